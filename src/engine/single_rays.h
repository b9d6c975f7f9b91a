/* single_rays.h - the engine as a SurfaceFinder: one ray at a time, for what is not done in lanes. */
#ifndef ECLAIRAGE_ENGINE_SINGLE_RAYS_H
#define ECLAIRAGE_ENGINE_SINGLE_RAYS_H

#include "engine/compiled_scene.h"

/* Finds as the reference tracer does, through the compiled scene that it is the first member of. */
SurfaceFinder createSingleRays(const Scene *scene);

#endif
