/* csg.c - solids made of solids; see csg.h.
 *
 * A point on the surface of a part is on the surface of the whole if the other parts let it be: for a union
 * it must be outside all of them, for an intersection inside all, for a difference outside what is taken
 * away and, on what is taken away, inside the first (Roth 1982, "Ray casting for modeling solids", section
 * 3, by points in place of intervals, as POV-Ray does). The surface keeps the material of its part: a cut
 * shows that of the cutter.
 *
 * Where the surfaces of two parts coincide, rounding would decide whether a point of one is inside the other.
 * So the space on both sides of the surface is looked at, a little more than rounding away: what matters is
 * whether a solid is there (Requicha 1980, "Representations for rigid solids", section 4, regularized sets).
 */
#include "shapes/csg.h"

#include "shapes/shape.h"

#include <stdlib.h>

/* How far from the surface its two sides are looked at, as a share of the numbers that the hit is computed
 * from; their rounding is some 2^-50. */
#define SIDE_DISTANCE 0x1p-40

/* Only where the ray meets another part as near as this do surfaces coincide, as a share of the same numbers;
 * wide, as rounding moves hits of rays along a surface far. */
#define NEAR_DISTANCE 0x1p-24

/* Whether the part lets a point of another part, inside or outside of it, be in the whole or on its surface.
 */
static bool admits(const Csg *csg, size_t part, bool inside)
{
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

/* Whether the part's surface stays where another part's coincides with it; sameSide: the two solids are on
 * the same side of it. Of surfaces that both stay the first counts, of an intersection the last, as in
 * POV-Ray. */
static bool keepsShared(const Csg *csg, size_t part, size_t other, bool sameSide)
{
    switch (csg->operation) {
    case CSG_GROUP:
        return true;
    case CSG_UNION: /* a wall between two solids is within the whole */
        return sameSide && part < other;
    case CSG_INTERSECTION: /* what two solids share that only touch is flat */
        return sameSide && part > other;
    default: /* a cut that ends in the first's surface opens it; one that only touches it leaves it */
        if (part == 0 || other == 0)
            return part == 0 && !sameSide;
        return sameSide && part < other;
    }
}

/* From the hit a little towards a point within the shape that it is on, so that the edge of a face counts as
 * a place within the face, and a seam between two other parts as a place in one of them: the point is none
 * that round numbers give. */
static Vector3D stepInwards(const Hit *hit, Vector3D position, double distance)
{
    Bounds bounds;
    if (!objectBounds(hit->object, &bounds))
        return createVector(0, 0, 0);
    Vector3D size = subVectors(bounds.max, bounds.min);
    Vector3D within = addVectors(bounds.min, createVector(0.37 * size.x, 0.59 * size.y, 0.43 * size.z));
    Vector3D inwards = subVectors(within, position);
    double length = norm(inwards);
    return multVector(inwards, length > 0 ? distance / length : 0);
}

/* Whether a hit of a part is on the surface of the whole, for any surfaces that coincide. */
static bool isOnWholeBySides(const Object *object, size_t part, const Ray *ray, const Hit *hit)
{
    const Csg *csg = &object->csg;
    Vector3D position = pointOnRay(ray, hit->distance);
    Vector3D normal = objectFlatNormal(hit, objectNormal(ray, hit, position));
    double magnitude =
        fmax(hitMagnitude(hit->object, ray, hit->distance), hitMagnitude(object, ray, hit->distance));
    Vector3D step = multVector(normal, magnitude * SIDE_DISTANCE);
    Vector3D middle = addVectors(position, stepInwards(hit, position, magnitude * SIDE_DISTANCE / 4));
    Vector3D before = addVectors(middle, step), behind = subVectors(middle, step);
    for (size_t i = 0; i < csg->partCount; i++) {
        if (i == part)
            continue;
        bool inside = objectContains(&csg->parts[i], before);
        bool isShared = inside != objectContains(&csg->parts[i], behind);
        if (isShared ? !keepsShared(csg, part, i, inside == objectContains(&csg->parts[part], before))
                     : !admits(csg, i, inside))
            return false;
    }
    return true;
}

/* The same where no other surface is near. */
static bool isOnWhole(const Csg *csg, size_t part, Vector3D position)
{
    for (size_t i = 0; i < csg->partCount; i++)
        if (i != part && !admits(csg, i, objectContains(&csg->parts[i], position)))
            return false;
    return true;
}

/* Whether the ray meets any other part near the hit. own: the hits of all parts, those of this part from
 * first up to end. */
static bool hasHitNear(const HitSink *own, size_t first, size_t end, double distance, double near)
{
    for (size_t i = 0; i < own->count; i++)
        if ((i < first || i >= end) && fabs(own->all[i].distance - distance) <= near)
            return true;
    return false;
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

/* Report those of the hits that the other parts let be on the whole. ends: behind the last hit of each part.
 */
static void reportHitsOnWhole(const Object *object, const Ray *ray, const HitSink *own, const size_t *ends,
                              HitSink *sink)
{
    const Csg *csg = &object->csg;
    double near = (largestCoordinate(ray->origin) + csgMagnitude(object)) * NEAR_DISTANCE;
    for (size_t i = 0; i < csg->partCount; i++) {
        size_t first = i == 0 ? 0 : ends[i - 1];
        for (size_t h = first; h < ends[i]; h++) {
            const Hit *hit = &own->all[h];
            if (!sink->keepAll && !(hit->distance < sink->nearest.distance))
                continue;
            bool isKept = true;
            if (csg->operation != CSG_GROUP)
                isKept = hasHitNear(own, first, ends[i], hit->distance, near + hit->distance * NEAR_DISTANCE)
                             ? isOnWholeBySides(object, i, ray, hit)
                             : isOnWhole(csg, i, pointOnRay(ray, hit->distance));
            if (isKept) {
                sink->current = hit->object;
                reportHit(sink, hit->distance, hit->part, hit->u, hit->v);
            }
        }
    }
}

enum {
    FEW_PARTS = 16 /* for which no memory is asked */
};

static void csgIntersect(const Object *object, const Ray *ray, HitSink *sink)
{
    const Csg *csg = &object->csg;
    size_t fewEnds[FEW_PARTS];
    size_t *ends = csg->partCount <= FEW_PARTS ? fewEnds : malloc(csg->partCount * sizeof *ends);
    if (ends == NULL) {
        sink->outOfMemory = true;
        return;
    }
    /* Find every hit of every part, then keep those that the other parts admit. */
    HitSink own = createHitSink(0, true);
    for (size_t i = 0; i < csg->partCount; i++) {
        intersectObject(&csg->parts[i], ray, &own);
        ends[i] = own.count;
    }
    if (own.count > 0)
        reportHitsOnWhole(object, ray, &own, ends, sink);
    sink->outOfMemory |= own.outOfMemory;
    freeHitSink(&own);
    if (ends != fewEnds)
        free(ends);
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
        if (!admits(csg, i, objectContains(&csg->parts[i], point)))
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
