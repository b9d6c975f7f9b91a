#!/bin/sh
# load.sh - fuzz the loader for some seconds (60 by default); see load.c. Needs clang with libFuzzer.
#
# New inputs are kept under BUILD/fuzz (BUILD is build by default); a crash leaves its input there too.
set -eu

seconds=${1:-60}
build=${BUILD:-build}/fuzz
clang=${CLANG:-clang}
if ! command -v "$clang" >/dev/null; then
    echo "fuzz: skipped, clang is not installed (apt-get install clang)"
    exit 0
fi

mkdir -p "$build/seeds" "$build/found"
for scene in scenes/*/*.yaml; do
    cp "$scene" "$build/seeds/$(echo "$scene" | tr / -)"
done
"$clang" -std=c17 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all \
    -D_POSIX_C_SOURCE=200809L -Isrc -I. -o "$build/load" \
    tests/fuzz/load.c $(ls src/*.c | grep -v 'main[.]c$') src/scene/*.c src/base/*.c src/shapes/*.c \
    src/patterns/*.c src/image/*.c $(pkg-config --cflags --libs yaml-0.1 libpng zlib) -lm -pthread
"$build/load" -max_total_time="$seconds" -max_len=4096 -timeout=5 -dict=tests/fuzz/load.dict \
    -artifact_prefix="$build/" -print_final_stats=1 "$build/found" "$build/seeds"
