/* pattern.h - a diffuse colour that depends on the point.
 *
 * A pattern is asked for the colour at a point of the object's own space: the coordinates in which the
 * object's keys are written, before its transform and its groups'. First the point is taken back through
 * the pattern's own transform, then divided by size. Where the colour changes, what lies within 1e-10 before
 * the change counts as behind it: a surface in that very plane has one colour. Ownership: a Scene owns its
 * patterns.
 */
#ifndef ECLAIRAGE_PATTERNS_PATTERN_H
#define ECLAIRAGE_PATTERNS_PATTERN_H

#include "colors.h"
#include "geometry.h"

#include <stddef.h>

typedef enum PatternKind {
    PATTERN_CHECKER,
    PATTERN_STRIPES,
    PATTERN_GRADIENT,
    PATTERN_IMAGE
} PatternKind;

typedef enum PatternMapping {
    MAPPING_PLANAR,   /* u = x, v = y, v up, repeating */
    MAPPING_SPHERICAL /* u = 1/2 - atan2(z, x) / 2pi, v = 1/2 + asin(y / |p|) / pi */
} PatternMapping;

typedef struct Pattern {
    PatternKind kind;
    Color3f colors[2]; /* a and b; not of an image */
    Vector3D axis;     /* stripes and gradient: the coordinate is p . axis; of unit length */
    double size;       /* above 0 */
    bool hasTransform;
    Transform transform;

    /* An image: nearest texel, row 0 at the top; linear colours. */
    PatternMapping mapping;
    int width, height;
    const Color3f *texels; /* owned by the scene */
    const char *path;      /* the PNG file, absolute, for POV-Ray; owned by the scene */
    bool isLinear;         /* the file's samples are linear, not sRGB */
    bool hasAlpha;         /* the file has transparency, which does not count here but does in POV-Ray */
} Pattern;

/* The colour at a point of the object's own space. */
Color3f patternColor(const Pattern *pattern, Vector3D point);

#endif
