/* hypothesis.c - see hypothesis.h. */
#include "explain/hypothesis.h"

#include <math.h>
#include <string.h>

Hypothesis neutralHypothesis(void)
{
    return (Hypothesis){
        .view = neutralViewChange(), .light = neutralLightChange(), .value = neutralValueChange()};
}

/* ---- Numbers to try ---- */

#define GRID(name) .grid = name, .gridCount = (int)(sizeof name / sizeof *name)

static const double FACTORS[] = {1 / 32., 1 / 16., 1 / 8., 1 / 5., 1 / 3., 0.5, 0.7, 0.85, 0.95,
                                 1.05,    1.2,     1.4,    2,      3,      5,   8,   16,   32};
static const double POWERS[] = {0.3, 0.45, 0.6, 0.75, 0.9, 1.1, 1.35, 1.7, 2.2, 3};
static const double OFFSETS[] = {-0.5, -0.2, -0.1, -0.05, -0.02, -0.005, 0.005, 0.02, 0.05, 0.1, 0.2, 0.5};
static const double LEVELS[] = {4, 5, 6, 7, 8, 10, 16, 32, 64, 128, 256};
static const double DROPPED_BITS[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14};
static const double STRETCHES[] = {0.45, 0.5,   0.5625, 0.625,  0.6875, 0.75, 0.8,    0.875, 0.95,
                                   1.05, 1.125, 1.25,   1.3333, 1.5,    1.6,  1.7778, 2,     2.2};
static const double EXPONENTS[] = {0, 0.5, 1, 1.5, 2.5, 3, 4};
static const double SHININESS_FACTORS[] = {1 / 16., 1 / 8., 1 / 4., 1 / 2., 0.7, 0.85, 1.2, 1.4, 2, 4, 8, 16};
static const double AMBIENTS[] = {0, 0.25, 0.5, 0.75, 1.5, 2, 3, 5};
static const double LIGHT_FACTORS[] = {0, 0.1, 0.25, 0.5, 0.75, 1.25, 1.5, 2, 3, 5, 10};
static const double SHININESSES[] = {1, 2, 5, 10, 20, 40, 80, 160, 320};

/* ---- Values ---- */

static const char GAMMA_FORMULA[] = "the encoding of the file: v = srgb(linear), once (IEC 61966-2-1)";
static const char CLAMP_FORMULA[] =
    "color = sum over the lights of Lc * (...), clamped only when it is stored";

static void applyEncoding(const Trait *trait, double number, Hypothesis *hypothesis)
{
    (void)number;
    hypothesis->value.encoding = (EncodingMistake)trait->choice;
}

static void tellEncoding(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)number;
    (void)scene;
    textAppend(text,
               trait->choice == ENCODED_TWICE
                   ? "the sRGB curve is applied once too often (double gamma), so the picture is too bright"
                   : "the sRGB curve is missing: linear light is stored where encoded samples belong, so the "
                     "picture is too dark");
}

static void applyPower(const Trait *trait, double number, Hypothesis *hypothesis)
{
    if (trait->choice == 0)
        hypothesis->value.storedPower = (float)number;
    else
        hypothesis->value.linearPower = (float)number;
}

static void tellPower(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)scene;
    textAppend(text, trait->choice == 0 ? "the stored samples are raised to the power "
                                        : "linear light is raised to the power ");
    appendRounded(text, number, 3);
    textAppend(text, number > 1 ? " (a gamma of " : " (a gamma of 1/");
    appendRounded(text, number > 1 ? number : 1 / number, 3);
    textAppend(text, number > 1 ? " decoded once too often)" : " applied once too often)");
}

static void applyScale(const Trait *trait, double number, Hypothesis *hypothesis)
{
    if (trait->choice == 0)
        hypothesis->value.scale = (float)number;
    else
        hypothesis->value.storedScale = (float)number;
}

static void tellScale(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)scene;
    textAppend(text, trait->choice == 0 ? "all light is " : "all stored samples are ");
    appendRounded(text, number, 4);
    textAppend(text,
               trait->choice == 0 ? " times as much as it should be" : " times as high as they should be");
}

static void applyOffset(const Trait *trait, double number, Hypothesis *hypothesis)
{
    hypothesis->value.offset = (float)number;
    hypothesis->value.offsetPlace = (OffsetPlace)trait->choice;
}

static void tellOffset(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)scene;
    textAppend(text, number > 0 ? "an ambient light of " : "an ambient light of ");
    appendRounded(text, fabs(number), 3);
    textAppend(text, number > 0 ? " is added " : " is missing ");
    textAppend(text, trait->choice == OFFSET_EVERYWHERE    ? "everywhere, the background included"
                     : trait->choice == OFFSET_ON_SURFACES ? "on all surfaces, whatever their colour"
                                                           : "on all surfaces, times their diffuse colour");
}

static void applyStoredOffset(const Trait *trait, double number, Hypothesis *hypothesis)
{
    hypothesis->value.storedOffset = (float)number;
    hypothesis->value.storedOnSurfaces = trait->choice != 0;
}

static void tellStoredOffset(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)scene;
    appendRounded(text, fabs(number), 3);
    textAppend(text, number > 0 ? " is added to the stored samples " : " is taken from the stored samples ");
    textAppend(text, trait->choice == 0 ? "everywhere, as if all were lit a little"
                                        : "of all surfaces, as by an ambient light after the encoding");
}

static void applyChannels(const Trait *trait, double number, Hypothesis *hypothesis)
{
    (void)number;
    for (int i = 0, order = trait->choice; i < 3; i++, order /= 10)
        hypothesis->value.channels[2 - i] = order % 10;
}

static void tellChannels(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)number;
    (void)scene;
    static const char *const NAMES[] = {"red", "green", "blue"};
    textAppendFormat(
        text, "the channels are in another order: what is stored as red, green and blue is %s, %s and %s",
        NAMES[trait->choice / 100], NAMES[trait->choice / 10 % 10], NAMES[trait->choice % 10]);
}

static void applyLevels(const Trait *trait, double number, Hypothesis *hypothesis)
{
    hypothesis->value.levels = (int)number;
    hypothesis->value.levelsLinear = (trait->choice & 1) != 0;
    hypothesis->value.truncated = (trait->choice & 2) != 0;
}

static void tellLevels(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)scene;
    textAppendFormat(text, "the samples have only %d levels%s%s", (int)number,
                     (trait->choice & 1) != 0 ? " of linear light" : "",
                     (trait->choice & 2) != 0 ? ", and are cut off instead of rounded" : "");
    if (number == 256)
        textAppend(text, " (8 bits)");
}

static void applyDroppedBits(const Trait *trait, double number, Hypothesis *hypothesis)
{
    (void)trait;
    hypothesis->value.droppedBits = (int)number;
}

static void tellDroppedBits(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)trait;
    (void)scene;
    textAppendFormat(text, "the lowest %d bits of the samples are 0: they were cut off and not rounded",
                     (int)number);
}

/* ---- Views ---- */

static void applyMirrored(const Trait *trait, double number, Hypothesis *hypothesis)
{
    (void)number;
    if (trait->choice == 0)
        hypothesis->view.mirrored = true;
    else
        hypothesis->view.flipped = true;
}

static void tellMirrored(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)number;
    (void)scene;
    textAppend(text,
               trait->choice == 0
                   ? "left and right are swapped: the camera's right vector points to the left, or the world "
                     "is left-handed"
                   : "top and bottom are swapped: row 0 is the top of the picture, and v points up");
}

static void applyShift(const Trait *trait, double number, Hypothesis *hypothesis)
{
    (void)number;
    hypothesis->view.shiftX = trait->shiftX;
    hypothesis->view.shiftY = trait->shiftY;
}

static void appendShift(Text *text, double shift, const char *positive, const char *negative)
{
    textAppend(text, fabs(shift) == 0.5 ? "half a pixel " : "one pixel ");
    textAppend(text, shift > 0 ? positive : negative);
}

static void tellShift(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)number;
    (void)scene;
    /* Where the wrong picture shows what lies to the right, its content has moved to the left. */
    textAppend(text, "the picture is moved ");
    if (trait->shiftX != 0)
        appendShift(text, trait->shiftX, "to the left", "to the right");
    if (trait->shiftX != 0 && trait->shiftY != 0)
        textAppend(text, " and ");
    if (trait->shiftY != 0)
        appendShift(text, trait->shiftY, "up", "down");
    if (fabs(trait->shiftX) == 0.5 || fabs(trait->shiftY) == 0.5)
        textAppend(text, ": rays go through the corners of the pixels and not through their middles");
}

static void applyStretch(const Trait *trait, double number, Hypothesis *hypothesis)
{
    if (trait->choice != 1)
        hypothesis->view.scaleX = number;
    if (trait->choice != 0)
        hypothesis->view.scaleY = number;
}

static void tellStretch(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)scene;
    static const char *const WAYS[] = {"the picture shows ", "the picture shows ", "the picture shows "};
    textAppend(text, WAYS[trait->choice]);
    appendRounded(text, number, 3);
    textAppend(text, trait->choice == 0 ? " times its width in the same space: the aspect of the picture is "
                                          "not that of the camera"
                     : trait->choice == 1
                         ? " times its height in the same space: the aspect of the picture is "
                           "not that of the camera"
                         : " times its width and height: the angle of view is another one");
}

/* ---- Light ---- */

static void applyShadows(const Trait *trait, double number, Hypothesis *hypothesis)
{
    (void)number;
    hypothesis->light.shadows = (ShadowMistake)trait->choice;
    hypothesis->light.shadowlessLight = trait->other;
}

static void tellShadows(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)number;
    (void)scene;
    if (trait->other > 0)
        textAppendFormat(text, "light %d throws no shadows", trait->other);
    else if (trait->choice == SHADOWS_NONE)
        textAppend(text, "shadows are missing: nothing blocks the light");
    else if (trait->choice == SHADOWS_TOO_LONG)
        textAppend(text, "there are too many shadows: objects behind the light block it too");
    else
        textAppend(text, "there are shadows, and the scene says shadows: false");
}

static void applyFalloff(const Trait *trait, double number, Hypothesis *hypothesis)
{
    hypothesis->light.falloff = (FalloffMistake)trait->choice;
    hypothesis->light.exponent = number;
}

static void tellFalloff(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)scene;
    if (trait->choice == FALLOFF_POVRAY) {
        textAppend(text, "the lights fall off by 2/(1 + d^2), as POV-Ray's fade_distance 1 does");
    } else if (trait->choice == FALLOFF_ONE_MORE) {
        textAppend(text, "the lights fall off by 1/(1 + d^2)");
    } else if (fabs(number) < 0.01) {
        textAppend(text, "falloff is missing: the lights are as strong at any distance");
    } else {
        textAppend(text, "the lights fall off by 1/d^");
        appendRounded(text, number, 3);
    }
}

static void applyHighlight(const Trait *trait, double number, Hypothesis *hypothesis)
{
    (void)number;
    hypothesis->light.highlight = (HighlightMistake)trait->choice;
}

static void tellHighlight(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)number;
    bool blinn = scene != NULL && scene->render.model == MODEL_BLINN_PHONG;
    switch ((HighlightMistake)trait->choice) {
    case HIGHLIGHT_OTHER_MODEL:
        textAppend(text, blinn
                             ? "the highlight is Phong's, (R.V)^shininess, where the scene asks for Blinn's, "
                               "(N.H)^shininess"
                             : "the highlight is Blinn's, (N.H)^shininess, where the scene asks for Phong's, "
                               "(R.V)^shininess");
        break;
    case HIGHLIGHT_NO_FALLOFF:
        textAppend(text, "the highlight does not fall off with the distance of the light");
        break;
    case HIGHLIGHT_DIFFUSE:
        textAppend(text, "the highlight has the diffuse colour: Ispec is multiplied by Ic");
        break;
    default:
        textAppend(text, "the highlight is missing");
        break;
    }
}

static void applyShininess(const Trait *trait, double number, Hypothesis *hypothesis)
{
    hypothesis->light.shininess = (ShininessMistake)trait->choice;
    hypothesis->light.shininessValue = number;
    hypothesis->light.shininessOf = trait->group;
}

static void tellShininess(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)scene;
    if (trait->choice == SHININESS_OF_ONE) {
        textAppend(text, "where the scene says shininess ");
        appendRounded(text, (double)trait->group, 4);
        textAppend(text, ", the highlight is that of ");
        appendRounded(text, number, 3);
    } else if (trait->choice == SHININESS_IS) {
        textAppend(text, "all highlights are those of shininess ");
        appendRounded(text, number, 3);
    } else {
        textAppend(text, "the exponent of the highlights is ");
        appendRounded(text, number, 3);
        textAppend(text, " times the scene's shininess");
    }
}

static void applyNormals(const Trait *trait, double number, Hypothesis *hypothesis)
{
    (void)number;
    hypothesis->light.normals = (NormalMistake)trait->choice;
    hypothesis->light.backUnshadowed = trait->other != 0;
}

static void tellNormals(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)number;
    (void)scene;
    textAppend(text,
               trait->choice == NORMALS_FLIPPED ? "the normals point into the objects, so what faces a light "
                                                  "is dark"
               : trait->choice == NORMALS_NOT_TURNED
                   ? "the normals are not turned to the side that is seen, so surfaces seen from inside are "
                     "lit from outside"
                   : "the normals are those of the triangles, and the scene's are interpolated (smooth)");
}

static void applyNegative(const Trait *trait, double number, Hypothesis *hypothesis)
{
    (void)number;
    hypothesis->light.negative = (NegativeMistake)trait->choice;
    hypothesis->light.backUnshadowed = trait->other != 0;
}

static void tellNegative(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)number;
    (void)scene;
    textAppend(text, trait->choice == NEGATIVE_SUBTRACTS
                         ? "dot(N, L) is not clamped at 0, so lights behind a surface take light away"
                     : trait->choice == NEGATIVE_ABSOLUTE
                         ? "the absolute value of dot(N, L) is taken, so lights behind a surface light it"
                         : "the highlight is added for lights behind the surface too");
}

static void applyAmbientScale(const Trait *trait, double number, Hypothesis *hypothesis)
{
    (void)trait;
    hypothesis->light.ambientScale = number;
}

static void tellAmbientScale(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)trait;
    (void)scene;
    if (number == 0) {
        textAppend(text, "the ambient term is missing");
        return;
    }
    textAppend(text, "the ambient light is ");
    appendRounded(text, number, 3);
    textAppend(text, " times the scene's");
}

static void applyLightScale(const Trait *trait, double number, Hypothesis *hypothesis)
{
    hypothesis->light.lightScale = number;
    hypothesis->light.scaledLight = trait->other;
}

static void tellLightScale(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)scene;
    if (trait->other == 0)
        textAppend(text, "the lights are ");
    else
        textAppendFormat(text, "light %d is ", trait->other);
    if (number == 0) {
        textAppend(text, "missing");
        return;
    }
    appendRounded(text, number, 3);
    textAppend(text, " times as bright as they should be");
}

static void applyAcne(const Trait *trait, double number, Hypothesis *hypothesis)
{
    (void)trait;
    (void)number;
    hypothesis->acne = true;
}

static void tellAcne(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)trait;
    (void)number;
    (void)scene;
    textAppend(text,
               "shadow acne: surfaces shadow themselves in specks, since the ray to the light starts on the "
               "surface, a rounding error below it");
}

/* ---- The list ---- */

static void addTrait(Traits *traits, Trait trait)
{
    if (traits->count < MAX_TRAITS)
        traits->items[traits->count++] = trait;
}

static void addValueTraits(const Scene *scene, StoredFormat file, Traits *traits)
{
    static const int ORDERS[] = {21, 102, 120, 201, 210};
    for (size_t i = 0; i < sizeof ORDERS / sizeof *ORDERS; i++)
        addTrait(traits, (Trait){.cause = CAUSE_CHANNELS,
                                 .part = TRAIT_VALUE,
                                 .apply = applyChannels,
                                 .choice = ORDERS[i],
                                 .tell = tellChannels,
                                 .formula = "the order in which r, g and b are written"});
    for (int mistake = ENCODED_TWICE; mistake <= NOT_ENCODED; mistake++)
        addTrait(traits, (Trait){.cause = CAUSE_GAMMA,
                                 .part = TRAIT_VALUE,
                                 .apply = applyEncoding,
                                 .choice = mistake,
                                 .tell = tellEncoding,
                                 .formula = GAMMA_FORMULA,
                                 .key = "encoding"});
    addTrait(traits, (Trait){.cause = CAUSE_EXPOSURE,
                             .part = TRAIT_VALUE,
                             .apply = applyScale,
                             GRID(FACTORS),
                             .isLogarithmic = true,
                             .tell = tellScale,
                             .formula = CLAMP_FORMULA,
                             .key = "color"});
    for (int choice = 0; choice < 2; choice++)
        addTrait(traits, (Trait){.cause = CAUSE_GAMMA,
                                 .part = TRAIT_VALUE,
                                 .apply = applyPower,
                                 GRID(POWERS),
                                 .isLogarithmic = true,
                                 .choice = choice,
                                 .tell = tellPower,
                                 .formula = GAMMA_FORMULA,
                                 .key = "encoding"});
    addTrait(traits, (Trait){.cause = CAUSE_EXPOSURE,
                             .part = TRAIT_VALUE,
                             .apply = applyScale,
                             GRID(FACTORS),
                             .isLogarithmic = true,
                             .choice = 1,
                             .tell = tellScale,
                             .formula = CLAMP_FORMULA,
                             .key = "color"});
    for (int place = OFFSET_EVERYWHERE; place <= OFFSET_ON_DIFFUSE; place++)
        if (place != OFFSET_ON_DIFFUSE || scene != NULL)
            addTrait(traits, (Trait){.cause = CAUSE_AMBIENT,
                                     .part = TRAIT_VALUE,
                                     .apply = applyOffset,
                                     GRID(OFFSETS),
                                     .choice = place,
                                     .tell = tellOffset,
                                     .formula = "color = ambient * render.ambient + emission + ...",
                                     .key = "ambient"});
    for (int choice = 0; choice < 2; choice++)
        addTrait(traits, (Trait){.cause = CAUSE_AMBIENT,
                                 .part = TRAIT_VALUE,
                                 .apply = applyStoredOffset,
                                 GRID(OFFSETS),
                                 .choice = choice,
                                 .tell = tellStoredOffset,
                                 .formula = "color = ambient * render.ambient + emission + ...",
                                 .key = "ambient"});
    addTrait(traits, (Trait){.cause = CAUSE_QUANTISATION,
                             .part = TRAIT_VALUE,
                             .apply = applyDroppedBits,
                             .grid = DROPPED_BITS,
                             .gridCount = file.bitDepth == 16 ? 14 : 6,
                             .isWhole = true,
                             .tell = tellDroppedBits,
                             .formula = "sample = floor(v * (2^bits - 1) + 1/2)",
                             .key = "bit_depth"});
    for (int choice = 0; choice < 4; choice++) {
        bool ofFile = choice == (file.encoding == ENCODING_LINEAR ? 1 : 0) && file.bitDepth == 8;
        addTrait(traits, (Trait){.cause = CAUSE_QUANTISATION,
                                 .part = TRAIT_VALUE,
                                 .apply = applyLevels,
                                 .grid = LEVELS,
                                 /* 256 levels of an 8-bit file are no mistake. */
                                 .gridCount = (int)(sizeof LEVELS / sizeof *LEVELS) - ofFile,
                                 .isWhole = true,
                                 .choice = choice,
                                 .tell = tellLevels,
                                 .formula = "sample = floor(v * (2^bits - 1) + 1/2)",
                                 .key = "bit_depth"});
    }
}

static void addViewTraits(Traits *traits)
{
    for (int choice = 0; choice < 2; choice++)
        addTrait(traits, (Trait){.cause = choice == 0 ? CAUSE_MIRRORED : CAUSE_FLIPPED,
                                 .part = TRAIT_VIEW,
                                 .apply = applyMirrored,
                                 .choice = choice,
                                 .tell = tellMirrored,
                                 .formula = choice == 0 ? "right = cross(forward, up)"
                                                        : "v = (height - y) / height - 1/2",
                                 .key = choice == 0 ? "camera" : "up"});
    for (int half = 0; half < 2; half++)
        for (int y = -1; y <= 1; y++)
            for (int x = -1; x <= 1; x++)
                if (x != 0 || y != 0)
                    addTrait(traits, (Trait){.cause = CAUSE_SHIFT,
                                             .part = TRAIT_VIEW,
                                             .apply = applyShift,
                                             .shiftX = half ? x * 0.5 : x,
                                             .shiftY = half ? y * 0.5 : y,
                                             .tell = tellShift,
                                             .formula = "the ray goes through (x + 1/2, y + 1/2)"});
    for (int way = 0; way < 3; way++)
        addTrait(traits, (Trait){.cause = CAUSE_ASPECT,
                                 .part = TRAIT_VIEW,
                                 .apply = applyStretch,
                                 GRID(STRETCHES),
                                 .isLogarithmic = true,
                                 .choice = way,
                                 .tell = tellStretch,
                                 .formula = "height = 2 tan(fov/2), width = height * columns / rows",
                                 .key = way == 2 ? "fov" : "width"});
}

static bool hasHighlights(const Object *objects, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (objects[i].kind == SHAPE_CSG) {
            if (hasHighlights(objects[i].csg.parts, objects[i].csg.partCount))
                return true;
        } else if (!colorIsBlack(objects[i].material.specular)) {
            return true;
        }
    }
    return false;
}

/* Collect the first different exponents of the highlights, those of CSG objects' parts too; count is how many
 * there are already. */
static size_t listShininesses(const Object *objects, size_t objectCount, float *found, size_t count,
                              size_t most)
{
    for (size_t i = 0; i < objectCount && count < most; i++) {
        const Material *material = &objects[i].material;
        if (objects[i].kind == SHAPE_CSG) {
            count = listShininesses(objects[i].csg.parts, objects[i].csg.partCount, found, count, most);
            continue;
        }
        bool isKnown = colorIsBlack(material->specular);
        for (size_t j = 0; j < count; j++)
            isKnown |= found[j] == material->shininess;
        if (!isKnown)
            found[count++] = material->shininess;
    }
    return count;
}

static void addLightTrait(Traits *traits, Cause cause, void (*apply)(const Trait *, double, Hypothesis *),
                          void (*tell)(const Trait *, double, const Scene *, Text *), int choice, int other,
                          const char *formula, const char *key)
{
    addTrait(traits, (Trait){.cause = cause,
                             .part = TRAIT_LIGHT,
                             .apply = apply,
                             .tell = tell,
                             .choice = choice,
                             .other = other,
                             .formula = formula,
                             .key = key});
}

static void addHighlightTraits(const Scene *scene, Traits *traits)
{
    static const char PHONG[] = "Ispec * Lc * max(0, dot(R, V))^shininess / d^2";
    addLightTrait(traits, CAUSE_SPECULAR, applyHighlight, tellHighlight, HIGHLIGHT_NONE, 0, PHONG,
                  "specular");
    addLightTrait(traits, CAUSE_BLINN, applyHighlight, tellHighlight, HIGHLIGHT_OTHER_MODEL, 0, PHONG,
                  "model");
    addLightTrait(traits, CAUSE_SPECULAR, applyHighlight, tellHighlight, HIGHLIGHT_NO_FALLOFF, 0, PHONG,
                  "specular");
    addLightTrait(traits, CAUSE_SPECULAR, applyHighlight, tellHighlight, HIGHLIGHT_DIFFUSE, 0, PHONG,
                  "specular");
    Trait shininess = {.cause = CAUSE_SHININESS,
                       .part = TRAIT_LIGHT,
                       .apply = applyShininess,
                       .isLogarithmic = true,
                       .tell = tellShininess,
                       .formula = PHONG,
                       .key = "shininess"};
    float groups[6];
    size_t count = listShininesses(scene->objects, scene->objectCount, groups, 0, 6);
    for (size_t i = 0; i < count; i++) {
        Trait one = shininess;
        one.grid = SHININESSES;
        one.gridCount = (int)(sizeof SHININESSES / sizeof *SHININESSES);
        one.choice = count > 1 ? SHININESS_OF_ONE : SHININESS_IS;
        one.group = groups[i];
        addTrait(traits, one);
    }
    if (count > 1) {
        Trait all = shininess;
        all.grid = SHININESS_FACTORS;
        all.gridCount = (int)(sizeof SHININESS_FACTORS / sizeof *SHININESS_FACTORS);
        all.choice = SHININESS_TIMES;
        addTrait(traits, all);
        all.grid = SHININESSES;
        all.gridCount = (int)(sizeof SHININESSES / sizeof *SHININESSES);
        all.choice = SHININESS_IS;
        addTrait(traits, all);
    }
}

/* All lamps brighter or darker; of several also each alone. */
static void addLightScales(const Scene *scene, Traits *traits)
{
    size_t each = scene->lightCount > 1 && scene->lightCount <= 8 ? scene->lightCount : 0;
    for (size_t i = 0; i <= each && scene->lightCount > 0; i++)
        addTrait(traits, (Trait){.cause = CAUSE_EXPOSURE,
                                 .part = TRAIT_LIGHT,
                                 .apply = applyLightScale,
                                 GRID(LIGHT_FACTORS),
                                 .other = (int)i,
                                 .tell = tellLightScale,
                                 .formula = "Ic * Lc * dot(N, L) / d^2",
                                 .key = "color"});
}

static void addLightTraits(const Scene *scene, Traits *traits)
{
    static const char SHADOW[] = "a light counts if nothing lies strictly between the point and it";
    static const char FALLOFF[] = "Ic * Lc * dot(N, L) / d^2";
    static const char FACING[] = "Ic * Lc * max(0, dot(N, L)) / d^2";
    if (scene->render.shadows) {
        addLightTrait(traits, CAUSE_SHADOW, applyShadows, tellShadows, SHADOWS_NONE, 0, SHADOW, "shadows");
        addLightTrait(traits, CAUSE_SHADOW, applyShadows, tellShadows, SHADOWS_TOO_LONG, 0, SHADOW,
                      "shadows");
        for (size_t i = 0; i < scene->lightCount && i < 8 && scene->lightCount > 1; i++)
            addLightTrait(traits, CAUSE_SHADOW, applyShadows, tellShadows, SHADOWS_AS_SCENE, (int)i + 1,
                          SHADOW, "lights");
    } else {
        addLightTrait(traits, CAUSE_SHADOW, applyShadows, tellShadows, SHADOWS_UNASKED, 0, SHADOW, "shadows");
    }
    Trait falloff = {.cause = CAUSE_FALLOFF,
                     .part = TRAIT_LIGHT,
                     .apply = applyFalloff,
                     GRID(EXPONENTS),
                     .choice = FALLOFF_POWER,
                     .tell = tellFalloff,
                     .formula = FALLOFF,
                     .key = "falloff"};
    addTrait(traits, falloff);
    addLightTrait(traits, CAUSE_FALLOFF, applyFalloff, tellFalloff, FALLOFF_POVRAY, 0, FALLOFF, "falloff");
    addLightTrait(traits, CAUSE_FALLOFF, applyFalloff, tellFalloff, FALLOFF_ONE_MORE, 0, FALLOFF, "falloff");
    if (hasHighlights(scene->objects, scene->objectCount))
        addHighlightTraits(scene, traits);
    for (int back = 0; back < 2; back++) {
        addLightTrait(traits, CAUSE_NORMALS, applyNormals, tellNormals, NORMALS_FLIPPED, back,
                      "N is of unit length and points to the side the ray comes from", NULL);
        for (int mistake = NEGATIVE_SUBTRACTS; mistake <= NEGATIVE_HIGHLIGHT; mistake++)
            addLightTrait(traits, CAUSE_NEGATIVE_LIGHT, applyNegative, tellNegative, mistake, back, FACING,
                          NULL);
    }
    addLightTrait(traits, CAUSE_NORMALS, applyNormals, tellNormals, NORMALS_NOT_TURNED, 1,
                  "N is of unit length and points to the side the ray comes from", NULL);
    addLightTrait(traits, CAUSE_NORMALS, applyNormals, tellNormals, NORMALS_FLAT, 0,
                  "N is interpolated between the corners of a triangle", "smooth");
    if (!colorIsBlack(scene->render.ambient))
        addTrait(traits, (Trait){.cause = CAUSE_AMBIENT,
                                 .part = TRAIT_LIGHT,
                                 .apply = applyAmbientScale,
                                 GRID(AMBIENTS),
                                 .tell = tellAmbientScale,
                                 .formula = "color = ambient * render.ambient + emission + ...",
                                 .key = "ambient"});
    addLightScales(scene, traits);
    if (scene->lightCount > 0)
        addTrait(traits, (Trait){.cause = CAUSE_ACNE,
                                 .part = TRAIT_ACNE,
                                 .apply = applyAcne,
                                 .tell = tellAcne,
                                 .formula = "the shadow ray starts a little off the surface: offsetStart in "
                                            "src/raytracer.c",
                                 .key = "shadow_bias"});
}

void listTraits(const Scene *scene, StoredFormat file, Traits *traits)
{
    traits->count = 0;
    addViewTraits(traits);
    addValueTraits(scene, file, traits);
    if (scene != NULL)
        addLightTraits(scene, traits);
}

bool traitsCombine(const Trait *a, const Trait *b)
{
    /* Each cause once, and what the same field of a hypothesis would hold twice not at all. */
    if (a->cause == b->cause || (a->apply == b->apply && a->apply != applyMirrored))
        return false;
    bool bothBack = (a->apply == applyNormals || a->apply == applyNegative) &&
                    (b->apply == applyNormals || b->apply == applyNegative);
    return !bothBack;
}
