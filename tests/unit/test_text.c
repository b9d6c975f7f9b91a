/* Numbers as text: rounded to some digits, short or with all decimals, with a point in every locale. */
#include "base/text.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void numbersAreRoundedToDigits(void **state)
{
    (void)state;
    static const struct {
        double value;
        int digits;
        const char *text;
    } cases[] = {{0, 3, "0"},
                 {-0.0, 3, "0"},
                 {1, 3, "1"},
                 {2, 3, "2"},
                 {0.123456, 3, "0.123"},
                 {-0.123456, 3, "-0.123"},
                 {0.031249, 3, "0.0312"},
                 {-1.9999, 3, "-2"},
                 {0.99996, 4, "1"},
                 {99.96, 3, "100"},
                 {0.1, 4, "0.1"},
                 {1 / 3.0, 4, "0.3333"},
                 {2 / 3.0, 1, "0.7"},
                 {123456, 2, "120000"},
                 {3 / 65535.0, 4, "4.578e-05"},
                 {4.17e-7, 2, "4.2e-07"},
                 {0.1 + 0.2, 15, "0.3"},
                 {1e-300, 3, "1e-300"},
                 {5e-324, 3, "4.94065645841247e-324"},
                 {NAN, 3, "nan"},
                 {INFINITY, 3, "inf"},
                 {-INFINITY, 3, "-inf"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Text text = {0};
        textAppendRounded(&text, cases[i].value, cases[i].digits);
        assert_string_equal(textString(&text), cases[i].text);
        textFree(&text);
    }
}

static void numbersAreRoundedToDecimals(void **state)
{
    (void)state;
    static const struct {
        double value;
        int decimals;
        const char *text;
    } cases[] = {{0, 5, "0.00000"},
                 {0.194215, 4, "0.1942"},
                 {0.99999, 4, "1.0000"},
                 {12.34, 1, "12.3"},
                 {7, 0, "7"},
                 {0.000004, 5, "0.00000"},
                 {-12.34, 1, "-12.3"},
                 {-0.25, 2, "-0.25"},
                 {-0.04, 1, "0.0"},
                 {-0.0, 1, "0.0"},
                 {999999999, 9, "999999999.000000000"},
                 {NAN, 2, "nan"},
                 {-INFINITY, 2, "-inf"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Text text = {0};
        textAppendFixed(&text, cases[i].value, cases[i].decimals);
        assert_string_equal(textString(&text), cases[i].text);
        textFree(&text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbersAreRoundedToDigits),
        cmocka_unit_test(numbersAreRoundedToDecimals),
    };
    return cmocka_run_group_tests_name("text", tests, NULL, NULL);
}
