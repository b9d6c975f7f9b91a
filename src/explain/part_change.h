/* part_change.h - a scene that is changed in one part: an object, the objects of a material, or a lamp.
 *
 * A mistake that is made for all of a scene is a LightChange or a ViewChange; here are those that are made
 * for a part of it. The changed scene is traced by the engine like any other, so what a change predicts is
 * exact: in mirrors and shadows too.
 */
#ifndef ECLAIRAGE_EXPLAIN_PART_CHANGE_H
#define ECLAIRAGE_EXPLAIN_PART_CHANGE_H

#include "explain/predict.h"

typedef enum PartKind {
    PART_GONE,       /* the object is not there */
    PART_SHADOW,     /* the object blocks no light, or does where the scene says that it does not */
    PART_FORMULA,    /* the light of its surface is computed in another way: light */
    PART_MATERIAL,   /* its material is another one: material */
    PART_PLACE,      /* the object is moved by offset, and scale times as large about its middle */
    PART_LAMP,       /* the lamp is another one: lamp */
    PART_ALL_LAMPS,  /* the lamps have other colours: lampColors */
    PART_BACKGROUND, /* the background has other colours: background */
    PART_SETTINGS    /* more or fewer samples, or rays in a chain: render */
} PartKind;

enum {
    MOST_LAMPS = 16 /* that are looked at one by one */
};

typedef struct PartChange {
    PartKind kind;
    size_t number;              /* of the object, or of the lamp, in the scene, from 0 */
    const Material *ofMaterial; /* of the object, or of the part of a solid, that is meant */
    bool wholeMaterial;         /* all objects of that material, and not only this one */
    LightChange light;          /* neutral but in what is wrong */
    Material material;
    Vector3D offset; /* in scene units */
    double scale;
    Light lamp;
    Color3f lampColors[MOST_LAMPS];
    Background background;
    RenderSettings render;
} PartChange;

/* How many objects of the scene have the material, or a part that has it. */
size_t countOfMaterial(const Scene *scene, const Material *material);

/* The middle of the object in world space, about which it is scaled; false where it has no end. */
bool findObjectMiddle(const Object *object, Vector3D *middle);

/* What the evidence's pixels would be in the changed scene. truth: the scene as it is. STATUS_IO when memory
 * runs out, STATUS_INTERRUPTED when cancelled. The caller frees *prediction. */
Status predictPart(const Truth *truth, const Evidence *evidence, const PartChange *change,
                   Prediction *prediction);

#endif
