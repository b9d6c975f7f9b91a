/* loaded_scene.c - scenes written in the test; see loaded_scene.h. */
#include "loaded_scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

Scene load(const char *yaml)
{
    Scene scene;
    Diagnostics diagnostics = {0};
    Status status = loadSceneFromText(yaml, strlen(yaml), &scene, &diagnostics);
    if (!statusIsOk(&status)) {
        Text text = {0};
        diagnosticsPrint(&diagnostics, "test", false, &text);
        fail_msg("%s\n%s\nin:\n%s", status.message, textString(&text), yaml);
    }
    assert_int_equal(diagnostics.errors, 0);
    diagnosticsFree(&diagnostics);
    return scene;
}

bool loads(const char *yaml)
{
    Scene scene;
    Diagnostics diagnostics = {0};
    Status status = loadSceneFromText(yaml, strlen(yaml), &scene, &diagnostics);
    assert_true(statusIsOk(&status) == (diagnostics.errors == 0));
    diagnosticsFree(&diagnostics);
    freeScene(&scene);
    return statusIsOk(&status);
}

void assertVector(Vector3D v, double x, double y, double z)
{
    if (!(v.x == x && v.y == y && v.z == z))
        fail_msg("(%g, %g, %g) is not (%g, %g, %g)", v.x, v.y, v.z, x, y, z);
}
