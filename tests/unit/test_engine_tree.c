/* The tree of the fast engine: its invariants on nasty distributions, that faults in it are found, and what
 * it takes of time and memory; and that its work can be cancelled. */
#include "base/cancel.h"
#include "engine/compiled_scene.h"
#include "random_shapes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

/* Sphere number i of n. */
typedef Sphere (*Distribution)(size_t i, size_t n);

static Sphere sphereAt(double x, double y, double z, double radius)
{
    return createSphere(createVector(x, y, z), radius, defaultMaterial());
}

static Sphere coincident(size_t i, size_t n)
{
    (void)i;
    (void)n;
    return sphereAt(1, 2, 3, 0.5);
}

static Sphere inALine(size_t i, size_t n)
{
    return sphereAt((double)i / (double)n, 0, 0, 1e-3);
}

static Sphere inAPlane(size_t i, size_t n)
{
    return sphereAt((double)(i % 71), -3, (double)(i / 71) + 0 * (double)n, 0.5);
}

static Sphere growing(size_t i, size_t n)
{
    double size = pow(1e30, (double)i / (double)n);
    return sphereAt(size, -size, 0, size / 3);
}

static Sphere shrinking(size_t i, size_t n)
{
    double size = pow(1e-300, (double)i / (double)n);
    return sphereAt(size, size, size, size / 3);
}

static Sphere oneHuge(size_t i, size_t n)
{
    (void)n;
    return i == 0 ? sphereAt(0, -1e6, 0, 1e6) : sphereAt(1e-3 * (double)i, 0, 0, 1e-3);
}

static Sphere concentric(size_t i, size_t n)
{
    return sphereAt(0, 0, 0, (double)(i + 1) / (double)n);
}

static Sphere denormal(size_t i, size_t n)
{
    (void)n;
    return sphereAt((double)i * 1e-315, 0, -(double)i * 1e-316, 1e-316);
}

static Sphere denormalInFloat(size_t i, size_t n)
{
    return i == 0 ? sphereAt(1, 1, 1, 1) : sphereAt((double)i / (double)n * 1e-39, 0, 0, 1e-42);
}

static Sphere scattered(size_t i, size_t n)
{
    (void)i;
    (void)n;
    return createSphere(randomVector(1), 0.01, defaultMaterial());
}

static const Distribution distributions[] = {coincident, inALine,    inAPlane, growing,         shrinking,
                                             oneHuge,    concentric, denormal, denormalInFloat, scattered};

static Scene sceneOf(Distribution distribution, size_t count)
{
    Scene scene = createScene();
    for (size_t i = 0; i < count; i++)
        assert_true(addSphereToScene(&scene, distribution(i, count)));
    return scene;
}

static CompiledScene *compile(const Scene *scene, int threads)
{
    CompiledScene *compiled;
    Status status = compileScene(scene, threads, &compiled);
    if (!statusIsOk(&status))
        fail_msg("%s", status.message);
    return compiled;
}

static void noFaultInAnyTree(void **state)
{
    (void)state;
    static const size_t counts[] = {0, 1, 8, 9, 64, 65, 5000};
    for (size_t d = 0; d < sizeof distributions / sizeof *distributions; d++)
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
            for (int threads = 1; threads <= 4; threads += 3) {
                Scene scene = sceneOf(distributions[d], counts[c]);
                CompiledScene *compiled = compile(&scene, threads);
                const char *fault = findBvhFault(compiled);
                if (fault != NULL || compiled->sphereCount != counts[c])
                    fail_msg("distribution %zu, %zu spheres, %d threads: %s", d, counts[c], threads,
                             fault != NULL ? fault : "not as many");
                freeCompiledScene(compiled);
                freeScene(&scene);
            }
}

/* Spheres, triangles and boxes, each in a tree of its own below one root. */
static Scene mixedScene(void)
{
    Scene scene = sceneOf(scattered, 300);
    for (int i = 0; i < 100; i++)
        addCubeToScene(&scene, createCube(randomVector(1), 0.01, defaultMaterial()));
    MeshData *mesh = calloc(1, sizeof *mesh);
    mesh->vertices = calloc(300, sizeof *mesh->vertices);
    mesh->triangles = calloc(100, sizeof *mesh->triangles);
    for (uint32_t i = 0; i < 300; i++)
        mesh->vertices[i] = randomVector(1);
    for (uint32_t i = 0; i < 100; i++)
        mesh->triangles[i] = (MeshTriangle){{3 * i, 3 * i + 1, 3 * i + 2}, {0, 0, 0}};
    mesh->vertexCount = 300;
    mesh->triangleCount = 100;
    Status status = buildMesh(mesh);
    assert_true(statusIsOk(&status) && keepMeshInScene(&scene, mesh));
    addObjectToScene(&scene, (Object){.kind = SHAPE_MESH, .mesh = {defaultMaterial(), mesh}});
    return scene;
}

static void assertFault(const CompiledScene *compiled, const char *expected)
{
    const char *fault = findBvhFault(compiled);
    if (fault == NULL)
        fail_msg("not found: %s", expected);
    assert_string_equal(fault, expected);
}

static void plantedFaultsAreFound(void **state)
{
    (void)state;
    Scene scene = mixedScene();
    CompiledScene *compiled = compile(&scene, 1);
    assert_null(findBvhFault(compiled));
    BvhNode *root = &compiled->nodes[childNumber(compiled->root)];
    BvhNode *inner = &compiled->nodes[childNumber(root->children[0])], kept = *inner;

    /* A box that is moved, and one that is too small for what is in it. */
    inner->max[1][0] += 3;
    assertFault(compiled, "a box outside its parent's");
    *inner = kept;
    inner->min[0][0] = inner->max[0][0];
    assert_non_null(findBvhFault(compiled));
    *inner = kept;
    inner->min[2][0] = NAN;
    assert_non_null(findBvhFault(compiled));
    *inner = kept;

    /* A child that is dropped: the last one, then one before others. */
    int last = BVH_WIDTH - 1;
    while (inner->children[last] == CHILD_NONE)
        last--;
    inner->children[last] = CHILD_NONE;
    assertFault(compiled, "a primitive that is in no block");
    *inner = kept;
    inner->children[0] = CHILD_NONE;
    assertFault(compiled, "a child behind an absent one");
    *inner = kept;

    /* A child twice, one that is not there, and a tree without end. */
    for (int axis = 0; axis < 3; axis++) {
        inner->min[axis][1] = inner->min[axis][0];
        inner->max[axis][1] = inner->max[axis][0];
    }
    inner->children[1] = inner->children[0];
    assertFault(compiled, "a primitive in two places");
    *inner = kept;
    inner->children[0] = childReference(LEAF_TRIANGLES, (uint32_t)compiled->triangleBlockCount);
    assertFault(compiled, "a block that is not there");
    inner->children[0] = childReference(LEAF_NODE, (uint32_t)compiled->nodeCount);
    assertFault(compiled, "a node too deep, or one that is not there");
    *inner = kept;
    for (int axis = 0; axis < 3; axis++) {
        inner->min[axis][0] = root->min[axis][0];
        inner->max[axis][0] = root->max[axis][0];
    }
    inner->children[0] = root->children[0];
    assertFault(compiled, "a node too deep, or one that is not there");
    *inner = kept;

    /* A primitive that is in two places, out of its box, or none. */
    int32_t *primitives = compiled->triangleBlocks[0].primitives;
    int32_t primitive = primitives[0];
    primitives[0] = compiled->objectBlocks[0].primitives[0];
    assertFault(compiled, "a primitive in two places");
    primitives[0] = NO_PRIMITIVE;
    assertFault(compiled, "a primitive that is in no block");
    primitives[0] = INT32_MAX;
    assertFault(compiled, "a primitive that is not there");
    primitives[0] = primitive;
    float radius = compiled->sphereBlocks[0].radius[0];
    compiled->sphereBlocks[0].radius[0] = 1;
    assertFault(compiled, "a primitive outside its box");
    compiled->sphereBlocks[0].radius[0] = radius;
    compiled->triangleBlocks[0].corners[1][2][0] += 3;
    assertFault(compiled, "a primitive outside its box");
    freeCompiledScene(compiled);
    freeScene(&scene);
}

static double secondsSince(const struct timespec *start)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)(now.tv_sec - start->tv_sec) + 1e-9 * (double)(now.tv_nsec - start->tv_nsec);
}

/* Of so many that no ray can tell apart, the rays must look at all: but at each once, and on a flat stack. */
static void manyCoincidentSpheres(void **state)
{
    (void)state;
    size_t count = getenv("ECLAIRAGE_SANITIZED") != NULL ? 20000 : 1000000;
    Scene scene = sceneOf(coincident, count);
    scene.objects[0].sphere.material.diffuse = createColor(0, 1, 0);
    scene.camera.position = createVector(1, 2, 5);
    addLightToScene(&scene, createLight(createVector(5, 5, 5), createColor(9, 9, 9)));
    struct timespec start;
    clock_gettime(CLOCK_MONOTONIC, &start);
    CompiledScene *compiled = compile(&scene, 2);
    assert_null(findBvhFault(compiled));
    Framebuffer *framebuffer = createFramebuffer(8, 8);
    RenderOptions options = {.threads = 2};
    Status status = renderCompiled(compiled, framebuffer, &options, NULL);
    assert_true(statusIsOk(&status));
    /* The first one is seen. */
    Color3f middle = framebuffer->pixels[8 * 4 + 4];
    assert_true(middle.g > 0 && middle.r == 0 && middle.b == 0);
    if (secondsSince(&start) > 30)
        fail_msg("%zu spheres in one place take %.1f s", count, secondsSince(&start));
    freeFramebuffer(framebuffer);
    freeCompiledScene(compiled);
    freeScene(&scene);
}

static void fewBytesForASphere(void **state)
{
    (void)state;
    const size_t count = 100000;
    Scene scene = sceneOf(scattered, count);
    for (int threads = 1; threads <= 2; threads++) {
        CompiledScene *compiled = compile(&scene, threads);
        double each = (double)compiledSceneBytes(compiled) / (double)count;
        if (!(each <= 100) || each < 40)
            fail_msg("%g bytes a sphere", each);
        freeCompiledScene(compiled);
    }
    freeScene(&scene);
}

static void anUnknownPathIsAnError(void **state)
{
    (void)state;
    Scene scene = createScene();
    CompiledScene *compiled = NULL;
    setenv("ECLAIRAGE_PATH", "abacus", 1);
    Status status = compileScene(&scene, 1, &compiled);
    unsetenv("ECLAIRAGE_PATH");
    assert_int_equal(status.code, STATUS_USAGE);
    assert_non_null(strstr(status.message, "abacus"));
    assert_null(compiled);
}

/* Nothing takes a cancellation back, so this is the last test. */
static void cancelled(void **state)
{
    (void)state;
    for (size_t count = 100; count <= 10000; count *= 10) {
        Scene scene = sceneOf(scattered, count);
        CompiledScene *compiled = NULL, *before = cancelRequested() ? NULL : compile(&scene, 2);
        requestCancel();
        Status status = compileScene(&scene, 2, &compiled);
        assert_int_equal(status.code, STATUS_INTERRUPTED);
        assert_null(compiled);
        if (before != NULL) {
            Framebuffer *framebuffer = createFramebuffer(200, 200);
            RenderOptions options = {.threads = 2};
            status = renderCompiled(before, framebuffer, &options, NULL);
            assert_int_equal(status.code, STATUS_INTERRUPTED);
            freeFramebuffer(framebuffer);
            freeCompiledScene(before);
        }
        freeScene(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(noFaultInAnyTree),       cmocka_unit_test(plantedFaultsAreFound),
        cmocka_unit_test(manyCoincidentSpheres),  cmocka_unit_test(fewBytesForASphere),
        cmocka_unit_test(anUnknownPathIsAnError), cmocka_unit_test(cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
