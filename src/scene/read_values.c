/* read_values.c - one value, from a node or from its default in the table; see read_values.h. */
#include "scene/read_values.h"

#include "scene/suggest.h"
#include "scene/yaml_scalar.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Reporting ---- */

void textAppendNode(Text *text, const YamlNode *node)
{
    if (node->kind == NODE_LIST || node->kind == NODE_MAPPING) {
        bool empty = node->count == 0;
        textAppend(text, node->kind == NODE_LIST ? empty ? "an empty list" : "a list"
                         : empty                 ? "an empty mapping"
                                                 : "a mapping");
        return;
    }
    ScalarValue value = readScalar(node->text, node->count, node->plain);
    if (value.type == SCALAR_NULL)
        textAppend(text, "empty");
    else if (value.type == SCALAR_TEXT)
        textAppendFormat(text, "the text '%s'", quoteBytes(node->text, node->count).text);
    else
        textAppend(text, quoteBytes(node->text, node->count).text);
}

static bool isOneOfWords(const YamlNode *value, const char *a, const char *b)
{
    return value->kind == NODE_SCALAR && (strcmp(value->text, a) == 0 || strcmp(value->text, b) == 0);
}

void reportWrongType(SceneReader *reader, const FormatKey *key, Place place, const YamlNode *value)
{
    Text message = {0}, hint = {0};
    textAppendFormat(&message, "'%s' must be ", key->name);
    textAppendExpectation(&message, key);
    textAppend(&message, ", but is ");
    textAppendNode(&message, value);
    if (key->type == FORMAT_BOOL && isOneOfWords(value, "yes", "on"))
        textAppend(&hint, "write true");
    else if (key->type == FORMAT_BOOL && isOneOfWords(value, "no", "off"))
        textAppend(&hint, "write false");
    else if (value->kind == NODE_SCALAR && value->count == 0)
        textAppend(&hint, key->type == FORMAT_KINDS ? "write [] for an empty list"
                                                    : "write its value behind the ':', or leave the key out");
    else if (key->type == FORMAT_MAPPING && value->kind == NODE_SCALAR && strchr(value->text, ':') != NULL)
        textAppend(&hint, "put a space behind the ':'");
    else if (key->type == FORMAT_KINDS && value->kind == NODE_MAPPING)
        textAppendFormat(&hint, "begin each %s with '- '", key->kinds->noun);
    else if (key->type == FORMAT_STEPS && value->kind == NODE_MAPPING)
        textAppendFormat(&hint, "begin each %s with '- '", key->mapping->name);
    else if (key->type == FORMAT_COLOR && key->count == 0 && value->kind == NODE_SCALAR)
        textAppend(&hint, "write how much red, green and blue it has, in brackets: red is [1, 0, 0]");
    else if ((key->type == FORMAT_POINT || key->type == FORMAT_DIRECTION) && key->count == 0 &&
             value->kind == NODE_SCALAR)
        textAppend(&hint, "write the three numbers in brackets, such as [0, 1, 0]");
    reportError(reader, place, hint.length > 0 ? hint.data : NULL, "%s", textString(&message));
    textFree(&message);
    textFree(&hint);
}

/* What a text that should be a number may be mended by, or NULL. */
static const char *numberHint(const YamlNode *value)
{
    if (value->kind != NODE_SCALAR)
        return NULL;
    const char *s = value->text;
    if (!value->plain) {
        ScalarValue inside = readScalar(s, value->count, true);
        bool isNumber = inside.type == SCALAR_INTEGER || inside.type == SCALAR_FLOAT;
        return isNumber ? "remove the quotes" : NULL;
    }
    s += *s == '-' || *s == '+';
    if (!(*s >= '0' && *s <= '9') && *s != '.')
        return NULL;
    const char *digits = s + strspn(s, "0123456789.");
    if (*digits == ',')
        return "write a point instead of the comma";
    if (*digits == '_' || *digits == '\'')
        return "write the digits without anything between them";
    if (*digits == '/' || *digits == '*')
        return "write the result; nothing is computed in a scene file";
    return "write the number alone, without a unit";
}

/* A value's name in messages: "'center'", or "the x of 'center'". */
typedef struct ValueName {
    char text[80];
} ValueName;

static ValueName nameValue(const FormatKey *key, const char *component)
{
    ValueName name;
    if (component == NULL)
        snprintf(name.text, sizeof name.text, "'%s'", key->name);
    else
        snprintf(name.text, sizeof name.text, "the %s of '%s'", component, key->name);
    return name;
}

/* ---- Numbers ---- */

/* Whether the number is one that the key can have; largest: what the type that stores it can hold. */
static bool isRightNumber(const FormatKey *key, const FormatRange *range, double largest,
                          const ScalarValue *scalar)
{
    bool hasType =
        scalar->type == SCALAR_INTEGER || (scalar->type == SCALAR_FLOAT && key->type != FORMAT_INTEGER);
    return hasType && isfinite(scalar->number) && fabs(scalar->number) <= largest &&
           isInFormatRange(range, scalar->number);
}

/* Report what is wrong with the number. */
static void reportWrongNumber(SceneReader *reader, const FormatKey *key, const char *component,
                              const FormatRange *range, double largest, Place place, const YamlNode *value,
                              const ScalarValue *scalar)
{
    ValueName name = nameValue(key, component);
    bool isNumber = scalar->type == SCALAR_INTEGER || scalar->type == SCALAR_FLOAT;
    bool wantsInteger = key->type == FORMAT_INTEGER;
    Text message = {0};
    const char *hint = NULL;
    if (!isNumber) {
        textAppendFormat(&message, "%s must be a %snumber", name.text, wantsInteger ? "whole " : "");
        if (range->low != LIMIT_NONE || range->high != LIMIT_NONE)
            textAppend(&message, " ");
        textAppendRange(&message, range);
        textAppend(&message, ", but is ");
        textAppendNode(&message, value);
        hint = numberHint(value);
    } else if (scalar->overflow || (isfinite(scalar->number) && fabs(scalar->number) > largest)) {
        textAppendFormat(&message, "%s is too large: %s is beyond ", name.text,
                         quoteBytes(value->text, value->count).text);
        textAppend(&message, largest < DBL_MAX ? "3.4e38" : "1.8e308");
        if (range->low != LIMIT_NONE || range->high != LIMIT_NONE) {
            textAppend(&message, "; it must be ");
            textAppendRange(&message, range);
        }
    } else if (!isfinite(scalar->number)) {
        textAppendFormat(&message, "%s must be an ordinary number, but is %s", name.text, value->text);
    } else if (wantsInteger && scalar->type != SCALAR_INTEGER) {
        textAppendFormat(&message, "%s needs a whole number, but is %s", name.text,
                         quoteBytes(value->text, value->count).text);
        hint = "write it without a decimal point";
    } else {
        textAppendFormat(&message, "%s must be ", name.text);
        textAppendRange(&message, range);
        textAppendFormat(&message, ", but is %s", quoteBytes(value->text, value->count).text);
    }
    reportError(reader, place, hint, "%s", textString(&message));
    textFree(&message);
}

/* Read a number of the key or, with component not NULL, of its list. */
static bool readNumber(SceneReader *reader, const FormatKey *key, const char *component,
                       const FormatRange *range, double largest, Place place, const YamlNode *value,
                       double *number)
{
    ScalarValue scalar = {.type = SCALAR_TEXT};
    if (value->kind == NODE_SCALAR)
        scalar = readScalar(value->text, value->count, value->plain);
    bool right = isRightNumber(key, range, largest, &scalar);
    if (right)
        *number = scalar.number;
    else
        reportWrongNumber(reader, key, component, range, largest, place, value, &scalar);
    return right;
}

/* Read as many numbers as there are components; each that is wrong is reported. */
static bool readNumbers(SceneReader *reader, const FormatKey *key, const char *const *components,
                        size_t count, const FormatRange *range, double largest, Place place,
                        const YamlNode *list, double *numbers)
{
    if (list->count != count) {
        bool noCommas =
            list->count == 1 && list->first->kind == NODE_SCALAR && strpbrk(list->first->text, " ;") != NULL;
        Text names = {0};
        for (size_t i = 0; i < count; i++)
            textAppendFormat(&names, "%s%s", i > 0 ? ", " : "", components[i]);
        reportError(reader, place, noCommas ? "put commas between the numbers" : NULL,
                    "'%s' needs %zu numbers [%s], but has %zu", key->name, count, textString(&names),
                    list->count);
        textFree(&names);
        return false;
    }
    bool right = true;
    const YamlNode *item = list->first;
    for (size_t i = 0; i < count; i++, item = item->next) {
        const YamlNode *value = resolveAlias(item);
        right = value != NULL &&
                readNumber(reader, key, components[i], range, largest, item->place, value, &numbers[i]) &&
                right;
    }
    return right;
}

static bool readVector(SceneReader *reader, const FormatKey *key, Place place, const YamlNode *value,
                       Vector3D *vector)
{
    static const char *const components[3] = {"x", "y", "z"};
    if (value->kind != NODE_LIST) {
        reportWrongType(reader, key, place, value);
        return false;
    }
    double v[3];
    if (!readNumbers(reader, key, components, 3, &key->range, DBL_MAX, place, value, v))
        return false;
    if (key->type == FORMAT_DIRECTION && v[0] == 0 && v[1] == 0 && v[2] == 0) {
        reportError(reader, place, "at least one of the three numbers must not be 0",
                    "'%s' has length 0 and so points nowhere", key->name);
        return false;
    }
    *vector = createVector(v[0], v[1], v[2]);
    return true;
}

/* Read factors that are not 0: three, or one for all. */
static bool readFactors(SceneReader *reader, const FormatKey *key, Place place, const YamlNode *value,
                        Vector3D *factors)
{
    static const char *const components[3] = {"x", "y", "z"};
    double f[3];
    if (value->kind == NODE_LIST) {
        if (!readNumbers(reader, key, components, 3, &anyRange, DBL_MAX, place, value, f))
            return false;
    } else if (value->kind == NODE_SCALAR) {
        if (!readNumber(reader, key, NULL, &anyRange, DBL_MAX, place, value, &f[0]))
            return false;
        f[1] = f[2] = f[0];
    } else {
        reportWrongType(reader, key, place, value);
        return false;
    }
    if (f[0] == 0 || f[1] == 0 || f[2] == 0) {
        reportError(reader, place, "use 1 for what stays as it is",
                    "'%s' must not be 0: that would squeeze the object flat", key->name);
        return false;
    }
    *factors = createVector(f[0], f[1], f[2]);
    return true;
}

bool readSphereRow(SceneReader *reader, const FormatKey *key, const YamlNode *rowNode, double numbers[4])
{
    static const char *const components[4] = {"x", "y", "z", "r"};
    const YamlNode *row = resolveAlias(rowNode);
    if (row == NULL)
        return false;
    if (row->kind != NODE_LIST) {
        Text what = {0};
        textAppendNode(&what, row);
        reportError(reader, rowNode->place, "write it as [x, y, z, r]",
                    "a sphere of '%s' must be a list of 4 numbers [x, y, z, r], but is %s", key->name,
                    textString(&what));
        textFree(&what);
        return false;
    }
    if (!readNumbers(reader, key, components, 4, &anyRange, DBL_MAX, rowNode->place, row, numbers))
        return false;
    if (!isInFormatRange(&key->range, numbers[3])) {
        /* Report it at its own place. */
        const YamlNode *radius = row->first->next->next->next;
        double unused;
        readNumber(reader, key, "r", &key->range, DBL_MAX, radius->place, resolveAlias(radius), &unused);
        return false;
    }
    return true;
}

bool takeSphereRow(const YamlNode *row, double numbers[4])
{
    const YamlNode *item = row->first;
    for (size_t i = 0; i < 4; i++, item = item->next) {
        if (item->kind != NODE_SCALAR)
            return false;
        ScalarValue scalar = readScalar(item->text, item->count, item->plain);
        if ((scalar.type != SCALAR_INTEGER && scalar.type != SCALAR_FLOAT) || !isfinite(scalar.number))
            return false;
        numbers[i] = scalar.number;
    }
    return isInFormatRange(&rowsFormatKey->range, numbers[3]);
}

static bool readColor(SceneReader *reader, const FormatKey *key, Place place, const YamlNode *value,
                      Color3f *color)
{
    static const char *const components[3] = {"r", "g", "b"};
    double c[3];
    if (value->kind == NODE_LIST) {
        if (!readNumbers(reader, key, components, 3, &colorRange, (double)FLT_MAX, place, value, c))
            return false;
    } else {
        ScalarValue scalar = {.type = SCALAR_TEXT};
        if (value->kind == NODE_SCALAR)
            scalar = readScalar(value->text, value->count, value->plain);
        if (scalar.type != SCALAR_INTEGER && scalar.type != SCALAR_FLOAT) {
            reportWrongType(reader, key, place, value);
            return false;
        }
        if (!readNumber(reader, key, NULL, &colorRange, (double)FLT_MAX, place, value, &c[0]))
            return false;
        c[1] = c[2] = c[0];
    }
    *color = createColor((float)c[0], (float)c[1], (float)c[2]);
    return true;
}

/* ---- Words ---- */

static bool readBool(SceneReader *reader, const FormatKey *key, Place place, const YamlNode *value,
                     bool *truth)
{
    ScalarValue scalar = {.type = SCALAR_TEXT};
    if (value->kind == NODE_SCALAR)
        scalar = readScalar(value->text, value->count, value->plain);
    if (scalar.type != SCALAR_BOOL) {
        reportWrongType(reader, key, place, value);
        return false;
    }
    *truth = scalar.truth;
    return true;
}

/* Store the choice with this word or number; false when it is none. */
static bool findChoice(const FormatKey *key, const YamlNode *value, int *choice)
{
    if (value->kind != NODE_SCALAR)
        return false;
    ScalarValue scalar = readScalar(value->text, value->count, value->plain);
    for (size_t i = 0; i < key->choiceCount; i++) {
        const FormatChoice *c = &key->choices[i];
        bool same = key->type == FORMAT_INTEGER
                        ? scalar.type == SCALAR_INTEGER && scalar.number == c->value
                        : strcmp(c->word, value->text) == 0 && strlen(c->word) == value->count;
        if (same) {
            *choice = c->value;
            return true;
        }
    }
    return false;
}

static bool readChoice(SceneReader *reader, const FormatKey *key, Place place, const YamlNode *value,
                       int *choice)
{
    if (findChoice(key, value, choice))
        return true;
    bool isWord =
        value->kind == NODE_SCALAR && readScalar(value->text, value->count, value->plain).type == SCALAR_TEXT;
    if (!isWord || key->type == FORMAT_INTEGER) {
        reportWrongType(reader, key, place, value);
        return false;
    }
    Suggestion suggestion = {.word = value->text, .length = value->count};
    for (size_t i = 0; i < key->choiceCount; i++)
        tryCandidate(&suggestion, key->choices[i].word);
    Text choices = {0};
    textAppendChoices(&choices, key);
    char hint[80];
    snprintf(hint, sizeof hint, "did you mean '%s'?", suggestion.best != NULL ? suggestion.best : "");
    reportError(reader, place, suggestion.best != NULL ? hint : NULL, "'%s' must be %s, but is '%s'",
                key->name, textString(&choices), quoteBytes(value->text, value->count).text);
    textFree(&choices);
    return false;
}

static bool readFile(SceneReader *reader, const FormatKey *key, Place place, const YamlNode *value,
                     const char **path)
{
    ScalarValue scalar = {.type = SCALAR_NULL};
    if (value->kind == NODE_SCALAR)
        scalar = readScalar(value->text, value->count, value->plain);
    if (scalar.type != SCALAR_TEXT || value->count == 0) {
        reportWrongType(reader, key, place, value);
        return false;
    }
    if (strlen(value->text) != value->count) {
        reportError(reader, place, NULL, "the path in '%s' holds a zero byte, which no path can", key->name);
        return false;
    }
    *path = value->text;
    return true;
}

/* ---- One value ---- */

static bool readOne(SceneReader *reader, const FormatKey *key, Place place, const YamlNode *value,
                    void *target)
{
    double number;
    switch (key->type) {
    case FORMAT_NUMBER:
        return readNumber(reader, key, NULL, &key->range, DBL_MAX, place, value, target);
    case FORMAT_FLOAT:
        if (!readNumber(reader, key, NULL, &key->range, (double)FLT_MAX, place, value, &number))
            return false;
        if (!isInFormatRange(&key->range, (double)(float)number)) {
            reportError(reader, place, NULL, "'%s' is too small: it would become 0", key->name);
            return false;
        }
        *(float *)target = (float)number;
        return true;
    case FORMAT_INTEGER:
        if (key->choiceCount > 0)
            return readChoice(reader, key, place, value, target);
        if (!readNumber(reader, key, NULL, &key->range, DBL_MAX, place, value, &number))
            return false;
        *(int *)target = (int)number;
        return true;
    case FORMAT_BOOL:
        return readBool(reader, key, place, value, target);
    case FORMAT_CHOICE:
        return readChoice(reader, key, place, value, target);
    case FORMAT_POINT:
    case FORMAT_DIRECTION:
        return readVector(reader, key, place, value, target);
    case FORMAT_FACTORS:
        return readFactors(reader, key, place, value, target);
    case FORMAT_COLOR:
        return readColor(reader, key, place, value, target);
    case FORMAT_FILE:
        return readFile(reader, key, place, value, target);
    case FORMAT_SPHERES:
    case FORMAT_MATERIAL:
    case FORMAT_MAPPING:
    case FORMAT_STEPS:
    case FORMAT_NAMED:
    case FORMAT_KINDS:
        break;
    }
    return false;
}

/* The bytes of one value of a key that has a count. */
static size_t sizeOfOne(const FormatKey *key)
{
    return key->type == FORMAT_INTEGER ? sizeof(int)
           : key->type == FORMAT_COLOR ? sizeof(Color3f)
                                       : sizeof(Vector3D);
}

bool readSimpleValue(SceneReader *reader, const FormatKey *key, Place place, const YamlNode *value,
                     void *target)
{
    if (key->count == 0)
        return readOne(reader, key, place, value, target);
    if (value->kind != NODE_LIST) {
        reportWrongType(reader, key, place, value);
        return false;
    }
    if (value->count != key->count) {
        Text expected = {0};
        textAppendExpectation(&expected, key);
        reportError(reader, place, NULL, "'%s' must be %s, but has %zu", key->name, textString(&expected),
                    value->count);
        textFree(&expected);
        return false;
    }
    FormatKey one = *key;
    one.count = 0;
    bool right = true;
    char *next = target;
    for (const YamlNode *item = value->first; item != NULL; item = item->next, next += sizeOfOne(key)) {
        const YamlNode *itemValue = resolveAlias(item);
        right = itemValue != NULL && readOne(reader, &one, item->place, itemValue, next) && right;
    }
    return right;
}

/* The numbers of a default: one, or those of a list [a, b, c]. */
static void readDefaultNumbers(const char *text, double numbers[3])
{
    if (*text != '[') {
        numbers[0] = numbers[1] = numbers[2] = parseDouble(text, NULL);
        return;
    }
    char *s = (char *)(uintptr_t)text;
    for (int i = 0; i < 3; i++)
        numbers[i] = parseDouble(s + 1, &s);
}

void storeDefault(const FormatKey *key, void *values)
{
    void *target = (char *)values + key->offset;
    if (key->type == FORMAT_MATERIAL) {
        *(Material *)target = defaultMaterial();
        return;
    }
    if (key->type == FORMAT_STEPS) {
        *(Matrix *)target = identityMatrix();
        return;
    }
    if (key->fallback == NULL) {
        if (key->type == FORMAT_NUMBER && key->optional)
            *(double *)target = NAN;
        return;
    }
    double n[3];
    switch (key->type) {
    case FORMAT_NUMBER:
        *(double *)target = parseDouble(key->fallback, NULL);
        break;
    case FORMAT_FLOAT:
        *(float *)target = (float)parseDouble(key->fallback, NULL);
        break;
    case FORMAT_INTEGER:
        *(int *)target = (int)parseDouble(key->fallback, NULL);
        break;
    case FORMAT_BOOL:
        *(bool *)target = *key->fallback == 't';
        break;
    case FORMAT_CHOICE:
        for (size_t i = 0; i < key->choiceCount; i++)
            if (strcmp(key->choices[i].word, key->fallback) == 0)
                *(int *)target = key->choices[i].value;
        break;
    case FORMAT_POINT:
    case FORMAT_DIRECTION:
    case FORMAT_FACTORS:
        readDefaultNumbers(key->fallback, n);
        *(Vector3D *)target = createVector(n[0], n[1], n[2]);
        break;
    case FORMAT_COLOR:
        readDefaultNumbers(key->fallback, n);
        *(Color3f *)target = createColor((float)n[0], (float)n[1], (float)n[2]);
        break;
    case FORMAT_FILE:
    case FORMAT_SPHERES:
    case FORMAT_MATERIAL:
    case FORMAT_MAPPING:
    case FORMAT_STEPS:
    case FORMAT_NAMED:
    case FORMAT_KINDS:
        break;
    }
}
