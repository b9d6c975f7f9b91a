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
#include "cli/compare_job.h"
#include "cli/drawing.h"
#include "cli/report_folder.h"
#include "cli/scene_input.h"
#include "cli/shell_words.h"
#include "cli/terminal.h"
#include "compare/report.h"
#include "compare/words.h"
#include "explain/scene_variant.h"
#include "explain/terms.h"
#include "povray/run.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum {
    MOST_AT_ONCE = 8, /* pictures under way */
    LONGEST_NAME = 80 /* bytes of a scene's name in those of its files */
};

static const char DEFAULT_FOLDER[] = "eclairage-report";

/* One term of a scene. */
typedef struct TermJob {
    Term term;
    PictureFiles files;
    Text messages;
    Status status;
} TermJob;

/* One scene of the run. */
typedef struct Job {
    const char *path;
    Text name; /* what its files are called; no two jobs have the same */
    PictureFiles files;
    Text command; /* that repeats this comparison */
    SceneResult result;
    TermJob terms[TERM_COUNT]; /* those that it has, with --per-term */
    TermResult termResults[TERM_COUNT];
    Text messages; /* what is to be said about it */
    bool isDone;
} Job;

typedef struct Run {
    const Arguments *arguments;
    const char *folder;
    Job *jobs;
    size_t count;
    CompareSettings settings;
    int termsAtOnce;          /* of one scene */
    pthread_mutex_t turn;     /* held by the scene that draws or measures */
    pthread_mutex_t printing; /* guards isDone, the messages that are printed and the counts below */
    size_t printed, done;
} Run;

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

/* Whether the longer name is what a term of the other is called. */
static bool isTermOf(const char *longer, const char *name)
{
    size_t length = strlen(name);
    if (strncasecmp(longer, name, length) != 0 || longer[length] != '-')
        return false;
    for (Term term = 0; term < TERM_COUNT; term++)
        if (strcasecmp(longer + length + 1, termName(term)) == 0)
            return true;
    return false;
}

/* Whether files of an earlier job would be called the same; capitals do not count, for file systems that
 * ignore them. */
static bool isNameTaken(const Run *run, size_t number, const char *name)
{
    for (size_t i = 0; i < number; i++) {
        const char *other = textString(&run->jobs[i].name);
        if (strcasecmp(other, name) == 0)
            return true;
        if (run->arguments->perTerm && (isTermOf(other, name) || isTermOf(name, other)))
            return true;
    }
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
    namePictureFiles(textString(&job->name), &job->files);
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

/* ---- Terms ---- */

/* The terms of one scene, each a task. */
typedef struct TermRun {
    Run *run;
    Job *job;
    const Scene *scene;
} TermRun;

static void runTerm(void *context, size_t number)
{
    const TermRun *terms = context;
    TermJob *termJob = &terms->job->terms[number];
    Scene variant;
    Status status = createTermScene(terms->scene, termJob->term, &variant);
    if (statusIsOk(&status)) {
        PictureResult result = {0};
        status = comparePicture(&terms->run->settings, &variant, terms->job->path, &termJob->files, &result,
                                &termJob->messages);
        freeSceneVariant(&variant);
        TermResult *told = &terms->job->termResults[number];
        told->metrics = result.metrics;
        told->verdict = result.verdict;
    }
    termJob->status = status;
}

/* Compare the terms that the scene has, several at once. */
static Status compareTerms(Run *run, Job *job, const Scene *scene)
{
    size_t count = 0;
    for (Term term = 0; term < TERM_COUNT; term++) {
        if (!sceneHasTerm(scene, term))
            continue;
        TermJob *termJob = &job->terms[count];
        termJob->term = term;
        Text stem = {0};
        textAppendFormat(&stem, "%s-%s", textString(&job->name), termName(term));
        bool isNamed = namePictureFiles(textString(&stem), &termJob->files) && !stem.failed;
        textFree(&stem);
        if (!isNamed)
            return statusOutOfMemory();
        job->termResults[count] = (TermResult){.term = termName(term),
                                               .oursFile = termJob->files.ours.data,
                                               .povrayFile = termJob->files.povray.data,
                                               .differenceFile = termJob->files.difference.data,
                                               .povFile = termJob->files.pov.data};
        count++;
    }
    TermRun terms = {.run = run, .job = job, .scene = scene};
    Status status = runTasks(count, run->termsAtOnce, runTerm, &terms);
    for (size_t i = 0; i < count; i++) {
        TermJob *termJob = &job->terms[i];
        textAppend(&job->messages, textString(&termJob->messages));
        textFree(&termJob->messages);
        if (!statusIsOk(&status) || statusIsOk(&termJob->status))
            continue;
        status = statusErrorAt(termJob->status.code, termJob->status.line, termJob->status.column,
                               "the %s term could not be compared: %s", termName(termJob->term),
                               termJob->status.message);
    }
    job->result.terms = job->termResults;
    job->result.termCount = count;
    return status;
}

/* ---- One scene ---- */

/* Everything for a scene that was loaded. */
static Status compareScene(Run *run, Job *job, Scene *scene)
{
    /* Compare where the two can agree to 1/65535: in 16 bits, linear. */
    scene->image.bitDepth = 16;
    scene->image.encoding = ENCODING_LINEAR;
    SceneResult *told = &job->result;
    told->tolerance = scene->tolerance;
    PictureResult result = {0};
    Status status = comparePicture(&run->settings, scene, job->path, &job->files, &result, &job->messages);
    told->metrics = result.metrics;
    told->verdict = result.verdict;
    told->renderSeconds = result.renderSeconds;
    told->povraySeconds = result.povraySeconds;
    told->compareSeconds = result.compareSeconds;
    if (statusIsOk(&status) && run->arguments->perTerm)
        status = compareTerms(run, job, scene);
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
    return !statusIsOk(&result->status)               ? (int)result->status.code
           : findSceneOutcome(result) == SCENE_AGREES ? STATUS_OK
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
    Status status = writeResultsFile(run->folder, &json);
    if (statusIsOk(&status))
        status = command.failed ? statusOutOfMemory()
                                : writeReport(run->folder, results, run->count, textString(&command));
    textFree(&command);
    int written = statusIsOk(&status) ? 0 : printError(NULL, &status);

    Text words = {0};
    if (!arguments->json)
        writeResultsText(results, run->count, colorOnOutput(), &words);
    int code = printResults(arguments, run->folder, written, &json, &words);
    return code > highest ? code : highest;
}

static void freeRun(Run *run)
{
    for (size_t i = 0; i < run->count; i++) {
        Job *job = &run->jobs[i];
        textFree(&job->name);
        freePictureFiles(&job->files);
        for (size_t t = 0; t < TERM_COUNT; t++)
            freePictureFiles(&job->terms[t].files);
        textFree(&job->command);
        textFree(&job->messages);
    }
    free(run->jobs);
    pthread_mutex_destroy(&run->turn);
    pthread_mutex_destroy(&run->printing);
}

/* Give each scene its names, and make the folder. */
static Status prepareJobs(Run *run)
{
    for (size_t i = 0; i < run->count; i++) {
        Job *job = &run->jobs[i];
        job->path = run->arguments->operands[i];
        nameJob(run, i);
        Text folder = pathInFolder(run->folder, textString(&job->name));
        appendCommandLine(&job->command, run->arguments, job->path, textString(&folder));
        textFree(&folder);
        const PictureFiles *files = &job->files;
        if (job->name.failed || files->ours.failed || files->povray.failed || files->difference.failed ||
            files->pov.failed || job->command.failed)
            return statusOutOfMemory();
        job->result = (SceneResult){.scene = job->path,
                                    .oursFile = files->ours.data,
                                    .povrayFile = files->povray.data,
                                    .differenceFile = files->difference.data,
                                    .povFile = files->pov.data,
                                    .command = job->command.data,
                                    .perTerm = run->arguments->perTerm};
    }
    Status status = protectInputsFromPage(run->arguments, NULL, run->folder);
    return statusIsOk(&status) ? makeFolders(run->folder) : status;
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
    /* With terms, what one scene leaves free is for its terms. */
    int termsAtOnce = arguments->perTerm && atOnce > 0 ? MOST_AT_ONCE / atOnce : 1;
    int povrays = atOnce * termsAtOnce;
    Run run = {.arguments = arguments,
               .folder = arguments->folder != NULL ? arguments->folder : DEFAULT_FOLDER,
               .jobs = calloc(count, sizeof(Job)),
               .termsAtOnce = termsAtOnce,
               .settings = {.arguments = arguments,
                            .engine = chosenEngine(arguments),
                            .threads = threads,
                            .povrayThreads = threads > povrays ? threads / povrays : 1}};
    run.settings.folder = run.folder;
    run.settings.turn = &run.turn;
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
