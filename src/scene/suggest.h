/* suggest.h - the word that was probably meant.
 *
 * Words are compared without regard to case, hyphens, underscores and spaces; then by the edit distance
 * in which leaving out, adding, changing a letter and exchanging two neighbours cost 1 each (Damerau 1964,
 * in the restricted form known as optimal string alignment).
 */
#ifndef ECLAIRAGE_SCENE_SUGGEST_H
#define ECLAIRAGE_SCENE_SUGGEST_H

#include <stddef.h>

/* The best of many candidates so far. Begin with {.word = ..., .length = ...}. */
typedef struct Suggestion {
    const char *word; /* what was written */
    size_t length;
    const char *best; /* the nearest candidate, or NULL while none is near enough */
    int distance;
} Suggestion;

/* Try one more candidate. One is near enough when no more of the longer word's letters must change than 1
 * of 3, 2 of 6 or 3 of 9; of equally near ones the first stays. */
void tryCandidate(Suggestion *suggestion, const char *candidate);

#endif
