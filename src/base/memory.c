/* memory.c - what is worth telling the system about large pieces of memory; see memory.h. */
#define _GNU_SOURCE
#include "base/memory.h"

#include <stdint.h>
#include <sys/mman.h>
#include <unistd.h>

void useLargePages(void *memory, size_t size)
{
    enum {
        LARGE = 32 << 20 /* bytes; glibc's malloc gives each piece from here on a mapping of its own */
    };
#ifdef MADV_HUGEPAGE
    if (size < LARGE)
        return;
    /* Ask for the whole mapping, from the page that malloc's own words are in: realloc can move a mapping
     * that is of one kind without copying it. */
    size_t page = (size_t)sysconf(_SC_PAGESIZE);
    uintptr_t start = (uintptr_t)memory / page * page;
    madvise((void *)start, (uintptr_t)memory + size - start, MADV_HUGEPAGE);
#else
    (void)memory;
    (void)size;
#endif
}
