/* lights.c - what arrives of a light at a point, if nothing is between; see raytracer.h. */
#include "power.h"
#include "raytracer.h"

int lightSampleCount(const Light *light)
{
    return light->kind == LIGHT_AREA ? light->countU * light->countV : 1;
}

/* Where number i of count points lies along a side: -1/2 .. 1/2, the outermost on the border. */
static double alongSide(int i, int count)
{
    return count > 1 ? (double)i / (count - 1) - 0.5 : 0;
}

Vector3D lightSamplePosition(const Light *light, int sample)
{
    if (light->kind != LIGHT_AREA)
        return light->position;
    double u = alongSide(sample / light->countV, light->countU);
    double v = alongSide(sample % light->countV, light->countV);
    return addVectors(addVectors(light->position, multVector(light->edgeU, u)), multVector(light->edgeV, v));
}

/* How much of a spot light goes in a direction at this cosine from its axis: with
 *     s = clamp((cos t - cos outer) / (cos inner - cos outer), 0, 1)
 * it is s^2 (3 - 2s) cos(t)^tightness. */
static double spotShare(const Light *light, double cosine)
{
    const double pi = 3.14159265358979323846;
    if (!(cosine > 0))
        return 0;
    double inner = cos(light->innerAngle * pi / 180), outer = cos(light->outerAngle * pi / 180);
    double share = power(cosine, light->tightness);
    if (cosine < inner) {
        double s = cosine < outer ? 0 : (cosine - outer) / (inner - outer);
        share *= (3 - 2 * s) * s * s;
    }
    return share;
}

ArrivingLight lightArriving(const Light *light, int sample, Vector3D point)
{
    if (light->kind == LIGHT_DIRECTIONAL)
        return (ArrivingLight){
            .direction = multVector(light->direction, -1), .distance = INFINITY, .color = light->color};

    ArrivingLight arriving = {.position = lightSamplePosition(light, sample), .color = light->color};
    Vector3D il = subVectors(arriving.position, point);
    arriving.direction = normalize(il);
    arriving.distance = norm(il);
    if (light->kind == LIGHT_AREA)
        arriving.color = scaleColor(light->color, 1.0 / lightSampleCount(light));

    /* Work out falloff and cone in double and round the colour once. */
    double factor = 1;
    if (light->kind == LIGHT_SPOT)
        factor = spotShare(light, -dot(arriving.direction, light->direction));
    if (light->falloff == FALLOFF_INVERSE_SQUARE)
        factor *= 1 / (arriving.distance * arriving.distance);
    if (factor != 1)
        arriving.color = scaleColor(arriving.color, factor);
    return arriving;
}
