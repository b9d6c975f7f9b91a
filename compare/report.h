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
} SceneResult;

/* Append the fields of `diff --json` (interfaces.md) to an open object. */
void jsonMetrics(JsonWriter *json, const Metrics *metrics);

/* The whole of `compare --json` and of results.json. */
void writeResultsJson(const SceneResult *results, size_t count, Text *text);

/* The page: folder/index.html, which embeds the pictures from their files in folder. */
Status writeReport(const char *folder, const SceneResult *results, size_t count, const char *command);

/* The results in words, for the terminal: a line a scene, then the verdict. */
void writeResultsText(const SceneResult *results, size_t count, bool color, Text *text);

/* One comparison in words, for diff. */
void writeMetricsText(const Metrics *metrics, const Verdict *verdict, bool color, Text *text);

#endif
