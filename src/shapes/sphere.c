/* sphere.c - all points at one distance from a centre; see sphere.h.
 *
 * A point o + t d of the ray (|d| = 1) is on the sphere when |o + t d - c|^2 = r^2. With f = o - c:
 *     t^2 + 2 t (f.d) + f.f - r^2 = 0
 * The textbook's discriminant (f.d)^2 - (f.f - r^2) loses its digits when the sphere is far away or
 * large; r^2 - |f - (f.d) d|^2 is the same number without that loss, since f - (f.d) d is the vector
 * from the centre to the ray's nearest point (Haines, Gunther and Akenine-Moeller 2019, "Precision
 * improvements for ray/sphere intersection", Ray Tracing Gems, eq. 3), and of the two solutions the
 * one that would be a difference of nearly equal numbers comes from the other as c / q (eq. 5).
 */
#include "shapes/sphere.h"

#include "shapes/shape.h"

Sphere createSphere(Vector3D center, double radius, Material material)
{
    return (Sphere){material, center, radius};
}

static void sphereIntersect(const Object *object, const Ray *ray, HitSink *sink)
{
    double first, second;
    if (!sphereDistances(object->sphere.center, object->sphere.radius, ray, &first, &second))
        return;
    reportHit(sink, first, 0, 0, 0);
    reportHit(sink, second, 0, 0, 0);
}

static Vector3D sphereNormal(const Object *object, const Hit *hit, Vector3D position)
{
    (void)hit;
    return multVector(subVectors(position, object->sphere.center), 1 / object->sphere.radius);
}

static bool sphereContains(const Object *object, Vector3D point)
{
    return norm(subVectors(point, object->sphere.center)) < object->sphere.radius;
}

static bool sphereBounds(const Object *object, Bounds *bounds)
{
    double r = object->sphere.radius;
    bounds->min = subVectors(object->sphere.center, createVector(r, r, r));
    bounds->max = addVectors(object->sphere.center, createVector(r, r, r));
    return true;
}

static double sphereMagnitude(const Object *object)
{
    return largestCoordinate(object->sphere.center) + object->sphere.radius;
}

static void sphereWritePov(const Object *object, double scale, Text *pov)
{
    textAppend(pov, "sphere { ");
    textAppendPovVector(pov, object->sphere.center, scale);
    textAppend(pov, ", ");
    textAppendPovNumber(pov, object->sphere.radius * scale);
}

const Shape sphereShape = {.name = "sphere",
                           .intersect = sphereIntersect,
                           .normal = sphereNormal,
                           .contains = sphereContains,
                           .hasInside = alwaysTrue,
                           .bounds = sphereBounds,
                           .magnitude = sphereMagnitude,
                           .writePov = sphereWritePov};

bool intersectsSphere(Ray ray, Sphere sphere, Intersection *intersection)
{
    Object object = {.kind = SHAPE_SPHERE, .sphere = sphere};
    return intersectsObject(&ray, &object, intersection);
}
