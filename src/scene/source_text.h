/* source_text.h - the text of a scene file, as characters in lines.
 *
 * YAML is UTF-8 here; places count lines and characters from 1. A line ends where libyaml ends it: at LF,
 * CR, CR LF, and at U+0085, U+2028 and U+2029 (YAML 1.1, section 4.1.4).
 * Invariant: lineStarts, made when it is first needed, holds the offset of every line.
 */
#ifndef ECLAIRAGE_SCENE_SOURCE_TEXT_H
#define ECLAIRAGE_SCENE_SOURCE_TEXT_H

#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A stretch of one line. */
typedef struct Place {
    int line, column; /* from 1, in characters */
    int width;        /* characters, at least 1 */
} Place;

typedef struct SourceText {
    const char *text; /* not owned */
    size_t length;    /* bytes */
    size_t *lineStarts;
    size_t lineCount;
    int foundLine, foundColumn; /* the character looked for last, and its offset */
    size_t foundOffset;
} SourceText;

/* A byte order mark in front is left out. */
SourceText openSourceText(const char *text, size_t length);
void closeSourceText(SourceText *source);

/* The line without its end, as bytes; an empty one when there is no such line or no memory. */
const char *sourceLine(SourceText *source, int line, size_t *length);

/* The start of a character of the line, or the line's end where it is shorter. Asking for places in rising
 * order takes linear time in all, also on one very long line. */
const char *sourceCharacter(SourceText *source, int line, int column);

/* The character at s (s < end) and in *size its bytes; for bytes that are not UTF-8 (RFC 3629, section
 * 4) UINT32_MAX, *size then being 1. */
uint32_t decodeUtf8(const char *s, const char *end, size_t *size);

/* The columns it takes on a terminal: 0 for combining marks, 2 for wide characters, else 1. */
int displayWidth(uint32_t character);

/* Why a text cannot be YAML in UTF-8, and where. */
typedef struct EncodingFault {
    Place place;
    bool isText; /* the line can be shown */
    const char *hint;
    char message[160];
} EncodingFault;

/* Whether all is well; else the first fault. */
bool checkEncoding(const SourceText *source, EncodingFault *fault);

/* Append bytes of the file with everything unprintable but tabs replaced by U+FFFD. */
void textAppendPrintable(Text *text, const char *bytes, size_t length);

enum {
    QUOTE_SIZE = 200
};

/* Text from the file for use in a message: at most 40 characters, everything unprintable escaped. */
typedef struct Quote {
    char text[QUOTE_SIZE];
} Quote;

Quote quoteBytes(const char *bytes, size_t length);

#endif
