/* raytracer.c - the course's tracer; see raytracer.h.
 *
 * Read it from the end upwards: renderTile sends rays through each pixel, traceRay finds what one meets,
 * shade adds up what the surface returns, lightThatReaches asks what hides a light.
 */
#include "raytracer.h"

#include "base/cancel.h"
#include "base/threads.h"

#include <stdatomic.h>
#include <stdlib.h>

/* ---- Where a ray meets the scene ---- */

/* SurfaceFinder's nearest: look at all objects. */
static const Object *findNearest(const SurfaceFinder *finder, const Ray *ray, Hit *hit)
{
    const Scene *scene = finder->scene;
    const Object *nearest = NULL;
    HitSink sink = createHitSink(0, false);
    for (size_t i = 0; i < scene->objectCount; i++) {
        double before = sink.nearest.distance;
        intersectObject(&scene->objects[i], ray, &sink);
        if (sink.nearest.distance < before)
            nearest = &scene->objects[i];
    }
    *hit = sink.nearest;
    return nearest;
}

bool throwRayThroughScene(Ray ray, Scene scene, Intersection *intersection)
{
    Hit hit;
    SurfaceFinder finder = {.scene = &scene};
    if (findNearest(&finder, &ray, &hit) == NULL)
        return false;
    *intersection = intersectionAt(&ray, &hit);
    return true;
}

SurfacePoint surfacePointAt(const Ray *ray, const Object *object, const Hit *hit)
{
    SurfacePoint point = {.object = object, .hit = *hit};
    point.position = pointOnRay(ray, hit->distance);
    point.normal = objectNormal(ray, hit, point.position);
    point.flatNormal = objectFlatNormal(hit, point.normal);
    point.offset = hitMagnitude(hit->object, ray, hit->distance) * ROUNDING_MARGIN;
    return point;
}

/* ---- Shadows ---- */

/* Shadow acne, and what to do about it (handout, exercise 04, questions 03 and 04). The computed point
 * is not on the surface but, by rounding, a little above or below it. From below, the ray to the light
 * meets the very surface it starts on, and the point shadows itself: half of the points do, in a
 * pattern of specks. Taking double for float makes the gap smaller, not the specks fewer.
 *
 * The remedy is to start the ray a little above the surface, on the side that is seen. How little? A
 * fixed 0.001 is too much for a scene of millimetres and too little for one of kilometres. But the
 * rounding error is known: it is a few units in the last place of the largest number that went into
 * the point. So the step is 2^-40 of that number: some thousand times the error, and a million
 * millionth of the scene. Every ray that leaves the surface steps off it to the side that it leaves to,
 * refracted ones to the other one. The light's end has the same trouble when the light lies on a surface,
 * and the same remedy.
 *
 * A scene that gives a shadow bias gets the textbook's remedy instead, for comparison: start on the
 * surface, and count only what is farther than the bias. With 0 the acne is back. */
Vector3D offsetStart(const SurfacePoint *point, Vector3D direction)
{
    double step = copysign(point->offset, dot(point->flatNormal, direction));
    return addVectors(point->position, multVector(point->flatNormal, step));
}

Color3f effectiveTransmission(const Scene *scene, const Material *material)
{
    return materialModel(scene, material) == MODEL_SIMPLE ? createColor(0, 0, 0) : material->transmission;
}

const Material *transmissivePart(const Scene *scene, const Object *object)
{
    if (object->kind != SHAPE_CSG)
        return colorIsBlack(effectiveTransmission(scene, &object->material)) ? NULL : &object->material;
    for (size_t i = 0; i < object->csg.partCount; i++) {
        const Material *material = transmissivePart(scene, &object->csg.parts[i]);
        if (material != NULL)
            return material;
    }
    return NULL;
}

ShadowRay shadowRayFrom(Vector3D start, const ArrivingLight *arriving)
{
    ShadowRay shadow = {.ray = createRay(start, arriving->direction), .farthest = INFINITY};
    if (isfinite(arriving->distance)) {
        Vector3D toLight = subVectors(arriving->position, start);
        double distance = norm(toLight);
        shadow.ray.direction = normalize(toLight);
        shadow.farthest = distance - (distance + largestCoordinate(arriving->position)) * ROUNDING_MARGIN;
    }
    return shadow;
}

ShadowRay shadowRayTo(const Scene *scene, const SurfacePoint *point, const ArrivingLight *arriving)
{
    double bias = scene->render.shadowBias;
    if (isnan(bias))
        return shadowRayFrom(offsetStart(point, arriving->direction), arriving);
    ShadowRay shadow = shadowRayFrom(point->position, arriving);
    shadow.above = bias;
    shadow.farthest =
        isfinite(arriving->distance) ? norm(subVectors(arriving->position, point->position)) : INFINITY;
    return shadow;
}

Color3f lightThroughObjects(const Scene *scene, const uint32_t *objects, size_t count,
                            const ShadowRay *shadow, Color3f color)
{
    /* A blocker counts only between the point and the light. Of an opaque one any hit will do. */
    double farthest = shadow->farthest;
    HitSink sink = createHitSink(shadow->above, true);
    for (size_t i = 0; i < count && !colorIsBlack(color); i++) {
        const Object *blocker = &scene->objects[objects != NULL ? objects[i] : i];
        if (blocker->noShadow)
            continue;
        size_t before = sink.count;
        sink.keepAll = transmissivePart(scene, blocker) != NULL;
        sink.nearest.distance = farthest;
        intersectObject(blocker, &shadow->ray, &sink);
        bool blocked = !sink.keepAll && sink.nearest.distance < farthest;
        for (size_t h = before; h < sink.count && !blocked; h++)
            blocked = sink.all[h].distance < farthest &&
                      colorIsBlack(effectiveTransmission(scene, &sink.all[h].object->material));
        if (blocked)
            color = createColor(0, 0, 0);
    }

    /* Filter by what is left, which is transparent, in the order in which the light is met. */
    if (!colorIsBlack(color) && sink.count > 0) {
        sortHits(&sink);
        for (size_t h = 0; h < sink.count && sink.all[h].distance < farthest; h++)
            color = multColors(color, effectiveTransmission(scene, &sink.all[h].object->material));
    }
    freeHitSink(&sink);
    return color;
}

/* SurfaceFinder's lightAlong: look at all objects. */
static Color3f findLight(const SurfaceFinder *finder, const ShadowRay *shadow, Color3f color)
{
    return lightThroughObjects(finder->scene, NULL, finder->scene->objectCount, shadow, color);
}

/* What is left of the light after all that lies between the point and it. */
static Color3f lightThatReaches(const SurfaceFinder *finder, const SurfacePoint *point,
                                const ArrivingLight *arriving)
{
    ShadowRay shadow = shadowRayTo(finder->scene, point, arriving);
    return finder->lightAlong(finder, &shadow, arriving->color);
}

/* ---- What leaves a surface ---- */

/* The simple model: the diffuse colour where a light reaches the point, or where that is not asked. */
static Color3f shadeSimple(const SurfaceFinder *finder, const SurfacePoint *point, const Material *material,
                           RayCounts *counts)
{
    const Scene *scene = finder->scene;
    if (!scene->render.shadows || scene->lightCount == 0)
        return material->diffuse;
    for (size_t i = 0; i < scene->lightCount; i++) {
        for (int sample = 0; sample < lightSampleCount(&scene->lights[i]); sample++) {
            ArrivingLight arriving = lightArriving(&scene->lights[i], sample, point->position);
            if (!(dot(point->normal, arriving.direction) > 0))
                continue;
            /* Falloff, cone and colour play no part. */
            arriving.color = createColor(1, 1, 1);
            counts->shadow++;
            if (!colorIsBlack(lightThatReaches(finder, point, &arriving)))
                return material->diffuse;
        }
    }
    return createColor(0, 0, 0);
}

Color3f lightReturned(const SurfaceFinder *finder, const SurfacePoint *point, const Material *material,
                      Vector3D v, RayCounts *counts)
{
    const Scene *scene = finder->scene;
    ShadingModel model = materialModel(scene, material);
    bool hasHighlight = model >= MODEL_PHONG && !colorIsBlack(material->specular);
    Color3f diffuse = createColor(0, 0, 0), highlight = createColor(0, 0, 0);
    for (size_t i = 0; i < scene->lightCount; i++) {
        const Light *light = &scene->lights[i];
        for (int sample = 0; sample < lightSampleCount(light); sample++) {
            ArrivingLight arriving = lightArriving(light, sample, point->position);
            Vector3D l = arriving.direction;

            /* A light behind the surface adds nothing. */
            if (!(dot(point->normal, l) > 0) || colorIsBlack(arriving.color))
                continue;
            if (scene->render.shadows) {
                counts->shadow++;
                arriving.color = lightThatReaches(finder, point, &arriving);
                if (colorIsBlack(arriving.color))
                    continue;
            }

            /* Add Ic * Lc * dot(N, IL/|IL|) / |IL|^2, and for Phong Lc * specFactor / |IL|^2. */
            diffuse = addColors(diffuse, diffuseReflection(material, arriving.color, point->normal, l));
            if (hasHighlight)
                highlight = addColors(highlight,
                                      model == MODEL_PHONG
                                          ? specularHighlight(material, arriving.color, point->normal, l, v)
                                          : blinnHighlight(material, arriving.color, point->normal, l, v));
        }
    }

    /* Ispec is the same for all lights, so it multiplies their sum. In this order and with each step
     * rounded to float, POV-Ray's layers (povray/MAPPING.md) give the same bits. */
    Color3f own = addColors(multColors(material->ambient, scene->render.ambient), material->emission);
    return addColors(addColors(own, diffuse), multColors(material->specular, highlight));
}

double crossSurface(const Media *media, const Object *object, double ior, Media *behind)
{
    *behind = *media;
    int last = media->count - 1;
    double outside = last >= 0 ? (double)media->objects[last]->material.ior : 1;
    for (int i = last; i >= 0; i--) {
        if (media->objects[i] != object)
            continue;
        /* Leaving: the last one entered into what was before it, another one without bending. */
        for (int j = i; j < last; j++)
            behind->objects[j] = media->objects[j + 1];
        behind->count = last;
        if (i < last)
            return 1;
        return ior / (last > 0 ? (double)media->objects[last - 1]->material.ior : 1);
    }
    if (behind->count < MAX_MEDIA)
        behind->objects[behind->count++] = object;
    return outside / ior;
}

/* What comes along the mirrored ray. */
static Color3f traceMirrored(const SurfaceFinder *finder, const SurfacePoint *point, const Ray *ray,
                             const Media *media, int depth, RayCounts *counts)
{
    Vector3D direction = normalize(reflect(ray->direction, point->normal));
    Ray mirrored = createRay(offsetStart(point, direction), direction);
    counts->secondary++;
    return traceRay(finder, &mirrored, media, depth + 1, counts);
}

Color3f addSecondaryRays(const SurfaceFinder *finder, const SurfacePoint *point, const Material *material,
                         const Ray *ray, const Media *media, int depth, Color3f color, RayCounts *counts)
{
    if (!colorIsBlack(material->transmission)) {
        /* Snell's law: the refracted direction is r d + (r c - sqrt(k)) n, with c = -n.d, r the ratio of
         * the indices and k = 1 - r^2 (1 - c^2); where k < 0 the reflection is total (Heckbert 1989,
         * "Derivation of refraction formulas", in An Introduction to Ray Tracing). */
        Media behind;
        double r = crossSurface(media, point->object, (double)material->ior, &behind);
        double c = -dot(point->normal, ray->direction);
        double k = 1 + r * r * (c * c - 1);
        if (k < 0)
            return addColors(color, traceMirrored(finder, point, ray, media, depth, counts));
        Vector3D direction =
            addVectors(multVector(ray->direction, r), multVector(point->normal, r * c - sqrt(k)));
        direction = r == 1 ? ray->direction : normalize(direction);
        Ray refracted = createRay(offsetStart(point, direction), direction);
        counts->secondary++;
        Color3f through = traceRay(finder, &refracted, &behind, depth + 1, counts);
        color = addColors(color, multColors(through, material->transmission));
    }
    if (!colorIsBlack(material->reflection)) {
        Color3f mirrored = traceMirrored(finder, point, ray, media, depth, counts);
        color = addColors(color, multColors(material->reflection, mirrored));
    }
    return color;
}

Color3f shade(const SurfaceFinder *finder, const SurfacePoint *point, const Ray *ray, const Media *media,
              int depth, RayCounts *counts)
{
    Material material = materialAt(point->hit.object, point->position);
    if (materialModel(finder->scene, &material) == MODEL_SIMPLE)
        return shadeSimple(finder, point, &material, counts);
    LightShader *shadeWith = finder->lightShader != NULL ? finder->lightShader : lightReturned;
    Color3f color = shadeWith(finder, point, &material, multVector(ray->direction, -1), counts);
    return addSecondaryRays(finder, point, &material, ray, media, depth, color, counts);
}

/* ---- One ray ---- */

Color3f backgroundColor(const Background *background, const Ray *ray)
{
    if (!background->isGradient)
        return background->bottom;
    double t = (1 + ray->direction.y) / 2;
    return mixColors(background->bottom, background->top, t);
}

Color3f throughFog(const Fog *fog, Color3f color, double distance)
{
    if (!(fog->distance > 0))
        return color;
    double weight = exp(-distance / fog->distance);
    return addColors(scaleColor(fog->color, 1 - weight), scaleColor(color, (double)(float)weight));
}

Color3f traceRay(const SurfaceFinder *finder, const Ray *ray, const Media *media, int depth,
                 RayCounts *counts)
{
    const Scene *scene = finder->scene;
    if (depth > scene->render.maxDepth || cancelRequested())
        return createColor(0, 0, 0);
    Hit hit;
    const Object *object = finder->nearest(finder, ray, &hit);
    if (object == NULL)
        return throughFog(&scene->fog, backgroundColor(&scene->background, ray), INFINITY);
    SurfacePoint point = surfacePointAt(ray, object, &hit);
    return throughFog(&scene->fog, shade(finder, &point, ray, media, depth, counts), hit.distance);
}

/* ---- The media round the camera ---- */

uint32_t *findTransparentObjects(const Scene *scene, size_t *count, bool *failed)
{
    uint32_t *found = NULL;
    size_t capacity = 0;
    *count = 0;
    *failed = false;
    for (size_t i = 0; i < scene->objectCount; i++) {
        if (transmissivePart(scene, &scene->objects[i]) == NULL)
            continue;
        if (*count == capacity) {
            capacity = capacity == 0 ? 16 : 2 * capacity;
            uint32_t *larger = realloc(found, capacity * sizeof *larger);
            if (larger == NULL) {
                free(found);
                *failed = true;
                return NULL;
            }
            found = larger;
        }
        found[(*count)++] = (uint32_t)i;
    }
    return found;
}

/* Which of these objects, given by their numbers in the scene in rising order, contain the point. */
static Media mediaAmong(const Scene *scene, const uint32_t *objects, size_t count, Vector3D point)
{
    Media media = {.count = 0};
    for (size_t i = 0; i < count && media.count < MAX_MEDIA; i++)
        if (objectContains(&scene->objects[objects[i]], point))
            media.objects[media.count++] = &scene->objects[objects[i]];
    return media;
}

/* ---- One pixel ---- */

PixelRays createPixelRays(const Scene *scene, int width, int height, const uint32_t *transparent,
                          size_t transparentCount)
{
    return (PixelRays){.scene = scene,
                       .width = width,
                       .height = height,
                       .frame = cameraFrame(&scene->camera, width, height),
                       .transparent = transparent,
                       .transparentCount = transparentCount,
                       .media = mediaAmong(scene, transparent, transparentCount, scene->camera.position)};
}

Media cameraMedia(const PixelRays *rays, const Ray *ray)
{
    if (rays->frame.projection == PROJECTION_PERSPECTIVE)
        return rays->media;
    return mediaAmong(rays->scene, rays->transparent, rays->transparentCount, ray->origin);
}

Ray pixelRay(const PixelRays *rays, double x, double y, Media *media)
{
    if (rays->movePoint != NULL)
        rays->movePoint(rays->moveContext, rays->width, rays->height, &x, &y);
    Ray ray = cameraRay(&rays->frame, x, y, rays->width, rays->height);
    *media = cameraMedia(rays, &ray);
    return ray;
}

Color3f tracePixel(const PixelRays *rays, const SurfaceFinder *finder, int x, int y, RayCounts *counts)
{
    int n = rays->scene->render.samples;
    ColorSum sum = {0};
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            Media media;
            Ray ray = pixelRay(rays, x + (i + 0.5) / n, y + (j + 0.5) / n, &media);
            counts->primary++;
            Color3f color = traceRay(finder, &ray, &media, 1, counts);
            if (n == 1)
                return color;
            addToSum(&sum, color);
        }
    }
    return meanColor(sum, (double)n * n);
}

/* ---- The picture ---- */

enum {
    TILE_SIZE = 32
};

typedef struct Rendering {
    const SurfaceFinder *finder;
    PixelRays rays;
    Framebuffer *framebuffer;
    const RenderOptions *options;
    size_t tileColumns, tileCount;
    atomic_size_t tilesDone;
    _Atomic uint64_t primary, shadow, secondary;
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

    RayCounts counts = {0};
    for (int y = top; y < bottom; y++)
        for (int x = left; x < right && !cancelRequested(); x++)
            putLinearPixel(framebuffer, x, y, tracePixel(&rendering->rays, rendering->finder, x, y, &counts));

    rendering->primary += counts.primary;
    rendering->shadow += counts.shadow;
    rendering->secondary += counts.secondary;
    size_t done = atomic_fetch_add(&rendering->tilesDone, 1) + 1;
    if (rendering->options->progress != NULL)
        rendering->options->progress(rendering->options->progressContext,
                                     (double)done / (double)rendering->tileCount);
}

Status renderWithFinder(const SurfaceFinder *finder, Framebuffer *framebuffer, const RenderOptions *options,
                        RayCounts *counts)
{
    const Scene *scene = finder->scene;
    size_t columns = ((size_t)framebuffer->width + TILE_SIZE - 1) / TILE_SIZE;
    size_t rows = ((size_t)framebuffer->height + TILE_SIZE - 1) / TILE_SIZE;
    size_t transparentCount;
    bool failed;
    uint32_t *transparent = findTransparentObjects(scene, &transparentCount, &failed);
    if (failed)
        return statusOutOfMemory();
    Rendering rendering = {.finder = finder,
                           .rays = createPixelRays(scene, framebuffer->width, framebuffer->height,
                                                   transparent, transparentCount),
                           .framebuffer = framebuffer,
                           .options = options,
                           .tileColumns = columns,
                           .tileCount = columns * rows};
    Status status = runTasks(rendering.tileCount, options->threads, renderTile, &rendering);
    free(transparent);
    if (counts != NULL)
        *counts = (RayCounts){
            .primary = rendering.primary, .shadow = rendering.shadow, .secondary = rendering.secondary};
    return status;
}

Status renderReference(const Scene *scene, Framebuffer *framebuffer, const RenderOptions *options,
                       RayCounts *counts)
{
    SurfaceFinder finder = {.scene = scene, .nearest = findNearest, .lightAlong = findLight};
    return renderWithFinder(&finder, framebuffer, options, counts);
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
