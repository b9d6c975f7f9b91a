/* json.h - write a JSON document (RFC 8259).
 *
 * Call begin/end and values in document order; commas, newlines and indentation are put in. Numbers are
 * the shortest decimals that read back exactly; what is not finite is written as null. Strings are
 * UTF-8; bytes that are not become U+FFFD, so the document is always valid.
 */
#ifndef ECLAIRAGE_BASE_JSON_H
#define ECLAIRAGE_BASE_JSON_H

#include "base/text.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    JSON_MAX_DEPTH = 64
};

typedef struct JsonWriter {
    Text *text;                   /* where the document goes; not owned */
    int depth;                    /* open objects and arrays */
    bool inline_[JSON_MAX_DEPTH]; /* this one is written on one line */
    bool empty[JSON_MAX_DEPTH];   /* nothing written in it yet */
    bool afterKey;
} JsonWriter;

JsonWriter jsonBegin(Text *text);
void jsonObject(JsonWriter *json);       /* { one member a line */
void jsonInlineObject(JsonWriter *json); /* { all on one line */
void jsonArray(JsonWriter *json);
void jsonInlineArray(JsonWriter *json);
void jsonEndObject(JsonWriter *json);
void jsonEndArray(JsonWriter *json);
void jsonKey(JsonWriter *json, const char *key);
void jsonString(JsonWriter *json, const char *value);
void jsonNumber(JsonWriter *json, double value);
void jsonInteger(JsonWriter *json, int64_t value);
void jsonBool(JsonWriter *json, bool value);
void jsonNull(JsonWriter *json);
/* End the document with a newline. */
void jsonEnd(JsonWriter *json);

/* Key and value in one call. */
void jsonKeyString(JsonWriter *json, const char *key, const char *value);
void jsonKeyNumber(JsonWriter *json, const char *key, double value);
void jsonKeyInteger(JsonWriter *json, const char *key, int64_t value);
void jsonKeyBool(JsonWriter *json, const char *key, bool value);

#endif
