/* report_fixture.c - write reports for the browser to be tested with, without rendering anything.
 *
 *   report_fixture FOLDER    writes FOLDER/mixed (every outcome, every size, hostile names),
 *                            FOLDER/agree (two scenes that agree) and FOLDER/many (24 scenes)
 *
 * The pictures are shaded spheres; the second differs from the first in a known way. Measuring, judging
 * and writing are the program's own.
 */
#include "base/files.h"
#include "base/text.h"
#include "compare/difference.h"
#include "compare/metrics.h"
#include "compare/report.h"
#include "image/image.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum Change {
    CHANGE_NOTHING,
    CHANGE_LAST_BIT,  /* one step in some samples, as two good renderers differ */
    CHANGE_HIGHLIGHT, /* another exponent */
    CHANGE_SHIFT      /* half a pixel to the right */
} Change;

typedef struct FixtureScene {
    const char *name;
    int width, height;
    Change change;
    StatusCode failure; /* STATUS_OK: compared */
    const char *message;
} FixtureScene;

/* A reproducible number in 0..1 for a pixel. */
static double hash(unsigned x, unsigned y, unsigned seed)
{
    unsigned h = x * 374761393u + y * 668265263u + seed * 2246822519u;
    h = (h ^ (h >> 13)) * 1274126177u;
    return (double)((h ^ (h >> 16)) & 0xFFFFFF) / 16777216.0;
}

/* Shade three spheres over a floor: enough like the course's pictures to look at. */
static void shade(double u, double v, unsigned seed, double exponent, double color[3])
{
    color[0] = color[1] = color[2] = 0;
    if (v < -0.55) {
        double fall = 1.0 / (1.0 + 4 * u * u + 3 * (v + 0.55) * (v + 0.55));
        bool odd = ((int)floor(u / (0.12 - v) * 3) + (int)floor(0.6 / (0.1 - v) * 6)) & 1;
        for (int c = 0; c < 3; c++)
            color[c] = fall * (odd ? 0.3 : 0.12);
    }
    for (unsigned i = 0; i < 3; i++) {
        double x = (hash(i, 1, seed) - 0.5) * 1.4, y = (hash(i, 2, seed) - 0.5) * 0.7;
        double r = 0.2 + 0.3 * hash(i, 3, seed);
        double dx = (u - x) / r, dy = (v - y) / r, dd = dx * dx + dy * dy;
        if (dd > 1)
            continue;
        double nz = sqrt(1 - dd), lambert = fmax(0, 0.5 * nz - 0.5 * dx + 0.707 * dy);
        double highlight = pow(fmax(0, 2 * nz * lambert - 0.5), exponent) * 0.6;
        for (unsigned c = 0; c < 3; c++)
            color[c] = (0.1 + 0.9 * hash(i, 4 + c, seed)) * lambert + highlight;
    }
}

static Status makePicture(const FixtureScene *scene, unsigned seed, bool second, Image *image)
{
    Status status = createImage(scene->width, scene->height, 16, ENCODING_LINEAR, image);
    if (!statusIsOk(&status))
        return status;
    double shift = second && scene->change == CHANGE_SHIFT ? 0.5 : 0.0;
    double exponent = second && scene->change == CHANGE_HIGHLIGHT ? 34.0 : 30.0;
    double scale = 2.0 / (scene->width < scene->height ? scene->width : scene->height);
    for (int y = 0; y < scene->height; y++) {
        for (int x = 0; x < scene->width; x++) {
            double color[3];
            shade((x + 0.5 - shift - scene->width / 2.0) * scale, (scene->height / 2.0 - y - 0.5) * scale,
                  seed, exponent, color);
            for (int c = 0; c < 3; c++) {
                double value = floor(fmin(1, color[c]) * 65535 + 0.5);
                if (second && scene->change == CHANGE_LAST_BIT && value > 0 && value < 65535 &&
                    hash((unsigned)x, (unsigned)y, (unsigned)c) < 0.002)
                    value += 1;
                image->samples[3 * ((size_t)y * (size_t)scene->width + (size_t)x) + (size_t)c] =
                    (uint16_t)value;
            }
        }
    }
    return statusOk();
}

/* A copy of a text that lives until the program ends, which is when the table of them goes. */
static const char *keep(const Text *text)
{
    static char *kept[512];
    static size_t count;
    if (count == sizeof kept / sizeof *kept)
        return "";
    char *copy = malloc(text->length + 1);
    if (copy == NULL)
        return "";
    memcpy(copy, textString(text), text->length + 1);
    kept[count++] = copy;
    return copy;
}

static const char *makeName(const char *before, unsigned number, const char *after)
{
    Text text = {0};
    textAppendFormat(&text, "%s%02u%s", before, number, after);
    const char *name = keep(&text);
    textFree(&text);
    return name;
}

static Status writeImageIn(const char *folder, const char *name, const Image *image)
{
    Text path = {0};
    textAppendFormat(&path, "%s/%s", folder, name);
    Status status = writePng(textString(&path), image, 1);
    textFree(&path);
    return status;
}

/* Where the highlights differ: two terms, of which the diffuse one agrees. */
static Status addTerms(const Image *ours, const char *oursFile, SceneResult *result)
{
    static TermResult terms[2];
    terms[0] = (TermResult){.term = "diffuse",
                            .oursFile = oursFile,
                            .povrayFile = oursFile,
                            .differenceFile = result->differenceFile,
                            .povFile = result->povFile};
    Status status = measureImages(ours, ours, result->tolerance.fail, 2, &terms[0].metrics);
    terms[0].verdict = judgeMetrics(&terms[0].metrics, &result->tolerance);
    terms[1] = terms[0];
    terms[1].term = "specular";
    terms[1].povrayFile = result->povrayFile;
    terms[1].metrics = result->metrics;
    terms[1].verdict = result->verdict;
    result->terms = terms;
    result->termCount = 2;
    result->perTerm = true;
    return status;
}

/* Make, measure and judge one scene, and write its pictures. */
static Status makeResult(const char *folder, const FixtureScene *scene, unsigned number, SceneResult *result)
{
    Text command = {0};
    textAppendFormat(&command, "eclairage compare '%s' --out report", scene->name);
    *result = (SceneResult){.scene = scene->name,
                            .status = statusOk(),
                            .tolerance = {3.1e-5, 0, 1, NAN, 0.9999, NAN},
                            .renderSeconds = 0.0213,
                            .povraySeconds = 0.742,
                            .compareSeconds = 0.0391,
                            .command = keep(&command)};
    textFree(&command);
    if (scene->failure != STATUS_OK) {
        result->status = statusError(scene->failure, "%s", scene->message);
        return statusOk();
    }
    result->oursFile = makeName("", number, "-ours.png");
    result->povrayFile = makeName("", number, "-povray & co.png");
    result->differenceFile = makeName("", number, "-difference.png");
    result->povFile = makeName("", number, ".pov");
    Image a, b, difference;
    Status status = makePicture(scene, number + 7, false, &a);
    if (statusIsOk(&status))
        status = makePicture(scene, number + 7, true, &b);
    if (statusIsOk(&status))
        status = measureImages(&a, &b, result->tolerance.fail, 2, &result->metrics);
    if (statusIsOk(&status))
        status = differencePicture(&a, &b, &difference);
    if (!statusIsOk(&status))
        return status;
    if (isnan(result->metrics.ssim))
        result->tolerance.ssim = NAN;
    result->verdict = judgeMetrics(&result->metrics, &result->tolerance);
    if (scene->change == CHANGE_HIGHLIGHT && number == 2)
        status = addTerms(&a, result->oursFile, result);
    if (statusIsOk(&status))
        status = writeImageIn(folder, result->oursFile, &a);
    if (statusIsOk(&status))
        status = writeImageIn(folder, result->povrayFile, &b);
    if (statusIsOk(&status))
        status = writeImageIn(folder, result->differenceFile, &difference);
    freeImage(&a);
    freeImage(&b);
    freeImage(&difference);
    return status;
}

enum {
    MAX_SCENES = 32
};

static Status makeReport(const char *folder, const FixtureScene *scenes, size_t count, const char *command)
{
    static SceneResult results[MAX_SCENES];
    Status status = makeFolders(folder);
    for (size_t i = 0; i < count && statusIsOk(&status); i++)
        status = makeResult(folder, &scenes[i], (unsigned)i + 1, &results[i]);
    if (statusIsOk(&status))
        status = writeReport(folder, results, count, command);
    Text json = {0}, path = {0}, words = {0};
    writeResultsJson(results, count, &json);
    writeResultsText(results, count, false, &words);
    textAppendFormat(&path, "%s/results.json", folder);
    if (statusIsOk(&status))
        status = writeWholeFile(textString(&path), json.data, json.length);
    fputs(textString(&words), stdout);
    textFree(&json);
    textFree(&path);
    textFree(&words);
    return status;
}

static const FixtureScene mixed[] = {
    {"scenes/course/03-lambert.yaml", 640, 480, CHANGE_LAST_BIT, STATUS_OK, NULL},
    {"scenes/course/03-phong.yaml", 640, 480, CHANGE_HIGHLIGHT, STATUS_OK, NULL},
    {"scenes/course/04-shifted.yaml", 640, 480, CHANGE_SHIFT, STATUS_OK, NULL},
    {"scenes/<script>window.hacked=1</script>\"'><img src=x "
     "onerror=\"window.hacked=1\">&amp;{{run-command}}.yaml",
     320, 240, CHANGE_LAST_BIT, STATUS_OK, NULL},
    {"scenes/one-pixel.yaml", 1, 1, CHANGE_NOTHING, STATUS_OK, NULL},
    {"scenes/eight.yaml", 8, 8, CHANGE_SHIFT, STATUS_OK, NULL},
    {"scenes/gallery/panorama.yaml", 4000, 600, CHANGE_LAST_BIT, STATUS_OK, NULL},
    {"scenes/gallery/tall-with-quite-a-long-name-that-has-to-be-broken-somewhere-on-a-telephone.yaml", 150,
     900, CHANGE_LAST_BIT, STATUS_OK, NULL},
    {"scenes/bad/typo.yaml", 0, 0, CHANGE_NOTHING, STATUS_SCENE,
     "scenes/bad/typo.yaml:7:5: unknown key 'postion', did you mean 'position'? "
     "</pre><script>window.hacked=1</script>"},
    {"scenes/bad/missing.yaml", 0, 0, CHANGE_NOTHING, STATUS_IO,
     "scenes/bad/missing.yaml cannot be read: there is no such file"},
    {"scenes/gallery/slow \xFF\x1B[31m\xE2\x80\xAE.yaml", 0, 0, CHANGE_NOTHING, STATUS_POVRAY,
     "POV-Ray is not installed; install it with: apt-get install povray"},
    {"scenes/gallery/bias.yaml", 0, 0, CHANGE_NOTHING, STATUS_INEXPRESSIBLE,
     "render.shadow_bias cannot be expressed in POV-Ray; leave it out to compare"},
};

static const FixtureScene agreeing[] = {
    {"scenes/course/03-simple.yaml", 640, 480, CHANGE_NOTHING, STATUS_OK, NULL},
    {"scenes/course/03-lambert.yaml", 640, 480, CHANGE_LAST_BIT, STATUS_OK, NULL},
};

int main(int count, char **arguments)
{
    if (count != 2) {
        fprintf(stderr, "usage: report_fixture FOLDER\n");
        return 2;
    }
    FixtureScene many[24];
    for (unsigned i = 0; i < 24; i++)
        many[i] = (FixtureScene){
            makeName("scenes/course/", i + 1, i % 3 == 0 ? "-lambert.yaml" : "-phong-lights.yaml"),
            640,
            480,
            i == 13 ? CHANGE_HIGHLIGHT : CHANGE_LAST_BIT,
            STATUS_OK,
            NULL};

    struct {
        const char *name;
        const FixtureScene *scenes;
        size_t count;
    } reports[] = {{"mixed", mixed, sizeof mixed / sizeof *mixed},
                   {"agree", agreeing, sizeof agreeing / sizeof *agreeing},
                   {"many", many, sizeof many / sizeof *many}};
    for (size_t i = 0; i < sizeof reports / sizeof *reports; i++) {
        Text folder = {0};
        textAppendFormat(&folder, "%s/%s", arguments[1], reports[i].name);
        Status status = makeReport(textString(&folder), reports[i].scenes, reports[i].count,
                                   "eclairage compare scenes/course/*.yaml --out report");
        textFree(&folder);
        if (!statusIsOk(&status)) {
            fprintf(stderr, "report_fixture: %s\n", status.message);
            return (int)status.code;
        }
    }
    return 0;
}
