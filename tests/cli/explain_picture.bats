#!/usr/bin/env bats
# eclairage explain with a picture: of a scene, or beside another picture

load helpers

milliseconds() { echo $(($(date +%s%N) / 1000000)); }

draw() { # SCENE OUT ARGUMENT...
    "$ECLAIRAGE" render -q "$1" -o "$2" "${@:3}"
}

# A scene and its picture without shadows: s.yaml, right.png, wrong.png.
makePictures() {
    makeScene s.yaml 'render: {shadows: true}'
    sed 's/shadows: true/shadows: false/' s.yaml >wrong.yaml
    draw s.yaml right.png
    draw wrong.yaml wrong.png
}

# A PNG of this colour type, all of whose rows are the same; row and palette are hexadecimal.
makePng() { # OUT TYPE WIDTH HEIGHT DEPTH ROW [PALETTE]
    needs python3
    python3 - "$@" <<'END'
import struct, sys, zlib
out, kind, width, height, depth, row = sys.argv[1], *map(int, sys.argv[2:6]), bytes.fromhex(sys.argv[6])
def chunk(name, data):
    return struct.pack('>I', len(data)) + name + data + struct.pack('>I', zlib.crc32(name + data))
palette = chunk(b'PLTE', bytes.fromhex(sys.argv[7])) if len(sys.argv) > 7 else b''
open(out, 'wb').write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, depth, kind, 0, 0, 0))
    + palette + chunk(b'IDAT', zlib.compress((b'\0' + row) * height)) + chunk(b'IEND', b''))
END
}

# Expects that the causes are exactly these: causes NAME...
causes() {
    json --args '[.causes[].cause] == $ARGS.positional' "$@"
}

@test "a scene and its picture without shadows, word for word" {
    makePictures
    try 0 explain s.yaml wrong.png
    sameAs "$out" <<'END'
difference: root mean square error 0.0384

1. shadow: shadows are missing: nothing blocks the light
   look at: s.yaml:7: a light counts if nothing lies strictly between the point and it
   left after this: 0
END
    isEmpty "$err"
    folderHolds s.yaml right.png wrong.yaml wrong.png
    # The other way round there are shadows that the scene does not ask for.
    try 0 explain wrong.yaml right.png
    hasLine "$out" "1. shadow: there are shadows, and the scene says shadows: false"
}

@test "JSON has the contract's fields" {
    makePictures
    try 0 explain s.yaml wrong.png --json
    isEmpty "$err"
    json 'keys == ["causes"] and (.causes | length) == 1'
    json '.causes[0] | keys_unsorted == ["cause", "residual", "text", "where"]'
    json '.causes[0] | .cause == "shadow" and .residual == 0 and (.text | type) == "string"'
    json '.causes[0].where | startswith("s.yaml:7: ")'
    try 0 explain wrong.png right.png --json
    causes unknown
    json '.causes[0] | .residual > 0.01 and .text != "" and .where == "the pixels from (22, 19) to (26, 30)"'
}

@test "pictures that agree have no causes" {
    makePictures
    cp right.png same.png
    for pair in 's.yaml right.png' 'right.png same.png'; do
        # shellcheck disable=SC2086
        try 0 explain $pair
        sameAs "$out" <<<"The pictures agree: no sample differs by more than rounding."
        # shellcheck disable=SC2086
        try 0 explain --json $pair
        json '. == {"causes": []}'
        isEmpty "$err"
    done
}

@test "what is not known is not guessed" {
    [ -z "$ECLAIRAGE_SANITIZED" ] || skip "the search is slow here, and the same in the others"
    makePictures
    # Another scene's picture: one that has moved and shrunk, with a light elsewhere.
    sed 's/radius: 1.5/radius: 0.9/; s/center: \[0, 0, -5\]/center: [1.2, 0.9, -5]/; s/\[-3, 1, 1\]/[4, -2, 1]/' \
        s.yaml >other.yaml
    draw other.yaml other.png
    try 0 explain s.yaml other.png
    hasText "$out" "1. unknown: none of the mistakes that are known here fits; "
    hasText "$out" " of the pixels differ, "
    hasText "$out" "   not explained: "
    hasNoText "$out" "left after this"
    # Of one colour, a picture could be the result of nearly anything.
    makePng white.png 0 64 48 8 "$(printf 'ff%.0s' {1..64})"
    makePng black.png 0 64 48 8 "$(printf '00%.0s' {1..64})"
    for pair in 's.yaml white.png' 'white.png black.png' 'black.png white.png' 'right.png black.png' \
        'white.png right.png'; do
        # shellcheck disable=SC2086
        try 0 explain --json $pair
        causes unknown
    done
    try 0 explain --json black.png black.png
    json '.causes == []'
}

@test "from two pictures: mirrored, flipped, gamma, exposure, and from the scene too" {
    makePictures
    # The scene itself turned over: each point to the other side.
    sed 's/center: \[-1,/center: [1,/; s/position: \[-3,/position: [3,/' s.yaml >mirrored.yaml
    sed 's/position: \[-3, 1,/position: [-3, -1,/' s.yaml >flipped.yaml
    sed 's/position: \[3, 1,/position: [3, -1,/' mirrored.yaml >both.yaml
    for name in mirrored flipped both; do
        draw $name.yaml $name.png
    done
    for of in right.png s.yaml; do
        for name in mirrored flipped; do
            operands=("$name.png" "$of")
            [ $of = right.png ] || operands=("$of" "$name.png")
            try 0 explain "${operands[@]}" --json
            causes $name
            json '.causes[0].residual < 0.001'
        done
    done
    try 0 explain both.png right.png --json
    json '[.causes[].cause] | sort == ["flipped", "mirrored"]'

    # Linear samples in a file that no longer says so.
    needs python3
    draw s.yaml linear.png --encoding linear --bit-depth 16
    python3 - linear.png dark.png <<'END'
import struct, sys
data = open(sys.argv[1], 'rb').read()
kept, at = data[:8], 8
while at < len(data):
    end = at + 12 + struct.unpack('>I', data[at:at + 4])[0]
    if data[at + 4:at + 8] not in (b'gAMA', b'cHRM'):
        kept += data[at:end]
    at = end
open(sys.argv[2], 'wb').write(kept)
END
    try 0 explain s.yaml dark.png --json
    causes gamma
    json '.causes[0].text | contains("the sRGB curve is missing")'
    try 0 explain dark.png right.png --json
    causes gamma

    sed 's/color: \[20, 20, 20\]/color: [10, 10, 10]/' s.yaml >half.yaml
    draw half.yaml half.png
    try 0 explain half.png right.png
    # Through the rounding of both.
    grep -qE '^1\. exposure: all light is 0\.(5|50[01]|499) times as much as it should be$' "$out"
    try 0 explain s.yaml half.png
    hasText "$out" "1. exposure: all light is 0.5 times as much as it should be"
    hasText "$out" "look at: s.yaml:3: "
}

@test "more bits, and files with another encoding, are the same picture" {
    makePictures
    draw s.yaml deep.png --bit-depth 16
    draw s.yaml linear.png --encoding linear
    draw s.yaml deep-linear.png --bit-depth 16 --encoding linear
    for name in right deep linear deep-linear; do
        try 0 explain s.yaml $name.png --json
        json '.causes == []'
    done
    for pair in 'right.png deep.png' 'deep.png right.png' 'linear.png deep-linear.png'; do
        # shellcheck disable=SC2086
        try 0 explain --json $pair
        causes quantisation
        json '.causes[0] | .residual == 0 and (.text | contains("less than a step of 8 bits"))'
    done
    # And a mistake is found through all of them.
    for form in '--bit-depth 16' '--encoding linear' '--bit-depth 16 --encoding linear'; do
        # shellcheck disable=SC2086
        draw wrong.yaml form.png $form
        try 0 explain s.yaml form.png --json
        causes shadow
    done
}

@test "grey, palette and alpha" {
    makePictures
    makePng grey.png 0 64 48 8 "$(printf '%02x' {0..63})"
    makePng bits.png 0 64 48 1 f0f0f0f0f0f0f0f0
    makePng palette.png 3 64 48 8 "$(printf '00010201%.0s' {1..16})" 000000ff000000ff00
    makePng alpha.png 6 64 48 8 "$(printf '10203040%.0s' {1..32})$(printf '50403080%.0s' {1..32})"
    for name in grey bits palette alpha; do
        try 0 explain $name.png $name.png --json
        json '.causes == []'
    done
    try 0 explain right.png palette.png --json
    json '.causes | length > 0'
    try 0 explain s.yaml alpha.png
    hasLine "$err" "eclairage: warning: alpha.png has an alpha channel, which is ignored"
}

@test "pictures of one pixel, one column and one row" {
    makeScene s.yaml
    makePng dark.png 2 1 1 8 0a141e
    makePng light.png 2 1 1 8 c8141e
    try 0 explain dark.png light.png --json
    causes unknown
    try 0 explain dark.png dark.png --json
    json '.causes == []'
    try 0 explain s.yaml dark.png --json
    json '.causes | length == 1'
    sed -i 's/width: 64, height: 48/width: 1, height: 40/' s.yaml
    draw s.yaml column.png
    try 0 explain s.yaml column.png --json
    json '.causes == []'
    sed 's/center: \[0, 0, -5\]/center: [0, 0.5, -5]/' s.yaml >moved.yaml
    draw moved.yaml moved.png
    try 0 explain s.yaml moved.png --json
    json '.causes | length > 0'
    try 0 explain moved.png column.png --json
    json '.causes | length > 0'
    makePng row.png 0 40 1 8 "$(printf '%02x' {0..39})"
    makePng back.png 0 40 1 8 "$(printf '%02x' {39..0})"
    try 0 explain row.png back.png --json
    causes mirrored
}

@test "the scene's picture at another size of its aspect, and no other aspect" {
    makePictures
    draw wrong.yaml large.png --width 128
    try 0 explain s.yaml large.png --json
    causes shadow
    draw s.yaml square.png --width 48 --height 48
    try 6 explain s.yaml square.png
    isEmpty "$out"
    sameAs "$err" <<'END'
eclairage: error: square.png has 48 x 48 pixels, which is not the aspect of s.yaml, 64 x 48: a picture of that aspect can be explained
END
    try 6 explain right.png square.png --json
    isEmpty "$out"
    sameAs "$err" <<'END'
eclairage: error: right.png is 64 x 48 pixels and square.png 48 x 48: only pictures of one size can be explained
END
}

@test "standard input can be the scene or the picture" {
    makePictures
    try 0 explain - wrong.png <s.yaml
    hasLine "$out" "1. shadow: shadows are missing: nothing blocks the light"
    # The scene's text is gone then, so no line is named.
    hasLine "$out" "   look at: a light counts if nothing lies strictly between the point and it"
    try 0 explain s.yaml - <wrong.png
    hasText "$out" "look at: s.yaml:7: "
    try 0 explain right.png - <right.png
    hasText "$out" "The pictures agree"
    try 2 explain - - <s.yaml
    hasText "$err" "standard input (-) can be read only once"
}

@test "what goes wrong" {
    makePictures
    try 4 explain s.yaml missing.png
    hasText "$err" "cannot read 'missing.png'"
    try 4 explain missing.yaml right.png
    hasText "$err" "cannot read 'missing.yaml'"
    try 4 explain right.png missing.png
    hasText "$err" "cannot read 'missing.png'"
    echo 'lights: 3' >bad.yaml
    try 3 explain bad.yaml right.png --json
    hasText "$err" "bad.yaml:1:9: error: 'lights' must be a list, but is 3"
    isEmpty "$out"
    head -c 100 right.png >cut.png
    try 4 explain s.yaml cut.png
    hasText "$err" cut.png
    try 4 explain s.yaml s.yaml
    hasText "$err" "it is not a PNG file"

    try 2 explain right.png s.yaml
    sameAs "$err" <<<"eclairage: error: the scene comes first: eclairage explain s.yaml right.png"
    try 2 explain right.png
    hasText "$err" "right.png alone cannot be explained"
    try 2 explain s.yaml wrong.png right.png
    hasText "$err" "'right.png' is too many"
    for pair in 's.yaml right.png' 'right.png wrong.png'; do
        # shellcheck disable=SC2086
        try 2 explain $pair --width 40
        hasText "$err" "takes no --width and no --height"
        # shellcheck disable=SC2086
        try 2 explain $pair --height 40 --out folder
        isEmpty "$out"
    done
    try 2 explain right.png wrong.png --model lambert
    hasText "$err" "there is none"
    not [ -e folder ]
}

# Draws what is on standard input as s.yaml, and with a sed script applied to it: explained SCRIPT CAUSE...
explained() {
    cat >s.yaml
    sed "$1" s.yaml >wrong.yaml
    not cmp -s s.yaml wrong.yaml
    draw s.yaml right.png 2>/dev/null
    draw wrong.yaml wrong.png 2>/dev/null
    try 0 explain s.yaml right.png --json --quiet
    json '.causes == []'
    try 0 explain s.yaml wrong.png --json --quiet
    causes "${@:2}"
}

image='image: {width: 96, height: 72}'
light='lights: [{point: {position: [-3, 1, 1], color: [20, 20, 20]}}]'
spheres='objects:
  - sphere: {center: [0, 0, -5], radius: 1.5, material: {diffuse: [1, 0, 0], specular: 0.5}}
  - sphere: {center: [-1, 0, -3.5], radius: 0.5, material: {diffuse: [0, 1, 0]}}'
shadowless='s/shadows: true/shadows: false/'

@test "scenes of every kind: several samples, an orthographic camera, glass, many lights, solids" {
    [ -z "$ECLAIRAGE_SANITIZED" ] || skip "the search is slow here, and the same in the others"
    printf '%s\n' "$image" 'render: {shadows: true, samples: 3}' "$light" "$spheres" | explained "$shadowless" shadow
    printf '%s\n' "$image" 'render: {shadows: true}' 'camera: {projection: orthographic, view_height: 5}' \
        "$light" "$spheres" | explained "$shadowless" shadow
    printf '%s\n' "$image" 'render: {shadows: true}' "$light" "$spheres" \
        '  - sphere: {center: [1, 0, -3], radius: 0.5, material: {transmission: 0.8, reflection: 0.1, ior: 1.5}}' |
        explained "$shadowless" shadow
    {
        printf '%s\n' "$image" 'render: {shadows: true}' lights:
        awk 'BEGIN { for (i = 0; i < 40; i++)
            printf "  - point: {position: [%d, %d, 1], color: 1}\n", i % 8 - 4, i / 8 }'
        printf '%s\n' "$spheres"
    } | explained "$shadowless" shadow
    printf '%s\n' "$image" 'render: {model: simple}' "$spheres" | explained 's/\[1, 0, 0\]/[0, 0, 1]/' channels
    # The exponents of a solid's parts are looked at too.
    printf '%s\n' "$image" "$light" 'objects:' '  - difference:' '      objects:' \
        '        - sphere: {center: [0, 0, -5], radius: 1.5, material: {specular: 0.9, shininess: 20}}' \
        '        - sphere: {center: [1, 0, -3.5], radius: 0.9, material: {specular: 0.9, shininess: 20}}' |
        explained 's/shininess: 20/shininess: 90/' shininess
}

@test "scenes with no light or no object" {
    printf '%s\n' "$image" "$spheres" | explained 's/diffuse: \[1, 0, 0\]/&, emission: 0.4/' unknown
    printf '%s\n' "$image" 'background: [0.2, 0.3, 0.4]' | explained 's/0.2, 0.3/0.5, 0.1/' unknown
    printf '%s\n' "$image" 'background: {gradient: {bottom: 0, top: 0.4}}' | explained 's/top: 0.4/top: 0.2/' exposure
}

# A mistake in one part: planted CAUSE SED-SCRIPT TEXT LINE, where LINE of the scene is what to look at.
planted() {
    sed "$2" part.yaml >wrong.yaml
    not cmp -s part.yaml wrong.yaml
    draw wrong.yaml wrong.png
    try 0 explain part.yaml wrong.png --json
    causes "$1"
    json --arg text "$3" --arg where "part.yaml:$4: " \
        '.causes[0] | .text == $text and (.where | startswith($where)) and .residual < 0.001'
}

@test "a mistake in one object, one material or one lamp is named with its line" {
    [ -z "$ECLAIRAGE_SANITIZED" ] || skip "the search is slow here, and the same in the unit tests"
    cat >part.yaml <<'END'
image: {width: 96, height: 72}
camera: {position: [0, 1, 1], look_at: [0, 0, -5], fov: 50}
materials: {shiny: {diffuse: [0.8, 0.3, 0.1], specular: 0.5, shininess: 20}}
lights:
  - point: {position: [-3, 4, 1], color: [20, 18, 16]}
  - point: {position: [4, 3, -1], color: [8, 9, 12]}
objects:
  - plane: {point: [0, -1, 0], normal: [0, 1, 0]}
  - sphere: {center: [-1.3, 0, -5], radius: 1, material: shiny}
  - sphere: {center: [1, -0.4, -4], radius: 0.6, material: shiny}
  - cube: {center: [1.5, -0.4, -6], size: 1.2, material: {diffuse: [0.1, 0.3, 0.7]}}
END
    planted unknown 10d "it is as if the sphere of line 10 were not there" 10
    planted shadow '9s/}$/, casts_shadow: false}/' \
        "the sphere of line 9 throws no shadow; those of the other objects are right" 9
    planted unknown 's/0.8, 0.3, 0.1/0.1, 0.3, 0.6/' \
        "it is as if the sphere of line 9 and the other object of its material had diffuse about [0.1, 0.3, 0.6] where the scene says [0.8, 0.3, 0.1]" 9
    planted unknown 's/0.1, 0.3, 0.7/0.9, 0.3, 0.2/' \
        "it is as if the cube of line 11 had diffuse about [0.9, 0.3, 0.2] where the scene says [0.1, 0.3, 0.7]" 11
    planted unknown 's/8, 9, 12/2, 9, 20/' \
        "light 2 (line 6) has about the color [2, 9, 20] where the scene says [8, 9, 12]" 6
    planted exposure 6d "light 2 is missing" 6
    planted unknown 's/radius: 1,/radius: 0.8,/' \
        "it is as if the sphere of line 9 were 0.8 times as large: radius 0.8" 9

    # In words it has a name, of which JSON has none.
    try 0 explain part.yaml wrong.png --out page
    hasText "$out" "1. another scene: it is as if the sphere of line 9 were 0.8 times as large: radius 0.8"
    hasText "$out" "left after this: "
    hasText page/index.html "were 0.8 times as large: radius 0.8"
    hasText page/index.html "The difference has one cause: an object, a material or a lamp that is another one."
}

@test "other settings of the picture are told at once, and before specks" {
    makePictures
    draw s.yaml finer.png --samples 3
    try 0 explain s.yaml finer.png --json
    causes unknown
    json '.causes[0] | .residual == 0 and .text == "it is as if samples were 3 where the scene has 1"'
    hasText "$out" '"where": "s.yaml:'
    cat >mirror.yaml <<'END'
image: {width: 96, height: 72}
lights: [{point: {position: [-3, 3, 1], color: 30}}]
objects:
  - sphere: {center: [-1, 0, -5], radius: 1, material: {transmission: 0.9, ior: 1.4}}
  - sphere: {center: [1, 0, -5], radius: 1, material: {reflection: 0.8}}
  - plane: {point: [0, -1, 0], normal: [0, 1, 0]}
END
    sed '1irender: {max_depth: 2}' mirror.yaml >shallow.yaml
    draw shallow.yaml shallow.png
    try 0 explain mirror.yaml shallow.png
    hasText "$out" "1. another scene: it is as if max_depth were 2 where the scene has 5"
    hasText "$out" "   look at: render.max_depth: a ray past it, in mirrors and glass, is black"
    hasText "$out" "   left after this: 0"
}

@test "where nothing fits, the objects that differ are named" {
    [ -z "$ECLAIRAGE_SANITIZED" ] || skip "the search is slow here, and the same in the unit tests"
    makePictures
    # One that the scene does not have.
    { cat s.yaml; echo '  - sphere: {center: [0.6, 0.4, -3], radius: 0.3, material: {diffuse: [0, 0, 1]}}'; } |
        sed '/^render/d' >other.yaml
    sed -i '/^render/d' s.yaml
    draw other.yaml other.png
    try 0 explain s.yaml other.png
    hasText "$out" "1. unknown: none of the mistakes that are known here fits; "
    grep -qE "; there the scene shows the sphere of line 5 \([0-9.]+ % of it\)" "$out"
    grep -qE "^   look at: the pixels from \([0-9]+, [0-9]+\) to \([0-9]+, [0-9]+\), s.yaml:5$" "$out"
}

@test "a black picture cannot tell missing lights from flipped normals, and says so" {
    makeScene s.yaml
    sed 's/color: \[20, 20, 20\]/color: 0/' s.yaml >dark.yaml
    draw dark.yaml dark.png
    try 0 explain s.yaml dark.png --json
    json '.causes[0].text | contains("the picture is black, as it is without lights, with normals that point into the objects")'
    # With light of its own, a surface would be seen without lights: then it can tell.
    makeScene lit.yaml
    sed -i '5s/specular: 0.5/specular: 0.5, emission: 0.3/' lit.yaml
    try 0 explain lit.yaml dark.png --json
    json '.causes[0].text | contains("the picture is black") | not'
}

# Ctrl-C while a scene or two large pictures are searched, at several times.
@test "Ctrl-C ends it within a second with 130" {
    cat >large.yaml <<'END'
image: {width: 900, height: 600}
lights: [{point: {position: [0, 9, 0], color: 50}}]
objects:
  - sphere: {center: [0, 0, -6], radius: 2, material: {transmission: 0.5, ior: 1.3}}
END
    sed 's/\[0, 9, 0\]/[5, 2, 3]/; s/radius: 2/radius: 1.6/' large.yaml >other.yaml
    draw large.yaml right.png
    draw other.yaml wrong.png
    for pair in 'large.yaml wrong.png' 'wrong.png right.png'; do
        for delay in 0.15 0.4 0.8; do
            # shellcheck disable=SC2086
            "$ECLAIRAGE" explain $pair >"$out" 2>"$err" &
            program=$!
            sleep $delay
            start=$(milliseconds)
            kill -INT $program
            code=0
            wait $program || code=$?
            took=$(($(milliseconds) - start))
            expectCode 130 $code
            sameAs "$err" <<<"eclairage: interrupted"
            isEmpty "$out"
            [ -n "$ECLAIRAGE_SANITIZED" ] || [ $took -lt 1000 ] || {
                echo "$pair after $delay s: it took $took ms"
                return 1
            }
        done
    done
    nothingTemporary
}
