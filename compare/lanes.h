/* lanes.h - four floats side by side, and the functions that FLIP needs of them.
 *
 * Invariant: only additions, multiplications, divisions, square roots and comparisons of IEEE 754, each
 * rounded once, and no library function: every machine and instruction set gives the same bits.
 * GCC vector extensions of 16 bytes, which every x86-64 and aarch64 has: no choice at run time is needed.
 */
#ifndef ECLAIRAGE_COMPARE_LANES_H
#define ECLAIRAGE_COMPARE_LANES_H

#include <stdint.h>
#include <string.h>

enum {
    LANES = 4
};

typedef float Lanes __attribute__((vector_size(LANES * sizeof(float))));
typedef int32_t IntLanes __attribute__((vector_size(LANES * sizeof(int32_t))));

#define LANES_INLINE static inline __attribute__((always_inline))

/* Four floats from or to memory of any alignment. */
LANES_INLINE Lanes loadLanes(const float *from)
{
    Lanes value;
    memcpy(&value, from, sizeof value);
    return value;
}

LANES_INLINE void storeLanes(float *to, Lanes value)
{
    memcpy(to, &value, sizeof value);
}

LANES_INLINE Lanes splatLanes(float value)
{
    return value - (Lanes){0};
}

/* Where the condition holds (all bits set) yes, else no. */
LANES_INLINE Lanes selectLanes(IntLanes condition, Lanes yes, Lanes no)
{
    return (Lanes)((condition & (IntLanes)yes) | (~condition & (IntLanes)no));
}

LANES_INLINE Lanes maxLanes(Lanes a, Lanes b)
{
    return selectLanes(a > b, a, b);
}

LANES_INLINE Lanes minLanes(Lanes a, Lanes b)
{
    return selectLanes(a < b, a, b);
}

LANES_INLINE Lanes absLanes(Lanes a)
{
    return (Lanes)((IntLanes)a & 0x7fffffff);
}

LANES_INLINE Lanes sqrtLanes(Lanes a)
{
    for (int i = 0; i < LANES; i++)
        a[i] = __builtin_sqrtf(a[i]);
    return a;
}

/* The cube root of a normal positive number, within 3e-7 of its size. */
LANES_INLINE Lanes cbrtLanes(Lanes a)
{
    /* Guess by a third of the exponent: the bits of a float are nearly its logarithm. */
    Lanes bits = __builtin_convertvector((IntLanes)a, Lanes);
    Lanes root = (Lanes)(__builtin_convertvector(bits * (1.0f / 3.0f), IntLanes) + 0x2a5137a0);
    /* Improve by Halley's iteration, r (r^3 + 2a) / (2r^3 + a), which cubes the error: 4 %, 4e-5, 0. */
    for (int i = 0; i < 2; i++) {
        Lanes cube = root * root * root;
        root = root * (cube + 2.0f * a) / (2.0f * cube + a);
    }
    return root;
}

/* The binary logarithm of a normal positive number, within 1e-7 plus 1e-7 of its size. */
LANES_INLINE Lanes log2Lanes(Lanes a)
{
    /* Split a = 2^e m, with m from sqrt(1/2) to sqrt(2): 0x3f3504f3 are the bits of sqrt(1/2). */
    IntLanes exponent = ((IntLanes)a - 0x3f3504f3) >> 23;
    Lanes m = (Lanes)((IntLanes)a - (exponent << 23));
    /* ln m = 2 artanh s with s = (m - 1) / (m + 1), |s| < 0.172: take 5 terms of the series. */
    Lanes s = (m - 1.0f) / (m + 1.0f), s2 = s * s;
    Lanes series = 1.0f + s2 * (1 / 3.0f + s2 * (1 / 5.0f + s2 * (1 / 7.0f + s2 * (1 / 9.0f))));
    return __builtin_convertvector(exponent, Lanes) + 2.88539008f * s * series; /* 2 / ln 2 */
}

/* 2^a for a from -126 to 127, within 3e-7 of its size. */
LANES_INLINE Lanes exp2Lanes(Lanes a)
{
    /* Split a into an integer and a rest from -1/2 to 1/2. Adding 1.5 * 2^23 rounds to an integer. */
    Lanes whole = (a + 12582912.0f) - 12582912.0f;
    Lanes t = (a - whole) * 0.693147181f; /* ln 2 */
    /* e^t with |t| < 0.347: take 8 terms of the series. */
    Lanes e =
        1.0f +
        t * (1.0f +
             t * (1 / 2.0f + t * (1 / 6.0f + t * (1 / 24.0f +
                                                  t * (1 / 120.0f + t * (1 / 720.0f + t * (1 / 5040.0f)))))));
    return (Lanes)((IntLanes)e + (__builtin_convertvector(whole, IntLanes) << 23));
}

/* a^b for a at least 0 and b at least 0; 0^b is 0, also for b = 0. */
LANES_INLINE Lanes powLanes(Lanes a, Lanes b)
{
    Lanes exponent = maxLanes(b * log2Lanes(maxLanes(a, splatLanes(1e-37f))), splatLanes(-126.0f));
    return selectLanes(a > splatLanes(1e-37f), exp2Lanes(exponent), splatLanes(0.0f));
}

#endif
