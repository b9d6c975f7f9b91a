/* cut_outline.h - where a plane cuts an object: the outline of the cut as the path of an SVG.
 *
 * It works for every shape: of solids by asking on a grid which points are inside, of surfaces by rays that
 * run in the plane.
 */
#ifndef ECLAIRAGE_EXPLAIN_CUT_OUTLINE_H
#define ECLAIRAGE_EXPLAIN_CUT_OUTLINE_H

#include "base/text.h"
#include "geometry.h"
#include "shapes/shape.h"

#include <stdbool.h>

/* The plane of a drawing: from world space to its pixels. */
typedef struct DrawingPlane {
    Vector3D origin;    /* drawn at (originX, originY) */
    Vector3D right, up; /* of unit length, at right angles */
    Vector3D normal;
    double scale; /* pixels for a scene unit */
    double originX, originY;
    double left, top, width, height; /* the part that is seen, in pixels */
} DrawingPlane;

typedef struct DrawnPoint {
    double x, y; /* pixels, y down */
} DrawnPoint;

/* The point, projected onto the plane. */
DrawnPoint drawnPoint(const DrawingPlane *plane, Vector3D world);

/* Append a coordinate in pixels, to a tenth. */
void appendPixels(Text *text, double value);

/* What came out: nothing is cut, an area to be filled, or dots along a line. */
typedef enum CutKind {
    CUT_NOTHING,
    CUT_AREA,
    CUT_DOTS
} CutKind;

/* Append the data of a path, without the element round it; box gets the corners of what was drawn. */
CutKind appendCutPath(const DrawingPlane *plane, const Object *object, Text *path, DrawnPoint box[2]);

#endif
