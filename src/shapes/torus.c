/* torus.c - a ring round the y axis; see torus.h.
 *
 * With rho the distance from the axis, the surface is G = (rho - R)^2 + y^2 - r^2 = 0, inside G < 0. Times
 * (rho + R)^2 + y^2 - r^2, which is positive, it is a polynomial: (|p|^2 + R^2 - r^2)^2 - 4 R^2 rho^2. Along
 * a ray p + t d whose start is moved to where it is nearest to the centre (p.d = 0) that is a quartic
 * without its cubic term,
 *     F = t^4 + 2 a t^2 + 4 b t + c,   a = |p|^2 - R^2 - r^2 + 2 R^2 dy^2,   b = 2 R^2 py dy.
 * The closed form for a quartic's roots (Ferrari) is of no use for a thin ring: its c is a small difference
 * of large numbers. Instead the roots are bracketed: between the roots of F' / 4 = t^3 + a t + b, at most
 * three, F rises or falls all the way, so there is one root where its sign changes (Collins and Loos 1976,
 * "Polynomial real root isolation by differentiation"). The sign is taken of G, which has no such difference,
 * and so is Newton's step, kept in the bracket by bisection (Press et al. 2007, Numerical Recipes, section
 * 9.4). An error of a bracket's end counts only by its square, F being flat there.
 */
#include "shapes/torus.h"

#include "shapes/shape.h"

#include <float.h>

Torus createTorus(double majorRadius, double minorRadius, Material material)
{
    return (Torus){material, majorRadius, minorRadius};
}

/* G at a point, and its slope along d where that is wanted. */
static double insideness(const Torus *torus, Vector3D p, Vector3D d, double *slope)
{
    double rho = sqrt(p.x * p.x + p.z * p.z);
    double across = rho - torus->majorRadius;
    if (slope != NULL)
        *slope = 2 * (across * (p.x * d.x + p.z * d.z) / rho + p.y * d.y);
    return across * across + p.y * p.y - torus->minorRadius * torus->minorRadius;
}

/* The real roots of t^3 + a t + b in rising order: three by Viete's formula, or one by Cardano's. */
static int solveCubic(double a, double b, double roots[3])
{
    double third = a / 3, half = b / 2;
    double discriminant = half * half + third * third * third;
    if (discriminant < 0) {
        double size = sqrt(-third);
        double angle = acos(fmax(-1, fmin(1, -half / (size * size * size)))) / 3;
        const double thirdOfTurn = 2.09439510239319549;
        roots[0] = 2 * size * cos(angle + thirdOfTurn);
        roots[1] = 2 * size * cos(angle - thirdOfTurn);
        roots[2] = 2 * size * cos(angle);
        return 3;
    }
    /* With u^3 - v^3 = |b| and u v = a / 3 the root is v - u, or -|b| / (u^2 + u v + v^2) where that is a
     * difference. */
    double u = cbrt(fabs(half) + sqrt(discriminant));
    double v = u > 0 ? third / u : 0;
    double root = v > 0 ? fabs(b) / (u * u + u * v + v * v) : u - v;
    roots[0] = copysign(root, -b);
    return 1;
}

/* The place between low and high where G changes its sign. */
static double findRoot(const Torus *torus, Vector3D p, Vector3D d, double low, double high)
{
    bool insideAtLow = insideness(torus, addVectors(p, multVector(d, low)), d, NULL) <= 0;
    double t = (low + high) / 2, step = high - low, stepBefore = step;
    double enough = DBL_EPSILON / 4 * torus->majorRadius;
    for (int i = 0; i < 128; i++) {
        double slope;
        double value = insideness(torus, addVectors(p, multVector(d, t)), d, &slope);
        if ((value <= 0) == insideAtLow)
            low = t;
        else
            high = t;
        /* Step by Newton where that stays in the bracket and at least halves the step before the last. */
        double next = t - value / slope;
        bool converges = next >= low && next <= high && fabs(2 * (next - t)) <= fabs(stepBefore);
        stepBefore = step;
        step = (converges ? next : low + (high - low) / 2) - t;
        t += step;
        if (fabs(step) <= enough)
            break;
    }
    return t;
}

static void torusIntersect(const Object *object, const Ray *ray, HitSink *sink)
{
    const Torus *torus = &object->torus;
    double major = torus->majorRadius, minor = torus->minorRadius, outer = major + minor;

    /* Move the ray's start to where it is nearest to the centre, and leave out what stays away. */
    Vector3D d = ray->direction;
    double moved = -dot(ray->origin, d);
    Vector3D p = addVectors(ray->origin, multVector(d, moved));
    double reachSquared = outer * outer - dot(p, p);
    if (!(reachSquared >= 0))
        return;

    double reach = sqrt(reachSquared) + minor;
    if (fabs(p.y) - fabs(d.y) * reach > minor)
        return;

    /* Divide the way through the ball round the torus where F turns. */
    double a = dot(p, p) - major * major - minor * minor + 2 * major * major * d.y * d.y;
    double b = 2 * major * major * p.y * d.y;
    double turns[3], ends[5] = {-reach};
    int turnCount = solveCubic(a, b, turns), count = 1;
    for (int i = 0; i < turnCount; i++)
        if (turns[i] > ends[count - 1] && turns[i] < reach)
            ends[count++] = turns[i];
    ends[count++] = reach;

    /* Find the root between two ends of which one is inside. */
    bool wasInside = false;
    for (int i = 1; i < count; i++) {
        bool isInside = insideness(torus, addVectors(p, multVector(d, ends[i])), d, NULL) <= 0;
        if (isInside != wasInside)
            reportHit(sink, findRoot(torus, p, d, ends[i - 1], ends[i]) + moved, 0, 0, 0);
        wasInside = isInside;
    }
}

/* Away from the nearest point of the circle in the middle of the ring; where a ring without a hole closes,
 * along the axis. */
static Vector3D torusNormal(const Object *object, const Hit *hit, Vector3D position)
{
    (void)hit;
    double rho = sqrt(position.x * position.x + position.z * position.z);
    if (rho == 0)
        return createVector(0, 1, 0);
    double major = object->torus.majorRadius;
    Vector3D n = subVectors(position, createVector(major * position.x / rho, 0, major * position.z / rho));
    return normalize(n);
}

static bool torusContains(const Object *object, Vector3D point)
{
    return insideness(&object->torus, point, point, NULL) < 0;
}

static bool torusBounds(const Object *object, Bounds *bounds)
{
    double outer = object->torus.majorRadius + object->torus.minorRadius, minor = object->torus.minorRadius;
    *bounds = (Bounds){{-outer, -minor, -outer}, {outer, minor, outer}};
    return true;
}

static double torusMagnitude(const Object *object)
{
    return object->torus.majorRadius + object->torus.minorRadius;
}

static void torusWritePov(const Object *object, double scale, Text *pov)
{
    textAppend(pov, "torus { ");
    textAppendPovNumber(pov, object->torus.majorRadius * scale);
    textAppend(pov, ", ");
    textAppendPovNumber(pov, object->torus.minorRadius * scale);
}

const Shape torusShape = {.name = "torus",
                          .intersect = torusIntersect,
                          .normal = torusNormal,
                          .contains = torusContains,
                          .hasInside = alwaysTrue,
                          .bounds = torusBounds,
                          .magnitude = torusMagnitude,
                          .writePov = torusWritePov};
