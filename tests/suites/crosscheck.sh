#!/usr/bin/env bash
# Every course, gallery and regress scene against the real POV-Ray: within the tolerances of compare/results.csv,
# and with the very numbers committed there. Prints TAP. Run from the repository root after `make`.
set -uo pipefail
for tool in povray jq; do
    if ! command -v "$tool" >/dev/null; then
        echo "1..0 # SKIP $tool is not installed"
        exit 0
    fi
done
measured=$(mktemp)
trap 'rm -f "$measured"' EXIT
if ! tools/measure-scenes.sh >"$measured"; then
    echo 'Bail out! the scenes could not be measured'
    exit 1
fi

# Each measured row against its tolerance.
awk '
# The fields of one CSV line; a comma inside quotes does not end one.
function split_csv(line, fields,    n, inside, i, c) {
    n = 1; inside = 0; fields[1] = ""
    for (i = 1; i <= length(line); i++) {
        c = substr(line, i, 1)
        if (c == "\"") inside = !inside
        else if (c == "," && !inside) fields[++n] = ""
        else fields[n] = fields[n] c
    }
    return n
}
NR > 1 {
    split_csv($0, field)
    ok = field[3] + 0 <= field[4] + 0
    printf "%sok %d - %s: %s: %s, at most %s\n", ok ? "" : "not ", ++count, field[1], field[2], field[3], field[4]
}
' "$measured"
rows=$(($(wc -l <"$measured") - 1))

# The numbers in git are these.
if difference=$(diff -u compare/results.csv "$measured"); then
    echo "ok $((rows + 1)) - compare/results.csv is what was measured"
else
    echo "not ok $((rows + 1)) - compare/results.csv is what was measured; make update-results rewrites it"
    echo "${difference//$'\n'/$'\n'# }" | sed '1s/^/# /'
fi
echo "1..$((rows + 1))"
