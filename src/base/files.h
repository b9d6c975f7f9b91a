/* files.h - whole files, safely.
 *
 * A file is written to a temporary file in the same folder and renamed when it is complete: a failed
 * or interrupted write leaves the old file as it was and nothing half-written beside it. Standard
 * output and special files (/dev/full, a pipe) are written directly, and only when all is ready: an
 * abandoned output has sent nothing.
 * Waiting for a pipe ends within 0.1 s of requestCancel(). The caller ignores SIGPIPE (and SIGXFSZ,
 * where a limit on the size of files may hold); then a closed pipe is an ordinary error.
 */
#ifndef ECLAIRAGE_BASE_FILES_H
#define ECLAIRAGE_BASE_FILES_H

#include "base/status.h"
#include "base/text.h"

#include <stddef.h>
#include <stdio.h>

/* Read a whole file; "-" is standard input. On success *data is a NUL-terminated buffer of *length
 * bytes (the NUL not counted) that the caller frees. A folder, a missing or an unreadable file and a
 * file over maxLength bytes are STATUS_IO with the file's name and the reason; STATUS_INTERRUPTED when
 * cancelled. On failure *data and *length are untouched. */
Status readWholeFile(const char *path, size_t maxLength, char **data, size_t *length);

/* A file being written. Between openOutput and closeOutput or abandonOutput; not to be copied. */
typedef struct OutputFile {
    FILE *stream;        /* write here; check nothing until closeOutput. In memory: has no descriptor */
    char *path;          /* as given; owned */
    char *temporaryPath; /* what is written and renamed at the end; NULL: path itself; owned */
    /* Private. */
    char *target;   /* path with its symbolic links followed: what is replaced; owned */
    int descriptor; /* of the temporary file, the special file or standard output */
    char *memory;   /* what was written to stream so far; owned */
    size_t memoryLength;
} OutputFile;

/* Begin to write path ("-" or /dev/stdout is standard output). On failure nothing is open. The new file
 * gets the permissions the old one had, else those of the umask; a symbolic link is followed. A folder,
 * a write-protected file and a folder in which no file can be made are STATUS_IO with the path, the
 * reason and what to do. */
Status openOutput(OutputFile *output, const char *path);

/* Finish: write, check for every error of the whole writing, rename. On failure the temporary file is
 * gone and the target is as it was. STATUS_IO, or STATUS_INTERRUPTED when cancelled before all was
 * written. Either way output is closed. */
Status closeOutput(OutputFile *output);

/* Give up: the temporary file is removed. Does nothing to an output that is closed. */
void abandonOutput(OutputFile *output);

/* Write these bytes as the whole file: openOutput, write, closeOutput. */
Status writeWholeFile(const char *path, const void *data, size_t length);

/* Make a new private folder under $TMPDIR or /tmp; *path is absolute and freed by the caller. */
Status makeTemporaryFolder(char **path);

/* Remove a folder and all in it, not following links; what cannot be removed is left. Does nothing to
 * what is not a folder. Works after requestCancel() too. */
void removeFolder(const char *path);

/* The path of a file in a folder, freed by the caller; may have failed for want of memory. */
Text pathInFolder(const char *folder, const char *name);

/* Make a folder and its parents; an existing folder is fine. */
Status makeFolders(const char *path);

#endif
