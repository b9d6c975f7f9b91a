/* polygon.c - cut a polygon into triangles by clipping ears; see polygon.h.
 *
 * An ear is a convex corner whose triangle with its two neighbours has no other corner in it; every simple
 * polygon has two (Meisters 1975, "Polygons have ears"), so one after the other can be cut off. Only reflex
 * corners can lie in the triangle. The polygon is looked at in the coordinate plane that its normal
 * (Newell's: Sutherland, Sproull and Schumacker 1974) is steepest to. A hole
 * that is joined to the border by a pair of edges leaves ears with another corner in the same place as
 * one of theirs; so where no ear is free of others on its border, one that is free inside will do.
 */
#include "shapes/polygon.h"

#include "base/cancel.h"

#include <stdlib.h>

/* A corner in the plane, in a ring of those that are left. */
typedef struct PlaneCorner {
    double x, y;
    uint32_t previous, next;
    bool isReflex; /* or straight */
} PlaneCorner;

/* Twice the signed area of a triangle, above 0 where it turns left. */
static double turn(const PlaneCorner *a, const PlaneCorner *b, const PlaneCorner *c)
{
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

/* Look along the axis nearest to the normal so that the polygon goes round to the left. */
static void projectCorners(PlaneCorner *ring, const Vector3D *corners, size_t count)
{
    /* Sum the normal from the first corner, so that a polygon far away loses no digits. */
    Vector3D normal = {0, 0, 0};
    for (size_t i = 1; i + 1 < count; i++)
        normal = addVectors(
            normal, cross(subVectors(corners[i], corners[0]), subVectors(corners[i + 1], corners[0])));
    double nx = fabs(normal.x), ny = fabs(normal.y), nz = fabs(normal.z);
    for (size_t i = 0; i < count; i++) {
        Vector3D p = subVectors(corners[i], corners[0]);
        double x = p.x, y = p.y, toViewer = normal.z;
        if (nx >= ny && nx >= nz) {
            x = p.y;
            y = p.z;
            toViewer = normal.x;
        } else if (ny >= nz) {
            x = p.z;
            y = p.x;
            toViewer = normal.y;
        }
        ring[i] = (PlaneCorner){.x = toViewer < 0 ? -x : x,
                                .y = y,
                                .previous = (uint32_t)(i > 0 ? i - 1 : count - 1),
                                .next = (uint32_t)(i + 1 < count ? i + 1 : 0)};
    }
}

static void findWhetherReflex(PlaneCorner *ring, uint32_t corner)
{
    PlaneCorner *c = &ring[corner];
    c->isReflex = !(turn(&ring[c->previous], c, &ring[c->next]) > 0);
}

/* Whether the corner is convex and its triangle has no other corner in it or, if strict, on its border. */
static bool isEar(const PlaneCorner *ring, uint32_t corner, bool strict)
{
    const PlaneCorner *b = &ring[corner];
    if (b->isReflex)
        return false;
    const PlaneCorner *a = &ring[b->previous], *c = &ring[b->next];
    for (uint32_t i = c->next; i != b->previous; i = ring[i].next) {
        const PlaneCorner *p = &ring[i];
        if (!p->isReflex)
            continue;
        double ab = turn(a, b, p), bc = turn(b, c, p), ca = turn(c, a, p);
        if (strict ? ab >= 0 && bc >= 0 && ca >= 0 : ab > 0 && bc > 0 && ca > 0)
            return false;
    }
    return true;
}

Status cutPolygon(PolygonCutter *cutter, const Vector3D *corners, size_t count, uint32_t (*triangles)[3])
{
    if (count > cutter->capacity) {
        PlaneCorner *larger = realloc(cutter->corners, 2 * count * sizeof *larger);
        if (larger == NULL)
            return statusOutOfMemory();
        cutter->corners = larger;
        cutter->capacity = 2 * count;
    }
    PlaneCorner *ring = cutter->corners;
    projectCorners(ring, corners, count);
    for (uint32_t i = 0; i < count; i++)
        findWhetherReflex(ring, i);

    /* Go round the ring and cut off ears. Without one in a whole round, ask for less: corners may lie on
     * the border of an ear, then it need only be convex, then nothing. */
    enum {
        STRICT,
        LOOSE,
        CONVEX,
        ANY
    } demand = STRICT;
    uint32_t corner = 1;
    size_t sinceLast = 0, cut = 0;
    for (size_t left = count; left > 3;) {
        if (sinceLast == left) {
            demand++;
            sinceLast = 0;
        }
        PlaneCorner *c = &ring[corner];
        bool found = demand == ANY      ? true
                     : demand == CONVEX ? !c->isReflex
                                        : isEar(ring, corner, demand == STRICT);
        if (!found) {
            corner = c->next;
            sinceLast++;
            continue;
        }
        triangles[cut][0] = c->previous;
        triangles[cut][1] = corner;
        triangles[cut++][2] = c->next;
        ring[c->previous].next = c->next;
        ring[c->next].previous = c->previous;
        findWhetherReflex(ring, c->previous);
        findWhetherReflex(ring, c->next);
        corner = c->next;
        demand = STRICT;
        sinceLast = 0;
        left--;
        if (left % 256 == 0 && cancelRequested())
            return statusInterrupted();
    }
    triangles[cut][0] = ring[corner].previous;
    triangles[cut][1] = corner;
    triangles[cut][2] = ring[corner].next;
    return statusOk();
}

void freePolygonCutter(PolygonCutter *cutter)
{
    free(cutter->corners);
    *cutter = (PolygonCutter){0};
}
