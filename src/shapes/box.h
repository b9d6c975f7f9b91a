/* box.h - a block between two corners, its faces parallel to the axes; a cube is one with equal edges. */
#ifndef ECLAIRAGE_SHAPES_BOX_H
#define ECLAIRAGE_SHAPES_BOX_H

#include "shapes/intersection.h"

#include <stdbool.h>

typedef struct Box {
    Material material;
    Vector3D min, max; /* min below max in each coordinate */
} Box;

typedef struct Cube {
    Material material;
    Vector3D center;
    double size; /* the edge, above 0 */
} Cube;

Box createBox(Vector3D min, Vector3D max, Material material);
Cube createCube(Vector3D center, double size, Material material);

/* The nearest point at t > 0 where the ray meets the surface; from inside, that is where it leaves.
 * The normal is that of the face; on an edge, of the first of the faces in the order x, y, z. A ray
 * within the plane of a face meets the box. On a miss the intersection is untouched. */
bool intersectsBox(Ray ray, Box box, Intersection *intersection);
bool intersectsCube(Ray ray, Cube cube, Intersection *intersection);

#endif
