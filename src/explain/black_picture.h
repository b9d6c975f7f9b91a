/* black_picture.h - what a picture without any light may come from.
 *
 * Nothing can be seen in it, so mistakes that leave nothing to be seen cannot be told apart.
 */
#ifndef ECLAIRAGE_EXPLAIN_BLACK_PICTURE_H
#define ECLAIRAGE_EXPLAIN_BLACK_PICTURE_H

#include "explain/predict.h"

#include <stdbool.h>

bool isBlackPicture(const Image *image);

/* Append to what is told of a black picture, in brackets, that it may come from missing lights or from
 * normals that point inwards, if both would make the scene's picture black; else nothing. right: how the
 * scene's own picture would be stored. STATUS_IO when memory runs out, STATUS_INTERRUPTED when cancelled. */
Status appendBlackReasons(const Truth *truth, const Image *black, const Image *right, Text *text);

#endif
