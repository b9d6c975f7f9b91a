/* nasty_scene.h - random scenes made of coincidences: what an author rarely draws and an engine trips over.
 */
#ifndef ECLAIRAGE_TESTS_NASTY_SCENE_H
#define ECLAIRAGE_TESTS_NASTY_SCENE_H

#include "raytracer.h"

#include <stdint.h>

/* The scene with this number; freed with freeScene. Objects whose number has its bit set in `without` (as far
 * as it has bits) are left out, which changes nothing else. Ends the program when memory runs out. */
Scene createNastyScene(uint64_t seed, uint64_t without);

#endif
