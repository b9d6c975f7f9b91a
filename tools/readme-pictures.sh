#!/usr/bin/env bash
# Makes the pictures that the README shows: a scene of the gallery, and the report of a few scenes as a
# browser shows it (left as it is where there is no chromium).
#
#   tools/readme-pictures.sh FOLDER
set -euo pipefail
program=$(realpath "${ECLAIRAGE:-build/eclairage}")
mkdir -p "$1"
"$program" render --quiet scenes/gallery/colonnade.yaml -o "$1/colonnade.png"
command -v chromium >/dev/null || exit 0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ln -s "$PWD/scenes" "$program" "$work"
out=$(realpath "$1")
cd "$work"
PATH=$work:$PATH eclairage compare --quiet scenes/gallery/[cdilr-s]*.yaml >words
chromium --headless --no-sandbox --disable-gpu --disable-background-networking --hide-scrollbars \
    --user-data-dir="$work/profile" --window-size=1200,900 --virtual-time-budget=60000 \
    --screenshot="$out/report.png" "file://$work/eclairage-report/index.html" >log 2>&1
