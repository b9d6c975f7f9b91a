/* mesh_normals.c - the normals at the corners of a smooth mesh; see mesh_build.h.
 *
 * Where the file has none, a corner's normal is the mean of those of all faces that share its position,
 * each weighted by its angle there (Thuermer and Wuethrich 1998, "Computing vertex normals from polygonal
 * facets", Journal of Graphics Tools 3(1), eq. 1). Weighted so, it does not depend on how a face is cut
 * into triangles.
 */
#include "shapes/mesh_build.h"

#include <stdlib.h>

/* A mean shorter than this is what rounding leaves of faces that cancel each other, back to back. */
static const double SHORTEST_MEAN = 1e-9;

/* Add each triangle's normal, times its angle at the corner, to the sums of its three positions. */
static void addWeightedNormals(const MeshData *mesh, Vector3D *sums)
{
    for (size_t i = 0; i < mesh->triangleCount; i++) {
        Vector3D corners[3];
        meshCorners(mesh, i, corners);
        Vector3D normal = normalize(triangleCross(corners));
        for (int j = 0; j < 3; j++) {
            Vector3D toNext = subVectors(corners[(j + 1) % 3], corners[j]);
            Vector3D toPrevious = subVectors(corners[(j + 2) % 3], corners[j]);
            double angle = atan2(norm(cross(toNext, toPrevious)), dot(toNext, toPrevious));
            Vector3D *sum = &sums[mesh->triangles[i].vertices[j]];
            *sum = addVectors(*sum, multVector(normal, angle));
        }
    }
}

/* Bring the given normals to unit length; corners whose normal is 0 lose it. Returns how many have none. */
static size_t takeGivenNormals(MeshData *mesh)
{
    for (size_t i = 0; i < mesh->normalCount; i++)
        mesh->normals[i] = normalize(mesh->normals[i]);
    size_t absent = 0;
    for (size_t i = 0; i < 3 * mesh->triangleCount; i++) {
        uint32_t *index = &mesh->triangles[i / 3].normals[i % 3];
        if (*index != MESH_NO_NORMAL && !(norm(mesh->normals[*index]) > 0.5))
            *index = MESH_NO_NORMAL;
        absent += *index == MESH_NO_NORMAL;
    }
    return absent;
}

Status completeNormals(MeshData *mesh)
{
    if (!mesh->isSmooth) {
        free(mesh->normals);
        mesh->normals = NULL;
        mesh->normalCount = 0;
        return statusOk();
    }
    size_t absent = takeGivenNormals(mesh);
    if (absent == 0)
        return statusOk();

    /* Each absent one adds one at most: that of its position, or that of its face. */
    if (absent >= MESH_NO_NORMAL - mesh->normalCount)
        return statusError(STATUS_SCENE, "The mesh has too many normals; cut it into several files.");
    Vector3D *normals = realloc(mesh->normals, (mesh->normalCount + absent) * sizeof *normals);
    if (normals != NULL)
        mesh->normals = normals;
    Vector3D *sums = calloc(mesh->vertexCount, sizeof *sums);
    uint32_t *indexOfPosition = calloc(mesh->vertexCount, sizeof *indexOfPosition);
    if (normals == NULL || sums == NULL || indexOfPosition == NULL) {
        free(sums);
        free(indexOfPosition);
        return statusOutOfMemory();
    }
    addWeightedNormals(mesh, sums);

    for (size_t i = 0; i < 3 * mesh->triangleCount; i++) {
        MeshTriangle *triangle = &mesh->triangles[i / 3];
        if (triangle->normals[i % 3] != MESH_NO_NORMAL)
            continue;
        uint32_t position = triangle->vertices[i % 3];
        Vector3D sum = sums[position];
        bool cancelsOut = norm(sum) < SHORTEST_MEAN;
        if (indexOfPosition[position] == 0 || cancelsOut) {
            Vector3D corners[3];
            meshCorners(mesh, i / 3, corners);
            normals[mesh->normalCount++] = normalize(cancelsOut ? triangleCross(corners) : sum);
            indexOfPosition[position] = (uint32_t)mesh->normalCount; /* plus 1: 0 says none yet */
        }
        triangle->normals[i % 3] = indexOfPosition[position] - 1;
    }
    free(sums);
    free(indexOfPosition);
    Vector3D *smaller = realloc(mesh->normals, mesh->normalCount * sizeof *smaller);
    if (smaller != NULL)
        mesh->normals = smaller;
    return statusOk();
}
