/* ray_triangle.h - where a ray meets a triangle, so that no ray slips between two that share an edge.
 *
 * Woop, Benthin and Wald 2013, "Watertight ray/triangle intersection", JCGT 2(1), section 3: shear space
 * so that the ray becomes the z axis; then it is a question in the plane on which side of the three edges
 * the origin lies. The test of an edge from b to c is the exact negative of that from c to b, because the
 * same two products are subtracted the other way round; so for a ray that one triangle leaves out at the
 * edge, the neighbour decides the other way. An edge itself belongs to both. The same holds round a
 * vertex: it has one place in the plane, and the edges that leave it go round that place.
 */
#ifndef ECLAIRAGE_SHAPES_RAY_TRIANGLE_H
#define ECLAIRAGE_SHAPES_RAY_TRIANGLE_H

#include "geometry.h"

#include <stdbool.h>

/* Below this cosine to the normal a ray counts as parallel to the plane. */
#define RAY_TRIANGLE_PARALLEL 0x1p-40

/* A corner's share below it is next to an edge. */
#define RAY_TRIANGLE_NEAR_EDGE 0x1p-40

/* A ray made ready for many triangles: the shear that turns it into the z axis. */
typedef struct ShearedRay {
    Vector3D origin, direction;
    int x, y, z; /* which coordinate becomes x, y, z: z is that of the steepest descent */
    double shearX, shearY, shearZ;
} ShearedRay;

/* Where the ray meets the triangle: its distance, and the shares of the corners, which are at least 0 and
 * have the sum 1. isOnEdge: it passes through an edge or a vertex, or so near that rounding decides. */
typedef struct TriangleHit {
    double distance;
    double share1, share2; /* of the second and the third corner; the first has the rest */
    bool isOnEdge;
} TriangleHit;

static inline double coordinateOf(Vector3D v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/* ray: of any direction but 0. */
static inline ShearedRay shearRay(const Ray *ray)
{
    Vector3D d = ray->direction, size = {fabs(d.x), fabs(d.y), fabs(d.z)};
    int z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    int x = (z + 1) % 3, y = (z + 2) % 3;
    double along = coordinateOf(d, z);
    return (ShearedRay){.origin = ray->origin,
                        .direction = ray->direction,
                        .x = x,
                        .y = y,
                        .z = z,
                        .shearX = coordinateOf(d, x) / along,
                        .shearY = coordinateOf(d, y) / along,
                        .shearZ = 1 / along};
}

/* Whether the line of the ray meets the triangle a, b, c from either side; the distance may be negative. A
 * line within the triangle's plane misses. On a miss the hit is untouched. */
static inline bool intersectTriangle(const ShearedRay *ray, Vector3D a, Vector3D b, Vector3D c,
                                     TriangleHit *hit)
{
    /* Move the origin of the ray to 0 and its direction to the z axis. */
    Vector3D toA = subVectors(a, ray->origin), toB = subVectors(b, ray->origin);
    Vector3D toC = subVectors(c, ray->origin);
    double az = coordinateOf(toA, ray->z), bz = coordinateOf(toB, ray->z), cz = coordinateOf(toC, ray->z);
    double ax = coordinateOf(toA, ray->x) - ray->shearX * az,
           ay = coordinateOf(toA, ray->y) - ray->shearY * az;
    double bx = coordinateOf(toB, ray->x) - ray->shearX * bz,
           by = coordinateOf(toB, ray->y) - ray->shearY * bz;
    double cx = coordinateOf(toC, ray->x) - ray->shearX * cz,
           cy = coordinateOf(toC, ray->y) - ray->shearY * cz;

    /* Ask on which side of each edge 0 lies: inside, it is the same side of all. */
    double u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0))
        return false;
    double sum = u + v + w;
    if (sum == 0)
        return false;
    /* A difference of two rounded products never has the wrong sign, but it may be 0. With a triangle that is
     * tiny beside its distance from the ray all of them are; so ask whether it lies round 0 at all. */
    if ((ax > 0 && bx > 0 && cx > 0) || (ax < 0 && bx < 0 && cx < 0) || (ay > 0 && by > 0 && cy > 0) ||
        (ay < 0 && by < 0 && cy < 0))
        return false;

    /* Meet the plane: so a point a little off the surface stays on its side, however thin the triangle is.
     * Where the ray all but lies in the plane, take the depth of the corners, of which u, v and w are the
     * shares. */
    Vector3D normal = normalize(cross(subVectors(b, a), subVectors(c, a)));
    double slope = dot(normal, ray->direction);
    hit->distance = fabs(slope) > RAY_TRIANGLE_PARALLEL ? dot(normal, toA) / slope
                                                        : ray->shearZ * (u * az + v * bz + w * cz) / sum;
    hit->share1 = v / sum;
    hit->share2 = w / sum;
    double nearEdge = RAY_TRIANGLE_NEAR_EDGE * fabs(sum);
    hit->isOnEdge = fabs(u) <= nearEdge || fabs(v) <= nearEdge || fabs(w) <= nearEdge;
    return true;
}

#endif
