/* colors.c - light as three numbers, and the picture made of them; see colors.h. */
#include "colors.h"

#include "base/cancel.h"
#include "base/memory.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/* The comparison is false for NaN, which so becomes 0. */
static float clampUnit(float value)
{
    return value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
}

ColorRGB clampColor(Color3f c)
{
    return (ColorRGB){clampUnit(c.r), clampUnit(c.g), clampUnit(c.b)};
}

Framebuffer *createFramebuffer(int width, int height)
{
    if (width < 1 || height < 1 || (size_t)width > SIZE_MAX / sizeof(Color3f) / (size_t)height)
        return NULL;
    Framebuffer *framebuffer = malloc(sizeof *framebuffer);
    Color3f *pixels = allocateZeroed((size_t)width * (size_t)height, sizeof *pixels);
    if (framebuffer == NULL || pixels == NULL) {
        free(framebuffer);
        free(pixels);
        return NULL;
    }
    *framebuffer = (Framebuffer){width, height, pixels};
    return framebuffer;
}

void freeFramebuffer(Framebuffer *framebuffer)
{
    if (framebuffer != NULL)
        free(framebuffer->pixels);
    free(framebuffer);
}

void putLinearPixel(Framebuffer *framebuffer, int x, int y, Color3f color)
{
    if (x >= 0 && x < framebuffer->width && y >= 0 && y < framebuffer->height)
        framebuffer->pixels[(size_t)y * (size_t)framebuffer->width + (size_t)x] = color;
}

void PutPixel(Framebuffer *framebuffer, int x, int y, ColorRGB color)
{
    putLinearPixel(framebuffer, x, y, createColor(color.r, color.g, color.b));
}

size_t countNonFinitePixels(const Framebuffer *framebuffer)
{
    size_t count = 0;
    const Color3f *pixel = framebuffer->pixels;
    for (int y = 0; y < framebuffer->height && !cancelRequested(); y++) {
        for (int x = 0; x < framebuffer->width; x++, pixel++) {
            /* A finite number times 0 is 0; any other is NaN, and so is a sum with it. */
            count += pixel->r * 0 + pixel->g * 0 + pixel->b * 0 != 0;
        }
    }
    return count;
}

float linearToSrgb(float linear)
{
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * powf(linear, 1.0f / 2.4f) - 0.055f;
}

float srgbToLinear(float srgb)
{
    return srgb < 0.04045f ? srgb / 12.92f : powf((srgb + 0.055f) / 1.055f, 2.4f);
}

unsigned quantizeSample(float linear, int bits, Encoding encoding)
{
    float value = clampUnit(linear);
    if (encoding == ENCODING_SRGB)
        value = clampUnit(linearToSrgb(value));
    float largest = bits == 16 ? 65535.0f : 255.0f;
    /* Not negative, so the conversion rounds down. */
    return (unsigned)(value * largest + 0.5f);
}
