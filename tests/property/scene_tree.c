/* scene_tree.c - a scene as a tree that can be made smaller; see scene_tree.h. */
#include "scene_tree.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *allocate(void *memory, size_t size)
{
    void *larger = realloc(memory, size);
    if (larger == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(4);
    }
    return larger;
}

/* ---- Growing ---- */

static Node *createNode(NodeKind kind, const char *key)
{
    Node *node = allocate(NULL, sizeof *node);
    *node = (Node){.kind = kind, .key = key};
    return node;
}

static Node *append(Node *parent, Node *child)
{
    if (parent->count == parent->capacity) {
        parent->capacity = 2 * parent->capacity + 4;
        parent->children = allocate(parent->children, parent->capacity * sizeof *parent->children);
    }
    parent->children[parent->count++] = child;
    return child;
}

Node *createTree(void)
{
    return createNode(NODE_MAPPING, NULL);
}

Node *addMapping(Node *parent, const char *key)
{
    return append(parent, createNode(NODE_MAPPING, key));
}

Node *addList(Node *parent, const char *key)
{
    return append(parent, createNode(NODE_LIST, key));
}

void addNumber(Node *parent, const char *key, double number)
{
    append(parent, createNode(NODE_SCALAR, key))->number = number;
}

void addWord(Node *parent, const char *key, const char *word)
{
    append(parent, createNode(NODE_SCALAR, key))->word = word;
}

void addTriple(Node *parent, const char *key, double x, double y, double z)
{
    Node *list = addList(parent, key);
    addNumber(list, NULL, x);
    addNumber(list, NULL, y);
    addNumber(list, NULL, z);
}

Node *copyTree(const Node *tree)
{
    Node *copy = createNode(tree->kind, tree->key);
    copy->isFixed = tree->isFixed;
    copy->word = tree->word;
    copy->number = tree->number;
    for (size_t i = 0; i < tree->count; i++)
        append(copy, copyTree(tree->children[i]));
    return copy;
}

void freeTree(Node *tree)
{
    for (size_t i = 0; i < tree->count; i++)
        freeTree(tree->children[i]);
    free(tree->children);
    free(tree);
}

/* ---- Writing ---- */

static void writeFlow(const Node *node, Text *text)
{
    if (node->key != NULL)
        textAppendFormat(text, "%s: ", node->key);
    if (node->kind == NODE_SCALAR) {
        if (node->word != NULL)
            textAppend(text, node->word);
        else
            textAppendDouble(text, node->number);
        return;
    }
    textAppend(text, node->kind == NODE_LIST ? "[" : "{");
    for (size_t i = 0; i < node->count; i++) {
        textAppend(text, i > 0 ? ", " : "");
        writeFlow(node->children[i], text);
    }
    textAppend(text, node->kind == NODE_LIST ? "]" : "}");
}

void writeTree(const Node *tree, Text *text)
{
    for (size_t i = 0; i < tree->count; i++) {
        const Node *section = tree->children[i];
        bool hasItems =
            section->kind == NODE_LIST && section->count > 0 && section->children[0]->kind == NODE_MAPPING;
        if (!hasItems) {
            writeFlow(section, text);
            textAppend(text, "\n");
            continue;
        }
        textAppendFormat(text, "%s:\n", section->key);
        for (size_t j = 0; j < section->count; j++) {
            textAppend(text, "  - ");
            writeFlow(section->children[j], text);
            textAppend(text, "\n");
        }
    }
}

/* ---- Making smaller ---- */

/* Whether a list is one of numbers, a point or a colour, which has a fixed length. */
static bool isTuple(const Node *node)
{
    return node->kind == NODE_LIST && node->count > 0 && node->children[0]->kind == NODE_SCALAR;
}

static void removeChild(Node *node, size_t i)
{
    freeTree(node->children[i]);
    node->count--;
    memmove(&node->children[i], &node->children[i + 1], (node->count - i) * sizeof *node->children);
}

/* Try to use up the edits left at and below the node; true when the last one was made. */
static bool cutOff(Node *node, size_t *left)
{
    for (size_t i = 0; i < node->count && !isTuple(node); i++) {
        if (!node->children[i]->isFixed && (*left)-- == 0) {
            removeChild(node, i);
            return true;
        }
        if (cutOff(node->children[i], left))
            return true;
    }
    return false;
}

/* The list of parts of an item {KIND: {objects: [...]}}, or NULL. */
static Node *partsOf(const Node *item)
{
    if (item->kind != NODE_MAPPING || item->count != 1 || item->children[0]->kind != NODE_MAPPING)
        return NULL;
    const Node *values = item->children[0];
    for (size_t i = 0; i < values->count; i++)
        if (strcmp(values->children[i]->key, "objects") == 0)
            return values->children[i];
    return NULL;
}

static bool hoistPart(Node *node, size_t *left)
{
    for (size_t i = 0; i < node->count; i++) {
        const Node *parts = partsOf(node->children[i]);
        for (size_t j = 0; parts != NULL && j < parts->count; j++) {
            if ((*left)-- == 0) {
                Node *part = copyTree(parts->children[j]);
                freeTree(node->children[i]);
                node->children[i] = part;
                return true;
            }
        }
        if (hoistPart(node->children[i], left))
            return true;
    }
    return false;
}

static bool roundNumber(Node *node, size_t *left)
{
    for (size_t i = 0; i < node->count; i++)
        if (roundNumber(node->children[i], left))
            return true;
    if (node->kind != NODE_SCALAR || node->word != NULL)
        return false;
    for (double digits = 10; digits <= 1000; digits *= 10) {
        /* Not to whole numbers, or faces would fall on one another. */
        double rounded = round(node->number * digits) / digits;
        if (rounded != node->number && (*left)-- == 0) {
            node->number = rounded;
            return true;
        }
    }
    return false;
}

Node *makeSmaller(const Node *tree, size_t edit)
{
    Node *copy = copyTree(tree);
    if (cutOff(copy, &edit) || hoistPart(copy, &edit) || roundNumber(copy, &edit))
        return copy;
    freeTree(copy);
    return NULL;
}
