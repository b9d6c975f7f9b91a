/* explain_page.c - see explain_page.h. */
#include "explain/explain_page.h"

#include "base/cancel.h"
#include "base/embed.h"
#include "colors.h"
#include "compare/difference.h"
#include "compare/html.h"
#include "compare/report_template.h"
#include "explain/habits.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

EMBED_FILE("explainStyle", "src/explain/explain_page.css");
EMBED_FILE("explainScript", "src/explain/explain_page.js");
extern const char explainStyle[], explainScript[];

enum {
    LARGEST_SHOWN = 1280, /* the longer side of a picture on the page, in pixels */
    SMALL_WIDTH = 200     /* narrower pictures are shown with sharp pixels */
};

/* ---- The file ---- */

Status openPage(ExplainPage *page, const char *folder, int threads)
{
    page->threads = threads;
    page->status = statusOk();
    Text path = pathInFolder(folder, "index.html");
    Status status = path.failed ? statusOutOfMemory() : openOutput(&page->output, path.data);
    textFree(&path);
    return status;
}

Status closePage(ExplainPage *page)
{
    if (statusIsOk(&page->status))
        return closeOutput(&page->output);
    abandonOutput(&page->output);
    return page->status;
}

/* ---- Words ---- */

void writeMarkup(ExplainPage *page, const char *markup)
{
    fputs(markup, page->output.stream);
}

void writeMade(ExplainPage *page, Text *markup)
{
    if (markup->failed && statusIsOk(&page->status))
        page->status = statusOutOfMemory();
    writeMarkup(page, textString(markup));
    textFree(markup);
}

void writeWords(ExplainPage *page, const char *words)
{
    Text markup = {0};
    textAppendHtml(&markup, words);
    writeMade(page, &markup);
}

void writeMarkedWords(ExplainPage *page, const char *words)
{
    bool isCode = false;
    for (const char *part = words;;) {
        size_t length = strcspn(part, "`");
        Text plain = {0};
        textAppendBytes(&plain, part, length);
        writeWords(page, textString(&plain));
        if (plain.failed)
            page->status = statusOutOfMemory();
        textFree(&plain);
        if (part[length] == '\0')
            break;
        isCode = !isCode;
        writeMarkup(page, isCode ? "<code>" : "</code>");
        part += length + 1;
    }
}

void writeBreakableName(ExplainPage *page, const char *name)
{
    for (const char *part = name; *part != '\0';) {
        size_t length = strcspn(part, "/");
        length += part[length] == '/';
        Text plain = {0};
        textAppendBytes(&plain, part, length);
        if (plain.failed)
            page->status = statusOutOfMemory();
        writeWords(page, textString(&plain));
        textFree(&plain);
        part += length;
        if (*part != '\0')
            writeMarkup(page, "<wbr>");
    }
}

void writeNumber(ExplainPage *page, double value)
{
    Text text = {0};
    textAppendFixed(&text, value, PAGE_DECIMALS);
    writeMade(page, &text);
}

void appendChange(Text *text, double change)
{
    double shown = round(change * 1e5);
    textAppend(text, shown > 0 ? "+" : shown < 0 ? "\xE2\x88\x92" : "");
    textAppendFixed(text, fabs(change), PAGE_DECIMALS);
}

/* ---- The frame ---- */

void beginPageMain(ExplainPage *page, const char *title, const char *skip, const char *skipName)
{
    writeMarkup(
        page,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
        "'unsafe-inline'; script-src 'unsafe-inline'; form-action 'none'; base-uri 'none'\">\n"
        "<meta name=\"referrer\" content=\"no-referrer\">\n<meta name=\"color-scheme\" content=\"light "
        "dark\">\n"
        "<meta name=\"generator\" content=\"Éclairage " ECLAIRAGE_VERSION "\">\n<title>");
    writeWords(page, title);
    writeMarkup(page, " – Éclairage</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n");
    writeMarkup(page, reportStyle);
    writeMarkup(page, explainStyle);
    writeMarkup(
        page,
        "</style>\n<script>document.documentElement.classList.add('js');\n"
        "try { const theme = localStorage.getItem('eclairage-theme'); "
        "if (theme) document.documentElement.dataset.theme = theme; } catch { /* no storage */ }</script>\n"
        "</head>\n<body>\n<a class=\"skip\" href=\"#");
    writeWords(page, skip);
    writeMarkup(page, "\">Skip to ");
    writeWords(page, skipName);
    writeMarkup(
        page,
        "</a>\n<header class=\"top\">\n"
        "  <p class=\"brand\"><svg viewBox=\"0 0 32 32\" width=\"30\" height=\"30\" aria-hidden=\"true\">"
        "<circle class=\"brand-lit\" cx=\"16\" cy=\"16\" r=\"14\"/><path class=\"brand-shade\" "
        "d=\"M16 2a14 14 0 0 1 0 28z\"/></svg>\n  <span><b>Éclairage</b> <span class=\"soft\">explains"
        "</span></span></p>\n  <div class=\"top-tools js-only\"><button type=\"button\" id=\"theme-button\">"
        "<span aria-hidden=\"true\">◐</span> Dark</button></div>\n</header>\n<main>\n");
}

void endPageMain(ExplainPage *page)
{
    writeMarkup(page, "</main>\n<footer>Éclairage " ECLAIRAGE_VERSION "</footer>\n<script>\n");
    writeMarkup(page, explainScript);
    writeMarkup(page, "</script>\n</body>\n</html>\n");
}

void writeRunAgain(ExplainPage *page, const char *command)
{
    writeMarkup(page, "<div class=\"command\"><span class=\"command-label\">Run again</span><code>");
    writeWords(page, command);
    writeMarkup(page, "</code></div>\n");
}

/* ---- Pictures ---- */

/* The picture as a screen shows it: in 8 bits by the sRGB curve, each pixel the mean of step x step. */
static Status makeScreenImage(const Image *image, Image *screen)
{
    int longer = image->width > image->height ? image->width : image->height;
    int step = (longer + LARGEST_SHOWN - 1) / LARGEST_SHOWN;
    int width = (image->width + step - 1) / step, height = (image->height + step - 1) / step;
    Status status = createImage(width, height, 8, ENCODING_SRGB, screen);
    if (!statusIsOk(&status))
        return status;
    float largest = (float)imageMaxSample(image);
    Encoding encoding = image->encoding == ENCODING_LINEAR ? ENCODING_SRGB : ENCODING_LINEAR;
    for (int y = 0; y < height; y++) {
        for (int i = 0; i < 3 * width; i++) {
            int x = i / 3 * step, count = 0;
            double sum = 0;
            for (int row = y * step; row < (y + 1) * step && row < image->height; row++)
                for (int column = x; column < x + step && column < image->width; column++, count++)
                    sum += image->samples[3 * ((size_t)row * (size_t)image->width + (size_t)column) +
                                          (size_t)(i % 3)];
            screen->samples[3 * (size_t)y * (size_t)width + (size_t)i] =
                (uint16_t)quantizeSample((float)(sum / count) / largest, 8, encoding);
        }
        if (cancelRequested()) {
            freeImage(screen);
            return statusInterrupted();
        }
    }
    return statusOk();
}

/* Write a figure with the picture in it. */
static void writeFigure(ExplainPage *page, const PagePicture *picture)
{
    Image screen;
    Status status = makeScreenImage(picture->image, &screen);
    unsigned char *data = NULL;
    size_t length = 0;
    if (statusIsOk(&status)) {
        status = encodePng(&screen, page->threads, &data, &length);
        if (statusIsOk(&status)) {
            fprintf(page->output.stream, "<figure%s><img width=\"%d\" height=\"%d\" alt=\"",
                    picture->image->width < SMALL_WIDTH ? " class=\"small\"" : "", screen.width,
                    screen.height);
            writeWords(page, picture->alternative);
            writeMarkup(page, "\" src=\"data:image/png;base64,");
            writeBase64(page->output.stream, data, length);
            writeMarkup(page, "\"><figcaption>");
            writeWords(page, picture->caption);
            writeMarkup(page, "</figcaption></figure>\n");
            free(data);
        }
        freeImage(&screen);
    }
    if (statusIsOk(&page->status))
        page->status = status;
}

void writePair(ExplainPage *page, const PagePicture *left, const PagePicture *right, const char *sliderLabel)
{
    writeMarkup(page, "<div class=\"shots\">\n<div class=\"pair\">\n");
    writeFigure(page, left);
    writeFigure(page, right);
    writeMarkup(page,
                "<input class=\"js-only\" type=\"range\" min=\"0\" max=\"100\" value=\"50\" step=\"0.5\" "
                "aria-label=\"");
    writeWords(page, sliderLabel);
    writeMarkup(page, "\">\n</div>\n");

    Image difference;
    Status status = differencePicture(left->image, right->image, &difference);
    if (statusIsOk(&status)) {
        PagePicture shown = {
            &difference, "Where the two pictures differ, with the scale of the colours below", "difference"};
        writeFigure(page, &shown);
        freeImage(&difference);
    } else if (statusIsOk(&page->status)) {
        page->status = status;
    }
    writeMarkup(page, "</div>\n");
}

/* ---- The waterfall ---- */

enum {
    CHART_WIDTH = 480,
    ROW_HEIGHT = 46,
    BAR_TOP = 24, /* below the row's words */
    BAR_HEIGHT = 14
};

void beginWaterfall(const Waterfall *chart, const char *title, const char *description, Text *svg)
{
    textAppendFormat(svg,
                     "<svg viewBox=\"-1 0 %d %d\" role=\"img\" aria-labelledby=\"chart-title chart-words\">\n"
                     "<title id=\"chart-title\">",
                     CHART_WIDTH + 2, chart->rows * ROW_HEIGHT);
    textAppendHtml(svg, title);
    textAppend(svg, "</title>\n<desc id=\"chart-words\">");
    textAppendHtml(svg, description);
    textAppendFormat(svg, "</desc>\n<path class=\"base\" d=\"M0 %dV%d\"/>\n", BAR_TOP - 4,
                     chart->rows * ROW_HEIGHT);
}

/* Append a bar from one value to another. */
static void appendBox(Text *svg, const char *kind, double from, double to, double largest, int top)
{
    double scale = largest > 0 ? CHART_WIDTH / largest : 0;
    textAppendFormat(svg, "<rect class=\"%s\" x=\"", kind);
    textAppendFixed(svg, from * scale, 2);
    textAppendFormat(svg, "\" y=\"%d\" width=\"", top + BAR_TOP);
    textAppendFixed(svg, fmax(to - from, 0) * scale, 2);
    textAppendFormat(svg, "\" height=\"%d\"/>\n", BAR_HEIGHT);
}

void appendWaterfallRow(const Waterfall *chart, int row, const char *label, double before, double after,
                        Text *svg)
{
    int top = row * ROW_HEIGHT;
    textAppendFormat(svg, "<text x=\"0\" y=\"%d\">", top + 17);
    textAppendHtml(svg, label);
    textAppendFormat(svg, "</text><text class=\"number\" x=\"%d\" y=\"%d\" text-anchor=\"end\">", CHART_WIDTH,
                     top + 17);
    textAppendFixed(svg, after, PAGE_DECIMALS);
    if (after != before) {
        textAppend(svg, " (");
        appendChange(svg, after - before);
        textAppend(svg, ")");
    }
    textAppend(svg, "</text>\n");
    appendBox(svg, "left", 0, fmin(after, before), chart->largest, top);
    if (after < before)
        appendBox(svg, "taken", after, before, chart->largest, top);
    if (after > before)
        appendBox(svg, "added", before, after, chart->largest, top);
}

void writeLegend(ExplainPage *page, const char *taken, bool hasGrown)
{
    writeMarkup(page, "<p class=\"legend\"><span><i class=\"key-left\"></i>left</span><span>"
                      "<i class=\"key-taken\"></i>");
    writeWords(page, taken);
    writeMarkup(page, "</span>");
    if (hasGrown)
        writeMarkup(page, "<span><i class=\"key-added\"></i>grown</span>");
    writeMarkup(page, "</p>\n");
}
