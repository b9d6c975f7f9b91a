/* Valid scenes: every construct of the format gives the values it says, the defaults of the table are
 * those of createScene(), and a file builds what a program would build.
 */
#include "base/cancel.h"
#include "base/files.h"
#include "loaded_scene.h"
#include "scene/load.h"

#include <float.h>
#include <locale.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#if defined(__SANITIZE_ADDRESS__)
#define SANITIZED 1
#elif defined(__has_feature)
#define SANITIZED __has_feature(address_sanitizer)
#else
#define SANITIZED 0
#endif

/* A number written as the radius of a sphere. */
static double loadNumber(const char *number)
{
    char yaml[400];
    snprintf(yaml, sizeof yaml, "objects: [{sphere: {center: [0, 0, %s], radius: 1}}]", number);
    Scene scene = load(yaml);
    double value = scene.objects[0].sphere.center.z;
    freeScene(&scene);
    return value;
}

static void assertColor(Color3f c, float r, float g, float b)
{
    assert_true(c.r == r && c.g == g && c.b == b);
}

static void assertSameSettings(const Scene *a, const Scene *b)
{
    assert_int_equal(a->image.width, b->image.width);
    assert_int_equal(a->image.height, b->image.height);
    assert_int_equal(a->image.bitDepth, b->image.bitDepth);
    assert_int_equal(a->image.encoding, b->image.encoding);
    assertVector(a->camera.position, b->camera.position.x, b->camera.position.y, b->camera.position.z);
    assertVector(a->camera.direction, b->camera.direction.x, b->camera.direction.y, b->camera.direction.z);
    assertVector(a->camera.up, b->camera.up.x, b->camera.up.y, b->camera.up.z);
    assert_true(a->camera.fov == b->camera.fov);
    assert_int_equal(a->render.model, b->render.model);
    assert_int_equal(a->render.shadows, b->render.shadows);
    assert_true(isnan(a->render.shadowBias) && isnan(b->render.shadowBias));
    assert_int_equal(a->camera.projection, b->camera.projection);
    assert_true(a->camera.viewHeight == b->camera.viewHeight);
    assert_int_equal(a->render.samples, b->render.samples);
    assert_int_equal(a->render.maxDepth, b->render.maxDepth);
    assertColor(a->render.ambient, b->render.ambient.r, b->render.ambient.g, b->render.ambient.b);
    assert_false(a->background.isGradient || b->background.isGradient);
    assert_true(a->fog.distance == 0 && b->fog.distance == 0);
    assertColor(a->background.bottom, b->background.bottom.r, b->background.bottom.g, b->background.bottom.b);
    assert_true(a->tolerance.fail == b->tolerance.fail);
    assert_true(a->tolerance.failPercent == b->tolerance.failPercent);
    assert_true(a->tolerance.hardFail == b->tolerance.hardFail);
    assert_true(isnan(a->tolerance.rmse) && isnan(b->tolerance.rmse));
    assert_true(isnan(a->tolerance.ssim) && isnan(b->tolerance.ssim));
    assert_true(isnan(a->tolerance.flip) && isnan(b->tolerance.flip));
}

/* The table's defaults, read through a section that is there but empty, are those of createScene(). */
static void defaultsAreThoseOfCreateScene(void **state)
{
    (void)state;
    Scene expected = createScene();
    Scene nothing = load("{}");
    assertSameSettings(&nothing, &expected);
    Scene empty =
        load("{image: {}, camera: {}, render: {}, materials: {}, lights: [], objects: [], compare: {}}");
    assertSameSettings(&empty, &expected);
    assert_int_equal(empty.lightCount, 0);
    assert_int_equal(empty.objectCount, 0);
}

static void assertMaterial(Material a, Material b)
{
    assertColor(a.diffuse, b.diffuse.r, b.diffuse.g, b.diffuse.b);
    assertColor(a.specular, b.specular.r, b.specular.g, b.specular.b);
    assert_true(a.shininess == b.shininess);
}

static void defaultMaterialIsTheSameEverywhere(void **state)
{
    (void)state;
    Scene scene = load("materials: {plain: {}}\n"
                       "objects:\n"
                       "  - sphere: {center: [0, 0, -5], radius: 1}\n"
                       "  - sphere: {center: [0, 0, -5], radius: 1, material: {}}\n"
                       "  - sphere: {center: [0, 0, -5], radius: 1, material: plain}\n"
                       "  - sphere: {center: [0, 0, -5], radius: 1, material: {specular: 0}}\n");
    assert_int_equal(scene.objectCount, 4);
    for (size_t i = 0; i < 4; i++)
        assertMaterial(scene.objects[i].material, defaultMaterial());
    freeScene(&scene);
}

static void everyKeyIsRead(void **state)
{
    (void)state;
    Scene scene =
        load("image: {width: 320, height: 200, bit_depth: 16, encoding: linear}\n"
             "camera: {position: [1, 2, 3], look_at: [1.5, 1, -4], up: [0, 0, 1], fov: 33.5}\n"
             "render: {model: lambert, shadows: false, shadow_bias: 0.25}\n"
             "background: [0.25, 0.5, 10]\n"
             "compare: {fail: 3.1e-5, fail_percent: 0, hard_fail: 0.5, rmse: 0.1, ssim: 0.9, flip: 0.2}\n"
             "lights:\n"
             "  - point: {position: [-3, 4, 5], color: [10, 20, 30], falloff: none}\n"
             "  - point: {position: [0, 0, 0], color: 2}\n"
             "objects:\n"
             "  - sphere: {center: [1, 2, 3], radius: 0.5}\n"
             "  - cube: {center: [4, 5, 6], size: 2}\n"
             "  - box: {min: [-1, -2, -3], max: [1, 2, 3]}\n"
             "  - plane: {point: [0, -1, 0], normal: [0, 2, 0]}\n");
    assert_int_equal(scene.image.width, 320);
    assert_int_equal(scene.image.height, 200);
    assert_int_equal(scene.image.bitDepth, 16);
    assert_int_equal(scene.image.encoding, ENCODING_LINEAR);
    assertVector(scene.camera.position, 1, 2, 3);
    assertVector(scene.camera.direction, 0.5, -1, -7); /* look_at - position */
    assertVector(scene.camera.up, 0, 0, 1);
    assert_true(scene.camera.fov == 33.5);
    assert_int_equal(scene.render.model, MODEL_LAMBERT);
    assert_false(scene.render.shadows);
    assert_true(scene.render.shadowBias == 0.25);
    assertColor(scene.background.bottom, 0.25F, 0.5F, 10);
    assert_true(scene.tolerance.fail == 3.1e-5 && scene.tolerance.failPercent == 0);
    assert_true(scene.tolerance.hardFail == 0.5 && scene.tolerance.rmse == 0.1);
    assert_true(scene.tolerance.ssim == 0.9 && scene.tolerance.flip == 0.2);
    assert_int_equal(scene.lightCount, 2);
    assertVector(scene.lights[0].position, -3, 4, 5);
    assertColor(scene.lights[0].color, 10, 20, 30);
    assert_int_equal(scene.lights[0].falloff, FALLOFF_NONE);
    assertColor(scene.lights[1].color, 2, 2, 2);
    assert_int_equal(scene.lights[1].falloff, FALLOFF_INVERSE_SQUARE);
    assert_int_equal(scene.objectCount, 4);
    assert_int_equal(scene.objects[0].kind, SHAPE_SPHERE);
    assertVector(scene.objects[0].sphere.center, 1, 2, 3);
    assert_true(scene.objects[0].sphere.radius == 0.5);
    assert_int_equal(scene.objects[0].line, 10);
    assert_int_equal(scene.objects[1].kind, SHAPE_CUBE);
    assertVector(scene.objects[1].cube.center, 4, 5, 6);
    assert_true(scene.objects[1].cube.size == 2);
    assert_int_equal(scene.objects[2].kind, SHAPE_BOX);
    assertVector(scene.objects[2].box.min, -1, -2, -3);
    assertVector(scene.objects[2].box.max, 1, 2, 3);
    assert_int_equal(scene.objects[3].kind, SHAPE_PLANE);
    assertVector(scene.objects[3].plane.point, 0, -1, 0);
    assertVector(scene.objects[3].plane.normal, 0, 1, 0); /* made a unit vector */
    assert_int_equal(scene.objects[3].line, 13);
    freeScene(&scene);
}

static void furtherSettingsAreRead(void **state)
{
    (void)state;
    Scene scene = load("camera: {projection: orthographic, view_height: 4.5}\n"
                       "render: {model: blinn_phong, samples: 3, max_depth: 9, ambient: [0.1, 0.2, 0.3]}\n"
                       "background: {gradient: {bottom: [1, 2, 3], top: 0.5}}\n"
                       "fog: {color: [0.25, 0.5, 0.75], distance: 12.5}\n");
    assert_int_equal(scene.camera.projection, PROJECTION_ORTHOGRAPHIC);
    assert_true(scene.camera.viewHeight == 4.5);
    assert_int_equal(scene.render.model, MODEL_BLINN_PHONG);
    assert_int_equal(scene.render.samples, 3);
    assert_int_equal(scene.render.maxDepth, 9);
    assertColor(scene.render.ambient, 0.1F, 0.2F, 0.3F);
    assert_true(scene.background.isGradient);
    assertColor(scene.background.bottom, 1, 2, 3);
    assertColor(scene.background.top, 0.5F, 0.5F, 0.5F);
    assertColor(scene.fog.color, 0.25F, 0.5F, 0.75F);
    assert_true(scene.fog.distance == 12.5);

    /* The order of the two does not matter, nor does a fov that then plays no part. */
    assert_true(loads("camera: {view_height: 1, fov: 30, projection: orthographic}"));
    assert_true(loads("camera: {projection: perspective, fov: 30}"));
}

static void everyLightIsRead(void **state)
{
    (void)state;
    Scene scene = load(
        "lights:\n"
        "  - directional: {direction: [0, -3, 4], color: [1, 2, 3]}\n"
        "  - spot: {position: [1, 2, 3], look_at: [1, 2, 8], color: 4, inner_angle: 10, outer_angle: 20.5,\n"
        "           tightness: 2.5, falloff: none}\n"
        "  - spot: {position: [1, 2, 3], look_at: [0, 2, 3], color: 4, inner_angle: 90, outer_angle: 90}\n"
        "  - area: {center: [1, 2, 3], edge_u: [4, 0, 0], edge_v: [0, 5, 6], samples: [3, 256], color: 7}\n"
        "  - area: {center: [1, 2, 3], edge_u: [4, 0, 0], edge_v: [0, 5, 6], samples: [1, 1], color: 7, "
        "falloff: none}\n"
        "  - point: {position: [1, 2, 3], color: 7}\n");
    const Light *l = scene.lights;
    static const LightKind kinds[] = {LIGHT_DIRECTIONAL, LIGHT_SPOT, LIGHT_SPOT,
                                      LIGHT_AREA,        LIGHT_AREA, LIGHT_POINT};
    static const Falloff falloffs[] = {FALLOFF_NONE,           FALLOFF_NONE, FALLOFF_INVERSE_SQUARE,
                                       FALLOFF_INVERSE_SQUARE, FALLOFF_NONE, FALLOFF_INVERSE_SQUARE};
    assert_int_equal(scene.lightCount, 6);
    for (size_t i = 0; i < 6; i++) {
        assert_int_equal(l[i].kind, kinds[i]);
        assert_int_equal(l[i].falloff, falloffs[i]);
    }
    assert_true(fabs(l[0].direction.y + 0.6) < 1e-15 && fabs(l[0].direction.z - 0.8) < 1e-15);
    assertColor(l[0].color, 1, 2, 3);
    assertVector(l[1].position, 1, 2, 3);
    assertVector(l[1].direction, 0, 0, 1);
    assertColor(l[1].color, 4, 4, 4);
    assert_true(l[1].innerAngle == 10 && l[1].outerAngle == 20.5 && l[1].tightness == 2.5);
    assertVector(l[2].direction, -1, 0, 0);
    assert_true(l[2].innerAngle == 90 && l[2].outerAngle == 90 && l[2].tightness == 0);
    assertVector(l[3].position, 1, 2, 3);
    assertVector(l[3].edgeU, 4, 0, 0);
    assertVector(l[3].edgeV, 0, 5, 6);
    assert_int_equal(l[3].countU, 3);
    assert_int_equal(l[3].countV, 256);
    assert_int_equal(lightSampleCount(&l[4]), 1);
    freeScene(&scene);
}

static void cameraLooksInADirection(void **state)
{
    (void)state;
    Scene scene = load("camera: {position: [1, 2, 3], direction: [0, -3, 4]}");
    assertVector(scene.camera.direction, 0, -3, 4);
    assertVector(scene.camera.position, 1, 2, 3);
    scene = load("camera: {direction: [0, -1, 0], up: [0, 0, -1]}");
    assertVector(scene.camera.direction, 0, -1, 0);
    assert_true(loads("camera: {look_at: [0, -1.0e-5, -1], up: [0, 1, 0]}"));
    /* Nearly parallel is not parallel. */
    assert_true(loads("camera: {direction: [0.001, 1, 0]}"));
    assert_true(loads("camera: {direction: [1.0e-300, 0, 0]}"));
}

static void materialsMayComeAfterTheirUse(void **state)
{
    (void)state;
    Scene scene =
        load("objects:\n"
             "  - sphere: {material: red, center: [0, 0, -5], radius: 1}\n"
             "  - cube: {center: [0, 0, -5], size: 1, material: 'green one'}\n"
             "  - sphere: {center: [0, 0, -5], radius: 1, material: {diffuse: [0, 0, 1], shininess: 7}}\n"
             "  - sphere: {center: [0, 0, -5], radius: 1, material: red}\n"
             "materials:\n"
             "  red: {diffuse: [1, 0, 0], specular: 0.5, shininess: 64}\n"
             "  green one: {diffuse: [0, 1, 0]}\n");
    assertMaterial(scene.objects[0].material,
                   createMaterial(createColor(1, 0, 0), createColor(0.5F, 0.5F, 0.5F), 64));
    assertMaterial(scene.objects[1].material, createMaterial(createColor(0, 1, 0), createColor(0, 0, 0), 32));
    assertMaterial(scene.objects[2].material, createMaterial(createColor(0, 0, 1), createColor(0, 0, 0), 7));
    assertMaterial(scene.objects[3].material, scene.objects[0].material);
    freeScene(&scene);
}

static void aliasesStandForWhatWasAnchored(void **state)
{
    (void)state;
    Scene scene = load("materials:\n"
                       "  a: &glaze {diffuse: &c [0.25, 0.5, 1], shininess: &n 3}\n"
                       "  b: {diffuse: *c, specular: *n, shininess: *n}\n"
                       "objects:\n"
                       "  - sphere: {center: &p [*n, 1, -5], radius: *n, material: *glaze}\n"
                       "  - sphere: {center: *p, radius: 2, material: b}\n"
                       "  - &third\n"
                       "    cube: {center: *p, size: 2, material: &m {diffuse: 0.125}}\n"
                       "  - *third\n"
                       "  - sphere: {center: [0, 0, -9], radius: 1, material: *m}\n");
    assert_int_equal(scene.objectCount, 5);
    assert_true(scene.objects[0].sphere.radius == 3);
    assertVector(scene.objects[0].sphere.center, 3, 1, -5);
    assertMaterial(scene.objects[0].material,
                   createMaterial(createColor(0.25F, 0.5F, 1), createColor(0, 0, 0), 3));
    assertVector(scene.objects[1].sphere.center, 3, 1, -5);
    assertMaterial(scene.objects[1].material,
                   createMaterial(createColor(0.25F, 0.5F, 1), createColor(3, 3, 3), 3));
    assert_int_equal(scene.objects[3].kind, SHAPE_CUBE);
    assertVector(scene.objects[3].cube.center, 3, 1, -5);
    assertColor(scene.objects[3].material.diffuse, 0.125F, 0.125F, 0.125F);
    assertColor(scene.objects[4].material.diffuse, 0.125F, 0.125F, 0.125F);
    freeScene(&scene);

    /* An anchored list of objects, used twice as a whole by way of the keys of a mapping. */
    scene = load("objects: &all [{sphere: {center: [0, 0, -5], radius: 1}}, {sphere: {center: [0, 0, -5], "
                 "radius: 2}}]");
    assert_int_equal(scene.objectCount, 2);
    assert_true(scene.objects[1].sphere.radius == 2);
    freeScene(&scene);
}

static void blockAndFlowStyleAreTheSame(void **state)
{
    (void)state;
    Scene scene = load("%YAML 1.2\n"
                       "---\n"
                       "objects:\n"
                       "- sphere:\n"
                       "    center:\n"
                       "      - 1\n"
                       "      - 2 # a comment\n"
                       "      - 3\n"
                       "    \"radius\": 4\n"
                       "    'material':\n"
                       "      diffuse: 1\n"
                       "\n"
                       "- ? sphere\n"
                       "  : {center: [\n"
                       "     1, 2,\n"
                       "   3], radius: 4, material: {diffuse: 1},}\n"
                       "...\n");
    assert_int_equal(scene.objectCount, 2);
    for (size_t i = 0; i < 2; i++) {
        assertVector(scene.objects[i].sphere.center, 1, 2, 3);
        assert_true(scene.objects[i].sphere.radius == 4);
        assertColor(scene.objects[i].material.diffuse, 1, 1, 1);
    }
    freeScene(&scene);
}

static void bytesOfTheFileDoNotMatter(void **state)
{
    (void)state;
    static const char bom[] = "\xEF\xBB\xBFimage: {width: 5}\n";
    static const char crlf[] = "image:\r\n  width: 5\r\n";
    static const char cr[] = "image:\r  width: 5\r";
    static const char noEnd[] = "image: {width: 5}";
    static const char latin1[] = "# \xC3\xA9 \xE9 x\nimage: {width: 5}\n";
    const char *const files[] = {
        bom, crlf, cr, noEnd, "image: {width: 0x5}", "image: {width: 0o5}", "image: {width: +5}"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        Scene scene = load(files[i]);
        assert_int_equal(scene.image.width, 5);
    }
    /* An e with an accent as Latin-1 has it is not UTF-8, not even in a comment. */
    assert_false(loads(latin1));
    assert_true(loads("# \xC3\xA9 \xE9\x87\x89 \xF0\x9F\x94\xB4 \xC2\x85\nimage: {width: 5}\n"));
}

/* YAML 1.2 core schema, section 10.3.2. */
static void numbersAreThoseOfYaml12(void **state)
{
    (void)state;
    assert_true(loadNumber("12") == 12);
    assert_true(loadNumber("-12") == -12);
    assert_true(loadNumber("+12") == 12);
    assert_true(loadNumber("017") == 17);
    assert_true(loadNumber("0o17") == 15);
    assert_true(loadNumber("0x1F") == 31);
    assert_true(loadNumber("0xffffffffffffffffffff") == 0x1p80);
    assert_true(loadNumber(".5") == 0.5);
    assert_true(loadNumber("-.5") == -0.5);
    assert_true(loadNumber("5.") == 5);
    assert_true(loadNumber("1e3") == 1000);
    assert_true(loadNumber("1E+3") == 1000);
    assert_true(loadNumber("12.5e-1") == 1.25);
    assert_true(loadNumber("0.1") == 0.1);
    assert_true(loadNumber("1.7976931348623157e308") == DBL_MAX);
    assert_true(loadNumber("4.9406564584124654e-324") == 0x1p-1074);
    assert_true(loadNumber("0.1000000000000000055511151231257827021181583404541015625") == 0.1);
    assert_true(loadNumber("12345678901234567890123") == 12345678901234567890123.0);

    static const char *const notNumbers[] = {
        "1_000", "1:30", "0b11",  "0x",     "0o8",   "0o",   "1e",      "e1",   ".",     "-",
        "+",     "--1",  "1-",    "1e+",    "nan",   "inf",  "NaN",     ".nan", ".inf",  "-.inf",
        ".Inf",  "1d",   "1f",    "1.5.",   "0x1p3", "0X1F", "1,5",     "'1'",  "\"1\"", "true",
        "null",  "~",    "1e999", "-1e999", "1 2",   "-0x1", "infinity"};
    for (size_t i = 0; i < sizeof notNumbers / sizeof *notNumbers; i++) {
        char yaml[200];
        snprintf(yaml, sizeof yaml, "camera: {fov: %s}", notNumbers[i]);
        if (loads(yaml))
            fail_msg("%s is taken for a number", notNumbers[i]);
    }
}

static void wordsAreThoseOfYaml12(void **state)
{
    (void)state;
    static const char *const words[] = {"true", "True", "TRUE"};
    for (size_t i = 0; i < 3; i++) {
        char yaml[80];
        snprintf(yaml, sizeof yaml, "render: {shadows: %s}", words[i]);
        Scene scene = load(yaml);
        assert_true(scene.render.shadows);
    }
    Scene scene = load("render: {shadows: FALSE}");
    assert_false(scene.render.shadows);
    static const char *const notTruths[] = {"yes",    "no",   "on", "off",  "1", "0",
                                            "'true'", "tRUE", "y",  "null", ""};
    for (size_t i = 0; i < sizeof notTruths / sizeof *notTruths; i++) {
        char yaml[80];
        snprintf(yaml, sizeof yaml, "render: {shadows: %s}", notTruths[i]);
        if (loads(yaml))
            fail_msg("%s is taken for a truth", notTruths[i]);
    }
    /* Words that other versions of YAML take for something else are names like any other. */
    assert_true(loads("materials: {yes: {}, no: {}, 1_0: {}}\n"
                      "objects: [{sphere: {center: [0, 0, -5], radius: 1, material: yes}},"
                      " {sphere: {center: [0, 0, -5], radius: 1, material: 1_0}}]"));
    assert_true(loads("materials: {true: {}, 5: {}}\n"
                      "objects: [{sphere: {center: [0, 0, -5], radius: 1, material: 'true'}},"
                      " {sphere: {center: [0, 0, -5], radius: 1, material: '5'}}]"));
}

static void limitsAreWhereTheFormatSaysTheyAre(void **state)
{
    (void)state;
    assert_true(loads("image: {width: 65535, height: 32768}")); /* 2^31 - 32768 */
    assert_false(loads("image: {width: 65535, height: 32769}"));
    assert_true(loads("image: {width: 1, height: 1}"));
    assert_false(loads("image: {width: 65536, height: 1}"));
    assert_false(loads("image: {width: 0}"));
    assert_false(loads("image: {width: 4294967297}"));
    assert_false(loads("image: {width: 5.0}"));
    assert_true(loads("camera: {fov: 179.999}"));
    assert_true(loads("camera: {fov: 1.0e-300}"));
    assert_false(loads("camera: {fov: 0}"));
    assert_false(loads("camera: {fov: -0.0}"));
    assert_true(loads("background: -0"));
    assert_true(loads("background: 3.4e38"));
    assert_false(loads("background: 3.5e38"));
    assert_true(loads("materials: {a: {shininess: 0}}"));
    assert_false(loads("materials: {a: {shininess: 1e39}}"));
    assert_true(loads("render: {shadow_bias: 0}"));
    assert_true(loads("compare: {fail: 1, fail_percent: 100, ssim: -1}"));
    assert_false(loads("compare: {fail: 1.01}"));
    assert_true(loads("render: {samples: 64, max_depth: 256}"));
    assert_true(loads("render: {samples: 1, max_depth: 1}"));
    assert_true(loads("materials: {a: {ior: 1.0e-38}}"));
    assert_false(loads("materials: {a: {ior: 1.0e-46}}")); /* 0 as a float */
    assert_true(loads("lights: [{spot: {position: [0, 0, 0], look_at: [0, 0, 1], color: 0, inner_angle: 0, "
                      "outer_angle: 0}}]"));
}

/* A file in a land of decimal commas is read the same. */
static void localeDoesNotMatter(void **state)
{
    (void)state;
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8",
                                        "fr_FR.utf8",  "de_DE",      "fr_FR"};
    const char *found = NULL;
    for (size_t i = 0; i < sizeof names / sizeof *names && found == NULL; i++)
        found = setlocale(LC_ALL, names[i]);

    /* Where none is installed, make one for this process. */
    char *folder = NULL;
    if (found == NULL) {
        Status status = makeTemporaryFolder(&folder);
        assert_true(statusIsOk(&status));
        char command[600];
        snprintf(command, sizeof command, "localedef -i de_DE -f UTF-8 '%s/de_DE.UTF-8' >/dev/null 2>&1",
                 folder);
        if (system(command) == 0) {
            setenv("LOCPATH", folder, 1);
            found = setlocale(LC_ALL, "de_DE.UTF-8");
            unsetenv("LOCPATH");
        }
        removeFolder(folder);
        free(folder);
    }
    if (found == NULL) {
        print_message("skipped: no locale with a decimal comma is installed\n");
        skip();
    }
    assert_string_equal(localeconv()->decimal_point, ",");
    double value = loadNumber("1.5");
    bool comma = loads("camera: {fov: 1,5}");
    Text schema = {0};
    writeSceneSchema(&schema);
    setlocale(LC_ALL, "C");
    assert_true(value == 1.5);
    assert_false(comma);
    assert_non_null(strstr(textString(&schema), "0.004"));
    textFree(&schema);
}

static void missingFileIsAnIoError(void **state)
{
    (void)state;
    Scene scene;
    Diagnostics diagnostics = {0};
    Status status = loadScene("tests/no such file.yaml", &scene, &diagnostics);
    assert_int_equal(status.code, STATUS_IO);
    assert_non_null(strstr(status.message, "no such file.yaml"));
    assert_int_equal(diagnostics.errors, 0);
    status = loadScene("tests", &scene, &diagnostics);
    assert_int_equal(status.code, STATUS_IO);
    diagnosticsFree(&diagnostics);
}

/* One sphere a line, as many as asked for. */
static char *manySpheres(size_t count, size_t *length)
{
    enum {
        LINE = 100
    };
    char *yaml = malloc(count * LINE + 200);
    assert_non_null(yaml);
    size_t used = (size_t)sprintf(yaml, "camera: {position: [0, 0, 9]}\nmaterials: {glaze: {diffuse: 0.5}}\n"
                                        "lights: [{point: {position: [0, 9, 9], color: 9}}]\nobjects:\n");
    for (size_t i = 0; i < count; i++)
        used += (size_t)sprintf(
            yaml + used, "  - sphere: {center: [%zu.25, 0.5, -5], radius: 0.125, material: glaze}\n", i);
    *length = used;
    return yaml;
}

/* As many spheres as rows of one object. */
static char *manyRows(size_t count, size_t *length)
{
    enum {
        LINE = 60
    };
    char *yaml = malloc(count * LINE + 200);
    assert_non_null(yaml);
    size_t used = (size_t)sprintf(yaml, "camera: {position: [0, 0, 9]}\nmaterials: {glaze: {diffuse: 0.5}}\n"
                                        "lights: [{point: {position: [0, 9, 9], color: 9}}]\nobjects:\n"
                                        "- spheres:\n    material: glaze\n    data:\n");
    for (size_t i = 0; i < count; i++)
        used += (size_t)sprintf(yaml + used, "      - [%zu.25, 0.5, -5, 0.125]\n", i);
    *length = used;
    return yaml;
}

static long peakKilobytes(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

enum {
    COUNT = 100000
};

/* Load so many spheres in a child process, so that its peak memory is its own, and free the text. */
static void assertLittleMemory(char *yaml, size_t length, long bytesEach)
{
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        long before = peakKilobytes();
        Scene scene;
        Diagnostics diagnostics = {0};
        Status status = loadSceneFromText(yaml, length, &scene, &diagnostics);
        long kilobytes = peakKilobytes() - before;
        bool right = statusIsOk(&status) && scene.objectCount == COUNT && diagnostics.warnings == 0 &&
                     scene.objects[COUNT - 1].sphere.center.x == COUNT - 1 + 0.25 &&
                     scene.objects[COUNT - 1].material.diffuse.r == 0.5F;
        /* Under a sanitizer freed memory is kept back, so only the values are checked. */
        bool tooMuch = !SANITIZED && kilobytes * 1024 > bytesEach * (long)COUNT;
        if (tooMuch)
            fprintf(stderr, "%ld bytes an object\n", kilobytes * 1024 / COUNT);
        freeScene(&scene);
        free(yaml);
        _exit(!right ? 1 : tooMuch ? 2 : 0);
    }
    int result;
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_true(WIFEXITED(result));
    assert_int_equal(WEXITSTATUS(result), 0);
    free(yaml);
}

/* Promised is less than 1 kB for an object. Reading item by item takes about BYTES; keeping the file's tree
 * would take some 700 more. */
static void hundredThousandObjectsTakeLittleMemory(void **state)
{
    (void)state;
    size_t length;
    char *yaml = manySpheres(COUNT, &length);
    assertLittleMemory(yaml, length, 700);
    yaml = manyRows(COUNT, &length);
    assertLittleMemory(yaml, length, 900);
}

static void diagnosticsOfTwoFilesAreAppended(void **state)
{
    (void)state;
    Scene scene;
    Diagnostics diagnostics = {0};
    loadSceneFromText("a: 1\nb: 1\n", 10, &scene, &diagnostics);
    loadSceneFromText("c: 1\n", 5, &scene, &diagnostics);
    loadSceneFromText("image: {}\n", 10, &scene, &diagnostics);
    assert_int_equal(diagnostics.errors, 3);
    assert_int_equal(diagnostics.warnings, 1);
    assert_int_equal(diagnostics.count, 4);
    assert_string_equal(diagnostics.items[1].message, "unknown key 'b'");
    assert_string_equal(diagnostics.items[2].message, "unknown key 'c'");
    diagnosticsFree(&diagnostics);
}

/* The flag is never cleared, so it is set in a child process. */
static void loadingStopsWhenCancelled(void **state)
{
    (void)state;
    size_t length;
    char *yaml = manySpheres(100, &length);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        requestCancel();
        Scene scene;
        Diagnostics diagnostics = {0};
        Status status = loadSceneFromText(yaml, length, &scene, &diagnostics);
        bool empty = scene.objects == NULL && scene.objectCount == 0;
        diagnosticsFree(&diagnostics);
        free(yaml);
        _exit(status.code == STATUS_INTERRUPTED && empty ? 0 : 1);
    }
    int result;
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_true(WIFEXITED(result) && WEXITSTATUS(result) == 0);
    free(yaml);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaultsAreThoseOfCreateScene),
        cmocka_unit_test(defaultMaterialIsTheSameEverywhere),
        cmocka_unit_test(everyKeyIsRead),
        cmocka_unit_test(furtherSettingsAreRead),
        cmocka_unit_test(everyLightIsRead),
        cmocka_unit_test(cameraLooksInADirection),
        cmocka_unit_test(materialsMayComeAfterTheirUse),
        cmocka_unit_test(aliasesStandForWhatWasAnchored),
        cmocka_unit_test(blockAndFlowStyleAreTheSame),
        cmocka_unit_test(bytesOfTheFileDoNotMatter),
        cmocka_unit_test(numbersAreThoseOfYaml12),
        cmocka_unit_test(wordsAreThoseOfYaml12),
        cmocka_unit_test(limitsAreWhereTheFormatSaysTheyAre),
        cmocka_unit_test(localeDoesNotMatter),
        cmocka_unit_test(missingFileIsAnIoError),
        cmocka_unit_test(hundredThousandObjectsTakeLittleMemory),
        cmocka_unit_test(diagnosticsOfTwoFilesAreAppended),
        cmocka_unit_test(loadingStopsWhenCancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
