/* manual.c - the manual page and the completion for bash, made from the tables; see help.h.
 *
 * Both are committed (man/eclairage.1, completions/eclairage.bash), and tests/cli/generated.bats holds
 * them against what is written here. References: man(7); the section "Programmable Completion" of bash(1).
 */
#include "cli/help.h"
#include "explain/aov.h"

#include <stdbool.h>
#include <string.h>

/* ---- The manual page ---- */

/* Append text for troff: backslashes and hyphens escaped, and no line begins with a request. */
static void appendTroff(Text *text, const char *words, size_t length)
{
    for (size_t i = 0; i < length && words[i] != '\0'; i++) {
        bool atLineStart = i == 0 || words[i - 1] == '\n';
        if (atLineStart && (words[i] == '.' || words[i] == '\''))
            textAppend(text, "\\&");
        if (words[i] == '\\')
            textAppend(text, "\\e");
        else if (words[i] == '-')
            textAppend(text, "\\-");
        else
            textAppendBytes(text, &words[i], 1);
    }
}

/* Append paragraphs: an empty line parts two, and a line that begins with spaces stands by itself. */
static void appendTroffParagraphs(Text *text, const char *words)
{
    for (const char *line = words; *line != '\0';) {
        size_t length = strcspn(line, "\n"), indent = strspn(line, " ");
        if (length == 0) {
            textAppend(text, ".PP\n");
        } else {
            if (indent > 0)
                textAppend(text, ".RS\n.nf\n");
            appendTroff(text, line + indent, length - indent);
            textAppend(text, indent > 0 ? "\n.fi\n.RE\n" : "\n");
        }
        line += length + (line[length] == '\n');
    }
    textAppend(text, "\n");
}

static void appendTroffOption(Text *text, const Option *option)
{
    Text syntax = {0};
    appendOptionSyntax(&syntax, option);
    textAppend(text, ".TP\n.B ");
    appendTroff(text, textString(&syntax), syntax.length);
    textAppend(text, "\n");
    appendTroff(text, option->help, strlen(option->help));
    textAppend(text, ".\n");
    text->failed = text->failed || syntax.failed;
    textFree(&syntax);
}

static void appendTroffExamples(Text *text, const char *examples)
{
    for (const char *line = examples; *line != '\0'; line = strchr(line, '\n') + 1) {
        size_t typed = strcspn(line, "\t");
        textAppend(text, ".TP\n.B ");
        appendTroff(text, line, typed);
        textAppend(text, "\n");
        appendTroff(text, line + typed + 1, strcspn(line + typed + 1, "\n"));
        textAppend(text, "\n");
    }
}

static void appendTroffCommand(Text *text, const Command *command)
{
    textAppendFormat(text, ".SS eclairage %s ", command->name);
    appendTroff(text, command->operands, strlen(command->operands));
    textAppend(text, "\n");
    appendTroffParagraphs(text, command->description);
    textAppend(text, ".PP\nExamples:\n");
    appendTroffExamples(text, command->examples);
    bool any = false;
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        if ((OPTIONS[i].commands & command->bit) == 0 || OPTIONS[i].commands == ALL_COMMANDS)
            continue;
        textAppend(text, any ? "" : ".PP\nOptions:\n");
        appendTroffOption(text, &OPTIONS[i]);
        any = true;
    }
}

void writeManualPage(Text *text)
{
    textAppend(text, ".\\\" Made by: eclairage --print-manual-page\n"
                     ".TH ECLAIRAGE 1 \"\" \"eclairage " ECLAIRAGE_VERSION "\" \"User Commands\"\n"
                     ".SH NAME\n"
                     "eclairage \\- draw scenes written in YAML, and prove the pictures against POV\\-Ray\n"
                     ".SH SYNOPSIS\n");
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        textAppendFormat(text, "%s.B eclairage %s\n", i == 0 ? "" : ".br\n", COMMANDS[i].name);
        textAppend(text, "[\\fIOPTION\\fR]... ");
        appendTroff(text, COMMANDS[i].operands, strlen(COMMANDS[i].operands));
        textAppend(text, "\n");
    }
    textAppend(text,
               ".SH DESCRIPTION\n"
               "A scene in YAML is drawn by eclairage, written as a scene for POV\\-Ray 3.7, drawn by\n"
               "POV\\-Ray too, and the two pictures are compared pixel by pixel.\n"
               ".PP\n"
               "Options may stand before or after operands;\n"
               ".B \\-\\-\n"
               "ends them. Standard output carries data only: a PNG, a .pov, JSON, or the result of diff\n"
               "and compare in words. Everything else goes to standard error. A file is complete or not\n"
               "there: it is written under another name and renamed.\n"
               ".SH COMMANDS\n");
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        appendTroffCommand(text, &COMMANDS[i]);
    textAppend(text, ".SH OPTIONS OF EVERY COMMAND\n");
    for (size_t i = 0; i < OPTION_COUNT; i++)
        if (OPTIONS[i].commands == ALL_COMMANDS)
            appendTroffOption(text, &OPTIONS[i]);
    textAppend(text, ".SH EXIT STATUS\n");
    for (size_t i = 0; i < EXIT_CODE_COUNT; i++) {
        textAppendFormat(text, ".TP\n.B %d\n", EXIT_CODES[i].code);
        appendTroff(text, EXIT_CODES[i].meaning, strlen(EXIT_CODES[i].meaning));
        textAppend(text, "\n");
    }
    textAppend(text, ".PP\n"
                     "With several scenes the others are still done, and the highest of their codes is\n"
                     "returned.\n"
                     ".SH ENVIRONMENT\n"
                     ".TP\n.B NO_COLOR\n"
                     "When it is not empty, messages have no colour unless \\-\\-color always asks for it.\n"
                     ".TP\n.B TERM\n"
                     "When it is dumb there are no colours and no progress bar.\n"
                     ".TP\n.B TMPDIR\n"
                     "Where the temporary folders for POV\\-Ray are made, instead of /tmp.\n"
                     ".SH SEE ALSO\n"
                     ".BR povray (1)\n");
}

/* ---- The completion for bash ---- */

static void appendWords(Text *text, unsigned command)
{
    bool first = true;
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        if ((OPTIONS[i].commands & command) == 0)
            continue;
        if (OPTIONS[i].letter != 0)
            textAppendFormat(text, "%s-%c", first ? "" : " ", OPTIONS[i].letter);
        textAppendFormat(text, "%s--%s", first && OPTIONS[i].letter == 0 ? "" : " ", OPTIONS[i].name);
        first = false;
    }
}

/* Append the case that completes the value of one option. */
static void appendValueCase(Text *text, const Option *option)
{
    if (option->letter != 0)
        textAppendFormat(text, "    -%c|", option->letter);
    else
        textAppend(text, "    ");
    textAppendFormat(text, "--%s)\n", option->name);
    switch (option->kind) {
    case VALUE_CHOICE:
        textAppend(text, "      mapfile -t COMPREPLY < <(compgen -W '");
        for (int i = 0; i < MAX_CHOICES && option->choices[i] != NULL; i++)
            textAppendFormat(text, "%s%s", i == 0 ? "" : " ", option->choices[i]);
        textAppend(text, "' -- \"$word\")\n");
        break;
    case VALUE_AOVS:
        /* Complete the last name of the list. */
        textAppend(text, "      local given=''\n"
                         "      [[ $word != *,* ]] || given=${word%,*},\n"
                         "      compopt -o nospace 2>/dev/null\n"
                         "      mapfile -t COMPREPLY < <(compgen -P \"$given\" -W '");
        for (Aov aov = 0; aov < AOV_COUNT; aov++)
            textAppendFormat(text, "%s ", aovName(aov));
        textAppend(text, "all' -- \"${word##*,}\")\n");
        break;
    case VALUE_FILE:
        textAppend(text, "      compopt -o filenames 2>/dev/null\n"
                         "      mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n");
        break;
    case VALUE_FOLDER:
        textAppend(text, "      compopt -o filenames 2>/dev/null\n"
                         "      mapfile -t COMPREPLY < <(compgen -d -- \"$word\")\n");
        break;
    case VALUE_NONE:
    case VALUE_WHOLE:
    case VALUE_NUMBER:
        break;
    }
    textAppend(text, "      return\n      ;;\n");
}

void writeBashCompletion(Text *text)
{
    textAppend(text, "# Completion of eclairage for bash. Made by: eclairage --print-bash-completion\n"
                     "\n"
                     "_eclairage()\n"
                     "{\n"
                     "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
                     "  local command='' i\n"
                     "  COMPREPLY=()\n"
                     "\n"
                     "  # Bash makes three words of --color=auto; the option is the first of them.\n"
                     "  if [[ $word == = ]]; then\n"
                     "    word=''\n"
                     "  elif [[ $before == = ]]; then\n"
                     "    before=${COMP_WORDS[COMP_CWORD-2]}\n"
                     "  fi\n"
                     "\n"
                     "  # The value of an option.\n"
                     "  case $before in\n");
    for (size_t i = 0; i < OPTION_COUNT; i++)
        if (OPTIONS[i].kind != VALUE_NONE)
            appendValueCase(text, &OPTIONS[i]);
    textAppend(text, "  esac\n"
                     "\n"
                     "  # Options and operands, by the command.\n"
                     "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
                     "    case ${COMP_WORDS[i]} in\n"
                     "    ");
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        textAppendFormat(text, "%s%s", i == 0 ? "" : "|", COMMANDS[i].name);
    textAppend(text, ")\n"
                     "      command=${COMP_WORDS[i]}\n"
                     "      break\n"
                     "      ;;\n"
                     "    esac\n"
                     "  done\n"
                     "  local options operands=\n"
                     "  case $command in\n");
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        textAppendFormat(text, "  %s)\n    options='", COMMANDS[i].name);
        appendWords(text, COMMANDS[i].bit);
        textAppend(text, "'\n");
        if (COMMANDS[i].operandKind == OPERANDS_SCENES || COMMANDS[i].operandKind == OPERANDS_PIXEL)
            textAppend(text, "    operands='@(*.yaml|*.yml)'\n");
        else if (COMMANDS[i].operandKind == OPERANDS_PICTURES)
            textAppend(text, "    operands='*.png'\n");
        else if (COMMANDS[i].operandKind == OPERANDS_SCENE_OR_PICTURES)
            textAppend(text, "    operands='@(*.yaml|*.yml|*.png)'\n");
        textAppend(text, "    ;;\n");
    }
    textAppend(text, "  *)\n    options='");
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        textAppendFormat(text, "%s ", COMMANDS[i].name);
    textAppend(text, "--help --version'\n"
                     "    ;;\n"
                     "  esac\n"
                     "\n"
                     "  if [[ $word == -* || -z $command ]]; then\n"
                     "    mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\")\n"
                     "  elif [[ -n $operands ]]; then\n"
                     "    # Files of the kind that is wanted, and folders on the way to them.\n"
                     "    compopt -o filenames 2>/dev/null\n"
                     "    local extended\n"
                     "    extended=$(shopt -p extglob)\n"
                     "    shopt -s extglob\n"
                     "    mapfile -t COMPREPLY < <(\n"
                     "      compgen -f -X \"!$operands\" -- \"$word\"\n"
                     "      compgen -d -- \"$word\"\n"
                     "    )\n"
                     "    $extended\n"
                     "  fi\n"
                     "}\n"
                     "\n"
                     "complete -F _eclairage eclairage\n");
}
