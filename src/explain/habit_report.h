/* habit_report.h - a study of habits as a page and the files beside it. */
#ifndef ECLAIRAGE_EXPLAIN_HABIT_REPORT_H
#define ECLAIRAGE_EXPLAIN_HABIT_REPORT_H

#include "base/status.h"
#include "explain/habits.h"

/* What the page says beside the study, which must have kept its pictures. */
typedef struct HabitReport {
    const HabitStudy *study;
    const Scene *scene;
    const Image *ours;
    const char *name;    /* of the scene */
    const char *command; /* that writes the page again */
    int threads;
} HabitReport;

/* Write into an existing folder: index.html, one page that needs no other file; ours.png; and for matched,
 * native and each habit, by its name, NAME.pov, NAME.png and NAME-difference.png. STATUS_IO with the file and
 * the reason, STATUS_INTERRUPTED when cancelled; then some of them may be there, each of them whole. */
Status writeHabitReport(const char *folder, const HabitReport *report);

/* Append the name of a file that it may write beside index.html, by a number from 0 on; false, with nothing
 * appended, behind the last one. */
bool appendHabitFileName(int number, Text *name);

#endif
