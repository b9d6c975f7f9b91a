/* disc.c - a flat round plate, perhaps with a hole; see disc.h.
 *
 * A point o + t d of the ray is in the plane of the disc when n.(o + t d - c) = 0, so
 *     t = n.(c - o) / n.d
 * and on the disc when its distance from the centre is between the two radii, both included. A ray that
 * runs along the plane misses. A disc has two sides and no inside.
 */
#include "shapes/disc.h"

#include "shapes/shape.h"

Disc createDisc(Vector3D center, Vector3D normal, double radius, double innerRadius, Material material)
{
    return (Disc){material, center, normalize(normal), radius, innerRadius};
}

static void discIntersect(const Object *object, const Ray *ray, HitSink *sink)
{
    const Disc *disc = &object->disc;
    double slope = dot(disc->normal, ray->direction);
    if (slope == 0)
        return;
    Vector3D toCenter = subVectors(disc->center, ray->origin);
    double t = dot(disc->normal, toCenter) / slope;

    /* Measure how far from the centre the plane is met. */
    Vector3D offset = subVectors(multVector(ray->direction, t), toCenter);
    double squared = dot(offset, offset);
    if (squared >= disc->innerRadius * disc->innerRadius && squared <= disc->radius * disc->radius)
        reportHit(sink, t, 0, 0, 0);
}

static Vector3D discNormal(const Object *object, const Hit *hit, Vector3D position)
{
    (void)hit;
    (void)position;
    return object->disc.normal;
}

/* A circle with the unit normal n reaches r sqrt(1 - nx^2) = r sqrt(ny^2 + nz^2) along x. */
static bool discBounds(const Object *object, Bounds *bounds)
{
    const Disc *disc = &object->disc;
    Vector3D n = disc->normal;
    Vector3D reach = multVector(
        createVector(sqrt(n.y * n.y + n.z * n.z), sqrt(n.x * n.x + n.z * n.z), sqrt(n.x * n.x + n.y * n.y)),
        disc->radius);
    *bounds = (Bounds){subVectors(disc->center, reach), addVectors(disc->center, reach)};
    return true;
}

static double discMagnitude(const Object *object)
{
    return largestCoordinate(object->disc.center) + object->disc.radius;
}

static void discWritePov(const Object *object, double scale, Text *pov)
{
    const Disc *disc = &object->disc;
    textAppend(pov, "disc { ");
    textAppendPovVector(pov, disc->center, scale);
    textAppend(pov, ", ");
    textAppendPovVector(pov, disc->normal, 1);
    textAppend(pov, ", ");
    textAppendPovNumber(pov, disc->radius * scale);
    textAppend(pov, ", ");
    textAppendPovNumber(pov, disc->innerRadius * scale);
}

const Shape discShape = {.name = "disc",
                         .intersect = discIntersect,
                         .normal = discNormal,
                         .contains = containsNothing,
                         .hasInside = alwaysFalse,
                         .bounds = discBounds,
                         .magnitude = discMagnitude,
                         .writePov = discWritePov};
