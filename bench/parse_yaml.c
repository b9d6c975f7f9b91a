/* parse_yaml.c - the yardstick of loading: libyaml alone takes every event of a file and drops it.
 *
 * Usage: parse_yaml FILE. Built and timed by load.sh.
 */
#include "base/files.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <yaml.h>

int main(int argc, char **argv)
{
    char *text;
    size_t length;
    Status status = readWholeFile(argc == 2 ? argv[1] : "", 1 << 30, &text, &length);
    yaml_parser_t parser;
    if (!statusIsOk(&status) || !yaml_parser_initialize(&parser)) {
        fprintf(stderr, "parse_yaml: %s\n", status.message);
        return 1;
    }
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, length);
    bool done = false;
    while (!done) {
        yaml_event_t event;
        if (!yaml_parser_parse(&parser, &event)) {
            fprintf(stderr, "parse_yaml: %s\n", parser.problem);
            return 1;
        }
        done = event.type == YAML_STREAM_END_EVENT;
        yaml_event_delete(&event);
    }
    yaml_parser_delete(&parser);
    free(text);
    return 0;
}
