/* raytracer.c - the course's tracer; see raytracer.h.
 *
 * Read it from the end upwards: renderTile sends a ray through each pixel, traceRay finds what it
 * meets, shade adds up the lights, isInShadow asks whether one of them is hidden.
 */
#include "raytracer.h"

#include "base/cancel.h"
#include "base/threads.h"

#include <stdatomic.h>
#include <stdlib.h>

/* ---- The scene ---- */

Light createLight(Vector3D position, Color3f color)
{
    return (Light){.position = position, .color = color, .falloff = FALLOFF_INVERSE_SQUARE};
}

Scene createScene(void)
{
    return (Scene){
        .image = {.width = 640, .height = 480, .bitDepth = 8, .encoding = ENCODING_SRGB},
        .camera = {.direction = {0, 0, -1}, .up = {0, 1, 0}, .fov = 60},
        .render = {.model = MODEL_PHONG, .shadows = true, .shadowBias = NAN},
        .tolerance = TOLERANCE_DEFAULT,
    };
}

void freeScene(Scene *scene)
{
    free(scene->lights);
    free(scene->objects);
    scene->lights = NULL;
    scene->objects = NULL;
    scene->lightCount = scene->lightCapacity = 0;
    scene->objectCount = scene->objectCapacity = 0;
}

/* Make room for one more item; returns the array, or NULL when memory runs out. */
static void *growArray(void *array, size_t count, size_t *capacity, size_t itemSize)
{
    if (count < *capacity)
        return array;
    size_t larger = *capacity < 8 ? 8 : *capacity + *capacity / 2;
    if (larger > SIZE_MAX / itemSize)
        return NULL;
    void *grown = realloc(array, larger * itemSize);
    if (grown != NULL)
        *capacity = larger;
    return grown;
}

bool addLightToScene(Scene *scene, Light light)
{
    Light *lights = growArray(scene->lights, scene->lightCount, &scene->lightCapacity, sizeof *lights);
    if (lights == NULL)
        return false;
    scene->lights = lights;
    scene->lights[scene->lightCount++] = light;
    return true;
}

bool addObjectToScene(Scene *scene, Object object)
{
    Object *objects = growArray(scene->objects, scene->objectCount, &scene->objectCapacity, sizeof *objects);
    if (objects == NULL)
        return false;
    scene->objects = objects;
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

/* ---- The camera ---- */

CameraFrame cameraFrame(const Camera *camera, int width, int height)
{
    const double pi = 3.14159265358979323846;
    Vector3D forward = normalize(camera->direction);
    Vector3D right = normalize(cross(forward, normalize(camera->up)));
    Vector3D up = cross(right, forward);
    double pictureHeight = 2 * tan(camera->fov * pi / 360);
    double pictureWidth = pictureHeight * width / height;
    return (CameraFrame){camera->position, forward, multVector(right, pictureWidth),
                         multVector(up, pictureHeight)};
}

Ray cameraRay(const CameraFrame *frame, double x, double y, int width, int height)
{
    double u = x / width - 0.5;
    double v = (height - y) / height - 0.5;
    Vector3D direction =
        addVectors(addVectors(frame->forward, multVector(frame->right, u)), multVector(frame->up, v));
    return createRay(frame->position, normalize(direction));
}

/* ---- One ray ---- */

/* The nearest object that the ray meets, or NULL. */
static const Object *nearestObject(const Ray *ray, const Scene *scene, double *distance)
{
    const Object *nearest = NULL;
    *distance = INFINITY;
    for (size_t i = 0; i < scene->objectCount; i++) {
        const Object *object = &scene->objects[i];
        double t = objectShape(object)->distance(object, ray);
        if (t < *distance) {
            *distance = t;
            nearest = object;
        }
    }
    return nearest;
}

bool throwRayThroughScene(Ray ray, Scene scene, Intersection *intersection)
{
    double distance;
    const Object *object = nearestObject(&ray, &scene, &distance);
    return object != NULL && intersectsObject(&ray, object, intersection);
}

/* How many times the largest number in a computation its result may be wrong, with a wide margin: a
 * few roundings of 2^-53 each. */
static const double ROUNDING_MARGIN = 0x1p-40;

/* Whether something lies between the point of the object and the light.
 *
 * Shadow acne, and what to do about it (handout, exercise 04, questions 03 and 04). The computed point
 * is not on the surface but, by rounding, a little above or below it. From below, the ray to the light
 * meets the very surface it starts on, and the point shadows itself: half of the points do, in a
 * pattern of specks. Taking double for float makes the gap smaller, not the specks fewer.
 *
 * The remedy is to start the ray a little above the surface, on the side that is seen. How little? A
 * fixed 0.001 is too much for a scene of millimetres and too little for one of kilometres. But the
 * rounding error is known: it is a few units in the last place of the largest number that went into
 * the point. So the step is 2^-40 of that number: some thousand times the error, and a million
 * millionth of the scene. The light's end has the same trouble when the light lies on a surface, and
 * the same remedy.
 *
 * A scene that gives a shadow bias gets the textbook's remedy instead, for comparison: start on the
 * surface, and count only what is farther than the bias. With 0 the acne is back. */
static bool isInShadow(const Scene *scene, const Object *object, const Ray *ray, const Intersection *hit,
                       Vector3D lightPosition)
{
    bool ownRule = isnan(scene->render.shadowBias);
    double nearest = ownRule ? 0 : scene->render.shadowBias;
    Vector3D start = hit->position;
    if (ownRule) {
        double magnitude =
            largestCoordinate(ray->origin) + hit->distance + objectShape(object)->magnitude(object);
        start = addVectors(start, multVector(hit->normal, magnitude * ROUNDING_MARGIN));
    }

    /* A blocker counts only between the point and the light. */
    Vector3D toLight = subVectors(lightPosition, start);
    double lightDistance = norm(toLight);
    double farthest = lightDistance;
    if (ownRule)
        farthest -= (lightDistance + largestCoordinate(lightPosition)) * ROUNDING_MARGIN;
    Ray shadowRay = createRay(start, normalize(toLight));
    for (size_t i = 0; i < scene->objectCount; i++) {
        const Object *blocker = &scene->objects[i];
        double t = objectShape(blocker)->distance(blocker, &shadowRay);
        if (t > nearest && t < farthest)
            return true;
    }
    return false;
}

/* What arrives of the light at distance d. */
static Color3f lightAtDistance(const Light *light, double d)
{
    return light->falloff == FALLOFF_INVERSE_SQUARE ? scaleColor(light->color, 1 / (d * d)) : light->color;
}

/* The colour that leaves the point towards the ray's origin. */
static Color3f shade(const Scene *scene, const Object *object, const Ray *ray, const Intersection *hit,
                     RayCounts *counts)
{
    const Material *material = &hit->material;
    ShadingModel model = scene->render.model;
    bool hasHighlight = !colorIsBlack(material->specular);
    Vector3D v = multVector(ray->direction, -1);
    if (model == MODEL_SIMPLE && (!scene->render.shadows || scene->lightCount == 0))
        return material->diffuse;

    Color3f diffuse = createColor(0, 0, 0), highlight = createColor(0, 0, 0);
    for (size_t i = 0; i < scene->lightCount; i++) {
        const Light *light = &scene->lights[i];
        Vector3D il = subVectors(light->position, hit->position);
        Vector3D l = normalize(il);

        /* A light behind the surface adds nothing. */
        if (!(dot(hit->normal, l) > 0))
            continue;
        if (scene->render.shadows) {
            counts->shadow++;
            if (isInShadow(scene, object, ray, hit, light->position))
                continue;
        }

        /* One light that reaches the point is enough for the simple model. */
        if (model == MODEL_SIMPLE)
            return material->diffuse;

        /* Add Ic * Lc * dot(N, IL/|IL|) / |IL|^2, and for Phong Lc * specFactor / |IL|^2. */
        Color3f arriving = lightAtDistance(light, norm(il));
        diffuse = addColors(diffuse, diffuseReflection(material, arriving, hit->normal, l));
        if (model == MODEL_PHONG && hasHighlight)
            highlight = addColors(highlight, specularHighlight(material, arriving, hit->normal, l, v));
    }

    /* Ispec is the same for all lights, so it multiplies their sum. In this order and with each step
     * rounded to float, POV-Ray's three layers (povray/MAPPING.md) give the same bits. */
    return addColors(diffuse, multColors(material->specular, highlight));
}

/* The colour that comes along the ray. */
static Color3f traceRay(const Ray *ray, const Scene *scene, RayCounts *counts)
{
    double distance;
    const Object *object = nearestObject(ray, scene, &distance);
    if (object == NULL)
        return scene->background;
    Vector3D position = pointOnRay(ray, distance);
    Intersection hit = {.distance = distance,
                        .position = position,
                        .normal = objectShape(object)->normal(object, ray, position),
                        .material = object->material};
    return shade(scene, object, ray, &hit, counts);
}

/* ---- The picture ---- */

enum {
    TILE_SIZE = 32
};

typedef struct Rendering {
    const Scene *scene;
    Framebuffer *framebuffer;
    const RenderOptions *options;
    CameraFrame frame;
    size_t tileColumns, tileCount;
    atomic_size_t tilesDone;
    _Atomic uint64_t primary, shadow;
} Rendering;

/* Draw one square of the picture. */
static void renderTile(void *context, size_t number)
{
    Rendering *rendering = context;
    Framebuffer *framebuffer = rendering->framebuffer;
    int left = (int)(number % rendering->tileColumns) * TILE_SIZE;
    int top = (int)(number / rendering->tileColumns) * TILE_SIZE;
    int right = left + TILE_SIZE < framebuffer->width ? left + TILE_SIZE : framebuffer->width;
    int bottom = top + TILE_SIZE < framebuffer->height ? top + TILE_SIZE : framebuffer->height;

    /* Send one ray through the middle of each pixel. */
    RayCounts counts = {0};
    for (int y = top; y < bottom; y++) {
        for (int x = left; x < right && !cancelRequested(); x++) {
            Ray ray = cameraRay(&rendering->frame, x + 0.5, y + 0.5, framebuffer->width, framebuffer->height);
            counts.primary++;
            putLinearPixel(framebuffer, x, y, traceRay(&ray, rendering->scene, &counts));
        }
    }

    rendering->primary += counts.primary;
    rendering->shadow += counts.shadow;
    size_t done = atomic_fetch_add(&rendering->tilesDone, 1) + 1;
    if (rendering->options->progress != NULL)
        rendering->options->progress(rendering->options->progressContext,
                                     (double)done / (double)rendering->tileCount);
}

Status renderReference(const Scene *scene, Framebuffer *framebuffer, const RenderOptions *options,
                       RayCounts *counts)
{
    size_t columns = ((size_t)framebuffer->width + TILE_SIZE - 1) / TILE_SIZE;
    size_t rows = ((size_t)framebuffer->height + TILE_SIZE - 1) / TILE_SIZE;
    Rendering rendering = {.scene = scene,
                           .framebuffer = framebuffer,
                           .options = options,
                           .frame = cameraFrame(&scene->camera, framebuffer->width, framebuffer->height),
                           .tileColumns = columns,
                           .tileCount = columns * rows};
    Status status = runTasks(rendering.tileCount, options->threads, renderTile, &rendering);
    if (counts != NULL)
        *counts = (RayCounts){.primary = rendering.primary, .shadow = rendering.shadow};
    return status;
}

static void renderWithModel(Scene *scene, ShadingModel model, Framebuffer *framebuffer)
{
    scene->render.model = model;
    RenderOptions options = {.threads = availableProcessors()};
    renderReference(scene, framebuffer, &options, NULL);
}

void simpleRaytracing(Scene scene, Framebuffer *framebuffer)
{
    renderWithModel(&scene, MODEL_SIMPLE, framebuffer);
}

void lambertRaytracing(Scene scene, Framebuffer *framebuffer)
{
    renderWithModel(&scene, MODEL_LAMBERT, framebuffer);
}

void phongRaytracing(Scene scene, Framebuffer *framebuffer)
{
    renderWithModel(&scene, MODEL_PHONG, framebuffer);
}
