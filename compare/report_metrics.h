/* report_metrics.h - the report's table: each metric, what it means, its value, its limit, whether it holds.
 */
#ifndef ECLAIRAGE_COMPARE_REPORT_METRICS_H
#define ECLAIRAGE_COMPARE_REPORT_METRICS_H

#include "compare/report.h"

#include <stdbool.h>

enum {
    METRIC_ROW_COUNT = 8
};

typedef struct MetricRow {
    const char *name, *meaning; /* static texts */
    Text value, limit;          /* plain text; limit is empty where none is set */
    bool judged;                /* there is a limit */
    bool pass;                  /* it holds; true where there is none */
} MetricRow;

/* Fill row number, 0 to METRIC_ROW_COUNT - 1, for a measured scene. The caller frees it. */
MetricRow makeMetricRow(const SceneResult *result, int number);
void freeMetricRow(MetricRow *row);

/* Append a number as a person writes it: "0.0012", "4.2 x 10^-7" with a raised exponent (UTF-8). */
void textAppendReadable(Text *text, double value, int digits);

#endif
