/* noise.c - copy a PNG and add noise of a given strength to it.
 *
 *     cc -O2 -o noise notes/experiments/noise.c -lpng -lm && ./noise in.png out.png 0.01
 *
 * Each sample gets a random number added, of the root mean square given, in 0..1. The random numbers are
 * always the same. What leaves 0..255 is cut off, which takes away a little of the strength; so the noise is
 * made stronger, step by step, until the root mean square that is measured is the one asked for.
 */
#include <math.h>
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* -1 .. 1, all alike likely (a linear congruential generator; Knuth's MMIX constants). */
static double nextRandom(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / (double)(1ull << 52) - 1;
}

/* Add noise of this amplitude; return the root mean square that came of it, in 0..1. */
static double addNoise(const png_byte *from, png_byte *to, size_t count, double amplitude)
{
    uint64_t state = 1;
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        double value = from[i] + 255 * amplitude * nextRandom(&state);
        to[i] = (png_byte)(value < 0 ? 0 : value > 255 ? 255 : floor(value + 0.5));
        sum += pow((to[i] - from[i]) / 255.0, 2);
    }
    return sqrt(sum / (double)count);
}

int main(int argc, char **argv)
{
    double wanted = argc == 4 ? atof(argv[3]) : 0;
    if (!(wanted > 0 && wanted < 0.3)) {
        fprintf(stderr, "usage: noise IN.png OUT.png RMSE, which is above 0 and below 0.3\n");
        return 2;
    }
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&image, argv[1])) {
        fprintf(stderr, "noise: %s: %s\n", argv[1], image.message);
        return 4;
    }
    image.format = PNG_FORMAT_RGB;
    size_t count = PNG_IMAGE_SIZE(image);
    png_byte *from = malloc(count), *to = malloc(count);
    if (from == NULL || to == NULL || !png_image_finish_read(&image, NULL, from, 0, NULL)) {
        fprintf(stderr, "noise: %s cannot be read\n", argv[1]);
        return 4;
    }

    /* Halve the interval that the amplitude lies in. */
    double low = 0, high = 4;
    for (int step = 0; step < 40; step++) {
        double middle = (low + high) / 2;
        if (addNoise(from, to, count, middle) < wanted)
            low = middle;
        else
            high = middle;
    }
    addNoise(from, to, count, high);
    if (!png_image_write_to_file(&image, argv[2], 0, to, 0, NULL)) {
        fprintf(stderr, "noise: %s: %s\n", argv[2], image.message);
        return 4;
    }
    free(from);
    free(to);
    return 0;
}
