/* downhill.c - see downhill.h. */
#include "explain/downhill.h"

#include <math.h>
#include <stdbool.h>

/* A corner of the simplex. */
typedef struct Corner {
    double numbers[MOST_NUMBERS];
    double value;
} Corner;

static void measureCorner(const Downhill *downhill, Corner *corner)
{
    corner->value = downhill->measure(downhill->context, corner->numbers);
}

static void sortCorners(Corner *corners, int count)
{
    for (int i = 1; i < count; i++)
        for (int j = i; j > 0 && corners[j].value < corners[j - 1].value; j--) {
            Corner moved = corners[j];
            corners[j] = corners[j - 1];
            corners[j - 1] = moved;
        }
}

/* The point so far from the middle of all corners but the last, on the line to the last one. */
static Corner cornerAlong(const Downhill *downhill, const Corner *corners, double far)
{
    int last = downhill->dimensions;
    Corner made = corners[last];
    for (int k = 0; k < last; k++) {
        double middle = 0;
        for (int i = 0; i < last; i++)
            middle += corners[i].numbers[k] / last;
        made.numbers[k] = middle + far * (corners[last].numbers[k] - middle);
    }
    measureCorner(downhill, &made);
    return made;
}

/* Move all corners half way to the best one. */
static void shrink(const Downhill *downhill, Corner *corners)
{
    for (int i = 1; i <= downhill->dimensions; i++) {
        for (int k = 0; k < downhill->dimensions; k++)
            corners[i].numbers[k] = 0.5 * (corners[i].numbers[k] + corners[0].numbers[k]);
        measureCorner(downhill, &corners[i]);
    }
}

/* Put a better corner in the place of the last one. */
static void improve(const Downhill *downhill, Corner *corners)
{
    Corner *last = &corners[downhill->dimensions];
    Corner mirrored = cornerAlong(downhill, corners, -1);
    if (mirrored.value < corners[0].value) {
        Corner farther = cornerAlong(downhill, corners, -2);
        *last = farther.value < mirrored.value ? farther : mirrored;
        return;
    }
    if (mirrored.value < last[-1].value) {
        *last = mirrored;
        return;
    }
    Corner nearer = cornerAlong(downhill, corners, mirrored.value < last->value ? -0.5 : 0.5);
    if (nearer.value < last->value)
        *last = nearer;
    else
        shrink(downhill, corners);
}

double goDownhill(const Downhill *downhill, double numbers[MOST_NUMBERS])
{
    Corner corners[MOST_NUMBERS + 1];
    int last = downhill->dimensions;
    for (int i = 0; i <= last; i++) {
        for (int k = 0; k < MOST_NUMBERS; k++)
            corners[i].numbers[k] = numbers[k] + (k == i - 1 ? downhill->step : 0);
        measureCorner(downhill, &corners[i]);
    }
    sortCorners(corners, last + 1);
    for (int turn = 0; turn < downhill->turns && corners[0].value > downhill->enough; turn++) {
        bool isHopeless = turn >= downhill->hopeTurns && !(corners[0].value < downhill->hope);
        if (isHopeless || !(corners[last].value - corners[0].value > 1e-9))
            break;
        improve(downhill, corners);
        sortCorners(corners, last + 1);
    }
    for (int k = 0; k < MOST_NUMBERS; k++)
        numbers[k] = corners[0].numbers[k];
    return corners[0].value;
}

double goldenSection(double (*measure)(void *context, double number), void *context, double a, double b,
                     int steps)
{
    const double ratio = 0.6180339887498949;
    double x = b - ratio * (b - a), y = a + ratio * (b - a);
    double atX = measure(context, x), atY = measure(context, y);
    for (int step = 0; step < steps; step++) {
        if (atX <= atY) {
            b = y;
            y = x;
            atY = atX;
            x = b - ratio * (b - a);
            atX = measure(context, x);
        } else {
            a = x;
            x = y;
            atX = atY;
            y = a + ratio * (b - a);
            atY = measure(context, y);
        }
    }
    return 0.5 * (a + b);
}
