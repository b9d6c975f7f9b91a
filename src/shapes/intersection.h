/* intersection.h - where a ray meets a surface, and a box that bounds a shape. */
#ifndef ECLAIRAGE_SHAPES_INTERSECTION_H
#define ECLAIRAGE_SHAPES_INTERSECTION_H

#include "geometry.h"
#include "shading.h"

#include <stdbool.h>
#include <stddef.h>

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

struct Object;

/* One place where a ray meets a surface. */
typedef struct Hit {
    double distance;             /* along the world's ray, above 0 */
    const struct Object *object; /* the object, or the part of a CSG object, that has the surface */
    int part;                    /* which face, for the shape's own normal */
    double u, v;                 /* where on the face, likewise */
} Hit;

/* Where shapes report their hits: either only the nearest one above a minimum is kept, or all are. */
typedef struct HitSink {
    double above;           /* hits at or below this distance do not count */
    Hit nearest;            /* its distance is INFINITY while there is none */
    Hit *all;               /* all of them, unsorted; NULL when only the nearest is wanted */
    size_t count, capacity; /* of all */
    bool keepAll;
    bool outOfMemory;
    const struct Object *current; /* whose shape is reporting */
    double scale;                 /* world distance = scale * the shape's own */
} HitSink;

/* A sink for the nearest hit above this distance, or for all of them; one for all is freed. */
HitSink createHitSink(double above, bool keepAll);
void freeHitSink(HitSink *sink);

/* Called by shapes: there is a hit at this distance of the ray they were given. */
void reportHit(HitSink *sink, double distance, int part, double u, double v);

/* Sort all hits by their distance. */
void sortHits(HitSink *sink);

/* n, or -n where n points the way the ray goes: the normal on the side that is seen. */
static inline Vector3D turnedToRay(Vector3D n, const Ray *ray)
{
    return dot(n, ray->direction) > 0 ? multVector(n, -1) : n;
}

#endif
