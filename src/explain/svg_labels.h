/* svg_labels.h - labels that cover neither each other nor the lines of a drawing.
 *
 * Lines and marks are noted while they are drawn and labels are only asked for; all labels find their place
 * at the end, when every line is known.
 */
#ifndef ECLAIRAGE_EXPLAIN_SVG_LABELS_H
#define ECLAIRAGE_EXPLAIN_SVG_LABELS_H

#include "base/text.h"
#include "explain/cut_outline.h"

#include <stdbool.h>

enum {
    MOST_LABEL_BOXES = 1200,
    MOST_LABELS = 96,
    LABEL_SIZE = 80
};

typedef struct LabelBox {
    double x, y, width, height;
} LabelBox;

/* A label that was asked for. */
typedef struct Label {
    DrawnPoint at;
    char words[LABEL_SIZE];
    const char *color;
    bool isCentred, mustBeThere;
} Label;

/* Begins as zeros but for the view. What is more than it can hold is left out. */
typedef struct LabelBoard {
    LabelBox view; /* labels stay inside */
    LabelBox taken[MOST_LABEL_BOXES], lines[MOST_LABEL_BOXES];
    int takenCount, lineCount;
    Label labels[MOST_LABELS];
    int labelCount;
} LabelBoard;

/* Keep labels off a line, and off a mark with this radius. */
void keepOffLine(LabelBoard *board, DrawnPoint a, DrawnPoint b);
void keepOffMark(LabelBoard *board, DrawnPoint at, double radius);

/* Ask for a label near a point; centred: best on the point itself. Where there is no room it is left out
 * rather than put over another, unless it must be there. Words beyond LABEL_SIZE are cut off; color must stay
 * valid. */
void askForLabel(LabelBoard *board, DrawnPoint at, const char *words, const char *color, bool isCentred,
                 bool mustBeThere);

/* Append all labels that were asked for: first those that must stand at their point, then the others in the
 * order in which they were asked for. */
void placeLabels(LabelBoard *board, Text *text);

#endif
