/* html.c - pieces of an HTML page; see html.h. */
#include "compare/html.h"

#include "base/text.h"

#include <stdbool.h>
#include <string.h>

static const char replacement[] = "\xEF\xBF\xBD"; /* U+FFFD */

/* Whether a valid character is a control character: C0, DEL, or C1 (U+0080 to U+009F, C2 80 to C2 9F). */
static bool isControl(const unsigned char *s)
{
    return s[0] < 0x20 || s[0] == 0x7F || (s[0] == 0xC2 && s[1] < 0xA0);
}

/* Whether a valid character changes the direction of the text around it: U+202A to U+202E, U+2066 to U+2069
 * (E2 80 AA to AE, E2 81 A6 to A9). */
static bool turnsDirection(const unsigned char *s)
{
    return s[0] == 0xE2 &&
           ((s[1] == 0x80 && s[2] >= 0xAA && s[2] <= 0xAE) || (s[1] == 0x81 && s[2] >= 0xA6 && s[2] <= 0xA9));
}

/* The reference for a character with a meaning in HTML, or NULL. */
static const char *htmlReference(unsigned char c)
{
    switch (c) {
    case '&':
        return "&amp;";
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '"':
        return "&quot;";
    case '\'':
        return "&#39;";
    default:
        return NULL;
    }
}

void textAppendHtml(Text *html, const char *text)
{
    for (const unsigned char *s = (const unsigned char *)(text != NULL ? text : ""); *s != '\0';) {
        size_t length = utf8Length((const char *)s);
        const char *reference = htmlReference(*s);
        bool layout = *s == '\t' || *s == '\n';
        if (length == 0 || (isControl(s) && !layout) || turnsDirection(s))
            textAppend(html, replacement);
        else if (reference != NULL)
            textAppend(html, reference);
        else
            textAppendBytes(html, s, length);
        s += length == 0 ? 1 : length;
    }
}

size_t textAppendPlain(Text *plain, const char *text)
{
    size_t characters = 0;
    for (const unsigned char *s = (const unsigned char *)(text != NULL ? text : ""); *s != '\0';) {
        size_t length = utf8Length((const char *)s);
        if (length == 0 || isControl(s) || turnsDirection(s))
            textAppend(plain, replacement);
        else
            textAppendBytes(plain, s, length);
        s += length == 0 ? 1 : length;
        characters++;
    }
    return characters;
}

void textAppendFileAddress(Text *html, const char *fileName)
{
    static const char kept[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
    textAppend(html, "./");
    for (const unsigned char *s = (const unsigned char *)(fileName != NULL ? fileName : ""); *s != '\0';
         s++) {
        if (strchr(kept, *s) != NULL)
            textAppendBytes(html, s, 1);
        else
            textAppendFormat(html, "%%%02X", *s);
    }
}

void writeBase64(FILE *stream, const void *data, size_t length)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned char *bytes = data;
    char block[4 * 1024];
    size_t filled = 0;
    for (size_t i = 0; i < length; i += 3) {
        /* Take three bytes, zeros behind the end, as four digits of six bits. */
        size_t left = length - i;
        unsigned group = (unsigned)bytes[i] << 16;
        if (left > 1)
            group |= (unsigned)bytes[i + 1] << 8;
        if (left > 2)
            group |= bytes[i + 2];
        block[filled++] = digits[group >> 18];
        block[filled++] = digits[group >> 12 & 63];
        block[filled++] = left > 1 ? digits[group >> 6 & 63] : '=';
        block[filled++] = left > 2 ? digits[group & 63] : '=';
        if (filled == sizeof block || left <= 3) {
            fwrite(block, 1, filled, stream);
            filled = 0;
        }
    }
}
