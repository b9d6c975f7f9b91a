/* mesh.c - many triangles as one object; see mesh.h. */
#include "shapes/mesh.h"

#include "shapes/mesh_build.h"
#include "shapes/shape.h"

#include <limits.h>
#include <stdlib.h>

/* ---- Making and freeing ---- */

Status buildMesh(MeshData *mesh)
{
    if (mesh->triangleCount > INT_MAX || mesh->vertexCount >= UINT32_MAX || mesh->normalCount >= UINT32_MAX)
        return statusError(STATUS_SCENE,
                           "The mesh has more than %d triangles, vertices or normals; cut it "
                           "into several files.",
                           INT_MAX);
    Status status = weldVertices(mesh);
    if (statusIsOk(&status))
        status = findWhetherClosed(mesh);
    if (!statusIsOk(&status))
        return status;
    dropDegenerateTriangles(mesh);
    if (mesh->triangleCount == 0)
        return statusError(STATUS_SCENE, "No face has an area, so there is nothing to see; check the "
                                         "coordinates of the corners.");
    status = completeNormals(mesh);
    if (statusIsOk(&status))
        status = buildMeshTree(mesh);
    return status;
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

/* ---- Hits ---- */

/* The sink, and how far the ray's hits are of interest. */
typedef struct Reporting {
    HitSink *sink;
    double limit; /* in the mesh's own space */
} Reporting;

static double limitOf(const HitSink *sink)
{
    return sink->keepAll ? INFINITY : sink->nearest.distance / sink->scale;
}

static void report(void *context, size_t triangle, const TriangleHit *hit)
{
    Reporting *reporting = context;
    HitSink *sink = reporting->sink;
    /* Of two triangles met at the same distance the first of the mesh counts, in whatever order they come. */
    Hit *nearest = &sink->nearest;
    if (hit->distance * sink->scale == nearest->distance && nearest->object == sink->current &&
        (int)triangle < nearest->part) {
        nearest->part = (int)triangle;
        nearest->u = hit->share1;
        nearest->v = hit->share2;
    }
    reportHit(sink, hit->distance, (int)triangle, hit->share1, hit->share2);
    reporting->limit = limitOf(sink);
}

static void meshIntersect(const Object *object, const Ray *ray, HitSink *sink)
{
    Reporting reporting = {sink, limitOf(sink)};
    walkMesh(object->mesh.data, ray, &reporting.limit, report, &reporting);
}

static Vector3D meshFlatNormal(const Object *object, const Hit *hit)
{
    Vector3D corners[3];
    meshCorners(object->mesh.data, (size_t)hit->part, corners);
    return normalize(triangleCross(corners));
}

static Vector3D meshNormal(const Object *object, const Hit *hit, Vector3D position)
{
    (void)position;
    const MeshData *mesh = object->mesh.data;
    if (mesh->isSmooth) {
        /* The mean of the corners' normals by the hit's shares (Phong 1975). POV-Ray's smooth triangle has
         * the same in other words: n0 + a ((n1 - n0) + b (n2 - n1)) with a = u + v and b = v / a. */
        const uint32_t *indices = mesh->triangles[hit->part].normals;
        Vector3D n0 = mesh->normals[indices[0]], n1 = mesh->normals[indices[1]];
        Vector3D n2 = mesh->normals[indices[2]];
        Vector3D along =
            addVectors(multVector(subVectors(n1, n0), hit->u), multVector(subVectors(n2, n0), hit->v));
        Vector3D mean = addVectors(n0, along);
        if (norm(mean) > 1e-9)
            return normalize(mean);
    }
    return meshFlatNormal(object, hit);
}

/* ---- Inside ---- */

static bool meshHasInside(const Object *object)
{
    return object->mesh.data->isClosed;
}

/* How often a ray crosses the surface. */
typedef struct Crossings {
    double tolerance; /* a crossing nearer than it is the start itself */
    bool isOdd;
    bool startsOnSurface;
    bool isDoubtful; /* one of them is through an edge, where it is not sure how often it counts, or near the
                      * start */
} Crossings;

static void countCrossing(void *context, size_t triangle, const TriangleHit *hit)
{
    (void)triangle;
    Crossings *crossings = context;
    /* A ray that all but runs along a triangle may meet it only farther on. */
    if (fabs(hit->distance) <= crossings->tolerance)
        crossings->startsOnSurface = true;
    else if (fabs(hit->distance) <= 1024 * crossings->tolerance)
        crossings->isDoubtful = true;
    if (hit->distance > 0) {
        crossings->isOdd = !crossings->isOdd;
        crossings->isDoubtful |= hit->isOnEdge;
    }
}

/* How often the surface goes round the point, from the solid angle of each triangle (Jacobson, Kavan and
 * Sorkine-Hornung 2013, "Robust inside-outside segmentation using generalized winding numbers", eq. 5; the
 * angle by van Oosterom and Strackee 1983). Certain everywhere, but it looks at all triangles. */
static double windingNumber(const MeshData *mesh, Vector3D point)
{
    double halfAngles = 0;
    for (size_t i = 0; i < mesh->triangleCount; i++) {
        Vector3D p[3];
        meshCorners(mesh, i, p);
        Vector3D a = subVectors(p[0], point), b = subVectors(p[1], point), c = subVectors(p[2], point);
        double la = norm(a), lb = norm(b), lc = norm(c);
        halfAngles +=
            atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return halfAngles / (2 * 3.14159265358979323846);
}

/* Whether a ray from the point crosses the surface an odd number of times; that is POV-Ray's rule too. */
static bool meshContains(const Object *object, Vector3D point)
{
    /* Rays that are parallel to nothing a modeller draws; each is taken only where the last was doubtful. */
    static const Vector3D directions[] = {{0.5127, 0.7441, 0.4283},
                                          {-0.6329, 0.4587, 0.6238},
                                          {0.3371, -0.8123, 0.4759},
                                          {0.2713, 0.3917, -0.8791}};
    const MeshData *mesh = object->mesh.data;
    if (!mesh->isClosed)
        return false;
    const Bounds *bounds = &mesh->bounds;
    if (!(point.x > bounds->min.x && point.x < bounds->max.x && point.y > bounds->min.y &&
          point.y < bounds->max.y && point.z > bounds->min.z && point.z < bounds->max.z))
        return false;
    double size = fmax(largestCoordinate(bounds->min), largestCoordinate(bounds->max));
    for (size_t i = 0; i < sizeof directions / sizeof *directions; i++) {
        Ray ray = createRay(point, normalize(directions[i]));
        Crossings crossings = {.tolerance = 0x1p-46 * size};
        double limit = INFINITY;
        walkMesh(mesh, &ray, &limit, countCrossing, &crossings);
        if (crossings.startsOnSurface)
            return false;
        if (!crossings.isDoubtful)
            return crossings.isOdd;
    }
    return fabs(remainder(windingNumber(mesh, point), 2)) > 0.5;
}

/* ---- Size ---- */

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

/* A closed mesh may be a part of CSG, for all that is known here. */
static void meshWritePov(const Object *object, double scale, Text *pov)
{
    writeMeshPov(object, scale, object->mesh.data->isClosed, pov);
}

const Shape meshShape = {.name = "mesh",
                         .intersect = meshIntersect,
                         .normal = meshNormal,
                         .flatNormal = meshFlatNormal,
                         .contains = meshContains,
                         .hasInside = meshHasInside,
                         .bounds = meshBounds,
                         .magnitude = meshMagnitude,
                         .writePov = meshWritePov};
