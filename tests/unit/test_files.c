/* test_files.c - whole files: what is written is there, what fails leaves no trace.
 *
 * Everything happens in a private folder, whose entries are listed after each failure. The tests hold
 * for root too, who may write anywhere: what cannot be written lies below a regular file.
 */
#define _XOPEN_SOURCE 700
#include "base/cancel.h"
#include "base/files.h"
#include "file_checks.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static char *folder; /* where a test works; the working folder */

static int enterFolder(void **state)
{
    (void)state;
    Status status = makeTemporaryFolder(&folder);
    return statusIsOk(&status) ? chdir(folder) : 1;
}

static int leaveFolder(void **state)
{
    (void)state;
    if (chdir("/") != 0)
        return 1;
    removeFolder(folder);
    struct stat info;
    int left = stat(folder, &info) == 0;
    free(folder);
    return left;
}

/* A failure of this code whose message holds both texts. */
static void assertFails(Status status, StatusCode code, const char *first, const char *second)
{
    if (status.code != code || strstr(status.message, first) == NULL ||
        strstr(status.message, second) == NULL || strchr(status.message, '\n') != NULL)
        fail_msg("code %d, message '%s'; expected code %d with '%s' and '%s'", (int)status.code,
                 status.message, (int)code, first, second);
}

static void assertHolds(const char *path, const char *expected)
{
    char *data;
    size_t length;
    assertOk(readWholeFile(path, 1000, &data, &length));
    assert_int_equal(length, strlen(expected));
    assert_string_equal(data, expected);
    free(data);
}

static Status writeText(const char *path, const char *text)
{
    return writeWholeFile(path, text, strlen(text));
}

static mode_t permissions(const char *path)
{
    struct stat info;
    assert_int_equal(lstat(path, &info), 0);
    return info.st_mode & 07777;
}

/* ---- Reading ---- */

static void readsEveryLength(void **state)
{
    (void)state;
    static const size_t lengths[] = {0, 1, 2, 3, 4095, 65535, 65536, 65537, 300000};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        size_t length = lengths[i];
        char *bytes = malloc(length + 1);
        assert_non_null(bytes);
        for (size_t j = 0; j < length; j++)
            bytes[j] = (char)(j * 7 + j / 256); /* zeros among them */
        assertOk(writeWholeFile("f", bytes, length));
        char *data;
        size_t readLength;
        /* The limit is the last length that is allowed. */
        assertOk(readWholeFile("f", length, &data, &readLength));
        assert_int_equal(readLength, length);
        assert_memory_equal(data, bytes, length);
        assert_int_equal(data[length], 0);
        free(data);
        if (length > 0)
            assertFails(readWholeFile("f", length - 1, &data, &readLength), STATUS_IO, "'f'", "larger");
        free(bytes);
    }
}

static void refusesToRead(void **state)
{
    (void)state;
    assertOk(writeText("file", "x"));
    char *data = NULL;
    size_t length = 77;
    assertFails(readWholeFile("missing", 10, &data, &length), STATUS_IO, "'missing'", "does not exist");
    assertFails(readWholeFile("", 10, &data, &length), STATUS_IO, "''", "does not exist");
    assertFails(readWholeFile(".", 10, &data, &length), STATUS_IO, "'.'", "folder");
    assertFails(readWholeFile("file/x", 10, &data, &length), STATUS_IO, "'file/x'", "not a folder");
    assertFails(readWholeFile("/dev/zero", 100000, &data, &length), STATUS_IO, "/dev/zero", "larger");
    /* A file of 1 TB, all holes, is refused unread. */
    assert_int_equal(truncate("file", (off_t)1 << 40), 0);
    assertFails(readWholeFile("file", 10, &data, &length), STATUS_IO, "'file'", "larger");
    assert_null(data);
    assert_int_equal(length, 77);
}

/* What a thread writes to a named pipe, in two parts. */
static void *feedPipe(void *path)
{
    int descriptor = open(path, O_WRONLY);
    if (descriptor >= 0) {
        (void)!write(descriptor, "one ", 4);
        nanosleep(&(struct timespec){.tv_nsec = 80000000}, NULL);
        (void)!write(descriptor, "two", 3);
        close(descriptor);
    }
    return NULL;
}

static void readsPipes(void **state)
{
    (void)state;
    char path[] = "pipe";
    assert_int_equal(mkfifo(path, 0600), 0);
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, feedPipe, path), 0);
    assertHolds(path, "one two");
    pthread_join(thread, NULL);

    /* A pipe's length is not known before: the limit holds all the same. */
    char *data = NULL;
    size_t length = 0;
    assert_int_equal(pthread_create(&thread, NULL, feedPipe, path), 0);
    assertFails(readWholeFile(path, 6, &data, &length), STATUS_IO, "'pipe'", "larger");
    pthread_join(thread, NULL);
    assert_int_equal(pthread_create(&thread, NULL, feedPipe, path), 0);
    assertOk(readWholeFile(path, 7, &data, &length));
    pthread_join(thread, NULL);
    free(data);

    /* Standard input. */
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(write(ends[1], "typed", 5), 5);
    close(ends[1]);
    int saved = dup(STDIN_FILENO);
    dup2(ends[0], STDIN_FILENO);
    close(ends[0]);
    assertHolds("-", "typed");
    close(STDIN_FILENO);
    assertFails(readWholeFile("-", 10, &data, &length), STATUS_IO, "standard input", "closed");
    if (saved >= 0) {
        dup2(saved, STDIN_FILENO);
        close(saved);
    }
}

/* ---- Writing ---- */

static void writesAndReplaces(void **state)
{
    (void)state;
    umask(027);
    assertOk(writeText("f", "first"));
    assert_int_equal(permissions("f"), 0640);
    assertHolds("f", "first");
    assert_int_equal(chmod("f", 0604), 0);
    assertOk(writeText("f", "second, longer"));
    assert_int_equal(permissions("f"), 0604);
    assertHolds("f", "second, longer");
    assertOk(writeText("f", ""));
    assertHolds("f", "");
    umask(022);

    /* The longest name there is: the temporary file's must fit too. */
    char name[NAME_MAX + 1];
    memset(name, 'n', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    assertOk(writeText(name, "long"));
    assertHolds(name, "long");
    assert_int_equal(countEntries("."), 2);
}

static void keepsTheOldFileUntilClosed(void **state)
{
    (void)state;
    assertOk(writeText("f", "old"));
    OutputFile output;
    assertOk(openOutput(&output, "f"));
    assert_non_null(output.temporaryPath);
    assert_int_equal(strncmp(output.temporaryPath, ".f.", 3), 0);
    fputs("new", output.stream);
    fflush(output.stream);
    assertHolds("f", "old");
    assert_int_equal(countEntries("."), 2);
    assertOk(closeOutput(&output));
    assertHolds("f", "new");
    assert_int_equal(countEntries("."), 1);
    abandonOutput(&output); /* harmless now */
    assertHolds("f", "new");

    assertOk(openOutput(&output, "f"));
    fputs("never", output.stream);
    abandonOutput(&output);
    assertHolds("f", "new");
    assert_int_equal(countEntries("."), 1);

    /* The folder goes while the file is written. */
    assertOk(makeFolders("d"));
    assertOk(openOutput(&output, "d/f"));
    fputs("lost", output.stream);
    removeFolder("d");
    assertFails(closeOutput(&output), STATUS_IO, "'d/f'", "folder");
    assert_int_equal(countEntries("."), 1);

    /* The target becomes a folder while the file is written. */
    assertOk(openOutput(&output, "g"));
    assertOk(makeFolders("g/inner"));
    assertFails(closeOutput(&output), STATUS_IO, "'g'", "folder");
    assert_int_equal(countEntries("."), 2);
    assert_int_equal(countEntries("g"), 1);
}

static void followsLinks(void **state)
{
    (void)state;
    assertOk(makeFolders("d"));
    assertOk(writeText("d/target", "old"));
    assert_int_equal(symlink("target", "d/second"), 0);
    assert_int_equal(symlink("d/second", "first"), 0);
    assertOk(writeText("first", "new"));
    assertHolds("d/target", "new");
    struct stat info;
    assert_int_equal(lstat("first", &info), 0);
    assert_true(S_ISLNK(info.st_mode));
    assert_int_equal(lstat("d/second", &info), 0);
    assert_true(S_ISLNK(info.st_mode));
    assert_int_equal(countEntries("d"), 2);

    /* A link to nothing yet makes what it leads to; an absolute one too. */
    char absolute[PATH_MAX];
    assert_non_null(getcwd(absolute, sizeof absolute - 20));
    strcat(absolute, "/d/made");
    assert_int_equal(symlink(absolute, "dangling"), 0);
    assertOk(writeText("dangling", "made"));
    assertHolds("d/made", "made");

    assert_int_equal(symlink("circle", "circle"), 0);
    assertFails(writeText("circle", "x"), STATUS_IO, "'circle'", "circle");
    assert_int_equal(symlink("nowhere/x", "astray"), 0);
    assertFails(writeText("astray", "x"), STATUS_IO, "'astray'", "does not exist");
    assert_int_equal(countEntries("d"), 3);
    assert_int_equal(countEntries("."), 5);
}

static void refusesToWrite(void **state)
{
    (void)state;
    assertOk(makeFolders("d"));
    assertOk(writeText("file", "kept"));
    assertFails(writeText("d", "x"), STATUS_IO, "'d'", "folder");
    assertFails(writeText("new/", "x"), STATUS_IO, "'new/'", "folder");
    assertFails(writeText("", "x"), STATUS_IO, "without a name", "give");
    assertFails(writeText("no/x", "x"), STATUS_IO, "'no/x'", "create the folder");
    assertFails(writeText("file/x", "x"), STATUS_IO, "'file/x'", "not a folder");
    char name[NAME_MAX + 2];
    memset(name, 'n', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    assertFails(writeText(name, "x"), STATUS_IO, "nnn", "too long");
    /* Opening already says so, before the work of writing. */
    OutputFile output;
    assertFails(openOutput(&output, "d"), STATUS_IO, "'d'", "folder");
    assertFails(openOutput(&output, "file/x"), STATUS_IO, "'file/x'", "not a folder");
    abandonOutput(&output); /* harmless */
    assertHolds("file", "kept");
    assert_int_equal(countEntries("."), 2);
    assert_int_equal(countEntries("d"), 0);
    if (geteuid() != 0) {
        assert_int_equal(chmod("file", 0444), 0);
        assertFails(writeText("file", "x"), STATUS_IO, "'file'", "permission");
        assert_int_equal(chmod("d", 0555), 0);
        assertFails(writeText("d/x", "x"), STATUS_IO, "'d/x'", "permission");
        chmod("d", 0755);
    }
}

/* Write to a device. It must be written itself: where a temporary file was made to replace it, stop, or
 * root would lose the device. */
static Status writeSpecial(const char *path, const char *text)
{
    OutputFile output;
    Status status = openOutput(&output, path);
    assertOk(status);
    if (output.temporaryPath != NULL) {
        abandonOutput(&output);
        fail_msg("'%s' would be replaced", path);
    }
    fputs(text, output.stream);
    return closeOutput(&output);
}

static void keepsTheOldFileWhenTheDiskIsFull(void **state)
{
    (void)state;
    assertFails(writeSpecial("/dev/full", "x"), STATUS_IO, "'/dev/full'", "no space");
    assertOk(writeSpecial("/dev/full", ""));
    assertOk(writeSpecial("/dev/null", "x"));
    assert_int_equal(symlink("/dev/full", "link"), 0);
    assertFails(writeSpecial("link", "x"), STATUS_IO, "'link'", "no space");

    /* A regular file that cannot grow: the limit on file sizes, for which root is no exception. */
    assertOk(writeText("f", "old"));
    struct rlimit old;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &old), 0);
    struct rlimit small = {.rlim_cur = 4096, .rlim_max = old.rlim_max};
    char *bytes = calloc(3, 4096);
    assert_non_null(bytes);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    Status status = writeWholeFile("f", bytes, (size_t)3 * 4096);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &old), 0);
    free(bytes);
    assertFails(status, STATUS_IO, "'f'", "larger than allowed");
    assertHolds("f", "old");
    assert_int_equal(countEntries("."), 2);
}

/* Do what a test says in a process of its own whose standard output is the descriptor; 0: it passed. */
static int inChild(bool (*act)(void), int standardOutput)
{
    fflush(stdout);
    fflush(stderr);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        if (standardOutput >= 0)
            dup2(standardOutput, STDOUT_FILENO);
        else
            close(STDOUT_FILENO);
        _exit(act() ? 0 : 1);
    }
    int result;
    assert_int_equal(waitpid(child, &result, 0), child);
    return result;
}

static bool writeToStandardOutput(void)
{
    printf("before, ");
    Status status = writeText("-", "data, ");
    if (!statusIsOk(&status))
        return false;
    OutputFile output;
    status = openOutput(&output, "/dev/stdout");
    if (!statusIsOk(&status))
        return false;
    fputs("more, ", output.stream);
    status = closeOutput(&output);
    printf("after");
    return statusIsOk(&status) && fflush(stdout) == 0;
}

static bool seeThatNobodyReads(void)
{
    Status status = writeText("-", "data");
    return status.code == STATUS_IO && strstr(status.message, "standard output") != NULL &&
           strstr(status.message, "has ended") != NULL;
}

static bool seeThatItIsClosed(void)
{
    Status status = writeText("-", "data");
    return status.code == STATUS_IO && strstr(status.message, "standard output: it is closed") != NULL;
}

static void writesToStandardOutput(void **state)
{
    (void)state;
    int descriptor = open("out", O_RDWR | O_CREAT, 0600);
    assert_true(descriptor >= 0);
    assert_int_equal(inChild(writeToStandardOutput, descriptor), 0);
    close(descriptor);
    assertHolds("out", "before, data, more, after");

    int ends[2];
    assert_int_equal(pipe(ends), 0);
    close(ends[0]);
    assert_int_equal(inChild(seeThatNobodyReads, ends[1]), 0);
    close(ends[1]);
    assert_int_equal(inChild(seeThatItIsClosed, -1), 0);
}

static void *drainPipe(void *path)
{
    int descriptor = open(path, O_RDONLY);
    char buffer[5000];
    size_t length = 0;
    ssize_t count = 1;
    while (descriptor >= 0 && (count = read(descriptor, buffer, sizeof buffer)) > 0)
        length += (size_t)count;
    close(descriptor);
    return (void *)(uintptr_t)length;
}

static void writesToNamedPipes(void **state)
{
    (void)state;
    char path[] = "pipe";
    assert_int_equal(mkfifo(path, 0600), 0);
    char *bytes = calloc(1, 300000); /* more than a pipe holds */
    assert_non_null(bytes);
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, drainPipe, path), 0);
    assertOk(writeWholeFile(path, bytes, 300000));
    void *length;
    pthread_join(thread, &length);
    assert_int_equal((uintptr_t)length, 300000);
    free(bytes);
    struct stat info;
    assert_int_equal(stat(path, &info), 0);
    assert_true(S_ISFIFO(info.st_mode));
}

/* ---- Cancelling: each in a process of its own, since the flag is never cleared ---- */

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

static void *cancelSoon(void *unused)
{
    nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
    requestCancel();
    return unused;
}

/* Cancelled before the rename: the old file stays. */
static bool cancelWriting(void)
{
    OutputFile output;
    Status status = openOutput(&output, "f");
    if (!statusIsOk(&status))
        return false;
    fputs("new", output.stream);
    requestCancel();
    status = closeOutput(&output);
    return status.code == STATUS_INTERRUPTED;
}

/* Nobody reads the pipe: writing waits, first for a reader to come and then for room. */
static bool cancelWaiting(void)
{
    static char bytes[300000];
    pthread_t thread;
    double start = seconds();
    if (pthread_create(&thread, NULL, cancelSoon, NULL) != 0)
        return false;
    Status noReader = writeWholeFile("pipe", bytes, sizeof bytes);
    pthread_join(thread, NULL);
    return noReader.code == STATUS_INTERRUPTED && seconds() - start < 1.0;
}

static bool cancelFullPipe(void)
{
    static char bytes[300000];
    pthread_t thread;
    double start = seconds();
    if (pthread_create(&thread, NULL, cancelSoon, NULL) != 0)
        return false;
    Status status = writeWholeFile("-", bytes, sizeof bytes);
    pthread_join(thread, NULL);
    return status.code == STATUS_INTERRUPTED && seconds() - start < 1.0;
}

static bool cancelReading(void)
{
    pthread_t thread;
    double start = seconds();
    if (pthread_create(&thread, NULL, cancelSoon, NULL) != 0)
        return false;
    char *data;
    size_t length;
    Status status = readWholeFile("pipe", 100, &data, &length);
    pthread_join(thread, NULL);
    return status.code == STATUS_INTERRUPTED && seconds() - start < 1.0;
}

static void stopsWhenCancelled(void **state)
{
    (void)state;
    assertOk(writeText("f", "old"));
    assert_int_equal(mkfifo("pipe", 0600), 0);
    assert_int_equal(inChild(cancelWriting, STDERR_FILENO), 0);
    assertHolds("f", "old");
    assert_int_equal(inChild(cancelWaiting, STDERR_FILENO), 0);
    assert_int_equal(inChild(cancelReading, STDERR_FILENO), 0);
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(inChild(cancelFullPipe, ends[1]), 0);
    close(ends[0]);
    close(ends[1]);
    assert_int_equal(countEntries("."), 2);
}

/* ---- Folders ---- */

static void makesFolders(void **state)
{
    (void)state;
    assertOk(makeFolders("a/b//c/"));
    assertOk(makeFolders("a/b/c"));
    assertOk(makeFolders("a/../a/./d"));
    assertOk(makeFolders("/"));
    assertOk(makeFolders("."));
    assert_int_equal(countEntries("a"), 2);
    char absolute[PATH_MAX];
    assert_non_null(getcwd(absolute, sizeof absolute - 20));
    strcat(absolute, "/x/y");
    assertOk(makeFolders(absolute));
    assertOk(writeText("x/y/f", "f"));
    assertFails(makeFolders("x/y/f"), STATUS_IO, "'x/y/f'", "not a folder");
    assertFails(makeFolders("x/y/f/g"), STATUS_IO, "'x/y/f/g'", "not a folder");
    assertFails(makeFolders(""), STATUS_IO, "''", "does not exist");
    assertHolds("x/y/f", "f");
    assert_int_equal(symlink("x", "link"), 0);
    assertOk(makeFolders("link/z"));
    assert_int_equal(countEntries("x"), 2);
}

static void removesFolders(void **state)
{
    (void)state;
    assertOk(makeFolders("kept"));
    assertOk(writeText("kept/f", "kept"));
    assertOk(makeFolders("d/e/f"));
    assertOk(writeText("d/.hidden", "x"));
    assertOk(writeText("d/e/x", "x"));
    assert_int_equal(symlink("../kept", "d/link"), 0);
    assert_int_equal(symlink("nowhere", "d/e/dangling"), 0);
    assert_int_equal(mkfifo("d/pipe", 0600), 0);
    removeFolder("d");
    assert_int_equal(countEntries("."), 1);
    assertHolds("kept/f", "kept");

    /* What is not a folder stays. */
    assert_int_equal(symlink("kept", "link"), 0);
    removeFolder("link");
    removeFolder("kept/f");
    removeFolder("missing");
    assertHolds("link/f", "kept");
}

static void makesTemporaryFolders(void **state)
{
    (void)state;
    char *saved = getenv("TMPDIR") != NULL ? strdup(getenv("TMPDIR")) : NULL;
    assertOk(makeFolders("t"));
    char *first;
    char *second;
    setenv("TMPDIR", "t", 1);
    assertOk(makeTemporaryFolder(&first));
    assertOk(makeTemporaryFolder(&second));
    assert_string_not_equal(first, second);
    assert_int_equal(first[0], '/');
    assert_int_equal(permissions(first), 0700);
    assert_int_equal(countEntries("t"), 2);
    removeFolder(first);
    removeFolder(second);
    free(first);
    free(second);
    setenv("TMPDIR", "missing", 1);
    assertFails(makeTemporaryFolder(&first), STATUS_IO, "'missing'", "TMPDIR");
    setenv("TMPDIR", "", 1);
    assertOk(makeTemporaryFolder(&first));
    assert_int_equal(strncmp(first, "/tmp/", 5), 0);
    removeFolder(first);
    free(first);
    if (saved != NULL)
        setenv("TMPDIR", saved, 1);
    else
        unsetenv("TMPDIR");
    free(saved);
}

int main(void)
{
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    umask(022);
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, enterFolder, leaveFolder)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(readsEveryLength),
        IN_FOLDER(refusesToRead),
        IN_FOLDER(readsPipes),
        IN_FOLDER(writesAndReplaces),
        IN_FOLDER(keepsTheOldFileUntilClosed),
        IN_FOLDER(followsLinks),
        IN_FOLDER(refusesToWrite),
        IN_FOLDER(keepsTheOldFileWhenTheDiskIsFull),
        IN_FOLDER(writesToStandardOutput),
        IN_FOLDER(writesToNamedPipes),
        IN_FOLDER(stopsWhenCancelled),
        IN_FOLDER(makesFolders),
        IN_FOLDER(removesFolders),
        IN_FOLDER(makesTemporaryFolders),
    };
    return cmocka_run_group_tests_name("files", tests, NULL, NULL);
}
