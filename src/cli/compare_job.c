/* compare_job.c - see compare_job.h. */
#include "cli/compare_job.h"

#include "base/files.h"
#include "cli/drawing.h"
#include "cli/report_folder.h"
#include "cli/scene_input.h"
#include "cli/terminal.h"
#include "compare/difference.h"
#include "image/image.h"
#include "povray/export.h"
#include "povray/run.h"

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

/* See that none of the files is written over what is read. */
static Status protectFrom(const CompareSettings *settings, const PictureFiles *files, const Scene *scene)
{
    const Text *const names[] = {&files->ours, &files->povray, &files->difference, &files->pov};
    Status status = statusOk();
    for (size_t i = 0; i < sizeof names / sizeof *names && statusIsOk(&status); i++)
        status = protectInputs(settings->arguments, scene, settings->folder, textString(names[i]));
    return status;
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
    pthread_mutex_lock(settings->turn);
    DrawingSeconds seconds = {0};
    Status status =
        drawImage(scene, scenePath, settings->engine, settings->threads, ours, &seconds, messages);
    result->renderSeconds = seconds.compile + seconds.trace;
    pthread_mutex_unlock(settings->turn);
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
        status = protectFrom(settings, files, scene);
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
