/* simd.h - eight floats at a time: the one place that knows an instruction set.
 *
 * Built on the vector types of GCC and Clang, whose + - * / and comparisons work lane by lane on any machine.
 * Only what they cannot say well has a second way with intrinsics; with ECLAIRAGE_PORTABLE those are left
 * out, and the results are the same but for f8MultAdd, which fuses where the machine can. So it may be used
 * only where its rounding cannot reach the picture: in the float filter (see bundle.h). A mask is a vector of
 * ints, each 0 or -1.
 */
#ifndef ECLAIRAGE_ENGINE_SIMD_H
#define ECLAIRAGE_ENGINE_SIMD_H

#include <math.h>
#include <stdint.h>

#if defined __SSE2__ && !defined ECLAIRAGE_PORTABLE
#include <immintrin.h>
#define SIMD_SSE2 1
#endif
#if defined __AVX2__ && defined __FMA__ && !defined ECLAIRAGE_PORTABLE
#define SIMD_AVX2 1
#endif

typedef float F8 __attribute__((vector_size(32)));
typedef int32_t I8 __attribute__((vector_size(32)));
typedef float F4 __attribute__((vector_size(16)));
typedef int32_t I4 __attribute__((vector_size(16)));

/* All lanes the same. */
static inline F8 f8Set(float x)
{
    return (F8){x, x, x, x, x, x, x, x};
}

static inline I8 i8Set(int32_t x)
{
    return (I8){x, x, x, x, x, x, x, x};
}

/* Eight floats at an address that is a multiple of 32. */
static inline F8 f8Load(const float *from)
{
    return *(const F8 *)__builtin_assume_aligned(from, 32);
}

static inline void f8Store(float *to, F8 x)
{
    *(F8 *)__builtin_assume_aligned(to, 32) = x;
}

/* The eight truths of a mask as bits, lane 0 the lowest. */
static inline unsigned maskBits(I8 mask)
{
#if defined SIMD_AVX2
    return (unsigned)_mm256_movemask_ps((__m256)mask);
#elif defined SIMD_SSE2
    union {
        I8 whole;
        __m128 halves[2];
    } both = {mask};
    return (unsigned)_mm_movemask_ps(both.halves[0]) | (unsigned)_mm_movemask_ps(both.halves[1]) << 4;
#else
    unsigned bits = 0;
    for (unsigned i = 0; i < 8; i++)
        bits |= (mask[i] != 0 ? 1u : 0u) << i;
    return bits;
#endif
}

/* The other way round. */
static inline I8 maskOfBits(unsigned bits)
{
    const I8 each = {1, 2, 4, 8, 16, 32, 64, 128};
    return (i8Set((int32_t)bits) & each) == each;
}

/* Lane by lane a where the mask is set, else b. */
static inline F8 f8Select(I8 mask, F8 a, F8 b)
{
#if defined SIMD_AVX2
    return (F8)_mm256_blendv_ps((__m256)b, (__m256)a, (__m256)mask);
#else
    return (F8)((mask & (I8)a) | (~mask & (I8)b));
#endif
}

static inline I8 i8Select(I8 mask, I8 a, I8 b)
{
    return (mask & a) | (~mask & b);
}

static inline F8 f8Min(F8 a, F8 b)
{
#if defined SIMD_AVX2
    return (F8)_mm256_min_ps((__m256)a, (__m256)b);
#else
    return f8Select(a < b, a, b);
#endif
}

static inline F8 f8Max(F8 a, F8 b)
{
#if defined SIMD_AVX2
    return (F8)_mm256_max_ps((__m256)a, (__m256)b);
#else
    return f8Select(a > b, a, b);
#endif
}

static inline F8 f8Abs(F8 a)
{
    return (F8)((I8)a & i8Set(0x7FFFFFFF));
}

static inline F8 f8Sqrt(F8 a)
{
#if defined SIMD_AVX2
    return (F8)_mm256_sqrt_ps((__m256)a);
#elif defined SIMD_SSE2
    union {
        F8 whole;
        __m128 halves[2];
    } both = {a};
    both.halves[0] = _mm_sqrt_ps(both.halves[0]);
    both.halves[1] = _mm_sqrt_ps(both.halves[1]);
    return both.whole;
#else
    for (int i = 0; i < 8; i++)
        a[i] = sqrtf(a[i]);
    return a;
#endif
}

/* a b + c, rounded once or twice. */
static inline F8 f8MultAdd(F8 a, F8 b, F8 c)
{
#if defined SIMD_AVX2
    return (F8)_mm256_fmadd_ps((__m256)a, (__m256)b, (__m256)c);
#else
    return a * b + c;
#endif
}

/* c - a b, likewise. */
static inline F8 f8NegMultAdd(F8 a, F8 b, F8 c)
{
#if defined SIMD_AVX2
    return (F8)_mm256_fnmadd_ps((__m256)a, (__m256)b, (__m256)c);
#else
    return c - a * b;
#endif
}

/* a b - c, likewise. */
static inline F8 f8MultSub(F8 a, F8 b, F8 c)
{
#if defined SIMD_AVX2
    return (F8)_mm256_fmsub_ps((__m256)a, (__m256)b, (__m256)c);
#else
    return a * b - c;
#endif
}

/* The smallest and the largest lane. */
static inline float f8Least(F8 a)
{
#if defined SIMD_AVX2
    __m128 m = _mm_min_ps(_mm256_castps256_ps128((__m256)a), _mm256_extractf128_ps((__m256)a, 1));
    m = _mm_min_ps(m, _mm_movehl_ps(m, m));
    return _mm_cvtss_f32(_mm_min_ss(m, _mm_shuffle_ps(m, m, 1)));
#else
    float least = a[0];
    for (int i = 1; i < 8; i++)
        least = a[i] < least ? a[i] : least;
    return least;
#endif
}

static inline float f8Largest(F8 a)
{
    return -f8Least(-a);
}

/* Four floats, for boxes while a tree is built. */
static inline F4 f4Min(F4 a, F4 b)
{
#if defined SIMD_SSE2
    return (F4)_mm_min_ps((__m128)a, (__m128)b);
#else
    for (int i = 0; i < 4; i++)
        a[i] = a[i] < b[i] ? a[i] : b[i];
    return a;
#endif
}

static inline F4 f4Max(F4 a, F4 b)
{
#if defined SIMD_SSE2
    return (F4)_mm_max_ps((__m128)a, (__m128)b);
#else
    for (int i = 0; i < 4; i++)
        a[i] = a[i] > b[i] ? a[i] : b[i];
    return a;
#endif
}

/* The smallest lane of each of four. */
static inline F4 f8Least4(F8 a, F8 b, F8 c, F8 d)
{
    F8 ab = f8Min(__builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13),
                  __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15));
    F8 cd = f8Min(__builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13),
                  __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15));
    F8 all = f8Min(__builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13),
                   __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15));
    return f4Min(__builtin_shufflevector(all, all, 0, 1, 2, 3),
                 __builtin_shufflevector(all, all, 4, 5, 6, 7));
}

#endif
