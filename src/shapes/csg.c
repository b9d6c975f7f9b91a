/* csg.c - solids made of solids; see csg.h.
 *
 * A point on the surface of a part is on the surface of the whole if the other parts let it be: for a union
 * it must be outside all of them, for an intersection inside all, for a difference outside what is taken
 * away and, on what is taken away, inside the first (Roth 1982, "Ray casting for modeling solids", section
 * 3, by points in place of intervals, as POV-Ray does). The surface keeps the material of its part: a cut
 * shows that of the cutter.
 */
#include "shapes/csg.h"

#include "shapes/shape.h"

#include <stdlib.h>

/* Whether the part lets a point of another part's surface be on the surface of the whole. */
static bool admits(const Csg *csg, size_t part, Vector3D point)
{
    bool inside = objectContains(&csg->parts[part], point);
    switch (csg->operation) {
    case CSG_GROUP:
        return true;
    case CSG_UNION:
        return !inside;
    case CSG_INTERSECTION:
        return inside;
    default:
        return part == 0 ? inside : !inside;
    }
}

static void csgIntersect(const Object *object, const Ray *ray, HitSink *sink)
{
    const Csg *csg = &object->csg;
    for (size_t i = 0; i < csg->partCount; i++) {
        /* Find every hit of the part, then keep those that the other parts admit. */
        HitSink own = createHitSink(0, true);
        intersectObject(&csg->parts[i], ray, &own);
        for (size_t h = 0; h < own.count; h++) {
            const Hit *hit = &own.all[h];
            if (!sink->keepAll && !(hit->distance < sink->nearest.distance))
                continue;
            Vector3D position = pointOnRay(ray, hit->distance);
            bool kept = true;
            for (size_t j = 0; j < csg->partCount && kept; j++)
                kept = j == i || admits(csg, j, position);
            if (kept) {
                sink->current = hit->object;
                reportHit(sink, hit->distance, hit->part, hit->u, hit->v);
            }
        }
        sink->outOfMemory |= own.outOfMemory;
        freeHitSink(&own);
    }
    sink->current = object;
}

/* Hits carry the part they are on, so nobody asks the whole for a normal. */
static Vector3D csgNormal(const Object *object, const Hit *hit, Vector3D position)
{
    (void)object;
    (void)hit;
    (void)position;
    return createVector(0, 0, 1);
}

static bool csgContains(const Object *object, Vector3D point)
{
    const Csg *csg = &object->csg;
    if (csg->operation == CSG_UNION || csg->operation == CSG_GROUP) {
        for (size_t i = 0; i < csg->partCount; i++)
            if (objectContains(&csg->parts[i], point))
                return true;
        return false;
    }
    for (size_t i = 0; i < csg->partCount; i++)
        if (!admits(csg, i, point))
            return false;
    return true;
}

/* Of a union the box round all parts, of an intersection what their boxes share, of a difference the
 * first's. */
static bool csgBounds(const Object *object, Bounds *bounds)
{
    const Csg *csg = &object->csg;
    if (csg->operation == CSG_DIFFERENCE)
        return objectBounds(&csg->parts[0], bounds);
    bool isUnion = csg->operation == CSG_UNION || csg->operation == CSG_GROUP;
    bool found = false;
    Bounds all = {{0, 0, 0}, {0, 0, 0}};
    for (size_t i = 0; i < csg->partCount; i++) {
        Bounds part;
        if (!objectBounds(&csg->parts[i], &part)) {
            if (isUnion)
                return false;
            continue;
        }
        if (!found) {
            all = part;
        } else if (isUnion) {
            all.min = createVector(fmin(all.min.x, part.min.x), fmin(all.min.y, part.min.y),
                                   fmin(all.min.z, part.min.z));
            all.max = createVector(fmax(all.max.x, part.max.x), fmax(all.max.y, part.max.y),
                                   fmax(all.max.z, part.max.z));
        } else {
            all.min = createVector(fmax(all.min.x, part.min.x), fmax(all.min.y, part.min.y),
                                   fmax(all.min.z, part.min.z));
            all.max = createVector(fmin(all.max.x, part.max.x), fmin(all.max.y, part.max.y),
                                   fmin(all.max.z, part.max.z));
        }
        found = true;
    }
    if (found)
        *bounds = all;
    return found;
}

static double csgMagnitude(const Object *object)
{
    double largest = 0;
    for (size_t i = 0; i < object->csg.partCount; i++) {
        const Object *part = &object->csg.parts[i];
        double own = objectShape(part)->magnitude(part);
        if (part->transform != NULL)
            own = matrixNorm(&part->transform->worldFromObject) * own +
                  largestCoordinate(part->transform->worldFromObject.translate);
        largest = fmax(largest, own);
    }
    return largest;
}

/* Its parts are whole objects with materials, so the exporter writes them; only the word is here. */
static void csgWritePov(const Object *object, double scale, Text *pov)
{
    (void)scale;
    const char *words[] = {[CSG_UNION] = "merge",
                           [CSG_GROUP] = "union",
                           [CSG_INTERSECTION] = "intersection",
                           [CSG_DIFFERENCE] = "difference"};
    textAppendFormat(pov, "%s {", words[object->csg.operation]);
}

static void csgRelease(Object *object)
{
    for (size_t i = 0; i < object->csg.partCount; i++)
        releaseObject(&object->csg.parts[i]);
    free(object->csg.parts);
    object->csg.parts = NULL;
    object->csg.partCount = 0;
}

const Shape csgShape = {.name = "csg",
                        .intersect = csgIntersect,
                        .normal = csgNormal,
                        .contains = csgContains,
                        .hasInside = alwaysTrue,
                        .bounds = csgBounds,
                        .magnitude = csgMagnitude,
                        .writePov = csgWritePov,
                        .release = csgRelease};
