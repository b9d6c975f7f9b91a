/* part_place.c - the place and the size that an object would need; see part_search.h.
 *
 * The size alone and the place alone are looked for first: one by the golden section, the other in steps over
 * the picture and then downhill. Then both together. What counts is always how far off the traced picture is.
 */
#include "explain/downhill.h"
#include "explain/part_search.h"

#include <math.h>

enum {
    SIMPLEX_TURNS = 70, /* each traces the scene once or twice */
    RESTARTS = 3,
    STEPS_TO_A_SIDE = 4, /* over the picture */
    GOLDEN_STEPS = 14
};

/* Tells how far off an object is that is moved along the camera's axes and scaled. The numbers are how far to
 * the right, up and away it is moved, in sizes of it, and the logarithm of its scale. */
typedef struct PlaceFit {
    PartSearch *search;
    PartChange change;
    Vector3D right, up, away; /* of unit length */
    double distance;          /* from the camera, in sizes; INFINITY where it does not matter */
    double size;              /* of the object, in scene units; the unit of the moves */
} PlaceFit;

static void applyNumbers(const PlaceFit *fit, const double *numbers, PartChange *change)
{
    change->offset = addVectors(addVectors(multVector(fit->right, numbers[0] * fit->size),
                                           multVector(fit->up, numbers[1] * fit->size)),
                                multVector(fit->away, numbers[2] * fit->size));
    change->scale = exp(numbers[3]);
}

static double measureNumbers(void *context, const double numbers[MOST_NUMBERS])
{
    PlaceFit *fit = context;
    if (!(fabs(numbers[3]) < 3))
        return INFINITY;
    applyNumbers(fit, numbers, &fit->change);
    return measurePart(fit->search, &fit->change);
}

/* ---- The size alone ---- */

typedef struct SizeFit {
    PlaceFit *fit;
    double *numbers;
} SizeFit;

static double measureSize(void *context, double size)
{
    const SizeFit *alone = context;
    alone->numbers[3] = size;
    return measureNumbers(alone->fit, alone->numbers);
}

static double fitSize(PlaceFit *fit, double numbers[MOST_NUMBERS])
{
    double best = 0, least = INFINITY;
    for (double size = -1.2; size <= 1.21; size += 0.2) {
        numbers[3] = size;
        double left = measureNumbers(fit, numbers);
        if (left < least) {
            least = left;
            best = size;
        }
    }
    SizeFit alone = {fit, numbers};
    numbers[3] = goldenSection(measureSize, &alone, best - 0.2, best + 0.2, GOLDEN_STEPS);
    return measureNumbers(fit, numbers);
}

/* ---- The place ---- */

/* Go over the picture in steps of half the object's size. */
static void fitPlaceRoughly(PlaceFit *fit, double numbers[MOST_NUMBERS])
{
    double best[2] = {0, 0}, least = INFINITY;
    for (int j = -STEPS_TO_A_SIDE; j <= STEPS_TO_A_SIDE; j++) {
        for (int i = -STEPS_TO_A_SIDE; i <= STEPS_TO_A_SIDE; i++) {
            double tried[MOST_NUMBERS] = {0.25 * i, 0.25 * j, 0, 0};
            double left = measureNumbers(fit, tried);
            if (left < least) {
                least = left;
                best[0] = tried[0];
                best[1] = tried[1];
            }
        }
    }
    numbers[0] = best[0];
    numbers[1] = best[1];
}

/* Narrow down the first so many numbers; returns how far off they are then. A simplex that has shrunk on the
 * way is opened again where it came to. */
static double narrowDown(PlaceFit *fit, int dimensions, double numbers[MOST_NUMBERS])
{
    Downhill downhill = {.measure = measureNumbers,
                         .context = fit,
                         .dimensions = dimensions,
                         .step = 0.1,
                         .enough = 0.2 * fit->search->rounding,
                         .turns = SIMPLEX_TURNS,
                         .hope = HOPEFUL_SHARE * fit->search->before,
                         .hopeTurns = SIMPLEX_TURNS / 3};
    double left = goDownhill(&downhill, numbers);
    for (int i = 0; i < RESTARTS && left < downhill.hope && left > downhill.enough; i++) {
        downhill.step *= 0.7;
        left = goDownhill(&downhill, numbers);
    }
    return left;
}

/* ---- What is tried ---- */

/* The length that the scene file gives for the object's size, or 1 where it gives none or several. */
static double givenSize(const Object *object)
{
    return object->kind == SHAPE_SPHERE ? object->sphere.radius
           : object->kind == SHAPE_CUBE ? object->cube.size
                                        : 1;
}

static double roundTo(double value, double step)
{
    return round(value / step) * step;
}

/* Try the numbers as the change with the fewest digits that fits as well. */
static void tryNumbers(PlaceFit *fit, const double *numbers, double left)
{
    PartSearch *search = fit->search;
    if (!(left < FITTED_PART_SHARE * search->before))
        return;
    PartChange exact = fit->change, rounded;
    applyNumbers(fit, numbers, &exact);
    double given = givenSize(&search->truth->scene->objects[exact.number]);
    double step = pow(10, ceil(log10(fit->size))); /* at least the size */
    for (int digits = 1; digits <= 4; digits++) {
        step /= 10;
        rounded = exact;
        rounded.offset = createVector(roundTo(exact.offset.x, step), roundTo(exact.offset.y, step),
                                      roundTo(exact.offset.z, step));
        if (exact.scale != 1)
            rounded.scale = roundTo(exact.scale * given, given == 1 ? step / fit->size : step) / given;
        if (fabs(rounded.scale - 1) < 1e-9)
            rounded.scale = 1;
        if (rounded.scale > 0 && measurePart(search, &rounded) <= 1.02 * left + 0.05 * search->rounding)
            break;
        rounded = exact;
    }
    tryPart(search, &rounded, FITTED_PART_SHARE);
}

/* Where it has moved away, let it be smaller instead, and the other way round: it looks nearly the same. */
static void exchangeDistanceForSize(const PlaceFit *fit, double numbers[MOST_NUMBERS])
{
    double ratio = isfinite(fit->distance) ? 1 + numbers[2] / fit->distance : 1;
    if (!(ratio > 0.05))
        return;
    numbers[0] /= ratio;
    numbers[1] /= ratio;
    numbers[2] = 0;
    numbers[3] -= log(ratio);
}

/* Find place and size together, from what was found alone. More pixels are looked at, since what tells an
 * object that is near from one that is large is little. */
static void fitFinely(PlaceFit *fit, double numbers[MOST_NUMBERS])
{
    PartSearch *search = fit->search;
    const Evidence *few = search->evidence;
    search->evidence = search->manyPixels;
    double exchanged[MOST_NUMBERS];
    for (int k = 0; k < MOST_NUMBERS; k++)
        exchanged[k] = numbers[k];
    tryNumbers(fit, numbers, narrowDown(fit, 3, numbers));
    if (!isPartExact(search)) {
        exchangeDistanceForSize(fit, exchanged);
        tryNumbers(fit, exchanged, narrowDown(fit, MOST_NUMBERS, exchanged));
    }
    if (!isPartExact(search))
        tryNumbers(fit, numbers, narrowDown(fit, MOST_NUMBERS, numbers));
    search->evidence = few;
}

void tryPlaces(PartSearch *search, const PartChange *target)
{
    const Scene *scene = search->truth->scene;
    const Object *object = &scene->objects[target->number];
    Bounds bounds;
    Vector3D middle;
    if (!objectBounds(object, &bounds) || !findObjectMiddle(object, &middle))
        return;
    CameraFrame frame = cameraFrame(&scene->camera, search->evidence->width, search->evidence->height);
    PlaceFit fit = {.search = search,
                    .change = *target,
                    .right = normalize(frame.right),
                    .up = normalize(frame.up),
                    .away = frame.forward,
                    .size = norm(subVectors(bounds.max, bounds.min)),
                    .distance = INFINITY};
    fit.change.kind = PART_PLACE;
    if (!(fit.size > 0) || !isfinite(fit.size))
        return;
    if (frame.projection == PROJECTION_PERSPECTIVE)
        fit.distance = norm(subVectors(middle, frame.position)) / fit.size;
    double bySize[MOST_NUMBERS] = {0, 0, 0, 0}, byPlace[MOST_NUMBERS] = {0, 0, 0, 0};
    double leftBySize = fitSize(&fit, bySize);
    tryNumbers(&fit, bySize, leftBySize);
    if (isPartExact(search))
        return;
    fitPlaceRoughly(&fit, byPlace);
    double leftByPlace = narrowDown(&fit, 3, byPlace);
    if (fmin(leftBySize, leftByPlace) < HOPEFUL_SHARE * search->before)
        fitFinely(&fit, leftBySize < leftByPlace ? bySize : byPlace);
}
