/* words.c - results as words and numbers; see words.h. */
#include "compare/words.h"

#include <math.h>

SceneOutcome findSceneOutcome(const SceneResult *result)
{
    if (!statusIsOk(&result->status))
        return SCENE_FAILED;
    return result->verdict.pass && countDifferingTerms(result) == 0 ? SCENE_AGREES : SCENE_DIFFERS;
}

size_t countDifferingTerms(const SceneResult *result)
{
    size_t found = 0;
    for (size_t i = 0; i < result->termCount; i++)
        if (!result->terms[i].verdict.pass)
            found++;
    return found;
}

size_t countScenes(const SceneResult *results, size_t count, SceneOutcome outcome)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++)
        if (findSceneOutcome(&results[i]) == outcome)
            found++;
    return found;
}

const char *sceneOutcomeWord(SceneOutcome outcome)
{
    switch (outcome) {
    case SCENE_AGREES:
        return "agree";
    case SCENE_DIFFERS:
        return "differ";
    default:
        return "failed";
    }
}

/* The sentence where all scenes have one outcome: "Both scenes agree with POV-Ray." */
static void appendUniformVerdict(Text *text, size_t count, SceneOutcome outcome)
{
    static const char *const one[] = {"agrees with POV-Ray", "differs from POV-Ray", "could not be compared"};
    static const char *const many[] = {"agree with POV-Ray", "differ from POV-Ray", "could be compared"};
    if (count == 1)
        textAppendFormat(text, "The scene %s.", one[outcome]);
    else if (outcome == SCENE_FAILED)
        textAppendFormat(text, "None of the %zu scenes %s.", count, many[outcome]);
    else if (count == 2)
        textAppendFormat(text, "Both scenes %s.", many[outcome]);
    else
        textAppendFormat(text, "All %zu scenes %s.", count, many[outcome]);
}

void textAppendRunVerdict(Text *text, const SceneResult *results, size_t count)
{
    size_t differing = countScenes(results, count, SCENE_DIFFERS);
    size_t failed = countScenes(results, count, SCENE_FAILED);
    if (count == 0)
        textAppend(text, "No scene was compared.");
    else if (differing == count || failed == count || differing + failed == 0)
        appendUniformVerdict(text, count, findSceneOutcome(&results[0]));
    else if (differing == 0)
        textAppendFormat(text, "%zu of %zu scenes could not be compared, the %s POV-Ray.", failed, count,
                         count - failed == 1 ? "other agrees with" : "others agree with");
    else if (failed == 0)
        textAppendFormat(text, "%zu of %zu scenes %s from POV-Ray.", differing, count,
                         differing == 1 ? "differs" : "differ");
    else
        textAppendFormat(text, "%zu of %zu scenes %s from POV-Ray, %zu could not be compared.", differing,
                         count, differing == 1 ? "differs" : "differ", failed);
}

void textAppendCount(Text *text, size_t value, const char *separator)
{
    if (separator == NULL || value < 1000) {
        textAppendFormat(text, "%zu", value);
        return;
    }
    textAppendCount(text, value / 1000, separator);
    textAppendFormat(text, "%s%03zu", separator, value % 1000);
}

/* Whether value is a multiple of 1/maxSample, but for rounding in double arithmetic. */
static bool isMultiple(double value, unsigned maxSample)
{
    double steps = value * (double)maxSample;
    return fabs(steps - round(steps)) < 1e-6;
}

unsigned findMaxSample(const Metrics *metrics)
{
    static const unsigned candidates[] = {255, 65535};
    for (size_t i = 0; i < sizeof candidates / sizeof *candidates; i++)
        if (isMultiple(metrics->maxDifference, candidates[i]) &&
            isMultiple(metrics->worst.a, candidates[i]) && isMultiple(metrics->worst.b, candidates[i]))
            return candidates[i];
    return 0;
}

void textAppendDifference(Text *text, double difference, unsigned maxSample)
{
    if (maxSample == 0)
        textAppendRounded(text, difference, 4);
    else
        textAppendFormat(text, "%lld/%u", llround(difference * (double)maxSample), maxSample);
}

const char *channelName(int channel)
{
    return channel == 0 ? "r" : channel == 1 ? "g" : "b";
}
