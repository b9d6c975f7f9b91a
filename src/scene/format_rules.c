/* format_rules.c - what the table cannot say; see format_rules.h. */
#include "scene/format_rules.h"

#include "scene/reader.h"

#include <string.h>

void finishImage(SceneReader *reader, const GivenKeys *given, void *values, void *target)
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

void finishCamera(SceneReader *reader, const GivenKeys *given, void *values, void *target)
{
    const CameraValues *camera = values;
    Camera *built = target;
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
    *built =
        (Camera){.position = camera->position, .direction = direction, .up = camera->up, .fov = camera->fov};
}

/* ---- Lights and objects ---- */

void finishPoint(SceneReader *reader, const GivenKeys *given, void *values, void *target)
{
    (void)target;
    const Light *read = values;
    Light light = createLight(read->position, read->color);
    light.falloff = read->falloff;
    addReadLight(reader, given, light);
}

void finishSphere(SceneReader *reader, const GivenKeys *given, void *values, void *target)
{
    (void)target;
    const Sphere *read = &((const Object *)values)->sphere;
    Sphere sphere = createSphere(read->center, read->radius, read->material);
    addReadObject(reader, given, (Object){.kind = SHAPE_SPHERE, .sphere = sphere});
}

void finishCube(SceneReader *reader, const GivenKeys *given, void *values, void *target)
{
    (void)target;
    const Cube *read = &((const Object *)values)->cube;
    Cube cube = createCube(read->center, read->size, read->material);
    addReadObject(reader, given, (Object){.kind = SHAPE_CUBE, .cube = cube});
}

void finishBox(SceneReader *reader, const GivenKeys *given, void *values, void *target)
{
    (void)target;
    const Box *read = &((const Object *)values)->box;
    if (isUsable(given, "min") && isUsable(given, "max")) {
        const double min[3] = {read->min.x, read->min.y, read->min.z};
        const double max[3] = {read->max.x, read->max.y, read->max.z};
        for (int i = 0; i < 3; i++) {
            char from[NUMBER_TEXT_SIZE], to[NUMBER_TEXT_SIZE];
            if (min[i] < max[i])
                continue;
            reportError(reader, placeOfKey(given, "max"),
                        min[i] > max[i] ? "exchange the two numbers"
                                        : "a flat box is no box; make it a little thicker",
                        "'min' must be below 'max' on each axis, but %c goes from %s to %s", "xyz"[i],
                        formatDouble(from, min[i]), formatDouble(to, max[i]));
            break;
        }
    }
    addReadObject(reader, given,
                  (Object){.kind = SHAPE_BOX, .box = createBox(read->min, read->max, read->material)});
}

void finishPlane(SceneReader *reader, const GivenKeys *given, void *values, void *target)
{
    (void)target;
    const Plane *read = &((const Object *)values)->plane;
    Plane plane = createPlane(read->point, read->normal, read->material);
    addReadObject(reader, given, (Object){.kind = SHAPE_PLANE, .plane = plane});
}
