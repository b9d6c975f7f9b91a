/* picture_report.c - see picture_report.h.
 *
 * The two pictures may be stored in different ways; the page shows the right one as mine is stored, so that
 * what differs is seen and measured in the same steps as in the explanation.
 */
#include "explain/picture_report.h"

#include "base/cancel.h"
#include "explain/explain_page.h"
#include "explain/habits.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* ORDER Cause */
static const char *const CAUSE_WORDS[CAUSE_COUNT] = {
    "another gamma curve",
    "another exposure",
    "left and right swapped",
    "top and bottom swapped",
    "red, green and blue in another order",
    "a shift",
    "another aspect or angle of view",
    "shadows that are missing or too many",
    "another falloff of the light",
    "Blinn’s highlight for Phong’s, or the other way round",
    "another shininess",
    "a highlight that is missing or has another colour",
    "light from behind the surface",
    "normals that are turned or not interpolated",
    "light added everywhere",
    "shadow acne",
    "too few levels",
    "an object, a material or a lamp that is another one",
    "none that is known here",
};

/* ---- The right picture as mine is stored ---- */

static bool isStoredAlike(const Image *a, const Image *b)
{
    return a->bitDepth == b->bitDepth && a->encoding == b->encoding;
}

/* A copy in the depth and encoding of like. */
static Status storeLike(const Image *like, const Image *image, Image *stored)
{
    Image made;
    Status status = createImage(image->width, image->height, like->bitDepth, like->encoding, &made);
    if (!statusIsOk(&status))
        return status;
    float largest = (float)imageMaxSample(image);
    /* Only what is stored by another curve goes through both. */
    bool isAlike = image->encoding == like->encoding;
    bool isCurved = !isAlike && image->encoding == ENCODING_SRGB;
    Encoding encoding = isAlike ? ENCODING_LINEAR : like->encoding;
    size_t row = 3 * (size_t)image->width;
    for (int y = 0; y < image->height; y++) {
        for (size_t i = row * (size_t)y; i < row * (size_t)(y + 1); i++) {
            float v = (float)image->samples[i] / largest;
            made.samples[i] =
                (uint16_t)quantizeSample(isCurved ? srgbToLinear(v) : v, like->bitDepth, encoding);
        }
        if (cancelRequested()) {
            freeImage(&made);
            return statusInterrupted();
        }
    }
    *stored = made;
    return statusOk();
}

static const char *encodingWords(const Image *image)
{
    return image->encoding == ENCODING_SRGB ? "sRGB" : "linear";
}

/* ---- Mine and what it should be ---- */

static void writePictures(ExplainPage *page, const PictureReport *report)
{
    bool isAlike = isStoredAlike(report->mine, report->right);
    Image stored = {0};
    if (!isAlike) {
        Status status = storeLike(report->mine, report->right, &stored);
        if (!statusIsOk(&status)) {
            page->status = statusIsOk(&page->status) ? status : page->status;
            return;
        }
    }
    Text mine = {0}, right = {0};
    textAppendFormat(&mine, "The picture %s", report->name);
    textAppendFormat(&right, report->isDrawn ? "The scene %s as Éclairage draws it" : "The picture %s",
                     report->rightName);
    PagePicture left = {report->mine, textString(&mine), "mine"};
    PagePicture other = {isAlike ? report->right : &stored, textString(&right), "what it should be"};
    writePair(page, &left, &other, "How much of my picture is shown, in percent of the width");
    textFree(&mine);
    textFree(&right);
    freeImage(&stored);
    if (isAlike)
        return;
    writeMarkup(page, "<p class=\"soft\">");
    writeBreakableName(page, report->rightName);
    fprintf(page->output.stream,
            " has %d bits a sample, %s; here it is shown, and held against mine, as mine is "
            "stored: in %d bits, %s.</p>\n",
            report->right->bitDepth, encodingWords(report->right), report->mine->bitDepth,
            encodingWords(report->mine));
}

/* ---- The waterfall ---- */

static const Explanations *causesOf(const PictureReport *report)
{
    return &report->explanation->causes;
}

/* The error that is left when the first so many causes are taken into account. */
static double errorAfter(const Explanations *causes, size_t taken)
{
    return taken == 0 ? causes->before : causes->items[taken - 1].residual;
}

/* Whether there is a cause that takes something of the difference away. */
static bool hasKnownCause(const Explanations *causes)
{
    return causes->count > 0 && causes->items[0].cause != CAUSE_UNKNOWN;
}

static void writeChart(ExplainPage *page, const Explanations *causes)
{
    Waterfall chart = {.largest = causes->before, .rows = (int)causes->count + 1};
    for (size_t i = 0; i < causes->count; i++)
        chart.largest = fmax(chart.largest, causes->items[i].residual);
    Text svg = {0}, words = {0};
    textAppend(&words, "Bars of the root mean square error, from ");
    textAppendFixed(&words, causes->before, PAGE_DECIMALS);
    textAppend(&words, " before to ");
    textAppendFixed(&words, errorAfter(causes, causes->count), PAGE_DECIMALS);
    textAppend(&words, " in the end; the table has the same numbers.");
    beginWaterfall(&chart, "How the difference goes down as its causes are taken into account",
                   textString(&words), &svg);
    textFree(&words);
    appendWaterfallRow(&chart, 0, "before", causes->before, causes->before, &svg);
    for (size_t i = 0; i < causes->count; i++) {
        Text label = {0};
        textAppendFormat(&label, "after %zu. %s", i + 1, causeName(causes->items[i].cause));
        appendWaterfallRow(&chart, (int)i + 1, textString(&label), errorAfter(causes, i),
                           errorAfter(causes, i + 1), &svg);
        textFree(&label);
    }
    textAppend(&svg, "</svg>\n");
    writeMade(page, &svg);
}

static void writeTable(ExplainPage *page, const Explanations *causes)
{
    writeMarkup(page,
                "<div class=\"table-frame\"><table class=\"steps\">\n<caption>Root mean square error, "
                "cause by cause</caption>\n<thead><tr><th scope=\"col\">Cause</th><th scope=\"col\">left "
                "after it</th><th scope=\"col\">change</th></tr></thead>\n<tbody>\n"
                "<tr><th scope=\"row\">before</th><td>");
    writeNumber(page, causes->before);
    writeMarkup(page, "</td><td></td></tr>\n");
    for (size_t i = 0; i < causes->count; i++) {
        fprintf(page->output.stream, "<tr><th scope=\"row\"><a href=\"#cause-%zu\">%zu. %s</a></th><td>",
                i + 1, i + 1, causeName(causes->items[i].cause));
        writeNumber(page, errorAfter(causes, i + 1));
        writeMarkup(page, "</td><td>");
        Text change = {0};
        appendChange(&change, errorAfter(causes, i + 1) - errorAfter(causes, i));
        writeMade(page, &change);
        writeMarkup(page, "</td></tr>\n");
    }
    writeMarkup(page, "</tbody>\n</table></div>\n");
}

static void writeWaterfall(ExplainPage *page, const Explanations *causes)
{
    bool hasGrown = false;
    for (size_t i = 0; i < causes->count; i++)
        hasGrown = hasGrown || errorAfter(causes, i + 1) > errorAfter(causes, i);
    writeMarkup(page, "<section class=\"panel\">\n<h2>What is left, cause by cause</h2>\n"
                      "<div class=\"waterfall\">\n<div>\n");
    writeChart(page, causes);
    writeLegend(page, "explained", hasGrown);
    writeMarkup(page, "</div>\n");
    writeTable(page, causes);
    writeMarkup(page, "</div>\n</section>\n");
}

/* ---- The page ---- */

/* In one sentence, what it is. */
static void writeHeadline(ExplainPage *page, const PictureReport *report)
{
    const Explanations *causes = causesOf(report);
    if (causes->count == 0) {
        writeWords(page, textString(&report->explanation->summary));
        return;
    }
    if (!hasKnownCause(causes)) {
        writeMarkup(page, "None of the mistakes that are known here explains the difference.");
        return;
    }
    writeMarkup(page,
                causes->count == 1 ? "The difference has one cause: " : "The difference has these causes: ");
    for (size_t i = 0; i < causes->count; i++) {
        writeMarkup(page, i == 0 ? "" : i + 1 < causes->count ? "; " : "; and ");
        writeWords(page, CAUSE_WORDS[causes->items[i].cause]);
    }
    writeMarkup(page, ".");
}

static void writeSummary(ExplainPage *page, const PictureReport *report)
{
    writeMarkup(page, "<section class=\"hero\" id=\"found\">\n<h1>What is wrong with ");
    writeBreakableName(page, report->name);
    writeMarkup(page, "</h1>\n<p class=\"sum\">");
    writeHeadline(page, report);
    writeMarkup(page, "</p>\n<p>Against ");
    writeBreakableName(page, report->rightName);
    if (report->isDrawn)
        writeMarkup(page, ", drawn at the size of the picture,");
    writeMarkup(page, " the root mean square error is <b>");
    writeNumber(page, causesOf(report)->before);
    writeMarkup(page, "</b>, of the samples as they are stored, from 0 to 1.</p>\n");
    writeRunAgain(page, report->command);
    writePictures(page, report);
    writeMarkup(page, "<p class=\"files\"><a href=\"./results.json\">results.json</a></p>\n</section>\n");
}

/* A paragraph that begins with a capital, by the style, and ends with a full stop. */
static void writeSentence(ExplainPage *page, const char *opening, const Text *words)
{
    writeMarkup(page, opening);
    writeWords(page, textString(words));
    if (words->length > 0 && strchr(".!?", words->data[words->length - 1]) == NULL)
        writeMarkup(page, ".");
    writeMarkup(page, "</p>\n");
}

static void writeCause(ExplainPage *page, const Explanations *causes, size_t number)
{
    const Explanation *cause = &causes->items[number];
    fprintf(page->output.stream,
            "<section class=\"panel habit\" id=\"cause-%zu\">\n<div class=\"habit-head\"><h2><span "
            "class=\"ordinal\">%zu.</span>%s</h2>\n<p class=\"numbers\"><span>%s <b>",
            number + 1, number + 1, causeName(cause->cause),
            cause->cause == CAUSE_UNKNOWN ? "not explained" : "left after this");
    writeNumber(page, cause->residual);
    writeMarkup(page, "</b></span></p></div>\n");
    writeSentence(page, "<p class=\"told\">", &cause->text);
    writeMarkup(page, "<p class=\"remedy\">Look at: ");
    writeWords(page, textString(&cause->where));
    writeMarkup(page, "</p>\n</section>\n");
}

static void writePage(ExplainPage *page, const PictureReport *report)
{
    const Explanations *causes = causesOf(report);
    Text title = {0};
    textAppendFormat(&title, "What is wrong with %s", report->name);
    beginPageMain(page, textString(&title), "found", "what was found");
    textFree(&title);
    writeSummary(page, report);
    if (hasKnownCause(causes))
        writeWaterfall(page, causes);
    for (size_t i = 0; i < causes->count; i++)
        writeCause(page, causes, i);
    endPageMain(page);
}

Status writePictureReport(const char *folder, const PictureReport *report)
{
    ExplainPage page;
    Status status = openPage(&page, folder, report->threads);
    if (!statusIsOk(&status))
        return status;
    writePage(&page, report);
    return closePage(&page);
}
