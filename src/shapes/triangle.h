/* triangle.h - a flat triangle, with one normal or one interpolated from its corners'. */
#ifndef ECLAIRAGE_SHAPES_TRIANGLE_H
#define ECLAIRAGE_SHAPES_TRIANGLE_H

#include "shapes/intersection.h"

#include <stdbool.h>

typedef struct Triangle {
    Material material;
    Vector3D vertices[3]; /* not on one line */
    bool isSmooth;        /* normals are given, and interpolated over the triangle */
    Vector3D normals[3];  /* of unit length */
} Triangle;

/* normals: three of any length but 0, or NULL for a flat triangle. */
Triangle createTriangle(const Vector3D vertices[3], const Vector3D *normals, Material material);

/* Whether the corners' normals are all on one side of a triangle with this flat normal, and surely so, in
 * world space; object says where that is. Where they are not, POV-Ray ignores a smooth triangle that is not
 * in a mesh. */
bool normalsAgree(const struct Object *object, Vector3D flat, const Vector3D normals[3]);

/* Whether the three points span a triangle: its area is more than rounding error. */
bool isTriangle(const Vector3D vertices[3]);

#endif
