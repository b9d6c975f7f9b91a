/* colormap.h - the colours of a difference picture.
 *
 * A path through OKLab (B. Ottosson: A perceptual color space for image processing, 2020): from black over
 * violet, red and orange to a pale yellow. Lightness only rises, so the order survives on a grey printer
 * and for colour-blind readers; equal steps of value are equal distances in OKLab within 7 %. Equality has a
 * colour of its own, the first: the slightest difference starts a visible step above it.
 */
#ifndef ECLAIRAGE_COMPARE_COLORMAP_H
#define ECLAIRAGE_COMPARE_COLORMAP_H

#include <stdint.h>

enum {
    COLOR_MAP_SIZE = 1024
};

typedef struct ColorMap {
    uint16_t colors[COLOR_MAP_SIZE][3]; /* sRGB, 0..255, from equal to the end of the scale */
} ColorMap;

void makeColorMap(ColorMap *map);

/* The colour of a difference as a share of the scale, 0..1: 0 is the map's first colour, more lies in the
 * upper five sixths of the map. */
const uint16_t *colorOfDifference(const ColorMap *map, double share);

#endif
