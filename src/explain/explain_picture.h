/* explain_picture.h - say why a picture differs from another one, or from what its scene should give. */
#ifndef ECLAIRAGE_EXPLAIN_EXPLAIN_PICTURE_H
#define ECLAIRAGE_EXPLAIN_EXPLAIN_PICTURE_H

#include "base/status.h"
#include "explain/explanation.h"
#include "image/image.h"
#include "raytracer.h"

#include <stdbool.h>

/* What was found. */
typedef struct PictureExplanation {
    Explanations causes; /* none where the pictures agree */
    Text summary;        /* one sentence for a reader: that they agree, or how far apart they are */
    Image right;         /* what the scene gives, stored as the picture is; no samples where none was drawn */
} PictureExplanation;

void freePictureExplanation(PictureExplanation *explanation);

/* Why mine differs from the reference. STATUS_MISMATCH when their sizes differ; bit depth and encoding may.
 * mineName and referenceName stand for them in messages. STATUS_IO when memory runs out, STATUS_INTERRUPTED
 * when cancelled; then *explanation is untouched. The caller frees it. */
Status explainPictures(const Image *mine, const char *mineName, const Image *reference,
                       const char *referenceName, PictureExplanation *explanation);

/* Where a scene was read from, for the places that are named. */
typedef struct SceneSource {
    const char *name; /* as it is shown */
    const char *text; /* the whole file, or NULL if it is not at hand */
} SceneSource;

/* Why the picture, at whose size the scene is drawn, differs from what the scene gives. As above. */
Status explainPictureOfScene(const Image *picture, const Scene *scene, const SceneSource *source, int threads,
                             PictureExplanation *explanation);

#endif
