/* random_shapes.h - shapes at random, and what is known of them apart from their own code.
 *
 * The same numbers everywhere: the generator is xorshift64* (Vigna 2016, "An experimental exploration of
 * Marsaglia's xorshift generators, scrambled").
 */
#ifndef ECLAIRAGE_TESTS_RANDOM_SHAPES_H
#define ECLAIRAGE_TESTS_RANDOM_SHAPES_H

#include "shapes/shape.h"

/* In 0..1, low..high, and each coordinate in -size..size. */
double randomUnit(void);
double randomIn(double low, double high);
Vector3D randomVector(double size);

/* Of unit length, all directions alike. */
Vector3D randomDirection(void);

Ray rayFromTo(Vector3D from, Vector3D to);

/* Not SHAPE_MESH and not SHAPE_CSG. Round the origin, with parts of a thousandth of size up to size: thin,
 * flat, pointed, open, closed. */
Object randomObject(ShapeKind kind, double size);

/* The same, but one that has an inside and is not small: it reaches half of size, or has no end. */
Object randomSolid(double size);

/* Rotated, moved, scaled by factors of 1/3 .. 3 of either sign, and sheared. */
Transform randomTransform(double size);

/* A point that rays can be sent to: on a triangle, in the box of others, or on a plane. Object space. */
Vector3D randomTarget(const Object *object, double size);

/* How far a point is from the surface of the object, of which it is untransformed. */
double distanceToSurface(const Object *object, Vector3D p);

/* Whether the box, or a little more, holds the point. */
bool boundsHold(const Bounds *bounds, Vector3D p, double slack);

/* All hits of the ray, sorted; the caller frees the sink. */
HitSink allHits(const Object *object, const Ray *ray);

#endif
