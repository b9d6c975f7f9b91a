#!/usr/bin/env bash
# Programs of several compilers draw the same bytes. Prints TAP. Run from the repository root.
#
#   tools/same-pictures.sh PROGRAM...       those that are not there are left out
set -uo pipefail
programs=()
for program; do
    [ ! -x "$program" ] || programs+=("$program")
done
if [ ${#programs[@]} -lt 2 ]; then
    echo '1..0 # SKIP there is only one build'
    exit 0
fi
count=0
for scene in scenes/course/*.yaml scenes/gallery/*.yaml; do
    count=$((count + 1))
    expected=
    different=
    for program in "${programs[@]}"; do
        actual=$("$program" render "$scene" --width 64 --quiet -o - | sha256sum) || different="$different $program fails"
        expected=${expected:-$actual}
        [ "$actual" = "$expected" ] || different="$different $program"
    done
    if [ -z "$different" ]; then
        echo "ok $count - $scene"
    else
        echo "not ok $count - $scene: not the bytes of ${programs[0]}:$different"
    fi
done
echo "1..$count"
