/* svg_labels.c - labels that cover neither each other nor the lines; see svg_labels.h. */
#include "explain/svg_labels.h"

#include "explain/svg_pieces.h"

#include <math.h>
#include <stdio.h>

void keepOffLine(LabelBoard *board, DrawnPoint a, DrawnPoint b)
{
    double length = hypot(b.x - a.x, b.y - a.y);
    int steps = length < 1000 ? (int)(length / 12) + 1 : 84;
    for (int i = 0; i <= steps && board->lineCount < MOST_LABEL_BOXES; i++)
        board->lines[board->lineCount++] =
            (LabelBox){a.x + (b.x - a.x) * i / steps - 3, a.y + (b.y - a.y) * i / steps - 3, 6, 6};
}

void keepOffMark(LabelBoard *board, DrawnPoint at, double radius)
{
    if (board->takenCount < MOST_LABEL_BOXES)
        board->taken[board->takenCount++] = (LabelBox){at.x - radius, at.y - radius, 2 * radius, 2 * radius};
}

void askForLabel(LabelBoard *board, DrawnPoint at, const char *words, const char *color, bool isCentred,
                 bool mustBeThere)
{
    if (board->labelCount == MOST_LABELS)
        return;
    Label *label = &board->labels[board->labelCount++];
    *label = (Label){.at = at, .color = color, .isCentred = isCentred, .mustBeThere = mustBeThere};
    snprintf(label->words, sizeof label->words, "%s", words);
}

static bool overlaps(const LabelBox *a, const LabelBox *boxes, int count)
{
    for (int i = 0; i < count; i++)
        if (a->x < boxes[i].x + boxes[i].width && boxes[i].x < a->x + a->width &&
            a->y < boxes[i].y + boxes[i].height && boxes[i].y < a->y + a->height)
            return true;
    return false;
}

/* Put a label in the first place where it covers neither label nor line, else no label. */
static void placeLabel(LabelBoard *board, const Label *label, Text *text)
{
    const LabelBox *view = &board->view;
    static const double ways[8][2] = {{0.7, -0.7}, {-0.7, -0.7}, {0.7, 0.7}, {-0.7, 0.7},
                                      {0, -1},     {0, 1},       {1, 0},     {-1, 0}};
    static const double distances[] = {0, 12, 20, 30, 44, 62, 84};
    double width = 7.8 * (double)countCharacters(label->words) + 4, height = 17;
    LabelBox best = {0};
    bool found = false;
    for (int pass = 0; pass < 2 && !found; pass++) {
        for (size_t d = label->isCentred ? 0 : 1; d < sizeof distances / sizeof *distances && !found; d++) {
            if (!label->mustBeThere && distances[d] > 30)
                break; /* farther off nobody would know what it belongs to */
            for (int way = 0; way < 8 && !found; way++) {
                /* What is best on its point goes straight up or down before it goes aside. */
                const double *to = ways[label->isCentred && !label->mustBeThere ? (way + 4) % 8 : way];
                double dx = d > 0 ? to[0] : 0, dy = d > 0 ? to[1] : 0;
                double centerX = label->at.x + dx * distances[d] +
                                 (dx > 0.1    ? width / 2
                                  : dx < -0.1 ? -width / 2
                                              : 0);
                double centerY = label->at.y + dy * distances[d];
                LabelBox box = {centerX - width / 2, centerY - height / 2, width, height};
                if (box.x < view->x + 2 || box.x + width > view->x + view->width - 2 || box.y < view->y + 2 ||
                    box.y + height > view->y + view->height - 2)
                    continue;
                found = !overlaps(&box, board->taken, board->takenCount) &&
                        (pass == 1 || !overlaps(&box, board->lines, board->lineCount));
                best = box;
            }
        }
    }
    if (!found && !(label->mustBeThere && best.width > 0))
        return;
    if (board->takenCount < MOST_LABEL_BOXES)
        board->taken[board->takenCount++] = best;
    textAppend(text, "<text");
    appendAttribute(text, "x", best.x + best.width / 2);
    appendAttribute(text, "y", best.y + 13.5);
    textAppendFormat(text, " fill=\"%s\">", label->color);
    appendEscaped(text, label->words);
    textAppend(text, "</text>\n");
}

void placeLabels(LabelBoard *board, Text *text)
{
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < board->labelCount; i++) {
            const Label *label = &board->labels[i];
            if ((label->isCentred && label->mustBeThere) == (pass == 0))
                placeLabel(board, label, text);
        }
}
