/* both_engines.h - for tests of the fast engine: a scene drawn by both engines, and compared to the last bit.
 */
#ifndef ECLAIRAGE_TESTS_BOTH_ENGINES_H
#define ECLAIRAGE_TESTS_BOTH_ENGINES_H

#include "raytracer.h"

enum {
    MOST_ENGINE_PATHS = 4,
    DIFFERENCE_SIZE = 1200
};

/* The instruction sets that the fast engine can be forced to here, the program's own choice first; how many.
 * Changes the environment, as enginesAgree does: neither is for several threads at a time. */
size_t findEnginePaths(const char *paths[MOST_ENGINE_PATHS]);

/* Whether the fast engine, on each of these paths and with each of these numbers of threads (0: no further),
 * draws the picture of the course's tracer in all bits, with the same counts of rays. Where it does not,
 * `difference` says in one line where and how. */
bool enginesAgree(const Scene *scene, int width, int height, const char *const *paths, size_t pathCount,
                  const int threads[2], char difference[DIFFERENCE_SIZE]);

#endif
