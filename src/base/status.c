/* status.c - errors as values; see status.h. */
#include "base/status.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static Status makeStatus(StatusCode code, int line, int column, const char *format, va_list arguments)
{
    Status status = {.code = code, .line = line, .column = column};
    int length = vsnprintf(status.message, sizeof status.message, format, arguments);
    /* Cut a message that is too long at the start of a UTF-8 character. */
    if (length >= (int)sizeof status.message) {
        size_t end = sizeof status.message - 1;
        while (end > 0 && ((unsigned char)status.message[end - 1] & 0xC0) == 0x80)
            end--;
        if (end > 0 && ((unsigned char)status.message[end - 1] & 0xC0) == 0xC0)
            end--;
        status.message[end] = '\0';
    }
    return status;
}

Status statusOk(void)
{
    /* Leave the rest of the message as it is: clearing it took a tenth of the time of reading an OBJ file. */
    Status status;
    status.code = STATUS_OK;
    status.line = status.column = 0;
    status.message[0] = '\0';
    return status;
}

Status statusError(StatusCode code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    Status status = makeStatus(code, 0, 0, format, arguments);
    va_end(arguments);
    return status;
}

Status statusErrorAt(StatusCode code, int line, int column, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    Status status = makeStatus(code, line, column, format, arguments);
    va_end(arguments);
    return status;
}

Status statusOutOfMemory(void)
{
    return statusError(STATUS_IO, "out of memory");
}

Status statusInterrupted(void)
{
    return statusError(STATUS_INTERRUPTED, "interrupted");
}
