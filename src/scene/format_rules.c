/* format_rules.c - what the table cannot say; see format_rules.h. */
#include "scene/format_rules.h"

#include "scene/reader.h"

#include <string.h>

void finishImage(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    const ImageSettings *image = values;
    const int64_t mostPixels = INT64_C(1) << 31;
    if (!isUsable(given, "width") || !isUsable(given, "height"))
        return;
    int64_t pixels = (int64_t)image->width * image->height;
    if (pixels > mostPixels)
        reportError(reader, placeOfKey(given, isGiven(given, "height") ? "height" : "width"), NULL,
                    "the picture has %lld pixels, %d times %d; it may have at most 2147483648",
                    (long long)pixels, image->width, image->height);
}

/* ---- The camera ---- */

static bool isFiniteVector(Vector3D v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

/* The sine of an angle from which on two directions count as parallel: far above rounding, far below what
 * can be meant. */
static const double PARALLEL_SINE = 1e-9;

/* An orthographic camera needs a view_height, another one cannot have it. */
static void checkViewHeight(SceneReader *reader, const GivenKeys *given, bool isOrthographic)
{
    if (!isUsable(given, "projection") || !isUsable(given, "view_height"))
        return;
    if (isOrthographic && !isGiven(given, "view_height"))
        reportError(reader, placeOfKey(given, "projection"),
                    "add view_height: the height of the picture in scene units",
                    "an orthographic camera needs a 'view_height'");
    if (!isOrthographic && isGiven(given, "view_height"))
        reportError(
            reader, placeOfKey(given, "view_height"),
            "add projection: orthographic, or leave view_height out",
            "'view_height' is for an orthographic camera only; of a perspective one 'fov' says what is "
            "seen");
}

void finishCamera(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    const CameraValues *camera = values;
    Camera *built = target;
    bool isOrthographic = camera->projection == PROJECTION_ORTHOGRAPHIC;
    checkViewHeight(reader, given, isOrthographic);
    bool looksAt = isGiven(given, "look_at");
    Vector3D direction = camera->direction;
    reader->positionPlace = placeOfKey(given, "position");
    reader->viewPlace = placeOfKey(given, looksAt ? "look_at" : "direction");
    if (looksAt && isUsable(given, "position")) {
        direction = subVectors(camera->lookAt, camera->position);
        if (direction.x == 0 && direction.y == 0 && direction.z == 0) {
            reportError(reader, placeOfKey(given, "look_at"), "move one of the two",
                        "'look_at' is the camera's own position, so it looks nowhere");
            return;
        }
        if (!isFiniteVector(direction)) {
            reportError(reader, placeOfKey(given, "look_at"), "use smaller numbers",
                        "'look_at' and 'position' are too far apart");
            return;
        }
    }
    bool knowsView =
        isUsable(given, "position") && isUsable(given, "look_at") && isUsable(given, "direction");
    if (knowsView && isUsable(given, "up") &&
        norm(cross(normalize(direction), normalize(camera->up))) < PARALLEL_SINE) {
        const char *culprit = isGiven(given, "up") ? "up" : looksAt ? "look_at" : "direction";
        bool alongZ = direction.x == 0 && direction.y == 0;
        reportError(reader, placeOfKey(given, culprit),
                    alongZ ? "for example up: [0, 1, 0]" : "for example up: [0, 0, -1]",
                    "the camera looks along 'up', so it cannot tell what is up in the picture");
        return;
    }
    *built = (Camera){.position = camera->position,
                      .direction = direction,
                      .up = camera->up,
                      .fov = camera->fov,
                      .projection = camera->projection,
                      .viewHeight = isOrthographic ? camera->viewHeight : 0};
}

/* The values are the scene's background. */
void finishSky(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)reader;
    (void)given;
    (void)target;
    ((Background *)values)->isGradient = true;
}

/* ---- Lights ---- */

/* Add a light of this kind with the values that were read. */
static void addLight(SceneReader *reader, GivenKeys *given, const LightValues *read, LightKind kind)
{
    Light light = read->light;
    light.kind = kind;
    addReadLight(reader, given, light);
}

void finishPoint(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    addLight(reader, given, values, LIGHT_POINT);
}

void finishDirectional(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    LightValues *read = values;
    read->light.direction = normalize(read->light.direction);
    read->light.falloff = FALLOFF_NONE;
    addLight(reader, given, read, LIGHT_DIRECTIONAL);
}

void finishSpot(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    LightValues *read = values;
    Light *light = &read->light;
    if (isGiven(given, "position") && isGiven(given, "look_at")) {
        Vector3D axis = subVectors(read->lookAt, light->position);
        if (axis.x == 0 && axis.y == 0 && axis.z == 0)
            reportError(reader, placeOfKey(given, "look_at"), "move one of the two",
                        "'look_at' is the light's own position, so it points nowhere");
        if (!isFiniteVector(axis))
            reportError(reader, placeOfKey(given, "look_at"), "use smaller numbers",
                        "'look_at' and 'position' are too far apart");
        light->direction = normalize(axis);
    }
    if (isGiven(given, "inner_angle") && isGiven(given, "outer_angle") &&
        light->innerAngle > light->outerAngle) {
        char inner[NUMBER_TEXT_SIZE], outer[NUMBER_TEXT_SIZE];
        reportError(reader, placeOfKey(given, "inner_angle"), "exchange the two numbers",
                    "'inner_angle' must be at most 'outer_angle', which is %s, but is %s",
                    formatDouble(outer, light->outerAngle), formatDouble(inner, light->innerAngle));
    }
    addLight(reader, given, read, LIGHT_SPOT);
}

void finishArea(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    LightValues *read = values;
    read->light.countU = read->samples[0];
    read->light.countV = read->samples[1];
    addLight(reader, given, read, LIGHT_AREA);
}
