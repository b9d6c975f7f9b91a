/* bvh_check.c - the invariants of the tree as a function; see compiled_scene.h. */
#include "engine/compiled_scene.h"

#include <stdlib.h>

typedef struct Check {
    const CompiledScene *compiled;
    uint8_t *seen; /* of each primitive */
    const char *fault;
} Check;

/* One box of a node, or of an object block. */
typedef struct FloatBox {
    float min[3], max[3];
} FloatBox;

static bool holds(const FloatBox *outer, const FloatBox *inner)
{
    for (int k = 0; k < 3; k++)
        if (!(outer->min[k] <= inner->min[k] && inner->max[k] <= outer->max[k]))
            return false;
    return true;
}

/* Box number `lane` of a node or of a block of objects, whose floats begin there. */
static FloatBox floatBox(const float *floats, int lane)
{
    FloatBox box;
    for (int k = 0; k < 3; k++) {
        box.min[k] = floats[8 * k + lane];
        box.max[k] = floats[8 * k + lane + 24];
    }
    return box;
}

/* The box of primitive number `lane` of a block, from what rays are tested against: a float has some error
 * beside the double that the tree's box was made from, so it is made smaller by that. */
static FloatBox primitiveBox(const CompiledScene *compiled, uint32_t reference, int lane)
{
    uint32_t number = childNumber(reference);
    if (childKind(reference) == LEAF_OBJECTS)
        return floatBox(&compiled->objectBlocks[number].min[0][0], lane);
    FloatBox box;
    for (int k = 0; k < 3; k++) {
        float low, high;
        if (childKind(reference) == LEAF_SPHERES) {
            const SphereBlock *block = &compiled->sphereBlocks[number];
            const float *centers[3] = {block->x, block->y, block->z};
            low = centers[k][lane] - block->radius[lane];
            high = centers[k][lane] + block->radius[lane];
        } else {
            const TriangleBlock *block = &compiled->triangleBlocks[number];
            low = high = block->corners[0][k][lane];
            for (int c = 1; c < 3; c++) {
                low = fminf(low, block->corners[c][k][lane]);
                high = fmaxf(high, block->corners[c][k][lane]);
            }
        }
        float error = 0x1p-22f * fmaxf(fabsf(low), fabsf(high)) + 1e-30f;
        box.min[k] = low + error < high ? low + error : high;
        box.max[k] = high - error > low ? high - error : low;
        if (box.min[k] > box.max[k])
            box.min[k] = box.max[k] = (low + high) / 2;
    }
    return box;
}

static void checkLeaf(Check *check, uint32_t reference, const FloatBox *box)
{
    const CompiledScene *compiled = check->compiled;
    uint32_t number = childNumber(reference);
    LeafKind kind = childKind(reference);
    size_t blocks = kind == LEAF_SPHERES     ? compiled->sphereBlockCount
                    : kind == LEAF_TRIANGLES ? compiled->triangleBlockCount
                                             : compiled->objectBlockCount;
    if (number >= blocks) {
        check->fault = "a block that is not there";
        return;
    }
    const int32_t *primitives = kind == LEAF_SPHERES     ? compiled->sphereBlocks[number].primitives
                                : kind == LEAF_TRIANGLES ? compiled->triangleBlocks[number].primitives
                                                         : compiled->objectBlocks[number].primitives;
    size_t count = compiled->sphereCount + compiled->triangleCount + compiled->generalCount;
    for (int i = 0; i < BVH_WIDTH; i++) {
        if (primitives[i] == NO_PRIMITIVE)
            continue;
        if (primitives[i] < 0 || (size_t)primitives[i] >= count) {
            check->fault = "a primitive that is not there";
            return;
        }
        if (check->seen[primitives[i]]++ != 0)
            check->fault = "a primitive in two places";
        FloatBox own = primitiveBox(compiled, reference, i);
        if (box != NULL && !holds(box, &own))
            check->fault = "a primitive outside its box";
    }
}

static void checkPart(Check *check, uint32_t reference, const FloatBox *box, int depth)
{
    if (check->fault != NULL)
        return;
    if (childKind(reference) != LEAF_NODE) {
        checkLeaf(check, reference, box);
        return;
    }
    if (depth >= BVH_MAX_DEPTH || childNumber(reference) >= check->compiled->nodeCount) {
        check->fault = "a node too deep, or one that is not there";
        return;
    }
    const BvhNode *node = &check->compiled->nodes[childNumber(reference)];
    bool ended = false;
    for (int i = 0; i < BVH_WIDTH; i++) {
        if (node->children[i] == CHILD_NONE) {
            ended = true;
            continue;
        }
        FloatBox own = floatBox(&node->min[0][0], i);
        if (ended)
            check->fault = "a child behind an absent one";
        else if (box != NULL && !holds(box, &own))
            check->fault = "a box outside its parent's";
        else
            checkPart(check, node->children[i], &own, depth + 1);
    }
}

const char *findBvhFault(const CompiledScene *compiled)
{
    size_t count = compiled->sphereCount + compiled->triangleCount + compiled->generalCount;
    if (count == 0)
        return compiled->root == CHILD_NONE ? NULL : "a tree of nothing";
    Check check = {.compiled = compiled, .seen = calloc(count, 1)};
    if (check.seen == NULL)
        return NULL;
    checkPart(&check, compiled->root, NULL, 0);
    for (size_t i = 0; i < count && check.fault == NULL; i++)
        if (check.seen[i] == 0)
            check.fault = "a primitive that is in no block";
    free(check.seen);
    return check.fault;
}
