/* bundle.h - 64 rays that start in one point or run in one direction, and how they are filtered in float.
 *
 * The rays of a tile of 8 x 8 pixels come from the eye; those that ask whether light reaches its points are
 * taken from the light. In a frame of their own, with the origin O and three axes, a central ray is the
 * points (u z, v z, z) and a parallel one the points (u, v, z), z being the depth:
 *
 *          v |      /|         8 packets of 8 rays, each of 4 x 2 pixels:   0 1
 *            |    /  |                                                      2 3
 *          O +--/----|---- z                                                4 5
 *               \  u |                                                      6 7
 *
 * So one test of a box looks at all 64 rays, and one of a sphere or triangle at 8.
 *
 * The filter and its margins. A point that is converted to float, moved to O and turned into the frame is
 * wrong, as a vector, by less than d = 1.25 x 2^-20 (|O| + |c|), |c| being the largest coordinate of the
 * thing, its radius added, and |O| that of the origin. In units of 2^-24 (|O| + |c|): two conversions and a
 * difference, 1 each and by sqrt(3) as a vector, 5.2; axes rounded to float, 1.5 each, and sums of three
 * products, 3 sqrt(3) each, by sqrt(3), 11.6; u and v rounded, sqrt(6) times the larger of them;
 * together 16.8 + 2.4 = 19.2 < 20 for u and v up to 1, and floatError takes care of larger ones. Every
 * decision below is made with what such an error can do to it, and what is nearer to the border than that is
 * left to the referee. README.md has the margins of each test.
 */
#ifndef ECLAIRAGE_ENGINE_BUNDLE_H
#define ECLAIRAGE_ENGINE_BUNDLE_H

#include "engine/compiled_scene.h"
#include "engine/lanes/path.h"
#include "engine/lanes/simd.h"

enum {
    LANES = 64,
    PACKETS = 8
};

/* One number, or one vector, of each ray. */
typedef struct NumberLanes {
    _Alignas(64) double v[LANES];
} NumberLanes;

typedef struct VectorLanes {
    _Alignas(64) double x[LANES], y[LANES], z[LANES];
} VectorLanes;

static inline Vector3D laneVector(const VectorLanes *lanes, int lane)
{
    return createVector(lanes->x[lane], lanes->y[lane], lanes->z[lane]);
}

static inline void setLaneVector(VectorLanes *lanes, int lane, Vector3D v)
{
    lanes->x[lane] = v.x;
    lanes->y[lane] = v.y;
    lanes->z[lane] = v.z;
}

/* In Bundle's primitive: nothing, or number n of the planes and then the other endless objects. */
static inline int32_t endlessCode(size_t number)
{
    return -2 - (int32_t)number;
}

static inline size_t endlessNumber(int32_t code)
{
    return (size_t)(-2 - code);
}

typedef struct Bundle {
    const CompiledScene *compiled;
    bool isParallel;
    float origin[3], axes[3][3]; /* scaled; the third axis is the depth's */
    float largest;               /* of the coordinates of origin and of the rays' ends */
    float startDepth;            /* hits count from here on */
    F8 u[PACKETS], v[PACKETS];
    F8 slope[PACKETS];        /* the squared length of (u, v, 1), of a parallel ray 1 */
    F8 inverseSlope[PACKETS]; /* 1 / slope */

    /* The depth of the nearest hit so far, or of the ray's end, is in this interval. */
    F8 nearest[PACKETS], farthest[PACKETS];
    /* What the nearest hit is on; of shadow rays what cannot block them. */
    I8 primitives[PACKETS];
    uint8_t active[PACKETS]; /* the rays that count; of shadow rays those not yet blocked */

    /* The same rays in double, in world units. */
    const VectorLanes *origins, *directions; /* shadow rays: the origins are their starts, at the far end */
    const ArrivingLight *light;              /* of shadow rays */

    /* The exact distance of a hit that the referee has seen, and on which primitive; then `hits` has it all.
     */
    double exact[LANES];
    int32_t exactPrimitives[LANES];
    Hit hits[LANES];
} Bundle;

/* Set the frame: a point and three axes of unit length in world space, the last one the depth's. */
static inline void setBundleFrame(Bundle *bundle, const CompiledScene *compiled, Vector3D origin, Vector3D x,
                                  Vector3D y, Vector3D z)
{
    const Vector3D vectors[4] = {multVector(origin, compiled->scale), x, y, z};
    for (int i = 0; i < 4; i++) {
        float *to = i == 0 ? bundle->origin : bundle->axes[i - 1];
        to[0] = (float)vectors[i].x;
        to[1] = (float)vectors[i].y;
        to[2] = (float)vectors[i].z;
    }
    bundle->compiled = compiled;
    bundle->largest = (float)largestCoordinate(vectors[0]);
}

/* Find the nearest primitive of each active ray. */
void PATH(meetBundle)(Bundle *bundle);

/* Take away the active rays that something blocks. lastBlock: any number at first, kept from call to call
 * with the same light: the block that blocked last is tried first. */
void PATH(blockBundle)(Bundle *bundle, uint32_t *lastBlock);

#endif
