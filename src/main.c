/* main.c - the program's beginning and end: signals, the command line, the exit code.
 *
 * Only this file installs signal handlers. The first Ctrl-C asks all work to stop (base/cancel.h), which
 * it does within 100 ms, leaving no temporary files; the second ends the program at once. The commands
 * are in cli/.
 */
#include "base/cancel.h"
#include "cli/command.h"
#include "cli/help.h"
#include "cli/options.h"
#include "cli/terminal.h"

#include <fcntl.h>
#include <signal.h>
#include <stddef.h>
#include <string.h>
#include <unistd.h>

static volatile sig_atomic_t stopRequests;

static void stopOnSignal(int signalNumber)
{
    (void)signalNumber;
    if (stopRequests > 0)
        _exit(STATUS_INTERRUPTED);
    stopRequests = 1;
    requestCancel();
}

/* Stop on Ctrl-C, on kill and when the terminal goes away (unless nohup asked to go on). Without
 * SA_RESTART, so that reading from a silent terminal ends too. A closed pipe is an error of writing, not
 * a signal. */
static void installSignalHandlers(void)
{
    struct sigaction stop = {.sa_handler = stopOnSignal}, ignore = {.sa_handler = SIG_IGN}, before;
    sigemptyset(&stop.sa_mask);
    sigemptyset(&ignore.sa_mask);
    sigaction(SIGINT, &stop, NULL);
    sigaction(SIGTERM, &stop, NULL);
    if (sigaction(SIGHUP, NULL, &before) == 0 && before.sa_handler != SIG_IGN)
        sigaction(SIGHUP, &stop, NULL);
    sigaction(SIGPIPE, &ignore, NULL);
}

/* Fill the places of closed standard streams, so that no file that is opened later can be taken for one:
 * with /dev/null opened the wrong way round, which still fails when it is used. */
static void occupyStandardStreams(void)
{
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; descriptor++) {
        bool isClosed = fcntl(descriptor, F_GETFD) == -1;
        if (isClosed && open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY) != descriptor)
            return;
    }
}

/* Say what is wrong with the command line, and where to look. */
static int refuse(const Status *status, const Command *command)
{
    Text messages = {0};
    appendError(&messages, NULL, status);
    if (status->code == STATUS_USAGE)
        textAppendFormat(&messages, "Try: eclairage %s%s--help\n", command != NULL ? command->name : "",
                         command != NULL ? " " : "");
    printMessages(&messages);
    return (int)status->code;
}

/* What the build asks for: the files that are made from the tables of the options and commands. */
static bool writesGeneratedFile(const char *argument, Text *text)
{
    if (strcmp(argument, "--print-manual-page") == 0)
        writeManualPage(text);
    else if (strcmp(argument, "--print-bash-completion") == 0)
        writeBashCompletion(text);
    else
        return false;
    return true;
}

static int runProgram(int argc, char **argv)
{
    Text text = {0};
    if (argc < 2) {
        writeHelp(NULL, &text);
        printMessages(&text);
        return STATUS_USAGE;
    }
    if (argc == 2 && writesGeneratedFile(argv[1], &text))
        return printData(&text);

    Arguments arguments;
    Status status = parseArguments(argc, argv, &arguments);
    if (!statusIsOk(&status))
        return refuse(&status, arguments.command);
    setUpTerminal(&arguments);
    int code;
    if (arguments.help) {
        writeHelp(arguments.command, &text);
        code = printData(&text);
    } else if (arguments.version) {
        textAppend(&text, "eclairage " ECLAIRAGE_VERSION "\n");
        code = printData(&text);
    } else {
        code = arguments.command->run(&arguments);
    }
    freeArguments(&arguments);
    return code;
}

int main(int argc, char **argv)
{
    occupyStandardStreams();
    installSignalHandlers();
    int code = runProgram(argc, argv);

    /* What failed because of a Ctrl-C was interrupted, and that is said once. */
    if (code == STATUS_OK || !cancelRequested())
        return code;
    Text message = {0};
    textAppend(&message, "eclairage: interrupted\n");
    printMessages(&message);
    return STATUS_INTERRUPTED;
}
