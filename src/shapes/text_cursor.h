/* text_cursor.h - read words and numbers from lines of text, and know the place of each.
 *
 * A line ends with LF, CR LF or CR. `#` begins a comment up to the end of the line; a backslash at the end
 * of a line lets it go on in the next. Words are what blanks separate.
 */
#ifndef ECLAIRAGE_SHAPES_TEXT_CURSOR_H
#define ECLAIRAGE_SHAPES_TEXT_CURSOR_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct TextCursor {
    const char *next, *end; /* the text has a NUL at end */
    const char *lineStart;
    int line; /* from 1 */
} TextCursor;

/* A word in the text, with its place. */
typedef struct Word {
    const char *start;
    size_t length;
    const char *lineStart;
    int line;
} Word;

/* text: of length bytes with a NUL behind; it is not copied. A byte order mark is skipped. */
TextCursor createTextCursor(const char *text, size_t length);

/* The next word of this line; false at its end. */
bool nextWord(TextCursor *cursor, Word *word);

/* Skip what is left of this line; false where there is no further one. */
bool nextLine(TextCursor *cursor);

bool wordIs(const Word *word, const char *text);

/* The word as a finite decimal number of magnitude at most largest. Else STATUS_SCENE, with its place. */
Status wordToNumber(const Word *word, double largest, double *number);

/* A STATUS_SCENE with the place of the word, offset bytes into it; the message is printf-style. */
Status errorAtWord(const Word *word, size_t offset, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Begin of a message: a printable copy of the word, cut where it is long. Returns buffer. */
enum {
    SHOWN_WORD_SIZE = 48
};
const char *showWord(char buffer[SHOWN_WORD_SIZE], const Word *word);

#endif
