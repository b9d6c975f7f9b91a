/* drawing.h - a scene drawn by the engine that the command line names. */
#ifndef ECLAIRAGE_CLI_DRAWING_H
#define ECLAIRAGE_CLI_DRAWING_H

#include "base/text.h"
#include "cli/command.h"
#include "image/image.h"
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

/* Draw the scene, which messages call path, and store it as it says in *image, which the caller frees. A
 * warning of what a picture cannot hold is appended to messages. */
Status drawImage(const Scene *scene, const char *path, Engine engine, int threads, Image *image,
                 DrawingSeconds *seconds, Text *messages);

#endif
