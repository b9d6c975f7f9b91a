/* run.c - run POV-Ray as a program; see run.h.
 *
 * POV-Ray reads povray.conf and povray.ini from the user's home, from the current folder and from where
 * POVINI says, and any of them can change the picture without a word. So each run gets a folder of its
 * own, which is its home and its current folder, an empty povray.ini named by POVINI, and no other
 * variable but PATH. All it leaves behind (picture, state file, log) is in that folder, which is removed.
 */
#define _GNU_SOURCE
#include "povray/run.h"

#include "base/cancel.h"
#include "base/files.h"
#include "base/text.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define INSTALL_HINT "install it with: sudo apt-get install povray"

/* The program's path by the PATH, or NULL; freed by the caller. */
static char *searchPath(const char *program)
{
    const char *path = getenv("PATH");
    if (path == NULL || *path == '\0')
        path = "/usr/local/bin:/usr/bin:/bin";
    while (*path != '\0') {
        size_t length = strcspn(path, ":");
        Text candidate = {0};
        textAppendBytes(&candidate, path, length);
        textAppendFormat(&candidate, "%s%s", length > 0 ? "/" : "./", program);
        struct stat information;
        if (!candidate.failed && access(candidate.data, X_OK) == 0 &&
            stat(candidate.data, &information) == 0 && S_ISREG(information.st_mode)) {
            /* The run changes its folder, so a relative path must be made absolute. */
            char *absolute = realpath(candidate.data, NULL);
            textFree(&candidate);
            return absolute;
        }
        textFree(&candidate);
        path += length;
        path += *path == ':';
    }
    return NULL;
}

PovraySettings createPovraySettings(const Scene *scene, int threads)
{
    return (PovraySettings){.width = scene->image.width,
                            .height = scene->image.height,
                            .bitDepth = scene->image.bitDepth,
                            .encoding = scene->image.encoding,
                            .samples = scene->render.samples,
                            .threads = threads,
                            .timeoutSeconds = POVRAY_TIMEOUT};
}

Status findPovray(void)
{
    char *program = searchPath("povray");
    bool found = program != NULL;
    free(program);
    return found ? statusOk() : statusError(STATUS_POVRAY, "POV-Ray is not installed; " INSTALL_HINT);
}

static double monotonicSeconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

enum {
    CANNOT_START = 127 /* how the child ends when it cannot become POV-Ray */
};

/* The largest file POV-Ray may write, in bytes: a run that says the same line for ever must not fill the
 * disk. Its largest ones are the state file and the picture, with some 20 and 6 bytes a pixel. */
static struct rlimit fileLimit(const PovraySettings *settings)
{
    struct rlimit limit = {RLIM_INFINITY, RLIM_INFINITY};
    getrlimit(RLIMIT_FSIZE, &limit);
    rlim_t enough = ((rlim_t)64 << 20) + 64 * (rlim_t)settings->width * (rlim_t)settings->height;
    if (limit.rlim_cur > enough)
        limit.rlim_cur = enough;
    return limit;
}

/* Start the program in the folder with its output in the log; 0 on failure. Between fork and exec only
 * what is safe in a program with threads. */
static pid_t startIn(const char *folder, const char *program, char *const arguments[],
                     char *const environment[], const struct rlimit *largestFile)
{
    pid_t child = fork();
    if (child != 0)
        return child > 0 ? child : 0;
    /* A process group of its own: Ctrl-C on the terminal is for us, and we end it. */
    setpgid(0, 0);
    int null = open("/dev/null", O_RDONLY);
    if (chdir(folder) != 0 || null < 0)
        _exit(CANNOT_START);
    int log = open("log", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (log < 0 || dup2(null, 0) < 0 || dup2(log, 1) < 0 || dup2(log, 2) < 0 ||
        setrlimit(RLIMIT_FSIZE, largestFile) != 0)
        _exit(CANNOT_START);
    signal(SIGPIPE, SIG_DFL);
    execve(program, arguments, environment);
    _exit(CANNOT_START);
}

/* Wait until the process ends, looking for a cancel and at the clock; it is killed for either.
 * *ended is how waitpid saw it end. */
static Status waitFor(pid_t child, double timeoutSeconds, int *ended)
{
    double deadline = monotonicSeconds() + timeoutSeconds;
    for (;;) {
        /* Look first and reap later: until then no other group can have its number, and what it started
         * and left running is ended safely. */
        siginfo_t seen = {0};
        int result = waitid(P_PID, (id_t)child, &seen, WEXITED | WNOHANG | WNOWAIT);
        if (result == 0 && seen.si_pid == child) {
            kill(-child, SIGKILL);
            while (waitpid(child, ended, 0) < 0 && errno == EINTR)
                continue;
            return statusOk();
        }
        if (result < 0 && errno != EINTR)
            return statusError(STATUS_POVRAY, "cannot wait for POV-Ray: %s", strerror(errno));
        bool late = monotonicSeconds() > deadline;
        if (cancelRequested() || late) {
            kill(-child, SIGKILL);
            kill(child, SIGKILL);
            while (waitpid(child, ended, 0) < 0 && errno == EINTR)
                continue;
            if (!late)
                return statusInterrupted();
            return statusError(STATUS_POVRAY, "POV-Ray took longer than %.0f s and was stopped",
                               timeoutSeconds);
        }
        nanosleep(&(struct timespec){.tv_nsec = 5000000}, NULL);
    }
}

/* What POV-Ray said about its failure: the lines from the first that names an error, or the last ones. */
static void quoteLog(const char *path, char quote[600])
{
    char *log = NULL;
    size_t length = 0;
    quote[0] = '\0';
    Status status = readWholeFile(path, 16 << 20, &log, &length);
    if (!statusIsOk(&status))
        return;
    const char *from = strstr(log, " Error:");
    while (from != NULL && from > log && from[-1] != '\n')
        from--;
    if (from == NULL)
        from = length > 400 ? log + length - 400 : log;
    size_t kept = 0;
    for (; *from != '\0' && kept < 598; from++) {
        /* Printable characters only, and no empty lines. */
        char c = *from == '\n' || (*from >= ' ' && *from <= '~') ? *from : ' ';
        if (c == '\n' && (kept == 0 || quote[kept - 1] == '\n'))
            continue;
        quote[kept++] = c;
    }
    while (kept > 0 && (quote[kept - 1] == '\n' || quote[kept - 1] == ' '))
        kept--;
    quote[kept] = '\0';
    free(log);
}

/* Run it in the folder, which holds scene.pov and empty.ini; the picture is picture.png there. With
 * antialias it is the mean of samples^2 + 1 rays: those and the one in the middle. */
static Status runIn(const char *folder, const PovraySettings *settings, bool antialias)
{
    char *program = searchPath("povray");
    if (program == NULL)
        return findPovray();

    char size[2][24], format[8], threads[16], samples[16], region[4][24];
    snprintf(size[0], sizeof size[0], "+W%d", settings->width);
    snprintf(size[1], sizeof size[1], "+H%d", settings->height);
    snprintf(format, sizeof format, "+FN%d", settings->bitDepth == 16 ? 16 : 8);
    snprintf(threads, sizeof threads, "+WT%d", settings->threads > 0 ? settings->threads : 1);
    snprintf(samples, sizeof samples, "+R%d", settings->samples);
    char *gamma = settings->encoding == ENCODING_LINEAR ? "File_Gamma=1.0" : "File_Gamma=srgb";
    char *arguments[] = {"povray", "+Iscene.pov", "+Opicture.png",
                         size[0],  size[1],       format,
                         gamma,    "-D",          "-P",
                         threads,  "-A",          NULL,
                         NULL,     NULL,          NULL,
                         NULL,     NULL,          NULL,
                         NULL};
    int count = 10;
    if (antialias) {
        arguments[count++] = "+A0.0";
        arguments[count++] = "+AM1";
        arguments[count++] = samples;
        arguments[count++] = "-J";
    } else {
        count++;
    }
    if (settings->onePixel) {
        /* Columns and rows count from 1. */
        const char *const bounds[4] = {"+SC", "+EC", "+SR", "+ER"};
        for (int i = 0; i < 4; i++) {
            snprintf(region[i], sizeof region[i], "%s%d", bounds[i], 1 + (i < 2 ? settings->x : settings->y));
            arguments[count++] = region[i];
        }
    }
    Text path = {0}, home = {0}, ini = {0}, log = {0};
    const char *searched = getenv("PATH");
    textAppendFormat(&path, "PATH=%s", searched != NULL ? searched : "/usr/local/bin:/usr/bin:/bin");
    textAppendFormat(&home, "HOME=%s", folder);
    textAppendFormat(&ini, "POVINI=%s/empty.ini", folder);
    textAppendFormat(&log, "%s/log", folder);
    Status status = statusOutOfMemory();
    if (!path.failed && !home.failed && !ini.failed && !log.failed) {
        char *environment[] = {path.data, home.data, ini.data, "LC_ALL=C", NULL};
        struct rlimit largestFile = fileLimit(settings);
        pid_t child = startIn(folder, program, arguments, environment, &largestFile);
        int ended = 0;
        status = child != 0 ? waitFor(child, settings->timeoutSeconds, &ended)
                            : statusError(STATUS_POVRAY, "cannot start POV-Ray: %s", strerror(errno));
        if (statusIsOk(&status) && WIFEXITED(ended) && WEXITSTATUS(ended) == CANNOT_START) {
            status = statusError(STATUS_POVRAY, "cannot start POV-Ray: is %s that program?", program);
        } else if (statusIsOk(&status) && WIFSIGNALED(ended) && WTERMSIG(ended) == SIGXFSZ) {
            status = statusError(STATUS_POVRAY, "POV-Ray wrote a file of more than %llu MB and was stopped",
                                 (unsigned long long)(largestFile.rlim_cur >> 20));
        } else if (statusIsOk(&status) && !(WIFEXITED(ended) && WEXITSTATUS(ended) == 0)) {
            char quote[600];
            quoteLog(log.data, quote);
            const char *how = WIFSIGNALED(ended) ? "was ended by signal" : "failed with exit code";
            int number = WIFSIGNALED(ended) ? WTERMSIG(ended) : WEXITSTATUS(ended);
            status = statusError(STATUS_POVRAY, "POV-Ray %s %d%s%s", how, number,
                                 quote[0] != '\0' ? ":\n" : "", quote);
        }
    }
    textFree(&path);
    textFree(&home);
    textFree(&ini);
    textFree(&log);
    free(program);
    return status;
}

/* Read the picture that POV-Ray wrote; a wrong one is POV-Ray's failure, not the user's. */
static Status readPicture(const char *path, const PovraySettings *settings, Image *image)
{
    Status status = readPng(path, image);
    if (status.code == STATUS_IO && access(path, R_OK) != 0)
        return statusError(STATUS_POVRAY, "POV-Ray wrote no picture");
    if (status.code == STATUS_IO && strcmp(status.message, statusOutOfMemory().message) != 0)
        return statusError(STATUS_POVRAY, "POV-Ray wrote a picture that cannot be read");
    if (!statusIsOk(&status))
        return status;
    if (image->width == settings->width && image->height == settings->height &&
        image->bitDepth == settings->bitDepth)
        return statusOk();
    status = statusError(
        STATUS_POVRAY, "POV-Ray wrote a picture of %d x %d pixels and %d bits, not of %d x %d and %d",
        image->width, image->height, image->bitDepth, settings->width, settings->height, settings->bitDepth);
    freeImage(image);
    return status;
}

/* Run and read the picture. */
static Status drawIn(const char *folder, const PovraySettings *settings, const char *picture, bool antialias,
                     Image *image)
{
    Status status = runIn(folder, settings, antialias);
    if (statusIsOk(&status))
        status = readPicture(picture, settings, image);
    unlink(picture);
    return status;
}

/* The same where POV-Ray took the mean of values that it then raised to the power gamma. */
static void takeOutMiddleBeforeGamma(const Image *mean, Image *middle, int n, double gamma)
{
    double rays = (double)n * n, largest = imageMaxSample(middle);
    size_t count = 3 * (size_t)middle->width * (size_t)middle->height;
    for (size_t i = 0; i < count; i++) {
        double all = pow(mean->samples[i] / largest, 1 / gamma);
        double one = pow(middle->samples[i] / largest, 1 / gamma);
        double others = fmin(fmax(((rays + 1) * all - one) / rays, 0), 1);
        middle->samples[i] = (uint16_t)(pow(others, gamma) * largest + 0.5);
    }
}

/* Of the mean of n^2 + 1 rays and the one in the middle, the mean of the n^2 others:
 * ((n^2 + 1) mean - middle) / n^2, into middle. */
static void takeOutMiddle(const Image *mean, Image *middle, int n)
{
    int64_t rays = (int64_t)n * n, largest = imageMaxSample(middle);
    size_t count = 3 * (size_t)middle->width * (size_t)middle->height;
    for (size_t i = 0; i < count; i++) {
        int64_t others = (rays + 1) * mean->samples[i] - middle->samples[i];
        int64_t rounded = others > 0 ? (others + rays / 2) / rays : 0;
        middle->samples[i] = (uint16_t)(rounded < largest ? rounded : largest);
    }
}

Status runPovray(const char *pov, const PovraySettings *settings, Image *image)
{
    Status status = findPovray();
    if (!statusIsOk(&status))
        return status;
    char *folder = NULL;
    status = makeTemporaryFolder(&folder);
    if (!statusIsOk(&status))
        return status;

    /* Write the scene and the empty configuration, run, read the picture. */
    Text scene = {0}, ini = {0}, picture = {0};
    textAppendFormat(&scene, "%s/scene.pov", folder);
    textAppendFormat(&ini, "%s/empty.ini", folder);
    textAppendFormat(&picture, "%s/picture.png", folder);
    if (scene.failed || ini.failed || picture.failed)
        status = statusOutOfMemory();
    if (statusIsOk(&status))
        status = writeWholeFile(scene.data, pov, strlen(pov));
    if (statusIsOk(&status))
        status = writeWholeFile(ini.data, "", 0);
    if (statusIsOk(&status))
        status = drawIn(folder, settings, picture.data, false, image);
    if (statusIsOk(&status) && settings->samples > 1) {
        Image mean;
        status = drawIn(folder, settings, picture.data, true, &mean);
        if (statusIsOk(&status)) {
            if (settings->gamma == 0 || settings->gamma == 1)
                takeOutMiddle(&mean, image, settings->samples);
            else
                takeOutMiddleBeforeGamma(&mean, image, settings->samples, settings->gamma);
            freeImage(&mean);
        } else {
            freeImage(image);
        }
    }
    textFree(&scene);
    textFree(&ini);
    textFree(&picture);
    removeFolder(folder);
    free(folder);
    return status;
}
