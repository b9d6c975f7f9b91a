/* story_words.c - lines of text from formats that know vectors, colours and objects; see story_words.h. */
#include "explain/story_words.h"

#include <stdarg.h>

enum {
    DIGITS = 5
};

static void appendNumber(Text *text, double value)
{
    textAppendRounded(text, value, DIGITS);
}

static void appendTriple(Text *text, double x, double y, double z)
{
    textAppend(text, "(");
    appendNumber(text, x);
    textAppend(text, ", ");
    appendNumber(text, y);
    textAppend(text, ", ");
    appendNumber(text, z);
    textAppend(text, ")");
}

/* Append by a format; see story_words.h. */
static void appendWords(Teller *teller, const char *format, va_list arguments)
{
    Text *text = teller->text;
    for (const char *f = format; *f != '\0'; f++) {
        if (*f != '%') {
            textAppendBytes(text, f, 1);
            continue;
        }
        switch (*++f) {
        case 'v': {
            Vector3D v = va_arg(arguments, Vector3D);
            appendTriple(text, v.x, v.y, v.z);
            break;
        }
        case 'c': {
            Color3f c = va_arg(arguments, Color3f);
            appendTriple(text, (double)c.r, (double)c.g, (double)c.b);
            break;
        }
        case 'g':
            appendNumber(text, va_arg(arguments, double));
            break;
        case 's':
            textAppend(text, va_arg(arguments, const char *));
            break;
        case 'u':
            textAppendFormat(text, "%zu", va_arg(arguments, size_t));
            break;
        case 'd':
            textAppendFormat(text, "%d", va_arg(arguments, int));
            break;
        case 'o': {
            const Object *object = va_arg(arguments, const Object *);
            const Object *part = va_arg(arguments, const Object *);
            appendObjectName(teller->story->scene, object, part, text);
            break;
        }
        default:
            break;
        }
    }
}

void addWords(Teller *teller, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    appendWords(teller, format, arguments);
    va_end(arguments);
}

void beginLine(Teller *teller)
{
    textAppendFormat(teller->text, "%*s", teller->indent, "");
}

void sayLine(Teller *teller, const char *format, ...)
{
    beginLine(teller);
    va_list arguments;
    va_start(arguments, format);
    appendWords(teller, format, arguments);
    va_end(arguments);
    textAppend(teller->text, "\n");
}

void sayHeading(Teller *teller, const char *format, ...)
{
    textAppend(teller->text, "\n");
    beginLine(teller);
    textAppend(teller->text, teller->color ? "\x1b[1m" : "");
    va_list arguments;
    va_start(arguments, format);
    appendWords(teller, format, arguments);
    va_end(arguments);
    textAppend(teller->text, teller->color ? "\x1b[0m\n" : "\n");
}
