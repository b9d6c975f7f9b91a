/* threads.h - run independent tasks on several threads.
 *
 * Tasks are numbered and handed out by one atomic counter, so the assignment of tasks to threads is
 * not fixed: a task must write only what belongs to its own number, and then the result is the same
 * for every number of threads.
 */
#ifndef ECLAIRAGE_BASE_THREADS_H
#define ECLAIRAGE_BASE_THREADS_H

#include "base/status.h"

#include <stddef.h>

/* One task: number is 0 .. taskCount-1. */
typedef void (*Task)(void *context, size_t number);

/* Run task(context, n) for every n below taskCount on up to threadCount threads (the calling thread is
 * one of them; where no further thread can be made, fewer do all the work). Returns when all are done.
 * After requestCancel() no new task is handed out and the result is statusInterrupted(). */
Status runTasks(size_t taskCount, int threadCount, Task task, void *context);

/* The processors this process may run on, at least 1, at most 256. */
int availableProcessors(void);

#endif
