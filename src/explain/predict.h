/* predict.h - what a wrong picture would look like: from the right picture, or from the scene.
 *
 * A picture can be looked up elsewhere (mirrored, shifted, stretched). A scene can be traced with other
 * formulas too, and its colours are neither clamped nor rounded, so what it predicts is exact.
 */
#ifndef ECLAIRAGE_EXPLAIN_PREDICT_H
#define ECLAIRAGE_EXPLAIN_PREDICT_H

#include "engine/engine.h"
#include "explain/evidence.h"
#include "explain/light_change.h"
#include "explain/ray_memory.h"
#include "explain/view_change.h"

#include <stdbool.h>

/* The linear light that a stored sample may stand for: half a step of its rounding to both sides. */
typedef struct LightRange {
    float low, middle, high;
} LightRange;

/* What is right: a picture, or a scene; the other is NULL. Of these only ranges and transparent are owned. */
typedef struct Truth {
    const Image *picture;
    LightRange *ranges; /* of each sample that the picture may have */
    const Scene *scene;
    const SurfaceFinder *finder; /* of the scene */
    uint32_t *transparent;       /* numbers of its transparent objects */
    size_t transparentCount;
    int threads;
} Truth;

/* STATUS_IO when memory runs out. Freed with freeTruth. */
Status truthOfPicture(const Image *picture, Truth *truth);

/* The scene's finder must live as long. STATUS_IO when memory runs out. Freed with freeTruth. */
Status truthOfScene(const SurfaceFinder *finder, int threads, Truth *truth);
void freeTruth(Truth *truth);

/* What the evidence's pixels would be after these changes. acne: any lamps may be blocked at any pixel, and
 * all ways are given. A picture knows no light, so light is for scenes only and may be NULL. STATUS_IO when
 * memory runs out, STATUS_INTERRUPTED when cancelled. memories: one for each pixel, of the rays of earlier
 * predictions, which makes it faster and changes nothing else; or NULL. The caller frees *prediction. */
Status predictPixels(const Truth *truth, const Evidence *evidence, PixelMemory *memories,
                     const ViewChange *view, const LightChange *light, bool acne, Prediction *prediction);

/* How many times as many rays as the simplest scenes' a pixel has, roughly; 1 for a picture. */
size_t predictionCost(const Truth *truth);

#endif
