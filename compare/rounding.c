/* rounding.c - numbers in words; see rounding.h.
 *
 * The value becomes an integer of so many digits and goes back by an exact power of ten, which gives the
 * double nearest to a short decimal; formatDouble finds that decimal.
 */
#include "compare/rounding.h"

#include <math.h>
#include <stdlib.h>

enum {
    EXACT_POWERS = 22 /* up to 10^22 the powers of ten are doubles */
};

char *formatRounded(char buffer[NUMBER_TEXT_SIZE], double value, int digits)
{
    if (!isfinite(value) || value == 0)
        return formatDouble(buffer, value);
    int exponent = (int)floor(log10(fabs(value))) + 1 - digits;
    if (abs(exponent) > EXACT_POWERS)
        return formatDouble(buffer, value);
    double power = pow(10, abs(exponent));
    return formatDouble(buffer, exponent < 0 ? round(value * power) / power : round(value / power) * power);
}
