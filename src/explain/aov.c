/* aov.c - see aov.h. */
#include "explain/aov.h"

#include "base/cancel.h"
#include "base/threads.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

/* ORDER Aov */
static const char *const NAMES[AOV_COUNT] = {"normal",     "depth",      "id",           "albedo",
                                             "ambient",    "emission",   "diffuse",      "specular",
                                             "background", "reflection", "transmission", "shadow"};

const char *aovName(Aov aov)
{
    return NAMES[aov];
}

bool aovIsTerm(Aov aov, Term *term)
{
    if (aov < AOV_AMBIENT || aov > AOV_BACKGROUND)
        return false;
    *term = (Term)(aov - AOV_AMBIENT);
    return true;
}

uint32_t objectIdColor(size_t number)
{
    /* The golden section of 2^24, which is odd, so that no two numbers below 2^24 get the same; neighbours
     * lie far apart in each channel. */
    static const uint32_t GOLDEN = 0x9E3779, COLORS = 1u << 24;
    uint32_t rest = (uint32_t)(number % (COLORS - 1)) + 1;
    return (uint32_t)((uint64_t)rest * GOLDEN % COLORS);
}

/* ---- One sample ---- */

/* What is known of the pixel so far: sums over its samples. */
typedef struct Sums {
    ColorSum values[AOV_COUNT];
    int hits;
    const Object *object; /* of the sample in the middle; NULL: none */
} Sums;

typedef struct Drawing {
    const SurfaceFinder *finder;
    unsigned set;
    const RenderOptions *options;
    PixelRays rays;
    int width, height;
    AovPictures *aovs;
    uint32_t *objects; /* number + 1 of the object in each pixel, 0: none */
    atomic_size_t rowsDone;
} Drawing;

static bool wants(const Drawing *drawing, Aov aov)
{
    return (drawing->set & 1u << aov) != 0;
}

static void addTo(Sums *sums, Aov aov, Color3f color)
{
    addToSum(&sums->values[aov], color);
}

/* The share of the light that reaches the point, of the lights shining at its front. */
static Color3f litShare(const SurfaceFinder *finder, const SurfacePoint *point)
{
    const Scene *scene = finder->scene;
    ColorSum sum = {0};
    int count = 0;
    for (size_t i = 0; i < scene->lightCount; i++) {
        for (int sample = 0; sample < lightSampleCount(&scene->lights[i]); sample++) {
            ArrivingLight arriving = lightArriving(&scene->lights[i], sample, point->position);
            if (!(dot(point->normal, arriving.direction) > 0) || colorIsBlack(arriving.color))
                continue;
            Color3f reaching = createColor(1, 1, 1);
            if (scene->render.shadows) {
                ShadowRay shadow = shadowRayTo(scene, point, &arriving);
                reaching = finder->lightAlong(finder, &shadow, reaching);
            }
            addToSum(&sum, reaching);
            count++;
        }
    }
    return count > 0 ? meanColor(sum, count) : createColor(1, 1, 1);
}

/* A finder that meets nothing and only notes where the ray goes. */
typedef struct DirectionProbe {
    SurfaceFinder finder; /* first, so that one can be taken for the other */
    Vector3D *direction;
} DirectionProbe;

static const Object *noteDirection(const SurfaceFinder *finder, const Ray *ray, Hit *hit)
{
    (void)hit;
    *((const DirectionProbe *)finder)->direction = ray->direction;
    return NULL;
}

/* Whether the ray that should go through the surface is mirrored as a whole (see addSecondaryRays). Asked of
 * the tracer itself, so that the two never decide differently. */
static bool isTotallyReflected(const Scene *scene, const SurfacePoint *point, const Material *material,
                               const Ray *ray, const Media *media)
{
    Vector3D direction = createVector(0, 0, 0);
    DirectionProbe probe = {.finder = {.scene = scene, .nearest = noteDirection}, .direction = &direction};
    RayCounts counts = {0};
    addSecondaryRays(&probe.finder, point, material, ray, media, 1, createColor(0, 0, 0), &counts);
    return dot(point->normal, direction) > 0;
}

/* Add what comes along the two rays that go on from here. */
static void addRaysOnward(const Drawing *drawing, Sums *sums, const SurfacePoint *point, const Ray *ray,
                          const Media *media)
{
    const SurfaceFinder *finder = drawing->finder;
    const Scene *scene = finder->scene;
    Material material = materialAt(point->hit.object, point->position);
    if (materialModel(scene, &material) == MODEL_SIMPLE || scene->render.maxDepth < 2)
        return;
    const Color3f black = createColor(0, 0, 0);
    Fog fog = {.color = black, .distance = scene->fog.distance};
    RayCounts counts = {0};
    Material through = material, mirror = material;
    through.reflection = black;
    mirror.transmission = black;

    bool isGlass = !colorIsBlack(material.transmission);
    bool isTotal = isGlass && isTotallyReflected(scene, point, &through, ray, media);
    Aov aov = isTotal ? AOV_REFLECTION : AOV_TRANSMISSION;
    if (isGlass && wants(drawing, aov)) {
        Color3f color = addSecondaryRays(finder, point, &through, ray, media, 1, black, &counts);
        addTo(sums, aov, throughFog(&fog, color, point->hit.distance));
    }
    if (!isTotal && wants(drawing, AOV_REFLECTION)) {
        Color3f color = addSecondaryRays(finder, point, &mirror, ray, media, 1, black, &counts);
        addTo(sums, AOV_REFLECTION, throughFog(&fog, color, point->hit.distance));
    }
}

/* Add one ray of the camera. */
static void addSample(const Drawing *drawing, Sums *sums, const Ray *ray, const Media *media, bool isMiddle)
{
    const SurfaceFinder *finder = drawing->finder;
    Hit hit;
    const Object *object = finder->nearest(finder, ray, &hit);
    if (isMiddle)
        sums->object = object;
    if (object == NULL) {
        addTo(sums, AOV_SHADOW, createColor(1, 1, 1));
        return;
    }
    SurfacePoint point = surfacePointAt(ray, object, &hit);
    sums->hits++;
    ColorSum *normal = &sums->values[AOV_NORMAL], *depth = &sums->values[AOV_DEPTH];
    normal->r += (point.normal.x + 1) / 2;
    normal->g += (point.normal.y + 1) / 2;
    normal->b += (point.normal.z + 1) / 2;
    depth->r += hit.distance;
    depth->g += hit.distance;
    depth->b += hit.distance;
    if (wants(drawing, AOV_ALBEDO))
        addTo(sums, AOV_ALBEDO, materialAt(hit.object, point.position).diffuse);
    if (wants(drawing, AOV_SHADOW))
        addTo(sums, AOV_SHADOW, litShare(finder, &point));
    if (wants(drawing, AOV_REFLECTION) || wants(drawing, AOV_TRANSMISSION))
        addRaysOnward(drawing, sums, &point, ray, media);
}

/* ---- The pictures ---- */

static void storePixel(const Drawing *drawing, const Sums *sums, int x, int y)
{
    int n = drawing->finder->scene->render.samples;
    for (Aov aov = 0; aov < AOV_COUNT; aov++) {
        Framebuffer *picture = drawing->aovs->pictures[aov];
        if (picture == NULL || aov == AOV_ID)
            continue;
        bool overHits = aov == AOV_NORMAL || aov == AOV_DEPTH;
        double count = overHits ? fmax(1, sums->hits) : (double)n * n;
        Color3f mean = meanColor(sums->values[aov], count);
        /* Until the farthest is known, no distance is an infinite one. */
        if (aov == AOV_DEPTH && sums->hits == 0)
            mean = createColor(INFINITY, INFINITY, INFINITY);
        putLinearPixel(picture, x, y, mean);
    }
    if (drawing->objects != NULL && sums->object != NULL)
        drawing->objects[(size_t)y * (size_t)drawing->width + (size_t)x] =
            (uint32_t)(sums->object - drawing->finder->scene->objects) + 1;
}

static void drawRow(void *context, size_t number)
{
    Drawing *drawing = context;
    const Scene *scene = drawing->finder->scene;
    int n = scene->render.samples, y = (int)number;
    for (int x = 0; x < drawing->width && !cancelRequested(); x++) {
        Sums sums = {.object = NULL};
        for (int j = 0; j < n; j++) {
            for (int i = 0; i < n; i++) {
                Media media;
                Ray ray = pixelRay(&drawing->rays, x + (i + 0.5) / n, y + (j + 0.5) / n, &media);
                addSample(drawing, &sums, &ray, &media, i == n / 2 && j == n / 2);
            }
        }
        storePixel(drawing, &sums, x, y);
    }
    size_t done = atomic_fetch_add(&drawing->rowsDone, 1) + 1;
    if (drawing->options->progress != NULL)
        drawing->options->progress(drawing->options->progressContext, (double)done / (double)drawing->height);
}

/* Divide the distances by the farthest of them. */
static void scaleDepth(AovPictures *aovs)
{
    Framebuffer *depth = aovs->pictures[AOV_DEPTH];
    size_t count = (size_t)depth->width * (size_t)depth->height;
    float farthest = 0;
    for (size_t i = 0; i < count; i++)
        if (isfinite(depth->pixels[i].r) && depth->pixels[i].r > farthest)
            farthest = depth->pixels[i].r;
    for (size_t i = 0; i < count; i++) {
        float value = isfinite(depth->pixels[i].r) ? depth->pixels[i].r / farthest : 1;
        depth->pixels[i] = createColor(value, value, value);
    }
    aovs->farthest = farthest > 0 ? (double)farthest : NAN;
}

/* Count and colour the objects. */
static void paintObjects(const Drawing *drawing)
{
    Framebuffer *picture = drawing->aovs->pictures[AOV_ID];
    size_t count = (size_t)drawing->width * (size_t)drawing->height;
    for (size_t i = 0; i < count; i++) {
        if (drawing->objects[i] == 0)
            continue;
        size_t number = drawing->objects[i] - 1;
        uint32_t color = objectIdColor(number);
        drawing->aovs->objectPixels[number]++;
        picture->pixels[i] = createColor((float)(color >> 16) / 255, (float)(color >> 8 & 255) / 255,
                                         (float)(color & 255) / 255);
    }
}

/* Make room for what was asked for. */
static bool createPictures(Drawing *drawing)
{
    AovPictures *aovs = drawing->aovs;
    *aovs = (AovPictures){.farthest = NAN};
    Term term;
    for (Aov aov = 0; aov < AOV_COUNT; aov++) {
        if (!wants(drawing, aov) || aovIsTerm(aov, &term))
            continue;
        aovs->pictures[aov] = createFramebuffer(drawing->width, drawing->height);
        if (aovs->pictures[aov] == NULL)
            return false;
    }
    if (!wants(drawing, AOV_ID))
        return true;
    size_t objectCount = drawing->finder->scene->objectCount;
    aovs->objectPixels = calloc(objectCount > 0 ? objectCount : 1, sizeof *aovs->objectPixels);
    drawing->objects = calloc((size_t)drawing->width * (size_t)drawing->height, sizeof *drawing->objects);
    return aovs->objectPixels != NULL && drawing->objects != NULL;
}

Status renderAovs(const SurfaceFinder *finder, unsigned set, int width, int height,
                  const RenderOptions *options, AovPictures *aovs)
{
    const Scene *scene = finder->scene;
    bool failed;
    size_t transparentCount;
    uint32_t *transparent = findTransparentObjects(scene, &transparentCount, &failed);
    if (failed)
        return statusOutOfMemory();
    Drawing drawing = {.finder = finder,
                       .set = set,
                       .options = options,
                       .rays = createPixelRays(scene, width, height, transparent, transparentCount),
                       .width = width,
                       .height = height,
                       .aovs = aovs};
    Status status = createPictures(&drawing) ? runTasks((size_t)height, options->threads, drawRow, &drawing)
                                             : statusOutOfMemory();
    if (statusIsOk(&status) && aovs->pictures[AOV_DEPTH] != NULL)
        scaleDepth(aovs);
    if (statusIsOk(&status) && aovs->pictures[AOV_ID] != NULL)
        paintObjects(&drawing);
    free(drawing.objects);
    free(transparent);
    if (!statusIsOk(&status))
        freeAovPictures(aovs);
    return status;
}

void freeAovPictures(AovPictures *aovs)
{
    for (Aov aov = 0; aov < AOV_COUNT; aov++)
        freeFramebuffer(aovs->pictures[aov]);
    free(aovs->objectPixels);
    *aovs = (AovPictures){.farthest = NAN};
}
