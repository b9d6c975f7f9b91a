/* command_check.c - `eclairage check`: everything that is wrong with some scenes.
 *
 * What is wrong goes to standard error in words, or with --json to standard output as data. That a scene
 * is fine is a note: standard error, and not with --quiet.
 */
#include "base/cancel.h"
#include "base/json.h"
#include "cli/command.h"
#include "cli/terminal.h"
#include "scene/load.h"

/* Append the diagnostics of one severity as a JSON array. */
static void writeDiagnostics(JsonWriter *json, const Diagnostics *diagnostics, Severity severity,
                             const Status *unreadable)
{
    jsonArray(json);
    for (size_t i = 0; i < diagnostics->count; i++) {
        const Diagnostic *item = &diagnostics->items[i];
        if (item->severity != severity)
            continue;
        jsonInlineObject(json);
        jsonKeyInteger(json, "line", item->line);
        jsonKeyInteger(json, "column", item->column);
        jsonKeyString(json, "message", item->message);
        jsonKey(json, "hint");
        if (item->hint != NULL)
            jsonString(json, item->hint);
        else
            jsonNull(json);
        jsonEndObject(json);
    }
    /* A file that could not be read has an error without a place. */
    if (unreadable != NULL) {
        jsonInlineObject(json);
        jsonKey(json, "line");
        jsonNull(json);
        jsonKey(json, "column");
        jsonNull(json);
        jsonKeyString(json, "message", unreadable->message);
        jsonKey(json, "hint");
        jsonNull(json);
        jsonEndObject(json);
    }
    jsonEndArray(json);
}

static void writeFile(JsonWriter *json, const char *path, const Diagnostics *diagnostics,
                      const Status *unreadable)
{
    jsonObject(json);
    jsonKeyString(json, "file", path);
    jsonKey(json, "errors");
    writeDiagnostics(json, diagnostics, SEVERITY_ERROR, unreadable);
    jsonKey(json, "warnings");
    writeDiagnostics(json, diagnostics, SEVERITY_WARNING, NULL);
    jsonEndObject(json);
}

static void sayResult(const char *path, const Diagnostics *diagnostics, const Status *status, bool isSaid)
{
    Text messages = {0};
    diagnosticsPrint(diagnostics, displayName(path), colorOnErrors(), &messages);
    if (!statusIsOk(status) && !isSaid)
        appendError(&messages, displayName(path), status);
    printMessages(&messages);
    if (!statusIsOk(status))
        return;
    if (diagnostics->warnings > 0)
        printNote("%s: ok, with %zu %s", displayName(path), diagnostics->warnings,
                  diagnostics->warnings == 1 ? "warning" : "warnings");
    else
        printNote("%s: ok", displayName(path));
}

int runCheck(const Arguments *arguments)
{
    int highest = 0;
    Text text = {0};
    JsonWriter json = jsonBegin(&text);
    jsonObject(&json);
    jsonKey(&json, "files");
    jsonArray(&json);
    for (size_t i = 0; i < arguments->operandCount && !cancelRequested(); i++) {
        const char *path = arguments->operands[i];
        Scene scene;
        Diagnostics diagnostics = {0};
        Status status = loadScene(path, &scene, &diagnostics);
        if (statusIsOk(&status))
            freeScene(&scene);
        bool isSaid = status.code == STATUS_SCENE && diagnostics.errors > 0;
        sayResult(path, &diagnostics, &status, isSaid);
        writeFile(&json, path, &diagnostics, statusIsOk(&status) || isSaid ? NULL : &status);
        diagnosticsFree(&diagnostics);
        if ((int)status.code > highest)
            highest = (int)status.code;
    }
    jsonEndArray(&json);
    jsonEndObject(&json);
    jsonEnd(&json);
    if (!arguments->json || cancelRequested()) {
        textFree(&text);
        return cancelRequested() ? STATUS_INTERRUPTED : highest;
    }
    int code = printData(&text);
    return code > highest ? code : highest;
}
