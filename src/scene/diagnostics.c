/* diagnostics.c - everything that is to be said about a file, with places; see diagnostics.h. */
#include "scene/diagnostics.h"

#include "scene/name_table.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* ---- Collecting ---- */

/* Put a hash into the set of those seen; false when it was there. */
static bool isNew(Diagnostics *diagnostics, uint64_t hash)
{
    hash = hash == 0 ? 1 : hash;
    if (2 * (diagnostics->seenCount + 1) > diagnostics->seenCapacity) {
        size_t capacity = diagnostics->seenCapacity == 0 ? 64 : diagnostics->seenCapacity * 2;
        uint64_t *seen = calloc(capacity, sizeof *seen);
        if (seen == NULL) {
            diagnostics->outOfMemory = true;
            return true;
        }
        for (size_t i = 0; i < diagnostics->seenCapacity; i++) {
            uint64_t old = diagnostics->seen[i];
            size_t slot = (size_t)(old ^ old >> 32) & (capacity - 1);
            while (old != 0 && seen[slot] != 0)
                slot = (slot + 1) & (capacity - 1);
            if (old != 0)
                seen[slot] = old;
        }
        free(diagnostics->seen);
        diagnostics->seen = seen;
        diagnostics->seenCapacity = capacity;
    }
    size_t slot = (size_t)(hash ^ hash >> 32) & (diagnostics->seenCapacity - 1);
    while (diagnostics->seen[slot] != 0) {
        if (diagnostics->seen[slot] == hash)
            return false;
        slot = (slot + 1) & (diagnostics->seenCapacity - 1);
    }
    diagnostics->seen[slot] = hash;
    diagnostics->seenCount++;
    return true;
}

/* Make room for more items; false when memory runs out, which is noted. */
static bool makeRoom(Diagnostics *diagnostics, size_t more)
{
    if (diagnostics->count + more <= diagnostics->capacity)
        return true;
    size_t capacity = 2 * diagnostics->capacity + more + 15;
    Diagnostic *items = realloc(diagnostics->items, capacity * sizeof *items);
    if (items == NULL) {
        diagnostics->outOfMemory = true;
        return false;
    }
    diagnostics->items = items;
    diagnostics->capacity = capacity;
    return true;
}

/* A printable copy, or NULL when memory runs out. */
static char *copyPrintable(const char *bytes, size_t length)
{
    Text text = {0};
    textAppendPrintable(&text, bytes, length);
    if (text.failed) {
        textFree(&text);
        return NULL;
    }
    return text.data != NULL ? text.data : calloc(1, 1);
}

/* A copy of the line; of a very long one only what is round the place, the cuts shown as dots. */
static char *copySourceLine(SourceText *source, Place place, int *offset)
{
    enum {
        MOST_CHARACTERS = 160, /* shown of a line */
        BEFORE = 60            /* of these before the place where something is cut in front */
    };
    *offset = 0;
    size_t length;
    const char *line = sourceLine(source, place.line, &length);
    const char *end = line + length;
    int first = place.column > MOST_CHARACTERS - BEFORE ? place.column - BEFORE : 1;
    const char *start = sourceCharacter(source, place.line, first);
    const char *stop = start;
    for (int i = 0; i < MOST_CHARACTERS && stop < end; i++) {
        size_t size;
        decodeUtf8(stop, end, &size);
        stop += size;
    }
    if (length == 0)
        return NULL;
    bool cutBehind = stop < end;
    if (first == 1 && !cutBehind)
        return copyPrintable(start, (size_t)(stop - start));

    /* Put dots where characters were cut. */
    Text text = {0};
    *offset = first - 1;
    if (first > 1 && start < stop) {
        size_t size;
        decodeUtf8(start, stop, &size);
        start += size;
        textAppend(&text, "\xE2\x80\xA6");
    }
    textAppendPrintable(&text, start, (size_t)(stop - start));
    if (cutBehind)
        textAppend(&text, "\xE2\x80\xA6");
    if (text.failed)
        textFree(&text);
    return text.data;
}

void addDiagnostic(Diagnostics *diagnostics, SourceText *source, Severity severity, Place place,
                   const char *hint, const char *message)
{
    /* Say the same thing once. */
    uint64_t hash = hashBytes(HASH_START, &place, sizeof place);
    hash = hashBytes(hash, &severity, sizeof severity);
    if (!isNew(diagnostics, hashBytes(hash, message, strlen(message))))
        return;
    if (severity == SEVERITY_ERROR)
        diagnostics->errors++;
    else
        diagnostics->warnings++;
    if (diagnostics->count >= DIAGNOSTICS_KEPT)
        return;

    if (!makeRoom(diagnostics, 1))
        return;
    Diagnostic item = {
        .severity = severity, .line = place.line, .column = place.column, .width = place.width};
    item.message = copyPrintable(message, strlen(message));
    item.hint = hint != NULL ? copyPrintable(hint, strlen(hint)) : NULL;
    item.sourceLine = source != NULL ? copySourceLine(source, place, &item.sourceOffset) : NULL;
    if (item.message == NULL) {
        diagnostics->outOfMemory = true;
        free(item.hint);
        free(item.sourceLine);
        return;
    }
    diagnostics->items[diagnostics->count++] = item;
}

void moveDiagnostics(Diagnostics *to, Diagnostics *from)
{
    if (from->count > 0 && makeRoom(to, from->count)) {
        memcpy(to->items + to->count, from->items, from->count * sizeof *from->items);
        to->count += from->count;
        from->count = 0;
    }
    to->errors += from->errors;
    to->warnings += from->warnings;
    to->outOfMemory = to->outOfMemory || from->outOfMemory;
    diagnosticsFree(from);
}

void diagnosticsSort(Diagnostics *diagnostics)
{
    /* Insert each where it belongs; they come nearly sorted, and equal ones keep their order. */
    for (size_t i = 1; i < diagnostics->count; i++) {
        Diagnostic item = diagnostics->items[i];
        size_t j = i;
        for (; j > 0; j--) {
            const Diagnostic *before = &diagnostics->items[j - 1];
            if (before->line < item.line || (before->line == item.line && before->column <= item.column))
                break;
            diagnostics->items[j] = *before;
        }
        diagnostics->items[j] = item;
    }
}

void diagnosticsFree(Diagnostics *diagnostics)
{
    for (size_t i = 0; i < diagnostics->count; i++) {
        free(diagnostics->items[i].message);
        free(diagnostics->items[i].hint);
        free(diagnostics->items[i].sourceLine);
    }
    free(diagnostics->items);
    free(diagnostics->seen);
    *diagnostics = (Diagnostics){0};
}

/* ---- Printing ---- */

typedef struct Colors {
    const char *error, *warning, *place, *caret, *hint, *end;
} Colors;

static const Colors COLORED = {"\x1b[1;31m", "\x1b[1;35m", "\x1b[1m", "\x1b[1;32m", "\x1b[36m", "\x1b[0m"};
static const Colors PLAIN = {"", "", "", "", "", ""};

/* Append the line that marks width characters of the source line with ^~~~. */
static void appendCaret(const Diagnostic *item, const Colors *colors, Text *text)
{
    textAppend(text, "  ");
    const char *s = item->sourceLine;
    const char *end = s + strlen(s);
    int caret = item->column - item->sourceOffset;

    /* Go to the caret: keep tabs, and give each character the room it takes. */
    for (int column = 1; column < caret; column++) {
        size_t size = 0;
        uint32_t character = s < end ? decodeUtf8(s, end, &size) : ' ';
        s += size;
        if (character == '\t')
            textAppend(text, "\t");
        else
            textAppendFormat(text, "%*s", displayWidth(character), "");
    }

    /* Underline what is there, at least one character. */
    textAppend(text, colors->caret);
    textAppend(text, "^");
    int columns = 0;
    for (int i = 0; i < item->width && s < end; i++) {
        size_t size;
        uint32_t character = decodeUtf8(s, end, &size);
        columns += character == '\t' ? 1 : displayWidth(character);
        s += size;
    }
    for (int i = 1; i < columns; i++)
        textAppend(text, "~");
    textAppend(text, colors->end);
    textAppend(text, "\n");
}

static void appendItem(const Diagnostic *item, const char *file, const Colors *colors, Text *text)
{
    bool isError = item->severity == SEVERITY_ERROR;
    textAppend(text, colors->place);
    textAppendPrintable(text, file, strlen(file));
    textAppendFormat(text, ":%d:%d:%s %s%s:%s %s\n", item->line, item->column, colors->end,
                     isError ? colors->error : colors->warning, isError ? "error" : "warning", colors->end,
                     item->message);
    if (item->sourceLine != NULL && item->sourceLine[0] != '\0') {
        textAppendFormat(text, "  %s\n", item->sourceLine);
        appendCaret(item, colors, text);
    }
    if (item->hint != NULL)
        textAppendFormat(text, "  %shint:%s %s\n", colors->hint, colors->end, item->hint);
}

void diagnosticsPrint(const Diagnostics *diagnostics, const char *file, bool color, Text *text)
{
    const Colors *colors = color ? &COLORED : &PLAIN;
    size_t shownErrors = 0, shownWarnings = 0;
    size_t keptErrors = 0;
    for (size_t i = 0; i < diagnostics->count; i++)
        keptErrors += diagnostics->items[i].severity == SEVERITY_ERROR;

    /* Errors come first to the places there are. */
    size_t roomForErrors = keptErrors < DIAGNOSTICS_SHOWN ? keptErrors : DIAGNOSTICS_SHOWN;
    size_t roomForWarnings = DIAGNOSTICS_SHOWN - roomForErrors;
    for (size_t i = 0; i < diagnostics->count; i++) {
        const Diagnostic *item = &diagnostics->items[i];
        bool isError = item->severity == SEVERITY_ERROR;
        if (isError ? shownErrors >= roomForErrors : shownWarnings >= roomForWarnings)
            continue;
        appendItem(item, file, colors, text);
        shownErrors += isError;
        shownWarnings += !isError;
    }
    size_t moreErrors = diagnostics->errors - shownErrors;
    size_t moreWarnings = diagnostics->warnings - shownWarnings;
    if (moreErrors > 0)
        textAppendFormat(text, "... and %zu more error%s\n", moreErrors, moreErrors == 1 ? "" : "s");
    if (moreWarnings > 0)
        textAppendFormat(text, "... and %zu more warning%s\n", moreWarnings, moreWarnings == 1 ? "" : "s");
}
