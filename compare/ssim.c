/* ssim.c - structural similarity of two pictures; see ssim.h.
 *
 * Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli: Image quality assessment: from error visibility
 * to structural similarity. IEEE Transactions on Image Processing 13(4), 2004: equations 13 to 17.
 * The window is a Gaussian, which is a product of one in x and one in y: rows are filtered, then columns.
 * Invariant: equal windows give exactly 1. With x = y the two factors of the numerator and those of the
 * denominator are the same operations on the same values, up to factors of two, which round nothing. And
 * no operation tells x from y, so swapping the pictures changes no bit.
 */
#include "compare/ssim.h"

#include "compare/tiles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    RADIUS = 5,
    WINDOW = 2 * RADIUS + 1,
    TILE_WIDTH = 128, /* windows; a multiple of LANES */
    TILE_HEIGHT = 64,
    LUMA_WIDTH = TILE_WIDTH + 2 * RADIUS,
    LUMA_HEIGHT = TILE_HEIGHT + 2 * RADIUS,
    LANES = 2,
    MOMENTS = 4
};

static const double SIGMA = 1.5;                        /* pixels */
static const double C1 = 0.01 * 0.01, C2 = 0.03 * 0.03; /* (K1 L)^2 and (K2 L)^2, with L = 1 */

/* Numbers side by side, in 16 bytes, which every x86-64 and aarch64 has. */
typedef double Doubles __attribute__((vector_size(LANES * sizeof(double))));

typedef struct SsimContext {
    const Image *a, *b;
    const double *encoded;      /* for each sample value, the sRGB encoding in 0..1 */
    double weights[RADIUS + 1]; /* of the window in one dimension, from its middle outwards */
} SsimContext;

typedef struct SsimScratch {
    double luma[2][LUMA_HEIGHT][LUMA_WIDTH];
    /* Filtered along rows: x, y, x x + y y, x y. */
    double moments[MOMENTS][LUMA_HEIGHT][TILE_WIDTH];
} SsimScratch;

static inline Doubles loadDoubles(const double *from)
{
    Doubles value;
    memcpy(&value, from, sizeof value);
    return value;
}

static inline void storeDoubles(double *to, Doubles value)
{
    memcpy(to, &value, sizeof value);
}

/* Y = 0.299 R + 0.587 G + 0.114 B of the sRGB encodings, for the tile's windows; the rest of each row is
 * zero, so that whole vectors can be worked on. */
static void loadLuma(const SsimContext *context, const Image *image, const Tile *tile,
                     double luma[LUMA_HEIGHT][LUMA_WIDTH])
{
    for (int y = 0; y < tile->height + 2 * RADIUS; y++) {
        size_t start = (size_t)(tile->y + y) * (size_t)image->width + (size_t)tile->x;
        const uint16_t *samples = image->samples + 3 * start;
        int width = tile->width + 2 * RADIUS;
        for (int x = 0; x < width; x++, samples += 3)
            luma[y][x] = 0.299 * context->encoded[samples[0]] + 0.587 * context->encoded[samples[1]] +
                         0.114 * context->encoded[samples[2]];
        for (int x = width; x < LUMA_WIDTH; x++)
            luma[y][x] = 0;
    }
}

/* Filter one row: the weighted means along x of x, y, x x + y y and x y. */
static void filterRow(const double weights[RADIUS + 1], const double *a, const double *b, int width,
                      double *moments[MOMENTS])
{
    for (int x = 0; x < width; x += LANES) {
        Doubles sums[MOMENTS] = {{0}};
        for (int k = 0; k < WINDOW; k++) {
            double weight = weights[k < RADIUS ? RADIUS - k : k - RADIUS];
            Doubles p = loadDoubles(a + x + k), q = loadDoubles(b + x + k);
            sums[0] += weight * p;
            sums[1] += weight * q;
            sums[2] += weight * (p * p + q * q);
            sums[3] += weight * (p * q);
        }
        for (int m = 0; m < MOMENTS; m++)
            storeDoubles(moments[m] + x, sums[m]);
    }
}

/* The weighted mean along y of one moment, for LANES columns; top is the window's first row. */
static inline Doubles filterColumn(const double weights[RADIUS + 1], const double *top)
{
    Doubles sum = weights[0] * loadDoubles(top + RADIUS * TILE_WIDTH);
    for (int k = 1; k <= RADIUS; k++)
        sum += weights[k] *
               (loadDoubles(top + (RADIUS - k) * TILE_WIDTH) + loadDoubles(top + (RADIUS + k) * TILE_WIDTH));
    return sum;
}

/* The sum of SSIM over the windows whose first pixels are the tile. */
static double ssimOfTile(const void *argument, const Tile *tile, void *memory)
{
    const SsimContext *context = argument;
    SsimScratch *scratch = memory;
    /* Skip what is equal: each window would give exactly 1. */
    Tile covered = {tile->x, tile->y, tile->width + 2 * RADIUS, tile->height + 2 * RADIUS};
    if (tilesEqual(context->a, context->b, &covered, 0))
        return (double)tile->width * (double)tile->height;

    loadLuma(context, context->a, tile, scratch->luma[0]);
    loadLuma(context, context->b, tile, scratch->luma[1]);
    for (int y = 0; y < tile->height + 2 * RADIUS; y++) {
        double *rows[MOMENTS];
        for (int m = 0; m < MOMENTS; m++)
            rows[m] = scratch->moments[m][y];
        filterRow(context->weights, scratch->luma[0][y], scratch->luma[1][y], tile->width, rows);
    }
    double sum = 0;
    for (int y = 0; y < tile->height; y++) {
        double row[TILE_WIDTH];
        for (int x = 0; x < tile->width; x += LANES) {
            Doubles meanA = filterColumn(context->weights, &scratch->moments[0][y][x]);
            Doubles meanB = filterColumn(context->weights, &scratch->moments[1][y][x]);
            Doubles squares = filterColumn(context->weights, &scratch->moments[2][y][x]);
            Doubles product = filterColumn(context->weights, &scratch->moments[3][y][x]);
            /* Combine by equation 13: (2 mx my + C1)(2 sxy + C2) / ((mx^2 + my^2 + C1)(sx^2 + sy^2 + C2)),
             * where sx^2 = E[x x] - mx^2 and sxy = E[x y] - mx my. Luma lies in 0..1, so the subtraction
             * errs by about 1e-16, far below C2. */
            Doubles meanProduct = 2 * (meanA * meanB);
            Doubles meanSquares = meanA * meanA + meanB * meanB;
            Doubles ssim = ((meanProduct + C1) * (2 * product - meanProduct + C2)) /
                           ((meanSquares + C1) * (squares - meanSquares + C2));
            storeDoubles(row + x, ssim);
        }
        for (int x = 0; x < tile->width; x++)
            sum += row[x];
    }
    return sum;
}

/* For each sample value the sRGB encoding in 0..1, without rounding to bits; NULL when memory runs out. */
static double *encodeSamples(const Image *image)
{
    unsigned largest = imageMaxSample(image);
    double *encoded = malloc(((size_t)largest + 1) * sizeof *encoded);
    for (unsigned i = 0; encoded != NULL && i <= largest; i++) {
        double value = (double)i / (double)largest;
        if (image->encoding == ENCODING_LINEAR)
            value = value <= 0.0031308 ? 12.92 * value : 1.055 * pow(value, 1 / 2.4) - 0.055;
        encoded[i] = value;
    }
    return encoded;
}

Status measureSsim(const Image *a, const Image *b, int threads, double *ssim)
{
    if (a->width < WINDOW || a->height < WINDOW) {
        *ssim = NAN;
        return statusOk();
    }
    double *encoded = encodeSamples(a);
    if (encoded == NULL)
        return statusOutOfMemory();
    SsimContext context = {.a = a, .b = b, .encoded = encoded};
    double total = 0;
    for (int k = 0; k <= RADIUS; k++) {
        context.weights[k] = exp(-k * k / (2 * SIGMA * SIGMA));
        total += k == 0 ? context.weights[k] : 2 * context.weights[k];
    }
    for (int k = 0; k <= RADIUS; k++)
        context.weights[k] /= total;

    /* Take the mean over all windows (equation 17). */
    int columns = a->width - 2 * RADIUS, rows = a->height - 2 * RADIUS;
    TileSum what = {columns, rows, TILE_WIDTH, TILE_HEIGHT, sizeof(SsimScratch), ssimOfTile, &context};
    double sum = 0;
    Status status = sumTiles(&what, threads, &sum);
    if (statusIsOk(&status))
        *ssim = sum / ((double)columns * (double)rows);
    free(encoded);
    return status;
}
