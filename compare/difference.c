/* difference.c - the difference of two pictures as a picture; see difference.h.
 *
 * Layout, with all distances times a scale that grows with the width:
 *
 *     the picture, width x height, at the top left         (paper at its right when it is narrow)
 *     difference of each pixel (largest of r, g, b)
 *     [== the colours, from 0 to the largest difference ==]
 *     0        |        |        |        |                 ticks at round values
 *     [] equal          largest 3/255 = 0.01176 at 12,7
 */
#include "compare/difference.h"

#include "base/cancel.h"
#include "base/text.h"
#include "compare/colormap.h"
#include "compare/lettering.h"
#include "compare/metrics.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    LEAST_WIDTH = 320, /* holds the longest line at scale 1 */
    WIDTH_OF_SCALE = 480,
    LARGEST_SCALE = 6,
    MARGIN = 6,
    TITLE_TOP = 6,
    BAR_TOP = 19,
    BAR_HEIGHT = 12,
    TICK_HEIGHT = 3,
    LABEL_TOP = BAR_TOP + BAR_HEIGHT + TICK_HEIGHT + 2,
    NOTE_TOP = LABEL_TOP + 14,
    LEGEND_HEIGHT = NOTE_TOP + 15,
    LABEL_SIZE = 48,
    LABEL_DIGITS = 4,
    MOST_STEPS_TICKED = 8, /* up to here the ticks are the sample steps themselves */
    MOST_TICKS = 6
};

static const uint16_t PAPER[3] = {246, 246, 246}, INK[3] = {24, 24, 24};

/* What the picture shows. */
typedef struct Shown {
    const Image *a, *b;
    unsigned largest; /* difference, in sample steps */
    int x, y;         /* where it is first */
} Shown;

/* The largest channel difference of a pixel, in sample steps. */
static unsigned pixelDifference(const Shown *shown, size_t pixel)
{
    const uint16_t *a = shown->a->samples + 3 * pixel, *b = shown->b->samples + 3 * pixel;
    unsigned largest = 0;
    for (int channel = 0; channel < 3; channel++) {
        unsigned difference = (unsigned)abs(a[channel] - b[channel]);
        largest = difference > largest ? difference : largest;
    }
    return largest;
}

static Status findLargest(Shown *shown)
{
    for (int y = 0; y < shown->a->height; y++) {
        if (cancelRequested())
            return statusInterrupted();
        for (int x = 0; x < shown->a->width; x++) {
            unsigned difference = pixelDifference(shown, (size_t)y * (size_t)shown->a->width + (size_t)x);
            if (difference > shown->largest) {
                shown->largest = difference;
                shown->x = x;
                shown->y = y;
            }
        }
    }
    return statusOk();
}

static Status drawDifferences(const Shown *shown, const ColorMap *map, Image *canvas)
{
    int width = shown->a->width;
    for (int y = 0; y < shown->a->height; y++) {
        if (cancelRequested())
            return statusInterrupted();
        for (int x = 0; x < width; x++) {
            unsigned difference = pixelDifference(shown, (size_t)y * (size_t)width + (size_t)x);
            const uint16_t *color =
                colorOfDifference(map, difference == 0 ? 0 : (double)difference / shown->largest);
            fillRectangle(canvas, x, y, 1, 1, color);
        }
    }
    return statusOk();
}

/* The distance of the ticks, in 0..1: whole sample steps where there are few, else 1, 2 or 5 times a power
 * of ten, so that there are at most MOST_TICKS. */
static double chooseTickDistance(const Shown *shown, double end)
{
    if (shown->largest <= MOST_STEPS_TICKED)
        return (shown->largest <= MOST_STEPS_TICKED / 2 ? 1.0 : 2.0) / imageMaxSample(shown->a);
    double distance = pow(10, floor(log10(end)) - 1);
    for (int i = 0; end / distance > (double)MOST_TICKS; i++)
        distance *= i % 3 == 1 ? 2.5 : 2; /* 1, 2, 5, 10 */
    return distance;
}

/* Draw the bar of colours with its ticks and labels; top is the legend's first row. */
static void drawScale(const Shown *shown, const ColorMap *map, Image *canvas, int top, int scale)
{
    int left = MARGIN * scale, width = canvas->width - 2 * left;
    unsigned largestSample = imageMaxSample(shown->a);
    double end = (double)shown->largest / largestSample;
    /* Frame the bar, whose end is nearly as light as the paper. */
    fillRectangle(canvas, left - scale, top + (BAR_TOP - 1) * scale, width + 2 * scale,
                  (BAR_HEIGHT + 2) * scale, INK);
    for (int x = 0; x < width; x++)
        fillRectangle(canvas, left + x, top + BAR_TOP * scale, 1, BAR_HEIGHT * scale,
                      colorOfDifference(map, (x + 0.5) / width));
    double distance = chooseTickDistance(shown, end);
    int freeFrom = 0; /* no label may start before */
    for (int i = 0; i * distance <= end * (1 + 1e-9); i++) {
        char label[LABEL_SIZE], number[NUMBER_TEXT_SIZE];
        if (i > 0 && shown->largest <= MOST_STEPS_TICKED)
            snprintf(label, sizeof label, "%.0f/%u", i * distance * largestSample, largestSample);
        else
            snprintf(label, sizeof label, "%s", formatRounded(number, i * distance, LABEL_DIGITS));
        int x = left + (int)(i * distance / end * (width - scale) + 0.5);
        fillRectangle(canvas, x, top + (BAR_TOP + BAR_HEIGHT) * scale, scale, TICK_HEIGHT * scale, INK);
        /* Center the label below its tick, inside the bar's ends, unless it would touch the one before. */
        int labelWidth = measureText(label, scale) - scale;
        int from = x + scale / 2 - labelWidth / 2;
        from = from + labelWidth > left + width ? left + width - labelWidth : from;
        from = from < left ? left : from;
        if (from < freeFrom)
            continue;
        drawText(canvas, from, top + LABEL_TOP * scale, scale, INK, label);
        freeFrom = from + labelWidth + LETTER_ADVANCE * scale;
    }
}

static void drawLegend(const Shown *shown, const ColorMap *map, Image *canvas, int top, int scale)
{
    int left = MARGIN * scale;
    char note[96], number[NUMBER_TEXT_SIZE];
    drawText(canvas, left, top + TITLE_TOP * scale, scale, INK,
             "difference of each pixel (largest of r, g, b)");
    /* Show the colour of equality, in a frame since it may lie beside black. */
    int noteTop = top + NOTE_TOP * scale, box = (LETTER_HEIGHT + 2) * scale;
    fillRectangle(canvas, left, noteTop - scale, box, box, map->colors[0]);
    drawText(canvas, left + box + 4 * scale, noteTop, scale, INK, "equal");
    if (shown->largest == 0) {
        drawText(canvas, left, top + (BAR_TOP + 2) * scale, scale, INK, "no pixel differs");
        return;
    }
    drawScale(shown, map, canvas, top, scale);
    unsigned largestSample = imageMaxSample(shown->a);
    snprintf(note, sizeof note, "largest %u/%u = %s at %d,%d", shown->largest, largestSample,
             formatRounded(number, (double)shown->largest / largestSample, LABEL_DIGITS), shown->x, shown->y);
    int width = measureText(note, scale) - scale;
    drawText(canvas, canvas->width - left - width, noteTop, scale, INK, note);
}

Status differencePicture(const Image *a, const Image *b, Image *difference)
{
    Status status = checkComparable(a, "the first", b, "the second");
    if (!statusIsOk(&status))
        return status;
    Shown shown = {.a = a, .b = b};
    status = findLargest(&shown);
    if (!statusIsOk(&status))
        return status;
    /* Make room for the legend below, and at the right where the picture is too narrow for it. */
    int width = a->width > LEAST_WIDTH ? a->width : LEAST_WIDTH;
    int scale = width / WIDTH_OF_SCALE;
    scale = scale < 1 ? 1 : scale > LARGEST_SCALE ? LARGEST_SCALE : scale;
    Image canvas;
    status = createImage(width, a->height + LEGEND_HEIGHT * scale, 8, ENCODING_SRGB, &canvas);
    if (!statusIsOk(&status))
        return status;
    ColorMap map;
    makeColorMap(&map);
    fillRectangle(&canvas, a->width, 0, width - a->width, a->height, PAPER);
    fillRectangle(&canvas, 0, a->height, width, LEGEND_HEIGHT * scale, PAPER);
    status = drawDifferences(&shown, &map, &canvas);
    if (!statusIsOk(&status)) {
        freeImage(&canvas);
        return status;
    }
    drawLegend(&shown, &map, &canvas, a->height, scale);
    *difference = canvas;
    return statusOk();
}
