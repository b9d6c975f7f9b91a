/* scene_variant.c - see scene_variant.h. */
#include "explain/scene_variant.h"

#include <stdlib.h>
#include <string.h>

static void freeParts(Object *objects, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (objects[i].kind != SHAPE_CSG || objects[i].csg.parts == NULL)
            continue;
        freeParts(objects[i].csg.parts, objects[i].csg.partCount);
        free(objects[i].csg.parts);
    }
}

/* A copy of the objects in which the parts of solids are copies too; NULL when memory runs out. */
static Object *copyObjects(const Object *objects, size_t count)
{
    Object *copies = malloc((count > 0 ? count : 1) * sizeof *copies);
    if (copies == NULL)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        copies[i] = objects[i];
        if (objects[i].kind != SHAPE_CSG)
            continue;
        copies[i].csg.parts = copyObjects(objects[i].csg.parts, objects[i].csg.partCount);
        if (copies[i].csg.parts == NULL) {
            freeParts(copies, i);
            free(copies);
            return NULL;
        }
    }
    return copies;
}

Status createSceneVariant(const Scene *original, Scene *variant)
{
    Object *objects = copyObjects(original->objects, original->objectCount);
    Light *lights = malloc((original->lightCount > 0 ? original->lightCount : 1) * sizeof *lights);
    if (objects == NULL || lights == NULL) {
        if (objects != NULL)
            freeParts(objects, original->objectCount);
        free(objects);
        free(lights);
        return statusOutOfMemory();
    }
    if (original->lightCount > 0)
        memcpy(lights, original->lights, original->lightCount * sizeof *lights);
    *variant = *original;
    variant->objects = objects;
    variant->objectCapacity = original->objectCount;
    variant->lights = lights;
    variant->lightCapacity = original->lightCount;
    variant->memory = NULL;
    variant->meshes = NULL;
    variant->meshCount = variant->meshCapacity = 0;
    return statusOk();
}

void freeSceneVariant(Scene *variant)
{
    freeParts(variant->objects, variant->objectCount);
    free(variant->objects);
    free(variant->lights);
    *variant = createScene();
}

static void changeObjects(Object *objects, size_t count, void (*change)(Material *material, void *context),
                          void *context)
{
    for (size_t i = 0; i < count; i++) {
        if (objects[i].kind == SHAPE_CSG)
            changeObjects(objects[i].csg.parts, objects[i].csg.partCount, change, context);
        else
            change(&objects[i].material, context);
    }
}

void changeMaterials(Scene *variant, void (*change)(Material *material, void *context), void *context)
{
    changeObjects(variant->objects, variant->objectCount, change, context);
}
