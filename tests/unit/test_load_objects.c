/* Objects of a scene file: every kind's keys arrive, transforms compose in the order that the format says,
 * and groups and solids hand down their transform, material and shadow.
 */
#include "base/files.h"
#include "loaded_scene.h"
#include "scene/load.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void assertNear(Vector3D v, double x, double y, double z)
{
    if (!(norm(subVectors(v, createVector(x, y, z))) < 1e-12))
        fail_msg("(%.17g, %.17g, %.17g) is not (%g, %g, %g)", v.x, v.y, v.z, x, y, z);
}

/* Where the object takes a point of its own space. */
static Vector3D placed(const Object *object, double x, double y, double z)
{
    Vector3D p = createVector(x, y, z);
    if (object->transform == NULL)
        return p;
    Vector3D world = transformPoint(&object->transform->worldFromObject, p);
    /* The way back is there too. */
    Vector3D back = transformPoint(&object->transform->objectFromWorld, world);
    assertNear(back, x, y, z);
    return world;
}

#define SPHERE "sphere: {center: [0, 0, 0], radius: 1"

/* ---- Shapes ---- */

static void everyShapeIsRead(void **state)
{
    (void)state;
    Scene scene = load(
        "objects:\n"
        "  - triangle: {vertices: [[1, 2, 3], [4, 5, 6], [7, 8, 10]]}\n"
        "  - triangle: {vertices: [[0, 0, 0], [1, 0, 0], [0, 1, 0]], normals: [[0, 0, 2], [3, 0, 4], [0, "
        "1, 0]]}\n"
        "  - cylinder: {base: [1, 2, 3], top: [4, 5, 6], radius: 0.5}\n"
        "  - cylinder: {base: [1, 2, 3], top: [4, 5, 6], radius: 0.5, open: true}\n"
        "  - cone: {base: [0, 1, 0], top: [0, 3, 0], base_radius: 2, top_radius: 0, open: false}\n"
        "  - cone: {base: [0, 1, 0], top: [0, 3, 0], base_radius: 0, top_radius: 3, open: true}\n"
        "  - disc: {center: [1, 2, 3], normal: [0, 0, -5], radius: 2, inner_radius: 1.5}\n"
        "  - disc: {center: [1, 2, 3], normal: [0, 3, 0], radius: 2}\n"
        "  - torus: {major_radius: 2, minor_radius: 2}\n");
    const Object *o = scene.objects;
    assert_int_equal(scene.objectCount, 9);
    assert_int_equal(o[0].kind, SHAPE_TRIANGLE);
    assertVector(o[0].triangle.vertices[0], 1, 2, 3);
    assertVector(o[0].triangle.vertices[1], 4, 5, 6);
    assertVector(o[0].triangle.vertices[2], 7, 8, 10);
    assert_false(o[0].triangle.isSmooth);
    assert_true(o[1].triangle.isSmooth);
    assertVector(o[1].triangle.normals[0], 0, 0, 1); /* made unit vectors */
    assertNear(o[1].triangle.normals[1], 0.6, 0, 0.8);
    assertVector(o[1].triangle.normals[2], 0, 1, 0);
    assert_int_equal(o[2].kind, SHAPE_CONE);
    assertVector(o[2].cone.base, 1, 2, 3);
    assertVector(o[2].cone.top, 4, 5, 6);
    assert_true(o[2].cone.baseRadius == 0.5 && o[2].cone.topRadius == 0.5);
    assert_false(o[2].cone.isOpen);
    assert_true(o[3].cone.isOpen);
    assert_true(o[4].cone.baseRadius == 2 && o[4].cone.topRadius == 0);
    assert_false(o[4].cone.isOpen);
    assert_true(o[5].cone.baseRadius == 0 && o[5].cone.topRadius == 3);
    assert_true(o[5].cone.isOpen);
    assert_int_equal(o[6].kind, SHAPE_DISC);
    assertVector(o[6].disc.center, 1, 2, 3);
    assertVector(o[6].disc.normal, 0, 0, -1);
    assert_true(o[6].disc.radius == 2 && o[6].disc.innerRadius == 1.5);
    assert_true(o[7].disc.innerRadius == 0);
    assert_int_equal(o[8].kind, SHAPE_TORUS);
    assert_true(o[8].torus.majorRadius == 2 && o[8].torus.minorRadius == 2);
    for (size_t i = 0; i < scene.objectCount; i++) {
        assert_int_equal(o[i].line, 2 + (int)i);
        assert_null(o[i].transform);
        assert_false(o[i].noShadow);
    }
    freeScene(&scene);
}

static void spheresAreSpheres(void **state)
{
    (void)state;
    Scene scene = load("objects:\n"
                       "  - spheres:\n"
                       "      material: {diffuse: 0.25}\n"
                       "      casts_shadow: false\n"
                       "      transform: [translate: [1, 0, 0]]\n"
                       "      data:\n"
                       "        - [1, 2, 3, 0.5]\n"
                       "        - &row [4, 5, 6, 1]\n"
                       "        - *row\n"
                       "  - spheres: {data: []}\n"
                       "  - " SPHERE "}\n");
    assert_int_equal(scene.objectCount, 4);
    assertVector(scene.objects[0].sphere.center, 1, 2, 3);
    assert_true(scene.objects[0].sphere.radius == 0.5);
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(scene.objects[i].kind, SHAPE_SPHERE);
        assert_int_equal(scene.objects[i].line, 7 + (int)i);
        assert_true(scene.objects[i].noShadow);
        assert_true(scene.objects[i].material.diffuse.g == 0.25F);
        assertVector(placed(&scene.objects[i], 0, 0, 0), 1, 0, 0);
        /* One transform serves all. */
        assert_ptr_equal(scene.objects[i].transform, scene.objects[0].transform);
    }
    assertVector(scene.objects[2].sphere.center, 4, 5, 6);
    assert_false(scene.objects[3].noShadow);
    assert_true(scene.objects[3].material.diffuse.g == 0.8F);
    assert_null(scene.objects[3].transform);
    freeScene(&scene);
}

/* ---- Transforms ---- */

static void stepsActInTheirOrder(void **state)
{
    (void)state;
    Scene scene = load("objects:\n"
                       "  - " SPHERE ", transform: [translate: [1, 0, 0], scale: 2]}\n"
                       "  - " SPHERE ", transform: [scale: 2, translate: [1, 0, 0]]}\n"
                       "  - " SPHERE ", transform: [rotate: {axis: [0, 0, 7], angle: 90}]}\n"
                       "  - " SPHERE ", transform: [rotate: {axis: [0, 1, 0], angle: 90}]}\n"
                       "  - " SPHERE ", transform: [scale: [1, -2, 3]]}\n"
                       "  - " SPHERE ", transform: [matrix: {x: [0, 1, 0], y: [0, 0, 1], z: [1, 0, 0], "
                       "translate: [10, 20, 30]}]}\n"
                       "  - " SPHERE ", transform: [{scale: [2, 1, 1]}, {rotate: {axis: [0, 0, 1], angle: "
                       "90}}, {translate: [0, 0, 5]}]}\n"
                       "  - " SPHERE ", transform: []}\n"
                       "  - " SPHERE ", transform: [translate: [0, 0, 0], scale: 1]}\n");
    const Object *o = scene.objects;
    assertVector(placed(&o[0], 1, 1, 1), 4, 2, 2);
    assertVector(placed(&o[1], 1, 1, 1), 3, 2, 2);
    assertVector(placed(&o[2], 1, 0, 0), 0, 1, 0); /* right-handed: x goes to y round z */
    assertVector(placed(&o[2], 0, 1, 0), -1, 0, 0);
    assertVector(placed(&o[3], 0, 0, 1), 1, 0, 0); /* and z to x round y */
    assertVector(placed(&o[4], 1, 1, 1), 1, -2, 3);
    assertVector(placed(&o[5], 1, 2, 3), 13, 21, 32);
    assertVector(placed(&o[6], 1, 0, 0), 0, 2, 5);
    assert_null(o[7].transform); /* what does nothing is left out */
    assert_null(o[8].transform);
    freeScene(&scene);
    assert_true(loads("objects: [{" SPHERE ", transform: [rotate: {axis: [1, 2, 3], angle: -1000}]}}]"));
    assert_true(loads("objects: [{" SPHERE ", transform: [scale: 1.0e-100]}}]"));
}

static void aChildActsBeforeItsGroups(void **state)
{
    (void)state;
    Scene scene = load("objects:\n"
                       "  - group:\n"
                       "      transform: [translate: [0, 0, 100]]\n"
                       "      objects:\n"
                       "        - group:\n"
                       "            objects:\n"
                       "              - " SPHERE ", transform: [translate: [1, 0, 0]]}\n"
                       "              - " SPHERE "}\n"
                       "            transform:\n"
                       "              - scale: 2\n"
                       "              - translate: [0, 10, 0]\n"
                       "        - " SPHERE "}\n"
                       "        - group:\n"
                       "            objects: [{" SPHERE ", transform: [scale: 5]}}]\n"
                       "  - " SPHERE "}\n");
    const Object *o = scene.objects;
    assert_int_equal(scene.objectCount, 5);
    assertVector(placed(&o[0], 1, 1, 1), 4, 12, 102);
    assertVector(placed(&o[1], 1, 1, 1), 2, 12, 102);
    assertVector(placed(&o[2], 1, 1, 1), 1, 1, 101);
    assertVector(placed(&o[3], 1, 1, 1), 5, 5, 105);
    assert_null(o[4].transform);
    freeScene(&scene);
}

/* ---- What is handed down ---- */

static void theNearestMaterialWins(void **state)
{
    (void)state;
    Scene scene = load("objects:\n"
                       "  - group:\n"
                       "      objects:\n"
                       "        - " SPHERE "}\n" /* 0: from the group below, 0.1 */
                       "        - " SPHERE ", material: b}\n"
                       "        - group:\n"
                       "            objects:\n"
                       "              - " SPHERE "}\n" /* 2: 0.1, through a group without one */
                       "              - union:\n"
                       "                  material: c\n"
                       "                  objects:\n"
                       "                    - " SPHERE "}\n"
                       "                    - " SPHERE ", material: {diffuse: 0.4}}\n"
                       "                    - group: {material: b, objects: [{" SPHERE "}}]}\n"
                       "        - group:\n"
                       "            material: {diffuse: 0.5}\n"
                       "            objects: [{" SPHERE "}}, {spheres: {data: [[0, 0, 0, 1]]}}, {spheres: "
                       "{data: [[0, 0, 0, 1]], material: c}}]\n"
                       "      material: a\n"
                       "  - " SPHERE "}\n"
                       "materials: {c: {diffuse: 0.3}, b: {diffuse: 0.2}, a: {diffuse: 0.1}}\n");
    assert_int_equal(scene.objectCount, 8);
    const Object *o = scene.objects;
    assert_int_equal(o[3].kind, SHAPE_CSG);
    assert_int_equal(o[3].csg.partCount, 3);
    const Object *p = o[3].csg.parts;
    assert_int_equal(p[2].kind, SHAPE_CSG); /* a group among the parts of a solid is a part */
    const Object *leaves[] = {&o[0], &o[1], &o[2], &p[0], &p[1], &p[2].csg.parts[0],
                              &o[4], &o[5], &o[6], &o[7]};
    static const float expected[] = {0.1F, 0.2F, 0.1F, 0.3F, 0.4F, 0.2F, 0.5F, 0.5F, 0.3F, 0.8F};
    for (size_t i = 0; i < sizeof leaves / sizeof *leaves; i++)
        if (leaves[i]->material.diffuse.r != expected[i])
            fail_msg("leaf %zu: diffuse %g", i, (double)leaves[i]->material.diffuse.r);
    freeScene(&scene);
}

static void shadowsAreSwitchedOffForAll(void **state)
{
    (void)state;
    Scene scene = load("objects:\n"
                       "  - " SPHERE ", casts_shadow: false}\n"
                       "  - " SPHERE ", casts_shadow: true}\n"
                       "  - group:\n"
                       "      casts_shadow: false\n"
                       "      objects:\n"
                       "        - " SPHERE ", casts_shadow: true}\n"
                       "        - group: {objects: [{" SPHERE "}}]}\n"
                       "        - union: {objects: [{" SPHERE "}}]}\n"
                       "  - group: {objects: [{" SPHERE ", casts_shadow: false}}, {" SPHERE "}}]}\n"
                       "  - intersection: {casts_shadow: false, objects: [{" SPHERE "}}]}\n"
                       "  - intersection: {objects: [{" SPHERE "}}]}\n");
    static const bool expected[] = {true, false, true, true, true, true, false, true, false};
    assert_int_equal(scene.objectCount, 9);
    for (size_t i = 0; i < 9; i++)
        assert_int_equal(scene.objects[i].noShadow, expected[i]);
    assert_true(scene.objects[7].csg.parts[0].noShadow);
    freeScene(&scene);
}

/* ---- Solids ---- */

static void solidsHaveTheirPartsInTheWorld(void **state)
{
    (void)state;
    Scene scene = load("objects:\n"
                       "  - group:\n"
                       "      transform: [translate: [0, 0, 100]]\n"
                       "      objects:\n"
                       "        - difference:\n"
                       "            transform: [scale: 2]\n"
                       "            objects:\n"
                       "              - cube: {center: [0, 0, 0], size: 2}\n"
                       "              - " SPHERE ", transform: [translate: [1, 0, 0]]}\n"
                       "              - intersection:\n"
                       "                  objects:\n"
                       "                    - plane: {point: [0, 0, 0], normal: [0, 1, 0]}\n"
                       "                    - torus: {major_radius: 2, minor_radius: 1}\n"
                       "              - spheres: {data: [[0, 0, 0, 0.5], [0, 0, 0, 1]]}\n"
                       "        - union: {objects: [{" SPHERE "}}]}\n");
    assert_int_equal(scene.objectCount, 2);
    const Object *solid = &scene.objects[0];
    assert_int_equal(solid->kind, SHAPE_CSG);
    assert_int_equal(solid->csg.operation, CSG_DIFFERENCE);
    assert_int_equal(solid->line, 5);
    assert_null(solid->transform);
    assert_int_equal(solid->csg.partCount, 4);
    const Object *p = solid->csg.parts;
    assert_int_equal(p[0].kind, SHAPE_CUBE);
    assert_int_equal(p[1].kind, SHAPE_SPHERE);
    assertVector(placed(&p[0], 1, 1, 1), 2, 2, 102);
    assertVector(placed(&p[1], 1, 1, 1), 4, 2, 102);
    assert_int_equal(p[2].kind, SHAPE_CSG);
    assert_int_equal(p[2].csg.operation, CSG_INTERSECTION);
    assert_int_equal(p[2].csg.parts[0].kind, SHAPE_PLANE);
    assertVector(placed(&p[2].csg.parts[1], 1, 1, 1), 2, 2, 102);
    assert_int_equal(p[3].csg.operation, CSG_GROUP);
    assert_int_equal(p[3].csg.partCount, 2);
    assertVector(placed(&p[3].csg.parts[1], 1, 1, 1), 2, 2, 102);
    assert_int_equal(scene.objects[1].csg.operation, CSG_UNION);
    assertVector(placed(&scene.objects[1].csg.parts[0], 1, 1, 1), 1, 1, 101);

    /* What is inside: in the cube and in nothing of what is taken away. */
    assert_true(objectContains(solid, createVector(-1.9, 0.4, 98.1)));
    assert_false(objectContains(solid, createVector(-1.9, -0.4, 98.1))); /* below, in the torus */
    assert_false(objectContains(solid, createVector(0, 0, 101.9)));      /* in a sphere */
    assert_false(objectContains(solid, createVector(2, 0, 100)));
    assert_false(objectContains(solid, createVector(0, 0, 0)));
    freeScene(&scene);
}

static void glassInASolidHasOneIndex(void **state)
{
    (void)state;
    Scene scene = load("materials: {glass: {transmission: 0.9, ior: 1.5}}\n"
                       "objects:\n"
                       "  - difference:\n"
                       "      objects:\n"
                       "        - " SPHERE ", material: {ior: 7}}\n" /* opaque: its index plays no part */
                       "        - " SPHERE ", material: glass}\n"
                       "        - union: {material: glass, objects: [{" SPHERE "}}]}\n");
    assert_true(scene.objects[0].csg.material.ior == 1.5F);
    freeScene(&scene);
    /* Different ones in different solids, or in a group, are fine. */
    assert_true(loads("objects:\n"
                      "  - union: {objects: [{" SPHERE ", material: {transmission: 1, ior: 2}}}]}\n"
                      "  - union: {objects: [{" SPHERE ", material: {transmission: 1, ior: 3}}}]}\n"
                      "  - group: {objects: [{" SPHERE ", material: {transmission: 1, ior: 4}}}, {" SPHERE
                      ", material: {transmission: 1, ior: 5}}}]}\n"));
    assert_false(loads("objects:\n"
                       "  - union: {objects: [{" SPHERE ", material: {transmission: 1, ior: 2}}}, {" SPHERE
                       ", material: {transmission: 1, ior: 3}}}]}\n"));
}

static void countsOfPartsAreChecked(void **state)
{
    (void)state;
    assert_true(loads("objects: [{group: {objects: [{" SPHERE "}}]}}]"));
    assert_true(loads("objects: [{intersection: {objects: [{" SPHERE "}}]}}]"));
    assert_true(loads("objects: [{difference: {objects: [{" SPHERE "}}, {" SPHERE "}}]}}]"));
    assert_false(loads("objects: [{difference: {objects: [{" SPHERE "}}]}}]"));
    assert_false(loads("objects: [{group: {objects: []}}]"));
    assert_false(loads("objects: [{union: {objects: []}}]"));
}

/* 64 levels of YAML are 20 groups in one another with an object in the last. */
static void groupsMayBeDeep(void **state)
{
    (void)state;
    for (int depth = 15; depth < 30; depth++) {
        Text yaml = {0};
        textAppend(&yaml, "objects: [");
        for (int i = 0; i < depth; i++)
            textAppend(&yaml, "{group: {transform: [translate: [1, 0, 0]], objects: [");
        textAppend(&yaml, "{sphere: {center: [0, 0, 0], radius: 1}}");
        for (int i = 0; i < depth; i++)
            textAppend(&yaml, "]}}");
        textAppend(&yaml, "]");
        Scene scene;
        Diagnostics diagnostics = {0};
        Status status = loadSceneFromText(yaml.data, yaml.length, &scene, &diagnostics);
        /* The mapping, the list, three levels a group, and three for the sphere and its centre. */
        assert_int_equal(statusIsOk(&status), 2 + 3 * depth + 3 <= 64);
        if (statusIsOk(&status))
            assertVector(placed(&scene.objects[0], 0, 0, 0), depth, 0, 0);
        else
            assert_non_null(strstr(diagnostics.items[0].message, "deeper than 64"));
        diagnosticsFree(&diagnostics);
        freeScene(&scene);
        textFree(&yaml);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everyShapeIsRead),
        cmocka_unit_test(spheresAreSpheres),
        cmocka_unit_test(stepsActInTheirOrder),
        cmocka_unit_test(aChildActsBeforeItsGroups),
        cmocka_unit_test(theNearestMaterialWins),
        cmocka_unit_test(shadowsAreSwitchedOffForAll),
        cmocka_unit_test(solidsHaveTheirPartsInTheWorld),
        cmocka_unit_test(glassInASolidHasOneIndex),
        cmocka_unit_test(countsOfPartsAreChecked),
        cmocka_unit_test(groupsMayBeDeep),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
