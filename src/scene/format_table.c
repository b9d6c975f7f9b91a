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
const FormatRange anyRange = {.low = LIMIT_NONE};

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
    {"blinn_phong", MODEL_BLINN_PHONG, "the same with Blinn's highlight, by the half vector"},
};

static const FormatChoice falloffs[] = {
    {"inverse_square", FALLOFF_INVERSE_SQUARE, "the light divided by the square of the distance"},
    {"none", FALLOFF_NONE, "the same light at every distance"},
};

static const FormatChoice projections[] = {
    {"perspective", PROJECTION_PERSPECTIVE, "what is far is small"},
    {"orthographic", PROJECTION_ORTHOGRAPHIC, "all rays are parallel, so that size does not depend on the distance"},
};

static const FormatChoice axes[] = {
    {"x", AXIS_X, "to the right"},
    {"y", AXIS_Y, "up"},
    {"z", AXIS_Z, "to the front"},
};

static const FormatChoice mappings[] = {
    {"planar", MAPPING_PLANAR, "u = x and v = y, repeated without end"},
    {"spherical", MAPPING_SPHERICAL, "round the origin: u by the angle round the y axis, v by the height"},
};

/* ---- Transforms ---- */

static const FormatKey rotateKeys[] = {
    {"axis", FORMAT_DIRECTION, offsetof(RotateValues, axis), .help = "the axis through the origin, of any length"},
    {"angle", FORMAT_NUMBER, offsetof(RotateValues, angle),
     .help = "in degrees, right-handed: anticlockwise for who looks against the axis"},
};
static const FormatMapping rotateFormat = {"rotate", "a turn round an axis through the origin", KEYS(rotateKeys)};

static const FormatKey matrixKeys[] = {
    {"x", FORMAT_POINT, offsetof(Matrix, x), .help = "where the x axis, [1, 0, 0], goes"},
    {"y", FORMAT_POINT, offsetof(Matrix, y), .help = "where the y axis goes"},
    {"z", FORMAT_POINT, offsetof(Matrix, z), .help = "where the z axis goes; the three do not lie in one plane"},
    {"translate", FORMAT_POINT, offsetof(Matrix, translate), .help = "where the origin goes"},
};
static const FormatMapping matrixFormat = {"matrix", "any affine map", KEYS(matrixKeys)};

static const FormatKey stepKeys[] = {
    {"translate", FORMAT_POINT, offsetof(StepValues, translate), .optional = true, .help = "move by this much"},
    {"scale", FORMAT_FACTORS, offsetof(StepValues, scale), .optional = true,
     .help = "make larger or smaller, from the origin; a negative factor mirrors"},
    {"rotate", FORMAT_MAPPING, offsetof(StepValues, rotate), .optional = true, .mapping = &rotateFormat,
     .help = "turn round an axis through the origin"},
    {"matrix", FORMAT_MAPPING, offsetof(StepValues, matrix), .optional = true, .mapping = &matrixFormat,
     .help = "the images of the three axes, then a translation"},
};
static const FormatMapping stepFormat = {
    "step", "a step of a `transform`, which is a list of steps: the first one acts first", KEYS(stepKeys),
    .oneKey = "begin each step with '- '", .isShared = true,
    .valuesSize = sizeof(StepValues), .finish = finishStep};

/* ---- Patterns ---- */

static const FormatKey patternKeys[] = {
    {"size", FORMAT_NUMBER, offsetof(PatternValues, pattern.size), "1", .range = ABOVE(0),
     .help = "the point is divided by this, so that a larger one makes the pattern larger"},
    {"transform", FORMAT_STEPS, offsetof(PatternValues, transform), "[]", .mapping = &stepFormat,
     .help = "steps that place the pattern on the object; they act after `size`"},
};

#define PATTERN(array, finisher)                                                                             \
    KEYS(array), .common = patternKeys, .commonCount = COUNT(patternKeys),                                   \
                                       .valuesSize = sizeof(PatternValues), .finish = (finisher)

static const FormatKey checkerKeys[] = {
    {"colors", FORMAT_COLOR, offsetof(PatternValues, pattern.colors), .count = 2,
     .help = "the first where floor(x) + floor(y) + floor(z) is even"},
};
static const FormatMapping checkerFormat = {
    "checker", "cubes of two colours in turn", PATTERN(checkerKeys, finishChecker)};

static const FormatKey stripesKeys[] = {
    {"colors", FORMAT_COLOR, offsetof(PatternValues, pattern.colors), .count = 2,
     .help = "the first where the fraction of the coordinate is below 1/2; a pair is `size` wide"},
    {"axis", FORMAT_CHOICE, offsetof(PatternValues, axis), "x", CHOICES(axes), .help = "across the stripes"},
};
static const FormatMapping stripesFormat = {
    "stripes", "stripes of two colours in turn", PATTERN(stripesKeys, finishStripes)};

static const FormatKey gradientKeys[] = {
    {"colors", FORMAT_COLOR, offsetof(PatternValues, pattern.colors), .count = 2,
     .help = "from the first to the second over each `size`, then from the first again"},
    {"axis", FORMAT_CHOICE, offsetof(PatternValues, axis), "x", CHOICES(axes), .help = "along the gradient"},
};
static const FormatMapping gradientFormat = {
    "gradient", "one colour that becomes another, again and again", PATTERN(gradientKeys, finishGradient)};

static const FormatKey imageFileKeys[] = {
    {"file", FORMAT_FILE, offsetof(PatternValues, file),
     .help = "a PNG, its path relative to the scene file; of 8 bits it is sRGB, its alpha is ignored; at most 2^26 pixels"},
    {"mapping", FORMAT_CHOICE, offsetof(PatternValues, pattern.mapping), "planar", CHOICES(mappings),
     .help = "how the picture lies on the object; each point has the nearest texel's colour"},
};
static const FormatMapping imageFileFormat = {
    "image", "a picture", PATTERN(imageFileKeys, finishImageFile)};

#define PATTERN_KEY(name, format, text)                                                                      \
    {                                                                                                        \
        name, FORMAT_MAPPING, 0, .optional = true, .mapping = &(format), .help = (text)                      \
    }
static const FormatKey patternKindKeys[] = {
    PATTERN_KEY("checker", checkerFormat, "cubes of two colours in turn"),
    PATTERN_KEY("stripes", stripesFormat, "stripes of two colours in turn"),
    PATTERN_KEY("gradient", gradientFormat, "one colour that becomes another, again and again"),
    PATTERN_KEY("image", imageFileFormat, "a picture"),
};
static const FormatMapping patternFormat = {
    "pattern", "a diffuse colour that depends on the point, in the coordinates in which the object's keys are "
    "written, before its `transform` and those of its groups", KEYS(patternKindKeys),
    .oneKey = "keep one of the two", .isShared = true};

/* ---- Materials ---- */

static const FormatKey materialKeys[] = {
    {"diffuse", FORMAT_COLOR, offsetof(Material, diffuse), "[0.8, 0.8, 0.8]",
     .help = "how much of the light the surface scatters to all sides, by colour"},
    {"specular", FORMAT_COLOR, offsetof(Material, specular), "[0, 0, 0]",
     .help = "how strong the highlight is, by colour"},
    {"shininess", FORMAT_FLOAT, offsetof(Material, shininess), "32", .range = AT_LEAST(0),
     .help = "the exponent of the highlight: a larger one makes it smaller and sharper"},
    {"ambient", FORMAT_COLOR, offsetof(Material, ambient), "[0, 0, 0]",
     .help = "how much it returns of the light from everywhere, `ambient` of the section `render`"},
    {"emission", FORMAT_COLOR, offsetof(Material, emission), "[0, 0, 0]",
     .help = "light of its own; it lights nothing else"},
    {"reflection", FORMAT_COLOR, offsetof(Material, reflection), "[0, 0, 0]",
     .help = "share of what comes along the mirrored ray"},
    {"transmission", FORMAT_COLOR, offsetof(Material, transmission), "[0, 0, 0]",
     .help = "share of what comes along the refracted ray; above 0 the object is transparent"},
    {"ior", FORMAT_FLOAT, offsetof(Material, ior), "1", .range = ABOVE(0),
     .help = "index of refraction, where there is a transmission: 1 does not bend, water has 1.33, glass 1.5"},
    {"model", FORMAT_CHOICE, offsetof(Material, model), CHOICES(models), .optional = true,
     .otherwise = "the scene's model", .help = "how this surface returns light"},
    {"pattern", FORMAT_MAPPING, offsetof(Material, pattern), .optional = true, .mapping = &patternFormat,
     .otherwise = "`diffuse` everywhere", .help = "takes the place of `diffuse`, point by point"},
};

static const FormatMapping materialFormat = {
    "material", "what a surface does with light", KEYS(materialKeys), .isShared = true};

/* ---- Lights ---- */

#define FALLOFF_KEY                                                                                          \
    {"falloff", FORMAT_CHOICE, offsetof(LightValues, light.falloff), "inverse_square", CHOICES(falloffs),    \
     .help = "how the light weakens with the distance"}
#define LIGHT(array, finisher) KEYS(array), .valuesSize = sizeof(LightValues), .finish = (finisher)

static const FormatKey pointKeys[] = {
    {"position", FORMAT_POINT, offsetof(LightValues, light.position), .help = "where the light is"},
    {"color", FORMAT_COLOR, offsetof(LightValues, light.color), .help = "its colour and strength: what arrives at distance 1"},
    FALLOFF_KEY,
};
static const FormatMapping pointFormat = {
    "point", "a point that shines the same to all sides", LIGHT(pointKeys, finishPoint)};

static const FormatKey directionalKeys[] = {
    {"direction", FORMAT_DIRECTION, offsetof(LightValues, light.direction), .help = "the way the light travels, of any length"},
    {"color", FORMAT_COLOR, offsetof(LightValues, light.color), .help = "its colour and strength: what arrives everywhere"},
};
static const FormatMapping directionalFormat = {
    "directional", "light from infinitely far, such as the sun's", LIGHT(directionalKeys, finishDirectional)};

static const FormatKey spotKeys[] = {
    {"position", FORMAT_POINT, offsetof(LightValues, light.position), .help = "where the light is"},
    {"look_at", FORMAT_POINT, offsetof(LightValues, lookAt), .help = "a point on the cone's axis; not `position`"},
    {"color", FORMAT_COLOR, offsetof(LightValues, light.color), .help = "its colour and strength: what arrives on the axis at distance 1"},
    FALLOFF_KEY,
    {"inner_angle", FORMAT_NUMBER, offsetof(LightValues, light.innerAngle), .range = FROM_TO(0, 90),
     .help = "full strength up to this angle from the axis, in degrees; at most `outer_angle`"},
    {"outer_angle", FORMAT_NUMBER, offsetof(LightValues, light.outerAngle), .range = FROM_TO(0, 90),
     .help = "no light from this angle from the axis on, in degrees; between the two it fades smoothly"},
    {"tightness", FORMAT_NUMBER, offsetof(LightValues, light.tightness), "0", .range = AT_LEAST(0),
     .help = "the light is also multiplied by the cosine of the angle to this power"},
};
static const FormatMapping spotFormat = {
    "spot", "a point that shines in a cone", LIGHT(spotKeys, finishSpot)};

static const FormatKey areaKeys[] = {
    {"center", FORMAT_POINT, offsetof(LightValues, light.position), .help = "the middle of the parallelogram"},
    {"edge_u", FORMAT_POINT, offsetof(LightValues, light.edgeU), .help = "one whole side, as a vector"},
    {"edge_v", FORMAT_POINT, offsetof(LightValues, light.edgeV), .help = "the other whole side"},
    {"samples", FORMAT_INTEGER, offsetof(LightValues, samples), .count = 2, .range = FROM_TO(1, 256),
     .help = "point lights along `edge_u` and along `edge_v`, the outermost on the border; 1 is in the middle"},
    {"color", FORMAT_COLOR, offsetof(LightValues, light.color), .help = "colour and strength of all of it: what arrives at distance 1"},
    FALLOFF_KEY,
};
static const FormatMapping areaFormat = {
    "area", "a parallelogram that shines, as the mean of a grid of point lights", LIGHT(areaKeys, finishArea)};

static const FormatMapping *const lightKindList[] = {&pointFormat, &directionalFormat, &spotFormat, &areaFormat};
static const FormatKinds lightKinds = {"light", lightKindList, COUNT(lightKindList)};

/* ---- Objects ---- */

static const FormatKinds objectKinds;

static const FormatKey objectKeys[] = {
    {"material", FORMAT_MATERIAL, offsetof(ObjectValues, object.material), .optional = true, .mapping = &materialFormat,
     .otherwise = "that of the nearest group or solid round it, else the default material",
     .help = "the surface: a name from `materials`, or a material written in place"},
    {"transform", FORMAT_STEPS, offsetof(ObjectValues, transform), "[]", .mapping = &stepFormat,
     .help = "steps that move, turn, stretch the object; they act before those of its group"},
    {"casts_shadow", FORMAT_BOOL, offsetof(ObjectValues, castsShadow), "true",
     .help = "whether it keeps light from others; false of a group or solid holds for all in it"},
};

#define OBJECT(array, finisher)                                                                              \
    KEYS(array), .common = objectKeys, .commonCount = COUNT(objectKeys), .valuesSize = sizeof(ObjectValues), \
                                       .finish = (finisher)

static const FormatKey sphereKeys[] = {
    {"center", FORMAT_POINT, offsetof(ObjectValues, object.sphere.center), .help = "its middle"},
    {"radius", FORMAT_NUMBER, offsetof(ObjectValues, object.sphere.radius), .range = ABOVE(0), .help = "from the middle to the surface"},
};
static const FormatMapping sphereFormat = {
    "sphere", "all points at one distance from a centre", OBJECT(sphereKeys, finishSphere)};

static const FormatKey cubeKeys[] = {
    {"center", FORMAT_POINT, offsetof(ObjectValues, object.cube.center), .help = "its middle"},
    {"size", FORMAT_NUMBER, offsetof(ObjectValues, object.cube.size), .range = ABOVE(0), .help = "the length of an edge"},
};
static const FormatMapping cubeFormat = {
    "cube", "a block with equal edges, parallel to the axes", OBJECT(cubeKeys, finishCube)};

static const FormatKey boxKeys[] = {
    {"min", FORMAT_POINT, offsetof(ObjectValues, object.box.min), .help = "the corner with the smallest x, y and z"},
    {"max", FORMAT_POINT, offsetof(ObjectValues, object.box.max), .help = "the opposite corner: each coordinate above that of `min`"},
};
static const FormatMapping boxFormat = {
    "box", "a block between two corners, parallel to the axes", OBJECT(boxKeys, finishBox)};

static const FormatKey planeKeys[] = {
    {"point", FORMAT_POINT, offsetof(ObjectValues, object.plane.point), .help = "a point on it"},
    {"normal", FORMAT_DIRECTION, offsetof(ObjectValues, object.plane.normal), .help = "the direction it faces, of any length"},
};
static const FormatMapping planeFormat = {
    "plane", "a flat surface without end; as a part of a solid, all that lies behind it", OBJECT(planeKeys, finishPlane)};

static const FormatKey triangleKeys[] = {
    {"vertices", FORMAT_POINT, offsetof(ObjectValues, object.triangle.vertices), .count = 3,
     .help = "its corners, not on one line"},
    {"normals", FORMAT_DIRECTION, offsetof(ObjectValues, object.triangle.normals), .count = 3, .optional = true,
     .otherwise = "flat", .help = "a normal for each corner, of any length; between them it is interpolated"},
};
static const FormatMapping triangleFormat = {"triangle", "a triangle", OBJECT(triangleKeys, finishTriangle)};

static const FormatKey meshKeys[] = {
    {"file", FORMAT_FILE, offsetof(ObjectValues, file), .help = "a Wavefront OBJ, its path relative to the scene file"},
    {"smooth", FORMAT_BOOL, offsetof(ObjectValues, smooth), "true",
     .help = "whether normals are interpolated: the file's, else the angle-weighted mean of the faces round a "
             "point; false is flat"},
};
static const FormatMapping meshFormat = {"mesh", "many triangles, from a file", OBJECT(meshKeys, finishMesh)};

#define OPEN_KEY                                                                                             \
    {"open", FORMAT_BOOL, offsetof(ObjectValues, object.cone.isOpen), "false", .help = "without the discs at the ends"}

static const FormatKey cylinderKeys[] = {
    {"base", FORMAT_POINT, offsetof(ObjectValues, object.cone.base), .help = "one end of the axis"},
    {"top", FORMAT_POINT, offsetof(ObjectValues, object.cone.top), .help = "the other end; not `base`"},
    {"radius", FORMAT_NUMBER, offsetof(ObjectValues, object.cone.baseRadius), .range = ABOVE(0), .help = "from the axis to the surface"},
    OPEN_KEY,
};
static const FormatMapping cylinderFormat = {
    "cylinder", "a round column", OBJECT(cylinderKeys, finishCylinder)};

static const FormatKey coneKeys[] = {
    {"base", FORMAT_POINT, offsetof(ObjectValues, object.cone.base), .help = "one end of the axis"},
    {"top", FORMAT_POINT, offsetof(ObjectValues, object.cone.top), .help = "the other end; not `base`"},
    {"base_radius", FORMAT_NUMBER, offsetof(ObjectValues, object.cone.baseRadius), .range = AT_LEAST(0), .help = "at `base`"},
    {"top_radius", FORMAT_NUMBER, offsetof(ObjectValues, object.cone.topRadius), .range = AT_LEAST(0),
     .help = "at `top`; not both are 0"},
    OPEN_KEY,
};
static const FormatMapping coneFormat = {
    "cone", "a circle that changes its radius along an axis", OBJECT(coneKeys, finishCone)};

static const FormatKey discKeys[] = {
    {"center", FORMAT_POINT, offsetof(ObjectValues, object.disc.center), .help = "its middle"},
    {"normal", FORMAT_DIRECTION, offsetof(ObjectValues, object.disc.normal), .help = "the direction it faces, of any length"},
    {"radius", FORMAT_NUMBER, offsetof(ObjectValues, object.disc.radius), .range = ABOVE(0), .help = "from the middle to the rim"},
    {"inner_radius", FORMAT_NUMBER, offsetof(ObjectValues, object.disc.innerRadius), "0", .range = AT_LEAST(0),
     .help = "of a hole in the middle; below `radius`"},
};
static const FormatMapping discFormat = {"disc", "a flat round plate", OBJECT(discKeys, finishDisc)};

static const FormatKey torusKeys[] = {
    {"major_radius", FORMAT_NUMBER, offsetof(ObjectValues, object.torus.majorRadius), .range = ABOVE(0),
     .help = "of the circle in the middle of the ring"},
    {"minor_radius", FORMAT_NUMBER, offsetof(ObjectValues, object.torus.minorRadius), .range = ABOVE(0),
     .help = "of the ring itself; at most `major_radius`"},
};
static const FormatMapping torusFormat = {
    "torus", "a ring round the y axis, at the origin", OBJECT(torusKeys, finishTorus)};

static const FormatKey spheresKeys[] = {
    {"data", FORMAT_SPHERES, offsetof(ObjectValues, rows), .optional = true, .range = ABOVE(0), .excludes = "file",
     .otherwise = "`file` counts", .help = "centre and radius of each"},
    {"file", FORMAT_FILE, offsetof(ObjectValues, file), .optional = true, .excludes = "data", .otherwise = "`data` counts",
     .help = "a text file with four numbers a line, x y z r; its path is relative to the scene file"},
};
const FormatKey *const rowsFormatKey = &spheresKeys[0];
static const FormatMapping spheresFormat = {
    "spheres", "many spheres with one material", OBJECT(spheresKeys, finishSpheres), .enter = enterSpheres};

#define PARTS(atLeast, text)                                                                                 \
    {                                                                                                        \
        {                                                                                                    \
            "objects", FORMAT_KINDS, 0, .kinds = &objectKinds, .least = (atLeast), .help = (text)            \
        }                                                                                                    \
    }
static const FormatKey groupKeys[] = PARTS(1, "what is in it");
static const FormatMapping groupFormat = {
    "group", "objects that have a material, a transform or no shadow in common; what they hide of one another stays",
    OBJECT(groupKeys, finishGroup), .enter = enterGroup};

static const FormatKey unionKeys[] = PARTS(1, "its parts, each with an inside");
static const FormatMapping unionFormat = {
    "union", "a solid: what is in any part, without the surfaces inside", OBJECT(unionKeys, finishGroup),
    .enter = enterUnion};

static const FormatKey intersectionKeys[] = PARTS(1, "its parts, each with an inside");
static const FormatMapping intersectionFormat = {
    "intersection", "a solid: what is in all parts", OBJECT(intersectionKeys, finishGroup),
    .enter = enterIntersection};

static const FormatKey differenceKeys[] = PARTS(2, "its parts, each with an inside; the first minus the others");
static const FormatMapping differenceFormat = {
    "difference", "a solid: what is in the first part and in none of the others; a cut shows the cutter's material",
    OBJECT(differenceKeys, finishGroup), .enter = enterDifference};

static const FormatMapping *const objectKindList[] = {
    &sphereFormat, &cubeFormat, &boxFormat, &planeFormat, &triangleFormat, &meshFormat, &cylinderFormat,
    &coneFormat, &discFormat, &torusFormat, &spheresFormat, &groupFormat, &unionFormat, &intersectionFormat,
    &differenceFormat};
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
     .help = "the angle of view from the lower to the upper edge, in degrees; of a perspective camera"},
    {"projection", FORMAT_CHOICE, offsetof(CameraValues, projection), "perspective", CHOICES(projections),
     .help = "how rays leave the camera"},
    {"view_height", FORMAT_NUMBER, offsetof(CameraValues, viewHeight), .optional = true, .range = ABOVE(0),
     .otherwise = "none, as the camera is not orthographic",
     .help = "the height of the picture in scene units; required of an orthographic camera, an error for another"},
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
    {"samples", FORMAT_INTEGER, offsetof(RenderSettings, samples), "1", .range = FROM_TO(1, 64),
     .help = "n for n times n rays a pixel, on a regular grid"},
    {"max_depth", FORMAT_INTEGER, offsetof(RenderSettings, maxDepth), "5", .range = FROM_TO(1, 256),
     .help = "rays in a chain of mirrored and refracted ones, the camera's counts 1; what a ray past it sees is black"},
    {"ambient", FORMAT_COLOR, offsetof(RenderSettings, ambient), "[0, 0, 0]",
     .help = "light from everywhere, of which a material returns its `ambient`"},
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

static const FormatKey skyKeys[] = {
    {"bottom", FORMAT_COLOR, offsetof(Background, bottom), .help = "straight down"},
    {"top", FORMAT_COLOR, offsetof(Background, top), .help = "straight up"},
};
static const FormatMapping skyFormat = {
    "gradient", "two colours, mixed by (1 + y) / 2 of the ray's unit direction", KEYS(skyKeys), .finish = finishSky};

static const FormatKey backgroundKeys[] = {
    {"gradient", FORMAT_MAPPING, 0, .optional = true, .mapping = &skyFormat,
     .help = "two colours, mixed by (1 + y) / 2 of the ray's unit direction"},
};
static const FormatMapping backgroundFormat = {
    "background", "a background that is not one colour", KEYS(backgroundKeys), .oneKey = "keep one of the two"};

static const FormatKey fogKeys[] = {
    {"color", FORMAT_COLOR, offsetof(Fog, color), .help = "what is seen of something far away, and of the background"},
    {"distance", FORMAT_NUMBER, offsetof(Fog, distance), .range = ABOVE(0),
     .help = "at this distance 1/e, 37 percent, is still seen; it is exp(-d / distance) at the distance d"},
};
static const FormatMapping fogFormat = {
    "fog", "haze between a ray's origin and what it sees; light on its way to a surface is not dimmed", KEYS(fogKeys)};

static const FormatKey sceneKeys[] = {
    {"image", FORMAT_MAPPING, offsetof(Scene, image), "{}", .mapping = &imageFormat, .help = "the picture that is written"},
    {"camera", FORMAT_MAPPING, offsetof(Scene, camera), "{}", .mapping = &cameraFormat, .help = "where the picture is taken from"},
    {"render", FORMAT_MAPPING, offsetof(Scene, render), "{}", .mapping = &renderFormat, .help = "how light is computed"},
    {"background", FORMAT_COLOR, offsetof(Scene, background), "[0, 0, 0]", .mapping = &backgroundFormat, .help = "what is seen where no object is"},
    {"fog", FORMAT_MAPPING, offsetof(Scene, fog), .optional = true, .mapping = &fogFormat, .otherwise = "no fog",
     .help = "haze between a ray's origin and what it sees; light on its way to a surface is not dimmed"},
    {"materials", FORMAT_NAMED, 0, "{}", .mapping = &materialFormat, .help = "materials by name, for use by many objects"},
    {"lights", FORMAT_KINDS, 0, "[]", .kinds = &lightKinds, .help = "what shines"},
    {"objects", FORMAT_KINDS, 0, "[]", .kinds = &objectKinds, .help = "what is seen"},
    {"compare", FORMAT_MAPPING, offsetof(Scene, tolerance), "{}", .mapping = &compareFormat, .help = "how far the picture may be from POV-Ray's"},
};

const FormatMapping sceneFormat = {
    "scene", "a scene of Éclairage", KEYS(sceneKeys), .finish = NULL};

/* clang-format on */

_Static_assert(sizeof(ObjectValues) <= FORMAT_MAX_VALUES && sizeof(LightValues) <= FORMAT_MAX_VALUES &&
                   sizeof(CameraValues) <= FORMAT_MAX_VALUES && sizeof(PatternValues) <= FORMAT_MAX_VALUES &&
                   sizeof(StepValues) <= FORMAT_MAX_VALUES,
               "values must fit");
_Static_assert(sizeof(Encoding) == sizeof(int) && sizeof(ShadingModel) == sizeof(int) &&
                   sizeof(Falloff) == sizeof(int) && sizeof(Projection) == sizeof(int) &&
                   sizeof(PatternMapping) == sizeof(int) && sizeof(PatternAxis) == sizeof(int),
               "a choice is stored as an int");
_Static_assert(offsetof(Background, bottom) == 0, "a background that is one colour is read as its bottom");
_Static_assert(MODEL_OF_SCENE == 0, "a choice that is left out is 0");
