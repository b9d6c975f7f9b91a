/* planted.c - pictures with planted mistakes, and pictures without: is the right cause named first?
 *
 *     planted [-v] [--all] SCENE.yaml...    planted mistakes; --all: every mistake in every scene
 *     planted [-v] --honest SCENE.yaml...   pairs without one: ours, and POV-Ray's of the same scene
 *
 * Each mistake is made here in a way of its own, in the scene, in the shading of the course's tracer, in the
 * framebuffer or in the stored samples; nothing of src/explain takes part. Then `explain` is asked, with the
 * scene and, where a picture is enough, with the right picture alone. Prints TAP: at least 95 of 100 must be
 * named first, and nothing at all for honest pairs.
 */
#include "explain/explain_picture.h"
#include "povray/export.h"
#include "povray/run.h"
#include "scene/load.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- Mistakes in the scene and its shading ---- */

static void noShadows(Scene *scene)
{
    scene->render.shadows = false;
}

static void noFalloff(Scene *scene)
{
    for (size_t i = 0; i < scene->lightCount; i++)
        scene->lights[i].falloff = FALLOFF_NONE;
}

static void blinnForPhong(Scene *scene)
{
    scene->render.model = scene->render.model == MODEL_PHONG ? MODEL_BLINN_PHONG : MODEL_PHONG;
}

static void shininessTen(Scene *scene)
{
    for (size_t i = 0; i < scene->objectCount; i++)
        scene->objects[i].material.shininess = 10;
}

static void shininessDoubled(Scene *scene)
{
    for (size_t i = 0; i < scene->objectCount; i++)
        scene->objects[i].material.shininess *= 2.5f;
}

static void noSpecular(Scene *scene)
{
    for (size_t i = 0; i < scene->objectCount; i++)
        scene->objects[i].material.specular = createColor(0, 0, 0);
}

static void biasZero(Scene *scene)
{
    scene->render.shadowBias = 0;
}

static void lightsHalved(Scene *scene)
{
    for (size_t i = 0; i < scene->lightCount; i++)
        scene->lights[i].color = scaleColor(scene->lights[i].color, 0.5);
}

static void ambientAdded(Scene *scene)
{
    if (!colorIsBlack(scene->render.ambient)) {
        scene->render.ambient = scaleColor(scene->render.ambient, 1.8);
        return;
    }
    scene->render.ambient = createColor(0.1f, 0.1f, 0.1f);
    for (size_t i = 0; i < scene->objectCount; i++)
        scene->objects[i].material.ambient = scene->objects[i].material.diffuse;
}

/* A student's shading, with a flag for each mistake. */
typedef struct Student {
    SurfaceFinder finder;
    SurfaceFinder honest;
    bool unclamped, absolute, flipped, inverse, oneMore, allTerms, allShadows, shortHighlight;
} Student;

static const Object *studentNearest(const SurfaceFinder *finder, const Ray *ray, Hit *hit)
{
    const Scene *scene = finder->scene;
    const Object *nearest = NULL;
    HitSink sink = createHitSink(0, false);
    for (size_t i = 0; i < scene->objectCount; i++) {
        double before = sink.nearest.distance;
        intersectObject(&scene->objects[i], ray, &sink);
        if (sink.nearest.distance < before)
            nearest = &scene->objects[i];
    }
    *hit = sink.nearest;
    return nearest;
}

static Color3f studentLight(const SurfaceFinder *finder, const ShadowRay *shadow, Color3f color)
{
    return lightThroughObjects(finder->scene, NULL, finder->scene->objectCount, shadow, color);
}

static Color3f studentShade(const SurfaceFinder *finder, const SurfacePoint *point, const Material *material,
                            Vector3D v, RayCounts *counts)
{
    const Student *student = (const Student *)(const void *)finder;
    const Scene *scene = finder->scene;
    (void)counts;
    double sum[3] = {(double)(material->ambient.r * scene->render.ambient.r + material->emission.r),
                     (double)(material->ambient.g * scene->render.ambient.g + material->emission.g),
                     (double)(material->ambient.b * scene->render.ambient.b + material->emission.b)};
    Vector3D n = student->flipped ? multVector(point->normal, -1) : point->normal;
    for (size_t i = 0; i < scene->lightCount; i++) {
        ArrivingLight arriving = lightArriving(&scene->lights[i], 0, point->position);
        double d = arriving.distance, weaker = 1;
        if (scene->lights[i].falloff == FALLOFF_INVERSE_SQUARE &&
            scene->lights[i].kind != LIGHT_DIRECTIONAL) {
            if (student->inverse)
                weaker = d; /* 1/d */
            if (student->oneMore)
                weaker = d * d / (1 + d * d);
            if (student->allTerms)
                weaker = d * d / (1 + d + d * d);
        }
        double cosine = dot(n, arriving.direction);
        bool behind = cosine <= 0;
        if (student->absolute)
            cosine = fabs(cosine);
        else if (behind && !student->unclamped)
            continue;
        if (scene->render.shadows && !(behind && (student->absolute || student->unclamped))) {
            ShadowRay shadow = shadowRayTo(scene, point, &arriving);
            if (student->allShadows)
                shadow.farthest = INFINITY;
            if (colorIsBlack(studentLight(finder, &shadow, createColor(1, 1, 1))))
                continue;
        }
        Vector3D r = reflect(multVector(arriving.direction, -1), n);
        double base = dot(r, v);
        if (materialModel(scene, material) == MODEL_BLINN_PHONG)
            base = dot(n, normalize(addVectors(arriving.direction, v)));
        double shine = pow(fmax(0, base), (double)material->shininess);
        if (behind || materialModel(scene, material) == MODEL_LAMBERT)
            shine = 0;
        if (student->shortHighlight && scene->lights[i].falloff == FALLOFF_INVERSE_SQUARE &&
            scene->lights[i].kind != LIGHT_DIRECTIONAL)
            shine *= d * d;
        const float lights[3] = {arriving.color.r, arriving.color.g, arriving.color.b};
        const float kd[3] = {material->diffuse.r, material->diffuse.g, material->diffuse.b};
        const float ks[3] = {material->specular.r, material->specular.g, material->specular.b};
        for (int c = 0; c < 3; c++)
            sum[c] += (double)lights[c] * weaker * ((double)kd[c] * cosine + (double)ks[c] * shine);
    }
    return createColor((float)sum[0], (float)sum[1], (float)sum[2]);
}

/* ---- Mistakes in the picture ---- */

static void doubleExposure(Framebuffer *f)
{
    for (int i = 0; i < f->width * f->height; i++)
        f->pixels[i] = scaleColor(f->pixels[i], 1.7);
}

static void halfExposure(Framebuffer *f)
{
    for (int i = 0; i < f->width * f->height; i++)
        f->pixels[i] = scaleColor(f->pixels[i], 0.6);
}

static void grayAdded(Framebuffer *f)
{
    for (int i = 0; i < f->width * f->height; i++)
        f->pixels[i] = addColors(f->pixels[i], createColor(0.07f, 0.07f, 0.07f));
}

static void mirrorPicture(Framebuffer *f)
{
    for (int y = 0; y < f->height; y++)
        for (int x = 0; x < f->width / 2; x++) {
            Color3f *a = &f->pixels[y * f->width + x], *b = &f->pixels[y * f->width + f->width - 1 - x],
                    c = *a;
            *a = *b;
            *b = c;
        }
}

static void flipPicture(Framebuffer *f)
{
    for (int y = 0; y < f->height / 2; y++)
        for (int x = 0; x < f->width; x++) {
            Color3f *a = &f->pixels[y * f->width + x], *b = &f->pixels[(f->height - 1 - y) * f->width + x],
                    c = *a;
            *a = *b;
            *b = c;
        }
}

static void swapRedAndBlue(Framebuffer *f)
{
    for (int i = 0; i < f->width * f->height; i++) {
        float r = f->pixels[i].r;
        f->pixels[i].r = f->pixels[i].b;
        f->pixels[i].b = r;
    }
}

static void turnChannels(Framebuffer *f)
{
    for (int i = 0; i < f->width * f->height; i++) {
        Color3f c = f->pixels[i];
        f->pixels[i] = createColor(c.g, c.b, c.r);
    }
}

static void shiftByOne(Framebuffer *f)
{
    for (int y = 0; y < f->height; y++)
        memmove(&f->pixels[y * f->width], &f->pixels[y * f->width + 1],
                (size_t)(f->width - 1) * sizeof *f->pixels);
}

static void shiftDownFromBlack(Framebuffer *f)
{
    size_t width = (size_t)f->width, height = (size_t)f->height;
    memmove(f->pixels + width, f->pixels, (height - 1) * width * sizeof *f->pixels);
    for (size_t x = 0; x < width; x++)
        f->pixels[x] = createColor(0, 0, 0);
}

/* As an image program moves a picture: the mean of two neighbours, and black from outside. */
static void shiftBetweenPixels(Framebuffer *f)
{
    for (int y = 0; y < f->height; y++)
        for (int x = 0; x < f->width; x++) {
            Color3f *here = &f->pixels[y * f->width + x];
            Color3f next = x + 1 < f->width ? here[1] : createColor(0, 0, 0);
            *here = scaleColor(addColors(*here, next), 0.5);
        }
}

static void turnHalf(Framebuffer *f)
{
    mirrorPicture(f);
    flipPicture(f);
}

/* Of a picture that was clamped already. */
static void dimClamped(Framebuffer *f)
{
    for (int i = 0; i < f->width * f->height; i++) {
        Color3f c = f->pixels[i];
        f->pixels[i] = createColor(fminf(c.r, 1) * 0.7f, fminf(c.g, 1) * 0.7f, fminf(c.b, 1) * 0.7f);
    }
}

static float gammaTwo(float v)
{
    return powf(v, 1 / 2.2f);
}

static float gammaDown(float v)
{
    return powf(v, 2.2f);
}

static float encodeTwice(float v)
{
    return linearToSrgb(v);
}

static float neverEncode(float v)
{
    return srgbToLinear(v);
}

static float powerForCurve(float v)
{
    return powf(srgbToLinear(v), 1 / 2.2f);
}

static float fewLevels(float v)
{
    return floorf(v * 15 + 0.5f) / 15;
}

static float cutOff(float v)
{
    return floorf(v * 31) / 31;
}

/* ---- The plants ---- */

typedef struct Mistake {
    const char *name;
    Cause cause;
    Cause orCause; /* which it may as well be called; 0: none */
    void (*inScene)(Scene *scene);
    size_t studentFlag; /* offset of a flag of Student, or 0 */
    double rayX, rayY;  /* where the rays go within a pixel, besides the middle */
    double stretch;     /* of the camera's right vector; 0: none */
    void (*inPicture)(Framebuffer *framebuffer);
    float (*inSamples)(float v); /* as stored, 0..1 */
    bool isSeenAlone;            /* where it is the only one, two pictures are enough */
    bool isOfCurve;              /* a mistake only where samples are encoded */
} Mistake;

#define FLAG(name) .studentFlag = offsetof(Student, name)

static const Mistake MISTAKES[] = {
    {"no shadows", CAUSE_SHADOW, .inScene = noShadows, .isSeenAlone = true},
    {"shadows from behind the light", CAUSE_SHADOW, FLAG(allShadows)},
    {"no falloff", CAUSE_FALLOFF, .inScene = noFalloff},
    {"falloff 1/d", CAUSE_FALLOFF, FLAG(inverse)},
    {"falloff 1/(1+d^2)", CAUSE_FALLOFF, FLAG(oneMore)},
    {"falloff 1/(1+d+d^2)", CAUSE_FALLOFF, FLAG(allTerms)},
    {"the other highlight", CAUSE_BLINN, .inScene = blinnForPhong},
    {"shininess 10", CAUSE_SHININESS, .inScene = shininessTen, .isSeenAlone = true},
    {"shininess times 2.5", CAUSE_SHININESS, .inScene = shininessDoubled},
    {"no highlight", CAUSE_SPECULAR, .inScene = noSpecular, .isSeenAlone = true},
    {"highlight without falloff", CAUSE_SPECULAR, FLAG(shortHighlight)},
    {"negative light", CAUSE_NEGATIVE_LIGHT, FLAG(unclamped)},
    {"absolute N.L", CAUSE_NEGATIVE_LIGHT, FLAG(absolute)},
    {"normals flipped", CAUSE_NORMALS, FLAG(flipped)},
    {"acne", CAUSE_ACNE, .inScene = biasZero, .isSeenAlone = true},
    {"half the light", CAUSE_EXPOSURE, .inScene = lightsHalved},
    {"ambient times diffuse", CAUSE_AMBIENT, .inScene = ambientAdded},
    {"exposure 1.7", CAUSE_EXPOSURE, .inPicture = doubleExposure},
    {"exposure 0.6", CAUSE_EXPOSURE, .inPicture = halfExposure},
    {"exposure 0.7 after clamping", CAUSE_EXPOSURE, .inPicture = dimClamped},
    {"grey added", CAUSE_AMBIENT, .inPicture = grayAdded},
    {"mirrored", CAUSE_MIRRORED, .inPicture = mirrorPicture},
    {"flipped", CAUSE_FLIPPED, .inPicture = flipPicture},
    {"half a turn", CAUSE_MIRRORED, .orCause = CAUSE_FLIPPED, .inPicture = turnHalf},
    {"red and blue swapped", CAUSE_CHANNELS, .inPicture = swapRedAndBlue},
    {"channels turned", CAUSE_CHANNELS, .inPicture = turnChannels},
    {"shifted by one", CAUSE_SHIFT, .inPicture = shiftByOne},
    {"shifted down from black", CAUSE_SHIFT, .inPicture = shiftDownFromBlack},
    {"half a pixel, blurred", CAUSE_SHIFT, .inPicture = shiftBetweenPixels},
    {"half a pixel", CAUSE_SHIFT, .rayX = -0.5, .rayY = -0.5},
    {"half a pixel to the right", CAUSE_SHIFT, .rayX = 0.5},
    {"aspect 1", CAUSE_ASPECT, .stretch = 0.75},
    {"aspect 4/3 twice", CAUSE_ASPECT, .stretch = 4 / 3.},
    {"gamma 2.2 again", CAUSE_GAMMA, .inSamples = gammaTwo},
    {"gamma taken away", CAUSE_GAMMA, .inSamples = gammaDown},
    {"sRGB twice", CAUSE_GAMMA, .inSamples = encodeTwice},
    {"never encoded", CAUSE_GAMMA, .inSamples = neverEncode},
    {"a power for the curve", CAUSE_GAMMA, .inSamples = powerForCurve, .isOfCurve = true},
    {"16 levels", CAUSE_QUANTISATION, .inSamples = fewLevels},
    {"32 levels cut off", CAUSE_QUANTISATION, .inSamples = cutOff},
};
enum {
    MISTAKE_COUNT = sizeof MISTAKES / sizeof *MISTAKES
};

static bool needsScene(const Mistake *mistake)
{
    return mistake != NULL && (mistake->inScene != NULL || mistake->studentFlag != 0);
}

/* Draw with the course's shading, ray by ray, and the mistakes. */
static void drawWithMistakes(const Scene *original, const Mistake *mistakes[2], Framebuffer *framebuffer)
{
    Scene scene = *original;
    scene.objects = malloc(scene.objectCount * sizeof *scene.objects);
    scene.lights = malloc(scene.lightCount * sizeof *scene.lights);
    memcpy(scene.objects, original->objects, scene.objectCount * sizeof *scene.objects);
    memcpy(scene.lights, original->lights, scene.lightCount * sizeof *scene.lights);
    Student student = {.finder = {.nearest = studentNearest, .lightAlong = studentLight}};
    double x0 = 0.5, y0 = 0.5, stretch = 1;
    for (int i = 0; i < 2; i++) {
        if (mistakes[i] == NULL)
            continue;
        if (mistakes[i]->inScene != NULL)
            mistakes[i]->inScene(&scene);
        if (mistakes[i]->studentFlag != 0) {
            *(bool *)((char *)&student + mistakes[i]->studentFlag) = true;
            student.finder.lightShader = studentShade;
        }
        x0 += mistakes[i]->rayX;
        y0 += mistakes[i]->rayY;
        if (mistakes[i]->stretch != 0)
            stretch = mistakes[i]->stretch;
    }
    student.finder.scene = &scene;
    CameraFrame frame = cameraFrame(&scene.camera, framebuffer->width, framebuffer->height);
    frame.right = multVector(frame.right, stretch);
    Media media = {.count = 0};
    RayCounts counts = {0};
    for (int y = 0; y < framebuffer->height; y++)
        for (int x = 0; x < framebuffer->width; x++) {
            Ray ray = cameraRay(&frame, x + x0, y + y0, framebuffer->width, framebuffer->height);
            framebuffer->pixels[y * framebuffer->width + x] =
                traceRay(&student.finder, &ray, &media, 1, &counts);
        }
    free(scene.objects);
    free(scene.lights);
}

static void storeWithMistakes(Framebuffer *framebuffer, const Mistake *mistakes[2], int bits,
                              Encoding encoding, Image *image)
{
    for (int i = 0; i < 2; i++)
        if (mistakes[i] != NULL && mistakes[i]->inPicture != NULL)
            mistakes[i]->inPicture(framebuffer);
    imageFromFramebuffer(framebuffer, bits, encoding, 1, image);
    /* Change what was stored from the exact values, as a program would. */
    bool changed = false;
    for (int i = 0; i < 2; i++)
        changed |= mistakes[i] != NULL && mistakes[i]->inSamples != NULL;
    if (!changed)
        return;
    const float highest = (float)imageMaxSample(image);
    for (int p = 0; p < image->width * image->height; p++) {
        const float linear[3] = {framebuffer->pixels[p].r, framebuffer->pixels[p].g,
                                 framebuffer->pixels[p].b};
        for (int c = 0; c < 3; c++) {
            float v = fminf(fmaxf(linear[c], 0), 1);
            v = encoding == ENCODING_SRGB ? linearToSrgb(v) : v;
            for (int i = 0; i < 2; i++)
                if (mistakes[i] != NULL && mistakes[i]->inSamples != NULL)
                    v = mistakes[i]->inSamples(v);
            image->samples[3 * p + c] = (uint16_t)floorf(v * highest + 0.5f);
        }
    }
}

/* ---- Asking ---- */

typedef struct Tally {
    int asked, right, testNumber, failed;
    bool verbose, all;
} Tally;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void judge(Tally *tally, const char *scene, const char *how, const Mistake *mistakes[2],
                  const PictureExplanation *explanation, double seconds)
{
    const Explanations *causes = &explanation->causes;
    Cause first = causes->count > 0 ? causes->items[0].cause : CAUSE_COUNT;
    bool right = false;
    for (int i = 0; i < 2 && mistakes[i] != NULL; i++)
        right |= first == mistakes[i]->cause || (mistakes[i]->orCause != 0 && first == mistakes[i]->orCause);
    tally->asked++;
    tally->right += right;
    if (right && !tally->verbose)
        return;
    printf("# %s %s, %s: %s%s%s:", right ? "right" : "WRONG", scene, how, mistakes[0]->name,
           mistakes[1] != NULL ? " and " : "", mistakes[1] != NULL ? mistakes[1]->name : "");
    for (size_t i = 0; i < causes->count; i++)
        printf(" [%s %.5f: %s]", causeName(causes->items[i].cause), causes->items[i].residual,
               textString(&causes->items[i].text));
    printf(" before %.5f, %.2f s\n", causes->before, seconds);
}

/* Whether the planted picture differs enough to be noticed at all. */
static bool isVisible(const Image *a, const Image *b)
{
    size_t differing = 0, samples = 3 * (size_t)a->width * (size_t)a->height;
    for (size_t i = 0; i < samples; i++)
        differing += abs(a->samples[i] - b->samples[i]) > (a->bitDepth == 8 ? 3 : 600);
    return differing > samples / 400;
}

static void plant(Tally *tally, const char *path, const Scene *scene, const Mistake *first,
                  const Mistake *second, int bits, Encoding encoding)
{
    const Mistake *mistakes[2] = {first, second}, *none[2] = {NULL, NULL};
    if (encoding == ENCODING_LINEAR && (first->isOfCurve || (second != NULL && second->isOfCurve)))
        return;
    Framebuffer *wrong = createFramebuffer(scene->image.width, scene->image.height);
    Framebuffer *right = createFramebuffer(scene->image.width, scene->image.height);
    Image planted, honest;
    drawWithMistakes(scene, mistakes, wrong);
    storeWithMistakes(wrong, mistakes, bits, encoding, &planted);
    RenderOptions options = {.threads = 2};
    renderReference(scene, right, &options, NULL);
    storeWithMistakes(right, none, bits, encoding, &honest);
    const char *name = strrchr(path, '/') != NULL ? strrchr(path, '/') + 1 : path;
    if (isVisible(&planted, &honest)) {
        PictureExplanation explanation;
        SceneSource source = {.name = name};
        bool isEnough = (!needsScene(first) || (first->isSeenAlone && second == NULL)) && !needsScene(second);
        bool alternates = !tally->all && isEnough && tally->asked % 2 == 1;
        double start = now();
        Status status = statusOk();
        if (!alternates)
            status = explainPictureOfScene(&planted, scene, &source, 2, &explanation);
        if (!alternates && statusIsOk(&status)) {
            judge(tally, name, "with the scene", mistakes, &explanation, now() - start);
            freePictureExplanation(&explanation);
        }
        if (isEnough && (tally->all || alternates)) {
            start = now();
            status = explainPictures(&planted, "planted", &honest, "honest", &explanation);
            if (statusIsOk(&status)) {
                judge(tally, name, "with a picture", mistakes, &explanation, now() - start);
                freePictureExplanation(&explanation);
            }
        }
    } else if (tally->verbose) {
        printf("# not visible: %s: %s %s\n", name, first->name, second != NULL ? second->name : "");
    }
    freeImage(&planted);
    freeImage(&honest);
    freeFramebuffer(wrong);
    freeFramebuffer(right);
}

static bool canMeet(const Mistake *a, const Mistake *b)
{
    /* Two of one cause, or two that change the same thing. */
    bool views = (a->rayX != 0 || a->rayY != 0 || a->stretch != 0) &&
                 (b->rayX != 0 || b->rayY != 0 || b->stretch != 0);
    bool areTurns =
        (a->orCause != 0 && a->orCause == b->cause) || (b->orCause != 0 && b->orCause == a->cause);
    return a->cause != b->cause && !views && !areTurns &&
           !(a->cause == CAUSE_NORMALS && b->cause != CAUSE_MIRRORED && b->cause != CAUSE_FLIPPED);
}

/* All the mistakes that are this scene's share, alone and in pairs. */
static void plantAll(Tally *tally, const char *path, const Scene *scene, int number)
{
    int bits = number % 3 == 2 ? 16 : 8;
    Encoding encoding = number % 3 == 2 ? ENCODING_LINEAR : ENCODING_SRGB;
    for (int m = 0; m < MISTAKE_COUNT; m++)
        if (tally->all || (m + number) % 4 == 0)
            plant(tally, path, scene, &MISTAKES[m], NULL, bits, encoding);
    for (int m = 0; m < MISTAKE_COUNT; m++) {
        int other = (m + 5 + 7 * number) % MISTAKE_COUNT;
        if ((m + number) % (tally->all ? 3 : 15) == 0 && canMeet(&MISTAKES[m], &MISTAKES[other]))
            plant(tally, path, scene, &MISTAKES[m], &MISTAKES[other], bits, encoding);
    }
}

/* Nothing must be claimed of what is named. */
static void judgeHonest(Tally *tally, const char *path, const char *how, const Status *status,
                        PictureExplanation *explanation)
{
    tally->asked++;
    if (!statusIsOk(status)) {
        printf("# WRONG %s, %s: %s\n", path, how, status->message);
        return;
    }
    tally->right += explanation->causes.count == 0;
    if (tally->verbose || explanation->causes.count > 0)
        printf("# %s, %s: %s%s\n", path, how,
               explanation->causes.count > 0 ? textString(&explanation->causes.items[0].text) : "",
               textString(&explanation->summary));
    freePictureExplanation(explanation);
}

/* Our picture and POV-Ray's, which have no mistake. */
static void honestPair(Tally *tally, const char *path, const Scene *scene, int number)
{
    int bits = number % 2 == 0 ? 8 : 16;
    Encoding encoding = number % 4 == 0 ? ENCODING_SRGB : ENCODING_LINEAR;
    Framebuffer *framebuffer = createFramebuffer(scene->image.width, scene->image.height);
    RenderOptions options = {.threads = 2};
    PovraySettings settings = {.width = scene->image.width,
                               .height = scene->image.height,
                               .bitDepth = bits,
                               .encoding = encoding,
                               .samples = 1,
                               .threads = 2,
                               .timeoutSeconds = 100};
    Text pov = {0};
    Image ours, povray;
    PictureExplanation explanation;
    Status status = exportPov(scene, "scene.pov", &pov);
    if (statusIsOk(&status))
        status = runPovray(textString(&pov), &settings, &povray);
    textFree(&pov);
    if (!statusIsOk(&status)) {
        judgeHonest(tally, path, "drawn by POV-Ray", &status, &explanation);
        freeFramebuffer(framebuffer);
        return;
    }
    renderReference(scene, framebuffer, &options, NULL);
    imageFromFramebuffer(framebuffer, bits, encoding, 1, &ours);
    status = explainPictures(&ours, "ours", &povray, "POV-Ray's", &explanation);
    judgeHonest(tally, path, "two pictures", &status, &explanation);
    SceneSource source = {.name = path};
    status = explainPictureOfScene(&povray, scene, &source, 2, &explanation);
    judgeHonest(tally, path, "POV-Ray's picture and the scene", &status, &explanation);
    freeImage(&ours);
    freeImage(&povray);
    freeFramebuffer(framebuffer);
}

int main(int argc, char **argv)
{
    enum {
        WIDTH = 160
    };
    Tally tally = {0};
    bool honest = false;
    int scenes = 0;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "-v") == 0 || strcmp(argv[i], "--all") == 0 || strcmp(argv[i], "--honest") == 0) {
            tally.verbose |= argv[i][1] == 'v';
            tally.all |= argv[i][2] == 'a';
            honest |= argv[i][2] == 'h';
            continue;
        }
        Scene scene;
        Diagnostics diagnostics = {0};
        Status status = loadScene(argv[i], &scene, &diagnostics);
        diagnosticsFree(&diagnostics);
        if (!statusIsOk(&status)) {
            printf("Bail out! %s: %s\n", argv[i], status.message);
            return 1;
        }
        scene.image.height = scene.image.height * WIDTH / scene.image.width;
        scene.image.width = WIDTH;
        scene.render.samples = 1;
        if (honest)
            honestPair(&tally, argv[i], &scene, scenes);
        else
            plantAll(&tally, argv[i], &scene, scenes);
        freeScene(&scene);
        scenes++;
    }
    if (honest)
        printf("%s 1 - of %d pairs without a mistake, none is explained by one\n1..1\n",
               tally.right == tally.asked && tally.asked >= 2 * scenes && scenes > 0 ? "ok" : "not ok",
               tally.asked);
    else
        printf(
            "%s 1 - the right cause is named first for at least 95 of 100 planted mistakes: %d of %d\n1..1\n",
            tally.right * 100 >= tally.asked * 95 && tally.asked >= 40 ? "ok" : "not ok", tally.right,
            tally.asked);
    return 0;
}
