/* part_lamp_place.c - the place that a lamp would need; see part_search.h.
 *
 * A lamp in the wrong place often has a wrong sign or two coordinates exchanged: these are looked at first.
 * From the best of them, or from where the scene has the lamp if that is better, the search goes downhill.
 */
#include "explain/downhill.h"
#include "explain/part_search.h"

#include <math.h>

enum {
    MOST_MOVED_LAMPS = 3, /* that are looked at, since each takes hundreds of pictures */
    SIMPLEX_TURNS = 80,
    DIMENSIONS = 3
};

typedef struct LampFit {
    PartSearch *search;
    PartChange change;
    double size; /* the unit of the numbers, in scene units */
} LampFit;

static Vector3D positionOf(const LampFit *fit, const double numbers[MOST_NUMBERS])
{
    return createVector(numbers[0] * fit->size, numbers[1] * fit->size, numbers[2] * fit->size);
}

static double measureLamp(void *context, const double numbers[MOST_NUMBERS])
{
    LampFit *fit = context;
    fit->change.lamp.position = positionOf(fit, numbers);
    return measurePart(fit->search, &fit->change);
}

static double goFrom(LampFit *fit, double numbers[MOST_NUMBERS])
{
    Downhill downhill = {.measure = measureLamp,
                         .context = fit,
                         .dimensions = DIMENSIONS,
                         .step = 0.15,
                         .enough = 0.2 * fit->search->rounding,
                         .turns = SIMPLEX_TURNS,
                         .hope = HOPEFUL_SHARE * fit->search->before,
                         .hopeTurns = SIMPLEX_TURNS / 3};
    return goDownhill(&downhill, numbers);
}

/* The other places that a slip of the pen makes: signs, and two coordinates exchanged. */
static double findSlip(LampFit *fit, const double from[MOST_NUMBERS], double best[MOST_NUMBERS])
{
    double least = INFINITY;
    for (int signs = 1; signs < 8 + DIMENSIONS; signs++) {
        double tried[MOST_NUMBERS] = {from[0], from[1], from[2], 0};
        if (signs < 8) {
            for (int k = 0; k < DIMENSIONS; k++)
                tried[k] = (signs >> k & 1) != 0 ? -from[k] : from[k];
        } else {
            int a = signs - 8, b = (a + 1) % DIMENSIONS;
            tried[a] = from[b];
            tried[b] = from[a];
        }
        double left = measureLamp(fit, tried);
        if (left < least) {
            least = left;
            for (int k = 0; k < MOST_NUMBERS; k++)
                best[k] = tried[k];
        }
    }
    return least;
}

/* Try the place, with the fewest digits that fit as well. */
static void tryPosition(LampFit *fit, const double numbers[MOST_NUMBERS], double left)
{
    PartSearch *search = fit->search;
    if (!(left < FITTED_PART_SHARE * search->before))
        return;
    Vector3D exact = positionOf(fit, numbers);
    double step = pow(10, ceil(log10(fit->size)));
    for (int digits = 1; digits <= 4; digits++) {
        step /= 10;
        fit->change.lamp.position = createVector(round(exact.x / step) * step, round(exact.y / step) * step,
                                                 round(exact.z / step) * step);
        if (measurePart(search, &fit->change) <= 1.02 * left + 0.05 * search->rounding)
            break;
        fit->change.lamp.position = exact;
    }
    tryPart(search, &fit->change, FITTED_PART_SHARE);
}

void tryLampPlaces(PartSearch *search)
{
    const Scene *scene = search->truth->scene;
    for (size_t i = 0; i < scene->lightCount && i < MOST_MOVED_LAMPS && !isPartExact(search); i++) {
        const Light *light = &scene->lights[i];
        if (light->kind == LIGHT_DIRECTIONAL)
            continue;
        LampFit fit = {.search = search,
                       .change = {.kind = PART_LAMP, .number = i, .lamp = *light},
                       .size = fmax(norm(light->position), 1e-3)};
        double from[MOST_NUMBERS] = {light->position.x / fit.size, light->position.y / fit.size,
                                     light->position.z / fit.size, 0};
        double slip[MOST_NUMBERS];
        double *start = findSlip(&fit, from, slip) < search->before ? slip : from;
        double left = goFrom(&fit, start);
        tryPosition(&fit, start, left);
    }
}
