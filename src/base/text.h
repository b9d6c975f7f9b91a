/* text.h - growable text, and numbers as text.
 *
 * Invariant: a Text that was initialised by textInit or {0} is either valid (data is a NUL-terminated
 * string of length bytes, or NULL when empty) or failed (out of memory): a failed Text ignores every
 * append, so that a writer checks once at the end.
 * Numbers are written and read the same in every locale.
 */
#ifndef ECLAIRAGE_BASE_TEXT_H
#define ECLAIRAGE_BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>

typedef struct Text {
    char *data;
    size_t length, capacity;
    bool failed;
} Text;

/* Append bytes, a string, or a printf-style text (which must not contain floating-point
 * conversions: they follow the locale; use textAppendDouble). */
void textAppendBytes(Text *text, const void *bytes, size_t length);
void textAppend(Text *text, const char *string);
void textAppendFormat(Text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Append the shortest decimal number that reads back as exactly this double; "nan", "inf", "-inf"
 * for what is not finite. */
void textAppendDouble(Text *text, double value);

/* Append the value rounded to so many significant digits, 1 to 17, as short as that can be: "0.0123",
 * "120000", "4.58e-05"; "0" for both zeros; "nan", "inf", "-inf". */
void textAppendRounded(Text *text, double value, int digits);

/* Append the value rounded to so many digits behind the point, 0 to 9: "-0.5000"; no minus where that is
 * zero; below 10^9. "nan", "inf", "-inf". */
void textAppendFixed(Text *text, double value, int decimals);

/* The string, never NULL; owned by the text. */
const char *textString(const Text *text);

/* Free it and make it empty again. */
void textFree(Text *text);

/* The length in bytes of the valid UTF-8 character at the start of a NUL-terminated string, or 0 where there
 * is none (RFC 3629, section 4). */
size_t utf8Length(const char *string);

enum {
    NUMBER_TEXT_SIZE = 32
};

/* What textAppendDouble appends, into a buffer of NUMBER_TEXT_SIZE bytes. Returns buffer. */
char *formatDouble(char buffer[NUMBER_TEXT_SIZE], double value);

/* What textAppendRounded appends. */
char *formatRounded(char buffer[NUMBER_TEXT_SIZE], double value, int digits);

/* The shortest decimal number that reads back as exactly this float. */
char *formatFloat(char buffer[NUMBER_TEXT_SIZE], float value);

/* Read a decimal number as strtod does in the C locale: correctly rounded; *end is set behind it, or
 * to string where there is none. Out of range gives +-HUGE_VAL or a value near 0, as strtod. */
double parseDouble(const char *string, char **end);

/* Read a decimal number, [+-] digits [. digits] [e [+-] digits] with at least one digit before the e, where
 * that is quick: up to 2^53 in its digits, and powers of ten up to 22. The result is parseDouble's. False,
 * with nothing stored, for all that is longer or no such number. */
bool parseShortDouble(const char *string, const char **end, double *value);

#endif
