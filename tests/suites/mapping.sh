#!/usr/bin/env bash
# The measured columns of povray/MAPPING.md are those of compare/results.csv, and every regress scene stands in a
# row. Prints TAP. Run from the repository root.
set -uo pipefail
if difference=$(tools/update-mapping.sh --check 2>&1); then
    echo 'ok 1 - povray/MAPPING.md shows compare/results.csv'
else
    echo 'not ok 1 - povray/MAPPING.md shows compare/results.csv; tools/update-mapping.sh rewrites it'
    printf '%s\n' "$difference" | sed 's/^/# /'
fi
echo '1..1'
