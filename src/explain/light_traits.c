/* light_traits.c - the mistakes in how light is computed, with what is said of them; see hypothesis.h. */
#include "explain/trait_list.h"

#include <math.h>

/* ---- Numbers to try ---- */

static const double EXPONENTS[] = {0, 0.5, 1, 1.5, 2.5, 3, 4};
static const double FADE_DISTANCES[] = {1, 2, 4, 8, 16};
static const double SHININESS_FACTORS[] = {1 / 16., 1 / 8., 1 / 4., 1 / 2., 0.7, 0.85, 1.2, 1.4, 2, 4, 8, 16};
static const double AMBIENTS[] = {0, 0.25, 0.5, 0.75, 1.5, 2, 3, 5};
static const double LIGHT_FACTORS[] = {0, 0.1, 0.25, 0.5, 0.75, 1.25, 1.5, 2, 3, 5, 10};
static const double SHININESSES[] = {1, 2, 5, 10, 20, 40, 80, 160, 320};

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
    if (trait->choice == FALLOFF_POWER)
        hypothesis->light.exponent = number;
    else if (trait->grid != NULL)
        hypothesis->light.fadeDistance = number;
}

static void tellFalloff(const Trait *trait, double number, const Scene *scene, Text *text)
{
    (void)scene;
    switch ((FalloffMistake)trait->choice) {
    case FALLOFF_POVRAY:
        textAppend(text,
                   "the lights fall off by 2/(1 + (d/D)^2), as POV-Ray's fade_distance D does, with a D of ");
        textAppendRounded(text, number, 3);
        break;
    case FALLOFF_ONE_MORE:
        textAppend(text, "the lights fall off by 1/(1 + (d/D)^2), with a D of ");
        textAppendRounded(text, number, 3);
        break;
    case FALLOFF_LINEAR:
        textAppend(text, "the lights fall off by 1/(1 + d)");
        break;
    case FALLOFF_ALL_TERMS:
        textAppend(text, "the lights fall off by 1/(1 + d + d^2)");
        break;
    default:
        if (fabs(number) < 0.01) {
            textAppend(text, "falloff is missing: the lights are as strong at any distance");
            break;
        }
        textAppend(text, "the lights fall off by 1/d^");
        textAppendRounded(text, number, 3);
        break;
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
        textAppendRounded(text, (double)trait->group, 4);
        textAppend(text, ", the highlight is that of ");
        textAppendRounded(text, number, 3);
    } else if (trait->choice == SHININESS_IS) {
        textAppend(text, "all highlights are those of shininess ");
        textAppendRounded(text, number, 3);
    } else {
        textAppend(text, "the exponent of the highlights is ");
        textAppendRounded(text, number, 3);
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
    textAppendRounded(text, number, 3);
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
    textAppendRounded(text, number, 3);
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

/* ---- What the scene has ---- */

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

/* ---- The list, without the choices ---- */

static const char PHONG_FORMULA[] = "Ispec * Lc * max(0, dot(R, V))^shininess / d^2";
static const char NORMAL_FORMULA[] = "N is of unit length and points to the side the ray comes from";

static const Trait SHADOWS = {.cause = CAUSE_SHADOW,
                              .part = TRAIT_LIGHT,
                              .apply = applyShadows,
                              .tell = tellShadows,
                              .formula = "a light counts if nothing lies strictly between the point and it",
                              .key = "shadows"};
static const Trait FALLOFF = {.cause = CAUSE_FALLOFF,
                              .part = TRAIT_LIGHT,
                              .apply = applyFalloff,
                              .tell = tellFalloff,
                              .formula = "Ic * Lc * dot(N, L) / d^2",
                              .key = "falloff"};
static const Trait HIGHLIGHT = {.cause = CAUSE_SPECULAR,
                                .part = TRAIT_LIGHT,
                                .apply = applyHighlight,
                                .tell = tellHighlight,
                                .formula = PHONG_FORMULA,
                                .key = "specular"};
static const Trait OTHER_MODEL = {.cause = CAUSE_BLINN,
                                  .part = TRAIT_LIGHT,
                                  .apply = applyHighlight,
                                  .choice = HIGHLIGHT_OTHER_MODEL,
                                  .tell = tellHighlight,
                                  .formula = PHONG_FORMULA,
                                  .key = "model"};
static const Trait SHININESS = {.cause = CAUSE_SHININESS,
                                .part = TRAIT_LIGHT,
                                .apply = applyShininess,
                                GRID(SHININESSES),
                                .isLogarithmic = true,
                                .tell = tellShininess,
                                .formula = PHONG_FORMULA,
                                .key = "shininess"};
static const Trait NORMALS = {.cause = CAUSE_NORMALS,
                              .part = TRAIT_LIGHT,
                              .apply = applyNormals,
                              .tell = tellNormals,
                              .formula = NORMAL_FORMULA};
static const Trait FLAT_NORMALS = {.cause = CAUSE_NORMALS,
                                   .part = TRAIT_LIGHT,
                                   .apply = applyNormals,
                                   .choice = NORMALS_FLAT,
                                   .tell = tellNormals,
                                   .formula = "N is interpolated between the corners of a triangle",
                                   .key = "smooth"};
static const Trait NEGATIVE = {.cause = CAUSE_NEGATIVE_LIGHT,
                               .part = TRAIT_LIGHT,
                               .apply = applyNegative,
                               .tell = tellNegative,
                               .formula = "Ic * Lc * max(0, dot(N, L)) / d^2"};
static const Trait AMBIENT_SCALE = {.cause = CAUSE_AMBIENT,
                                    .part = TRAIT_LIGHT,
                                    .apply = applyAmbientScale,
                                    GRID(AMBIENTS),
                                    .tell = tellAmbientScale,
                                    .formula = "color = ambient * render.ambient + emission + ...",
                                    .key = "ambient"};
static const Trait LIGHT_SCALE = {.cause = CAUSE_EXPOSURE,
                                  .part = TRAIT_LIGHT,
                                  .apply = applyLightScale,
                                  GRID(LIGHT_FACTORS),
                                  .tell = tellLightScale,
                                  .formula = "Ic * Lc * dot(N, L) / d^2",
                                  .key = "color"};
static const Trait ACNE = {.cause = CAUSE_ACNE,
                           .part = TRAIT_ACNE,
                           .apply = applyAcne,
                           .tell = tellAcne,
                           .formula = "the shadow ray starts a little off the surface: offsetStart in "
                                      "src/raytracer.c",
                           .key = "shadow_bias"};

/* ---- The list ---- */

static void addShadowTraits(const Scene *scene, Traits *traits)
{
    if (!scene->render.shadows) {
        addChoice(traits, SHADOWS, SHADOWS_UNASKED);
        return;
    }
    addChoice(traits, SHADOWS, SHADOWS_NONE);
    addChoice(traits, SHADOWS, SHADOWS_TOO_LONG);
    Trait ofOne = SHADOWS;
    ofOne.key = "lights";
    for (size_t i = 0; i < scene->lightCount && i < 8 && scene->lightCount > 1; i++) {
        ofOne.other = (int)i + 1;
        addChoice(traits, ofOne, SHADOWS_AS_SCENE);
    }
}

static void addFalloffTraits(Traits *traits)
{
    Trait power = FALLOFF;
    power.grid = EXPONENTS;
    power.gridCount = (int)(sizeof EXPONENTS / sizeof *EXPONENTS);
    addChoice(traits, power, FALLOFF_POWER);
    Trait fading = FALLOFF;
    fading.grid = FADE_DISTANCES;
    fading.gridCount = (int)(sizeof FADE_DISTANCES / sizeof *FADE_DISTANCES);
    fading.isLogarithmic = true;
    addChoices(traits, fading, FALLOFF_POVRAY, FALLOFF_ONE_MORE);
    addChoices(traits, FALLOFF, FALLOFF_LINEAR, FALLOFF_ALL_TERMS);
}

static void addHighlightTraits(const Scene *scene, Traits *traits)
{
    addChoice(traits, HIGHLIGHT, HIGHLIGHT_NONE);
    addTrait(traits, OTHER_MODEL);
    addChoice(traits, HIGHLIGHT, HIGHLIGHT_NO_FALLOFF);
    addChoice(traits, HIGHLIGHT, HIGHLIGHT_DIFFUSE);
    float groups[6];
    size_t count = listShininesses(scene->objects, scene->objectCount, groups, 0, 6);
    for (size_t i = 0; i < count; i++) {
        Trait ofGroup = SHININESS;
        ofGroup.group = groups[i];
        addChoice(traits, ofGroup, count > 1 ? SHININESS_OF_ONE : SHININESS_IS);
    }
    if (count > 1) {
        Trait times = SHININESS;
        times.grid = SHININESS_FACTORS;
        times.gridCount = (int)(sizeof SHININESS_FACTORS / sizeof *SHININESS_FACTORS);
        addChoice(traits, times, SHININESS_TIMES);
        addChoice(traits, SHININESS, SHININESS_IS);
    }
}

/* What lies behind a surface, with and without shadows there. */
static void addFacingTraits(Traits *traits)
{
    for (int back = 0; back < 2; back++) {
        Trait normals = NORMALS, negative = NEGATIVE;
        normals.other = negative.other = back;
        addChoice(traits, normals, NORMALS_FLIPPED);
        addChoices(traits, negative, NEGATIVE_SUBTRACTS, NEGATIVE_HIGHLIGHT);
    }
    Trait normals = NORMALS;
    normals.other = 1;
    addChoice(traits, normals, NORMALS_NOT_TURNED);
    addTrait(traits, FLAT_NORMALS);
}

/* All lamps brighter or darker; of several also each alone. */
static void addLightScales(const Scene *scene, Traits *traits)
{
    size_t each = scene->lightCount > 1 && scene->lightCount <= 8 ? scene->lightCount : 0;
    for (size_t i = 0; i <= each && scene->lightCount > 0; i++) {
        Trait scale = LIGHT_SCALE;
        scale.other = (int)i;
        addTrait(traits, scale);
    }
}

void addLightTraits(const Scene *scene, Traits *traits)
{
    addShadowTraits(scene, traits);
    /* Flipped normals make some scenes black, as lights do that are missing, and are the likelier mistake. */
    addFacingTraits(traits);
    /* Before the falloff, of which some are much the same far from the lamps. */
    addLightScales(scene, traits);
    addFalloffTraits(traits);
    if (hasHighlights(scene->objects, scene->objectCount))
        addHighlightTraits(scene, traits);
    if (!colorIsBlack(scene->render.ambient))
        addTrait(traits, AMBIENT_SCALE);
    if (scene->lightCount > 0)
        addTrait(traits, ACNE);
}
