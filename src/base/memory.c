/* memory.c - large pieces of memory; see memory.h. */
#define _GNU_SOURCE
#include "base/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

enum {
    LARGE_MAPPING = 32 << 20, /* bytes; see memory.h */
    LARGE_BLOCK = 4 << 20     /* bytes: two pages of the size that Linux has on most machines */
};

/* Hint from a whole page on. */
static void adviseLargePages(uintptr_t start, uintptr_t end)
{
#ifdef MADV_HUGEPAGE
    madvise((void *)start, end - start, MADV_HUGEPAGE);
#else
    (void)start;
    (void)end;
#endif
}

void useLargePages(void *memory, size_t size)
{
    if (size < LARGE_MAPPING)
        return;
    /* Ask for the whole mapping, from the page that malloc's own words are in: realloc can move a mapping
     * that is of one kind without copying it. */
    uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE), start = (uintptr_t)memory;
    adviseLargePages(start / page * page, start + size);
}

void *allocateZeroed(size_t count, size_t size)
{
    void *memory = calloc(count, size);
    if (memory != NULL && count * size >= LARGE_BLOCK) {
        /* The first whole page in the block; the block itself begins a few bytes before it. */
        uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE), start = (uintptr_t)memory;
        adviseLargePages((start + page - 1) / page * page, start + count * size);
    }
    return memory;
}
