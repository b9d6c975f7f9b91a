/* terms.h - a picture taken apart into the terms of its light.
 *
 * What leaves a surface is a sum, and all that happens to light on its way to the eye (mirrors, glass,
 * shadows, fog) only multiplies it and adds it up. So a picture is the sum of its terms, each of which is the
 * same scene with the sources of the others set to zero and everything that passes light on kept: a Scene
 * like any other, which both engines draw and exportPov writes.
 *
 * Invariant: the five pictures add up to the picture of the scene, but for the rounding of floats.
 */
#ifndef ECLAIRAGE_EXPLAIN_TERMS_H
#define ECLAIRAGE_EXPLAIN_TERMS_H

#include "base/status.h"
#include "raytracer.h"

#include <stdbool.h>

/* Of the simple model, all that a surface returns is diffuse. */
typedef enum Term {
    TERM_AMBIENT,    /* materials' ambient times render.ambient */
    TERM_EMISSION,   /* light of the materials' own */
    TERM_DIFFUSE,    /* of all lights, Lambert's term */
    TERM_SPECULAR,   /* of all lights, the highlights */
    TERM_BACKGROUND, /* the background, and the fog's own colour */
    TERM_COUNT
} Term;

/* "ambient", ...: as it stands on the command line and in the names of files. */
const char *termName(Term term);

/* Whether the scene has a source of this term; without one the term's picture is black by construction. */
bool sceneHasTerm(const Scene *scene, Term term);

/* Make the scene whose picture is this term of the original's, which must live longer. STATUS_IO when memory
 * runs out, and then *variant is untouched. The caller frees it with freeSceneVariant. */
Status createTermScene(const Scene *original, Term term, Scene *variant);

#endif
