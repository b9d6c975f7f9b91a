#!/usr/bin/env python3
"""Writes one benchmark scene for every renderer, so that all of them draw the same picture.

    make_peer_scene.py flake DEPTH BASE [WIDTH] | random COUNT BASE [WIDTH] | mesh COUNT BASE [WIDTH]

flake   Eric Haines' sphereflake (SPD "balls"): nine children a sphere, a third of its radius; depth 4 is 7,381 spheres
random  COUNT spheres spread evenly in the cube [-1, 1]^3
mesh    a closed ball with smooth bumps, of about COUNT flat triangles, in the same cube

It writes BASE.yaml for eclairage, BASE.pov for POV-Ray, BASE.dat for Tachyon, and what embree_peer reads: BASE.sph, a
line x y z radius for each sphere, or BASE.obj, which BASE.yaml names too. Every file has the same camera, the same
three white lights without falloff and the same ground, which cuts what lies below it; the picture is a square of WIDTH
pixels, 1024 by default. A shape has the same seven digits everywhere. The same arguments give the same files.

Red is 0.5 * N.L + 0.5 * highlight on all surfaces, as embree_peer, which computes one channel, has it (ORDER SHADING).
The colours differ in green and blue, so that the other peers' pictures also show which surface was hit.
"""
import math
import random
import sys

EYE, FOV = (2.1, 1.3, 1.7), 45
LIGHTS = [(4, 3, 2), (1, -4, 4), (-3, 1, 5)]
LIGHT_COLOR = 0.5
GROUND = -0.5
BALL_COLOR, GROUND_COLOR = (0.5, 0.45, 0.35), (0.5, 0.375, 0.165)
SPECULAR, SHININESS = 0.5, 12


# ---------------------------------------------------------------------------------------------------------------------
# Vectors
# ---------------------------------------------------------------------------------------------------------------------

def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(sum(k * k for k in a))
    return tuple(k / length for k in a)


def text(vector, separator):
    return separator.join("%.17g" % k for k in vector)


# ---------------------------------------------------------------------------------------------------------------------
# Shapes: spheres as (x, y, z, radius); a mesh as (vertices, triangles), triangles counted from 0, anticlockwise
# seen from outside
# ---------------------------------------------------------------------------------------------------------------------

def sphereflake(depth):
    directions = [(math.cos(i * math.pi / 3), math.sin(i * math.pi / 3), 0) for i in range(6)]
    for i in range(3):
        turn, tilt = math.pi / 6 + i * 2 * math.pi / 3, math.radians(60)
        directions.append((math.cos(turn) * math.cos(tilt), math.sin(turn) * math.cos(tilt), math.sin(tilt)))
    spheres = []

    def grow(center, radius, axis, left):
        spheres.append((*center, radius))
        if left == 0:
            return
        helper = (1, 0, 0) if abs(axis[0]) < 0.9 else (0, 1, 0)
        x = unit(cross(helper, axis))
        y = cross(axis, x)
        for d in directions:
            way = tuple(x[k] * d[0] + y[k] * d[1] + axis[k] * d[2] for k in range(3))
            grow(tuple(center[k] + way[k] * radius * 4 / 3 for k in range(3)), radius / 3, way, left - 1)

    grow((0, 0, 0), 0.5, (0, 0, 1), depth)
    return spheres


def scattered(count):
    rng, spacing = random.Random(1), (1 / count) ** (1 / 3)
    return [(*(rng.uniform(-1, 1) for _ in range(3)), rng.uniform(0.3, 0.8) * spacing) for _ in range(count)]


def bumpyBall(count):
    """An octahedron whose eight faces are cut into n * n triangles each, blown up to a ball with bumps.

    Its vertices are the points of whole numbers with |x| + |y| + |z| = n: neighbouring faces share those of their
    edge by themselves, so the mesh is closed.
    """
    n = max(1, round(math.sqrt(count / 8)))
    rng, waves, sum_of_heights = random.Random(1), [], 0
    for _ in range(16):
        frequency = rng.uniform(4, 40)
        waves.append((*(frequency * k for k in unit([rng.gauss(0, 1) for _ in range(3)])), rng.uniform(0, 2 * math.pi),
                      1 / frequency))
        sum_of_heights += 1 / frequency

    # The radius is 0.87 with bumps of at most 0.12, all waves together.
    def radiusAlong(x, y, z):
        return 0.87 + 0.12 / sum_of_heights * sum(h * math.sin(a * x + b * y + c * z + p) for a, b, c, p, h in waves)

    vertices, triangles, number_of = [], [], {}

    def vertexAt(point):
        if point not in number_of:
            number_of[point] = len(vertices)
            x, y, z = unit(point)
            radius = radiusAlong(x, y, z)
            vertices.append((x * radius, y * radius, z * radius))
        return number_of[point]

    for sx, sy, sz in ((x, y, z) for x in (1, -1) for y in (1, -1) for z in (1, -1)):
        def corner(i, j):
            return vertexAt((sx * i, sy * j, sz * (n - i - j)))

        for i in range(n):
            for j in range(n - i):
                faces = [(corner(i, j), corner(i + 1, j), corner(i, j + 1))]
                if i + j < n - 1:
                    faces.append((corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)))
                # Each mirroring turns the sense of rotation round.
                triangles.extend(face if sx * sy * sz > 0 else face[::-1] for face in faces)
    return vertices, triangles


# ---------------------------------------------------------------------------------------------------------------------
# Files: each writer takes spheres or a mesh, the other being None
# ---------------------------------------------------------------------------------------------------------------------

FORWARD = unit(tuple(-k for k in EYE))
RIGHT = unit(cross(FORWARD, (0, 0, 1)))
UP = cross(RIGHT, FORWARD)
HALF = math.tan(math.radians(FOV / 2))


def writeYaml(base, width, spheres, mesh):
    def material(color):
        return "{diffuse: [%s], specular: %g, shininess: %g}" % (text(color, ", "), SPECULAR, SHININESS)

    with open(base + ".yaml", "w") as f:
        f.write("image: {width: %d, height: %d}\n" % (width, width))
        f.write("camera: {position: [%s], look_at: [0, 0, 0], up: [0, 0, 1], fov: %g}\n" % (text(EYE, ", "), FOV))
        f.write("materials:\n  m: %s\n  ground: %s\nlights:\n" % (material(BALL_COLOR), material(GROUND_COLOR)))
        for light in LIGHTS:
            f.write("  - point: {position: [%s], color: %g, falloff: none}\n" % (text(light, ", "), LIGHT_COLOR))
        f.write("objects:\n  - plane: {point: [0, 0, %g], normal: [0, 0, 1], material: ground}\n" % GROUND)
        if mesh:
            f.write("  - mesh: {file: %s.obj, smooth: false, material: m}\n" % base.rpartition("/")[2])
        else:
            f.write("  - spheres:\n      material: m\n      data:\n")
            f.writelines("        - [%.7g, %.7g, %.7g, %.7g]\n" % s for s in spheres)


def writePov(base, width, spheres, mesh):
    def texture(color):
        return ("texture { pigment { rgb <%s> } finish { ambient 0 diffuse 1 phong %g phong_size %g } }"
                % (text(color, ","), SPECULAR, SHININESS))

    with open(base + ".pov", "w") as f:
        f.write("#version 3.7;\nglobal_settings { assumed_gamma 1.0 ambient_light 0 }\nbackground { rgb 0 }\n")
        f.write("camera { location <%s> direction <%s> right %.17g*<%s> up %.17g*<%s> }\n"
                % (text(EYE, ","), text(FORWARD, ","), 2 * HALF, text(RIGHT, ","), 2 * HALF, text(UP, ",")))
        for light in LIGHTS:
            f.write("light_source { <%s> rgb %g }\n" % (text(light, ","), LIGHT_COLOR))
        f.write("#declare M = %s\n" % texture(BALL_COLOR))
        f.write("plane { z, %g %s }\n" % (GROUND, texture(GROUND_COLOR)))
        if mesh:
            f.write("mesh2 {\nvertex_vectors { %d,\n" % len(mesh[0]))
            f.write(",\n".join("<%.7g,%.7g,%.7g>" % v for v in mesh[0]))
            f.write("\n}\nface_indices { %d,\n" % len(mesh[1]))
            f.write(",\n".join("<%d,%d,%d>" % t for t in mesh[1]))
            f.write("\n}\ntexture { M }\n}\n")
        else:
            f.writelines("sphere { <%.7g,%.7g,%.7g> %.7g texture { M } }\n" % s for s in spheres)


def writeTachyon(base, width, spheres, mesh):
    """Tachyon's camera is left-handed, so it gets the world mirrored: y is turned round. It looks through a corner of
    each pixel, so the frustum is moved by half a pixel, which brings its rays into the middle (measured).
    """
    def mirrored(vector):
        return (vector[0], -vector[1], *vector[2:])

    def material(name, color):
        return ("TEXDEF %s AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 PHONG PLASTIC %g PHONG_SIZE %g COLOR %s TEXFUNC 0\n"
                % (name, SPECULAR, SHININESS, text(color, " ")))

    with open(base + ".dat", "w") as f:
        shift = HALF / width
        f.write("BEGIN_SCENE\nRESOLUTION %d %d\nCAMERA\n ZOOM %.9g\n ASPECTRATIO 1.0\n" % (width, width, 0.5 / HALF))
        f.write(" ANTIALIASING 0\n RAYDEPTH 1\n CENTER %s\n VIEWDIR %s\n UPDIR 0 0 1\n"
                % (text(mirrored(EYE), " "), text(mirrored(FORWARD), " ")))
        f.write(" FRUSTUM %.9g %.9g %.9g %.9g\nEND_CAMERA\nBACKGROUND 0 0 0\n" % ((-HALF - shift, HALF - shift) * 2))
        for light in LIGHTS:
            f.write("LIGHT CENTER %s RAD 0.01 COLOR %s\n" % (text(mirrored(light), " "), text([LIGHT_COLOR] * 3, " ")))
        f.write(material("M", BALL_COLOR))
        f.write(material("G", GROUND_COLOR))
        f.write("PLANE CENTER 0 0 %g NORMAL 0 0 1 G\n" % GROUND)
        if mesh:
            corners = ["%.7g %.7g %.7g" % mirrored(v) for v in mesh[0]]
            f.writelines("TRI V0 %s V1 %s V2 %s M\n" % tuple(corners[k] for k in t) for t in mesh[1])
        else:
            f.writelines("SPHERE CENTER %.7g %.7g %.7g RAD %.7g M\n" % mirrored(s) for s in spheres)
        f.write("END_SCENE\n")


def writeEmbree(base, width, spheres, mesh):
    if mesh:
        with open(base + ".obj", "w") as f:
            f.writelines("v %.7g %.7g %.7g\n" % v for v in mesh[0])
            f.writelines("f %d %d %d\n" % (a + 1, b + 1, c + 1) for a, b, c in mesh[1])
    else:
        with open(base + ".sph", "w") as f:
            f.writelines("%.7g %.7g %.7g %.7g\n" % s for s in spheres)


def main():
    makers = {"flake": sphereflake, "random": scattered, "mesh": bumpyBall}
    if len(sys.argv) not in (4, 5) or sys.argv[1] not in makers or not all(n.isdigit() for n in sys.argv[2::2]):
        sys.exit(__doc__)
    kind, base = sys.argv[1], sys.argv[3]
    width = int(sys.argv[4]) if len(sys.argv) == 5 else 1024
    made = makers[kind](int(sys.argv[2]))
    spheres, mesh = (None, made) if kind == "mesh" else (made, None)
    for write in (writeYaml, writePov, writeTachyon, writeEmbree):
        write(base, width, spheres, mesh)
    print("%d triangles" % len(mesh[1]) if mesh else "%d spheres" % len(spheres))


if __name__ == "__main__":
    main()
