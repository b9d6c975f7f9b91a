/* pov_scale.c - the size at which POV-Ray sees a scene as we do; see pov_scale.h. */
#include "povray/pov_scale.h"

#include "povray/pov_texture.h"

/* Parts that are a hundred times POV-Ray's shadow tolerance need no help. */
static const double SMALLEST_PART = 0.1;
static const double FARTHEST_PART = 1e4;
/* Even for the sake of small parts nothing is moved farther away; POV-Ray's limit is 1e7. */
static const double FARTHEST_EXPORTED = 0x1p22;

/* Inside glass, rays meet surfaces at all distances, down to nothing in the edges, and a shadow counts how
 * many it crosses; and on a mesh, shadow rays graze the neighbours of the triangle that they leave. So scenes
 * with either are made larger, as far as the horizon of a plane allows. */
static const double SMALLEST_OF_DELICATE = 128;
static const double FARTHEST_OF_DELICATE = 0x1p13;

/* The distance from the camera to the farthest corner of a box. */
static double farthestCorner(Bounds bounds, Vector3D camera)
{
    Vector3D toMin = subVectors(bounds.min, camera), toMax = subVectors(bounds.max, camera);
    return norm(createVector(fmax(fabs(toMin.x), fabs(toMax.x)), fmax(fabs(toMin.y), fabs(toMax.y)),
                             fmax(fabs(toMin.z), fabs(toMax.z))));
}

static bool hasMesh(const Object *object)
{
    for (size_t i = 0; object->kind == SHAPE_CSG && i < object->csg.partCount; i++)
        if (hasMesh(&object->csg.parts[i]))
            return true;
    return object->kind == SHAPE_MESH;
}

double povScale(const Scene *scene)
{
    /* Find the smallest part of the scene and how far its farthest part is from the camera. */
    double smallest = INFINITY, farthest = 0;
    for (size_t i = 0; i < scene->objectCount; i++) {
        const Object *object = &scene->objects[i];
        Bounds bounds;
        if (objectBounds(object, &bounds)) {
            Vector3D size = subVectors(bounds.max, bounds.min);
            smallest = fmin(smallest, fmin(size.x, fmin(size.y, size.z)));
            farthest = fmax(farthest, farthestCorner(bounds, scene->camera.position));
        }
    }
    for (size_t i = 0; i < scene->lightCount; i++)
        if (scene->lights[i].kind != LIGHT_DIRECTIONAL)
            farthest = fmax(farthest, norm(subVectors(scene->lights[i].position, scene->camera.position)));

    /* A scene of planes only is as large as its lights are far. */
    if (!isfinite(smallest))
        smallest = farthest;
    if (!(smallest > 0) || !isfinite(farthest) || !(farthest > 0))
        return 1;
    bool isDelicate = false;
    for (size_t i = 0; i < scene->objectCount && !isDelicate; i++)
        isDelicate = hasMesh(&scene->objects[i]) || transmissivePart(scene, &scene->objects[i]) != NULL;
    if (!isDelicate && smallest >= SMALLEST_PART && farthest <= FARTHEST_PART)
        return 1;

    /* Bring the smallest part to a size of 1 to 2, or more of a delicate scene, and the farthest within
     * reach. */
    double scale = exp2(-floor(log2(smallest)));
    while (farthest * scale > FARTHEST_EXPORTED)
        scale /= 2;
    while (isDelicate && smallest * scale < SMALLEST_OF_DELICATE &&
           farthest * scale * 2 <= FARTHEST_OF_DELICATE)
        scale *= 2;
    return scale;
}

double sceneExtent(const Scene *scene)
{
    double extent = largestCoordinate(scene->camera.position);
    for (size_t i = 0; i < scene->objectCount; i++) {
        Bounds bounds;
        if (objectBounds(&scene->objects[i], &bounds))
            extent = fmax(extent, fmax(largestCoordinate(bounds.min), largestCoordinate(bounds.max)));
    }
    return extent;
}
