/* yaml_scalar.h - what a word in a YAML file means.
 *
 * The core schema of YAML 1.2 (section 10.3.2), not that of 1.1: `yes` and `on` are text, 0o17 is fifteen,
 * 017 is seventeen, 1_000 and 1:30 are text. What stands in quotes is always text. Independent of the
 * locale.
 */
#ifndef ECLAIRAGE_SCENE_YAML_SCALAR_H
#define ECLAIRAGE_SCENE_YAML_SCALAR_H

#include <stdbool.h>
#include <stddef.h>

typedef enum ScalarType {
    SCALAR_NULL,    /* nothing, ~ or null */
    SCALAR_BOOL,    /* true or false */
    SCALAR_INTEGER, /* digits, 0o17 or 0x1F */
    SCALAR_FLOAT,   /* with a point or an exponent, .inf, .nan */
    SCALAR_TEXT
} ScalarType;

typedef struct ScalarValue {
    ScalarType type;
    bool truth;    /* of a bool */
    double number; /* of an integer or a float, correctly rounded; infinite where it overflows */
    bool overflow; /* the number is finite but larger than a double can be */
} ScalarValue;

/* text is NUL-terminated, of length bytes; plain: it stood without quotes. */
ScalarValue readScalar(const char *text, size_t length, bool plain);

#endif
