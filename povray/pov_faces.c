/* pov_faces.c - keeps faces of solids from coinciding in POV-Ray; see pov_faces.h. */
#include "povray/pov_faces.h"

#include <math.h>

/* Two planes are the same within this share of their numbers: what rounding does, and more. */
#define SAME_PLANE 0x1p-40

/* A face is moved by this share of its numbers; POV-Ray's own tolerances in cylinders and cones are 1e-9. */
#define STEP 0x1p-24

enum {
    MOST_FACES = 6 /* of one shape */
};

/* A flat face in world space. */
typedef struct Face {
    Vector3D point;
    Vector3D normal; /* of unit length, outwards */
} Face;

static Vector3D boxCorner(const Object *object, bool isMax)
{
    if (object->kind == SHAPE_BOX)
        return isMax ? object->box.max : object->box.min;
    double half = object->cube.size / 2;
    Vector3D corner = createVector(half, half, half);
    return isMax ? addVectors(object->cube.center, corner) : subVectors(object->cube.center, corner);
}

/* The flat faces in the shape's own space: of a block -x, x, -y, y, -z, z; of a cone base and top, also where
 * there is none, being a tip or open. */
static int ownFaces(const Object *object, Face *faces)
{
    if (object->kind == SHAPE_BOX || object->kind == SHAPE_CUBE) {
        for (int i = 0; i < 6; i++) {
            double sign = i % 2 == 0 ? -1 : 1;
            Vector3D normal =
                createVector(i / 2 == 0 ? sign : 0, i / 2 == 1 ? sign : 0, i / 2 == 2 ? sign : 0);
            faces[i] = (Face){boxCorner(object, i % 2 == 1), normal};
        }
        return 6;
    }
    if (object->kind == SHAPE_CONE) {
        Vector3D axis = normalize(subVectors(object->cone.top, object->cone.base));
        faces[0] = (Face){object->cone.base, multVector(axis, -1)};
        faces[1] = (Face){object->cone.top, axis};
        return 2;
    }
    if (object->kind == SHAPE_PLANE) {
        faces[0] = (Face){object->plane.point, object->plane.normal};
        return 1;
    }
    return 0;
}

static int worldFaces(const Object *object, Face *faces)
{
    int count = ownFaces(object, faces);
    for (int i = 0; i < count && object->transform != NULL; i++) {
        faces[i].point = transformPoint(&object->transform->worldFromObject, faces[i].point);
        faces[i].normal = normalize(transformNormal(&object->transform->objectFromWorld, faces[i].normal));
    }
    return count;
}

/* How large the numbers are that its faces are computed from. */
static double worldMagnitude(const Object *object)
{
    double own = objectShape(object)->magnitude(object);
    if (object->transform == NULL)
        return own;
    const Matrix *matrix = &object->transform->worldFromObject;
    return matrixNorm(matrix) * own + largestCoordinate(matrix->translate);
}

static double overlap(double minA, double maxA, double minB, double maxB)
{
    return fmin(maxA, maxB) - fmax(minA, minB);
}

/* Whether the boxes round the two have more than slack in common: on all axes when they are on the same side
 * of a face, on two when they only touch. */
static bool isBeside(const Object *a, const Object *b, bool sameSide, double slack)
{
    Bounds first, second;
    if (!objectBounds(a, &first) || !objectBounds(b, &second))
        return true;
    int axes = (overlap(first.min.x, first.max.x, second.min.x, second.max.x) > slack) +
               (overlap(first.min.y, first.max.y, second.min.y, second.max.y) > slack) +
               (overlap(first.min.z, first.max.z, second.min.z, second.max.z) > slack);
    return axes >= (sameSide ? 3 : 2);
}

/* Whether the face of the part lies in one of the other object: 1 when the two solids are on the same side of
 * it, -1 on different sides, 0 when it does not. What the other takes away does not count. */
static int findShared(const Object *part, const Face *face, const Object *other)
{
    if (other->kind == SHAPE_CSG) {
        size_t count = other->csg.operation == CSG_DIFFERENCE ? 1 : other->csg.partCount;
        int shared = 0;
        for (size_t i = 0; i < count && shared == 0; i++)
            shared = findShared(part, face, &other->csg.parts[i]);
        return shared;
    }
    Face faces[MOST_FACES];
    int count = worldFaces(other, faces);
    double slack = (worldMagnitude(part) + worldMagnitude(other)) * SAME_PLANE;
    for (int i = 0; i < count; i++) {
        double cosine = dot(face->normal, faces[i].normal);
        if (fabs(cosine) > 1 - SAME_PLANE &&
            fabs(dot(face->normal, subVectors(faces[i].point, face->point))) <= slack &&
            isBeside(part, other, cosine > 0, slack))
            return cosine > 0 ? 1 : -1;
    }
    return 0;
}

/* How many steps outwards a face goes where it coincides with one of another part of the solid; shared: as
 * above. Of surfaces that both count the first stays, of an intersection the last, as in csg.c. */
static double stepsOutwards(const Csg *csg, size_t part, size_t other, int shared)
{
    switch (csg->operation) {
    case CSG_GROUP:
        return 0;
    case CSG_INTERSECTION:
        return shared > 0 && part < other ? (double)(csg->partCount - part) : 0;
    case CSG_DIFFERENCE:
        if (part == 0)
            return 0;
        if (other == 0) /* a cut that ends in the first's surface opens it; one that touches it leaves it */
            return shared * (double)part;
        break;
    default:
        break;
    }
    /* Of what is one, the later goes into the former. */
    return part > other ? -shared * (double)part : 0;
}

/* The same, by all parts of the solid and of those that it is a part of. */
static double stepsOfFace(const Object *part, const Face *face, const PovPart *place)
{
    for (; place != NULL; place = place->outer) {
        const Csg *csg = &place->solid->csg;
        for (size_t i = 0; i < csg->partCount; i++) {
            int shared = i != place->number ? findShared(part, face, &csg->parts[i]) : 0;
            double steps = stepsOutwards(csg, place->number, i, shared);
            if (shared != 0 && steps != 0)
                return steps;
        }
        /* The outside of what is taken away is an inside to those farther out. */
        if (csg->operation == CSG_DIFFERENCE && place->number > 0)
            return 0;
    }
    return 0;
}

Object separatedPart(const Object *part, const PovPart *place)
{
    Face faces[MOST_FACES];
    int count = part->kind != SHAPE_PLANE ? worldFaces(part, faces) : 0;
    double step = objectShape(part)->magnitude(part) * STEP;
    double outwards[MOST_FACES] = {0};
    bool isMoved = false;
    for (int i = 0; i < count; i++) {
        outwards[i] = step * stepsOfFace(part, &faces[i], place);
        isMoved |= outwards[i] != 0;
    }
    Object moved = *part;
    if (!isMoved)
        return moved;
    if (part->kind == SHAPE_CONE) {
        Cone *cone = &moved.cone;
        Vector3D axis = subVectors(cone->top, cone->base);
        double length = norm(axis), slope = (cone->topRadius - cone->baseRadius) / length;
        double baseRadius = part->cone.baseRadius - slope * outwards[0];
        double topRadius = part->cone.topRadius + slope * outwards[1];
        if (part->cone.baseRadius > 0 && baseRadius > 0) {
            cone->base = subVectors(part->cone.base, multVector(axis, outwards[0] / length));
            cone->baseRadius = baseRadius;
        }
        if (part->cone.topRadius > 0 && topRadius > 0) {
            cone->top = addVectors(part->cone.top, multVector(axis, outwards[1] / length));
            cone->topRadius = topRadius;
        }
        return moved;
    }
    Vector3D min = subVectors(boxCorner(part, false), createVector(outwards[0], outwards[2], outwards[4]));
    Vector3D max = addVectors(boxCorner(part, true), createVector(outwards[1], outwards[3], outwards[5]));
    moved.kind = SHAPE_BOX;
    moved.box = createBox(min, max, part->material);
    return moved;
}
