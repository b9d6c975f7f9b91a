/* png_write.c - an Image as a PNG file (PNG specification, W3C 2003); see image.h.
 *
 * The file is made in memory and then written whole (base/files.h). Its chunks are IHDR, the colour
 * space, IDAT, IEND and nothing else: no time, no text, so the same Image gives the same bytes.
 * Invariant of the libpng calls: everything that lives across them is in the Writer, never in a local
 * variable, since libpng leaves by longjmp when it fails (C17 7.13.2.1: changed locals are then lost).
 */
#include "base/cancel.h"
#include "base/files.h"
#include "image/image.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

enum {
    PNG_LINEAR_GAMMA = 100000,     /* gAMA holds 100000 times the file's gamma, which is 1 */
    COMPRESSION_LEVEL = 1,         /* zlib's */
    COMPRESSION_BUFFER = 64 * 1024 /* bytes in an IDAT chunk */
};

typedef struct Writer {
    const Image *image;
    unsigned char *data; /* the file so far; owned */
    size_t length, capacity;
    unsigned char *row; /* one row as PNG stores it; owned */
    Status status;      /* the first failure */
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

/* One row as PNG stores it: samples of one byte, or of two with the high byte first. */
static void packRow(const Image *image, int y, unsigned char *row)
{
    size_t count = 3 * (size_t)image->width;
    const uint16_t *samples = image->samples + (size_t)y * count;
    if (image->bitDepth == 16) {
        for (size_t i = 0; i < count; i++) {
            row[2 * i] = (unsigned char)(samples[i] >> 8);
            row[2 * i + 1] = (unsigned char)(samples[i] & 0xFF);
        }
    } else {
        for (size_t i = 0; i < count; i++)
            row[i] = (unsigned char)samples[i];
    }
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

    /* Compress fast. Measured at 640x480, a sphere on a plane: 8 bits in 3.8 ms to 74 kB, 16 bits in
     * 10 ms to 303 kB; zlib's usual level 6 takes 16 and 32 ms to 51 and 248 kB. Up is the filter of
     * fewest bytes for its time. */
    png_set_compression_level(png, COMPRESSION_LEVEL);
    png_set_compression_buffer_size(png, COMPRESSION_BUFFER);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_write_info(png, info);

    for (int y = 0; y < image->height; y++) {
        if (cancelRequested()) {
            writer->status = statusInterrupted();
            return;
        }
        packRow(image, y, writer->row);
        png_write_row(png, writer->row);
    }
    png_write_end(png, NULL);
}

Status encodePng(const Image *image, unsigned char **data, size_t *length)
{
    Writer writer = {.image = image, .status = statusOk()};
    size_t rowLength = 3 * (size_t)image->width * (image->bitDepth == 16 ? 2 : 1);
    writer.row = malloc(rowLength);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer, failWriting, ignoreWarning);
    png_infop info = png != NULL ? png_create_info_struct(png) : NULL;
    if (writer.row == NULL || info == NULL)
        writer.status = statusOutOfMemory();
    else
        encodeAll(png, info, &writer);
    png_destroy_write_struct(&png, &info);
    free(writer.row);
    if (!statusIsOk(&writer.status)) {
        free(writer.data);
        return writer.status;
    }
    *data = writer.data;
    *length = writer.length;
    return statusOk();
}

Status writePng(const char *path, const Image *image)
{
    unsigned char *data;
    size_t length;
    Status status = encodePng(image, &data, &length);
    if (!statusIsOk(&status))
        return status;
    status = writeWholeFile(path, data, length);
    free(data);
    return status;
}
