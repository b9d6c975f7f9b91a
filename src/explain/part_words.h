/* part_words.h - what is said of a mistake in a part of the scene, and of where the pixels that differ lie.
 */
#ifndef ECLAIRAGE_EXPLAIN_PART_WORDS_H
#define ECLAIRAGE_EXPLAIN_PART_WORDS_H

#include "explain/explain_picture.h"
#include "explain/part_search.h"

/* Add what was found to the causes. source may be NULL. */
void tellPart(const PartFinding *finding, const Scene *scene, const SceneSource *source,
              Explanations *causes);

/* Add to an explanation that knows no cause, whose text and where are told as far as the pictures go: the
 * objects that the pixels that differ belong to, and where the scene has the first of them. */
void tellOwners(const DifferenceOwners *owners, const Scene *scene, const SceneSource *source,
                Explanation *told);

#endif
