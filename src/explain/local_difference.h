/* local_difference.h - what two pictures alone tell of a difference that is confined to a part of them.
 *
 * Without the scene no light can be computed again. But a shadow that is missing leaves a trace of its own:
 * where the darker picture has an edge the brighter one has none. And a highlight rises and fades without an
 * edge, in one hue.
 */
#ifndef ECLAIRAGE_EXPLAIN_LOCAL_DIFFERENCE_H
#define ECLAIRAGE_EXPLAIN_LOCAL_DIFFERENCE_H

#include "explain/explanation.h"
#include "image/image.h"

typedef struct LocalDifference {
    Cause cause; /* CAUSE_SHADOW, CAUSE_SPECULAR, CAUSE_SHININESS; CAUSE_UNKNOWN where it is none of them */
    bool mineIsBrighter; /* there */
} LocalDifference;

/* Both of one size; whatever their bit depths and encodings. STATUS_IO when memory runs out. */
Status findLocalDifference(const Image *mine, const Image *other, LocalDifference *found);

#endif
