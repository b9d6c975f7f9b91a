/* file_checks.h - for tests that write files: what is in a folder, and whether it went well. */
#ifndef ECLAIRAGE_TESTS_FILE_CHECKS_H
#define ECLAIRAGE_TESTS_FILE_CHECKS_H

#include "base/status.h"

#include <stddef.h>

/* The entries of a folder but . and .. */
size_t countEntries(const char *path);

/* Fail with the message unless the status is ok. */
void assertOk(Status status);

#endif
