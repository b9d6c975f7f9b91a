/* intersection.h - where a ray meets a surface, and a box that bounds a shape. */
#ifndef ECLAIRAGE_SHAPES_INTERSECTION_H
#define ECLAIRAGE_SHAPES_INTERSECTION_H

#include "geometry.h"
#include "shading.h"

typedef struct Intersection {
    double distance;   /* from the ray's origin, above 0 */
    Vector3D position; /* in world space */
    Vector3D normal;   /* of unit length, turned to the side the ray comes from */
    Material material;
} Intersection;

/* An axis-aligned box: all p with min <= p <= max in each coordinate. */
typedef struct Bounds {
    Vector3D min, max;
} Bounds;

/* n, or -n where n points the way the ray goes: the normal on the side that is seen. */
static inline Vector3D turnedToRay(Vector3D n, const Ray *ray)
{
    return dot(n, ray->direction) > 0 ? multVector(n, -1) : n;
}

#endif
