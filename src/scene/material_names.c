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

/* The defined name that is nearest to the undefined one, or NULL. Each name is looked for once. */
static const char *nearestMaterial(SceneReader *reader, size_t number, size_t *searches)
{
    enum {
        MOST_SEARCHES = 20 /* a file with more undefined names gets no suggestions for the rest */
    };
    NamedMaterial *named = &reader->materials[number];
    if (!named->isSearched && *searches < MOST_SEARCHES) {
        const Name *name = &reader->materialNames.names[number];
        Suggestion suggestion = {.word = name->text, .length = name->length};
        for (size_t i = 0; i < reader->materialNames.count; i++)
            if (reader->materials[i].defined)
                tryCandidate(&suggestion, reader->materialNames.names[i].text);
        named->suggestion = suggestion.best;
        ++*searches;
    }
    named->isSearched = true;
    return named->suggestion;
}

void reportUndefinedMaterials(SceneReader *reader)
{
    bool anyDefined = false;
    for (size_t i = 0; i < reader->materialNames.count && !anyDefined; i++)
        anyDefined = reader->materials[i].defined;
    size_t searches = 0;
    for (size_t i = 0; i < reader->useCount; i++) {
        const MaterialUse *use = &reader->uses[i];
        if (reader->materials[use->name].defined)
            continue;
        const Name *name = &reader->materialNames.names[use->name];
        const char *nearest = nearestMaterial(reader, use->name, &searches);
        Text hint = {0};
        if (nearest != NULL)
            textAppendFormat(&hint, "did you mean '%s'?", quoteBytes(nearest, strlen(nearest)).text);
        else if (anyDefined)
            textAppend(&hint, "define it in the section 'materials'");
        else
            textAppend(&hint, "define it in a section 'materials', or write it in place: material: "
                              "{diffuse: [1, 0, 0]}");
        reportError(reader, use->place, textString(&hint), "there is no material '%s'",
                    quoteBytes(name->text, name->length).text);
        textFree(&hint);
    }
}
