/* lane_paths.c - which instruction set draws: see lanes/path.h.
 *
 * The plain path is what the compiler makes for any processor of the architecture: SSE2 on x86-64, NEON on
 * aarch64, no vectors at all with ECLAIRAGE_PORTABLE. On x86-64 there is a second one for AVX2 and FMA.
 */
#include "engine/lanes/path.h"
#include "engine/lanes/simd.h"

#include <stdlib.h>
#include <string.h>

#define DECLARE_PATH(path)                                                                                   \
    void drawTile_##path(const TileJob *job, int left, int top, uint32_t *lastBlocks, RayCounts *counts);    \
    void meetRay_##path(const CompiledScene *compiled, const Ray *ray, Hit *hit, uint32_t *object);          \
    bool blockRay_##path(const CompiledScene *compiled, const ShadowRay *shadow);

#if defined SIMD_SSE2
#define PLAIN_NAME "sse2"
#elif defined __ARM_NEON && !defined ECLAIRAGE_PORTABLE
#define PLAIN_NAME "neon"
#else
#define PLAIN_NAME "portable"
#endif

DECLARE_PATH(plain)
static const LanePath plainPath = {PLAIN_NAME, drawTile_plain, meetRay_plain, blockRay_plain};

#ifdef ECLAIRAGE_HAS_AVX2
DECLARE_PATH(avx2)
static const LanePath avx2Path = {"avx2", drawTile_avx2, meetRay_avx2, blockRay_avx2};
#endif

/* The paths that this processor can run, the fastest first. */
static size_t findPaths(const LanePath *paths[2])
{
    size_t count = 0;
#ifdef ECLAIRAGE_HAS_AVX2
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        paths[count++] = &avx2Path;
#endif
    paths[count++] = &plainPath;
    return count;
}

Status chooseLanePath(const LanePath **path)
{
    const LanePath *paths[2];
    size_t count = findPaths(paths);
    const char *wanted = getenv("ECLAIRAGE_PATH");
    if (wanted == NULL || *wanted == '\0') {
        *path = paths[0];
        return statusOk();
    }
    for (size_t i = 0; i < count; i++)
        if (strcmp(wanted, paths[i]->name) == 0) {
            *path = paths[i];
            return statusOk();
        }
    return statusError(STATUS_USAGE, "ECLAIRAGE_PATH is '%s', which is not here; there %s %s%s%s", wanted,
                       count > 1 ? "are" : "is", paths[0]->name, count > 1 ? " and " : "",
                       count > 1 ? paths[1]->name : "");
}
