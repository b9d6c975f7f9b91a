/* Materials of a scene file: every term and every pattern arrives, and the files that a scene names, pictures
 * and meshes and lists of spheres, are found beside it, wherever the program runs, and read once.
 */
#include "base/files.h"
#include "image/image.h"
#include "loaded_scene.h"
#include "scene/load.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static void assertColor(Color3f c, float r, float g, float b)
{
    assert_true(c.r == r && c.g == g && c.b == b);
}

/* ---- Terms ---- */

static void everyTermIsRead(void **state)
{
    (void)state;
    Scene scene =
        load("materials:\n"
             "  a: {diffuse: 0.125, specular: 0.25, shininess: 5, ambient: [1, 2, 3], emission: [4, 5, 6],\n"
             "      reflection: [0.1, 0.2, 0.3], transmission: 0.5, ior: 1.5, model: blinn_phong}\n"
             "objects:\n"
             "  - sphere: {center: [0, 0, -5], radius: 1, material: {diffuse: 1, model: simple}}\n"
             "  - sphere: {center: [0, 0, -5], radius: 1, material: {model: lambert}}\n"
             "  - sphere: {center: [0, 0, -5], radius: 1, material: {model: phong}}\n"
             "  - sphere: {center: [0, 0, -5], radius: 1, material: {}}\n"
             "  - sphere: {center: [0, 0, -5], radius: 1}\n"
             "  - sphere: {center: [0, 0, -5], radius: 1, material: a}\n");
    const Material *m = &scene.objects[5].material;
    assertColor(m->diffuse, 0.125F, 0.125F, 0.125F);
    assertColor(m->specular, 0.25F, 0.25F, 0.25F);
    assert_true(m->shininess == 5);
    assertColor(m->ambient, 1, 2, 3);
    assertColor(m->emission, 4, 5, 6);
    assertColor(m->reflection, 0.1F, 0.2F, 0.3F);
    assertColor(m->transmission, 0.5F, 0.5F, 0.5F);
    assert_true(m->ior == 1.5F);
    assert_null(m->pattern);
    static const ShadingModel models[] = {MODEL_SIMPLE,   MODEL_LAMBERT,  MODEL_PHONG,
                                          MODEL_OF_SCENE, MODEL_OF_SCENE, MODEL_BLINN_PHONG};
    for (size_t i = 0; i < 6; i++)
        assert_int_equal(scene.objects[i].material.model, models[i]);

    /* What is left out is as in a program's default material. */
    Material fallback = defaultMaterial();
    for (size_t i = 3; i < 5; i++) {
        m = &scene.objects[i].material;
        assertColor(m->ambient, fallback.ambient.r, fallback.ambient.g, fallback.ambient.b);
        assertColor(m->emission, 0, 0, 0);
        assertColor(m->reflection, 0, 0, 0);
        assertColor(m->transmission, 0, 0, 0);
        assert_true(m->ior == fallback.ior && m->ior == 1);
        assert_null(m->pattern);
    }
    freeScene(&scene);
}

/* Glass comes last, in the order of the file: of two surfaces at the same distance the first counts, and
 * glass on a floor, here looked at from straight above, shows the floor. */
static void transparentObjectsComeLast(void **state)
{
    (void)state;
    Scene scene =
        load("materials:\n"
             "  glass: {diffuse: 0, transmission: 0.5, ior: 1.5}\n"
             "objects:\n"
             "  - cube: {center: [0, 0.5, 0], size: 1, material: glass}\n"
             "  - cylinder: {base: [5, 0, 0], top: [5, 1, 0], radius: 0.5, material: glass}\n"
             "  - plane: {point: [0, 0, 0], normal: [0, 1, 0]}\n"
             "  - difference: {objects: [{sphere: {center: [0, 3, 0], radius: 1, material: glass}},\n"
             "                           {sphere: {center: [0, 4, 0], radius: 1}}]}\n"
             "  - cube: {center: [3, 0, 0], size: 1, material: {transmission: 1, model: simple}}\n");
    static const int lines[] = {6, 9, 4, 5, 7};
    assert_int_equal(scene.objectCount, 5);
    for (size_t i = 0; i < 5; i++)
        assert_int_equal(scene.objects[i].line, lines[i]);
    for (int x = 0; x <= 5; x += 5)
        for (int i = 0; i < 100; i++) {
            Vector3D from = createVector(x + 0.1, 0.7, 0.1),
                     to = createVector(x - 0.3 + 0.005 * i, 0, 0.003 * i);
            Vector3D way = subVectors(to, from);
            Intersection hit;
            assert_true(throwRayThroughScene(createRay(from, normalize(way)), scene, &hit));
            assert_true(hit.material.transmission.r == 0);
        }
    freeScene(&scene);
}

/* ---- Patterns ---- */

static void everyPatternIsRead(void **state)
{
    (void)state;
    Scene scene =
        load("materials:\n"
             "  a: {pattern: {checker: {colors: [[1, 0, 0], 0.25]}}}\n"
             "  b: {pattern: {checker: {colors: [0, 1], size: 0.5, transform: [translate: [1, 2, 3]]}}}\n"
             "  c: {pattern: {stripes: {colors: [0, 1]}}}\n"
             "  d: {pattern: {stripes: {colors: [0, 1], axis: y, size: 3}}}\n"
             "  e: {pattern: {gradient: {colors: [0, [0, 0, 2]], axis: z}}}\n"
             "  f: {pattern: {gradient: {colors: [0, 1], transform: []}}, diffuse: 0.5}\n"
             "objects:\n"
             "  - sphere: {center: [0, 0, -5], radius: 1, material: a}\n"
             "  - sphere: {center: [0, 0, -5], radius: 1, material: b}\n"
             "  - sphere: {center: [0, 0, -5], radius: 1, material: c}\n"
             "  - sphere: {center: [0, 0, -5], radius: 1, material: d}\n"
             "  - sphere: {center: [0, 0, -5], radius: 1, material: e}\n"
             "  - sphere: {center: [0, 0, -5], radius: 1, material: f}\n"
             "  - sphere: {center: [0, 0, -5], radius: 1, material: f}\n");
    const Pattern *p[7];
    for (size_t i = 0; i < 7; i++) {
        p[i] = scene.objects[i].material.pattern;
        assert_non_null(p[i]);
    }
    static const PatternKind kinds[] = {PATTERN_CHECKER, PATTERN_CHECKER,  PATTERN_STRIPES,
                                        PATTERN_STRIPES, PATTERN_GRADIENT, PATTERN_GRADIENT};
    static const double sizes[] = {1, 0.5, 1, 3, 1, 1};
    for (size_t i = 0; i < 6; i++) {
        assert_int_equal(p[i]->kind, kinds[i]);
        assert_true(p[i]->size == sizes[i]);
    }
    assertColor(p[0]->colors[0], 1, 0, 0);
    assertColor(p[0]->colors[1], 0.25F, 0.25F, 0.25F);
    assert_false(p[0]->hasTransform);
    assert_true(p[1]->hasTransform);
    assertVector(p[1]->transform.worldFromObject.translate, 1, 2, 3);
    assertVector(p[1]->transform.objectFromWorld.translate, -1, -2, -3);
    assertVector(p[2]->axis, 1, 0, 0);
    assertVector(p[3]->axis, 0, 1, 0);
    assertVector(p[4]->axis, 0, 0, 1);
    assertColor(p[4]->colors[1], 0, 0, 2);
    assertVector(p[5]->axis, 1, 0, 0);
    assert_ptr_equal(p[5], p[6]); /* one material, one pattern */
    freeScene(&scene);
}

/* ---- Files ---- */

/* A folder of its own with a scene in a folder in it. */
typedef struct Folder {
    char *path;
    char scene[600];
} Folder;

static Folder makeFolder(const char *yaml)
{
    Folder folder;
    Status status = makeTemporaryFolder(&folder.path);
    assert_true(statusIsOk(&status));
    char inner[500];
    snprintf(inner, sizeof inner, "%s/scenes/inner", folder.path);
    status = makeFolders(inner);
    assert_true(statusIsOk(&status));
    snprintf(folder.scene, sizeof folder.scene, "%s/scene.yaml", inner);
    status = writeWholeFile(folder.scene, yaml, strlen(yaml));
    assert_true(statusIsOk(&status));
    return folder;
}

static void writeFile(const Folder *folder, const char *name, const char *text)
{
    char path[600];
    snprintf(path, sizeof path, "%s/%s", folder->path, name);
    Status status = writeWholeFile(path, text, strlen(text));
    assert_true(statusIsOk(&status));
}

/* Two texels: the samples of the first are 0, half and all, of the second a quarter. */
static void writeTexture(const Folder *folder, const char *name, int bitDepth, Encoding encoding)
{
    char path[600];
    snprintf(path, sizeof path, "%s/%s", folder->path, name);
    Image image;
    Status status = createImage(2, 1, bitDepth, encoding, &image);
    assert_true(statusIsOk(&status));
    unsigned most = imageMaxSample(&image);
    const unsigned samples[6] = {0, most / 2, most, most / 4, most / 4, most / 4};
    for (int i = 0; i < 6; i++)
        image.samples[i] = (uint16_t)samples[i];
    status = writePng(path, &image, 1);
    assert_true(statusIsOk(&status));
    freeImage(&image);
}

static Scene loadFrom(const char *path)
{
    Scene scene;
    Diagnostics diagnostics = {0};
    Status status = loadScene(path, &scene, &diagnostics);
    if (!statusIsOk(&status))
        fail_msg("%s", status.message);
    diagnosticsFree(&diagnostics);
    return scene;
}

static void removeFiles(Folder *folder)
{
    removeFolder(folder->path);
    free(folder->path);
}

static void picturesBecomeLinearTexels(void **state)
{
    (void)state;
    Folder folder = makeFolder(
        "objects:\n"
        "  - sphere: {center: [0, 0, -5], radius: 1, material: {pattern: {image: {file: eight.png}}}}\n"
        "  - sphere: {center: [0, 0, -5], radius: 1, material: {pattern: {image: {file: eight-linear.png,\n"
        "      mapping: spherical, size: 2, transform: [scale: 3]}}}}\n"
        "  - sphere: {center: [0, 0, -5], radius: 1, material: {pattern: {image: {file: sixteen.png}}}}\n"
        "  - sphere: {center: [0, 0, -5], radius: 1, material: {pattern: {image: {file: "
        "../sixteen-linear.png, mapping: planar}}}}\n"
        "  - sphere: {center: [0, 0, -5], radius: 1, material: {pattern: {image: {file: eight.png, size: "
        "5}}}}\n");
    writeTexture(&folder, "scenes/inner/eight.png", 8, ENCODING_SRGB);
    writeTexture(&folder, "scenes/inner/eight-linear.png", 8, ENCODING_LINEAR);
    writeTexture(&folder, "scenes/inner/sixteen.png", 16, ENCODING_SRGB);
    writeTexture(&folder, "scenes/sixteen-linear.png", 16, ENCODING_LINEAR);
    Scene scene = loadFrom(folder.scene);
    const Pattern *p[5];
    for (size_t i = 0; i < 5; i++) {
        p[i] = scene.objects[i].material.pattern;
        assert_int_equal(p[i]->kind, PATTERN_IMAGE);
        assert_int_equal(p[i]->width, 2);
        assert_int_equal(p[i]->height, 1);
        assert_true(p[i]->texels[0].r == 0 && p[i]->texels[0].b == 1);
        assert_int_equal(p[i]->path[0], '/');
    }

    /* 8 bits are sRGB whatever the file says; 16 bits are what it says. */
    float half = srgbToLinear(127.0F / 255.0F), half16 = srgbToLinear(32767.0F / 65535.0F);
    assert_true(p[0]->texels[0].g == half && p[1]->texels[0].g == half);
    assert_true(p[2]->texels[0].g == half16);
    assert_true(p[3]->texels[0].g == 32767.0F / 65535.0F);
    assert_true(p[3]->texels[1].r == 16383.0F / 65535.0F);
    assert_true(!p[0]->isLinear && !p[1]->isLinear && !p[2]->isLinear && p[3]->isLinear);
    assert_int_equal(p[0]->mapping, MAPPING_PLANAR);
    assert_int_equal(p[1]->mapping, MAPPING_SPHERICAL);
    assert_true(p[1]->size == 2 && p[0]->size == 1 && p[4]->size == 5);
    assert_true(p[1]->hasTransform && p[1]->transform.worldFromObject.x.x == 3);

    /* The same file is read once. */
    assert_ptr_equal(p[0]->texels, p[4]->texels);
    assert_ptr_not_equal(p[0]->texels, p[1]->texels);
    freeScene(&scene);
    removeFiles(&folder);
}

static const char tetrahedron[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

static void meshesAreReadOnceAndFoundBesideTheScene(void **state)
{
    (void)state;
    Folder folder = makeFolder("objects:\n"
                               "  - mesh: {file: ../../models/a.obj}\n"
                               "  - mesh: {file: ../../models/a.obj, smooth: false}\n"
                               "  - mesh: {file: ../../models/a.obj, smooth: true, transform: [scale: 2]}\n"
                               "  - difference: {objects: [{mesh: {file: ../../models/a.obj}}, {sphere: "
                               "{center: [0, 0, 0], radius: 0.5}}]}\n");
    char models[600];
    snprintf(models, sizeof models, "%s/models", folder.path);
    Status status = makeFolders(models);
    assert_true(statusIsOk(&status));
    writeFile(&folder, "models/a.obj", tetrahedron);
    Scene scene = loadFrom(folder.scene);
    assert_int_equal(scene.objectCount, 4);
    assert_int_equal(scene.objects[0].kind, SHAPE_MESH);
    const MeshData *smooth = scene.objects[0].mesh.data, *flat = scene.objects[1].mesh.data;
    assert_int_equal(smooth->triangleCount, 4);
    assert_non_null(smooth->normals);
    assert_null(flat->normals);
    assert_ptr_equal(scene.objects[2].mesh.data, smooth);
    assert_ptr_equal(scene.objects[3].csg.parts[0].mesh.data, smooth);
    freeScene(&scene);

    /* The same from the folder of the scene, and from another one, by a relative path. */
    char before[1000], inner[600];
    assert_non_null(getcwd(before, sizeof before));
    snprintf(inner, sizeof inner, "%s/scenes/inner", folder.path);
    assert_int_equal(chdir(inner), 0);
    scene = loadFrom("scene.yaml");
    assert_int_equal(scene.objectCount, 4);
    freeScene(&scene);
    assert_int_equal(chdir(folder.path), 0);
    scene = loadFrom("scenes/inner/scene.yaml");
    assert_int_equal(scene.objectCount, 4);
    freeScene(&scene);

    /* A text without a file is in the working folder. */
    scene = load("objects: [{mesh: {file: models/a.obj}}]");
    assert_int_equal(scene.objects[0].mesh.data->triangleCount, 4);
    freeScene(&scene);
    assert_int_equal(chdir(before), 0);
    removeFiles(&folder);
}

static void listsOfSpheresAreRead(void **state)
{
    (void)state;
    Folder folder = makeFolder("objects:\n"
                               "  - spheres: {file: list.txt, material: {diffuse: 0.5}}\n"
                               "  - spheres: {file: list.txt, transform: [translate: [1, 0, 0]]}\n");
    writeFile(&folder, "scenes/inner/list.txt", "# x y z r\n1 2 3 4\n\n5 6 7 8\n");
    Scene scene = loadFrom(folder.scene);
    assert_int_equal(scene.objectCount, 4);
    assertVector(scene.objects[1].sphere.center, 5, 6, 7);
    assert_true(scene.objects[1].sphere.radius == 8);
    assert_true(scene.objects[1].material.diffuse.r == 0.5F);
    assert_int_equal(scene.objects[1].line, 2);
    assertVector(scene.objects[2].sphere.center, 1, 2, 3);
    assert_non_null(scene.objects[3].transform);
    assert_int_equal(scene.objects[3].line, 3);
    freeScene(&scene);
    removeFiles(&folder);
}

/* An absolute path is one; a file called - is a file. */
static void pathsAreTakenAsTheyAre(void **state)
{
    (void)state;
    Folder folder = makeFolder("objects: []\n");
    writeFile(&folder, "a.obj", tetrahedron);
    writeFile(&folder, "-", tetrahedron);
    char yaml[700], before[1000];
    snprintf(yaml, sizeof yaml, "objects: [{mesh: {file: '%s/a.obj'}}]", folder.path);
    Scene scene = load(yaml);
    assert_int_equal(scene.objects[0].mesh.data->triangleCount, 4);
    freeScene(&scene);
    assert_non_null(getcwd(before, sizeof before));
    assert_int_equal(chdir(folder.path), 0);
    scene = load("objects: [{mesh: {file: '-'}}]");
    assert_int_equal(scene.objects[0].mesh.data->triangleCount, 4);
    freeScene(&scene);
    assert_int_equal(chdir(before), 0);
    removeFiles(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everyTermIsRead),
        cmocka_unit_test(transparentObjectsComeLast),
        cmocka_unit_test(everyPatternIsRead),
        cmocka_unit_test(picturesBecomeLinearTexels),
        cmocka_unit_test(meshesAreReadOnceAndFoundBesideTheScene),
        cmocka_unit_test(listsOfSpheresAreRead),
        cmocka_unit_test(pathsAreTakenAsTheyAre),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
