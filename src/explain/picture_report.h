/* picture_report.h - what is wrong with a picture, as a page. */
#ifndef ECLAIRAGE_EXPLAIN_PICTURE_REPORT_H
#define ECLAIRAGE_EXPLAIN_PICTURE_REPORT_H

#include "base/status.h"
#include "explain/explain_picture.h"

/* What the page says beside what was found. */
typedef struct PictureReport {
    const PictureExplanation *explanation;
    const Image *mine, *right; /* of one size */
    const char *name;          /* of mine */
    const char *rightName;     /* of the right picture, or of the scene that it was drawn from */
    bool isDrawn;              /* from a scene */
    const char *command;       /* that writes the page again */
    int threads;
} PictureReport;

/* Write index.html, one page that needs no other file, into an existing folder. STATUS_IO with the file and
 * the reason, STATUS_INTERRUPTED when cancelled; then there is no new page. */
Status writePictureReport(const char *folder, const PictureReport *report);

#endif
