/* povray_pixel.c - what POV-Ray puts into the same pixel; see pixel_story.h. */
#include "explain/pixel_story.h"

#include "image/image.h"
#include "povray/export.h"
#include "povray/run.h"

PovrayPixel askPovray(const PixelStory *story, int threads)
{
    PovrayPixel pixel = {.status = findPovray()};
    if (!statusIsOk(&pixel.status))
        return pixel;
    const Scene *scene = story->scene;
    Text pov = {0};
    pixel.status = exportPov(scene, "scene.pov", &pov);
    if (statusIsOk(&pixel.status) && pov.failed)
        pixel.status = statusOutOfMemory();
    Image image;
    if (statusIsOk(&pixel.status)) {
        PovraySettings settings = createPovraySettings(scene, threads);
        settings.bitDepth = 16;
        settings.encoding = ENCODING_LINEAR;
        settings.onePixel = true;
        settings.x = story->x;
        settings.y = story->y;
        pixel.status = runPovray(textString(&pov), &settings, &image);
    }
    textFree(&pov);
    if (!statusIsOk(&pixel.status))
        return pixel;

    const uint16_t *samples = &image.samples[3 * ((size_t)story->y * (size_t)image.width + (size_t)story->x)];
    const float ours[3] = {story->color.r, story->color.g, story->color.b};
    for (int i = 0; i < 3; i++) {
        pixel.samples[i] = samples[i];
        pixel.stored[i] =
            quantizeSample((float)samples[i] / 65535, scene->image.bitDepth, scene->image.encoding);
        pixel.ours[i] = quantizeSample(ours[i], 16, ENCODING_LINEAR);
        double difference = fabs((double)pixel.samples[i] - (double)pixel.ours[i]) / 65535;
        pixel.difference = fmax(pixel.difference, difference);
    }
    freeImage(&image);
    pixel.agrees = pixel.difference <= scene->tolerance.fail;
    return pixel;
}
