/* pixel_story.c - the whole story of one pixel; see pixel_story.h.
 *
 * tellRay is traceRay, shade and addSecondaryRays of raytracer.c once more, written to be looked at: the same
 * calls in the same order, but each number is kept. tests/unit/test_pixel_story.c holds the two together.
 */
#include "explain/pixel_story.h"

#include "base/cancel.h"
#include "base/threads.h"
#include "engine/engine.h"

#include <stdlib.h>
#include <string.h>

enum {
    MOST_RAYS = 256,            /* told in full; the colours of the others are known */
    MOST_LIGHT_STORIES = 20000, /* no ray is told after so many */
    FEW_OBJECTS = 16,           /* so many are all named, of more those that were met */
    DEEPEST_RAY = 40            /* in a chain that is told */
};

typedef struct Telling {
    const Scene *scene;
    const SurfaceFinder *finder; /* for what is not told */
    RayCounts counts;
    size_t rays, lights;
    bool outOfMemory;
} Telling;

/* ---- Objects ---- */

static int compareTried(const void *a, const void *b)
{
    const TriedObject *first = a, *second = b;
    if (first->distance != second->distance)
        return first->distance < second->distance ? -1 : 1;
    return (first->object > second->object) - (first->object < second->object);
}

/* Try the ray on every object, as findNearest in raytracer.c. */
static const Object *tellObjects(Telling *telling, RayStory *story, Hit *hit)
{
    const Scene *scene = telling->scene;
    size_t capacity = FEW_OBJECTS;
    story->tried = calloc(capacity, sizeof *story->tried);
    if (story->tried == NULL) {
        telling->outOfMemory = true;
        return NULL;
    }
    bool few = scene->objectCount <= FEW_OBJECTS;
    const Object *nearest = NULL;
    HitSink best = createHitSink(0, false);
    for (size_t i = 0; i < scene->objectCount && !cancelRequested(); i++) {
        const Object *object = &scene->objects[i];
        HitSink sink = createHitSink(0, false);
        intersectObject(object, &story->ray, &sink);
        bool isMet = sink.nearest.distance < INFINITY;
        if (isMet && sink.nearest.distance < best.nearest.distance) {
            best.nearest = sink.nearest;
            nearest = object;
        }
        story->metCount += isMet;
        story->missedCount += !isMet;
        if (!isMet && !few)
            continue;
        TriedObject tried = {object, isMet ? sink.nearest.object : NULL,
                             isMet ? sink.nearest.distance : INFINITY};
        if (story->triedCount < capacity) {
            story->tried[story->triedCount++] = tried;
            if (!few)
                qsort(story->tried, story->triedCount, sizeof tried, compareTried);
        } else if (compareTried(&tried, &story->tried[capacity - 1]) < 0) {
            story->tried[capacity - 1] = tried;
            qsort(story->tried, story->triedCount, sizeof tried, compareTried);
        }
    }
    *hit = best.nearest;
    return nearest;
}

/* ---- Lights ---- */

/* Find out who stands in the way. lightThroughObjects has said how much is left; here it is asked why. */
static void findBlockers(Telling *telling, LightStory *story)
{
    const Scene *scene = telling->scene;
    HitSink sink = createHitSink(story->shadow.above, true);
    story->blockedAt = INFINITY;
    for (size_t i = 0; i < scene->objectCount && !cancelRequested(); i++) {
        const Object *object = &scene->objects[i];
        if (object->noShadow)
            continue;
        sink.count = 0;
        sink.keepAll = transmissivePart(scene, object) != NULL;
        sink.nearest.distance = INFINITY;
        intersectObject(object, &story->shadow.ray, &sink);
        if (!sink.keepAll && sink.nearest.distance < story->shadow.farthest &&
            sink.nearest.distance < story->blockedAt) {
            story->blocker = object;
            story->blockerPart = sink.nearest.object;
            story->blockedAt = sink.nearest.distance;
        }
        for (size_t h = 0; h < sink.count; h++) {
            const Hit *hit = &sink.all[h];
            if (!(hit->distance < story->shadow.farthest))
                continue;
            Color3f transmission = effectiveTransmission(scene, &hit->object->material);
            if (colorIsBlack(transmission)) {
                if (hit->distance < story->blockedAt) {
                    story->blocker = object;
                    story->blockerPart = hit->object;
                    story->blockedAt = hit->distance;
                }
                continue;
            }
            /* Keep the nearest crossings in order. */
            size_t kept = story->crossingCount < MOST_CROSSINGS ? story->crossingCount : MOST_CROSSINGS;
            size_t at = kept;
            while (at > 0 && story->crossings[at - 1].distance > hit->distance)
                at--;
            if (at < MOST_CROSSINGS) {
                size_t behind = kept < MOST_CROSSINGS ? kept - at : kept - at - 1;
                memmove(&story->crossings[at + 1], &story->crossings[at],
                        behind * sizeof story->crossings[0]);
                story->crossings[at] = (Crossing){object, hit->object, hit->distance, transmission};
            }
            story->crossingCount++;
        }
    }
    telling->outOfMemory = telling->outOfMemory || sink.outOfMemory;
    freeHitSink(&sink);
}

/* Ask whether the light reaches the point, and what is left of it. */
static void tellShadow(Telling *telling, const SurfacePoint *point, LightStory *story)
{
    const Scene *scene = telling->scene;
    story->hasShadowRay = true;
    story->shadow = shadowRayTo(scene, point, &story->arriving);
    story->reaching =
        lightThroughObjects(scene, NULL, scene->objectCount, &story->shadow, story->arriving.color);
    findBlockers(telling, story);
    if (colorIsBlack(story->reaching))
        story->fate = LIGHT_BLOCKED;
}

static LightStory beginLight(Telling *telling, const SurfacePoint *point, size_t light, int sample)
{
    const Light *lamp = &telling->scene->lights[light];
    LightStory story = {.light = light, .sample = sample};
    story.arriving = lightArriving(lamp, sample, point->position);
    story.il = lamp->kind == LIGHT_DIRECTIONAL ? story.arriving.direction
                                               : subVectors(story.arriving.position, point->position);
    story.cosine = dot(point->normal, story.arriving.direction);
    story.blockedAt = INFINITY;
    return story;
}

/* As shadeSimple. */
static Color3f tellSimple(Telling *telling, RayStory *story)
{
    const Scene *scene = telling->scene;
    story->isUnlit = !scene->render.shadows || scene->lightCount == 0;
    if (story->isUnlit)
        return story->material.diffuse;
    bool isLit = false;
    for (size_t n = 0; n < story->lightCount; n++) {
        LightStory *light = &story->lights[n];
        light->arriving.color = createColor(1, 1, 1);
        if (isLit) {
            light->fate = LIGHT_NOT_ASKED;
        } else if (!(light->cosine > 0)) {
            light->fate = LIGHT_BEHIND;
        } else {
            tellShadow(telling, &story->point, light);
            isLit = light->fate == LIGHT_REACHES;
        }
    }
    return isLit ? story->material.diffuse : createColor(0, 0, 0);
}

/* The highlight of a light and how it comes about. */
static void tellHighlight(const RayStory *story, LightStory *light)
{
    const Material *material = &story->material;
    Vector3D n = story->point.normal, l = light->arriving.direction;
    Vector3D v = multVector(story->ray.direction, -1);
    light->hasHighlight = true;
    if (story->model == MODEL_PHONG) {
        light->r = reflect(multVector(l, -1), n);
        light->highlightDot = dot(light->r, v);
        light->highlight = specularHighlight(material, light->reaching, n, l, v);
    } else {
        light->r = normalize(addVectors(v, l));
        light->highlightDot = blinnCosine(n, l, v);
        light->highlight = blinnHighlight(material, light->reaching, n, l, v);
    }
    if (light->highlightDot > 0)
        light->specFactor = highlightPower(light->highlightDot, (double)material->shininess);
}

/* As lightReturned. */
static Color3f tellLights(Telling *telling, RayStory *story)
{
    const Scene *scene = telling->scene;
    const Material *material = &story->material;
    bool hasHighlight = story->model >= MODEL_PHONG && !colorIsBlack(material->specular);
    for (size_t n = 0; n < story->lightCount; n++) {
        LightStory *light = &story->lights[n];
        light->fate = !(light->cosine > 0)                  ? LIGHT_BEHIND
                      : colorIsBlack(light->arriving.color) ? LIGHT_DARK
                                                            : LIGHT_REACHES;
        if (light->fate != LIGHT_REACHES)
            continue;
        light->reaching = light->arriving.color;
        if (scene->render.shadows)
            tellShadow(telling, &story->point, light);
        if (light->fate != LIGHT_REACHES)
            continue;
        light->diffuse =
            diffuseReflection(material, light->reaching, story->point.normal, light->arriving.direction);
        story->diffuseSum = addColors(story->diffuseSum, light->diffuse);
        if (!hasHighlight)
            continue;
        tellHighlight(story, light);
        story->highlightSum = addColors(story->highlightSum, light->highlight);
    }
    story->ambientTerm = multColors(material->ambient, scene->render.ambient);
    story->specularTerm = multColors(material->specular, story->highlightSum);
    Color3f own = addColors(story->ambientTerm, material->emission);
    return addColors(addColors(own, story->diffuseSum), story->specularTerm);
}

/* ---- Rays ---- */

static void freeRay(RayStory *story)
{
    if (story == NULL)
        return;
    freeRay(story->refracted);
    freeRay(story->mirrored);
    free(story->tried);
    free(story->lights);
    free(story);
}

static RayStory *tellRay(Telling *telling, RayRole role, Ray ray, const Media *media, int depth);

static RayStory *tellMirrored(Telling *telling, const RayStory *story, RayRole role)
{
    Vector3D direction = normalize(reflect(story->ray.direction, story->point.normal));
    Ray mirrored = createRay(offsetStart(&story->point, direction), direction);
    return tellRay(telling, role, mirrored, &story->media, story->depth + 1);
}

/* As addSecondaryRays. */
static Color3f tellSecondaryRays(Telling *telling, RayStory *story, Color3f color)
{
    const SurfacePoint *point = &story->point;
    const Material *material = &story->material;
    story->isTransparent = !colorIsBlack(material->transmission);
    if (story->isTransparent) {
        Media behind;
        double r = crossSurface(&story->media, point->object, (double)material->ior, &behind);
        double c = -dot(point->normal, story->ray.direction);
        story->ratio = r;
        story->cosine = c;
        story->k = 1 + r * r * (c * c - 1);
        if (story->k < 0) {
            story->refracted = tellMirrored(telling, story, RAY_TOTALLY_REFLECTED);
            return story->refracted != NULL ? addColors(color, story->refracted->color) : color;
        }
        Vector3D direction = addVectors(multVector(story->ray.direction, r),
                                        multVector(point->normal, r * c - sqrt(story->k)));
        direction = r == 1 ? story->ray.direction : normalize(direction);
        Ray refracted = createRay(offsetStart(point, direction), direction);
        story->refracted = tellRay(telling, RAY_REFRACTED, refracted, &behind, story->depth + 1);
        if (story->refracted != NULL)
            color = addColors(color, multColors(story->refracted->color, material->transmission));
    }
    if (!colorIsBlack(material->reflection)) {
        story->mirrored = tellMirrored(telling, story, RAY_MIRRORED);
        if (story->mirrored != NULL)
            color = addColors(color, multColors(material->reflection, story->mirrored->color));
    }
    return color;
}

/* As shade: what the surface sends back. */
static Color3f tellSurface(Telling *telling, RayStory *story)
{
    const Scene *scene = telling->scene;
    story->material = materialAt(story->point.hit.object, story->point.position);
    story->model = materialModel(scene, &story->material);

    /* Begin the story of each point light. */
    size_t count = 0;
    for (size_t i = 0; i < scene->lightCount; i++)
        count += (size_t)lightSampleCount(&scene->lights[i]);
    story->lights = calloc(count > 0 ? count : 1, sizeof *story->lights);
    if (story->lights == NULL) {
        telling->outOfMemory = true;
        return createColor(0, 0, 0);
    }
    for (size_t i = 0; i < scene->lightCount; i++)
        for (int sample = 0; sample < lightSampleCount(&scene->lights[i]); sample++)
            story->lights[story->lightCount++] = beginLight(telling, &story->point, i, sample);
    telling->lights += count;

    if (story->model == MODEL_SIMPLE)
        return story->local = tellSimple(telling, story);
    story->local = tellLights(telling, story);
    return tellSecondaryRays(telling, story, story->local);
}

/* As traceRay. NULL when memory runs out. */
static RayStory *tellRay(Telling *telling, RayRole role, Ray ray, const Media *media, int depth)
{
    const Scene *scene = telling->scene;
    RayStory *story = telling->outOfMemory ? NULL : calloc(1, sizeof *story);
    if (story == NULL) {
        telling->outOfMemory = true;
        return NULL;
    }
    story->role = role;
    story->ray = ray;
    story->media = *media;
    story->depth = depth;
    story->fogWeight = 1;
    if (depth > scene->render.maxDepth || cancelRequested()) {
        story->end = RAY_TOO_DEEP;
        return story;
    }
    if (telling->rays >= MOST_RAYS || telling->lights >= MOST_LIGHT_STORIES || depth > DEEPEST_RAY) {
        story->end = RAY_NOT_TOLD;
        story->color = story->seen = traceRay(telling->finder, &ray, media, depth, &telling->counts);
        return story;
    }
    telling->rays++;
    Hit hit;
    const Object *object = tellObjects(telling, story, &hit);
    double distance = INFINITY;
    if (object == NULL) {
        story->end = RAY_MEETS_NOTHING;
        story->seen = backgroundColor(&scene->background, &ray);
    } else {
        distance = hit.distance;
        story->point = surfacePointAt(&ray, object, &hit);
        story->seen = tellSurface(telling, story);
    }
    if (scene->fog.distance > 0)
        story->fogWeight = exp(-distance / scene->fog.distance);
    story->color = throughFog(&scene->fog, story->seen, distance);
    return story;
}

/* ---- The pixel ---- */

/* As tracePixel: the samples, of which one is told, and their mean. */
static void tellSamples(Telling *telling, PixelStory *story, const uint32_t *transparent,
                        size_t transparentCount)
{
    const Scene *scene = telling->scene;
    PixelRays rays =
        createPixelRays(scene, scene->image.width, scene->image.height, transparent, transparentCount);
    int n = scene->render.samples;
    ColorSum sum = {0};
    for (size_t number = 0; number < story->sampleCount; number++) {
        SampleStory *sample = &story->samples[number];
        int i = (int)(number % (size_t)n), j = (int)(number / (size_t)n);
        sample->x = story->x + (i + 0.5) / n;
        sample->y = story->y + (j + 0.5) / n;
        Media media;
        Ray ray = pixelRay(&rays, sample->x, sample->y, &media);
        if (number == story->told) {
            story->ray = tellRay(telling, RAY_OF_CAMERA, ray, &media, 1);
            if (story->ray == NULL)
                return;
            sample->color = story->ray->color;
        } else {
            sample->color = traceRay(telling->finder, &ray, &media, 1, &telling->counts);
        }
        addToSum(&sum, sample->color);
    }
    story->color = n == 1 ? story->samples[0].color : meanColor(sum, (double)n * n);
}

Status createPixelStory(const Scene *scene, int x, int y, PixelStory *story)
{
    size_t n = (size_t)scene->render.samples;
    PixelStory told = {.scene = scene, .x = x, .y = y, .sampleCount = n * n, .told = n / 2 * n + n / 2};
    told.samples = calloc(told.sampleCount, sizeof *told.samples);
    CompiledScene *compiled = NULL;
    size_t transparentCount = 0;
    bool failed = false;
    uint32_t *transparent = findTransparentObjects(scene, &transparentCount, &failed);
    Status status = statusOk();
    if (told.samples == NULL || failed)
        status = statusOutOfMemory();
    else
        status = compileScene(scene, availableProcessors(), &compiled);
    if (statusIsOk(&status)) {
        Telling telling = {.scene = scene, .finder = compiledFinder(compiled)};
        tellSamples(&telling, &told, transparent, transparentCount);
        told.rayCount = telling.rays;
        if (cancelRequested())
            status = statusInterrupted();
        else if (telling.outOfMemory)
            status = statusOutOfMemory();
        freeCompiledScene(compiled);
    }
    free(transparent);
    if (!statusIsOk(&status)) {
        freePixelStory(&told);
        return status;
    }
    const float channels[3] = {told.color.r, told.color.g, told.color.b};
    for (int i = 0; i < 3; i++)
        told.stored[i] = quantizeSample(channels[i], scene->image.bitDepth, scene->image.encoding);
    *story = told;
    return statusOk();
}

void freePixelStory(PixelStory *story)
{
    free(story->samples);
    freeRay(story->ray);
    *story = (PixelStory){0};
}

/* ---- Names ---- */

const char *objectKindName(const Object *object)
{
    static const char *const operations[] = {[CSG_UNION] = "union",
                                             [CSG_INTERSECTION] = "intersection",
                                             [CSG_DIFFERENCE] = "difference",
                                             [CSG_GROUP] = "group"};
    return object->kind == SHAPE_CSG ? operations[object->csg.operation] : objectShape(object)->name;
}

size_t objectNumber(const Scene *scene, const Object *object)
{
    return (size_t)(object - scene->objects);
}

void appendObjectName(const Scene *scene, const Object *object, const Object *part, Text *text)
{
    if (part != NULL && part != object) {
        textAppendFormat(text, "the %s", objectKindName(part));
        if (part->line > 0)
            textAppendFormat(text, " of line %d", part->line);
        textAppend(text, " in ");
    }
    if (object->line > 0)
        textAppendFormat(text, "the %s of line %d", objectKindName(object), object->line);
    else
        textAppendFormat(text, "the %s, object %zu of the scene", objectKindName(object),
                         objectNumber(scene, object) + 1);
}

const char *lightKindName(const Light *light)
{
    static const char *const names[] = {[LIGHT_POINT] = "point",
                                        [LIGHT_DIRECTIONAL] = "directional",
                                        [LIGHT_SPOT] = "spot",
                                        [LIGHT_AREA] = "area"};
    return names[light->kind];
}

const char *shadingModelName(ShadingModel model)
{
    static const char *const names[] = {[MODEL_OF_SCENE] = "the scene's",
                                        [MODEL_SIMPLE] = "simple",
                                        [MODEL_LAMBERT] = "lambert",
                                        [MODEL_PHONG] = "phong",
                                        [MODEL_BLINN_PHONG] = "blinn_phong"};
    return names[model];
}
