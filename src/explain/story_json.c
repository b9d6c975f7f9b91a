/* story_json.c - the story of a pixel as JSON, all numbers in full; see story_writers.h.
 *
 * The tree of rays is a list, since a JSON document that nests as deep as rays do is of no use: each ray has
 * its number and that of the ray it comes from.
 */
#include "explain/story_writers.h"

static void keyVector(JsonWriter *json, const char *key, Vector3D v)
{
    jsonKey(json, key);
    jsonInlineArray(json);
    jsonNumber(json, v.x);
    jsonNumber(json, v.y);
    jsonNumber(json, v.z);
    jsonEndArray(json);
}

static void keyColor(JsonWriter *json, const char *key, Color3f c)
{
    keyVector(json, key, createVector((double)c.r, (double)c.g, (double)c.b));
}

static void keySamples(JsonWriter *json, const char *key, const unsigned samples[3])
{
    jsonKey(json, key);
    jsonInlineArray(json);
    for (int i = 0; i < 3; i++)
        jsonInteger(json, (int64_t)samples[i]);
    jsonEndArray(json);
}

static void keyWhole(JsonWriter *json, const char *key, size_t value)
{
    jsonKeyInteger(json, key, (int64_t)value);
}

/* An object: number in the scene from 1, kind and line, and its part's where that is another. */
static void keyObject(JsonWriter *json, const char *key, const Scene *scene, const Object *object,
                      const Object *part)
{
    if (key != NULL)
        jsonKey(json, key);
    if (object == NULL) {
        jsonNull(json);
        return;
    }
    jsonInlineObject(json);
    keyWhole(json, "number", objectNumber(scene, object) + 1);
    jsonKeyString(json, "kind", objectKindName(object));
    jsonKey(json, "line");
    if (object->line > 0)
        jsonInteger(json, object->line);
    else
        jsonNull(json);
    if (part != NULL && part != object) {
        jsonKey(json, "part");
        jsonInlineObject(json);
        jsonKeyString(json, "kind", objectKindName(part));
        jsonKeyInteger(json, "line", part->line);
        jsonEndObject(json);
    }
    jsonEndObject(json);
}

static void writeTried(JsonWriter *json, const Scene *scene, const RayStory *ray)
{
    keyWhole(json, "objects_met", ray->metCount);
    keyWhole(json, "objects_missed", ray->missedCount);
    jsonKey(json, "objects");
    jsonArray(json);
    for (size_t i = 0; i < ray->triedCount; i++) {
        jsonInlineObject(json);
        keyObject(json, "object", scene, ray->tried[i].object, ray->tried[i].part);
        jsonKeyBool(json, "met", ray->tried[i].part != NULL);
        jsonKeyNumber(json, "distance", ray->tried[i].distance);
        jsonEndObject(json);
    }
    jsonEndArray(json);
}

static void writeShadow(JsonWriter *json, const Scene *scene, const LightStory *light)
{
    jsonKey(json, "shadow");
    if (!light->hasShadowRay) {
        jsonNull(json);
        return;
    }
    jsonObject(json);
    keyVector(json, "origin", light->shadow.ray.origin);
    keyVector(json, "direction", light->shadow.ray.direction);
    jsonKeyNumber(json, "above", light->shadow.above);
    jsonKeyNumber(json, "farthest", light->shadow.farthest);
    keyObject(json, "blocker", scene, light->blocker, light->blockerPart);
    jsonKeyNumber(json, "blocked_at", light->blockedAt);
    keyWhole(json, "transparent_surfaces", light->crossingCount);
    jsonKey(json, "crossings");
    jsonArray(json);
    for (size_t i = 0; i < light->crossingCount && i < MOST_CROSSINGS; i++) {
        const Crossing *crossing = &light->crossings[i];
        jsonInlineObject(json);
        keyObject(json, "object", scene, crossing->object, crossing->part);
        jsonKeyNumber(json, "distance", crossing->distance);
        keyColor(json, "transmission", crossing->transmission);
        jsonEndObject(json);
    }
    jsonEndArray(json);
    jsonEndObject(json);
}

static void writeLight(JsonWriter *json, const Scene *scene, const RayStory *ray, const LightStory *light)
{
    static const char *const fates[] = {[LIGHT_REACHES] = "reaches",
                                        [LIGHT_BEHIND] = "behind",
                                        [LIGHT_DARK] = "dark",
                                        [LIGHT_BLOCKED] = "blocked",
                                        [LIGHT_NOT_ASKED] = "not_asked"};
    const Light *lamp = &scene->lights[light->light];
    jsonObject(json);
    keyWhole(json, "light", light->light + 1);
    jsonKeyString(json, "kind", lightKindName(lamp));
    jsonKeyInteger(json, "point_light", light->sample + 1);
    jsonKeyInteger(json, "point_lights", lightSampleCount(lamp));
    jsonKeyString(json, "fate", fates[light->fate]);
    keyColor(json, "lc", lamp->color);
    jsonKeyString(json, "falloff",
                  lamp->kind == LIGHT_DIRECTIONAL || lamp->falloff == FALLOFF_NONE ? "none"
                                                                                   : "inverse_square");
    keyVector(json, "il", light->il);
    jsonKeyNumber(json, "distance", light->arriving.distance);
    keyVector(json, "l", light->arriving.direction);
    jsonKeyNumber(json, "n_dot_l", light->cosine);
    keyColor(json, "arriving", light->arriving.color);
    writeShadow(json, scene, light);
    keyColor(json, "reaching", light->reaching);
    keyColor(json, "diffuse", light->diffuse);
    if (light->hasHighlight) {
        bool isPhong = ray->model == MODEL_PHONG;
        keyVector(json, isPhong ? "r" : "h", light->r);
        jsonKeyNumber(json, isPhong ? "r_dot_v" : "n_dot_h", light->highlightDot);
        jsonKeyNumber(json, "spec_factor", light->specFactor);
        keyColor(json, "specular", multColors(ray->material.specular, light->highlight));
    }
    jsonEndObject(json);
}

static void writeSurface(JsonWriter *json, const Scene *scene, const RayStory *ray)
{
    const Material *material = &ray->material;
    keyObject(json, "object", scene, ray->point.object, ray->point.hit.object);
    jsonKeyNumber(json, "distance", ray->point.hit.distance);
    keyVector(json, "point", ray->point.position);
    keyVector(json, "n", ray->point.normal);
    keyVector(json, "v", multVector(ray->ray.direction, -1));
    jsonKeyString(json, "model", shadingModelName(ray->model));
    jsonKey(json, "material");
    jsonObject(json);
    keyColor(json, "ic", material->diffuse);
    jsonKeyBool(json, "has_pattern", material->pattern != NULL);
    keyColor(json, "ispec", material->specular);
    jsonKeyNumber(json, "shininess", (double)material->shininess);
    keyColor(json, "ambient", material->ambient);
    keyColor(json, "emission", material->emission);
    keyColor(json, "reflection", material->reflection);
    keyColor(json, "transmission", material->transmission);
    jsonKeyNumber(json, "ior", (double)material->ior);
    jsonEndObject(json);
    jsonKey(json, "lights");
    jsonArray(json);
    for (size_t i = 0; i < ray->lightCount && !ray->isUnlit; i++)
        writeLight(json, scene, ray, &ray->lights[i]);
    jsonEndArray(json);
    jsonKey(json, "terms");
    jsonObject(json);
    keyColor(json, "ambient", ray->ambientTerm);
    keyColor(json, "emission", ray->model == MODEL_SIMPLE ? createColor(0, 0, 0) : material->emission);
    keyColor(json, "diffuse", ray->diffuseSum);
    keyColor(json, "specular", ray->specularTerm);
    keyColor(json, "local", ray->local);
    bool isTotal = ray->refracted != NULL && ray->refracted->role == RAY_TOTALLY_REFLECTED;
    Color3f black = createColor(0, 0, 0);
    keyColor(json, "refracted",
             ray->refracted == NULL ? black
             : isTotal              ? ray->refracted->color
                                    : multColors(ray->refracted->color, material->transmission));
    keyColor(json, "mirrored",
             ray->mirrored == NULL ? black : multColors(material->reflection, ray->mirrored->color));
    jsonEndObject(json);
    jsonKey(json, "refraction");
    if (ray->isTransparent) {
        jsonInlineObject(json);
        jsonKeyNumber(json, "n1_over_n2", ray->ratio);
        jsonKeyNumber(json, "cosine_in", ray->cosine);
        jsonKeyNumber(json, "k", ray->k);
        jsonKeyBool(json, "total_reflection", ray->k < 0);
        jsonEndObject(json);
    } else {
        jsonNull(json);
    }
}

/* Write the ray and those that come from it; next is the number of the next one. */
static void writeRay(JsonWriter *json, const Scene *scene, const RayStory *ray, int parent, int *next)
{
    static const char *const roles[] = {[RAY_OF_CAMERA] = "camera",
                                        [RAY_MIRRORED] = "mirrored",
                                        [RAY_REFRACTED] = "refracted",
                                        [RAY_TOTALLY_REFLECTED] = "total_reflection"};
    static const char *const ends[] = {[RAY_MEETS_SURFACE] = "surface",
                                       [RAY_MEETS_NOTHING] = "background",
                                       [RAY_TOO_DEEP] = "max_depth",
                                       [RAY_NOT_TOLD] = "not_told"};
    int number = (*next)++;
    jsonObject(json);
    jsonKeyInteger(json, "number", number);
    jsonKey(json, "parent");
    if (parent > 0)
        jsonInteger(json, parent);
    else
        jsonNull(json);
    jsonKeyString(json, "role", roles[ray->role]);
    jsonKeyInteger(json, "depth", ray->depth);
    keyVector(json, "origin", ray->ray.origin);
    keyVector(json, "direction", ray->ray.direction);
    jsonKey(json, "media");
    jsonArray(json);
    for (int i = 0; i < ray->media.count; i++)
        keyObject(json, NULL, scene, ray->media.objects[i], NULL);
    jsonEndArray(json);
    jsonKeyString(json, "end", ends[ray->end]);
    writeTried(json, scene, ray);
    if (ray->end == RAY_MEETS_SURFACE)
        writeSurface(json, scene, ray);
    keyColor(json, "seen", ray->seen);
    jsonKeyNumber(json, "fog_weight", ray->fogWeight);
    keyColor(json, "color", ray->color);
    jsonEndObject(json);
    if (ray->refracted != NULL)
        writeRay(json, scene, ray->refracted, number, next);
    if (ray->mirrored != NULL)
        writeRay(json, scene, ray->mirrored, number, next);
}

static void writePovray(JsonWriter *json, const PovrayPixel *povray)
{
    jsonKey(json, "povray");
    if (povray == NULL) {
        jsonNull(json);
        return;
    }
    jsonObject(json);
    if (!statusIsOk(&povray->status)) {
        jsonKey(json, "linear");
        jsonNull(json);
        jsonKey(json, "error");
        jsonInlineObject(json);
        jsonKeyInteger(json, "code", (int64_t)povray->status.code);
        jsonKeyString(json, "message", povray->status.message);
        jsonEndObject(json);
    } else {
        keyVector(json, "linear",
                  createVector(povray->samples[0] / 65535.0, povray->samples[1] / 65535.0,
                               povray->samples[2] / 65535.0));
        keySamples(json, "linear_16_bit", povray->samples);
        keySamples(json, "stored", povray->stored);
        jsonKeyNumber(json, "difference", povray->difference);
        jsonKeyBool(json, "agrees", povray->agrees);
    }
    jsonEndObject(json);
}

void writeStoryJson(const PixelStory *story, const PovrayPixel *povray, const char *name, Text *text)
{
    static const char *const channels[] = {"r", "g", "b"};
    const Scene *scene = story->scene;
    JsonWriter json = jsonBegin(text);
    jsonObject(&json);
    jsonKeyString(&json, "scene", name);
    jsonKeyInteger(&json, "x", story->x);
    jsonKeyInteger(&json, "y", story->y);
    jsonKeyInteger(&json, "width", scene->image.width);
    jsonKeyInteger(&json, "height", scene->image.height);
    jsonKeyInteger(&json, "bit_depth", scene->image.bitDepth);
    jsonKeyString(&json, "encoding", scene->image.encoding == ENCODING_LINEAR ? "linear" : "srgb");
    jsonKey(&json, "ours");
    jsonObject(&json);
    keyColor(&json, "linear", story->color);
    const float linear[3] = {story->color.r, story->color.g, story->color.b};
    unsigned samples[3];
    for (int i = 0; i < 3; i++)
        samples[i] = quantizeSample(linear[i], 16, ENCODING_LINEAR);
    keySamples(&json, "linear_16_bit", samples);
    keySamples(&json, "stored", story->stored);
    jsonKey(&json, "clamped");
    jsonInlineArray(&json);
    for (int i = 0; i < 3; i++)
        if (!(linear[i] >= 0 && linear[i] <= 1))
            jsonString(&json, channels[i]);
    jsonEndArray(&json);
    jsonEndObject(&json);
    writePovray(&json, povray);
    jsonKey(&json, "samples");
    jsonArray(&json);
    for (size_t i = 0; i < story->sampleCount; i++) {
        jsonInlineObject(&json);
        jsonKeyNumber(&json, "x", story->samples[i].x);
        jsonKeyNumber(&json, "y", story->samples[i].y);
        keyColor(&json, "linear", story->samples[i].color);
        jsonKeyBool(&json, "told", i == story->told);
        jsonEndObject(&json);
    }
    jsonEndArray(&json);
    jsonKey(&json, "rays");
    jsonArray(&json);
    int next = 1;
    writeRay(&json, scene, story->ray, 0, &next);
    jsonEndArray(&json);
    jsonEndObject(&json);
    jsonEnd(&json);
}
