#!/usr/bin/env bash
# Rewrites compare/results.csv from a fresh measurement. A change of its numbers is a commit of its own,
# with the reason.
set -euo pipefail
cd "$(dirname "$0")/.."
measured=$(mktemp)
trap 'rm -f "$measured"' EXIT
tools/measure-scenes.sh >"$measured"
cp "$measured" compare/results.csv
git --no-pager diff --stat -- compare/results.csv
