/* command.h - the commands of the program, and what the command line asked for.
 *
 * COMMANDS (command.c) and OPTIONS (options.c) are the only lists of commands and options: parsing, help,
 * the manual page and the completion of the shell are all made from them.
 * A command prints its own messages through terminal.h and returns the program's exit code.
 */
#ifndef ECLAIRAGE_CLI_COMMAND_H
#define ECLAIRAGE_CLI_COMMAND_H

#include "base/tolerance.h"

#include <stdbool.h>
#include <stddef.h>

/* One bit for each command, so that an option can name the commands it belongs to. */
typedef enum CommandBit {
    COMMAND_RENDER = 1 << 0,
    COMMAND_POV = 1 << 1,
    COMMAND_COMPARE = 1 << 2,
    COMMAND_DIFF = 1 << 3,
    COMMAND_CHECK = 1 << 4,
    COMMAND_SCHEMA = 1 << 5,
    COMMAND_WHY = 1 << 6,
    COMMAND_EXPLAIN = 1 << 7,
    ALL_COMMANDS = (1 << 8) - 1
} CommandBit;

/* What the operands of a command are, for the completion of the shell. */
typedef enum OperandKind {
    OPERANDS_NONE,
    OPERANDS_SCENES,
    OPERANDS_PICTURES,
    OPERANDS_SCENE_OR_PICTURES,
    OPERANDS_PIXEL /* a scene, and two whole numbers */
} OperandKind;

typedef struct Arguments Arguments;

typedef struct Command {
    CommandBit bit;
    const char *name;
    OperandKind operandKind;
    const char *operands; /* as they stand in the usage line */
    size_t fewestOperands, mostOperands;
    const char *summary;     /* one line, for the list of commands */
    const char *examples;    /* lines of "command<TAB>what it does" */
    const char *description; /* one line a paragraph; lines that begin with spaces stay as they are */
    int (*run)(const Arguments *arguments);
} Command;

extern const Command COMMANDS[];
extern const size_t COMMAND_COUNT;

/* The command of that name, or NULL. */
const Command *findCommand(const char *name);

typedef enum ColorChoice {
    COLOR_AUTO,
    COLOR_ALWAYS,
    COLOR_NEVER
} ColorChoice;

/* What an option that was not given leaves in an int that is a choice. */
enum {
    NOT_GIVEN = -1
};

/* What draws. */
typedef enum Engine {
    ENGINE_FAST,
    ENGINE_REFERENCE
} Engine;

/* The command line, checked. Strings point into argv. */
struct Arguments {
    int argc; /* as main got them */
    char **argv;
    const Command *command; /* NULL only with help or version */
    const char **operands;  /* owned */
    size_t operandCount;
    bool help, version, json, quiet;
    bool perTerm;         /* --per-term */
    unsigned aovs;        /* of --aov: a set of Aovs, one bit each */
    int color;            /* a ColorChoice */
    const char *output;   /* of -o; NULL: not given */
    const char *folder;   /* of --out; NULL: not given */
    const char *svg;      /* of --svg; NULL: not given */
    int width, height;    /* 0: not given */
    int samples, threads; /* 0: not given */
    int model;            /* a ShadingModel less MODEL_SIMPLE, or NOT_GIVEN */
    int engine;           /* an Engine, or NOT_GIVEN */
    int encoding;         /* an Encoding or NOT_GIVEN */
    int depthChoice;      /* NOT_GIVEN, 0: 8 bits, 1: 16 bits */
    Tolerance tolerance;  /* NAN where not given */
};

int runRender(const Arguments *arguments);
int runPov(const Arguments *arguments);
int runCompare(const Arguments *arguments);
int runDiff(const Arguments *arguments);
int runExplain(const Arguments *arguments);
int runCheck(const Arguments *arguments);
int runSchema(const Arguments *arguments);
int runWhy(const Arguments *arguments);

#endif
