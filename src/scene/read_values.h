/* read_values.h - one value, from a node or from its default in the table.
 *
 * Invariant: what is stored is finite and within the key's range; nothing is stored where an error was
 * reported.
 */
#ifndef ECLAIRAGE_SCENE_READ_VALUES_H
#define ECLAIRAGE_SCENE_READ_VALUES_H

#include "scene/reader.h"

/* Read a number, a truth, a word, a vector, a colour or a path, or as many as the key's count says; false
 * when it is wrong, which is reported at place. */
bool readSimpleValue(SceneReader *reader, const FormatKey *key, Place place, const YamlNode *value,
                     void *target);

/* Read one sphere [x, y, z, r] of a list of them; key: of the list. */
bool readSphereRow(SceneReader *reader, const FormatKey *key, const YamlNode *row, double numbers[4]);

/* The same for a row that is right and needs no more than its numbers: false, with nothing reported, where
 * readSphereRow is to read it. */
bool takeSphereRow(const YamlNode *row, double numbers[4]);

/* Store the key's default among the values of its mapping. */
void storeDefault(const FormatKey *key, void *values);

/* Report that the value is something else than the key wants. */
void reportWrongType(SceneReader *reader, const FormatKey *key, Place place, const YamlNode *value);

/* Append "a list", "the text 'abc'" and the like. */
void textAppendNode(Text *text, const YamlNode *node);

#endif
