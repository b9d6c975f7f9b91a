/* image.h - pictures as they are stored, and PNG files in and out.
 *
 * An Image holds integer RGB samples, 8 or 16 bits each, encoded by the sRGB curve or linear: exactly
 * what a PNG holds. Comparison works on Images, since these are what two renderers can agree on.
 * Writing goes to a temporary file that is renamed (base/files.h); reading never crashes on a corrupt
 * file. No timestamps: the same Image gives the same bytes.
 */
#ifndef ECLAIRAGE_IMAGE_IMAGE_H
#define ECLAIRAGE_IMAGE_IMAGE_H

#include "base/status.h"
#include "colors.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct Image {
    int width, height;
    int bitDepth;      /* 8 or 16 */
    Encoding encoding; /* by the file's chunks; no chunk means sRGB */
    bool hadAlpha;     /* the file had an alpha channel or tRNS chunk, which was ignored */
    uint16_t *samples; /* samples[3 * (y * width + x) + channel], row 0 at the top; owned */
} Image;

/* A black image; STATUS_IO when memory runs out. The caller frees it with freeImage. */
Status createImage(int width, int height, int bitDepth, Encoding encoding, Image *image);
void freeImage(Image *image);

/* The framebuffer as stored: each sample is that of quantizeSample. Works on up to threads threads, which
 * change nothing but the time. STATUS_IO when memory runs out, STATUS_INTERRUPTED when cancelled; on
 * failure image is untouched. */
Status imageFromFramebuffer(const Framebuffer *framebuffer, int bitDepth, Encoding encoding, int threads,
                            Image *image);

/* The largest sample value, 255 or 65535. */
static inline unsigned imageMaxSample(const Image *image)
{
    return image->bitDepth == 16 ? 65535u : 255u;
}

/* Write a PNG; "-" is standard output. With sRGB an sRGB chunk (and the gAMA and cHRM that go with it),
 * linear a gAMA chunk of 1.0. Works on up to threads threads; the bytes are the same for any number.
 * STATUS_IO names the file and the reason, and leaves the old file as it was; STATUS_INTERRUPTED when
 * cancelled. */
Status writePng(const char *path, const Image *image, int threads);

/* The same bytes in memory; *data is freed by the caller. */
Status encodePng(const Image *image, int threads, unsigned char **data, size_t *length);

/* Read a PNG of any colour type, depth and interlacing; grey and palette are expanded to RGB, depths
 * below 8 to 8, alpha is dropped (hadAlpha). A gAMA chunk within 1 % of 1.0 and no sRGB or iCCP chunk
 * means linear. Width and height are limited to 65535 each and 2^31 pixels. STATUS_IO with the file's
 * name and the reason for a missing, empty, truncated or corrupt file; on failure image is untouched. */
Status readPng(const char *path, Image *image);

/* For a program of one's own: clamp, encode as 8-bit sRGB and write, on all processors. */
Status savePicture(const Framebuffer *framebuffer, const char *path);

#endif
