/* random_shapes.c - shapes at random; see random_shapes.h. */
#include "random_shapes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static uint64_t seed = 88172645463325252u;

double randomUnit(void)
{
    seed ^= seed >> 12;
    seed ^= seed << 25;
    seed ^= seed >> 27;
    return (double)((seed * 2685821657736338717u) >> 11) * 0x1p-53;
}

double randomIn(double low, double high)
{
    return low + (high - low) * randomUnit();
}

Vector3D randomVector(double size)
{
    return createVector(randomIn(-size, size), randomIn(-size, size), randomIn(-size, size));
}

Vector3D randomDirection(void)
{
    for (;;) {
        Vector3D v = randomVector(1);
        double squared = dot(v, v);
        if (squared > 1e-6 && squared <= 1)
            return normalize(v);
    }
}

Ray rayFromTo(Vector3D from, Vector3D to)
{
    return createRay(from, normalize(subVectors(to, from)));
}

/* A length of very different magnitudes. */
static double randomPart(double size)
{
    return size * pow(10, randomIn(-3, 0));
}

Object randomObject(ShapeKind kind, double size)
{
    Material material = defaultMaterial();
    Vector3D at = randomVector(size);
    double part = randomPart(size);
    Object object = {.kind = kind};
    switch (kind) {
    case SHAPE_SPHERE:
        object.sphere = createSphere(at, part, material);
        break;
    case SHAPE_CUBE:
        object.cube = createCube(at, part, material);
        break;
    case SHAPE_BOX:
        object.box = createBox(at, addVectors(at, createVector(part, 2 * part, part / 3)), material);
        break;
    case SHAPE_TRIANGLE: {
        const Vector3D vertices[3] = {at, addVectors(at, multVector(randomDirection(), part)),
                                      addVectors(at, multVector(randomDirection(), randomPart(size)))};
        Vector3D flat =
            normalize(cross(subVectors(vertices[1], vertices[0]), subVectors(vertices[2], vertices[0])));
        Vector3D normals[3];
        for (int i = 0; i < 3; i++)
            normals[i] = addVectors(multVector(flat, 2), randomDirection());
        object.triangle = createTriangle(vertices, randomUnit() < 0.5 ? normals : NULL, material);
        break;
    }
    case SHAPE_CONE: {
        Vector3D top = addVectors(at, multVector(randomDirection(), randomPart(size)));
        double shape = randomUnit();
        double other = shape < 0.3 ? part : shape < 0.5 ? 0 : randomPart(size);
        if (randomUnit() < 0.5)
            object.cone = createCone(at, top, part, other, randomUnit() < 0.3, material);
        else
            object.cone = createCone(at, top, other, part, randomUnit() < 0.3, material);
        break;
    }
    case SHAPE_DISC:
        object.disc =
            createDisc(at, randomDirection(), part, randomUnit() < 0.5 ? 0 : part * randomUnit(), material);
        break;
    case SHAPE_TORUS:
        object.torus =
            createTorus(part, randomUnit() < 0.1 ? part : part * pow(10, randomIn(-3, 0)), material);
        break;
    default:
        object.kind = SHAPE_PLANE;
        object.plane = createPlane(at, randomDirection(), material);
    }
    return object;
}

Object randomSolid(double size)
{
    const ShapeKind solids[] = {SHAPE_SPHERE, SHAPE_CUBE, SHAPE_BOX, SHAPE_CONE, SHAPE_TORUS, SHAPE_PLANE};
    for (;;) {
        Object object = randomObject(solids[(int)(randomUnit() * 6)], size);
        if (object.kind == SHAPE_CONE)
            object.cone.isOpen = false;
        Bounds bounds;
        if (!objectShape(&object)->bounds(&object, &bounds) ||
            largestCoordinate(subVectors(bounds.max, bounds.min)) > size / 2)
            return object;
    }
}

Transform randomTransform(double size)
{
    for (;;) {
        Matrix first = rotationMatrix(randomDirection(), randomIn(-180, 180));
        Matrix second = scalingMatrix(createVector(randomIn(-3, 3), randomIn(-3, 3), randomIn(-3, 3)));
        Matrix third = {
            .x = {1, randomIn(-1, 1), 0}, .y = {0, 1, randomIn(-1, 1)}, .z = {randomIn(-1, 1), 0, 1}};
        Matrix fourth = translationMatrix(randomVector(size));
        Matrix all = composeMatrices(&first, &second);
        all = composeMatrices(&all, &third);
        all = composeMatrices(&all, &fourth);
        Transform transform;
        if (createTransform(&all, &transform) && matrixNorm(&transform.objectFromWorld) < 6)
            return transform;
    }
}

Vector3D randomTarget(const Object *object, double size)
{
    Bounds bounds;
    if (object->kind == SHAPE_TRIANGLE) {
        const Vector3D *v = object->triangle.vertices;
        double w = 1 - sqrt(randomUnit()), u = (1 - w) * randomUnit();
        return addVectors(multVector(v[0], 1 - u - w), addVectors(multVector(v[1], u), multVector(v[2], w)));
    }
    if (objectShape(object)->bounds(object, &bounds))
        return createVector(randomIn(bounds.min.x, bounds.max.x), randomIn(bounds.min.y, bounds.max.y),
                            randomIn(bounds.min.z, bounds.max.z));
    return addVectors(object->kind == SHAPE_PLANE ? object->plane.point : randomVector(size),
                      randomVector(size * 0.01));
}

/* ---- Distances, by the textbook ---- */

/* From a point to a line segment. */
static double distanceToSegment(Vector3D p, Vector3D from, Vector3D to)
{
    Vector3D along = subVectors(to, from);
    double t = dot(subVectors(p, from), along) / dot(along, along);
    Vector3D nearest = addVectors(from, multVector(along, fmax(0, fmin(1, t))));
    return norm(subVectors(p, nearest));
}

static double distanceToTriangle(const Vector3D v[3], Vector3D p)
{
    Vector3D n = normalize(cross(subVectors(v[1], v[0]), subVectors(v[2], v[0])));
    double nearestEdge = INFINITY;
    bool above = true;
    for (int i = 0; i < 3; i++) {
        Vector3D from = v[i], to = v[(i + 1) % 3];
        above = above && dot(n, cross(subVectors(to, from), subVectors(p, from))) >= 0;
        nearestEdge = fmin(nearestEdge, distanceToSegment(p, from, to));
    }
    return above ? fabs(dot(n, subVectors(p, v[0]))) : nearestEdge;
}

/* In the half-plane through an axis the surface is a line or two: (across, along) from the axis' start. */
static Vector3D inHalfPlane(Vector3D p, Vector3D start, Vector3D axis)
{
    Vector3D fromStart = subVectors(p, start);
    double along = dot(fromStart, axis);
    return createVector(norm(subVectors(fromStart, multVector(axis, along))), along, 0);
}

static double distanceToCone(const Cone *cone, Vector3D p)
{
    Vector3D axis = subVectors(cone->top, cone->base);
    double height = norm(axis);
    Vector3D at = inHalfPlane(p, cone->base, multVector(axis, 1 / height));
    Vector3D base = createVector(cone->baseRadius, 0, 0), top = createVector(cone->topRadius, height, 0);
    double distance = distanceToSegment(at, base, top);
    if (cone->isOpen)
        return distance;
    if (cone->baseRadius > 0)
        distance = fmin(distance, distanceToSegment(at, createVector(0, 0, 0), base));
    if (cone->topRadius > 0)
        distance = fmin(distance, distanceToSegment(at, createVector(0, height, 0), top));
    return distance;
}

double distanceToSurface(const Object *object, Vector3D p)
{
    switch (object->kind) {
    case SHAPE_SPHERE:
        return fabs(norm(subVectors(p, object->sphere.center)) - object->sphere.radius);
    case SHAPE_PLANE:
        return fabs(dot(object->plane.normal, subVectors(p, object->plane.point)));
    case SHAPE_TRIANGLE:
        return distanceToTriangle(object->triangle.vertices, p);
    case SHAPE_CONE:
        return distanceToCone(&object->cone, p);
    case SHAPE_DISC: {
        const Disc *disc = &object->disc;
        Vector3D at = inHalfPlane(p, disc->center, disc->normal);
        return distanceToSegment(at, createVector(disc->innerRadius, 0, 0), createVector(disc->radius, 0, 0));
    }
    case SHAPE_TORUS:
        return fabs(hypot(hypot(p.x, p.z) - object->torus.majorRadius, p.y) - object->torus.minorRadius);
    default: {
        Bounds bounds;
        objectShape(object)->bounds(object, &bounds);
        double dx = fmax(bounds.min.x - p.x, p.x - bounds.max.x);
        double dy = fmax(bounds.min.y - p.y, p.y - bounds.max.y);
        double dz = fmax(bounds.min.z - p.z, p.z - bounds.max.z);
        return fabs(fmax(dx, fmax(dy, dz)));
    }
    }
}

bool boundsHold(const Bounds *bounds, Vector3D p, double slack)
{
    return p.x >= bounds->min.x - slack && p.y >= bounds->min.y - slack && p.z >= bounds->min.z - slack &&
           p.x <= bounds->max.x + slack && p.y <= bounds->max.y + slack && p.z <= bounds->max.z + slack;
}

HitSink allHits(const Object *object, const Ray *ray)
{
    HitSink sink = createHitSink(0, true);
    intersectObject(object, ray, &sink);
    assert_false(sink.outOfMemory);
    sortHits(&sink);
    return sink;
}
