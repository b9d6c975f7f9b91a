/* test_terms.c - a picture is the sum of its terms, on every scene there is, and each term is what it says.
 */
#include "engine/engine.h"
#include "explain/scene_variant.h"
#include "explain/terms.h"
#include "loaded_scene.h"
#include "one_pixel.h"

#include <float.h>
#include <glob.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

enum {
    WIDTH = 80 /* of the pictures that are added up */
};

static Framebuffer *draw(const Scene *scene)
{
    Framebuffer *framebuffer = createFramebuffer(scene->image.width, scene->image.height);
    assert_non_null(framebuffer);
    CompiledScene *compiled;
    Status status = compileScene(scene, 2, &compiled);
    assert_true(statusIsOk(&status));
    RenderOptions options = {.threads = 2};
    status = renderCompiled(compiled, framebuffer, &options, NULL);
    assert_true(statusIsOk(&status));
    freeCompiledScene(compiled);
    return framebuffer;
}

/* How far the sum of the terms is from the picture, in units of the rounding of its largest float. A term
 * without a source must be black. */
static double sumError(const Scene *scene)
{
    Framebuffer *whole = draw(scene), *sum = createFramebuffer(whole->width, whole->height);
    assert_non_null(sum);
    size_t samples = 3 * (size_t)whole->width * (size_t)whole->height;
    float *sums = &sum->pixels[0].r;
    const float *wanted = &whole->pixels[0].r;
    for (Term term = 0; term < TERM_COUNT; term++) {
        Scene variant;
        Status status = createTermScene(scene, term, &variant);
        assert_true(statusIsOk(&status));
        Framebuffer *part = draw(&variant);
        for (size_t i = 0; i < samples; i++) {
            float value = (&part->pixels[0].r)[i];
            assert_true(value >= 0);
            assert_true(value == 0 || sceneHasTerm(scene, term));
            sums[i] += value;
        }
        freeFramebuffer(part);
        freeSceneVariant(&variant);
    }
    double worst = 0;
    for (size_t i = 0; i < samples; i++)
        worst = fmax(worst, fabs((double)sums[i] - (double)wanted[i]) / fmax((double)wanted[i], 1e-3));
    freeFramebuffer(whole);
    freeFramebuffer(sum);
    return worst / (double)FLT_EPSILON;
}

/* A few roundings in each of the surfaces that a ray meets, and in each of the terms. */
static const double MOST_ROUNDINGS = 16;

static void testSumIsThePicture(void **state)
{
    (void)state;
    static const char *const patterns[] = {"scenes/course/*.yaml", "scenes/gallery/*.yaml",
                                           "scenes/regress/*.yaml"};
    size_t count = 0;
    for (size_t p = 0; p < sizeof patterns / sizeof *patterns; p++) {
        glob_t found;
        assert_int_equal(glob(patterns[p], 0, NULL, &found), 0);
        for (size_t i = 0; i < found.gl_pathc; i++) {
            Scene scene;
            Diagnostics diagnostics = {0};
            Status status = loadScene(found.gl_pathv[i], &scene, &diagnostics);
            diagnosticsFree(&diagnostics);
            assert_true(statusIsOk(&status));
            scene.image.height = (scene.image.height * WIDTH + scene.image.width - 1) / scene.image.width;
            scene.image.width = WIDTH;
            double error = sumError(&scene);
            if (!(error <= MOST_ROUNDINGS))
                fail_msg("%s: the terms add up to something else, by %g roundings", found.gl_pathv[i], error);
            freeScene(&scene);
            count++;
        }
        globfree(&found);
    }
    assert_true(count > 50);
}

/* A scene with all terms, a sphere ahead and nothing beside it. */
static const char ALL_TERMS[] =
    "render: {ambient: 0.5}\n"
    "background: [0, 0, 0.25]\n"
    "lights:\n"
    "  - directional: {direction: [0, 0, -1], color: 2}\n"
    "objects:\n"
    "  - sphere: {center: [0, 0, -5], radius: 1, material: {diffuse: [0.5, 0.25, 0], specular: 0.125,\n"
    "             shininess: 10, ambient: [0, 0.5, 0], emission: [0, 0, 0.75]}}\n";

static Color3f termAt(const Scene *scene, Term term, double x)
{
    Scene variant;
    Status status = createTermScene(scene, term, &variant);
    assert_true(statusIsOk(&status));
    Color3f color = colorAlong(&variant, createVector(0, 0, 0), createVector(x, 0, -1));
    freeSceneVariant(&variant);
    return color;
}

/* Light, normal and eye are in one line, so every cosine is 1. */
static void testEachTerm(void **state)
{
    (void)state;
    Scene scene = load(ALL_TERMS);
    assertColorNear(termAt(&scene, TERM_AMBIENT, 0), 0, 0.25, 0);
    assertColorNear(termAt(&scene, TERM_EMISSION, 0), 0, 0, 0.75);
    assertColorNear(termAt(&scene, TERM_DIFFUSE, 0), 1, 0.5, 0);
    assertColorNear(termAt(&scene, TERM_SPECULAR, 0), 0.25, 0.25, 0.25);
    assertColorNear(termAt(&scene, TERM_BACKGROUND, 0), 0, 0, 0);
    for (Term term = 0; term < TERM_COUNT; term++) {
        assertColorNear(termAt(&scene, term, 1), 0, 0, term == TERM_BACKGROUND ? 0.25 : 0);
        assert_true(sceneHasTerm(&scene, term));
    }
    freeScene(&scene);
}

static bool hasTerm(const char *yaml, Term term)
{
    Scene scene = load(yaml);
    bool has = sceneHasTerm(&scene, term);
    freeScene(&scene);
    return has;
}

#define LIT "lights: [{point: {position: [0, 5, 0], color: 9}}]\n"
#define SPHERE(material) "objects: [{sphere: {center: [0, 0, -5], radius: 1, material: {" material "}}}]\n"

static void testWhichTermsThereAre(void **state)
{
    (void)state;
    /* A term needs its colour in a material, and what that is multiplied by. */
    assert_true(hasTerm(LIT SPHERE("diffuse: 1"), TERM_DIFFUSE));
    assert_false(hasTerm(SPHERE("diffuse: 1"), TERM_DIFFUSE));
    assert_false(
        hasTerm("lights: [{point: {position: [0, 5, 0], color: 0}}]\n" SPHERE("diffuse: 1"), TERM_DIFFUSE));
    assert_false(hasTerm(LIT SPHERE("diffuse: 0, specular: 1"), TERM_DIFFUSE));
    assert_true(hasTerm(LIT SPHERE("diffuse: 0, pattern: {checker: {colors: [0, 1]}}"), TERM_DIFFUSE));
    assert_true(hasTerm(LIT SPHERE("specular: 1"), TERM_SPECULAR));
    assert_false(hasTerm(SPHERE("specular: 1"), TERM_SPECULAR));
    assert_false(hasTerm(LIT SPHERE("specular: 1, model: lambert"), TERM_SPECULAR));
    assert_true(hasTerm("render: {ambient: 1}\n" SPHERE("ambient: 1"), TERM_AMBIENT));
    assert_false(hasTerm("render: {ambient: [1, 0, 0]}\n" SPHERE("ambient: [0, 1, 0]"), TERM_AMBIENT));
    assert_true(hasTerm(SPHERE("emission: 1"), TERM_EMISSION));
    assert_false(hasTerm(SPHERE("diffuse: 1"), TERM_BACKGROUND));
    assert_true(hasTerm("background: 0.5\n" SPHERE("diffuse: 1"), TERM_BACKGROUND));
    assert_true(hasTerm("fog: {color: 0.5, distance: 9}\n" SPHERE("diffuse: 1"), TERM_BACKGROUND));

    /* The simple model has but one, whether lit or not. */
    static const char simple[] =
        "render: {model: simple, ambient: 1}\n" SPHERE("diffuse: 1, ambient: 1, emission: 1");
    assert_true(hasTerm(simple, TERM_DIFFUSE));
    assert_false(hasTerm(simple, TERM_AMBIENT));
    assert_false(hasTerm(simple, TERM_EMISSION));
}

/* Fog dims each term; its colour is the background's. */
static void testFog(void **state)
{
    (void)state;
    Scene scene =
        load("fog: {color: [0, 1, 0], distance: 4}\n"
             "objects: [{sphere: {center: [0, 0, -5], radius: 1, material: {emission: [1, 0, 0]}}}]\n");
    assertColorNear(termAt(&scene, TERM_EMISSION, 0), exp(-1), 0, 0);
    assertColorNear(termAt(&scene, TERM_BACKGROUND, 0), 0, 1 - exp(-1), 0);
    assertColorNear(termAt(&scene, TERM_BACKGROUND, 1), 0, 1, 0);
    freeScene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(testSumIsThePicture),
        cmocka_unit_test(testEachTerm),
        cmocka_unit_test(testWhichTermsThereAre),
        cmocka_unit_test(testFog),
    };
    return cmocka_run_group_tests_name("terms", tests, NULL, NULL);
}
