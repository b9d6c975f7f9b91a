/* sample_rounding.c - see sample_rounding.h. */
#include "explain/sample_rounding.h"

#include <math.h>
#include <stdlib.h>

static float storedAsLight(const Image *image, float stored)
{
    return image->encoding == ENCODING_SRGB ? srgbToLinear(stored) : stored;
}

float sampleAsLight(const Image *image, size_t sample)
{
    return storedAsLight(image, sampleAsStored(image, sample));
}

/* The light that a sample may stand for, with a step and a half of its rounding in all. */
static void lightRange(const Image *image, size_t sample, float *low, float *high)
{
    float v = sampleAsStored(image, sample), reach = 0.75f / (float)imageMaxSample(image);
    *low = storedAsLight(image, fmaxf(v - reach, 0));
    *high = storedAsLight(image, fminf(v + reach, 1));
}

static bool lightsDiffer(const Image *a, const Image *b, size_t sample)
{
    float aLow, aHigh, bLow, bHigh;
    lightRange(a, sample, &aLow, &aHigh);
    lightRange(b, sample, &bLow, &bHigh);
    return aHigh < bLow || bHigh < aLow;
}

bool pixelsDiffer(const Image *a, const Image *b, size_t pixel)
{
    float step = a->bitDepth == 8 || b->bitDepth == 8 ? 1.0f / 255 : 1.0f / 65535;
    for (size_t i = 3 * pixel; i < 3 * pixel + 3; i++)
        if (a->encoding != b->encoding ? lightsDiffer(a, b, i)
                                       : fabsf(sampleAsStored(a, i) - sampleAsStored(b, i)) > 1.5f * step)
            return true;
    return false;
}

bool *findDifferentPixels(const Image *a, const Image *b)
{
    size_t count = (size_t)a->width * (size_t)a->height;
    bool *isDifferent = malloc(count * sizeof *isDifferent);
    for (size_t i = 0; i < count && isDifferent != NULL; i++)
        isDifferent[i] = pixelsDiffer(a, b, i);
    return isDifferent;
}
