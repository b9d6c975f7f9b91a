#!/bin/sh
# load.sh - time and peak memory of loading spheres written one object a line.
#
# Usage: bench/load.sh [COUNT...]; 100,000 and 1,000,000 by default. Prints, for each count, the whole
# process `eclairage check` in seconds (the best of three) and its peak memory, in bytes an object too.
# Needs build/eclairage (or ECLAIRAGE), awk and GNU time.
set -eu

eclairage=${ECLAIRAGE:-build/eclairage}
folder=$(mktemp -d "${TMPDIR:-/tmp}/eclairage-bench.XXXXXX")
trap 'rm -rf "$folder"' EXIT
trap 'exit 130' INT TERM

if ! [ -x /usr/bin/time ]; then
    echo "load: skipped, GNU time is not installed (apt-get install time)"
    exit 0
fi

[ $# -gt 0 ] || set -- 100000 1000000
for count in "$@"; do
    awk -v count="$count" 'BEGIN {
        srand(1)
        print "camera: {position: [0, 0, 30]}"
        print "materials: {glaze: {diffuse: [1, 0, 0], specular: 0.5}}"
        print "lights: [{point: {position: [-3, 40, 30], color: 1000}}]"
        print "objects:"
        for (i = 0; i < count; i++)
            printf "  - sphere: {center: [%.6f, %.6f, %.6f], radius: %.6f, material: glaze}\n",
                20 * rand() - 10, 20 * rand() - 10, 20 * rand() - 10, 0.01 + rand() / 10
    }' >"$folder/spheres.yaml"
    for run in 1 2 3; do
        /usr/bin/time -f '%e %M' "$eclairage" check "$folder/spheres.yaml" 2>&1 >/dev/null | tail -n 1
    done | sort -n | awk -v count="$count" '
        NR == 1 { printf "load %d spheres: %.2f s, %d kB at most, %.0f bytes an object\n", count, $1, $2, 1024 * $2 / count }'
done
