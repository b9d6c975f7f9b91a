/* shade_surfaces.c - what the 64 rays of a tile see: `shade` of the course's tracer, in lanes; see
 * tile_lanes.h.
 *
 * The order of operations, and where a number is rounded to float, is that of raytracer.c and shading.c, term
 * by term; lanes to which a term does not apply add 0. The rare goes the general way, one ray at a time: the
 * simple model, spot lights, transparent things in the light's way, mirrored and refracted rays.
 */
#include "engine/lanes/tile_lanes.h"
#include "engine/referee.h"
#include "engine/single_rays.h"
#include "power.h"

/* ---- Materials ---- */

/* Write a material's numbers into these lanes; whole: into all. */
static inline __attribute__((always_inline)) void writeMaterial(TileLanes *tile, uint64_t lanes, bool whole,
                                                                const Material *material, Color3f own)
{
    MaskLanes mask;
    maskOfSet(lanes, &mask);
    Color3f diffuse = material->diffuse, specular = material->specular;
    double shininess = (double)material->shininess;
    EACH_LANE(k) {
        bool mine = whole || mask.v[k] != 0;
        tile->colors.r[k] = mine ? own.r : tile->colors.r[k];
        tile->colors.g[k] = mine ? own.g : tile->colors.g[k];
        tile->colors.b[k] = mine ? own.b : tile->colors.b[k];
        tile->diffuse.r[k] = mine ? diffuse.r : tile->diffuse.r[k];
        tile->diffuse.g[k] = mine ? diffuse.g : tile->diffuse.g[k];
        tile->diffuse.b[k] = mine ? diffuse.b : tile->diffuse.b[k];
        tile->specular.r[k] = mine ? specular.r : tile->specular.r[k];
        tile->specular.g[k] = mine ? specular.g : tile->specular.g[k];
        tile->specular.b[k] = mine ? specular.b : tile->specular.b[k];
        tile->shininess.v[k] = mine ? shininess : tile->shininess.v[k];
    }
}

/* Give these lanes a material; their colors begin with what it sends out by itself. */
static void setMaterial(TileLanes *tile, uint64_t lanes, const Material *material)
{
    const Scene *scene = tile->job->compiled->scene;
    Color3f own = addColors(multColors(material->ambient, scene->render.ambient), material->emission);
    if (lanes == ~0ull)
        writeMaterial(tile, lanes, true, material, own);
    else
        writeMaterial(tile, lanes, false, material, own);
    if (material->pattern != NULL)
        EACH_SET(k, lanes) {
            Vector3D point = objectSpacePoint(tile->surfaces[k], laneVector(&tile->positions, k));
            setLaneColor(&tile->diffuse, k, patternColor(material->pattern, point));
        }
    ShadingModel model = materialModel(scene, material);
    bool shines = !colorIsBlack(material->specular);
    if (model == MODEL_SIMPLE)
        tile->simple |= lanes;
    else if (!(colorIsBlack(material->reflection) && colorIsBlack(material->transmission)))
        tile->secondary |= lanes;
    if (model == MODEL_PHONG && shines)
        tile->phong |= lanes;
    if (model == MODEL_BLINN_PHONG && shines)
        tile->blinn |= lanes;
}

/* Bring the materials into lanes, one material at a time: few tiles have many. */
static void gatherMaterials(TileLanes *tile)
{
    const CompiledScene *compiled = tile->job->compiled;
    tile->simple = tile->phong = tile->blinn = tile->secondary = 0;
    for (uint64_t left = tile->met; left != 0;) {
        int first = __builtin_ctzll(left);
        int32_t number = tile->materials[first];
        if (number == PART_MATERIAL) {
            setMaterial(tile, 1ull << first, &tile->surfaces[first]->material);
            left &= left - 1;
            continue;
        }
        MaskLanes same;
        EACH_LANE(k)
            same.v[k] = tile->materials[k] == number ? -1 : 0;
        uint64_t lanes = setOfMask(&same) & left;
        setMaterial(tile, lanes, &compiled->materials[number]);
        left &= ~lanes;
    }
}

/* ---- One light ---- */

/* What arrives of one point light, as in ArrivingLight, and the rays to it. */
typedef struct LightLanes {
    VectorLanes directions; /* to the light, of unit length */
    ColorLanes colors;
    NumberLanes cosines; /* dot(N, L) */
    VectorLanes starts;  /* of the shadow rays, off the surface */
    MaskLanes lit;       /* before shadows: the light is in front of the surface and not black there */
    MaskLanes leaves;    /* the ray to the light surely leaves the surface it starts on */
} LightLanes;

/* As lightArriving, for one point light of a point or area light. */
static void arriveFromPoint(const TileLanes *tile, const Light *light, int sample, LightLanes *arriving)
{
    Vector3D position = lightSamplePosition(light, sample);
    Color3f color = light->color;
    if (light->kind == LIGHT_AREA)
        color = scaleColor(color, 1.0 / lightSampleCount(light));
    bool fades = light->falloff == FALLOFF_INVERSE_SQUARE;
    int unusual = 0;
    EACH_LANE(k) {
        Vector3D il = subVectors(position, laneVector(&tile->positions, k));
        double squared = dot(il, il), distance = sqrt(squared);
        unusual |= !isUsualSquare(squared);
        setLaneVector(&arriving->directions, k, normalizeUsual(il, squared));
        if (fades)
            setLaneColor(&arriving->colors, k, scaleColor(color, 1 / (distance * distance)));
        else
            setLaneColor(&arriving->colors, k, color);
    }
    if (unusual)
        EACH_SET(k, tile->met) {
            ArrivingLight exact = lightArriving(light, sample, laneVector(&tile->positions, k));
            setLaneVector(&arriving->directions, k, exact.direction);
            setLaneColor(&arriving->colors, k, exact.color);
        }
}

static void arrive(const TileLanes *tile, const Light *light, int sample, LightLanes *arriving)
{
    if (light->kind == LIGHT_POINT || light->kind == LIGHT_AREA) {
        arriveFromPoint(tile, light, sample, arriving);
    } else {
        ArrivingLight exact = {.direction = {0, 0, 0}};
        EACH_LANE(k) {
            if (light->kind != LIGHT_DIRECTIONAL || k == 0)
                exact = lightArriving(light, sample, laneVector(&tile->positions, k));
            setLaneVector(&arriving->directions, k, exact.direction);
            setLaneColor(&arriving->colors, k, exact.color);
        }
    }
    EACH_LANE(k) {
        Vector3D l = laneVector(&arriving->directions, k), flat = laneVector(tile->flatNormals, k);
        Color3f c = laneColor(&arriving->colors, k);
        double cosine = dot(laneVector(&tile->normals, k), l);
        arriving->cosines.v[k] = cosine;
        int inFront = cosine > 0;
        int black = (c.r == 0) & (c.g == 0) & (c.b == 0);
        arriving->lit.v[k] = (inFront & !black) != 0 ? -1 : 0;

        /* As offsetStart. */
        double along = dot(flat, l);
        double step = copysign(tile->offsets.v[k], along);
        setLaneVector(&arriving->starts, k,
                      addVectors(laneVector(&tile->positions, k), multVector(flat, step)));
        arriving->leaves.v[k] = fabs(along) > 0x1p-30 ? -1 : 0;
    }
}

/* ---- Its shadows ---- */

/* The light as the shadow rays see it. */
static ArrivingLight lightItself(const Light *light, int sample)
{
    if (light->kind == LIGHT_DIRECTIONAL)
        return (ArrivingLight){.direction = multVector(light->direction, -1), .distance = INFINITY};
    return (ArrivingLight){.position = lightSamplePosition(light, sample), .distance = 1};
}

/* The shadow ray of one lane. */
static ShadowRay laneShadow(const LightLanes *arriving, const ArrivingLight *light, int k)
{
    return shadowRayFrom(laneVector(&arriving->starts, k), light);
}

/* Take away the rays that a plane or another object without a box blocks. A plane with both ends of a ray on
 * the same side does not; unless that is sure, ask the referee. */
static uint64_t endlessShadows(const TileLanes *tile, const LightLanes *arriving, const ArrivingLight *light,
                               uint64_t lit)
{
    const CompiledScene *compiled = tile->job->compiled;
    bool isDirectional = !isfinite(light->distance);
    uint64_t doubtful = compiled->endlessCount > 0 ? lit : 0;
    for (size_t i = 0; i < compiled->planeCount; i++) {
        if (!compiled->planes[i].castsShadow)
            continue;
        Vector3D normal = compiled->planes[i].normal;
        double height = compiled->planes[i].height, size = fabs(height) + compiled->planes[i].magnitude;
        double end = isDirectional ? dot(normal, light->direction) : dot(normal, light->position) - height;
        double endSize = isDirectional ? 1 : largestCoordinate(light->position) + size;
        MaskLanes unsure;
        /* With the end's sign turned to above, both are above. */
        double sign = end < 0 ? -1 : 1, ends = end * sign;
        EACH_LANE(k) {
            Vector3D start = laneVector(&arriving->starts, k);
            double side = (dot(normal, start) - height) * sign;
            double startSize = largestCoordinate(start) + size;
            double endMargin = 0x1p-30 * (isDirectional ? endSize : endSize + startSize);
            int clear = (side > 0x1p-46 * startSize) & (ends > endMargin);
            unsure.v[k] = clear != 0 ? 0 : -1;
        }
        doubtful |= setOfMask(&unsure) & lit;
    }
    EACH_SET(k, doubtful) {
        ShadowRay shadow = laneShadow(arriving, light, k);
        if (endlessBlocks(compiled, &shadow))
            lit &= ~(1ull << k);
    }
    return lit;
}

/* A frame whose z axis is this unit vector (Duff et al. 2017, "Building an orthonormal basis, revisited",
 * JCGT 6(1)). */
static void frameRound(Vector3D z, Vector3D *x, Vector3D *y)
{
    double sign = copysign(1, z.z), a = -1 / (sign + z.z), b = z.x * z.y * a;
    *x = createVector(1 + sign * z.x * z.x * a, sign * b, -sign * z.x);
    *y = createVector(b, sign + z.y * z.y * a, -z.y);
}

/* A point is taken from the light together with the others when it is within this cosine of their middle; its
 * depth is then no small difference. */
static const double LEAST_COSINE = 0.1;
/* From a light farther away than this, in the size of the scene, floats would tell little. */
static const float FARTHEST_LIGHT = 1024;

typedef double D4 __attribute__((vector_size(32)));

/* The sum of these lanes. What is in the others may be no number, so they are left out rather than multiplied
 * by 0. */
static double sumOfLanes(const double *values, const MaskLanes *mask)
{
    NumberLanes counted;
    EACH_LANE(k)
        counted.v[k] = mask->v[k] != 0 ? values[k] : 0;
    const D4 *fours = (const D4 *)counted.v;
    D4 sum[2] = {{0, 0, 0, 0}, {0, 0, 0, 0}};
    for (int i = 0; i < LANES / 4; i += 2) {
        sum[0] += fours[i];
        sum[1] += fours[i + 1];
    }
    D4 both = sum[0] + sum[1];
    return both[0] + both[1] + (both[2] + both[3]);
}

static Vector3D sumOfVectors(const VectorLanes *vectors, const MaskLanes *mask)
{
    return createVector(sumOfLanes(vectors->x, mask), sumOfLanes(vectors->y, mask),
                        sumOfLanes(vectors->z, mask));
}

/* The rays to a light, in the frame that they are bundled in. */
typedef struct ShadowFrame {
    Vector3D origin, x, y, z;
    double scale;
} ShadowFrame;

/* Where the rays go, and how far; those that must go alone are bad. */
typedef struct FloatLanes {
    _Alignas(64) float u[LANES], v[LANES], low[LANES], high[LANES], size[LANES];
    MaskLanes bad;
} FloatLanes;

static void placeCentral(const ShadowFrame *frame, const LightLanes *arriving, FloatLanes *floats)
{
    double originSize = largestCoordinate(frame->origin), scale = frame->scale;
    EACH_LANE(k) {
        Vector3D start = laneVector(&arriving->starts, k), from = subVectors(start, frame->origin);
        double depth = dot(from, frame->z), inverse = 1 / depth;
        double size = largestCoordinate(start), noise = 1e-9 * (originSize + size);
        double least = LEAST_COSINE * LEAST_COSINE * dot(from, from);
        int good = (depth > noise) & (depth * depth > least);
        floats->bad.v[k] = good ? 0 : -1;
        floats->u[k] = (float)(good ? dot(from, frame->x) * inverse : 0);
        floats->v[k] = (float)(good ? dot(from, frame->y) * inverse : 0);
        floats->low[k] = (float)(depth * (1 - 1e-6) * scale);
        floats->high[k] = (float)(depth * (1 + 1e-6) * scale);
        /* The referee's rays are as wrong as their ends are far away. */
        int counts = (arriving->lit.v[k] != 0) & good;
        floats->size[k] = (float)(counts != 0 ? size * scale * 0x1p-28 : 0);
    }
}

static void placeParallel(const ShadowFrame *frame, const LightLanes *arriving, FloatLanes *floats)
{
    double scale = frame->scale;
    EACH_LANE(k) {
        Vector3D start = laneVector(&arriving->starts, k), from = subVectors(start, frame->origin);
        double depth = dot(from, frame->z), u = dot(from, frame->x) * scale, v = dot(from, frame->y) * scale;
        double slack = 1e-6 * fabs(depth) + 1e-14 * largestCoordinate(start);
        floats->bad.v[k] = 0;
        floats->u[k] = (float)u;
        floats->v[k] = (float)v;
        floats->low[k] = (float)((depth - slack) * scale);
        floats->high[k] = (float)((depth + slack) * scale);
        /* And u and v are rounded; but a ray that is farther out meets nothing in the tree. */
        double wide = fabs(u) > fabs(v) ? fabs(u) : fabs(v);
        double size = 0x1p-28 * largestCoordinate(start) * scale + (wide < 4 ? wide : 4);
        floats->size[k] = (float)(arriving->lit.v[k] != 0 ? size : 0);
    }
}

/* Bundle the rays of these lanes from the light; returns those that must go alone. */
static uint64_t bundleShadows(TileLanes *tile, const LightLanes *arriving, const ArrivingLight *light,
                              uint64_t lit)
{
    Bundle *bundle = &tile->bundle;
    ShadowFrame frame = {.scale = tile->job->compiled->scale};
    bundle->isParallel = !isfinite(light->distance);
    bundle->light = light;
    bundle->origins = &arriving->starts;

    /* Look from the light to the middle of the points. */
    Vector3D toLight = light->direction;
    if (bundle->isParallel) {
        frame.origin =
            multVector(sumOfVectors(&arriving->starts, &arriving->lit), 1.0 / __builtin_popcountll(lit));
    } else {
        frame.origin = light->position;
        toLight = sumOfVectors(&arriving->directions, &arriving->lit);
        if (!(dot(toLight, toLight) > 0.01))
            return lit;
        toLight = normalize(toLight);
    }
    frame.z = multVector(toLight, -1);
    frameRound(frame.z, &frame.x, &frame.y);
    if (!(largestCoordinate(frame.origin) * frame.scale < (double)FARTHEST_LIGHT))
        return lit;
    setBundleFrame(bundle, tile->job->compiled, frame.origin, frame.x, frame.y, frame.z);
    bundle->startDepth = bundle->isParallel ? -1e30f : 0;

    /* Find where each goes. */
    FloatLanes floats;
    if (bundle->isParallel)
        placeParallel(&frame, arriving, &floats);
    else
        placeCentral(&frame, arriving, &floats);
    uint64_t alone = setOfMask(&floats.bad) & lit, together = lit & ~alone;
    I8 nothing = i8Set(NO_PRIMITIVE);
    F8 largest = f8Set(0);
    for (int p = 0; p < PACKETS; p++) {
        F8 u = f8Load(&floats.u[8 * p]), v = f8Load(&floats.v[8 * p]);
        bundle->u[p] = u;
        bundle->v[p] = v;
        bundle->nearest[p] = f8Load(&floats.low[8 * p]);
        bundle->farthest[p] = f8Load(&floats.high[8 * p]);
        bundle->slope[p] = bundle->isParallel ? f8Set(1) : f8MultAdd(u, u, f8MultAdd(v, v, f8Set(1)));
        bundle->inverseSlope[p] = f8Set(1) / bundle->slope[p];
        largest = f8Max(largest, f8Load(&floats.size[8 * p]));
        I8 leaves = *(const I8 *)&arriving->leaves.v[8 * p];
        bundle->primitives[p] = i8Select(leaves, *(const I8 *)&tile->ownPrimitives[8 * p], nothing);
        bundle->active[p] = (uint8_t)(together >> 8 * p);
    }
    /* Nor would they of a point so far away that the margins leave the range of a float. */
    if (!(f8Largest(largest) < FARTHEST_LIGHT))
        return lit;
    bundle->largest += f8Largest(largest);
    return alone;
}

/* The lanes that the light reaches, of those that are lit. Light that comes through something transparent is
 * coloured by it. */
static uint64_t castShadows(TileLanes *tile, const Light *light, int sample, uint64_t lit,
                            uint32_t *lastBlock, LightLanes *arriving)
{
    const CompiledScene *compiled = tile->job->compiled;
    ArrivingLight itself = lightItself(light, sample);
    lit = endlessShadows(tile, arriving, &itself, lit);
    if (lit == 0)
        return lit;

    if (compiled->root != CHILD_NONE) {
        uint64_t alone = bundleShadows(tile, arriving, &itself, lit);
        uint64_t together = lit & ~alone;
        if (together != 0) {
            PATH(blockBundle)(&tile->bundle, lastBlock);
            uint64_t open;
            __builtin_memcpy(&open, tile->bundle.active, sizeof open);
            lit = alone | (together & open);
        }
        EACH_SET(k, alone) {
            ShadowRay shadow = laneShadow(arriving, &itself, k);
            if (compiled->path->blockRay(compiled, &shadow))
                lit &= ~(1ull << k);
        }
    }
    if (compiled->transparentCount > 0)
        EACH_SET(k, lit) {
            ShadowRay shadow = laneShadow(arriving, &itself, k);
            Color3f color =
                lightThroughObjects(compiled->scene, compiled->transparent, compiled->transparentCount,
                                    &shadow, laneColor(&arriving->colors, k));
            setLaneColor(&arriving->colors, k, color);
            if (colorIsBlack(color))
                lit &= ~(1ull << k);
        }
    return lit;
}

/* ---- Adding up ---- */

/* As diffuseReflection. */
static void addDiffuse(const TileLanes *tile, const LightLanes *arriving, const MaskLanes *reached,
                       ColorLanes *sum)
{
    EACH_LANE(k) {
        double cosine = arriving->cosines.v[k];
        Color3f term = multColors(scaleColor(laneColor(&tile->diffuse, k), cosine > 0 ? cosine : 0),
                                  laneColor(&arriving->colors, k));
        bool counts = reached->v[k] != 0;
        sum->r[k] += counts ? term.r : 0;
        sum->g[k] += counts ? term.g : 0;
        sum->b[k] += counts ? term.b : 0;
    }
}

/* highlightPower of each lane, one shininess at a time: few tiles have many. */
static void raiseToShininess(const TileLanes *tile, uint64_t lanes, const NumberLanes *cosines,
                             NumberLanes *powers)
{
    while (lanes != 0) {
        double shininess = tile->shininess.v[__builtin_ctzll(lanes)];
        MaskLanes same;
        EACH_LANE(k)
            same.v[k] = tile->shininess.v[k] == shininess ? -1 : 0;
        if (isWholeShininess(shininess)) {
            /* wholePower, its loop outside that over lanes. */
            NumberLanes squares, products;
            EACH_LANE(k) {
                squares.v[k] = cosines->v[k];
                products.v[k] = 1;
            }
            for (int left = (int)shininess; left != 0; left >>= 1) {
                if ((left & 1) != 0)
                    EACH_LANE(k)
                        products.v[k] *= squares.v[k];
                EACH_LANE(k)
                    squares.v[k] *= squares.v[k];
            }
            EACH_LANE(k)
                powers->v[k] = same.v[k] != 0 ? products.v[k] : powers->v[k];
        } else {
            EACH_LANE(k) {
                double raised = power(cosines->v[k], shininess);
                powers->v[k] = same.v[k] != 0 ? raised : powers->v[k];
            }
        }
        lanes &= ~setOfMask(&same);
    }
}

/* The highlights of these lanes, from the cosine of each. */
static void addPowers(const TileLanes *tile, const LightLanes *arriving, NumberLanes *cosines, uint64_t lanes,
                      ColorLanes *sum)
{
    MaskLanes counts;
    maskOfSet(lanes, &counts);
    NumberLanes powers;
    EACH_LANE(k) {
        counts.v[k] = cosines->v[k] > 0 ? counts.v[k] : 0;
        cosines->v[k] = cosines->v[k] > 0 ? cosines->v[k] : 0;
        powers.v[k] = 0;
    }
    lanes = setOfMask(&counts);
    if (lanes == 0)
        return;
    raiseToShininess(tile, lanes, cosines, &powers);
    EACH_LANE(k) {
        Color3f term = scaleColor(laneColor(&arriving->colors, k), powers.v[k]);
        bool adds = counts.v[k] != 0;
        sum->r[k] += adds ? term.r : 0;
        sum->g[k] += adds ? term.g : 0;
        sum->b[k] += adds ? term.b : 0;
    }
}

/* As specularHighlight and blinnHighlight. */
static void addHighlights(const TileLanes *tile, const LightLanes *arriving, uint64_t reached,
                          ColorLanes *sum)
{
    NumberLanes cosines;
    if ((reached & tile->phong) != 0) {
        EACH_LANE(k) {
            Vector3D l = laneVector(&arriving->directions, k), n = laneVector(&tile->normals, k);
            Vector3D v = multVector(laneVector(&tile->directions, k), -1);
            cosines.v[k] = dot(reflect(multVector(l, -1), n), v);
        }
        addPowers(tile, arriving, &cosines, reached & tile->phong, sum);
    }
    if ((reached & tile->blinn) != 0) {
        EACH_LANE(k) {
            Vector3D l = laneVector(&arriving->directions, k), n = laneVector(&tile->normals, k);
            Vector3D v = multVector(laneVector(&tile->directions, k), -1);
            cosines.v[k] = blinnCosine(n, l, v);
        }
        addPowers(tile, arriving, &cosines, reached & tile->blinn, sum);
    }
}

/* As lightReturned. */
static void shadeLights(TileLanes *tile)
{
    const Scene *scene = tile->job->compiled->scene;
    ColorLanes diffuse, highlight;
    EACH_LANE(k) {
        setLaneColor(&diffuse, k, createColor(0, 0, 0));
        setLaneColor(&highlight, k, createColor(0, 0, 0));
    }
    uint64_t shaded = tile->met & ~tile->simple;
    LightLanes arriving;
    for (size_t i = 0; i < scene->lightCount && shaded != 0; i++) {
        const Light *light = &scene->lights[i];
        uint32_t *lastBlock = &tile->lastBlocks[i % LAST_BLOCKS];
        for (int sample = 0; sample < lightSampleCount(light); sample++) {
            arrive(tile, light, sample, &arriving);
            uint64_t reached = setOfMask(&arriving.lit) & shaded;
            maskOfSet(reached, &arriving.lit);
            if (reached == 0)
                continue;
            if (scene->render.shadows) {
                tile->counts->shadow += (uint64_t)__builtin_popcountll(reached);
                reached = castShadows(tile, light, sample, reached, lastBlock, &arriving);
                if (reached == 0)
                    continue;
            }
            MaskLanes mask;
            maskOfSet(reached, &mask);
            addDiffuse(tile, &arriving, &mask, &diffuse);
            if ((reached & (tile->phong | tile->blinn)) != 0)
                addHighlights(tile, &arriving, reached, &highlight);
        }
    }
    EACH_LANE(k) {
        Color3f own = laneColor(&tile->colors, k);
        Color3f term = multColors(laneColor(&tile->specular, k), laneColor(&highlight, k));
        setLaneColor(&tile->colors, k, addColors(addColors(own, laneColor(&diffuse, k)), term));
    }
}

/* ---- The rare ---- */

/* What the course's tracer would know of the point. */
static SurfacePoint lanePoint(const TileLanes *tile, int k)
{
    return (SurfacePoint){.object = &tile->job->compiled->scene->objects[tile->objects[k]],
                          .hit = {.distance = tile->distances.v[k], .object = tile->surfaces[k]},
                          .position = laneVector(&tile->positions, k),
                          .normal = laneVector(&tile->normals, k),
                          .flatNormal = laneVector(tile->flatNormals, k),
                          .offset = tile->offsets.v[k]};
}

static void shadeSingly(TileLanes *tile)
{
    const TileJob *job = tile->job;
    const SurfaceFinder *finder = &job->compiled->finder;
    EACH_SET(k, tile->simple | tile->secondary) {
        SurfacePoint point = lanePoint(tile, k);
        Ray ray = createRay(laneVector(&tile->origins, k), laneVector(&tile->directions, k));
        Media media = cameraMedia(&job->rays, &ray);
        Color3f color;
        if ((tile->simple >> k & 1) != 0) {
            color = shade(finder, &point, &ray, &media, 1, tile->counts);
        } else {
            Material material = tile->surfaces[k]->material;
            color = addSecondaryRays(finder, &point, &material, &ray, &media, 1, laneColor(&tile->colors, k),
                                     tile->counts);
        }
        setLaneColor(&tile->colors, k, color);
    }
}

void PATH(shadeSurfaces)(TileLanes *tile)
{
    const Scene *scene = tile->job->compiled->scene;
    if (tile->met != ~0ull)
        EACH_LANE(k) {
            setLaneColor(&tile->colors, k, createColor(0, 0, 0));
            setLaneColor(&tile->diffuse, k, createColor(0, 0, 0));
            setLaneColor(&tile->specular, k, createColor(0, 0, 0));
            tile->shininess.v[k] = 1;
        }
    gatherMaterials(tile);
    shadeLights(tile);
    if ((tile->simple | tile->secondary) != 0)
        shadeSingly(tile);

    /* Add what lies behind and between. */
    uint64_t missed = tile->inPicture & ~tile->met;
    if (missed != 0 && !scene->background.isGradient) {
        MaskLanes mask;
        maskOfSet(missed, &mask);
        Color3f color = scene->background.bottom;
        EACH_LANE(k) {
            tile->colors.r[k] = mask.v[k] != 0 ? color.r : tile->colors.r[k];
            tile->colors.g[k] = mask.v[k] != 0 ? color.g : tile->colors.g[k];
            tile->colors.b[k] = mask.v[k] != 0 ? color.b : tile->colors.b[k];
        }
    }
    EACH_SET(k, scene->background.isGradient ? missed : 0) {
        Ray ray = createRay(laneVector(&tile->origins, k), laneVector(&tile->directions, k));
        setLaneColor(&tile->colors, k, backgroundColor(&scene->background, &ray));
    }
    if (scene->fog.distance > 0)
        EACH_SET(k, tile->inPicture) {
            bool isMissed = (missed >> k & 1) != 0;
            setLaneColor(&tile->colors, k,
                         throughFog(&scene->fog, laneColor(&tile->colors, k),
                                    isMissed ? INFINITY : tile->distances.v[k]));
        }
}
