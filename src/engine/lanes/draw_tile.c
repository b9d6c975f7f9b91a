/* draw_tile.c - the picture's pixels in one tile of 8 x 8; see path.h. */
#include "base/cancel.h"
#include "engine/lanes/tile_lanes.h"

void PATH(drawTile)(const TileJob *job, int left, int top, uint32_t *lastBlocks, RayCounts *counts)
{
    Framebuffer *framebuffer = job->framebuffer;
    int n = job->compiled->scene->render.samples;
    TileLanes tile;
    tile.job = job;
    tile.lastBlocks = lastBlocks;
    tile.counts = counts;
    tile.inPicture = ~0ull;
    if (left + TILE_SIDE > framebuffer->width || top + TILE_SIDE > framebuffer->height)
        EACH_LANE(k)
            if (left + laneX(k) >= framebuffer->width || top + laneY(k) >= framebuffer->height)
                tile.inPicture &= ~(1ull << k);

    /* The mean of n x n rays, evenly spread; of one, through the middle. As tracePixel of the course's
     * tracer. */
    VectorLanes sums;
    if (n > 1)
        EACH_LANE(k)
            setLaneVector(&sums, k, createVector(0, 0, 0));
    for (int j = 0; j < n && !cancelRequested(); j++)
        for (int i = 0; i < n; i++) {
            PATH(aimRays)(&tile, left, top, (i + 0.5) / n, (j + 0.5) / n);
            PATH(meetSurfaces)(&tile);
            PATH(shadeSurfaces)(&tile);
            counts->primary += (uint64_t)__builtin_popcountll(tile.inPicture);
            if (n > 1)
                EACH_LANE(k) {
                    sums.x[k] += (double)tile.colors.r[k];
                    sums.y[k] += (double)tile.colors.g[k];
                    sums.z[k] += (double)tile.colors.b[k];
                }
        }
    if (n > 1) {
        double count = (double)n * n;
        EACH_LANE(k)
            setLaneColor(&tile.colors, k,
                         createColor((float)(sums.x[k] / count), (float)(sums.y[k] / count),
                                     (float)(sums.z[k] / count)));
    }
    Color3f *pixels = framebuffer->pixels + (size_t)top * (size_t)framebuffer->width + left;
    if (tile.inPicture == ~0ull) {
        EACH_LANE(k)
            pixels[(size_t)laneY(k) * (size_t)framebuffer->width + (size_t)laneX(k)] =
                laneColor(&tile.colors, k);
    } else {
        EACH_SET(k, tile.inPicture)
            pixels[(size_t)laneY(k) * (size_t)framebuffer->width + (size_t)laneX(k)] =
                laneColor(&tile.colors, k);
    }
}
