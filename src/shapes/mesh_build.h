/* mesh_build.h - the steps of buildMesh, and the walk through the finished tree; for mesh.c and its tests. */
#ifndef ECLAIRAGE_SHAPES_MESH_BUILD_H
#define ECLAIRAGE_SHAPES_MESH_BUILD_H

#include "shapes/mesh.h"
#include "shapes/ray_triangle.h"

/* The three corners of a triangle. */
static inline void meshCorners(const MeshData *mesh, size_t triangle, Vector3D corners[3])
{
    for (int i = 0; i < 3; i++)
        corners[i] = mesh->vertices[mesh->triangles[triangle].vertices[i]];
}

/* The cross product of two edges: along the triangle's normal, twice its area long. */
static inline Vector3D triangleCross(const Vector3D corners[3])
{
    return cross(subVectors(corners[1], corners[0]), subVectors(corners[2], corners[0]));
}

/* ---- Steps, in this order ---- */

/* Give each position one vertex, numbered in the order of their use, and drop those not used. */
Status weldVertices(MeshData *mesh);

/* Set isClosed. Triangles with two corners in one place play no part. */
Status findWhetherClosed(MeshData *mesh);

/* Leave out triangles whose area is not more than rounding error. */
void dropDegenerateTriangles(MeshData *mesh);

/* Of a smooth mesh: bring normals to unit length and work out those that are absent. */
Status completeNormals(MeshData *mesh);

/* Set nodes, bounds and meanEdge; triangles are reordered. There is at least one. */
Status buildMeshTree(MeshData *mesh);

/* ---- The tree ---- */

/* Called for a triangle that the ray's line meets. */
typedef void (*MeshVisitor)(void *context, size_t triangle, const TriangleHit *hit);

/* Visit every triangle that the ray meets at 0 < t <= *limit; some others whose t is negative or above the
 * limit may be visited too. The visitor may lower the limit. Order: roughly from near to far. */
void walkMesh(const MeshData *mesh, const Ray *ray, const double *limit, MeshVisitor visit, void *context);

/* The number of levels below which the tree may not grow, for tests. */
enum {
    MESH_TREE_MAX_DEPTH = 80
};

/* One box of the tree, 32 bytes. Boxes contain their triangles: rounded outwards to float. */
typedef struct MeshNode {
    float min[3], max[3];
    uint32_t
        first; /* of a leaf its first triangle, else its second child; the first child is the next node */
    uint32_t count; /* of a leaf's triangles; 0 for an inner node */
} MeshNode;

#endif
