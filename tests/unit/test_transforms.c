/* Objects moved to world space: an ellipsoid worked out by hand, and over random maps (rotated, scaled by
 * different factors, mirrored, sheared, moved) that hits are on the moved surface, at the right distance and
 * with its normal, that inside stays inside, and that the bounds hold. */
#include "random_shapes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void ellipsoidByHand(void **state)
{
    (void)state;
    /* x^2/4 + y^2 + z^2/9 = 1, moved by (10, 0, 0); its normal is along (x/4, y, z/9). */
    Matrix scale = scalingMatrix(createVector(2, 1, 3));
    Matrix move = translationMatrix(createVector(10, 0, 0));
    Matrix matrix = composeMatrices(&scale, &move);
    Transform transform;
    assert_true(createTransform(&matrix, &transform));
    Object object = {.kind = SHAPE_SPHERE,
                     .transform = &transform,
                     .sphere = createSphere(createVector(0, 0, 0), 1, defaultMaterial())};
    Intersection hit;
    Ray ray = createRay(createVector(20, 0, 0), createVector(-1, 0, 0));
    assert_true(intersectsObject(&ray, &object, &hit));
    assert_true(fabs(hit.distance - 8) < 1e-14 && fabs(hit.normal.x - 1) < 1e-14);
    ray = createRay(createVector(11, 5, 0), createVector(0, -1, 0));
    assert_true(intersectsObject(&ray, &object, &hit));
    assert_true(fabs(hit.distance - (5 - sqrt(0.75))) < 1e-14);
    Vector3D n = normalize(createVector(1.0 / 4, sqrt(0.75), 0));
    assert_true(norm(subVectors(hit.normal, n)) < 1e-14);
    /* From inside the normal is turned, and all distances count in the world. */
    ray = createRay(createVector(10, 0, 0), createVector(0, 0, 1));
    assert_true(intersectsObject(&ray, &object, &hit));
    assert_true(fabs(hit.distance - 3) < 1e-14 && fabs(hit.normal.z + 1) < 1e-14);
    assert_true(objectContains(&object, createVector(11.9, 0, 0)));
    assert_false(objectContains(&object, createVector(10, 1.1, 0)));
    Bounds bounds;
    assert_true(objectBounds(&object, &bounds));
    assert_true(bounds.min.x == 8 && bounds.max.x == 12 && bounds.min.y == -1 && bounds.max.z == 3);
}

/* A unit vector across n. */
static Vector3D tangentOf(Vector3D n)
{
    return normalize(cross(n, fabs(n.x) < 0.5 ? createVector(1, 0, 0) : createVector(0, 1, 0)));
}

static void hitsOfTransformedObjects(void **state)
{
    (void)state;
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        size_t hits = 0;
        for (int i = 0; i < 20000 && kind != SHAPE_MESH && kind != SHAPE_CSG; i++) {
            double size = pow(10, randomIn(-6, 6));
            Object plain = randomObject((ShapeKind)kind, size), object = plain;
            Transform transform = randomTransform(size);
            object.transform = &transform;
            Vector3D target = transformPoint(&transform.worldFromObject, randomTarget(&plain, size));
            Ray ray =
                i % 3 == 0 ? createRay(target, randomDirection()) : rayFromTo(randomVector(9 * size), target);
            bool startsInside = objectContains(&object, ray.origin);
            Intersection hit;
            HitSink sink = createHitSink(0, false);
            intersectObject(&object, &ray, &sink);
            if (!intersectsObject(&ray, &object, &hit)) {
                assert_false(startsInside && kind != SHAPE_PLANE);
                continue;
            }
            hits++;
            double rounding = hitMagnitude(&object, &ray, hit.distance) * 1e-13;
            Vector3D own = transformPoint(&transform.objectFromWorld, hit.position);
            assert_true(distanceToSurface(&plain, own) <= rounding * 6);
            assert_true(fabs(norm(hit.normal) - 1) < 1e-14);
            assert_true(dot(hit.normal, ray.direction) <= 0);

            /* Tangents go by the map itself, and the normal is across them. */
            Vector3D ownNormal = objectShape(&plain)->normal(&plain, &sink.nearest, own);
            Vector3D tangent = tangentOf(ownNormal), other = cross(ownNormal, tangent);
            tangent = transformDirection(&transform.worldFromObject, tangent);
            other = transformDirection(&transform.worldFromObject, other);
            assert_true(fabs(dot(hit.normal, tangent)) <= 1e-13 * norm(tangent));
            assert_true(fabs(dot(hit.normal, other)) <= 1e-13 * norm(other));

            /* Along the normal is the side the ray comes from, and on the way there nothing changes. */
            Vector3D before = addVectors(hit.position, multVector(hit.normal, 1e3 * rounding));
            assert_int_equal(objectContains(&object, before), startsInside);
            before = pointOnRay(&ray, hit.distance * randomIn(0.01, 0.99));
            if (distanceToSurface(&plain, transformPoint(&transform.objectFromWorld, before)) >
                100 * rounding)
                assert_int_equal(objectContains(&object, before), startsInside);

            Bounds bounds;
            if (objectBounds(&object, &bounds))
                assert_true(boundsHold(&bounds, hit.position, rounding));
        }
        assert_true(hits > 5000 || kind == SHAPE_MESH || kind == SHAPE_CSG);
    }
}

static void hitsAboveAMinimum(void **state)
{
    (void)state;
    /* A minimum, and the distances of hits, are the world's, also where the object's own are others. */
    Matrix matrix = scalingMatrix(createVector(100, 100, 100));
    Transform transform;
    assert_true(createTransform(&matrix, &transform));
    Object object = {
        .kind = SHAPE_TORUS, .transform = &transform, .torus = createTorus(2, 0.5, defaultMaterial())};
    Ray ray = createRay(createVector(500, 0, 0), createVector(-1, 0, 0));
    const double above[] = {0, 249, 251, 349, 351, 651, 751};
    const double nearest[] = {250, 250, 350, 350, 650, 750, INFINITY};
    for (size_t i = 0; i < sizeof above / sizeof *above; i++) {
        HitSink sink = createHitSink(above[i], true);
        intersectObject(&object, &ray, &sink);
        assert_true(sink.nearest.distance == nearest[i] || fabs(sink.nearest.distance - nearest[i]) < 1e-11);
        assert_int_equal(sink.count, i < 2 ? 4 : i < 4 ? 3 : i == 4 ? 2 : i == 5 ? 1 : 0);
        freeHitSink(&sink);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ellipsoidByHand),
        cmocka_unit_test(hitsOfTransformedObjects),
        cmocka_unit_test(hitsAboveAMinimum),
    };
    return cmocka_run_group_tests_name("transforms", tests, NULL, NULL);
}
