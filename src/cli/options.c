/* options.c - the one table of options, and the command line read by it; see options.h. */
#include "cli/options.h"

#include "base/text.h"
#include "explain/aov.h"
#include "scene/suggest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    DRAWING = COMMAND_RENDER | COMMAND_COMPARE,
    SIZED = DRAWING | COMMAND_POV | COMMAND_WHY,
    JUDGING = COMMAND_COMPARE | COMMAND_DIFF
};

#define FIELD(name) .offset = offsetof(Arguments, name)

/* In the order of the help. Ranges are those of the scene format; ORDER ShadingModel, Encoding. */
const Option OPTIONS[] = {
    {"output", 'o', COMMAND_RENDER | COMMAND_POV | COMMAND_DIFF, VALUE_FILE, .placeholder = "FILE",
     FIELD(output), .help = "write to FILE; - is standard output"},
    {"out", 0, COMMAND_COMPARE | COMMAND_EXPLAIN, VALUE_FOLDER, .placeholder = "DIR", FIELD(folder),
     .help = "write the report and the pictures to DIR"},
    {"aov", 0, COMMAND_RENDER, VALUE_AOVS, .placeholder = "LIST", FIELD(aovs),
     .help = "draw these as well, names with commas between, or all"},
    {"per-term", 0, COMMAND_COMPARE, VALUE_NONE, FIELD(perTerm),
     .help = "compare each term of the light as well; one that differs makes the scene differ"},
    {"svg", 0, COMMAND_WHY, VALUE_FILE, .placeholder = "FILE", FIELD(svg),
     .help = "draw the rays from the side to FILE; - is standard output"},
    {"width", 0, SIZED | COMMAND_EXPLAIN, VALUE_WHOLE, .placeholder = "N", .minimum = 1, .maximum = 65535,
     FIELD(width), .help = "draw N pixels wide; without --height the scene's aspect is kept"},
    {"height", 0, SIZED | COMMAND_EXPLAIN, VALUE_WHOLE, .placeholder = "N", .minimum = 1, .maximum = 65535,
     FIELD(height), .help = "draw N pixels high; without --width the scene's aspect is kept"},
    {"model", 0, SIZED | COMMAND_EXPLAIN, VALUE_CHOICE,
     .choices = {"simple", "lambert", "phong", "blinn_phong"}, FIELD(model),
     .help = "shade with this model, whatever the scene says"},
    {"samples", 0, SIZED | COMMAND_EXPLAIN, VALUE_WHOLE, .placeholder = "N", .minimum = 1, .maximum = 64,
     FIELD(samples), .help = "draw each pixel as the mean of N x N samples"},
    {"threads", 0, DRAWING | COMMAND_EXPLAIN, VALUE_WHOLE, .placeholder = "N", .minimum = 1, .maximum = 256,
     FIELD(threads), .help = "draw on N threads (one for each processor); the picture is the same"},
    {"engine", 0, DRAWING | COMMAND_EXPLAIN, VALUE_CHOICE, .choices = {"fast", "reference"}, FIELD(engine),
     .help = "how to draw; the picture is the same (default fast)"},
    {"encoding", 0, SIZED, VALUE_CHOICE, .choices = {"srgb", "linear"}, FIELD(encoding),
     .help = "store samples by the sRGB curve or as they are"},
    {"bit-depth", 0, SIZED, VALUE_CHOICE, .choices = {"8", "16"}, FIELD(depthChoice),
     .help = "store 8 or 16 bits for each sample"},
    {"fail", 0, JUDGING, VALUE_NUMBER, .placeholder = "X", .minimum = 0, .maximum = 1, FIELD(tolerance.fail),
     .help = "a pixel differs when a channel differs by more than X, in 0 to 1"},
    {"fail-percent", 0, JUDGING, VALUE_NUMBER, .placeholder = "X", .minimum = 0, .maximum = 100,
     FIELD(tolerance.failPercent), .help = "allow X percent of the pixels to differ"},
    {"hard-fail", 0, JUDGING, VALUE_NUMBER, .placeholder = "X", .minimum = 0, .maximum = 1,
     FIELD(tolerance.hardFail), .help = "allow no pixel to differ by more than X"},
    {"rmse", 0, JUDGING, VALUE_NUMBER, .placeholder = "X", .minimum = 0, .maximum = 1, FIELD(tolerance.rmse),
     .help = "allow a root mean square error of at most X"},
    {"ssim", 0, JUDGING, VALUE_NUMBER, .placeholder = "X", .minimum = -1, .maximum = 1, FIELD(tolerance.ssim),
     .help = "ask for a structural similarity of at least X"},
    {"flip", 0, JUDGING, VALUE_NUMBER, .placeholder = "X", .minimum = 0, .maximum = 1, FIELD(tolerance.flip),
     .help = "allow a mean FLIP error of at most X"},
    {"json", 0, ALL_COMMANDS & ~(COMMAND_POV | COMMAND_SCHEMA), VALUE_NONE, FIELD(json),
     .help = "write the result as JSON to standard output"},
    {"quiet", 'q', ALL_COMMANDS, VALUE_NONE, FIELD(quiet),
     .help = "show no progress and no notes; errors and warnings stay"},
    {"color", 0, ALL_COMMANDS, VALUE_CHOICE, .choices = {"auto", "always", "never"}, FIELD(color),
     .help = "colour messages; auto: on a terminal, unless NO_COLOR is set"},
    {"help", 'h', ALL_COMMANDS, VALUE_NONE, FIELD(help), .help = "show this help"},
    {"version", 0, ALL_COMMANDS, VALUE_NONE, FIELD(version), .help = "show the version"},
};
const size_t OPTION_COUNT = sizeof OPTIONS / sizeof OPTIONS[0];

/* ---- Values ---- */

/* Append "a", "a or b", "a, b or c". */
static void appendChoices(Text *text, const Option *option)
{
    for (int i = 0; i < MAX_CHOICES && option->choices[i] != NULL; i++) {
        bool isLast = i + 1 == MAX_CHOICES || option->choices[i + 1] == NULL;
        textAppendFormat(text, "%s%s", i == 0 ? "" : isLast ? " or " : ", ", option->choices[i]);
    }
}

static Status readChoice(const Option *option, const char *given, const char *value, int *choice)
{
    Suggestion suggestion = {.word = value, .length = strlen(value)};
    for (int i = 0; i < MAX_CHOICES && option->choices[i] != NULL; i++) {
        if (strcmp(value, option->choices[i]) == 0) {
            *choice = i;
            return statusOk();
        }
        tryCandidate(&suggestion, option->choices[i]);
    }
    Text choices = {0};
    appendChoices(&choices, option);
    Status status;
    if (suggestion.best != NULL && !(*value >= '0' && *value <= '9'))
        status = statusError(STATUS_USAGE, "%s must be %s, not '%s'; did you mean '%s'?", given,
                             textString(&choices), value, suggestion.best);
    else
        status = statusError(STATUS_USAGE, "%s must be %s, not '%s'", given, textString(&choices), value);
    textFree(&choices);
    return status;
}

static Status unknownAov(const char *given, const char *name, size_t length)
{
    Suggestion suggestion = {.word = name, .length = length};
    Text names = {0};
    for (Aov aov = 0; aov < AOV_COUNT; aov++) {
        textAppendFormat(&names, "%s%s", aov == 0 ? "" : ", ", aovName(aov));
        tryCandidate(&suggestion, aovName(aov));
    }
    Status status;
    if (suggestion.best != NULL)
        status = statusError(STATUS_USAGE, "%s has no '%.*s'; did you mean '%s'? There are %s and all", given,
                             (int)length, name, suggestion.best, textString(&names));
    else
        status = statusError(STATUS_USAGE, "%s has no '%.*s'; there are %s and all", given, (int)length, name,
                             textString(&names));
    textFree(&names);
    return status;
}

/* Read names with commas between them. */
static Status readAovs(const char *given, const char *value, unsigned *set)
{
    *set = 0;
    for (const char *name = value;; name++) {
        size_t length = strcspn(name, ",");
        unsigned found = length == 3 && strncmp(name, "all", 3) == 0 ? ALL_AOVS : 0;
        for (Aov aov = 0; aov < AOV_COUNT; aov++)
            if (strlen(aovName(aov)) == length && strncmp(aovName(aov), name, length) == 0)
                found = 1u << aov;
        if (length == 0)
            return statusError(STATUS_USAGE, "%s needs names with one comma between them, not '%s'", given,
                               value);
        if (found == 0)
            return unknownAov(given, name, length);
        *set |= found;
        name += length;
        if (*name == '\0')
            return statusOk();
    }
}

/* Read a decimal number and nothing else: no spaces, hexadecimals, nan or inf. */
static bool readNumber(const char *value, double *number)
{
    if (*value == '\0' || strspn(value, "0123456789+-.eE") != strlen(value))
        return false;
    char *end;
    *number = parseDouble(value, &end);
    return *end == '\0' && isfinite(*number);
}

static Status storeValue(const Option *option, const char *given, const char *value, Arguments *arguments)
{
    void *field = (char *)arguments + option->offset;
    switch (option->kind) {
    case VALUE_NONE:
        *(bool *)field = true;
        break;
    case VALUE_WHOLE: {
        double number = 0;
        bool isNumber = readNumber(value, &number) && strspn(value, "0123456789+-") == strlen(value);
        if (!isNumber || number < option->minimum || number > option->maximum)
            return statusError(STATUS_USAGE, "%s must be a whole number from %d to %d, not '%s'", given,
                               (int)option->minimum, (int)option->maximum, value);
        *(int *)field = (int)number;
        break;
    }
    case VALUE_NUMBER: {
        double number = 0;
        if (!readNumber(value, &number) || number < option->minimum || number > option->maximum)
            return statusError(STATUS_USAGE, "%s must be a number from %d to %d, not '%s'", given,
                               (int)option->minimum, (int)option->maximum, value);
        *(double *)field = number;
        break;
    }
    case VALUE_CHOICE:
        return readChoice(option, given, value, field);
    case VALUE_AOVS:
        return readAovs(given, value, field);
    case VALUE_FILE:
    case VALUE_FOLDER:
        if (*value == '\0')
            return statusError(STATUS_USAGE, "%s needs the name of a %s, not an empty one", given,
                               option->kind == VALUE_FILE ? "file" : "folder");
        *(const char **)field = value;
        break;
    }
    return statusOk();
}

/* ---- Options ---- */

static const Option *findOption(const char *name, size_t length)
{
    for (size_t i = 0; i < OPTION_COUNT; i++)
        if (strlen(OPTIONS[i].name) == length && strncmp(OPTIONS[i].name, name, length) == 0)
            return &OPTIONS[i];
    return NULL;
}

static const Option *findLetter(char letter)
{
    for (size_t i = 0; i < OPTION_COUNT; i++)
        if (OPTIONS[i].letter == letter && letter != '\0')
            return &OPTIONS[i];
    return NULL;
}

/* One argument taken apart: an option, its value, and where the next argument is. */
typedef struct Token {
    const Option *option; /* NULL: not an option that exists */
    const char *value;    /* NULL: none */
    bool valueMissing;
    const char *rest; /* the letters that follow in the same argument, or NULL */
    int next;         /* index of the next argument */
} Token;

/* Take the value of an option from the next argument; something like an option is not one. */
static void takeNextValue(Token *token, int argc, char **argv)
{
    bool isThere = token->next < argc && strncmp(argv[token->next], "--", 2) != 0;
    if (isThere)
        token->value = argv[token->next++];
    else
        token->valueMissing = true;
}

/* Take `--name`, `--name=value` or `--name value` apart. */
static Token readLongOption(int argc, char **argv, int index)
{
    Token token = {.next = index + 1};
    const char *name = argv[index] + 2;
    size_t length = strcspn(name, "=");
    token.option = findOption(name, length);
    if (name[length] == '=')
        token.value = name + length + 1;
    else if (token.option != NULL && token.option->kind != VALUE_NONE)
        takeNextValue(&token, argc, argv);
    return token;
}

/* Take one letter of `-q`, `-qh`, `-o FILE` or `-oFILE` apart. */
static Token readLetter(int argc, char **argv, int index, const char *letters)
{
    Token token = {.next = index + 1, .option = findLetter(*letters)};
    if (token.option == NULL)
        return token;
    if (token.option->kind == VALUE_NONE)
        token.rest = letters[1] != '\0' ? letters + 1 : NULL;
    else if (letters[1] != '\0')
        token.value = letters + 1;
    else
        takeNextValue(&token, argc, argv);
    return token;
}

static bool looksLikeOption(const char *argument)
{
    return argument[0] == '-' && argument[1] != '\0';
}

/* Whether it is a number below 0 where a command takes numbers: no option, but a wrong pixel, and the command
 * says what is wrong with it. */
static bool isNegativeOperand(const char *argument, const Command *command)
{
    return command != NULL && command->operandKind == OPERANDS_PIXEL && argument[0] == '-' &&
           argument[1] >= '0' && argument[1] <= '9';
}

/* Name the option that was probably meant, among those that fit the command. */
static Status unknownOption(const char *given, size_t length, const Command *command)
{
    Suggestion suggestion = {.word = given, .length = length};
    for (size_t i = 0; i < OPTION_COUNT && length > 2; i++)
        if (command == NULL || (OPTIONS[i].commands & command->bit) != 0)
            tryCandidate(&suggestion, OPTIONS[i].name);
    if (suggestion.best != NULL)
        return statusError(STATUS_USAGE, "unknown option '%.*s'; did you mean '--%s'?", (int)length, given,
                           suggestion.best);
    return statusError(STATUS_USAGE, "unknown option '%.*s'", (int)length, given);
}

/* An option of other commands: name them, and what this one has for the same purpose. */
static Status misplacedOption(const char *given, const Option *option, const Command *command)
{
    Text names = {0};
    size_t count = 0, total = 0;
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        total += (option->commands & COMMANDS[i].bit) != 0;
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        if ((option->commands & COMMANDS[i].bit) == 0)
            continue;
        count++;
        textAppendFormat(&names, "%s%s", count == 1 ? "" : count == total ? " and " : ", ", COMMANDS[i].name);
    }
    bool isTarget = option->kind == VALUE_FILE || option->kind == VALUE_FOLDER;
    for (size_t i = 0; i < OPTION_COUNT && isTarget; i++)
        if ((OPTIONS[i].commands & command->bit) != 0 &&
            (OPTIONS[i].kind == VALUE_FILE || OPTIONS[i].kind == VALUE_FOLDER))
            textAppendFormat(&names, "; use --%s %s", OPTIONS[i].name, OPTIONS[i].placeholder);
    Status status = statusError(STATUS_USAGE, "'%s' does not take %s, which is an option of %s",
                                command->name, given, textString(&names));
    textFree(&names);
    return status;
}

/* Check and store one option as it was taken apart. */
static Status acceptOption(const Token *token, const char *given, size_t length, Arguments *arguments)
{
    const Option *option = token->option;
    const Command *command = arguments->command;
    char name[72];
    if (option == NULL || length >= sizeof name)
        return unknownOption(given, length, command);
    memcpy(name, given, length);
    name[length] = '\0';
    if (command != NULL && (option->commands & command->bit) == 0)
        return misplacedOption(name, option, command);
    if (option->kind == VALUE_NONE && token->value != NULL)
        return statusError(STATUS_USAGE, "%s takes no value, and '%s' was given", name, token->value);
    if (token->valueMissing)
        return statusError(STATUS_USAGE, "%s needs a value after it", name);
    return storeValue(option, name, token->value, arguments);
}

static Status readOption(int argc, char **argv, int *index, Arguments *arguments)
{
    const char *argument = argv[*index];
    if (argument[1] == '-') {
        Token token = readLongOption(argc, argv, *index);
        *index = token.next;
        return acceptOption(&token, argument, strcspn(argument, "="), arguments);
    }
    const char *letters = argument + 1;
    int start = *index;
    while (letters != NULL) {
        Token token = readLetter(argc, argv, start, letters);
        char given[3] = {'-', *letters, '\0'};
        /* Name a character beyond ASCII whole. */
        bool isWhole = (unsigned char)*letters < 0x80;
        Status status = isWhole ? acceptOption(&token, given, 2, arguments)
                                : statusError(STATUS_USAGE, "unknown option '%s'", argument);
        if (!statusIsOk(&status))
            return status;
        *index = token.next;
        letters = token.rest;
    }
    return statusOk();
}

/* ---- The command line ---- */

static Status unknownCommand(const char *name)
{
    Suggestion suggestion = {.word = name, .length = strlen(name)};
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        tryCandidate(&suggestion, COMMANDS[i].name);
    if (suggestion.best != NULL)
        return statusError(STATUS_USAGE, "unknown command '%s'; did you mean '%s'?", name, suggestion.best);
    size_t length = strlen(name);
    bool isScene = (length > 5 && strcmp(name + length - 5, ".yaml") == 0) ||
                   (length > 4 && strcmp(name + length - 4, ".yml") == 0);
    if (isScene)
        return statusError(STATUS_USAGE, "no command before '%s'; to draw it: eclairage render %s", name,
                           name);
    return statusError(STATUS_USAGE, "unknown command '%s'", name);
}

/* The first argument that is neither an option nor the value of one, or NULL. */
static const char *findCommandName(int argc, char **argv)
{
    for (int i = 1; i < argc;) {
        const char *argument = argv[i];
        if (!looksLikeOption(argument))
            return argument;
        if (strcmp(argument, "--") == 0)
            return i + 1 < argc ? argv[i + 1] : NULL;
        if (argument[1] == '-') {
            i = readLongOption(argc, argv, i).next;
            continue;
        }
        Token token = {.rest = argument + 1, .next = i + 1};
        while (token.rest != NULL)
            token = readLetter(argc, argv, i, token.rest);
        i = token.next;
    }
    return NULL;
}

/* What no single option can know of itself. */
static Status checkTogether(const Arguments *arguments)
{
    const Command *command = arguments->command;
    size_t count = arguments->operandCount;
    if (count < command->fewestOperands)
        return statusError(STATUS_USAGE, "'%s' needs %s", command->name,
                           command->bit == COMMAND_DIFF  ? "two pictures: A.png B.png"
                           : command->bit == COMMAND_WHY ? "a scene and a pixel: SCENE.yaml X Y"
                           : command->bit == COMMAND_EXPLAIN
                               ? "a scene, a scene and a picture, or two pictures"
                           : command->mostOperands > 1 ? "at least one scene: SCENE.yaml"
                                                       : "a scene: SCENE.yaml");
    if (count > command->mostOperands)
        return statusError(STATUS_USAGE, "'%s' takes %s%s, and '%s' is too many", command->name,
                           command->mostOperands == 0 ? "no operands" : "only ",
                           command->mostOperands == 0        ? ""
                           : command->bit == COMMAND_WHY     ? "one scene and a pixel"
                           : command->bit == COMMAND_EXPLAIN ? "a scene and a picture, or two pictures"
                           : command->mostOperands == 1      ? "one scene"
                                                             : "two pictures",
                           arguments->operands[command->mostOperands]);
    size_t standardInputs = 0;
    size_t files = command->operandKind == OPERANDS_PIXEL ? 1 : count;
    for (size_t i = 0; i < files; i++) {
        if (*arguments->operands[i] == '\0')
            return statusError(STATUS_USAGE, "the name of a file is empty");
        standardInputs += strcmp(arguments->operands[i], "-") == 0;
    }
    if (standardInputs > 1)
        return statusError(STATUS_USAGE, "standard input (-) can be read only once");
    if (standardInputs == 1 && command->bit == COMMAND_RENDER && arguments->output == NULL)
        return statusError(STATUS_USAGE, "a scene from standard input (-) has no name to make that of the "
                                         "picture from: give one with -o FILE");
    if (arguments->aovs != 0 && arguments->output != NULL && strcmp(arguments->output, "-") == 0)
        return statusError(STATUS_USAGE,
                           "--aov writes its pictures beside that of -o, and -o - has no name to "
                           "make theirs from: give -o a file");
    if (arguments->json && arguments->output != NULL && strcmp(arguments->output, "-") == 0)
        return statusError(STATUS_USAGE, "-o - and --json would both write to standard output: "
                                         "give -o a file");
    if (arguments->json && arguments->svg != NULL && strcmp(arguments->svg, "-") == 0)
        return statusError(STATUS_USAGE, "--svg - and --json would both write to standard output: "
                                         "give --svg a file");
    return statusOk();
}

Status parseArguments(int argc, char **argv, Arguments *arguments)
{
    *arguments = (Arguments){.argc = argc,
                             .argv = argv,
                             .model = NOT_GIVEN,
                             .engine = NOT_GIVEN,
                             .encoding = NOT_GIVEN,
                             .depthChoice = NOT_GIVEN,
                             .tolerance = {NAN, NAN, NAN, NAN, NAN, NAN}};

    /* Find the command first: it says which options may stand before it. `help X` is `X --help`. */
    const char *name = findCommandName(argc, argv);
    bool isHelpCommand = name != NULL && strcmp(name, "help") == 0;
    if (name != NULL && !isHelpCommand) {
        arguments->command = findCommand(name);
        if (arguments->command == NULL)
            return unknownCommand(name);
    }

    /* Read the options and keep the rest. */
    arguments->operands = calloc((size_t)argc + 1, sizeof *arguments->operands);
    if (arguments->operands == NULL)
        return statusOutOfMemory();
    Status status = statusOk();
    bool optionsEnded = false;
    for (int i = 1; i < argc && statusIsOk(&status);) {
        if (!optionsEnded && strcmp(argv[i], "--") == 0) {
            optionsEnded = true;
            i++;
        } else if (!optionsEnded && looksLikeOption(argv[i]) &&
                   !isNegativeOperand(argv[i], arguments->command)) {
            status = readOption(argc, argv, &i, arguments);
        } else {
            /* The first operand is the name of the command. */
            if (argv[i] != name)
                arguments->operands[arguments->operandCount++] = argv[i];
            i++;
        }
    }

    if (statusIsOk(&status) && isHelpCommand) {
        arguments->help = true;
        if (arguments->operandCount > 0) {
            arguments->command = findCommand(arguments->operands[0]);
            if (arguments->command == NULL)
                status = unknownCommand(arguments->operands[0]);
        }
    }
    if (statusIsOk(&status) && !arguments->help && !arguments->version)
        status = arguments->command != NULL ? checkTogether(arguments)
                                            : statusError(STATUS_USAGE, "no command was given");
    if (!statusIsOk(&status))
        freeArguments(arguments);
    return status;
}

void freeArguments(Arguments *arguments)
{
    free(arguments->operands);
    arguments->operands = NULL;
    arguments->operandCount = 0;
}
