/* story_writers.h - a pixel's story as words, as JSON and as a drawing.
 *
 * povray may be NULL where POV-Ray was not asked. Nothing fails but for memory, which the Text notes.
 */
#ifndef ECLAIRAGE_EXPLAIN_STORY_WRITERS_H
#define ECLAIRAGE_EXPLAIN_STORY_WRITERS_H

#include "base/json.h"
#include "base/text.h"
#include "explain/pixel_story.h"

#include <stdbool.h>

/* Append the story in the order of the formula, numbers with five significant digits; with colour, headings
 * are bold. name: how the scene is called. */
void writeStoryText(const PixelStory *story, const PovrayPixel *povray, const char *name, bool color,
                    Text *text);

/* Append one JSON document, numbers in full. */
void writeStoryJson(const PixelStory *story, const PovrayPixel *povray, const char *name, Text *text);

/* Append an SVG document: the scene from the side, cut by the plane of the camera's ray and the first light
 * that matters. It needs nothing else and has its own background. */
void writeStorySvg(const PixelStory *story, const char *name, Text *text);

#endif
