/* Cylinder, cone, frustum and torus: hits worked out by hand, among them rays through rims, apexes and along
 * the surface, thin and far shapes, tight bounds, and POV-Ray's words for them. */
#include "random_shapes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static Object coneOf(Vector3D base, double baseRadius, Vector3D top, double topRadius, bool isOpen)
{
    return (Object){.kind = SHAPE_CONE,
                    .cone = createCone(base, top, baseRadius, topRadius, isOpen, defaultMaterial())};
}

/* Round the y axis from y = low to y = high. */
static Object upright(double low, double lowRadius, double high, double highRadius, bool isOpen)
{
    return coneOf(createVector(0, low, 0), lowRadius, createVector(0, high, 0), highRadius, isOpen);
}

static Object torusOf(double majorRadius, double minorRadius)
{
    return (Object){.kind = SHAPE_TORUS, .torus = createTorus(majorRadius, minorRadius, defaultMaterial())};
}

static int compareNumbers(const void *a, const void *b)
{
    double first = *(const double *)a, second = *(const double *)b;
    return (first > second) - (first < second);
}

/* That the ray has exactly these hits, in this order. */
static void assertHits(const Object *object, Vector3D origin, Vector3D direction, size_t count,
                       const double *distances, double tolerance)
{
    Ray ray = createRay(origin, normalize(direction));
    HitSink sink = createHitSink(0, true);
    intersectObject(object, &ray, &sink);
    assert_int_equal(sink.count, count);
    double found[8];
    for (size_t i = 0; i < count; i++)
        found[i] = sink.all[i].distance;
    qsort(found, count, sizeof *found, compareNumbers);
    for (size_t i = 0; i < count; i++)
        assert_true(fabs(found[i] - distances[i]) <= tolerance);
    freeHitSink(&sink);
}

#define ASSERT_HITS(object, origin, direction, ...)                                                          \
    assertHits(object, origin, direction, sizeof((double[]){__VA_ARGS__}) / sizeof(double),                  \
               (double[]){__VA_ARGS__}, 1e-13)
#define ASSERT_MISS(object, origin, direction) assertHits(object, origin, direction, 0, NULL, 0)

/* That the nearest hit has this normal. */
static void assertNormal(const Object *object, Vector3D origin, Vector3D direction, Vector3D normal)
{
    Ray ray = createRay(origin, normalize(direction));
    Intersection hit;
    assert_true(intersectsObject(&ray, object, &hit));
    assert_true(norm(subVectors(hit.normal, normal)) < 1e-12);
}

static const Vector3D left = {-1, 0, 0}, right = {1, 0, 0}, down = {0, -1, 0}, up = {0, 1, 0};

static void cylinderSideAndEnds(void **state)
{
    (void)state;
    Object closed = upright(-1, 1, 1, 1, false), open = upright(-1, 1, 1, 1, true);
    ASSERT_HITS(&closed, createVector(5, 0.5, 0), left, 4, 6);
    ASSERT_HITS(&open, createVector(5, 0.5, 0), left, 4, 6);
    assertNormal(&closed, createVector(5, 0.5, 0), left, right);
    ASSERT_HITS(&closed, createVector(0.5, 5, 0.5), down, 4, 6);
    assertNormal(&closed, createVector(0.5, 5, 0.5), down, up);
    assertNormal(&closed, createVector(0.5, -5, 0.5), up, down);
    ASSERT_MISS(&open, createVector(0.5, 5, 0.5), down);
    /* From inside, along the axis and across. */
    ASSERT_HITS(&closed, createVector(0, 0, 0), up, 1);
    assertNormal(&closed, createVector(0, 0, 0), up, down);
    ASSERT_HITS(&closed, createVector(0.25, 0, 0), right, 0.75);
    assertNormal(&closed, createVector(0.25, 0, 0), right, left);
    ASSERT_MISS(&open, createVector(0, 0, 0), up);
    /* In through an end, out through the side: (0, 2, 0) to (1, 0, 0), at y = 1 half the way. */
    ASSERT_HITS(&closed, createVector(0, 2, 0), createVector(1, -2, 0), sqrt(5) / 2, sqrt(5));
    ASSERT_HITS(&open, createVector(0, 2, 0), createVector(1, -2, 0), sqrt(5));
    /* Beside it, above it, behind it. */
    ASSERT_MISS(&closed, createVector(5, 1.0000001, 0), left);
    ASSERT_MISS(&closed, createVector(5, 0, 1.0000001), left);
    ASSERT_MISS(&closed, createVector(1.0000001, 5, 0), down);
    ASSERT_MISS(&closed, createVector(5, 0, 0), right);
    /* Within the plane of an end, along the side, and touching the side: these meet. */
    ASSERT_HITS(&closed, createVector(5, 1, 0), left, 4, 6);
    ASSERT_HITS(&closed, createVector(1, 5, 0), down, 4, 6);
    ASSERT_HITS(&closed, createVector(5, 0, 1), left, 5, 5);

    assert_true(objectContains(&closed, createVector(0.7, 0.99, 0.7)));
    assert_false(objectContains(&closed, createVector(0.8, 0.99, 0.7)));
    assert_false(objectContains(&closed, createVector(0, 1.01, 0)));
    assert_false(objectContains(&open, createVector(0, 0, 0)));
    assert_true(objectShape(&closed)->hasInside(&closed));
    assert_false(objectShape(&open)->hasInside(&open));
}

static void coneHasOneHalfAndAnApex(void **state)
{
    (void)state;
    /* Radius 1 at y = 0, apex at y = 1: the side falls by 45 degrees. */
    Object cone = upright(0, 1, 1, 0, false), open = upright(0, 1, 1, 0, true);
    const Vector3D outward = {sqrt(0.5), sqrt(0.5), 0};
    ASSERT_HITS(&cone, createVector(5, 0.5, 0), left, 4.5, 5.5);
    assertNormal(&cone, createVector(5, 0.5, 0), left, outward);
    ASSERT_HITS(&cone, createVector(0.25, 5, 0), down, 4.25, 5);
    assertNormal(&cone, createVector(0.25, 5, 0), down, outward);
    assertNormal(&cone, createVector(0.25, -5, 0), up, down);
    ASSERT_HITS(&open, createVector(0.25, 5, 0), down, 4.25);
    ASSERT_HITS(&open, createVector(0.25, -5, 0), up, 5.75);
    /* Straight through the apex; the cone's mirror image above it is not there. */
    ASSERT_HITS(&cone, createVector(0, 5, 0), down, 4, 5);
    ASSERT_HITS(&open, createVector(0, 5, 0), down, 4);
    ASSERT_MISS(&cone, createVector(5, 1.5, 0), left);
    /* At a slant steeper and flatter than the side: (1.5, 2, 0) to (0, -1, 0), and (2, 0.75, 0) to (-2, 0.25,
     * 0): x = 1 - y and x = y - 1 on the lines y = -1 + 2x and y = 0.5 + x/8. */
    ASSERT_HITS(&cone, createVector(1.5, 2, 0), createVector(-1, -2, 0), (1.5 - 2.0 / 3) * sqrt(5), sqrt(5));
    ASSERT_HITS(&cone, createVector(2, 0.75, 0), createVector(-8, -1, 0), (2 - 4.0 / 9) * sqrt(65) / 8,
                (2 + 4.0 / 7) * sqrt(65) / 8);
    /* Parallel to the side, inside: from (-0.5, 0, 0) up along (1, 1, 0) there is one way out, at (0.25,
     * 0.75, 0). */
    ASSERT_HITS(&open, createVector(-0.5, 0, 0), createVector(1, 1, 0), 0.75 * sqrt(2));
    ASSERT_HITS(&open, createVector(0.75, 1.25, 0), createVector(-1, -1, 0), 0.5 * sqrt(2));
    ASSERT_HITS(&cone, createVector(0.75, 1.25, 0), createVector(-1, -1, 0), 0.5 * sqrt(2), 1.25 * sqrt(2));

    /* The other way round: apex below. */
    Object funnel = upright(0, 0, 1, 1, true);
    ASSERT_HITS(&funnel, createVector(5, 0.25, 0), left, 4.75, 5.25);
    assertNormal(&funnel, createVector(5, 0.25, 0), left, createVector(sqrt(0.5), -sqrt(0.5), 0));
    assertNormal(&funnel, createVector(0.25, 5, 0), down, createVector(-sqrt(0.5), sqrt(0.5), 0));

    /* A frustum: radius 2 at y = 0, 1 at y = 1. */
    Object frustum = upright(0, 2, 1, 1, false);
    ASSERT_HITS(&frustum, createVector(5, 0.5, 0), left, 3.5, 6.5);
    ASSERT_HITS(&frustum, createVector(0.5, 5, 0), down, 4, 5);
    ASSERT_HITS(&frustum, createVector(1.5, 5, 0), down, 4.5, 5);
    assert_true(objectContains(&frustum, createVector(1.4, 0.5, 0)));
    assert_false(objectContains(&frustum, createVector(1.6, 0.5, 0)));
    assert_false(objectContains(&cone, createVector(0, 1.5, 0)));
}

static void coneStaysExactThinAndFar(void **state)
{
    (void)state;
    /* A wire of radius 1e-4 and length 2000. */
    Object wire = upright(-1000, 1e-4, 1000, 1e-4, false);
    ASSERT_HITS(&wire, createVector(5, 700, 0), left, 5 - 1e-4, 5 + 1e-4);
    ASSERT_MISS(&wire, createVector(5, 700, 1.0001e-4), left);
    assertHits(&wire, createVector(5, 705, 0), createVector(-1, -1, 0), 2,
               (double[]){(5 - 1e-4) * sqrt(2), (5 + 1e-4) * sqrt(2)}, 1e-12);
    assertHits(&wire, createVector(800, -100, 0), createVector(-1, 1, 0), 2,
               (double[]){(800 - 1e-4) * sqrt(2), (800 + 1e-4) * sqrt(2)}, 1e-11);
    /* A needle that ends in a point: half its radius in the middle. */
    Object needle = upright(0, 1e-3, 1000, 0, false);
    ASSERT_HITS(&needle, createVector(5, 500, 0), left, 5 - 5e-4, 5 + 5e-4);
    /* A coin of thickness 1e-6, from above and from the side. */
    Object coin = upright(0, 1, 1e-6, 1, false);
    ASSERT_HITS(&coin, createVector(0.5, 5, 0), down, 5 - 1e-6, 5);
    ASSERT_HITS(&coin, createVector(5, 5e-7, 0), left, 4, 6);
    /* A cone as flat as that, met half the way to its apex. */
    Object hat = upright(0, 1, 1e-6, 0, false);
    ASSERT_HITS(&hat, createVector(0.5, 5, 0), down, 5 - 5e-7, 5);
    /* Small and far away, where the textbook's discriminant has no digits left. */
    Object speck = coneOf(createVector(-1, 0, -1e7), 0.5, createVector(1, 0, -1e7), 0.5, false);
    Ray ray = createRay(createVector(0, 0.4, 0), createVector(0, 0, -1));
    Intersection hit;
    assert_true(intersectsObject(&ray, &speck, &hit));
    assert_true(fabs(hit.normal.y - 0.8) < 1e-6);
    ray.origin.y = 0.5000001;
    assert_false(intersectsObject(&ray, &speck, &hit));
}

static void coneBoundsAreTight(void **state)
{
    (void)state;
    for (int i = 0; i < 200; i++) {
        Object object = randomObject(SHAPE_CONE, 10);
        const Cone *cone = &object.cone;
        Bounds bounds, reached = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
        assert_true(objectShape(&object)->bounds(&object, &bounds));
        /* Walk along both rims. */
        Vector3D axis = normalize(subVectors(cone->top, cone->base));
        Vector3D x = normalize(cross(axis, randomDirection())), y = cross(axis, x);
        for (int step = 0; step < 2000; step++) {
            double angle = PI * (step / 2) / 500;
            Vector3D aside = addVectors(multVector(x, cos(angle)), multVector(y, sin(angle)));
            Vector3D p = step % 2 == 0 ? addVectors(cone->base, multVector(aside, cone->baseRadius))
                                       : addVectors(cone->top, multVector(aside, cone->topRadius));
            assert_true(boundsHold(&bounds, p, 1e-13));
            reached.min =
                createVector(fmin(reached.min.x, p.x), fmin(reached.min.y, p.y), fmin(reached.min.z, p.z));
            reached.max =
                createVector(fmax(reached.max.x, p.x), fmax(reached.max.y, p.y), fmax(reached.max.z, p.z));
        }
        double largest = fmax(cone->baseRadius, cone->topRadius);
        assert_true(boundsHold(&reached, bounds.min, 1e-5 * largest));
        assert_true(boundsHold(&reached, bounds.max, 1e-5 * largest));
    }
}

static void torusAcrossAndAlong(void **state)
{
    (void)state;
    Object torus = torusOf(2, 0.5);
    ASSERT_HITS(&torus, createVector(5, 0, 0), left, 2.5, 3.5, 6.5, 7.5);
    ASSERT_HITS(&torus, createVector(0, 0, 5), createVector(0, 0, -1), 2.5, 3.5, 6.5, 7.5);
    ASSERT_HITS(&torus, createVector(2, 5, 0), down, 4.5, 5.5);
    assertNormal(&torus, createVector(2, 5, 0), down, up);
    assertNormal(&torus, createVector(5, 0, 0), left, right);
    /* (3, 4, 5): 0.3 beside the middle of the ring and 0.4 high. */
    ASSERT_HITS(&torus, createVector(2.3, 5, 0), down, 4.6, 5.4);
    assertNormal(&torus, createVector(2.3, 5, 0), down, createVector(0.6, 0.8, 0));
    /* Through the hole, over it and round it. */
    ASSERT_MISS(&torus, createVector(0, 5, 0), down);
    ASSERT_MISS(&torus, createVector(1.4999999, 5, 0), down);
    ASSERT_MISS(&torus, createVector(5, 0.5000001, 0), left);
    ASSERT_MISS(&torus, createVector(5, 0, 2.5000001), left);
    /* Past the hole's rim, and a little into the hole: the circles of radius 1.5 and 2.5 at x = 1.5, 1.4. */
    ASSERT_HITS(&torus, createVector(1.5, 0, 5), createVector(0, 0, -1), 3, 7);
    ASSERT_HITS(&torus, createVector(1.4, 0, 5), createVector(0, 0, -1), 5 - sqrt(4.29), 5 - sqrt(0.29),
                5 + sqrt(0.29), 5 + sqrt(4.29));
    /* From inside the ring and from its hole. */
    ASSERT_HITS(&torus, createVector(2, 0, 0), right, 0.5);
    assertNormal(&torus, createVector(2, 0, 0), right, left);
    ASSERT_HITS(&torus, createVector(2, 0, 0), left, 0.5, 3.5, 4.5);
    ASSERT_HITS(&torus, createVector(0, 0, 0), left, 1.5, 2.5);
    assert_true(objectContains(&torus, createVector(0, 0.3, 2.3)));
    assert_false(objectContains(&torus, createVector(0, 0, 0)));
    assert_false(objectContains(&torus, createVector(0, 0.5, 2.1)));
    /* Just below the top it is met at both sides, a hair before and behind x = 2 and -2. */
    double hair = sqrt(1e-10 - 1e-20 / 4);
    assertHits(&torus, createVector(5, 0.5 - 1e-10, 0), left, 4,
               (double[]){3 - hair, 3 + hair, 7 - hair, 7 + hair}, 1e-7);

    Bounds bounds;
    assert_true(objectShape(&torus)->bounds(&torus, &bounds));
    assert_true(bounds.max.x == 2.5 && bounds.max.y == 0.5 && bounds.max.z == 2.5);
    assert_true(bounds.min.x == -2.5 && bounds.min.y == -0.5 && bounds.min.z == -2.5);
}

static void torusThinAndClosed(void **state)
{
    (void)state;
    /* Rings down to a millionth, where the quartic's last coefficient has hardly a digit left. */
    for (double r = 0.1; r > 1e-7; r /= 3) {
        Object ring = torusOf(1, r);
        ASSERT_HITS(&ring, createVector(5, 0, 0), left, 4 - r, 4 + r, 6 - r, 6 + r);
        ASSERT_HITS(&ring, createVector(1, 5, 0), down, 5 - r, 5 + r);
        ASSERT_HITS(&ring, createVector(0.6, 5, 0.8), down, 5 - r, 5 + r);
        ASSERT_MISS(&ring, createVector(5, 1.001 * r, 0), left);
        assertHits(&ring, createVector(1e6, 0, 0), left, 4,
                   (double[]){1e6 - 1 - r, 1e6 - 1 + r, 1e6 + 1 - r, 1e6 + 1 + r}, 1e-9);
    }
    /* Without a hole: the ring's inner circle is the origin. */
    Object horn = torusOf(1, 1);
    ASSERT_HITS(&horn, createVector(5, 0, 0), left, 3, 7);
    ASSERT_HITS(&horn, createVector(0.5, 5, 0), down, 5 - sqrt(0.75), 5 + sqrt(0.75));
    ASSERT_HITS(&horn, createVector(5, 0.5, 0), left, 4 - sqrt(0.75), 4 + sqrt(0.75), 6 - sqrt(0.75),
                6 + sqrt(0.75));
    assert_false(objectContains(&horn, createVector(0, 0, 0)));
    assert_false(objectContains(&horn, createVector(0, 1e-6, 0)));
    assert_true(objectContains(&horn, createVector(1e-6, 0, 0)));
    Hit hit = {.object = &horn};
    assert_true(norm(objectShape(&horn)->normal(&horn, &hit, createVector(0, 0, 0))) == 1);
}

static void povWords(void **state)
{
    (void)state;
    const struct {
        Object object;
        const char *words;
    } cases[] = {
        {upright(1, 0.5, 2, 0.5, false), "cylinder { <0, 3, 0>, <0, 6, 0>, 1.5"},
        {upright(1, 0.5, 2, 0.5, true), "cylinder { <0, 3, 0>, <0, 6, 0>, 1.5 open"},
        {upright(1, 0.5, 2, 0, false), "cone { <0, 3, 0>, 1.5, <0, 6, 0>, 0"},
        {upright(1, 0.5, 2, 1, true), "cone { <0, 3, 0>, 1.5, <0, 6, 0>, 3 open"},
        {torusOf(2, 0.25), "torus { 6, 0.75"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Text pov = {0};
        objectShape(&cases[i].object)->writePov(&cases[i].object, 3, &pov);
        assert_string_equal(textString(&pov), cases[i].words);
        textFree(&pov);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cylinderSideAndEnds),
        cmocka_unit_test(coneHasOneHalfAndAnApex),
        cmocka_unit_test(coneStaysExactThinAndFar),
        cmocka_unit_test(coneBoundsAreTight),
        cmocka_unit_test(torusAcrossAndAlong),
        cmocka_unit_test(torusThinAndClosed),
        cmocka_unit_test(povWords),
    };
    return cmocka_run_group_tests_name("round shapes", tests, NULL, NULL);
}
