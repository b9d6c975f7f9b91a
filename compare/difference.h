/* difference.h - the difference of two pictures as a picture. */
#ifndef ECLAIRAGE_COMPARE_DIFFERENCE_H
#define ECLAIRAGE_COMPARE_DIFFERENCE_H

#include "base/status.h"
#include "image/image.h"

/* The largest channel difference of each pixel through a perceptually uniform colour map (colormap.h),
 * with the map's scale and its values drawn below. The scale ends at the largest difference, so that
 * differences of 1/65535 can be seen; a pixel that is equal has the map's first colour, which no other
 * has. The top left width x height pixels are the pixels of the two pictures; below is the scale, and at
 * the right paper where the pictures are narrower than 320. 8-bit sRGB; the caller frees it.
 * STATUS_MISMATCH for pictures that cannot be compared, STATUS_IO when memory runs out,
 * STATUS_INTERRUPTED when cancelled; then *difference is untouched. */
Status differencePicture(const Image *a, const Image *b, Image *difference);

#endif
