/* light_change.c - see light_change.h. */
#include "explain/light_change.h"

static const ChangedFinder *changedOf(const SurfaceFinder *finder)
{
    return (const ChangedFinder *)(const void *)finder;
}

static const Object *findNearest(const SurfaceFinder *finder, const Ray *ray, Hit *hit)
{
    const SurfaceFinder *base = changedOf(finder)->base;
    return base->nearest(base, ray, hit);
}

static Color3f findLight(const SurfaceFinder *finder, const ShadowRay *shadow, Color3f color)
{
    const ChangedFinder *changed = changedOf(finder);
    if (changed->change.shadows == SHADOWS_NONE)
        return color;
    ShadowRay longer = *shadow;
    if (changed->change.shadows == SHADOWS_TOO_LONG)
        longer.farthest = INFINITY;
    return changed->base->lightAlong(changed->base, &longer, color);
}

/* As the scene has it, for the surfaces that the change is not made on. */
static Color3f findUnchangedLight(const SurfaceFinder *finder, const ShadowRay *shadow, Color3f color)
{
    const SurfaceFinder *base = changedOf(finder)->base;
    return base->lightAlong(base, shadow, color);
}

static bool asksForShadows(const ChangedFinder *changed)
{
    return changed->change.shadows == SHADOWS_UNASKED ||
           (changed->change.shadows != SHADOWS_NONE && changed->base->scene->render.shadows);
}

/* The share of the light that arrives at the distance d. */
static double changedFalloff(const LightChange *change, double d)
{
    double faded = d / change->fadeDistance;
    switch (change->falloff) {
    case FALLOFF_POWER:
        return change->exponent == 0 ? 1 : pow(d, -change->exponent);
    case FALLOFF_POVRAY:
        return 2 / (1 + faded * faded);
    case FALLOFF_ONE_MORE:
        return 1 / (1 + faded * faded);
    case FALLOFF_LINEAR:
        return 1 / (1 + d);
    default:
        return 1 / (1 + d + d * d);
    }
}

/* The light that arrives, growing weaker as the change says. full gets what it would be without any falloff.
 */
static ArrivingLight changedArriving(const LightChange *change, const Light *light, int sample,
                                     Vector3D point, Color3f *full)
{
    Light even = *light;
    even.falloff = FALLOFF_NONE;
    ArrivingLight arriving = lightArriving(&even, sample, point);
    *full = arriving.color;
    if (change->falloff != FALLOFF_AS_SCENE && light->kind != LIGHT_DIRECTIONAL)
        arriving.color = scaleColor(arriving.color, changedFalloff(change, arriving.distance));
    else if (light->falloff != FALLOFF_NONE)
        return lightArriving(light, sample, point);
    return arriving;
}

/* The normal that the change takes for the point's. */
static Vector3D changedNormal(const LightChange *change, const SurfacePoint *point)
{
    switch (change->normals) {
    case NORMALS_FLIPPED:
        return multVector(point->normal, -1);
    case NORMALS_NOT_TURNED: {
        double step = 1e-6 * (1 + largestCoordinate(point->position));
        Vector3D above = addVectors(point->position, multVector(point->normal, step));
        return multVector(point->normal, objectContains(point->object, above) ? -1 : 1);
    }
    case NORMALS_FLAT:
        return multVector(point->flatNormal, dot(point->flatNormal, point->normal) < 0 ? -1 : 1);
    default:
        return point->normal;
    }
}

static void changeShininess(const LightChange *change, Material *material)
{
    if (change->shininess == SHININESS_TIMES)
        material->shininess = (float)((double)material->shininess * change->shininessValue);
    else if (change->shininess == SHININESS_IS ||
             (change->shininess == SHININESS_OF_ONE && material->shininess == change->shininessOf))
        material->shininess = (float)change->shininessValue;
}

static Color3f changedHighlight(const LightChange *change, ShadingModel model, const Material *material,
                                Color3f light, Vector3D n, Vector3D l, Vector3D v)
{
    bool blinn = (model == MODEL_BLINN_PHONG) != (change->highlight == HIGHLIGHT_OTHER_MODEL);
    return blinn ? blinnHighlight(material, light, n, l, v) : specularHighlight(material, light, n, l, v);
}

static bool sameColor(Color3f a, Color3f b)
{
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

bool sameMaterial(const Material *a, const Material *b)
{
    return sameColor(a->diffuse, b->diffuse) && sameColor(a->specular, b->specular) &&
           a->shininess == b->shininess && sameColor(a->ambient, b->ambient) &&
           sameColor(a->emission, b->emission) && sameColor(a->reflection, b->reflection) &&
           sameColor(a->transmission, b->transmission) && a->ior == b->ior && a->model == b->model &&
           a->pattern == b->pattern;
}

/* Whether the change is made at this point. */
static bool isChangedAt(const LightChange *change, const SurfacePoint *point)
{
    return (change->onlyObject == NULL || change->onlyObject == point->object) &&
           (change->onlyMaterial == NULL || sameMaterial(change->onlyMaterial, &point->hit.object->material));
}

/* As lightReturned, with the change. */
static Color3f changedLightReturned(const SurfaceFinder *finder, const SurfacePoint *point,
                                    const Material *material, Vector3D v, RayCounts *counts)
{
    const LightChange *change = &changedOf(finder)->change;
    if (!isChangedAt(change, point))
        return lightReturned(changedOf(finder)->base, point, material, v, counts);
    const Scene *scene = finder->scene;
    ShadingModel model = materialModel(scene, material);
    Material changed = *material;
    changeShininess(change, &changed);
    bool hasHighlight =
        model >= MODEL_PHONG && !colorIsBlack(material->specular) && change->highlight != HIGHLIGHT_NONE;
    Vector3D n = changedNormal(change, point);
    Color3f diffuse = createColor(0, 0, 0), highlight = createColor(0, 0, 0);
    for (size_t i = 0; i < scene->lightCount; i++) {
        if (i < 32 && (change->blockedLights >> i & 1) != 0)
            continue;
        const Light *light = &scene->lights[i];
        for (int sample = 0; sample < lightSampleCount(light); sample++) {
            Color3f full;
            ArrivingLight arriving = changedArriving(change, light, sample, point->position, &full);
            if (change->lightScale != 1 && (change->scaledLight == 0 || change->scaledLight == (int)i + 1)) {
                arriving.color = scaleColor(arriving.color, change->lightScale);
                full = scaleColor(full, change->lightScale);
            }
            double cosine = dot(n, arriving.direction);
            bool isBehind = !(cosine > 0);
            if ((isBehind && change->negative == NEGATIVE_AS_SCENE) || colorIsBlack(arriving.color))
                continue;

            /* What is left of it after the shadows, as a share of each channel. */
            bool asksShadow = asksForShadows(changedOf(finder)) && (int)i + 1 != change->shadowlessLight &&
                              !(isBehind && change->backUnshadowed);
            if (asksShadow) {
                counts->shadow++;
                ShadowRay shadow = shadowRayTo(scene, point, &arriving);
                Color3f share = findLight(finder, &shadow, createColor(1, 1, 1));
                if (colorIsBlack(share))
                    continue;
                arriving.color = multColors(arriving.color, share);
                full = multColors(full, share);
            }
            if (!isBehind || change->negative != NEGATIVE_HIGHLIGHT) {
                double used = change->negative == NEGATIVE_ABSOLUTE ? fabs(cosine) : cosine;
                diffuse = addColors(diffuse, multColors(scaleColor(changed.diffuse, used), arriving.color));
            }
            if (!hasHighlight || (isBehind && change->negative == NEGATIVE_SUBTRACTS))
                continue;
            Color3f shining = change->highlight == HIGHLIGHT_NO_FALLOFF ? full : arriving.color;
            Vector3D facing = isBehind && change->negative == NEGATIVE_ABSOLUTE ? multVector(n, -1) : n;
            highlight = addColors(
                highlight, changedHighlight(change, model, &changed, shining, facing, arriving.direction, v));
        }
    }
    Color3f ambient = multColors(material->ambient, scene->render.ambient);
    Color3f own = addColors(scaleColor(ambient, change->ambientScale), material->emission);
    Color3f ks = change->highlight == HIGHLIGHT_DIFFUSE ? multColors(material->specular, material->diffuse)
                                                        : material->specular;
    return addColors(addColors(own, diffuse), multColors(ks, highlight));
}

void createChangedFinder(const SurfaceFinder *base, const LightChange *change, ChangedFinder *finder)
{
    *finder = (ChangedFinder){.base = base, .change = *change, .scene = *base->scene};
    bool isOfAll = change->onlyObject == NULL && change->onlyMaterial == NULL;
    if (isOfAll)
        finder->scene.render.shadows = asksForShadows(finder);
    finder->finder = (SurfaceFinder){.scene = &finder->scene,
                                     .nearest = findNearest,
                                     .lightAlong = isOfAll ? findLight : findUnchangedLight,
                                     .lightShader = changedLightReturned};
}
