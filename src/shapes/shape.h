/* shape.h - what every shape can do, found from one table.
 *
 * An Object is one shape with its material. SHAPES lists the kinds; from that list come the enum, the
 * union and the table of operations, so that a new shape is its own file and a line here.
 * Invariant: every shape's struct begins with its Material, so object->material is valid for all.
 */
#ifndef ECLAIRAGE_SHAPES_SHAPE_H
#define ECLAIRAGE_SHAPES_SHAPE_H

#include "base/text.h"
#include "shapes/box.h"
#include "shapes/intersection.h"
#include "shapes/plane.h"
#include "shapes/sphere.h"

#include <stdbool.h>

/* X(kind, Type, name): name is the key in a scene file and the prefix of the shape's operations. */
#define SHAPES(X)                                                                                            \
    X(SHAPE_SPHERE, Sphere, sphere)                                                                          \
    X(SHAPE_CUBE, Cube, cube)                                                                                \
    X(SHAPE_BOX, Box, box)                                                                                   \
    X(SHAPE_PLANE, Plane, plane)

typedef enum ShapeKind {
#define X(kind, Type, name) kind,
    SHAPES(X)
#undef X
    SHAPE_COUNT
} ShapeKind;

typedef struct Object {
    ShapeKind kind;
    int line; /* where the scene file has it, from 1; 0: made by a program */
    union {
        Material material;
#define X(kind, Type, name) Type name;
        SHAPES(X)
#undef X
    };
} Object;

typedef struct Shape {
    const char *name; /* the key in a scene file */

    /* The distance of the nearest hit at t > 0; INFINITY on a miss. */
    double (*distance)(const Object *object, const Ray *ray);

    /* The unit normal where distance() said, turned to the ray's side; position is pointOnRay there. */
    Vector3D (*normal)(const Object *object, const Ray *ray, Vector3D position);

    /* Whether the point is strictly inside. */
    bool (*contains)(const Object *object, Vector3D point);

    /* The smallest box round it; false for a shape without end, and then bounds is untouched. */
    bool (*bounds)(const Object *object, Bounds *bounds);

    /* The largest magnitude among the numbers its hits are computed from: rounding errors of a hit are
     * in proportion to it. */
    double (*magnitude)(const Object *object);

    /* POV-Ray's words for it up to the material, without the closing brace, e.g. "sphere { <0, 0, -5>,
     * 1.5"; all lengths are multiplied by scale. */
    void (*writePov)(const Object *object, double scale, Text *pov);
} Shape;

#define X(kind, Type, name) extern const Shape name##Shape;
SHAPES(X)
#undef X

/* The operations of the object's shape. */
const Shape *objectShape(const Object *object);

/* Whether the ray meets the object at t > 0; on a miss the intersection is untouched. */
bool intersectsObject(const Ray *ray, const Object *object, Intersection *intersection);

/* Append "<x, y, z>", each coordinate times scale, in full precision. */
void textAppendPovVector(Text *pov, Vector3D v, double scale);

/* Append one number in POV-Ray's spelling, in full precision. */
void textAppendPovNumber(Text *pov, double value);

#endif
