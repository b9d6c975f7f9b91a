/* The difference picture: its colours mean what its scale says, the colour map keeps order and distance,
 * and the scale is readable at every size. */
#include "compare/difference.h"

#include "base/cancel.h"
#include "base/text.h"
#include "compare/colormap.h"
#include "compare/lettering.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const uint16_t INK[3] = {24, 24, 24};

static Image makeImage(int width, int height, int bitDepth)
{
    Image image;
    Status status = createImage(width, height, bitDepth, ENCODING_SRGB, &image);
    assert_true(statusIsOk(&status));
    return image;
}

static Image makeDifference(const Image *a, const Image *b)
{
    Image difference;
    Status status = differencePicture(a, b, &difference);
    assert_true(statusIsOk(&status));
    assert_int_equal(difference.bitDepth, 8);
    assert_int_equal(difference.encoding, ENCODING_SRGB);
    assert_true(difference.width >= a->width && difference.height > a->height);
    return difference;
}

static const uint16_t *pixelAt(const Image *image, int x, int y)
{
    return image->samples + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static void assertColor(const uint16_t *color, const uint16_t *expected)
{
    assert_memory_equal(color, expected, 3 * sizeof *color);
}

/* Whether the text stands somewhere below row top: its ink, and nothing but its ink, in its rectangle. */
static bool showsText(const Image *image, int top, int scale, const char *text)
{
    Image wanted = makeImage(measureText(text, scale), LETTER_HEIGHT * scale, 8);
    drawText(&wanted, 0, 0, scale, INK, text);
    bool found = false;
    for (int y = top; !found && y + wanted.height <= image->height; y++) {
        for (int x = 0; !found && x + wanted.width - scale <= image->width; x++) {
            found = true;
            for (int j = 0; found && j < wanted.height; j++)
                for (int i = 0; found && i < wanted.width - scale; i++)
                    found =
                        (pixelAt(&wanted, i, j)[0] == INK[0]) == (pixelAt(image, x + i, y + j)[0] == INK[0]);
        }
    }
    freeImage(&wanted);
    return found;
}

/* OKLab of an 8-bit sRGB colour (Ottosson 2020), by the inverse of colormap.c's direction. */
static void oklabFromSrgb(const uint16_t rgb[3], double lab[3])
{
    double c[3];
    for (int i = 0; i < 3; i++) {
        double v = rgb[i] / 255.0;
        c[i] = v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
    }
    double l = cbrt(0.4122214708 * c[0] + 0.5363325363 * c[1] + 0.0514459929 * c[2]);
    double m = cbrt(0.2119034982 * c[0] + 0.6806995451 * c[1] + 0.1073969566 * c[2]);
    double s = cbrt(0.0883024619 * c[0] + 0.2817188376 * c[1] + 0.6299787005 * c[2]);
    lab[0] = 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
    lab[1] = 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s;
    lab[2] = 0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s;
}

static double oklabDistance(const uint16_t a[3], const uint16_t b[3])
{
    double p[3], q[3];
    oklabFromSrgb(a, p);
    oklabFromSrgb(b, q);
    return sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) +
                (p[2] - q[2]) * (p[2] - q[2]));
}

static void colorMapKeepsOrderAndDistance(void **unused)
{
    (void)unused;
    ColorMap map;
    makeColorMap(&map);
    double lab[3], before = -1, shortest = 1, longest = 0;
    for (int i = 0; i < COLOR_MAP_SIZE; i += 33) {
        /* Lightness rises in every step. */
        oklabFromSrgb(map.colors[i], lab);
        assert_true(lab[0] > before + 0.005);
        before = lab[0];
        /* Equal steps are equally far; rounding to 8 bits moves each end by up to 0.004, more near black,
         * where a step of 8 bits is a long one. */
        if (i >= 165) {
            double step = oklabDistance(map.colors[i], map.colors[i - 33]);
            shortest = step < shortest ? step : shortest;
            longest = step > longest ? step : longest;
        }
    }
    assert_true(before > 0.95);
    assert_true(shortest > 0.03 && longest < 1.15 * shortest);
}

static void smallestDifferenceIsSeenBesideEquality(void **unused)
{
    (void)unused;
    ColorMap map;
    makeColorMap(&map);
    assertColor(colorOfDifference(&map, 0), map.colors[0]);
    assertColor(colorOfDifference(&map, -1), map.colors[0]);
    assertColor(colorOfDifference(&map, NAN), map.colors[0]);
    assertColor(colorOfDifference(&map, 1), map.colors[COLOR_MAP_SIZE - 1]);
    assertColor(colorOfDifference(&map, 2), map.colors[COLOR_MAP_SIZE - 1]);
    assert_true(oklabDistance(colorOfDifference(&map, 1e-9), map.colors[0]) > 0.1);
}

static void colorsMeanWhatTheScaleSays(void **unused)
{
    (void)unused;
    /* Column x differs by x steps in one channel and by less in another. */
    Image a = makeImage(400, 30, 16), b = makeImage(400, 30, 16);
    for (int y = 0; y < 30; y++) {
        for (int x = 0; x < 400; x++) {
            size_t at = 3 * (size_t)(y * 400 + x);
            a.samples[at + (size_t)(x % 3)] = (uint16_t)(y % 2 ? 5000 + x : 5000);
            b.samples[at + (size_t)(x % 3)] = (uint16_t)(y % 2 ? 5000 : 5000 + x);
            b.samples[at + (size_t)((x + 1) % 3)] = (uint16_t)(x / 2);
        }
    }
    ColorMap map;
    makeColorMap(&map);
    Image difference = makeDifference(&a, &b);
    assert_int_equal(difference.width, 400);
    for (int y = 0; y < 30; y++)
        for (int x = 0; x < 400; x++)
            assertColor(pixelAt(&difference, x, y), colorOfDifference(&map, x / 399.0));
    /* The bar runs from the first difference's colour to the last: look at every row for one that does. */
    int bars = 0;
    for (int y = 30; y < difference.height; y++) {
        bool isBar = true;
        for (int x = 6; x < 394 && isBar; x++)
            isBar = memcmp(pixelAt(&difference, x, y), colorOfDifference(&map, (x - 6 + 0.5) / 388),
                           3 * sizeof(uint16_t)) == 0;
        bars += isBar;
    }
    assert_true(bars >= 10);
    assert_true(showsText(&difference, 30, 1, "0.002"));
    assert_true(showsText(&difference, 30, 1, "0.006"));
    assert_true(showsText(&difference, 30, 1, "largest 399/65535 = 0.006088 at 399,0"));
    assert_true(showsText(&difference, 30, 1, "equal"));
    assert_false(showsText(&difference, 30, 1, "no pixel differs"));
    freeImage(&a);
    freeImage(&b);
    freeImage(&difference);
}

static void fewStepsAreLabelledAsSteps(void **unused)
{
    (void)unused;
    Image a = makeImage(1, 1, 16), b = makeImage(1, 1, 16);
    a.samples[1] = 3;
    Image difference = makeDifference(&a, &b);
    ColorMap map;
    makeColorMap(&map);
    assertColor(pixelAt(&difference, 0, 0), map.colors[COLOR_MAP_SIZE - 1]);
    assert_true(showsText(&difference, 1, 1, "1/65535"));
    assert_true(showsText(&difference, 1, 1, "2/65535"));
    assert_true(showsText(&difference, 1, 1, "3/65535"));
    assert_true(showsText(&difference, 1, 1, "largest 3/65535 = 4.578e-05 at 0,0"));
    freeImage(&a);
    freeImage(&b);
    freeImage(&difference);
}

static void equalPicturesSaySo(void **unused)
{
    (void)unused;
    Image a = makeImage(340, 7, 8);
    Image difference = makeDifference(&a, &a);
    ColorMap map;
    makeColorMap(&map);
    for (int y = 0; y < 7; y++)
        for (int x = 0; x < 340; x++)
            assertColor(pixelAt(&difference, x, y), map.colors[0]);
    assert_true(showsText(&difference, 7, 1, "no pixel differs"));
    assert_false(showsText(&difference, 7, 1, "largest 0"));
    freeImage(&a);
    freeImage(&difference);
}

/* At all sizes the legend is whole and the picture stays at its place. */
static void everySizeHasItsLegend(void **unused)
{
    (void)unused;
    static const int sizes[][3] = {/* width, height, scale of the text */
                                   {1, 1, 1},   {2, 500, 1}, {319, 3, 1},  {320, 3, 1},
                                   {959, 2, 1}, {960, 2, 2}, {2000, 1, 4}, {5000, 2, 6}};
    ColorMap map;
    makeColorMap(&map);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        int width = sizes[i][0], height = sizes[i][1], scale = sizes[i][2];
        Image a = makeImage(width, height, 8), b = makeImage(width, height, 8);
        b.samples[3 * (size_t)(width - 1) + 2] = 255;
        Image difference = makeDifference(&a, &b);
        assert_int_equal(difference.width, width < 320 ? 320 : width);
        assertColor(pixelAt(&difference, width - 1, 0), map.colors[COLOR_MAP_SIZE - 1]);
        if (width > 1)
            assertColor(pixelAt(&difference, width - 2, 0), map.colors[0]);
        if (width < 320)
            assert_true(pixelAt(&difference, width, 0)[0] > 200);
        assert_true(showsText(&difference, height, scale, "difference of each pixel (largest of r, g, b)"));
        assert_true(showsText(&difference, height, scale, "0.4"));
        assert_true(showsText(&difference, height, scale, "largest 255/255 = 1 at"));
        freeImage(&a);
        freeImage(&b);
        freeImage(&difference);
    }
}

static void everyCharacterIsDrawn(void **unused)
{
    (void)unused;
    const char *used = "0123456789.e-/=,():abcdfghilnopqrstux";
    for (const char *c = used; *c != '\0'; c++) {
        Image image = makeImage(6, 9, 8);
        drawText(&image, 0, 0, 1, INK, (char[]){*c, '\0'});
        int ink = 0;
        for (int i = 0; i < 6 * 9; i++)
            ink += image.samples[3 * i] == INK[0];
        assert_true(ink >= 4);
        /* The gap to the next letter stays free. */
        for (int y = 0; y < 9; y++)
            assert_int_equal(pixelAt(&image, 5, y)[0], 0);
        freeImage(&image);
    }
    /* Text beyond the border is cut. */
    Image image = makeImage(3, 3, 8);
    drawText(&image, -4, -4, 2, INK, "888");
    drawText(&image, 100, 100, 2, INK, "888");
    fillRectangle(&image, -5, -5, 100, 100, INK);
    assertColor(pixelAt(&image, 2, 2), INK);
    freeImage(&image);
}

static void differentSizesAreRefused(void **unused)
{
    (void)unused;
    Image a = makeImage(3, 4, 8), b = makeImage(4, 3, 8), difference = {.width = 77};
    Status status = differencePicture(&a, &b, &difference);
    assert_int_equal(status.code, STATUS_MISMATCH);
    assert_int_equal(difference.width, 77);
    freeImage(&a);
    freeImage(&b);
}

/* Last, since a cancel is never taken back. */
static void cancelledPictureIsNotMade(void **unused)
{
    (void)unused;
    Image a = makeImage(3, 4, 8), difference = {.width = 77};
    requestCancel();
    Status status = differencePicture(&a, &a, &difference);
    assert_int_equal(status.code, STATUS_INTERRUPTED);
    assert_int_equal(difference.width, 77);
    freeImage(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colorMapKeepsOrderAndDistance),
        cmocka_unit_test(smallestDifferenceIsSeenBesideEquality),
        cmocka_unit_test(colorsMeanWhatTheScaleSays),
        cmocka_unit_test(fewStepsAreLabelledAsSteps),
        cmocka_unit_test(equalPicturesSaySo),
        cmocka_unit_test(everySizeHasItsLegend),
        cmocka_unit_test(everyCharacterIsDrawn),
        cmocka_unit_test(differentSizesAreRefused),
        cmocka_unit_test(cancelledPictureIsNotMade),
    };
    return cmocka_run_group_tests_name("difference", tests, NULL, NULL);
}
