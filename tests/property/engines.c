/* engines.c - random scenes, each drawn by the course's tracer and by the fast engine: the same picture to
 * the last bit, and the same counts of rays.
 *
 *   build/engines [--seeds A..B] [--nasty A..B] [--print SEED] [--scene FILE]
 *
 * Prints TAP, one test for each batch of scenes. --seeds: scenes of random_scene.c, over the whole vocabulary
 * of the format; one that differs is made smaller as long as it still does, and printed as YAML. --nasty:
 * those of nasty_scene.c; what is left out of one that differs is printed. --scene: one from a file. Run from
 * the repository root.
 */
#include "nasty_scene.h"
#include "random_scene.h"
#include "scene/load.h"
#include "tests/unit/both_engines.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    BATCH_SIZE = 50
};
static const double SHRINK_SECONDS = 20; /* for all scenes of a run together */

typedef struct Paths {
    const char *names[MOST_ENGINE_PATHS];
    size_t count;
} Paths;

/* Whether the engines agree on the scene, with one thread or two. */
static bool agree(const Scene *scene, const Paths *paths, uint64_t seed, char difference[DIFFERENCE_SIZE])
{
    const int threads[2] = {1 + (int)(seed % 2), 0};
    return enginesAgree(scene, scene->image.width, scene->image.height, paths->names, paths->count, threads,
                        difference);
}

/* ---- Scenes of the format ---- */

/* Whether the scene is valid and the engines do not agree on it. */
static bool differs(const Node *tree, const Paths *paths, uint64_t seed, char difference[DIFFERENCE_SIZE])
{
    Text yaml = {0};
    writeTree(tree, &yaml);
    Scene scene;
    Diagnostics diagnostics = {0};
    Status status = loadSceneFromText(textString(&yaml), yaml.length, &scene, &diagnostics);
    diagnosticsFree(&diagnostics);
    textFree(&yaml);
    if (!statusIsOk(&status))
        return false;
    bool agreed = agree(&scene, paths, seed, difference);
    freeScene(&scene);
    return !agreed;
}

/* The smallest scene found that still differs. Takes the tree, returns another. */
static Node *shrink(Node *tree, const Paths *paths, uint64_t seed, char difference[DIFFERENCE_SIZE])
{
    static time_t end;
    if (end == 0)
        end = time(NULL) + (time_t)SHRINK_SECONDS;
    char other[DIFFERENCE_SIZE];
    for (size_t edit = 0; time(NULL) < end;) {
        Node *smaller = makeSmaller(tree, edit);
        if (smaller == NULL)
            return tree;
        if (differs(smaller, paths, seed, other)) {
            freeTree(tree);
            tree = smaller;
            memcpy(difference, other, sizeof other);
            edit = 0;
        } else {
            freeTree(smaller);
            edit++;
        }
    }
    return tree;
}

/* The scene as comment lines of TAP. */
static void printTree(const Node *tree)
{
    Text yaml = {0};
    writeTree(tree, &yaml);
    for (const char *line = textString(&yaml); *line != '\0';) {
        int length = (int)strcspn(line, "\n");
        printf("#   %.*s\n", length, line);
        line += length + (line[length] == '\n');
    }
    textFree(&yaml);
}

static bool checkSeed(uint64_t seed, const Paths *paths)
{
    char difference[DIFFERENCE_SIZE] = "";
    Node *tree = createRandomScene(seed);
    bool failed = differs(tree, paths, seed, difference);
    if (failed) {
        printf("# seed %llu: %s\n", (unsigned long long)seed, difference);
        tree = shrink(tree, paths, seed, difference);
        printf("# made smaller, as far as time allowed: %s\n", difference);
        printTree(tree);
    }
    freeTree(tree);
    return !failed;
}

/* ---- Nasty scenes ---- */

static bool nastyAgrees(uint64_t seed, uint64_t without, const Paths *paths, char difference[DIFFERENCE_SIZE])
{
    Scene scene = createNastyScene(seed, without);
    bool agreed = agree(&scene, paths, seed, difference);
    freeScene(&scene);
    return agreed;
}

static bool checkNasty(uint64_t seed, const Paths *paths)
{
    char difference[DIFFERENCE_SIZE] = "", other[DIFFERENCE_SIZE];
    if (nastyAgrees(seed, 0, paths, difference))
        return true;
    printf("# nasty seed %llu: %s\n", (unsigned long long)seed, difference);
    uint64_t without = 0;
    for (int i = 0; i < 64; i++)
        if (!nastyAgrees(seed, without | 1ull << i, paths, other)) {
            without |= 1ull << i;
            memcpy(difference, other, sizeof other);
        }
    printf("# createNastyScene(%llu, 0x%llx): %s\n", (unsigned long long)seed, (unsigned long long)without,
           difference);
    return false;
}

static bool checkFile(const char *path, const Paths *paths)
{
    char difference[DIFFERENCE_SIZE] = "it cannot be loaded";
    Scene scene;
    Diagnostics diagnostics = {0};
    Status status = loadScene(path, &scene, &diagnostics);
    diagnosticsFree(&diagnostics);
    bool agreed = statusIsOk(&status) && agree(&scene, paths, 1, difference);
    if (statusIsOk(&status))
        freeScene(&scene);
    printf("%sok 1 - %s%s%s\n1..1\n", agreed ? "" : "not ", path, agreed ? "" : ": ",
           agreed ? "" : difference);
    return agreed;
}

/* ---- The run ---- */

typedef struct Seeds {
    uint64_t first, last;
    bool wanted;
} Seeds;

static bool readSeeds(const char *text, Seeds *seeds)
{
    char *end;
    seeds->first = seeds->last = strtoull(text, &end, 10);
    if (end == text)
        return false;
    if (strncmp(end, "..", 2) == 0)
        seeds->last = strtoull(end + 2, &end, 10);
    seeds->wanted = true;
    return *end == '\0' && seeds->last >= seeds->first;
}

/* Check these scenes; returns how many batches differ. */
static int runSeeds(const Seeds *seeds, const char *what, bool (*check)(uint64_t seed, const Paths *paths),
                    const Paths *paths, int *number)
{
    int failed = 0;
    for (uint64_t first = seeds->first; seeds->wanted && first <= seeds->last; first += BATCH_SIZE) {
        uint64_t last = first + BATCH_SIZE - 1 < seeds->last ? first + BATCH_SIZE - 1 : seeds->last;
        bool ok = true;
        for (uint64_t seed = first; seed <= last; seed++)
            ok &= check(seed, paths);
        printf("%sok %d - %s %llu to %llu: both engines draw the same bits\n", ok ? "" : "not ", ++*number,
               what, (unsigned long long)first, (unsigned long long)last);
        fflush(stdout);
        failed += !ok;
    }
    return failed;
}

int main(int argc, char **argv)
{
    Seeds random = {.wanted = false}, nasty = {.wanted = false}, print = {.wanted = false};
    const char *file = NULL;
    bool ok = argc > 1 && argc % 2 == 1;
    for (int i = 1; i < argc && ok; i += 2) {
        if (strcmp(argv[i], "--scene") == 0) {
            file = argv[i + 1];
            continue;
        }
        Seeds *seeds = strcmp(argv[i], "--seeds") == 0   ? &random
                       : strcmp(argv[i], "--nasty") == 0 ? &nasty
                       : strcmp(argv[i], "--print") == 0 ? &print
                                                         : NULL;
        ok = seeds != NULL && readSeeds(argv[i + 1], seeds);
    }
    if (!ok) {
        fprintf(stderr, "usage: engines [--seeds A..B] [--nasty A..B] [--print SEED] [--scene FILE]\n");
        return 2;
    }
    if (print.wanted) {
        Node *tree = createRandomScene(print.first);
        printTree(tree);
        freeTree(tree);
        return 0;
    }
    Paths paths;
    paths.count = findEnginePaths(paths.names);
    printf("# paths:");
    for (size_t i = 0; i < paths.count; i++)
        printf(" %s", paths.names[i]);
    printf("\n");
    if (file != NULL)
        return !checkFile(file, &paths);
    int number = 0, failed = runSeeds(&random, "seeds", checkSeed, &paths, &number);
    failed += runSeeds(&nasty, "nasty scenes", checkNasty, &paths, &number);
    printf("1..%d\n", number);
    return failed > 0;
}
