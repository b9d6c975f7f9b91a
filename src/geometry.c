/* geometry.c - points, directions and rays; see geometry.h. */
#include "geometry.h"

#include <float.h>

Vector3D normalize(Vector3D v)
{
    double squared = dot(v, v);
    /* Bring vectors whose square leaves the range of a double to a size where it does not. */
    if (!(squared > DBL_MIN && squared < DBL_MAX)) {
        double largest = largestCoordinate(v);
        if (largest == 0 || !isfinite(largest))
            return v;
        int exponent;
        frexp(largest, &exponent);
        v = (Vector3D){ldexp(v.x, -exponent), ldexp(v.y, -exponent), ldexp(v.z, -exponent)};
        squared = dot(v, v);
    }
    return multVector(v, 1 / sqrt(squared));
}

Vector3D reflect(Vector3D v, Vector3D n)
{
    return subVectors(v, multVector(n, 2.0 * dot(v, n)));
}
