#!/usr/bin/env bash
# ThreadSanitizer finds no race while several threads compile scenes and draw them by the fast engine, and the
# pictures are those of one thread. Prints TAP. Run from the repository root after `make`.
set -uo pipefail
program=${ECLAIRAGE:-build/eclairage}
build=${BUILD:-build}/thread
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
if ! printf 'int main(void) { return 0; }\n' | ${CC:-cc} -fsanitize=thread -x c - -o "$folder/probe" 2>/dev/null ||
    ! "$folder/probe" 2>/dev/null; then
    echo "1..0 # SKIP ${CC:-cc} has no working -fsanitize=thread"
    exit 0
fi
if ! "${MAKE:-make}" --no-print-directory SANITIZE=thread BUILD="$build" \
    "$build/eclairage" >"$folder/log" 2>&1; then
    sed 's/^/# /' "$folder/log"
    echo 'Bail out! the build with -fsanitize=thread failed'
    exit 1
fi

# As many spheres as it takes for several threads to build one tree.
awk 'BEGIN {
    srand(1)
    print "lights: [{point: {position: [3, 5, 2], color: 40}}, {directional: {direction: [1, -2, -1], color: 0.3}}]"
    print "objects:\n  - spheres:\n      material: {reflection: 0.3}\n      data:"
    for (i = 0; i < 20000; i++) printf "        - [%.4f, %.4f, %.4f, 0.03]\n", 4 * rand() - 2, 4 * rand() - 2, -2 - 4 * rand()
}' >"$folder/many.yaml"
count=0
for scene in "$folder/many.yaml" scenes/gallery/glass.yaml scenes/gallery/dice.yaml scenes/gallery/city.yaml; do
    count=$((count + 1))
    options=(render --quiet --engine fast --width 200 --bit-depth 16 "$scene")
    if "$program" "${options[@]}" --threads 1 -o "$folder/one.png" 2>"$folder/words" &&
        TSAN_OPTIONS=halt_on_error=1:exitcode=99 "$build/eclairage" "${options[@]}" --threads 4 -o "$folder/four.png" \
            2>"$folder/words" && cmp "$folder/one.png" "$folder/four.png" >"$folder/words" 2>&1; then
        echo "ok $count - ${scene##*/}: no race, and the picture of one thread"
    else
        echo "not ok $count - ${scene##*/}: no race, and the picture of one thread"
        sed 's/^/# /' "$folder/words"
    fi
done
echo "1..$count"
