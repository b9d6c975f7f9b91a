/* The fast engine against the course's tracer: the same picture to the last bit and the same counts of rays,
 * on each instruction set there is and with one thread and three. */
#include "both_engines.h"
#include "loaded_scene.h"
#include "random_shapes.h"
#include "shapes/mesh.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *paths[MOST_ENGINE_PATHS];
static size_t pathCount;

static void assertAgreementAt(const char *name, const Scene *scene, int width, int height)
{
    static const int threads[2] = {1, 3};
    char difference[DIFFERENCE_SIZE];
    if (!enginesAgree(scene, width, height, paths, pathCount, threads, difference))
        fail_msg("%s, %d x %d: %s", name, width, height, difference);
}

static void assertAgreement(const char *name, const Scene *scene)
{
    assertAgreementAt(name, scene, 70, 37);
}

static int findPaths(void **state)
{
    (void)state;
    pathCount = findEnginePaths(paths);
    return pathCount == 0;
}

/* ---- Scenes in the words of the format ---- */

typedef struct NamedScene {
    const char *name, *yaml;
} NamedScene;

static void assertAll(const NamedScene *scenes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        Scene scene = load(scenes[i].yaml);
        assertAgreement(scenes[i].name, &scene);
        freeScene(&scene);
    }
}

#define ASSERT_ALL(scenes) assertAll(scenes, sizeof(scenes) / sizeof *(scenes))

#define POINT_LIGHT "lights: [{point: {position: [-3, 4, 3], color: 30}}]\n"
#define SUN "lights: [{directional: {direction: [1, -2, -1], color: 0.8}}]\n"
#define FLOOR "  - plane: {point: [0, -1, 0], normal: [0, 1, 0], material: {diffuse: [0.2, 0.2, 0.5]}}\n"
#define RED "material: {diffuse: [1, 0, 0], specular: 0.5}"
#define GLASS "material: {diffuse: 0.1, transmission: [0.9, 0.8, 0.9], ior: 1.5, reflection: 0.1}"
#define MIRROR "material: {diffuse: 0.2, reflection: 0.7}"
#define THREE_SPHERES                                                                                        \
    "  - sphere: {center: [0, 0, -5], radius: 1, " RED "}\n"                                                 \
    "  - sphere: {center: [1.2, 0.3, -4], radius: 0.4, " MIRROR "}\n"                                        \
    "  - sphere: {center: [-1.2, -0.5, -4], radius: 0.5, " GLASS "}\n"
#define SOME_SHAPES                                                                                          \
    "  - cube: {center: [-1.5, 0, -5], size: 1, " RED "}\n"                                                  \
    "  - cone: {base: [0, -1, -4], top: [0, 0.5, -4], base_radius: 0.5, top_radius: 0}\n"                    \
    "  - disc: {center: [1, 1, -5], normal: [0, -1, 1], radius: 0.7, inner_radius: 0.2}\n"                   \
    "  - torus: {major_radius: 0.6, minor_radius: 0.2, transform: [rotate: {axis: [1, 0, 0], angle: 70}, "   \
    "translate: [1.4, -0.4, -4]], material: {diffuse: [0, 1, 0]}}\n"                                         \
    "  - triangle: {vertices: [[-3, -1, -6], [3, -1, -6], [0, 3, -7]], " MIRROR "}\n"

static void simpleScenes(void **state)
{
    (void)state;
    static const NamedScene scenes[] = {
        {"nothing", "background: [0.1, 0.2, 0.3]\n"},
        {"nothing but a light", POINT_LIGHT},
        {"a sphere without light", "objects:\n" THREE_SPHERES},
        {"a sphere", POINT_LIGHT "objects: [{sphere: {center: [0, 0, -5], radius: 1.5}}]\n"},
        {"spheres", POINT_LIGHT "objects:\n" THREE_SPHERES FLOOR},
        {"shapes", POINT_LIGHT "objects:\n" SOME_SHAPES FLOOR},
        {"everything in the sun", SUN "objects:\n" THREE_SPHERES SOME_SHAPES FLOOR},
    };
    ASSERT_ALL(scenes);
}

static void insideOfThings(void **state)
{
    (void)state;
    static const NamedScene scenes[] = {
        {"in a sphere", "lights: [{point: {position: [0.5, 0.5, -0.5], color: 1}}]\n"
                        "objects: [{sphere: {center: [0, 0, 0], radius: 2, " RED "}}]\n"},
        {"in a glass sphere",
         POINT_LIGHT "objects:\n" THREE_SPHERES "  - sphere: {center: [0, 0, 0], radius: 2, " GLASS "}\n"},
        {"in a box", "lights: [{point: {position: [0.5, 0.5, -0.5], color: 1}}]\n"
                     "objects: [{box: {min: [-1, -1, -3], max: [1, 2, 1], " MIRROR "}}]\n"},
        {"in a mesh", "lights: [{point: {position: [0.1, 0.1, 0], color: 1}}]\n"
                      "objects: [{mesh: {file: scenes/regress/star.obj, transform: [scale: 3], " RED "}}]\n"},
        {"in a glass mesh", POINT_LIGHT
         "objects:\n" THREE_SPHERES "  - mesh: {file: scenes/regress/star.obj, smooth: false, " GLASS "}\n"},
        {"the eye on a sphere",
         POINT_LIGHT "objects:\n" THREE_SPHERES "  - sphere: {center: [0, -2, 0], radius: 2, " MIRROR "}\n"},
        {"the eye in the middle of a sphere", "lights: [{point: {position: [0, 0, 0], color: 1}}]\nobjects: "
                                              "[{sphere: {center: [0, 0, 0], radius: 1}}]\n"},
    };
    ASSERT_ALL(scenes);
}

static void lightsInAndOnThings(void **state)
{
    (void)state;
    static const NamedScene scenes[] = {
        {"in a sphere",
         "lights: [{point: {position: [0, 0, -5], color: 30}}]\nobjects:\n" THREE_SPHERES FLOOR},
        {"on a sphere",
         "lights: [{point: {position: [0, 1, -5], color: 30}}]\nobjects:\n" THREE_SPHERES FLOOR},
        {"on the floor",
         "lights: [{point: {position: [0.3, -1, -3], color: 30}}]\nobjects:\n" THREE_SPHERES FLOOR},
        /* Of the 71 x 37 pixels the middle one looks along -z. */
        {"where the middle ray hits", "lights: [{point: {position: [0, 0, -4], color: 1}}]\n"
                                      "objects: [{sphere: {center: [0, 0, -5], radius: 1}}]\n"},
        {"in the eye", "lights: [{point: {position: [0, 0, 0], color: 30}}]\nobjects:\n" SOME_SHAPES FLOOR},
        {"far away", "lights: [{point: {position: [1e9, 2e9, 1e9], color: 1, falloff: none}}]\nobjects:\n"
                     "" THREE_SPHERES SOME_SHAPES FLOOR},
        {"next to a sphere",
         "lights: [{point: {position: [0, 1.0000001, -5], color: 1}}]\nobjects:\n" THREE_SPHERES FLOOR},
    };
    ASSERT_ALL(scenes);
    Scene scene = load(scenes[3].yaml);
    assertAgreementAt(scenes[3].name, &scene, 71, 37);
    freeScene(&scene);
}

static void tiesGoToTheFirst(void **state)
{
    (void)state;
#define BLUE "material: {diffuse: [0, 0, 1]}"
    static const NamedScene scenes[] = {
        {"equal spheres", POINT_LIGHT "objects:\n"
                                      "  - sphere: {center: [0, 0, -5], radius: 1, " RED "}\n"
                                      "  - sphere: {center: [0, 0, -5], radius: 1, " BLUE "}\n"},
        {"a sphere, then an equal one by its transform", POINT_LIGHT
         "objects:\n"
         "  - sphere: {center: [0, 0, -5], radius: 1, " RED "}\n"
         "  - sphere: {center: [0, 0, 0], radius: 1, transform: [translate: [0, 0, -5]], " BLUE "}\n"},
        {"the other way round", POINT_LIGHT
         "objects:\n"
         "  - sphere: {center: [0, 0, 0], radius: 1, transform: [translate: [0, 0, -5]], " BLUE "}\n"
         "  - sphere: {center: [0, 0, -5], radius: 1, " RED "}\n"},
        {"equal meshes", POINT_LIGHT
         "objects:\n"
         "  - mesh: {file: scenes/regress/star.obj, transform: [translate: [0, 0, -4]], " RED "}\n"
         "  - mesh: {file: scenes/regress/star.obj, transform: [translate: [0, 0, -4]], " BLUE "}\n"},
        {"equal planes",
         POINT_LIGHT "objects:\n" FLOOR "  - plane: {point: [5, -1, 0], normal: [0, 1, 0], " RED "}\n"},
        {"a box on a plane",
         POINT_LIGHT "objects:\n  - box: {min: [-1, -3, -6], max: [1, -1, -4], " RED "}\n" FLOOR},
        {"a plane under a box",
         POINT_LIGHT "objects:\n" FLOOR "  - box: {min: [-1, -3, -6], max: [1, -1, -4], " RED "}\n"},
        {"a turned plane on a plane", POINT_LIGHT
         "objects:\n" FLOOR
         "  - plane: {point: [0, 0, 0], normal: [0, 1, 0], transform: [translate: [0, -1, 0]], " RED "}\n"},
        {"equal boxes of glass", POINT_LIGHT "objects:\n"
                                             "  - cube: {center: [0, 0, -5], size: 1, " GLASS "}\n"
                                             "  - cube: {center: [0, 0, -5], size: 1, " MIRROR "}\n"},
    };
    ASSERT_ALL(scenes);
#undef BLUE
}

static void planes(void **state)
{
    (void)state;
    static const NamedScene scenes[] = {
        {"above and below",
         POINT_LIGHT "objects:\n" FLOOR "  - plane: {point: [0, 2, 0], normal: [0, 1, 0], " MIRROR "}\n"},
        {"the eye on it",
         POINT_LIGHT "objects:\n" THREE_SPHERES "  - plane: {point: [0, 0, 0], normal: [0, 1, 0]}\n"},
        {"along the rays",
         POINT_LIGHT "camera: {projection: orthographic, view_height: 4}\nobjects:\n" THREE_SPHERES
                     "  - plane: {point: [0, -1, 0], normal: [0, 1, 0]}\n"},
        {"all but along the rays",
         SUN "camera: {projection: orthographic, view_height: 4, direction: [0, -1e-15, "
             "-1]}\nobjects:\n" THREE_SPHERES "  - plane: {point: [0, -1, 0], normal: [0, 1, 0]}\n"},
        {"moved",
         POINT_LIGHT "objects:\n" THREE_SPHERES
                     "  - plane: {point: [0, 0, 0], normal: [0, 1, 0], transform: [rotate: {axis: [0, 0, 1], "
                     "angle: 10}, translate: [0, -1, 0]]}\n"},
        {"a light on it",
         "lights: [{point: {position: [0, -1, -4], color: 9}}]\nobjects:\n" THREE_SPHERES FLOOR},
    };
    ASSERT_ALL(scenes);
}

static void cameras(void **state)
{
    (void)state;
#define ALL POINT_LIGHT "objects:\n" THREE_SPHERES SOME_SHAPES FLOOR
    static const NamedScene scenes[] = {
        {"wide", "camera: {fov: 179, position: [0, 0, -3]}\n" ALL},
        {"narrow", "camera: {fov: 0.01}\n" ALL},
        {"orthographic", "camera: {projection: orthographic, view_height: 5}\n" ALL},
        {"orthographic, along an edge",
         "camera: {projection: orthographic, view_height: 2, position: [-1, 0, 0]}\n" ALL},
        {"orthographic, large", "camera: {projection: orthographic, view_height: 5e4}\n" ALL},
        {"in the middle", "camera: {position: [0, 0, -4.5], direction: [1, 0.2, 0.1]}\n" ALL},
        {"from far away", "camera: {position: [1e4, 1e3, 1e4], look_at: [0, 0, -5], fov: 0.02}\n" ALL},
        {"straight down", "camera: {position: [0, 6, -5], direction: [0, -1, 0], up: [0, 0, -1]}\n" ALL},
    };
    ASSERT_ALL(scenes);
#undef ALL
}

static void lights(void **state)
{
    (void)state;
#define ALL "objects:\n" THREE_SPHERES SOME_SHAPES FLOOR
    static const NamedScene scenes[] = {
        {"sun", SUN ALL},
        {"sun along an axis", "lights: [{directional: {direction: [0, -1, 0], color: 0.8}}]\n" ALL},
        {"sun along the floor", "lights: [{directional: {direction: [1, 0, 0], color: 0.8}}]\n" ALL},
        {"spot", "lights: [{spot: {position: [0, 4, -2], look_at: [0, 0, -5], color: 30, inner_angle: 5, "
                 "outer_angle: 30, tightness: 2}}]\n" ALL},
        {"area",
         "lights: [{area: {center: [0, 3, -3], edge_u: [2, 0, 0], edge_v: [0, 0, 2], samples: [3, 2], "
         "color: 20}}]\n" ALL},
        {"many", "lights:\n"
                 "  - point: {position: [3, 3, 0], color: [9, 1, 1]}\n"
                 "  - point: {position: [-3, 3, 0], color: [1, 9, 1], falloff: none}\n"
                 "  - directional: {direction: [-1, -1, -1], color: 0.2}\n"
                 "  - spot: {position: [0, 4, -2], look_at: [0, 0, -5], color: 3, inner_angle: 5, "
                 "outer_angle: 90}\n" ALL},
        {"no shadows", "render: {shadows: false}\n" POINT_LIGHT ALL},
        {"bias 0", "render: {shadow_bias: 0}\n" POINT_LIGHT ALL},
        {"bias 0.01", "render: {shadow_bias: 0.01, samples: 2}\n" SUN ALL},
    };
    ASSERT_ALL(scenes);
#undef ALL
}

static void materials(void **state)
{
    (void)state;
#define REST                                                                                                 \
    "  - sphere: {center: [0.5, 0, -3], radius: 0.3, casts_shadow: false, " RED "}\n" THREE_SPHERES FLOOR
    static const NamedScene scenes[] = {
        {"no shadow", POINT_LIGHT "objects:\n" REST},
        {"samples", "render: {samples: 3}\n" POINT_LIGHT "objects:\n" REST},
        {"fog", "fog: {color: [0.5, 0.6, 0.7], distance: 6}\n" POINT_LIGHT "objects:\n" REST},
        {"gradient",
         "background: {gradient: {bottom: [1, 0.5, 0], top: [0, 0.3, 1]}}\n" POINT_LIGHT "objects:\n" REST},
        {"simple", "render: {model: simple}\n" POINT_LIGHT "objects:\n" REST},
        {"simple, unlit", "render: {model: simple, shadows: false}\nobjects:\n" REST},
        {"lambert", "render: {model: lambert}\n" POINT_LIGHT "objects:\n" REST},
        {"blinn", "render: {model: blinn_phong, ambient: 0.2}\n" POINT_LIGHT "objects:\n" REST},
        {"one of each", POINT_LIGHT
         "objects:\n"
         "  - sphere: {center: [-1, 0, -4], radius: 0.6, material: {model: simple, diffuse: [1, 1, 0]}}\n"
         "  - sphere: {center: [0, 0, -4], radius: 0.6, material: {model: lambert, emission: [0, 0.1, 0]}}\n"
         "  - sphere: {center: [1, 0, -4], radius: 0.6, material: {model: blinn_phong, specular: 1, "
         "shininess: 0}}\n" FLOOR},
        {"patterns", POINT_LIGHT "objects:\n"
                                 "  - sphere: {center: [0, 0, -4], radius: 1, material: {pattern: {checker: "
                                 "{colors: [0, 1], size: 0.3}}}}\n"
                                 "  - plane: {point: [0, -1, 0], normal: [0, 1, 0], material: {pattern: "
                                 "{stripes: {colors: [[1, 0, 0], 1]}}}}\n"},
        {"glass in the light's way", "lights: [{point: {position: [0, 5, -4], color: 30}}]\nobjects:\n"
                                     "  - sphere: {center: [0, 2, -4], radius: 0.5, " GLASS "}\n"
                                     "  - cube: {center: [1, 2, -4], size: 0.5, " GLASS "}\n" REST},
        {"glass in the sun's way",
         SUN "objects:\n  - sphere: {center: [0, 2, -4], radius: 0.5, " GLASS "}\n" REST},
        {"a deep chain", "render: {max_depth: 12}\n" POINT_LIGHT
                         "objects:\n  - plane: {point: [0, 0, 1], normal: [0, 0, 1], " MIRROR "}\n"
                         "  - plane: {point: [0, 0, -8], normal: [0, 0, 1], " MIRROR "}\n" REST},
    };
    ASSERT_ALL(scenes);
#undef REST
}

static void solidsAndTransforms(void **state)
{
    (void)state;
#define STAR(steps, more)                                                                                    \
    "  - mesh: {file: scenes/regress/star.obj, transform: [" steps ", translate: [0, 0, -4]], " more "}\n"
    static const NamedScene scenes[] = {
        {"csg", POINT_LIGHT "objects:\n"
                            "  - difference: {objects: [{cube: {center: [0, 0, -5], size: 2, " RED
                            "}}, {sphere: {center: [0, 0, -4], "
                            "radius: 1, " MIRROR "}}]}\n"
                            "  - intersection: {objects: [{sphere: {center: [2, 0, -5], radius: 1}}, "
                            "{sphere: {center: [2.5, 0, -5], "
                            "radius: 1}}], " GLASS "}\n"
                            "  - union: {objects: [{sphere: {center: [-2, 0, -5], radius: 0.7}}, {cube: "
                            "{center: [-2.5, 0, -5], size: "
                            "1}}], " RED "}\n" FLOOR},
        {"mirrored", POINT_LIGHT "objects:\n" STAR("scale: [-1, 1, 1]", RED) FLOOR},
        {"stretched", POINT_LIGHT "objects:\n" STAR("scale: [100, 0.1, 1]", RED) FLOOR},
        {"stretched more", POINT_LIGHT "objects:\n" STAR("scale: [1e4, 0.1, 1]", "smooth: false") FLOOR},
        {"a flat star", SUN "objects:\n" STAR("scale: [1, 1, 1e-9]", RED) FLOOR},
        {"sheared", POINT_LIGHT
         "objects:\n" STAR("matrix: {x: [1, 0, 0], y: [3, 1, 0], z: [0, 2, 1], translate: [0, 0, 0]}", MIRROR)
             FLOOR},
        {"a glass star", SUN "objects:\n" STAR("rotate: {axis: [1, 2, 3], angle: 40}", GLASS) FLOOR},
        {"spheres become ellipsoids", SUN "objects:\n"
                                          "  - sphere: {center: [0, 0, 0], radius: 1, transform: [scale: "
                                          "[1000, 0.5, 1], translate: [0, 0, -5]], " RED "}\n"
                                          "  - sphere: {center: [0, 0, 0], radius: 1, transform: [scale: "
                                          "[0.001, 1, 1], translate: [1, 0, -4]]}\n" FLOOR},
    };
    ASSERT_ALL(scenes);
#undef STAR
}

static void pictureSizes(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {7, 3}, {65, 9}, {8, 8}, {9, 64}, {1, 130}, {129, 2}};
    Scene scene = load(POINT_LIGHT "render: {samples: 2}\nobjects:\n" THREE_SPHERES SOME_SHAPES FLOOR);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        assertAgreementAt("all sizes", &scene, sizes[i][0], sizes[i][1]);
    freeScene(&scene);
}

/* ---- Scenes made by hand ---- */

static Material gray(double level)
{
    return createMaterial(createColor((float)level, 0.5f, 0.7f), createColor(0.3f, 0.3f, 0.3f), 20);
}

static void addMesh(Scene *scene, const char *obj, Material material)
{
    MeshData *mesh;
    Status status = parseObjMesh(obj, strlen(obj), false, &mesh);
    assert_true(statusIsOk(&status));
    assert_true(keepMeshInScene(scene, mesh));
    assert_true(addObjectToScene(scene, (Object){.kind = SHAPE_MESH, .mesh = {material, mesh}}));
}

/* Some spheres, a box, a mesh of two triangles, a floor and two lights round offset, all of it scaled. */
static Scene sceneAtScale(double scale, double offset)
{
    Scene scene = createScene();
    Vector3D at = createVector(offset, -offset, offset);
#define P(x, y, z) multVector(addVectors(createVector(x, y, z), at), scale)
    scene.camera.position = P(0, 0, 0);
    for (int i = 0; i < 9; i++)
        addSphereToScene(&scene, createSphere(P(i % 3 - 1, i / 3 - 1, -4 - 0.3 * i), (0.2 + 0.05 * i) * scale,
                                              gray(0.1 * i)));
    scene.objects[4].sphere.material.reflection = createColor(0.5f, 0.5f, 0.5f);
    scene.objects[5].sphere.material.transmission = createColor(0.5f, 0.9f, 0.5f);
    addBoxToScene(&scene, createBox(P(-2, -1, -5), P(-1.5, 1, -3), gray(0.9)));
    addPlaneToScene(&scene, createPlane(P(0, -1.4, 0), createVector(0, 1, 0), gray(0.4)));
    Light lamp = createLight(P(3, 4, 1), createColor(1, 1, 1));
    lamp.falloff = FALLOFF_NONE;
    addLightToScene(&scene, lamp);
    addLightToScene(&scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                    .direction = {-0.6, -0.8, 0},
                                    .color = createColor(0.3f, 0.3f, 0.1f),
                                    .falloff = FALLOFF_NONE});
    if (scale <= 1e6) { /* of a mesh no more is allowed */
        char obj[800];
        int length = 0;
        const Vector3D corners[4] = {P(1.5, -1, -3), P(2, 1, -6), P(1.5, 1.5, -4), P(3, -1, -5)};
        for (int i = 0; i < 4; i++)
            length += snprintf(obj + length, sizeof obj - (size_t)length, "v %.17g %.17g %.17g\n",
                               corners[i].x, corners[i].y, corners[i].z);
        snprintf(obj + length, sizeof obj - (size_t)length, "f 1 2 3\nf 1 4 2\n");
        addMesh(&scene, obj, gray(1));
    }
#undef P
    return scene;
}

static void scales(void **state)
{
    (void)state;
    static const double all[] = {1, 1e-30, 1e-6, 1e6, 1e30, 1e100, 1e-100, 1e-150, 1e150, 1e-310};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        char name[40];
        snprintf(name, sizeof name, "scale %g", all[i]);
        Scene scene = sceneAtScale(all[i], 0);
        assertAgreement(name, &scene);
        freeScene(&scene);
    }
    static const double offsets[] = {1e3, 1e6, 1e9, 1e13};
    for (size_t i = 0; i < sizeof offsets / sizeof *offsets; i++) {
        char name[40];
        snprintf(name, sizeof name, "moved by %g", offsets[i]);
        Scene scene = sceneAtScale(1, offsets[i]);
        assertAgreement(name, &scene);
        freeScene(&scene);
    }
}

static void addLamp(Scene *scene, double x, double y, double z)
{
    Light lamp = createLight(createVector(x, y, z), createColor(1, 1, 1));
    lamp.falloff = FALLOFF_NONE;
    addLightToScene(scene, lamp);
}

/* A camera along -z, and orthographic along z, x and y, with every ray through a point of the lattice. */
static void assertAgreementAlongAxes(const char *name, Scene *scene, double extent)
{
    static const Vector3D directions[] = {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}, {1, 1, 0}};
    for (int i = 0; i < 4; i++)
        for (int ortho = 0; ortho < 2; ortho++) {
            scene->camera.direction = directions[i];
            scene->camera.position = multVector(directions[i], -3 * extent);
            scene->camera.up = i == 2 ? createVector(0, 0, 1) : createVector(0, 1, 0);
            scene->camera.projection = ortho ? PROJECTION_ORTHOGRAPHIC : PROJECTION_PERSPECTIVE;
            scene->camera.viewHeight = 2 * extent;
            assertAgreementAt(name, scene, 33, 33);
        }
}

static void touchingSpheres(void **state)
{
    (void)state;
    Scene scene = createScene();
    for (int x = -2; x <= 2; x++)
        for (int y = -2; y <= 2; y++)
            for (int z = -2; z <= 2; z++)
                addSphereToScene(&scene, createSphere(createVector(x, y, z), 0.5, gray(0.1 * (x + 3))));
    addLamp(&scene, 0, 0, 0);
    addLamp(&scene, 0.5, 0.5, 9);
    assertAgreementAlongAxes("a grid of spheres", &scene, 3);
    /* The eye in the gap between, and where two touch. */
    scene.camera.projection = PROJECTION_PERSPECTIVE;
    scene.camera.position = createVector(0.5, 0.5, 0.5);
    assertAgreement("between spheres", &scene);
    scene.camera.position = createVector(0.5, 0, 0);
    assertAgreement("where spheres touch", &scene);
    for (size_t i = 0; i < scene.objectCount; i++)
        scene.objects[i].sphere.radius = 0.8;
    assertAgreementAlongAxes("overlapping spheres", &scene, 3);
    for (size_t i = 0; i < scene.objectCount; i++)
        scene.objects[i].sphere.center.y = 0;
    assertAgreementAlongAxes("spheres in a plane", &scene, 3);
    freeScene(&scene);
}

static void gridOfTriangles(void **state)
{
    (void)state;
    /* A lattice of quads in three planes, twice: rays run through edges and vertices and along planes, and
     * each triangle coincides with another, of this mesh and of a second one. */
    char *obj = calloc(1, 1 << 16);
    size_t length = 0;
    int vertex = 0;
    for (int plane = 0; plane < 6; plane++)
        for (int i = -2; i < 2; i++)
            for (int j = -2; j < 2; j++) {
                for (int c = 0; c < 4; c++) {
                    int a = i + (c == 1 || c == 2), b = j + c / 2;
                    length += (size_t)snprintf(obj + length, (1 << 16) - length, "v %d %d %d\n",
                                               plane % 3 == 0 ? 0 : a,
                                               plane % 3 == 1   ? 0
                                               : plane % 3 == 0 ? a
                                                                : b,
                                               plane % 3 == 2 ? 0 : b);
                }
                length +=
                    (size_t)snprintf(obj + length, (1 << 16) - length, "f %d %d %d\nf %d %d %d\n", vertex + 1,
                                     vertex + 2, vertex + 3, vertex + 1, vertex + 3, vertex + 4);
                vertex += 4;
            }
    Scene scene = createScene();
    addMesh(&scene, obj, gray(1));
    addMesh(&scene, obj, gray(0.2));
    free(obj);
    addLamp(&scene, 0, 0, 9); /* edge on to two of the planes */
    addLamp(&scene, 1, 1, 1); /* above a vertex of each */
    addLamp(&scene, 0, 1, 0); /* on an edge */
    assertAgreementAlongAxes("a grid of triangles", &scene, 2.0625);
    scene.camera.projection = PROJECTION_PERSPECTIVE;
    scene.camera.position = createVector(1, 1, 0);
    assertAgreement("the eye on a vertex", &scene);
    scene.camera.position = createVector(0, 0, 1e-300);
    assertAgreement("the eye all but on a vertex", &scene);
    freeScene(&scene);
}

static void slivers(void **state)
{
    (void)state;
    Scene scene = createScene();
    addMesh(
        &scene,
        "v -3 0 -5\nv 3 1e-9 -5\nv 0 1e-7 -5\nv -3 -1 -4\nv 3 -1 -6\nv 3 -1.00001 -6\nv 0 1 -5\nv 1e-8 1 -5\n"
        "v 0 3 -5.00001\nv 1 1 -1e6\nv 1 -1 -1e6\nv 1 0 -1\nf 1 2 3\nf 4 5 6\nf 7 8 9\nf 10 11 12\nf 1 4 9\n",
        gray(1));
    addLamp(&scene, 0, 0, -5); /* in the plane of the first */
    addLamp(&scene, 1, 2, 0);
    assertAgreement("slivers", &scene);
    scene.camera.fov = 1e-6; /* the middle triangle's height is some rows */
    assertAgreement("slivers from near", &scene);
    freeScene(&scene);
}

/* Their planes are known far worse than their corners: what is nearest, or behind the eye, is hard to tell.
 */
static void bundleOfSlivers(void **state)
{
    (void)state;
    enum {
        SLIVERS = 400
    };
    for (int projection = 0; projection < 2; projection++)
        for (int power = -4; power <= -2; power++) {
            MeshData *mesh = calloc(1, sizeof *mesh);
            mesh->vertices = calloc(3 * SLIVERS, sizeof *mesh->vertices);
            mesh->triangles = calloc(SLIVERS, sizeof *mesh->triangles);
            double thickness = pow(10, power);
            for (uint32_t i = 0; i < SLIVERS; i++) {
                Vector3D middle = randomVector(thickness), along = randomDirection();
                mesh->vertices[3 * i] = addVectors(middle, along);
                mesh->vertices[3 * i + 1] = subVectors(middle, along);
                mesh->vertices[3 * i + 2] =
                    addVectors(randomVector(thickness), multVector(along, randomIn(-1, 1)));
                mesh->triangles[i] = (MeshTriangle){{3 * i, 3 * i + 1, 3 * i + 2}, {0, 0, 0}};
            }
            mesh->vertexCount = 3 * SLIVERS;
            mesh->triangleCount = SLIVERS;
            Status status = buildMesh(mesh);
            assert_true(statusIsOk(&status));
            Scene scene = createScene();
            assert_true(keepMeshInScene(&scene, mesh));
            addObjectToScene(&scene, (Object){.kind = SHAPE_MESH, .mesh = {gray(1), mesh}});
            addLamp(&scene, 0.1 * thickness, thickness, 0);
            scene.camera.projection = projection ? PROJECTION_ORTHOGRAPHIC : PROJECTION_PERSPECTIVE;
            scene.camera.viewHeight = 4 * thickness;
            scene.camera.position.z = 0.5 * thickness;
            assertAgreementAt("a bundle of slivers", &scene, 64, 64);
            freeScene(&scene);
        }
}

static void extremeSizes(void **state)
{
    (void)state;
    Scene scene = createScene();
    addSphereToScene(&scene, createSphere(createVector(0, -1e6 - 1, -5), 1e6, gray(0.3)));
    for (int i = 0; i < 300; i++)
        addSphereToScene(&scene,
                         createSphere(createVector((i % 20 - 10) * 0.002, -1 + 0.001 + (i % 3) * 0.002,
                                                   -3 - (i / 20) * 0.002),
                                      1e-3, gray(0.003 * i)));
    scene.camera.position = createVector(0, -0.99, -2.9);
    addLamp(&scene, 0, 2, -3);
    addLamp(&scene, 1e9, 1e9, 0);
    assertAgreement("one huge and many tiny", &scene);
    freeScene(&scene);

    scene = createScene();
    for (int i = 0; i < 40; i++)
        addSphereToScene(&scene,
                         createSphere(createVector((i - 20) * 0.1, 0, -3), i % 2 ? 1e-310 : 0.05, gray(0.5)));
    addLamp(&scene, 0, 3, 0);
    assertAgreement("denormal radii", &scene);
    for (size_t i = 0; i < scene.objectCount; i++)
        scene.objects[i].sphere =
            createSphere(createVector((double)i * 1e-310, 0, -1e-309), 4e-311, gray(0.5));
    assertAgreement("a denormal scene", &scene);
    freeScene(&scene);

    scene = createScene();
    for (int i = 0; i < 60; i++)
        addSphereToScene(&scene, createSphere(createVector(0.2 * pow(3, i), 0, -pow(3, i)), 0.3 * pow(3, i),
                                              gray(0.01 * i)));
    addLamp(&scene, -1, 1, 1);
    assertAgreement("growing spheres", &scene);
    freeScene(&scene);
}

/* Points of a plane so far away that floats, and the margins of the filter, leave their range. */
static void farHorizons(void **state)
{
    (void)state;
    static const double slopes[] = {1e-10, 1e-20, 1e-40, 1e-100};
    for (size_t i = 0; i < sizeof slopes / sizeof *slopes; i++)
        for (int sun = 0; sun < 2; sun++) {
            Scene scene = createScene();
            scene.camera.projection = PROJECTION_ORTHOGRAPHIC;
            scene.camera.viewHeight = 8;
            scene.camera.position = createVector(1, 0, -5);
            scene.camera.direction = createVector(1, 0, 0);
            addPlaneToScene(&scene,
                            createPlane(createVector(0, 0, 0), createVector(slopes[i], 0, 1), gray(0.4)));
            for (int s = 0; s < 20; s++)
                addSphereToScene(&scene,
                                 createSphere(createVector(-9 - s, s % 5 - 2, -6 + s % 4), 0.4, gray(0.9)));
            if (sun)
                addLightToScene(&scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                                .direction = {1, 0, 0},
                                                .color = createColor(1, 1, 1),
                                                .falloff = FALLOFF_NONE});
            else
                addLamp(&scene, -40, 0, -5);
            assertAgreement("a far horizon", &scene);
            scene.objects[0].plane.material.reflection = createColor(1, 1, 1);
            assertAgreement("a far mirror", &scene);
            freeScene(&scene);
        }
}

/* A wall so far away, square to the view, that what is behind the eye still throws its shadow on it. */
static void farWalls(void **state)
{
    (void)state;
    static const double distances[] = {1e8, 1e14, 1e20, 1e30, 1e40, 1e100};
    for (size_t i = 0; i < sizeof distances / sizeof *distances; i++)
        for (int kind = 0; kind < 4; kind++) {
            Scene scene = createScene();
            if (kind % 2 == 0)
                scene.camera.projection = PROJECTION_ORTHOGRAPHIC;
            scene.camera.viewHeight = 8;
            scene.camera.fov = 1e-4;
            addPlaneToScene(&scene,
                            createPlane(createVector(0, 0, -distances[i]), createVector(0, 0, 1), gray(0.4)));
            for (int s = 0; s < 40; s++)
                addSphereToScene(&scene,
                                 createSphere(createVector(s % 8 - 4, s % 5 - 2, 6 + s), 0.4, gray(0.9)));
            addMesh(&scene, "v -3 -3 3\nv 3 -3 3.5\nv 0 -1 4\nv -3 1 3\nv 0 2 3\nf 1 2 3\nf 1 3 4\nf 3 5 4\n",
                    gray(0.1));
            addCubeToScene(&scene, createCube(createVector(2, 2, 3), 1, gray(0.5)));
            if (kind < 2)
                addLightToScene(&scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                                .direction = {0, 0, -1},
                                                .color = createColor(1, 1, 1),
                                                .falloff = FALLOFF_NONE});
            else
                addLamp(&scene, 0, 0, 60);
            char name[60];
            snprintf(name, sizeof name, "a wall at %g, kind %d", distances[i], kind);
            assertAgreement(name, &scene);
            scene.objects[0].plane.material.reflection = createColor(1, 1, 1);
            assertAgreement(name, &scene);
            freeScene(&scene);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(simpleScenes),
        cmocka_unit_test(insideOfThings),
        cmocka_unit_test(lightsInAndOnThings),
        cmocka_unit_test(tiesGoToTheFirst),
        cmocka_unit_test(planes),
        cmocka_unit_test(cameras),
        cmocka_unit_test(lights),
        cmocka_unit_test(materials),
        cmocka_unit_test(solidsAndTransforms),
        cmocka_unit_test(pictureSizes),
        cmocka_unit_test(scales),
        cmocka_unit_test(touchingSpheres),
        cmocka_unit_test(gridOfTriangles),
        cmocka_unit_test(slivers),
        cmocka_unit_test(bundleOfSlivers),
        cmocka_unit_test(extremeSizes),
        cmocka_unit_test(farHorizons),
        cmocka_unit_test(farWalls),
    };
    return cmocka_run_group_tests(tests, findPaths, NULL);
}
