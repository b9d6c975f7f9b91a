/* path.h - the same source compiled for each instruction set, chosen when the program runs.
 *
 * The files of this folder are compiled once for each path, with LANE_PATH set to its name, and PATH(name)
 * makes the functions of each different. A path may not change a single bit of the picture; the tests draw
 * all scenes with each.
 */
#ifndef ECLAIRAGE_ENGINE_PATH_H
#define ECLAIRAGE_ENGINE_PATH_H

#include "base/status.h"
#include "engine/compiled_scene.h"

#ifdef LANE_PATH
#define PATH_JOIN(name, path) name##_##path
#define PATH_OF(name, path) PATH_JOIN(name, path)
#define PATH(name) PATH_OF(name, LANE_PATH)
#endif

/* The drawing of one picture; constant while it is drawn. */
typedef struct TileJob {
    const CompiledScene *compiled;
    Framebuffer *framebuffer;
    PixelRays rays;
} TileJob;

#ifdef LANE_PATH
void PATH(drawTile)(const TileJob *job, int left, int top, uint32_t *lastBlocks, RayCounts *counts);
void PATH(meetRay)(const CompiledScene *compiled, const Ray *ray, Hit *hit, uint32_t *object);
bool PATH(blockRay)(const CompiledScene *compiled, const ShadowRay *shadow);
#endif

enum {
    TILE_SIDE = 8, /* pixels */
    LAST_BLOCKS = 32
};

typedef struct LanePath {
    const char *name;
    /* Draw the tile whose first pixel this is, as much of it as is in the picture. lastBlocks: LAST_BLOCKS
     * numbers that one thread keeps from tile to tile, CHILD_NONE at first; what blocked a light last. */
    void (*drawTile)(const TileJob *job, int left, int top, uint32_t *lastBlocks, RayCounts *counts);
    /* Find a primitive that one ray meets nearer than hit->distance, or as near and before *object in the
     * scene; hit and *object, the number of its object, are then the new one's. */
    void (*meetRay)(const CompiledScene *compiled, const Ray *ray, Hit *hit, uint32_t *object);
    /* Whether a primitive blocks the way. */
    bool (*blockRay)(const CompiledScene *compiled, const ShadowRay *shadow);
} LanePath;

/* The fastest path that the processor has, or the one that ECLAIRAGE_PATH names. */
Status chooseLanePath(const LanePath **path);

#endif
