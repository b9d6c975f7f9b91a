/* mesh_tree.c - a tree of boxes round triangles: its building, and a ray's walk through it; see mesh_build.h.
 *
 * Built from the top by the surface area heuristic over bins (Wald 2007, "On fast construction of SAH-based
 * bounding volume hierarchies", section 3). Nodes lie in depth-first order:
 *
 *     root | first child, and all below it | second child, and all below it
 *
 * Invariant: a box contains all triangles below it. The walk makes boxes larger still, by more than the
 * rounding errors of box test and triangle test together (Ize 2013, "Robust BVH ray traversal", JCGT 2(2)),
 * so what the triangle test would find is never lost.
 */
#include "base/cancel.h"
#include "shapes/mesh_build.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

enum {
    BIN_COUNT = 16,
    LEAF_LIMIT = 8,          /* more triangles are always divided */
    SAH_DEPTH_LIMIT = 40,    /* below it halves are taken as they lie, so the depth stays limited */
    CANCEL_POLL_COUNT = 4096 /* nodes of fewer triangles do not look at cancelRequested */
};

/* The cost of a step down the tree, in tests of a triangle. */
static const double STEP_COST = 1.0;

/* ---- Building ---- */

/* A box while the tree is built; empty where min is above max. */
typedef struct Box3f {
    float min[3], max[3];
} Box3f;

typedef struct BuildItem {
    Box3f box;
    uint32_t triangle;
} BuildItem;

typedef struct TreeBuilder {
    BuildItem *items;
    MeshNode *nodes;
    size_t nodeCount;
    bool cancelled;
} TreeBuilder;

static const Box3f emptyBox = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

/* The largest float at most x, and the smallest at least x. */
static float roundDown(double x)
{
    float f = (float)x;
    return (double)f > x ? nextafterf(f, -INFINITY) : f;
}

static float roundUp(double x)
{
    float f = (float)x;
    return (double)f < x ? nextafterf(f, INFINITY) : f;
}

static void growBox(Box3f *box, const Box3f *by)
{
    for (int k = 0; k < 3; k++) {
        box->min[k] = by->min[k] < box->min[k] ? by->min[k] : box->min[k];
        box->max[k] = by->max[k] > box->max[k] ? by->max[k] : box->max[k];
    }
}

/* Half its surface; 0 where it is empty. */
static double boxArea(const Box3f *box)
{
    double size[3];
    for (int k = 0; k < 3; k++)
        size[k] = fmax(0, (double)box->max[k] - (double)box->min[k]);
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

/* Twice the middle of the box. */
static double middleOf(const BuildItem *item, int axis)
{
    return (double)item->box.min[axis] + (double)item->box.max[axis];
}

/* Where to divide: triangles whose middle lies in a bin below this one go to the first child. */
typedef struct Split {
    int axis, bin;
    double low, binsPerUnit; /* where the first bin begins, along the axis */
    double cost;             /* INFINITY: there is none */
} Split;

static int binOf(const Split *split, const BuildItem *item)
{
    double bin = (middleOf(item, split->axis) - split->low) * split->binsPerUnit;
    return bin < BIN_COUNT - 1 ? (int)bin : BIN_COUNT - 1;
}

/* The best division along one axis. */
static Split splitAlong(const BuildItem *items, size_t count, int axis)
{
    Split split = {.axis = axis, .low = INFINITY, .cost = INFINITY};
    double high = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        split.low = fmin(split.low, middleOf(&items[i], axis));
        high = fmax(high, middleOf(&items[i], axis));
    }
    split.binsPerUnit = BIN_COUNT / (high - split.low);
    if (!(high > split.low) || !isfinite(split.binsPerUnit) || !(split.binsPerUnit > 0))
        return split;

    /* Put the triangles into bins. */
    Box3f boxes[BIN_COUNT];
    size_t counts[BIN_COUNT] = {0};
    for (int b = 0; b < BIN_COUNT; b++)
        boxes[b] = emptyBox;
    for (size_t i = 0; i < count; i++) {
        int b = binOf(&split, &items[i]);
        growBox(&boxes[b], &items[i].box);
        counts[b]++;
    }

    /* Sweep from above for what lies behind each border, then from below for the cost of each. */
    double costAbove[BIN_COUNT];
    Box3f box = emptyBox;
    size_t number = 0;
    for (int b = BIN_COUNT - 1; b > 0; b--) {
        growBox(&box, &boxes[b]);
        number += counts[b];
        costAbove[b] = number > 0 ? boxArea(&box) * (double)number : INFINITY;
    }
    box = emptyBox;
    number = 0;
    for (int b = 1; b < BIN_COUNT; b++) {
        growBox(&box, &boxes[b - 1]);
        number += counts[b - 1];
        double cost = number > 0 ? boxArea(&box) * (double)number + costAbove[b] : INFINITY;
        if (cost < split.cost) {
            split.cost = cost;
            split.bin = b;
        }
    }
    return split;
}

/* Bring those of the first child to the front; returns how many they are. */
static size_t partition(BuildItem *items, size_t count, const Split *split)
{
    size_t front = 0;
    for (size_t i = 0; i < count; i++)
        if (binOf(split, &items[i]) < split->bin) {
            BuildItem moved = items[i];
            items[i] = items[front];
            items[front++] = moved;
        }
    return front;
}

static void buildNode(TreeBuilder *builder, size_t first, size_t count, int depth)
{
    BuildItem *items = builder->items + first;
    size_t index = builder->nodeCount++;
    MeshNode *node = &builder->nodes[index];
    Box3f box = emptyBox;
    for (size_t i = 0; i < count; i++)
        growBox(&box, &items[i].box);
    memcpy(node->min, box.min, sizeof node->min);
    memcpy(node->max, box.max, sizeof node->max);
    node->first = (uint32_t)first;
    node->count = (uint32_t)count;
    if (count >= CANCEL_POLL_COUNT && cancelRequested())
        builder->cancelled = true;
    if (count == 1 || builder->cancelled)
        return;

    /* Find the best of the three axes; a leaf may still be cheaper. */
    Split best = {.cost = INFINITY};
    if (depth < SAH_DEPTH_LIMIT)
        for (int axis = 0; axis < 3; axis++) {
            Split split = splitAlong(items, count, axis);
            if (split.cost < best.cost)
                best = split;
        }
    double area = boxArea(&box);
    if (count <= LEAF_LIMIT && !(best.cost + STEP_COST * area < area * (double)count))
        return;

    /* Divide; where all middles are in one place, any halves will do. */
    size_t front = best.cost < INFINITY ? partition(items, count, &best) : count / 2;
    node->count = 0;
    buildNode(builder, first, front, depth + 1);
    node->first = (uint32_t)builder->nodeCount;
    buildNode(builder, first + front, count - front, depth + 1);
}

/* Renumber the vertices in the order in which the triangles now use them: neighbours lie together. */
static bool sortVertices(MeshData *mesh)
{
    Vector3D *sorted = malloc(mesh->vertexCount * sizeof *sorted);
    uint32_t *newNumber = calloc(mesh->vertexCount, sizeof *newNumber);
    if (sorted == NULL || newNumber == NULL) {
        free(sorted);
        free(newNumber);
        return false;
    }
    uint32_t count = 0;
    for (size_t i = 0; i < 3 * mesh->triangleCount; i++) {
        uint32_t *corner = &mesh->triangles[i / 3].vertices[i % 3];
        if (newNumber[*corner] == 0) {
            sorted[count] = mesh->vertices[*corner];
            newNumber[*corner] = ++count;
        }
        *corner = newNumber[*corner] - 1;
    }
    free(newNumber);
    free(mesh->vertices);
    mesh->vertices = sorted;
    mesh->vertexCount = count;
    return true;
}

Status buildMeshTree(MeshData *mesh)
{
    size_t count = mesh->triangleCount;
    TreeBuilder builder = {.items = malloc(count * sizeof *builder.items),
                           .nodes = malloc((2 * count - 1) * sizeof *builder.nodes)};
    MeshTriangle *sorted = malloc(count * sizeof *sorted);
    if (builder.items == NULL || builder.nodes == NULL || sorted == NULL) {
        free(builder.items);
        free(builder.nodes);
        free(sorted);
        return statusOutOfMemory();
    }

    /* Find the box of each triangle and of all, and the mean edge. */
    Bounds *all = &mesh->bounds;
    *all = (Bounds){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    double edges = 0;
    for (size_t i = 0; i < count; i++) {
        Vector3D p[3];
        meshCorners(mesh, i, p);
        for (int j = 0; j < 3; j++)
            edges += norm(subVectors(p[(j + 1) % 3], p[j]));
        Vector3D low = createVector(fmin(p[0].x, fmin(p[1].x, p[2].x)), fmin(p[0].y, fmin(p[1].y, p[2].y)),
                                    fmin(p[0].z, fmin(p[1].z, p[2].z)));
        Vector3D high = createVector(fmax(p[0].x, fmax(p[1].x, p[2].x)), fmax(p[0].y, fmax(p[1].y, p[2].y)),
                                     fmax(p[0].z, fmax(p[1].z, p[2].z)));
        builder.items[i] = (BuildItem){{{roundDown(low.x), roundDown(low.y), roundDown(low.z)},
                                        {roundUp(high.x), roundUp(high.y), roundUp(high.z)}},
                                       (uint32_t)i};
        all->min = createVector(fmin(all->min.x, low.x), fmin(all->min.y, low.y), fmin(all->min.z, low.z));
        all->max = createVector(fmax(all->max.x, high.x), fmax(all->max.y, high.y), fmax(all->max.z, high.z));
    }

    mesh->meanEdge = edges / (3 * (double)count);

    /* Build, and put the triangles in the order of the leaves. */
    buildNode(&builder, 0, count, 0);
    for (size_t i = 0; i < count; i++)
        sorted[i] = mesh->triangles[builder.items[i].triangle];
    free(builder.items);
    free(mesh->triangles);
    mesh->triangles = sorted;
    free(mesh->nodes);
    MeshNode *smaller = realloc(builder.nodes, builder.nodeCount * sizeof *smaller);
    mesh->nodes = smaller != NULL ? smaller : builder.nodes;
    mesh->nodeCount = builder.nodeCount;
    if (builder.cancelled)
        return statusInterrupted();
    return sortVertices(mesh) ? statusOk() : statusOutOfMemory();
}

/* ---- The walk of a ray ---- */

/* A ray made ready for many boxes. */
typedef struct BoxRay {
    double inverse[3];                  /* 1 / direction */
    double nearOrigin[3], farOrigin[3]; /* the origin, moved by the margin for the two planes of a slab */
    bool isNegative[3];                 /* the ray goes down this axis */
} BoxRay;

static BoxRay createBoxRay(const MeshData *mesh, const Ray *ray)
{
    /* Both tests begin with the difference of a coordinate and the origin's, and make an error of a few
     * units in the last place of it; 16 are more than enough. */
    double size = largestCoordinate(ray->origin) +
                  fmax(largestCoordinate(mesh->bounds.min), largestCoordinate(mesh->bounds.max));
    double margin = 16 * DBL_EPSILON * size;
    BoxRay boxRay;
    for (int k = 0; k < 3; k++) {
        double origin = coordinateOf(ray->origin, k), direction = coordinateOf(ray->direction, k) + 0.0;
        boxRay.isNegative[k] = direction < 0;
        boxRay.inverse[k] = 1 / direction;
        boxRay.nearOrigin[k] = direction < 0 ? origin - margin : origin + margin;
        boxRay.farOrigin[k] = direction < 0 ? origin + margin : origin - margin;
    }
    return boxRay;
}

/* Where the ray enters the box, 0 from inside; INFINITY where it misses it up to the limit. 0 times
 * INFINITY, a ray along a face, is NAN and fails each comparison: the slab plays no part. */
static double enterBox(const MeshNode *node, const BoxRay *ray, double limit)
{
    double entry = 0, exit = limit;
    for (int k = 0; k < 3; k++) {
        double nearPlane = (double)(ray->isNegative[k] ? node->max[k] : node->min[k]);
        double farPlane = (double)(ray->isNegative[k] ? node->min[k] : node->max[k]);
        double t1 = (nearPlane - ray->nearOrigin[k]) * ray->inverse[k];
        double t2 = (farPlane - ray->farOrigin[k]) * ray->inverse[k];
        entry = t1 > entry ? t1 : entry;
        exit = t2 < exit ? t2 : exit;
    }
    return entry <= exit ? entry : INFINITY;
}

void walkMesh(const MeshData *mesh, const Ray *ray, const double *limit, MeshVisitor visit, void *context)
{
    ShearedRay sheared = shearRay(ray);
    BoxRay boxRay = createBoxRay(mesh, ray);
    struct {
        size_t node;
        double entry;
    } stack[MESH_TREE_MAX_DEPTH];
    int waiting = 0;

    size_t index = 0;
    double entry = enterBox(&mesh->nodes[0], &boxRay, *limit);
    for (;;) {
        if (entry <= *limit && entry < INFINITY) {
            const MeshNode *node = &mesh->nodes[index];
            if (node->count == 0) {
                /* Go on with the nearer child; the other one waits. */
                size_t nearChild = index + 1, farChild = node->first;
                double nearEntry = enterBox(&mesh->nodes[nearChild], &boxRay, *limit);
                double farEntry = enterBox(&mesh->nodes[farChild], &boxRay, *limit);
                if (farEntry < nearEntry) {
                    size_t child = nearChild;
                    nearChild = farChild;
                    farChild = child;
                    double other = nearEntry;
                    nearEntry = farEntry;
                    farEntry = other;
                }
                if (farEntry < INFINITY) {
                    stack[waiting].node = farChild;
                    stack[waiting++].entry = farEntry;
                }
                index = nearChild;
                entry = nearEntry;
                continue;
            }
            /* Test the triangles of a leaf. */
            for (size_t i = node->first; i < (size_t)node->first + node->count; i++) {
                Vector3D p[3];
                TriangleHit hit;
                meshCorners(mesh, i, p);
                if (intersectTriangle(&sheared, p[0], p[1], p[2], &hit))
                    visit(context, i, &hit);
            }
        }
        if (waiting == 0)
            return;
        index = stack[--waiting].node;
        entry = stack[waiting].entry;
    }
}
