/* explain_with_povray.c - `eclairage explain SCENE.yaml`; see explain_ways.h. */
#include "cli/explain_ways.h"

#include "base/files.h"
#include "cli/command.h"
#include "cli/drawing.h"
#include "cli/report_folder.h"
#include "cli/scene_input.h"
#include "cli/shell_words.h"
#include "cli/terminal.h"
#include "explain/habit_report.h"
#include "explain/habits.h"
#include "povray/run.h"

/* ---- Files in the folder ---- */

/* Make the folder, and see that nothing is written over what is read. */
static Status prepareFolder(const Arguments *arguments, const Scene *scene)
{
    Status status = protectInputsFromPage(arguments, scene, arguments->folder);
    Text name = {0};
    for (int i = 0; statusIsOk(&status) && appendHabitFileName(i, &name); i++) {
        status = name.failed ? statusOutOfMemory()
                             : protectInputs(arguments, scene, arguments->folder, textString(&name));
        textFree(&name);
    }
    return statusIsOk(&status) ? makeFolders(arguments->folder) : status;
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
    return statusIsOk(&status) ? writeResultsFile(arguments->folder, json) : status;
}

/* ---- A scene and POV-Ray's habits ---- */

/* Say what was found, in words or as JSON; returns the exit code. */
static int tellHabits(const Arguments *arguments, const HabitStudy *study, const Scene *scene,
                      const Image *ours)
{
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
        writeHabitsText(study, scene, displayName(arguments->operands[0]), colorOnOutput(), &words);
    return printResults(arguments, arguments->folder, written, &json, &words);
}

/* Everything for a scene that was loaded. */
static int explainScene(const Arguments *arguments, Scene *scene)
{
    /* Measure where matched pictures agree to 1/65535: in 16 bits, linear. */
    scene->image.bitDepth = 16;
    scene->image.encoding = ENCODING_LINEAR;
    const char *path = arguments->operands[0];
    Status status = arguments->folder != NULL ? prepareFolder(arguments, scene) : statusOk();
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
    DrawingSeconds unused;
    Text messages = {0};
    status = drawImage(scene, path, chosenEngine(arguments), settings.threads, &ours, &unused, &messages);
    printMessages(&messages);
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
