/* words.h - results as words and numbers that a person reads; shared by the terminal and the page.
 *
 * Numbers are independent of the locale. A difference is told as a fraction of the largest sample,
 * "2/65535" or "3/255", wherever it is one.
 */
#ifndef ECLAIRAGE_COMPARE_WORDS_H
#define ECLAIRAGE_COMPARE_WORDS_H

#include "compare/report.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum SceneOutcome {
    SCENE_AGREES,
    SCENE_DIFFERS,
    SCENE_FAILED, /* could not be compared */
    SCENE_OUTCOME_COUNT
} SceneOutcome;

SceneOutcome findSceneOutcome(const SceneResult *result);

/* How many of its terms differ. */
size_t countDifferingTerms(const SceneResult *result);

/* How many of the results have this outcome. */
size_t countScenes(const SceneResult *results, size_t count, SceneOutcome outcome);

/* "agree", "differ" or "failed". */
const char *sceneOutcomeWord(SceneOutcome outcome);

/* The whole run in one sentence: "2 of 5 scenes differ from POV-Ray, 1 could not be compared." */
void textAppendRunVerdict(Text *text, const SceneResult *results, size_t count);

/* An integer; with separator, which goes between groups of three digits, or NULL. */
void textAppendCount(Text *text, size_t value, const char *separator);

/* The largest sample that stored values as these can come from: 255 where all of them are multiples of
 * 1/255, else 65535 where they are multiples of that, else 0. */
unsigned findMaxSample(const Metrics *metrics);

/* A difference in 0..1 as "n/maxSample"; as a decimal number for maxSample 0. */
void textAppendDifference(Text *text, double difference, unsigned maxSample);

/* "r", "g" or "b". */
const char *channelName(int channel);

#endif
