/* files.h - whole files, safely.
 *
 * A file is written to a temporary file in the same folder and renamed when it is complete: a failed
 * or interrupted write leaves the old file as it was and nothing half-written beside it. Standard
 * output and special files (/dev/full, a pipe) are written directly.
 */
#ifndef ECLAIRAGE_BASE_FILES_H
#define ECLAIRAGE_BASE_FILES_H

#include "base/status.h"

#include <stddef.h>
#include <stdio.h>

/* Read a whole file; "-" is standard input. On success *data is a NUL-terminated buffer of *length
 * bytes (the NUL not counted) that the caller frees. A folder, a missing or an unreadable file and a
 * file over maxLength bytes are STATUS_IO with the file's name and the reason. */
Status readWholeFile(const char *path, size_t maxLength, char **data, size_t *length);

/* A file being written. Between openOutput and closeOutput or abandonOutput. */
typedef struct OutputFile {
    FILE *stream;        /* write here; check nothing until closeOutput */
    char *path;          /* the target; owned */
    char *temporaryPath; /* what is being written and renamed at the end; NULL: path itself */
} OutputFile;

/* Begin to write path ("-" is standard output). On failure nothing is open. The new file gets the
 * permissions the old one had, else those of the umask; a symbolic link is followed. */
Status openOutput(OutputFile *output, const char *path);

/* Finish: flush, check for every error of the whole writing, rename. On failure the temporary file is
 * gone and the target is as it was. Either way output is closed. */
Status closeOutput(OutputFile *output);

/* Give up: the temporary file is removed. */
void abandonOutput(OutputFile *output);

/* Write these bytes as the whole file. */
Status writeWholeFile(const char *path, const void *data, size_t length);

/* Make a new private folder under $TMPDIR or /tmp; *path is freed by the caller. */
Status makeTemporaryFolder(char **path);

/* Remove a folder and all in it, not following links; what cannot be removed is left. */
void removeFolder(const char *path);

/* Make a folder and its parents; an existing folder is fine. */
Status makeFolders(const char *path);

#endif
