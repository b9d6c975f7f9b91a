#!/usr/bin/env bats
# eclairage compare

load helpers

# An exact comparison: the two renderers agree on small scenes to the last bits.
strict='compare: {fail: 3.1e-5, fail_percent: 0}'

@test "one scene: words, the report and its files" {
    needs povray
    makeScene s.yaml "$strict"
    try 0 compare s.yaml
    [ -s "$out" ]
    hasLine "$err" "eclairage: the report is eclairage-report/index.html"
    folderHolds eclairage-report s.yaml
    [ "$(cd eclairage-report && echo *)" = "index.html results.json s-difference.png s-ours.png s-povray.png s.pov" ]
    for picture in ours povray difference; do
        isPng eclairage-report/s-$picture.png
    done
    try 0 diff eclairage-report/s-ours.png eclairage-report/s-povray.png --fail 3.1e-5 --fail-percent 0
}

@test "JSON on standard output is results.json, with the contract's fields" {
    needs povray
    makeScene s.yaml "$strict"
    try 0 compare s.yaml --json --out report
    cmp "$out" report/results.json
    json '.pass and (.scenes | length) == 1'
    json '.scenes[0] | .scene == "s.yaml" and .pass and .width == 64 and .height == 48 and .pixels == 3072'
    json '.scenes[0] | has("identical_pixels") and has("differing_pixels") and has("differing_percent")
        and has("max_difference") and has("worst_pixel") and has("mae") and has("rmse") and has("psnr")
        and has("ssim") and has("flip")'
    json '.scenes[0].seconds | [.render, .povray, .compare] | all(. >= 0)'
    json -r '.scenes[0].files | .ours, .povray, .difference, .pov' >/dev/null
    for file in $(jq -r '.scenes[0].files[]' "$out"); do
        [ -s "report/$file" ]
    done
    try 0 compare s.yaml --json --out report --quiet
    isEmpty "$err"
}

@test "too different: code 1, in words and in JSON, and the options override the scene" {
    needs povray
    # A limit that no picture of this scene keeps.
    makeScene s.yaml 'compare: {ssim: 1, flip: 0, hard_fail: 0, rmse: 0, fail: 0, fail_percent: 0}'
    mkdir programs
    # A POV-Ray that always draws at another place.
    cat >programs/povray <<END
#!/bin/bash
for word; do case \$word in +I*) sed -i 's/1\.5/1.4/' "\${word#+I}" ;; esac; done
exec $(command -v povray) "\$@"
END
    chmod +x programs/povray
    PATH=$PWD/programs:$PATH try 1 compare s.yaml
    hasText "$out" "s.yaml"
    PATH=$PWD/programs:$PATH try 1 compare s.yaml --json
    json '.pass == false and (.scenes[0] | .pass == false and (.reasons | length) > 0 and has("error") == false)'
    PATH=$PWD/programs:$PATH try 0 compare s.yaml --json --ssim -1 --rmse 1 --hard-fail 1 --fail 1 \
        --fail-percent 100 --flip 1
    json '.pass and .scenes[0].pass and .scenes[0].reasons == [] and .scenes[0].max_difference > 0'
}

@test "several scenes in the order given, those of the same name apart" {
    needs povray
    mkdir a b
    makeScene a/same.yaml
    makeScene b/same.yaml 'render: {model: lambert}'
    makeScene Same.yaml
    makeScene "odd nàme;\$(x).yaml"
    makeScene same-2.yml
    try 0 compare b/same.yaml a/same.yaml Same.yaml "odd nàme;\$(x).yaml" same-2.yml a/same.yaml --out new/report --json
    json '[.scenes[].scene] == ["b/same.yaml", "a/same.yaml", "Same.yaml", "odd nàme;$(x).yaml", "same-2.yml", "a/same.yaml"]'
    [ "$(jq -r '[.scenes[].files[]] | unique | length' "$out")" = 24 ]
    [ "$(jq -r '[.scenes[].files[] | ascii_downcase] | unique | length' "$out")" = 24 ]
    jq -r '.scenes[].files[]' "$out" >names
    not grep -vE '^[A-Za-z0-9_][A-Za-z0-9_.-]*$' names
    while read -r name; do
        [ -s "new/report/$name" ]
    done <names
    # The two of one name are lambert and phong.
    not cmp -s "new/report/$(sed -n 1p names)" "new/report/$(sed -n 5p names)"
    nothingTemporary
}

@test "a scene that fails is in the results, the others are done, and the highest code counts" {
    needs povray
    makeScene good.yaml
    makeScene bad.yaml 'typo: 1'
    makeScene bias.yaml 'render: {shadow_bias: 0.1}'
    try 7 compare bad.yaml missing.yaml good.yaml bias.yaml --json
    json '.pass == false and [.scenes[].pass] == [false, false, true, false]'
    json '[.scenes[].error.code] == [3, 4, null, 7]'
    json '.scenes[0].error.message | startswith("line 7: ")'
    json '.scenes[0] | keys == ["error", "pass", "scene"]'
    grep -q '^bad\.yaml:7:1: error: ' "$err"
    hasText "$err" missing.yaml
    hasText "$err" bias.yaml
    [ -s eclairage-report/index.html ]
    try 3 compare bad.yaml good.yaml
    grep -q 'good.yaml' "$out"
    grep -q 'bad.yaml' "$out"
}

@test "standard input" {
    needs povray
    makeScene s.yaml
    "$ECLAIRAGE" compare - <s.yaml >"$out" 2>"$err"
    [ -s eclairage-report/stdin.pov ]
}

@test "without POV-Ray: code 5 and how to install it, once" {
    makeScene s.yaml
    mkdir empty
    PATH=$PWD/empty try 5 compare s.yaml s.yaml s.yaml
    [ "$(grep -c 'error: ' "$err")" = 1 ]
    hasText "$err" "install povray"
    isEmpty "$out"
    [ ! -e eclairage-report ]
}

@test "a POV-Ray that fails: code 5, with the end of what it said and the scene's name" {
    makeScene s.yaml
    mkdir programs
    printf '#!/bin/sh\necho "the dog ate it" >&2\nexit 1\n' >programs/povray
    chmod +x programs/povray
    PATH=$PWD/programs:$PATH try 5 compare s.yaml
    hasText "$err" "the dog ate it"
    hasText "$err" "s.yaml"
    nothingTemporary
}

@test "a folder that cannot be made: code 4" {
    needs povray
    makeScene s.yaml
    echo file >file
    try 4 compare s.yaml --out file/report
    hasText "$err" file
    isEmpty "$out"
}

@test "eleven scenes take little more time than one" {
    needs povray
    for i in 1 2 3 4 5 6 7 8 9 10 11; do
        makeScene s$i.yaml
    done
    SECONDS=0
    try 0 compare s*.yaml
    [ $SECONDS -lt 7 ] # one after another they would take eight seconds at least
}

@test "encoding and depth are those of the comparison, whatever is asked for" {
    command -v povray >/dev/null || skip "povray is not installed"
    makeScene s.yaml
    try 0 compare s.yaml --encoding srgb --bit-depth 8 --width 40
    grep -q '16-bit linear' "$err"
    try 0 diff eclairage-report/s-ours.png eclairage-report/s-povray.png
    try 6 diff eclairage-report/s-ours.png eclairage-report/s-difference.png
    try 0 compare -q s.yaml --bit-depth 16 --encoding linear
    isEmpty "$err"
}

@test "per term: each term has its files, and is in JSON" {
    needs povray
    makeScene s.yaml "$strict" 'background: [0, 0, 0.5]'
    try 0 compare s.yaml --per-term --json
    cmp "$out" eclairage-report/results.json
    json '[.scenes[0].terms[].term] == ["diffuse", "specular", "background"]'
    json '.scenes[0].terms | all(.pass and .pixels == 3072 and .reasons == [] and has("rmse"))'
    for file in $(jq -r '.scenes[0].terms[].files[]' "$out"); do
        [ -s "eclairage-report/$file" ]
    done
    [ "$(jq -r '.scenes[0].terms[0].files.pov' "$out")" = s-diffuse.pov ]
    hasText eclairage-report/index.html "Term by term"
    try 0 compare s.yaml --per-term
    hasLine "$out" "        each term agrees: diffuse, specular, background"
    try 0 compare s.yaml --json
    json '.scenes[0] | has("terms") == false'
    hasNoText eclairage-report/index.html "Term by term"
    try 2 render s.yaml --per-term
    hasText "$err" "'render' does not take --per-term, which is an option of compare"
}

@test "per term: the term that disagrees is named, and makes the scene differ" {
    needs povray
    makeScene s.yaml "$strict" 'background: [0, 0, 0.5]'
    mkdir programs
    # A POV-Ray with another shininess, but only where nothing is diffuse: the whole picture stays right.
    cat >programs/povray <<END
#!/bin/bash
for word; do case \$word in +I*)
    grep -q 'rgb <2, 0, 0>\|rgb <1, 0, 0>' "\${word#+I}" || sed -i 's/phong_size 32/phong_size 31/' "\${word#+I}" ;;
esac; done
exec $(command -v povray) "\$@"
END
    chmod +x programs/povray
    PATH=$PWD/programs:$PATH try 1 compare s.yaml --per-term
    hasText "$out" "        the specular term disagrees: "
    hasNoText "$out" "diffuse term"
    hasText eclairage-report/index.html "The specular term disagrees: "
    hasNoText eclairage-report/index.html "The diffuse term disagrees: "
    PATH=$PWD/programs:$PATH try 1 compare s.yaml --per-term --json
    json '.pass == false and .scenes[0].pass == false and .scenes[0].reasons == []'
    json '[.scenes[0].terms[] | select(.pass | not) | .term] == ["specular"]'
}

@test "per term: a scene called like another's term has files of its own" {
    needs povray
    makeScene s.yaml
    makeScene s-diffuse.yaml
    try 0 compare s.yaml s-diffuse.yaml --per-term --json
    json '[.scenes[].files.pov] == ["s.pov", "s-diffuse-2.pov"]'
    json '[.scenes[] | .files[], .terms[].files[]] | length == (unique | length)'
}
