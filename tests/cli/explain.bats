#!/usr/bin/env bats
# eclairage explain

load helpers

@test "a scene: each habit, the sequence and the sum, and no file" {
    needs povray
    makeScene s.yaml
    try 0 explain s.yaml
    hasLine "$out" "s.yaml, 64 x 48: POV-Ray's habits against our picture"
    for habit in falloff ambient diffuse highlight gamma left-handed angle; do
        grep -q "^  $habit  .* 0\.[0-9]* .*#" "$out"
        grep -q "^  $habit taken back  .* 0\.[0-9]*  (" "$out"
        grep -q "^[1-7]\. $habit: " "$out"
    done
    hasText "$out" "write \`light_source { P rgb L*K fade_distance D fade_power 2 }\`"
    # What the last step leaves is what the matched form leaves.
    tail -1 "$out" | grep -qE '^explained (0\.[0-9]{5}) of \1, left (0|[0-9.]+e-0[6-9], which is rounding)$'
    grep -q "^  matched, with none  .* 0\.00000$" "$out"
    grep -qE '^eclairage: 15 pictures in [0-9]+\.[0-9] s$' "$err"
    folderHolds s.yaml
    # In lines that fit a terminal, without colour.
    not grep -E '.{81}' "$out"
    not grep -q $'\033' "$out"
    try 0 explain s.yaml --color always --quiet
    grep -q $'\033' "$out"
    isEmpty "$err"
}

@test "JSON: causes, the largest first, with what is left" {
    needs povray
    makeScene s.yaml
    try 0 explain s.yaml --json --quiet
    isEmpty "$err"
    json '.causes | length == 7 and all(.text != "" and (.where | startswith("write ")) and .residual >= 0)'
    json '[.causes[].cause] | sort == ["ambient", "aspect", "blinn", "exposure", "falloff", "gamma", "mirrored"]'
    json '.causes[6].residual < 1.6e-5 and .causes[0].residual > 1e-3'
    json '.causes[0] | keys == ["cause", "residual", "text", "where"]'
}

@test "--out: a page that needs nothing else, the pictures and the scenes" {
    needs povray
    makeScene s.yaml
    try 0 explain s.yaml --json --out new/folder
    cmp "$out" new/folder/results.json
    hasLine "$err" "eclairage: the report is new/folder/index.html"
    for name in native matched falloff ambient diffuse highlight gamma left-handed angle; do
        [ -s new/folder/$name.pov ]
        isPng new/folder/$name.png
        isPng new/folder/$name-difference.png
    done
    [ "$(find new/folder -type f | wc -l)" = 30 ]
    # The matched picture is ours; the native scene renders by its first line to the native picture.
    try 0 diff new/folder/ours.png new/folder/matched.png --fail 3.1e-5 --fail-percent 0
    try 1 diff new/folder/ours.png new/folder/native.png
    (cd new/folder && HOME=$PWD sh -c "$(sed -n '1s,^// ,,p' native.pov | sed 's,+Onative.png,+Oagain.png,')" 2>log)
    try 0 diff new/folder/native.png new/folder/again.png --hard-fail 0
    try 0 pov s.yaml
    sed 1d "$out" | diff - <(sed 1d new/folder/matched.pov)
    # Nothing from outside, and the waterfall has words.
    not grep -qE '(src|href)="(https?:)?//' new/folder/index.html
    hasText new/folder/index.html '<title id="chart-title">'
    hasText new/folder/index.html 'explain s.yaml --json --out new/folder'
    [ "$(grep -o '<section class="panel habit"' new/folder/index.html | wc -l)" = 7 ]
    [ "$(grep -o '<img [^>]*alt="[^"]' new/folder/index.html | wc -l)" = 24 ]
    nothingTemporary
}

@test "the simple model has the habits of the camera" {
    needs povray
    makeScene s.yaml 'render: {model: simple}'
    try 0 explain s.yaml --json
    json '[.causes[].cause] | sort == ["aspect", "mirrored"]'
    # White and black stay what they are, and a habit that is not seen says so.
    try 0 explain s.yaml
    hasText "$out" "In this picture nothing of it is seen."
}

@test "a scene with nothing in it has no causes" {
    needs povray
    echo 'image: {width: 40, height: 30}' >s.yaml
    try 0 explain s.yaml --json
    json '.causes == []'
    try 0 explain s.yaml --out r
    [ "$(tail -1 "$out")" = "explained 0.00000 of 0.00000, left 0" ]
    not grep -q nan r/index.html
}

@test "options: size, model, samples, engine" {
    needs povray
    makeScene s.yaml
    try 0 explain s.yaml --width 40 --height 40 --model lambert --samples 2 --engine reference --threads 2
    hasLine "$out" "s.yaml, 40 x 40: POV-Ray's habits against our picture"
    hasNoText "$out" "highlight"
    hasNoText "$out" "angle"
    hasText "$out" "which is rounding"
}

@test "a scene from standard input, and a name that is no markup" {
    needs povray
    makeScene s.yaml
    try 0 explain - <s.yaml
    hasText "$out" "<stdin>, 64 x 48"
    cp s.yaml '<b>&.yaml'
    try 0 explain '<b>&.yaml' --out r --quiet
    hasText r/index.html '&lt;b&gt;&amp;.yaml'
    hasNoText r/index.html '<b>&.yaml'
}

@test "what goes wrong" {
    needs povray
    makeScene s.yaml 'render: {shadow_bias: 0.1}'
    try 7 explain s.yaml --out r
    hasText "$err" "render.shadow_bias cannot be exported"
    isEmpty "$out"
    echo 'lights: 3' >bad.yaml
    try 3 explain bad.yaml
    hasText "$err" "bad.yaml:1:9: error:"
    try 4 explain missing.yaml
    try 2 explain
    hasText "$err" "'explain' needs a scene, a scene and a picture, or two pictures"
    makeScene s.yaml
    touch file
    try 4 explain s.yaml --out file/r
    PATH=/nowhere try 5 explain s.yaml
    hasText "$err" "POV-Ray is not installed"
    mkdir programs
    printf '#!/bin/sh\nexit 3\n' >programs/povray
    chmod +x programs/povray
    PATH=$PWD/programs:/usr/bin:/bin try 5 explain s.yaml
    hasText "$err" "POV-Ray failed with exit code 3"
    isEmpty "$out"
    nothingTemporary
}

@test "Ctrl-C ends it with 130, and nothing stays" {
    needs povray
    makeScene s.yaml
    "$ECLAIRAGE" explain s.yaml --width 1500 >"$out" 2>"$err" &
    program=$!
    sleep 0.7
    kill -INT $program
    code=0
    wait $program || code=$?
    expectCode 130 $code
    sameAs "$err" <<<"eclairage: interrupted"
    isEmpty "$out"
    folderHolds s.yaml
}
