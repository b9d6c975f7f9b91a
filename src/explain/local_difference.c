/* local_difference.c - see local_difference.h. */
#include "explain/local_difference.h"

#include "explain/sample_rounding.h"

#include <math.h>
#include <stdlib.h>

/* Of the picture, the part may be no more than this share, and no fewer than some pixels. */
static const double LARGEST_PART = 0.6;
enum {
    FEWEST_PIXELS = 25
};

/* What counts as a difference in linear light, and what as an edge: as a share of the largest difference. */
static const float SLIGHTEST = 0.004f;
static const float EDGE_SHARE = 0.2f;

/* Both pictures as linear light, and where they differ. */
typedef struct Pair {
    int width, height;
    Color3f *bright, *dark; /* the one that is brighter in the part, and the other */
    unsigned char *isPart;
} Pair;

static void readLinear(const Image *image, Color3f *pixels)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++)
        pixels[i] = createColor(sampleAsLight(image, 3 * i), sampleAsLight(image, 3 * i + 1),
                                sampleAsLight(image, 3 * i + 2));
}

static float sumOf(Color3f c)
{
    return c.r + c.g + c.b;
}

static float differenceAt(const Pair *pair, size_t i)
{
    return sumOf(pair->bright[i]) - sumOf(pair->dark[i]);
}

/* Mark where the two differ; false unless it is one part of the picture and nearly all of it of one sign.
 * Puts the brighter one into bright. */
static bool markPart(Pair *pair, bool *mineIsBrighter)
{
    size_t count = (size_t)pair->width * (size_t)pair->height, brighter = 0, darker = 0;
    for (size_t i = 0; i < count; i++) {
        Color3f a = pair->bright[i], b = pair->dark[i];
        float most = fmaxf(fabsf(a.r - b.r), fmaxf(fabsf(a.g - b.g), fabsf(a.b - b.b)));
        pair->isPart[i] = most > SLIGHTEST;
        if (pair->isPart[i] != 0) {
            brighter += differenceAt(pair, i) > 0;
            darker += differenceAt(pair, i) < 0;
        }
    }
    size_t part = brighter + darker, fewer = brighter < darker ? brighter : darker;
    if (part < FEWEST_PIXELS || (double)part > LARGEST_PART * (double)count || fewer * 50 > part)
        return false;
    *mineIsBrighter = brighter > darker;
    if (darker > brighter) {
        Color3f *mine = pair->bright;
        pair->bright = pair->dark;
        pair->dark = mine;
    }
    return true;
}

/* What the border of the part is like. */
typedef struct Border {
    size_t pixels;     /* pairs of neighbours, one in the part and one not */
    size_t sharp;      /* where the difference does not fade out */
    size_t onlyInDark; /* of those: where the darker picture has an edge and the brighter one none */
} Border;

static void countBorder(const Pair *pair, size_t in, size_t out, float edge, Border *border)
{
    border->pixels++;
    if (differenceAt(pair, in) < edge)
        return;
    border->sharp++;
    float stepInBright = fabsf(sumOf(pair->bright[in]) - sumOf(pair->bright[out]));
    float stepInDark = fabsf(sumOf(pair->dark[in]) - sumOf(pair->dark[out]));
    border->onlyInDark += stepInBright < 0.35f * stepInDark;
}

static Border lookAtBorder(const Pair *pair, float edge)
{
    Border border = {0};
    for (int y = 0; y < pair->height; y++) {
        for (int x = 0; x < pair->width; x++) {
            size_t here = (size_t)y * (size_t)pair->width + (size_t)x;
            size_t neighbours[2] = {here + 1, here + (size_t)pair->width};
            bool exists[2] = {x + 1 < pair->width, y + 1 < pair->height};
            for (int k = 0; k < 2; k++) {
                if (!exists[k] || pair->isPart[here] == pair->isPart[neighbours[k]])
                    continue;
                size_t in = pair->isPart[here] != 0 ? here : neighbours[k];
                countBorder(pair, in, in == here ? neighbours[k] : here, edge, &border);
            }
        }
    }
    return border;
}

/* Whether the difference has one hue; saturated pixels say nothing. */
static bool hasOneHue(const Pair *pair, float edge)
{
    size_t count = (size_t)pair->width * (size_t)pair->height, looked = 0, alike = 0;
    double mean[3] = {0, 0, 0};
    for (int pass = 0; pass < 2; pass++) {
        double length = sqrt(mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]);
        for (size_t i = 0; i < count; i++) {
            Color3f a = pair->bright[i], b = pair->dark[i];
            if (pair->isPart[i] == 0 || differenceAt(pair, i) < edge || fmaxf(a.r, fmaxf(a.g, a.b)) >= 1)
                continue;
            double d[3] = {(double)(a.r - b.r), (double)(a.g - b.g), (double)(a.b - b.b)};
            double own = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            double along = d[0] * mean[0] + d[1] * mean[1] + d[2] * mean[2];
            if (pass == 1) {
                looked++;
                alike += along > 0.97 * own * length;
            }
            for (int c = 0; c < 3 && pass == 0; c++)
                mean[c] += d[c];
        }
    }
    return looked > 0 && alike * 10 >= looked * 9;
}

/* Whether the difference is largest where the brighter picture is: a whole highlight, and not its rim. */
static bool peaksWithHighlight(const Pair *pair, float largest)
{
    size_t count = (size_t)pair->width * (size_t)pair->height, brightest = 0;
    float most = -1;
    for (size_t i = 0; i < count; i++) {
        if (pair->isPart[i] != 0 && sumOf(pair->bright[i]) > most) {
            most = sumOf(pair->bright[i]);
            brightest = i;
        }
    }
    return differenceAt(pair, brightest) > 0.6f * largest;
}

/* How much two neighbours differ, whatever the light on both. */
static double contrastBetween(const Color3f *pixels, size_t a, size_t b)
{
    const double dark = 0.02; /* below that, nothing is seen */
    return fabs(log((dark + (double)sumOf(pixels[a])) / (dark + (double)sumOf(pixels[b]))));
}

/* Which of the pictures has edges that the other one has not, in the part and at its border: from -1, all in
 * the brighter one, as with a highlight, to 1, all in the darker one, as with a shadow. The edges of the
 * objects and of their patterns are in both. */
static double contrastOfDark(const Pair *pair)
{
    double inBright = 0, inDark = 0;
    for (int y = 0; y + 1 < pair->height; y++) {
        for (int x = 0; x + 1 < pair->width; x++) {
            size_t here = (size_t)y * (size_t)pair->width + (size_t)x;
            size_t neighbours[2] = {here + 1, here + (size_t)pair->width};
            for (int k = 0; k < 2; k++) {
                if (pair->isPart[here] == 0 && pair->isPart[neighbours[k]] == 0)
                    continue;
                inBright += contrastBetween(pair->bright, here, neighbours[k]);
                inDark += contrastBetween(pair->dark, here, neighbours[k]);
            }
        }
    }
    return inBright + inDark > 0 ? (inDark - inBright) / (inDark + inBright) : 0;
}

static Cause causeOfPart(const Pair *pair)
{
    size_t count = (size_t)pair->width * (size_t)pair->height;
    float largest = 0;
    for (size_t i = 0; i < count; i++)
        largest = pair->isPart[i] != 0 ? fmaxf(largest, differenceAt(pair, i)) : largest;
    float edge = EDGE_SHARE * largest;
    Border border = lookAtBorder(pair, edge);
    double contrast = contrastOfDark(pair);
    /* What is another object has an outline. So a soft border is that of a soft shadow or a highlight, and a
     * sharp one that of a shadow where the brighter picture shows nothing. */
    bool isSharp = border.sharp * 3 > border.pixels;
    if (contrast > 0.07 && (!isSharp || border.onlyInDark * 10 > border.sharp * 4))
        return CAUSE_SHADOW;
    /* Highlights of several lamps have several hues; then the border must be without any edge. */
    size_t edgesAllowed = hasOneHue(pair, edge) ? border.pixels / 6 : border.pixels / 20;
    if (border.sharp > edgesAllowed || contrast > 0)
        return CAUSE_UNKNOWN;
    return contrast < -0.17 || peaksWithHighlight(pair, largest) ? CAUSE_SPECULAR : CAUSE_SHININESS;
}

Status findLocalDifference(const Image *mine, const Image *other, LocalDifference *found)
{
    size_t count = (size_t)mine->width * (size_t)mine->height;
    Color3f *pixels = malloc(2 * count * sizeof *pixels);
    unsigned char *isPart = malloc(count);
    if (pixels == NULL || isPart == NULL) {
        free(pixels);
        free(isPart);
        return statusOutOfMemory();
    }
    readLinear(mine, pixels);
    readLinear(other, pixels + count);
    Pair pair = {mine->width, mine->height, pixels, pixels + count, isPart};
    *found = (LocalDifference){.cause = CAUSE_UNKNOWN};
    if (markPart(&pair, &found->mineIsBrighter))
        found->cause = causeOfPart(&pair);
    free(pixels);
    free(isPart);
    return statusOk();
}
