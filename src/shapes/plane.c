/* plane.c - a flat surface without end; see plane.h.
 *
 * A point o + t d of the ray is on the plane when n.(o + t d) = n.p, so t = (n.p - n.o) / n.d.
 */
#include "shapes/plane.h"

#include "shapes/shape.h"

Plane createPlane(Vector3D point, Vector3D normal, Material material)
{
    return (Plane){material, point, normalize(normal)};
}

static void planeIntersect(const Object *object, const Ray *ray, HitSink *sink)
{
    const Plane *plane = &object->plane;
    double slope = dot(plane->normal, ray->direction);
    if (slope != 0)
        reportHit(sink, (dot(plane->normal, plane->point) - dot(plane->normal, ray->origin)) / slope, 0, 0,
                  0);
}

static Vector3D planeNormal(const Object *object, const Hit *hit, Vector3D position)
{
    (void)hit;
    (void)position;
    return object->plane.normal;
}

static bool planeContains(const Object *object, Vector3D point)
{
    return dot(object->plane.normal, subVectors(point, object->plane.point)) < 0;
}

static bool planeBounds(const Object *object, Bounds *bounds)
{
    (void)object;
    (void)bounds;
    return false;
}

static double planeMagnitude(const Object *object)
{
    return largestCoordinate(object->plane.point);
}

static void planeWritePov(const Object *object, double scale, Text *pov)
{
    textAppend(pov, "plane { ");
    textAppendPovVector(pov, object->plane.normal, 1);
    textAppend(pov, ", ");
    textAppendPovNumber(pov, dot(object->plane.normal, object->plane.point) * scale);
}

const Shape planeShape = {.name = "plane",
                          .intersect = planeIntersect,
                          .normal = planeNormal,
                          .contains = planeContains,
                          .hasInside = alwaysTrue,
                          .bounds = planeBounds,
                          .magnitude = planeMagnitude,
                          .writePov = planeWritePov};

bool intersectsPlane(Ray ray, Plane plane, Intersection *intersection)
{
    Object object = {.kind = SHAPE_PLANE, .plane = plane};
    return intersectsObject(&ray, &object, intersection);
}
