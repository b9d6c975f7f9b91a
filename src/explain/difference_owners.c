/* difference_owners.c - see difference_owners.h. */
#include "explain/difference_owners.h"

#include "base/cancel.h"

#include <math.h>
#include <stdlib.h>

/* What is noted of each object while pixels are traced. */
typedef struct Note {
    OwnerShare share;
    double majority;                  /* by how much its material leads in the vote of its pixels */
    size_t mirroredPixel, shadePixel; /* the last pixel, from 1, that was counted as such */
} Note;

/* A finder that notes what it meets on the way of a pixel's rays. */
typedef struct NotingFinder {
    SurfaceFinder finder;
    const SurfaceFinder *base;
    struct PixelNotes *pixel;
} NotingFinder;

typedef struct PixelNotes {
    Note *notes;   /* of all objects of the scene */
    size_t number; /* of the pixel, from 1 */
    bool isFirst;  /* the next surface is what the camera sees */
    bool differs;
    double weight;
} PixelNotes;

static const NotingFinder *notingOf(const SurfaceFinder *finder)
{
    return (const NotingFinder *)(const void *)finder;
}

/* The material that more than half of the votes are for, if there is one (Boyer and Moore's majority vote).
 */
static void voteForMaterial(Note *note, const Material *material, double weight)
{
    if (note->share.material == material) {
        note->majority += weight;
        return;
    }
    note->majority -= weight;
    if (note->majority < 0) {
        note->share.material = material;
        note->majority = -note->majority;
    }
}

static const Object *findNearest(const SurfaceFinder *finder, const Ray *ray, Hit *hit)
{
    const NotingFinder *noting = notingOf(finder);
    PixelNotes *pixel = noting->pixel;
    const Object *object = noting->base->nearest(noting->base, ray, hit);
    bool isFirst = pixel->isFirst;
    pixel->isFirst = false;
    if (object == NULL)
        return NULL;
    Note *note = &pixel->notes[object - finder->scene->objects];
    if (isFirst) {
        note->share.seen += pixel->weight;
        note->share.differing += pixel->differs ? pixel->weight : 0;
    } else if (pixel->differs && note->mirroredPixel != pixel->number) {
        note->share.mirrored += pixel->weight;
        note->mirroredPixel = pixel->number;
    }
    voteForMaterial(note, &hit->object->material, pixel->differs ? pixel->weight : 1e-6 * pixel->weight);
    return object;
}

static Color3f findLight(const SurfaceFinder *finder, const ShadowRay *shadow, Color3f color)
{
    const NotingFinder *noting = notingOf(finder);
    PixelNotes *pixel = noting->pixel;
    Hit hit;
    const Object *blocker = pixel->differs ? noting->base->nearest(noting->base, &shadow->ray, &hit) : NULL;
    if (blocker != NULL && hit.distance < shadow->farthest) {
        Note *note = &pixel->notes[blocker - finder->scene->objects];
        if (note->share.material == NULL)
            note->share.material = &hit.object->material;
        if (note->shadePixel != pixel->number) {
            note->share.shaded += pixel->weight;
            note->shadePixel = pixel->number;
        }
    }
    return noting->base->lightAlong(noting->base, shadow, color);
}

static bool differsFrom(const Evidence *evidence, const Prediction *right, size_t pixel)
{
    float stored[3], step = evidence->format.bitDepth == 8 ? 1.5f / 255 : 1.5f / 65535;
    ValueChange neutral = neutralValueChange();
    storedSamples(&neutral, evidence->format, &right->places[pixel], right->low[0] + 3 * pixel, stored);
    for (int c = 0; c < 3; c++)
        if (fabsf(stored[c] - evidence->pixels[pixel].samples[c]) > step)
            return true;
    return false;
}

static void tracePixels(const Truth *truth, const Evidence *evidence, const Prediction *right,
                        PixelNotes *pixel, DifferenceOwners *owners)
{
    const Scene *scene = truth->scene;
    NotingFinder noting = {.finder = {.scene = scene, .nearest = findNearest, .lightAlong = findLight},
                           .base = truth->finder,
                           .pixel = pixel};
    PixelRays rays = createPixelRays(scene, evidence->width, evidence->height, truth->transparent,
                                     truth->transparentCount);
    for (size_t i = 0; i < evidence->count && !cancelRequested(); i++) {
        const EvidencePixel *at = &evidence->pixels[i];
        pixel->number = i + 1;
        pixel->isFirst = true;
        pixel->weight = (double)at->weight;
        pixel->differs = differsFrom(evidence, right, i);
        Media media;
        Ray ray = pixelRay(&rays, at->x + 0.5, at->y + 0.5, &media);
        Hit hit;
        if (pixel->differs) {
            owners->differing += pixel->weight;
            if (truth->finder->nearest(truth->finder, &ray, &hit) == NULL)
                owners->onBackground += pixel->weight;
        }
        RayCounts counts = {0};
        traceRay(&noting.finder, &ray, &media, 1, &counts);
    }
}

static int compareShares(const void *a, const void *b)
{
    const OwnerShare *x = a, *y = b;
    if (x->differing != y->differing)
        return x->differing > y->differing ? -1 : 1;
    return x->object < y->object ? -1 : 1;
}

Status findDifferenceOwners(const Truth *truth, const Evidence *evidence, const Prediction *right,
                            DifferenceOwners *owners)
{
    size_t objects = truth->scene->objectCount, count = 0;
    *owners = (DifferenceOwners){0};
    PixelNotes pixel = {.notes = calloc(objects + 1, sizeof *pixel.notes)};
    if (pixel.notes == NULL)
        return statusOutOfMemory();
    tracePixels(truth, evidence, right, &pixel, owners);
    for (size_t i = 0; i < objects; i++)
        count += pixel.notes[i].share.material != NULL;
    OwnerShare *items = malloc((count + 1) * sizeof *items);
    if (items == NULL || cancelRequested()) {
        free(pixel.notes);
        free(items);
        return items == NULL ? statusOutOfMemory() : statusInterrupted();
    }
    for (size_t i = 0; i < objects; i++) {
        if (pixel.notes[i].share.material == NULL)
            continue;
        items[owners->count] = pixel.notes[i].share;
        items[owners->count++].object = i;
    }
    qsort(items, count, sizeof *items, compareShares);
    owners->items = items;
    free(pixel.notes);
    return statusOk();
}

void freeDifferenceOwners(DifferenceOwners *owners)
{
    free(owners->items);
    *owners = (DifferenceOwners){0};
}
