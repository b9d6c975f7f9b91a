/* format_rules.h - what the table cannot say: rules between keys, and where the values go.
 *
 * Each finish function belongs to one mapping of format_table.c and is called when its keys were read; see
 * FormatMapping. They build the scene through the same functions that a C program would call.
 */
#ifndef ECLAIRAGE_SCENE_FORMAT_RULES_H
#define ECLAIRAGE_SCENE_FORMAT_RULES_H

#include "geometry.h"

struct SceneReader;
struct GivenKeys;

/* `camera` as it is written. */
typedef struct CameraValues {
    Vector3D position, lookAt, direction, up;
    double fov;
} CameraValues;

void finishImage(struct SceneReader *reader, const struct GivenKeys *given, void *values, void *target);
void finishCamera(struct SceneReader *reader, const struct GivenKeys *given, void *values, void *target);
void finishPoint(struct SceneReader *reader, const struct GivenKeys *given, void *values, void *target);
void finishSphere(struct SceneReader *reader, const struct GivenKeys *given, void *values, void *target);
void finishCube(struct SceneReader *reader, const struct GivenKeys *given, void *values, void *target);
void finishBox(struct SceneReader *reader, const struct GivenKeys *given, void *values, void *target);
void finishPlane(struct SceneReader *reader, const struct GivenKeys *given, void *values, void *target);

#endif
