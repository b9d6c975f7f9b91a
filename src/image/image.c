/* image.c - pictures as they are stored; see image.h.
 *
 * This is the one place where a linear Framebuffer becomes integers: clamp, encode, round, each sample
 * by quantizeSample (colors.h), so that every file of ours is rounded the same way.
 */
#include "image/image.h"

#include "base/cancel.h"

#include <stdlib.h>

Status createImage(int width, int height, int bitDepth, Encoding encoding, Image *image)
{
    if (width < 1 || height < 1)
        return statusError(STATUS_IO, "a picture cannot be %d x %d pixels; give at least 1 x 1", width,
                           height);
    size_t sampleCount = 3 * (size_t)width * (size_t)height;
    uint16_t *samples =
        sampleCount <= SIZE_MAX / 2 / sizeof *samples ? calloc(sampleCount, sizeof *samples) : NULL;
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

Status imageFromFramebuffer(const Framebuffer *framebuffer, int bitDepth, Encoding encoding, Image *image)
{
    Image made;
    Status status = createImage(framebuffer->width, framebuffer->height, bitDepth, encoding, &made);
    if (!statusIsOk(&status))
        return status;
    const Color3f *pixel = framebuffer->pixels;
    uint16_t *sample = made.samples;
    for (int y = 0; y < made.height; y++) {
        if (cancelRequested()) {
            freeImage(&made);
            return statusInterrupted();
        }
        for (int x = 0; x < made.width; x++, pixel++, sample += 3) {
            sample[0] = (uint16_t)quantizeSample(pixel->r, bitDepth, encoding);
            sample[1] = (uint16_t)quantizeSample(pixel->g, bitDepth, encoding);
            sample[2] = (uint16_t)quantizeSample(pixel->b, bitDepth, encoding);
        }
    }
    *image = made;
    return statusOk();
}

Status savePicture(const Framebuffer *framebuffer, const char *path)
{
    Image image;
    Status status = imageFromFramebuffer(framebuffer, 8, ENCODING_SRGB, &image);
    if (!statusIsOk(&status))
        return status;
    status = writePng(path, &image);
    freeImage(&image);
    return status;
}
