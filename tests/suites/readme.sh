#!/usr/bin/env bash
# What the README says is run: its scene is valid, its commands do what stands beside them, its mistake is told
# in its very words, its links lead somewhere, its pictures are current. Prints TAP. Run from the repository root.
set -uo pipefail
program=$(realpath "${ECLAIRAGE:-build/eclairage}")
root=$PWD
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
count=0
report() { # LABEL STATUS
    count=$((count + 1))
    [ "$2" = 0 ] && echo "ok $count - $1" || echo "not ok $count - $1"
}

# The lines between the first fence with this word and the next fence, from the N-th such block.
block() { # WORD N
    awk -v word="$1" -v wanted="$2" '
        inside && /^```/ { exit }
        inside { print }
        $0 == "```" word && ++found == wanted { inside = 1 }
        $0 != "```" word && /^```/ && !inside { skip = !skip }' README.md
}

mkdir -p "$folder/build"
ln -s "$program" "$folder/build/eclairage"
block yaml 1 >"$folder/ball.yaml"
cd "$folder" || exit 1
cp ball.yaml one.yaml

build/eclairage check --quiet ball.yaml 2>check.txt
report "the scene is valid, without warnings" $(($? + $(wc -l <check.txt)))

# Each command of the block "Write a scene", as written.
commands=$(cd "$root" && block sh 2 | sed 's/ *#.*//')
build/eclairage render --quiet --width 64 ball.yaml -o one.png && cp one.png other.png
while read -r command; do
    if [[ $command == *compare* || $command == *"explain ball.yaml" ]] && ! command -v povray >/dev/null; then
        count=$((count + 1))
        echo "ok $count - $command # SKIP povray is not installed"
        continue
    fi
    $command </dev/null >out.txt 2>&1
    report "$command" $?
    cat out.txt >>said.txt
done <<<"$commands"
for file in ball.png ball.pov; do
    test -s $file
    report "$file was written" $?
done
if command -v povray >/dev/null; then
    test -s eclairage-report/index.html
    report "eclairage-report/index.html was written" $?
fi

# What explain and why print: each line of the two samples, but for the dots.
for first in 'difference: ' '  Light 1 of '; do
    (cd "$root" && awk -v first="$first" '/^```/ { inside = 0 } index($0, first) == 1 { inside = 1 } inside && NF && $0 != "..."' README.md) >sample.txt
    missing=$(grep -Fxv -f said.txt sample.txt)
    echo "${missing:+# not said: }$missing" | grep . || true
    report "the sample that begins with '$first' is what is said" "$([ -s sample.txt ] && [ -z "$missing" ]; echo $?)"
done

# The mistake, word for word: the third block without a language.
(cd "$root" && awk '/^```$/ && !inside { inside = 1; text = ""; next } /^```/ && inside { inside = 0; if (text ~ /error:/) printf "%s", text; next }
    /^```[a-z]/ { inside = 2; next } inside == 1 { text = text $0 "\n" }' README.md) >expected.txt
sed 's/position: \[-3/postion: [-3/' one.yaml >ball.yaml
build/eclairage check ball.yaml >/dev/null 2>told.txt
diff expected.txt told.txt | sed 's/^/# /'
report "the mistake is told in the README's words" "${PIPESTATUS[0]}"

cd "$root" || exit 1
# Links and pictures.
missing=$(grep -o '](\([^)]*\))' README.md CONTRIBUTING.md | sed 's/.*](\(.*\))/\1/; s/#.*//' | grep -v '^http' |
    sort -u | while read -r target; do [ -z "$target" ] || [ -e "$target" ] || echo "$target"; done)
echo "${missing:+# missing: }$missing" | grep . || true
report "links lead somewhere" "$([ -z "$missing" ]; echo $?)"
"$program" render --quiet scenes/gallery/colonnade.yaml --bit-depth 8 -o "$folder/colonnade.png" &&
    "$program" diff --fail 0.005 --fail-percent 0 "$folder/colonnade.png" notes/pictures/colonnade.png >/dev/null
report "the README's picture is current" $?
echo "1..$count"
