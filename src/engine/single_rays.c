/* single_rays.c - see single_rays.h. */
#include "engine/single_rays.h"

#include "engine/lanes/path.h"
#include "engine/referee.h"

static const CompiledScene *compiledOf(const SurfaceFinder *finder)
{
    return (const CompiledScene *)(const void *)finder;
}

static const Object *findNearest(const SurfaceFinder *finder, const Ray *ray, Hit *hit)
{
    const CompiledScene *compiled = compiledOf(finder);
    uint32_t object;
    meetEndless(compiled, ray, hit, &object);
    compiled->path->meetRay(compiled, ray, hit, &object);
    return hit->distance < INFINITY ? &compiled->scene->objects[object] : NULL;
}

static Color3f findLight(const SurfaceFinder *finder, const ShadowRay *shadow, Color3f color)
{
    const CompiledScene *compiled = compiledOf(finder);
    if (endlessBlocks(compiled, shadow) || compiled->path->blockRay(compiled, shadow))
        return createColor(0, 0, 0);
    if (compiled->transparentCount == 0)
        return color;
    return lightThroughObjects(compiled->scene, compiled->transparent, compiled->transparentCount, shadow,
                               color);
}

SurfaceFinder createSingleRays(const Scene *scene)
{
    return (SurfaceFinder){.scene = scene, .nearest = findNearest, .lightAlong = findLight};
}
