/* story_light_text.c - what each light does at a point, in words; see story_words.h.
 *
 * The names are the handout's, as in story_text.c. Each term stands as a formula first, with its numbers
 * next, and its value last.
 */
#include "explain/story_words.h"

#include <math.h>

enum {
    FEW_LIGHTS = 4 /* point lights of an area that are all told in full */
};

static void sayCrossings(Teller *teller, const LightStory *light)
{
    size_t kept = light->crossingCount < MOST_CROSSINGS ? light->crossingCount : MOST_CROSSINGS;
    for (size_t i = 0; i < kept; i++)
        sayLine(teller, "            through %o at distance %g: times %c", light->crossings[i].object,
                light->crossings[i].part, light->crossings[i].distance, light->crossings[i].transmission);
    if (kept < light->crossingCount)
        sayLine(teller, "            and %u transparent surfaces behind these", light->crossingCount - kept);
}

static void sayShadow(Teller *teller, const LightStory *light)
{
    if (!light->hasShadowRay) {
        sayLine(teller, "shadow      not asked: the scene says shadows: false");
        return;
    }
    if (light->blocker != NULL) {
        beginLine(teller);
        addWords(teller, "shadow      blocked by %o at distance %g", light->blocker, light->blockerPart,
                 light->blockedAt);
        if (isfinite(light->arriving.distance))
            addWords(teller, " of %g", light->arriving.distance);
        addWords(teller, ": this light adds nothing\n");
        return;
    }
    if (light->crossingCount == 0) {
        sayLine(teller, "shadow      nothing lies between the point and the light");
        return;
    }
    sayLine(teller, "shadow      only what is transparent lies between:");
    sayCrossings(teller, light);
    sayLine(teller, "            left of the light: %c%s", light->reaching,
            light->fate == LIGHT_BLOCKED ? ": this light adds nothing" : "");
}

/* The factors of a term: Lc and what is left of it, with or without numbers. */
typedef struct LightFactors {
    Color3f color;
    int parts;   /* point lights that share it */
    double cone; /* of a spot light; NAN: none */
    bool isFiltered;
    Color3f filter;
    bool hasFalloff;
    double squared;
} LightFactors;

static double largestChannel(Color3f c)
{
    return fmax((double)c.r, fmax((double)c.g, (double)c.b));
}

static float share(float part, float whole)
{
    return whole != 0 ? part / whole : 0;
}

static LightFactors factorsOf(const Light *lamp, const LightStory *light)
{
    LightFactors factors = {.color = lamp->color,
                            .parts = lightSampleCount(lamp),
                            .cone = NAN,
                            .isFiltered = light->crossingCount > 0 && light->fate == LIGHT_REACHES,
                            .hasFalloff =
                                lamp->kind != LIGHT_DIRECTIONAL && lamp->falloff == FALLOFF_INVERSE_SQUARE,
                            .squared = light->arriving.distance * light->arriving.distance};
    if (lamp->kind == LIGHT_SPOT)
        factors.cone = largestChannel(light->arriving.color) / largestChannel(lamp->color) *
                       (factors.hasFalloff ? factors.squared : 1);
    Color3f before = light->arriving.color, left = light->reaching;
    factors.filter = createColor(share(left.r, before.r), share(left.g, before.g), share(left.b, before.b));
    return factors;
}

/* Append "Lc * cone" and the like, then the last factor, then "/ d^2"; first in symbols, then in numbers. */
static void addFactors(Teller *teller, const LightFactors *factors, bool numbers, const char *symbol,
                       double value)
{
    if (numbers)
        addWords(teller, "%c", factors->color);
    else
        addWords(teller, "Lc");
    if (factors->parts > 1)
        addWords(teller, " / %d", factors->parts);
    if (!isnan(factors->cone)) {
        if (numbers)
            addWords(teller, " * %g", factors->cone);
        else
            addWords(teller, " * cone");
    }
    if (factors->isFiltered) {
        if (numbers)
            addWords(teller, " * %c", factors->filter);
        else
            addWords(teller, " * filter");
    }
    if (symbol != NULL) {
        if (numbers)
            addWords(teller, " * %g", value);
        else
            addWords(teller, " * %s", symbol);
    }
    if (factors->hasFalloff) {
        if (numbers)
            addWords(teller, " / %g", factors->squared);
        else
            addWords(teller, " / d^2");
    }
}

static void sayTerm(Teller *teller, const char *name, const char *first, Color3f firstValue,
                    const LightFactors *factors, const char *symbol, double value, Color3f result)
{
    beginLine(teller);
    addWords(teller, "%s%s * ", name, first);
    addFactors(teller, factors, false, symbol, 0);
    addWords(teller, "\n");
    beginLine(teller);
    addWords(teller, "            = %c * ", firstValue);
    addFactors(teller, factors, true, symbol, value);
    addWords(teller, "\n");
    sayLine(teller, "            = %c", result);
}

/* Where the light stands to the point. */
static void sayLightGeometry(Teller *teller, const Light *lamp, const LightStory *light)
{
    if (lamp->kind == LIGHT_DIRECTIONAL) {
        sayLine(teller, "L           %v, against the light's direction; it has no distance and no falloff",
                light->arriving.direction);
    } else {
        sayLine(teller, "IL          light - P = %v", light->il);
        sayLine(teller, "d           |IL| = %g", light->arriving.distance);
        sayLine(teller, "L           IL / d = %v", light->arriving.direction);
    }
    sayLine(teller, "N.L         %g%s", light->cosine,
            light->fate == LIGHT_BEHIND ? ", not above 0: the light is behind the surface and adds nothing"
                                        : "");
}

static void sayArriving(Teller *teller, const Light *lamp, const LightStory *light,
                        const LightFactors *factors)
{
    const double pi = 3.14159265358979323846;
    if (lamp->kind == LIGHT_SPOT) {
        double cosine = -dot(light->arriving.direction, lamp->direction);
        double angle = acos(fmax(-1, fmin(1, cosine))) * 180 / pi;
        sayLine(teller, "cone        %g degrees from the axis (full to %g, none from %g): cone = %g", angle,
                lamp->innerAngle, lamp->outerAngle, light->fate == LIGHT_DARK ? 0.0 : factors->cone);
    }
    if (lamp->kind != LIGHT_DIRECTIONAL) {
        if (factors->hasFalloff)
            sayLine(teller, "falloff     1 / d^2 = 1 / %g = %g", factors->squared, 1 / factors->squared);
        else
            sayLine(teller, "falloff     none: the scene says so");
    }
    beginLine(teller);
    LightFactors unfiltered = *factors;
    unfiltered.isFiltered = false;
    addWords(teller, "arriving    ");
    addFactors(teller, &unfiltered, false, NULL, 0);
    addWords(teller, " = %c%s\n", light->arriving.color,
             light->fate == LIGHT_DARK ? ": nothing, so this light adds nothing" : "");
}

/* One point light in full. */
static void sayLight(Teller *teller, const RayStory *ray, const LightStory *light)
{
    const Light *lamp = &teller->story->scene->lights[light->light];
    const Material *material = &ray->material;
    sayLightGeometry(teller, lamp, light);
    if (light->fate == LIGHT_BEHIND)
        return;
    if (ray->model == MODEL_SIMPLE) {
        sayShadow(teller, light);
        return;
    }
    LightFactors factors = factorsOf(lamp, light);
    sayArriving(teller, lamp, light, &factors);
    if (light->fate == LIGHT_DARK)
        return;
    sayShadow(teller, light);
    if (light->fate == LIGHT_BLOCKED)
        return;
    sayTerm(teller, "diffuse     ", "Ic", material->diffuse, &factors, "(N.L)", light->cosine,
            light->diffuse);
    if (!light->hasHighlight)
        return;
    bool isPhong = ray->model == MODEL_PHONG;
    if (isPhong)
        sayLine(teller, "R           L mirrored at N: 2 (N.L) N - L = %v", light->r);
    else
        sayLine(teller, "H           halfway between L and V: %v", light->r);
    const char *name = isPhong ? "R.V" : "N.H";
    sayLine(teller, "%s         %g%s", name, light->highlightDot,
            light->highlightDot > 0 ? "" : ", not above 0: no highlight");
    sayLine(teller, "specFactor  max(0, %s)^shininess = %g^%g = %g", name, fmax(0, light->highlightDot),
            (double)material->shininess, light->specFactor);
    sayTerm(teller, "specular    ", "Ispec", material->specular, &factors, "specFactor", light->specFactor,
            multColors(material->specular, light->highlight));
}

/* What many point lights of an area do, together. */
static void sayAreaSum(Teller *teller, const LightStory *lights, size_t count)
{
    size_t fates[LIGHT_NOT_ASKED + 1] = {0};
    Color3f diffuse = {0}, highlight = {0};
    for (size_t i = 0; i < count; i++) {
        fates[lights[i].fate]++;
        diffuse = addColors(diffuse, lights[i].diffuse);
        highlight = addColors(highlight, lights[i].highlight);
    }
    sayLine(teller, "of its %u point lights %u reach the point, %u are blocked, %u are behind the surface",
            count, fates[LIGHT_REACHES], fates[LIGHT_BLOCKED], fates[LIGHT_BEHIND]);
    const Object *named[MOST_NAMED];
    size_t namedCount = 0;
    for (size_t i = 0; i < count && namedCount < MOST_NAMED; i++) {
        const Object *blocker = lights[i].blocker;
        size_t n = 0, blocked = 0;
        while (n < namedCount && named[n] != blocker)
            n++;
        if (blocker == NULL || n < namedCount)
            continue;
        named[namedCount++] = blocker;
        for (size_t j = i; j < count; j++)
            blocked += lights[j].blocker == blocker;
        sayLine(teller, "%o blocks %u of them", blocker, blocker, blocked);
    }
    sayLine(teller, "diffuse, all of them together     %c", diffuse);
    if (!colorIsBlack(highlight))
        sayLine(teller, "Lc specFactor / d^2, likewise     %c", highlight);
}

void sayLights(Teller *teller, const RayStory *ray)
{
    const Scene *scene = teller->story->scene;
    for (size_t from = 0; from < ray->lightCount;) {
        size_t number = ray->lights[from].light, to = from;
        const Light *lamp = &scene->lights[number];
        while (to < ray->lightCount && ray->lights[to].light == number)
            to++;
        if (lamp->kind == LIGHT_DIRECTIONAL)
            sayHeading(teller, "Light %u of %u: directional, along %v, Lc = %c", number + 1,
                       scene->lightCount, lamp->direction, lamp->color);
        else
            sayHeading(teller, "Light %u of %u: %s, at %v, Lc = %c", number + 1, scene->lightCount,
                       lightKindName(lamp), lamp->position, lamp->color);
        teller->indent += 2;
        size_t count = to - from;
        if (ray->lights[from].fate == LIGHT_NOT_ASKED)
            sayLine(teller, "not asked: one light that reaches the point is enough for the simple model");
        else if (lamp->kind != LIGHT_AREA)
            sayLight(teller, ray, &ray->lights[from]);
        else {
            sayAreaSum(teller, &ray->lights[from], count);
            size_t first = count > FEW_LIGHTS ? count / 2 : 0, last = count > FEW_LIGHTS ? first + 1 : count;
            for (size_t i = first; i < last; i++) {
                sayLine(teller, "its point light %u of %u, at %v:", i + 1, count,
                        ray->lights[from + i].arriving.position);
                teller->indent += 2;
                if (ray->lights[from + i].fate == LIGHT_NOT_ASKED)
                    sayLine(teller, "not asked: one that reaches the point is enough");
                else
                    sayLight(teller, ray, &ray->lights[from + i]);
                teller->indent -= 2;
            }
        }
        teller->indent -= 2;
        from = to;
    }
}
