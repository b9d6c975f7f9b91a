/* pattern.c - a diffuse colour that depends on the point; see pattern.h. */
#include "patterns/pattern.h"

/* The whole number below x. A floor or the face of a box often lies in the very plane where a pattern
 * changes, and rounding alone would scatter its points to both sides: what is this near to the next number
 * counts as that, as in POV-Ray. */
static double wholePart(double x)
{
    const double nearby = 1e-10;
    return floor(x + nearby);
}

/* The part behind the point, in 0..1, of negative numbers too. */
static double fraction(double x)
{
    return fmax(x - wholePart(x), 0);
}

/* a where floor(x) + floor(y) + floor(z) is even. */
static Color3f checkerColor(const Pattern *pattern, Vector3D p)
{
    double sum = wholePart(p.x) + wholePart(p.y) + wholePart(p.z);
    return pattern->colors[fmod(sum, 2) != 0];
}

/* The texel at (u, v), which repeats outside 0..1. */
static Color3f texel(const Pattern *pattern, double u, double v)
{
    int column = (int)wholePart(fraction(u) * pattern->width);
    int row = (int)wholePart(fraction(v) * pattern->height);
    column = column < pattern->width ? column : pattern->width - 1;
    row = row < pattern->height ? row : pattern->height - 1;
    return pattern->texels[(size_t)(pattern->height - 1 - row) * (size_t)pattern->width + (size_t)column];
}

static Color3f imageColor(const Pattern *pattern, Vector3D p)
{
    const double pi = 3.14159265358979323846;
    if (pattern->mapping == MAPPING_PLANAR)
        return texel(pattern, p.x, p.y);
    double length = norm(p);
    double latitude = length > 0 ? asin(fmax(-1, fmin(1, p.y / length))) : 0;
    return texel(pattern, 0.5 - atan2(p.z, p.x) / (2 * pi), 0.5 + latitude / pi);
}

Color3f patternColor(const Pattern *pattern, Vector3D point)
{
    if (pattern->hasTransform)
        point = transformPoint(&pattern->transform.objectFromWorld, point);
    point = multVector(point, 1 / pattern->size);
    double along = dot(point, pattern->axis);
    switch (pattern->kind) {
    case PATTERN_CHECKER:
        return checkerColor(pattern, point);
    case PATTERN_STRIPES:
        return pattern->colors[wholePart(2 * fraction(along)) != 0];
    case PATTERN_GRADIENT:
        return mixColors(pattern->colors[0], pattern->colors[1], fraction(along));
    default:
        return imageColor(pattern, point);
    }
}
