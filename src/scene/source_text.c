/* source_text.c - the text of a scene file, as characters in lines; see source_text.h. */
#include "scene/source_text.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char BYTE_ORDER_MARK[] = "\xEF\xBB\xBF";

SourceText openSourceText(const char *text, size_t length)
{
    if (length >= 3 && memcmp(text, BYTE_ORDER_MARK, 3) == 0) {
        text += 3;
        length -= 3;
    }
    return (SourceText){.text = text, .length = length};
}

void closeSourceText(SourceText *source)
{
    free(source->lineStarts);
    source->lineStarts = NULL;
    source->lineCount = 0;
}

/* ---- Characters ---- */

uint32_t decodeUtf8(const char *s, const char *end, size_t *size)
{
    const unsigned char *u = (const unsigned char *)s;
    size_t length = u[0] < 0x80   ? 1
                    : u[0] < 0xC2 ? 0
                    : u[0] < 0xE0 ? 2
                    : u[0] < 0xF0 ? 3
                    : u[0] < 0xF5 ? 4
                                  : 0;
    *size = 1;
    if (length == 0 || (size_t)(end - s) < length)
        return UINT32_MAX;
    uint32_t character = length == 1 ? u[0] : u[0] & (0x7Fu >> length);
    for (size_t i = 1; i < length; i++) {
        if ((u[i] & 0xC0) != 0x80)
            return UINT32_MAX;
        character = character << 6 | (u[i] & 0x3Fu);
    }

    /* Refuse what has a shorter form, the surrogates, and what is beyond Unicode. */
    bool overlong = (length == 3 && character < 0x800) || (length == 4 && character < 0x10000);
    bool surrogate = character >= 0xD800 && character <= 0xDFFF;
    if (overlong || surrogate || character > 0x10FFFF)
        return UINT32_MAX;
    *size = length;
    return character;
}

typedef struct Range {
    uint32_t first, last;
} Range;

static bool isInRanges(uint32_t character, const Range *ranges, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (character >= ranges[i].first && character <= ranges[i].last)
            return true;
    return false;
}

/* Whether a terminal or an editor could take the character for something else than a character to
 * show: control characters, and those that change the direction of writing. */
static bool isUnprintable(uint32_t character)
{
    static const Range unprintable[] = {{0x00, 0x1F},     {0x7F, 0x9F},     {0x200B, 0x200F},
                                        {0x2028, 0x202E}, {0x2060, 0x206F}, {0xFEFF, 0xFEFF},
                                        {0xFFF9, 0xFFFB}, {0xFFFE, 0xFFFF}, {0xE0000, UINT32_MAX}};
    return isInRanges(character, unprintable, sizeof unprintable / sizeof *unprintable);
}

int displayWidth(uint32_t character)
{
    static const Range combining[] = {
        {0x300, 0x36F}, {0x483, 0x489}, {0x20D0, 0x20FF}, {0xFE00, 0xFE0F}, {0xFE20, 0xFE2F}};
    static const Range wide[] = {{0x1100, 0x115F},   {0x2E80, 0x303E},   {0x3041, 0xA4CF},
                                 {0xAC00, 0xD7A3},   {0xF900, 0xFAFF},   {0xFE30, 0xFE6F},
                                 {0xFF00, 0xFF60},   {0xFFE0, 0xFFE6},   {0x1F300, 0x1F64F},
                                 {0x1F680, 0x1F6FF}, {0x1F900, 0x1F9FF}, {0x20000, 0x3FFFD}};
    if (character < 0x300)
        return 1;
    if (isInRanges(character, combining, sizeof combining / sizeof *combining))
        return 0;
    return isInRanges(character, wide, sizeof wide / sizeof *wide) ? 2 : 1;
}

/* ---- Lines ---- */

/* The bytes of the line end at s, or 0. */
static size_t lineEnd(const char *s, const char *end)
{
    const unsigned char *u = (const unsigned char *)s;
    size_t left = (size_t)(end - s);
    if (u[0] == '\n')
        return 1;
    if (u[0] == '\r')
        return left > 1 && u[1] == '\n' ? 2 : 1;
    if (u[0] == 0xC2 && left > 1 && u[1] == 0x85)
        return 2;
    if (u[0] == 0xE2 && left > 2 && u[1] == 0x80 && (u[2] == 0xA8 || u[2] == 0xA9))
        return 3;
    return 0;
}

/* Go through the text and note where lines begin; with starts NULL only count them. */
static size_t findLines(const SourceText *source, size_t *starts)
{
    const char *end = source->text + source->length;
    size_t count = 1;
    if (starts != NULL)
        starts[0] = 0;
    for (const char *s = source->text; s < end;) {
        size_t size = lineEnd(s, end);
        s += size > 0 ? size : 1;
        if (size > 0 && starts != NULL)
            starts[count] = (size_t)(s - source->text);
        count += size > 0;
    }
    return count;
}

const char *sourceLine(SourceText *source, int line, size_t *length)
{
    *length = 0;
    if (source->lineStarts == NULL) {
        size_t count = findLines(source, NULL);
        source->lineStarts = malloc(count * sizeof *source->lineStarts);
        if (source->lineStarts == NULL)
            return "";
        source->lineCount = findLines(source, source->lineStarts);
    }
    if (line < 1 || (size_t)line > source->lineCount)
        return "";
    const char *start = source->text + source->lineStarts[line - 1];
    const char *stop = source->text + source->length;
    if ((size_t)line < source->lineCount) {
        /* Step back over the line end before the next line: LF, CR, CR LF, or one of 2 or 3 bytes. */
        stop = source->text + source->lineStarts[line];
        if (stop[-1] == '\n')
            stop -= stop - start > 1 && stop[-2] == '\r' ? 2 : 1;
        else if (stop[-1] == '\r')
            stop -= 1;
        else
            stop -= (unsigned char)stop[-1] == 0x85 ? 2 : 3;
    }
    *length = (size_t)(stop - start);
    return start;
}

const char *sourceCharacter(SourceText *source, int line, int column)
{
    size_t length;
    const char *start = sourceLine(source, line, &length);
    const char *end = start + length;
    const char *s = start;
    int at = 1;
    if (source->foundLine == line && source->foundColumn <= column) {
        s = source->text + source->foundOffset;
        at = source->foundColumn;
    }
    for (; at < column && s < end; at++) {
        size_t size;
        decodeUtf8(s, end, &size);
        s += size;
    }
    if (at == column && length > 0) {
        source->foundLine = line;
        source->foundColumn = column;
        source->foundOffset = (size_t)(s - source->text);
    }
    return s;
}

/* ---- Encoding ---- */

/* The place of a byte. */
static Place placeOfOffset(const SourceText *source, size_t offset)
{
    Place place = {1, 1, 1};
    const char *end = source->text + source->length;
    for (const char *s = source->text; s < source->text + offset;) {
        size_t size = lineEnd(s, end);
        if (size > 0) {
            place.line++;
            place.column = 1;
        } else {
            decodeUtf8(s, end, &size);
            place.column++;
        }
        s += size;
    }
    return place;
}

/* Whether YAML allows the character as such (YAML 1.2, section 5.1, c-printable). */
static bool isAllowed(uint32_t c)
{
    return c == '\t' || c == '\n' || c == '\r' || (c >= 0x20 && c <= 0x7E) || c == 0x85 ||
           (c >= 0xA0 && c <= 0xFFFD) || c >= 0x10000;
}

static bool isUtf16(const SourceText *source)
{
    const unsigned char *u = (const unsigned char *)source->text;
    return source->length >= 2 && ((u[0] == 0xFE && u[1] == 0xFF) || (u[0] == 0xFF && u[1] == 0xFE));
}

/* The first of the bytes that is neither a printable character of ASCII nor LF; eight at a time. */
static const char *skipPlain(const char *s, const char *end)
{
    const uint64_t ones = UINT64_MAX / 255, highs = ones * 0x80, lows = ~highs;
    while (end - s >= 8) {
        /* Set the highest bit of each byte that is 0x80 or above, that borrows when 0x20 is taken from it, or
         * that 1 makes 0x80. A borrow or carry can only set too many bits, and then the bytes are looked at
         * one by one. */
        uint64_t x;
        memcpy(&x, s, sizeof x);
        uint64_t isOdd = (x | (x - ones * 0x20) | (x + ones)) & highs;

        /* Leave out the bytes that are LF: those, and only those, are 0 when LF is taken out of them. */
        uint64_t rest = x ^ (ones * '\n');
        uint64_t isFeed = ~(((rest & lows) + lows) | rest) & highs;
        if ((isOdd & ~isFeed) != 0)
            break;
        s += 8;
    }
    while (s < end && ((*s >= 0x20 && *s <= 0x7E) || *s == '\n'))
        s++;
    return s;
}

bool checkEncoding(const SourceText *source, EncodingFault *fault)
{
    fault->place = (Place){1, 1, 1};
    fault->isText = !isUtf16(source);
    if (!fault->isText) {
        snprintf(fault->message, sizeof fault->message, "the file is saved as UTF-16, not as UTF-8");
        fault->hint = "save it again with the encoding UTF-8";
        return false;
    }
    const char *end = source->text + source->length;
    for (const char *s = source->text; s < end;) {
        /* Skip what is plain quickly, and line ends, which most files have one of every few bytes. */
        s = skipPlain(s, end);
        if (s == end)
            break;
        size_t size;
        uint32_t character = decodeUtf8(s, end, &size);
        if (character != UINT32_MAX && isAllowed(character)) {
            s += size;
            continue;
        }
        fault->place = placeOfOffset(source, (size_t)(s - source->text));
        if (character == UINT32_MAX) {
            snprintf(fault->message, sizeof fault->message, "the byte 0x%02X here is not UTF-8 text",
                     (unsigned)(unsigned char)*s);
            fault->hint = "save the file again with the encoding UTF-8";
        } else if (character == 0) {
            snprintf(fault->message, sizeof fault->message,
                     "there is a zero byte here, which text never holds");
            fault->hint = "is this a YAML file? If so, save it again with the encoding UTF-8";
        } else {
            snprintf(fault->message, sizeof fault->message,
                     "the control character U+%04" PRIX32 " is not allowed in a scene", character);
            fault->hint = "remove it; an editor may show it as a box or not at all";
        }
        return false;
    }
    return true;
}

/* ---- Showing ---- */

void textAppendPrintable(Text *text, const char *bytes, size_t length)
{
    const char *end = bytes + length;
    for (const char *s = bytes; s < end;) {
        size_t size;
        uint32_t character = decodeUtf8(s, end, &size);
        if (isUnprintable(character) && character != '\t')
            textAppend(text, "\xEF\xBF\xBD");
        else
            textAppendBytes(text, s, size);
        s += size;
    }
}

Quote quoteBytes(const char *bytes, size_t length)
{
    enum {
        MOST_CHARACTERS = 40
    };
    Quote quote;
    size_t used = 0;
    const char *end = bytes + length;
    int count = 0;
    for (const char *s = bytes; s < end; count++) {
        char piece[16];
        size_t size;
        uint32_t character = decodeUtf8(s, end, &size);
        bool full = count == MOST_CHARACTERS;
        if (full)
            snprintf(piece, sizeof piece, "...");
        else if (character == UINT32_MAX)
            snprintf(piece, sizeof piece, "\\x%02X", (unsigned)(unsigned char)*s);
        else if (character == '\n')
            snprintf(piece, sizeof piece, "\\n");
        else if (character == '\t')
            snprintf(piece, sizeof piece, "\\t");
        else if (isUnprintable(character))
            snprintf(piece, sizeof piece, character < 0x100 ? "\\x%02" PRIX32 : "\\u%04" PRIX32, character);
        else
            snprintf(piece, sizeof piece, "%.*s", (int)size, s);
        size_t pieceLength = strlen(piece);
        if (used + pieceLength + 4 > sizeof quote.text)
            break;
        memcpy(quote.text + used, piece, pieceLength);
        used += pieceLength;
        if (full)
            break;
        s += size;
    }
    quote.text[used] = '\0';
    return quote;
}
