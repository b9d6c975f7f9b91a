/* text_cursor.c - read words and numbers from lines of text; see text_cursor.h. */
#include "shapes/text_cursor.h"

#include "base/text.h"

#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

TextCursor createTextCursor(const char *text, size_t length)
{
    size_t mark = length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    return (TextCursor){.next = text + mark, .end = text + length, .lineStart = text + mark, .line = 1};
}

static bool isLineEnd(char c)
{
    return c == '\n' || c == '\r';
}

static bool isBlank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/* Step over one line end, which is there. */
static void stepOverLineEnd(TextCursor *cursor)
{
    cursor->next += cursor->next[0] == '\r' && cursor->next[1] == '\n' ? 2 : 1;
    cursor->lineStart = cursor->next;
    if (cursor->line < INT_MAX)
        cursor->line++;
}

/* Whether a backslash is next that joins this line to the following one. */
static bool isContinuation(const TextCursor *cursor)
{
    return cursor->next[0] == '\\' && isLineEnd(cursor->next[1]);
}

bool nextWord(TextCursor *cursor, Word *word)
{
    /* Skip blanks and joined line ends. */
    while (isBlank(*cursor->next) || isContinuation(cursor)) {
        bool joined = !isBlank(*cursor->next);
        cursor->next++;
        if (joined)
            stepOverLineEnd(cursor);
    }
    if (cursor->next == cursor->end || isLineEnd(*cursor->next) || *cursor->next == '#')
        return false;

    *word = (Word){.start = cursor->next, .lineStart = cursor->lineStart, .line = cursor->line};
    while (cursor->next != cursor->end && !isBlank(*cursor->next) && !isLineEnd(*cursor->next) &&
           *cursor->next != '#' && !isContinuation(cursor))
        cursor->next++;
    word->length = (size_t)(cursor->next - word->start);
    return true;
}

bool nextLine(TextCursor *cursor)
{
    bool inComment = false;
    for (;;) {
        while (cursor->next != cursor->end && !isLineEnd(*cursor->next)) {
            inComment |= *cursor->next == '#';
            cursor->next++;
        }
        if (cursor->next == cursor->end)
            return false;
        /* A comment is never joined: one that ends with the name of a folder would swallow a line. */
        bool joined = !inComment && cursor->next > cursor->lineStart && cursor->next[-1] == '\\';
        stepOverLineEnd(cursor);
        if (!joined)
            return cursor->next != cursor->end;
    }
}

bool wordIs(const Word *word, const char *text)
{
    return strlen(text) == word->length && memcmp(word->start, text, word->length) == 0;
}

Status errorAtWord(const Word *word, size_t offset, const char *format, ...)
{
    char message[STATUS_MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);

    /* Count characters, not bytes: bytes 10xxxxxx go on with one. */
    int column = 1;
    for (const char *c = word->lineStart; c < word->start + offset && column < INT_MAX; c++)
        column += ((unsigned char)*c & 0xC0) != 0x80;
    return statusErrorAt(STATUS_SCENE, word->line, column, "%s", message);
}

const char *showWord(char buffer[SHOWN_WORD_SIZE], const Word *word)
{
    /* Keep what is plain ASCII, and say with dots that more follows. */
    size_t length = 0;
    for (size_t i = 0; i < word->length && length < SHOWN_WORD_SIZE - 4; i++)
        buffer[length++] = word->start[i] >= ' ' && word->start[i] <= '~' ? word->start[i] : '?';
    if (length < word->length) {
        memcpy(buffer + length, "...", 3);
        length += 3;
    }
    buffer[length] = '\0';
    return buffer;
}

Status wordToNumber(const Word *word, double largest, double *number)
{
    /* Let through only what decimal numbers are made of, not "nan", "inf" or "0x10". */
    char shown[SHOWN_WORD_SIZE];
    bool isDecimal = true;
    for (size_t i = 0; i < word->length && isDecimal; i++) {
        char c = word->start[i];
        isDecimal = (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E';
    }
    char *end = NULL;
    double value = isDecimal ? parseDouble(word->start, &end) : 0;
    if (!isDecimal || end != word->start + word->length)
        return errorAtWord(word, 0, "'%s' is not a number; write one like 1.5 or -2e-3.",
                           showWord(shown, word));
    if (!(fabs(value) <= largest))
        return errorAtWord(word, 0, "%s is too large; the largest allowed here is %.0e.",
                           showWord(shown, word), largest);
    *number = value;
    return statusOk();
}
