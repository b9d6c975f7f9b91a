/* pov_texture.h - a material as POV-Ray's layers of texture (MAPPING.md). */
#ifndef ECLAIRAGE_POVRAY_POV_TEXTURE_H
#define ECLAIRAGE_POVRAY_POV_TEXTURE_H

#include "base/text.h"
#include "raytracer.h"

/* How the materials of a scene are to be written. */
typedef enum PovFinish {
    FINISH_UNLIT,     /* the diffuse colour as it is */
    FINISH_LIT,       /* the diffuse colour where the light arrives, black elsewhere */
    FINISH_REFLECTION /* the terms of the material's model */
} PovFinish;

/* Append "rgb <r, g, b>", each component times factor. */
void textAppendPovColor(Text *pov, Color3f color, double factor);

/* Append the textures of a material, the top layer last, by these PovHabits (pov_habits.h). scale: of all
 * lengths; extent: how far from the origin of its own space the object's points can be. */
void textAppendPovTexture(Text *pov, const Scene *scene, const Material *material, PovFinish finish,
                          unsigned habits, double scale, double extent);

/* Append "matrix <...>", the translation times scale. */
void textAppendPovMatrix(Text *pov, const Matrix *matrix, double scale);

#endif
