/* part_place.c - the place and the size that an object would need; see part_search.h.
 *
 * The size alone and the place alone are looked for first: one by the golden section, the other in steps over
 * the picture and then by Nelder and Mead's method (1965, "A simplex method for function minimization"). Then
 * both together. What counts is always how far off the traced picture is.
 */
#include "explain/part_search.h"

#include <math.h>

enum {
    MOST_NUMBERS = 4,    /* to the right, up, away, and the logarithm of the size */
    SIMPLEX_STEPS = 90,  /* each traces the scene once or twice */
    STEPS_TO_A_SIDE = 4, /* over the picture */
    GOLDEN_STEPS = 14
};

/* Tells how far off an object is that is moved along the camera's axes and scaled. */
typedef struct PlaceFit {
    PartSearch *search;
    PartChange change;
    Vector3D right, up, away; /* of unit length */
    double size;              /* of the object, in scene units; the unit of the moves */
} PlaceFit;

static void applyNumbers(const PlaceFit *fit, const double *numbers, PartChange *change)
{
    change->offset = addVectors(addVectors(multVector(fit->right, numbers[0] * fit->size),
                                           multVector(fit->up, numbers[1] * fit->size)),
                                multVector(fit->away, numbers[2] * fit->size));
    change->scale = exp(numbers[3]);
}

static double measureNumbers(PlaceFit *fit, const double *numbers)
{
    if (!(fabs(numbers[3]) < 3))
        return INFINITY;
    applyNumbers(fit, numbers, &fit->change);
    return measurePart(fit->search, &fit->change);
}

/* ---- The size alone ---- */

static double fitSize(PlaceFit *fit, double numbers[MOST_NUMBERS])
{
    const double ratio = 0.6180339887498949;
    double best = 0, least = INFINITY;
    for (double size = -1.2; size <= 1.21; size += 0.2) {
        numbers[3] = size;
        double left = measureNumbers(fit, numbers);
        if (left < least) {
            least = left;
            best = size;
        }
    }
    double a = best - 0.2, b = best + 0.2;
    for (int step = 0; step < GOLDEN_STEPS && statusIsOk(&fit->search->status); step++) {
        double x = b - ratio * (b - a), y = a + ratio * (b - a);
        numbers[3] = x;
        double atX = measureNumbers(fit, numbers);
        numbers[3] = y;
        if (atX <= measureNumbers(fit, numbers))
            b = y;
        else
            a = x;
    }
    numbers[3] = 0.5 * (a + b);
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

typedef struct Corner {
    double numbers[MOST_NUMBERS];
    double left;
} Corner;

static void sortCorners(Corner *corners, int count)
{
    for (int i = 1; i < count; i++)
        for (int j = i; j > 0 && corners[j].left < corners[j - 1].left; j--) {
            Corner moved = corners[j];
            corners[j] = corners[j - 1];
            corners[j - 1] = moved;
        }
}

/* The point from the middle of all corners but the last, so far from it on the line to the last one. */
static Corner cornerAlong(PlaceFit *fit, const Corner *corners, int dimensions, double far)
{
    Corner made = {.left = INFINITY};
    for (int k = 0; k < MOST_NUMBERS; k++) {
        double middle = 0;
        for (int i = 0; i < dimensions; i++)
            middle += corners[i].numbers[k] / dimensions;
        made.numbers[k] = middle + far * (corners[dimensions].numbers[k] - middle);
    }
    made.left = measureNumbers(fit, made.numbers);
    return made;
}

/* Go downhill from the numbers in the first so many of them; returns how far off they are then. */
static double goDownhill(PlaceFit *fit, int dimensions, double step, double numbers[MOST_NUMBERS])
{
    Corner corners[MOST_NUMBERS + 1];
    for (int i = 0; i <= dimensions; i++) {
        for (int k = 0; k < MOST_NUMBERS; k++)
            corners[i].numbers[k] = numbers[k] + (k == i - 1 ? step : 0);
        corners[i].left = measureNumbers(fit, corners[i].numbers);
    }
    sortCorners(corners, dimensions + 1);
    for (int turn = 0; turn < SIMPLEX_STEPS && statusIsOk(&fit->search->status); turn++) {
        Corner *last = &corners[dimensions];
        if (corners[0].left <= 0.2 * fit->search->rounding || last->left - corners[0].left < 1e-9)
            break;
        Corner mirrored = cornerAlong(fit, corners, dimensions, -1);
        if (mirrored.left < corners[0].left) {
            Corner farther = cornerAlong(fit, corners, dimensions, -2);
            *last = farther.left < mirrored.left ? farther : mirrored;
        } else if (mirrored.left < corners[dimensions - 1].left) {
            *last = mirrored;
        } else {
            Corner nearer = cornerAlong(fit, corners, dimensions, mirrored.left < last->left ? -0.5 : 0.5);
            if (nearer.left < last->left) {
                *last = nearer;
            } else {
                for (int i = 1; i <= dimensions; i++) {
                    for (int k = 0; k < MOST_NUMBERS; k++)
                        corners[i].numbers[k] = 0.5 * (corners[i].numbers[k] + corners[0].numbers[k]);
                    corners[i].left = measureNumbers(fit, corners[i].numbers);
                }
            }
        }
        sortCorners(corners, dimensions + 1);
    }
    for (int k = 0; k < MOST_NUMBERS; k++)
        numbers[k] = corners[0].numbers[k];
    return corners[0].left;
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
        if (rounded.scale > 0 && measurePart(search, &rounded) <= 1.02 * left + 0.05 * search->rounding)
            break;
        rounded = exact;
    }
    tryPart(search, &rounded, FITTED_PART_SHARE);
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
                    .size = norm(subVectors(bounds.max, bounds.min))};
    fit.change.kind = PART_PLACE;
    if (!(fit.size > 0) || !isfinite(fit.size))
        return;
    double numbers[MOST_NUMBERS] = {0, 0, 0, 0};
    double bySize = fitSize(&fit, numbers);
    tryNumbers(&fit, numbers, bySize);
    if (isPartExact(search))
        return;
    double size = numbers[3];
    numbers[3] = 0;
    fitPlaceRoughly(&fit, numbers);
    double byPlace = goDownhill(&fit, 3, 0.1, numbers);
    tryNumbers(&fit, numbers, byPlace);
    if (isPartExact(search))
        return;
    if (bySize < byPlace) {
        numbers[0] = numbers[1] = numbers[2] = 0;
        numbers[3] = size;
    }
    double both = goDownhill(&fit, MOST_NUMBERS, 0.1, numbers);
    tryNumbers(&fit, numbers, both);
}
