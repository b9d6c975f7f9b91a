/* shading.c - what a surface does with light; see shading.h.
 *
 * Each term is computed in double up to the point where it meets a colour and rounded to float there,
 * in the order in which POV-Ray does it, so that the two pictures can agree in every bit.
 */
#include "shading.h"
Material createMaterial(Color3f diffuse, Color3f specular, float shininess)
{
    return (Material){.diffuse = diffuse, .specular = specular, .shininess = shininess, .ior = 1};
}

Material defaultMaterial(void)
{
    return createMaterial(createColor(0.8f, 0.8f, 0.8f), createColor(0, 0, 0), 32);
}

Color3f diffuseReflection(const Material *material, Color3f light, Vector3D n, Vector3D l)
{
    double cosine = dot(n, l);
    return multColors(scaleColor(material->diffuse, cosine > 0 ? cosine : 0), light);
}

Color3f specularHighlight(const Material *material, Color3f light, Vector3D n, Vector3D l, Vector3D v)
{
    /* specFactor = max(0, dot(R, V))^shininess */
    Vector3D r = reflect(multVector(l, -1), n);
    double cosine = dot(r, v);
    if (!(cosine > 0))
        return createColor(0, 0, 0);
    return scaleColor(light, highlightPower(cosine, (double)material->shininess));
}

Color3f blinnHighlight(const Material *material, Color3f light, Vector3D n, Vector3D l, Vector3D v)
{
    double cosine = blinnCosine(n, l, v);
    if (!(cosine > 0))
        return createColor(0, 0, 0);
    return scaleColor(light, highlightPower(cosine, (double)material->shininess));
}
