/* obj_read.c - read Wavefront OBJ files; see readObjMesh in mesh.h.
 *
 * The format is that of Wavefront's Advanced Visualizer manual, appendix B1. Read are v (its colours or
 * weight are let pass), vn, and f with corners v, v/vt, v//vn and v/vt/vn; indices count from 1, negative
 * ones back from the newest. Statements about groups, materials, textures, lines and points change no
 * surface and are skipped. Curved surfaces, and words that are no statement at all, are errors, because
 * something would be missing from the picture. One pass; time and memory are linear in the file's length.
 */
#include "base/cancel.h"
#include "base/files.h"
#include "shapes/mesh.h"
#include "shapes/polygon.h"
#include "shapes/text_cursor.h"

#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Lines are counted as int, and a line has a byte at least. */
static const size_t LONGEST_FILE = INT_MAX;

enum {
    CANCEL_POLL_LINES = 4096
};

/* A corner of a face: indices from 0. */
typedef struct FaceCorner {
    uint32_t vertex, normal; /* normal may be MESH_NO_NORMAL */
} FaceCorner;

/* The largest index in the file and where it is; checked at the end, as faces may come before vertices. */
typedef struct LargestIndex {
    size_t index; /* from 1; 0: none yet */
    Word word;
    size_t offset; /* in the word */
} LargestIndex;

typedef struct ObjReader {
    TextCursor cursor;
    MeshData *mesh;
    size_t vertexCapacity, normalCapacity;
    LargestIndex largestVertex, largestNormal;

    FaceCorner *corners; /* of all faces, one after the other */
    size_t cornerCount, cornerCapacity;
    uint32_t *faceSizes; /* how many corners each face has */
    size_t faceCount, faceCapacity;
} ObjReader;

/* Make room for one more element; false without memory. */
static bool growArray(void **array, size_t count, size_t *capacity, size_t elementSize)
{
    if (count < *capacity)
        return true;
    size_t larger = *capacity < 64 ? 64 : *capacity + *capacity / 2;
    void *moved = larger > SIZE_MAX / elementSize ? NULL : realloc(*array, larger * elementSize);
    if (moved == NULL)
        return false;
    *array = moved;
    *capacity = larger;
    return true;
}

static bool appendVector(Vector3D **array, size_t *count, size_t *capacity, Vector3D v)
{
    void *grown = *array;
    if (!growArray(&grown, *count, capacity, sizeof v))
        return false;
    *array = grown;
    (*array)[(*count)++] = v;
    return true;
}

/* ---- Statements ---- */

/* Read the numbers of a statement: at least 3, at most `most`; the first three are the vector. */
static Status readVector(ObjReader *reader, const Word *keyword, size_t most, Vector3D *v)
{
    double values[3] = {0, 0, 0};
    size_t count = 0;
    Word word;
    for (; nextWord(&reader->cursor, &word); count++) {
        double value;
        if (count == most)
            return errorAtWord(&word, 0, "A %.*s statement has at most %zu numbers; remove this one.",
                               (int)keyword->length, keyword->start, most);
        Status status = wordToNumber(&word, MESH_LARGEST_COORDINATE, &value);
        if (!statusIsOk(&status))
            return status;
        if (count < 3)
            values[count] = value;
    }
    if (count < 3)
        return errorAtWord(keyword, 0, "A %.*s statement needs three numbers, x y z; this one has %zu.",
                           (int)keyword->length, keyword->start, count);
    *v = createVector(values[0], values[1], values[2]);
    return statusOk();
}

/* x y z, then perhaps a weight, or a colour of three or four numbers. */
static Status readVertex(ObjReader *reader, const Word *keyword)
{
    MeshData *mesh = reader->mesh;
    Vector3D v;
    Status status = readVector(reader, keyword, 7, &v);
    if (statusIsOk(&status) && !appendVector(&mesh->vertices, &mesh->vertexCount, &reader->vertexCapacity, v))
        return statusOutOfMemory();
    return status;
}

static Status readNormal(ObjReader *reader, const Word *keyword)
{
    MeshData *mesh = reader->mesh;
    Vector3D v;
    Status status = readVector(reader, keyword, 3, &v);
    if (statusIsOk(&status) && !appendVector(&mesh->normals, &mesh->normalCount, &reader->normalCapacity, v))
        return statusOutOfMemory();
    return status;
}

/* Read the whole number at offset in the word and step over it; false where there is none. Numbers of more
 * than 18 digits stay larger than any index. */
static bool readInteger(const Word *word, size_t *offset, int64_t *value)
{
    size_t i = *offset;
    bool negative = i < word->length && word->start[i] == '-';
    if (negative || (i < word->length && word->start[i] == '+'))
        i++;
    size_t firstDigit = i;
    int64_t magnitude = 0;
    for (; i < word->length && word->start[i] >= '0' && word->start[i] <= '9'; i++)
        if (magnitude < INT64_C(100000000000000000))
            magnitude = 10 * magnitude + (word->start[i] - '0');
    if (i == firstDigit)
        return false;
    *offset = i;
    *value = negative ? -magnitude : magnitude;
    return true;
}

/* Turn an index of the file, found at offset in the word, into one from 0. count: how many there are so
 * far; what: "vertex" or "normal". */
static Status resolveIndex(const Word *word, size_t offset, int64_t given, size_t count, const char *what,
                           LargestIndex *largest, uint32_t *index)
{
    if (given == 0)
        return errorAtWord(word, offset, "There is no %s 0; indices count from 1.", what);
    if (given < 0 && (uint64_t)-given > count)
        return errorAtWord(word, offset,
                           "Index %lld counts back from the newest %s, but only %zu come before this line.",
                           (long long)given, what, count);
    size_t fromOne = given < 0 ? count - (size_t)-given + 1 : (size_t)given;
    if (fromOne > largest->index)
        *largest = (LargestIndex){fromOne, *word, offset};
    *index = fromOne < UINT32_MAX ? (uint32_t)(fromOne - 1) : UINT32_MAX - 1;
    return statusOk();
}

/* Read a corner of a face: v, v/vt, v//vn or v/vt/vn. */
static Status readCorner(ObjReader *reader, const Word *word, FaceCorner *corner)
{
    char shown[SHOWN_WORD_SIZE];
    *corner = (FaceCorner){0, MESH_NO_NORMAL};
    size_t offset = 0;
    int64_t given;
    bool good = readInteger(word, &offset, &given);
    if (good) {
        Status status = resolveIndex(word, 0, given, reader->mesh->vertexCount, "vertex",
                                     &reader->largestVertex, &corner->vertex);
        if (!statusIsOk(&status))
            return status;
    }
    /* Step over the texture coordinate, which may be left out. */
    if (good && offset < word->length && word->start[offset] == '/') {
        offset++;
        if (offset < word->length && word->start[offset] != '/')
            good = readInteger(word, &offset, &given);
    }
    if (good && offset < word->length && word->start[offset] == '/') {
        size_t start = ++offset;
        if (offset < word->length && readInteger(word, &offset, &given)) {
            Status status = resolveIndex(word, start, given, reader->mesh->normalCount, "normal",
                                         &reader->largestNormal, &corner->normal);
            if (!statusIsOk(&status))
                return status;
        }
    }
    if (!good || offset != word->length)
        return errorAtWord(
            word, 0,
            "'%s' is not a corner of a face; write one as v, v/vt, v//vn or v/vt/vn with whole "
            "numbers.",
            showWord(shown, word));
    return statusOk();
}

static Status readFace(ObjReader *reader, const Word *keyword)
{
    uint32_t size = 0;
    Word word;
    for (; nextWord(&reader->cursor, &word); size++) {
        if (size == POLYGON_MAX_CORNERS)
            return errorAtWord(
                &word, 0,
                "This face has more than %d corners; cut it into triangles in the program that "
                "wrote the file.",
                POLYGON_MAX_CORNERS);
        void *grown = reader->corners;
        if (!growArray(&grown, reader->cornerCount, &reader->cornerCapacity, sizeof(FaceCorner)))
            return statusOutOfMemory();
        reader->corners = grown;
        Status status = readCorner(reader, &word, &reader->corners[reader->cornerCount]);
        if (!statusIsOk(&status))
            return status;
        reader->cornerCount++;
    }
    if (size < 3)
        return errorAtWord(keyword, 0, "A face needs at least 3 corners; this one has %u.", size);
    void *grown = reader->faceSizes;
    if (!growArray(&grown, reader->faceCount, &reader->faceCapacity, sizeof size))
        return statusOutOfMemory();
    reader->faceSizes = grown;
    reader->faceSizes[reader->faceCount++] = size;
    return statusOk();
}

static bool isOneOf(const Word *word, const char *const words[])
{
    for (size_t i = 0; words[i] != NULL; i++)
        if (wordIs(word, words[i]))
            return true;
    return false;
}

static Status readStatement(ObjReader *reader, const Word *keyword)
{
    static const char *const skipped[] = {"vt",        "vp",       "l",        "p",      "o",
                                          "g",         "s",        "mg",       "usemtl", "mtllib",
                                          "usemap",    "maplib",   "bevel",    "lod",    "shadow_obj",
                                          "trace_obj", "c_interp", "d_interp", NULL};
    static const char *const curved[] = {"cstype", "deg",  "bmat",  "step",  "curv", "curv2",
                                         "surf",   "parm", "trim",  "hole",  "scrv", "sp",
                                         "end",    "con",  "ctech", "stech", NULL};
    char shown[SHOWN_WORD_SIZE];
    if (wordIs(keyword, "v"))
        return readVertex(reader, keyword);
    if (wordIs(keyword, "vn"))
        return readNormal(reader, keyword);
    if (wordIs(keyword, "f") || wordIs(keyword, "fo"))
        return readFace(reader, keyword);
    if (isOneOf(keyword, skipped))
        return statusOk();
    if (isOneOf(keyword, curved))
        return errorAtWord(keyword, 0, "Curved surfaces (%s) are not read; export the model as polygons.",
                           showWord(shown, keyword));
    return errorAtWord(keyword, 0,
                       "'%s' is no statement of an OBJ file; remove the line, or check that this is a "
                       "Wavefront OBJ file in plain text.",
                       showWord(shown, keyword));
}

/* ---- From faces to triangles ---- */

static Status checkLargest(const LargestIndex *largest, size_t count, const char *one, const char *many)
{
    if (largest->index <= count)
        return statusOk();
    return errorAtWord(&largest->word, largest->offset,
                       "There is no %s %.*s; the file has %zu %s, and a positive index is at most that.", one,
                       (int)strspn(largest->word.start + largest->offset, "+-0123456789"),
                       largest->word.start + largest->offset, count, many);
}

/* Cut all faces into triangles. */
static Status cutFaces(ObjReader *reader)
{
    MeshData *mesh = reader->mesh;
    size_t triangleCount = reader->cornerCount - 2 * reader->faceCount;
    mesh->triangles = malloc(triangleCount * sizeof *mesh->triangles);
    Vector3D *positions = malloc(POLYGON_MAX_CORNERS * sizeof *positions);
    uint32_t(*pieces)[3] = malloc(POLYGON_MAX_CORNERS * sizeof *pieces);
    PolygonCutter cutter = {0};
    Status status = statusOk();
    if (mesh->triangles == NULL || positions == NULL || pieces == NULL)
        status = statusOutOfMemory();

    const FaceCorner *corners = reader->corners;
    for (size_t face = 0; face < reader->faceCount && statusIsOk(&status); face++) {
        uint32_t size = reader->faceSizes[face];
        for (uint32_t i = 0; i < size; i++)
            positions[i] = mesh->vertices[corners[i].vertex];
        status = cutPolygon(&cutter, positions, size, pieces);
        if (!statusIsOk(&status))
            break;
        for (uint32_t i = 0; i + 2 < size; i++) {
            MeshTriangle *triangle = &mesh->triangles[mesh->triangleCount++];
            for (int j = 0; j < 3; j++) {
                triangle->vertices[j] = corners[pieces[i][j]].vertex;
                triangle->normals[j] = corners[pieces[i][j]].normal;
            }
        }
        corners += size;
        if (face % CANCEL_POLL_LINES == 0 && cancelRequested())
            status = statusInterrupted();
    }
    freePolygonCutter(&cutter);
    free(positions);
    free(pieces);
    return status;
}

/* ---- The whole file ---- */

static Status readStatements(ObjReader *reader)
{
    do {
        Word keyword;
        if (nextWord(&reader->cursor, &keyword)) {
            Status status = readStatement(reader, &keyword);
            if (!statusIsOk(&status))
                return status;
        }
        if (reader->cursor.line % CANCEL_POLL_LINES == 0 && cancelRequested())
            return statusInterrupted();
    } while (nextLine(&reader->cursor));

    Status status = checkLargest(&reader->largestVertex, reader->mesh->vertexCount, "vertex", "vertices");
    if (statusIsOk(&status))
        status = checkLargest(&reader->largestNormal, reader->mesh->normalCount, "normal", "normals");
    if (statusIsOk(&status) && reader->faceCount == 0)
        status = statusError(STATUS_SCENE, "The file has no faces (lines that begin with f), so there is "
                                           "nothing to see; export the model with its polygons.");
    return status;
}

Status parseObjMesh(const char *text, size_t length, bool smooth, MeshData **mesh)
{
    ObjReader reader = {.cursor = createTextCursor(text, length), .mesh = calloc(1, sizeof *reader.mesh)};
    if (reader.mesh == NULL)
        return statusOutOfMemory();
    reader.mesh->isSmooth = smooth;
    Status status = readStatements(&reader);
    if (statusIsOk(&status))
        status = cutFaces(&reader);
    free(reader.corners);
    free(reader.faceSizes);
    if (statusIsOk(&status))
        status = buildMesh(reader.mesh);
    if (statusIsOk(&status))
        *mesh = reader.mesh;
    else
        freeMesh(reader.mesh);
    return status;
}

Status readObjMesh(const char *path, bool smooth, MeshData **mesh)
{
    char *text = NULL;
    size_t length = 0;
    Status status = readWholeFile(path, LONGEST_FILE, &text, &length);
    if (!statusIsOk(&status))
        return status;
    status = parseObjMesh(text, length, smooth, mesh);
    free(text);
    return status;
}
