/* large_memory.h - zeroed memory for whole pictures.
 *
 * A system hands out memory in pages of 4 kB when they are first touched, and for the hundred megabytes of
 * a large picture that takes longer than filling them. Where the system has larger pages, ask for those.
 */
#ifndef ECLAIRAGE_BASE_LARGE_MEMORY_H
#define ECLAIRAGE_BASE_LARGE_MEMORY_H

#include <stddef.h>

/* Like calloc: zeroed memory for count elements of size bytes, freed by free; NULL when there is too little
 * or count times size overflows. */
void *allocateZeroed(size_t count, size_t size);

#endif
