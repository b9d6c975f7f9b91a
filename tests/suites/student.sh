#!/usr/bin/env bash
# A student's main.c, written from the handout alone, against the library: its pixels are those worked
# out by hand. Prints TAP. Run from the repository root after `make`.
set -euo pipefail
build=${BUILD:-build}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
flags="-std=c17 -Wall -Wextra -Isrc $(pkg-config --cflags libpng zlib)"
libraries="$build/libeclairage.a $(pkg-config --libs libpng yaml-0.1 zlib) -lm -pthread"
for program in main check; do
    # shellcheck disable=SC2086
    ${CC:-cc} $flags -o "$folder/$program" "tests/student/$program.c" $libraries
done
cd "$folder"
./main

# The picture is 641 x 481, so pixel (320, 240) looks straight ahead and one pixel is a slope of
# 2 tan 30 / 481 = 0.00240062. Values are 8-bit sRGB.
#
# 03a, straight ahead: 10 / 3.5^2 = 0.81633, sRGB 0.91446, 233.
# 100 pixels up: slope 0.240062, t = 3.91967, N.L = 0.62813: 10 * 0.62813 / 15.364 = 0.40884: 171.
# 03b, straight ahead R = V: (0.81633 + 0.5 * 0.81633, 0.40816, 0.40816): 255, 171, 171.
# 04, 119 pixels left: the green sphere at t = 3.14011; IL = (-2.13746, 0, 4.01931), N.L = 0.71973:
# 5 * 0.71973 / 20.7236 = 0.17365: 116. 55 pixels left: on the red sphere at (-0.472, 0, -3.576), whose
# way to the light passes the green one's centre at less than its radius: black.
./check lambert.png 320 240 233 0 0 \
    lambert.png 320 140 171 0 0 \
    lambert.png 0 0 0 0 0 \
    my-lambert.png 320 240 233 0 0 \
    my-lambert.png 320 140 171 0 0 \
    phong.png 320 240 255 171 171 \
    shadow-lambert.png 201 240 0 116 0 \
    shadow-lambert.png 265 240 0 0 0 \
    shadow-simple.png 201 240 0 255 0 \
    shadow-simple.png 265 240 0 0 0 \
    shadow-simple.png 330 240 255 0 0
