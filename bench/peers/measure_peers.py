#!/usr/bin/env python3
"""Draws the benchmark scenes with us and with the peers, several rounds in one run, and prints the table of ratios.

    measure_peers.py --program eclairage --tools FOLDER --folder TEMPORARY [--engine E] [--rounds N] [--width N]
                     [--results FILE] [SCENE...]

bench/peers.sh calls it. FOLDER has what that script compiled: same_picture, yaml_parse, and where they could be
compiled embree_peer and engine_frames. SCENE is flakeDEPTH, rndCOUNT, meshCOUNT (a count may end in k or m), `course` for
the handout's scenes, `4k` for one of them at 3840x2160; all that the table has by default.

In each round everybody draws, one after the other, so that what else the machine does hits all of them. The least of
each one's times is kept, and a ratio is one least by another; the median is printed beside it. A ratio counts only
while the peer draws the same picture: that is measured too, and a picture that differs ends the program with 1, as a
renderer that fails does. A target that is missed is only said: the table is for reading.
"""
import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
THREADS = 2  # of every renderer; embree_peer has it built in
SLOW, SLOW_ROUNDS = 5, 2  # what takes longer than SLOW seconds is run in so many rounds only
FRAMES = 5
OUR_RUNS = 3  # in each round, while they take less than SLOW seconds together; embree_peer draws five frames
COURSE_ROUNDS = 3

# At least so many times as fast as a peer: Embree's trace, POV-Ray's, Tachyon's, POV-Ray's whole process.
TARGETS = {
    "flake4": {"embree": 3.5, "povray": 12, "tachyon": 4, "povray whole": 8},
    "flake5": {"embree": 2.8, "povray": 12, "tachyon": 4, "povray whole": 5},
    "rnd100k": {"embree": 2.8, "povray": 12, "tachyon": 4, "povray whole": 5},
    "rnd1m": {"embree": 2.0, "povray": 12, "tachyon": 4, "povray whole": 5},
    "mesh70k": {"embree": 1.5},
    "mesh1m": {"embree": 1.5},
}
COURSE_TARGET = 20
ALL = [*TARGETS, "course", "4k"]

# The share of pixels, in percent, that may be off by more than 2/255 (same_picture.c): twice what was measured of
# Embree, whose hits and shadows are float (bench/NOTES.md), and some pixels at edges of the others.
PICTURE_TOLERANCE = {"embree": 0.1, "povray": 0.02, "tachyon": 0.02}
NAMES = {"embree": "Embree", "povray": "POV-Ray", "tachyon": "Tachyon"}
PACKAGES = {"embree": "libembree-dev 3", "povray": "povray", "tachyon": "tachyon-bin-nox"}


class Failure(Exception):
    pass


# ---------------------------------------------------------------------------------------------------------------------
# Running
# ---------------------------------------------------------------------------------------------------------------------

def run(command, folder):
    """Run it there; returns its wall time in seconds and all it printed."""
    # A home of its own keeps the user's settings of POV-Ray out.
    environment = dict(os.environ, HOME=folder, POVINI=os.path.join(folder, "empty.ini"))
    start = time.perf_counter()
    try:
        done = subprocess.run(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, errors="replace", timeout=600)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise Failure("%s: %s" % (os.path.basename(command[0]), error)) from error
    took = time.perf_counter() - start
    if done.returncode != 0:
        last = (done.stderr.strip() or done.stdout.strip() or "nothing was printed").splitlines()[-1]
        raise Failure("%s ended with %d: %s" % (os.path.basename(command[0]), done.returncode, last))
    return took, done.stdout + done.stderr


def find(pattern, output, program):
    match = re.search(pattern, output)
    if not match:
        raise Failure("%s printed no %s" % (program, pattern))
    return match[1]


def picture(scene, peer):
    return "%s-%s.%s" % (scene, peer, "pgm" if peer == "embree" else "ppm")


class Seconds:
    """What was measured: for (scene, renderer, part) all times, from which come the least and the median."""

    def __init__(self):
        self.times = {}

    def add(self, scene, renderer, **parts):
        for part, seconds in parts.items():
            self.times.setdefault((scene, renderer, part), []).append(seconds)

    def count(self, scene, renderer, part):
        return len(self.times.get((scene, renderer, part), []))

    def summary(self, scene, renderer, part, how=min):
        times = self.times.get((scene, renderer, part))
        return how(times) if times else None

    def asJson(self):
        tree = {}
        for (scene, renderer, part), times in self.times.items():
            tree.setdefault(scene, {}).setdefault(renderer, {})[part] = {
                "least": round(min(times), 6), "median": round(statistics.median(times), 6), "runs": len(times)}
        return tree


# ---------------------------------------------------------------------------------------------------------------------
# The renderers: each draws a scene once and returns its times by part
# ---------------------------------------------------------------------------------------------------------------------

class Bench:
    def __init__(self, options):
        self.options = options
        self.folder = options.folder
        self.seconds = Seconds()
        self.rows = []
        self.failures = []
        self.versions = {}
        self.bytes = {}
        self.peers = []
        open(os.path.join(self.folder, "empty.ini"), "w").close()

    def tool(self, name):
        path = os.path.join(self.options.tools, name)
        return path if os.path.exists(path) else None

    def findPeers(self):
        found = {"embree": self.tool("embree_peer"), "povray": shutil.which("povray"),
                 "tachyon": shutil.which("tachyon")}
        for peer, program in found.items():
            if program:
                self.peers.append(peer)
            else:
                print("%s: skipped, it is not installed (apt-get install %s)." % (NAMES[peer], PACKAGES[peer]))
        if "povray" in self.peers:
            _, said = run(["povray", "--version"], self.folder)
            self.versions["povray"] = find(r"POV-Ray (\S+)", said, "povray")

    def renderOurs(self, path, output, threads, *more):
        took, said = run([self.options.program, "render", path, "-o", output, "--engine", self.options.engine,
                          "--threads", str(threads), "--json", "--quiet", *more], self.folder)
        result = json.loads(said)
        return {"whole": took, **result["seconds"]}, result

    def renderEmbree(self, scene):
        shapes = scene + (".obj" if scene.startswith("mesh") else ".sph")
        command = [self.tool("embree_peer"), shapes, str(self.options.width), picture(scene, "embree")]
        _, said = run(command, self.folder)
        result = json.loads(said)
        self.versions["embree"] = result["version"]
        return {part: result[part] for part in ("build", "trace")}

    def renderPovray(self, scene, width, height, output):
        took, said = run(["povray", "+I%s.pov" % scene, "+W%d" % width, "+H%d" % height, "+WT%d" % THREADS, "-D",
                          *output], self.folder)
        return {"whole": took, "trace": float(find(r"Trace Time:.*\(([0-9.]+) seconds\)", said, "povray"))}

    def renderTachyon(self, scene):
        took, said = run(["tachyon", scene + ".dat", "+V", "-numthreads", str(THREADS), "-shade_phong",
                          "-format", "PPM", "-o", picture(scene, "tachyon")], self.folder)
        self.versions["tachyon"] = find(r"Tachyon.*Version (\S+)", said, "tachyon")
        return {"whole": took, "trace": float(find(r"Ray Tracing Time:\s*([0-9.]+)", said, "tachyon"))}

    # -----------------------------------------------------------------------------------------------------------------
    # Rounds
    # -----------------------------------------------------------------------------------------------------------------

    def attempt(self, scene, renderer, part, draw, rounds):
        """One run, unless it is slow and has had its rounds; one that fails is said, and not run again."""
        least = self.seconds.summary(scene, renderer, part) or 0
        if (scene, renderer) in self.failures or self.seconds.count(scene, renderer, part) >= rounds:
            return
        if least > SLOW and self.seconds.count(scene, renderer, part) >= SLOW_ROUNDS:
            return
        try:
            self.seconds.add(scene, renderer, **draw())
        except Failure as failure:
            print("%s: %s" % (scene, failure), flush=True)
            self.failures.append((scene, renderer))

    def renderFrames(self, scene, threads):
        _, said = run([self.tool("engine_frames"), scene + ".yaml", str(threads), str(FRAMES)], self.folder)
        result = json.loads(said)
        self.bytes[scene] = result["bytes"]
        return {part: result[part] for part in ("compile", "trace")}

    def drawOurs(self, scene, threads):
        renderer = "ours"
        spent, drawn = 0, 0
        while drawn < OUR_RUNS and spent < SLOW and (scene, renderer) not in self.failures:
            before = time.perf_counter()
            self.attempt(scene, renderer, "whole", lambda: self.renderOurs(scene + ".yaml", "ours.png", threads)[0],
                         self.options.rounds * OUR_RUNS)
            spent += time.perf_counter() - before
            drawn += 1

    def drawScene(self, scene):
        width, rounds = self.options.width, self.options.rounds
        draw = {
            "embree": lambda: self.renderEmbree(scene),
            "povray": lambda: self.renderPovray(scene, width, width,
                                                ["+O" + picture(scene, "povray"), "+FP16", "File_Gamma=1.0"]),
            "tachyon": lambda: self.renderTachyon(scene),
        }
        self.drawOurs(scene, THREADS)
        self.attempt(scene, "frames", "trace", lambda: self.renderFrames(scene, THREADS), rounds)
        for peer in self.peers:
            self.attempt(scene, peer, "trace", draw[peer], rounds)
        self.attempt(scene, "frames on 1 thread", "trace", lambda: self.renderFrames(scene, 1), rounds)
        if scene == "rnd1m":
            self.attempt(scene, "libyaml", "whole",
                         lambda: {"whole": run([self.tool("yaml_parse"), scene + ".yaml"], self.folder)[0]}, rounds)

    def drawCourse(self):
        for path in self.coursePaths():
            scene = "course/" + os.path.basename(path)[:-len(".yaml")]
            base = scene.replace("/", "-")
            if self.seconds.count(scene, "ours", "whole") == 0:
                run([self.options.program, "pov", path, "--quiet", "-o", base + ".pov"], self.folder)
            size = {}

            def drawOurs():
                seconds, result = self.renderOurs(path, "ours.png", THREADS)
                size.update(result)
                return seconds

            for _ in range(OUR_RUNS):
                self.attempt(scene, "ours", "whole", drawOurs, COURSE_ROUNDS * OUR_RUNS)
            if size and "povray" in self.peers:
                self.attempt(scene, "povray", "whole",
                             lambda: self.renderPovray(base, size["width"], size["height"], ["+O%s.png" % base, "+FN"]),
                             COURSE_ROUNDS)

    def drawLarge(self):
        size = ["--width", "3840", "--height", "2160"]
        self.attempt("4k", "ours", "whole", lambda: self.renderOurs(self.largePath(), "ours.png", THREADS, *size)[0],
                     self.options.rounds)

    @staticmethod
    def coursePaths():
        folder = os.path.join(HERE, "..", "..", "scenes", "course")
        return [os.path.join(folder, name) for name in sorted(os.listdir(folder)) if name.endswith(".yaml")]

    @staticmethod
    def largePath():
        return os.path.join(HERE, "..", "..", "scenes", "course", "05-phong.yaml")

    # -----------------------------------------------------------------------------------------------------------------
    # Rows
    # -----------------------------------------------------------------------------------------------------------------

    def addRow(self, row, scene, value, unit, at_least=None, at_most=None, median=None, **details):
        met = None
        if at_least is not None or at_most is not None:
            met = (at_least is None or value >= at_least) and (at_most is None or value <= at_most)
        entry = {"row": row, "scene": scene, "value": round(value, 4), "unit": unit}
        if median is not None:
            entry["median"] = round(median, 4)
        if at_least is not None:
            entry["at_least"] = at_least
        if at_most is not None:
            entry["at_most"] = round(at_most, 4)
        if met is not None:
            entry["met"] = met
        self.rows.append({**entry, **details})

    def addRatio(self, row, above, below, scene=None, **target):
        """A row of two times, each (scene, renderer, part); none where one was not measured."""
        top, bottom = self.seconds.summary(*above), self.seconds.summary(*below)
        if top is None or not bottom:
            return
        median = self.seconds.summary(*above, statistics.median) / self.seconds.summary(*below, statistics.median)
        self.addRow(row, scene or below[0], top / bottom, "times", median=median, **target)

    def addSceneRows(self, scenes):
        def eachScene(row, peer, part, target, ours="ours"):
            for scene in scenes:
                self.addRatio(row, (scene, peer, part), (scene, ours, part),
                              at_least=TARGETS.get(scene, {}).get(target))

        eachScene("trace: Embree / ours", "embree", "trace", "embree", "frames")
        eachScene("trace: POV-Ray / ours", "povray", "trace", "povray")
        eachScene("trace: Tachyon / ours", "tachyon", "trace", "tachyon")
        eachScene("whole process: POV-Ray / ours", "povray", "whole", "povray whole")
        for scene in scenes:
            self.addRatio("trace: one thread / two", (scene, "frames on 1 thread", "trace"), (scene, "frames", "trace"),
                          at_least=1.9)
        if "rnd1m" in scenes:
            self.addRatio("whole process: ours / libyaml's parse", ("rnd1m", "ours", "whole"),
                          ("rnd1m", "libyaml", "whole"), at_most=1.7)
            self.addRatio("compile: ours / Embree's build", ("rnd1m", "frames", "compile"), ("rnd1m", "embree", "build"),
                          at_most=1.0)
            self.addBytesRow()
        if "rnd1m" in scenes and "rnd100k" in scenes:
            self.addRatio("trace: rnd1m / rnd100k", ("rnd1m", "frames", "trace"), ("rnd100k", "frames", "trace"),
                          scene="rnd1m", at_most=1.8)

    def addBytesRow(self):
        if "rnd1m" in self.bytes:
            self.addRow("compiled scene, bytes a sphere", "rnd1m", self.bytes["rnd1m"] / 1e6, "bytes", at_most=100)

    def addCourseRow(self):
        """One row, of the scene where we are ahead by the least; the others are in the results."""
        ratios = {}
        for scene in sorted({key[0] for key in self.seconds.times if key[0].startswith("course/")}):
            ours, theirs = (self.seconds.summary(scene, who, "whole") for who in ("ours", "povray"))
            if ours and theirs:
                ratios[scene] = theirs / ours
        if ratios:
            worst = min(ratios, key=ratios.get)
            self.addRow("whole process: POV-Ray / ours, least of %d" % len(ratios), worst, ratios[worst], "times",
                        at_least=COURSE_TARGET)

    def addLargeRow(self):
        """At most 2.5 times the trace or 0.25 s more than it, whichever is larger."""
        whole, trace = (self.seconds.summary("4k", "ours", part) for part in ("whole", "trace"))
        if whole:
            scene = os.path.basename(self.largePath())[:-len(".yaml")]
            self.addRow("whole process: ours at 3840x2160", scene, whole, "seconds", trace=round(trace, 4),
                        at_most=max(2.5 * trace, trace + 0.25),
                        median=self.seconds.summary("4k", "ours", "whole", statistics.median))

    def comparePictures(self, scenes):
        """A row for each peer's picture: ours in 16 bits, linear, against it."""
        for scene in scenes:
            try:
                self.renderOurs(scene + ".yaml", scene + ".png", THREADS, "--bit-depth", "16", "--encoding", "linear")
            except Failure as failure:
                self.failures.append((scene, "ours"))
                print("%s: %s" % (scene, failure))
                continue
            for peer in self.peers:
                if (scene, peer) not in self.failures:
                    self.comparePicture(scene, peer)

    def comparePicture(self, scene, peer):
        try:
            _, said = run([self.tool("same_picture"), scene + ".png", picture(scene, peer)], self.folder)
        except Failure as failure:
            self.failures.append((scene, peer))
            print("%s: %s" % (scene, failure))
            return
        result = json.loads(said)
        self.addRow("picture: " + NAMES[peer], scene, 100 * result["off"] / result["pixels"], "percent of pixels off",
                    at_most=PICTURE_TOLERANCE[peer])

    # -----------------------------------------------------------------------------------------------------------------
    # What is printed and written
    # -----------------------------------------------------------------------------------------------------------------

    def printTable(self):
        print("\n%-44s %-16s %9s %9s %9s" % ("", "scene", "best", "median", "target"))
        for row in self.rows:
            target = (">= %g" % row["at_least"] if "at_least" in row else
                      "<= %.4g" % row["at_most"] if "at_most" in row else "")
            print("%-44s %-16s %9.3f %9s %9s  %s" % (
                row["row"], row["scene"], row["value"], "%.3f" % row["median"] if "median" in row else "", target,
                {True: "met", False: "MISSED", None: ""}[row.get("met")]))
        judged = [row for row in self.rows if "met" in row]
        print("%d of %d targets met" % (sum(row["met"] for row in judged), len(judged)))
        self.judgePictures()

    def judgePictures(self):
        compared = [row for row in self.rows if row["row"].startswith("picture: ")]
        for row in compared:
            if not row["met"]:
                print("%s: %s draws another picture than we do: %.3f %% of the pixels are off"
                      % (row["scene"], row["row"][len("picture: "):], row["value"]))
                self.failures.append((row["scene"], row["row"]))
        if compared and all(row["met"] for row in compared):
            print("pictures agree: all %d" % len(compared))

    def writeResults(self, path):
        """A row is a line, so that a change of one is seen as such. Renamed from a file beside it, so that there is
        never half a file.
        """
        head = {"machine": machine(), "engine": self.options.engine, "width": self.options.width, "threads": THREADS,
                "rounds": self.options.rounds, "versions": dict(sorted(self.versions.items()))}
        seconds = self.seconds.asJson()
        with open(path + ".new", "w") as out:
            out.write("{\n")
            for key, value in head.items():
                out.write("%s: %s,\n" % (json.dumps(key), json.dumps(value)))
            out.write('"rows": [\n%s\n],\n' % ",\n".join("  " + json.dumps(row) for row in self.rows))
            out.write('"seconds": {\n%s\n}\n}\n' % ",\n".join(
                "  %s: %s" % (json.dumps(scene), json.dumps(seconds[scene])) for scene in seconds))
        os.replace(path + ".new", path)
        print("written: %s" % os.path.relpath(path))


def machine():
    model = "unknown"
    try:
        with open("/proc/cpuinfo") as lines:
            model = next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), model)
    except OSError:
        pass
    return {"processor": model, "cores": len(os.sched_getaffinity(0))}


def makeScene(scene, bench):
    kind, number = re.fullmatch(r"(flake|rnd|mesh)(\d+[km]?)", scene).groups()
    number = number.replace("k", "000").replace("m", "000000")
    run([sys.executable, os.path.join(HERE, "make_peer_scene.py"), {"rnd": "random"}.get(kind, kind), number, scene,
         str(bench.options.width)], bench.folder)


def main():
    parser = argparse.ArgumentParser(description="Times us and the peers; called by bench/peers.sh.")
    for name in ("program", "tools", "folder"):
        parser.add_argument("--" + name, required=True, type=os.path.abspath)
    parser.add_argument("--engine", default="fast")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--width", type=int, default=1024)
    parser.add_argument("--results", type=os.path.abspath)
    parser.add_argument("scene", nargs="*", default=ALL)
    options = parser.parse_args()
    for scene in options.scene:
        if scene not in ALL and not re.fullmatch(r"(flake|rnd|mesh)\d+[km]?", scene):
            parser.error("there is no scene '%s'; there are %s, and others of these kinds" % (scene, ", ".join(ALL)))

    bench = Bench(options)
    bench.findPeers()
    scenes = [scene for scene in options.scene if scene not in ("course", "4k")]
    for scene in scenes:
        makeScene(scene, bench)
    for number in range(options.rounds):
        print("round %d of %d" % (number + 1, options.rounds), flush=True)
        for scene in scenes:
            bench.drawScene(scene)
        if "course" in options.scene and number < COURSE_ROUNDS:
            bench.drawCourse()
        if "4k" in options.scene:
            bench.drawLarge()

    bench.addSceneRows(scenes)
    bench.addCourseRow()
    bench.addLargeRow()
    bench.comparePictures(scenes)
    bench.printTable()
    if options.results and not bench.failures:
        bench.writeResults(options.results)
    elif options.results:
        print("the results were not written: see above")
    return 1 if bench.failures else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Failure as failure:
        sys.exit("bench/peers: %s" % failure)
    except KeyboardInterrupt:
        sys.exit(130)
