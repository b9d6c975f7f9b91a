/* load.h - from a YAML file to a Scene.
 *
 * The format is described by one table (scene/format_table.h); what is not in it is an error, never a
 * guess. All errors of a file are found in one run.
 */
#ifndef ECLAIRAGE_SCENE_LOAD_H
#define ECLAIRAGE_SCENE_LOAD_H

#include "base/status.h"
#include "base/text.h"
#include "raytracer.h"
#include "scene/diagnostics.h"

/* Read path ("-" is standard input) into *scene, which the caller frees with freeScene. Errors and
 * warnings are appended, in the order of their places, to diagnostics, which the caller begins as {0} and
 * frees. STATUS_SCENE when there was an error, with the first one's place and message, STATUS_IO when the
 * file could not be read or memory ran out, STATUS_INTERRUPTED when cancelled; then *scene is empty and
 * needs no freeing. */
Status loadScene(const char *path, Scene *scene, Diagnostics *diagnostics);

/* The same from text in memory; the files that it names are relative to the working folder. */
Status loadSceneFromText(const char *text, size_t length, Scene *scene, Diagnostics *diagnostics);

/* Append the JSON Schema (draft-07) of the format. */
void writeSceneSchema(Text *text);

/* Append the reference page of the format in Markdown. */
void writeSceneReference(Text *text);

#endif
