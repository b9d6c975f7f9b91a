/* arena.h - memory that is given back all at once.
 *
 * Blocks are taken from malloc and cut up from the front. arenaMark and arenaRewind give back what came
 * after a moment, so that reading a million objects one by one needs the memory of one.
 * Invariant: block->used <= block->size in every block; blocks are listed newest first.
 */
#ifndef ECLAIRAGE_SCENE_ARENA_H
#define ECLAIRAGE_SCENE_ARENA_H

#include <stddef.h>

typedef struct ArenaBlock ArenaBlock;

/* {0} is an empty arena. */
typedef struct Arena {
    ArenaBlock *newest;
    ArenaBlock *spare; /* one that was given back, for the next time; or NULL */
} Arena;

/* A moment in the life of an arena. */
typedef struct ArenaMark {
    ArenaBlock *block;
    size_t used;
} ArenaMark;

/* size bytes, not cleared, aligned for pointers and doubles; NULL when memory runs out. */
void *arenaAllocate(Arena *arena, size_t size);

/* A copy with a NUL behind it; NULL when memory runs out. */
char *arenaCopy(Arena *arena, const char *bytes, size_t length);

ArenaMark arenaMark(const Arena *arena);

/* Give back all that was allocated since the mark was taken; {0} marks the beginning. */
void arenaRewind(Arena *arena, ArenaMark mark);

void arenaFree(Arena *arena);

#endif
