/* report_folder.c - see report_folder.h. */
#include "cli/report_folder.h"

#include "base/files.h"
#include "cli/scene_input.h"
#include "cli/terminal.h"

static const char PAGE[] = "index.html", RESULTS[] = "results.json";

Status protectInputs(const Arguments *arguments, const Scene *scene, const char *folder, const char *name)
{
    Text path = pathInFolder(folder, name);
    Status status = path.failed
                        ? statusOutOfMemory()
                        : refuseOverwriting(arguments, scene, path.data, "choose another folder with --out");
    textFree(&path);
    return status;
}

Status protectInputsFromPage(const Arguments *arguments, const Scene *scene, const char *folder)
{
    Status status = protectInputs(arguments, scene, folder, PAGE);
    return statusIsOk(&status) ? protectInputs(arguments, scene, folder, RESULTS) : status;
}

Status writeResultsFile(const char *folder, const Text *json)
{
    Text path = pathInFolder(folder, RESULTS);
    Status status = path.failed || json->failed ? statusOutOfMemory()
                                                : writeWholeFile(path.data, textString(json), json->length);
    textFree(&path);
    return status;
}

int printResults(const Arguments *arguments, const char *folder, int written, Text *json, Text *words)
{
    int printed = printData(arguments->json ? json : words);
    textFree(json);
    textFree(words);
    if (written == 0 && folder != NULL) {
        Text page = pathInFolder(folder, PAGE);
        printNote("the report is %s", textString(&page));
        textFree(&page);
    }
    return written > printed ? written : printed;
}
