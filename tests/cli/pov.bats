#!/usr/bin/env bats
# eclairage pov

load helpers

@test "standard output is the default, and - means it" {
    makeScene scene.yaml
    try 0 pov scene.yaml
    isEmpty "$err"
    grep -q 'sphere' "$out"
    cp "$out" default.pov
    try 0 pov scene.yaml -o -
    cmp "$out" default.pov
    "$ECLAIRAGE" pov - <scene.yaml | cmp - default.pov
    # The command in the first comment has the name that the file will most likely get.
    mkdir folder
    cp scene.yaml folder/other.yml
    try 0 pov folder/other.yml
    head -n 5 "$out" | grep -q '+Iother\.pov '
}

@test "a file, with a note" {
    makeScene s.yaml
    try 0 pov s.yaml -o s.pov
    isEmpty "$out"
    hasLine "$err" "eclairage: wrote s.pov"
    head -n 5 s.pov | grep -q 's\.pov'
    try 0 pov -q s.yaml -o s.pov
    isEmpty "$err"
    folderHolds s.pov s.yaml
}

@test "the options change the scene" {
    makeScene s.yaml
    try 0 pov s.yaml
    cp "$out" before.pov
    for options in "--width 32" "--model simple" "--model lambert" "--bit-depth 16" "--encoding linear"; do
        # shellcheck disable=SC2086
        try 0 pov s.yaml $options
        not cmp -s "$out" before.pov || { echo "no change by $options"; return 1; }
    done
}

@test "what POV-Ray cannot say gives code 7, with the place, and writes nothing" {
    makeScene s.yaml 'render: {model: simple}'
    sed -i 's/^lights:/&\n  - point: {position: [3, 3, 3], color: 1}/' s.yaml
    try 7 pov s.yaml
    isEmpty "$out"
    grep -qE '^(s\.yaml:[0-9]+:|eclairage:).* error: ' "$err"
    try 7 pov s.yaml -o s.pov
    makeScene bias.yaml 'render: {shadow_bias: 0.1}'
    try 7 pov bias.yaml
    folderHolds bias.yaml s.yaml
}

@test "errors of reading and writing" {
    makeScene s.yaml
    try 3 pov - </dev/null
    isEmpty "$out"
    try 4 pov missing.yaml
    try 4 pov s.yaml -o missing/s.pov
    folderHolds s.yaml
}

@test "POV-Ray draws the file with the command of its first comment, whatever its name" {
    needs povray
    makeScene s.yaml
    try 0 render -q s.yaml --width 32 -o ours.png
    for name in s "l'été \"1\" \$x" -x; do
        try 0 pov s.yaml -o "./$name.pov" --width 32
        command=$(sed -n 's|^[ /*]*\(povray .*\)|\1|p' "./$name.pov" | head -n 1)
        [ -n "$command" ]
        HOME=$TMPDIR bash -c "$command" 2>"$err" || { cat "$err"; return 1; }
        isPng "./$name.png"
        try 0 diff ours.png "./$name.png" --fail 0.004 --fail-percent 1
    done
}
