/* The fast FLIP against a simple twin: the paper's formulas in double, with its YCxCz and its filters in
 * two dimensions, nothing folded, separated, cut or approximated. */
#include "compare/flip.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;
static const double WHITE[3] = {0.950428545, 1.000000000, 1.088900371}; /* D65 */

/* A plane of numbers that repeats its border. */
typedef struct Plane {
    int width, height;
    double *values;
} Plane;

static Plane makePlane(int width, int height)
{
    Plane plane = {width, height, calloc((size_t)width * (size_t)height, sizeof(double))};
    assert_non_null(plane.values);
    return plane;
}

static double *at(Plane plane, int x, int y)
{
    x = x < 0 ? 0 : x < plane.width ? x : plane.width - 1;
    y = y < 0 ? 0 : y < plane.height ? y : plane.height - 1;
    return &plane.values[y * plane.width + x];
}

/* Each pixel as the sum over the kernel's square of 2 radius + 1. */
static Plane convolve(Plane plane, Plane kernel)
{
    int radius = kernel.width / 2;
    Plane result = makePlane(plane.width, plane.height);
    for (int y = 0; y < plane.height; y++)
        for (int x = 0; x < plane.width; x++)
            for (int j = -radius; j <= radius; j++)
                for (int i = -radius; i <= radius; i++)
                    *at(result, x, y) += *at(kernel, i + radius, j + radius) * *at(plane, x + i, y + j);
    return result;
}

/* The contrast sensitivity of one opponent channel: the sum of two Gaussians a sqrt(pi / b)
 * exp(-pi^2 r^2 / b) of the distance r from the middle in degrees, normalised to sum 1 (section 4.1 and
 * table 1 of the paper). */
static Plane contrastKernel(const double a[2], const double b[2], double pixelsPerDegree)
{
    int radius = (int)ceil(3 * sqrt(0.04 / (2 * PI * PI)) * pixelsPerDegree);
    Plane kernel = makePlane(2 * radius + 1, 2 * radius + 1);
    double sum = 0;
    for (int j = -radius; j <= radius; j++) {
        for (int i = -radius; i <= radius; i++) {
            double square = (i * i + j * j) / (pixelsPerDegree * pixelsPerDegree);
            double weight = 0;
            for (int k = 0; k < 2; k++)
                weight += a[k] * sqrt(PI / b[k]) * exp(-PI * PI * square / b[k]);
            *at(kernel, i + radius, j + radius) = weight;
            sum += weight;
        }
    }
    for (int i = 0; i < kernel.width * kernel.height; i++)
        kernel.values[i] /= sum;
    return kernel;
}

/* The first or second derivative in x of a Gaussian, or with vertical set in y; its positive weights sum
 * to 1, its negative ones to -1 (section 4.2). */
static Plane featureKernel(int order, int vertical, double pixelsPerDegree)
{
    double deviation = 0.5 * 0.082 * pixelsPerDegree;
    int radius = (int)ceil(3 * deviation);
    Plane kernel = makePlane(2 * radius + 1, 2 * radius + 1);
    double positive = 0, negative = 0;
    for (int j = -radius; j <= radius; j++) {
        for (int i = -radius; i <= radius; i++) {
            double along = vertical ? j : i;
            double gauss = exp(-(i * i + j * j) / (2 * deviation * deviation));
            double weight =
                order == 1 ? -along * gauss : (along * along / (deviation * deviation) - 1) * gauss;
            *at(kernel, i + radius, j + radius) = weight;
            positive += weight > 0 ? weight : 0;
            negative += weight < 0 ? -weight : 0;
        }
    }
    for (int i = 0; i < kernel.width * kernel.height; i++)
        kernel.values[i] /= kernel.values[i] > 0 ? positive : negative;
    return kernel;
}

static void xyzFromRgb(const double rgb[3], double xyz[3])
{
    xyz[0] = (10135552 * rgb[0] + 8788810 * rgb[1] + 4435075 * rgb[2]) / 24577794;
    xyz[1] = (2613072 * rgb[0] + 8788810 * rgb[1] + 887015 * rgb[2]) / 12288897;
    xyz[2] = (1425312 * rgb[0] + 8788810 * rgb[1] + 70074185 * rgb[2]) / 73733382;
}

static void rgbFromXyz(const double xyz[3], double rgb[3])
{
    rgb[0] = 3.241003275 * xyz[0] - 1.537398934 * xyz[1] - 0.498615861 * xyz[2];
    rgb[1] = -0.969224334 * xyz[0] + 1.875930071 * xyz[1] + 0.041554224 * xyz[2];
    rgb[2] = 0.055639423 * xyz[0] - 0.204011202 * xyz[1] + 1.057148933 * xyz[2];
}

/* CIELab with a and b times L / 100: the Hunt effect. */
static void huntLabFromRgb(const double rgb[3], double lab[3])
{
    double xyz[3], f[3];
    xyzFromRgb(rgb, xyz);
    for (int i = 0; i < 3; i++) {
        double t = xyz[i] / WHITE[i];
        f[i] = t > pow(6 / 29.0, 3) ? cbrt(t) : t / (3 * (6 / 29.0) * (6 / 29.0)) + 4 / 29.0;
    }
    lab[0] = 116 * f[1] - 16;
    lab[1] = 0.01 * lab[0] * 500 * (f[0] - f[1]);
    lab[2] = 0.01 * lab[0] * 200 * (f[1] - f[2]);
}

static double hyab(const double p[3], const double q[3])
{
    return fabs(p[0] - q[0]) + sqrt((p[1] - q[1]) * (p[1] - q[1]) + (p[2] - q[2]) * (p[2] - q[2]));
}

/* What is seen of one picture: filtered colour, and edges and points. */
typedef struct Seen {
    Plane lab[3], edge, point;
} Seen;

static Plane lengthOf(Plane gray, int order, double pixelsPerDegree)
{
    Plane length = makePlane(gray.width, gray.height);
    for (int vertical = 0; vertical < 2; vertical++) {
        Plane kernel = featureKernel(order, vertical, pixelsPerDegree);
        Plane derivative = convolve(gray, kernel);
        for (int i = 0; i < gray.width * gray.height; i++)
            length.values[i] = hypot(length.values[i], derivative.values[i]);
        free(kernel.values);
        free(derivative.values);
    }
    return length;
}

static Seen see(const Image *image, double pixelsPerDegree)
{
    static const double a[3][2] = {{1, 0}, {1, 0}, {34.1, 13.5}};
    static const double b[3][2] = {{0.0047, 1e-5}, {0.0053, 1e-5}, {0.04, 0.025}};
    int width = image->width, height = image->height;
    Plane ycxcz[3], filtered[3], gray = makePlane(width, height);
    for (int c = 0; c < 3; c++)
        ycxcz[c] = makePlane(width, height);
    for (int i = 0; i < width * height; i++) {
        double rgb[3], xyz[3];
        for (int c = 0; c < 3; c++) {
            double v = image->samples[3 * i + c] / (double)imageMaxSample(image);
            rgb[c] = image->encoding == ENCODING_LINEAR ? v
                     : v <= 0.04045                     ? v / 12.92
                                                        : pow((v + 0.055) / 1.055, 2.4);
        }
        xyzFromRgb(rgb, xyz);
        double x = xyz[0] / WHITE[0], y = xyz[1] / WHITE[1], z = xyz[2] / WHITE[2];
        ycxcz[0].values[i] = 116 * y - 16;
        ycxcz[1].values[i] = 500 * (x - y);
        ycxcz[2].values[i] = 200 * (y - z);
        gray.values[i] = (ycxcz[0].values[i] + 16) / 116;
    }
    Seen seen;
    for (int c = 0; c < 3; c++) {
        Plane kernel = contrastKernel(a[c], b[c], pixelsPerDegree);
        filtered[c] = convolve(ycxcz[c], kernel);
        free(kernel.values);
        seen.lab[c] = makePlane(width, height);
    }
    for (int i = 0; i < width * height; i++) {
        double y = (filtered[0].values[i] + 16) / 116, rgb[3], lab[3];
        double xyz[3] = {(y + filtered[1].values[i] / 500) * WHITE[0], y * WHITE[1],
                         (y - filtered[2].values[i] / 200) * WHITE[2]};
        rgbFromXyz(xyz, rgb);
        for (int c = 0; c < 3; c++)
            rgb[c] = fmin(fmax(rgb[c], 0), 1);
        huntLabFromRgb(rgb, lab);
        for (int c = 0; c < 3; c++)
            seen.lab[c].values[i] = lab[c];
    }
    seen.edge = lengthOf(gray, 1, pixelsPerDegree);
    seen.point = lengthOf(gray, 2, pixelsPerDegree);
    for (int c = 0; c < 3; c++) {
        free(ycxcz[c].values);
        free(filtered[c].values);
    }
    free(gray.values);
    return seen;
}

static void freeSeen(Seen *seen)
{
    for (int c = 0; c < 3; c++)
        free(seen->lab[c].values);
    free(seen->edge.values);
    free(seen->point.values);
}

static double twinFlip(const Image *a, const Image *b)
{
    double pixelsPerDegree = 0.7 * (3840 / 0.7) * (PI / 180);
    double green[3], blue[3];
    huntLabFromRgb((const double[]){0, 1, 0}, green);
    huntLabFromRgb((const double[]){0, 0, 1}, blue);
    double largest = pow(hyab(green, blue), 0.7), knee = 0.4 * largest;
    Seen p = see(a, pixelsPerDegree), q = see(b, pixelsPerDegree);
    double sum = 0;
    for (int i = 0; i < a->width * a->height; i++) {
        double labP[3], labQ[3];
        for (int c = 0; c < 3; c++) {
            labP[c] = p.lab[c].values[i];
            labQ[c] = q.lab[c].values[i];
        }
        double color = pow(hyab(labP, labQ), 0.7);
        color = color < knee ? color * 0.95 / knee : 0.95 + 0.05 * (color - knee) / (largest - knee);
        double edge = fabs(p.edge.values[i] - q.edge.values[i]);
        double point = fabs(p.point.values[i] - q.point.values[i]);
        sum += pow(color, 1 - sqrt(fmax(edge, point) / sqrt(2)));
    }
    freeSeen(&p);
    freeSeen(&q);
    return sum / (a->width * a->height);
}

static void fastAndSimpleAgree(void **unused)
{
    (void)unused;
    /* Noise, and blocks of one colour with noise on some: edges, flat parts, dark and vivid colours. */
    static const struct {
        int width, height, bitDepth, block;
        Encoding encoding;
    } cases[] = {{1, 1, 8, 1, ENCODING_SRGB},    {3, 40, 8, 5, ENCODING_SRGB},
                 {45, 31, 8, 1, ENCODING_SRGB},  {60, 40, 8, 16, ENCODING_SRGB},
                 {140, 9, 16, 7, ENCODING_SRGB}, {30, 70, 16, 12, ENCODING_LINEAR}};
    uint64_t state = 7;
    for (size_t n = 0; n < sizeof cases / sizeof cases[0]; n++) {
        Image a, b;
        Status status =
            createImage(cases[n].width, cases[n].height, cases[n].bitDepth, cases[n].encoding, &a);
        assert_true(status.code == STATUS_OK);
        status = createImage(cases[n].width, cases[n].height, cases[n].bitDepth, cases[n].encoding, &b);
        assert_true(status.code == STATUS_OK);
        for (int y = 0; y < a.height; y++) {
            for (int x = 0; x < a.width; x++) {
                for (int c = 0; c < 3; c++) {
                    state = state * 6364136223846793005u + 1442695040888963407u;
                    /* The colour of the block is one of a hash of its place. */
                    uint64_t place = (uint64_t)(x / cases[n].block * 73 + y / cases[n].block * 179 + c * 7);
                    unsigned value = (unsigned)(place * 11400714819323198485u >> 48);
                    unsigned noise = (unsigned)(state >> 33) % 9000;
                    value = value > 65535 - noise ? value - noise : value + noise;
                    size_t i = 3 * (size_t)(y * a.width + x) + (size_t)c;
                    a.samples[i] = (uint16_t)(place * 11400714819323198485u >> 48);
                    b.samples[i] = (uint16_t)(place % 3 == 0 ? a.samples[i] : value);
                    if (a.bitDepth == 8) {
                        a.samples[i] >>= 8;
                        b.samples[i] >>= 8;
                    }
                }
            }
        }
        double fast = 0, simple = twinFlip(&a, &b);
        status = measureFlip(&a, &b, 2, &fast);
        assert_true(status.code == STATUS_OK);
        assert_true(simple > 0.01);
        if (!(fabs(fast - simple) <= 5e-7))
            fail_msg("case %d: fast %.9g, simple %.9g", (int)n, fast, simple);
        freeImage(&a);
        freeImage(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fastAndSimpleAgree),
    };
    return cmocka_run_group_tests_name("flip", tests, NULL, NULL);
}
