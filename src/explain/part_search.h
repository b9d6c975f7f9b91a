/* part_search.h - find the mistake that was made for one part of a scene: an object, a material or a lamp.
 *
 * For a picture that none of the mistakes in hypothesis.h turns the right one into. The parts that are tried
 * are those that the differing pixels belong to. Nothing is found that leaves more than a fifth of the
 * difference when the changed scene is traced.
 */
#ifndef ECLAIRAGE_EXPLAIN_PART_SEARCH_H
#define ECLAIRAGE_EXPLAIN_PART_SEARCH_H

#include "explain/difference_owners.h"
#include "explain/part_change.h"

#include <stdbool.h>

typedef struct PartFinding {
    bool isFound;
    PartChange change; /* what leaves least */
    double residual;   /* with it; of the samples as stored, 0..1 */
    bool hasOther;
    PartChange other; /* of another kind, which fits as well */
    DifferenceOwners owners;
} PartFinding;

/* Find what was changed; right: how the scene's own picture would be stored, of the same size. STATUS_IO when
 * memory runs out, STATUS_INTERRUPTED when cancelled; then *finding is untouched. Freed with
 * freePartFinding; the scene must live as long. */
Status findPart(const Truth *truth, const Image *wrong, const Image *right, PartFinding *finding);

/* The same for other settings of the picture alone, which must leave nothing: soon done. */
Status findSettings(const Truth *truth, const Image *wrong, const Image *right, PartFinding *finding);
void freePartFinding(PartFinding *finding);

/* For the parts of the search, in files of their own: where it stands. */
typedef struct PartSearch {
    const Truth *truth;
    const Evidence *evidence;
    const Evidence *manyPixels; /* for what is hard to tell apart */
    Prediction right;           /* what the scene gives */
    double before;              /* how far off that is */
    double rounding;            /* what rounding alone may leave */
    bool isFound, hasOther;
    PartChange best, other;
    double left;   /* with the best one; before where there is none */
    Status status; /* the first failure */
} PartSearch;

/* How far off a change is; INFINITY after a failure, which is noted. */
double measurePart(PartSearch *search, const PartChange *change);

/* Measure a change and keep it if it is the best so far, and leaves less than this share of the difference.
 */
double tryPart(PartSearch *search, const PartChange *change, double share);

/* Whether nothing is left to be explained, so that what costs more need not be tried. */
bool isPartExact(const PartSearch *search);

/* What must be left at most: a fifth; half of that where several numbers were fitted. */
#define PART_SHARE 0.2
#define FITTED_PART_SHARE 0.1

/* What must be left after a third of the way downhill, to go on. */
#define HOPEFUL_SHARE 0.75

/* Try other colours of the lamps, each alone and all together. In part_colors.c. */
void tryLampColors(PartSearch *search);

/* Try another background. In part_colors.c. */
void tryBackground(PartSearch *search);

/* Try other numbers of samples and of rays in a chain. In part_settings.c. */
void trySettings(PartSearch *search);

/* Try each lamp elsewhere. In part_lamp_place.c. */
void tryLampPlaces(PartSearch *search);

/* Try other colours of the object's material, of it alone or of all objects with that material. In
 * part_colors.c. */
void tryMaterialColors(PartSearch *search, const PartChange *target);

/* Try the object larger, smaller, and elsewhere. In part_place.c. */
void tryPlaces(PartSearch *search, const PartChange *target);

#endif
