/* torus.h - a ring round the y axis: all points at one distance from a circle. */
#ifndef ECLAIRAGE_SHAPES_TORUS_H
#define ECLAIRAGE_SHAPES_TORUS_H

#include "shapes/intersection.h"

typedef struct Torus {
    Material material;
    double majorRadius; /* of the circle in the plane y = 0 round the origin, above 0 */
    double minorRadius; /* of the ring, above 0 and at most majorRadius */
} Torus;

Torus createTorus(double majorRadius, double minorRadius, Material material);

#endif
