/* export.c - from a Scene to a POV-Ray scene; see export.h and MAPPING.md.
 *
 * Everything is stated explicitly, since POV-Ray's defaults (left-handed camera, ambient light, diffuse
 * 0.6, no falloff) are not ours. Numbers are written so that they read back as the same double. Of the
 * scene file nothing reaches the text but numbers and the quoted names of picture files, so nothing in it
 * can be read as POV-Ray code.
 */
#include "povray/export.h"

#include "povray/pov_faces.h"
#include "povray/pov_habits.h"
#include "povray/pov_scale.h"
#include "povray/pov_texture.h"

#include <float.h>
#include <string.h>

/* The whole of an export. */
typedef struct Export {
    const Scene *scene;
    Text *pov;
    double scale; /* of all lengths */
    PovFinish finish;
    unsigned habits; /* PovHabits that apply to the scene */
} Export;

static bool has(const Export *export, PovHabit habit)
{
    return (export->habits & habit) != 0;
}

/* The length in bytes of the character at the start of name if a line of a comment can show it, else 0: no
 * control character, and none of U+2000..U+207F, which end lines or turn the direction of writing. */
static size_t shownLength(const char *name)
{
    size_t length = utf8Length(name);
    unsigned char first = (unsigned char)name[0], second = (unsigned char)(length > 1 ? name[1] : 0);
    if (first < ' ' || first == 0x7F || (first == 0xC2 && second < 0xA0) ||
        (first == 0xE2 && (second == 0x80 || second == 0x81)))
        return 0;
    return length;
}

/* Append a file name as one word of the shell, with _ for each byte that cannot be shown. */
static void appendQuoted(Text *pov, const char *name, size_t length)
{
    textAppend(pov, "'");
    for (size_t i = 0; i < length;) {
        size_t shown = shownLength(name + i);
        if (name[i] == '\'')
            textAppend(pov, "'\\''");
        else if (shown > 0)
            textAppendBytes(pov, name + i, shown);
        else
            textAppend(pov, "_");
        i += shown > 0 ? shown : 1;
    }
    textAppend(pov, "'");
}

/* The command that renders the file. POV-Ray 3.7 opens no file whose name has spaces, quotes or letters
 * outside ASCII, so the shell opens those. */
static void writeCommand(const Scene *scene, const char *name, Text *pov)
{
    const char *slash = strrchr(name, '/');
    const char *base = slash != NULL ? slash + 1 : name;
    if (*base == '\0')
        base = "scene.pov";
    size_t length = strlen(base);
    int stem = (int)(length > 4 && strcmp(base + length - 4, ".pov") == 0 ? length - 4 : length);
    bool plain = base[0] != '-' && strspn(base, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                "0123456789_-.") == length;
    if (plain)
        textAppendFormat(pov, "// povray +I%s +O%.*s.png", base, stem, base);
    else
        textAppend(pov, "// povray +I/dev/stdin +O-");
    textAppendFormat(pov, " +W%d +H%d +FN%d File_Gamma=%s -A -D", scene->image.width, scene->image.height,
                     scene->image.bitDepth, scene->image.encoding == ENCODING_LINEAR ? "1.0" : "srgb");
    if (!plain) {
        textAppend(pov, " <");
        appendQuoted(pov, base, length);
        textAppend(pov, " >");
        appendQuoted(pov, base, (size_t)stem);
        textAppend(pov, ".png");
    }
    textAppend(pov, "\n");
}

/* What the file draws. */
static void writePurpose(const Export *export)
{
    if (export->habits == 0) {
        textAppend(export->pov, "// Written by eclairage: the same picture, to the last bits of 16.\n");
        return;
    }
    textAppend(export->pov, "// Written by eclairage: another picture, as POV-Ray is written by habit:\n//");
    for (int i = 0; i < POV_HABIT_COUNT; i++)
        if (has(export, (PovHabit)(1 << i)))
            textAppendFormat(export->pov, " %s", povHabitName((PovHabit)(1 << i)));
    textAppend(export->pov, "\n");
}

static void writeHeader(const Export *export, const char *name)
{
    const Scene *scene = export->scene;
    Text *pov = export->pov;
    writeCommand(scene, name, pov);
    writePurpose(export);
    if (export->scale != 1) {
        textAppend(pov, "// All lengths are multiplied by ");
        textAppendPovNumber(pov, export->scale);
        textAppend(pov, ", since POV-Ray ignores what is nearer than 0.001 to a surface.\n");
    }
    if (scene->render.samples > 1 && has(export, POV_HABIT_GAMMA))
        textAppend(pov, "// It is drawn with one ray a pixel: a mean of several cannot be said here.\n");
    else if (scene->render.samples > 1)
        textAppendFormat(
            pov,
            "// The mean of %d x %d rays a pixel cannot be said here; `eclairage compare` works it out\n"
            "// of this picture, C, and of one with +A0.0 +AM1 +R%d -J, A: (%d A - C) / %d.\n",
            scene->render.samples, scene->render.samples, scene->render.samples,
            scene->render.samples * scene->render.samples + 1, scene->render.samples * scene->render.samples);
    textAppend(pov, "#version 3.7;\nglobal_settings { assumed_gamma ");
    textAppendPovNumber(pov, has(export, POV_HABIT_GAMMA) ? POV_HABIT_ASSUMED_GAMMA : 1);
    textAppendFormat(pov, " max_trace_level %d adc_bailout 0 ambient_light rgb %d }\n",
                     scene->render.maxDepth, has(export, POV_HABIT_AMBIENT));
    textAppend(pov, "#default { finish { ambient 0 emission 0 diffuse 1 brilliance 1 phong 0 specular 0 "
                    "reflection 0 } }\n\n");
}

/* A point at which a ray from there points. The farther the point, the less its rounding turns the ray. */
static Vector3D pointAlong(Vector3D start, Vector3D direction)
{
    return addVectors(start, multVector(direction, fmax(1, norm(start))));
}

/* A camera by its angle and look_at, as it is written by hand. POV-Ray's angle is the horizontal one. */
static void writeUsualCamera(const Export *export, const CameraFrame *frame)
{
    const double pi = 3.14159265358979323846;
    const Scene *scene = export->scene;
    const ImageSettings *image = &scene->image;
    Text *pov = export->pov;
    double angle = scene->camera.fov;
    if (!has(export, POV_HABIT_ANGLE))
        angle = atan(tan(angle * pi / 360) * image->width / image->height) * 360 / pi;
    textAppend(pov, "camera {\n  location ");
    textAppendPovVector(pov, frame->position, export->scale);
    textAppendFormat(pov, "\n  right %sx*%d/%d\n  up y\n  angle ",
                     has(export, POV_HABIT_LEFT_HANDED) ? "" : "-", image->width, image->height);
    textAppendPovNumber(pov, angle);
    textAppend(pov, "\n  sky ");
    textAppendPovVector(pov, normalize(scene->camera.up), 1);
    textAppend(pov, "\n  look_at ");
    textAppendPovVector(pov, pointAlong(frame->position, frame->forward), export->scale);
    textAppend(pov, "\n}\n\n");
}

/* Direction, right and up span exactly our picture plane; right-handed, and no angle. */
static void writeCamera(const Export *export)
{
    const Scene *scene = export->scene;
    Text *pov = export->pov;
    CameraFrame frame = cameraFrame(&scene->camera, scene->image.width, scene->image.height);
    bool orthographic = frame.projection == PROJECTION_ORTHOGRAPHIC;
    if (!orthographic && (export->habits & (POV_HABIT_LEFT_HANDED | POV_HABIT_ANGLE)) != 0) {
        writeUsualCamera(export, &frame);
        return;
    }
    if (has(export, POV_HABIT_LEFT_HANDED))
        frame.right = multVector(frame.right, -1);
    double planeScale = orthographic ? export->scale : 1;
    textAppend(pov, orthographic ? "camera {\n  orthographic\n  location "
                                 : "camera {\n  perspective\n  location ");
    textAppendPovVector(pov, frame.position, export->scale);
    textAppend(pov, "\n  direction ");
    textAppendPovVector(pov, frame.forward, 1);
    textAppend(pov, "\n  right ");
    textAppendPovVector(pov, frame.right, planeScale);
    textAppend(pov, "\n  up ");
    textAppendPovVector(pov, frame.up, planeScale);
    textAppend(pov, "\n}\n\n");
}

static void writeBackground(const Export *export)
{
    const Background *background = &export->scene->background;
    const Fog *fog = &export->scene->fog;
    Text *pov = export->pov;
    if (background->isGradient) {
        textAppend(pov, "sky_sphere { pigment { gradient y color_map { [0 ");
        textAppendPovColor(pov, background->bottom, 1);
        textAppend(pov, "] [1 ");
        textAppendPovColor(pov, background->top, 1);
        textAppend(pov, "] } scale 2 translate -1 } }\n\n");
    } else {
        textAppend(pov, "background { ");
        textAppendPovColor(pov, background->bottom, 1);
        textAppend(pov, " }\n\n");
    }
    if (fog->distance > 0) {
        textAppend(pov, "fog { fog_type 1 distance ");
        textAppendPovNumber(pov, fog->distance * export->scale);
        textAppend(pov, " ");
        textAppendPovColor(pov, fog->color, 1);
        textAppend(pov, " }\n\n");
    }
}

/* ---- Lights ---- */

/* Beyond it POV-Ray counts no hit. */
static const double FARTHEST_SEEN = 1e7;

/* Far beyond every hit that POV-Ray counts, so that all of the scene is before a directional light. */
static const double DIRECTIONAL_DISTANCE = 0x1p26;

static void writeSpot(const Export *export, const Light *light)
{
    textAppend(export->pov, "\n  spotlight point_at ");
    textAppendPovVector(export->pov, pointAlong(light->position, light->direction), export->scale);
    textAppend(export->pov, " radius ");
    textAppendPovNumber(export->pov, light->innerAngle);
    textAppend(export->pov, " falloff ");
    textAppendPovNumber(export->pov, light->outerAngle);
    textAppend(export->pov, " tightness ");
    textAppendPovNumber(export->pov, light->tightness);
}

/* Whether the light is written as one area_light. */
static bool isAreaLight(const Export *export, const Light *light)
{
    return has(export, POV_HABIT_AREA_LIGHT) && lightSampleCount(light) > 1;
}

/* One of the point lights that a light stands for; or all of them, as an area_light. */
static void writeLightSample(const Export *export, const Light *light, int sample)
{
    Text *pov = export->pov;
    bool directional = light->kind == LIGHT_DIRECTIONAL, isArea = isAreaLight(export, light);
    textAppend(pov, "light_source {\n  ");
    if (directional)
        textAppendPovVector(pov, light->direction, -DIRECTIONAL_DISTANCE);
    else if (isArea)
        textAppendPovVector(pov, light->position, export->scale);
    else
        textAppendPovVector(pov, lightSamplePosition(light, sample), export->scale);
    textAppend(pov, "\n  ");

    /* Only whether it arrives matters. */
    if (export->finish == FINISH_LIT) {
        textAppend(pov, directional ? "rgb 1\n  parallel point_at 0\n}\n\n" : "rgb 1\n}\n\n");
        return;
    }
    Color3f color = light->color;
    if (light->kind == LIGHT_AREA && !isArea)
        color = scaleColor(color, 1.0 / lightSampleCount(light));
    bool falls = !directional && light->falloff == FALLOFF_INVERSE_SQUARE;
    bool fallsByHabit = falls && has(export, POV_HABIT_FALLOFF);
    textAppendPovColor(pov, color, falls && !fallsByHabit ? export->scale * export->scale : 1);
    if (fallsByHabit) {
        textAppend(pov, "\n  fade_distance ");
        textAppendPovNumber(pov, export->scale);
        textAppend(pov, " fade_power 2");
    } else if (falls) {
        textAppend(pov, "*K\n  fade_distance D fade_power 2");
    }
    if (isArea) {
        textAppend(pov, "\n  area_light ");
        textAppendPovVector(pov, light->edgeU, export->scale);
        textAppend(pov, ", ");
        textAppendPovVector(pov, light->edgeV, export->scale);
        textAppendFormat(pov, ", %d, %d", light->countU, light->countV);
    }
    if (light->kind == LIGHT_SPOT)
        writeSpot(export, light);
    textAppend(pov, directional ? "\n  parallel point_at 0\n}\n\n" : "\n}\n\n");
}

/* POV-Ray 3.7 fades by 2 / (1 + (d/D)^2). With D = 2^-20 and the colour times K = 1/(2 D^2), which is a
 * power of two and exact, that is 1 / (D^2 + d^2): within 1e-12 of 1/d^2. */
static Status writeLights(const Export *export)
{
    const Scene *scene = export->scene;
    bool isFaded = export->finish == FINISH_REFLECTION && !has(export, POV_HABIT_FALLOFF);
    if (isFaded && scene->lightCount > 0)
        textAppend(export->pov, "#declare D = 1/1048576; // with fade_distance D and the color times K,\n"
                                "#declare K = 1/(2*D*D); // the light falls off by 1/d^2\n\n");
    for (size_t i = 0; i < scene->lightCount && export->finish != FINISH_UNLIT; i++) {
        const Light *light = &scene->lights[i];
        double brightest = fmax((double)light->color.r, fmax((double)light->color.g, (double)light->color.b));
        if (light->falloff == FALLOFF_INVERSE_SQUARE && isFaded &&
            brightest * export->scale * export->scale * 0x1p39 > (double)FLT_MAX)
            return statusError(
                STATUS_INEXPRESSIBLE,
                "light %zu is too bright for POV-Ray, which keeps colours in single precision; "
                "a colour below 1e26 can be exported",
                i + 1);
        int samples = isAreaLight(export, light) ? 1 : lightSampleCount(light);
        for (int sample = 0; sample < samples; sample++)
            writeLightSample(export, light, sample);
    }
    return statusOk();
}

/* ---- Objects ---- */

enum {
    MOST_COMPARED = 4096 /* of objects, each with every other */
};

/* Whether rays begin inside the object, as far as POV-Ray knows. */
static bool containsCamera(const Export *export, const Object *object)
{
    const Camera *camera = &export->scene->camera;
    return camera->projection == PROJECTION_PERSPECTIVE && objectContains(object, camera->position);
}

/* Whether surfaces within the union can be seen or be passed: if it is a part of a solid, transparent, or
 * rays begin in it. If not they may stay, and then a ray along the plane in which two parts touch finds them.
 */
static bool showsItsInside(const Export *export, const Object *object, const PovPart *place)
{
    return place != NULL || transmissivePart(export->scene, object) != NULL ||
           export->scene->camera.projection != PROJECTION_PERSPECTIVE || containsCamera(export, object);
}

/* The shape up to its material. A mesh has an inside in POV-Ray only at the cost of exactness, so only where
 * that matters: as a part of CSG, and as glass round the camera. */
static void writeShape(const Export *export, const Object *object, const PovPart *place)
{
    const Scene *scene = export->scene;
    bool needsInside = place != NULL || (transmissivePart(scene, object) != NULL &&
                                         objectContains(object, scene->camera.position));
    if (object->kind == SHAPE_MESH)
        writeMeshPov(object, export->scale, needsInside, export->pov);
    else if (object->kind == SHAPE_CSG && object->csg.operation == CSG_UNION &&
             !showsItsInside(export, object, place))
        textAppend(export->pov, "union {");
    else if (place == NULL || object->kind == SHAPE_CSG)
        objectShape(object)->writePov(object, export->scale, export->pov);
    else {
        Object separated = separatedPart(object, place);
        objectShape(&separated)->writePov(&separated, export->scale, export->pov);
    }
}

/* How far from the origin of its own space the object's points can be. An endless one is drawn as far as
 * POV-Ray sees. */
static double ownExtent(const Export *export, const Object *object)
{
    Bounds bounds;
    if (objectShape(object)->bounds(object, &bounds))
        return fmax(largestCoordinate(bounds.min), largestCoordinate(bounds.max));
    double extent = FARTHEST_SEEN / export->scale + largestCoordinate(export->scene->camera.position);
    if (object->transform != NULL)
        extent = matrixNorm(&object->transform->objectFromWorld) * extent +
                 largestCoordinate(object->transform->objectFromWorld.translate);
    return extent;
}

/* An object up to its closing brace; place: where it is a part of CSG, or NULL. */
static void writeObject(const Export *export, const Object *object, const PovPart *place)
{
    Text *pov = export->pov;
    writeShape(export, object, place);
    textAppend(pov, "\n  ");
    if (object->kind == SHAPE_CSG) {
        for (size_t i = 0; i < object->csg.partCount; i++) {
            PovPart part = {object, i, place};
            writeObject(export, &object->csg.parts[i], &part);
            textAppend(pov, "\n}\n");
        }
        return;
    }
    textAppendPovTexture(pov, export->scene, &object->material, export->finish, export->habits, export->scale,
                         ownExtent(export, object));
    if (object->transform != NULL) {
        textAppend(pov, "\n  ");
        textAppendPovMatrix(pov, &object->transform->worldFromObject, export->scale);
    }
}

static bool isBoxIn(Bounds inner, Bounds outer)
{
    return inner.min.x >= outer.min.x && inner.min.y >= outer.min.y && inner.min.z >= outer.min.z &&
           inner.max.x <= outer.max.x && inner.max.y <= outer.max.y && inner.max.z <= outer.max.z;
}

/* Whether the transparent object may be in, or round, another one of the same index. Of more objects than can
 * be looked at, it may. */
static bool nestsInLikeGlass(const Export *export, const Object *object, double ior)
{
    const Scene *scene = export->scene;
    Bounds own, bounds;
    if (scene->objectCount > MOST_COMPARED || !objectBounds(object, &own))
        return true;
    for (size_t i = 0; i < scene->objectCount; i++) {
        const Object *other = &scene->objects[i];
        const Material *glass = other != object ? transmissivePart(scene, other) : NULL;
        if (glass != NULL && (double)glass->ior == ior &&
            (!objectBounds(other, &bounds) || isBoxIn(own, bounds) || isBoxIn(bounds, own)))
            return true;
    }
    return false;
}

/* The interior of a transparent object. Where the index does not change, POV-Ray does not count the ray that
 * goes on, so that max_trace_level would cut the chain later than max_depth. A difference in the last bit of
 * its float makes it count, and bends by nothing that can be seen. */
static void writeInterior(const Export *export, size_t number)
{
    const Object *object = &export->scene->objects[number];
    const Material *glass = transmissivePart(export->scene, object);
    if (glass == NULL)
        return;
    double ior = (double)glass->ior;
    if (nestsInLikeGlass(export, object, ior))
        ior *= 1 + FLT_EPSILON * (double)(1 + number % 8);
    else if (ior == 1)
        ior += FLT_EPSILON;
    textAppend(export->pov, "\n  interior { ior ");
    textAppendPovNumber(export->pov, ior);
    textAppend(export->pov, " }");
}

static void writeObjects(const Export *export)
{
    bool isCameraInGlass = false;
    for (size_t i = 0; i < export->scene->objectCount && !isCameraInGlass; i++) {
        const Object *object = &export->scene->objects[i];
        isCameraInGlass = transmissivePart(export->scene, object) != NULL && containsCamera(export, object);
    }
    for (size_t i = 0; i < export->scene->objectCount; i++) {
        const Object *object = &export->scene->objects[i];
        writeObject(export, object, NULL);
        writeInterior(export, i);
        /* POV-Ray also counts what is opaque among the media that rays begin in, and the last one, in an
         * order of its own, decides how they leave the glass. Of an inverse room the outside is its inside.
         */
        if (isCameraInGlass && object->kind != SHAPE_MESH &&
            transmissivePart(export->scene, object) == NULL && containsCamera(export, object))
            textAppend(export->pov, "\n  inverse");
        bool castsShadow = export->scene->render.shadows && !object->noShadow;
        textAppend(export->pov, castsShadow ? "" : "\n  no_shadow");
        /* To POV-Ray there is no fog in what is not hollow, be it glass or the room round the camera. */
        textAppend(export->pov, export->scene->fog.distance > 0 ? "\n  hollow\n}\n\n" : "\n}\n\n");
    }
}

/* ---- What can be said ---- */

/* Count the surfaces by whether their model is the simple one. */
static void countModels(const Scene *scene, const Object *object, size_t *simple, size_t *other)
{
    if (object->kind == SHAPE_CSG) {
        for (size_t i = 0; i < object->csg.partCount; i++)
            countModels(scene, &object->csg.parts[i], simple, other);
    } else if (materialModel(scene, &object->material) == MODEL_SIMPLE) {
        ++*simple;
    } else {
        ++*other;
    }
}

/* A picture on the object that POV-Ray would make transparent, or NULL. */
static const Pattern *transparentPicture(const Object *object)
{
    const Pattern *pattern = object->kind != SHAPE_CSG ? object->material.pattern : NULL;
    if (pattern != NULL && pattern->kind == PATTERN_IMAGE && pattern->hasAlpha)
        return pattern;
    for (size_t i = 0; object->kind == SHAPE_CSG && i < object->csg.partCount; i++)
        if ((pattern = transparentPicture(&object->csg.parts[i])) != NULL)
            return pattern;
    return NULL;
}

/* Decide how the materials are written, or refuse. */
static Status chooseFinish(const Scene *scene, PovFinish *finish)
{
    if (!isnan(scene->render.shadowBias))
        return statusError(
            STATUS_INEXPRESSIBLE,
            "render.shadow_bias cannot be exported: POV-Ray's own bias is fixed; remove the key "
            "to compare with POV-Ray");
    size_t simple = 0, other = 0;
    for (size_t i = 0; i < scene->objectCount; i++)
        countModels(scene, &scene->objects[i], &simple, &other);
    for (size_t i = 0; i < scene->objectCount; i++) {
        const Pattern *picture = transparentPicture(&scene->objects[i]);
        if (picture != NULL)
            return statusErrorAt(STATUS_INEXPRESSIBLE, scene->objects[i].line, 0,
                                 "the picture %s has transparency, which is ignored here but not by POV-Ray; "
                                 "save it without an alpha channel to compare",
                                 picture->path);
    }
    if (simple > 0 && other > 0)
        return statusError(
            STATUS_INEXPRESSIBLE,
            "the simple model beside other models in one scene cannot be exported: its light is "
            "not POV-Ray's; use one or the other");
    *finish = FINISH_REFLECTION;
    if (simple == 0)
        return statusOk();

    int lights = 0;
    for (size_t i = 0; i < scene->lightCount; i++)
        lights += lightSampleCount(&scene->lights[i]);
    bool lightsMatter = scene->render.shadows && lights > 0;
    if (lightsMatter && lights > 1)
        return statusError(STATUS_INEXPRESSIBLE,
                           "the simple model with several lights (here %d) cannot be exported: POV-Ray adds "
                           "lights up, and the simple model does not; use one light, or shadows: false",
                           lights);
    *finish = lightsMatter ? FINISH_LIT : FINISH_UNLIT;
    return statusOk();
}

Status exportPov(const Scene *scene, const char *name, Text *pov)
{
    return exportPovWithHabits(scene, name, 0, pov);
}

Status exportPovWithHabits(const Scene *scene, const char *name, unsigned habits, Text *pov)
{
    Export export = {.scene = scene, .pov = pov, .scale = povScale(scene)};
    export.habits = habits & applicablePovHabits(scene);
    Status status = chooseFinish(scene, &export.finish);
    if (!statusIsOk(&status))
        return status;
    writeHeader(&export, name);
    writeBackground(&export);
    writeCamera(&export);
    status = writeLights(&export);
    if (!statusIsOk(&status))
        return status;
    writeObjects(&export);
    return pov->failed ? statusOutOfMemory() : statusOk();
}
