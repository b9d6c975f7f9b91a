/* png_read.c - a PNG file as an Image (PNG specification, W3C 2003); see image.h.
 *
 * The file is read whole, then decoded by libpng into the Image's own memory: each row as PNG bytes
 * first, so that interlaced passes can add to it, and in the end widened in place to 16-bit samples.
 * libpng is told to skip every chunk that does not change the samples; the colour space is read here
 * from the chunks themselves, so a damaged profile cannot change what a gAMA chunk says.
 * Invariant of the libpng calls: everything that lives across them is in the Reader, never in a local
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
    SIDE_LIMIT = 65535, /* pixels */
    SIGNATURE_LENGTH = 8,
    DEFLATE_RATIO = 1032 /* what deflate makes of one byte at most (RFC 1951: 258 bytes of 2 bits) */
};

static const size_t FILE_LIMIT = (size_t)1 << 30; /* bytes */
static const size_t PIXEL_LIMIT = (size_t)1 << 31;

typedef struct Reader {
    const char *name;          /* of the file, for messages */
    const unsigned char *data; /* the whole file */
    size_t length, position;
    Image image;   /* samples owned */
    Status status; /* the first failure */
} Reader;

static _Noreturn void failReading(png_structp png, png_const_charp message)
{
    Reader *reader = png_get_error_ptr(png);
    if (statusIsOk(&reader->status))
        reader->status =
            statusError(STATUS_IO, "cannot read %s: the PNG is corrupt (%s); make or copy it again",
                        reader->name, message);
    png_longjmp(png, 1);
}

static void ignoreWarning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void takeBytes(png_structp png, png_bytep bytes, size_t length)
{
    Reader *reader = png_get_io_ptr(png);
    if (length > reader->length - reader->position) {
        reader->status = statusError(
            STATUS_IO, "cannot read %s: the PNG ends too early, after %zu bytes; make or copy it again",
            reader->name, reader->length);
        png_error(png, "truncated");
    }
    memcpy(bytes, reader->data + reader->position, length);
    reader->position += length;
}

static uint32_t readBigEndian(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

/* What the chunks before the picture say of the encoding. Each is a length, a type, that many bytes and
 * a CRC; libpng has found the CRCs right. */
static Encoding findEncoding(const unsigned char *data, size_t length)
{
    bool linear = false;
    for (size_t position = SIGNATURE_LENGTH; length - position >= 12;) {
        const unsigned char *chunk = data + position;
        size_t chunkLength = readBigEndian(chunk);
        if (chunkLength > length - position - 12 || memcmp(chunk + 4, "IDAT", 4) == 0)
            break;
        if (memcmp(chunk + 4, "sRGB", 4) == 0 || memcmp(chunk + 4, "iCCP", 4) == 0)
            return ENCODING_SRGB;
        /* gAMA is 100000 times the gamma of the file: 1 within 1 %. */
        if (memcmp(chunk + 4, "gAMA", 4) == 0 && chunkLength == 4) {
            uint32_t gamma = readBigEndian(chunk + 8);
            linear = gamma >= 99000 && gamma <= 101000;
        }
        position += chunkLength + 12;
    }
    return linear ? ENCODING_LINEAR : ENCODING_SRGB;
}

/* Refuse a size that is over the limits, or that a file of this length cannot hold: a few bytes must
 * not make us ask for gigabytes. */
static Status checkSize(const Reader *reader, png_uint_32 width, png_uint_32 height, size_t rowLength)
{
    if (width > SIDE_LIMIT || height > SIDE_LIMIT || (size_t)width * height > PIXEL_LIMIT)
        return statusError(
            STATUS_IO,
            "cannot read %s: %u x %u pixels are too many; the limits are %d a side and 2^31 in all",
            reader->name, (unsigned)width, (unsigned)height, SIDE_LIMIT);
    if (rowLength * height / DEFLATE_RATIO > reader->length)
        return statusError(STATUS_IO,
                           "cannot read %s: %zu bytes cannot hold its %u x %u pixels; make or copy it again",
                           reader->name, reader->length, (unsigned)width, (unsigned)height);
    return statusOk();
}

/* Have libpng give rows of RGB, 8 or 16 bits, whatever the file holds. */
static void askForRgb(png_structp png, png_infop info)
{
    png_set_expand(png); /* palette to RGB, less than 8 bits to 8, tRNS to alpha */
    png_set_gray_to_rgb(png);
    png_set_strip_alpha(png); /* dropped, not composited */
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
}

/* Widen the rows' bytes to samples, in place: from the end, since a sample of 16 bits is as long as or
 * longer than what it is made of. */
static void widenSamples(Image *image)
{
    size_t perRow = 3 * (size_t)image->width;
    for (int y = 0; y < image->height; y++) {
        uint16_t *samples = image->samples + (size_t)y * perRow;
        const unsigned char *bytes = (const unsigned char *)samples;
        for (size_t i = perRow; i-- > 0;) {
            int sample = image->bitDepth == 16 ? bytes[2 * i] << 8 | bytes[2 * i + 1] : bytes[i];
            samples[i] = (uint16_t)sample;
        }
    }
}

/* Decode everything; on failure reader->status says why. */
static void decodeAll(png_structp png, png_infop info, Reader *reader)
{
    if (setjmp(png_jmpbuf(png)) != 0)
        return;
    png_set_read_fn(png, reader, takeBytes);
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX); /* ours have a better message */
    png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
    png_read_info(png, info);

    /* Make room for the picture, if its size is believable. */
    png_uint_32 width = png_get_image_width(png, info);
    png_uint_32 height = png_get_image_height(png, info);
    reader->status = checkSize(reader, width, height, png_get_rowbytes(png, info));
    if (!statusIsOk(&reader->status))
        return;
    reader->status = createImage((int)width, (int)height, png_get_bit_depth(png, info) == 16 ? 16 : 8,
                                 findEncoding(reader->data, reader->length), &reader->image);
    if (!statusIsOk(&reader->status))
        return;
    reader->image.hadAlpha = (png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA) != 0 ||
                             png_get_valid(png, info, PNG_INFO_tRNS) != 0;

    /* Decode each pass into the picture's memory. */
    askForRgb(png, info);
    int passes = png_get_interlace_type(png, info) == PNG_INTERLACE_NONE ? 1 : PNG_INTERLACE_ADAM7_PASSES;
    for (int pass = 0; pass < passes; pass++) {
        for (png_uint_32 y = 0; y < height; y++) {
            if (cancelRequested()) {
                reader->status = statusInterrupted();
                return;
            }
            png_read_row(png, (png_bytep)(reader->image.samples + 3 * (size_t)y * width), NULL);
        }
    }
    png_read_end(png, NULL);
    widenSamples(&reader->image);
}

/* Decode the file in reader->data, whose name is reader->name. */
static Status decodePng(Reader *reader)
{
    if (reader->length == 0)
        return statusError(STATUS_IO, "cannot read %s: the file is empty; make or copy it again",
                           reader->name);
    size_t known = reader->length < SIGNATURE_LENGTH ? reader->length : SIGNATURE_LENGTH;
    if (png_sig_cmp(reader->data, 0, known) != 0)
        return statusError(STATUS_IO, "cannot read %s: it is not a PNG file; give a PNG file", reader->name);

    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, reader, failReading, ignoreWarning);
    png_infop info = png != NULL ? png_create_info_struct(png) : NULL;
    if (info == NULL)
        reader->status = statusOutOfMemory();
    else
        decodeAll(png, info, reader);
    png_destroy_read_struct(&png, &info, NULL);
    return reader->status;
}

Status readPng(const char *path, Image *image)
{
    char *data;
    size_t length;
    Status status = readWholeFile(path, FILE_LIMIT, &data, &length);
    if (!statusIsOk(&status))
        return status;
    char name[STATUS_MESSAGE_SIZE / 2];
    snprintf(name, sizeof name, strcmp(path, "-") == 0 ? "standard input" : "'%s'", path);
    Reader reader = {
        .name = name, .data = (const unsigned char *)data, .length = length, .status = statusOk()};
    status = decodePng(&reader);
    free(data);
    if (statusIsOk(&status))
        *image = reader.image;
    else
        freeImage(&reader.image);
    return status;
}
