#!/usr/bin/env bash
# Measures how our pictures of all course, gallery and regress scenes differ from POV-Ray's, and prints it as CSV:
# what compare/results.csv holds. Needs povray and jq; $ECLAIRAGE is the program.
#
#   tools/measure-scenes.sh > compare/results.csv
#
# 16 bit: `eclairage compare`, on linear samples. 8 bit: what a user would do by hand, the command in the
# first comment of the .pov against `eclairage render`, on sRGB files of the scene's own size; not of scenes with
# several samples a pixel, which a .pov cannot say.
#
# A scene that agrees but for a few pixels says so in its section `compare`, with the reason in the comment above.
set -euo pipefail

program=$(realpath "${ECLAIRAGE:-build/eclairage}")
scenes=(scenes/course/*.yaml)
for scene in scenes/gallery/*.yaml scenes/regress/*.yaml; do
    [ -e "$scene" ] && scenes+=("$scene")
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# A scene that differs is a number here, not an error; one that failed ends this below. However far a scene may
# be off, what counts is 2/65535.
"$program" compare --quiet --json --fail 3.1e-5 --out "$folder/report" "${scenes[@]}" >"$folder/16.json" || [ $? = 1 ]

hasSamples() { # SCENE
    "$program" pov --quiet "$1" | grep 'rays a pixel cannot be said' >/dev/null
}

# Draw one scene both ways in a folder of its own and measure.
measure8() { # SCENE
    local name=${1//\//_}
    mkdir "$folder/$name"
    "$program" render --quiet "$1" -o "$folder/$name/ours.png"
    "$program" pov --quiet "$1" -o "$folder/$name/theirs.pov"
    cd "$folder/$name"
    : >empty.ini
    command=$(sed -n '1s:^// ::p' theirs.pov)
    # shellcheck disable=SC2086
    HOME=$PWD POVINI=$PWD/empty.ini $command >log 2>&1 || { cat log >&2; return 1; }
    "$program" diff --json ours.png theirs.png >8.json || [ $? = 1 ]
}
export -f measure8
export program folder
for scene in "${scenes[@]}"; do
    hasSamples "$scene" || printf '%s\n' "$scene"
done | xargs -P 8 -I{} bash -euo pipefail -c 'measure8 "{}"'

# What the scene says of its tolerance: a key of its section compare, and the comment above it.
toleranceOf() { # SCENE KEY DEFAULT
    local value
    value=$(sed -n "s/^compare:.*[{ ]$2: *\([0-9.e+-]*\).*/\1/p" "$1")
    echo "${value:-$3}"
}
reasonOf() { # SCENE
    awk '/^#/ { text = text (text == "" ? "" : " ") substr($0, 3); next } /^compare:/ { print text } { text = "" }' "$1"
}

echo 'scene,metric,value,tolerance,reason'
for scene in "${scenes[@]}"; do
    samples=false
    hasSamples "$scene" && samples=true
    jq -r --arg scene "$scene" --argjson percent "$(toleranceOf "$scene" fail_percent 0)" \
        --argjson hard "$(toleranceOf "$scene" hard_fail 1)" --arg reason "$(reasonOf "$scene")" \
        --argjson samples $samples '
        .scenes[] | select(.scene == $scene)
        | if .error then error("\(.scene): \(.error.message)") else . end
        | (.pixels * $percent / 100 | floor) as $allowed
        | [.scene, "differing pixels, 16 bit", .pixels - .identical_pixels]
          + if $samples then [.pixels, "the roundings of the two pictures that the mean of several rays is worked out of"]
            else [(.pixels * 0.005 | floor) + $allowed, "the last bit of float arithmetic: 0.5 % of the pixels"] end,
          [.scene, "pixels off by more than 2/65535", .differing_pixels, $allowed]
          + if $allowed > 0 then [$reason]
            else ["a ray within 1e-6 of an edge may decide otherwise; this scene has none"] end,
          [.scene, "largest difference in 1/65535", (.max_difference * 65535 | round)]
          + if $allowed > 0 then [($hard * 65535 | floor), $reason] else [2, "the last bit of float arithmetic"] end
        | @csv' "$folder/16.json"
    $samples || jq -r --arg scene "$scene" --argjson percent "$(toleranceOf "$scene" fail_percent 0)" \
        --arg reason "$(reasonOf "$scene")" '
        (.pixels * $percent / 100 | floor) as $allowed
        | [$scene, "differing pixels, 8 bit", .pixels - .identical_pixels, 10 + $allowed,
           "a last bit at the border between two of 256 values"],
          [$scene, "largest difference in 1/255", (.max_difference * 255 | round)]
          + if $allowed > 0 then [255, $reason] else [1, "a last bit at the border between two of 256 values"] end
        | @csv' "$folder/${scene//\//_}/8.json"
done
