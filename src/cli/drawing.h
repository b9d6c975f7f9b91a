/* drawing.h - a scene drawn by the engine that the command line names. */
#ifndef ECLAIRAGE_CLI_DRAWING_H
#define ECLAIRAGE_CLI_DRAWING_H

#include "cli/command.h"
#include "raytracer.h"

/* The engine to draw with. */
Engine chosenEngine(const Arguments *arguments);

/* How long its parts took, in seconds. */
typedef struct DrawingSeconds {
    double compile, trace;
} DrawingSeconds;

/* Draw the scene; counts may be NULL. */
Status drawScene(const Scene *scene, Engine engine, Framebuffer *framebuffer, const RenderOptions *options,
                 RayCounts *counts, DrawingSeconds *seconds);

#endif
