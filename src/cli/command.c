/* command.c - the table of commands; see command.h. */
#include "cli/command.h"

#include <stdint.h>
#include <string.h>

/* In the order of the help. */
const Command COMMANDS[] = {
    {COMMAND_RENDER, "render", OPERANDS_SCENES, "SCENE.yaml", 1, 1, "draw a scene",
     "eclairage render scene.yaml\tdraw scene.png beside the scene\n"
     "eclairage render scene.yaml -o picture.png --width 320\tsmaller, somewhere else\n"
     "eclairage render scene.yaml -o - | feh -\tthe PNG on standard output\n"
     "generate | eclairage render - -o picture.png\ta scene from standard input\n",
     "Draws the scene and writes a PNG: the file given with -o, else SCENE.png beside\n"
     "the scene. A scene named - is standard input, and then -o is needed.\n"
     "\n"
     "With --json the sizes, times and counts of rays go to standard output, so the\n"
     "picture then needs a file.",
     runRender},
    {COMMAND_POV, "pov", OPERANDS_SCENES, "SCENE.yaml", 1, 1, "write the equivalent POV-Ray scene",
     "eclairage pov scene.yaml\tshow the POV-Ray scene\n"
     "eclairage pov scene.yaml -o scene.pov\twrite it to a file\n",
     "Writes a scene for POV-Ray 3.7 that draws the same picture, to standard output or\n"
     "to the file given with -o. Its first comment is the command that renders it. What\n"
     "POV-Ray cannot draw the same is refused with exit code 7, never approximated.",
     runPov},
    {COMMAND_COMPARE, "compare", OPERANDS_SCENES, "SCENE.yaml...", 1, SIZE_MAX,
     "draw scenes with POV-Ray too, and compare",
     "eclairage compare scene.yaml\tone scene; the report is eclairage-report/index.html\n"
     "eclairage compare scenes/*.yaml --out report\tmany scenes, one report\n"
     "eclairage compare scene.yaml --fail 0.001 --json\ta stricter limit, the result as JSON\n",
     "Draws each scene twice, with this program and with POV-Ray, measures how far the\n"
     "two pictures lie apart (16 bits, linear) and judges by the limits under `compare`\n"
     "in the scene, which the options override. DIR gets index.html, a page that needs\n"
     "nothing else, results.json, and for each scene both pictures, their difference and\n"
     "the .pov.",
     runCompare},
    {COMMAND_DIFF, "diff", OPERANDS_PICTURES, "A.png B.png", 2, 2, "compare two pictures",
     "eclairage diff mine.png reference.png\tare they the same, and if not, where\n"
     "eclairage diff mine.png reference.png -o difference.png\tsee where\n"
     "eclairage diff mine.png reference.png --fail 0 --fail-percent 0\tallow no difference\n",
     "Measures how far two PNG files lie apart and judges: exit code 0 when they are\n"
     "within the limits, 1 when they are not. The two need the same width, height, bit\n"
     "depth and encoding; alpha is ignored. -o writes a picture of the differences; with\n"
     "-o - that picture has standard output, and the words go to standard error.",
     runDiff},
    {COMMAND_CHECK, "check", OPERANDS_SCENES, "SCENE.yaml...", 1, SIZE_MAX, "find what is wrong with scenes",
     "eclairage check scene.yaml\tevery error and warning, with its place\n"
     "eclairage check --quiet *.yaml && echo all fine\tmany scenes, in a script\n",
     "Reads the scenes, draws nothing, and reports every error and warning. Messages go\n"
     "to standard error; with --json they are data on standard output as well.",
     runCheck},
    {COMMAND_SCHEMA, "schema", OPERANDS_NONE, "", 0, 0, "write the JSON Schema of the scene format",
     "eclairage schema > scene.schema.json\tfor an editor that completes and checks\n",
     "Writes the JSON Schema (draft-07) of the scene format to standard output. A first\n"
     "line such as\n"
     "\n"
     "  # yaml-language-server: $schema=scene.schema.json\n"
     "\n"
     "in a scene lets an editor complete and check it.",
     runSchema},
};
const size_t COMMAND_COUNT = sizeof COMMANDS / sizeof COMMANDS[0];

const Command *findCommand(const char *name)
{
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(COMMANDS[i].name, name) == 0)
            return &COMMANDS[i];
    return NULL;
}
