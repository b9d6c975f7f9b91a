/* ray_memory.h - what rays met, remembered, so that pixels can be shaded again without tracing them again.
 *
 * Mistakes in the light leave the rays as they are: the same ray meets the same surface, and the same of each
 * lamp is left on its way. So what was found for a ray of a pixel is found again for the same ray, and what
 * is predicted is the same with and without a memory.
 */
#ifndef ECLAIRAGE_EXPLAIN_RAY_MEMORY_H
#define ECLAIRAGE_EXPLAIN_RAY_MEMORY_H

#include "raytracer.h"

#include <stddef.h>

typedef struct RememberedHit {
    Ray ray;
    const Object *object; /* NULL: it met nothing */
    Hit hit;
} RememberedHit;

typedef struct RememberedLight {
    ShadowRay shadow;
    Color3f color, left; /* before and after */
} RememberedLight;

/* The rays of one pixel; begins as {0}. */
typedef struct PixelMemory {
    RememberedHit *hits; /* owned, as are the lights */
    RememberedLight *lights;
    size_t hitCount, lightCount;
} PixelMemory;

void freePixelMemory(PixelMemory *memory);

/* Where a thread is among the rays of a pixel, which mostly come in the order of the time before. */
typedef struct RayCursor {
    PixelMemory *pixel; /* NULL: nothing is remembered */
    size_t nextHit, nextLight;
} RayCursor;

/* From now on the rays are those of this pixel. */
static inline void beginPixel(RayCursor *cursor, PixelMemory *pixel)
{
    *cursor = (RayCursor){.pixel = pixel};
}

/* A finder that remembers; begins with its SurfaceFinder. For one thread. */
typedef struct RememberingFinder {
    SurfaceFinder finder;
    const SurfaceFinder *base;
    RayCursor *cursor;
} RememberingFinder;

/* Fill *finder, which lives as long as base and cursor and must not be copied afterwards. */
void createRememberingFinder(const SurfaceFinder *base, RayCursor *cursor, RememberingFinder *finder);

#endif
