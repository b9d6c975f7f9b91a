/* story_words.h - how the story of a pixel becomes lines of text: indented, with numbers of five digits. */
#ifndef ECLAIRAGE_EXPLAIN_STORY_WORDS_H
#define ECLAIRAGE_EXPLAIN_STORY_WORDS_H

#include "base/text.h"
#include "explain/pixel_story.h"

#include <stdbool.h>

enum {
    MOST_NAMED = 16 /* samples and objects that are listed */
};

typedef struct Teller {
    const PixelStory *story;
    Text *text;
    bool color; /* headings are bold */
    int indent; /* of the lines to come, in spaces */
} Teller;

/* The words are given by a format: %v a Vector3D, %c a Color3f, %g a double, %s a string, %u a size_t, %d an
 * int, %o a const Object * and its part. */

/* Append words without a line of their own. */
void addWords(Teller *teller, const char *format, ...);

/* Begin a line that addWords goes on with. */
void beginLine(Teller *teller);

/* Append a whole line; a line that opens a part of the story, after an empty one. */
void sayLine(Teller *teller, const char *format, ...);
void sayHeading(Teller *teller, const char *format, ...);

/* ---- The lights, in story_light_text.c ---- */

/* Tell what each light does at the point where the ray met a surface. */
void sayLights(Teller *teller, const RayStory *ray);

#endif
