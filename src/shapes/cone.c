/* cone.c - cylinder, cone and frustum; see cone.h.
 *
 * Seen from the middle of the axis, with w the unit axis, a point has the height z = p.w and the part q
 * across the axis. With r the mean radius and half the opening angle alpha, tan(alpha) being the growth of
 * the radius per height, the side is where |q| cos(alpha) = r cos(alpha) + z sin(alpha), and for the ray
 * p + t d that is the quadratic A t^2 + 2 B t + C = 0 with g = r cos + pz sin and
 *     A = cos^2 |dq|^2 - sin^2 dz^2,   B = cos^2 (pq.dq) - g dz sin,   C = cos^2 |pq|^2 - g^2.
 * B^2 - A C loses its digits by cancellation, while by Lagrange's identity it is
 *     cos^2 (|g dq - dz sin pq|^2 - cos^2 |pq x dq|^2),
 * a difference of two squares without that loss. The ray's start is moved near the solid for the same reason
 * (Haines, Gunther and Akenine-Moeller 2019, "Precision improvements for ray/sphere intersection", Ray
 * Tracing Gems). The solid is convex: the ray is in it where it is both in the endless cone and between the
 * ends, as with the slabs of a box (Kay and Kajiya 1986), so no ray slips through the rim between side and
 * disc.
 */
#include "shapes/cone.h"

#include "shapes/shape.h"

Cone createCone(Vector3D base, Vector3D top, double baseRadius, double topRadius, bool isOpen,
                Material material)
{
    return (Cone){material, base, top, baseRadius, topRadius, isOpen};
}

Cone createCylinder(Vector3D base, Vector3D top, double radius, bool isOpen, Material material)
{
    return createCone(base, top, radius, radius, isOpen, material);
}

/* The part of a hit. */
enum {
    PART_SIDE,
    PART_BASE,
    PART_TOP
};

/* The cone by its middle. */
typedef struct Frame {
    Vector3D middle, axis; /* axis: of unit length, from base to top */
    double halfHeight, radius;
    double sine, cosine; /* of the angle between side and axis; the sine is negative where it narrows */
} Frame;

static Frame frameOfCone(const Cone *cone)
{
    Vector3D along = subVectors(cone->top, cone->base);
    double height = norm(along);
    double growth = cone->topRadius - cone->baseRadius;
    double slant = hypot(height, growth);
    return (Frame){.middle = addVectors(multVector(cone->base, 0.5), multVector(cone->top, 0.5)),
                   .axis = normalize(along),
                   .halfHeight = height / 2,
                   .radius = (cone->baseRadius + cone->topRadius) / 2,
                   .sine = growth / slant,
                   .cosine = height / slant};
}

/* How far the point, seen from the middle, is outside the side of the endless cone; negative inside. */
static double distanceToSide(const Frame *frame, Vector3D p)
{
    double z = dot(p, frame->axis);
    double across = norm(subVectors(p, multVector(frame->axis, z)));
    return (across - frame->radius) * frame->cosine - z * frame->sine;
}

/* Where a line is within the endless cone whose radius is positive; empty when entry > exit. */
typedef struct Interval {
    double entry, exit;
} Interval;

static Interval insideEndlessCone(const Frame *frame, Vector3D p, Vector3D d)
{
    const Interval nowhere = {INFINITY, -INFINITY};
    double pz = dot(p, frame->axis), dz = dot(d, frame->axis);
    Vector3D pq = subVectors(p, multVector(frame->axis, pz)), dq = subVectors(d, multVector(frame->axis, dz));
    double sine = frame->sine, cosine = frame->cosine;
    double g = frame->radius * cosine + pz * sine;

    /* Set up the quadratic. */
    double a = (cosine * norm(dq) - sine * dz) * (cosine * norm(dq) + sine * dz);
    double b = cosine * cosine * dot(pq, dq) - g * dz * sine;
    double c = (cosine * norm(pq) - g) * (cosine * norm(pq) + g);
    double first = norm(subVectors(multVector(dq, g), multVector(pq, dz * sine)));
    double second = cosine * norm(cross(pq, dq));
    double discriminant = cosine * cosine * (first - second) * (first + second);
    if (discriminant < 0) {
        if (a > 0)
            return nowhere;
        discriminant = 0;
    }

    /* Solve it, the root nearer to 0 by the product of both; q is 0 only where both are at t = 0. */
    double q = -(b + copysign(sqrt(discriminant), b));
    if (q == 0 && a == 0)
        return c <= 0 ? (Interval){-INFINITY, INFINITY} : nowhere;
    double t1 = q == 0 ? 0 : c / q;
    double t2 = q == 0 ? 0 : a != 0 ? q / a : copysign(INFINITY, q);
    if (a > 0)
        return (Interval){fmin(t1, t2), fmax(t1, t2)};
    /* Take the end that is on the half where the radius is positive. */
    if (a == 0)
        return b > 0 ? (Interval){-INFINITY, t1} : (Interval){t1, INFINITY};
    return dz * sine > 0 ? (Interval){fmax(t1, t2), INFINITY} : (Interval){-INFINITY, fmin(t1, t2)};
}

static void coneIntersect(const Object *object, const Ray *ray, HitSink *sink)
{
    const Cone *cone = &object->cone;
    Frame frame = frameOfCone(cone);

    /* Move the ray's start to where it is nearest to the middle. */
    Vector3D fromMiddle = subVectors(ray->origin, frame.middle);
    double moved = -dot(fromMiddle, ray->direction);
    Vector3D p = addVectors(fromMiddle, multVector(ray->direction, moved));
    Interval side = insideEndlessCone(&frame, p, ray->direction);
    if (side.entry > side.exit)
        return;

    /* Find where it is between the two ends, which are planes: worked out as those of plane.c, so that a
     * column on a floor meets the floor's plane where the floor does. */
    double z = dot(p, frame.axis), dz = dot(ray->direction, frame.axis);
    Interval slab = {-INFINITY, INFINITY}, ends = slab;
    if (dz != 0) {
        double start = dot(frame.axis, ray->origin);
        double t1 = (dot(frame.axis, cone->base) - start) / dz,
               t2 = (dot(frame.axis, cone->top) - start) / dz;
        ends = (Interval){fmin(t1, t2), fmax(t1, t2)};
        slab = (Interval){ends.entry - moved, ends.exit - moved};
    } else if (fabs(z) > frame.halfHeight) {
        return;
    }

    if (cone->isOpen) {
        if (side.entry >= slab.entry && side.entry <= slab.exit)
            reportHit(sink, side.entry + moved, PART_SIDE, 0, 0);
        if (side.exit >= slab.entry && side.exit <= slab.exit)
            reportHit(sink, side.exit + moved, PART_SIDE, 0, 0);
        return;
    }
    if (fmax(side.entry, slab.entry) > fmin(side.exit, slab.exit))
        return;
    int first = dz > 0 ? PART_BASE : PART_TOP, last = dz > 0 ? PART_TOP : PART_BASE;
    bool entersSide = side.entry >= slab.entry, leavesSide = side.exit <= slab.exit;
    reportHit(sink, entersSide ? side.entry + moved : ends.entry, entersSide ? PART_SIDE : first, 0, 0);
    reportHit(sink, leavesSide ? side.exit + moved : ends.exit, leavesSide ? PART_SIDE : last, 0, 0);
}

static Vector3D coneNormal(const Object *object, const Hit *hit, Vector3D position)
{
    Frame frame = frameOfCone(&object->cone);
    if (hit->part != PART_SIDE)
        return frame.axis;
    Vector3D p = subVectors(position, frame.middle);
    Vector3D across = normalize(subVectors(p, multVector(frame.axis, dot(p, frame.axis))));
    Vector3D n = subVectors(multVector(across, frame.cosine), multVector(frame.axis, frame.sine));
    return normalize(n);
}

static bool coneContains(const Object *object, Vector3D point)
{
    const Cone *cone = &object->cone;
    if (cone->isOpen)
        return false;
    Frame frame = frameOfCone(cone);
    Vector3D p = subVectors(point, frame.middle);
    return fabs(dot(p, frame.axis)) < frame.halfHeight && distanceToSide(&frame, p) < 0;
}

static bool coneHasInside(const Object *object)
{
    return !object->cone.isOpen;
}

/* Each end is a circle, which reaches r sqrt(wy^2 + wz^2) along x. */
static bool coneBounds(const Object *object, Bounds *bounds)
{
    const Cone *cone = &object->cone;
    Vector3D w = frameOfCone(cone).axis;
    Vector3D reach =
        createVector(sqrt(w.y * w.y + w.z * w.z), sqrt(w.x * w.x + w.z * w.z), sqrt(w.x * w.x + w.y * w.y));
    Vector3D atBase = multVector(reach, cone->baseRadius), atTop = multVector(reach, cone->topRadius);
    Vector3D low1 = subVectors(cone->base, atBase), low2 = subVectors(cone->top, atTop);
    Vector3D high1 = addVectors(cone->base, atBase), high2 = addVectors(cone->top, atTop);
    bounds->min = createVector(fmin(low1.x, low2.x), fmin(low1.y, low2.y), fmin(low1.z, low2.z));
    bounds->max = createVector(fmax(high1.x, high2.x), fmax(high1.y, high2.y), fmax(high1.z, high2.z));
    return true;
}

static double coneMagnitude(const Object *object)
{
    const Cone *cone = &object->cone;
    return fmax(largestCoordinate(cone->base) + cone->baseRadius,
                largestCoordinate(cone->top) + cone->topRadius);
}

static void coneWritePov(const Object *object, double scale, Text *pov)
{
    const Cone *cone = &object->cone;
    bool isCylinder = cone->baseRadius == cone->topRadius;
    textAppend(pov, isCylinder ? "cylinder { " : "cone { ");
    textAppendPovVector(pov, cone->base, scale);
    textAppend(pov, ", ");
    if (!isCylinder) {
        textAppendPovNumber(pov, cone->baseRadius * scale);
        textAppend(pov, ", ");
    }
    textAppendPovVector(pov, cone->top, scale);
    textAppend(pov, ", ");
    textAppendPovNumber(pov, cone->topRadius * scale);
    if (cone->isOpen)
        textAppend(pov, " open");
}

const Shape coneShape = {.name = "cone",
                         .intersect = coneIntersect,
                         .normal = coneNormal,
                         .contains = coneContains,
                         .hasInside = coneHasInside,
                         .bounds = coneBounds,
                         .magnitude = coneMagnitude,
                         .writePov = coneWritePov};
