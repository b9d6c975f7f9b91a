#!/usr/bin/env bash
# Measures how our pictures of all course and gallery scenes differ from POV-Ray's, and prints it as CSV:
# what compare/results.csv holds. Needs povray and jq; $ECLAIRAGE is the program.
#
#   tools/measure-scenes.sh > compare/results.csv
#
# 16 bit: `eclairage compare`, on linear samples. 8 bit: what a user would do by hand, the command in the
# first comment of the .pov against `eclairage render`, on sRGB files of the scene's own size.
set -euo pipefail

program=$(realpath "${ECLAIRAGE:-build/eclairage}")
scenes=(scenes/course/*.yaml)
for scene in scenes/gallery/*.yaml; do
    [ -e "$scene" ] && scenes+=("$scene")
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# A scene that differs is a number here, not an error; one that failed ends this below.
"$program" compare --quiet --json --out "$folder/report" "${scenes[@]}" >"$folder/16.json" || [ $? = 1 ]

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
printf '%s\n' "${scenes[@]}" | xargs -P 4 -I{} bash -euo pipefail -c 'measure8 "{}"'

echo 'scene,metric,value,tolerance,reason'
for scene in "${scenes[@]}"; do
    jq -r --arg scene "$scene" '
        .scenes[] | select(.scene == $scene)
        | if .error then error("\(.scene): \(.error.message)") else . end
        | [.scene, "differing pixels, 16 bit", .pixels - .identical_pixels, (.pixels * 0.005 | floor),
           "the last bit of float arithmetic: 0.5 % of the pixels"],
          [.scene, "pixels off by more than 2/65535", .differing_pixels, 0,
           "a ray within 1e-6 of an edge may decide otherwise; none of these scenes has one"],
          [.scene, "largest difference in 1/65535", (.max_difference * 65535 | round), 2,
           "the last bit of float arithmetic"]
        | @csv' "$folder/16.json"
    jq -r --arg scene "$scene" '
        [$scene, "differing pixels, 8 bit", .pixels - .identical_pixels, 10,
         "a last bit at the border between two of 256 values"],
        [$scene, "largest difference in 1/255", (.max_difference * 255 | round), 1,
         "a last bit at the border between two of 256 values"]
        | @csv' "$folder/${scene//\//_}/8.json"
done
