/* report_metrics.c - the rows of the report's table of metrics; see report_metrics.h.
 *
 * Whether a row holds is asked of judgeMetrics with that row's limit alone, so that the table can never
 * say otherwise than the verdict.
 */
#include "compare/report_metrics.h"
#include "compare/words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A group separator that is read in every language: narrow no-break space, U+202F. */
static const char thinSpace[] = "\xE2\x80\xAF";

void textAppendReadable(Text *text, double value, int digits)
{
    static const char *const raised[] = {"\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    Text plain = {0};
    textAppendRounded(&plain, value, digits);
    const char *number = textString(&plain);
    const char *exponent = strchr(number, 'e');
    if (exponent == NULL) {
        textAppend(text, number);
    } else {
        textAppendBytes(text, number, (size_t)(exponent - number));
        textAppend(text, " × 10");
        int power = atoi(exponent + 1);
        textAppend(text, power < 0 ? "\u207B" : "");
        Text decimal = {0};
        textAppendFormat(&decimal, "%d", abs(power));
        for (const char *digit = textString(&decimal); *digit != '\0'; digit++)
            textAppend(text, raised[*digit - '0']);
        textFree(&decimal);
    }
    textFree(&plain);
}

/* A tolerance that limits nothing. */
static Tolerance unlimited(const Tolerance *tolerance)
{
    return (Tolerance){
        .fail = tolerance->fail, .failPercent = NAN, .hardFail = NAN, .rmse = NAN, .ssim = NAN, .flip = NAN};
}

/* Say the limit of a row and ask whether it holds. */
static void judgeRow(MetricRow *row, const Metrics *metrics, const char *relation, double limit,
                     const char *unit, const Tolerance *alone)
{
    if (isnan(limit))
        return;
    textAppend(&row->limit, relation);
    textAppendReadable(&row->limit, limit, 6);
    textAppend(&row->limit, unit);
    row->judged = true;
    row->pass = judgeMetrics(metrics, alone).pass;
}

static void appendValue(Text *text, double value, int digits, const char *unit)
{
    if (!isfinite(value)) {
        textAppend(text, "none");
        return;
    }
    textAppendReadable(text, value, digits);
    textAppend(text, unit);
}

MetricRow makeMetricRow(const SceneResult *result, int number)
{
    const Metrics *metrics = &result->metrics;
    const Tolerance *tolerance = &result->tolerance;
    Tolerance alone = unlimited(tolerance);
    MetricRow row = {.pass = true};
    switch (number) {
    case 0:
        row.name = "Differing pixels";
        row.meaning = "Share of pixels in which a channel differs by more than the scene's fail.";
        textAppendReadable(&row.value, metrics->differingPercent, 4);
        textAppend(&row.value, " % (");
        textAppendCount(&row.value, metrics->differingPixels, thinSpace);
        textAppend(&row.value, ")");
        alone.failPercent = tolerance->failPercent;
        judgeRow(&row, metrics, "at most ", tolerance->failPercent, " %", &alone);
        break;
    case 1:
        row.name = "Largest difference";
        row.meaning = "The worst single channel of all pixels, of 0 to 1; 1/65535 is the smallest step.";
        if (metrics->maxDifference > 0) {
            textAppendReadable(&row.value, metrics->maxDifference, 3);
            textAppend(&row.value, " (");
            textAppendDifference(&row.value, metrics->maxDifference, 65535);
            textAppend(&row.value, ")");
        } else {
            textAppend(&row.value, "0");
        }
        alone.hardFail = tolerance->hardFail;
        judgeRow(&row, metrics, "at most ", tolerance->hardFail, "", &alone);
        break;
    case 2:
        row.name = "Identical pixels";
        row.meaning = "Pixels that are equal in every sample, to the last bit.";
        textAppendReadable(
            &row.value,
            metrics->pixels > 0 ? 100.0 * (double)metrics->identicalPixels / (double)metrics->pixels : 100.0,
            metrics->identicalPixels == metrics->pixels ? 3 : 5);
        textAppend(&row.value, " % (");
        textAppendCount(&row.value, metrics->identicalPixels, thinSpace);
        textAppend(&row.value, ")");
        break;
    case 3:
        row.name = "MAE";
        row.meaning = "Mean absolute error: the average difference of a channel. 0 is equal.";
        appendValue(&row.value, metrics->mae, 3, "");
        break;
    case 4:
        row.name = "RMSE";
        row.meaning = "Root mean square error: an average in which large differences weigh more. 0 is equal.";
        appendValue(&row.value, metrics->rmse, 3, "");
        alone.rmse = tolerance->rmse;
        judgeRow(&row, metrics, "at most ", tolerance->rmse, "", &alone);
        break;
    case 5:
        row.name = "PSNR";
        row.meaning =
            "Peak signal to noise ratio: RMSE in decibels, higher is closer. Equal pictures have none.";
        appendValue(&row.value, metrics->psnr, 4, " dB");
        break;
    case 6:
        row.name = "SSIM";
        row.meaning = "Structural similarity: do brightness and contrast vary alike? 1 is equal.";
        appendValue(&row.value, metrics->ssim, 7, "");
        alone.ssim = tolerance->ssim;
        judgeRow(&row, metrics, "at least ", tolerance->ssim, "", &alone);
        break;
    default:
        row.name = "FLIP";
        row.meaning = "How visible the difference is to a person who flips between the two. 0 is invisible.";
        appendValue(&row.value, metrics->flip, 3, "");
        alone.flip = tolerance->flip;
        judgeRow(&row, metrics, "at most ", tolerance->flip, "", &alone);
        break;
    }
    return row;
}

void freeMetricRow(MetricRow *row)
{
    textFree(&row->value);
    textFree(&row->limit);
}
