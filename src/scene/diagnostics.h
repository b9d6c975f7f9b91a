/* diagnostics.h - everything that is to be said about a file, with places.
 *
 * A Diagnostics collects errors and warnings in the order in which they are found; it prints nothing.
 */
#ifndef ECLAIRAGE_SCENE_DIAGNOSTICS_H
#define ECLAIRAGE_SCENE_DIAGNOSTICS_H

#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum Severity {
    SEVERITY_ERROR,
    SEVERITY_WARNING
} Severity;

typedef struct Diagnostic {
    Severity severity;
    int line, column; /* from 1; the column counts characters */
    int width;        /* characters to underline, at least 1 */
    char *message;    /* one sentence; owned */
    char *hint;       /* what to do, or NULL; owned */
    char *sourceLine; /* the line of the file, cut when very long, or NULL; owned */
    int sourceOffset; /* characters cut from its front, so the caret stands at column - sourceOffset */
} Diagnostic;

typedef struct Diagnostics {
    Diagnostic *items;
    size_t count, capacity;
    size_t errors, warnings; /* all of them, also those beyond the limit that are not kept */
    bool outOfMemory;
} Diagnostics;

/* Sort by place and drop exact repeats. */
void diagnosticsSort(Diagnostics *diagnostics);

/* Append as text for a person: `file:line:col: error: message`, the source line, a caret, the hint. In
 * colour where color is true. */
void diagnosticsPrint(const Diagnostics *diagnostics, const char *file, bool color, Text *text);

void diagnosticsFree(Diagnostics *diagnostics);

#endif
