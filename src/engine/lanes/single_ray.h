/* single_ray.h - one ray through the tree, eight boxes or primitives at a time.
 *
 * For rays that have no company: mirrored and refracted ones, and what is left of a bundle. As in bundle.h
 * the float filter keeps what may be met, and the referee decides.
 */
#ifndef ECLAIRAGE_ENGINE_SINGLE_RAY_H
#define ECLAIRAGE_ENGINE_SINGLE_RAY_H

#include "engine/lanes/beam.h"
#include "engine/referee.h"

typedef struct FloatRay {
    float origin[3], direction[3], inverse[3]; /* scaled; the direction of unit length */
    float nearOrigin[3], farOrigin[3]; /* the origin, moved by the margin for the two planes of a slab */
    int nearAt[3], farAt[3];           /* where in a node the planes are that it enters and leaves by */
    float errorBase;                   /* as of a beam */
    double skipped; /* the origin is this much farther along the ray than where the ray begins */
    float limit;    /* hits farther than this from the origin do not count */
} FloatRay;

/* Hits farther than this scaled distance from where the ray begins do not count. */
static inline void limitFloatRay(FloatRay *ray, double distance)
{
    double limit = (distance - ray->skipped) * (1 + 1e-6) + (double)ray->errorBase;
    ray->limit = limit < (double)ray->limit ? (float)limit : ray->limit;
}

/* All of the tree is within this distance of 0. */
#define TREE_RADIUS 4.0

static inline FloatRay createFloatRay(const CompiledScene *compiled, const Ray *ray, double farthest)
{
    FloatRay made = {.limit = 4 * (float)TREE_RADIUS};
    Vector3D origin = multVector(ray->origin, compiled->scale), d = ray->direction;

    /* From far away begin where the ray comes near the tree, so that the numbers are small; a ray that does
     * not come near meets nothing. */
    double size = largestCoordinate(origin);
    if (size > TREE_RADIUS) {
        double skipped = -dot(origin, d) - TREE_RADIUS;
        made.skipped = skipped > 0 ? skipped : 0;
        origin = addVectors(origin, multVector(d, made.skipped));
        double left = largestCoordinate(origin), rounding = 0x1p-46 * size;
        if (left > 2 * TREE_RADIUS + rounding)
            made.limit = -INFINITY;
        made.errorBase = (float)rounding;
        if (!(rounding < 1)) {
            /* From so far away floats tell nothing: with this error, whose square is still a float, anything
             * may be met. */
            origin = createVector(0, 0, 0);
            made.skipped = 0;
            made.errorBase = 1e15f;
        }
    }
    const double origins[3] = {origin.x, origin.y, origin.z}, directions[3] = {d.x, d.y, d.z};
    float largest = 0;
    for (int k = 0; k < 3; k++) {
        made.origin[k] = (float)origins[k];
        made.direction[k] = (float)directions[k];
        largest = fabsf(made.origin[k]) > largest ? fabsf(made.origin[k]) : largest;
        /* Next to nothing in place of 0, whose inverse times 0 is no number. */
        float along = made.direction[k];
        along = fabsf(along) < 1e-12f ? copysignf(1e-12f, along) : along;
        made.inverse[k] = 1 / along;
        made.nearAt[k] = nodeCoordinate(k, along < 0);
        made.farAt[k] = nodeCoordinate(k, along > 0);
    }
    made.errorBase += FLOAT_ERROR * largest + LEAST_ERROR;
    float margin = 2 * (made.errorBase + FLOAT_ERROR * 2);
    for (int k = 0; k < 3; k++) {
        float outward = made.inverse[k] > 0 ? margin : -margin;
        made.nearOrigin[k] = made.origin[k] + outward;
        made.farOrigin[k] = made.origin[k] - outward;
    }
    limitFloatRay(&made, farthest * compiled->scale);
    return made;
}

/* The boxes, of a node's children or of a block of objects, that the ray may meet before its limit, as bits;
 * and where it enters them. floats: as of a node. */
static inline unsigned rayMeetsBoxes(const FloatRay *ray, const float *floats, F8 *entries)
{
    F8 entry = f8Set(0), exit = f8Set(ray->limit);
    for (int k = 0; k < 3; k++) {
        F8 inverse = f8Set(ray->inverse[k]);
        entry = f8Max(entry, (f8Load(floats + ray->nearAt[k]) - f8Set(ray->nearOrigin[k])) * inverse);
        exit = f8Min(exit, (f8Load(floats + ray->farAt[k]) - f8Set(ray->farOrigin[k])) * inverse);
    }
    *entries = entry;
    return maskBits(entry <= exit * f8Set(1 + 1e-6f));
}

/* The spheres of a block that the ray may meet before its limit, as bits; and those that it surely meets
 * before `sureLimit`. */
static inline unsigned rayMeetsSpheres(const FloatRay *ray, const SphereBlock *block, float sureLimit,
                                       unsigned *sure)
{
    F8 x = f8Load(block->x) - f8Set(ray->origin[0]), y = f8Load(block->y) - f8Set(ray->origin[1]);
    F8 z = f8Load(block->z) - f8Set(ray->origin[2]), radius = f8Load(block->radius);
    F8 dx = f8Set(ray->direction[0]), dy = f8Set(ray->direction[1]), dz = f8Set(ray->direction[2]);
    F8 d = f8MultAdd(f8Set(FLOAT_ERROR), largestOf(block->x, block->y, block->z) + radius,
                     f8Set(ray->errorBase));
    F8 middle = f8MultAdd(x, dx, f8MultAdd(y, dy, z * dz));
    F8 ex = f8NegMultAdd(middle, dx, x), ey = f8NegMultAdd(middle, dy, y), ez = f8NegMultAdd(middle, dz, z);
    F8 squaredRadius = radius * radius;
    F8 discriminant = squaredRadius - f8MultAdd(ex, ex, f8MultAdd(ey, ey, ez * ez));
    F8 margin = f8MultAdd(radius + radius + d, d, squaredRadius * f8Set(0x1p-21f));
    I8 possible = discriminant > -margin;
    *sure = 0;
    if (maskBits(possible) == 0)
        return 0;
    F8 root = f8Sqrt(f8Max(discriminant, margin));
    F8 error = margin / root + (d + d);
    F8 entry = middle - root, exit = middle + root, zero = f8Set(0);
    possible &= (entry - error <= f8Set(ray->limit)) & (exit + error >= zero);
    *sure = maskBits((discriminant > margin) & (entry - error > zero) & (entry + error < f8Set(sureLimit)));
    return maskBits(possible);
}

/* The triangles of a block that the ray may meet before its limit, likewise. */
static inline unsigned rayMeetsTriangles(const FloatRay *ray, const TriangleBlock *block, float sureLimit,
                                         unsigned *sure)
{
    F8 p[3][3], largest = f8Set(0), zero = f8Set(0);
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++) {
            F8 corner = f8Load(block->corners[c][k]);
            p[c][k] = corner - f8Set(ray->origin[k]);
            largest = f8Max(largest, f8Abs(corner));
        }
    F8 d = f8MultAdd(f8Set(FLOAT_ERROR), largest, f8Set(ray->errorBase));
    LocalTriangles local;
    setUpTriangles(false, 1, p, d, &local);
    F8 x = f8Set(ray->direction[0]), y = f8Set(ray->direction[1]), z = f8Set(ray->direction[2]);
#define ALONG(n) f8MultAdd(x, f8Load(n[0]), f8MultAdd(y, f8Load(n[1]), z *f8Load(n[2])))
    F8 inner = least3(ALONG(local.edges[0]), ALONG(local.edges[1]), ALONG(local.edges[2]));
    F8 margin = f8Load(local.edgeMargin), slopeMargin = f8Load(local.depthMargin);
    I8 possible = inner >= -margin;
    *sure = 0;
    if (maskBits(possible) == 0)
        return 0;
    F8 sureSlope = f8Abs(ALONG(local.normal)) - slopeMargin;
    I8 steep = sureSlope > slopeMargin;
    F8 distance = f8Select(steep, f8Set(1) / ALONG(local.depth), zero);
#undef ALONG
    F8 error = (d + d) * (f8Set(1) + f8Load(local.depthScale) / sureSlope);
    error = f8Select(steep, error, f8Set(INFINITY));
    possible &= (distance - error <= f8Set(ray->limit)) & (distance + error >= zero);
    *sure = maskBits((inner > margin) & steep & (distance - error > zero) &
                     (distance + error < f8Set(sureLimit)));
    return maskBits(possible);
}

/* What the ray may meet in a leaf, as bits, and what it surely does; and the primitives they stand for. */
static inline unsigned rayMeetsLeaf(const CompiledScene *compiled, const FloatRay *ray, uint32_t reference,
                                    float sureLimit, unsigned *sure, const int32_t **primitives)
{
    uint32_t number = childNumber(reference);
    switch (childKind(reference)) {
    case LEAF_SPHERES:
        *primitives = compiled->sphereBlocks[number].primitives;
        return rayMeetsSpheres(ray, &compiled->sphereBlocks[number], sureLimit, sure);
    case LEAF_TRIANGLES:
        *primitives = compiled->triangleBlocks[number].primitives;
        return rayMeetsTriangles(ray, &compiled->triangleBlocks[number], sureLimit, sure);
    default:
        *primitives = compiled->objectBlocks[number].primitives;
        *sure = 0;
        F8 entries;
        return rayMeetsBoxes(ray, &compiled->objectBlocks[number].min[0][0], &entries);
    }
}

/* Whether a primitive of this leaf, not `own`, blocks the way. */
static inline bool leafBlocks(const CompiledScene *compiled, const FloatRay *ray, const ShadowRay *shadow,
                              uint32_t reference, float sureLimit, int32_t own)
{
    const int32_t *primitives;
    unsigned sure, possible = rayMeetsLeaf(compiled, ray, reference, sureLimit, &sure, &primitives);
    for (; possible != 0; possible &= possible - 1) {
        int i = __builtin_ctz(possible);
        int32_t candidate = primitives[i];
        if (candidate == NO_PRIMITIVE || candidate == own ||
            (compiled->skipsShadow != NULL &&
             compiled->skipsShadow[primitiveObject(compiled, candidate)] != 0))
            continue;
        if ((sure >> i & 1) != 0 || primitiveBlocks(compiled, candidate, shadow))
            return true;
    }
    return false;
}

/* Whether a primitive in what waits, `count` parts of the tree, lies on the way; the leaf of the last one
 * that did is tried first. */
static inline bool blockSingleRay(const CompiledScene *compiled, const ShadowRay *shadow, int32_t own,
                                  const uint32_t *parts, int count, uint32_t *lastBlock)
{
    FloatRay ray = createFloatRay(compiled, &shadow->ray, shadow->farthest);
    double sure =
        (shadow->farthest * compiled->scale - ray.skipped) * (1 - 1e-6) - (double)(4 * ray.errorBase);
    float sureLimit = sure < (double)ray.limit ? (float)sure : ray.limit;
    if (shadow->above > 0)
        sureLimit = 0; /* a hit may not be far enough */
    uint32_t stack[2 * BVH_STACK_SIZE];
    int waiting = 0;
    for (; waiting < count; waiting++)
        stack[waiting] = parts[waiting];
    if (*lastBlock != CHILD_NONE && leafBlocks(compiled, &ray, shadow, *lastBlock, sureLimit, own))
        return true;
    while (waiting > 0) {
        uint32_t current = stack[--waiting];
        if (childKind(current) != LEAF_NODE) {
            if (leafBlocks(compiled, &ray, shadow, current, sureLimit, own)) {
                *lastBlock = current;
                return true;
            }
            continue;
        }
        const BvhNode *node = &compiled->nodes[childNumber(current)];
        F8 entries;
        for (unsigned met = rayMeetsBoxes(&ray, &node->min[0][0], &entries); met != 0; met &= met - 1)
            stack[waiting++] = node->children[__builtin_ctz(met)];
    }
    return false;
}

#endif
