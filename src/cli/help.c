/* help.c - what `--help` says; see help.h. */
#include "cli/help.h"

#include <string.h>

enum {
    PAGE_WIDTH = 80,
    OPTION_COLUMN = 28 /* where the explanation of an option begins */
};

/* ORDER StatusCode (base/status.h) */
const ExitCode EXIT_CODES[] = {
    {0, "done, or within tolerance"},
    {1, "compared, and different"},
    {2, "the command line is wrong"},
    {3, "the scene is invalid"},
    {4, "a file could not be read or written, or memory ran out"},
    {5, "POV-Ray is missing, failed or took too long"},
    {6, "the two pictures differ in width, height, bit depth or encoding"},
    {7, "the scene cannot be expressed in POV-Ray"},
    {130, "interrupted"},
};
const size_t EXIT_CODE_COUNT = sizeof EXIT_CODES / sizeof EXIT_CODES[0];

void appendOptionSyntax(Text *text, const Option *option)
{
    if (option->letter != 0)
        textAppendFormat(text, "-%c, ", option->letter);
    textAppendFormat(text, "--%s", option->name);
    if (option->kind == VALUE_NONE)
        return;
    textAppend(text, " ");
    if (option->placeholder != NULL)
        textAppend(text, option->placeholder);
    else
        for (int i = 0; i < MAX_CHOICES && option->choices[i] != NULL; i++)
            textAppendFormat(text, "%s%s", i == 0 ? "" : "|", option->choices[i]);
}

/* Append spaces up to a column; at least two. */
static void padTo(Text *text, size_t lineStart, size_t column)
{
    size_t length = text->length - lineStart;
    textAppendFormat(text, "%*s", length + 2 <= column ? (int)(column - length) : 2, "");
}

/* Append words from the column on that is reached, in lines of up to PAGE_WIDTH that all begin there. */
static void appendWrapped(Text *text, const char *words, size_t column)
{
    size_t at = column;
    for (const char *word = words; *word != '\0';) {
        size_t length = strcspn(word, " ");
        if (at > column && at + 1 + length > PAGE_WIDTH) {
            textAppendFormat(text, "\n%*s", (int)column, "");
            at = column;
        }
        if (at > column) {
            textAppend(text, " ");
            at++;
        }
        textAppendBytes(text, word, length);
        at += length;
        word += length + (word[length] == ' ');
    }
    textAppend(text, "\n");
}

/* The explanations of a command's examples stand below each other. */
static size_t exampleColumn(const char *examples)
{
    size_t column = 0;
    for (const char *line = examples; *line != '\0'; line = strchr(line, '\n') + 1) {
        size_t needed = 2 + strcspn(line, "\t") + 2;
        if (needed > column)
            column = needed;
    }
    return column;
}

static void appendExamples(Text *text, const char *examples)
{
    size_t column = exampleColumn(examples);
    textAppend(text, "Examples:\n");
    for (const char *line = examples; *line != '\0'; line = strchr(line, '\n') + 1) {
        size_t start = text->length, typed = strcspn(line, "\t");
        textAppend(text, "  ");
        textAppendBytes(text, line, typed);
        padTo(text, start, column);
        textAppendBytes(text, line + typed + 1, strcspn(line + typed + 1, "\n") + 1);
    }
}

static void appendOption(Text *text, const Option *option)
{
    size_t start = text->length;
    /* Let the long names stand below each other, with or without a letter before them. */
    textAppend(text, option->letter != 0 ? "  " : "      ");
    appendOptionSyntax(text, option);
    if (text->length - start + 2 > OPTION_COLUMN) {
        textAppend(text, "\n");
        start = text->length;
    }
    padTo(text, start, OPTION_COLUMN);
    appendWrapped(text, option->help, OPTION_COLUMN);
}

/* Append a description: wrapped paragraphs, and lines that begin with spaces as they are. */
static void appendDescription(Text *text, const char *description)
{
    for (const char *line = description; *line != '\0';) {
        size_t length = strcspn(line, "\n");
        Text paragraph = {0};
        textAppendBytes(&paragraph, line, length);
        if (*line == ' ')
            textAppendFormat(text, "%s\n", textString(&paragraph));
        else
            appendWrapped(text, textString(&paragraph), 0);
        text->failed = text->failed || paragraph.failed;
        textFree(&paragraph);
        line += length + (line[length] == '\n');
    }
}

static void writeProgramHelp(Text *text)
{
    textAppend(text, "eclairage draws scenes written in YAML, and proves the pictures against POV-Ray.\n\n");
    appendExamples(text, "eclairage render scene.yaml\tdraw scene.png\n"
                         "eclairage check scene.yaml\tfind what is wrong with a scene\n"
                         "eclairage compare scene.yaml\tdraw it with POV-Ray too, and compare\n");
    textAppend(text, "\nUsage: eclairage COMMAND [OPTION]... [FILE]...\n\nCommands:\n");
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        textAppendFormat(text, "  %-9s %s\n", COMMANDS[i].name, COMMANDS[i].summary);
    textAppend(text, "\nOptions of every command:\n");
    for (size_t i = 0; i < OPTION_COUNT; i++)
        if (OPTIONS[i].commands == ALL_COMMANDS)
            appendOption(text, &OPTIONS[i]);
    textAppend(text, "\nExit codes:\n");
    for (size_t i = 0; i < EXIT_CODE_COUNT; i++)
        textAppendFormat(text, "  %3d  %s\n", EXIT_CODES[i].code, EXIT_CODES[i].meaning);
    textAppend(text, "\neclairage COMMAND --help says more about a command.\n");
}

void writeHelp(const Command *command, Text *text)
{
    if (command == NULL) {
        writeProgramHelp(text);
        return;
    }
    appendExamples(text, command->examples);
    textAppendFormat(text, "\nUsage: eclairage %s [OPTION]...%s%s\n\n", command->name,
                     *command->operands != '\0' ? " " : "", command->operands);
    appendDescription(text, command->description);
    textAppend(text, "\nOptions:\n");
    for (size_t i = 0; i < OPTION_COUNT; i++)
        if ((OPTIONS[i].commands & command->bit) != 0)
            appendOption(text, &OPTIONS[i]);
}
