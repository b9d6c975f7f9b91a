/* compare_job.h - one picture drawn by this program and by POV-Ray, measured and written. */
#ifndef ECLAIRAGE_CLI_COMPARE_JOB_H
#define ECLAIRAGE_CLI_COMPARE_JOB_H

#include "base/status.h"
#include "base/text.h"
#include "cli/command.h"
#include "compare/metrics.h"
#include "raytracer.h"

#include <pthread.h>

/* What is the same for all pictures of a run. */
typedef struct CompareSettings {
    const Arguments *arguments;
    const char *folder; /* of the report */
    Engine engine;
    int threads, povrayThreads;
    pthread_mutex_t *turn; /* held by the picture that is drawn or measured */
} CompareSettings;

/* The names of a picture's files, in the folder. */
typedef struct PictureFiles {
    Text ours, povray, difference, pov;
} PictureFiles;

/* Append STEM-ours.png and so on; false when memory runs out. Freed by the caller with freePictureFiles. */
bool namePictureFiles(const char *stem, PictureFiles *files);
void freePictureFiles(PictureFiles *files);

/* What came of it. */
typedef struct PictureResult {
    Metrics metrics;
    Verdict verdict;
    double renderSeconds, povraySeconds, compareSeconds;
} PictureResult;

/* Draw the scene twice, measure by its tolerance, and write the files; warnings are appended to messages. The
 * pictures are written only when all went well. STATUS_USAGE when a file would overwrite one that is read.
 */
Status comparePicture(const CompareSettings *settings, const Scene *scene, const char *scenePath,
                      const PictureFiles *files, PictureResult *result, Text *messages);

#endif
