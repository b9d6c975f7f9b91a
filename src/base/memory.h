/* memory.h - what is worth telling the system about large pieces of memory. */
#ifndef ECLAIRAGE_BASE_MEMORY_H
#define ECLAIRAGE_BASE_MEMORY_H

#include <stddef.h>

/* Ask for pages of 2 MiB in place of 4 KiB where the memory is large: to touch a new page costs about the
 * same whatever its size. Only a hint, which changes nothing but time; memory: from malloc, of size bytes. */
void useLargePages(void *memory, size_t size);

#endif
