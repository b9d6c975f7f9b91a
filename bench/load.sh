#!/bin/sh
# load.sh - time and peak memory of loading many spheres, held against libyaml's own parsing.
#
# Usage: bench/load.sh [COUNT...]; 100,000 and 1,000,000 by default. For each count, once as rows of one
# `spheres` and once as one object a line: the whole process `eclairage check` and the whole process of
# yaml_parse, which only asks libyaml for all events, take turns. Printed are the best of five of each in
# seconds, the median of the five quotients, and the peak memory, in bytes an object too. Other work on the
# machine hits both, so the quotient is what to compare.
# Needs build/eclairage (or ECLAIRAGE) with its library beside it, a C compiler, awk and GNU time.
set -eu

eclairage=${ECLAIRAGE:-build/eclairage}
folder=$(mktemp -d "${TMPDIR:-/tmp}/eclairage-bench.XXXXXX")
trap 'rm -rf "$folder"' EXIT
trap 'exit 130' INT TERM

if ! [ -x /usr/bin/time ]; then
    echo "load: skipped, GNU time is not installed (apt-get install time)"
    exit 0
fi
# shellcheck disable=SC2046 # the libraries are several words
${CC:-cc} -std=c17 -O2 -o "$folder/yaml_parse" bench/yaml_parse.c $(pkg-config --cflags --libs yaml-0.1)

# writeScene COUNT FORM: a scene of so many random spheres.
writeScene() {
    awk -v count="$1" -v form="$2" 'BEGIN {
        srand(1)
        print "camera: {position: [0, 0, 30]}"
        print "materials: {glaze: {diffuse: [1, 0, 0], specular: 0.5}}"
        print "lights: [{point: {position: [-3, 40, 30], color: 1000}}]"
        print "objects:"
        line = "  - sphere: {center: [%.7g, %.7g, %.7g], radius: %.7g, material: glaze}\n"
        if (form == "rows") {
            print "  - spheres:\n      material: glaze\n      data:"
            line = "        - [%.7g, %.7g, %.7g, %.7g]\n"
        }
        for (i = 0; i < count; i++)
            printf(line, 20 * rand() - 10, 20 * rand() - 10, 20 * rand() - 10, 0.01 + rand() / 10)
    }'
}

# measure COMMAND...: its seconds and kilobytes.
measure() {
    /usr/bin/time -f '%e %M' "$@" 2>&1 >/dev/null | tail -n 1
}

[ $# -gt 0 ] || set -- 100000 1000000
for count in "$@"; do
    for form in rows objects; do
        writeScene "$count" "$form" >"$folder/spheres.yaml"
        for _ in 1 2 3 4 5; do
            echo "$(measure "$folder/yaml_parse" "$folder/spheres.yaml")" \
                "$(measure "$eclairage" check "$folder/spheres.yaml")"
        done | awk '{ print ($1 > 0 ? $3 / $1 : 0), $0 }' | sort -n | awk -v count="$count" -v form="$form" '
            { quotient[NR] = $1 }
            NR == 1 || $2 < parse { parse = $2 }
            NR == 1 || $4 < load { load = $4 }
            $5 > memory { memory = $5 }
            END {
                printf("load %d spheres as %s: %.2f s, libyaml alone %.2f s, the median quotient %.2f; ", count,
                    form, load, parse, quotient[int((NR + 1) / 2)])
                printf("%d kB at most, %.0f bytes an object\n", memory, 1024 * memory / count)
            }'
    done
done
