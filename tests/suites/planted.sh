#!/usr/bin/env bash
# `eclairage explain` and pictures whose mistakes are known (tests/property/planted.c): the right cause is named
# first, and none for pictures without one. Prints TAP. Run from the repository root after `make`;
# `build/planted --all -v SCENE.yaml` plants every mistake in a scene and shows what was said.
set -uo pipefail
build=${BUILD:-build}
tests/property/build.sh planted || exit 1

# Each run is one test; the plan of both stands here.
"$build/planted" tests/property/scenes/*.yaml scenes/course/04-phong.yaml scenes/course/05-phong.yaml |
    sed '/^1\.\./d'
"$build/planted" --honest scenes/course/*.yaml scenes/gallery/*.yaml | sed 's/^\(not \)\?ok 1/\1ok 2/; /^1\.\./d'
echo "1..2"
