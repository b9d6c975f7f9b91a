#!/usr/bin/env bash
# Writes the measured differences into the tables of povray/MAPPING.md, from compare/results.csv; no number there is
# typed by hand.
#
#   tools/update-mapping.sh            rewrite it
#   tools/update-mapping.sh --check    print how it would change; the exit status is 0 if it would not
#
# In a table whose heading has the columns "measured with | 16 bit | 8 bit", each row names scenes, as patterns of
# the shell on the part of the path behind scenes/. Its cells become: pixels that differ of pixels drawn, and the
# largest difference, in 1/65535 or 1/255. A pattern that no scene has is an error, and so is a scene of
# scenes/regress that no row names.
set -euo pipefail
cd "$(dirname "$0")/.."
page=povray/MAPPING.md
rewritten=$(mktemp)
trap 'rm -f "$rewritten"' EXIT

for scene in scenes/*/*.yaml; do
    # Width and height, which say how many pixels there are.
    sed -n "s:^image\: *{.*width\: *\([0-9]*\).*height\: *\([0-9]*\).*:size,$scene,\1,\2:p" "$scene"
done | awk -F, '
function fail(message) { print "update-mapping.sh: " message >"/dev/stderr"; failed = 1 }
# A pattern of the shell with * as a regular expression.
function toExpression(pattern) {
    gsub(/[.+]/, "\\\\&", pattern)
    gsub(/\*/, ".*", pattern)
    return "^" pattern "$"
}
function withCommas(n,    text) {
    text = n ""
    while (match(text, /[0-9][0-9][0-9][0-9]($|,)/))
        text = substr(text, 1, RSTART) "," substr(text, RSTART + 1)
    return text
}
function cell(list, bits,    count, patterns, i, scene, found, pixels, differ, largest, any) {
    count = split(list, patterns, /, */)
    for (i = 1; i <= count; i++) {
        found = 0
        for (scene in measured) {
            if (scene !~ toExpression(patterns[i]))
                continue
            found = named[scene] = 1
            if (!((scene, bits, "differ") in value))
                continue
            any = 1
            pixels += size[scene]
            differ += value[scene, bits, "differ"]
            if (value[scene, bits, "largest"] > largest)
                largest = value[scene, bits, "largest"]
        }
        if (!found)
            fail("no scene is called " patterns[i])
    }
    if (!any)
        return ""
    return withCommas(differ + 0) " of " withCommas(pixels) (differ > 0 ? ", by " withCommas(largest) : "")
}
FILENAME == "-" {
    sub(/^scenes\//, "", $2); sub(/\.yaml$/, "", $2)
    size[$2] = $3 * $4
    next
}
FILENAME ~ /results.csv$/ {
    # "scene","metric, bits",value,...
    split($0, parts, "\"")
    scene = parts[2]; metric = parts[4]
    sub(/^scenes\//, "", scene); sub(/\.yaml$/, "", scene)
    split(parts[5], numbers, ",")
    measured[scene] = 1
    if (!(scene in size))
        size[scene] = 640 * 480
    if (metric ~ /^differing pixels, 16/) value[scene, 16, "differ"] = numbers[2]
    if (metric ~ /^differing pixels, 8/) value[scene, 8, "differ"] = numbers[2]
    if (metric ~ /65535$/ && metric ~ /^largest/) value[scene, 16, "largest"] = numbers[2]
    if (metric ~ /255$/ && metric ~ /^largest/) value[scene, 8, "largest"] = numbers[2]
    next
}
/measured with \| 16 bit \| 8 bit \|$/ { inside = 1; print; next }
!/^\|/ { inside = 0 }
inside && !/^\|-/ {
    n = split($0, cells, "|")
    list = cells[n - 3]
    gsub(/^ +| +$/, "", list)
    line = cells[1]
    for (i = 2; i < n - 2; i++)
        line = line "|" cells[i]
    line = line "| " cell(list, 16) " | " cell(list, 8) " |"
    gsub(/\|  \|/, "| |", line)
    print line
    next
}
{ print }
END {
    for (scene in measured)
        if (scene ~ /^regress\// && !(scene in named))
            fail("no row names " scene)
    exit failed
}' - compare/results.csv $page >"$rewritten"

if [ "${1-}" = --check ]; then
    diff -u "$page" "$rewritten"
else
    cp "$rewritten" "$page"
fi
