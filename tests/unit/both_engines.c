/* both_engines.c - see both_engines.h. */
#include "both_engines.h"

#include "engine/engine.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char VARIABLE[] = "ECLAIRAGE_PATH";

size_t findEnginePaths(const char *paths[MOST_ENGINE_PATHS])
{
    static const char *const known[MOST_ENGINE_PATHS] = {"avx2", "sse2", "neon", "portable"};
    size_t count = 0;
    Scene scene = createScene();
    for (size_t i = 0; i < MOST_ENGINE_PATHS; i++) {
        setenv(VARIABLE, known[i], 1);
        CompiledScene *compiled;
        Status status = compileScene(&scene, 1, &compiled);
        if (!statusIsOk(&status))
            continue;
        if (strcmp(compiledScenePath(compiled), known[i]) == 0)
            paths[count++] = known[i];
        freeCompiledScene(compiled);
    }
    unsetenv(VARIABLE);
    freeScene(&scene);
    return count;
}

/* Put 1 into all bits, so that a pixel that nobody draws is seen. */
static void spoil(Framebuffer *framebuffer)
{
    memset(framebuffer->pixels, 0xff,
           (size_t)framebuffer->width * (size_t)framebuffer->height * sizeof *framebuffer->pixels);
}

/* Leave numbers on the stack that do harm where somebody reads what nobody wrote: large ones, and none at
 * all, other ones in each 64, as many as a tile has rays. */
static __attribute__((noinline)) void spoilStack(unsigned which)
{
    const double numbers[] = {NAN, 1e20, -1e5, INFINITY, 1e160, 3, 1e300, -1e-300};
    volatile double stack[1 << 15];
    for (size_t i = 0; i < sizeof stack / sizeof *stack; i++)
        stack[i] = numbers[(which + i / 64) % (sizeof numbers / sizeof *numbers)];
}

/* Describe the first pixel whose bits differ; false where there is none. */
static bool describeDifference(const Framebuffer *a, const Framebuffer *b, char *text, size_t size)
{
    size_t count = (size_t)a->width * (size_t)a->height, differing = 0, first = 0;
    for (size_t i = count; i-- > 0;)
        if (memcmp(&a->pixels[i], &b->pixels[i], sizeof *a->pixels) != 0) {
            differing++;
            first = i;
        }
    if (differing == 0)
        return false;
    Color3f p = a->pixels[first], q = b->pixels[first];
    snprintf(
        text, size,
        "%zu of %zu pixels differ, the first at (%zu, %zu): reference %.9g %.9g %.9g, fast %.9g %.9g %.9g",
        differing, count, first % (size_t)a->width, first / (size_t)a->width, (double)p.r, (double)p.g,
        (double)p.b, (double)q.r, (double)q.g, (double)q.b);
    return true;
}

/* Draw the scene fast and compare with what the reference has given. */
static bool fastAgrees(const Scene *scene, int threads, const Framebuffer *expected, RayCounts expectedCounts,
                       Framebuffer *drawn, char *text, size_t size)
{
    CompiledScene *compiled;
    Status status = compileScene(scene, threads, &compiled);
    if (!statusIsOk(&status)) {
        snprintf(text, size, "compileScene: %s", status.message);
        return false;
    }
    spoil(drawn);
    RayCounts counts = {0};
    RenderOptions options = {.threads = threads};
    static unsigned drawings;
    spoilStack(drawings++ + 4 + 3 + 2 + 1);
    status = renderCompiled(compiled, drawn, &options, &counts);
    freeCompiledScene(compiled);
    if (!statusIsOk(&status)) {
        snprintf(text, size, "renderCompiled: %s", status.message);
        return false;
    }
    if (describeDifference(expected, drawn, text, size))
        return false;
    if (counts.primary == expectedCounts.primary && counts.shadow == expectedCounts.shadow &&
        counts.secondary == expectedCounts.secondary)
        return true;
    snprintf(text, size,
             "the same picture, but not the same primary, shadow and secondary rays: reference %" PRIu64
             " %" PRIu64 " %" PRIu64 ", fast %" PRIu64 " %" PRIu64 " %" PRIu64,
             expectedCounts.primary, expectedCounts.shadow, expectedCounts.secondary, counts.primary,
             counts.shadow, counts.secondary);
    return false;
}

bool enginesAgree(const Scene *scene, int width, int height, const char *const *paths, size_t pathCount,
                  const int threads[2], char difference[DIFFERENCE_SIZE])
{
    Framebuffer *expected = createFramebuffer(width, height), *drawn = createFramebuffer(width, height);
    bool agree = false;
    if (expected == NULL || drawn == NULL) {
        snprintf(difference, DIFFERENCE_SIZE, "out of memory");
    } else {
        RayCounts counts = {0};
        RenderOptions options = {.threads = 1};
        spoil(expected);
        Status status = renderReference(scene, expected, &options, &counts);
        agree = statusIsOk(&status);
        if (!agree)
            snprintf(difference, DIFFERENCE_SIZE, "renderReference: %s", status.message);
        for (size_t p = 0; p < pathCount && agree; p++)
            for (int t = 0; t < 2 && threads[t] > 0 && agree; t++) {
                int length = snprintf(difference, DIFFERENCE_SIZE, "%s, threads %d: ", paths[p], threads[t]);
                setenv(VARIABLE, paths[p], 1);
                agree = fastAgrees(scene, threads[t], expected, counts, drawn, difference + length,
                                   DIFFERENCE_SIZE - (size_t)length);
            }
        unsetenv(VARIABLE);
    }
    freeFramebuffer(expected);
    freeFramebuffer(drawn);
    return agree;
}
