/* scene_variant.h - a scene changed in some of its settings, lights or materials, beside the original.
 *
 * What would the picture be without shadows, without highlights, with another falloff? A variant is a Scene
 * of its own as far as such questions reach: its settings, its lights and its objects' materials can be
 * changed freely. Shapes' geometry, meshes, patterns and transforms are the original's, which must live
 * longer.
 */
#ifndef ECLAIRAGE_EXPLAIN_SCENE_VARIANT_H
#define ECLAIRAGE_EXPLAIN_SCENE_VARIANT_H

#include "base/status.h"
#include "raytracer.h"

/* Make a copy to change. STATUS_IO when memory runs out, and then *variant is untouched. The caller frees it
 * with freeSceneVariant, never with freeScene, which would free what it shares. */
Status createSceneVariant(const Scene *original, Scene *variant);
void freeSceneVariant(Scene *variant);

/* Call change for the material of each object, of a CSG object for those of its parts instead. */
void changeMaterials(Scene *variant, void (*change)(Material *material, void *context), void *context);

#endif
