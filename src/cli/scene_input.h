/* scene_input.h - the scene that a command works on: the file, changed by the options. */
#ifndef ECLAIRAGE_CLI_SCENE_INPUT_H
#define ECLAIRAGE_CLI_SCENE_INPUT_H

#include "base/status.h"
#include "base/text.h"
#include "cli/command.h"
#include "colors.h"
#include "raytracer.h"

#include <stdbool.h>

/* Load the scene at path and let the options override it. What there is to say, the failure included, is
 * appended to messages. On success the caller frees the scene with freeScene. */
Status openScene(const char *path, const Arguments *arguments, Scene *scene, Text *messages);

/* The same, printing at once what there is to say. */
Status openSceneAloud(const char *path, const Arguments *arguments, Scene *scene);

/* Let the limits that were given, those that are not NAN, take the place of others. */
void overrideTolerance(const Tolerance *given, Tolerance *tolerance);

/* The threads to draw on. */
int chosenThreads(const Arguments *arguments);

/* Append the name that a result of the scene gets where none is given: SCENE.yaml or SCENE.yml with the
 * extension in place of its own, any other name with the extension behind it. */
void appendNameBeside(const char *scene, const char *extension, Text *name);

/* Whether the path's name ends in .png, in any case. */
bool isPictureName(const char *path);

/* The part of a path behind its last slash. */
const char *baseName(const char *path);

/* STATUS_USAGE when writing to output, which may be NULL, would destroy what is read: an operand, or a file
 * that the scene names; scene may be NULL. The message ends with the remedy, such as CHOOSE_OUTPUT. */
#define CHOOSE_OUTPUT "choose another name with -o"
Status refuseOverwriting(const Arguments *arguments, const Scene *scene, const char *output,
                         const char *remedy);

/* Whether output could be written, found out before the long work and not after it: what can be known
 * without touching an existing file. */
Status probeOutput(const char *output);

/* Append a warning when the picture has pixels that a file cannot hold. */
void warnOfNonFinitePixels(const Framebuffer *framebuffer, const char *path, Text *messages);

#endif
