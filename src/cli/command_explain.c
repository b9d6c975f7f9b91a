/* command_explain.c - `eclairage explain`: say why two pictures differ; see explain_ways.h. */
#include "cli/explain_ways.h"
#include "cli/scene_input.h"
#include "cli/terminal.h"

int runExplain(const Arguments *arguments)
{
    const char *first = arguments->operands[0];
    if (arguments->operandCount == 2)
        return explainPictureFile(arguments);
    if (isPictureName(first)) {
        Status status =
            statusError(STATUS_USAGE,
                        "%s alone cannot be explained: give what it should be as well, its scene before "
                        "it or the right picture after it",
                        first);
        return printError(NULL, &status);
    }
    return explainWithPovray(arguments);
}
