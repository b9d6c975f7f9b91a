/* meet_surfaces.c - from the camera to the first surface, for the 64 rays of a tile; see tile_lanes.h. */
#include "engine/lanes/tile_lanes.h"
#include "engine/referee.h"
#include "shapes/mesh_build.h"

/* ---- The rays ---- */

void PATH(aimRays)(TileLanes *tile, int left, int top, double x, double y)
{
    const CameraFrame *frame = &tile->job->rays.frame;
    int width = tile->job->framebuffer->width, height = tile->job->framebuffer->height;
    VectorLanes *origins = &tile->origins, *directions = &tile->directions;
    if (frame->projection == PROJECTION_ORTHOGRAPHIC) {
        EACH_LANE(k) {
            Vector3D start =
                pictureVector(frame, frame->position, left + laneX(k) + x, top + laneY(k) + y, width, height);
            setLaneVector(origins, k, start);
            setLaneVector(directions, k, frame->forward);
        }
        return;
    }
    Vector3D forward = frame->forward;
    int unusual = 0;
    EACH_LANE(k) {
        Vector3D sum = pictureVector(frame, forward, left + laneX(k) + x, top + laneY(k) + y, width, height);
        double squared = dot(sum, sum);
        unusual |= !isUsualSquare(squared);
        setLaneVector(directions, k, normalizeUsual(sum, squared));
        setLaneVector(origins, k, frame->position);
    }
    if (unusual)
        EACH_LANE(k)
            setLaneVector(directions, k,
                          normalize(pictureVector(frame, forward, left + laneX(k) + x, top + laneY(k) + y,
                                                  width, height)));
}

/* Make the bundle of the camera's rays: their frame, and where each goes in it. */
static void bundleRays(TileLanes *tile)
{
    const CameraFrame *frame = &tile->job->rays.frame;
    const CompiledScene *compiled = tile->job->compiled;
    Bundle *bundle = &tile->bundle;
    Vector3D x = normalize(frame->right), y = normalize(frame->up), z = frame->forward;
    setBundleFrame(bundle, compiled, frame->position, x, y, z);
    bundle->isParallel = frame->projection == PROJECTION_ORTHOGRAPHIC;
    bundle->startDepth = 0;
    bundle->origins = &tile->origins;
    bundle->directions = &tile->directions;
    _Alignas(64) float u[LANES], v[LANES];
    const VectorLanes *directions = &tile->directions, *origins = &tile->origins;
    if (bundle->isParallel) {
        float farthest = 0;
        EACH_LANE(k) {
            Vector3D from = subVectors(laneVector(origins, k), frame->position);
            u[k] = (float)(dot(from, x) * compiled->scale);
            v[k] = (float)(dot(from, y) * compiled->scale);
            float size = fabsf(u[k]) > fabsf(v[k]) ? fabsf(u[k]) : fabsf(v[k]);
            farthest = size > farthest ? size : farthest;
        }
        /* A ray that is farther out meets nothing in the tree. */
        bundle->largest += farthest < 4 ? farthest : 4;
    } else {
        EACH_LANE(k) {
            Vector3D d = laneVector(directions, k);
            double along = dot(d, z);
            u[k] = (float)(dot(d, x) / along);
            v[k] = (float)(dot(d, y) / along);
        }
    }
    for (int p = 0; p < PACKETS; p++) {
        bundle->u[p] = f8Load(&u[8 * p]);
        bundle->v[p] = f8Load(&v[8 * p]);
        bundle->slope[p] = bundle->isParallel
                               ? f8Set(1)
                               : bundle->u[p] * bundle->u[p] + (bundle->v[p] * bundle->v[p] + f8Set(1));
        bundle->inverseSlope[p] = f8Set(1) / bundle->slope[p];
        bundle->active[p] = (uint8_t)(tile->inPicture >> 8 * p);
    }
}

/* ---- What has no box ---- */

/* Start with the nearest of the planes and other endless objects. */
static void meetEndlessObjects(TileLanes *tile)
{
    const CompiledScene *compiled = tile->job->compiled;
    Bundle *bundle = &tile->bundle;
    const VectorLanes *origins = &tile->origins, *directions = &tile->directions;
    double *nearest = bundle->exact;
    int32_t *primitives = (int32_t *)bundle->primitives;
    EACH_LANE(k) {
        nearest[k] = INFINITY;
        primitives[k] = NO_PRIMITIVE;
    }
    for (size_t i = 0; i < compiled->planeCount; i++) {
        Vector3D normal = compiled->planes[i].normal;
        double height = compiled->planes[i].height;
        int32_t code = endlessCode(i);
        EACH_LANE(k) {
            double slope = dot(normal, laneVector(directions, k));
            double distance = (height - dot(normal, laneVector(origins, k))) / slope;
            /* Without slope the distance is infinite or no number. */
            int closer = distance > 0 && distance < nearest[k];
            nearest[k] = closer ? distance : nearest[k];
            primitives[k] = closer ? code : primitives[k];
        }
    }
    for (size_t i = 0; i < compiled->endlessCount; i++) {
        uint32_t number = compiled->endless[i];
        EACH_SET(k, tile->inPicture) {
            Ray ray = createRay(laneVector(origins, k), laneVector(directions, k));
            HitSink sink = createHitSink(0, false);
            intersectObject(&compiled->scene->objects[number], &ray, &sink);
            double distance = sink.nearest.distance;
            bool tie = distance == nearest[k] && distance < INFINITY &&
                       endlessNumber(primitives[k]) < compiled->planeCount &&
                       number < compiled->planes[endlessNumber(primitives[k])].object;
            if (distance < nearest[k] || tie) {
                nearest[k] = distance;
                primitives[k] = endlessCode(compiled->planeCount + i);
                bundle->hits[k] = sink.nearest;
            }
        }
    }
    double scale = compiled->scale;
    const float *slopes = (const float *)bundle->slope;
    float *low = (float *)bundle->nearest, *high = (float *)bundle->farthest;
    EACH_LANE(k) {
        double depth = nearest[k] * scale / sqrt((double)slopes[k]);
        /* Nothing in the tree is farther away than this, and floats go no farther. */
        depth = depth < 1e30 ? depth : 1e30;
        low[k] = (float)(depth * (1 - 1e-6));
        high[k] = (float)(depth * (1 + 1e-6));
        bundle->exactPrimitives[k] = primitives[k];
    }
}

/* ---- Exactly where ---- */

/* Store what the reference tracer has of the hit; the general way, one ray at a time. */
static void storePoint(TileLanes *tile, int k, const Object *object, const Hit *hit)
{
    Ray ray = createRay(laneVector(&tile->origins, k), laneVector(&tile->directions, k));
    SurfacePoint point = surfacePointAt(&ray, object, hit);
    tile->distances.v[k] = hit->distance;
    tile->offsets.v[k] = point.offset;
    setLaneVector(&tile->positions, k, point.position);
    setLaneVector(&tile->normals, k, point.normal);
    setLaneVector(&tile->ownNormals, k, point.flatNormal);
    tile->surfaces[k] = hit->object;
    if (hit->object != object)
        tile->materials[k] = PART_MATERIAL;
}

/* Most tiles see one kind of thing: their loops need not choose between lanes. */
#define ALWAYS_INLINE __attribute__((always_inline))
#define WHOLE_OR_PART(function, tile, lanes)                                                                 \
    ((lanes) == ~0ull ? function(tile, ~0ull, true) : function(tile, lanes, false))

/* The lanes of each way to work out a hit. */
typedef struct HitWays {
    uint64_t spheres, planes, triangles, others;
} HitWays;

static HitWays sortHitLanes(TileLanes *tile)
{
    const CompiledScene *compiled = tile->job->compiled;
    const int32_t *primitives = (const int32_t *)tile->bundle.primitives;
    HitWays ways = {0};
    tile->met = 0;
    EACH_LANE(k) {
        int32_t primitive = primitives[k];
        uint64_t bit = (tile->inPicture >> k & 1) << k;
        tile->ownPrimitives[k] = NO_PRIMITIVE;
        tile->objects[k] = 0;
        tile->surfaces[k] = NULL;
        if (primitive == NO_PRIMITIVE || bit == 0)
            continue;
        tile->met |= bit;
        if (primitive < 0) {
            size_t number = endlessNumber(primitive);
            bool isPlane = number < compiled->planeCount;
            *(isPlane ? &ways.planes : &ways.others) |= bit;
            tile->objects[k] =
                isPlane ? compiled->planes[number].object : compiled->endless[number - compiled->planeCount];
        } else {
            tile->objects[k] = primitiveObject(compiled, primitive);
            PrimitiveKind kind = primitiveKind(compiled, primitive);
            const Object *object = &compiled->scene->objects[tile->objects[k]];
            bool isFlat =
                kind == PRIMITIVE_TRIANGLE && object->transform == NULL && !object->mesh.data->isSmooth;
            *(kind == PRIMITIVE_SPHERE ? &ways.spheres : isFlat ? &ways.triangles : &ways.others) |= bit;
        }
        tile->surfaces[k] = &compiled->scene->objects[tile->objects[k]];
        tile->materials[k] = (int32_t)compiled->objectMaterial[tile->objects[k]];
    }
    return ways;
}

/* Set a lane's vector where it is mine; else it stays. Without a branch. */
static inline ALWAYS_INLINE void keepVector(VectorLanes *lanes, int k, bool mine, Vector3D v)
{
    lanes->x[k] = mine ? v.x : lanes->x[k];
    lanes->y[k] = mine ? v.y : lanes->y[k];
    lanes->z[k] = mine ? v.z : lanes->z[k];
}

/* Likewise all that is known of the point. */
static inline ALWAYS_INLINE void keepPoint(TileLanes *tile, int k, bool mine, double distance, double offset,
                                           Vector3D position, Vector3D normal)
{
    tile->distances.v[k] = mine ? distance : tile->distances.v[k];
    tile->offsets.v[k] = mine ? offset : tile->offsets.v[k];
    keepVector(&tile->positions, k, mine, position);
    keepVector(&tile->normals, k, mine, normal);
}

static inline ALWAYS_INLINE void meetSphereLanes(TileLanes *tile, uint64_t lanes, bool whole)
{
    /* Gather the spheres; other lanes get one that does no harm. */
    const CompiledScene *compiled = tile->job->compiled;
    const int32_t *primitives = (const int32_t *)tile->bundle.primitives;
    VectorLanes centers;
    NumberLanes radii;
    MaskLanes mask;
    maskOfSet(lanes, &mask);
    EACH_LANE(k) {
        ExactSphere sphere = {{0, 0, 0}, 1};
        if (mask.v[k] != 0)
            sphere = compiled->spheres[primitives[k]];
        setLaneVector(&centers, k, sphere.center);
        radii.v[k] = sphere.radius;
    }

    MaskLanes isOutside;
    EACH_LANE(k) {
        Ray ray = createRay(laneVector(&tile->origins, k), laneVector(&tile->directions, k));
        Vector3D center = laneVector(&centers, k);
        double radius = radii.v[k], first, second;
        sphereDistances(center, radius, &ray, &first, &second);
        /* Of the two distances the smaller that is above 0. */
        double distance = first > 0 && !(second > 0 && second < first) ? first : second;
        Vector3D position = pointOnRay(&ray, distance);
        Vector3D outward = multVector(subVectors(position, center), 1 / radius);
        Vector3D normal = turnedToRay(outward, &ray);
        double own = largestCoordinate(center) + radius;
        double offset = (largestCoordinate(ray.origin) + distance + own) * ROUNDING_MARGIN;

        bool mine = whole || mask.v[k] != 0;
        keepPoint(tile, k, mine, distance, offset, position, normal);

        /* From outside, a sphere does not hide the light from its own lit points: they are lifted off it by
         * more than any rounding (unless it is a speck beside its coordinates), and it is convex. */
        bool sees = dot(outward, ray.direction) < 0 && own < 0x1p20 * radius;
        isOutside.v[k] = mine && sees ? -1 : 0;
    }
    EACH_LANE(k)
        tile->ownPrimitives[k] = isOutside.v[k] != 0 ? primitives[k] : tile->ownPrimitives[k];
}

static inline ALWAYS_INLINE void meetPlaneLanes(TileLanes *tile, uint64_t lanes, bool whole)
{
    const CompiledScene *compiled = tile->job->compiled;
    const int32_t *primitives = (const int32_t *)tile->bundle.primitives;
    VectorLanes planeNormals;
    NumberLanes magnitudes;
    MaskLanes mask;
    maskOfSet(lanes, &mask);
    EACH_LANE(k) {
        Vector3D normal = createVector(0, 0, 1);
        double magnitude = 0;
        if (mask.v[k] != 0) {
            const ExactPlane *plane = &compiled->planes[endlessNumber(primitives[k])];
            normal = plane->normal;
            magnitude = plane->magnitude;
        }
        setLaneVector(&planeNormals, k, normal);
        magnitudes.v[k] = magnitude;
    }
    EACH_LANE(k) {
        Ray ray = createRay(laneVector(&tile->origins, k), laneVector(&tile->directions, k));
        double distance = tile->bundle.exact[k];
        Vector3D position = pointOnRay(&ray, distance);
        Vector3D normal = turnedToRay(laneVector(&planeNormals, k), &ray);
        double offset = (largestCoordinate(ray.origin) + distance + magnitudes.v[k]) * ROUNDING_MARGIN;

        bool mine = whole || mask.v[k] != 0;
        keepPoint(tile, k, mine, distance, offset, position, normal);
    }
}

/* Flat triangles without transform, as intersectTriangle meets them. */
static inline ALWAYS_INLINE void meetTriangleLanes(TileLanes *tile, uint64_t lanes, bool whole, HitWays *ways)
{
    const CompiledScene *compiled = tile->job->compiled;
    const int32_t *primitives = (const int32_t *)tile->bundle.primitives;
    VectorLanes corners[3];
    NumberLanes magnitudes;
    MaskLanes mask, unusual;
    maskOfSet(lanes, &mask);
    EACH_LANE(k) {
        Vector3D p[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        double magnitude = 0;
        if (mask.v[k] != 0) {
            MeshPart part = compiled->triangles[(size_t)primitives[k] - compiled->sphereCount];
            const MeshData *mesh = compiled->scene->objects[part.object].mesh.data;
            meshCorners(mesh, part.triangle, p);
            double low = largestCoordinate(mesh->bounds.min), high = largestCoordinate(mesh->bounds.max);
            magnitude = low > high ? low : high;
        }
        for (int c = 0; c < 3; c++)
            setLaneVector(&corners[c], k, p[c]);
        magnitudes.v[k] = magnitude;
    }
    EACH_LANE(k) {
        Ray ray = createRay(laneVector(&tile->origins, k), laneVector(&tile->directions, k));
        Vector3D a = laneVector(&corners[0], k), b = laneVector(&corners[1], k),
                 c = laneVector(&corners[2], k);
        Vector3D across = cross(subVectors(b, a), subVectors(c, a));
        double squared = dot(across, across);
        Vector3D flat = normalizeUsual(across, squared);
        double slope = dot(flat, ray.direction);
        double distance = dot(flat, subVectors(a, ray.origin)) / slope;
        Vector3D position = pointOnRay(&ray, distance);
        Vector3D normal = turnedToRay(flat, &ray);
        double offset = (largestCoordinate(ray.origin) + distance + magnitudes.v[k]) * ROUNDING_MARGIN;
        unusual.v[k] = isUsualSquare(squared) && fabs(slope) > RAY_TRIANGLE_PARALLEL ? 0 : -1;

        bool mine = whole || mask.v[k] != 0;
        keepPoint(tile, k, mine, distance, offset, position, normal);
        keepVector(&tile->ownNormals, k, mine, flat);
    }
    ways->others |= lanes & setOfMask(&unusual);
    EACH_LANE(k)
        tile->ownPrimitives[k] = mask.v[k] != 0 ? primitives[k] : tile->ownPrimitives[k];
}

static void meetOtherLanes(TileLanes *tile, uint64_t lanes)
{
    const CompiledScene *compiled = tile->job->compiled;
    Bundle *bundle = &tile->bundle;
    const int32_t *primitives = (const int32_t *)bundle->primitives;
    EACH_SET(k, lanes) {
        int32_t primitive = primitives[k];
        if (primitive >= 0) {
            /* The referee may have seen it before. */
            if (bundle->exactPrimitives[k] != primitive) {
                Ray ray = createRay(laneVector(&tile->origins, k), laneVector(&tile->directions, k));
                meetPrimitive(compiled, primitive, &ray, &bundle->hits[k]);
            }
            if (primitiveKind(compiled, primitive) == PRIMITIVE_TRIANGLE)
                tile->ownPrimitives[k] = primitive;
        }
        storePoint(tile, k, &compiled->scene->objects[tile->objects[k]], &bundle->hits[k]);
    }
}

void PATH(meetSurfaces)(TileLanes *tile)
{
    bundleRays(tile);
    meetEndlessObjects(tile);
    PATH(meetBundle)(&tile->bundle);
    HitWays ways = sortHitLanes(tile);
    if (ways.spheres != 0)
        WHOLE_OR_PART(meetSphereLanes, tile, ways.spheres);
    if (ways.planes != 0)
        WHOLE_OR_PART(meetPlaneLanes, tile, ways.planes);
    /* So far the surfaces' own normals are the same. */
    tile->flatNormals = &tile->normals;
    if ((ways.triangles | ways.others) != 0) {
        tile->ownNormals = tile->normals;
        tile->flatNormals = &tile->ownNormals;
    }
    if (ways.triangles != 0)
        ways.triangles == ~0ull ? meetTriangleLanes(tile, ~0ull, true, &ways)
                                : meetTriangleLanes(tile, ways.triangles, false, &ways);
    if (ways.others != 0)
        meetOtherLanes(tile, ways.others);
}
