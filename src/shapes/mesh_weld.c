/* mesh_weld.c - one vertex for each position, and whether the mesh is closed; see mesh_build.h.
 *
 * Two corners are in the same place when their coordinates are equal, not when their indices are: files
 * repeat a position for each normal or texture coordinate that it is used with. Both steps take linear
 * time by hashing (open addressing; Knuth, The Art of Computer Programming 3, section 6.4, algorithm L).
 */
#include "base/cancel.h"
#include "shapes/mesh_build.h"
#include "shapes/triangle.h"

#include <stdlib.h>
#include <string.h>

enum {
    POLL_INTERVAL = 1 << 16 /* corners between two looks at cancelRequested */
};

/* Mix all bits into all bits (the finisher of MurmurHash3). */
static uint64_t mixBits(uint64_t x)
{
    x ^= x >> 33;
    x *= 0xff51afd7ed558ccdu;
    x ^= x >> 33;
    x *= 0xc4ceb9fe1a85ec53u;
    x ^= x >> 33;
    return x;
}

/* p: without -0, which is equal to 0 and has other bits. */
static uint64_t hashPosition(Vector3D p)
{
    uint64_t bits[3];
    memcpy(bits, &p, sizeof bits);
    return mixBits(bits[0] + mixBits(bits[1] + mixBits(bits[2])));
}

static bool samePosition(Vector3D a, Vector3D b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* The smallest power of two that is at least twice the number. */
static size_t tableSize(size_t number)
{
    size_t size = 16;
    while (size < 2 * number)
        size *= 2;
    return size;
}

Status weldVertices(MeshData *mesh)
{
    /* The table has the number of a vertex plus 1, or 0; newNumber has the same for each old vertex. */
    size_t size = tableSize(mesh->vertexCount);
    uint32_t *table = calloc(size, sizeof *table);
    uint32_t *newNumber = calloc(mesh->vertexCount + 1, sizeof *newNumber);
    Vector3D *welded = malloc((mesh->vertexCount + 1) * sizeof *welded);
    Status status = statusOk();
    uint32_t count = 0;
    if (table == NULL || newNumber == NULL || welded == NULL)
        status = statusOutOfMemory();

    for (size_t i = 0; i < 3 * mesh->triangleCount && statusIsOk(&status); i++) {
        if (i % POLL_INTERVAL == 0 && cancelRequested())
            status = statusInterrupted();
        uint32_t *corner = &mesh->triangles[i / 3].vertices[i % 3];
        if (newNumber[*corner] == 0) {
            /* Look for the position; where it is not in the table, it gets the next number. */
            Vector3D p = addVectors(mesh->vertices[*corner], createVector(0, 0, 0)); /* -0 becomes 0 */
            size_t slot = hashPosition(p) & (size - 1);
            while (table[slot] != 0 && !samePosition(welded[table[slot] - 1], p))
                slot = (slot + 1) & (size - 1);
            if (table[slot] == 0) {
                welded[count] = p;
                table[slot] = ++count;
            }
            newNumber[*corner] = table[slot];
        }
        *corner = newNumber[*corner] - 1;
    }
    free(table);
    free(newNumber);
    if (!statusIsOk(&status)) {
        free(welded);
        return status;
    }

    /* Give back the memory of those that were not used. */
    Vector3D *smaller = realloc(welded, (count > 0 ? count : 1) * sizeof *welded);
    free(mesh->vertices);
    mesh->vertices = smaller != NULL ? smaller : welded;
    mesh->vertexCount = count;
    return status;
}

/* An edge between two vertices, and how many triangles run along it, up and down the numbers. */
typedef struct Edge {
    uint32_t low, high; /* both 0: the slot is free */
    uint8_t up, down;
} Edge;

static bool hasTwoEqualCorners(const MeshTriangle *triangle)
{
    const uint32_t *v = triangle->vertices;
    return v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
}

/* Count one more triangle along an edge. False if the edge has had one in that direction already, or if
 * there is no place left for a new edge. */
static bool addEdge(Edge *table, size_t size, size_t *placesLeft, uint32_t from, uint32_t to)
{
    uint32_t low = from < to ? from : to, high = from < to ? to : from;
    size_t slot = mixBits((uint64_t)high << 32 | low) & (size - 1);
    while (table[slot].high != 0 && (table[slot].low != low || table[slot].high != high))
        slot = (slot + 1) & (size - 1);
    if (table[slot].high == 0) {
        if (*placesLeft == 0)
            return false;
        --*placesLeft;
        table[slot].low = low;
        table[slot].high = high;
    }
    uint8_t *count = from < to ? &table[slot].up : &table[slot].down;
    return ++*count == 1;
}

Status findWhetherClosed(MeshData *mesh)
{
    /* A closed mesh has three edges for each two triangles; with more it is open. */
    size_t placesLeft = mesh->triangleCount + mesh->triangleCount / 2;
    size_t size = tableSize(placesLeft);
    Edge *table = calloc(size, sizeof *table);
    if (table == NULL)
        return statusOutOfMemory();
    bool closed = true;
    size_t counted = 0, edges = placesLeft;
    Status status = statusOk();
    for (size_t i = 0; i < mesh->triangleCount && closed; i++) {
        if (i % POLL_INTERVAL == 0 && cancelRequested()) {
            status = statusInterrupted();
            break;
        }
        if (hasTwoEqualCorners(&mesh->triangles[i]))
            continue;
        const uint32_t *v = mesh->triangles[i].vertices;
        for (int j = 0; j < 3 && closed; j++)
            closed = addEdge(table, size, &placesLeft, v[j], v[(j + 1) % 3]);
        counted++;
    }
    /* No direction of an edge was used twice, so each was used both ways if there are half as many edges. */
    edges -= placesLeft;
    mesh->isClosed = closed && counted > 0 && 2 * edges == 3 * counted;
    free(table);
    return status;
}

void dropDegenerateTriangles(MeshData *mesh)
{
    size_t kept = 0;
    for (size_t i = 0; i < mesh->triangleCount; i++) {
        Vector3D corners[3];
        meshCorners(mesh, i, corners);
        if (isTriangle(corners))
            mesh->triangles[kept++] = mesh->triangles[i];
    }
    mesh->triangleCount = kept;
}
