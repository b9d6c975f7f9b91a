/* meet_bundle.c - the nearest primitive of each of 64 rays; see bundle.h.
 *
 * One walk through the tree for all, near children first. For each ray an interval is kept that surely holds
 * the depth of the nearest hit so far. A new hit replaces it when it is sure and its own interval is wholly
 * in front, and plays no part when it is wholly behind; where the two overlap the referee decides between
 * them by their exact distances, as the reference tracer would.
 */
#include "engine/lanes/beam.h"
#include "engine/lanes/path.h"
#include "engine/referee.h"

/* The exact distance of the nearest hit so far, worked out when it is first asked for. */
static double exactNearest(Bundle *bundle, int lane, const Ray *ray)
{
    const int32_t *primitives = (const int32_t *)bundle->primitives;
    int32_t primitive = primitives[lane];
    if (primitive == NO_PRIMITIVE)
        return INFINITY;
    if (bundle->exactPrimitives[lane] != primitive) {
        bundle->exact[lane] = meetPrimitive(bundle->compiled, primitive, ray, &bundle->hits[lane]);
        bundle->exactPrimitives[lane] = primitive;
    }
    return bundle->exact[lane];
}

/* Which of the two the reference tracer keeps when both are as far. */
static bool winsTie(const Bundle *bundle, int32_t candidate, int32_t holder)
{
    const CompiledScene *compiled = bundle->compiled;
    if (holder >= 0)
        return comesFirst(compiled, candidate, holder);
    if (holder == NO_PRIMITIVE)
        return true;
    size_t number = endlessNumber(holder);
    uint32_t object = number < compiled->planeCount ? compiled->planes[number].object
                                                    : compiled->endless[number - compiled->planeCount];
    return primitiveObject(compiled, candidate) < object;
}

/* Let the referee decide between the candidate and the nearest so far, for these rays of a packet. */
static __attribute__((noinline)) bool refereeNearest(Bundle *bundle, int p, unsigned rays, int32_t candidate)
{
    float *nearest = (float *)&bundle->nearest[p], *farthest = (float *)&bundle->farthest[p];
    int32_t *primitives = (int32_t *)bundle->primitives;
    const float *slopes = (const float *)&bundle->slope[p];
    bool changed = false;
    for (; rays != 0; rays &= rays - 1) {
        int i = __builtin_ctz(rays), lane = 8 * p + i;
        Ray ray = createRay(laneVector(bundle->origins, lane), laneVector(bundle->directions, lane));
        Hit hit;
        double distance = meetPrimitive(bundle->compiled, candidate, &ray, &hit);
        if (distance == INFINITY)
            continue;
        double holder = exactNearest(bundle, lane, &ray);
        if (distance < holder || (distance == holder && winsTie(bundle, candidate, primitives[lane]))) {
            primitives[lane] = bundle->exactPrimitives[lane] = candidate;
            bundle->exact[lane] = holder = distance;
            bundle->hits[lane] = hit;
            changed = true;
        }
        double depth = holder * bundle->compiled->scale / sqrt((double)slopes[i]);
        nearest[i] = (float)(depth * (1 - 1e-6));
        farthest[i] = (float)(depth * (1 + 1e-6));
    }
    return changed;
}

/* Take the rays that surely hit in front, and send those to the referee that may; possible: the hit is not
 * behind the start. */
static inline bool takeHits(Bundle *bundle, int p, I8 possible, I8 sure, F8 depth, F8 error,
                            int32_t candidate)
{
    F8 low = depth - error, high = depth + error;
    possible &= low <= bundle->farthest[p];
    unsigned rays = maskBits(possible) & bundle->active[p];
    if (rays == 0)
        return false;
    I8 wins = possible & sure & (high < bundle->nearest[p]) & (low > f8Set(bundle->startDepth));
    wins &= maskOfBits(rays);
    bundle->nearest[p] = f8Select(wins, low, bundle->nearest[p]);
    bundle->farthest[p] = f8Select(wins, high, bundle->farthest[p]);
    bundle->primitives[p] = i8Select(wins, i8Set(candidate), bundle->primitives[p]);
    unsigned doubtful = rays & ~maskBits(wins);
    if (doubtful != 0)
        refereeNearest(bundle, p, doubtful, candidate);
    return true;
}

static bool meetSpheres(Bundle *bundle, const Beam *beam, const SphereBlock *block)
{
    LocalSpheres local;
    bool changed = false;
    for (unsigned met = beamMeetsSpheres(bundle, beam, block, &local); met != 0; met &= met - 1) {
        int i = __builtin_ctz(met);
        int32_t candidate = block->primitives[i];
        if (candidate == NO_PRIMITIVE)
            continue;
        OneSphere one = pickSphere(beam, &local, i);
        float squared = one.x * one.x + one.y * one.y + one.z * one.z;
        float outer = local.radius[i] + one.error, inner = local.radius[i] - 2 * one.error;
        /* Surely inside, the rays meet it where they leave it. */
        bool fromInside = !bundle->isParallel && inner > 0 && squared * (1 + 0x1p-20f) < inner * inner;
        unsigned packets = packetsMeetSphere(bundle, beam, one.x, one.y, one.z, outer);
        for (; packets != 0; packets &= packets - 1) {
            int p = __builtin_ctz(packets);
            SphereDepths depths = sphereDepths(bundle, p, &one);
            if (maskBits(depths.possible) == 0)
                continue;
            I8 exits = depths.exit + depths.error >= f8Set(bundle->startDepth);
            changed |= takeHits(bundle, p, depths.possible & exits, depths.sure,
                                fromInside ? depths.exit : depths.entry, depths.error, candidate);
        }
    }
    return changed;
}

static bool meetTriangles(Bundle *bundle, const Beam *beam, const TriangleBlock *block)
{
    LocalTriangles local;
    bool changed = false;
    for (unsigned met = beamMeetsTriangles(bundle, beam, block, &local); met != 0; met &= met - 1) {
        int i = __builtin_ctz(met);
        int32_t candidate = block->primitives[i];
        if (candidate == NO_PRIMITIVE)
            continue;
        for (unsigned packets = packetsMeetTriangle(beam, &local, i); packets != 0; packets &= packets - 1) {
            int p = __builtin_ctz(packets);
            TriangleDepths depths = triangleDepths(bundle, p, &local, i);
            if (maskBits(depths.possible) == 0)
                continue;
            I8 starts = depths.depth + depths.error >= f8Set(bundle->startDepth);
            changed |= takeHits(bundle, p, depths.possible & starts, depths.sure, depths.depth, depths.error,
                                candidate);
        }
    }
    return changed;
}

static bool meetObjects(Bundle *bundle, const Beam *beam, const ObjectBlock *block, Slabs *slabs)
{
    bool changed = false;
    prepareSlabs(bundle, slabs);
    for (int i = 0; i < BVH_WIDTH && block->primitives[i] != NO_PRIMITIVE; i++) {
        SlabBox box = createSlabBox(bundle, beam, &block->min[0][0], i);
        for (int p = 0; p < PACKETS; p++) {
            if (bundle->active[p] == 0)
                continue;
            unsigned rays = packetMeetsBox(bundle, slabs, p, &box);
            if (rays != 0)
                changed |= refereeNearest(bundle, p, rays, block->primitives[i]);
        }
    }
    return changed;
}

/* A part of the tree that waits. */
typedef struct Waiting {
    uint32_t reference;
    float depth; /* its least */
} Waiting;

void PATH(meetBundle)(Bundle *bundle)
{
    const CompiledScene *compiled = bundle->compiled;
    if (compiled->root == CHILD_NONE)
        return;
    Beam beam;
    createBeam(bundle, &beam);
    Slabs slabs;
    slabs.isReady = false;
    Waiting stack[BVH_STACK_SIZE];
    int waiting = 0;
    uint32_t current = compiled->root;
    for (;;) {
        bool changed = false;
        switch (childKind(current)) {
        case LEAF_NODE: {
            const BvhNode *node = &compiled->nodes[childNumber(current)];
            F8 depths;
            unsigned met = beamMeetsChildren(bundle, &beam, node, &depths);
            if (met != 0 && (met & (met - 1)) == 0) {
                current = node->children[__builtin_ctz(met)];
                continue;
            }
            /* Put them on the stack with the nearest on top. */
            _Alignas(32) float depth[8];
            f8Store(depth, depths);
            int base = waiting;
            for (; met != 0; met &= met - 1) {
                int i = __builtin_ctz(met), at = waiting++;
                for (; at > base && stack[at - 1].depth < depth[i]; at--)
                    stack[at] = stack[at - 1];
                stack[at] = (Waiting){node->children[i], depth[i]};
            }
            break;
        }
        case LEAF_SPHERES:
            changed = meetSpheres(bundle, &beam, &compiled->sphereBlocks[childNumber(current)]);
            break;
        case LEAF_TRIANGLES:
            changed = meetTriangles(bundle, &beam, &compiled->triangleBlocks[childNumber(current)]);
            break;
        case LEAF_OBJECTS:
            changed = meetObjects(bundle, &beam, &compiled->objectBlocks[childNumber(current)], &slabs);
            break;
        }
        if (changed)
            beam.reach = largestDepth(bundle);
        do {
            if (waiting == 0)
                return;
            waiting--;
        } while (stack[waiting].depth > beam.reach + 2 * beam.nodeError);
        current = stack[waiting].reference;
    }
}
