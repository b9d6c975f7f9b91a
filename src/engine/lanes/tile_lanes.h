/* tile_lanes.h - the 64 rays of a tile on their way from the camera to a colour.
 *
 * Everything that reaches the picture is computed here in the same operations as in the course's tracer, each
 * line for all rays in one loop: the functions are its own, inline, and without branches, so that the
 * compiler takes several lanes at a time. Lanes that have nothing to do with a loop compute something
 * harmless.
 */
#ifndef ECLAIRAGE_ENGINE_TILE_LANES_H
#define ECLAIRAGE_ENGINE_TILE_LANES_H

#include "engine/lanes/bundle.h"

#define EACH_LANE(k) for (int k = 0; k < LANES; k++)
/* For each lane k of a set; `continue` goes on with the next, and there is no `break`. */
#define EACH_SET(k, set)                                                                                     \
    for (uint64_t k##Left = (set); k##Left != 0; k##Left &= k##Left - 1)                                     \
        for (int k = __builtin_ctzll(k##Left), k##Done = 0; k##Done == 0; k##Done = 1)

/* A set of rays is 64 bits; a mask of them 64 ints, 0 or -1, for the loops. */
typedef struct MaskLanes {
    _Alignas(64) int32_t v[LANES];
} MaskLanes;

typedef struct ColorLanes {
    _Alignas(64) float r[LANES], g[LANES], b[LANES];
} ColorLanes;

static inline Color3f laneColor(const ColorLanes *lanes, int k)
{
    return createColor(lanes->r[k], lanes->g[k], lanes->b[k]);
}

static inline void setLaneColor(ColorLanes *lanes, int k, Color3f color)
{
    lanes->r[k] = color.r;
    lanes->g[k] = color.g;
    lanes->b[k] = color.b;
}

static inline uint64_t setOfMask(const MaskLanes *mask)
{
    uint64_t set = 0;
    for (int p = 0; p < PACKETS; p++)
        set |= (uint64_t)maskBits(*(const I8 *)&mask->v[8 * p]) << 8 * p;
    return set;
}

static inline void maskOfSet(uint64_t set, MaskLanes *mask)
{
    for (int p = 0; p < PACKETS; p++)
        *(I8 *)&mask->v[8 * p] = maskOfBits((unsigned)(set >> 8 * p) & 255);
}

/* Where lane k lies in its tile. */
static inline int laneX(int k)
{
    return (k >> 3 & 1) * 4 + (k & 3);
}

static inline int laneY(int k)
{
    return (k >> 4) * 2 + (k >> 2 & 1);
}

/* The material of a part of a solid, which the surface itself has. */
#define PART_MATERIAL (-1)

typedef struct TileLanes {
    const TileJob *job;
    uint32_t *lastBlocks;
    RayCounts *counts;
    uint64_t inPicture; /* the rays of pixels that exist */

    /* The rays, and their bundle. */
    VectorLanes origins, directions;
    Bundle bundle;

    /* Where they meet a surface: as in SurfacePoint. */
    uint64_t met;
    NumberLanes distances, offsets;
    VectorLanes positions, normals;
    VectorLanes
        ownNormals; /* of the surfaces themselves, in tiles where some are interpolated or not turned */
    const VectorLanes *flatNormals;            /* these, or normals */
    _Alignas(64) int32_t ownPrimitives[LANES]; /* what cannot hide a light from the point, or NO_PRIMITIVE */
    uint32_t objects[LANES];
    const Object *surfaces[LANES]; /* the object, or the part of a solid, that has the surface */

    /* Its material there. */
    _Alignas(64) int32_t materials[LANES]; /* its number among the compiled scene's, or PART_MATERIAL */
    ColorLanes diffuse, specular;
    NumberLanes shininess;
    uint64_t simple, phong, blinn, secondary; /* lanes of these models; with mirrored or refracted rays */

    ColorLanes colors; /* what the rays see */
} TileLanes;

/* Each does one step for all rays of the tile; in this order. */
void PATH(aimRays)(TileLanes *tile, int left, int top, double x, double y); /* x, y: in each pixel, 0 .. 1 */
void PATH(meetSurfaces)(TileLanes *tile);
void PATH(shadeSurfaces)(TileLanes *tile);

#endif
