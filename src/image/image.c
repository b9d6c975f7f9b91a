/* image.c - pictures as they are stored; see image.h.
 *
 * This is the one place where a linear Framebuffer becomes integers: clamp, encode, round, each sample
 * as by quantizeSample (colors.h), so that every file of ours is rounded the same way.
 */
#include "image/image.h"

#include "base/memory.h"
#include "base/threads.h"
#include "image/quantizer.h"

#include <stdlib.h>

enum {
    PIXELS_PER_TASK = 1 << 15 /* a few milliseconds at most */
};

Status createImage(int width, int height, int bitDepth, Encoding encoding, Image *image)
{
    if (width < 1 || height < 1)
        return statusError(STATUS_IO, "a picture cannot be %d x %d pixels; give at least 1 x 1", width,
                           height);
    size_t sampleCount = 3 * (size_t)width * (size_t)height;
    uint16_t *samples =
        sampleCount <= SIZE_MAX / 2 / sizeof *samples ? allocateZeroed(sampleCount, sizeof *samples) : NULL;
    if (samples == NULL)
        return statusError(STATUS_IO, "out of memory for a picture of %d x %d pixels; make it smaller", width,
                           height);
    *image = (Image){
        .width = width, .height = height, .bitDepth = bitDepth, .encoding = encoding, .samples = samples};
    return statusOk();
}

void freeImage(Image *image)
{
    free(image->samples);
    image->samples = NULL;
}

/* What the threads share: each task is a run of PIXELS_PER_TASK pixels, whatever the rows. */
typedef struct Conversion {
    const Quantizer *quantizer;
    const Color3f *pixels;
    size_t pixelCount;
    uint16_t *samples;
} Conversion;

static void convertPixels(void *context, size_t number)
{
    const Conversion *conversion = context;
    size_t first = number * PIXELS_PER_TASK;
    size_t left = conversion->pixelCount - first;
    quantizePixels(conversion->quantizer, conversion->pixels + first,
                   left < PIXELS_PER_TASK ? left : PIXELS_PER_TASK, conversion->samples + 3 * first);
}

Status imageFromFramebuffer(const Framebuffer *framebuffer, int bitDepth, Encoding encoding, int threads,
                            Image *image)
{
    Image made;
    Status status = createImage(framebuffer->width, framebuffer->height, bitDepth, encoding, &made);
    if (!statusIsOk(&status))
        return status;
    size_t pixelCount = (size_t)made.width * (size_t)made.height;
    Quantizer *quantizer = createQuantizer(bitDepth, encoding, 3 * pixelCount);
    Conversion conversion = {quantizer, framebuffer->pixels, pixelCount, made.samples};
    if (quantizer == NULL)
        status = statusOutOfMemory();
    else
        status = runTasks((pixelCount - 1) / PIXELS_PER_TASK + 1, threads, convertPixels, &conversion);
    freeQuantizer(quantizer);
    if (!statusIsOk(&status)) {
        freeImage(&made);
        return status;
    }
    *image = made;
    return statusOk();
}

Status savePicture(const Framebuffer *framebuffer, const char *path)
{
    int threads = availableProcessors();
    Image image;
    Status status = imageFromFramebuffer(framebuffer, 8, ENCODING_SRGB, threads, &image);
    if (!statusIsOk(&status))
        return status;
    status = writePng(path, &image, threads);
    freeImage(&image);
    return status;
}
