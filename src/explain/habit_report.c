/* habit_report.c - see habit_report.h.
 *
 * The page is written from the top; what a scene says goes through textAppendHtml. The style and the script
 * are put into the read-only data as in compare/report_template.c.
 */
#include "explain/habit_report.h"

#include "base/cancel.h"
#include "base/files.h"
#include "colors.h"
#include "compare/difference.h"
#include "compare/html.h"
#include "compare/report_template.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define EMBED_FILE(symbol, path)                                                                             \
    __asm__(".pushsection .rodata\n"                                                                         \
            ".global " symbol "\n" symbol ":\n"                                                              \
            ".incbin \"" path "\"\n"                                                                         \
            ".byte 0\n"                                                                                      \
            ".popsection\n")

EMBED_FILE("habitStyle", "src/explain/habit_report.css");
EMBED_FILE("habitScript", "src/explain/habit_report.js");
extern const char habitStyle[], habitScript[];

enum {
    DECIMALS = 5,
    LARGEST_SHOWN = 1280, /* the longer side of a picture on the page, in pixels */
    SMALL_WIDTH = 200     /* narrower pictures are shown with sharp pixels */
};

/* A page being written. */
typedef struct HabitPage {
    const HabitReport *report;
    FILE *stream;
    Status status;
} HabitPage;

/* ---- Pieces ---- */

static void writeMarkup(HabitPage *page, const char *markup)
{
    fputs(markup, page->stream);
}

/* Write what was made, and free it. */
static void writeMade(HabitPage *page, Text *markup)
{
    if (markup->failed && statusIsOk(&page->status))
        page->status = statusOutOfMemory();
    writeMarkup(page, textString(markup));
    textFree(markup);
}

static void writeWords(HabitPage *page, const char *words)
{
    Text markup = {0};
    textAppendHtml(&markup, words);
    writeMade(page, &markup);
}

/* Write words in which code stands in backquotes. */
static void writeMarkedWords(HabitPage *page, const char *words)
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

/* Write the name of a file, with places to break the line behind its slashes. */
static void writeBreakableName(HabitPage *page, const char *name)
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

static void writeNumber(HabitPage *page, double value)
{
    Text text = {0};
    appendFixed(&text, value, DECIMALS);
    writeMade(page, &text);
}

/* "+0.01234", with the minus sign of typesetting. */
static void appendChange(Text *text, double change)
{
    double shown = round(change * 1e5);
    textAppend(text, shown > 0 ? "+" : shown < 0 ? "\xE2\x88\x92" : "");
    appendFixed(text, fabs(change), DECIMALS);
}

/* ---- Pictures on the page ---- */

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
static void writeFigure(HabitPage *page, const Image *image, const char *alternative, const char *caption)
{
    Image screen;
    Status status = makeScreenImage(image, &screen);
    unsigned char *data = NULL;
    size_t length = 0;
    if (statusIsOk(&status)) {
        status = encodePng(&screen, page->report->threads, &data, &length);
        if (statusIsOk(&status)) {
            fprintf(page->stream, "<figure%s><img width=\"%d\" height=\"%d\" alt=\"",
                    image->width < SMALL_WIDTH ? " class=\"small\"" : "", screen.width, screen.height);
            writeWords(page, alternative);
            writeMarkup(page, "\" src=\"data:image/png;base64,");
            writeBase64(page->stream, data, length);
            writeMarkup(page, "\"><figcaption>");
            writeWords(page, caption);
            writeMarkup(page, "</figcaption></figure>\n");
            free(data);
        }
        freeImage(&screen);
    }
    if (statusIsOk(&page->status))
        page->status = status;
}

/* Write our picture and POV-Ray's with a slider, and their difference. */
static void writeShots(HabitPage *page, const Image *povray, const char *caption)
{
    writeMarkup(page, "<div class=\"shots\">\n<div class=\"pair\">\n");
    writeFigure(page, page->report->ours, "The scene drawn by Éclairage", "Éclairage");
    Text alternative = {0};
    textAppendFormat(&alternative, "The scene drawn by POV-Ray, %s", caption);
    Text shown = {0};
    textAppendFormat(&shown, "POV-Ray, %s", caption);
    writeFigure(page, povray, textString(&alternative), textString(&shown));
    writeMarkup(page,
                "<input class=\"js-only\" type=\"range\" min=\"0\" max=\"100\" value=\"50\" step=\"0.5\" "
                "aria-label=\"How much of our picture is shown, in percent of the width\">\n</div>\n");
    textFree(&shown);
    textFree(&alternative);

    Image difference;
    Status status = differencePicture(page->report->ours, povray, &difference);
    if (statusIsOk(&status)) {
        writeFigure(page, &difference, "Where the two pictures differ, with the scale of the colours below",
                    "difference");
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

static double rmseAfter(const HabitStudy *study, int taken)
{
    return pictureAfterHabits(study, taken)->metrics.rmse;
}

static double largestAfter(const HabitStudy *study)
{
    double largest = 0;
    for (int i = 0; i <= study->count; i++)
        largest = fmax(largest, rmseAfter(study, i));
    return largest;
}

/* Append a bar from one value to another. */
static void appendBox(Text *svg, const char *kind, double from, double to, double largest, int top)
{
    double scale = largest > 0 ? CHART_WIDTH / largest : 0;
    textAppendFormat(svg, "<rect class=\"%s\" x=\"", kind);
    appendFixed(svg, from * scale, 2);
    textAppendFormat(svg, "\" y=\"%d\" width=\"", top + BAR_TOP);
    appendFixed(svg, fmax(to - from, 0) * scale, 2);
    textAppendFormat(svg, "\" height=\"%d\"/>\n", BAR_HEIGHT);
}

/* One row: its words above the bar of what is left, and what was taken since the row before. */
static void appendRow(Text *svg, int row, const char *label, double before, double after, double largest)
{
    int top = row * ROW_HEIGHT;
    textAppendFormat(svg,
                     "<text x=\"0\" y=\"%d\">%s</text><text class=\"number\" x=\"%d\" y=\"%d\" "
                     "text-anchor=\"end\">",
                     top + 17, label, CHART_WIDTH, top + 17);
    appendFixed(svg, after, DECIMALS);
    if (after != before) {
        textAppend(svg, " (");
        appendChange(svg, after - before);
        textAppend(svg, ")");
    }
    textAppend(svg, "</text>\n");
    appendBox(svg, "left", 0, fmin(after, before), largest, top);
    if (after < before)
        appendBox(svg, "taken", after, before, largest, top);
    if (after > before)
        appendBox(svg, "added", before, after, largest, top);
}

static void writeChart(HabitPage *page)
{
    const HabitStudy *study = page->report->study;
    double largest = largestAfter(study), before = rmseAfter(study, 0);
    Text svg = {0};
    textAppendFormat(&svg,
                     "<svg viewBox=\"-1 0 %d %d\" role=\"img\" aria-labelledby=\"chart-title chart-words\">\n"
                     "<title id=\"chart-title\">How the difference goes down as the habits are taken back"
                     "</title>\n<desc id=\"chart-words\">Bars of the root mean square error, from ",
                     CHART_WIDTH + 2, (study->count + 2) * ROW_HEIGHT);
    appendFixed(&svg, before, DECIMALS);
    textAppend(&svg, " with all habits to ");
    appendFixed(&svg, rmseAfter(study, study->count), DECIMALS);
    textAppend(&svg, " with none; the table has the same numbers.</desc>\n");
    textAppendFormat(&svg, "<path class=\"base\" d=\"M0 %dV%d\"/>\n", BAR_TOP - 4,
                     (study->count + 2) * ROW_HEIGHT);
    appendRow(&svg, 0, "native, with all habits", before, before, largest);
    for (int i = 0; i < study->count; i++) {
        Text label = {0};
        textAppendFormat(&label, "%s taken back", povHabitName(study->order[i]));
        double after = rmseAfter(study, i + 1);
        appendRow(&svg, i + 1, textString(&label), before, after, largest);
        textFree(&label);
        before = after;
    }
    appendRow(&svg, study->count + 1, "matched, with none", before, before, largest);
    textAppend(&svg, "</svg>\n");
    writeMade(page, &svg);
}

static void writeTable(HabitPage *page)
{
    const HabitStudy *study = page->report->study;
    writeMarkup(page,
                "<div class=\"table-frame\"><table class=\"steps\">\n<caption>Root mean square error, "
                "habit by habit</caption>\n<thead><tr><th scope=\"col\">Habit</th><th scope=\"col\">alone"
                "</th><th scope=\"col\">FLIP alone</th><th scope=\"col\">left when taken back</th>"
                "<th scope=\"col\">change</th></tr></thead>\n<tbody>\n<tr><th scope=\"row\">native</th>"
                "<td></td><td>");
    const Metrics *native = &pictureAfterHabits(study, 0)->metrics;
    writeNumber(page, native->flip);
    writeMarkup(page, "</td><td>");
    writeNumber(page, native->rmse);
    writeMarkup(page, "</td><td></td></tr>\n");
    for (int i = 0; i < study->count; i++) {
        const Metrics *alone = &pictureWithHabit(study, i)->metrics;
        double after = rmseAfter(study, i + 1);
        fprintf(page->stream, "<tr><th scope=\"row\"><a href=\"#%s\">%s</a></th><td>",
                povHabitName(study->order[i]), povHabitName(study->order[i]));
        writeNumber(page, alone->rmse);
        writeMarkup(page, "</td><td>");
        writeNumber(page, alone->flip);
        writeMarkup(page, "</td><td>");
        writeNumber(page, after);
        writeMarkup(page, "</td><td>");
        Text change = {0};
        appendChange(&change, after - rmseAfter(study, i));
        writeMade(page, &change);
        writeMarkup(page, "</td></tr>\n");
    }
    writeMarkup(page, "</tbody>\n</table></div>\n");
}

/* ---- The page ---- */

static void writeHead(HabitPage *page)
{
    writeMarkup(
        page,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
        "'unsafe-inline'; script-src 'unsafe-inline'; form-action 'none'; base-uri 'none'\">\n"
        "<meta name=\"referrer\" content=\"no-referrer\">\n<meta name=\"color-scheme\" content=\"light "
        "dark\">\n"
        "<meta name=\"generator\" content=\"Éclairage " ECLAIRAGE_VERSION "\">\n<title>POV-Ray’s habits in ");
    writeWords(page, page->report->name);
    writeMarkup(page, " – Éclairage</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n");
    writeMarkup(page, reportStyle);
    writeMarkup(page, habitStyle);
    writeMarkup(
        page,
        "</style>\n<script>document.documentElement.classList.add('js');\n"
        "try { const theme = localStorage.getItem('eclairage-theme'); "
        "if (theme) document.documentElement.dataset.theme = theme; } catch { /* no storage */ }</script>\n"
        "</head>\n<body>\n<a class=\"skip\" href=\"#habits\">Skip to the habits</a>\n<header class=\"top\">\n"
        "  <p class=\"brand\"><svg viewBox=\"0 0 32 32\" width=\"30\" height=\"30\" aria-hidden=\"true\">"
        "<circle class=\"brand-lit\" cx=\"16\" cy=\"16\" r=\"14\"/><path class=\"brand-shade\" "
        "d=\"M16 2a14 14 0 0 1 0 28z\"/></svg>\n  <span><b>Éclairage</b> <span class=\"soft\">explains"
        "</span></span></p>\n  <div class=\"top-tools js-only\"><button type=\"button\" id=\"theme-button\">"
        "<span aria-hidden=\"true\">◐</span> Dark</button></div>\n</header>\n<main>\n");
}

static void writeSummary(HabitPage *page)
{
    const HabitStudy *study = page->report->study;
    writeMarkup(page, "<section class=\"hero\">\n<h1>What POV-Ray’s habits make of ");
    writeBreakableName(page, page->report->name);
    writeMarkup(page, "</h1>\n<p>The scene was written as POV-Ray is usually written, and drawn. Against our "
                      "picture the root mean square error is <b>");
    writeNumber(page, rmseAfter(study, 0));
    writeMarkup(page,
                "</b>, of linear samples from 0 to 1. Below, each habit is measured alone, and then all "
                "are taken back one after another, the largest first.</p>\n<p class=\"sum\">");
    Text sum = {0};
    appendHabitSum(study, &sum);
    if (sum.length > 0)
        sum.data[0] = 'E';
    writeMade(page, &sum);
    writeMarkup(page, ".</p>\n<div class=\"command\"><span class=\"command-label\">Run again</span><code>");
    writeWords(page, page->report->command);
    writeMarkup(page, "</code></div>\n");
    writeShots(page, &pictureAfterHabits(study, 0)->image, "with all habits");
    writeMarkup(page,
                "<p class=\"files\"><a href=\"./native.pov\">native.pov</a> <a href=\"./matched.pov\">"
                "matched.pov</a> <a href=\"./ours.png\">ours.png</a> <a href=\"./native.png\">native.png"
                "</a> <a href=\"./matched.png\">matched.png</a> <a href=\"./results.json\">results.json"
                "</a></p>\n</section>\n");
}

static void writeHabit(HabitPage *page, int number)
{
    const HabitStudy *study = page->report->study;
    const HabitPicture *picture = pictureWithHabit(study, number);
    const char *name = povHabitName(study->order[number]);
    fprintf(
        page->stream,
        "<section class=\"panel habit\" id=\"%s\">\n<div class=\"habit-head\"><h2><span class=\"ordinal\">"
        "%d.</span>%s</h2>\n<p class=\"numbers\"><span>RMSE <b>",
        name, number + 1, name);
    writeNumber(page, picture->metrics.rmse);
    writeMarkup(page, "</b></span> <span>FLIP <b>");
    writeNumber(page, picture->metrics.flip);
    writeMarkup(page, "</b></span> <span>largest <b>");
    writeNumber(page, picture->metrics.maxDifference);
    writeMarkup(page, "</b></span></p></div>\n<p>");
    Text words = {0};
    appendHabitText(study, page->report->scene, number, &words);
    if (!isHabitSeen(study, number))
        textAppend(&words, " In this picture nothing of it is seen.");
    writeMarkedWords(page, textString(&words));
    textFree(&words);
    writeMarkup(page, "</p>\n<p class=\"remedy\">");
    appendHabitRemedy(study, page->report->scene, number, &words);
    writeMarkedWords(page, textString(&words));
    textFree(&words);
    writeMarkup(page, "</p>\n");
    writeShots(page, &picture->image, "with this habit alone");
    fprintf(page->stream,
            "<p class=\"files\"><a href=\"./%s.pov\">%s.pov</a> <a href=\"./%s.png\">%s.png</a> "
            "<a href=\"./%s-difference.png\">%s-difference.png</a></p>\n</section>\n",
            name, name, name, name, name, name);
}

static void writePage(HabitPage *page)
{
    writeHead(page);
    writeSummary(page);
    writeMarkup(
        page, "<section class=\"panel\" id=\"habits\">\n<h2>All of them, taken back one after another</h2>\n"
              "<div class=\"waterfall\">\n<div>\n");
    writeChart(page);
    writeMarkup(page, "<p class=\"legend\"><span><i class=\"key-left\"></i>left</span><span>"
                      "<i class=\"key-taken\"></i>taken back</span><span><i class=\"key-added\"></i>"
                      "grown</span></p>\n</div>\n");
    writeTable(page);
    writeMarkup(page,
                "</div>\n<p class=\"soft\">A habit can hide another: then the difference grows when it is "
                "taken back, and what habits change together is not the sum of what each changes "
                "alone.</p>\n</section>\n");
    for (int i = 0; i < page->report->study->count && statusIsOk(&page->status); i++)
        writeHabit(page, i);
    writeMarkup(page, "</main>\n<footer>Éclairage " ECLAIRAGE_VERSION "</footer>\n<script>\n");
    writeMarkup(page, habitScript);
    writeMarkup(page, "</script>\n</body>\n</html>\n");
}

/* ---- Files ---- */

/* The path of a file in the folder, freed by the caller. */
static Text pathIn(const char *folder, const char *name, const char *ending)
{
    Text path = {0};
    textAppendFormat(&path, "%s%s%s%s", folder, folder[strlen(folder) - 1] == '/' ? "" : "/", name, ending);
    return path;
}

static Status writeImage(const char *folder, const HabitReport *report, const char *name, const char *ending,
                         const Image *image)
{
    Text path = pathIn(folder, name, ending);
    Status status = path.failed ? statusOutOfMemory() : writePng(path.data, image, report->threads);
    textFree(&path);
    return status;
}

/* Write a picture, its difference and its .pov. */
static Status writeFiles(const char *folder, const HabitReport *report, const HabitPicture *picture,
                         const char *name)
{
    Text path = pathIn(folder, name, ".pov");
    Status status = path.failed || picture->pov.failed
                        ? statusOutOfMemory()
                        : writeWholeFile(path.data, textString(&picture->pov), picture->pov.length);
    textFree(&path);
    if (statusIsOk(&status))
        status = writeImage(folder, report, name, ".png", &picture->image);
    Image difference;
    if (statusIsOk(&status))
        status = differencePicture(report->ours, &picture->image, &difference);
    if (statusIsOk(&status)) {
        status = writeImage(folder, report, name, "-difference.png", &difference);
        freeImage(&difference);
    }
    return status;
}

Status writeHabitReport(const char *folder, const HabitReport *report)
{
    const HabitStudy *study = report->study;
    Status status = writeImage(folder, report, "ours", ".png", report->ours);
    if (statusIsOk(&status))
        status = writeFiles(folder, report, habitPicture(study, 0), "matched");
    if (statusIsOk(&status))
        status = writeFiles(folder, report, pictureAfterHabits(study, 0), "native");
    for (int i = 0; i < study->count && statusIsOk(&status); i++)
        status = writeFiles(folder, report, pictureWithHabit(study, i), povHabitName(study->order[i]));
    if (!statusIsOk(&status))
        return status;

    Text path = pathIn(folder, "index.html", "");
    OutputFile output;
    status = path.failed ? statusOutOfMemory() : openOutput(&output, path.data);
    textFree(&path);
    if (!statusIsOk(&status))
        return status;
    HabitPage page = {.report = report, .stream = output.stream, .status = statusOk()};
    writePage(&page);
    if (!statusIsOk(&page.status)) {
        abandonOutput(&output);
        return page.status;
    }
    return closeOutput(&output);
}
