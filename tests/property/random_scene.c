/* random_scene.c - a random scene over the whole vocabulary of the scene format; see random_scene.h.
 *
 * The middle of the scene is a cube of side 6 round the origin. Things are put there, each into a sphere of
 * its own: of two things one of which is transparent these spheres are disjoint, others may cut each other.
 * Camera and lights are outside; floor and room, if any, round it. Numbers have three digits behind the
 * point, so that a scene can be read, and are otherwise as they fall.
 */
#include "random_scene.h"

#include <math.h>
#include <string.h>

enum {
    MAX_THINGS = 16,
    MAX_NAMED = 4
};

static const char *const NAMES[MAX_NAMED] = {"clay", "brass", "ink", "pearl"};

/* A sphere that something lies in. */
typedef struct Place {
    double x, y, z, radius;
} Place;

typedef struct Generator {
    uint64_t state;
    bool simple;      /* the scene's model is the simple one */
    bool manySamples; /* a pixel has several */
    Place places[MAX_THINGS];
    bool isGlass[MAX_THINGS];
    int placeCount;
    int namedCount;
} Generator;

/* ---- Chance ---- */

/* Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators", figure 17. */
static double uniform(Generator *generator)
{
    uint64_t z = (generator->state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static double between(Generator *generator, double low, double high)
{
    return round(1000 * (low + (high - low) * uniform(generator))) / 1000;
}

static bool chance(Generator *generator, double probability)
{
    return uniform(generator) < probability;
}

static int pick(Generator *generator, int count)
{
    return (int)(uniform(generator) * count);
}

/* A direction, of a length that does not matter. */
static void addDirection(Generator *generator, Node *parent, const char *key)
{
    double d[3], square = 0;
    while (square < 0.1 || square > 1) {
        square = 0;
        for (int i = 0; i < 3; i++) {
            d[i] = between(generator, -1, 1);
            square += d[i] * d[i];
        }
    }
    addTriple(parent, key, d[0], d[1], d[2]);
}

/* A colour; its channels may be 0, or all the same. */
static void addColor(Generator *generator, Node *parent, const char *key, double low, double high)
{
    if (chance(generator, 0.2)) {
        addNumber(parent, key, between(generator, low, high));
        return;
    }
    double c[3];
    for (int i = 0; i < 3; i++)
        c[i] = chance(generator, 0.08) ? 0 : between(generator, low, high);
    addTriple(parent, key, c[0], c[1], c[2]);
}

/* ---- Transforms ---- */

/* Steps that change the shape, all of them near the identity. */
static void addDistortion(Generator *generator, Node *steps)
{
    Node *step = addMapping(steps, NULL);
    switch (pick(generator, 4)) {
    case 0:
        addNumber(step, "scale", between(generator, 0.5, 1.3));
        break;
    case 1:
        addTriple(step, "scale", between(generator, 0.4, 1.3), between(generator, 0.4, 1.3),
                  (chance(generator, 0.3) ? -1 : 1) * between(generator, 0.4, 1.3));
        break;
    case 2: {
        Node *matrix = addMapping(step, "matrix");
        addTriple(matrix, "x", between(generator, 0.7, 1), between(generator, -0.3, 0.3),
                  between(generator, -0.3, 0.3));
        addTriple(matrix, "y", between(generator, -0.3, 0.3), between(generator, 0.7, 1),
                  between(generator, -0.3, 0.3));
        addTriple(matrix, "z", between(generator, -0.3, 0.3), between(generator, -0.3, 0.3),
                  between(generator, 0.7, 1));
        addTriple(matrix, "translate", 0, between(generator, -0.1, 0.1), 0);
        break;
    }
    default: {
        Node *rotate = addMapping(step, "rotate");
        addDirection(generator, rotate, "axis");
        addNumber(rotate, "angle", between(generator, -180, 180));
    }
    }
}

/* From a thing of radius 1 round the origin to its place. */
static void addTransformTo(Generator *generator, Node *values, Place place)
{
    Node *steps = addList(values, "transform");
    for (int i = pick(generator, 3); i > 0; i--)
        addDistortion(generator, steps);
    addNumber(addMapping(steps, NULL), "scale", round(place.radius * 600) / 1000);
    addTriple(addMapping(steps, NULL), "translate", place.x, place.y, place.z);
}

/* ---- Materials ---- */

static void addPattern(Generator *generator, Node *material)
{
    static const char *const kinds[] = {"checker", "stripes", "gradient", "image"};
    static const char *const axes[] = {"x", "y", "z"};
    int kind = pick(generator, 4);
    Node *pattern = addMapping(addMapping(material, "pattern"), kinds[kind]);
    if (kind == 3) {
        addWord(pattern, "file", "scenes/regress/tiles.png");
        addWord(pattern, "mapping", chance(generator, 0.5) ? "planar" : "spherical");
    } else {
        Node *colors = addList(pattern, "colors");
        addColor(generator, colors, NULL, 0, 1);
        addColor(generator, colors, NULL, 0, 1);
        if (kind > 0 && chance(generator, 0.7))
            addWord(pattern, "axis", axes[pick(generator, 3)]);
    }
    addNumber(pattern, "size", between(generator, 0.2, 2));
    if (chance(generator, 0.5)) {
        Node *steps = addList(pattern, "transform");
        addDistortion(generator, steps);
        if (chance(generator, 0.5))
            addTriple(addMapping(steps, NULL), "translate", between(generator, -1, 1),
                      between(generator, -1, 1), between(generator, -1, 1));
    }
}

/* Fill in a material. */
static void addTerms(Generator *generator, Node *material, bool isGlass)
{
    static const char *const models[] = {"lambert", "phong", "blinn_phong"};
    if (chance(generator, isGlass ? 0.2 : 0.3))
        addPattern(generator, material);
    else if (chance(generator, 0.9))
        addColor(generator, material, "diffuse", 0, isGlass ? 0.2 : 1);
    if (chance(generator, 0.5)) {
        addColor(generator, material, "specular", 0, 1);
        if (chance(generator, 0.8))
            addNumber(material, "shininess", round(10 * exp(uniform(generator) * 5)) / 10);
    }
    if (chance(generator, 0.3))
        addColor(generator, material, "ambient", 0, 1);
    if (chance(generator, 0.15))
        addColor(generator, material, "emission", 0, 0.2);
    if (chance(generator, 0.25))
        addColor(generator, material, "reflection", 0, 0.7);
    if (isGlass) {
        addColor(generator, material, "transmission", 0.2, 0.95);
        addNumber(material, "ior", chance(generator, 0.1) ? 1 : between(generator, 0.7, 1.8));
    }
    if (!generator->simple && chance(generator, 0.2))
        addWord(material, "model", models[pick(generator, 3)]);
}

/* The surface of an object: of its own, a name, or none. */
static void addSurface(Generator *generator, Node *values, bool isGlass)
{
    if (isGlass || chance(generator, 0.6))
        addTerms(generator, addMapping(values, "material"), isGlass);
    else if (generator->namedCount > 0 && chance(generator, 0.7))
        addWord(values, "material", NAMES[pick(generator, generator->namedCount)]);
    if (chance(generator, 0.1))
        addWord(values, "casts_shadow", "false");
}

/* ---- Shapes ---- */

/* What a shape must be able to do. */
typedef enum Need {
    NEED_NOTHING,
    NEED_INSIDE, /* for glass, where an open cylinder will do */
    NEED_SOLID   /* for CSG */
} Need;

static void addPoint(Generator *generator, Node *parent, const char *key, Place place)
{
    double d[3], square = 2;
    while (square > 1 || square < 0.5) {
        square = 0;
        for (int i = 0; i < 3; i++) {
            d[i] = 2 * uniform(generator) - 1;
            square += d[i] * d[i];
        }
    }
    addTriple(parent, key, round(1000 * (place.x + d[0] * place.radius)) / 1000,
              round(1000 * (place.y + d[1] * place.radius)) / 1000,
              round(1000 * (place.z + d[2] * place.radius)) / 1000);
}

static void addConic(Generator *generator, Node *item, Place place, bool mayBeOpen, bool isCone)
{
    Node *values = addMapping(item, isCone ? "cone" : "cylinder");
    double r = place.radius, h = between(generator, 0.3, 0.8) * r;
    double tilt = between(generator, -0.3, 0.3) * r;
    addTriple(values, "base", place.x + tilt, place.y - h, place.z);
    addTriple(values, "top", place.x - tilt, place.y + h, place.z + tilt);
    if (isCone) {
        bool pointed = chance(generator, 0.5);
        addNumber(values, "base_radius", between(generator, 0.2, 0.5) * r);
        addNumber(values, "top_radius", pointed ? 0 : between(generator, 0.1, 0.5) * r);
    } else {
        addNumber(values, "radius", between(generator, 0.2, 0.5) * r);
    }
    if (mayBeOpen && chance(generator, 0.4))
        addWord(values, "open", "true");
}

/* One shape in its place, without surface or transform. Returns its values. */
static Node *addShapeAt(Generator *generator, Node *item, Place place, Need need)
{
    double r = place.radius;
    int kind = pick(generator, need == NEED_NOTHING ? 10 : 7);
    switch (kind) {
    case 0: {
        Node *values = addMapping(item, "sphere");
        addTriple(values, "center", place.x, place.y, place.z);
        addNumber(values, "radius", r);
        return values;
    }
    case 1: {
        Node *values = addMapping(item, "cube");
        addTriple(values, "center", place.x, place.y, place.z);
        addNumber(values, "size", round(r * 1100) / 1000);
        return values;
    }
    case 2: {
        Node *values = addMapping(item, "box");
        double a = between(generator, 0.2, 0.57) * r, b = between(generator, 0.2, 0.57) * r, c = 0.5 * r;
        addTriple(values, "min", place.x - a, place.y - b, place.z - c);
        addTriple(values, "max", place.x + a, place.y + b, place.z + c);
        return values;
    }
    case 3:
    case 4:
        addConic(generator, item, place, need != NEED_SOLID, kind == 4);
        return item->children[0];
    case 5: {
        Node *values = addMapping(item, "mesh");
        addWord(values, "file", "scenes/regress/star.obj");
        if (chance(generator, 0.4))
            addWord(values, "smooth", "false");
        return values;
    }
    case 6: {
        Node *values = addMapping(item, "torus");
        addNumber(values, "major_radius", between(generator, 0.5, 0.7));
        addNumber(values, "minor_radius", between(generator, 0.1, 0.3));
        return values;
    }
    case 7: {
        Node *values = addMapping(item, "triangle");
        Node *vertices = addList(values, "vertices");
        for (int i = 0; i < 3; i++)
            addPoint(generator, vertices, NULL, place);
        return values;
    }
    case 8: {
        Node *values = addMapping(item, "disc");
        addTriple(values, "center", place.x, place.y, place.z);
        addDirection(generator, values, "normal");
        addNumber(values, "radius", r);
        if (chance(generator, 0.5))
            addNumber(values, "inner_radius", between(generator, 0.1, 0.9) * r);
        return values;
    }
    default: {
        Node *values = addMapping(item, "spheres");
        Node *data = addList(values, "data");
        for (int i = 0; i < 4; i++) {
            Node *row = addList(data, NULL);
            addNumber(row, NULL, place.x + between(generator, -0.6, 0.6) * r);
            addNumber(row, NULL, place.y + between(generator, -0.6, 0.6) * r);
            addNumber(row, NULL, place.z + between(generator, -0.6, 0.6) * r);
            addNumber(row, NULL, between(generator, 0.1, 0.4) * r);
        }
        return values;
    }
    }
}

/* One shape, in its place by its own numbers or by a transform. */
static Node *addShape(Generator *generator, Node *list, Place place, Need need)
{
    Node *item = addMapping(list, NULL);
    Place unit = {0, 0, 0, 1};
    bool byTransform = chance(generator, 0.5);
    Node *values = addShapeAt(generator, item, byTransform ? unit : place, need);
    const char *kind = values->key;
    if (byTransform || strcmp(kind, "mesh") == 0 || strcmp(kind, "torus") == 0)
        addTransformTo(generator, values, place);
    return values;
}

/* A solid of parts that overlap. */
static Node *addSolid(Generator *generator, Node *list, Place place, bool isGlass, int depth)
{
    static const char *const operations[] = {"union", "intersection", "difference"};
    int operation = pick(generator, 3);
    Node *values = addMapping(addMapping(list, NULL), operations[operation]);
    Node *parts = addList(values, "objects");
    double r = place.radius;
    for (int i = 0; i < 2 || (i < 4 && chance(generator, 0.3)); i++) {
        double reach = i == 0 ? 0 : operation == 1 ? 0.2 : 0.4;
        Place part = {round(1000 * place.x + 1000 * reach * r * (2 * uniform(generator) - 1)) / 1000,
                      round(1000 * place.y + 1000 * reach * r * (2 * uniform(generator) - 1)) / 1000,
                      round(1000 * place.z + 1000 * reach * r * (2 * uniform(generator) - 1)) / 1000,
                      round(700 * r) / 1000};
        Node *made = depth < 1 && chance(generator, 0.2)
                         ? addSolid(generator, parts, part, isGlass, depth + 1)
                         : addShape(generator, parts, part, NEED_SOLID);
        if (!isGlass && depth == 0)
            addSurface(generator, made, false);
    }
    return values;
}

/* Some shapes that share a transform, a material or the lack of a shadow. */
static void addGroup(Generator *generator, Node *list, Place place, int depth)
{
    Node *values = addMapping(addMapping(list, NULL), "group");
    Node *parts = addList(values, "objects");
    for (int i = 0; i < 2; i++) {
        Place part = {between(generator, -0.6, 0.6), between(generator, -0.6, 0.6),
                      between(generator, -0.6, 0.6), 0.5};
        if (depth < 1 && chance(generator, 0.2))
            addGroup(generator, parts, part, depth + 1);
        else if (chance(generator, 0.3))
            addSolid(generator, parts, part, false, 0);
        else
            addSurface(generator, addShape(generator, parts, part, NEED_NOTHING), false);
    }
    addSurface(generator, values, false);
    addTransformTo(generator, values, place);
}

/* A place for something; false when there is none left. */
static bool findPlace(Generator *generator, bool isGlass, Place *place)
{
    for (int attempt = 0; attempt < 30; attempt++) {
        *place = (Place){between(generator, -3, 3), between(generator, -1.5, 2), between(generator, -3, 3),
                         between(generator, 0.5, 1.3)};
        bool isFree = true;
        for (int i = 0; i < generator->placeCount && isFree; i++) {
            const Place *other = &generator->places[i];
            double dx = place->x - other->x, dy = place->y - other->y, dz = place->z - other->z;
            double reach = 1.3 * (place->radius + other->radius);
            bool mayTouch = !isGlass && !generator->isGlass[i] && attempt == 0;
            isFree = mayTouch || dx * dx + dy * dy + dz * dz > reach * reach;
        }
        if (isFree) {
            generator->isGlass[generator->placeCount] = isGlass;
            generator->places[generator->placeCount++] = *place;
            return true;
        }
    }
    return false;
}

static void addThings(Generator *generator, Node *objects)
{
    int count = 1 + pick(generator, 6);
    for (int i = 0; i < count; i++) {
        bool isGlass = chance(generator, 0.25);
        Place place;
        if (!findPlace(generator, isGlass, &place))
            continue;
        if (!isGlass && chance(generator, 0.2)) {
            addGroup(generator, objects, place, 0);
        } else if (chance(generator, 0.3)) {
            Node *values = addSolid(generator, objects, place, isGlass, 0);
            addSurface(generator, values, isGlass);
        } else {
            Node *values = addShape(generator, objects, place, isGlass ? NEED_INSIDE : NEED_NOTHING);
            addSurface(generator, values, isGlass);
        }
    }
}

/* What the things stand on, or in. */
static void addSurroundings(Generator *generator, Node *objects)
{
    if (chance(generator, 0.7)) {
        Node *plane = addMapping(addMapping(objects, NULL), "plane");
        addTriple(plane, "point", 0, between(generator, -3.5, -2), 0);
        addTriple(plane, "normal", between(generator, -0.1, 0.1), 1, between(generator, -0.1, 0.1));
        addSurface(generator, plane, false);
    }
    if (chance(generator, 0.15)) {
        Node *room = addMapping(addMapping(objects, NULL), "box");
        addTriple(room, "min", between(generator, -18, -14), between(generator, -18, -14),
                  between(generator, -18, -14));
        addTriple(room, "max", between(generator, 14, 18), between(generator, 14, 18),
                  between(generator, 14, 18));
        addSurface(generator, room, false);
    }
}

/* ---- The rest of a scene ---- */

/* A point 7 to 10 away from the origin, well above it. */
static void addOutside(Generator *generator, Node *parent, const char *key)
{
    double angle = 2 * 3.14159265358979 * uniform(generator), height = between(generator, 0.5, 6);
    double away = between(generator, 7, 8);
    addTriple(parent, key, round(1000 * away * cos(angle)) / 1000, height,
              round(1000 * away * sin(angle)) / 1000);
}

static void addCamera(Generator *generator, Node *scene, Node *objects)
{
    Node *camera = addMapping(scene, "camera");
    camera->isFixed = true;
    addOutside(generator, camera, "position");
    addTriple(camera, "look_at", between(generator, -1, 1), between(generator, -1, 0.5),
              between(generator, -1, 1));
    if (chance(generator, 0.3))
        addTriple(camera, "up", between(generator, -0.5, 0.5), 1, between(generator, -0.5, 0.5));
    if (chance(generator, 0.2)) {
        addWord(camera, "projection", "orthographic");
        addNumber(camera, "view_height", between(generator, 4, 8));
    } else {
        addNumber(camera, "fov", between(generator, 30, 70));
        /* Now and then the camera is in a ball of glass. */
        if (chance(generator, 0.06) && !generator->simple) {
            const Node *position = camera->children[0];
            Node *ball = addMapping(addMapping(objects, NULL), "sphere");
            addTriple(ball, "center", position->children[0]->number, position->children[1]->number + 0.1,
                      position->children[2]->number);
            addNumber(ball, "radius", between(generator, 0.4, 0.7));
            addSurface(generator, ball, true);
        }
    }
    for (size_t i = 0; i < camera->count; i++)
        camera->children[i]->isFixed = true;
}

static void addRender(Generator *generator, Node *scene, const char *model, bool shadows)
{
    Node *render = addMapping(scene, "render");
    addWord(render, "model", model);
    if (!shadows)
        addWord(render, "shadows", "false");
    if (chance(generator, 0.5))
        addColor(generator, render, "ambient", 0, 0.5);
    if (chance(generator, 0.6))
        addNumber(render, "max_depth", 1 + pick(generator, 8));
    generator->manySamples = chance(generator, 0.08);
    if (generator->manySamples)
        addNumber(render, "samples", 2 + pick(generator, 2));
}

static void addLight(Generator *generator, Node *lights, int kind)
{
    static const char *const kinds[] = {"point", "directional", "spot", "area"};
    Node *light = addMapping(addMapping(lights, NULL), kinds[kind]);
    bool falls = chance(generator, 0.6);
    double brightest = kind == 1 || !falls ? 1 : 80;
    if (generator->manySamples)
        brightest /= 10;
    if (kind == 1)
        addTriple(light, "direction", between(generator, -1, 1), between(generator, -1, -0.3),
                  between(generator, -1, 1));
    else
        addOutside(generator, light, kind == 3 ? "center" : "position");
    addColor(generator, light, "color", brightest / 5, brightest);
    if (kind != 1 && !falls)
        addWord(light, "falloff", "none");
    if (kind == 2) {
        double outer = between(generator, 8, 30);
        addTriple(light, "look_at", between(generator, -1, 1), between(generator, -2, 1),
                  between(generator, -1, 1));
        addNumber(light, "inner_angle", chance(generator, 0.2) ? outer : between(generator, 0, outer));
        addNumber(light, "outer_angle", outer);
        if (chance(generator, 0.5))
            addNumber(light, "tightness", between(generator, 0, 20));
    }
    if (kind == 3) {
        addTriple(light, "edge_u", between(generator, 0.5, 2), between(generator, -1, 1), 0);
        addTriple(light, "edge_v", 0, between(generator, -1, 1), between(generator, 0.5, 2));
        Node *samples = addList(light, "samples");
        addNumber(samples, NULL, 1 + pick(generator, 3));
        addNumber(samples, NULL, 1 + pick(generator, 3));
    }
}

Node *createRandomScene(uint64_t seed)
{
    static const char *const models[] = {"phong",       "phong",   "phong", "blinn_phong",
                                         "blinn_phong", "lambert", "simple"};
    Generator generator = {.state = seed};
    for (int i = 0; i < 4; i++)
        uniform(&generator);
    Node *scene = createTree();
    Node *image = addMapping(scene, "image");
    image->isFixed = true;
    addNumber(image, "width", 80);
    addNumber(image, "height", 60);

    const char *model = models[pick(&generator, sizeof models / sizeof *models)];
    generator.simple = strcmp(model, "simple") == 0;
    bool shadows = chance(&generator, 0.9);
    addRender(&generator, scene, model, shadows);
    if (chance(&generator, 0.5))
        addColor(&generator, scene, "background", 0, 0.8);
    else if (chance(&generator, 0.6)) {
        Node *gradient = addMapping(addMapping(scene, "background"), "gradient");
        addColor(&generator, gradient, "bottom", 0, 1);
        addColor(&generator, gradient, "top", 0, 1);
    }
    if (chance(&generator, 0.15)) {
        Node *fog = addMapping(scene, "fog");
        addColor(&generator, fog, "color", 0, 0.8);
        addNumber(fog, "distance", between(&generator, 5, 50));
    }

    generator.namedCount = pick(&generator, MAX_NAMED + 1);
    if (generator.namedCount > 0) {
        Node *materials = addMapping(scene, "materials");
        for (int i = 0; i < generator.namedCount; i++)
            addTerms(&generator, addMapping(materials, NAMES[i]), false);
    }
    /* The simple model with shadows and several lights has no like in POV-Ray. */
    Node *lights = addList(scene, "lights");
    int lightCount = generator.simple ? 1 : 1 + pick(&generator, 3);
    for (int i = 0; i < lightCount; i++)
        addLight(&generator, lights, pick(&generator, generator.simple ? 3 : 4));
    Node *objects = addList(scene, "objects");
    addSurroundings(&generator, objects);
    addThings(&generator, objects);
    addCamera(&generator, scene, objects);
    return scene;
}
