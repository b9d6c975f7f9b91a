/* difference.h - the difference of two pictures as a picture. */
#ifndef ECLAIRAGE_COMPARE_DIFFERENCE_H
#define ECLAIRAGE_COMPARE_DIFFERENCE_H

#include "base/status.h"
#include "image/image.h"

/* The largest channel difference of each pixel through a perceptually uniform colour map, with the map's
 * scale and its end values drawn below. The scale ends at the largest difference, so that differences of
 * 1/65535 can be seen; equal pictures give the map's first colour. 8-bit sRGB; the caller frees it. */
Status differencePicture(const Image *a, const Image *b, Image *difference);

#endif
