/* shape.c - the table of shapes, and what all shapes share: transforms and hits; see shape.h. */
#include "shapes/shape.h"

#include <stdlib.h>

static const Shape *const shapes[SHAPE_COUNT] = {
#define X(kind, Type, name) [kind] = &name##Shape,
    SHAPES(X)
#undef X
};

const Shape *objectShape(const Object *object)
{
    return shapes[object->kind];
}

bool alwaysTrue(const Object *object)
{
    (void)object;
    return true;
}

bool alwaysFalse(const Object *object)
{
    (void)object;
    return false;
}

bool containsNothing(const Object *object, Vector3D point)
{
    (void)object;
    (void)point;
    return false;
}

void releaseObject(Object *object)
{
    if (objectShape(object)->release != NULL)
        objectShape(object)->release(object);
}

/* ---- Hits ---- */

HitSink createHitSink(double above, bool keepAll)
{
    return (HitSink){.above = above, .keepAll = keepAll, .nearest.distance = INFINITY, .scale = 1};
}

void freeHitSink(HitSink *sink)
{
    free(sink->all);
    sink->all = NULL;
    sink->count = sink->capacity = 0;
}

void reportHit(HitSink *sink, double distance, int part, double u, double v)
{
    distance *= sink->scale;
    if (!(distance > sink->above) || !(distance < INFINITY))
        return;
    Hit hit = {distance, sink->current, part, u, v};
    if (distance < sink->nearest.distance)
        sink->nearest = hit;
    if (!sink->keepAll)
        return;
    if (sink->count == sink->capacity) {
        size_t capacity = sink->capacity < 16 ? 16 : 2 * sink->capacity;
        Hit *all = realloc(sink->all, capacity * sizeof *all);
        if (all == NULL) {
            sink->outOfMemory = true;
            return;
        }
        sink->all = all;
        sink->capacity = capacity;
    }
    sink->all[sink->count++] = hit;
}

static int compareDistances(const void *a, const void *b)
{
    double first = ((const Hit *)a)->distance, second = ((const Hit *)b)->distance;
    return (first > second) - (first < second);
}

void sortHits(HitSink *sink)
{
    if (sink->count > 0)
        qsort(sink->all, sink->count, sizeof *sink->all, compareDistances);
}

/* ---- Between world and object space ---- */

Ray rayInObjectSpace(const Transform *transform, const Ray *ray, double *scale)
{
    const Matrix *inverse = &transform->objectFromWorld;
    Vector3D direction = transformDirection(inverse, ray->direction);
    double length = norm(direction);
    *scale = 1 / length;
    return createRay(transformPoint(inverse, ray->origin), multVector(direction, 1 / length));
}

void intersectObject(const Object *object, const Ray *ray, HitSink *sink)
{
    sink->current = object;
    sink->scale = 1;
    if (object->transform == NULL) {
        objectShape(object)->intersect(object, ray, sink);
        return;
    }
    Ray local = rayInObjectSpace(object->transform, ray, &sink->scale);
    objectShape(object)->intersect(object, &local, sink);
    sink->scale = 1;
}

Vector3D objectSpacePoint(const Object *object, Vector3D worldPoint)
{
    return object->transform != NULL ? transformPoint(&object->transform->objectFromWorld, worldPoint)
                                     : worldPoint;
}

Vector3D objectNormal(const Ray *ray, const Hit *hit, Vector3D position)
{
    const Object *object = hit->object;
    Vector3D n = objectShape(object)->normal(object, hit, objectSpacePoint(object, position));
    if (object->transform != NULL)
        n = normalize(transformNormal(&object->transform->objectFromWorld, n));
    return turnedToRay(n, ray);
}

Vector3D objectFlatNormal(const Hit *hit, Vector3D normal)
{
    const Object *object = hit->object;
    if (objectShape(object)->flatNormal == NULL)
        return normal;
    Vector3D n = objectShape(object)->flatNormal(object, hit);
    return object->transform != NULL ? normalize(transformNormal(&object->transform->objectFromWorld, n)) : n;
}

bool objectContains(const Object *object, Vector3D point)
{
    return objectShape(object)->contains(object, objectSpacePoint(object, point));
}

bool objectBounds(const Object *object, Bounds *bounds)
{
    Bounds own;
    if (!objectShape(object)->bounds(object, &own))
        return false;
    if (object->transform == NULL) {
        *bounds = own;
        return true;
    }
    /* The box round the eight corners, moved to world space. */
    *bounds = (Bounds){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int corner = 0; corner < 8; corner++) {
        Vector3D p = createVector(corner & 1 ? own.max.x : own.min.x, corner & 2 ? own.max.y : own.min.y,
                                  corner & 4 ? own.max.z : own.min.z);
        p = transformPoint(&object->transform->worldFromObject, p);
        bounds->min =
            createVector(fmin(bounds->min.x, p.x), fmin(bounds->min.y, p.y), fmin(bounds->min.z, p.z));
        bounds->max =
            createVector(fmax(bounds->max.x, p.x), fmax(bounds->max.y, p.y), fmax(bounds->max.z, p.z));
    }
    return true;
}

double hitMagnitude(const Object *object, const Ray *ray, double distance)
{
    double world = largestCoordinate(ray->origin) + distance;
    double own = objectShape(object)->magnitude(object);
    if (object->transform == NULL)
        return world + own;
    const Matrix *matrix = &object->transform->worldFromObject;
    const Matrix *inverse = &object->transform->objectFromWorld;
    double inObjectSpace = matrixNorm(inverse) * world + largestCoordinate(inverse->translate) + own;
    return world + largestCoordinate(matrix->translate) + matrixNorm(matrix) * inObjectSpace;
}

Material materialAt(const Object *object, Vector3D worldPoint)
{
    Material material = object->material;
    if (material.pattern != NULL)
        material.diffuse = patternColor(material.pattern, objectSpacePoint(object, worldPoint));
    return material;
}

Intersection intersectionAt(const Ray *ray, const Hit *hit)
{
    Vector3D position = pointOnRay(ray, hit->distance);
    return (Intersection){.distance = hit->distance,
                          .position = position,
                          .normal = objectNormal(ray, hit, position),
                          .material = materialAt(hit->object, position)};
}

bool intersectsObject(const Ray *ray, const Object *object, Intersection *intersection)
{
    HitSink sink = createHitSink(0, false);
    intersectObject(object, ray, &sink);
    if (!(sink.nearest.distance < INFINITY))
        return false;
    *intersection = intersectionAt(ray, &sink.nearest);
    return true;
}

/* ---- POV-Ray ---- */

void textAppendPovNumber(Text *pov, double value)
{
    textAppendDouble(pov, value);
}

void textAppendPovVector(Text *pov, Vector3D v, double scale)
{
    textAppend(pov, "<");
    textAppendPovNumber(pov, v.x * scale);
    textAppend(pov, ", ");
    textAppendPovNumber(pov, v.y * scale);
    textAppend(pov, ", ");
    textAppendPovNumber(pov, v.z * scale);
    textAppend(pov, ">");
}
