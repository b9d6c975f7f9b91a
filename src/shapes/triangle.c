/* triangle.c - a flat triangle; see triangle.h.
 *
 * Whether a ray goes through the triangle is asked along the ray: with the origin moved to the ray's and
 * space sheared so that the ray becomes an axis, the corners lie in a plane and the ray at its origin, and
 * the signs of the three edge functions tell the side of each edge (Woop, Benthin and Wald 2013, "Watertight
 * ray/triangle intersection", section 3). Two triangles with a common edge compute the same number for it but
 * for the sign, so no ray passes between them; a ray through an edge or a corner meets the triangle.
 * Where it does is asked of the plane, t = n.(a - o) / n.d: so a point a little off the surface stays on its
 * side, however thin the triangle is.
 */
#include "shapes/triangle.h"

#include "shapes/shape.h"

#include <float.h>

Triangle createTriangle(const Vector3D vertices[3], const Vector3D *normals, Material material)
{
    Triangle triangle = {.material = material, .isSmooth = normals != NULL};
    for (int i = 0; i < 3; i++) {
        triangle.vertices[i] = vertices[i];
        if (normals != NULL)
            triangle.normals[i] = normalize(normals[i]);
    }
    return triangle;
}

/* The normal by the right-hand rule, its length twice the area. */
static Vector3D areaNormal(const Vector3D vertices[3])
{
    return cross(subVectors(vertices[1], vertices[0]), subVectors(vertices[2], vertices[0]));
}

bool isTriangle(const Vector3D vertices[3])
{
    /* Bring the corners to a size where nothing overflows or vanishes. */
    double largest = fmax(largestCoordinate(vertices[0]),
                          fmax(largestCoordinate(vertices[1]), largestCoordinate(vertices[2])));
    if (!(largest > 0) || !isfinite(largest))
        return false;
    int exponent;
    frexp(largest, &exponent);
    Vector3D v[3];
    for (int i = 0; i < 3; i++)
        v[i] = createVector(ldexp(vertices[i].x, -exponent), ldexp(vertices[i].y, -exponent),
                            ldexp(vertices[i].z, -exponent));

    /* Coordinates near 1 may each be wrong by DBL_EPSILON / 2, which moves a corner by about that. */
    double longest =
        fmax(norm(subVectors(v[1], v[0])), fmax(norm(subVectors(v[2], v[0])), norm(subVectors(v[2], v[1]))));
    return norm(areaNormal(v)) > 8 * DBL_EPSILON * longest;
}

/* The corner relative to the ray, sheared so that the ray's direction becomes an axis: where it is across. */
typedef struct Across {
    double x, y;
} Across;

static Across shear(const double corner[3], int x, int y, int z, double shearX, double shearY)
{
    return (Across){corner[x] - shearX * corner[z], corner[y] - shearY * corner[z]};
}

/* A ray that runs along the plane up to rounding misses: where it would meet it, rounding alone decides.
 * The cosine of the angle to the normal. */
static const double PARALLEL = 0x1p-40;

static void triangleIntersect(const Object *object, const Ray *ray, HitSink *sink)
{
    const Triangle *triangle = &object->triangle;

    /* Take the direction's largest coordinate as z. */
    const double d[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    int z = fabs(d[0]) > fabs(d[1]) ? 0 : 1;
    if (fabs(d[2]) > fabs(d[z]))
        z = 2;
    int x = (z + 1) % 3, y = (z + 2) % 3;
    double shearX = d[x] / d[z], shearY = d[y] / d[z];

    /* Shear the corners, seen from the ray's origin. */
    Across corners[3];
    for (int i = 0; i < 3; i++) {
        Vector3D v = subVectors(triangle->vertices[i], ray->origin);
        corners[i] = shear((double[3]){v.x, v.y, v.z}, x, y, z, shearX, shearY);
    }
    Across a = corners[0], b = corners[1], c = corners[2];

    /* Ask of each edge on which side the ray passes; on all the same is through the triangle. */
    double edgeA = c.x * b.y - c.y * b.x;
    double edgeB = a.x * c.y - a.y * c.x;
    double edgeC = b.x * a.y - b.y * a.x;
    if ((edgeA < 0 || edgeB < 0 || edgeC < 0) && (edgeA > 0 || edgeB > 0 || edgeC > 0))
        return;
    double sum = edgeA + edgeB + edgeC;
    if (sum == 0)
        return;

    /* Meet the plane. */
    Vector3D n = normalize(areaNormal(triangle->vertices));
    double slope = dot(n, ray->direction);
    if (fabs(slope) > PARALLEL)
        reportHit(sink, dot(n, subVectors(triangle->vertices[0], ray->origin)) / slope, 0, edgeB / sum,
                  edgeC / sum);
}

static Vector3D triangleFlatNormal(const Object *object, const Hit *hit)
{
    (void)hit;
    return normalize(areaNormal(object->triangle.vertices));
}

/* Of a smooth triangle (1 - u - v) na + u nb + v nc, as long as that is a direction (Phong 1975). */
static Vector3D triangleNormal(const Object *object, const Hit *hit, Vector3D position)
{
    (void)position;
    const Triangle *triangle = &object->triangle;
    if (triangle->isSmooth) {
        const Vector3D *n = triangle->normals;
        Vector3D along = addVectors(multVector(subVectors(n[1], n[0]), hit->u),
                                    multVector(subVectors(n[2], n[0]), hit->v));
        Vector3D mixed = addVectors(n[0], along);
        if (norm(mixed) > 1e-9)
            return normalize(mixed);
    }
    return triangleFlatNormal(object, hit);
}

static bool triangleBounds(const Object *object, Bounds *bounds)
{
    const Vector3D *v = object->triangle.vertices;
    bounds->min = createVector(fmin(v[0].x, fmin(v[1].x, v[2].x)), fmin(v[0].y, fmin(v[1].y, v[2].y)),
                               fmin(v[0].z, fmin(v[1].z, v[2].z)));
    bounds->max = createVector(fmax(v[0].x, fmax(v[1].x, v[2].x)), fmax(v[0].y, fmax(v[1].y, v[2].y)),
                               fmax(v[0].z, fmax(v[1].z, v[2].z)));
    return true;
}

static double triangleMagnitude(const Object *object)
{
    const Vector3D *v = object->triangle.vertices;
    return fmax(largestCoordinate(v[0]), fmax(largestCoordinate(v[1]), largestCoordinate(v[2])));
}

/* A side is sure when the cosine to the plane is above this. */
static const double SURE_SIDE = 1e-6;

/* A normal in world space, of unit length. */
static Vector3D normalInWorld(const Object *object, Vector3D n)
{
    return object->transform != NULL ? normalize(transformNormal(&object->transform->objectFromWorld, n)) : n;
}

bool normalsAgree(const Object *object, Vector3D flat, const Vector3D normals[3])
{
    flat = normalInWorld(object, flat);
    int front = 0, back = 0;
    for (int i = 0; i < 3; i++) {
        double cosine = dot(normalInWorld(object, normals[i]), flat);
        front += cosine > SURE_SIDE;
        back += cosine < -SURE_SIDE;
    }
    return front == 3 || back == 3;
}

/* POV-Ray ignores a smooth triangle, but not one in a mesh, unless its normals are all on one side of it. */
static void triangleWritePov(const Object *object, double scale, Text *pov)
{
    const Triangle *triangle = &object->triangle;
    bool inMesh = triangle->isSmooth &&
                  !normalsAgree(object, normalize(areaNormal(triangle->vertices)), triangle->normals);
    textAppend(pov, inMesh ? "mesh { " : "");
    textAppend(pov, triangle->isSmooth ? "smooth_triangle { " : "triangle { ");
    for (int i = 0; i < 3; i++) {
        if (i > 0)
            textAppend(pov, ", ");
        textAppendPovVector(pov, triangle->vertices[i], scale);
        if (triangle->isSmooth) {
            textAppend(pov, ", ");
            textAppendPovVector(pov, triangle->normals[i], 1);
        }
    }
    textAppend(pov, inMesh ? " }" : "");
}

const Shape triangleShape = {.name = "triangle",
                             .intersect = triangleIntersect,
                             .normal = triangleNormal,
                             .flatNormal = triangleFlatNormal,
                             .contains = containsNothing,
                             .hasInside = alwaysFalse,
                             .bounds = triangleBounds,
                             .magnitude = triangleMagnitude,
                             .writePov = triangleWritePov};
