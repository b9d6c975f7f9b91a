/* black_picture.c - see black_picture.h. */
#include "explain/black_picture.h"

#include "explain/sample_rounding.h"

#include <math.h>
#include <stdlib.h>

enum {
    TRIED_PIXELS = 400,
    REASONS = 2
};

bool isBlackPicture(const Image *image)
{
    size_t count = 3 * (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++)
        if (image->samples[i] != 0)
            return false;
    return true;
}

/* Whether the change leaves nothing to be seen. */
static Status isMadeBlack(const Truth *truth, const Evidence *evidence, const LightChange *change,
                          bool *isBlack)
{
    ViewChange view = neutralViewChange();
    ValueChange value = neutralValueChange();
    Prediction prediction;
    Status status = predictPixels(truth, evidence, NULL, &view, change, false, &prediction);
    if (!statusIsOk(&status))
        return status;
    *isBlack = measureMisfit(evidence, &prediction, &value, 1, INFINITY).rmse == 0;
    freePrediction(&prediction);
    return status;
}

Status appendBlackReasons(const Truth *truth, const Image *black, const Image *right, Text *text)
{
    LightChange changes[REASONS] = {neutralLightChange(), neutralLightChange()};
    changes[0].lightScale = 0;
    changes[1].normals = NORMALS_FLIPPED;
    Evidence evidence;
    bool *isDifferent = findDifferentPixels(black, right);
    if (isDifferent == NULL)
        return statusOutOfMemory();
    Status status = gatherEvidence(black, isDifferent, NULL, TRIED_PIXELS, &evidence);
    free(isDifferent);
    if (!statusIsOk(&status))
        return status;
    bool isBlack[REASONS] = {false, false};
    for (int i = 0; i < REASONS && statusIsOk(&status); i++)
        status = isMadeBlack(truth, &evidence, &changes[i], &isBlack[i]);
    freeEvidence(&evidence);
    if (statusIsOk(&status) && isBlack[0] && isBlack[1])
        textAppend(text, " (the picture is black, as it is without lights, with normals that point into the "
                         "objects, and where nothing was drawn: it cannot tell which)");
    return status;
}
