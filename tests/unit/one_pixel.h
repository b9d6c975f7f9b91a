/* one_pixel.h - for tests of the tracer: the colour along one ray. */
#ifndef ECLAIRAGE_TESTS_ONE_PIXEL_H
#define ECLAIRAGE_TESTS_ONE_PIXEL_H

#include "raytracer.h"

/* The colour along one ray, seen through a picture of one pixel that looks along it. */
Color3f colorAlong(Scene *scene, Vector3D from, Vector3D to);

/* Fail unless each channel is within 2e-6 of what is expected, relative above 1. */
void assertColorNear(Color3f color, double r, double g, double b);

#endif
