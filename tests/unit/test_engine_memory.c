/* Memory that runs out while a scene is compiled: whichever allocation fails, the result is an I/O error,
 * nothing crashes, nothing leaks. */
#include "engine/engine.h"
#include "failing_memory.h"
#include "loaded_scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

/* Everything that compiling looks at, of many materials. */
static Scene everything(void)
{
    Scene scene = load("objects:\n"
                       "  - mesh: {file: scenes/regress/star.obj}\n"
                       "  - cube: {center: [0, 0, -5], size: 1, casts_shadow: false}\n"
                       "  - plane: {point: [0, -1, 0], normal: [0, 1, 0]}\n"
                       "  - plane: {point: [0, -1, 0], normal: [0, 1, 0], transform: [scale: 2]}\n"
                       "  - sphere: {center: [0, 0, -5], radius: 1, material: {transmission: 0.5}}\n");
    for (int i = 0; i < 100; i++) {
        Material material = createMaterial(createColor((float)i, 0, 0), createColor(0, 0, 0), 1);
        addSphereToScene(&scene, createSphere(createVector(i, i % 7, -5), 0.5, material));
    }
    return scene;
}

static void everyAllocationMayFail(void **state)
{
    (void)state;
    if (!CAN_FAIL) {
        print_message("skipped: the allocator cannot be replaced here\n");
        skip();
    }
    Scene scene = everything();
    bool failed = true;
    long ioErrors = 0;
    for (long count = 0; failed; count++) {
        CompiledScene *compiled = NULL;
        long before = blocks;
        allowed = count;
        armed = true;
        Status status = compileScene(&scene, 1, &compiled);
        armed = false;
        failed = allowed == 0;
        if (!statusIsOk(&status) && (status.code != STATUS_IO || compiled != NULL))
            fail_msg("allocation %ld: code %d", count, status.code);
        ioErrors += status.code == STATUS_IO;
        freeCompiledScene(compiled);
        if (blocks != before)
            fail_msg("allocation %ld: %ld blocks leak", count, blocks - before);
    }
    assert_true(ioErrors > 15);
    freeScene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(everyAllocationMayFail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
