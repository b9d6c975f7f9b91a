/* results.c - the result of a run as JSON and as lines for the terminal; see report.h. */
#include "compare/html.h"
#include "compare/report.h"
#include "compare/words.h"

#include <math.h>
#include <string.h>

void jsonMetrics(JsonWriter *json, const Metrics *metrics)
{
    jsonKeyInteger(json, "width", metrics->width);
    jsonKeyInteger(json, "height", metrics->height);
    jsonKeyInteger(json, "pixels", (int64_t)metrics->pixels);
    jsonKeyInteger(json, "identical_pixels", (int64_t)metrics->identicalPixels);
    jsonKeyInteger(json, "differing_pixels", (int64_t)metrics->differingPixels);
    jsonKeyNumber(json, "differing_percent", metrics->differingPercent);
    jsonKeyNumber(json, "max_difference", metrics->maxDifference);
    jsonKey(json, "worst_pixel");
    jsonInlineObject(json);
    jsonKeyInteger(json, "x", metrics->worst.x);
    jsonKeyInteger(json, "y", metrics->worst.y);
    jsonKeyInteger(json, "channel", metrics->worst.channel);
    jsonKeyNumber(json, "a", metrics->worst.a);
    jsonKeyNumber(json, "b", metrics->worst.b);
    jsonEndObject(json);
    jsonKeyNumber(json, "mae", metrics->mae);
    jsonKeyNumber(json, "rmse", metrics->rmse);
    jsonKeyNumber(json, "psnr", metrics->psnr);
    jsonKeyNumber(json, "ssim", metrics->ssim);
    jsonKeyNumber(json, "flip", metrics->flip);
}

void jsonReasons(JsonWriter *json, const Verdict *verdict)
{
    jsonKey(json, "reasons");
    jsonArray(json);
    for (int i = 0; i < verdict->reasonCount && i < MAX_REASONS; i++)
        jsonString(json, verdict->reasons[i]);
    jsonEndArray(json);
}

/* Seconds, to the microsecond. */
static void jsonSeconds(JsonWriter *json, const char *key, double seconds)
{
    jsonKeyNumber(json, key, round(seconds * 1e6) / 1e6);
}

static void jsonFile(JsonWriter *json, const char *key, const char *name)
{
    jsonKey(json, key);
    if (name != NULL)
        jsonString(json, name);
    else
        jsonNull(json);
}

static void jsonFiles(JsonWriter *json, const char *ours, const char *povray, const char *difference,
                      const char *pov)
{
    jsonKey(json, "files");
    jsonObject(json);
    jsonFile(json, "ours", ours);
    jsonFile(json, "povray", povray);
    jsonFile(json, "difference", difference);
    jsonFile(json, "pov", pov);
    jsonEndObject(json);
}

static void jsonTerms(JsonWriter *json, const SceneResult *result)
{
    jsonKey(json, "terms");
    jsonArray(json);
    for (size_t i = 0; i < result->termCount; i++) {
        const TermResult *term = &result->terms[i];
        jsonObject(json);
        jsonKeyString(json, "term", term->term);
        jsonKeyBool(json, "pass", term->verdict.pass);
        jsonMetrics(json, &term->metrics);
        jsonReasons(json, &term->verdict);
        jsonFiles(json, term->oursFile, term->povrayFile, term->differenceFile, term->povFile);
        jsonEndObject(json);
    }
    jsonEndArray(json);
}

static void jsonScene(JsonWriter *json, const SceneResult *result)
{
    jsonObject(json);
    jsonKeyString(json, "scene", result->scene);
    jsonKeyBool(json, "pass", findSceneOutcome(result) == SCENE_AGREES);
    if (findSceneOutcome(result) == SCENE_FAILED) {
        jsonKey(json, "error");
        jsonObject(json);
        jsonKeyInteger(json, "code", result->status.code);
        jsonKeyString(json, "message", result->status.message);
        jsonEndObject(json);
        jsonEndObject(json);
        return;
    }
    jsonMetrics(json, &result->metrics);
    jsonReasons(json, &result->verdict);
    jsonKey(json, "seconds");
    jsonInlineObject(json);
    jsonSeconds(json, "render", result->renderSeconds);
    jsonSeconds(json, "povray", result->povraySeconds);
    jsonSeconds(json, "compare", result->compareSeconds);
    jsonEndObject(json);
    jsonFiles(json, result->oursFile, result->povrayFile, result->differenceFile, result->povFile);
    if (result->perTerm)
        jsonTerms(json, result);
    jsonEndObject(json);
}

void writeResultsJson(const SceneResult *results, size_t count, Text *text)
{
    JsonWriter json = jsonBegin(text);
    jsonObject(&json);
    jsonKeyBool(&json, "pass", countScenes(results, count, SCENE_AGREES) == count);
    jsonKey(&json, "scenes");
    jsonArray(&json);
    for (size_t i = 0; i < count; i++)
        jsonScene(&json, &results[i]);
    jsonEndArray(&json);
    jsonEndObject(&json);
    jsonEnd(&json);
}

/* A word padded to 8 columns, in the outcome's colour: green, red, yellow. */
static void appendOutcome(Text *text, SceneOutcome outcome, bool color)
{
    static const char *const colors[] = {"\033[32m", "\033[31m", "\033[33m"};
    const char *word = sceneOutcomeWord(outcome);
    if (color)
        textAppend(text, colors[outcome]);
    textAppend(text, word);
    if (color)
        textAppend(text, "\033[0m");
    textAppendFormat(text, "%*s", 8 - (int)strlen(word), "");
}

/* The characters a name takes in the terminal. */
static size_t plainLength(const char *name)
{
    Text text = {0};
    size_t characters = textAppendPlain(&text, name);
    textFree(&text);
    return characters;
}

/* The columns of an integer. */
static int countDigits(size_t value)
{
    int digits = 1;
    while (value >= 10) {
        value /= 10;
        digits++;
    }
    return digits;
}

/* "0 of 307200 pixels differ, largest 1/65535 at (12, 40)", the counts right-aligned in these columns. */
static void appendDifferences(Text *text, const Metrics *metrics, unsigned maxSample, int differingDigits,
                              int pixelDigits)
{
    textAppendFormat(text, "%*zu of %*zu %s %s, ", differingDigits, metrics->differingPixels, pixelDigits,
                     metrics->pixels, metrics->pixels == 1 ? "pixel" : "pixels",
                     metrics->differingPixels == 1 || metrics->pixels == 1 ? "differs" : "differ");
    if (metrics->maxDifference > 0) {
        textAppend(text, "largest ");
        textAppendDifference(text, metrics->maxDifference, maxSample);
    } else {
        textAppend(text, "all identical");
    }
}

/* Which terms disagree and how, a line each; else one line that all agree. */
static void appendTerms(Text *text, const SceneResult *result)
{
    for (size_t i = 0; i < result->termCount; i++) {
        const TermResult *term = &result->terms[i];
        if (term->verdict.pass)
            continue;
        textAppendFormat(text, "        the %s term disagrees: ", term->term);
        appendDifferences(text, &term->metrics, 65535, 1, 1);
        textAppendFormat(text, " at (%d, %d)\n", term->metrics.worst.x, term->metrics.worst.y);
    }
    if (countDifferingTerms(result) > 0)
        return;
    textAppend(text, result->termCount == 0 ? "        no term: the scene is black\n"
                                            : "        each term agrees: ");
    for (size_t i = 0; i < result->termCount; i++)
        textAppendFormat(text, "%s%s", result->terms[i].term, i + 1 < result->termCount ? ", " : "\n");
}

enum {
    MAX_NAME_COLUMNS = 60 /* a longer name pushes its own line to the right, not all of them */
};

void writeResultsText(const SceneResult *results, size_t count, bool color, Text *text)
{
    /* Find the width of each column. */
    size_t nameColumns = 0;
    int differingDigits = 1, pixelDigits = 1;
    for (size_t i = 0; i < count; i++) {
        size_t length = plainLength(results[i].scene);
        if (length <= MAX_NAME_COLUMNS && length > nameColumns)
            nameColumns = length;
        if (findSceneOutcome(&results[i]) == SCENE_FAILED)
            continue;
        int differing = countDigits(results[i].metrics.differingPixels);
        int pixels = countDigits(results[i].metrics.pixels);
        differingDigits = differing > differingDigits ? differing : differingDigits;
        pixelDigits = pixels > pixelDigits ? pixels : pixelDigits;
    }

    /* Write a line a scene. */
    for (size_t i = 0; i < count; i++) {
        const SceneResult *result = &results[i];
        SceneOutcome outcome = findSceneOutcome(result);
        appendOutcome(text, outcome, color);
        size_t length = textAppendPlain(text, result->scene);
        textAppendFormat(text, "%*s", length < nameColumns ? (int)(nameColumns - length) + 3 : 3, "");
        if (outcome == SCENE_FAILED) {
            textAppendPlain(text, result->status.message);
        } else {
            appendDifferences(text, &result->metrics, 65535, differingDigits, pixelDigits);
            if (outcome == SCENE_DIFFERS)
                textAppendFormat(text, " at (%d, %d)", result->metrics.worst.x, result->metrics.worst.y);
        }
        textAppend(text, "\n");
        if (result->perTerm && outcome != SCENE_FAILED)
            appendTerms(text, result);
    }

    /* Close with the verdict. */
    textAppendRunVerdict(text, results, count);
    textAppend(text, "\n");
}

/* One metric on its own line; what has no value says why. */
static void appendMetric(Text *text, const char *name, double value, const char *unit, const char *without)
{
    textAppendFormat(text, "  %-20s", name);
    if (isfinite(value)) {
        textAppendRounded(text, value, 6);
        textAppend(text, unit);
    } else {
        textAppend(text, without);
    }
    textAppend(text, "\n");
}

void writeMetricsText(const Metrics *metrics, const Verdict *verdict, bool color, Text *text)
{
    unsigned maxSample = findMaxSample(metrics);

    /* Say the verdict first, then why. */
    appendOutcome(text, verdict->pass ? SCENE_AGREES : SCENE_DIFFERS, color);
    appendDifferences(text, metrics, maxSample, 1, 1);
    textAppend(text, "\n");
    for (int i = 0; i < verdict->reasonCount && i < MAX_REASONS; i++)
        textAppendFormat(text, "  because %s\n", verdict->reasons[i]);

    /* List the numbers. */
    textAppendFormat(text, "\n  %-20s%d x %d\n", "size", metrics->width, metrics->height);
    textAppendFormat(text, "  %-20s%zu of %zu\n", "identical pixels", metrics->identicalPixels,
                     metrics->pixels);
    appendMetric(text, "differing pixels", metrics->differingPercent, " %", "");
    if (metrics->maxDifference > 0) {
        const WorstPixel *worst = &metrics->worst;
        textAppendFormat(text, "  %-20s(%d, %d) in %s: ", "worst pixel", worst->x, worst->y,
                         channelName(worst->channel));
        textAppendDifference(text, worst->a, maxSample);
        textAppend(text, " against ");
        textAppendDifference(text, worst->b, maxSample);
        textAppend(text, "\n");
    }
    appendMetric(text, "mean abs. error", metrics->mae, "", "none");
    appendMetric(text, "RMSE", metrics->rmse, "", "none");
    appendMetric(text, "PSNR", metrics->psnr, " dB", "none, the pictures are equal");
    appendMetric(text, "SSIM", metrics->ssim, "", "none, it needs 11 x 11 pixels");
    appendMetric(text, "FLIP", metrics->flip, "", "none");
}
