/* render.c - the picture by the fast engine: squares of tiles, handed out to threads; see engine.h. */
#include "engine/lanes/path.h"

#include "base/cancel.h"
#include "base/threads.h"

#include <stdatomic.h>

enum {
    SQUARE_SIDE = 64 /* pixels of what is handed out at a time */
};

typedef struct Drawing {
    TileJob job;
    const RenderOptions *options;
    size_t squareColumns, squareCount;
    atomic_size_t squaresDone;
    _Atomic uint64_t primary, shadow, secondary;
} Drawing;

/* A tile whose rays are traced one by one: for a shadow bias, which the lanes do not know. */
static void drawSingly(const TileJob *job, int left, int top, RayCounts *counts)
{
    const Framebuffer *framebuffer = job->framebuffer;
    for (int y = top; y < top + TILE_SIDE && y < framebuffer->height; y++)
        for (int x = left; x < left + TILE_SIDE && x < framebuffer->width; x++)
            putLinearPixel(job->framebuffer, x, y,
                           tracePixel(&job->rays, &job->compiled->finder, x, y, counts));
}

static void drawSquare(void *context, size_t number)
{
    Drawing *drawing = context;
    const TileJob *job = &drawing->job;
    int left = (int)(number % drawing->squareColumns) * SQUARE_SIDE;
    int top = (int)(number / drawing->squareColumns) * SQUARE_SIDE;
    RayCounts counts = {0};
    uint32_t lastBlocks[LAST_BLOCKS];
    for (int i = 0; i < LAST_BLOCKS; i++)
        lastBlocks[i] = CHILD_NONE;
    for (int y = top; y < top + SQUARE_SIDE && y < job->framebuffer->height; y += TILE_SIDE)
        for (int x = left; x < left + SQUARE_SIDE && x < job->framebuffer->width && !cancelRequested();
             x += TILE_SIDE) {
            if (job->compiled->lanesShade)
                job->compiled->path->drawTile(job, x, y, lastBlocks, &counts);
            else
                drawSingly(job, x, y, &counts);
        }

    drawing->primary += counts.primary;
    drawing->shadow += counts.shadow;
    drawing->secondary += counts.secondary;
    size_t done = atomic_fetch_add(&drawing->squaresDone, 1) + 1;
    if (drawing->options->progress != NULL)
        drawing->options->progress(drawing->options->progressContext,
                                   (double)done / (double)drawing->squareCount);
}

Status renderCompiled(const CompiledScene *compiled, Framebuffer *framebuffer, const RenderOptions *options,
                      RayCounts *counts)
{
    const Scene *scene = compiled->scene;
    size_t columns = ((size_t)framebuffer->width + SQUARE_SIDE - 1) / SQUARE_SIDE;
    size_t rows = ((size_t)framebuffer->height + SQUARE_SIDE - 1) / SQUARE_SIDE;
    Drawing drawing = {.job = {.compiled = compiled,
                               .framebuffer = framebuffer,
                               .rays = createPixelRays(scene, framebuffer->width, framebuffer->height,
                                                       compiled->transparent, compiled->transparentCount)},
                       .options = options,
                       .squareColumns = columns,
                       .squareCount = columns * rows};
    Status status = runTasks(drawing.squareCount, options->threads, drawSquare, &drawing);
    if (counts != NULL)
        *counts =
            (RayCounts){.primary = drawing.primary, .shadow = drawing.shadow, .secondary = drawing.secondary};
    return status;
}
