/* story_svg.c - the rays of a pixel seen from the side; see story_writers.h.
 *
 * The drawing's plane holds the camera's ray and the light that matters most. Objects are drawn as the plane
 * cuts them, all else as its projection onto the plane: a vector that leaves the plane is drawn shorter.
 */
#include "explain/cut_outline.h"
#include "explain/side_view.h"
#include "explain/story_writers.h"
#include "explain/svg_labels.h"
#include "explain/svg_pieces.h"

#include <string.h>

enum {
    WIDTH = 720, /* about the column of a page, so that the words are as large as the page's */
    LEFT = 16,
    TOP = 64,
    VIEW_WIDTH = 688,
    VIEW_HEIGHT = 460,
    VECTOR_LENGTH = 84, /* of a unit vector in the plane */
    MOST_OBJECTS = 24,
    MOST_RAYS_DRAWN = 40,
    MOST_SHADOW_RAYS = 12,
    DISTANCE_DIGITS = 4
};

#define CAMERA_COLOR "#b45309"
#define LIGHT_COLOR "#a16207"
#define BLOCKED_COLOR "#c81e1e"
#define MIRROR_COLOR "#1d4ed8"
#define REFRACTED_COLOR "#0f766e"
#define NORMAL_COLOR "#15803d"
#define VIEW_COLOR "#6d28d9"
#define HIGHLIGHT_COLOR "#be185d"
#define INK "#1f2328"
#define DARK_STROKE "stroke=\"#6e7781\" stroke-width=\"1.4\" stroke-dasharray=\"1.5 5\""

typedef struct Drawing {
    const PixelStory *story;
    Text *text;
    DrawingPlane plane;
    const LightStory *light; /* the one in the plane, or NULL */
    const Object *objects[MOST_OBJECTS];
    size_t objectCount;
    LabelBoard board; /* its labels are drawn last, above everything */
    int raysDrawn;
    bool hasMirrored, hasRefracted, hasBlocked, hasReaching, hasDark, hasOmitted;
} Drawing;

static void drawLine(Drawing *drawing, DrawnPoint a, DrawnPoint b, const char *attributes)
{
    appendLine(drawing->text, a, b, attributes);
    keepOffLine(&drawing->board, a, b);
}

/* The part of the line from a towards b that is seen, a being inside. */
static DrawnPoint clipped(DrawnPoint a, DrawnPoint b, double inset)
{
    double t = 1;
    const double low[2] = {LEFT + inset, TOP + inset};
    const double high[2] = {LEFT + VIEW_WIDTH - inset, TOP + VIEW_HEIGHT - inset};
    const double from[2] = {a.x, a.y}, way[2] = {b.x - a.x, b.y - a.y};
    for (int i = 0; i < 2; i++) {
        if (from[i] + way[i] > high[i] && way[i] > 0)
            t = fmin(t, (high[i] - from[i]) / way[i]);
        if (from[i] + way[i] < low[i] && way[i] < 0)
            t = fmin(t, (low[i] - from[i]) / way[i]);
    }
    t = fmax(t, 0);
    return (DrawnPoint){a.x + t * way[0], a.y + t * way[1]};
}

/* ---- Objects ---- */

static void wantObject(Drawing *drawing, const Object *object)
{
    if (object == NULL)
        return;
    for (size_t i = 0; i < drawing->objectCount; i++)
        if (drawing->objects[i] == object)
            return;
    if (drawing->objectCount < MOST_OBJECTS)
        drawing->objects[drawing->objectCount++] = object;
    else
        drawing->hasOmitted = true;
}

/* Those that the story speaks of first, then the others of the scene. */
static void wantObjectsOf(Drawing *drawing, const RayStory *ray)
{
    if (ray == NULL)
        return;
    if (ray->end == RAY_MEETS_SURFACE) {
        wantObject(drawing, ray->point.object);
        for (size_t i = 0; i < ray->lightCount; i++) {
            wantObject(drawing, ray->lights[i].blocker);
            for (size_t c = 0; c < ray->lights[i].crossingCount && c < MOST_CROSSINGS; c++)
                wantObject(drawing, ray->lights[i].crossings[c].object);
        }
    }
    wantObjectsOf(drawing, ray->refracted);
    wantObjectsOf(drawing, ray->mirrored);
    for (size_t i = 0; i < ray->triedCount; i++)
        if (ray->tried[i].part != NULL)
            wantObject(drawing, ray->tried[i].object);
}

static void appendFill(Text *text, const Object *object)
{
    const Material *material = &object->material;
    if (object->kind == SHAPE_CSG)
        material = &object->csg.parts[0].material;
    Color3f c = material->pattern != NULL ? createColor(0.5f, 0.5f, 0.5f) : material->diffuse;
    textAppendFormat(text, "#%02x%02x%02x", quantizeSample(c.r, 8, ENCODING_SRGB),
                     quantizeSample(c.g, 8, ENCODING_SRGB), quantizeSample(c.b, 8, ENCODING_SRGB));
}

/* A sphere: the exact circle of the cut, or, beside the plane, its silhouette. */
static bool drawSphere(Drawing *drawing, const Object *object, DrawnPoint box[2])
{
    const DrawingPlane *plane = &drawing->plane;
    Vector3D center = object->sphere.center;
    double radius = object->sphere.radius;
    double away = dot(subVectors(center, plane->origin), plane->normal);
    bool isCut = fabs(away) < radius;
    double drawn = (isCut ? sqrt(radius * radius - away * away) : radius) * plane->scale;
    DrawnPoint at = drawnPoint(plane, center);
    if (!(drawn < 5e4) || at.x + drawn < LEFT || at.x - drawn > LEFT + VIEW_WIDTH || at.y + drawn < TOP ||
        at.y - drawn > TOP + VIEW_HEIGHT)
        return false;
    box[0] = (DrawnPoint){at.x - drawn, at.y - drawn};
    box[1] = (DrawnPoint){at.x + drawn, at.y + drawn};
    textAppend(drawing->text, "<g fill=\"");
    appendFill(drawing->text, object);
    textAppend(drawing->text, "\">");
    appendCircle(drawing->text, at, drawn,
                 isCut ? "fill-opacity=\"0.22\" stroke=\"#57606a\" stroke-width=\"1.5\""
                       : "fill-opacity=\"0.05\" stroke=\"#8c959f\" stroke-dasharray=\"2 4\"");
    textAppend(drawing->text, "</g>\n");
    return true;
}

static bool drawCut(Drawing *drawing, const Object *object, DrawnPoint box[2])
{
    Text path = {0};
    CutKind kind = appendCutPath(&drawing->plane, object, &path, box);
    Text *text = drawing->text;
    if (kind == CUT_AREA) {
        textAppend(text, "<path fill=\"");
        appendFill(text, object);
        textAppend(text, "\" fill-opacity=\"0.22\" fill-rule=\"evenodd\" stroke=\"#57606a\" "
                         "stroke-width=\"1.5\" d=\"");
    } else if (kind == CUT_DOTS) {
        textAppend(text, "<path fill=\"none\" stroke=\"#57606a\" stroke-width=\"2.2\" "
                         "stroke-linecap=\"round\" d=\"");
    }
    if (kind != CUT_NOTHING) {
        textAppend(text, textString(&path));
        textAppend(text, "\"/>\n");
    }
    text->failed = text->failed || path.failed;
    textFree(&path);
    return kind != CUT_NOTHING;
}

/* A speck gets no name: among others nobody could tell whose it is. */
static bool isLargeEnough(const DrawnPoint box[2])
{
    return fmax(box[1].x - box[0].x, box[1].y - box[0].y) >= 18;
}

static void labelObject(Drawing *drawing, const Object *object, const DrawnPoint box[2])
{
    Text name = {0};
    textAppend(&name, objectKindName(object));
    if (object->line > 0)
        textAppendFormat(&name, ", line %d", object->line);
    double left = fmax(box[0].x, LEFT), right = fmin(box[1].x, LEFT + VIEW_WIDTH);
    double top = fmax(box[0].y, TOP), bottom = fmin(box[1].y, TOP + VIEW_HEIGHT);
    DrawnPoint at = {(left + right) / 2, (top + bottom) / 2};
    askForLabel(&drawing->board, at, textString(&name), "#57606a", true, false);
    drawing->text->failed = drawing->text->failed || name.failed;
    textFree(&name);
}

/* ---- Rays and lights ---- */

static void drawArrow(Drawing *drawing, DrawnPoint from, Vector3D v, const char *color, const char *marker,
                      const char *name)
{
    const DrawingPlane *plane = &drawing->plane;
    DrawnPoint to = {from.x + dot(v, plane->right) * VECTOR_LENGTH,
                     from.y - dot(v, plane->up) * VECTOR_LENGTH};
    Text attributes = {0};
    textAppendFormat(&attributes, "stroke=\"%s\" stroke-width=\"2.5\" marker-end=\"url(#%s)\"", color,
                     marker);
    drawLine(drawing, from, to, textString(&attributes));
    textFree(&attributes);
    double length = hypot(to.x - from.x, to.y - from.y);
    if (length > 1)
        to = (DrawnPoint){to.x + (to.x - from.x) / length * 12, to.y + (to.y - from.y) / length * 12};
    askForLabel(&drawing->board, to, name, color, true, true);
}

static void drawVectors(Drawing *drawing)
{
    const RayStory *ray = drawing->story->ray;
    DrawnPoint p = drawnPoint(&drawing->plane, ray->point.position);
    drawArrow(drawing, p, ray->point.normal, NORMAL_COLOR, "arrow-n", "N");
    drawArrow(drawing, p, multVector(ray->ray.direction, -1), VIEW_COLOR, "arrow-v", "V");
    const LightStory *light = drawing->light;
    if (light == NULL)
        return;
    drawArrow(drawing, p, light->arriving.direction, LIGHT_COLOR, "arrow-l", "L");
    if (light->hasHighlight)
        drawArrow(drawing, p, light->r, HIGHLIGHT_COLOR, "arrow-r", ray->model == MODEL_PHONG ? "R" : "H");
}

/* A light as a small sun. */
static void drawSun(Drawing *drawing, DrawnPoint at, const Light *lamp, size_t number, double distance,
                    bool isOutside)
{
    if (!isOutside) {
        for (int i = 0; i < 8; i++) {
            double angle = i * 0.78539816339744831;
            DrawnPoint from = {at.x + 9 * cos(angle), at.y + 9 * sin(angle)};
            DrawnPoint to = {at.x + 14 * cos(angle), at.y + 14 * sin(angle)};
            drawLine(drawing, from, to, "stroke=\"" LIGHT_COLOR "\" stroke-width=\"2\"");
        }
        appendCircle(drawing->text, at, 6.5,
                     "fill=\"#facc15\" stroke=\"" LIGHT_COLOR "\" stroke-width=\"1.5\"");
        keepOffMark(&drawing->board, at, 14);
    }
    Text name = {0};
    textAppendFormat(&name, "light %zu, %s", number + 1, lightKindName(lamp));
    if (isOutside && isfinite(distance)) {
        textAppend(&name, ", at distance ");
        textAppendRounded(&name, distance, DISTANCE_DIGITS);
    } else if (isOutside) {
        textAppend(&name, ", from infinitely far");
    }
    askForLabel(&drawing->board, at, textString(&name), LIGHT_COLOR, false, true);
    textFree(&name);
}

/* The way from a point to a light; dashed and red behind what blocks it. */
static void drawShadowRay(Drawing *drawing, DrawnPoint p, const LightStory *light, DrawnPoint end)
{
    const char *free = "stroke=\"" LIGHT_COLOR "\" stroke-width=\"1.6\"";
    if (light->fate == LIGHT_REACHES && (light->hasShadowRay || light->arriving.distance > 0)) {
        drawing->hasReaching = true;
        drawLine(drawing, p, end, free);
        return;
    }
    if (light->fate == LIGHT_BLOCKED && light->blocker != NULL) {
        drawing->hasBlocked = true;
        DrawnPoint at = drawnPoint(&drawing->plane, pointOnRay(&light->shadow.ray, light->blockedAt));
        drawLine(drawing, p, end,
                 "stroke=\"" BLOCKED_COLOR "\" stroke-width=\"1.8\" stroke-dasharray=\"7 5\"");
        drawLine(drawing, (DrawnPoint){at.x - 6, at.y - 6}, (DrawnPoint){at.x + 6, at.y + 6},
                 "stroke=\"" BLOCKED_COLOR "\" stroke-width=\"3\"");
        drawLine(drawing, (DrawnPoint){at.x - 6, at.y + 6}, (DrawnPoint){at.x + 6, at.y - 6},
                 "stroke=\"" BLOCKED_COLOR "\" stroke-width=\"3\"");
        if (light == drawing->light) {
            keepOffMark(&drawing->board, at, 6);
            Text name = {0};
            textAppend(&name, "blocked here");
            if (light->blocker->line > 0)
                textAppendFormat(&name, " by line %d", light->blocker->line);
            askForLabel(&drawing->board, at, textString(&name), BLOCKED_COLOR, false, true);
            textFree(&name);
        }
        return;
    }
    drawing->hasDark = true;
    drawLine(drawing, p, end, DARK_STROKE);
}

static void drawLights(Drawing *drawing)
{
    const RayStory *ray = drawing->story->ray;
    const Scene *scene = drawing->story->scene;
    if (ray->end != RAY_MEETS_SURFACE || ray->isUnlit)
        return;
    DrawnPoint p = drawnPoint(&drawing->plane, ray->point.position);
    size_t drawn = 0;
    for (size_t i = 0; i < ray->lightCount; i++) {
        const LightStory *light = &ray->lights[i];
        const Light *lamp = &scene->lights[light->light];
        bool isMain = light == drawing->light;
        bool isShown =
            lamp->kind == LIGHT_AREA ? light->sample % (lightSampleCount(lamp) / 6 + 1) == 0 : true;
        if (!isMain && (!isShown || drawn >= MOST_SHADOW_RAYS)) {
            drawing->hasOmitted = drawing->hasOmitted || isShown;
            continue;
        }
        drawn++;
        /* A light that is far is drawn in its direction, up to the border. */
        DrawnPoint end = {p.x + dot(light->arriving.direction, drawing->plane.right) * 1e4,
                          p.y - dot(light->arriving.direction, drawing->plane.up) * 1e4};
        bool isOutside = true;
        if (isfinite(light->arriving.distance)) {
            DrawnPoint at = drawnPoint(&drawing->plane, light->arriving.position);
            DrawnPoint inside = clipped(p, at, 20);
            isOutside = hypot(inside.x - at.x, inside.y - at.y) > 0.5;
            end = at;
        }
        end = clipped(p, end, 20);
        drawShadowRay(drawing, p, light, end);
        if (lamp->kind == LIGHT_AREA && !isOutside)
            appendCircle(drawing->text, end, 3, "fill=\"#facc15\" stroke=\"" LIGHT_COLOR "\"");
        if (lamp->kind != LIGHT_AREA || isMain)
            drawSun(drawing, end, lamp, light->light, light->arriving.distance, isOutside);
    }
}

/* Mirrored and refracted rays, as projected. */
static void drawRays(Drawing *drawing, const RayStory *ray)
{
    if (ray == NULL || ray->end == RAY_TOO_DEEP || ray->end == RAY_NOT_TOLD)
        return;
    if (drawing->raysDrawn++ >= MOST_RAYS_DRAWN) {
        drawing->hasOmitted = true;
        return;
    }
    if (ray->depth > 1) {
        DrawnPoint from = drawnPoint(&drawing->plane, ray->ray.origin), to;
        if (ray->end == RAY_MEETS_SURFACE)
            to = drawnPoint(&drawing->plane, ray->point.position);
        else
            to = (DrawnPoint){from.x + dot(ray->ray.direction, drawing->plane.right) * 160,
                              from.y - dot(ray->ray.direction, drawing->plane.up) * 160};
        bool isRefracted = ray->role == RAY_REFRACTED;
        drawing->hasRefracted = drawing->hasRefracted || isRefracted;
        drawing->hasMirrored = drawing->hasMirrored || !isRefracted;
        drawLine(drawing, from, to,
                 isRefracted ? "stroke=\"" REFRACTED_COLOR "\" stroke-width=\"2\""
                             : "stroke=\"" MIRROR_COLOR "\" stroke-width=\"2\"");
        if (ray->end == RAY_MEETS_SURFACE)
            appendCircle(drawing->text, to, 3,
                         isRefracted ? "fill=\"" REFRACTED_COLOR "\"" : "fill=\"" MIRROR_COLOR "\"");
    }
    drawRays(drawing, ray->refracted);
    drawRays(drawing, ray->mirrored);
}

/* The camera as an eye-like triangle that opens along its view. */
static void drawCamera(Drawing *drawing, DrawnPoint at)
{
    const Scene *scene = drawing->story->scene;
    const DrawingPlane *plane = &drawing->plane;
    Vector3D forward = normalize(scene->camera.direction);
    double x = dot(forward, plane->right), y = -dot(forward, plane->up), length = hypot(x, y);
    if (length < 0.05) {
        x = 1;
        y = 0;
        length = 1;
    }
    x /= length;
    y /= length;
    Text *text = drawing->text;
    textAppend(text, "<path fill=\"#ffffff\" stroke=\"" INK "\" stroke-width=\"2\" d=\"M");
    const double corners[3][2] = {{0, 0}, {22, 11}, {22, -11}};
    for (int i = 0; i < 3; i++) {
        appendPixels(text, at.x + corners[i][0] * x - corners[i][1] * y);
        textAppend(text, " ");
        appendPixels(text, at.y + corners[i][0] * y + corners[i][1] * x);
        textAppend(text, i < 2 ? "L" : "Z\"/>\n");
    }
    appendCircle(text, at, 5, "fill=\"" INK "\"");
    keepOffMark(&drawing->board, at, 8);
    keepOffMark(&drawing->board, (DrawnPoint){at.x + 13 * x, at.y + 13 * y}, 11);
    askForLabel(&drawing->board, at, "camera", INK, false, true);
}

/* ---- The page ---- */

/* One entry of the legend. */
static void legendEntry(Drawing *drawing, double *x, double *y, const char *stroke, const char *words)
{
    double width = 46 + 7.1 * (double)countCharacters(words);
    if (*x + width > WIDTH) {
        *x = LEFT;
        *y += 20;
    }
    Text *text = drawing->text;
    textAppend(text, "<line");
    appendAttribute(text, "x1", *x);
    appendAttribute(text, "x2", *x + 24);
    appendAttribute(text, "y1", *y - 4);
    appendAttribute(text, "y2", *y - 4);
    textAppendFormat(text, " %s/><text class=\"key\"", stroke);
    appendAttribute(text, "x", *x + 30);
    appendAttribute(text, "y", *y);
    textAppend(text, ">");
    appendEscaped(text, words);
    textAppend(text, "</text>\n");
    *x += width;
}

static void appendNote(Drawing *drawing, double y, const char *words)
{
    textAppend(drawing->text, "<text class=\"note\"");
    appendAttribute(drawing->text, "x", LEFT);
    appendAttribute(drawing->text, "y", y);
    textAppendFormat(drawing->text, ">%s</text>\n", words);
}

/* Returns the height of the whole drawing, which ends below the legend. */
static int drawLegend(Drawing *drawing)
{
    const RayStory *ray = drawing->story->ray;
    double x = LEFT, y = TOP + VIEW_HEIGHT + 26;
    bool hasPoint = ray->end == RAY_MEETS_SURFACE;
    legendEntry(drawing, &x, &y, "stroke=\"" CAMERA_COLOR "\" stroke-width=\"3\"", "ray of the camera");
    if (drawing->hasReaching)
        legendEntry(drawing, &x, &y, "stroke=\"" LIGHT_COLOR "\" stroke-width=\"1.6\"",
                    "way to a light, free");
    if (drawing->hasBlocked)
        legendEntry(drawing, &x, &y,
                    "stroke=\"" BLOCKED_COLOR "\" stroke-width=\"1.8\" stroke-dasharray=\"7 5\"",
                    "way to a light, blocked at the cross");
    if (drawing->hasDark)
        legendEntry(drawing, &x, &y, DARK_STROKE, "way to a light that adds nothing");
    if (drawing->hasMirrored)
        legendEntry(drawing, &x, &y, "stroke=\"" MIRROR_COLOR "\" stroke-width=\"2\"", "mirrored ray");
    if (drawing->hasRefracted)
        legendEntry(drawing, &x, &y, "stroke=\"" REFRACTED_COLOR "\" stroke-width=\"2\"", "refracted ray");
    if (hasPoint) {
        legendEntry(drawing, &x, &y, "stroke=\"" NORMAL_COLOR "\" stroke-width=\"2.5\"", "N, the normal");
        legendEntry(drawing, &x, &y, "stroke=\"" VIEW_COLOR "\" stroke-width=\"2.5\"", "V, to the eye");
    }
    if (drawing->light != NULL) {
        legendEntry(drawing, &x, &y, "stroke=\"" LIGHT_COLOR "\" stroke-width=\"2.5\"", "L, to the light");
        if (drawing->light->hasHighlight)
            legendEntry(drawing, &x, &y, "stroke=\"" HIGHLIGHT_COLOR "\" stroke-width=\"2.5\"",
                        ray->model == MODEL_PHONG ? "R, L mirrored at N" : "H, halfway between L and V");
    }
    y += 6;
    appendNote(drawing, y += 18,
               "Objects as the plane cuts them; a dotted circle: a sphere beside the plane.");
    appendNote(drawing, y += 18, "What leaves the plane is drawn as its projection, so shorter.");
    if (drawing->hasOmitted)
        appendNote(drawing, y += 18, "Not all objects, lights and rays are drawn.");
    return (int)y + 16;
}

/* What the drawing shows, for those who cannot see it. */
static void appendDescription(Drawing *drawing)
{
    const PixelStory *story = drawing->story;
    const RayStory *ray = story->ray;
    Text words = {0};
    textAppend(&words, "The ray of the camera ");
    if (ray->end == RAY_MEETS_SURFACE) {
        textAppend(&words, "meets ");
        appendObjectName(story->scene, ray->point.object, ray->point.hit.object, &words);
        textAppend(&words, " at distance ");
        textAppendRounded(&words, ray->point.hit.distance, DISTANCE_DIGITS);
        textAppend(&words, ".");
    } else {
        textAppend(&words, "meets nothing.");
    }
    const char *const fates[] = {[LIGHT_REACHES] = "reaches the point",
                                 [LIGHT_BEHIND] = "is behind the surface",
                                 [LIGHT_DARK] = "sends nothing to the point",
                                 [LIGHT_BLOCKED] = "is blocked",
                                 [LIGHT_NOT_ASKED] = "is not asked"};
    for (size_t i = 0; i < ray->lightCount && i < 1000 && !ray->isUnlit; i++) {
        const LightStory *light = &ray->lights[i];
        /* Of an area's point lights one that fares as the one before it is not told again. */
        if (i > 0 && light[-1].light == light->light && light[-1].fate == light->fate)
            continue;
        textAppendFormat(&words, " Light %zu%s %s", light->light + 1,
                         story->scene->lights[light->light].kind == LIGHT_AREA ? ", a part of it," : "",
                         fates[light->fate]);
        if (light->blocker != NULL) {
            textAppend(&words, " by ");
            appendObjectName(story->scene, light->blocker, light->blockerPart, &words);
        }
        textAppend(&words, ".");
    }
    appendEscaped(drawing->text, textString(&words));
    drawing->text->failed = drawing->text->failed || words.failed;
    textFree(&words);
}

static void beginPage(Drawing *drawing, const char *name, int height)
{
    Text *text = drawing->text;
    textAppendFormat(text,
                     "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" "
                     "height=\"%d\" fill=\"" INK "\" role=\"img\" aria-labelledby=\"title desc\">\n"
                     "<title id=\"title\">Pixel (%d, %d) of ",
                     WIDTH, height, WIDTH, height, drawing->story->x, drawing->story->y);
    appendEscaped(text, name);
    const char *view = viewOfPlane(&drawing->plane, drawing->story->scene->camera.up);
    textAppendFormat(text, ", seen %s</title>\n<desc id=\"desc\">", view);
    appendDescription(drawing);
    textAppendFormat(text,
                     "</desc>\n"
                     "<style>text { font: 14px system-ui, sans-serif; text-anchor: middle; } .labels text { "
                     "paint-order: stroke; stroke: #fbfbf9; stroke-width: 4px; "
                     "stroke-linejoin: round; } .head { font-size: 17px; font-weight: 600; } .note { "
                     "font-size: 13px; } .head, .note, .key { text-anchor: start; }</style>\n"
                     "<defs><clipPath id=\"view\"><rect x=\"%d\" y=\"%d\" width=\"%d\" "
                     "height=\"%d\"/></clipPath>\n",
                     LEFT, TOP, VIEW_WIDTH, VIEW_HEIGHT);
    appendMarker(text, "arrow-n", NORMAL_COLOR);
    appendMarker(text, "arrow-v", VIEW_COLOR);
    appendMarker(text, "arrow-l", LIGHT_COLOR);
    appendMarker(text, "arrow-r", HIGHLIGHT_COLOR);
    textAppendFormat(text,
                     "</defs>\n<rect width=\"%d\" height=\"%d\" fill=\"#fbfbf9\"/>\n"
                     "<text class=\"head\" x=\"16\" y=\"28\">Pixel (%d, %d) of ",
                     WIDTH, height, drawing->story->x, drawing->story->y);
    appendEscaped(text, name);
    textAppend(text, "</text>\n<text class=\"note\" x=\"16\" y=\"49\">The plane through "
                     "the ray of the camera");
    if (drawing->light != NULL)
        textAppendFormat(text, " and light %zu", drawing->light->light + 1);
    textAppendFormat(text,
                     ", seen %s</text>\n<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" "
                     "fill=\"#ffffff\" stroke=\"#d0d7de\"/>\n",
                     view, LEFT, TOP, VIEW_WIDTH, VIEW_HEIGHT);
}

void writeStorySvg(const PixelStory *story, const char *name, Text *text)
{
    Text body = {0};
    Drawing drawing = {.story = story,
                       .text = &body,
                       .plane = {.left = LEFT, .top = TOP, .width = VIEW_WIDTH, .height = VIEW_HEIGHT},
                       .board = {.view = {LEFT, TOP, VIEW_WIDTH, VIEW_HEIGHT}}};
    const RayStory *ray = story->ray;
    double far = sceneLength(story);
    drawing.light = choosePlane(story, far, &drawing.plane);
    textAppend(&body, "<g clip-path=\"url(#view)\">\n");

    /* Draw the objects; those of the story first on the list, the others as long as there is room. */
    wantObjectsOf(&drawing, ray);
    for (size_t i = 0; i < story->scene->objectCount && !drawing.hasOmitted; i++)
        wantObject(&drawing, &story->scene->objects[i]);
    DrawnPoint boxes[MOST_OBJECTS][2];
    bool drawn[MOST_OBJECTS];
    for (size_t i = 0; i < drawing.objectCount; i++) {
        const Object *object = drawing.objects[i];
        bool isRound = object->kind == SHAPE_SPHERE && object->transform == NULL;
        drawn[i] = isRound ? drawSphere(&drawing, object, boxes[i]) : drawCut(&drawing, object, boxes[i]);
    }

    /* Draw rays, lights and vectors, then the labels of the objects where room is left. */
    DrawnPoint camera = drawnPoint(&drawing.plane, ray->ray.origin);
    DrawnPoint end = drawnPoint(&drawing.plane, endOfCameraRay(ray, far));
    if (ray->end == RAY_MEETS_NOTHING)
        end = (DrawnPoint){camera.x + 1.5 * (end.x - camera.x), camera.y + 1.5 * (end.y - camera.y)};
    drawLine(&drawing, camera, end, "stroke=\"" CAMERA_COLOR "\" stroke-width=\"3\"");
    drawRays(&drawing, ray);
    drawCamera(&drawing, camera);
    if (ray->end == RAY_MEETS_SURFACE) {
        keepOffMark(&drawing.board, end, 6);
        drawLights(&drawing);
        drawVectors(&drawing);
        appendCircle(&body, end, 4.5, "fill=\"" INK "\"");
        askForLabel(&drawing.board, end, "P", INK, false, true);
    }
    for (size_t i = 0; i < drawing.objectCount; i++)
        if (drawn[i] && (i == 0 || isLargeEnough(boxes[i])))
            labelObject(&drawing, drawing.objects[i], boxes[i]);
    textAppend(&body, "</g>\n<g class=\"labels\">\n");
    placeLabels(&drawing.board, &body);
    textAppend(&body, "</g>\n");
    int height = drawLegend(&drawing);

    drawing.text = text;
    beginPage(&drawing, name, height);
    textAppendBytes(text, textString(&body), body.length);
    textAppend(text, "</svg>\n");
    text->failed = text->failed || body.failed;
    textFree(&body);
}
