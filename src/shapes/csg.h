/* csg.h - solids made of solids: their union, intersection or difference. */
#ifndef ECLAIRAGE_SHAPES_CSG_H
#define ECLAIRAGE_SHAPES_CSG_H

#include "shapes/intersection.h"

#include <stddef.h>

typedef enum CsgOperation {
    CSG_UNION,        /* in any part, without the surfaces inside */
    CSG_INTERSECTION, /* in all parts */
    CSG_DIFFERENCE,   /* in the first part and in none of the others */
    CSG_GROUP         /* in any part, with the surfaces inside: a group within another solid */
} CsgOperation;

typedef struct Csg {
    Material material; /* only its ior counts, that of the transparent parts; each part has its own colours */
    CsgOperation operation;
    struct Object *parts; /* each in world space by its own transform; owned, and so is what they own */
    size_t partCount;     /* at least 1 */
} Csg;

#endif
