/* compile.c - from a Scene to a CompiledScene; see compiled_scene.h.
 *
 * Objects are sorted by what the engine can do with them: spheres, meshes taken apart into triangles, planes,
 * any other shape by its box, and what has no box. They are counted first and stored then, each chunk of
 * objects at its own place, so that any number of threads gives the same arrays. Invariant: a box contains
 * every point in which the reference tracer can meet what is in it, rounded outwards.
 */
#include "engine/bvh_build.h"
#include "engine/compiled_scene.h"
#include "engine/lanes/path.h"
#include "engine/single_rays.h"

#include "base/memory.h"
#include "base/threads.h"
#include "shapes/mesh_build.h"

#include <stdlib.h>
#include <string.h>

enum {
    CHUNK_SIZE = 8192 /* objects a task */
};

/* Beyond these, products leave the range of a double, or the numbers of the tree that of a float. */
static const double LARGEST_COORDINATE = 1e200;
static const double SMALLEST_SCENE = 1e-200;

/* With a transform that stretches more than this in one direction than in another, or moves an object this
 * many times its size, rounding errors may be larger than the margins of the tree. */
static const double LARGEST_DISTORTION = 1e4;

/* What becomes of an object. */
typedef enum Treatment {
    TREAT_SPHERE,
    TREAT_MESH,
    TREAT_BOXED,
    TREAT_PLANE,
    TREAT_ENDLESS
} Treatment;

/* How many of each there are, and then where the next one goes. */
typedef struct Tally {
    size_t spheres, triangles, boxed, planes, endless;
    size_t transparent, shadowless; /* objects among them */
    double largest;                 /* coordinate */
} Tally;

typedef struct Compiling {
    const Scene *scene;
    CompiledScene *compiled;
    Tally *tallies; /* of each chunk */
    size_t chunkCount;
    BuildItem *items; /* spheres, then triangles, then boxed objects */
} Compiling;

/* ---- What becomes of an object ---- */

static bool isTame(const Transform *transform, const Bounds *bounds)
{
    if (transform == NULL)
        return true;
    const Matrix *to = &transform->worldFromObject, *from = &transform->objectFromWorld;
    double size = norm(subVectors(bounds->max, bounds->min));
    double reach =
        largestCoordinate(to->translate) + matrixNorm(to) * matrixNorm(from) * largestCoordinate(bounds->max);
    return matrixNorm(to) * matrixNorm(from) < LARGEST_DISTORTION && reach < LARGEST_DISTORTION * size;
}

static Treatment treatmentOf(const Object *object, Bounds *bounds)
{
    if (object->kind == SHAPE_PLANE && object->transform == NULL)
        return TREAT_PLANE;
    if (!objectBounds(object, bounds))
        return TREAT_ENDLESS;
    double largest = fmax(largestCoordinate(bounds->min), largestCoordinate(bounds->max));
    Vector3D size = subVectors(bounds->max, bounds->min);
    if (!(largest < LARGEST_COORDINATE) || !(size.x >= 0) || !(size.y >= 0) || !(size.z >= 0) ||
        !isTame(object->transform, bounds))
        return TREAT_ENDLESS;
    if (object->kind == SHAPE_SPHERE && object->transform == NULL)
        return TREAT_SPHERE;
    return object->kind == SHAPE_MESH ? TREAT_MESH : TREAT_BOXED;
}

/* In objectMaterial, until materials are numbered: whether an object has another one than that before it. */
enum {
    SAME_MATERIAL,
    NEW_MATERIAL
};

static void tallyChunk(void *context, size_t number)
{
    Compiling *compiling = context;
    const Scene *scene = compiling->scene;
    size_t end =
        (number + 1) * CHUNK_SIZE < scene->objectCount ? (number + 1) * CHUNK_SIZE : scene->objectCount;
    Tally tally = {0};
    for (size_t i = number * CHUNK_SIZE; i < end; i++) {
        const Object *object = &scene->objects[i];
        bool isSame = i > 0 && memcmp(&object->material, &object[-1].material, sizeof object->material) == 0;
        compiling->compiled->objectMaterial[i] = isSame ? SAME_MATERIAL : NEW_MATERIAL;
        tally.transparent += transmissivePart(scene, object) != NULL;
        tally.shadowless += object->noShadow;
        Bounds bounds;
        switch (treatmentOf(object, &bounds)) {
        case TREAT_SPHERE:
            tally.spheres++;
            break;
        case TREAT_MESH:
            tally.triangles += object->mesh.data->triangleCount;
            break;
        case TREAT_BOXED:
            tally.boxed++;
            break;
        case TREAT_PLANE:
            tally.planes++;
            continue;
        case TREAT_ENDLESS:
            tally.endless++;
            continue;
        }
        tally.largest = fmax(tally.largest, largestCoordinate(bounds.min));
        tally.largest = fmax(tally.largest, largestCoordinate(bounds.max));
    }
    compiling->tallies[number] = tally;
}

/* Turn the counts of the chunks into places; returns the counts of all. */
static Tally sumTallies(Compiling *compiling)
{
    Tally sum = {0};
    for (size_t i = 0; i < compiling->chunkCount; i++) {
        Tally own = compiling->tallies[i];
        compiling->tallies[i] = sum;
        sum.spheres += own.spheres;
        sum.triangles += own.triangles;
        sum.boxed += own.boxed;
        sum.planes += own.planes;
        sum.endless += own.endless;
        sum.transparent += own.transparent;
        sum.shadowless += own.shadowless;
        sum.largest = fmax(sum.largest, own.largest);
    }
    return sum;
}

/* ---- Storing ---- */

/* A float below x, or above x, by one to three units in the last place. */
static float roundedDown(double x)
{
    float f = (float)x;
    return f - (fabsf(f) * 0x1p-23f + 0x1p-126f);
}

static float roundedUp(double x)
{
    return -roundedDown(-x);
}

static BuildItem createItem(Vector3D min, Vector3D max, double scale, size_t primitive)
{
    BuildItem item = {{roundedDown(min.x * scale), roundedDown(min.y * scale), roundedDown(min.z * scale), 0},
                      {roundedUp(max.x * scale), roundedUp(max.y * scale), roundedUp(max.z * scale), 0}};
    setItemPrimitive(&item, (uint32_t)primitive);
    return item;
}

/* The corners of a triangle in world space. */
static void worldCorners(const Object *object, size_t triangle, Vector3D corners[3])
{
    meshCorners(object->mesh.data, triangle, corners);
    if (object->transform != NULL)
        for (int i = 0; i < 3; i++)
            corners[i] = transformPoint(&object->transform->worldFromObject, corners[i]);
}

static void storeTriangles(Compiling *compiling, uint32_t number, size_t at)
{
    const Object *object = &compiling->scene->objects[number];
    CompiledScene *compiled = compiling->compiled;
    for (size_t t = 0; t < object->mesh.data->triangleCount; t++, at++) {
        Vector3D p[3];
        worldCorners(object, t, p);
        Vector3D min = createVector(fmin(p[0].x, fmin(p[1].x, p[2].x)), fmin(p[0].y, fmin(p[1].y, p[2].y)),
                                    fmin(p[0].z, fmin(p[1].z, p[2].z)));
        Vector3D max = createVector(fmax(p[0].x, fmax(p[1].x, p[2].x)), fmax(p[0].y, fmax(p[1].y, p[2].y)),
                                    fmax(p[0].z, fmax(p[1].z, p[2].z)));
        compiled->triangles[at] = (MeshPart){number, (uint32_t)t};
        size_t primitive = compiled->sphereCount + at;
        compiling->items[primitive] = createItem(min, max, compiled->scale, primitive);
    }
}

static void storeObject(Compiling *compiling, uint32_t number, Tally *place)
{
    const Object *object = &compiling->scene->objects[number];
    CompiledScene *compiled = compiling->compiled;
    Bounds bounds;
    switch (treatmentOf(object, &bounds)) {
    case TREAT_SPHERE: {
        size_t primitive = place->spheres++;
        compiled->spheres[primitive] = (ExactSphere){object->sphere.center, object->sphere.radius};
        compiled->sphereObjects[primitive] = number;
        compiling->items[primitive] = createItem(bounds.min, bounds.max, compiled->scale, primitive);
        break;
    }
    case TREAT_MESH:
        storeTriangles(compiling, number, place->triangles);
        place->triangles += object->mesh.data->triangleCount;
        break;
    case TREAT_BOXED: {
        /* A hit may be computed to lie outside the box by some rounding errors. */
        double margin = 0x1p-20 * fmax(largestCoordinate(bounds.min), largestCoordinate(bounds.max));
        Vector3D more = createVector(margin, margin, margin);
        size_t boxed = place->boxed++;
        size_t primitive = compiled->sphereCount + compiled->triangleCount + boxed;
        compiled->generalObjects[boxed] = number;
        compiling->items[primitive] = createItem(subVectors(bounds.min, more), addVectors(bounds.max, more),
                                                 compiled->scale, primitive);
        break;
    }
    case TREAT_PLANE:
        compiled->planes[place->planes++] =
            (ExactPlane){.normal = object->plane.normal,
                         .height = dot(object->plane.normal, object->plane.point),
                         .magnitude = largestCoordinate(object->plane.point),
                         .object = number,
                         .castsShadow = !objectSkipsShadow(compiled, number)};
        break;
    case TREAT_ENDLESS:
        compiled->endless[place->endless++] = number;
        break;
    }
}

static void storeChunk(void *context, size_t number)
{
    Compiling *compiling = context;
    size_t count = compiling->scene->objectCount;
    size_t end = (number + 1) * CHUNK_SIZE < count ? (number + 1) * CHUNK_SIZE : count;
    for (size_t i = number * CHUNK_SIZE; i < end; i++)
        storeObject(compiling, (uint32_t)i, &compiling->tallies[number]);
}

/* ---- Blocks ---- */

static void fillSpheres(CompiledScene *compiled, uint32_t number, const BuildItem *items, size_t count)
{
    SphereBlock *block = &compiled->sphereBlocks[number];
    for (size_t i = 0; i < BVH_WIDTH; i++) {
        int32_t primitive = i < count ? itemPrimitive(&items[i]) : NO_PRIMITIVE;
        ExactSphere sphere = {{4, 4, 4}, 0};
        if (i < count) {
            sphere = compiled->spheres[primitive];
            sphere.center = multVector(sphere.center, compiled->scale);
            sphere.radius *= compiled->scale;
        }
        block->x[i] = (float)sphere.center.x;
        block->y[i] = (float)sphere.center.y;
        block->z[i] = (float)sphere.center.z;
        block->radius[i] = (float)sphere.radius;
        block->primitives[i] = primitive;
    }
}

static void fillTriangles(CompiledScene *compiled, uint32_t number, const BuildItem *items, size_t count)
{
    TriangleBlock *block = &compiled->triangleBlocks[number];
    for (size_t i = 0; i < BVH_WIDTH; i++) {
        int32_t primitive = i < count ? itemPrimitive(&items[i]) : NO_PRIMITIVE;
        Vector3D corners[3] = {{4, 4, 4}, {4, 4, 4}, {4, 4, 4}};
        if (i < count) {
            MeshPart part = compiled->triangles[(size_t)primitive - compiled->sphereCount];
            worldCorners(&compiled->scene->objects[part.object], part.triangle, corners);
        }
        for (int c = 0; c < 3; c++) {
            double scale = i < count ? compiled->scale : 1;
            block->corners[c][0][i] = (float)(corners[c].x * scale);
            block->corners[c][1][i] = (float)(corners[c].y * scale);
            block->corners[c][2][i] = (float)(corners[c].z * scale);
        }
        block->primitives[i] = primitive;
    }
}

static void fillObjects(CompiledScene *compiled, uint32_t number, const BuildItem *items, size_t count)
{
    ObjectBlock *block = &compiled->objectBlocks[number];
    for (size_t i = 0; i < BVH_WIDTH; i++) {
        for (int axis = 0; axis < 3; axis++) {
            block->min[axis][i] = i < count ? items[i].min[axis] : INFINITY;
            block->max[axis][i] = i < count ? items[i].max[axis] : -INFINITY;
        }
        block->primitives[i] = i < count ? itemPrimitive(&items[i]) : NO_PRIMITIVE;
    }
}

/* ---- The tree ---- */

static void *allocateAligned(size_t count, size_t size)
{
    size_t bytes = (count * size + 63) / 64 * 64;
    void *array = aligned_alloc(64, bytes > 0 ? bytes : 64);
    if (array != NULL)
        useLargePages(array, bytes);
    return array;
}

/* Give back what was reserved and not used; alignment is kept, as large arrays never move when they shrink.
 */
static void *shrink(void *array, size_t bytes)
{
    void *smaller = realloc(array, bytes > 64 ? bytes : 64);
    if (smaller == NULL)
        return array;
    if ((uintptr_t)smaller % 64 == 0)
        return smaller;
    void *aligned = allocateAligned(bytes, 1);
    if (aligned == NULL)
        return NULL;
    memcpy(aligned, smaller, bytes);
    free(smaller);
    return aligned;
}

/* Build one tree for each kind of block, and hang them below one root. */
static Status buildTrees(Compiling *compiling, int threads)
{
    CompiledScene *compiled = compiling->compiled;
    const size_t counts[3] = {compiled->sphereCount, compiled->triangleCount, compiled->generalCount};
    const LeafKind kinds[3] = {LEAF_SPHERES, LEAF_TRIANGLES, LEAF_OBJECTS};
    const FillBlock fills[3] = {fillSpheres, fillTriangles, fillObjects};
    const size_t sizes[3] = {sizeof(SphereBlock), sizeof(TriangleBlock), sizeof(ObjectBlock)};
    void **arrays[3] = {(void **)&compiled->sphereBlocks, (void **)&compiled->triangleBlocks,
                        (void **)&compiled->objectBlocks};
    size_t *blockCounts[3] = {&compiled->sphereBlockCount, &compiled->triangleBlockCount,
                              &compiled->objectBlockCount};

    size_t nodeLimit = 1;
    for (int k = 0; k < 3; k++)
        nodeLimit += counts[k] > 0 ? bvhNodeLimit(counts[k]) : 0;
    compiled->nodes = allocateAligned(nodeLimit, sizeof(BvhNode));
    if (compiled->nodes == NULL)
        return statusOutOfMemory();
    atomic_uint nodesUsed = 1;
    compiled->root = CHILD_NONE;
    int trees = 0;
    BuildItem *items = compiling->items;
    for (int k = 0; k < 3; k++) {
        if (counts[k] == 0)
            continue;
        *arrays[k] = allocateAligned(bvhBlockLimit(counts[k]), sizes[k]);
        if (*arrays[k] == NULL)
            return statusOutOfMemory();
        BvhBuild build = {.compiled = compiled,
                          .items = items,
                          .count = counts[k],
                          .kind = kinds[k],
                          .fill = fills[k],
                          .nodesUsed = &nodesUsed,
                          .threads = threads};
        atomic_init(&build.blocksUsed, 0);
        uint32_t root;
        BuildItem box;
        Status status = buildBvh(&build, &root, &box);
        if (!statusIsOk(&status))
            return status;
        *blockCounts[k] = build.blocksUsed;
        *arrays[k] = shrink(*arrays[k], *blockCounts[k] * sizes[k]);
        if (*arrays[k] == NULL)
            return statusOutOfMemory();
        items += counts[k];
        setNodeChild(&compiled->nodes[0], trees++, &box, root);
        compiled->root = root;
    }
    if (trees > 1) {
        for (int i = trees; i < BVH_WIDTH; i++)
            setNodeChild(&compiled->nodes[0], i, NULL, CHILD_NONE);
        compiled->root = childReference(LEAF_NODE, 0);
    }
    compiled->nodeCount = nodesUsed;
    compiled->nodes = shrink(compiled->nodes, compiled->nodeCount * sizeof(BvhNode));
    return compiled->nodes != NULL ? statusOk() : statusOutOfMemory();
}

/* ---- Materials and shadows ---- */

static uint64_t hashMaterial(const Material *material)
{
    /* FNV-1a (Fowler, Noll and Vo), by words. */
    uint64_t hash = 14695981039346656037u;
    uint32_t words[sizeof *material / 4];
    memcpy(words, material, sizeof words);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        hash = (hash ^ words[i]) * 1099511628211u;
    return hash ^ hash >> 32;
}

/* Number the materials that occur. Two that differ only in what lies between their fields count twice, which
 * does no harm. */
static bool collectMaterials(Compiling *compiling)
{
    const Scene *scene = compiling->scene;
    CompiledScene *compiled = compiling->compiled;
    size_t tableSize = 64, capacity = 16;
    uint32_t *table = calloc(tableSize, sizeof *table); /* number + 1; 0: free */
    compiled->materials = malloc(capacity * sizeof *compiled->materials);
    bool ok = table != NULL && compiled->materials != NULL;
    for (size_t i = 0; i < scene->objectCount && ok; i++) {
        if (compiled->objectMaterial[i] == SAME_MATERIAL) {
            compiled->objectMaterial[i] = compiled->objectMaterial[i - 1];
            continue;
        }
        const Material *material = &scene->objects[i].material;
        size_t slot = hashMaterial(material) & (tableSize - 1);
        while (table[slot] != 0 &&
               memcmp(material, &compiled->materials[table[slot] - 1], sizeof *material) != 0)
            slot = (slot + 1) & (tableSize - 1);
        if (table[slot] == 0) {
            if (compiled->materialCount == capacity) {
                capacity *= 2;
                Material *larger = realloc(compiled->materials, capacity * sizeof *larger);
                if (larger == NULL) {
                    ok = false;
                    break;
                }
                compiled->materials = larger;
            }
            memcpy(&compiled->materials[compiled->materialCount++], material, sizeof *material);
            table[slot] = (uint32_t)compiled->materialCount;
        }
        compiled->objectMaterial[i] = table[slot] - 1;

        /* Keep the table at most half full. */
        if (2 * compiled->materialCount > tableSize) {
            free(table);
            tableSize *= 4;
            table = calloc(tableSize, sizeof *table);
            ok = table != NULL;
            for (size_t m = 0; m < compiled->materialCount && ok; m++) {
                slot = hashMaterial(&compiled->materials[m]) & (tableSize - 1);
                while (table[slot] != 0)
                    slot = (slot + 1) & (tableSize - 1);
                table[slot] = (uint32_t)m + 1;
            }
        }
    }
    free(table);
    return ok;
}

/* Find the transparent objects, and which ones block no light by themselves. */
static bool collectShadows(Compiling *compiling, const Tally *all)
{
    const Scene *scene = compiling->scene;
    CompiledScene *compiled = compiling->compiled;
    if (all->transparent + all->shadowless == 0)
        return true;
    bool failed;
    compiled->transparent = findTransparentObjects(scene, &compiled->transparentCount, &failed);
    compiled->skipsShadow = calloc(scene->objectCount, 1);
    if (failed || compiled->skipsShadow == NULL)
        return false;
    for (size_t i = 0; i < scene->objectCount; i++)
        compiled->skipsShadow[i] = scene->objects[i].noShadow;
    for (size_t i = 0; i < compiled->transparentCount; i++)
        compiled->skipsShadow[compiled->transparent[i]] = 1;
    return true;
}

/* ---- All of it ---- */

/* The power of two that brings this number to 1 .. 2. */
static double scaleFor(double largest)
{
    int exponent;
    frexp(largest, &exponent);
    return ldexp(1, 1 - exponent);
}

static Status compileInto(Compiling *compiling, int threads)
{
    const Scene *scene = compiling->scene;
    CompiledScene *compiled = compiling->compiled;
    compiled->objectMaterial = malloc((scene->objectCount + 1) * sizeof *compiled->objectMaterial);

    /* Count. */
    compiling->chunkCount = (scene->objectCount + CHUNK_SIZE - 1) / CHUNK_SIZE;
    compiling->tallies = calloc(compiling->chunkCount + 1, sizeof *compiling->tallies);
    if (compiled->objectMaterial == NULL || compiling->tallies == NULL)
        return statusOutOfMemory();
    Status status = runTasks(compiling->chunkCount, threads, tallyChunk, compiling);
    if (!statusIsOk(&status))
        return status;
    Tally all = sumTallies(compiling);
    if (!collectMaterials(compiling) || !collectShadows(compiling, &all))
        return statusOutOfMemory();
    if (all.spheres + all.triangles + all.boxed > MOST_PRIMITIVES)
        return statusError(
            STATUS_SCENE,
            "the scene has more than %d spheres, triangles and other parts, which the fast engine "
            "cannot hold; draw it with --engine reference",
            MOST_PRIMITIVES);

    /* Choose the scale, by all that rays start from or meet. */
    double largest = fmax(all.largest, largestCoordinate(scene->camera.position));
    compiled->scale = largest > SMALLEST_SCENE && largest < LARGEST_COORDINATE ? scaleFor(largest) : 1;

    /* Store. */
    compiled->sphereCount = all.spheres;
    compiled->triangleCount = all.triangles;
    compiled->generalCount = all.boxed;
    compiled->planeCount = all.planes;
    compiled->endlessCount = all.endless;
    compiled->spheres = malloc((all.spheres + 1) * sizeof *compiled->spheres);
    compiled->sphereObjects = malloc((all.spheres + 1) * sizeof *compiled->sphereObjects);
    compiled->triangles = malloc((all.triangles + 1) * sizeof *compiled->triangles);
    compiled->generalObjects = malloc((all.boxed + 1) * sizeof *compiled->generalObjects);
    compiled->planes = malloc((all.planes + 1) * sizeof *compiled->planes);
    compiled->endless = malloc((all.endless + 1) * sizeof *compiled->endless);
    compiling->items = allocateAligned(all.spheres + all.triangles + all.boxed, sizeof *compiling->items);
    if (compiled->spheres == NULL || compiled->sphereObjects == NULL || compiled->triangles == NULL ||
        compiled->generalObjects == NULL || compiled->planes == NULL || compiled->endless == NULL ||
        compiling->items == NULL)
        return statusOutOfMemory();
    status = runTasks(compiling->chunkCount, threads, storeChunk, compiling);
    if (!statusIsOk(&status))
        return status;
    status = buildTrees(compiling, threads);
    if (!statusIsOk(&status))
        return status;
    compiled->lanesShade = isnan(scene->render.shadowBias);
    return statusOk();
}

Status compileScene(const Scene *scene, int threads, CompiledScene **compiled)
{
    const LanePath *path;
    Status status = chooseLanePath(&path);
    if (!statusIsOk(&status))
        return status;
    CompiledScene *made = calloc(1, sizeof *made);
    if (made == NULL)
        return statusOutOfMemory();
    made->scene = scene;
    made->path = path;
    made->finder = createSingleRays(scene);
    Compiling compiling = {.scene = scene, .compiled = made};
    status = compileInto(&compiling, threads);
    free(compiling.tallies);
    free(compiling.items);
    if (!statusIsOk(&status)) {
        freeCompiledScene(made);
        return status;
    }
#ifdef ECLAIRAGE_CHECK_TREE
    const char *fault = findBvhFault(made);
    if (fault != NULL) {
        freeCompiledScene(made);
        return statusError(STATUS_SCENE, "the fast engine made a wrong tree: %s; please report it", fault);
    }
#endif
    *compiled = made;
    return statusOk();
}

void freeCompiledScene(CompiledScene *compiled)
{
    if (compiled == NULL)
        return;
    free(compiled->nodes);
    free(compiled->sphereBlocks);
    free(compiled->triangleBlocks);
    free(compiled->objectBlocks);
    free(compiled->spheres);
    free(compiled->sphereObjects);
    free(compiled->triangles);
    free(compiled->generalObjects);
    free(compiled->planes);
    free(compiled->endless);
    free(compiled->transparent);
    free(compiled->skipsShadow);
    free(compiled->materials);
    free(compiled->objectMaterial);
    free(compiled);
}

const SurfaceFinder *compiledFinder(const CompiledScene *compiled)
{
    return &compiled->finder;
}

size_t compiledSceneBytes(const CompiledScene *c)
{
    return sizeof *c + c->nodeCount * sizeof *c->nodes + c->sphereBlockCount * sizeof *c->sphereBlocks +
           c->triangleBlockCount * sizeof *c->triangleBlocks + c->objectBlockCount * sizeof *c->objectBlocks +
           c->sphereCount * (sizeof *c->spheres + sizeof *c->sphereObjects) +
           c->triangleCount * sizeof *c->triangles + c->generalCount * sizeof *c->generalObjects +
           c->planeCount * sizeof *c->planes + c->endlessCount * sizeof *c->endless +
           c->transparentCount * sizeof *c->transparent +
           (c->skipsShadow != NULL ? c->scene->objectCount : 0) + c->materialCount * sizeof *c->materials +
           c->scene->objectCount * sizeof *c->objectMaterial;
}

const char *compiledScenePath(const CompiledScene *compiled)
{
    return compiled->path->name;
}
