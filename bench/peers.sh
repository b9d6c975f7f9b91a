#!/bin/sh
# peers.sh - us beside the peers on the same scenes: Embree's packets, POV-Ray, Tachyon, libyaml's parser.
#
# Usage: bench/peers.sh [SCENE...]; see bench/peers/measure_peers.py for the scenes, and for what is measured and how.
# It prints each ratio with its target, and whether the pictures agree. A run of all scenes with all peers at the full
# size also writes bench/results.json. A peer that is not installed is left out, aloud.
#
# ROUNDS=5         how often everybody draws
# WIDTH=1024       of the pictures, a multiple of 16
# ENGINE=fast      ours
# RESULTS=FILE     write the results there instead, whatever was run
# PEER_CFLAGS=...  how the yardstick is compiled: for this machine, as was the fastest of what was tried
set -eu
cd "$(dirname "$0")/.."
program=${ECLAIRAGE:-build/eclairage}
engine=${ENGINE:-fast}
width=${WIDTH:-1024}
cflags=${PEER_CFLAGS:--O3 -march=native -ffp-contract=fast -fno-math-errno -fno-trapping-math}

if ! command -v python3 >/dev/null; then
    echo "peers: skipped, python3 is not installed (apt-get install python3)"
    exit 0
fi
folder=$(mktemp -d "${TMPDIR:-/tmp}/eclairage-bench.XXXXXX")
trap 'rm -rf "$folder"' EXIT
trap 'exit 130' INT TERM
mkdir "$folder/tools" "$folder/scenes"

status=0
"$program" render --engine "$engine" --quiet --width 16 scenes/course/03a-simple.yaml -o "$folder/probe.png" \
    2>"$folder/log" || status=$?
if [ $status -eq 2 ]; then
    echo "peers: skipped, $(sed -n '1s/^eclairage: error: //p' "$folder/log")"
    exit 0
elif [ $status -ne 0 ]; then
    cat "$folder/log" >&2
    exit 1
fi

# Compile bench/peers/NAME.c, or FILE, into the tools. The flags are several words.
compileTool() { # FLAGS FILE LIBRARIES
    tool=$(basename "$2" .c)
    # shellcheck disable=SC2086
    ${CC:-cc} -std=c17 $1 -D_POSIX_C_SOURCE=200809L -pthread -o "$folder/tools/$tool" "$2" $3 -lm
}
includes="-O2 -Isrc -I. $(pkg-config --cflags libpng zlib yaml-0.1)"
library="$(dirname "$program")/libeclairage.a $(pkg-config --libs libpng zlib yaml-0.1)"
compileTool "$includes" bench/peers/same_picture.c "$library"
compileTool "$includes" bench/yaml_parse.c "$library"
if echo '#include <embree3/rtcore.h>' | ${CC:-cc} -E - >/dev/null 2>&1; then
    compileTool "$cflags" bench/peers/embree_peer.c -lembree3
fi
compileTool "$includes" bench/peers/engine_frames.c "$library"

# Numbers of a part of the table, of a small picture or without a peer are not the ones to commit.
results=${RESULTS-}
if [ -z "$results" ] && [ $# -eq 0 ] && [ "$width" = 1024 ] && [ "$engine" = fast ] &&
    [ -e "$folder/tools/embree_peer" ] && command -v povray >/dev/null && command -v tachyon >/dev/null; then
    results=bench/results.json
fi
python3 bench/peers/measure_peers.py --program "$program" --tools "$folder/tools" --folder "$folder/scenes" \
    --engine "$engine" --rounds "${ROUNDS:-5}" --width "$width" ${results:+--results "$results"} -- "$@"
