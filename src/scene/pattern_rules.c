/* pattern_rules.c - transforms and patterns: from values to maps; see format_rules.h. */
#include "scene/format_rules.h"
#include "scene/reader.h"
#include "scene/scene_files.h"

/* ---- Transforms ---- */

/* Put the step behind those before it; target is the Matrix of them all. */
void finishStep(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    const StepValues *step = values;
    Matrix *all = target;
    Matrix matrix = identityMatrix();
    if (isGiven(given, "translate")) {
        matrix = translationMatrix(step->translate);
    } else if (isGiven(given, "scale")) {
        matrix = scalingMatrix(step->scale);
    } else if (isGiven(given, "rotate")) {
        matrix = rotationMatrix(step->rotate.axis, step->rotate.angle);
    } else if (isGiven(given, "matrix")) {
        Transform unused;
        matrix = step->matrix;
        if (!createTransform(&matrix, &unused)) {
            reportError(reader, placeOfKey(given, "matrix"), "choose three axes that span space",
                        "the axes x, y and z lie in one plane, so the matrix squeezes the object flat");
            return;
        }
    }
    *all = composeMatrices(all, &matrix);
}

/* ---- Patterns ---- */

/* Keep the pattern in the scene; target is where the material points to it. */
static void keepPattern(SceneReader *reader, GivenKeys *given, const PatternValues *values, PatternKind kind,
                        void *target)
{
    if (!areAllUsable(given))
        return;
    Pattern *pattern = allocateInScene(reader->scene, sizeof *pattern);
    if (pattern == NULL) {
        reader->outOfMemory = true;
        return;
    }
    static const Vector3D directions[] = {[AXIS_X] = {1, 0, 0}, [AXIS_Y] = {0, 1, 0}, [AXIS_Z] = {0, 0, 1}};
    *pattern = values->pattern;
    pattern->kind = kind;
    pattern->axis = directions[values->axis];
    pattern->hasTransform = isGiven(given, "transform");
    if (pattern->hasTransform && !createTransform(&values->transform, &pattern->transform)) {
        reportKeyError(
            reader, given, "transform", "use larger or smaller numbers",
            "'transform' cannot be undone: it squeezes the pattern flat, or its numbers grow too large "
            "or too small");
        return;
    }
    *(const Pattern **)target = pattern;
}

void finishChecker(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    keepPattern(reader, given, values, PATTERN_CHECKER, target);
}

void finishStripes(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    keepPattern(reader, given, values, PATTERN_STRIPES, target);
}

void finishGradient(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    keepPattern(reader, given, values, PATTERN_GRADIENT, target);
}

void finishImageFile(SceneReader *reader, GivenKeys *given, void *values, void *target)
{
    PatternValues *read = values;
    if (isGiven(given, "file") && loadImage(reader, placeOfKey(given, "file"), read->file, &read->pattern))
        keepPattern(reader, given, values, PATTERN_IMAGE, target);
}
