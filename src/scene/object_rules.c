/* object_rules.c - rules of the objects' keys, and the objects built from them; see format_rules.h. */
#include "base/cancel.h"
#include "scene/format_rules.h"
#include "scene/read_values.h"
#include "scene/reader.h"
#include "scene/scene_files.h"

/* Whether the object can be built; one that cannot was reported and is left out. */
static bool canBuild(SceneReader *reader, GivenKeys *given)
{
    if (areAllUsable(given))
        return true;
    dropReadObject(reader);
    return false;
}

/* ---- Simple shapes ---- */

void finishSphere(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    const Sphere *read = &((const ObjectValues *)values)->object.sphere;
    if (!canBuild(reader, given))
        return;
    Sphere sphere = createSphere(read->center, read->radius, read->material);
    addReadObject(reader, given, values, (Object){.kind = SHAPE_SPHERE, .sphere = sphere});
}

void finishCube(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    const Cube *read = &((const ObjectValues *)values)->object.cube;
    if (!canBuild(reader, given))
        return;
    Cube cube = createCube(read->center, read->size, read->material);
    addReadObject(reader, given, values, (Object){.kind = SHAPE_CUBE, .cube = cube});
}

void finishBox(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    const Box *read = &((const ObjectValues *)values)->object.box;
    if (isUsable(given, "min") && isUsable(given, "max")) {
        const double min[3] = {read->min.x, read->min.y, read->min.z};
        const double max[3] = {read->max.x, read->max.y, read->max.z};
        for (int i = 0; i < 3; i++) {
            char from[NUMBER_TEXT_SIZE], to[NUMBER_TEXT_SIZE];
            if (min[i] < max[i])
                continue;
            reportKeyError(reader, given, "max",
                           min[i] > max[i] ? "exchange the two numbers"
                                           : "a flat box is no box; make it a little thicker",
                           "'min' must be below 'max' on each axis, but %c goes from %s to %s", "xyz"[i],
                           formatDouble(from, min[i]), formatDouble(to, max[i]));
            break;
        }
    }
    if (!canBuild(reader, given))
        return;
    addReadObject(reader, given, values,
                  (Object){.kind = SHAPE_BOX, .box = createBox(read->min, read->max, read->material)});
}

void finishPlane(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    const Plane *read = &((const ObjectValues *)values)->object.plane;
    if (!canBuild(reader, given))
        return;
    Plane plane = createPlane(read->point, read->normal, read->material);
    addReadObject(reader, given, values, (Object){.kind = SHAPE_PLANE, .plane = plane});
}

void finishTriangle(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    const Triangle *read = &((const ObjectValues *)values)->object.triangle;
    if (isGiven(given, "vertices") && !isTriangle(read->vertices))
        reportKeyError(reader, given, "vertices", "move one of them",
                       "the three vertices lie on one line, so they span no triangle");
    if (!canBuild(reader, given))
        return;
    Triangle triangle =
        createTriangle(read->vertices, isGiven(given, "normals") ? read->normals : NULL, read->material);
    addReadObject(reader, given, values, (Object){.kind = SHAPE_TRIANGLE, .triangle = triangle});
}

/* ---- Round shapes ---- */

/* Add a cylinder or a cone. */
static void addCone(SceneReader *reader, GivenKeys *given, const ObjectValues *values, Cone cone)
{
    Vector3D axis = subVectors(cone.top, cone.base);
    if (isGiven(given, "base") && isGiven(given, "top")) {
        if (axis.x == 0 && axis.y == 0 && axis.z == 0)
            reportKeyError(reader, given, "top", "move one of the two",
                           "'top' is the same point as 'base', so the %s has no height", given->format->name);
        if (!isfinite(norm(axis)))
            reportKeyError(reader, given, "top", "use smaller numbers", "'base' and 'top' are too far apart");
    }
    if (canBuild(reader, given))
        addReadObject(reader, given, values, (Object){.kind = SHAPE_CONE, .cone = cone});
}

void finishCylinder(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    const Cone *read = &((const ObjectValues *)values)->object.cone;
    addCone(reader, given, values,
            createCylinder(read->base, read->top, read->baseRadius, read->isOpen, read->material));
}

void finishCone(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    const Cone *read = &((const ObjectValues *)values)->object.cone;
    if (isGiven(given, "base_radius") && isGiven(given, "top_radius") && read->baseRadius == 0 &&
        read->topRadius == 0)
        reportKeyError(reader, given, "top_radius", "make one of the two larger than 0",
                       "'base_radius' and 'top_radius' are both 0, so the cone is only a line");
    addCone(
        reader, given, values,
        createCone(read->base, read->top, read->baseRadius, read->topRadius, read->isOpen, read->material));
}

void finishDisc(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    const Disc *read = &((const ObjectValues *)values)->object.disc;
    char inner[NUMBER_TEXT_SIZE], radius[NUMBER_TEXT_SIZE];
    if (isGiven(given, "inner_radius") && isGiven(given, "radius") && !(read->innerRadius < read->radius))
        reportKeyError(reader, given, "inner_radius", "make the hole smaller, or the disc larger",
                       "'inner_radius' must be below 'radius', which is %s, but is %s",
                       formatDouble(radius, read->radius), formatDouble(inner, read->innerRadius));
    if (!canBuild(reader, given))
        return;
    Disc disc = createDisc(read->center, read->normal, read->radius, read->innerRadius, read->material);
    addReadObject(reader, given, values, (Object){.kind = SHAPE_DISC, .disc = disc});
}

void finishTorus(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    const Torus *read = &((const ObjectValues *)values)->object.torus;
    char minor[NUMBER_TEXT_SIZE], major[NUMBER_TEXT_SIZE];
    if (isGiven(given, "minor_radius") && isGiven(given, "major_radius") &&
        read->minorRadius > read->majorRadius)
        reportKeyError(reader, given, "minor_radius", "exchange the two numbers",
                       "'minor_radius' must be at most 'major_radius', which is %s, but is %s",
                       formatDouble(major, read->majorRadius), formatDouble(minor, read->minorRadius));
    if (!canBuild(reader, given))
        return;
    Torus torus = createTorus(read->majorRadius, read->minorRadius, read->material);
    addReadObject(reader, given, values, (Object){.kind = SHAPE_TORUS, .torus = torus});
}

/* ---- From files ---- */

void finishMesh(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    const ObjectValues *read = values;
    const MeshData *data = NULL;
    if (isGiven(given, "file"))
        data = loadMesh(reader, placeOfKey(given, "file"), read->file, read->smooth);
    if (data == NULL || !areAllUsable(given)) {
        dropReadObject(reader);
        return;
    }
    Mesh mesh = {.material = read->object.material, .data = data};
    addReadObject(reader, given, values, (Object){.kind = SHAPE_MESH, .mesh = mesh});
}

enum {
    CANCEL_POLL_SPHERES = 4096
};

/* The same as mustStop, with a look now and then at whether the user asked. */
static bool mustStopAt(SceneReader *reader, size_t number)
{
    if (number % CANCEL_POLL_SPHERES == 0 && cancelRequested())
        reader->interrupted = true;
    return mustStop(reader);
}

static void addListed(SceneReader *reader, Object *sphere, Place place, const double numbers[4])
{
    sphere->sphere =
        createSphere(createVector(numbers[0], numbers[1], numbers[2]), numbers[3], sphere->material);
    addInnerObject(reader, place, sphere);
}

/* Add the spheres of `data`. */
static void addRows(SceneReader *reader, Object *sphere, const YamlNode *list)
{
    size_t number = 0;
    for (const YamlNode *item = list->first; item != NULL && !mustStopAt(reader, number); item = item->next) {
        double numbers[4];
        number++;
        if (item->kind != NODE_ROWS) {
            if (readSphereRow(reader, rowsFormatKey, item, numbers))
                addListed(reader, sphere, item->place, numbers);
            continue;
        }
        for (size_t i = 0; i < item->count && !mustStopAt(reader, number); i++, number++)
            addListed(reader, sphere, (Place){item->rows[i].line, 1, 1}, item->rows[i].numbers);
    }
}

void finishSpheres(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)target;
    const ObjectValues *read = values;
    if (given->keys[findFormatKey(given->format, "data", 4)] == NULL &&
        given->keys[findFormatKey(given->format, "file", 4)] == NULL && !given->anyUnknown)
        reportError(reader, given->place, "add data: [[x, y, z, r], ...] or file: spheres.txt",
                    "these spheres have neither 'data' nor 'file'");
    Object sphere = {.kind = SHAPE_SPHERE};
    handDown(reader, &sphere);
    if (isGiven(given, "data")) {
        reserveInScope(reader, read->rows->count);
        addRows(reader, &sphere, read->rows);
    } else if (isGiven(given, "file")) {
        size_t count = 0;
        const ListedSphere *listed = loadSpheres(reader, placeOfKey(given, "file"), read->file, &count);
        reserveInScope(reader, count);
        for (size_t i = 0; listed != NULL && i < count && !mustStopAt(reader, i); i++) {
            Vector3D c = listed[i].center;
            addListed(reader, &sphere, given->place, (double[]){c.x, c.y, c.z, listed[i].radius});
        }
    }
    closeScope(reader, given);
}

/* ---- Groups ---- */

void enterGroup(SceneReader *reader, GivenKeys *given, void *values)
{
    openScope(reader, given, values, false, CSG_GROUP);
}

void enterSpheres(SceneReader *reader, GivenKeys *given, void *values)
{
    openScope(reader, given, values, false, CSG_GROUP);
}

void enterUnion(SceneReader *reader, GivenKeys *given, void *values)
{
    openScope(reader, given, values, true, CSG_UNION);
}

void enterIntersection(SceneReader *reader, GivenKeys *given, void *values)
{
    openScope(reader, given, values, true, CSG_INTERSECTION);
}

void enterDifference(SceneReader *reader, GivenKeys *given, void *values)
{
    openScope(reader, given, values, true, CSG_DIFFERENCE);
}

void finishGroup(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    (void)values;
    (void)target;
    closeScope(reader, given);
}
