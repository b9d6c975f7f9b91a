/* yaml_syntax.h - what libyaml says about broken YAML, in words for who wrote it. */
#ifndef ECLAIRAGE_SCENE_YAML_SYNTAX_H
#define ECLAIRAGE_SCENE_YAML_SYNTAX_H

#include "scene/diagnostics.h"
#include "scene/source_text.h"

#include <yaml.h>

/* Add the error the parser has stopped at, at the place where it must be mended: for a bracket or quote
 * that is never closed, the opening one. */
void reportSyntaxError(const yaml_parser_t *parser, SourceText *source, Diagnostics *diagnostics);

#endif
