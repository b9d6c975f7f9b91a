/* light_change.h - what can be wrong with how light is computed, as a tracer that makes the mistake.
 *
 * Each field is one mistake that programs written from the handout make; all of them can be combined. The
 * tracer is the engine's own, with the formulas changed, so what a hypothesis predicts is exact, in mirrors
 * and behind glass too.
 */
#ifndef ECLAIRAGE_EXPLAIN_LIGHT_CHANGE_H
#define ECLAIRAGE_EXPLAIN_LIGHT_CHANGE_H

#include "raytracer.h"

#include <stdbool.h>

typedef enum ShadowMistake {
    SHADOWS_AS_SCENE,
    SHADOWS_NONE,     /* nothing blocks light */
    SHADOWS_TOO_LONG, /* what lies behind the light blocks it too */
    SHADOWS_UNASKED   /* shadows where the scene says none */
} ShadowMistake;

typedef enum FalloffMistake {
    FALLOFF_AS_SCENE,
    FALLOFF_POWER,    /* 1/d^exponent; 0: no falloff */
    FALLOFF_POVRAY,   /* 2/(1 + (d/fadeDistance)^2) */
    FALLOFF_ONE_MORE, /* 1/(1 + (d/fadeDistance)^2) */
    FALLOFF_LINEAR,   /* 1/(1 + d) */
    FALLOFF_ALL_TERMS /* 1/(1 + d + d^2) */
} FalloffMistake;

typedef enum HighlightMistake {
    HIGHLIGHT_AS_SCENE,
    HIGHLIGHT_NONE,
    HIGHLIGHT_OTHER_MODEL, /* Blinn's for Phong's, Phong's for Blinn's */
    HIGHLIGHT_NO_FALLOFF,  /* only the diffuse term grows weaker with the distance */
    HIGHLIGHT_DIFFUSE      /* in the diffuse colour */
} HighlightMistake;

typedef enum ShininessMistake {
    SHININESS_AS_SCENE,
    SHININESS_TIMES, /* every exponent times shininess */
    SHININESS_IS,    /* every exponent is shininess */
    SHININESS_OF_ONE /* the exponents that are shininessOf are shininess */
} ShininessMistake;

typedef enum NormalMistake {
    NORMALS_AS_SCENE,
    NORMALS_FLIPPED,    /* all of them */
    NORMALS_NOT_TURNED, /* out of the object, also seen from inside */
    NORMALS_FLAT        /* those of the triangles, where the scene's are interpolated */
} NormalMistake;

typedef enum NegativeMistake {
    NEGATIVE_AS_SCENE,
    NEGATIVE_SUBTRACTS, /* dot(N, L) is not clamped at 0 */
    NEGATIVE_ABSOLUTE,  /* |dot(N, L)| */
    NEGATIVE_HIGHLIGHT  /* the highlight is not left out where dot(N, L) is negative */
} NegativeMistake;

typedef struct LightChange {
    ShadowMistake shadows;
    int shadowlessLight; /* the number of the light that throws no shadow, from 1; 0: none */
    FalloffMistake falloff;
    double exponent, fadeDistance;
    HighlightMistake highlight;
    ShininessMistake shininess;
    double shininessValue; /* a factor, or the exponent */
    float shininessOf;
    NormalMistake normals;
    NegativeMistake negative;
    bool backUnshadowed;    /* lights behind the surface are not tested for shadows */
    double ambientScale;    /* of the scene's ambient light */
    double lightScale;      /* of the lamps, or of the one below */
    int scaledLight;        /* its number, from 1; 0: all */
    unsigned blockedLights; /* bit i: light i does not arrive */

    /* The change is made on these surfaces only; NULL: on all. */
    const Object *onlyObject;
    const Material *onlyMaterial;
} LightChange;

/* Whether both are the same in all that an author can say of a material. */
bool sameMaterial(const Material *a, const Material *b);

/* The change that changes nothing. */
static inline LightChange neutralLightChange(void)
{
    return (LightChange){.fadeDistance = 1, .ambientScale = 1, .lightScale = 1};
}

/* A finder that traces with the change; begins with its SurfaceFinder. */
typedef struct ChangedFinder {
    SurfaceFinder finder;
    const SurfaceFinder *base;
    LightChange change;
    Scene scene; /* base's, with shadows as the change says; shares everything */
} ChangedFinder;

/* Fill *finder, which lives as long as base and must not be copied afterwards. */
void createChangedFinder(const SurfaceFinder *base, const LightChange *change, ChangedFinder *finder);

#endif
