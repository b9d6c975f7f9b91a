/* mesh_pov.c - a mesh for POV-Ray; see writeMeshPov in mesh.h.
 *
 * POV-Ray has two forms of it. A union of triangles keeps doubles but has no inside. Its mesh2 has an inside
 * (odd crossings along inside_vector) but keeps vertices, planes and normals in float. Measured on the 69,666
 * triangles of a bunny, 640 x 480 at 16 bit, one light, POV-Ray 3.7.0.10 on two threads: smooth, 77 pixels of
 * the union differ from ours, each by 1/65535, and 254 of mesh2, one by 2410; flat, 74 and 2107. Reading and
 * bounding take 0.5 s against 0.2 s, the file 21 MB against 7 MB, the picture 0.13 s against 0.2 s. So the
 * union is written wherever no inside is needed. Glass does not need it unless the camera is in it: 180
 * pixels of a smooth glass bunny differ by 1, against 4,010 by up to 2,606 of mesh2. POV-Ray ignores a smooth
 * triangle, but not one in a mesh, unless all three normals are on one side of it. Those that are not, on
 * sharp edges, go into a mesh of their own within the union.
 */
#include "shapes/mesh_build.h"
#include "shapes/shape.h"

#include <stdlib.h>

/* Vectors as text, each written once: a vertex is used by some six triangles. */
typedef struct VectorTexts {
    Text text;
    size_t *starts; /* of each vector, and the end */
} VectorTexts;

/* Text without memory fails, and then pov does too. */
static VectorTexts writeVectors(const Vector3D *vectors, size_t count, double scale)
{
    VectorTexts texts = {.starts = malloc((count + 1) * sizeof *texts.starts)};
    if (texts.starts == NULL) {
        texts.text.failed = true;
        return texts;
    }
    for (size_t i = 0; i < count; i++) {
        texts.starts[i] = texts.text.length;
        textAppendPovVector(&texts.text, vectors[i], scale);
    }
    texts.starts[count] = texts.text.length;
    return texts;
}

static void appendVectorText(Text *pov, const VectorTexts *texts, size_t index)
{
    if (texts->text.failed) {
        pov->failed = true;
        return;
    }
    size_t start = texts->starts[index];
    textAppendBytes(pov, texts->text.data + start, texts->starts[index + 1] - start);
}

static void freeVectorTexts(VectorTexts *texts)
{
    textFree(&texts->text);
    free(texts->starts);
}

/* ---- The exact surface ---- */

/* Whether POV-Ray would draw the triangle outside a mesh. */
static bool standsAlone(const Object *object, size_t triangle)
{
    const MeshData *mesh = object->mesh.data;
    if (!mesh->isSmooth)
        return true;
    Vector3D corners[3], normals[3];
    meshCorners(mesh, triangle, corners);
    for (int j = 0; j < 3; j++)
        normals[j] = mesh->normals[mesh->triangles[triangle].normals[j]];
    return normalsAgree(object, normalize(triangleCross(corners)), normals);
}

static void writeTriangle(const MeshData *mesh, size_t triangle, const VectorTexts *vertices,
                          const VectorTexts *normals, Text *pov)
{
    textAppend(pov, mesh->isSmooth ? "smooth_triangle { " : "triangle { ");
    for (int j = 0; j < 3; j++) {
        if (j > 0)
            textAppend(pov, ", ");
        appendVectorText(pov, vertices, mesh->triangles[triangle].vertices[j]);
        if (mesh->isSmooth) {
            textAppend(pov, ", ");
            appendVectorText(pov, normals, mesh->triangles[triangle].normals[j]);
        }
    }
}

static void writeExactSurface(const Object *object, double scale, Text *pov)
{
    const MeshData *mesh = object->mesh.data;
    VectorTexts vertices = writeVectors(mesh->vertices, mesh->vertexCount, scale);
    VectorTexts normals = writeVectors(mesh->normals, mesh->normalCount, 1);
    size_t agreeing = 0;
    for (size_t i = 0; i < mesh->triangleCount; i++)
        agreeing += standsAlone(object, i);
    size_t others = mesh->triangleCount - agreeing;

    /* A single triangle needs no union, of which POV-Ray expects two parts. */
    if (agreeing == 1 && others == 0) {
        writeTriangle(mesh, 0, &vertices, &normals, pov);
    } else {
        if (agreeing > 0)
            textAppend(pov, "union {\n");
        for (size_t i = 0; i < mesh->triangleCount; i++)
            if (standsAlone(object, i)) {
                writeTriangle(mesh, i, &vertices, &normals, pov);
                textAppend(pov, " }\n");
            }
        if (others > 0) {
            textAppend(pov, "mesh {\n");
            for (size_t i = 0; i < mesh->triangleCount; i++)
                if (!standsAlone(object, i)) {
                    writeTriangle(mesh, i, &vertices, &normals, pov);
                    textAppend(pov, " }\n");
                }
            if (agreeing > 0)
                textAppend(pov, "}\n");
        }
    }
    freeVectorTexts(&vertices);
    freeVectorTexts(&normals);
}

/* ---- The solid ---- */

static void writeVectorList(Text *pov, const char *name, const Vector3D *vectors, size_t count, double scale)
{
    textAppendFormat(pov, "%s { %zu", name, count);
    for (size_t i = 0; i < count; i++) {
        textAppend(pov, ",\n");
        textAppendPovVector(pov, vectors[i], scale);
    }
    textAppend(pov, " }\n");
}

static void writeSolid(const Object *object, double scale, Text *pov)
{
    const MeshData *mesh = object->mesh.data;
    textAppend(pov, "mesh2 {\n");
    writeVectorList(pov, "vertex_vectors", mesh->vertices, mesh->vertexCount, scale);
    if (mesh->isSmooth)
        writeVectorList(pov, "normal_vectors", mesh->normals, mesh->normalCount, 1);
    textAppendFormat(pov, "face_indices { %zu", mesh->triangleCount);
    for (size_t i = 0; i < mesh->triangleCount; i++) {
        const uint32_t *v = mesh->triangles[i].vertices;
        textAppendFormat(pov, ",\n<%u, %u, %u>", v[0], v[1], v[2]);
    }
    textAppend(pov, " }\n");
    if (mesh->isSmooth) {
        textAppendFormat(pov, "normal_indices { %zu", mesh->triangleCount);
        for (size_t i = 0; i < mesh->triangleCount; i++) {
            const uint32_t *n = mesh->triangles[i].normals;
            textAppendFormat(pov, ",\n<%u, %u, %u>", n[0], n[1], n[2]);
        }
        textAppend(pov, " }\n");
    }
    /* Parallel to nothing that a modeller draws. */
    textAppend(pov, "inside_vector <0.5127, 0.7441, 0.4283>\n");
}

void writeMeshPov(const struct Object *object, double scale, bool solid, Text *pov)
{
    if (solid)
        writeSolid(object, scale, pov);
    else
        writeExactSurface(object, scale, pov);
}
