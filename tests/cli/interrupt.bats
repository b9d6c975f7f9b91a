#!/usr/bin/env bats
# Ctrl-C and kill: within 100 ms (a second is allowed here, for busy machines), code 130, nothing left.

load helpers

milliseconds() { echo $(($(date +%s%N) / 1000000)); }

# Starts the program, sends it a signal after a while, and expects it to end soon: interrupted SIGNAL DELAY
# ARGUMENT...
interrupted() {
    local signal=$1 delay=$2 code=0 start
    shift 2
    "$ECLAIRAGE" "$@" >"$out" 2>"$err" &
    local program=$!
    sleep "$delay"
    start=$(milliseconds)
    kill -"$signal" $program
    wait $program || code=$?
    took=$(($(milliseconds) - start))
    expectCode 130 $code
    sameAs "$err" <<<"eclairage: interrupted"
    [ $took -lt 1000 ] || {
        echo "it took $took ms"
        return 1
    }
}

@test "a long render stops, and the old picture stays" {
    makeLongScene s.yaml
    echo old >s.png
    for signal in INT TERM HUP; do
        interrupted $signal 0.4 render s.yaml
        isEmpty "$out"
    done
    [ "$(cat s.png)" = old ]
    folderHolds s.png s.yaml
}

@test "a render to standard output stops, and writes nothing" {
    makeLongScene s.yaml
    interrupted INT 0.4 render s.yaml -o -
    isEmpty "$out"
    folderHolds s.yaml
}

@test "reading from silent standard input stops" {
    mkfifo silent
    sleep 5 3>&- >silent &
    sleeper=$!
    "$ECLAIRAGE" check - <silent >"$out" 2>"$err" &
    program=$!
    sleep 0.3
    start=$(milliseconds)
    kill -INT $program
    code=0
    wait $program || code=$?
    took=$(($(milliseconds) - start))
    kill $sleeper
    expectCode 130 $code
    [ $took -lt 1000 ]
}

@test "compare stops while it draws and while POV-Ray does, and leaves nothing temporary" {
    needs povray
    makeLongScene long.yaml
    interrupted INT 0.5 compare long.yaml
    nothingTemporary
    [ -z "$(find . -name '*.png' -o -name '.*.png*')" ]
    # A small one spends its time in POV-Ray, which sleeps.
    makeScene s.yaml
    interrupted INT 0.3 compare s.yaml s.yaml s.yaml
    nothingTemporary
    [ -z "$(find . -name index.html)" ]
    # No POV-Ray of ours is left running either: it would have a file of our folder open.
    not grep -lqs "$TMPDIR" /proc/[0-9]*/cmdline
}

@test "a Ctrl-C at the terminal, which POV-Ray gets too" {
    needs povray
    needs setsid
    makeScene s.yaml
    setsid "$ECLAIRAGE" compare s.yaml s.yaml >"$out" 2>"$err" &
    program=$!
    sleep 0.3
    kill -INT -- -$program
    code=0
    wait $program || code=$?
    expectCode 130 $code
    sameAs "$err" <<<"eclairage: interrupted"
    nothingTemporary
}

@test "compare with JSON that was interrupted writes no JSON" {
    needs povray
    makeScene s.yaml
    interrupted TERM 0.3 compare s.yaml --json
    isEmpty "$out"
}

@test "check of a huge scene stops" {
    {
        echo 'objects:'
        awk 'BEGIN { for (i = 0; i < 2000000; i++) print "  - sphere: {center: [0, 0, -9], radius: 1}" }'
    } >s.yaml
    interrupted INT 0.3 check s.yaml
    interrupted INT 0.3 check --json s.yaml
    isEmpty "$out"
}
