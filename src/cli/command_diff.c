/* command_diff.c - `eclairage diff`: how far two PNG files lie apart. */
#include "base/json.h"
#include "base/threads.h"
#include "cli/command.h"
#include "cli/scene_input.h"
#include "cli/terminal.h"
#include "compare/difference.h"
#include "compare/metrics.h"
#include "compare/report.h"
#include "image/image.h"

#include <math.h>
#include <string.h>

/* The limits: the options over the defaults of the scene format. */
static Tolerance chosenTolerance(const Arguments *arguments)
{
    Tolerance tolerance = TOLERANCE_DEFAULT;
    overrideTolerance(&arguments->tolerance, &tolerance);
    return tolerance;
}

static Status readPicture(const char *path, Image *image)
{
    Status status = readPng(path, image);
    if (!statusIsOk(&status))
        printError(NULL, &status);
    else if (image->hadAlpha)
        printWarning("%s has an alpha channel, which is ignored", displayName(path));
    return status;
}

/* Write the picture of the differences. */
static int writeDifference(const Image *a, const Image *b, const char *output)
{
    Image difference;
    Status status = differencePicture(a, b, &difference);
    if (statusIsOk(&status)) {
        status = writePng(output, &difference, availableProcessors());
        freeImage(&difference);
    }
    if (!statusIsOk(&status))
        return printError(NULL, &status);
    if (strcmp(output, "-") != 0)
        printNote("wrote %s", output);
    return 0;
}

static int printResult(const Arguments *arguments, const Metrics *metrics, const Verdict *verdict)
{
    Text text = {0};
    if (arguments->json) {
        JsonWriter json = jsonBegin(&text);
        jsonObject(&json);
        jsonMetrics(&json, metrics);
        jsonKeyBool(&json, "pass", verdict->pass);
        jsonReasons(&json, verdict);
        jsonEndObject(&json);
        jsonEnd(&json);
        return printData(&text);
    }

    /* Where the difference picture has standard output, the words make way. */
    bool isOutputTaken = arguments->output != NULL && strcmp(arguments->output, "-") == 0;
    writeMetricsText(metrics, verdict, isOutputTaken ? colorOnErrors() : colorOnOutput(), &text);
    if (!isOutputTaken)
        return printData(&text);
    printMessages(&text);
    return 0;
}

/* Measure, judge and report two pictures that were read. */
static int comparePictures(const Arguments *arguments, const Image *a, const Image *b)
{
    Tolerance tolerance = chosenTolerance(arguments);
    Status status =
        checkComparable(a, displayName(arguments->operands[0]), b, displayName(arguments->operands[1]));
    Metrics metrics;
    if (statusIsOk(&status))
        status = measureImages(a, b, tolerance.fail, availableProcessors(), &metrics);
    if (!statusIsOk(&status))
        return printError(NULL, &status);

    Verdict verdict = judgeMetrics(&metrics, &tolerance);
    int code = verdict.pass ? STATUS_OK : STATUS_DIFFERENT;
    int written = arguments->output != NULL ? writeDifference(a, b, arguments->output) : 0;
    int printed = printResult(arguments, &metrics, &verdict);
    code = written > code ? written : code;
    return printed > code ? printed : code;
}

int runDiff(const Arguments *arguments)
{
    Status status = refuseOverwriting(arguments, NULL, arguments->output, CHOOSE_OUTPUT);
    if (!statusIsOk(&status))
        return printError(NULL, &status);

    /* Read both, so that one run names both when neither can be read. */
    Image a, b;
    Status aStatus = readPicture(arguments->operands[0], &a);
    Status bStatus = readPicture(arguments->operands[1], &b);
    bool bothRead = statusIsOk(&aStatus) && statusIsOk(&bStatus);
    int code = bothRead                      ? comparePictures(arguments, &a, &b)
               : aStatus.code > bStatus.code ? (int)aStatus.code
                                             : (int)bStatus.code;
    if (statusIsOk(&aStatus))
        freeImage(&a);
    if (statusIsOk(&bStatus))
        freeImage(&b);
    return code;
}
