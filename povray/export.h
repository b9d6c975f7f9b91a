/* export.h - from a Scene to the POV-Ray 3.7 scene that draws the same picture (MAPPING.md). */
#ifndef ECLAIRAGE_POVRAY_EXPORT_H
#define ECLAIRAGE_POVRAY_EXPORT_H

#include "base/status.h"
#include "base/text.h"
#include "raytracer.h"

/* Append the .pov. It states everything explicitly, includes nothing and renders alone; its first
 * comment is the command that renders it from the file called name, for a shell in that file's folder;
 * characters that could end the comment are replaced in it.
 * STATUS_INEXPRESSIBLE, with the line of the scene where there is one, for what POV-Ray cannot say. */
Status exportPov(const Scene *scene, const char *name, Text *pov);

/* The same, but written with these PovHabits, which change the picture; those that do not apply to the scene
 * are as if they were not there. Without any it is exportPov. */
Status exportPovWithHabits(const Scene *scene, const char *name, unsigned habits, Text *pov);

#endif
