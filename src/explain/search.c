/* search.c - see search.h. */
#include "explain/search.h"

#include "base/cancel.h"
#include "explain/sample_rounding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROUGH_PIXELS = 250,   /* that pairs are tried on */
    FINE_PIXELS = 1500,   /* that single traits, and the best pairs, are fitted to */
    FULL_PIXELS = 120000, /* that the residuals are measured on */
    ROUGH_STEP = 8,       /* of the pixels, while the grid of a number is gone through */
    GOLDEN_STEPS = 12,
    ROUGH_GOLDEN_STEPS = 5,
    ROUGH_GRID = 6,    /* numbers of a grid that pairs are tried with, where each needs tracing */
    MOST_NUMBERS = 20, /* that pairs are tried with at all */
    NARROWED = 3,      /* numbers of the first of a pair for which the second's is narrowed down */
    KEPT_PAIRS = 24,   /* of the rough fits, measured again */
    FITTED_PAIRS = 6,  /* of those, fitted finely */
    KEPT_VIEWS = 3,
    KEPT_SINGLES = 12 /* of which one must be in a pair that needs tracing */
};

/* How much better a later hypothesis must be to take the place of an earlier, simpler one. */
static const double MARGIN = 0.97;

/* By how much it must be better besides, as a share of what rounding may leave: a right hypothesis leaves
 * hardly a sample in a thousand off by a step. */
static const double SLACK = 0.05;

/* Two mistakes must leave less than this share of what one leaves. */
static const double PAIR_SHARE = 0.6;

/* Pairs whose error, with the numbers of the grids, is so many times that of the worst one kept are given up:
 * that much is not gained between two numbers of a grid. */
static const double HOPELESS = 3;

/* What is left must be less than this share of what there was, for the cause to be named. */
static const double EXPLAINED_SHARE = 0.2;

/* The same for acne and something else: any lamp may be blocked anywhere, which explains a part of anything.
 */
static const double EXPLAINED_BY_ACNE = 0.05;

/* The same where the first of two causes makes it worse alone. */
static const double OPPOSED_SHARE = 0.03;

typedef struct Search {
    const Truth *truth;
    const Traits *traits;
    const Evidence *evidence;
    Prediction right;      /* the neutral hypothesis */
    PixelMemory *memories; /* of the rays of the neutral view; NULL: none are kept */
    bool isPlain;  /* the wrong picture has one colour, which nearly any values and views could give */
    Status status; /* the first failure */
} Search;

/* One or two traits with their numbers, and how well they fit. */
typedef struct Candidate {
    const Trait *traits[MOST_FINDINGS];
    double numbers[MOST_FINDINGS];
    int count;
    double rmse;
} Candidate;

static Hypothesis hypothesisOf(const Candidate *candidate)
{
    Hypothesis hypothesis = neutralHypothesis();
    for (int i = 0; i < candidate->count; i++)
        candidate->traits[i]->apply(candidate->traits[i], candidate->numbers[i], &hypothesis);
    return hypothesis;
}

/* Predict for a hypothesis, or borrow the neutral prediction where only values change. */
static bool predictFor(Search *search, const Hypothesis *hypothesis, bool onlyValues, Prediction *prediction)
{
    if (onlyValues) {
        *prediction = search->right;
        return true;
    }
    if (!statusIsOk(&search->status))
        return false;
    PixelMemory *memories = isNeutralView(&hypothesis->view) ? search->memories : NULL;
    search->status = predictPixels(search->truth, search->evidence, memories, &hypothesis->view,
                                   &hypothesis->light, hypothesis->acne, prediction);
    return statusIsOk(&search->status);
}

static bool changesOnlyValues(const Candidate *candidate)
{
    for (int i = 0; i < candidate->count; i++)
        if (candidate->traits[i]->part != TRAIT_VALUE)
            return false;
    return true;
}

/* The error that counts. A hypothesis that was let off at the edges must at least not be worse without that,
 * and one that predicts little of the picture explains nothing. */
static double scoreOf(const Misfit *misfit, double plainBefore)
{
    if (misfit->known < 0.3)
        return INFINITY;
    return misfit->plain > misfit->rmse * 1.2 && misfit->plain > 0.93 * plainBefore ? misfit->plain
                                                                                    : misfit->rmse;
}

static double plainBefore(const Search *search)
{
    ValueChange neutral = neutralValueChange();
    return measureMisfit(search->evidence, &search->right, &neutral, 1, INFINITY).plain;
}

/* ---- One number ---- */

/* What the number of a trait is fitted with: all else of the hypothesis, and a prediction if the number does
 * not change it. */
typedef struct NumberFit {
    Search *search;
    Candidate *candidate;
    int which;                    /* of the candidate's traits */
    const Prediction *prediction; /* NULL: to be made for each number */
    double before;
} NumberFit;

/* Whether a picture that is stretched is so by less than a pixel at its border. Then what lies between the
 * pixels explains any other edges, as those of more samples. */
static bool isHardlyStretched(const ViewChange *view, const Evidence *evidence)
{
    if (view->scaleX == 1 && view->scaleY == 1)
        return false;
    return fabs(view->scaleX - 1) * evidence->width < 2 && fabs(view->scaleY - 1) * evidence->height < 2;
}

/* The error with this number; above limit it may be INFINITY. */
static double tryNumber(const NumberFit *fit, double number, size_t step, double limit)
{
    fit->candidate->numbers[fit->which] = number;
    Hypothesis hypothesis = hypothesisOf(fit->candidate);
    Prediction made;
    const Prediction *prediction = fit->prediction;
    if (cancelRequested())
        fit->search->status = statusInterrupted();
    if (!statusIsOk(&fit->search->status) || isHardlyStretched(&hypothesis.view, fit->search->evidence))
        return INFINITY;
    if (prediction == NULL) {
        if (!predictFor(fit->search, &hypothesis, false, &made))
            return INFINITY;
        prediction = &made;
        step = 1;
    }
    Misfit misfit = measureMisfit(fit->search->evidence, prediction, &hypothesis.value, step, limit);
    if (fit->prediction == NULL)
        freePrediction(&made);
    return scoreOf(&misfit, fit->before);
}

static double toScale(const Trait *trait, double number)
{
    return trait->isLogarithmic ? log(number) : number;
}

static double fromScale(const Trait *trait, double scaled)
{
    return trait->isLogarithmic ? exp(scaled) : scaled;
}

/* Go through the grid of the trait's numbers, on every step-th pixel, and return the place of the best.
 * *least: the error up to which it counts; becomes its error, or INFINITY. */
static int goThroughGrid(const NumberFit *fit, size_t step, double *least)
{
    const Trait *trait = fit->candidate->traits[fit->which];
    int best = -1;
    for (int i = 0; i == 0 || i < trait->gridCount; i++) {
        double rmse = tryNumber(fit, trait->grid != NULL ? trait->grid[i] : 0, step, *least);
        if (rmse < *least) {
            *least = rmse;
            best = i;
        }
    }
    if (best < 0)
        *least = INFINITY;
    return best < 0 ? 0 : best;
}

/* Narrow the number down between from and to by the golden section, and leave the best in the candidate. */
static double narrowDown(const NumberFit *fit, double from, double to, int steps)
{
    const Trait *trait = fit->candidate->traits[fit->which];
    const double ratio = 0.6180339887498949;
    double a = toScale(trait, from), b = toScale(trait, to);
    double x = b - ratio * (b - a), y = a + ratio * (b - a);
    double atX = tryNumber(fit, fromScale(trait, x), 1, INFINITY);
    double atY = tryNumber(fit, fromScale(trait, y), 1, atX);
    for (int i = 0; i < steps; i++) {
        /* The smaller of the two, which is kept, is known in full. */
        if (atX <= atY) {
            b = y;
            y = x;
            atY = atX;
            x = b - ratio * (b - a);
            atX = tryNumber(fit, fromScale(trait, x), 1, atY);
        } else {
            a = x;
            x = y;
            atX = atY;
            y = a + ratio * (b - a);
            atY = tryNumber(fit, fromScale(trait, y), 1, atX);
        }
    }
    double number = fromScale(trait, atX <= atY ? x : y), least = atX <= atY ? atX : atY;

    /* A round number close by is likelier, if it fits as well. */
    for (double digits = steps < GOLDEN_STEPS ? 1000 : 1; digits <= 100; digits *= 10) {
        double rounded = round(number * digits) / digits, most = least * 1.02 + 1e-9;
        if (fabs(rounded - number) > 0.02 * fabs(number) + 0.005 || (trait->isLogarithmic && rounded <= 0))
            continue;
        double rmse = tryNumber(fit, rounded, 1, most);
        if (rmse <= most) {
            number = rounded;
            least = rmse;
            break;
        }
    }
    fit->candidate->numbers[fit->which] = number;
    return least;
}

/* Narrow the number down round a place in the grid. */
static double narrowDownAt(const NumberFit *fit, int place, int steps)
{
    const Trait *trait = fit->candidate->traits[fit->which];
    int last = trait->gridCount - 1;
    return narrowDown(fit, trait->grid[place > 0 ? place - 1 : 0],
                      trait->grid[place < last ? place + 1 : last], steps);
}

/* The best number of one trait of the candidate, with all else as it is. */
static double fitNumber(const NumberFit *fit)
{
    const Trait *trait = fit->candidate->traits[fit->which];
    double least = INFINITY;
    bool isCheap = fit->prediction != NULL && trait->grid != NULL && !trait->isWhole;
    int best = goThroughGrid(fit, isCheap ? ROUGH_STEP : 1, &least);
    if (trait->grid != NULL && !trait->isWhole)
        return narrowDownAt(fit, best, GOLDEN_STEPS);
    fit->candidate->numbers[fit->which] = trait->grid != NULL ? trait->grid[best] : 0;
    return least;
}

/* Narrow the number down between its neighbours in the grid. */
static double fitNumberNear(const NumberFit *fit, double number)
{
    const Trait *trait = fit->candidate->traits[fit->which];
    int last = trait->gridCount - 1, below = 0, above = last;
    for (int i = 0; i <= last; i++) {
        if (trait->grid[i] < number * (1 - 1e-9) - 1e-12)
            below = i;
        if (trait->grid[last - i] > number * (1 + 1e-9) + 1e-12)
            above = last - i;
    }
    double old = tryNumber(fit, number, 1, INFINITY),
           rmse = narrowDown(fit, trait->grid[below], trait->grid[above], GOLDEN_STEPS);
    if (rmse <= old)
        return rmse;
    fit->candidate->numbers[fit->which] = number;
    return old;
}

/* ---- One trait ---- */

static double fitSingle(Search *search, Candidate *candidate, double before)
{
    bool isValue = candidate->traits[0]->part == TRAIT_VALUE;
    NumberFit fit = {search, candidate, 0, isValue ? &search->right : NULL, before};
    candidate->rmse = fitNumber(&fit);
    return candidate->rmse;
}

/* ---- Two traits ---- */

/* The numbers of a trait that pairs are tried with: number i, or false when there are no more. A trait
 * without numbers has one, without meaning; of those that need tracing only some of the grid are taken. */
static bool roughNumber(const Trait *trait, int i, double *number)
{
    bool isCheap = trait->part == TRAIT_VALUE;
    int place = i * (isCheap ? 1 : (trait->gridCount + ROUGH_GRID - 1) / ROUGH_GRID);
    if (trait->grid == NULL ? i > 0 : place >= trait->gridCount)
        return false;
    *number = trait->grid != NULL ? trait->grid[place] : 0;
    return true;
}

/* The first of a pair with its numbers, and what is predicted for each. */
typedef struct FirstTrait {
    const Trait *trait;
    double numbers[MOST_NUMBERS];
    Prediction predictions[MOST_NUMBERS]; /* of a trait that only changes values all the same one */
    int count;
} FirstTrait;

static void predictFirst(Search *search, const Trait *trait, FirstTrait *first)
{
    *first = (FirstTrait){.trait = trait};
    double number;
    for (int i = 0; i < MOST_NUMBERS && roughNumber(trait, i, &number); i++) {
        Candidate single = {.traits = {trait}, .numbers = {number}, .count = 1};
        Hypothesis hypothesis = hypothesisOf(&single);
        if (!predictFor(search, &hypothesis, trait->part == TRAIT_VALUE, &first->predictions[i]))
            return;
        first->numbers[i] = number;
        first->count++;
    }
}

static void freeFirst(FirstTrait *first)
{
    for (int i = 0; i < first->count && first->trait->part != TRAIT_VALUE; i++)
        freePrediction(&first->predictions[i]);
}

/* A number of the first of a pair, with the best place in the grid of the second. */
typedef struct RoughPlace {
    int first, second;
    double rmse;
} RoughPlace;

/* Those that fit best so far. */
typedef struct RoughPlaces {
    RoughPlace items[NARROWED];
    int count;
} RoughPlaces;

static void keepPlace(RoughPlaces *places, RoughPlace found)
{
    if (places->count == NARROWED && found.rmse >= places->items[NARROWED - 1].rmse)
        return;
    int at = places->count < NARROWED ? places->count++ : NARROWED - 1;
    for (; at > 0 && places->items[at - 1].rmse > found.rmse; at--)
        places->items[at] = places->items[at - 1];
    places->items[at] = found;
}

/* Fit a pair whose second changes only values: all numbers of both on few pixels, then the best of the first
 * on more of them, with the second's narrowed down. What is above limit on the few is given up; then the
 * result has no traits. */
static Candidate fitValueSecond(Search *search, const FirstTrait *first, const Trait *second, double before,
                                double limit)
{
    Candidate best = {.rmse = INFINITY};
    RoughPlaces places = {.count = 0};
    bool isNarrowed = second->grid != NULL && !second->isWhole;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < (pass == 0 ? first->count : places.count); i++) {
            int k = pass == 0 ? i : places.items[i].first;
            Candidate tried = {.traits = {first->trait, second}, .numbers = {first->numbers[k]}, .count = 2};
            NumberFit fit = {search, &tried, 1, &first->predictions[k], before};
            if (pass == 0) {
                double least = places.count < NARROWED ? limit : places.items[NARROWED - 1].rmse;
                int place = goThroughGrid(&fit, ROUGH_STEP, &least);
                if (!isinf(least))
                    keepPlace(&places, (RoughPlace){k, place, least});
                continue;
            }
            int place = places.items[i].second;
            tried.rmse = isNarrowed
                             ? narrowDownAt(&fit, place, ROUGH_GOLDEN_STEPS)
                             : tryNumber(&fit, second->grid != NULL ? second->grid[place] : 0, 1, best.rmse);
            if (tried.rmse < best.rmse)
                best = tried;
        }
    }
    return best;
}

/* Fit a pair that needs tracing for every two numbers: some of the first's with some of the second's. */
static Candidate fitTracedSecond(Search *search, const Trait *first, const Trait *second, double before)
{
    Candidate best = {.rmse = INFINITY};
    Candidate tried = {.traits = {first, second}, .count = 2};
    NumberFit fit = {search, &tried, 1, NULL, before};
    for (int i = 0; roughNumber(first, i, &tried.numbers[0]); i++) {
        double number;
        for (int k = 0; roughNumber(second, k, &number) && statusIsOk(&search->status); k++) {
            tried.rmse = tryNumber(&fit, number, 1, best.rmse);
            if (tried.rmse < best.rmse)
                best = tried;
        }
    }
    return best;
}

/* The error of a candidate in this search's evidence. */
static double measureCandidate(Search *search, const Candidate *candidate, double before)
{
    Hypothesis hypothesis = hypothesisOf(candidate);
    bool onlyValues = changesOnlyValues(candidate);
    Prediction prediction;
    if (!predictFor(search, &hypothesis, onlyValues, &prediction))
        return INFINITY;
    Misfit misfit = measureMisfit(search->evidence, &prediction, &hypothesis.value, 1, INFINITY);
    if (!onlyValues)
        freePrediction(&prediction);
    return scoreOf(&misfit, before);
}

/* Fit both in turns, starting from rough numbers, until nothing is left to gain. */
static void fitPairFinely(Search *search, Candidate *pair, double before, double floorError)
{
    int turns = pair->traits[0]->grid != NULL && pair->traits[1]->grid != NULL ? 8 : 2;
    for (int turn = 0; turn < turns && statusIsOk(&search->status) && pair->rmse > 0.1 * floorError; turn++) {
        int which = (turn + 1) % 2;
        const Trait *trait = pair->traits[which];
        if (trait->grid == NULL || trait->isWhole)
            continue;
        Hypothesis hypothesis = hypothesisOf(pair);
        bool isValue = trait->part == TRAIT_VALUE, onlyValues = changesOnlyValues(pair);
        Prediction prediction;
        if (isValue && !predictFor(search, &hypothesis, onlyValues, &prediction))
            return;
        NumberFit fit = {search, pair, which, isValue ? &prediction : NULL, before};
        double was = pair->rmse;
        pair->rmse = fitNumberNear(&fit, pair->numbers[which]);
        if (isValue && !onlyValues)
            freePrediction(&prediction);
        if (turn >= 3 && pair->rmse > 0.98 * was)
            break;
    }
}

static void keepPair(Candidate *kept, int *count, const Candidate *pair)
{
    if (*count == KEPT_PAIRS && pair->rmse >= kept[KEPT_PAIRS - 1].rmse)
        return;
    int at = *count < KEPT_PAIRS ? (*count)++ : KEPT_PAIRS - 1;
    while (at > 0 && kept[at - 1].rmse > pair->rmse) {
        kept[at] = kept[at - 1];
        at--;
    }
    kept[at] = *pair;
}

/* The error of the last pair that is kept. */
static double worstKept(const Candidate *kept, int count)
{
    return count == KEPT_PAIRS ? kept[KEPT_PAIRS - 1].rmse : INFINITY;
}

/* ---- The whole search ---- */

/* Whether the trait's prediction is the right picture itself in the evidence: then it can be left out. */
static bool changesNothing(Search *search, const Candidate *single)
{
    Hypothesis hypothesis = hypothesisOf(single);
    Prediction prediction;
    if (single->traits[0]->part != TRAIT_LIGHT || !predictFor(search, &hypothesis, false, &prediction))
        return false;
    bool same = true;
    for (size_t i = 0; i < 3 * prediction.count && same; i++)
        same = fabsf(prediction.low[0][i] - search->right.low[0][i]) < 1e-6f;
    freePrediction(&prediction);
    return same;
}

/* remembers: whether the rays are kept, for evidence of few pixels that is asked often. */
static Status beginSearch(Search *search, const Truth *truth, const Traits *traits, const Evidence *evidence,
                          bool remembers)
{
    ViewChange view = neutralViewChange();
    LightChange light = neutralLightChange();
    *search = (Search){.truth = truth, .traits = traits, .evidence = evidence, .status = statusOk()};
    if (remembers && (search->memories = calloc(evidence->count + 1, sizeof *search->memories)) == NULL)
        return statusOutOfMemory();
    return predictPixels(truth, evidence, search->memories, &view, &light, false, &search->right);
}

static void endSearch(Search *search)
{
    freePrediction(&search->right);
    for (size_t i = 0; search->memories != NULL && i < search->evidence->count; i++)
        freePixelMemory(&search->memories[i]);
    free(search->memories);
}

static bool isOneColor(const Image *image)
{
    size_t count = 3 * (size_t)image->width * (size_t)image->height;
    return memcmp(image->samples, image->samples + 3, (count - 3) * sizeof *image->samples) == 0;
}

/* What rounding alone may leave. */
static double roundingFloor(const Truth *truth, const Evidence *evidence)
{
    bool coarse = evidence->format.bitDepth == 8 || (truth->picture != NULL && truth->picture->bitDepth == 8);
    return roundingError(coarse ? 8 : 16);
}

/* Whether the pair is worth trying: of two views, or a view and something else, only the best views; of two
 * changes that both need tracing only where one of them explains much alone. */
static bool isPairTried(const Search *search, const double *singles, size_t i, size_t j, double viewLimit,
                        double limit)
{
    const Trait *a = &search->traits->items[i], *b = &search->traits->items[j];
    if (!traitsCombine(a, b) || isinf(singles[i]) || isinf(singles[j]))
        return false;
    bool aView = a->part == TRAIT_VIEW && singles[i] > viewLimit;
    bool bView = b->part == TRAIT_VIEW && singles[j] > viewLimit;
    bool isTurned = a->cause == CAUSE_MIRRORED || a->cause == CAUSE_FLIPPED;
    /* Mirrored and flipped, or one of them shifted or stretched; and of these two, where one is likely. */
    if (a->part == TRAIT_VIEW && b->part == TRAIT_VIEW)
        return isTurned || !aView || !bView;
    bool isTraced = a->part >= TRAIT_LIGHT || b->part >= TRAIT_LIGHT;
    return !aView && !bView && (!isTraced || fmin(singles[i], singles[j]) <= limit);
}

/* The residual up to which traits are among the so many best; views only, or all. */
static double limitOfBest(const Traits *traits, const double *singles, bool onlyViews, int most)
{
    double best[KEPT_SINGLES];
    for (int k = 0; k < most; k++)
        best[k] = INFINITY;
    for (size_t i = 0; i < traits->count; i++) {
        if (onlyViews && traits->items[i].part != TRAIT_VIEW)
            continue;
        double score = singles[i];
        for (int k = 0; k < most; k++) {
            if (score < best[k]) {
                double moved = best[k];
                best[k] = score;
                score = moved;
            }
        }
    }
    return best[most - 1];
}

/* Find the best single trait, and the residual of each alone; INFINITY for those that change nothing. */
static Candidate findBestSingle(Search *search, double *singles, double *numbers, double floorError)
{
    Candidate best = {.rmse = INFINITY};
    double before = plainBefore(search);
    for (size_t i = 0; i < search->traits->count && statusIsOk(&search->status); i++) {
        if (best.rmse * MARGIN < SLACK * floorError)
            break; /* no other one can be so much better; then the rest is not asked for either */
        const Trait *trait = &search->traits->items[i];
        Candidate single = {.traits = {trait}, .count = 1};
        single.numbers[0] = trait->grid != NULL ? trait->grid[0] : 0;
        bool isLeftOut = (search->isPlain && trait->part != TRAIT_LIGHT) || changesNothing(search, &single);
        singles[i] = isLeftOut ? INFINITY : fitSingle(search, &single, before);
        numbers[i] = single.numbers[0];
        if (!isinf(singles[i]) && single.rmse < best.rmse * MARGIN - SLACK * floorError * (best.count > 0))
            best = single;
    }
    return best;
}

/* Order the two of a pair: first the one that explains more alone. */
static void orderPair(const Search *search, const double *singles, Candidate *pair)
{
    size_t first = (size_t)(pair->traits[0] - search->traits->items);
    size_t second = (size_t)(pair->traits[1] - search->traits->items);
    if (singles[second] >= singles[first])
        return;
    const Trait *trait = pair->traits[0];
    double number = pair->numbers[0];
    pair->traits[0] = pair->traits[1];
    pair->numbers[0] = pair->numbers[1];
    pair->traits[1] = trait;
    pair->numbers[1] = number;
}

static int findPairs(Search *rough, const double *singles, Candidate kept[KEPT_PAIRS])
{
    int count = 0;
    double before = plainBefore(rough);
    double viewLimit = limitOfBest(rough->traits, singles, true, KEPT_VIEWS);
    double limit = limitOfBest(rough->traits, singles, false, KEPT_SINGLES);
    for (size_t i = 0; i < rough->traits->count && statusIsOk(&rough->status); i++) {
        FirstTrait first = {.count = 0};
        for (size_t j = 0; j < rough->traits->count && statusIsOk(&rough->status); j++) {
            /* The part that needs a new prediction goes first, so that values are fitted to it. */
            const Trait *a = &rough->traits->items[i], *b = &rough->traits->items[j];
            if (a->part < b->part || (a->part == b->part && i >= j))
                continue;
            if (!isPairTried(rough, singles, i, j, viewLimit, limit))
                continue;
            Candidate pair;
            if (b->part == TRAIT_VALUE) {
                if (first.count == 0)
                    predictFirst(rough, a, &first);
                pair = fitValueSecond(rough, &first, b, before, HOPELESS * worstKept(kept, count));
            } else {
                pair = fitTracedSecond(rough, a, b, before);
            }
            if (pair.count > 0)
                keepPair(kept, &count, &pair);
        }
        freeFirst(&first);
    }
    return count;
}

/* Fit single traits and pairs of them, and choose. */
static Candidate chooseCandidate(Search *fine, Search *rough, double *singles, double floorError)
{
    double numbers[MAX_TRAITS];
    Candidate single = findBestSingle(fine, singles, numbers, floorError);
    if (single.rmse <= 1.5 * floorError || !statusIsOk(&fine->status))
        return single;
    Candidate rougher[KEPT_PAIRS], kept[KEPT_PAIRS], best = {.rmse = INFINITY};
    int roughCount = findPairs(rough, singles, rougher), count = 0;
    double before = plainBefore(fine);
    for (int i = 0; i < roughCount && statusIsOk(&fine->status); i++) {
        rougher[i].rmse = measureCandidate(fine, &rougher[i], before);
        keepPair(kept, &count, &rougher[i]);
    }
    for (int i = 0; i < count && i < FITTED_PAIRS && statusIsOk(&fine->status); i++) {
        fitPairFinely(fine, &kept[i], before, floorError);
        if (kept[i].rmse < best.rmse * MARGIN - SLACK * floorError * (best.count > 0))
            best = kept[i];
    }
    if (best.count == 0 || best.rmse > PAIR_SHARE * single.rmse)
        return single;
    orderPair(fine, singles, &best);
    return best;
}

static void storeFindings(Search *full, const Candidate *chosen, double floorError, Findings *findings)
{
    double before = plainBefore(full);
    findings->before = before;
    findings->count = 0;
    if (chosen->count == 0)
        return;
    double left = measureCandidate(full, chosen, before);
    bool isRounding = left <= 2 * floorError && before >= 6 * floorError;
    double share = chosen->count > 1 && hypothesisOf(chosen).acne ? EXPLAINED_BY_ACNE : EXPLAINED_SHARE;
    if (left >= share * before && !isRounding)
        return;
    for (int i = 0; i < chosen->count; i++) {
        Candidate part = *chosen;
        part.count = i + 1;
        findings->items[i] =
            (Finding){.trait = chosen->traits[i],
                      .number = chosen->numbers[i],
                      .residual = i + 1 < chosen->count ? measureCandidate(full, &part, before) : left};
    }
    /* Where the first cause alone makes it worse, two may fit by chance; but two mistakes that act against
     * each other, as acne and a gamma that brightens, or mirrored and flipped, leave next to nothing. */
    if (findings->items[0].residual > before && left > OPPOSED_SHARE * before && !isRounding)
        return;
    findings->count = chosen->count;
}

Status searchCauses(const Truth *truth, const Image *wrong, const Image *right, const bool *isIgnored,
                    const Traits *traits, Findings *findings)
{
    *findings = (Findings){0};
    /* Fewer pixels where each has many rays. */
    size_t share = predictionCost(truth);
    const size_t most[3] = {ROUGH_PIXELS / share + 200, FINE_PIXELS / share + 400,
                            FULL_PIXELS / share + 2000};
    Evidence evidence[3] = {{.count = 0}, {.count = 0}, {.count = 0}};
    Search searches[3] = {{.truth = NULL}, {.truth = NULL}, {.truth = NULL}};
    bool *isDifferent = findDifferentPixels(wrong, right);
    Status status = isDifferent != NULL ? statusOk() : statusOutOfMemory();
    for (int i = 0; i < 3 && statusIsOk(&status); i++) {
        status = gatherEvidence(wrong, isDifferent, isIgnored, most[i], &evidence[i]);
        if (statusIsOk(&status))
            status = beginSearch(&searches[i], truth, traits, &evidence[i], truth->scene != NULL && i < 2);
        searches[i].isPlain = isOneColor(wrong);
    }
    if (statusIsOk(&status)) {
        double singles[MAX_TRAITS], floorError = roundingFloor(truth, &evidence[1]);
        Candidate chosen = chooseCandidate(&searches[1], &searches[0], singles, floorError);
        storeFindings(&searches[2], &chosen, floorError, findings);
        for (int i = 0; i < 3 && statusIsOk(&status); i++)
            status = searches[i].status;
    }
    for (int i = 0; i < 3; i++) {
        endSearch(&searches[i]);
        freeEvidence(&evidence[i]);
    }
    free(isDifferent);
    return status;
}
