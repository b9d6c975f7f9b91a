/* scene_lines.h - find the line of a scene's YAML that a reader should look at. */
#ifndef ECLAIRAGE_EXPLAIN_SCENE_LINES_H
#define ECLAIRAGE_EXPLAIN_SCENE_LINES_H

#include "base/text.h"

/* The first line, from 1, where the text has "key:" outside comments; 0 where it has none. */
int findKeyLine(const char *text, const char *key);

/* Append where to look: "scene.yaml:12: formula" if the scene's text has the key, or the section that it
 * would stand in; else the formula alone. name, text and key may be NULL. */
void appendPlace(const char *name, const char *text, const char *key, const char *formula, Text *where);

#endif
