/* yaml_parse.c - libyaml's bare parse of a file, every event thrown away: what loading it costs at least.
 *
 *   yaml_parse FILE.yaml
 */
#include <stdio.h>
#include <yaml.h>

int main(int argc, char **argv)
{
    FILE *in = argc == 2 ? fopen(argv[1], "rb") : NULL;
    yaml_parser_t parser;
    if (!in || !yaml_parser_initialize(&parser)) {
        fprintf(stderr, "yaml_parse: no file, or it cannot be opened\n");
        return 2;
    }
    yaml_parser_set_input_file(&parser, in);
    for (yaml_event_type_t type = YAML_NO_EVENT; type != YAML_STREAM_END_EVENT;) {
        yaml_event_t event;
        if (!yaml_parser_parse(&parser, &event)) {
            fprintf(stderr, "yaml_parse: %s: %s\n", argv[1], parser.problem);
            return 1;
        }
        type = event.type;
        yaml_event_delete(&event);
    }
    yaml_parser_delete(&parser);
    fclose(in);
    return 0;
}
