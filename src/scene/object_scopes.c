/* object_scopes.c - where an object that was read goes; see object_scopes.h. */
#include "scene/object_scopes.h"

#include "base/cancel.h"
#include "scene/format_rules.h"
#include "scene/reader.h"

#include <stdlib.h>
#include <string.h>

/* ---- What is handed down ---- */

static bool isIdentity(const Matrix *m)
{
    const Matrix identity = identityMatrix();
    const Vector3D *a[] = {&m->x, &m->y, &m->z, &m->translate};
    const Vector3D *b[] = {&identity.x, &identity.y, &identity.z, &identity.translate};
    for (int i = 0; i < 4; i++)
        if (a[i]->x != b[i]->x || a[i]->y != b[i]->y || a[i]->z != b[i]->z)
            return false;
    return true;
}

/* The transform of what was read, inside the innermost scope: its own list first, then those of the scopes.
 * Objects without a list share that of their scope. */
static const Transform *transformInScope(SceneReader *reader, const GivenKeys *given, const Matrix *own)
{
    const Transform *outer = reader->scope != NULL ? reader->scope->transform : NULL;
    if (isIdentity(own))
        return outer;
    Matrix composed = outer != NULL ? composeMatrices(own, &outer->worldFromObject) : *own;
    Transform *transform = allocateInScene(reader->scene, sizeof *transform);
    if (transform == NULL) {
        reader->outOfMemory = true;
        return NULL;
    }
    if (createTransform(&composed, transform))
        return transform;
    reportError(
        reader, placeOfKey(given, "transform"), "use larger or smaller numbers",
        "'transform'%s cannot be undone: it squeezes the object flat, or its numbers grow too large or "
        "too small",
        outer != NULL ? ", together with those of the groups round it," : "");
    return NULL;
}

/* ---- Uses of materials ---- */

static void addUse(SceneReader *reader, MaterialUse use)
{
    /* Let the use before go on where it is the same one: a million spheres name their material in one place.
     */
    MaterialUse *last = reader->useCount > 0 ? &reader->uses[reader->useCount - 1] : NULL;
    if (last != NULL && last->leaf != NAME_NONE && last->leaf + last->leafCount == use.leaf &&
        last->place.line == use.place.line && last->place.column == use.place.column &&
        last->leafCount < UINT32_MAX) {
        last->leafCount++;
        return;
    }
    use.leafCount = 1;
    MaterialUse *uses =
        makeReaderRoom(reader, reader->uses, reader->useCount, &reader->useCapacity, sizeof *uses);
    if (uses == NULL)
        return;
    reader->uses = uses;
    uses[reader->useCount++] = use;
}

void dropReadObject(SceneReader *reader)
{
    if (reader->pendingUse.name != NAME_NONE) {
        reader->pendingUse.leaf = NAME_NONE;
        addUse(reader, reader->pendingUse);
    }
}

/* The material of a leaf that has none of its own: that of the nearest scope that has one, else the default
 * material. */
static Material inheritedMaterial(const SceneReader *reader)
{
    const ObjectScope *scope = reader->scope;
    return scope != NULL && scope->hasMaterial ? scope->material : defaultMaterial();
}

/* The leaf about to be added uses that material. */
static void noteInheritedUse(SceneReader *reader)
{
    const ObjectScope *scope = reader->scope;
    if (scope == NULL || !scope->hasMaterial || scope->materialUse.name == NAME_NONE)
        return;
    MaterialUse use = scope->materialUse;
    use.leaf = reader->leafCount;
    addUse(reader, use);
}

/* ---- Adding ---- */

/* Put an object into the solid that is being read, else into the scene. */
static void addObject(SceneReader *reader, Object *object)
{
    ObjectScope *scope = reader->scope;
    if (scope == NULL || !scope->isSolid) {
        if (!addObjectToScene(reader->scene, *object)) {
            reader->outOfMemory = true;
            releaseObject(object);
        }
        return;
    }
    Object *parts =
        makeReaderRoom(reader, scope->parts, scope->partCount, &scope->partCapacity, sizeof *parts);
    if (parts == NULL) {
        releaseObject(object);
        return;
    }
    scope->parts = parts;
    parts[scope->partCount++] = *object;
}

/* What to do about a part that has no inside. */
static const char *insideHint(const Object *object)
{
    if (object->kind == SHAPE_CONE)
        return "leave 'open' out, so that it is closed at its ends";
    if (object->kind == SHAPE_MESH)
        return "close the mesh: each edge must belong to exactly two triangles";
    return "use a closed shape, such as a box, or move it out and put both into a group";
}

/* name: its kind in the file. */
static void addLeaf(SceneReader *reader, Place place, const char *name, Object *object)
{
    const ObjectScope *scope = reader->scope;
    object->line = place.line;
    if (scope != NULL && scope->isSolid && !objectShape(object)->hasInside(object))
        reportError(reader, place, insideHint(object),
                    "this %s has no inside, so it cannot be a part of a solid, here of the %s", name,
                    scope->solidName);
    addObject(reader, object);
    reader->leafCount++;
}

void addReadObject(SceneReader *reader, const GivenKeys *given, const ObjectValues *values, Object object)
{
    object.noShadow = !values->castsShadow || (reader->scope != NULL && reader->scope->noShadow);
    object.transform = transformInScope(reader, given, &values->transform);
    if (!isGiven(given, "material")) {
        object.material = inheritedMaterial(reader);
        noteInheritedUse(reader);
    } else {
        object.material = values->object.material;
        reader->pendingUse.leaf = reader->leafCount;
        if (reader->pendingUse.name != NAME_NONE)
            addUse(reader, reader->pendingUse);
    }
    addLeaf(reader, given->place, given->format->name, &object);
}

void handDown(const SceneReader *reader, Object *object)
{
    object->noShadow = reader->scope->noShadow;
    object->transform = reader->scope->transform;
    object->material = inheritedMaterial(reader);
}

void reserveInScope(SceneReader *reader, size_t count)
{
    if (!reader->scope->isSolid && !reserveObjectsInScene(reader->scene, count))
        reader->outOfMemory = true;
}

void addInnerObject(SceneReader *reader, Place place, Object *object)
{
    noteInheritedUse(reader);
    addLeaf(reader, place, objectShape(object)->name, object);
}

/* ---- Scopes ---- */

void openScope(SceneReader *reader, const GivenKeys *given, ObjectValues *values, bool isSolid,
               CsgOperation operation)
{
    ObjectScope *outer = reader->scope;
    ObjectScope *scope = &values->scope;
    *scope = (ObjectScope){.outer = outer, .materialUse = {.name = NAME_NONE}};
    scope->transform = transformInScope(reader, given, &values->transform);
    scope->noShadow = !values->castsShadow || (outer != NULL && outer->noShadow);
    if (isGiven(given, "material")) {
        scope->hasMaterial = true;
        scope->material = values->object.material;
        scope->materialUse = reader->pendingUse;
        dropReadObject(reader);
    } else if (outer != NULL && outer->hasMaterial) {
        scope->hasMaterial = true;
        scope->material = outer->material;
        scope->materialUse = outer->materialUse;
    }
    scope->isSolid = isSolid || (outer != NULL && outer->isSolid);
    scope->operation = isSolid ? operation : CSG_GROUP;
    scope->solidName = isSolid ? given->format->name : scope->isSolid ? outer->solidName : NULL;
    reader->pendingUse.name = NAME_NONE;
    reader->scope = scope;
}

void closeScope(SceneReader *reader, const GivenKeys *given)
{
    ObjectScope *scope = reader->scope;
    reader->scope = scope->outer;
    if (!scope->isSolid)
        return;
    if (scope->partCount == 0) {
        free(scope->parts);
        return;
    }

    /* Give back the room that was not needed; keep it where that fails. */
    Object *parts = realloc(scope->parts, scope->partCount * sizeof *parts);
    Object solid = {.kind = SHAPE_CSG, .line = given->place.line, .noShadow = scope->noShadow};
    solid.csg = (Csg){.material = defaultMaterial(),
                      .operation = scope->operation,
                      .parts = parts != NULL ? parts : scope->parts,
                      .partCount = scope->partCount};
    bool isWhole = scope->outer == NULL || !scope->outer->isSolid;
    if (isWhole) {
        Place *places = makeReaderRoom(reader, reader->solidPlaces, reader->solidCount,
                                       &reader->solidPlaceCapacity, sizeof *places);
        if (places != NULL) {
            reader->solidPlaces = places;
            places[reader->solidCount++] = given->place;
        }
    }
    addObject(reader, &solid);
}

/* ---- When all was read ---- */

/* A walk of all leaves in the order in which they were read. */
typedef struct LeafWalk {
    SceneReader *reader;
    size_t leaf, use, solid;
    const Object *glass; /* the first transparent part of the solid in hand, or NULL */
    const Object *other; /* one whose index of refraction is another */
} LeafWalk;

static void walkObject(LeafWalk *walk, Object *object)
{
    SceneReader *reader = walk->reader;
    if (object->kind == SHAPE_CSG) {
        for (size_t i = 0; i < object->csg.partCount; i++)
            walkObject(walk, &object->csg.parts[i]);
        return;
    }
    while (walk->use < reader->useCount && reader->uses[walk->use].leaf == NAME_NONE)
        walk->use++;
    const MaterialUse *use = walk->use < reader->useCount ? &reader->uses[walk->use] : NULL;
    if (use != NULL && walk->leaf >= use->leaf) {
        object->material = reader->materials[use->name].material;
        walk->use += walk->leaf + 1 == use->leaf + use->leafCount;
    }
    walk->leaf++;

    const Material *material = &object->material;
    if (colorIsBlack(material->transmission) || material->model == MODEL_SIMPLE)
        return;
    if (walk->glass == NULL)
        walk->glass = object;
    else if (material->ior != walk->glass->material.ior)
        walk->other = object;
}

/* A ray is inside a solid or not, whatever its parts: so it has one index of refraction. */
static void finishSolid(LeafWalk *walk, Object *solid)
{
    if (walk->glass != NULL)
        solid->csg.material.ior = walk->glass->material.ior;
    if (walk->other != NULL) {
        char first[NUMBER_TEXT_SIZE], second[NUMBER_TEXT_SIZE];
        reportError(
            walk->reader, walk->reader->solidPlaces[walk->solid],
            "give its transparent parts the same 'ior', or put them into a group",
            "a solid has one index of refraction, but this one has 'ior' %s in line %d and %s in line "
            "%d",
            formatFloat(first, walk->glass->material.ior), walk->glass->line,
            formatFloat(second, walk->other->material.ior), walk->other->line);
    }
    walk->solid++;
}

/* Put the transparent objects behind the others, each in the order of the file: of two surfaces at the same
 * distance the first one counts, and a block of glass on a floor shows the floor whichever was written first.
 * Seen the other way the ray would leave the glass on the far side of the floor. */
static void putTransparentLast(SceneReader *reader)
{
    Scene *scene = reader->scene;
    size_t transparent = 0, inFront = 0; /* inFront: of an opaque one */
    for (size_t i = 0; i < scene->objectCount; i++) {
        bool isTransparent = transmissivePart(scene, &scene->objects[i]) != NULL;
        inFront = isTransparent ? inFront : transparent;
        transparent += isTransparent;
    }
    if (inFront == 0)
        return;
    Object *last = malloc(transparent * sizeof *last);
    if (last == NULL) {
        reader->outOfMemory = true;
        return;
    }
    size_t opaque = 0, kept = 0;
    for (size_t i = 0; i < scene->objectCount; i++) {
        if (transmissivePart(scene, &scene->objects[i]) != NULL)
            last[kept++] = scene->objects[i];
        else
            scene->objects[opaque++] = scene->objects[i];
    }
    memcpy(&scene->objects[opaque], last, kept * sizeof *last);
    free(last);
}

void finishObjects(SceneReader *reader)
{
    /* With errors objects were left out, and the scene is of no use. */
    if (reader->diagnostics->errors > 0 || reader->outOfMemory)
        return;
    enum {
        CANCEL_POLL_OBJECTS = 65536
    };
    LeafWalk walk = {.reader = reader};
    for (size_t i = 0; i < reader->scene->objectCount && !reader->interrupted; i++) {
        reader->interrupted = i % CANCEL_POLL_OBJECTS == 0 && cancelRequested();
        Object *object = &reader->scene->objects[i];
        walk.glass = walk.other = NULL;
        walkObject(&walk, object);
        if (object->kind == SHAPE_CSG)
            finishSolid(&walk, object);
    }
    if (reader->diagnostics->errors == 0 && !reader->interrupted)
        putTransparentLast(reader);
}
