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
#include "shapes/cone.h"
#include "shapes/csg.h"
#include "shapes/disc.h"
#include "shapes/intersection.h"
#include "shapes/mesh.h"
#include "shapes/plane.h"
#include "shapes/sphere.h"
#include "shapes/torus.h"
#include "shapes/triangle.h"

#include <stdbool.h>

/* X(kind, Type, name): name is the key in a scene file and the prefix of the shape's operations. */
#define SHAPES(X)                                                                                            \
    X(SHAPE_SPHERE, Sphere, sphere)                                                                          \
    X(SHAPE_CUBE, Cube, cube)                                                                                \
    X(SHAPE_BOX, Box, box)                                                                                   \
    X(SHAPE_PLANE, Plane, plane)                                                                             \
    X(SHAPE_TRIANGLE, Triangle, triangle)                                                                    \
    X(SHAPE_CONE, Cone, cone)                                                                                \
    X(SHAPE_DISC, Disc, disc)                                                                                \
    X(SHAPE_TORUS, Torus, torus)                                                                             \
    X(SHAPE_MESH, Mesh, mesh)                                                                                \
    X(SHAPE_CSG, Csg, csg)

typedef enum ShapeKind {
#define X(kind, Type, name) kind,
    SHAPES(X)
#undef X
    SHAPE_COUNT
} ShapeKind;

typedef struct Object {
    ShapeKind kind;
    int line;                   /* where the scene file has it, from 1; 0: made by a program */
    bool noShadow;              /* it blocks no light */
    const Transform *transform; /* from object to world space, or NULL where they are the same; not owned */
    union {
        Material material;
#define X(kind, Type, name) Type name;
        SHAPES(X)
#undef X
    };
} Object;

/* What a shape can do. All of it is in the object's own space, before its transform. */
typedef struct Shape {
    const char *name; /* the key in a scene file */

    /* Report every hit at t > 0, in any order. ray: of unit direction. A shape that looks at more than a few
     * surfaces may leave out what is farther than sink->nearest, unless sink->keepAll. */
    void (*intersect)(const Object *object, const Ray *ray, HitSink *sink);

    /* The unit normal at a hit, on either side; position is the hit's. */
    Vector3D (*normal)(const Object *object, const Hit *hit, Vector3D position);

    /* The unit normal of the surface itself, where normal() is an interpolated one; NULL where they are the
     * same. Rays that leave the surface step off it along this one. */
    Vector3D (*flatNormal)(const Object *object, const Hit *hit);

    /* Whether the point is strictly inside; false for a shape without an inside. */
    bool (*contains)(const Object *object, Vector3D point);

    /* Whether it divides space into inside and outside, so that it can be a part of CSG. */
    bool (*hasInside)(const Object *object);

    /* The smallest box round it, or a little larger; false for a shape without end, and then bounds is
     * untouched. */
    bool (*bounds)(const Object *object, Bounds *bounds);

    /* The largest magnitude among the numbers its hits are computed from: rounding errors of a hit are
     * in proportion to it. */
    double (*magnitude)(const Object *object);

    /* POV-Ray's words for it up to the material, without the closing brace, e.g. "sphere { <0, 0, -5>,
     * 1.5"; all lengths are multiplied by scale. */
    void (*writePov)(const Object *object, double scale, Text *pov);

    /* Free what the object owns beside itself; NULL where there is nothing. */
    void (*release)(Object *object);
} Shape;

#define X(kind, Type, name) extern const Shape name##Shape;
SHAPES(X)
#undef X

/* The operations of the object's shape. */
const Shape *objectShape(const Object *object);

/* Free what the object owns beside itself. */
void releaseObject(Object *object);

/* For shapes that always, or never, have an inside; and without one, for contains. */
bool alwaysTrue(const Object *object);
bool alwaysFalse(const Object *object);
bool containsNothing(const Object *object, Vector3D point);

/* The following are in world space. */

/* The ray in an object's own space, of unit direction again: distances there are world distances divided by
 * *scale. */
Ray rayInObjectSpace(const Transform *transform, const Ray *ray, double *scale);

/* Report every hit of the ray (of unit direction) at t > sink->above. */
void intersectObject(const Object *object, const Ray *ray, HitSink *sink);

/* The unit normal at a hit on hit->object, turned to the ray's side. */
Vector3D objectNormal(const Ray *ray, const Hit *hit, Vector3D position);

/* The unit normal of the surface itself at a hit, on either side; normal is what objectNormal gave. */
Vector3D objectFlatNormal(const Hit *hit, Vector3D normal);

/* Whether the point is strictly inside. */
bool objectContains(const Object *object, Vector3D point);

/* A box round it; false for a shape without end. */
bool objectBounds(const Object *object, Bounds *bounds);

/* How large the numbers are that a hit of this ray at this distance is computed from: its rounding error is
 * some 2^-50 of it. */
double hitMagnitude(const Object *object, const Ray *ray, double distance);

/* What there is to know of a hit of the ray. */
Intersection intersectionAt(const Ray *ray, const Hit *hit);

/* Whether the ray meets the object at t > 0; on a miss the intersection is untouched. */
bool intersectsObject(const Ray *ray, const Object *object, Intersection *intersection);

/* The point in the object's own space, where its pattern is. */
Vector3D objectSpacePoint(const Object *object, Vector3D worldPoint);

/* The material's pattern, if it has one, worked out at the point. */
Material materialAt(const Object *object, Vector3D worldPoint);

/* Append "<x, y, z>", each coordinate times scale, in full precision. */
void textAppendPovVector(Text *pov, Vector3D v, double scale);

/* Append one number in POV-Ray's spelling, in full precision. */
void textAppendPovNumber(Text *pov, double value);

#endif
