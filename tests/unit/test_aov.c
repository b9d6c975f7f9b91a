/* test_aov.c - the pictures of the first surface, where they can be worked out by hand. */
#include "base/text.h"
#include "engine/engine.h"
#include "explain/aov.h"
#include "loaded_scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* Draw AOVs of a scene, on this many threads. */
static AovPictures drawAovs(const Scene *scene, unsigned set, int threads)
{
    CompiledScene *compiled;
    Status status = compileScene(scene, threads, &compiled);
    assert_true(statusIsOk(&status));
    RenderOptions options = {.threads = threads};
    AovPictures aovs;
    status =
        renderAovs(compiledFinder(compiled), set, scene->image.width, scene->image.height, &options, &aovs);
    assert_true(statusIsOk(&status));
    freeCompiledScene(compiled);
    return aovs;
}

static Color3f at(const AovPictures *aovs, Aov aov, int x, int y)
{
    const Framebuffer *picture = aovs->pictures[aov];
    assert_non_null(picture);
    return picture->pixels[y * picture->width + x];
}

static void assertColor(Color3f color, double r, double g, double b)
{
    assert_true(fabs((double)color.r - r) < 1e-6);
    assert_true(fabs((double)color.g - g) < 1e-6);
    assert_true(fabs((double)color.b - b) < 1e-6);
}

/* The handout's sphere, 3.5 before the camera, and a smaller one to the right at the same distance; an odd
 * size, so that the middle of a pixel is the picture's middle. */
static const char TWO_SPHERES[] =
    "image: {width: 33, height: 33}\n"
    "objects:\n"
    "  - sphere: {center: [0, 0, -5], radius: 1.5, material: {diffuse: [1, 0.5, 0]}}\n"
    "  - sphere: {center: [2, 0, -5], radius: 0.5}\n";

static void testSphereAhead(void **state)
{
    (void)state;
    Scene scene = load(TWO_SPHERES);
    AovPictures aovs = drawAovs(&scene, ALL_AOVS, 2);

    /* The normal at its middle comes straight at the viewer. */
    assertColor(at(&aovs, AOV_NORMAL, 16, 16), 0.5, 0.5, 1);
    assert_true(at(&aovs, AOV_NORMAL, 20, 16).r > 0.6f);
    assert_true(at(&aovs, AOV_NORMAL, 16, 12).g > 0.6f);
    assertColor(at(&aovs, AOV_NORMAL, 0, 0), 0, 0, 0);

    /* Depth is a share of the farthest. */
    assert_true(aovs.farthest > 3.5 && aovs.farthest < 5.5);
    assert_true(fabs((double)at(&aovs, AOV_DEPTH, 16, 16).g * aovs.farthest - 3.5) < 1e-6);
    assertColor(at(&aovs, AOV_DEPTH, 0, 0), 1, 1, 1);

    assertColor(at(&aovs, AOV_ALBEDO, 16, 16), 1, 0.5, 0);
    assertColor(at(&aovs, AOV_ALBEDO, 0, 0), 0, 0, 0);

    /* No light, nothing in its way; no mirror, no glass. */
    assertColor(at(&aovs, AOV_SHADOW, 16, 16), 1, 1, 1);
    assertColor(at(&aovs, AOV_REFLECTION, 16, 16), 0, 0, 0);
    assertColor(at(&aovs, AOV_TRANSMISSION, 16, 16), 0, 0, 0);

    /* The terms are not drawn here. */
    assert_null(aovs.pictures[AOV_DIFFUSE]);
    assert_null(aovs.pictures[AOV_BACKGROUND]);
    freeAovPictures(&aovs);

    /* The same on one thread; only what was asked for. */
    aovs = drawAovs(&scene, 1u << AOV_DEPTH, 1);
    assert_true(fabs((double)at(&aovs, AOV_DEPTH, 16, 16).r * aovs.farthest - 3.5) < 1e-6);
    assert_null(aovs.pictures[AOV_NORMAL]);
    assert_null(aovs.objectPixels);
    freeAovPictures(&aovs);
    freeScene(&scene);
}

/* Each object has one flat colour, with several samples too, and the pixels are counted. */
static void testId(void **state)
{
    (void)state;
    Scene scene = load(TWO_SPHERES);
    scene.render.samples = 3;
    AovPictures aovs = drawAovs(&scene, 1u << AOV_ID, 2);
    uint64_t counts[3] = {0, 0, 0};
    for (int y = 0; y < 33; y++) {
        for (int x = 0; x < 33; x++) {
            Color3f color = at(&aovs, AOV_ID, x, y);
            uint32_t stored = quantizeSample(color.r, 8, ENCODING_LINEAR) << 16 |
                              quantizeSample(color.g, 8, ENCODING_LINEAR) << 8 |
                              quantizeSample(color.b, 8, ENCODING_LINEAR);
            int which = stored == objectIdColor(0) ? 0 : stored == objectIdColor(1) ? 1 : 2;
            assert_true(which < 2 || stored == 0);
            counts[which]++;
        }
    }
    assert_true(counts[0] > counts[1] && counts[1] > 0);
    assert_true(counts[0] == aovs.objectPixels[0] && counts[1] == aovs.objectPixels[1]);
    freeAovPictures(&aovs);
    freeScene(&scene);
}

static void testIdColorsAreDistinct(void **state)
{
    (void)state;
    static uint8_t seen[(1 << 24) / 8];
    for (size_t i = 0; i < (1 << 24) - 1; i++) {
        uint32_t color = objectIdColor(i);
        assert_true(color > 0 && color < 1 << 24);
        if ((seen[color / 8] & 1 << color % 8) != 0)
            fail_msg("object %zu has the colour of an earlier one", i);
        seen[color / 8] = (uint8_t)(seen[color / 8] | 1 << color % 8);
    }
}

/* A floor seen from above, with a lamp over a disc: the shadow lies under the disc. One of two lamps leaves
 * half. */
static const char SHADOWED[] = "image: {width: 33, height: 33}\n"
                               "camera: {position: [0, 0.5, 4], direction: [0, -0.1, -1]}\n"
                               "lights:\n"
                               "  - point: {position: [0, 4, 0], color: [1, 0, 0]}\n"
                               "%s"
                               "objects:\n"
                               "  - plane: {point: [0, -1, 0], normal: [0, 1, 0]}\n"
                               "  - disc: {center: [0, 2, 0], normal: [0, 1, 0], radius: 1%s}\n";

static Color3f shadowAtOrigin(const char *secondLight, const char *material)
{
    Text yaml = {0};
    textAppendFormat(&yaml, SHADOWED, secondLight, material);
    Scene scene = load(textString(&yaml));
    textFree(&yaml);
    scene.camera.direction = subVectors(createVector(0, -1, 0), scene.camera.position);
    AovPictures aovs = drawAovs(&scene, 1u << AOV_SHADOW, 1);
    Color3f color = at(&aovs, AOV_SHADOW, 16, 16);
    /* The floor in front of the camera is lit. */
    assertColor(at(&aovs, AOV_SHADOW, 16, 32), 1, 1, 1);
    freeAovPictures(&aovs);
    freeScene(&scene);
    return color;
}

static void testShadow(void **state)
{
    (void)state;
    static const char bright[] = "  - point: {position: [0, 1, 0], color: 50}\n";
    static const char below[] = "  - point: {position: [0, -5, 0], color: 50}\n";
    assertColor(shadowAtOrigin("", ""), 0, 0, 0);
    /* Each light counts the same, however bright; one behind the surface does not count. */
    assertColor(shadowAtOrigin(bright, ""), 0.5, 0.5, 0.5);
    assertColor(shadowAtOrigin(below, ""), 0, 0, 0);
    /* Through glass its colour. */
    assertColor(shadowAtOrigin("", ", material: {transmission: [0.25, 0.5, 1]}"), 0.25, 0.5, 1);
    assertColor(shadowAtOrigin("", ", casts_shadow: false"), 1, 1, 1);
}

/* A mirror, a pane of no refraction, and fog before both. */
static void testRaysOnward(void **state)
{
    (void)state;
    static const char scenes[] =
        "image: {width: 3, height: 3}\n"
        "background: {gradient: {bottom: [0, 0, 0], top: [0, 1, 0]}}\n"
        "fog: {color: [0, 0, 1], distance: 1e9}\n"
        "objects:\n"
        "  - disc: {center: [0, 0, -2], normal: [0, 0, 1], radius: 1,\n"
        "           material: {diffuse: 0, reflection: 0.25, transmission: [0.5, 0, 0]}}\n"
        "  - sphere: {center: [0, 0, -9], radius: 2, material: {emission: 1}}\n"
        "  - sphere: {center: [0, 0, 9], radius: 2, material: {emission: [0, 1, 0]}}\n";
    Scene scene = load(scenes);
    AovPictures aovs = drawAovs(&scene, ALL_AOVS, 1);
    assertColor(at(&aovs, AOV_REFLECTION, 1, 1), 0, 0.25, 0);
    assertColor(at(&aovs, AOV_TRANSMISSION, 1, 1), 0.5, 0, 0);
    freeAovPictures(&aovs);

    /* The fog between dims both. */
    scene.fog.distance = 2;
    scene.fog.color = createColor(0, 0, 0);
    aovs = drawAovs(&scene, ALL_AOVS, 1);
    assertColor(at(&aovs, AOV_REFLECTION, 1, 1), 0, 0.25 * exp(-1) * exp(-4.5), 0);
    assertColor(at(&aovs, AOV_TRANSMISSION, 1, 1), 0.5 * exp(-1) * exp(-2.5), 0, 0);
    freeAovPictures(&aovs);

    /* A ray past max_depth brings nothing. */
    scene.render.maxDepth = 1;
    aovs = drawAovs(&scene, ALL_AOVS, 1);
    assertColor(at(&aovs, AOV_REFLECTION, 1, 1), 0, 0, 0);
    freeAovPictures(&aovs);
    freeScene(&scene);
}

/* From inside glass, at a steep angle: all of the light comes along the mirrored ray, and is counted there.
 */
static void testTotalReflection(void **state)
{
    (void)state;
    Scene scene =
        load("image: {width: 3, height: 3}\n"
             "camera: {position: [0, 0, 0], direction: [1, 0, -0.2], fov: 1}\n"
             "background: 0.5\n"
             "objects:\n"
             "  - box: {min: [-99, -99, -1], max: [99, 99, 1],\n"
             "          material: {diffuse: 0, transmission: 0.75, ior: 1.5, reflection: 0.125}}\n");
    scene.render.maxDepth = 2;
    scene.objects[0].material.emission = createColor(1, 0, 0);
    AovPictures aovs = drawAovs(&scene, ALL_AOVS, 1);
    /* Whole, not times its transmission or its reflection. */
    assertColor(at(&aovs, AOV_REFLECTION, 1, 1), 1, 0, 0);
    assertColor(at(&aovs, AOV_TRANSMISSION, 1, 1), 0, 0, 0);
    freeAovPictures(&aovs);
    freeScene(&scene);
}

static void testNothingThere(void **state)
{
    (void)state;
    Scene scene = createScene();
    scene.image.width = 2;
    scene.image.height = 1;
    AovPictures aovs = drawAovs(&scene, ALL_AOVS, 1);
    assert_true(isnan(aovs.farthest));
    assertColor(at(&aovs, AOV_DEPTH, 1, 0), 1, 1, 1);
    assertColor(at(&aovs, AOV_ID, 1, 0), 0, 0, 0);
    assertColor(at(&aovs, AOV_SHADOW, 1, 0), 1, 1, 1);
    freeAovPictures(&aovs);
    freeScene(&scene);
}

static void testNames(void **state)
{
    (void)state;
    for (Aov aov = 0; aov < AOV_COUNT; aov++) {
        Term term;
        if (aovIsTerm(aov, &term))
            assert_string_equal(aovName(aov), termName(term));
    }
    assert_string_equal(aovName(AOV_NORMAL), "normal");
    assert_string_equal(aovName(AOV_SHADOW), "shadow");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(testSphereAhead),         cmocka_unit_test(testId),
        cmocka_unit_test(testIdColorsAreDistinct), cmocka_unit_test(testShadow),
        cmocka_unit_test(testRaysOnward),          cmocka_unit_test(testTotalReflection),
        cmocka_unit_test(testNothingThere),        cmocka_unit_test(testNames),
    };
    return cmocka_run_group_tests_name("aov", tests, NULL, NULL);
}
