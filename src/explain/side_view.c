/* side_view.c - how the plane of a drawing lies in the scene; see side_view.h. */
#include "explain/side_view.h"

#include <math.h>

static Vector3D withoutPart(Vector3D v, Vector3D along)
{
    return subVectors(v, multVector(along, dot(v, along)));
}

/* The light whose direction the plane holds: one that reaches the point, else one that is blocked, else any.
 */
static const LightStory *chooseLight(const RayStory *ray)
{
    static const LightFate order[] = {LIGHT_REACHES, LIGHT_BLOCKED, LIGHT_DARK, LIGHT_BEHIND};
    for (size_t f = 0; f < sizeof order / sizeof *order; f++) {
        size_t first = ray->lightCount, last = 0;
        for (size_t i = 0; i < ray->lightCount; i++) {
            if (ray->lights[i].fate != order[f] ||
                (first < ray->lightCount && ray->lights[i].light != ray->lights[first].light))
                continue;
            first = first == ray->lightCount ? i : first;
            last = i;
        }
        /* Of an area's, one in the middle of those. */
        if (first < ray->lightCount)
            for (size_t i = (first + last) / 2; i < ray->lightCount; i++)
                if (ray->lights[i].fate == order[f])
                    return &ray->lights[i];
    }
    return NULL;
}

Vector3D endOfCameraRay(const RayStory *ray, double far)
{
    return ray->end == RAY_MEETS_SURFACE ? ray->point.position : pointOnRay(&ray->ray, far);
}

double sceneLength(const PixelStory *story)
{
    double length = 0;
    for (size_t i = 0; i < story->scene->objectCount && i < 1000; i++) {
        Bounds bounds;
        if (objectBounds(&story->scene->objects[i], &bounds)) {
            Vector3D middle = multVector(addVectors(bounds.min, bounds.max), 0.5);
            length = fmax(length, fmin(norm(subVectors(middle, story->ray->ray.origin)), 1e6));
        }
    }
    return length > 0 ? length : 5;
}

static void includePoint(DrawnPoint range[2], Vector3D origin, const DrawingPlane *plane, Vector3D p)
{
    Vector3D d = subVectors(p, origin);
    double x = dot(d, plane->right), y = dot(d, plane->up);
    range[0] = (DrawnPoint){fmin(range[0].x, x), fmin(range[0].y, y)};
    range[1] = (DrawnPoint){fmax(range[1].x, x), fmax(range[1].y, y)};
}

const LightStory *choosePlane(const PixelStory *story, double far, DrawingPlane *plane)
{
    const RayStory *ray = story->ray;
    const Scene *scene = story->scene;
    Vector3D a = ray->ray.direction, end = endOfCameraRay(ray, far);
    Vector3D cameraUp = normalize(scene->camera.up);
    bool hasPoint = ray->end == RAY_MEETS_SURFACE;
    const LightStory *chosen = hasPoint && !ray->isUnlit ? chooseLight(ray) : NULL;

    /* The second direction: to the light, or the normal, or the camera's up. */
    Vector3D b = chosen != NULL ? withoutPart(chosen->arriving.direction, a) : createVector(0, 0, 0);
    if (norm(b) < 1e-3 && hasPoint)
        b = withoutPart(ray->point.normal, a);
    if (norm(b) < 1e-3)
        b = withoutPart(cameraUp, a);
    if (norm(b) < 1e-3)
        b = withoutPart(fabs(a.x) < 0.9 ? createVector(1, 0, 0) : createVector(0, 1, 0), a);
    b = normalize(b);
    Vector3D normal = normalize(cross(a, b));

    /* Up in the drawing is the camera's up, where that can be seen; the camera looks to the right. */
    Vector3D up = withoutPart(cameraUp, normal);
    plane->normal = normal;
    plane->up = norm(up) > 0.25 ? normalize(up) : b;
    plane->right = cross(plane->up, normal);
    if (dot(plane->right, a) < 0)
        plane->right = multVector(plane->right, -1);
    /* Where the camera's up is not seen, look down, not up. */
    if (norm(up) <= 0.25 && dot(cross(plane->right, plane->up), cameraUp) < 0)
        plane->up = multVector(plane->up, -1);
    plane->origin = end;

    /* Hold the camera, the point, lights that are not too far, and what the ray meets. */
    DrawnPoint range[2] = {{0, 0}, {0, 0}};
    double size = fmax(norm(subVectors(end, ray->ray.origin)), 1e-9);
    includePoint(range, end, plane, ray->ray.origin);
    for (size_t i = 0; i < ray->lightCount && !ray->isUnlit; i++) {
        const ArrivingLight *arriving = &ray->lights[i].arriving;
        bool isMain = &ray->lights[i] == chosen;
        if (isfinite(arriving->distance) && arriving->distance < (isMain ? 4 : 1.5) * size)
            includePoint(range, end, plane, arriving->position);
    }
    Bounds bounds;
    if (hasPoint && objectBounds(ray->point.object, &bounds) &&
        norm(subVectors(bounds.max, bounds.min)) < 1.6 * size) {
        Vector3D middle = multVector(addVectors(bounds.min, bounds.max), 0.5);
        Vector3D half = multVector(subVectors(bounds.max, bounds.min), 0.5);
        double radius = fmax(half.x, fmax(half.y, half.z));
        const Vector3D ways[4] = {plane->right, multVector(plane->right, -1), plane->up,
                                  multVector(plane->up, -1)};
        for (int i = 0; i < 4; i++)
            includePoint(range, end, plane, addVectors(middle, multVector(ways[i], radius)));
    }
    const double margin = 74;
    double spanX = fmax(range[1].x - range[0].x, 1e-9), spanY = fmax(range[1].y - range[0].y, 1e-9);
    plane->scale = fmin((plane->width - 2 * margin) / spanX, (plane->height - 2 * margin) / spanY);
    plane->originX = plane->left + plane->width / 2 - (range[0].x + range[1].x) / 2 * plane->scale;
    plane->originY = plane->top + plane->height / 2 + (range[0].y + range[1].y) / 2 * plane->scale;
    return chosen;
}

const char *viewOfPlane(const DrawingPlane *plane, Vector3D up)
{
    double toViewer = dot(cross(plane->right, plane->up), normalize(up));
    static const char *const views[] = {"from below", "from the side and below", "from the side",
                                        "from the side and above", "from above"};
    int steepness = (fabs(toViewer) > 0.5) + (fabs(toViewer) > 0.9);
    return views[toViewer < 0 ? 2 - steepness : 2 + steepness];
}
