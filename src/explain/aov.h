/* aov.h - what else there is to say about each pixel: the pictures of `render --aov`.
 *
 * An AOV ("arbitrary output variable", as renderers call it) is a picture of one quantity at the surface that
 * the camera's ray meets first. Those that are terms of the light (terms.h) are drawn as scenes of their own,
 * and are not made here. Of several samples a pixel has the mean: of normal and depth over those that meet a
 * surface, of the others over all.
 *
 *   normal        (N + 1) / 2 per coordinate, N of unit length and turned to the viewer; black where there is
 * none depth         the distance along the ray, divided by the farthest in the picture; 1 where there is
 * none id            one flat colour for each object, from its number in the scene; black where there is
 * none. Of one sample, the one nearest to the pixel's middle albedo        the diffuse colour, with its
 * pattern reflection    what the mirrored ray adds to the picture: what comes along it, times its weight and
 * the fog's transmission  likewise the refracted ray. Total reflection counts as reflection shadow        the
 * share of the lights shining at the point's front that reach it: 1 is lit, 0 in the shadow, and behind glass
 * its colour. 1 where none shines there, since nothing is in its way
 */
#ifndef ECLAIRAGE_EXPLAIN_AOV_H
#define ECLAIRAGE_EXPLAIN_AOV_H

#include "base/status.h"
#include "explain/terms.h"
#include "raytracer.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum Aov {
    AOV_NORMAL,
    AOV_DEPTH,
    AOV_ID,
    AOV_ALBEDO,
    AOV_AMBIENT, /* the terms: ORDER Term */
    AOV_EMISSION,
    AOV_DIFFUSE,
    AOV_SPECULAR,
    AOV_BACKGROUND,
    AOV_REFLECTION,
    AOV_TRANSMISSION,
    AOV_SHADOW,
    AOV_COUNT
} Aov;

/* Sets of Aovs are bits, 1 << aov. */
#define ALL_AOVS ((1u << AOV_COUNT) - 1)

/* "normal", ...: as it stands on the command line and in the names of files. */
const char *aovName(Aov aov);

/* Whether it is a term, and then which. */
bool aovIsTerm(Aov aov, Term *term);

/* What renderAovs gives; each part is NULL that was not asked for. */
typedef struct AovPictures {
    Framebuffer *pictures[AOV_COUNT]; /* linear; of the id, colours as they are to be stored */
    double farthest;                  /* the distance that depth was divided by; NAN where there is none */
    uint64_t *objectPixels; /* with the id: in how many pixels each of the scene's objects is seen */
} AovPictures;

/* The colour of an object's id, given the object's number in the scene: 0xRRGGBB, not black, the same for no
 * two of the first 2^24 - 1 objects. */
uint32_t objectIdColor(size_t number);

/* Draw those of the set that are not terms, of the finder's scene, in this size. On success the caller frees
 * *aovs with freeAovPictures; on failure there is nothing to free. STATUS_IO when memory runs out,
 * STATUS_INTERRUPTED when cancelled. The same pictures for any number of threads. */
Status renderAovs(const SurfaceFinder *finder, unsigned set, int width, int height,
                  const RenderOptions *options, AovPictures *aovs);
void freeAovPictures(AovPictures *aovs);

#endif
