/* OBJ files and lists of spheres: every spelling, every error with its place, polygons, random changes. */
#include "base/cancel.h"
#include "base/text.h"
#include "shapes/mesh_build.h"
#include "shapes/polygon.h"
#include "shapes/shape.h"
#include "shapes/sphere_list.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* xorshift64* (Vigna 2016): the same numbers everywhere. */
static uint64_t seed = 88172645463325252u;

static uint64_t randomBits(void)
{
    seed ^= seed >> 12;
    seed ^= seed << 25;
    seed ^= seed >> 27;
    return (seed * 2685821657736338717u) >> 11;
}

static double randomIn(double low, double high)
{
    return low + (high - low) * (double)randomBits() * 0x1p-53;
}

static MeshData *parse(const char *text, bool smooth)
{
    MeshData *mesh = NULL;
    Status status = parseObjMesh(text, strlen(text), smooth, &mesh);
    if (!statusIsOk(&status))
        fail_msg("%d:%d: %s", status.line, status.column, status.message);
    return mesh;
}

/* The corners of all triangles, sorted, as text: what does not depend on the order in the tree. */
static int compareLines(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static char *describe(const MeshData *mesh)
{
    char **lines = calloc(mesh->triangleCount, sizeof *lines);
    for (size_t i = 0; i < mesh->triangleCount; i++) {
        Vector3D p[3];
        meshCorners(mesh, i, p);
        /* Begin with the smallest corner, so that a turned triangle reads the same. */
        Text best = {0};
        for (int start = 0; start < 3; start++) {
            Text line = {0};
            for (int j = 0; j < 3; j++) {
                textAppendPovVector(&line, p[(start + j) % 3], 1);
                if (mesh->isSmooth) {
                    textAppend(&line, " n ");
                    textAppendPovVector(&line, mesh->normals[mesh->triangles[i].normals[(start + j) % 3]], 1);
                }
            }
            if (best.data == NULL || strcmp(line.data, best.data) < 0) {
                textFree(&best);
                best = line;
            } else {
                textFree(&line);
            }
        }
        lines[i] = best.data;
    }
    qsort(lines, mesh->triangleCount, sizeof *lines, compareLines);
    Text all = {0};
    for (size_t i = 0; i < mesh->triangleCount; i++) {
        textAppend(&all, lines[i]);
        textAppend(&all, "\n");
        free(lines[i]);
    }
    free(lines);
    return all.data;
}

/* Two triangles, one of them with normals. */
static const char *const plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 2\nvn 0 1 0\nvn 1 0 0\n"
                                 "f 1//1 2//2 3//3\nf 1 3 4\n";

static void allSpellingsAreTheSame(void **state)
{
    (void)state;
    static const char *const spellings[] = {
        /* CR LF, tabs, CR, no newline at the end, a byte order mark. */
        "v 0 0 0\r\nv 1 0 0\r\nv\t0 1 0 \r\nv 0 0 1\r\nvn 0 0 2\r\nvn 0 1 0\r\nvn 1 0 0\r\n"
        "f 1//1 2//2 3//3\r\nf 1 3 4",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rv 0 0 1\rvn 0 0 2\rvn 0 1 0\rvn 1 0 0\rf 1//1 2//2 3//3\rf 1 3 4\r",
        "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 2\nvn 0 1 0\nvn 1 0 0\n\n"
        "f 1//1 2//2 3//3\n  f 1 3 4  ",
        /* Negative indices, texture coordinates, faces before vertices, comments. */
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 2\nvn 0 1 0\nvn 1 0 0\nvt 0 0\n"
        "f -4/-1/-3 -3/1/-2 -2/1/-1\nf -4/1 -2/1 -1/1\n",
        "f 1//1 2//2 3//3 # first\nf 1/ 3// 4#second\nv 0 0 0#\n#v 9\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
        "vn 0 0 2\nvn 0 1 0\nvn 1 0 0",
        /* Joined lines; a comment is not joined. */
        "v 0 0 0\nv 1 \\\n0 0\nv 0 1 0 # \\\nv 0 0 1\nvn 0 0 2\nvn 0 1 0\nvn 1 0 0\n"
        "f 1//1\\\r\n2//2 3//3\nf \\\n \\\n 1 3 4\n",
        /* Numbers, colours and a weight. */
        "v 0. .0 -0e5 1.0\nv +1 0 0 .1 .2 .3\nv 0 10e-1 0 0 0 0 1\nv 0 0 0.1E+1\n"
        "vn 0 0 2\nvn 0 1 0\nvn 1 0 0\nf 1//1 2//2 3//3\nf 1 3 4\n",
        /* What changes no surface. */
        "mtllib a b.mtl\no x\ng\ns off\nusemtl y\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvp 1\nvn 0 0 2\n"
        "vn 0 1 0\nvn 1 0 0\nvt 1\nl 1 2\np 1\nf 1//1 2//2 3//3\ng a b\nf 1 3 4\nf 1 2 2\n"};
    for (int smooth = 0; smooth < 2; smooth++) {
        MeshData *mesh = parse(plain, smooth);
        char *expected = describe(mesh);
        freeMesh(mesh);
        for (size_t i = 0; i < sizeof spellings / sizeof *spellings; i++) {
            mesh = parse(spellings[i], smooth);
            char *found = describe(mesh);
            assert_string_equal(found, expected);
            free(found);
            freeMesh(mesh);
        }
        free(expected);
    }
}

typedef struct BrokenText {
    const char *text;
    int line, column;
    const char *message; /* a part of it */
} BrokenText;

static void errorsHaveTheirPlace(void **state)
{
    (void)state;
    static const BrokenText broken[] = {
        {"", 0, 0, "no faces"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\n", 0, 0, "no faces"},
        {"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n", 0, 0, "has an area"},
        {"v 0 0 0\nf 1 2 3\n", 2, 7, "no vertex 3; the file has 1 vertices"},
        {"f 1 2 3\nv 0 0 0\nv 1 0 0\n", 1, 7, "no vertex 3; the file has 2"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 0 3\n", 4, 5, "count from 1"},
        {"v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n", 3, 9, "counts back"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2 3\n", 4, 6, "no normal 1"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/0 2 3\n", 4, 7, "no normal 0"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n", 4, 7, "no vertex 99999999999999999999"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -99999999999999999999\n", 4, 7, "counts back"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4294967297\n", 4, 7, "no vertex 4294967297"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3/1/1/1\n", 4, 7, "not a corner"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3.5\n", 4, 7, "not a corner"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 /3\n", 4, 7, "not a corner"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\n 2 x\n", 5, 4, "'x' is not a corner"},
        {"v 0 0 0\n\n  f 1 1\n", 3, 3, "at least 3 corners; this one has 2"},
        {"f\n", 1, 1, "this one has 0"},
        {"v 1 2\n", 1, 1, "this one has 2"},
        {"v 1 2 3 4 5 6 7 8\n", 1, 17, "at most 7"},
        {"vn 1 2 3 4\n", 1, 10, "at most 3"},
        {"v 1 2 1e400\n", 1, 7, "too large"},
        {"v 1 2 1e31\n", 1, 7, "too large"},
        {"v 1 nan 3\n", 1, 5, "'nan' is not a number"},
        {"v 1 2 inf\n", 1, 7, "'inf' is not a number"},
        {"v 0x10 2 3\n", 1, 3, "not a number"},
        {"v 1,5 2 3\n", 1, 3, "not a number"},
        {"v 1 2 3.1+e2\n", 1, 7, "not a number"},
        {"v 1 2 3 \xC3\xA9 x\n", 1, 9, "not a number"},
        {"\xEF\xBB\xBFv 1 2 x\n", 1, 7, "not a number"},
        {"g \xC3\xA9\xC3\xA9 \\\n\xC3\xA9\nv 1 2 x\n", 3, 7, "not a number"},
        {"o \xE2\x82\xAC\nv 1 \\\r\n\xE2\x82\xAC 2\n", 3, 1, "not a number"},
        {"surf 0 1 0 1 1 2 3\n", 1, 1, "Curved surfaces"},
        {"  facet normal 1 0 0\n", 1, 3, "'facet' is no statement"},
        {"\xFF\xFEv", 1, 1, "plain text"},
    };
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++) {
        MeshData *mesh = NULL;
        Status status = parseObjMesh(broken[i].text, strlen(broken[i].text), i % 2 == 0, &mesh);
        assert_null(mesh);
        assert_int_equal(status.code, STATUS_SCENE);
        if (strstr(status.message, broken[i].message) == NULL)
            fail_msg("'%s' gave '%s'", broken[i].text, status.message);
        if (status.line != broken[i].line || status.column != broken[i].column)
            fail_msg("'%s' gave %d:%d, not %d:%d", broken[i].text, status.line, status.column, broken[i].line,
                     broken[i].column);
    }
}

static void aNulByteIsNoNumber(void **state)
{
    (void)state;
    static const char text[] = "v 1 2 3\0 4\nf 1 1 1\n";
    MeshData *mesh = NULL;
    Status status = parseObjMesh(text, sizeof text - 1, true, &mesh);
    assert_int_equal(status.code, STATUS_SCENE);
    assert_int_equal(status.line, 1);
    assert_int_equal(status.column, 7);
}

/* ---- Polygons ---- */

/* Cut and check: the triangles' areas add up without overlap, each edge of the polygon is there, and no
 * triangle is turned round or without area. */
static void checkCut(const Vector3D *corners, size_t count, double area)
{
    PolygonCutter cutter = {0};
    uint32_t(*triangles)[3] = calloc(count, sizeof *triangles);
    bool *hasEdge = calloc(count, sizeof *hasEdge);
    Status status = cutPolygon(&cutter, corners, count, triangles);
    assert_true(statusIsOk(&status));
    Vector3D sum = {0, 0, 0};
    double sumOfAreas = 0;
    for (size_t i = 0; i + 2 < count; i++) {
        const Vector3D p[3] = {corners[triangles[i][0]], corners[triangles[i][1]], corners[triangles[i][2]]};
        Vector3D twice = triangleCross(p);
        sum = addVectors(sum, twice);
        sumOfAreas += norm(twice) / 2;
        assert_true(norm(twice) > 1e-14 * area);
        for (int j = 0; j < 3; j++)
            if ((triangles[i][j] + 1) % count == triangles[i][(j + 1) % 3])
                hasEdge[triangles[i][j]] = true;
    }
    assert_true(fabs(norm(sum) / 2 - area) < 1e-9 * area);
    assert_true(fabs(sumOfAreas - area) < 1e-9 * area);
    for (size_t i = 0; i < count; i++)
        assert_true(hasEdge[i]);
    free(hasEdge);
    free(triangles);
    freePolygonCutter(&cutter);
}

static void concavePolygonsAreRight(void **state)
{
    (void)state;
    /* Stars of random radii are simple polygons with many reflex corners; look at them from everywhere. */
    for (int round = 0; round < 2000; round++) {
        size_t count = 3 + (size_t)(randomBits() % 60);
        Vector3D corners[64];
        Vector3D x = normalize(createVector(randomIn(-1, 1), randomIn(-1, 1), randomIn(-1, 1)));
        Vector3D y = normalize(cross(x, createVector(0.3, 0.2, 0.9)));
        if (round % 4 == 0) {
            x = createVector(round % 8 == 0 ? 1 : -1, 0, 0);
            y = createVector(0, round % 16 < 8 ? 1 : 0, round % 16 < 8 ? 0 : 1);
        }
        double radii[64], area = 0;
        for (size_t i = 0; i < count; i++) {
            radii[i] = randomIn(0.1, 1);
            double angle = 2 * 3.14159265358979323846 * (double)i / (double)count;
            corners[i] =
                addVectors(multVector(x, radii[i] * cos(angle)), multVector(y, radii[i] * sin(angle)));
            corners[i] = addVectors(corners[i], createVector(3, -2, 7));
        }
        for (size_t i = 0; i < count; i++)
            area += radii[i] * radii[(i + 1) % count] * sin(2 * 3.14159265358979323846 / (double)count) / 2;
        checkCut(corners, count, area);
    }
}

static void polygonsWithStraightCornersAndHoles(void **state)
{
    (void)state;
    /* An L with corners in the middle of its edges. */
    const Vector3D ell[] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                            {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
    checkCut(ell, 8, 3);
    /* A square with a square hole, joined by a pair of edges. */
    const Vector3D frame[] = {{0, 0, 1}, {0, 4, 1}, {4, 4, 1}, {4, 0, 1}, {0, 0, 1},
                              {1, 1, 1}, {3, 1, 1}, {3, 3, 1}, {1, 3, 1}, {1, 1, 1}};
    checkCut(frame, 10, 12);
    /* A comb. */
    Vector3D comb[84];
    size_t count = 0;
    comb[count++] = createVector(0, 0, 0);
    comb[count++] = createVector(0, 0, 40);
    for (int i = 40; i-- > 0;)
        comb[count++] = createVector(0, i % 2 == 0 ? 1 : 30, i);
    double area = 0;
    for (size_t i = 0; i < count; i++)
        area += (comb[i].z * comb[(i + 1) % count].y - comb[i].y * comb[(i + 1) % count].z) / 2;
    checkCut(comb, count, area);
    /* A convex one is a fan round its first corner. */
    MeshData *mesh = parse("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", false);
    MeshData *fan = parse("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n", false);
    char *found = describe(mesh), *expected = describe(fan);
    assert_string_equal(found, expected);
    free(found);
    free(expected);
    freeMesh(mesh);
    freeMesh(fan);
}

static void polygonsWithRandomHoles(void **state)
{
    (void)state;
    /* A star with a star cut out of it, joined by a pair of edges between their first corners. */
    for (int round = 0; round < 2000; round++) {
        Vector3D corners[64];
        size_t count = 0;
        double area = 0;
        for (int hole = 0; hole < 2; hole++) {
            size_t sides = 3 + (size_t)(randomBits() % 28);
            double radii[31], step = 2 * 3.14159265358979323846 / (double)sides;
            for (size_t i = 0; i < sides; i++)
                radii[i] = hole ? randomIn(0.1, 0.9) : randomIn(2, 4);
            for (size_t i = 0; i <= sides; i++) {
                double r = radii[i % sides], angle = (hole ? -step : step) * (double)(i % sides);
                corners[count++] = createVector(r * cos(angle), r * sin(angle), 5);
                if (i < sides)
                    area += (hole ? -0.5 : 0.5) * r * radii[(i + 1) % sides] * sin(step);
            }
        }
        checkCut(corners, count, area);
    }
}

static void hopelessPolygonsEnd(void **state)
{
    (void)state;
    /* Random points, points on a line, all in one place: any triangles, but all of them, and soon. */
    for (int round = 0; round < 300; round++) {
        size_t count = 3 + (size_t)(randomBits() % 200);
        Vector3D corners[203];
        uint32_t triangles[203][3];
        for (size_t i = 0; i < count; i++) {
            double t = (double)(randomBits() % 5);
            corners[i] = round % 3 == 0   ? createVector(randomIn(-1, 1), randomIn(-1, 1), randomIn(-1, 1))
                         : round % 3 == 1 ? createVector(t, 2 * t, -t)
                                          : createVector(1, t > 2, t > 3);
        }
        PolygonCutter cutter = {0};
        Status status = cutPolygon(&cutter, corners, count, triangles);
        assert_true(statusIsOk(&status));
        for (size_t i = 0; i + 2 < count; i++)
            for (int j = 0; j < 3; j++)
                assert_true(triangles[i][j] < count && triangles[i][j] != triangles[i][(j + 1) % 3]);
        freePolygonCutter(&cutter);
    }
    /* Too many corners are an error, not an hour of work. */
    Text text = {0};
    textAppend(&text, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf");
    for (int i = 0; i <= POLYGON_MAX_CORNERS; i++)
        textAppendFormat(&text, " %d", i % 3 + 1);
    MeshData *mesh = NULL;
    Status status = parseObjMesh(text.data, text.length, true, &mesh);
    assert_int_equal(status.code, STATUS_SCENE);
    assert_non_null(strstr(status.message, "more than 10000 corners"));
    assert_int_equal(status.line, 4);
    assert_int_equal(status.column, 3 + 2 * POLYGON_MAX_CORNERS);
    textFree(&text);
}

/* ---- Random changes ---- */

static void randomChangesNeverCrash(void **state)
{
    (void)state;
    static const char *const pieces[] = {
        "-", "1", "9999999999999", "/",    "//",    "\n", "\r", "\\\n", "#", " ", "f ", "v ", "vn ", "e",
        ".", "0", "nan",           "\xC3", "1e308", "-0", "\t"};
    int good = 0, bad = 0;
    for (int round = 0; round < 20000; round++) {
        Text text = {0};
        textAppend(&text, plain);
        textAppend(&text, "f -1 -2 -3 -4\nf 1/2/3 2//1 3/1 4\n");
        for (uint64_t changes = 1 + randomBits() % 4; changes > 0; changes--) {
            size_t at = (size_t)(randomBits() % text.length);
            if (randomBits() % 2 == 0) {
                text.data[at] = randomBits() % 4 == 0 ? (char)(randomBits() % 256)
                                                      : "0123456789 -\n./#"[randomBits() % 17];
            } else {
                Text changed = {0};
                textAppendBytes(&changed, text.data, at);
                textAppend(&changed, pieces[randomBits() % (sizeof pieces / sizeof *pieces)]);
                size_t skipped = (size_t)(randomBits() % 8);
                if (at + skipped < text.length)
                    textAppendBytes(&changed, text.data + at + skipped, text.length - at - skipped);
                textFree(&text);
                text = changed;
            }
        }
        MeshData *mesh = NULL;
        Status status = parseObjMesh(text.data, text.length, round % 2 == 0, &mesh);
        if (statusIsOk(&status)) {
            assert_true(mesh->triangleCount > 0);
            for (size_t i = 0; i < 3 * mesh->triangleCount; i++) {
                assert_true(mesh->triangles[i / 3].vertices[i % 3] < mesh->vertexCount);
                if (mesh->isSmooth) {
                    uint32_t n = mesh->triangles[i / 3].normals[i % 3];
                    assert_true(n < mesh->normalCount);
                    assert_true(fabs(norm(mesh->normals[n]) - 1) < 1e-12);
                }
            }
            freeMesh(mesh);
            good++;
        } else {
            assert_int_equal(status.code, STATUS_SCENE);
            assert_true(status.message[0] != '\0');
            bad++;
        }
        textFree(&text);
    }
    assert_true(good > 500 && bad > 500);
}

/* ---- Real files ---- */

typedef struct RealFile {
    const char *path;
    size_t triangles; /* whose area is not 0 in exact arithmetic; 0: the file is broken */
    bool isClosed;
} RealFile;

static void realFilesAreRead(void **state)
{
    (void)state;
    static const char models[] = "/usr/share/assimp/models/OBJ/";
    static const RealFile files[] = {
        {"/usr/share/glmark2/models/bunny.obj", 69666, true},
        {"spider.obj", 1312, false},
        {"WusonOBJ.obj", 3732, false},
        {"box.obj", 12, true},
        {"box_without_lineending.obj", 12, true},
        {"concave_polygon.obj", 64, false},
        {"regr01.obj", 2706, false},
        {"cube_with_vertexcolors.obj", 12, true},
        {"number_formats.obj", 0, false},
        {"point_cloud.obj", 0, false},
        {"box_UTF16BE.obj", 0, false},
    };
    int missing = 0;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char path[256];
        snprintf(path, sizeof path, "%s%s", files[i].path[0] == '/' ? "" : models, files[i].path);
        if (access(path, R_OK) != 0) {
            print_message("skipped: there is no %s\n", path);
            missing++;
            continue;
        }
        MeshData *mesh = NULL;
        Status status = readObjMesh(path, true, &mesh);
        if (files[i].triangles == 0) {
            assert_int_equal(status.code, STATUS_SCENE);
            assert_null(mesh);
            continue;
        }
        if (!statusIsOk(&status))
            fail_msg("%s:%d:%d: %s", path, status.line, status.column, status.message);
        assert_int_equal(mesh->triangleCount, files[i].triangles);
        assert_int_equal(mesh->isClosed, files[i].isClosed);
        freeMesh(mesh);
    }
    if (missing > 0)
        skip();
}

static void missingFileIsAnError(void **state)
{
    (void)state;
    MeshData *mesh = NULL;
    ListedSphere *spheres = NULL;
    size_t count = 0;
    Status status = readObjMesh("no/such.obj", true, &mesh);
    assert_int_equal(status.code, STATUS_IO);
    status = readSphereList("no/such.txt", &spheres, &count);
    assert_int_equal(status.code, STATUS_IO);
}

/* ---- Lists of spheres ---- */

static void sphereListsAreRead(void **state)
{
    (void)state;
    static const char text[] = "# x y z r\n\n1 2 3 4\r\n\t-1e-3 +.5 0 1e300 # far\n  \n5 6 7 8";
    ListedSphere *spheres = NULL;
    size_t count = 0;
    Status status = parseSphereList(text, sizeof text - 1, &spheres, &count);
    assert_true(statusIsOk(&status));
    assert_int_equal(count, 3);
    const ListedSphere expected[] = {{{1, 2, 3}, 4}, {{-1e-3, 0.5, 0}, 1e300}, {{5, 6, 7}, 8}};
    assert_memory_equal(spheres, expected, sizeof expected);
    free(spheres);

    static const BrokenText broken[] = {
        {"", 0, 0, "no spheres"},
        {"# nothing\n\n", 0, 0, "no spheres"},
        {"1 2 3 4\n1 2 3\n", 2, 1, "this one has 3"},
        {"1 2 3 4\n\n  1 2 3 4 5\n", 3, 11, "begin a new line"},
        {"1 2 3 0\n", 1, 7, "above 0"},
        {"1 2 3 -1\n", 1, 7, "above 0"},
        {"1 2 x 1\n", 1, 5, "'x' is not a number"},
        {"1, 2, 3, 1\n", 1, 1, "not a number"},
        {"1 2 3 nan\n", 1, 7, "not a number"},
        {"1 2 3 inf\n", 1, 7, "not a number"},
        {"1 2 1e999 4\n", 1, 5, "too large"},
    };
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++) {
        spheres = NULL;
        status = parseSphereList(broken[i].text, strlen(broken[i].text), &spheres, &count);
        assert_null(spheres);
        assert_int_equal(status.code, STATUS_SCENE);
        assert_int_equal(status.line, broken[i].line);
        assert_int_equal(status.column, broken[i].column);
        if (strstr(status.message, broken[i].message) == NULL)
            fail_msg("'%s' gave '%s'", broken[i].text, status.message);
    }
}

/* The last one: a request to stop is never taken back. */
static void cancellingLeavesNothing(void **state)
{
    (void)state;
    Text spheres = {0};
    for (int i = 0; i < 10000; i++)
        textAppend(&spheres, "1 2 3 4\n");
    requestCancel();
    MeshData *mesh = NULL;
    ListedSphere *list = NULL;
    size_t count = 0;
    Status status = parseObjMesh(plain, strlen(plain), true, &mesh);
    assert_int_equal(status.code, STATUS_INTERRUPTED);
    assert_null(mesh);
    status = parseSphereList(spheres.data, spheres.length, &list, &count);
    assert_int_equal(status.code, STATUS_INTERRUPTED);
    assert_null(list);
    textFree(&spheres);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(allSpellingsAreTheSame),
        cmocka_unit_test(errorsHaveTheirPlace),
        cmocka_unit_test(aNulByteIsNoNumber),
        cmocka_unit_test(concavePolygonsAreRight),
        cmocka_unit_test(polygonsWithStraightCornersAndHoles),
        cmocka_unit_test(polygonsWithRandomHoles),
        cmocka_unit_test(hopelessPolygonsEnd),
        cmocka_unit_test(randomChangesNeverCrash),
        cmocka_unit_test(realFilesAreRead),
        cmocka_unit_test(missingFileIsAnError),
        cmocka_unit_test(sphereListsAreRead),
        cmocka_unit_test(cancellingLeavesNothing),
    };
    return cmocka_run_group_tests_name("obj", tests, NULL, NULL);
}
