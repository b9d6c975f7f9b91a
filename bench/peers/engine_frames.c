/* engine_frames.c - the fast engine measured as the Embree yardstick measures itself: several frames in one
 * process.
 *
 *   engine_frames SCENE.yaml THREADS FRAMES
 *
 * Prints JSON: the bytes of the CompiledScene, seconds of compiling it, and least and median seconds of a
 * frame.
 */
#include "engine/engine.h"
#include "scene/load.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum {
    MOST_FRAMES = 100
};

static double secondsNow(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int compareSeconds(const void *a, const void *b)
{
    double first = *(const double *)a, second = *(const double *)b;
    return (first > second) - (first < second);
}

static Status measure(const Scene *scene, int threads, int frames)
{
    double start = secondsNow();
    CompiledScene *compiled;
    Status status = compileScene(scene, threads, &compiled);
    double compile = secondsNow() - start;
    if (!statusIsOk(&status))
        return status;
    Framebuffer *framebuffer = createFramebuffer(scene->image.width, scene->image.height);
    status = framebuffer != NULL ? statusOk() : statusOutOfMemory();
    double seconds[MOST_FRAMES];
    RenderOptions options = {.threads = threads};
    for (int i = 0; i < frames && statusIsOk(&status); i++) {
        start = secondsNow();
        status = renderCompiled(compiled, framebuffer, &options, NULL);
        seconds[i] = secondsNow() - start;
    }
    qsort(seconds, (size_t)frames, sizeof *seconds, compareSeconds);
    if (statusIsOk(&status))
        printf("{\"bytes\": %zu, \"compile\": %.6f, \"trace\": %.6f, \"trace_median\": %.6f}\n",
               compiledSceneBytes(compiled), compile, seconds[0], seconds[frames / 2]);
    freeFramebuffer(framebuffer);
    freeCompiledScene(compiled);
    return status;
}

int main(int argc, char **argv)
{
    int threads = argc == 4 ? atoi(argv[2]) : 0, frames = argc == 4 ? atoi(argv[3]) : 0;
    if (threads < 1 || frames < 1 || frames > MOST_FRAMES) {
        fprintf(stderr, "Usage: engine_frames SCENE.yaml THREADS FRAMES\n");
        return 2;
    }
    Scene scene;
    Diagnostics diagnostics = {0};
    Status status = loadScene(argv[1], &scene, &diagnostics);
    diagnosticsFree(&diagnostics);
    if (statusIsOk(&status)) {
        status = measure(&scene, threads, frames);
        freeScene(&scene);
    }
    if (!statusIsOk(&status))
        fprintf(stderr, "engine_frames: %s: %s\n", argv[1], status.message);
    return statusIsOk(&status) ? 0 : 1;
}
