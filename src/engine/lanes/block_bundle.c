/* block_bundle.c - which of 64 rays to a light are blocked; see bundle.h.
 *
 * The rays are taken from the light: those of one tile leave it close together, however far apart the points
 * are that they lead to. Yet the beam round them holds much that none of them meets; so what the whole beam
 * meets is asked again of the packets, from the first that met the parent, and a child that none of them
 * meets is left out. When few rays are left they finish one by one, since each goes its own way by then.
 */
#include "engine/lanes/beam.h"
#include "engine/lanes/path.h"
#include "engine/lanes/single_ray.h"
#include "engine/referee.h"

enum {
    FEW_RAYS = 8
};

static ShadowRay exactShadow(const Bundle *bundle, int lane)
{
    return shadowRayFrom(laneVector(bundle->origins, lane), bundle->light);
}

/* The rays of a packet, of these, that the referee finds blocked. */
static __attribute__((noinline)) unsigned refereeBlocked(const Bundle *bundle, int p, unsigned rays,
                                                         int32_t candidate)
{
    unsigned blocked = 0;
    for (; rays != 0; rays &= rays - 1) {
        int i = __builtin_ctz(rays);
        if (primitiveIsPassed(bundle->compiled, candidate, laneVector(bundle->origins, 8 * p + i),
                              bundle->light))
            continue;
        ShadowRay shadow = exactShadow(bundle, 8 * p + i);
        if (primitiveBlocks(bundle->compiled, candidate, &shadow))
            blocked |= 1u << i;
    }
    return blocked;
}

/* Whether the candidate blocks no light, and need not be looked at. */
static inline bool skips(const CompiledScene *compiled, int32_t candidate)
{
    return candidate == NO_PRIMITIVE || (compiled->skipsShadow != NULL &&
                                         compiled->skipsShadow[primitiveObject(compiled, candidate)] != 0);
}

/* Take away the rays that are surely blocked, and those that the referee finds blocked. */
static inline bool takeBlocked(Bundle *bundle, int p, I8 possible, I8 sure, int32_t candidate)
{
    possible &= bundle->primitives[p] != i8Set(candidate);
    unsigned rays = maskBits(possible) & bundle->active[p];
    if (rays == 0)
        return false;
    unsigned blocked = rays & maskBits(sure);
    if (rays & ~blocked)
        blocked |= refereeBlocked(bundle, p, rays & ~blocked, candidate);
    bundle->active[p] &= (uint8_t)~blocked;
    return blocked != 0;
}

/* Of a depth with its error: whether it may be, and whether it surely is, between light and surface. */
static inline I8 mayBeBetween(const Bundle *bundle, int p, F8 depth, F8 error)
{
    return (depth - error < bundle->farthest[p]) & (depth + error > f8Set(bundle->startDepth));
}

static inline I8 isBetween(const Bundle *bundle, int p, F8 depth, F8 error)
{
    return (depth + error < bundle->nearest[p]) & (depth - error > f8Set(bundle->startDepth));
}

static bool blockBySpheres(Bundle *bundle, const Beam *beam, const SphereBlock *block)
{
    LocalSpheres local;
    bool changed = false;
    for (unsigned met = beamMeetsSpheres(bundle, beam, block, &local); met != 0; met &= met - 1) {
        int i = __builtin_ctz(met);
        int32_t candidate = block->primitives[i];
        if (skips(bundle->compiled, candidate))
            continue;
        OneSphere one = pickSphere(beam, &local, i);
        unsigned packets = packetsMeetSphere(bundle, beam, one.x, one.y, one.z, local.radius[i] + one.error);
        for (; packets != 0; packets &= packets - 1) {
            int p = __builtin_ctz(packets);
            if (bundle->active[p] == 0)
                continue;
            SphereDepths depths = sphereDepths(bundle, p, &one);
            if (maskBits(depths.possible) == 0)
                continue;
            I8 may = mayBeBetween(bundle, p, depths.entry, depths.error) |
                     mayBeBetween(bundle, p, depths.exit, depths.error);
            I8 is = isBetween(bundle, p, depths.entry, depths.error) |
                    isBetween(bundle, p, depths.exit, depths.error);
            changed |= takeBlocked(bundle, p, depths.possible & may, depths.sure & is, candidate);
        }
    }
    return changed;
}

static bool blockByTriangles(Bundle *bundle, const Beam *beam, const TriangleBlock *block)
{
    LocalTriangles local;
    bool changed = false;
    for (unsigned met = beamMeetsTriangles(bundle, beam, block, &local); met != 0; met &= met - 1) {
        int i = __builtin_ctz(met);
        int32_t candidate = block->primitives[i];
        if (skips(bundle->compiled, candidate))
            continue;
        for (unsigned packets = packetsMeetTriangle(beam, &local, i); packets != 0; packets &= packets - 1) {
            int p = __builtin_ctz(packets);
            if (bundle->active[p] == 0)
                continue;
            TriangleDepths depths = triangleDepths(bundle, p, &local, i);
            if (maskBits(depths.possible) != 0)
                changed |= takeBlocked(
                    bundle, p, depths.possible & mayBeBetween(bundle, p, depths.depth, depths.error),
                    depths.sure & isBetween(bundle, p, depths.depth, depths.error), candidate);
        }
    }
    return changed;
}

static bool blockByObjects(Bundle *bundle, const Beam *beam, const ObjectBlock *block, Slabs *slabs)
{
    bool changed = false;
    prepareSlabs(bundle, slabs);
    for (int i = 0; i < BVH_WIDTH && block->primitives[i] != NO_PRIMITIVE; i++) {
        if (skips(bundle->compiled, block->primitives[i]))
            continue;
        SlabBox box = createSlabBox(bundle, beam, &block->min[0][0], i);
        for (int p = 0; p < PACKETS; p++) {
            if (bundle->active[p] == 0)
                continue;
            unsigned rays = packetMeetsBox(bundle, slabs, p, &box);
            if (rays != 0)
                changed |= takeBlocked(bundle, p, maskOfBits(rays), i8Set(0), block->primitives[i]);
        }
    }
    return changed;
}

static bool blockByLeaf(Bundle *bundle, const Beam *beam, uint32_t reference, Slabs *slabs)
{
    const CompiledScene *compiled = bundle->compiled;
    switch (childKind(reference)) {
    case LEAF_SPHERES:
        return blockBySpheres(bundle, beam, &compiled->sphereBlocks[childNumber(reference)]);
    case LEAF_TRIANGLES:
        return blockByTriangles(bundle, beam, &compiled->triangleBlocks[childNumber(reference)]);
    default:
        return blockByObjects(bundle, beam, &compiled->objectBlocks[childNumber(reference)], slabs);
    }
}

static int raysLeft(const Bundle *bundle)
{
    uint64_t all;
    _Static_assert(sizeof all == sizeof bundle->active, "a bit for each ray");
    __builtin_memcpy(&all, bundle->active, sizeof all);
    return __builtin_popcountll(all);
}

/* Let the rays that are left finish one by one, each from all that waits. */
static void finishSingly(Bundle *bundle, const uint32_t *waiting, int count, uint32_t *lastBlock)
{
    const int32_t *own = (const int32_t *)bundle->primitives;
    for (int p = 0; p < PACKETS; p++)
        for (unsigned rays = bundle->active[p]; rays != 0; rays &= rays - 1) {
            int i = __builtin_ctz(rays);
            ShadowRay shadow = exactShadow(bundle, 8 * p + i);
            if (blockSingleRay(bundle->compiled, &shadow, own[8 * p + i], waiting, count, lastBlock))
                bundle->active[p] &= (uint8_t) ~(1u << i);
        }
}

/* A part of the tree that waits, and the first packet that may meet it. */
typedef struct Waiting {
    uint32_t reference;
    int firstPacket;
} Waiting;

void PATH(blockBundle)(Bundle *bundle, uint32_t *lastBlock)
{
    const CompiledScene *compiled = bundle->compiled;
    if (compiled->root == CHILD_NONE)
        return;
    Beam beam;
    createBeam(bundle, &beam);
    Slabs slabs;
    slabs.isReady = false;
    if (*lastBlock != CHILD_NONE) {
        blockByLeaf(bundle, &beam, *lastBlock, &slabs);
        if (raysLeft(bundle) == 0)
            return;
    }
    prepareSlabs(bundle, &slabs);

    Waiting stack[BVH_STACK_SIZE];
    int waiting = 1;
    stack[0] = (Waiting){compiled->root, 0};
    while (waiting > 0) {
        if (raysLeft(bundle) <= FEW_RAYS) {
            uint32_t rest[BVH_STACK_SIZE];
            for (int i = 0; i < waiting; i++)
                rest[i] = stack[i].reference;
            finishSingly(bundle, rest, waiting, lastBlock);
            return;
        }
        Waiting current = stack[--waiting];
        if (childKind(current.reference) != LEAF_NODE) {
            if (blockByLeaf(bundle, &beam, current.reference, &slabs)) {
                *lastBlock = current.reference;
                if (raysLeft(bundle) == 0)
                    return;
            }
            continue;
        }
        const BvhNode *node = &compiled->nodes[childNumber(current.reference)];
        F8 depths;
        for (unsigned met = beamMeetsChildren(bundle, &beam, node, &depths); met != 0; met &= met - 1) {
            int child = __builtin_ctz(met), p = current.firstPacket;
            SlabBox box = createSlabBox(bundle, &beam, &node->min[0][0], child);
            while (p < PACKETS && (bundle->active[p] == 0 || packetMeetsBox(bundle, &slabs, p, &box) == 0))
                p++;
            if (p < PACKETS)
                stack[waiting++] = (Waiting){node->children[child], p};
        }
    }
}
