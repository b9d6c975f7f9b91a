/* trait_list.h - how the list of traits is put together; for hypothesis.c, value_traits.c and light_traits.c.
 */
#ifndef ECLAIRAGE_EXPLAIN_TRAIT_LIST_H
#define ECLAIRAGE_EXPLAIN_TRAIT_LIST_H

#include "explain/hypothesis.h"

/* The numbers of a trait that are tried first, as two fields of it. */
#define GRID(name) .grid = name, .gridCount = (int)(sizeof name / sizeof *name)

/* Add one; more than MAX_TRAITS are left out. */
void addTrait(Traits *traits, Trait trait);

/* Add one with a choice, or with each choice of a range, both ends included. */
void addChoice(Traits *traits, Trait trait, int choice);
void addChoices(Traits *traits, Trait trait, int first, int last);

/* Add all of a kind; scene may be NULL, but for light. */
void addValueTraits(const Scene *scene, StoredFormat file, Traits *traits);
void addViewTraits(Traits *traits);
void addLightTraits(const Scene *scene, Traits *traits);

#endif
