/* mesh.c - many triangles as one object; see mesh.h. */
#include "shapes/mesh.h"

#include "shapes/shape.h"

#include <stdlib.h>

static void meshIntersect(const Object *object, const Ray *ray, HitSink *sink)
{
    const MeshData *data = object->mesh.data;
    for (size_t i = 0; i < data->triangleCount; i++) {
        const uint32_t *corners = data->triangles[i].vertices;
        Vector3D a = data->vertices[corners[0]];
        Vector3D e1 = subVectors(data->vertices[corners[1]], a);
        Vector3D e2 = subVectors(data->vertices[corners[2]], a);
        Vector3D p = cross(ray->direction, e2);
        double determinant = dot(e1, p);
        Vector3D s = subVectors(ray->origin, a);
        Vector3D q = cross(s, e1);
        double u = dot(s, p) / determinant, v = dot(ray->direction, q) / determinant;
        if (u >= 0 && v >= 0 && u + v <= 1)
            reportHit(sink, dot(e2, q) / determinant, (int)i, u, v);
    }
}

static Vector3D meshNormal(const Object *object, const Hit *hit, Vector3D position)
{
    (void)position;
    const MeshData *data = object->mesh.data;
    const MeshTriangle *triangle = &data->triangles[hit->part];
    Vector3D a = data->vertices[triangle->vertices[0]];
    return normalize(cross(subVectors(data->vertices[triangle->vertices[1]], a),
                           subVectors(data->vertices[triangle->vertices[2]], a)));
}

static bool meshHasInside(const Object *object)
{
    return object->mesh.data->isClosed;
}

static bool meshBounds(const Object *object, Bounds *bounds)
{
    *bounds = object->mesh.data->bounds;
    return true;
}

static double meshMagnitude(const Object *object)
{
    const Bounds *bounds = &object->mesh.data->bounds;
    return fmax(largestCoordinate(bounds->min), largestCoordinate(bounds->max));
}

static void meshWritePov(const Object *object, double scale, Text *pov)
{
    (void)object;
    (void)scale;
    textAppend(pov, "mesh {");
}

const Shape meshShape = {.name = "mesh",
                         .intersect = meshIntersect,
                         .normal = meshNormal,
                         .contains = containsNothing,
                         .hasInside = meshHasInside,
                         .bounds = meshBounds,
                         .magnitude = meshMagnitude,
                         .writePov = meshWritePov};

Status buildMesh(MeshData *mesh)
{
    mesh->bounds = (Bounds){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < mesh->vertexCount; i++) {
        Vector3D p = mesh->vertices[i], low = mesh->bounds.min, high = mesh->bounds.max;
        mesh->bounds.min = createVector(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
        mesh->bounds.max = createVector(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
    }
    return statusOk();
}

void freeMesh(MeshData *mesh)
{
    if (mesh == NULL)
        return;
    free(mesh->vertices);
    free(mesh->normals);
    free(mesh->triangles);
    free(mesh->nodes);
    free(mesh);
}

Status readObjMesh(const char *path, bool smooth, MeshData **mesh)
{
    (void)smooth;
    (void)mesh;
    return statusError(STATUS_SCENE, "%s: OBJ files are not read yet.", path);
}
