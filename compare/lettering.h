/* lettering.h - small text in pictures: digits, lowercase letters and a few signs, 5 pixels wide. */
#ifndef ECLAIRAGE_COMPARE_LETTERING_H
#define ECLAIRAGE_COMPARE_LETTERING_H

#include "image/image.h"

enum {
    LETTER_ADVANCE = 6, /* pixels from one letter to the next, at scale 1 */
    LETTER_HEIGHT = 7   /* above the line's foot; 2 more are below it in g, p, q and the comma */
};

/* The width of a text in pixels. */
int measureText(const char *text, int scale);

/* Draw a text with its top left corner at (x, y), each of its dots scale x scale pixels. What lies outside
 * the picture is cut; a character that is not drawn leaves its place empty. */
void drawText(Image *image, int x, int y, int scale, const uint16_t color[3], const char *text);

/* Fill a rectangle; what lies outside the picture is cut. */
void fillRectangle(Image *image, int x, int y, int width, int height, const uint16_t color[3]);

#endif
