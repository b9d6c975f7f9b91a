/* sphere.h - all points at one distance from a centre. */
#ifndef ECLAIRAGE_SHAPES_SPHERE_H
#define ECLAIRAGE_SHAPES_SPHERE_H

#include "shapes/intersection.h"

#include <stdbool.h>

typedef struct Sphere {
    Material material;
    Vector3D center;
    double radius; /* above 0 */
} Sphere;

Sphere createSphere(Vector3D center, double radius, Material material);

/* The nearest point at t > 0 where the ray meets the sphere; from inside, that is where it leaves. A
 * ray that only touches (discriminant 0) meets it. On a miss the intersection is untouched. */
bool intersectsSphere(Ray ray, Sphere sphere, Intersection *intersection);

#endif
