/* format_table.h - the scene format, once.
 *
 * This table drives the loader, the JSON Schema, the reference page and the suggestions; nothing about the
 * format is written anywhere else but the rules between keys (format_rules.h). A new key is a row in a
 * table of format_table.c, a new shape or light a table of its keys and a row in the table of kinds.
 * Invariant: offset + the size of the type lies within the mapping's values; a key has a fallback, is
 * optional, or is required; the fallbacks are what createScene() and defaultMaterial() give.
 */
#ifndef ECLAIRAGE_SCENE_FORMAT_TABLE_H
#define ECLAIRAGE_SCENE_FORMAT_TABLE_H

#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* How a value is written, and what is stored at its offset. ORDER types: format_table.c, reader.c,
 * read_values.c, write_schema.c and write_reference.c switch over all of them. */
typedef enum FormatType {
    FORMAT_NUMBER,    /* double; an optional one that is left out is NAN */
    FORMAT_FLOAT,     /* float */
    FORMAT_INTEGER,   /* int; with choices only those */
    FORMAT_BOOL,      /* bool */
    FORMAT_CHOICE,    /* an enum: one of the words in choices; an optional one that is left out is 0 */
    FORMAT_POINT,     /* Vector3D: [x, y, z] */
    FORMAT_DIRECTION, /* Vector3D, not [0, 0, 0] */
    FORMAT_FACTORS,   /* Vector3D: [x, y, z] or one number for all three, none of them 0 */
    FORMAT_COLOR,     /* Color3f: [r, g, b] or one number, at least 0; or else what mapping says */
    FORMAT_FILE,      /* const char *, in the tree: a path, relative to the scene's folder */
    FORMAT_SPHERES,   /* const YamlNode *: a list of [x, y, z, r], which finish reads; the range is of r */
    FORMAT_MATERIAL,  /* Material: a name from `materials`, or mapping written in place */
    FORMAT_MAPPING,   /* what mapping says */
    FORMAT_STEPS,     /* a list, each item as mapping says; all with the same target */
    FORMAT_NAMED,     /* names the author chooses, with what mapping says behind each */
    FORMAT_KINDS      /* a list of mappings with one key, its kind */
} FormatType;

typedef enum FormatLimit {
    LIMIT_NONE,
    LIMIT_INCLUDED,
    LIMIT_EXCLUDED
} FormatLimit;

typedef struct FormatRange {
    FormatLimit low, high;
    double min, max;
} FormatRange;

typedef struct FormatChoice {
    const char *word;
    int value;
    const char *help;
} FormatChoice;

typedef struct FormatMapping FormatMapping;
typedef struct FormatKinds FormatKinds;

typedef struct FormatKey {
    const char *name;
    FormatType type;
    size_t offset;         /* in the mapping's values */
    const char *fallback;  /* the default as it would be written, or NULL */
    const char *otherwise; /* what the reference says of an optional key that is left out, or NULL */
    bool optional;         /* may be left out and has no default */
    FormatRange range;     /* of a number or an integer */
    size_t count;          /* above 0: a list of so many values of the type, stored one after another */
    size_t least;          /* items that a list of kinds has at least */
    const char *excludes;  /* the key it cannot stand together with, or NULL */
    const FormatChoice *choices;
    size_t choiceCount;
    const FormatMapping *mapping;
    const FormatKinds *kinds;
    const char *help; /* one sentence without its full stop; units in it */
} FormatKey;

struct SceneReader;
struct GivenKeys;

struct FormatMapping {
    const char *name; /* as in messages: the section or kind */
    const char *help;
    const FormatKey *keys;
    size_t keyCount;
    const FormatKey *common; /* keys shared with others, such as the material of every object; or NULL */
    size_t commonCount;
    const char *oneKey; /* not NULL: exactly one of its keys must be there; the hint for a second one */
    bool isShared;      /* it is used by several keys, so that schema and reference describe it once */

    /* Called when all keys were read but lists of kinds, which are read last: what is inside may depend on
     * what is beside. May be NULL; finish is called in any case. */
    void (*enter)(struct SceneReader *reader, struct GivenKeys *given, void *values);

    /* Check what goes beyond single keys and put the values where they belong. With valuesSize 0 the values
     * are target itself; otherwise they are in a place of their own of that many bytes, and finish does
     * what is to be done with them. May be NULL. */
    size_t valuesSize;
    void (*finish)(struct SceneReader *reader, struct GivenKeys *given, void *values, void *target);
};

struct FormatKinds {
    const char *noun; /* one of them, such as "light" */
    const FormatMapping *const *kinds;
    size_t count;
};

enum {
    FORMAT_MAX_KEYS = 24,    /* in a mapping */
    FORMAT_MAX_VALUES = 1024 /* bytes of values */
};

/* The whole format: the mapping that a scene file is. */
extern const FormatMapping sceneFormat;

/* The key of many spheres whose value is their rows. */
extern const FormatKey *const rowsFormatKey;

/* The range of a colour's components, and of a scene's numbers without one. */
extern const FormatRange colorRange;
extern const FormatRange anyRange;

static inline size_t formatKeyCount(const FormatMapping *mapping)
{
    return mapping->keyCount + mapping->commonCount;
}

static inline const FormatKey *formatKey(const FormatMapping *mapping, size_t index)
{
    return index < mapping->keyCount ? &mapping->keys[index] : &mapping->common[index - mapping->keyCount];
}

/* The number of the key with this name, or formatKeyCount(mapping). */
size_t findFormatKey(const FormatMapping *mapping, const char *name, size_t length);

/* The kind with this name, or NULL. */
const FormatMapping *findFormatKind(const FormatKinds *kinds, const char *name, size_t length);

static inline bool isRequired(const FormatKey *key)
{
    return key->fallback == NULL && !key->optional;
}

bool isInFormatRange(const FormatRange *range, double value);

/* Append the range in words, such as "above 0 and below 180"; nothing where there is none. */
void textAppendRange(Text *text, const FormatRange *range);

/* Append the words of the choices, such as "srgb or linear". */
void textAppendChoices(Text *text, const FormatKey *key);

/* Append the keys of a mapping in braces, such as "{base, top}". */
void textAppendShape(Text *text, const FormatMapping *mapping);

/* Append what a value of the key is, such as "a number above 0". */
void textAppendExpectation(Text *text, const FormatKey *key);

#endif
