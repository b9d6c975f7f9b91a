#!/usr/bin/env bash
# The notes are made anew with the tested program: their numbers are the committed ones, the languages show the
# same, every page is whole in itself, every link leads somewhere; and what is wrong in a chapter is told and stops
# the build. Prints TAP. Run from the repository root. The site stays where NOTES_SITE says.
set -uo pipefail
for tool in pandoc jq povray; do
    command -v $tool >/dev/null || {
        echo "1..0 # SKIP $tool is not installed (make setup installs it)"
        exit 0
    }
done
if [ -n "${ECLAIRAGE_SANITIZED-}" ]; then
    echo '1..0 # SKIP the notes show what the program without sanitizers does'
    exit 0
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
site=${NOTES_SITE:-$folder/site}
count=0
report() { # LABEL; standard input says what is wrong, or nothing
    local said
    said=$(cat)
    count=$((count + 1))
    if [ -z "$said" ]; then
        echo "ok $count - $1"
    else
        echo "not ok $count - $1"
        printf '%s\n' "$said" | sed 's/^/# /'
    fi
}
# The last command of a pipe runs in this shell, so that report can count.
shopt -s lastpipe

# --- The notes as they are ----------------------------------------------------------------------------------

hasFiles() { # true if the pattern that the caller wrote matched something
    [ -e "$1" ]
}
checkSite() {
    local pages page language file target
    pages=("$site"/index.html "$site"/en/*.html)
    [ ! -d "$site/fr" ] || pages+=("$site"/fr/*.html)
    # Every picture, chart, listing and formula, in order; the build itself holds the directives against each other.
    # Drawings have words in them, in the language of the page.
    if [ -d notes/fr ]; then
        for page in "$site"/en/*.html "$site"/fr/*.html; do
            [ -f "$site/en/${page##*/}" ] && [ -f "$site/fr/${page##*/}" ] || echo "${page##*/} is in one language only"
            for language in en fr; do
                grep -oE '<(figure|table|math|section|details) [^>]*class="[a-z ]*"|<div class="(listing|run)|data:image/[^"]*' \
                    "$site/$language/${page##*/}" 2>&1 | sed -e 's/aria-label="[^"]*"//' -e 's/svg+xml.*/svg+xml/' | while read -r line; do echo "$line" | cksum; done >"$folder/$language"
            done
            cmp -s "$folder/en" "$folder/fr" || echo "${page##*/}"
        done | report "each page has a French one with the same figures"
    fi
    grep -noE '<(link|script|img|iframe|source|video|audio|object|embed)[^>]*(src|href)="?(https?:)?//[^">]*' "${pages[@]}" |
        cut -c1-200 | report "no page loads anything from outside"
    grep -oE '<(link|script|img)[^>]*(src|href)="[^"]{1,60}' "${pages[@]}" | grep -v '="data:' |
        report "no page needs a file beside it"
    # The small pictures in the list of chapters only adorn: their alt is empty.
    grep -oE '<img [^>]{0,100}' "${pages[@]}" | grep -v -e '<img alt="[^"]' -e '/index.html:<img alt=""' |
        report "every picture has an alternative text"
    # French has its spaces: before : a no-break one, before ; ! ? % a narrow one, inside guillemets one that does not
    # break. Commands, formulas and code are another language; so are the titles in English of the sources.
    for file in notes/fr/*.md; do
        [ -f "$file" ] || continue
        # Backquotes and dollars are Markdown's.
        # shellcheck disable=SC2016
        awk '/^```/ { inside = !inside } !inside && !/^- [A-Z]/ && !/^:::/ && !/^title:|^summary:/' "$file" |
            sed -E 's/`[^`]*`//g; s/\{\.[^}]*\}//g; s/\$\$?[^$]*\$\$?//g; s/\]\([^)]*\)//g' |
            grep -nE "[ [:alnum:]][;!?%»]|[ [:alnum:]]:( |$)|« |[[:alpha:]]'[[:alpha:]]" | sed "s|^|$file: |"
    done | report "French texts have the spaces and apostrophes of French"
    for page in "${pages[@]}"; do
        sed 's/src="data:[^"]*"//g' "$page" | grep -oE '\bhref="[^"]*"' | sed 's/^href="//; s/"$//' | sort -u | while read -r target; do
            case $target in https://* | http://* | data:,) continue ;; esac
            file=$page
            [ "${target%%#*}" = "" ] || file=$(dirname "$page")/${target%%#*}
            if [ ! -f "$file" ]; then
                echo "${page#"$site/"}: $target"
            elif [[ $target == *'#'* ]] && ! grep -qF "id=\"${target#*#}\"" "$file"; then
                echo "${page#"$site/"}: $target: there is no such section"
            fi
        done
    done | report "every link inside the notes leads somewhere"
}

if hasFiles notes/??/*.md; then
    code=0
    said=$(notes/make-notes.sh "$site" 2>&1) || code=$?
    # 1: the pages were made, but a number is another, which is a test of its own.
    { ((code <= 1)) || echo "$said"; } | report "the notes can be made"
    if ((code <= 1)); then
        { ((code == 0)) || echo "$said"; } | report "no number is stale: notes/numbers.csv is what the pages show"
        checkSite
    fi
else
    count=$((count + 1))
    echo "ok $count - the notes can be made # SKIP there are no chapters yet"
fi

# --- Wrong chapters: one line of Markdown, and what must be said of it --------------------------------------

# A good chapter, so that a bad one is seen to leave the old site.
mkdir -p "$folder/good/en" "$folder/bad/en"
chapter() { # FOLDER NAME; the text is on standard input
    { printf -- '---\ntitle: T\nsummary: S\n---\n\n' && cat; } >"$folder/$1/$2.md"
}
# The commands' own output is here all that makes numbers.
echo 'Text.' | chapter good en/index
chapter good en/01-one <<'END'
```{.sh .run .output exit="1"}
echo '{"a": {"b": 1234.5678}, "share": 0.25, "none": null}' >a.json
echo 'there is 1 line'; false
```

[x]{.value json="cat a.json" get=".a.b" digits="5"} [x]{.value json="cat a.json" get=".share" as="percent"}
[x]{.value json="cat a.json" get=".a.b" volatile="true"} [x]{.value json="date +%s" get="." volatile="true"}
END
mkdir -p "$folder/good/fr"
sed 's/^title: T/title: U/' "$folder/good/en/01-one.md" >"$folder/good/fr/01-one.md"
cp "$folder/good/en/index.md" "$folder/good/fr/"
NOTES=$folder/good notes/make-notes.sh --update "$folder/out" 2>&1 | report "chapters in a folder of their own"
diff - "$folder/good/numbers.csv" <<'END' | report "numbers.csv holds what the pages show, but not what is volatile"
chapter,directive,command,path,value
01-one,output,echo 'there is 1 line'; false,1,there is 1 line
01-one,value,cat a.json,.a.b,1234.6
01-one,value,cat a.json,.share,25%
END
grep -o '<span class="value"[^>]*>[^ ]*</span>' "$folder/out/fr/01-one.html" | sed 's/ title="[^"]*"//' | head -n 2 | diff - <(printf '<span class="value">%s</span>\n' '1234,6' $'25\u202f%') |
    report "French numbers have a comma"
sed -i 's/1234.6/1234.7/' "$folder/good/numbers.csv"
said=$(NOTES=$folder/good notes/make-notes.sh "$folder/out" 2>&1)
code=$?
{ { [ $code = 1 ] && [[ $said == *'committed: 01-one,value,cat a.json,.a.b,1234.7'*'now:       01-one,value,cat a.json,.a.b,1234.6'* ]]; } ||
    echo "exit code $code: $said"; } | report "a stale number is told"
echo 'Text.' | chapter bad en/index
number=0
expected=()
wrong() { # WHAT MUST BE SAID; the text is on standard input
    number=$((number + 1))
    chapter bad "en/$(printf '%02d' $number)-bad"
    expected+=("$1")
}
wrong "the function 'nothing' is not in src/shading.c" <<<'::: {.code file="src/shading.c" function="nothing"}
:::'
wrong 'there is no file src/nothing.c' <<<'::: {.code file="src/nothing.c" function="dot"}
:::'
wrong 'from="no such line" is not in src/shading.c' <<<'::: {.code file="src/shading.c" from="no such line" to="return"}
:::'
wrong 'from="return" stands in src/shading.c more than once' <<<'::: {.code file="src/shading.c" from="return" to="#include"}
:::'
wrong 'there is no scene notes/scenes/nothing.yaml' <<<'::: {.pair scene="notes/scenes/nothing.yaml" alt="a ball"}
:::'
wrong 'the scene scenes/bad/tab-indentation.yaml could not be compared' <<<'::: {.pair scene="scenes/bad/tab-indentation.yaml" alt="a ball"}
:::'
wrong 'the directive .pair needs alt="..."' <<<'::: {.pair scene="scenes/course/03a-lambert.yaml"}
:::'
wrong 'there is no scene scenes/nothing.yaml' <<<'::: {.scene file="scenes/nothing.yaml"}
:::'
wrong '.b gives null in the JSON of' <<<'[x]{.value json="echo {}" get=".b"}'
wrong 'ended with exit code 127' <<<'[x]{.value json="no-such-program" get=".b"}'
# Backquotes are what is said, not commands.
# shellcheck disable=SC2016
{
wrong 'jq cannot take .a from what `echo words` printed' <<<'[x]{.value json="echo words" get=".a"}'
wrong 'the command `build/eclairage check` ended with exit code 2, not 0' <<<'```{.sh .run}
build/eclairage check
```'
wrong 'the command `true` ended with exit code 0, not 1' <<<'```{.sh .run exit="1"}
true
```'
wrong 'the command `false` ended with exit code 1, not 0' <<<'```{.sh .run exit="1"}
false
false
```'
}
wrong 'there is no picture nothing.png' <<<'::: {.picture file="nothing.png" alt="nothing"}
:::'
wrong 'there is no file nothing.csv' <<<'::: {.table csv="nothing.csv"}
:::'
wrong 'a.csv has no column "z"' <<<'```{.sh .run}
printf "x,y\n1,2\n2,3\n" >a.csv
```

::: {.plot csv="a.csv" x="x" y="z" alt="a line"}
:::'
wrong 'there is no directive .piar' <<<'::: {.piar}
:::'
wrong 'the directive .value has no attribute "digit"' <<<'[x]{.value json="echo 1" get="." digit="3"}'
wrong 'exercise 20.1 has 0 answers' <<<'::: {.exercise}
Why?
:::'
wrong 'the link to 99-nothing.md leads nowhere' <<<'[there](99-nothing.md)'
sum=$(cat "$folder/out"/*/*.html | cksum)
said=$(NOTES=$folder/bad notes/make-notes.sh "$folder/out" 2>&1)
code=$?
{ [ $code = 2 ] || echo "the exit code is $code"; } | report "wrong chapters stop the build"
{ [ "$(cat "$folder/out"/*/*.html | cksum)" = "$sum" ] || echo "it is another"; } | report "a build that fails leaves the old site"
for ((i = 1; i <= number; i++)); do
    file=$folder/bad/en/$(printf '%02d' $i)-bad.md
    { grep -F "$file: " <<<"$said" | grep -qF -- "${expected[i - 1]}" || grep -F -A 3 "$file: " <<<"$said" || echo "nothing is said"; } |
        report "told: ${expected[i - 1]}"
done

# The languages must hold the same directives, values in any order.
echo '[x]{.value json="cat a.json" get=".a.b" digits="5"}' | chapter good fr/01-one
said=$(NOTES=$folder/good notes/make-notes.sh "$folder/out" 2>&1)
code=$?
{ { [ $code = 2 ] && [[ $said == *'fr/01-one.md: its directives'* || $said == *'fr/01-one.md: it has'* ]]; } || echo "exit code $code: $said"; } |
    report "a chapter that has other directives in French is told"
for language in en fr; do
    chapter good $language/01-one <<'END'
```{.sh .run}
echo '<svg width="9" height="9"><text x="1">camera</text><text x="2">no such words</text></svg>' >a.svg
```

::: {.picture file="a.svg" alt="some words"}
:::
END
done
said=$(NOTES=$folder/good notes/make-notes.sh "$folder/out" 2>&1)
code=$?
{ { [ $code = 2 ] && [[ $said == *'fr/01-one.md: the drawing a.svg says "no such words", for which'* && $said != *'"camera"'* && $said != *en/01-one.md* ]]; } ||
    echo "exit code $code: $said"; } | report "words in a drawing that have no French are told"
rm "$folder/good/fr/01-one.md"
NOTES=$folder/good notes/make-notes.sh "$folder/out" >/dev/null 2>&1
{ grep -q 'href="../fr/index.html"' "$folder/out/en/01-one.html" && [ ! -f "$folder/out/fr/01-one.html" ] || echo "it leads elsewhere"; } |
    report "where a chapter is not in French yet, its page leads to the French list of chapters"
echo "1..$count"
