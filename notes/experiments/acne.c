/* acne.c - how many points are wrongly in shadow, or wrongly lit, for a shadow bias; as CSV.
 *
 *     cc -O2 -o acne notes/experiments/acne.c -lm && ./acne > acne.csv
 *     ./acne 1e-15                                 one bias, as JSON
 *
 * For each bias, and in single and in double precision, a ray is sent through the middle of each pixel of
 * 480 x 360. Where it meets a surface that faces the lamp, a shadow ray starts at the computed point, and
 * what it meets counts when it is farther than the bias. The truth for the point is what the same test says
 * in long double with no bias, when the surface that the point lies on is left out: spheres and planes do
 * not shade their own lit side. Two numbers come out for each scene and precision, in percent:
 *
 *   acne: of the lit points, those that the test says are in shadow;
 *   lost: of the points in shadow, those that the test says are lit.
 *
 * One source for both precisions: this file includes itself, with REAL set.
 */
#ifndef REAL
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    WIDTH = 480,
    HEIGHT = 360
};

/* A sphere where radius is above 0; else the plane through center with the unit normal. */
typedef struct Surface {
    double center[3], radius, normal[3];
} Surface;

typedef struct Scene {
    const char *name;
    double light[3];
    int count;
    Surface surfaces[2];
} Scene;

/* The handout's exercise 04; and a sphere that lies on a tilted plane, whose normal (1, 2, 2) / 3 has no
 * coordinate that is exact in binary. The sphere's centre is 0.15 from the plane. */
static const Scene SCENES[2] = {
    {"spheres", {-3, 0, 1}, 2, {{{0, 0, -5}, 1.5, {0, 0, 0}}, {{-1, 0, -3.5}, 0.5, {0, 0, 0}}}},
    {"plane",
     {-3, 4, 1},
     2,
     {{{0.1, 0.1, -2.2}, 0.15, {0, 0, 0}},
      {{0.1 - 0.15 / 3, 0.1 - 0.3 / 3, -2.2 - 0.3 / 3}, 0, {1 / 3.0, 2 / 3.0, 2 / 3.0}}}}};

static const char *const COLUMNS[4] = {"acne_float", "acne_double", "lost_float", "lost_double"};

typedef struct Counts {
    long lit, shadowed, acne, lost;
} Counts;

#define REAL float
#define NAMED(name) name##Single
#include "acne.c"
#undef REAL
#undef NAMED
#define REAL double
#define NAMED(name) name##Double
#include "acne.c"
#undef REAL
#undef NAMED
#define REAL long double
#define NAMED(name) name##Long
#include "acne.c"

static double percent(long part, long whole)
{
    return whole > 0 ? 100.0 * (double)part / (double)whole : 0;
}

/* One line of the CSV, or a JSON object of the same numbers. */
static void writeBias(double bias, bool json)
{
    printf(json ? "{\"bias\": %g" : "%g", bias);
    for (int s = 0; s < 2; s++) {
        const Scene *scene = &SCENES[s];
        Counts single = countPointsSingle(scene, bias), twice = countPointsDouble(scene, bias);
        double numbers[4] = {percent(single.acne, single.lit), percent(twice.acne, twice.lit),
                             percent(single.lost, single.shadowed), percent(twice.lost, twice.shadowed)};
        for (int i = 0; i < 4; i++) {
            if (json)
                printf(", \"%s_%s\"", scene->name, COLUMNS[i]);
            printf(json ? ": %.4f" : ",%.4f", numbers[i]);
        }
    }
    printf(json ? "}\n" : "\n");
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        char *end;
        double bias = strtod(argv[1], &end);
        if (*end != '\0' || !(bias >= 0)) {
            fprintf(stderr, "acne: '%s' is not a bias; give a number that is at least 0\n", argv[1]);
            return 2;
        }
        writeBias(bias, true);
        return 0;
    }
    printf("bias");
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < 4; i++)
            printf(",%s_%s", SCENES[s].name, COLUMNS[i]);
    printf("\n");
    writeBias(0, false);
    for (int exponent = -16; exponent <= 0; exponent++)
        writeBias(pow(10, exponent), false);
    return 0;
}

#else

/* The nearest distance above `above` at which the ray meets the surface, or -1. The quadratic as the
 * handout's readers write it: t^2 + 2 b t + c = 0. */
static REAL NAMED(meetSurface)(const Surface *surface, const REAL origin[3], const REAL direction[3],
                               REAL above)
{
    REAL b = 0, c = 0, along = 0, height = 0;
    for (int i = 0; i < 3; i++) {
        REAL from = origin[i] - (REAL)surface->center[i];
        b += from * direction[i];
        c += from * from;
        along += direction[i] * (REAL)surface->normal[i];
        height += from * (REAL)surface->normal[i];
    }
    if (surface->radius <= 0) {
        REAL t = along != 0 ? -height / along : -1;
        return t > above ? t : -1;
    }
    c -= (REAL)surface->radius * (REAL)surface->radius;
    REAL discriminant = b * b - c;
    if (discriminant < 0)
        return -1;
    REAL root = (REAL)sqrtl((long double)discriminant);
    REAL first = -b - root, second = -b + root;
    return first > above ? first : second > above ? second : -1;
}

/* Whether something lies between the point and the lamp, farther than the bias; surface number `except`
 * does not count. */
static bool NAMED(isHidden)(const Scene *scene, const REAL point[3], REAL bias, int except)
{
    REAL direction[3], squared = 0;
    for (int i = 0; i < 3; i++) {
        direction[i] = (REAL)scene->light[i] - point[i];
        squared += direction[i] * direction[i];
    }
    REAL distance = (REAL)sqrtl((long double)squared);
    for (int i = 0; i < 3; i++)
        direction[i] /= distance;
    for (int s = 0; s < scene->count; s++) {
        REAL t = s == except ? -1 : NAMED(meetSurface)(&scene->surfaces[s], point, direction, bias);
        if (t > 0 && t < distance)
            return true;
    }
    return false;
}

#ifndef COUNT_POINTS_NEEDS_THE_TRUTH
#define COUNT_POINTS_NEEDS_THE_TRUTH
static bool isHiddenLong(const Scene *scene, const long double point[3], long double bias, int except);
#endif

__attribute__((unused)) static Counts NAMED(countPoints)(const Scene *scene, double bias)
{
    Counts counts = {0, 0, 0, 0};
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            /* Aim: the camera at the origin looks along -z, 60 degrees from edge to edge. */
            REAL up = 2 * (REAL)tan(acos(-1) / 6);
            REAL direction[3] = {((REAL)x + (REAL)0.5 - WIDTH / 2) / HEIGHT * up,
                                 (HEIGHT / 2 - (REAL)0.5 - (REAL)y) / HEIGHT * up, -1};
            REAL length =
                (REAL)sqrtl((long double)(direction[0] * direction[0] + direction[1] * direction[1] + 1));
            const REAL origin[3] = {0, 0, 0};
            for (int i = 0; i < 3; i++)
                direction[i] /= length;

            /* Find the nearest surface. */
            int nearest = -1;
            REAL t = 0;
            for (int s = 0; s < scene->count; s++) {
                REAL hit = NAMED(meetSurface)(&scene->surfaces[s], origin, direction, 0);
                if (hit > 0 && (nearest < 0 || hit < t)) {
                    nearest = s;
                    t = hit;
                }
            }
            if (nearest < 0)
                continue;

            /* Leave out what faces away from the lamp: it is dark without any shadow ray. */
            const Surface *surface = &scene->surfaces[nearest];
            REAL point[3], cosine = 0;
            long double exact[3];
            for (int i = 0; i < 3; i++) {
                point[i] = origin[i] + t * direction[i];
                exact[i] = (long double)point[i];
                REAL normal = surface->radius > 0
                                  ? (point[i] - (REAL)surface->center[i]) / (REAL)surface->radius
                                  : (REAL)surface->normal[i];
                cosine += normal * ((REAL)scene->light[i] - point[i]);
            }
            if (!(cosine > 0))
                continue;

            bool truth = isHiddenLong(scene, exact, 0, nearest);
            bool said = NAMED(isHidden)(scene, point, (REAL)bias, -1);
            counts.lit += !truth;
            counts.shadowed += truth;
            counts.acne += !truth && said;
            counts.lost += truth && !said;
        }
    }
    return counts;
}
#endif
