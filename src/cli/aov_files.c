/* aov_files.c - see aov_files.h.
 *
 * Colours are stored as the picture is. Normal and depth are data and stored linear, depth in 16 bits. The
 * id's colours are stored as they are, in 8 bits.
 */
#include "cli/aov_files.h"

#include "cli/drawing.h"
#include "cli/scene_input.h"
#include "cli/terminal.h"
#include "engine/engine.h"
#include "explain/scene_variant.h"
#include "image/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static bool isWanted(const AovFiles *files, Aov aov)
{
    return (files->set & 1u << aov) != 0;
}

Status prepareAovFiles(const Arguments *arguments, const Scene *scene, const char *output, AovFiles *files)
{
    *files = (AovFiles){.set = arguments->aovs, .farthest = NAN};
    size_t length = strlen(output);
    size_t stem = length - strlen(baseName(output));
    if (length > stem + 4 && strcasecmp(output + length - 4, ".png") == 0)
        length -= 4;
    for (Aov aov = 0; aov < AOV_COUNT; aov++) {
        if (!isWanted(files, aov))
            continue;
        Text *name = &files->names[aov];
        textAppendBytes(name, output, length);
        textAppendFormat(name, "-%s.png", aovName(aov));
        if (name->failed)
            return statusOutOfMemory();
        Status status = refuseOverwriting(arguments, scene, name->data, CHOOSE_OUTPUT);
        if (statusIsOk(&status))
            status = probeOutput(name->data);
        if (!statusIsOk(&status))
            return status;
    }
    return statusOk();
}

void freeAovFiles(AovFiles *files)
{
    for (Aov aov = 0; aov < AOV_COUNT; aov++)
        textFree(&files->names[aov]);
    free(files->objectPixels);
    files->objectPixels = NULL;
}

/* How a picture is stored. */
static void chooseStorage(const Scene *scene, Aov aov, int *bitDepth, Encoding *encoding)
{
    *bitDepth = scene->image.bitDepth;
    *encoding = scene->image.encoding;
    if (aov == AOV_NORMAL || aov == AOV_DEPTH)
        *encoding = ENCODING_LINEAR;
    if (aov == AOV_DEPTH)
        *bitDepth = 16;
    if (aov == AOV_ID) {
        *bitDepth = 8;
        *encoding = ENCODING_LINEAR;
    }
}

static Status writeAov(const AovFiles *files, const Scene *scene, Aov aov, const Framebuffer *framebuffer,
                       const char *scenePath, int threads)
{
    const char *name = textString(&files->names[aov]);
    size_t nonFinite = countNonFinitePixels(framebuffer);
    if (nonFinite > 0)
        printWarning("%s: in %s %zu %s not finite (infinite or not a number), which a picture cannot hold; "
                     "stored as white or black",
                     displayName(scenePath), name, nonFinite, nonFinite == 1 ? "pixel is" : "pixels are");
    int bitDepth;
    Encoding encoding;
    chooseStorage(scene, aov, &bitDepth, &encoding);
    Image image;
    Status status = imageFromFramebuffer(framebuffer, bitDepth, encoding, threads, &image);
    if (!statusIsOk(&status))
        return status;
    /* The samples of the id are colours of the screen. */
    if (aov == AOV_ID)
        image.encoding = ENCODING_SRGB;
    status = writePng(name, &image, threads);
    freeImage(&image);
    if (!statusIsOk(&status))
        return status;
    if (aov == AOV_DEPTH && isfinite(files->farthest)) {
        char farthest[NUMBER_TEXT_SIZE];
        printNote("wrote %s (white is at the distance %s)", name,
                  formatFloat(farthest, (float)files->farthest));
    } else {
        printNote("wrote %s", name);
    }
    return statusOk();
}

/* Draw and write those of the first surface. */
static Status writeSurfaceAovs(AovFiles *files, const Scene *scene, const char *scenePath, int threads)
{
    CompiledScene *compiled;
    Status status = compileScene(scene, threads, &compiled);
    if (!statusIsOk(&status))
        return status;
    beginProgress("rendering surfaces");
    RenderOptions options = {.threads = threads, .progress = showProgress};
    AovPictures aovs;
    status = renderAovs(compiledFinder(compiled), files->set, scene->image.width, scene->image.height,
                        &options, &aovs);
    endProgress();
    freeCompiledScene(compiled);
    if (!statusIsOk(&status))
        return status;
    files->farthest = aovs.farthest;
    files->objectPixels = aovs.objectPixels;
    aovs.objectPixels = NULL;
    for (Aov aov = 0; aov < AOV_COUNT && statusIsOk(&status); aov++)
        if (aovs.pictures[aov] != NULL)
            status = writeAov(files, scene, aov, aovs.pictures[aov], scenePath, threads);
    freeAovPictures(&aovs);
    return status;
}

static Status writeTerm(const AovFiles *files, const Scene *scene, Aov aov, Term term, const char *scenePath,
                        Engine engine, int threads)
{
    Framebuffer *framebuffer = createFramebuffer(scene->image.width, scene->image.height);
    if (framebuffer == NULL)
        return statusOutOfMemory();
    Status status = statusOk();
    if (sceneHasTerm(scene, term)) {
        Scene variant;
        status = createTermScene(scene, term, &variant);
        if (statusIsOk(&status)) {
            beginProgress(aovName(aov));
            RenderOptions options = {.threads = threads, .progress = showProgress};
            DrawingSeconds seconds;
            status = drawScene(&variant, engine, framebuffer, &options, NULL, &seconds);
            endProgress();
            freeSceneVariant(&variant);
        }
    }
    if (statusIsOk(&status))
        status = writeAov(files, scene, aov, framebuffer, scenePath, threads);
    freeFramebuffer(framebuffer);
    return status;
}

Status writeAovFiles(AovFiles *files, const Scene *scene, const char *scenePath, Engine engine, int threads)
{
    unsigned ofSurface = files->set;
    Term term;
    for (Aov aov = 0; aov < AOV_COUNT; aov++)
        if (aovIsTerm(aov, &term))
            ofSurface &= ~(1u << aov);
    Status status = ofSurface != 0 ? writeSurfaceAovs(files, scene, scenePath, threads) : statusOk();
    for (Aov aov = 0; aov < AOV_COUNT && statusIsOk(&status); aov++)
        if (isWanted(files, aov) && aovIsTerm(aov, &term))
            status = writeTerm(files, scene, aov, term, scenePath, engine, threads);
    return status;
}

/* The objects that are seen, each with its colour. */
static void jsonObjects(JsonWriter *json, const AovFiles *files, const Scene *scene)
{
    jsonKey(json, "objects");
    jsonArray(json);
    for (size_t i = 0; i < scene->objectCount; i++) {
        const Object *object = &scene->objects[i];
        if (files->objectPixels == NULL || files->objectPixels[i] == 0)
            continue;
        Text color = {0};
        textAppendFormat(&color, "#%06x", (unsigned)objectIdColor(i));
        jsonInlineObject(json);
        jsonKeyString(json, "color", textString(&color));
        jsonKeyString(json, "kind", objectShape(object)->name);
        jsonKeyInteger(json, "line", object->line);
        jsonKeyInteger(json, "pixels", (int64_t)files->objectPixels[i]);
        jsonEndObject(json);
        textFree(&color);
    }
    jsonEndArray(json);
}

void jsonAovFiles(JsonWriter *json, const AovFiles *files, const Scene *scene)
{
    jsonKey(json, "aov");
    jsonArray(json);
    for (Aov aov = 0; aov < AOV_COUNT; aov++) {
        if (!isWanted(files, aov))
            continue;
        jsonObject(json);
        jsonKeyString(json, "name", aovName(aov));
        jsonKeyString(json, "file", textString(&files->names[aov]));
        if (aov == AOV_DEPTH)
            jsonKeyNumber(json, "farthest", files->farthest);
        if (aov == AOV_ID)
            jsonObjects(json, files, scene);
        jsonEndObject(json);
    }
    jsonEndArray(json);
}
