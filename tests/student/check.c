/* Check pixels of PNG files: check FILE X Y R G B [FILE X Y R G B]...; prints TAP. */
#include "image/image.h"

#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    int failures = 0;
    printf("1..%d\n", (argc - 1) / 6);
    for (int i = 1; i + 5 < argc; i += 6) {
        Image image = {0};
        Status status = readPng(argv[i], &image);
        int x = atoi(argv[i + 1]), y = atoi(argv[i + 2]);
        int found[3] = {-1, -1, -1};
        if (statusIsOk(&status) && x < image.width && y < image.height)
            for (int c = 0; c < 3; c++)
                found[c] = image.samples[3 * (y * image.width + x) + c];
        freeImage(&image);
        int same =
            found[0] == atoi(argv[i + 3]) && found[1] == atoi(argv[i + 4]) && found[2] == atoi(argv[i + 5]);
        failures += !same;
        printf("%sok %d - %s (%d, %d) is %s %s %s\n", same ? "" : "not ", (i + 5) / 6, argv[i], x, y,
               argv[i + 3], argv[i + 4], argv[i + 5]);
        if (!same)
            printf("# found %d %d %d %s\n", found[0], found[1], found[2], status.message);
    }
    return failures > 0;
}
