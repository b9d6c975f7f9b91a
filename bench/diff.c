/* diff.c - time the metrics on a pair of 1920x1080 pictures, part by part.
 *
 * Usage: diff FOLDER. Writes the pairs it measured to FOLDER (a.png, different.png, near.png, 8-bit sRGB)
 * and prints the least time of several runs of each part, on one thread and on all. Built and run by
 * diff.sh.
 */
#include "base/threads.h"
#include "compare/difference.h"
#include "compare/flip.h"
#include "compare/metrics.h"
#include "compare/ssim.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum {
    WIDTH = 1920,
    HEIGHT = 1080,
    RUNS = 5
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
        fprintf(stderr, "bench/diff: %s\n", status.message);
        exit(1);
    }
}

/* Rings and slopes as in a rendered picture; noise in 0..1 is the share of samples that are one off. */
static Image makePicture(double noise)
{
    Image image;
    stopOnError(createImage(WIDTH, HEIGHT, 8, ENCODING_SRGB, &image));
    unsigned state = 1;
    uint16_t *sample = image.samples;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            double ring = sin(hypot(x - 700.0, y - 500.0) / 60);
            double shade[3] = {0.5 + 0.4 * ring, (double)x / WIDTH, (double)y / HEIGHT};
            for (int channel = 0; channel < 3; channel++, sample++) {
                state = state * 1664525u + 1013904223u;
                *sample = (uint16_t)(1 + 253 * shade[channel]);
                if (state < noise * 0x1p32)
                    *sample = (uint16_t)(*sample + 1);
            }
        }
    }
    return image;
}

typedef enum Part {
    PART_ALL,
    PART_SSIM,
    PART_FLIP,
    PART_PICTURE,
    PARTS
} Part;

static double timePart(Part part, const Image *a, const Image *b, int threads)
{
    double least = INFINITY, value;
    for (int run = 0; run < RUNS; run++) {
        Metrics metrics;
        Image difference = {0};
        double start = secondsNow();
        if (part == PART_ALL)
            stopOnError(measureImages(a, b, 0.004, threads, &metrics));
        else if (part == PART_SSIM)
            stopOnError(measureSsim(a, b, threads, &value));
        else if (part == PART_FLIP)
            stopOnError(measureFlip(a, b, threads, &value));
        else
            stopOnError(differencePicture(a, b, &difference));
        least = fmin(least, secondsNow() - start);
        freeImage(&difference);
    }
    return least;
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: diff FOLDER\n");
        return 2;
    }
    static const char *const names[PARTS] = {"all metrics", "  SSIM alone", "  FLIP alone",
                                             "difference picture"};
    Image a = makePicture(0);
    struct {
        const char *name;
        Image image;
    } others[] = {{"different", makePicture(0.5)}, {"near", makePicture(1e-6)}};
    int all = availableProcessors();
    char path[4096];
    snprintf(path, sizeof path, "%s/a.png", argv[1]);
    stopOnError(writePng(path, &a, 1));
    printf("%-32s %10s %10s\n", "1920x1080, 8 bit, milliseconds", "1 thread", "all");
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/%s.png", argv[1], others[i].name);
        stopOnError(writePng(path, &others[i].image, 1));
        for (int part = 0; part < PARTS; part++) {
            double one = timePart((Part)part, &a, &others[i].image, 1);
            double many = timePart((Part)part, &a, &others[i].image, all);
            printf("%-12s%-20s %10.1f %10.1f\n", others[i].name, names[part], 1e3 * one, 1e3 * many);
        }
        freeImage(&others[i].image);
    }
    freeImage(&a);
    return 0;
}
