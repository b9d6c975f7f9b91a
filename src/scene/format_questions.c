/* format_questions.c - questions about the table of the format; see format_table.h. */
#include "scene/format_table.h"

#include <string.h>

static bool isName(const char *name, const char *text, size_t length)
{
    return strlen(name) == length && memcmp(name, text, length) == 0;
}

size_t findFormatKey(const FormatMapping *mapping, const char *name, size_t length)
{
    size_t i = 0;
    while (i < formatKeyCount(mapping) && !isName(formatKey(mapping, i)->name, name, length))
        i++;
    return i;
}

const FormatMapping *findFormatKind(const FormatKinds *kinds, const char *name, size_t length)
{
    for (size_t i = 0; i < kinds->count; i++)
        if (isName(kinds->kinds[i]->name, name, length))
            return kinds->kinds[i];
    return NULL;
}

bool isInFormatRange(const FormatRange *range, double value)
{
    bool lowOk =
        range->low == LIMIT_NONE || (range->low == LIMIT_INCLUDED ? value >= range->min : value > range->min);
    bool highOk = range->high == LIMIT_NONE ||
                  (range->high == LIMIT_INCLUDED ? value <= range->max : value < range->max);
    return lowOk && highOk;
}

void textAppendRange(Text *text, const FormatRange *range)
{
    if (range->low == LIMIT_INCLUDED && range->high == LIMIT_INCLUDED) {
        textAppend(text, "from ");
        textAppendDouble(text, range->min);
        textAppend(text, " to ");
        textAppendDouble(text, range->max);
        return;
    }
    if (range->low != LIMIT_NONE) {
        textAppend(text, range->low == LIMIT_INCLUDED ? "at least " : "above ");
        textAppendDouble(text, range->min);
    }
    if (range->high != LIMIT_NONE) {
        textAppend(text, range->low != LIMIT_NONE ? " and " : "");
        textAppend(text, range->high == LIMIT_INCLUDED ? "at most " : "below ");
        textAppendDouble(text, range->max);
    }
}

void textAppendChoices(Text *text, const FormatKey *key)
{
    for (size_t i = 0; i < key->choiceCount; i++)
        textAppendFormat(text, "%s%s",
                         i == 0                      ? ""
                         : i + 1 == key->choiceCount ? " or "
                                                     : ", ",
                         key->choices[i].word);
}

void textAppendShape(Text *text, const FormatMapping *mapping)
{
    textAppend(text, "{");
    for (size_t i = 0; i < formatKeyCount(mapping); i++)
        textAppendFormat(text, "%s%s", i == 0 ? "" : ", ", formatKey(mapping, i)->name);
    textAppend(text, "}");
}

/* Append what a list of so many values of the key's type is. */
static void appendCounted(Text *text, const FormatKey *key)
{
    textAppendFormat(text, "a list of %zu ", key->count);
    if (key->type == FORMAT_POINT || key->type == FORMAT_DIRECTION)
        textAppend(text,
                   key->type == FORMAT_POINT ? "points [[x, y, z], ...]" : "directions [[x, y, z], ...]");
    else if (key->type == FORMAT_COLOR)
        textAppend(text, "colours [a, b]");
    else
        textAppend(text, "whole numbers [n, m], each");
}

static void appendValue(Text *text, const FormatKey *key)
{
    switch (key->type) {
    case FORMAT_NUMBER:
    case FORMAT_FLOAT:
        textAppend(text, "a number");
        break;
    case FORMAT_INTEGER:
    case FORMAT_CHOICE:
        if (key->choiceCount > 0)
            textAppendChoices(text, key);
        else
            textAppend(text, "a whole number");
        break;
    case FORMAT_BOOL:
        textAppend(text, "true or false");
        break;
    case FORMAT_POINT:
    case FORMAT_DIRECTION:
        textAppend(text, "a list of 3 numbers [x, y, z]");
        break;
    case FORMAT_FACTORS:
        textAppend(text, "a list of 3 numbers [x, y, z], or one number for all three, none of them 0");
        break;
    case FORMAT_COLOR:
        textAppend(text, "a colour: a list of 3 numbers [r, g, b], or one number for a grey");
        if (key->mapping != NULL) {
            textAppend(text, "; or a mapping ");
            textAppendShape(text, key->mapping);
        }
        break;
    case FORMAT_FILE:
        textAppend(text, "the path of a file");
        break;
    case FORMAT_SPHERES:
        textAppend(text, "a list of spheres [x, y, z, r], r");
        break;
    case FORMAT_MATERIAL:
        textAppend(text, "the name of a material, or a mapping {key: value}");
        break;
    case FORMAT_MAPPING:
        textAppend(text, "a mapping {key: value}");
        break;
    case FORMAT_NAMED:
        textAppend(text, "a mapping {name: {key: value}}");
        break;
    case FORMAT_STEPS:
    case FORMAT_KINDS:
        textAppend(text, "a list");
        break;
    }
}

void textAppendExpectation(Text *text, const FormatKey *key)
{
    if (key->count > 0)
        appendCounted(text, key);
    else
        appendValue(text, key);
    if (key->range.low != LIMIT_NONE || key->range.high != LIMIT_NONE) {
        textAppend(text, " ");
        textAppendRange(text, &key->range);
    }
}
