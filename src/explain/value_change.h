/* value_change.h - what can be wrong with the values of a picture whose shapes are right.
 *
 * A linear colour goes through the change and comes out as samples as they are stored, in 0..1. The neutral
 * change stores it as it should be. Each field is one mistake; together they act in the order in which
 * programs make them: offset and scale of the light, the encoding, the order of the channels, the levels.
 */
#ifndef ECLAIRAGE_EXPLAIN_VALUE_CHANGE_H
#define ECLAIRAGE_EXPLAIN_VALUE_CHANGE_H

#include "colors.h"

#include <stdbool.h>

/* How the picture's own file stores a sample. */
typedef struct StoredFormat {
    int bitDepth; /* 8 or 16 */
    Encoding encoding;
} StoredFormat;

typedef enum EncodingMistake {
    ENCODED_RIGHT,
    ENCODED_TWICE, /* by the sRGB curve once more than the file says */
    NOT_ENCODED    /* once less */
} EncodingMistake;

/* What an offset is multiplied by. */
typedef enum OffsetPlace {
    OFFSET_EVERYWHERE,
    OFFSET_ON_SURFACES, /* not where the background is seen */
    OFFSET_ON_DIFFUSE   /* times the diffuse colour */
} OffsetPlace;

typedef struct ValueChange {
    float scale;  /* of linear light; 1 */
    float offset; /* added to linear light; 0 */
    OffsetPlace offsetPlace;
    float linearPower; /* exponent of linear light; 1 */
    EncodingMistake encoding;
    float curvePower;      /* light to this power is stored in place of the sRGB curve; 0: the curve */
    float storedPower;     /* exponent of the stored sample; 1 */
    float storedScale;     /* of the stored sample; 1 */
    float storedOffset;    /* added to the stored sample; 0 */
    bool storedOnSurfaces; /* but not where the background is seen */
    int channels[3];       /* channel i of the picture is channel channels[i] */
    int levels;            /* of a stored sample; 0: those of the file */
    bool levelsLinear;     /* the levels are of linear light */
    bool truncated;        /* to the level below and not to the nearest */
    int droppedBits;       /* the lowest bits of a stored sample that are 0 */
} ValueChange;

/* The change that changes nothing. */
ValueChange neutralValueChange(void);

/* What is known of the place that a colour comes from. */
typedef struct ValuePlace {
    bool isSurface;
    Color3f diffuse; /* its diffuse colour; black if not known */
} ValuePlace;

/* The stored samples, 0..1, of a linear colour, rounded to the format's steps. A component may be infinite.
 */
void storedSamples(const ValueChange *change, StoredFormat format, const ValuePlace *place,
                   const float linear[3], float stored[3]);

#endif
