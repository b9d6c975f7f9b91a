#!/usr/bin/env bash
# Built without anything that knows an instruction set, the fast engine passes its tests and draws the same bytes.
# Prints TAP. Run from the repository root after `make`.
set -uo pipefail
program=${ECLAIRAGE:-build/eclairage}
build=${BUILD:-build}/portable
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
if ! "${MAKE:-make}" --no-print-directory PORTABLE=1 BUILD="$build" "$build/eclairage" "$build/tests/test_engine" \
    >"$folder/log" 2>&1; then
    sed 's/^/# /' "$folder/log"
    echo 'Bail out! the portable build failed'
    exit 1
fi
if CMOCKA_MESSAGE_OUTPUT=STDOUT "$build/tests/test_engine" >"$folder/words" 2>&1; then
    echo 'ok 1 - test_engine'
else
    echo 'not ok 1 - test_engine'
    sed 's/^/# /' "$folder/words"
fi
if ECLAIRAGE_PATH=portable "$build/eclairage" render --quiet scenes/course/03a-cube.yaml --width 8 -o "$folder/a.png" &&
    ! ECLAIRAGE_PATH=sse2 "$build/eclairage" render --quiet scenes/course/03a-cube.yaml --width 8 -o "$folder/a.png" 2>/dev/null; then
    echo 'ok 2 - it has the portable path alone'
else
    echo 'not ok 2 - it has the portable path alone'
fi
count=2
for scene in scenes/course/05-phong.yaml scenes/gallery/*.yaml; do
    count=$((count + 1))
    options=(render --quiet --engine fast --width 64 --bit-depth 16 "$scene")
    if "$program" "${options[@]}" -o "$folder/native.png" 2>"$folder/words" &&
        "$build/eclairage" "${options[@]}" -o "$folder/portable.png" 2>"$folder/words" &&
        cmp "$folder/native.png" "$folder/portable.png" >"$folder/words" 2>&1; then
        echo "ok $count - $scene"
    else
        echo "not ok $count - $scene"
        sed 's/^/# /' "$folder/words"
    fi
done
echo "1..$count"
