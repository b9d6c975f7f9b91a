/* render.c - the picture by the fast engine: squares of tiles, handed out to threads; see engine.h. */
#include "engine/lanes/path.h"
#include "engine/single_rays.h"

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
    const CompiledScene *compiled = job->compiled;
    const Framebuffer *framebuffer = job->framebuffer;
    int n = compiled->scene->render.samples;
    for (int y = top; y < top + TILE_SIDE && y < framebuffer->height; y++)
        for (int x = left; x < left + TILE_SIDE && x < framebuffer->width; x++) {
            double sum[3] = {0, 0, 0};
            Color3f color = createColor(0, 0, 0);
            for (int sample = 0; sample < n * n; sample++) {
                Ray ray = cameraRay(&job->frame, x + (sample % n + 0.5) / n, y + (sample / n + 0.5) / n,
                                    framebuffer->width, framebuffer->height);
                Media media = cameraMedia(job, &ray);
                counts->primary++;
                color = traceRay(&compiled->finder, &ray, &media, 1, counts);
                sum[0] += (double)color.r;
                sum[1] += (double)color.g;
                sum[2] += (double)color.b;
            }
            double count = (double)n * n;
            if (n > 1)
                color =
                    createColor((float)(sum[0] / count), (float)(sum[1] / count), (float)(sum[2] / count));
            putLinearPixel(job->framebuffer, x, y, color);
        }
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
                               .frame = cameraFrame(&scene->camera, framebuffer->width, framebuffer->height),
                               .media = mediaAmong(scene, compiled->transparent, compiled->transparentCount,
                                                   scene->camera.position)},
                       .options = options,
                       .squareColumns = columns,
                       .squareCount = columns * rows};
    Status status = runTasks(drawing.squareCount, options->threads, drawSquare, &drawing);
    if (counts != NULL)
        *counts =
            (RayCounts){.primary = drawing.primary, .shadow = drawing.shadow, .secondary = drawing.secondary};
    return status;
}
