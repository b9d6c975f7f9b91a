/* test_explain_parts.c - mistakes in one object, one material or one lamp: planted in a scene, found from its
 * picture; and what is left alone. */
#include "engine/engine.h"
#include "explain/downhill.h"
#include "explain/part_fit.h"
#include "explain/part_search.h"
#include "explain/part_words.h"
#include "explain/scene_lines.h"
#include "loaded_scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* ---- Scenes with a planted mistake ---- */

/* Two spheres of one material, a third one, a floor and a mirror; two lamps, both with shadows. */
static const char SCENE[] =
    "image: {width: 120, height: 90}\n"
    "camera: {position: [0, 0.5, 2], look_at: [0, 0, -5], fov: 55}\n"
    "materials:\n"
    "  shiny: {diffuse: [0.8, 0.3, 0.1], specular: [0.5, 0.5, 0.5], shininess: 20}\n"
    "lights:\n"
    "  - point: {position: [-3, 4, 1], color: [20, 18, 16]}\n"
    "  - point: {position: [4, 3, -1], color: [8, 9, 12]}\n"
    "objects:\n"
    "  - plane: {point: [0, -1, 0], normal: [0, 1, 0], material: {diffuse: [0.6, 0.6, 0.5]}}\n"
    "  - sphere: {center: [-1.5, 0, -5], radius: 1, material: shiny}\n"
    "  - sphere: {center: [1, -0.4, -4], radius: 0.6, material: shiny}\n"
    "  - sphere: {center: [0.2, 1, -6], radius: 0.7, material: {diffuse: [0.1, 0.3, 0.7], specular: 0.4}}\n"
    "  - box: {min: [2, -1, -6], max: [2.4, 1, -4], material: {diffuse: 0.2, reflection: 0.5}}\n";

enum {
    FLOOR,
    LEFT,
    RIGHT,
    FAR,
    MIRROR
};

static Image draw(const Scene *scene, int bitDepth)
{
    Framebuffer *framebuffer = createFramebuffer(scene->image.width, scene->image.height);
    assert_non_null(framebuffer);
    RenderOptions options = {.threads = 2};
    Status status = renderReference(scene, framebuffer, &options, NULL);
    assert_true(statusIsOk(&status));
    Image image;
    status = imageFromFramebuffer(framebuffer, bitDepth, ENCODING_SRGB, 2, &image);
    assert_true(statusIsOk(&status));
    freeFramebuffer(framebuffer);
    return image;
}

/* What is found, and what is said of it. */
typedef struct Found {
    PartFinding finding;
    Explanations causes;
} Found;

static Scene original; /* the materials of what was found point into it */

/* Load the scene, let plant make a mistake in it, and look for the mistake in the picture. */
static Found findPlanted(const char *yaml, void (*plant)(Scene *scene), int bitDepth)
{
    original = load(yaml);
    Scene wrong = load(yaml);
    plant(&wrong);
    Image picture = draw(&wrong, bitDepth), right = draw(&original, bitDepth);
    CompiledScene *compiled;
    Status status = compileScene(&original, 2, &compiled);
    assert_true(statusIsOk(&status));
    Truth truth;
    status = truthOfScene(compiledFinder(compiled), 2, &truth);
    assert_true(statusIsOk(&status));
    Found found = {.causes = {.count = 0}};
    status = findPart(&truth, &picture, &right, &found.finding);
    assert_true(statusIsOk(&status));
    if (found.finding.isFound) {
        SceneSource source = {.name = "scene.yaml", .text = yaml};
        tellPart(&found.finding, &original, &source, &found.causes);
    }
    freeTruth(&truth);
    freeCompiledScene(compiled);
    freeImage(&picture);
    freeImage(&right);
    freeScene(&wrong);
    return found;
}

static void freeFound(Found *found)
{
    freeExplanations(&found->causes);
    freePartFinding(&found->finding);
    freeScene(&original);
}

/* Fail unless the mistake is told like this and leaves nothing but rounding. where: how it begins. */
static void assertTold(void (*plant)(Scene *scene), Cause cause, const char *text, const char *where)
{
    for (int bitDepth = 8; bitDepth <= 16; bitDepth += 8) {
        Found found = findPlanted(SCENE, plant, bitDepth);
        if (!found.finding.isFound)
            fail_msg("not found in %d bits: %s", bitDepth, text);
        const Explanation *told = &found.causes.items[0];
        assert_string_equal(textString(&told->text), text);
        if (strncmp(textString(&told->where), where, strlen(where)) != 0)
            fail_msg("told to look at %s", textString(&told->where));
        assert_int_equal(told->cause, cause);
        if (!(told->residual < 0.3 / 255))
            fail_msg("%s leaves %g", text, told->residual);
        freeFound(&found);
    }
}

/* ---- Objects ---- */

static void removeRight(Scene *scene)
{
    scene->objects[RIGHT] = scene->objects[--scene->objectCount];
}

static void shadowlessLeft(Scene *scene)
{
    scene->objects[LEFT].noShadow = true;
}

static void noHighlightOnFar(Scene *scene)
{
    scene->objects[FAR].material.specular = createColor(0, 0, 0);
}

static void noHighlightOnShiny(Scene *scene)
{
    scene->objects[LEFT].material.specular = createColor(0, 0, 0);
    scene->objects[RIGHT].material.specular = createColor(0, 0, 0);
}

static void otherShininessOfLeft(Scene *scene)
{
    scene->objects[LEFT].material.shininess = 60;
}

static void blinnOnLeft(Scene *scene)
{
    scene->objects[LEFT].material.model = MODEL_BLINN_PHONG;
}

static void nothingMirrored(Scene *scene)
{
    scene->objects[MIRROR].material.reflection = createColor(0, 0, 0);
}

static void testObjects(void **state)
{
    (void)state;
    assertTold(removeRight, CAUSE_SCENE, "it is as if the sphere of line 11 were not there",
               "scene.yaml:11: ");
    assertTold(shadowlessLeft, CAUSE_SHADOW,
               "the sphere of line 10 throws no shadow; those of the other objects are right",
               "scene.yaml:10: a light counts if nothing lies strictly between");
    assertTold(noHighlightOnFar, CAUSE_SPECULAR,
               "the highlight is missing on the sphere of line 12; the others are there",
               "scene.yaml:12: Ispec");
    assertTold(noHighlightOnShiny, CAUSE_SPECULAR,
               "the highlight is missing on the sphere of line 10 and the other object of its material; the "
               "others are there",
               "scene.yaml:10: Ispec");
    assertTold(otherShininessOfLeft, CAUSE_SHININESS,
               "the highlight is that of shininess 60 where the scene says 20, on the sphere of line 10",
               "scene.yaml:10: Ispec");
    assertTold(
        blinnOnLeft, CAUSE_BLINN,
        "the highlight is Blinn's, (N.H)^shininess, where the scene asks for Phong's, (R.V)^shininess, "
        "on the sphere of line 10",
        "scene.yaml:10: Ispec");
    assertTold(nothingMirrored, CAUSE_SCENE, "it is as if nothing were mirrored in the box of line 13",
               "scene.yaml:13: ");
}

static void blackFar(Scene *scene)
{
    scene->objects[FAR].material = createMaterial(createColor(0, 0, 0), createColor(0, 0, 0), 1);
}

/* Two mistakes that give the same picture are both told. */
static void testWhatCannotBeToldApart(void **state)
{
    (void)state;
    Found found = findPlanted(SCENE, blackFar, 8);
    assert_true(found.finding.isFound && found.finding.hasOther);
    const char *text = textString(&found.causes.items[0].text);
    assert_non_null(strstr(text, "(the picture would be the same if this were so: "));
    assert_non_null(strstr(text, "the normals point into the sphere of line 12"));
    assert_non_null(strstr(text, "the sphere of line 12 had diffuse about [0, 0, 0]"));
    freeFound(&found);
}

/* ---- Colours ---- */

static void otherDiffuseOfShiny(Scene *scene)
{
    scene->objects[LEFT].material.diffuse = createColor(0.2f, 0.3f, 0.9f);
    scene->objects[RIGHT].material.diffuse = createColor(0.2f, 0.3f, 0.9f);
}

static void otherSpecularOfFar(Scene *scene)
{
    scene->objects[FAR].material.specular = createColor(0.9f, 0.2f, 0.4f);
}

static void glowingFar(Scene *scene)
{
    scene->objects[FAR].material.emission = createColor(0, 0.2f, 0.1f);
}

static void bluerLamp(Scene *scene)
{
    scene->lights[1].color = createColor(2, 9, 20);
}

static void dimmerLamp(Scene *scene)
{
    scene->lights[0].color = scaleColor(scene->lights[0].color, 0.5);
}

static void lampOff(Scene *scene)
{
    scene->lights[1].color = createColor(0, 0, 0);
}

static void bothLampsOther(Scene *scene)
{
    scene->lights[0].color = createColor(10, 18, 20);
    scene->lights[1].color = createColor(2, 9, 20);
}

static void evenLamp(Scene *scene)
{
    scene->lights[1].falloff = FALLOFF_NONE;
    scene->lights[1].color = createColor(8, 9, 12);
}

static void otherBackground(Scene *scene)
{
    scene->background.bottom = createColor(0.3f, 0.3f, 0.8f);
}

static void testColors(void **state)
{
    (void)state;
    assertTold(otherDiffuseOfShiny, CAUSE_SCENE,
               "it is as if the sphere of line 10 and the other object of its material had diffuse about "
               "[0.2, 0.3, 0.9] where the scene says [0.8, 0.3, 0.1]",
               "scene.yaml:10: diffuse in ");
    assertTold(otherSpecularOfFar, CAUSE_SPECULAR,
               "it is as if the sphere of line 12 had specular about [0.9, 0.2, 0.4] where the scene says "
               "[0.4, 0.4, 0.4]",
               "scene.yaml:12: specular in ");
    assertTold(glowingFar, CAUSE_SCENE,
               "it is as if the sphere of line 12 had a light of its own, ambient and emission, of about [0, "
               "0.2, 0.1] where the scene says [0, 0, 0]",
               "scene.yaml:12: color = ambient");
    assertTold(bluerLamp, CAUSE_SCENE,
               "light 2 (line 7) has about the color [2, 9, 20] where the scene says [8, 9, 12]",
               "scene.yaml:7: ");
    assertTold(dimmerLamp, CAUSE_EXPOSURE, "light 1 (line 6) is 0.5 times as bright as it should be",
               "scene.yaml:6: ");
    assertTold(lampOff, CAUSE_EXPOSURE, "light 2 (line 7) is off", "scene.yaml:7: ");
    assertTold(bothLampsOther, CAUSE_SCENE,
               "light 1 (line 6) has about the color [10, 18, 20] where the scene says [20, 18, 16]; light 2 "
               "(line 7) has about the color [2, 9, 20] where the scene says [8, 9, 12]",
               "scene.yaml:6: ");
    assertTold(evenLamp, CAUSE_FALLOFF,
               "light 2 (line 7) is as strong at any distance: its falloff is missing", "scene.yaml:7: ");
    assertTold(otherBackground, CAUSE_SCENE,
               "it is as if the background were about [0.3, 0.3, 0.8] where the scene says [0, 0, 0]",
               "background, which a ray sees");
}

/* A solid is changed in the part whose surface it is. */
static void redPart(Scene *scene)
{
    scene->objects[1].csg.parts[1].material.diffuse = createColor(0.9f, 0.1f, 0.1f);
}

static void testSolids(void **state)
{
    (void)state;
    static const char SOLID[] =
        "image: {width: 120, height: 90}\n"
        "lights: [{point: {position: [-3, 4, 1], color: 25}}]\n"
        "objects:\n"
        "  - plane: {point: [0, -1.5, 0], normal: [0, 1, 0]}\n"
        "  - difference:\n"
        "      objects:\n"
        "        - sphere: {center: [0, 0, -5], radius: 1.5, material: {diffuse: [0.8, 0.8, 0.2]}}\n"
        "        - sphere: {center: [-0.4, 0.4, -3.7], radius: 0.9, material: {diffuse: [0.2, 0.3, 0.4]}}\n";
    Found found = findPlanted(SOLID, redPart, 8);
    assert_true(found.finding.isFound);
    assert_string_equal(
        textString(&found.causes.items[0].text),
        "it is as if the sphere of line 8 in the difference of line 5 had diffuse about [0.9, "
        "0.1, 0.1] where the scene says [0.2, 0.3, 0.4]");
    assert_int_equal(countOfMaterial(&original, &original.objects[1].csg.parts[1].material), 1);
    freeFound(&found);
}

/* ---- Places ---- */

static void largerFar(Scene *scene)
{
    scene->objects[FAR].sphere.radius = 0.85;
}

static void movedFar(Scene *scene)
{
    scene->objects[FAR].sphere.center = createVector(0.6, 1.2, -5.8);
}

static void mirroredLamp(Scene *scene)
{
    scene->lights[0].position.x = 3;
}

static void testPlaces(void **state)
{
    (void)state;
    Found found = findPlanted(SCENE, largerFar, 8);
    assert_true(found.finding.isFound && found.finding.change.kind == PART_PLACE);
    assert_int_equal(found.finding.change.number, FAR);
    assert_true(fabs(found.finding.change.scale - 0.85 / 0.7) < 0.01);
    assert_true(norm(found.finding.change.offset) == 0);
    assert_non_null(strstr(textString(&found.causes.items[0].text), "radius 0.85"));
    freeFound(&found);

    found = findPlanted(SCENE, movedFar, 8);
    assert_true(found.finding.isFound && found.finding.change.kind == PART_PLACE);
    assert_int_equal(found.finding.change.number, FAR);
    assert_true(norm(subVectors(found.finding.change.offset, createVector(0.4, 0.2, 0.2))) < 0.05);
    freeFound(&found);

    found = findPlanted(SCENE, mirroredLamp, 8);
    assert_true(found.finding.isFound && found.finding.change.kind == PART_LAMP);
    assert_string_equal(textString(&found.causes.items[0].text),
                        "light 1 (line 6) shines from about [3, 4, 1] where the scene says [-3, 4, 1]");
    freeFound(&found);
}

/* ---- What is not claimed ---- */

static void severalThings(Scene *scene)
{
    scene->lights[0].position = createVector(1, 5, 3);
    scene->objects[LEFT].sphere.radius = 0.7;
    scene->objects[RIGHT].material.diffuse = createColor(0, 0.9f, 0.9f);
}

static void otherCamera(Scene *scene)
{
    scene->camera.position = createVector(1, 1, 2.5);
}

static void oneMoreSphere(Scene *scene)
{
    bool added = addSphereToScene(
        scene, createSphere(createVector(-0.3, -0.6, -3.5), 0.4,
                            createMaterial(createColor(0.2f, 0.8f, 0.2f), createColor(0, 0, 0), 1)));
    assert_true(added);
}

static void nothingAtAll(Scene *scene)
{
    (void)scene;
}

static void testWhatIsNotClaimed(void **state)
{
    (void)state;
    static void (*const plants[])(Scene *) = {severalThings, otherCamera, oneMoreSphere, nothingAtAll};
    for (size_t i = 0; i < sizeof plants / sizeof *plants; i++) {
        Found found = findPlanted(SCENE, plants[i], 8);
        if (found.finding.isFound)
            fail_msg("plant %zu: %s", i, textString(&found.causes.items[0].text));
        freeFound(&found);
    }
}

static void testOwners(void **state)
{
    (void)state;
    Found found = findPlanted(SCENE, oneMoreSphere, 8);
    const DifferenceOwners *owners = &found.finding.owners;
    /* The new sphere stands before the floor and hides some of the spheres behind it. */
    assert_true(owners->count >= 2 && owners->items[0].object == FLOOR);
    double sum = owners->onBackground;
    for (size_t i = 0; i < owners->count; i++) {
        assert_true(owners->items[i].differing <= owners->items[i].seen * (1 + 1e-6));
        assert_true(i == 0 || owners->items[i].differing <= owners->items[i - 1].differing);
        sum += owners->items[i].differing;
    }
    assert_true(fabs(sum - owners->differing) < 1e-6 * sum);
    Explanation told = {.cause = CAUSE_UNKNOWN};
    SceneSource source = {.name = "scene.yaml", .text = SCENE};
    tellOwners(owners, &original, &source, &told);
    assert_non_null(strstr(textString(&told.text), "; there the scene shows the plane of line 9 ("));
    assert_string_equal(textString(&told.where), ", scene.yaml:9");
    textFree(&told.text);
    textFree(&told.where);
    freeFound(&found);

    /* Who throws the shadow, and who is seen in the mirror. */
    found = findPlanted(SCENE, shadowlessLeft, 8);
    bool isBlocker = false;
    for (size_t i = 0; i < found.finding.owners.count; i++)
        isBlocker = isBlocker || (found.finding.owners.items[i].object == LEFT &&
                                  found.finding.owners.items[i].shaded > 10);
    assert_true(isBlocker);
    freeFound(&found);
}

/* ---- Numbers ---- */

static void testFittedColors(void **state)
{
    (void)state;
    /* Three pixels of two colours: the first is seen in the first two, the second in the last two, and not
     * at all in blue; the last pixel of the four is as bright as can be and must not count. */
    EvidencePixel pixels[4] = {{.weight = 1, .samples = {0.3f, 0.1f, 0.1f}},
                               {.weight = 2, .samples = {0.5f, 0.3f, 0.1f}},
                               {.weight = 1, .samples = {0.2f, 0.2f, 0}},
                               {.weight = 9, .samples = {1, 1, 1}}};
    Evidence evidence = {
        .format = {16, ENCODING_LINEAR}, .width = 4, .height = 1, .pixels = pixels, .count = 4};
    Prediction before, terms[2];
    Status status = createPrediction(4, 1, &before);
    for (int i = 0; i < 2 && statusIsOk(&status); i++)
        status = createPrediction(4, 1, &terms[i]);
    assert_true(statusIsOk(&status));
    for (int i = 0; i < 12; i++) {
        int pixel = i / 3, channel = i % 3;
        before.low[0][i] = 0;
        terms[0].low[0][i] = pixel != 2 ? 1 : 0;
        terms[1].low[0][i] = pixel != 0 && channel != 2 ? 1 : 0;
    }
    float added[2][3];
    bool isSeen[2][3];
    fitColors(&evidence, &before, terms, 2, added, isSeen);
    const float expected[2][3] = {{0.3f, 0.1f, 0.1f}, {0.2f, 0.2f, 0}};
    for (int i = 0; i < 2; i++)
        for (int c = 0; c < 3; c++) {
            assert_true(fabsf(added[i][c] - expected[i][c]) < 1e-5f);
            assert_int_equal(isSeen[i][c], i == 0 || c != 2);
        }
    freePrediction(&before);
    freePrediction(&terms[0]);
    freePrediction(&terms[1]);
}

/* A bowl with its lowest place at (1, -2, 0.5), and a count of how often it is looked at. */
static double bowl(void *context, const double numbers[MOST_NUMBERS])
{
    ++*(int *)context;
    double x = numbers[0] - 1, y = numbers[1] + 2, z = numbers[2] - 0.5;
    return x * x + 3 * y * y + 0.5 * z * z + 0.2 * x * y + 7;
}

static void testDownhill(void **state)
{
    (void)state;
    int looks = 0;
    Downhill downhill = {.measure = bowl,
                         .context = &looks,
                         .dimensions = 3,
                         .step = 0.3,
                         .turns = 300,
                         .hope = INFINITY,
                         .hopeTurns = 5};
    double numbers[MOST_NUMBERS] = {0, 0, 0, 42};
    double least = goDownhill(&downhill, numbers);
    assert_true(fabs(least - 7) < 1e-6);
    assert_true(fabs(numbers[0] - 1) < 1e-3 && fabs(numbers[1] + 2) < 1e-3 && fabs(numbers[2] - 0.5) < 1e-3);
    assert_true(numbers[3] == 42);
    /* Without hope it ends early, and where it is good enough too. */
    looks = 0;
    downhill.hope = 1;
    double start[MOST_NUMBERS] = {0, 0, 0, 0};
    goDownhill(&downhill, start);
    assert_true(looks < 35);
    looks = 0;
    downhill.enough = 100;
    double again[MOST_NUMBERS] = {0, 0, 0, 0};
    goDownhill(&downhill, again);
    assert_int_equal(looks, 4);
}

static void testItemLines(void **state)
{
    (void)state;
    static const char DASHES[] = "# lights:\n"
                                 "render: {model: phong}\n"
                                 "lights:   # two\n"
                                 "\n"
                                 "  - point:\n"
                                 "      position: [0, 0, 0]\n"
                                 "  # - point: {}\n"
                                 "  - spot: {position: [1, 2, 3]}\n"
                                 "objects:\n"
                                 "- sphere: {}\n"
                                 "- sphere: {}\n";
    assert_int_equal(findItemLine(DASHES, "lights", 0), 5);
    assert_int_equal(findItemLine(DASHES, "lights", 1), 8);
    assert_int_equal(findItemLine(DASHES, "lights", 2), 0);
    assert_int_equal(findItemLine(DASHES, "objects", 1), 11);
    assert_int_equal(findItemLine(DASHES, "objects", 2), 0);
    assert_int_equal(findItemLine(DASHES, "camera", 0), 0);
    static const char BRACKETS[] = "lights: [{point: {position: [-3, 1, 1]}}, # [ {\n"
                                   "  {point: {position: [3, 1, 1]}},\n"
                                   "  {point: {position: [3, 1, 1]}}]\n"
                                   "objects: [{sphere: {}}]\n";
    assert_int_equal(findItemLine(BRACKETS, "lights", 0), 1);
    assert_int_equal(findItemLine(BRACKETS, "lights", 1), 2);
    assert_int_equal(findItemLine(BRACKETS, "lights", 2), 3);
    assert_int_equal(findItemLine(BRACKETS, "lights", 3), 0);
    assert_int_equal(findItemLine("lights: [\n  {a: {}, b: {}},\n  {c: {}}]\n", "lights", 1), 3);
    assert_int_equal(findItemLine("", "lights", 0), 0);
    assert_int_equal(findItemLine("lights:", "lights", 0), 0);
    assert_int_equal(findItemLine("lights: [", "lights", 0), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(testObjects),          cmocka_unit_test(testColors),
        cmocka_unit_test(testSolids),           cmocka_unit_test(testPlaces),
        cmocka_unit_test(testWhatIsNotClaimed), cmocka_unit_test(testWhatCannotBeToldApart),
        cmocka_unit_test(testOwners),           cmocka_unit_test(testFittedColors),
        cmocka_unit_test(testDownhill),         cmocka_unit_test(testItemLines),
    };
    return cmocka_run_group_tests_name("explain: parts of a scene", tests, NULL, NULL);
}
