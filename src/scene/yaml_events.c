/* yaml_events.c - what libyaml finds in a text, event by event; see yaml_events.h.
 *
 * The batches stand in a ring. Those numbered taken to filled - 1 are full and the reader's, the others are
 * the parser's; only these two numbers, `stopped` and the conditions are shared, under the mutex:
 *
 *     ... | taken: being read | full | full | filled: being parsed | free | ...
 *
 * Without a thread there is one batch, filled whenever it was read to its end.
 */
#include "scene/yaml_events.h"

#include "base/cancel.h"
#include "base/threads.h"
#include "scene/arena.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum {
    SMALL_BATCH = 256, /* events, without a thread */

    /* With a thread. So much at most is parsed ahead, and it is bounded not only for memory: the reader stops
     * where lists are nested too deep, before libyaml's time for them, quadratic in their depth, matters. */
    LARGE_BATCH = 2048, /* events: some 0.5 ms of parsing, many times what it costs to wake a thread */
    BATCH_COUNT = 4,
    LONG_TEXT = 1 << 18 /* bytes from which on a thread is worth its while */
};

typedef struct Batch {
    YamlEvent *events;
    size_t count;
    EventsEnd end; /* after the last event */
    Arena texts;
} Batch;

struct YamlEvents {
    yaml_parser_t parser; /* the thread's, while there is one */
    Batch batches[BATCH_COUNT];
    size_t batchCount, batchSize; /* how many are used, of how many events */
    YamlEvent *storage;           /* all of their events */
    size_t next;                  /* event of the batch being read */

    bool hasThread;
    pthread_t thread;
    pthread_mutex_t mutex;
    pthread_cond_t isFilled, isFree;
    size_t taken, filled;
    bool stopped; /* nothing more will be read */
};

/* ---- Parsing ---- */

static Place placeOfEvent(const yaml_event_t *event)
{
    const yaml_mark_t *start = &event->start_mark, *end = &event->end_mark;
    bool oneLine = start->line == end->line && end->column > start->column;
    bool isCollection = event->type == YAML_SEQUENCE_START_EVENT || event->type == YAML_MAPPING_START_EVENT;
    int width = oneLine && !isCollection ? (int)(end->column - start->column) : 1;
    return (Place){(int)start->line + 1, (int)start->column + 1, width};
}

/* Copy a string, which may be NULL; false when memory runs out. */
static bool copyString(Arena *arena, const yaml_char_t *string, const char **copy)
{
    const char *text = (const char *)string;
    *copy = text != NULL ? arenaCopy(arena, text, strlen(text)) : NULL;
    return text == NULL || *copy != NULL;
}

/* Copy what is needed of an event; false when memory runs out. */
static bool copyEvent(Arena *arena, const yaml_event_t *event, YamlEvent *copy)
{
    *copy = (YamlEvent){
        .place = placeOfEvent(event), .endLine = (int)event->end_mark.line + 1, .type = (uint8_t)event->type};
    switch (event->type) {
    case YAML_SCALAR_EVENT:
        copy->plain = event->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
        copy->length = event->data.scalar.length;
        copy->text = arenaCopy(arena, (const char *)event->data.scalar.value, copy->length);
        return copy->text != NULL && copyString(arena, event->data.scalar.anchor, &copy->anchor) &&
               copyString(arena, event->data.scalar.tag, &copy->tag);
    case YAML_SEQUENCE_START_EVENT:
        copy->inBrackets = event->data.sequence_start.style == YAML_FLOW_SEQUENCE_STYLE;
        return copyString(arena, event->data.sequence_start.anchor, &copy->anchor) &&
               copyString(arena, event->data.sequence_start.tag, &copy->tag);
    case YAML_MAPPING_START_EVENT:
        copy->inBrackets = event->data.mapping_start.style == YAML_FLOW_MAPPING_STYLE;
        return copyString(arena, event->data.mapping_start.anchor, &copy->anchor) &&
               copyString(arena, event->data.mapping_start.tag, &copy->tag);
    case YAML_ALIAS_EVENT:
        return copyString(arena, event->data.alias.anchor, &copy->anchor);
    default:
        return true;
    }
}

/* Parse one event into the batch; what ends the text, or EVENTS_GO_ON. */
static EventsEnd parseEvent(YamlEvents *events, Batch *batch)
{
    yaml_event_t event;
    if (!yaml_parser_parse(&events->parser, &event))
        return events->parser.error == YAML_MEMORY_ERROR ? EVENTS_OUT_OF_MEMORY : EVENTS_BROKEN;
    bool copied = copyEvent(&batch->texts, &event, &batch->events[batch->count]);
    batch->count += copied;
    yaml_event_type_t type = event.type;
    yaml_event_delete(&event);
    if (!copied)
        return EVENTS_OUT_OF_MEMORY;
    return type == YAML_STREAM_END_EVENT ? EVENTS_COMPLETE : EVENTS_GO_ON;
}

static void fillBatch(YamlEvents *events, Batch *batch)
{
    arenaRewind(&batch->texts, (ArenaMark){0});
    batch->count = 0;
    batch->end = cancelRequested() ? EVENTS_INTERRUPTED : EVENTS_GO_ON;
    while (batch->count < events->batchSize && batch->end == EVENTS_GO_ON)
        batch->end = parseEvent(events, batch);
}

/* ---- The thread ---- */

/* Fill batch after batch, until the text ends or nobody wants more. */
static void *parseAhead(void *argument)
{
    YamlEvents *events = argument;
    EventsEnd end = EVENTS_GO_ON;
    while (end == EVENTS_GO_ON) {
        pthread_mutex_lock(&events->mutex);
        while (events->filled - events->taken == BATCH_COUNT && !events->stopped)
            pthread_cond_wait(&events->isFree, &events->mutex);
        bool stopped = events->stopped;
        pthread_mutex_unlock(&events->mutex);
        if (stopped)
            break;
        Batch *batch = &events->batches[events->filled % BATCH_COUNT];
        fillBatch(events, batch);
        end = batch->end;
        pthread_mutex_lock(&events->mutex);
        events->filled++;
        pthread_cond_signal(&events->isFilled);
        pthread_mutex_unlock(&events->mutex);
    }
    return NULL;
}

/* Give back the batch that was read, and wait for the next one. */
static void takeBatch(YamlEvents *events)
{
    pthread_mutex_lock(&events->mutex);
    events->taken++;
    pthread_cond_signal(&events->isFree);
    while (events->filled == events->taken)
        pthread_cond_wait(&events->isFilled, &events->mutex);
    pthread_mutex_unlock(&events->mutex);
}

static void freeMutex(YamlEvents *events)
{
    pthread_cond_destroy(&events->isFilled);
    pthread_cond_destroy(&events->isFree);
    pthread_mutex_destroy(&events->mutex);
}

/* Where no thread can be made, the reader parses. */
static void startThread(YamlEvents *events)
{
    pthread_mutex_init(&events->mutex, NULL);
    pthread_cond_init(&events->isFilled, NULL);
    pthread_cond_init(&events->isFree, NULL);
    events->hasThread = pthread_create(&events->thread, NULL, parseAhead, events) == 0;
    if (!events->hasThread)
        freeMutex(events);
}

/* ---- Reading ---- */

YamlEvents *openYamlEvents(const SourceText *source)
{
    YamlEvents *events = calloc(1, sizeof *events);
    if (events == NULL)
        return NULL;
    bool isLong = source->length >= LONG_TEXT && availableProcessors() > 1;
    events->batchCount = isLong ? BATCH_COUNT : 1;
    events->batchSize = isLong ? LARGE_BATCH : SMALL_BATCH;
    events->storage = malloc(events->batchCount * events->batchSize * sizeof *events->storage);
    if (events->storage == NULL || !yaml_parser_initialize(&events->parser)) {
        free(events->storage);
        free(events);
        return NULL;
    }
    for (size_t i = 0; i < events->batchCount; i++)
        events->batches[i].events = events->storage + i * events->batchSize;
    yaml_parser_set_input_string(&events->parser, (const unsigned char *)source->text, source->length);
    yaml_parser_set_encoding(&events->parser, YAML_UTF8_ENCODING);

    /* The first batch is filled here, so that whoever reads always has one. */
    fillBatch(events, &events->batches[0]);
    events->filled = 1;
    if (isLong && events->batches[0].end == EVENTS_GO_ON)
        startThread(events);
    return events;
}

const YamlEvent *nextYamlEvent(YamlEvents *events, EventsEnd *end)
{
    Batch *batch = &events->batches[events->taken % events->batchCount];
    while (events->next == batch->count) {
        *end = batch->end;
        if (batch->end != EVENTS_GO_ON)
            return NULL;
        events->next = 0;
        if (events->hasThread)
            takeBatch(events);
        else
            fillBatch(events, batch);
        batch = &events->batches[events->taken % events->batchCount];
    }
    *end = EVENTS_GO_ON;
    return &batch->events[events->next++];
}

const yaml_parser_t *brokenYamlParser(const YamlEvents *events)
{
    return &events->parser;
}

void closeYamlEvents(YamlEvents *events)
{
    if (events == NULL)
        return;
    if (events->hasThread) {
        pthread_mutex_lock(&events->mutex);
        events->stopped = true;
        pthread_cond_signal(&events->isFree);
        pthread_mutex_unlock(&events->mutex);
        pthread_join(events->thread, NULL);
        freeMutex(events);
    }
    for (size_t i = 0; i < events->batchCount; i++)
        arenaFree(&events->batches[i].texts);
    yaml_parser_delete(&events->parser);
    free(events->storage);
    free(events);
}
