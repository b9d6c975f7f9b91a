/* verdict.c - hold measured numbers against limits, and say in words what broke them; see metrics.h.
 *
 * Invariant: pass exactly when there is no reason. A limit that is NAN is not judged; a value that cannot
 * be measured breaks a limit that is set, since nothing shows that it is kept.
 * Numbers are in words with a point in every locale, and so that value and limit never look equal where
 * the one breaks the other.
 */
#include "compare/metrics.h"

#include "base/text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

enum {
    FEWEST_DIGITS = 3,
    MOST_DIGITS = 15
};

/* Two different numbers as two different texts, short where that is enough. */
static void formatPair(char valueText[NUMBER_TEXT_SIZE], double value, char limitText[NUMBER_TEXT_SIZE],
                       double limit)
{
    formatDouble(limitText, limit);
    for (int digits = FEWEST_DIGITS; digits <= MOST_DIGITS; digits++) {
        formatRounded(valueText, value, digits);
        /* Take it when its reader sees the value on the right side of the limit. */
        double read = parseDouble(valueText, NULL);
        if ((read > limit) == (value > limit) && (read < limit) == (value < limit))
            return;
    }
    formatDouble(valueText, value);
}

static void addReason(Verdict *verdict, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void addReason(Verdict *verdict, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (verdict->reasonCount < MAX_REASONS)
        vsnprintf(verdict->reasons[verdict->reasonCount++], REASON_SIZE, format, arguments);
    va_end(arguments);
}

/* "SUBJECT VALUE, more than the allowed LIMIT" when the value lies above the limit. */
static void judgeUpperLimit(Verdict *verdict, const char *subject, double value, double limit)
{
    char valueText[NUMBER_TEXT_SIZE], limitText[NUMBER_TEXT_SIZE];
    if (isnan(limit) || value <= limit)
        return;
    formatPair(valueText, value, limitText, limit);
    addReason(verdict, "%s is %s (allowed: at most %s)", subject, valueText, limitText);
}

Verdict judgeMetrics(const Metrics *metrics, const Tolerance *tolerance)
{
    Verdict verdict = {.pass = true};
    char value[NUMBER_TEXT_SIZE], limit[NUMBER_TEXT_SIZE], fail[NUMBER_TEXT_SIZE];

    /* Judge the share of differing pixels. */
    if (!isnan(tolerance->failPercent) && !(metrics->differingPercent <= tolerance->failPercent)) {
        formatPair(value, metrics->differingPercent, limit, tolerance->failPercent);
        formatDouble(fail, tolerance->fail);
        addReason(&verdict, "%s %% of the pixels differ by more than %s (allowed: %s %%)", value, fail,
                  limit);
    }
    /* Judge the worst pixel, naming its place. */
    if (!isnan(tolerance->hardFail) && !(metrics->maxDifference <= tolerance->hardFail)) {
        static const char *const channels[] = {"red", "green", "blue"};
        formatPair(value, metrics->maxDifference, limit, tolerance->hardFail);
        addReason(&verdict, "pixel (%d, %d) differs by %s in %s (allowed: at most %s)", metrics->worst.x,
                  metrics->worst.y, value, channels[metrics->worst.channel], limit);
    }
    judgeUpperLimit(&verdict, "the root mean square error (RMSE)", metrics->rmse, tolerance->rmse);
    /* Judge similarity, where more is better. */
    if (!isnan(tolerance->ssim) && isnan(metrics->ssim)) {
        formatDouble(limit, tolerance->ssim);
        addReason(&verdict,
                  "the similarity (SSIM) cannot be measured on %dx%d pixels, it needs 11x11 "
                  "(asked for: at least %s)",
                  metrics->width, metrics->height, limit);
    } else if (metrics->ssim < tolerance->ssim) {
        formatPair(value, metrics->ssim, limit, tolerance->ssim);
        addReason(&verdict, "the similarity (SSIM) is %s (asked for: at least %s)", value, limit);
    }
    judgeUpperLimit(&verdict, "the visible difference (FLIP)", metrics->flip, tolerance->flip);
    verdict.pass = verdict.reasonCount == 0;
    return verdict;
}
