/* pattern.c - a diffuse colour that depends on the point; see pattern.h. */
#include "patterns/pattern.h"

/* The part behind the point, in 0..1, of negative numbers too. */
static double fraction(double x)
{
    return x - floor(x);
}

/* a where floor(x) + floor(y) + floor(z) is even. */
static Color3f checkerColor(const Pattern *pattern, Vector3D p)
{
    double sum = floor(p.x) + floor(p.y) + floor(p.z);
    return pattern->colors[fmod(sum, 2) != 0];
}

/* The texel at (u, v), which repeats outside 0..1. */
static Color3f texel(const Pattern *pattern, double u, double v)
{
    int column = (int)(fraction(u) * pattern->width);
    int row = (int)(fraction(v) * pattern->height);
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
        return pattern->colors[fraction(along) >= 0.5];
    case PATTERN_GRADIENT:
        return mixColors(pattern->colors[0], pattern->colors[1], fraction(along));
    default:
        return imageColor(pattern, point);
    }
}
