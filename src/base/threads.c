/* threads.c - run independent tasks on several threads; see threads.h. */
#define _GNU_SOURCE
#include "base/threads.h"

#include "base/cancel.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

enum {
    MAX_THREADS = 256
};

typedef struct TaskQueue {
    atomic_size_t next;
    size_t count;
    Task task;
    void *context;
} TaskQueue;

static void *work(void *argument)
{
    TaskQueue *queue = argument;
    while (!cancelRequested()) {
        size_t number = atomic_fetch_add_explicit(&queue->next, 1, memory_order_relaxed);
        if (number >= queue->count)
            break;
        queue->task(queue->context, number);
    }
    return NULL;
}

Status runTasks(size_t taskCount, int threadCount, Task task, void *context)
{
    TaskQueue queue = {.count = taskCount, .task = task, .context = context};
    atomic_init(&queue.next, 0);
    int helpers = threadCount < MAX_THREADS ? threadCount - 1 : MAX_THREADS - 1;
    if (helpers > 0 && (size_t)helpers >= taskCount)
        helpers = taskCount > 0 ? (int)taskCount - 1 : 0;
    pthread_t threads[MAX_THREADS];
    int started = 0;
    while (started < helpers && pthread_create(&threads[started], NULL, work, &queue) == 0)
        started++;
    work(&queue);
    for (int i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
    return cancelRequested() ? statusInterrupted() : statusOk();
}

int availableProcessors(void)
{
    int count = 1;
#ifdef CPU_COUNT
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        count = CPU_COUNT(&set);
    else
#endif
        count = (int)sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > MAX_THREADS ? MAX_THREADS : count;
}
