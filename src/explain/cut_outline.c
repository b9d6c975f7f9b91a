/* cut_outline.c - where a plane cuts an object; see cut_outline.h.
 *
 * Solids: marching squares (Lorensen and Cline 1987, in two dimensions). Points of a grid are inside or not;
 * where an edge of the grid joins one of each the outline crosses it, and the place is found by halving. In
 * each square the crossings are joined in pairs. The grid's border counts as outside, so every line closes.
 */
#include "explain/cut_outline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    CELLS = 110,  /* along each side of the grid */
    HALVINGS = 12 /* of an edge: a few thousandths of a pixel */
};

DrawnPoint drawnPoint(const DrawingPlane *plane, Vector3D world)
{
    Vector3D d = subVectors(world, plane->origin);
    return (DrawnPoint){plane->originX + dot(d, plane->right) * plane->scale,
                        plane->originY - dot(d, plane->up) * plane->scale};
}

/* The point of the plane at a place of the drawing. */
static Vector3D worldPointAt(const DrawingPlane *plane, DrawnPoint point)
{
    double x = (point.x - plane->originX) / plane->scale, y = (plane->originY - point.y) / plane->scale;
    return addVectors(plane->origin, addVectors(multVector(plane->right, x), multVector(plane->up, y)));
}

void appendPixels(Text *text, double value)
{
    textAppendFixed(text, isfinite(value) ? fmax(-1e5, fmin(1e5, value)) : 0, 1);
}

static void appendPoint(Text *path, const char *command, DrawnPoint point)
{
    textAppend(path, command);
    appendPixels(path, point.x);
    textAppend(path, " ");
    appendPixels(path, point.y);
}

/* The part of the drawing that the object can be in; false: none. */
static bool findPart(const DrawingPlane *plane, const Object *object, DrawnPoint part[2])
{
    DrawnPoint low = {plane->left, plane->top};
    DrawnPoint high = {plane->left + plane->width, plane->top + plane->height};
    Bounds bounds;
    if (objectBounds(object, &bounds)) {
        DrawnPoint min = {INFINITY, INFINITY}, max = {-INFINITY, -INFINITY};
        double nearest = INFINITY, farthest = -INFINITY;
        for (int corner = 0; corner < 8; corner++) {
            Vector3D p = createVector(corner & 1 ? bounds.max.x : bounds.min.x,
                                      corner & 2 ? bounds.max.y : bounds.min.y,
                                      corner & 4 ? bounds.max.z : bounds.min.z);
            DrawnPoint drawn = drawnPoint(plane, p);
            double away = dot(subVectors(p, plane->origin), plane->normal);
            min = (DrawnPoint){fmin(min.x, drawn.x), fmin(min.y, drawn.y)};
            max = (DrawnPoint){fmax(max.x, drawn.x), fmax(max.y, drawn.y)};
            nearest = fmin(nearest, away);
            farthest = fmax(farthest, away);
        }
        if (nearest > 0 || farthest < 0)
            return false;
        low = (DrawnPoint){fmax(low.x, min.x - 1), fmax(low.y, min.y - 1)};
        high = (DrawnPoint){fmin(high.x, max.x + 1), fmin(high.y, max.y + 1)};
    }
    part[0] = low;
    part[1] = high;
    return low.x < high.x && low.y < high.y;
}

/* ---- Solids ---- */

typedef struct Grid {
    const DrawingPlane *plane;
    const Object *object;
    DrawnPoint low;
    double stepX, stepY;
    bool inside[CELLS + 1][CELLS + 1]; /* by row and column */
    /* Of each edge of the grid that is crossed: its one or two neighbours on the outline. Edge 2 (row *
     * (CELLS + 1) + column) goes to the right, the next one down. */
    int links[2 * (CELLS + 1) * (CELLS + 1)][2];
    bool done[2 * (CELLS + 1) * (CELLS + 1)];
} Grid;

static DrawnPoint gridPoint(const Grid *grid, int row, int column)
{
    return (DrawnPoint){grid->low.x + grid->stepX * column, grid->low.y + grid->stepY * row};
}

static int edgeNumber(int row, int column, bool isDown)
{
    return 2 * (row * (CELLS + 1) + column) + isDown;
}

/* Where the outline crosses an edge. */
static DrawnPoint crossingOf(const Grid *grid, int edge)
{
    int row = edge / 2 / (CELLS + 1), column = edge / 2 % (CELLS + 1);
    DrawnPoint a = gridPoint(grid, row, column);
    DrawnPoint b = edge % 2 != 0 ? gridPoint(grid, row + 1, column) : gridPoint(grid, row, column + 1);
    bool aInside = grid->inside[row][column];
    for (int i = 0; i < HALVINGS; i++) {
        DrawnPoint middle = {(a.x + b.x) / 2, (a.y + b.y) / 2};
        if (objectContains(grid->object, worldPointAt(grid->plane, middle)) == aInside)
            a = middle;
        else
            b = middle;
    }
    return (DrawnPoint){(a.x + b.x) / 2, (a.y + b.y) / 2};
}

static void linkEdges(Grid *grid, int a, int b)
{
    grid->links[a][grid->links[a][0] >= 0] = b;
    grid->links[b][grid->links[b][0] >= 0] = a;
}

/* Join the crossings of one square: above, right, below, left in turn; of four the first two and the others.
 */
static void joinSquare(Grid *grid, int row, int column)
{
    const int edges[4] = {edgeNumber(row, column, false), edgeNumber(row, column + 1, true),
                          edgeNumber(row + 1, column, false), edgeNumber(row, column, true)};
    const bool corners[5] = {grid->inside[row][column], grid->inside[row][column + 1],
                             grid->inside[row + 1][column + 1], grid->inside[row + 1][column],
                             grid->inside[row][column]};
    int crossed[4], count = 0;
    for (int i = 0; i < 4; i++)
        if (corners[i] != corners[i + 1])
            crossed[count++] = edges[i];
    for (int i = 0; i + 1 < count; i += 2)
        linkEdges(grid, crossed[i], crossed[i + 1]);
}

/* Walk along the outline from an edge until it closes. */
static void appendLoop(Grid *grid, int start, Text *path, DrawnPoint box[2])
{
    const char *command = "M";
    for (int edge = start; edge >= 0 && !grid->done[edge];) {
        grid->done[edge] = true;
        DrawnPoint point = crossingOf(grid, edge);
        box[0] = (DrawnPoint){fmin(box[0].x, point.x), fmin(box[0].y, point.y)};
        box[1] = (DrawnPoint){fmax(box[1].x, point.x), fmax(box[1].y, point.y)};
        appendPoint(path, command, point);
        command = "L";
        int next = grid->links[edge][0];
        if (next < 0 || grid->done[next])
            next = grid->links[edge][1];
        edge = next;
    }
    textAppend(path, "Z");
}

static CutKind appendSolid(const DrawingPlane *plane, const Object *object, const DrawnPoint part[2],
                           Text *path, DrawnPoint box[2])
{
    Grid *grid = malloc(sizeof *grid);
    if (grid == NULL) {
        path->failed = true;
        return CUT_NOTHING;
    }
    *grid = (Grid){.plane = plane,
                   .object = object,
                   .stepX = (part[1].x - part[0].x) / (CELLS - 2),
                   .stepY = (part[1].y - part[0].y) / (CELLS - 2)};
    grid->low = (DrawnPoint){part[0].x - grid->stepX, part[0].y - grid->stepY};
    memset(grid->links, -1, sizeof grid->links);
    for (int row = 1; row < CELLS; row++)
        for (int column = 1; column < CELLS; column++)
            grid->inside[row][column] =
                objectContains(object, worldPointAt(plane, gridPoint(grid, row, column)));
    for (int row = 0; row < CELLS; row++)
        for (int column = 0; column < CELLS; column++)
            joinSquare(grid, row, column);
    size_t before = path->length;
    for (int edge = 0; edge < 2 * (CELLS + 1) * (CELLS + 1); edge++)
        if (grid->links[edge][0] >= 0 && !grid->done[edge])
            appendLoop(grid, edge, path, box);
    free(grid);
    return path->length > before ? CUT_AREA : CUT_NOTHING;
}

/* ---- Surfaces ---- */

/* Dots where a ray in the plane meets the surface. */
static void appendHits(const DrawingPlane *plane, const Object *object, DrawnPoint from, DrawnPoint to,
                       Text *path, DrawnPoint box[2])
{
    Vector3D start = worldPointAt(plane, from), way = subVectors(worldPointAt(plane, to), start);
    Ray ray = createRay(start, normalize(way));
    HitSink sink = createHitSink(0, true);
    intersectObject(object, &ray, &sink);
    for (size_t i = 0; i < sink.count; i++) {
        if (!(sink.all[i].distance <= norm(way)))
            continue;
        DrawnPoint point = drawnPoint(plane, pointOnRay(&ray, sink.all[i].distance));
        box[0] = (DrawnPoint){fmin(box[0].x, point.x), fmin(box[0].y, point.y)};
        box[1] = (DrawnPoint){fmax(box[1].x, point.x), fmax(box[1].y, point.y)};
        appendPoint(path, "M", point);
        textAppend(path, "h0.1");
    }
    path->failed = path->failed || sink.outOfMemory;
    freeHitSink(&sink);
}

static CutKind appendSurface(const DrawingPlane *plane, const Object *object, const DrawnPoint part[2],
                             Text *path, DrawnPoint box[2])
{
    size_t before = path->length;
    for (int i = 0; i <= CELLS; i++) {
        double t = (i + 0.5) / (CELLS + 1);
        double x = part[0].x + t * (part[1].x - part[0].x), y = part[0].y + t * (part[1].y - part[0].y);
        appendHits(plane, object, (DrawnPoint){part[0].x - 1, y}, (DrawnPoint){part[1].x + 1, y}, path, box);
        appendHits(plane, object, (DrawnPoint){x, part[0].y - 1}, (DrawnPoint){x, part[1].y + 1}, path, box);
    }
    return path->length > before ? CUT_DOTS : CUT_NOTHING;
}

CutKind appendCutPath(const DrawingPlane *plane, const Object *object, Text *path, DrawnPoint box[2])
{
    DrawnPoint part[2];
    box[0] = (DrawnPoint){INFINITY, INFINITY};
    box[1] = (DrawnPoint){-INFINITY, -INFINITY};
    if (!findPart(plane, object, part))
        return CUT_NOTHING;
    return objectShape(object)->hasInside(object) ? appendSolid(plane, object, part, path, box)
                                                  : appendSurface(plane, object, part, path, box);
}
