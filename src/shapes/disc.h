/* disc.h - a flat round plate, perhaps with a round hole in its middle. */
#ifndef ECLAIRAGE_SHAPES_DISC_H
#define ECLAIRAGE_SHAPES_DISC_H

#include "shapes/intersection.h"

typedef struct Disc {
    Material material;
    Vector3D center;
    Vector3D normal;            /* of unit length */
    double radius, innerRadius; /* 0 <= innerRadius < radius */
} Disc;

/* normal: any length but 0. */
Disc createDisc(Vector3D center, Vector3D normal, double radius, double innerRadius, Material material);

#endif
