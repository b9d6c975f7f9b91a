/* downhill.h - the least value of a function of a few numbers, of which nothing is known but its values:
 * Nelder and Mead, "A simplex method for function minimization", The Computer Journal 7 (1965). */
#ifndef ECLAIRAGE_EXPLAIN_DOWNHILL_H
#define ECLAIRAGE_EXPLAIN_DOWNHILL_H

enum {
    MOST_NUMBERS = 4
};

typedef struct Downhill {
    double (*measure)(void *context, const double numbers[MOST_NUMBERS]); /* INFINITY where it has no value */
    void *context;
    int dimensions; /* 1 .. MOST_NUMBERS; the numbers behind stay as they are */
    double step;    /* in which the numbers around the first ones are tried */
    double enough;  /* a value that need not become less */
    int turns;      /* at most; each takes the value one to dimensions + 2 times */
    double hope; /* where the value is not below this after hopeTurns, there is no hope; INFINITY: always */
    int hopeTurns;
} Downhill;

/* Go downhill from the numbers, which become the best ones found; returns the value there. It may be the
 * lowest place of a valley among several. */
double goDownhill(const Downhill *downhill, double numbers[MOST_NUMBERS]);

/* The place of the least value between a and b by the golden section (Kiefer, "Sequential minimax search for
 * a maximum", Proceedings of the AMS 4 (1953)): the middle of what is left after so many steps, each of which
 * takes one value. */
double goldenSection(double (*measure)(void *context, double number), void *context, double a, double b,
                     int steps);

#endif
