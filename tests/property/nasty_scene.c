/* nasty_scene.c - random scenes made of coincidences; see nasty_scene.h.
 *
 * Points lie on a lattice, mostly: spheres touch and coincide, triangles share edges and planes, rays run
 * along axes, through edges and vertices, the eye and the lights are on surfaces. Then the whole scene is
 * scaled and moved, by up to what still is a scene. Nothing of it is likely to have a picture that is worth
 * looking at.
 */
#include "nasty_scene.h"

#include "shapes/mesh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct Chance {
    uint64_t state;
    double scale;    /* of all lengths */
    Vector3D offset; /* of all points, scaled */
    double step;     /* of the lattice */
    double blur;     /* how far points are off it */
} Chance;

/* Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators", figure 17. */
static double uniform(Chance *chance)
{
    uint64_t z = (chance->state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static int pick(Chance *chance, int count)
{
    return (int)(uniform(chance) * count);
}

static bool happens(Chance *chance, double probability)
{
    return uniform(chance) < probability;
}

static void *needed(void *memory)
{
    if (memory == NULL) {
        fprintf(stderr, "nasty_scene: out of memory\n");
        exit(4);
    }
    return memory;
}

static void add(Scene *scene, Object object)
{
    if (!addObjectToScene(scene, object))
        needed(NULL);
}

/* ---- Numbers ---- */

static double coordinate(Chance *chance)
{
    double at = (pick(chance, 7) - 3) * chance->step;
    return at + chance->blur * (2 * uniform(chance) - 1);
}

/* A point of the lattice before scale and offset. */
static Vector3D barePoint(Chance *chance)
{
    double x = coordinate(chance), y = coordinate(chance);
    return createVector(x, y, coordinate(chance));
}

static Vector3D point(Chance *chance)
{
    return addVectors(multVector(barePoint(chance), chance->scale), chance->offset);
}

static double length(Chance *chance)
{
    static const double lengths[] = {0.5, 1, 1, 2, 0.25, 1e-3, 1e-6, 3, 100};
    return lengths[pick(chance, happens(chance, 0.8) ? 5 : 9)] * chance->step * chance->scale;
}

/* Not 0; most along an axis. */
static Vector3D direction(Chance *chance)
{
    for (;;) {
        Vector3D d = createVector(pick(chance, 3) - 1, pick(chance, 3) - 1, pick(chance, 3) - 1);
        if (happens(chance, 0.2))
            d = createVector(2 * uniform(chance) - 1, 2 * uniform(chance) - 1, 2 * uniform(chance) - 1);
        if (happens(chance, 0.1))
            d.x += 1e-9;
        if (dot(d, d) > 1e-3)
            return d;
    }
}

static Color3f color(Chance *chance)
{
    float r = (float)uniform(chance), g = (float)uniform(chance);
    return createColor(r, g, (float)uniform(chance));
}

static Material material(Chance *chance)
{
    Material made = defaultMaterial();
    made.diffuse = color(chance);
    if (happens(chance, 0.4)) {
        made.specular = color(chance);
        made.shininess = (float)(1 + pick(chance, 100));
    }
    if (happens(chance, 0.15))
        made.reflection = color(chance);
    if (happens(chance, 0.15)) {
        made.transmission = color(chance);
        made.ior = happens(chance, 0.3) ? 1 : 1.4f;
    }
    if (happens(chance, 0.1))
        made.model = (ShadingModel)(MODEL_SIMPLE + pick(chance, 4));
    return made;
}

/* ---- Objects ---- */

/* An odd map, or NULL. */
static const Transform *transform(Chance *chance, Scene *scene, double probability)
{
    if (!happens(chance, probability))
        return NULL;
    static const double factors[] = {1, -1, 2, 0.5, 1000, 0.001, -0.3, 1e5};
    Matrix turn = rotationMatrix(direction(chance), 45 * pick(chance, 8));
    int most = happens(chance, 0.7) ? 4 : 8;
    Vector3D by;
    by.x = factors[pick(chance, most)];
    by.y = factors[pick(chance, most)];
    by.z = factors[pick(chance, most)];
    Matrix stretch = scalingMatrix(by),
           move = translationMatrix(multVector(barePoint(chance), chance->scale));
    Matrix all = composeMatrices(&turn, &stretch);
    if (happens(chance, 0.5))
        all = composeMatrices(&all, &move);
    Transform *made = needed(allocateInScene(scene, sizeof *made));
    return createTransform(&all, made) ? made : NULL;
}

/* Triangles between points of the lattice, some of them slivers. NULL where none has an area. */
static MeshData *mesh(Chance *chance)
{
    MeshData *made = needed(calloc(1, sizeof *made));
    size_t vertices = 4 + (size_t)pick(chance, 12), triangles = 1 + (size_t)pick(chance, 24);
    made->vertices = needed(calloc(vertices, sizeof *made->vertices));
    made->triangles = needed(calloc(triangles, sizeof *made->triangles));
    made->isSmooth = happens(chance, 0.3);
    for (size_t i = 0; i < vertices; i++)
        made->vertices[i] = point(chance);
    if (happens(chance, 0.3))
        made->vertices[0].x += 1e-9 * chance->scale;
    for (size_t i = 0; i < triangles; i++)
        for (int c = 0; c < 3; c++) {
            made->triangles[i].vertices[c] = (uint32_t)pick(chance, (int)vertices);
            made->triangles[i].normals[c] = MESH_NO_NORMAL;
        }
    made->vertexCount = vertices;
    made->triangleCount = triangles;
    Status status = buildMesh(made);
    if (statusIsOk(&status))
        return made;
    freeMesh(made);
    return NULL;
}

static Object simpleObject(Chance *chance)
{
    Object made = {.kind = SHAPE_SPHERE};
    Material own = material(chance);
    Vector3D at = point(chance);
    double size = length(chance);
    switch (pick(chance, 9)) {
    case 0:
        made.kind = SHAPE_BOX;
        made.box = createBox(at, addVectors(at, createVector(size, size, length(chance))), own);
        break;
    case 1:
        made.kind = SHAPE_CUBE;
        made.cube = createCube(at, size, own);
        break;
    case 2:
        made.kind = SHAPE_CONE;
        made.cone = createCone(at, addVectors(at, multVector(normalize(direction(chance)), size)), size,
                               happens(chance, 0.5) ? size : 0, false, own);
        break;
    case 3:
        made.kind = SHAPE_DISC;
        made.disc = createDisc(at, direction(chance), size, happens(chance, 0.5) ? 0 : size / 2, own);
        break;
    case 4:
        made.kind = SHAPE_TORUS;
        made.torus = createTorus(size, size / (1 + pick(chance, 3)), own);
        break;
    default:
        made.sphere = createSphere(at, size, own);
    }
    return made;
}

static Object solid(Chance *chance, Scene *scene)
{
    Object made = {.kind = SHAPE_CSG};
    made.csg.material = defaultMaterial();
    made.csg.operation = (CsgOperation)pick(chance, 4);
    made.csg.partCount = 2 + (size_t)pick(chance, 2);
    made.csg.parts = needed(calloc(made.csg.partCount, sizeof *made.csg.parts));
    for (size_t i = 0; i < made.csg.partCount;) {
        Object part = simpleObject(chance);
        if (!objectShape(&part)->hasInside(&part))
            continue;
        part.transform = transform(chance, scene, 0.3);
        made.csg.parts[i++] = part;
    }
    return made;
}

/* One thing; its number in the scene decides whether it is left out. */
static void addThing(Chance *chance, Scene *scene, bool isLeftOut)
{
    Object made = {.kind = SHAPE_MESH};
    double kind = uniform(chance);
    if (kind < 0.1) {
        made.kind = SHAPE_PLANE;
        made.plane = createPlane(point(chance), direction(chance), material(chance));
        made.transform = transform(chance, scene, 0.2);
    } else if (kind < 0.35) {
        MeshData *data = mesh(chance);
        if (data == NULL)
            return;
        if (!keepMeshInScene(scene, data))
            needed(NULL);
        made.mesh = (Mesh){material(chance), data};
        made.transform = transform(chance, scene, 0.3);
    } else if (kind < 0.42) {
        made = solid(chance, scene); /* has no transform of its own: its parts do */
    } else {
        made = simpleObject(chance);
        made.transform = transform(chance, scene, made.kind == SHAPE_TORUS ? 1 : 0.15);
    }
    made.noShadow = happens(chance, 0.1);
    if (isLeftOut)
        releaseObject(&made);
    else
        add(scene, made);
}

static Light light(Chance *chance)
{
    Light made = createLight(point(chance), color(chance));
    if (happens(chance, 0.2))
        made.position = multVector(made.position, 1e9);
    double size = chance->scale;
    made.falloff = size == 1 && happens(chance, 0.5) ? FALLOFF_INVERSE_SQUARE : FALLOFF_NONE;
    made.kind = (LightKind)pick(chance, 4);
    made.direction = normalize(direction(chance));
    made.innerAngle = 10;
    made.outerAngle = 30 + 15 * pick(chance, 5);
    made.tightness = pick(chance, 3);
    made.edgeU = multVector(direction(chance), size);
    made.edgeV = multVector(direction(chance), size);
    made.countU = 1 + pick(chance, 3);
    made.countV = 1 + pick(chance, 3);
    return made;
}

Scene createNastyScene(uint64_t seed, uint64_t without)
{
    static const double scales[] = {1e-3, 1e-6, 1e6, 1e30, 1e-30, 1e100, 1e-100};
    static const double steps[] = {1, 0.1, 1 / 3.0, 5};
    static const double blurs[] = {1e-16, 1e-12, 1e-9, 1e-3};
    static const double offsets[] = {1e3, 1e6, -1e9};
    Chance chance = {.state = seed * 2654435761u + 1, .scale = 1};
    if (happens(&chance, 0.4))
        chance.scale = scales[pick(&chance, 7)];
    chance.step = steps[pick(&chance, 4)];
    if (happens(&chance, 0.5))
        chance.blur = happens(&chance, 0.4) ? chance.step : blurs[pick(&chance, 4)];
    if (happens(&chance, 0.3))
        chance.offset = multVector(direction(&chance), chance.scale * offsets[pick(&chance, 3)]);

    Scene scene = createScene();
    scene.camera.position = point(&chance);
    if (happens(&chance, 0.5))
        scene.camera.position.z += 10 * chance.scale;
    scene.camera.direction = direction(&chance);
    if (happens(&chance, 0.6))
        scene.camera.direction = subVectors(point(&chance), scene.camera.position);
    if (!(norm(scene.camera.direction) > 0))
        scene.camera.direction = createVector(0, 0, -1);
    scene.camera.up = createVector(0.3, 1, 0.2);
    if (scene.camera.direction.x == 0 && scene.camera.direction.z != 0)
        scene.camera.up = createVector(0, 1, 0);
    if (scene.camera.direction.x != 0 && scene.camera.direction.y == 0)
        scene.camera.up = createVector(0, 1, 0);
    static const double fovs[] = {60, 60, 90, 179, 1, 10};
    scene.camera.fov = fovs[pick(&chance, 6)];
    if (happens(&chance, 0.25)) {
        scene.camera.projection = PROJECTION_ORTHOGRAPHIC;
        scene.camera.viewHeight = (1 + pick(&chance, 8)) * chance.step * chance.scale;
    }
    scene.image.width = 1 + pick(&chance, 40);
    scene.image.height = 1 + pick(&chance, 30);
    scene.render.samples = happens(&chance, 0.1) ? 2 : 1;
    scene.render.shadows = happens(&chance, 0.9);
    if (happens(&chance, 0.08))
        scene.render.shadowBias = happens(&chance, 0.5) ? 0 : 0.01 * chance.scale;
    if (happens(&chance, 0.1))
        scene.render.model = (ShadingModel)(MODEL_SIMPLE + pick(&chance, 4));
    scene.background = (Background){color(&chance), color(&chance), happens(&chance, 0.5)};
    if (happens(&chance, 0.1))
        scene.fog = (Fog){color(&chance), 5 * chance.scale};

    for (int i = pick(&chance, 4); i > 0; i--)
        if (!addLightToScene(&scene, light(&chance)))
            needed(NULL);
    int things = 1 + pick(&chance, happens(&chance, 0.5) ? 8 : 60);
    for (int i = 0; i < things; i++)
        addThing(&chance, &scene, i < 64 && (without >> i & 1) != 0);
    return scene;
}
