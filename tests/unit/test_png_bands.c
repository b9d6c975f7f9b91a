/* test_png_bands.c - PNG files compressed in bands: the same bytes on any number of threads, and valid.
 *
 * Each file is read in three ways: by readPng, by libpng with every warning an error, and by hand, where
 * zlib checks the sum at the end of the stream and the filter Up is undone as the PNG specification says.
 */
#include "base/cancel.h"
#include "file_checks.h"
#include "image/image.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <png.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#include <zlib.h>

/* What the pictures show: nothing compresses noise, everything compresses one colour. */
typedef enum Content {
    CONTENT_FLAT,
    CONTENT_SLOPES,
    CONTENT_NOISE,
    CONTENTS
} Content;

static Image makeImage(int width, int height, int bitDepth, Content content)
{
    Image image;
    assertOk(createImage(width, height, bitDepth, bitDepth == 16 ? ENCODING_LINEAR : ENCODING_SRGB, &image));
    uint32_t random = 1;
    uint16_t *sample = image.samples;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            for (int channel = 0; channel < 3; channel++, sample++) {
                random = random * 1664525u + 1013904223u;
                unsigned value = content == CONTENT_FLAT     ? 40000u
                                 : content == CONTENT_SLOPES ? (unsigned)(x * 97 + y * 31 + channel * 9000)
                                                             : random >> 16;
                *sample = (uint16_t)(value & imageMaxSample(&image));
            }
        }
    }
    return image;
}

/* Whether a row as PNG stores it, two bytes with the high one first for 16 bits, holds these samples. */
static bool rowHolds(const unsigned char *row, const uint16_t *samples, size_t count, int bitDepth)
{
    for (size_t i = 0; i < count; i++) {
        if (samples[i] != (bitDepth == 8 ? row[i] : row[2 * i] << 8 | row[2 * i + 1]))
            return false;
    }
    return true;
}

/* ---- Reading by libpng, which must have nothing to say ---- */

static _Noreturn void failReading(png_structp png, png_const_charp message)
{
    (void)png;
    fail_msg("libpng: %s", message);
    abort();
}

static void assertLibpngReads(const unsigned char *data, size_t length, const Image *image)
{
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, length, file), length);
    rewind(file);
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, failReading, failReading);
    png_infop info = png_create_info_struct(png);
    assert_non_null(info);
    png_init_io(png, file);
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_read_info(png, info);
    assert_int_equal(png_get_image_width(png, info), image->width);
    assert_int_equal(png_get_image_height(png, info), image->height);
    assert_int_equal(png_get_bit_depth(png, info), image->bitDepth);
    size_t rowBytes = png_get_rowbytes(png, info), count = 3 * (size_t)image->width;
    assert_int_equal(rowBytes, count * (size_t)image->bitDepth / 8);
    png_byte *row = malloc(rowBytes);
    assert_non_null(row);
    for (int y = 0; y < image->height; y++) {
        png_read_row(png, row, NULL);
        assert_true(rowHolds(row, image->samples + (size_t)y * count, count, image->bitDepth));
    }
    png_read_end(png, NULL);
    assert_int_equal(fgetc(file), EOF);
    free(row);
    png_destroy_read_struct(&png, &info, NULL);
    fclose(file);
}

/* ---- Reading by hand ---- */

static size_t numberAt(const unsigned char *bytes)
{
    return (size_t)bytes[0] << 24 | (size_t)bytes[1] << 16 | (size_t)bytes[2] << 8 | bytes[3];
}

/* Returns the number of IDAT chunks. */
static int assertStreamHolds(const unsigned char *data, size_t length, const Image *image)
{
    /* Join what is in the IDAT chunks. */
    unsigned char *stream = malloc(length);
    assert_non_null(stream);
    size_t streamLength = 0;
    int chunks = 0;
    for (size_t at = 8; at < length; at += numberAt(data + at) + 12) {
        if (memcmp(data + at + 4, "IDAT", 4) != 0)
            continue;
        memcpy(stream + streamLength, data + at + 8, numberAt(data + at));
        streamLength += numberAt(data + at);
        chunks++;
    }

    /* Decompress; the right length and sum are needed for Z_OK, and all bytes must have been used. */
    size_t count = 3 * (size_t)image->width, sampleBytes = (size_t)image->bitDepth / 8;
    size_t rowBytes = 1 + count * sampleBytes, size = rowBytes * (size_t)image->height;
    unsigned char *rows = malloc(size);
    assert_non_null(rows);
    uLongf unpacked = size;
    uLong used = streamLength;
    assert_int_equal(uncompress2(rows, &unpacked, stream, &used), Z_OK);
    assert_int_equal(unpacked, size);
    assert_int_equal(used, streamLength);

    /* Undo the filter Up: each byte is the sum of this one and the one above it. */
    for (int y = 0; y < image->height; y++) {
        unsigned char *row = rows + (size_t)y * rowBytes;
        assert_int_equal(row[0], 2);
        for (size_t i = 1; i < rowBytes && y > 0; i++)
            row[i] = (unsigned char)(row[i] + row[i - rowBytes]);
        assert_true(rowHolds(row + 1, image->samples + (size_t)y * count, count, image->bitDepth));
    }
    free(rows);
    free(stream);
    return chunks;
}

static void checkPicture(int width, int height, int bitDepth, Content content)
{
    Image image = makeImage(width, height, bitDepth, content);
    unsigned char *data;
    size_t length;
    assertOk(encodePng(&image, 1, &data, &length));
    static const int threads[] = {2, 7, 1};
    for (size_t i = 0; i < sizeof threads / sizeof *threads; i++) {
        unsigned char *again;
        size_t againLength;
        assertOk(encodePng(&image, threads[i], &again, &againLength));
        assert_int_equal(againLength, length);
        assert_memory_equal(again, data, length);
        free(again);
    }
    assertLibpngReads(data, length, &image);
    int chunks = assertStreamHolds(data, length, &image);
    /* Only several bands put several threads to the test. */
    size_t rows = (size_t)height * (size_t)width * 3 * (size_t)bitDepth / 8;
    assert_true(rows < 600000 ? chunks >= 1 : chunks > 1);
    free(data);
    freeImage(&image);
}

static void givesTheSameBytesOnAnyThreads(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1},     {1, 1000},   {1000, 1},   {7, 5},    {333, 257},
                                   {641, 479}, {1, 100003}, {100003, 3}, {65537, 9}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        for (int bitDepth = 8; bitDepth <= 16; bitDepth += 8) {
            for (int content = 0; content < CONTENTS; content++)
                checkPicture(sizes[i][0], sizes[i][1], bitDepth, (Content)content);
        }
    }
}

/* Equal pictures come back equal through readPng, and noise grows by less than a hundredth. */
static void isReadBack(void **state)
{
    (void)state;
    for (int bitDepth = 8; bitDepth <= 16; bitDepth += 8) {
        Image image = makeImage(701, 503, bitDepth, CONTENT_NOISE);
        size_t bytes = 3 * 701 * 503 * (size_t)bitDepth / 8;
        unsigned char *data;
        size_t length;
        assertOk(encodePng(&image, 2, &data, &length));
        assert_in_range(length, bytes / 2, bytes + bytes / 100);
        free(data);
        char path[] = "/tmp/eclairage-bands-XXXXXX";
        int descriptor = mkstemp(path);
        assert_true(descriptor >= 0);
        close(descriptor);
        assertOk(writePng(path, &image, 2));
        Image back;
        assertOk(readPng(path, &back));
        unlink(path);
        assert_memory_equal(back.samples, image.samples, 6 * (size_t)701 * 503);
        freeImage(&back);
        freeImage(&image);
    }
}

/* ---- Cancelling, in a process of its own since the flag is never cleared ---- */

static double processorSeconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Cancels a little later and notes how much processor time had been used. */
static void *cancelSoon(void *argument)
{
    nanosleep(&(struct timespec){.tv_nsec = 30 * 1000 * 1000}, NULL);
    *(double *)argument = processorSeconds();
    requestCancel();
    return NULL;
}

/* Begin to make a large picture's file and cancel. 0 when that was noticed within 100 ms of processor time,
 * which is 50 ms on each of two threads; the whole would take several times as long. A sanitizer marks
 * all that is freed, which takes a while of its own. */
static int cancelLargePicture(bool encode)
{
    static const int width = 12000, height = 9000;
    double limit = getenv("ECLAIRAGE_SANITIZED") != NULL ? 1.0 : 0.1;
    Image image = {0};
    Framebuffer *framebuffer = NULL;
    Status status = statusOk();
    if (encode)
        status = createImage(width, height, 8, ENCODING_SRGB, &image);
    else
        framebuffer = createFramebuffer(width, height);
    if (!statusIsOk(&status) || (!encode && framebuffer == NULL))
        return 77;
    double cancelled = 0;
    pthread_t thread;
    if (pthread_create(&thread, NULL, cancelSoon, &cancelled) != 0)
        return 3;
    unsigned char *data;
    size_t length;
    status = encode ? encodePng(&image, 2, &data, &length)
                    : imageFromFramebuffer(framebuffer, 8, ENCODING_SRGB, 2, &image);
    double noticed = processorSeconds();
    pthread_join(thread, NULL);
    return status.code != STATUS_INTERRUPTED ? 2 : noticed - cancelled > limit ? 1 : 0;
}

static void noticesCancelSoon(void **state)
{
    (void)state;
    fflush(stdout);
    fflush(stderr);
    for (int encode = 0; encode <= 1; encode++) {
        pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0)
            _exit(cancelLargePicture(encode != 0));
        int result;
        assert_int_equal(waitpid(child, &result, 0), child);
        if (WIFEXITED(result) && WEXITSTATUS(result) == 77)
            skip();
        assert_int_equal(result, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(givesTheSameBytesOnAnyThreads),
        cmocka_unit_test(isReadBack),
        cmocka_unit_test(noticesCancelSoon),
    };
    return cmocka_run_group_tests_name("png bands", tests, NULL, NULL);
}
