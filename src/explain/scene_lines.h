/* scene_lines.h - find the line of a scene's YAML that a reader should look at. */
#ifndef ECLAIRAGE_EXPLAIN_SCENE_LINES_H
#define ECLAIRAGE_EXPLAIN_SCENE_LINES_H

#include "base/text.h"

#include <stddef.h>

/* The first line, from 1, where the text has "key:" outside comments; 0 where it has none. */
int findKeyLine(const char *text, const char *key);

/* The line of an item, numbered from 0, of a list that is a section of the scene, such as "lights"; written
 * with dashes or in brackets. 0 where it is not found. */
int findItemLine(const char *text, const char *section, size_t number);

/* Append where to look: "scene.yaml:12: formula" if the scene's text has the key, or the section that it
 * would stand in; else the formula alone. name, text and key may be NULL. */
void appendPlace(const char *name, const char *text, const char *key, const char *formula, Text *where);

#endif
