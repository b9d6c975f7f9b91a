/* yaml_tree.c - a YAML document, node by node; see yaml_tree.h. */
#include "scene/yaml_tree.h"

#include "base/cancel.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Events ---- */

static Place placeOfEvent(const yaml_event_t *event)
{
    const yaml_mark_t *start = &event->start_mark, *end = &event->end_mark;
    bool oneLine = start->line == end->line && end->column > start->column;
    bool isCollection = event->type == YAML_SEQUENCE_START_EVENT || event->type == YAML_MAPPING_START_EVENT;
    int width = oneLine && !isCollection ? (int)(end->column - start->column) : 1;
    return (Place){(int)start->line + 1, (int)start->column + 1, width};
}

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
    const yaml_event_t *event = &reader->event;
    reader->syntax.afterText = event->type == YAML_SCALAR_EVENT && event->data.scalar.length > 0 &&
                               event->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
    if (!reader->syntax.afterText)
        return;
    reader->syntax.text = placeOfEvent(event);
    reader->syntax.textEndLine = (int)event->end_mark.line + 1;
}

static void reportBrokenYaml(YamlReader *reader)
{
    SyntaxContext context = reader->syntax;
    context.inBrackets = reader->depth > 0 && reader->inBrackets[reader->depth - 1];
    if (reader->depth > 0)
        context.opening = reader->openings[reader->depth - 1];
    reportSyntaxError(&reader->parser, &context, reader->source, reader->diagnostics);
}

/* Make reader->event the next event; false when there is none. */
static bool pullEvent(YamlReader *reader)
{
    if (reader->failed)
        return false;
    if (reader->hasEvent)
        return true;
    if (cancelRequested()) {
        reader->interrupted = true;
        reader->failed = true;
        return false;
    }
    if (yaml_parser_parse(&reader->parser, &reader->event)) {
        reader->hasEvent = true;
        noteText(reader);
        return true;
    }
    reader->failed = true;
    if (reader->parser.error == YAML_MEMORY_ERROR)
        reader->outOfMemory = true;
    else
        reportBrokenYaml(reader);
    return false;
}

static void dropEvent(YamlReader *reader)
{
    if (reader->hasEvent)
        yaml_event_delete(&reader->event);
    reader->hasEvent = false;
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

void openYaml(YamlReader *reader, SourceText *source, Diagnostics *diagnostics)
{
    *reader = (YamlReader){.source = source, .diagnostics = diagnostics};
    if (!yaml_parser_initialize(&reader->parser)) {
        failOutOfMemory(reader);
        return;
    }
    yaml_parser_set_input_string(&reader->parser, (const unsigned char *)source->text, source->length);
    yaml_parser_set_encoding(&reader->parser, YAML_UTF8_ENCODING);

    refuseManyTagDirectives(reader);

    /* Skip the start of the stream and of the document. */
    if (pullEvent(reader))
        dropEvent(reader);
    if (pullEvent(reader) && reader->event.type == YAML_DOCUMENT_START_EVENT)
        dropEvent(reader);
}

void closeYaml(YamlReader *reader)
{
    dropEvent(reader);
    yaml_parser_delete(&reader->parser);
    freeNameTable(&reader->anchorNames);
    free(reader->anchors);
    arenaFree(&reader->arena);
}

YamlNext peekYaml(YamlReader *reader)
{
    if (!pullEvent(reader))
        return NEXT_FAILED;
    switch (reader->event.type) {
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

static const char *anchorOfEvent(const yaml_event_t *event)
{
    switch (event->type) {
    case YAML_SCALAR_EVENT:
        return (const char *)event->data.scalar.anchor;
    case YAML_SEQUENCE_START_EVENT:
        return (const char *)event->data.sequence_start.anchor;
    case YAML_MAPPING_START_EVENT:
        return (const char *)event->data.mapping_start.anchor;
    default:
        return NULL;
    }
}

bool nextHasAnchor(const YamlReader *reader)
{
    return reader->hasEvent && anchorOfEvent(&reader->event) != NULL;
}

/* Note the anchor of the event, if it has one. Its number, or NAME_NONE. */
static size_t defineAnchor(YamlReader *reader)
{
    const char *anchor = anchorOfEvent(&reader->event);
    if (anchor == NULL)
        return NAME_NONE;
    Place place = placeOfEvent(&reader->event);
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
    const char *anchor = (const char *)reader->event.data.alias.anchor;
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
    const yaml_event_t *event = &reader->event;
    const yaml_char_t *tag = NULL;
    if (event->type == YAML_SCALAR_EVENT)
        tag = event->data.scalar.tag;
    else if (event->type == YAML_SEQUENCE_START_EVENT)
        tag = event->data.sequence_start.tag;
    else if (event->type == YAML_MAPPING_START_EVENT)
        tag = event->data.mapping_start.tag;
    if (tag == NULL)
        return;
    /* Show a core tag as it is usually written. */
    static const char core[] = "tag:yaml.org,2002:";
    const char *text = (const char *)tag;
    bool isCore = strncmp(text, core, sizeof core - 1) == 0;
    text += isCore ? sizeof core - 1 : 0;
    char message[QUOTE_SIZE + 80];
    snprintf(message, sizeof message, "the tag '%s%s' has no meaning in a scene", isCore ? "!!" : "",
             quoteBytes(text, strlen(text)).text);
    addDiagnostic(reader->diagnostics, reader->source, SEVERITY_ERROR, placeOfEvent(event),
                  "remove the word that begins with '!'", message);
}

/* Count one level more; false when there are too many. */
static bool descend(YamlReader *reader)
{
    const yaml_event_t *event = &reader->event;
    if (reader->depth < YAML_MAX_DEPTH) {
        reader->openings[reader->depth] = placeOfEvent(event);
        reader->inBrackets[reader->depth] = event->type == YAML_SEQUENCE_START_EVENT
                                                ? event->data.sequence_start.style == YAML_FLOW_SEQUENCE_STYLE
                                                : event->data.mapping_start.style == YAML_FLOW_MAPPING_STYLE;
        reader->depth++;
        return true;
    }
    char message[80];
    snprintf(message, sizeof message, "lists and mappings are nested deeper than %d levels", YAML_MAX_DEPTH);
    fail(reader, placeOfEvent(&reader->event), "no scene needs this; is a bracket repeated?", message);
    return false;
}

void enterYaml(YamlReader *reader, Place *place)
{
    *place = placeOfEvent(&reader->event);
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

static YamlNode *readNode(YamlReader *reader);

/* Read the children of a list or mapping, and its end. */
static void readChildren(YamlReader *reader, YamlNode *node)
{
    if (!descend(reader))
        return;
    dropEvent(reader);
    YamlNode **last = &node->first;
    while (pullEvent(reader) && peekYaml(reader) != NEXT_END) {
        YamlNode *child = readNode(reader);
        if (child == NULL)
            return;
        *last = child;
        last = &child->next;
        node->count++;
        node->size += child->size;
        if (child->height >= node->height)
            node->height = (uint8_t)(child->height + 1);
    }
    if (node->kind == NODE_MAPPING)
        node->count /= 2;
    leaveYaml(reader);
}

static YamlNode *readNode(YamlReader *reader)
{
    YamlNext next = peekYaml(reader);
    if (next == NEXT_FAILED || next == NEXT_END)
        return NULL;
    YamlNode *node = arenaAllocate(&reader->arena, sizeof *node);
    if (node == NULL) {
        failOutOfMemory(reader);
        return NULL;
    }
    *node = (YamlNode){.size = 1, .place = placeOfEvent(&reader->event)};
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
        node->count = reader->event.data.scalar.length;
        node->plain = reader->event.data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
        node->text = arenaCopy(&reader->arena, (const char *)reader->event.data.scalar.value, node->count);
        if (node->text == NULL)
            failOutOfMemory(reader);
        dropEvent(reader);
    } else {
        node->kind = next == NEXT_LIST ? NODE_LIST : NODE_MAPPING;
        node->height = 1;
        readChildren(reader, node);
    }
    if (anchor != NAME_NONE && !reader->failed)
        reader->anchors[anchor].node = node;
    return reader->failed ? NULL : node;
}

const YamlNode *readYamlNode(YamlReader *reader)
{
    return readNode(reader);
}

void finishYaml(YamlReader *reader)
{
    /* Drop the end of the document, then nothing may come but the end of the stream. */
    if (!pullEvent(reader))
        return;
    if (reader->event.type == YAML_DOCUMENT_END_EVENT)
        dropEvent(reader);
    if (pullEvent(reader) && reader->event.type == YAML_DOCUMENT_START_EVENT)
        fail(reader, placeOfEvent(&reader->event), "put each scene into a file of its own",
             "a second document begins here; a file holds one scene");
}
