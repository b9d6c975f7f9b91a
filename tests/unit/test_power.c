/* power() against the library's powl, which has eleven more digits; its exact values and its ends of the
 * range; and that every compiler makes the same bits of it, one number at a time and in vector code. */
#include "power.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* xorshift64 (G. Marsaglia, "Xorshift RNGs", Journal of Statistical Software 8(14), 2003). */
static uint64_t nextBits(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

/* In [0, 1). */
static double nextUniform(uint64_t *state)
{
    return (double)(nextBits(state) >> 11) * 0x1p-53;
}

/* In [1, 2) times 2^low .. 2^high, or its negative: as likely near 2^low as near 2^high. */
static double nextMagnitude(uint64_t *state, int low, int high)
{
    double digits = 1 + nextUniform(state);
    return ldexp(digits, low + (int)(nextBits(state) % (unsigned)(high - low + 1)));
}

/* Kinds of bases and of exponents that go wrong in their own ways. Made without the library's functions
 * that round, so that they are the same numbers everywhere. */
enum {
    BASE_KINDS = 7,
    EXPONENT_KINDS = 4
};

static double nextBase(uint64_t *state, int kind)
{
    const double sqrtHalf = 0.70710678118654752;
    double uniform = nextUniform(state), aside = (uniform - 0.5) * nextMagnitude(state, -52, -3);
    switch (kind) {
    case 0:
        return uniform;
    case 1: /* just below 1 */
        return 1 - nextMagnitude(state, -53, -2);
    case 2: /* just above 1: rounded cosines, and more */
        return 1 + nextMagnitude(state, -52, -2);
    case 3: /* on both sides of a power of 2 */
        return ldexp(1 + aside, -(int)(nextBits(state) % 40));
    case 4: /* on both sides of where the reduction changes its power of 2 */
        return ldexp(sqrtHalf + aside, -(int)(nextBits(state) % 3));
    case 5: /* tiny */
        return nextMagnitude(state, -1022, -20);
    default: /* large */
        return nextMagnitude(state, 0, 1023);
    }
}

static double nextExponent(uint64_t *state, int kind)
{
    switch (kind) {
    case 0: /* shininess: a float */
        return (double)(float)(1000 * nextUniform(state));
    case 1: /* a whole number */
        return (double)(nextBits(state) % 300);
    case 2:
        return nextMagnitude(state, -60, 0);
    default:
        return nextMagnitude(state, 0, 62);
    }
}

/* Of what the result is off, as a part of the exact value, for results that are normal numbers. */
static double relativeError(double base, double exponent)
{
    long double exact = powl((long double)base, (long double)exponent);
    if (exact < (long double)DBL_MIN || exact > (long double)DBL_MAX)
        return 0;
    return (double)fabsl(((long double)power(base, exponent) - exact) / exact);
}

static void isWithinItsBound(void **state)
{
    (void)state;
    uint64_t random = 1;
    int normal = 0;
    for (int i = 0; i < 1000000; i++) {
        double base = nextBase(&random, i % BASE_KINDS);
        double exponent = nextExponent(&random, i / BASE_KINDS % EXPONENT_KINDS);
        double error = relativeError(base, exponent);
        normal += error > 0;
        if (!(error < 0x1p-51))
            fail_msg("power(%a, %a) is off by %g of 2^-51", base, exponent, error / 0x1p-51);
    }
    assert_true(normal > 400000);
}

/* Where the exponent enlarges an error of the logarithm most: results next to the ends of the range. */
static void isWithinItsBoundAtTheEndsOfTheRange(void **state)
{
    (void)state;
    uint64_t random = 2;
    for (int i = 0; i < 500000; i++) {
        double base = nextBase(&random, i % BASE_KINDS);
        if (base == 1)
            continue;
        double exponent = (1000 + 21.99 * nextUniform(&random)) / fabs(log2(base));
        double error = relativeError(base, exponent);
        if (!(error < 0x1p-51))
            fail_msg("power(%a, %a) is off by %g of 2^-51", base, exponent, error / 0x1p-51);
    }
}

/* A colour is a float, and the exact value lies so close to where two floats meet in one case of 2^25. */
static void roundsToTheSameFloat(void **state)
{
    (void)state;
    uint64_t random = 3;
    int differ = 0;
    for (int i = 0; i < 1 << 20; i++) {
        double base = nextUniform(&random), exponent = (double)(float)(128 * nextUniform(&random));
        differ += (float)power(base, exponent) != (float)powl((long double)base, (long double)exponent);
    }
    assert_in_range(differ, 0, 1);
}

static void isExactWhereItIsPromised(void **state)
{
    (void)state;
    uint64_t random = 4;
    for (int i = 0; i < 200000; i++) {
        double base = nextBase(&random, i % BASE_KINDS);
        double exponent = nextExponent(&random, i / BASE_KINDS % EXPONENT_KINDS);
        assert_true(base > 0);
        assert_true(power(base, 1) == base);
        assert_true(power(base, 0) == 1);
        assert_true(power(1, exponent) == 1);
        assert_true(power(0, exponent) == (exponent > 0 ? 0 : 1));
    }
    assert_true(power(1, DBL_MAX) == 1);
    assert_true(power(0, 0) == 1);
    assert_true(power(-0.0, 0.5) == 0);
    assert_true(power(0, DBL_TRUE_MIN) == 0);
    assert_true(power(DBL_MAX, 1) == DBL_MAX);
    for (int n = 0; n <= 1022; n++)
        assert_true(power(0.5, n) == ldexp(1, -n));
}

static void endsInZeroAndInfinity(void **state)
{
    (void)state;
    assert_true(power(0.5, 1022) == DBL_MIN);
    assert_true(power(0.5, 1022.001) == 0);
    assert_true(power(0.5, 1e30) == 0);
    assert_true(power(0.5, DBL_MAX) == 0);
    assert_true(power(1 - 0x1p-53, 1e30) == 0);
    assert_true(power(1 - 0x1p-53, DBL_MAX) == 0);
    assert_true(power(DBL_MIN, DBL_MAX) == 0);
    assert_true(power(DBL_TRUE_MIN, 0.5) == 0);
    assert_true(power(NAN, 2) == 0);
    assert_true(power(2, 1023) == 0x1p1023);
    assert_true(power(2, 1024) == INFINITY);
    assert_true(power(1 + 0x1p-52, DBL_MAX) == INFINITY);
    assert_true(power(DBL_MAX, DBL_MAX) == INFINITY);
    assert_true(power(0.5, -1) == 2);
    assert_true(power(0.5, -1e30) == INFINITY);
    /* Between: never a number that is not one, nor one above 1. */
    uint64_t random = 5;
    for (int i = 0; i < 200000; i++) {
        double base = nextBase(&random, i % 2);
        double result = power(base, nextMagnitude(&random, -100, 1023));
        assert_true(result >= 0 && result <= 1);
    }
}

/* A larger cosine makes a brighter highlight, but for the two last digits. */
static void growsWithTheBase(void **state)
{
    (void)state;
    const double exponents[] = {0.25, 1.5, 2, 32, 77.7, 1000, 1e6};
    for (size_t e = 0; e < sizeof exponents / sizeof *exponents; e++) {
        double before = 0;
        for (int i = 0; i <= 100000; i++) {
            double now = power(i / 100000.0, exponents[e]);
            assert_true(now >= before * (1 - 0x1p-50));
            before = now;
        }
        assert_true(before == 1);
    }
}

enum {
    LANES = 64
};

/* The loop that becomes vector code: by clang always, by gcc from -O3 on. */
#if defined(__GNUC__) && !defined(__clang__)
__attribute__((optimize("O3")))
#endif
static void
powersOfLanes(double *restrict results, const double *restrict bases, const double *restrict exponents)
{
    for (int k = 0; k < LANES; k++)
        results[k] = power(bases[k], exponents[k]);
}

/* 64-bit FNV-1a over the bits of all results: another compiler, level or processor must end in the same. */
static void givesTheSameBitsEverywhere(void **state)
{
    (void)state;
    uint64_t random = 6, hash = 0xcbf29ce484222325;
    for (int round = 0; round < 5000; round++) {
        double bases[LANES], exponents[LANES], results[LANES];
        for (int k = 0; k < LANES; k++) {
            bases[k] = nextBase(&random, k % BASE_KINDS);
            exponents[k] = nextExponent(&random, k / BASE_KINDS % EXPONENT_KINDS);
        }
        powersOfLanes(results, bases, exponents);
        for (int k = 0; k < LANES; k++) {
            /* Through volatile, so that this one is computed by itself. */
            volatile double base = bases[k], exponent = exponents[k];
            double alone = power(base, exponent);
            assert_memory_equal(&alone, &results[k], sizeof alone);
            for (int byte = 0; byte < 8; byte++)
                hash = (hash ^ (bitsOfDouble(alone) >> (8 * byte) & 0xff)) * 0x100000001b3;
        }
    }
    if (hash != 0xfd6812b1857dd989)
        fail_msg("the results have the sum 0x%016llx", (unsigned long long)hash);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(isWithinItsBound),           cmocka_unit_test(isWithinItsBoundAtTheEndsOfTheRange),
        cmocka_unit_test(roundsToTheSameFloat),       cmocka_unit_test(isExactWhereItIsPromised),
        cmocka_unit_test(endsInZeroAndInfinity),      cmocka_unit_test(growsWithTheBase),
        cmocka_unit_test(givesTheSameBitsEverywhere),
    };
    return cmocka_run_group_tests_name("power", tests, NULL, NULL);
}
