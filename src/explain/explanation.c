/* explanation.c - see explanation.h. */
#include "explain/explanation.h"

#include "base/json.h"

/* ORDER Cause */
static const char *const CAUSE_NAMES[CAUSE_COUNT] = {
    "gamma",   "exposure", "mirrored",     "flipped",       "channels", "shift",          "aspect",
    "shadow",  "falloff",  "blinn",        "shininess",     "specular", "negative_light", "normals",
    "ambient", "acne",     "quantisation", "another scene", "unknown",
};

const char *causeName(Cause cause)
{
    return CAUSE_NAMES[cause];
}

Explanation *addExplanation(Explanations *explanations, Cause cause, double residual)
{
    if (explanations->count == MAX_EXPLANATIONS) {
        explanations->count--;
        textFree(&explanations->items[explanations->count].text);
        textFree(&explanations->items[explanations->count].where);
    }
    Explanation *added = &explanations->items[explanations->count++];
    *added = (Explanation){.cause = cause, .residual = residual};
    return added;
}

void freeExplanations(Explanations *explanations)
{
    for (size_t i = 0; i < explanations->count; i++) {
        textFree(&explanations->items[i].text);
        textFree(&explanations->items[i].where);
    }
    explanations->count = 0;
}

void writeExplanationsJson(const Explanations *explanations, Text *text)
{
    JsonWriter json = jsonBegin(text);
    jsonObject(&json);
    jsonKey(&json, "causes");
    jsonArray(&json);
    for (size_t i = 0; i < explanations->count; i++) {
        const Explanation *item = &explanations->items[i];
        jsonObject(&json);
        /* The words of JSON are fixed, and have none for another scene. */
        jsonKeyString(&json, "cause", causeName(item->cause == CAUSE_SCENE ? CAUSE_UNKNOWN : item->cause));
        jsonKeyNumber(&json, "residual", item->residual);
        jsonKeyString(&json, "text", textString(&item->text));
        jsonKeyString(&json, "where", textString(&item->where));
        jsonEndObject(&json);
    }
    jsonEndArray(&json);
    jsonEndObject(&json);
    jsonEnd(&json);
}

void writeExplanationsText(const Explanations *explanations, const char *summary, Text *text)
{
    if (explanations->count == 0) {
        textAppend(text, summary);
        textAppend(text, "\n");
        return;
    }
    textAppend(text, "difference: root mean square error ");
    textAppendRounded(text, explanations->before, 3);
    textAppend(text, "\n");
    for (size_t i = 0; i < explanations->count; i++) {
        const Explanation *item = &explanations->items[i];
        textAppendFormat(text, "\n%zu. %s: %s\n   look at: %s\n", i + 1, causeName(item->cause),
                         textString(&item->text), textString(&item->where));
        textAppend(text, item->cause == CAUSE_UNKNOWN ? "   not explained: " : "   left after this: ");
        textAppendRounded(text, item->residual, 3);
        textAppend(text, "\n");
    }
}
