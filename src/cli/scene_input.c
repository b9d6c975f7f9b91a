/* scene_input.c - the scene that a command works on; see scene_input.h. */
#include "cli/scene_input.h"

#include "base/files.h"
#include "base/threads.h"
#include "cli/terminal.h"
#include "scene/load.h"

#include <math.h>
#include <stdint.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum {
    LARGEST_SIDE = 65535
};
static const int64_t MOST_PIXELS = (int64_t)1 << 31;

/* a * numerator / denominator, rounded, at least 1. */
static int64_t scaleSide(int side, int numerator, int denominator)
{
    int64_t scaled = (2 * (int64_t)side * numerator + denominator) / (2 * (int64_t)denominator);
    return scaled < 1 ? 1 : scaled;
}

/* Set the picture's size; one side alone takes the other with it. */
static Status overrideSize(const Arguments *arguments, ImageSettings *image)
{
    int64_t width = image->width, height = image->height;
    if (arguments->width != 0)
        width = arguments->width;
    if (arguments->height != 0)
        height = arguments->height;
    if (arguments->width != 0 && arguments->height == 0)
        height = scaleSide(arguments->width, image->height, image->width);
    if (arguments->height != 0 && arguments->width == 0)
        width = scaleSide(arguments->height, image->width, image->height);
    if (width > LARGEST_SIDE || height > LARGEST_SIDE)
        return statusError(STATUS_USAGE,
                           "a picture of this size in the scene's aspect would be %lld x %lld pixels, and a "
                           "side has at most %d: choose a smaller one, or both sides",
                           (long long)width, (long long)height, LARGEST_SIDE);
    if (width * height > MOST_PIXELS)
        return statusError(STATUS_USAGE,
                           "a picture of %lld x %lld has more than the %lld pixels (2^31) that are possible: "
                           "choose a smaller --width or --height",
                           (long long)width, (long long)height, (long long)MOST_PIXELS);
    image->width = (int)width;
    image->height = (int)height;
    return statusOk();
}

static void overrideLimit(double given, double *limit)
{
    if (!isnan(given))
        *limit = given;
}

void overrideTolerance(const Tolerance *given, Tolerance *tolerance)
{
    overrideLimit(given->fail, &tolerance->fail);
    overrideLimit(given->failPercent, &tolerance->failPercent);
    overrideLimit(given->hardFail, &tolerance->hardFail);
    overrideLimit(given->rmse, &tolerance->rmse);
    overrideLimit(given->ssim, &tolerance->ssim);
    overrideLimit(given->flip, &tolerance->flip);
}

static Status overrideScene(const Arguments *arguments, Scene *scene)
{
    if (arguments->model != NOT_GIVEN)
        scene->render.model = (ShadingModel)(MODEL_SIMPLE + arguments->model);
    if (arguments->samples > 0)
        scene->render.samples = arguments->samples;
    if (arguments->encoding != NOT_GIVEN)
        scene->image.encoding = (Encoding)arguments->encoding;
    if (arguments->depthChoice != NOT_GIVEN)
        scene->image.bitDepth = arguments->depthChoice == 0 ? 8 : 16;
    overrideTolerance(&arguments->tolerance, &scene->tolerance);
    return overrideSize(arguments, &scene->image);
}

Status openScene(const char *path, const Arguments *arguments, Scene *scene, Text *messages)
{
    Diagnostics diagnostics = {0};
    Status status = loadScene(path, scene, &diagnostics);
    diagnosticsPrint(&diagnostics, displayName(path), colorOnErrors(), messages);
    bool isSaid = status.code == STATUS_SCENE && diagnostics.errors > 0;
    diagnosticsFree(&diagnostics);
    if (statusIsOk(&status)) {
        status = overrideScene(arguments, scene);
        if (!statusIsOk(&status))
            freeScene(scene);
    }
    if (status.code == STATUS_USAGE)
        appendSceneError(messages, path, &status);
    else if (!statusIsOk(&status) && !isSaid)
        appendError(messages, displayName(path), &status);
    return status;
}

Status openSceneAloud(const char *path, const Arguments *arguments, Scene *scene)
{
    Text messages = {0};
    Status status = openScene(path, arguments, scene, &messages);
    printMessages(&messages);
    return status;
}

int chosenThreads(const Arguments *arguments)
{
    return arguments->threads > 0 ? arguments->threads : availableProcessors();
}

const char *baseName(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

bool isPictureName(const char *path)
{
    const char *dot = strrchr(baseName(path), '.');
    return dot != NULL && strcasecmp(dot, ".png") == 0;
}

void appendNameBeside(const char *scene, const char *extension, Text *name)
{
    const char *base = baseName(scene), *dot = strrchr(base, '.');
    bool isYaml =
        dot != NULL && dot != base && (strcasecmp(dot, ".yaml") == 0 || strcasecmp(dot, ".yml") == 0);
    textAppendBytes(name, scene, isYaml ? (size_t)(dot - scene) : strlen(scene));
    textAppend(name, extension);
}

/* Whether both name the same existing file. */
static bool isSameFile(const char *a, const char *b)
{
    struct stat aFile, bFile;
    return strcmp(a, "-") != 0 && strcmp(b, "-") != 0 && stat(a, &aFile) == 0 && stat(b, &bFile) == 0 &&
           S_ISREG(aFile.st_mode) && aFile.st_dev == bFile.st_dev && aFile.st_ino == bFile.st_ino;
}

Status refuseOverwriting(const Arguments *arguments, const Scene *scene, const char *output,
                         const char *remedy)
{
    const char *input = NULL;
    for (size_t i = 0; i < arguments->operandCount && output != NULL && input == NULL; i++)
        if (isSameFile(output, arguments->operands[i]))
            input = arguments->operands[i];
    const SceneFileName *file = scene != NULL && output != NULL ? scene->files : NULL;
    for (; file != NULL && input == NULL; file = file->next)
        if (isSameFile(output, file->path))
            input = file->path;
    return input == NULL ? statusOk()
                         : statusError(STATUS_USAGE, "writing %s would overwrite %s, which is read: %s",
                                       output, input, remedy);
}

Status probeOutput(const char *output)
{
    /* Only regular files; opening a pipe or a device would be noticed at its other end. */
    struct stat file;
    if (strcmp(output, "-") == 0 ||
        (stat(output, &file) == 0 && !S_ISREG(file.st_mode) && !S_ISDIR(file.st_mode)))
        return statusOk();
    OutputFile probe;
    Status status = openOutput(&probe, output);
    if (statusIsOk(&status))
        abandonOutput(&probe);
    return status;
}

void warnOfNonFinitePixels(const Framebuffer *framebuffer, const char *path, Text *messages)
{
    size_t count = countNonFinitePixels(framebuffer);
    if (count > 0)
        appendWarning(messages,
                      "%s: %zu %s not finite (infinite or not a number), which a picture cannot hold; stored "
                      "as white or black",
                      displayName(path), count, count == 1 ? "pixel is" : "pixels are");
}
