/* POV-Ray's habits: what each writes, that none is what `pov` writes, and that POV-Ray with a habit draws
 * what our own tracer draws with the same mistake. The last is skipped where there is no POV-Ray. */
#include "base/threads.h"
#include "engine/engine.h"
#include "explain/habits.h"
#include "file_checks.h"
#include "loaded_scene.h"
#include "povray/export.h"
#include "povray/run.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Every term that a habit can change: both highlights, in colour, a pattern, a mirror, glass, shadows. */
static const char everything[] =
    "image: {width: 96, height: 64, bit_depth: 16, encoding: linear}\n"
    "camera: {position: [0.5, 1, 2], direction: [-0.05, -0.2, -1], fov: 50}\n"
    "render: {ambient: [0.2, 0.1, 0.3]}\n"
    "background: [0.1, 0.2, 0.4]\n"
    "lights:\n"
    "  - point: {position: [-3, 4, 1], color: [9, 8, 7]}\n"
    "  - spot: {position: [3, 4, 0], look_at: [0, 0, -4], inner_angle: 20, outer_angle: 40, color: [6, 7, "
    "8]}\n"
    "  - directional: {direction: [1, -2, -1], color: [0.1, 0.1, 0.2]}\n"
    "objects:\n"
    "  - plane: {normal: [0, 1, 0], point: [0, -1, 0], material: {pattern: {checker: {colors: [[0.8, 0.7, "
    "0.6], "
    "[0.2, 0.3, 0.4]], size: 1.3}}, model: lambert}}\n"
    "  - sphere: {center: [0, 0, -4], radius: 1, material: {diffuse: [0.7, 0.1, 0], specular: [0.6, 0.3, "
    "0.1], "
    "shininess: 20, ambient: [0.3, 0.3, 0.3]}}\n"
    "  - sphere: {center: [1.6, -0.2, -3.5], radius: 0.7, material: {diffuse: [0, 0.3, 0.1], specular: 0.4, "
    "shininess: 40, model: blinn_phong, reflection: 0.3}}\n"
    "  - sphere: {center: [-1.6, -0.2, -3.2], radius: 0.7, material: {diffuse: [0.1, 0.1, 0.1], specular: "
    "[0.2, 0.4, 0.6], shininess: 12.5, transmission: [0.6, 0.5, 0.4], ior: 1.3, emission: [0.02, 0.01, "
    "0]}}\n";

static char *exported(const Scene *scene, unsigned habits)
{
    Text pov = {0};
    assertOk(exportPovWithHabits(scene, "a.pov", habits, &pov));
    return pov.data;
}

static bool says(const Scene *scene, unsigned habits, const char *words)
{
    char *pov = exported(scene, habits);
    bool found = strstr(pov, words) != NULL;
    free(pov);
    return found;
}

/* ---- The text ---- */

static void withoutHabitsItIsTheMatchedScene(void **state)
{
    (void)state;
    Scene scene = load(everything);
    Text matched = {0};
    assertOk(exportPov(&scene, "a.pov", &matched));
    char *pov = exported(&scene, 0);
    assert_string_equal(pov, textString(&matched));
    /* What does not apply is as if it were not there. */
    char *same = exported(&scene, POV_HABIT_AREA_LIGHT);
    assert_string_equal(same, textString(&matched));
    free(same);
    free(pov);
    textFree(&matched);
    freeScene(&scene);
}

static void eachHabitWritesItsLine(void **state)
{
    (void)state;
    Scene scene = load(everything);
    scene.objectCount--; /* with glass, lengths would have another scale */
    const struct {
        PovHabit habit;
        const char *with, *without;
    } lines[] = {
        {POV_HABIT_FALLOFF, "rgb <9, 8, 7>\n  fade_distance 1 fade_power 2", "rgb <9, 8, 7>*K"},
        {POV_HABIT_AMBIENT, "ambient_light rgb 1 }", "ambient_light rgb 0 }"},
        {POV_HABIT_AMBIENT, "finish { ambient 0.1 }", "emission 1"},
        {POV_HABIT_DIFFUSE, "finish { diffuse 0.6 }", "NEVER"},
        {POV_HABIT_HIGHLIGHT, "specular 1 roughness 1/20", "phong 1 phong_size 20"},
        {POV_HABIT_HIGHLIGHT, "phong 1 phong_size 40", "specular 1 roughness 1/40"},
        {POV_HABIT_HIGHLIGHT_COLOR, "NEVER", "rgb <2.4000000953674316, "},
        {POV_HABIT_GAMMA, "assumed_gamma 2.2 ", "assumed_gamma 1 "},
        {POV_HABIT_LEFT_HANDED, "\n  right x*96/64\n", "\n  direction "},
        {POV_HABIT_ANGLE, "\n  right -x*96/64\n  up y\n  angle 50\n", "\n  direction "},
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        bool isNever = strcmp(lines[i].with, "NEVER") == 0;
        assert_int_equal(says(&scene, lines[i].habit, lines[i].with), !isNever);
        assert_false(says(&scene, 0, lines[i].with));
        if (strcmp(lines[i].without, "NEVER") != 0)
            assert_true(says(&scene, 0, lines[i].without));
        assert_false(says(&scene, lines[i].habit, lines[i].without));
    }
    assert_true(says(&scene, POV_HABIT_FALLOFF | POV_HABIT_ANGLE, "// falloff angle\n"));
    assert_false(says(&scene, POV_HABIT_FALLOFF, "the same picture"));
    freeScene(&scene);
}

static void allTogetherLookAsWrittenByHand(void **state)
{
    (void)state;
    Scene scene = load("image: {width: 64, height: 48}\n"
                       "lights: [{point: {position: [-3, 0, 1], color: 5}}]\n"
                       "objects: [{sphere: {center: [0, 0, -5], radius: 1.5, material: {diffuse: [1, 0, 0], "
                       "specular: [0.75, 0.5, 0.25], shininess: 32, reflection: 0.25}}}]\n");
    assert_true(says(&scene, ALL_POV_HABITS,
                     "camera {\n  location <0, 0, 0>\n  right x*64/48\n  up y\n  angle 60\n"
                     "  sky <0, 1, 0>\n  look_at <0, 0, -1>\n}\n\n"
                     "light_source {\n  <-3, 0, 1>\n  rgb <5, 5, 5>\n  fade_distance 1 fade_power 2\n}\n\n"
                     "sphere { <0, 0, -5>, 1.5\n  texture { pigment { rgb <1, 0, 0> } finish { ambient 0.1 "
                     "diffuse 0.6 specular 0.5 roughness 1/32 reflection { rgb <0.25, 0.25, 0.25> } } }\n}"));
    freeScene(&scene);
}

static void anAreaLightKeepsItsGrid(void **state)
{
    (void)state;
    Scene scene =
        load("lights: [{area: {center: [0, 3, 0], edge_u: [2, 0, 0], edge_v: [0, 0, 1], samples: [4, 3], "
             "color: 12}}]\n"
             "objects: [{sphere: {center: [0, 0, -5], radius: 1}}]\n");
    assert_true(says(&scene, POV_HABIT_AREA_LIGHT,
                     "  <0, 3, 0>\n  rgb <12, 12, 12>*K\n  fade_distance D fade_power 2\n"
                     "  area_light <2, 0, 0>, <0, 0, 1>, 4, 3\n}"));
    assert_true(says(&scene, 0, "rgb <1, 1, 1>*K"));
    freeScene(&scene);
}

static unsigned applicable(const char *yaml)
{
    Scene scene = load(yaml);
    unsigned habits = applicablePovHabits(&scene);
    freeScene(&scene);
    return habits;
}

static void habitsThatChangeNothingDoNotApply(void **state)
{
    (void)state;
    unsigned camera = POV_HABIT_GAMMA | POV_HABIT_LEFT_HANDED;
    const char *sphere = "objects: [{sphere: {center: [0, 0, -5], radius: 1}}]\n";
    Text yaml = {0};
    textAppend(&yaml, sphere);
    assert_int_equal(applicable(textString(&yaml)), camera | POV_HABIT_ANGLE | POV_HABIT_AMBIENT);
    textAppend(&yaml, "image: {width: 40, height: 40}\n");
    assert_int_equal(applicable(textString(&yaml)), camera | POV_HABIT_AMBIENT);
    textAppend(&yaml, "lights: [{directional: {direction: [0, -1, 0], color: 1}}]\n");
    assert_int_equal(applicable(textString(&yaml)), camera | POV_HABIT_AMBIENT | POV_HABIT_DIFFUSE);
    textAppend(&yaml, "render: {model: simple}\n");
    assert_int_equal(applicable(textString(&yaml)), camera);
    textFree(&yaml);
    assert_int_equal(
        applicable("lights: [{point: {position: [0, 9, 0], color: 0}}]\n"
                   "camera: {"
                   "projection: orthographic, view_height: 3}\n"
                   "objects: [{sphere: {center: [0, 0, -5], radius: 1, material: {specular: 1}}}]\n"),
        camera | POV_HABIT_AMBIENT);
    assert_int_equal(
        applicable("lights: [{point: {position: [0, 9, 0], color: 1, falloff: none}}]\n"
                   "objects: [{sphere: {center: [0, 0, -5], radius: 1, material: {specular: 1}}}]\n"),
        camera | POV_HABIT_ANGLE | POV_HABIT_AMBIENT | POV_HABIT_DIFFUSE | POV_HABIT_HIGHLIGHT);
    Scene scene = load(everything);
    assert_int_equal(applicablePovHabits(&scene), ALL_POV_HABITS & ~POV_HABIT_AREA_LIGHT);
    freeScene(&scene);
}

/* ---- The same mistakes in our own tracer ---- */

/* A finder that asks another one, so that it can have a shader of its own. */
typedef struct MistakenFinder {
    SurfaceFinder finder;
    const SurfaceFinder *inner;
    unsigned habits;
} MistakenFinder;

static const Object *nearestOfInner(const SurfaceFinder *finder, const Ray *ray, Hit *hit)
{
    const SurfaceFinder *inner = ((const MistakenFinder *)finder)->inner;
    return inner->nearest(inner, ray, hit);
}

static Color3f lightOfInner(const SurfaceFinder *finder, const ShadowRay *shadow, Color3f color)
{
    const SurfaceFinder *inner = ((const MistakenFinder *)finder)->inner;
    return inner->lightAlong(inner, shadow, color);
}

/* The formulas of the habits, written down as they are. */
static Color3f mistakenLight(const SurfaceFinder *finder, const SurfacePoint *point, const Material *material,
                             Vector3D v, RayCounts *counts)
{
    (void)counts;
    const Scene *scene = finder->scene;
    unsigned habits = ((const MistakenFinder *)finder)->habits;
    ShadingModel model = materialModel(scene, material);
    Color3f kd = material->diffuse, ks = material->specular;
    Color3f sum = addColors(material->emission, multColors(material->ambient, scene->render.ambient));
    if ((habits & POV_HABIT_AMBIENT) != 0)
        sum = addColors(material->emission, scaleColor(kd, 0.1));
    if ((habits & POV_HABIT_HIGHLIGHT_COLOR) != 0) {
        float mean = (ks.r + ks.g + ks.b) / 3;
        ks = createColor(mean, mean, mean);
    }
    if (model < MODEL_PHONG)
        ks = createColor(0, 0, 0);
    for (size_t i = 0; i < scene->lightCount; i++) {
        Light light = scene->lights[i];
        bool falls = light.kind != LIGHT_DIRECTIONAL && light.falloff == FALLOFF_INVERSE_SQUARE;
        light.falloff = FALLOFF_NONE;
        ArrivingLight arriving = lightArriving(&light, 0, point->position);
        double cosine = dot(point->normal, arriving.direction), d = arriving.distance;
        if (!(cosine > 0))
            continue;
        if (falls)
            arriving.color =
                scaleColor(arriving.color, (habits & POV_HABIT_FALLOFF) != 0 ? 2 / (1 + d * d) : 1 / (d * d));
        ShadowRay shadow = shadowRayTo(scene, point, &arriving);
        Color3f color = finder->lightAlong(finder, &shadow, arriving.color);
        sum = addColors(sum, multColors(scaleColor(kd, (habits & POV_HABIT_DIFFUSE) != 0 ? 0.6 : 1),
                                        scaleColor(color, cosine)));
        Vector3D n = point->normal, l = arriving.direction;
        double mirrored = dot(subVectors(multVector(n, 2 * dot(n, l)), l), v);
        double halfway = dot(n, normalize(addVectors(l, v)));
        bool isPhong = (model == MODEL_PHONG) != ((habits & POV_HABIT_HIGHLIGHT) != 0);
        double base = fmax(0, isPhong ? mirrored : halfway);
        sum = addColors(sum, multColors(ks, scaleColor(color, pow(base, (double)material->shininess))));
    }
    return sum;
}

/* Left for right. */
static void mirrorFramebuffer(Framebuffer *framebuffer)
{
    for (int y = 0; y < framebuffer->height; y++) {
        Color3f *row = framebuffer->pixels + (size_t)y * (size_t)framebuffer->width;
        for (int x = 0; x < framebuffer->width / 2; x++) {
            Color3f left = row[x];
            row[x] = row[framebuffer->width - 1 - x];
            row[framebuffer->width - 1 - x] = left;
        }
    }
}

static float toPower(float value)
{
    return powf(fmaxf(value, 0), 2.2f);
}

static Image drawWithMistakes(const Scene *original, unsigned habits)
{
    const double pi = 3.14159265358979323846;
    Scene scene = *original;
    int width = scene.image.width, height = scene.image.height;
    /* As many degrees across as are meant from top to bottom. */
    if ((habits & POV_HABIT_ANGLE) != 0)
        scene.camera.fov = 2 * atan(tan(scene.camera.fov * pi / 360) * height / width) * 180 / pi;
    CompiledScene *compiled;
    assertOk(compileScene(&scene, 1, &compiled));
    MistakenFinder finder = {.finder = {.scene = &scene,
                                        .nearest = nearestOfInner,
                                        .lightAlong = lightOfInner,
                                        .lightShader = mistakenLight},
                             .inner = compiledFinder(compiled),
                             .habits = habits};
    Framebuffer *framebuffer = createFramebuffer(width, height);
    assert_non_null(framebuffer);
    RenderOptions options = {.threads = 1};
    assertOk(renderWithFinder(&finder.finder, framebuffer, &options, NULL));
    freeCompiledScene(compiled);
    if ((habits & POV_HABIT_LEFT_HANDED) != 0)
        mirrorFramebuffer(framebuffer);
    for (int i = 0; i < width * height && (habits & POV_HABIT_GAMMA) != 0; i++) {
        Color3f *pixel = &framebuffer->pixels[i];
        *pixel = createColor(toPower(pixel->r), toPower(pixel->g), toPower(pixel->b));
    }
    Image image;
    assertOk(imageFromFramebuffer(framebuffer, 16, ENCODING_LINEAR, 1, &image));
    freeFramebuffer(framebuffer);
    return image;
}

/* ---- Beside POV-Ray ---- */

enum {
    MOST_SETS = 32
};

typedef struct Sets {
    const Scene *scene;
    unsigned habits[MOST_SETS];
    size_t count;
    Status statuses[MOST_SETS];
    Image pictures[MOST_SETS];
} Sets;

static void drawSet(void *context, size_t number)
{
    Sets *sets = context;
    PovraySettings settings = {.width = sets->scene->image.width,
                               .height = sets->scene->image.height,
                               .bitDepth = 16,
                               .encoding = ENCODING_LINEAR,
                               .samples = 1,
                               .threads = 1,
                               .timeoutSeconds = 60};
    Text pov = {0};
    Status status = exportPovWithHabits(sets->scene, "a.pov", sets->habits[number], &pov);
    if (statusIsOk(&status))
        status = runPovray(textString(&pov), &settings, &sets->pictures[number]);
    sets->statuses[number] = status;
    textFree(&pov);
}

/* Fail unless POV-Ray's picture and ours are the same for each set, but for this many pixels on edges. */
static void assertSetsAgree(Sets *sets, size_t allowed)
{
    assertOk(runTasks(sets->count, 8, drawSet, sets));
    for (size_t i = 0; i < sets->count; i++) {
        assertOk(sets->statuses[i]);
        Image ours = drawWithMistakes(sets->scene, sets->habits[i]);
        Metrics metrics;
        assertOk(measureImages(&ours, &sets->pictures[i], HABIT_STEP * 1.01, 1, &metrics));
        if (metrics.differingPixels > allowed)
            fail_msg("habits %x: %zu pixels differ, the worst (%d, %d) by %d/65535", sets->habits[i],
                     metrics.differingPixels, metrics.worst.x, metrics.worst.y,
                     (int)lround(metrics.maxDifference * 65535));
        freeImage(&ours);
        freeImage(&sets->pictures[i]);
    }
}

static void skipWithoutPovray(void)
{
    Status status = findPovray();
    if (!statusIsOk(&status)) {
        print_message("POV-Ray is not installed\n");
        skip();
    }
}

static void povrayMakesTheSameMistakes(void **state)
{
    (void)state;
    skipWithoutPovray();
    Scene scene = load(everything);
    Sets sets = {.scene = &scene};
    unsigned habits = applicablePovHabits(&scene);
    sets.habits[sets.count++] = 0;
    sets.habits[sets.count++] = habits;
    for (unsigned bit = 1; bit < ALL_POV_HABITS; bit <<= 1) {
        if ((habits & bit) == 0)
            continue;
        sets.habits[sets.count++] = bit;
        sets.habits[sets.count++] = habits & ~bit;
    }
    /* Others, from a fixed sequence. */
    for (unsigned seed = 1; sets.count < MOST_SETS; seed++)
        sets.habits[sets.count++] = habits & (seed * 2654435761u >> 20);
    assertSetsAgree(&sets, 0);
    freeScene(&scene);
}

/* On the course's scene the habits have the sizes that were measured apart from this program. */
static void theCoursesSceneHasTheKnownNumbers(void **state)
{
    (void)state;
    skipWithoutPovray();
    Scene scene =
        load("image: {width: 512, height: 512, bit_depth: 16, encoding: linear}\n"
             "render: {model: phong}\n"
             "lights: [{point: {position: [-3, 0, 1], color: [5, 5, 5]}}]\n"
             "objects:\n"
             "  - sphere: {center: [0, 0, -5], radius: 1.5, material: {diffuse: [1, 0, 0], specular: 0.5, "
             "shininess: 20}}\n"
             "  - sphere: {center: [-1, 0, -3.5], radius: 0.5, material: {diffuse: [0, 1, 0], specular: 0.5, "
             "shininess: 20}}\n");
    Image ours = drawWithMistakes(&scene, 0);
    HabitStudySettings settings = {.threads = 2, .timeoutSeconds = 60};
    HabitStudy study;
    assertOk(studyHabits(&scene, &ours, &settings, &study));
    const struct {
        PovHabit habit;
        double rmse;
    } known[] = {{POV_HABIT_LEFT_HANDED, .034730}, {POV_HABIT_FALLOFF, .031242},
                 {POV_HABIT_GAMMA, .0299},         {POV_HABIT_AMBIENT, .029217},
                 {POV_HABIT_DIFFUSE, .012945},     {POV_HABIT_HIGHLIGHT, .006218}};
    assert_int_equal(study.count, 6);
    for (int i = 0; i < study.count; i++) {
        assert_int_equal(study.order[i], known[i].habit);
        double rmse = pictureWithHabit(&study, i)->metrics.rmse;
        if (fabs(rmse - known[i].rmse) > 5e-5)
            fail_msg("%s: %d millionths", povHabitName(known[i].habit), (int)lround(rmse * 1e6));
        assert_true(isHabitSeen(&study, i));
    }
    assert_true(habitPicture(&study, 0)->metrics.rmse < 1.0 / 65535);

    /* As causes: in this order, the last leaves nothing, and none is unknown. */
    Explanations explanations;
    assertOk(explainHabits(&study, &scene, &explanations));
    const char *names[] = {"mirrored", "falloff", "gamma", "ambient", "exposure", "blinn"};
    assert_int_equal(explanations.count, 6);
    for (size_t i = 0; i < 6; i++) {
        assert_string_equal(causeName(explanations.items[i].cause), names[i]);
        assert_true(explanations.items[i].text.length > 0 && explanations.items[i].where.length > 0);
        assert_true(explanations.items[i].residual == pictureAfterHabits(&study, (int)i + 1)->metrics.rmse);
    }
    assert_true(explanations.before == pictureAfterHabits(&study, 0)->metrics.rmse);
    freeExplanations(&explanations);

    /* Against a picture that is not of the scene, the rest is unknown. */
    HabitStudy other;
    for (int i = 0; i < 3 * 512 * 100; i++)
        ours.samples[i] = 40000;
    assertOk(studyHabits(&scene, &ours, &settings, &other));
    assertOk(explainHabits(&other, &scene, &explanations));
    const Explanation *last = &explanations.items[explanations.count - 1];
    assert_string_equal(causeName(last->cause), "unknown");
    assert_true(last->residual > 0.1);
    freeExplanations(&explanations);
    freeHabitStudy(&other);
    freeHabitStudy(&study);
    freeImage(&ours);
    freeScene(&scene);
}

/* The mean of several rays is taken before the gamma. */
static void samplesAndGammaGoTogether(void **state)
{
    (void)state;
    skipWithoutPovray();
    Scene scene =
        load("image: {width: 64, height: 48, bit_depth: 16, encoding: linear}\n"
             "render: {samples: 2}\n"
             "lights: [{point: {position: [-3, 0, 1], color: 5}}]\n"
             "objects: [{sphere: {center: [0, 0, -5], radius: 1.5, material: {diffuse: [1, 0.5, 0]}}}]\n");
    Text pov = {0};
    assertOk(exportPovWithHabits(&scene, "a.pov", POV_HABIT_GAMMA, &pov));
    PovraySettings settings = {.width = 64,
                               .height = 48,
                               .bitDepth = 16,
                               .encoding = ENCODING_LINEAR,
                               .samples = 2,
                               .gamma = POV_HABIT_ASSUMED_GAMMA,
                               .threads = 1,
                               .timeoutSeconds = 60};
    Image povray, ours = drawWithMistakes(&scene, POV_HABIT_GAMMA);
    assertOk(runPovray(textString(&pov), &settings, &povray));
    Metrics metrics;
    assertOk(measureImages(&ours, &povray, 4.0 / 65535, 1, &metrics));
    assert_int_equal(metrics.differingPixels, 0);
    freeImage(&povray);
    freeImage(&ours);
    textFree(&pov);
    freeScene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(withoutHabitsItIsTheMatchedScene),  cmocka_unit_test(eachHabitWritesItsLine),
        cmocka_unit_test(allTogetherLookAsWrittenByHand),    cmocka_unit_test(anAreaLightKeepsItsGrid),
        cmocka_unit_test(habitsThatChangeNothingDoNotApply), cmocka_unit_test(povrayMakesTheSameMistakes),
        cmocka_unit_test(theCoursesSceneHasTheKnownNumbers), cmocka_unit_test(samplesAndGammaGoTogether),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
