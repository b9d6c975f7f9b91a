/* sample_rounding.h - the samples of pictures as numbers, and when two of them differ by more than rounding.
 *
 * Bit depth and encoding of the two may be others. Samples of one encoding differ when they are more than a
 * step and a half of the coarser depth apart: each may be rounded the other way, and a renderer may be a
 * little off. Of two encodings, they differ when no light could have been stored as both.
 */
#ifndef ECLAIRAGE_EXPLAIN_SAMPLE_ROUNDING_H
#define ECLAIRAGE_EXPLAIN_SAMPLE_ROUNDING_H

#include "image/image.h"

#include <stdbool.h>
#include <stddef.h>

/* A sample as it is stored, 0..1; its number is 3 * pixel + channel. */
static inline float sampleAsStored(const Image *image, size_t sample)
{
    return (float)image->samples[sample] / (float)imageMaxSample(image);
}

/* The linear light that a sample stands for, 0..1. */
float sampleAsLight(const Image *image, size_t sample);

/* What rounding alone may leave: a root mean square error, of pictures of 8 or 16 bits. */
static inline double roundingError(int bitDepth)
{
    return bitDepth == 8 ? 0.4 / 255 : 0.6 / 65535;
}

/* Whether any channel of a pixel differs by more than rounding. Both have the same width and height. */
bool pixelsDiffer(const Image *a, const Image *b, size_t pixel);

/* The same for all pixels, to be freed; NULL when memory runs out. */
bool *findDifferentPixels(const Image *a, const Image *b);

#endif
