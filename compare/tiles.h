/* tiles.h - a sum over a picture, worked out tile by tile on several threads.
 *
 * Invariant: the tiles depend only on the size of the picture, each tile's value only on its place, and
 * the values are added in reading order: the sum has the same bits for every number of threads.
 */
#ifndef ECLAIRAGE_COMPARE_TILES_H
#define ECLAIRAGE_COMPARE_TILES_H

#include "base/status.h"
#include "image/image.h"

#include <stdbool.h>
#include <stddef.h>

/* A part of the picture, wholly inside it. */
typedef struct Tile {
    int x, y, width, height;
} Tile;

/* The value of one tile. scratch is memory of the asked size that no other tile uses meanwhile; what a
 * tile before left in it is still there. */
typedef double (*TileValue)(const void *context, const Tile *tile, void *scratch);

/* How to cut and what to add. */
typedef struct TileSum {
    int width, height;         /* of the whole, each at least 1 */
    int tileWidth, tileHeight; /* the tiles at the right and at the bottom may be smaller */
    size_t scratchSize;        /* bytes, for each thread; aligned to 64 */
    TileValue value;
    const void *context;
} TileSum;

/* Add the values of all tiles. STATUS_IO when memory runs out, STATUS_INTERRUPTED when cancelled; then
 * *sum is untouched. */
Status sumTiles(const TileSum *what, int threads, double *sum);

/* Whether the two pictures, of one size, hold the same samples in the tile and margin pixels around it. */
bool tilesEqual(const Image *a, const Image *b, const Tile *tile, int margin);

#endif
