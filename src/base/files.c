/* files.c - whole files, safely; see files.h.
 *
 * An output is collected in memory (open_memstream) and written with write(2) when it is complete, so
 * errno still says why a write failed, and a reader at a pipe's end never sees half a file.
 * Invariant: whoever holds temporaryPath removes that file or renames it.
 */
#define _XOPEN_SOURCE 700
#include "base/files.h"

#include "base/cancel.h"
#include "base/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <limits.h>
#include <poll.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum {
    WAIT_MILLISECONDS = 50, /* between two looks at cancelRequested() */
    WRITE_STEP = 1 << 20,   /* bytes between two looks at cancelRequested(), in a regular file */
    READ_STEP = 1 << 16,    /* bytes to read first where the length is not known */
    MOST_AT_ONCE = 1 << 24, /* bytes to read between two looks at cancelRequested() */
    LINK_LIMIT = 40,        /* symbolic links to follow, as Linux does */
    NAME_LIMIT = 200        /* bytes of a file's name that its temporary file's name repeats */
};

/* ---- Messages ------------------------------------------------------------------------------------ */

/* What went wrong and what to do about it, for a beginner. buffer is used where errno's own text is. */
static const char *explainError(int error, char *buffer, size_t size)
{
    switch (error) {
    case ENOENT:
        return "the file or its folder does not exist; check the spelling";
    case ENOTDIR:
        return "a part of this path is a file, not a folder; check the path";
    case EISDIR:
        return "it is a folder; give the name of a file";
    case EACCES:
    case EPERM:
        return "permission denied; check the permissions or choose another place";
    case EROFS:
        return "the disk is read-only; choose another place";
    case ENOSPC:
        return "no space left on the device; free some space or choose another place";
    case EDQUOT:
        return "your disk quota is used up; free some space or choose another place";
    case EFBIG:
        return "the file would be larger than allowed; raise the limit (ulimit -f) or choose another place";
    case EPIPE:
        return "the program that was reading it has ended; check that program";
    case EBADF:
        return "it is closed; open it or give the name of a file";
    case ENAMETOOLONG:
        return "the name is too long; choose a shorter one";
    case ELOOP:
        return "its symbolic links lead in a circle; remove one of them";
    default:
        if (strerror_r(error, buffer, size) != 0)
            snprintf(buffer, size, "error %d", error);
        return buffer;
    }
}

/* "cannot VERB 'PATH': reason", where "-" is the standard stream of that name. */
static Status fileError(const char *verb, const char *path, const char *standardStream, int error)
{
    if (error == ENOMEM)
        return statusOutOfMemory();
    char buffer[128];
    const char *reason = explainError(error, buffer, sizeof buffer);
    if (standardStream != NULL && strcmp(path, "-") == 0)
        return statusError(STATUS_IO, "cannot %s %s: %s", verb, standardStream, reason);
    return statusError(STATUS_IO, "cannot %s '%s': %s", verb, path, reason);
}

static Status readError(const char *path, int error)
{
    return fileError("read", path, "standard input", error);
}

static Status writeError(const char *path, int error)
{
    return fileError("write", path, "standard output", error);
}

/* ---- Descriptors --------------------------------------------------------------------------------- */

/* Wait until the descriptor is ready for events or has failed; false when cancelled before that. */
static bool waitUntilReady(int descriptor, short events)
{
    while (!cancelRequested()) {
        struct pollfd ready = {.fd = descriptor, .events = events};
        int count = poll(&ready, 1, WAIT_MILLISECONDS);
        if (count > 0 || (count < 0 && errno != EINTR))
            return true;
    }
    return false;
}

/* Open without waiting for the other end of a pipe; what waits later is waitUntilReady. Returns -1 and
 * sets errno on failure. */
static int openWithoutWaiting(const char *path, int flags)
{
    return open(path, flags | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

/* ---- Reading ------------------------------------------------------------------------------------- */

/* Bytes read so far, with room for more and the NUL. */
typedef struct Buffer {
    char *data;
    size_t length, capacity;
} Buffer;

/* Make room for a byte more than there are, and for the NUL. */
static bool growBuffer(Buffer *buffer, size_t firstCapacity)
{
    if (buffer->length + 2 <= buffer->capacity)
        return true;
    if (buffer->capacity > SIZE_MAX / 2)
        return false;
    size_t capacity = buffer->capacity > 0 ? buffer->capacity * 2 : firstCapacity;
    char *data = realloc(buffer->data, capacity);
    if (data == NULL)
        return false;
    useLargePages(data, capacity);
    buffer->data = data;
    buffer->capacity = capacity;
    return true;
}

static Status tooLarge(const char *path, size_t maxLength)
{
    if (strcmp(path, "-") == 0)
        return statusError(STATUS_IO, "cannot read standard input: it is larger than the limit of %zu bytes",
                           maxLength);
    return statusError(STATUS_IO, "cannot read '%s': it is larger than the limit of %zu bytes", path,
                       maxLength);
}

/* Read to the end of the descriptor. On failure buffer->data is still the caller's to free. */
static Status readDescriptor(int descriptor, const char *path, size_t maxLength, Buffer *buffer)
{
    /* Refuse what is known to be too large before reading it. (A folder fails at the first read.) */
    struct stat info;
    if (fstat(descriptor, &info) != 0)
        return readError(path, errno);
    bool regular = S_ISREG(info.st_mode);
    if (regular && (uintmax_t)info.st_size > maxLength)
        return tooLarge(path, maxLength);

    size_t firstCapacity = regular && info.st_size > 0 ? (size_t)info.st_size + 2 : READ_STEP;
    for (;;) {
        if (!growBuffer(buffer, firstCapacity))
            return statusOutOfMemory();
        if (cancelRequested() || (!regular && !waitUntilReady(descriptor, POLLIN)))
            return statusInterrupted();
        size_t room = buffer->capacity - 1 - buffer->length;
        ssize_t count =
            read(descriptor, buffer->data + buffer->length, room < MOST_AT_ONCE ? room : MOST_AT_ONCE);
        if (count == 0)
            break;
        if (count < 0 && errno != EINTR && errno != EAGAIN)
            return readError(path, errno);
        if (count > 0)
            buffer->length += (size_t)count;
        if (buffer->length > maxLength)
            return tooLarge(path, maxLength);
    }
    buffer->data[buffer->length] = '\0';
    return statusOk();
}

Status readWholeFile(const char *path, size_t maxLength, char **data, size_t *length)
{
    bool standardInput = strcmp(path, "-") == 0;
    int descriptor = standardInput ? STDIN_FILENO : openWithoutWaiting(path, O_RDONLY);
    if (descriptor < 0)
        return readError(path, errno);
    Buffer buffer = {0};
    Status status = readDescriptor(descriptor, path, maxLength, &buffer);
    if (!standardInput)
        close(descriptor);
    if (!statusIsOk(&status)) {
        free(buffer.data);
        return status;
    }
    *data = buffer.data;
    *length = buffer.length;
    return status;
}

/* ---- Writing ------------------------------------------------------------------------------------- */

/* Find what path leads to through its symbolic links, the last of which may lead to nothing yet.
 * Returns an errno value, 0 on success. */
static int followLinks(const char *path, char target[PATH_MAX])
{
    if (strlen(path) >= PATH_MAX)
        return ENAMETOOLONG;
    strcpy(target, path);
    for (int i = 0; i < LINK_LIMIT; i++) {
        char link[PATH_MAX];
        ssize_t length = readlink(target, link, sizeof link - 1);
        if (length < 0)
            return errno == EINVAL || errno == ENOENT ? 0 : errno;
        link[length] = '\0';
        /* Put a relative link behind the folder that it lies in. */
        char *slash = strrchr(target, '/');
        char *start = link[0] == '/' || slash == NULL ? target : slash + 1;
        if ((size_t)(start - target) + (size_t)length >= PATH_MAX)
            return ENAMETOOLONG;
        strcpy(start, link);
    }
    return ELOOP;
}

/* Make a new file of a name not used yet in target's folder: ".NAME.XXXXXX". Unlike after mkstemp its
 * permissions are those of the umask. Returns an errno value, 0 on success. */
static int makeTemporaryFile(OutputFile *output)
{
    static atomic_uint counter;
    const char *slash = strrchr(output->target, '/');
    const char *name = slash != NULL ? slash + 1 : output->target;
    int folderLength = (int)(name - output->target);
    size_t size = (size_t)folderLength + NAME_LIMIT + 16;
    output->temporaryPath = malloc(size);
    if (output->temporaryPath == NULL)
        return ENOMEM;
    int error = EEXIST;
    for (int attempt = 0; attempt < 100 && error == EEXIST; attempt++) {
        struct timespec now;
        clock_gettime(CLOCK_REALTIME, &now);
        unsigned number = (unsigned)now.tv_nsec ^ ((unsigned)getpid() << 8) ^
                          (atomic_fetch_add(&counter, 1u) * 2654435761u);
        snprintf(output->temporaryPath, size, "%.*s.%.*s.%06x", folderLength, output->target, NAME_LIMIT,
                 name, number & 0xFFFFFFu);
        output->descriptor = open(output->temporaryPath, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        error = output->descriptor >= 0 ? 0 : errno;
    }
    if (error != 0) {
        free(output->temporaryPath);
        output->temporaryPath = NULL;
    }
    return error;
}

/* Give the new file the old one's owner, where we may, and its permissions. */
static void copyPermissions(int descriptor, const struct stat *old)
{
    struct stat now;
    if (fstat(descriptor, &now) == 0 && (now.st_uid != old->st_uid || now.st_gid != old->st_gid) &&
        fchown(descriptor, old->st_uid, old->st_gid) != 0) {
        /* Only root may; the file is ours then. */
    }
    fchmod(descriptor, old->st_mode & 0777);
}

/* Open a pipe or a device that exists. A named pipe is waited for until somebody reads it. */
static int openSpecialFile(OutputFile *output, mode_t mode)
{
    for (;;) {
        output->descriptor = openWithoutWaiting(output->path, O_WRONLY);
        if (output->descriptor >= 0)
            return 0;
        if (errno != EINTR && !(errno == ENXIO && S_ISFIFO(mode)))
            return errno;
        if (cancelRequested())
            return ECANCELED;
        nanosleep(&(struct timespec){.tv_nsec = 10 * 1000 * 1000}, NULL);
    }
}

/* Open what the bytes will go to. Returns an errno value, 0 on success. */
static int openDescriptor(OutputFile *output)
{
    /* Standard output: what was printed before comes first. */
    if (strcmp(output->path, "-") == 0 || strcmp(output->path, "/dev/stdout") == 0) {
        if (fflush(stdout) != 0)
            return errno;
        output->descriptor = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
        return output->descriptor >= 0 ? 0 : errno;
    }

    /* A special file is written itself; a folder cannot be opened. */
    struct stat old;
    bool exists = stat(output->path, &old) == 0;
    if (!exists && errno != ENOENT)
        return errno;
    if (exists && !S_ISREG(old.st_mode))
        return openSpecialFile(output, old.st_mode);

    /* A regular file is replaced, though not one that is write-protected. */
    if (exists && access(output->path, W_OK) != 0)
        return errno;
    char target[PATH_MAX];
    int error = followLinks(output->path, target);
    if (error != 0)
        return error;
    size_t length = strlen(target);
    if (length == 0)
        return ENOENT;
    if (target[length - 1] == '/')
        return EISDIR;
    output->target = strdup(target);
    if (output->target == NULL)
        return ENOMEM;
    error = makeTemporaryFile(output);
    if (error == 0 && exists)
        copyPermissions(output->descriptor, &old);
    return error;
}

/* Write all bytes. A pipe is given no more than it takes at once, so that waiting for it can be
 * interrupted. Returns an errno value: 0 on success, ECANCELED when cancelled. */
static int writeBytes(int descriptor, const char *data, size_t length)
{
    struct stat info;
    bool regular = fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode);
    size_t step = regular ? WRITE_STEP : PIPE_BUF;
    while (length > 0) {
        if (cancelRequested() || (!regular && !waitUntilReady(descriptor, POLLOUT)))
            return ECANCELED;
        ssize_t count = write(descriptor, data, length < step ? length : step);
        if (count < 0 && errno != EINTR && errno != EAGAIN)
            return errno;
        if (count > 0) {
            data += count;
            length -= (size_t)count;
        }
    }
    return 0;
}

/* Close and free everything; the temporary file goes unless it was renamed. */
static void releaseOutput(OutputFile *output)
{
    if (output->stream != NULL)
        fclose(output->stream);
    if (output->descriptor >= 0)
        close(output->descriptor);
    if (output->temporaryPath != NULL)
        unlink(output->temporaryPath);
    free(output->path);
    free(output->temporaryPath);
    free(output->target);
    free(output->memory);
    *output = (OutputFile){.descriptor = -1};
}

/* The Status of an errno value, after which the output is closed. */
static Status finishOutput(OutputFile *output, int error)
{
    Status status = statusOk();
    if (error == ECANCELED)
        status = statusInterrupted();
    else if (error == ENOENT && output->path != NULL && output->path[0] == '\0')
        status = statusError(STATUS_IO, "cannot write a file without a name; give the name of a file");
    else if (error == ENOENT)
        status = statusError(STATUS_IO,
                             "cannot write '%s': its folder does not exist; create the folder or "
                             "choose another",
                             output->path);
    else if (error != 0 && output->path != NULL)
        status = writeError(output->path, error);
    else if (error != 0)
        status = statusOutOfMemory();
    releaseOutput(output);
    return status;
}

/* Begin without a stream: writeWholeFile needs none. Returns an errno value. */
static int beginOutput(OutputFile *output, const char *path)
{
    *output = (OutputFile){.descriptor = -1};
    output->path = strdup(path);
    return output->path != NULL ? openDescriptor(output) : ENOMEM;
}

/* Write the bytes, close and rename. Returns an errno value. */
static int commitOutput(OutputFile *output, const void *data, size_t length)
{
    int error = writeBytes(output->descriptor, data, length);
    /* Some file systems say only now that the disk was full. */
    if (close(output->descriptor) != 0 && error == 0 && errno != EINTR)
        error = errno;
    output->descriptor = -1;
    if (error == 0 && output->temporaryPath != NULL) {
        if (rename(output->temporaryPath, output->target) != 0)
            return errno;
        free(output->temporaryPath);
        output->temporaryPath = NULL;
    }
    return error;
}

Status openOutput(OutputFile *output, const char *path)
{
    int error = beginOutput(output, path);
    if (error != 0)
        return finishOutput(output, error);
    output->stream = open_memstream(&output->memory, &output->memoryLength);
    return output->stream != NULL ? statusOk() : finishOutput(output, ENOMEM);
}

Status closeOutput(OutputFile *output)
{
    /* A stream in memory fails only when memory runs out. */
    bool failed = ferror(output->stream) != 0;
    failed = fclose(output->stream) != 0 || failed;
    output->stream = NULL;
    int error = failed ? ENOMEM : commitOutput(output, output->memory, output->memoryLength);
    return finishOutput(output, error);
}

void abandonOutput(OutputFile *output)
{
    if (output->stream != NULL)
        releaseOutput(output);
}

Status writeWholeFile(const char *path, const void *data, size_t length)
{
    OutputFile output;
    int error = beginOutput(&output, path);
    if (error == 0)
        error = commitOutput(&output, data, length);
    return finishOutput(&output, error);
}

/* ---- Folders ------------------------------------------------------------------------------------- */

Status makeTemporaryFolder(char **path)
{
    const char *parent = getenv("TMPDIR");
    if (parent == NULL || parent[0] == '\0')
        parent = "/tmp";
    /* An absolute name stays right in a process that works in another folder. */
    char *absolute = realpath(parent, NULL);
    static const char suffix[] = "/eclairage-XXXXXX";
    size_t size = absolute != NULL ? strlen(absolute) + sizeof suffix : 0;
    char *template = absolute != NULL ? malloc(size) : NULL;
    int error = absolute != NULL ? ENOMEM : errno;
    if (template != NULL) {
        snprintf(template, size, "%s%s", strcmp(absolute, "/") == 0 ? "" : absolute, suffix);
        error = mkdtemp(template) != NULL ? 0 : errno;
    }
    free(absolute);
    if (error == 0) {
        *path = template;
        return statusOk();
    }
    free(template);
    if (error == ENOMEM)
        return statusOutOfMemory();
    char buffer[128];
    return statusError(STATUS_IO, "cannot make a temporary folder in '%s': %s (TMPDIR says where)", parent,
                       explainError(error, buffer, sizeof buffer));
}

/* What nftw calls for every entry, a folder after what is in it. */
static int removeEntry(const char *path, const struct stat *info, int type, struct FTW *place)
{
    (void)info;
    (void)type;
    (void)place;
    remove(path);
    return 0;
}

void removeFolder(const char *path)
{
    struct stat info;
    if (lstat(path, &info) == 0 && S_ISDIR(info.st_mode))
        nftw(path, removeEntry, 16, FTW_DEPTH | FTW_PHYS);
}

static bool isFolder(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

Text pathInFolder(const char *folder, const char *name)
{
    Text path = {0};
    size_t length = strlen(folder);
    textAppendFormat(&path, "%s%s%s", folder, length > 0 && folder[length - 1] == '/' ? "" : "/", name);
    return path;
}

/* Make one folder whose parent exists. Returns an errno value. */
static int makeFolder(const char *path)
{
    if (isFolder(path) || mkdir(path, 0777) == 0)
        return 0;
    int error = errno;
    /* Another process may have made it in between. */
    if (error == EEXIST)
        return isFolder(path) ? 0 : ENOTDIR;
    return error;
}

Status makeFolders(const char *path)
{
    char *part = strdup(path);
    if (part == NULL)
        return statusOutOfMemory();
    int error = part[0] == '\0' ? ENOENT : 0;
    /* End the path at each slash in turn: a, a/b, a/b/c. */
    for (char *end = part; *end != '\0' && error == 0;) {
        end += strspn(end, "/");
        end += strcspn(end, "/");
        char separator = *end;
        *end = '\0';
        error = makeFolder(part);
        *end = separator;
    }
    free(part);
    return error == 0 ? statusOk() : fileError("make the folder", path, NULL, error);
}
