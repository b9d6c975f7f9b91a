/* part_change.c - see part_change.h. */
#include "explain/part_change.h"

#include "engine/engine.h"
#include "explain/scene_variant.h"

#include <math.h>

enum {
    MOST_MOVED = 64 /* parts of a solid */
};

/* ---- Materials ---- */

static bool hasMaterial(const Object *object, const Material *material)
{
    if (object->kind != SHAPE_CSG)
        return sameMaterial(&object->material, material);
    for (size_t i = 0; i < object->csg.partCount; i++)
        if (hasMaterial(&object->csg.parts[i], material))
            return true;
    return false;
}

size_t countOfMaterial(const Scene *scene, const Material *material)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->objectCount; i++)
        count += hasMaterial(&scene->objects[i], material);
    return count;
}

static void replaceMaterial(Object *object, const Material *old, const Material *material)
{
    if (object->kind == SHAPE_CSG) {
        for (size_t i = 0; i < object->csg.partCount; i++)
            replaceMaterial(&object->csg.parts[i], old, material);
    } else if (sameMaterial(&object->material, old)) {
        object->material = *material;
    }
}

/* ---- Places ---- */

bool findObjectMiddle(const Object *object, Vector3D *middle)
{
    Bounds bounds;
    if (!objectBounds(object, &bounds))
        return false;
    *middle = multVector(addVectors(bounds.min, bounds.max), 0.5);
    return isfinite(middle->x) && isfinite(middle->y) && isfinite(middle->z);
}

/* The transforms of what was moved: of an object, or of the parts of a solid. */
typedef struct MovedPlaces {
    Transform transforms[MOST_MOVED];
    size_t count;
} MovedPlaces;

static void moveBy(Object *object, const Matrix *move, MovedPlaces *places)
{
    if (object->kind == SHAPE_CSG) {
        for (size_t i = 0; i < object->csg.partCount; i++)
            moveBy(&object->csg.parts[i], move, places);
        return;
    }
    if (places->count == MOST_MOVED)
        return;
    Matrix matrix = *move;
    if (object->transform != NULL)
        matrix = composeMatrices(&object->transform->worldFromObject, move);
    Transform *transform = &places->transforms[places->count];
    if (createTransform(&matrix, transform)) {
        object->transform = transform;
        places->count++;
    }
}

/* Move and scale the object: x' = scale (x - middle) + middle + offset. One without a middle is not scaled,
 * and of a solid with more than MOST_MOVED parts some stay where they are. */
static void moveObject(Object *object, Vector3D offset, double scale, MovedPlaces *places)
{
    Vector3D middle = createVector(0, 0, 0);
    if (!findObjectMiddle(object, &middle))
        scale = 1;
    Matrix matrix = scalingMatrix(createVector(scale, scale, scale));
    matrix.translate = addVectors(multVector(middle, 1 - scale), offset);
    moveBy(object, &matrix, places);
}

/* ---- The changed scene ---- */

/* Take an object out. It goes to the end of the array, behind the count, where it is freed from. */
static void removeObject(Scene *variant, size_t number)
{
    Object removed = variant->objects[number];
    for (size_t i = number; i + 1 < variant->objectCount; i++)
        variant->objects[i] = variant->objects[i + 1];
    variant->objects[--variant->objectCount] = removed;
}

static void changeObjects(const PartChange *change, MovedPlaces *places, Scene *variant)
{
    Object *object = &variant->objects[change->number];
    switch (change->kind) {
    case PART_GONE:
        removeObject(variant, change->number);
        break;
    case PART_SHADOW:
        object->noShadow = !object->noShadow;
        break;
    case PART_PLACE:
        moveObject(object, change->offset, change->scale, places);
        break;
    default: {
        Material old = *change->ofMaterial;
        for (size_t i = 0; i < variant->objectCount; i++)
            if (i == change->number || change->wholeMaterial)
                replaceMaterial(&variant->objects[i], &old, &change->material);
        break;
    }
    }
}

static Status predictVariant(const Truth *truth, const Evidence *evidence, const Scene *variant,
                             Prediction *prediction)
{
    ViewChange view = neutralViewChange();
    LightChange light = neutralLightChange();
    CompiledScene *compiled;
    Status status = compileScene(variant, truth->threads, &compiled);
    if (!statusIsOk(&status))
        return status;
    Truth changed;
    status = truthOfScene(compiledFinder(compiled), truth->threads, &changed);
    if (statusIsOk(&status)) {
        status = predictPixels(&changed, evidence, NULL, &view, &light, false, prediction);
        freeTruth(&changed);
    }
    freeCompiledScene(compiled);
    return status;
}

static Status predictObjects(const Truth *truth, const Evidence *evidence, const PartChange *change,
                             Prediction *prediction)
{
    Scene variant;
    MovedPlaces places = {.count = 0};
    Status status = createSceneVariant(truth->scene, &variant);
    if (!statusIsOk(&status))
        return status;
    changeObjects(change, &places, &variant);
    status = predictVariant(truth, evidence, &variant, prediction);
    variant.objectCount = truth->scene->objectCount;
    freeSceneVariant(&variant);
    return status;
}

/* ---- Other lamps, another background and other settings, with the surfaces that are there ---- */

typedef struct RelitFinder {
    SurfaceFinder finder;
    const SurfaceFinder *base;
} RelitFinder;

static const SurfaceFinder *baseOf(const SurfaceFinder *finder)
{
    return ((const RelitFinder *)(const void *)finder)->base;
}

static const Object *findNearest(const SurfaceFinder *finder, const Ray *ray, Hit *hit)
{
    return baseOf(finder)->nearest(baseOf(finder), ray, hit);
}

static Color3f findLight(const SurfaceFinder *finder, const ShadowRay *shadow, Color3f color)
{
    return baseOf(finder)->lightAlong(baseOf(finder), shadow, color);
}

static Status predictRelit(const Truth *truth, const Evidence *evidence, const PartChange *change,
                           Prediction *prediction)
{
    Scene variant;
    Status status = createSceneVariant(truth->scene, &variant);
    if (!statusIsOk(&status))
        return status;
    if (change->kind == PART_LAMP)
        variant.lights[change->number] = change->lamp;
    for (size_t i = 0; change->kind == PART_ALL_LAMPS && i < variant.lightCount && i < MOST_LAMPS; i++)
        variant.lights[i].color = change->lampColors[i];

    /* The surfaces are those of the scene itself, which the finder knows. */
    Scene relit = *truth->scene;
    relit.lights = variant.lights;
    if (change->kind == PART_BACKGROUND)
        relit.background = change->background;
    if (change->kind == PART_SETTINGS)
        relit.render = change->render;
    RelitFinder finder = {.finder = {.scene = &relit, .nearest = findNearest, .lightAlong = findLight},
                          .base = truth->finder};
    Truth changed = *truth;
    changed.scene = &relit;
    changed.finder = &finder.finder;
    ViewChange view = neutralViewChange();
    LightChange light = neutralLightChange();
    status = predictPixels(&changed, evidence, NULL, &view, &light, false, prediction);
    freeSceneVariant(&variant);
    return status;
}

Status predictPart(const Truth *truth, const Evidence *evidence, const PartChange *change,
                   Prediction *prediction)
{
    if (change->kind == PART_LAMP || change->kind == PART_ALL_LAMPS || change->kind == PART_BACKGROUND ||
        change->kind == PART_SETTINGS)
        return predictRelit(truth, evidence, change, prediction);
    if (change->kind != PART_FORMULA)
        return predictObjects(truth, evidence, change, prediction);
    ViewChange view = neutralViewChange();
    LightChange light = change->light;
    light.onlyMaterial = change->ofMaterial;
    light.onlyObject = change->wholeMaterial ? NULL : &truth->scene->objects[change->number];
    return predictPixels(truth, evidence, NULL, &view, &light, false, prediction);
}
