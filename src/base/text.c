/* text.c - growable text, and numbers as text; see text.h. */
#define _GNU_SOURCE
#include "base/text.h"

#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Make room for extra bytes and the NUL; doubles the capacity, so appending is linear in all. */
static bool reserve(Text *text, size_t extra)
{
    if (text->failed)
        return false;
    size_t needed = text->length + extra + 1;
    if (needed < extra)
        text->failed = true;
    if (!text->failed && needed > text->capacity) {
        size_t capacity = text->capacity * 2 > needed ? text->capacity * 2 : needed;
        if (capacity < 64)
            capacity = 64;
        char *data = realloc(text->data, capacity);
        if (data == NULL) {
            text->failed = true;
        } else {
            text->data = data;
            text->capacity = capacity;
        }
    }
    return !text->failed;
}

void textAppendBytes(Text *text, const void *bytes, size_t length)
{
    if (length == 0 || !reserve(text, length))
        return;
    memcpy(text->data + text->length, bytes, length);
    text->length += length;
    text->data[text->length] = '\0';
}

void textAppend(Text *text, const char *string)
{
    textAppendBytes(text, string, strlen(string));
}

void textAppendFormat(Text *text, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    va_list again;
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (length >= 0 && reserve(text, (size_t)length)) {
        vsnprintf(text->data + text->length, (size_t)length + 1, format, again);
        text->length += (size_t)length;
    }
    va_end(again);
}

void textAppendDouble(Text *text, double value)
{
    char buffer[NUMBER_TEXT_SIZE];
    textAppend(text, formatDouble(buffer, value));
}

const char *textString(const Text *text)
{
    return text->data != NULL ? text->data : "";
}

void textFree(Text *text)
{
    free(text->data);
    *text = (Text){0};
}

size_t utf8Length(const char *string)
{
    const unsigned char *s = (const unsigned char *)string;
    if (s[0] < 0x80)
        return 1;
    size_t length = s[0] >= 0xF0 ? 4 : s[0] >= 0xE0 ? 3 : 2;
    if (s[0] < 0xC2 || s[0] > 0xF4)
        return 0;
    for (size_t i = 1; i < length; i++)
        if ((s[i] & 0xC0) != 0x80)
            return 0;
    bool overlong = (s[0] == 0xE0 && s[1] < 0xA0) || (s[0] == 0xF0 && s[1] < 0x90);
    bool surrogate = s[0] == 0xED && s[1] > 0x9F;
    bool tooLarge = s[0] == 0xF4 && s[1] > 0x8F;
    return overlong || surrogate || tooLarge ? 0 : length;
}

/* The C locale, made once; (locale_t)0 where memory ran out, and then the thread's own is used. */
static locale_t cLocale;
static pthread_once_t cLocaleOnce = PTHREAD_ONCE_INIT;

static void makeCLocale(void)
{
    cLocale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
}

double parseDouble(const char *string, char **end)
{
    pthread_once(&cLocaleOnce, makeCLocale);
    return cLocale != (locale_t)0 ? strtod_l(string, end, cLocale) : strtod(string, end);
}

/* Print with as few digits as read back to the same value: between fewest and most. */
static char *formatShortest(char buffer[NUMBER_TEXT_SIZE], double value, int fewest, int most, bool isFloat)
{
    if (isnan(value))
        return strcpy(buffer, "nan");
    if (isinf(value))
        return strcpy(buffer, value > 0 ? "inf" : "-inf");
    pthread_once(&cLocaleOnce, makeCLocale);
    locale_t before = cLocale != (locale_t)0 ? uselocale(cLocale) : (locale_t)0;
    for (int digits = fewest; digits <= most; digits++) {
        snprintf(buffer, NUMBER_TEXT_SIZE, "%.*g", digits, value);
        double back = strtod(buffer, NULL);
        if (isFloat ? (float)back == (float)value : back == value)
            break;
    }
    if (before != (locale_t)0)
        uselocale(before);
    return buffer;
}

char *formatDouble(char buffer[NUMBER_TEXT_SIZE], double value)
{
    return formatShortest(buffer, value, 15, 17, false);
}

char *formatFloat(char buffer[NUMBER_TEXT_SIZE], float value)
{
    return formatShortest(buffer, (double)value, 6, 9, true);
}
