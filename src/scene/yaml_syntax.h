/* yaml_syntax.h - what libyaml says about broken YAML, in words for who wrote it. */
#ifndef ECLAIRAGE_SCENE_YAML_SYNTAX_H
#define ECLAIRAGE_SCENE_YAML_SYNTAX_H

#include "scene/diagnostics.h"
#include "scene/source_text.h"

#include <stdbool.h>
#include <yaml.h>

/* What was read before the error. */
typedef struct SyntaxContext {
    bool inBrackets; /* the innermost list or mapping is written in brackets */
    Place opening;   /* where that one begins */
    bool afterText;  /* the last thing read was a text without quotes */
    Place text;      /* where that began, and in which line it ended */
    int textEndLine;
} SyntaxContext;

/* Add the error the parser has stopped at, at the place where it must be mended: for a bracket or quote
 * that is never closed, the opening one. */
void reportSyntaxError(const yaml_parser_t *parser, const SyntaxContext *context, SourceText *source,
                       Diagnostics *diagnostics);

#endif
