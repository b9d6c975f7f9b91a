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
    double u = x / width - 0.5;
    double v = (height - y) / height - 0.5;
    bool orthographic = frame->projection == PROJECTION_ORTHOGRAPHIC;
    Vector3D base = orthographic ? frame->position : frame->forward;
    Vector3D sum = addVectors(addVectors(base, multVector(frame->right, u)), multVector(frame->up, v));
    return orthographic ? createRay(sum, frame->forward) : createRay(frame->position, normalize(sum));
}
