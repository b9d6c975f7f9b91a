/* json.c - write a JSON document; see json.h. */
#include "base/json.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

JsonWriter jsonBegin(Text *text)
{
    return (JsonWriter){.text = text};
}

/* Put the comma and the line break that belong before the next value or key. */
static void separate(JsonWriter *json)
{
    if (json->afterKey) {
        json->afterKey = false;
        return;
    }
    if (json->depth == 0)
        return;
    bool onOneLine = json->inline_[json->depth - 1];
    if (!json->empty[json->depth - 1])
        textAppend(json->text, onOneLine ? ", " : ",");
    json->empty[json->depth - 1] = false;
    if (!onOneLine)
        textAppendFormat(json->text, "\n%*s", 2 * json->depth, "");
}

static void open(JsonWriter *json, const char *bracket, bool onOneLine)
{
    separate(json);
    textAppend(json->text, bracket);
    if (json->depth >= JSON_MAX_DEPTH) {
        json->text->failed = true;
        return;
    }
    bool inherited = json->depth > 0 && json->inline_[json->depth - 1];
    json->inline_[json->depth] = onOneLine || inherited;
    json->empty[json->depth] = true;
    json->depth++;
}

static void shut(JsonWriter *json, const char *bracket)
{
    json->depth--;
    if (!json->empty[json->depth] && !json->inline_[json->depth])
        textAppendFormat(json->text, "\n%*s", 2 * json->depth, "");
    textAppend(json->text, bracket);
}

void jsonObject(JsonWriter *json)
{
    open(json, "{", false);
}

void jsonInlineObject(JsonWriter *json)
{
    open(json, "{", true);
}

void jsonArray(JsonWriter *json)
{
    open(json, "[", false);
}

void jsonInlineArray(JsonWriter *json)
{
    open(json, "[", true);
}

void jsonEndObject(JsonWriter *json)
{
    shut(json, "}");
}

void jsonEndArray(JsonWriter *json)
{
    shut(json, "]");
}

/* Append value as a JSON string, quotes included. */
static void appendQuoted(Text *text, const char *value)
{
    textAppend(text, "\"");
    for (const unsigned char *s = (const unsigned char *)value; *s != '\0';) {
        size_t length = utf8Length((const char *)s);
        if (length == 0) {
            textAppend(text, "\xEF\xBF\xBD");
            length = 1;
        } else if (*s == '"' || *s == '\\') {
            textAppendFormat(text, "\\%c", *s);
        } else if (*s == '\n') {
            textAppend(text, "\\n");
        } else if (*s == '\t') {
            textAppend(text, "\\t");
        } else if (*s < 0x20 || *s == 0x7F) {
            textAppendFormat(text, "\\u%04x", *s);
        } else {
            textAppendBytes(text, s, length);
        }
        s += length;
    }
    textAppend(text, "\"");
}

void jsonKey(JsonWriter *json, const char *key)
{
    separate(json);
    appendQuoted(json->text, key);
    textAppend(json->text, ": ");
    json->afterKey = true;
}

void jsonString(JsonWriter *json, const char *value)
{
    separate(json);
    appendQuoted(json->text, value);
}

void jsonNumber(JsonWriter *json, double value)
{
    separate(json);
    if (isfinite(value))
        textAppendDouble(json->text, value);
    else
        textAppend(json->text, "null");
}

void jsonInteger(JsonWriter *json, int64_t value)
{
    separate(json);
    textAppendFormat(json->text, "%" PRId64, value);
}

void jsonBool(JsonWriter *json, bool value)
{
    separate(json);
    textAppend(json->text, value ? "true" : "false");
}

void jsonNull(JsonWriter *json)
{
    separate(json);
    textAppend(json->text, "null");
}

void jsonEnd(JsonWriter *json)
{
    textAppend(json->text, "\n");
}

void jsonKeyString(JsonWriter *json, const char *key, const char *value)
{
    jsonKey(json, key);
    jsonString(json, value);
}

void jsonKeyNumber(JsonWriter *json, const char *key, double value)
{
    jsonKey(json, key);
    jsonNumber(json, value);
}

void jsonKeyInteger(JsonWriter *json, const char *key, int64_t value)
{
    jsonKey(json, key);
    jsonInteger(json, value);
}

void jsonKeyBool(JsonWriter *json, const char *key, bool value)
{
    jsonKey(json, key);
    jsonBool(json, value);
}
