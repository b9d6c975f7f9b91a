/* metrics.c - how far two pictures lie apart; see metrics.h and METRICS.md.
 *
 * The differences of samples are integers, so each row's sums are exact; rows are added in order from
 * the top. Thus the numbers do not depend on the number of threads.
 */
#include "compare/metrics.h"

#include "base/threads.h"
#include "compare/flip.h"
#include "compare/ssim.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

enum {
    ROWS_PER_TASK = 16
};

/* What one row of pixels gives; differences are counted in sample steps. */
typedef struct RowSums {
    uint64_t absolute, squares; /* a row's squares are below 65535 * 3 * 65535^2 < 2^64 */
    int identical, differing;
    int largest;    /* the largest difference, -1 before the first sample */
    int x, channel; /* where it is first */
} RowSums;

typedef struct RowsContext {
    const Image *a, *b;
    int failSteps; /* a pixel differs when a channel differs by more steps */
    RowSums *rows;
} RowsContext;

static const char *encodingName(Encoding encoding)
{
    return encoding == ENCODING_LINEAR ? "linear" : "sRGB-encoded";
}

Status checkComparable(const Image *a, const char *aName, const Image *b, const char *bName)
{
    if (a->width != b->width || a->height != b->height)
        return statusError(STATUS_MISMATCH,
                           "the pictures differ in size: %s is %dx%d, %s is %dx%d pixels; "
                           "render both at one size (--width, --height)",
                           aName, a->width, a->height, bName, b->width, b->height);
    if (a->bitDepth != b->bitDepth)
        return statusError(STATUS_MISMATCH,
                           "the pictures differ in bit depth: %s has %d bits, %s has %d bits a sample; "
                           "render both at one depth (--bit-depth)",
                           aName, a->bitDepth, bName, b->bitDepth);
    if (a->encoding != b->encoding)
        return statusError(STATUS_MISMATCH,
                           "the pictures differ in encoding: %s is %s, %s is %s by its chunks (none means "
                           "sRGB); render both in one encoding (--encoding)",
                           aName, encodingName(a->encoding), bName, encodingName(b->encoding));
    return statusOk();
}

static void sumRow(const RowsContext *context, int y)
{
    int width = context->a->width;
    size_t start = 3 * (size_t)y * (size_t)width;
    const uint16_t *a = context->a->samples + start, *b = context->b->samples + start;
    RowSums sums = {.largest = -1};
    for (int x = 0; x < width; x++, a += 3, b += 3) {
        int pixelLargest = 0;
        for (int channel = 0; channel < 3; channel++) {
            int difference = abs(a[channel] - b[channel]);
            sums.absolute += (uint64_t)difference;
            sums.squares += (uint64_t)difference * (uint64_t)difference;
            if (difference > pixelLargest)
                pixelLargest = difference;
            if (difference > sums.largest) {
                sums.largest = difference;
                sums.x = x;
                sums.channel = channel;
            }
        }
        sums.identical += pixelLargest == 0;
        sums.differing += pixelLargest > context->failSteps;
    }
    context->rows[y] = sums;
}

static void sumRows(void *argument, size_t number)
{
    const RowsContext *context = argument;
    int first = (int)number * ROWS_PER_TASK;
    for (int y = first; y < first + ROWS_PER_TASK && y < context->a->height; y++)
        sumRow(context, y);
}

/* The most steps that are not more than fail: steps / largest <= fail, decided in double by one division,
 * so that a fail written as 0.00392156862745098 means exactly 1/255. A NAN is no limit. */
static int stepsWithin(double fail, int largest)
{
    int steps = -1;
    while (steps < largest && !((double)(steps + 1) / largest > fail))
        steps++;
    return steps;
}

/* Add the rows up, from the top. */
static void addRows(const RowsContext *context, Metrics *metrics)
{
    const Image *a = context->a, *b = context->b;
    double largestSample = imageMaxSample(a);
    double squares = 0;
    uint64_t absolute = 0; /* at most 2^31 * 3 * 65535 */
    int largest = -1;
    for (int y = 0; y < a->height; y++) {
        const RowSums *row = &context->rows[y];
        absolute += row->absolute;
        squares += (double)row->squares;
        metrics->identicalPixels += (size_t)row->identical;
        metrics->differingPixels += (size_t)row->differing;
        /* Keep the first of the worst in reading order. */
        if (row->largest > largest) {
            largest = row->largest;
            metrics->worst.x = row->x;
            metrics->worst.y = y;
            metrics->worst.channel = row->channel;
        }
    }
    WorstPixel *worst = &metrics->worst;
    size_t at = 3 * ((size_t)worst->y * (size_t)a->width + (size_t)worst->x) + (size_t)worst->channel;
    worst->a = a->samples[at] / largestSample;
    worst->b = b->samples[at] / largestSample;
    metrics->maxDifference = largest / largestSample;
    metrics->differingPercent = 100.0 * (double)metrics->differingPixels / (double)metrics->pixels;
    double samples = 3.0 * (double)metrics->pixels;
    metrics->mae = (double)absolute / samples / largestSample;
    metrics->rmse = sqrt(squares / samples) / largestSample;
    /* PSNR = 10 log10(1 / mean square); equal pictures have none. */
    metrics->psnr = squares > 0 ? -20 * log10(metrics->rmse) : NAN;
}

Status measureImages(const Image *a, const Image *b, double fail, int threads, Metrics *metrics)
{
    size_t height = (size_t)a->height;
    RowsContext context = {a, b, stepsWithin(fail, (int)imageMaxSample(a)),
                           malloc(height * sizeof *context.rows)};
    if (context.rows == NULL)
        return statusOutOfMemory();
    Metrics result = {.width = a->width, .height = a->height, .pixels = (size_t)a->width * height};
    Status status = runTasks((height + ROWS_PER_TASK - 1) / ROWS_PER_TASK, threads, sumRows, &context);
    if (statusIsOk(&status)) {
        addRows(&context, &result);
        status = measureSsim(a, b, threads, &result.ssim);
    }
    if (statusIsOk(&status))
        status = measureFlip(a, b, threads, &result.flip);
    if (statusIsOk(&status))
        *metrics = result;
    free(context.rows);
    return status;
}
