/* pov_scale.h - the size at which POV-Ray sees a scene as we do.
 *
 * POV-Ray's tolerances are absolute: it drops hits nearer than 1e-4, shadow hits nearer than 1e-3 and
 * everything beyond 1e7. A scene of millimetres loses its shadows, one of kilometres its horizon. So
 * such a scene is exported at another size: lengths times a factor, lights with 1/d^2 times its square.
 * The factor is a power of two, so no number loses a digit. A scene whose parts span more than some 1e8 has
 * no size that suits all of them: the far ones are kept, and the smallest may differ.
 */
#ifndef ECLAIRAGE_POVRAY_POV_SCALE_H
#define ECLAIRAGE_POVRAY_POV_SCALE_H

#include "raytracer.h"

/* The factor: 1 for a scene without glass or meshes whose parts are at least 0.1 and at most 1e4 away, and
 * the camera not within 0.01 of a surface; above 0. */
double povScale(const Scene *scene);

#endif
