/* reader.h - from nodes to values, as the table says.
 *
 * A mapping is read in three steps: beginMapping stores the defaults, acceptKey and readValue take one key
 * after another in the order of the file, endMapping reports what is missing and calls the mapping's
 * finish. Errors are reported and reading goes on; what was wrong keeps its default.
 * Invariant: every value of a scene that is read without an error is in its range and finite.
 */
#ifndef ECLAIRAGE_SCENE_READER_H
#define ECLAIRAGE_SCENE_READER_H

#include "raytracer.h"
#include "scene/diagnostics.h"
#include "scene/format_table.h"
#include "scene/name_table.h"
#include "scene/object_scopes.h"
#include "scene/scene_files.h"
#include "scene/source_text.h"
#include "scene/yaml_tree.h"

#include <stdbool.h>
#include <stddef.h>

/* A material by the number of its name. */
typedef struct NamedMaterial {
    Material material;
    bool defined;
    int line;               /* of the definition */
    bool isSearched;        /* nothing defines it, and the nearest name was looked for: */
    const char *suggestion; /* or NULL */
} NamedMaterial;

typedef struct SceneReader {
    Scene *scene;
    SourceText *source;
    Diagnostics *diagnostics;
    SceneFiles *files;
    bool outOfMemory, interrupted;

    NameTable materialNames;
    NamedMaterial *materials; /* by number of the name */
    size_t materialCapacity;
    MaterialUse *uses; /* in the order of their leaves */
    size_t useCount, useCapacity;
    MaterialUse pendingUse; /* of the object being read; name is NAME_NONE when it names none */

    ObjectScope *scope; /* the innermost group and the like being read, or NULL */
    size_t leafCount;
    Place *solidPlaces; /* of the solids that are no parts of others */
    size_t solidCount, solidPlaceCapacity;

    /* Where things are, for the warnings. */
    Place positionPlace, viewPlace; /* of the camera; line 0: it is not in the file */
    Place *lightPlaces;             /* of each light of the scene */
    size_t lightPlaceCapacity;
} SceneReader;

/* Which keys of a mapping are there. */
typedef struct GivenKeys {
    const FormatMapping *format;
    Place place;                           /* of what the mapping belongs to */
    const YamlNode *keys[FORMAT_MAX_KEYS]; /* by the key's number, or NULL */
    Place places[FORMAT_MAX_KEYS];         /* of the values */
    bool wrong[FORMAT_MAX_KEYS];           /* it was reported */
    bool anyUnknown;                       /* another key was, too */
} GivenKeys;

SceneReader beginReader(Scene *scene, SourceText *source, Diagnostics *diagnostics, SceneFiles *files);
void freeReader(SceneReader *reader);

void beginMapping(const FormatMapping *format, Place place, GivenKeys *given, void *values);

/* The key that the node names, and its number; NULL when it is unknown, given before or not a word, which
 * is reported. */
const FormatKey *acceptKey(SceneReader *reader, GivenKeys *given, const YamlNode *keyNode, size_t *number);

/* Read the value of the key with this number. */
void readValue(SceneReader *reader, GivenKeys *given, size_t number, const YamlNode *valueNode, void *values);

void endMapping(SceneReader *reader, GivenKeys *given, void *values, void *target);

/* Read one item of a list of kinds. */
void readKindItem(SceneReader *reader, const FormatKinds *kinds, const YamlNode *item);

/* Read all of a mapping that is a tree already; place is that of what it belongs to. */
void readMapping(SceneReader *reader, const FormatMapping *format, Place place, const YamlNode *node,
                 void *target);

/* Parts of reading that material_names.c shares. */

/* The scalar that a key is; NULL, reported, when it is something else. */
const YamlNode *keyWord(SceneReader *reader, const YamlNode *keyNode);
/* Returns the number of the key that was probably meant, or formatKeyCount(format). */
size_t reportUnknownKey(SceneReader *reader, const FormatMapping *format, const YamlNode *keyNode);
void reportDuplicate(SceneReader *reader, Place place, const YamlNode *word, int firstLine);

/* The array with room for one item more; NULL when memory runs out, which is noted. */
void *makeReaderRoom(SceneReader *reader, void *array, size_t count, size_t *capacity, size_t itemSize);

/* Whether reading must end at once: memory ran out, or the user asked. */
bool mustStop(const SceneReader *reader);

/* ---- For finish functions ---- */

/* Report an error; hint may be NULL. */
void reportError(SceneReader *reader, Place place, const char *hint, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The same at the value of a key, which counts as wrong from then on. */
void reportKeyError(SceneReader *reader, GivenKeys *given, const char *key, const char *hint,
                    const char *format, ...) __attribute__((format(printf, 5, 6)));

/* Whether the key is in the file with a value that is right. */
bool isGiven(const GivenKeys *given, const char *name);

/* Whether the key has a usable value: given and right, or its default. */
bool isUsable(const GivenKeys *given, const char *name);

/* Whether all keys of the mapping have usable values. */
bool areAllUsable(const GivenKeys *given);

/* The place of the key's value; of the whole mapping when it is not given. */
Place placeOfKey(const GivenKeys *given, const char *name);

/* Add a light that was built. */
void addReadLight(SceneReader *reader, const GivenKeys *given, Light light);

#endif
