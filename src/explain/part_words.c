/* part_words.c - see part_words.h. */
#include "explain/part_words.h"

#include "explain/pixel_story.h"
#include "explain/scene_lines.h"

#include <math.h>

enum {
    DIGITS = 3,
    MOST_OWNERS = 3 /* that are named */
};

/* Objects with less of the differing pixels than this are not named. */
static const double NAMED_SHARE = 0.05;

/* ---- Names and numbers ---- */

/* The part of a solid that has the material, or the object itself. */
static const Object *findPartOf(const Object *object, const Material *material)
{
    if (object->kind != SHAPE_CSG)
        return sameMaterial(&object->material, material) ? object : NULL;
    for (size_t i = 0; i < object->csg.partCount; i++) {
        const Object *part = findPartOf(&object->csg.parts[i], material);
        if (part != NULL)
            return part;
    }
    return NULL;
}

/* The object that is meant; of a whole material the first one in the scene. */
static const Object *objectOf(const PartChange *change, const Scene *scene)
{
    for (size_t i = 0; change->wholeMaterial && i < scene->objectCount; i++)
        if (findPartOf(&scene->objects[i], change->ofMaterial) != NULL)
            return &scene->objects[i];
    return &scene->objects[change->number];
}

static const Object *partOf(const PartChange *change, const Scene *scene)
{
    const Object *object = objectOf(change, scene);
    bool isOfMaterial = change->kind == PART_FORMULA || change->kind == PART_MATERIAL;
    const Object *part = isOfMaterial ? findPartOf(object, change->ofMaterial) : NULL;
    return part != NULL ? part : object;
}

/* "the sphere of line 11", and how many others have its material where they are meant too. */
static void appendTarget(const PartChange *change, const Scene *scene, Text *text)
{
    appendObjectName(scene, objectOf(change, scene), partOf(change, scene), text);
    size_t others = change->wholeMaterial ? countOfMaterial(scene, change->ofMaterial) - 1 : 0;
    if (others == 1)
        textAppend(text, " and the other object of its material");
    else if (others > 1)
        textAppendFormat(text, " and the other %zu objects of its material", others);
}

static int lampLine(const SceneSource *source, size_t number)
{
    return source != NULL && source->text != NULL ? findItemLine(source->text, "lights", number) : 0;
}

static void appendLamp(const SceneSource *source, size_t number, Text *text)
{
    textAppendFormat(text, "light %zu", number + 1);
    int line = lampLine(source, number);
    if (line > 0)
        textAppendFormat(text, " (line %d)", line);
}

static void appendTriple(Text *text, double x, double y, double z)
{
    const double numbers[3] = {x, y, z};
    for (int i = 0; i < 3; i++) {
        textAppend(text, i == 0 ? "[" : ", ");
        textAppendRounded(text, fabs(numbers[i]) < 1e-6 ? 0 : numbers[i], DIGITS);
    }
    textAppend(text, "]");
}

static void appendColor(Text *text, Color3f color)
{
    appendTriple(text, (double)color.r, (double)color.g, (double)color.b);
}

static void appendPercent(Text *text, double share)
{
    textAppendRounded(text, 100 * share, share < 0.1 ? 1 : 2);
    textAppend(text, " %");
}

static bool sameColors(Color3f a, Color3f b)
{
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

/* ---- What is said of objects ---- */

static void tellFormula(const PartChange *change, const Scene *scene, Text *text)
{
    const LightChange *light = &change->light;
    const char *opening = "", *rest = "";
    if (light->shadows == SHADOWS_NONE) {
        opening = "no shadow falls on ";
        rest = ": nothing blocks the light there, and elsewhere the shadows are right";
    } else if (light->shadows == SHADOWS_UNASKED) {
        opening = "shadows fall on ";
        rest = ", and the scene says shadows: false";
    } else if (light->ambientScale == 0) {
        opening = "the ambient term is missing on ";
    } else if (light->highlight == HIGHLIGHT_NONE) {
        opening = "the highlight is missing on ";
        rest = "; the others are there";
    } else if (light->highlight == HIGHLIGHT_OTHER_MODEL) {
        bool blinn = materialModel(scene, change->ofMaterial) == MODEL_BLINN_PHONG;
        opening = blinn ? "the highlight is Phong's, (R.V)^shininess, where the scene asks for Blinn's, "
                          "(N.H)^shininess, on "
                        : "the highlight is Blinn's, (N.H)^shininess, where the scene asks for Phong's, "
                          "(R.V)^shininess, on ";
    } else if (light->highlight == HIGHLIGHT_DIFFUSE) {
        opening = "the highlight has the diffuse colour on ";
        rest = ": Ispec is multiplied by Ic";
    } else if (light->normals == NORMALS_FLIPPED) {
        opening = "the normals point into ";
        rest = ", so what faces a light is dark";
    } else if (light->normals == NORMALS_NOT_TURNED) {
        opening = "the normals are not turned to the side that is seen on ";
        rest = ", which is lit from the other side";
    } else if (light->normals == NORMALS_FLAT) {
        opening = "the normals are those of the triangles on ";
        rest = ", and the scene's are interpolated (smooth)";
    } else if (light->negative != NEGATIVE_AS_SCENE) {
        opening = light->negative == NEGATIVE_ABSOLUTE
                      ? "the absolute value of dot(N, L) is taken on "
                      : "dot(N, L) is not clamped at 0, so lights behind the surface take light away, on ";
    } else {
        textAppend(text, "the highlight is that of shininess ");
        textAppendRounded(text, light->shininessValue, DIGITS);
        textAppend(text, " where the scene says ");
        textAppendRounded(text, (double)change->ofMaterial->shininess, 4);
        opening = ", on ";
    }
    textAppend(text, opening);
    appendTarget(change, scene, text);
    textAppend(text, rest);
}

static void tellColor(const char *name, Color3f found, Color3f asked, bool *isFirst, Text *text)
{
    if (sameColors(found, asked))
        return;
    textAppend(text, *isFirst ? " had " : " and ");
    textAppend(text, name);
    textAppend(text, " about ");
    appendColor(text, found);
    textAppend(text, " where the scene says ");
    appendColor(text, asked);
    *isFirst = false;
}

static void tellMaterial(const PartChange *change, const Scene *scene, Text *text)
{
    const Material *found = &change->material, *asked = change->ofMaterial;
    if (!sameColors(found->reflection, asked->reflection)) {
        textAppend(text, "it is as if nothing were mirrored in ");
        appendTarget(change, scene, text);
        return;
    }
    if (!sameColors(found->transmission, asked->transmission)) {
        textAppend(text, "it is as if no light went through ");
        appendTarget(change, scene, text);
        return;
    }
    textAppend(text, "it is as if ");
    appendTarget(change, scene, text);
    bool isFirst = true;
    if (asked->pattern != NULL && found->pattern == NULL) {
        textAppend(text, " had one colour, about ");
        appendColor(text, found->diffuse);
        textAppend(text, ", where the scene has a pattern");
        return;
    }
    Color3f askedOwn = addColors(asked->emission, multColors(asked->ambient, scene->render.ambient));
    Color3f own = addColors(found->emission, multColors(found->ambient, scene->render.ambient));
    tellColor("diffuse", found->diffuse, asked->diffuse, &isFirst, text);
    tellColor("specular", found->specular, asked->specular, &isFirst, text);
    tellColor("a light of its own, ambient and emission, of", own, askedOwn, &isFirst, text);
}

/* Where a sphere or a cube would be; of other objects, by how much it is moved. */
static void tellPlace(const PartChange *change, const Scene *scene, Text *text)
{
    const Object *object = objectOf(change, scene);
    bool isMoved = norm(change->offset) > 0, isScaled = change->scale != 1;
    textAppend(text, "it is as if ");
    appendTarget(change, scene, text);
    if (isMoved) {
        textAppend(text, " were moved by about ");
        appendTriple(text, change->offset.x, change->offset.y, change->offset.z);
    }
    if (isScaled) {
        textAppend(text, isMoved ? " and " : " were ");
        textAppendRounded(text, change->scale, DIGITS);
        textAppend(text, " times as large");
    }
    if (object->transform != NULL || (object->kind != SHAPE_SPHERE && object->kind != SHAPE_CUBE))
        return;
    Vector3D center = object->kind == SHAPE_SPHERE ? object->sphere.center : object->cube.center;
    center = addVectors(center, change->offset);
    textAppend(text, ": ");
    if (isMoved) {
        textAppend(text, "center ");
        appendTriple(text, center.x, center.y, center.z);
    }
    if (isScaled) {
        textAppend(text, isMoved ? ", " : "");
        textAppend(text, object->kind == SHAPE_SPHERE ? "radius " : "size ");
        textAppendRounded(
            text, change->scale * (object->kind == SHAPE_SPHERE ? object->sphere.radius : object->cube.size),
            DIGITS);
    }
}

/* ---- What is said of lamps ---- */

/* Whether found is k times asked in all channels, to a hundredth. */
static bool isMultiple(Color3f found, Color3f asked, double *k)
{
    const double a[3] = {(double)found.r, (double)found.g, (double)found.b};
    const double b[3] = {(double)asked.r, (double)asked.g, (double)asked.b};
    double most = fmax(b[0], fmax(b[1], b[2]));
    if (!(most > 0))
        return false;
    *k = b[0] == most ? a[0] / b[0] : b[1] == most ? a[1] / b[1] : a[2] / b[2];
    for (int c = 0; c < 3; c++)
        if (fabs(a[c] - *k * b[c]) > 0.01 * fmax(*k, 0.1) * most)
            return false;
    return true;
}

static void tellLampColor(const SceneSource *source, size_t number, Color3f found, Color3f asked, Text *text)
{
    double k;
    appendLamp(source, number, text);
    if (colorIsBlack(found)) {
        textAppend(text, " is off");
    } else if (isMultiple(found, asked, &k)) {
        textAppend(text, " is ");
        textAppendRounded(text, k, DIGITS);
        textAppend(text, " times as bright as it should be");
    } else {
        textAppend(text, " has about the color ");
        appendColor(text, found);
        textAppend(text, " where the scene says ");
        appendColor(text, asked);
    }
}

static bool isMoved(const Light *found, const Light *asked)
{
    return norm(subVectors(found->position, asked->position)) > 0;
}

static void tellLamp(const PartChange *change, const Light *asked, const SceneSource *source, Text *text)
{
    const Light *found = &change->lamp;
    if (found->falloff != asked->falloff) {
        appendLamp(source, change->number, text);
        textAppend(text, found->falloff == FALLOFF_NONE
                             ? " is as strong at any distance: its falloff is missing"
                             : " falls off by 1/d^2, and the scene says falloff: none");
    } else if (isMoved(found, asked)) {
        appendLamp(source, change->number, text);
        textAppend(text, " shines from about ");
        appendTriple(text, found->position.x, found->position.y, found->position.z);
        textAppend(text, " where the scene says ");
        appendTriple(text, asked->position.x, asked->position.y, asked->position.z);
    } else {
        tellLampColor(source, change->number, found->color, asked->color, text);
    }
}

static void tellLamps(const PartChange *change, const Scene *scene, const SceneSource *source, Text *text)
{
    bool isFirst = true;
    for (size_t i = 0; i < scene->lightCount && i < MOST_LAMPS; i++) {
        double k;
        Color3f found = change->lampColors[i], asked = scene->lights[i].color;
        if (sameColors(found, asked) || (isMultiple(found, asked, &k) && fabs(k - 1) < 0.005))
            continue;
        textAppend(text, isFirst ? "" : "; ");
        tellLampColor(source, i, found, asked, text);
        isFirst = false;
    }
}

static void tellBackground(const Background *found, const Background *asked, Text *text)
{
    bool isFirst = true;
    textAppend(text, "it is as if the background");
    if (!asked->isGradient) {
        textAppend(text, " were about ");
        appendColor(text, found->bottom);
        textAppend(text, " where the scene says ");
        appendColor(text, asked->bottom);
        return;
    }
    tellColor("the bottom", found->bottom, asked->bottom, &isFirst, text);
    tellColor("the top", found->top, asked->top, &isFirst, text);
}

static void tellSettings(const RenderSettings *found, const RenderSettings *asked, Text *text)
{
    bool isSamples = found->samples != asked->samples;
    textAppendFormat(text, "it is as if %s were %d where the scene has %d",
                     isSamples ? "samples" : "max_depth", isSamples ? found->samples : found->maxDepth,
                     isSamples ? asked->samples : asked->maxDepth);
}

/* ---- The whole of it ---- */

static void tellChange(const PartChange *change, const Scene *scene, const SceneSource *source, Text *text)
{
    switch (change->kind) {
    case PART_GONE:
        textAppend(text, "it is as if ");
        appendTarget(change, scene, text);
        textAppend(text, " were not there");
        break;
    case PART_SHADOW:
        appendTarget(change, scene, text);
        textAppend(text, objectOf(change, scene)->noShadow
                             ? " throws a shadow, and the scene says casts_shadow: false"
                             : " throws no shadow; those of the other objects are right");
        break;
    case PART_FORMULA:
        tellFormula(change, scene, text);
        break;
    case PART_MATERIAL:
        tellMaterial(change, scene, text);
        break;
    case PART_PLACE:
        tellPlace(change, scene, text);
        break;
    case PART_ALL_LAMPS:
        tellLamps(change, scene, source, text);
        break;
    case PART_BACKGROUND:
        tellBackground(&change->background, &scene->background, text);
        break;
    case PART_SETTINGS:
        tellSettings(&change->render, &scene->render, text);
        break;
    case PART_LAMP:
        tellLamp(change, &scene->lights[change->number], source, text);
        break;
    }
}

static Cause causeOfFormula(const LightChange *light)
{
    if (light->shadows != SHADOWS_AS_SCENE)
        return CAUSE_SHADOW;
    if (light->ambientScale != 1)
        return CAUSE_AMBIENT;
    if (light->highlight == HIGHLIGHT_OTHER_MODEL)
        return CAUSE_BLINN;
    if (light->highlight != HIGHLIGHT_AS_SCENE)
        return CAUSE_SPECULAR;
    if (light->normals != NORMALS_AS_SCENE)
        return CAUSE_NORMALS;
    return light->negative != NEGATIVE_AS_SCENE ? CAUSE_NEGATIVE_LIGHT : CAUSE_SHININESS;
}

/* The cause that the contract has a word for, or none. */
static Cause causeOf(const PartChange *change, const Scene *scene)
{
    double k;
    switch (change->kind) {
    case PART_SHADOW:
        return CAUSE_SHADOW;
    case PART_FORMULA:
        return causeOfFormula(&change->light);
    case PART_MATERIAL: {
        const Material *found = &change->material, *old = change->ofMaterial;
        Material otherwise = *found;
        otherwise.specular = old->specular;
        return sameMaterial(&otherwise, old) ? CAUSE_SPECULAR : CAUSE_SCENE;
    }
    case PART_LAMP: {
        const Light *asked = &scene->lights[change->number];
        if (change->lamp.falloff != asked->falloff)
            return CAUSE_FALLOFF;
        if (isMoved(&change->lamp, asked))
            return CAUSE_SCENE;
        return colorIsBlack(change->lamp.color) || isMultiple(change->lamp.color, asked->color, &k)
                   ? CAUSE_EXPOSURE
                   : CAUSE_SCENE;
    }
    default:
        return CAUSE_SCENE;
    }
}

/* What to look at in the scene, or in the program. */
static const char *formulaOf(const PartChange *change, const Scene *scene, Cause cause)
{
    switch (change->kind) {
    case PART_GONE:
        return "of all objects that a ray meets, the nearest one is seen";
    case PART_PLACE:
        return "its place and its size";
    case PART_BACKGROUND:
        return "background, which a ray sees that meets no object";
    case PART_SETTINGS:
        return change->render.samples != scene->render.samples
                   ? "render.samples: a pixel is the mean of samples x samples rays"
                   : "render.max_depth: a ray past it, in mirrors and glass, is black";
    case PART_MATERIAL:
        if (!sameColors(change->material.reflection, change->ofMaterial->reflection))
            return "color = ... + reflection * mirrored";
        if (!sameColors(change->material.transmission, change->ofMaterial->transmission))
            return "color = ... + transmission * refracted";
        return cause == CAUSE_SPECULAR ? "specular in Ispec * Lc * max(0, dot(R, V))^shininess / d^2"
               : sameColors(change->material.diffuse, change->ofMaterial->diffuse) &&
                       change->material.pattern == change->ofMaterial->pattern
                   ? "color = ambient * render.ambient + emission + ..."
                   : "diffuse in Ic * Lc * dot(N, L) / d^2";
    default:
        break;
    }
    switch (cause) {
    case CAUSE_SHADOW:
        return "a light counts if nothing lies strictly between the point and it";
    case CAUSE_SPECULAR:
    case CAUSE_BLINN:
    case CAUSE_SHININESS:
        return "Ispec * Lc * max(0, dot(R, V))^shininess / d^2";
    case CAUSE_NORMALS:
        return "N is of unit length and points to the side the ray comes from";
    case CAUSE_AMBIENT:
        return "color = ambient * render.ambient + emission + ...";
    default:
        return "Ic * Lc * max(0, dot(N, L)) / d^2";
    }
}

/* The first lamp whose color is not the scene's. */
static size_t firstChangedLamp(const PartChange *change, const Scene *scene)
{
    for (size_t i = 0; i < scene->lightCount && i < MOST_LAMPS; i++)
        if (!sameColors(change->lampColors[i], scene->lights[i].color))
            return i;
    return 0;
}

static void appendLine(const SceneSource *source, int line, Text *where)
{
    if (source != NULL && source->name != NULL && line > 0)
        textAppendFormat(where, "%s:%d: ", source->name, line);
}

/* Where the key stands, or 0. */
static int keyLine(const SceneSource *source, const char *key)
{
    return source != NULL && source->text != NULL ? findKeyLine(source->text, key) : 0;
}

/* The line of the scene to look at, or 0. */
static int lineOf(const PartChange *change, const Scene *scene, const SceneSource *source)
{
    switch (change->kind) {
    case PART_LAMP:
        return lampLine(source, change->number);
    case PART_ALL_LAMPS:
        return lampLine(source, firstChangedLamp(change, scene));
    case PART_BACKGROUND:
        return keyLine(source, "background");
    case PART_SETTINGS:
        return keyLine(source, "render");
    default:
        return partOf(change, scene)->line;
    }
}

void tellPart(const PartFinding *finding, const Scene *scene, const SceneSource *source, Explanations *causes)
{
    const PartChange *change = &finding->change;
    Cause cause = causeOf(change, scene);
    Explanation *told = addExplanation(causes, cause, finding->residual);
    tellChange(change, scene, source, &told->text);
    if (finding->hasOther) {
        textAppend(&told->text, " (the picture would be the same if this were so: ");
        tellChange(&finding->other, scene, source, &told->text);
        textAppend(&told->text, ")");
    }
    appendLine(source, lineOf(change, scene, source), &told->where);
    textAppend(&told->where, formulaOf(change, scene, cause));
}

/* ---- Where the difference lies ---- */

static void tellOwner(const OwnerShare *share, const Scene *scene, Text *text)
{
    appendObjectName(scene, &scene->objects[share->object], NULL, text);
    textAppend(text, " (");
    if (share->differing > 0.995 * share->seen) {
        textAppend(text, "all of it)");
        return;
    }
    appendPercent(text, share->differing / share->seen);
    textAppend(text, " of it)");
}

void tellOwners(const DifferenceOwners *owners, const Scene *scene, const SceneSource *source,
                Explanation *told)
{
    size_t named = 0;
    while (named < owners->count && named < MOST_OWNERS &&
           owners->items[named].differing > NAMED_SHARE * owners->differing)
        named++;
    bool hasBackground = owners->onBackground > NAMED_SHARE * owners->differing;
    if (named == 0 && !hasBackground)
        return;
    textAppend(&told->text, "; there the scene shows ");
    for (size_t i = 0; i < named; i++) {
        textAppend(&told->text, i == 0 ? "" : i + 1 < named || hasBackground ? ", " : " and ");
        tellOwner(&owners->items[i], scene, &told->text);
    }
    if (hasBackground)
        textAppend(&told->text, named > 0 ? " and the background" : "the background");
    if (named > 0 && source != NULL && source->name != NULL &&
        scene->objects[owners->items[0].object].line > 0)
        textAppendFormat(&told->where, ", %s:%d", source->name, scene->objects[owners->items[0].object].line);
}
