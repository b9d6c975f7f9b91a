/* test_pixel_story.c - the story of a pixel: the tracer's own bits, and numbers worked out by hand.
 *
 * Run from the repository's root, where the scenes are.
 */
#include "explain/pixel_story.h"
#include "loaded_scene.h"
#include "scene/load.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static PixelStory tell(const Scene *scene, int x, int y)
{
    PixelStory story;
    Status status = createPixelStory(scene, x, y, &story);
    assert_true(statusIsOk(&status));
    return story;
}

static void assertSameBits(Color3f a, Color3f b, const char *name, int x, int y)
{
    if (memcmp(&a, &b, sizeof a) != 0)
        fail_msg("%s, pixel %d, %d: the story has %.9g %.9g %.9g, the picture %.9g %.9g %.9g", name, x, y,
                 (double)a.r, (double)a.g, (double)a.b, (double)b.r, (double)b.g, (double)b.b);
}

/* The terms that are told add up to what is told. */
static void assertAddsUp(const RayStory *ray)
{
    if (ray == NULL || ray->end != RAY_MEETS_SURFACE || ray->model == MODEL_SIMPLE)
        return;
    Color3f diffuse = {0}, highlight = {0};
    for (size_t i = 0; i < ray->lightCount; i++) {
        const LightStory *light = &ray->lights[i];
        diffuse = addColors(diffuse, light->diffuse);
        highlight = addColors(highlight, light->highlight);
        assert_true((light->fate == LIGHT_REACHES) == !colorIsBlack(light->reaching));
        /* Nothing opaque and unnamed takes a light away; what is named lies between. */
        if (light->fate == LIGHT_BLOCKED && light->crossingCount == 0)
            assert_non_null(light->blocker);
        if (light->blocker != NULL) {
            assert_true(light->fate == LIGHT_BLOCKED);
            assert_true(light->blockedAt < light->shadow.farthest);
        }
    }
    assert_memory_equal(&diffuse, &ray->diffuseSum, sizeof diffuse);
    assert_memory_equal(&highlight, &ray->highlightSum, sizeof highlight);
    assertAddsUp(ray->refracted);
    assertAddsUp(ray->mirrored);
}

/* Pixels of the scene in a small size, drawn and told. */
static void checkScene(const char *path)
{
    Scene scene;
    Diagnostics diagnostics = {0};
    Status status = loadScene(path, &scene, &diagnostics);
    diagnosticsFree(&diagnostics);
    assert_true(statusIsOk(&status));
    if (scene.objectCount > 3000) {
        freeScene(&scene);
        return;
    }
    scene.image.width = 20;
    scene.image.height = 15;
    Framebuffer *picture = createFramebuffer(20, 15);
    assert_non_null(picture);
    RenderOptions options = {.threads = 2};
    status = renderReference(&scene, picture, &options, NULL);
    assert_true(statusIsOk(&status));
    for (int i = 3; i < 300; i += 17) {
        int x = i % 20, y = i / 20;
        PixelStory story = tell(&scene, x, y);
        assertSameBits(story.color, picture->pixels[i], path, x, y);
        const float channels[3] = {story.color.r, story.color.g, story.color.b};
        for (int c = 0; c < 3; c++)
            assert_int_equal(story.stored[c],
                             quantizeSample(channels[c], scene.image.bitDepth, scene.image.encoding));
        assertAddsUp(story.ray);
        freePixelStory(&story);
    }
    freeFramebuffer(picture);
    freeScene(&scene);
}

static void checkFolder(const char *folder)
{
    DIR *directory = opendir(folder);
    assert_non_null(directory);
    int scenes = 0;
    for (struct dirent *entry; (entry = readdir(directory)) != NULL;) {
        const char *extension = strrchr(entry->d_name, '.');
        if (extension == NULL || strcmp(extension, ".yaml") != 0)
            continue;
        Text path = {0};
        textAppendFormat(&path, "%s/%s", folder, entry->d_name);
        checkScene(textString(&path));
        textFree(&path);
        scenes++;
    }
    closedir(directory);
    assert_true(scenes >= 9);
}

static void courseHasThePicturesBits(void **state)
{
    (void)state;
    checkFolder("scenes/course");
}

static void galleryHasThePicturesBits(void **state)
{
    (void)state;
    checkFolder("scenes/gallery");
}

static void regressHasThePicturesBits(void **state)
{
    (void)state;
    checkFolder("scenes/regress");
}

/* The handout's 03a: a sphere of radius 1.5 at (0, 0, -5), a light (10, 10, 10) at the origin, where the
 * camera is too. The middle ray meets it at distance 3.5, head on: Ic * Lc * 1 / 12.25 = 0.8163 of red. */
static void numbersByHandOfTheHandout(void **state)
{
    (void)state;
    Scene scene = load("image: {width: 3, height: 3}\n"
                       "render: {model: lambert}\n"
                       "lights: [{point: {position: [0, 0, 0], color: 10}}]\n"
                       "objects:\n"
                       "  - sphere: {center: [0, 0, -5], radius: 1.5, material: {diffuse: [1, 0, 0]}}\n"
                       "  - sphere: {center: [0, 9, -5], radius: 1}\n");
    PixelStory story = tell(&scene, 1, 1);
    const RayStory *ray = story.ray;
    assert_int_equal(ray->end, RAY_MEETS_SURFACE);
    assert_int_equal(ray->triedCount, 2);
    assert_int_equal(ray->metCount, 1);
    assert_true(ray->tried[0].distance == 3.5);
    assert_true(isinf(ray->tried[1].distance));
    assertVector(ray->point.position, 0, 0, -3.5);
    assertVector(ray->point.normal, 0, 0, 1);
    assert_int_equal(ray->lightCount, 1);
    assertVector(ray->lights[0].il, 0, 0, 3.5);
    assert_true(ray->lights[0].cosine == 1);
    assert_int_equal(ray->lights[0].fate, LIGHT_REACHES);
    assert_true(fabs((double)story.color.r - 10 / 12.25) < 1e-7);
    assert_true(story.color.g == 0 && story.color.b == 0);
    assert_int_equal(story.stored[0], 233); /* 255 (1.055 0.8163^(1/2.4) - 0.055) = 232.57 */
    freePixelStory(&story);
    freeScene(&scene);
}

static void phongAndBlinnByHand(void **state)
{
    (void)state;
    /* The camera looks down on a plane; the light stands at 45 degrees, the camera straight above. */
    Scene scene = load("image: {width: 1, height: 1}\n"
                       "camera: {position: [0, 4, 0], direction: [0, -1, 0], up: [0, 0, -1]}\n"
                       "lights: [{point: {position: [2, 2, 0], color: 8}}]\n"
                       "objects:\n"
                       "  - plane: {point: [0, 0, 0], normal: [0, 1, 0],\n"
                       "            material: {diffuse: 0.5, specular: 0.25, shininess: 2}}\n");
    PixelStory story = tell(&scene, 0, 0);
    const LightStory *light = &story.ray->lights[0];
    double half = sqrt(0.5);
    assert_true(fabs(light->cosine - half) < 1e-15);
    assert_true(fabs(light->arriving.distance - sqrt(8)) < 1e-15);
    assert_true(fabs(light->highlightDot - half) < 1e-15);
    assert_true(fabs(light->specFactor - 0.5) < 1e-15);
    /* 0.5 * 8 * 0.7071 / 8 + 0.25 * 8 * 0.5 / 8 */
    assert_true(fabs((double)story.color.r - (0.5 * half + 0.125)) < 1e-7);
    freePixelStory(&story);

    scene.render.model = MODEL_BLINN_PHONG;
    story = tell(&scene, 0, 0);
    light = &story.ray->lights[0];
    double cosine = cos(atan(1) / 2); /* of 22.5 degrees */
    assert_true(fabs(light->highlightDot - cosine) < 1e-15);
    assert_true(fabs(light->specFactor - cosine * cosine) < 1e-15);
    assertVector(light->r, light->r.x, light->r.y, 0);
    freePixelStory(&story);
    freeScene(&scene);
}

static void theNearestBlockerIsNamed(void **state)
{
    (void)state;
    Scene scene = load("image: {width: 1, height: 1}\n"
                       "camera: {position: [0, 1, 5], direction: [0, -0.2, -1]}\n"
                       "lights: [{point: {position: [0, 9, 0], color: 8}}]\n"
                       "objects:\n"
                       "  - sphere: {center: [0, 7, 0], radius: 0.5}\n"
                       "  - sphere: {center: [0, 4, 0], radius: 0.5}\n"
                       "  - sphere: {center: [0, 2, 0], radius: 0.5, casts_shadow: false}\n"
                       "  - plane: {point: [0, 0, 0], normal: [0, 1, 0]}\n"
                       "  - sphere: {center: [0, 5.5, 0], radius: 0.5}\n"
                       "  - sphere: {center: [0, 12, 0], radius: 0.5}\n");
    PixelStory story = tell(&scene, 0, 0);
    const LightStory *light = &story.ray->lights[0];
    assert_int_equal(light->fate, LIGHT_BLOCKED);
    assert_ptr_equal(light->blocker, &scene.objects[1]);
    assert_int_equal(light->blocker->line, 6);
    assert_true(fabs(light->blockedAt - 3.5) < 1e-9);
    Text name = {0};
    appendObjectName(&scene, light->blocker, light->blockerPart, &name);
    assert_string_equal(textString(&name), "the sphere of line 6");
    textFree(&name);
    freePixelStory(&story);
    freeScene(&scene);
}

/* A cascade of mirrors and glass has more rays than a story tells; the colour is right all the same. */
static void aCascadeOfRaysEnds(void **state)
{
    (void)state;
    Scene scene = load("image: {width: 2, height: 2}\n"
                       "camera: {fov: 20}\n"
                       "render: {max_depth: 14, samples: 3}\n"
                       "background: [0.2, 0.3, 0.4]\n"
                       "lights: [{area: {center: [0, 5, 0], edge_u: [1, 0, 0], edge_v: [0, 0, 1], "
                       "samples: [3, 3], color: 30}}]\n"
                       "objects:\n"
                       "  - sphere: {center: [0.4, 0, -3], radius: 1.2, material: {transmission: 0.6, "
                       "reflection: 0.4, ior: 1.4}}\n"
                       "  - sphere: {center: [0.4, 0, -3], radius: 0.7, material: {transmission: 0.6, "
                       "reflection: 0.4, ior: 1.2}}\n");
    Framebuffer *picture = createFramebuffer(2, 2);
    RenderOptions options = {.threads = 1};
    Status status = renderReference(&scene, picture, &options, NULL);
    assert_true(statusIsOk(&status));
    for (int i = 0; i < 4; i++) {
        PixelStory story = tell(&scene, i % 2, i / 2);
        assertSameBits(story.color, picture->pixels[i], "cascade", i % 2, i / 2);
        assert_true(story.rayCount > 20 && story.rayCount <= 256);
        assert_int_equal(story.sampleCount, 9);
        assert_int_equal(story.told, 4);
        freePixelStory(&story);
    }
    freeFramebuffer(picture);
    freeScene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(courseHasThePicturesBits),  cmocka_unit_test(galleryHasThePicturesBits),
        cmocka_unit_test(regressHasThePicturesBits), cmocka_unit_test(numbersByHandOfTheHandout),
        cmocka_unit_test(phongAndBlinnByHand),       cmocka_unit_test(theNearestBlockerIsNamed),
        cmocka_unit_test(aCascadeOfRaysEnds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
