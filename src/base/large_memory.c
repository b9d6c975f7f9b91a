/* large_memory.c - zeroed memory for whole pictures; see large_memory.h. */
#define _DEFAULT_SOURCE
#include "base/large_memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

enum {
    LARGE = 4 << 20 /* bytes: two pages of the size that Linux has on most machines */
};

void *allocateZeroed(size_t count, size_t size)
{
    void *memory = calloc(count, size);
#ifdef MADV_HUGEPAGE
    if (memory != NULL && count * size >= LARGE) {
        /* The first whole page in the block; the block itself begins a few bytes before it. */
        size_t page = (size_t)sysconf(_SC_PAGESIZE);
        size_t skipped = (page - (uintptr_t)memory % page) % page;
        /* A wish: where it fails everything is as before. */
        madvise((char *)memory + skipped, count * size - skipped, MADV_HUGEPAGE);
    }
#endif
    return memory;
}
