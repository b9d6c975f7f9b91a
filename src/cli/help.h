/* help.h - help, manual page and completion, all made from COMMANDS and OPTIONS. */
#ifndef ECLAIRAGE_CLI_HELP_H
#define ECLAIRAGE_CLI_HELP_H

#include "base/text.h"
#include "cli/command.h"
#include "cli/options.h"

#include <stddef.h>

/* What an exit code means. */
typedef struct ExitCode {
    int code;
    const char *meaning;
} ExitCode;

extern const ExitCode EXIT_CODES[];
extern const size_t EXIT_CODE_COUNT;

/* Append how the option is typed: "-o, --output FILE". */
void appendOptionSyntax(Text *text, const Option *option);

/* Append the help of a command, or of the program where command is NULL. */
void writeHelp(const Command *command, Text *text);

/* Append the manual page (man/eclairage.1), and the completion for bash (completions/eclairage.bash). */
void writeManualPage(Text *text);
void writeBashCompletion(Text *text);

#endif
