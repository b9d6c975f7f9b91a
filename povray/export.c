/* export.c - from a Scene to a POV-Ray scene; see export.h and MAPPING.md.
 *
 * Everything is stated explicitly, since POV-Ray's defaults (left-handed camera, ambient light, diffuse
 * 0.6, no falloff) are not ours. Numbers are written so that they read back as the same double. Nothing
 * of the scene file reaches the text but numbers, so nothing in it can be read as POV-Ray code.
 */
#include "povray/export.h"

#include "povray/pov_scale.h"

#include <float.h>
#include <string.h>

/* How the materials of a scene are to be written. */
typedef enum Finish {
    FINISH_UNLIT,     /* the diffuse colour as it is */
    FINISH_LIT,       /* the diffuse colour where the light arrives, black elsewhere */
    FINISH_REFLECTION /* Lambert's term, and Phong's */
} Finish;

static void appendColor(Text *pov, Color3f color, double factor)
{
    textAppend(pov, "rgb <");
    textAppendPovNumber(pov, (double)color.r * factor);
    textAppend(pov, ", ");
    textAppendPovNumber(pov, (double)color.g * factor);
    textAppend(pov, ", ");
    textAppendPovNumber(pov, (double)color.b * factor);
    textAppend(pov, ">");
}

/* The length in bytes of the character at the start of name if a line of a comment can show it, else 0: no
 * control character, and none of U+2000..U+207F, which end lines or turn the direction of writing. */
static size_t shownLength(const char *name)
{
    size_t length = utf8Length(name);
    unsigned char first = (unsigned char)name[0], second = (unsigned char)(length > 1 ? name[1] : 0);
    if (first < ' ' || first == 0x7F || (first == 0xC2 && second < 0xA0) ||
        (first == 0xE2 && (second == 0x80 || second == 0x81)))
        return 0;
    return length;
}

/* Append a file name as one word of the shell, with _ for each byte that cannot be shown. */
static void appendQuoted(Text *pov, const char *name, size_t length)
{
    textAppend(pov, "'");
    for (size_t i = 0; i < length;) {
        size_t shown = shownLength(name + i);
        if (name[i] == '\'')
            textAppend(pov, "'\\''");
        else if (shown > 0)
            textAppendBytes(pov, name + i, shown);
        else
            textAppend(pov, "_");
        i += shown > 0 ? shown : 1;
    }
    textAppend(pov, "'");
}

/* The command that renders the file. POV-Ray 3.7 opens no file whose name has spaces, quotes or letters
 * outside ASCII, so the shell opens those. */
static void writeCommand(const Scene *scene, const char *name, Text *pov)
{
    const char *slash = strrchr(name, '/');
    const char *base = slash != NULL ? slash + 1 : name;
    if (*base == '\0')
        base = "scene.pov";
    size_t length = strlen(base);
    int stem = (int)(length > 4 && strcmp(base + length - 4, ".pov") == 0 ? length - 4 : length);
    bool plain = base[0] != '-' && strspn(base, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                "0123456789_-.") == length;
    if (plain)
        textAppendFormat(pov, "// povray +I%s +O%.*s.png", base, stem, base);
    else
        textAppend(pov, "// povray +I/dev/stdin +O-");
    textAppendFormat(pov, " +W%d +H%d +FN%d File_Gamma=%s -A -D", scene->image.width, scene->image.height,
                     scene->image.bitDepth, scene->image.encoding == ENCODING_LINEAR ? "1.0" : "srgb");
    if (!plain) {
        textAppend(pov, " <");
        appendQuoted(pov, base, length);
        textAppend(pov, " >");
        appendQuoted(pov, base, (size_t)stem);
        textAppend(pov, ".png");
    }
    textAppend(pov, "\n");
}

static void writeHeader(const Scene *scene, const char *name, double scale, Text *pov)
{
    writeCommand(scene, name, pov);
    textAppend(pov, "// Written by eclairage: the same picture, to the last bits of 16.\n");
    if (scale != 1) {
        textAppend(pov, "// All lengths are multiplied by ");
        textAppendPovNumber(pov, scale);
        textAppend(pov, ", since POV-Ray ignores what is nearer than 0.001 to a surface.\n");
    }
    textAppend(pov,
               "#version 3.7;\n"
               "global_settings { assumed_gamma 1 max_trace_level 5 adc_bailout 0 ambient_light rgb 0 }\n"
               "#default { finish { ambient 0 emission 0 diffuse 1 brilliance 1 phong 0 specular 0 "
               "reflection 0 } }\n\n");
}

/* Direction, right and up span exactly our picture plane; right-handed, and no angle. */
static void writeCamera(const Scene *scene, double scale, Text *pov)
{
    CameraFrame frame = cameraFrame(&scene->camera, scene->image.width, scene->image.height);
    textAppend(pov, "camera {\n  perspective\n  location ");
    textAppendPovVector(pov, frame.position, scale);
    textAppend(pov, "\n  direction ");
    textAppendPovVector(pov, frame.forward, 1);
    textAppend(pov, "\n  right ");
    textAppendPovVector(pov, frame.right, 1);
    textAppend(pov, "\n  up ");
    textAppendPovVector(pov, frame.up, 1);
    textAppend(pov, "\n}\n\n");
}

/* POV-Ray 3.7 fades by 2 / (1 + (d/D)^2). With D = 2^-20 and the colour times K = 1/(2 D^2), which is a
 * power of two and exact, that is 1 / (D^2 + d^2): within 1e-12 of 1/d^2. */
static Status writeLights(const Scene *scene, Finish finish, double scale, Text *pov)
{
    if (finish == FINISH_REFLECTION && scene->lightCount > 0)
        textAppend(pov, "#declare D = 1/1048576; // with fade_distance D and the color times K,\n"
                        "#declare K = 1/(2*D*D); // the light falls off by 1/d^2\n\n");
    for (size_t i = 0; i < scene->lightCount && finish != FINISH_UNLIT; i++) {
        const Light *light = &scene->lights[i];
        textAppend(pov, "light_source {\n  ");
        textAppendPovVector(pov, light->position, scale);
        textAppend(pov, "\n  ");
        if (finish == FINISH_LIT) {
            textAppend(pov, "rgb 1\n}\n\n");
            continue;
        }
        bool falls = light->falloff == FALLOFF_INVERSE_SQUARE;
        double brightest = fmax((double)light->color.r, fmax((double)light->color.g, (double)light->color.b));
        if (falls && brightest * scale * scale * 0x1p39 > (double)FLT_MAX)
            return statusError(
                STATUS_INEXPRESSIBLE,
                "light %zu is too bright for POV-Ray, which keeps colours in single precision; "
                "a colour below 1e26 can be exported",
                i + 1);
        appendColor(pov, light->color, falls ? scale * scale : 1);
        textAppend(pov, falls ? "*K\n  fade_distance D fade_power 2\n}\n\n" : "\n}\n\n");
    }
    return statusOk();
}

/* A material with a highlight is three layers, the last on top. The top one is half transparent and
 * twice as bright: the diffuse term. The middle one filters what lies below to the specular colour. The
 * bottom one is a white highlight. So each channel has its own highlight, exactly. */
static void writeMaterial(const Material *material, Finish finish, bool highlight, Text *pov)
{
    if (finish == FINISH_UNLIT || finish == FINISH_LIT) {
        textAppend(pov, "pigment { ");
        appendColor(pov, material->diffuse, 1);
        textAppend(pov, finish == FINISH_UNLIT ? " } finish { diffuse 0 emission 1 }"
                                               : " } finish { brilliance 0 }");
    } else if (!highlight) {
        textAppend(pov, "pigment { ");
        appendColor(pov, material->diffuse, 1);
        textAppend(pov, " }");
    } else {
        textAppend(pov, "texture { pigment { rgb 0 } finish { diffuse 0 phong 1 phong_size ");
        textAppendPovNumber(pov, (double)material->shininess);
        textAppend(pov, " } }\n  texture { pigment { ");
        appendColor(pov, material->specular, 2);
        textAppend(pov, " filter 1 } finish { diffuse 0 } }\n  texture { pigment { ");
        appendColor(pov, material->diffuse, 2);
        textAppend(pov, " transmit 0.5 } }");
    }
}

static void writeObjects(const Scene *scene, Finish finish, double scale, Text *pov)
{
    for (size_t i = 0; i < scene->objectCount; i++) {
        const Object *object = &scene->objects[i];
        objectShape(object)->writePov(object, scale, pov);
        textAppend(pov, "\n  ");
        bool highlight = scene->render.model == MODEL_PHONG && !colorIsBlack(object->material.specular);
        writeMaterial(&object->material, finish, highlight, pov);
        textAppend(pov, scene->render.shadows ? "\n}\n\n" : "\n  no_shadow\n}\n\n");
    }
}

Status exportPov(const Scene *scene, const char *name, Text *pov)
{
    /* Refuse what POV-Ray cannot say. */
    bool simple = scene->render.model == MODEL_SIMPLE;
    bool lightsMatter = scene->render.shadows && scene->lightCount > 0;
    if (!isnan(scene->render.shadowBias))
        return statusError(
            STATUS_INEXPRESSIBLE,
            "render.shadow_bias cannot be exported: POV-Ray's own bias is fixed; remove the key "
            "to compare with POV-Ray");
    if (simple && lightsMatter && scene->lightCount > 1)
        return statusError(STATUS_INEXPRESSIBLE,
                           "the simple model with several lights (here %zu) cannot be exported: POV-Ray adds "
                           "lights up, and the simple model does not; use one light, or shadows: false",
                           scene->lightCount);

    Finish finish = !simple ? FINISH_REFLECTION : lightsMatter ? FINISH_LIT : FINISH_UNLIT;
    double scale = povScale(scene);
    writeHeader(scene, name, scale, pov);
    textAppend(pov, "background { ");
    appendColor(pov, scene->background, 1);
    textAppend(pov, " }\n\n");
    writeCamera(scene, scale, pov);
    Status status = writeLights(scene, finish, scale, pov);
    if (!statusIsOk(&status))
        return status;
    writeObjects(scene, finish, scale, pov);
    return pov->failed ? statusOutOfMemory() : statusOk();
}
