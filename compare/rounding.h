/* rounding.h - numbers in words, with no more digits than a reader needs. */
#ifndef ECLAIRAGE_COMPARE_ROUNDING_H
#define ECLAIRAGE_COMPARE_ROUNDING_H

#include "base/text.h"

/* The value rounded to this many significant digits, 1 to 17, without zeros behind them, with a point in
 * every locale: "0.0123", "4.58e-05"; "nan", "inf". Returns buffer. */
char *formatRounded(char buffer[NUMBER_TEXT_SIZE], double value, int digits);

#endif
