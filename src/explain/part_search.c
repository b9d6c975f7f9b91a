/* part_search.c - see part_search.h. */
#include "explain/part_search.h"

#include "base/cancel.h"
#include "explain/downhill.h"
#include "explain/sample_rounding.h"

#include <math.h>
#include <stdlib.h>

enum {
    TRIED_PIXELS = 500,   /* that changes are tried on */
    MANY_PIXELS = 2500,   /* that those are which are hard to tell apart */
    FULL_PIXELS = 120000, /* that the residual is measured on */
    TRIED_OBJECTS = 5,    /* at most */
    FEW_OBJECTS = 2,      /* where each costs much */
    MANY_SHAPES = 20000   /* objects, or triangles of meshes, from where on they do */
};

/* How much better a later, less simple change must be to take the place of an earlier one. */
static const double MARGIN = 0.97;

/* Up to this share of the difference, what is left is noise. */
static const double NOISE_SHARE = 0.01;

/* ---- One change ---- */

double measurePart(PartSearch *search, const PartChange *change)
{
    if (cancelRequested() && statusIsOk(&search->status))
        search->status = statusInterrupted();
    if (!statusIsOk(&search->status))
        return INFINITY;
    Prediction prediction;
    search->status = predictPart(search->truth, search->evidence, change, &prediction);
    if (!statusIsOk(&search->status))
        return INFINITY;
    ValueChange neutral = neutralValueChange();
    double left = measureMisfit(search->evidence, &prediction, &neutral, 1, INFINITY).rmse;
    freePrediction(&prediction);
    return left;
}

/* Whether two changes say different things, and not one the more general case of the other. */
static bool isOtherKind(const PartChange *a, const PartChange *b)
{
    if (a->kind != b->kind)
        return true;
    return a->kind == PART_FORMULA &&
           (a->light.normals != b->light.normals || a->light.shadows != b->light.shadows ||
            a->light.highlight != b->light.highlight);
}

double tryPart(PartSearch *search, const PartChange *change, double share)
{
    double left = measurePart(search, change), noise = NOISE_SHARE * search->before;
    if (!(left < share * search->before))
        return left;
    if (!search->isFound || left < MARGIN * search->left - noise) {
        search->best = *change;
        search->left = left;
        search->isFound = true;
        search->hasOther = false;
    } else if (left <= search->left + noise && !search->hasOther && isOtherKind(change, &search->best)) {
        search->other = *change;
        search->hasOther = true;
    }
    return left;
}

bool isPartExact(const PartSearch *search)
{
    return !statusIsOk(&search->status) ||
           (search->isFound && search->left <= fmax(0.03 * search->before, 0.2 * search->rounding));
}

/* ---- One object ---- */

static ShadingModel modelOf(const PartSearch *search, const PartChange *target)
{
    return materialModel(search->truth->scene, target->ofMaterial);
}

/* The mistakes in the formulas that can be made for one object, the simpler ones first. */
static const LightChange FORMULAS[] = {
    {.shadows = SHADOWS_NONE, .ambientScale = 1, .lightScale = 1},
    {.shadows = SHADOWS_UNASKED, .ambientScale = 1, .lightScale = 1},
    {.highlight = HIGHLIGHT_NONE, .ambientScale = 1, .lightScale = 1},
    {.ambientScale = 0, .lightScale = 1},
    {.highlight = HIGHLIGHT_OTHER_MODEL, .ambientScale = 1, .lightScale = 1},
    {.highlight = HIGHLIGHT_DIFFUSE, .ambientScale = 1, .lightScale = 1},
    {.normals = NORMALS_FLIPPED, .ambientScale = 1, .lightScale = 1},
    {.normals = NORMALS_FLIPPED, .backUnshadowed = true, .ambientScale = 1, .lightScale = 1},
    {.normals = NORMALS_FLAT, .ambientScale = 1, .lightScale = 1},
    {.normals = NORMALS_NOT_TURNED, .backUnshadowed = true, .ambientScale = 1, .lightScale = 1},
    {.negative = NEGATIVE_SUBTRACTS, .backUnshadowed = true, .ambientScale = 1, .lightScale = 1},
    {.negative = NEGATIVE_ABSOLUTE, .backUnshadowed = true, .ambientScale = 1, .lightScale = 1},
};

/* Whether the change can make a difference to the material in this scene. */
static bool isFormulaOf(const PartSearch *search, const PartChange *target, const LightChange *light)
{
    const Scene *scene = search->truth->scene;
    const Material *material = target->ofMaterial;
    bool hasHighlight = modelOf(search, target) >= MODEL_PHONG && !colorIsBlack(material->specular);
    if (light->shadows != SHADOWS_AS_SCENE)
        return (light->shadows == SHADOWS_NONE) == scene->render.shadows;
    if (light->ambientScale != 1)
        return !colorIsBlack(multColors(material->ambient, scene->render.ambient));
    if (light->normals == NORMALS_FLAT)
        return scene->objects[target->number].kind == SHAPE_MESH ||
               scene->objects[target->number].kind == SHAPE_CSG ||
               scene->objects[target->number].kind == SHAPE_TRIANGLE;
    return light->highlight == HIGHLIGHT_AS_SCENE || hasHighlight;
}

static void tryFormulas(PartSearch *search, const PartChange *target)
{
    if (modelOf(search, target) == MODEL_SIMPLE)
        return;
    for (size_t i = 0; i < sizeof FORMULAS / sizeof *FORMULAS; i++) {
        if (!isFormulaOf(search, target, &FORMULAS[i]))
            continue;
        PartChange change = *target;
        change.kind = PART_FORMULA;
        change.light = FORMULAS[i];
        tryPart(search, &change, PART_SHARE);
    }
}

typedef struct ShininessFit {
    PartSearch *search;
    PartChange *change;
} ShininessFit;

static double measureExponent(void *context, double logarithm)
{
    const ShininessFit *fit = context;
    fit->change->light.shininessValue = exp(logarithm);
    return measurePart(fit->search, fit->change);
}

/* The exponent of the highlights, by a grid and the golden section between the neighbours of the best. */
static void tryShininess(PartSearch *search, const PartChange *target)
{
    if (modelOf(search, target) < MODEL_PHONG || colorIsBlack(target->ofMaterial->specular))
        return;
    PartChange change = *target;
    change.kind = PART_FORMULA;
    change.light = neutralLightChange();
    change.light.shininess = SHININESS_IS;
    double best = 1, least = INFINITY;
    for (double shininess = 1; shininess < 1000 && !isPartExact(search); shininess *= 2) {
        change.light.shininessValue = shininess;
        double left = measurePart(search, &change);
        if (left < least) {
            least = left;
            best = shininess;
        }
    }
    /* Only where there is something to be gained. */
    if (!(least < 0.7 * search->before))
        return;
    ShininessFit fit = {search, &change};
    double exponent = exp(goldenSection(measureExponent, &fit, log(best / 2), log(best * 2), 14));
    change.light.shininessValue =
        fabs(exponent - round(exponent)) < 0.02 * exponent ? round(exponent) : exponent;
    tryPart(search, &change, PART_SHARE);
}

/* What no number has to be found for. */
static void tryObject(PartSearch *search, const PartChange *target)
{
    PartChange change = *target;
    change.kind = PART_GONE;
    tryPart(search, &change, PART_SHARE);
    change.kind = PART_SHADOW;
    tryPart(search, &change, PART_SHARE);
    tryFormulas(search, target);
    change.kind = PART_MATERIAL;
    change.material = *target->ofMaterial;
    change.material.diffuse = change.material.specular = createColor(0, 0, 0);
    change.material.pattern = NULL;
    tryPart(search, &change, PART_SHARE); /* it sends no lamp's light back */
    change.material = *target->ofMaterial;
    change.material.reflection = createColor(0, 0, 0);
    if (!colorIsBlack(target->ofMaterial->reflection))
        tryPart(search, &change, PART_SHARE);
    change.material = *target->ofMaterial;
    change.material.transmission = createColor(0, 0, 0);
    if (!colorIsBlack(target->ofMaterial->transmission))
        tryPart(search, &change, PART_SHARE);
}

/* ---- The lamps ---- */

static void tryLamps(PartSearch *search)
{
    const Scene *scene = search->truth->scene;
    for (size_t i = 0; i < scene->lightCount && i < MOST_LAMPS && statusIsOk(&search->status); i++) {
        PartChange change = {.kind = PART_LAMP, .number = i, .lamp = scene->lights[i]};
        change.lamp.color = createColor(0, 0, 0);
        tryPart(search, &change, PART_SHARE);
        change.lamp = scene->lights[i];
        change.lamp.falloff = change.lamp.falloff == FALLOFF_NONE ? FALLOFF_INVERSE_SQUARE : FALLOFF_NONE;
        if (change.lamp.kind != LIGHT_DIRECTIONAL)
            tryPart(search, &change, PART_SHARE);
    }
}

/* ---- Which objects ---- */

typedef enum OwnerOrder {
    BY_SHARE_OF_ITS_PIXELS,
    BY_DIFFERING,
    BY_SHADOW_AND_MIRROR,
    OWNER_ORDERS
} OwnerOrder;

static double rankOf(const OwnerShare *share, const DifferenceOwners *owners, OwnerOrder order)
{
    switch (order) {
    case BY_SHARE_OF_ITS_PIXELS:
        return share->differing > 0.02 * owners->differing ? share->differing / share->seen : 0;
    case BY_DIFFERING:
        return share->differing;
    default:
        return share->shaded + share->mirrored;
    }
}

static bool isChosen(const PartChange *chosen, size_t count, size_t object)
{
    for (size_t i = 0; i < count; i++)
        if (chosen[i].number == object)
            return true;
    return false;
}

/* Choose the objects to try: by turns the foremost of each order. Returns how many. */
static size_t chooseObjects(const DifferenceOwners *owners, size_t most, PartChange chosen[TRIED_OBJECTS])
{
    size_t count = 0;
    for (int turn = 0; turn < 2 * OWNER_ORDERS && count < most; turn++) {
        const OwnerShare *best = NULL;
        OwnerOrder order = (OwnerOrder)(turn % OWNER_ORDERS);
        for (size_t i = 0; i < owners->count; i++) {
            const OwnerShare *share = &owners->items[i];
            double rank = rankOf(share, owners, order);
            if (rank > (best != NULL ? rankOf(best, owners, order) : 0) &&
                !isChosen(chosen, count, share->object))
                best = share;
        }
        if (best != NULL)
            chosen[count++] = (PartChange){.number = best->object, .ofMaterial = best->material, .scale = 1};
    }
    return count;
}

/* Objects, and the triangles of meshes. */
static size_t countShapes(const Scene *scene)
{
    size_t count = scene->objectCount;
    for (size_t i = 0; i < scene->objectCount; i++)
        if (scene->objects[i].kind == SHAPE_MESH)
            count += scene->objects[i].mesh.data->triangleCount;
    return count;
}

/* ---- The whole search ---- */

static void tryParts(PartSearch *search, const DifferenceOwners *owners)
{
    const Scene *scene = search->truth->scene;
    bool isLarge = countShapes(scene) > MANY_SHAPES;
    PartChange objects[TRIED_OBJECTS];
    size_t count = chooseObjects(owners, isLarge ? FEW_OBJECTS : TRIED_OBJECTS, objects);
    for (size_t i = 0; i < count && !isPartExact(search); i++)
        tryObject(search, &objects[i]);
    tryLamps(search);
    if (!isPartExact(search))
        tryLampColors(search);
    if (!isPartExact(search) && owners->onBackground > 0)
        tryBackground(search);
    for (int whole = 0; whole < 2; whole++) {
        for (size_t i = 0; i < count && !isPartExact(search); i++) {
            PartChange target = objects[i];
            target.wholeMaterial = whole == 1;
            if (target.wholeMaterial && countOfMaterial(scene, target.ofMaterial) < 2)
                continue;
            if (target.wholeMaterial)
                tryFormulas(search, &target);
            if (!isPartExact(search))
                tryMaterialColors(search, &target);
            if (!isPartExact(search))
                tryShininess(search, &target);
        }
    }
    for (size_t i = 0; i < count && i < FEW_OBJECTS && !isPartExact(search) && !isLarge; i++)
        tryPlaces(search, &objects[i]);
    if (!isPartExact(search))
        tryLampPlaces(search);
}

/* Measure what was found on many pixels; it must hold there too. */
static Status measureFully(const PartSearch *tried, const Evidence *full, PartFinding *finding)
{
    PartSearch search = *tried;
    search.evidence = full;
    ViewChange view = neutralViewChange();
    LightChange light = neutralLightChange();
    Prediction right;
    Status status = predictPixels(search.truth, full, NULL, &view, &light, false, &right);
    if (!statusIsOk(&status))
        return status;
    ValueChange neutral = neutralValueChange();
    double before = measureMisfit(full, &right, &neutral, 1, INFINITY).rmse;
    freePrediction(&right);
    finding->change = tried->best;
    finding->residual = measurePart(&search, &tried->best);
    finding->isFound = finding->residual < PART_SHARE * before;
    finding->hasOther = tried->hasOther;
    finding->other = tried->other;
    return search.status;
}

/* Find the parts that the differing pixels belong to, and try them. */
static Status searchParts(PartSearch *search, DifferenceOwners *owners)
{
    Status status = findDifferenceOwners(search->truth, search->evidence, &search->right, owners);
    if (!statusIsOk(&status))
        return status;
    tryParts(search, owners);
    return search->status;
}

/* Settings need not be fitted to a part, so what finds one is left out. */
static Status searchSettings(PartSearch *search, DifferenceOwners *owners)
{
    (void)owners;
    trySettings(search);
    search->isFound = isPartExact(search);
    return search->status;
}

static Status findByTrying(const Truth *truth, const Image *wrong, const Image *right,
                           Status (*tryThem)(PartSearch *, DifferenceOwners *), PartFinding *finding)
{
    size_t cost = predictionCost(truth);
    Evidence evidence = {.count = 0}, many = {.count = 0}, full = {.count = 0};
    PartSearch search = {.truth = truth, .evidence = &evidence, .manyPixels = &many, .status = statusOk()};
    search.rounding = roundingError(wrong->bitDepth);
    ViewChange view = neutralViewChange();
    LightChange light = neutralLightChange();
    PartFinding found = {0};
    bool *isDifferent = findDifferentPixels(wrong, right);
    Status status = isDifferent != NULL ? statusOk() : statusOutOfMemory();
    if (statusIsOk(&status))
        status = gatherEvidence(wrong, isDifferent, NULL, TRIED_PIXELS / cost + 300, &evidence);
    if (statusIsOk(&status))
        status = gatherEvidence(wrong, isDifferent, NULL, MANY_PIXELS / cost + 300, &many);
    if (statusIsOk(&status))
        status = predictPixels(truth, &evidence, NULL, &view, &light, false, &search.right);
    if (statusIsOk(&status)) {
        ValueChange neutral = neutralValueChange();
        search.before = search.left = measureMisfit(&evidence, &search.right, &neutral, 1, INFINITY).rmse;
        status = tryThem(&search, &found.owners);
    }
    if (statusIsOk(&status) && search.isFound)
        status = gatherEvidence(wrong, isDifferent, NULL, FULL_PIXELS / cost + 2000, &full);
    if (statusIsOk(&status) && search.isFound)
        status = measureFully(&search, &full, &found);
    freePrediction(&search.right);
    freeEvidence(&evidence);
    freeEvidence(&many);
    freeEvidence(&full);
    free(isDifferent);
    if (statusIsOk(&status))
        *finding = found;
    else
        freePartFinding(&found);
    return status;
}

Status findPart(const Truth *truth, const Image *wrong, const Image *right, PartFinding *finding)
{
    return findByTrying(truth, wrong, right, searchParts, finding);
}

Status findSettings(const Truth *truth, const Image *wrong, const Image *right, PartFinding *finding)
{
    return findByTrying(truth, wrong, right, searchSettings, finding);
}

void freePartFinding(PartFinding *finding)
{
    freeDifferenceOwners(&finding->owners);
    *finding = (PartFinding){0};
}
