/* tiles.c - a sum over a picture, worked out tile by tile on several threads; see tiles.h.
 *
 * Memory is taken before the first tile, so that a tile cannot fail: one block of scratch for each
 * thread, claimed by a tile through a flag. At most as many tiles as blocks are at work, so a free
 * block is always found.
 */
#include "compare/tiles.h"

#include "base/threads.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum {
    MAX_BLOCKS = 256, /* runTasks uses no more threads */
    ALIGNMENT = 64
};

typedef struct TileRun {
    const TileSum *what;
    size_t columns;
    double *values; /* one for each tile */
    unsigned char *scratch;
    size_t stride; /* bytes from one block of scratch to the next */
    atomic_bool claimed[MAX_BLOCKS];
} TileRun;

static void runTile(void *context, size_t number)
{
    TileRun *run = context;
    const TileSum *what = run->what;
    size_t block = 0;
    while (atomic_exchange_explicit(&run->claimed[block], true, memory_order_acquire))
        block = (block + 1) % MAX_BLOCKS;
    int x = (int)(number % run->columns) * what->tileWidth;
    int y = (int)(number / run->columns) * what->tileHeight;
    int right = what->width - x, below = what->height - y;
    Tile tile = {x, y, right < what->tileWidth ? right : what->tileWidth,
                 below < what->tileHeight ? below : what->tileHeight};
    run->values[number] = what->value(what->context, &tile, run->scratch + block * run->stride);
    atomic_store_explicit(&run->claimed[block], false, memory_order_release);
}

Status sumTiles(const TileSum *what, int threads, double *sum)
{
    size_t columns = ((size_t)what->width + (size_t)what->tileWidth - 1) / (size_t)what->tileWidth;
    size_t rows = ((size_t)what->height + (size_t)what->tileHeight - 1) / (size_t)what->tileHeight;
    size_t blocks = threads < 1 ? 1 : threads > MAX_BLOCKS ? MAX_BLOCKS : (size_t)threads;
    if (blocks > columns * rows)
        blocks = columns * rows;
    TileRun run = {.what = what, .columns = columns};
    run.stride = (what->scratchSize + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    run.values = calloc(columns * rows, sizeof *run.values);
    run.scratch = aligned_alloc(ALIGNMENT, blocks * run.stride);
    /* The flags beyond the last block stay claimed. */
    for (size_t i = 0; i < MAX_BLOCKS; i++)
        atomic_init(&run.claimed[i], i >= blocks);

    Status status = statusOutOfMemory();
    if (run.values != NULL && run.scratch != NULL)
        status = runTasks(columns * rows, (int)blocks, runTile, &run);
    if (statusIsOk(&status)) {
        *sum = 0;
        for (size_t i = 0; i < columns * rows; i++)
            *sum += run.values[i];
    }
    free(run.values);
    free(run.scratch);
    return status;
}

bool tilesEqual(const Image *a, const Image *b, const Tile *tile, int margin)
{
    int left = tile->x > margin ? tile->x - margin : 0;
    int top = tile->y > margin ? tile->y - margin : 0;
    int right = tile->x + tile->width < a->width - margin ? tile->x + tile->width + margin : a->width;
    int bottom = tile->y + tile->height < a->height - margin ? tile->y + tile->height + margin : a->height;
    size_t bytes = 3 * (size_t)(right - left) * sizeof *a->samples;
    for (int y = top; y < bottom; y++) {
        size_t start = 3 * ((size_t)y * (size_t)a->width + (size_t)left);
        if (memcmp(a->samples + start, b->samples + start, bytes) != 0)
            return false;
    }
    return true;
}
