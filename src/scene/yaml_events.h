/* yaml_events.h - what libyaml finds in a text, event by event.
 *
 * Events are made in batches. Where the text is long, a thread of its own parses some batches ahead while the
 * scene is built from those before; whoever reads the events cannot tell the difference, as an error of
 * libyaml's is an end that comes after all events before it.
 * Invariant: an event and its texts stay as they are until the next one is asked for.
 */
#ifndef ECLAIRAGE_SCENE_YAML_EVENTS_H
#define ECLAIRAGE_SCENE_YAML_EVENTS_H

#include "scene/source_text.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <yaml.h>

typedef struct YamlEvent {
    Place place; /* of a list or mapping: where it begins */
    int endLine;
    uint8_t type;       /* yaml_event_type_t */
    bool plain;         /* scalar: without quotes */
    bool inBrackets;    /* list or mapping: written in brackets */
    const char *text;   /* scalar: NUL-terminated */
    size_t length;      /* its bytes */
    const char *anchor; /* or NULL; of an alias the anchor that it names */
    const char *tag;    /* or NULL */
} YamlEvent;

/* Why there is no further event. */
typedef enum EventsEnd {
    EVENTS_GO_ON, /* there is one */
    EVENTS_BROKEN,
    EVENTS_OUT_OF_MEMORY,
    EVENTS_INTERRUPTED,
    EVENTS_COMPLETE /* all were read */
} EventsEnd;

typedef struct YamlEvents YamlEvents;

/* Begin at the start of a text, which outlives the events. NULL when memory runs out. */
YamlEvents *openYamlEvents(const SourceText *source);

/* The next event; NULL where there is none, and then *end says why. */
const YamlEvent *nextYamlEvent(YamlEvents *events, EventsEnd *end);

/* The parser after EVENTS_BROKEN, for its error. */
const yaml_parser_t *brokenYamlParser(const YamlEvents *events);

/* Stop, wherever parsing is; events may be NULL. */
void closeYamlEvents(YamlEvents *events);

#endif
