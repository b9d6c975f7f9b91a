/* hypothesis.c - see hypothesis.h. */
#include "explain/trait_list.h"

Hypothesis neutralHypothesis(void)
{
    return (Hypothesis){
        .view = neutralViewChange(), .light = neutralLightChange(), .value = neutralValueChange()};
}

void addTrait(Traits *traits, Trait trait)
{
    if (traits->count < MAX_TRAITS)
        traits->items[traits->count++] = trait;
}

void addChoice(Traits *traits, Trait trait, int choice)
{
    trait.choice = choice;
    addTrait(traits, trait);
}

void addChoices(Traits *traits, Trait trait, int first, int last)
{
    for (int choice = first; choice <= last; choice++)
        addChoice(traits, trait, choice);
}

void listTraits(const Scene *scene, StoredFormat file, Traits *traits)
{
    traits->count = 0;
    addViewTraits(traits);
    addValueTraits(scene, file, traits);
    if (scene != NULL)
        addLightTraits(scene, traits);
}

bool traitsCombine(const Trait *a, const Trait *b)
{
    /* Each cause once, and what the same field of a hypothesis would hold twice not at all. */
    bool areTurns = a->cause != b->cause && (a->cause == CAUSE_MIRRORED || a->cause == CAUSE_FLIPPED);
    if (a->cause == b->cause || (a->apply == b->apply && !areTurns))
        return false;
    bool aFaces = a->cause == CAUSE_NORMALS || a->cause == CAUSE_NEGATIVE_LIGHT;
    bool bFaces = b->cause == CAUSE_NORMALS || b->cause == CAUSE_NEGATIVE_LIGHT;
    return !(aFaces && bFaces);
}
