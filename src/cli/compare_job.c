/* compare_job.c - see compare_job.h. */
#include "cli/compare_job.h"

#include "base/files.h"
#include "cli/drawing.h"
#include "cli/scene_input.h"
#include "cli/terminal.h"
#include "compare/difference.h"
#include "image/image.h"
#include "povray/export.h"
#include "povray/run.h"

#include <string.h>

/* Both pictures of a scene and their difference. */
typedef struct Pictures {
    Image ours, povray, difference;
} Pictures;

bool namePictureFiles(const char *stem, PictureFiles *files)
{
    textAppendFormat(&files->ours, "%s-ours.png", stem);
    textAppendFormat(&files->povray, "%s-povray.png", stem);
    textAppendFormat(&files->difference, "%s-difference.png", stem);
    textAppendFormat(&files->pov, "%s.pov", stem);
    return !(files->ours.failed || files->povray.failed || files->difference.failed || files->pov.failed);
}

void freePictureFiles(PictureFiles *files)
{
    textFree(&files->ours);
    textFree(&files->povray);
    textFree(&files->difference);
    textFree(&files->pov);
}

Text pathInFolder(const char *folder, const char *name)
{
    Text path = {0};
    bool endsInSlash = folder[strlen(folder) - 1] == '/';
    textAppendFormat(&path, "%s%s%s", folder, endsInSlash ? "" : "/", name);
    return path;
}

/* STATUS_USAGE when the .pov would be written over its scene. */
static Status protectScene(const CompareSettings *settings, const Text *pov, const char *scenePath)
{
    Text path = pathInFolder(settings->folder, textString(pov));
    bool isScene = isSameFile(textString(&path), scenePath);
    textFree(&path);
    return isScene ? statusError(STATUS_USAGE, "the POV-Ray scene would overwrite the scene itself: choose "
                                               "another folder with --out, or end its name in .yaml")
                   : statusOk();
}

static Status writePov(const CompareSettings *settings, const Text *name, const Text *pov)
{
    Text path = pathInFolder(settings->folder, textString(name));
    Status status = path.failed || pov->failed ? statusOutOfMemory()
                                               : writeWholeFile(path.data, textString(pov), pov->length);
    textFree(&path);
    return status;
}

static Status writePicture(const CompareSettings *settings, const Text *name, const Image *image)
{
    Text path = pathInFolder(settings->folder, textString(name));
    Status status = path.failed ? statusOutOfMemory() : writePng(path.data, image, settings->threads);
    textFree(&path);
    return status;
}

static Status drawOurs(const CompareSettings *settings, const Scene *scene, const char *scenePath,
                       Image *ours, PictureResult *result, Text *messages)
{
    Framebuffer *framebuffer = createFramebuffer(scene->image.width, scene->image.height);
    if (framebuffer == NULL)
        return statusError(STATUS_IO, "out of memory for a picture of %d x %d pixels", scene->image.width,
                           scene->image.height);
    pthread_mutex_lock(settings->turn);
    RenderOptions options = {.threads = settings->threads};
    DrawingSeconds seconds;
    Status status = drawScene(scene, settings->engine, framebuffer, &options, NULL, &seconds);
    result->renderSeconds = seconds.compile + seconds.trace;
    pthread_mutex_unlock(settings->turn);
    if (statusIsOk(&status)) {
        warnOfNonFinitePixels(framebuffer, scenePath, messages);
        status = imageFromFramebuffer(framebuffer, scene->image.bitDepth, scene->image.encoding,
                                      settings->threads, ours);
    }
    freeFramebuffer(framebuffer);
    return status;
}

static Status drawWithPovray(const CompareSettings *settings, const Scene *scene, const Text *pov,
                             Image *povray, PictureResult *result)
{
    PovraySettings povraySettings = createPovraySettings(scene, settings->povrayThreads);
    double start = secondsNow();
    Status status = runPovray(textString(pov), &povraySettings, povray);
    result->povraySeconds = secondsSince(start);
    return status;
}

static Status measurePictures(const CompareSettings *settings, const Tolerance *tolerance, Pictures *pictures,
                              PictureResult *result)
{
    Status status = checkComparable(&pictures->ours, "our picture", &pictures->povray, "POV-Ray's picture");
    pthread_mutex_lock(settings->turn);
    double start = secondsNow();
    if (statusIsOk(&status))
        status = measureImages(&pictures->ours, &pictures->povray, tolerance->fail, settings->threads,
                               &result->metrics);
    if (statusIsOk(&status))
        status = differencePicture(&pictures->ours, &pictures->povray, &pictures->difference);
    result->compareSeconds = secondsSince(start);
    pthread_mutex_unlock(settings->turn);
    if (statusIsOk(&status))
        result->verdict = judgeMetrics(&result->metrics, tolerance);
    return status;
}

Status comparePicture(const CompareSettings *settings, const Scene *scene, const char *scenePath,
                      const PictureFiles *files, PictureResult *result, Text *messages)
{
    Text pov = {0};
    Pictures pictures = {0};
    Status status = exportPov(scene, textString(&files->pov), &pov);
    if (statusIsOk(&status))
        status = protectScene(settings, &files->pov, scenePath);
    if (statusIsOk(&status))
        status = writePov(settings, &files->pov, &pov);
    if (statusIsOk(&status))
        status = drawOurs(settings, scene, scenePath, &pictures.ours, result, messages);
    if (statusIsOk(&status))
        status = drawWithPovray(settings, scene, &pov, &pictures.povray, result);
    textFree(&pov);
    if (statusIsOk(&status))
        status = measurePictures(settings, &scene->tolerance, &pictures, result);
    if (statusIsOk(&status))
        status = writePicture(settings, &files->ours, &pictures.ours);
    if (statusIsOk(&status))
        status = writePicture(settings, &files->povray, &pictures.povray);
    if (statusIsOk(&status))
        status = writePicture(settings, &files->difference, &pictures.difference);
    freeImage(&pictures.ours);
    freeImage(&pictures.povray);
    freeImage(&pictures.difference);
    return status;
}
