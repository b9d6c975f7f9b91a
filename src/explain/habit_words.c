/* habit_words.c - POV-Ray's habits in words: what each is, what to write instead, and the sum; see habits.h.
 */
#include "compare/html.h"
#include "explain/habits.h"

#include <math.h>
#include <string.h>

static Cause habitCause(PovHabit habit)
{
    switch (habit) {
    case POV_HABIT_FALLOFF:
        return CAUSE_FALLOFF;
    case POV_HABIT_AMBIENT:
        return CAUSE_AMBIENT;
    case POV_HABIT_DIFFUSE:
        return CAUSE_EXPOSURE;
    case POV_HABIT_HIGHLIGHT:
        return CAUSE_BLINN;
    case POV_HABIT_HIGHLIGHT_COLOR:
        return CAUSE_SPECULAR;
    case POV_HABIT_GAMMA:
        return CAUSE_GAMMA;
    case POV_HABIT_LEFT_HANDED:
        return CAUSE_MIRRORED;
    case POV_HABIT_ANGLE:
        return CAUSE_ASPECT;
    case POV_HABIT_AREA_LIGHT:
        return CAUSE_SHADOW;
    case ALL_POV_HABITS:
        break;
    }
    return CAUSE_UNKNOWN;
}

/* Whether the object has a highlight of this model. */
static bool hasHighlight(const Scene *scene, const Object *object, ShadingModel model)
{
    if (object->kind != SHAPE_CSG)
        return materialModel(scene, &object->material) == model && !colorIsBlack(object->material.specular);
    for (size_t i = 0; i < object->csg.partCount; i++)
        if (hasHighlight(scene, &object->csg.parts[i], model))
            return true;
    return false;
}

static bool sceneHasHighlight(const Scene *scene, ShadingModel model)
{
    for (size_t i = 0; i < scene->objectCount; i++)
        if (hasHighlight(scene, &scene->objects[i], model))
            return true;
    return false;
}

/* ---- What each habit is ---- */

static void appendHighlightText(const Scene *scene, Text *text)
{
    bool phong = sceneHasHighlight(scene, MODEL_PHONG), blinn = sceneHasHighlight(scene, MODEL_BLINN_PHONG);
    if (phong)
        textAppend(text, "`specular` with `roughness 1/n` in place of `phong` is Blinn's highlight, (N.H)^n, "
                         "and not Phong's, (R.V)^n: wider for the same n.");
    if (blinn)
        textAppendFormat(text,
                         "%s`phong` with `phong_size n` in place of `specular` is Phong's highlight, "
                         "(R.V)^n, and not Blinn's, (N.H)^n: narrower for the same n.",
                         phong ? " " : "");
}

/* The angle of view across the picture, in degrees. */
static double horizontalAngle(const Scene *scene)
{
    const double pi = 3.14159265358979323846;
    double half = tan(scene->camera.fov * pi / 360) * scene->image.width / scene->image.height;
    return atan(half) * 360 / pi;
}

void appendHabitText(const HabitStudy *study, const Scene *scene, int number, Text *text)
{
    switch (study->order[number]) {
    case POV_HABIT_FALLOFF:
        textAppend(text,
                   "With `fade_distance 1 fade_power 2` POV-Ray makes the light 2/(1+d^2) of its colour "
                   "and not 1/d^2: the same at distance 1, twice as bright far away.");
        break;
    case POV_HABIT_AMBIENT:
        textAppend(text, "POV-Ray's default finish has `ambient 0.1`: a tenth of the diffuse colour is added "
                         "everywhere, in the shadows too.");
        if (!colorIsBlack(scene->render.ambient))
            textAppend(text, " The ambient light that the scene has is not there.");
        break;
    case POV_HABIT_DIFFUSE:
        textAppend(text, "POV-Ray's default finish has `diffuse 0.6`: the diffuse term is dimmed to 0.6 of "
                         "what it is.");
        break;
    case POV_HABIT_HIGHLIGHT:
        appendHighlightText(scene, text);
        break;
    case POV_HABIT_HIGHLIGHT_COLOR:
        textAppend(text, "A finish has one number for the highlight and no colour, here the mean of red, "
                         "green and blue: the highlight gets the light's colour.");
        break;
    case POV_HABIT_GAMMA:
        textAppend(text,
                   "`assumed_gamma 2.2` takes the light that was worked out for values that are encoded "
                   "already, and raises them to the power 2.2: all but black and white is too dark.");
        break;
    case POV_HABIT_LEFT_HANDED:
        textAppend(text,
                   "POV-Ray's camera is left-handed: with `right x*aspect` the picture of a right-handed "
                   "scene has left and right exchanged.");
        break;
    case POV_HABIT_ANGLE:
        textAppend(text, "POV-Ray's `angle` is the one across the picture, and `fov` is the one from top to "
                         "bottom: ");
        textAppendRounded(text, scene->camera.fov, 4);
        textAppend(text, " degrees across where ");
        textAppendRounded(text, horizontalAngle(scene), 4);
        textAppend(text, " are meant.");
        break;
    case POV_HABIT_AREA_LIGHT:
        textAppend(text, "`area_light` uses its grid for the shadows alone, and shades as if all light came "
                         "from its middle.");
        break;
    case ALL_POV_HABITS:
        break;
    }
}

/* ---- What to write ---- */

static void appendHighlightRemedy(const Scene *scene, Text *text)
{
    bool phong = sceneHasHighlight(scene, MODEL_PHONG), blinn = sceneHasHighlight(scene, MODEL_BLINN_PHONG);
    if (phong)
        textAppend(text, "write `finish { phong ks phong_size n }`");
    if (blinn)
        textAppendFormat(text, "%s`finish { specular ks roughness 1/n }`%s", phong ? ", and " : "write ",
                         phong ? " for Blinn's" : "");
}

void appendHabitRemedy(const HabitStudy *study, const Scene *scene, int number, Text *text)
{
    switch (study->order[number]) {
    case POV_HABIT_FALLOFF:
        textAppend(text, "write `light_source { P rgb L*K fade_distance D fade_power 2 }` with "
                         "D = 1/1048576, K = 1/(2*D*D)");
        break;
    case POV_HABIT_AMBIENT:
        textAppend(text, "write `#default { finish { ambient 0 } }`");
        if (!colorIsBlack(scene->render.ambient))
            textAppend(text, ", and the scene's own as `emission`");
        break;
    case POV_HABIT_DIFFUSE:
        textAppend(text, "write `#default { finish { diffuse 1 } }`");
        break;
    case POV_HABIT_HIGHLIGHT:
        appendHighlightRemedy(scene, text);
        break;
    case POV_HABIT_HIGHLIGHT_COLOR:
        textAppend(text, "write three layers, `texture { pigment { rgb 0 } finish { phong 1 phong_size n } } "
                         "texture { pigment { rgb 2*ks filter 1 } finish { diffuse 0 } } "
                         "texture { pigment { rgb 2*kd transmit 0.5 } }`");
        break;
    case POV_HABIT_GAMMA:
        textAppend(text, "write `global_settings { assumed_gamma 1 }`");
        break;
    case POV_HABIT_LEFT_HANDED:
        textAppend(text, "write `camera { right -x*image_width/image_height }`");
        break;
    case POV_HABIT_ANGLE:
        textAppend(text, "write `camera { angle 2*degrees(atan2(tan(radians(");
        textAppendRounded(text, scene->camera.fov, 15);
        textAppend(text, ")/2)*image_width/image_height, 1)) }`");
        break;
    case POV_HABIT_AREA_LIGHT:
        textAppend(text, "write a `light_source` for each point of the grid, with the colour divided by how "
                         "many there are");
        break;
    case ALL_POV_HABITS:
        break;
    }
}

/* ---- As causes ---- */

Status explainHabits(const HabitStudy *study, const Scene *scene, Explanations *explanations)
{
    Explanations made = {.before = pictureAfterHabits(study, 0)->metrics.rmse};
    for (int i = 0; i < study->count; i++) {
        if (!isHabitSeen(study, i))
            continue;
        Explanation *item = addExplanation(&made, habitCause(study->order[i]),
                                           pictureAfterHabits(study, i + 1)->metrics.rmse);
        appendHabitText(study, scene, i, &item->text);
        appendHabitRemedy(study, scene, i, &item->where);
    }
    const Metrics *matched = &habitPicture(study, 0)->metrics;
    if (matched->rmse > HABIT_STEP) {
        Explanation *item = addExplanation(&made, CAUSE_UNKNOWN, matched->rmse);
        textAppend(&item->text, "With every habit taken back the two pictures still differ: that is none of "
                                "POV-Ray's habits.");
        if (scene->render.samples > 1)
            textAppend(&item->text, " Where one of several rays in a pixel is brighter than 1, POV-Ray's "
                                    "picture does not tell their mean: with `--samples 1` that is out of "
                                    "the way.");
        textAppendFormat(&item->where, "the pixel (%d, %d), where they differ most", matched->worst.x,
                         matched->worst.y);
    }
    bool failed = false;
    for (size_t i = 0; i < made.count; i++)
        failed = failed || made.items[i].text.failed || made.items[i].where.failed;
    if (failed) {
        freeExplanations(&made);
        return statusOutOfMemory();
    }
    *explanations = made;
    return statusOk();
}

/* ---- For the terminal ---- */

enum {
    DECIMALS = 5,
    NAME_COLUMNS = 30,
    BAR_COLUMNS = 24,
    TEXT_COLUMNS = 80,
    INDENT = 3
};

/* A number in a column, after two spaces. */
static void appendColumn(Text *text, double value)
{
    textAppend(text, "  ");
    textAppendFixed(text, value, DECIMALS);
}

/* A bar whose length is in proportion; what is more than 0 has at least a mark. */
static void appendBar(Text *text, double value, double largest)
{
    int length = largest > 0 ? (int)lround(value / largest * BAR_COLUMNS) : 0;
    const char *tip = length == 0 && value > HABIT_STEP ? "|" : "";
    if (length > 0 || *tip != '\0')
        textAppend(text, "  ");
    for (int i = 0; i < length; i++)
        textAppend(text, "#");
    textAppend(text, tip);
    textAppend(text, "\n");
}

static void appendName(Text *text, const char *name, const char *rest)
{
    int length = (int)(strlen(name) + strlen(rest));
    textAppendFormat(text, "  %s%s%*s", name, rest, length < NAME_COLUMNS ? NAME_COLUMNS - length : 0, "");
}

/* A paragraph whose further lines begin under the first; without the backquotes round code where color marks
 * it in another way. */
static void appendParagraph(Text *text, const char *words, size_t column, bool color)
{
    bool isCode = false;
    for (const char *word = words; *word != '\0';) {
        size_t length = strcspn(word, " "), marks = 0;
        for (size_t i = 0; i < length; i++)
            marks += word[i] == '`';
        size_t shown = color ? length - marks : length;
        if (column > INDENT && column + 1 + shown > TEXT_COLUMNS) {
            textAppendFormat(text, "\n%*s", INDENT, "");
            column = INDENT;
        } else if (column > INDENT) {
            textAppend(text, " ");
            column++;
        }
        for (size_t i = 0; i < length; i++) {
            if (!color || word[i] != '`') {
                textAppendBytes(text, &word[i], 1);
                continue;
            }
            isCode = !isCode;
            textAppend(text, isCode ? "\033[36m" : "\033[0m");
        }
        column += shown;
        word += length + (word[length] == ' ');
    }
    textAppend(text, "\n");
}

static double largestRmse(const HabitStudy *study)
{
    double largest = 0;
    for (int i = 0; i < study->pictureCount; i++)
        largest = fmax(largest, study->pictures[i].metrics.rmse);
    return largest;
}

static void appendHeading(Text *text, const char *heading, const char *columns, bool color)
{
    textAppendFormat(text, "\n%s%-32s%s%s\n", color ? "\033[1m" : "", heading, columns,
                     color ? "\033[0m" : "");
}

/* How the difference goes down from step to step. */
static void appendSequence(const HabitStudy *study, bool color, Text *text)
{
    double largest = largestRmse(study), before = pictureAfterHabits(study, 0)->metrics.rmse;
    appendHeading(text, "All of them, then taken back:", "     RMSE     change", color);
    appendName(text, "native", ", with all habits");
    appendColumn(text, before);
    textAppendFormat(text, "%*s", 12, "");
    appendBar(text, before, largest);
    for (int i = 0; i < study->count; i++) {
        double after = pictureAfterHabits(study, i + 1)->metrics.rmse;
        appendName(text, povHabitName(study->order[i]), " taken back");
        appendColumn(text, after);
        double change = round((after - before) * 1e5);
        textAppend(text, change > 0 ? "  (+" : change < 0 ? "  (-" : "  ( ");
        textAppendFixed(text, fabs(after - before), DECIMALS);
        textAppend(text, ")");
        appendBar(text, after, largest);
        before = after;
    }
    appendName(text, "matched", ", with none");
    appendColumn(text, before);
    textAppend(text, "\n");
}

void appendHabitSum(const HabitStudy *study, Text *text)
{
    double native = pictureAfterHabits(study, 0)->metrics.rmse;
    const Metrics *matched = &habitPicture(study, 0)->metrics;
    textAppend(text, "explained ");
    textAppendFixed(text, fmax(native - matched->rmse, 0), DECIMALS);
    textAppend(text, " of ");
    textAppendFixed(text, native, DECIMALS);
    textAppend(text, ", left ");
    textAppendRounded(text, matched->rmse, 2);
    if (matched->rmse > HABIT_STEP)
        textAppendFormat(text, ", which is none of these habits; look at the pixel (%d, %d)",
                         matched->worst.x, matched->worst.y);
    else if (matched->rmse > 0)
        textAppend(text, ", which is rounding");
}

void writeHabitsText(const HabitStudy *study, const Scene *scene, const char *name, bool color, Text *text)
{
    textAppendPlain(text, name);
    textAppendFormat(text, ", %d x %d: POV-Ray's habits against our picture\n", scene->image.width,
                     scene->image.height);
    double largest = largestRmse(study);
    appendHeading(text, "Each habit alone:", "     RMSE     FLIP  largest", color);
    for (int i = 0; i < study->count; i++) {
        const Metrics *metrics = &pictureWithHabit(study, i)->metrics;
        appendName(text, povHabitName(study->order[i]), "");
        appendColumn(text, metrics->rmse);
        appendColumn(text, metrics->flip);
        appendColumn(text, metrics->maxDifference);
        appendBar(text, metrics->rmse, largest);
    }
    appendSequence(study, color, text);

    for (int i = 0; i < study->count; i++) {
        const char *habit = povHabitName(study->order[i]);
        Text words = {0};
        appendHabitText(study, scene, i, &words);
        if (!isHabitSeen(study, i))
            textAppend(&words, " In this picture nothing of it is seen.");
        textAppendFormat(text, "\n%d. %s%s%s:", i + 1, color ? "\033[1m" : "", habit, color ? "\033[0m" : "");
        appendParagraph(text, textString(&words), strlen(habit) + 5, color);
        textAppendFormat(text, "%*s", INDENT, "");
        text->failed |= words.failed;
        textFree(&words);
        appendHabitRemedy(study, scene, i, &words);
        appendParagraph(text, textString(&words), INDENT, color);
        text->failed |= words.failed;
        textFree(&words);
    }
    textAppend(text, "\n");
    appendHabitSum(study, text);
    textAppend(text, "\n");
}
