/* story_text.c - the story of a pixel in words; see story_writers.h.
 *
 * The names are the handout's: Ic the diffuse colour, Ispec the specular one, Lc the light's, N the normal,
 * IL from the point to the light, R the reflected direction, V to the eye. Each term stands as a formula
 * first, with its numbers next, and its value last.
 */
#include "explain/story_words.h"
#include "explain/story_writers.h"

#include <string.h>

/* ---- What a ray meets ---- */

static void sayObjects(Teller *teller, const RayStory *ray)
{
    if (ray->metCount + ray->missedCount == 0) {
        sayLine(teller, "objects: the scene has none");
        return;
    }
    sayLine(teller, "objects tried: %u, met %u, missed %u", ray->metCount + ray->missedCount, ray->metCount,
            ray->missedCount);
    teller->indent += 2;
    for (size_t i = 0; i < ray->triedCount; i++) {
        const TriedObject *tried = &ray->tried[i];
        if (tried->part == NULL)
            sayLine(teller, "%o: missed", tried->object, tried->object);
        else
            sayLine(teller, "%o: met at distance %g%s", tried->object, tried->part, tried->distance,
                    tried->object == ray->point.object && ray->end == RAY_MEETS_SURFACE ? ", the nearest"
                                                                                        : "");
    }
    size_t named = 0;
    for (size_t i = 0; i < ray->triedCount; i++)
        named += ray->tried[i].part != NULL;
    if (named < ray->metCount)
        sayLine(teller, "and %u more that were met behind these", ray->metCount - named);
    teller->indent -= 2;
}

static void sayMaterial(Teller *teller, const RayStory *ray)
{
    static const char *const patterns[] = {[PATTERN_CHECKER] = "checker",
                                           [PATTERN_STRIPES] = "stripes",
                                           [PATTERN_GRADIENT] = "gradient",
                                           [PATTERN_IMAGE] = "image"};
    const Material *material = &ray->material;
    sayLine(teller, "model       %s%s", shadingModelName(ray->model),
            ray->point.hit.object->material.model != MODEL_OF_SCENE ? ", the material's own" : "");
    if (material->pattern != NULL)
        sayLine(teller, "Ic          %c, the diffuse colour of the pattern (%s) at this point",
                material->diffuse, patterns[material->pattern->kind]);
    else
        sayLine(teller, "Ic          %c, the diffuse colour", material->diffuse);
    if (ray->model >= MODEL_PHONG) {
        sayLine(teller, "Ispec       %c, the specular colour", material->specular);
        sayLine(teller, "shininess   %g", (double)material->shininess);
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
    sayHeading(teller, "Through the surface (Snell's law)");
    teller->indent += 2;
    sayLine(teller, "n1 / n2     %g", ray->ratio);
    sayLine(teller, "angle in    %g degrees from N", angle);
    if (ray->k < 0)
        sayLine(teller, "total reflection: sin = n1 / n2 * %g is above 1, so all goes back, with weight 1",
                sqrt(fmax(0, 1 - ray->cosine * ray->cosine)));
    else
        sayLine(teller, "angle out   %g degrees; weight It = %c, the transmission",
                acos(fmin(1, sqrt(ray->k))) * 180 / pi, ray->material.transmission);
    teller->indent -= 2;
}

static void saySum(Teller *teller, const RayStory *ray)
{
    const Material *material = &ray->material;
    sayHeading(teller, "What the surface sends along the ray");
    teller->indent += 2;
    if (ray->model == MODEL_SIMPLE) {
        if (ray->isUnlit)
            sayLine(teller, "Ic, as it is: %s",
                    teller->story->scene->lightCount == 0 ? "the scene has no light" : "shadows are off");
        else
            sayLine(teller, colorIsBlack(ray->local) ? "nothing: no light reaches the point"
                                                     : "Ic, as it is: a light reaches the point");
    } else {
        if (!colorIsBlack(ray->ambientTerm))
            sayLine(teller, "ambient     Ia * scene's = %c * %c = %c", material->ambient,
                    teller->story->scene->render.ambient, ray->ambientTerm);
        if (!colorIsBlack(material->emission))
            sayLine(teller, "emission    %c", material->emission);
        sayLine(teller, "diffuse     %c, of all lights", ray->diffuseSum);
        if (ray->model >= MODEL_PHONG)
            sayLine(teller, "specular    Ispec * %c = %c, of all lights", ray->highlightSum,
                    ray->specularTerm);
        if (ray->refracted != NULL && ray->refracted->role == RAY_TOTALLY_REFLECTED)
            sayLine(teller, "reflected   %c, all of it", ray->refracted->color);
        else if (ray->refracted != NULL)
            sayLine(teller, "refracted   It * %c = %c", ray->refracted->color,
                    multColors(ray->refracted->color, material->transmission));
        if (ray->mirrored != NULL)
            sayLine(teller, "mirrored    Ir * %c = %c", ray->mirrored->color,
                    multColors(material->reflection, ray->mirrored->color));
    }
    sayLine(teller, "sum         %c", ray->seen);
    teller->indent -= 2;
}

static void sayFog(Teller *teller, const RayStory *ray)
{
    const Fog *fog = &teller->story->scene->fog;
    if (!(fog->distance > 0) || ray->end == RAY_TOO_DEEP || ray->end == RAY_NOT_TOLD)
        return;
    if (ray->end == RAY_MEETS_SURFACE)
        sayLine(teller, "fog         weight exp(-%g / %g) = %g of it, and %g of the fog's %c: %c",
                ray->point.hit.distance, fog->distance, ray->fogWeight, 1 - ray->fogWeight, fog->color,
                ray->color);
    else
        sayLine(teller, "fog         nothing is left through fog without end, only its own %c", ray->color);
}

static void saySurface(Teller *teller, const RayStory *ray)
{
    const SurfacePoint *point = &ray->point;
    sayLine(teller, "P           origin + %g * direction = %v, the point", point->hit.distance,
            point->position);
    sayLine(teller, "N           %v, the normal on the side of the ray", point->normal);
    sayLine(teller, "V           %v, back along the ray", multVector(ray->ray.direction, -1));
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
    sayHeading(teller, "%s", roles[ray->role]);
    teller->indent += 2;
    sayLine(teller, "origin      %v", ray->ray.origin);
    sayLine(teller, "direction   %v", ray->ray.direction);
    if (ray->depth > 1)
        sayLine(teller, "chain       ray %d of at most %d", ray->depth,
                teller->story->scene->render.maxDepth);
    for (int i = 0; i < ray->media.count; i++)
        sayLine(teller, "inside      %o, ior %g", ray->media.objects[i], ray->media.objects[i],
                (double)ray->media.objects[i]->material.ior);
    switch (ray->end) {
    case RAY_TOO_DEEP:
        sayLine(teller, "the chain is longer than max_depth: black");
        break;
    case RAY_NOT_TOLD:
        sayLine(teller, "not told further, the story has enough rays; it brings %c", ray->color);
        break;
    case RAY_MEETS_NOTHING:
        sayObjects(teller, ray);
        if (teller->story->scene->background.isGradient)
            sayLine(teller,
                    "nothing is met: the background, a gradient, at t = (1 + direction.y) / 2 = %g: %c",
                    (1 + ray->ray.direction.y) / 2, ray->seen);
        else
            sayLine(teller, "nothing is met: the background, %c", ray->seen);
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
    sayHeading(teller, "Samples");
    teller->indent += 2;
    size_t listed = story->sampleCount <= MOST_NAMED ? story->sampleCount : 0;
    for (size_t i = 0; i < listed; i++)
        sayLine(teller, "(%g, %g)  %c%s", story->samples[i].x, story->samples[i].y, story->samples[i].color,
                i == story->told ? ", told above" : "");
    sayLine(teller, "mean of %u  %c", story->sampleCount, story->color);
    teller->indent -= 2;
}

static void sayEncoding(Teller *teller)
{
    static const char names[] = "rgb";
    const PixelStory *story = teller->story;
    const ImageSettings *image = &story->scene->image;
    const float linear[3] = {story->color.r, story->color.g, story->color.b};
    int largest = image->bitDepth == 16 ? 65535 : 255;
    sayHeading(teller, "The pixel");
    teller->indent += 2;
    sayLine(teller, "linear      %c", story->color);
    for (int i = 0; i < 3; i++) {
        float clamped = linear[i] > 1 ? 1 : linear[i] > 0 ? linear[i] : 0;
        if (!(linear[i] == clamped))
            sayLine(teller, "clamped     the %s channel from %g to %g: a picture holds 0 to 1",
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
            addWords(teller, "%g as it is", v);
        else if (v <= 0.0031308)
            addWords(teller, "sRGB: 12.92 * %g = %g", v, (double)linearToSrgb(clamped));
        else
            addWords(teller, "sRGB: 1.055 * %g^(1/2.4) - 0.055 = %g", v, (double)linearToSrgb(clamped));
        addWords(teller, "; times %d, rounded: %d\n", largest, (int)story->stored[i]);
    }
    sayLine(teller, "stored      (%d, %d, %d), %d bits, %s", (int)story->stored[0], (int)story->stored[1],
            (int)story->stored[2], image->bitDepth, image->encoding == ENCODING_LINEAR ? "linear" : "sRGB");
    teller->indent -= 2;
}

static void sayPovray(Teller *teller, const PovrayPixel *povray)
{
    sayHeading(teller, "POV-Ray, the same pixel");
    teller->indent += 2;
    if (!statusIsOk(&povray->status)) {
        beginLine(teller);
        addWords(teller, "no value: ");
        if (povray->status.line > 0)
            addWords(teller, "line %d: ", povray->status.line);
        for (const char *c = povray->status.message; *c != '\0'; c++)
            textAppendBytes(teller->text, *c == '\n' ? " " : c, 1);
        addWords(teller, "\n");
        teller->indent -= 2;
        return;
    }
    sayLine(teller, "linear      (%g, %g, %g)", povray->samples[0] / 65535.0, povray->samples[1] / 65535.0,
            povray->samples[2] / 65535.0);
    sayLine(teller, "of 65535    (%d, %d, %d); ours (%d, %d, %d)", (int)povray->samples[0],
            (int)povray->samples[1], (int)povray->samples[2], (int)povray->ours[0], (int)povray->ours[1],
            (int)povray->ours[2]);
    sayLine(teller, "stored      (%d, %d, %d)", (int)povray->stored[0], (int)povray->stored[1],
            (int)povray->stored[2]);
    int apart = (int)(povray->difference * 65535 + 0.5);
    if (apart == 0)
        sayLine(teller, "the two agree exactly");
    else if (povray->agrees)
        sayLine(teller, "the two agree: they lie %d/65535 apart, within the scene's limit, %g of 1", apart,
                teller->story->scene->tolerance.fail);
    else
        sayLine(teller, "the two differ: they lie %d/65535 apart, beyond the scene's limit, %g of 1", apart,
                teller->story->scene->tolerance.fail);
    teller->indent -= 2;
}

void writeStoryText(const PixelStory *story, const PovrayPixel *povray, const char *name, bool color,
                    Text *text)
{
    Teller teller = {.story = story, .text = text, .color = color};
    const ImageSettings *image = &story->scene->image;
    const SampleStory *sample = &story->samples[story->told];
    sayLine(&teller, "Pixel (%d, %d) of %s, %d x %d, counted from 0 at the top left", story->x, story->y,
            name, image->width, image->height);
    if (story->sampleCount == 1)
        sayLine(&teller, "One ray goes through its middle, (%g, %g).", sample->x, sample->y);
    else
        sayLine(&teller, "It is the mean of %u samples; the one at (%g, %g), nearest to the middle, is told.",
                story->sampleCount, sample->x, sample->y);
    sayRay(&teller, story->ray);
    saySamples(&teller);
    sayEncoding(&teller);
    if (povray != NULL)
        sayPovray(&teller, povray);
}
