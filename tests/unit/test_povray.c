/* Export and runner: what the .pov says and refuses to say, and a run that nothing outside can change
 * and that leaves nothing behind. Runs of the real POV-Ray are skipped where there is none. */
#define _GNU_SOURCE
#include "base/files.h"
#include "povray/export.h"
#include "povray/pov_faces.h"
#include "povray/pov_scale.h"
#include "povray/run.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

static const PovraySettings small = {.width = 64,
                                     .height = 48,
                                     .bitDepth = 16,
                                     .encoding = ENCODING_LINEAR,
                                     .samples = 1,
                                     .threads = 1,
                                     .timeoutSeconds = 60};

static Scene shinySphere(void)
{
    Scene scene = createScene();
    scene.image.width = 64;
    scene.image.height = 48;
    Material material = createMaterial(createColor(0.7f, 0.1f, 0), createColor(0.9f, 0, 0.3f), 20);
    addSphereToScene(&scene, createSphere(createVector(0.1, 0, -5), 1.5, material));
    addLightToScene(&scene, createLight(createVector(-3, 2, 1), createColor(15, 12, 10)));
    return scene;
}

static char *exported(const Scene *scene, const char *name)
{
    Text pov = {0};
    Status status = exportPov(scene, name, &pov);
    assert_int_equal(status.code, STATUS_OK);
    return pov.data;
}

static void numbersAreWrittenInFull(void **state)
{
    (void)state;
    Scene scene = shinySphere();
    scene.objects[0].sphere.center.x = 0.1 + 0.2;
    scene.background.bottom = createColor(1.0f / 3, 0, 0);
    char *pov = exported(&scene, "a.pov");
    assert_non_null(strstr(pov, "sphere { <0.30000000000000004, 0, -5>, 1.5"));
    assert_non_null(strstr(pov, "background { rgb <0.3333333432674408, 0, 0> }"));
    assert_non_null(strstr(pov, "rgb <15, 12, 10>*K"));
    free(pov);
    freeScene(&scene);
}

static void theFirstCommentIsTheCommand(void **state)
{
    (void)state;
    Scene scene = shinySphere();
    char *pov = exported(&scene, "scenes/04-phong.pov");
    const char *expected = "// povray +I04-phong.pov +O04-phong.png +W64 +H48 +FN8 File_Gamma=srgb -A -D\n";
    assert_memory_equal(pov, expected, strlen(expected));
    free(pov);
    scene.image.bitDepth = 16;
    scene.image.encoding = ENCODING_LINEAR;
    pov = exported(&scene, "x");
    expected = "// povray +Ix +Ox.png +W64 +H48 +FN16 File_Gamma=1.0 -A -D\n";
    assert_memory_equal(pov, expected, strlen(expected));
    free(pov);
    pov = exported(&scene, "l'\xC3\xA9t\xC3\xA9 1.pov");
    expected = "// povray +I/dev/stdin +O- +W64 +H48 +FN16 File_Gamma=1.0 -A -D"
               " <'l'\\''\xC3\xA9t\xC3\xA9 1.pov' >'l'\\''\xC3\xA9t\xC3\xA9 1'.png\n";
    assert_memory_equal(pov, expected, strlen(expected));
    free(pov);
    freeScene(&scene);
}

static void aNameCannotBecomeCode(void **state)
{
    (void)state;
    Scene scene = shinySphere();
    const char *names[] = {"x\n#write(F,1)\n.pov", "x\r#error",       "*/ sphere{",
                           "$(rm -rf ~).pov",      "-Ifoo;reboot",    "\xE2\x80\xA8.pov",
                           "\xC2\x85.pov",         "\x1B[2J\xE9.pov", ""};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char *pov = exported(&scene, names[i]);
        char *end = strchr(pov, '\n');
        assert_memory_equal(end, "\n// Written by", 14);
        *end = '\0';
        assert_null(strpbrk(pov, "\r\f\v\x1B\xE2"));
        assert_null(strstr(pov, "\xC2\x85"));
        /* What is not harmless stands in the shell's quotes. */
        size_t bare = strspn(pov, " +=-_./ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789");
        if (pov[bare] != '\0')
            assert_memory_equal(pov + bare, "<'", 2);
        assert_null(strstr(pov, "+I-"));
        free(pov);
    }
    freeScene(&scene);
}

static void refusesWhatItCannotSay(void **state)
{
    (void)state;
    Scene scene = shinySphere();
    Text pov = {0};
    scene.render.shadowBias = 0.001;
    Status status = exportPov(&scene, "a", &pov);
    assert_int_equal(status.code, STATUS_INEXPRESSIBLE);
    assert_non_null(strstr(status.message, "shadow_bias"));

    scene.render.shadowBias = NAN;
    scene.render.model = MODEL_SIMPLE;
    addLightToScene(&scene, createLight(createVector(0, 5, 0), createColor(1, 1, 1)));
    status = exportPov(&scene, "a", &pov);
    assert_int_equal(status.code, STATUS_INEXPRESSIBLE);
    scene.render.shadows = false;
    status = exportPov(&scene, "a", &pov);
    assert_int_equal(status.code, STATUS_OK);

    scene.render.model = MODEL_PHONG;
    scene.lights[1].color.g = 1e30f;
    status = exportPov(&scene, "a", &pov);
    assert_int_equal(status.code, STATUS_INEXPRESSIBLE);
    assert_non_null(strstr(status.message, "light 2"));

    /* A picture with transparency, also deep in a solid: it would make the surface transparent. */
    scene.lights[1].color.g = 1;
    const Color3f texel = {1, 0, 0};
    Pattern picture = {.kind = PATTERN_IMAGE,
                       .size = 1,
                       .width = 1,
                       .height = 1,
                       .texels = &texel,
                       .path = "/tiles.png",
                       .hasAlpha = true};
    Object *part = calloc(1, sizeof *part);
    *part = scene.objects[0];
    part->material.pattern = &picture;
    addObjectToScene(&scene, (Object){.kind = SHAPE_CSG, .csg = {.parts = part, .partCount = 1}});
    status = exportPov(&scene, "a", &pov);
    assert_int_equal(status.code, STATUS_INEXPRESSIBLE);
    assert_non_null(strstr(status.message, "tiles.png"));
    picture.hasAlpha = false;
    status = exportPov(&scene, "a", &pov);
    assert_int_equal(status.code, STATUS_OK);
    textFree(&pov);
    freeScene(&scene);
}

static Object block(double minX, double minY, double maxX, double maxY)
{
    return (Object){
        .kind = SHAPE_BOX,
        .box = createBox(createVector(minX, minY, -1), createVector(maxX, maxY, 1), defaultMaterial())};
}

static Object column(double bottom, double top, double radius)
{
    return (Object){.kind = SHAPE_CONE,
                    .cone = createCylinder(createVector(0, bottom, 0), createVector(0, top, 0), radius, false,
                                           defaultMaterial())};
}

/* The part as it is written; parts: of one solid. */
static Object written(CsgOperation operation, Object *parts, size_t count, size_t number)
{
    Object solid = {.kind = SHAPE_CSG, .csg = {.operation = operation, .parts = parts, .partCount = count}};
    PovPart place = {&solid, number, NULL};
    return separatedPart(&parts[number], &place);
}

/* Whether a was moved from b by a little more than nothing. */
static bool isAbove(double a, double b)
{
    return a > b && a - b < 1e-6;
}

static void facesThatCoincideAreMovedApart(void **state)
{
    (void)state;
    /* A hole as deep as its block goes through; the block stays as it is. */
    Object hole[] = {block(-1, 0, 1, 1), column(0, 1, 0.5)};
    Object part = written(CSG_DIFFERENCE, hole, 2, 1);
    assert_true(isAbove(part.cone.top.y, 1) && isAbove(0, part.cone.base.y));
    assert_true(part.cone.topRadius == 0.5 && part.cone.baseRadius == 0.5);
    part = written(CSG_DIFFERENCE, hole, 2, 0);
    assert_true(part.box.min.y == 0 && part.box.max.y == 1);
    /* A blind one opens where it ends in the face, and nowhere else. */
    Object corner[] = {block(-1, 0, 1, 1), block(0, 0.5, 1, 1)};
    part = written(CSG_DIFFERENCE, corner, 2, 1);
    assert_true(isAbove(part.box.max.x, 1) && isAbove(part.box.max.y, 1) && isAbove(part.box.max.z, 1));
    assert_true(part.box.min.x == 0 && part.box.min.y == 0.5 && isAbove(-1, part.box.min.z));
    /* One that only touches leaves the block its face; a cube is one too. */
    Object touching[] = {
        block(-1, 0, 1, 1),
        {.kind = SHAPE_CUBE, .cube = createCube(createVector(0, 2, 0), 2, defaultMaterial())}};
    part = written(CSG_DIFFERENCE, touching, 2, 1);
    assert_true(part.kind == SHAPE_BOX && isAbove(part.box.min.y, 1) && part.box.max.y == 3);
    /* Of the same block twice the last stays. */
    Object twice[] = {block(-1, 0, 1, 1), block(-1, 0, 1, 1)};
    part = written(CSG_INTERSECTION, twice, 2, 0);
    assert_true(isAbove(part.box.max.y, 1) && isAbove(-1, part.box.min.x));
    part = written(CSG_INTERSECTION, twice, 2, 1);
    assert_true(part.box.max.y == 1 && part.box.min.x == -1);
    /* What stands on the other goes into it; across it, it is lower. Side by side they are of one height. */
    Object stacked[] = {block(-1, 0, 1, 1), column(1, 2, 0.5)};
    part = written(CSG_UNION, stacked, 2, 1);
    assert_true(isAbove(1, part.cone.base.y) && part.cone.top.y == 2);
    Object cross[] = {block(-2, 0, 2, 1), block(-1, 0, 1, 1)};
    cross[1].box.max.z = 2;
    part = written(CSG_UNION, cross, 2, 1);
    assert_true(isAbove(1, part.box.max.y) && part.box.max.z == 2);
    Object row[] = {block(-1, 0, 0, 1), block(0, 0, 1, 1)};
    part = written(CSG_UNION, row, 2, 1);
    assert_true(isAbove(0, part.box.min.x) && part.box.max.y == 1 && part.box.max.x == 1);
    /* Transformed alike, and as a part of a part. */
    Matrix rotation = rotationMatrix(createVector(1, 2, 3), 30);
    Transform turned;
    assert_true(createTransform(&rotation, &turned));
    hole[0].transform = hole[1].transform = &turned;
    part = written(CSG_DIFFERENCE, hole, 2, 1);
    assert_true(isAbove(part.cone.top.y, 1) && isAbove(0, part.cone.base.y));
    Object holes = {.kind = SHAPE_CSG, .csg = {.operation = CSG_UNION, .parts = &hole[1], .partCount = 1}};
    Object outer[] = {hole[0], holes};
    Object solid = {.kind = SHAPE_CSG, .csg = {.operation = CSG_DIFFERENCE, .parts = outer, .partCount = 2}};
    PovPart outerPlace = {&solid, 1, NULL}, innerPlace = {&outer[1], 0, &outerPlace};
    part = separatedPart(&hole[1], &innerPlace);
    assert_true(isAbove(part.cone.top.y, 1) && isAbove(0, part.cone.base.y));
}

static void sizesThatPovraySeesWell(void **state)
{
    (void)state;
    Scene scene = shinySphere();
    assert_true(povScale(&scene) == 1);
    /* A small part makes the scene larger, by a power of two; a huge one limits that. */
    addSphereToScene(&scene, createSphere(createVector(0, 0, -4), 0.001, defaultMaterial()));
    double scale = povScale(&scene);
    assert_true(scale * 0.002 >= 1 && scale * 0.002 < 2);
    assert_true(log2(scale) == floor(log2(scale)));
    addSphereToScene(&scene, createSphere(createVector(0, -1e6, 0), 1e6, defaultMaterial()));
    assert_true(povScale(&scene) * 2e6 <= 0x1p22);
    freeScene(&scene);
    Scene empty = createScene();
    assert_true(povScale(&empty) == 1);
}

/* What the camera stands on, what it looks along and where the lights are. */
static void sizesForTheCamera(void **state)
{
    (void)state;
    /* A camera a hair from a surface would look through it; the kind of surface and the side do not matter.
     */
    for (int kind = 0; kind < 4; kind++) {
        Scene close = createScene();
        Vector3D corner = createVector(-1e-6, -1e-6, -2);
        if (kind == 0)
            addSphereToScene(&close, createSphere(createVector(2, -2, 1), 3 - 1e-6, defaultMaterial()));
        else if (kind == 1)
            addPlaneToScene(&close,
                            createPlane(createVector(1e-6, 0, 0), createVector(3, 1, -2), defaultMaterial()));
        else if (kind == 2)
            addBoxToScene(&close, createBox(createVector(-5, -4, -3), corner, defaultMaterial()));
        else
            addBoxToScene(&close,
                          createBox(createVector(-5, -4, -3), createVector(1e-6, 1, 1), defaultMaterial()));
        close.camera.position = kind == 2 ? createVector(0, 0, -2.5) : createVector(0, 0, 0);
        double scale = povScale(&close);
        assert_true(1e-6 * scale >= 1e-2);
        assert_true(scale <= 0x1p22);
        freeScene(&close);
    }

    /* Nor is a plane to end before the horizon of the picture for the sake of a thin block. */
    Scene flat = createScene();
    flat.image.width = 96;
    flat.image.height = 72;
    flat.camera.position = createVector(0, 1, 0);
    addPlaneToScene(&flat, createPlane(createVector(0, 0, 0), createVector(0, 1, 0), defaultMaterial()));
    assert_true(povScale(&flat) == 1);
    addBoxToScene(&flat, createBox(createVector(-1, 0, -3), createVector(1, 1e-9, -2), defaultMaterial()));
    double horizon = 72 / (2 * tan(30 * 3.14159265358979 / 180) * 0.5); /* half a pixel below it */
    assert_true(povScale(&flat) * horizon <= 0x1p22);
    assert_true(povScale(&flat) > 0x1p13);
    freeScene(&flat);

    /* In a room, or beside a wall, a light outside must not leak in along the edges. */
    for (int kind = 0; kind < 2; kind++) {
        Scene room = createScene();
        if (kind == 0)
            addBoxToScene(&room,
                          createBox(createVector(-4, -3, -9), createVector(4, 3, 2), defaultMaterial()));
        else
            addPlaneToScene(&room,
                            createPlane(createVector(4, 0, 0), createVector(1, 0, 0), defaultMaterial()));
        addLightToScene(&room, createLight(createVector(1, 2, -3), createColor(1, 1, 1)));
        assert_true(povScale(&room) == 1);
        addLightToScene(&room, createLight(createVector(5, 2, -3), createColor(1, 1, 1)));
        assert_true(povScale(&room) >= 1024);
        room.render.shadows = false;
        assert_true(povScale(&room) == 1);
        freeScene(&room);
    }

    /* A far light changes nothing; of a globe only what is before the horizon counts. */
    Scene globe = shinySphere();
    addLightToScene(&globe, createLight(createVector(1e9, 1e9, 0), createColor(1, 1, 1)));
    assert_true(povScale(&globe) == 1);
    addSphereToScene(&globe, createSphere(createVector(0, -1e11 - 2, 0), 1e11, defaultMaterial()));
    assert_true(povScale(&globe) >= 0.25);
    freeScene(&globe);
}

/* What is left in a folder but . and .. */
static int entriesIn(const char *path)
{
    DIR *folder = opendir(path);
    assert_non_null(folder);
    int count = -2;
    while (readdir(folder) != NULL)
        count++;
    closedir(folder);
    return count;
}

/* Private TMPDIR and current folder with a hostile povray.ini; its path, for assertNothingLeft. */
static char *hostileSurroundings(void)
{
    char *folder = NULL;
    Status status = makeTemporaryFolder(&folder);
    assert_true(statusIsOk(&status));
    setenv("TMPDIR", folder, 1);
    return folder;
}

static void assertNothingLeft(char *folder, int expected)
{
    assert_int_equal(entriesIn(folder), expected);
    unsetenv("TMPDIR");
    removeFolder(folder);
    free(folder);
}

/* A program of our own called povray, first on the PATH. */
static char *fakePovray(const char *script)
{
    char *folder = NULL;
    Status status = makeTemporaryFolder(&folder);
    assert_true(statusIsOk(&status));
    char path[512];
    snprintf(path, sizeof path, "%s/povray", folder);
    status = writeWholeFile(path, script, strlen(script));
    assert_true(statusIsOk(&status));
    assert_int_equal(chmod(path, 0755), 0);
    setenv("PATH", folder, 1);
    return folder;
}

static void missingPovraySaysHowToInstallIt(void **state)
{
    (void)state;
    char *path = strdup(getenv("PATH"));
    setenv("PATH", "/nonexistent", 1);
    Image image;
    Status status = runPovray("", &small, &image);
    assert_int_equal(status.code, STATUS_POVRAY);
    assert_non_null(strstr(status.message, "apt-get install povray"));
    setenv("PATH", path, 1);
    free(path);
}

/* Whether the process is there and not only waiting to be reaped by whoever inherited it. */
static bool isRunning(int pid)
{
    char path[64], *text = NULL;
    size_t length;
    snprintf(path, sizeof path, "/proc/%d/stat", pid);
    Status status = readWholeFile(path, 1000, &text, &length);
    bool running = statusIsOk(&status) && strstr(text, ") Z ") == NULL;
    free(text);
    return running;
}

static void failureAndTimeoutAreTold(void **state)
{
    (void)state;
    char *path = strdup(getenv("PATH"));
    char *surroundings = hostileSurroundings();
    char *fake =
        fakePovray("#!/bin/sh\necho banner\necho \"File 'scene.pov' line 3: Parse Error: $HOME no.\" >&2\n"
                   "exit 3\n");
    Image image;
    Status status = runPovray("", &small, &image);
    assert_int_equal(status.code, STATUS_POVRAY);
    assert_non_null(strstr(status.message, "exit code 3"));
    assert_non_null(strstr(status.message, "line 3: Parse Error"));
    assert_null(strstr(status.message, "banner"));
    removeFolder(fake);
    free(fake);

    fake = fakePovray("#!/bin/sh\nkill -SEGV $$\n");
    status = runPovray("", &small, &image);
    assert_int_equal(status.code, STATUS_POVRAY);
    assert_non_null(strstr(status.message, "signal 11"));
    removeFolder(fake);
    free(fake);

    fake = fakePovray("#!/bin/sh\nexit 0\n");
    status = runPovray("", &small, &image);
    assert_int_equal(status.code, STATUS_POVRAY);
    assert_non_null(strstr(status.message, "no picture"));
    removeFolder(fake);
    free(fake);

    /* A picture that is none, or another one, is POV-Ray's failure and names no file of ours. */
    fake = fakePovray("#!/bin/sh\necho no >picture.png\n");
    status = runPovray("", &small, &image);
    assert_int_equal(status.code, STATUS_POVRAY);
    assert_non_null(strstr(status.message, "cannot be read"));
    assert_null(strstr(status.message, "picture.png"));
    removeFolder(fake);
    free(fake);

    fake = fakePovray("#!/bin/sh\nexec /bin/cat ${0%/*}/other.png >picture.png\n");
    char otherPath[512];
    snprintf(otherPath, sizeof otherPath, "%s/other.png", fake);
    Image other;
    status = createImage(small.width + 1, small.height, small.bitDepth, small.encoding, &other);
    assert_true(statusIsOk(&status));
    status = writePng(otherPath, &other, 1);
    assert_true(statusIsOk(&status));
    freeImage(&other);
    status = runPovray("", &small, &image);
    assert_int_equal(status.code, STATUS_POVRAY);
    assert_non_null(strstr(status.message, "65 x"));
    removeFolder(fake);
    free(fake);

    fake = fakePovray("no program\n");
    status = runPovray("", &small, &image);
    assert_int_equal(status.code, STATUS_POVRAY);
    assert_non_null(strstr(status.message, "cannot start"));
    removeFolder(fake);
    free(fake);

    /* What is said without end does not fill the disk. */
    fake = fakePovray("#!/bin/sh\nexec /usr/bin/yes\n");
    status = runPovray("", &small, &image);
    assert_int_equal(status.code, STATUS_POVRAY);
    assert_non_null(strstr(status.message, "64 MB"));
    removeFolder(fake);
    free(fake);

    /* The program and what it started are ended, whether it takes too long or ends by itself. */
    for (int i = 0; i < 2; i++) {
        fake = fakePovray(i == 0 ? "#!/bin/sh\n/bin/sleep 60 &\necho $! > ${0%/*}/pid\nwait\n"
                                 : "#!/bin/sh\n/bin/sleep 60 &\necho $! > ${0%/*}/pid\nexit 1\n");
        PovraySettings hasty = small;
        hasty.timeoutSeconds = i == 0 ? 0.2 : 20;
        status = runPovray("", &hasty, &image);
        assert_int_equal(status.code, STATUS_POVRAY);
        assert_non_null(strstr(status.message, i == 0 ? "longer than" : "exit code 1"));
        char pidPath[512], *pid = NULL;
        size_t length;
        snprintf(pidPath, sizeof pidPath, "%s/pid", fake);
        status = readWholeFile(pidPath, 100, &pid, &length);
        assert_true(statusIsOk(&status));
        bool alive = true;
        for (int j = 0; j < 200 && alive; j++) {
            usleep(10000);
            alive = isRunning(atoi(pid));
        }
        assert_false(alive);
        free(pid);
        removeFolder(fake);
        free(fake);
    }
    setenv("PATH", path, 1);
    free(path);
    assertNothingLeft(surroundings, 0);
}

static void skipWithoutPovray(void)
{
    Status status = findPovray();
    if (!statusIsOk(&status)) {
        print_message("skipped: %s\n", status.message);
        skip();
    }
}

static void theRealOneDrawsOurPicture(void **state)
{
    (void)state;
    skipWithoutPovray();
    char *surroundings = hostileSurroundings();
    char here[4096];
    assert_non_null(getcwd(here, sizeof here));
    /* Configurations that would change size, samples and gamma, where POV-Ray looks for them. */
    assert_int_equal(chdir(surroundings), 0);
    const char *ini = "Quality=1\nEnd_Column=20\nWidth=10\nAntialias=On\nFile_Gamma=2.2\n";
    Status status = writeWholeFile("povray.ini", ini, strlen(ini));
    assert_true(statusIsOk(&status));
    status = makeFolders(".povray/3.7");
    assert_true(statusIsOk(&status));
    status = writeWholeFile(".povray/3.7/povray.ini", ini, strlen(ini));
    assert_true(statusIsOk(&status));
    char named[4200];
    snprintf(named, sizeof named, "%s/povray.ini", surroundings);
    setenv("POVINI", named, 1);
    setenv("HOME", surroundings, 1);

    Scene scene = shinySphere();
    char *pov = exported(&scene, "a");
    Image theirs, ours;
    status = runPovray(pov, &small, &theirs);
    assert_int_equal(chdir(here), 0);
    assert_int_equal(status.code, STATUS_OK);
    assert_int_equal(theirs.width, 64);
    assert_int_equal(theirs.bitDepth, 16);
    assert_int_equal(theirs.encoding, ENCODING_LINEAR);

    Framebuffer *framebuffer = createFramebuffer(64, 48);
    RenderOptions options = {.threads = 1};
    renderReference(&scene, framebuffer, &options, NULL);
    status = imageFromFramebuffer(framebuffer, 16, ENCODING_LINEAR, 1, &ours);
    assert_int_equal(status.code, STATUS_OK);
    assert_memory_equal(ours.samples, theirs.samples, 64 * 48 * 3 * sizeof(uint16_t));
    unsigned brightest = 0;
    for (size_t i = 0; i < 64 * 48 * 3; i++)
        brightest = ours.samples[i] > brightest ? ours.samples[i] : brightest;
    assert_true(brightest > 20000);

    freeImage(&ours);
    freeImage(&theirs);
    freeFramebuffer(framebuffer);
    free(pov);
    freeScene(&scene);
    unsetenv("POVINI");
    assertNothingLeft(surroundings, 2);
}

static void theRealOnesErrorIsQuoted(void **state)
{
    (void)state;
    skipWithoutPovray();
    char *surroundings = hostileSurroundings();
    Image image;
    Status status = runPovray("sphere { <0,0,0> 1 nonsense }\n", &small, &image);
    assert_int_equal(status.code, STATUS_POVRAY);
    assert_non_null(strstr(status.message, "line 1: Parse Error"));
    assertNothingLeft(surroundings, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbersAreWrittenInFull),
        cmocka_unit_test(theFirstCommentIsTheCommand),
        cmocka_unit_test(aNameCannotBecomeCode),
        cmocka_unit_test(refusesWhatItCannotSay),
        cmocka_unit_test(facesThatCoincideAreMovedApart),
        cmocka_unit_test(sizesThatPovraySeesWell),
        cmocka_unit_test(sizesForTheCamera),
        cmocka_unit_test(missingPovraySaysHowToInstallIt),
        cmocka_unit_test(failureAndTimeoutAreTold),
        cmocka_unit_test(theRealOneDrawsOurPicture),
        cmocka_unit_test(theRealOnesErrorIsQuoted),
    };
    return cmocka_run_group_tests_name("povray", tests, NULL, NULL);
}
