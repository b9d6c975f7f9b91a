/* svg_pieces.c - the pieces that a drawing is put together from; see svg_pieces.h. */
#include "explain/svg_pieces.h"

#include <string.h>

void appendEscaped(Text *text, const char *words)
{
    for (const char *c = words; *c != '\0';) {
        size_t length = utf8Length(c);
        if (length == 0 || (length == 1 && (unsigned char)*c < 0x20) || *c == 0x7F) {
            textAppend(text, "?");
            length = 1;
        } else if (length == 3 && memcmp(c, "\xEF\xBF", 2) == 0 && (unsigned char)c[2] >= 0xBE) {
            textAppend(text, "?"); /* U+FFFE and U+FFFF */
        } else if (*c == '&') {
            textAppend(text, "&amp;");
        } else if (*c == '<') {
            textAppend(text, "&lt;");
        } else if (*c == '>') {
            textAppend(text, "&gt;");
        } else if (*c == '"') {
            textAppend(text, "&quot;");
        } else {
            textAppendBytes(text, c, length);
        }
        c += length;
    }
}

void appendAttribute(Text *text, const char *name, double value)
{
    textAppendFormat(text, " %s=\"", name);
    appendPixels(text, value);
    textAppend(text, "\"");
}

void appendLine(Text *text, DrawnPoint a, DrawnPoint b, const char *attributes)
{
    textAppend(text, "<line");
    appendAttribute(text, "x1", a.x);
    appendAttribute(text, "y1", a.y);
    appendAttribute(text, "x2", b.x);
    appendAttribute(text, "y2", b.y);
    textAppendFormat(text, " %s/>\n", attributes);
}

void appendCircle(Text *text, DrawnPoint at, double radius, const char *attributes)
{
    textAppend(text, "<circle");
    appendAttribute(text, "cx", at.x);
    appendAttribute(text, "cy", at.y);
    appendAttribute(text, "r", radius);
    textAppendFormat(text, " %s/>\n", attributes);
}

void appendMarker(Text *text, const char *name, const char *color)
{
    textAppendFormat(text,
                     "<marker id=\"%s\" viewBox=\"0 0 10 10\" refX=\"8\" refY=\"5\" markerWidth=\"5\" "
                     "markerHeight=\"5\" orient=\"auto-start-reverse\"><path d=\"M0 0L10 5L0 10z\" "
                     "fill=\"%s\"/></marker>\n",
                     name, color);
}

size_t countCharacters(const char *words)
{
    size_t count = 0;
    for (; *words != '\0'; words++)
        count += ((unsigned char)*words & 0xC0) != 0x80;
    return count;
}
