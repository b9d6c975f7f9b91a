/* material_names.h - materials that have a name, and who uses them.
 *
 * A name gets its number when it is first seen, in a definition or in a use; a use may come before the
 * definition, so objects get their materials when the whole file was read.
 */
#ifndef ECLAIRAGE_SCENE_MATERIAL_NAMES_H
#define ECLAIRAGE_SCENE_MATERIAL_NAMES_H

#include "scene/reader.h"

/* The number of a material's name; NAME_NONE when memory runs out, which is noted. */
size_t materialNumber(SceneReader *reader, const char *text, size_t length);

/* Read the section of the key: names with a mapping behind each. */
void readNamedMaterials(SceneReader *reader, const FormatKey *key, const YamlNode *node);

/* When all was read: report the names in use that nothing defines. */
void reportUndefinedMaterials(SceneReader *reader);

#endif
