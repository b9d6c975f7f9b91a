#!/usr/bin/env bash
# Builds the notes: an offline site in English and French, each page whole in itself, whose pictures and numbers
# come from the commands that stand in its chapters. CONTRIBUTING.md says how a chapter is written.
#
#   notes/make-notes.sh [OUT]            builds OUT (build/notes) and compares its numbers with numbers.csv
#   notes/make-notes.sh --update [OUT]   builds, and writes numbers.csv
#
# Exit code 0: done; 1: the site was made, and its numbers are not those committed; 2: a chapter is wrong or a tool
# is missing: everything wrong was said, and the old site is left as it was.
#
# ECLAIRAGE names the program (build/eclairage), with its library beside it; NOTES the folder of the sources
# (notes); CC the compiler. Commands run in OUT/work/CHAPTER, where all folders of the repository, and build for the
# program's, are linked: what a reader types in the top folder works there.
set -euo pipefail
cd "$(dirname "$0")/.."
tools=$PWD/notes # the filter, the template, the style
NOTES=${NOTES:-notes}
CC=${CC:-cc}
program=$(realpath "${ECLAIRAGE:-build/eclairage}")
update=false
if [ "${1-}" = --update ]; then
    update=true
    shift
fi
site=${1:-build/notes}

fail() { # MESSAGE
    echo "make-notes.sh: $1" >&2
    exit 2
}
for tool in pandoc jq povray base64; do
    command -v $tool >/dev/null || fail "$tool is not installed (tools/install-dependencies.sh notes installs what is missing)"
done
[ -x "$program" ] || fail "there is no program $program; make builds it"
hasFiles() { # true if the pattern that the caller wrote matched something
    [ -e "$1" ]
}
hasFiles "$NOTES"/??/*.md || fail "there is no chapter in $NOTES/en or $NOTES/fr"

mkdir -p "$(dirname "$site")"
out=$(cd "$(dirname "$site")" && pwd)/$(basename "$site").new.$$
work=$out/work
trap 'rm -rf "$out"' EXIT
trap 'exit 130' INT TERM
mkdir -p "$work" "$out/lists" "$out/numbers" "$out/errors" "$out/thumbnails"
unset NO_COLOR CLICOLOR CLICOLOR_FORCE MAKEFLAGS MAKELEVEL MFLAGS
processors=$(nproc 2>/dev/null || echo 2)

# A place where a reader's commands work.
linkFolders() { # FOLDER
    local entry
    mkdir -p "$1"
    for entry in */; do
        entry=${entry%/}
        case $entry in build | notes) ;; *) ln -s "$PWD/$entry" "$1/$entry" ;; esac
    done
    ln -s "$(dirname "$program")" "$1/build"
    ln -s "$(realpath "$NOTES")" "$1/notes"
}

# Says all that is wrong, and ends if anything is.
stopOnErrors() {
    local found=false file
    for file in "$out"/errors/*; do
        [ ! -s "$file" ] || { found=true && cat "$file" >&2; }
    done
    if $found; then
        [ ! -d "$site" ] || echo "The notes are wrong; $site is left as it was." >&2
        exit 2
    fi
}

# Makes the program that stores pictures as pages show them.
pictureFlags=$("${PKG_CONFIG:-pkg-config}" --cflags --libs libpng zlib yaml-0.1)
# shellcheck disable=SC2086 # these are words
$CC -std=c17 -O2 -D_POSIX_C_SOURCE=200809L -Isrc -I. -o "$out/screen-picture" notes/screen_picture.c \
    "$(dirname "$program")/libeclairage.a" $pictureFlags -lm -pthread || fail "notes/screen_picture.c does not compile"

runPandoc() { # MODE FILE LEADS ARGUMENT...
    local mode=$1 file=$2 leads=$3 name language
    shift 3
    name=$(basename "$file" .md)
    language=$(basename "$(dirname "$file")")
    NOTES_MODE=$mode NOTES_FILE=$file NOTES_NAME=$name NOTES_LANGUAGE=$language NOTES_LEADS=$leads NOTES_WORK=$work/$name \
        NOTES_LIST=$out/lists/$language-$name NOTES_PAGES=$out/pages NOTES_COMPARED=$out/compared \
        NOTES_PICTURES=$out/compare NOTES_SCREEN_PICTURE=$out/screen-picture NOTES_NUMBERS=$out/numbers/$name.csv \
        NOTES_ERRORS=$out/errors/$name-$language \
        pandoc --from markdown-implicit_figures --to html5 --lua-filter "$tools/notes.lua" "$@" "$file" 2>"$out/lists/said-$language-$name" ||
        [ -s "$out/errors/$name-$language" ] ||
        sed "s|^|$file: |" "$out/lists/said-$language-$name" >>"$out/errors/$name-$language"
}

# Starts a command in the background once a processor is free.
inBackground() {
    while (($(jobs -pr | wc -l) >= processors)); do
        wait -n || true
    done
    "$@" &
}

# --- What there is: titles, and the scenes that are compared ------------------------------------------------

files=()
for file in "$NOTES"/en/*.md "$NOTES"/fr/*.md; do
    [ -f "$file" ] || continue
    files+=("$file")
    inBackground runPandoc list "$file" no --output /dev/null
done
wait
stopOnErrors
: >"$out/pages"
: >"$out/scenes"
for file in "${files[@]}"; do
    list=$out/lists/$(basename "$(dirname "$file")")-$(basename "$file" .md)
    sed -n 's/^page\t//p' "$list" >>"$out/pages"
    sed -n 's/^compare\t//p' "$list" >>"$out/scenes"
done

# All pairs in one run. A scene that is not there is told by its page.
linkFolders "$work/compare"
: >"$out/compared"
scenes=()
while read -r scene; do
    [ ! -f "$work/compare/$scene" ] || scenes+=("$scene")
done < <(sort -u "$out/scenes")
if [ ${#scenes[@]} -gt 0 ]; then
    code=0
    (cd "$work/compare" && build/eclairage compare --quiet --json --out "$out/compare" "${scenes[@]}") \
        >"$out/compared.json" 2>"$out/compared.err" </dev/null || code=$?
    jq -r '.scenes[] | [.scene, .pass, .max_difference, .rmse, .flip, .identical_pixels, .pixels,
        .files.ours, .files.povray, .files.difference, .error.message] | map(. // "" | tostring) | join("\t")' \
        "$out/compared.json" >"$out/compared" || {
        cat "$out/compared.err" >&2
        fail "\`eclairage compare\` ended with exit code $code and without results"
    }
fi

# The small pictures of the list of chapters.
while IFS=$'\t' read -r language name title summary scene; do
    picture=$out/thumbnails/$name.png
    if [ -n "$scene" ] && [ ! -f "$picture" ]; then
        (cd "$work/compare" && build/eclairage render --quiet --width 320 --bit-depth 8 "$scene" -o "$picture" 2>/dev/null) || true
    fi
    printf '%s\t%s\t%s\t%s\t%s\t%s\n' "$language" "$name" "$title" "$summary" "$scene" "$picture"
done <"$out/pages" >"$out/pages.whole"
mv "$out/pages.whole" "$out/pages"

# --- The pages ----------------------------------------------------------------------------------------------

{
    echo '<style>'
    cat "$tools/notes.css"
    echo '</style>'
    # Before anything is drawn: a chosen theme must not flash.
    echo "<script>document.documentElement.classList.add('js');"
    echo "try { const theme = localStorage.getItem('eclairage-theme'); if (theme) document.documentElement.dataset.theme = theme; } catch { /* no storage */ }</script>"
} >"$out/head.html"
{
    echo '<script>'
    cat "$tools/notes.js"
    echo '</script>'
} >"$out/foot.html"

# One chapter in its languages, the second after the first: it shows what the first one's commands made.
makeChapter() { # NAME
    local language leads=yes contents
    linkFolders "$work/$1"
    for language in en fr; do
        [ -f "$NOTES/$language/$1.md" ] || continue
        mkdir -p "$out/$language"
        contents=(--toc --toc-depth 2)
        [ "$1" != index ] || contents=()
        runPandoc page "$NOTES/$language/$1.md" $leads --standalone --wrap none --mathml ${contents[@]+"${contents[@]}"} --template "$tools/template.html" \
            --include-in-header "$out/head.html" --include-after-body "$out/foot.html" --output "$out/$language/$1.html"
        # A sign is not a difference: pandoc marks no minus as a prefix, and browsers put spaces on both its sides.
        [ ! -f "$out/$language/$1.html" ] ||
            sed -i -E 's/(<mo[^>]*form="prefix"[^>]*>[^<]*<\/mo>|<mo>[=,<]<\/mo>)<mo>−<\/mo>/\1<mo form="prefix">−<\/mo>/g' "$out/$language/$1.html"
        leads=no
    done
}
while read -r name; do
    inBackground makeChapter "$name"
done < <(for file in "${files[@]}"; do basename "$file" .md; done | sort -u)
wait
stopOnErrors

# --- The choice of a language, and the numbers ---------------------------------------------------------------

{
    cat <<END
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>Éclairage</title>
<link rel="icon" href="data:,">
END
    cat "$out/head.html"
    cat <<END
</head>
<body><main class="choice">
<svg viewBox="0 0 32 32" width="72" height="72" aria-hidden="true"><circle class="brand-lit" cx="16" cy="16" r="14"/><path class="brand-shade" d="M16 2a14 14 0 0 1 0 28z"/></svg>
<h1>Éclairage</h1>
<nav aria-label="Language · Langue">
END
    [ ! -d "$out/en" ] || echo '<a href="en/index.html" lang="en" hreflang="en"><b>English</b><span class="soft">The notes</span></a>'
    [ ! -d "$out/fr" ] || echo '<a href="fr/index.html" lang="fr" hreflang="fr"><b>Français</b><span class="soft">Les notes de cours</span></a>'
    echo '</nav></main></body></html>'
} >"$out/index.html"
{
    echo 'chapter,directive,command,path,value'
    cat "$out"/numbers/*.csv
} >"$out/numbers.csv"

# Only the site, its pictures and what commands made are of use to anyone.
rm -rf "$out/lists" "$out/errors" "$out/numbers" "$out/thumbnails" "$out/screen-picture" "$out/pages" "$out/scenes" "$out/compared" \
    "$out/compared.json" "$out/compared.err" "$out/head.html" "$out/foot.html"
rm -rf "$site"
mv "$out" "$site"

if $update; then
    cp "$site/numbers.csv" "$NOTES/numbers.csv"
elif [ ! -f "$NOTES/numbers.csv" ]; then
    echo "There is no $NOTES/numbers.csv; make update-notes writes it." >&2
    exit 1
elif ! cmp -s "$NOTES/numbers.csv" "$site/numbers.csv"; then
    echo "The numbers in the pages are not those of $NOTES/numbers.csv (make update-notes writes it):" >&2
    diff --unchanged-line-format= --old-line-format='  committed: %L' --new-line-format='  now:       %L' \
        "$NOTES/numbers.csv" "$site/numbers.csv" >&2 || true
    exit 1
fi
