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

/* The two distances at which the line of the ray meets the sphere, in no order; false where it passes by, and
 * then they mean nothing. Without branches, so that a compiler can do several rays at a time. See sphere.c.
 */
static inline bool sphereDistances(Vector3D center, double radius, const Ray *ray, double *first,
                                   double *second)
{
    Vector3D f = subVectors(ray->origin, center);
    double b = -dot(f, ray->direction);
    double squaredRadius = radius * radius;

    /* Find how far the ray's nearest point is from the centre. */
    Vector3D nearest = addVectors(f, multVector(ray->direction, b));
    double discriminant = squaredRadius - dot(nearest, nearest);
    double root = copysign(sqrt(discriminant >= 0 ? discriminant : 0), b);

    /* Solve for the two distances. From a point on the sphere along it, c is nothing but rounding; then the
     * difference is the better one. */
    double c = dot(f, f) - squaredRadius;
    double q = b + root;
    double other = c / (q != 0 ? q : 1);
    other = q != 0 ? other : 0;
    *first = q;
    *second = fabs(other) > fabs(q) ? b - root : other;
    return discriminant >= 0;
}

/* The nearest point at t > 0 where the ray meets the sphere; from inside, that is where it leaves. A
 * ray that only touches (discriminant 0) meets it. On a miss the intersection is untouched. */
bool intersectsSphere(Ray ray, Sphere sphere, Intersection *intersection);

#endif
