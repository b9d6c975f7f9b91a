/* report_template.c - the report's page, style and scripts, embedded in the program. */
#include "compare/report_template.h"

#include "base/embed.h"

EMBED_FILE("reportPage", "compare/report.html");
EMBED_FILE("reportStyle", "compare/report.css");
EMBED_FILE("reportPictureScript", "compare/report_picture.js");
EMBED_FILE("reportScript", "compare/report.js");
