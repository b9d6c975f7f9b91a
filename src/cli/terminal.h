/* terminal.h - everything the program says: messages to standard error, data to standard output.
 *
 * Messages never carry control characters from file names to the terminal. Printing is safe from any
 * thread; a progress bar is taken off the line before a message is put there.
 */
#ifndef ECLAIRAGE_CLI_TERMINAL_H
#define ECLAIRAGE_CLI_TERMINAL_H

#include "base/status.h"
#include "base/text.h"
#include "cli/command.h"

#include <stdbool.h>

/* Decide once whether notes are shown and where colour is used. Before it: notes, and no colour. */
void setUpTerminal(const Arguments *arguments);

/* Whether to colour what goes to standard error, and to standard output. */
bool colorOnErrors(void);
bool colorOnOutput(void);

/* Append a message as it is printed: "eclairage: error: ..." or, for a status with a place in file,
 * "file:12:3: error: ...". file may be NULL. appendSceneError names the scene in any case.
 * That the user interrupted the work is said by main, once, and not here. */
void appendError(Text *messages, const char *file, const Status *status);
void appendSceneError(Text *messages, const char *path, const Status *status);
void appendWarning(Text *messages, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Print what was appended, and free it. */
void printMessages(Text *messages);

/* Print one message at once; returns the status's code. */
int printError(const char *file, const Status *status);
void printWarning(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Print "eclairage: ...", unless --quiet was given. */
void printNote(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Write text as data to standard output and free it. The code is 0, or 4 after an error message. */
int printData(Text *data);

/* How a scene is named in messages: "-" is "<stdin>". */
const char *displayName(const char *path);

/* Begin to show how far the work called name has come, if standard error is a terminal and --quiet was not
 * given. Nothing is seen in the first second. */
void beginProgress(const char *name);

/* Say how much is done, in 0..1; callable from any thread, with context unused (RenderOptions). */
void showProgress(void *context, double done);

/* Take the bar away. */
void endProgress(void);

/* Seconds since some moment in the past; never goes backwards. */
double secondsNow(void);

/* Seconds since secondsNow() was start, in whole microseconds. */
double secondsSince(double start);

#endif
