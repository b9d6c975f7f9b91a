/* Large scenes: what makes them quick to read (a thread that parses ahead, rows kept as numbers, numbers read
 * by a short way, room made at once) changes nothing else. Here each is held against the plain way. */
#include "base/cancel.h"
#include "base/files.h"
#include "base/text.h"
#include "loaded_scene.h"

#include <glob.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

/* ---- Numbers ---- */

static void assertSameNumber(const char *text)
{
    char *expectedEnd, *end;
    double expected = strtod(text, &expectedEnd); /* the tests run in the C locale */
    double value = parseDouble(text, &end);
    if (memcmp(&value, &expected, sizeof value) != 0 || end != expectedEnd)
        fail_msg("'%s' is read as %.17g, %td characters, not %.17g, %td", text, value, end - text, expected,
                 expectedEnd - text);
    const char *shortEnd;
    if (parseShortDouble(text, &shortEnd, &value) &&
        (memcmp(&value, &expected, sizeof value) != 0 || shortEnd != expectedEnd))
        fail_msg("'%s' is read as %.17g by the short way", text, value);
}

static void numbersAreThoseOfStrtod(void **state)
{
    (void)state;
    static const char *const special[] = {"",
                                          "-",
                                          ".",
                                          "+.",
                                          "-.e5",
                                          "e5",
                                          "0",
                                          "-0",
                                          "+0",
                                          "-0.0e5",
                                          "1.",
                                          ".5",
                                          "-.5e-3",
                                          "1e",
                                          "1e+",
                                          "1e5x",
                                          "1.5.5",
                                          "0x10",
                                          "0X1p3",
                                          "-0x10",
                                          "inf",
                                          "nan",
                                          "-inf",
                                          " 1",
                                          "1 ",
                                          "00001.5",
                                          "0.000000000000000000001",
                                          "9007199254740992",
                                          "9007199254740993",
                                          "9007199254740991e22",
                                          "9007199254740993e1",
                                          "1e22",
                                          "1e23",
                                          "1e-22",
                                          "1e-23",
                                          "123456789012345678e-25",
                                          "18446744073709551616",
                                          "184467440737095516160",
                                          "18446744073709551616.5",
                                          "0.18446744073709551616",
                                          "36893488147419103232",
                                          "1e400",
                                          "-1e400",
                                          "1e-400",
                                          "1e99999999999999999999",
                                          "1e-99999999999999999999",
                                          "0e99999999999999999999",
                                          "2.2250738585072011e-308",
                                          "0.1e1",
                                          "1000000000000000000000000",
                                          "3.14159265358979323846264338327950288"};
    for (size_t i = 0; i < sizeof special / sizeof *special; i++)
        assertSameNumber(special[i]);

    /* Random ones, of all lengths, most of a kind that scenes have. */
    uint64_t random = 1;
    for (int i = 0; i < 200000; i++) {
        char text[80];
        int length = 0;
        int lengths[3]; /* of the digits before and behind the point, and of the exponent */
        for (int part = 0; part < 3; part++) {
            random = random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
            lengths[part] = (int)(random >> 33) % (part == 2 ? 4 : 12);
        }
        if (random >> 63)
            text[length++] = '-';
        for (int part = 0; part < 3; part++) {
            if (part == 1)
                text[length++] = '.';
            if (part == 2 && lengths[2] > 0)
                length += sprintf(text + length, random >> 62 & 1 ? "e-" : "e");
            for (int j = 0; j < lengths[part] && (part < 2 || j < 2); j++) {
                random = random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
                text[length++] = (char)('0' + (random >> 33) % 10);
            }
        }
        text[length] = '\0';
        assertSameNumber(text);
    }
}

/* ---- Parsing ahead ---- */

/* As many bytes of comments as make a thread of its own worth while. */
enum {
    PADDING_LINES = 8000
};
static const char PADDING[] = "# a line that says nothing, as there are some in any file\n";

/* The text behind as many lines of comments. */
static char *padText(const char *text, size_t length, size_t *paddedLength)
{
    size_t padding = PADDING_LINES * (sizeof PADDING - 1);
    char *padded = malloc(padding + length + 1);
    assert_non_null(padded);
    for (size_t i = 0; i < PADDING_LINES; i++)
        memcpy(padded + i * (sizeof PADDING - 1), PADDING, sizeof PADDING - 1);
    memcpy(padded + padding, text, length);
    *paddedLength = padding + length;
    return padded;
}

static Diagnostics diagnose(const char *text, size_t length, Status *status)
{
    Scene scene;
    Diagnostics diagnostics = {0};
    *status = loadSceneFromText(text, length, &scene, &diagnostics);
    freeScene(&scene);
    return diagnostics;
}

/* Behind many lines of comments a scene has the same errors and warnings, so many lines further down. */
static void longFilesSayTheSame(void **state)
{
    (void)state;
    glob_t files;
    assert_int_equal(glob("scenes/bad/*.yaml", 0, NULL, &files), 0);
    size_t compared = 0;
    for (size_t i = 0; i < files.gl_pathc; i++) {
        char *text;
        size_t length, paddedLength;
        Status status = readWholeFile(files.gl_pathv[i], 1 << 24, &text, &length), paddedStatus;
        assert_true(statusIsOk(&status));
        Diagnostics plain = diagnose(text, length, &status);
        char *padded = padText(text, length, &paddedLength);
        Diagnostics behind = diagnose(padded, paddedLength, &paddedStatus);
        free(padded);

        /* What has no place is said of the first line; marks of the encoding count only there. */
        bool isMarked = length >= 2 && (unsigned char)text[0] >= 0xEF;
        if (!isMarked) {
            assert_int_equal(paddedStatus.code, status.code);
            if (behind.errors != plain.errors || behind.count != plain.count)
                fail_msg("%s: %zu errors, not %zu", files.gl_pathv[i], behind.errors, plain.errors);
            for (size_t j = 0; j < plain.count; j++) {
                const Diagnostic *a = &plain.items[j], *b = &behind.items[j];
                bool isSame = a->column == b->column && a->width == b->width &&
                              (a->line + PADDING_LINES == b->line || b->line == 1) &&
                              (strcmp(a->message, b->message) == 0 || strstr(a->message, " line ") != NULL);
                if (!isSame)
                    fail_msg("%s:%d: %s\nbut %d: %s", files.gl_pathv[i], a->line, a->message, b->line,
                             b->message);
            }
            compared++;
        }
        diagnosticsFree(&plain);
        diagnosticsFree(&behind);
        free(text);
    }
    globfree(&files);
    assert_true(compared > 100);
}

/* Brackets without end are refused at once, though libyaml would take minutes for them and parses ahead. */
static void deepNestingStopsParsing(void **state)
{
    (void)state;
    enum {
        LENGTH = 1 << 20
    };
    char *text = malloc(LENGTH);
    assert_non_null(text);
    memset(text, '[', LENGTH);
    Status status;
    Diagnostics diagnostics = diagnose(text, LENGTH, &status);
    assert_int_equal(diagnostics.errors, 1);
    assert_int_equal(diagnostics.items[0].column, 65);
    diagnosticsFree(&diagnostics);
    free(text);
}

/* As many spheres in rows; the row number odd is oddRow. */
static char *manyRows(size_t count, size_t odd, const char *oddRow, size_t *length)
{
    enum {
        LINE = 60
    };
    char *yaml = malloc(count * LINE + 300);
    assert_non_null(yaml);
    size_t used = (size_t)sprintf(yaml, "objects:\n- spheres:\n    data:\n");
    for (size_t i = 0; i < count; i++)
        used += i == odd ? (size_t)sprintf(yaml + used, "    - %s\n", oddRow)
                         : (size_t)sprintf(yaml + used, "    - [%zu.25, 0.5, -5, 0.125]\n", i);
    *length = used;
    return yaml;
}

static void askToStop(int number)
{
    (void)number;
    requestCancel();
}

/* A signal stops both threads. */
static void loadingStopsInTheMiddle(void **state)
{
    (void)state;
    size_t length;
    char *yaml = manyRows(400000, SIZE_MAX, "", &length);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        struct sigaction action = {.sa_handler = askToStop};
        sigaction(SIGALRM, &action, NULL);
        setitimer(ITIMER_REAL, &(struct itimerval){.it_value = {.tv_usec = 30000}}, NULL);
        Scene scene;
        Diagnostics diagnostics = {0};
        Status status = loadSceneFromText(yaml, length, &scene, &diagnostics);
        bool empty = scene.objects == NULL && scene.objectCount == 0 && diagnostics.errors == 0;
        diagnosticsFree(&diagnostics);
        free(yaml);
        _exit(status.code == STATUS_INTERRUPTED && empty ? 0 : 1);
    }
    int result;
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_true(WIFEXITED(result) && WEXITSTATUS(result) == 0);
    free(yaml);
}

/* ---- Rows ---- */

static void rowsComeInTheirOrder(void **state)
{
    (void)state;
    /* A row with an anchor, and one that is an alias, stay what they are among the others. */
    Scene scene = load("objects:\n"
                       "- spheres:\n"
                       "    data:\n"
                       "    - [1, 0, -5, 1]\n"
                       "    - &a [2, 0, -5, 1]\n"
                       "    - [3, 0, -5, 1]\n"
                       "    - *a\n"
                       "    - [4, &b 0, -5, 1]\n"
                       "    - [5, *b, -5, 1.0]\n"
                       "    - [6, 0, -5,\n"
                       "       0x1]\n"
                       "    transform: [translate: [0, 0, -1]]\n"
                       "- sphere: {center: [9, 0, -5], radius: 1}\n");
    static const double x[] = {1, 2, 3, 2, 4, 5, 6, 9};
    static const int lines[] = {4, 5, 6, 7, 8, 9, 10, 13};
    assert_int_equal(scene.objectCount, 8);
    for (size_t i = 0; i < 8; i++) {
        assert_true(scene.objects[i].sphere.center.x == x[i] && scene.objects[i].sphere.radius == 1);
        assert_int_equal(scene.objects[i].line, lines[i]);
        assert_true((scene.objects[i].transform != NULL) == (i < 7));
    }
    freeScene(&scene);
}

/* A list of rows that has a name can be used in other places, where its items are looked at one by one. */
static void namedRowsStayLists(void **state)
{
    (void)state;
    Scene scene = load("objects:\n"
                       "- spheres: {data: &rows [[1, 0, -5, 1], [2, 0, -5, 1]]}\n"
                       "- spheres: {data: *rows}\n"
                       "- spheres: &all {data: [[3, 0, -5, 1]]}\n"
                       "- spheres: *all\n");
    assert_int_equal(scene.objectCount, 6);
    assert_true(scene.objects[3].sphere.center.x == 2 && scene.objects[5].sphere.center.x == 3);
    freeScene(&scene);
    Status status;
    static const char other[] = "objects:\n"
                                "- spheres: {data: &rows [[1, 0, -5, 1], [2, 0, -5, 1], [3, 0, -5, 1]]}\n"
                                "- triangle: {vertices: *rows}\n";
    Diagnostics diagnostics = diagnose(other, sizeof other - 1, &status);
    assert_int_equal(diagnostics.errors, 3);
    assert_string_equal(diagnostics.items[0].message, "'vertices' needs 3 numbers [x, y, z], but has 4");
    diagnosticsFree(&diagnostics);
}

static void wrongRowsAreReported(void **state)
{
    (void)state;
    static const struct {
        const char *row, *message;
        int column;
    } wrong[] = {{"[1, 2, 3, 0]", "the r of 'data' must be above 0, but is 0", 17},
                 {"[1, 2, 3]", "'data' needs 4 numbers [x, y, z, r], but has 3", 7},
                 {"[1, 2, .inf, 1]", "the z of 'data' must be an ordinary number, but is .inf", 14},
                 {"[1, 1e999, 3, 1]", "the y of 'data' is too large: 1e999 is beyond 1.8e308", 11},
                 {"[1, 2, 3, '4']", "the r of 'data' must be a number, but is the text '4'", 17}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        size_t length;
        char *yaml = manyRows(20000, 15000, wrong[i].row, &length);
        Status status;
        Diagnostics diagnostics = diagnose(yaml, length, &status);
        assert_int_equal(diagnostics.errors, 1);
        assert_string_equal(diagnostics.items[0].message, wrong[i].message);
        assert_int_equal(diagnostics.items[0].line, 15004);
        assert_int_equal(diagnostics.items[0].column, wrong[i].column);
        diagnosticsFree(&diagnostics);
        free(yaml);
    }
}

/* Each leaf gets the material that it, or the nearest group, names. */
static void runsOfMaterialsEndWhereTheyShould(void **state)
{
    (void)state;
    Scene scene = load("objects:\n"
                       "- spheres: {material: a, data: [[0, 0, -5, 1], [1, 0, -5, 1]]}\n"
                       "- spheres: {material: b, data: [[2, 0, -5, 1]]}\n"
                       "- group: {material: a, objects: [sphere: {center: [3, 0, -5], radius: 1},"
                       " sphere: {center: [4, 0, -5], radius: 1, material: b},"
                       " sphere: {center: [5, 0, -5], radius: 1}]}\n"
                       "- sphere: {center: [6, 0, -5], radius: 1}\n"
                       "materials: {a: {diffuse: 0.25}, b: {diffuse: 0.5}}\n");
    static const float diffuse[] = {0.25F, 0.25F, 0.5F, 0.25F, 0.5F, 0.25F, 0.8F};
    assert_int_equal(scene.objectCount, 7);
    for (size_t i = 0; i < 7; i++)
        assert_true(scene.objects[i].material.diffuse.r == diffuse[i]);
    freeScene(&scene);
}

/* ---- Room ---- */

static void reservedRoomStays(void **state)
{
    (void)state;
    Scene scene = createScene();
    Sphere sphere = createSphere(createVector(0, 0, -5), 1, defaultMaterial());
    assert_true(addSphereToScene(&scene, sphere));
    assert_true(reserveObjectsInScene(&scene, 100000));
    const Object *before = scene.objects;
    for (int i = 0; i < 100000; i++)
        assert_true(addSphereToScene(&scene, sphere));
    assert_ptr_equal(scene.objects, before);
    assert_int_equal(scene.objectCount, 100001);
    assert_int_equal(scene.objectCapacity, 100001);
    assert_true(reserveObjectsInScene(&scene, 0));
    assert_false(reserveObjectsInScene(&scene, SIZE_MAX));
    assert_false(reserveObjectsInScene(&scene, SIZE_MAX / sizeof(Object)));
    assert_ptr_equal(scene.objects, before);
    assert_int_equal(scene.objectCount, 100001);
    freeScene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbersAreThoseOfStrtod), cmocka_unit_test(longFilesSayTheSame),
        cmocka_unit_test(deepNestingStopsParsing), cmocka_unit_test(loadingStopsInTheMiddle),
        cmocka_unit_test(rowsComeInTheirOrder),    cmocka_unit_test(namedRowsStayLists),
        cmocka_unit_test(wrongRowsAreReported),    cmocka_unit_test(runsOfMaterialsEndWhereTheyShould),
        cmocka_unit_test(reservedRoomStays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
