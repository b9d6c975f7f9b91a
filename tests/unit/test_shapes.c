/* The shapes: hits and normals worked out by hand, and for each shape the same properties over random
 * and nasty rays: the hit lies on the surface, nothing nearer does, none is left out, the normal is the
 * surface's and is turned to the ray. */
#include "random_shapes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static const Material red = {.diffuse = {1, 0, 0}, .shininess = 32};

static void assertHit(bool hit, const Intersection *found, double distance, Vector3D normal)
{
    assert_true(hit);
    assert_true(fabs(found->distance - distance) <= 1e-12 * distance);
    assert_true(norm(subVectors(found->normal, normal)) < 1e-12);
}

static void sphereFromOutsideAndInside(void **state)
{
    (void)state;
    Sphere sphere = createSphere(createVector(0, 0, -5), 1.5, red);
    Intersection hit;
    Ray ray = createRay(createVector(0, 0, 0), createVector(0, 0, -1));
    assertHit(intersectsSphere(ray, sphere, &hit), &hit, 3.5, createVector(0, 0, 1));
    assert_true(hit.material.diffuse.r == 1.0f);
    assert_true(norm(subVectors(hit.position, createVector(0, 0, -3.5))) < 1e-15);

    /* From inside the normal is turned to the ray's side (exercise 03a, 01b). */
    ray.origin = createVector(0, 0, -5);
    assertHit(intersectsSphere(ray, sphere, &hit), &hit, 1.5, createVector(0, 0, 1));

    /* Behind it is a miss, and a miss changes nothing. */
    hit.distance = 42;
    ray.origin = createVector(0, 0, -7);
    assert_false(intersectsSphere(ray, sphere, &hit));
    ray.origin = createVector(1.6, 0, 0);
    assert_false(intersectsSphere(ray, sphere, &hit));
    assert_true(hit.distance == 42);

    /* A ray that touches meets it. */
    ray.origin = createVector(1.5, 0, 0);
    assert_true(intersectsSphere(ray, sphere, &hit));
    assert_true(fabs(hit.distance - 5) < 1e-7);
}

static void sphereStaysExactWhereTheTextbookDoesNot(void **state)
{
    (void)state;
    /* A ground of radius 1e6 seen from 1 above it, straight down and at a slant. */
    Sphere ground = createSphere(createVector(0, -1e6, 0), 1e6, red);
    Intersection hit;
    Ray down = createRay(createVector(0, 1, 0), createVector(0, -1, 0));
    assert_true(intersectsSphere(down, ground, &hit));
    assert_true(fabs(hit.distance - 1) < 1e-9);
    /* A small sphere far away: seen at 1e7, where b^2 - c has no digits left. */
    Sphere speck = createSphere(createVector(0, 0, -1e7), 0.5, red);
    Ray ray = createRay(createVector(0, 0.4, 0), createVector(0, 0, -1));
    assert_true(intersectsSphere(ray, speck, &hit));
    assert_true(fabs(hit.normal.y - 0.8) < 1e-6);
    ray.origin.y = 0.5000001;
    assert_false(intersectsSphere(ray, speck, &hit));
}

static void boxFaces(void **state)
{
    (void)state;
    Box box = createBox(createVector(-1, -2, -3), createVector(1, 2, 3), red);
    const Vector3D axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double half[3] = {1, 2, 3};
    for (int i = 0; i < 3; i++) {
        for (int side = -1; side <= 1; side += 2) {
            Vector3D outward = multVector(axes[i], side);
            Intersection hit;
            Ray ray = createRay(multVector(outward, 10), multVector(outward, -1));
            assertHit(intersectsBox(ray, box, &hit), &hit, 10 - half[i], outward);
            ray = createRay(createVector(0, 0, 0), outward);
            assertHit(intersectsBox(ray, box, &hit), &hit, half[i], multVector(outward, -1));
            ray = createRay(multVector(outward, 10), outward);
            assert_false(intersectsBox(ray, box, &hit));
        }
    }
    /* Within the plane of a face it is met; beside it, it is not. */
    Intersection hit;
    assert_true(intersectsBox(createRay(createVector(1, 0, 9), createVector(0, 0, -1)), box, &hit));
    assert_false(intersectsBox(createRay(createVector(1.0000001, 0, 9), createVector(0, 0, -1)), box, &hit));

    /* Through an edge exactly: the face first in the order x, y, z; an edge that is only touched is met. */
    Box unit = createBox(createVector(-1, -1, -1), createVector(1, 1, 1), red);
    Vector3D slant = createVector(-sqrt(0.5), -sqrt(0.5), 0);
    assert_true(intersectsBox(createRay(createVector(3, 3, 0), slant), unit, &hit));
    assert_true(hit.normal.x == 1 && hit.normal.y == 0);
    slant.x = sqrt(0.5);
    assert_true(intersectsBox(createRay(createVector(0, 2, 0), slant), unit, &hit));
    assert_true(fabs(hit.position.x - 1) < 1e-15 && fabs(hit.position.y - 1) < 1e-15);

    Cube cube = createCube(createVector(0, 0, -5), 2, red);
    assertHit(intersectsCube(createRay(createVector(0, 0, 0), createVector(0, 0, -1)), cube, &hit), &hit, 4,
              createVector(0, 0, 1));
}

static void planeFromBothSides(void **state)
{
    (void)state;
    Plane plane = createPlane(createVector(7, -1, 3), createVector(0, 5, 0), red);
    Intersection hit;
    Ray ray = createRay(createVector(0, 1, 0), createVector(0, -1, 0));
    assertHit(intersectsPlane(ray, plane, &hit), &hit, 2, createVector(0, 1, 0));
    ray = createRay(createVector(0, -2, 0), createVector(0, 1, 0));
    assertHit(intersectsPlane(ray, plane, &hit), &hit, 1, createVector(0, -1, 0));
    ray = createRay(createVector(0, 1, 0), createVector(0, 1, 0));
    assert_false(intersectsPlane(ray, plane, &hit));
    ray = createRay(createVector(0, 1, 0), createVector(1, 0, 0));
    assert_false(intersectsPlane(ray, plane, &hit));
}

/* Kinds that have a shape of their own: not meshes, and not CSG. */
static bool isSimpleKind(int kind)
{
    return kind != SHAPE_MESH && kind != SHAPE_CSG;
}

static void hitsLieOnTheSurfaceAndNothingIsNearer(void **state)
{
    (void)state;
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        if (!isSimpleKind(kind))
            continue;
        size_t hits = 0, inside = 0;
        for (int i = 0; i < 20000; i++) {
            double size = pow(10, randomIn(-6, 6));
            Object object = randomObject((ShapeKind)kind, size);
            const Shape *shape = objectShape(&object);
            Vector3D target = randomTarget(&object, size);
            Ray ray = createRay(target, randomDirection());
            if (i % 3 != 0 || !shape->hasInside(&object))
                ray = rayFromTo(randomVector(3 * size), target);
            bool startsInside = shape->contains(&object, ray.origin);
            inside += startsInside;
            if (startsInside)
                assert_true(shape->hasInside(&object));
            Intersection hit;
            if (!intersectsObject(&ray, &object, &hit)) {
                /* From inside a closed shape there is always a way out. */
                assert_false(startsInside && kind != SHAPE_PLANE);
                continue;
            }
            hits++;
            double rounding =
                (shape->magnitude(&object) + largestCoordinate(ray.origin) + hit.distance) * 1e-14;
            assert_true(hit.distance > 0);
            assert_true(distanceToSurface(&object, hit.position) <= rounding);
            assert_true(fabs(norm(hit.normal) - 1) < 1e-9);
            assert_true(dot(hit.normal, ray.direction) <= 0);
            /* On the way there, inside stays inside and outside stays outside. */
            for (int step = 1; step < 8; step++) {
                Vector3D before = pointOnRay(&ray, hit.distance * step / 8);
                if (distanceToSurface(&object, before) > 10 * rounding &&
                    distanceToSurface(&object, ray.origin) > 10 * rounding)
                    assert_int_equal(shape->contains(&object, before), startsInside);
            }
            /* A little along the normal is the ray's side. */
            double little = 1e3 * rounding;
            assert_int_equal(
                shape->contains(&object, addVectors(hit.position, multVector(hit.normal, little))),
                startsInside);
        }
        assert_true(hits > 5000);
        assert_true(inside > 500 || kind == SHAPE_TRIANGLE || kind == SHAPE_DISC);
    }
}

/* Between two hits a ray is all inside or all outside, and at each it changes over. So no hit is missing and
 * none is too many, wherever the ray starts. */
static void everyHitIsReported(void **state)
{
    (void)state;
    size_t most[SHAPE_COUNT] = {0};
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        for (int i = 0; i < 10000 && isSimpleKind(kind); i++) {
            double size = pow(10, randomIn(-6, 6));
            Object object = randomObject((ShapeKind)kind, size);
            if (!objectShape(&object)->hasInside(&object))
                continue;
            Vector3D target = randomTarget(&object, size);
            Ray ray = createRay(target, randomDirection());
            /* Some start inside, some near, some far away. */
            double magnitude = objectShape(&object)->magnitude(&object);
            if (i % 4 != 0)
                ray.origin = pointOnRay(&ray, -magnitude * pow(10, randomIn(-1, 2)));
            double rounding = (magnitude + largestCoordinate(ray.origin)) * 1e-13;
            HitSink sink = allHits(&object, &ray);
            if (sink.count > most[kind])
                most[kind] = sink.count;
            assert_true(sink.count == 0 || sink.nearest.distance == sink.all[0].distance);

            bool inside = objectContains(&object, ray.origin);
            double before = 0;
            for (size_t h = 0; h <= sink.count; h++) {
                double end = h < sink.count ? sink.all[h].distance : before + 10 * magnitude;
                for (int step = 1; step < 16; step++) {
                    Vector3D p = pointOnRay(&ray, before + (end - before) * step / 16);
                    if (distanceToSurface(&object, p) > rounding)
                        assert_int_equal(objectContains(&object, p), inside);
                }
                inside = !inside;
                before = end;
            }
            freeHitSink(&sink);
        }
    }
    assert_int_equal(most[SHAPE_SPHERE], 2);
    assert_int_equal(most[SHAPE_BOX], 2);
    assert_int_equal(most[SHAPE_PLANE], 1);
    assert_int_equal(most[SHAPE_CONE], 2);
    assert_int_equal(most[SHAPE_TORUS], 4);
}

/* Rays that start on the surface, run along it, touch it, or have zeros in their direction: no hit is NaN,
 * at or behind the start, or off the surface. */
static void nastyRaysGiveNoNonsense(void **state)
{
    (void)state;
    const Vector3D axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        for (int i = 0; i < 30000 && isSimpleKind(kind); i++) {
            double size = i % 2 == 0 ? 1 : pow(10, randomIn(-6, 6));
            Object object = randomObject((ShapeKind)kind, size);
            if (i % 2 == 0 && kind == SHAPE_CONE)
                object.cone = createCone(createVector(0, 0, 0), createVector(0, 1, 0), 1, i % 4 == 0 ? 1 : 0,
                                         i % 3 == 0, defaultMaterial());
            if (i % 2 == 0 && kind == SHAPE_TORUS)
                object.torus = createTorus(2, i % 4 == 0 ? 2 : 0.5, defaultMaterial());
            const Shape *shape = objectShape(&object);

            /* Find a point on the surface, or take one of whole coordinates, and a tangent or an axis. */
            Ray ray = rayFromTo(randomVector(3 * size), randomTarget(&object, size));
            Vector3D on =
                createVector(floor(randomIn(-3, 4)), floor(randomIn(-3, 4)), floor(randomIn(-3, 4)));
            Vector3D direction = axes[i / 2 % 6];
            Intersection hit;
            if (i % 4 < 3 && intersectsObject(&ray, &object, &hit)) {
                on = hit.position;
                direction = i % 4 == 0 ? direction : normalize(cross(hit.normal, randomDirection()));
            }
            ray = createRay(on, direction);
            if (i % 5 == 0)
                ray.origin = pointOnRay(&ray, -4 * size);
            HitSink sink = allHits(&object, &ray);
            for (size_t h = 0; h < sink.count; h++) {
                double t = sink.all[h].distance;
                assert_true(t > 0 && t < INFINITY);
                Vector3D position = pointOnRay(&ray, t);
                double rounding = (shape->magnitude(&object) + largestCoordinate(ray.origin) + t) * 1e-14;
                assert_true(distanceToSurface(&object, position) <= rounding);
                assert_true(fabs(norm(shape->normal(&object, &sink.all[h], position)) - 1) < 1e-9);
            }
            freeHitSink(&sink);
        }
    }
}

/* Rays to a light start a little above the surface, by the tracer's rule; they must not meet the surface that
 * they start on. A hit is that surface when the ray is not farther from it half the way there. */
static void noSurfaceShadowsItself(void **state)
{
    (void)state;
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        size_t rays = 0;
        for (int i = 0; i < 20000 && isSimpleKind(kind); i++) {
            double size = pow(10, randomIn(-6, 6));
            Object object = randomObject((ShapeKind)kind, size);
            if (kind == SHAPE_TRIANGLE)
                object.triangle.isSmooth = false;
            Vector3D target = randomTarget(&object, size);
            Vector3D from =
                addVectors(target, multVector(randomDirection(), size * pow(10, randomIn(-2, 2))));
            Ray ray = rayFromTo(from, target);
            Intersection hit;
            if (!intersectsObject(&ray, &object, &hit))
                continue;
            double offset = hitMagnitude(&object, &ray, hit.distance) * 0x1p-40;
            Vector3D start = addVectors(hit.position, multVector(hit.normal, offset));
            /* Every other one grazes. */
            Vector3D direction = randomDirection();
            if (dot(direction, hit.normal) <= 0)
                direction = multVector(direction, -1);
            if (i % 2 == 0)
                direction = normalize(addVectors(cross(hit.normal, direction),
                                                 multVector(hit.normal, pow(10, randomIn(-9, -2)))));
            Ray toLight = createRay(start, direction);
            HitSink sink = createHitSink(0, false);
            intersectObject(&object, &toLight, &sink);
            rays++;
            if (!(sink.nearest.distance < INFINITY))
                continue;
            /* From inside a round surface the way along it ends soon, but at its other side. */
            Object solid = object;
            if (kind == SHAPE_CONE)
                solid.cone.isOpen = false;
            double t = sink.nearest.distance;
            if (objectContains(&solid, pointOnRay(&toLight, 2 * t)) == objectContains(&solid, start))
                assert_true(distanceToSurface(&object, pointOnRay(&toLight, t / 2)) > 0.9 * offset);
        }
        assert_true(rays > 3000 || !isSimpleKind(kind));
    }
}

static void boundsHoldEveryHit(void **state)
{
    (void)state;
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        for (int i = 0; i < 5000 && isSimpleKind(kind) && kind != SHAPE_PLANE; i++) {
            Object object = randomObject((ShapeKind)kind, 10);
            Bounds bounds;
            assert_true(objectShape(&object)->bounds(&object, &bounds));
            Ray ray = rayFromTo(randomVector(30), randomTarget(&object, 10));
            Intersection hit;
            if (intersectsObject(&ray, &object, &hit))
                assert_true(boundsHold(&bounds, hit.position, 1e-12));
        }
    }
    Bounds bounds = {{1, 2, 3}, {4, 5, 6}};
    Object plane = randomObject(SHAPE_PLANE, 1);
    assert_false(objectShape(&plane)->bounds(&plane, &bounds));
    assert_true(bounds.max.z == 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphereFromOutsideAndInside),
        cmocka_unit_test(sphereStaysExactWhereTheTextbookDoesNot),
        cmocka_unit_test(boxFaces),
        cmocka_unit_test(planeFromBothSides),
        cmocka_unit_test(hitsLieOnTheSurfaceAndNothingIsNearer),
        cmocka_unit_test(everyHitIsReported),
        cmocka_unit_test(nastyRaysGiveNoNonsense),
        cmocka_unit_test(noSurfaceShadowsItself),
        cmocka_unit_test(boundsHoldEveryHit),
    };
    return cmocka_run_group_tests_name("shapes", tests, NULL, NULL);
}
