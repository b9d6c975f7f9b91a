#!/bin/sh
# Time the conversion of a rendered picture of 3840x2160 to samples, and its encoding as PNG.
# Run by `make bench`, which names the program in ECLAIRAGE; its library lies beside it.
#
#   bench/png.sh [SCENE.yaml]
set -eu
program=${ECLAIRAGE:-build/eclairage}
scene=${1:-scenes/course/05-phong.yaml}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# shellcheck disable=SC2046 # the libraries are several words
${CC:-cc} -std=c17 -O2 -D_POSIX_C_SOURCE=200809L -Isrc -I. -pthread -o "$folder/png" bench/png.c \
    "$(dirname "$program")/libeclairage.a" $(pkg-config --libs libpng yaml-0.1 zlib) -lm
"$program" render "$scene" --width 3840 --height 2160 --bit-depth 16 --encoding linear --quiet \
    -o "$folder/scene.png"
"$folder/png" "$folder/scene.png" "$folder"
