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

static const char *nextLine(const char *line)
{
    line = strchr(line, '\n');
    return line != NULL ? line + 1 : NULL;
}

/* Where the text of the line begins, or where the line ends if there is none. */
static const char *startOfText(const char *line)
{
    const char *end = endOfText(line);
    while (line < end && (*line == ' ' || *line == '\t' || *line == '\r'))
        line++;
    return line;
}

/* The item of a list in brackets, which begins on this line. Quotes do not matter: no item of a list in
 * brackets that holds a quoted bracket is a lamp or an object. */
static int findBracketItem(const char *line, const char *at, int lineNumber, size_t number)
{
    int depth = 0;
    size_t seen = 0;
    for (; line != NULL; line = nextLine(line), at = line, lineNumber++) {
        for (const char *end = endOfText(line); at < end; at++) {
            if ((*at == '{' || *at == '[') && ++depth == 2 && seen++ == number)
                return lineNumber;
            if ((*at == '}' || *at == ']') && --depth == 0)
                return 0;
        }
    }
    return 0;
}

int findItemLine(const char *text, const char *section, size_t number)
{
    size_t length = strlen(section);
    const char *line = text;
    int lineNumber = 1;
    while (line != NULL && (strncmp(line, section, length) != 0 || line[length] != ':')) {
        line = nextLine(line);
        lineNumber++;
    }
    if (line == NULL)
        return 0;
    const char *rest = startOfText(line + length + 1);
    if (rest < endOfText(line) && *rest == '[')
        return findBracketItem(line, rest, lineNumber, number);

    /* Items have the indentation of the first one; what is deeper belongs to them. */
    ptrdiff_t indent = -1;
    size_t seen = 0;
    for (line = nextLine(line), lineNumber++; line != NULL; line = nextLine(line), lineNumber++) {
        const char *start = startOfText(line);
        if (start == endOfText(line))
            continue;
        if (indent < 0)
            indent = start - line;
        if (start - line < indent || (start - line == indent && *start != '-'))
            return 0;
        if (start - line == indent && seen++ == number)
            return lineNumber;
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
