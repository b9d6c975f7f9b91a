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
     "make-scene | eclairage render - -o made.png\tfrom standard input\n"
     "eclairage render scene.yaml --aov normal,depth\tscene-normal.png too\n",
     "Draws the scene and writes a PNG: the file given with -o, else SCENE.png beside "
     "the scene. A scene named - is standard input, and then -o is needed. "
     "What no option says is as the scene says.\n"
     "\n"
     "With --json the sizes, times and counts of rays go to standard output, so the "
     "picture then needs a file.\n"
     "\n"
     "--aov writes what else there is to say about each pixel, each to a PNG of its own, "
     "beside the picture: of ball.png, ball-normal.png. Of the surface that the camera's ray meets first:\n"
     "\n"
     "  normal        (N + 1) / 2, N turned to the viewer; linear\n"
     "  depth         distance along the ray, white the farthest; linear, 16 bits\n"
     "  id            a colour for each object; --json names the objects\n"
     "  albedo        the diffuse colour, with its pattern\n"
     "  reflection    what the mirrored ray adds to the picture\n"
     "  transmission  what the refracted ray adds to it\n"
     "  shadow        the share of the lights before it that reach it\n"
     "\n"
     "And the terms, which add up to the picture: ambient, emission, diffuse, specular, "
     "and background with the fog's own colour. Each is what is left when the others' "
     "sources are zero; mirrors, glass, shadows and fog stay.",
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
     "eclairage compare scene.yaml --fail 0.001 --json\tstricter; as JSON\n"
     "eclairage compare scene.yaml --per-term\twhich term disagrees?\n",
     "Draws each scene twice, with this program and with POV-Ray, measures how far the "
     "two pictures lie apart (16 bits, linear) and judges by the limits under `compare` "
     "in the scene, which the options override. DIR, which is eclairage-report where none "
     "is given, gets index.html, a page that needs nothing else, results.json, and for "
     "each scene both pictures, their difference and the .pov.\n"
     "\n"
     "With --per-term each term that a scene has (ambient, emission, diffuse, specular, "
     "background) is drawn by both from a scene of its own and held to the same limits, "
     "so the report says which term disagrees. A scene agrees when its picture and all "
     "its terms do.",
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
    {COMMAND_EXPLAIN, "explain", OPERANDS_SCENE_OR_PICTURES, "SCENE.yaml [PICTURE.png] | A.png B.png", 1, 2,
     "say why pictures differ",
     "eclairage explain scene.yaml\tPOV-Ray's habits, one by one\n"
     "eclairage explain scene.yaml --out why\twith a page, why/index.html\n"
     "eclairage explain scene.yaml mine.png\twhat is wrong with mine?\n"
     "eclairage explain scene.yaml mine.png --out why\tthe same as a page\n"
     "eclairage explain mine.png reference.png\tthe same, without the scene\n",
     "With a picture: finds the mistake, or the two, that turn the right picture into it "
     "(gamma, exposure, mirrored, no shadows, another falloff or highlight, acne, ...), and "
     "says what is left when it is taken into account and what to look at. Mistakes in how "
     "light is computed are found only with the scene. Where nothing fits, it says so.\n"
     "\n"
     "With a scene alone: writes it as POV-Ray is usually written, with its default finish, "
     "fade_distance 1, a left-handed camera and so on, and measures what each of these "
     "habits alone changes in the picture, and what is left when they are taken back one "
     "after another, the largest first. Each comes with the line of POV-Ray to write "
     "instead. In the matched form, which `pov` writes, nothing is left.\n"
     "\n"
     "With --out, in all three ways, DIR gets index.html, a page that needs nothing else, "
     "and results.json, what --json prints; with a scene alone also the pictures, their "
     "differences and the .pov of each. Without it no file is written. "
     "Differences are root mean square errors of the samples: with a scene alone 16-bit "
     "linear ones, else those of the picture. The exit code is 0 when all is told, whatever "
     "was found.",
     runExplain},
    {COMMAND_WHY, "why", OPERANDS_PIXEL, "SCENE.yaml X Y", 3, 3, "tell the whole story of one pixel",
     "eclairage why scene.yaml 250 240\tevery number of its colour\n"
     "eclairage why scene.yaml 250 240 --svg side.svg\tand a drawing of the rays\n"
     "eclairage why scene.yaml 250 240 --json\tas JSON, numbers in full\n",
     "Tells how the pixel gets its colour: the ray, the objects it was tried on, the point "
     "and the normal, each light with every number of the formula and its shadow test, "
     "mirrored and refracted rays, clamping and encoding, and POV-Ray's value for the same "
     "pixel. X counts to the right and Y down, both from 0.\n"
     "\n"
     "--svg draws the rays from the side; with --svg - the drawing has standard output, and "
     "the words go to standard error. The exit code is 0 also where POV-Ray has no value for "
     "the pixel, which the story then says.",
     runWhy},
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
