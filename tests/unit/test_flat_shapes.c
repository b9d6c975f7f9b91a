/* Triangle and disc: hits worked out by hand, edges that leave no gap, smooth normals, what is too thin to be
 * a triangle, and POV-Ray's words for them. */
#include "random_shapes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static Object triangleOf(Vector3D a, Vector3D b, Vector3D c)
{
    const Vector3D vertices[3] = {a, b, c};
    return (Object){.kind = SHAPE_TRIANGLE, .triangle = createTriangle(vertices, NULL, defaultMaterial())};
}

static bool isNear(Vector3D a, Vector3D b)
{
    return norm(subVectors(a, b)) < 1e-12;
}

/* The nearest hit of the ray from a point along a direction; false where there is none. */
static bool meets(const Object *object, Vector3D origin, Vector3D direction, Intersection *hit)
{
    Ray ray = createRay(origin, normalize(direction));
    return intersectsObject(&ray, object, hit);
}

static void triangleFromBothSides(void **state)
{
    (void)state;
    Object object = triangleOf(createVector(0, 0, 0), createVector(2, 0, 0), createVector(0, 2, 0));
    const Vector3D forward = {0, 0, -1}, back = {0, 0, 1};
    Intersection hit;
    assert_true(meets(&object, createVector(0.5, 0.25, 3), forward, &hit));
    assert_true(hit.distance == 3 && isNear(hit.normal, back));
    assert_true(meets(&object, createVector(0.5, 0.25, -4), back, &hit));
    assert_true(hit.distance == 4 && isNear(hit.normal, forward));

    /* u belongs to the second corner, v to the third. */
    Ray ray = createRay(createVector(0.5, 0.25, 3), forward);
    HitSink sink = createHitSink(0, false);
    intersectObject(&object, &ray, &sink);
    assert_true(fabs(sink.nearest.u - 0.25) < 1e-15 && fabs(sink.nearest.v - 0.125) < 1e-15);

    /* At a slant: the point (0.5, 0.5, 0) from (3.5, 4.5, 12) is 13 away. */
    assert_true(meets(&object, createVector(3.5, 4.5, 12), createVector(-3, -4, -12), &hit));
    assert_true(fabs(hit.distance - 13) < 1e-14);

    /* Edges and corners belong to it; beside them it ends. */
    const double on[][2] = {{0, 0}, {2, 0}, {0, 2}, {1, 0}, {0, 1}, {1, 1}};
    for (size_t i = 0; i < sizeof on / sizeof *on; i++)
        assert_true(meets(&object, createVector(on[i][0], on[i][1], 1), forward, &hit));
    hit.distance = 42;
    const double beside[][2] = {{-1e-9, 0.5}, {0.5, -1e-9}, {1 + 1e-9, 1}, {2.1, 0}, {-1, -1}};
    for (size_t i = 0; i < sizeof beside / sizeof *beside; i++)
        assert_false(meets(&object, createVector(beside[i][0], beside[i][1], 1), forward, &hit));

    /* Behind the ray, under its very start, along its plane and in it: misses. */
    assert_false(meets(&object, createVector(0.5, 0.5, 3), back, &hit));
    assert_false(meets(&object, createVector(0.5, 0.5, 0), back, &hit));
    assert_false(meets(&object, createVector(-1, 0.5, 1), createVector(1, 0, 0), &hit));
    assert_false(meets(&object, createVector(-1, 0.5, 0), createVector(1, 0, 0), &hit));
    assert_true(hit.distance == 42);
    assert_false(objectShape(&object)->hasInside(&object));
}

/* A ray to a point of the edge that two triangles share meets one of them, however the numbers round. */
static void noRayPassesBetweenTriangles(void **state)
{
    (void)state;
    for (int i = 0; i < 200000; i++) {
        double size = pow(10, randomIn(-6, 6));
        Vector3D a = randomVector(size), b = addVectors(a, randomVector(size * pow(10, randomIn(-3, 0))));
        Vector3D across = randomVector(size * 0.1), middle = multVector(addVectors(a, b), 0.5);
        /* On opposite sides of the edge, turned the same way or not, each beginning at any corner. */
        Vector3D above = addVectors(middle, across), below = subVectors(middle, across);
        const Vector3D one[3] = {a, b, above};
        const Vector3D other[3] = {i % 2 == 0 ? b : a, i % 2 == 0 ? a : b, below};
        int k = (int)(randomUnit() * 3), l = (int)(randomUnit() * 3);
        Object first = triangleOf(one[k], one[(k + 1) % 3], one[(k + 2) % 3]);
        Object second = triangleOf(other[l], other[(l + 1) % 3], other[(l + 2) % 3]);
        Vector3D on = addVectors(a, multVector(subVectors(b, a), randomIn(0.001, 0.999)));
        Ray ray = rayFromTo(addVectors(on, randomVector(size * 3)), on);
        /* Nearly along the plane both are invisible. */
        Vector3D n = normalize(cross(subVectors(b, a), across));
        if (fabs(dot(n, ray.direction)) < 1e-3)
            continue;
        Intersection hit;
        assert_true(intersectsObject(&ray, &first, &hit) || intersectsObject(&ray, &second, &hit));
    }
}

static void smoothNormalsAreInterpolated(void **state)
{
    (void)state;
    const Vector3D vertices[3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    const Vector3D normals[3] = {{0, 0, 5}, {3, 0, 4}, {0, 0.6, 0.8}};
    Object object = {.kind = SHAPE_TRIANGLE,
                     .triangle = createTriangle(vertices, normals, defaultMaterial())};
    const Vector3D forward = {0, 0, -1};
    Intersection hit;
    /* At the corners the normals themselves, made of unit length. */
    assert_true(meets(&object, createVector(0, 0, 1), forward, &hit));
    assert_true(isNear(hit.normal, createVector(0, 0, 1)));
    assert_true(meets(&object, createVector(2, 0, 1), forward, &hit));
    assert_true(isNear(hit.normal, createVector(0.6, 0, 0.8)));
    assert_true(meets(&object, createVector(0, 2, 1), forward, &hit));
    assert_true(isNear(hit.normal, createVector(0, 0.6, 0.8)));
    /* A quarter of the second, half of the third, and what is left of the first. */
    assert_true(meets(&object, createVector(0.5, 1, 1), forward, &hit));
    Vector3D mixed = createVector(0.25 * 0.6, 0.5 * 0.6, 0.25 + 0.25 * 0.8 + 0.5 * 0.8);
    assert_true(isNear(hit.normal, normalize(mixed)));
    /* From behind it is the interpolated normal that is turned. */
    assert_true(meets(&object, createVector(0.5, 1, -1), createVector(0, 0, 1), &hit));
    assert_true(isNear(hit.normal, multVector(normalize(mixed), -1)));
    /* Where normals cancel, the triangle's own is left. */
    object.triangle.normals[1] = createVector(0, 0, -1);
    assert_true(meets(&object, createVector(1, 0, 1), forward, &hit));
    assert_true(isNear(hit.normal, createVector(0, 0, 1)));
}

static void thinTrianglesAndNone(void **state)
{
    (void)state;
    Vector3D triangle[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const double scales[] = {1e-300, 1e-9, 1, 1e9, 1e300};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        double s = scales[i];
        /* Very thin is thin enough, on one line is not a triangle. */
        const Vector3D thin[3] = {{0, 0, 0}, {s, 0, 0}, {s / 2, s * 1e-9, 0}};
        const Vector3D line[3] = {
            {0.1 * s, 0.1 * s, 0.7 * s}, {0.2 * s, 0.2 * s, 0.8 * s}, {0.3 * s, 0.3 * s, 0.9 * s}};
        const Vector3D pair[3] = {{s, s, 0}, {s, s, 0}, {0, s, 0}};
        assert_true(isTriangle(thin));
        assert_false(isTriangle(line));
        assert_false(isTriangle(pair));
    }
    /* A line far from the origin, as rounded as its numbers are. */
    const Vector3D farLine[3] = {
        {1e6 + 0.1, 1e6 + 0.1, 0}, {1e6 + 0.2, 1e6 + 0.2, 0}, {1e6 + 0.7, 1e6 + 0.7, 0}};
    assert_false(isTriangle(farLine));
    const Vector3D point[3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    assert_false(isTriangle(point));
    assert_true(isTriangle(triangle));
    triangle[2].y = NAN;
    assert_false(isTriangle(triangle));
    triangle[2].y = INFINITY;
    assert_false(isTriangle(triangle));
}

static void discWithAndWithoutHole(void **state)
{
    (void)state;
    Object object = {
        .kind = SHAPE_DISC,
        .disc = createDisc(createVector(1, 2, 3), createVector(0, 7, 0), 1.5, 0.5, defaultMaterial())};
    const Vector3D up = {0, 1, 0}, down = {0, -1, 0};
    Intersection hit;
    assert_true(meets(&object, createVector(2, 5, 3), down, &hit));
    assert_true(hit.distance == 3 && isNear(hit.normal, up));
    assert_true(meets(&object, createVector(2, 0, 3), up, &hit));
    assert_true(hit.distance == 2 && isNear(hit.normal, down));
    /* Both rims belong to it. */
    assert_true(meets(&object, createVector(2.5, 5, 3), down, &hit));
    assert_true(meets(&object, createVector(1.5, 5, 3), down, &hit));
    hit.distance = 42;
    assert_false(meets(&object, createVector(2.5 + 1e-9, 5, 3), down, &hit));
    assert_false(meets(&object, createVector(1.5 - 1e-9, 5, 3), down, &hit));
    assert_false(meets(&object, createVector(1, 5, 3), down, &hit));
    /* Behind, at the start, along the plane, in the plane. */
    assert_false(meets(&object, createVector(2, 5, 3), up, &hit));
    assert_false(meets(&object, createVector(2, 2, 3), up, &hit));
    assert_false(meets(&object, createVector(-9, 3, 3), createVector(1, 0, 0), &hit));
    assert_false(meets(&object, createVector(-9, 2, 3), createVector(1, 0, 0), &hit));
    assert_true(hit.distance == 42);
    object.disc.innerRadius = 0;
    assert_true(meets(&object, createVector(1, 5, 3), down, &hit));
    assert_false(objectShape(&object)->hasInside(&object));
}

static void boundsAreTight(void **state)
{
    (void)state;
    /* A disc with the normal (1, 1, 1): each axis leaves the plane by the same angle, whose cosine is
     * sqrt(2/3). */
    Object object = {.kind = SHAPE_DISC,
                     .disc =
                         createDisc(createVector(1, 2, 3), createVector(1, 1, 1), 6, 0, defaultMaterial())};
    Bounds bounds;
    assert_true(objectShape(&object)->bounds(&object, &bounds));
    double reach = 6 * sqrt(2.0 / 3);
    assert_true(isNear(bounds.min, createVector(1 - reach, 2 - reach, 3 - reach)));
    assert_true(isNear(bounds.max, createVector(1 + reach, 2 + reach, 3 + reach)));

    object = triangleOf(createVector(1, -2, 3), createVector(4, 5, -6), createVector(-7, 8, 9));
    assert_true(objectShape(&object)->bounds(&object, &bounds));
    assert_true(isNear(bounds.min, createVector(-7, -2, -6)) && isNear(bounds.max, createVector(4, 8, 9)));
}

static void povWords(void **state)
{
    (void)state;
    Text pov = {0};
    Object object = triangleOf(createVector(1, 2, 3), createVector(4, 5, 6), createVector(7, 8, 0.5));
    objectShape(&object)->writePov(&object, 2, &pov);
    assert_string_equal(textString(&pov), "triangle { <2, 4, 6>, <8, 10, 12>, <14, 16, 1>");
    textFree(&pov);
    const Vector3D normals[3] = {{0, 0, 5}, {0, 3, 0}, {1, 0, 0}};
    object.triangle = createTriangle(object.triangle.vertices, normals, defaultMaterial());
    objectShape(&object)->writePov(&object, 2, &pov);
    /* POV-Ray ignores a smooth triangle whose normals are not all on one side of it, unless it is in a mesh.
     */
    assert_string_equal(
        textString(&pov),
        "mesh { smooth_triangle { <2, 4, 6>, <0, 0, 1>, <8, 10, 12>, <0, 1, 0>, <14, 16, 1>, <1, 0, 0> }");
    textFree(&pov);
    const Vector3D level[3] = {{1, 2, 3}, {4, 2, 3}, {1, 5, 3}}, up[3] = {{0, 0, 5}, {0, 0, 3}, {0, 0, 1}};
    object.triangle = createTriangle(level, up, defaultMaterial());
    objectShape(&object)->writePov(&object, 2, &pov);
    assert_string_equal(
        textString(&pov),
        "smooth_triangle { <2, 4, 6>, <0, 0, 1>, <8, 4, 6>, <0, 0, 1>, <2, 10, 6>, <0, 0, 1>");
    textFree(&pov);
    object = (Object){
        .kind = SHAPE_DISC,
        .disc = createDisc(createVector(1, 2, 3), createVector(0, 5, 0), 1.5, 0.25, defaultMaterial())};
    objectShape(&object)->writePov(&object, 2, &pov);
    assert_string_equal(textString(&pov), "disc { <2, 4, 6>, <0, 1, 0>, 3, 0.5");
    textFree(&pov);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangleFromBothSides),
        cmocka_unit_test(noRayPassesBetweenTriangles),
        cmocka_unit_test(smoothNormalsAreInterpolated),
        cmocka_unit_test(thinTrianglesAndNone),
        cmocka_unit_test(discWithAndWithoutHole),
        cmocka_unit_test(boundsAreTight),
        cmocka_unit_test(povWords),
    };
    return cmocka_run_group_tests_name("flat shapes", tests, NULL, NULL);
}
