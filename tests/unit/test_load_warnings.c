/* Warnings: each is given where it is certain, at its place, and not for the fine scene next to it. What
 * the loader says comes out black is rendered, and it does.
 */
#include "scene/load.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define LIGHT "lights: [{point: {position: [0, 5, 0], color: 30}}]\n"
#define SPHERE "objects: [{sphere: {center: [0, 0, -5], radius: 1}}]\n"

/* Whether all of the picture, small, is black; pixels without an object show the background, black too. */
static bool isBlack(Scene *scene)
{
    Framebuffer *framebuffer = createFramebuffer(24, 18);
    assert_non_null(framebuffer);
    RenderOptions options = {.threads = 1};
    Status status = renderReference(scene, framebuffer, &options, NULL);
    assert_true(statusIsOk(&status));
    bool black = true;
    for (int i = 0; i < 24 * 18; i++)
        black = black && colorIsBlack(framebuffer->pixels[i]);
    freeFramebuffer(framebuffer);
    return black;
}

/* Load a scene without errors; with message NULL there is no warning, else one, at that place. */
static void assertWarning(const char *yaml, int line, int column, const char *message, bool black)
{
    Scene scene;
    Diagnostics d = {0};
    Status status = loadSceneFromText(yaml, strlen(yaml), &scene, &d);
    if (!statusIsOk(&status))
        fail_msg("%s in:\n%s", status.message, yaml);
    assert_int_equal(d.errors, 0);
    if (d.warnings != (message != NULL))
        fail_msg("%zu warnings, the first '%s', for:\n%s", d.warnings, d.count > 0 ? d.items[0].message : "",
                 yaml);
    if (message != NULL) {
        assert_int_equal(d.items[0].severity, SEVERITY_WARNING);
        assert_string_equal(d.items[0].message, message);
        assert_int_equal(d.items[0].line, line);
        assert_int_equal(d.items[0].column, column);
        Text text = {0};
        diagnosticsPrint(&d, "w.yaml", false, &text);
        assert_non_null(strstr(textString(&text), ": warning: "));
        textFree(&text);
    }
    if (isBlack(&scene) != black)
        fail_msg("the picture is %sblack for:\n%s", black ? "not " : "", yaml);
    diagnosticsFree(&d);
    freeScene(&scene);
}

static void fineScenesGiveNone(void **state)
{
    (void)state;
    assertWarning(LIGHT SPHERE, 0, 0, NULL, false);
    /* The simple model needs no light. */
    assertWarning("render: {model: simple}\n" SPHERE, 0, 0, NULL, false);
    /* A room: camera and light are inside the box. */
    assertWarning(
        "lights: [{point: {position: [0, 1, 0], color: 3}}]\n"
        "objects: [{box: {min: [-5, -5, -5], max: [5, 5, 5]}}, {sphere: {center: [0, 0, -3], radius: 1}}]\n",
        0, 0, NULL, false);
    /* A room whose lamp lies on the ceiling, in the middle, on an edge and in a corner. */
    assertWarning("lights: [{point: {position: [0, 5, 0], color: 30}}]\n"
                  "objects: [{cube: {center: [0, 0, 0], size: 10}}]\n",
                  0, 0, NULL, false);
    assertWarning("lights: [{point: {position: [0, 5, 5], color: 30}}]\n"
                  "objects: [{cube: {center: [0, 0, 0], size: 10}}]\n",
                  0, 0, NULL, false);
    assertWarning("lights: [{point: {position: [5, 5, 5], color: 30}}]\n"
                  "objects: [{cube: {center: [0, 0, 0], size: 10}}]\n",
                  0, 0, NULL, false);
    /* A camera on the surface of a sphere, looking outwards. */
    assertWarning(
        "camera: {position: [0, 0, 1], direction: [0, 0, 1]}\n"
        "lights: [{point: {position: [0, 3, 3], color: 30}}]\n"
        "objects: [{sphere: {center: [0, 0, 0], radius: 1}}, {sphere: {center: [0, 0, 5], radius: 1}}]\n",
        0, 0, NULL, false);
    /* A wall behind the camera, which the light stands before. */
    assertWarning(LIGHT "objects: [{plane: {point: [0, 0, 20], normal: [0, 0, 1]}}, {sphere: {center: [0, 0, "
                        "-5], radius: 1}}]\n",
                  0, 0, NULL, false);
    /* Something behind the camera, something before it. */
    assertWarning(
        LIGHT
        "objects: [{sphere: {center: [0, 0, 5], radius: 1}}, {sphere: {center: [0, 0, -5], radius: 1}}]\n",
        0, 0, NULL, false);
    /* Only just before it. */
    assertWarning(LIGHT "objects: [{sphere: {center: [0, 0, 5], radius: 5.001}}]\nrender: {shadows: false}\n",
                  0, 0, NULL, false);
    /* A floor is seen whatever the camera's direction is said to be. */
    assertWarning(LIGHT "objects: [{plane: {point: [0, -1, 0], normal: [0, 1, 0]}}]\n", 0, 0, NULL, false);
    /* One of two lights shines. */
    assertWarning("lights: [{point: {position: [0, 5, 0], color: 0}}, {point: {position: [0, 5, 0], color: "
                  "9}}]\n" SPHERE,
                  0, 0, NULL, false);
}

/* What shines by itself, lets something else be seen or lies in fog needs no light. */
static void notAllLightComesFromLights(void **state)
{
    (void)state;
#define WITH(material)                                                                                       \
    "objects: [{sphere: {center: [0, 0, -5], radius: 1, material: {" material "}}}, {sphere: {center: [1, "  \
    "0, -5], radius: 1}}]\n"
    assertWarning(WITH("emission: 0.5"), 0, 0, NULL, false);
    assertWarning("render: {ambient: 0.5}\n" WITH("ambient: 0.5"), 0, 0, NULL, false);
    assertWarning("background: 1\n" WITH("reflection: 0.5"), 0, 0, NULL, false);
    assertWarning("background: 1\n" WITH("transmission: 0.5"), 0, 0, NULL, false);
    assertWarning(WITH("model: simple"), 0, 0, NULL, false);
    assertWarning("fog: {color: 0.5, distance: 10}\n" SPHERE, 0, 0, NULL, false);
    assertWarning("lights: [{point: {position: [0, 5, 0], color: 0}}]\n" WITH("model: simple"), 0, 0, NULL,
                  false);
    assertWarning(
        "objects: [{union: {objects: [{cube: {center: [0, 0, -5], size: 1, material: {emission: 1}}}]}}]\n",
        0, 0, NULL, false);
    /* What the terms are multiplied by is black. */
    const char *message = "there is no light: every object comes out black";
    assertWarning(WITH("ambient: 0.5"), 1, 1, message, true);
    assertWarning("render: {ambient: [1, 0, 0]}\n" WITH("ambient: [0, 1, 0]"), 1, 1, message, true);
    assertWarning("fog: {color: 0, distance: 10}\n" SPHERE, 1, 1, message, true);
    assertWarning("render: {model: simple}\n" WITH("model: lambert"), 0, 0, NULL, false);
    assertWarning("objects: [{union: {objects: [{cube: {center: [0, 0, -5], size: 1}}]}}]\n", 1, 1, message,
                  true);
}

/* Lights that are no points, cameras without one, objects that light goes through. */
static void otherLightsAndCamerasAreLeftAlone(void **state)
{
    (void)state;
#define ROOM "objects: [{sphere: {center: [0, 0, 0], radius: 2}}]\n"
    assertWarning(
        "camera: {projection: orthographic, view_height: 9, position: [0, 0, 0]}\n"
        "lights: [{point: {position: [0, 9, -9], color: 300}}]\n"
        "objects: [{sphere: {center: [0, 0, 0], radius: 2}}, {cube: {center: [0, 0, -9], size: 20}}]\n",
        0, 0, NULL, false);
    assertWarning("lights: [{directional: {direction: [0, -1, 0], color: 1}}]\n" ROOM, 0, 0, NULL, true);
    assertWarning(
        "lights: [{area: {center: [0, 5, 0], edge_u: [9, 0, 0], edge_v: [0, 9, 0], samples: [3, 3], "
        "color: 30}}]\n" ROOM,
        0, 0, NULL, false);
    /* A spot light is a point. */
    assertWarning(
        "lights: [{spot: {position: [0, 5, 0], look_at: [0, 0, 0], color: 30, inner_angle: 20, "
        "outer_angle: 30}}]\n" ROOM,
        1, 1,
        "the camera is inside the sphere of line 2 and every light is outside: all surfaces it sees "
        "are black",
        true);
    assertWarning(LIGHT "objects: [{sphere: {center: [0, 0, 0], radius: 2, casts_shadow: false}}]\n", 0, 0,
                  NULL, false);
    assertWarning(LIGHT
                  "objects: [{sphere: {center: [0, 0, 0], radius: 2, material: {transmission: 0.5}}}]\n",
                  0, 0, NULL, false);
    assertWarning(LIGHT "objects: [{sphere: {center: [0, 0, 0], radius: 2}}, {sphere: {center: [0, 0, 0], "
                        "radius: 1, material: {emission: 1}}}]\n",
                  0, 0, NULL, false);
    assertWarning("lights: [{point: {position: [0, 0, -5], color: 30}}]\n"
                  "objects: [{sphere: {center: [0, 0, -5], radius: 1, material: {transmission: 0.5}}}, "
                  "{plane: {point: [0, -2, 0], normal: [0, 1, 0]}}]\n",
                  0, 0, NULL, false);
    /* A bulb of which a part is transparent. */
    assertWarning(
        "lights: [{point: {position: [0, 0, -5], color: 30}}]\n"
        "objects: [{union: {objects: [{sphere: {center: [0, 0, -5], radius: 1}}, {sphere: {center: [0, -1, "
        "-5], radius: 1, material: {transmission: 1}}}]}}, {plane: {point: [0, -2, 0], normal: [0, 1, "
        "0]}}]\n",
        0, 0, NULL, false);
}

/* Objects are where their transforms put them. */
static void transformsCount(void **state)
{
    (void)state;
    const char *behind = "the camera looks away: every object is behind it";
    assertWarning(LIGHT "objects: [{sphere: {center: [0, 0, 5], radius: 1, transform: [translate: [0, 0, "
                        "-10]]}}]\n",
                  0, 0, NULL, false);
    assertWarning(LIGHT
                  "objects: [{sphere: {center: [0, 0, -5], radius: 1, transform: [rotate: {axis: [0, 1, "
                  "0], angle: 180}]}}]\n",
                  1, 1, behind, true);
    assertWarning(LIGHT "objects: [{group: {transform: [scale: [1, 1, -1]], objects: [{union: {objects: "
                        "[{cube: {center: [0, 0, -5], size: 1}}]}}]}}]\n",
                  1, 1, behind, true);
    assertWarning(
        "camera: {projection: orthographic, view_height: 3}\n" LIGHT
        "objects: [{torus: {major_radius: 2, minor_radius: 1, transform: [translate: [0, 0, 4]]}}]\n",
        1, 1, behind, true);
    assertWarning(
        LIGHT "objects: [{sphere: {center: [5, 5, 5], radius: 1, transform: [translate: [-5, -5, "
              "-5], scale: 2]}}]\n",
        1, 1,
        "the camera is inside the sphere of line 2 and every light is outside: all surfaces it sees "
        "are black",
        true);
    assertWarning("lights: [{point: {position: [0, 0, -5], color: 30}}]\n"
                  "objects: [{difference: {objects: [{cube: {center: [0, 0, -5], size: 2}}, {cube: {center: "
                  "[9, 0, -5], "
                  "size: 2}}]}}]\n",
                  1, 11, "this light is inside the solid of line 2 and lights nothing that the camera sees",
                  true);
    /* In the hollow of one, with a window, it lights something. */
    assertWarning(
        "lights: [{point: {position: [0, 0, -5], color: 30}}]\n"
        "objects: [{difference: {objects: [{cube: {center: [0, 0, -5], size: 2}}, {box: {min: [-0.9, -0.9, "
        "-5.9], max: [0.9, 0.9, 0]}}]}}]\n",
        0, 0, NULL, false);
}

static void noObject(void **state)
{
    (void)state;
    const char *message = "there is no object: the picture shows only the background";
    assertWarning("image: {width: 5}\n", 1, 1, message, true);
    assertWarning("# empty\n" LIGHT "objects: []\n", 3, 1, message, true);
    assertWarning("fog: {color: 0.5, distance: 10}\n", 1, 1,
                  "there is no object: the picture shows only the fog", false);
}

static void noLight(void **state)
{
    (void)state;
    const char *message = "there is no light: every object comes out black";
    assertWarning(SPHERE, 1, 1, message, true);
    assertWarning("render: {model: lambert, shadows: false}\nlights: []\n" SPHERE, 2, 1, message, true);
    assertWarning("lights: [{point: {position: [0, 5, 0], color: 0}}]\n" SPHERE, 1, 1,
                  "every light is black: every object comes out black", true);
}

static void everythingBehindTheCamera(void **state)
{
    (void)state;
    const char *message = "the camera looks away: every object is behind it";
    assertWarning(LIGHT "objects: [{sphere: {center: [0, 0, 5], radius: 1}}]\n", 1, 1, message, true);
    assertWarning(LIGHT "camera: {position: [0, 0, 5], look_at: [0, 0, 9]}\n" SPHERE, 2, 40, message, true);
    assertWarning(
        LIGHT "camera: {position: [0, 0, 5], direction: [1, 1, 9]}\n"
              "objects: [{cube: {center: [0, 0, 0], size: 1}}, {box: {min: [0, 0, 0], max: [1, 1, 1]}}]\n",
        2, 42, message, true);
}

static void cameraInside(void **state)
{
    (void)state;
    assertWarning(
        LIGHT
        "objects: [{sphere: {center: [0, 0, -5], radius: 1}}, {sphere: {center: [0, 0, 0], radius: 2}}]\n",
        1, 1,
        "the camera is inside the sphere of line 2 and every light is outside: all surfaces it sees are "
        "black",
        true);
    assertWarning(
        "camera: {position: [0, 0.5, 0]}\n" LIGHT "objects:\n  - cube: {center: [0, 0, 0], size: 2}\n", 1, 20,
        "the camera is inside the cube of line 4 and every light is outside: all surfaces it sees are black",
        true);
    assertWarning(LIGHT "objects: [{cylinder: {base: [0, -1, 0], top: [0, 1, 0], radius: 2}}]\n", 1, 1,
                  "the camera is inside the cylinder of line 2 and every light is outside: all surfaces it "
                  "sees are black",
                  true);
    assertWarning(LIGHT "objects: [{cylinder: {base: [0, -1, 0], top: [0, 1, 0], radius: 2, open: true}}]\n",
                  0, 0, NULL, false);
    /* Without shadows light comes in. */
    assertWarning("render: {shadows: false}\n" LIGHT "objects: [{sphere: {center: [0, 0, 0], radius: 2}}]\n",
                  0, 0, NULL, false);
    /* Without a light the simple model shows the inside. */
    assertWarning("render: {model: simple}\nobjects: [{sphere: {center: [0, 0, 0], radius: 2}}]\n", 0, 0,
                  NULL, false);
    /* Below the floor. */
    assertWarning(
        "camera: {position: [0, -2, 0], direction: [0, 1, -1]}\n" LIGHT
        "objects: [{plane: {point: [0, -1, 0], normal: [0, 1, 0]}}]\n",
        1, 20,
        "the camera is behind the plane of line 3 and every light is outside: all surfaces it sees are black",
        true);
}

static void lightInside(void **state)
{
    (void)state;
    assertWarning("lights: [{point: {position: [0, 0, -5], color: 30}}]\n" SPHERE, 1, 11,
                  "this light is inside the sphere of line 2 and lights nothing that the camera sees", true);
    assertWarning("lights:\n  - point: {position: [0, 5, 0], color: 30}\n  - point: {position: [0, 0, -5], "
                  "color: 30}\n" SPHERE,
                  3, 5, "this light is inside the sphere of line 4 and lights nothing that the camera sees",
                  false);
    /* Without shadows it lights what is outside. */
    assertWarning(
        "render: {shadows: false}\nlights: [{point: {position: [0, 0, -9], color: 30}}]\n"
        "objects: [{sphere: {center: [0, 0, -9], radius: 1}}, {cube: {center: [0, 0, -19], size: 5}}]\n",
        0, 0, NULL, false);
}

/* A file with errors is not warned about besides: the warnings may come from the errors. */
static void errorsSilenceWarnings(void **state)
{
    (void)state;
    const char *yaml = "objects: [{spher: {}}]\n";
    Scene scene;
    Diagnostics d = {0};
    loadSceneFromText(yaml, strlen(yaml), &scene, &d);
    assert_int_equal(d.errors, 1);
    assert_int_equal(d.warnings, 0);
    diagnosticsFree(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fineScenesGiveNone),
        cmocka_unit_test(notAllLightComesFromLights),
        cmocka_unit_test(otherLightsAndCamerasAreLeftAlone),
        cmocka_unit_test(transformsCount),
        cmocka_unit_test(noObject),
        cmocka_unit_test(noLight),
        cmocka_unit_test(everythingBehindTheCamera),
        cmocka_unit_test(cameraInside),
        cmocka_unit_test(lightInside),
        cmocka_unit_test(errorsSilenceWarnings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
