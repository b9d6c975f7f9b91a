/* status.h - errors as values.
 *
 * Every function that can fail returns a Status: a code (which is also the program's exit code), a
 * message for a person, and, where there is one, a place. A Status owns nothing and may be copied.
 * Invariant: code == STATUS_OK exactly when message is empty.
 * Only main prints a Status or exits with it; nothing below main does either.
 */
#ifndef ECLAIRAGE_BASE_STATUS_H
#define ECLAIRAGE_BASE_STATUS_H

#include <stdbool.h>

/* The program's exit codes, each different from a crash. */
typedef enum StatusCode {
    STATUS_OK = 0,            /* done, or within tolerance */
    STATUS_DIFFERENT = 1,     /* compared, and different */
    STATUS_USAGE = 2,         /* the command line is wrong */
    STATUS_SCENE = 3,         /* the scene is invalid */
    STATUS_IO = 4,            /* a file could not be read or written, or memory ran out */
    STATUS_POVRAY = 5,        /* POV-Ray is missing, failed or timed out */
    STATUS_MISMATCH = 6,      /* two pictures of different size, depth or encoding */
    STATUS_INEXPRESSIBLE = 7, /* the scene cannot be expressed in POV-Ray */
    STATUS_INTERRUPTED = 130  /* stopped by the user */
} StatusCode;

enum {
    STATUS_MESSAGE_SIZE = 1024
};

typedef struct Status {
    StatusCode code;
    int line;   /* counted from 1; 0: no place */
    int column; /* counted from 1, in characters; 0: no place */
    char message[STATUS_MESSAGE_SIZE];
} Status;

/* The successful Status. */
Status statusOk(void);

/* A failed Status with a printf-style message (cut at STATUS_MESSAGE_SIZE - 1 bytes, never inside a
 * UTF-8 character). The message is one sentence without a final newline. */
Status statusError(StatusCode code, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The same with a place in a file that the message's reader knows. */
Status statusErrorAt(StatusCode code, int line, int column, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* "out of memory", as STATUS_IO. */
Status statusOutOfMemory(void);

/* "interrupted", as STATUS_INTERRUPTED. */
Status statusInterrupted(void);

static inline bool statusIsOk(const Status *status)
{
    return status->code == STATUS_OK;
}

#endif
