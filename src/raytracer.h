/* raytracer.h - the scene, and the course's tracer that draws it (handout: raytracer.h).
 *
 * This is the scalar, double-precision, obvious tracer: what a student reads, and the truth that the
 * other engines are tested against (`--engine reference`). One ray at a time: find the nearest surface,
 * ask of each light whether it reaches that point, add up what the surface returns.
 */
#ifndef ECLAIRAGE_RAYTRACER_H
#define ECLAIRAGE_RAYTRACER_H

#include "base/status.h"
#include "base/tolerance.h"
#include "colors.h"
#include "geometry.h"
#include "shading.h"
#include "shapes/shape.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How a light grows weaker with the distance d: by 1/d^2, or not at all. */
typedef enum Falloff {
    FALLOFF_INVERSE_SQUARE,
    FALLOFF_NONE
} Falloff;

typedef enum LightKind {
    LIGHT_POINT,       /* shines the same in all directions from position */
    LIGHT_DIRECTIONAL, /* comes from infinitely far along direction, the same everywhere */
    LIGHT_SPOT,        /* a point light in a cone round direction */
    LIGHT_AREA         /* the mean of countU x countV point lights on a parallelogram round position */
} LightKind;

typedef struct Light {
    Vector3D position;
    Color3f color; /* linear, at least 0, not limited to 1 */
    Falloff falloff;
    LightKind kind;
    Vector3D direction; /* directional: the way the light travels; spot: the cone's axis; of unit length */
    double innerAngle;  /* spot: full strength up to this angle from the axis, in degrees, 0 .. outerAngle */
    double outerAngle;  /* spot: none from this angle on, at most 90 */
    double tightness;   /* spot: times cos(angle)^tightness, at least 0 */
    Vector3D edgeU, edgeV; /* area: its whole sides */
    int countU, countV;    /* area: point lights along each side, at least 1; the outermost on the border */
} Light;

typedef enum Projection {
    PROJECTION_PERSPECTIVE,
    PROJECTION_ORTHOGRAPHIC
} Projection;

typedef struct Camera {
    Vector3D position;
    Vector3D direction; /* of any length but 0 */
    Vector3D up;        /* not parallel to direction */
    double fov;         /* perspective: the vertical angle of the picture in degrees, 0 < fov < 180 */
    Projection projection;
    double viewHeight; /* orthographic: the height of the picture in scene units, above 0 */
} Camera;

typedef struct ImageSettings {
    int width, height; /* 1 .. 65535 */
    int bitDepth;      /* 8 or 16 */
    Encoding encoding;
} ImageSettings;

typedef struct RenderSettings {
    ShadingModel model;
    bool shadows;
    double shadowBias; /* NAN: the tracer's own rule (see offsetStart); else, in scene units and at least
                        * 0: a blocker counts when it is farther than this along the shadow ray */
    int samples;       /* samples x samples rays a pixel, at least 1 */
    int maxDepth;      /* rays in a chain, the camera's counts 1; a ray past it is black */
    Color3f ambient;   /* light from everywhere, which a material's ambient returns */
} RenderSettings;

/* What a ray sees that meets nothing: one colour, or two mixed by t = (1 + direction.y) / 2, t = 1 being
 * the top. */
typedef struct Background {
    Color3f bottom;
    Color3f top; /* of a gradient */
    bool isGradient;
} Background;

/* What a ray of length d sees has the weight exp(-d / distance), the fog's colour the rest. */
typedef struct Fog {
    Color3f color;
    double distance; /* above 0; 0 is no fog */
} Fog;

/* The name of a file that a scene was read from beside its own, in a list. */
typedef struct SceneFileName {
    const struct SceneFileName *next;
    char path[];
} SceneFileName;

/* What an author wrote. The arrays grow as things are added and belong to the scene. */
typedef struct Scene {
    ImageSettings image;
    Camera camera;
    RenderSettings render;
    Background background;
    Fog fog;
    Light *lights;
    size_t lightCount, lightCapacity;
    Object *objects;
    size_t objectCount, objectCapacity;
    Tolerance tolerance;        /* for the comparison with POV-Ray */
    struct SceneMemory *memory; /* what allocateInScene gave */
    MeshData **meshes;          /* what keepMeshInScene was given */
    size_t meshCount, meshCapacity;
    const SceneFileName *files; /* in the scene's memory */
} Scene;

/* A light with the handout's falloff, 1/d^2. */
Light createLight(Vector3D position, Color3f color);

/* An empty scene with the defaults of the scene format: 640 x 480, camera at the origin looking along
 * -z with a vertical angle of 60 degrees, Phong with shadows, black background. Needs no memory; free
 * what is added with freeScene. */
Scene createScene(void);
void freeScene(Scene *scene);

/* Zeroed memory that lives as long as the scene, for transforms, patterns and texels; NULL when memory runs
 * out. */
void *allocateInScene(Scene *scene, size_t size);

/* Let the scene own a mesh, so that it is freed with it: any number of objects may share it. False when
 * memory runs out, and then it is still the caller's. */
bool keepMeshInScene(Scene *scene, MeshData *mesh);

/* Add a copy, which from then on owns what the object owns. False when memory runs out, and then the scene is
 * as before. */
bool addLightToScene(Scene *scene, Light light);
bool addObjectToScene(Scene *scene, Object object);
bool addSphereToScene(Scene *scene, Sphere sphere);
bool addCubeToScene(Scene *scene, Cube cube);
bool addBoxToScene(Scene *scene, Box box);
bool addPlaneToScene(Scene *scene, Plane plane);

/* Make room for so many more objects at once, which is faster than room for one after the other and takes no
 * more memory than they need. False when memory runs out, and then the scene is as before. */
bool reserveObjectsInScene(Scene *scene, size_t count);

/* The nearest object that the ray meets at t > 0; of two at the same distance the one added first. On
 * a miss the intersection is untouched. */
bool throwRayThroughScene(Ray ray, Scene scene, Intersection *intersection);

/* The handout's three functions: draw the scene with that model, whatever the scene says, on all
 * processors. The camera's picture fills the framebuffer, whose aspect counts. */
void simpleRaytracing(Scene scene, Framebuffer *framebuffer);
void lambertRaytracing(Scene scene, Framebuffer *framebuffer);
void phongRaytracing(Scene scene, Framebuffer *framebuffer);

/* The camera as three vectors: the ray through the point (u, v) of the picture, both in -1/2..1/2, u to
 * the right and v up, has the direction forward + u right + v up and starts at position; orthographic, it
 * has the direction forward and starts at position + u right + v up. */
typedef struct CameraFrame {
    Projection projection;
    Vector3D position;
    Vector3D forward; /* of unit length */
    Vector3D right;   /* the picture's width, of a perspective camera at distance 1 */
    Vector3D up;      /* its height, likewise */
} CameraFrame;

CameraFrame cameraFrame(const Camera *camera, int width, int height);

/* base + u right + v up at a point of the picture in pixels: of a perspective camera, with base = forward,
 * along the ray; of an orthographic one, with base = position, where the ray starts. */
static inline Vector3D pictureVector(const CameraFrame *frame, Vector3D base, double x, double y, int width,
                                     int height)
{
    double u = x / width - 0.5;
    double v = (height - y) / height - 0.5;
    return addVectors(addVectors(base, multVector(frame->right, u)), multVector(frame->up, v));
}

/* The ray through a point of the picture in pixels: (0, 0) is its top left corner, the middle of the
 * first pixel (0.5, 0.5). */
Ray cameraRay(const CameraFrame *frame, double x, double y, int width, int height);

/* What a light sends to a point, if nothing is between. */
typedef struct ArrivingLight {
    Vector3D direction; /* to the light, of unit length */
    Vector3D position;  /* where it comes from; not of a directional light */
    double distance;    /* to there; INFINITY of a directional light */
    Color3f color;      /* after falloff and cone; black outside the cone */
} ArrivingLight;

/* The point lights that a light stands for: 1, or those of an area. */
int lightSampleCount(const Light *light);
ArrivingLight lightArriving(const Light *light, int sample, Vector3D point);

/* Where a point light of an area is; of others their position. */
Vector3D lightSamplePosition(const Light *light, int sample);

/* The model of a material in this scene. */
static inline ShadingModel materialModel(const Scene *scene, const Material *material)
{
    return material->model == MODEL_OF_SCENE ? scene->render.model : material->model;
}

/* What goes through a surface: its transmission, or black where its model has none. */
Color3f effectiveTransmission(const Scene *scene, const Material *material);

/* The first material in the object, or in the parts of a solid, that rays go through; NULL where they go
 * through none. */
const Material *transmissivePart(const Scene *scene, const Object *object);

/* How many rays were traced. */
typedef struct RayCounts {
    uint64_t primary, shadow, secondary;
} RayCounts;

/* ---- What every engine shares ----
 *
 * Engines differ in how they find the surfaces that a ray meets; what happens there is the same for all, and
 * so is every rounding of it. */

/* A point where a ray met a surface, ready to send further rays from. */
typedef struct SurfacePoint {
    const Object *object; /* the whole object; hit.object is its part */
    Hit hit;
    Vector3D position;
    Vector3D normal;     /* turned to the ray's side */
    Vector3D flatNormal; /* of the surface itself, where normal is interpolated; on either side */
    double offset;       /* how far to step off the surface */
} SurfacePoint;

/* How many times the largest number in a computation its result may be wrong, with a wide margin: a
 * few roundings of 2^-53 each. */
#define ROUNDING_MARGIN 0x1p-40

/* The point where the ray meets the object in this hit. */
SurfacePoint surfacePointAt(const Ray *ray, const Object *object, const Hit *hit);

/* Where a ray that leaves the point in this direction starts: off the surface, to the side that it leaves to.
 */
Vector3D offsetStart(const SurfacePoint *point, Vector3D direction);

/* The transparent objects that a ray is in, the one entered last at the end. */
enum {
    MAX_MEDIA = 64
};
typedef struct Media {
    const Object *objects[MAX_MEDIA];
    int count;
} Media;

/* The numbers of the scene's transparent objects in rising order, which the caller frees; NULL where there
 * are none, and with *failed set when memory runs out. */
uint32_t *findTransparentObjects(const Scene *scene, size_t *count, bool *failed);

/* Go through the surface of a transparent object: behind gets the media on its other side, and the result is
 * the ratio n1 / n2 of the index before the surface to the one behind it. An object that is not among the
 * media is entered; one that is, is left, and where others were entered after it the ratio is 1. With
 * MAX_MEDIA already, the one entered is not noted. ior: of the object's material at this point. */
double crossSurface(const Media *media, const Object *object, double ior, Media *behind);

/* The way from a surface to a light: what blocks lies at above < t < farthest. */
typedef struct ShadowRay {
    Ray ray;
    double above, farthest;
} ShadowRay;

ShadowRay shadowRayTo(const Scene *scene, const SurfacePoint *point, const ArrivingLight *arriving);

/* The same from a start that is off the surface, by the tracer's own rule. */
ShadowRay shadowRayFrom(Vector3D start, const ArrivingLight *arriving);

/* What is left of the light behind these objects of the scene, given by their numbers in rising order; NULL:
 * behind all of them. Black behind an opaque surface, times the transmission of each transparent one that it
 * crosses. */
Color3f lightThroughObjects(const Scene *scene, const uint32_t *objects, size_t count,
                            const ShadowRay *shadow, Color3f color);

/* How an engine finds surfaces; an engine's own struct begins with it. */
typedef struct SurfaceFinder SurfaceFinder;

/* What a surface returns of all lamps towards v, of unit length, and its own light. */
typedef Color3f LightShader(const SurfaceFinder *finder, const SurfacePoint *point, const Material *material,
                            Vector3D v, RayCounts *counts);

struct SurfaceFinder {
    const Scene *scene;
    /* As throwRayThroughScene: the nearest object that the ray meets, or NULL; hit says where, and on which
     * of its parts. */
    const Object *(*nearest)(const SurfaceFinder *finder, const Ray *ray, Hit *hit);
    /* As lightThroughObjects behind all objects. */
    Color3f (*lightAlong)(const SurfaceFinder *finder, const ShadowRay *shadow, Color3f color);
    /* Takes the place of lightReturned, to see what another formula would give; NULL: the course's models. */
    LightShader *lightShader;
};

/* The course's models, but for the simple one: ambient and emission, then for each lamp that reaches the
 * point the diffuse term and the highlight. */
LightShader lightReturned;

/* The colour that comes along the ray, number depth in its chain (the camera's is 1), within these media. */
Color3f traceRay(const SurfaceFinder *finder, const Ray *ray, const Media *media, int depth,
                 RayCounts *counts);

/* What the rays of a picture's pixels have in common. Nothing is owned. */
typedef struct PixelRays {
    const Scene *scene;
    int width, height;
    CameraFrame frame;
    const uint32_t *transparent; /* numbers of the transparent objects */
    size_t transparentCount;
    Media media; /* at the position of a perspective camera */
    /* NULL, or puts in place of a point of the picture, in pixels, another one to look through. */
    void (*movePoint)(const void *context, int width, int height, double *x, double *y);
    const void *moveContext;
} PixelRays;

/* transparent: as findTransparentObjects gives them. */
PixelRays createPixelRays(const Scene *scene, int width, int height, const uint32_t *transparent,
                          size_t transparentCount);

/* The transparent objects that a ray of the camera starts in. */
Media cameraMedia(const PixelRays *rays, const Ray *ray);

/* The ray through a point of the picture (see cameraRay), and the media where it starts. */
Ray pixelRay(const PixelRays *rays, double x, double y, Media *media);

/* The mean of a pixel's samples x samples rays, evenly spread; of one, through the middle. */
Color3f tracePixel(const PixelRays *rays, const SurfaceFinder *finder, int x, int y, RayCounts *counts);

/* The colour that leaves the point towards the ray's origin. */
Color3f shade(const SurfaceFinder *finder, const SurfacePoint *point, const Ray *ray, const Media *media,
              int depth, RayCounts *counts);

/* The part of it that comes along mirrored and refracted rays, added to the color of all else. */
Color3f addSecondaryRays(const SurfaceFinder *finder, const SurfacePoint *point, const Material *material,
                         const Ray *ray, const Media *media, int depth, Color3f color, RayCounts *counts);

/* What a ray sees that meets nothing, and what is left of a color seen through fog, with the fog's own. */
Color3f backgroundColor(const Background *background, const Ray *ray);
Color3f throughFog(const Fog *fog, Color3f color, double distance);

typedef struct RenderOptions {
    int threads;                                  /* at least 1 */
    void (*progress)(void *context, double done); /* NULL, or called from any thread; done in 0..1 */
    void *progressContext;
} RenderOptions;

/* Draw the finder's scene as it says, into a framebuffer of any size. The same picture for any number of
 * threads. STATUS_INTERRUPTED when cancelled; counts may be NULL. */
Status renderWithFinder(const SurfaceFinder *finder, Framebuffer *framebuffer, const RenderOptions *options,
                        RayCounts *counts);

/* The same, finding surfaces by looking at all objects. */
Status renderReference(const Scene *scene, Framebuffer *framebuffer, const RenderOptions *options,
                       RayCounts *counts);

#endif
