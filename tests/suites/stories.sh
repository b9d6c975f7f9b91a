#!/bin/sh
# The story of a pixel (eclairage why) against the course's tracer, to the last bit, on random scenes and on
# scenes made of coincidences (tests/property/stories.c). Prints TAP. Run from the repository root after `make`.
set -eu

build=${BUILD:-build}
tests/property/build.sh stories || exit 1
exec "$build/stories" --seeds 1..200 --nasty 1..100
