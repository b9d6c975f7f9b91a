/* side_view.h - the plane of the drawing of a pixel's story: how it lies in the scene, and how much it shows.
 */
#ifndef ECLAIRAGE_EXPLAIN_SIDE_VIEW_H
#define ECLAIRAGE_EXPLAIN_SIDE_VIEW_H

#include "explain/cut_outline.h"
#include "explain/pixel_story.h"

/* A length that fits the scene, in scene units, for a ray that meets nothing. */
double sceneLength(const PixelStory *story);

/* Where the ray of the camera ends; far: its length where it meets nothing. */
Vector3D endOfCameraRay(const RayStory *ray, double far);

/* Lay the plane through the ray of the camera and the light that matters most, which is returned; NULL where
 * there is none. The plane's left, top, width and height are given, all else is set. */
const LightStory *choosePlane(const PixelStory *story, double far, DrawingPlane *plane);

/* From where, as words, one looks at the plane: "from the side", "from above", "from the side and below". up:
 * the camera's. */
const char *viewOfPlane(const DrawingPlane *plane, Vector3D up);

#endif
