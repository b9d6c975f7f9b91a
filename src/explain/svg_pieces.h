/* svg_pieces.h - the pieces that a drawing is put together from: text, numbers and shapes as SVG.
 *
 * All are appended to a Text, which notes when memory runs out. Coordinates are pixels, y down.
 */
#ifndef ECLAIRAGE_EXPLAIN_SVG_PIECES_H
#define ECLAIRAGE_EXPLAIN_SVG_PIECES_H

#include "base/text.h"
#include "explain/cut_outline.h"

#include <stddef.h>

/* Append text with what XML keeps for itself escaped, and what it cannot hold replaced by '?'. */
void appendEscaped(Text *text, const char *words);

/* Append ` name="value"`, the value in pixels. */
void appendAttribute(Text *text, const char *name, double value);

/* Append an element. attributes: those but for the coordinates, as they stand in the file. */
void appendLine(Text *text, DrawnPoint a, DrawnPoint b, const char *attributes);
void appendCircle(Text *text, DrawnPoint at, double radius, const char *attributes);

/* Append the definition of an arrow's head with this id. */
void appendMarker(Text *text, const char *name, const char *color);

/* The characters of a text in UTF-8, to guess how wide it will be. */
size_t countCharacters(const char *words);

#endif
