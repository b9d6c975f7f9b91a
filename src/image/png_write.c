/* png_write.c - an Image as a PNG file (PNG specification, W3C 2003); see image.h.
 *
 * The file is made in memory and then written whole (base/files.h). Its chunks are IHDR, the colour
 * space, IDAT, IEND and nothing else: no time, no text, so the same Image gives the same bytes. libpng
 * makes the chunks; what is in the IDAT chunks comes from png_bands.h, a band in each.
 * Invariant of the libpng calls: everything that lives across them is in the Writer, never in a local
 * variable, since libpng leaves by longjmp when it fails (C17 7.13.2.1: changed locals are then lost).
 */
#include "base/cancel.h"
#include "base/files.h"
#include "image/image.h"
#include "image/png_bands.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

enum {
    PNG_LINEAR_GAMMA = 100000 /* gAMA holds 100000 times the file's gamma, which is 1 */
};

typedef struct Writer {
    const Image *image;
    PngBands bands;      /* those not written yet have data; owned */
    unsigned char *data; /* the file so far; owned */
    size_t length, capacity;
    Status status; /* the first failure */
} Writer;

/* libpng calls this and must not be returned to. */
static _Noreturn void failWriting(png_structp png, png_const_charp message)
{
    Writer *writer = png_get_error_ptr(png);
    if (statusIsOk(&writer->status))
        writer->status = statusError(STATUS_IO, "cannot make the PNG: libpng says '%s'", message);
    png_longjmp(png, 1);
}

static void ignoreWarning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void appendBytes(png_structp png, png_bytep bytes, size_t length)
{
    Writer *writer = png_get_io_ptr(png);
    if (length > writer->capacity - writer->length) {
        size_t capacity =
            writer->capacity * 2 > writer->length + length ? writer->capacity * 2 : writer->length + length;
        unsigned char *data = realloc(writer->data, capacity);
        if (data == NULL) {
            writer->status = statusOutOfMemory();
            png_error(png, "out of memory");
        }
        writer->data = data;
        writer->capacity = capacity;
    }
    memcpy(writer->data + writer->length, bytes, length);
    writer->length += length;
}

static void flushNothing(png_structp png)
{
    (void)png;
}

/* Write everything; on failure writer->status says why. */
static void encodeAll(png_structp png, png_infop info, Writer *writer)
{
    if (setjmp(png_jmpbuf(png)) != 0)
        return;
    const Image *image = writer->image;
    png_set_write_fn(png, writer, appendBytes, flushNothing);
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);

    /* Say what the samples are. */
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, image->bitDepth,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (image->encoding == ENCODING_LINEAR)
        png_set_gAMA_fixed(png, info, PNG_LINEAR_GAMMA);
    else
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);

    /* Write each band, and free it, so that the picture is not twice in memory. */
    static const png_byte dataChunk[4] = {'I', 'D', 'A', 'T'}, endChunk[4] = {'I', 'E', 'N', 'D'};
    for (size_t i = 0; i < writer->bands.count; i++) {
        if (cancelRequested()) {
            writer->status = statusInterrupted();
            return;
        }
        PngBand *band = &writer->bands.bands[i];
        png_write_chunk(png, dataChunk, band->data, band->length);
        free(band->data);
        band->data = NULL;
    }
    png_write_chunk(png, endChunk, NULL, 0);
}

Status encodePng(const Image *image, int threads, unsigned char **data, size_t *length)
{
    Writer writer = {.image = image};
    writer.status = compressPngBands(image, threads, &writer.bands);
    if (!statusIsOk(&writer.status))
        return writer.status;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer, failWriting, ignoreWarning);
    png_infop info = png != NULL ? png_create_info_struct(png) : NULL;
    if (info == NULL)
        writer.status = statusOutOfMemory();
    else
        encodeAll(png, info, &writer);
    png_destroy_write_struct(&png, &info);
    freePngBands(&writer.bands);
    if (!statusIsOk(&writer.status)) {
        free(writer.data);
        return writer.status;
    }
    *data = writer.data;
    *length = writer.length;
    return statusOk();
}

Status writePng(const char *path, const Image *image, int threads)
{
    unsigned char *data;
    size_t length;
    Status status = encodePng(image, threads, &data, &length);
    if (!statusIsOk(&status))
        return status;
    status = writeWholeFile(path, data, length);
    free(data);
    return status;
}
