/* mesh.h - many triangles as one object, in a tree of boxes so that a ray looks at few of them.
 *
 * Invariant of a built mesh: every triangle's indices are below vertexCount and, if it is smooth,
 * normalCount; no two vertices have the same position, so that an index says where a corner is;
 * degenerate triangles have been left out. A mesh is never changed once it is built, so objects may share
 * one.
 */
#ifndef ECLAIRAGE_SHAPES_MESH_H
#define ECLAIRAGE_SHAPES_MESH_H

#include "base/status.h"
#include "base/text.h"
#include "shapes/intersection.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Given to buildMesh in place of a normal's index: the mean over the faces round the corner. */
#define MESH_NO_NORMAL UINT32_MAX

/* Coordinates above it are an error: products of three would leave the range of a double. */
#define MESH_LARGEST_COORDINATE 1e30

typedef struct MeshTriangle {
    uint32_t vertices[3];
    uint32_t normals[3]; /* of a smooth mesh */
} MeshTriangle;

struct MeshNode;

typedef struct MeshData {
    Vector3D *vertices;
    size_t vertexCount;
    Vector3D *normals; /* of unit length; NULL where the mesh is flat */
    size_t normalCount;
    MeshTriangle *triangles; /* reordered by buildMesh */
    size_t triangleCount;
    bool isSmooth;          /* normals are interpolated over each triangle */
    struct MeshNode *nodes; /* the tree of boxes; see mesh_tree.c */
    size_t nodeCount;
    bool isClosed; /* every edge belongs to exactly two triangles, which run along it in opposite directions,
                    * so the mesh has an inside */
    Bounds bounds;
    double meanEdge; /* the mean length of the triangles' edges: how fine its detail is */
} MeshData;

typedef struct Mesh {
    Material material;
    const MeshData *data; /* not owned by the object */
} Mesh;

/* Read a Wavefront OBJ file (v, vn, f; statements about groups, materials, textures, lines and points are
 * read and ignored) and build the mesh. smooth: with the file's normals, where absent the angle-weighted
 * mean over the faces that share the position (Thuermer and Wuethrich 1998); else flat. Faces of more than
 * three corners are cut into triangles. On success the caller frees it with freeMesh; on failure *mesh is
 * untouched. A file that cannot be read is STATUS_IO, a broken one STATUS_SCENE with the line and column in
 * the OBJ file in the status (0 where the whole file is meant); STATUS_INTERRUPTED when cancelled. */
Status readObjMesh(const char *path, bool smooth, MeshData **mesh);

/* The same from the text of a file, of length bytes with a NUL behind. */
Status parseObjMesh(const char *text, size_t length, bool smooth, MeshData **mesh);

/* Build from vertices, triangles, isSmooth and, for a smooth mesh, normals of any length (one of length 0
 * counts as absent); the other fields are 0. All indices are in range or, of a normal, MESH_NO_NORMAL.
 * The arrays come from malloc and belong to the mesh, which the caller frees with freeMesh, also after a
 * failure: STATUS_SCENE where nothing but degenerate triangles is left, STATUS_INTERRUPTED, out of memory. */
Status buildMesh(MeshData *mesh);

/* Write a mesh object for POV-Ray, as Shape's writePov does. solid: what has an inside there, for a closed
 * mesh that is a part of CSG or contains the camera; the numbers are then single precision. Else the exact
 * surface, which has no inside; glass is right with it too. See mesh_pov.c. */
void writeMeshPov(const struct Object *object, double scale, bool solid, Text *pov);

/* Free it and all in it; NULL is fine. */
void freeMesh(MeshData *mesh);

#endif
