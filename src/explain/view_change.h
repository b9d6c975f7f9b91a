/* view_change.h - what can be wrong with where a picture looks: mirrored, flipped, shifted, stretched. */
#ifndef ECLAIRAGE_EXPLAIN_VIEW_CHANGE_H
#define ECLAIRAGE_EXPLAIN_VIEW_CHANGE_H

#include <stdbool.h>

/* A point of the wrong picture shows what the right one has at another point. */
typedef struct ViewChange {
    bool mirrored, flipped;
    double shiftX, shiftY; /* in pixels */
    double scaleX, scaleY; /* about the middle of the picture; 1 */
} ViewChange;

/* The change that changes nothing. */
static inline ViewChange neutralViewChange(void)
{
    return (ViewChange){.scaleX = 1, .scaleY = 1};
}

static inline bool isNeutralView(const ViewChange *change)
{
    return !change->mirrored && !change->flipped && change->shiftX == 0 && change->shiftY == 0 &&
           change->scaleX == 1 && change->scaleY == 1;
}

/* Replace a point of the wrong picture, in pixels from the top left corner, by that of the right one. */
static inline void changePoint(const ViewChange *change, int width, int height, double *x, double *y)
{
    double fromMiddleX = *x - width * 0.5, fromMiddleY = *y - height * 0.5;
    if (change->mirrored)
        fromMiddleX = -fromMiddleX;
    if (change->flipped)
        fromMiddleY = -fromMiddleY;
    *x = fromMiddleX * change->scaleX + width * 0.5 + change->shiftX;
    *y = fromMiddleY * change->scaleY + height * 0.5 + change->shiftY;
}

#endif
