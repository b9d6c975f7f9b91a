/* report_folder.h - what is the same for all commands that write a report into a folder.
 *
 * Each report has an index.html and a results.json, which holds what --json prints.
 */
#ifndef ECLAIRAGE_CLI_REPORT_FOLDER_H
#define ECLAIRAGE_CLI_REPORT_FOLDER_H

#include "base/status.h"
#include "base/text.h"
#include "cli/command.h"
#include "raytracer.h"

/* STATUS_USAGE when a file of this name in the folder is one that is read: an operand, or a file that the
 * scene names; scene may be NULL. */
Status protectInputs(const Arguments *arguments, const Scene *scene, const char *folder, const char *name);

/* The same for the files that each report has. */
Status protectInputsFromPage(const Arguments *arguments, const Scene *scene, const char *folder);

/* Write results.json into an existing folder. */
Status writeResultsFile(const char *folder, const Text *json);

/* Print the results, the one or the other text as --json says, free both, and say where the report is; folder
 * is NULL where none was wanted. written: the exit code of writing it. Returns the exit code of both. */
int printResults(const Arguments *arguments, const char *folder, int written, Text *json, Text *words);

#endif
