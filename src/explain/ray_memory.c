/* ray_memory.c - see ray_memory.h. */
#include "explain/ray_memory.h"

#include <stdlib.h>
#include <string.h>

enum {
    MOST_REMEMBERED = 128 /* rays of each kind and pixel; more are traced each time */
};

void freePixelMemory(PixelMemory *memory)
{
    free(memory->hits);
    free(memory->lights);
    *memory = (PixelMemory){0};
}

static const RememberingFinder *rememberingOf(const SurfaceFinder *finder)
{
    return (const RememberingFinder *)(const void *)finder;
}

/* Room for one more of size bytes after count of them, which grow by doubling; NULL where no more are
 * remembered, and then they stay as they are. */
static void *roomFor(void *items, size_t count, size_t size)
{
    if (count >= MOST_REMEMBERED)
        return NULL;
    bool isFull = count == 0 || (count >= 4 && (count & (count - 1)) == 0);
    return isFull ? realloc(items, (count < 4 ? 4 : 2 * count) * size) : items;
}

static const Object *findNearest(const SurfaceFinder *finder, const Ray *ray, Hit *hit)
{
    const RememberingFinder *remembering = rememberingOf(finder);
    RayCursor *cursor = remembering->cursor;
    PixelMemory *pixel = cursor->pixel;
    size_t count = pixel != NULL ? pixel->hitCount : 0;
    for (size_t i = 0, at = cursor->nextHit; i < count; i++, at++) {
        const RememberedHit *known = &pixel->hits[at < count ? at : at - count];
        if (memcmp(&known->ray, ray, sizeof *ray) != 0)
            continue;
        cursor->nextHit = (at < count ? at : at - count) + 1;
        if (known->object != NULL)
            *hit = known->hit;
        return known->object;
    }
    const Object *object = remembering->base->nearest(remembering->base, ray, hit);
    RememberedHit *hits = pixel != NULL ? roomFor(pixel->hits, count, sizeof *hits) : NULL;
    if (hits != NULL) {
        pixel->hits = hits;
        hits[count] = (RememberedHit){.ray = *ray, .object = object};
        if (object != NULL)
            hits[count].hit = *hit;
        pixel->hitCount = count + 1;
        cursor->nextHit = count + 1;
    }
    return object;
}

static bool isSameShadow(const RememberedLight *known, const ShadowRay *shadow, Color3f color)
{
    return memcmp(&known->shadow, shadow, sizeof *shadow) == 0 &&
           memcmp(&known->color, &color, sizeof color) == 0;
}

static Color3f findLight(const SurfaceFinder *finder, const ShadowRay *shadow, Color3f color)
{
    const RememberingFinder *remembering = rememberingOf(finder);
    RayCursor *cursor = remembering->cursor;
    PixelMemory *pixel = cursor->pixel;
    size_t count = pixel != NULL ? pixel->lightCount : 0;
    for (size_t i = 0, at = cursor->nextLight; i < count; i++, at++) {
        const RememberedLight *known = &pixel->lights[at < count ? at : at - count];
        if (!isSameShadow(known, shadow, color))
            continue;
        cursor->nextLight = (at < count ? at : at - count) + 1;
        return known->left;
    }
    Color3f left = remembering->base->lightAlong(remembering->base, shadow, color);
    RememberedLight *lights = pixel != NULL ? roomFor(pixel->lights, count, sizeof *lights) : NULL;
    if (lights != NULL) {
        pixel->lights = lights;
        lights[count] = (RememberedLight){.shadow = *shadow, .color = color, .left = left};
        pixel->lightCount = count + 1;
        cursor->nextLight = count + 1;
    }
    return left;
}

void createRememberingFinder(const SurfaceFinder *base, RayCursor *cursor, RememberingFinder *finder)
{
    *finder =
        (RememberingFinder){.finder = {.scene = base->scene, .nearest = findNearest, .lightAlong = findLight},
                            .base = base,
                            .cursor = cursor};
}
