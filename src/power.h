/* power.h - base to the power of exponent, by additions, multiplications and one division alone.
 *
 * For what fades with the power of a cosine: highlights and spot lights. The library's pow may run another
 * code, and give another last bit, on a processor with fused multiply-add than on one without; here the same
 * two numbers give the same bits everywhere, provided that the compiler fuses nothing (-ffp-contract=off).
 * There is no branch, no table and no conversion of an integer, so that compilers turn a loop over power()
 * into vector code.
 *
 * base^exponent = 2^(exponent log2 base), with the logarithm in two doubles. Sources: J.-M. Muller et al.,
 * "Handbook of Floating-Point Arithmetic", 2nd edition, 2018, chapter 4 (exact products of split numbers) and
 * chapter 10 (reduction, polynomials); pow in fdlibm (K. Ng, Sun, 1993) for ln m by s = (m - 1) / (m + 1) and
 * the factor 3/2; T. Dekker, "A floating-point technique for extending the available precision", Numerische
 * Mathematik 18, 1971, for numbers in two parts.
 *
 * How exact: a result in the range of normal numbers has a relative error below 2^-51, two units in the last
 * place.
 *   log2 base:  relative error below 2^-61.9: about eleven roundings of low parts, each below 2^-65.4 of the
 *               whole, and 2^-66.2 of the polynomial
 *   2^it:       |exponent log2 base| <= 1024 turns that into 2^10 ln 2 2^-61.9 < 2^-52.4; polynomial 2^-57.8;
 *               roundings of the last steps 2^-52
 * Exact: power(x, 0) = 1, power(1, y) = 1, power(x, 1) = x, power(0, y) = 0 for y > 0.
 */
#ifndef ECLAIRAGE_POWER_H
#define ECLAIRAGE_POWER_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

static inline uint64_t bitsOfDouble(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static inline double doubleOfBits(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The number's first 26 binary digits, the others cut off: a product of two such numbers is exact. */
static inline double leadingHalf(double value)
{
    return doubleOfBits(bitsOfDouble(value) & 0xfffffffff8000000);
}

/* base: at least 0 and finite; below DBL_MIN, where numbers are no longer normal, it counts as 0, and so
 * does what is not a number. exponent: finite, and at least 0 where base counts as 0. A result below DBL_MIN
 * is 0, one above DBL_MAX is INFINITY; which of the two sides holds is uncertain within 2^-42 of these
 * limits. Always inline, because to compilers a call in a loop is the end of vector code. */
__attribute__((always_inline)) static inline double power(double base, double exponent)
{
    /* Write base as m 2^k with m in [sqrt 1/2, sqrt 2): adding moves the border between two k to a power of
     * 2, and k + 1023 becomes a double as the last digits of 2^52 + k + 1023. */
    const uint64_t sqrtHalf = 0x3fe6a09e667f3bcd, one = 0x3ff0000000000000;
    uint64_t moved = bitsOfDouble(base) + (one - sqrtHalf);
    double m = doubleOfBits((moved & 0x000fffffffffffff) + sqrtHalf);
    double k = doubleOfBits(moved >> 52 | 0x4330000000000000) - (0x1p52 + 1023);

    /* Divide s = (m - 1) / (m + 1), |s| < 0.1716, with m + 1 = sum + sumRest and s = sHigh + sLow. */
    double sum = leadingHalf(m + 1), sumRest = m - (sum - 1);
    double inverse = 1 / (m + 1);
    double s = (m - 1) * inverse, sHigh = leadingHalf(s);
    double sLow = ((m - 1 - sHigh * sum) - sHigh * sumRest) * inverse;

    /* Sum up 3/2 ln(m) / s = 3 + s^2 + (3/5 s^4 + 3/7 s^6 + ...): the first two terms in full, the bracket in
     * a minimax polynomial. From here on a high part never waits for the polynomial, which goes into the low
     * parts: they are below 2^-12.4 of the sum, so that each of their roundings is below 2^-65.4 of it. */
    double s2 = s * s, s4 = s2 * s2;
    double square = sHigh * sHigh, squareRest = sLow * (sHigh + s);
    double even = (0x1.3333333333464p-1 + s2 * 0x1.b6db6db683c90p-2) +
                  s4 * (0x1.555555a20683dp-2 + s2 * 0x1.1745af6cc6039p-2);
    double odd = (0x1.d8ae61390c19ap-3 + s2 * 0x1.973ff28b4cf7ep-3) + s4 * 0x1.9563437c3b907p-3;
    double bracket = s4 * (even + (s4 * s4) * odd);
    double logOverS = leadingHalf(3 + square);
    double logOverSRest = ((square - (logOverS - 3)) + squareRest) + bracket;

    /* Multiply by s, and by 2 / (3 ln 2); add k: log2 base = logHigh + logLow. */
    double product = sHigh * logOverS, productRest = sLow * logOverS + s * logOverSRest;
    double lnHigh = leadingHalf(product);
    double lnLow = (product - lnHigh) + productRest;
    double scaled = 0x1.ec709d8p-1 * lnHigh;
    double scaledRest = 0x1.0e80ff5d27f05p-27 * lnHigh + 0x1.ec709dc3a03fdp-1 * lnLow;
    double logHigh = leadingHalf(k + scaled);
    double logLow = (scaled - (logHigh - k)) + scaledRest;

    /* Multiply by the exponent and take the nearest integer, which rounding to a unit of 1 leaves at the end
     * of `shifted`. */
    double exponentHigh = leadingHalf(exponent);
    double z = exponentHigh * logHigh;
    double zRest = (exponent - exponentHigh) * logHigh + exponent * logLow;
    double whole = z + zRest, shifted = whole + 0x1.8p52;
    double f = (z - (shifted - 0x1.8p52)) + zRest;

    /* 2^f for |f| <= 1/2, again a minimax polynomial, and the integer onto its exponent. */
    double f2 = f * f, f4 = f2 * f2;
    double low = (0x1.62e42fefa39efp-1 + f * 0x1.ebfbdff82c5a1p-3) +
                 f2 * (0x1.c6b08d704a008p-5 + f * 0x1.3b2ab6fba07a5p-7);
    double middle = (0x1.5d87fe78ca208p-10 + f * 0x1.4309130dbc846p-13) +
                    f2 * (0x1.ffcbfbb20e6d8p-17 + f * 0x1.62bfca104b3a5p-20);
    double high = (0x1.b5267479d6f82p-24 + f * 0x1.e61784ca68e7ep-28) + f2 * 0x1.e79ee6da9b30ep-32;
    double fraction = 1 + f * (low + f4 * (middle + f4 * high));
    double result = doubleOfBits(bitsOfDouble(fraction) + (bitsOfDouble(shifted) << 52));

    /* Put in what the formulas do not reach. */
    result = whole >= -1022 ? result : 0;
    result = whole < 1024 ? result : INFINITY;
    result = exponent == 1 ? base : result;
    return base >= DBL_MIN ? result : (exponent > 0 ? 0 : 1);
}

#endif
