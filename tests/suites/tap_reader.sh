#!/bin/sh
# The counting of tests is itself tested: every way to fail must be counted as a failure.
# Each row: what a program printed (| for a new line), its exit status, and "PASSED FAILED SKIPPED" expected.

set -u
number=0
failures=0
row() { # LABEL OUTPUT STATUS COUNTS
    number=$((number + 1))
    counts=$(printf '%s' "$2" | tr '|' '\n' | awk -v name=x -v status="$3" -f tools/read-tap.awk | head -n 1)
    if [ "$counts" = "$4" ]; then
        echo "ok $number - $1"
    else
        echo "not ok $number - $1"
        echo "# expected '$4', got '$counts'"
        failures=$((failures + 1))
    fi
}
echo 1..14
row "all pass" '1..2|ok 1 - a|ok 2 - b' 0 "2 0 0"
row "a failure" '1..2|ok 1 - a|not ok 2 - b|# why' 1 "1 1 0"
row "a failure of a program that exits with 0" '1..2|ok 1 - a|not ok 2 - b' 0 "1 1 0"
row "a crash after the first of three tests" '1..3|ok 1 - a' 139 "1 2 0"
row "an early exit with status 0" '1..3|ok 1 - a' 0 "1 2 0"
row "an error at the end, such as a leak" '1..1|ok 1 - a' 99 "1 1 0"
row "no plan" 'ok 1 - a' 0 "1 1 0"
row "no output" '' 0 "0 1 0"
row "time limit" '1..2|ok 1 - a' 124 "1 1 0"
row "more tests than planned" '1..1|ok 1 - a|ok 2 - b' 0 "2 1 0"
row "skipped tests, as bats and as cmocka write them" '1..2|ok 1 a # skip why|not ok 2 # SKIP b' 0 "0 0 2"
row "a skipped program" '1..0 # SKIP no chromium' 0 "0 0 1"
row "two groups in one program" '1..1|ok 1 - a|1..2|ok 1 - b|not ok 2 - c' 1 "2 1 0"
row "subtests are not counted twice" '1..1|    1..1|    not ok 1 - inner|not ok 1 - a' 1 "0 1 0"
[ "$failures" = 0 ]
