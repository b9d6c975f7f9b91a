#!/bin/sh
# Time `eclairage diff` on 1920x1080 pictures: the whole process, and each part on its own.
# Run by `make bench`, which names the program in ECLAIRAGE; its library lies beside it.
set -eu
program=${ECLAIRAGE:-build/eclairage}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# shellcheck disable=SC2046 # the libraries are several words
${CC:-cc} -std=c17 -O2 -D_POSIX_C_SOURCE=200809L -Isrc -I. -pthread -o "$folder/diff" bench/diff.c \
    "$(dirname "$program")/libeclairage.a" $(pkg-config --libs libpng yaml-0.1 zlib) -lm
"$folder/diff" "$folder"

# The least of five runs of the whole process; different pictures make diff exit with 1.
for pair in different near; do
    least=
    for _ in 1 2 3 4 5; do
        start=$(date +%s%N)
        "$program" diff "$folder/a.png" "$folder/$pair.png" --quiet -o "$folder/difference.png" >"$folder/out" ||
            [ $? -eq 1 ]
        milliseconds=$((($(date +%s%N) - start) / 1000000))
        if [ -z "$least" ] || [ "$milliseconds" -lt "$least" ]; then
            least=$milliseconds
        fi
    done
    printf '%-12s%-20s %21d\n' "$pair" 'eclairage diff -o' "$least"
done
