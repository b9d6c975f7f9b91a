/* light_traits.c - the mistakes in how light is computed, with what is said of them; see hypothesis.h. */
#include "explain/trait_list.h"

#include <math.h>

/* ---- Numbers to try ---- */

static const double EXPONENTS[] = {0, 0.5, 1, 1.5, 2.5, 3, 4};
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
        textAppendRounded(text, number, 3);
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

/* ---- The list ---- */

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

void addLightTraits(const Scene *scene, Traits *traits)
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
