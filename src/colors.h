/* colors.h - light as three numbers, and the picture made of them (handout: colors.h).
 *
 * A Color3f is linear: twice the number is twice the light; at least 0 and not limited to 1. A ColorRGB
 * is what a screen can show: each component in 0..1. A Framebuffer holds linear colours as computed;
 * clamping, encoding and rounding happen once, when it becomes an 8- or 16-bit picture.
 * Colours are float, as in the handout and in POV-Ray (its COLC): with the same order of operations the
 * two then agree in the last bit.
 */
#ifndef ECLAIRAGE_COLORS_H
#define ECLAIRAGE_COLORS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct Color3f {
    float r, g, b;
} Color3f;

typedef struct ColorRGB {
    float r, g, b; /* each in 0..1 */
} ColorRGB;

/* How a sample in 0..1 is stored in a file: as it is, or by the curve of IEC 61966-2-1. */
typedef enum Encoding {
    ENCODING_SRGB,
    ENCODING_LINEAR
} Encoding;

/* Pixels in rows from the top, each row from the left: pixels[y * width + x]. */
typedef struct Framebuffer {
    int width, height; /* each at least 1 */
    Color3f *pixels;   /* owned by the framebuffer */
} Framebuffer;

static inline Color3f createColor(float r, float g, float b)
{
    return (Color3f){r, g, b};
}

static inline Color3f addColors(Color3f a, Color3f b)
{
    return (Color3f){a.r + b.r, a.g + b.g, a.b + b.b};
}

/* Channel by channel: what a surface of colour a returns of light b. */
static inline Color3f multColors(Color3f a, Color3f b)
{
    return (Color3f){a.r * b.r, a.g * b.g, a.b * b.b};
}

/* Each channel times a double, rounded to float once. */
static inline Color3f scaleColor(Color3f c, double factor)
{
    return (Color3f){(float)((double)c.r * factor), (float)((double)c.g * factor),
                     (float)((double)c.b * factor)};
}

/* a for t = 0, b for t = 1, rounded to float at each step as POV-Ray does it: a + t (b - a). */
static inline Color3f mixColors(Color3f a, Color3f b, double t)
{
    Color3f difference = {b.r - a.r, b.g - a.g, b.b - a.b};
    return addColors(a, scaleColor(difference, t));
}

static inline bool colorIsBlack(Color3f c)
{
    return c.r == 0 && c.g == 0 && c.b == 0;
}

/* Colours that are added up, in double, for their mean. */
typedef struct ColorSum {
    double r, g, b;
} ColorSum;

static inline void addToSum(ColorSum *sum, Color3f color)
{
    sum->r += (double)color.r;
    sum->g += (double)color.g;
    sum->b += (double)color.b;
}

/* The sum divided by count, which is not 0, and rounded to float. */
static inline Color3f meanColor(ColorSum sum, double count)
{
    return (Color3f){(float)(sum.r / count), (float)(sum.g / count), (float)(sum.b / count)};
}

/* Each component clamped to 0..1 (handout, exercise 03a); NaN becomes 0. */
ColorRGB clampColor(Color3f c);

/* A black framebuffer, or NULL when memory runs out or width or height is below 1. The caller frees it
 * with freeFramebuffer. */
Framebuffer *createFramebuffer(int width, int height);
void freeFramebuffer(Framebuffer *framebuffer);

/* Set one pixel; (0, 0) is the top left one. Outside the picture nothing happens. */
void PutPixel(Framebuffer *framebuffer, int x, int y, ColorRGB color);

/* The same with a linear colour that is not clamped: what the tracers of this library store. */
void putLinearPixel(Framebuffer *framebuffer, int x, int y, Color3f color);

/* The pixels that have a channel that is not finite, which a PNG cannot hold; when cancelled, those found
 * until then. */
size_t countNonFinitePixels(const Framebuffer *framebuffer);

/* The sRGB curve and its inverse (IEC 61966-2-1), for a value in 0..1. */
float linearToSrgb(float linear);
float srgbToLinear(float srgb);

/* A sample as stored in a file: clamped to 0..1 (NaN: 0), encoded, rounded to
 * floor(v (2^bits - 1) + 1/2). bits is 8 or 16. Float throughout, as POV-Ray's IntEncode. */
unsigned quantizeSample(float linear, int bits, Encoding encoding);

#endif
