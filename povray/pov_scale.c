/* pov_scale.c - the size at which POV-Ray sees a scene as we do; see pov_scale.h. */
#include "povray/pov_scale.h"

/* Parts that are a hundred times POV-Ray's shadow tolerance need no help, nor does a camera that is a
 * hundred times its tolerance for hits away from a surface, which is a tenth of that. */
static const double SMALLEST_PART = 0.1;
static const double PART_PER_CLEARANCE = 10;
static const double FARTHEST_PART = 1e4;
/* Along edges where light would leak, POV-Ray's tolerance of 1e-3 is brought to some 1e-7. */
static const double NARROWEST_EDGE = 0x1p-12;
/* Even for the sake of small parts nothing is moved farther away; POV-Ray's limit is 1e7. */
static const double FARTHEST_EXPORTED = 0x1p22;

/* Inside glass, rays meet surfaces at all distances, down to nothing in the edges, and a shadow counts how
 * many it crosses. So scenes with glass are made larger, as far as the horizon of a plane allows. */
static const double SMALLEST_OF_GLASS = 128;
static const double FARTHEST_OF_GLASS = 0x1p13;

/* The smallest of the three sizes of a box that is not that of something flat. */
static double partSize(Bounds bounds)
{
    Vector3D size = subVectors(bounds.max, bounds.min);
    double flat = 1e-12 * largestCoordinate(size), smallest = INFINITY;
    const double sizes[3] = {size.x, size.y, size.z};
    for (int i = 0; i < 3; i++)
        if (sizes[i] > flat)
            smallest = fmin(smallest, sizes[i]);
    return smallest;
}

/* The distance from the camera to the farthest corner of a box. */
static double farthestCorner(Bounds bounds, Vector3D camera)
{
    Vector3D toMin = subVectors(bounds.min, camera), toMax = subVectors(bounds.max, camera);
    return norm(createVector(fmax(fabs(toMin.x), fabs(toMax.x)), fmax(fabs(toMin.y), fabs(toMax.y)),
                             fmax(fabs(toMin.z), fabs(toMax.z))));
}

/* How far away a bounded shape can be seen. */
static double farthestSeen(const Object *object, Bounds bounds, Vector3D camera)
{
    double corner = farthestCorner(bounds, camera);
    if (object->kind != SHAPE_SPHERE || object->transform != NULL)
        return corner;
    /* From outside, no farther than where a line through the camera touches the sphere: of the globe
     * one stands on, up to the horizon. (f - r)(f + r) keeps the digits that f^2 - r^2 would lose. */
    double f = norm(subVectors(object->sphere.center, camera)), r = object->sphere.radius;
    return f > r ? fmin(corner, sqrt((f - r) * (f + r))) : corner;
}

/* The distance to the surface along the direction; INFINITY on a miss. */
static double probe(const Object *object, Vector3D camera, Vector3D direction, Vector3D *normal)
{
    Ray ray = createRay(camera, normalize(direction));
    Intersection hit;
    if (!intersectsObject(&ray, object, &hit))
        return INFINITY;
    *normal = hit.normal;
    return hit.distance;
}

/* The distance to the surface along the ray; INFINITY on a miss. */
static double distanceAlong(const Object *object, Ray ray)
{
    Vector3D normal;
    return probe(object, ray.origin, ray.direction, &normal);
}

/* The distance from the camera to the nearest point of the surface, above 0: exact for spheres, planes and
 * blocks, since one of the probes goes straight there. */
static double clearance(const Object *object, Vector3D camera)
{
    Vector3D directions[9] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    int count = 6;
    Bounds bounds;
    if (objectBounds(object, &bounds)) {
        Vector3D nearest = createVector(fmin(fmax(camera.x, bounds.min.x), bounds.max.x),
                                        fmin(fmax(camera.y, bounds.min.y), bounds.max.y),
                                        fmin(fmax(camera.z, bounds.min.z), bounds.max.z));
        Vector3D middle = multVector(addVectors(bounds.min, bounds.max), 0.5);
        directions[count++] = subVectors(nearest, camera);
        directions[count++] = subVectors(middle, camera);
        directions[count++] = subVectors(camera, middle);
    }
    double shortest = INFINITY;
    for (int i = 0; i < count; i++) {
        Vector3D normal = {0, 0, 0};
        shortest = fmin(shortest, probe(object, camera, directions[i], &normal));
        /* From a point of a plane, its normal leads straight to it. */
        if (largestCoordinate(normal) > 0)
            shortest = fmin(shortest, probe(object, camera, multVector(normal, -1), &normal));
    }
    return shortest;
}

/* How far away the picture shows a shape without end: in each row, at the pixels nearest to the horizon. */
static double farthestInPicture(const Object *object, const Scene *scene)
{
    CameraFrame frame = cameraFrame(&scene->camera, scene->image.width, scene->image.height);
    /* With several samples a pixel, their rays are those of a larger picture. */
    int width = scene->image.width * scene->render.samples;
    int height = scene->image.height * scene->render.samples;
    double farthest = 0;
    for (int y = 0; y < height; y++) {
        /* Find by bisection where the row leaves the shape, if it does. */
        double distances[2];
        int low = 0, high = width - 1;
        for (int end = 0; end < 2; end++) {
            Ray ray = cameraRay(&frame, (end == 0 ? low : high) + 0.5, y + 0.5, width, height);
            distances[end] = distanceAlong(object, ray);
        }
        bool lowMeets = isfinite(distances[0]);
        while (lowMeets != isfinite(distances[1]) && high - low > 1) {
            int middle = low + (high - low) / 2;
            Ray ray = cameraRay(&frame, middle + 0.5, y + 0.5, width, height);
            double t = distanceAlong(object, ray);
            if (isfinite(t) == lowMeets) {
                low = middle;
                distances[0] = t;
            } else {
                high = middle;
                distances[1] = t;
            }
        }
        for (int end = 0; end < 2; end++)
            if (isfinite(distances[end]))
                farthest = fmax(farthest, distances[end]);
    }
    return farthest;
}

/* A tenth of the mean edge of the object's finest mesh: on a mesh, shadow rays graze the neighbours of the
 * triangle that they leave. INFINITY where there is none. */
static double finestMesh(const Object *object)
{
    double finest = INFINITY;
    for (size_t i = 0; object->kind == SHAPE_CSG && i < object->csg.partCount; i++)
        finest = fmin(finest, finestMesh(&object->csg.parts[i]));
    if (object->kind != SHAPE_MESH)
        return finest;
    double stretch = object->transform != NULL ? matrixNorm(&object->transform->worldFromObject) : 1;
    return 0.1 * object->mesh.data->meanEdge * stretch;
}

/* Whether the surface stands between the camera and a light, the camera on the inside or a plane's one side.
 * Along the edge of two walls POV-Ray does not see the wall that should hide the light: a shadow ray meets it
 * nearer than its tolerance, and not a second time as it does a block's that is seen from outside. */
static bool hidesLight(const Object *object, const Scene *scene)
{
    Bounds bounds;
    Vector3D camera = scene->camera.position;
    bool isCameraIn = objectContains(object, camera);
    bool hides = false;
    if (!object->noShadow && (isCameraIn || !objectBounds(object, &bounds)))
        for (size_t i = 0; i < scene->lightCount && !hides; i++) {
            const Light *light = &scene->lights[i];
            Vector3D from = light->kind == LIGHT_DIRECTIONAL
                                ? subVectors(camera, multVector(light->direction, FARTHEST_EXPORTED))
                                : light->position;
            hides = objectContains(object, from) != isCameraIn;
        }
    return hides;
}

double povScale(const Scene *scene)
{
    /* Find the smallest part of the scene and how far its farthest part is from the camera. Lights may be
     * anywhere: POV-Ray's limit is one for surfaces. */
    double smallest = INFINITY, farthest = 0, horizon = 0, room = INFINITY;
    for (size_t i = 0; i < scene->objectCount; i++) {
        const Object *object = &scene->objects[i];
        Bounds bounds;
        if (objectBounds(object, &bounds)) {
            smallest = fmin(smallest, partSize(bounds));
            farthest = fmax(farthest, farthestSeen(object, bounds, scene->camera.position));
            /* From the inside of a block or sphere nothing beyond it is seen. */
            if (transmissivePart(scene, object) == NULL && objectContains(object, scene->camera.position))
                room = fmin(room, farthestCorner(bounds, scene->camera.position));
        } else {
            horizon = fmax(horizon, farthestInPicture(object, scene));
        }
        smallest = fmin(smallest, finestMesh(object));
        smallest = fmin(smallest, PART_PER_CLEARANCE * clearance(object, scene->camera.position));
        if (scene->render.shadows && hidesLight(object, scene))
            smallest = fmin(smallest, NARROWEST_EDGE);
    }
    farthest = fmin(farthest, room);
    horizon = fmin(horizon, room);
    if (!(smallest > 0) || !isfinite(smallest) || !isfinite(farthest))
        return 1;
    bool hasGlass = false;
    for (size_t i = 0; i < scene->objectCount && !hasGlass; i++)
        hasGlass = transmissivePart(scene, &scene->objects[i]) != NULL;
    if (!hasGlass && smallest >= SMALLEST_PART && farthest <= FARTHEST_PART && horizon <= FARTHEST_EXPORTED)
        return 1;

    /* Bring the smallest part to a size of 1 to 2, or more with glass, and the farthest within
     * reach. A horizon may limit how much the scene grows, but is not worth making small parts smaller. */
    double scale = exp2(-floor(log2(smallest)));
    while (scale > 1 && horizon * scale > FARTHEST_EXPORTED)
        scale /= 2;
    while (farthest * scale > FARTHEST_EXPORTED)
        scale /= 2;
    while (hasGlass && smallest * scale < SMALLEST_OF_GLASS && farthest * scale * 2 <= FARTHEST_OF_GLASS &&
           horizon * scale * 2 <= FARTHEST_EXPORTED)
        scale *= 2;
    return scale;
}
