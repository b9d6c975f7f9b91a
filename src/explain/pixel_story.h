/* pixel_story.h - the whole story of one pixel: every ray, hit, light and term, in the order of the tracer.
 *
 * A story is pure data, a tree of rays whose root is the camera's, that others put into words, JSON or a
 * drawing. It is told by the tracer's own functions in the tracer's own order.
 * Invariant: story->color is, to the last bit, what renderReference puts into this pixel.
 * Units and spaces are those of raytracer.h: world space, scene units, linear colours.
 */
#ifndef ECLAIRAGE_EXPLAIN_PIXEL_STORY_H
#define ECLAIRAGE_EXPLAIN_PIXEL_STORY_H

#include "base/status.h"
#include "raytracer.h"

#include <stdbool.h>
#include <stddef.h>

/* An object that a ray was tried on. */
typedef struct TriedObject {
    const Object *object;
    const Object *part; /* of a solid: the part whose surface was met; else the object; NULL: missed */
    double distance;    /* of the nearest hit; INFINITY: missed */
} TriedObject;

/* A transparent surface on the way to a light. */
typedef struct Crossing {
    const Object *object, *part;
    double distance; /* from the start of the shadow ray */
    Color3f transmission;
} Crossing;

typedef enum LightFate {
    LIGHT_REACHES,  /* its terms count */
    LIGHT_BEHIND,   /* N.L is not above 0 */
    LIGHT_DARK,     /* black arrives: outside the cone of a spot light, or a black light */
    LIGHT_BLOCKED,  /* nothing is left of it behind what lies between */
    LIGHT_NOT_ASKED /* the simple model stops at the first light that reaches the point */
} LightFate;

enum {
    MOST_CROSSINGS = 8 /* that are kept of one way to a light */
};

/* What one point light does at a point. Of a light that is behind, dark or not asked, what comes after that
 * finding is zero. */
typedef struct LightStory {
    size_t light;           /* its number in the scene, from 0 */
    int sample;             /* of an area's point lights, from 0 */
    ArrivingLight arriving; /* with nothing between; of the simple model with the colour 1 */
    Vector3D il;            /* from the point to the light; of a directional one of unit length */
    double cosine;          /* N.L */
    LightFate fate;

    /* The shadow test, where there was one. */
    bool hasShadowRay;
    ShadowRay shadow;
    const Object *blocker, *blockerPart; /* the nearest opaque one, or NULL */
    double blockedAt;                    /* distance along the shadow ray */
    Crossing crossings[MOST_CROSSINGS];  /* the nearest ones, in order */
    size_t crossingCount;                /* of all */
    Color3f reaching;                    /* what is left of the light */

    /* The terms. */
    Color3f diffuse;     /* Ic * Lc * (N.L), Lc with its falloff */
    bool hasHighlight;   /* the model has one, and Ispec is not black */
    Vector3D r;          /* Phong: -L reflected at N; Blinn-Phong: H, halfway between L and V */
    double highlightDot; /* R.V or N.H */
    double specFactor;   /* max(0, R.V)^shininess */
    Color3f highlight;   /* Lc * specFactor, not yet times Ispec */
} LightStory;

typedef enum RayRole {
    RAY_OF_CAMERA,
    RAY_MIRRORED,
    RAY_REFRACTED,
    RAY_TOTALLY_REFLECTED /* mirrored because no refracted ray is possible */
} RayRole;

typedef enum RayEnd {
    RAY_MEETS_SURFACE,
    RAY_MEETS_NOTHING,
    RAY_TOO_DEEP, /* the chain is longer than max_depth: black */
    RAY_NOT_TOLD  /* its colour is known, but the story has enough rays */
} RayEnd;

typedef struct RayStory RayStory;
struct RayStory {
    RayRole role;
    Ray ray;
    int depth;   /* in its chain, the camera's is 1 */
    Media media; /* what the ray runs in */
    RayEnd end;
    Color3f seen;     /* at its end, before the fog */
    double fogWeight; /* the share of seen that is left behind the fog; 1 without fog */
    Color3f color;    /* what comes along the ray */

    /* The objects tried: all in the order of the scene where there are few, else the nearest that were met.
     */
    TriedObject *tried;
    size_t triedCount;
    size_t metCount, missedCount; /* of all objects */

    /* Where it met a surface. */
    SurfacePoint point;
    Material material; /* with the pattern worked out */
    ShadingModel model;
    LightStory *lights; /* in order; an area has one for each of its point lights */
    size_t lightCount;
    bool isUnlit;        /* simple model: the diffuse colour without asking any light */
    Color3f ambientTerm; /* Ia * the scene's ambient light */
    Color3f diffuseSum, highlightSum;
    Color3f specularTerm; /* Ispec * highlightSum */
    Color3f local;        /* all of the surface's own, without mirrored and refracted rays */

    /* Where it goes on. Snell's law: ratio = n1 / n2, cosine = -N.d, and the reflection is total where
     * k = 1 - ratio^2 (1 - cosine^2) is below 0. */
    bool isTransparent;
    double ratio, cosine, k;
    RayStory *refracted; /* or the totally reflected one; owned; NULL: none */
    RayStory *mirrored;  /* owned; NULL: none */
};

/* One of the samples of a pixel. */
typedef struct SampleStory {
    double x, y; /* in pixels from the picture's top left corner */
    Color3f color;
} SampleStory;

typedef struct PixelStory {
    const Scene *scene;
    int x, y;             /* from the left and from the top, both from 0 */
    SampleStory *samples; /* samples x samples, row by row */
    size_t sampleCount;
    size_t told;        /* the number of the sample whose ray is told: the one nearest to the middle */
    RayStory *ray;      /* owned */
    Color3f color;      /* the pixel's: the mean of the samples, as the tracer takes it */
    unsigned stored[3]; /* as the scene stores it */
    size_t rayCount;    /* told */
} PixelStory;

/* Tell the story of a pixel of the scene's picture; x and y are inside it. The scene must live longer than
 * the story, which the caller frees. STATUS_IO when memory runs out, STATUS_INTERRUPTED when cancelled; then
 * *story is untouched. */
Status createPixelStory(const Scene *scene, int x, int y, PixelStory *story);
void freePixelStory(PixelStory *story);

/* ---- Names ---- */

/* Append how an object is called: "the sphere of line 14"; made by a program, it has no line: "sphere 3 of
 * the scene". part: of a solid, the part that is meant, or the object itself, or NULL. */
void appendObjectName(const Scene *scene, const Object *object, const Object *part, Text *text);

/* The kind of the object as in a scene file: "sphere", "difference". */
const char *objectKindName(const Object *object);

/* The number of the object in the scene, from 0. */
size_t objectNumber(const Scene *scene, const Object *object);

const char *lightKindName(const Light *light);
const char *shadingModelName(ShadingModel model);

/* ---- POV-Ray's answer ---- */

typedef struct PovrayPixel {
    Status status;       /* STATUS_OK: the rest is valid; else why there is no value */
    unsigned samples[3]; /* 16 bits, linear */
    unsigned stored[3];  /* the same as the scene stores it */
    unsigned ours[3];    /* our pixel in 16 bits, linear */
    double difference;   /* the largest of the channels', in 0..1 */
    bool agrees;         /* the difference is at most the scene's tolerance `fail` */
} PovrayPixel;

/* Let POV-Ray draw this pixel of the exported scene, in 16 bits linear. */
PovrayPixel askPovray(const PixelStory *story, int threads);

#endif
