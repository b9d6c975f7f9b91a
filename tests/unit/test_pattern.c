/* The colours of patterns where they change: a surface in that very plane has one colour, whatever its points
 * were rounded to. */
#include "patterns/pattern.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const Color3f TEXELS[4] = {{0.1f, 0, 0}, {0.2f, 0, 0}, {0.3f, 0, 0}, {0.4f, 0, 0}};

static Pattern createPattern(PatternKind kind, Vector3D axis, double size)
{
    return (Pattern){.kind = kind,
                     .colors = {{1, 0, 0}, {0, 0, 1}},
                     .axis = axis,
                     .size = size,
                     .width = 2,
                     .height = 2,
                     .texels = TEXELS};
}

static float redAt(const Pattern *pattern, double x, double y, double z)
{
    return patternColor(pattern, createVector(x, y, z)).r;
}

/* Checker, stripes and texels on both sides of their edges, negative coordinates too. */
static void testColors(void **state)
{
    (void)state;
    Pattern checker = createPattern(PATTERN_CHECKER, createVector(1, 0, 0), 2);
    assert_true(redAt(&checker, 0.1, 0.1, 0.1) == 1);
    assert_true(redAt(&checker, 2.1, 0.1, 0.1) == 0);
    assert_true(redAt(&checker, -0.1, 0.1, 0.1) == 0);
    assert_true(redAt(&checker, -0.1, -0.1, -4.1) == 0);
    assert_true(redAt(&checker, 1.999999, 0.1, 0.1) == 1);
    Pattern stripes = createPattern(PATTERN_STRIPES, createVector(1, 0, 0), 2);
    assert_true(redAt(&stripes, 0.999999, 0, 0) == 1);
    assert_true(redAt(&stripes, 1.000001, 0, 0) == 0);
    assert_true(redAt(&stripes, -0.000001, 0, 0) == 0);
    assert_true(redAt(&stripes, -1.000001, 0, 0) == 1);
    Pattern gradient = createPattern(PATTERN_GRADIENT, createVector(0, 1, 0), 2);
    assert_true(redAt(&gradient, 0, 0.5, 0) == 0.75f);
    assert_true(redAt(&gradient, 0, -0.5, 0) == 0.25f);
    /* Row 0 of the texels is at the top. */
    Pattern image = createPattern(PATTERN_IMAGE, createVector(1, 0, 0), 1);
    assert_true(redAt(&image, 0.1, 0.9, 0) == 0.1f);
    assert_true(redAt(&image, 0.9, 0.9, 0) == 0.2f);
    assert_true(redAt(&image, -0.9, -0.9, 0) == 0.3f);
    assert_true(redAt(&image, 1.9, 0.1, 5) == 0.4f);
}

/* Just below and just above a number where the colour changes, by what rounding makes of it. */
static void assertSameAround(const Pattern *pattern, double edge, double x, double y, double z)
{
    double step = 4e-16 * (1 + fabs(edge));
    Vector3D axis = createVector(x == 0, y == 0, z == 0);
    float at = redAt(pattern, x + edge * axis.x, y + edge * axis.y, z + edge * axis.z);
    for (int i = -40; i <= 40; i++) {
        double moved = edge + i * step;
        float color = redAt(pattern, x + moved * axis.x, y + moved * axis.y, z + moved * axis.z);
        assert_true(fabsf(color - at) < 1e-6f);
    }
}

static void testSurfacesInThePlanesOfChange(void **state)
{
    (void)state;
    static const double SIZES[] = {1, 0.1, 0.3, 2, 7};
    for (size_t s = 0; s < sizeof SIZES / sizeof *SIZES; s++) {
        for (int cell = -20; cell <= 20; cell++) {
            double edge = cell * SIZES[s];
            Pattern checker = createPattern(PATTERN_CHECKER, createVector(1, 0, 0), SIZES[s]);
            assertSameAround(&checker, edge, 0, 0.03, 0.04);
            assertSameAround(&checker, edge, 0.03, 0, 0.04);
            assertSameAround(&checker, edge, 0.03, 0.04, 0);
            Pattern stripes = createPattern(PATTERN_STRIPES, createVector(0, 1, 0), SIZES[s]);
            assertSameAround(&stripes, edge, 0.03, 0, 0.04);
            assertSameAround(&stripes, edge + SIZES[s] / 2, 0.03, 0, 0.04);
            Pattern gradient = createPattern(PATTERN_GRADIENT, createVector(0, 0, 1), SIZES[s]);
            assertSameAround(&gradient, edge, 0.03, 0.04, 0);
            Pattern image = createPattern(PATTERN_IMAGE, createVector(1, 0, 0), SIZES[s]);
            assertSameAround(&image, edge, 0, 0.03, 0.04);
            assertSameAround(&image, edge + SIZES[s] / 2, 0.03, 0, 0.04);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(testColors),
        cmocka_unit_test(testSurfacesInThePlanesOfChange),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
