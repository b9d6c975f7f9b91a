/* diagnostics.h - everything that is to be said about a file, with places.
 *
 * A Diagnostics collects errors and warnings in the order in which they are found; it prints nothing. The
 * same thing is said once, however often an alias leads to it. The first DIAGNOSTICS_KEPT are kept, the
 * rest is counted.
 * Invariant: errors + warnings >= count; message, hint and sourceLine hold no control characters but tabs.
 */
#ifndef ECLAIRAGE_SCENE_DIAGNOSTICS_H
#define ECLAIRAGE_SCENE_DIAGNOSTICS_H

#include "base/text.h"
#include "scene/source_text.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    DIAGNOSTICS_KEPT = 1000, /* in memory */
    DIAGNOSTICS_SHOWN = 20   /* by diagnosticsPrint */
};

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
    uint64_t *seen;          /* hashes of what was said, 0 for a free slot */
    size_t seenCount, seenCapacity;
    bool outOfMemory;
} Diagnostics;

/* Add one, with the line of source (which may be NULL) it is about. hint may be NULL. */
void addDiagnostic(Diagnostics *diagnostics, SourceText *source, Severity severity, Place place,
                   const char *hint, const char *message);

/* Append what from has, and empty from. The items of to keep their order, those of from come behind. */
void moveDiagnostics(Diagnostics *to, Diagnostics *from);

/* Sort by place; of two at the same place the one added first comes first. */
void diagnosticsSort(Diagnostics *diagnostics);

/* Append as text for a person: `file:line:col: error: message`, the source line, a caret, the hint. In
 * colour where color is true. At most DIAGNOSTICS_SHOWN, errors before warnings where not all have room,
 * and then how many more there are. */
void diagnosticsPrint(const Diagnostics *diagnostics, const char *file, bool color, Text *text);

void diagnosticsFree(Diagnostics *diagnostics);

#endif
