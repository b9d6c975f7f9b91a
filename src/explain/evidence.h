/* evidence.h - the pixels that a hypothesis is held against, and how far off it is there.
 *
 * A wrong picture is looked at in a list of its pixels: all of them, or a sample in which those that differ
 * from the right picture are half. A hypothesis predicts for each of them a linear colour, or a range of
 * colours, or several. The error of a channel is the distance of the stored sample from what was predicted,
 * stored in the same way.
 */
#ifndef ECLAIRAGE_EXPLAIN_EVIDENCE_H
#define ECLAIRAGE_EXPLAIN_EVIDENCE_H

#include "explain/value_change.h"
#include "image/image.h"

#include <stddef.h>

typedef struct EvidencePixel {
    int x, y;
    float weight;     /* how many pixels of the picture it stands for */
    float samples[3]; /* of the wrong picture, as stored, 0..1 */
} EvidencePixel;

typedef struct Evidence {
    StoredFormat format;
    int width, height;
    EvidencePixel *pixels; /* owned */
    size_t count;
} Evidence;

/* Choose at most mostPixels pixels of the wrong picture. isDifferent: for each pixel, whether it differs from
 * the right one's by more than rounding; isIgnored: whether it is left out, or NULL. STATUS_IO when memory
 * runs out, STATUS_INTERRUPTED when cancelled; then evidence is untouched. Freed with freeEvidence. */
Status gatherEvidence(const Image *wrong, const bool *isDifferent, const bool *isIgnored, size_t mostPixels,
                      Evidence *evidence);
void freeEvidence(Evidence *evidence);

enum {
    MAX_ALTERNATIVES = 8
};

/* What is predicted for the evidence's pixels. low, high: [alternative][3 * pixel + channel], linear, the
 * ends of a range; low above high: not known, and does not count. */
typedef struct Prediction {
    size_t count;
    int alternatives; /* at least 1; the nearest one counts */
    float *low[MAX_ALTERNATIVES], *high[MAX_ALTERNATIVES];
    float *middle; /* a single best guess, for those hypotheses that are not let off with a range */
    ValuePlace *places;
} Prediction;

/* Room for a prediction of so many pixels; STATUS_IO when memory runs out. Freed with freePrediction. */
Status createPrediction(size_t count, int alternatives, Prediction *prediction);
void freePrediction(Prediction *prediction);

typedef struct Misfit {
    double rmse;  /* by the ranges */
    double plain; /* by the best guesses */
    double known; /* the share of the picture that was predicted */
} Misfit;

/* Look at every step-th pixel only. Where rmse would be above limit, all of them may be INFINITY: most
 * hypotheses are only asked whether they are better than another one, and few pixels tell. */
Misfit measureMisfit(const Evidence *evidence, const Prediction *prediction, const ValueChange *change,
                     size_t step, double limit);

#endif
