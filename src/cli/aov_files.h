/* aov_files.h - the pictures of `render --aov`: their files, and what --json says of them. */
#ifndef ECLAIRAGE_CLI_AOV_FILES_H
#define ECLAIRAGE_CLI_AOV_FILES_H

#include "base/json.h"
#include "base/status.h"
#include "base/text.h"
#include "cli/command.h"
#include "explain/aov.h"
#include "raytracer.h"

typedef struct AovFiles {
    unsigned set;
    Text names[AOV_COUNT];  /* of those in the set; beside the picture */
    double farthest;        /* of the depth; NAN where nothing was hit */
    uint64_t *objectPixels; /* of the id, as in AovPictures; owned */
} AovFiles;

/* Name the files by the picture's, which is output, and see before the long work whether each can be written.
 * STATUS_USAGE when one would overwrite what is read. Freed by the caller with freeAovFiles in any case. */
Status prepareAovFiles(const Arguments *arguments, const Scene *scene, const char *output, AovFiles *files);
void freeAovFiles(AovFiles *files);

/* Draw and write them, saying each that is there. The first failure ends it, and its message names the file.
 */
Status writeAovFiles(AovFiles *files, const Scene *scene, const char *scenePath, Engine engine, int threads);

/* Append "aov", an array, to an open object. */
void jsonAovFiles(JsonWriter *json, const AovFiles *files, const Scene *scene);

#endif
