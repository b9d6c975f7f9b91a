#!/usr/bin/env bats
# eclairage why: the story of one pixel

load helpers

# The whole text of a scene with a light that reaches the point and one that is blocked.
makeTwoLights() { # FILE
    cat >"$1" <<'END'
image: {width: 3, height: 3}
lights:
  - point: {position: [0, 0, 0], color: 10}
  - point: {position: [0, 4, 0], color: 10}
objects:
  - sphere: {center: [0, 0, -5], radius: 1.5, material: {diffuse: [1, 0, 0], specular: 0.5, shininess: 2}}
  - sphere: {center: [0, 2, -1.75], radius: 0.25}
END
}

# A PATH without POV-Ray, on which the program itself can still be run.
withoutPovray() {
    mkdir -p "$BATS_TEST_TMPDIR/empty"
    PATH=$BATS_TEST_TMPDIR/empty "$ECLAIRAGE" "$@" >"$out" 2>"$err"
}

# To renew: the command below, without POV-Ray on the PATH, >tests/cli/expected/why.txt
@test "the story in words" {
    makeTwoLights s.yaml
    withoutPovray why s.yaml 1 1
    isEmpty "$err"
    sameAs "$out" <"$root/tests/cli/expected/why.txt"
}

@test "POV-Ray's value for the same pixel" {
    needs povray
    makeScene s.yaml
    try 0 why s.yaml 30 20
    hasText "$out" "POV-Ray, the same pixel"
    hasText "$out" "the two agree"
    nothingTemporary
    try 0 why --json s.yaml 30 20
    json '.povray.agrees and .povray.difference <= 0.0001'
    json '[.ours.linear_16_bit, .povray.linear_16_bit] | transpose | all(.[0] - .[1] | fabs <= 2)'
    # Samples take two runs of POV-Ray.
    try 0 why --json --samples 2 s.yaml 30 12
    json '.povray.agrees and (.samples | length) == 4'
}

@test "the value is that of the picture" {
    makeScene s.yaml
    "$ECLAIRAGE" render -q s.yaml --width 1 --height 1 --samples 3 --encoding linear --bit-depth 16 -o p.png
    try 0 why --json s.yaml 0 0 --width 1 --height 1 --samples 3 --encoding linear --bit-depth 16
    json '.ours.stored == .ours.linear_16_bit and .encoding == "linear"'
    needs python3
    python3 - p.png "$out" <<'END'
import json, struct, sys, zlib
png, story = open(sys.argv[1], "rb").read(), json.load(open(sys.argv[2]))
at = png.index(b"IDAT")
row = zlib.decompress(png[at + 4:at + 4 + struct.unpack(">I", png[at - 4:at])[0]])
assert list(struct.unpack(">3H", row[1:7])) == story["ours"]["stored"], (row, story["ours"])
END
    try 0 why --json s.yaml 30 20
    json '.encoding == "srgb" and .bit_depth == 8 and (.ours.stored | length) == 3'
}

@test "without POV-Ray the story is told, and says why there is no value" {
    makeScene s.yaml
    withoutPovray why s.yaml 30 20
    hasText "$out" "no value: POV-Ray is not installed"
    withoutPovray why --json s.yaml 30 20
    json '.povray.linear == null and .povray.error.code == 5'
}

@test "a scene that POV-Ray cannot be given: the story is told, and says why there is no value" {
    needs povray
    makeTwoLights s.yaml
    echo 'render: {model: simple}' >>s.yaml
    try 7 pov s.yaml -o s.pov
    try 0 why s.yaml 1 1
    hasText "$out" "no value: the simple model with several lights (here 2) cannot be exported"
    hasText "$out" "use one light, or shadows: false"
    try 0 why --json s.yaml 1 1
    json '.povray.linear == null and .povray.error.code == 7 and (.ours.linear | length) == 3'
    nothingTemporary
}

@test "the drawing says from where it is seen, and what a dotted way is" {
    # The first light is beside the camera's ray, so the plane lies flat.
    cat >s.yaml <<'END'
image: {width: 3, height: 3}
camera: {position: [0, 0, 5]}
lights:
  - point: {position: [9, 0, 0], color: 10}
  - point: {position: [0, 0, -90], color: 10}
objects:
  - sphere: {center: [0, 0, 0], radius: 1}
END
    withoutPovray why s.yaml 1 1 --svg s.svg
    hasText s.svg "seen from above"
    hasText s.svg "way to a light that adds nothing"
    makeTwoLights t.yaml
    withoutPovray why t.yaml 1 1 --svg t.svg
    hasText t.svg "seen from the side</title>"
    ! grep -q "way to a light that adds nothing" t.svg
}

@test "huge numbers, the widest picture and the most samples" {
    cat >s.yaml <<'END'
image: {width: 65535, height: 9}
camera: {position: [1.0e+12, 0, 0]}
lights:
  - point: {position: [1.0e+12, 4.0e+9, 0], color: 1.0e+20}
objects:
  - sphere: {center: [1.0e+12, 0, -5.0e+10], radius: 1.0e+10}
END
    for x in 0 32767 65534; do
        withoutPovray why s.yaml $x 4 --svg s.svg
        ! grep -q -w -i -e nan -e inf s.svg "$out"
    done
    withoutPovray why s.yaml 32767 4 --samples 64
    hasText "$out" "It is the mean of 4096 samples"
}

@test "a drawing or a story that cannot be written is an error" {
    makeTwoLights s.yaml
    try 4 why s.yaml 1 1 --svg /dev/full
    hasText "$err" "cannot write '/dev/full'"
    PATH=$BATS_TEST_TMPDIR "$ECLAIRAGE" why s.yaml 1 1 >&- 2>"$err" && false
    hasText "$err" "cannot write standard output"
}

@test "JSON names every number" {
    makeTwoLights s.yaml
    withoutPovray why --json s.yaml 1 1
    json '[keys_unsorted[]] == ["scene", "x", "y", "width", "height", "bit_depth", "encoding", "ours", "povray",
        "samples", "rays"]'
    json '.rays[0] | .role == "camera" and .parent == null and .distance == 3.5 and .n == [0, 0, 1]'
    json '.rays[0].objects | map([.object.line, .met]) == [[6, true], [7, false]]'
    json '.rays[0].lights[0] | .fate == "reaches" and .n_dot_l == 1 and .distance == 3.5 and .r_dot_v == 1'
    json '.rays[0].lights[1] | .fate == "blocked" and .shadow.blocker.line == 7 and .shadow.blocked_at > 2'
    json '.rays[0].terms.diffuse[0] * 12.25 - 10 | fabs < 1e-5'
    json '.ours.clamped == ["r"]'
}

@test "the drawing is well-formed, and words make way for it" {
    makeTwoLights 's & <t>.yaml'
    withoutPovray why 's & <t>.yaml' 1 1 --svg side.svg
    hasLine "$err" "eclairage: wrote side.svg"
    [ -s "$out" ]
    cp "$out" words
    withoutPovray why 's & <t>.yaml' 1 1 --svg -
    cmp "$out" side.svg
    cmp "$err" words
    needs python3
    python3 - side.svg <<'END'
import sys
import xml.dom.minidom
page = xml.dom.minidom.parse(sys.argv[1]).documentElement
assert page.tagName == "svg" and page.getAttribute("role") == "img"
assert "s & <t>.yaml" in page.getElementsByTagName("title")[0].firstChild.data
assert "blocked by the sphere of line 7" in page.getElementsByTagName("desc")[0].firstChild.data
assert len(page.getElementsByTagName("circle")) >= 4
width, height = map(float, page.getAttribute("viewBox").split()[2:])
assert width <= 720 and all(0 < float(t.getAttribute("x")) < width and 0 < float(t.getAttribute("y")) < height - 8
                            for t in page.getElementsByTagName("text")), "words outside, or smaller than a page's"
assert "http" not in page.toxml().replace("http://www.w3.org/2000/svg", "")
END
}

@test "a scene from standard input" {
    makeTwoLights s.yaml
    withoutPovray why - 1 1 <s.yaml
    hasText "$out" "Pixel (1, 1) of <stdin>, 3 x 3"
}

@test "wrong operands are told apart" {
    makeScene s.yaml
    try 2 why s.yaml
    hasLine "$err" "eclairage: error: 'why' needs a scene and a pixel: SCENE.yaml X Y"
    try 2 why s.yaml 3
    hasLine "$err" "eclairage: error: 'why' needs a scene and a pixel: SCENE.yaml X Y"
    try 2 why s.yaml 1 2 3
    hasText "$err" "'3' is too many"
    try 2 why s.yaml x 2
    hasLine "$err" "eclairage: error: X must be a whole number from 0 to 63, not 'x'"
    try 2 why s.yaml 1 2.5
    hasLine "$err" "eclairage: error: Y must be a whole number from 0 to 47, not '2.5'"
    try 2 why s.yaml -1 2
    hasLine "$err" "eclairage: error: X = -1 is outside of the picture, which has 64 x 48 pixels: X must be from 0 to 63"
    try 2 why s.yaml 64 2
    hasText "$err" "X = 64 is outside of the picture"
    try 2 why s.yaml 1 99999999999999999999
    hasText "$err" "is outside of the picture"
    try 2 why s.yaml 64 2 --width 64 --height 48
    try 2 why s.yaml '' 2
    try 2 why s.yaml 1 2 --json --svg -
    hasText "$err" "--svg - and --json would both write to standard output"
    try 2 why s.yaml 1 2 --svg s.yaml
    try 4 why s.yaml 1 2 --svg missing/side.svg
    try 4 why missing.yaml 1 2
    try 2 render -1
    hasText "$err" "unknown option '-1'"
}
