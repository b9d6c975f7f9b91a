/* box.c - a block between two corners, and the cube; see box.h.
 *
 * The block is what three slabs share, a slab being the space between two parallel faces. The ray is
 * inside a slab from entry t1 to exit t2, and inside the block from the largest of the three entries
 * to the smallest of the three exits, if that is an interval (Kay and Kajiya 1986, "Ray tracing complex
 * scenes", section 3). The face that was entered or left last gives the normal.
 */
#include "shapes/box.h"

#include "shapes/shape.h"

Box createBox(Vector3D min, Vector3D max, Material material)
{
    return (Box){material, min, max};
}

Cube createCube(Vector3D center, double size, Material material)
{
    return (Cube){material, center, size};
}

static Box boxOfCube(const Cube *cube)
{
    double half = cube->size / 2;
    Vector3D corner = createVector(half, half, half);
    return createBox(subVectors(cube->center, corner), addVectors(cube->center, corner), cube->material);
}

/* Report where the ray enters and leaves; the part of a hit is the axis of its face: 0, 1, 2 for x, y, z. */
static void hitBox(const Box *box, const Ray *ray, HitSink *sink)
{
    const double origin[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const double direction[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    const double min[3] = {box->min.x, box->min.y, box->min.z};
    const double max[3] = {box->max.x, box->max.y, box->max.z};

    double entry = -INFINITY, exit = INFINITY;
    int entryAxis = 0, exitAxis = 0;
    for (int i = 0; i < 3; i++) {
        /* A ray that runs along a slab is in it all the time or never. */
        if (direction[i] == 0) {
            if (origin[i] < min[i] || origin[i] > max[i])
                return;
            continue;
        }
        double t1 = ((direction[i] > 0 ? min[i] : max[i]) - origin[i]) / direction[i];
        double t2 = ((direction[i] > 0 ? max[i] : min[i]) - origin[i]) / direction[i];
        if (t1 > entry) {
            entry = t1;
            entryAxis = i;
        }
        if (t2 < exit) {
            exit = t2;
            exitAxis = i;
        }
    }
    if (entry > exit)
        return;
    reportHit(sink, entry, entryAxis, 0, 0);
    reportHit(sink, exit, exitAxis, 0, 0);
}

static Vector3D faceNormal(const Object *object, const Hit *hit, Vector3D position)
{
    (void)object;
    (void)position;
    return createVector(hit->part == 0, hit->part == 1, hit->part == 2);
}

static bool isInside(const Box *box, Vector3D p)
{
    return p.x > box->min.x && p.x < box->max.x && p.y > box->min.y && p.y < box->max.y && p.z > box->min.z &&
           p.z < box->max.z;
}

static double magnitude(const Box *box)
{
    return fmax(largestCoordinate(box->min), largestCoordinate(box->max));
}

static void writePov(const Box *box, double scale, Text *pov)
{
    textAppend(pov, "box { ");
    textAppendPovVector(pov, box->min, scale);
    textAppend(pov, ", ");
    textAppendPovVector(pov, box->max, scale);
}

static void boxIntersect(const Object *object, const Ray *ray, HitSink *sink)
{
    hitBox(&object->box, ray, sink);
}

static bool boxContains(const Object *object, Vector3D point)
{
    return isInside(&object->box, point);
}

static bool boxBounds(const Object *object, Bounds *bounds)
{
    *bounds = (Bounds){object->box.min, object->box.max};
    return true;
}

static double boxMagnitude(const Object *object)
{
    return magnitude(&object->box);
}

static void boxWritePov(const Object *object, double scale, Text *pov)
{
    writePov(&object->box, scale, pov);
}

const Shape boxShape = {.name = "box",
                        .intersect = boxIntersect,
                        .normal = faceNormal,
                        .contains = boxContains,
                        .hasInside = alwaysTrue,
                        .bounds = boxBounds,
                        .magnitude = boxMagnitude,
                        .writePov = boxWritePov};

static void cubeIntersect(const Object *object, const Ray *ray, HitSink *sink)
{
    Box box = boxOfCube(&object->cube);
    hitBox(&box, ray, sink);
}

static bool cubeContains(const Object *object, Vector3D point)
{
    Box box = boxOfCube(&object->cube);
    return isInside(&box, point);
}

static bool cubeBounds(const Object *object, Bounds *bounds)
{
    Box box = boxOfCube(&object->cube);
    *bounds = (Bounds){box.min, box.max};
    return true;
}

static double cubeMagnitude(const Object *object)
{
    Box box = boxOfCube(&object->cube);
    return magnitude(&box);
}

static void cubeWritePov(const Object *object, double scale, Text *pov)
{
    Box box = boxOfCube(&object->cube);
    writePov(&box, scale, pov);
}

const Shape cubeShape = {.name = "cube",
                         .intersect = cubeIntersect,
                         .normal = faceNormal,
                         .contains = cubeContains,
                         .hasInside = alwaysTrue,
                         .bounds = cubeBounds,
                         .magnitude = cubeMagnitude,
                         .writePov = cubeWritePov};

bool intersectsBox(Ray ray, Box box, Intersection *intersection)
{
    Object object = {.kind = SHAPE_BOX, .box = box};
    return intersectsObject(&ray, &object, intersection);
}

bool intersectsCube(Ray ray, Cube cube, Intersection *intersection)
{
    Object object = {.kind = SHAPE_CUBE, .cube = cube};
    return intersectsObject(&ray, &object, intersection);
}
