/* quantizer.c - quantizeSample for many samples at once; see quantizer.h.
 *
 * quantizeSample(x) is the whole part of
 *
 *     v(x) = encode(x) (2^bits - 1) + 1/2,
 *
 * and what takes time in it is powf, in the curved part of sRGB. Here a table holds v at 1024 floats of each
 * power of two, in fixed point, and a chord between two neighbours approximates it. Invariant: where the
 * approximation is so near a whole number that it could fall on the wrong side, quantizeSample itself
 * decides, so nothing depends on how a machine's powf rounds, nor on its being monotone. How near is
 * worked out at MARGIN.
 */
#include "image/quantizer.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum {
    /* The floats from 2^-21 to 1 by their bits (IEEE 754: 8 bits of exponent, then 23 of mantissa), and
     * the 13 bits within a cell of the table. Below 2^-21 every sample is 0: 12.92 x 65535 + 1/2 < 1. */
    CELL_BITS = 13,
    FIRST_BITS = (127 - 21) << 23,
    ONE_BITS = 127 << 23,
    CELLS = (ONE_BITS - FIRST_BITS) >> CELL_BITS,

    /* v is held in units of 2^(bits-28): 2^-12 of a sample with 16 bits, and 2^-20 with 8 bits, whose
     * samples are 257 times as far apart. */
    VALUE_BITS = 28,

    /* In these units, about 1/16 of a 16-bit sample. Wrong, in 16-bit samples, may be: the chord by 0.002,
     * or in the one cell where the curve begins by 0.006; the rounding to units by 0.0005; the float
     * arithmetic after powf by 0.006 in a node of the table and by 0.010 in quantizeSample. That leaves
     * 0.039, so powf may be wrong by four units in the last place (0.0041 each) in both. */
    MARGIN = 256,

    /* Samples that repay the table. */
    WORTHWHILE = 1 << 17
};

struct Quantizer {
    int bits;
    Encoding encoding;
    bool hasTable;
    uint16_t white;            /* the sample of 1 and above */
    uint32_t table[CELLS + 1]; /* v at the lower end of each cell, and at 1; only if hasTable */
};

static uint32_t bitsOfFloat(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static float floatOfBits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

Quantizer *createQuantizer(int bits, Encoding encoding, size_t sampleCount)
{
    Quantizer *quantizer = malloc(sizeof *quantizer);
    if (quantizer == NULL)
        return NULL;
    quantizer->bits = bits;
    quantizer->encoding = encoding;
    quantizer->hasTable = sampleCount >= WORTHWHILE;
    quantizer->white = (uint16_t)quantizeSample(1.0f, bits, encoding);
    double largest = bits == 16 ? 65535.0 : 255.0;
    double unit = 1u << (VALUE_BITS - bits);
    for (uint32_t i = 0; i <= CELLS && quantizer->hasTable; i++) {
        float linear = floatOfBits(FIRST_BITS + (i << CELL_BITS));
        double encoded = (double)(encoding == ENCODING_SRGB ? linearToSrgb(linear) : linear);
        quantizer->table[i] = (uint32_t)((encoded * largest + 0.5) * unit + 0.5);
    }
    return quantizer;
}

void freeQuantizer(Quantizer *quantizer)
{
    free(quantizer);
}

/* quantizeSample by the table. */
static inline uint16_t lookUpSample(const Quantizer *quantizer, int bits, float linear)
{
    /* Take what lies outside the table, NaN too. */
    if (!(linear >= 0x1p-21f))
        return 0;
    if (linear >= 1.0f)
        return quantizer->white;

    /* Follow the chord across the cell; the product is below 2^31. */
    uint32_t offset = bitsOfFloat(linear) - FIRST_BITS;
    const uint32_t *node = quantizer->table + (offset >> CELL_BITS);
    uint32_t within = offset & ((1u << CELL_BITS) - 1);
    uint32_t value = node[0] + (((node[1] - node[0]) * within) >> CELL_BITS);

    /* Leave close calls to the judge. */
    uint32_t sampleUnit = 1u << (VALUE_BITS - bits);
    if (((value + MARGIN) & (sampleUnit - 1)) < 2 * MARGIN)
        return (uint16_t)quantizeSample(linear, bits, quantizer->encoding);
    return (uint16_t)(value / sampleUnit);
}

/* Inlined with bits known. */
static inline void lookUpPixels(const Quantizer *quantizer, int bits, const Color3f *pixels, size_t count,
                                uint16_t *samples)
{
    for (size_t i = 0; i < count; i++, samples += 3) {
        samples[0] = lookUpSample(quantizer, bits, pixels[i].r);
        samples[1] = lookUpSample(quantizer, bits, pixels[i].g);
        samples[2] = lookUpSample(quantizer, bits, pixels[i].b);
    }
}

void quantizePixels(const Quantizer *quantizer, const Color3f *pixels, size_t count, uint16_t *samples)
{
    if (quantizer->hasTable && quantizer->bits == 8) {
        lookUpPixels(quantizer, 8, pixels, count, samples);
        return;
    }
    if (quantizer->hasTable) {
        lookUpPixels(quantizer, 16, pixels, count, samples);
        return;
    }
    for (size_t i = 0; i < count; i++, samples += 3) {
        samples[0] = (uint16_t)quantizeSample(pixels[i].r, quantizer->bits, quantizer->encoding);
        samples[1] = (uint16_t)quantizeSample(pixels[i].g, quantizer->bits, quantizer->encoding);
        samples[2] = (uint16_t)quantizeSample(pixels[i].b, quantizer->bits, quantizer->encoding);
    }
}
