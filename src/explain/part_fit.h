/* part_fit.h - colours that are found from a picture by least squares.
 *
 * A picture is linear in the colour of each lamp, and in each colour of a material that only sends light
 * back: twice the colour adds the same light once more. So what such a colour must be for a picture is the
 * solution of a linear system, one for each channel, in linear light.
 */
#ifndef ECLAIRAGE_EXPLAIN_PART_FIT_H
#define ECLAIRAGE_EXPLAIN_PART_FIT_H

#include "explain/evidence.h"

#include <stdbool.h>

enum {
    MOST_FITTED = 16 /* colours at once */
};

/* Find what must be added to each of count colours, so that the predicted pixels become the evidence's.
 * before: the prediction as it is. terms[i]: what is predicted when 1 is added to each channel of colour i
 * and the others are as they are. Of a colour that can be seen nowhere in a channel, added is 0 there and
 * *isSeen false. Pixels that are as bright as can be stored do not count. */
void fitColors(const Evidence *evidence, const Prediction *before, const Prediction *terms, int count,
               float added[][3], bool isSeen[][3]);

#endif
