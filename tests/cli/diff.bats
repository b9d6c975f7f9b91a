#!/usr/bin/env bats
# eclairage diff

load helpers

# Two pictures that differ, and a third like the first.
makePictures() {
    makeScene s.yaml
    "$ECLAIRAGE" render -q s.yaml -o a.png
    "$ECLAIRAGE" render -q s.yaml -o same.png
    "$ECLAIRAGE" render -q s.yaml -o b.png --model lambert
}

@test "equal pictures: code 0, and words on standard output" {
    makePictures
    try 0 diff a.png same.png
    [ -s "$out" ]
    isEmpty "$err"
}

@test "different pictures: code 1, and the options set the limits" {
    makePictures
    try 1 diff a.png b.png
    [ -s "$out" ]
    isEmpty "$err"
    try 0 diff a.png b.png --fail 1
    try 0 diff a.png b.png --fail-percent 100
    try 1 diff a.png b.png --fail-percent 100 --hard-fail 0.01
    try 1 diff a.png b.png --fail 1 --rmse 0.0001
    try 0 diff a.png b.png --fail 1 --rmse 1
    try 1 diff a.png b.png --fail 1 --ssim 0.99999
    try 0 diff a.png b.png --fail 1 --ssim 0
    try 1 diff a.png b.png --fail 1 --flip 0.00001
    try 0 diff a.png b.png --fail 1 --flip 1
}

@test "JSON has the contract's fields" {
    makePictures
    fields='["width", "height", "pixels", "identical_pixels", "differing_pixels", "differing_percent",
        "max_difference", "worst_pixel", "mae", "rmse", "psnr", "ssim", "flip", "pass", "reasons"]'
    try 1 diff --json a.png b.png
    json "[keys_unsorted[]] == $fields"
    json '.worst_pixel | [keys_unsorted[]] == ["x", "y", "channel", "a", "b"]'
    json '.width == 64 and .height == 48 and .pixels == 3072 and .pass == false and (.reasons | length) > 0'
    json '.max_difference == ((.worst_pixel.a - .worst_pixel.b) | fabs)'
    try 0 diff --json a.png same.png
    json "[keys_unsorted[]] == $fields"
    json '.pass and .reasons == [] and .psnr == null and .ssim == 1 and .identical_pixels == 3072'
}

@test "the difference picture, in a file or on standard output" {
    makePictures
    try 1 diff a.png b.png -o d.png
    isPng d.png
    hasLine "$err" "eclairage: wrote d.png"
    [ -s "$out" ]
    try 1 diff a.png b.png -o -
    cmp "$out" d.png
    [ -s "$err" ] # the words make way for the picture
    try 1 diff -q a.png b.png -o d.png
    isEmpty "$err"
    try 4 diff a.png b.png -o missing/d.png
    hasText "$err" missing/d.png
}

@test "pictures that cannot be compared give code 6" {
    makePictures
    "$ECLAIRAGE" render -q s.yaml -o wide.png --width 32
    "$ECLAIRAGE" render -q s.yaml -o deep.png --bit-depth 16
    "$ECLAIRAGE" render -q s.yaml -o linear.png --encoding linear
    for other in wide deep linear; do
        try 6 diff a.png $other.png --json
        isEmpty "$out"
        hasText "$err" "eclairage: error: "
        hasText "$err" $other.png
    done
}

@test "files that are not pictures give code 4, each named" {
    makePictures
    echo text >text.png
    head -c 100 a.png >cut.png
    : >empty.png
    for bad in text cut empty missing; do
        try 4 diff a.png $bad.png
        isEmpty "$out"
        hasText "$err" $bad.png
    done
    try 4 diff text.png missing.png
    hasText "$err" text.png
    hasText "$err" missing.png
}

@test "alpha is ignored, with a warning" {
    # A red pixel with half of its opacity.
    base64 -d >alpha.png <<'END'
iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP4z8DQAAAEgQGA8wvcoAAAAABJRU5ErkJggg==
END
    try 0 diff alpha.png alpha.png
    [ "$(grep -c 'eclairage: warning: alpha.png has an alpha channel, which is ignored' "$err")" = 2 ]
}
