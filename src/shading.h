/* shading.h - what a surface does with light (handout: shading.h; Phong 1975).
 *
 * Directions are of unit length and point away from the surface: N the normal, L to the light, V to
 * where the ray came from. The light's colour is what arrives, so the falloff 1/d^2 is already in it.
 */
#ifndef ECLAIRAGE_SHADING_H
#define ECLAIRAGE_SHADING_H

#include "colors.h"
#include "geometry.h"
#include "patterns/pattern.h"
#include "power.h"

#include <stdbool.h>

/* The models, each adding a term: simple (unlit), Lambert (diffuse), Phong (diffuse and specular); Blinn's
 * has its highlight by the half vector. */
typedef enum ShadingModel {
    MODEL_OF_SCENE, /* of a material: the scene's model */
    MODEL_SIMPLE,
    MODEL_LAMBERT,
    MODEL_PHONG,
    MODEL_BLINN_PHONG
} ShadingModel;

/* All colours linear, at least 0. What is all zero plays no part, so {diffuse, specular, shininess} is a
 * whole material. */
typedef struct Material {
    Color3f diffuse;
    Color3f specular;
    float shininess;      /* the exponent of the highlight, at least 0; larger is smaller and sharper */
    Color3f ambient;      /* times the scene's ambient light */
    Color3f emission;     /* light of its own, which lights nothing else */
    Color3f reflection;   /* share of what comes along the mirrored ray */
    Color3f transmission; /* share of what comes along the refracted ray */
    float ior;            /* index of refraction, above 0; counts where transmission does */
    ShadingModel model;
    const Pattern *pattern; /* gives the diffuse colour instead, or NULL; not owned */
} Material;

Material createMaterial(Color3f diffuse, Color3f specular, float shininess);

/* The material an author gets who names none: diffuse 0.8, no specular, shininess 32. */
Material defaultMaterial(void);

/* Lambert's term, Ic * Lc * dot(N, L); 0 where dot(N, L) <= 0. */
Color3f diffuseReflection(const Material *material, Color3f light, Vector3D n, Vector3D l);

/* Phong's highlight without its colour, Lc * max(0, dot(R, V))^shininess, R being -L reflected at N; the
 * specular colour Ispec multiplies the sum over all lights. It has no factor dot(N, L): whoever calls it
 * must have left out the lights behind the surface. */
Color3f specularHighlight(const Material *material, Color3f light, Vector3D n, Vector3D l, Vector3D v);

/* The largest exponent that is multiplied out. */
#define LARGEST_WHOLE_SHININESS 64

static inline bool isWholeShininess(double shininess)
{
    return shininess <= LARGEST_WHOLE_SHININESS && shininess == (double)(int)shininess;
}

/* cosine^shininess by squaring, shininess being whole and at most LARGEST_WHOLE_SHININESS: exact but for one
 * rounding a multiplication, so to some 2^-47, and far faster than power(). */
static inline double wholePower(double cosine, int shininess)
{
    double result = 1;
    for (; shininess != 0; shininess >>= 1) {
        result = (shininess & 1) != 0 ? result * cosine : result;
        cosine *= cosine;
    }
    return result;
}

/* What a highlight fades with: cosine^shininess; both at least 0. */
static inline double highlightPower(double cosine, double shininess)
{
    return isWholeShininess(shininess) ? wholePower(cosine, (int)shininess) : power(cosine, shininess);
}

/* dot(N, H), H halfway between L and V; 0 where they are opposite. */
static inline double blinnCosine(Vector3D n, Vector3D l, Vector3D v)
{
    Vector3D half = multVector(addVectors(v, l), 0.5);
    double length = norm(half), cosine = dot(half, n) / length;
    return length > 0 ? cosine : 0;
}

/* Blinn's highlight without its colour, Lc * max(0, dot(N, H))^shininess, H halfway between L and V (Blinn
 * 1977, "Models of light reflection for computer synthesized pictures", section 3). */
Color3f blinnHighlight(const Material *material, Color3f light, Vector3D n, Vector3D l, Vector3D v);

#endif
