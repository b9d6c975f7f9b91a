/* tree.c - how many tests a ray costs with a tree of boxes, and without one; as CSV.
 *
 *     cc -O2 -o tree notes/experiments/tree.c -lm && ./tree > tree.csv
 *
 * For 10 to 100,000 random spheres in a cube, whose radius shrinks as their number grows so that a ray meets
 * about as many: 1000 rays through the cube look for the nearest sphere. Without a tree each ray tests each
 * sphere. The tree is the simplest there is: halve the spheres at the middle one along the longest side of
 * their box, until four or fewer are left. Both ways must find the same spheres; the program says so if not.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    LARGEST_COUNT = 100000,
    RAYS = 1000,
    LEAF_COUNT = 4
};

typedef struct Sphere {
    double center[3], radius;
} Sphere;

typedef struct Node {
    double min[3], max[3];
    int first, count; /* the spheres of a leaf; count is 0 in an inner node */
    int children[2];
} Node;

static Sphere spheres[LARGEST_COUNT];
static Node nodes[2 * LARGEST_COUNT];
static int nodeCount;
static int sortAxis;
static long sphereTests, boxTests;

/* 0 .. 1, all alike likely (a linear congruential generator; Knuth's MMIX constants). */
static double nextRandom(void)
{
    static uint64_t state = 1;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / (double)(1ull << 53);
}

static int compareCenters(const void *a, const void *b)
{
    double x = ((const Sphere *)a)->center[sortAxis], y = ((const Sphere *)b)->center[sortAxis];
    return (x > y) - (x < y);
}

static int buildNode(int first, int count)
{
    int number = nodeCount++;
    Node node = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, first, count, {0, 0}};
    for (int s = first; s < first + count; s++)
        for (int i = 0; i < 3; i++) {
            node.min[i] = fmin(node.min[i], spheres[s].center[i] - spheres[s].radius);
            node.max[i] = fmax(node.max[i], spheres[s].center[i] + spheres[s].radius);
        }
    if (count > LEAF_COUNT) {
        sortAxis = 0;
        for (int i = 1; i < 3; i++)
            if (node.max[i] - node.min[i] > node.max[sortAxis] - node.min[sortAxis])
                sortAxis = i;
        qsort(spheres + first, (size_t)count, sizeof *spheres, compareCenters);
        node.count = 0;
        node.children[0] = buildNode(first, count / 2);
        node.children[1] = buildNode(first + count / 2, count - count / 2);
    }
    nodes[number] = node;
    return number;
}

/* The distance at which the ray meets the sphere, or `nearest` where it is not nearer than that. */
static double meetSphere(const Sphere *sphere, const double o[3], const double d[3], double nearest)
{
    double b = 0, c = -sphere->radius * sphere->radius;
    sphereTests++;
    for (int i = 0; i < 3; i++) {
        b += (o[i] - sphere->center[i]) * d[i];
        c += (o[i] - sphere->center[i]) * (o[i] - sphere->center[i]);
    }
    double t = b * b - c >= 0 ? -b - sqrt(b * b - c) : -1;
    return t > 0 && t < nearest ? t : nearest;
}

/* Where the ray enters the box, or INFINITY where it misses it: the largest of the three entries must not
 * lie behind the smallest of the three exits. */
static double meetBox(const Node *node, const double o[3], const double d[3])
{
    double entry = 0, exit = INFINITY;
    boxTests++;
    for (int i = 0; i < 3; i++) {
        double a = (node->min[i] - o[i]) / d[i], b = (node->max[i] - o[i]) / d[i];
        entry = fmax(entry, fmin(a, b));
        exit = fmin(exit, fmax(a, b));
    }
    return entry <= exit ? entry : INFINITY;
}

static double meetNode(int number, const double o[3], const double d[3], double nearest)
{
    const Node *node = &nodes[number];
    for (int s = node->first; s < node->first + node->count; s++)
        nearest = meetSphere(&spheres[s], o, d, nearest);
    if (node->count > 0)
        return nearest;

    /* The nearer child first: what it finds may spare the other one. */
    double entries[2] = {meetBox(&nodes[node->children[0]], o, d), meetBox(&nodes[node->children[1]], o, d)};
    int near = entries[1] < entries[0];
    for (int k = 0; k < 2; k++) {
        int child = k == 0 ? near : 1 - near;
        if (entries[child] < nearest)
            nearest = meetNode(node->children[child], o, d, nearest);
    }
    return nearest;
}

int main(void)
{
    printf("spheres,without,sphere_tests,box_tests\n");
    for (int count = 10; count <= LARGEST_COUNT; count *= 10) {
        for (int s = 0; s < count; s++)
            spheres[s] = (Sphere){{nextRandom(), nextRandom(), nextRandom()}, 0.5 / sqrt(count)};
        nodeCount = 0;
        int root = buildNode(0, count);
        long tests[3] = {0, 0, 0};
        for (int r = 0; r < RAYS; r++) {
            double o[3] = {nextRandom(), nextRandom(), -3}, d[3] = {0, 0, 0}, length = 0;
            for (int i = 0; i < 3; i++) {
                d[i] = nextRandom() - o[i] + (i == 2 ? 1 : 0);
                length += d[i] * d[i];
            }
            for (int i = 0; i < 3; i++)
                d[i] /= sqrt(length);

            double all = INFINITY;
            sphereTests = boxTests = 0;
            for (int s = 0; s < count; s++)
                all = meetSphere(&spheres[s], o, d, all);
            tests[0] += sphereTests;
            sphereTests = 0;
            double found = meetNode(root, o, d, INFINITY);
            tests[1] += sphereTests;
            tests[2] += boxTests;
            if (found != all) {
                fprintf(stderr, "tree: the tree finds another sphere than the list\n");
                return 1;
            }
        }
        printf("%d,%.2f,%.2f,%.2f\n", count, (double)tests[0] / RAYS, (double)tests[1] / RAYS,
               (double)tests[2] / RAYS);
    }
    return 0;
}
