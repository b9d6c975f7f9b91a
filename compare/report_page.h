/* report_page.h - the page while it is written: where it stands, and the fields of its template. */
#ifndef ECLAIRAGE_COMPARE_REPORT_PAGE_H
#define ECLAIRAGE_COMPARE_REPORT_PAGE_H

#include "compare/report.h"
#include "compare/report_metrics.h"

#include <stdio.h>

enum {
    MAX_EMBEDDED_BYTES = 192 * 1024 * 1024 /* of a scene's pictures; browsers end at 512 MiB of text */
};

/* What is being written, and where in the loops the template is. */
typedef struct Page {
    FILE *stream;
    Status status; /* the first failure; nothing is written after it */
    const char *folder;
    const SceneResult *results;
    size_t count;
    const char *command;
    size_t scene;           /* inside {{#scenes}} or {{#cards}}: which */
    int reason;             /* inside {{#reasons}}: which */
    const MetricRow *row;   /* inside {{#metrics}} */
    const TermResult *term; /* inside {{#terms}} or {{#differing-terms}} */
} Page;

/* The result of the scene the template is at. */
static inline const SceneResult *pageScene(const Page *page)
{
    return &page->results[page->scene];
}

/* How a field gets its value: as text, escaped unless it is markup, or by writing itself. */
typedef struct Field {
    const char *name;
    void (*append)(const Page *page, Text *text);
    void (*write)(Page *page);
    bool markup;
} Field;

/* The fields of a term (report_terms.c). */
extern const Field termFields[];
extern const size_t termFieldCount;

/* Write the value of a field; false when there is no field of this name. A failure is in page->status. */
bool writeField(Page *page, const char *name, size_t length);

#endif
