/* evidence.c - see evidence.h. */
#include "explain/evidence.h"

#include "base/cancel.h"
#include "explain/sample_rounding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Which pixels ---- */

/* Add wanted of the members of a kind of pixels, evenly spread: member number i when (i * wanted) / members
 * steps on. */
typedef struct Stratum {
    size_t members, wanted, seen;
} Stratum;

static bool isTaken(Stratum *stratum)
{
    size_t i = stratum->seen++;
    return (i + 1) * stratum->wanted / stratum->members != i * stratum->wanted / stratum->members;
}

Status gatherEvidence(const Image *wrong, const bool *isDifferent, const bool *isIgnored, size_t mostPixels,
                      Evidence *evidence)
{
    if (cancelRequested())
        return statusInterrupted();
    size_t total = (size_t)wrong->width * (size_t)wrong->height;
    Stratum strata[2] = {{0}, {0}};
    for (size_t i = 0; i < total; i++)
        if (isIgnored == NULL || !isIgnored[i])
            strata[isDifferent[i]].members++;

    /* Half of each kind, and what one does not need to the other. */
    for (int k = 0; k < 2; k++) {
        size_t other = strata[1 - k].members < mostPixels / 2 ? strata[1 - k].members : mostPixels / 2;
        size_t most = mostPixels - other;
        strata[k].wanted = strata[k].members < most ? strata[k].members : most;
    }
    EvidencePixel *pixels = malloc((strata[0].wanted + strata[1].wanted + 1) * sizeof *pixels);
    if (pixels == NULL)
        return statusOutOfMemory();
    size_t count = 0;
    for (size_t i = 0; i < total; i++) {
        Stratum *stratum = &strata[isDifferent[i]];
        if ((isIgnored != NULL && isIgnored[i]) || stratum->wanted == 0 || !isTaken(stratum))
            continue;
        EvidencePixel *pixel = &pixels[count++];
        pixel->x = (int)(i % (size_t)wrong->width);
        pixel->y = (int)(i / (size_t)wrong->width);
        pixel->weight = (float)stratum->members / (float)stratum->wanted;
        for (size_t c = 0; c < 3; c++)
            pixel->samples[c] = sampleAsStored(wrong, 3 * i + c);
    }
    *evidence = (Evidence){.format = {wrong->bitDepth, wrong->encoding},
                           .width = wrong->width,
                           .height = wrong->height,
                           .pixels = pixels,
                           .count = count};
    return statusOk();
}

void freeEvidence(Evidence *evidence)
{
    free(evidence->pixels);
    *evidence = (Evidence){0};
}

/* ---- How far off ---- */

Status createPrediction(size_t count, int alternatives, Prediction *prediction)
{
    size_t floats = 3 * count;
    float *memory = malloc(((size_t)(2 * alternatives + 1) * floats + 1) * sizeof *memory);
    ValuePlace *places = calloc(count + 1, sizeof *places);
    if (memory == NULL || places == NULL) {
        free(memory);
        free(places);
        return statusOutOfMemory();
    }
    *prediction =
        (Prediction){.count = count, .alternatives = alternatives, .middle = memory, .places = places};
    for (int i = 0; i < alternatives; i++) {
        prediction->low[i] = memory + (size_t)(2 * i + 1) * floats;
        prediction->high[i] = memory + (size_t)(2 * i + 2) * floats;
    }
    return statusOk();
}

void freePrediction(Prediction *prediction)
{
    free(prediction->middle);
    free(prediction->places);
    *prediction = (Prediction){0};
}

static float squaredDistance(const float sample[3], const float low[3], const float high[3])
{
    float sum = 0;
    for (int c = 0; c < 3; c++) {
        float below = low[c] - sample[c], above = sample[c] - high[c];
        float error = below > 0 ? below : above > 0 ? above : 0;
        sum += error * error;
    }
    return sum;
}

Misfit measureMisfit(const Evidence *evidence, const Prediction *prediction, const ValueChange *change,
                     size_t step, double limit)
{
    double sum = 0, plain = 0, known = 0, total = 0;
    for (size_t i = 0; i < evidence->count; i += step)
        total += (double)evidence->pixels[i].weight;
    double mostSum = 3 * total * limit * limit * (1 + 1e-9);
    for (size_t i = 0; i < evidence->count && sum <= mostSum; i += step) {
        const EvidencePixel *pixel = &evidence->pixels[i];
        const ValuePlace *place = &prediction->places[i];
        if (prediction->low[0][3 * i] > prediction->high[0][3 * i])
            continue;
        float nearest = INFINITY, low[3], high[3];
        bool hasRange = false;
        for (int a = 0; a < prediction->alternatives; a++) {
            const float *from = prediction->low[a] + 3 * i, *to = prediction->high[a] + 3 * i;
            storedSamples(change, evidence->format, place, from, low);
            bool isRange = memcmp(from, to, 3 * sizeof *from) != 0;
            hasRange |= isRange;
            if (isRange)
                storedSamples(change, evidence->format, place, to, high);
            float distance = squaredDistance(pixel->samples, low, isRange ? high : low);
            nearest = distance < nearest ? distance : nearest;
        }
        sum += (double)(pixel->weight * nearest);
        float guess = nearest;
        if (hasRange) {
            storedSamples(change, evidence->format, place, prediction->middle + 3 * i, low);
            guess = squaredDistance(pixel->samples, low, low);
        }
        plain += (double)(pixel->weight * guess);
        known += (double)pixel->weight;
    }
    if (!(known > 0) || sum > mostSum)
        return (Misfit){INFINITY, INFINITY, 0};
    return (Misfit){sqrt(sum / (3 * known)), sqrt(plain / (3 * known)), known / total};
}
