#!/usr/bin/env bash
# The pictures of all course and gallery scenes, small, 16-bit linear, are the ones in tests/golden/pictures,
# in every sample and with any number of threads. They need no POV-Ray, so they hold where it is missing.
# `make update-results` rewrites them. Prints TAP. Run from the repository root after `make`.
set -uo pipefail
program=${ECLAIRAGE:-build/eclairage}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
count=0
for scene in scenes/course/*.yaml scenes/gallery/*.yaml; do
    name=$(basename "$scene" .yaml)
    for threads in 1 3; do
        count=$((count + 1))
        if "$program" render --quiet --threads $threads --width 96 --bit-depth 16 --encoding linear "$scene" \
            -o "$folder/$name.png" && "$program" diff --fail 0 --fail-percent 0 --hard-fail 0 \
            "tests/golden/pictures/$name.png" "$folder/$name.png" >"$folder/words"; then
            echo "ok $count - $scene with $threads threads"
        else
            echo "not ok $count - $scene with $threads threads"
            sed 's/^/# /' "$folder/words"
        fi
    done
done
# No picture without its scene.
count=$((count + 1))
left=$(comm -3 <(basename -as .png tests/golden/pictures/*.png | sort) \
    <(basename -as .yaml scenes/course/*.yaml scenes/gallery/*.yaml | sort))
[ -z "$left" ] && echo "ok $count - a picture for each scene" || echo "not ok $count - a picture for each scene: $left"
echo "1..$count"
