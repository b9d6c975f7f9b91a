/* single_ray.c - one ray through the tree; see single_ray.h. */
#include "engine/lanes/single_ray.h"

#include "engine/lanes/path.h"

/* A part of the tree that waits. */
typedef struct Waiting {
    uint32_t reference;
    float entry;
} Waiting;

/* Look at what the ray may meet in a leaf. */
static void meetLeaf(const CompiledScene *compiled, const Ray *ray, FloatRay *floats, uint32_t reference,
                     Hit *hit, uint32_t *object)
{
    const int32_t *primitives;
    unsigned sure, possible = rayMeetsLeaf(compiled, floats, reference, 0, &sure, &primitives);
    for (; possible != 0; possible &= possible - 1) {
        int32_t candidate = primitives[__builtin_ctz(possible)];
        if (candidate == NO_PRIMITIVE)
            continue;
        Hit own;
        double distance = meetPrimitive(compiled, candidate, ray, &own);
        if (!(distance < INFINITY) || distance > hit->distance)
            continue;
        /* At the same distance the one that comes first stays: of two triangles of a mesh, the first. */
        uint32_t number = primitiveObject(compiled, candidate);
        if (distance == hit->distance &&
            !(number < *object || (number == *object && own.object == hit->object && own.part < hit->part)))
            continue;
        *object = number;
        *hit = own;
        limitFloatRay(floats, distance * compiled->scale);
    }
}

void PATH(meetRay)(const CompiledScene *compiled, const Ray *ray, Hit *hit, uint32_t *object)
{
    if (compiled->root == CHILD_NONE)
        return;
    FloatRay floats = createFloatRay(compiled, ray, hit->distance);
    Waiting stack[BVH_STACK_SIZE];
    int waiting = 0;
    uint32_t current = compiled->root;
    for (;;) {
        if (childKind(current) == LEAF_NODE) {
            const BvhNode *node = &compiled->nodes[childNumber(current)];
            F8 entries;
            unsigned met = rayMeetsBoxes(&floats, &node->min[0][0], &entries);
            if (met != 0 && (met & (met - 1)) == 0) {
                current = node->children[__builtin_ctz(met)];
                continue;
            }
            /* Put them on the stack with the nearest on top. */
            _Alignas(32) float entry[8];
            f8Store(entry, entries);
            int base = waiting;
            for (; met != 0; met &= met - 1) {
                int i = __builtin_ctz(met), at = waiting++;
                for (; at > base && stack[at - 1].entry < entry[i]; at--)
                    stack[at] = stack[at - 1];
                stack[at] = (Waiting){node->children[i], entry[i]};
            }
        } else {
            meetLeaf(compiled, ray, &floats, current, hit, object);
        }
        do {
            if (waiting == 0)
                return;
            waiting--;
        } while (stack[waiting].entry > floats.limit * (1 + 1e-6f));
        current = stack[waiting].reference;
    }
}

bool PATH(blockRay)(const CompiledScene *compiled, const ShadowRay *shadow)
{
    uint32_t lastBlock = CHILD_NONE;
    return compiled->root != CHILD_NONE &&
           blockSingleRay(compiled, shadow, NO_PRIMITIVE, &compiled->root, 1, &lastBlock);
}
