/* embree_peer.c - the yardstick: the benchmark scenes drawn with Embree 3's 8-wide coherent packets.
 *
 *   embree_peer SCENE.sph|SCENE.obj WIDTH [OUT.pgm]
 *
 * A .sph file has a line x y z radius for each sphere; of a .obj file the lines `v x y z` and `f a b c` are
 * read. Ground, camera, lights and the material's red channel are those of make_peer_scene.py (ORDER
 * SHADING); normals are flat, hits and shading all float, one grey value a pixel, two threads. Prints JSON:
 * primitives, the seconds of the high-quality build, and of FRAMES frames the least and the median time of
 * tracing and shading. OUT.pgm has 16 bits a sample, linear.
 *
 * Whatever may make Embree faster without changing the picture belongs here: we compare ourselves with its
 * best. What is told about its packets is in Wald et al. 2014, "Embree: A Kernel Framework for Efficient CPU
 * Ray Tracing".
 */
#include <embree3/rtcore.h>
#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    LANES = 8, /* a packet is 4 x 2 pixels */
    LIGHTS = 3,
    THREADS = 2,
    TILE = 16, /* pixels on a side of what a thread takes at once */
    FRAMES = 5
};

static const float lights[LIGHTS][3] = {{4, 3, 2}, {1, -4, 4}, {-3, 1, 5}};
static const float eye[3] = {2.1f, 1.3f, 1.7f};
static const float fieldOfView = 45, groundHeight = -.5f, groundHalfSize = 1e3f;
/* Far less than the smallest sphere, whose shadow begins that much too late; spheres and triangles show no
 * acne with it. */
static const float shadowOffset = 1e-5f;

/* What the threads share: written before they start, but for nextTile and each thread's own pixels. */
static RTCScene scene;
static int width;
static float *image;
static atomic_int nextTile;
static float forward[3], right[3], up[3], extent; /* extent: the picture's size at distance 1 */

/* Spheres, 4 floats each (center, radius), or vertices of 3 floats and triangles of 3 indices from 0. */
typedef struct Geometry {
    bool isMesh;
    float *numbers;
    unsigned *indices;
    size_t numberCount, indexCount;
} Geometry;

static void stop(const char *file, const char *message)
{
    fprintf(stderr, "embree_peer: %s: %s\n", file, message);
    exit(1);
}

static double secondsNow(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Draw the 4 x 2 pixels whose first is (left, top). */
static void drawPacket(int left, int top, struct RTCIntersectContext *context)
{
    /* Send a ray through the middle of each pixel. */
    struct RTCRayHit8 h __attribute__((aligned(32)));
    int valid[LANES] __attribute__((aligned(32)));
    memset(&h, 0, sizeof h);
    for (int i = 0; i < LANES; i++) {
        float u = ((float)(left + (i & 3)) + .5f) / (float)width * extent - extent / 2;
        float v = extent / 2 - ((float)(top + (i >> 2)) + .5f) / (float)width * extent;
        h.ray.org_x[i] = eye[0];
        h.ray.org_y[i] = eye[1];
        h.ray.org_z[i] = eye[2];
        h.ray.dir_x[i] = forward[0] + u * right[0] + v * up[0];
        h.ray.dir_y[i] = forward[1] + u * right[1] + v * up[1];
        h.ray.dir_z[i] = forward[2] + u * right[2] + v * up[2];
        h.ray.tfar[i] = 1e30f;
        h.ray.mask[i] = ~0u;
        h.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        h.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        valid[i] = -1;
    }
    rtcIntersect8(valid, scene, context, &h);

    /* Find where each ray hit, the unit normal there, and the unit direction it came along. */
    float px[LANES], py[LANES], pz[LANES], nx[LANES], ny[LANES], nz[LANES];
    float vx[LANES], vy[LANES], vz[LANES], value[LANES];
    int hit[LANES];
    for (int i = 0; i < LANES; i++) {
        float t = h.ray.tfar[i];
        hit[i] = h.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        t = hit[i] ? t : 0;
        float dx = h.ray.dir_x[i], dy = h.ray.dir_y[i], dz = h.ray.dir_z[i];
        px[i] = eye[0] + t * dx;
        py[i] = eye[1] + t * dy;
        pz[i] = eye[2] + t * dz;
        float x = h.hit.Ng_x[i], y = h.hit.Ng_y[i], z = h.hit.Ng_z[i];
        float q = 1 / sqrtf(x * x + y * y + z * z + 1e-30f);
        nx[i] = x * q;
        ny[i] = y * q;
        nz[i] = z * q;
        float d = 1 / sqrtf(dx * dx + dy * dy + dz * dz);
        vx[i] = dx * d;
        vy[i] = dy * d;
        vz[i] = dz * d;
        value[i] = 0;
    }

    for (int light = 0; light < LIGHTS; light++) {
        /* Shade by Phong, exponent 12: R is the light's direction mirrored, the viewer is against the ray. */
        struct RTCRay8 s __attribute__((aligned(32)));
        float cosine[LANES], highlight[LANES];
        int any = 0;
        memset(&s, 0, sizeof s);
        for (int i = 0; i < LANES; i++) {
            float x = lights[light][0] - px[i], y = lights[light][1] - py[i], z = lights[light][2] - pz[i];
            float q = 1 / sqrtf(x * x + y * y + z * z);
            cosine[i] = (x * nx[i] + y * ny[i] + z * nz[i]) * q;
            float rx = x * q - 2 * cosine[i] * nx[i];
            float ry = y * q - 2 * cosine[i] * ny[i];
            float rz = z * q - 2 * cosine[i] * nz[i];
            float c = rx * vx[i] + ry * vy[i] + rz * vz[i];
            c = c > 0 ? c : 0;
            float c2 = c * c, c4 = c2 * c2;
            highlight[i] = c4 * c4 * c4;
            s.org_x[i] = px[i] + shadowOffset * nx[i];
            s.org_y[i] = py[i] + shadowOffset * ny[i];
            s.org_z[i] = pz[i] + shadowOffset * nz[i];
            s.dir_x[i] = x;
            s.dir_y[i] = y;
            s.dir_z[i] = z;
            s.tfar[i] = 1;
            s.mask[i] = ~0u;
            valid[i] = hit[i] && cosine[i] > 0 ? -1 : 0;
            any |= valid[i];
        }
        if (!any)
            continue;

        /* Add the light where nothing is in its way; rtcOccluded8 makes tfar negative where something is. */
        rtcOccluded8(valid, scene, context, &s);
        for (int i = 0; i < LANES; i++)
            value[i] += valid[i] && s.tfar[i] >= 0 ? .5f * (.5f * cosine[i] + .5f * highlight[i]) : 0;
    }
    for (int i = 0; i < LANES; i++)
        image[(size_t)(top + (i >> 2)) * (size_t)width + (size_t)(left + (i & 3))] = value[i];
}

static void *drawTiles(void *unused)
{
    (void)unused;
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    int tiles = width / TILE;
    for (int t; (t = atomic_fetch_add(&nextTile, 1)) < tiles * tiles;)
        for (int y = 0; y < TILE; y += 2)
            for (int x = 0; x < TILE; x += 4)
                drawPacket(t % tiles * TILE + x, t / tiles * TILE + y, &context);
    return NULL;
}

static double drawFrame(void)
{
    pthread_t thread[THREADS];
    double start = secondsNow();
    atomic_store(&nextTile, 0);
    for (int i = 0; i < THREADS; i++)
        if (pthread_create(&thread[i], NULL, drawTiles, NULL) != 0)
            stop("a frame", "no thread could be started");
    for (int i = 0; i < THREADS; i++)
        pthread_join(thread[i], NULL);
    return secondsNow() - start;
}

static Geometry readGeometry(const char *path)
{
    Geometry read = {.isMesh = strlen(path) > 4 && strcmp(path + strlen(path) - 4, ".obj") == 0};
    FILE *in = fopen(path, "r");
    if (!in)
        stop(path, strerror(errno));

    /* Make room for what so many lines can hold at most. */
    char line[256];
    size_t lines = 0;
    while (fgets(line, sizeof line, in))
        lines++;
    rewind(in);
    read.numbers = malloc((lines + 1) * 4 * sizeof *read.numbers);
    read.indices = malloc((lines + 1) * 3 * sizeof *read.indices);
    if (!read.numbers || !read.indices)
        stop(path, strerror(ENOMEM));

    for (size_t i = 0; i < lines && fgets(line, sizeof line, in); i++) {
        float *number = read.numbers + read.numberCount;
        unsigned *index = read.indices + read.indexCount;
        if (read.isMesh && sscanf(line, "f %u %u %u", &index[0], &index[1], &index[2]) == 3) {
            for (int k = 0; k < 3; k++)
                index[k]--;
            read.indexCount += 3;
        } else if (read.isMesh && sscanf(line, "v %f %f %f", &number[0], &number[1], &number[2]) == 3) {
            read.numberCount += 3;
        } else if (!read.isMesh &&
                   sscanf(line, "%f %f %f %f", &number[0], &number[1], &number[2], &number[3]) == 4) {
            read.numberCount += 4;
        } else {
            stop(path, "a line is not of this format");
        }
    }
    if (ferror(in))
        stop(path, strerror(errno));
    fclose(in);
    return read;
}

static void fillBuffer(RTCGeometry geometry, enum RTCBufferType type, enum RTCFormat format, size_t itemBytes,
                       const void *data, size_t items)
{
    void *buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, itemBytes, items);
    if (!buffer)
        stop("Embree", "no memory for the scene");
    memcpy(buffer, data, items * itemBytes);
}

static void attachGeometry(RTCDevice device, const Geometry *from)
{
    RTCGeometry g =
        rtcNewGeometry(device, from->isMesh ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_SPHERE_POINT);
    if (from->isMesh) {
        fillBuffer(g, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 12, from->numbers, from->numberCount / 3);
        fillBuffer(g, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 12, from->indices, from->indexCount / 3);
    } else {
        fillBuffer(g, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 16, from->numbers, from->numberCount / 4);
    }
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene, g);
    rtcReleaseGeometry(g);
}

static void buildScene(RTCDevice device, const Geometry *shapes)
{
    float e = groundHalfSize, z = groundHeight;
    float corners[12] = {-e, -e, z, e, -e, z, e, e, z, -e, e, z};
    unsigned faces[6] = {0, 1, 2, 0, 2, 3};
    const Geometry ground = {
        .isMesh = true, .numbers = corners, .numberCount = 12, .indices = faces, .indexCount = 6};
    scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    attachGeometry(device, shapes);
    attachGeometry(device, &ground);
    rtcCommitScene(scene);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
        stop("Embree", "the scene was not accepted");
}

static void normalize(float v[3])
{
    float q = 1 / sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++)
        v[k] *= q;
}

/* Look at the origin, z up. */
static void aimCamera(void)
{
    for (int k = 0; k < 3; k++)
        forward[k] = -eye[k];
    normalize(forward);
    right[0] = forward[1];
    right[1] = -forward[0];
    normalize(right);
    up[0] = right[1] * forward[2] - right[2] * forward[1];
    up[1] = right[2] * forward[0] - right[0] * forward[2];
    up[2] = right[0] * forward[1] - right[1] * forward[0];
    extent = 2 * tanf(fieldOfView / 2 * 3.14159265f / 180);
}

static void writePgm(const char *path)
{
    FILE *out = fopen(path, "wb");
    if (!out)
        stop(path, strerror(errno));
    fprintf(out, "P5\n%d %d\n65535\n", width, width);
    for (size_t i = 0; i < (size_t)width * (size_t)width; i++) {
        int sample = image[i] > 1 ? 65535 : (int)(image[i] * 65535 + .5f);
        fputc(sample >> 8, out);
        fputc(sample & 255, out);
    }
    if (ferror(out) | fclose(out))
        stop(path, strerror(errno));
}

static int compareDoubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv)
{
    if (argc < 3 || argc > 4) {
        fprintf(stderr, "Usage: embree_peer SCENE.sph|SCENE.obj WIDTH [OUT.pgm]\n");
        return 2;
    }
    width = atoi(argv[2]);
    if (width < TILE || width % TILE != 0 || width > 16384)
        stop(argv[2], "the width must be a multiple of 16, from 16 to 16384");
    Geometry shapes = readGeometry(argv[1]);
    if (shapes.numberCount == 0)
        stop(argv[1], "there is nothing in it");
    aimCamera();
    image = malloc((size_t)width * (size_t)width * sizeof *image);
    RTCDevice device = rtcNewDevice("threads=2");
    if (!image || !device)
        stop("Embree", "no device, or no memory for the picture");

    double start = secondsNow();
    buildScene(device, &shapes);
    double build = secondsNow() - start;

    double trace[FRAMES];
    for (int frame = 0; frame < FRAMES; frame++)
        trace[frame] = drawFrame();
    qsort(trace, FRAMES, sizeof *trace, compareDoubles);

    printf("{\"primitives\": %zu, \"version\": \"%s\", \"build\": %.6f, \"trace\": %.6f, \"trace_median\": "
           "%.6f}\n",
           shapes.isMesh ? shapes.indexCount / 3 : shapes.numberCount / 4, RTC_VERSION_STRING, build,
           trace[0], trace[FRAMES / 2]);
    if (argc > 3)
        writePgm(argv[3]);
    free(image);
    free(shapes.numbers);
    free(shapes.indices);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    return 0;
}
