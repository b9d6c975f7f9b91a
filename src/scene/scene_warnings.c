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

/* Whether the material shows nothing where no light arrives: it has no light of its own, and lets nothing of
 * what is elsewhere be seen. The simple model needs a light only where shadows are on and there is one. */
static bool isDarkWithoutLight(const Scene *scene, const Material *material)
{
    if (materialModel(scene, material) == MODEL_SIMPLE)
        return scene->render.shadows && scene->lightCount > 0;
    return colorIsBlack(multColors(material->ambient, scene->render.ambient)) &&
           colorIsBlack(material->emission) && colorIsBlack(material->reflection) &&
           colorIsBlack(material->transmission);
}

/* Whether this holds of every surface; of a solid, of all its parts. */
static bool areDarkWithoutLight(const Scene *scene, const Object *objects, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const Object *object = &objects[i];
        if (object->kind == SHAPE_CSG ? !areDarkWithoutLight(scene, object->csg.parts, object->csg.partCount)
                                      : !isDarkWithoutLight(scene, &object->material))
            return false;
    }
    return true;
}

static bool usesSimpleModel(const Scene *scene, const Object *object)
{
    if (object->kind != SHAPE_CSG)
        return materialModel(scene, &object->material) == MODEL_SIMPLE;
    for (size_t i = 0; i < object->csg.partCount; i++)
        if (usesSimpleModel(scene, &object->csg.parts[i]))
            return true;
    return false;
}

/* Without light everything is black, where nothing shines by itself and no fog lies before it. */
static void warnOfDarkness(SceneReader *reader, const GivenKeys *given)
{
    const Scene *scene = reader->scene;
    for (size_t i = 0; i < scene->lightCount; i++)
        if (!colorIsBlack(scene->lights[i].color))
            return;
    /* The simple model takes no light's color into account. */
    for (size_t i = 0; i < scene->objectCount && scene->lightCount > 0; i++)
        if (usesSimpleModel(scene, &scene->objects[i]))
            return;
    if (!areDarkWithoutLight(scene, scene->objects, scene->objectCount))
        return;
    if (scene->lightCount == 0)
        warn(reader, placeOfSection(given, "lights"),
             "add a light, or use the model simple, which needs none",
             "there is no light: every object comes out black");
    else
        warn(reader, placeOfSection(given, "lights"), "give a light a color above 0",
             "every light is black: every object comes out black");
}

/* The size of the numbers that an object's place in the world is computed from. */
static double worldSize(const Object *object)
{
    double own = objectShape(object)->magnitude(object);
    if (object->transform == NULL)
        return own;
    const Matrix *matrix = &object->transform->worldFromObject;
    return matrixNorm(matrix) * own + largestCoordinate(matrix->translate);
}

/* A ray of the camera has a part along the camera's direction, as fov is below 180 degrees or all rays are
 * parallel to it; what lies wholly on the other side of the plane through the camera is never met. A margin
 * for rounding. */
static void warnOfAllBehind(SceneReader *reader)
{
    const Scene *scene = reader->scene;
    const Camera *camera = &scene->camera;
    Vector3D forward = normalize(camera->direction);
    for (size_t i = 0; i < scene->objectCount; i++) {
        const Object *object = &scene->objects[i];
        Bounds b;
        if (!objectBounds(object, &b) || !(b.min.x <= b.max.x && b.min.y <= b.max.y && b.min.z <= b.max.z))
            return;

        /* Find the corner of the bounds that is farthest forward. */
        Vector3D corner = createVector(forward.x > 0 ? b.max.x : b.min.x, forward.y > 0 ? b.max.y : b.min.y,
                                       forward.z > 0 ? b.max.z : b.min.z);
        double size = largestCoordinate(corner) + largestCoordinate(camera->position) + worldSize(object);
        if (!(dot(subVectors(corner, camera->position), forward) < -1e-9 * size))
            return;
    }
    warn(reader, reader->viewPlace, "turn the camera round, or move it back",
         "the camera looks away: every object is behind it");
}

/* How far in its own space a point is moved to see whether it is clearly inside or outside: by a millionth
 * of the sizes in question. */
static double clearStep(const Object *object, Vector3D worldPoint, Vector3D point)
{
    double size = objectShape(object)->magnitude(object) + largestCoordinate(point);
    if (object->transform != NULL) {
        const Matrix *inverse = &object->transform->objectFromWorld;
        size += matrixNorm(inverse) * largestCoordinate(worldPoint) + largestCoordinate(inverse->translate);
    }
    return 1e-6 * size;
}

/* Whether the object contains the point and all round it. */
static bool containsClearly(const Object *object, Vector3D worldPoint)
{
    const Shape *shape = objectShape(object);
    Vector3D point = objectSpacePoint(object, worldPoint);
    if (!shape->contains(object, point))
        return false;
    double step = clearStep(object, worldPoint, point);
    for (int i = 0; i < 6; i++) {
        double s = i < 3 ? step : -step;
        Vector3D moved =
            addVectors(point, createVector(i % 3 == 0 ? s : 0, i % 3 == 1 ? s : 0, i % 3 == 2 ? s : 0));
        if (!shape->contains(object, moved))
            return false;
    }
    return true;
}

/* Whether the point is outside, and stays so when it is moved a little towards a point that is inside. */
static bool isClearlyOutside(const Object *object, Vector3D worldPoint, Vector3D worldInside)
{
    const Shape *shape = objectShape(object);
    Vector3D point = objectSpacePoint(object, worldPoint), inside = objectSpacePoint(object, worldInside);
    double step = clearStep(object, worldPoint, point);
    Vector3D moved = addVectors(point, multVector(normalize(subVectors(inside, point)), step));
    return !shape->contains(object, point) && !shape->contains(object, moved);
}

/* Whether no light goes through the object: it is opaque and casts a shadow, and so do all parts of a solid.
 */
static bool blocksLight(const Object *object)
{
    if (object->noShadow)
        return false;
    if (object->kind != SHAPE_CSG)
        return colorIsBlack(object->material.transmission);
    for (size_t i = 0; i < object->csg.partCount; i++)
        if (!blocksLight(&object->csg.parts[i]))
            return false;
    return true;
}

/* Whether all of the light's rays come from its position. */
static bool shinesFromPosition(const Light *light)
{
    return light->kind == LIGHT_POINT || light->kind == LIGHT_SPOT;
}

/* "inside the cube", "behind the plane". */
typedef struct Where {
    char text[40];
} Where;

static Where whereInside(const Object *object)
{
    Where where;
    bool isCylinder = object->kind == SHAPE_CONE && object->cone.baseRadius == object->cone.topRadius;
    snprintf(where.text, sizeof where.text, "%s the %s", object->kind == SHAPE_PLANE ? "behind" : "inside",
             isCylinder                  ? "cylinder"
             : object->kind == SHAPE_CSG ? "solid"
                                         : objectShape(object)->name);
    return where;
}

enum {
    /* Pairs of an object and a light that are looked at; a scene with more gets no such warnings, so that
     * loading stays linear. */
    MOST_PAIRS = 2000000
};

/* All that a camera inside an object sees is inside it too, its inner side included. With shadows on, light
 * from outside does not get in. A room with the light inside is fine, and so is anything that shines by
 * itself. */
static void warnOfCameraInside(SceneReader *reader)
{
    const Scene *scene = reader->scene;
    for (size_t i = 0; i < scene->lightCount; i++)
        if (!shinesFromPosition(&scene->lights[i]))
            return;
    if (!areDarkWithoutLight(scene, scene->objects, scene->objectCount))
        return;
    for (size_t i = 0; i < scene->objectCount; i++) {
        const Object *object = &scene->objects[i];
        if (!blocksLight(object) || !containsClearly(object, scene->camera.position))
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
        for (size_t j = 0; j < scene->objectCount && shinesFromPosition(&scene->lights[i]); j++) {
            const Object *object = &scene->objects[j];
            Vector3D position = scene->lights[i].position;
            if (!blocksLight(object) || !containsClearly(object, position) ||
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
             "there is no object: the picture shows only the %s",
             scene->fog.distance > 0 ? "fog" : "background");
        return;
    }
    bool hasFog = scene->fog.distance > 0 && !colorIsBlack(scene->fog.color);
    if (!hasFog)
        warnOfDarkness(reader, given);
    warnOfAllBehind(reader);

    /* What is inside what matters only where shadows are cast, by the engine's own rule, and where all rays
     * start from one point. In fog nothing is black. */
    bool shadows = scene->render.shadows && isnan(scene->render.shadowBias) && scene->lightCount > 0;
    if (shadows && !hasFog && scene->camera.projection == PROJECTION_PERSPECTIVE &&
        scene->lightCount <= MOST_PAIRS / scene->objectCount) {
        warnOfCameraInside(reader);
        warnOfLightsInside(reader);
    }
}
