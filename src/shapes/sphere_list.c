/* sphere_list.c - many spheres from a text file; see sphere_list.h. */
#include "shapes/sphere_list.h"

#include "base/cancel.h"
#include "base/files.h"
#include "shapes/text_cursor.h"

#include <float.h>
#include <limits.h>
#include <stdlib.h>

/* Lines are counted as int, and a line has a byte at least. */
static const size_t LONGEST_FILE = INT_MAX;

enum {
    CANCEL_POLL_LINES = 4096
};

/* Read one line; *found is false for one without a sphere. */
static Status readSphere(TextCursor *cursor, ListedSphere *sphere, bool *found)
{
    double numbers[4];
    Word first = {0}, word = {0};
    size_t count = 0;
    for (; nextWord(cursor, &word); count++) {
        if (count == 0)
            first = word;
        if (count == 4)
            return errorAtWord(
                &word, 0, "A line has four numbers, x y z radius; begin a new line for the next sphere.");
        Status status = wordToNumber(&word, DBL_MAX, &numbers[count]);
        if (!statusIsOk(&status))
            return status;
        if (count == 3 && !(numbers[3] > 0))
            return errorAtWord(&word, 0, "The radius, the fourth number, must be above 0.");
    }
    if (count > 0 && count < 4)
        return errorAtWord(&first, 0, "A line needs four numbers, x y z radius; this one has %zu.", count);
    *found = count == 4;
    if (*found)
        *sphere = (ListedSphere){createVector(numbers[0], numbers[1], numbers[2]), numbers[3]};
    return statusOk();
}

Status parseSphereList(const char *text, size_t length, ListedSphere **spheres, size_t *count)
{
    TextCursor cursor = createTextCursor(text, length);
    ListedSphere *list = NULL;
    size_t number = 0, capacity = 0;
    Status status = statusOk();
    do {
        if (number == capacity) {
            size_t larger = capacity < 64 ? 64 : 2 * capacity;
            ListedSphere *moved = realloc(list, larger * sizeof *moved);
            if (moved == NULL) {
                status = statusOutOfMemory();
                break;
            }
            list = moved;
            capacity = larger;
        }
        bool found = false;
        status = readSphere(&cursor, &list[number], &found);
        number += found;
        if (statusIsOk(&status) && cursor.line % CANCEL_POLL_LINES == 0 && cancelRequested())
            status = statusInterrupted();
    } while (statusIsOk(&status) && nextLine(&cursor));
    if (statusIsOk(&status) && number == 0)
        status = statusError(
            STATUS_SCENE, "The file has no spheres; write one on each line as four numbers, x y z radius.");
    if (!statusIsOk(&status)) {
        free(list);
        return status;
    }
    *spheres = list;
    *count = number;
    return status;
}

Status readSphereList(const char *path, ListedSphere **spheres, size_t *count)
{
    char *text = NULL;
    size_t length = 0;
    Status status = readWholeFile(path, LONGEST_FILE, &text, &length);
    if (!statusIsOk(&status))
        return status;
    status = parseSphereList(text, length, spheres, count);
    free(text);
    return status;
}
