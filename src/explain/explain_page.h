/* explain_page.h - the pieces that the pages of explain are made of: the frame, words, pictures, the
 * waterfall.
 *
 * A page is one index.html that needs no other file and nothing from outside. It is written from the top;
 * words go through textAppendHtml, markup as it is. The first error is kept in status, and closePage gives
 * it.
 */
#ifndef ECLAIRAGE_EXPLAIN_EXPLAIN_PAGE_H
#define ECLAIRAGE_EXPLAIN_EXPLAIN_PAGE_H

#include "base/files.h"
#include "base/status.h"
#include "base/text.h"
#include "image/image.h"

#include <stdbool.h>

enum {
    PAGE_DECIMALS = 5 /* of an error on a page */
};

/* A page being written, between openPage and closePage; not to be copied. */
typedef struct ExplainPage {
    OutputFile output;
    int threads;
    Status status;
} ExplainPage;

/* Begin index.html in an existing folder. On failure nothing is open: STATUS_IO with the file and the reason.
 */
Status openPage(ExplainPage *page, const char *folder, int threads);

/* Finish it, or take it back where something failed: STATUS_IO, STATUS_INTERRUPTED. Either way it is closed.
 */
Status closePage(ExplainPage *page);

/* ---- The frame ---- */

/* Write all down to the beginning of <main>. title: words; skip: the id of the part that the first link leads
 * to, and its name as it stands in "Skip to the habits". */
void beginPageMain(ExplainPage *page, const char *title, const char *skip, const char *skipName);

/* Write the end of <main> and what follows. */
void endPageMain(ExplainPage *page);

/* Write the command that writes the page again. */
void writeRunAgain(ExplainPage *page, const char *command);

/* ---- Words ---- */

void writeMarkup(ExplainPage *page, const char *markup);

/* Write markup that was made, and free it. */
void writeMade(ExplainPage *page, Text *markup);

void writeWords(ExplainPage *page, const char *words);

/* Write words in which code stands in backquotes. */
void writeMarkedWords(ExplainPage *page, const char *words);

/* Write the name of a file, with places to break the line behind its slashes. */
void writeBreakableName(ExplainPage *page, const char *name);

/* "0.01234" */
void writeNumber(ExplainPage *page, double value);

/* "+0.01234", with the minus sign of typesetting; nothing before what rounds to 0. */
void appendChange(Text *text, double change);

/* ---- Pictures ---- */

/* A picture as it stands on a page; both texts are words. */
typedef struct PagePicture {
    const Image *image;
    const char *alternative; /* for who cannot see it */
    const char *caption;
} PagePicture;

/* Write two pictures of one size, depth and encoding with a slider, and their difference. sliderLabel: words,
 * how much of which picture the slider shows. */
void writePair(ExplainPage *page, const PagePicture *left, const PagePicture *right, const char *sliderLabel);

/* ---- The waterfall ---- */

/* A chart of bars, each with what was taken since the one before. */
typedef struct Waterfall {
    double largest; /* value, which fills the width; at least 0 */
    int rows;
} Waterfall;

/* Append the beginning of the SVG; title and description are words. It ends with </svg>. */
void beginWaterfall(const Waterfall *chart, const char *title, const char *description, Text *svg);

/* Append a row, counted from 0: its words above the bar of what is left. */
void appendWaterfallRow(const Waterfall *chart, int row, const char *label, double before, double after,
                        Text *svg);

/* Write what the bars mean; taken: words for what the row before had more. */
void writeLegend(ExplainPage *page, const char *taken, bool hasGrown);

#endif
