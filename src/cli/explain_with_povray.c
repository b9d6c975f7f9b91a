/* explain_with_povray.c - `eclairage explain SCENE.yaml`; see explain_ways.h. */
#include "cli/explain_ways.h"

#include "base/files.h"
#include "cli/command.h"
#include "cli/drawing.h"
#include "cli/scene_input.h"
#include "cli/shell_words.h"
#include "cli/terminal.h"
#include "explain/habit_report.h"
#include "explain/habits.h"
#include "povray/run.h"

#include <string.h>

/* ---- Files in the folder ---- */

/* The path of a file in the folder, freed by the caller. */
static Text pathInFolder(const char *folder, const char *name, const char *ending)
{
    Text path = {0};
    bool endsInSlash = folder[strlen(folder) - 1] == '/';
    textAppendFormat(&path, "%s%s%s%s", folder, endsInSlash ? "" : "/", name, ending);
    return path;
}

static Status protectFrom(const char *folder, const char *name, const char *scene)
{
    Text path = pathInFolder(folder, name, ".pov");
    bool isScene = isSameFile(textString(&path), scene);
    textFree(&path);
    return isScene ? statusError(STATUS_USAGE, "the POV-Ray scene would overwrite the scene itself: choose "
                                               "another folder with --out, or end its name in .yaml")
                   : statusOk();
}

/* Make the folder, and see that no .pov is written over the scene. */
static Status prepareFolder(const char *folder, const char *scene)
{
    Status status = protectFrom(folder, "native", scene);
    if (statusIsOk(&status))
        status = protectFrom(folder, "matched", scene);
    for (int i = 0; i < POV_HABIT_COUNT && statusIsOk(&status); i++)
        status = protectFrom(folder, povHabitName((PovHabit)(1 << i)), scene);
    return statusIsOk(&status) ? makeFolders(folder) : status;
}

static Status writeFolder(const Arguments *arguments, const HabitStudy *study, const Scene *scene,
                          const Image *ours, const Text *json)
{
    Text command = {0};
    appendShellLine(&command, arguments->argc, arguments->argv);
    HabitReport report = {.study = study,
                          .scene = scene,
                          .ours = ours,
                          .name = displayName(arguments->operands[0]),
                          .command = textString(&command),
                          .threads = chosenThreads(arguments)};
    Status status = command.failed ? statusOutOfMemory() : writeHabitReport(arguments->folder, &report);
    textFree(&command);
    if (!statusIsOk(&status))
        return status;
    Text path = pathInFolder(arguments->folder, "results.json", "");
    status = path.failed || json->failed ? statusOutOfMemory()
                                         : writeWholeFile(path.data, textString(json), json->length);
    textFree(&path);
    return status;
}

/* ---- A scene and POV-Ray's habits ---- */

static Status drawOurs(const Arguments *arguments, const Scene *scene, Image *ours)
{
    Framebuffer *framebuffer = createFramebuffer(scene->image.width, scene->image.height);
    if (framebuffer == NULL)
        return statusError(STATUS_IO, "out of memory for a picture of %d x %d pixels", scene->image.width,
                           scene->image.height);
    RenderOptions options = {.threads = chosenThreads(arguments)};
    DrawingSeconds seconds;
    Status status = drawScene(scene, chosenEngine(arguments), framebuffer, &options, NULL, &seconds);
    if (statusIsOk(&status)) {
        Text messages = {0};
        warnOfNonFinitePixels(framebuffer, arguments->operands[0], &messages);
        printMessages(&messages);
        status = imageFromFramebuffer(framebuffer, scene->image.bitDepth, scene->image.encoding,
                                      options.threads, ours);
    }
    freeFramebuffer(framebuffer);
    return status;
}

/* Say what was found, in words or as JSON; returns the exit code. */
static int tellHabits(const Arguments *arguments, const HabitStudy *study, const Scene *scene,
                      const Image *ours)
{
    const char *path = arguments->operands[0];
    Explanations explanations;
    Status status = explainHabits(study, scene, &explanations);
    if (!statusIsOk(&status))
        return printError(NULL, &status);
    Text json = {0}, words = {0};
    writeExplanationsJson(&explanations, &json);
    freeExplanations(&explanations);

    int written = 0;
    if (arguments->folder != NULL) {
        status = writeFolder(arguments, study, scene, ours, &json);
        written = statusIsOk(&status) ? 0 : printError(NULL, &status);
    }
    if (!arguments->json)
        writeHabitsText(study, scene, displayName(path), colorOnOutput(), &words);
    int printed = printData(arguments->json ? &json : &words);
    textFree(&json);
    textFree(&words);
    if (written == 0 && arguments->folder != NULL) {
        Text page = pathInFolder(arguments->folder, "index.html", "");
        printNote("the report is %s", textString(&page));
        textFree(&page);
    }
    return written > printed ? written : printed;
}

/* Everything for a scene that was loaded. */
static int explainScene(const Arguments *arguments, Scene *scene)
{
    /* Measure where matched pictures agree to 1/65535: in 16 bits, linear. */
    scene->image.bitDepth = 16;
    scene->image.encoding = ENCODING_LINEAR;
    const char *path = arguments->operands[0];
    Status status = arguments->folder != NULL ? prepareFolder(arguments->folder, path) : statusOk();
    if (!statusIsOk(&status))
        return printError(NULL, &status);

    Image ours = {0};
    HabitStudySettings settings = {.threads = chosenThreads(arguments),
                                   .timeoutSeconds = POVRAY_TIMEOUT,
                                   .keepPictures = arguments->folder != NULL,
                                   .progress = showProgress};
    HabitStudy study;
    double start = secondsNow();
    beginProgress("explaining");
    status = drawOurs(arguments, scene, &ours);
    if (statusIsOk(&status))
        status = studyHabits(scene, &ours, &settings, &study);
    endProgress();
    int code;
    if (statusIsOk(&status)) {
        code = tellHabits(arguments, &study, scene, &ours);
        Text seconds = {0};
        textAppendFixed(&seconds, secondsSince(start), 1);
        printNote("%d pictures in %s s", study.pictureCount + 1, textString(&seconds));
        textFree(&seconds);
        freeHabitStudy(&study);
    } else {
        Text messages = {0};
        appendSceneError(&messages, path, &status);
        printMessages(&messages);
        code = (int)status.code;
    }
    freeImage(&ours);
    return code;
}

int explainWithPovray(const Arguments *arguments)
{
    Status status = findPovray();
    if (!statusIsOk(&status))
        return printError(NULL, &status);
    Scene scene;
    status = openSceneAloud(arguments->operands[0], arguments, &scene);
    if (!statusIsOk(&status))
        return (int)status.code;
    int code = explainScene(arguments, &scene);
    freeScene(&scene);
    return code;
}
