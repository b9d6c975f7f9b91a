/* colormap.c - the colours of a difference picture; see colormap.h.
 *
 * The path in OKLab's lightness L, chroma C and hue h, for s from 0 to 1: L = 0.13 + 0.84 s,
 * h = 285 + 180 s degrees, C = 0.175 sin(pi s) + 0.05 s, which stays inside sRGB. These were chosen so
 * that its speed, the root of L'^2 + C'^2 + (C h')^2, is nearly the same everywhere.
 */
#include "compare/colormap.h"

#include <math.h>

static const double PI = 3.14159265358979323846;
static const double FIRST_SHARE = 1.0 / 6; /* where the colours of differences begin */

/* A point of the path: L, a, b. */
static void pathPoint(double s, double lab[3])
{
    double hue = (285 + 180 * s) * PI / 180, chroma = 0.175 * sin(PI * s) + 0.05 * s;
    lab[0] = 0.13 + 0.84 * s;
    lab[1] = chroma * cos(hue);
    lab[2] = chroma * sin(hue);
}

/* OKLab to 8-bit sRGB, by the matrices of Ottosson 2020. */
static void srgbFromOklab(const double lab[3], uint16_t rgb[3])
{
    double l = lab[0] + 0.3963377774 * lab[1] + 0.2158037573 * lab[2];
    double m = lab[0] - 0.1055613458 * lab[1] - 0.0638541728 * lab[2];
    double s = lab[0] - 0.0894841775 * lab[1] - 1.2914855480 * lab[2];
    l = l * l * l;
    m = m * m * m;
    s = s * s * s;
    double linear[3] = {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                        -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
    for (int i = 0; i < 3; i++) {
        double v = fmin(fmax(linear[i], 0), 1);
        v = v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
        rgb[i] = (uint16_t)floor(255 * v + 0.5);
    }
}

void makeColorMap(ColorMap *map)
{
    for (int i = 0; i < COLOR_MAP_SIZE; i++) {
        double lab[3];
        pathPoint((double)i / (COLOR_MAP_SIZE - 1), lab);
        srgbFromOklab(lab, map->colors[i]);
    }
}

const uint16_t *colorOfDifference(const ColorMap *map, double share)
{
    if (!(share > 0))
        return map->colors[0];
    double place = FIRST_SHARE + (1 - FIRST_SHARE) * fmin(share, 1);
    return map->colors[(int)(place * (COLOR_MAP_SIZE - 1) + 0.5)];
}
