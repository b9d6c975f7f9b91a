/* drawing.c - see drawing.h. */
#include "cli/drawing.h"

#include "cli/scene_input.h"
#include "cli/terminal.h"
#include "engine/engine.h"

Engine chosenEngine(const Arguments *arguments)
{
    return arguments->engine == NOT_GIVEN ? ENGINE_FAST : (Engine)arguments->engine;
}

Status drawScene(const Scene *scene, Engine engine, Framebuffer *framebuffer, const RenderOptions *options,
                 RayCounts *counts, DrawingSeconds *seconds)
{
    *seconds = (DrawingSeconds){0};
    double start = secondsNow();
    if (engine == ENGINE_REFERENCE) {
        Status status = renderReference(scene, framebuffer, options, counts);
        seconds->trace = secondsSince(start);
        return status;
    }
    CompiledScene *compiled;
    Status status = compileScene(scene, options->threads, &compiled);
    seconds->compile = secondsSince(start);
    if (!statusIsOk(&status))
        return status;
    start = secondsNow();
    status = renderCompiled(compiled, framebuffer, options, counts);
    seconds->trace = secondsSince(start);
    freeCompiledScene(compiled);
    return status;
}

Status drawImage(const Scene *scene, const char *path, Engine engine, int threads, Image *image,
                 DrawingSeconds *seconds, Text *messages)
{
    *seconds = (DrawingSeconds){0};
    Framebuffer *framebuffer = createFramebuffer(scene->image.width, scene->image.height);
    if (framebuffer == NULL)
        return statusError(STATUS_IO, "out of memory for a picture of %d x %d pixels", scene->image.width,
                           scene->image.height);
    RenderOptions options = {.threads = threads};
    Status status = drawScene(scene, engine, framebuffer, &options, NULL, seconds);
    if (statusIsOk(&status)) {
        warnOfNonFinitePixels(framebuffer, path, messages);
        status =
            imageFromFramebuffer(framebuffer, scene->image.bitDepth, scene->image.encoding, threads, image);
    }
    freeFramebuffer(framebuffer);
    return status;
}
