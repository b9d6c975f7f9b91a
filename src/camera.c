/* camera.c - from a pixel to a ray; see raytracer.h. */
#include "raytracer.h"

CameraFrame cameraFrame(const Camera *camera, int width, int height)
{
    const double pi = 3.14159265358979323846;
    Vector3D forward = normalize(camera->direction);
    Vector3D right = normalize(cross(forward, normalize(camera->up)));
    Vector3D up = cross(right, forward);
    bool orthographic = camera->projection == PROJECTION_ORTHOGRAPHIC;
    double pictureHeight = orthographic ? camera->viewHeight : 2 * tan(camera->fov * pi / 360);
    double pictureWidth = pictureHeight * width / height;
    return (CameraFrame){camera->projection, camera->position, forward, multVector(right, pictureWidth),
                         multVector(up, pictureHeight)};
}

Ray cameraRay(const CameraFrame *frame, double x, double y, int width, int height)
{
    bool orthographic = frame->projection == PROJECTION_ORTHOGRAPHIC;
    Vector3D sum = pictureVector(frame, orthographic ? frame->position : frame->forward, x, y, width, height);
    return orthographic ? createRay(sum, frame->forward) : createRay(frame->position, normalize(sum));
}
