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

static void writeColor(JsonWriter *json)
{
    jsonKey(json, "anyOf");
    jsonArray(json);
    jsonInlineObject(json);
    writeThreeNumbers(json, &colorRange);
    jsonEndObject(json);
    jsonInlineObject(json);
    jsonKeyString(json, "type", "number");
    writeRange(json, &colorRange);
    jsonEndObject(json);
    jsonEndArray(json);
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

static void writeKeySchema(JsonWriter *json, const FormatKey *key)
{
    static const FormatRange anything = {.low = LIMIT_NONE};
    writeDescription(json, key);
    writeDefault(json, key);
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
        writeThreeNumbers(json, &anything);
        break;
    case FORMAT_DIRECTION:
        writeThreeNumbers(json, &anything);
        writeNotZero(json);
        break;
    case FORMAT_COLOR:
        writeColor(json);
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
        writeMapping(json, key->mapping);
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
        break;
    }
}

/* Define what lists of kinds and named mappings refer to. */
static void writeDefinition(JsonWriter *json, const FormatKey *key)
{
    if (key->type == FORMAT_NAMED) {
        jsonKey(json, key->mapping->name);
        jsonObject(json);
        jsonKeyString(json, "description", key->mapping->help);
        writeMapping(json, key->mapping);
        jsonEndObject(json);
    }
    if (key->type != FORMAT_KINDS)
        return;
    jsonKey(json, key->kinds->noun);
    jsonObject(json);
    jsonKeyString(json, "type", "object");
    jsonKeyBool(json, "additionalProperties", false);
    jsonKeyInteger(json, "minProperties", 1);
    jsonKeyInteger(json, "maxProperties", 1);
    jsonKey(json, "properties");
    jsonObject(json);
    for (size_t i = 0; i < key->kinds->count; i++) {
        const FormatMapping *kind = key->kinds->kinds[i];
        jsonKey(json, kind->name);
        jsonObject(json);
        jsonKeyString(json, "description", kind->help);
        writeMapping(json, kind);
        jsonEndObject(json);
    }
    jsonEndObject(json);
    jsonEndObject(json);
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
    for (size_t i = 0; i < formatKeyCount(&sceneFormat); i++)
        writeDefinition(json, formatKey(&sceneFormat, i));
    jsonEndObject(json);
    jsonEndObject(json);
    jsonEnd(json);
}
