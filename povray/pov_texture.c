/* pov_texture.c - a material as POV-Ray's layers of texture; see pov_texture.h.
 *
 * A finish of POV-Ray has one number for each term and not a colour, and dims its terms in ways of its own.
 * So each term gets a layer. Of the layers on top of one another, an upper one lets through to the lower
 * ones its `transmit`, or its colour with `filter 1`; these multiply up to a colour F that all terms of the
 * layers below are multiplied by. From the top:
 *
 *     own light   2 E / F, half transparent, emission 1         F becomes F / 2
 *     diffuse     2 kd / F, half transparent, diffuse 1         F becomes F / 2
 *     filter      ks / F, filter 1                              F becomes ks
 *     highlight   phong 1; or specular 1 for Blinn's            F stays, or becomes kt with filter 1
 *     transparent kt / F, filter 1                              F becomes kt, which the refracted ray gets
 *
 * Only layers with something to say are written, and the last one is opaque unless the material is
 * transparent. Up to the filter F is a power of two, so no number is rounded. Mirrored rays are not
 * multiplied by F; their colour is in the top layer's finish.
 */
#include "povray/pov_texture.h"

#include "povray/pov_habits.h"

#include <math.h>

void textAppendPovColor(Text *pov, Color3f color, double factor)
{
    textAppend(pov, "rgb <");
    textAppendPovNumber(pov, (double)color.r * factor);
    textAppend(pov, ", ");
    textAppendPovNumber(pov, (double)color.g * factor);
    textAppend(pov, ", ");
    textAppendPovNumber(pov, (double)color.b * factor);
    textAppend(pov, ">");
}

void textAppendPovMatrix(Text *pov, const Matrix *matrix, double scale)
{
    const Vector3D rows[4] = {matrix->x, matrix->y, matrix->z, multVector(matrix->translate, scale)};
    textAppend(pov, "matrix <");
    for (int i = 0; i < 4; i++) {
        textAppend(pov, i > 0 ? ", " : "");
        textAppendPovNumber(pov, rows[i].x);
        textAppend(pov, ", ");
        textAppendPovNumber(pov, rows[i].y);
        textAppend(pov, ", ");
        textAppendPovNumber(pov, rows[i].z);
    }
    textAppend(pov, ">");
}

/* ---- Pigments ---- */

/* Append a file's name as a string of POV-Ray. */
static void appendString(Text *pov, const char *string)
{
    textAppend(pov, "\"");
    for (const char *c = string; *c != '\0'; c++) {
        if (*c == '"' || *c == '\\')
            textAppend(pov, "\\");
        textAppendBytes(pov, c, 1);
    }
    textAppend(pov, "\"");
}

/* One of the pattern's two colours as an entry of a pigment. */
static void appendEntry(Text *pov, const Pattern *pattern, int i, double factor, bool halfTransparent)
{
    textAppendPovColor(pov, pattern->colors[i], factor);
    if (halfTransparent)
        textAppend(pov, " transmit 0.5");
}

/* The word or vector for the pattern's axis. */
static void appendGradient(Text *pov, const Pattern *pattern)
{
    textAppend(pov, "gradient ");
    textAppendPovVector(pov, pattern->axis, 1);
}

/* POV-Ray's gradient repeats with a period of 1.00001 at negative coordinates, so it is moved by whole
 * periods until no point of the object has one: not farther than needed, since each doubling costs a bit. */
static void appendShift(Text *pov, const Pattern *pattern, double extent)
{
    double periods = 1024;
    double largest = 2 * extent / pattern->size;
    if (pattern->hasTransform)
        largest = largest * matrixNorm(&pattern->transform.objectFromWorld) +
                  largestCoordinate(pattern->transform.objectFromWorld.translate) / pattern->size;
    while (periods < largest && periods < 0x1p36)
        periods *= 2;
    textAppend(pov, " translate ");
    textAppendPovVector(pov, pattern->axis, -periods);
}

static void appendPattern(Text *pov, const Pattern *pattern, double factor, bool halfTransparent,
                          double scale, double extent)
{
    switch (pattern->kind) {
    case PATTERN_CHECKER:
        textAppend(pov, "checker ");
        appendEntry(pov, pattern, 0, factor, halfTransparent);
        textAppend(pov, ", ");
        appendEntry(pov, pattern, 1, factor, halfTransparent);
        break;
    case PATTERN_STRIPES:
    case PATTERN_GRADIENT:
        appendGradient(pov, pattern);
        textAppend(pov, pattern->kind == PATTERN_STRIPES ? " color_map { [0.5 " : " color_map { [0 ");
        appendEntry(pov, pattern, 0, factor, halfTransparent);
        textAppend(pov, pattern->kind == PATTERN_STRIPES ? "] [0.5 " : "] [1 ");
        appendEntry(pov, pattern, 1, factor, halfTransparent);
        textAppend(pov, "] }");
        appendShift(pov, pattern, extent);
        break;
    case PATTERN_IMAGE:
        textAppend(pov, "image_map { png ");
        appendString(pov, pattern->path);
        textAppendFormat(pov, " gamma %s map_type %d", pattern->isLinear ? "1.0" : "srgb",
                         pattern->mapping == MAPPING_SPHERICAL);
        textAppend(pov, halfTransparent ? " transmit all 0.5 }" : " }");
        /* POV-Ray's spherical map runs the other way round. */
        if (pattern->mapping == MAPPING_SPHERICAL)
            textAppend(pov, " scale <-1, 1, 1>");
        break;
    }
    textAppend(pov, " scale ");
    textAppendPovNumber(pov, pattern->size * scale);
    if (pattern->hasTransform) {
        textAppend(pov, " ");
        textAppendPovMatrix(pov, &pattern->transform.worldFromObject, scale);
    }
}

/* The diffuse colour, times factor. An image cannot be multiplied, so its factor goes to the finish. */
static void appendDiffusePigment(Text *pov, const Material *material, double factor, bool halfTransparent,
                                 double scale, double extent)
{
    textAppend(pov, "pigment { ");
    if (material->pattern != NULL) {
        appendPattern(pov, material->pattern, factor, halfTransparent, scale, extent);
    } else {
        textAppendPovColor(pov, material->diffuse, factor);
        if (halfTransparent)
            textAppend(pov, " transmit 0.5");
    }
    textAppend(pov, " }");
}

static bool isImage(const Material *material)
{
    return material->pattern != NULL && material->pattern->kind == PATTERN_IMAGE;
}

/* ---- Layers ---- */

enum {
    MAX_LAYERS = 5
};

typedef struct Layers {
    Text texts[MAX_LAYERS]; /* the inside of each texture { }, from the top */
    int count;
} Layers;

static Text *addLayer(Layers *layers)
{
    return &layers->texts[layers->count++];
}

/* Where a channel of ks is 0, what lies below could not be given back its colour; with so small a number it
 * can, and the highlight is as good as 0. */
static const float TINY_SPECULAR = 0x1p-60f;

static Color3f divideColors(Color3f a, Color3f b)
{
    return createColor(a.r / b.r, a.g / b.g, a.b / b.b);
}

/* What a material is by these habits. */
typedef struct Terms {
    Color3f own, ks, kt;     /* its own light, the highlight's colour, what goes through */
    bool isPhong;            /* the highlight is Phong's, not Blinn's */
    double ambient, diffuse; /* shares of the diffuse colour */
} Terms;

static Terms termsByHabits(const Scene *scene, const Material *material, unsigned habits)
{
    ShadingModel model = materialModel(scene, material);
    Terms terms = {.own = material->emission,
                   .kt = material->transmission,
                   .isPhong = (model == MODEL_PHONG) != ((habits & POV_HABIT_HIGHLIGHT) != 0),
                   .ambient = (habits & POV_HABIT_AMBIENT) != 0 ? 0.1 : 0,
                   .diffuse = (habits & POV_HABIT_DIFFUSE) != 0 ? 0.6 : 1};
    if ((habits & POV_HABIT_AMBIENT) == 0)
        terms.own = addColors(multColors(material->ambient, scene->render.ambient), material->emission);
    if (model >= MODEL_PHONG)
        terms.ks = material->specular;
    if ((habits & POV_HABIT_HIGHLIGHT_COLOR) != 0) {
        float mean = (terms.ks.r + terms.ks.g + terms.ks.b) / 3;
        terms.ks = createColor(mean, mean, mean);
    }
    return terms;
}

/* The shares of the diffuse colour that are not the default of the file, each times factor. */
static void appendShares(Text *layer, const Terms *terms, double factor)
{
    if (terms->ambient != 0) {
        textAppend(layer, "ambient ");
        textAppendPovNumber(layer, terms->ambient * factor);
        textAppend(layer, " ");
    }
    if (terms->diffuse * factor != 1) {
        textAppend(layer, "diffuse ");
        textAppendPovNumber(layer, terms->diffuse * factor);
        textAppend(layer, " ");
    }
}

static void appendHighlight(Text *layer, const Terms *terms, double strength, double shininess)
{
    textAppend(layer, terms->isPhong ? "phong " : "specular ");
    textAppendPovNumber(layer, strength);
    textAppend(layer, terms->isPhong ? " phong_size " : " roughness 1/");
    textAppendPovNumber(layer, shininess);
    textAppend(layer, " ");
}

static void appendReflection(Text *layer, const Material *material)
{
    if (colorIsBlack(material->reflection))
        return;
    textAppend(layer, "reflection { ");
    textAppendPovColor(layer, material->reflection, 1);
    textAppend(layer, " } ");
}

/* Whether one finish says it all, as it is written by hand: with the default finish's numbers, and a
 * highlight of one number. */
static bool fitsOneFinish(const Terms *terms, unsigned habits)
{
    return (habits & POV_HABIT_AMBIENT) != 0 && (habits & POV_HABIT_DIFFUSE) != 0 &&
           colorIsBlack(terms->own) && colorIsBlack(terms->kt) && terms->ks.r == terms->ks.g &&
           terms->ks.g == terms->ks.b;
}

static void appendOneFinish(Text *pov, const Material *material, const Terms *terms, double scale,
                            double extent)
{
    textAppend(pov, "texture { ");
    appendDiffusePigment(pov, material, 1, false, scale, extent);
    textAppend(pov, " finish { ");
    appendShares(pov, terms, 1);
    if (!colorIsBlack(terms->ks))
        appendHighlight(pov, terms, (double)terms->ks.r, (double)material->shininess);
    appendReflection(pov, material);
    textAppend(pov, "} }");
}

static Layers reflectionLayers(const Material *material, const Terms *terms, double scale, double extent)
{
    Layers layers = {.count = 0};
    Color3f own = terms->own, ks = terms->ks;
    Color3f kt = terms->kt;
    bool highlight = !colorIsBlack(ks), transparent = !colorIsBlack(kt);
    bool hasDiffuse = material->pattern != NULL || !colorIsBlack(material->diffuse);
    double f = 1;

    if (!colorIsBlack(own)) {
        Text *layer = addLayer(&layers);
        textAppend(layer, "pigment { ");
        textAppendPovColor(layer, own, 2 / f);
        textAppend(layer, " transmit 0.5 } finish { diffuse 0 emission 1 ");
        f /= 2;
    }
    bool seeThrough = highlight || transparent;
    if (hasDiffuse || !seeThrough) {
        Text *layer = addLayer(&layers);
        double factor = seeThrough ? 2 / f : 1 / f;
        double inPigment = isImage(material) ? 1 : factor;
        appendDiffusePigment(layer, material, inPigment, seeThrough, scale, extent);
        textAppend(layer, " finish { ");
        appendShares(layer, terms, isImage(material) ? factor : 1);
        f = seeThrough ? f / 2 : f;
    }
    if (highlight) {
        if (transparent)
            ks = createColor(fmaxf(ks.r, TINY_SPECULAR), fmaxf(ks.g, TINY_SPECULAR),
                             fmaxf(ks.b, TINY_SPECULAR));
        Text *filter = addLayer(&layers);
        textAppend(filter, "pigment { ");
        textAppendPovColor(filter, ks, 1 / f);
        textAppend(filter, " filter 1 } finish { diffuse 0 ");
        Text *layer = addLayer(&layers);
        textAppend(layer, "pigment { ");
        textAppendPovColor(layer, transparent ? divideColors(kt, ks) : createColor(0, 0, 0), 1);
        textAppend(layer, transparent ? " filter 1 } finish { diffuse 0 " : " } finish { diffuse 0 ");
        appendHighlight(layer, terms, 1, (double)material->shininess);
    } else if (transparent) {
        Text *layer = addLayer(&layers);
        textAppend(layer, "pigment { ");
        textAppendPovColor(layer, kt, 1 / f);
        textAppend(layer, " filter 1 } finish { diffuse 0 ");
    }

    appendReflection(&layers.texts[0], material);
    for (int i = 0; i < layers.count; i++)
        textAppend(&layers.texts[i], "}");
    return layers;
}

void textAppendPovTexture(Text *pov, const Scene *scene, const Material *material, PovFinish finish,
                          unsigned habits, double scale, double extent)
{
    if (finish != FINISH_REFLECTION) {
        appendDiffusePigment(pov, material, 1, false, scale, extent);
        textAppend(pov,
                   finish == FINISH_UNLIT ? " finish { diffuse 0 emission 1 }" : " finish { brilliance 0 }");
        return;
    }
    Terms terms = termsByHabits(scene, material, habits);
    if (fitsOneFinish(&terms, habits)) {
        appendOneFinish(pov, material, &terms, scale, extent);
        return;
    }
    Layers layers = reflectionLayers(material, &terms, scale, extent);
    for (int i = layers.count - 1; i >= 0; i--) {
        textAppend(pov, "texture { ");
        textAppend(pov, textString(&layers.texts[i]));
        textAppend(pov, i > 0 ? " }\n  " : " }");
        pov->failed |= layers.texts[i].failed;
        textFree(&layers.texts[i]);
    }
}
