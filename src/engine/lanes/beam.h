/* beam.h - the rays of a bundle as one thing: the pyramid or prism round them, and what it meets.
 *
 * Four planes bound the rays, from the least and largest u and v; a fifth and sixth bound their depth. A box
 * is outside when its corner farthest along a plane's normal is; eight boxes, the children of a node, are
 * tested at a time. Of eight primitives that have been moved into the frame, the same is asked with their own
 * size.
 */
#ifndef ECLAIRAGE_ENGINE_BEAM_H
#define ECLAIRAGE_ENGINE_BEAM_H

#include "engine/lanes/bundle.h"

/* See bundle.h; and an error that nothing is below, so that its square is no denormal number. */
#define FLOAT_ERROR 0x1.4p-20f
#define LEAST_ERROR 1e-15f

typedef struct Beam {
    float normals[4][3], offsets[4]; /* a point p is inside when normals.p >= offsets */
    int farCorner[4][3];             /* where in a node the coordinate farthest along a normal is */
    float depthAxis[3], depthOrigin;
    int nearCorner[3]; /* likewise of the least depth */
    float uMin, uMax, vMin, vMax;
    float uMinLength, uMaxLength, vMinLength, vMaxLength; /* of (1, -u) */
    /* The same of each packet; a packet without active rays has bounds that nothing is within. */
    F8 packetUMin, packetUMax, packetVMin, packetVMax;
    F8 packetUMinLength, packetUMaxLength, packetVMinLength, packetVMaxLength;
    float slopeMax;   /* the largest slope, at least 1 */
    float slopeRoot;  /* its square root */
    float floatError; /* FLOAT_ERROR, more where rays go far to the side */
    float errorBase;  /* floatError |O| + LEAST_ERROR */
    float nodeError;  /* d for anything in the tree */
    float reach;      /* the largest depth of interest */
} Beam;

/* The place of a coordinate in a node's floats: min is first, then max. */
static inline int nodeCoordinate(int axis, bool isMax)
{
    return 8 * axis + (isMax ? 24 : 0);
}

static inline float largestDepth(const Bundle *bundle)
{
    F8 all = f8Set(-INFINITY);
    for (int p = 0; p < PACKETS; p++)
        all = f8Max(all, f8Select(maskOfBits(bundle->active[p]), bundle->farthest[p], all));
    return f8Largest(all);
}

static inline void createBeam(const Bundle *bundle, Beam *beam)
{
    /* Largest numbers are found as smallest ones with the other sign. */
    F8 outside = f8Set(1e30f), slopes = f8Set(1);
    _Alignas(32) float uMin[8], uMax[8], vMin[8], vMax[8];
    for (int p = 0; p < PACKETS; p++) {
        I8 mask = maskOfBits(bundle->active[p]);
        F8 u = bundle->u[p], v = bundle->v[p];
        F4 least = f8Least4(f8Select(mask, u, outside), f8Select(mask, -u, outside),
                            f8Select(mask, v, outside), f8Select(mask, -v, outside));
        uMin[p] = least[0];
        uMax[p] = -least[1];
        vMin[p] = least[2];
        vMax[p] = -least[3];
        slopes = f8Max(slopes, f8Select(mask, bundle->slope[p], slopes));
    }
    beam->packetUMin = f8Load(uMin);
    beam->packetUMax = f8Load(uMax);
    beam->packetVMin = f8Load(vMin);
    beam->packetVMax = f8Load(vMax);
    F4 least = f8Least4(beam->packetUMin, -beam->packetUMax, beam->packetVMin, -beam->packetVMax);
    beam->uMin = least[0];
    beam->uMax = -least[1];
    beam->vMin = least[2];
    beam->vMax = -least[3];
    beam->slopeMax = f8Largest(slopes);
    beam->slopeRoot = sqrtf(beam->slopeMax);

    /* The normal of u >= uMin is X - uMin Z of a central beam, and X of a parallel one. */
    bool parallel = bundle->isParallel;
    F8 one = f8Set(1);
#define PLANE_LENGTH(bound) (parallel ? one : f8Sqrt(f8MultAdd(bound, bound, one)))
    beam->packetUMinLength = PLANE_LENGTH(beam->packetUMin);
    beam->packetUMaxLength = PLANE_LENGTH(beam->packetUMax);
    beam->packetVMinLength = PLANE_LENGTH(beam->packetVMin);
    beam->packetVMaxLength = PLANE_LENGTH(beam->packetVMax);
#undef PLANE_LENGTH
    const float bounds[4] = {beam->uMin, beam->uMax, beam->vMin, beam->vMax};
    float lengths[4];
    for (int k = 0; k < 4; k++)
        lengths[k] = parallel ? 1 : sqrtf(1 + bounds[k] * bounds[k]);
    beam->uMinLength = lengths[0];
    beam->uMaxLength = lengths[1];
    beam->vMinLength = lengths[2];
    beam->vMaxLength = lengths[3];

    float aside = sqrtf(beam->slopeMax - 1);
    beam->floatError = FLOAT_ERROR * (aside > 1 ? aside : 1);
    beam->errorBase = beam->floatError * bundle->largest + LEAST_ERROR;
    beam->nodeError = beam->errorBase + beam->floatError * 2;
    for (int k = 0; k < 4; k++) {
        const float *side = bundle->axes[k / 2], *depth = bundle->axes[2];
        float sign = k % 2 == 0 ? 1.0f : -1.0f;
        float offset = parallel ? sign * bounds[k] : 0;
        for (int axis = 0; axis < 3; axis++) {
            beam->normals[k][axis] = sign * (parallel ? side[axis] : side[axis] - bounds[k] * depth[axis]);
            offset += beam->normals[k][axis] * bundle->origin[axis];
            beam->farCorner[k][axis] = nodeCoordinate(axis, beam->normals[k][axis] > 0);
        }
        beam->offsets[k] = offset - 2 * beam->nodeError * lengths[k];
    }
    beam->depthOrigin = 0;
    for (int axis = 0; axis < 3; axis++) {
        beam->depthAxis[axis] = bundle->axes[2][axis];
        beam->depthOrigin += bundle->axes[2][axis] * bundle->origin[axis];
        beam->nearCorner[axis] = nodeCoordinate(axis, !(bundle->axes[2][axis] > 0));
    }
    beam->reach = largestDepth(bundle);
}

/* Which of the eight children the beam meets, as bits, and the least depth of each. */
static inline unsigned beamMeetsChildren(const Bundle *bundle, const Beam *beam, const BvhNode *node,
                                         F8 *leastDepth)
{
    const float *floats = &node->min[0][0];
    I8 inside = i8Set(-1);
    for (int k = 0; k < 4; k++) {
        F8 along = f8Set(beam->normals[k][2]) * f8Load(floats + beam->farCorner[k][2]);
        along = f8MultAdd(f8Set(beam->normals[k][1]), f8Load(floats + beam->farCorner[k][1]), along);
        along = f8MultAdd(f8Set(beam->normals[k][0]), f8Load(floats + beam->farCorner[k][0]), along);
        inside &= along >= f8Set(beam->offsets[k]);
    }
    F8 origin = f8Set(-beam->depthOrigin), low = origin, high = origin;
    for (int axis = 2; axis >= 0; axis--) {
        F8 toward = f8Set(beam->depthAxis[axis]);
        int nearAt = beam->nearCorner[axis];
        int farAt = 2 * nodeCoordinate(axis, false) + 24 - nearAt;
        low = f8MultAdd(toward, f8Load(floats + nearAt), low);
        high = f8MultAdd(toward, f8Load(floats + farAt), high);
    }
    inside &= low <= f8Set(beam->reach + 2 * beam->nodeError);
    inside &= high >= f8Set(bundle->startDepth - 2 * beam->nodeError);
    *leastDepth = low;
    return maskBits(inside);
}

/* Move eight points into the frame. */
static inline void toFrame(const Bundle *bundle, const float *xs, const float *ys, const float *zs, F8 out[3])
{
    F8 x = f8Load(xs) - f8Set(bundle->origin[0]);
    F8 y = f8Load(ys) - f8Set(bundle->origin[1]);
    F8 z = f8Load(zs) - f8Set(bundle->origin[2]);
    for (int k = 0; k < 3; k++)
        out[k] = f8MultAdd(f8Set(bundle->axes[k][0]), x,
                           f8MultAdd(f8Set(bundle->axes[k][1]), y, f8Set(bundle->axes[k][2]) * z));
}

static inline F8 largestOf(const float *xs, const float *ys, const float *zs)
{
    return f8Max(f8Abs(f8Load(xs)), f8Max(f8Abs(f8Load(ys)), f8Abs(f8Load(zs))));
}

/* ---- Spheres ---- */

/* Eight spheres in the frame, and d of each. */
typedef struct LocalSpheres {
    _Alignas(32) float x[8], y[8], z[8], radius[8], error[8];
} LocalSpheres;

/* Which of them the beam meets, as bits. */
static inline unsigned beamMeetsSpheres(const Bundle *bundle, const Beam *beam, const SphereBlock *block,
                                        LocalSpheres *local)
{
    F8 p[3], radius = f8Load(block->radius);
    toFrame(bundle, block->x, block->y, block->z, p);
    F8 error = f8MultAdd(f8Set(beam->floatError), largestOf(block->x, block->y, block->z) + radius,
                         f8Set(beam->errorBase));
    f8Store(local->x, p[0]);
    f8Store(local->y, p[1]);
    f8Store(local->z, p[2]);
    f8Store(local->radius, radius);
    f8Store(local->error, error);
    F8 size = radius + error, zero = f8Set(0), w = bundle->isParallel ? f8Set(1) : p[2];
    I8 inside = p[2] - size <= f8Set(beam->reach);
    inside &= f8MultAdd(f8Set(beam->uMinLength), size, f8NegMultAdd(f8Set(beam->uMin), w, p[0])) >= zero;
    inside &= f8MultAdd(f8Set(beam->uMaxLength), size, f8MultSub(f8Set(beam->uMax), w, p[0])) >= zero;
    inside &= f8MultAdd(f8Set(beam->vMinLength), size, f8NegMultAdd(f8Set(beam->vMin), w, p[1])) >= zero;
    inside &= f8MultAdd(f8Set(beam->vMaxLength), size, f8MultSub(f8Set(beam->vMax), w, p[1])) >= zero;
    return maskBits(inside);
}

/* The packets that a sphere of this centre and size (its radius and d) may meet, as bits. */
static inline unsigned packetsMeetSphere(const Bundle *bundle, const Beam *beam, float x, float y, float z,
                                         float size)
{
    F8 px = f8Set(x), py = f8Set(y), w = f8Set(bundle->isParallel ? 1 : z), s = f8Set(size), zero = f8Set(0);
    I8 inside = f8MultAdd(s, beam->packetUMinLength, f8NegMultAdd(beam->packetUMin, w, px)) >= zero;
    inside &= f8MultAdd(s, beam->packetUMaxLength, f8MultSub(beam->packetUMax, w, px)) >= zero;
    inside &= f8MultAdd(s, beam->packetVMinLength, f8NegMultAdd(beam->packetVMin, w, py)) >= zero;
    inside &= f8MultAdd(s, beam->packetVMaxLength, f8MultSub(beam->packetVMax, w, py)) >= zero;
    return maskBits(inside);
}

/* Where the eight rays of a packet meet a sphere. */
typedef struct SphereDepths {
    I8 possible;    /* the ray may meet it */
    I8 sure;        /* and surely does */
    F8 entry, exit; /* the two depths */
    F8 error;       /* of both */
} SphereDepths;

/* What the rays of a packet have in common with one sphere. */
typedef struct OneSphere {
    float x, y, z, squaredRadius;
    float margin; /* of the discriminant: slope (2 r d + d^2), and its rounding */
    float error;  /* d */
} OneSphere;

static inline OneSphere pickSphere(const Beam *beam, const LocalSpheres *local, int i)
{
    float r = local->radius[i], d = local->error[i];
    OneSphere one = {
        .x = local->x[i], .y = local->y[i], .z = local->z[i], .squaredRadius = r * r, .error = d};
    one.margin = beam->slopeMax * (2 * r * d + d * d + 0x1p-21f * r * r);
    return one;
}

/* With e = c - w (u, v, 1), w = z of a central ray and 1 of a parallel one, the squared distance of the
 * centre from the ray's line is (ex^2 + ey^2 + (ex v - ey u)^2) / slope, for a parallel ray ex^2 + ey^2: no
 * difference of large numbers (compare sphere.c). */
static inline SphereDepths sphereDepths(const Bundle *bundle, int p, const OneSphere *one)
{
    F8 u = bundle->u[p], v = bundle->v[p], x = f8Set(one->x), y = f8Set(one->y), z = f8Set(one->z);
    F8 ex, ey, squared, middle;
    F8 reach = f8Set(one->squaredRadius);
    if (bundle->isParallel) {
        ex = x - u;
        ey = y - v;
        squared = f8MultAdd(ey, ey, ex * ex);
        middle = z;
    } else {
        ex = f8NegMultAdd(u, z, x);
        ey = f8NegMultAdd(v, z, y);
        F8 ez = f8MultSub(ex, v, ey * u);
        squared = f8MultAdd(ez, ez, f8MultAdd(ey, ey, ex * ex));
        middle = f8MultAdd(x, u, f8MultAdd(y, v, z));
        reach = reach * bundle->slope[p];
    }
    F8 discriminant = reach - squared, margin = f8Set(one->margin);
    SphereDepths depths = {.possible = discriminant > -margin};
    if (maskBits(depths.possible) == 0)
        return depths;
    F8 atLeast = f8Max(discriminant, margin), root = f8Sqrt(atLeast);
    depths.sure = discriminant > margin;
    depths.entry = (middle - root) * bundle->inverseSlope[p];
    depths.exit = (middle + root) * bundle->inverseSlope[p];
    /* sqrt(x) - sqrt(x - m) <= m / sqrt(x). */
    depths.error = margin / root + f8Set(2 * one->error);
    return depths;
}

/* ---- Triangles ---- */

/* Eight triangles in the frame. The ray (u, v) passes the edge opposite corner i on the inner side when
 * edges[i] . (u, v, 1) > 0; its depth, or of a central bundle 1 over it, is depth . (u, v, 1). */
typedef struct LocalTriangles {
    _Alignas(32) float uMin[8], uMax[8], vMin[8],
        vMax[8]; /* of the corners, as rays go to them; with errors */
    float edges[3][3][8];
    float depth[3][8];
    float edgeMargin[8]; /* 3 d L sqrt(slope), L the longest edge; INFINITY: only the referee knows */
    float depthScale[8]; /* a depth is wrong by 2 d (1 + depthScale / (depthSlope - depthMargin)) */
    float normal[3][8];  /* whose product with (u, v, 1) is depthSlope: the slope of the ray to the plane */
    float depthMargin[8];
    float error[8]; /* d */
} LocalTriangles;

static inline F8 least3(F8 a, F8 b, F8 c)
{
    return f8Min(a, f8Min(b, c));
}

static inline F8 largest3(F8 a, F8 b, F8 c)
{
    return f8Max(a, f8Max(b, c));
}

/* Work out the edges and planes of eight triangles; p: their corners in the frame; d: their errors. */
static inline void setUpTriangles(bool isParallel, float slopeRoot, F8 p[3][3], F8 d, LocalTriangles *local)
{
    F8 one = f8Set(1), zero = f8Set(0);
    F8 sides[3][3], longest = zero;
    for (int i = 0; i < 3; i++) {
        int b = (i + 1) % 3, c = (i + 2) % 3;
        F8 squared = zero;
        for (int axis = 0; axis < 3; axis++) {
            sides[i][axis] = p[c][axis] - p[b][axis];
            squared = f8MultAdd(sides[i][axis], sides[i][axis], squared);
        }
        longest = f8Max(longest, squared);
    }
    longest = f8Sqrt(longest);

    /* The plane through the rays' origin and an edge, or along the rays: corner x edge. */
    F8 edges[3][3];
    for (int i = 0; i < 3; i++) {
        int b = (i + 1) % 3;
        F8 w = isParallel ? one : p[b][2], side = isParallel ? zero : sides[i][2];
        edges[i][0] = f8MultSub(p[b][1], side, w * sides[i][1]);
        edges[i][1] = f8MultSub(w, sides[i][0], p[b][0] * side);
        edges[i][2] = f8MultSub(p[b][0], sides[i][1], p[b][1] * sides[i][0]);
    }

    /* The triangle's own plane. */
    F8 normal[3];
    for (int axis = 0; axis < 3; axis++) {
        int j = (axis + 1) % 3, k = (axis + 2) % 3;
        normal[axis] = f8MultSub(sides[1][j], sides[2][k], sides[1][k] * sides[2][j]);
    }
    F8 height = f8MultAdd(normal[0], p[0][0], f8MultAdd(normal[1], p[0][1], normal[2] * p[0][2]));
    F8 length =
        f8Sqrt(f8MultAdd(normal[0], normal[0], f8MultAdd(normal[1], normal[1], normal[2] * normal[2])));
    F8 normalError = f8Set(5) * d * longest;

    /* Turn it so that the inner sides are positive; where that is not sure, ask the referee. */
    F8 facing = isParallel ? normal[2] : height;
    F8 facingError =
        isParallel ? normalError : f8MultAdd(f8Set(4) * d, length, f8Set(0x1p-20f) * f8Abs(height));
    I8 unsure = ~(f8Abs(facing) > facingError);
    F8 sign = f8Select(facing < zero, f8Set(-1), one);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            f8Store(local->edges[i][k], edges[i][k] * sign);
    f8Store(local->edgeMargin,
            f8Select(unsure, f8Set(INFINITY), f8Set(3 * slopeRoot) * d * longest + f8Set(1e-36f)));
    f8Store(local->depthMargin, f8Select(unsure, f8Set(INFINITY), normalError * f8Set(slopeRoot)));
    /* The normal is wrong by some roundings of the product of two sides, 8 x 2^-24 L^2, which up to L from
     * the corner turns the plane away by more than d where the triangle is thin. */
    f8Store(local->depthScale, f8MultAdd(longest * longest, f8Set(0x1p-22f) * longest / d, length));
    f8Store(local->error, d);
    F8 inverse = one / (isParallel ? normal[2] : height);
    for (int k = 0; k < 3; k++)
        f8Store(local->normal[k], normal[k] * sign);
    if (isParallel) {
        /* z = (height - nx u - ny v) / nz. */
        f8Store(local->depth[0], -normal[0] * inverse);
        f8Store(local->depth[1], -normal[1] * inverse);
        f8Store(local->depth[2], height * inverse);
        f8Store(local->normal[0], zero);
        f8Store(local->normal[1], zero);
    } else {
        /* 1 / z = (nx u + ny v + nz) / height. */
        for (int k = 0; k < 3; k++)
            f8Store(local->depth[k], normal[k] * inverse);
    }
}

/* Which of the triangles the beam meets, as bits. A ray to a point of a triangle has u and v between those of
 * the corners, unless a corner is beside the rays' origin or behind it: then nothing is known. */
static inline unsigned beamMeetsTriangles(const Bundle *bundle, const Beam *beam, const TriangleBlock *block,
                                          LocalTriangles *local)
{
    F8 p[3][3], largest = f8Set(0), one = f8Set(1);
    for (int c = 0; c < 3; c++) {
        toFrame(bundle, block->corners[c][0], block->corners[c][1], block->corners[c][2], p[c]);
        largest = f8Max(largest, largestOf(block->corners[c][0], block->corners[c][1], block->corners[c][2]));
    }
    F8 d = f8MultAdd(f8Set(beam->floatError), largest, f8Set(beam->errorBase));
    F8 zMin = least3(p[0][2], p[1][2], p[2][2]), zMax = largest3(p[0][2], p[1][2], p[2][2]);
    F8 u[3], v[3], margin = d;
    for (int c = 0; c < 3; c++) {
        F8 inverse = bundle->isParallel ? one : one / p[c][2];
        u[c] = p[c][0] * inverse;
        v[c] = p[c][1] * inverse;
    }
    F8 uMin = least3(u[0], u[1], u[2]), uMax = largest3(u[0], u[1], u[2]);
    F8 vMin = least3(v[0], v[1], v[2]), vMax = largest3(v[0], v[1], v[2]);
    I8 known = i8Set(-1);
    if (!bundle->isParallel) {
        /* A corner moved by d goes from u to less than u + 2 d (1 + |u|) / z away, when z is above 2 d. */
        F8 size = f8Max(f8Max(f8Abs(uMin), f8Abs(uMax)), f8Max(f8Abs(vMin), f8Abs(vMax)));
        margin = f8Set(2) * d * (one + size) / zMin;
        known = zMin > f8Set(4) * d;
    }
    F8 low = f8Set(-INFINITY), high = f8Set(INFINITY);
    uMin = f8Select(known, uMin - margin, low);
    uMax = f8Select(known, uMax + margin, high);
    vMin = f8Select(known, vMin - margin, low);
    vMax = f8Select(known, vMax + margin, high);
    I8 inside = (zMin - d <= f8Set(beam->reach)) & (zMax + d >= f8Set(bundle->startDepth));
    inside &= (uMax >= f8Set(beam->uMin)) & (uMin <= f8Set(beam->uMax));
    inside &= (vMax >= f8Set(beam->vMin)) & (vMin <= f8Set(beam->vMax));
    unsigned met = maskBits(inside);
    if (met == 0)
        return 0;
    f8Store(local->uMin, uMin);
    f8Store(local->uMax, uMax);
    f8Store(local->vMin, vMin);
    f8Store(local->vMax, vMax);
    setUpTriangles(bundle->isParallel, beam->slopeRoot, p, d, local);
    return met;
}

/* The packets that triangle i may meet, as bits. */
static inline unsigned packetsMeetTriangle(const Beam *beam, const LocalTriangles *local, int i)
{
    return maskBits(
        (f8Set(local->uMax[i]) >= beam->packetUMin) & (f8Set(local->uMin[i]) <= beam->packetUMax) &
        (f8Set(local->vMax[i]) >= beam->packetVMin) & (f8Set(local->vMin[i]) <= beam->packetVMax));
}

/* Where the eight rays of a packet meet a triangle. */
typedef struct TriangleDepths {
    I8 possible, sure;
    F8 depth, error;
} TriangleDepths;

static inline F8 linear(F8 u, F8 v, float a, float b, float c)
{
    return f8MultAdd(u, f8Set(a), f8MultAdd(v, f8Set(b), f8Set(c)));
}

static inline TriangleDepths triangleDepths(const Bundle *bundle, int p, const LocalTriangles *t, int i)
{
    F8 u = bundle->u[p], v = bundle->v[p];
    F8 inner = least3(linear(u, v, t->edges[0][0][i], t->edges[0][1][i], t->edges[0][2][i]),
                      linear(u, v, t->edges[1][0][i], t->edges[1][1][i], t->edges[1][2][i]),
                      linear(u, v, t->edges[2][0][i], t->edges[2][1][i], t->edges[2][2][i]));
    F8 margin = f8Set(t->edgeMargin[i]);
    TriangleDepths depths = {.possible = inner >= -margin};
    if (maskBits(depths.possible) == 0)
        return depths;
    F8 depth = linear(u, v, t->depth[0][i], t->depth[1][i], t->depth[2][i]);
    depths.depth = bundle->isParallel ? depth : f8Set(1) / depth;
    /* A ray along the plane has no depth that is sure. */
    F8 slope = f8Abs(linear(u, v, t->normal[0][i], t->normal[1][i], t->normal[2][i]));
    F8 sureSlope = slope - f8Set(t->depthMargin[i]);
    I8 steep = sureSlope > f8Set(t->depthMargin[i]);
    depths.sure = (inner > margin) & steep;
    F8 twice = f8Set(2 * t->error[i]);
    F8 error = twice * (f8Set(1) + f8Set(t->depthScale[i]) / sureSlope);
    depths.error = f8Select(steep, error, f8Set(INFINITY));
    depths.depth = f8Select(steep, depths.depth, f8Set(0));
    return depths;
}

/* ---- Boxes, ray by ray ---- */

/* The rays in the scaled world, ready for boxes. */
typedef struct Slabs {
    bool isReady;
    F8 inverses[3][PACKETS]; /* 1 / direction */
    F8 origins[3][PACKETS];  /* of parallel rays */
} Slabs;

static inline void prepareSlabs(const Bundle *bundle, Slabs *slabs)
{
    if (slabs->isReady)
        return;
    slabs->isReady = true;
    for (int axis = 0; axis < 3; axis++) {
        F8 x = f8Set(bundle->axes[0][axis]), y = f8Set(bundle->axes[1][axis]);
        F8 z = f8Set(bundle->axes[2][axis]);
        for (int p = 0; p < PACKETS; p++) {
            F8 across = f8MultAdd(x, bundle->u[p], y * bundle->v[p]);
            F8 direction = bundle->isParallel ? z : across + z;
            if (bundle->isParallel)
                slabs->origins[axis][p] = across + f8Set(bundle->origin[axis]);
            /* Next to nothing in place of 0, whose inverse times 0 is no number. */
            I8 tiny = f8Abs(direction) < f8Set(1e-12f);
            slabs->inverses[axis][p] = f8Set(1) / f8Select(tiny, f8Set(1e-12f), direction);
        }
    }
}

/* The two planes of a box along each axis, made larger by the margin, and of a central bundle seen from where
 * the rays start. */
typedef struct SlabBox {
    float low[3], high[3];
} SlabBox;

static inline SlabBox createSlabBox(const Bundle *bundle, const Beam *beam, const float *floats, int child)
{
    SlabBox box;
    float margin = 2 * beam->nodeError;
    for (int axis = 0; axis < 3; axis++) {
        float from = bundle->isParallel ? 0 : bundle->origin[axis];
        box.low[axis] = floats[8 * axis + child] - margin - from;
        box.high[axis] = floats[8 * axis + child + 24] + margin - from;
    }
    return box;
}

/* The rays of a packet that may meet a box before their farthest depth. */
static inline unsigned packetMeetsBox(const Bundle *bundle, const Slabs *slabs, int p, const SlabBox *box)
{
    F8 entry = f8Set(bundle->startDepth), exit = bundle->farthest[p];
    for (int axis = 0; axis < 3; axis++) {
        F8 inverse = slabs->inverses[axis][p], low = f8Set(box->low[axis]), high = f8Set(box->high[axis]);
        if (bundle->isParallel) {
            low -= slabs->origins[axis][p];
            high -= slabs->origins[axis][p];
        }
        F8 t1 = low * inverse, t2 = high * inverse;
        entry = f8Max(entry, f8Min(t1, t2));
        exit = f8Min(exit, f8Max(t1, t2));
    }
    /* The larger end, whatever its sign, is wrong by a few units in the last place. */
    return maskBits(entry <= exit + f8Set(1e-6f) * f8Abs(exit)) & bundle->active[p];
}

#endif
