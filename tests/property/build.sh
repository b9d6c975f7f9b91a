#!/bin/sh
# Builds a program of this folder for a suite: tests/property/build.sh NAME || exit 1. Says why in TAP where that fails.
# BUILD, MAKE and SANITIZE are those of the suite.
build=${BUILD:-build}
"${MAKE:-make}" --no-print-directory BUILD="$build" SANITIZE="${SANITIZE-}" "$build/$1" >"$build/$1.log" 2>&1 && exit 0
sed 's/^/# /' "$build/$1.log"
echo "Bail out! $1 could not be built"
exit 1
