/* name_table.c - names and their numbers; see name_table.h. */
#include "scene/name_table.h"

#include <stdlib.h>
#include <string.h>

uint64_t hashBytes(uint64_t hash, const void *bytes, size_t length)
{
    const unsigned char *s = bytes;
    for (size_t i = 0; i < length; i++)
        hash = (hash ^ s[i]) * UINT64_C(0x100000001b3);
    return hash;
}

/* The slot where the name is, or the empty one where it would be put. */
static size_t findSlot(const NameTable *table, const char *text, size_t length, uint64_t hash)
{
    size_t slot = (size_t)(hash ^ (hash >> 32)) & (table->slotCount - 1);
    while (table->slots[slot] != 0) {
        const Name *name = &table->names[table->slots[slot] - 1];
        if (name->hash == hash && name->length == length && memcmp(name->text, text, length) == 0)
            break;
        slot = (slot + 1) & (table->slotCount - 1);
    }
    return slot;
}

size_t findName(const NameTable *table, const char *text, size_t length)
{
    if (table->slotCount == 0)
        return NAME_NONE;
    size_t slot = findSlot(table, text, length, hashBytes(HASH_START, text, length));
    return table->slots[slot] != 0 ? table->slots[slot] - 1 : NAME_NONE;
}

/* Make room for one more name. */
static int reserve(NameTable *table)
{
    if (table->count == table->capacity) {
        size_t capacity = table->capacity == 0 ? 16 : table->capacity * 2;
        Name *names = realloc(table->names, capacity * sizeof *names);
        if (names == NULL)
            return 0;
        table->names = names;
        table->capacity = capacity;
    }
    if (2 * (table->count + 1) <= table->slotCount)
        return 1;

    /* Double the slots and put every name where it belongs now. */
    size_t slotCount = table->slotCount == 0 ? 32 : table->slotCount * 2;
    size_t *slots = calloc(slotCount, sizeof *slots);
    if (slots == NULL)
        return 0;
    free(table->slots);
    table->slots = slots;
    table->slotCount = slotCount;
    for (size_t i = 0; i < table->count; i++) {
        const Name *name = &table->names[i];
        table->slots[findSlot(table, name->text, name->length, name->hash)] = i + 1;
    }
    return 1;
}

size_t addName(NameTable *table, const char *text, size_t length)
{
    size_t known = findName(table, text, length);
    if (known != NAME_NONE)
        return known;
    char *copy = reserve(table) ? arenaCopy(&table->arena, text, length) : NULL;
    if (copy == NULL)
        return NAME_NONE;
    uint64_t hash = hashBytes(HASH_START, text, length);
    table->slots[findSlot(table, text, length, hash)] = table->count + 1;
    table->names[table->count] = (Name){copy, length, hash};
    return table->count++;
}

void freeNameTable(NameTable *table)
{
    free(table->names);
    free(table->slots);
    arenaFree(&table->arena);
    *table = (NameTable){0};
}
