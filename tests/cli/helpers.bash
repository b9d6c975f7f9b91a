# What the tests of the command line share. `load helpers` at the top of a .bats file.
#
# ECLAIRAGE names the program (build/eclairage below the repository's root where it is not set). Each test
# works in an empty folder of its own; what the program wrote is in the files $out and $err outside of it.

bats_require_minimum_version 1.5.0

setup() {
    root=$(cd "$BATS_TEST_DIRNAME/../.." && pwd)
    ECLAIRAGE=${ECLAIRAGE:-$root/build/eclairage}
    case $ECLAIRAGE in /*) ;; *) ECLAIRAGE=$root/$ECLAIRAGE ;; esac
    out=$BATS_TEST_TMPDIR/out
    err=$BATS_TEST_TMPDIR/err
    export TMPDIR=$BATS_TEST_TMPDIR/temporary
    unset NO_COLOR
    mkdir "$TMPDIR" "$BATS_TEST_TMPDIR/work"
    cd "$BATS_TEST_TMPDIR/work" || exit 1
}

# Runs the program and expects an exit code: try CODE ARGUMENT...
try() {
    local expected=$1 code=0
    shift
    "$ECLAIRAGE" "$@" >"$out" 2>"$err" || code=$?
    expectCode "$expected" "$code"
}

expectCode() { # EXPECTED ACTUAL
    [ "$1" = "$2" ] && return
    echo "exit code $2 in place of $1; standard error was:"
    cat "$err"
    return 1
}

# Expects what the program wrote to be exactly the text on standard input: sameAs "$err" <<'END'
sameAs() {
    diff -u --label expected --label actual - "$1"
}

isEmpty() { # FILE...
    local file
    for file in "$@"; do
        [ ! -s "$file" ] && continue
        echo "expected nothing, and there is:"
        cat "$file"
        return 1
    done
}

hasLine() { # FILE LINE
    grep -qxF -- "$2" "$1" && return
    echo "expected a line: $2"
    echo "in:"
    cat "$1"
    return 1
}

hasText() { # FILE TEXT
    grep -qF -- "$2" "$1" && return
    echo "expected: $2"
    echo "in:"
    cat "$1"
    return 1
}

hasNoText() { # FILE TEXT
    ! hasText "$@" >/dev/null && return
    echo "did not expect: $2"
    echo "in:"
    cat "$1"
    return 1
}

# Expects a command to fail; a plain ! would not fail the test.
not() { # COMMAND...
    if "$@"; then
        echo "did not expect this to succeed: $*"
        return 1
    fi
}

# Expects the names in the current folder, and that nothing is left where temporary files go.
folderHolds() { # NAME...
    [ "$(ls -A)" = "$(printf '%s\n' "$@" | sort)" ] || {
        echo "expected: $*"
        echo "there is:"
        ls -A
        return 1
    }
    nothingTemporary
}

nothingTemporary() {
    [ -z "$(ls -A "$TMPDIR")" ] || {
        echo "left behind in TMPDIR:"
        ls -A "$TMPDIR"
        return 1
    }
}

isPng() { # FILE
    [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ]
}

needs() { # PROGRAM
    command -v "$1" >/dev/null || skip "$1 is not installed"
}

# jq on what the program wrote: json FILTER ARGUMENT...; fails where the filter is false.
json() {
    needs jq
    jq -e "$@" "$out" >"$BATS_TEST_TMPDIR/jq" || {
        echo "jq $* is false or fails for:"
        cat "$out"
        return 1
    }
}

# A small scene in which every model gives another picture.
makeScene() { # FILE [EXTRA LINE...]
    local file=$1
    shift
    cat >"$file" <<'END'
image: {width: 64, height: 48}
lights:
  - point: {position: [-3, 1, 1], color: [20, 20, 20]}
objects:
  - sphere: {center: [0, 0, -5], radius: 1.5, material: {diffuse: [1, 0, 0], specular: 0.5}}
  - sphere: {center: [-1, 0, -3.5], radius: 0.5, material: {diffuse: [0, 1, 0]}}
END
    [ $# = 0 ] || printf '%s\n' "$@" >>"$file"
}

# A scene that takes many seconds to draw: hundreds of rays for each of its pixels.
makeLongScene() { # FILE
    {
        echo 'image: {width: 2000, height: 1500}'
        echo 'render: {samples: 16}'
        echo 'lights: [{point: {position: [0, 9, 0], color: 50}}]'
        echo 'objects:'
        awk 'BEGIN { for (i = 0; i < 3000; i++)
            printf "  - sphere: {center: [%d, %d, -60], radius: 0.6}\n", i % 60 - 30, i / 60 - 25 }'
    } >"$1"
}
