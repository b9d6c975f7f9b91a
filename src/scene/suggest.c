/* suggest.c - the word that was probably meant; see suggest.h. */
#include "scene/suggest.h"

#include <string.h>

enum {
    LONGEST_WORD = 48
};

/* Lower case, without hyphens, underscores and spaces. The number of letters, or LONGEST_WORD + 1 for a
 * word that is too long to be a slip. */
static size_t simplify(const char *word, size_t length, char letters[LONGEST_WORD])
{
    size_t count = 0;
    for (size_t i = 0; i < length; i++) {
        char c = word[i];
        if (c == '-' || c == '_' || c == ' ')
            continue;
        if (count == LONGEST_WORD)
            return LONGEST_WORD + 1;
        letters[count++] = c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
    }
    return count;
}

static int smallest(int a, int b)
{
    return a < b ? a : b;
}

/* The edit distance; rows of the usual table, of which three are kept. */
static int editDistance(const char *a, size_t aLength, const char *b, size_t bLength)
{
    int rows[3][LONGEST_WORD + 1];
    for (size_t j = 0; j <= bLength; j++)
        rows[0][j] = (int)j;
    for (size_t i = 1; i <= aLength; i++) {
        int *row = rows[i % 3], *above = rows[(i + 2) % 3], *above2 = rows[(i + 1) % 3];
        row[0] = (int)i;
        for (size_t j = 1; j <= bLength; j++) {
            int change = above[j - 1] + (a[i - 1] != b[j - 1]);
            row[j] = smallest(change, smallest(above[j], row[j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = smallest(row[j], above2[j - 2] + 1);
        }
    }
    return rows[aLength % 3][bLength];
}

void tryCandidate(Suggestion *suggestion, const char *candidate)
{
    char a[LONGEST_WORD], b[LONGEST_WORD];
    size_t aLength = simplify(suggestion->word, suggestion->length, a);
    size_t bLength = simplify(candidate, strlen(candidate), b);
    if (aLength > LONGEST_WORD || bLength > LONGEST_WORD || aLength == 0 || bLength == 0)
        return;
    size_t longer = aLength > bLength ? aLength : bLength;
    int limit = longer < 3 ? 0 : longer < 6 ? 1 : longer < 9 ? 2 : 3;
    if (suggestion->best != NULL)
        limit = suggestion->distance - 1;
    size_t difference = longer - (aLength < bLength ? aLength : bLength);
    if ((int)difference > limit)
        return;
    int distance = editDistance(a, aLength, b, bLength);
    if (distance <= limit) {
        suggestion->best = candidate;
        suggestion->distance = distance;
    }
}
