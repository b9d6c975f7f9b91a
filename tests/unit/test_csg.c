/* CSG: a cut sphere worked out by hand, and random unions, intersections and differences, nested and
 * transformed, whose hits must divide each ray where membership of points, by Boolean algebra over the parts,
 * changes. */
#include "random_shapes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

/* A CSG object that takes over a copy of the parts. */
static Object csgOf(CsgOperation operation, const Object *parts, size_t count)
{
    Object object = {.kind = SHAPE_CSG, .csg = {.operation = operation, .partCount = count}};
    object.csg.parts = malloc(count * sizeof *parts);
    assert_non_null(object.csg.parts);
    for (size_t i = 0; i < count; i++)
        object.csg.parts[i] = parts[i];
    return object;
}

static Object sphereOf(double x, double radius, float red)
{
    Material material = createMaterial(createColor(red, 0, 0), createColor(0, 0, 0), 1);
    return (Object){.kind = SHAPE_SPHERE, .sphere = createSphere(createVector(x, 0, 0), radius, material)};
}

static void twoSpheresByHand(void **state)
{
    (void)state;
    /* Along x the first is from -1 to 1, the second from 0.5 to 2.5; the ray starts at 5 and looks back. */
    const Object parts[2] = {sphereOf(0, 1, 0.25f), sphereOf(1.5, 1, 0.75f)};
    const struct {
        CsgOperation operation;
        double distances[2];
        float reds[2];
    } cases[] = {
        {CSG_UNION, {2.5, 6}, {0.75f, 0.25f}},
        {CSG_INTERSECTION, {4, 4.5}, {0.25f, 0.75f}},
        /* The cut is the second's surface, in its material. */
        {CSG_DIFFERENCE, {4.5, 6}, {0.75f, 0.25f}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Object object = csgOf(cases[i].operation, parts, 2);
        Ray ray = createRay(createVector(5, 0, 0), createVector(-1, 0, 0));
        HitSink sink = allHits(&object, &ray);
        assert_int_equal(sink.count, 2);
        for (int h = 0; h < 2; h++) {
            assert_true(fabs(sink.all[h].distance - cases[i].distances[h]) < 1e-14);
            assert_true(sink.all[h].object->material.diffuse.r == cases[i].reds[h]);
        }
        freeHitSink(&sink);
        Intersection hit;
        assert_true(intersectsObject(&ray, &object, &hit));
        assert_true(hit.material.diffuse.r == cases[i].reds[0] && fabs(hit.normal.x - 1) < 1e-14);

        Bounds bounds;
        assert_true(objectBounds(&object, &bounds));
        const double low[] = {-1, 0.5, -1}, high[] = {2.5, 1, 1};
        assert_true(bounds.min.x == low[i] && bounds.max.x == high[i]);
        releaseObject(&object);
    }
    /* What is taken away leaves a hollow that is seen from within: from (0.4, 0, 0), in the first only, the
     * way to the right ends at the cut. */
    Object object = csgOf(CSG_DIFFERENCE, parts, 2);
    Ray ray = createRay(createVector(0.4, 0, 0), createVector(1, 0, 0));
    Intersection hit;
    assert_true(intersectsObject(&ray, &object, &hit));
    assert_true(fabs(hit.distance - 0.1) < 1e-14 && fabs(hit.normal.x + 1) < 1e-14);
    releaseObject(&object);
}

/* Random parts, some transformed and some CSG themselves; transforms[] is filled from *used on. */
enum {
    MOST_TRANSFORMS = 64
};
typedef struct Transforms {
    Transform items[MOST_TRANSFORMS];
    int count;
} Transforms;

static Object randomCsg(double size, int depth, Transforms *transforms)
{
    Object parts[3];
    size_t count = randomUnit() < 0.5 ? 2 : 3;
    for (size_t i = 0; i < count; i++) {
        if (depth > 0 && randomUnit() < 0.3) {
            parts[i] = randomCsg(size, depth - 1, transforms);
            continue;
        }
        parts[i] = randomSolid(size);
        if (randomUnit() < 0.5 && transforms->count < MOST_TRANSFORMS) {
            transforms->items[transforms->count] = randomTransform(size / 3);
            parts[i].transform = &transforms->items[transforms->count++];
        }
    }
    return csgOf((CsgOperation)(randomUnit() * 3), parts, count);
}

/* Boolean algebra over the parts. */
static bool isMember(const Object *object, Vector3D p)
{
    if (object->kind != SHAPE_CSG)
        return objectContains(object, p);
    bool inAny = false, inAll = true, inOthers = false;
    for (size_t i = 0; i < object->csg.partCount; i++) {
        bool inside = isMember(&object->csg.parts[i], p);
        inAny |= inside;
        inAll &= inside;
        inOthers |= i > 0 && inside;
    }
    switch (object->csg.operation) {
    case CSG_UNION:
        return inAny;
    case CSG_INTERSECTION:
        return inAll;
    default:
        return isMember(&object->csg.parts[0], p) && !inOthers;
    }
}

/* How far from the surface of any part, at least; the transforms shorten no length to less than a sixth. */
static double distanceToParts(const Object *object, Vector3D p)
{
    if (object->kind != SHAPE_CSG)
        return distanceToSurface(object, objectSpacePoint(object, p));
    double nearest = INFINITY;
    for (size_t i = 0; i < object->csg.partCount; i++)
        nearest = fmin(nearest, distanceToParts(&object->csg.parts[i], p));
    return nearest;
}

static void hitsDivideInsideFromOutside(void **state)
{
    (void)state;
    size_t hits = 0, several = 0, starts = 0;
    for (int i = 0; i < 20000; i++) {
        double size = i % 2 == 0 ? 1 : pow(10, randomIn(-6, 6));
        Transforms transforms = {.count = 0};
        Object object = randomCsg(size, 2, &transforms);
        Ray ray = createRay(randomVector(size * 0.7), randomDirection());
        if (i % 3 != 0)
            ray.origin = pointOnRay(&ray, -6 * size);
        double rounding = 1e-12 * 20 * size;
        HitSink sink = allHits(&object, &ray);
        hits += sink.count;
        several += sink.count > 2;
        starts += isMember(&object, ray.origin);

        /* The nearest hit is the same when only that is asked for. */
        HitSink nearest = createHitSink(0, false);
        intersectObject(&object, &ray, &nearest);
        if (sink.count > 0) {
            assert_true(nearest.nearest.distance == sink.all[0].distance);
            Intersection hit;
            assert_true(intersectsObject(&ray, &object, &hit));
            assert_true(distanceToParts(&object, hit.position) < rounding);
            assert_true(dot(hit.normal, ray.direction) <= 0);
            Bounds bounds;
            if (objectBounds(&object, &bounds))
                assert_true(boundsHold(&bounds, hit.position, rounding));
        } else {
            assert_true(nearest.nearest.distance == INFINITY);
        }

        /* Between hits all points are members, or none is, and each hit changes that. */
        bool inside = isMember(&object, ray.origin);
        double before = 0;
        for (size_t h = 0; h <= sink.count; h++) {
            double end = h < sink.count ? sink.all[h].distance : before + 20 * size;
            for (int step = 1; step < 16; step++) {
                Vector3D p = pointOnRay(&ray, before + (end - before) * step / 16);
                if (distanceToParts(&object, p) < rounding)
                    continue;
                assert_int_equal(isMember(&object, p), inside);
                assert_int_equal(objectContains(&object, p), inside);
            }
            inside = !inside;
            before = end;
        }
        freeHitSink(&sink);
        releaseObject(&object);
    }
    assert_true(hits > 9000 && several > 400 && starts > 1000);
}

static Object boxOf(double minX, double minY, double minZ, double maxX, double maxY, double maxZ, float red)
{
    Material material = createMaterial(createColor(red, 0, 0), createColor(0, 0, 0), 1);
    Vector3D min = createVector(minX, minY, minZ), max = createVector(maxX, maxY, maxZ);
    return (Object){.kind = SHAPE_BOX, .box = createBox(min, max, material)};
}

static Object cylinderOf(double bottom, double top, double radius, float red)
{
    Material material = createMaterial(createColor(red, 0, 0), createColor(0, 0, 0), 1);
    return (Object){
        .kind = SHAPE_CONE,
        .cone = createCylinder(createVector(0, bottom, 0), createVector(0, top, 0), radius, false, material)};
}

/* Solids whose surfaces coincide, as they are written by hand: the hits still divide inside from outside, so
 * that no lid stays on a hole and no face is lost or there twice. */
static void sharedFacesAreNoAccident(void **state)
{
    (void)state;
    const struct {
        CsgOperation operation;
        Object parts[3];
        size_t count;
        float top; /* the red of what is seen from above at (0.3, 0.2) */
    } cases[] = {
        /* The same block twice; its material is the last's. */
        {CSG_INTERSECTION, {boxOf(-1, 0, -1, 1, 1, 1, 0.25f), boxOf(-1, 0, -1, 1, 1, 1, 0.5f)}, 2, 0.5f},
        {CSG_UNION, {boxOf(-1, 0, -1, 1, 1, 1, 0.25f), boxOf(-1, 0, -1, 1, 1, 1, 0.5f)}, 2, 0.25f},
        {CSG_DIFFERENCE, {boxOf(-1, 0, -1, 1, 1, 1, 0.25f), boxOf(-1, 0, -1, 1, 1, 1, 0.5f)}, 2, 0},
        /* A hole and a corner as high as the block. */
        {CSG_DIFFERENCE, {boxOf(-1, 0, -1, 1, 1, 1, 0.25f), cylinderOf(0, 1, 0.5, 0.5f)}, 2, 0},
        {CSG_DIFFERENCE, {cylinderOf(0, 1, 1, 0.25f), cylinderOf(0, 1, 0.25, 0.5f)}, 2, 0.25f},
        {CSG_DIFFERENCE, {boxOf(-1, 0, -1, 1, 1, 1, 0.25f), boxOf(0, 0.5, 0, 1, 1, 1, 0.5f)}, 2, 0.5f},
        /* Cuts that share a face with one another, and one that only touches the block. */
        {CSG_DIFFERENCE,
         {boxOf(-1, 0, -1, 1, 1, 1, 0.25f), boxOf(0, 0.5, 0, 1, 2, 1, 0.5f),
          boxOf(-1, 0.5, 0, 0, 2, 1, 0.75f)},
         3,
         0.5f},
        {CSG_DIFFERENCE, {boxOf(-1, 0, -1, 1, 1, 1, 0.25f), boxOf(-1, 1, -1, 1, 2, 1, 0.5f)}, 2, 0.25f},
        /* Side by side, one on the other, and across each other. */
        {CSG_UNION, {boxOf(-1, 0, -1, 0, 1, 1, 0.25f), boxOf(0, 0, -1, 1, 1, 1, 0.5f)}, 2, 0.5f},
        {CSG_UNION, {boxOf(-1, 0, -1, 1, 1, 1, 0.25f), cylinderOf(1, 2, 0.5, 0.5f)}, 2, 0.5f},
        {CSG_UNION, {boxOf(-2, 0, -1, 2, 1, 1, 0.25f), boxOf(-1, 0, -2, 1, 1, 2, 0.5f)}, 2, 0.25f},
        {CSG_INTERSECTION, {boxOf(-1, 0, -1, 1, 1, 1, 0.25f), boxOf(-1, 1, -1, 1, 2, 1, 0.5f)}, 2, 0},
        /* A ball that touches the faces of the block round it, and the ball twice. */
        {CSG_DIFFERENCE, {sphereOf(0, 1, 0.25f), boxOf(-1, 0, -1, 1, 1, 1, 0.5f)}, 2, 0.5f},
        {CSG_INTERSECTION, {sphereOf(0, 1, 0.25f), sphereOf(0, 1, 0.5f)}, 2, 0.5f},
    };
    Matrix rotation = rotationMatrix(createVector(0, 1, 0), 30);
    Transform turned;
    assert_true(createTransform(&rotation, &turned));
    size_t hits = 0;
    for (size_t i = 0; i < 2 * sizeof cases / sizeof *cases; i++) {
        size_t number = i / 2;
        Object object = csgOf(cases[number].operation, cases[number].parts, cases[number].count);
        for (size_t part = 0; part < object.csg.partCount && i % 2 == 1; part++)
            object.csg.parts[part].transform = &turned;
        Ray down = createRay(createVector(0.3, 5, 0.2), createVector(0, -1, 0));
        Intersection seen;
        bool isSeen = intersectsObject(&down, &object, &seen);
        assert_int_equal(isSeen, cases[number].top > 0);
        if (isSeen && i % 2 == 0)
            assert_true(seen.material.diffuse.r == cases[number].top);
        for (int r = 0; r < 3000; r++) {
            Vector3D target = randomVector(1.2), from = randomVector(6);
            from.y += 9; /* above everything */
            Ray ray = rayFromTo(from, target);
            HitSink sink = allHits(&object, &ray);
            hits += sink.count;
            assert_int_equal(sink.count % 2, 0);
            double before = 0;
            for (size_t h = 0; h <= sink.count; h++) {
                double end = h < sink.count ? sink.all[h].distance : before + 20;
                Vector3D middle = pointOnRay(&ray, (before + end) / 2);
                if (distanceToParts(&object, middle) > 1e-9)
                    assert_int_equal(isMember(&object, middle), h % 2 == 1);
                before = end;
            }
            freeHitSink(&sink);
        }
        releaseObject(&object);
    }
    assert_true(hits > 50000);
}

/* A ray straight through an edge of the block where a corner was cut off as high and as wide as it is: the
 * edge is gone with the corner. */
static void edgesGoWithTheCorner(void **state)
{
    (void)state;
    const Object parts[] = {boxOf(-1, 0, -1, 1, 1, 1, 0.25f), boxOf(0, 0, 0, 1, 1, 1, 0.5f)};
    Object object = csgOf(CSG_DIFFERENCE, parts, 2);
    for (int i = 1; i < 40; i++) {
        Vector3D from = createVector(4, 4, 4);
        Ray ray = rayFromTo(from, createVector(1, i / 40.0, 1));
        HitSink sink = allHits(&object, &ray);
        assert_true(sink.count == 0 ||
                    sink.all[0].distance > norm(subVectors(createVector(0.9, 0.9, 0.9), from)));
        freeHitSink(&sink);
    }
    releaseObject(&object);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(twoSpheresByHand),
        cmocka_unit_test(hitsDivideInsideFromOutside),
        cmocka_unit_test(sharedFacesAreNoAccident),
        cmocka_unit_test(edgesGoWithTheCorner),
    };
    return cmocka_run_group_tests_name("csg", tests, NULL, NULL);
}
