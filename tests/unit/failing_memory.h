/* failing_memory.h - memory that runs out: for a test program of its own, which includes it once.
 *
 * The allocator is replaced by one that fails at the n-th call, for every n. That needs glibc's own names
 * for its allocator and no sanitizer, which brings an allocator itself; elsewhere CAN_FAIL is 0 and the test
 * skips. For one thread: set `allowed`, then `armed`, call, and disarm; allowed == 0 then says that a call
 * may have failed.
 */
#ifndef ECLAIRAGE_TESTS_FAILING_MEMORY_H
#define ECLAIRAGE_TESTS_FAILING_MEMORY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

#if defined(__has_feature)
#define SANITIZED __has_feature(address_sanitizer)
#elif defined(__SANITIZE_ADDRESS__)
#define SANITIZED 1
#else
#define SANITIZED 0
#endif

#if defined(__GLIBC__) && !SANITIZED && !defined(__SANITIZE_ADDRESS__)
#define CAN_FAIL 1

extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *memory, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);
extern void __libc_free(void *memory);

static bool armed;
static long allowed; /* allocations that still succeed while armed */
static long blocks;  /* allocated and not freed */

static bool mayAllocate(void)
{
    if (armed && allowed == 0)
        return false;
    allowed -= armed;
    return true;
}

void *malloc(size_t size)
{
    void *memory = mayAllocate() ? __libc_malloc(size) : NULL;
    blocks += memory != NULL;
    return memory;
}

void *calloc(size_t count, size_t size)
{
    void *memory = mayAllocate() ? __libc_calloc(count, size) : NULL;
    blocks += memory != NULL;
    return memory;
}

void *realloc(void *memory, size_t size)
{
    if (!mayAllocate())
        return NULL;
    void *moved = __libc_realloc(memory, size);
    blocks += memory == NULL && moved != NULL;
    return moved;
}

void *aligned_alloc(size_t alignment, size_t size)
{
    void *memory = mayAllocate() ? __libc_memalign(alignment, size) : NULL;
    blocks += memory != NULL;
    return memory;
}

void free(void *memory)
{
    blocks -= memory != NULL;
    __libc_free(memory);
}

#else
#define CAN_FAIL 0
static bool armed;
static long allowed, blocks;
#endif

#endif
