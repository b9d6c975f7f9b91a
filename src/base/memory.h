/* memory.h - large pieces of memory.
 *
 * A system hands out memory in pages of 4 KiB when they are first touched, and for hundreds of megabytes that
 * takes longer than filling them. Where it has larger pages, ask for those; that is only a hint, and changes
 * nothing but time.
 */
#ifndef ECLAIRAGE_BASE_MEMORY_H
#define ECLAIRAGE_BASE_MEMORY_H

#include <stddef.h>

/* Ask for large pages where the memory, from malloc and of size bytes, is 32 MiB or more: glibc gives each
 * such piece a mapping of its own, and realloc can then still move it without copying. */
void useLargePages(void *memory, size_t size);

/* Like calloc, with large pages from 4 MiB on: zeroed memory for count elements of size bytes, freed by free;
 * NULL when there is too little or count times size overflows. For what is not made larger later. */
void *allocateZeroed(size_t count, size_t size);

#endif
