/* arena.c - memory that is given back all at once; see arena.h. */
#include "scene/arena.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct ArenaBlock {
    ArenaBlock *older;
    size_t used, size;
    double bytes[]; /* aligned for all that is stored here */
};

enum {
    BLOCK_SIZE = 64 * 1024,
    ALIGNMENT = sizeof(double)
};

void *arenaAllocate(Arena *arena, size_t size)
{
    if (size > SIZE_MAX / 2)
        return NULL;
    size = (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    ArenaBlock *block = arena->newest;
    if (block == NULL || block->size - block->used < size) {
        size_t blockSize = size > BLOCK_SIZE ? size : BLOCK_SIZE;
        bool useSpare = blockSize == BLOCK_SIZE && arena->spare != NULL;
        block = useSpare ? arena->spare : malloc(sizeof *block + blockSize);
        if (block == NULL)
            return NULL;
        if (useSpare)
            arena->spare = NULL;
        *block = (ArenaBlock){.older = arena->newest, .size = blockSize};
        arena->newest = block;
    }
    void *memory = (char *)block->bytes + block->used;
    block->used += size;
    return memory;
}

char *arenaCopy(Arena *arena, const char *bytes, size_t length)
{
    char *copy = arenaAllocate(arena, length + 1);
    if (copy == NULL)
        return NULL;
    memcpy(copy, bytes, length);
    copy[length] = '\0';
    return copy;
}

ArenaMark arenaMark(const Arena *arena)
{
    return (ArenaMark){arena->newest, arena->newest != NULL ? arena->newest->used : 0};
}

void arenaRewind(Arena *arena, ArenaMark mark)
{
    while (arena->newest != mark.block) {
        ArenaBlock *block = arena->newest;
        arena->newest = block->older;
        if (arena->spare == NULL && block->size == BLOCK_SIZE)
            arena->spare = block;
        else
            free(block);
    }
    if (mark.block != NULL)
        mark.block->used = mark.used;
}

void arenaFree(Arena *arena)
{
    arenaRewind(arena, (ArenaMark){0});
    free(arena->spare);
    arena->spare = NULL;
}
