/* test_scene_variant.c - a variant can be changed in everything it owns, and the original stays as it was. */
#include "explain/scene_variant.h"
#include "loaded_scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const char SCENE[] =
    "lights:\n"
    "  - point: {position: [0, 5, 0], color: 10}\n"
    "objects:\n"
    "  - sphere: {center: [0, 0, -5], radius: 1, material: {diffuse: 0.25}}\n"
    "  - difference:\n"
    "      objects:\n"
    "        - box: {min: [1, 0, -5], max: [2, 1, -4], material: {diffuse: 0.5}}\n"
    "        - union:\n"
    "            objects:\n"
    "              - sphere: {center: [1, 0, -5], radius: 0.5, material: {diffuse: 0.75}}\n"
    "              - sphere: {center: [2, 0, -5], radius: 0.5, material: {diffuse: 1}}\n";

/* Count the materials and take their colour. */
static void blacken(Material *material, void *context)
{
    size_t *count = context;
    material->diffuse = createColor(0, 0, 0);
    ++*count;
}

/* The diffuse colours of an object's surfaces, added up. */
static float sumDiffuse(const Object *object)
{
    if (object->kind != SHAPE_CSG)
        return object->material.diffuse.r;
    float sum = 0;
    for (size_t i = 0; i < object->csg.partCount; i++)
        sum += sumDiffuse(&object->csg.parts[i]);
    return sum;
}

static void testMaterialsOfPartsToo(void **state)
{
    (void)state;
    Scene scene = load(SCENE), variant;
    Status status = createSceneVariant(&scene, &variant);
    assert_true(statusIsOk(&status));
    assert_int_equal(variant.objectCount, 2);
    assert_true(sumDiffuse(&variant.objects[1]) == 2.25f);

    /* Four surfaces, those of the nested solid too; the original keeps its colours. */
    size_t count = 0;
    changeMaterials(&variant, blacken, &count);
    assert_int_equal(count, 4);
    assert_true(sumDiffuse(&variant.objects[0]) == 0 && sumDiffuse(&variant.objects[1]) == 0);
    assert_true(sumDiffuse(&scene.objects[0]) == 0.25f && sumDiffuse(&scene.objects[1]) == 2.25f);
    freeSceneVariant(&variant);
    assert_int_equal(variant.objectCount, 0);
    freeScene(&scene);
}

static void testLightsAndSettings(void **state)
{
    (void)state;
    Scene scene = load(SCENE), variant;
    Status status = createSceneVariant(&scene, &variant);
    assert_true(statusIsOk(&status));
    variant.lights[0].color = createColor(1, 2, 3);
    variant.render.shadows = false;
    assert_true(scene.lights[0].color.g == 10);
    assert_true(scene.render.shadows);

    /* It can grow, as any scene. */
    assert_true(addLightToScene(&variant, createLight(createVector(0, 1, 0), createColor(1, 1, 1))));
    assert_int_equal(variant.lightCount, 2);
    assert_int_equal(scene.lightCount, 1);
    freeSceneVariant(&variant);
    freeScene(&scene);
}

static void testEmptyScene(void **state)
{
    (void)state;
    Scene scene = createScene(), variant;
    Status status = createSceneVariant(&scene, &variant);
    assert_true(statusIsOk(&status));
    assert_int_equal(variant.objectCount, 0);
    assert_int_equal(variant.lightCount, 0);
    freeSceneVariant(&variant);
    freeScene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(testMaterialsOfPartsToo),
        cmocka_unit_test(testLightsAndSettings),
        cmocka_unit_test(testEmptyScene),
    };
    return cmocka_run_group_tests_name("a scene's variant", tests, NULL, NULL);
}
