/* value_traits.c - the mistakes in values and views, with what is said of them; see hypothesis.h. */
#include "explain/trait_list.h"

#include <math.h>

/* ---- Numbers to try ---- */

static const double FACTORS[] = {1 / 32., 1 / 16., 1 / 8., 1 / 5., 1 / 3., 0.5, 0.7, 0.85, 0.95,
                                 1.05,    1.2,     1.4,    2,      3,      5,   8,   16,   32};
static const double POWERS[] = {0.3, 0.45, 0.6, 0.75, 0.9, 1.1, 1.35, 1.7, 2.2, 3};
static const double CURVE_POWERS[] = {1.4, 1.6, 1.8, 2, 2.2, 2.4, 2.6, 2.8};
static const double OFFSETS[] = {-0.5, -0.2, -0.1, -0.05, -0.02, -0.005, 0.005, 0.02, 0.05, 0.1, 0.2, 0.5};
static const double LEVELS[] = {4, 5, 6, 7, 8, 10, 16, 32, 64, 128, 256};
static const double DROPPED_BITS[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14};
static const double STRETCHES[] = {0.45, 0.5,   0.5625, 0.625,  0.6875, 0.75, 0.8,    0.875, 0.95,
                                   1.05, 1.125, 1.25,   1.3333, 1.5,    1.6,  1.7778, 2,     2.2};

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
    textAppendRounded(text, number, 3);
    textAppend(text, number > 1 ? " (a gamma of " : " (a gamma of 1/");
    textAppendRounded(text, number > 1 ? number : 1 / number, 3);
    textAppend(text, number > 1 ? " decoded once too often)" : " applied once too often)");
}

static void applyCurvePower(const Trait *trait, double number, Hypothesis *hypothesis)
{
    (void)trait;
    hypothesis->value.curvePower = (float)(1 / number);
}

static void tellCurvePower(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)trait;
    (void)scene;
    textAppend(text, "the samples are encoded by the power 1/");
    textAppendRounded(text, number, 3);
    textAppend(text, " and not by the sRGB curve");
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
    textAppendRounded(text, number, 4);
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
    textAppend(text, "an ambient light of ");
    textAppendRounded(text, fabs(number), 3);
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
    textAppendRounded(text, fabs(number), 3);
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
    textAppend(text, "the picture shows ");
    textAppendRounded(text, number, 3);
    textAppend(text, trait->choice == 0 ? " times its width in the same space: the aspect of the picture is "
                                          "not that of the camera"
                     : trait->choice == 1
                         ? " times its height in the same space: the aspect of the picture is "
                           "not that of the camera"
                         : " times its width and height: the angle of view is another one");
}

/* ---- The list, without the choices ---- */

static const char AMBIENT_FORMULA[] = "color = ambient * render.ambient + emission + ...";
static const char LEVEL_FORMULA[] = "sample = floor(v * (2^bits - 1) + 1/2)";

static const Trait CHANNELS = {.cause = CAUSE_CHANNELS,
                               .part = TRAIT_VALUE,
                               .apply = applyChannels,
                               .tell = tellChannels,
                               .formula = "the order in which r, g and b are written"};
static const Trait ENCODED = {.cause = CAUSE_GAMMA,
                              .part = TRAIT_VALUE,
                              .apply = applyEncoding,
                              .tell = tellEncoding,
                              .formula = GAMMA_FORMULA,
                              .key = "encoding"};
static const Trait POWER = {.cause = CAUSE_GAMMA,
                            .part = TRAIT_VALUE,
                            .apply = applyPower,
                            GRID(POWERS),
                            .isLogarithmic = true,
                            .tell = tellPower,
                            .formula = GAMMA_FORMULA,
                            .key = "encoding"};
static const Trait CURVE_POWER = {.cause = CAUSE_GAMMA,
                                  .part = TRAIT_VALUE,
                                  .apply = applyCurvePower,
                                  GRID(CURVE_POWERS),
                                  .tell = tellCurvePower,
                                  .formula = GAMMA_FORMULA,
                                  .key = "encoding"};
static const Trait SCALE = {.cause = CAUSE_EXPOSURE,
                            .part = TRAIT_VALUE,
                            .apply = applyScale,
                            GRID(FACTORS),
                            .isLogarithmic = true,
                            .tell = tellScale,
                            .formula = CLAMP_FORMULA,
                            .key = "color"};
static const Trait OFFSET = {.cause = CAUSE_AMBIENT,
                             .part = TRAIT_VALUE,
                             .apply = applyOffset,
                             GRID(OFFSETS),
                             .tell = tellOffset,
                             .formula = AMBIENT_FORMULA,
                             .key = "ambient"};
static const Trait STORED_OFFSET = {.cause = CAUSE_AMBIENT,
                                    .part = TRAIT_VALUE,
                                    .apply = applyStoredOffset,
                                    GRID(OFFSETS),
                                    .tell = tellStoredOffset,
                                    .formula = AMBIENT_FORMULA,
                                    .key = "ambient"};
static const Trait BITS_DROPPED = {.cause = CAUSE_QUANTISATION,
                                   .part = TRAIT_VALUE,
                                   .apply = applyDroppedBits,
                                   GRID(DROPPED_BITS),
                                   .isWhole = true,
                                   .tell = tellDroppedBits,
                                   .formula = LEVEL_FORMULA,
                                   .key = "bit_depth"};
static const Trait FEW_LEVELS = {.cause = CAUSE_QUANTISATION,
                                 .part = TRAIT_VALUE,
                                 .apply = applyLevels,
                                 GRID(LEVELS),
                                 .isWhole = true,
                                 .tell = tellLevels,
                                 .formula = LEVEL_FORMULA,
                                 .key = "bit_depth"};
static const Trait MIRRORED = {.cause = CAUSE_MIRRORED,
                               .part = TRAIT_VIEW,
                               .apply = applyMirrored,
                               .tell = tellMirrored,
                               .formula = "right = cross(forward, up)",
                               .key = "camera"};
static const Trait FLIPPED = {.cause = CAUSE_FLIPPED,
                              .part = TRAIT_VIEW,
                              .apply = applyMirrored,
                              .choice = 1,
                              .tell = tellMirrored,
                              .formula = "v = (height - y) / height - 1/2",
                              .key = "up"};
static const Trait SHIFT = {.cause = CAUSE_SHIFT,
                            .part = TRAIT_VIEW,
                            .apply = applyShift,
                            .tell = tellShift,
                            .formula = "the ray goes through (x + 1/2, y + 1/2)"};
static const Trait STRETCH = {.cause = CAUSE_ASPECT,
                              .part = TRAIT_VIEW,
                              .apply = applyStretch,
                              GRID(STRETCHES),
                              .isLogarithmic = true,
                              .tell = tellStretch,
                              .formula = "height = 2 tan(fov/2), width = height * columns / rows",
                              .key = "width"};

/* ---- The list ---- */

static void addShifts(Traits *traits, double step)
{
    Trait shift = SHIFT;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++) {
            shift.shiftX = x * step;
            shift.shiftY = y * step;
            if (x != 0 || y != 0)
                addTrait(traits, shift);
        }
}

void addValueTraits(const Scene *scene, StoredFormat file, Traits *traits)
{
    static const int ORDERS[] = {21, 102, 120, 201, 210};
    for (size_t i = 0; i < sizeof ORDERS / sizeof *ORDERS; i++)
        addChoice(traits, CHANNELS, ORDERS[i]);
    addChoices(traits, ENCODED, ENCODED_TWICE, NOT_ENCODED);
    addChoice(traits, SCALE, 0);
    addChoices(traits, POWER, 0, 1);
    if (file.encoding == ENCODING_SRGB)
        addTrait(traits, CURVE_POWER);
    addChoice(traits, SCALE, 1);
    addChoices(traits, OFFSET, OFFSET_EVERYWHERE, scene != NULL ? OFFSET_ON_DIFFUSE : OFFSET_ON_SURFACES);
    addChoices(traits, STORED_OFFSET, 0, 1);
    Trait dropped = BITS_DROPPED;
    dropped.gridCount = file.bitDepth == 16 ? dropped.gridCount : 6;
    addTrait(traits, dropped);
    for (int choice = 0; choice < 4; choice++) {
        Trait levels = FEW_LEVELS;
        /* 256 levels of an 8-bit file are no mistake. */
        if (choice == (file.encoding == ENCODING_LINEAR ? 1 : 0) && file.bitDepth == 8)
            levels.gridCount--;
        addChoice(traits, levels, choice);
    }
}

void addViewTraits(Traits *traits)
{
    addTrait(traits, MIRRORED);
    addTrait(traits, FLIPPED);
    addShifts(traits, 1);
    addShifts(traits, 0.5);
    addChoices(traits, STRETCH, 0, 1);
    Trait both = STRETCH;
    both.key = "fov";
    addChoice(traits, both, 2);
}
