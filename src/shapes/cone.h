/* cone.h - a cylinder, a cone, or a cone cut off: a circle that changes its radius along an axis. */
#ifndef ECLAIRAGE_SHAPES_CONE_H
#define ECLAIRAGE_SHAPES_CONE_H

#include "shapes/intersection.h"

#include <stdbool.h>

typedef struct Cone {
    Material material;
    Vector3D base, top;           /* the two ends of the axis, not the same point */
    double baseRadius, topRadius; /* at least 0, not both 0; equal: a cylinder */
    bool isOpen;                  /* without the two discs at the ends */
} Cone;

Cone createCone(Vector3D base, Vector3D top, double baseRadius, double topRadius, bool isOpen,
                Material material);
Cone createCylinder(Vector3D base, Vector3D top, double radius, bool isOpen, Material material);

#endif
