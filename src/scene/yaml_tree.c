/* yaml_tree.c - a YAML document, node by node; see yaml_tree.h. */
#include "scene/yaml_tree.h"

#include "base/cancel.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Events ---- */

/* Report an error after which nothing more can be read. */
static void fail(YamlReader *reader, Place place, const char *hint, const char *message)
{
    addDiagnostic(reader->diagnostics, reader->source, SEVERITY_ERROR, place, hint, message);
    reader->failed = true;
}

static void failOutOfMemory(YamlReader *reader)
{
    reader->outOfMemory = true;
    reader->failed = true;
}

/* Remember the last text without quotes. */
static void noteText(YamlReader *reader)
{
    const YamlEvent *event = reader->event;
    reader->syntax.afterText = event->plain && event->length > 0;
    if (!reader->syntax.afterText)
        return;
    reader->syntax.text = event->place;
    reader->syntax.textEndLine = event->endLine;
}

static void reportBrokenYaml(YamlReader *reader)
{
    SyntaxContext context = reader->syntax;
    context.inBrackets = reader->depth > 0 && reader->inBrackets[reader->depth - 1];
    if (reader->depth > 0)
        context.opening = reader->openings[reader->depth - 1];
    reportSyntaxError(brokenYamlParser(reader->events), &context, reader->source, reader->diagnostics);
}

/* Make reader->event the next event; false when there is none. */
static bool pullEvent(YamlReader *reader)
{
    static const YamlEvent nothing = {.type = YAML_NO_EVENT};
    if (reader->failed)
        return false;
    if (reader->event != NULL)
        return true;
    EventsEnd end = EVENTS_INTERRUPTED;
    if (!cancelRequested())
        reader->event = nextYamlEvent(reader->events, &end);
    if (end == EVENTS_COMPLETE)
        reader->event = &nothing;
    if (reader->event != NULL) {
        noteText(reader);
        return true;
    }
    reader->failed = true;
    if (end == EVENTS_INTERRUPTED)
        reader->interrupted = true;
    else if (end == EVENTS_OUT_OF_MEMORY)
        reader->outOfMemory = true;
    else
        reportBrokenYaml(reader);
    return false;
}

static void dropEvent(YamlReader *reader)
{
    reader->event = NULL;
}

/* libyaml compares each %TAG directive with all before it. Tags are no part of a scene, so there is no need
 * for many: stop before that takes long. */
static void refuseManyTagDirectives(YamlReader *reader)
{
    enum {
        MOST_DIRECTIVES = 64
    };
    const char *text = reader->source->text, *end = text + reader->source->length;
    int count = 0;
    for (const char *s = text; s < end && (s = memchr(s, '%', (size_t)(end - s))) != NULL; s++) {
        bool isDirective =
            end - s >= 4 && memcmp(s, "%TAG", 4) == 0 && (s == text || s[-1] == '\n' || s[-1] == '\r');
        count += isDirective;
    }
    if (count > MOST_DIRECTIVES)
        fail(reader, (Place){1, 1, 1}, "remove them",
             "tags and their %TAG directives have no meaning in a scene");
}

void openYaml(YamlReader *reader, SourceText *source, Diagnostics *diagnostics, RowFormat rowFormat)
{
    *reader = (YamlReader){.source = source, .diagnostics = diagnostics, .rowFormat = rowFormat};
    refuseManyTagDirectives(reader);
    if (reader->failed)
        return;
    reader->events = openYamlEvents(source);
    if (reader->events == NULL) {
        failOutOfMemory(reader);
        return;
    }

    /* Skip the start of the stream and of the document. */
    if (pullEvent(reader))
        dropEvent(reader);
    if (pullEvent(reader) && reader->event->type == YAML_DOCUMENT_START_EVENT)
        dropEvent(reader);
}

void closeYaml(YamlReader *reader)
{
    closeYamlEvents(reader->events);
    freeNameTable(&reader->anchorNames);
    free(reader->anchors);
    arenaFree(&reader->arena);
}

YamlNext peekYaml(YamlReader *reader)
{
    if (!pullEvent(reader))
        return NEXT_FAILED;
    switch (reader->event->type) {
    case YAML_SCALAR_EVENT:
        return NEXT_SCALAR;
    case YAML_ALIAS_EVENT:
        return NEXT_ALIAS;
    case YAML_SEQUENCE_START_EVENT:
        return NEXT_LIST;
    case YAML_MAPPING_START_EVENT:
        return NEXT_MAPPING;
    default:
        return NEXT_END;
    }
}

/* ---- Anchors ---- */

bool nextHasAnchor(const YamlReader *reader)
{
    return reader->event != NULL && reader->event->anchor != NULL;
}

/* Note the anchor of the event, if it has one. Its number, or NAME_NONE. */
static size_t defineAnchor(YamlReader *reader)
{
    const char *anchor = reader->event->anchor;
    if (anchor == NULL)
        return NAME_NONE;
    Place place = reader->event->place;
    size_t known = findName(&reader->anchorNames, anchor, strlen(anchor));
    if (known != NAME_NONE) {
        char message[QUOTE_SIZE + 80];
        snprintf(message, sizeof message, "the anchor '&%s' is given twice; the first is in line %d",
                 quoteBytes(anchor, strlen(anchor)).text, reader->anchors[known].line);
        addDiagnostic(reader->diagnostics, reader->source, SEVERITY_ERROR, place,
                      "give one of them another name", message);
        return NAME_NONE;
    }
    size_t number = addName(&reader->anchorNames, anchor, strlen(anchor));
    if (number != NAME_NONE && number >= reader->anchorCapacity) {
        size_t capacity = reader->anchorCapacity == 0 ? 16 : reader->anchorCapacity * 2;
        YamlAnchor *anchors = realloc(reader->anchors, capacity * sizeof *anchors);
        if (anchors == NULL) {
            number = NAME_NONE;
        } else {
            reader->anchors = anchors;
            reader->anchorCapacity = capacity;
        }
    }
    if (number == NAME_NONE)
        failOutOfMemory(reader);
    else
        reader->anchors[number] = (YamlAnchor){.line = place.line};
    return number;
}

/* Point an alias to what it stands for. */
static void followAlias(YamlReader *reader, YamlNode *node)
{
    const char *anchor = reader->event->anchor;
    size_t number = findName(&reader->anchorNames, anchor, strlen(anchor));
    char message[2 * QUOTE_SIZE + 120];
    Quote name = quoteBytes(anchor, strlen(anchor));
    if (number == NAME_NONE) {
        snprintf(message, sizeof message, "the alias '*%s' stands for nothing: no '&%s' comes before it",
                 name.text, name.text);
        addDiagnostic(reader->diagnostics, reader->source, SEVERITY_ERROR, node->place,
                      "put the anchor before the first alias, or write the value out", message);
        return;
    }
    node->target = reader->anchors[number].node;
    if (node->target == NULL) {
        snprintf(message, sizeof message, "the alias '*%s' is inside the value it stands for, without end",
                 name.text);
        addDiagnostic(reader->diagnostics, reader->source, SEVERITY_ERROR, node->place, "write the value out",
                      message);
        return;
    }
    node->size += node->target->size;
    node->height = node->target->height;
    reader->aliasNodes += node->target->size;
    if (reader->depth + node->height > YAML_MAX_DEPTH) {
        snprintf(message, sizeof message, "lists and mappings are nested deeper than %d levels",
                 YAML_MAX_DEPTH);
        fail(reader, node->place, NULL, message);
    } else if (reader->aliasNodes > ALIAS_BUDGET + ALIAS_BUDGET_PER_NODE * reader->nodeCount) {
        snprintf(message, sizeof message, "aliases blow this file up to more than %" PRIu64 " values",
                 ALIAS_BUDGET + ALIAS_BUDGET_PER_NODE * reader->nodeCount);
        fail(reader, node->place, "use fewer aliases of aliases", message);
    }
}

/* ---- Nodes ---- */

static void refuseTag(YamlReader *reader)
{
    const YamlEvent *event = reader->event;
    if (event->tag == NULL)
        return;
    /* Show a core tag as it is usually written. */
    static const char core[] = "tag:yaml.org,2002:";
    const char *text = event->tag;
    bool isCore = strncmp(text, core, sizeof core - 1) == 0;
    text += isCore ? sizeof core - 1 : 0;
    char message[QUOTE_SIZE + 80];
    snprintf(message, sizeof message, "the tag '%s%s' has no meaning in a scene", isCore ? "!!" : "",
             quoteBytes(text, strlen(text)).text);
    addDiagnostic(reader->diagnostics, reader->source, SEVERITY_ERROR, event->place,
                  "remove the word that begins with '!'", message);
}

/* Count one level more; false when there are too many. */
static bool descend(YamlReader *reader)
{
    if (reader->depth < YAML_MAX_DEPTH) {
        reader->openings[reader->depth] = reader->event->place;
        reader->inBrackets[reader->depth] = reader->event->inBrackets;
        reader->depth++;
        return true;
    }
    char message[80];
    snprintf(message, sizeof message, "lists and mappings are nested deeper than %d levels", YAML_MAX_DEPTH);
    fail(reader, reader->event->place, "no scene needs this; is a bracket repeated?", message);
    return false;
}

void enterYaml(YamlReader *reader, Place *place)
{
    *place = reader->event->place;
    refuseTag(reader);
    defineAnchor(reader);
    reader->nodeCount++;
    if (descend(reader))
        dropEvent(reader);
}

void leaveYaml(YamlReader *reader)
{
    if (!reader->failed)
        dropEvent(reader);
    reader->depth--;
}

static YamlNode *readNode(YamlReader *reader, bool mayBeRows);

/* Put a child behind the last one; newest is that one, or NULL. */
static void appendChild(YamlNode *node, YamlNode *newest, YamlNode *child)
{
    if (newest == NULL)
        node->first = child;
    else
        newest->next = child;
}

/* Count what is in a child. */
static void countChild(YamlNode *node, uint64_t size, uint8_t height)
{
    node->count++;
    node->size += size;
    if (height >= node->height)
        node->height = (uint8_t)(height + 1);
}

/* The newest child, where it is a block with room for a row, or a new block behind it; NULL when memory runs
 * out. */
static YamlNode *roomForRow(YamlReader *reader, YamlNode *list, YamlNode *newest, size_t *capacity)
{
    enum {
        MOST_ROWS = 256 /* in a block */
    };
    if (newest != NULL && newest->kind == NODE_ROWS && newest->count < *capacity)
        return newest;
    *capacity = *capacity == 0 ? 4 : *capacity < MOST_ROWS ? 2 * *capacity : MOST_ROWS;
    YamlNode *block = arenaAllocate(&reader->arena, sizeof *block);
    YamlRow *rows = arenaAllocate(&reader->arena, *capacity * sizeof *rows);
    if (block == NULL || rows == NULL) {
        failOutOfMemory(reader);
        return NULL;
    }
    *block = (YamlNode){.kind = NODE_ROWS, .rows = rows};
    appendChild(list, newest, block);
    return block;
}

/* Whether the key is the one behind which rows stand. */
static bool isRowsKey(const YamlReader *reader, const YamlNode *key)
{
    return reader->rowFormat.key != NULL && key->kind == NODE_SCALAR &&
           strcmp(key->text, reader->rowFormat.key) == 0;
}

/* Read the children of a list or mapping, and its end; areRows: of a list, its items may be rows. */
static void readChildren(YamlReader *reader, YamlNode *node, bool areRows)
{
    if (!descend(reader))
        return;
    dropEvent(reader);
    YamlNode *newest = NULL;
    size_t rowCapacity = 0;
    while (pullEvent(reader) && peekYaml(reader) != NEXT_END) {
        bool isValue = node->kind == NODE_MAPPING && node->count % 2 == 1;
        ArenaMark mark = arenaMark(&reader->arena);
        size_t anchors = reader->anchorNames.count;
        YamlNode *child = readNode(reader, isValue && isRowsKey(reader, newest));
        if (child == NULL)
            return;
        countChild(node, child->size, child->height);

        /* Keep only the numbers of a row; what an alias may lead to stays as it is. */
        YamlRow row = {.line = child->place.line};
        if (areRows && child->kind == NODE_LIST && child->count == YAML_ROW_NUMBERS &&
            reader->anchorNames.count == anchors && reader->rowFormat.take(child, row.numbers)) {
            arenaRewind(&reader->arena, mark);
            child = roomForRow(reader, node, newest, &rowCapacity);
            if (child == NULL)
                return;
            child->rows[child->count++] = row;
        } else {
            appendChild(node, newest, child);
        }
        newest = child;
    }
    if (node->kind == NODE_MAPPING)
        node->count /= 2;
    leaveYaml(reader);
}

/* mayBeRows: where it is a list, its items may be rows. */
static YamlNode *readNode(YamlReader *reader, bool mayBeRows)
{
    YamlNext next = peekYaml(reader);
    if (next == NEXT_FAILED || next == NEXT_END)
        return NULL;
    YamlNode *node = arenaAllocate(&reader->arena, sizeof *node);
    if (node == NULL) {
        failOutOfMemory(reader);
        return NULL;
    }
    *node = (YamlNode){.size = 1, .place = reader->event->place};
    reader->nodeCount++;
    if (next == NEXT_ALIAS) {
        node->kind = NODE_ALIAS;
        followAlias(reader, node);
        dropEvent(reader);
        return reader->failed ? NULL : node;
    }

    refuseTag(reader);
    size_t anchor = defineAnchor(reader);
    if (next == NEXT_SCALAR) {
        node->kind = NODE_SCALAR;
        node->count = reader->event->length;
        node->plain = reader->event->plain;
        node->text = arenaCopy(&reader->arena, reader->event->text, node->count);
        if (node->text == NULL)
            failOutOfMemory(reader);
        dropEvent(reader);
    } else {
        node->kind = next == NEXT_LIST ? NODE_LIST : NODE_MAPPING;
        node->height = 1;
        reader->anchoredDepth += anchor != NAME_NONE;
        readChildren(reader, node, mayBeRows && node->kind == NODE_LIST && reader->anchoredDepth == 0);
        reader->anchoredDepth -= anchor != NAME_NONE;
    }
    if (anchor != NAME_NONE && !reader->failed)
        reader->anchors[anchor].node = node;
    return reader->failed ? NULL : node;
}

const YamlNode *readYamlNode(YamlReader *reader)
{
    return readNode(reader, false);
}

void finishYaml(YamlReader *reader)
{
    /* Drop the end of the document, then nothing may come but the end of the stream. */
    if (!pullEvent(reader))
        return;
    if (reader->event->type == YAML_DOCUMENT_END_EVENT)
        dropEvent(reader);
    if (pullEvent(reader) && reader->event->type == YAML_DOCUMENT_START_EVENT)
        fail(reader, reader->event->place, "put each scene into a file of its own",
             "a second document begins here; a file holds one scene");
}
