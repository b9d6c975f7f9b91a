/* explain_picture.c - see explain_picture.h. */
#include "explain/explain_picture.h"

#include "base/cancel.h"
#include "engine/engine.h"
#include "explain/black_picture.h"
#include "explain/local_difference.h"
#include "explain/part_words.h"
#include "explain/sample_rounding.h"
#include "explain/scene_lines.h"
#include "explain/search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the pixels, so many may differ by more than rounding without there being a cause: rays that pass an edge
 * on different sides. */
static const double STRAY_SHARE = 1e-4;

/* Of the pixels, so many must be specks for acne to be considered. */
static const double SPECK_SHARE = 1.5e-3;

/* What a mistake of the whole scene may leave of the difference, without a part being looked for that is
 * wrong alone. */
static const double WELL_EXPLAINED = 0.05;

/* A part must leave less than this share of what such a mistake leaves. */
static const double PART_LEAVES = 0.25;

void freePictureExplanation(PictureExplanation *explanation)
{
    freeExplanations(&explanation->causes);
    textFree(&explanation->summary);
    freeImage(&explanation->right);
}

/* ---- A look at both pictures ---- */

/* How two pictures of one size, as stored, lie apart. */
typedef struct Look {
    size_t pixels, differing; /* by more than rounding */
    size_t below, above;      /* samples of mine that are one step below or above; more do not count */
    size_t specks;            /* of mine: darker than the pixels on both sides, where the other is not */
    size_t darker, brighter;  /* of those that differ */
    bool isOneFormat;         /* both have the same bit depth and encoding */
    double rmse;
    double rmseButDarker,
        rmseButBrighter; /* of the pixels that differ, those that are darker, or brighter, left out */
    int left, top, right, bottom; /* of those that differ */
} Look;

/* A sample of other as it would be stored in the format of image. */
static float storedLike(const Image *image, const Image *other, size_t sample)
{
    if (image->encoding == other->encoding)
        return sampleAsStored(other, sample);
    float light = sampleAsLight(other, sample);
    return image->encoding == ENCODING_SRGB ? linearToSrgb(light) : light;
}

static float brightness(const Image *image, int x, int y)
{
    size_t sample = 3 * ((size_t)y * (size_t)image->width + (size_t)x);
    return sampleAsStored(image, sample) + sampleAsStored(image, sample + 1) +
           sampleAsStored(image, sample + 2);
}

/* Whether the pixel is a hole in what surrounds it. */
static bool isSpeck(const Image *image, int x, int y)
{
    float here = brightness(image, x, y);
    float across = fminf(brightness(image, x - 1, y), brightness(image, x + 1, y));
    float down = fminf(brightness(image, x, y - 1), brightness(image, x, y + 1));
    return fmaxf(across, down) - here > 0.05f && here < 0.85f * fmaxf(across, down);
}

static Look lookAt(const Image *mine, const Image *other)
{
    Look look = {.pixels = (size_t)mine->width * (size_t)mine->height,
                 .isOneFormat = mine->bitDepth == other->bitDepth && mine->encoding == other->encoding,
                 .left = mine->width,
                 .top = mine->height,
                 .right = -1,
                 .bottom = -1};
    bool coarse = mine->bitDepth == 8 || other->bitDepth == 8;
    float step = coarse ? 1.0f / 255 : 1.0f / 65535;
    double sum = 0, darkerSum = 0, brighterSum = 0;
    for (int y = 0; y < mine->height && !cancelRequested(); y++) {
        for (int x = 0; x < mine->width; x++) {
            size_t pixel = (size_t)y * (size_t)mine->width + (size_t)x;
            float signedSum = 0;
            double pixelSum = 0;
            for (size_t i = 3 * pixel; i < 3 * pixel + 3; i++) {
                float d = sampleAsStored(mine, i) - storedLike(mine, other, i);
                pixelSum += (double)(d * d);
                signedSum += d;
                look.below += d < -0.5f * step;
                look.above += d > 0.5f * step;
            }
            if (pixelsDiffer(mine, other, pixel)) {
                look.differing++;
                look.darker += signedSum < 0;
                look.brighter += signedSum > 0;
                darkerSum += signedSum < 0 ? pixelSum : 0;
                brighterSum += signedSum > 0 ? pixelSum : 0;
                look.left = x < look.left ? x : look.left;
                look.top = y < look.top ? y : look.top;
                look.right = x > look.right ? x : look.right;
                look.bottom = y > look.bottom ? y : look.bottom;
            }
            sum += pixelSum;
            bool inside = x > 0 && y > 0 && x < mine->width - 1 && y < mine->height - 1;
            look.specks += inside && isSpeck(mine, x, y) && !isSpeck(other, x, y);
        }
    }
    double samples = 3.0 * (double)look.pixels;
    look.rmse = sqrt(sum / samples);
    look.rmseButDarker = sqrt(fmax(sum - darkerSum, 0) / samples);
    look.rmseButBrighter = sqrt(fmax(sum - brighterSum, 0) / samples);
    return look;
}

/* Whether what differs is rounding, but for stray pixels. */
static bool isRounding(const Look *look)
{
    return (double)look->differing <= STRAY_SHARE * (double)look->pixels;
}

/* Whether one picture was cut off where the other was rounded: many of its samples are a step lower and none
 * is higher. lower and higher: of the look's samples, those where it is so. */
static bool isCutOff(const Look *look, size_t lower, size_t higher)
{
    return look->isOneFormat && isRounding(look) && lower > 3 * look->pixels / 10 && higher * 50 < lower;
}

static bool hasSpecks(const Look *look)
{
    return look->specks > 20 && (double)look->specks > SPECK_SHARE * (double)look->pixels;
}

/* Whether the difference is dark specks, which nothing else makes than acne. */
static bool isSpeckled(const Look *look)
{
    return hasSpecks(look) && look->darker > 20 * look->brighter && look->differing < look->pixels / 10 * 9;
}

/* ---- What is told ---- */

static void appendShare(Text *text, size_t part, size_t whole)
{
    textAppendRounded(text, 100.0 * (double)part / (double)whole, 3);
    textAppend(text, " %");
}

/* Where the scene has what the trait changes: the lamp that it is about, or the first line with its key. */
static void tellPlaceOf(const Trait *trait, const SceneSource *source, Text *where)
{
    const char *name = source != NULL ? source->name : NULL, *text = source != NULL ? source->text : NULL;
    bool isOfLamp = trait->other > 0 && (trait->cause == CAUSE_EXPOSURE || trait->cause == CAUSE_SHADOW);
    int line = isOfLamp && text != NULL ? findItemLine(text, "lights", (size_t)trait->other - 1) : 0;
    if (line > 0 && name != NULL)
        textAppendFormat(where, "%s:%d: %s", name, line, trait->formula);
    else
        appendPlace(name, text, trait->key, trait->formula, where);
}

static void tellFindings(const Findings *findings, const Scene *scene, const SceneSource *source,
                         const char *swappedName, Explanations *causes)
{
    for (int i = 0; i < findings->count; i++) {
        const Finding *finding = &findings->items[i];
        const Trait *trait = finding->trait;
        Explanation *told = addExplanation(causes, trait->cause, finding->residual);
        if (swappedName != NULL)
            textAppendFormat(&told->text, "in %s ", swappedName);
        trait->tell(trait, finding->number, scene, &told->text);
        tellPlaceOf(trait, source, &told->where);
    }
}

static void tellAcne(double residual, Explanations *causes)
{
    Explanation *told = addExplanation(causes, CAUSE_ACNE, residual);
    textAppend(&told->text,
               "shadow acne: specks are darker than what surrounds them, since surfaces shadow "
               "themselves; the ray to the light starts on the surface, a rounding error below it");
    textAppend(&told->where,
               "the shadow ray starts a little off the surface: offsetStart in src/raytracer.c");
}

static void tellCutOff(int bitDepth, double residual, Explanations *causes)
{
    Explanation *told = addExplanation(causes, CAUSE_QUANTISATION, residual);
    textAppendFormat(&told->text,
                     "the samples are cut off instead of rounded to %d bits: many are one step too low",
                     bitDepth);
    textAppend(&told->where, "sample = floor(v * (2^bits - 1) + 1/2)");
}

static void tellDepths(const Image *mine, const Image *other, double residual, Explanations *causes)
{
    Explanation *told = addExplanation(causes, CAUSE_QUANTISATION, residual);
    textAppendFormat(
        &told->text,
        "one picture has %d bits a sample and the other %d; what differs is less than a step of 8 bits",
        mine->bitDepth, other->bitDepth);
    textAppend(&told->where, "sample = floor(v * (2^bits - 1) + 1/2)");
}

/* A guess from the two pictures alone, and how to be sure. */
static void tellLocal(const LocalDifference *local, double residual, Explanations *causes)
{
    Explanation *told = addExplanation(causes, local->cause, residual);
    const char *place = local->mineIsBrighter ? "the first picture" : "the second picture";
    if (local->cause == CAUSE_SHADOW) {
        textAppendFormat(
            &told->text,
            "shadows are missing in %s: the other one has an edge where this one is smooth, and they "
            "agree elsewhere",
            place);
        textAppend(&told->where, "a light counts if nothing lies strictly between the point and it");
    } else if (local->cause == CAUSE_SPECULAR) {
        textAppendFormat(&told->text, "%s has a highlight that the other one has not", place);
        textAppend(&told->where, "Ispec * Lc * max(0, dot(R, V))^shininess / d^2");
    } else {
        textAppendFormat(
            &told->text,
            "the highlights are wider in %s: another shininess, or Blinn's highlight for Phong's", place);
        textAppend(&told->where, "Ispec * Lc * max(0, dot(R, V))^shininess / d^2");
    }
    textAppend(&told->text, " (to be sure, give the scene as the first of the two)");
}

static Explanation *tellUnknown(const Look *look, bool hasScene, Explanations *causes)
{
    Explanation *told = addExplanation(causes, CAUSE_UNKNOWN, look->rmse);
    textAppend(&told->text, "none of the mistakes that are known here fits; ");
    appendShare(&told->text, look->differing, look->pixels);
    textAppend(&told->text, " of the pixels differ, ");
    textAppend(&told->text, look->darker > 9 * look->brighter   ? "nearly all of them darker"
                            : look->brighter > 9 * look->darker ? "nearly all of them brighter"
                                                                : "some darker and some brighter");
    textAppend(&told->text, hasScene ? " than the scene's"
                                     : " than the other's; mistakes in the light can only be "
                                       "found from the scene: give it as the first of the two");
    textAppendFormat(&told->where, "the pixels from (%d, %d) to (%d, %d)", look->left, look->top, look->right,
                     look->bottom);
    return told;
}

static void tellAgreement(const Look *look, Text *summary)
{
    if (look->differing == 0) {
        textAppend(summary, "The pictures agree: no sample differs by more than rounding.");
        return;
    }
    textAppendFormat(summary, "The pictures agree but for %zu of %zu pixels, too few to have a cause.",
                     look->differing, look->pixels);
}

/* ---- Which mistakes are looked for ---- */

static void dropTraits(Traits *traits, Cause cause)
{
    size_t kept = 0;
    for (size_t i = 0; i < traits->count; i++)
        if (traits->items[i].cause != cause)
            traits->items[kept++] = traits->items[i];
    traits->count = kept;
}

/* Whether the picture has only two values, as a drawing without shading has: few levels explain that always.
 */
static bool isTwoValued(const Image *image)
{
    size_t count = 3 * (size_t)image->width * (size_t)image->height;
    uint16_t first = image->samples[0], second = first;
    for (size_t i = 1; i < count; i++) {
        if (image->samples[i] == first || image->samples[i] == second)
            continue;
        if (second != first)
            return false;
        second = image->samples[i];
    }
    return true;
}

/* Leave out what would explain too much: acne where there are no specks, since with it any lamp may be
 * blocked anywhere, and all that changes values where one picture has only two of them. */
static void listPossibleTraits(const Scene *scene, const Image *wrong, const Image *right, const Look *look,
                               Traits *traits)
{
    listTraits(scene, (StoredFormat){wrong->bitDepth, wrong->encoding}, traits);
    if (!hasSpecks(look))
        dropTraits(traits, CAUSE_ACNE);
    if (isTwoValued(wrong) || isTwoValued(right)) {
        dropTraits(traits, CAUSE_GAMMA);
        dropTraits(traits, CAUSE_EXPOSURE);
        dropTraits(traits, CAUSE_AMBIENT);
        dropTraits(traits, CAUSE_QUANTISATION);
    }
}

/* ---- Two pictures ---- */

static Status checkSizes(const Image *a, const char *aName, const Image *b, const char *bName)
{
    if (a->width != b->width || a->height != b->height)
        return statusError(STATUS_MISMATCH,
                           "%s is %d x %d pixels and %s %d x %d: only pictures of one size can be explained",
                           aName, a->width, a->height, bName, b->width, b->height);
    return statusOk();
}

/* Search with one of two pictures as the right one. */
static Status searchFrom(const Image *wrong, const Image *right, const bool *isIgnored, const Look *look,
                         Traits *traits, Findings *findings)
{
    Truth truth;
    Status status = truthOfPicture(right, &truth);
    if (!statusIsOk(&status))
        return status;
    listPossibleTraits(NULL, wrong, right, look, traits);
    status = searchCauses(&truth, wrong, right, isIgnored, traits, findings);
    freeTruth(&truth);
    return status;
}

/* Specks and something else: what explains the picture but for its specks. Adds nothing where nothing does.
 */
static Status explainButForSpecks(const Image *mine, const Image *reference, const Look *look,
                                  Explanations *causes)
{
    if (!hasSpecks(look))
        return statusOk();
    size_t count = (size_t)mine->width * (size_t)mine->height;
    bool *isIgnored = calloc(count, sizeof *isIgnored);
    Traits *traits = malloc(sizeof *traits);
    Status status = isIgnored != NULL && traits != NULL ? statusOk() : statusOutOfMemory();
    Findings findings = {.count = 0};
    if (statusIsOk(&status)) {
        for (int y = 1; y < mine->height - 1; y++)
            for (int x = 1; x < mine->width - 1; x++)
                isIgnored[(size_t)y * (size_t)mine->width + (size_t)x] = isSpeck(mine, x, y);
        status = searchFrom(mine, reference, isIgnored, look, traits, &findings);
    }
    if (statusIsOk(&status) && findings.count > 0) {
        tellFindings(&findings, NULL, NULL, NULL, causes);
        tellAcne(findings.items[findings.count - 1].residual, causes);
    }
    free(isIgnored);
    free(traits);
    return status;
}

/* The residual as a share of the difference; 1 where nothing was found. */
static double shareLeft(const Findings *findings)
{
    return findings->count > 0 ? findings->items[findings->count - 1].residual / findings->before : 1;
}

/* Where no formula fits: what kind of part it is that differs. */
static Status explainLocally(const Image *mine, const Image *reference, const Look *look,
                             Explanations *causes)
{
    LocalDifference local;
    Status status = findLocalDifference(mine, reference, &local);
    if (!statusIsOk(&status))
        return status;
    if (local.cause == CAUSE_UNKNOWN)
        tellUnknown(look, false, causes);
    else
        tellLocal(&local, local.mineIsBrighter ? look->rmseButBrighter : look->rmseButDarker, causes);
    return status;
}

static Status explainDifference(const Image *mine, const Image *reference, const char *referenceName,
                                const Look *look, Explanations *causes)
{
    Traits *traits = malloc(2 * sizeof *traits);
    if (traits == NULL)
        return statusOutOfMemory();
    Findings from, back = {0};
    Status status = searchFrom(mine, reference, NULL, look, &traits[0], &from);
    if (statusIsOk(&status) && shareLeft(&from) > 0.01)
        status = searchFrom(reference, mine, NULL, look, &traits[1], &back);

    if (!statusIsOk(&status))
        ;
    else if (isSpeckled(look) && shareLeft(&from) > 0.05)
        tellAcne(look->rmseButDarker, causes);
    else if (from.count > 0 && (back.count == 0 || shareLeft(&from) <= 2 * shareLeft(&back)))
        tellFindings(&from, NULL, NULL, NULL, causes);
    else if (back.count > 0)
        tellFindings(&back, NULL, NULL, referenceName, causes);
    else
        status = explainButForSpecks(mine, reference, look, causes);
    if (statusIsOk(&status) && causes->count == 0)
        status = explainLocally(mine, reference, look, causes);
    free(traits);
    return status;
}

Status explainPictures(const Image *mine, const char *mineName, const Image *reference,
                       const char *referenceName, PictureExplanation *explanation)
{
    Status status = checkSizes(mine, mineName, reference, referenceName);
    if (!statusIsOk(&status))
        return status;
    PictureExplanation found = {0};
    Look look = lookAt(mine, reference);
    found.causes.before = look.rmse;
    if (cancelRequested())
        status = statusInterrupted();
    else if (isRounding(&look) && mine->bitDepth != reference->bitDepth)
        tellDepths(mine, reference, 0, &found.causes);
    else if (isCutOff(&look, look.below, look.above) || isCutOff(&look, look.above, look.below))
        tellCutOff(mine->bitDepth, 0, &found.causes);
    else if (isRounding(&look))
        tellAgreement(&look, &found.summary);
    else
        status = explainDifference(mine, reference, referenceName, &look, &found.causes);
    if (!statusIsOk(&status))
        freePictureExplanation(&found);
    else
        *explanation = found;
    return status;
}

/* ---- A picture and its scene ---- */

/* The picture as it should be stored, from the fast engine. */
static Status drawRight(const CompiledScene *compiled, const Image *like, int threads, Image *right)
{
    Framebuffer *framebuffer = createFramebuffer(like->width, like->height);
    if (framebuffer == NULL)
        return statusOutOfMemory();
    RenderOptions options = {.threads = threads};
    Status status = renderCompiled(compiled, framebuffer, &options, NULL);
    if (statusIsOk(&status))
        status = imageFromFramebuffer(framebuffer, like->bitDepth, like->encoding, threads, right);
    freeFramebuffer(framebuffer);
    return status;
}

/* Tell other settings of the picture, if they leave nothing. */
static Status explainSettings(const Image *picture, const Image *right, const Truth *truth,
                              const SceneSource *source, Explanations *causes)
{
    PartFinding settings;
    Status status = findSettings(truth, picture, right, &settings);
    if (!statusIsOk(&status))
        return status;
    if (settings.isFound)
        tellPart(&settings, truth->scene, source, causes);
    freePartFinding(&settings);
    return status;
}

/* Where no mistake that is made for the whole scene fits, or fits well: in which part it is, or what there is
 * to say without knowing it. */
static Status explainPart(const Image *picture, const Image *right, const Truth *truth,
                          const SceneSource *source, const Look *look, const Findings *findings,
                          Explanations *causes)
{
    PartFinding part;
    Status status = findPart(truth, picture, right, &part);
    if (!statusIsOk(&status))
        return status;
    if (part.isFound && part.residual < PART_LEAVES * shareLeft(findings) * findings->before)
        tellPart(&part, truth->scene, source, causes);
    else if (findings->count > 0)
        tellFindings(findings, truth->scene, source, NULL, causes);
    else if (isSpeckled(look))
        tellAcne(look->rmseButDarker, causes);
    else
        status = explainButForSpecks(picture, right, look, causes);
    if (statusIsOk(&status) && causes->count == 0)
        tellOwners(&part.owners, truth->scene, source, tellUnknown(look, true, causes));
    freePartFinding(&part);
    return status;
}

/* Try the mistakes that are made for the whole scene, and then those in a part of it. */
static Status explainByMistakes(const Image *picture, const Image *right, const Truth *truth,
                                const SceneSource *source, const Look *look, Explanations *causes)
{
    Traits *traits = malloc(sizeof *traits);
    if (traits == NULL)
        return statusOutOfMemory();
    listPossibleTraits(truth->scene, picture, right, look, traits);
    Findings findings;
    Status status = searchCauses(truth, picture, right, NULL, traits, &findings);
    /* A picture that was drawn right and changed afterwards has edges and borders that no tracing gives. */
    if (statusIsOk(&status) && findings.count == 0)
        status = searchFrom(picture, right, NULL, look, traits, &findings);
    if (statusIsOk(&status) && shareLeft(&findings) <= WELL_EXPLAINED)
        tellFindings(&findings, truth->scene, source, NULL, causes);
    else if (statusIsOk(&status))
        status = explainPart(picture, right, truth, source, look, &findings, causes);
    free(traits);
    return status;
}

static Status explainFromScene(const Image *picture, const Image *right, const CompiledScene *compiled,
                               const SceneSource *source, int threads, const Look *look, Explanations *causes)
{
    Truth truth;
    Status status = truthOfScene(compiledFinder(compiled), threads, &truth);
    if (!statusIsOk(&status))
        return status;
    status = explainSettings(picture, right, &truth, source, causes);
    if (statusIsOk(&status) && causes->count == 0)
        status = explainByMistakes(picture, right, &truth, source, look, causes);
    if (statusIsOk(&status) && causes->count > 0 && isBlackPicture(picture))
        status = appendBlackReasons(&truth, picture, right, &causes->items[0].text);
    freeTruth(&truth);
    return status;
}

Status explainPictureOfScene(const Image *picture, const Scene *scene, const SceneSource *source, int threads,
                             PictureExplanation *explanation)
{
    CompiledScene *compiled;
    Status status = compileScene(scene, threads, &compiled);
    if (!statusIsOk(&status))
        return status;
    PictureExplanation found = {0};
    status = drawRight(compiled, picture, threads, &found.right);
    if (statusIsOk(&status)) {
        Look look = lookAt(picture, &found.right);
        found.causes.before = look.rmse;
        if (isCutOff(&look, look.below, look.above))
            tellCutOff(picture->bitDepth, 0, &found.causes);
        else if (isRounding(&look))
            tellAgreement(&look, &found.summary);
        else
            status = explainFromScene(picture, &found.right, compiled, source, threads, &look, &found.causes);
    }
    if (statusIsOk(&status))
        *explanation = found;
    else
        freePictureExplanation(&found);
    freeCompiledScene(compiled);
    return status;
}
