/* png.c - time the way from a framebuffer to a PNG file at the picture's own size.
 *
 * Usage: png PICTURE.png FOLDER. Takes the picture, which should be 16 bits and linear, as a framebuffer, and
 * prints for each kind of file the least time of several runs of the conversion, of the encoding and of
 * all with writing to FOLDER, on one thread and on two, and the file's size. Built and run by png.sh.
 */
#include "image/image.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum {
    RUNS = 9
};

static double secondsNow(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void stopOnError(Status status)
{
    if (!statusIsOk(&status)) {
        fprintf(stderr, "bench/png: %s\n", status.message);
        exit(1);
    }
}

static Framebuffer *readFramebuffer(const char *path)
{
    Image image;
    stopOnError(readPng(path, &image));
    Framebuffer *framebuffer = createFramebuffer(image.width, image.height);
    if (framebuffer == NULL)
        stopOnError(statusOutOfMemory());
    float largest = (float)imageMaxSample(&image);
    for (size_t i = 0; i < (size_t)image.width * (size_t)image.height; i++) {
        const uint16_t *sample = image.samples + 3 * i;
        framebuffer->pixels[i] =
            createColor((float)sample[0] / largest, (float)sample[1] / largest, (float)sample[2] / largest);
    }
    freeImage(&image);
    return framebuffer;
}

typedef struct Times {
    double convert, encode, all; /* seconds */
    size_t size;
} Times;

static Times timeFile(const Framebuffer *framebuffer, int bitDepth, Encoding encoding, int threads,
                      const char *path)
{
    Times least = {INFINITY, INFINITY, INFINITY, 0};
    for (int run = 0; run < RUNS; run++) {
        Image image;
        unsigned char *data;
        double start = secondsNow();
        stopOnError(imageFromFramebuffer(framebuffer, bitDepth, encoding, threads, &image));
        double converted = secondsNow();
        stopOnError(encodePng(&image, threads, &data, &least.size));
        double encoded = secondsNow();
        free(data);
        freeImage(&image);
        least.convert = fmin(least.convert, converted - start);
        least.encode = fmin(least.encode, encoded - converted);

        start = secondsNow();
        stopOnError(imageFromFramebuffer(framebuffer, bitDepth, encoding, threads, &image));
        stopOnError(writePng(path, &image, threads));
        freeImage(&image);
        least.all = fmin(least.all, secondsNow() - start);
    }
    return least;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: png PICTURE.png FOLDER\n");
        return 2;
    }
    Framebuffer *framebuffer = readFramebuffer(argv[1]);
    char path[4096];
    snprintf(path, sizeof path, "%s/written.png", argv[2]);
    static const struct {
        int bitDepth;
        Encoding encoding;
        const char *name;
    } kinds[] = {{8, ENCODING_SRGB, "8 bit, sRGB"},
                 {8, ENCODING_LINEAR, "8 bit, linear"},
                 {16, ENCODING_SRGB, "16 bit, sRGB"},
                 {16, ENCODING_LINEAR, "16 bit, linear"}};
    printf("%4d x %d, milliseconds   threads   convert    encode  all, to a file       bytes\n",
           framebuffer->width, framebuffer->height);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        for (int threads = 1; threads <= 2; threads++) {
            Times times = timeFile(framebuffer, kinds[i].bitDepth, kinds[i].encoding, threads, path);
            printf("%-27s %6d %9.1f %9.1f %15.1f %11zu\n", kinds[i].name, threads, 1e3 * times.convert,
                   1e3 * times.encode, 1e3 * times.all, times.size);
        }
    }
    freeFramebuffer(framebuffer);
    return 0;
}
