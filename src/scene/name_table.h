/* name_table.h - names and their numbers.
 *
 * Each different name gets the next number, from 0; what belongs to a name is kept by the caller in an
 * array of its own. Finding and adding take constant time however many names there are (open addressing
 * with linear probing, Knuth, The Art of Computer Programming 3, section 6.4, algorithm L).
 * Invariant: slots has a power of two places, at most half of them taken.
 */
#ifndef ECLAIRAGE_SCENE_NAME_TABLE_H
#define ECLAIRAGE_SCENE_NAME_TABLE_H

#include "scene/arena.h"

#include <stddef.h>
#include <stdint.h>

#define NAME_NONE SIZE_MAX

typedef struct Name {
    const char *text; /* NUL-terminated; may hold NULs of its own */
    size_t length;
    uint64_t hash;
} Name;

/* {0} is an empty table. */
typedef struct NameTable {
    Name *names; /* by number */
    size_t count, capacity;
    size_t *slots; /* number + 1, or 0 */
    size_t slotCount;
    Arena arena;
} NameTable;

/* The number of a name, or NAME_NONE. */
size_t findName(const NameTable *table, const char *text, size_t length);

/* The number of a name, which is added where it is new; NAME_NONE when memory runs out. */
size_t addName(NameTable *table, const char *text, size_t length);

void freeNameTable(NameTable *table);

/* A hash of bytes (FNV-1a, 64 bits), continuing from hash. */
#define HASH_START UINT64_C(0xcbf29ce484222325)
uint64_t hashBytes(uint64_t hash, const void *bytes, size_t length);

#endif
