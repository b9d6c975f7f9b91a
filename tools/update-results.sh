#!/usr/bin/env bash
# Rewrites what is committed of the program's results: the measured differences from POV-Ray, the table of
# povray/MAPPING.md that shows them, the small golden pictures, and the pictures of the README. A change of them is a commit of its own, with the reason.
set -euo pipefail
cd "$(dirname "$0")/.."
program=${ECLAIRAGE:-build/eclairage}

measured=$(mktemp)
trap 'rm -f "$measured"' EXIT
tools/measure-scenes.sh >"$measured"
cp "$measured" compare/results.csv
tools/update-mapping.sh

mkdir -p tests/golden/pictures
rm -f tests/golden/pictures/*.png
for scene in scenes/course/*.yaml scenes/gallery/*.yaml; do
    "$program" render --quiet --width 96 --bit-depth 16 --encoding linear "$scene" \
        -o "tests/golden/pictures/$(basename "$scene" .yaml).png"
done

tools/readme-pictures.sh notes/pictures
git --no-pager diff --stat -- compare/results.csv povray/MAPPING.md tests/golden notes/pictures
