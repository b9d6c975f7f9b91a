/* same_picture.c - says in how many pixels a peer's picture differs from ours, so that none wins by drawing
 * less.
 *
 *   same_picture OURS.png PEER.pgm|PEER.ppm
 *
 * Both are linear; the peer's has 8 or 16 bits a sample. A grey picture is compared with our red channel,
 * which the benchmark scenes make equal to it (make_peer_scene.py). A pixel is off when a channel differs by
 * more than 2/255: the quantisation of both is below that, a shadow or an edge on another side is not. Prints
 * JSON.
 */
#include "image/image.h"

#include <stdio.h>
#include <stdlib.h>

static const double tolerance = 2.0 / 255;

static void stop(const char *file, const char *message)
{
    fprintf(stderr, "same_picture: %s: %s\n", file, message);
    exit(1);
}

/* A binary PNM file: its sample of (pixel, channel) is in 0..1. */
typedef struct Pnm {
    int width, height, channels, maxSample;
    unsigned char *bytes; /* from the first sample to the end of the file; owned */
} Pnm;

static Pnm readPnm(const char *path)
{
    Pnm picture = {0};
    FILE *in = fopen(path, "rb");
    if (!in)
        stop(path, "cannot be opened");
    char kind;
    if (fscanf(in, "P%c", &kind) != 1 || (kind != '5' && kind != '6'))
        stop(path, "is not a binary PGM or PPM file");

    /* Read the three numbers of the header, over comments; one white space ends the last. */
    int *header[] = {&picture.width, &picture.height, &picture.maxSample};
    for (int i = 0; i < 3; i++) {
        int skipped = 0;
        while (fscanf(in, " #%*[^\n]%n", &skipped) != EOF && skipped > 0)
            skipped = 0;
        if (fscanf(in, "%d", header[i]) != 1 || *header[i] < 1 || *header[i] > 65535)
            stop(path, "has a broken header");
    }
    fgetc(in);
    picture.channels = kind == '5' ? 1 : 3;
    size_t length = (size_t)picture.width * (size_t)picture.height * (size_t)picture.channels;
    length *= picture.maxSample > 255 ? 2 : 1;
    picture.bytes = malloc(length);
    if (!picture.bytes || fread(picture.bytes, 1, length, in) != length)
        stop(path, "is shorter than its header says");
    fclose(in);
    return picture;
}

static double pnmSample(const Pnm *picture, size_t pixel, int channel)
{
    size_t at = pixel * (size_t)picture->channels + (size_t)channel;
    const unsigned char *bytes = picture->bytes;
    int sample = picture->maxSample > 255 ? bytes[2 * at] << 8 | bytes[2 * at + 1] : bytes[at];
    return (double)sample / picture->maxSample;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "Usage: same_picture OURS.png PEER.pgm|PEER.ppm\n");
        return 2;
    }
    Image ours;
    Status status = readPng(argv[1], &ours);
    if (!statusIsOk(&status))
        stop(argv[1], status.message);
    if (ours.encoding != ENCODING_LINEAR)
        stop(argv[1], "is not linear");
    Pnm peer = readPnm(argv[2]);
    if (peer.width != ours.width || peer.height != ours.height)
        stop(argv[2], "has another size than ours");

    size_t pixels = (size_t)ours.width * (size_t)ours.height, off = 0, lit = 0;
    double largest = 0;
    for (size_t pixel = 0; pixel < pixels; pixel++) {
        double furthest = 0;
        bool isLit = false;
        for (int channel = 0; channel < peer.channels; channel++) {
            double theirs = pnmSample(&peer, pixel, channel);
            double difference =
                (double)ours.samples[3 * pixel + (size_t)channel] / imageMaxSample(&ours) - theirs;
            furthest = difference > furthest ? difference : -difference > furthest ? -difference : furthest;
            isLit |= theirs > 0;
        }
        off += furthest > tolerance;
        lit += isLit;
        largest = furthest > largest ? furthest : largest;
    }
    printf("{\"pixels\": %zu, \"lit\": %zu, \"off\": %zu, \"largest\": %.6f}\n", pixels, lit, off, largest);
    free(peer.bytes);
    freeImage(&ours);
    return 0;
}
