/* fade.c - how light weakens with the distance d, by 1/d^2 and by POV-Ray's rule; as CSV.
 *
 *     cc -O2 -o fade notes/experiments/fade.c && ./fade > fade.csv
 *
 * POV-Ray 3.7 with fade_distance D and fade_power 2 multiplies a light by 2 / (1 + (d/D)^2). With D = 2^-20
 * its colour is written K = 2^39 times as large.
 */
#include <stdio.h>

int main(void)
{
    const double D = 1.0 / 1048576, K = 549755813888.0;
    printf("distance,inverse_square,fade_1,fade_1_half,fade_tiny\n");
    for (int i = 2; i <= 40; i++) {
        double d = i / 8.0;
        printf("%g,%.9f,%.9f,%.9f,%.9f\n", d, 1 / (d * d), 2 / (1 + d * d), 1 / (1 + d * d),
               K * 2 / (1 + (d / D) * (d / D)));
    }
    return 0;
}
