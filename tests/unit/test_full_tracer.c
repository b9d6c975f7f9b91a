/* The whole format in the tracer, by hand: every kind of light, every term of a material, rays in a chain,
 * fog and sky, orthographic and several samples. */
#include "one_pixel.h"
#include "raytracer.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static const Color3f black = {0, 0, 0};

static Material diffuseOnly(float r, float g, float b)
{
    return createMaterial(createColor(r, g, b), black, 32);
}

static Object sphereObject(double x, double y, double z, double radius, Material material)
{
    return (Object){.kind = SHAPE_SPHERE, .sphere = createSphere(createVector(x, y, z), radius, material)};
}

static Object groundObject(Material material)
{
    return (Object){.kind = SHAPE_PLANE,
                    .plane = createPlane(createVector(0, 0, 0), createVector(0, 1, 0), material)};
}

/* ---- Lights ---- */

static void directionalLight(void **state)
{
    (void)state;
    Scene scene = createScene();
    addObjectToScene(&scene, groundObject(diffuseOnly(1, 0.5f, 0)));
    addLightToScene(&scene, (Light){.kind = LIGHT_DIRECTIONAL,
                                    .direction = {0.6, -0.8, 0},
                                    .color = createColor(1, 1, 1),
                                    .falloff = FALLOFF_NONE});
    Vector3D eye = createVector(1, 5, 2);
    assertColorNear(colorAlong(&scene, eye, createVector(0, 0, 0)), 0.8, 0.4, 0);
    assertColorNear(colorAlong(&scene, eye, createVector(3, 0, -7)), 0.8, 0.4, 0);
    /* A blocker at any distance against the light's direction, and none along it. */
    addObjectToScene(&scene, sphereObject(-6e6, 8e6, 0, 1, diffuseOnly(1, 1, 1)));
    assertColorNear(colorAlong(&scene, eye, createVector(0, 0, 0)), 0, 0, 0);
    scene.objects[1].sphere.center = createVector(6, -8, 0);
    assertColorNear(colorAlong(&scene, eye, createVector(0, 0, 0)), 0.8, 0.4, 0);
    scene.lights[0].direction.y = 0.8;
    assertColorNear(colorAlong(&scene, eye, createVector(0, 0, 0)), 0, 0, 0);
    freeScene(&scene);
}

static void spotLight(void **state)
{
    (void)state;
    /* Straight above the origin at 2: on the ground the angle t has tan t = x / 2. */
    Scene scene = createScene();
    addObjectToScene(&scene, groundObject(diffuseOnly(1, 1, 1)));
    Light spot = {.kind = LIGHT_SPOT,
                  .position = {0, 2, 0},
                  .direction = {0, -1, 0},
                  .color = createColor(10, 10, 10),
                  .innerAngle = 10,
                  .outerAngle = 30,
                  .tightness = 2};
    addLightToScene(&scene, spot);
    const double pi = 3.14159265358979323846;
    const double angles[] = {0, 5, 9.9, 15, 20, 29, 30.5, 60};
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        double t = angles[i] * pi / 180, x = 2 * tan(t);
        double inner = cos(10 * pi / 180), outer = cos(30 * pi / 180);
        double s = fmax(0, fmin(1, (cos(t) - outer) / (inner - outer)));
        double expected = s * s * (3 - 2 * s) * pow(cos(t), 2) * 10 * cos(t) / (4 + x * x);
        assertColorNear(colorAlong(&scene, createVector(x, 3, 1), createVector(x, 0, 0)), expected, expected,
                        expected);
    }
    /* Inner = outer is a hard edge, and no falloff is none. */
    scene.lights[0].innerAngle = 30;
    scene.lights[0].tightness = 0;
    scene.lights[0].falloff = FALLOFF_NONE;
    double x = 2 * tan(29.99 * pi / 180), cosine = cos(29.99 * pi / 180);
    assertColorNear(colorAlong(&scene, createVector(x, 3, 1), createVector(x, 0, 0)), 10 * cosine,
                    10 * cosine, 10 * cosine);
    x = 2 * tan(30.01 * pi / 180);
    assertColorNear(colorAlong(&scene, createVector(x, 3, 1), createVector(x, 0, 0)), 0, 0, 0);
    /* Behind the light there is nothing, even with an outer angle of 90. */
    scene.lights[0].innerAngle = scene.lights[0].outerAngle = 90;
    scene.lights[0].direction.y = 1;
    assertColorNear(colorAlong(&scene, createVector(0, 3, 1), createVector(0, 0, 0)), 0, 0, 0);
    freeScene(&scene);
}

static void areaLight(void **state)
{
    (void)state;
    /* The mean of its point lights, the outermost on the border. */
    Scene area = createScene(), points = createScene();
    addObjectToScene(&area, groundObject(diffuseOnly(1, 1, 1)));
    addObjectToScene(&points, groundObject(diffuseOnly(1, 1, 1)));
    addLightToScene(&area, (Light){.kind = LIGHT_AREA,
                                   .position = {0, 4, 0},
                                   .color = createColor(30, 20, 10),
                                   .edgeU = {2, 0, 0},
                                   .edgeV = {0, 0, 6},
                                   .countU = 2,
                                   .countV = 3});
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 3; j++)
            addLightToScene(&points, createLight(createVector(-1 + 2 * i, 4, -3 + 3 * j),
                                                 createColor(5, 20.0f / 6, 10.0f / 6)));
    Vector3D eye = createVector(1, 5, 2), target = createVector(0.3, 0, 0.7);
    Color3f expected = colorAlong(&points, eye, target);
    assertColorNear(colorAlong(&area, eye, target), (double)expected.r, (double)expected.g,
                    (double)expected.b);
    /* A count of 1 is the middle. */
    area.lights[0].countU = area.lights[0].countV = 1;
    double d2 = 16 + 0.3 * 0.3 + 0.7 * 0.7, cosine = 4 / sqrt(d2);
    assertColorNear(colorAlong(&area, eye, target), 30 * cosine / d2, 20 * cosine / d2, 10 * cosine / d2);
    freeScene(&area);
    freeScene(&points);
}

/* ---- Materials ---- */

static void ownLightAndAmbient(void **state)
{
    (void)state;
    Scene scene = createScene();
    scene.render.ambient = createColor(0.5f, 0.25f, 1);
    Material material = diffuseOnly(1, 1, 1);
    material.ambient = createColor(0.2f, 0.4f, 0.6f);
    material.emission = createColor(0.01f, 3, 0);
    addObjectToScene(&scene, groundObject(material));
    Vector3D eye = createVector(1, 5, 2), origin = createVector(0, 0, 0);
    assertColorNear(colorAlong(&scene, eye, origin), 0.11, 3.1, 0.6);
    /* The simple model has neither, also where only the material says so. */
    scene.objects[0].material.model = MODEL_SIMPLE;
    assertColorNear(colorAlong(&scene, eye, origin), 1, 1, 1);
    freeScene(&scene);
}

static void blinnsHighlight(void **state)
{
    (void)state;
    /* As in the test of Phong's: V = (-3, 4)/5, L = (4, 3)/5, so H is along (1, 7): N.H = 7 / sqrt(50). */
    Scene scene = createScene();
    scene.render.model = MODEL_BLINN_PHONG;
    addObjectToScene(&scene, groundObject(createMaterial(black, createColor(1, 0.5f, 0), 9)));
    addLightToScene(&scene, createLight(createVector(4, 3, 0), createColor(50, 50, 50)));
    double highlight = 2 * pow(7 / sqrt(50), 9);
    assertColorNear(colorAlong(&scene, createVector(-3, 4, 0), createVector(0, 0, 0)), highlight,
                    highlight / 2, 0);
    scene.objects[0].material.model = MODEL_PHONG;
    highlight = 2 * pow(24.0 / 25, 9);
    assertColorNear(colorAlong(&scene, createVector(-3, 4, 0), createVector(0, 0, 0)), highlight,
                    highlight / 2, 0);
    freeScene(&scene);
}

static void mirrorsAndTheirLimit(void **state)
{
    (void)state;
    /* Between two parallel mirrors that shine: at a limit of n rays the light of n surfaces is seen. */
    Scene scene = createScene();
    Material mirror = diffuseOnly(0, 0, 0);
    mirror.emission = createColor(1, 1, 1);
    mirror.reflection = createColor(0.5f, 0.25f, 1);
    addObjectToScene(&scene, groundObject(mirror));
    addObjectToScene(&scene,
                     (Object){.kind = SHAPE_PLANE,
                              .plane = createPlane(createVector(0, 3, 0), createVector(0, -1, 0), mirror)});
    scene.background.bottom = createColor(100, 100, 100);
    for (int depth = 1; depth <= 8; depth++) {
        scene.render.maxDepth = depth;
        double r = 0, g = 0, b = 0;
        for (int i = 0; i < depth; i++) {
            r += pow(0.5, i);
            g += pow(0.25, i);
            b += 1;
        }
        assertColorNear(colorAlong(&scene, createVector(0, 1, 0), createVector(0.1, 0, 0.2)), r, g, b);
    }
    freeScene(&scene);
}

static Material glass(float ior)
{
    Material material = diffuseOnly(0, 0, 0);
    material.transmission = createColor(0.5f, 1, 0.25f);
    material.ior = ior;
    return material;
}

static void refractionBySnell(void **state)
{
    (void)state;
    /* Down through a plane of glass (its inside is below) at an angle with sin = 0.6; below, a striped
     * screen: the ray leaves at sin = 0.6 / 1.5 = 0.4 and so lands at depth * tan. */
    Scene scene = createScene();
    scene.render.maxDepth = 3;
    addObjectToScene(&scene, groundObject(glass(1.5f)));
    Material left = diffuseOnly(0, 0, 0), right = diffuseOnly(0, 0, 0);
    left.emission = createColor(1, 0, 0);
    right.emission = createColor(0, 1, 1);
    double lands = 2 * 0.4 / sqrt(1 - 0.16);
    Vector3D far = createVector(60, -2, 60);
    addObjectToScene(&scene,
                     (Object){.kind = SHAPE_BOX, .box = createBox(createVector(-60, -3, -60), far, right)});
    /* Where the first box is left, another begins a hair before the place. */
    addObjectToScene(&scene, (Object){.kind = SHAPE_BOX,
                                      .box = createBox(createVector(-60, -3, -60),
                                                       createVector(lands - 1e-6, -1.9999999, 60), left)});
    assertColorNear(colorAlong(&scene, createVector(-0.6, 0.8, 0), createVector(0, 0, 0)), 0, 1, 0.25);
    scene.objects[2].box.max.x = lands + 1e-6;
    assertColorNear(colorAlong(&scene, createVector(-0.6, 0.8, 0), createVector(0, 0, 0)), 0.5, 0, 0);
    freeScene(&scene);
}

static void totalReflection(void **state)
{
    (void)state;
    /* From inside glass (camera below the plane) beyond the critical angle, sin > 1/1.5, all is mirrored,
     * untinted; within it goes through. */
    Scene scene = createScene();
    scene.render.maxDepth = 3;
    Material surface = glass(1.5f);
    surface.reflection = createColor(1, 1, 1);
    addObjectToScene(&scene, groundObject(surface));
    Material floor = diffuseOnly(0, 0, 0);
    floor.emission = createColor(0.5f, 0.25f, 0.125f);
    addObjectToScene(&scene,
                     (Object){.kind = SHAPE_BOX,
                              .box = createBox(createVector(-99, -9, -99), createVector(99, -8, 99), floor)});
    scene.background.bottom = createColor(1, 1, 1);
    assertColorNear(colorAlong(&scene, createVector(-0.8, -0.6, 0), createVector(0, 0, 0)), 0.5, 0.25, 0.125);
    /* At sin = 0.5: transmission * background + reflection * floor. */
    assertColorNear(colorAlong(&scene, createVector(-0.5, -sqrt(0.75), 0), createVector(0, 0, 0)), 1, 1.25,
                    0.375);
    freeScene(&scene);
}

static void nestedGlassAndIor(void **state)
{
    (void)state;
    /* Straight through, only the tints count: four surfaces. */
    Scene scene = createScene();
    addObjectToScene(&scene, sphereObject(0, 0, -5, 2, glass(1.5f)));
    addObjectToScene(&scene, sphereObject(0, 0, -5, 1, glass(2.4f)));
    scene.background.bottom = createColor(1, 1, 1);
    assertColorNear(colorAlong(&scene, createVector(0, 0, 0), createVector(0, 0, -1)), 0.0625, 1, 0.00390625);
    /* From inside both, two. */
    assertColorNear(colorAlong(&scene, createVector(0, 0, -5), createVector(0, 0, -6)), 0.25, 1, 0.0625);
    freeScene(&scene);
}

static void lightThroughGlassIsTinted(void **state)
{
    (void)state;
    Scene scene = createScene();
    addObjectToScene(&scene, groundObject(diffuseOnly(1, 1, 1)));
    addObjectToScene(&scene, sphereObject(0, 3, 0, 1, glass(1.5f)));
    addLightToScene(&scene, createLight(createVector(0, 6, 0), createColor(36, 36, 36)));
    Vector3D eye = createVector(1, 1, 1), origin = createVector(0, 0, 0);
    assertColorNear(colorAlong(&scene, eye, origin), 0.25, 1, 0.0625);
    /* The light inside: one surface. */
    scene.lights[0].position.y = 3;
    assertColorNear(colorAlong(&scene, eye, origin), 4 * 0.5, 4, 4 * 0.25);
    /* An opaque one beside it blocks all the same; one that casts no shadow does not. */
    addObjectToScene(&scene, sphereObject(0, 1.2, 0, 0.3, diffuseOnly(1, 1, 1)));
    assertColorNear(colorAlong(&scene, eye, origin), 0, 0, 0);
    scene.objects[2].noShadow = true;
    assertColorNear(colorAlong(&scene, eye, origin), 2, 4, 1);
    freeScene(&scene);
}

static void patternsAreInObjectSpace(void **state)
{
    (void)state;
    Scene scene = createScene();
    scene.render.model = MODEL_SIMPLE;
    Pattern pattern = {
        .kind = PATTERN_CHECKER, .colors = {{1, 0, 0}, {0, 0, 1}}, .axis = {1, 0, 0}, .size = 2};
    Material material = diffuseOnly(1, 1, 1);
    material.pattern = &pattern;
    Object object = groundObject(material);
    Matrix matrix = translationMatrix(createVector(0.5, -0.5, 0));
    Transform transform;
    assert_true(createTransform(&matrix, &transform));
    object.transform = &transform;
    addObjectToScene(&scene, object);
    /* In object space the ground is y = 0, to be kept off the cells' border by the pattern's transform. */
    pattern.hasTransform = true;
    matrix = translationMatrix(createVector(0, -0.5, 0));
    assert_true(createTransform(&matrix, &pattern.transform));
    for (int i = -4; i < 4; i++)
        for (int j = -4; j < 4; j++) {
            Vector3D p = createVector(0.5 + 2 * i + 1, -0.5, 2 * j + 0.3);
            Color3f color = colorAlong(&scene, addVectors(p, createVector(0, 3, 1)), p);
            bool even = (i + j) % 2 == 0;
            assertColorNear(color, even, 0, !even);
        }
    /* Stripes: a below one half of the fraction, of negative coordinates too. Gradient: a sawtooth. */
    const double xs[] = {-3.9, -3.1, -2.9, -0.1, 0.1, 0.9, 1.1, 1.9, 2.1};
    for (size_t i = 0; i < sizeof xs / sizeof *xs; i++) {
        Vector3D p = createVector(0.5 + xs[i], -0.5, 0);
        double fraction = xs[i] / 2 - floor(xs[i] / 2);
        pattern.kind = PATTERN_STRIPES;
        bool first = fraction < 0.5;
        assertColorNear(colorAlong(&scene, addVectors(p, createVector(0, 3, 1)), p), first, 0, !first);
        pattern.kind = PATTERN_GRADIENT;
        assertColorNear(colorAlong(&scene, addVectors(p, createVector(0, 3, 1)), p), 1 - fraction, 0,
                        fraction);
    }
    freeScene(&scene);
}

static void imagesByNearestTexel(void **state)
{
    (void)state;
    /* Two by two texels, the first row at the top: v up, repeating. */
    const Color3f texels[4] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
    Pattern pattern = {.kind = PATTERN_IMAGE, .size = 1, .width = 2, .height = 2, .texels = texels};
    const struct {
        double x, y;
        int texel;
    } cases[] = {{0.2, 0.8, 0},  {0.7, 0.8, 1},   {0.2, 0.3, 2}, {0.7, 0.3, 3},
                 {-0.8, 1.8, 0}, {-0.3, -0.2, 1}, {5.2, -0.7, 2}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Color3f color = patternColor(&pattern, createVector(cases[i].x, cases[i].y, 7));
        const Color3f *expected = &texels[cases[i].texel];
        assertColorNear(color, (double)expected->r, (double)expected->g, (double)expected->b);
    }
    /* Spherical: u = 1/2 - atan2(z, x) / 2pi, v = 1/2 + asin(y / |p|) / pi. */
    pattern.mapping = MAPPING_SPHERICAL;
    assertColorNear(patternColor(&pattern, createVector(1, 1, 0.1)), 1, 0, 0);
    assertColorNear(patternColor(&pattern, createVector(1, 1, -0.1)), 0, 1, 0);
    assertColorNear(patternColor(&pattern, createVector(-3, -0.1, 0.1)), 0, 0, 1);
    assertColorNear(patternColor(&pattern, createVector(-3, -0.1, -0.1)), 1, 1, 0);
}

/* ---- Between and around ---- */

static void fogAndSky(void **state)
{
    (void)state;
    Scene scene = createScene();
    scene.background = (Background){.bottom = {1, 0, 0}, .top = {0, 0, 1}, .isGradient = true};
    Vector3D origin = createVector(0, 0, 0);
    assertColorNear(colorAlong(&scene, origin, createVector(0, 0, -1)), 0.5, 0, 0.5);
    assertColorNear(colorAlong(&scene, origin, createVector(0, 1, 0)), 0, 0, 1);
    assertColorNear(colorAlong(&scene, origin, createVector(0.8, -0.6, 0)), 0.8, 0, 0.2);

    /* The background is infinitely far, so nothing of it is left in fog. */
    scene.fog = (Fog){createColor(0.2f, 0.4f, 0.6f), 5};
    assertColorNear(colorAlong(&scene, origin, createVector(0, 0, -1)), 0.2, 0.4, 0.6);
    Material shining = diffuseOnly(0, 0, 0);
    shining.emission = createColor(1, 1, 1);
    addObjectToScene(&scene, sphereObject(0, 0, -9, 2, shining));
    double weight = exp(-7.0 / 5);
    assertColorNear(colorAlong(&scene, origin, createVector(0, 0, -1)), weight + 0.2 * (1 - weight),
                    weight + 0.4 * (1 - weight), weight + 0.6 * (1 - weight));
    /* Each ray of a chain has its own distance. */
    Material mirror = diffuseOnly(0, 0, 0);
    mirror.reflection = createColor(1, 1, 1);
    addObjectToScene(&scene,
                     (Object){.kind = SHAPE_PLANE,
                              .plane = createPlane(createVector(0, 0, 3), createVector(0, 0, -1), mirror)});
    double back = exp(-3.0 / 5), there = exp(-10.0 / 5);
    double seen = there + 0.2 * (1 - there);
    assertColorNear(colorAlong(&scene, origin, createVector(0, 0, 1)), back * seen + 0.2 * (1 - back),
                    back * (there + 0.4 * (1 - there)) + 0.4 * (1 - back),
                    back * (there + 0.6 * (1 - there)) + 0.6 * (1 - back));
    freeScene(&scene);
}

static void orthographicRays(void **state)
{
    (void)state;
    Camera camera = {.position = {1, 2, 3},
                     .direction = {0, 0, -2},
                     .up = {0, 1, 0},
                     .projection = PROJECTION_ORTHOGRAPHIC,
                     .viewHeight = 10};
    CameraFrame frame = cameraFrame(&camera, 200, 100);
    Ray ray = cameraRay(&frame, 0, 0, 200, 100);
    assert_true(norm(subVectors(ray.origin, createVector(1 - 10, 2 + 5, 3))) < 1e-12);
    assert_true(ray.direction.z == -1 && ray.direction.x == 0);
    ray = cameraRay(&frame, 150, 75, 200, 100);
    assert_true(norm(subVectors(ray.origin, createVector(1 + 5, 2 - 2.5, 3))) < 1e-12);
}

/* How many of n columns of samples of the pixel -1/2 .. 1/2 lie to the right of x. */
static int columnsRightOf(int n, double x)
{
    int columns = 0;
    for (int i = 0; i < n; i++)
        columns += (i + 0.5) / n - 0.5 > x;
    return columns;
}

static void samplesAreAMean(void **state)
{
    (void)state;
    /* A bright part and a black one: the samples of a pixel on the border see the share. */
    Scene scene = createScene();
    scene.render.model = MODEL_SIMPLE;
    addObjectToScene(&scene, (Object){.kind = SHAPE_BOX,
                                      .box = createBox(createVector(0.26, -99, -2), createVector(99, 99, -1),
                                                       diffuseOnly(8, 8, 8))});
    scene.camera.projection = PROJECTION_ORTHOGRAPHIC;
    scene.camera.viewHeight = 1;
    Framebuffer *framebuffer = createFramebuffer(1, 1);
    RenderOptions options = {.threads = 1};
    const int counts[] = {1, 2, 4, 8};
    for (size_t i = 0; i < 4; i++) {
        scene.render.samples = counts[i];
        RayCounts rays;
        renderReference(&scene, framebuffer, &options, &rays);
        /* Not clamped before the mean: so many columns of brightness 8. */
        double expected = 8.0 * columnsRightOf(counts[i], 0.26) / counts[i];
        assertColorNear(framebuffer->pixels[0], expected, expected, expected);
        assert_int_equal(rays.primary, counts[i] * counts[i]);
    }
    freeFramebuffer(framebuffer);
    freeScene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directionalLight),
        cmocka_unit_test(spotLight),
        cmocka_unit_test(areaLight),
        cmocka_unit_test(ownLightAndAmbient),
        cmocka_unit_test(blinnsHighlight),
        cmocka_unit_test(mirrorsAndTheirLimit),
        cmocka_unit_test(refractionBySnell),
        cmocka_unit_test(totalReflection),
        cmocka_unit_test(nestedGlassAndIor),
        cmocka_unit_test(lightThroughGlassIsTinted),
        cmocka_unit_test(patternsAreInObjectSpace),
        cmocka_unit_test(imagesByNearestTexel),
        cmocka_unit_test(fogAndSky),
        cmocka_unit_test(orthographicRays),
        cmocka_unit_test(samplesAreAMean),
    };
    return cmocka_run_group_tests_name("the whole tracer", tests, NULL, NULL);
}
