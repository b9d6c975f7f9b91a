/* The metrics: cases worked out by hand, values measured by others (tests/golden/metrics), and properties
 * that hold for all pictures: symmetry, independence of threads, tiles and bit depth. */
#include "compare/metrics.h"

#include "base/cancel.h"
#include "base/text.h"
#include "compare/lanes.h"

#include <locale.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define GOLDEN "tests/golden/metrics/"

static void assertNear(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.12g is not within %g of %.12g", value, tolerance, expected);
}

static Image makeImage(int width, int height, int bitDepth, Encoding encoding)
{
    Image image;
    Status status = createImage(width, height, bitDepth, encoding, &image);
    assert_true(statusIsOk(&status));
    return image;
}

static size_t countSamples(const Image *image)
{
    return 3 * (size_t)image->width * (size_t)image->height;
}

/* A picture of one colour. */
static Image uniformImage(int width, int height, unsigned r, unsigned g, unsigned b)
{
    Image image = makeImage(width, height, 8, ENCODING_SRGB);
    for (size_t i = 0; i < countSamples(&image); i += 3) {
        image.samples[i] = (uint16_t)r;
        image.samples[i + 1] = (uint16_t)g;
        image.samples[i + 2] = (uint16_t)b;
    }
    return image;
}

/* The constants of Knuth's MMIX; ssim_random.py draws the same numbers. */
static uint64_t state;

static unsigned draw(unsigned count)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)((state >> 33) % count);
}

/* A picture of noise, and the same with noise upon it. */
static void randomPair(int width, int height, int bitDepth, Encoding encoding, int noise, uint64_t seed,
                       Image pair[2])
{
    state = seed;
    pair[0] = makeImage(width, height, bitDepth, encoding);
    pair[1] = makeImage(width, height, bitDepth, encoding);
    int largest = (int)imageMaxSample(&pair[0]);
    for (size_t i = 0; i < countSamples(&pair[0]); i++)
        pair[0].samples[i] = (uint16_t)draw((unsigned)largest + 1);
    for (size_t i = 0; i < countSamples(&pair[0]); i++) {
        int value = pair[0].samples[i] + (int)draw(2 * (unsigned)noise + 1) - noise;
        pair[1].samples[i] = (uint16_t)(value < 0 ? 0 : value > largest ? largest : value);
    }
}

static Metrics measureWith(const Image *a, const Image *b, double fail, int threads)
{
    Metrics metrics;
    Status status = measureImages(a, b, fail, threads, &metrics);
    assert_true(statusIsOk(&status));
    return metrics;
}

static Metrics measure(const Image *a, const Image *b)
{
    return measureWith(a, b, 0.004, 2);
}

static void freePair(Image pair[2])
{
    freeImage(&pair[0]);
    freeImage(&pair[1]);
}

/* The same double, bit for bit, or both NAN. */
static void assertSame(double a, double b)
{
    assert_true(memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b)));
}

static void assertSameMetrics(const Metrics *a, const Metrics *b)
{
    assert_int_equal(a->identicalPixels, b->identicalPixels);
    assert_int_equal(a->differingPixels, b->differingPixels);
    assert_int_equal(a->worst.x, b->worst.x);
    assert_int_equal(a->worst.y, b->worst.y);
    assert_int_equal(a->worst.channel, b->worst.channel);
    assertSame(a->maxDifference, b->maxDifference);
    assertSame(a->differingPercent, b->differingPercent);
    assertSame(a->mae, b->mae);
    assertSame(a->rmse, b->rmse);
    assertSame(a->psnr, b->psnr);
    assertSame(a->ssim, b->ssim);
    assertSame(a->flip, b->flip);
}

static void samplesWorkedOutByHand(void **unused)
{
    (void)unused;
    /* Two by two pixels; the differences in steps are 0 0 0 | 0 51 0 | 0 0 1 | 51 0 51. */
    Image pair[2] = {uniformImage(2, 2, 100, 100, 100), uniformImage(2, 2, 100, 100, 100)};
    pair[1].samples[3 * 1 + 1] = 151;
    pair[1].samples[3 * 2 + 2] = 101;
    pair[1].samples[3 * 3 + 0] = 49;
    pair[1].samples[3 * 3 + 2] = 49;
    Metrics metrics = measure(&pair[0], &pair[1]);
    assert_int_equal(metrics.width, 2);
    assert_int_equal(metrics.height, 2);
    assert_int_equal(metrics.pixels, 4);
    assert_int_equal(metrics.identicalPixels, 1);
    assert_int_equal(metrics.differingPixels, 2); /* 1/255 is below 0.004 */
    assertNear(metrics.differingPercent, 50, 0);
    assertNear(metrics.maxDifference, 0.2, 1e-15);
    /* Three samples differ by 51: the worst is the first of them. */
    assert_int_equal(metrics.worst.x, 1);
    assert_int_equal(metrics.worst.y, 0);
    assert_int_equal(metrics.worst.channel, 1);
    assertNear(metrics.worst.a, 100 / 255.0, 0);
    assertNear(metrics.worst.b, 151 / 255.0, 0);
    assertNear(metrics.mae, 154 / 12.0 / 255, 1e-16);
    double square = (3 * 51.0 * 51 + 1) / 12 / (255.0 * 255);
    assertNear(metrics.rmse, sqrt(square), 1e-15);
    assertNear(metrics.psnr, 10 * log10(1 / square), 1e-12);
    assert_true(isnan(metrics.ssim));
    freePair(pair);
}

static void equalPictures(void **unused)
{
    (void)unused;
    static const int sizes[][2] = {{1, 1}, {1, 300}, {300, 1}, {10, 11}, {11, 11}, {200, 150}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        Image pair[2], other[2];
        randomPair(sizes[i][0], sizes[i][1], 8, ENCODING_SRGB, 9, i, pair);
        randomPair(sizes[i][0], sizes[i][1], 8, ENCODING_SRGB, 9, i, other);
        Metrics metrics = measure(&pair[0], &other[0]);
        assert_int_equal(metrics.identicalPixels, metrics.pixels);
        assert_int_equal(metrics.differingPixels, 0);
        assert_true(metrics.maxDifference == 0 && metrics.mae == 0 && metrics.rmse == 0);
        assert_true(metrics.differingPercent == 0 && metrics.flip == 0);
        assert_true(isnan(metrics.psnr));
        assert_int_equal(metrics.worst.x, 0);
        assert_int_equal(metrics.worst.y, 0);
        assertNear(metrics.worst.a, pair[0].samples[0] / 255.0, 0);
        if (sizes[i][0] >= 11 && sizes[i][1] >= 11)
            assert_true(metrics.ssim == 1);
        else
            assert_true(isnan(metrics.ssim));
        freePair(pair);
        freePair(other);
    }
}

/* A pixel differs when a channel differs by more than fail, and not when by just as much, though 1/255 is
 * no binary fraction. */
static void failIsExactAtEveryStep(void **unused)
{
    (void)unused;
    for (int bitDepth = 8; bitDepth <= 16; bitDepth += 8) {
        Image a = makeImage(1, 1, bitDepth, ENCODING_SRGB), b = makeImage(1, 1, bitDepth, ENCODING_SRGB);
        unsigned largest = imageMaxSample(&a);
        for (unsigned step = 0; step <= largest; step += bitDepth == 8 ? 1 : 977) {
            b.samples[1] = (uint16_t)step;
            char text[NUMBER_TEXT_SIZE];
            double fail = parseDouble(formatDouble(text, step / (double)largest), NULL);
            assert_int_equal(measureWith(&a, &b, fail, 1).differingPixels, 0);
            assert_int_equal(measureWith(&a, &b, nextafter(fail, -1), 1).differingPixels, 1);
        }
        freeImage(&a);
        freeImage(&b);
    }
    /* The course's tolerance of 3.1e-5 lets 2/65535 pass and 3/65535 not; a NAN lets all pass. */
    Image a = makeImage(1, 1, 16, ENCODING_LINEAR), b = makeImage(1, 1, 16, ENCODING_LINEAR);
    b.samples[2] = 2;
    assert_int_equal(measureWith(&a, &b, 3.1e-5, 1).differingPixels, 0);
    b.samples[2] = 3;
    assert_int_equal(measureWith(&a, &b, 3.1e-5, 1).differingPixels, 1);
    assert_int_equal(measureWith(&a, &b, NAN, 1).differingPixels, 0);
    assert_int_equal(measureWith(&a, &b, 1, 1).differingPixels, 0);
    freeImage(&a);
    freeImage(&b);
}

/* Squares of large pictures need more than 32 bits a row and more than 53 bits in all to be exact. */
static void largestDifferenceEverywhere(void **unused)
{
    (void)unused;
    Image a = makeImage(3000, 20, 16, ENCODING_SRGB), b = makeImage(3000, 20, 16, ENCODING_SRGB);
    for (size_t i = 0; i < countSamples(&a); i++)
        b.samples[i] = 65535;
    Metrics metrics = measure(&a, &b);
    assertNear(metrics.mae, 1, 0);
    assertNear(metrics.rmse, 1, 0);
    assertNear(metrics.maxDifference, 1, 0);
    assertNear(metrics.psnr, 0, 0);
    freeImage(&a);
    freeImage(&b);
}

static void pairsMeasuredByOthers(void **unused)
{
    (void)unused;
    FILE *file = fopen(GOLDEN "values.csv", "r");
    assert_non_null(file);
    char line[200];
    assert_non_null(fgets(line, sizeof line, file));
    int count = 0, pair;
    double flip, ssim, rmse, mae, largest;
    while (fscanf(file, "%d,%lf,%lf,%lf,%lf,%lf", &pair, &flip, &ssim, &rmse, &mae, &largest) == 6) {
        char path[100];
        Image reference, test;
        snprintf(path, sizeof path, GOLDEN "%d-reference.png", pair);
        Status status = readPng(path, &reference);
        assert_true(statusIsOk(&status));
        snprintf(path, sizeof path, GOLDEN "%d-test.png", pair);
        status = readPng(path, &test);
        assert_true(statusIsOk(&status));
        Metrics metrics = measure(&test, &reference);
        assertNear(metrics.flip, flip, 1e-5); /* 1e-4 is asked for; the reference computes in float */
        assertNear(metrics.ssim, ssim, 1e-6);
        assertNear(metrics.rmse, rmse, 1e-6);
        assertNear(metrics.mae, mae, 1e-6);
        assertNear(metrics.maxDifference, largest, 1e-6);
        freeImage(&reference);
        freeImage(&test);
        count++;
    }
    assert_int_equal(count, 3);
    fclose(file);
}

static void ssimMeasuredByOthers(void **unused)
{
    (void)unused;
    FILE *file = fopen(GOLDEN "ssim_random.csv", "r");
    assert_non_null(file);
    char line[200];
    assert_non_null(fgets(line, sizeof line, file));
    int count = 0, width, height, depth, linear, noise, seed;
    double ssim;
    while (fscanf(file, "%d,%d,%d,%d,%d,%d,%lf", &width, &height, &depth, &linear, &noise, &seed, &ssim) ==
           7) {
        Image pair[2];
        randomPair(width, height, depth, linear ? ENCODING_LINEAR : ENCODING_SRGB, noise, (uint64_t)seed,
                   pair);
        assertNear(measure(&pair[0], &pair[1]).ssim, ssim, 1e-9);
        freePair(pair);
        count++;
    }
    assert_int_equal(count, 7);
    fclose(file);
}

/* In uniform pictures all variances vanish: SSIM = (2 m n + C1) / (m^2 + n^2 + C1). */
static void ssimOfUniformPictures(void **unused)
{
    (void)unused;
    const double c1 = 1e-4;
    Image black = uniformImage(11, 11, 0, 0, 0), white = uniformImage(11, 11, 255, 255, 255);
    assertNear(measure(&black, &white).ssim, c1 / (1 + c1), 1e-12);
    /* Luma of red is 0.299, of green 0.587. */
    Image red = uniformImage(30, 12, 255, 0, 0), green = uniformImage(30, 12, 0, 255, 0);
    double m = 0.299, n = 0.587;
    assertNear(measure(&red, &green).ssim, (2 * m * n + c1) / (m * m + n * n + c1), 1e-12);
    freeImage(&black);
    freeImage(&white);
    freeImage(&red);
    freeImage(&green);
}

/* Filters leave uniform pictures as they are, border included, and find no feature in them: FLIP is the
 * colour difference alone, at every size. */
static void flipOfUniformPictures(void **unused)
{
    (void)unused;
    static const int sizes[][2] = {{1, 1}, {2, 1}, {1, 9}, {5, 3}, {129, 65}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        int width = sizes[i][0], height = sizes[i][1];
        Image black = uniformImage(width, height, 0, 0, 0);
        Image white = uniformImage(width, height, 255, 255, 255);
        Image green = uniformImage(width, height, 0, 255, 0), blue = uniformImage(width, height, 0, 0, 255);
        Image grey = uniformImage(width, height, 119, 119, 119);
        /* Green and blue are the farthest colours. */
        assertNear(measure(&green, &blue).flip, 1, 1e-6);
        /* CIELab of green is (87.735, -86.183, 83.180), of blue (32.300, 79.191, -107.857). With a and b
         * times L / 100 they lie 55.435 + hypot(101.190, 107.815) = 203.298 apart: 203.298^0.7 = 41.281,
         * the knee is at 0.4 of it, 16.512. White lies 100 from black, 100^0.7 = 25.119, beyond it:
         * 0.95 + 0.05 (25.119 - 16.512) / (41.281 - 16.512) = 0.96737. */
        assertNear(measure(&black, &white).flip, 0.96737, 2e-5);
        /* sRGB 119 is linear 0.18447, L = 116 0.18447^(1/3) - 16 = 50.034, 50.034^0.7 = 15.473, before
         * it: 0.95 15.473 / 16.512 = 0.8902. */
        assertNear(measure(&black, &grey).flip, 0.8902, 1e-4);
        freeImage(&black);
        freeImage(&white);
        freeImage(&green);
        freeImage(&blue);
        freeImage(&grey);
    }
}

/* The same blemish on a uniform picture counts the same wherever it lies: on seams of tiles too. */
static void blemishCountsTheSameEverywhere(void **unused)
{
    (void)unused;
    static const int places[][2] = {{100, 50},  {127, 63},  {128, 64},  {128, 40}, {60, 64},
                                    {122, 58},  {133, 69},  {138, 74},  {117, 53}, {137, 100},
                                    {259, 130}, {250, 127}, {187, 131}, {187, 20}};
    double flip = 0, ssim = 0;
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        Image a = uniformImage(280, 151, 90, 100, 110), b = uniformImage(280, 151, 90, 100, 110);
        size_t at = 3 * (size_t)(places[i][1] * 280 + places[i][0]);
        b.samples[at] = 250;
        b.samples[at + 1] = 30;
        Metrics metrics = measure(&a, &b);
        assert_int_equal(metrics.worst.x, places[i][0]);
        assert_int_equal(metrics.worst.y, places[i][1]);
        if (i == 0) {
            flip = metrics.flip;
            ssim = metrics.ssim;
            assert_true(flip > 1e-5 && ssim < 1 - 1e-5);
        }
        assertNear(metrics.flip, flip, flip * 1e-6);
        assertNear(metrics.ssim, ssim, 1e-12);
        freeImage(&a);
        freeImage(&b);
    }
}

static void propertiesOfRandomPairs(void **unused)
{
    (void)unused;
    static const int sizes[][2] = {{1, 1},    {3, 2},    {7, 19},    {11, 11}, {12, 300},
                                   {128, 64}, {129, 65}, {257, 131}, {300, 5}};
    static const int noises[] = {1, 7, 80, 255};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (size_t n = 0; n < sizeof noises / sizeof noises[0]; n++) {
            Image pair[2];
            randomPair(sizes[i][0], sizes[i][1], 8, ENCODING_SRGB, noises[n], 10 * i + n, pair);
            Metrics one = measureWith(&pair[0], &pair[1], 0.004, 1);
            /* Threads change nothing. */
            for (int threads = 2; threads < 8; threads += 5) {
                Metrics several = measureWith(&pair[0], &pair[1], 0.004, threads);
                assertSameMetrics(&one, &several);
            }
            /* The order of the two changes nothing but which is a. */
            Metrics swapped = measureWith(&pair[1], &pair[0], 0.004, 2);
            assertSame(one.worst.a, swapped.worst.b);
            assertSameMetrics(&one, &swapped);
            /* The ranges hold. */
            assert_true(0 <= one.mae && one.mae <= one.rmse && one.rmse <= one.maxDifference);
            assert_true(one.maxDifference <= 1 && one.flip >= 0 && one.flip <= 1);
            assert_true(isnan(one.ssim) || (one.ssim >= -1 && one.ssim <= 1));
            assertNear(one.maxDifference, fabs(one.worst.a - one.worst.b), 1e-15);
            assert_true(one.identicalPixels + one.differingPixels <= one.pixels);
            /* 16-bit samples 257 times as large mean the same. */
            Image wide[2] = {makeImage(pair[0].width, pair[0].height, 16, ENCODING_SRGB),
                             makeImage(pair[0].width, pair[0].height, 16, ENCODING_SRGB)};
            for (int w = 0; w < 2; w++)
                for (size_t s = 0; s < countSamples(&wide[w]); s++)
                    wide[w].samples[s] = (uint16_t)(257 * pair[w].samples[s]);
            Metrics sixteen = measure(&wide[0], &wide[1]);
            assertNear(sixteen.mae, one.mae, 1e-15);
            assertNear(sixteen.rmse, one.rmse, 1e-15);
            assertNear(sixteen.flip, one.flip, 1e-9);
            assert_int_equal(sixteen.differingPixels, one.differingPixels);
            if (!isnan(one.ssim))
                assertNear(sixteen.ssim, one.ssim, 1e-12);
            freePair(pair);
            freePair(wide);
        }
    }
}

/* SSIM and FLIP are of the sRGB encodings: a linear picture and its encoding give the same, up to the
 * rounding to 16 bits. */
static void linearPicturesAreEncoded(void **unused)
{
    (void)unused;
    Image linear[2], encoded[2];
    randomPair(60, 40, 16, ENCODING_LINEAR, 8000, 5, linear);
    for (int i = 0; i < 2; i++) {
        encoded[i] = makeImage(60, 40, 16, ENCODING_SRGB);
        for (size_t s = 0; s < countSamples(&linear[i]); s++) {
            double value = linear[i].samples[s] / 65535.0;
            value = value <= 0.0031308 ? 12.92 * value : 1.055 * pow(value, 1 / 2.4) - 0.055;
            encoded[i].samples[s] = (uint16_t)floor(65535 * value + 0.5);
        }
    }
    Metrics ofLinear = measure(&linear[0], &linear[1]), ofEncoded = measure(&encoded[0], &encoded[1]);
    assertNear(ofLinear.ssim, ofEncoded.ssim, 1e-4);
    assertNear(ofLinear.flip, ofEncoded.flip, 1e-4);
    /* The samples themselves are compared as stored. */
    assert_true(fabs(ofLinear.rmse - ofEncoded.rmse) > 1e-3);
    freePair(linear);
    freePair(encoded);
}

/* The functions of lanes.h keep the accuracy they state. */
static void laneFunctionsAreAccurate(void **unused)
{
    (void)unused;
    for (int i = 0; i < 200000; i++) {
        float x = (float)(pow(10, -6 + 9 * i / 200000.0));
        Lanes cubeRoot = cbrtLanes(splatLanes(x)), logarithm = log2Lanes(splatLanes(x));
        assertNear((double)cubeRoot[3], cbrt((double)x), 3e-7 * cbrt((double)x));
        double expected = log2((double)x);
        assertNear((double)logarithm[0], expected, 1e-7 + 1e-7 * fabs(expected));
        float y = (float)(-126 + 253 * i / 200000.0);
        Lanes power = exp2Lanes(splatLanes(y));
        assertNear((double)power[1], exp2((double)y), 3e-7 * exp2((double)y));
    }
    static const float exponents[] = {0, 0.5f, 0.7f, 1};
    for (int e = 0; e < 4; e++)
        assert_true(powLanes(splatLanes(0), splatLanes(exponents[e]))[2] == 0);
    assert_true(powLanes(splatLanes(1), splatLanes(0.3f))[2] == 1);
    assert_true(powLanes(splatLanes(0.25f), splatLanes(0))[2] == 1);
}

static void assertMismatch(const Image *a, const Image *b, const char *const *parts, size_t count)
{
    Status status = checkComparable(a, "ours.png", b, "theirs.png");
    assert_int_equal(status.code, STATUS_MISMATCH);
    assert_non_null(strstr(status.message, "ours.png"));
    assert_non_null(strstr(status.message, "theirs.png"));
    for (size_t i = 0; i < count; i++)
        assert_non_null(strstr(status.message, parts[i]));
}

static void onlyComparablePicturesAreCompared(void **unused)
{
    (void)unused;
    Image base = makeImage(4, 3, 8, ENCODING_SRGB), same = makeImage(4, 3, 8, ENCODING_SRGB);
    Image turned = makeImage(3, 4, 8, ENCODING_SRGB), deep = makeImage(4, 3, 16, ENCODING_SRGB);
    Image linear = makeImage(4, 3, 8, ENCODING_LINEAR);
    Status status = checkComparable(&base, "a", &same, "b");
    assert_true(statusIsOk(&status));
    same.hadAlpha = true;
    status = checkComparable(&base, "a", &same, "b");
    assert_true(statusIsOk(&status));
    assertMismatch(&base, &turned, (const char *[]){"size", "4x3", "3x4", "--width"}, 4);
    assertMismatch(&base, &deep, (const char *[]){"bit depth", "8 bits", "16 bits", "--bit-depth"}, 4);
    assertMismatch(&linear, &base, (const char *[]){"encoding", "linear", "sRGB", "--encoding"}, 4);
    freeImage(&base);
    freeImage(&same);
    freeImage(&turned);
    freeImage(&deep);
    freeImage(&linear);
}

static Metrics goodMetrics(void)
{
    return (Metrics){.width = 40,
                     .height = 30,
                     .pixels = 1200,
                     .differingPixels = 1,
                     .differingPercent = 100.0 / 1200,
                     .maxDifference = 0.25,
                     .worst = {.x = 7, .y = 9, .channel = 1, .a = 0.5, .b = 0.75},
                     .mae = 0.001,
                     .rmse = 0.002,
                     .psnr = 53.9,
                     .ssim = 0.99,
                     .flip = 0.01};
}

static void assertOneReason(const Metrics *metrics, const Tolerance *tolerance, const char *reason)
{
    Verdict verdict = judgeMetrics(metrics, tolerance);
    assert_false(verdict.pass);
    assert_int_equal(verdict.reasonCount, 1);
    assert_string_equal(verdict.reasons[0], reason);
}

static void verdictsInWords(void **unused)
{
    (void)unused;
    Metrics metrics = goodMetrics();
    Tolerance tolerance = TOLERANCE_DEFAULT;
    Verdict verdict = judgeMetrics(&metrics, &tolerance);
    assert_true(verdict.pass);
    assert_int_equal(verdict.reasonCount, 0);

    metrics.differingPercent = 0.1234567;
    assertOneReason(&metrics, &tolerance, "0.123 % of the pixels differ by more than 0.004 (allowed: 0.1 %)");
    /* Rounding does not make value and limit look equal. */
    metrics.differingPercent = 0.10004;
    assertOneReason(&metrics, &tolerance,
                    "0.10004 % of the pixels differ by more than 0.004 (allowed: 0.1 %)");
    metrics = goodMetrics();
    tolerance.hardFail = 0.2;
    assertOneReason(&metrics, &tolerance, "pixel (7, 9) differs by 0.25 in green (allowed: at most 0.2)");
    tolerance = TOLERANCE_DEFAULT;
    tolerance.rmse = 1e-5;
    assertOneReason(&metrics, &tolerance,
                    "the root mean square error (RMSE) is 0.002 (allowed: at most 1e-05)");
    tolerance = TOLERANCE_DEFAULT;
    tolerance.ssim = 0.995;
    assertOneReason(&metrics, &tolerance, "the similarity (SSIM) is 0.99 (asked for: at least 0.995)");
    metrics.ssim = NAN;
    metrics.width = metrics.height = 8;
    assertOneReason(&metrics, &tolerance,
                    "the similarity (SSIM) cannot be measured on 8x8 pixels, it needs 11x11 "
                    "(asked for: at least 0.995)");
    tolerance = TOLERANCE_DEFAULT;
    tolerance.flip = 0.009999;
    assertOneReason(&metrics, &tolerance,
                    "the visible difference (FLIP) is 0.01 (allowed: at most 0.009999)");
}

static void verdictsAtTheLimits(void **unused)
{
    (void)unused;
    /* A value equal to its limit passes; the next double beyond does not. */
    Metrics metrics = goodMetrics();
    Tolerance tolerance = {
        0.004, metrics.differingPercent, metrics.maxDifference, metrics.rmse, metrics.ssim, metrics.flip};
    assert_true(judgeMetrics(&metrics, &tolerance).pass);
    Tolerance stricter = {0.004,
                          nextafter(metrics.differingPercent, 0),
                          nextafter(metrics.maxDifference, 0),
                          nextafter(metrics.rmse, 0),
                          nextafter(metrics.ssim, 1),
                          nextafter(metrics.flip, 0)};
    Verdict verdict = judgeMetrics(&metrics, &stricter);
    assert_false(verdict.pass);
    assert_int_equal(verdict.reasonCount, 5);
    /* Limits that are not set judge nothing, not even what cannot be measured. */
    metrics.ssim = metrics.psnr = NAN;
    metrics.flip = metrics.rmse = metrics.maxDifference = 1;
    metrics.differingPercent = 100;
    Tolerance none = {0.004, NAN, NAN, NAN, NAN, NAN};
    assert_true(judgeMetrics(&metrics, &none).pass);
}

/* Every reason is whole, in the worst case of long numbers, and has points in a locale with commas. */
static void reasonsAreWhole(void **unused)
{
    (void)unused;
    const char *locale = setlocale(LC_NUMERIC, "fr_FR.UTF-8");
    if (locale == NULL)
        locale = setlocale(LC_NUMERIC, "de_DE.UTF-8");
    if (locale == NULL)
        print_message("# no locale with a decimal comma is installed: only the C locale is tried\n");
    Metrics metrics = goodMetrics();
    metrics.width = metrics.height = 65535;
    metrics.worst.x = metrics.worst.y = 65534;
    metrics.differingPercent = 12.345678901234567;
    metrics.maxDifference = 0.12345678901234567;
    metrics.rmse = metrics.flip = 0.12345678901234567;
    metrics.ssim = -0.12345678901234567;
    Tolerance tolerance = {nextafter(1.2345678901234567e-05, 0), nextafter(metrics.differingPercent, 0),
                           nextafter(metrics.maxDifference, 0),  nextafter(metrics.rmse, 0),
                           nextafter(metrics.ssim, 1),           nextafter(metrics.flip, 0)};
    Verdict verdict = judgeMetrics(&metrics, &tolerance);
    assert_int_equal(verdict.reasonCount, 5);
    for (int i = 0; i < verdict.reasonCount; i++) {
        const char *reason = verdict.reasons[i];
        assert_int_equal(reason[strlen(reason) - 1], ')');
        assert_non_null(strstr(reason, "."));
        assert_null(strstr(reason, ",1"));
        assert_null(strstr(reason, "0,"));
    }
    setlocale(LC_NUMERIC, "C");
}

/* Last, since a cancel is never taken back. */
static void cancelledMeasuringLeavesTheResult(void **unused)
{
    (void)unused;
    Image pair[2];
    randomPair(300, 200, 8, ENCODING_SRGB, 50, 1, pair);
    Metrics metrics = {.width = 77};
    requestCancel();
    Status status = measureImages(&pair[0], &pair[1], 0.004, 2, &metrics);
    assert_int_equal(status.code, STATUS_INTERRUPTED);
    assert_int_equal(metrics.width, 77);
    freePair(pair);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samplesWorkedOutByHand),
        cmocka_unit_test(equalPictures),
        cmocka_unit_test(failIsExactAtEveryStep),
        cmocka_unit_test(largestDifferenceEverywhere),
        cmocka_unit_test(pairsMeasuredByOthers),
        cmocka_unit_test(ssimMeasuredByOthers),
        cmocka_unit_test(ssimOfUniformPictures),
        cmocka_unit_test(flipOfUniformPictures),
        cmocka_unit_test(blemishCountsTheSameEverywhere),
        cmocka_unit_test(propertiesOfRandomPairs),
        cmocka_unit_test(linearPicturesAreEncoded),
        cmocka_unit_test(laneFunctionsAreAccurate),
        cmocka_unit_test(onlyComparablePicturesAreCompared),
        cmocka_unit_test(verdictsInWords),
        cmocka_unit_test(verdictsAtTheLimits),
        cmocka_unit_test(reasonsAreWhole),
        cmocka_unit_test(cancelledMeasuringLeavesTheResult),
    };
    return cmocka_run_group_tests_name("metrics", tests, NULL, NULL);
}
