/* scene_tree.h - a scene as a tree of mappings, lists and scalars that can be written as YAML and made
 * smaller.
 *
 * The tree knows nothing of the scene format. It makes smaller scenes blindly, one edit at a time, in a fixed
 * order; whether one is still valid, and still shows what is looked for, is for others to find out (Zeller
 * and Hildebrandt 2002, "Simplifying and isolating failure-inducing input", with edits in place of subsets).
 * Ownership: a node owns what is below it.
 */
#ifndef ECLAIRAGE_TESTS_SCENE_TREE_H
#define ECLAIRAGE_TESTS_SCENE_TREE_H

#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum NodeKind {
    NODE_SCALAR,
    NODE_LIST,
    NODE_MAPPING
} NodeKind;

typedef struct Node {
    NodeKind kind;
    const char *key;  /* in a mapping; not owned */
    bool isFixed;     /* never left out */
    const char *word; /* of a scalar that is no number; not owned */
    double number;    /* of a scalar without a word */
    struct Node **children;
    size_t count, capacity;
} Node;

/* Each adds a child to a mapping, or with key NULL to a list, and returns it. They end the program when
 * memory runs out. */
Node *createTree(void);
Node *addMapping(Node *parent, const char *key);
Node *addList(Node *parent, const char *key);
void addNumber(Node *parent, const char *key, double number);
void addWord(Node *parent, const char *key, const char *word);
/* A list of three numbers. */
void addTriple(Node *parent, const char *key, double x, double y, double z);

Node *copyTree(const Node *tree);
void freeTree(Node *tree);

/* Append the tree as YAML: a line for each section, and one for each item of a section that is a list. */
void writeTree(const Node *tree, Text *text);

/* A copy made smaller by edit number 0, 1, ..., or NULL when there are not so many. From large to small:
 * leave out a key or an item, put a part in the place of its group or solid, round a number. */
Node *makeSmaller(const Node *tree, size_t edit);

#endif
