/* shell_words.h - commands as they can be typed again. */
#ifndef ECLAIRAGE_CLI_SHELL_WORDS_H
#define ECLAIRAGE_CLI_SHELL_WORDS_H

#include "base/text.h"

/* Append a word of a command as a shell reads it. */
void appendShellWord(Text *text, const char *word);

/* Append a whole command line. */
void appendShellLine(Text *text, int argc, char **argv);

#endif
