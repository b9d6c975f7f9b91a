/* difference_owners.h - the objects that the pixels that differ belong to.
 *
 * An object may be seen in a pixel, be seen there in a mirror or behind glass, or stand between the lamps and
 * what is seen there. All of it is told by the rays of the scene as it is.
 */
#ifndef ECLAIRAGE_EXPLAIN_DIFFERENCE_OWNERS_H
#define ECLAIRAGE_EXPLAIN_DIFFERENCE_OWNERS_H

#include "explain/predict.h"

/* What of the picture belongs to an object, in pixels. */
typedef struct OwnerShare {
    size_t object;            /* its number in the scene, from 0 */
    const Material *material; /* its own, or that of the part of a solid that most pixels show; of those that
                               * differ where there are any */
    double seen;              /* where it is seen first */
    double differing;         /* of those, the ones that differ */
    double mirrored;          /* that differ and show it in a mirror or behind glass */
    double shaded;            /* that differ and are in its shadow, of one lamp or more */
} OwnerShare;

typedef struct DifferenceOwners {
    OwnerShare *items; /* of the objects that have a share, those with most differing pixels first */
    size_t count;
    double differing;    /* of all pixels */
    double onBackground; /* of those, where no object is seen */
} DifferenceOwners;

/* Find them from the evidence's pixels; right: what the scene gives there. STATUS_IO when memory runs out,
 * STATUS_INTERRUPTED when cancelled. Freed with freeDifferenceOwners. */
Status findDifferenceOwners(const Truth *truth, const Evidence *evidence, const Prediction *right,
                            DifferenceOwners *owners);
void freeDifferenceOwners(DifferenceOwners *owners);

#endif
