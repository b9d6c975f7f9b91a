/* A student's program, written from the handout alone: its exercises 03a, 03b and 04, with a Framebuffer
 * in place of the SDL surface and PNG files in place of a window. tests/suites/student.sh compiles it
 * against the library and checks its pictures. */
#include "colors.h"
#include "geometry.h"
#include "image/image.h"
#include "raytracer.h"
#include "shading.h"

/* Exercise 03a, 02, once more in the student's own words: each pixel, each light. */
static void myLambertRaytracing(Scene scene, Framebuffer *framebuffer)
{
    for (int y = 0; y < framebuffer->height; y++) {
        for (int x = 0; x < framebuffer->width; x++) {
            double pixel = 2 * tan(60.0 / 2 * 3.14159265358979 / 180) / framebuffer->height;
            double px = (x + 0.5 - framebuffer->width / 2.0) * pixel;
            double py = (framebuffer->height / 2.0 - y - 0.5) * pixel;
            Ray ray = createRay(createVector(0, 0, 0), normalize(createVector(px, py, -1)));
            Intersection intersection;
            Color3f color = createColor(0, 0, 0);
            if (throwRayThroughScene(ray, scene, &intersection)) {
                for (size_t i = 0; i < scene.lightCount; i++) {
                    Vector3D il = subVectors(scene.lights[i].position, intersection.position);
                    double cosine = dot(intersection.normal, normalize(il));
                    if (cosine > 0) {
                        Color3f ic = intersection.material.diffuse;
                        Color3f lc = scene.lights[i].color;
                        color =
                            addColors(color, scaleColor(multColors(ic, lc), cosine / (norm(il) * norm(il))));
                    }
                }
            }
            PutPixel(framebuffer, x, y, clampColor(color));
        }
    }
}

int main(void)
{
    Framebuffer *framebuffer = createFramebuffer(641, 481);

    /* Exercise 03a */
    Material red = createMaterial(createColor(1, 0, 0), createColor(0, 0, 0), 1);
    Scene scene = createScene();
    addSphereToScene(&scene, createSphere(createVector(0, 0, -5), 1.5, red));
    addLightToScene(&scene, createLight(createVector(0, 0, 0), createColor(10, 10, 10)));
    lambertRaytracing(scene, framebuffer);
    savePicture(framebuffer, "lambert.png");
    myLambertRaytracing(scene, framebuffer);
    savePicture(framebuffer, "my-lambert.png");

    /* Exercise 03b */
    Material shiny = createMaterial(createColor(1, 0, 0), createColor(0.5f, 0.5f, 0.5f), 32);
    Scene scene2 = createScene();
    addSphereToScene(&scene2, createSphere(createVector(0, 0, -5), 1.5, shiny));
    addLightToScene(&scene2, createLight(createVector(0, 0, 0), createColor(10, 10, 10)));
    phongRaytracing(scene2, framebuffer);
    savePicture(framebuffer, "phong.png");

    /* Exercise 04 */
    Material green = createMaterial(createColor(0, 1, 0), createColor(0, 0, 0), 1);
    Scene scene3 = createScene();
    addSphereToScene(&scene3, createSphere(createVector(0, 0, -5), 1.5, red));
    addSphereToScene(&scene3, createSphere(createVector(-1, 0, -3.5), 0.5, green));
    addLightToScene(&scene3, createLight(createVector(-3, 0, 1), createColor(5, 5, 5)));
    simpleRaytracing(scene3, framebuffer);
    savePicture(framebuffer, "shadow-simple.png");
    lambertRaytracing(scene3, framebuffer);
    savePicture(framebuffer, "shadow-lambert.png");
    return 0;
}
