/* scene_bytes.c - prints how many bytes the CompiledScene of a scene takes.
 *
 *   scene_bytes SCENE.yaml
 */
#include "engine/engine.h"
#include "scene/load.h"

#include <stdio.h>

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "Usage: scene_bytes SCENE.yaml\n");
        return 2;
    }
    Scene scene;
    Diagnostics diagnostics = {0};
    CompiledScene *compiled = NULL;
    Status status = loadScene(argv[1], &scene, &diagnostics);
    diagnosticsFree(&diagnostics);
    if (statusIsOk(&status)) {
        status = compileScene(&scene, 2, &compiled);
        if (statusIsOk(&status))
            printf("%zu\n", compiledSceneBytes(compiled));
        freeCompiledScene(compiled);
        freeScene(&scene);
    }
    if (!statusIsOk(&status))
        fprintf(stderr, "scene_bytes: %s: %s\n", argv[1], status.message);
    return statusIsOk(&status) ? 0 : 1;
}
