#!/usr/bin/env bash
# Times whole processes on the scenes of the course: one render at 640 x 480, and the comparison of ten scenes
# with POV-Ray. Prints the fastest and the median of several runs in seconds; nothing here is a test.
#
#   bench/render.sh [RUNS]
set -euo pipefail
program=${ECLAIRAGE:-build/eclairage}
runs=${1:-9}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Print LABEL, the fastest and the median of the wall times of COMMAND.
measure() { # LABEL RUNS COMMAND...
    local label=$1 runs=$2
    shift 2
    for _ in $(seq "$runs"); do
        local start=$EPOCHREALTIME
        "$@" >/dev/null 2>&1
        awk -v a="$start" -v b="$EPOCHREALTIME" 'BEGIN { print b - a }'
    done | sort -n | awk -v label="$label" '
        { seconds[NR] = $1 }
        END { printf "%-44s %8.3f s fastest %8.3f s median\n", label, seconds[1], seconds[int((NR + 1) / 2)] }'
}

for scene in 03a-lambert 04-phong 05-phong; do
    measure "render $scene, 640 x 480" "$runs" "$program" render "scenes/course/$scene.yaml" -o "$folder/a.png"
done
if command -v povray >/dev/null; then
    measure "compare the ten course scenes" 3 "$program" compare scenes/course/*.yaml --out "$folder/report"
fi
