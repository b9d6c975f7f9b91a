#!/usr/bin/env bash
# Runs the test suites and ends in one line over all of them:  N passed, M failed[, K skipped]
#
# Every test program speaks TAP; tools/read-tap.awk says what counts as a failure. A sanitizer's report is one
# too. What could not run says why and counts as skipped, never as passed.
#
#   tools/run-tests.sh                          everything; the exit status is 0 only if nothing failed
#   SUITES='unit cli' tools/run-tests.sh        only those suites (their names are at the end of this file)
#   SANITIZE=address,undefined tools/run-tests.sh    unit and cli, with a build under those sanitizers
#
# From make come MAKE, CC, BUILD and SANITIZE. Tests get ECLAIRAGE (the program's absolute path), BUILD,
# CC and MAKE, and ECLAIRAGE_SANITIZED=1 where the program is slower and hungrier than a user's.

set -u -o pipefail
cd "$(dirname "$0")/.." || exit 1

MAKE=${MAKE:-make}
CC=${CC:-cc}
SANITIZE=${SANITIZE-}
BUILD=${BUILD:-build${SANITIZE:+/${SANITIZE//,/-}}}
export MAKE CC BUILD
# The options of the make that called, such as -j, are not for the ones below.
unset MAKEFLAGS MAKELEVEL MFLAGS
# A test must not depend on how its user likes the program to look.
unset NO_COLOR CLICOLOR CLICOLOR_FORCE

processors=$(nproc 2>/dev/null || echo 2)
timeLimit=300 # seconds for one test program
logs=$BUILD/test-logs
reports=$PWD/$logs/sanitizer
rm -rf "$logs"
mkdir -p "$logs"
case $BUILD in /*) reports=$logs/sanitizer ;; esac

passed=0
failed=0
skipped=0

# Ctrl-C ends the programs that are still running, and their children with them.
stopAll() {
    trap '' INT TERM
    # shellcheck disable=SC2046
    kill $(jobs -p) 2>/dev/null
    wait
    echo "Interrupted." >&2
    exit 130
}
trap stopAll INT TERM

# --- A suite: a heading, jobs that run side by side, their results in order, one line of counts -----------

beginSuite() { # TITLE
    printf '\n== %s\n' "$1"
    suite=$logs/$2
    mkdir -p "$suite"
    jobNames=()
    suiteStart=$SECONDS
    suitePassed=0
    suiteFailed=0
    suiteSkipped=0
}

# Starts a TAP program in the background; its output and exit status go to files named after it.
addJob() { # NAME COMMAND...
    local name=$1
    shift
    while (($(jobs -pr | wc -l) >= processors)); do
        wait -n
    done
    jobNames+=("$name")
    (
        timeout --kill-after=10 "$timeLimit" "$@" </dev/null >"$suite/$name.log" 2>&1 &
        program=$!
        trap 'kill "$program"' TERM
        wait "$program"
        echo $? >"$suite/$name.status"
    ) &
}

endSuite() {
    local name status counts
    wait
    for name in ${jobNames[@]+"${jobNames[@]}"}; do
        status=$(cat "$suite/$name.status" 2>/dev/null || echo 'unknown')
        {
            read -r -a counts
            cat
        } < <(awk -v name="$name" -v status="$status" -f tools/read-tap.awk "$suite/$name.log")
        suitePassed=$((suitePassed + counts[0]))
        suiteFailed=$((suiteFailed + counts[1]))
        suiteSkipped=$((suiteSkipped + counts[2]))
    done
    # A sanitizer's report fails the suite even if the test swallowed the program's output.
    for report in "$reports".*; do
        [ -f "$report" ] || continue
        suiteFailed=$((suiteFailed + 1))
        echo "  FAILED: a sanitizer reported:"
        sed 's/^/    /' "$report"
        mv "$report" "$suite/"
    done
    printf '   %d passed, %d failed' "$suitePassed" "$suiteFailed"
    [ "$suiteSkipped" = 0 ] || printf ', %d skipped' "$suiteSkipped"
    printf ' (%d s)\n' $((SECONDS - suiteStart))
    passed=$((passed + suitePassed))
    failed=$((failed + suiteFailed))
    skipped=$((skipped + suiteSkipped))
}

skipSuite() { # TITLE REASON
    printf '\n== %s\n   skipped: %s\n' "$1" "$2"
    skipped=$((skipped + 1))
}

# One test inside the current suite: a command that says what is wrong and exits with an error, or 77 to skip.
check() { # LABEL COMMAND...
    local label=$1 log=$suite/check.log status
    shift
    "$@" </dev/null >"$log" 2>&1
    status=$?
    case $status in
    0)
        suitePassed=$((suitePassed + 1))
        ;;
    77)
        suiteSkipped=$((suiteSkipped + 1))
        echo "  skipped: $label: $(cat "$log")"
        ;;
    *)
        suiteFailed=$((suiteFailed + 1))
        sed 's/^/    /' "$log"
        echo "  FAILED: $label (exit status $status)"
        ;;
    esac
    return $status
}

# Builds targets with make; a failure is printed and counted as a failed test of the current suite.
build() { # FOLDER TARGET... [VARIABLE=VALUE...]
    local folder=$1 log
    shift
    log=$suite/build.log
    if ! "$MAKE" --no-print-directory -k -j"$processors" BUILD="$folder" "$@" </dev/null >"$log" 2>&1; then
        suiteFailed=$((suiteFailed + 1))
        grep -v '^  [A-Z]* ' "$log" | sed 's/^/    /'
        echo "  FAILED: the build in $folder"
        return 1
    fi
}

absolute() {
    case $1 in /*) echo "$1" ;; *) echo "$PWD/$1" ;; esac
}

# --- The suites -------------------------------------------------------------------------------------------

# What the sanitizers are told. Leaks count. A report goes to a file, or with gcc's undefined-behaviour library to
# standard error, and ends the program with 99, which no command uses: a test cannot take it for what it expects.
# Memory that cannot be had gives NULL, as it does without a sanitizer.
sanitizedFolder=$BUILD
[ -n "$SANITIZE" ] || sanitizedFolder=$BUILD/address-undefined
sanitizedEnvironment=(
    "ECLAIRAGE=$(absolute "$sanitizedFolder")/eclairage" "ECLAIRAGE_SANITIZED=1"
    "ASAN_OPTIONS=detect_leaks=1:allocator_may_return_null=1:exitcode=99:log_path=$reports:${ASAN_OPTIONS-}"
    "UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1:exitcode=99:log_path=$reports:${UBSAN_OPTIONS-}"
)
plainEnvironment=("ECLAIRAGE=$(absolute "$BUILD")/eclairage")
if [ -n "$SANITIZE" ]; then
    plainEnvironment=("${sanitizedEnvironment[@]}")
fi

hasFiles() { # true if the pattern that the caller wrote matched something
    [ -e "$1" ]
}

unitTests() { # FOLDER ENVIRONMENT...
    local folder=$1 program
    shift
    for program in tests/unit/test_*.c; do
        program=${program##*/}
        program=$folder/tests/${program%.c}
        # A program that did not build was counted by build.
        [ ! -x "$program" ] || addJob "${program##*/}" env "$@" CMOCKA_MESSAGE_OUTPUT=TAP "$program"
    done
}

commandLineTests() { # ENVIRONMENT...
    local file
    for file in tests/cli/*.bats; do
        addJob "${file##*/}" env "$@" bats --tap "$file"
    done
}

suite_unit() {
    hasFiles tests/unit/test_*.c || return 0
    beginSuite "Unit tests" unit
    build "$BUILD" all unit SANITIZE="$SANITIZE"
    unitTests "$BUILD" "${plainEnvironment[@]}"
    endSuite
}

suite_cli() {
    hasFiles tests/cli/*.bats || return 0
    beginSuite "The command line" cli
    build "$BUILD" all SANITIZE="$SANITIZE" && commandLineTests "${plainEnvironment[@]}"
    endSuite
}

# Everything once more, the program too, with the address and undefined-behaviour sanitizers.
suite_sanitized() {
    hasFiles tests/unit/test_*.c || return 0
    beginSuite "Unit tests and the command line under AddressSanitizer and UndefinedBehaviorSanitizer" sanitized
    build "$sanitizedFolder" all unit SANITIZE=address,undefined
    unitTests "$sanitizedFolder" "${sanitizedEnvironment[@]}"
    if hasFiles tests/cli/*.bats && [ -x "$sanitizedFolder/eclairage" ]; then
        commandLineTests "${sanitizedEnvironment[@]}"
    fi
    endSuite
}

# A real build and not only a look at the syntax: some warnings need the optimiser. Then the pictures of the
# compilers and of the sanitized program are the same to the byte.
suite_compilers() {
    local compiler
    beginSuite "gcc and clang: warnings are errors, and the pictures are the same" compilers
    for compiler in gcc clang; do
        if ! command -v $compiler >/dev/null; then
            echo "  skipped: $compiler is not installed"
            suiteSkipped=$((suiteSkipped + 1))
        elif build "$BUILD/$compiler" all unit CC=$compiler WERROR=1; then
            suitePassed=$((suitePassed + 1))
        fi
    done
    check "the same pictures from every build" samePictures
    endSuite
}
samePictures() {
    local scene folder expected actual program programs=() different=0
    for folder in "$BUILD/gcc" "$BUILD/clang" "$sanitizedFolder"; do
        [ ! -x "$folder/eclairage" ] || programs+=("$folder/eclairage")
    done
    if [ ${#programs[@]} -lt 2 ]; then
        echo "there is only one build"
        return 77
    fi
    for scene in scenes/course/*.yaml scenes/gallery/*.yaml; do
        expected=
        for program in "${programs[@]}"; do
            actual=$("$program" render "$scene" --width 64 --quiet -o - | sha256sum) || return 1
            expected=${expected:-$actual}
            if [ "$actual" != "$expected" ]; then
                echo "$scene: $program draws other bytes than ${programs[0]}"
                different=1
            fi
        done
    done
    return $different
}

suite_style() {
    beginSuite "Layout of the code, and who includes whom" style
    check "clang-format" tools/check-format.sh
    check "include arrows" tools/check-includes.sh
    endSuite
}

# Every executable tests/suites/*.sh is a suite: it runs from the top folder, prints TAP and cleans up.
suite_shell() {
    local script
    hasFiles tests/suites/*.sh || return 0
    beginSuite "Whole-program suites (tests/suites)" shell
    if build "$BUILD" all SANITIZE="$SANITIZE"; then
        for script in tests/suites/*.sh; do
            addJob "${script##*/}" env "${plainEnvironment[@]}" "$script"
        done
    fi
    endSuite
}

suite_browser() {
    local file title="The report and the notes in a browser"
    hasFiles tests/browser/*test*.*js || return 0
    if ! command -v node >/dev/null; then
        skipSuite "$title" "node is not installed (make setup installs it)"
    elif [ ! -d tests/browser/node_modules/playwright-core ]; then
        skipSuite "$title" "playwright-core is not installed (make setup installs it)"
    elif ! command -v chromium >/dev/null && ! command -v chromium-browser >/dev/null &&
        ! command -v google-chrome >/dev/null; then
        skipSuite "$title" "chromium is not installed (make setup installs it)"
    else
        beginSuite "$title" browser
        if build "$BUILD" all SANITIZE="$SANITIZE"; then
            for file in tests/browser/*test*.*js; do
                addJob "${file##*/}" env "${plainEnvironment[@]}" node "$file"
            done
        fi
        endSuite
    fi
}

# Testing leaves no trace in the work tree. Known only where there was none before.
treeIsClean() {
    ! git status --porcelain | grep .
}
suite_clean() {
    [ "$treeBefore" = "" ] || return 0
    beginSuite "The work tree after the tests" clean
    check "git status is clean" treeIsClean
    endSuite
}

treeBefore=$(git status --porcelain 2>/dev/null || echo unknown)
allSuites='style unit cli shell sanitized compilers browser clean'
suites=$allSuites
[ -z "$SANITIZE" ] || suites='unit cli'
suites=${SUITES:-$suites}
for name in $suites; do
    case " $allSuites " in
    *" $name "*) ;;
    *)
        echo "run-tests.sh: there is no suite '$name'; there are: $allSuites." >&2
        exit 2
        ;;
    esac
done
for name in $suites; do
    "suite_$name"
done

if [ $((passed + failed)) = 0 ]; then
    echo "No test ran."
    failed=1
fi
printf '\n%d passed, %d failed' "$passed" "$failed"
[ "$skipped" = 0 ] || printf ', %d skipped' "$skipped"
printf '\n'
[ "$failed" = 0 ]
