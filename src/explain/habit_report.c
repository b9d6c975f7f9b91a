/* habit_report.c - see habit_report.h.
 *
 * The page is written from the top; what a scene says goes through textAppendHtml.
 */
#include "explain/habit_report.h"

#include "base/files.h"
#include "compare/difference.h"
#include "explain/explain_page.h"

#include <math.h>

/* Write our picture and POV-Ray's with a slider, and their difference. */
static void writeShots(ExplainPage *page, const HabitReport *report, const Image *povray, const char *caption)
{
    Text alternative = {0};
    textAppendFormat(&alternative, "The scene drawn by POV-Ray, %s", caption);
    Text shown = {0};
    textAppendFormat(&shown, "POV-Ray, %s", caption);
    PagePicture left = {report->ours, "The scene drawn by Éclairage", "Éclairage"};
    PagePicture right = {povray, textString(&alternative), textString(&shown)};
    writePair(page, &left, &right, "How much of our picture is shown, in percent of the width");
    textFree(&shown);
    textFree(&alternative);
}

/* ---- The waterfall ---- */

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

static void writeChart(ExplainPage *page, const HabitStudy *study)
{
    Waterfall chart = {.largest = largestAfter(study), .rows = study->count + 2};
    double before = rmseAfter(study, 0);
    Text svg = {0}, words = {0};
    textAppend(&words, "Bars of the root mean square error, from ");
    textAppendFixed(&words, before, PAGE_DECIMALS);
    textAppend(&words, " with all habits to ");
    textAppendFixed(&words, rmseAfter(study, study->count), PAGE_DECIMALS);
    textAppend(&words, " with none; the table has the same numbers.");
    beginWaterfall(&chart, "How the difference goes down as the habits are taken back", textString(&words),
                   &svg);
    textFree(&words);
    appendWaterfallRow(&chart, 0, "native, with all habits", before, before, &svg);
    for (int i = 0; i < study->count; i++) {
        Text label = {0};
        textAppendFormat(&label, "%s taken back", povHabitName(study->order[i]));
        double after = rmseAfter(study, i + 1);
        appendWaterfallRow(&chart, i + 1, textString(&label), before, after, &svg);
        textFree(&label);
        before = after;
    }
    appendWaterfallRow(&chart, study->count + 1, "matched, with none", before, before, &svg);
    textAppend(&svg, "</svg>\n");
    writeMade(page, &svg);
}

static void writeTable(ExplainPage *page, const HabitStudy *study)
{
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
        fprintf(page->output.stream, "<tr><th scope=\"row\"><a href=\"#%s\">%s</a></th><td>",
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

static void writeSummary(ExplainPage *page, const HabitReport *report)
{
    const HabitStudy *study = report->study;
    writeMarkup(page, "<section class=\"hero\">\n<h1>What POV-Ray’s habits make of ");
    writeBreakableName(page, report->name);
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
    writeMarkup(page, ".</p>\n");
    writeRunAgain(page, report->command);
    writeShots(page, report, &pictureAfterHabits(study, 0)->image, "with all habits");
    writeMarkup(page,
                "<p class=\"files\"><a href=\"./native.pov\">native.pov</a> <a href=\"./matched.pov\">"
                "matched.pov</a> <a href=\"./ours.png\">ours.png</a> <a href=\"./native.png\">native.png"
                "</a> <a href=\"./matched.png\">matched.png</a> <a href=\"./results.json\">results.json"
                "</a></p>\n</section>\n");
}

static void writeHabit(ExplainPage *page, const HabitReport *report, int number)
{
    const HabitStudy *study = report->study;
    const HabitPicture *picture = pictureWithHabit(study, number);
    const char *name = povHabitName(study->order[number]);
    fprintf(
        page->output.stream,
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
    appendHabitText(study, report->scene, number, &words);
    if (!isHabitSeen(study, number))
        textAppend(&words, " In this picture nothing of it is seen.");
    writeMarkedWords(page, textString(&words));
    textFree(&words);
    writeMarkup(page, "</p>\n<p class=\"remedy\">");
    appendHabitRemedy(study, report->scene, number, &words);
    writeMarkedWords(page, textString(&words));
    textFree(&words);
    writeMarkup(page, "</p>\n");
    writeShots(page, report, &picture->image, "with this habit alone");
    fprintf(page->output.stream,
            "<p class=\"files\"><a href=\"./%s.pov\">%s.pov</a> <a href=\"./%s.png\">%s.png</a> "
            "<a href=\"./%s-difference.png\">%s-difference.png</a></p>\n</section>\n",
            name, name, name, name, name, name);
}

static void writePage(ExplainPage *page, const HabitReport *report)
{
    Text title = {0};
    textAppendFormat(&title, "POV-Ray’s habits in %s", report->name);
    beginPageMain(page, textString(&title), "habits", "the habits");
    textFree(&title);
    writeSummary(page, report);
    writeMarkup(
        page, "<section class=\"panel\" id=\"habits\">\n<h2>All of them, taken back one after another</h2>\n"
              "<div class=\"waterfall\">\n<div>\n");
    writeChart(page, report->study);
    writeLegend(page, "taken back", true);
    writeMarkup(page, "</div>\n");
    writeTable(page, report->study);
    writeMarkup(page,
                "</div>\n<p class=\"soft\">A habit can hide another: then the difference grows when it is "
                "taken back, and what habits change together is not the sum of what each changes "
                "alone.</p>\n</section>\n");
    for (int i = 0; i < report->study->count && statusIsOk(&page->status); i++)
        writeHabit(page, report, i);
    endPageMain(page);
}

/* ---- Files ---- */

typedef enum PictureFile {
    FILE_POV,
    FILE_PICTURE,
    FILE_DIFFERENCE,
    PICTURE_FILE_COUNT
} PictureFile;

/* ORDER PictureFile */
static const char *const ENDINGS[] = {".pov", ".png", "-difference.png"};

static const char OURS[] = "ours.png", MATCHED[] = "matched", NATIVE[] = "native";

bool appendHabitFileName(int number, Text *name)
{
    if (number == 0) {
        textAppend(name, OURS);
        return true;
    }
    int picture = (number - 1) / PICTURE_FILE_COUNT, file = (number - 1) % PICTURE_FILE_COUNT;
    if (picture >= 2 + POV_HABIT_COUNT)
        return false;
    textAppend(name, picture == 0   ? MATCHED
                     : picture == 1 ? NATIVE
                                    : povHabitName((PovHabit)(1 << (picture - 2))));
    textAppend(name, ENDINGS[file]);
    return true;
}

static Text pathOfFile(const char *folder, const char *name, PictureFile file)
{
    Text path = pathInFolder(folder, name);
    textAppend(&path, ENDINGS[file]);
    return path;
}

static Status writeImage(const HabitReport *report, Text path, const Image *image)
{
    Status status = path.failed ? statusOutOfMemory() : writePng(path.data, image, report->threads);
    textFree(&path);
    return status;
}

/* Write a picture, its difference and its .pov. */
static Status writeFiles(const char *folder, const HabitReport *report, const HabitPicture *picture,
                         const char *name)
{
    Text path = pathOfFile(folder, name, FILE_POV);
    Status status = path.failed || picture->pov.failed
                        ? statusOutOfMemory()
                        : writeWholeFile(path.data, textString(&picture->pov), picture->pov.length);
    textFree(&path);
    if (statusIsOk(&status))
        status = writeImage(report, pathOfFile(folder, name, FILE_PICTURE), &picture->image);
    Image difference;
    if (statusIsOk(&status))
        status = differencePicture(report->ours, &picture->image, &difference);
    if (statusIsOk(&status)) {
        status = writeImage(report, pathOfFile(folder, name, FILE_DIFFERENCE), &difference);
        freeImage(&difference);
    }
    return status;
}

Status writeHabitReport(const char *folder, const HabitReport *report)
{
    const HabitStudy *study = report->study;
    Status status = writeImage(report, pathInFolder(folder, OURS), report->ours);
    if (statusIsOk(&status))
        status = writeFiles(folder, report, habitPicture(study, 0), MATCHED);
    if (statusIsOk(&status))
        status = writeFiles(folder, report, pictureAfterHabits(study, 0), NATIVE);
    for (int i = 0; i < study->count && statusIsOk(&status); i++)
        status = writeFiles(folder, report, pictureWithHabit(study, i), povHabitName(study->order[i]));
    if (!statusIsOk(&status))
        return status;

    ExplainPage page;
    status = openPage(&page, folder, report->threads);
    if (!statusIsOk(&status))
        return status;
    writePage(&page, report);
    return closePage(&page);
}
