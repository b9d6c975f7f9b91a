/* part_fit.c - see part_fit.h. */
#include "explain/part_fit.h"

#include <math.h>

/* The normal equations of one channel: matrix * added = wanted. */
typedef struct Equations {
    double matrix[MOST_FITTED][MOST_FITTED], wanted[MOST_FITTED];
} Equations;

/* How much a stored sample changes with the linear light, squared: where it changes much, it says more. */
static double weightAt(StoredFormat format, double linear)
{
    if (format.encoding != ENCODING_SRGB)
        return 1;
    double v = fmax(linear, 0.0031308);
    double slope = 1.055 / 2.4 * pow(v, 1 / 2.4 - 1);
    return slope * slope;
}

static void addPixel(double missing, double weight, const double *terms, int count, Equations *equations)
{
    for (int i = 0; i < count; i++) {
        equations->wanted[i] += weight * terms[i] * missing;
        for (int j = 0; j < count; j++)
            equations->matrix[i][j] += weight * terms[i] * terms[j];
    }
}

static void gather(const Evidence *evidence, const Prediction *before, const Prediction *terms, int count,
                   size_t channel, Equations *equations)
{
    *equations = (Equations){.wanted = {0}};
    for (size_t p = 0; p < evidence->count; p++) {
        const EvidencePixel *pixel = &evidence->pixels[p];
        float stored = pixel->samples[channel];
        if (!(stored < 1))
            continue;
        size_t at = 3 * p + channel;
        double linear = (double)(evidence->format.encoding == ENCODING_SRGB ? srgbToLinear(stored) : stored);
        double there = (double)before->low[0][at], ofPixel[MOST_FITTED];
        bool isFinite = isfinite(there);
        for (int i = 0; i < count; i++) {
            ofPixel[i] = (double)terms[i].low[0][at] - there;
            isFinite = isFinite && isfinite(ofPixel[i]);
        }
        if (isFinite)
            addPixel(linear - there, (double)pixel->weight * weightAt(evidence->format, linear), ofPixel,
                     count, equations);
    }
}

/* Solve by Gauss and Jordan with pivots on the diagonal. A colour whose pivot is next to nothing beside what
 * it was is not seen, or cannot be told from those before it: it stays as it is. */
static void solve(Equations *equations, int count, double *added, bool *isSeen)
{
    double was[MOST_FITTED];
    for (int i = 0; i < count; i++) {
        was[i] = equations->matrix[i][i];
        isSeen[i] = false;
    }
    for (int step = 0; step < count; step++) {
        int pivot = -1;
        for (int i = 0; i < count; i++) {
            bool isLarge = equations->matrix[i][i] > 1e-7 * was[i] && equations->matrix[i][i] > 1e-12;
            if (!isSeen[i] && isLarge &&
                (pivot < 0 || equations->matrix[i][i] > equations->matrix[pivot][pivot]))
                pivot = i;
        }
        if (pivot < 0)
            break;
        isSeen[pivot] = true;
        for (int i = 0; i < count; i++) {
            if (i == pivot)
                continue;
            double factor = equations->matrix[i][pivot] / equations->matrix[pivot][pivot];
            for (int j = 0; j < count; j++)
                equations->matrix[i][j] -= factor * equations->matrix[pivot][j];
            equations->wanted[i] -= factor * equations->wanted[pivot];
        }
    }
    for (int i = 0; i < count; i++)
        added[i] = isSeen[i] ? equations->wanted[i] / equations->matrix[i][i] : 0;
}

void fitColors(const Evidence *evidence, const Prediction *before, const Prediction *terms, int count,
               float added[][3], bool isSeen[][3])
{
    for (size_t channel = 0; channel < 3; channel++) {
        Equations equations;
        double solution[MOST_FITTED];
        bool seen[MOST_FITTED];
        gather(evidence, before, terms, count, channel, &equations);
        solve(&equations, count, solution, seen);
        for (int i = 0; i < count; i++) {
            added[i][channel] = (float)solution[i];
            isSeen[i][channel] = seen[i];
        }
    }
}
