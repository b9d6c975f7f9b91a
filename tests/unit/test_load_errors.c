/* Errors: places are exact, all are found in one run, the right word is suggested, and nothing that a file
 * can hold crashes, hangs or takes more than linear time. What the messages say is checked word by word by
 * the scenes in scenes/bad (test_load_files.c).
 */
#include "scene/load.h"
#include "scene/suggest.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

static Diagnostics loadBytes(const char *yaml, size_t length)
{
    /* A copy of just that length, so that a sanitizer sees a byte read too far. */
    char *copy = malloc(length > 0 ? length : 1);
    assert_non_null(copy);
    memcpy(copy, yaml, length);
    Scene scene;
    Diagnostics diagnostics = {0};
    Status status = loadSceneFromText(copy, length, &scene, &diagnostics);
    free(copy);

    /* What must hold whatever the bytes are. */
    assert_true(status.code == STATUS_OK || status.code == STATUS_SCENE);
    assert_true((status.code == STATUS_SCENE) == (diagnostics.errors > 0));
    assert_true(diagnostics.count <= diagnostics.errors + diagnostics.warnings);
    for (size_t i = 0; i < diagnostics.count; i++) {
        const Diagnostic *item = &diagnostics.items[i];
        assert_true(item->line >= 1 && item->column >= 1 && item->width >= 1);
        assert_true(item->message != NULL && item->message[0] != '\0');
        assert_true(item->sourceOffset >= 0 && item->sourceOffset < item->column);
        assert_true(i == 0 || item[-1].line < item->line ||
                    (item[-1].line == item->line && item[-1].column <= item->column));
    }
    freeScene(&scene);
    return diagnostics;
}

static Diagnostics load(const char *yaml)
{
    return loadBytes(yaml, strlen(yaml));
}

static void assertError(const Diagnostics *diagnostics, size_t number, int line, int column,
                        const char *message)
{
    assert_true(number < diagnostics->count);
    const Diagnostic *item = &diagnostics->items[number];
    assert_int_equal(item->severity, SEVERITY_ERROR);
    assert_string_equal(item->message, message);
    assert_int_equal(item->line, line);
    assert_int_equal(item->column, column);
}

static char *repeat(const char *piece, size_t count, size_t *length)
{
    size_t pieceLength = strlen(piece);
    char *text = malloc(pieceLength * count + 1);
    assert_non_null(text);
    for (size_t i = 0; i < count; i++)
        memcpy(text + i * pieceLength, piece, pieceLength);
    *length = pieceLength * count;
    text[*length] = '\0';
    return text;
}

/* ---- Finding ---- */

static void allErrorsAreFoundInOrder(void **state)
{
    (void)state;
    Diagnostics d = load("objects:\n"
                         "  - sphere: {center: [0, 0], radius: -1, material: gold}\n"
                         "camera: {fov: 0, postion: [0, 0, 0]}\n"
                         "lights: [{pont: {}}]\n");
    assert_int_equal(d.errors, 6);
    assertError(&d, 0, 2, 22, "'center' needs 3 numbers [x, y, z], but has 2");
    assertError(&d, 1, 2, 38, "'radius' must be above 0, but is -1");
    assertError(&d, 2, 2, 52, "there is no material 'gold'");
    assertError(&d, 3, 3, 15, "'fov' must be above 0 and below 180, but is 0");
    assertError(&d, 4, 3, 18, "unknown key 'postion'");
    assert_string_equal(d.items[4].hint, "did you mean 'position'?");
    assertError(&d, 5, 4, 11, "unknown light 'pont'");
    diagnosticsFree(&d);
}

static void columnsCountCharacters(void **state)
{
    (void)state;
    Diagnostics d = load("materials: {\xC3\xA9mail: {diffus: 1}, \xE9\x87\x89\xE8\x96\xAC: {diffus: 1}}\n");
    assertError(&d, 0, 1, 21, "unknown key 'diffus'");
    assertError(&d, 1, 1, 38, "unknown key 'diffus'");
    diagnosticsFree(&d);
    d = load("\xEF\xBB\xBFimag: {}");
    assertError(&d, 0, 1, 1, "unknown key 'imag'");
    diagnosticsFree(&d);
    d = load("# one\r\n# two\r\nimag: {}\r\n");
    assertError(&d, 0, 3, 1, "unknown key 'imag'");
    assert_string_equal(d.items[0].sourceLine, "imag: {}");
    diagnosticsFree(&d);
}

static void theStatusSaysTheFirstErrorAndHowManyMore(void **state)
{
    (void)state;
    const char *const yaml[] = {"a: 1\n", "a: 1\nb: 1\n", "a: 1\nb: 1\nc: 1\n"};
    const char *const messages[] = {"unknown key 'a'", "unknown key 'a' (and 1 more error)",
                                    "unknown key 'a' (and 2 more errors)"};
    for (size_t i = 0; i < 3; i++) {
        Scene scene;
        Diagnostics d = {0};
        Status status = loadSceneFromText(yaml[i], strlen(yaml[i]), &scene, &d);
        assert_int_equal(status.code, STATUS_SCENE);
        assert_string_equal(status.message, messages[i]);
        diagnosticsFree(&d);
    }
}

static void everyErrorIsCountedAndEachOnce(void **state)
{
    (void)state;
    size_t length;
    char *items = repeat("{sphere: {center: [0, 0, -5], radius: 0}}, ", 3000, &length);
    char *yaml = malloc(length + 20);
    assert_non_null(yaml);
    length = (size_t)sprintf(yaml, "objects: [%s]", items);
    Diagnostics d = loadBytes(yaml, length);
    assert_int_equal(d.errors, 3000);
    assert_int_equal(d.count, DIAGNOSTICS_KEPT);
    Text text = {0};
    diagnosticsPrint(&d, "many.yaml", false, &text);
    assert_non_null(strstr(textString(&text), "... and 2980 more errors\n"));
    textFree(&text);
    diagnosticsFree(&d);
    free(items);
    free(yaml);

    /* An error in a value that is used many times is one error. */
    d = load("objects:\n  - &o\n    sphere: {center: [0, 0, -5], radius: 0}\n  - *o\n  - *o\n");
    assert_int_equal(d.errors, 1);
    diagnosticsFree(&d);
}

static void onlyCloseWordsAreSuggested(void **state)
{
    (void)state;
    static const struct {
        const char *word, *candidate;
        bool near;
    } pairs[] = {
        {"postion", "position", true},
        {"poistion", "position", true},
        {"positoin", "position", true},
        {"Position", "position", true},
        {"lookAt", "look_at", true},
        {"look-at", "look_at", true},
        {"colour", "color", true},
        {"centre", "center", true},
        {"radious", "radius", true},
        {"sphre", "sphere", true},
        {"fovv", "fov", true},
        {"fvo", "fov", true},
        {"up", "fov", false},
        {"size", "radius", false},
        {"min", "max", false},
        {"m0", "m1", false},
        {"blinn_phong", "phong", false},
        {"triangle", "plane", false},
        {"", "fov", false},
        {"___", "fov", false},
        {"x", "y", false},
        {"shininess_", "shininess", true},
        {"specualr", "specular", true},
        {"difuse", "diffuse", true},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        Suggestion suggestion = {.word = pairs[i].word, .length = strlen(pairs[i].word)};
        tryCandidate(&suggestion, pairs[i].candidate);
        if ((suggestion.best != NULL) != pairs[i].near)
            fail_msg("'%s' and '%s'", pairs[i].word, pairs[i].candidate);
    }

    /* The nearest one wins, whatever the order. */
    Suggestion suggestion = {.word = "red_glase", .length = 9};
    tryCandidate(&suggestion, "red_gloss");
    tryCandidate(&suggestion, "red_glaze");
    tryCandidate(&suggestion, "red_glade2");
    assert_string_equal(suggestion.best, "red_glaze");

    /* Words of any length are safe. */
    size_t length;
    char *word = repeat("position", 1000, &length);
    suggestion = (Suggestion){.word = word, .length = length};
    tryCandidate(&suggestion, word);
    assert_null(suggestion.best);
    free(word);
}

/* Whether exactly one error is found, with this message. */
static void assertOnly(const char *yaml, int line, int column, const char *message)
{
    Diagnostics d = load(yaml);
    assert_int_equal(d.errors, 1);
    assertError(&d, 0, line, column, message);
    diagnosticsFree(&d);
}

static void oneMistakeGivesOneError(void **state)
{
    (void)state;
    /* A required key that is misspelt is not reported as missing too. */
    assertOnly("objects: [{sphere: {centre: [0, 0, -5], radius: 1}}]", 1, 21, "unknown key 'centre'");
    assertOnly("objects: [{sphere: {center: [0, 0, -5], radius: one}}]", 1, 49,
               "'radius' must be a number above 0, but is the text 'one'");
    assertOnly("camera: {look_at: [0, 0, 0], position: [0, 0, a]}", 1, 47,
               "the z of 'position' must be a number, but is the text 'a'");
    assertOnly("camera: {direction: [0, 0, 0], up: [0, 1, 0]}", 1, 21,
               "'direction' has length 0 and so points nowhere");
    assertOnly("image: {width: 65535, height: 70000}", 1, 31,
               "'height' must be from 1 to 65535, but is 70000");
    assertOnly(
        "materials: {red: {diffuse: x}}\nobjects: [{cube: {center: [0, 0, 0], size: 1, material: red}}]", 1,
        28,
        "'diffuse' must be a colour: a list of 3 numbers [r, g, b], or one number for a grey, but is the "
        "text 'x'");
    assertOnly("objects: [{sphere: {center: *c, radius: 1}}]", 1, 29,
               "the alias '*c' stands for nothing: no '&c' comes before it");
}

static void pixelLimitIsReportedAtTheHeight(void **state)
{
    (void)state;
    Diagnostics d = load("image: {height: 65535, width: 65535}");
    assert_int_equal(d.errors, 1);
    assert_int_equal(d.items[0].column, 17);
    diagnosticsFree(&d);
    /* The height comes from the default where only the width is given; then no width in range is too much. */
    d = load("image: {width: 65535}");
    assert_int_equal(d.errors, 0);
    diagnosticsFree(&d);
}

/* ---- Printing ---- */

static char *print(const char *yaml, bool color)
{
    Diagnostics d = load(yaml);
    Text text = {0};
    diagnosticsPrint(&d, "a.yaml", color, &text);
    diagnosticsFree(&d);
    assert_non_null(text.data);
    return text.data;
}

static void caretStandsBelowTheFault(void **state)
{
    (void)state;
    char *text = print("camera:\t{\tfov:\t-1}\nobjects: []\n", false);
    assert_non_null(strstr(text, "a.yaml:1:16: error: 'fov' must be above 0 and below 180, but is -1\n"
                                 "  camera:\t{\tfov:\t-1}\n"
                                 "         \t \t    \t^~\n"));
    free(text);
    text = print("\"\xE9\x87\x89\": 1\n", false);
    assert_non_null(strstr(text, "\n  \"\xE9\x87\x89\": 1\n  ^~~~\n")); /* the wide one takes two columns */
    free(text);
}

static void colorIsOnlyWhereAsked(void **state)
{
    (void)state;
    char *text = print("imag: {}", true);
    assert_non_null(strstr(text, "\x1b[1;31merror:\x1b[0m"));
    free(text);
    text = print("imag: {}", false);
    assert_null(strchr(text, '\x1b'));
    free(text);
}

static void veryLongLinesAreCut(void **state)
{
    (void)state;
    size_t length;
    char *before = repeat("{sphere: {center: [0, 0, -5], radius: 1}}, ", 500, &length);
    char *yaml = malloc(2 * length + 200);
    assert_non_null(yaml);
    sprintf(yaml, "objects: [%s{sphere: {center: [0, 0, -5], radius: -7}}, %s]", before, before);
    Diagnostics d = load(yaml);
    assert_int_equal(d.count, 1);
    const Diagnostic *item = &d.items[0];
    assert_int_equal(item->column, (int)strlen("objects: [") + (int)length + 39);
    assert_true(strlen(item->sourceLine) < 200);
    assert_memory_equal(item->sourceLine, "\xE2\x80\xA6", 3);
    /* The caret's place in the cut line is where the number is; the dots are one character of three bytes. */
    assert_memory_equal(item->sourceLine + (item->column - item->sourceOffset - 1) + 2, "-7}}", 4);
    diagnosticsFree(&d);
    free(before);
    free(yaml);
}

static void nothingFromTheFileReachesTheTerminalRaw(void **state)
{
    (void)state;
    static const char *const scenes[] = {
        "\"\\e[31m\\u202E\\0x\": 1\n",
        "objects: [{cube: {center: [0, 0, 0], size: 1, material: \"\\x9b3J\\n\"}}]\n",
        "render: {model: \"\\e]0;title\\a\"}\n",
        "image: *\xE2\x80\xAE\n",
        "image: \"\xE2\x80\xAE\xEF\xBB\xBF\"\n",
        "a\x1b[2J: 1\n",
        "a\x7f: 1\n",
        "a\xC2\x9B: 1\n",
    };
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        char *text = print(scenes[i], false);
        for (const unsigned char *s = (const unsigned char *)text; *s != '\0'; s++) {
            assert_true(*s >= 0x20 || *s == '\n' || *s == '\t');
            assert_true(*s != 0x7F);
            assert_false(s[0] == 0xC2 && s[1] < 0xA0);
            assert_false(s[0] == 0xE2 && s[1] == 0x80 && s[2] == 0xAE);
        }
        free(text);
    }
    Diagnostics d = load("imag: 1");
    Text text = {0};
    diagnosticsPrint(&d, "evil\x1b[2J.yaml", false, &text);
    assert_null(strchr(textString(&text), '\x1b'));
    textFree(&text);
    diagnosticsFree(&d);
}

/* ---- Hostile files ---- */

static double secondsToLoad(const char *yaml, size_t length, size_t *errors)
{
    struct timespec start, end;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &start);
    Diagnostics d = loadBytes(yaml, length);
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
    *errors = d.errors;
    diagnosticsFree(&d);
    return (double)(end.tv_sec - start.tv_sec) + 1e-9 * (double)(end.tv_nsec - start.tv_nsec);
}

/* What takes libyaml alone 25 s must not take one; the limit is wide, for slow machines and sanitizers. */
static void repeatedPiecesAreStoppedAtOnce(void **state)
{
    (void)state;
    static const char *const pieces[] = {"[",    "{",   "- ",   "? ",         "a: ",   "[{a: ",       "&a ",
                                         "!a ",  "*a ", "*a, ", "%TAG ! x\n", "---\n", "...\n",       "'",
                                         "\"",   "\\",  "#",    ":",          ",",     "\t",          "\n",
                                         "\r\n", "|\n", "<<: ", "[]",         "{}, ",  "\xEF\xBB\xBF"};
    for (size_t i = 0; i < sizeof pieces / sizeof *pieces; i++) {
        size_t length, errors;
        char *yaml = repeat(pieces[i], 100000 / strlen(pieces[i]), &length);
        double seconds = secondsToLoad(yaml, length, &errors);
        if (seconds > 2 || errors == 0)
            fail_msg("100 kB of '%s': %.1f s, %zu errors", pieces[i], seconds, errors);
        free(yaml);
    }
    size_t length, errors;
    char *yaml = malloc(3000000);
    assert_non_null(yaml);
    length = 0;
    for (int i = 0; i < 100000; i++)
        length += (size_t)sprintf(yaml + length, "%%TAG !a%d! x\n", i);
    assert_true(secondsToLoad(yaml, length, &errors) < 2);
    assert_int_equal(errors, 1);
    free(yaml);
}

static void depthIsLimitedTo64(void **state)
{
    (void)state;
    for (int depth = 60; depth < 70; depth++) {
        char yaml[200] = "x: ";
        size_t used = 3;
        for (int i = 1; i < depth; i++)
            yaml[used++] = '[';
        for (int i = 1; i < depth; i++)
            yaml[used++] = ']';
        Diagnostics d = loadBytes(yaml, used);
        bool tooDeep = false;
        for (size_t i = 0; i < d.count; i++)
            tooDeep = tooDeep || strstr(d.items[i].message, "deeper than 64") != NULL;
        assert_int_equal(tooDeep, depth > 64);
        diagnosticsFree(&d);
    }
}

static void aliasesCannotBlowUpAFile(void **state)
{
    (void)state;
    Text yaml = {0};
    textAppend(&yaml, "objects:\n  - &a0\n    sphere: {center: [0, 0, -5], radius: 1}\nx:\n");
    for (int i = 1; i <= 30; i++)
        textAppendFormat(&yaml, "  - &a%d [*a%d, *a%d]\n", i, i - 1, i - 1);
    size_t errors;
    double seconds = secondsToLoad(yaml.data, yaml.length, &errors);
    textFree(&yaml);
    assert_true(errors >= 1);
    assert_true(seconds < 2);

    /* Honest use of one alias by every object is far from the limit. */
    textAppend(&yaml,
               "materials: {m: &m {diffuse: [1, 1, 1], specular: [1, 1, 1], shininess: 5}}\nobjects:\n");
    for (int i = 0; i < 60000; i++)
        textAppend(&yaml, "- sphere: {center: [0, 0, -5], radius: 1, material: *m}\n");
    secondsToLoad(yaml.data, yaml.length, &errors);
    assert_int_equal(errors, 0);
    textFree(&yaml);
}

/* An undefined material that a group hands down to many is one error and one search for its name. */
static void anInheritedErrorIsOneError(void **state)
{
    (void)state;
    Text yaml = {0};
    textAppend(&yaml, "objects:\n- group:\n    material: glod\n    objects:\n");
    for (int i = 0; i < 20000; i++)
        textAppend(&yaml, "    - sphere: {center: [0, 0, -5], radius: 1}\n");
    textAppend(&yaml, "    - &o\n      sphere: {center: [0, 0, -5], radius: 1, material: sliver}\n");
    for (int i = 0; i < 20000; i++)
        textAppend(&yaml, "    - *o\n");
    textAppend(&yaml, "materials:\n  gold: {}\n  silver: {}\n");
    for (int i = 0; i < 20000; i++)
        textAppendFormat(&yaml, "  name%d: {}\n", i);
    size_t errors;
    double seconds = secondsToLoad(yaml.data, yaml.length, &errors);
    if (errors != 2 || seconds > 2)
        fail_msg("%zu errors, %.1f s", errors, seconds);
    Diagnostics d = loadBytes(yaml.data, yaml.length);
    assert_string_equal(d.items[0].hint, "did you mean 'gold'?");
    assert_int_equal(d.items[0].line, 3);
    assert_string_equal(d.items[1].hint, "did you mean 'silver'?");
    diagnosticsFree(&d);
    textFree(&yaml);
}

/* Lists within lists of groups by way of aliases stay within the budget of aliases. */
static void groupsOfAliasesCannotBlowUp(void **state)
{
    (void)state;
    Text yaml = {0};
    textAppend(&yaml, "objects:\n- &g0\n  group: {objects: [{sphere: {center: [0, 0, -5], radius: 1}}]}\n");
    for (int i = 1; i <= 18; i++)
        textAppendFormat(&yaml, "- &g%d\n  group: {objects: [*g%d, *g%d, *g%d, *g%d]}\n", i, i - 1, i - 1,
                         i - 1, i - 1);
    size_t errors;
    double seconds = secondsToLoad(yaml.data, yaml.length, &errors);
    textFree(&yaml);
    assert_true(errors >= 1);
    assert_true(seconds < 5);
}

/* A broken file that many objects name is read once and reported at each. */
static void aBrokenFileIsReportedWhereverItIsNamed(void **state)
{
    (void)state;
    Diagnostics d = load("objects:\n- mesh: {file: scenes/bad/files/broken.obj}\n"
                         "- mesh: {file: scenes/bad/files/broken.obj, transform: [scale: 2]}\n"
                         "- spheres: {file: scenes/bad/files/broken-spheres.txt}\n"
                         "- mesh: {file: /dev/zero}\n");
    assert_int_equal(d.errors, 4);
    for (size_t i = 0; i < 2; i++) {
        assert_int_equal(d.items[i].line, 2 + (int)i);
        assert_non_null(strstr(d.items[i].message, "scenes/bad/files/broken.obj:5:7: "));
    }
    assert_int_equal(d.items[2].column, 19);
    assert_non_null(strstr(d.items[2].message, "scenes/bad/files/broken-spheres.txt:3:8: "));
    assert_non_null(strstr(d.items[3].message, "'/dev/zero': it is not an ordinary file"));
    diagnosticsFree(&d);
}

/* ---- Any bytes ---- */

static const char SCENE[] =
    "%YAML 1.2\n--- # \xC3\xA9\n"
    "image: {width: 64, height: 0x30, bit_depth: 16, encoding: 'linear'}\n"
    "camera:\n  position: &p [0, .5, +5e0]\n  look_at: [0, 0, -1]\n  fov: 60.\n"
    "render: {model: \"lam\\x62ert\", shadows: True, samples: 2, ambient: 0.1}\n"
    "background: {gradient: {bottom: 0.25, top: [0, 0, 1]}}\nfog: {color: 0, distance: 5}\n"
    "materials:\n  red glaze: &m {diffuse: [1, 0, 0], shininess: 32, transmission: 0.5, ior: 1.5}\n"
    "  ? blue\n  : {specular: 1, pattern: {stripes: {colors: [0, 1], axis: y, transform: [scale: 2]}}}\n"
    "lights:\n- point: {position: *p, color: 20, falloff: none}\n"
    "- spot: {position: *p, look_at: [0, 0, 0], color: 1, inner_angle: 5, outer_angle: 9}\n"
    "- area: {center: *p, edge_u: [1, 0, 0], edge_v: [0, 1, 0], samples: [2, 3], color: 1}\n"
    "objects: [\n  {sphere: {center: [0, 0, -5], radius: 1, material: red glaze}},\n"
    "  {group: {transform: [{translate: *p}, {rotate: {axis: [0, 1, 0], angle: 30}}], casts_shadow: false,\n"
    "    objects: [{spheres: {data: [[0, 0, 0, 1], [1, 1, 1, 2]]}}, {difference: {material: *m, objects: [\n"
    "      {cube: {center: *p, size: 1}}, {cone: {base: *p, top: [0, 0, 0], base_radius: 1, top_radius: "
    "0}},\n"
    "      {group: {objects: [{torus: {major_radius: 2, minor_radius: 1}}]}}]}}]}},\n"
    "  {triangle: {vertices: [*p, [0, 0, 0], [1, 0, 0]], material: blue}},\n"
    "  {plane: {point: [0, -1, 0], normal: [0, 2, 0], material: *m}}]\n"
    "compare: {fail: 3.1e-5}\n...\n";

static void everyPrefixIsHandled(void **state)
{
    (void)state;
    Diagnostics d = loadBytes(SCENE, sizeof SCENE - 1);
    assert_int_equal(d.errors, 0);
    diagnosticsFree(&d);
    for (size_t length = 0; length < sizeof SCENE; length++) {
        d = loadBytes(SCENE, length);
        Text text = {0};
        diagnosticsPrint(&d, "prefix.yaml", false, &text);
        assert_false(text.failed);
        textFree(&text);
        diagnosticsFree(&d);
    }
}

/* xorshift64 (Marsaglia 2003), so that every run tries the same. */
static uint64_t random64(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    return *state ^= *state << 17;
}

static void randomChangesAreHandled(void **state)
{
    (void)state;
    enum {
        ROUNDS = 6000,
        ROOM = 200
    };
    static const char *const pieces[] = {
        "[",  "]",    "{",  "}",        ": ",    ", ",   "- ",           "\n", "\t",
        "  ", "&p ",  "*p", "*m",       "<<",    "!x ",  "? ",           "|",  ">",
        "'",  "\"",   "%",  "#",        "@",     "\\",   "---\n",        "~",  "1e9",
        "-1", ".nan", "0",  "sphere: ", "point", "\xC3", "\xE2\x80\xA8", "\r", "\x01"};
    uint64_t seed = 20240517;
    size_t valid = 0;
    for (int round = 0; round < ROUNDS; round++) {
        char yaml[sizeof SCENE + ROOM];
        size_t length = sizeof SCENE - 1;
        memcpy(yaml, SCENE, length);
        size_t changes = 1 + random64(&seed) % 4;
        for (size_t i = 0; i < changes; i++) {
            size_t at = random64(&seed) % length;
            const char *piece = pieces[random64(&seed) % (sizeof pieces / sizeof *pieces)];
            size_t pieceLength = strlen(piece);
            switch (random64(&seed) % 4) {
            case 0: /* change a byte */
                yaml[at] = (char)random64(&seed);
                break;
            case 1: /* leave some out */
            {
                size_t count = 1 + random64(&seed) % 8;
                count = count < length - at ? count : length - at;
                memmove(yaml + at, yaml + at + count, length - at - count);
                length -= count;
                break;
            }
            default: /* put a piece in */
                memmove(yaml + at + pieceLength, yaml + at, length - at);
                memcpy(yaml + at, piece, pieceLength);
                length += pieceLength;
                break;
            }
        }
        Diagnostics d = loadBytes(yaml, length);
        Text text = {0};
        diagnosticsPrint(&d, "mutation.yaml", round % 2 == 0, &text);
        assert_false(text.failed);
        valid += d.errors == 0;
        textFree(&text);
        diagnosticsFree(&d);
    }
    /* The changes are neither all harmless nor all fatal. */
    assert_in_range(valid, ROUNDS / 100, ROUNDS / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(allErrorsAreFoundInOrder),
        cmocka_unit_test(columnsCountCharacters),
        cmocka_unit_test(theStatusSaysTheFirstErrorAndHowManyMore),
        cmocka_unit_test(everyErrorIsCountedAndEachOnce),
        cmocka_unit_test(onlyCloseWordsAreSuggested),
        cmocka_unit_test(oneMistakeGivesOneError),
        cmocka_unit_test(pixelLimitIsReportedAtTheHeight),
        cmocka_unit_test(caretStandsBelowTheFault),
        cmocka_unit_test(colorIsOnlyWhereAsked),
        cmocka_unit_test(veryLongLinesAreCut),
        cmocka_unit_test(nothingFromTheFileReachesTheTerminalRaw),
        cmocka_unit_test(repeatedPiecesAreStoppedAtOnce),
        cmocka_unit_test(depthIsLimitedTo64),
        cmocka_unit_test(aliasesCannotBlowUpAFile),
        cmocka_unit_test(anInheritedErrorIsOneError),
        cmocka_unit_test(groupsOfAliasesCannotBlowUp),
        cmocka_unit_test(aBrokenFileIsReportedWhereverItIsNamed),
        cmocka_unit_test(everyPrefixIsHandled),
        cmocka_unit_test(randomChangesAreHandled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
