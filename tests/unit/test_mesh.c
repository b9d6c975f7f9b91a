/* Meshes: closed and watertight, the tree against trying every triangle, inside and outside, normals. */
#include "shapes/mesh_build.h"
#include "shapes/shape.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const Material red = {.diffuse = {1, 0, 0}, .shininess = 32};

/* xorshift64* (Vigna 2016): the same numbers everywhere. */
static uint64_t seed = 88172645463325252u;

static double randomUnit(void)
{
    seed ^= seed >> 12;
    seed ^= seed << 25;
    seed ^= seed >> 27;
    return (double)((seed * 2685821657736338717u) >> 11) * 0x1p-53;
}

static double randomIn(double low, double high)
{
    return low + (high - low) * randomUnit();
}

static Vector3D randomVector(double size)
{
    /* One after the other: the order in which arguments are worked out is the compiler's choice. */
    double x = randomIn(-size, size), y = randomIn(-size, size), z = randomIn(-size, size);
    return createVector(x, y, z);
}

static Ray rayFromTo(Vector3D from, Vector3D to)
{
    return createRay(from, normalize(subVectors(to, from)));
}

/* ---- Making meshes ---- */

/* An unbuilt mesh with room for this many vertices and triangles, none of them there yet. */
static MeshData *createMesh(size_t vertices, size_t triangles, bool smooth)
{
    MeshData *mesh = calloc(1, sizeof *mesh);
    assert_non_null(mesh);
    mesh->vertices = calloc(vertices, sizeof *mesh->vertices);
    mesh->triangles = calloc(triangles, sizeof *mesh->triangles);
    assert_non_null(mesh->vertices);
    assert_non_null(mesh->triangles);
    mesh->isSmooth = smooth;
    return mesh;
}

static uint32_t addVertex(MeshData *mesh, Vector3D v)
{
    mesh->vertices[mesh->vertexCount] = v;
    return (uint32_t)mesh->vertexCount++;
}

static void addTriangle(MeshData *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    mesh->triangles[mesh->triangleCount++] =
        (MeshTriangle){{a, b, c}, {MESH_NO_NORMAL, MESH_NO_NORMAL, MESH_NO_NORMAL}};
}

static void build(MeshData *mesh)
{
    Status status = buildMesh(mesh);
    if (!statusIsOk(&status))
        fail_msg("%s", status.message);
}

/* Add a cube. own: each face has vertices of its own. flipped: this face runs the wrong way round; 6: none.
 * turned: bit i cuts face i along its other diagonal. */
static void addCube(MeshData *mesh, Vector3D min, double size, bool own, int flipped, unsigned turned)
{
    static const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    uint32_t shared[8];
    for (int i = 0; i < 8 && !own; i++)
        shared[i] = addVertex(
            mesh, addVectors(min, createVector(i & 1 ? size : 0, i & 2 ? size : 0, i & 4 ? size : 0)));
    for (int f = 0; f < 6; f++) {
        uint32_t v[4];
        for (int j = 0; j < 4; j++) {
            int i = faces[f][f == flipped ? 3 - j : j];
            v[j] = own ? addVertex(mesh, addVectors(min, createVector(i & 1 ? size : 0, i & 2 ? size : 0,
                                                                      i & 4 ? size : 0)))
                       : shared[i];
        }
        if (turned >> f & 1) {
            addTriangle(mesh, v[1], v[2], v[3]);
            addTriangle(mesh, v[1], v[3], v[0]);
        } else {
            addTriangle(mesh, v[0], v[1], v[2]);
            addTriangle(mesh, v[0], v[2], v[3]);
        }
    }
}

/* A ball of radius 1 round the centre, rows x 2 rows quads each cut in two, with bumps of this height. */
static MeshData *createBall(Vector3D center, uint32_t rows, double bumps, bool smooth)
{
    uint32_t columns = 2 * rows;
    MeshData *mesh = createMesh((rows + 1) * columns, 2 * rows * columns, smooth);
    for (uint32_t i = 0; i <= rows; i++)
        for (uint32_t j = 0; j < columns; j++) {
            double theta = 3.14159265358979323846 * i / rows, phi = 3.14159265358979323846 * 2 * j / columns;
            double r = 1 + bumps * sin(5 * phi) * sin(theta) * sin(3 * theta);
            /* All vertices of a pole are in one place. */
            double ring = i == 0 || i == rows ? 0 : r * sin(theta);
            addVertex(mesh,
                      addVectors(center, createVector(ring * cos(phi), r * cos(theta), ring * sin(phi))));
        }
    for (uint32_t i = 0; i < rows; i++)
        for (uint32_t j = 0; j < columns; j++) {
            uint32_t a = i * columns + j, b = i * columns + (j + 1) % columns, c = a + columns,
                     d = b + columns;
            addTriangle(mesh, a, b, d);
            addTriangle(mesh, a, d, c);
        }
    build(mesh);
    return mesh;
}

static Object objectOf(const MeshData *mesh)
{
    return (Object){.kind = SHAPE_MESH, .mesh = {red, mesh}};
}

/* ---- What a mesh is ---- */

static void cubeIsTheBox(void **state)
{
    (void)state;
    MeshData *mesh = createMesh(24, 12, false);
    addCube(mesh, createVector(-1, 2, -3), 2, true, 6, 0);
    build(mesh);
    assert_int_equal(mesh->vertexCount, 8); /* welded */
    assert_true(mesh->isClosed);
    Object object = objectOf(mesh);
    Box box = createBox(createVector(-1, 2, -3), createVector(1, 4, -1), red);
    Object boxObject = {.kind = SHAPE_BOX, .box = box};
    Bounds bounds;
    assert_true(objectBounds(&object, &bounds));
    assert_memory_equal(&bounds.min, &box.min, sizeof box.min);
    assert_memory_equal(&bounds.max, &box.max, sizeof box.max);

    int hits = 0;
    for (int i = 0; i < 20000; i++) {
        Ray ray = rayFromTo(addVectors(createVector(0, 3, -2), randomVector(4)),
                            addVectors(createVector(0, 3, -2), randomVector(1.2)));
        Intersection found, expected;
        bool isHit = intersectsBox(ray, box, &expected);
        assert_int_equal(intersectsObject(&ray, &object, &found), isHit);
        if (isHit) {
            assert_true(fabs(found.distance - expected.distance) < 1e-13);
            assert_true(norm(subVectors(found.normal, expected.normal)) < 1e-14);
            hits++;
        }
        Vector3D p = addVectors(createVector(0, 3, -2), randomVector(1.5));
        assert_int_equal(objectContains(&object, p), objectContains(&boxObject, p));
    }
    assert_true(hits > 5000);
    freeMesh(mesh);
}

static void closedMeansTwoOppositeTrianglesAtEachEdge(void **state)
{
    (void)state;
    /* Flipped faces, a missing one, one too many, two cubes that touch along an edge. */
    for (int kind = 0; kind < 7; kind++) {
        MeshData *mesh = createMesh(60, 30, false);
        addCube(mesh, createVector(0, 0, 0), 1, kind != 0, kind == 1 ? 3 : 6, 0x15);
        if (kind == 2 || kind == 6)
            mesh->triangleCount--;
        if (kind == 3) {
            const uint32_t *v = mesh->triangles[0].vertices;
            addTriangle(mesh, v[0], v[1], v[2]);
        }
        if (kind == 4)
            addCube(mesh, createVector(1, 1, 0), 1, true, 6, 0);
        if (kind >= 5) {
            /* What has two corners in one place changes nothing. */
            const uint32_t *v = mesh->triangles[0].vertices;
            for (int i = 0; i < 8; i++)
                addTriangle(mesh, v[0], v[1], v[1]);
        }
        build(mesh);
        bool expected = kind == 0 || kind == 5;
        Object object = objectOf(mesh);
        assert_int_equal(mesh->isClosed, expected);
        assert_int_equal(objectShape(&object)->hasInside(&object), expected);
        assert_int_equal(objectContains(&object, createVector(0.5, 0.25, 0.5)), expected);
        freeMesh(mesh);
    }
}

static void minusZeroIsZero(void **state)
{
    (void)state;
    MeshData *mesh = createMesh(60, 30, false);
    addCube(mesh, createVector(0, 0, 0), 1, true, 6, 0);
    for (size_t i = 0; i < mesh->vertexCount; i += 2)
        if (mesh->vertices[i].y == 0)
            mesh->vertices[i].y = -0.0;
    build(mesh);
    assert_int_equal(mesh->vertexCount, 8);
    assert_true(mesh->isClosed);
    freeMesh(mesh);
}

static void degenerateTrianglesAreLeftOut(void **state)
{
    (void)state;
    MeshData *mesh = createMesh(60, 30, true);
    addCube(mesh, createVector(0, 0, 0), 1, false, 6, 0);
    addTriangle(mesh, 0, 0, 0);
    addTriangle(mesh, 1, 2, 1);
    uint32_t a = addVertex(mesh, createVector(7, 0, 0)), b = addVertex(mesh, createVector(8, 0.1, 0));
    addTriangle(mesh, a, b, addVertex(mesh, createVector(9, 0.2, 0)));
    build(mesh);
    assert_int_equal(mesh->triangleCount, 12);
    assert_true(mesh->bounds.max.x == 1);
    freeMesh(mesh);

    mesh = createMesh(3, 1, true);
    for (int i = 0; i < 3; i++)
        addVertex(mesh, createVector(i, i, i));
    addTriangle(mesh, 0, 1, 2);
    Status status = buildMesh(mesh);
    assert_int_equal(status.code, STATUS_SCENE);
    freeMesh(mesh);
}

/* ---- The tree ---- */

/* Check the part of the tree below a node; returns the index behind it. */
static size_t checkNode(const MeshData *mesh, size_t index, const MeshNode *parent, size_t *triangle,
                        int depth)
{
    assert_true(index < mesh->nodeCount);
    assert_true(depth < MESH_TREE_MAX_DEPTH);
    const MeshNode *node = &mesh->nodes[index];
    for (int k = 0; k < 3 && parent != NULL; k++) {
        assert_true(node->min[k] >= parent->min[k]);
        assert_true(node->max[k] <= parent->max[k]);
    }
    if (node->count == 0) {
        size_t second = checkNode(mesh, index + 1, node, triangle, depth + 1);
        assert_int_equal(node->first, second);
        return checkNode(mesh, second, node, triangle, depth + 1);
    }
    assert_int_equal(node->first, *triangle);
    for (uint32_t i = 0; i < node->count; i++) {
        Vector3D corners[3];
        meshCorners(mesh, (*triangle)++, corners);
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) {
                assert_true(coordinateOf(corners[j], k) >= (double)node->min[k]);
                assert_true(coordinateOf(corners[j], k) <= (double)node->max[k]);
            }
    }
    return index + 1;
}

/* Every triangle is in exactly one leaf, every box in that of its parent. */
static void assertTreeValid(const MeshData *mesh)
{
    size_t triangles = 0;
    assert_int_equal(checkNode(mesh, 0, NULL, &triangles, 0), mesh->nodeCount);
    assert_int_equal(triangles, mesh->triangleCount);
}

enum {
    SOUP_KINDS = 7,
    SOUP_SIZE = 500
};

/* Triangles with nothing in common, of a nasty kind. */
static MeshData *createSoup(int kind, size_t count)
{
    MeshData *mesh = createMesh(3 * count, count, false);
    for (size_t i = 0; i < count; i++) {
        Vector3D center = randomVector(1);
        double size = 0.1, step = (double)i / (double)count;
        switch (kind) {
        case 1: /* all in one place */
            center = createVector(0.3, -0.2, 0.1);
            break;
        case 2: /* each half as far as the one before, down to the smallest float and beyond */
            center = createVector(exp2(-(double)i), 0, 0);
            size = exp2(-(double)i) / 4;
            break;
        case 3: /* long and thin */
            size = 2;
            break;
        case 4: /* far from the origin */
            center = addVectors(center, createVector(1e6, 1e6, -1e6));
            break;
        case 5: /* of very different sizes */
            size = exp2(randomIn(-20, 1));
            break;
        case 6: /* in planes along the axes */
            center = createVector(floor(4 * step) / 4, randomIn(-1, 1), randomIn(-1, 1));
            break;
        default:
            break;
        }
        uint32_t v[3];
        for (int j = 0; j < 3; j++) {
            Vector3D offset = randomVector(size);
            if (kind == 3)
                offset = createVector(offset.x, 1e-6 * offset.y, 1e-6 * offset.z);
            if (kind == 6)
                offset.x = 0;
            v[j] = addVertex(mesh, addVectors(center, offset));
        }
        addTriangle(mesh, v[0], v[1], v[2]);
    }
    build(mesh);
    return mesh;
}

static int compareHits(const void *a, const void *b)
{
    const Hit *first = a, *second = b;
    return first->part - second->part;
}

static void treeFindsWhatTryingEachTriangleFinds(void **state)
{
    (void)state;
    for (int kind = 0; kind < SOUP_KINDS; kind++) {
        MeshData *mesh = createSoup(kind, SOUP_SIZE);
        assertTreeValid(mesh);
        Object object = objectOf(mesh);
        Vector3D middle = multVector(addVectors(mesh->bounds.min, mesh->bounds.max), 0.5);
        double size = norm(subVectors(mesh->bounds.max, mesh->bounds.min));
        size_t found = 0;
        for (int i = 0; i < 2000; i++) {
            /* Aim at a corner, at an edge, at a face, or along an axis. */
            Vector3D p[3], target, from = addVectors(middle, randomVector(size));
            meshCorners(mesh, (size_t)(randomUnit() * (double)mesh->triangleCount), p);
            double share = randomUnit();
            target = i % 4 == 0 ? p[0] : addVectors(multVector(p[0], share), multVector(p[1], 1 - share));
            if (i % 4 == 2)
                target = addVectors(multVector(target, 0.5), multVector(p[2], 0.5));
            if (i % 4 == 3)
                from = createVector(target.x, target.y, target.z + size);
            Ray ray = rayFromTo(from, target);
            if (i % 8 == 7)
                ray.direction = createVector(-0.0, -0.0, -1);

            HitSink all = createHitSink(0, true), nearest = createHitSink(0, false);
            intersectObject(&object, &ray, &all);
            intersectObject(&object, &ray, &nearest);
            ShearedRay sheared = shearRay(&ray);
            size_t expected = 0;
            double nearestDistance = INFINITY;
            if (all.count > 0)
                qsort(all.all, all.count, sizeof *all.all, compareHits);
            for (size_t t = 0; t < mesh->triangleCount; t++) {
                TriangleHit hit;
                Vector3D q[3];
                meshCorners(mesh, t, q);
                if (!intersectTriangle(&sheared, q[0], q[1], q[2], &hit) || !(hit.distance > 0))
                    continue;
                assert_true(expected < all.count);
                assert_int_equal(all.all[expected].part, t);
                assert_true(all.all[expected++].distance == hit.distance);
                nearestDistance = fmin(nearestDistance, hit.distance);
            }
            assert_int_equal(expected, all.count);
            assert_true(nearest.nearest.distance == nearestDistance);
            found += expected;
            freeHitSink(&all);
        }
        assert_true(found > 500);
        freeMesh(mesh);
    }
}

/* ---- Watertight ---- */

static void noRaySlipsBetweenTriangles(void **state)
{
    (void)state;
    static const double offsets[] = {0, 1, 1000, 1e6};
    for (size_t o = 0; o < sizeof offsets / sizeof *offsets; o++) {
        Vector3D center = multVector(createVector(1, -0.7, 0.3), offsets[o]);
        MeshData *mesh = createBall(center, 12, 0.2, false);
        assert_true(mesh->isClosed);
        Object object = objectOf(mesh);
        for (int i = 0; i < 40000; i++) {
            Vector3D p[3], target;
            meshCorners(mesh, (size_t)i % mesh->triangleCount, p);
            double share = i % 3 == 0 ? 0 : randomUnit();
            target = addVectors(multVector(p[0], 1 - share), multVector(p[1], share));
            Vector3D from = addVectors(center, randomVector(i % 2 == 0 ? 0.3 : 1e-9));
            Ray ray = rayFromTo(from, target);
            HitSink sink = createHitSink(0, false);
            intersectObject(&object, &ray, &sink);
            assert_true(sink.nearest.distance < 2);
            /* And back from outside, through the edge into the ball. */
            ray = rayFromTo(addVectors(center, multVector(subVectors(target, center), 3)), target);
            sink = createHitSink(0, false);
            intersectObject(&object, &ray, &sink);
            assert_true(sink.nearest.distance < 3.5);
        }
        freeMesh(mesh);
    }
}

static void containsIsRightAlsoThroughEdges(void **state)
{
    (void)state;
    /* Random points, by the radius where the direction from the centre leaves. */
    MeshData *mesh = createBall(createVector(3, 4, 5), 16, 0.2, true);
    Object object = objectOf(mesh);
    for (int i = 0; i < 20000; i++) {
        Vector3D offset = randomVector(1.3);
        Ray ray = createRay(createVector(3, 4, 5), normalize(offset));
        HitSink sink = createHitSink(0, false);
        intersectObject(&object, &ray, &sink);
        if (fabs(norm(offset) - sink.nearest.distance) > 1e-9)
            assert_int_equal(objectContains(&object, addVectors(createVector(3, 4, 5), offset)),
                             norm(offset) < sink.nearest.distance);
    }
    freeMesh(mesh);

    /* Points on a grid, from which rays along simple directions go through vertices and edges. */
    for (unsigned turned = 0; turned < 64; turned++) {
        mesh = createMesh(8, 12, false);
        addCube(mesh, createVector(-4, -4, -4), 8, false, 6, turned);
        build(mesh);
        object = objectOf(mesh);
        for (int i = 0; i < 11 * 11 * 11; i++) {
            Vector3D p = createVector(i % 11 - 5, i / 11 % 11 - 5, i / 121 - 5);
            assert_int_equal(objectContains(&object, p), largestCoordinate(p) < 4);
        }
        freeMesh(mesh);
    }

    /* From the middle of two pyramids base to base, all the rays that are tried go through a corner, and the
     * winding number decides. */
    static const Vector3D tried[] = {{0.5127, 0.7441, 0.4283},
                                     {-0.6329, 0.4587, 0.6238},
                                     {0.3371, -0.8123, 0.4759},
                                     {0.2713, 0.3917, -0.8791}};
    mesh = createMesh(5, 6, false);
    for (int i = 0; i < 4; i++)
        addVertex(mesh, tried[i]);
    addVertex(mesh, multVector(tried[0], -1));
    for (uint32_t i = 1; i < 4; i++) {
        addTriangle(mesh, 0, i, i % 3 + 1);
        addTriangle(mesh, 4, i % 3 + 1, i);
    }
    build(mesh);
    assert_true(mesh->isClosed);
    object = objectOf(mesh);
    assert_true(objectContains(&object, createVector(0, 0, 0)));
    for (int i = -15; i <= 15; i++)
        if (abs(i) != 10)
            assert_int_equal(objectContains(&object, multVector(tried[0], i / 10.0)), abs(i) < 10);
    freeMesh(mesh);
}

static void pointsOnTheSurfaceAreNotInside(void **state)
{
    (void)state;
    MeshData *mesh = createBall(createVector(3, 4, 5), 16, 0.2, false);
    Object object = objectOf(mesh);
    for (size_t i = 0; i < mesh->triangleCount; i++) {
        Vector3D p[3];
        meshCorners(mesh, i, p);
        Vector3D middle = multVector(addVectors(p[0], addVectors(p[1], p[2])), 1.0 / 3);
        assert_false(objectContains(&object, middle));
        assert_false(objectContains(&object, p[0]));
    }
    freeMesh(mesh);
}

/* ---- Normals ---- */

static void absentNormalsAreWeightedByAngle(void **state)
{
    (void)state;
    /* A cube's corner has the same normal however its faces are cut, and whether or not they share vertices.
     */
    for (unsigned turned = 0; turned < 64; turned++) {
        MeshData *mesh = createMesh(24, 12, true);
        addCube(mesh, createVector(-1, -1, -1), 2, turned % 2 == 0, 6, turned);
        build(mesh);
        for (size_t i = 0; i < 3 * mesh->triangleCount; i++) {
            Vector3D v = mesh->vertices[mesh->triangles[i / 3].vertices[i % 3]];
            Vector3D n = mesh->normals[mesh->triangles[i / 3].normals[i % 3]];
            assert_true(norm(subVectors(n, normalize(v))) < 1e-14);
        }
        freeMesh(mesh);
    }
}

static void givenNormalsAreNormalisedAndZeroIsAbsent(void **state)
{
    (void)state;
    MeshData *mesh = createMesh(24, 12, true);
    addCube(mesh, createVector(-1, -1, -1), 2, false, 6, 0);
    mesh->normals = calloc(2, sizeof *mesh->normals);
    mesh->normals[mesh->normalCount++] = createVector(0, 1e-200, 0);
    mesh->normals[mesh->normalCount++] = createVector(0, 0, 0);
    mesh->triangles[0].normals[0] = 0;
    mesh->triangles[0].normals[1] = 1;
    build(mesh);
    int given = 0;
    for (size_t i = 0; i < 3 * mesh->triangleCount; i++) {
        Vector3D v = mesh->vertices[mesh->triangles[i / 3].vertices[i % 3]];
        Vector3D n = mesh->normals[mesh->triangles[i / 3].normals[i % 3]];
        if (n.y == 1)
            given++;
        else
            assert_true(norm(subVectors(n, normalize(v))) < 1e-14);
    }
    assert_int_equal(given, 1);
    freeMesh(mesh);

    /* Two faces back to back have no mean; each keeps its own. */
    mesh = createMesh(3, 2, true);
    addVertex(mesh, createVector(0, 0, 0));
    addVertex(mesh, createVector(1, 0, 0));
    addVertex(mesh, createVector(0, 1, 0));
    addTriangle(mesh, 0, 1, 2);
    addTriangle(mesh, 0, 2, 1);
    build(mesh);
    for (size_t i = 0; i < 2; i++)
        for (int j = 0; j < 3; j++) {
            Vector3D p[3];
            meshCorners(mesh, i, p);
            Vector3D n = mesh->normals[mesh->triangles[i].normals[j]];
            assert_true(norm(subVectors(n, normalize(triangleCross(p)))) < 1e-15);
        }
    freeMesh(mesh);
}

static void smoothNormalIsThatOfTheSmoothTriangle(void **state)
{
    (void)state;
    for (int i = 0; i < 500; i++) {
        Vector3D v[3], n[3];
        MeshData *mesh = createMesh(3, 1, true);
        mesh->normals = calloc(3, sizeof *mesh->normals);
        for (int j = 0; j < 3; j++) {
            v[j] = randomVector(1);
            n[j] = normalize(addVectors(createVector(0, 0, 1), randomVector(0.7)));
            addVertex(mesh, v[j]);
            mesh->normals[mesh->normalCount++] = multVector(n[j], 3);
        }
        addTriangle(mesh, 0, 1, 2);
        for (uint32_t j = 0; j < 3; j++)
            mesh->triangles[0].normals[j] = j;
        build(mesh);
        Object object = objectOf(mesh);
        Object triangle = {.kind = SHAPE_TRIANGLE, .triangle = createTriangle(v, n, red)};
        for (int k = 0; k < 20; k++) {
            double a = randomUnit(), b = randomUnit();
            Vector3D target = addVectors(v[0], addVectors(multVector(subVectors(v[1], v[0]), a),
                                                          multVector(subVectors(v[2], v[0]), (1 - a) * b)));
            Ray ray = rayFromTo(randomVector(5), target);
            Intersection found, expected;
            assert_int_equal(intersectsObject(&ray, &object, &found),
                             intersectsObject(&ray, &triangle, &expected));
            /* A hit at a grazing angle is less sure of its place. */
            double slope = fabs(dot(ray.direction, normalize(triangleCross(v))));
            assert_true(fabs(found.distance - expected.distance) <= 1e-13 / slope);
            assert_true(norm(subVectors(found.normal, expected.normal)) < 1e-12);
        }
        freeMesh(mesh);
    }
}

/* ---- For POV-Ray ---- */

static size_t countOf(const char *text, const char *word)
{
    size_t count = 0;
    for (const char *at = strstr(text, word); at != NULL; at = strstr(at + 1, word))
        count++;
    return count;
}

/* The braces that are open at the end; -1 where one was closed too early. */
static int openBraces(const char *text)
{
    int open = 0;
    for (; *text != '\0'; text++) {
        open += (*text == '{') - (*text == '}');
        if (open < 0)
            return -1;
    }
    return open;
}

static void povHasEveryTriangleInTheRightForm(void **state)
{
    (void)state;
    MeshData *mesh = createMesh(60, 30, true);
    addCube(mesh, createVector(0, 0, 0), 1, false, 6, 0);
    build(mesh);
    Object object = objectOf(mesh);
    Text surface = {0}, solid = {0}, own = {0};
    writeMeshPov(&object, 2, false, &surface);
    writeMeshPov(&object, 2, true, &solid);
    objectShape(&object)->writePov(&object, 2, &own);
    assert_int_equal(openBraces(surface.data), 1);
    assert_int_equal(strncmp(surface.data, "union {", 7), 0);
    assert_int_equal(countOf(surface.data, "smooth_triangle {"), 12);
    assert_int_equal(countOf(surface.data, "mesh"), 0);
    assert_non_null(strstr(surface.data, "<2, 2, 2>"));
    assert_int_equal(openBraces(solid.data), 1);
    assert_non_null(strstr(solid.data, "vertex_vectors { 8"));
    assert_non_null(strstr(solid.data, "face_indices { 12"));
    assert_non_null(strstr(solid.data, "normal_indices { 12"));
    assert_non_null(strstr(solid.data, "inside_vector"));
    /* A closed mesh could be a part of CSG. */
    assert_string_equal(own.data, solid.data);
    textFree(&surface);
    textFree(&solid);
    textFree(&own);
    freeMesh(mesh);

    /* Normals on both sides of a triangle: POV-Ray has it only in a mesh. */
    static const char *const forms[] = {"smooth_triangle { ", "mesh {\nsmooth_triangle {",
                                        "union {\nsmooth_triangle {"};
    for (int kind = 0; kind < 3; kind++) {
        mesh = createMesh(6, 2, true);
        mesh->normals = calloc(3, sizeof *mesh->normals);
        for (uint32_t i = 0; i < 3; i++) {
            addVertex(mesh, createVector(i == 1, i == 2, 0));
            addVertex(mesh, createVector(i == 1, i == 2, 3));
            mesh->normals[mesh->normalCount++] = createVector(1, 0, i == 1 && kind > 0 ? -1 : 1);
        }
        addTriangle(mesh, 0, 2, 4);
        for (uint32_t i = 0; i < 3; i++)
            mesh->triangles[0].normals[i] = i;
        if (kind == 2)
            addTriangle(mesh, 1, 3, 5);
        build(mesh);
        object = objectOf(mesh);
        Text pov = {0};
        objectShape(&object)->writePov(&object, 1, &pov);
        assert_int_equal(strncmp(pov.data, forms[kind], strlen(forms[kind])), 0);
        assert_int_equal(countOf(pov.data, "mesh {\nsmooth_triangle"), kind > 0);
        assert_int_equal(openBraces(pov.data), 1);
        textFree(&pov);
        freeMesh(mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cubeIsTheBox),
        cmocka_unit_test(closedMeansTwoOppositeTrianglesAtEachEdge),
        cmocka_unit_test(minusZeroIsZero),
        cmocka_unit_test(degenerateTrianglesAreLeftOut),
        cmocka_unit_test(treeFindsWhatTryingEachTriangleFinds),
        cmocka_unit_test(noRaySlipsBetweenTriangles),
        cmocka_unit_test(containsIsRightAlsoThroughEdges),
        cmocka_unit_test(pointsOnTheSurfaceAreNotInside),
        cmocka_unit_test(absentNormalsAreWeightedByAngle),
        cmocka_unit_test(givenNormalsAreNormalisedAndZeroIsAbsent),
        cmocka_unit_test(povHasEveryTriangleInTheRightForm),
        cmocka_unit_test(smoothNormalIsThatOfTheSmoothTriangle),
    };
    return cmocka_run_group_tests_name("mesh", tests, NULL, NULL);
}
