/* test_explain.c - the parts of `explain` with a picture, each against numbers worked out by hand. */
#include "engine/engine.h"
#include "explain/evidence.h"
#include "explain/explain_picture.h"
#include "explain/light_change.h"
#include "explain/sample_rounding.h"
#include "explain/scene_lines.h"
#include "explain/search.h"
#include "explain/value_change.h"
#include "explain/view_change.h"
#include "loaded_scene.h"
#include "one_pixel.h"

#include <glob.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ---- Values ---- */

static const StoredFormat LINEAR = {16, ENCODING_LINEAR}, SRGB = {16, ENCODING_SRGB};
static const ValuePlace SURFACE = {.isSurface = true, .diffuse = {0.5f, 0.25f, 0}};
static const ValuePlace NO_SURFACE = {.isSurface = false};

/* Fail unless the linear colour 0.1, 0.2, 0.4 is stored as these samples, to half a step of 16 bits and the
 * roundings of float. */
static void assertStored(ValueChange change, StoredFormat format, ValuePlace place, double r, double g,
                         double b)
{
    const float linear[3] = {0.1f, 0.2f, 0.4f};
    const double expected[3] = {r, g, b};
    float stored[3];
    storedSamples(&change, format, &place, linear, stored);
    for (int i = 0; i < 3; i++)
        if (!(fabs((double)stored[i] - expected[i]) <= 0.6 / 65535))
            fail_msg("sample %d is %.9g, not %.9g", i, (double)stored[i], expected[i]);
}

/* The curve of IEC 61966-2-1, above its straight part. */
static double encode(double v)
{
    return 1.055 * pow(v, 1 / 2.4) - 0.055;
}

static double decode(double v)
{
    return pow((v + 0.055) / 1.055, 2.4);
}

static void testNeutralValues(void **state)
{
    (void)state;
    assertStored(neutralValueChange(), LINEAR, SURFACE, 0.1, 0.2, 0.4);
    assertStored(neutralValueChange(), SRGB, SURFACE, encode(0.1), encode(0.2), encode(0.4));
    /* The file's own steps. */
    assertStored(neutralValueChange(), (StoredFormat){8, ENCODING_LINEAR}, SURFACE, 26 / 255., 51 / 255.,
                 102 / 255.);
}

static void testValueMistakes(void **state)
{
    (void)state;
    ValueChange change = neutralValueChange();
    change.scale = 3;
    assertStored(change, LINEAR, SURFACE, 0.3, 0.6, 1);

    change = neutralValueChange();
    change.offset = 0.2f;
    assertStored(change, LINEAR, NO_SURFACE, 0.3, 0.4, 0.6);
    change.offsetPlace = OFFSET_ON_SURFACES;
    assertStored(change, LINEAR, SURFACE, 0.3, 0.4, 0.6);
    assertStored(change, LINEAR, NO_SURFACE, 0.1, 0.2, 0.4);
    change.offsetPlace = OFFSET_ON_DIFFUSE;
    assertStored(change, LINEAR, SURFACE, 0.2, 0.25, 0.4);
    assertStored(change, LINEAR, NO_SURFACE, 0.1, 0.2, 0.4);
    /* After the scale, and never below black. */
    change = neutralValueChange();
    change.scale = 2;
    change.offset = -0.3f;
    assertStored(change, LINEAR, SURFACE, 0, 0.1, 0.5);

    change = neutralValueChange();
    change.linearPower = 2;
    assertStored(change, LINEAR, SURFACE, 0.01, 0.04, 0.16);
    assertStored(change, SRGB, SURFACE, encode(0.01), encode(0.04), encode(0.16));
    change = neutralValueChange();
    change.storedPower = 2;
    assertStored(change, SRGB, SURFACE, pow(encode(0.1), 2), pow(encode(0.2), 2), pow(encode(0.4), 2));
    change = neutralValueChange();
    change.storedScale = 1.5f;
    assertStored(change, SRGB, SURFACE, 1.5 * encode(0.1), 1.5 * encode(0.2), 1.5 * encode(0.4));

    change = neutralValueChange();
    change.encoding = ENCODED_TWICE;
    assertStored(change, LINEAR, SURFACE, encode(0.1), encode(0.2), encode(0.4));
    assertStored(change, SRGB, SURFACE, encode(encode(0.1)), encode(encode(0.2)), encode(encode(0.4)));
    change.encoding = ENCODED_RIGHT;
    change.curvePower = 0.5f;
    assertStored(change, SRGB, SURFACE, sqrt(0.1), sqrt(0.2), sqrt(0.4));
    change.curvePower = 0;
    change.encoding = NOT_ENCODED;
    assertStored(change, SRGB, SURFACE, 0.1, 0.2, 0.4);
    assertStored(change, LINEAR, SURFACE, decode(0.1), decode(0.2), decode(0.4));

    change = neutralValueChange();
    change.channels[0] = 1;
    change.channels[1] = 2;
    change.channels[2] = 0;
    assertStored(change, LINEAR, SURFACE, 0.2, 0.4, 0.1);
}

static void testLevels(void **state)
{
    (void)state;
    /* Five levels: 0, 1/4, ... 0.4 lies between the second and the third. */
    ValueChange change = neutralValueChange();
    change.levels = 5;
    assertStored(change, LINEAR, SURFACE, 0, 0.25, 0.5);
    change.truncated = true;
    assertStored(change, LINEAR, SURFACE, 0, 0, 0.25);
    change.truncated = false;
    change.levelsLinear = true;
    assertStored(change, SRGB, SURFACE, 0, encode(0.25), encode(0.5));
    change.levelsLinear = false; /* 0.349, 0.485, 0.665 */
    assertStored(change, SRGB, SURFACE, 0.25, 0.5, 0.75);
}

static void testValuesThatAreNoNumbers(void **state)
{
    (void)state;
    const float linear[3] = {INFINITY, NAN, -1};
    float stored[3];
    ValueChange change = neutralValueChange();
    storedSamples(&change, SRGB, &SURFACE, linear, stored);
    assert_true(stored[0] == 1 && stored[1] == 0 && stored[2] == 0);
    change.scale = 0;
    storedSamples(&change, SRGB, &SURFACE, linear, stored);
    assert_true(stored[0] == 0 && stored[1] == 0 && stored[2] == 0);
}

/* ---- Views ---- */

static void assertPoint(ViewChange change, double x, double y)
{
    double foundX = 10, foundY = 5;
    changePoint(&change, 64, 48, &foundX, &foundY);
    if (!(fabs(foundX - x) < 1e-12 && fabs(foundY - y) < 1e-12))
        fail_msg("(10, 5) became (%g, %g), not (%g, %g)", foundX, foundY, x, y);
}

static void testViewMistakes(void **state)
{
    (void)state;
    ViewChange change = neutralViewChange();
    assertPoint(change, 10, 5);
    change.mirrored = true;
    assertPoint(change, 54, 5);
    change.flipped = true;
    assertPoint(change, 54, 43);
    change = neutralViewChange();
    change.shiftX = 0.5;
    change.shiftY = -1;
    assertPoint(change, 10.5, 4);
    change = neutralViewChange();
    change.scaleX = 2; /* 22 left of the middle become 44 */
    assertPoint(change, -12, 5);
    change.scaleY = 0.5;
    assertPoint(change, -12, 14.5);
}

/* ---- Light: the point (0, 0, -4) with N = V = (0, 0, 1), and a light at the distance 5 with N.L = 0.8, the
 * colour 25 and so 1 on arrival. Ambient 0.1, diffuse 0.4, highlight 0.5 * 0.8^2 = 0.32 ---- */

#define POINT_LIGHT "lights: [{point: {position: [3, 0, 0], color: 25}}]\n"
#define LIT_SPHERE                                                                                           \
    "objects:\n"                                                                                             \
    "  - sphere: {center: [0, 0, -5], radius: 1, material: {ambient: 0.1, diffuse: [0.5, 0.25, 0],"          \
    " specular: 0.5, shininess: 2}}\n"

/* Fail unless the ray along -z brings this colour with the change. */
static void assertLight(const char *yaml, LightChange change, double r, double g, double b)
{
    Scene scene = load(yaml);
    scene.render.ambient = createColor(1, 1, 1);
    CompiledScene *compiled;
    Status status = compileScene(&scene, 1, &compiled);
    assert_true(statusIsOk(&status));
    ChangedFinder finder;
    createChangedFinder(compiledFinder(compiled), &change, &finder);
    Ray ray = {.origin = createVector(0, 0, 0), .direction = createVector(0, 0, -1)};
    Media media = {.count = 0};
    RayCounts counts = {0};
    assertColorNear(traceRay(&finder.finder, &ray, &media, 1, &counts), r, g, b);
    freeCompiledScene(compiled);
    freeScene(&scene);
}

/* The same where all lights arrive with a factor. */
static void assertLightTimes(const char *yaml, LightChange change, double factor)
{
    assertLight(yaml, change, 0.1 + 0.72 * factor, 0.1 + 0.52 * factor, 0.1 + 0.32 * factor);
}

static void testShadowMistakes(void **state)
{
    (void)state;
    static const char BETWEEN[] = POINT_LIGHT LIT_SPHERE "  - sphere: {center: [1.5, 0, -2], radius: 0.3}\n";
    static const char UNASKED[] = POINT_LIGHT "render: {shadows: false}\n" LIT_SPHERE
                                              "  - sphere: {center: [1.5, 0, -2], radius: 0.3}\n";
    static const char BEHIND[] = POINT_LIGHT LIT_SPHERE "  - sphere: {center: [6, 0, 4], radius: 0.3}\n";
    LightChange change = neutralLightChange();
    assertLightTimes(BETWEEN, change, 0);
    assertLightTimes(UNASKED, change, 1);
    assertLightTimes(BEHIND, change, 1);
    change.shadows = SHADOWS_NONE;
    assertLightTimes(BETWEEN, change, 1);
    change.shadows = SHADOWS_UNASKED;
    assertLightTimes(UNASKED, change, 0);
    change.shadows = SHADOWS_TOO_LONG;
    assertLightTimes(BEHIND, change, 0);
    change = neutralLightChange();
    change.shadowlessLight = 1;
    assertLightTimes(BETWEEN, change, 1);
    change.shadowlessLight = 2;
    assertLightTimes(BETWEEN, change, 0);
}

static void testFalloffMistakes(void **state)
{
    (void)state;
    static const char SCENE[] = POINT_LIGHT LIT_SPHERE;
    static const char EVEN[] =
        "lights: [{point: {position: [3, 0, 0], color: 1, falloff: none}}]\n" LIT_SPHERE;
    static const char SUN[] = "lights: [{directional: {direction: [-3, 0, -4], color: 1}}]\n" LIT_SPHERE;
    LightChange change = neutralLightChange();
    assertLightTimes(SCENE, change, 1);
    assertLightTimes(EVEN, change, 1);
    change.falloff = FALLOFF_POWER;
    assertLightTimes(SCENE, change, 25);
    change.exponent = 1;
    assertLightTimes(SCENE, change, 5);
    assertLightTimes(EVEN, change, 0.2);
    assertLightTimes(SUN, change, 1); /* has no distance */
    change.exponent = 3;
    assertLightTimes(SCENE, change, 0.2);
    change.falloff = FALLOFF_POVRAY;
    assertLightTimes(SCENE, change, 50 / 26.);
    change.falloff = FALLOFF_ONE_MORE;
    assertLightTimes(SCENE, change, 25 / 26.);
    change.fadeDistance = 10;
    assertLightTimes(SCENE, change, 20);
    change.falloff = FALLOFF_POVRAY;
    assertLightTimes(SCENE, change, 40);
    change.falloff = FALLOFF_LINEAR;
    assertLightTimes(SCENE, change, 25 / 6.);
    change.falloff = FALLOFF_ALL_TERMS;
    assertLightTimes(SCENE, change, 25 / 31.);
}

static void testHighlightMistakes(void **state)
{
    (void)state;
    static const char SCENE[] = POINT_LIGHT LIT_SPHERE;
    static const char BLINN[] = "render: {model: blinn_phong}\n" POINT_LIGHT LIT_SPHERE;
    LightChange change = neutralLightChange();
    assertLight(BLINN, change, 0.95, 0.75, 0.55); /* (N.H)^2 = 0.9 */
    change.highlight = HIGHLIGHT_NONE;
    assertLight(SCENE, change, 0.5, 0.3, 0.1);
    change.highlight = HIGHLIGHT_OTHER_MODEL;
    assertLight(SCENE, change, 0.95, 0.75, 0.55);
    assertLight(BLINN, change, 0.82, 0.62, 0.42);
    change.highlight = HIGHLIGHT_NO_FALLOFF;
    assertLight(SCENE, change, 8.5, 8.3, 8.1);
    change.highlight = HIGHLIGHT_DIFFUSE;
    assertLight(SCENE, change, 0.66, 0.38, 0.1);

    change = neutralLightChange();
    change.shininessValue = 2;
    change.shininess = SHININESS_TIMES; /* 0.5 * 0.8^4 */
    assertLight(SCENE, change, 0.7048, 0.5048, 0.3048);
    change.shininessValue = 1;
    change.shininess = SHININESS_IS;
    assertLight(SCENE, change, 0.9, 0.7, 0.5);
    change.shininess = SHININESS_OF_ONE;
    change.shininessOf = 2;
    assertLight(SCENE, change, 0.9, 0.7, 0.5);
    change.shininessOf = 3;
    assertLight(SCENE, change, 0.82, 0.62, 0.42);
}

static void testNormalMistakes(void **state)
{
    (void)state;
    static const char SCENE[] = POINT_LIGHT LIT_SPHERE;
    /* The eye in the sphere: the same numbers at (0, 0, -5). */
    static const char INSIDE[] =
        "lights: [{point: {position: [3, 0, -1], color: 25}}]\n"
        "objects: [{sphere: {center: [0, 0, 0], radius: 5, material: {ambient: 0.1, diffuse: [0.5, 0.25, 0],"
        " specular: 0.5, shininess: 2}}}]\n";
    LightChange change = neutralLightChange();
    assertLightTimes(INSIDE, change, 1);
    change.normals = NORMALS_FLIPPED;
    assertLightTimes(SCENE, change, 0);
    change.normals = NORMALS_NOT_TURNED;
    assertLightTimes(SCENE, change, 1);
    assertLightTimes(INSIDE, change, 0);
    change.normals = NORMALS_FLAT; /* of a sphere nothing is interpolated */
    assertLightTimes(SCENE, change, 1);
}

static void testNegativeMistakes(void **state)
{
    (void)state;
    /* N.L = -0.8, and the sphere itself in the way. */
    static const char SCENE[] = "lights: [{point: {position: [3, 0, -8], color: 25}}]\n" LIT_SPHERE;
    LightChange change = neutralLightChange();
    assertLight(SCENE, change, 0.1, 0.1, 0.1);
    change.negative = NEGATIVE_SUBTRACTS;
    assertLight(SCENE, change, 0.1, 0.1, 0.1);
    change.backUnshadowed = true;
    assertLight(SCENE, change, -0.3, -0.1, 0.1);
    change.negative = NEGATIVE_ABSOLUTE; /* its highlight is on the other side */
    assertLight(SCENE, change, 0.5, 0.3, 0.1);
    change.negative = NEGATIVE_HIGHLIGHT;
    assertLight(SCENE, change, 0.1, 0.1, 0.1);
}

static void testStrengths(void **state)
{
    (void)state;
    static const char SCENE[] = POINT_LIGHT LIT_SPHERE;
    LightChange change = neutralLightChange();
    change.ambientScale = 3;
    assertLight(SCENE, change, 1.02, 0.82, 0.62);
    change = neutralLightChange();
    change.lightScale = 2;
    assertLightTimes(SCENE, change, 2);
    change.scaledLight = 1;
    assertLightTimes(SCENE, change, 2);
    change.scaledLight = 2;
    assertLightTimes(SCENE, change, 1);
    change = neutralLightChange();
    change.blockedLights = 1;
    assertLightTimes(SCENE, change, 0);
    change.blockedLights = 2;
    assertLightTimes(SCENE, change, 1);
}

/* What the shader returns towards v at the point above, whose triangle has another normal, (0.6, 0, 0.8). */
static Color3f shadeWith(const char *yaml, LightChange change, Vector3D v)
{
    Scene scene = load(yaml);
    scene.render.ambient = createColor(1, 1, 1);
    scene.render.shadows = false;
    CompiledScene *compiled;
    Status status = compileScene(&scene, 1, &compiled);
    assert_true(statusIsOk(&status));
    ChangedFinder finder;
    createChangedFinder(compiledFinder(compiled), &change, &finder);
    SurfacePoint point = {.object = &scene.objects[0],
                          .position = createVector(0, 0, -4),
                          .normal = createVector(0, 0, 1),
                          .flatNormal = createVector(-0.6, 0, -0.8)};
    RayCounts counts = {0};
    Color3f color = finder.finder.lightShader(&finder.finder, &point, &scene.objects[0].material, v, &counts);
    freeCompiledScene(compiled);
    freeScene(&scene);
    return color;
}

static void testFlatNormalsAndBackHighlights(void **state)
{
    (void)state;
    LightChange change = neutralLightChange();
    Vector3D v = createVector(0, 0, 1);
    assertColorNear(shadeWith(POINT_LIGHT LIT_SPHERE, change, v), 0.82, 0.62, 0.42);
    change.normals = NORMALS_FLAT; /* N = L = R, and R.V = 0.8 */
    assertColorNear(shadeWith(POINT_LIGHT LIT_SPHERE, change, v), 0.92, 0.67, 0.42);

    /* Behind the surface, seen along R = (-0.6, 0, -0.8). */
    static const char BEHIND[] = "lights: [{point: {position: [3, 0, -8], color: 25}}]\n" LIT_SPHERE;
    change = neutralLightChange();
    v = createVector(-0.6, 0, -0.8);
    assertColorNear(shadeWith(BEHIND, change, v), 0.1, 0.1, 0.1);
    change.negative = NEGATIVE_HIGHLIGHT;
    assertColorNear(shadeWith(BEHIND, change, v), 0.6, 0.6, 0.6);
    change.negative = NEGATIVE_SUBTRACTS;
    assertColorNear(shadeWith(BEHIND, change, v), -0.3, -0.1, 0.1);
}

static Framebuffer *drawWith(const SurfaceFinder *finder, int width, int height)
{
    Framebuffer *framebuffer = createFramebuffer(width, height);
    assert_non_null(framebuffer);
    RenderOptions options = {.threads = 2};
    Status status = renderWithFinder(finder, framebuffer, &options, NULL);
    assert_true(statusIsOk(&status));
    return framebuffer;
}

/* Call check for each scene of the course. */
static void forCourseScenes(void (*check)(Scene *scene, const char *path))
{
    glob_t found;
    assert_int_equal(glob("scenes/course/*.yaml", 0, NULL, &found), 0);
    assert_true(found.gl_pathc >= 10);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        Scene scene;
        Diagnostics diagnostics = {0};
        Status status = loadScene(found.gl_pathv[i], &scene, &diagnostics);
        assert_true(statusIsOk(&status));
        diagnosticsFree(&diagnostics);
        scene.image.height = scene.image.height * 80 / scene.image.width;
        scene.image.width = 80;
        check(&scene, found.gl_pathv[i]);
        freeScene(&scene);
    }
    globfree(&found);
}

static void checkNeutralChange(Scene *scene, const char *path)
{
    /* With light of its own too, so that the order of the sum is seen. */
    scene->render.ambient = createColor(0.1f, 0.2f, 0.3f);
    for (size_t i = 0; i < scene->objectCount; i++)
        scene->objects[i].material.ambient = createColor(0.7f, 0.9f, 0.3f);
    CompiledScene *compiled;
    Status status = compileScene(scene, 2, &compiled);
    assert_true(statusIsOk(&status));
    LightChange neutral = neutralLightChange();
    ChangedFinder changed;
    createChangedFinder(compiledFinder(compiled), &neutral, &changed);
    Framebuffer *right = drawWith(compiledFinder(compiled), 80, scene->image.height);
    Framebuffer *found = drawWith(&changed.finder, 80, scene->image.height);
    if (memcmp(right->pixels, found->pixels, 80 * (size_t)scene->image.height * sizeof *right->pixels) != 0)
        fail_msg("%s: the neutral change changes bits", path);
    freeFramebuffer(right);
    freeFramebuffer(found);
    freeCompiledScene(compiled);
}

static void testNeutralLightIsTheTracers(void **state)
{
    (void)state;
    forCourseScenes(checkNeutralChange);
}

/* ---- Evidence ---- */

/* Black, but for the first pixels, which are white. */
static Image makeImage(int width, int height, int whitePixels)
{
    Image image;
    Status status = createImage(width, height, 8, ENCODING_SRGB, &image);
    assert_true(statusIsOk(&status));
    for (int i = 0; i < 3 * whitePixels; i++)
        image.samples[i] = 255;
    return image;
}

/* Choose pixels, whose weights add up to all, and return how many; of them the white ones in *white. */
static size_t countEvidence(int whitePixels, size_t most, size_t *white)
{
    Image wrong = makeImage(20, 10, whitePixels), right = makeImage(20, 10, 0);
    Evidence evidence;
    bool *isDifferent = findDifferentPixels(&wrong, &right);
    assert_non_null(isDifferent);
    Status status = gatherEvidence(&wrong, isDifferent, NULL, most, &evidence);
    assert_true(statusIsOk(&status));
    free(isDifferent);
    double sum = 0, whiteSum = 0;
    *white = 0;
    for (size_t i = 0; i < evidence.count; i++) {
        const EvidencePixel *pixel = &evidence.pixels[i];
        bool isWhite = pixel->y * 20 + pixel->x < whitePixels;
        assert_true(pixel->samples[0] == (isWhite ? 1 : 0) && pixel->samples[2] == pixel->samples[0]);
        sum += (double)pixel->weight;
        whiteSum += isWhite ? (double)pixel->weight : 0;
        *white += isWhite;
    }
    assert_true(fabs(sum - 200) < 1e-3);
    assert_true(fabs(whiteSum - whitePixels) < 1e-3);
    size_t count = evidence.count;
    freeEvidence(&evidence);
    assert_null(evidence.pixels);
    freeImage(&wrong);
    freeImage(&right);
    return count;
}

static void testEvidence(void **state)
{
    (void)state;
    size_t white;
    /* Half of each kind; what one has not, the other gets; all, where all fit. */
    assert_int_equal(countEvidence(70, 40, &white), 40);
    assert_int_equal(white, 20);
    assert_int_equal(countEvidence(7, 40, &white), 40);
    assert_int_equal(white, 7);
    assert_int_equal(countEvidence(195, 40, &white), 40);
    assert_int_equal(white, 35);
    assert_int_equal(countEvidence(0, 40, &white), 40);
    assert_int_equal(countEvidence(200, 40, &white), 40);
    assert_int_equal(countEvidence(70, 200, &white), 200);
    assert_int_equal(white, 70);
    assert_int_equal(countEvidence(70, 100000, &white), 200);
}

/* ---- Rounding ---- */

/* Whether one-pixel pictures with these red samples differ. */
static bool differ(int aBits, Encoding aEncoding, unsigned aRed, int bBits, Encoding bEncoding, unsigned bRed)
{
    uint16_t aSamples[3] = {(uint16_t)aRed, 0, 0}, bSamples[3] = {(uint16_t)bRed, 0, 0};
    Image a = {.width = 1, .height = 1, .bitDepth = aBits, .encoding = aEncoding, .samples = aSamples};
    Image b = {.width = 1, .height = 1, .bitDepth = bBits, .encoding = bEncoding, .samples = bSamples};
    assert_int_equal(pixelsDiffer(&a, &b, 0), pixelsDiffer(&b, &a, 0));
    return pixelsDiffer(&a, &b, 0);
}

static void testRounding(void **state)
{
    (void)state;
    assert_false(differ(8, ENCODING_SRGB, 100, 8, ENCODING_SRGB, 101));
    assert_true(differ(8, ENCODING_SRGB, 100, 8, ENCODING_SRGB, 102));
    assert_false(differ(16, ENCODING_LINEAR, 100, 16, ENCODING_LINEAR, 101));
    assert_true(differ(16, ENCODING_LINEAR, 100, 16, ENCODING_LINEAR, 102));
    assert_false(differ(8, ENCODING_SRGB, 1, 16, ENCODING_SRGB, 640)); /* 257 is one step of 8 bits */
    assert_true(differ(8, ENCODING_SRGB, 1, 16, ENCODING_SRGB, 650));
    /* 188 is 0.5029, and the steps to both sides are 0.0045 wide there: 130 is 0.5098. */
    assert_false(differ(8, ENCODING_SRGB, 188, 8, ENCODING_LINEAR, 128));
    assert_false(differ(8, ENCODING_SRGB, 188, 8, ENCODING_LINEAR, 129));
    assert_true(differ(8, ENCODING_SRGB, 188, 8, ENCODING_LINEAR, 131));
    /* In the dark a step of the curve is little light, and a linear one is much. */
    assert_false(differ(8, ENCODING_SRGB, 13, 8, ENCODING_LINEAR, 1));
    assert_true(differ(16, ENCODING_SRGB, 3341, 16, ENCODING_LINEAR, 290)); /* 13/255 is 264 of 65535 */
}

/* ---- Remembered rays ---- */

static void testRayMemory(void **state)
{
    (void)state;
    /* A mirror, glass and two lamps, of which a sphere hides one in part. */
    Scene scene = load(
        "lights:\n"
        "  - point: {position: [3, 2, 0], color: 25}\n"
        "  - area: {center: [-3, 4, -2], edge_u: [1, 0, 0], edge_v: [0, 0, 1], samples: [2, 2], color: 9}\n"
        "objects:\n"
        "  - sphere: {center: [0, 0, -5], radius: 1.5, material: {reflection: 0.5, specular: 0.5}}\n"
        "  - sphere: {center: [1, 0.5, -3], radius: 0.5, material: {transmission: 0.7, ior: 1.5}}\n"
        "  - plane: {point: [0, -1, 0], normal: [0, 1, 0]}\n");
    CompiledScene *compiled;
    Status status = compileScene(&scene, 1, &compiled);
    assert_true(statusIsOk(&status));
    Truth truth;
    status = truthOfScene(compiledFinder(compiled), 2, &truth);
    assert_true(statusIsOk(&status));
    enum {
        COUNT = 200
    };
    EvidencePixel pixels[COUNT];
    for (int i = 0; i < COUNT; i++)
        pixels[i] = (EvidencePixel){.x = i % 20, .y = i / 20, .weight = 1};
    Evidence evidence = {.format = LINEAR, .width = 20, .height = 10, .pixels = pixels, .count = COUNT};
    PixelMemory memories[COUNT] = {{.hits = NULL}};
    LightChange changes[4] = {neutralLightChange(), neutralLightChange(), neutralLightChange(),
                              neutralLightChange()};
    changes[1].shadows = SHADOWS_TOO_LONG;
    changes[2].highlight = HIGHLIGHT_NONE;
    ViewChange view = neutralViewChange();
    for (int i = 0; i < 4; i++) {
        Prediction with, without;
        status = predictPixels(&truth, &evidence, memories, &view, &changes[i], false, &with);
        assert_true(statusIsOk(&status));
        status = predictPixels(&truth, &evidence, NULL, &view, &changes[i], false, &without);
        assert_true(statusIsOk(&status));
        assert_memory_equal(with.low[0], without.low[0], 3 * COUNT * sizeof(float));
        freePrediction(&with);
        freePrediction(&without);
    }
    size_t hits = 0, lights = 0;
    for (int i = 0; i < COUNT; i++) {
        hits += memories[i].hitCount;
        lights += memories[i].lightCount;
        freePixelMemory(&memories[i]);
    }
    assert_true(hits > COUNT && lights > COUNT);
    freeTruth(&truth);
    freeCompiledScene(compiled);
    freeScene(&scene);
}

static void testMisfit(void **state)
{
    (void)state;
    /* Two pixels, one white and one black, that stand for one and for three. */
    EvidencePixel pixels[2] = {{.weight = 1, .samples = {1, 1, 1}}, {.weight = 3}};
    Evidence evidence = {.format = LINEAR, .width = 4, .height = 1, .pixels = pixels, .count = 2};
    Prediction prediction;
    Status status = createPrediction(2, 2, &prediction);
    assert_true(statusIsOk(&status));
    for (int i = 0; i < 6; i++) {
        prediction.middle[i] = 0.5f;
        prediction.low[0][i] = prediction.high[0][i] = prediction.low[1][i] = prediction.high[1][i] = 0.5f;
    }
    ValueChange neutral = neutralValueChange();
    Misfit misfit = measureMisfit(&evidence, &prediction, &neutral, 1, INFINITY);
    assert_true(fabs(misfit.rmse - 0.5) < 1e-4 && misfit.plain == misfit.rmse && misfit.known == 1);

    /* What is above the limit need not be known, and what is below must. */
    misfit = measureMisfit(&evidence, &prediction, &neutral, 1, 0.49);
    assert_true(isinf(misfit.rmse));
    misfit = measureMisfit(&evidence, &prediction, &neutral, 1, 0.51);
    assert_true(fabs(misfit.rmse - 0.5) < 1e-4 && misfit.known == 1);

    /* A second way that is right for the black one: the nearer of the two counts. */
    for (int i = 3; i < 6; i++)
        prediction.low[1][i] = prediction.high[1][i] = 0;
    misfit = measureMisfit(&evidence, &prediction, &neutral, 1, INFINITY);
    assert_true(fabs(misfit.rmse - 0.25) < 1e-4 && misfit.plain == misfit.rmse);

    /* A range that holds the white one, whose middle is off by a half. */
    for (int i = 0; i < 3; i++)
        prediction.high[0][i] = 1;
    misfit = measureMisfit(&evidence, &prediction, &neutral, 1, INFINITY);
    assert_true(misfit.rmse == 0 && fabs(misfit.plain - 0.25) < 1e-4);

    /* Nothing is known of the black one. */
    prediction.low[0][3] = 1;
    prediction.high[0][3] = 0;
    misfit = measureMisfit(&evidence, &prediction, &neutral, 1, INFINITY);
    assert_true(misfit.rmse == 0 && misfit.known == 0.25);
    prediction.low[0][0] = 2;
    misfit = measureMisfit(&evidence, &prediction, &neutral, 1, INFINITY);
    assert_true(isinf(misfit.rmse) && misfit.known == 0);
    freePrediction(&prediction);
}

/* ---- Places and words ---- */

static void testKeyLines(void **state)
{
    (void)state;
    static const char SCENE[] = "# falloff: in a comment\n"
                                "render: {my_ambient: 1, ambient2: 1} # ambient: 3\n"
                                "lights:\n"
                                "  - point: {falloff: none,color: 3}\n"
                                "name#model: x\n"
                                "ambient: 1";
    assert_int_equal(findKeyLine(SCENE, "falloff"), 4);
    assert_int_equal(findKeyLine(SCENE, "color"), 4);
    assert_int_equal(findKeyLine(SCENE, "ambient"), 6);
    assert_int_equal(findKeyLine(SCENE, "lights"), 3);
    assert_int_equal(findKeyLine(SCENE, "none"), 0);
    assert_int_equal(findKeyLine(SCENE, "shadows"), 0);
    assert_int_equal(findKeyLine(SCENE, "model"), 5); /* # begins a comment only after a space */
    assert_int_equal(findKeyLine("", "model"), 0);
    assert_int_equal(findKeyLine("model:", "model"), 1);
    assert_int_equal(findKeyLine("model", "model"), 0);
}

static void assertPlace(const char *name, const char *text, const char *key, const char *expected)
{
    Text where = {0};
    appendPlace(name, text, key, "a formula", &where);
    assert_string_equal(textString(&where), expected);
    textFree(&where);
}

static void testPlaces(void **state)
{
    (void)state;
    static const char SCENE[] = "render: {samples: 2}\nlights: []\n";
    assertPlace("s.yaml", SCENE, "samples", "s.yaml:1: a formula");
    assertPlace("s.yaml", SCENE, "falloff", "s.yaml:2: a formula"); /* would stand in lights */
    assertPlace("s.yaml", SCENE, "shadows", "s.yaml:1: a formula");
    assertPlace("s.yaml", SCENE, "shininess", "a formula"); /* no materials */
    assertPlace("s.yaml", SCENE, "no such key", "a formula");
    assertPlace("s.yaml", SCENE, NULL, "a formula");
    assertPlace("s.yaml", NULL, "samples", "a formula");
    assertPlace(NULL, SCENE, "samples", "a formula");
}

static void testExplanations(void **state)
{
    (void)state;
    Explanations causes = {.before = 0.25};
    Text text = {0};
    writeExplanationsText(&causes, "They agree.", &text);
    assert_string_equal(textString(&text), "They agree.\n");
    textFree(&text);
    writeExplanationsJson(&causes, &text);
    assert_string_equal(textString(&text), "{\n  \"causes\": []\n}\n");
    textFree(&text);

    Explanation *told = addExplanation(&causes, CAUSE_NEGATIVE_LIGHT, 0.125);
    textAppend(&told->text, "it is \"dark\"");
    textAppend(&told->where, "line 3");
    told = addExplanation(&causes, CAUSE_UNKNOWN, 0.0625);
    textAppend(&told->text, "who knows");
    textAppend(&told->where, "anywhere");
    writeExplanationsText(&causes, "unused", &text);
    assert_string_equal(textString(&text), "difference: root mean square error 0.25\n"
                                           "\n1. negative_light: it is \"dark\"\n"
                                           "   look at: line 3\n"
                                           "   left after this: 0.125\n"
                                           "\n2. unknown: who knows\n"
                                           "   look at: anywhere\n"
                                           "   not explained: 0.0625\n");
    textFree(&text);
    writeExplanationsJson(&causes, &text);
    assert_non_null(strstr(textString(&text), "\"cause\": \"negative_light\",\n"
                                              "      \"residual\": 0.125,\n"
                                              "      \"text\": \"it is \\\"dark\\\"\",\n"
                                              "      \"where\": \"line 3\""));
    textFree(&text);

    /* More than there is room for replace the last one. */
    for (int i = 0; i < MAX_EXPLANATIONS + 3; i++) {
        told = addExplanation(&causes, CAUSE_GAMMA, i);
        assert_string_equal(textString(&told->text), "");
        textAppend(&told->text, "text");
    }
    assert_int_equal(causes.count, MAX_EXPLANATIONS);
    assert_int_equal(causes.items[0].cause, CAUSE_NEGATIVE_LIGHT);
    assert_true(causes.items[MAX_EXPLANATIONS - 1].residual == MAX_EXPLANATIONS + 2);
    freeExplanations(&causes);
    assert_int_equal(causes.count, 0);
    assert_string_equal(causeName(CAUSE_GAMMA), "gamma");
    assert_string_equal(causeName(CAUSE_ACNE), "acne");
    assert_string_equal(causeName(CAUSE_SCENE), "another scene");
    assert_string_equal(causeName(CAUSE_UNKNOWN), "unknown");
}

/* ---- The search ---- */

static Image draw(const Scene *scene)
{
    Framebuffer *framebuffer = createFramebuffer(scene->image.width, scene->image.height);
    assert_non_null(framebuffer);
    RenderOptions options = {.threads = 2};
    Status status = renderReference(scene, framebuffer, &options, NULL);
    assert_true(statusIsOk(&status));
    Image image;
    status = imageFromFramebuffer(framebuffer, 8, ENCODING_SRGB, 2, &image);
    assert_true(statusIsOk(&status));
    freeFramebuffer(framebuffer);
    return image;
}

/* Search for what turned the scene's picture into the wrong one. */
static Findings searchScene(const Scene *scene, const Image *wrong, const Image *right, Traits *traits)
{
    CompiledScene *compiled;
    Status status = compileScene(scene, 2, &compiled);
    assert_true(statusIsOk(&status));
    Truth truth;
    status = truthOfScene(compiledFinder(compiled), 2, &truth);
    assert_true(statusIsOk(&status));
    listTraits(scene, (StoredFormat){8, ENCODING_SRGB}, traits);
    assert_true(traits->count < MAX_TRAITS);
    Findings findings;
    status = searchCauses(&truth, wrong, right, NULL, traits, &findings);
    assert_true(statusIsOk(&status));
    freeTruth(&truth);
    freeCompiledScene(compiled);
    return findings;
}

static void checkOwnPicture(Scene *scene, const char *path)
{
    static Traits traits;
    Image image = draw(scene);
    Findings findings = searchScene(scene, &image, &image, &traits);
    if (findings.count != 0 || findings.before > 1e-6)
        fail_msg("%s: %d found in its own picture, before %g", path, findings.count, findings.before);
    PictureExplanation explanation;
    Status status = explainPictureOfScene(&image, scene, NULL, 2, &explanation);
    assert_true(statusIsOk(&status));
    assert_int_equal(explanation.causes.count, 0);
    assert_non_null(strstr(textString(&explanation.summary), "The pictures agree"));
    /* The right picture is handed out, stored as this one is. */
    assert_int_equal(explanation.right.bitDepth, image.bitDepth);
    assert_int_equal(explanation.right.encoding, image.encoding);
    size_t samples = 3 * (size_t)image.width * (size_t)image.height;
    assert_memory_equal(explanation.right.samples, image.samples, samples * sizeof *image.samples);
    freePictureExplanation(&explanation);
    freeImage(&image);
}

static void testOwnPictureHasNoCauses(void **state)
{
    (void)state;
    forCourseScenes(checkOwnPicture);
}

static void testSearchFindsWhatWasChanged(void **state)
{
    (void)state;
    static Traits traits;
    Scene scene = load("image: {width: 80, height: 60}\n" POINT_LIGHT LIT_SPHERE);
    Image right = draw(&scene);
    scene.objects[0].material.shininess = 9;
    Image wrong = draw(&scene);
    scene.objects[0].material.shininess = 2;
    Findings findings = searchScene(&scene, &wrong, &right, &traits);
    assert_int_equal(findings.count, 1);
    assert_int_equal(findings.items[0].trait->cause, CAUSE_SHININESS);
    assert_true(fabs(findings.items[0].number - 9) < 0.1);
    assert_true(findings.items[0].residual < 0.5 / 255 && findings.before > 8.0 / 255);
    freeImage(&wrong);

    /* Of one colour, it could be nearly any values and views. */
    wrong = makeImage(80, 60, 80 * 60);
    findings = searchScene(&scene, &wrong, &right, &traits);
    assert_int_equal(findings.count, 0);
    freeImage(&wrong);
    freeImage(&right);
    freeScene(&scene);
}

/* A shininess in a part of a solid is one that can be wrong; the same one twice is one. */
static void testTraitsOfSolids(void **state)
{
    (void)state;
    static Traits traits;
    Scene scene = load("lights: [{point: {position: [0, 5, 0], color: 10}}]\n"
                       "objects:\n"
                       "  - sphere: {center: [3, 0, -5], radius: 1, material: {specular: 1, shininess: 20}}\n"
                       "  - sphere: {center: [5, 0, -5], radius: 1, material: {shininess: 7}}\n"
                       "  - union:\n"
                       "      objects:\n"
                       "        - sphere: {center: [0, 0, -5], radius: 1, material: {specular: 1, shininess: "
                       "20}}\n"
                       "        - sphere: {center: [1, 0, -5], radius: 1, material: {specular: 1, shininess: "
                       "90}}\n");
    listTraits(&scene, (StoredFormat){8, ENCODING_SRGB}, &traits);
    float groups[MAX_TRAITS];
    size_t count = 0;
    for (size_t i = 0; i < traits.count; i++)
        if (traits.items[i].cause == CAUSE_SHININESS && traits.items[i].choice == SHININESS_OF_ONE)
            groups[count++] = traits.items[i].group;
    assert_int_equal(count, 2);
    assert_true(groups[0] == 20 && groups[1] == 90);
    freeScene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(testNeutralValues),
        cmocka_unit_test(testValueMistakes),
        cmocka_unit_test(testLevels),
        cmocka_unit_test(testValuesThatAreNoNumbers),
        cmocka_unit_test(testViewMistakes),
        cmocka_unit_test(testShadowMistakes),
        cmocka_unit_test(testFalloffMistakes),
        cmocka_unit_test(testHighlightMistakes),
        cmocka_unit_test(testNormalMistakes),
        cmocka_unit_test(testNegativeMistakes),
        cmocka_unit_test(testStrengths),
        cmocka_unit_test(testFlatNormalsAndBackHighlights),
        cmocka_unit_test(testNeutralLightIsTheTracers),
        cmocka_unit_test(testEvidence),
        cmocka_unit_test(testRounding),
        cmocka_unit_test(testRayMemory),
        cmocka_unit_test(testMisfit),
        cmocka_unit_test(testKeyLines),
        cmocka_unit_test(testPlaces),
        cmocka_unit_test(testExplanations),
        cmocka_unit_test(testOwnPictureHasNoCauses),
        cmocka_unit_test(testSearchFindsWhatWasChanged),
        cmocka_unit_test(testTraitsOfSolids),
    };
    return cmocka_run_group_tests_name("explain with a picture", tests, NULL, NULL);
}
