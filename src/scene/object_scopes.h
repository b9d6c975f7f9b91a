/* object_scopes.h - where an object that was read goes: into the scene, or into the solid that it is part
 * of; and what the groups round it hand down to it.
 *
 * While the objects of a group are read its scope is open, the innermost one being reader->scope. Groups are
 * flattened: each leaf gets the transforms of all scopes round it, the nearest material and the shadow. The
 * scope of a union, an intersection or a difference collects its objects as parts; so does a group inside one
 * of these, as a union.
 * Invariant: a leaf is an object that is not itself a solid of parts; leaves are counted in the order in
 * which they are read, which is the order in which a walk of the scene's objects, parts included, meets them.
 */
#ifndef ECLAIRAGE_SCENE_OBJECT_SCOPES_H
#define ECLAIRAGE_SCENE_OBJECT_SCOPES_H

#include "raytracer.h"
#include "scene/source_text.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct GivenKeys;
struct ObjectValues;
struct SceneReader;

/* A use of a material by the number of its name: materials may be defined after their use. */
typedef struct MaterialUse {
    size_t leaf; /* the first that uses it; NAME_NONE: nobody, but it must be defined */
    size_t name; /* NAME_NONE: no name */
    Place place;
    uint32_t leafCount; /* how many one after the other do, at least 1 */
} MaterialUse;

typedef struct ObjectScope {
    struct ObjectScope *outer;
    const Transform *transform; /* of all in it, scopes outside included; NULL: none */
    bool noShadow;
    bool hasMaterial;
    Material material; /* where it has no name */
    MaterialUse materialUse;

    bool isSolid; /* what is in it are the parts of a solid */
    CsgOperation operation;
    const char *solidName; /* for messages: the kind of the solid, such as "difference" */
    Object *parts;
    size_t partCount, partCapacity;
} ObjectScope;

/* Open the scope of the mapping that was read; operation: of a solid. A group, isSolid being false, is a
 * solid only inside one. */
void openScope(struct SceneReader *reader, const struct GivenKeys *given, struct ObjectValues *values,
               bool isSolid, CsgOperation operation);

/* Close the innermost scope, and put the solid, where it is one, where it goes. */
void closeScope(struct SceneReader *reader, const struct GivenKeys *given);

/* Put a leaf of this shape where it goes, with the material, transform and shadow that were read or that the
 * scopes hand down. */
void addReadObject(struct SceneReader *reader, const struct GivenKeys *given,
                   const struct ObjectValues *values, Object object);

/* For objects without keys of their own, inside a scope: give one the material, transform and shadow that the
 * scopes hand down, make room for count of them, and put each where it goes. */
void handDown(const struct SceneReader *reader, Object *object);
void reserveInScope(struct SceneReader *reader, size_t count);
void addInnerObject(struct SceneReader *reader, Place place, Object *object);

/* In place of addReadObject for an object with an error: its material must be defined all the same. */
void dropReadObject(struct SceneReader *reader);

/* When all was read: give the leaves the materials they name, check that what light goes through has one
 * index of refraction in each solid, and put transparent objects behind the others. */
void finishObjects(struct SceneReader *reader);

#endif
