#!/usr/bin/env bats
# Full, closed and coloured streams, and the progress bar.

load helpers

# The commands that write to standard output, one a line; they need a.png and s.yaml.
writers='--help
--version
help diff
render --help
schema
pov s.yaml
render s.yaml -o -
render s.yaml -o x.png --json
check s.yaml --json
diff a.png a.png
diff a.png a.png --json
diff a.png a.png -o -'

eachWriter() { # FUNCTION
    makeScene s.yaml
    "$ECLAIRAGE" render -q s.yaml -o a.png
    local line words
    while read -r line; do
        read -r -a words <<<"$line"
        "$1" "${words[@]}" || {
            echo "with: $line"
            return 1
        }
    done <<<"$writers"
}

@test "a full device: code 4 and a message, for every command" {
    full() {
        local code=0
        "$ECLAIRAGE" "$@" >/dev/full 2>"$err" || code=$?
        expectCode 4 $code
        hasText "$err" "eclairage: error: "
        hasText "$err" "standard output"
    }
    eachWriter full
}

@test "a closed standard output: code 4, and no file is taken for it" {
    closed() {
        local code=0
        "$ECLAIRAGE" "$@" >&- 2>"$err" || code=$?
        expectCode 4 $code
        hasText "$err" "eclairage: error: "
    }
    eachWriter closed
    isPng a.png
    isPng x.png
}

@test "a closed pipe: code 4 and a message, for every command" {
    broken() {
        rm -f code
        { sleep 0.1; code=0; "$ECLAIRAGE" "$@" 2>"$err" || code=$?; echo $code >code; } | true
        expectCode 4 "$(cat code)"
        hasText "$err" "eclairage: error: "
    }
    eachWriter broken
}

@test "closed standard input and error do no harm" {
    makeScene s.yaml
    "$ECLAIRAGE" render s.yaml 2>&- <&-
    isPng s.png
    code=0
    "$ECLAIRAGE" check - <&- 2>"$err" || code=$?
    expectCode 4 $code
    code=0
    "$ECLAIRAGE" check missing.yaml 2>/dev/full || code=$?
    [ $code = 4 ]
}

@test "the places of closed streams are taken before any file is opened" {
    [ -e /proc/self/fd ] || skip "there is no /proc"
    mkfifo scene.yaml
    "$ECLAIRAGE" check scene.yaml <&- >&- 2>&- &
    program=$!
    sleep 0.3
    for descriptor in 0 1 2; do
        [ "$(readlink /proc/$program/fd/$descriptor)" = /dev/null ]
    done
    kill $program
    wait $program || true
}

# What the program writes to a terminal of 80 columns: onTerminal COMMAND_LINE
onTerminal() {
    needs script
    TERM=${TERM_TO_TEST-xterm} script -qec "$1" /dev/null </dev/null >"$out"
}

escape=$'\e'

@test "colour: only on a terminal, unless NO_COLOR or --color says otherwise" {
    echo 'typo: 1' >bad.yaml
    try 3 check bad.yaml
    hasNoText "$err" "$escape"
    try 3 check bad.yaml --color=always
    hasText "$err" "$escape"
    NO_COLOR=1 try 3 check bad.yaml --color=always
    hasText "$err" "$escape"
    try 2 render --color always # usage errors come before the options count
    onTerminal "'$ECLAIRAGE' check bad.yaml" || true
    hasText "$out" "$escape"
    onTerminal "'$ECLAIRAGE' check bad.yaml --color never" || true
    hasNoText "$out" "$escape"
    onTerminal "NO_COLOR=1 '$ECLAIRAGE' check bad.yaml" || true
    hasNoText "$out" "$escape"
    onTerminal "NO_COLOR= '$ECLAIRAGE' check bad.yaml" || true
    hasText "$out" "$escape"
    TERM_TO_TEST=dumb onTerminal "'$ECLAIRAGE' check bad.yaml" || true
    hasNoText "$out" "$escape"
}

@test "words on standard output are coloured by the same rule" {
    makeScene s.yaml
    "$ECLAIRAGE" render -q s.yaml -o a.png
    try 0 diff a.png a.png
    hasNoText "$out" "$escape"
    try 0 diff a.png a.png --color always
    hasText "$out" "$escape"
    try 0 diff a.png a.png --color always --json
    hasNoText "$out" "$escape"
}

@test "the progress bar: only on a terminal, after a second, and erased" {
    needs script
    makeLongScene s.yaml
    # Draw for two seconds, and stop.
    bar() { onTerminal "$1 timeout --foreground -s INT 2 '$ECLAIRAGE' render s.yaml $2" || true; }
    bar '' ''
    grep -qE 'rendering \[#*\.*\] +[0-9]+ %  .* left' "$out"
    # Erased at the end: what follows the last bar begins with the order to erase the line.
    tail -c 200 "$out" | grep -q $'\r\e\[Keclairage: '
    bar '' --quiet
    hasNoText "$out" rendering
    bar 'env TERM=dumb' ''
    hasNoText "$out" rendering
    timeout --foreground -s INT 2 "$ECLAIRAGE" render s.yaml 2>"$err" || true
    hasNoText "$err" rendering
    makeScene short.yaml
    onTerminal "'$ECLAIRAGE' render short.yaml"
    hasNoText "$out" rendering
}
