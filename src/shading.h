/* shading.h - what a surface does with light (handout: shading.h; Phong 1975).
 *
 * Directions are of unit length and point away from the surface: N the normal, L to the light, V to
 * where the ray came from. The light's colour is what arrives, so the falloff 1/d^2 is already in it.
 */
#ifndef ECLAIRAGE_SHADING_H
#define ECLAIRAGE_SHADING_H

#include "colors.h"
#include "geometry.h"

typedef struct Material {
    Color3f diffuse;
    Color3f specular;
    float shininess; /* the exponent of the highlight, at least 0; larger is smaller and sharper */
} Material;

/* The models, each adding a term: simple (unlit), Lambert (diffuse), Phong (diffuse and specular). */
typedef enum ShadingModel {
    MODEL_SIMPLE,
    MODEL_LAMBERT,
    MODEL_PHONG
} ShadingModel;

Material createMaterial(Color3f diffuse, Color3f specular, float shininess);

/* The material an author gets who names none: diffuse 0.8, no specular, shininess 32. */
Material defaultMaterial(void);

/* Lambert's term, Ic * Lc * dot(N, L); 0 where dot(N, L) <= 0. */
Color3f diffuseReflection(const Material *material, Color3f light, Vector3D n, Vector3D l);

/* Phong's highlight without its colour, Lc * max(0, dot(R, V))^shininess, R being -L reflected at N; the
 * specular colour Ispec multiplies the sum over all lights. It has no factor dot(N, L): whoever calls it
 * must have left out the lights behind the surface. */
Color3f specularHighlight(const Material *material, Color3f light, Vector3D n, Vector3D l, Vector3D v);

#endif
