#!/bin/sh
# Checks that every C file is laid out as .clang-format says, with clang-format 14: other versions lay out
# some lines differently.
#
#   tools/check-format.sh               names each file and line that differs; exit 1 if there is one
#   tools/check-format.sh --fix         rewrites the files
#   tools/check-format.sh --available   exit 0 if there is a clang-format 14, 77 if not

set -u
cd "$(dirname "$0")/.." || exit 1

formatter=
for candidate in clang-format-14 clang-format; do
    if "$candidate" --version 2>/dev/null | grep 'version 14\.' >/dev/null; then
        formatter=$candidate
        break
    fi
done
if [ -z "$formatter" ]; then
    [ "${1-}" = --available ] || echo "clang-format 14 is not installed: the layout of the code was not checked."
    exit 77
fi

case ${1-} in
--available) exit 0 ;;
--fix) set -- -i ;;
*) set -- --dry-run --Werror ;;
esac
find . \( -path ./build -o -name node_modules -o -name '.?*' \) -prune -o -name '*.[ch]' -type f -print0 |
    xargs -0 -r "$formatter" --style=file "$@"
