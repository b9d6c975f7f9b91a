#!/usr/bin/env bash
# Random scenes over the whole vocabulary of the format, drawn by us and by the real POV-Ray, are the same
# (tests/property/crosscheck.c). Prints TAP. Run from the repository root after `make`; `build/crosscheck --seeds
# 1..1000` looks for longer.
set -uo pipefail
if ! command -v povray >/dev/null; then
    echo '1..0 # SKIP povray is not installed'
    exit 0
fi
build=${BUILD:-build}
tests/property/build.sh crosscheck || exit 1
exec "$build/crosscheck" --seeds 1..24 --threads 8
