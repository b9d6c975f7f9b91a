#!/usr/bin/env bats
# eclairage render

load helpers

@test "the picture stands beside the scene, and only it" {
    mkdir scenes
    makeScene scenes/one.yaml
    try 0 render scenes/one.yaml
    isEmpty "$out"
    grep -qxE 'eclairage: wrote scenes/one.png \(64 x 48, [0-9.]+ s\)' "$err"
    isPng scenes/one.png
    [ "$(ls -A scenes)" = "$(printf 'one.png\none.yaml')" ]
    folderHolds scenes
}

@test "the picture's name comes from the scene's" {
    makeScene a.yml
    makeScene B.YAML
    makeScene plain
    makeScene .yaml
    makeScene two.parts.yaml
    for scene in a.yml B.YAML plain .yaml two.parts.yaml; do
        try 0 render -q $scene
        isEmpty "$out" "$err"
    done
    folderHolds .yaml .yaml.png B.YAML B.png a.png a.yml plain plain.png two.parts.png two.parts.yaml
}

@test "standard input and standard output" {
    makeScene s.yaml
    try 0 render -q s.yaml
    "$ECLAIRAGE" render - -o - <s.yaml >stdout.png 2>"$err"
    isEmpty "$err"
    cmp stdout.png s.png
    "$ECLAIRAGE" render -q - -o named.png <s.yaml
    cmp named.png s.png
}

@test "the same picture for any number of threads, and each option changes it" {
    makeScene s.yaml
    try 0 render -q s.yaml -o one.png --threads 1
    try 0 render -q s.yaml -o many.png --threads 7
    cmp one.png many.png
    try 0 render -q s.yaml -o same.png --samples 1 --engine reference --model phong --bit-depth 8 --encoding srgb
    cmp one.png same.png
    for options in "--model simple" "--model lambert" "--model blinn_phong" "--samples 2" "--bit-depth 16" "--encoding linear" "--width 63"; do
        # shellcheck disable=SC2086
        try 0 render -q s.yaml -o other.png $options
        not cmp -s one.png other.png
    done
}

@test "the same picture and the same counts from both engines and every path" {
    makeScene s.yaml
    try 0 render -q s.yaml -o fast.png --engine fast --json
    json '.engine == "fast"'
    jq -c .rays "$out" >fast.rays
    try 0 render -q s.yaml -o reference.png --engine reference --json
    json '.engine == "reference" and .seconds.compile == 0'
    jq -c .rays "$out" >reference.rays
    cmp fast.png reference.png
    cmp fast.rays reference.rays
    for path in avx2 sse2 neon portable; do
        run env ECLAIRAGE_PATH=$path "$ECLAIRAGE" render -q s.yaml -o path.png
        [ "$status" -eq 2 ] || cmp fast.png path.png
    done
}

@test "an instruction set that is not there is named, with those that are" {
    makeScene s.yaml
    ECLAIRAGE_PATH=mmx try 2 render -q s.yaml -o path.png
    hasText "$err" "ECLAIRAGE_PATH is 'mmx', which is not here; there "
    not test -e path.png
}

@test "JSON has the contract's fields, and nothing else is on standard output" {
    makeScene s.yaml
    try 0 render s.yaml --json --threads 2 --width 20
    json '[keys_unsorted[]] == ["scene", "width", "height", "engine", "threads", "seconds", "rays",
        "peak_memory_bytes"]'
    json '.scene == "s.yaml" and .width == 20 and .height == 15 and .engine == "fast" and .threads == 2'
    json '[.seconds | keys_unsorted[]] == ["load", "compile", "trace", "write", "total"]'
    json '.seconds | [.[] | type == "number" and . >= 0] | all'
    json '.seconds | .total >= .load + .compile + .trace + .write - 1e-5 and .total < 10'
    json '.rays.primary == 300 and .rays.shadow > 0 and .rays.secondary == 0'
    json '.peak_memory_bytes | . > 1e6 and . < 1e9'
    try 0 render s.yaml --json --quiet --threads 2 --width 20
    isEmpty "$err"
    json '.width == 20'
}

@test "one side alone keeps the aspect" {
    makeScene s.yaml
    size() { try 0 render -q s.yaml -o a.png --json "$@" && json -r '"\(.width) x \(.height)"' && cat "$BATS_TEST_TMPDIR/jq"; }
    [ "$(size)" = "64 x 48" ]
    [ "$(size --width 32)" = "32 x 24" ]
    [ "$(size --height 24)" = "32 x 24" ]
    [ "$(size --width 1)" = "1 x 1" ]
    [ "$(size --width 33)" = "33 x 25" ] # 24.75
    [ "$(size --width 10 --height 20)" = "10 x 20" ]
}

@test "sizes beyond the limits are usage errors" {
    makeScene s.yaml
    try 2 render s.yaml --height 60000
    hasText "$err" "would be 80000 x 60000 pixels, and a side has at most 65535"
    try 2 render s.yaml --width 65535 --height 65535
    hasText "$err" "a picture of 65535 x 65535 has more than the 2147483648 pixels (2^31)"
    folderHolds s.yaml
}

@test "an invalid scene gives code 3, its places, and no picture" {
    makeScene s.yaml 'cmaera: {fov: 400}' 'render: {model: fong}'
    echo old >s.png
    try 3 render s.yaml
    isEmpty "$out"
    grep -qE '^s\.yaml:7:1: error: .*cmaera' "$err"
    grep -qE '^s\.yaml:8:17: error: .*fong' "$err"
    [ "$(grep -c 'error:' "$err")" = 2 ]
    [ "$(cat s.png)" = old ]
    try 3 render - -o x.png </dev/null
    grep -qE '^<stdin>:1:1: error: ' "$err"
    folderHolds s.png s.yaml
}

@test "files that cannot be read or written give code 4" {
    makeScene s.yaml
    mkdir folder
    try 4 render missing.yaml
    hasText "$err" "eclairage: error: "
    hasText "$err" missing.yaml
    try 4 render folder
    hasText "$err" folder
    try 4 render s.yaml -o missing/x.png
    hasText "$err" missing/x.png
    try 4 render s.yaml -o folder
    hasText "$err" folder
    try 4 render s.yaml -o /dev/full
    hasText "$err" /dev/full
    folderHolds folder s.yaml
}

@test "an unwritable place is found before the work, not after it" {
    makeLongScene s.yaml
    SECONDS=0
    try 4 render s.yaml -o missing/x.png
    [ $SECONDS -lt 5 ]
}

@test "an old picture is replaced whole, and keeps its permissions and its link" {
    makeScene s.yaml
    mkdir real
    echo old >real/s.png
    chmod 640 real/s.png
    ln -s real/s.png s.png
    try 0 render -q s.yaml
    isPng real/s.png
    [ -L s.png ]
    [ "$(stat -c %a real/s.png)" = 640 ]
    [ "$(ls -A real)" = s.png ]
}

@test "pixels that are not finite are counted in a warning" {
    sed 's/\[20, 20, 20\]/[3e38, 3e38, 3e38]/; s/diffuse: \[1, 0, 0\]/diffuse: [10, 0, 0]/; s/-3, 1, 1/0, 0, -3/' \
        <(makeScene /dev/stdout) >s.yaml
    try 0 render -q s.yaml
    grep -qE '^eclairage: warning: s\.yaml: [0-9]+ pixels are not finite' "$err"
    isPng s.png
}

@test "warnings of the scene do not change the code, and --quiet does not hide them" {
    echo 'objects: [{sphere: {center: [0, 0, -5], radius: 1}}]' >s.yaml
    try 0 render --quiet s.yaml
    grep -qE '^s\.yaml:[0-9]+:[0-9]+: warning: ' "$err"
    hasNoText "$err" wrote
}
