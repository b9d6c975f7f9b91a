/* test_image.c - pictures as stored, and PNG files in and out.
 *
 * What we write is checked chunk by chunk against the PNG specification; what we read is made here, by
 * libpng for every colour type and by hand for what is broken, and its expected samples are worked out
 * from the specification. Run under the address sanitizer, which sees what a corrupt file breaks.
 */
#define _XOPEN_SOURCE 700
#include "base/cancel.h"
#include "base/files.h"
#include "file_checks.h"
#include "image/image.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <math.h>
#include <png.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char *folder; /* the working folder of a test */

static int enterFolder(void **state)
{
    (void)state;
    Status status = makeTemporaryFolder(&folder);
    return statusIsOk(&status) ? chdir(folder) : 1;
}

static int leaveFolder(void **state)
{
    (void)state;
    if (chdir("/") != 0)
        return 1;
    removeFolder(folder);
    free(folder);
    return 0;
}

static void assertFails(Status status, const char *first, const char *second)
{
    if (status.code != STATUS_IO || strstr(status.message, first) == NULL ||
        strstr(status.message, second) == NULL)
        fail_msg("code %d, message '%s'; expected '%s' and '%s'", (int)status.code, status.message, first,
                 second);
}

/* A small generator of its own, so that a failure can be repeated. */
static uint32_t randomState = 1;

static unsigned randomBelow(unsigned limit)
{
    randomState = randomState * 1664525u + 1013904223u;
    return (unsigned)(((uint64_t)randomState * limit) >> 32);
}

static Image randomImage(int width, int height, int bitDepth, Encoding encoding)
{
    Image image;
    assertOk(createImage(width, height, bitDepth, encoding, &image));
    for (size_t i = 0; i < 3 * (size_t)width * (size_t)height; i++) {
        assert_int_equal(image.samples[i], 0);
        image.samples[i] = (uint16_t)randomBelow(imageMaxSample(&image) + 1);
    }
    return image;
}

static void assertSameImage(const Image *a, const Image *b)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->bitDepth, b->bitDepth);
    assert_int_equal(a->encoding, b->encoding);
    assert_int_equal(a->hadAlpha, b->hadAlpha);
    assert_memory_equal(a->samples, b->samples, 6 * (size_t)a->width * (size_t)a->height);
}

/* ---- PNG files by hand ---- */

typedef struct Bytes {
    unsigned char data[4096];
    size_t length;
} Bytes;

static const unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

static void appendBytes(Bytes *bytes, const void *data, size_t length)
{
    assert_true(length <= sizeof bytes->data - bytes->length);
    memcpy(bytes->data + bytes->length, data, length);
    bytes->length += length;
}

static void appendNumber(Bytes *bytes, uint32_t number)
{
    unsigned char big[4] = {(unsigned char)(number >> 24), (unsigned char)(number >> 16),
                            (unsigned char)(number >> 8), (unsigned char)number};
    appendBytes(bytes, big, 4);
}

static uint32_t numberAt(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

/* The CRC of the PNG specification, annex D, bit by bit. */
static uint32_t findCrc(const unsigned char *bytes, size_t length)
{
    uint32_t crc = 0xFFFFFFFFu;
    for (size_t i = 0; i < length; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc & 1u ? 0xEDB88320u ^ (crc >> 1) : crc >> 1;
    }
    return ~crc;
}

static void appendChunk(Bytes *bytes, const char *type, const void *data, size_t length)
{
    appendNumber(bytes, (uint32_t)length);
    size_t start = bytes->length;
    appendBytes(bytes, type, 4);
    appendBytes(bytes, data, length);
    appendNumber(bytes, findCrc(bytes->data + start, length + 4));
}

static void appendHeader(Bytes *bytes, uint32_t width, uint32_t height, int bitDepth, int colorType)
{
    appendBytes(bytes, signature, sizeof signature);
    Bytes header = {.length = 0};
    appendNumber(&header, width);
    appendNumber(&header, height);
    unsigned char rest[5] = {(unsigned char)bitDepth, (unsigned char)colorType, 0, 0, 0};
    appendBytes(&header, rest, sizeof rest);
    appendChunk(bytes, "IHDR", header.data, header.length);
}

/* One white pixel of 8-bit RGB: a zlib stream of one stored block (RFC 1950, 1951). */
static void appendWhitePixel(Bytes *bytes)
{
    static const unsigned char stream[] = {0x78, 0x01, 0x01, 4,    0,    0xFB, 0xFF, 0,
                                           0xFF, 0xFF, 0xFF, 0x05, 0xFE, 0x02, 0xFE};
    appendChunk(bytes, "IDAT", stream, sizeof stream);
    appendChunk(bytes, "IEND", "", 0);
}

static Status readBytes(const void *data, size_t length, Image *image)
{
    assertOk(writeWholeFile("bytes.png", data, length));
    return readPng("bytes.png", image);
}

/* ---- Writing ---- */

static void returnsWhatWasWritten(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {1, 7}, {7, 1}, {3, 5}, {17, 9}, {255, 2}, {640, 33}, {3000, 1}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        for (int bitDepth = 8; bitDepth <= 16; bitDepth += 8) {
            for (int linear = 0; linear <= 1; linear++) {
                Image image =
                    randomImage(sizes[i][0], sizes[i][1], bitDepth, linear ? ENCODING_LINEAR : ENCODING_SRGB);
                assertOk(writePng("a.png", &image, 2));
                Image back;
                assertOk(readPng("a.png", &back));
                assertSameImage(&image, &back);

                /* In memory and in the file, now and again: the same bytes. */
                unsigned char *data;
                size_t length;
                assertOk(encodePng(&image, 2, &data, &length));
                char *file;
                size_t fileLength;
                assertOk(readWholeFile("a.png", 10000000, &file, &fileLength));
                assert_int_equal(length, fileLength);
                assert_memory_equal(data, file, length);
                free(data);
                free(file);
                freeImage(&back);
                freeImage(&image);
            }
        }
    }
}

/* Check that data begins as expected, goes on with IDAT chunks and ends with IEND, all with right CRCs. */
static void assertChunks(const Image *image, const Bytes *expected)
{
    unsigned char *data;
    size_t length;
    assertOk(encodePng(image, 2, &data, &length));
    assert_true(length > expected->length);
    /* First the signature and IHDR, then the others in an order that libpng chooses. */
    size_t header = 8 + 12 + 13;
    assert_memory_equal(data, expected->data, header);
    for (size_t at = header; at < expected->length;) {
        size_t chunk = numberAt((const unsigned char *)expected->data + at) + 12;
        bool found = false;
        for (size_t other = header; other < expected->length && !found;) {
            size_t otherChunk = numberAt(data + other) + 12;
            assert_true(otherChunk <= expected->length - other);
            found = otherChunk == chunk && memcmp(data + other, expected->data + at, chunk) == 0;
            other += otherChunk;
        }
        assert_true(found);
        at += chunk;
    }
    size_t position = expected->length;
    int pictureChunks = 0;
    while (length - position >= 12 && memcmp(data + position + 4, "IDAT", 4) == 0) {
        size_t chunkLength = numberAt(data + position);
        assert_true(chunkLength > 0 && chunkLength <= length - position - 12);
        assert_int_equal(numberAt(data + position + 8 + chunkLength),
                         findCrc(data + position + 4, chunkLength + 4));
        position += chunkLength + 12;
        pictureChunks++;
    }
    assert_true(pictureChunks >= 1);
    Bytes end = {.length = 0};
    appendChunk(&end, "IEND", "", 0);
    assert_int_equal(length - position, end.length);
    assert_memory_equal(data + position, end.data, end.length);
    free(data);
}

static void writesTheseChunksOnly(void **state)
{
    (void)state;
    /* The primaries and the white point of sRGB, times 100000 (PNG specification, 11.3.3.5). */
    static const uint32_t primaries[8] = {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000};
    for (int bitDepth = 8; bitDepth <= 16; bitDepth += 8) {
        Bytes expected = {.length = 0};
        appendHeader(&expected, 260, 130, bitDepth, PNG_COLOR_TYPE_RGB);
        Bytes chunk = {.length = 0};
        appendNumber(&chunk, 100000);
        appendChunk(&expected, "gAMA", chunk.data, chunk.length);
        Image image = randomImage(260, 130, bitDepth, ENCODING_LINEAR);
        assertChunks(&image, &expected);

        expected.length = 0;
        appendHeader(&expected, 260, 130, bitDepth, PNG_COLOR_TYPE_RGB);
        chunk.length = 0;
        appendNumber(&chunk, 45455);
        appendChunk(&expected, "gAMA", chunk.data, chunk.length);
        appendChunk(&expected, "sRGB", "\0", 1);
        chunk.length = 0;
        for (int i = 0; i < 8; i++)
            appendNumber(&chunk, primaries[i]);
        appendChunk(&expected, "cHRM", chunk.data, chunk.length);
        image.encoding = ENCODING_SRGB;
        assertChunks(&image, &expected);
        freeImage(&image);
    }
}

static void keepsTheOldPicture(void **state)
{
    (void)state;
    Image image = randomImage(5, 5, 8, ENCODING_SRGB);
    assertOk(makeFolders("d"));
    assertOk(writeWholeFile("file", "kept", 4));
    assertFails(writePng("d", &image, 2), "'d'", "folder");
    assertFails(writePng("no/x.png", &image, 2), "'no/x.png'", "does not exist");
    assertFails(writePng("file/x.png", &image, 2), "'file/x.png'", "not a folder");
    char *data;
    size_t length;
    assertOk(readWholeFile("file", 10, &data, &length));
    assert_string_equal(data, "kept");
    free(data);
    assert_int_equal(countEntries("."), 2);
    assert_int_equal(countEntries("d"), 0);

    /* A full disk. The device itself is written; otherwise stop before root replaces it. */
    OutputFile output;
    assertOk(openOutput(&output, "/dev/full"));
    bool direct = output.temporaryPath == NULL;
    abandonOutput(&output);
    assert_true(direct);
    assertFails(writePng("/dev/full", &image, 2), "'/dev/full'", "no space");
    freeImage(&image);
}

static void roundsTheFramebuffer(void **state)
{
    (void)state;
    Framebuffer *framebuffer = createFramebuffer(3, 2);
    assert_non_null(framebuffer);
    putLinearPixel(framebuffer, 0, 0, createColor(0.0f, 0.5f, 1.0f));
    putLinearPixel(framebuffer, 1, 0, createColor(-1.0f, 7.0f, NAN));
    putLinearPixel(framebuffer, 2, 0, createColor(INFINITY, -INFINITY, 0.25f));
    putLinearPixel(framebuffer, 0, 1, createColor(0.22f, 0.001f, 0.9f));
    Image image;
    assertOk(imageFromFramebuffer(framebuffer, 8, ENCODING_LINEAR, 2, &image));
    static const uint16_t linear8[9] = {0, 128, 255, 0, 255, 0, 255, 0, 64};
    assert_memory_equal(image.samples, linear8, sizeof linear8);
    freeImage(&image);
    assertOk(imageFromFramebuffer(framebuffer, 16, ENCODING_LINEAR, 2, &image));
    static const uint16_t linear16[9] = {0, 32768, 65535, 0, 65535, 0, 65535, 0, 16384};
    assert_memory_equal(image.samples, linear16, sizeof linear16);
    assert_int_equal(image.bitDepth, 16);
    assert_int_equal(image.encoding, ENCODING_LINEAR);
    assert_false(image.hadAlpha);
    freeImage(&image);

    /* By the sRGB curve 0.5064, 0.01292 (its straight part) and 0.9547. */
    assertOk(savePicture(framebuffer, "a.png"));
    assertOk(readPng("a.png", &image));
    assert_int_equal(image.bitDepth, 8);
    assert_int_equal(image.encoding, ENCODING_SRGB);
    static const uint16_t srgb8[3] = {129, 3, 243};
    assert_memory_equal(image.samples + 9, srgb8, sizeof srgb8);
    freeImage(&image);
    assertFails(savePicture(framebuffer, "no/a.png"), "'no/a.png'", "does not exist");
    freeFramebuffer(framebuffer);

    assertFails(createImage(0, 5, 8, ENCODING_SRGB, &image), "0 x 5", "1 x 1");
    assertFails(createImage(5, -1, 8, ENCODING_SRGB, &image), "5 x -1", "1 x 1");
}

/* ---- Reading what libpng writes ---- */

enum {
    PALETTE_SIZE = 256
};

/* A file of any kind; raw holds a value for each channel of each pixel. */
typedef struct Kind {
    int bitDepth, colorType, interlace;
    bool transparent; /* with a tRNS chunk */
} Kind;

static int channelsOf(int colorType)
{
    return colorType == PNG_COLOR_TYPE_RGB          ? 3
           : colorType == PNG_COLOR_TYPE_RGB_ALPHA  ? 4
           : colorType == PNG_COLOR_TYPE_GRAY_ALPHA ? 2
                                                    : 1;
}

static png_color paletteEntry(unsigned index)
{
    return (png_color){(png_byte)(index * 37 + 5), (png_byte)(255 - index), (png_byte)(index * index)};
}

static void writeKind(const char *path, Kind kind, int width, int height, const uint16_t *raw)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    assert_non_null(info);
    png_init_io(png, file);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, kind.bitDepth, kind.colorType,
                 kind.interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_color palette[PALETTE_SIZE];
    png_byte alpha[PALETTE_SIZE];
    for (unsigned i = 0; i < PALETTE_SIZE; i++) {
        palette[i] = paletteEntry(i);
        alpha[i] = (png_byte)(i * 3);
    }
    if (kind.colorType == PNG_COLOR_TYPE_PALETTE)
        png_set_PLTE(png, info, palette, 1 << kind.bitDepth);
    png_color_16 clear = {.red = raw[0], .green = raw[1], .blue = raw[2], .gray = raw[0]};
    if (kind.transparent)
        png_set_tRNS(png, info, alpha, 1 << (kind.bitDepth < 8 ? kind.bitDepth : 8), &clear);
    png_write_info(png, info);

    /* Pack each row: the first pixel in the high bits, 16 bits with the high byte first. */
    int passes = png_set_interlace_handling(png);
    size_t perRow = (size_t)width * (size_t)channelsOf(kind.colorType);
    png_byte *row = malloc(2 * perRow);
    assert_non_null(row);
    for (int pass = 0; pass < passes; pass++) {
        for (int y = 0; y < height; y++) {
            memset(row, 0, 2 * perRow);
            for (size_t i = 0; i < perRow; i++) {
                unsigned value = raw[(size_t)y * perRow + i];
                size_t bit = i * (size_t)kind.bitDepth;
                if (kind.bitDepth == 16) {
                    row[2 * i] = (png_byte)(value >> 8);
                    row[2 * i + 1] = (png_byte)value;
                } else {
                    row[bit / 8] |= (png_byte)(value << (8 - (size_t)kind.bitDepth - bit % 8));
                }
            }
            png_write_row(png, row);
        }
    }
    free(row);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    assert_int_equal(fclose(file), 0);
}

/* What a channel of a pixel of that file is as an Image's sample. */
static unsigned expectedSample(Kind kind, const uint16_t *pixel, int channel)
{
    if (kind.colorType == PNG_COLOR_TYPE_PALETTE) {
        png_color color = paletteEntry(pixel[0]);
        return channel == 0 ? color.red : channel == 1 ? color.green : color.blue;
    }
    bool colored = (kind.colorType & PNG_COLOR_MASK_COLOR) != 0;
    unsigned value = pixel[colored ? channel : 0];
    return kind.bitDepth < 8 ? value * 255 / ((1u << kind.bitDepth) - 1) : value;
}

static void checkKind(Kind kind, int width, int height)
{
    int channels = channelsOf(kind.colorType);
    uint16_t *raw = malloc(((size_t)width * (size_t)height * (size_t)channels + 3) * sizeof *raw);
    assert_non_null(raw);
    for (size_t i = 0; i < (size_t)width * (size_t)height * (size_t)channels + 3; i++)
        raw[i] = (uint16_t)randomBelow(1u << kind.bitDepth);
    writeKind("kind.png", kind, width, height, raw);
    Image image;
    assertOk(readPng("kind.png", &image));
    assert_int_equal(image.width, width);
    assert_int_equal(image.height, height);
    assert_int_equal(image.bitDepth, kind.bitDepth == 16 ? 16 : 8);
    assert_int_equal(image.encoding, ENCODING_SRGB);
    assert_int_equal(image.hadAlpha, kind.transparent || (kind.colorType & PNG_COLOR_MASK_ALPHA) != 0);
    for (int i = 0; i < 3 * width * height; i++) {
        unsigned expected = expectedSample(kind, raw + (size_t)(i / 3) * (size_t)channels, i % 3);
        if (image.samples[i] != expected)
            fail_msg("colour type %d, %d bits, interlace %d, tRNS %d, %dx%d: sample %d is %u, expected %u",
                     kind.colorType, kind.bitDepth, kind.interlace, kind.transparent, width, height, i,
                     (unsigned)image.samples[i], expected);
    }
    freeImage(&image);
    free(raw);
}

static void readsEveryColorType(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {5, 3}, {33, 18}};
    static const int colorTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_PALETTE,
                                     PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB_ALPHA};
    int kinds = 0;
    for (int type = 0; type < 5; type++) {
        int colorType = colorTypes[type];
        bool alpha = (colorType & PNG_COLOR_MASK_ALPHA) != 0;
        bool small = colorType == PNG_COLOR_TYPE_GRAY || colorType == PNG_COLOR_TYPE_PALETTE;
        for (int bitDepth = small ? 1 : 8; bitDepth <= (colorType == PNG_COLOR_TYPE_PALETTE ? 8 : 16);
             bitDepth *= 2) {
            for (int variant = 0; variant < (alpha ? 2 : 4); variant++) {
                Kind kind = {bitDepth, colorType, variant & 1, (variant & 2) != 0};
                for (int size = 0; size < 3; size++)
                    checkKind(kind, sizes[size][0], sizes[size][1]);
                kinds++;
            }
        }
    }
    assert_int_equal(kinds, 4 * (5 + 2 + 4) + 2 * (2 + 2));
}

/* ---- Which encoding ---- */

typedef struct ExtraChunk {
    const char *type;
    const char *data;
    size_t length;
} ExtraChunk;

static void knowsLinearFromSrgb(void **state)
{
    (void)state;
#define GAMMA(a, b, c)                                                                                       \
    {                                                                                                        \
        "gAMA", "\0" a b c, 4                                                                                \
    }
    static const struct {
        ExtraChunk chunks[2];
        Encoding expected;
    } cases[] = {
        {{{0}}, ENCODING_SRGB},
        {{GAMMA("\x01", "\x86", "\xA0")}, ENCODING_LINEAR}, /* 100000 */
        {{GAMMA("\x01", "\x82", "\xB8")}, ENCODING_LINEAR}, /* 99000 */
        {{GAMMA("\x01", "\x82", "\xB7")}, ENCODING_SRGB},   /* 98999 */
        {{GAMMA("\x01", "\x8A", "\x88")}, ENCODING_LINEAR}, /* 101000 */
        {{GAMMA("\x01", "\x8A", "\x89")}, ENCODING_SRGB},   /* 101001 */
        {{GAMMA("\x00", "\xB1", "\x8F")}, ENCODING_SRGB},   /* 45455 */
        {{GAMMA("\x00", "\x00", "\x00")}, ENCODING_SRGB},
        {{{"sRGB", "\0", 1}}, ENCODING_SRGB},
        {{GAMMA("\x01", "\x86", "\xA0"), {"sRGB", "\0", 1}}, ENCODING_SRGB},
        {{{"sRGB", "\0", 1}, GAMMA("\x01", "\x86", "\xA0")}, ENCODING_SRGB},
        {{GAMMA("\x01", "\x86", "\xA0"), {"iCCP", "a\0\0broken", 9}}, ENCODING_SRGB},
        /* Chromaticities that make no sense, which make libpng itself forget the gamma. */
        {{GAMMA("\x01", "\x86", "\xA0"),
          {"cHRM", "\0\0\0\1\0\0\0\1\0\0\0\1\0\0\0\1\0\0\0\1\0\0\0\1\0\0\0\1\0\0\0\1", 32}},
         ENCODING_LINEAR},
        {{GAMMA("\x01", "\x86", "\xA0"), {"tEXt", "Comment\0sRGB", 12}}, ENCODING_LINEAR},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Bytes bytes = {.length = 0};
        appendHeader(&bytes, 1, 1, 8, PNG_COLOR_TYPE_RGB);
        for (int j = 0; j < 2 && cases[i].chunks[j].type != NULL; j++)
            appendChunk(&bytes, cases[i].chunks[j].type, cases[i].chunks[j].data, cases[i].chunks[j].length);
        appendWhitePixel(&bytes);
        Image image;
        assertOk(readBytes(bytes.data, bytes.length, &image));
        if (image.encoding != cases[i].expected)
            fail_msg("case %zu: encoding %d", i, (int)image.encoding);
        assert_int_equal(image.samples[0], 255);
        assert_int_equal(image.samples[2], 255);
        freeImage(&image);
    }
}

/* ---- Broken files ---- */

static void refusesWhatIsNoPicture(void **state)
{
    (void)state;
    Image untouched = {.width = -7};
    Image *image = &untouched;
    assertFails(readPng("missing.png", image), "'missing.png'", "does not exist");
    assertFails(readPng(".", image), "'.'", "folder");
    assertFails(readBytes("", 0, image), "'bytes.png'", "empty");
    assertFails(readBytes("GIF89a, a picture of another kind", 33, image), "'bytes.png'", "not a PNG");
    assertFails(readBytes(signature, 3, image), "'bytes.png'", "too early");
    assertFails(readBytes(signature, sizeof signature, image), "'bytes.png'", "too early");

    /* Sizes over the limits, sizes that so few bytes cannot hold, sizes of nothing. */
    static const struct {
        uint32_t width, height;
        const char *reason;
    } sizes[] = {
        {65536, 1, "too many"},      {1, 65536, "too many"},
        {65535, 65535, "too many"},  {0x7FFFFFFF, 0x7FFFFFFF, "too many"},
        {65535, 32769, "too many"},  {65535, 32768, "cannot hold"},
        {65535, 1, "cannot hold"},   {30000, 30000, "cannot hold"},
        {2, 1, "corrupt"},           {1, 2, "corrupt"},
        {0, 1, "corrupt"},           {1, 0, "corrupt"},
        {0x80000000u, 1, "corrupt"}, {1, 0xFFFFFFFFu, "corrupt"},
    };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        Bytes bytes = {.length = 0};
        appendHeader(&bytes, sizes[i].width, sizes[i].height, 8, PNG_COLOR_TYPE_RGB);
        appendWhitePixel(&bytes);
        assertFails(readBytes(bytes.data, bytes.length, image), "'bytes.png'", sizes[i].reason);
    }

    /* The largest side there may be is read. */
    Image wide = randomImage(65535, 1, 8, ENCODING_SRGB);
    assertOk(writePng("wide.png", &wide, 2));
    Image back;
    assertOk(readPng("wide.png", &back));
    assertSameImage(&wide, &back);
    freeImage(&wide);
    freeImage(&back);

    assert_int_equal(untouched.width, -7);
    assert_null(untouched.samples);
}

/* Files to break: plain, and one of every feature (palette, tRNS, interlacing). */
static unsigned char *fileToBreak(int number, size_t *length)
{
    uint16_t raw[3 * 7 * 5 + 3];
    for (size_t i = 0; i < sizeof raw / sizeof *raw; i++)
        raw[i] = (uint16_t)randomBelow(16);
    if (number == 0) {
        Image image = randomImage(7, 5, 16, ENCODING_LINEAR);
        unsigned char *data;
        assertOk(encodePng(&image, 2, &data, length));
        freeImage(&image);
        return data;
    }
    Kind kind = {4, PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_ADAM7, true};
    writeKind("break.png", kind, 7, 5, raw);
    char *file;
    assertOk(readWholeFile("break.png", 100000, &file, length));
    return (unsigned char *)file;
}

static void survivesEveryTruncation(void **state)
{
    (void)state;
    for (int number = 0; number < 2; number++) {
        size_t length;
        unsigned char *data = fileToBreak(number, &length);
        Image image = {.width = -7};
        for (size_t cut = 0; cut < length; cut++)
            assertFails(readBytes(data, cut, &image), "'bytes.png'", "copy it again");
        assert_int_equal(image.width, -7);
        assertOk(readBytes(data, length, &image));
        freeImage(&image);
        free(data);
    }
}

/* Put the right CRC behind every chunk, as far as their lengths make sense. */
static void repairCrcs(unsigned char *data, size_t length)
{
    for (size_t position = 8; length - position >= 12;) {
        size_t chunkLength = numberAt(data + position);
        if (chunkLength > length - position - 12)
            return;
        uint32_t crc = findCrc(data + position + 4, chunkLength + 4);
        for (size_t i = 0; i < 4; i++)
            data[position + 8 + chunkLength + i] = (unsigned char)(crc >> (24 - 8 * i));
        position += chunkLength + 12;
    }
}

static void survivesCorruption(void **state)
{
    (void)state;
    for (int number = 0; number < 2; number++) {
        size_t length;
        unsigned char *data = fileToBreak(number, &length);
        unsigned char *broken = malloc(length);
        assert_non_null(broken);
        int refused = 0;
        for (size_t i = 0; i < length; i++) {
            static const unsigned char flips[] = {0x01, 0x80, 0xFF, 0x20};
            for (size_t flip = 0; flip < sizeof flips; flip++) {
                /* Every single byte that is wrong is noticed. */
                memcpy(broken, data, length);
                broken[i] ^= flips[flip];
                Image image = {.width = -7};
                assertFails(readBytes(broken, length, &image), "cannot read", "'bytes.png'");
                assert_int_equal(image.width, -7);

                /* With the CRC made right it reaches the decoder, which may or may not find out. */
                repairCrcs(broken, length);
                Status status = readBytes(broken, length, &image);
                if (statusIsOk(&status)) {
                    assert_true(image.width > 0 && image.samples != NULL);
                    freeImage(&image);
                } else {
                    assert_int_equal(status.code, STATUS_IO);
                    assert_int_equal(image.width, -7);
                    refused++;
                }
            }
        }
        assert_true(refused > 50);
        free(broken);
        free(data);
    }
}

/* ---- Cancelling, in a process of its own since the flag is never cleared ---- */

static bool cancelAll(void)
{
    Image image = {.width = 1, .height = 1, .bitDepth = 8, .samples = (uint16_t[3]){1, 2, 3}};
    Status written = writePng("a.png", &image, 2);
    requestCancel();
    Status overwritten = writePng("b.png", &image, 2);
    unsigned char *data;
    size_t length;
    Status encoded = encodePng(&image, 2, &data, &length);
    Status read = readPng("a.png", &image);
    Framebuffer *framebuffer = createFramebuffer(2, 2);
    Status made = imageFromFramebuffer(framebuffer, 8, ENCODING_SRGB, 2, &image);
    freeFramebuffer(framebuffer);
    return statusIsOk(&written) && overwritten.code == STATUS_INTERRUPTED &&
           encoded.code == STATUS_INTERRUPTED && read.code == STATUS_INTERRUPTED &&
           made.code == STATUS_INTERRUPTED;
}

static void stopsWhenCancelled(void **state)
{
    (void)state;
    fflush(stdout);
    fflush(stderr);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0)
        _exit(cancelAll() ? 0 : 1);
    int result;
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_int_equal(result, 0);
    assert_int_equal(countEntries("."), 1);
}

int main(void)
{
    signal(SIGPIPE, SIG_IGN);
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, enterFolder, leaveFolder)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(returnsWhatWasWritten),  IN_FOLDER(writesTheseChunksOnly),   IN_FOLDER(keepsTheOldPicture),
        IN_FOLDER(roundsTheFramebuffer),   IN_FOLDER(readsEveryColorType),     IN_FOLDER(knowsLinearFromSrgb),
        IN_FOLDER(refusesWhatIsNoPicture), IN_FOLDER(survivesEveryTruncation), IN_FOLDER(survivesCorruption),
        IN_FOLDER(stopsWhenCancelled),
    };
    return cmocka_run_group_tests_name("image", tests, NULL, NULL);
}
