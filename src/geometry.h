/* geometry.h - points, directions and rays (handout: geometry.h).
 *
 * Right-handed world space, y up, lengths in scene units, everything in double. A Vector3D is a point
 * or a direction; which one, and whether it is of unit length, its name and comment say.
 */
#ifndef ECLAIRAGE_GEOMETRY_H
#define ECLAIRAGE_GEOMETRY_H

#include <float.h>
#include <math.h>
#include <stdbool.h>

typedef struct Vector3D {
    double x, y, z;
} Vector3D;

/* A half-line: the points origin + t direction for t > 0. */
typedef struct Ray {
    Vector3D origin;
    Vector3D direction; /* of unit length: t is then a distance */
} Ray;

static inline Vector3D createVector(double x, double y, double z)
{
    return (Vector3D){x, y, z};
}

static inline Ray createRay(Vector3D origin, Vector3D direction)
{
    return (Ray){origin, direction};
}

static inline Vector3D addVectors(Vector3D a, Vector3D b)
{
    return (Vector3D){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline Vector3D subVectors(Vector3D a, Vector3D b)
{
    return (Vector3D){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline Vector3D multVector(Vector3D v, double factor)
{
    return (Vector3D){v.x * factor, v.y * factor, v.z * factor};
}

static inline double dot(Vector3D a, Vector3D b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline Vector3D cross(Vector3D a, Vector3D b)
{
    return (Vector3D){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* The length. */
static inline double norm(Vector3D v)
{
    return sqrt(dot(v, v));
}

/* The point at distance t on the ray. */
static inline Vector3D pointOnRay(const Ray *ray, double t)
{
    return addVectors(ray->origin, multVector(ray->direction, t));
}

/* The largest of the coordinates' magnitudes: what rounding errors of a point are in proportion to. A y or z
 * that is not a number is passed over, an x that is not a number is the result. (Each comparison is written
 * so that it is one instruction; fmax would be a call of the library.) */
static inline double largestCoordinate(Vector3D v)
{
    double x = fabs(v.x), y = fabs(v.y), z = fabs(v.z);
    double larger = y > x ? y : x;
    return z > larger ? z : larger;
}

/* An affine map: where it takes the three axes, and then the translation. */
typedef struct Matrix {
    Vector3D x, y, z;
    Vector3D translate;
} Matrix;

/* A Matrix and its inverse. */
typedef struct Transform {
    Matrix worldFromObject, objectFromWorld;
} Transform;

static inline Vector3D transformDirection(const Matrix *matrix, Vector3D v)
{
    return addVectors(addVectors(multVector(matrix->x, v.x), multVector(matrix->y, v.y)),
                      multVector(matrix->z, v.z));
}

static inline Vector3D transformPoint(const Matrix *matrix, Vector3D p)
{
    return addVectors(transformDirection(matrix, p), matrix->translate);
}

/* Where the transpose of the matrix takes v. Normals go by the inverse transpose of the map: with
 * inverse = objectFromWorld it takes a normal from object to world space (not to unit length). */
static inline Vector3D transformNormal(const Matrix *inverse, Vector3D v)
{
    return (Vector3D){dot(inverse->x, v), dot(inverse->y, v), dot(inverse->z, v)};
}

/* The map that does first and then second. */
Matrix composeMatrices(const Matrix *first, const Matrix *second);

/* The steps that a scene file's `transform` is made of. axis: any length but 0; angle: degrees,
 * right-handed. */
Matrix identityMatrix(void);
Matrix translationMatrix(Vector3D by);
Matrix scalingMatrix(Vector3D factors);
Matrix rotationMatrix(Vector3D axis, double angle);

/* False, with transform untouched, when the map cannot be inverted: it squeezes space to a plane, or its
 * numbers leave the range of a double. */
bool createTransform(const Matrix *worldFromObject, Transform *transform);

/* An upper bound of how much longer a vector may get: the largest sum of magnitudes in a row. */
double matrixNorm(const Matrix *matrix);

/* The direction of v with length 1, of a v whose squared length is `squared`, where that is a usual number.
 */
static inline Vector3D normalizeUsual(Vector3D v, double squared)
{
    return multVector(v, 1 / sqrt(squared));
}

/* Neither too small nor too large: then normalize is normalizeUsual. */
static inline bool isUsualSquare(double squared)
{
    return squared > DBL_MIN && squared < DBL_MAX;
}

/* The direction of v with length 1. The zero vector, which has no direction, stays as it is. Right for
 * every finite v, also where |v|^2 would overflow or vanish. */
Vector3D normalize(Vector3D v);

/* v mirrored at the plane with unit normal n (handout, exercise 03b): R = V - N * 2.0 * dot(V, N). */
static inline Vector3D reflect(Vector3D v, Vector3D n)
{
    return subVectors(v, multVector(n, 2.0 * dot(v, n)));
}

#endif
