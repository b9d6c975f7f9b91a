/* command_why.c - `eclairage why`: the whole story of one pixel.
 *
 * The story is ours. Where POV-Ray has no value for the pixel, because it is missing, fails or cannot say the
 * scene, the story says so and the code is 0 all the same.
 */
#include "base/files.h"
#include "base/text.h"
#include "cli/command.h"
#include "cli/scene_input.h"
#include "cli/terminal.h"
#include "explain/pixel_story.h"
#include "explain/story_writers.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* Read a coordinate: digits, or -1 and the like, which has a message of its own. */
static Status readCoordinate(const char *name, const char *value, int size, const Scene *scene, int *result)
{
    bool isNegative = *value == '-';
    const char *digits = value + isNegative;
    if (*digits == '\0' || strspn(digits, "0123456789") != strlen(digits))
        return statusError(STATUS_USAGE, "%s must be a whole number from 0 to %d, not '%s'", name, size - 1,
                           value);
    size_t length = strlen(digits + strspn(digits, "0"));
    long number = length > 9 ? LONG_MAX : strtol(digits, NULL, 10);
    if (isNegative || number >= size)
        return statusError(
            STATUS_USAGE,
            "%s = %s is outside of the picture, which has %d x %d pixels: %s must be from 0 to "
            "%d",
            name, value, scene->image.width, scene->image.height, name, size - 1);
    *result = (int)number;
    return statusOk();
}

static int writeDrawing(const PixelStory *story, const Arguments *arguments)
{
    Text svg = {0};
    writeStorySvg(story, displayName(arguments->operands[0]), &svg);
    Status status =
        svg.failed ? statusOutOfMemory() : writeWholeFile(arguments->svg, textString(&svg), svg.length);
    textFree(&svg);
    if (!statusIsOk(&status))
        return printError(NULL, &status);
    if (strcmp(arguments->svg, "-") != 0)
        printNote("wrote %s", arguments->svg);
    return 0;
}

static int printStory(const PixelStory *story, const PovrayPixel *povray, const Arguments *arguments)
{
    Text text = {0};
    const char *name = displayName(arguments->operands[0]);
    if (arguments->json) {
        writeStoryJson(story, povray, arguments->operands[0], &text);
        return printData(&text);
    }
    /* Where the drawing has standard output, the words make way. */
    bool isOutputTaken = arguments->svg != NULL && strcmp(arguments->svg, "-") == 0;
    writeStoryText(story, povray, name, isOutputTaken ? colorOnErrors() : colorOnOutput(), &text);
    if (!isOutputTaken)
        return printData(&text);
    printMessages(&text);
    return 0;
}

/* Tell the story of a scene that was read. */
static int tellPixel(const Scene *scene, const Arguments *arguments)
{
    int x = 0, y = 0;
    Status status = readCoordinate("X", arguments->operands[1], scene->image.width, scene, &x);
    if (statusIsOk(&status))
        status = readCoordinate("Y", arguments->operands[2], scene->image.height, scene, &y);
    if (!statusIsOk(&status))
        return printError(NULL, &status);
    status = refuseOverwriting(arguments, scene, arguments->svg, "choose another name with --svg");
    if (statusIsOk(&status) && arguments->svg != NULL)
        status = probeOutput(arguments->svg);
    PixelStory story;
    if (statusIsOk(&status))
        status = createPixelStory(scene, x, y, &story);
    if (!statusIsOk(&status))
        return printError(displayName(arguments->operands[0]), &status);

    /* Look the pixel up in POV-Ray's picture, one of its own for this pixel. */
    PovrayPixel povray = askPovray(&story, chosenThreads(arguments));
    int code = povray.status.code == STATUS_INTERRUPTED ? STATUS_INTERRUPTED : 0;
    if (code == 0) {
        int written = arguments->svg != NULL ? writeDrawing(&story, arguments) : 0;
        code = printStory(&story, &povray, arguments);
        code = written > code ? written : code;
    }
    freePixelStory(&story);
    return code;
}

int runWhy(const Arguments *arguments)
{
    const char *path = arguments->operands[0];
    Scene scene;
    Status status = openSceneAloud(path, arguments, &scene);
    if (!statusIsOk(&status))
        return (int)status.code;
    int code = tellPixel(&scene, arguments);
    freeScene(&scene);
    return code;
}
