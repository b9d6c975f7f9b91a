/* flip.c - the difference a person sees when flipping between two pictures; see flip.h.
 *
 * P. Andersson, J. Nilsson, T. Akenine-Moller, M. Oskarsson, K. Astrom, M. D. Fairchild: FLIP: A
 * Difference Evaluator for Alternating Images. Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020.
 * Two pipelines (figure 5 there): colour blurs both pictures as the eye does at the viewing distance and
 * takes a colour distance; features finds edges and points that only one of them has. Their combination
 * is a number from 0 to 1 for each pixel; FLIP is its mean.
 * Invariant: a pixel whose neighbourhoods are equal gives exactly 0, since both go through the same
 * operations. All filters are products (or a sum of two products) of one in x and one in y; each tile
 * is filtered along its rows and then along its columns, in memory that stays in the cache.
 */
#include "compare/flip.h"

#include "compare/lanes.h"
#include "compare/tiles.h"

#include <math.h>
#include <stdlib.h>

enum {
    COLOR_RADIUS = 10,  /* pixels; 3 standard deviations of the widest filter, as in the paper */
    NARROW_RADIUS = 6,  /* of achromatic and red-green: all further weights sum to under 2^-24 */
    FEATURE_RADIUS = 9, /* 3 standard deviations */
    MARGIN = COLOR_RADIUS,
    TILE_WIDTH = 128, /* a multiple of LANES */
    TILE_HEIGHT = 64,
    SOURCE_WIDTH = TILE_WIDTH + 2 * MARGIN,
    SOURCE_HEIGHT = TILE_HEIGHT + 2 * MARGIN,
    SOURCE_STRIDE = (SOURCE_WIDTH + LANES - 1) / LANES * LANES
};

/* What is kept of a row after filtering along x, by the filter that it went through. */
enum {
    ROW_LUMA,   /* achromatic */
    ROW_RED,    /* red-green */
    ROW_BLUE_1, /* blue-yellow, the filter's two products */
    ROW_BLUE_2,
    ROW_GAUSS, /* achromatic, through the feature detectors' Gaussian */
    ROW_EDGE,  /* its first derivative */
    ROW_POINT, /* its second */
    ROWS
};

/* Section 5 of the paper: where the viewer sits, and how the two pipelines are weighed. */
static const double VIEWING_DISTANCE = 0.7, MONITOR_WIDTH = 0.7; /* metres */
static const double MONITOR_PIXELS = 3840;
static const double COLOR_EXPONENT = 0.7;    /* q_c */
static const double COLOR_KNEE = 0.4;        /* p_c: of the largest distance */
static const double COLOR_KNEE_VALUE = 0.95; /* p_t: what is made of it */
static const double FEATURE_WIDTH = 0.082;   /* w, degrees */
/* The feature exponent q_f is 0.5: a square root. */

/* Contrast sensitivity as a sum of Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees (table 1). */
static const double LUMA_B = 0.0047, RED_B = 0.0053;
static const double BLUE_A1 = 34.1, BLUE_B1 = 0.04, BLUE_A2 = 13.5, BLUE_B2 = 0.025;

/* XYZ from linear RGB with the primaries of sRGB and D65 white (IEC 61966-2-1), rows X, Y, Z. */
static const double XYZ_FROM_RGB[3][3] = {
    {10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0},
};

typedef struct Matrix {
    float m[3][3];
} Matrix;

/* Everything that does not depend on a pixel. Weights are from the filter's middle outwards. */
typedef struct FlipContext {
    const Image *a, *b;
    const float *linear; /* for each sample value, the linear value in 0..1 */
    Matrix opponentFromRgb, rgbFromOpponent, relativeXyzFromRgb;
    float luma[NARROW_RADIUS + 1], red[NARROW_RADIUS + 1];
    float blue1[COLOR_RADIUS + 1], blue2[COLOR_RADIUS + 1];
    float gauss[FEATURE_RADIUS + 1], edge[FEATURE_RADIUS + 1], point[FEATURE_RADIUS + 1];
    float knee;                   /* the colour distance, to its exponent, where the slope changes */
    float slopeBelow, slopeAbove; /* of the curve that brings it to 0..1 */
} FlipContext;

/* What comes of one picture at each pixel: Hunt-adjusted CIELab, and the strength of edges and points. */
enum {
    SEEN_L,
    SEEN_A,
    SEEN_B,
    SEEN_EDGE,
    SEEN_POINT,
    SEEN
};

typedef struct FlipScratch {
    float source[3][SOURCE_HEIGHT][SOURCE_STRIDE]; /* opponent colours, margin included */
    float rows[ROWS][SOURCE_HEIGHT][TILE_WIDTH];   /* filtered along x */
    float seen[2][SEEN][TILE_HEIGHT][TILE_WIDTH];  /* of each picture */
} FlipScratch;

/* Set out[i] to row i of the matrix times (r, g, b). */
LANES_INLINE void transformLanes(const Matrix *matrix, Lanes r, Lanes g, Lanes b, Lanes out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = matrix->m[i][0] * r + matrix->m[i][1] * g + matrix->m[i][2] * b;
}

/* Bring the tile and its margin into opponent colours: the paper's YCxCz without its factors and its
 * offset, (Y/Yn, X/Xn - Y/Yn, Y/Yn - Z/Zn), since filters that sum to 1 would carry them along. */
LANES_INLINE void loadOpponent(const FlipContext *context, const Image *image, const Tile *tile,
                               FlipScratch *scratch)
{
    /* Repeat the border pixels beyond the border. */
    int columns[SOURCE_WIDTH];
    for (int x = 0; x < SOURCE_WIDTH; x++) {
        int from = tile->x + x - MARGIN;
        columns[x] = 3 * (from < 0 ? 0 : from < image->width ? from : image->width - 1);
    }
    float linear[3][SOURCE_STRIDE] = {{0}};
    for (int y = 0; y < tile->height + 2 * MARGIN; y++) {
        int from = tile->y + y - MARGIN;
        from = from < 0 ? 0 : from < image->height ? from : image->height - 1;
        const uint16_t *row = image->samples + 3 * (size_t)from * (size_t)image->width;
        for (int x = 0; x < SOURCE_WIDTH; x++) {
            const uint16_t *samples = row + columns[x];
            linear[0][x] = context->linear[samples[0]];
            linear[1][x] = context->linear[samples[1]];
            linear[2][x] = context->linear[samples[2]];
        }
        for (int x = 0; x < SOURCE_STRIDE; x += LANES) {
            Lanes opponent[3];
            transformLanes(&context->opponentFromRgb, loadLanes(linear[0] + x), loadLanes(linear[1] + x),
                           loadLanes(linear[2] + x), opponent);
            for (int i = 0; i < 3; i++)
                storeLanes(&scratch->source[i][y][x], opponent[i]);
        }
    }
}

/* A symmetric filter at LANES places; step is the distance from one tap to the next. */
LANES_INLINE Lanes filterLanes(const float *weights, int radius, const float *middle, int step)
{
    Lanes sum = weights[0] * loadLanes(middle);
    for (int k = 1; k <= radius; k++)
        sum += weights[k] * (loadLanes(middle - k * step) + loadLanes(middle + k * step));
    return sum;
}

/* Filter the rows of the loaded picture along x with all filters. */
LANES_INLINE void filterRows(const FlipContext *context, FlipScratch *scratch, int width, int height)
{
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x += LANES) {
            const float *luma = &scratch->source[0][y][x + MARGIN];
            const float *red = &scratch->source[1][y][x + MARGIN];
            const float *blue = &scratch->source[2][y][x + MARGIN];
            /* Blur the opponent colours by the eye's contrast sensitivity. */
            storeLanes(&scratch->rows[ROW_LUMA][y][x], filterLanes(context->luma, NARROW_RADIUS, luma, 1));
            storeLanes(&scratch->rows[ROW_RED][y][x], filterLanes(context->red, NARROW_RADIUS, red, 1));
            Lanes blue1 = context->blue1[0] * loadLanes(blue), blue2 = context->blue2[0] * loadLanes(blue);
            for (int k = 1; k <= COLOR_RADIUS; k++) {
                Lanes pair = loadLanes(blue - k) + loadLanes(blue + k);
                blue1 += context->blue1[k] * pair;
                blue2 += context->blue2[k] * pair;
            }
            storeLanes(&scratch->rows[ROW_BLUE_1][y][x], blue1);
            storeLanes(&scratch->rows[ROW_BLUE_2][y][x], blue2);
            /* Blur luma by the detectors' Gaussian, and differentiate once and twice. */
            Lanes center = loadLanes(luma);
            Lanes gauss = context->gauss[0] * center, edge = {0}, point = {0};
            for (int k = 1; k <= FEATURE_RADIUS; k++) {
                Lanes before = loadLanes(luma - k), after = loadLanes(luma + k);
                gauss += context->gauss[k] * (before + after);
                point += context->point[k] * (before + after - 2 * center);
                edge += context->edge[k] * (after - before);
            }
            storeLanes(&scratch->rows[ROW_GAUSS][y][x], gauss);
            storeLanes(&scratch->rows[ROW_EDGE][y][x], edge);
            storeLanes(&scratch->rows[ROW_POINT][y][x], point);
        }
    }
}

/* CIELab's f (CIE 15): the cube root, and a line below (6/29)^3. */
LANES_INLINE Lanes labCurve(Lanes t)
{
    const float bend = 0.00885645168f;
    Lanes line = t * 7.78703704f + 0.137931034f; /* t / (3 (6/29)^2) + 4/29 */
    return selectLanes(t > bend, cbrtLanes(maxLanes(t, splatLanes(bend))), line);
}

/* Filter along y, and see the colour: Hunt-adjusted CIELab (paper, section 4.1). */
LANES_INLINE void seeColor(const FlipContext *context, FlipScratch *scratch, int which, int y, int x)
{
    int middle = y + MARGIN;
    Lanes luma = filterLanes(context->luma, NARROW_RADIUS, &scratch->rows[ROW_LUMA][middle][x], TILE_WIDTH);
    Lanes red = filterLanes(context->red, NARROW_RADIUS, &scratch->rows[ROW_RED][middle][x], TILE_WIDTH);
    Lanes blue =
        filterLanes(context->blue1, COLOR_RADIUS, &scratch->rows[ROW_BLUE_1][middle][x], TILE_WIDTH) +
        filterLanes(context->blue2, COLOR_RADIUS, &scratch->rows[ROW_BLUE_2][middle][x], TILE_WIDTH);
    /* Clamp to the colours that the screen can show. */
    Lanes rgb[3], xyz[3];
    transformLanes(&context->rgbFromOpponent, luma, red, blue, rgb);
    for (int i = 0; i < 3; i++)
        rgb[i] = minLanes(maxLanes(rgb[i], splatLanes(0.0f)), splatLanes(1.0f));
    /* Go to CIELab; L = 116 fy - 16, a = 500 (fx - fy), b = 200 (fy - fz). */
    transformLanes(&context->relativeXyzFromRgb, rgb[0], rgb[1], rgb[2], xyz);
    Lanes fx = labCurve(xyz[0]), fy = labCurve(xyz[1]), fz = labCurve(xyz[2]);
    Lanes lightness = 116.0f * fy - 16.0f;
    /* Adjust by the Hunt effect: colours of dark things look weaker, a and b times L / 100. */
    storeLanes(&scratch->seen[which][SEEN_L][y][x], lightness);
    storeLanes(&scratch->seen[which][SEEN_A][y][x], 0.01f * lightness * (500.0f * (fx - fy)));
    storeLanes(&scratch->seen[which][SEEN_B][y][x], 0.01f * lightness * (200.0f * (fy - fz)));
}

/* Filter along y, and see the features: the lengths of the first and second derivatives (section 4.2). */
LANES_INLINE void seeFeatures(const FlipContext *context, FlipScratch *scratch, int which, int y, int x)
{
    const float *gauss = &scratch->rows[ROW_GAUSS][y + MARGIN][x];
    Lanes edgeX =
        filterLanes(context->gauss, FEATURE_RADIUS, &scratch->rows[ROW_EDGE][y + MARGIN][x], TILE_WIDTH);
    Lanes pointX =
        filterLanes(context->gauss, FEATURE_RADIUS, &scratch->rows[ROW_POINT][y + MARGIN][x], TILE_WIDTH);
    Lanes center = loadLanes(gauss), edgeY = {0}, pointY = {0};
    for (int k = 1; k <= FEATURE_RADIUS; k++) {
        Lanes above = loadLanes(gauss - k * TILE_WIDTH), below = loadLanes(gauss + k * TILE_WIDTH);
        pointY += context->point[k] * (above + below - 2 * center);
        edgeY += context->edge[k] * (below - above);
    }
    storeLanes(&scratch->seen[which][SEEN_EDGE][y][x], sqrtLanes(edgeX * edgeX + edgeY * edgeY));
    storeLanes(&scratch->seen[which][SEEN_POINT][y][x], sqrtLanes(pointX * pointX + pointY * pointY));
}

/* The difference of one picture's value from the other's. */
LANES_INLINE Lanes seenDifference(const FlipScratch *scratch, int what, int y, int x)
{
    return loadLanes(&scratch->seen[0][what][y][x]) - loadLanes(&scratch->seen[1][what][y][x]);
}

/* FLIP at LANES pixels (section 4.3). */
LANES_INLINE Lanes combineLanes(const FlipContext *context, const FlipScratch *scratch, int y, int x)
{
    /* Take the HyAB distance |dL| + sqrt(da^2 + db^2), to its exponent. */
    Lanes a = seenDifference(scratch, SEEN_A, y, x), b = seenDifference(scratch, SEEN_B, y, x);
    Lanes distance = absLanes(seenDifference(scratch, SEEN_L, y, x)) + sqrtLanes(a * a + b * b);
    distance = powLanes(distance, splatLanes((float)COLOR_EXPONENT));
    /* Bring it to 0..1, with most of the range for small distances. */
    Lanes above = (float)COLOR_KNEE_VALUE + (distance - context->knee) * context->slopeAbove;
    Lanes color = selectLanes(distance < context->knee, distance * context->slopeBelow, above);
    /* Let a difference of features amplify it: dE = color^(1 - feature). */
    Lanes edge = absLanes(seenDifference(scratch, SEEN_EDGE, y, x));
    Lanes point = absLanes(seenDifference(scratch, SEEN_POINT, y, x));
    Lanes feature = sqrtLanes(0.707106781f * maxLanes(edge, point)); /* 1 / sqrt(2), to q_f */
    return powLanes(color, maxLanes(1.0f - feature, splatLanes(0.0f)));
}

/* The sum of FLIP over a tile. */
static double flipOfTile(const void *argument, const Tile *tile, void *memory)
{
    const FlipContext *context = argument;
    FlipScratch *scratch = memory;
    /* Skip what is equal: each pixel would give exactly 0. */
    if (tilesEqual(context->a, context->b, tile, MARGIN))
        return 0;
    int width = (tile->width + LANES - 1) / LANES * LANES;
    for (int which = 0; which < 2; which++) {
        loadOpponent(context, which == 0 ? context->a : context->b, tile, scratch);
        filterRows(context, scratch, width, tile->height + 2 * MARGIN);
        for (int y = 0; y < tile->height; y++)
            for (int x = 0; x < width; x += LANES)
                seeColor(context, scratch, which, y, x);
        for (int y = 0; y < tile->height; y++)
            for (int x = 0; x < width; x += LANES)
                seeFeatures(context, scratch, which, y, x);
    }
    double sum = 0;
    for (int y = 0; y < tile->height; y++) {
        float row[TILE_WIDTH];
        for (int x = 0; x < width; x += LANES)
            storeLanes(row + x, combineLanes(context, scratch, y, x));
        for (int x = 0; x < tile->width; x++)
            sum += (double)row[x];
    }
    return sum;
}

/* The inverse, by the adjugate. */
static void invertMatrix(double m[3][3], double inverse[3][3])
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            int r = (j + 1) % 3, s = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            inverse[i][j] = m[r][c] * m[s][d] - m[r][d] * m[s][c];
        }
    }
    double determinant = m[0][0] * inverse[0][0] + m[0][1] * inverse[1][0] + m[0][2] * inverse[2][0];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            inverse[i][j] /= determinant;
}

static Matrix roundMatrix(double m[3][3])
{
    Matrix rounded;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            rounded.m[i][j] = (float)m[i][j];
    return rounded;
}

/* Hunt-adjusted CIELab of a relative XYZ colour, in double. */
static void labOfXyz(const double xyz[3], double lab[3])
{
    double f[3];
    for (int i = 0; i < 3; i++)
        f[i] = xyz[i] > 216.0 / 24389.0 ? cbrt(xyz[i]) : xyz[i] * 841.0 / 108.0 + 4.0 / 29.0;
    lab[0] = 116 * f[1] - 16;
    lab[1] = 0.01 * lab[0] * 500 * (f[0] - f[1]);
    lab[2] = 0.01 * lab[0] * 200 * (f[1] - f[2]);
}

/* Set the matrices and the colour curve. */
static void prepareColors(FlipContext *context)
{
    /* Divide by the white point, which is the sum of each row: XYZ relative to white. */
    double relative[3][3], opponent[3][3], inverse[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            relative[i][j] =
                XYZ_FROM_RGB[i][j] / (XYZ_FROM_RGB[i][0] + XYZ_FROM_RGB[i][1] + XYZ_FROM_RGB[i][2]);
    for (int j = 0; j < 3; j++) {
        opponent[0][j] = relative[1][j];
        opponent[1][j] = relative[0][j] - relative[1][j];
        opponent[2][j] = relative[1][j] - relative[2][j];
    }
    invertMatrix(opponent, inverse);
    context->opponentFromRgb = roundMatrix(opponent);
    context->rgbFromOpponent = roundMatrix(inverse);
    context->relativeXyzFromRgb = roundMatrix(relative);

    /* The largest distance is that of green from blue (section 4.1). */
    double green[3], blue[3], greenLab[3], blueLab[3];
    for (int i = 0; i < 3; i++) {
        green[i] = relative[i][1];
        blue[i] = relative[i][2];
    }
    labOfXyz(green, greenLab);
    labOfXyz(blue, blueLab);
    double largest =
        pow(fabs(greenLab[0] - blueLab[0]) + hypot(greenLab[1] - blueLab[1], greenLab[2] - blueLab[2]),
            COLOR_EXPONENT);
    double knee = COLOR_KNEE * largest;
    context->knee = (float)knee;
    context->slopeBelow = (float)(COLOR_KNEE_VALUE / knee);
    context->slopeAbove = (float)((1 - COLOR_KNEE_VALUE) / (largest - knee));
}

/* A contrast sensitivity filter in one dimension, such that the product of two of them, one in x and one
 * in y, is the paper's; returns the sum of its weights on the full radius. */
static double gaussianWeights(double a, double b, double pixelsPerDegree, double weights[COLOR_RADIUS + 1])
{
    const double pi = 3.14159265358979323846;
    double sum = 0;
    for (int k = 0; k <= COLOR_RADIUS; k++) {
        double x = k / pixelsPerDegree;
        weights[k] = sqrt(a * sqrt(pi / b)) * exp(-pi * pi * x * x / b);
        sum += k == 0 ? weights[k] : 2 * weights[k];
    }
    return sum;
}

static void prepareColorFilters(FlipContext *context, double pixelsPerDegree)
{
    double weights[COLOR_RADIUS + 1], second[COLOR_RADIUS + 1];
    double sum = gaussianWeights(1, LUMA_B, pixelsPerDegree, weights);
    for (int k = 0; k <= NARROW_RADIUS; k++)
        context->luma[k] = (float)(weights[k] / sum);
    sum = gaussianWeights(1, RED_B, pixelsPerDegree, weights);
    for (int k = 0; k <= NARROW_RADIUS; k++)
        context->red[k] = (float)(weights[k] / sum);
    /* The two products of blue-yellow sum to 1 together: divide both in x and in y. */
    sum = gaussianWeights(BLUE_A1, BLUE_B1, pixelsPerDegree, weights);
    double secondSum = gaussianWeights(BLUE_A2, BLUE_B2, pixelsPerDegree, second);
    double norm = hypot(sum, secondSum);
    for (int k = 0; k <= COLOR_RADIUS; k++) {
        context->blue1[k] = (float)(weights[k] / norm);
        context->blue2[k] = (float)(second[k] / norm);
    }
}

/* The Gaussian and its derivatives: the first one's positive weights sum to 1 and its negative ones to -1,
 * and so do the second one's (section 4.2). As all of the second one's sum to 0, its middle weight can act
 * through the others, each on the difference from the middle: where a picture is uniform the sum is then
 * exactly 0. Rounding would leave 1e-8, of which the feature exponent makes 1e-4. */
static void prepareFeatureFilters(FlipContext *context, double pixelsPerDegree)
{
    double deviation = 0.5 * FEATURE_WIDTH * pixelsPerDegree;
    double gauss[FEATURE_RADIUS + 1], edge[FEATURE_RADIUS + 1], point[FEATURE_RADIUS + 1];
    double gaussSum = 0, edgeSum = 0, positiveSum = 0, negativeSum = 0;
    for (int k = 0; k <= FEATURE_RADIUS; k++) {
        double times = k == 0 ? 1 : 2; /* on both sides */
        gauss[k] = exp(-k * k / (2 * deviation * deviation));
        edge[k] = k * gauss[k];
        point[k] = (k * k / (deviation * deviation) - 1) * gauss[k];
        gaussSum += times * gauss[k];
        edgeSum += edge[k];
        if (point[k] > 0)
            positiveSum += times * point[k];
        else
            negativeSum -= times * point[k];
    }
    for (int k = 0; k <= FEATURE_RADIUS; k++) {
        context->gauss[k] = (float)(gauss[k] / gaussSum);
        context->edge[k] = (float)(edge[k] / edgeSum);
        context->point[k] = (float)(point[k] / (point[k] > 0 ? positiveSum : negativeSum));
    }
}

/* For each sample value the linear value in 0..1; NULL when memory runs out. */
static float *linearizeSamples(const Image *image)
{
    unsigned largest = imageMaxSample(image);
    float *linear = malloc(((size_t)largest + 1) * sizeof *linear);
    for (unsigned i = 0; linear != NULL && i <= largest; i++) {
        double value = (double)i / (double)largest;
        if (image->encoding == ENCODING_SRGB)
            value = value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
        linear[i] = (float)value;
    }
    return linear;
}

Status measureFlip(const Image *a, const Image *b, int threads, double *mean)
{
    float *linear = linearizeSamples(a);
    if (linear == NULL)
        return statusOutOfMemory();
    FlipContext context = {.a = a, .b = b, .linear = linear};
    double degree = 3.14159265358979323846 / 180;
    double pixelsPerDegree = VIEWING_DISTANCE * (MONITOR_PIXELS / MONITOR_WIDTH) * degree; /* 67.02 */
    prepareColors(&context);
    prepareColorFilters(&context, pixelsPerDegree);
    prepareFeatureFilters(&context, pixelsPerDegree);
    TileSum what = {a->width, a->height, TILE_WIDTH, TILE_HEIGHT, sizeof(FlipScratch), flipOfTile, &context};
    double sum = 0;
    Status status = sumTiles(&what, threads, &sum);
    if (statusIsOk(&status))
        *mean = sum / ((double)a->width * (double)a->height);
    free(linear);
    return status;
}
