#!/usr/bin/env bats
# --help, --version and what is made from the same tables: the manual page and the completion.
#
# A test whose expectation is a file says how to renew it after a change of the tables.

load helpers

commands="render pov compare diff explain why check schema"

# To renew: eclairage --help >tests/cli/expected/help.txt, and so on for each command.
@test "the help is exactly as expected, on standard output" {
    try 0 --help
    diff -u "$root/tests/cli/expected/help.txt" "$out"
    isEmpty "$err"
    for command in $commands; do
        try 0 "$command" --help
        diff -u "$root/tests/cli/expected/help-$command.txt" "$out"
        isEmpty "$err"
    done
}

@test "help is found in every way" {
    try 0 -h
    cmp "$out" "$root/tests/cli/expected/help.txt"
    try 0 help
    cmp "$out" "$root/tests/cli/expected/help.txt"
    for arguments in "help diff" "diff -h" "-h diff" "--help diff a b c d" "diff --help --width=3"; do
        case $arguments in *width*) code=2 ;; *) code=0 ;; esac
        # shellcheck disable=SC2086
        try $code $arguments
        [ $code = 2 ] || cmp "$out" "$root/tests/cli/expected/help-diff.txt"
    done
}

@test "help leads with examples, fits 80 columns, and its examples are accepted" {
    for command in $commands; do
        try 0 "$command" --help
        [ "$(head -n 1 "$out")" = "Examples:" ]
        if grep -nE '^.{81}' "$out"; then
            echo "a line of the help of $command is longer than 80 characters"
            return 1
        fi
    done
    # No example is a usage error: its files are missing, which is another one.
    for command in $commands; do
        "$ECLAIRAGE" "$command" --help | sed -n '/^Examples:/,/^$/s/^  //p' >examples
        while read -r line; do
            line=$(sed -E 's/^.*\| (eclairage)/\1/; s/  +.*//; s/ (\||>|&&) .*//' <<<"$line")
            [ "${line#eclairage }" != "$line" ]
            read -r -a words <<<"${line#eclairage }"
            code=0
            "$ECLAIRAGE" "${words[@]}" </dev/null >"$out" 2>"$err" || code=$?
            [ "$code" != 2 ] || {
                echo "the example is refused: $line"
                cat "$err"
                return 1
            }
        done <examples
    done
}

@test "the version" {
    try 0 --version
    grep -qxE 'eclairage [0-9]+\.[0-9]+\.[0-9]+' "$out"
    isEmpty "$err"
    "$ECLAIRAGE" render --version | cmp - "$out"
}

# To renew: eclairage --print-manual-page >man/eclairage.1
@test "the manual page is the one made from the tables" {
    try 0 --print-manual-page
    diff -u "$root/man/eclairage.1" "$out"
}

@test "the manual page has every command and option, and is clean troff" {
    for command in $commands; do
        grep -q "^\.SS eclairage $command" "$root/man/eclairage.1"
    done
    "$ECLAIRAGE" compare --help | grep -oE -- '--[a-z-]+' | sort -u >names
    while read -r name; do
        grep -qF -- "${name//-/\\-}" "$root/man/eclairage.1"
    done <names
    needs man
    LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -l "$root/man/eclairage.1" >"$out" 2>"$err"
    isEmpty "$err"
}

# To renew: eclairage --print-bash-completion >completions/eclairage.bash
@test "the completion is the one made from the tables" {
    try 0 --print-bash-completion
    diff -u "$root/completions/eclairage.bash" "$out"
}

# What bash offers after these words, the last one unfinished; sorted, on one line.
completes() {
    bash -c '
        compopt() { :; }
        source "$1"
        shift
        COMP_WORDS=(eclairage "$@")
        COMP_CWORD=$#
        _eclairage
        printf "%s\n" "${COMPREPLY[@]}" | sort | tr "\n" " "
    ' - "$root/completions/eclairage.bash" "$@"
}

@test "completion of commands, options, values and files" {
    mkdir folder
    touch a.yaml b.yml c.png "with space.yaml"
    [ "$(completes re)" = "render " ]
    [ "$(completes '')" = "--help --version check compare diff explain pov render schema why " ]
    [ "$(completes render --wi)" = "--width " ]
    [ "$(completes schema --)" = "--color --help --quiet --version " ]
    [ "$(completes render --model '')" = "blinn_phong lambert phong simple " ]
    [ "$(completes render --color = a)" = "always auto " ]
    [ "$(completes render --color =)" = "always auto never " ]
    [ "$(completes render '')" = "a.yaml b.yml folder with space.yaml " ]
    [ "$(completes -q check a)" = "a.yaml " ]
    [ "$(completes diff '')" = "c.png folder " ]
    [ "$(completes compare --out '')" = "folder " ]
    [ "$(completes render -o c)" = "c.png " ]
    [ "$(completes render --width '')" = " " ]
}

# The ranges of options and scene keys are the same numbers, written in two tables.
@test "options have the limits and choices of the scene format" {
    needs jq
    "$ECLAIRAGE" schema >schema.json
    limits() { jq -r ".properties.$1 | \"\(.minimum) to \(.maximum)\"" schema.json; }
    for pair in width:image.properties.width height:image.properties.height fail:compare.properties.fail \
        fail-percent:compare.properties.fail_percent hard-fail:compare.properties.hard_fail \
        rmse:compare.properties.rmse ssim:compare.properties.ssim flip:compare.properties.flip; do
        try 2 compare s.yaml "--${pair%%:*}=x"
        hasText "$err" "number from $(limits "${pair#*:}"), not 'x'"
    done
    jq -r '.properties.render.properties.model.enum[]' schema.json >models
    [ -s models ]
    "$ECLAIRAGE" render --help | sed -n 's/.*--model \([a-z_|]*\).*/\1/p' | tr '|' '\n' | sort | diff - <(sort models)
}
