/* plane.h - a flat surface without end. */
#ifndef ECLAIRAGE_SHAPES_PLANE_H
#define ECLAIRAGE_SHAPES_PLANE_H

#include "shapes/intersection.h"

#include <stdbool.h>

typedef struct Plane {
    Material material;
    Vector3D point;  /* on the plane */
    Vector3D normal; /* of unit length; its other side is the inside */
} Plane;

/* normal: any length but 0. */
Plane createPlane(Vector3D point, Vector3D normal, Material material);

/* The point at t > 0 where the ray meets the plane, from either side. A ray parallel to it misses. On a
 * miss the intersection is untouched. */
bool intersectsPlane(Ray ray, Plane plane, Intersection *intersection);

#endif
