/* scene_warnings.c - scenes that are valid and would come out black or empty; see scene_warnings.h. */
#include "scene/scene_warnings.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void warn(SceneReader *reader, Place place, const char *hint, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static void warn(SceneReader *reader, Place place, const char *hint, const char *format, ...)
{
    char message[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    if (place.line == 0)
        place = (Place){1, 1, 1};
    addDiagnostic(reader->diagnostics, reader->source, SEVERITY_WARNING, place, hint, message);
}

/* The section's key; the file's first character when it is left out. */
static Place placeOfSection(const GivenKeys *given, const char *name)
{
    const YamlNode *key = given->keys[findFormatKey(given->format, name, strlen(name))];
    return key != NULL ? key->place : (Place){1, 1, 1};
}

/* Without lights only the simple model shows anything. */
static void warnOfDarkness(SceneReader *reader, const GivenKeys *given)
{
    const Scene *scene = reader->scene;
    if (scene->render.model == MODEL_SIMPLE)
        return;
    if (scene->lightCount == 0) {
        warn(reader, placeOfSection(given, "lights"),
             "add a light, or use the model simple, which needs none",
             "there is no light: every object comes out black");
        return;
    }
    for (size_t i = 0; i < scene->lightCount; i++)
        if (!colorIsBlack(scene->lights[i].color))
            return;
    warn(reader, placeOfSection(given, "lights"), "give a light a color above 0",
         "every light is black: every object comes out black");
}

/* A ray of the camera has a part along the camera's direction, as fov is below 180 degrees; what lies
 * wholly on the other side of the plane through the camera is never met. A margin for rounding. */
static void warnOfAllBehind(SceneReader *reader)
{
    const Scene *scene = reader->scene;
    const Camera *camera = &scene->camera;
    Vector3D forward = normalize(camera->direction);
    for (size_t i = 0; i < scene->objectCount; i++) {
        Bounds b;
        if (!objectShape(&scene->objects[i])->bounds(&scene->objects[i], &b))
            return;

        /* Find the corner of the bounds that is farthest forward. */
        Vector3D corner = createVector(forward.x > 0 ? b.max.x : b.min.x, forward.y > 0 ? b.max.y : b.min.y,
                                       forward.z > 0 ? b.max.z : b.min.z);
        double margin = 1e-9 * (largestCoordinate(corner) + largestCoordinate(camera->position));
        if (!(dot(subVectors(corner, camera->position), forward) < -margin))
            return;
    }
    warn(reader, reader->viewPlace, "turn the camera round, or move it back",
         "the camera looks away: every object is behind it");
}

/* Whether the object contains the point and all round it, by a millionth of the sizes in question. */
static bool containsClearly(const Object *object, Vector3D point)
{
    const Shape *shape = objectShape(object);
    double step = 1e-6 * (shape->magnitude(object) + largestCoordinate(point));
    for (int i = 0; i < 6; i++) {
        double s = i < 3 ? step : -step;
        Vector3D moved =
            addVectors(point, createVector(i % 3 == 0 ? s : 0, i % 3 == 1 ? s : 0, i % 3 == 2 ? s : 0));
        if (!shape->contains(object, moved))
            return false;
    }
    return shape->contains(object, point);
}

/* Whether the point is outside, and stays so when it is moved a little towards a point that is inside. */
static bool isClearlyOutside(const Object *object, Vector3D point, Vector3D inside)
{
    const Shape *shape = objectShape(object);
    double step = 1e-6 * (shape->magnitude(object) + largestCoordinate(point));
    Vector3D moved = addVectors(point, multVector(normalize(subVectors(inside, point)), step));
    return !shape->contains(object, point) && !shape->contains(object, moved);
}

/* "inside the cube", "behind the plane". */
typedef struct Where {
    char text[40];
} Where;

static Where whereInside(const Object *object)
{
    Where where;
    snprintf(where.text, sizeof where.text, "%s the %s", object->kind == SHAPE_PLANE ? "behind" : "inside",
             objectShape(object)->name);
    return where;
}

enum {
    /* Pairs of an object and a light that are looked at; a scene with more gets no such warnings, so that
     * loading stays linear. */
    MOST_PAIRS = 2000000
};

/* All that a camera inside an object sees is inside it too, its inner side included. With shadows on, light
 * from outside does not get in. A room with the light inside is fine. */
static void warnOfCameraInside(SceneReader *reader)
{
    const Scene *scene = reader->scene;
    for (size_t i = 0; i < scene->objectCount; i++) {
        const Object *object = &scene->objects[i];
        if (!objectShape(object)->contains(object, scene->camera.position) ||
            !containsClearly(object, scene->camera.position))
            continue;
        size_t outside = 0;
        while (outside < scene->lightCount &&
               isClearlyOutside(object, scene->lights[outside].position, scene->camera.position))
            outside++;
        if (outside == scene->lightCount) {
            warn(reader, reader->positionPlace, "move the camera out, or put a light inside",
                 "the camera is %s of line %d and every light is outside: all surfaces it sees are black",
                 whereInside(object).text, object->line);
            return;
        }
    }
}

/* A light inside an object does not get out when shadows are on, and a camera outside sees nothing of what
 * it lights. */
static void warnOfLightsInside(SceneReader *reader)
{
    const Scene *scene = reader->scene;
    for (size_t i = 0; i < scene->lightCount; i++)
        for (size_t j = 0; j < scene->objectCount; j++) {
            const Object *object = &scene->objects[j];
            Vector3D position = scene->lights[i].position;
            if (!objectShape(object)->contains(object, position) || !containsClearly(object, position) ||
                !isClearlyOutside(object, scene->camera.position, position))
                continue;
            warn(reader, reader->lightPlaces[i], "move the light out of it",
                 "this light is %s of line %d and lights nothing that the camera sees",
                 whereInside(object).text, object->line);
            break;
        }
}

void addSceneWarnings(SceneReader *reader, const GivenKeys *given)
{
    const Scene *scene = reader->scene;
    if (scene->objectCount == 0) {
        warn(reader, placeOfSection(given, "objects"), "add an object to the section 'objects'",
             "there is no object: the picture shows only the background");
        return;
    }
    warnOfDarkness(reader, given);
    warnOfAllBehind(reader);

    /* What is inside what matters only where shadows are cast, by the engine's own rule. */
    bool shadows = scene->render.shadows && isnan(scene->render.shadowBias) && scene->lightCount > 0;
    if (shadows && scene->lightCount <= MOST_PAIRS / scene->objectCount) {
        warnOfCameraInside(reader);
        warnOfLightsInside(reader);
    }
}
