/* bvh_build.c - the making of the tree of boxes.
 *
 * From the top: a node takes the range of primitives it was given and divides it in two, then again that part
 * whose box has the largest surface, until it has eight parts or all fit into blocks. Where to divide is
 * found by the surface area heuristic over bins (Wald 2007, "On fast construction of SAH-based bounding
 * volume hierarchies", section 3): among the borders between bins along each axis, the one with the least
 * area x primitives, counted in blocks of eight once the ranges are small (Wald, Benthin and Boulos 2008,
 * "Getting rid of packets", section 4.1, build trees of wide nodes this way).
 * In parallel: the root is divided once by one thread, its halves by two, and what then hangs below the root
 * and its children is built by as many as there are. The numbers of nodes and blocks depend on who came
 * first, the tree does not.
 */
#include "engine/bvh_build.h"

#include "base/cancel.h"
#include "base/threads.h"

#include <string.h>

enum {
    BIN_COUNT = 16,
    FEW_BINS = 8, /* for a range of fewer than FEW_ITEMS */
    FEW_ITEMS = 64,
    BLOCK_COST_LIMIT = 256, /* ranges up to this count whole blocks */
    SAH_DEPTH_LIMIT = 26, /* below it halves are taken as they lie, so that BVH_MAX_DEPTH is never reached */
    NODE_RESERVE = 16,    /* numbers a thread takes at a time */
    BLOCK_RESERVE = 64,
    CANCEL_POLL_COUNT = 4096
};

/* Some of the items, with the box round them and, of their boxes' middles (doubled: min + max), the extent.
 */
typedef struct Range {
    size_t first, end;
    F4 min, max;
    F4 middleMin, middleMax;
} Range;

/* Numbers of nodes and blocks that one thread may use without asking. */
typedef struct Reserve {
    unsigned node, nodeEnd, block, blockEnd;
} Reserve;

static F4 f4Set(float x)
{
    return (F4){x, x, x, x};
}

static Range emptyRange(size_t first, size_t end)
{
    F4 high = f4Set(INFINITY), low = f4Set(-INFINITY);
    return (Range){first, end, high, low, high, low};
}

static size_t rangeCount(const Range *range)
{
    return range->end - range->first;
}

static float halfArea(F4 min, F4 max)
{
    F4 size = max - min;
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

static void boundRange(const BuildItem *items, Range *range)
{
    for (size_t i = range->first; i < range->end; i++) {
        F4 middle = items[i].min + items[i].max;
        range->min = f4Min(range->min, items[i].min);
        range->max = f4Max(range->max, items[i].max);
        range->middleMin = f4Min(range->middleMin, middle);
        range->middleMax = f4Max(range->middleMax, middle);
    }
}

/* ---- Dividing a range in two ---- */

typedef struct Bins {
    F4 min[3][BIN_COUNT], max[3][BIN_COUNT];
    size_t counts[3][BIN_COUNT];
} Bins;

/* Which bin a middle is in: (middle - low) * binsPerUnit, cut to a whole number. */
typedef struct BinScale {
    F4 low, binsPerUnit;
    int count;
} BinScale;

static BinScale binScale(const Range *range)
{
    int count = rangeCount(range) < FEW_ITEMS ? FEW_BINS : BIN_COUNT;
    F4 extent = range->middleMax - range->middleMin;
    BinScale scale = {.low = range->middleMin, .count = count};
    for (int axis = 0; axis < 3; axis++) {
        float perUnit = (float)count * 0.99999f / extent[axis];
        scale.binsPerUnit[axis] = extent[axis] > 0 && perUnit < INFINITY ? perUnit : 0;
    }
    scale.low[3] = 0;
    scale.binsPerUnit[3] = 0;
    return scale;
}

static inline I4 binOf(const BinScale *scale, F4 middle)
{
    return __builtin_convertvector((middle - scale->low) * scale->binsPerUnit, I4);
}

static void fillBins(const BuildItem *items, const Range *range, const BinScale *scale, Bins *bins)
{
    for (int axis = 0; axis < 3; axis++)
        for (int b = 0; b < scale->count; b++) {
            bins->min[axis][b] = f4Set(INFINITY);
            bins->max[axis][b] = f4Set(-INFINITY);
            bins->counts[axis][b] = 0;
        }
    for (size_t i = range->first; i < range->end; i++) {
        F4 min = items[i].min, max = items[i].max;
        I4 place = binOf(scale, min + max);
        for (int axis = 0; axis < 3; axis++) {
            int b = place[axis];
            bins->min[axis][b] = f4Min(bins->min[axis][b], min);
            bins->max[axis][b] = f4Max(bins->max[axis][b], max);
            bins->counts[axis][b]++;
        }
    }
}

/* Divide between the bins border - 1 and border along the axis; axis -1: all middles are in one place. */
typedef struct Split {
    int axis, border;
} Split;

static float costOf(F4 min, F4 max, size_t count, bool inBlocks)
{
    return halfArea(min, max) * (float)(inBlocks ? (count + 7) / 8 * 8 : count);
}

static Split bestSplit(const Bins *bins, const BinScale *scale, size_t count)
{
    Split best = {.axis = -1};
    float least = INFINITY;
    bool inBlocks = count <= BLOCK_COST_LIMIT;
    for (int axis = 0; axis < 3; axis++) {
        if (scale->binsPerUnit[axis] == 0)
            continue;
        /* Sweep from above for what lies behind each border, then from below for the cost of each. */
        float costAbove[BIN_COUNT];
        size_t countAbove[BIN_COUNT];
        F4 min = f4Set(INFINITY), max = f4Set(-INFINITY);
        size_t number = 0;
        for (int b = scale->count - 1; b > 0; b--) {
            min = f4Min(min, bins->min[axis][b]);
            max = f4Max(max, bins->max[axis][b]);
            number += bins->counts[axis][b];
            costAbove[b] = number > 0 ? costOf(min, max, number, inBlocks) : 0;
            countAbove[b] = number;
        }
        min = f4Set(INFINITY);
        max = f4Set(-INFINITY);
        number = 0;
        for (int b = 1; b < scale->count; b++) {
            min = f4Min(min, bins->min[axis][b - 1]);
            max = f4Max(max, bins->max[axis][b - 1]);
            number += bins->counts[axis][b - 1];
            if (number == 0 || countAbove[b] == 0)
                continue;
            float cost = costOf(min, max, number, inBlocks) + costAbove[b];
            if (cost < least) {
                least = cost;
                best = (Split){axis, b};
            }
        }
    }
    return best;
}

/* Bring the items below the border to the front, and bound both sides. */
static void partition(BuildItem *items, const BinScale *scale, Split split, const Bins *bins, Range *low,
                      Range *high)
{
    int axis = split.axis;
    size_t i = low->first, j = high->end;
    for (;;) {
        for (; i < j; i++) {
            F4 middle = items[i].min + items[i].max;
            if (binOf(scale, middle)[axis] >= split.border)
                break;
            low->middleMin = f4Min(low->middleMin, middle);
            low->middleMax = f4Max(low->middleMax, middle);
        }
        for (; i < j; j--) {
            F4 middle = items[j - 1].min + items[j - 1].max;
            if (binOf(scale, middle)[axis] < split.border)
                break;
            high->middleMin = f4Min(high->middleMin, middle);
            high->middleMax = f4Max(high->middleMax, middle);
        }
        if (i >= j)
            break;
        BuildItem moved = items[i];
        items[i] = items[j - 1];
        items[j - 1] = moved;
    }
    low->end = high->first = i;
    for (int b = 0; b < scale->count; b++) {
        Range *side = b < split.border ? low : high;
        side->min = f4Min(side->min, bins->min[axis][b]);
        side->max = f4Max(side->max, bins->max[axis][b]);
    }
}

static void divide(BuildItem *items, const Range *range, int depth, Range *low, Range *high)
{
    *low = emptyRange(range->first, range->end);
    *high = emptyRange(range->first, range->end);
    if (depth < SAH_DEPTH_LIMIT) {
        Bins bins;
        BinScale scale = binScale(range);
        fillBins(items, range, &scale, &bins);
        Split split = bestSplit(&bins, &scale, rangeCount(range));
        if (split.axis >= 0) {
            partition(items, &scale, split, &bins, low, high);
            return;
        }
    }
    low->end = high->first = range->first + rangeCount(range) / 2;
    boundRange(items, low);
    boundRange(items, high);
}

/* ---- Nodes ---- */

/* The parts of a node: up to eight. */
typedef struct Parts {
    Range ranges[BVH_WIDTH];
    int count;
} Parts;

/* Divide the part of the largest surface, again and again, until there are `most` parts or all are blocks. */
static void divideParts(BuildItem *items, Parts *parts, int most, int depth)
{
    while (parts->count < most) {
        int largest = -1;
        float area = -1;
        for (int i = 0; i < parts->count; i++) {
            float own = halfArea(parts->ranges[i].min, parts->ranges[i].max);
            if (rangeCount(&parts->ranges[i]) > BVH_WIDTH && own > area) {
                largest = i;
                area = own;
            }
        }
        if (largest < 0)
            return;
        Range whole = parts->ranges[largest];
        divide(items, &whole, depth, &parts->ranges[largest], &parts->ranges[parts->count]);
        parts->count++;
    }
}

void setNodeChild(BvhNode *node, int child, const BuildItem *box, uint32_t reference)
{
    for (int axis = 0; axis < 3; axis++) {
        node->min[axis][child] = box != NULL ? box->min[axis] : INFINITY;
        node->max[axis][child] = box != NULL ? box->max[axis] : -INFINITY;
    }
    node->children[child] = box != NULL ? reference : CHILD_NONE;
}

static uint32_t newNode(BvhBuild *build, Reserve *reserve)
{
    if (reserve->node == reserve->nodeEnd) {
        reserve->node = atomic_fetch_add(build->nodesUsed, NODE_RESERVE);
        reserve->nodeEnd = reserve->node + NODE_RESERVE;
    }
    return reserve->node++;
}

static uint32_t buildLeaf(BvhBuild *build, const Range *range, Reserve *reserve)
{
    if (reserve->block == reserve->blockEnd) {
        reserve->block = atomic_fetch_add(&build->blocksUsed, BLOCK_RESERVE);
        reserve->blockEnd = reserve->block + BLOCK_RESERVE;
    }
    uint32_t block = reserve->block++;
    build->fill(build->compiled, block, build->items + range->first, rangeCount(range));
    return childReference(build->kind, block);
}

static uint32_t nodeOfParts(BvhBuild *build, const Parts *parts, Reserve *reserve)
{
    uint32_t number = newNode(build, reserve);
    BvhNode *node = &build->compiled->nodes[number];
    for (int i = 0; i < BVH_WIDTH; i++) {
        BuildItem box = {0};
        if (i < parts->count)
            box = (BuildItem){parts->ranges[i].min, parts->ranges[i].max};
        setNodeChild(node, i, i < parts->count ? &box : NULL, CHILD_NONE);
    }
    return number;
}

static uint32_t buildRange(BvhBuild *build, const Range *range, int depth, Reserve *reserve)
{
    if (rangeCount(range) <= BVH_WIDTH)
        return buildLeaf(build, range, reserve);
    if (rangeCount(range) >= CANCEL_POLL_COUNT && cancelRequested())
        return CHILD_NONE;
    Parts parts = {.ranges = {*range}, .count = 1};
    divideParts(build->items, &parts, BVH_WIDTH, depth);
    uint32_t number = nodeOfParts(build, &parts, reserve);
    for (int i = 0; i < parts.count; i++)
        build->compiled->nodes[number].children[i] = buildRange(build, &parts.ranges[i], depth + 1, reserve);
    return childReference(LEAF_NODE, number);
}

/* ---- The top of the tree, by several threads ---- */

enum {
    MOST_BRANCHES = BVH_WIDTH * BVH_WIDTH
};

/* A part of the tree that one thread builds whole. */
typedef struct Branch {
    Range range;
    int depth;
    uint32_t *reference; /* where to store what refers to it */
} Branch;

typedef struct Top {
    BvhBuild *build;
    Parts halves[2];
    Parts children[BVH_WIDTH];
    Branch branches[MOST_BRANCHES];
} Top;

static void divideHalf(void *context, size_t number)
{
    Top *top = context;
    divideParts(top->build->items, &top->halves[number], BVH_WIDTH / 2, 0);
}

static void divideChild(void *context, size_t number)
{
    Top *top = context;
    if (rangeCount(&top->children[number].ranges[0]) > BVH_WIDTH)
        divideParts(top->build->items, &top->children[number], BVH_WIDTH, 1);
}

static void buildBranch(void *context, size_t number)
{
    Top *top = context;
    Branch *branch = &top->branches[number];
    Reserve reserve = {0};
    *branch->reference = buildRange(top->build, &branch->range, branch->depth, &reserve);
}

static Status buildTop(BvhBuild *build, const Range *all, uint32_t *root)
{
    /* Divide the root: once, then each half into up to four. */
    Top top = {.build = build, .halves = {{.count = 1}, {.count = 1}}};
    divide(build->items, all, 0, &top.halves[0].ranges[0], &top.halves[1].ranges[0]);
    Status status = runTasks(2, build->threads, divideHalf, &top);
    if (!statusIsOk(&status))
        return status;
    Parts parts = {.count = 0};
    for (int h = 0; h < 2; h++)
        for (int i = 0; i < top.halves[h].count; i++)
            parts.ranges[parts.count++] = top.halves[h].ranges[i];

    /* Divide its children. */
    for (int i = 0; i < parts.count; i++)
        top.children[i] = (Parts){.ranges = {parts.ranges[i]}, .count = 1};
    status = runTasks((size_t)parts.count, build->threads, divideChild, &top);
    if (!statusIsOk(&status))
        return status;

    /* Make their nodes, and build all that hangs below. */
    Reserve reserve = {0};
    uint32_t number = nodeOfParts(build, &parts, &reserve);
    size_t branchCount = 0;
    for (int i = 0; i < parts.count; i++) {
        uint32_t *reference = &build->compiled->nodes[number].children[i];
        const Parts *own = &top.children[i];
        if (own->count == 1) {
            top.branches[branchCount++] = (Branch){own->ranges[0], 1, reference};
            continue;
        }
        uint32_t child = nodeOfParts(build, own, &reserve);
        *reference = childReference(LEAF_NODE, child);
        for (int j = 0; j < own->count; j++)
            top.branches[branchCount++] =
                (Branch){own->ranges[j], 2, &build->compiled->nodes[child].children[j]};
    }
    *root = childReference(LEAF_NODE, number);
    return runTasks(branchCount, build->threads, buildBranch, &top);
}

/* A node of fewer than eight children has only blocks below it and holds more than 8 primitives; so there are
 * at most n/9 of those, and with at most n blocks at most (n + n/9)/7 full ones. Threads leave some unused.
 */
size_t bvhNodeLimit(size_t count)
{
    return count / 9 + (count + count / 9) / 7 + 2 + NODE_RESERVE * (MOST_BRANCHES + 2);
}

size_t bvhBlockLimit(size_t count)
{
    return count + BLOCK_RESERVE * (MOST_BRANCHES + 1);
}

Status buildBvh(BvhBuild *build, uint32_t *root, BuildItem *box)
{
    Range all = emptyRange(0, build->count);
    boundRange(build->items, &all);
    *box = (BuildItem){all.min, all.max};
    if (rangeCount(&all) > CANCEL_POLL_COUNT)
        return buildTop(build, &all, root);
    Reserve reserve = {0};
    *root = buildRange(build, &all, 0, &reserve);
    return cancelRequested() ? statusInterrupted() : statusOk();
}
