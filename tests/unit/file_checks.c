/* file_checks.c - what is in a folder, and whether it went well; see file_checks.h. */
#include "file_checks.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

size_t countEntries(const char *path)
{
    DIR *entries = opendir(path);
    assert_non_null(entries);
    size_t count = 0;
    while (readdir(entries) != NULL)
        count++;
    closedir(entries);
    return count - 2; /* . and .. */
}

void assertOk(Status status)
{
    if (!statusIsOk(&status))
        fail_msg("%s", status.message);
}
