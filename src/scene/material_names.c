/* material_names.c - materials that have a name, and who uses them; see material_names.h. */
#include "scene/material_names.h"

#include "scene/read_values.h"
#include "scene/suggest.h"

#include <stdlib.h>
#include <string.h>

size_t materialNumber(SceneReader *reader, const char *text, size_t length)
{
    size_t before = reader->materialNames.count;
    NamedMaterial *materials =
        makeReaderRoom(reader, reader->materials, before, &reader->materialCapacity, sizeof *materials);
    if (materials == NULL)
        return NAME_NONE;
    reader->materials = materials;
    size_t number = addName(&reader->materialNames, text, length);
    if (number == NAME_NONE)
        reader->outOfMemory = true;
    else if (number == before)
        materials[number] = (NamedMaterial){0};
    return number;
}

void readNamedMaterials(SceneReader *reader, const FormatKey *key, const YamlNode *node)
{
    for (const YamlNode *keyNode = node->first; keyNode != NULL; keyNode = keyNode->next->next) {
        const YamlNode *word = keyWord(reader, keyNode);
        if (word == NULL)
            continue;
        if (word->plain && word->count == 2 && memcmp(word->text, "<<", 2) == 0) {
            reportUnknownKey(reader, key->mapping, word);
            continue;
        }
        size_t number = materialNumber(reader, word->text, word->count);
        if (number == NAME_NONE)
            return;
        NamedMaterial *named = &reader->materials[number];
        if (named->defined) {
            reportDuplicate(reader, keyNode->place, word, named->line);
            continue;
        }
        *named = (NamedMaterial){.material = defaultMaterial(), .defined = true, .line = keyNode->place.line};
        const YamlNode *value = resolveAlias(keyNode->next);
        if (value == NULL)
            continue;
        if (value->kind != NODE_MAPPING) {
            Text what = {0};
            textAppendNode(&what, value);
            reportError(reader, value->count == 0 ? keyNode->place : keyNode->next->place,
                        "write it as name: {diffuse: [1, 0, 0]}",
                        "the material '%s' must be a mapping {key: value}, but is %s",
                        quoteBytes(word->text, word->count).text, textString(&what));
            textFree(&what);
            continue;
        }
        readMapping(reader, key->mapping, keyNode->place, value, &named->material);
    }
}

static void reportUndefined(SceneReader *reader, const MaterialUse *use)
{
    enum {
        MOST_SEARCHES = 20 /* a file with more such errors gets no suggestions for the rest */
    };
    const Name *name = &reader->materialNames.names[use->name];
    Suggestion suggestion = {.word = name->text, .length = name->length};
    bool anyDefined = false;
    if (reader->diagnostics->errors < MOST_SEARCHES)
        for (size_t i = 0; i < reader->materialNames.count; i++) {
            if (!reader->materials[i].defined)
                continue;
            anyDefined = true;
            tryCandidate(&suggestion, reader->materialNames.names[i].text);
        }
    Text hint = {0};
    if (suggestion.best != NULL)
        textAppendFormat(&hint, "did you mean '%s'?",
                         quoteBytes(suggestion.best, strlen(suggestion.best)).text);
    else if (anyDefined)
        textAppend(&hint, "define it in the section 'materials'");
    else
        textAppend(
            &hint,
            "define it in a section 'materials', or write it in place: material: {diffuse: [1, 0, 0]}");
    reportError(reader, use->place, textString(&hint), "there is no material '%s'",
                quoteBytes(name->text, name->length).text);
    textFree(&hint);
}

void resolveMaterials(SceneReader *reader)
{
    for (size_t i = 0; i < reader->useCount; i++) {
        const MaterialUse *use = &reader->uses[i];
        const NamedMaterial *named = &reader->materials[use->name];
        if (named->defined)
            reader->scene->objects[use->object].material = named->material;
        else
            reportUndefined(reader, use);
    }
}
