/* command.c - the table of commands; see command.h. */
#include "cli/command.h"

#include <stdint.h>
#include <string.h>

/* In the order of the help. */
const Command COMMANDS[] = {
    {COMMAND_RENDER, "render", OPERANDS_SCENES, "SCENE.yaml", 1, 1, "draw a scene",
     "eclairage render scene.yaml\tdraw scene.png\n"
     "eclairage render scene.yaml -o small.png --width 320\tsmaller\n"
     "eclairage render scene.yaml -o - | feh -\tto standard output\n"
     "make-scene | eclairage render - -o made.png\tfrom standard input\n",
     "Draws the scene and writes a PNG: the file given with -o, else SCENE.png beside "
     "the scene. A scene named - is standard input, and then -o is needed. "
     "What no option says is as the scene says.\n"
     "\n"
     "With --json the sizes, times and counts of rays go to standard output, so the "
     "picture then needs a file.",
     runRender},
    {COMMAND_POV, "pov", OPERANDS_SCENES, "SCENE.yaml", 1, 1, "write the equivalent POV-Ray scene",
     "eclairage pov scene.yaml\tshow the POV-Ray scene\n"
     "eclairage pov scene.yaml -o scene.pov\twrite it to a file\n",
     "Writes a scene for POV-Ray 3.7 that draws the same picture, to standard output or "
     "to the file given with -o. Its first comment is the command that renders it. What "
     "POV-Ray cannot draw the same is refused with exit code 7, never approximated.",
     runPov},
    {COMMAND_COMPARE, "compare", OPERANDS_SCENES, "SCENE.yaml...", 1, SIZE_MAX,
     "draw scenes with POV-Ray too, and compare",
     "eclairage compare scene.yaml\teclairage-report/index.html\n"
     "eclairage compare scenes/*.yaml --out report\tone report of all\n"
     "eclairage compare scene.yaml --fail 0.001 --json\tstricter; as JSON\n",
     "Draws each scene twice, with this program and with POV-Ray, measures how far the "
     "two pictures lie apart (16 bits, linear) and judges by the limits under `compare` "
     "in the scene, which the options override. DIR, which is eclairage-report where none "
     "is given, gets index.html, a page that needs nothing else, results.json, and for "
     "each scene both pictures, their difference and the .pov.",
     runCompare},
    {COMMAND_DIFF, "diff", OPERANDS_PICTURES, "A.png B.png", 2, 2, "compare two pictures",
     "eclairage diff mine.png reference.png\tdo they agree?\n"
     "eclairage diff mine.png reference.png -o where.png\tdraw where not\n"
     "eclairage diff mine.png reference.png --hard-fail 0\tmust be equal\n",
     "Measures how far two PNG files lie apart and judges: exit code 0 when they are "
     "within the limits, 1 when they are not. The two need the same width, height, bit "
     "depth and encoding; alpha is ignored. -o writes a picture of the differences; with "
     "-o - that picture has standard output, and the words go to standard error.",
     runDiff},
    {COMMAND_EXPLAIN, "explain", OPERANDS_SCENES, "SCENE.yaml", 1, 1, "say why POV-Ray draws something else",
     "eclairage explain scene.yaml\tPOV-Ray's habits, one by one\n"
     "eclairage explain scene.yaml --width 320\tquicker\n"
     "eclairage explain scene.yaml --out why\twith a page, why/index.html\n",
     "Writes the scene as POV-Ray is usually written: with its default finish, "
     "fade_distance 1, a left-handed camera and so on, and measures what each of these "
     "habits alone changes in the picture, and what is left when they are taken back one "
     "after another, the largest first. Each comes with the line of POV-Ray to write "
     "instead. In the matched form, which `pov` writes, nothing is left.\n"
     "\n"
     "Differences are root mean square errors of 16-bit linear samples. With --out, DIR "
     "gets index.html, a page that needs nothing else, results.json, the pictures, their "
     "differences and the .pov of each; without it no file is written.",
     runExplain},
    {COMMAND_CHECK, "check", OPERANDS_SCENES, "SCENE.yaml...", 1, SIZE_MAX, "find what is wrong with scenes",
     "eclairage check scene.yaml\tevery error and warning\n"
     "eclairage check --quiet *.yaml && echo all fine\tin a script\n",
     "Reads the scenes, draws nothing, and reports every error and warning. Messages go "
     "to standard error; with --json they are data on standard output as well.",
     runCheck},
    {COMMAND_SCHEMA, "schema", OPERANDS_NONE, "", 0, 0, "write the JSON Schema of the scene format",
     "eclairage schema > scene.schema.json\tfor an editor\n",
     "Writes the JSON Schema (draft-07) of the scene format to standard output. A first "
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
