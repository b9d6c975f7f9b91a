/* text.c - growable text, and numbers as text; see text.h. */
#define _GNU_SOURCE
#include "base/text.h"

#include <float.h>
#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdint.h>
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

void textAppendRounded(Text *text, double value, int digits)
{
    char buffer[NUMBER_TEXT_SIZE];
    textAppend(text, formatRounded(buffer, value, digits));
}

void textAppendFixed(Text *text, double value, int decimals)
{
    if (!isfinite(value)) {
        textAppendDouble(text, value);
        return;
    }
    long long unit = 1;
    for (int i = 0; i < decimals; i++)
        unit *= 10;
    long long scaled = llround(value * (double)unit);
    textAppendFormat(text, "%s%lld", scaled < 0 ? "-" : "", llabs(scaled) / unit);
    if (decimals > 0)
        textAppendFormat(text, ".%0*lld", decimals, llabs(scaled) % unit);
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

/* Clinger 1990, "How to read floating point numbers accurately", section 3: an integer of at most 53 bits and
 * a power of ten up to 10^22 are both doubles without an error, so their product or quotient is rounded once,
 * and so correctly. */
bool parseShortDouble(const char *string, const char **end, double *value)
{
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    enum {
        LARGEST_POWER = sizeof powers / sizeof *powers - 1,
        MOST_DIGITS = 19,     /* fit into 64 bits */
        MOST_EXPONENT = 10000 /* far above what can be right; its digits are not added up beyond */
    };
    /* Where sums are kept in more than double precision they are rounded twice. */
    if (FLT_EVAL_METHOD != 0)
        return false;

    /* Read the digits; digits counts those from the first one that is not 0. */
    const char *s = string;
    bool isNegative = *s == '-';
    s += isNegative || *s == '+';
    if (s[0] == '0' && (s[1] == 'x' || s[1] == 'X'))
        return false;
    const char *start = s;
    uint64_t integer = 0;
    int digits = 0;
    for (; *s >= '0' && *s <= '9' && digits <= MOST_DIGITS; s++) {
        integer = 10 * integer + (uint64_t)(*s - '0');
        digits += digits > 0 || integer > 0;
    }
    bool anyDigit = s > start;
    int exponent = 0;
    if (*s == '.') {
        const char *fraction = ++s;
        for (; *s >= '0' && *s <= '9' && digits <= MOST_DIGITS; s++) {
            integer = 10 * integer + (uint64_t)(*s - '0');
            digits += digits > 0 || integer > 0;
        }
        if (s - fraction > MOST_EXPONENT)
            return false;
        anyDigit = anyDigit || s > fraction;
        exponent = -(int)(s - fraction);
    }
    if (!anyDigit || digits > MOST_DIGITS || integer > (UINT64_C(1) << 53))
        return false;

    /* Read the exponent; an e without digits is not part of the number. */
    if (*s == 'e' || *s == 'E') {
        const char *e = s + 1;
        bool isBelow = *e == '-';
        e += isBelow || *e == '+';
        int given = 0;
        bool isExponent = *e >= '0' && *e <= '9';
        for (; *e >= '0' && *e <= '9'; e++)
            given = given < MOST_EXPONENT ? 10 * given + (*e - '0') : given;
        if (isExponent) {
            exponent += isBelow ? -given : given;
            s = e;
        }
    }
    if (exponent < -LARGEST_POWER || exponent > LARGEST_POWER)
        return false;
    double magnitude = (double)integer;
    magnitude = exponent < 0 ? magnitude / powers[-exponent] : magnitude * powers[exponent];
    *value = isNegative ? -magnitude : magnitude;
    *end = s;
    return true;
}

double parseDouble(const char *string, char **end)
{
    double value;
    const char *behind;
    if (parseShortDouble(string, &behind, &value)) {
        if (end != NULL)
            *end = (char *)(uintptr_t)behind;
        return value;
    }
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

/* The value becomes an integer of so many digits and goes back by an exact power of ten, which gives the
 * double nearest to a short decimal; formatDouble finds that decimal. */
char *formatRounded(char buffer[NUMBER_TEXT_SIZE], double value, int digits)
{
    enum {
        EXACT_POWERS = 22 /* up to 10^22 the powers of ten are doubles */
    };
    if (value == 0)
        return formatDouble(buffer, 0);
    if (!isfinite(value))
        return formatDouble(buffer, value);
    int exponent = (int)floor(log10(fabs(value))) + 1 - digits;
    if (abs(exponent) > EXACT_POWERS)
        return formatDouble(buffer, value);
    double power = pow(10, abs(exponent));
    return formatDouble(buffer, exponent < 0 ? round(value * power) / power : round(value / power) * power);
}
