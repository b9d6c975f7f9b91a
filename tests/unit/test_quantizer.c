/* test_quantizer.c - many samples at once are the samples of quantizeSample, one by one.
 *
 * All 2^32 floats were compared once, for both depths and encodings, on x86-64 with glibc 2.36: none
 * differed. Here are every 1009th of them, all floats about every threshold between two samples, and
 * what is special.
 */
#include "file_checks.h"
#include "image/image.h"
#include "image/quantizer.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    BATCH = 3 * 4096,
    MANY = 1 << 24, /* samples to come, for which a table is made */
    FEW = 10        /* and for which none is */
};

static float floatOfBits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t bitsOfFloat(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* Values collected until there is a batch to compare. */
typedef struct Batch {
    Quantizer *quantizer;
    int bits;
    Encoding encoding;
    float values[BATCH];
    size_t count;
} Batch;

static Batch *createBatch(int bits, Encoding encoding, size_t sampleCount)
{
    Batch *batch = calloc(1, sizeof *batch);
    assert_non_null(batch);
    batch->quantizer = createQuantizer(bits, encoding, sampleCount);
    assert_non_null(batch->quantizer);
    batch->bits = bits;
    batch->encoding = encoding;
    return batch;
}

static void compareBatch(Batch *batch)
{
    static Color3f pixels[BATCH / 3];
    static uint16_t samples[BATCH];
    size_t pixelCount = batch->count / 3;
    for (size_t i = 0; i < pixelCount; i++)
        pixels[i] = createColor(batch->values[3 * i], batch->values[3 * i + 1], batch->values[3 * i + 2]);
    quantizePixels(batch->quantizer, pixels, pixelCount, samples);
    for (size_t i = 0; i < batch->count; i++) {
        unsigned expected = quantizeSample(batch->values[i], batch->bits, batch->encoding);
        if (samples[i] != expected)
            fail_msg("%d bits, encoding %d: %a is %u in place of %u", batch->bits, (int)batch->encoding,
                     (double)batch->values[i], samples[i], expected);
    }
    batch->count = 0;
}

static void addValue(Batch *batch, uint32_t bits)
{
    batch->values[batch->count++] = floatOfBits(bits);
    if (batch->count == BATCH)
        compareBatch(batch);
}

/* Compare the rest too, filled up to whole pixels. */
static void freeBatch(Batch *batch)
{
    while (batch->count % 3 != 0)
        batch->values[batch->count++] = 0.5f;
    compareBatch(batch);
    freeQuantizer(batch->quantizer);
    free(batch);
}

static void agreesOverAllFloats(void **state)
{
    (void)state;
    for (int bits = 8; bits <= 16; bits += 8) {
        for (int linear = 0; linear <= 1; linear++) {
            Batch *batch = createBatch(bits, linear ? ENCODING_LINEAR : ENCODING_SRGB, MANY);
            for (uint64_t pattern = 0; pattern <= UINT32_MAX; pattern += 1009)
                addValue(batch, (uint32_t)pattern);
            freeBatch(batch);
        }
    }
}

static void agreesOnWhatIsSpecial(void **state)
{
    (void)state;
    static const float values[] = {0.0f,
                                   -0.0f,
                                   1.0f,
                                   -1.0f,
                                   NAN,
                                   -NAN,
                                   INFINITY,
                                   -INFINITY,
                                   0x1p-149f,
                                   -0x1p-149f,
                                   0x1p-126f,
                                   0x1p-21f,
                                   0x1.fffffep-22f,
                                   0x1p-9f,
                                   0x1.fffffep-1f,
                                   0x1.000002p0f,
                                   3.4e38f,
                                   0.0031308f};
    for (size_t samples = FEW; samples <= MANY; samples += MANY - FEW) {
        for (int bits = 8; bits <= 16; bits += 8) {
            for (int linear = 0; linear <= 1; linear++) {
                Batch *batch = createBatch(bits, linear ? ENCODING_LINEAR : ENCODING_SRGB, samples);
                for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
                    uint32_t pattern = bitsOfFloat(values[i]);
                    for (uint32_t near = 0; near < 100; near++)
                        addValue(batch, pattern - 50 + near);
                }
                freeBatch(batch);
            }
        }
    }
}

/* The least bits of a float in 0..1 whose sample is at least sample, found by halving. */
static uint32_t findThreshold(unsigned sample, int bits, Encoding encoding)
{
    uint32_t below = 0, at = bitsOfFloat(1.0f);
    while (at - below > 1) {
        uint32_t middle = below + (at - below) / 2;
        if (quantizeSample(floatOfBits(middle), bits, encoding) >= sample)
            at = middle;
        else
            below = middle;
    }
    return at;
}

static void agreesAtEveryThreshold(void **state)
{
    (void)state;
    for (int bits = 8; bits <= 16; bits += 8) {
        /* Of 16 bits a third of the thresholds, each with fewer floats about it. */
        unsigned step = bits == 8 ? 1 : 3;
        uint32_t reach = bits == 8 ? 500 : 6;
        for (int linear = 0; linear <= 1; linear++) {
            Encoding encoding = linear ? ENCODING_LINEAR : ENCODING_SRGB;
            Batch *batch = createBatch(bits, encoding, MANY);
            for (unsigned sample = 1; sample < 1u << bits; sample += step) {
                uint32_t threshold = findThreshold(sample, bits, encoding);
                for (uint32_t near = 0; near <= 2 * reach; near++)
                    addValue(batch, threshold - reach + near);
            }
            freeBatch(batch);
        }
    }
}

/* Small pictures and large ones, cut into tasks anywhere, on any number of threads. */
static void convertsWholePictures(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {1, 977}, {977, 1}, {301, 401}, {100001, 1}, {1, 100001}};
    static const int threads[] = {1, 2, 7};
    uint32_t random = 1;
    for (size_t size = 0; size < sizeof sizes / sizeof *sizes; size++) {
        int width = sizes[size][0], height = sizes[size][1];
        Framebuffer *framebuffer = createFramebuffer(width, height);
        assert_non_null(framebuffer);
        size_t pixels = (size_t)width * (size_t)height;
        for (size_t i = 0; i < pixels; i++) {
            random = random * 1664525u + 1013904223u;
            float value = (float)random * 0x1.2p-32f - 0.05f;
            framebuffer->pixels[i] = createColor(value, value * value, i % 100 == 0 ? NAN : 0.01f * value);
        }
        for (size_t run = 0; run < sizeof threads / sizeof *threads; run++) {
            for (int kind = 0; kind < 4; kind++) {
                int bits = kind < 2 ? 8 : 16;
                Encoding encoding = kind % 2 == 0 ? ENCODING_SRGB : ENCODING_LINEAR;
                Image image;
                assertOk(imageFromFramebuffer(framebuffer, bits, encoding, threads[run], &image));
                assert_int_equal(image.width, width);
                assert_int_equal(image.height, height);
                for (size_t i = 0; i < pixels; i++) {
                    Color3f c = framebuffer->pixels[i];
                    assert_true(image.samples[3 * i] == quantizeSample(c.r, bits, encoding));
                    assert_true(image.samples[3 * i + 1] == quantizeSample(c.g, bits, encoding));
                    assert_true(image.samples[3 * i + 2] == quantizeSample(c.b, bits, encoding));
                }
                freeImage(&image);
            }
        }
        freeFramebuffer(framebuffer);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agreesOverAllFloats),
        cmocka_unit_test(agreesOnWhatIsSpecial),
        cmocka_unit_test(agreesAtEveryThreshold),
        cmocka_unit_test(convertsWholePictures),
    };
    return cmocka_run_group_tests_name("quantizer", tests, NULL, NULL);
}
