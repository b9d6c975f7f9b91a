/* engine.h - the fast engine: the same picture as the course's tracer, to the last bit.
 *
 * compileScene turns a Scene into an immutable CompiledScene, which is drawn any number of times. How, and
 * what has a fast path: README.md beside this file.
 */
#ifndef ECLAIRAGE_ENGINE_ENGINE_H
#define ECLAIRAGE_ENGINE_ENGINE_H

#include "base/status.h"
#include "raytracer.h"

#include <stddef.h>

typedef struct CompiledScene CompiledScene;

/* Make the scene ready, on up to this many threads. The scene stays the caller's, and must neither change nor
 * go before the CompiledScene does. On success the caller frees *compiled with freeCompiledScene; on failure
 * it is untouched. STATUS_INTERRUPTED when cancelled; STATUS_USAGE when the environment asks for an
 * instruction set that is not there (ECLAIRAGE_PATH, see README.md). */
Status compileScene(const Scene *scene, int threads, CompiledScene **compiled);
void freeCompiledScene(CompiledScene *compiled);

/* Draw it as renderReference draws the scene, to the same bits, whatever the number of threads and the
 * instruction set; with the same counts. */
Status renderCompiled(const CompiledScene *compiled, Framebuffer *framebuffer, const RenderOptions *options,
                      RayCounts *counts);

/* What finds its surfaces one ray at a time, to the same bits; lives as long as the compiled scene. */
const SurfaceFinder *compiledFinder(const CompiledScene *compiled);

/* The bytes that it takes, without the scene. */
size_t compiledSceneBytes(const CompiledScene *compiled);

/* The instruction set that it will be drawn with: "avx2", "sse2", "neon" or "portable". */
const char *compiledScenePath(const CompiledScene *compiled);

#endif
