/* load.c - from a YAML file to a Scene; see load.h.
 *
 * The file is one mapping of sections. Each section is read into values as soon as it is complete, and a
 * list of lights or objects item by item, so that reading takes the memory of the scene and not of the
 * file's tree.
 */
#include "scene/load.h"

#include "base/files.h"
#include "scene/material_names.h"
#include "scene/read_values.h"
#include "scene/reader.h"
#include "scene/scene_warnings.h"
#include "scene/yaml_tree.h"

#include <stdlib.h>

enum {
    LARGEST_FILE = 1 << 30 /* bytes */
};

/* Whether broken YAML comes right behind a word: then the word is part of what is broken. */
static bool isSuspect(YamlReader *yaml, const YamlNode *node)
{
    return node->kind == NODE_SCALAR && peekYaml(yaml) == NEXT_FAILED;
}

/* Read the items of the list that comes next, each one's memory being used again for the next one's. */
static void readItems(SceneReader *reader, YamlReader *yaml, const FormatKinds *kinds)
{
    Place place;
    enterYaml(yaml, &place);
    while (peekYaml(yaml) != NEXT_END && !yaml->failed && !mustStop(reader)) {
        ArenaMark mark = arenaMark(&yaml->arena);
        size_t anchors = yaml->anchorNames.count;
        const YamlNode *item = readYamlNode(yaml);
        if (item == NULL || isSuspect(yaml, item))
            return;
        readKindItem(reader, kinds, item);

        /* What an alias may lead to must stay. */
        if (yaml->anchorNames.count == anchors)
            arenaRewind(&yaml->arena, mark);
    }
    if (!yaml->failed)
        leaveYaml(yaml);
}

/* Read one section: its key and its value. */
static void readSection(SceneReader *reader, YamlReader *yaml, GivenKeys *given)
{
    const YamlNode *keyNode = readYamlNode(yaml);
    if (keyNode == NULL)
        return;
    size_t number;
    const FormatKey *key = acceptKey(reader, given, keyNode, &number);
    YamlNext next = peekYaml(yaml);
    if (key != NULL && key->type == FORMAT_KINDS && next == NEXT_LIST && !nextHasAnchor(yaml)) {
        readItems(reader, yaml, key->kinds);
        return;
    }
    const YamlNode *value = readYamlNode(yaml);
    if (key != NULL && value != NULL && !isSuspect(yaml, value))
        readValue(reader, given, number, value, reader->scene);
}

/* root is NULL when there is nothing at all. */
static void reportNoMapping(SceneReader *reader, const YamlNode *root)
{
    if (root == NULL || (root->kind == NODE_SCALAR && root->count == 0)) {
        reportError(reader, (Place){1, 1, 1},
                    "a scene begins, for example, with objects:", "the file is empty");
        return;
    }
    Text what = {0};
    textAppendNode(&what, root);
    reportError(reader, root->place, "write sections such as camera: and objects:",
                "a scene must be a mapping {key: value}, but this is %s", textString(&what));
    textFree(&what);
}

/* Read the root, which must be a mapping. */
static void readRoot(SceneReader *reader, YamlReader *yaml, GivenKeys *given)
{
    YamlNext next = peekYaml(yaml);
    if (next == NEXT_FAILED)
        return;
    if (next != NEXT_MAPPING) {
        const YamlNode *root = next != NEXT_END ? readYamlNode(yaml) : NULL;
        bool isReported =
            yaml->failed || (root != NULL && (root->kind == NODE_ALIAS || isSuspect(yaml, root)));
        if (!isReported)
            reportNoMapping(reader, root);
        return;
    }
    Place place;
    enterYaml(yaml, &place);
    while (peekYaml(yaml) != NEXT_END && !yaml->failed && !mustStop(reader))
        readSection(reader, yaml, given);
    if (yaml->failed || mustStop(reader))
        return;
    leaveYaml(yaml);
    endMapping(reader, given, reader->scene, reader->scene);
    reportUndefinedMaterials(reader);
    finishObjects(reader);
}

/* What the diagnostics come to. */
static Status statusOfDiagnostics(const Diagnostics *diagnostics)
{
    const Diagnostic *first = NULL;
    for (size_t i = 0; i < diagnostics->count && first == NULL; i++)
        if (diagnostics->items[i].severity == SEVERITY_ERROR)
            first = &diagnostics->items[i];
    if (first == NULL)
        return statusOk();
    if (diagnostics->errors == 1)
        return statusErrorAt(STATUS_SCENE, first->line, first->column, "%s", first->message);
    return statusErrorAt(STATUS_SCENE, first->line, first->column, "%s (and %zu more error%s)",
                         first->message, diagnostics->errors - 1, diagnostics->errors > 2 ? "s" : "");
}

/* path: of the scene, or NULL; the files it names are relative to its folder. */
static Status loadText(const char *path, const char *text, size_t length, Scene *scene,
                       Diagnostics *diagnostics)
{
    *scene = createScene();
    Diagnostics found = {0};
    if (length > LARGEST_FILE)
        return statusError(STATUS_IO, "the scene is larger than 1 GiB");
    SourceText source = openSourceText(text, length);
    SceneFiles files = {.scenePath = path};
    SceneReader reader = beginReader(scene, &source, &found, &files);
    EncodingFault fault;
    bool outOfMemory = false, interrupted = false;
    if (!checkEncoding(&source, &fault)) {
        addDiagnostic(&found, fault.isText ? &source : NULL, SEVERITY_ERROR, fault.place, fault.hint,
                      fault.message);
    } else {
        YamlReader yaml;
        GivenKeys given;
        openYaml(&yaml, &source, &found, (RowFormat){rowsFormatKey->name, takeSphereRow});
        beginMapping(&sceneFormat, (Place){1, 1, 1}, &given, scene);
        readRoot(&reader, &yaml, &given);
        if (!mustStop(&reader))
            finishYaml(&yaml);
        outOfMemory = yaml.outOfMemory;
        interrupted = yaml.interrupted || reader.interrupted;
        if (found.errors == 0 && !yaml.failed && !mustStop(&reader))
            addSceneWarnings(&reader, &given);
        closeYaml(&yaml);
    }
    outOfMemory = outOfMemory || reader.outOfMemory || found.outOfMemory;
    freeReader(&reader);
    freeSceneFiles(&files);
    closeSourceText(&source);

    /* Hand over what was found, and the scene only when all is well. */
    diagnosticsSort(&found);
    Status status = outOfMemory   ? statusOutOfMemory()
                    : interrupted ? statusInterrupted()
                                  : statusOfDiagnostics(&found);
    moveDiagnostics(diagnostics, &found);
    if (!statusIsOk(&status)) {
        freeScene(scene);
        *scene = createScene();
    }
    return status;
}

Status loadSceneFromText(const char *text, size_t length, Scene *scene, Diagnostics *diagnostics)
{
    return loadText(NULL, text, length, scene, diagnostics);
}

Status loadScene(const char *path, Scene *scene, Diagnostics *diagnostics)
{
    *scene = createScene();
    char *text;
    size_t length;
    Status status = readWholeFile(path, LARGEST_FILE, &text, &length);
    if (!statusIsOk(&status))
        return status;
    status = loadText(path, text, length, scene, diagnostics);
    free(text);
    return status;
}
