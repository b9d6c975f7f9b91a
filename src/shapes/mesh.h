/* mesh.h - many triangles as one object, in a tree of boxes so that a ray looks at few of them.
 *
 * Invariant: every triangle's indices are below vertexCount, and normals below normalCount; degenerate
 * triangles have been left out. A mesh is never changed once it is built, so objects may share one.
 */
#ifndef ECLAIRAGE_SHAPES_MESH_H
#define ECLAIRAGE_SHAPES_MESH_H

#include "base/status.h"
#include "shapes/intersection.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct MeshTriangle {
    uint32_t vertices[3];
    uint32_t normals[3]; /* of a smooth mesh */
} MeshTriangle;

struct MeshNode;

typedef struct MeshData {
    Vector3D *vertices;
    size_t vertexCount;
    Vector3D *normals; /* of unit length; NULL: the mesh is flat */
    size_t normalCount;
    MeshTriangle *triangles; /* reordered by buildMesh */
    size_t triangleCount;
    struct MeshNode *nodes; /* the tree of boxes; see mesh.c */
    size_t nodeCount;
    bool isClosed; /* every edge belongs to exactly two triangles, so the mesh has an inside */
    Bounds bounds;
} MeshData;

typedef struct Mesh {
    Material material;
    const MeshData *data; /* not owned by the object */
} Mesh;

/* Read a Wavefront OBJ file (v, vn, f; o, g, s, usemtl, mtllib, vt are read and ignored) and build the
 * mesh. smooth: with the file's normals, where absent the angle-weighted mean over the faces that share the
 * position (Thuermer and Wuethrich 1998); else flat. On success the caller frees it with freeMesh. A missing
 * or broken file is STATUS_IO or STATUS_SCENE with the line and column in the OBJ file in the status. */
Status readObjMesh(const char *path, bool smooth, MeshData **mesh);

/* Build from arrays, which the mesh takes over: sets nodes, isClosed and bounds. */
Status buildMesh(MeshData *mesh);

void freeMesh(MeshData *mesh);

#endif
