/* unlabel.c - copy a PNG without the chunks that say how its numbers are to be read.
 *
 *     cc -O2 -o unlabel notes/experiments/unlabel.c && ./unlabel linear.png student.png
 *
 * A linear picture loses its gAMA chunk, and whoever opens the copy takes its numbers for sRGB: the picture
 * that a program makes which writes linear light into a file as it is. A PNG is 8 bytes of signature and
 * then chunks: 4 bytes of length, 4 of name, the data, 4 of checksum. The other chunks are copied as they
 * are.
 */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int fail(const char *what, const char *file)
{
    fprintf(stderr, "unlabel: %s: %s\n", file, what);
    return 4;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: unlabel IN.png OUT.png\n");
        return 2;
    }
    FILE *in = fopen(argv[1], "rb");
    unsigned char head[8];
    if (in == NULL || fread(head, 1, 8, in) != 8 || memcmp(head, "\x89PNG\r\n\x1a\n", 8) != 0)
        return fail("cannot be read, or is not a PNG", argv[1]);
    FILE *out = fopen(argv[2], "wb");
    if (out == NULL || fwrite(head, 1, 8, out) != 8)
        return fail("cannot be written", argv[2]);

    while (fread(head, 1, 8, in) == 8) {
        size_t length = (size_t)head[0] << 24 | (size_t)head[1] << 16 | (size_t)head[2] << 8 | head[3];
        bool label = memcmp(head + 4, "gAMA", 4) == 0 || memcmp(head + 4, "cHRM", 4) == 0 ||
                     memcmp(head + 4, "sRGB", 4) == 0 || memcmp(head + 4, "iCCP", 4) == 0;
        unsigned char *rest = malloc(length + 4);
        if (rest == NULL || fread(rest, 1, length + 4, in) != length + 4)
            return fail("ends too early", argv[1]);
        if (!label && (fwrite(head, 1, 8, out) != 8 || fwrite(rest, 1, length + 4, out) != length + 4))
            return fail("cannot be written", argv[2]);
        free(rest);
    }
    fclose(in);
    return fclose(out) == 0 ? 0 : fail("cannot be written", argv[2]);
}
