/* part_colors.c - the colours of lamps and materials that a picture would need; see part_search.h. */
#include "explain/part_fit.h"
#include "explain/part_search.h"

#include <math.h>

/* The colours of a scene's part that are fitted together. */
typedef struct Palette {
    int count;
    Prediction terms[MOST_FITTED]; /* what 1 more of each colour gives */
    float colors[MOST_FITTED][3];  /* as the scene has them */
    /* Give the change these colours. */
    void (*apply)(const struct Palette *palette, float colors[][3], PartChange *change);
    const bool *isUsed; /* of each colour; NULL: all are */
    const PartChange *target;
    const Scene *scene;
} Palette;

static void freePalette(Palette *palette)
{
    for (int i = 0; i < palette->count; i++)
        freePrediction(&palette->terms[i]);
    palette->count = 0;
}

/* Predict what the next colour of the palette gives, with 1 more of it. */
static void addTerm(PartSearch *search, Palette *palette, const PartChange *more, Color3f color)
{
    if (!statusIsOk(&search->status))
        return;
    search->status = predictPart(search->truth, search->evidence, more, &palette->terms[palette->count]);
    if (!statusIsOk(&search->status))
        return;
    float *channels = palette->colors[palette->count++];
    channels[0] = color.r;
    channels[1] = color.g;
    channels[2] = color.b;
}

static Color3f oneMore(Color3f color)
{
    return addColors(color, createColor(1, 1, 1));
}

/* How far off the colours would be, without tracing: a picture is linear in them. */
static double measureColors(const PartSearch *search, const Palette *palette, const Prediction *before,
                            float colors[][3])
{
    Prediction sum;
    Status status = createPrediction(before->count, 1, &sum);
    if (!statusIsOk(&status))
        return INFINITY;
    for (size_t p = 0; p < before->count; p++) {
        sum.places[p] = before->places[p];
        for (size_t c = 0; c < 3; c++) {
            size_t at = 3 * p + c;
            float v = before->low[0][at];
            for (int i = 0; i < palette->count; i++)
                v += (colors[i][c] - palette->colors[i][c]) *
                     (palette->terms[i].low[0][at] - before->low[0][at]);
            sum.low[0][at] = sum.high[0][at] = sum.middle[at] = v;
        }
    }
    ValueChange neutral = neutralValueChange();
    double left = measureMisfit(search->evidence, &sum, &neutral, 1, INFINITY).rmse;
    freePrediction(&sum);
    return left;
}

/* Colours with so many digits behind the point; those that are the scene's stay as they are. */
static void roundColors(const Palette *palette, int digits, float exact[][3], float rounded[][3])
{
    double unit = pow(10, digits);
    for (int i = 0; i < palette->count; i++)
        for (int c = 0; c < 3; c++)
            rounded[i][c] = exact[i][c] == palette->colors[i][c]
                                ? exact[i][c]
                                : (float)(round((double)exact[i][c] * unit) / unit);
}

/* Fit the palette's colours; before: the prediction that they are added to. Where they explain enough, try
 * the change with the fewest digits that fit as well. */
static void tryPalette(PartSearch *search, const Palette *palette, const Prediction *before, double share)
{
    if (!statusIsOk(&search->status) || palette->count == 0)
        return;
    float added[MOST_FITTED][3], exact[MOST_FITTED][3], rounded[MOST_FITTED][3];
    bool isSeen[MOST_FITTED][3], isChanged = false;
    fitColors(search->evidence, before, palette->terms, palette->count, added, isSeen);
    for (int i = 0; i < palette->count; i++)
        for (int c = 0; c < 3; c++) {
            exact[i][c] = fmaxf(palette->colors[i][c] + added[i][c], 0);
            isChanged = isChanged || isSeen[i][c];
        }
    double left = measureColors(search, palette, before, exact);
    if (!isChanged || !(left < share * search->before))
        return;
    int digits = 1;
    for (; digits <= 4; digits++) {
        roundColors(palette, digits, exact, rounded);
        if (measureColors(search, palette, before, rounded) <= 1.02 * left + 0.05 * search->rounding)
            break;
    }
    PartChange change = *palette->target;
    palette->apply(palette, rounded, &change);
    tryPart(search, &change, share);
}

/* ---- Lamps ---- */

static void applyLamp(const Palette *palette, float colors[][3], PartChange *change)
{
    (void)palette;
    change->lamp.color = createColor(colors[0][0], colors[0][1], colors[0][2]);
}

static void applyAllLamps(const Palette *palette, float colors[][3], PartChange *change)
{
    for (int i = 0; i < palette->count; i++)
        change->lampColors[i] = createColor(colors[i][0], colors[i][1], colors[i][2]);
}

void tryLampColors(PartSearch *search)
{
    const Scene *scene = search->truth->scene;
    if (scene->lightCount == 0 || scene->lightCount > MOST_LAMPS)
        return;
    Palette all = {.apply = applyAllLamps, .scene = scene};
    for (size_t i = 0; i < scene->lightCount; i++) {
        PartChange more = {.kind = PART_LAMP, .number = i, .lamp = scene->lights[i]};
        more.lamp.color = oneMore(more.lamp.color);
        addTerm(search, &all, &more, scene->lights[i].color);
    }
    for (int i = 0; i < all.count && statusIsOk(&search->status); i++) {
        Palette one = {.count = 1, .terms = {all.terms[i]}, .apply = applyLamp, .scene = scene};
        for (int c = 0; c < 3; c++)
            one.colors[0][c] = all.colors[i][c];
        PartChange target = {.kind = PART_LAMP, .number = (size_t)i, .lamp = scene->lights[i]};
        one.target = &target;
        tryPalette(search, &one, &search->right, PART_SHARE);
    }
    PartChange together = {.kind = PART_ALL_LAMPS};
    all.target = &together;
    if (all.count > 1 && !isPartExact(search))
        tryPalette(search, &all, &search->right, FITTED_PART_SHARE);
    freePalette(&all);
}

/* ---- The background ---- */

static void applyBackground(const Palette *palette, float colors[][3], PartChange *change)
{
    change->background = palette->scene->background;
    change->background.bottom = createColor(colors[0][0], colors[0][1], colors[0][2]);
    if (palette->count > 1)
        change->background.top = createColor(colors[1][0], colors[1][1], colors[1][2]);
}

void tryBackground(PartSearch *search)
{
    const Scene *scene = search->truth->scene;
    PartChange change = {.kind = PART_BACKGROUND, .background = scene->background}, more = change;
    Palette palette = {.apply = applyBackground, .scene = scene, .target = &change};
    more.background.bottom = oneMore(scene->background.bottom);
    addTerm(search, &palette, &more, scene->background.bottom);
    if (scene->background.isGradient) {
        more = change;
        more.background.top = oneMore(scene->background.top);
        addTerm(search, &palette, &more, scene->background.top);
    }
    tryPalette(search, &palette, &search->right, PART_SHARE);
    freePalette(&palette);
}

/* ---- Materials ---- */

typedef enum MaterialColor {
    COLOR_DIFFUSE,
    COLOR_SPECULAR,
    COLOR_OWN, /* the light that it sends out in any case: of emission and ambient light */
    MATERIAL_COLORS
} MaterialColor;

static Color3f ownLight(const Scene *scene, const Material *material)
{
    return addColors(material->emission, multColors(material->ambient, scene->render.ambient));
}

static void setColor(Material *material, MaterialColor which, Color3f color)
{
    switch (which) {
    case COLOR_DIFFUSE:
        material->diffuse = color;
        break;
    case COLOR_SPECULAR:
        material->specular = color;
        break;
    default:
        material->emission = color;
        material->ambient = createColor(0, 0, 0);
        break;
    }
}

static Color3f colorOf(const Scene *scene, const Material *material, MaterialColor which)
{
    return which == COLOR_DIFFUSE    ? material->diffuse
           : which == COLOR_SPECULAR ? material->specular
                                     : ownLight(scene, material);
}

/* Which colours of the material are fitted together. */
typedef struct ColorSet {
    bool isUsed[MATERIAL_COLORS];
} ColorSet;

static void applyMaterial(const Palette *palette, float colors[][3], PartChange *change)
{
    change->material = palette->target->material;
    for (int i = 0, k = 0; i < MATERIAL_COLORS; i++) {
        if (!palette->isUsed[i])
            continue;
        setColor(&change->material, (MaterialColor)i, createColor(colors[k][0], colors[k][1], colors[k][2]));
        k++;
    }
}

/* Whether the colour does anything with the material's model. */
static bool isColorShown(const Scene *scene, const Material *material, MaterialColor which)
{
    ShadingModel model = materialModel(scene, material);
    return which == COLOR_DIFFUSE || (which == COLOR_SPECULAR ? model >= MODEL_PHONG : model != MODEL_SIMPLE);
}

static void trySets(PartSearch *search, const PartChange *target, const Prediction *before,
                    const Prediction terms[MATERIAL_COLORS], const bool *isMade)
{
    static const ColorSet SETS[] = {{{true, false, false}},
                                    {{false, true, false}},
                                    {{false, false, true}},
                                    {{true, true, false}},
                                    {{true, false, true}}};
    const Scene *scene = search->truth->scene;
    for (size_t s = 0; s < sizeof SETS / sizeof *SETS && !isPartExact(search); s++) {
        Palette palette = {
            .apply = applyMaterial, .isUsed = SETS[s].isUsed, .target = target, .scene = scene};
        bool isPossible = true;
        for (int i = 0; i < MATERIAL_COLORS; i++) {
            if (!SETS[s].isUsed[i])
                continue;
            isPossible = isPossible && isMade[i];
            Color3f color = colorOf(scene, &target->material, (MaterialColor)i);
            float *channels = palette.colors[palette.count];
            channels[0] = color.r;
            channels[1] = color.g;
            channels[2] = color.b;
            palette.terms[palette.count++] = terms[i];
        }
        if (isPossible)
            tryPalette(search, &palette, before, palette.count > 1 ? FITTED_PART_SHARE : PART_SHARE);
    }
}

/* Fit the colours of target->material, which the scene has, or one that is drawn first: before. */
static void tryColorsFrom(PartSearch *search, const PartChange *target, const Prediction *before, bool all)
{
    const Scene *scene = search->truth->scene;
    Palette made = {.count = 0};
    Prediction terms[MATERIAL_COLORS];
    bool isMade[MATERIAL_COLORS] = {false, false, false};
    for (int i = 0; i < (all ? MATERIAL_COLORS : 1) && statusIsOk(&search->status); i++) {
        if (!isColorShown(scene, &target->material, (MaterialColor)i))
            continue;
        PartChange more = *target;
        Color3f color = colorOf(scene, &target->material, (MaterialColor)i);
        setColor(&more.material, (MaterialColor)i, oneMore(color));
        addTerm(search, &made, &more, color);
        isMade[i] = statusIsOk(&search->status);
        if (isMade[i])
            terms[i] = made.terms[made.count - 1];
    }
    if (statusIsOk(&search->status))
        trySets(search, target, before, terms, isMade);
    freePalette(&made);
}

void tryMaterialColors(PartSearch *search, const PartChange *target)
{
    PartChange change = *target;
    change.kind = PART_MATERIAL;
    change.material = *target->ofMaterial;
    if (change.material.pattern == NULL) {
        tryColorsFrom(search, &change, &search->right, true);
        return;
    }
    /* One colour in place of the pattern. */
    change.material.pattern = NULL;
    change.material.diffuse = createColor(0, 0, 0);
    Prediction plain;
    if (!statusIsOk(&search->status))
        return;
    search->status = predictPart(search->truth, search->evidence, &change, &plain);
    if (!statusIsOk(&search->status))
        return;
    tryColorsFrom(search, &change, &plain, false);
    freePrediction(&plain);
}
