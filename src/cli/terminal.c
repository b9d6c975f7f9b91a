/* terminal.c - everything the program says; see terminal.h. */
#include "cli/terminal.h"

#include "base/files.h"

#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static bool errorColor, outputColor, quiet;

static bool isPlainTerminal(void)
{
    const char *term = getenv("TERM");
    return term == NULL || *term == '\0' || strcmp(term, "dumb") == 0;
}

/* --color decides; auto: a terminal that can, unless NO_COLOR is there and not empty (no-color.org). */
static bool wantsColor(int choice, int descriptor)
{
    if (choice != COLOR_AUTO)
        return choice == COLOR_ALWAYS;
    const char *noColor = getenv("NO_COLOR");
    return (noColor == NULL || *noColor == '\0') && isatty(descriptor) && !isPlainTerminal();
}

void setUpTerminal(const Arguments *arguments)
{
    quiet = arguments->quiet;
    errorColor = wantsColor(arguments->color, STDERR_FILENO);
    outputColor = wantsColor(arguments->color, STDOUT_FILENO);
}

bool colorOnErrors(void)
{
    return errorColor;
}

bool colorOnOutput(void)
{
    return outputColor;
}

const char *displayName(const char *path)
{
    return strcmp(path, "-") == 0 ? "<stdin>" : path;
}

/* ---- Progress ---- */

/* A bar such as
 *   rendering  [###########.........]  56 %  3 s left
 * drawn over itself with a carriage return. shown: a bar is on the line. */
static struct {
    pthread_mutex_t lock;
    bool active, shown;
    const char *name;
    double start, lastDrawn;
} progress = {.lock = PTHREAD_MUTEX_INITIALIZER};

static const double FIRST_SHOWN_AFTER = 1.0; /* seconds */
static const double REDRAWN_EVERY = 0.1;     /* seconds */

static const char ERASE_LINE[] = "\r\033[K";

enum {
    BAR_WIDTH = 24
};

double secondsNow(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

double secondsSince(double start)
{
    return round((secondsNow() - start) * 1e6) / 1e6;
}

void beginProgress(const char *name)
{
    pthread_mutex_lock(&progress.lock);
    progress.active = !quiet && isatty(STDERR_FILENO) && !isPlainTerminal();
    progress.name = name;
    progress.start = progress.lastDrawn = secondsNow();
    pthread_mutex_unlock(&progress.lock);
}

/* "4 s", "3 min 20 s", "2 h 05 min". */
static void appendDuration(Text *text, double seconds)
{
    long s = seconds < 1e9 ? (long)ceil(seconds) : 1000000000L;
    if (s < 60)
        textAppendFormat(text, "%ld s", s);
    else if (s < 3600)
        textAppendFormat(text, "%ld min %02ld s", s / 60, s % 60);
    else
        textAppendFormat(text, "%ld h %02ld min", s / 3600, s / 60 % 60);
}

static void drawBar(double done, double elapsed)
{
    Text text = {0};
    int filled = (int)(done * (double)BAR_WIDTH);
    textAppendFormat(&text, "%s%s [", ERASE_LINE, progress.name);
    for (int i = 0; i < BAR_WIDTH; i++)
        textAppend(&text, i < filled ? "#" : ".");
    textAppendFormat(&text, "] %3d %%", (int)(done * 100));
    if (done > 0) {
        textAppend(&text, "  ");
        appendDuration(&text, elapsed * (1 - done) / done);
        textAppend(&text, " left");
    }
    fputs(textString(&text), stderr);
    fflush(stderr);
    textFree(&text);
    progress.shown = true;
}

void showProgress(void *context, double done)
{
    (void)context;
    /* Leave the drawing to whoever has it already. */
    if (pthread_mutex_trylock(&progress.lock) != 0)
        return;
    if (progress.active) {
        double now = secondsNow();
        bool isDue = now - progress.start > FIRST_SHOWN_AFTER && now - progress.lastDrawn > REDRAWN_EVERY;
        if (isDue) {
            progress.lastDrawn = now;
            drawBar(fmin(fmax(done, 0), 1), now - progress.start);
        }
    }
    pthread_mutex_unlock(&progress.lock);
}

/* The lock is held. */
static void eraseBar(void)
{
    if (progress.shown) {
        fputs(ERASE_LINE, stderr);
        progress.shown = false;
    }
}

void endProgress(void)
{
    pthread_mutex_lock(&progress.lock);
    eraseBar();
    progress.active = false;
    pthread_mutex_unlock(&progress.lock);
}

/* ---- Messages ---- */

/* Append a message with every control character but tab replaced, so that no name of a file can command the
 * terminal or pass for a message of its own. Line feeds are kept where hasLines. */
static void appendHarmless(Text *text, const char *message, bool hasLines)
{
    for (const char *c = message; *c != '\0'; c++) {
        unsigned char byte = (unsigned char)*c;
        bool isControl = (byte < 0x20 && !(byte == '\n' && hasLines) && byte != '\t') || byte == 0x7F;
        textAppendBytes(text, isControl ? "?" : c, 1);
    }
}

static void appendLabel(Text *text, const char *label, const char *color)
{
    if (errorColor)
        textAppendFormat(text, "\033[1;%sm%s\033[0m: ", color, label);
    else
        textAppendFormat(text, "%s: ", label);
}

void appendError(Text *messages, const char *file, const Status *status)
{
    if (status->code == STATUS_INTERRUPTED)
        return;
    if (file != NULL && status->line > 0) {
        appendHarmless(messages, file, false);
        textAppendFormat(messages, ":%d:", status->line);
        if (status->column > 0)
            textAppendFormat(messages, "%d:", status->column);
        textAppend(messages, " ");
    } else {
        textAppend(messages, "eclairage: ");
    }
    appendLabel(messages, "error", "31");
    /* POV-Ray's own words are several lines. */
    appendHarmless(messages, status->message, status->code == STATUS_POVRAY);
    textAppend(messages, "\n");
}

void appendSceneError(Text *messages, const char *path, const Status *status)
{
    Status named = *status;
    if (status->line == 0)
        named = statusError(status->code, "%s: %s", displayName(path), status->message);
    appendError(messages, displayName(path), &named);
}

/* Append a printf-style text, made harmless. */
static void appendFormatted(Text *messages, const char *format, va_list values)
{
    char buffer[STATUS_MESSAGE_SIZE + 4096];
    vsnprintf(buffer, sizeof buffer, format, values);
    appendHarmless(messages, buffer, false);
    textAppend(messages, "\n");
}

void appendWarning(Text *messages, const char *format, ...)
{
    textAppend(messages, "eclairage: ");
    appendLabel(messages, "warning", "35");
    va_list values;
    va_start(values, format);
    appendFormatted(messages, format, values);
    va_end(values);
}

void printMessages(Text *messages)
{
    if (messages->length == 0 && !messages->failed)
        return;
    pthread_mutex_lock(&progress.lock);
    eraseBar();
    fputs(messages->failed ? "eclairage: error: out of memory\n" : textString(messages), stderr);
    pthread_mutex_unlock(&progress.lock);
    textFree(messages);
}

int printError(const char *file, const Status *status)
{
    Text messages = {0};
    appendError(&messages, file, status);
    printMessages(&messages);
    return (int)status->code;
}

void printWarning(const char *format, ...)
{
    Text messages = {0};
    textAppend(&messages, "eclairage: ");
    appendLabel(&messages, "warning", "35");
    va_list values;
    va_start(values, format);
    appendFormatted(&messages, format, values);
    va_end(values);
    printMessages(&messages);
}

void printNote(const char *format, ...)
{
    if (quiet)
        return;
    Text messages = {0};
    textAppend(&messages, "eclairage: ");
    va_list values;
    va_start(values, format);
    appendFormatted(&messages, format, values);
    va_end(values);
    printMessages(&messages);
}

int printData(Text *data)
{
    Status status = data->failed ? statusOutOfMemory() : writeWholeFile("-", textString(data), data->length);
    textFree(data);
    return statusIsOk(&status) ? 0 : printError(NULL, &status);
}
