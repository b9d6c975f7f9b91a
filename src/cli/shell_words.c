/* shell_words.c - see shell_words.h. */
#include "cli/shell_words.h"

#include <string.h>

void appendShellWord(Text *text, const char *word)
{
    static const char HARMLESS[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
    if (*word != '\0' && strspn(word, HARMLESS) == strlen(word)) {
        textAppend(text, word);
        return;
    }
    textAppend(text, "'");
    for (const char *c = word; *c != '\0'; c++) {
        if (*c == '\'')
            textAppend(text, "'\\''");
        else
            textAppendBytes(text, c, 1);
    }
    textAppend(text, "'");
}

void appendShellLine(Text *text, int argc, char **argv)
{
    for (int i = 0; i < argc; i++) {
        if (i > 0)
            textAppend(text, " ");
        appendShellWord(text, argv[i]);
    }
}
