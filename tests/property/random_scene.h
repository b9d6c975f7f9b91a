/* random_scene.h - a random scene over the whole vocabulary of the scene format. */
#ifndef ECLAIRAGE_TESTS_RANDOM_SCENE_H
#define ECLAIRAGE_TESTS_RANDOM_SCENE_H

#include "scene_tree.h"

#include <stdint.h>

/* The scene with this number, the same everywhere: valid, and of the kind that crosscheck.c promises to be
 * the same in POV-Ray. The caller frees it with freeTree. */
Node *createRandomScene(uint64_t seed);

#endif
