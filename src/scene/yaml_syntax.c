/* yaml_syntax.c - what libyaml says about broken YAML, in words for who wrote it; see yaml_syntax.h.
 *
 * libyaml 0.2.5 names a problem and, for most, a context: what it was reading and where that began. The
 * table translates each pair that a file can cause; what is not in it is told in libyaml's own words.
 */
#include "scene/yaml_syntax.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

typedef struct SyntaxError {
    const char *context; /* how libyaml's context ends; NULL: any or none */
    const char *problem; /* how its problem begins */
    bool atContext;      /* the place to show is where the context began */
    const char *message;
    const char *hint;
} SyntaxError;

static const char INDENT_HINT[] = "check that it begins in the same column as the lines it belongs to";

static const SyntaxError SYNTAX_ERRORS[] = {
    {"quoted scalar", "found unexpected end of stream", true, "the quote that opens here is never closed",
     "put the same quote at the end of the text"},
    {"quoted scalar", "found unexpected document indicator", true,
     "the quote that opens here is not closed before the next document",
     "put the same quote at the end of the text"},
    {"quoted scalar", "found unknown escape character", false, "after this backslash comes no known letter",
     "write two backslashes for one, or use single quotes"},
    {"quoted scalar", "did not find expected hexdecimal number", false,
     "this escape needs hexadecimal digits", "for example \\x41 or \\u0041"},
    {"quoted scalar", "found invalid Unicode character escape code", false,
     "this escape stands for no character", NULL},
    {"block mapping", "did not find expected key", false, "this does not fit with the lines above",
     INDENT_HINT},
    {"block collection", "did not find expected '-' indicator", false,
     "a list item is expected here, or less indentation",
     "begin it with '- ', below the '-' of the item above"},
    {"simple key", "could not find expected ':'", true, "a ':' is missing behind this key",
     "write it as key: value"},
    {NULL, "block sequence entries are not allowed", false, "a list item '-' cannot begin here",
     "put it on a line of its own, or write the list as [a, b]"},
    {NULL, "mapping keys are not allowed", false, "a '?' cannot stand here", NULL},
    {"an anchor", "did not find expected alphabetic", true, "a name is missing behind this '&'",
     "an anchor is written &name"},
    {"an alias", "did not find expected alphabetic", true, "a name is missing behind this '*'",
     "an alias is written *name; a text that begins with '*' needs quotes"},
    {"plain scalar", "found a tab", false, "a tab is used for indentation", "indent with spaces"},
    {"block scalar", "found a tab", false, "a tab is used for indentation", "indent with spaces"},
    {"block scalar", "", false, "this block of text is not written as YAML wants it", NULL},
    {"plain scalar", "found unexpected ':'", false, "a ':' cannot stand here", "put a space behind it"},
    {"a directive", "", true, "a line that begins with '%' is a YAML directive, and this is not one of them",
     "put the text in quotes, or remove the line"},
    {"directive", "", true, "this YAML directive is not understood", "remove the line"},
    {NULL, "found incompatible YAML document", false, "this version of YAML is not known", "remove the line"},
    {NULL, "found duplicate %", false, "this directive is given twice", "remove one of the two lines"},
    {"a tag", "", false, "tags, the words that begin with '!', have no meaning in a scene", "remove it"},
    {"a node", "found undefined tag handle", false,
     "tags, the words that begin with '!', have no meaning in a scene", "remove it"},
    {NULL, "did not find expected <document start>", false, "nothing more is expected here", INDENT_HINT},
    {"flow node", "did not find expected node content", false, "a value is missing here", NULL},
    {"block node", "did not find expected node content", false, "a value cannot begin like this",
     "put a text that begins with a special character in quotes"},
};

static Place placeOfMark(const yaml_mark_t *mark)
{
    return (Place){(int)mark->line + 1, (int)mark->column + 1, 1};
}

/* The character at a place, 0 at the end of a line. */
static char characterAt(SourceText *source, Place place)
{
    size_t length;
    const char *line = sourceLine(source, place.line, &length);
    const char *s = sourceCharacter(source, place.line, place.column);
    return s < line + length ? *s : '\0';
}

static bool startsWith(const char *text, const char *start)
{
    return strncmp(text, start, strlen(start)) == 0;
}

static bool endsWith(const char *text, const char *end)
{
    size_t textLength = strlen(text), endLength = strlen(end);
    return textLength >= endLength && strcmp(text + textLength - endLength, end) == 0;
}

static void add(SourceText *source, Diagnostics *diagnostics, Place place, const char *hint,
                const char *message)
{
    addDiagnostic(diagnostics, source, SEVERITY_ERROR, place, hint, message);
}

/* Whether the place is behind all that is written. */
static bool isAtEnd(SourceText *source, Place place)
{
    size_t length;
    sourceLine(source, place.line, &length);
    return (size_t)place.line >= source->lineCount && characterAt(source, place) == '\0';
}

/* The first character of a line that is not blank. */
static Place startOfLine(SourceText *source, int line)
{
    size_t length, blanks = 0;
    const char *s = sourceLine(source, line, &length);
    while (blanks < length && (s[blanks] == ' ' || s[blanks] == '\t'))
        blanks++;
    return (Place){line, (int)blanks + 1, 1};
}

/* Whether only blanks come before the place in its line. */
static bool isFirstInLine(SourceText *source, Place place)
{
    return place.column <= startOfLine(source, place.line).column;
}

/* A list or mapping in brackets that goes wrong: a comma is missing, or the closing bracket. */
static void reportBrackets(SourceText *source, Diagnostics *diagnostics, Place opening, Place problem)
{
    char open = characterAt(source, opening), found = characterAt(source, problem);
    char close = open == '{' ? '}' : ']';
    char message[160], hint[120];
    bool mismatch = found == ']' || found == '}';
    if (opening.line == problem.line && found != '\0' && found != '#' && !mismatch) {
        snprintf(message, sizeof message, "a ',' or the closing '%c' is missing before this", close);
        snprintf(hint, sizeof hint, "the '%c' opens in column %d", open, opening.column);
        add(source, diagnostics, problem, hint, message);
        return;
    }
    if (mismatch)
        snprintf(message, sizeof message,
                 "the '%c' that opens here is closed by a '%c' in line %d, column %d", open, found,
                 problem.line, problem.column);
    else
        snprintf(message, sizeof message, "the '%c' that opens here is never closed", open);
    snprintf(hint, sizeof hint, "close it with '%c'", close);
    add(source, diagnostics, opening, hint, message);
}

/* Something stands where a mapping wants its next key. */
static void reportNoKey(SourceText *source, Diagnostics *diagnostics, Place place)
{
    char found = characterAt(source, place);
    char message[80];
    if (found == ']' || found == '}') {
        snprintf(message, sizeof message, "this '%c' closes nothing", found);
        add(source, diagnostics, place, "remove it, or add the bracket that opens", message);
    } else if (isFirstInLine(source, place)) {
        add(source, diagnostics, place, INDENT_HINT, "this does not fit with the lines above");
    } else {
        add(source, diagnostics, place, "begin a new line, or put the whole text in quotes",
            "nothing may follow the value in this line");
    }
}

/* A ':' where none can be. When the text before it began in an earlier line, that is where it goes wrong:
 * either that line has no ':' of its own, or this one is indented so far that it continues the text. */
static void reportColon(SourceText *source, Diagnostics *diagnostics, const SyntaxContext *context,
                        Place place)
{
    bool continued =
        context->afterText && context->text.line < place.line && context->textEndLine == place.line;
    if (continued && isFirstInLine(source, context->text))
        add(source, diagnostics, context->text, "write it as key: value, with a space behind the ':'",
            "a ':' is missing behind this key");
    else if (continued)
        add(source, diagnostics, startOfLine(source, place.line), INDENT_HINT,
            "this line is indented too far");
    else
        add(source, diagnostics, place,
            "put one 'key: value' on each line, and a text with ': ' in it in quotes",
            "a ':' cannot stand here");
}

/* The errors that need more than a row in the table; false when it is none of them. */
static bool reportSpecialError(const yaml_parser_t *parser, const SyntaxContext *context, SourceText *source,
                               Diagnostics *diagnostics, Place place)
{
    const char *what = parser->context != NULL ? parser->context : "";
    const char *problem = parser->problem;
    bool inQuotes = endsWith(what, "quoted scalar");
    if (endsWith(what, "flow sequence") || endsWith(what, "flow mapping")) {
        reportBrackets(source, diagnostics, placeOfMark(&parser->context_mark), place);
    } else if (context->inBrackets && !inQuotes && isAtEnd(source, place)) {
        reportBrackets(source, diagnostics, context->opening, place);
    } else if (endsWith(what, "block mapping") && startsWith(problem, "did not find expected key")) {
        reportNoKey(source, diagnostics, place);
    } else if (startsWith(problem, "mapping values are not allowed")) {
        reportColon(source, diagnostics, context, place);
    } else if (startsWith(problem, "found character that cannot start")) {
        char found = characterAt(source, place);
        char message[80];
        snprintf(message, sizeof message, "a value cannot begin with '%c'", found);
        if (found == '\t')
            add(source, diagnostics, place, "indent with spaces", "a tab is used for indentation");
        else
            add(source, diagnostics, place, "put the text in quotes", message);
    } else {
        return false;
    }
    return true;
}

void reportSyntaxError(const yaml_parser_t *parser, const SyntaxContext *context, SourceText *source,
                       Diagnostics *diagnostics)
{
    Place place = placeOfMark(&parser->problem_mark);
    const char *what = parser->context != NULL ? parser->context : "";
    const char *problem = parser->problem;
    if (problem == NULL) {
        add(source, diagnostics, place, NULL, "this is not YAML");
        return;
    }
    if (reportSpecialError(parser, context, source, diagnostics, place))
        return;
    for (size_t i = 0; i < sizeof SYNTAX_ERRORS / sizeof *SYNTAX_ERRORS; i++) {
        const SyntaxError *error = &SYNTAX_ERRORS[i];
        if ((error->context == NULL || endsWith(what, error->context)) &&
            startsWith(problem, error->problem)) {
            add(source, diagnostics, error->atContext ? placeOfMark(&parser->context_mark) : place,
                error->hint, error->message);
            return;
        }
    }
    char message[200];
    snprintf(message, sizeof message, "this is not YAML: %s", problem);
    add(source, diagnostics, place, NULL, message);
}
