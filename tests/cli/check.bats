#!/usr/bin/env bats
# eclairage check, and eclairage schema

load helpers

@test "a good scene: a note, which --quiet silences" {
    makeScene s.yaml
    try 0 check s.yaml
    isEmpty "$out"
    sameAs "$err" <<<"eclairage: s.yaml: ok"
    try 0 check -q s.yaml
    isEmpty "$out" "$err"
    "$ECLAIRAGE" check - <s.yaml 2>"$err"
    sameAs "$err" <<<"eclairage: <stdin>: ok"
}

@test "warnings: shown, counted, and code 0" {
    echo 'objects: [{sphere: {center: [0, 0, -5], radius: 1}}]' >s.yaml
    try 0 check s.yaml
    grep -qE '^s\.yaml:[0-9]+:[0-9]+: warning: ' "$err"
    hasLine "$err" "eclairage: s.yaml: ok, with $(grep -c 'warning: ' "$err") warning"
    try 0 check --quiet --json s.yaml
    grep -q 'warning: ' "$err"
    json '.files[0] | .errors == [] and (.warnings | length) == 1'
}

@test "errors: all of them in one run, with line, caret and hint" {
    makeScene s.yaml 'camera: {postion: [0, 0, 0]}' 'compare: {fail: 2}'
    try 3 check s.yaml
    isEmpty "$out"
    hasText "$err" "s.yaml:7:10: error: "
    hasText "$err" "camera: {postion: [0, 0, 0]}"
    hasText "$err" "^"
    hasText "$err" "position"
    hasText "$err" "s.yaml:8:17: error: "
    hasNoText "$err" "eclairage: error"
    hasNoText "$err" "ok"
}

@test "several scenes: all are checked, and the highest code counts" {
    makeScene good.yaml
    makeScene bad.yaml 'typo: 1'
    try 3 check good.yaml bad.yaml good.yaml
    [ "$(grep -cx 'eclairage: good.yaml: ok' "$err")" = 2 ]
    grep -q '^bad\.yaml:7:1: error: ' "$err"
    try 4 check missing.yaml bad.yaml good.yaml
    hasText "$err" "missing.yaml"
    grep -q '^bad\.yaml:7:1: error: ' "$err"
    hasLine "$err" "eclairage: good.yaml: ok"
}

@test "JSON has the contract's fields for every file, also one that cannot be read" {
    makeScene good.yaml
    makeScene bad.yaml 'camera: {postion: [0, 0, 0]}'
    try 4 check --json good.yaml bad.yaml missing.yaml
    json 'keys == ["files"] and [.files[].file] == ["good.yaml", "bad.yaml", "missing.yaml"]'
    json '[.files[] | [keys_unsorted[]] == ["file", "errors", "warnings"]] | all'
    json '.files[0].errors == [] and .files[0].warnings == []'
    json '.files[1].errors | length == 1 and (.[0] | [keys_unsorted[]] == ["line", "column", "message", "hint"])'
    json '.files[1].errors[0] | .line == 7 and .column == 10 and (.message | contains("postion"))
        and (.hint | contains("position"))'
    json '.files[2].errors | length == 1 and .[0].line == null and (.[0].message | contains("missing.yaml"))'
}

@test "the name of a file cannot command the terminal, nor break JSON" {
    name=$'bad\e[31m\nname.yaml'
    makeScene "$name" 'typo: 1'
    try 3 check --json "$name"
    not grep -q $'\e' "$err"
    needs jq
    [ "$(jq -r '.files[0].file' "$out")" = "$name" ]
    try 4 check $'missing\e[31m.yaml'
    not grep -q $'\e' "$err"
    name=$'good\e[31m.yaml'
    makeScene "$name"
    try 0 check "$name"
    not grep -q $'\e' "$err"
}

@test "the schema is JSON Schema draft-07, and the committed one" {
    try 0 schema
    isEmpty "$err"
    json '."$schema" == "http://json-schema.org/draft-07/schema#" and .type == "object"'
    json '.properties | has("image") and has("camera") and has("objects")'
    [ ! -e "$root/scenes/scene.schema.json" ] || diff -u "$root/scenes/scene.schema.json" "$out"
}
