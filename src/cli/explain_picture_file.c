/* explain_picture_file.c - `eclairage explain A.png B.png` and `explain SCENE.yaml PICTURE.png`; see
 * explain_ways.h. */
#include "base/files.h"
#include "cli/explain_ways.h"
#include "cli/report_folder.h"
#include "cli/scene_input.h"
#include "cli/shell_words.h"
#include "cli/terminal.h"
#include "explain/explain_picture.h"
#include "explain/picture_report.h"
#include "image/image.h"

#include <stdlib.h>
#include <string.h>

enum {
    LONGEST_SCENE_TEXT = 1 << 24 /* bytes that are searched for the line to look at */
};

/* ---- The report ---- */

/* Where a report is wanted, make its folder, when all that it needs was read, and see that it is not written
 * over that; scene may be NULL. */
static Status prepareFolder(const Arguments *arguments, const Scene *scene)
{
    if (arguments->folder == NULL)
        return statusOk();
    Status status = protectInputsFromPage(arguments, scene, arguments->folder);
    return statusIsOk(&status) ? makeFolders(arguments->folder) : status;
}

static Status writeReport(const Arguments *arguments, const PictureExplanation *explanation,
                          const Image *mine, const Image *right, const Text *json)
{
    Text command = {0};
    appendShellLine(&command, arguments->argc, arguments->argv);
    bool isDrawn = !isPictureName(arguments->operands[0]);
    PictureReport report = {.explanation = explanation,
                            .mine = mine,
                            .right = right,
                            .name = displayName(arguments->operands[isDrawn]),
                            .rightName = displayName(arguments->operands[!isDrawn]),
                            .isDrawn = isDrawn,
                            .command = textString(&command),
                            .threads = chosenThreads(arguments)};
    Status status = command.failed ? statusOutOfMemory() : writePictureReport(arguments->folder, &report);
    textFree(&command);
    return statusIsOk(&status) ? writeResultsFile(arguments->folder, json) : status;
}

/* Write the report where one is wanted and print what was found; returns the exit code. */
static int tell(const Arguments *arguments, const PictureExplanation *explanation, const Image *mine,
                const Image *right)
{
    Text json = {0}, words = {0};
    writeExplanationsJson(&explanation->causes, &json);
    int written = 0;
    if (arguments->folder != NULL) {
        Status status = writeReport(arguments, explanation, mine, right, &json);
        written = statusIsOk(&status) ? 0 : printError(NULL, &status);
    }
    if (!arguments->json)
        writeExplanationsText(&explanation->causes, textString(&explanation->summary), &words);
    return printResults(arguments, arguments->folder, written, &json, &words);
}

/* ---- What is explained ---- */

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
    if (!hasScene && (arguments->samples != 0 || arguments->model != NOT_GIVEN))
        return statusError(STATUS_USAGE,
                           "--samples and --model change how a scene is drawn, and there is none");
    return statusOk();
}

static int explainTwoPictures(const Arguments *arguments)
{
    const char *const *names = arguments->operands;
    Image mine = {0}, reference = {0};
    Status status = readPicture(names[0], &mine);
    if (statusIsOk(&status))
        status = readPicture(names[1], &reference);
    if (statusIsOk(&status))
        status = prepareFolder(arguments, NULL);
    PictureExplanation explanation;
    if (statusIsOk(&status))
        status =
            explainPictures(&mine, displayName(names[0]), &reference, displayName(names[1]), &explanation);
    int code;
    if (statusIsOk(&status)) {
        code = tell(arguments, &explanation, &mine, &reference);
        freePictureExplanation(&explanation);
    } else {
        code = printError(NULL, &status);
    }
    freeImage(&reference);
    freeImage(&mine);
    return code;
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
    status = openSceneAloud(path, arguments, &scene);
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
        status = prepareFolder(arguments, &scene);
    if (statusIsOk(&status))
        status = explainPictureOfScene(&picture, &scene, &source, chosenThreads(arguments), &explanation);
    int code = (int)status.code;
    if (statusIsOk(&status)) {
        code = tell(arguments, &explanation, &picture, &explanation.right);
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
