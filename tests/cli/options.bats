#!/usr/bin/env bats
# The command line itself: what is accepted, and what is refused with which words.

load helpers

# Expects a usage error: refused MESSAGE COMMAND ARGUMENT..., where COMMAND is - for none.
refused() {
    local message=$1 command=$2
    shift 2
    try 2 "$@"
    isEmpty "$out"
    sameAs "$err" <<END
eclairage: error: $message
Try: eclairage ${command#-}$([ "$command" = - ] || echo ' ')--help
END
}

@test "without arguments: the help on standard error, and code 2" {
    try 2
    isEmpty "$out"
    diff "$root/tests/cli/expected/help.txt" "$err"
}

@test "unknown commands, with the one that was meant" {
    refused "unknown command 'redner'; did you mean 'render'?" - redner scene.yaml
    refused "unknown command 'Compare'; did you mean 'compare'?" - Compare
    refused "unknown command 'frobnicate'" - frobnicate
    refused "unknown command ''" - ''
    refused "no command before 'scene.yaml'; to draw it: eclairage render scene.yaml" - scene.yaml
    refused "no command was given" - --quiet
    refused "unknown command 'chek'; did you mean 'check'?" - help chek
}

@test "unknown options, with the one that was meant" {
    refused "unknown option '--widht'; did you mean '--width'?" render render s.yaml --widht 3
    refused "unknown option '--colour'; did you mean '--color'?" schema schema --colour=never
    refused "unknown option '--bitdepth'; did you mean '--bit-depth'?" render render s.yaml --bitdepth 8
    refused "unknown option '--frobnicate'" render render s.yaml --frobnicate
    refused "unknown option '-x'" check check -x s.yaml
    refused "unknown option '-x'" check check -qx s.yaml
    refused "unknown option '-é'" check check -é
    refused "unknown option '--'" compare compare --=3 s.yaml
    refused "unknown option '--verison'; did you mean '--version'?" - --verison
}

@test "options of other commands are refused by name" {
    refused "'check' does not take --width, which is an option of render, pov, compare, explain and why" check \
        check --width 3 s.yaml
    refused "'compare' does not take -o, which is an option of render, pov and diff; use --out DIR" compare \
        compare s.yaml -o x
    refused "'render' does not take --out, which is an option of compare and explain; use --output FILE" render \
        render s.yaml --out x
    refused "'pov' does not take --json, which is an option of render, compare, diff, explain, why and check" pov \
        pov --json s.yaml
    refused "'schema' does not take --json, which is an option of render, compare, diff, explain, why and check" schema \
        --json schema
}

@test "numbers: the limits are in the message" {
    for value in 0 -1 65536 abc 1.5 1e3 0x10 ' 3' '3 ' 99999999999999999999 nan inf; do
        refused "--width must be a whole number from 1 to 65535, not '$value'" render render s.yaml --width "$value"
    done
    refused "--height must be a whole number from 1 to 65535, not ''" pov pov s.yaml --height=
    refused "--threads must be a whole number from 1 to 256, not '0'" compare compare s.yaml --threads 0
    refused "--threads must be a whole number from 1 to 256, not '257'" render render s.yaml --threads 257
    refused "--samples must be a whole number from 1 to 64, not '65'" render render s.yaml --samples 65
    refused "--fail must be a number from 0 to 1, not '1.01'" diff diff a b --fail 1.01
    refused "--fail must be a number from 0 to 1, not '-1e-9'" diff diff a b --fail -1e-9
    refused "--fail must be a number from 0 to 1, not 'nan'" diff diff a b --fail nan
    refused "--fail must be a number from 0 to 1, not '0,5'" diff diff a b --fail 0,5
    refused "--fail-percent must be a number from 0 to 100, not '101'" compare compare s.yaml --fail-percent 101
    refused "--hard-fail must be a number from 0 to 1, not '2'" compare compare s.yaml --hard-fail=2
    refused "--rmse must be a number from 0 to 1, not '1e400'" diff diff a b --rmse 1e400
    refused "--ssim must be a number from -1 to 1, not '2'" diff diff a b --ssim 2
    refused "--flip must be a number from 0 to 1, not ''" diff diff a b --flip ''
}

@test "choices: all of them are in the message" {
    refused "--model must be simple, lambert, phong or blinn_phong, not 'phnog'; did you mean 'phong'?" render \
        render s.yaml --model phnog
    refused "--engine must be fast or reference, not 'gpu'" compare compare s.yaml --engine gpu
    refused "--engine must be fast or reference, not 'quick'" render render s.yaml --engine quick
    refused "--encoding must be srgb or linear, not 'rgb'; did you mean 'srgb'?" render \
        render s.yaml --encoding rgb
    refused "--bit-depth must be 8 or 16, not '12'" render render s.yaml --bit-depth 12
    refused "--color must be auto, always or never, not 'sometimes'" check check s.yaml --color sometimes
}

@test "values that are missing, or not wanted" {
    refused "--width needs a value after it" render render s.yaml --width
    refused "--width needs a value after it" render render s.yaml --width --height 3
    refused "-o needs a value after it" render render s.yaml -o
    refused "-o needs a value after it" render render s.yaml -o --json
    refused "--out needs a value after it" compare compare s.yaml --out
    refused "--quiet takes no value, and 'yes' was given" render render s.yaml --quiet=yes
    refused "-o needs the name of a file, not an empty one" render render s.yaml -o ''
    refused "--out needs the name of a folder, not an empty one" compare compare s.yaml --out=
}

@test "operands: too few and too many" {
    refused "'render' needs a scene: SCENE.yaml" render render
    refused "'render' takes only one scene, and 'b.yaml' is too many" render render a.yaml b.yaml
    refused "'pov' needs a scene: SCENE.yaml" pov pov -q
    refused "'compare' needs at least one scene: SCENE.yaml" compare compare --json
    refused "'check' needs at least one scene: SCENE.yaml" check check --
    refused "'diff' needs two pictures: A.png B.png" diff diff a.png
    refused "'diff' takes only two pictures, and 'c.png' is too many" diff diff a.png b.png c.png
    refused "'schema' takes no operands, and 'x' is too many" schema schema x
    refused "the name of a file is empty" check check ''
}

@test "one standard output and one standard input cannot serve two" {
    refused "-o - and --json would both write to standard output: give -o a file" render render s.yaml -o - --json
    refused "-o - and --json would both write to standard output: give -o a file" diff diff --json -o- a.png b.png
    refused "standard input (-) can be read only once" check check - -
    refused "a scene from standard input (-) has no name to make that of the picture from: give one with -o FILE" \
        render render -
}

@test "options stand anywhere, in every spelling" {
    makeScene s.yaml
    try 0 --width=32 render s.yaml -oa.png
    try 0 render --width 32 -o b.png s.yaml
    try 0 render s.yaml --output=c.png --width 9 --width 32
    try 0 diff a.png b.png --fail 0 --fail-percent 0
    try 0 diff a.png c.png --fail 0 --fail-percent 0
    try 0 -qo d.png render s.yaml --width 32
    isEmpty "$err"
    try 0 diff a.png d.png --hard-fail 0
}

@test "-- ends the options" {
    makeScene ./-q
    try 0 render -o a.png -- -q
    isPng a.png
    try 2 render -o a.png -- -q -q
    hasText "$err" "'-q' is too many"
}
