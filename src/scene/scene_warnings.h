/* scene_warnings.h - scenes that are valid and would come out black or empty.
 *
 * Only what is certain is said: a warning on a fine scene would be a defect. Each warning's condition is
 * argued for where it is computed.
 */
#ifndef ECLAIRAGE_SCENE_SCENE_WARNINGS_H
#define ECLAIRAGE_SCENE_SCENE_WARNINGS_H

#include "scene/reader.h"

/* Add the warnings about a scene that was read without errors; given: its sections. */
void addSceneWarnings(SceneReader *reader, const GivenKeys *given);

#endif
