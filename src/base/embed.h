/* embed.h - whole files as strings in the program.
 *
 * The assembler's .incbin puts a file into the read-only data as it is (the C standard has no #embed before
 * C23). The path is relative to the folder that the compiler runs in, the project's root. The compiler does
 * not see the file: the Makefile lists it as a prerequisite.
 */
#ifndef ECLAIRAGE_BASE_EMBED_H
#define ECLAIRAGE_BASE_EMBED_H

/* Define the string called symbol, declared elsewhere as extern const char[], with a NUL at its end. */
#define EMBED_FILE(symbol, path)                                                                             \
    __asm__(".pushsection .rodata\n"                                                                         \
            ".global " symbol "\n" symbol ":\n"                                                              \
            ".incbin \"" path "\"\n"                                                                         \
            ".byte 0\n"                                                                                      \
            ".popsection\n")

#endif
