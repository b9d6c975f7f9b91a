/* Whole files: every scene in scenes/bad gives exactly the messages of its .expected file, every other
 * scene loads without a word, and what is written from the format's table is the committed schema and
 * reference page.
 *
 * With ECLAIRAGE_UPDATE=1 in the environment the expected messages, the schema and the reference page are
 * written instead of compared; look at the difference before committing it.
 */
#include "base/files.h"
#include "scene/load.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <cmocka.h>

enum {
    MOST_FILES = 400,
    FEWEST_BAD_FILES = 40
};

/* The paths of a folder's .yaml files, sorted. */
typedef struct Files {
    char paths[MOST_FILES][300];
    size_t count;
} Files;

static int comparePaths(const void *a, const void *b)
{
    return strcmp(a, b);
}

static void listScenes(const char *folder, Files *files)
{
    DIR *directory = opendir(folder);
    if (directory == NULL)
        return;
    for (struct dirent *entry = readdir(directory); entry != NULL; entry = readdir(directory)) {
        size_t length = strlen(entry->d_name);
        if (length < 6 || strcmp(entry->d_name + length - 5, ".yaml") != 0 || entry->d_name[0] == '.')
            continue;
        assert_true(files->count < MOST_FILES);
        snprintf(files->paths[files->count++], sizeof files->paths[0], "%s/%s", folder, entry->d_name);
    }
    closedir(directory);
    qsort(files->paths, files->count, sizeof files->paths[0], comparePaths);
}

static bool isUpdating(void)
{
    const char *update = getenv("ECLAIRAGE_UPDATE");
    return update != NULL && *update != '\0';
}

/* Compare with a file, or write it. */
static void checkAgainstFile(const char *path, const Text *text)
{
    assert_false(text->failed);
    if (isUpdating()) {
        Status status = writeWholeFile(path, textString(text), text->length);
        assert_true(statusIsOk(&status));
        return;
    }
    char *expected;
    size_t length;
    Status status = readWholeFile(path, 1 << 24, &expected, &length);
    if (!statusIsOk(&status))
        fail_msg("%s", status.message);
    if (strlen(expected) != strlen(textString(text)) || strcmp(expected, textString(text)) != 0)
        fail_msg("%s differs; expected:\n%s\nbut got:\n%s", path, expected, textString(text));
    free(expected);
}

static void everyBadSceneGivesItsExpectedMessages(void **state)
{
    (void)state;
    static Files files;
    listScenes("scenes/bad", &files);
    assert_true(files.count >= FEWEST_BAD_FILES);
    for (size_t i = 0; i < files.count; i++) {
        const char *path = files.paths[i];
        Scene scene;
        Diagnostics diagnostics = {0};
        Status status = loadScene(path, &scene, &diagnostics);
        if (status.code != STATUS_SCENE || diagnostics.errors == 0)
            fail_msg("%s: code %d, %zu errors", path, status.code, diagnostics.errors);
        assert_int_equal(diagnostics.warnings, 0);
        assert_true(status.line > 0 && status.column > 0);
        assert_null(scene.objects);
        assert_null(scene.lights);
        Text text = {0};
        diagnosticsPrint(&diagnostics, path, false, &text);
        char expected[320];
        snprintf(expected, sizeof expected, "%.*s.expected", (int)(strlen(path) - 5), path);
        checkAgainstFile(expected, &text);
        textFree(&text);
        diagnosticsFree(&diagnostics);
    }
}

/* No message of a bad scene can reach a terminal with control characters in it. */
static void messagesHoldNoControlCharacters(void **state)
{
    (void)state;
    static Files files;
    listScenes("scenes/bad", &files);
    for (size_t i = 0; i < files.count; i++) {
        Scene scene;
        Diagnostics diagnostics = {0};
        loadScene(files.paths[i], &scene, &diagnostics);
        Text text = {0};
        diagnosticsPrint(&diagnostics, files.paths[i], false, &text);
        for (const char *s = textString(&text); *s != '\0'; s++)
            if ((unsigned char)*s < 0x20 && *s != '\n' && *s != '\t')
                fail_msg("%s: the byte %d is printed", files.paths[i], *s);
        textFree(&text);
        diagnosticsFree(&diagnostics);
    }
}

static void everyGoodSceneLoadsWithoutAWord(void **state)
{
    (void)state;
    static const char *const folders[] = {"scenes", "scenes/course", "scenes/gallery", "scenes/regress"};
    static Files files;
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++)
        listScenes(folders[i], &files);
    assert_true(files.count > 0);
    for (size_t i = 0; i < files.count; i++) {
        Scene scene;
        Diagnostics diagnostics = {0};
        Status status = loadScene(files.paths[i], &scene, &diagnostics);
        Text text = {0};
        diagnosticsPrint(&diagnostics, files.paths[i], false, &text);
        if (!statusIsOk(&status) || text.length > 0)
            fail_msg("%s: %s\n%s", files.paths[i], status.message, textString(&text));
        assert_true(scene.objectCount > 0);
        textFree(&text);
        diagnosticsFree(&diagnostics);
        freeScene(&scene);
    }
}

static void schemaIsTheCommittedOne(void **state)
{
    (void)state;
    Text text = {0};
    writeSceneSchema(&text);
    checkAgainstFile("scenes/scene.schema.json", &text);
    textFree(&text);
}

static void referenceIsTheCommittedOne(void **state)
{
    (void)state;
    Text text = {0};
    writeSceneReference(&text);
    checkAgainstFile("scenes/REFERENCE.md", &text);
    textFree(&text);
}

/* The first block of YAML on the reference page is a scene. */
static void exampleOfTheReferenceLoads(void **state)
{
    (void)state;
    Text text = {0};
    writeSceneReference(&text);
    const char *start = strstr(textString(&text), "```yaml\n");
    assert_non_null(start);
    start += strlen("```yaml\n");
    const char *end = strstr(start, "```");
    assert_non_null(end);
    Scene scene;
    Diagnostics diagnostics = {0};
    Status status = loadSceneFromText(start, (size_t)(end - start), &scene, &diagnostics);
    assert_int_equal(status.code, STATUS_OK);
    assert_int_equal(diagnostics.warnings, 0);
    assert_int_equal(scene.objectCount, 2);
    freeScene(&scene);
    diagnosticsFree(&diagnostics);
    textFree(&text);
}

/* An independent reader of JSON Schema agrees: good scenes are valid, and of the bad ones most are not. */
static void schemaJudgesAsTheLoaderDoes(void **state)
{
    (void)state;
    if (system("python3 -c 'import jsonschema, yaml' >/dev/null 2>&1") != 0) {
        print_message("skipped: python3 has no jsonschema or no yaml module\n");
        skip();
    }
    assert_int_equal(system("python3 tests/unit/check_schema.py"), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everyBadSceneGivesItsExpectedMessages),
        cmocka_unit_test(messagesHoldNoControlCharacters),
        cmocka_unit_test(everyGoodSceneLoadsWithoutAWord),
        cmocka_unit_test(schemaIsTheCommittedOne),
        cmocka_unit_test(referenceIsTheCommittedOne),
        cmocka_unit_test(exampleOfTheReferenceLoads),
        cmocka_unit_test(schemaJudgesAsTheLoaderDoes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
