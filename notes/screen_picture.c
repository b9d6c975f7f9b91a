/* screen_picture.c - pictures made small for a page.
 *
 *   screen-picture IN.png OUT.png [IN.png OUT.png]...
 *
 * Renderers are compared on 16-bit linear PNGs, which no screen can show and which are five times as large as
 * what one sees of them. Each IN is written to OUT as 8 bits of sRGB, by the same rounding as `eclairage
 * render`; a picture that is 8-bit sRGB already keeps its samples.
 */
#include "colors.h"
#include "image/image.h"

#include <stdio.h>
#include <stdlib.h>

static Status writeForScreen(const char *from, const char *to)
{
    Image image, screen;
    Status status = readPng(from, &image);
    if (!statusIsOk(&status))
        return status;
    status = createImage(image.width, image.height, 8, ENCODING_SRGB, &screen);
    if (statusIsOk(&status)) {
        const unsigned most = imageMaxSample(&image);
        const size_t count = 3 * (size_t)image.width * (size_t)image.height;
        for (size_t i = 0; i < count; i++) {
            const float value = (float)image.samples[i] / (float)most;
            const Encoding curve = image.encoding == ENCODING_LINEAR ? ENCODING_SRGB : ENCODING_LINEAR;
            screen.samples[i] = (uint16_t)quantizeSample(value, 8, curve);
        }
        status = writePng(to, &screen, 1);
        freeImage(&screen);
    }
    freeImage(&image);
    return status;
}

int main(int argc, char **argv)
{
    if (argc < 3 || argc % 2 == 0) {
        fprintf(stderr, "usage: screen-picture IN.png OUT.png [IN.png OUT.png]...\n");
        return 2;
    }
    for (int i = 1; i < argc; i += 2) {
        const Status status = writeForScreen(argv[i], argv[i + 1]);
        if (!statusIsOk(&status)) {
            fprintf(stderr, "screen-picture: %s\n", status.message);
            return 1;
        }
    }
    return 0;
}
