/* sphere_list.h - many spheres from a text file: four numbers a line, x y z radius. */
#ifndef ECLAIRAGE_SHAPES_SPHERE_LIST_H
#define ECLAIRAGE_SHAPES_SPHERE_LIST_H

#include "base/status.h"
#include "geometry.h"

#include <stddef.h>

typedef struct ListedSphere {
    Vector3D center;
    double radius; /* above 0 */
} ListedSphere;

/* Read the file: on each line the centre and the radius, separated by blanks; empty lines are fine, and `#`
 * begins a comment. On success the caller frees *spheres, of *count at least 1; on failure both are
 * untouched. STATUS_IO, or STATUS_SCENE with the line and column in that file in the status (0 where the
 * whole file is meant); STATUS_INTERRUPTED when cancelled. */
Status readSphereList(const char *path, ListedSphere **spheres, size_t *count);

/* The same from the text of a file, of length bytes with a NUL behind. */
Status parseSphereList(const char *text, size_t length, ListedSphere **spheres, size_t *count);

#endif
