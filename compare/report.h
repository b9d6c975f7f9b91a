/* report.h - the result of a run: one self-contained page, and JSON. */
#ifndef ECLAIRAGE_COMPARE_REPORT_H
#define ECLAIRAGE_COMPARE_REPORT_H

#include "base/json.h"
#include "base/status.h"
#include "base/text.h"
#include "compare/metrics.h"
#include "image/image.h"

#include <stdbool.h>
#include <stddef.h>

/* What a comparison of one term of a scene's light gave: of the same scene with the sources of all other
 * terms set to zero. */
typedef struct TermResult {
    const char *term; /* "diffuse" */
    Metrics metrics;
    Verdict verdict; /* by the scene's tolerance */
    const char *oursFile, *povrayFile, *differenceFile, *povFile;
} TermResult;

/* What a comparison of one scene gave. Strings belong to the caller. */
typedef struct SceneResult {
    const char *scene; /* the path as given */
    Status status;     /* ok when it was measured, whatever the verdict; else why it was not */
    Metrics metrics;
    Tolerance tolerance;
    Verdict verdict;
    double renderSeconds, povraySeconds, compareSeconds;
    /* Names of the files, relative to the report's folder. */
    const char *oursFile, *povrayFile, *differenceFile, *povFile;
    const char *command; /* reproduces this scene's comparison */
    /* With --per-term, those that the scene has; one that differs makes the scene differ. */
    const TermResult *terms;
    size_t termCount;
    bool perTerm; /* whether they were asked for */
} SceneResult;

/* Append the measured fields of `diff --json`, "width" to "flip" in that order, to an open object; NAN is
 * null, worst_pixel.channel is 0, 1 or 2. diff ends with "pass", then jsonReasons. */
void jsonMetrics(JsonWriter *json, const Metrics *metrics);

/* Append "reasons", an array that is empty for a pass, to an open object. */
void jsonReasons(JsonWriter *json, const Verdict *verdict);

/* The whole of `compare --json` and of results.json. */
void writeResultsJson(const SceneResult *results, size_t count, Text *text);

/* Write the page, folder/index.html, which embeds the pictures from their files in folder. command is the
 * whole run's. STATUS_IO when a picture cannot be read or the page not written; STATUS_INTERRUPTED when
 * cancelled; the old page is then as it was. Pictures of a scene over 192 MiB in all are linked instead. */
Status writeReport(const char *folder, const SceneResult *results, size_t count, const char *command);

/* The results in words, for the terminal: a line a scene, then the verdict. */
void writeResultsText(const SceneResult *results, size_t count, bool color, Text *text);

/* One comparison in words, for diff. */
void writeMetricsText(const Metrics *metrics, const Verdict *verdict, bool color, Text *text);

#endif
