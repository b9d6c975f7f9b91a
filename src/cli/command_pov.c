/* command_pov.c - `eclairage pov`: from a scene to a .pov. */
#include "base/files.h"
#include "cli/command.h"
#include "cli/scene_input.h"
#include "cli/terminal.h"
#include "povray/export.h"

#include <string.h>

/* The name the .pov goes by in the command of its first comment. */
static const char *povName(const char *output)
{
    if (strcmp(output, "-") == 0)
        return "scene.pov";
    const char *slash = strrchr(output, '/');
    return slash != NULL ? slash + 1 : output;
}

int runPov(const Arguments *arguments)
{
    const char *path = arguments->operands[0];
    const char *output = arguments->output != NULL ? arguments->output : "-";
    Status status = refuseOverwriting(output, path);
    if (!statusIsOk(&status))
        return printError(NULL, &status);

    Scene scene;
    Text messages = {0};
    status = openScene(path, arguments, &scene, &messages);
    printMessages(&messages);
    if (!statusIsOk(&status))
        return (int)status.code;

    Text pov = {0};
    status = exportPov(&scene, povName(output), &pov);
    freeScene(&scene);
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
