/* hypothesis.h - the mistakes that are looked for, each a trait that a hypothesis can have.
 *
 * A trait sets one field of a hypothesis, some of them to a number that has to be found. Traits of different
 * causes can be put together.
 */
#ifndef ECLAIRAGE_EXPLAIN_HYPOTHESIS_H
#define ECLAIRAGE_EXPLAIN_HYPOTHESIS_H

#include "explain/explanation.h"
#include "explain/light_change.h"
#include "explain/value_change.h"
#include "explain/view_change.h"
#include "raytracer.h"

#include <stdbool.h>
#include <stddef.h>

/* A guess at what happened to the right picture. */
typedef struct Hypothesis {
    ViewChange view;
    LightChange light;
    ValueChange value;
    bool acne;
} Hypothesis;

Hypothesis neutralHypothesis(void);

/* What a trait changes, which decides how much must be predicted anew. */
typedef enum TraitPart {
    TRAIT_VALUE,
    TRAIT_VIEW,
    TRAIT_LIGHT,
    TRAIT_ACNE
} TraitPart;

typedef struct Trait Trait;
struct Trait {
    Cause cause;
    TraitPart part;
    /* Put the trait into a hypothesis; number is one of its numbers, or without meaning. */
    void (*apply)(const Trait *trait, double number, Hypothesis *hypothesis);
    const double *grid; /* numbers to try, rising; NULL: there is no number */
    int gridCount;
    bool isWhole;       /* only the numbers of the grid */
    bool isLogarithmic; /* between two of the grid, go by the logarithm */
    int choice, other;  /* for apply */
    float group;        /* for apply: the shininess that is meant */
    double shiftX, shiftY;
    /* Say what it is in one or two sentences; the number is the best one. scene may be NULL. */
    void (*tell)(const Trait *trait, double number, const Scene *scene, Text *text);
    const char *formula; /* what to look at where no line of a scene says it */
    const char *key;     /* the scene's key to look at; NULL: none */
};

enum {
    MAX_TRAITS = 128
};

typedef struct Traits {
    Trait items[MAX_TRAITS];
    size_t count;
} Traits;

/* All traits that can be predicted from a picture, with scene NULL, or from the scene. file: how the wrong
 * picture is stored. */
void listTraits(const Scene *scene, StoredFormat file, Traits *traits);

/* Whether both can be in one hypothesis. */
bool traitsCombine(const Trait *a, const Trait *b);

#endif
