/* reader.c - from nodes to values, as the table says; see reader.h. */
#include "scene/reader.h"

#include "scene/material_names.h"
#include "scene/read_values.h"
#include "scene/suggest.h"
#include "scene/yaml_scalar.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

SceneReader beginReader(Scene *scene, SourceText *source, Diagnostics *diagnostics, SceneFiles *files)
{
    return (SceneReader){.scene = scene,
                         .source = source,
                         .diagnostics = diagnostics,
                         .files = files,
                         .pendingUse = {.name = NAME_NONE}};
}

void freeReader(SceneReader *reader)
{
    freeNameTable(&reader->materialNames);
    free(reader->materials);
    free(reader->uses);
    free(reader->solidPlaces);
    free(reader->lightPlaces);
}

bool mustStop(const SceneReader *reader)
{
    return reader->outOfMemory || reader->interrupted;
}

void reportError(SceneReader *reader, Place place, const char *hint, const char *format, ...)
{
    char message[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    addDiagnostic(reader->diagnostics, reader->source, SEVERITY_ERROR, place, hint, message);
}

void reportKeyError(SceneReader *reader, GivenKeys *given, const char *key, const char *hint,
                    const char *format, ...)
{
    char message[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    reportError(reader, placeOfKey(given, key), hint, "%s", message);
    given->wrong[findFormatKey(given->format, key, strlen(key))] = true;
}

void *makeReaderRoom(SceneReader *reader, void *array, size_t count, size_t *capacity, size_t itemSize)
{
    if (count < *capacity)
        return array;
    size_t larger = *capacity < 16 ? 16 : *capacity + *capacity / 2;
    void *grown = realloc(array, larger * itemSize);
    if (grown == NULL)
        reader->outOfMemory = true;
    else
        *capacity = larger;
    return grown;
}

/* ---- Keys ---- */

bool isGiven(const GivenKeys *given, const char *name)
{
    size_t number = findFormatKey(given->format, name, strlen(name));
    return given->keys[number] != NULL && !given->wrong[number];
}

bool isUsable(const GivenKeys *given, const char *name)
{
    size_t number = findFormatKey(given->format, name, strlen(name));
    bool isThere = given->keys[number] != NULL || !isRequired(formatKey(given->format, number));
    return isThere && !given->wrong[number];
}

bool areAllUsable(const GivenKeys *given)
{
    for (size_t i = 0; i < formatKeyCount(given->format); i++)
        if (given->wrong[i] || (given->keys[i] == NULL && isRequired(formatKey(given->format, i))))
            return false;
    return true;
}

Place placeOfKey(const GivenKeys *given, const char *name)
{
    size_t number = findFormatKey(given->format, name, strlen(name));
    return given->keys[number] != NULL ? given->places[number] : given->place;
}

void beginMapping(const FormatMapping *format, Place place, GivenKeys *given, void *values)
{
    *given = (GivenKeys){.format = format, .place = place};
    for (size_t i = 0; i < formatKeyCount(format); i++)
        storeDefault(formatKey(format, i), values);
}

/* The hint for a word that is none of the candidates. */
static void appendNames(Text *hint, const Suggestion *suggestion, const char *what)
{
    if (suggestion->best != NULL)
        textAppendFormat(hint, "did you mean '%s'?", suggestion->best);
    else
        textAppendFormat(hint, "%s ", what);
}

/* Say where a key that is unknown at the top belongs; false when it belongs nowhere. */
static bool appendRightPlace(Text *hint, const YamlNode *keyNode)
{
    for (size_t i = 0; i < sceneFormat.keyCount; i++) {
        const FormatKey *section = &sceneFormat.keys[i];
        const FormatMapping *kind = section->type == FORMAT_KINDS
                                        ? findFormatKind(section->kinds, keyNode->text, keyNode->count)
                                        : NULL;
        bool isInside =
            section->type == FORMAT_MAPPING &&
            findFormatKey(section->mapping, keyNode->text, keyNode->count) < formatKeyCount(section->mapping);
        if (kind != NULL)
            textAppendFormat(hint, "write it as an item of '%s': - %s: {...}", section->name, kind->name);
        else if (isInside)
            textAppendFormat(hint, "it belongs in the section '%s'", section->name);
        if (kind != NULL || isInside)
            return true;
    }
    return false;
}

size_t reportUnknownKey(SceneReader *reader, const FormatMapping *format, const YamlNode *keyNode)
{
    Text hint = {0};
    if (keyNode->plain && keyNode->count == 2 && memcmp(keyNode->text, "<<", 2) == 0) {
        reportError(
            reader, keyNode->place,
            "write the keys out, or give the whole mapping an anchor (&name) and use it by its alias (*name)",
            "the merge key '<<' is not part of the scene format");
        return formatKeyCount(format);
    }
    Suggestion suggestion = {.word = keyNode->text, .length = keyNode->count};
    for (size_t i = 0; i < formatKeyCount(format); i++)
        tryCandidate(&suggestion, formatKey(format, i)->name);

    /* "fov 60" and "fov:60" are a key with its value. */
    size_t wordLength = strcspn(keyNode->text, " :");
    size_t key = findFormatKey(format, keyNode->text, wordLength);
    if (key < formatKeyCount(format)) {
        suggestion.best = formatKey(format, key)->name;
        textAppendFormat(&hint, "write it as %s: value, with a space behind the ':'", suggestion.best);
    } else if (keyNode->text[strspn(keyNode->text, "+-.")] >= '0' &&
               keyNode->text[strspn(keyNode->text, "+-.")] <= '9') {
        /* "{center: 0, 1, 0}" and "{radius: 1,5}" have numbers in the place of keys. */
        textAppend(&hint, "write a list in brackets, such as [0, 1, 0], and 1.5 with a point");
    } else if (suggestion.best != NULL || format != &sceneFormat || !appendRightPlace(&hint, keyNode)) {
        char what[80];
        snprintf(what, sizeof what, "the keys of '%s' are", format->name);
        appendNames(&hint, &suggestion, format == &sceneFormat ? "the sections of a scene are" : what);
        for (size_t i = 0; suggestion.best == NULL && i < formatKeyCount(format); i++)
            textAppendFormat(&hint, "%s%s", i > 0 ? ", " : "", formatKey(format, i)->name);
    }
    reportError(reader, keyNode->place, textString(&hint), "unknown key '%s'",
                quoteBytes(keyNode->text, keyNode->count).text);
    textFree(&hint);
    return suggestion.best != NULL ? findFormatKey(format, suggestion.best, strlen(suggestion.best))
                                   : formatKeyCount(format);
}

const YamlNode *keyWord(SceneReader *reader, const YamlNode *keyNode)
{
    const YamlNode *word = resolveAlias(keyNode);
    if (word == NULL)
        return NULL;
    if (word->kind != NODE_SCALAR) {
        reportError(reader, keyNode->place, "write it as key: value",
                    "a key must be a word, but this is a %s", word->kind == NODE_LIST ? "list" : "mapping");
        return NULL;
    }
    if (word->count == 0) {
        reportError(reader, keyNode->place, "write it as key: value", "there is no key before this ':'");
        return NULL;
    }
    return word;
}

void reportDuplicate(SceneReader *reader, Place place, const YamlNode *word, int firstLine)
{
    reportError(reader, place, "keep one of the two", "the key '%s' is given twice; the first is in line %d",
                quoteBytes(word->text, word->count).text, firstLine);
}

const FormatKey *acceptKey(SceneReader *reader, GivenKeys *given, const YamlNode *keyNode, size_t *number)
{
    const YamlNode *word = keyWord(reader, keyNode);
    if (word == NULL)
        return NULL;
    *number = findFormatKey(given->format, word->text, word->count);
    if (*number == formatKeyCount(given->format)) {
        /* The key that was probably meant is not missing too. */
        size_t meant = reportUnknownKey(reader, given->format, word);
        given->anyUnknown = true;
        if (meant < formatKeyCount(given->format))
            given->wrong[meant] = true;
        return NULL;
    }
    if (given->keys[*number] != NULL) {
        reportDuplicate(reader, keyNode->place, word, given->keys[*number]->place.line);
        return NULL;
    }
    for (size_t i = 0; given->format->oneKey != NULL && i < formatKeyCount(given->format); i++) {
        if (given->keys[i] == NULL)
            continue;
        reportError(reader, keyNode->place, given->format->oneKey,
                    "this %s has a key already, '%s' in line %d, and can have only one", given->format->name,
                    formatKey(given->format, i)->name, given->keys[i]->place.line);
        return NULL;
    }
    given->keys[*number] = keyNode;
    given->places[*number] = keyNode->place;

    /* Refuse the second of two keys that cannot stand together. */
    const FormatKey *key = formatKey(given->format, *number);
    size_t other = key->excludes != NULL ? findFormatKey(given->format, key->excludes, strlen(key->excludes))
                                         : formatKeyCount(given->format);
    if (key->excludes != NULL && given->keys[other] != NULL) {
        reportError(reader, keyNode->place, "keep one of the two",
                    "'%s' and '%s' cannot stand together; '%s' is in line %d", key->excludes, key->name,
                    key->excludes, given->keys[other]->place.line);
        given->wrong[*number] = true;
        given->wrong[other] = true;
    }
    return key;
}

/* ---- Values ---- */

void readMapping(SceneReader *reader, const FormatMapping *format, Place place, const YamlNode *node,
                 void *target)
{
    union {
        max_align_t align;
        char bytes[FORMAT_MAX_VALUES];
    } own;
    void *values = format->valuesSize > 0 ? own.bytes : target;
    if (format->valuesSize > 0)
        memset(own.bytes, 0, format->valuesSize);
    GivenKeys given;
    beginMapping(format, place, &given, values);
    for (const YamlNode *keyNode = node->first; keyNode != NULL; keyNode = keyNode->next->next) {
        size_t number;
        const FormatKey *key = acceptKey(reader, &given, keyNode, &number);
        if (key != NULL && key->type != FORMAT_KINDS)
            readValue(reader, &given, number, keyNode->next, values);
    }
    if (format->enter != NULL)
        format->enter(reader, &given, values);
    for (size_t i = 0; i < formatKeyCount(format); i++)
        if (given.keys[i] != NULL && formatKey(format, i)->type == FORMAT_KINDS)
            readValue(reader, &given, i, given.keys[i]->next, values);
    endMapping(reader, &given, values, target);
}

static bool readMaterial(SceneReader *reader, const FormatKey *key, Place place, const YamlNode *value,
                         Material *target)
{
    if (value->kind == NODE_MAPPING) {
        readMapping(reader, key->mapping, place, value, target);
        return true;
    }
    ScalarValue scalar = {.type = SCALAR_NULL};
    if (value->kind == NODE_SCALAR)
        scalar = readScalar(value->text, value->count, value->plain);
    if (scalar.type != SCALAR_TEXT) {
        reportWrongType(reader, key, place, value);
        return false;
    }
    size_t name = materialNumber(reader, value->text, value->count);
    reader->pendingUse = (MaterialUse){.name = name, .place = place};
    return name != NAME_NONE;
}

/* Read a list of steps, each a mapping; all have the same target. */
static bool readSteps(SceneReader *reader, const FormatKey *key, const YamlNode *list, void *target)
{
    size_t errors = reader->diagnostics->errors;
    for (const YamlNode *itemNode = list->first; itemNode != NULL; itemNode = itemNode->next) {
        const YamlNode *item = resolveAlias(itemNode);
        if (item == NULL)
            continue;
        if (item->kind == NODE_MAPPING) {
            readMapping(reader, key->mapping, itemNode->place, item, target);
            continue;
        }
        Text what = {0}, hint = {0};
        textAppendNode(&what, item);
        textAppendFormat(&hint, "write it as - %s: ...", formatKey(key->mapping, 0)->name);
        reportError(reader, itemNode->place, textString(&hint),
                    "a %s of '%s' must be a mapping with one key, but is %s", key->mapping->name, key->name,
                    textString(&what));
        textFree(&what);
        textFree(&hint);
    }
    return reader->diagnostics->errors == errors;
}

/* Read a list of kinds that is a tree already. */
static void readKinds(SceneReader *reader, const FormatKey *key, const char *owner, Place place,
                      const YamlNode *list)
{
    for (const YamlNode *item = list->first; item != NULL && !mustStop(reader); item = item->next)
        readKindItem(reader, key->kinds, item);
    if (list->count < key->least)
        reportError(reader, place, NULL, "'%s' of a %s needs at least %zu %s%s, but has %zu", key->name,
                    owner, key->least, key->kinds->noun, key->least > 1 ? "s" : "", list->count);
}

/* Whether the node is what the key's type is read from; what is not is reported. */
static bool hasRightKind(SceneReader *reader, const FormatKey *key, Place place, const YamlNode *value)
{
    bool right = true;
    if (key->type == FORMAT_MAPPING || key->type == FORMAT_NAMED)
        right = value->kind == NODE_MAPPING;
    else if (key->type == FORMAT_KINDS || key->type == FORMAT_STEPS || key->type == FORMAT_SPHERES)
        right = value->kind == NODE_LIST;
    if (!right)
        reportWrongType(reader, key, place, value);
    return right;
}

void readValue(SceneReader *reader, GivenKeys *given, size_t number, const YamlNode *valueNode, void *values)
{
    const FormatKey *key = formatKey(given->format, number);
    const YamlNode *value = resolveAlias(valueNode);
    void *target = (char *)values + key->offset;
    if (value == NULL) {
        given->wrong[number] = true;
        return;
    }

    /* Nothing has no place to show: show the key. */
    bool isEmpty = value->kind == NODE_SCALAR && value->count == 0 && value->plain;
    Place place = isEmpty ? given->keys[number]->place : valueNode->place;
    given->places[number] = place;
    if (!hasRightKind(reader, key, place, value)) {
        given->wrong[number] = true;
        return;
    }
    bool right = true;
    switch (key->type) {
    case FORMAT_MAPPING:
        readMapping(reader, key->mapping, given->keys[number]->place, value, target);
        break;
    case FORMAT_NAMED:
        readNamedMaterials(reader, key, value);
        break;
    case FORMAT_MATERIAL:
        right = readMaterial(reader, key, place, value, target);
        break;
    case FORMAT_STEPS:
        right = readSteps(reader, key, value, target);
        break;
    case FORMAT_SPHERES:
        *(const YamlNode **)target = value;
        break;
    case FORMAT_KINDS:
        readKinds(reader, key, given->format->name, place, value);
        break;
    case FORMAT_NUMBER:
    case FORMAT_FLOAT:
    case FORMAT_INTEGER:
    case FORMAT_BOOL:
    case FORMAT_CHOICE:
    case FORMAT_POINT:
    case FORMAT_DIRECTION:
    case FORMAT_FACTORS:
    case FORMAT_FILE:
        right = readSimpleValue(reader, key, place, value, target);
        break;
    case FORMAT_COLOR:
        if (key->mapping != NULL && value->kind == NODE_MAPPING)
            readMapping(reader, key->mapping, given->keys[number]->place, value, target);
        else
            right = readSimpleValue(reader, key, place, value, target);
        break;
    }
    given->wrong[number] = given->wrong[number] || !right;
}

/* A mapping of which one key must be there has none, or a wrong one, which was reported. */
static void reportNoKey(SceneReader *reader, const GivenKeys *given)
{
    Text names = {0};
    for (size_t i = 0; i < formatKeyCount(given->format); i++)
        textAppendFormat(&names, "%s%s",
                         i == 0                                   ? ""
                         : i + 1 == formatKeyCount(given->format) ? " or "
                                                                  : ", ",
                         formatKey(given->format, i)->name);
    reportError(reader, given->place, NULL, "this %s is empty; it must have one key: %s", given->format->name,
                textString(&names));
    textFree(&names);
}

void endMapping(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    const FormatMapping *format = given->format;
    bool anyGiven = given->anyUnknown;
    for (size_t i = 0; i < formatKeyCount(format); i++)
        anyGiven = anyGiven || given->keys[i] != NULL;
    if (format->oneKey != NULL && !anyGiven)
        reportNoKey(reader, given);
    for (size_t i = 0; i < formatKeyCount(format); i++) {
        const FormatKey *key = formatKey(format, i);
        if (!isRequired(key) || given->keys[i] != NULL || given->wrong[i])
            continue;
        Text hint = {0};
        textAppendFormat(&hint, "add %s: ", key->name);
        textAppendExpectation(&hint, key);
        reportError(reader, given->place, textString(&hint), "this %s has no '%s'", format->name, key->name);
        textFree(&hint);
    }
    if (format->finish != NULL)
        format->finish(reader, given, values, target);
}

/* ---- Items ---- */

void readKindItem(SceneReader *reader, const FormatKinds *kinds, const YamlNode *itemNode)
{
    const YamlNode *item = resolveAlias(itemNode);
    if (item == NULL)
        return;
    char hint[160];
    const char *exampleKind = kinds->kinds[0]->name;
    if (item->kind != NODE_MAPPING || item->count == 0) {
        Text what = {0};
        textAppendNode(&what, item);
        snprintf(hint, sizeof hint, "write it as - %s: {...}", exampleKind);
        reportError(reader, itemNode->place, hint,
                    "an item of this list must be a mapping with one key, the kind "
                    "of the %s, but is %s",
                    kinds->noun, textString(&what));
        textFree(&what);
        return;
    }
    const YamlNode *keyNode = item->first;
    if (item->count > 1) {
        /* The usual slip: what belongs to the kind is not indented below it. */
        const YamlNode *second = keyNode->next->next;
        snprintf(hint, sizeof hint, "begin each %s with '- ', and indent its keys below its kind",
                 kinds->noun);
        reportError(reader, second->place, hint,
                    "an item of this list has one key, the kind of the %s; this is "
                    "a second one",
                    kinds->noun);
        return;
    }
    const YamlNode *word = keyWord(reader, keyNode);
    if (word == NULL)
        return;
    const FormatMapping *kind = findFormatKind(kinds, word->text, word->count);
    if (kind == NULL) {
        Suggestion suggestion = {.word = word->text, .length = word->count};
        Text names = {0};
        for (size_t i = 0; i < kinds->count; i++)
            tryCandidate(&suggestion, kinds->kinds[i]->name);
        snprintf(hint, sizeof hint, "the kinds of %s are", kinds->noun);
        appendNames(&names, &suggestion, hint);
        for (size_t i = 0; suggestion.best == NULL && i < kinds->count; i++)
            textAppendFormat(&names, "%s%s", i > 0 ? ", " : "", kinds->kinds[i]->name);
        reportError(reader, keyNode->place, textString(&names), "unknown %s '%s'", kinds->noun,
                    quoteBytes(word->text, word->count).text);
        textFree(&names);
        return;
    }
    const YamlNode *value = resolveAlias(keyNode->next);
    if (value == NULL)
        return;
    if (value->kind != NODE_MAPPING) {
        Text what = {0};
        textAppendNode(&what, value);
        snprintf(hint, sizeof hint, "write it as - %s: {%s: ...}", kind->name, kind->keys[0].name);
        reportError(reader, value->count == 0 ? keyNode->place : keyNode->next->place, hint,
                    "'%s' must be a mapping {key: value}, but is %s", kind->name, textString(&what));
        textFree(&what);
        return;
    }
    reader->pendingUse.name = NAME_NONE;
    readMapping(reader, kind, keyNode->place, value, NULL);
}

void addReadLight(SceneReader *reader, const GivenKeys *given, Light light)
{
    size_t number = reader->scene->lightCount;
    Place *places =
        makeReaderRoom(reader, reader->lightPlaces, number, &reader->lightPlaceCapacity, sizeof *places);
    if (places == NULL)
        return;
    reader->lightPlaces = places;
    places[number] = given->place;
    if (!addLightToScene(reader->scene, light))
        reader->outOfMemory = true;
}
