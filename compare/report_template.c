/* report_template.c - the report's page, style and script, embedded in the program.
 *
 * The four files are put into the read-only data as they are, by the assembler's .incbin (the C standard
 * has no #embed before C23). Their paths are relative to the folder that the compiler runs in, the
 * project's root. The compiler does not see them: the Makefile lists them as prerequisites.
 */
#include "compare/report_template.h"

#define EMBED_FILE(symbol, path)                                                                             \
    __asm__(".pushsection .rodata\n"                                                                         \
            ".global " symbol "\n" symbol ":\n"                                                              \
            ".incbin \"" path "\"\n"                                                                         \
            ".byte 0\n"                                                                                      \
            ".popsection\n")

EMBED_FILE("reportPage", "compare/report.html");
EMBED_FILE("reportStyle", "compare/report.css");
EMBED_FILE("reportPictureScript", "compare/report_picture.js");
EMBED_FILE("reportScript", "compare/report.js");
