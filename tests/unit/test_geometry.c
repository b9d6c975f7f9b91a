/* Vectors and colours: the handout's formulas, and the nasty ends of the number range. */
#include "colors.h"
#include "geometry.h"

#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void assertVector(Vector3D v, double x, double y, double z)
{
    assert_true(fabs(v.x - x) < 1e-15);
    assert_true(fabs(v.y - y) < 1e-15);
    assert_true(fabs(v.z - z) < 1e-15);
}

static void reflectsAsInTheHandout(void **state)
{
    (void)state;
    /* R = V - N * 2.0 * dot(V, N) */
    assertVector(reflect(createVector(1, -1, 0), createVector(0, 1, 0)), 1, 1, 0);
    assertVector(reflect(createVector(0, -1, 0), createVector(0, 1, 0)), 0, 1, 0);
    assertVector(reflect(createVector(1, 0, 0), createVector(0, 1, 0)), 1, 0, 0);
    Vector3D n = createVector(0.6, 0, 0.8);
    assertVector(reflect(createVector(1, 2, 3), n), 1 - 2 * 3 * 0.6, 2, 3 - 2 * 3 * 0.8);
    /* Twice is the same direction again. */
    assertVector(reflect(reflect(createVector(1, 2, 3), n), n), 1, 2, 3);
}

static void crossIsRightHanded(void **state)
{
    (void)state;
    assertVector(cross(createVector(1, 0, 0), createVector(0, 1, 0)), 0, 0, 1);
    assertVector(cross(createVector(0, 1, 0), createVector(0, 0, 1)), 1, 0, 0);
}

static void normalizesEveryLength(void **state)
{
    (void)state;
    for (int exponent = -1070; exponent <= 1020; exponent += 10) {
        double size = ldexp(1, exponent);
        Vector3D v = normalize(createVector(3 * size, -4 * size, 0));
        assert_true(fabs(v.x - 0.6) < 1e-15);
        assert_true(fabs(v.y + 0.8) < 1e-15);
    }
    assertVector(normalize(createVector(0, 0, 0)), 0, 0, 0);
    assertVector(normalize(createVector(0, 0, -DBL_MAX)), 0, 0, -1);
    assertVector(normalize(createVector(0, DBL_TRUE_MIN, 0)), 0, 1, 0);
}

static void findsTheLargestCoordinate(void **state)
{
    (void)state;
    const double values[] = {0, -0.0, DBL_TRUE_MIN, -1, 1, 2.5, -3, 1e300, -INFINITY};
    const int count = sizeof values / sizeof *values;
    for (int i = 0; i < count * count * count; i++) {
        double x = values[i % count], y = values[i / count % count], z = values[i / count / count];
        double largest = largestCoordinate(createVector(x, y, z));
        assert_true(largest == fmax(fabs(x), fmax(fabs(y), fabs(z))));
        assert_false(signbit(largest));
    }
    assert_true(isnan(largestCoordinate(createVector(NAN, 1, INFINITY))));
    assert_true(largestCoordinate(createVector(1, NAN, -2)) == 2);
    assert_true(largestCoordinate(createVector(-3, 1, NAN)) == 3);
    assert_true(isnan(largestCoordinate(createVector(NAN, NAN, NAN))));
}

static void clampsColors(void **state)
{
    (void)state;
    ColorRGB c = clampColor(createColor(-1.0f, 0.25f, 7.0f));
    assert_true(c.r == 0.0f && c.g == 0.25f && c.b == 1.0f);
    c = clampColor(createColor(NAN, INFINITY, -INFINITY));
    assert_true(c.r == 0.0f && c.g == 1.0f && c.b == 0.0f);
}

static void putsPixelsInsideOnly(void **state)
{
    (void)state;
    Framebuffer *framebuffer = createFramebuffer(3, 2);
    PutPixel(framebuffer, 2, 1, (ColorRGB){0.5f, 0.25f, 1.0f});
    assert_true(framebuffer->pixels[5].r == 0.5f && framebuffer->pixels[5].b == 1.0f);
    PutPixel(framebuffer, 3, 0, (ColorRGB){1, 1, 1});
    PutPixel(framebuffer, -1, 1, (ColorRGB){1, 1, 1});
    PutPixel(framebuffer, 0, 2, (ColorRGB){1, 1, 1});
    PutPixel(framebuffer, 0, -1, (ColorRGB){1, 1, 1});
    for (int i = 0; i < 5; i++)
        assert_true(colorIsBlack(framebuffer->pixels[i]));
    freeFramebuffer(framebuffer);
    assert_null(createFramebuffer(0, 5));
    assert_null(createFramebuffer(5, -1));
    freeFramebuffer(NULL);
}

static void countsWhatAPictureCannotHold(void **state)
{
    (void)state;
    Framebuffer *framebuffer = createFramebuffer(2, 2);
    assert_int_equal(countNonFinitePixels(framebuffer), 0);
    framebuffer->pixels[0].g = NAN;
    framebuffer->pixels[3] = createColor(INFINITY, 0, NAN);
    assert_int_equal(countNonFinitePixels(framebuffer), 2);
    freeFramebuffer(framebuffer);
}

static void quantizesAsSpecified(void **state)
{
    (void)state;
    /* floor(v (2^bits - 1) + 1/2), clamped */
    assert_int_equal(quantizeSample(0.5f, 8, ENCODING_LINEAR), 128);
    assert_int_equal(quantizeSample(0.5f, 16, ENCODING_LINEAR), 32768);
    assert_int_equal(quantizeSample(0.49f / 255, 8, ENCODING_LINEAR), 0);
    assert_int_equal(quantizeSample(0.51f / 255, 8, ENCODING_LINEAR), 1);
    assert_int_equal(quantizeSample(-3.0f, 16, ENCODING_LINEAR), 0);
    assert_int_equal(quantizeSample(3.0f, 16, ENCODING_SRGB), 65535);
    assert_int_equal(quantizeSample(NAN, 8, ENCODING_SRGB), 0);
    assert_int_equal(quantizeSample(INFINITY, 8, ENCODING_SRGB), 255);
    /* IEC 61966-2-1: 1.055 v^(1/2.4) - 0.055, of 0.2 and 0.5: 0.484529 and 0.735357; the foot is 12.92 v. */
    assert_int_equal(quantizeSample(0.2f, 16, ENCODING_SRGB), 31754);
    assert_int_equal(quantizeSample(0.5f, 16, ENCODING_SRGB), 48192);
    assert_int_equal(quantizeSample(0.001f, 16, ENCODING_SRGB), 847);
    /* Every 8-bit value survives there and back. */
    for (unsigned value = 0; value <= 255; value++)
        assert_int_equal(quantizeSample(srgbToLinear((float)value / 255), 8, ENCODING_SRGB), value);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reflectsAsInTheHandout),
        cmocka_unit_test(crossIsRightHanded),
        cmocka_unit_test(normalizesEveryLength),
        cmocka_unit_test(findsTheLargestCoordinate),
        cmocka_unit_test(clampsColors),
        cmocka_unit_test(putsPixelsInsideOnly),
        cmocka_unit_test(countsWhatAPictureCannotHold),
        cmocka_unit_test(quantizesAsSpecified),
    };
    return cmocka_run_group_tests_name("geometry and colours", tests, NULL, NULL);
}
