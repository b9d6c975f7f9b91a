/* yaml_scalar.c - what a word in a YAML file means; see yaml_scalar.h. */
#include "scene/yaml_scalar.h"

#include "base/text.h"

#include <math.h>
#include <string.h>

static bool isOneOf(const char *text, size_t length, const char *const *words)
{
    for (; *words != NULL; words++)
        if (strlen(*words) == length && memcmp(*words, text, length) == 0)
            return true;
    return false;
}

static bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

/* The value of a digit up to base 16, or 16. */
static int digitValue(char c)
{
    if (isDigit(c))
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : 16;
}

/* 0o[0-7]+ and 0x[0-9a-fA-F]+. */
static bool readBasedInteger(const char *text, size_t length, double *number)
{
    if (length < 3 || text[0] != '0' || (text[1] != 'o' && text[1] != 'x'))
        return false;
    int base = text[1] == 'o' ? 8 : 16;
    *number = 0;
    for (size_t i = 2; i < length; i++) {
        int digit = digitValue(text[i]);
        if (digit >= base)
            return false;
        *number = *number * base + digit;
    }
    return true;
}

/* Whether it is [-+]? ( \. [0-9]+ | [0-9]+ ( \. [0-9]* )? ) ( [eE] [-+]? [0-9]+ )?, and whether without
 * point and exponent. */
static bool isDecimal(const char *s, bool *isInteger)
{
    *isInteger = true;
    if (*s == '-' || *s == '+')
        s++;
    const char *start = s;
    while (isDigit(*s))
        s++;
    size_t digits = (size_t)(s - start);
    if (*s == '.') {
        *isInteger = false;
        const char *fraction = ++s;
        while (isDigit(*s))
            s++;
        digits += (size_t)(s - fraction);
    }
    if (digits == 0)
        return false;
    if (*s == 'e' || *s == 'E') {
        *isInteger = false;
        s++;
        if (*s == '-' || *s == '+')
            s++;
        if (!isDigit(*s))
            return false;
        while (isDigit(*s))
            s++;
    }
    return *s == '\0';
}

/* Whether a decimal number has neither point nor exponent. */
static bool isWhole(const char *s, const char *end)
{
    while (s < end && *s != '.' && *s != 'e' && *s != 'E')
        s++;
    return s == end;
}

ScalarValue readScalar(const char *text, size_t length, bool plain)
{
    static const char *const nulls[] = {"", "~", "null", "Null", "NULL", NULL};
    static const char *const truths[] = {"true", "True", "TRUE", NULL};
    static const char *const falsehoods[] = {"false", "False", "FALSE", NULL};
    static const char *const infinities[] = {".inf", ".Inf", ".INF", NULL};
    static const char *const notNumbers[] = {".nan", ".NaN", ".NAN", NULL};
    ScalarValue value = {.type = SCALAR_TEXT};
    if (!plain)
        return value;

    /* Numbers first: they are what a scene is full of, and most are short. */
    const char *end;
    if (parseShortDouble(text, &end, &value.number) && end == text + length) {
        value.type = isWhole(text, end) ? SCALAR_INTEGER : SCALAR_FLOAT;
        return value;
    }
    value.number = 0;
    bool isInteger;
    if (strlen(text) != length)
        return value;
    if (isDecimal(text, &isInteger)) {
        value.type = isInteger ? SCALAR_INTEGER : SCALAR_FLOAT;
        value.number = parseDouble(text, NULL);
    } else if (readBasedInteger(text, length, &value.number)) {
        value.type = SCALAR_INTEGER;
    } else if (isOneOf(text, length, nulls)) {
        value.type = SCALAR_NULL;
    } else if (isOneOf(text, length, truths) || isOneOf(text, length, falsehoods)) {
        value.type = SCALAR_BOOL;
        value.truth = *text == 't' || *text == 'T';
    } else if (isOneOf(text, length, notNumbers)) {
        value.type = SCALAR_FLOAT;
        value.number = NAN;
    } else {
        bool isSigned = *text == '-' || *text == '+';
        if (isOneOf(text + isSigned, length - isSigned, infinities)) {
            value.type = SCALAR_FLOAT;
            value.number = *text == '-' ? -INFINITY : INFINITY;
        }
        return value;
    }
    value.overflow = (value.type == SCALAR_INTEGER || value.type == SCALAR_FLOAT) && isinf(value.number);
    return value;
}
