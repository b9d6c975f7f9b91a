/* explanation.h - the causes that were found for a difference, best first, and how they are told. */
#ifndef ECLAIRAGE_EXPLAIN_EXPLANATION_H
#define ECLAIRAGE_EXPLAIN_EXPLANATION_H

#include "base/status.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* What can be wrong with a picture. */
typedef enum Cause {
    CAUSE_GAMMA,          /* encoded twice, not at all, or with another curve */
    CAUSE_EXPOSURE,       /* all light times a number */
    CAUSE_MIRRORED,       /* left is right */
    CAUSE_FLIPPED,        /* top is bottom */
    CAUSE_CHANNELS,       /* red, green and blue in another order */
    CAUSE_SHIFT,          /* by half a pixel or a whole one */
    CAUSE_ASPECT,         /* stretched, or another angle of view */
    CAUSE_SHADOW,         /* shadows that are missing, or too many */
    CAUSE_FALLOFF,        /* light that grows weaker in another way */
    CAUSE_BLINN,          /* Blinn's highlight for Phong's, or the other way round */
    CAUSE_SHININESS,      /* another exponent */
    CAUSE_SPECULAR,       /* no highlight, or in another colour */
    CAUSE_NEGATIVE_LIGHT, /* lights behind the surface count */
    CAUSE_NORMALS,        /* turned to the wrong side, or not interpolated */
    CAUSE_AMBIENT,        /* light added everywhere */
    CAUSE_ACNE,           /* surfaces that shadow themselves */
    CAUSE_QUANTISATION,   /* too few levels */
    CAUSE_SCENE,          /* an object, a material or a lamp is another one; "unknown" in JSON */
    CAUSE_UNKNOWN,        /* none of these */
    CAUSE_COUNT
} Cause;

/* The cause's name: "gamma", ..., "another scene", "unknown". */
const char *causeName(Cause cause);

typedef struct Explanation {
    Cause cause;
    double residual; /* the root mean square error that is left when this cause and those before it are taken
                      * into account; of the samples as stored, 0..1 */
    Text text;       /* what it is, in plain words; one or two sentences */
    Text where;      /* what to look at: a line of the scene, "scene.yaml:12", or a formula; never empty */
} Explanation;

enum {
    MAX_EXPLANATIONS = 16
};

/* Begins as {0}; freed with freeExplanations. */
typedef struct Explanations {
    Explanation items[MAX_EXPLANATIONS];
    size_t count;
    double before; /* the root mean square error before anything is taken into account */
} Explanations;

/* Add a cause at the end and return it, its texts empty, to be filled. More than MAX_EXPLANATIONS replace the
 * last one. */
Explanation *addExplanation(Explanations *explanations, Cause cause, double residual);
void freeExplanations(Explanations *explanations);

/* Append the document of `explain --json`: {"causes": [{"cause", "residual", "text", "where"}]}. */
void writeExplanationsJson(const Explanations *explanations, Text *text);

/* Append the causes in words for a terminal. summary stands where there are none. */
void writeExplanationsText(const Explanations *explanations, const char *summary, Text *text);

#endif
