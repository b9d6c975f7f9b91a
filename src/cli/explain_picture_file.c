/* explain_picture_file.c - `eclairage explain A.png B.png` and `explain SCENE.yaml PICTURE.png`; see
 * explain_ways.h. */
#include "base/files.h"
#include "cli/explain_ways.h"
#include "cli/scene_input.h"
#include "cli/terminal.h"
#include "explain/explain_picture.h"
#include "image/image.h"

#include <stdlib.h>
#include <string.h>

enum {
    LONGEST_SCENE_TEXT = 1 << 24 /* bytes that are searched for the line to look at */
};

/* Print what was found; returns the exit code. */
static int tell(const Arguments *arguments, const PictureExplanation *explanation)
{
    Text text = {0};
    if (arguments->json)
        writeExplanationsJson(&explanation->causes, &text);
    else
        writeExplanationsText(&explanation->causes, textString(&explanation->summary), &text);
    return printData(&text);
}

static Status readPicture(const char *path, Image *image)
{
    Status status = readPng(path, image);
    if (statusIsOk(&status) && image->hadAlpha)
        printWarning("%s has an alpha channel, which is ignored", displayName(path));
    return status;
}

/* What makes no sense without POV-Ray, or with a picture that has its size. */
static Status refuseOptions(const Arguments *arguments, bool hasScene)
{
    if (arguments->width != 0 || arguments->height != 0)
        return statusError(STATUS_USAGE, "with a picture, 'explain' takes no --width and no --height: the "
                                         "picture has a size");
    if (arguments->folder != NULL)
        return statusError(STATUS_USAGE,
                           "'explain' writes a report only of a scene alone: leave out --out, or "
                           "the picture");
    if (!hasScene && (arguments->samples != 0 || arguments->model != NOT_GIVEN))
        return statusError(STATUS_USAGE,
                           "--samples and --model change how a scene is drawn, and there is none");
    return statusOk();
}

static int explainTwoPictures(const Arguments *arguments)
{
    const char *const *names = arguments->operands;
    Image mine, reference;
    Status status = readPicture(names[0], &mine);
    if (!statusIsOk(&status))
        return printError(NULL, &status);
    status = readPicture(names[1], &reference);
    if (statusIsOk(&status)) {
        PictureExplanation explanation;
        status =
            explainPictures(&mine, displayName(names[0]), &reference, displayName(names[1]), &explanation);
        freeImage(&reference);
        freeImage(&mine);
        if (statusIsOk(&status)) {
            int code = tell(arguments, &explanation);
            freePictureExplanation(&explanation);
            return code;
        }
        return printError(NULL, &status);
    }
    freeImage(&mine);
    return printError(NULL, &status);
}

/* Give the scene the picture's size; STATUS_MISMATCH when it has another aspect, by more than rounding. */
static Status takeSize(const Image *picture, const char *pictureName, const char *sceneName, Scene *scene)
{
    double height = (double)picture->width * scene->image.height / scene->image.width;
    double off = height - picture->height;
    if (off < -1 || off > 1)
        return statusError(
            STATUS_MISMATCH,
            "%s has %d x %d pixels, which is not the aspect of %s, %d x %d: a picture of that aspect "
            "can be explained",
            pictureName, picture->width, picture->height, sceneName, scene->image.width, scene->image.height);
    scene->image.width = picture->width;
    scene->image.height = picture->height;
    return statusOk();
}

static int explainWithScene(const Arguments *arguments)
{
    const char *path = arguments->operands[0], *pictureName = displayName(arguments->operands[1]);
    Image picture;
    Status status = readPicture(arguments->operands[1], &picture);
    if (!statusIsOk(&status))
        return printError(NULL, &status);
    Scene scene;
    Text messages = {0};
    status = openScene(path, arguments, &scene, &messages);
    printMessages(&messages);
    if (!statusIsOk(&status)) {
        freeImage(&picture);
        return (int)status.code;
    }

    /* The scene's text names the lines to look at; from standard input it is gone. */
    char *text = NULL;
    size_t length;
    if (strcmp(path, "-") != 0) {
        Status unread = readWholeFile(path, LONGEST_SCENE_TEXT, &text, &length);
        text = statusIsOk(&unread) ? text : NULL;
    }
    SceneSource source = {.name = displayName(path), .text = text};
    PictureExplanation explanation;
    status = takeSize(&picture, pictureName, displayName(path), &scene);
    if (statusIsOk(&status))
        status = explainPictureOfScene(&picture, &scene, &source, chosenThreads(arguments), &explanation);
    int code = (int)status.code;
    if (statusIsOk(&status)) {
        code = tell(arguments, &explanation);
        freePictureExplanation(&explanation);
    } else {
        printError(NULL, &status);
    }
    free(text);
    freeScene(&scene);
    freeImage(&picture);
    return code;
}

int explainPictureFile(const Arguments *arguments)
{
    bool firstIsPicture = isPictureName(arguments->operands[0]);
    Status status = refuseOptions(arguments, !firstIsPicture);
    if (statusIsOk(&status) && firstIsPicture && !isPictureName(arguments->operands[1]) &&
        strcmp(arguments->operands[1], "-") != 0)
        status = statusError(STATUS_USAGE, "the scene comes first: eclairage explain %s %s",
                             arguments->operands[1], arguments->operands[0]);
    if (!statusIsOk(&status))
        return printError(NULL, &status);
    return firstIsPicture ? explainTwoPictures(arguments) : explainWithScene(arguments);
}
