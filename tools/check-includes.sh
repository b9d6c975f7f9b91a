#!/bin/sh
# Checks who includes whom. The table below is the architecture of the program: a part may include itself, the
# parts on its line, and whatever lies below those. Everything else is a violation, and so is a folder that
# the table does not know. Nothing is listed twice: "below" is worked out from the table.
#
# A part is a folder (src/shapes, compare, ...) or one of the files the course handout names directly in src/.
# Note what the table rules out: compare reaches neither raytracer nor scene, so the judge of two pictures
# cannot know the scene they were made from.

set -u
cd "$(dirname "$0")/.." || exit 1

table='
base:
power:
geometry:   base
colors:     base
patterns:   geometry colors
shading:    patterns power
shapes:     shading
raytracer:  shapes
camera:     raytracer
lights:     raytracer
scene_objects: raytracer
image:      colors
scene:      raytracer image
engine:     raytracer
povray:     raytracer image
compare:    image
explain:    scene engine povray compare
cli:        explain
main:       cli
'

# Headers from outside that only one part may include, so that the dependency stays in one place.
libraries='
yaml.h:     scene
png.h:      image
zlib.h:     image
'

# Code outside these folders (tests, bench, notes) may include anything.
outside='build tests bench notes tools man completions scenes'

# Newcomers must read the same table.
copy=$(awk '/^    base:/, /^    main:/ { sub(/^    /, ""); print }' CONTRIBUTING.md)
if [ "$(echo "$table" | sed '/^$/d')" != "$copy" ]; then
    echo "CONTRIBUTING.md: its table of who may include whom is not the one in tools/check-includes.sh."
    exit 1
fi

# Collect every C file in the folders that are the program.
prune=
for folder in $outside; do
    prune="$prune -path ./$folder -o"
done
# shellcheck disable=SC2086 # the words of $prune are options
find . \( $prune -name '.?*' \) -prune -o -name '*.[ch]' -type f -print | sed 's|^\./||' | LC_ALL=C sort |
    awk -v table="$table" -v libraries="$libraries" '
# The part that a file belongs to: its folder, or in src/ itself its name.
function partOf(file,    words, count) {
    sub(/^src\//, "", file)
    count = split(file, words, "/")
    if (count == 1)
        sub(/\.[ch]$/, "", words[1])
    return words[1]
}
# Marks part and everything below it as reachable from top.
function reach(top, part,    next_, count, i) {
    if ((top, part) in reachable)
        return
    reachable[top, part] = 1
    count = split(direct[part], next_, " ")
    for (i = 1; i <= count; i++)
        reach(top, next_[i])
}
function complain(text) {
    print text
    violations++
}
# Looks for an included file as the compiler does: beside the includer, then with -Isrc, then with -I. .
function resolve(file, name,    folder) {
    folder = file
    sub(/[^\/]*$/, "", folder)
    if ((folder name) in known)
        return folder name
    if (("src/" name) in known)
        return "src/" name
    return name in known ? name : ""
}
BEGIN {
    count = split(table, lines, "\n")
    for (i = 1; i <= count; i++)
        if (split(lines[i], sides, ":") == 2)
            direct[sides[1]] = sides[2]
    for (part in direct) {
        words = split(direct[part], below, " ")
        for (i = 1; i <= words; i++) {
            if (!(below[i] in direct))
                complain("tools/check-includes.sh: the table has no line for " below[i] ".")
            reach(part, below[i])
        }
        if ((part, part) in reachable)
            complain("tools/check-includes.sh: in the table, " part " lies below itself.")
    }
    count = split(libraries, lines, "\n")
    for (i = 1; i <= count; i++)
        if (split(lines[i], sides, ":") == 2) {
            gsub(/ /, "", sides[2])
            owner[sides[1]] = sides[2]
        }
}
{
    files[++fileCount] = $0
    known[$0] = 1
}
END {
    for (i = 1; i <= fileCount; i++) {
        file = files[i]
        part = partOf(file)
        if (!(part in direct)) {
            complain(file ": the table in tools/check-includes.sh has no line for " part ".")
            continue
        }
        lineNumber = 0
        while ((getline line < file) > 0) {
            lineNumber++
            if (line !~ /^[ \t]*#[ \t]*include[ \t]*["<]/)
                continue
            place = file ":" lineNumber ": "
            name = line
            sub(/^[^"<]*["<]/, "", name)
            sub(/[">].*$/, "", name)
            target = resolve(file, name)
            if (target != "") {
                includes++
                targetPart = partOf(target)
                if (targetPart != part && !((part, targetPart) in reachable))
                    complain(place part " must not include " targetPart " (" name ").")
            } else if (line ~ /"/)
                complain(place "there is no file " name "; write its path from src/ or from the top folder.")
            else if (name in owner && owner[name] != part)
                complain(place "only " owner[name] " may include " name ".")
        }
        close(file)
    }
    if (fileCount == 0 || includes == 0)
        complain("tools/check-includes.sh: found no code to check.")
    if (violations)
        exit 1
    printf "%d files, %d includes: all of them allowed.\n", fileCount, includes
}'
