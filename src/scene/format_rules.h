/* format_rules.h - what the table cannot say: rules between keys, and where the values go.
 *
 * Each finish function belongs to one mapping of format_table.c and is called when its keys were read; see
 * FormatMapping. They build the scene through the same functions that a C program would call. Those of the
 * image, the camera and the lights are in format_rules.c, of transforms and patterns in pattern_rules.c, of
 * objects in object_rules.c.
 */
#ifndef ECLAIRAGE_SCENE_FORMAT_RULES_H
#define ECLAIRAGE_SCENE_FORMAT_RULES_H

#include "geometry.h"
#include "raytracer.h"
#include "scene/object_scopes.h"

struct GivenKeys;
struct SceneReader;
struct YamlNode;

/* ---- Values as they are written ---- */

typedef struct CameraValues {
    Vector3D position, lookAt, direction, up;
    double fov;
    Projection projection;
    double viewHeight;
} CameraValues;

typedef struct LightValues {
    Light light;
    Vector3D lookAt; /* of a spot */
    int samples[2];  /* of an area */
} LightValues;

typedef struct RotateValues {
    Vector3D axis;
    double angle;
} RotateValues;

/* One of them. */
typedef struct StepValues {
    Vector3D translate, scale;
    RotateValues rotate;
    Matrix matrix;
} StepValues;

typedef enum PatternAxis {
    AXIS_X,
    AXIS_Y,
    AXIS_Z
} PatternAxis;

typedef struct PatternValues {
    Pattern pattern;
    PatternAxis axis;
    Matrix transform;
    const char *file;
} PatternValues;

typedef struct ObjectValues {
    Object object; /* the keys of its shape, and its material */
    Matrix transform;
    bool castsShadow;
    bool smooth;                 /* of a mesh */
    const char *file;            /* of a mesh and of spheres */
    const struct YamlNode *rows; /* of spheres */
    ObjectScope scope;           /* of a group and the like: what holds for all in it */
} ObjectValues;

/* ---- Rules ---- */

typedef void FinishFunction(struct SceneReader *reader, struct GivenKeys *given, void *values, void *target);
typedef void EnterFunction(struct SceneReader *reader, struct GivenKeys *given, void *values);

FinishFunction finishImage, finishCamera, finishSky;
FinishFunction finishPoint, finishDirectional, finishSpot, finishArea;
FinishFunction finishStep, finishChecker, finishStripes, finishGradient, finishImageFile;
FinishFunction finishSphere, finishCube, finishBox, finishPlane, finishTriangle, finishMesh, finishCylinder,
    finishCone, finishDisc, finishTorus, finishSpheres, finishGroup;
EnterFunction enterSpheres, enterGroup, enterUnion, enterIntersection, enterDifference;

#endif
