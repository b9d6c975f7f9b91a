/* command_pov.c - `eclairage pov`: from a scene to a .pov. */
#include "base/files.h"
#include "cli/command.h"
#include "cli/scene_input.h"
#include "cli/terminal.h"
#include "povray/export.h"

#include <string.h>

/* Append the name the .pov goes by in the command of its first comment. On standard output it has none
 * yet, and gets the one that is most likely. */
static void appendPovName(const char *scene, const char *output, Text *name)
{
    if (strcmp(output, "-") != 0)
        textAppend(name, baseName(output));
    else if (strcmp(scene, "-") != 0)
        appendNameBeside(baseName(scene), ".pov", name);
    else
        textAppend(name, "scene.pov");
}

int runPov(const Arguments *arguments)
{
    const char *path = arguments->operands[0];
    const char *output = arguments->output != NULL ? arguments->output : "-";
    Scene scene;
    Status status = openSceneAloud(path, arguments, &scene);
    if (!statusIsOk(&status))
        return (int)status.code;

    Text pov = {0}, name = {0};
    appendPovName(path, output, &name);
    status = refuseOverwriting(arguments, &scene, output, CHOOSE_OUTPUT);
    if (statusIsOk(&status))
        status = exportPov(&scene, textString(&name), &pov);
    freeScene(&scene);
    textFree(&name);
    if (statusIsOk(&status) && pov.failed)
        status = statusOutOfMemory();
    if (statusIsOk(&status))
        status = writeWholeFile(output, textString(&pov), pov.length);
    textFree(&pov);
    if (!statusIsOk(&status))
        return printError(displayName(path), &status);
    if (strcmp(output, "-") != 0)
        printNote("wrote %s", output);
    return 0;
}
