/* stories.c - random scenes, pixel by pixel: the story's colour is the picture's, to the last bit, and the
 * story can be written in every way.
 *
 *   build/stories [--seeds A..B] [--nasty A..B]
 *
 * Prints TAP, one test for each batch of scenes, with the seed and the pixel where one differs;
 * `build/engines
 * --print SEED` prints the scene. --seeds: scenes of random_scene.c; --nasty: those of nasty_scene.c.
 */
#include "explain/story_writers.h"
#include "nasty_scene.h"
#include "random_scene.h"
#include "scene/load.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    BATCH_SIZE = 50,
    WIDTH = 12,
    HEIGHT = 9,
    EACH = 13 /* of so many pixels one is told */
};

/* Write the story in all ways; false when one of them is empty or fails. */
static bool canBeWritten(const PixelStory *story)
{
    PovrayPixel povray = {.status = statusError(STATUS_POVRAY, "not asked")};
    Text words = {0}, json = {0}, svg = {0};
    writeStoryText(story, &povray, "scene.yaml", true, &words);
    writeStoryJson(story, &povray, "scene.yaml", &json);
    writeStorySvg(story, "scene.yaml", &svg);
    bool written = !words.failed && !json.failed && !svg.failed && words.length > 0 && json.length > 0 &&
                   svg.length > 7 && strcmp(textString(&svg) + svg.length - 7, "</svg>\n") == 0;
    textFree(&words);
    textFree(&json);
    textFree(&svg);
    return written;
}

static bool checkScene(Scene *scene, uint64_t seed, const char *kind)
{
    scene->image.width = WIDTH;
    scene->image.height = HEIGHT;
    Framebuffer *picture = createFramebuffer(WIDTH, HEIGHT);
    RenderOptions options = {.threads = 1};
    Status status = statusOutOfMemory();
    if (picture != NULL)
        status = renderReference(scene, picture, &options, NULL);
    bool ok = statusIsOk(&status);
    for (int i = (int)(seed % EACH); i < WIDTH * HEIGHT && ok; i += EACH) {
        PixelStory story;
        status = createPixelStory(scene, i % WIDTH, i / WIDTH, &story);
        ok = statusIsOk(&status) && memcmp(&story.color, &picture->pixels[i], sizeof story.color) == 0 &&
             canBeWritten(&story);
        if (!ok)
            printf("# %s seed %llu, pixel %d, %d of %d x %d\n", kind, (unsigned long long)seed, i % WIDTH,
                   i / WIDTH, WIDTH, HEIGHT);
        if (statusIsOk(&status))
            freePixelStory(&story);
    }
    freeFramebuffer(picture);
    return ok;
}

static bool checkRandom(uint64_t seed)
{
    Node *tree = createRandomScene(seed);
    Text yaml = {0};
    writeTree(tree, &yaml);
    freeTree(tree);
    Scene scene;
    Diagnostics diagnostics = {0};
    Status status = loadSceneFromText(textString(&yaml), yaml.length, &scene, &diagnostics);
    diagnosticsFree(&diagnostics);
    textFree(&yaml);
    if (!statusIsOk(&status)) {
        printf("# seed %llu cannot be loaded\n", (unsigned long long)seed);
        return false;
    }
    bool ok = checkScene(&scene, seed, "random");
    freeScene(&scene);
    return ok;
}

static bool checkNasty(uint64_t seed)
{
    Scene scene = createNastyScene(seed, 0);
    bool ok = checkScene(&scene, seed, "nasty");
    freeScene(&scene);
    return ok;
}

int main(int argc, char **argv)
{
    int number = 0, failed = 0;
    bool usable = argc > 1 && argc % 2 == 1;
    for (int i = 1; i < argc && usable; i += 2) {
        bool isNasty = strcmp(argv[i], "--nasty") == 0;
        char *end;
        unsigned long long first = strtoull(argv[i + 1], &end, 10), last = first;
        if (strncmp(end, "..", 2) == 0)
            last = strtoull(end + 2, &end, 10);
        usable = (isNasty || strcmp(argv[i], "--seeds") == 0) && *end == '\0' && end != argv[i + 1];
        for (; usable && first <= last; first += BATCH_SIZE) {
            unsigned long long batchEnd = first + BATCH_SIZE - 1 < last ? first + BATCH_SIZE - 1 : last;
            bool ok = true;
            for (unsigned long long seed = first; seed <= batchEnd; seed++)
                ok &= isNasty ? checkNasty(seed) : checkRandom(seed);
            printf("%sok %d - %s scenes %llu to %llu: stories have the picture's bits\n", ok ? "" : "not ",
                   ++number, isNasty ? "nasty" : "random", first, batchEnd);
            fflush(stdout);
            failed += !ok;
        }
    }
    if (!usable) {
        fprintf(stderr, "usage: stories [--seeds A..B] [--nasty A..B]\n");
        return 2;
    }
    printf("1..%d\n", number);
    return failed > 0;
}
