/* pov_habits.c - see pov_habits.h. */
#include "povray/pov_habits.h"

const char *povHabitName(PovHabit habit)
{
    switch (habit) {
    case POV_HABIT_FALLOFF:
        return "falloff";
    case POV_HABIT_AMBIENT:
        return "ambient";
    case POV_HABIT_DIFFUSE:
        return "diffuse";
    case POV_HABIT_HIGHLIGHT:
        return "highlight";
    case POV_HABIT_HIGHLIGHT_COLOR:
        return "highlight-colour";
    case POV_HABIT_GAMMA:
        return "gamma";
    case POV_HABIT_LEFT_HANDED:
        return "left-handed";
    case POV_HABIT_ANGLE:
        return "angle";
    case POV_HABIT_AREA_LIGHT:
        return "area-light";
    case ALL_POV_HABITS:
        break;
    }
    return "all";
}

/* What a scene's surfaces have that habits can change. */
typedef struct Surfaces {
    bool diffuse, ownAmbient, highlight, coloredHighlight, simple;
} Surfaces;

static void lookAtMaterial(const Scene *scene, const Material *material, Surfaces *found)
{
    ShadingModel model = materialModel(scene, material);
    if (model == MODEL_SIMPLE) {
        found->simple = true;
        return;
    }
    Color3f ks = material->specular;
    found->diffuse = found->diffuse || material->pattern != NULL || !colorIsBlack(material->diffuse);
    found->ownAmbient =
        found->ownAmbient || !colorIsBlack(multColors(material->ambient, scene->render.ambient));
    if (model >= MODEL_PHONG && !colorIsBlack(ks)) {
        found->highlight = true;
        found->coloredHighlight = found->coloredHighlight || ks.r != ks.g || ks.g != ks.b;
    }
}

static void lookAtObject(const Scene *scene, const Object *object, Surfaces *found)
{
    if (object->kind != SHAPE_CSG)
        lookAtMaterial(scene, &object->material, found);
    else
        for (size_t i = 0; i < object->csg.partCount; i++)
            lookAtObject(scene, &object->csg.parts[i], found);
}

unsigned applicablePovHabits(const Scene *scene)
{
    unsigned habits = POV_HABIT_GAMMA | POV_HABIT_LEFT_HANDED;
    if (scene->camera.projection == PROJECTION_PERSPECTIVE && scene->image.width != scene->image.height)
        habits |= POV_HABIT_ANGLE;

    Surfaces found = {0};
    for (size_t i = 0; i < scene->objectCount; i++)
        lookAtObject(scene, &scene->objects[i], &found);
    if (found.simple)
        return habits;
    bool isLit = false;
    for (size_t i = 0; i < scene->lightCount; i++) {
        const Light *light = &scene->lights[i];
        if (colorIsBlack(light->color))
            continue;
        isLit = true;
        if (light->kind != LIGHT_DIRECTIONAL && light->falloff == FALLOFF_INVERSE_SQUARE)
            habits |= POV_HABIT_FALLOFF;
        if (lightSampleCount(light) > 1)
            habits |= POV_HABIT_AREA_LIGHT;
    }
    if (found.diffuse || found.ownAmbient)
        habits |= POV_HABIT_AMBIENT;
    if (found.diffuse && isLit)
        habits |= POV_HABIT_DIFFUSE;
    if (found.highlight && isLit)
        habits |= POV_HABIT_HIGHLIGHT;
    if (found.coloredHighlight && isLit)
        habits |= POV_HABIT_HIGHLIGHT_COLOR;
    return habits;
}
