/* polygon.h - cut a polygon into triangles. */
#ifndef ECLAIRAGE_SHAPES_POLYGON_H
#define ECLAIRAGE_SHAPES_POLYGON_H

#include "base/status.h"
#include "geometry.h"

#include <stddef.h>
#include <stdint.h>

enum {
    POLYGON_MAX_CORNERS = 10000
};

/* What cutPolygon works with; kept from one polygon to the next and freed by freePolygonCutter. */
typedef struct PolygonCutter {
    struct PlaneCorner *corners;
    size_t capacity;
} PolygonCutter;

/* Cut the polygon with these corners, 3 to POLYGON_MAX_CORNERS of them, into count - 2 triangles; each is
 * three indices below count, in the polygon's direction. Concave polygons are right; a convex one becomes a
 * fan round its first corner. One that crosses itself or is not flat is cut somehow, and all its edges are
 * still edges of triangles. Quadratic time at worst. triangles: room for count - 2.
 * STATUS_INTERRUPTED, or out of memory. */
Status cutPolygon(PolygonCutter *cutter, const Vector3D *corners, size_t count, uint32_t (*triangles)[3]);

void freePolygonCutter(PolygonCutter *cutter);

#endif
