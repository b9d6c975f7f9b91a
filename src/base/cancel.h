/* cancel.h - the one flag that stops long work.
 *
 * main's signal handler sets it; every loop that can run longer than about 50 ms looks at it, cleans
 * up after itself and returns statusInterrupted(). It is never cleared.
 */
#ifndef ECLAIRAGE_BASE_CANCEL_H
#define ECLAIRAGE_BASE_CANCEL_H

#include <stdbool.h>

/* Ask all running work to stop. Safe to call from a signal handler and from any thread. */
void requestCancel(void);

/* Whether somebody asked. Cheap enough to call once for each row of pixels. */
bool cancelRequested(void);

#endif
