/* pov_faces.h - keeps faces of solids from coinciding in POV-Ray.
 *
 * Where faces of two parts of a solid coincide POV-Ray asks whether a point of one is inside the other, and
 * rounding answers: a hole as deep as its block has a lid, a cross of two beams a hole, a block cut with
 * itself specks. So what is written is what is done by hand: one of the two faces is moved by 2^-24 of its
 * numbers, far more than rounding and far less than a pixel, to the side where it does no harm.
 */
#ifndef ECLAIRAGE_POVRAY_POV_FACES_H
#define ECLAIRAGE_POVRAY_POV_FACES_H

#include "shapes/shape.h"

/* Which part an object is, of which solid, and what that solid is a part of; NULL there: of none. */
typedef struct PovPart {
    const Object *solid; /* of kind SHAPE_CSG */
    size_t number;       /* in its parts */
    const struct PovPart *outer;
} PovPart;

/* The shape of the part with its flat faces moved off those of the parts that they coincide with; a cube
 * comes back as a box. Owns nothing that part does not own; not released. part: not of kind SHAPE_CSG. */
Object separatedPart(const Object *part, const PovPart *place);

#endif
