/* geometry.c - points, directions and rays; see geometry.h. */
#include "geometry.h"

Vector3D normalize(Vector3D v)
{
    double squared = dot(v, v);
    /* Bring vectors whose square leaves the range of a double to a size where it does not. */
    if (!isUsualSquare(squared)) {
        double largest = largestCoordinate(v);
        if (largest == 0 || !isfinite(largest))
            return v;
        int exponent;
        frexp(largest, &exponent);
        v = (Vector3D){ldexp(v.x, -exponent), ldexp(v.y, -exponent), ldexp(v.z, -exponent)};
        squared = dot(v, v);
    }
    return normalizeUsual(v, squared);
}

Matrix identityMatrix(void)
{
    return (Matrix){.x = {1, 0, 0}, .y = {0, 1, 0}, .z = {0, 0, 1}};
}

Matrix translationMatrix(Vector3D by)
{
    Matrix matrix = identityMatrix();
    matrix.translate = by;
    return matrix;
}

Matrix scalingMatrix(Vector3D factors)
{
    return (Matrix){.x = {factors.x, 0, 0}, .y = {0, factors.y, 0}, .z = {0, 0, factors.z}};
}

/* Where the rotation takes v: v cos a + (k x v) sin a + k (k.v)(1 - cos a), k the unit axis (Rodrigues 1840).
 */
static Vector3D rotated(Vector3D v, Vector3D k, double sine, double cosine)
{
    Vector3D along = multVector(k, dot(k, v) * (1 - cosine));
    return addVectors(addVectors(multVector(v, cosine), multVector(cross(k, v), sine)), along);
}

Matrix rotationMatrix(Vector3D axis, double angle)
{
    const double pi = 3.14159265358979323846;
    Vector3D k = normalize(axis);
    /* Quarter turns are exact. */
    double quarters = angle / 90;
    double radians = angle * pi / 180;
    double sine = sin(radians), cosine = cos(radians);
    if (quarters == floor(quarters) && fabs(quarters) < 1e9) {
        int turn = (int)(((long long)quarters % 4 + 4) % 4);
        sine = turn == 1 ? 1 : turn == 3 ? -1 : 0;
        cosine = turn == 0 ? 1 : turn == 2 ? -1 : 0;
    }
    return (Matrix){.x = rotated(createVector(1, 0, 0), k, sine, cosine),
                    .y = rotated(createVector(0, 1, 0), k, sine, cosine),
                    .z = rotated(createVector(0, 0, 1), k, sine, cosine)};
}

Matrix composeMatrices(const Matrix *first, const Matrix *second)
{
    return (Matrix){.x = transformDirection(second, first->x),
                    .y = transformDirection(second, first->y),
                    .z = transformDirection(second, first->z),
                    .translate = transformPoint(second, first->translate)};
}

double matrixNorm(const Matrix *m)
{
    return fmax(fabs(m->x.x) + fabs(m->y.x) + fabs(m->z.x),
                fmax(fabs(m->x.y) + fabs(m->y.y) + fabs(m->z.y), fabs(m->x.z) + fabs(m->y.z) + fabs(m->z.z)));
}

bool createTransform(const Matrix *worldFromObject, Transform *transform)
{
    /* The inverse of (x y z) has the rows y x z, z x x, x x y, divided by the determinant x . (y x z). */
    const Matrix *m = worldFromObject;
    Vector3D rowX = cross(m->y, m->z), rowY = cross(m->z, m->x), rowZ = cross(m->x, m->y);
    double determinant = dot(m->x, rowX);
    double size = norm(m->x) * norm(m->y) * norm(m->z);
    if (!(fabs(determinant) > 1e-12 * size) || !isfinite(determinant) || !isfinite(1 / determinant) ||
        !isfinite(largestCoordinate(m->translate)))
        return false;
    double d = 1 / determinant;
    Matrix inverse = {.x = {rowX.x * d, rowY.x * d, rowZ.x * d},
                      .y = {rowX.y * d, rowY.y * d, rowZ.y * d},
                      .z = {rowX.z * d, rowY.z * d, rowZ.z * d}};
    inverse.translate = multVector(transformDirection(&inverse, m->translate), -1);
    if (!isfinite(matrixNorm(&inverse)) || !isfinite(largestCoordinate(inverse.translate)))
        return false;
    *transform = (Transform){*worldFromObject, inverse};
    return true;
}
