/* scene_objects.c - a Scene and what is put into it; see raytracer.h. */
#include "base/memory.h"
#include "raytracer.h"

#include <stdlib.h>

/* One piece of memory that the scene owns, before what allocateInScene returned. */
typedef struct SceneMemory {
    struct SceneMemory *next;
    max_align_t data[];
} SceneMemory;

Light createLight(Vector3D position, Color3f color)
{
    return (Light){
        .kind = LIGHT_POINT, .position = position, .color = color, .falloff = FALLOFF_INVERSE_SQUARE};
}

Scene createScene(void)
{
    return (Scene){
        .image = {.width = 640, .height = 480, .bitDepth = 8, .encoding = ENCODING_SRGB},
        .camera = {.direction = {0, 0, -1}, .up = {0, 1, 0}, .fov = 60},
        .render = {.model = MODEL_PHONG, .shadows = true, .shadowBias = NAN, .samples = 1, .maxDepth = 5},
        .tolerance = TOLERANCE_DEFAULT,
    };
}

void freeScene(Scene *scene)
{
    for (size_t i = 0; i < scene->objectCount; i++)
        releaseObject(&scene->objects[i]);
    free(scene->lights);
    free(scene->objects);
    scene->lights = NULL;
    scene->objects = NULL;
    scene->lightCount = scene->lightCapacity = 0;
    scene->objectCount = scene->objectCapacity = 0;
    for (size_t i = 0; i < scene->meshCount; i++)
        freeMesh(scene->meshes[i]);
    free(scene->meshes);
    scene->meshes = NULL;
    scene->meshCount = scene->meshCapacity = 0;
    scene->files = NULL;
    while (scene->memory != NULL) {
        SceneMemory *next = scene->memory->next;
        free(scene->memory);
        scene->memory = next;
    }
}

void *allocateInScene(Scene *scene, size_t size)
{
    if (size > SIZE_MAX - sizeof(SceneMemory))
        return NULL;
    SceneMemory *memory = calloc(1, sizeof(SceneMemory) + size);
    if (memory == NULL)
        return NULL;
    memory->next = scene->memory;
    scene->memory = memory;
    return memory->data;
}

/* Make room for more items; returns the array, or NULL when memory runs out. Room grows by half at least, so
 * that adding one by one takes linear time. */
static void *growArray(void *array, size_t count, size_t more, size_t *capacity, size_t itemSize)
{
    if (more <= *capacity - count)
        return array;
    size_t larger = *capacity < 8 ? 8 : *capacity + *capacity / 2;
    if (more > SIZE_MAX - count)
        return NULL;
    if (larger < count + more)
        larger = count + more;
    if (larger > SIZE_MAX / itemSize)
        return NULL;
    void *grown = realloc(array, larger * itemSize);
    if (grown == NULL)
        return NULL;
    *capacity = larger;
    useLargePages(grown, larger * itemSize);
    return grown;
}

bool keepMeshInScene(Scene *scene, MeshData *mesh)
{
    MeshData **meshes = growArray(scene->meshes, scene->meshCount, 1, &scene->meshCapacity, sizeof *meshes);
    if (meshes == NULL)
        return false;
    scene->meshes = meshes;
    scene->meshes[scene->meshCount++] = mesh;
    return true;
}

bool addLightToScene(Scene *scene, Light light)
{
    Light *lights = growArray(scene->lights, scene->lightCount, 1, &scene->lightCapacity, sizeof *lights);
    if (lights == NULL)
        return false;
    scene->lights = lights;
    scene->lights[scene->lightCount++] = light;
    return true;
}

bool reserveObjectsInScene(Scene *scene, size_t count)
{
    if (count == 0)
        return true;
    Object *objects =
        growArray(scene->objects, scene->objectCount, count, &scene->objectCapacity, sizeof *objects);
    if (objects == NULL)
        return false;
    scene->objects = objects;
    return true;
}

bool addObjectToScene(Scene *scene, Object object)
{
    if (!reserveObjectsInScene(scene, 1))
        return false;
    scene->objects[scene->objectCount++] = object;
    return true;
}

bool addSphereToScene(Scene *scene, Sphere sphere)
{
    return addObjectToScene(scene, (Object){.kind = SHAPE_SPHERE, .sphere = sphere});
}

bool addCubeToScene(Scene *scene, Cube cube)
{
    return addObjectToScene(scene, (Object){.kind = SHAPE_CUBE, .cube = cube});
}

bool addBoxToScene(Scene *scene, Box box)
{
    return addObjectToScene(scene, (Object){.kind = SHAPE_BOX, .box = box});
}

bool addPlaneToScene(Scene *scene, Plane plane)
{
    return addObjectToScene(scene, (Object){.kind = SHAPE_PLANE, .plane = plane});
}
