/* write_schema.c - the JSON Schema of the scene format, from the table.
 *
 * Draft 07 (json-schema.org/draft-07), the newest that editors' YAML support knows. What a schema cannot
 * say, such as that a material is defined, only the loader checks. Mappings that are used in several places
 * are definitions, so that formats that contain themselves can be written too.
 */
#include "scene/load.h"

#include "base/json.h"
#include "scene/format_table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void writeKeySchema(JsonWriter *json, const FormatKey *key);

static void writeReference(JsonWriter *json, const char *definition)
{
    char path[80];
    snprintf(path, sizeof path, "#/definitions/%s", definition);
    jsonInlineObject(json);
    jsonKeyString(json, "$ref", path);
    jsonEndObject(json);
}

/* The help, the words of the choices explained. */
static void writeDescription(JsonWriter *json, const FormatKey *key)
{
    Text text = {0};
    textAppend(&text, key->help);
    for (size_t i = 0; i < key->choiceCount; i++)
        textAppendFormat(&text, "%s%s: %s", i == 0 ? ". " : "; ", key->choices[i].word, key->choices[i].help);
    if (key->otherwise != NULL)
        textAppendFormat(&text, ". Left out: %s", key->otherwise);
    jsonKeyString(json, "description", textString(&text));
    json->text->failed = json->text->failed || text.failed;
    textFree(&text);
}

/* The default as JSON; a list of numbers, a number and a truth are written as in YAML. */
static void writeDefault(JsonWriter *json, const FormatKey *key)
{
    if (key->fallback == NULL)
        return;
    jsonKey(json, "default");
    if (key->type == FORMAT_CHOICE) {
        jsonString(json, key->fallback);
    } else if (key->type == FORMAT_BOOL) {
        jsonBool(json, *key->fallback == 't');
    } else if (*key->fallback == '{') {
        jsonInlineObject(json);
        jsonEndObject(json);
    } else if (*key->fallback == '[') {
        jsonInlineArray(json);
        for (const char *s = key->fallback + 1; *s != ']' && *s != '\0';) {
            char *end;
            jsonNumber(json, parseDouble(s, &end));
            s = *end == ',' ? end + 1 : end;
        }
        jsonEndArray(json);
    } else {
        jsonNumber(json, parseDouble(key->fallback, NULL));
    }
}

static void writeRange(JsonWriter *json, const FormatRange *range)
{
    if (range->low != LIMIT_NONE)
        jsonKeyNumber(json, range->low == LIMIT_INCLUDED ? "minimum" : "exclusiveMinimum", range->min);
    if (range->high != LIMIT_NONE)
        jsonKeyNumber(json, range->high == LIMIT_INCLUDED ? "maximum" : "exclusiveMaximum", range->max);
}

/* A list of so many items, each as the caller writes it between these two. */
static void beginItems(JsonWriter *json)
{
    jsonKeyString(json, "type", "array");
    jsonKey(json, "items");
    jsonObject(json);
}

static void endItems(JsonWriter *json, size_t count)
{
    jsonEndObject(json);
    jsonKeyInteger(json, "minItems", (int64_t)count);
    jsonKeyInteger(json, "maxItems", (int64_t)count);
}

/* A list of three numbers in a range. */
static void writeThreeNumbers(JsonWriter *json, const FormatRange *range)
{
    jsonKeyString(json, "type", "array");
    jsonKey(json, "items");
    jsonInlineObject(json);
    jsonKeyString(json, "type", "number");
    writeRange(json, range);
    jsonEndObject(json);
    jsonKeyInteger(json, "minItems", 3);
    jsonKeyInteger(json, "maxItems", 3);
}

/* Not all numbers 0. */
static void writeNotZero(JsonWriter *json)
{
    jsonKey(json, "not");
    jsonInlineObject(json);
    jsonKey(json, "items");
    jsonInlineObject(json);
    jsonKeyInteger(json, "const", 0);
    jsonEndObject(json);
    jsonEndObject(json);
}

static void writeMapping(JsonWriter *json, const FormatMapping *mapping);

/* Three numbers, one, or what mapping says where it is not NULL. */
static void writeColor(JsonWriter *json, const FormatMapping *mapping)
{
    jsonKey(json, "anyOf");
    jsonArray(json);
    if (mapping != NULL) {
        jsonObject(json);
        writeMapping(json, mapping);
        jsonEndObject(json);
    }
    jsonInlineObject(json);
    writeThreeNumbers(json, &colorRange);
    jsonEndObject(json);
    jsonInlineObject(json);
    jsonKeyString(json, "type", "number");
    writeRange(json, &colorRange);
    jsonEndObject(json);
    jsonEndArray(json);
}

/* Three numbers or one, none of them 0. */
static void writeFactors(JsonWriter *json)
{
    jsonKey(json, "anyOf");
    jsonArray(json);
    for (int isList = 1; isList >= 0; isList--) {
        jsonInlineObject(json);
        if (isList) {
            jsonKeyString(json, "type", "array");
            jsonKey(json, "items");
            jsonInlineObject(json);
        }
        jsonKeyString(json, "type", "number");
        jsonKey(json, "not");
        jsonInlineObject(json);
        jsonKeyInteger(json, "const", 0);
        jsonEndObject(json);
        if (isList) {
            jsonEndObject(json);
            jsonKeyInteger(json, "minItems", 3);
            jsonKeyInteger(json, "maxItems", 3);
        }
        jsonEndObject(json);
    }
    jsonEndArray(json);
}

/* Four numbers, the last one in a range. */
static void writeSpheres(JsonWriter *json, const FormatRange *range)
{
    jsonKeyString(json, "type", "array");
    jsonKey(json, "items");
    jsonObject(json);
    jsonKeyString(json, "type", "array");
    jsonKey(json, "items");
    jsonArray(json);
    for (int i = 0; i < 4; i++) {
        jsonInlineObject(json);
        jsonKeyString(json, "type", "number");
        if (i == 3)
            writeRange(json, range);
        jsonEndObject(json);
    }
    jsonEndArray(json);
    jsonKeyInteger(json, "minItems", 4);
    jsonKeyInteger(json, "maxItems", 4);
    jsonEndObject(json);
}

static void writeChoices(JsonWriter *json, const FormatKey *key)
{
    jsonKey(json, "enum");
    jsonInlineArray(json);
    for (size_t i = 0; i < key->choiceCount; i++) {
        if (key->type == FORMAT_INTEGER)
            jsonInteger(json, key->choices[i].value);
        else
            jsonString(json, key->choices[i].word);
    }
    jsonEndArray(json);
}

/* The members that describe a mapping. */
static void writeMapping(JsonWriter *json, const FormatMapping *mapping)
{
    jsonKeyString(json, "type", "object");
    jsonKeyBool(json, "additionalProperties", false);
    if (mapping->oneKey != NULL) {
        jsonKeyInteger(json, "minProperties", 1);
        jsonKeyInteger(json, "maxProperties", 1);
    }
    bool anyRequired = false;
    for (size_t i = 0; i < formatKeyCount(mapping); i++)
        anyRequired = anyRequired || isRequired(formatKey(mapping, i));
    if (anyRequired) {
        jsonKey(json, "required");
        jsonInlineArray(json);
        for (size_t i = 0; i < formatKeyCount(mapping); i++)
            if (isRequired(formatKey(mapping, i)))
                jsonString(json, formatKey(mapping, i)->name);
        jsonEndArray(json);
    }

    /* Name each pair that cannot stand together once. */
    for (size_t i = 0; i < formatKeyCount(mapping); i++) {
        const FormatKey *key = formatKey(mapping, i);
        if (key->excludes == NULL || findFormatKey(mapping, key->excludes, strlen(key->excludes)) < i)
            continue;
        jsonKey(json, "not");
        jsonInlineObject(json);
        jsonKey(json, "required");
        jsonInlineArray(json);
        jsonString(json, key->name);
        jsonString(json, key->excludes);
        jsonEndArray(json);
        jsonEndObject(json);
    }
    jsonKey(json, "properties");
    jsonObject(json);
    for (size_t i = 0; i < formatKeyCount(mapping); i++) {
        jsonKey(json, formatKey(mapping, i)->name);
        jsonObject(json);
        writeKeySchema(json, formatKey(mapping, i));
        jsonEndObject(json);
    }
    jsonEndObject(json);
}

static void writeValue(JsonWriter *json, const FormatKey *key)
{
    switch (key->type) {
    case FORMAT_NUMBER:
    case FORMAT_FLOAT:
        jsonKeyString(json, "type", "number");
        writeRange(json, &key->range);
        break;
    case FORMAT_INTEGER:
        if (key->choiceCount > 0) {
            writeChoices(json, key);
        } else {
            jsonKeyString(json, "type", "integer");
            writeRange(json, &key->range);
        }
        break;
    case FORMAT_BOOL:
        jsonKeyString(json, "type", "boolean");
        break;
    case FORMAT_CHOICE:
        writeChoices(json, key);
        break;
    case FORMAT_POINT:
        writeThreeNumbers(json, &anyRange);
        break;
    case FORMAT_DIRECTION:
        writeThreeNumbers(json, &anyRange);
        writeNotZero(json);
        break;
    case FORMAT_FACTORS:
        writeFactors(json);
        break;
    case FORMAT_COLOR:
        writeColor(json, key->mapping);
        break;
    case FORMAT_FILE:
        jsonKeyString(json, "type", "string");
        jsonKeyInteger(json, "minLength", 1);
        break;
    case FORMAT_SPHERES:
        writeSpheres(json, &key->range);
        break;
    case FORMAT_MATERIAL:
        jsonKey(json, "anyOf");
        jsonArray(json);
        jsonInlineObject(json);
        jsonKeyString(json, "type", "string");
        jsonKeyInteger(json, "minLength", 1);
        jsonEndObject(json);
        writeReference(json, key->mapping->name);
        jsonEndArray(json);
        break;
    case FORMAT_MAPPING:
        if (key->mapping->isShared) {
            jsonKey(json, "allOf"); /* beside a $ref draft 07 ignores all else */
            jsonInlineArray(json);
            writeReference(json, key->mapping->name);
            jsonEndArray(json);
        } else {
            writeMapping(json, key->mapping);
        }
        break;
    case FORMAT_STEPS:
        jsonKeyString(json, "type", "array");
        jsonKey(json, "items");
        writeReference(json, key->mapping->name);
        break;
    case FORMAT_NAMED:
        jsonKeyString(json, "type", "object");
        jsonKey(json, "additionalProperties");
        writeReference(json, key->mapping->name);
        break;
    case FORMAT_KINDS:
        jsonKeyString(json, "type", "array");
        jsonKey(json, "items");
        writeReference(json, key->kinds->noun);
        if (key->least > 0)
            jsonKeyInteger(json, "minItems", (int64_t)key->least);
        break;
    }
}

static void writeKeySchema(JsonWriter *json, const FormatKey *key)
{
    writeDescription(json, key);
    writeDefault(json, key);
    if (key->count == 0) {
        writeValue(json, key);
        return;
    }
    beginItems(json);
    writeValue(json, key);
    endItems(json, key->count);
}

/* ---- Definitions ---- */

enum {
    MOST_DEFINITIONS = 16
};

/* The mappings and kinds that are defined, each once, in the order in which the table comes to them. */
typedef struct Definitions {
    const void *known[MOST_DEFINITIONS];
    size_t count;
} Definitions;

static bool isNew(Definitions *definitions, const void *item)
{
    for (size_t i = 0; i < definitions->count; i++)
        if (definitions->known[i] == item)
            return false;
    if (definitions->count < MOST_DEFINITIONS)
        definitions->known[definitions->count++] = item;
    return true;
}

static void writeDefinitions(JsonWriter *json, Definitions *definitions, const FormatMapping *mapping);

static void writeKinds(JsonWriter *json, const FormatKinds *kinds)
{
    jsonKey(json, kinds->noun);
    jsonObject(json);
    jsonKeyString(json, "type", "object");
    jsonKeyBool(json, "additionalProperties", false);
    jsonKeyInteger(json, "minProperties", 1);
    jsonKeyInteger(json, "maxProperties", 1);
    jsonKey(json, "properties");
    jsonObject(json);
    for (size_t i = 0; i < kinds->count; i++) {
        const FormatMapping *kind = kinds->kinds[i];
        jsonKey(json, kind->name);
        jsonObject(json);
        jsonKeyString(json, "description", kind->help);
        writeMapping(json, kind);
        jsonEndObject(json);
    }
    jsonEndObject(json);
    jsonEndObject(json);
}

/* Define what the key refers to, and what that refers to. */
static void writeDefinition(JsonWriter *json, Definitions *definitions, const FormatKey *key)
{
    if (key->kinds != NULL && isNew(definitions, key->kinds)) {
        writeKinds(json, key->kinds);
        for (size_t i = 0; i < key->kinds->count; i++)
            writeDefinitions(json, definitions, key->kinds->kinds[i]);
    }
    if (key->mapping == NULL || (key->mapping->isShared && !isNew(definitions, key->mapping)))
        return;
    if (key->mapping->isShared) {
        jsonKey(json, key->mapping->name);
        jsonObject(json);
        jsonKeyString(json, "description", key->mapping->help);
        writeMapping(json, key->mapping);
        jsonEndObject(json);
    }
    writeDefinitions(json, definitions, key->mapping);
}

static void writeDefinitions(JsonWriter *json, Definitions *definitions, const FormatMapping *mapping)
{
    for (size_t i = 0; i < formatKeyCount(mapping); i++)
        writeDefinition(json, definitions, formatKey(mapping, i));
}

void writeSceneSchema(Text *text)
{
    JsonWriter writer = jsonBegin(text);
    JsonWriter *json = &writer;
    jsonObject(json);
    jsonKeyString(json, "$schema", "http://json-schema.org/draft-07/schema#");
    jsonKeyString(json, "title", sceneFormat.help);
    writeMapping(json, &sceneFormat);
    jsonKey(json, "definitions");
    jsonObject(json);
    Definitions definitions = {.count = 0};
    writeDefinitions(json, &definitions, &sceneFormat);
    jsonEndObject(json);
    jsonEndObject(json);
    jsonEnd(json);
}
