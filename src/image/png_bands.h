/* png_bands.h - the rows of an Image, filtered and compressed for a PNG's IDAT chunks, on several threads.
 *
 * The rows are cut into bands, each of which is compressed on its own; put one after another the bands
 * are one zlib stream. Where the cuts are depends on the picture alone, so the bytes are the same for
 * every number of threads.
 */
#ifndef ECLAIRAGE_IMAGE_PNG_BANDS_H
#define ECLAIRAGE_IMAGE_PNG_BANDS_H

#include "base/status.h"
#include "image/image.h"

#include <stddef.h>

typedef struct PngBand {
    unsigned char *data; /* owned */
    size_t length;       /* more than 0, below 2^31 */
} PngBand;

typedef struct PngBands {
    PngBand *bands; /* from the top of the picture to its bottom; owned */
    size_t count;
} PngBands;

/* Compress all rows on up to threads threads. STATUS_IO when memory runs out, STATUS_INTERRUPTED when
 * cancelled; on failure there is nothing to free, else the caller calls freePngBands. */
Status compressPngBands(const Image *image, int threads, PngBands *bands);
void freePngBands(PngBands *bands);

#endif
