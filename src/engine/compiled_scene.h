/* compiled_scene.h - a scene made ready for the fast engine; see engine.h.
 *
 * What rays are tested against is in float, in a space of its own: world coordinates times `scale`, a power
 * of two that brings the largest of them to 1..2, so that thresholds and margins are free of units. It only
 * filters; what it cannot decide for sure, and everything that reaches the picture, comes from the exact
 * numbers of the scene in double (referee.h).
 *
 *     nodes:  [ 8 boxes | 8 children ]   child: kind << 30 | number
 *                 |
 *                 +-- LEAF_NODE      another node
 *                 +-- LEAF_SPHERES   a block of up to 8 spheres
 *                 +-- LEAF_TRIANGLES a block of up to 8 triangles of meshes
 *                 +-- LEAF_OBJECTS   a block of up to 8 objects of any other shape, by their boxes
 *
 * Primitives are numbered through: spheres, then triangles, then other objects; see PrimitiveKind.
 * Nothing here changes once it is compiled, so any number of threads may read it.
 */
#ifndef ECLAIRAGE_ENGINE_COMPILED_SCENE_H
#define ECLAIRAGE_ENGINE_COMPILED_SCENE_H

#include "engine/engine.h"

#include <stddef.h>
#include <stdint.h>

enum {
    BVH_WIDTH = 8,
    BVH_STACK_SIZE = 320, /* at most 7 children wait on each of BVH_MAX_DEPTH levels */
    BVH_MAX_DEPTH = 40,
    NO_PRIMITIVE = -1,
    MOST_PRIMITIVES = 1 << 29
};

/* What a child reference refers to, in its two highest bits. */
typedef enum LeafKind {
    LEAF_NODE,
    LEAF_SPHERES,
    LEAF_TRIANGLES,
    LEAF_OBJECTS
} LeafKind;

#define CHILD_NONE UINT32_MAX

static inline uint32_t childReference(LeafKind kind, uint32_t number)
{
    return (uint32_t)kind << 30 | number;
}

static inline LeafKind childKind(uint32_t reference)
{
    return (LeafKind)(reference >> 30);
}

static inline uint32_t childNumber(uint32_t reference)
{
    return reference & 0x3FFFFFFF;
}

/* Eight boxes; those of absent children are empty (min above max) and come last. Each contains all below it,
 * rounded outwards. */
typedef struct BvhNode {
    _Alignas(64) float min[3][8];
    float max[3][8];
    uint32_t children[8];
    uint32_t padding[8];
} BvhNode;

/* Absent ones have the primitive NO_PRIMITIVE, and numbers that no ray meets. */
typedef struct SphereBlock {
    _Alignas(32) float x[8], y[8], z[8], radius[8];
    int32_t primitives[8];
} SphereBlock;

typedef struct TriangleBlock {
    _Alignas(32) float corners[3][3][8]; /* [corner][axis] */
    int32_t primitives[8];
} TriangleBlock;

typedef struct ObjectBlock {
    _Alignas(32) float min[3][8], max[3][8];
    int32_t primitives[8];
} ObjectBlock;

typedef struct ExactSphere {
    Vector3D center;
    double radius;
} ExactSphere;

/* A triangle of a mesh. */
typedef struct MeshPart {
    uint32_t object, triangle;
} MeshPart;

/* A plane without transform. */
typedef struct ExactPlane {
    Vector3D normal;
    double height;    /* dot(normal, point), as its intersection computes it */
    double magnitude; /* as of its shape */
    uint32_t object;
    bool castsShadow;
} ExactPlane;

struct CompiledScene {
    SurfaceFinder finder; /* the general path: one ray at a time */
    const Scene *scene;
    double scale;

    BvhNode *nodes;
    SphereBlock *sphereBlocks;
    TriangleBlock *triangleBlocks;
    ObjectBlock *objectBlocks;
    size_t nodeCount, sphereBlockCount, triangleBlockCount, objectBlockCount;
    uint32_t root; /* CHILD_NONE: the tree is empty */

    ExactSphere *spheres;
    uint32_t *sphereObjects; /* the object of each */
    size_t sphereCount;
    MeshPart *triangles;
    size_t triangleCount;
    uint32_t *generalObjects; /* those behind ObjectBlocks */
    size_t generalCount;

    /* Without end, or out of the range of a float: every ray looks at them. */
    ExactPlane *planes;
    size_t planeCount;
    uint32_t *endless;
    size_t endlessCount;

    uint32_t *transparent; /* numbers of the transparent objects, rising */
    size_t transparentCount;
    uint8_t *skipsShadow;     /* of each object: it blocks no light by itself, being transparent or without
                               * shadow; NULL where there is none */
    Material *materials;      /* those that occur, each once */
    uint32_t *objectMaterial; /* of each object */
    size_t materialCount;
    bool lanesShade; /* the picture is shaded in lanes; otherwise each ray by itself */
    const struct LanePath *path;
};

/* What kind of primitive this is. */
typedef enum PrimitiveKind {
    PRIMITIVE_SPHERE,
    PRIMITIVE_TRIANGLE,
    PRIMITIVE_OBJECT
} PrimitiveKind;

static inline PrimitiveKind primitiveKind(const CompiledScene *compiled, int32_t primitive)
{
    size_t number = (size_t)primitive;
    return number < compiled->sphereCount                             ? PRIMITIVE_SPHERE
           : number < compiled->sphereCount + compiled->triangleCount ? PRIMITIVE_TRIANGLE
                                                                      : PRIMITIVE_OBJECT;
}

/* The number of its object in the scene. */
static inline uint32_t primitiveObject(const CompiledScene *compiled, int32_t primitive)
{
    size_t number = (size_t)primitive;
    switch (primitiveKind(compiled, primitive)) {
    case PRIMITIVE_SPHERE:
        return compiled->sphereObjects[number];
    case PRIMITIVE_TRIANGLE:
        return compiled->triangles[number - compiled->sphereCount].object;
    default:
        return compiled->generalObjects[number - compiled->sphereCount - compiled->triangleCount];
    }
}

static inline bool objectSkipsShadow(const CompiledScene *compiled, uint32_t object)
{
    return compiled->skipsShadow != NULL && compiled->skipsShadow[object] != 0;
}

/* Find what is wrong with the tree, or NULL: a child out of its parent's box, a primitive absent or twice, a
 * depth beyond BVH_MAX_DEPTH. Sanitized builds look for it after each compile. */
const char *findBvhFault(const CompiledScene *compiled);

#endif
