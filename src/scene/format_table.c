/* format_table.c - the scene format, once; see format_table.h. */
#include "scene/format_table.h"

#include "raytracer.h"
#include "scene/format_rules.h"

#include <float.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof *(array))
#define KEYS(array) .keys = array, .keyCount = COUNT(array)
#define CHOICES(array) .choices = array, .choiceCount = COUNT(array)
#define ABOVE(limit)                                                                                         \
    {                                                                                                        \
        .low = LIMIT_EXCLUDED, .min = (limit)                                                                \
    }
#define AT_LEAST(limit)                                                                                      \
    {                                                                                                        \
        .low = LIMIT_INCLUDED, .min = (limit)                                                                \
    }
#define FROM_TO(least, most)                                                                                 \
    {                                                                                                        \
        .low = LIMIT_INCLUDED, .high = LIMIT_INCLUDED, .min = (least), .max = (most)                         \
    }
#define BETWEEN(low_, high_)                                                                                 \
    {                                                                                                        \
        .low = LIMIT_EXCLUDED, .high = LIMIT_EXCLUDED, .min = (low_), .max = (high_)                         \
    }

/* clang-format off */

const FormatRange colorRange = AT_LEAST(0);

/* ---- Choices ---- */

static const FormatChoice bitDepths[] = {
    {"8", 8, "256 steps a channel"},
    {"16", 16, "65,536 steps a channel"},
};

static const FormatChoice encodings[] = {
    {"srgb", ENCODING_SRGB, "by the curve of IEC 61966-2-1, as screens expect"},
    {"linear", ENCODING_LINEAR, "as computed; twice the number is twice the light"},
};

static const FormatChoice models[] = {
    {"simple", MODEL_SIMPLE, "the diffuse colour, unlit; black where shadows are on and no light reaches the point"},
    {"lambert", MODEL_LAMBERT, "diffuse reflection of the lights"},
    {"phong", MODEL_PHONG, "diffuse reflection and Phong's highlight"},
};

static const FormatChoice falloffs[] = {
    {"inverse_square", FALLOFF_INVERSE_SQUARE, "the light divided by the square of the distance"},
    {"none", FALLOFF_NONE, "the same light at every distance"},
};

/* ---- Materials ---- */

static const FormatKey materialKeys[] = {
    {"diffuse", FORMAT_COLOR, offsetof(Material, diffuse), "[0.8, 0.8, 0.8]",
     .help = "how much of the light the surface scatters to all sides, by colour"},
    {"specular", FORMAT_COLOR, offsetof(Material, specular), "[0, 0, 0]",
     .help = "how strong the highlight is, by colour"},
    {"shininess", FORMAT_FLOAT, offsetof(Material, shininess), "32", .range = AT_LEAST(0),
     .help = "the exponent of the highlight: a larger one makes it smaller and sharper"},
};

static const FormatMapping materialFormat = {
    "material", "what a surface does with light", KEYS(materialKeys)};

/* ---- Lights ---- */

static const FormatKey pointKeys[] = {
    {"position", FORMAT_POINT, offsetof(Light, position), .help = "where the light is"},
    {"color", FORMAT_COLOR, offsetof(Light, color), .help = "its colour and strength: what arrives at distance 1"},
    {"falloff", FORMAT_CHOICE, offsetof(Light, falloff), "inverse_square", CHOICES(falloffs),
     .help = "how the light weakens with the distance"},
};

static const FormatMapping pointFormat = {
    "point", "a point that shines the same to all sides", KEYS(pointKeys),
    .valuesSize = sizeof(Light), .finish = finishPoint};

static const FormatMapping *const lightKindList[] = {&pointFormat};
static const FormatKinds lightKinds = {"light", lightKindList, COUNT(lightKindList)};

/* ---- Objects ---- */

static const FormatKey objectKeys[] = {
    {"material", FORMAT_MATERIAL, offsetof(Object, material), .optional = true, .mapping = &materialFormat,
     .otherwise = "the default material",
     .help = "the surface: a name from `materials`, or a material written in place"},
};

#define OBJECT(array, finisher)                                                                              \
    KEYS(array), .common = objectKeys, .commonCount = COUNT(objectKeys), .valuesSize = sizeof(Object),       \
                                       .finish = (finisher)

static const FormatKey sphereKeys[] = {
    {"center", FORMAT_POINT, offsetof(Object, sphere.center), .help = "its middle"},
    {"radius", FORMAT_NUMBER, offsetof(Object, sphere.radius), .range = ABOVE(0), .help = "from the middle to the surface"},
};
static const FormatMapping sphereFormat = {
    "sphere", "all points at one distance from a centre", OBJECT(sphereKeys, finishSphere)};

static const FormatKey cubeKeys[] = {
    {"center", FORMAT_POINT, offsetof(Object, cube.center), .help = "its middle"},
    {"size", FORMAT_NUMBER, offsetof(Object, cube.size), .range = ABOVE(0), .help = "the length of an edge"},
};
static const FormatMapping cubeFormat = {
    "cube", "a block with equal edges, parallel to the axes", OBJECT(cubeKeys, finishCube)};

static const FormatKey boxKeys[] = {
    {"min", FORMAT_POINT, offsetof(Object, box.min), .help = "the corner with the smallest x, y and z"},
    {"max", FORMAT_POINT, offsetof(Object, box.max), .help = "the opposite corner: each coordinate above that of `min`"},
};
static const FormatMapping boxFormat = {
    "box", "a block between two corners, parallel to the axes", OBJECT(boxKeys, finishBox)};

static const FormatKey planeKeys[] = {
    {"point", FORMAT_POINT, offsetof(Object, plane.point), .help = "a point on it"},
    {"normal", FORMAT_DIRECTION, offsetof(Object, plane.normal), .help = "the direction it faces, of any length"},
};
static const FormatMapping planeFormat = {
    "plane", "a flat surface without end", OBJECT(planeKeys, finishPlane)};

static const FormatMapping *const objectKindList[] = {&sphereFormat, &cubeFormat, &boxFormat, &planeFormat};
static const FormatKinds objectKinds = {"object", objectKindList, COUNT(objectKindList)};

/* ---- Sections ---- */

static const FormatKey imageKeys[] = {
    {"width", FORMAT_INTEGER, offsetof(ImageSettings, width), "640", .range = FROM_TO(1, 65535),
     .help = "the picture's width in pixels"},
    {"height", FORMAT_INTEGER, offsetof(ImageSettings, height), "480", .range = FROM_TO(1, 65535),
     .help = "its height in pixels; width times height is at most 2,147,483,648"},
    {"bit_depth", FORMAT_INTEGER, offsetof(ImageSettings, bitDepth), "8", CHOICES(bitDepths),
     .help = "bits a channel in the PNG"},
    {"encoding", FORMAT_CHOICE, offsetof(ImageSettings, encoding), "srgb", CHOICES(encodings),
     .help = "how the PNG stores light"},
};
static const FormatMapping imageFormat = {
    "image", "the picture that is written", KEYS(imageKeys), .finish = finishImage};

static const FormatKey cameraKeys[] = {
    {"position", FORMAT_POINT, offsetof(CameraValues, position), "[0, 0, 0]", .help = "where the camera is"},
    {"look_at", FORMAT_POINT, offsetof(CameraValues, lookAt), .optional = true, .excludes = "direction",
     .otherwise = "`direction` counts", .help = "the point in the middle of the picture; not `position`"},
    {"direction", FORMAT_DIRECTION, offsetof(CameraValues, direction), "[0, 0, -1]", .excludes = "look_at",
     .help = "where the camera looks, of any length; in place of `look_at`"},
    {"up", FORMAT_DIRECTION, offsetof(CameraValues, up), "[0, 1, 0]",
     .help = "what is up in the picture; not parallel to the view"},
    {"fov", FORMAT_NUMBER, offsetof(CameraValues, fov), "60", .range = BETWEEN(0, 180),
     .help = "the angle of view from the lower to the upper edge, in degrees"},
};
static const FormatMapping cameraFormat = {
    "camera", "where the picture is taken from", KEYS(cameraKeys),
    .valuesSize = sizeof(CameraValues), .finish = finishCamera};

static const FormatKey renderKeys[] = {
    {"model", FORMAT_CHOICE, offsetof(RenderSettings, model), "phong", CHOICES(models),
     .help = "how surfaces return light"},
    {"shadows", FORMAT_BOOL, offsetof(RenderSettings, shadows), "true", .help = "whether objects keep light from others"},
    {"shadow_bias", FORMAT_NUMBER, offsetof(RenderSettings, shadowBias), .optional = true, .range = AT_LEAST(0),
     .otherwise = "the engine's own rule",
     .help = "a blocker counts when it is farther than this along the shadow ray, in scene units; 0 brings shadow "
             "acne back, for teaching; a scene that gives it cannot be exported to POV-Ray"},
};
static const FormatMapping renderFormat = {"render", "how light is computed", KEYS(renderKeys)};

static const FormatKey compareKeys[] = {
    {"fail", FORMAT_NUMBER, offsetof(Tolerance, fail), "0.004", .range = FROM_TO(0, 1),
     .help = "a pixel differs when one of its channels differs by more, in 0..1"},
    {"fail_percent", FORMAT_NUMBER, offsetof(Tolerance, failPercent), "0.1", .range = FROM_TO(0, 100),
     .help = "the share of differing pixels that is allowed, in percent"},
    {"hard_fail", FORMAT_NUMBER, offsetof(Tolerance, hardFail), "1.0", .range = FROM_TO(0, 1),
     .help = "no pixel may differ by more, in 0..1"},
    {"rmse", FORMAT_NUMBER, offsetof(Tolerance, rmse), .optional = true, .range = FROM_TO(0, 1),
     .otherwise = "no limit", .help = "the root of the mean squared difference is at most this"},
    {"ssim", FORMAT_NUMBER, offsetof(Tolerance, ssim), .optional = true, .range = FROM_TO(-1, 1),
     .otherwise = "no limit", .help = "the structural similarity is at least this"},
    {"flip", FORMAT_NUMBER, offsetof(Tolerance, flip), .optional = true, .range = FROM_TO(0, 1),
     .otherwise = "no limit", .help = "the mean of FLIP is at most this"},
};
static const FormatMapping compareFormat = {
    "compare", "how far the picture may be from POV-Ray's", KEYS(compareKeys)};

static const FormatKey sceneKeys[] = {
    {"image", FORMAT_MAPPING, offsetof(Scene, image), "{}", .mapping = &imageFormat, .help = "the picture that is written"},
    {"camera", FORMAT_MAPPING, offsetof(Scene, camera), "{}", .mapping = &cameraFormat, .help = "where the picture is taken from"},
    {"render", FORMAT_MAPPING, offsetof(Scene, render), "{}", .mapping = &renderFormat, .help = "how light is computed"},
    {"background", FORMAT_COLOR, offsetof(Scene, background.bottom), "[0, 0, 0]", .help = "what is seen where no object is"},
    {"materials", FORMAT_NAMED, 0, "{}", .mapping = &materialFormat, .help = "materials by name, for use by many objects"},
    {"lights", FORMAT_KINDS, 0, "[]", .kinds = &lightKinds, .help = "what shines"},
    {"objects", FORMAT_KINDS, 0, "[]", .kinds = &objectKinds, .help = "what is seen"},
    {"compare", FORMAT_MAPPING, offsetof(Scene, tolerance), "{}", .mapping = &compareFormat, .help = "how far the picture may be from POV-Ray's"},
};

const FormatMapping sceneFormat = {
    "scene", "a scene of Éclairage", KEYS(sceneKeys), .finish = NULL};

/* clang-format on */

_Static_assert(sizeof(Object) <= FORMAT_MAX_VALUES && sizeof(Light) <= FORMAT_MAX_VALUES &&
                   sizeof(CameraValues) <= FORMAT_MAX_VALUES,
               "values must fit");
_Static_assert(sizeof(Encoding) == sizeof(int) && sizeof(ShadingModel) == sizeof(int) &&
                   sizeof(Falloff) == sizeof(int),
               "a choice is stored as an int");

/* ---- Questions ---- */

static bool isName(const char *name, const char *text, size_t length)
{
    return strlen(name) == length && memcmp(name, text, length) == 0;
}

size_t findFormatKey(const FormatMapping *mapping, const char *name, size_t length)
{
    size_t i = 0;
    while (i < formatKeyCount(mapping) && !isName(formatKey(mapping, i)->name, name, length))
        i++;
    return i;
}

const FormatMapping *findFormatKind(const FormatKinds *kinds, const char *name, size_t length)
{
    for (size_t i = 0; i < kinds->count; i++)
        if (isName(kinds->kinds[i]->name, name, length))
            return kinds->kinds[i];
    return NULL;
}

bool isInFormatRange(const FormatRange *range, double value)
{
    bool lowOk =
        range->low == LIMIT_NONE || (range->low == LIMIT_INCLUDED ? value >= range->min : value > range->min);
    bool highOk = range->high == LIMIT_NONE ||
                  (range->high == LIMIT_INCLUDED ? value <= range->max : value < range->max);
    return lowOk && highOk;
}

void textAppendRange(Text *text, const FormatRange *range)
{
    if (range->low == LIMIT_INCLUDED && range->high == LIMIT_INCLUDED) {
        textAppend(text, "from ");
        textAppendDouble(text, range->min);
        textAppend(text, " to ");
        textAppendDouble(text, range->max);
        return;
    }
    if (range->low != LIMIT_NONE) {
        textAppend(text, range->low == LIMIT_INCLUDED ? "at least " : "above ");
        textAppendDouble(text, range->min);
    }
    if (range->high != LIMIT_NONE) {
        textAppend(text, range->low != LIMIT_NONE ? " and " : "");
        textAppend(text, range->high == LIMIT_INCLUDED ? "at most " : "below ");
        textAppendDouble(text, range->max);
    }
}

void textAppendChoices(Text *text, const FormatKey *key)
{
    for (size_t i = 0; i < key->choiceCount; i++)
        textAppendFormat(text, "%s%s",
                         i == 0                      ? ""
                         : i + 1 == key->choiceCount ? " or "
                                                     : ", ",
                         key->choices[i].word);
}

void textAppendExpectation(Text *text, const FormatKey *key)
{
    switch (key->type) {
    case FORMAT_NUMBER:
    case FORMAT_FLOAT:
        textAppend(text, "a number");
        break;
    case FORMAT_INTEGER:
    case FORMAT_CHOICE:
        if (key->choiceCount > 0)
            textAppendChoices(text, key);
        else
            textAppend(text, "a whole number");
        break;
    case FORMAT_BOOL:
        textAppend(text, "true or false");
        break;
    case FORMAT_POINT:
    case FORMAT_DIRECTION:
        textAppend(text, "a list of 3 numbers [x, y, z]");
        break;
    case FORMAT_COLOR:
        textAppend(text, "a colour: a list of 3 numbers [r, g, b], or one number for a grey");
        break;
    case FORMAT_MATERIAL:
        textAppend(text, "the name of a material, or a mapping {key: value}");
        break;
    case FORMAT_MAPPING:
        textAppend(text, "a mapping {key: value}");
        break;
    case FORMAT_NAMED:
        textAppend(text, "a mapping {name: {key: value}}");
        break;
    case FORMAT_KINDS:
        textAppend(text, "a list");
        break;
    }
    if (key->range.low != LIMIT_NONE || key->range.high != LIMIT_NONE) {
        textAppend(text, " ");
        textAppendRange(text, &key->range);
    }
}
