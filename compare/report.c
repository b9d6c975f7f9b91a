/* report.c - the report of a run as one page; see report.h.
 *
 * The page is report.html with its fields filled in:
 *   {{name}}                  a value (report_fields.c)
 *   {{#name}} ... {{/name}}   written once for each scene, reason or metric, or only when it applies
 * A block does not contain another of its own name. Values are never searched for fields, so nothing that
 * a scene says can act in the page.
 */
#include "base/cancel.h"
#include "base/files.h"
#include "compare/report_page.h"
#include "compare/report_template.h"
#include "compare/words.h"

#include <string.h>
#include <sys/stat.h>

static bool nameIs(const char *name, size_t length, const char *wanted)
{
    return strlen(wanted) == length && memcmp(name, wanted, length) == 0;
}

/* A mistake in report.html, found by the first test that writes a page. */
static void failTemplate(Page *page, const char *name, size_t length)
{
    if (statusIsOk(&page->status))
        page->status =
            statusError(STATUS_IO, "the report's template has no meaning for {{%.*s}}", (int)length, name);
}

static void writeTemplate(Page *page, const char *start, const char *end);

/* Whether the files exist and the three pictures are small enough to be part of the page. */
static bool canEmbed(const Page *page)
{
    const SceneResult *result = pageScene(page);
    const char *const names[] = {result->oursFile, result->povrayFile, result->differenceFile};
    size_t total = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct stat info;
        Text path = pathInFolder(page->folder, names[i] != NULL ? names[i] : "");
        /* A file that cannot be looked at is left to writePicture, which says why. */
        if (names[i] != NULL && stat(textString(&path), &info) == 0)
            total += (size_t)info.st_size;
        textFree(&path);
        if (names[i] == NULL)
            return false;
    }
    return total <= MAX_EMBEDDED_BYTES;
}

/* Write a block's body as often as the block's name says. */
static void writeBlock(Page *page, const char *name, size_t length, const char *start, const char *end)
{
    if (nameIs(name, length, "scenes") || nameIs(name, length, "cards")) {
        for (page->scene = 0; page->scene < page->count; page->scene++)
            writeTemplate(page, start, end);
        page->scene = 0;
        return;
    }
    if (nameIs(name, length, "several")) {
        if (page->count > 1)
            writeTemplate(page, start, end);
        return;
    }
    if (page->count == 0) {
        failTemplate(page, name, length);
        return;
    }
    const SceneResult *result = pageScene(page);
    SceneOutcome outcome = findSceneOutcome(result);
    if (nameIs(name, length, "reasons")) {
        for (page->reason = 0; page->reason < result->verdict.reasonCount && page->reason < MAX_REASONS;
             page->reason++)
            writeTemplate(page, start, end);
    } else if (nameIs(name, length, "terms") || nameIs(name, length, "differing-terms")) {
        bool all = nameIs(name, length, "terms");
        for (size_t i = 0; i < result->termCount; i++) {
            page->term = &result->terms[i];
            if (all || !page->term->verdict.pass)
                writeTemplate(page, start, end);
        }
        page->term = NULL;
    } else if (nameIs(name, length, "metrics")) {
        for (int i = 0; i < METRIC_ROW_COUNT; i++) {
            MetricRow row = makeMetricRow(result, i);
            page->row = &row;
            if (row.value.failed || row.limit.failed)
                page->status = statusOutOfMemory();
            writeTemplate(page, start, end);
            freeMetricRow(&row);
        }
        page->row = NULL;
    } else {
        bool applies = false;
        if (nameIs(name, length, "measured"))
            applies = outcome != SCENE_FAILED;
        else if (nameIs(name, length, "failed"))
            applies = outcome == SCENE_FAILED;
        else if (nameIs(name, length, "differs"))
            applies = outcome == SCENE_DIFFERS;
        else if (nameIs(name, length, "per-term"))
            applies = result->termCount > 0;
        else if (nameIs(name, length, "embedded"))
            applies = canEmbed(page);
        else if (nameIs(name, length, "linked"))
            applies = !canEmbed(page);
        else
            failTemplate(page, name, length);
        if (applies)
            writeTemplate(page, start, end);
    }
}

/* Find marker between start and end, or NULL. */
static const char *findMarker(const char *start, const char *end, const char *marker, size_t length)
{
    for (const char *s = start; (size_t)(end - s) >= length; s++)
        if (memcmp(s, marker, length) == 0)
            return s;
    return NULL;
}

static void writeTemplate(Page *page, const char *start, const char *end)
{
    while (statusIsOk(&page->status) && start < end) {
        /* Write what comes before the next field. */
        const char *open = findMarker(start, end, "{{", 2);
        const char *close = open != NULL ? findMarker(open, end, "}}", 2) : NULL;
        const char *stop = close != NULL ? open : end;
        fwrite(start, 1, (size_t)(stop - start), page->stream);
        if (close == NULL)
            return;

        /* Fill the field in, or find the block's end and write the block. */
        const char *name = open + 2;
        size_t length = (size_t)(close - name);
        start = close + 2;
        if (length == 0 || *name != '#') {
            if (!writeField(page, name, length))
                failTemplate(page, name, length);
            continue;
        }
        name++;
        length--;
        char closing[64];
        int closingLength = snprintf(closing, sizeof closing, "{{/%.*s}}", (int)length, name);
        const char *blockEnd = closingLength < (int)sizeof closing
                                   ? findMarker(start, end, closing, (size_t)closingLength)
                                   : NULL;
        if (blockEnd == NULL) {
            failTemplate(page, name, length);
            return;
        }
        writeBlock(page, name, length, start, blockEnd);
        start = blockEnd + closingLength;
        if (cancelRequested())
            page->status = statusInterrupted();
    }
}

Status writeReport(const char *folder, const SceneResult *results, size_t count, const char *command)
{
    Text path = {0};
    textAppend(&path, folder);
    textAppend(&path, "/index.html");
    OutputFile output;
    Status status = path.failed ? statusOutOfMemory() : openOutput(&output, textString(&path));
    textFree(&path);
    if (!statusIsOk(&status))
        return status;

    Page page = {.stream = output.stream,
                 .status = statusOk(),
                 .folder = folder,
                 .results = results,
                 .count = count,
                 .command = command};
    writeTemplate(&page, reportPage, reportPage + strlen(reportPage));
    if (!statusIsOk(&page.status)) {
        abandonOutput(&output);
        return page.status;
    }
    return closeOutput(&output);
}
