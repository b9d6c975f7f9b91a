/* terms.c - see terms.h. */
#include "explain/terms.h"

#include "explain/scene_variant.h"

/* ORDER Term */
static const char *const NAMES[TERM_COUNT] = {"ambient", "emission", "diffuse", "specular", "background"};

const char *termName(Term term)
{
    return NAMES[term];
}

static Color3f black(void)
{
    return createColor(0, 0, 0);
}

/* ---- Which terms there are ---- */

static bool hasLight(const Scene *scene)
{
    for (size_t i = 0; i < scene->lightCount; i++)
        if (!colorIsBlack(scene->lights[i].color))
            return true;
    return false;
}

static bool materialHasTerm(const Scene *scene, const Material *material, Term term)
{
    ShadingModel model = materialModel(scene, material);
    bool isDiffuse = material->pattern != NULL || !colorIsBlack(material->diffuse);
    switch (term) {
    case TERM_AMBIENT:
        return model != MODEL_SIMPLE && !colorIsBlack(multColors(material->ambient, scene->render.ambient));
    case TERM_EMISSION:
        return model != MODEL_SIMPLE && !colorIsBlack(material->emission);
    case TERM_DIFFUSE:
        return isDiffuse && (model == MODEL_SIMPLE || hasLight(scene));
    case TERM_SPECULAR:
        return model >= MODEL_PHONG && !colorIsBlack(material->specular) && hasLight(scene);
    default:
        return false;
    }
}

static bool objectsHaveTerm(const Scene *scene, const Object *objects, size_t count, Term term)
{
    for (size_t i = 0; i < count; i++) {
        const Object *object = &objects[i];
        if (object->kind == SHAPE_CSG ? objectsHaveTerm(scene, object->csg.parts, object->csg.partCount, term)
                                      : materialHasTerm(scene, &object->material, term))
            return true;
    }
    return false;
}

bool sceneHasTerm(const Scene *scene, Term term)
{
    if (term != TERM_BACKGROUND)
        return objectsHaveTerm(scene, scene->objects, scene->objectCount, term);
    const Background *background = &scene->background;
    return !colorIsBlack(background->bottom) || (background->isGradient && !colorIsBlack(background->top)) ||
           (scene->fog.distance > 0 && !colorIsBlack(scene->fog.color));
}

/* ---- One term ---- */

/* Leave of a material's sources those of the term. Reflection, transmission and the index of refraction stay:
 * they only pass light on. */
static void keepTerm(Material *material, void *context)
{
    const Term *term = context;
    if (*term != TERM_DIFFUSE) {
        material->diffuse = black();
        material->pattern = NULL;
    }
    if (*term != TERM_SPECULAR)
        material->specular = black();
    if (*term != TERM_AMBIENT)
        material->ambient = black();
    if (*term != TERM_EMISSION)
        material->emission = black();
}

Status createTermScene(const Scene *original, Term term, Scene *variant)
{
    Status status = createSceneVariant(original, variant);
    if (!statusIsOk(&status))
        return status;
    changeMaterials(variant, keepTerm, &term);

    /* Without lights, a surface of the simple model shows its colour, which is black by now. */
    if (term != TERM_DIFFUSE && term != TERM_SPECULAR)
        variant->lightCount = 0;
    if (term != TERM_AMBIENT)
        variant->render.ambient = black();
    if (term != TERM_BACKGROUND) {
        variant->background = (Background){.bottom = black()};
        variant->fog.color = black();
    }
    return statusOk();
}
