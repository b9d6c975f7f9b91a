/* scene_lines.c - see scene_lines.h. */
#include "explain/scene_lines.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

static bool isWordCharacter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* Where the line's text ends: at its end, or where a comment begins. */
static const char *endOfText(const char *line)
{
    const char *c = line;
    for (; *c != '\0' && *c != '\n'; c++)
        if (*c == '#' && (c == line || c[-1] == ' ' || c[-1] == '\t'))
            break;
    return c;
}

static bool lineHasKey(const char *line, const char *end, const char *key)
{
    size_t length = strlen(key);
    for (const char *c = line; c + length < end; c++)
        if (strncmp(c, key, length) == 0 && c[length] == ':' && (c == line || !isWordCharacter(c[-1])))
            return true;
    return false;
}

int findKeyLine(const char *text, const char *key)
{
    int number = 1;
    for (const char *line = text; line != NULL && *line != '\0'; number++) {
        if (lineHasKey(line, endOfText(line), key))
            return number;
        line = strchr(line, '\n');
        line = line != NULL ? line + 1 : NULL;
    }
    return 0;
}

/* Where a key would stand that is left out. */
static const struct {
    const char *key, *section;
} SECTIONS[] = {
    {"shadows", "render"},      {"shadow_bias", "render"}, {"model", "render"},   {"ambient", "render"},
    {"falloff", "lights"},      {"color", "lights"},       {"encoding", "image"}, {"bit_depth", "image"},
    {"width", "image"},         {"fov", "camera"},         {"up", "camera"},      {"specular", "materials"},
    {"shininess", "materials"},
};

void appendPlace(const char *name, const char *text, const char *key, const char *formula, Text *where)
{
    int line = 0;
    if (name != NULL && text != NULL && key != NULL) {
        line = findKeyLine(text, key);
        for (size_t i = 0; i < sizeof SECTIONS / sizeof *SECTIONS && line == 0; i++)
            if (strcmp(SECTIONS[i].key, key) == 0)
                line = findKeyLine(text, SECTIONS[i].section);
    }
    if (line > 0)
        textAppendFormat(where, "%s:%d: ", name, line);
    textAppend(where, formula);
}
