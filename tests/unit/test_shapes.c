/* The shapes: hits and normals worked out by hand, and for each shape the same properties over random
 * and nasty rays: the hit lies on the surface, nothing nearer does, the normal is the surface's and is
 * turned to the ray. */
#include "shapes/shape.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

static const Material red = {{1, 0, 0}, {0, 0, 0}, 32};

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
    return createVector(randomIn(-size, size), randomIn(-size, size), randomIn(-size, size));
}

static Ray rayFromTo(Vector3D from, Vector3D to)
{
    return createRay(from, normalize(subVectors(to, from)));
}

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

/* How far a point is from the surface of the object, worked out apart from the shape's own code. */
static double distanceToSurface(const Object *object, Vector3D p)
{
    Bounds bounds;
    switch (object->kind) {
    case SHAPE_SPHERE:
        return fabs(norm(subVectors(p, object->sphere.center)) - object->sphere.radius);
    case SHAPE_PLANE:
        return fabs(dot(object->plane.normal, subVectors(p, object->plane.point)));
    default:
        objectShape(object)->bounds(object, &bounds);
        double dx = fmax(bounds.min.x - p.x, p.x - bounds.max.x);
        double dy = fmax(bounds.min.y - p.y, p.y - bounds.max.y);
        double dz = fmax(bounds.min.z - p.z, p.z - bounds.max.z);
        return fabs(fmax(dx, fmax(dy, dz)));
    }
}

static Object randomObject(ShapeKind kind, double size)
{
    Vector3D at = randomVector(size);
    double part = size * pow(10, randomIn(-3, 0));
    switch (kind) {
    case SHAPE_SPHERE:
        return (Object){.kind = kind, .sphere = createSphere(at, part, red)};
    case SHAPE_CUBE:
        return (Object){.kind = kind, .cube = createCube(at, part, red)};
    case SHAPE_BOX:
        return (Object){.kind = kind,
                        .box = createBox(at, addVectors(at, createVector(part, 2 * part, part / 3)), red)};
    default:
        return (Object){.kind = kind, .plane = createPlane(at, randomVector(1), red)};
    }
}

static void hitsLieOnTheSurfaceAndNothingIsNearer(void **state)
{
    (void)state;
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        size_t hits = 0, inside = 0;
        for (int i = 0; i < 20000; i++) {
            double size = pow(10, randomIn(-6, 6));
            Object object = randomObject((ShapeKind)kind, size);
            const Shape *shape = objectShape(&object);
            Vector3D target = addVectors(kind == SHAPE_PLANE ? object.plane.point : randomVector(size),
                                         randomVector(size * 0.01));
            Bounds bounds;
            if (shape->bounds(&object, &bounds))
                target =
                    createVector(randomIn(bounds.min.x, bounds.max.x), randomIn(bounds.min.y, bounds.max.y),
                                 randomIn(bounds.min.z, bounds.max.z));
            Vector3D origin = i % 3 == 0 ? target : randomVector(3 * size);
            Ray ray = createRay(origin, normalize(i % 3 == 0 ? randomVector(1) : subVectors(target, origin)));
            bool startsInside = shape->contains(&object, ray.origin);
            inside += startsInside;
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
            /* A little along the normal is the ray's side, a little against it the other. */
            double little = 1e3 * rounding;
            assert_int_equal(
                shape->contains(&object, addVectors(hit.position, multVector(hit.normal, little))),
                startsInside);
        }
        assert_true(hits > 6000);
        assert_true(inside > 500);
    }
}

static void boundsHoldEveryHit(void **state)
{
    (void)state;
    for (int kind = 0; kind < SHAPE_PLANE; kind++) {
        for (int i = 0; i < 5000; i++) {
            Object object = randomObject((ShapeKind)kind, 10);
            Bounds bounds;
            assert_true(objectShape(&object)->bounds(&object, &bounds));
            Ray ray =
                rayFromTo(randomVector(30),
                          addVectors(multVector(addVectors(bounds.min, bounds.max), 0.5), randomVector(1)));
            Intersection hit;
            if (!intersectsObject(&ray, &object, &hit))
                continue;
            Vector3D p = hit.position;
            double slack = 1e-12;
            assert_true(p.x >= bounds.min.x - slack && p.y >= bounds.min.y - slack &&
                        p.z >= bounds.min.z - slack);
            assert_true(p.x <= bounds.max.x + slack && p.y <= bounds.max.y + slack &&
                        p.z <= bounds.max.z + slack);
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
        cmocka_unit_test(boundsHoldEveryHit),
    };
    return cmocka_run_group_tests_name("shapes", tests, NULL, NULL);
}
