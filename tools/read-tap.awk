# Reads what one test program printed in TAP: a plan `1..N`, then a line `ok` or `not ok` for each test.
# Prints a line "PASSED FAILED SKIPPED", then what a reader needs to see of failures and skipped tests.
#
#   awk -v name=PROGRAM -v status=ITS_EXIT_STATUS -f tools/read-tap.awk LOG
#
# Failures are: a `not ok`; a test of the plan that never reported, since the program crashed; a program without
# a plan; and one that ends with an error although its tests passed. A test marked `# SKIP` is neither passed nor
# failed, even as `not ok`, which is how cmocka 1.1.5 writes it. Several plans add up: a program may run several
# groups. Indented lines belong to subtests, whose verdict is in their parent's line.

/^1\.\.[0-9]+/ {
    count = substr($1, 4) + 0
    plan += count
    hasPlan = 1
    if (count == 0 && tolower($0) ~ /# *skip/) {
        skipped++
        show("skipped", $0)
    }
    next
}
/^(not )?ok([ \t]|$)/ {
    seen++
    label = $0
    sub(/^(not )?ok *[0-9]* *-? */, "", label)
    inFailure = 0
    if (tolower($0) ~ /# *skip/) {
        skipped++
        sub(/^# *(SKIP|skip) */, "", label)
        show("skipped", label)
    } else if ($1 == "ok") {
        passed++
    } else {
        failed++
        # What the program printed before its verdict often holds the reason.
        text = text pending
        show("FAILED", label)
        inFailure = 1
    }
    pending = ""
    next
}
{
    if (inFailure)
        text = text "    " $0 "\n"
    else
        pending = pending "    " $0 "\n"
}
function show(verdict, what) {
    text = text "  " verdict ": " name ": " what "\n"
}
END {
    ending = status == 124 || status == 137 ? "it ran into the time limit" : "exit status " status
    if (!hasPlan) {
        failed++
        text = text pending
        show("FAILED", "printed no plan of its tests; " ending)
    } else if (seen < plan) {
        failed += plan - seen
        text = text pending
        show("FAILED", (plan - seen) " of its " plan " tests never reported; " ending)
    } else if (seen > plan) {
        failed++
        show("FAILED", seen " tests reported, but its plan says " plan)
    } else if (status != 0 && !failed) {
        failed++
        text = text pending
        show("FAILED", "no test failed, but " ending)
    }
    printf "%d %d %d\n%s", passed, failed, skipped, text
}
