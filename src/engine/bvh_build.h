/* bvh_build.h - the making of the tree of boxes; see bvh_build.c. */
#ifndef ECLAIRAGE_ENGINE_BVH_BUILD_H
#define ECLAIRAGE_ENGINE_BVH_BUILD_H

#include "engine/compiled_scene.h"
#include "engine/lanes/simd.h"

#include <stdatomic.h>

/* The box of a primitive: min and max in lanes 0 to 2. Lane 3 has the bits of the primitive's number, as
 * numbers from 1 to 2, with which arithmetic is as fast as with any other: a float that is no normal number
 * is slow. */
typedef struct BuildItem {
    F4 min, max;
} BuildItem;

enum {
    ITEM_BITS = 23 /* of a number in one lane: those behind a float's point */
};

static inline float itemBits(uint32_t bits)
{
    union {
        uint32_t bits;
        float number;
    } both = {bits | 0x3F800000};
    return both.number;
}

static inline uint32_t bitsOfItem(float number)
{
    union {
        float number;
        uint32_t bits;
    } both = {number};
    return both.bits & ((1u << ITEM_BITS) - 1);
}

static inline void setItemPrimitive(BuildItem *item, uint32_t primitive)
{
    item->min[3] = itemBits(primitive & ((1u << ITEM_BITS) - 1));
    item->max[3] = itemBits(primitive >> ITEM_BITS);
}

static inline int32_t itemPrimitive(const BuildItem *item)
{
    return (int32_t)(bitsOfItem(item->min[3]) | bitsOfItem(item->max[3]) << ITEM_BITS);
}

/* Make block number `block` of up to 8 items. */
typedef void (*FillBlock)(CompiledScene *compiled, uint32_t block, const BuildItem *items, size_t count);

/* One tree, of primitives of one kind. */
typedef struct BvhBuild {
    CompiledScene *compiled; /* whose nodes have room for bvhNodeLimit(count) more from nodesUsed on */
    BuildItem *items;        /* reordered */
    size_t count;            /* at least 1 */
    LeafKind kind;
    FillBlock fill;
    atomic_uint *nodesUsed;
    atomic_uint blocksUsed; /* from 0; there is room for bvhBlockLimit(count) */
    int threads;
} BvhBuild;

/* The most nodes and blocks that a tree of so many primitives takes. */
size_t bvhNodeLimit(size_t count);
size_t bvhBlockLimit(size_t count);

/* Build it; *root refers to its root, and *box is round all of it. STATUS_INTERRUPTED when cancelled. */
Status buildBvh(BvhBuild *build, uint32_t *root, BuildItem *box);

/* Set one child of a node, or with NULL leave it empty. */
void setNodeChild(BvhNode *node, int child, const BuildItem *box, uint32_t reference);

#endif
