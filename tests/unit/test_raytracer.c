/* The course's tracer: pixels worked out by hand from the handout's formulas, shadows with their nasty
 * cases, the camera, and the same picture at every scale and with any number of threads. */
#include "base/cancel.h"
#include "one_pixel.h"
#include "raytracer.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const Color3f black = {0, 0, 0};

static Material diffuseOnly(float r, float g, float b)
{
    return createMaterial(createColor(r, g, b), black, 32);
}

static void sceneGrowsAndKeepsItsOrder(void **state)
{
    (void)state;
    Scene scene = createScene();
    assert_int_equal(scene.lightCount, 0);
    for (int i = 0; i < 1000; i++) {
        assert_true(addLightToScene(&scene, createLight(createVector(i, 0, 0), createColor(1, 2, 3))));
        assert_true(addSphereToScene(&scene, createSphere(createVector(0, i, 0), 1 + i, defaultMaterial())));
    }
    assert_int_equal(scene.lightCount, 1000);
    assert_true(scene.lights[999].position.x == 999 && scene.lights[999].color.g == 2);
    assert_true(scene.lights[5].falloff == FALLOFF_INVERSE_SQUARE);
    assert_true(scene.objects[999].sphere.radius == 1000);
    freeScene(&scene);
    assert_int_equal(scene.lightCount, 0);
    assert_null(scene.lights);
}

static void nearestOfSeveralAndFirstOfEqual(void **state)
{
    (void)state;
    Scene scene = createScene();
    addSphereToScene(&scene, createSphere(createVector(0, 0, -9), 1, diffuseOnly(1, 0, 0)));
    addCubeToScene(&scene, createCube(createVector(0, 0, -5), 2, diffuseOnly(0, 1, 0)));
    addSphereToScene(&scene, createSphere(createVector(0, 0, -5), 1, diffuseOnly(0, 0, 1)));
    Intersection hit = {.distance = 42};
    Ray ray = createRay(createVector(0, 0, 0), createVector(0, 0, -1));
    assert_true(throwRayThroughScene(ray, scene, &hit));
    assert_true(hit.distance == 4);
    assert_true(hit.material.diffuse.g == 1);
    ray.direction.z = 1;
    hit.distance = 42;
    assert_false(throwRayThroughScene(ray, scene, &hit));
    assert_true(hit.distance == 42);
    freeScene(&scene);
}

/* Exercise 03a, 04: straight ahead the sphere is 3.5 away and faces the light: 1 * 10 * 1 / 3.5^2. */
static void lambertByHand(void **state)
{
    (void)state;
    Scene scene = createScene();
    scene.render.model = MODEL_LAMBERT;
    addSphereToScene(&scene, createSphere(createVector(0, 0, -5), 1.5, diffuseOnly(1, 0, 0)));
    addLightToScene(&scene, createLight(createVector(0, 0, 0), createColor(10, 10, 10)));
    Vector3D eye = createVector(0, 0, 0);
    assertColorNear(colorAlong(&scene, eye, createVector(0, 0, -1)), 10 / 12.25, 0, 0);

    /* On a plane tilted away: cos = 4/5 at distance 5. */
    scene.objectCount = 0;
    addPlaneToScene(&scene,
                    createPlane(createVector(0, 0, -5), createVector(3, 0, 4), diffuseOnly(0.5f, 1, 2)));
    assertColorNear(colorAlong(&scene, eye, createVector(0, 0, -1)), 0.5 * 10 * 0.8 / 25, 10 * 0.8 / 25,
                    2 * 10 * 0.8 / 25);

    /* Lights add up; one without falloff does not grow weaker. */
    Light sun = createLight(createVector(0, 0, 0), createColor(0, 0.25f, 0));
    sun.falloff = FALLOFF_NONE;
    addLightToScene(&scene, sun);
    assertColorNear(colorAlong(&scene, eye, createVector(0, 0, -1)), 0.16, 10 * 0.8 / 25 + 0.25 * 0.8, 0.64);
    freeScene(&scene);
}

static void phongByHand(void **state)
{
    (void)state;
    /* A plane at y = 0 seen from (-3, 4, 0) at the origin; the light at (4, 3, 0) is 5 away. N.L = 3/5,
     * V = (-3, 4)/5, R = (-4, 3)/5, R.V = 24/25. */
    Scene scene = createScene();
    Material material = createMaterial(createColor(0.5f, 0, 0), createColor(0, 0.75f, 1), 3);
    addPlaneToScene(&scene, createPlane(createVector(0, 0, 0), createVector(0, 1, 0), material));
    addLightToScene(&scene, createLight(createVector(4, 3, 0), createColor(50, 50, 25)));
    Vector3D eye = createVector(-3, 4, 0), origin = createVector(0, 0, 0);
    double highlight = pow(24.0 / 25, 3);
    assertColorNear(colorAlong(&scene, eye, origin), 0.5 * 2 * 0.6, 0.75 * 2 * highlight, 1 * 1 * highlight);

    /* Lambert leaves the highlight out. */
    scene.render.model = MODEL_LAMBERT;
    assertColorNear(colorAlong(&scene, eye, origin), 0.6, 0, 0);

    /* From the light's own side R.V is negative: no highlight, also with an odd shininess. */
    scene.render.model = MODEL_PHONG;
    assertColorNear(colorAlong(&scene, createVector(10, 0.1, 0), origin), 0.6, 0, 0);

    /* A light behind the surface adds nothing, and does not darken. */
    addLightToScene(&scene, createLight(createVector(0, -2, 0), createColor(1000, 1000, 1000)));
    assertColorNear(colorAlong(&scene, eye, origin), 0.6, 0.75 * 2 * highlight, highlight);
    freeScene(&scene);
}

static void simpleIsTheDiffuseColourOrBlack(void **state)
{
    (void)state;
    Scene scene = createScene();
    scene.render.model = MODEL_SIMPLE;
    addPlaneToScene(&scene,
                    createPlane(createVector(0, 0, 0), createVector(0, 1, 0), diffuseOnly(0.5f, 2, 0)));
    Vector3D eye = createVector(1, 4, 1), origin = createVector(0, 0, 0);
    assertColorNear(colorAlong(&scene, eye, origin), 0.5, 2, 0);
    addLightToScene(&scene, createLight(createVector(0, -3, 0), createColor(9, 9, 9)));
    assertColorNear(colorAlong(&scene, eye, origin), 0, 0, 0);
    scene.render.shadows = false;
    assertColorNear(colorAlong(&scene, eye, origin), 0.5, 2, 0);
    scene.render.shadows = true;
    /* One light of several is enough, however dim. */
    addLightToScene(&scene, createLight(createVector(0, 300, 0), createColor(1e-6f, 0, 0)));
    assertColorNear(colorAlong(&scene, eye, origin), 0.5, 2, 0);
    freeScene(&scene);
}

static void blockersCountOnlyBetweenPointAndLight(void **state)
{
    (void)state;
    Scene scene = createScene();
    scene.render.model = MODEL_SIMPLE;
    addPlaneToScene(&scene, createPlane(createVector(0, 0, 0), createVector(0, 1, 0), diffuseOnly(1, 1, 1)));
    addSphereToScene(&scene, createSphere(createVector(0, 5, 0), 1, diffuseOnly(1, 1, 1)));
    Vector3D eye = createVector(0, 2, 3), origin = createVector(0, 0, 0);
    const struct {
        double lightHeight;
        float expected;
    } cases[] = {{3.9, 1}, {3.999999, 1}, {6.000001, 0}, {7, 0}, {4.5, 0}};
    addLightToScene(&scene, createLight(createVector(0, 0, 0), createColor(1, 1, 1)));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scene.lights[0].position.y = cases[i].lightHeight;
        assertColorNear(colorAlong(&scene, eye, origin), (double)cases[i].expected, (double)cases[i].expected,
                        (double)cases[i].expected);
    }
    /* A light exactly on a surface: that surface is not between. */
    scene.lights[0].position.y = 4;
    assertColorNear(colorAlong(&scene, eye, origin), 1, 1, 1);
    /* Without shadows nothing blocks. */
    scene.lights[0].position.y = 7;
    scene.render.shadows = false;
    assertColorNear(colorAlong(&scene, eye, origin), 1, 1, 1);
    freeScene(&scene);
}

static void aLightOnASurfaceIsNotHiddenByIt(void **state)
{
    (void)state;
    /* Seen from a light on the sphere, rounding puts the sphere's surface now before the light and now
     * behind it; every point that the sphere does not hide must be lit. */
    Scene scene = createScene();
    scene.render.model = MODEL_SIMPLE;
    Vector3D center = createVector(0.1, 0.7, 0.2), outward = normalize(createVector(0.3, -0.9, 0.1));
    addPlaneToScene(&scene, createPlane(createVector(0, -1, 0), createVector(0, 1, 0), defaultMaterial()));
    addSphereToScene(&scene, createSphere(center, 0.3, defaultMaterial()));
    Vector3D light = addVectors(center, multVector(outward, 0.3));
    addLightToScene(&scene, createLight(light, createColor(1, 1, 1)));
    size_t lit = 0;
    for (int i = 0; i < 900; i++) {
        Vector3D p = createVector(-1 + i % 30 / 15.0, -1, -1 + i / 30 / 15.0);
        if (dot(outward, subVectors(p, light)) < 0.01)
            continue;
        lit++;
        assertColorNear(colorAlong(&scene, addVectors(p, createVector(2, 0.5, 0)), p), 0.8, 0.8, 0.8);
    }
    assert_true(lit > 500);
    freeScene(&scene);
}

static void whatIsVeryNearStillBlocks(void **state)
{
    (void)state;
    /* A sheet a hundred millionth above the ground, just beside the point, on the way to the light. */
    Scene scene = createScene();
    scene.render.model = MODEL_SIMPLE;
    addPlaneToScene(&scene, createPlane(createVector(0, 0, 0), createVector(0, 1, 0), defaultMaterial()));
    addBoxToScene(&scene,
                  createBox(createVector(1e-9, 5e-9, -1), createVector(2, 1e-8, 1), defaultMaterial()));
    addLightToScene(&scene, createLight(createVector(1, 1, 0), createColor(1, 1, 1)));
    Vector3D origin = createVector(0, 0, 0);
    assertColorNear(colorAlong(&scene, createVector(-1, 1, 0), origin), 0, 0, 0);
    scene.lights[0].position.x = -1;
    assertColorNear(colorAlong(&scene, createVector(-1, 1, 0), origin), 0.8, 0.8, 0.8);
    freeScene(&scene);
}

static void insideASphere(void **state)
{
    (void)state;
    /* Camera and light inside: the wall is lit from within; a light outside does not reach it. */
    Scene scene = createScene();
    scene.render.model = MODEL_LAMBERT;
    addSphereToScene(&scene, createSphere(createVector(0, 0, 0), 2, diffuseOnly(1, 1, 1)));
    addLightToScene(&scene, createLight(createVector(0, 0, 0), createColor(8, 8, 8)));
    assertColorNear(colorAlong(&scene, createVector(0, 0, 1), createVector(0, 0, -1)), 2, 2, 2);
    scene.lights[0].position = createVector(0, 0, 5);
    assertColorNear(colorAlong(&scene, createVector(0, 0, 1), createVector(0, 0, -1)), 0, 0, 0);
    freeScene(&scene);
}

static Scene twoSpheres(double scale)
{
    Scene scene = createScene();
    Material shiny = createMaterial(createColor(1, 0, 0), createColor(0.5f, 0.5f, 0.25f), 32);
    addSphereToScene(&scene, createSphere(createVector(0, 0, -5 * scale), 1.5 * scale, shiny));
    addSphereToScene(&scene, createSphere(createVector(-scale, 0, -3.5 * scale), 0.5 * scale, shiny));
    addCubeToScene(&scene, createCube(createVector(1.5 * scale, -scale, -4 * scale), 0.8 * scale, shiny));
    addPlaneToScene(&scene, createPlane(createVector(0, -1.6 * scale, 0), createVector(0.1, 1, 0.2), shiny));
    float power = (float)(5 * scale * scale);
    addLightToScene(&scene,
                    createLight(createVector(-3 * scale, 0, scale), createColor(power, power, power)));
    addLightToScene(&scene, createLight(createVector(3 * scale, 4 * scale, 0), createColor(power, power, 0)));
    return scene;
}

static Framebuffer *draw(const Scene *scene, int width, int height, int threads)
{
    Framebuffer *framebuffer = createFramebuffer(width, height);
    RenderOptions options = {.threads = threads};
    Status status = renderReference(scene, framebuffer, &options, NULL);
    assert_true(statusIsOk(&status));
    return framebuffer;
}

static void sameBitsAtEveryScaleAndThreadCount(void **state)
{
    (void)state;
    Scene scene = twoSpheres(1);
    Framebuffer *expected = draw(&scene, 160, 120, 1);
    freeScene(&scene);
    size_t bytes = 160 * 120 * sizeof(Color3f);
    for (int exponent = -60; exponent <= 60; exponent += 12) {
        scene = twoSpheres(ldexp(1, exponent));
        Framebuffer *framebuffer = draw(&scene, 160, 120, 3);
        assert_memory_equal(framebuffer->pixels, expected->pixels, bytes);
        freeFramebuffer(framebuffer);
        freeScene(&scene);
    }
    freeFramebuffer(expected);
}

/* The share of pixels on which the light falls by N.L and that are black all the same, on one convex
 * object: all of them wrongly. */
static double acneShare(Scene *scene, Vector3D light)
{
    scene->render.model = MODEL_SIMPLE;
    scene->lightCount = 0;
    addLightToScene(scene, createLight(light, createColor(1, 1, 1)));
    int width = 200, height = 200;
    Framebuffer *framebuffer = draw(scene, width, height, 2);
    CameraFrame frame = cameraFrame(&scene->camera, width, height);
    size_t facing = 0, dark = 0;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            Ray ray = cameraRay(&frame, x + 0.5, y + 0.5, width, height);
            Intersection hit;
            if (!throwRayThroughScene(ray, *scene, &hit))
                continue;
            if (dot(hit.normal, subVectors(light, hit.position)) <= 0)
                continue;
            facing++;
            dark += colorIsBlack(framebuffer->pixels[y * width + x]);
        }
    }
    freeFramebuffer(framebuffer);
    assert_true(facing > 1000);
    return (double)dark / (double)facing;
}

static void noAcneOnAnyShapeAtAnyScale(void **state)
{
    (void)state;
    const double scales[] = {1e-7, 1e-3, 1, 1e3, 1e7};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        double s = scales[i];
        for (int kind = 0; kind < SHAPE_COUNT; kind++) {
            /* Not convex; test_shapes.c has rays from their surfaces. */
            if (kind == SHAPE_TORUS || kind == SHAPE_MESH || kind == SHAPE_CSG)
                continue;
            Scene scene = createScene();
            Vector3D at = createVector(0.3 * s, 0.1 * s, -5 * s);
            Object object = {.kind = (ShapeKind)kind};
            Vector3D top = createVector(0.9 * s, 1.6 * s, -4 * s);
            const Vector3D corners[3] = {{-2 * s, -s, -4 * s}, {2 * s, -0.7 * s, -5 * s}, {0, 2 * s, -6 * s}};
            if (kind == SHAPE_TRIANGLE)
                object.triangle = createTriangle(corners, NULL, defaultMaterial());
            if (kind == SHAPE_CONE)
                object.cone =
                    createCone(at, top, 1.5 * s, 0.4 * s * (double)(i % 3), false, defaultMaterial());
            if (kind == SHAPE_DISC)
                object.disc = createDisc(at, createVector(0.2, 0.5, 1), 2 * s, s, defaultMaterial());
            if (kind >= SHAPE_TRIANGLE)
                addObjectToScene(&scene, object);
            if (kind == SHAPE_SPHERE)
                addSphereToScene(&scene, createSphere(at, 1.7 * s, defaultMaterial()));
            if (kind == SHAPE_CUBE)
                addCubeToScene(&scene, createCube(at, 2.3 * s, defaultMaterial()));
            if (kind == SHAPE_BOX)
                addBoxToScene(
                    &scene, createBox(at, addVectors(at, createVector(s, 2 * s, 3 * s)), defaultMaterial()));
            if (kind == SHAPE_PLANE)
                addPlaneToScene(&scene, createPlane(createVector(0, -1.1 * s, 0), createVector(0.3, 1, 0.2),
                                                    defaultMaterial()));
            /* A near light, a grazing one, one from where the camera is. */
            assert_true(acneShare(&scene, createVector(-3 * s, 2 * s, s)) == 0);
            assert_true(acneShare(&scene, createVector(90 * s, 2 * s, s)) == 0);
            assert_true(acneShare(&scene, createVector(0, 0, 0)) == 0);
            freeScene(&scene);
        }
    }
    /* A ground of radius 1e6 under a camera at 1. */
    Scene scene = createScene();
    scene.camera.direction = createVector(0, -1, -1);
    addSphereToScene(&scene, createSphere(createVector(0, -1e6 - 1, 0), 1e6, defaultMaterial()));
    assert_true(acneShare(&scene, createVector(-3, 2, 1)) == 0);

    /* With a bias of 0 it is back, and a bias of the right size takes it away again. */
    scene.objects[0].sphere = createSphere(createVector(0, 0, -5), 1.5, defaultMaterial());
    scene.camera.direction = createVector(0, 0, -1);
    scene.render.shadowBias = 0;
    assert_true(acneShare(&scene, createVector(-3, 0, 1)) > 0.3);
    scene.render.shadowBias = 1e-3;
    assert_true(acneShare(&scene, createVector(-3, 0, 1)) < 0.001);
    freeScene(&scene);
}

static void pixelsLookWhereTheyShould(void **state)
{
    (void)state;
    Camera camera = {.position = {1, 2, 3}, .direction = {0, 0, -7}, .up = {0, 5, 0}, .fov = 90};
    CameraFrame frame = cameraFrame(&camera, 200, 100);
    /* The middle of the picture, its top and its left edge: 45 degrees up, and twice that slope aside. */
    Ray ray = cameraRay(&frame, 100, 50, 200, 100);
    assert_true(fabs(ray.direction.z + 1) < 1e-15 && ray.origin.y == 2);
    ray = cameraRay(&frame, 100, 0, 200, 100);
    assert_true(fabs(ray.direction.y - sqrt(0.5)) < 1e-15 && fabs(ray.direction.x) < 1e-15);
    ray = cameraRay(&frame, 0, 50, 200, 100);
    assert_true(fabs(ray.direction.x / ray.direction.z - 2) < 1e-14 && ray.direction.x < 0);
    /* A tilted up vector only fixes the roll. */
    camera.up = createVector(0, 1, 3);
    Ray tilted = cameraRay(&frame, 10, 20, 200, 100);
    frame = cameraFrame(&camera, 200, 100);
    ray = cameraRay(&frame, 10, 20, 200, 100);
    assert_true(norm(subVectors(ray.direction, tilted.direction)) < 1e-15);
}

static void handoutFunctionsIgnoreTheScenesModel(void **state)
{
    (void)state;
    Scene scene = twoSpheres(1);
    Framebuffer *framebuffer = createFramebuffer(80, 60);
    void (*const functions[])(Scene, Framebuffer *) = {simpleRaytracing, lambertRaytracing, phongRaytracing};
    for (int model = 0; model < 3; model++) {
        functions[model](scene, framebuffer);
        Scene same = scene;
        same.render.model = (ShadingModel)(MODEL_SIMPLE + model);
        Framebuffer *expected = draw(&same, 80, 60, 1);
        assert_memory_equal(framebuffer->pixels, expected->pixels, 80 * 60 * sizeof(Color3f));
        freeFramebuffer(expected);
    }
    assert_int_equal(scene.render.model, MODEL_PHONG);
    freeFramebuffer(framebuffer);
    freeScene(&scene);
}

static void raysAreCounted(void **state)
{
    (void)state;
    Scene scene = createScene();
    addPlaneToScene(&scene, createPlane(createVector(0, 0, -1), createVector(0, 0, 1), defaultMaterial()));
    addLightToScene(&scene, createLight(createVector(0, 0, 0), createColor(1, 1, 1)));
    addLightToScene(&scene, createLight(createVector(0, 0, -2), createColor(1, 1, 1)));
    Framebuffer *framebuffer = createFramebuffer(50, 40);
    RenderOptions options = {.threads = 2};
    RayCounts counts;
    renderReference(&scene, framebuffer, &options, &counts);
    assert_int_equal(counts.primary, 2000);
    assert_int_equal(counts.shadow, 2000);
    assert_int_equal(counts.secondary, 0);
    freeFramebuffer(framebuffer);
    freeScene(&scene);
}

/* Last, since a cancel is never taken back. */
static void cancelStops(void **state)
{
    (void)state;
    Scene scene = twoSpheres(1);
    Framebuffer *framebuffer = createFramebuffer(100, 100);
    requestCancel();
    RenderOptions options = {.threads = 2};
    Status status = renderReference(&scene, framebuffer, &options, NULL);
    assert_int_equal(status.code, STATUS_INTERRUPTED);
    freeFramebuffer(framebuffer);
    freeScene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sceneGrowsAndKeepsItsOrder),
        cmocka_unit_test(nearestOfSeveralAndFirstOfEqual),
        cmocka_unit_test(lambertByHand),
        cmocka_unit_test(phongByHand),
        cmocka_unit_test(simpleIsTheDiffuseColourOrBlack),
        cmocka_unit_test(blockersCountOnlyBetweenPointAndLight),
        cmocka_unit_test(aLightOnASurfaceIsNotHiddenByIt),
        cmocka_unit_test(whatIsVeryNearStillBlocks),
        cmocka_unit_test(insideASphere),
        cmocka_unit_test(sameBitsAtEveryScaleAndThreadCount),
        cmocka_unit_test(noAcneOnAnyShapeAtAnyScale),
        cmocka_unit_test(pixelsLookWhereTheyShould),
        cmocka_unit_test(handoutFunctionsIgnoreTheScenesModel),
        cmocka_unit_test(raysAreCounted),
        cmocka_unit_test(cancelStops),
    };
    return cmocka_run_group_tests_name("raytracer", tests, NULL, NULL);
}
