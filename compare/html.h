/* html.h - pieces of an HTML page: text that cannot become markup, addresses, embedded files.
 *
 * Invariant: whatever bytes come in, what goes out is valid UTF-8 that an HTML parser reads as plain text
 * inside an element or a double-quoted attribute (WHATWG HTML, 13.1.2 and 13.1.4).
 * Errors of the stream are left to closeOutput (base/files.h).
 */
#ifndef ECLAIRAGE_COMPARE_HTML_H
#define ECLAIRAGE_COMPARE_HTML_H

#include "base/text.h"

#include <stddef.h>
#include <stdio.h>

/* Append text as HTML text: & < > " ' become references; bytes that are not UTF-8, control characters other
 * than tab and newline, and those that turn the text's direction become U+FFFD. NULL is the empty text. */
void textAppendHtml(Text *html, const char *text);

/* Append a file's name as a relative address: "./" and the name, percent-encoded except for RFC 3986's
 * unreserved characters and '/'. So "javascript:x" and "//host/x" stay names of files. */
void textAppendFileAddress(Text *html, const char *fileName);

/* Append text for a terminal: bytes that are not UTF-8, control characters and those that turn the text's
 * direction become U+FFFD, so a name cannot move the cursor. Returns the number of characters appended. */
size_t textAppendPlain(Text *plain, const char *text);

/* Write bytes in base64 (RFC 4648, section 4), on one line, with padding. */
void writeBase64(FILE *stream, const void *data, size_t length);

#endif
