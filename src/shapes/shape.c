/* shape.c - the table of shapes; see shape.h. */
#include "shapes/shape.h"

static const Shape *const shapes[SHAPE_COUNT] = {
#define X(kind, Type, name) [kind] = &name##Shape,
    SHAPES(X)
#undef X
};

const Shape *objectShape(const Object *object)
{
    return shapes[object->kind];
}

bool intersectsObject(const Ray *ray, const Object *object, Intersection *intersection)
{
    const Shape *shape = objectShape(object);
    double distance = shape->distance(object, ray);
    if (!(distance < INFINITY))
        return false;
    Vector3D position = pointOnRay(ray, distance);
    *intersection = (Intersection){.distance = distance,
                                   .position = position,
                                   .normal = shape->normal(object, ray, position),
                                   .material = object->material};
    return true;
}

void textAppendPovNumber(Text *pov, double value)
{
    textAppendDouble(pov, value);
}

void textAppendPovVector(Text *pov, Vector3D v, double scale)
{
    textAppend(pov, "<");
    textAppendPovNumber(pov, v.x * scale);
    textAppend(pov, ", ");
    textAppendPovNumber(pov, v.y * scale);
    textAppend(pov, ", ");
    textAppendPovNumber(pov, v.z * scale);
    textAppend(pov, ">");
}
