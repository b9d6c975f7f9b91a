/* options.h - the one table of options, and the command line read by it.
 *
 * Options may stand before or after operands and the command; `--` ends them. A value follows as
 * `--width 320` or `--width=320`, `-o FILE` or `-oFILE`; of an option given twice the last one counts.
 */
#ifndef ECLAIRAGE_CLI_OPTIONS_H
#define ECLAIRAGE_CLI_OPTIONS_H

#include "base/status.h"
#include "cli/command.h"

#include <stddef.h>

/* What follows an option, and the type of its field in Arguments. */
typedef enum ValueKind {
    VALUE_NONE,   /* bool */
    VALUE_WHOLE,  /* int, minimum to maximum */
    VALUE_NUMBER, /* double, minimum to maximum */
    VALUE_CHOICE, /* int: the index among choices */
    VALUE_AOVS,   /* unsigned: a set of Aovs, one bit each; names with commas between */
    VALUE_FILE,   /* const char * */
    VALUE_FOLDER  /* const char * */
} ValueKind;

enum {
    MAX_CHOICES = 4
};

typedef struct Option {
    const char *name;  /* without the dashes */
    char letter;       /* 0: none */
    unsigned commands; /* the CommandBits it belongs to */
    ValueKind kind;
    const char *placeholder; /* the value in the help; NULL with choices, which stand there themselves */
    double minimum, maximum;
    const char *choices[MAX_CHOICES]; /* up to the first NULL */
    size_t offset;                    /* of the field in Arguments */
    const char *help;                 /* one sentence without its full stop */
} Option;

extern const Option OPTIONS[];
extern const size_t OPTION_COUNT;

/* Read the command line. On success the caller frees arguments with freeArguments. On failure
 * (STATUS_USAGE, or STATUS_IO when memory runs out) there is nothing to free, and arguments->command is
 * the command if one was recognised, for the advice that follows the message. */
Status parseArguments(int argc, char **argv, Arguments *arguments);
void freeArguments(Arguments *arguments);

#endif
