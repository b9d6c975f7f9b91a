/* Memory that runs out: whichever allocation of loading a scene fails, the result is an I/O error or, where
 * only a hint is lost, the right one; nothing crashes, nothing leaks.
 *
 * Every allocation of the load fails once; see failing_memory.h.
 */
#include "base/files.h"
#include "failing_memory.h"
#include "scene/load.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Files, transforms, patterns, groups and solids, all right. */
static const char everything[] =
    "materials: {a: {pattern: {checker: {colors: [0, 1], transform: [scale: 2]}}}}\n"
    "lights: [{point: {position: [0, 9, 0], color: 9}}]\n"
    "objects:\n"
    "  - mesh: {file: scenes/bad/files/open.obj, transform: [translate: [0, 0, -5]]}\n"
    "  - spheres: {file: scenes/bad/files/spheres.txt, material: a}\n"
    "  - group:\n"
    "      material: a\n"
    "      objects:\n"
    "        - sphere: {center: [0, 0, -5], radius: 1, transform: [scale: 2]}\n"
    "        - difference:\n"
    "            objects:\n"
    "              - cube: {center: [0, 0, -5], size: 1}\n"
    "              - union: {objects: [{sphere: {center: [0, 0, -5], radius: 1}}]}\n";

static void everyAllocationMayFail(void **state)
{
    (void)state;
    static const char *const paths[] = {"scenes/course/04-phong.yaml",
                                        "scenes/bad/unknown-key.yaml",
                                        "scenes/bad/undefined-material.yaml",
                                        "scenes/bad/duplicate-anchor.yaml",
                                        "scenes/bad/merge-key.yaml",
                                        "scenes/bad/errors-before-broken-yaml.yaml",
                                        "scenes/bad/alias-cycle.yaml",
                                        "scenes/bad/missing-key.yaml",
                                        "scenes/bad/latin-1.yaml",
                                        "scenes/bad/group-material-undefined.yaml",
                                        "scenes/bad/part-without-inside.yaml",
                                        "scenes/bad/parts-with-different-ior.yaml",
                                        "scenes/bad/pattern-one-color.yaml",
                                        "scenes/bad/transform-step-wrong.yaml"};
    if (!CAN_FAIL) {
        print_message("skipped: the allocator cannot be replaced here\n");
        skip();
    }
    for (size_t i = 0; i <= sizeof paths / sizeof *paths; i++) {
        char *text;
        size_t length;
        const char *path = i < sizeof paths / sizeof *paths ? paths[i] : "everything";
        Status status;
        if (i < sizeof paths / sizeof *paths) {
            status = readWholeFile(path, 1 << 20, &text, &length);
            assert_true(statusIsOk(&status));
        } else {
            text = strdup(everything);
            length = strlen(everything);
        }
        Scene scene;
        Diagnostics diagnostics = {0};
        Status expected = loadSceneFromText(text, length, &scene, &diagnostics);
        diagnosticsFree(&diagnostics);
        freeScene(&scene);

        /* Let the first allocation fail, then the second, until all succeed. */
        bool failed = true;
        size_t ioErrors = 0;
        for (long count = 0; failed; count++) {
            long before = blocks;
            allowed = count;
            armed = true;
            status = loadSceneFromText(text, length, &scene, &diagnostics);
            armed = false;
            failed = allowed == 0;
            if (status.code != STATUS_IO && status.code != expected.code)
                fail_msg("%s, allocation %ld: code %d", path, count, status.code);
            ioErrors += status.code == STATUS_IO;
            diagnosticsFree(&diagnostics);
            freeScene(&scene);
            if (blocks != before)
                fail_msg("%s, allocation %ld: %ld blocks leak", path, count, blocks - before);
        }
        assert_true(ioErrors > 0);
        free(text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(everyAllocationMayFail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
