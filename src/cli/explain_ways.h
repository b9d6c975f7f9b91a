/* explain_ways.h - the ways to explain: what POV-Ray's habits change, and what is wrong with a picture. */
#ifndef ECLAIRAGE_CLI_EXPLAIN_WAYS_H
#define ECLAIRAGE_CLI_EXPLAIN_WAYS_H

#include "cli/command.h"

/* With a scene alone: how much of the picture each of POV-Ray's habits changes. Returns the exit code. */
int explainWithPovray(const Arguments *arguments);

/* With a picture, and before it a scene or, after it, another picture: which mistakes turn the right one into
 * it. Returns the exit code. */
int explainPictureFile(const Arguments *arguments);

#endif
