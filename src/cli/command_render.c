/* command_render.c - `eclairage render`: from a scene to a PNG, and to those of --aov. */
#include "base/json.h"
#include "base/text.h"
#include "cli/aov_files.h"
#include "cli/command.h"
#include "cli/drawing.h"
#include "cli/scene_input.h"
#include "cli/terminal.h"
#include "image/image.h"
#include "raytracer.h"

#include <string.h>
#include <sys/resource.h>

/* How long each phase took, in seconds. */
typedef struct Phases {
    double load, compile, trace, write, total;
} Phases;

/* The most memory the process has had, in bytes; Linux counts kibibytes. */
static int64_t peakMemory(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (int64_t)usage.ru_maxrss * 1024 : 0;
}

static int printJson(const char *path, const Scene *scene, Engine engine, int threads, const Phases *phases,
                     const RayCounts *rays, const AovFiles *aovs)
{
    Text text = {0};
    JsonWriter json = jsonBegin(&text);
    jsonObject(&json);
    jsonKeyString(&json, "scene", path);
    jsonKeyInteger(&json, "width", scene->image.width);
    jsonKeyInteger(&json, "height", scene->image.height);
    jsonKeyString(&json, "engine", engine == ENGINE_FAST ? "fast" : "reference");
    jsonKeyInteger(&json, "threads", threads);
    jsonKey(&json, "seconds");
    jsonInlineObject(&json);
    jsonKeyNumber(&json, "load", phases->load);
    jsonKeyNumber(&json, "compile", phases->compile);
    jsonKeyNumber(&json, "trace", phases->trace);
    jsonKeyNumber(&json, "write", phases->write);
    jsonKeyNumber(&json, "total", phases->total);
    jsonEndObject(&json);
    jsonKey(&json, "rays");
    jsonInlineObject(&json);
    jsonKeyInteger(&json, "primary", (int64_t)rays->primary);
    jsonKeyInteger(&json, "shadow", (int64_t)rays->shadow);
    jsonKeyInteger(&json, "secondary", (int64_t)rays->secondary);
    jsonEndObject(&json);
    jsonKeyInteger(&json, "peak_memory_bytes", peakMemory());
    if (aovs->set != 0)
        jsonAovFiles(&json, aovs, scene);
    jsonEndObject(&json);
    jsonEnd(&json);
    return printData(&text);
}

/* Draw, store and write; the phases' times and the rays are measured. */
static Status renderToFile(const Scene *scene, const char *path, Engine engine, int threads,
                           const char *output, Phases *phases, RayCounts *rays)
{
    Framebuffer *framebuffer = createFramebuffer(scene->image.width, scene->image.height);
    if (framebuffer == NULL)
        return statusError(STATUS_IO, "out of memory for a picture of %d x %d pixels", scene->image.width,
                           scene->image.height);

    beginProgress("rendering");
    RenderOptions options = {.threads = threads, .progress = showProgress};
    DrawingSeconds seconds;
    Status status = drawScene(scene, engine, framebuffer, &options, rays, &seconds);
    endProgress();
    phases->compile = seconds.compile;
    phases->trace = seconds.trace;

    /* Write the picture. */
    double start = secondsNow();
    Image image;
    if (statusIsOk(&status)) {
        Text messages = {0};
        warnOfNonFinitePixels(framebuffer, path, &messages);
        printMessages(&messages);
        status =
            imageFromFramebuffer(framebuffer, scene->image.bitDepth, scene->image.encoding, threads, &image);
    }
    freeFramebuffer(framebuffer);
    if (statusIsOk(&status)) {
        status = writePng(output, &image, threads);
        freeImage(&image);
    }
    phases->write = secondsSince(start);
    return status;
}

int runRender(const Arguments *arguments)
{
    double start = secondsNow();
    const char *path = arguments->operands[0];
    Scene scene;
    Status status = openSceneAloud(path, arguments, &scene);
    if (!statusIsOk(&status))
        return (int)status.code;

    Phases phases = {.load = secondsSince(start)};
    RayCounts rays = {0};
    int threads = chosenThreads(arguments);
    Text defaultName = {0};
    if (arguments->output == NULL)
        appendNameBeside(path, ".png", &defaultName);
    const char *output = arguments->output != NULL ? arguments->output : textString(&defaultName);
    status = defaultName.failed ? statusOutOfMemory()
                                : refuseOverwriting(arguments, &scene, output, CHOOSE_OUTPUT);
    if (statusIsOk(&status))
        status = probeOutput(output);
    AovFiles aovs = {.set = 0};
    if (statusIsOk(&status))
        status = prepareAovFiles(arguments, &scene, output, &aovs);
    if (statusIsOk(&status))
        status = renderToFile(&scene, path, chosenEngine(arguments), threads, output, &phases, &rays);
    phases.total = secondsSince(start);
    if (statusIsOk(&status) && strcmp(output, "-") != 0)
        printNote("wrote %s (%d x %d, %.2f s)", output, scene.image.width, scene.image.height, phases.total);
    if (statusIsOk(&status) && aovs.set != 0) {
        status = writeAovFiles(&aovs, &scene, path, chosenEngine(arguments), threads);
        phases.total = secondsSince(start);
    }

    int code = (int)status.code;
    if (!statusIsOk(&status)) {
        printError(displayName(path), &status);
    } else if (arguments->json) {
        code = printJson(path, &scene, chosenEngine(arguments), threads, &phases, &rays, &aovs);
    }
    freeAovFiles(&aovs);
    textFree(&defaultName);
    freeScene(&scene);
    return code;
}
