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
    switch (key->type) {
    case FORMAT_POINT:
    case FORMAT_DIRECTION:
        textAppend(text, key->type == FORMAT_POINT ? "`[x, y, z]`" : "`[x, y, z]`, not all 0");
        break;
    case FORMAT_COLOR:
        textAppend(text, "a colour");
        break;
    case FORMAT_MATERIAL:
        textAppend(text, "a name or a mapping");
        break;
    case FORMAT_NUMBER:
    case FORMAT_FLOAT:
    case FORMAT_INTEGER:
    case FORMAT_BOOL:
    case FORMAT_CHOICE:
    case FORMAT_MAPPING:
    case FORMAT_NAMED:
    case FORMAT_KINDS:
        textAppendExpectation(text, key);
        break;
    }
}

static void appendKeys(Text *text, const FormatMapping *mapping)
{
    textAppend(text, "| key | value | default | meaning |\n|---|---|---|---|\n");
    for (size_t i = 0; i < formatKeyCount(mapping); i++) {
        const FormatKey *key = formatKey(mapping, i);
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

static void appendSection(Text *text, const FormatKey *section)
{
    textAppendFormat(text, "\n## `%s`\n\n", section->name);
    textAppendFormat(text, "%c%s.", section->help[0] - 'a' + 'A', section->help + 1);
    switch (section->type) {
    case FORMAT_MAPPING:
        textAppend(text, "\n\n");
        appendKeys(text, section->mapping);
        break;
    case FORMAT_NAMED:
        textAppendFormat(text, " Each name has a %s behind it; names are free.\n\n", section->mapping->name);
        appendKeys(text, section->mapping);
        break;
    case FORMAT_KINDS:
        textAppendFormat(text, " A list; each item is one %s.\n", section->kinds->noun);
        for (size_t i = 0; i < section->kinds->count; i++) {
            const FormatMapping *kind = section->kinds->kinds[i];
            textAppendFormat(text, "\n### `%s`\n\n%c%s.\n\n", kind->name, kind->help[0] - 'a' + 'A',
                             kind->help + 1);
            appendKeys(text, kind);
        }
        break;
    case FORMAT_NUMBER:
    case FORMAT_FLOAT:
    case FORMAT_INTEGER:
    case FORMAT_BOOL:
    case FORMAT_CHOICE:
    case FORMAT_POINT:
    case FORMAT_DIRECTION:
    case FORMAT_COLOR:
    case FORMAT_MATERIAL:
        textAppend(text, " It is ");
        textAppendExpectation(text, section);
        textAppendFormat(text, "; left out: `%s`.\n", section->fallback);
        break;
    }
}

void writeSceneReference(Text *text)
{
    textAppend(text, INTRODUCTION);
    for (size_t i = 0; i < formatKeyCount(&sceneFormat); i++)
        appendSection(text, formatKey(&sceneFormat, i));
}
