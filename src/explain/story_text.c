/* story_text.c - the story of a pixel in words; see story_writers.h.
 *
 * The names are the handout's: Ic the diffuse colour, Ispec the specular one, Lc the light's, N the normal,
 * IL from the point to the light, R the reflected direction, V to the eye. Each term stands as a formula
 * first, with its numbers next, and its value last.
 */
#include "compare/rounding.h"
#include "explain/story_writers.h"

#include <stdarg.h>
#include <string.h>

enum {
    DIGITS = 5,
    MOST_NAMED = 16, /* samples and objects that are listed */
    FEW_LIGHTS = 4   /* point lights of an area that are all told in full */
};

typedef struct Teller {
    const PixelStory *story;
    Text *text;
    bool color;
    int indent;
} Teller;

static void appendNumber(Text *text, double value)
{
    char buffer[NUMBER_TEXT_SIZE];
    textAppend(text, formatRounded(buffer, value == 0 ? 0 : value, DIGITS));
}

static void appendTriple(Text *text, double x, double y, double z)
{
    textAppend(text, "(");
    appendNumber(text, x);
    textAppend(text, ", ");
    appendNumber(text, y);
    textAppend(text, ", ");
    appendNumber(text, z);
    textAppend(text, ")");
}

/* Append by a format: %v a Vector3D, %c a Color3f, %g a double, %s a string, %u a size_t, %d an int, %o a
 * const Object * and its part. */
static void appendWords(Teller *teller, const char *format, va_list arguments)
{
    Text *text = teller->text;
    for (const char *f = format; *f != '\0'; f++) {
        if (*f != '%') {
            textAppendBytes(text, f, 1);
            continue;
        }
        switch (*++f) {
        case 'v': {
            Vector3D v = va_arg(arguments, Vector3D);
            appendTriple(text, v.x, v.y, v.z);
            break;
        }
        case 'c': {
            Color3f c = va_arg(arguments, Color3f);
            appendTriple(text, (double)c.r, (double)c.g, (double)c.b);
            break;
        }
        case 'g':
            appendNumber(text, va_arg(arguments, double));
            break;
        case 's':
            textAppend(text, va_arg(arguments, const char *));
            break;
        case 'u':
            textAppendFormat(text, "%zu", va_arg(arguments, size_t));
            break;
        case 'd':
            textAppendFormat(text, "%d", va_arg(arguments, int));
            break;
        case 'o': {
            const Object *object = va_arg(arguments, const Object *);
            const Object *part = va_arg(arguments, const Object *);
            appendObjectName(teller->story->scene, object, part, text);
            break;
        }
        default:
            break;
        }
    }
}

/* Words without a line of their own. */
static void add(Teller *teller, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    appendWords(teller, format, arguments);
    va_end(arguments);
}

static void beginLine(Teller *teller)
{
    textAppendFormat(teller->text, "%*s", teller->indent, "");
}

/* A whole line. */
static void say(Teller *teller, const char *format, ...)
{
    beginLine(teller);
    va_list arguments;
    va_start(arguments, format);
    appendWords(teller, format, arguments);
    va_end(arguments);
    textAppend(teller->text, "\n");
}

/* A line that opens a part of the story, after an empty one. */
static void head(Teller *teller, const char *format, ...)
{
    textAppend(teller->text, "\n");
    beginLine(teller);
    textAppend(teller->text, teller->color ? "\x1b[1m" : "");
    va_list arguments;
    va_start(arguments, format);
    appendWords(teller, format, arguments);
    va_end(arguments);
    textAppend(teller->text, teller->color ? "\x1b[0m\n" : "\n");
}

/* ---- What a ray meets ---- */

static void sayObjects(Teller *teller, const RayStory *ray)
{
    if (ray->metCount + ray->missedCount == 0) {
        say(teller, "objects: the scene has none");
        return;
    }
    say(teller, "objects tried: %u, met %u, missed %u", ray->metCount + ray->missedCount, ray->metCount,
        ray->missedCount);
    teller->indent += 2;
    for (size_t i = 0; i < ray->triedCount; i++) {
        const TriedObject *tried = &ray->tried[i];
        if (tried->part == NULL)
            say(teller, "%o: missed", tried->object, tried->object);
        else
            say(teller, "%o: met at distance %g%s", tried->object, tried->part, tried->distance,
                tried->object == ray->point.object && ray->end == RAY_MEETS_SURFACE ? ", the nearest" : "");
    }
    size_t named = 0;
    for (size_t i = 0; i < ray->triedCount; i++)
        named += ray->tried[i].part != NULL;
    if (named < ray->metCount)
        say(teller, "and %u more that were met behind these", ray->metCount - named);
    teller->indent -= 2;
}

static void sayMaterial(Teller *teller, const RayStory *ray)
{
    static const char *const patterns[] = {[PATTERN_CHECKER] = "checker",
                                           [PATTERN_STRIPES] = "stripes",
                                           [PATTERN_GRADIENT] = "gradient",
                                           [PATTERN_IMAGE] = "image"};
    const Material *material = &ray->material;
    say(teller, "model       %s%s", shadingModelName(ray->model),
        ray->point.hit.object->material.model != MODEL_OF_SCENE ? ", the material's own" : "");
    if (material->pattern != NULL)
        say(teller, "Ic          %c, the diffuse colour of the pattern (%s) at this point", material->diffuse,
            patterns[material->pattern->kind]);
    else
        say(teller, "Ic          %c, the diffuse colour", material->diffuse);
    if (ray->model >= MODEL_PHONG) {
        say(teller, "Ispec       %c, the specular colour", material->specular);
        say(teller, "shininess   %g", (double)material->shininess);
    }
}

/* ---- Lights ---- */

static void sayCrossings(Teller *teller, const LightStory *light)
{
    size_t kept = light->crossingCount < MOST_CROSSINGS ? light->crossingCount : MOST_CROSSINGS;
    for (size_t i = 0; i < kept; i++)
        say(teller, "            through %o at distance %g: times %c", light->crossings[i].object,
            light->crossings[i].part, light->crossings[i].distance, light->crossings[i].transmission);
    if (kept < light->crossingCount)
        say(teller, "            and %u transparent surfaces behind these", light->crossingCount - kept);
}

static void sayShadow(Teller *teller, const LightStory *light)
{
    if (!light->hasShadowRay) {
        say(teller, "shadow      not asked: the scene says shadows: false");
        return;
    }
    if (light->blocker != NULL) {
        beginLine(teller);
        add(teller, "shadow      blocked by %o at distance %g", light->blocker, light->blockerPart,
            light->blockedAt);
        if (isfinite(light->arriving.distance))
            add(teller, " of %g", light->arriving.distance);
        add(teller, ": this light adds nothing\n");
        return;
    }
    if (light->crossingCount == 0) {
        say(teller, "shadow      nothing lies between the point and the light");
        return;
    }
    say(teller, "shadow      only what is transparent lies between:");
    sayCrossings(teller, light);
    say(teller, "            left of the light: %c%s", light->reaching,
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
        add(teller, "%c", factors->color);
    else
        add(teller, "Lc");
    if (factors->parts > 1)
        add(teller, " / %d", factors->parts);
    if (!isnan(factors->cone)) {
        if (numbers)
            add(teller, " * %g", factors->cone);
        else
            add(teller, " * cone");
    }
    if (factors->isFiltered) {
        if (numbers)
            add(teller, " * %c", factors->filter);
        else
            add(teller, " * filter");
    }
    if (symbol != NULL) {
        if (numbers)
            add(teller, " * %g", value);
        else
            add(teller, " * %s", symbol);
    }
    if (factors->hasFalloff) {
        if (numbers)
            add(teller, " / %g", factors->squared);
        else
            add(teller, " / d^2");
    }
}

static void sayTerm(Teller *teller, const char *name, const char *first, Color3f firstValue,
                    const LightFactors *factors, const char *symbol, double value, Color3f result)
{
    beginLine(teller);
    add(teller, "%s%s * ", name, first);
    addFactors(teller, factors, false, symbol, 0);
    add(teller, "\n");
    beginLine(teller);
    add(teller, "            = %c * ", firstValue);
    addFactors(teller, factors, true, symbol, value);
    add(teller, "\n");
    say(teller, "            = %c", result);
}

/* Where the light stands to the point. */
static void sayLightGeometry(Teller *teller, const Light *lamp, const LightStory *light)
{
    if (lamp->kind == LIGHT_DIRECTIONAL) {
        say(teller, "L           %v, against the light's direction; it has no distance and no falloff",
            light->arriving.direction);
    } else {
        say(teller, "IL          light - P = %v", light->il);
        say(teller, "d           |IL| = %g", light->arriving.distance);
        say(teller, "L           IL / d = %v", light->arriving.direction);
    }
    say(teller, "N.L         %g%s", light->cosine,
        light->fate == LIGHT_BEHIND ? ", not above 0: the light is behind the surface and adds nothing" : "");
}

static void sayArriving(Teller *teller, const Light *lamp, const LightStory *light,
                        const LightFactors *factors)
{
    const double pi = 3.14159265358979323846;
    if (lamp->kind == LIGHT_SPOT) {
        double cosine = -dot(light->arriving.direction, lamp->direction);
        double angle = acos(fmax(-1, fmin(1, cosine))) * 180 / pi;
        say(teller, "cone        %g degrees from the axis (full to %g, none from %g): cone = %g", angle,
            lamp->innerAngle, lamp->outerAngle, light->fate == LIGHT_DARK ? 0.0 : factors->cone);
    }
    if (lamp->kind != LIGHT_DIRECTIONAL) {
        if (factors->hasFalloff)
            say(teller, "falloff     1 / d^2 = 1 / %g = %g", factors->squared, 1 / factors->squared);
        else
            say(teller, "falloff     none: the scene says so");
    }
    beginLine(teller);
    LightFactors unfiltered = *factors;
    unfiltered.isFiltered = false;
    add(teller, "arriving    ");
    addFactors(teller, &unfiltered, false, NULL, 0);
    add(teller, " = %c%s\n", light->arriving.color,
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
        say(teller, "R           L mirrored at N: 2 (N.L) N - L = %v", light->r);
    else
        say(teller, "H           halfway between L and V: %v", light->r);
    const char *name = isPhong ? "R.V" : "N.H";
    say(teller, "%s         %g%s", name, light->highlightDot,
        light->highlightDot > 0 ? "" : ", not above 0: no highlight");
    say(teller, "specFactor  max(0, %s)^shininess = %g^%g = %g", name, fmax(0, light->highlightDot),
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
    say(teller, "of its %u point lights %u reach the point, %u are blocked, %u are behind the surface", count,
        fates[LIGHT_REACHES], fates[LIGHT_BLOCKED], fates[LIGHT_BEHIND]);
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
        say(teller, "%o blocks %u of them", blocker, blocker, blocked);
    }
    say(teller, "diffuse, all of them together     %c", diffuse);
    if (!colorIsBlack(highlight))
        say(teller, "Lc specFactor / d^2, likewise     %c", highlight);
}

static void sayLights(Teller *teller, const RayStory *ray)
{
    const Scene *scene = teller->story->scene;
    for (size_t from = 0; from < ray->lightCount;) {
        size_t number = ray->lights[from].light, to = from;
        const Light *lamp = &scene->lights[number];
        while (to < ray->lightCount && ray->lights[to].light == number)
            to++;
        if (lamp->kind == LIGHT_DIRECTIONAL)
            head(teller, "Light %u of %u: directional, along %v, Lc = %c", number + 1, scene->lightCount,
                 lamp->direction, lamp->color);
        else
            head(teller, "Light %u of %u: %s, at %v, Lc = %c", number + 1, scene->lightCount,
                 lightKindName(lamp), lamp->position, lamp->color);
        teller->indent += 2;
        size_t count = to - from;
        if (ray->lights[from].fate == LIGHT_NOT_ASKED)
            say(teller, "not asked: one light that reaches the point is enough for the simple model");
        else if (lamp->kind != LIGHT_AREA)
            sayLight(teller, ray, &ray->lights[from]);
        else {
            sayAreaSum(teller, &ray->lights[from], count);
            size_t first = count > FEW_LIGHTS ? count / 2 : 0, last = count > FEW_LIGHTS ? first + 1 : count;
            for (size_t i = first; i < last; i++) {
                say(teller, "its point light %u of %u, at %v:", i + 1, count,
                    ray->lights[from + i].arriving.position);
                teller->indent += 2;
                if (ray->lights[from + i].fate == LIGHT_NOT_ASKED)
                    say(teller, "not asked: one that reaches the point is enough");
                else
                    sayLight(teller, ray, &ray->lights[from + i]);
                teller->indent -= 2;
            }
        }
        teller->indent -= 2;
        from = to;
    }
}

/* ---- Rays ---- */

static void sayRay(Teller *teller, const RayStory *ray);

static void sayRefraction(Teller *teller, const RayStory *ray)
{
    const double pi = 3.14159265358979323846;
    if (!ray->isTransparent)
        return;
    double angle = acos(fmax(-1, fmin(1, ray->cosine))) * 180 / pi;
    head(teller, "Through the surface (Snell's law)");
    teller->indent += 2;
    say(teller, "n1 / n2     %g", ray->ratio);
    say(teller, "angle in    %g degrees from N", angle);
    if (ray->k < 0)
        say(teller, "total reflection: sin = n1 / n2 * %g is above 1, so all goes back, with weight 1",
            sqrt(fmax(0, 1 - ray->cosine * ray->cosine)));
    else
        say(teller, "angle out   %g degrees; weight It = %c, the transmission",
            acos(fmin(1, sqrt(ray->k))) * 180 / pi, ray->material.transmission);
    teller->indent -= 2;
}

static void saySum(Teller *teller, const RayStory *ray)
{
    const Material *material = &ray->material;
    head(teller, "What the surface sends along the ray");
    teller->indent += 2;
    if (ray->model == MODEL_SIMPLE) {
        if (ray->isUnlit)
            say(teller, "Ic, as it is: %s",
                teller->story->scene->lightCount == 0 ? "the scene has no light" : "shadows are off");
        else
            say(teller, colorIsBlack(ray->local) ? "nothing: no light reaches the point"
                                                 : "Ic, as it is: a light reaches the point");
    } else {
        if (!colorIsBlack(ray->ambientTerm))
            say(teller, "ambient     Ia * scene's = %c * %c = %c", material->ambient,
                teller->story->scene->render.ambient, ray->ambientTerm);
        if (!colorIsBlack(material->emission))
            say(teller, "emission    %c", material->emission);
        say(teller, "diffuse     %c, of all lights", ray->diffuseSum);
        if (ray->model >= MODEL_PHONG)
            say(teller, "specular    Ispec * %c = %c, of all lights", ray->highlightSum, ray->specularTerm);
        if (ray->refracted != NULL && ray->refracted->role == RAY_TOTALLY_REFLECTED)
            say(teller, "reflected   %c, all of it", ray->refracted->color);
        else if (ray->refracted != NULL)
            say(teller, "refracted   It * %c = %c", ray->refracted->color,
                multColors(ray->refracted->color, material->transmission));
        if (ray->mirrored != NULL)
            say(teller, "mirrored    Ir * %c = %c", ray->mirrored->color,
                multColors(material->reflection, ray->mirrored->color));
    }
    say(teller, "sum         %c", ray->seen);
    teller->indent -= 2;
}

static void sayFog(Teller *teller, const RayStory *ray)
{
    const Fog *fog = &teller->story->scene->fog;
    if (!(fog->distance > 0) || ray->end == RAY_TOO_DEEP || ray->end == RAY_NOT_TOLD)
        return;
    if (ray->end == RAY_MEETS_SURFACE)
        say(teller, "fog         weight exp(-%g / %g) = %g of it, and %g of the fog's %c: %c",
            ray->point.hit.distance, fog->distance, ray->fogWeight, 1 - ray->fogWeight, fog->color,
            ray->color);
    else
        say(teller, "fog         nothing is left through fog without end, only its own %c", ray->color);
}

static void saySurface(Teller *teller, const RayStory *ray)
{
    const SurfacePoint *point = &ray->point;
    say(teller, "P           origin + %g * direction = %v, the point", point->hit.distance, point->position);
    say(teller, "N           %v, the normal on the side of the ray", point->normal);
    say(teller, "V           %v, back along the ray", multVector(ray->ray.direction, -1));
    sayMaterial(teller, ray);
    if (!ray->isUnlit)
        sayLights(teller, ray);
    sayRefraction(teller, ray);
    if (ray->refracted != NULL) {
        teller->indent += 2;
        sayRay(teller, ray->refracted);
        teller->indent -= 2;
    }
    if (ray->mirrored != NULL) {
        teller->indent += 2;
        sayRay(teller, ray->mirrored);
        teller->indent -= 2;
    }
    saySum(teller, ray);
}

static void sayRay(Teller *teller, const RayStory *ray)
{
    static const char *const roles[] = {[RAY_OF_CAMERA] = "Ray from the camera",
                                        [RAY_MIRRORED] = "Mirrored ray",
                                        [RAY_REFRACTED] = "Refracted ray",
                                        [RAY_TOTALLY_REFLECTED] = "Totally reflected ray"};
    head(teller, "%s%s", roles[ray->role], ray->depth > 1 ? "" : "");
    teller->indent += 2;
    say(teller, "origin      %v", ray->ray.origin);
    say(teller, "direction   %v", ray->ray.direction);
    if (ray->depth > 1)
        say(teller, "chain       ray %d of at most %d", ray->depth, teller->story->scene->render.maxDepth);
    for (int i = 0; i < ray->media.count; i++)
        say(teller, "inside      %o, ior %g", ray->media.objects[i], ray->media.objects[i],
            (double)ray->media.objects[i]->material.ior);
    switch (ray->end) {
    case RAY_TOO_DEEP:
        say(teller, "the chain is longer than max_depth: black");
        break;
    case RAY_NOT_TOLD:
        say(teller, "not told further, the story has enough rays; it brings %c", ray->color);
        break;
    case RAY_MEETS_NOTHING:
        sayObjects(teller, ray);
        if (teller->story->scene->background.isGradient)
            say(teller, "nothing is met: the background, a gradient, at t = (1 + direction.y) / 2 = %g: %c",
                (1 + ray->ray.direction.y) / 2, ray->seen);
        else
            say(teller, "nothing is met: the background, %c", ray->seen);
        break;
    case RAY_MEETS_SURFACE:
        sayObjects(teller, ray);
        saySurface(teller, ray);
        break;
    }
    sayFog(teller, ray);
    teller->indent -= 2;
}

/* ---- The pixel ---- */

static void saySamples(Teller *teller)
{
    const PixelStory *story = teller->story;
    if (story->sampleCount == 1)
        return;
    head(teller, "Samples");
    teller->indent += 2;
    size_t listed = story->sampleCount <= MOST_NAMED ? story->sampleCount : 0;
    for (size_t i = 0; i < listed; i++)
        say(teller, "(%g, %g)  %c%s", story->samples[i].x, story->samples[i].y, story->samples[i].color,
            i == story->told ? ", told above" : "");
    say(teller, "mean of %u  %c", story->sampleCount, story->color);
    teller->indent -= 2;
}

static void sayEncoding(Teller *teller)
{
    static const char names[] = "rgb";
    const PixelStory *story = teller->story;
    const ImageSettings *image = &story->scene->image;
    const float linear[3] = {story->color.r, story->color.g, story->color.b};
    int largest = image->bitDepth == 16 ? 65535 : 255;
    head(teller, "The pixel");
    teller->indent += 2;
    say(teller, "linear      %c", story->color);
    for (int i = 0; i < 3; i++) {
        float clamped = linear[i] > 1 ? 1 : linear[i] > 0 ? linear[i] : 0;
        if (!(linear[i] == clamped))
            say(teller, "clamped     the %s channel from %g to %g: a picture holds 0 to 1",
                i == 0   ? "red"
                : i == 1 ? "green"
                         : "blue",
                (double)linear[i], (double)clamped);
    }
    for (int i = 0; i < 3; i++) {
        float clamped = linear[i] > 1 ? 1 : linear[i] > 0 ? linear[i] : 0;
        double v = (double)clamped;
        beginLine(teller);
        textAppendFormat(teller->text, "%c           ", names[i]);
        if (image->encoding == ENCODING_LINEAR)
            add(teller, "%g as it is", v);
        else if (v <= 0.0031308)
            add(teller, "sRGB: 12.92 * %g = %g", v, (double)linearToSrgb(clamped));
        else
            add(teller, "sRGB: 1.055 * %g^(1/2.4) - 0.055 = %g", v, (double)linearToSrgb(clamped));
        add(teller, "; times %d, rounded: %d\n", largest, (int)story->stored[i]);
    }
    say(teller, "stored      (%d, %d, %d), %d bits, %s", (int)story->stored[0], (int)story->stored[1],
        (int)story->stored[2], image->bitDepth, image->encoding == ENCODING_LINEAR ? "linear" : "sRGB");
    teller->indent -= 2;
}

static void sayPovray(Teller *teller, const PovrayPixel *povray)
{
    head(teller, "POV-Ray, the same pixel");
    teller->indent += 2;
    if (!statusIsOk(&povray->status)) {
        beginLine(teller);
        add(teller, "no value: ");
        if (povray->status.line > 0)
            add(teller, "line %d: ", povray->status.line);
        for (const char *c = povray->status.message; *c != '\0'; c++)
            textAppendBytes(teller->text, *c == '\n' ? " " : c, 1);
        add(teller, "\n");
        teller->indent -= 2;
        return;
    }
    say(teller, "linear      (%g, %g, %g)", povray->samples[0] / 65535.0, povray->samples[1] / 65535.0,
        povray->samples[2] / 65535.0);
    say(teller, "of 65535    (%d, %d, %d); ours (%d, %d, %d)", (int)povray->samples[0],
        (int)povray->samples[1], (int)povray->samples[2], (int)povray->ours[0], (int)povray->ours[1],
        (int)povray->ours[2]);
    say(teller, "stored      (%d, %d, %d)", (int)povray->stored[0], (int)povray->stored[1],
        (int)povray->stored[2]);
    int apart = (int)(povray->difference * 65535 + 0.5);
    if (apart == 0)
        say(teller, "the two agree exactly");
    else if (povray->agrees)
        say(teller, "the two agree: they lie %d/65535 apart, within the scene's limit, %g of 1", apart,
            teller->story->scene->tolerance.fail);
    else
        say(teller, "the two differ: they lie %d/65535 apart, beyond the scene's limit, %g of 1", apart,
            teller->story->scene->tolerance.fail);
    teller->indent -= 2;
}

void writeStoryText(const PixelStory *story, const PovrayPixel *povray, const char *name, bool color,
                    Text *text)
{
    Teller teller = {.story = story, .text = text, .color = color};
    const ImageSettings *image = &story->scene->image;
    const SampleStory *sample = &story->samples[story->told];
    say(&teller, "Pixel (%d, %d) of %s, %d x %d, counted from 0 at the top left", story->x, story->y, name,
        image->width, image->height);
    if (story->sampleCount == 1)
        say(&teller, "One ray goes through its middle, (%g, %g).", sample->x, sample->y);
    else
        say(&teller, "It is the mean of %u samples; the one at (%g, %g), nearest to the middle, is told.",
            story->sampleCount, sample->x, sample->y);
    sayRay(&teller, story->ray);
    saySamples(&teller);
    sayEncoding(&teller);
    if (povray != NULL)
        sayPovray(&teller, povray);
}
