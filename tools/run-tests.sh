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
# CC and MAKE, and ECLAIRAGE_SANITIZED=1 where the program is slower and hungrier than a user's. NOTES_SITE is where
# the first test that needs the notes makes them for the others.

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
jobLimit=$((processors + 1)) # one more, since jobs wait for POV-Ray, for Chromium and for the disk
timeLimit=300 # seconds for one test program
logs=$BUILD/test-logs
rm -rf "$logs"
mkdir -p "$logs"
logs=$(realpath "$logs")

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

# --- A suite: builds and checks, done at once, and jobs that wait for their turn ---------------------------

declare -A titles suitePassed suiteFailed suiteSkipped jobNames
begun=()
beginSuite() { # TITLE FOLDER
    suite=$logs/$2
    mkdir -p "$suite"
    begun+=("$suite")
    titles[$suite]=$1
    suitePassed[$suite]=0
    suiteFailed[$suite]=0
    suiteSkipped[$suite]=0
    jobNames[$suite]=
    : >"$suite/said"
}

# A line that is printed with the suite's result.
say() { # TEXT
    printf '  %s\n' "$1" >>"$suite/said"
}

skipSuite() { # TITLE FOLDER REASON
    beginSuite "$1" "$2"
    suiteSkipped[$suite]=1
    say "skipped: $3"
}

# A TAP program that is run later. Its output, exit status and seconds go to files named after it.
queue=()
addJob() { # NAME COMMAND...
    jobNames[$suite]+=" $1"
    queue+=("$(printf '%q ' "$suite/$1" "${@:2}")")
}

# One test inside the current suite: a command that says what is wrong and exits with an error, or 77 to skip.
check() { # LABEL COMMAND...
    local label=$1 log=$suite/check.log status
    shift
    "$@" </dev/null >"$log" 2>&1
    status=$?
    case $status in
    0)
        suitePassed[$suite]=$((suitePassed[$suite] + 1))
        ;;
    77)
        suiteSkipped[$suite]=$((suiteSkipped[$suite] + 1))
        say "skipped: $label: $(cat "$log")"
        ;;
    *)
        suiteFailed[$suite]=$((suiteFailed[$suite] + 1))
        sed 's/^/    /' "$log" >>"$suite/said"
        say "FAILED: $label (exit status $status)"
        ;;
    esac
    return $status
}

# Builds targets with make; a failure is printed and counted as a failed test of the current suite.
build() { # FOLDER TARGET... [VARIABLE=VALUE...]
    local folder=$1 log=$suite/build.log
    shift
    if ! "$MAKE" --no-print-directory -k -j"$jobLimit" BUILD="$folder" "$@" </dev/null >"$log" 2>&1; then
        suiteFailed[$suite]=$((suiteFailed[$suite] + 1))
        grep -v '^  [A-Z]* ' "$log" | sed 's/^/    /' >>"$suite/said"
        say "FAILED: the build in $folder"
        return 1
    fi
}

# Builds targets of the tested program. Where there was nothing before, what the compiler says is kept: all of it.
[ -d "$BUILD/obj" ] || : >"$logs/whole-build"
buildTested() { # TARGET...
    local status=0
    build "$BUILD" "$@" SANITIZE="$SANITIZE" || status=$?
    [ ! -f "$logs/whole-build" ] || cat "$suite/build.log" >>"$logs/whole-build"
    return $status
}

absolute() {
    case $1 in /*) echo "$1" ;; *) echo "$PWD/$1" ;; esac
}

# --- Running: the jobs of all suites side by side, each suite told once its last job is done ----------------

startJob() { # FILES COMMAND...
    local files=$1
    shift
    (
        start=$SECONDS
        timeout --kill-after=10 "$timeLimit" "$@" </dev/null >"$files.log" 2>&1 &
        program=$!
        trap 'kill "$program"' TERM
        wait "$program"
        status=$?
        { echo "$((SECONDS - start)) s" && times; } >"$files.seconds"
        echo "$status" >"$files.status"
    ) &
}

runJobs() {
    local job words
    for job in ${queue[@]+"${queue[@]}"}; do
        while (($(jobs -pr | wc -l) >= jobLimit)); do
            wait -n
            tellSuites
        done
        eval "words=($job)"
        startJob "${words[@]}"
    done
    while [ "$(jobs -pr)" != "" ]; do
        wait -n
        tellSuites
    done
    tellSuites
}

# Prints the suites that are done and were not told yet.
tellSuites() {
    local name waiting=()
    for suite in ${begun[@]+"${begun[@]}"}; do
        for name in ${jobNames[$suite]}; do
            [ -f "$suite/$name.status" ] && continue
            waiting+=("$suite")
            continue 2
        done
        tellSuite
    done
    begun=(${waiting[@]+"${waiting[@]}"})
}

tellSuite() {
    local name status counts report
    for name in ${jobNames[$suite]}; do
        status=$(cat "$suite/$name.status")
        {
            read -r -a counts
            cat >>"$suite/said"
        } < <(awk -v name="$name" -v status="$status" -f tools/read-tap.awk "$suite/$name.log")
        suitePassed[$suite]=$((suitePassed[$suite] + counts[0]))
        suiteFailed[$suite]=$((suiteFailed[$suite] + counts[1]))
        suiteSkipped[$suite]=$((suiteSkipped[$suite] + counts[2]))
    done
    # A sanitizer's report fails the suite even if the test swallowed the program's output.
    for report in "$suite"/sanitizer.*; do
        [ -f "$report" ] || continue
        suiteFailed[$suite]=$((suiteFailed[$suite] + 1))
        say "FAILED: a sanitizer reported:"
        sed 's/^/    /' "$report" >>"$suite/said"
    done
    printf '\n== %s\n' "${titles[$suite]}"
    cat "$suite/said"
    printf '   %d passed, %d failed' "${suitePassed[$suite]}" "${suiteFailed[$suite]}"
    [ "${suiteSkipped[$suite]}" = 0 ] || printf ', %d skipped' "${suiteSkipped[$suite]}"
    printf '\n'
    passed=$((passed + suitePassed[$suite]))
    failed=$((failed + suiteFailed[$suite]))
    skipped=$((skipped + suiteSkipped[$suite]))
}

# --- The suites -------------------------------------------------------------------------------------------

# What the sanitizers are told. Leaks count. A report goes to a file, or with gcc's undefined-behaviour library to
# standard error, and ends the program with 99, which no command uses: a test cannot take it for what it expects.
# Memory that cannot be had gives NULL, as it does without a sanitizer.
sanitizedFolder=$BUILD
[ -n "$SANITIZE" ] || sanitizedFolder=$BUILD/address-undefined
setEnvironment() { # FOLDER; sets `environment` for the current suite's jobs
    environment=("ECLAIRAGE=$(absolute "$1")/eclairage")
    [ "$1" != "$sanitizedFolder" ] || environment+=(
        "ECLAIRAGE_SANITIZED=1"
        "ASAN_OPTIONS=detect_leaks=1:allocator_may_return_null=1:exitcode=99:log_path=$suite/sanitizer:${ASAN_OPTIONS-}"
        "UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1:exitcode=99:log_path=$suite/sanitizer:${UBSAN_OPTIONS-}"
    )
}

hasFiles() { # true if the pattern that the caller wrote matched something
    [ -e "$1" ]
}

unitTests() { # FOLDER
    local program
    setEnvironment "$1"
    for program in tests/unit/test_*.c; do
        program=${program##*/}
        program=$1/tests/${program%.c}
        # A program that did not build was counted by build.
        [ ! -x "$program" ] || addJob "${program##*/}" env "${environment[@]}" CMOCKA_MESSAGE_OUTPUT=TAP "$program"
    done
}

commandLineTests() { # FOLDER
    local file
    setEnvironment "$1"
    for file in tests/cli/*.bats; do
        addJob "${file##*/}" env "${environment[@]}" bats --tap "$file"
    done
}

suite_unit() {
    hasFiles tests/unit/test_*.c || return 0
    beginSuite "Unit tests" unit
    buildTested all unit
    unitTests "$BUILD"
}

suite_cli() {
    hasFiles tests/cli/*.bats || return 0
    beginSuite "The command line" cli
    buildTested all && commandLineTests "$BUILD"
}

# Everything once more, the program too, with the address and undefined-behaviour sanitizers.
suite_sanitized() {
    hasFiles tests/unit/test_*.c || return 0
    beginSuite "Unit tests and the command line under AddressSanitizer and UndefinedBehaviorSanitizer" sanitized
    build "$sanitizedFolder" all unit SANITIZE=address,undefined
    if hasFiles tests/cli/*.bats && [ -x "$sanitizedFolder/eclairage" ]; then
        commandLineTests "$sanitizedFolder"
    fi
    unitTests "$sanitizedFolder"
}

# A real build and not only a look at the syntax: some warnings need the optimiser. Then the pictures of the
# compilers and of the sanitized program are the same to the byte.
suite_compilers() {
    local compiler folder programs=()
    beginSuite "gcc and clang: warnings are errors, and the pictures are the same" compilers
    for compiler in gcc clang; do
        folder=$BUILD/$compiler
        if ! command -v $compiler >/dev/null; then
            say "skipped: $compiler is not installed"
            suiteSkipped[$suite]=$((suiteSkipped[$suite] + 1))
        elif [ -f "$logs/whole-build" ] && [ "$(compilerName "$CC")" = "$(compilerName $compiler)" ]; then
            folder=$BUILD
            buildTested all unit property && check "no warning of $compiler" noWarning
        elif build "$folder" all unit property CC=$compiler WERROR=1; then
            suitePassed[$suite]=$((suitePassed[$suite] + 1))
        fi
        programs+=("$folder/eclairage")
    done
    addJob same-pictures.sh tools/same-pictures.sh "${programs[@]}" "$sanitizedFolder/eclairage"
}
compilerName() { # COMPILER
    "$1" --version 2>/dev/null | head -n 1 | sed 's/^[^ ]* //'
}
# Where this run built the tested program from nothing, another build by the same compiler would say the same.
noWarning() {
    ! grep -A 3 'warning:' "$logs/whole-build"
}

suite_style() {
    beginSuite "Layout of the code, and who includes whom" style
    check "clang-format" tools/check-format.sh
    check "include arrows" tools/check-includes.sh
}

# Every executable tests/suites/*.sh is a suite: it runs from the top folder, prints TAP and cleans up.
suite_shell() {
    local script
    hasFiles tests/suites/*.sh || return 0
    beginSuite "Whole-program suites (tests/suites)" shell
    setEnvironment "$BUILD"
    if buildTested all property; then
        for script in tests/suites/*.sh; do
            addJob "${script##*/}" env "${environment[@]}" NOTES_SITE="$logs/notes" "$script"
        done
    fi
}

suite_browser() {
    local file title="The report and the notes in a browser"
    hasFiles tests/browser/*test*.*js || return 0
    if ! command -v node >/dev/null; then
        skipSuite "$title" browser "node is not installed (make setup installs it)"
    elif [ ! -d tests/browser/node_modules/playwright-core ]; then
        skipSuite "$title" browser "playwright-core is not installed (make setup installs it)"
    elif ! command -v chromium >/dev/null && ! command -v chromium-browser >/dev/null &&
        ! command -v google-chrome >/dev/null; then
        skipSuite "$title" browser "chromium is not installed (make setup installs it)"
    else
        beginSuite "$title" browser
        setEnvironment "$BUILD"
        if buildTested all; then
            for file in tests/browser/*test*.*js; do
                addJob "${file##*/}" env "${environment[@]}" NOTES_SITE="$logs/notes" node "$file"
            done
        fi
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
    tellSuites
}

# In this order the jobs start: the long ones first, so that at the end no processor waits for one.
treeBefore=$(git status --porcelain 2>/dev/null || echo unknown)
allSuites='style shell sanitized compilers browser cli unit'
suites=$allSuites
[ -z "$SANITIZE" ] || suites='cli unit'
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
runJobs
suite_clean

if [ $((passed + failed)) = 0 ]; then
    echo "No test ran."
    failed=1
fi
printf '\nHow long each took: %s/*/*.seconds\n' "${logs#"$PWD/"}"
printf '%d passed, %d failed' "$passed" "$failed"
[ "$skipped" = 0 ] || printf ', %d skipped' "$skipped"
printf '\n'
[ "$failed" = 0 ]
