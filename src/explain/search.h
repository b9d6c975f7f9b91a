/* search.h - find the one or two mistakes that turn the right picture into the wrong one.
 *
 * Every trait alone, then in pairs, is fitted to a sample of the pixels; the few best are fitted to a larger
 * one. Two are named only where they leave much less than the best one alone.
 */
#ifndef ECLAIRAGE_EXPLAIN_SEARCH_H
#define ECLAIRAGE_EXPLAIN_SEARCH_H

#include "explain/hypothesis.h"
#include "explain/predict.h"

/* A trait with its best number. */
typedef struct Finding {
    const Trait *trait;
    double number;
    double residual; /* with this and the findings before it; of the samples as stored, 0..1 */
} Finding;

enum {
    MOST_FINDINGS = 2
};

typedef struct Findings {
    Finding items[MOST_FINDINGS];
    int count;     /* 0: nothing fits */
    double before; /* the error of the right picture itself */
} Findings;

/* Fit the traits to the wrong picture; right is how the right one would be stored, of the same size.
 * isIgnored: the pixels that are not looked at, or NULL. STATUS_IO when memory runs out, STATUS_INTERRUPTED
 * when cancelled. */
Status searchCauses(const Truth *truth, const Image *wrong, const Image *right, const bool *isIgnored,
                    const Traits *traits, Findings *findings);

#endif
