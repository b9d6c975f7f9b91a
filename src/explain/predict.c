/* predict.c - see predict.h. */
#include "explain/predict.h"

#include "base/cancel.h"
#include "base/threads.h"

#include <math.h>
#include <stdlib.h>

enum {
    CHUNK = 32 /* pixels a task: few, since each may take hundreds of rays */
};

/* What a sample at the top may stand for: what was clamped, up to a stop of light. More would let a picture
 * with much of it be anything. */
static const float BRIGHTEST = 1.25f;

Status truthOfPicture(const Image *picture, Truth *truth)
{
    size_t count = (size_t)imageMaxSample(picture) + 1;
    LightRange *ranges = malloc(count * sizeof *ranges);
    if (ranges == NULL)
        return statusOutOfMemory();
    float highest = (float)imageMaxSample(picture);
    for (size_t i = 0; i < count; i++) {
        float v = (float)i;
        float ends[3] = {fmaxf(v - 0.5f, 0) / highest, v / highest, fminf(v + 0.5f, highest) / highest};
        for (int k = 0; k < 3 && picture->encoding == ENCODING_SRGB; k++)
            ends[k] = srgbToLinear(ends[k]);
        ranges[i] = (LightRange){ends[0], ends[1], i + 1 < count ? ends[2] : BRIGHTEST};
    }
    *truth = (Truth){.picture = picture, .ranges = ranges, .threads = 1};
    return statusOk();
}

Status truthOfScene(const SurfaceFinder *finder, int threads, Truth *truth)
{
    bool failed;
    size_t count;
    uint32_t *transparent = findTransparentObjects(finder->scene, &count, &failed);
    if (failed)
        return statusOutOfMemory();
    *truth = (Truth){.scene = finder->scene,
                     .finder = finder,
                     .transparent = transparent,
                     .transparentCount = count,
                     .threads = threads};
    return statusOk();
}

void freeTruth(Truth *truth)
{
    free(truth->ranges);
    free(truth->transparent);
    truth->ranges = NULL;
    truth->transparent = NULL;
}

/* ---- From a picture ---- */

/* What lies at a point between four pixels: where they are alike, their mean; at an edge anything between. */
static void lookUpBetween(const Truth *truth, double x, double y, int channel, float *low, float *middle,
                          float *high)
{
    const Image *image = truth->picture;
    const float alike = 0.06f; /* of linear light: more is an edge */
    int left = (int)floor(x), top = (int)floor(y);
    float fx = (float)(x - left), fy = (float)(y - top);
    float least = INFINITY, most = -INFINITY, sum = 0;
    for (int j = 0; j < 2; j++) {
        for (int i = 0; i < 2; i++) {
            float share = (i == 1 ? fx : 1 - fx) * (j == 1 ? fy : 1 - fy);
            if (share == 0)
                continue;
            size_t pixel = (size_t)(top + j) * (size_t)image->width + (size_t)(left + i);
            LightRange range = truth->ranges[image->samples[3 * pixel + (size_t)channel]];
            least = fminf(least, range.low);
            most = fmaxf(most, range.high);
            sum += share * range.middle;
        }
    }
    *middle = sum;
    bool isEdge = most - least > alike;
    *low = isEdge ? least : sum - 0.25f * (sum - least);
    *high = isEdge ? most : sum + 0.25f * (most - sum);
}

/* The colour that most corners have, which is taken for the background. */
static void backgroundOf(const Image *image, const uint16_t **color)
{
    size_t w = (size_t)image->width, h = (size_t)image->height;
    const uint16_t *corners[4] = {image->samples, image->samples + 3 * (w - 1),
                                  image->samples + 3 * w * (h - 1), image->samples + 3 * (w * h - 1)};
    int best = 0;
    *color = corners[0];
    for (int i = 0; i < 4; i++) {
        int same = 0;
        for (int j = 0; j < 4; j++)
            same += corners[i][0] == corners[j][0] && corners[i][1] == corners[j][1] &&
                    corners[i][2] == corners[j][2];
        if (same > best) {
            best = same;
            *color = corners[i];
        }
    }
}

/* Say that the pixel is not known. */
static void setUnknown(Prediction *prediction, size_t pixel)
{
    prediction->low[0][3 * pixel] = 1;
    prediction->high[0][3 * pixel] = 0;
}

static void lookUpPixel(const Truth *truth, const uint16_t *background, const EvidencePixel *pixel,
                        const ViewChange *view, size_t i, Prediction *prediction)
{
    const Image *image = truth->picture;
    double x = pixel->x + 0.5, y = pixel->y + 0.5;
    changePoint(view, image->width, image->height, &x, &y);
    x -= 0.5;
    y -= 0.5;
    if (fabs(x - round(x)) < 1e-6)
        x = round(x);
    if (fabs(y - round(y)) < 1e-6)
        y = round(y);
    if (!(x >= 0 && y >= 0 && x <= image->width - 1 && y <= image->height - 1)) {
        setUnknown(prediction, i);
        return;
    }
    for (int c = 0; c < 3; c++) {
        size_t at = 3 * i + (size_t)c;
        lookUpBetween(truth, x, y, c, &prediction->low[0][at], &prediction->middle[at],
                      &prediction->high[0][at]);
    }
    const uint16_t *nearest =
        image->samples + 3 * ((size_t)lround(y) * (size_t)image->width + (size_t)lround(x));
    prediction->places[i] =
        (ValuePlace){.isSurface = nearest[0] != background[0] || nearest[1] != background[1] ||
                                  nearest[2] != background[2]};
}

/* ---- From a scene ---- */

typedef struct Tracing {
    const Truth *truth;
    const Evidence *evidence;
    const ViewChange *view;
    const LightChange *changes; /* one for each alternative */
    PixelMemory *memories;      /* one for each pixel, or NULL */
    bool isBlurred;             /* the second alternative lies between pixels of the picture as drawn */
    PixelRays rays, unmovedRays;
    Prediction *prediction;
} Tracing;

/* Look where the picture's point shows, if view is what is wrong with it. */
static void movePoint(const void *view, int width, int height, double *x, double *y)
{
    changePoint(view, width, height, x, y);
}

/* Whether the view moves the picture by half a pixel. */
static bool isHalfShift(const ViewChange *view)
{
    return fabs(view->shiftX) == 0.5 || fabs(view->shiftY) == 0.5;
}

static float encodeAs(const Evidence *evidence, float light)
{
    float v = fminf(fmaxf(light, 0), 1);
    return evidence->format.encoding == ENCODING_SRGB ? linearToSrgb(v) : v;
}

/* A pixel of a picture that was drawn and then moved: the mean of the two or four pixels round the point, of
 * their light (high) or of their samples (low, which is never more). */
static void traceBetween(const Tracing *tracing, const SurfaceFinder *finder, const EvidencePixel *pixel,
                         float low[3], float high[3])
{
    const Evidence *evidence = tracing->evidence;
    RayCounts counts = {0};
    double x = pixel->x + 0.5, y = pixel->y + 0.5, light[3] = {0, 0, 0}, stored[3] = {0, 0, 0};
    changePoint(tracing->view, evidence->width, evidence->height, &x, &y);
    int left = (int)floor(x - 0.5), top = (int)floor(y - 0.5);
    int right = (int)ceil(x - 0.5), bottom = (int)ceil(y - 0.5), count = 0;
    for (int row = top; row <= bottom; row++) {
        for (int column = left; column <= right; column++, count++) {
            Color3f color = tracePixel(&tracing->unmovedRays, finder, column, row, &counts);
            const float channels[3] = {color.r, color.g, color.b};
            for (int c = 0; c < 3; c++) {
                light[c] += (double)fminf(channels[c], 1);
                stored[c] += (double)encodeAs(evidence, channels[c]);
            }
        }
    }
    for (int c = 0; c < 3; c++) {
        float mean = (float)(stored[c] / count);
        high[c] = (float)(light[c] / count);
        low[c] = evidence->format.encoding == ENCODING_SRGB ? fminf(srgbToLinear(mean), high[c]) : high[c];
    }
}

static ValuePlace findPlace(const Tracing *tracing, const SurfaceFinder *finder, const EvidencePixel *pixel)
{
    Media media;
    Ray ray = pixelRay(&tracing->rays, pixel->x + 0.5, pixel->y + 0.5, &media);
    Hit hit;
    if (finder->nearest(finder, &ray, &hit) == NULL)
        return (ValuePlace){.isSurface = false};
    return (ValuePlace){.isSurface = true,
                        .diffuse = materialAt(hit.object, pointOnRay(&ray, hit.distance)).diffuse};
}

/* Whether a moved picture has nothing to show at the pixel but what its maker filled the border with. */
static bool isBorder(const Tracing *tracing, const EvidencePixel *pixel)
{
    const ViewChange *view = tracing->view;
    double x = pixel->x + 0.5, y = pixel->y + 0.5;
    if (view->shiftX == 0 && view->shiftY == 0)
        return false;
    changePoint(view, tracing->evidence->width, tracing->evidence->height, &x, &y);
    return x < 0.5 || y < 0.5 || x > tracing->evidence->width - 0.5 || y > tracing->evidence->height - 0.5;
}

static void traceChunk(void *context, size_t number)
{
    const Tracing *tracing = context;
    Prediction *prediction = tracing->prediction;
    size_t end = (number + 1) * CHUNK < prediction->count ? (number + 1) * CHUNK : prediction->count;
    RayCursor cursor;
    RememberingFinder base;
    ChangedFinder finders[MAX_ALTERNATIVES];
    createRememberingFinder(tracing->truth->finder, &cursor, &base);
    for (int a = 0; a < prediction->alternatives; a++)
        createChangedFinder(&base.finder, &tracing->changes[a], &finders[a]);
    for (size_t i = number * CHUNK; i < end && !cancelRequested(); i++) {
        const EvidencePixel *pixel = &tracing->evidence->pixels[i];
        for (int a = 0; a < prediction->alternatives; a++) {
            beginPixel(&cursor, tracing->memories != NULL ? &tracing->memories[i] : NULL);
            if (a == 1 && tracing->isBlurred) {
                traceBetween(tracing, &finders[a].finder, pixel, prediction->low[a] + 3 * i,
                             prediction->high[a] + 3 * i);
                continue;
            }
            RayCounts counts = {0};
            Color3f color = tracePixel(&tracing->rays, &finders[a].finder, pixel->x, pixel->y, &counts);
            const float channels[3] = {color.r, color.g, color.b};
            for (size_t c = 0; c < 3; c++) {
                prediction->low[a][3 * i + c] = prediction->high[a][3 * i + c] = channels[c];
                if (a == 0)
                    prediction->middle[3 * i + c] = channels[c];
            }
        }
        prediction->places[i] = findPlace(tracing, &base.finder, pixel);
        if (isBorder(tracing, pixel))
            setUnknown(prediction, i);
    }
}

/* The ways in which lamps can be blocked: any of up to three; of more none, all, or one. */
static int blockedWays(size_t lights, unsigned ways[MAX_ALTERNATIVES])
{
    int count = 0;
    ways[count++] = 0;
    if (lights <= 3) {
        for (unsigned way = 1; way < 1u << lights; way++)
            ways[count++] = way;
        return count;
    }
    ways[count++] = ~0u;
    for (size_t i = 0; i < lights && count < MAX_ALTERNATIVES; i++)
        ways[count++] = 1u << i;
    return count;
}

static Status predictFromScene(const Truth *truth, const Evidence *evidence, PixelMemory *memories,
                               const ViewChange *view, const LightChange *light, bool acne,
                               Prediction *prediction)
{
    unsigned ways[MAX_ALTERNATIVES] = {0};
    bool isBlurred = !acne && isHalfShift(view);
    int count = acne ? blockedWays(truth->scene->lightCount, ways) : isBlurred ? 2 : 1;
    Status status = createPrediction(evidence->count, count, prediction);
    if (!statusIsOk(&status))
        return status;
    LightChange changes[MAX_ALTERNATIVES];
    for (int i = 0; i < count; i++) {
        changes[i] = *light;
        changes[i].blockedLights = ways[i];
    }
    PixelRays rays = createPixelRays(truth->scene, evidence->width, evidence->height, truth->transparent,
                                     truth->transparentCount);
    Tracing tracing = {.truth = truth,
                       .evidence = evidence,
                       .view = view,
                       .changes = changes,
                       .memories = memories,
                       .isBlurred = isBlurred,
                       .rays = rays,
                       .unmovedRays = rays,
                       .prediction = prediction};
    tracing.rays.movePoint = movePoint;
    tracing.rays.moveContext = view;
    status = runTasks((evidence->count + CHUNK - 1) / CHUNK, truth->threads, traceChunk, &tracing);
    if (!statusIsOk(&status))
        freePrediction(prediction);
    return status;
}

Status predictPixels(const Truth *truth, const Evidence *evidence, PixelMemory *memories,
                     const ViewChange *view, const LightChange *light, bool acne, Prediction *prediction)
{
    if (truth->scene != NULL)
        return predictFromScene(truth, evidence, memories, view, light, acne, prediction);
    if (cancelRequested())
        return statusInterrupted();
    Status status = createPrediction(evidence->count, 1, prediction);
    if (!statusIsOk(&status))
        return status;
    const uint16_t *background;
    backgroundOf(truth->picture, &background);
    for (size_t i = 0; i < evidence->count; i++)
        lookUpPixel(truth, background, &evidence->pixels[i], view, i, prediction);
    return statusOk();
}

size_t predictionCost(const Truth *truth)
{
    if (truth->scene == NULL)
        return 1;
    const Scene *scene = truth->scene;
    size_t samples = (size_t)scene->render.samples, lamps = 0;
    for (size_t i = 0; i < scene->lightCount; i++)
        lamps += (size_t)lightSampleCount(&scene->lights[i]);
    size_t ofLights = scene->lightCount > 0 ? lamps / scene->lightCount : 1;
    return samples * samples * ofLights * (truth->transparentCount > 0 ? 4 : 1);
}
