/* referee.h - what the float filter cannot decide, in the reference tracer's own double arithmetic. */
#ifndef ECLAIRAGE_ENGINE_REFEREE_H
#define ECLAIRAGE_ENGINE_REFEREE_H

#include "engine/compiled_scene.h"

/* The nearest distance above 0 at which the ray meets the primitive, by the same operations as
 * intersectObject; INFINITY, with hit untouched, on a miss. */
double meetPrimitive(const CompiledScene *compiled, int32_t primitive, const Ray *ray, Hit *hit);

/* Whether the primitive lies between the ends of the shadow ray. */
bool primitiveBlocks(const CompiledScene *compiled, int32_t primitive, const ShadowRay *shadow);

/* Whether both ends of the way from `start` to the light are surely on the same side of the primitive's
 * plane, when it is a flat thing: then it blocks nothing, and the shadow ray need not be made. */
bool primitiveIsPassed(const CompiledScene *compiled, int32_t primitive, Vector3D start,
                       const ArrivingLight *light);

/* The nearest of the objects without a box, planes among them: its hit, and its number in the scene. Where
 * there is none hit->distance is INFINITY, and *object above all numbers. */
void meetEndless(const CompiledScene *compiled, const Ray *ray, Hit *hit, uint32_t *object);

/* Whether one of the objects without a box, planes among them, lies between the ends. */
bool endlessBlocks(const CompiledScene *compiled, const ShadowRay *shadow);

/* Of two hits at the same distance the one that the reference tracer keeps: of the object that comes first in
 * the scene, and in a mesh of the triangle that comes first. */
bool comesFirst(const CompiledScene *compiled, int32_t primitive, int32_t other);

#endif
