/* report_fields.c - the fields of the report's template, each with the value it stands for.
 *
 * All text goes through textAppendHtml, but for the page's own style and script; pictures are streamed
 * from their files, so that memory does not grow with the number of scenes.
 */
#include "base/cancel.h"
#include "base/files.h"
#include "compare/html.h"
#include "compare/report_page.h"
#include "compare/report_template.h"
#include "compare/words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    BASE64_CHUNK = 3 * 1024 * 1024 /* bytes between two looks at cancelRequested; divisible by 3 */
};

static const char thinSpace[] = "\xE2\x80\xAF"; /* U+202F */

static void appendRunOutcome(const Page *page, Text *text)
{
    bool differs = countScenes(page->results, page->count, SCENE_DIFFERS) > 0;
    bool failed = countScenes(page->results, page->count, SCENE_FAILED) > 0;
    textAppend(text, sceneOutcomeWord(differs ? SCENE_DIFFERS : failed ? SCENE_FAILED : SCENE_AGREES));
}

static void appendRunVerdict(const Page *page, Text *text)
{
    textAppendRunVerdict(text, page->results, page->count);
}

/* The same for the heading, where the name must not be broken at its hyphen. The sentence has no text from
 * outside. */
static void appendRunVerdictMarkup(const Page *page, Text *text)
{
    static const char name[] = "POV-Ray";
    Text sentence = {0};
    textAppendRunVerdict(&sentence, page->results, page->count);
    const char *found = strstr(textString(&sentence), name);
    const char *rest = textString(&sentence);
    if (found != NULL) {
        textAppendBytes(text, rest, (size_t)(found - rest));
        textAppendFormat(text, "<span class=\"nobr\">%s</span>", name);
        rest = found + strlen(name);
    }
    textAppend(text, rest);
    textFree(&sentence);
}

/* "6 144 000 pixels compared, 99.98 % of them identical; the largest difference is 1/65535." */
static void appendRunSummary(const Page *page, Text *text)
{
    size_t pixels = 0, identical = 0;
    double largest = 0.0;
    for (size_t i = 0; i < page->count; i++) {
        if (findSceneOutcome(&page->results[i]) == SCENE_FAILED)
            continue;
        const Metrics *metrics = &page->results[i].metrics;
        pixels += metrics->pixels;
        identical += metrics->identicalPixels;
        largest = metrics->maxDifference > largest ? metrics->maxDifference : largest;
    }
    if (pixels == 0) {
        textAppend(text, "No pixel was compared.");
        return;
    }
    textAppendCount(text, pixels, thinSpace);
    textAppend(text, pixels == 1 ? " pixel compared, " : " pixels compared, ");
    if (identical == pixels) {
        textAppend(text, "all of them identical to the last bit.");
        return;
    }
    /* Round down, so that 100 % is said of all pixels only. */
    double percent = floor(1e4 * (double)identical / (double)pixels) / 100.0;
    textAppendReadable(text, percent, 6);
    textAppend(text, "\u00A0% of them identical to the last bit; the largest difference is ");
    textAppendDifference(text, largest, 65535);
    textAppend(text, " of full brightness.");
}

static void appendVersion(const Page *page, Text *text)
{
    (void)page;
    textAppend(text, ECLAIRAGE_VERSION);
}

static void appendCommand(const Page *page, Text *text)
{
    textAppend(text, page->command != NULL ? page->command : "");
}

static void appendCount(const Page *page, Text *text)
{
    textAppendCount(text, page->count, NULL);
}

static void appendAgreeing(const Page *page, Text *text)
{
    textAppendCount(text, countScenes(page->results, page->count, SCENE_AGREES), NULL);
}

static void appendDiffering(const Page *page, Text *text)
{
    textAppendCount(text, countScenes(page->results, page->count, SCENE_DIFFERS), NULL);
}

static void appendFailed(const Page *page, Text *text)
{
    textAppendCount(text, countScenes(page->results, page->count, SCENE_FAILED), NULL);
}

static void appendStyle(const Page *page, Text *text)
{
    (void)page;
    textAppend(text, reportStyle);
}

static void appendScript(const Page *page, Text *text)
{
    (void)page;
    textAppend(text, reportPictureScript);
    textAppend(text, reportScript);
}

static void appendNumber(const Page *page, Text *text)
{
    textAppendCount(text, page->scene + 1, NULL);
}

static void appendOutcome(const Page *page, Text *text)
{
    textAppend(text, sceneOutcomeWord(findSceneOutcome(pageScene(page))));
}

static void appendOutcomeLabel(const Page *page, Text *text)
{
    static const char *const labels[] = {"Agrees", "Differs", "Not compared"};
    textAppend(text, labels[findSceneOutcome(pageScene(page))]);
}

static void appendName(const Page *page, Text *text)
{
    textAppend(text, pageScene(page)->scene);
}

/* The file's name without its folders, for where there is little room. */
static void appendShortName(const Page *page, Text *text)
{
    const char *name = pageScene(page)->scene;
    const char *slash = strrchr(name, '/');
    textAppend(text, slash != NULL && slash[1] != '\0' ? slash + 1 : name);
}

static void appendSummary(const Page *page, Text *text)
{
    const SceneResult *result = pageScene(page);
    const Metrics *metrics = &result->metrics;
    if (findSceneOutcome(result) == SCENE_FAILED) {
        textAppend(text, "It could not be compared.");
        return;
    }
    if (metrics->identicalPixels == metrics->pixels) {
        textAppend(text, "All ");
        textAppendCount(text, metrics->pixels, thinSpace);
        textAppend(text, " pixels are identical to the last bit.");
        return;
    }
    /* A channel differs by more than fail exactly when it does by more than this many steps. */
    double steps = floor(result->tolerance.fail * 65535.0);
    textAppendCount(text, metrics->differingPixels, thinSpace);
    textAppend(text, " of ");
    textAppendCount(text, metrics->pixels, thinSpace);
    textAppendFormat(text, " pixels differ by more than %lld/65535; the largest difference is ",
                     isfinite(steps) ? llround(steps) : 0LL);
    textAppendDifference(text, metrics->maxDifference, 65535);
    textAppend(text, ".");
}

static void appendCardLine(const Page *page, Text *text)
{
    const SceneResult *result = pageScene(page);
    const Metrics *metrics = &result->metrics;
    if (findSceneOutcome(result) == SCENE_FAILED) {
        textAppend(text, result->status.message);
    } else if (metrics->identicalPixels == metrics->pixels) {
        textAppend(text, "identical");
    } else {
        textAppendCount(text, metrics->differingPixels, thinSpace);
        textAppend(text,
                   metrics->differingPixels == 1 ? " pixel differs, largest " : " pixels differ, largest ");
        textAppendDifference(text, metrics->maxDifference, 65535);
    }
}

static void appendWidth(const Page *page, Text *text)
{
    textAppendFormat(text, "%d", pageScene(page)->metrics.width);
}

static void appendHeight(const Page *page, Text *text)
{
    textAppendFormat(text, "%d", pageScene(page)->metrics.height);
}

static void appendWorstX(const Page *page, Text *text)
{
    textAppendFormat(text, "%d", pageScene(page)->metrics.worst.x);
}

static void appendWorstY(const Page *page, Text *text)
{
    textAppendFormat(text, "%d", pageScene(page)->metrics.worst.y);
}

static void appendMaxDifference(const Page *page, Text *text)
{
    textAppendDouble(text, pageScene(page)->metrics.maxDifference);
}

static void appendFail(const Page *page, Text *text)
{
    textAppendDouble(text, pageScene(page)->tolerance.fail);
}

static void appendRenderSeconds(const Page *page, Text *text)
{
    textAppendReadable(text, pageScene(page)->renderSeconds, 2);
}

static void appendPovraySeconds(const Page *page, Text *text)
{
    textAppendReadable(text, pageScene(page)->povraySeconds, 2);
}

static void appendCompareSeconds(const Page *page, Text *text)
{
    textAppendReadable(text, pageScene(page)->compareSeconds, 2);
}

static void appendSceneCommand(const Page *page, Text *text)
{
    const char *command = pageScene(page)->command;
    textAppend(text, command != NULL ? command : "");
}

static void appendOursFile(const Page *page, Text *text)
{
    textAppendFileAddress(text, pageScene(page)->oursFile);
}

static void appendPovrayFile(const Page *page, Text *text)
{
    textAppendFileAddress(text, pageScene(page)->povrayFile);
}

static void appendDifferenceFile(const Page *page, Text *text)
{
    textAppendFileAddress(text, pageScene(page)->differenceFile);
}

static void appendPovFile(const Page *page, Text *text)
{
    textAppendFileAddress(text, pageScene(page)->povFile);
}

static void appendError(const Page *page, Text *text)
{
    textAppend(text, pageScene(page)->status.message);
}

static void appendErrorCode(const Page *page, Text *text)
{
    textAppendFormat(text, "%d", (int)pageScene(page)->status.code);
}

static void appendErrorMeaning(const Page *page, Text *text)
{
    switch (pageScene(page)->status.code) {
    case STATUS_USAGE:
        textAppend(text, "The command line is wrong.");
        break;
    case STATUS_SCENE:
        textAppend(text, "The scene file is not valid.");
        break;
    case STATUS_IO:
        textAppend(text, "A file could not be read or written, or memory ran out.");
        break;
    case STATUS_POVRAY:
        textAppend(text, "POV-Ray is missing, failed or took too long.");
        break;
    case STATUS_MISMATCH:
        textAppend(text, "The two pictures are not of one kind: size, bit depth or encoding.");
        break;
    case STATUS_INEXPRESSIBLE:
        textAppend(text, "POV-Ray has no way to say what this scene says.");
        break;
    default:
        textAppend(text, "It was interrupted.");
        break;
    }
}

static void appendReason(const Page *page, Text *text)
{
    textAppend(text, pageScene(page)->verdict.reasons[page->reason]);
}

static void appendMetricName(const Page *page, Text *text)
{
    textAppend(text, page->row->name);
}

static void appendMetricMeaning(const Page *page, Text *text)
{
    textAppend(text, page->row->meaning);
}

static void appendMetricValue(const Page *page, Text *text)
{
    textAppend(text, textString(&page->row->value));
}

static void appendMetricLimit(const Page *page, Text *text)
{
    textAppend(text, page->row->judged ? textString(&page->row->limit) : "no limit");
}

static void appendMetricOutcome(const Page *page, Text *text)
{
    textAppend(text, !page->row->judged ? "free" : page->row->pass ? "agree" : "differ");
}

static void appendMetricMark(const Page *page, Text *text)
{
    textAppend(text, !page->row->judged ? "" : page->row->pass ? "✓ within" : "✗ beyond");
}

/* Write a picture's file in base64. */
static void writePicture(Page *page, const char *fileName)
{
    Text path = pathInFolder(page->folder, fileName);
    char *data = NULL;
    size_t length = 0;
    page->status = path.failed ? statusOutOfMemory()
                               : readWholeFile(textString(&path), MAX_EMBEDDED_BYTES, &data, &length);
    textFree(&path);
    for (size_t done = 0; statusIsOk(&page->status) && done < length; done += BASE64_CHUNK) {
        writeBase64(page->stream, data + done, length - done < BASE64_CHUNK ? length - done : BASE64_CHUNK);
        if (cancelRequested())
            page->status = statusInterrupted();
    }
    free(data);
}

static void writeOurs(Page *page)
{
    writePicture(page, pageScene(page)->oursFile);
}

static void writePovray(Page *page)
{
    writePicture(page, pageScene(page)->povrayFile);
}

static void writeDifference(Page *page)
{
    writePicture(page, pageScene(page)->differenceFile);
}

static const Field fields[] = {
    {.name = "style", .append = appendStyle, .markup = true},
    {.name = "script", .append = appendScript, .markup = true},
    {.name = "version", .append = appendVersion},
    {.name = "run-outcome", .append = appendRunOutcome},
    {.name = "run-verdict", .append = appendRunVerdict},
    {.name = "run-verdict-markup", .append = appendRunVerdictMarkup, .markup = true},
    {.name = "run-summary", .append = appendRunSummary},
    {.name = "run-command", .append = appendCommand},
    {.name = "count", .append = appendCount},
    {.name = "agreeing", .append = appendAgreeing},
    {.name = "differing", .append = appendDiffering},
    {.name = "failing", .append = appendFailed},
    {.name = "number", .append = appendNumber},
    {.name = "outcome", .append = appendOutcome},
    {.name = "outcome-label", .append = appendOutcomeLabel},
    {.name = "name", .append = appendName},
    {.name = "short-name", .append = appendShortName},
    {.name = "summary", .append = appendSummary},
    {.name = "card-line", .append = appendCardLine},
    {.name = "width", .append = appendWidth},
    {.name = "height", .append = appendHeight},
    {.name = "worst-x", .append = appendWorstX},
    {.name = "worst-y", .append = appendWorstY},
    {.name = "max-difference", .append = appendMaxDifference},
    {.name = "fail", .append = appendFail},
    {.name = "render-seconds", .append = appendRenderSeconds},
    {.name = "povray-seconds", .append = appendPovraySeconds},
    {.name = "compare-seconds", .append = appendCompareSeconds},
    {.name = "command", .append = appendSceneCommand},
    {.name = "ours-file", .append = appendOursFile},
    {.name = "povray-file", .append = appendPovrayFile},
    {.name = "difference-file", .append = appendDifferenceFile},
    {.name = "pov-file", .append = appendPovFile},
    {.name = "ours-data", .write = writeOurs},
    {.name = "povray-data", .write = writePovray},
    {.name = "difference-data", .write = writeDifference},
    {.name = "error", .append = appendError},
    {.name = "error-code", .append = appendErrorCode},
    {.name = "error-meaning", .append = appendErrorMeaning},
    {.name = "reason", .append = appendReason},
    {.name = "metric-name", .append = appendMetricName},
    {.name = "metric-meaning", .append = appendMetricMeaning},
    {.name = "metric-value", .append = appendMetricValue},
    {.name = "metric-limit", .append = appendMetricLimit},
    {.name = "metric-outcome", .append = appendMetricOutcome},
    {.name = "metric-mark", .append = appendMetricMark},
};

static const Field *findField(const Field *table, size_t count, const char *name, size_t length)
{
    for (size_t i = 0; i < count; i++)
        if (strlen(table[i].name) == length && memcmp(name, table[i].name, length) == 0)
            return &table[i];
    return NULL;
}

bool writeField(Page *page, const char *name, size_t length)
{
    const Field *field = findField(fields, sizeof fields / sizeof *fields, name, length);
    if (field == NULL && page->term != NULL)
        field = findField(termFields, termFieldCount, name, length);
    if (field == NULL)
        return false;
    if (field->write != NULL) {
        field->write(page);
        return true;
    }
    Text value = {0}, html = {0};
    field->append(page, &value);
    if (!field->markup)
        textAppendHtml(&html, textString(&value));
    const Text *result = field->markup ? &value : &html;
    if (value.failed || html.failed)
        page->status = statusOutOfMemory();
    else
        fwrite(textString(result), 1, result->length, page->stream);
    textFree(&value);
    textFree(&html);
    return true;
}
