/* flip.h - the difference a person sees when flipping between two pictures (METRICS.md). */
#ifndef ECLAIRAGE_COMPARE_FLIP_H
#define ECLAIRAGE_COMPARE_FLIP_H

#include "base/status.h"
#include "image/image.h"

/* The mean LDR-FLIP of two comparable pictures at 67 pixels per degree of visual angle: 0..1, 0 for
 * equal pictures, lower is better; the order of the two does not matter. Where the picture ends, its
 * border pixels are repeated. The same bits for any number of threads.
 * STATUS_IO when memory runs out, STATUS_INTERRUPTED when cancelled. */
Status measureFlip(const Image *a, const Image *b, int threads, double *mean);

#endif
