/* run.h - run POV-Ray as a program, apart from the user's and the folder's configuration. */
#ifndef ECLAIRAGE_POVRAY_RUN_H
#define ECLAIRAGE_POVRAY_RUN_H

#include "base/status.h"
#include "image/image.h"
#include "raytracer.h"

#include <stdbool.h>

enum {
    POVRAY_TIMEOUT = 600 /* seconds that a picture may take which someone waits for */
};

typedef struct PovraySettings {
    int width, height;
    int bitDepth; /* 8 or 16 */
    Encoding encoding;
    int samples;           /* n for the mean of n x n rays a pixel; above 1 only with linear encoding */
    double gamma;          /* the .pov's assumed_gamma, which counts with samples above 1; 0 is 1 */
    int threads;           /* POV-Ray's work threads, at least 1 */
    double timeoutSeconds; /* then it is killed: STATUS_POVRAY */
    bool onePixel;         /* draw only the pixel (x, y), from 0 at the top left; all others are black */
    int x, y;
} PovraySettings;

/* The scene's picture as the scene says, with POVRAY_TIMEOUT. */
PovraySettings createPovraySettings(const Scene *scene, int threads);

/* Whether there is a program povray on the PATH; STATUS_POVRAY with the command that installs it. */
Status findPovray(void);

/* Render the text of a .pov into *image, which the caller frees. POV-Ray's own antialiasing adds the middle
 * of the pixel to the n x n samples, so with samples above 1 it runs twice, with and without, and the middle
 * is taken out again (MAPPING.md). STATUS_POVRAY when POV-Ray is missing, fails (with the end of what it
 * said), takes too long, writes too much or another picture; STATUS_INTERRUPTED when cancelled. Nothing is
 * left behind: no process, no file. */
Status runPovray(const char *pov, const PovraySettings *settings, Image *image);

#endif
