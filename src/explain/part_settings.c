/* part_settings.c - the settings of the picture that it would need; see part_search.h. */
#include "explain/part_search.h"

/* Rays a pixel, in one direction, and rays in a chain, that programs have. */
static const int SAMPLES[] = {1, 2, 3, 4};
static const int DEPTHS[] = {1, 2, 3, 4, 5, 6, 8, 10, 16, 20, 32};

void trySettings(PartSearch *search)
{
    const RenderSettings *asked = &search->truth->scene->render;
    PartChange change = {.kind = PART_SETTINGS, .render = *asked};
    for (size_t i = 0; i < sizeof SAMPLES / sizeof *SAMPLES && !isPartExact(search); i++) {
        change.render.samples = SAMPLES[i];
        if (change.render.samples != asked->samples)
            tryPart(search, &change, PART_SHARE);
    }
    change.render.samples = asked->samples;
    for (size_t i = 0; i < sizeof DEPTHS / sizeof *DEPTHS && !isPartExact(search); i++) {
        change.render.maxDepth = DEPTHS[i];
        /* Where a single ray gives the same, nothing is mirrored or refracted. */
        if (change.render.maxDepth != asked->maxDepth &&
            tryPart(search, &change, PART_SHARE) == search->before && DEPTHS[i] == 1)
            break;
    }
}
