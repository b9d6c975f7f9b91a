/* command_schema.c - `eclairage schema`: the scene format as a JSON Schema. */
#include "cli/command.h"
#include "cli/terminal.h"
#include "scene/load.h"

int runSchema(const Arguments *arguments)
{
    (void)arguments;
    Text text = {0};
    writeSceneSchema(&text);
    return printData(&text);
}
