/* load.c - the loader under libFuzzer: any bytes give a scene or errors, never a crash, a leak or a hang.
 *
 * Build and run, from the root of the repository, with clang:
 *     tests/fuzz/load.sh SECONDS
 * The seeds are the scenes of the repository.
 */
#include "scene/load.h"

#include <stdint.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t length);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t length)
{
    Scene scene;
    Diagnostics diagnostics = {0};
    Status status = loadSceneFromText((const char *)bytes, length, &scene, &diagnostics);
    Text text = {0};
    diagnosticsPrint(&diagnostics, "fuzz.yaml", false, &text);

    /* Errors and only errors make a scene invalid; what was read is within the format's ranges; nothing
     * that is printed can steer a terminal. */
    if ((status.code == STATUS_SCENE) != (diagnostics.errors > 0) || text.failed)
        abort();
    if (status.code == STATUS_OK)
        for (size_t i = 0; i < scene.objectCount; i++) {
            const Object *object = &scene.objects[i];
            if ((object->kind == SHAPE_SPHERE && !(object->sphere.radius > 0)) ||
                !(object->material.diffuse.r >= 0) || object->line < 1)
                abort();
        }
    for (const char *s = textString(&text); *s != '\0'; s++)
        if ((unsigned char)*s < 0x20 && *s != '\n' && *s != '\t')
            abort();
    textFree(&text);
    diagnosticsFree(&diagnostics);
    freeScene(&scene);
    return 0;
}
