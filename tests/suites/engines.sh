#!/usr/bin/env bash
# The fast engine draws what the course's tracer draws, to the last bit: random scenes of the whole vocabulary and
# scenes made of coincidences (tests/property/engines.c), and through the command line every scene of the tree on
# every instruction set there is. Prints TAP. Run from the repository root after `make`; `build/engines --seeds
# 1..100000 --nasty 1..100000` looks for longer.
set -uo pipefail
program=${ECLAIRAGE:-build/eclairage}
build=${BUILD:-build}
tests/property/build.sh engines || exit 1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# The random scenes, whose last line is their plan.
"$build/engines" --seeds 1..400 --nasty 1..600 >"$folder/random"
grep -v '^1\.\.' "$folder/random"
count=$(grep -c '^\(not \)\?ok ' "$folder/random")
[ "$count" = 20 ] || echo 'Bail out! the random scenes were not all drawn'

# Which paths there are, the program says when it is asked for none of them.
read -r -a paths <<<"$(ECLAIRAGE_PATH=none "$program" render --quiet --engine fast scenes/course/03a-cube.yaml -o "$folder/none.png" 2>&1 |
    sed -n "s/.*which is not here; there [a-z]* \([a-z0-9 ]*\).*/\1/p" | sed 's/ and / /')"
count=$((count + 1))
if [ ${#paths[@]} -gt 0 ]; then
    echo "ok $count - the paths are: ${paths[*]}"
else
    echo "not ok $count - the program names its paths"
fi

draw() { # SCENE PICTURE OPTION...
    "$program" render --quiet --width 44 --bit-depth 16 --encoding linear "$1" -o "$folder/$2.png" "${@:3}" 2>"$folder/words"
}
for scene in scenes/course/*.yaml scenes/gallery/*.yaml scenes/regress/*.yaml; do
    count=$((count + 1))
    different=
    draw "$scene" reference --engine reference || different='the reference fails'
    for path in ${paths[@]+"${paths[@]}"}; do
        ECLAIRAGE_PATH=$path draw "$scene" fast --engine fast && cmp -s "$folder/reference.png" "$folder/fast.png" ||
            different="$different $path"
    done
    if [ -z "$different" ]; then
        echo "ok $count - $scene"
    else
        echo "not ok $count - $scene: not the reference's bytes:$different"
        sed 's/^/# /' "$folder/words"
    fi
done
echo "1..$count"
