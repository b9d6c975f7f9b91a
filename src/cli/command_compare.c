/* command_compare.c - `eclairage compare`: draw scenes with POV-Ray too, and judge.
 *
 * A POV-Ray process sleeps for most of its 0.7 s, so several scenes are under way at once; but only one of
 * them at a time draws or measures, on all the threads there are. Results, messages and the report are in
 * the order of the command line, whatever finishes first.
 * Invariant: a scene's files are written whole or not at all, and its pictures only when all went well.
 */
#include "base/cancel.h"
#include "base/files.h"
#include "base/threads.h"
#include "cli/command.h"
#include "cli/drawing.h"
#include "cli/scene_input.h"
#include "cli/shell_words.h"
#include "cli/terminal.h"
#include "compare/difference.h"
#include "compare/metrics.h"
#include "compare/report.h"
#include "image/image.h"
#include "povray/export.h"
#include "povray/run.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum {
    MOST_AT_ONCE = 8,    /* scenes under way */
    LONGEST_NAME = 80,   /* bytes of a scene's name in those of its files */
    POVRAY_TIMEOUT = 600 /* seconds for one scene */
};

static const char DEFAULT_FOLDER[] = "eclairage-report";

/* One scene of the run. */
typedef struct Job {
    const char *path;
    Text name;                          /* what its files are called; no two jobs have the same */
    Text ours, povray, difference, pov; /* the names of its files, in the folder */
    Text command;                       /* that repeats this comparison */
    SceneResult result;
    Text messages; /* what is to be said about it */
    bool isDone;
} Job;

typedef struct Run {
    const Arguments *arguments;
    const char *folder;
    Job *jobs;
    size_t count;
    int threads, povrayThreads;
    pthread_mutex_t turn;     /* held by the scene that draws or measures */
    pthread_mutex_t printing; /* guards isDone, the messages that are printed and the counts below */
    size_t printed, done;
} Run;

/* Both pictures of a scene and their difference. */
typedef struct Pictures {
    Image ours, povray, difference;
} Pictures;

/* ---- Names ---- */

/* Append the scene's file name without folder and extension, in letters that are harmless everywhere. */
static void appendSafeName(Text *text, const char *path)
{
    const char *base = strcmp(path, "-") == 0 ? "stdin" : baseName(path);
    const char *dot = strrchr(base, '.');
    size_t length = dot != NULL && dot != base ? (size_t)(dot - base) : strlen(base);
    if (length > LONGEST_NAME)
        length = LONGEST_NAME;
    for (size_t i = 0; i < length; i++) {
        unsigned char c = (unsigned char)base[i];
        bool isContinuation = (c & 0xC0) == 0x80;
        bool isSafe = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '_' || ((c == '-' || c == '.') && i > 0);
        if (!isContinuation)
            textAppendBytes(text, isSafe ? &base[i] : "_", 1);
    }
    if (text->length == 0)
        textAppend(text, "scene");
}

/* Whether an earlier job has the name; capitals do not count, for file systems that ignore them. */
static bool isNameTaken(const Run *run, size_t number, const char *name)
{
    for (size_t i = 0; i < number; i++)
        if (strcasecmp(textString(&run->jobs[i].name), name) == 0)
            return true;
    return false;
}

static void nameJob(Run *run, size_t number)
{
    Job *job = &run->jobs[number];
    Text stem = {0};
    appendSafeName(&stem, job->path);
    textAppend(&job->name, textString(&stem));
    for (int copy = 2; isNameTaken(run, number, textString(&job->name)); copy++) {
        textFree(&job->name);
        textAppendFormat(&job->name, "%s-%d", textString(&stem), copy);
        if (job->name.failed)
            break;
    }
    textFree(&stem);
    textAppendFormat(&job->ours, "%s-ours.png", textString(&job->name));
    textAppendFormat(&job->povray, "%s-povray.png", textString(&job->name));
    textAppendFormat(&job->difference, "%s-difference.png", textString(&job->name));
    textAppendFormat(&job->pov, "%s.pov", textString(&job->name));
}

/* How many words the option --out takes at this place of the command line: 0 where it does not stand. */
static int outOptionLength(const Arguments *arguments, int i)
{
    if (strcmp(arguments->argv[i], "--out") == 0)
        return 2;
    return strncmp(arguments->argv[i], "--out=", 6) == 0;
}

/* Append the command line as it was typed. With one scene of several all others are left out, and the report
 * goes to a folder of its own, so that it does not take the place of the whole. */
static void appendCommandLine(Text *text, const Arguments *arguments, const char *scene, const char *folder)
{
    bool isPart = scene != NULL && arguments->operandCount > 1;
    bool optionsEnded = false, outWritten = false;
    for (int i = 0; i < arguments->argc; i++) {
        const char *word = arguments->argv[i];
        bool isOtherScene = false;
        for (size_t j = 0; j < arguments->operandCount && isPart; j++)
            isOtherScene =
                isOtherScene || (arguments->operands[j] == word && arguments->operands[j] != scene);
        optionsEnded = optionsEnded || strcmp(word, "--") == 0;
        int outLength = isPart && !optionsEnded ? outOptionLength(arguments, i) : 0;
        if (isOtherScene || outLength > 0) {
            i += outLength > 1;
            continue;
        }
        if (text->length > 0)
            textAppend(text, " ");
        appendShellWord(text, word);
        if (isPart && !outWritten && strcmp(word, "compare") == 0) {
            outWritten = true;
            textAppend(text, " --out ");
            appendShellWord(text, folder);
        }
    }
}

/* ---- One scene ---- */

/* The path of a file in the report's folder, freed by the caller. */
static Text pathInFolder(const Run *run, const char *name)
{
    Text path = {0};
    bool endsInSlash = run->folder[strlen(run->folder) - 1] == '/';
    textAppendFormat(&path, "%s%s%s", run->folder, endsInSlash ? "" : "/", name);
    return path;
}

/* STATUS_USAGE when the .pov would be written over its scene. */
static Status protectScene(const Run *run, const Job *job)
{
    Text path = pathInFolder(run, textString(&job->pov));
    bool isScene = isSameFile(textString(&path), job->path);
    textFree(&path);
    return isScene ? statusError(STATUS_USAGE, "the POV-Ray scene would overwrite the scene itself: choose "
                                               "another folder with --out, or end its name in .yaml")
                   : statusOk();
}

static Status writeTextFile(const Run *run, const char *name, const Text *text)
{
    Text path = pathInFolder(run, name);
    Status status = path.failed || text->failed ? statusOutOfMemory()
                                                : writeWholeFile(path.data, textString(text), text->length);
    textFree(&path);
    return status;
}

static Status writePicture(const Run *run, const Text *name, const Image *image)
{
    Text path = pathInFolder(run, textString(name));
    Status status = path.failed ? statusOutOfMemory() : writePng(path.data, image, run->threads);
    textFree(&path);
    return status;
}

static Status drawOurs(Run *run, Job *job, const Scene *scene, Image *ours)
{
    Framebuffer *framebuffer = createFramebuffer(scene->image.width, scene->image.height);
    if (framebuffer == NULL)
        return statusError(STATUS_IO, "out of memory for a picture of %d x %d pixels", scene->image.width,
                           scene->image.height);
    pthread_mutex_lock(&run->turn);
    RenderOptions options = {.threads = run->threads};
    DrawingSeconds seconds;
    Status status = drawScene(scene, chosenEngine(run->arguments), framebuffer, &options, NULL, &seconds);
    job->result.renderSeconds = seconds.compile + seconds.trace;
    pthread_mutex_unlock(&run->turn);
    if (statusIsOk(&status)) {
        warnOfNonFinitePixels(framebuffer, job->path, &job->messages);
        status = imageFromFramebuffer(framebuffer, scene->image.bitDepth, scene->image.encoding, run->threads,
                                      ours);
    }
    freeFramebuffer(framebuffer);
    return status;
}

static Status drawWithPovray(const Run *run, Job *job, const Scene *scene, const Text *pov, Image *povray)
{
    PovraySettings settings = {.width = scene->image.width,
                               .height = scene->image.height,
                               .bitDepth = scene->image.bitDepth,
                               .encoding = scene->image.encoding,
                               .samples = scene->render.samples,
                               .threads = run->povrayThreads,
                               .timeoutSeconds = POVRAY_TIMEOUT};
    double start = secondsNow();
    Status status = runPovray(textString(pov), &settings, povray);
    job->result.povraySeconds = secondsSince(start);
    return status;
}

static Status measurePictures(Run *run, Job *job, Pictures *pictures)
{
    SceneResult *result = &job->result;
    Status status = checkComparable(&pictures->ours, "our picture", &pictures->povray, "POV-Ray's picture");
    pthread_mutex_lock(&run->turn);
    double start = secondsNow();
    if (statusIsOk(&status))
        status = measureImages(&pictures->ours, &pictures->povray, result->tolerance.fail, run->threads,
                               &result->metrics);
    if (statusIsOk(&status))
        status = differencePicture(&pictures->ours, &pictures->povray, &pictures->difference);
    result->compareSeconds = secondsSince(start);
    pthread_mutex_unlock(&run->turn);
    if (statusIsOk(&status))
        result->verdict = judgeMetrics(&result->metrics, &result->tolerance);
    return status;
}

/* Everything for a scene that was loaded. */
static Status compareScene(Run *run, Job *job, Scene *scene)
{
    /* Compare where the two can agree to 1/65535: in 16 bits, linear. */
    scene->image.bitDepth = 16;
    scene->image.encoding = ENCODING_LINEAR;
    job->result.tolerance = scene->tolerance;

    Text pov = {0};
    Pictures pictures = {0};
    Status status = exportPov(scene, textString(&job->pov), &pov);
    if (statusIsOk(&status))
        status = protectScene(run, job);
    if (statusIsOk(&status))
        status = writeTextFile(run, textString(&job->pov), &pov);
    if (statusIsOk(&status))
        status = drawOurs(run, job, scene, &pictures.ours);
    if (statusIsOk(&status))
        status = drawWithPovray(run, job, scene, &pov, &pictures.povray);
    textFree(&pov);
    if (statusIsOk(&status))
        status = measurePictures(run, job, &pictures);
    if (statusIsOk(&status))
        status = writePicture(run, &job->ours, &pictures.ours);
    if (statusIsOk(&status))
        status = writePicture(run, &job->povray, &pictures.povray);
    if (statusIsOk(&status))
        status = writePicture(run, &job->difference, &pictures.difference);
    freeImage(&pictures.ours);
    freeImage(&pictures.povray);
    freeImage(&pictures.difference);
    return status;
}

/* Print what the scenes said, in the order of the command line, as far as all before them are done. */
static void finishJob(Run *run, Job *job)
{
    pthread_mutex_lock(&run->printing);
    job->isDone = true;
    run->done++;
    for (; run->printed < run->count && run->jobs[run->printed].isDone; run->printed++)
        printMessages(&run->jobs[run->printed].messages);
    showProgress(NULL, (double)run->done / (double)run->count);
    pthread_mutex_unlock(&run->printing);
}

static void runJob(void *context, size_t number)
{
    Run *run = context;
    Job *job = &run->jobs[number];
    Scene scene;
    Status status = openScene(job->path, run->arguments, &scene, &job->messages);
    if (statusIsOk(&status)) {
        status = compareScene(run, job, &scene);
        freeScene(&scene);
        if (!statusIsOk(&status))
            appendSceneError(&job->messages, job->path, &status);
    }
    /* In the results the message stands alone, so it says the place. */
    Status placed = status.line > 0 ? statusErrorAt(status.code, status.line, status.column, "line %d: %s",
                                                    status.line, status.message)
                                    : status;
    job->result.status = placed;
    finishJob(run, job);
}

/* ---- The run ---- */

static int jobCode(const Job *job)
{
    const SceneResult *result = &job->result;
    return !statusIsOk(&result->status) ? (int)result->status.code
           : result->verdict.pass       ? STATUS_OK
                                        : STATUS_DIFFERENT;
}

/* Write results.json and index.html, and the results to standard output. Returns the exit code. */
static int reportResults(const Run *run, const SceneResult *results)
{
    const Arguments *arguments = run->arguments;
    int highest = 0;
    for (size_t i = 0; i < run->count; i++)
        if (jobCode(&run->jobs[i]) > highest)
            highest = jobCode(&run->jobs[i]);

    Text json = {0}, command = {0};
    writeResultsJson(results, run->count, &json);
    appendCommandLine(&command, arguments, NULL, NULL);
    Status status = writeTextFile(run, "results.json", &json);
    if (statusIsOk(&status))
        status = command.failed ? statusOutOfMemory()
                                : writeReport(run->folder, results, run->count, textString(&command));
    textFree(&command);
    int written = statusIsOk(&status) ? 0 : printError(NULL, &status);

    Text words = {0};
    if (!arguments->json)
        writeResultsText(results, run->count, colorOnOutput(), &words);
    int printed = printData(arguments->json ? &json : &words);
    textFree(&json);
    if (written == 0) {
        Text page = pathInFolder(run, "index.html");
        printNote("the report is %s", textString(&page));
        textFree(&page);
    }
    highest = written > highest ? written : highest;
    return printed > highest ? printed : highest;
}

static void freeRun(Run *run)
{
    for (size_t i = 0; i < run->count; i++) {
        Job *job = &run->jobs[i];
        textFree(&job->name);
        textFree(&job->ours);
        textFree(&job->povray);
        textFree(&job->difference);
        textFree(&job->pov);
        textFree(&job->command);
        textFree(&job->messages);
    }
    free(run->jobs);
    pthread_mutex_destroy(&run->turn);
    pthread_mutex_destroy(&run->printing);
}

/* Give each scene its names. */
static Status prepareJobs(Run *run)
{
    for (size_t i = 0; i < run->count; i++) {
        Job *job = &run->jobs[i];
        job->path = run->arguments->operands[i];
        nameJob(run, i);
        Text folder = pathInFolder(run, textString(&job->name));
        appendCommandLine(&job->command, run->arguments, job->path, textString(&folder));
        textFree(&folder);
        if (job->name.failed || job->ours.failed || job->povray.failed || job->difference.failed ||
            job->pov.failed || job->command.failed)
            return statusOutOfMemory();
        job->result = (SceneResult){.scene = job->path,
                                    .oursFile = job->ours.data,
                                    .povrayFile = job->povray.data,
                                    .differenceFile = job->difference.data,
                                    .povFile = job->pov.data,
                                    .command = job->command.data};
    }
    return makeFolders(run->folder);
}

int runCompare(const Arguments *arguments)
{
    Status status = findPovray();
    if (!statusIsOk(&status))
        return printError(NULL, &status);

    if (arguments->encoding != NOT_GIVEN || arguments->depthChoice != NOT_GIVEN)
        printNote("compare measures 16-bit linear pictures; --encoding and --bit-depth play no part here");
    size_t count = arguments->operandCount;
    int atOnce = count < MOST_AT_ONCE ? (int)count : MOST_AT_ONCE;
    int threads = chosenThreads(arguments);
    Run run = {.arguments = arguments,
               .folder = arguments->folder != NULL ? arguments->folder : DEFAULT_FOLDER,
               .jobs = calloc(count, sizeof(Job)),
               .threads = threads,
               .povrayThreads = threads > atOnce ? threads / atOnce : 1};
    pthread_mutex_init(&run.turn, NULL);
    pthread_mutex_init(&run.printing, NULL);
    SceneResult *results = calloc(count, sizeof *results);
    if (run.jobs != NULL)
        run.count = count;
    status = run.jobs == NULL || results == NULL ? statusOutOfMemory() : prepareJobs(&run);

    if (statusIsOk(&status)) {
        beginProgress("comparing");
        status = runTasks(count, atOnce, runJob, &run);
        endProgress();
    }
    int code;
    if (statusIsOk(&status)) {
        for (size_t i = 0; i < count; i++)
            results[i] = run.jobs[i].result;
        code = reportResults(&run, results);
    } else {
        code = printError(NULL, &status);
    }
    free(results);
    freeRun(&run);
    return code;
}
