/* one_pixel.c - the colour along one ray; see one_pixel.h. */
#include "one_pixel.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

Color3f colorAlong(Scene *scene, Vector3D from, Vector3D to)
{
    scene->camera.position = from;
    scene->camera.direction = subVectors(to, from);
    scene->camera.up = fabs(scene->camera.direction.y) > 0.9 * norm(scene->camera.direction)
                           ? createVector(0, 0, -1)
                           : createVector(0, 1, 0);
    Framebuffer *framebuffer = createFramebuffer(1, 1);
    RenderOptions options = {.threads = 1};
    Status status = renderReference(scene, framebuffer, &options, NULL);
    assert_true(statusIsOk(&status));
    Color3f color = framebuffer->pixels[0];
    freeFramebuffer(framebuffer);
    return color;
}

void assertColorNear(Color3f color, double r, double g, double b)
{
    const double found[3] = {(double)color.r, (double)color.g, (double)color.b}, expected[3] = {r, g, b};
    for (int i = 0; i < 3; i++)
        if (!(fabs(found[i] - expected[i]) <= 2e-6 * fmax(1, expected[i])))
            fail_msg("channel %d is %.9g, not %.9g", i, found[i], expected[i]);
}
