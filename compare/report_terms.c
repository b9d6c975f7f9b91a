/* report_terms.c - the fields of the report's table of terms.
 *
 * The page shows small copies of the terms' pictures, since whole ones would be many times the page; the
 * files beside it are linked.
 */
#include "base/files.h"
#include "compare/html.h"
#include "compare/report_page.h"
#include "compare/words.h"
#include "image/image.h"

#include <stdlib.h>
#include <string.h>

enum {
    THUMB_SIDE = 240 /* pixels, of the longer side */
};

static void appendTermName(const Page *page, Text *text)
{
    textAppend(text, page->term->term);
}

static void appendTermMeaning(const Page *page, Text *text)
{
    static const char *const meanings[][2] = {
        {"ambient", "What materials return of the light from everywhere."},
        {"emission", "The materials’ own light."},
        {"diffuse", "What surfaces scatter of the lights."},
        {"specular", "The highlights."},
        {"background", "The background, and the colour of fog."},
    };
    for (size_t i = 0; i < sizeof meanings / sizeof *meanings; i++)
        if (strcmp(meanings[i][0], page->term->term) == 0)
            textAppend(text, meanings[i][1]);
}

static void appendTermReason(const Page *page, Text *text)
{
    const Verdict *verdict = &page->term->verdict;
    for (int i = 0; i < verdict->reasonCount && i < MAX_REASONS; i++)
        textAppendFormat(text, "%s%s", i > 0 ? "; " : "", verdict->reasons[i]);
}

static void appendTermOutcome(const Page *page, Text *text)
{
    textAppend(text, page->term->verdict.pass ? "agree" : "differ");
}

static void appendTermMark(const Page *page, Text *text)
{
    textAppend(text, page->term->verdict.pass ? "✓ agrees" : "✗ disagrees");
}

static void appendTermDiffering(const Page *page, Text *text)
{
    const Metrics *metrics = &page->term->metrics;
    textAppendCount(text, metrics->differingPixels, "\u202F");
    textAppend(text, " of ");
    textAppendCount(text, metrics->pixels, "\u202F");
}

static void appendTermLargest(const Page *page, Text *text)
{
    if (page->term->metrics.maxDifference > 0)
        textAppendDifference(text, page->term->metrics.maxDifference, 65535);
    else
        textAppend(text, "identical");
}

static void appendTermRmse(const Page *page, Text *text)
{
    textAppendReadable(text, page->term->metrics.rmse, 3);
}

static void appendTermOursFile(const Page *page, Text *text)
{
    textAppendFileAddress(text, page->term->oursFile);
}

static void appendTermPovrayFile(const Page *page, Text *text)
{
    textAppendFileAddress(text, page->term->povrayFile);
}

static void appendTermDifferenceFile(const Page *page, Text *text)
{
    textAppendFileAddress(text, page->term->differenceFile);
}

static void appendTermPovFile(const Page *page, Text *text)
{
    textAppendFileAddress(text, page->term->povFile);
}

/* ---- Small pictures ---- */

/* The mean of the picture's pixels from (x, y) to before (endX, endY), linear. */
static Color3f meanPixel(const Image *image, int x, int y, int endX, int endY)
{
    double sum[3] = {0, 0, 0};
    float maximum = (float)imageMaxSample(image);
    for (int j = y; j < endY; j++) {
        const uint16_t *row = image->samples + 3 * ((size_t)j * (size_t)image->width + (size_t)x);
        for (int i = 0; i < 3 * (endX - x); i++) {
            float value = (float)row[i] / maximum;
            sum[i % 3] += (double)(image->encoding == ENCODING_LINEAR ? value : srgbToLinear(value));
        }
    }
    double count = (double)(endX - x) * (endY - y);
    return createColor((float)(sum[0] / count), (float)(sum[1] / count), (float)(sum[2] / count));
}

/* A copy of at most THUMB_SIDE pixels a side, in 8 bits, as a PNG. */
static Status encodeSmall(const Image *image, unsigned char **data, size_t *length)
{
    int longer = image->width > image->height ? image->width : image->height;
    int side = longer < THUMB_SIDE ? longer : THUMB_SIDE;
    int64_t width = (int64_t)image->width * side / longer, height = (int64_t)image->height * side / longer;
    width = width > 0 ? width : 1;
    height = height > 0 ? height : 1;
    Framebuffer *small = createFramebuffer((int)width, (int)height);
    if (small == NULL)
        return statusOutOfMemory();
    for (int64_t y = 0; y < height; y++)
        for (int64_t x = 0; x < width; x++)
            small->pixels[y * width + x] =
                meanPixel(image, (int)(x * image->width / width), (int)(y * image->height / height),
                          (int)((x + 1) * image->width / width), (int)((y + 1) * image->height / height));
    Image stored;
    Status status = imageFromFramebuffer(small, 8, ENCODING_SRGB, 1, &stored);
    freeFramebuffer(small);
    if (!statusIsOk(&status))
        return status;
    status = encodePng(&stored, 1, data, length);
    freeImage(&stored);
    return status;
}

/* Write a small copy of a picture's file in base64. */
static void writeThumb(Page *page, const char *fileName)
{
    Text path = {0};
    textAppendFormat(&path, "%s/%s", page->folder, fileName);
    Image image;
    page->status = path.failed ? statusOutOfMemory() : readPng(textString(&path), &image);
    textFree(&path);
    if (!statusIsOk(&page->status))
        return;
    unsigned char *data = NULL;
    size_t length = 0;
    page->status = encodeSmall(&image, &data, &length);
    freeImage(&image);
    if (statusIsOk(&page->status))
        writeBase64(page->stream, data, length);
    free(data);
}

static void writeOursThumb(Page *page)
{
    writeThumb(page, page->term->oursFile);
}

static void writePovrayThumb(Page *page)
{
    writeThumb(page, page->term->povrayFile);
}

const Field termFields[] = {
    {.name = "term-name", .append = appendTermName},
    {.name = "term-meaning", .append = appendTermMeaning},
    {.name = "term-reason", .append = appendTermReason},
    {.name = "term-outcome", .append = appendTermOutcome},
    {.name = "term-mark", .append = appendTermMark},
    {.name = "term-differing", .append = appendTermDiffering},
    {.name = "term-largest", .append = appendTermLargest},
    {.name = "term-rmse", .append = appendTermRmse},
    {.name = "term-ours-file", .append = appendTermOursFile},
    {.name = "term-povray-file", .append = appendTermPovrayFile},
    {.name = "term-difference-file", .append = appendTermDifferenceFile},
    {.name = "term-pov-file", .append = appendTermPovFile},
    {.name = "term-ours-thumb", .write = writeOursThumb},
    {.name = "term-povray-thumb", .write = writePovrayThumb},
};
const size_t termFieldCount = sizeof termFields / sizeof *termFields;
