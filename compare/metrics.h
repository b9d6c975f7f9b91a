/* metrics.h - how far two pictures lie apart, and whether that is within tolerance (METRICS.md). */
#ifndef ECLAIRAGE_COMPARE_METRICS_H
#define ECLAIRAGE_COMPARE_METRICS_H

#include "base/status.h"
#include "base/tolerance.h"
#include "image/image.h"

#include <stdbool.h>
#include <stddef.h>

/* The pixel and channel that differ most; of several the first in reading order. */
typedef struct WorstPixel {
    int x, y;
    int channel; /* 0, 1, 2: r, g, b */
    double a, b; /* both values, 0..1 as stored */
} WorstPixel;

/* All differences are of samples as stored, in 0..1, without gamma decoding, the three channels pooled;
 * flip and ssim are of the sRGB encodings. */
typedef struct Metrics {
    int width, height;
    size_t pixels;
    size_t identicalPixels; /* equal in every sample */
    size_t differingPixels; /* a channel differs by more than the tolerance's fail */
    double differingPercent;
    double maxDifference;
    WorstPixel worst;
    double mae, rmse;
    double psnr; /* dB; NAN for equal pictures */
    double ssim; /* NAN for pictures under 11 x 11 */
    double flip; /* mean, 0..1 */
} Metrics;

enum {
    MAX_REASONS = 8,
    REASON_SIZE = 160
};

typedef struct Verdict {
    bool pass;
    int reasonCount;                        /* 0 when pass */
    char reasons[MAX_REASONS][REASON_SIZE]; /* one sentence each: the limit, the value */
} Verdict;

/* STATUS_MISMATCH, saying what and both values, when the two differ in width, height, bit depth or
 * encoding; aName and bName stand for them in the message. */
Status checkComparable(const Image *a, const char *aName, const Image *b, const char *bName);

/* All metrics of two comparable images; a is ours or the test, b the reference. STATUS_IO when memory
 * runs out, STATUS_INTERRUPTED when cancelled. The same numbers for any number of threads. */
Status measureImages(const Image *a, const Image *b, double fail, int threads, Metrics *metrics);

/* Hold the metrics against the limits. */
Verdict judgeMetrics(const Metrics *metrics, const Tolerance *tolerance);

#endif
