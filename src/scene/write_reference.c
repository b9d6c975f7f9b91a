/* write_reference.c - the reference page of the scene format, from the table. */
#include "scene/load.h"

#include "scene/format_table.h"

#include <string.h>

static const char INTRODUCTION[] =
    "# The scene format\n"
    "\n"
    "A scene is a YAML file: one mapping of the sections below, all of which may be left out.\n"
    "This page is written by the program from the table that its loader reads by.\n"
    "\n"
    "```yaml\n"
    "# yaml-language-server: $schema=scene.schema.json\n"
    "camera:\n"
    "  position: [0, 1, 4]\n"
    "  look_at: [0, 0.5, 0]\n"
    "materials:\n"
    "  red_glaze: {diffuse: [1, 0, 0], specular: 0.5, shininess: 32}\n"
    "lights:\n"
    "  - point: {position: [-3, 4, 3], color: 30}\n"
    "objects:\n"
    "  - sphere: {center: [0, 0.5, 0], radius: 0.5, material: red_glaze}\n"
    "  - plane: {point: [0, 0, 0], normal: [0, 1, 0], material: {diffuse: [0.2, 0.2, 0.5]}}\n"
    "```\n"
    "\n"
    "- World space is right-handed with y up; lengths are in scene units, angles in degrees.\n"
    "- Colours are linear: `[r, g, b]`, each at least 0 and not limited to 1, or one number for a grey.\n"
    "- An item of a list of lights or objects has one key, its kind; all about it is in the mapping behind\n"
    "  that key.\n"
    "- Numbers and words are those of YAML 1.2: `yes` is a text, `0o17` is fifteen, `1_000` is a text.\n"
    "- Paths of files are relative to the folder of the scene file.\n"
    "- Anchors (`&name`) and aliases (`*name`) work; the merge key `<<` and tags (`!name`) do not.\n"
    "- What is not on this page is an error, never a guess. `eclairage check SCENE.yaml` reports all errors\n"
    "  of a file with line and column.\n";

/* Append text for a cell of a table. */
static void appendCell(Text *text, const char *cell)
{
    for (; *cell != '\0'; cell++)
        textAppendFormat(text, *cell == '|' ? "\\%c" : "%c", *cell);
}

static void appendDefault(Text *text, const FormatKey *key)
{
    if (isRequired(key))
        textAppend(text, "required");
    else if (key->fallback == NULL)
        appendCell(text, key->otherwise != NULL ? key->otherwise : "");
    else
        textAppendFormat(text, "`%s`", key->fallback);
}

static void appendValue(Text *text, const FormatKey *key)
{
    if (key->count == 0 && (key->type == FORMAT_POINT || key->type == FORMAT_DIRECTION)) {
        textAppend(text, key->type == FORMAT_POINT ? "`[x, y, z]`" : "`[x, y, z]`, not all 0");
    } else if (key->count == 0 && key->type == FORMAT_COLOR) {
        textAppend(text, "a colour");
    } else if (key->type == FORMAT_MATERIAL) {
        textAppend(text, "a name or a mapping");
    } else if (key->type == FORMAT_MAPPING) {
        textAppend(text, "a mapping `");
        textAppendShape(text, key->mapping);
        textAppend(text, "`");
    } else if (key->type == FORMAT_STEPS) {
        textAppendFormat(text, "a list of %ss", key->mapping->name);
    } else if (key->type == FORMAT_KINDS) {
        textAppendFormat(text, "a list of %ss", key->kinds->noun);
        if (key->least > 1)
            textAppendFormat(text, ", at least %zu", key->least);
    } else {
        textAppendExpectation(text, key);
    }
}

static void appendSentence(Text *text, const char *sentence)
{
    textAppendFormat(text, "%c%s.", sentence[0] - 'a' + 'A', sentence + 1);
}

static void appendRows(Text *text, const FormatKey *keys, size_t count)
{
    textAppend(text, "| key | value | default | meaning |\n|---|---|---|---|\n");
    for (size_t i = 0; i < count; i++) {
        const FormatKey *key = &keys[i];
        textAppendFormat(text, "| `%s` | ", key->name);
        appendValue(text, key);
        textAppend(text, " | ");
        appendDefault(text, key);
        textAppend(text, " | ");
        appendCell(text, key->help);
        for (size_t j = 0; j < key->choiceCount; j++) {
            textAppendFormat(text, "%s`%s`: ", j == 0 ? ". " : "; ", key->choices[j].word);
            appendCell(text, key->choices[j].help);
        }
        textAppend(text, " |\n");
    }
}

/* The keys of a mapping and, below, those of the mappings in it that are not described elsewhere. */
static void appendKeys(Text *text, const FormatMapping *mapping)
{
    if (mapping->oneKey != NULL)
        textAppendFormat(text, "A %s written as a mapping has one key:\n\n", mapping->name);
    appendRows(text, mapping->keys, mapping->keyCount);
    const FormatKey *common = NULL;
    size_t commonCount = 0;
    for (size_t i = 0; i < mapping->keyCount; i++) {
        const FormatKey *key = &mapping->keys[i];
        if (key->type != FORMAT_MAPPING || key->mapping->isShared)
            continue;
        textAppendFormat(text, "\n### `%s`\n\n", key->name);
        appendSentence(text, key->mapping->help);
        textAppend(text, "\n\n");
        appendRows(text, key->mapping->keys, key->mapping->keyCount);
        common = key->mapping->common;
        commonCount = key->mapping->commonCount;
    }
    if (common != NULL) {
        textAppendFormat(text, "\n### Every %s\n\n", mapping->name);
        appendRows(text, common, commonCount);
    }
}

static void appendKinds(Text *text, const FormatKinds *kinds)
{
    for (size_t i = 0; i < kinds->count; i++) {
        const FormatMapping *kind = kinds->kinds[i];
        textAppendFormat(text, "\n### `%s`\n\n", kind->name);
        appendSentence(text, kind->help);
        textAppend(text, "\n\n");
        appendRows(text, kind->keys, kind->keyCount);
    }
    if (kinds->kinds[0]->common != NULL) {
        textAppendFormat(text, "\n### Every %s\n\nThese keys go with every kind.\n\n", kinds->noun);
        appendRows(text, kinds->kinds[0]->common, kinds->kinds[0]->commonCount);
    }
}

static void appendSection(Text *text, const FormatKey *section)
{
    textAppendFormat(text, "\n## `%s`\n\n", section->name);
    appendSentence(text, section->help);
    if (section->type == FORMAT_MAPPING) {
        if (section->otherwise != NULL)
            textAppendFormat(text, " Left out: %s.", section->otherwise);
        textAppend(text, "\n\n");
        appendKeys(text, section->mapping);
    } else if (section->type == FORMAT_NAMED) {
        textAppendFormat(text, " Each name has a %s behind it; names are free.\n\n", section->mapping->name);
        appendKeys(text, section->mapping);
    } else if (section->type == FORMAT_KINDS) {
        textAppendFormat(text, " A list; each item is one %s.\n", section->kinds->noun);
        appendKinds(text, section->kinds);
    } else {
        textAppend(text, " It is ");
        textAppendExpectation(text, section);
        textAppendFormat(text, "; left out: `%s`.\n", section->fallback);
        if (section->mapping != NULL) {
            textAppend(text, "\n");
            appendKeys(text, section->mapping);
        }
    }
}

/* ---- What several keys refer to ---- */

enum {
    MOST_MAPPINGS = 64
};

/* The mappings that were come by. */
typedef struct Visited {
    const FormatMapping *mappings[MOST_MAPPINGS];
    size_t count;
} Visited;

/* Describe the shared mappings that the keys of this one lead to, each once; that of names has its section.
 */
static void appendShared(Text *text, Visited *visited, const FormatMapping *mapping)
{
    for (size_t i = 0; i < visited->count; i++)
        if (visited->mappings[i] == mapping)
            return;
    if (visited->count == MOST_MAPPINGS)
        return;
    visited->mappings[visited->count++] = mapping;
    for (size_t i = 0; i < formatKeyCount(mapping); i++) {
        const FormatKey *key = formatKey(mapping, i);
        for (size_t j = 0; key->kinds != NULL && j < key->kinds->count; j++)
            appendShared(text, visited, key->kinds->kinds[j]);
        if (key->mapping == NULL)
            continue;
        size_t before = visited->count;
        appendShared(text, visited, key->mapping);
        bool isNew = visited->count > before;
        if (!isNew || !key->mapping->isShared || (key->type != FORMAT_STEPS && key->type != FORMAT_MAPPING))
            continue;
        textAppendFormat(text, "\n## A %s\n\n", key->mapping->name);
        appendSentence(text, key->mapping->help);
        textAppend(text, "\n\n");
        appendKeys(text, key->mapping);
    }
}

void writeSceneReference(Text *text)
{
    textAppend(text, INTRODUCTION);
    for (size_t i = 0; i < formatKeyCount(&sceneFormat); i++)
        appendSection(text, formatKey(&sceneFormat, i));
    Visited visited = {.count = 0};
    appendShared(text, &visited, &sceneFormat);
}
