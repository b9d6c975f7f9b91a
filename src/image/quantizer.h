/* quantizer.h - quantizeSample (colors.h) for many samples at once.
 *
 * The integers are those of quantizeSample for every float there is, NaN and infinities included; only
 * the time differs. A Quantizer is never changed once made, so any number of threads may share it.
 */
#ifndef ECLAIRAGE_IMAGE_QUANTIZER_H
#define ECLAIRAGE_IMAGE_QUANTIZER_H

#include "colors.h"

#include <stddef.h>
#include <stdint.h>

typedef struct Quantizer Quantizer;

/* For samples of bits (8 or 16), of which about sampleCount are to come: preparing costs as much as some
 * 10,000 samples, so for few of them nothing is prepared. NULL when memory runs out; freed by the caller
 * with freeQuantizer. */
Quantizer *createQuantizer(int bits, Encoding encoding, size_t sampleCount);
void freeQuantizer(Quantizer *quantizer);

/* samples[3 i], [3 i + 1] and [3 i + 2] are quantizeSample of pixels[i].r, .g and .b, for i below count. */
void quantizePixels(const Quantizer *quantizer, const Color3f *pixels, size_t count, uint16_t *samples);

#endif
