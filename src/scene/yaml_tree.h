/* yaml_tree.h - a YAML document, node by node.
 *
 * libyaml delivers events; here they become nodes with places. The document may be walked piece by piece,
 * so that a list of a million objects is never in memory as a whole: enter the mapping, enter the list,
 * read one item, rewind the arena, read the next.
 * What libyaml 0.2.5 lets pass is stopped here, while events are pulled: nesting deeper than YAML_MAX_DEPTH
 * (it takes quadratic time over 100 kB of `[`) and thousands of %TAG directives (quadratic too), aliases of
 * undefined anchors or within themselves, anchors defined twice, tags, documents blown up by aliases, a
 * second document. Invariant: a node's height plus the depth it stands at is at most YAML_MAX_DEPTH, aliases
 * followed, so that walking a tree recursively is safe.
 */
#ifndef ECLAIRAGE_SCENE_YAML_TREE_H
#define ECLAIRAGE_SCENE_YAML_TREE_H

#include "scene/arena.h"
#include "scene/diagnostics.h"
#include "scene/name_table.h"
#include "scene/source_text.h"
#include "scene/yaml_events.h"
#include "scene/yaml_syntax.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    YAML_MAX_DEPTH = 64,

    /* Nodes that may be reached through aliases: ALIAS_BUDGET, and ALIAS_BUDGET_PER_NODE more for each
     * node that is written out, so that reading stays linear in the length of the file. */
    ALIAS_BUDGET = 1000000,
    ALIAS_BUDGET_PER_NODE = 16
};

typedef enum NodeKind {
    NODE_SCALAR,
    NODE_LIST,
    NODE_MAPPING,
    NODE_ALIAS,
    NODE_ROWS /* of a list: items that RowFormat took; only behind its key, and never behind an alias */
} NodeKind;

enum {
    YAML_ROW_NUMBERS = 4
};

/* A list of numbers. */
typedef struct YamlRow {
    double numbers[YAML_ROW_NUMBERS];
    int line; /* where it begins */
} YamlRow;

struct YamlNode;

/* Lists that may come in millions, the items of the list behind a key. They are kept as their numbers, in a
 * sixth of the memory, and without the places of these: only rows that no more is to be said of. */
typedef struct RowFormat {
    const char *key;
    /* Store the numbers of a list of YAML_ROW_NUMBERS items if nothing is wrong with them. */
    bool (*take)(const struct YamlNode *list, double numbers[YAML_ROW_NUMBERS]);
} RowFormat;

typedef struct YamlNode {
    struct YamlNode *next; /* in the same list or mapping */
    union {
        const char *text;              /* scalar: NUL-terminated */
        struct YamlNode *first;        /* list: the items; mapping: key, value, key, value ... */
        const struct YamlNode *target; /* alias: never an alias itself; NULL: undefined, already reported */
        YamlRow *rows;
    };
    size_t count;   /* scalar: bytes; list: items; mapping: pairs; rows */
    uint64_t size;  /* nodes in it, itself and what aliases lead to included */
    Place place;    /* of a list or mapping: where it begins */
    uint8_t kind;   /* NodeKind */
    uint8_t height; /* levels of lists and mappings: 0 for a scalar */
    bool plain;     /* scalar: without quotes */
} YamlNode;

/* An anchor by its number in the table of names. */
typedef struct YamlAnchor {
    const YamlNode *node; /* NULL while the node is being read */
    int line;
} YamlAnchor;

typedef struct YamlReader {
    SourceText *source;
    Diagnostics *diagnostics;
    Arena arena; /* the nodes */
    RowFormat rowFormat;
    YamlEvents *events;
    const YamlEvent *event; /* the next one, or NULL: not asked for yet */
    int depth;
    bool inBrackets[YAML_MAX_DEPTH]; /* of the lists and mappings being read, from the root */
    Place openings[YAML_MAX_DEPTH];
    SyntaxContext syntax; /* its part about the last text */
    uint64_t nodeCount, aliasNodes;
    NameTable anchorNames;
    YamlAnchor *anchors;
    size_t anchorCapacity;
    int anchoredDepth; /* how many of the nodes being read have anchors */

    /* Nothing more can be read: an error that is in diagnostics, or one of the next two. */
    bool failed;
    bool outOfMemory, interrupted;
} YamlReader;

/* What comes next. */
typedef enum YamlNext {
    NEXT_FAILED,
    NEXT_SCALAR,
    NEXT_ALIAS,
    NEXT_LIST,
    NEXT_MAPPING,
    NEXT_END /* of the list or mapping, or of the document */
} YamlNext;

/* Begin at the document's root. source is checked by checkEncoding and outlives the reader. */
void openYaml(YamlReader *reader, SourceText *source, Diagnostics *diagnostics, RowFormat rowFormat);
void closeYaml(YamlReader *reader);

YamlNext peekYaml(YamlReader *reader);

/* Whether the node that comes next has an anchor. */
bool nextHasAnchor(const YamlReader *reader);

/* Enter the list or mapping that comes next; leave it when NEXT_END is next. */
void enterYaml(YamlReader *reader, Place *place);
void leaveYaml(YamlReader *reader);

/* Read one whole node; NULL when reader->failed. */
const YamlNode *readYamlNode(YamlReader *reader);

/* After the root: report what follows it. */
void finishYaml(YamlReader *reader);

/* The node itself, or what the alias stands for; NULL for an undefined alias. */
static inline const YamlNode *resolveAlias(const YamlNode *node)
{
    return node->kind == NODE_ALIAS ? node->target : node;
}

#endif
