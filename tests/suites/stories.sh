#!/bin/sh
# The story of a pixel (eclairage why) against the course's tracer, to the last bit, on random scenes and on
# scenes made of coincidences (tests/property/stories.c). Prints TAP. Run from the repository root after `make`.
set -eu

build=${BUILD:-build}
if ! "${MAKE:-make}" --no-print-directory BUILD="$build" SANITIZE="${SANITIZE-}" "$build/stories" >"$build/stories.log" 2>&1; then
    sed 's/^/# /' "$build/stories.log"
    echo 'Bail out! stories could not be built'
    exit 1
fi
exec "$build/stories" --seeds 1..200 --nasty 1..100
