/* referee.c - see referee.h. */
#include "engine/referee.h"

#include "shapes/mesh_build.h"

/* As meshIntersect of one triangle: it is met in the mesh's own space, where the ray is of unit length again.
 */
static double meetTriangle(const CompiledScene *compiled, MeshPart part, const Ray *ray, double above,
                           Hit *hit)
{
    const Object *object = &compiled->scene->objects[part.object];
    Ray local = *ray;
    double scale = 1;
    if (object->transform != NULL)
        local = rayInObjectSpace(object->transform, ray, &scale);
    Vector3D p[3];
    meshCorners(object->mesh.data, part.triangle, p);
    ShearedRay sheared = shearRay(&local);
    TriangleHit met;
    if (!intersectTriangle(&sheared, p[0], p[1], p[2], &met))
        return INFINITY;
    double distance = met.distance * scale;
    if (!(distance > above) || !(distance < INFINITY))
        return INFINITY;
    *hit = (Hit){distance, object, (int)part.triangle, met.share1, met.share2};
    return distance;
}

static double meetObject(const Object *object, const Ray *ray, double above, Hit *hit)
{
    HitSink sink = createHitSink(above, false);
    intersectObject(object, ray, &sink);
    if (sink.nearest.distance < INFINITY)
        *hit = sink.nearest;
    return sink.nearest.distance;
}

static double meetAbove(const CompiledScene *compiled, int32_t primitive, const Ray *ray, double above,
                        Hit *hit)
{
    if (primitiveKind(compiled, primitive) == PRIMITIVE_TRIANGLE)
        return meetTriangle(compiled, compiled->triangles[(size_t)primitive - compiled->sphereCount], ray,
                            above, hit);
    return meetObject(&compiled->scene->objects[primitiveObject(compiled, primitive)], ray, above, hit);
}

double meetPrimitive(const CompiledScene *compiled, int32_t primitive, const Ray *ray, Hit *hit)
{
    return meetAbove(compiled, primitive, ray, 0, hit);
}

bool primitiveBlocks(const CompiledScene *compiled, int32_t primitive, const ShadowRay *shadow)
{
    Hit hit;
    return meetAbove(compiled, primitive, &shadow->ray, shadow->above, &hit) < shadow->farthest;
}

bool primitiveIsPassed(const CompiledScene *compiled, int32_t primitive, Vector3D start,
                       const ArrivingLight *light)
{
    if (primitiveKind(compiled, primitive) != PRIMITIVE_TRIANGLE || !isfinite(light->distance))
        return false;
    MeshPart part = compiled->triangles[(size_t)primitive - compiled->sphereCount];
    const Object *object = &compiled->scene->objects[part.object];
    if (object->transform != NULL)
        return false;
    Vector3D p[3];
    meshCorners(object->mesh.data, part.triangle, p);
    Vector3D normal = triangleCross(p);
    double startSide = dot(normal, subVectors(start, p[0]));
    double lightSide = dot(normal, subVectors(light->position, p[0]));
    /* The distance of the start from the plane decides the sign of the hit's, which rounding cannot turn when
     * it is this large; the light is far from the plane, so that the hit is not next to it. */
    double size = norm(normal) * (largestCoordinate(start) + largestCoordinate(p[0]));
    double lightSize = size + norm(normal) * largestCoordinate(light->position);
    double margin = 0x1p-46 * size, lightMargin = 0x1p-30 * lightSize;
    return (startSide > margin && lightSide > lightMargin) ||
           (startSide < -margin && lightSide < -lightMargin);
}

void meetEndless(const CompiledScene *compiled, const Ray *ray, Hit *hit, uint32_t *object)
{
    hit->distance = INFINITY;
    *object = UINT32_MAX;
    size_t plane = 0, other = 0;
    while (plane < compiled->planeCount || other < compiled->endlessCount) {
        /* Take both lists in the order of the scene. */
        bool isPlane =
            other == compiled->endlessCount ||
            (plane < compiled->planeCount && compiled->planes[plane].object < compiled->endless[other]);
        uint32_t number = isPlane ? compiled->planes[plane++].object : compiled->endless[other++];
        Hit own;
        if (meetObject(&compiled->scene->objects[number], ray, 0, &own) < hit->distance) {
            *hit = own;
            *object = number;
        }
    }
}

bool endlessBlocks(const CompiledScene *compiled, const ShadowRay *shadow)
{
    Hit hit;
    for (size_t i = 0; i < compiled->planeCount; i++)
        if (compiled->planes[i].castsShadow &&
            meetObject(&compiled->scene->objects[compiled->planes[i].object], &shadow->ray, shadow->above,
                       &hit) < shadow->farthest)
            return true;
    for (size_t i = 0; i < compiled->endlessCount; i++)
        if (!objectSkipsShadow(compiled, compiled->endless[i]) &&
            meetObject(&compiled->scene->objects[compiled->endless[i]], &shadow->ray, shadow->above, &hit) <
                shadow->farthest)
            return true;
    return false;
}

bool comesFirst(const CompiledScene *compiled, int32_t primitive, int32_t other)
{
    uint32_t object = primitiveObject(compiled, primitive), otherObject = primitiveObject(compiled, other);
    return object != otherObject ? object < otherObject : primitive < other;
}
