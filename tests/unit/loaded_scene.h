/* loaded_scene.h - for tests of the loader: scenes written in the test. */
#ifndef ECLAIRAGE_TESTS_LOADED_SCENE_H
#define ECLAIRAGE_TESTS_LOADED_SCENE_H

#include "scene/load.h"

#include <stdbool.h>

/* Load what must be right; freed by the caller. */
Scene load(const char *yaml);

/* Whether it loads without an error. */
bool loads(const char *yaml);

/* Fail unless the vector has exactly these coordinates. */
void assertVector(Vector3D v, double x, double y, double z);

#endif
