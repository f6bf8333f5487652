#!/bin/sh
# SPDX-License-Identifier: MIT
# spdx.sh - every source file names its licence: --check lists tracked files that do not, --add puts the line where it is missing.
#   peri.h                 second line, in the head comment: the first says what it is
#   C, C++, .inl           a line of its own at the top
#   scripts, make, CMake   the first comment, after #! where there is one
cd "$(dirname "$0")/.." || exit 1
id="SPDX-License-Identifier: MIT" # of this file, too

lacking() {
    git ls-files -- '*.c' '*.h' '*.inl' '*.cpp' '*.py' '*.sh' '*.awk' '*.sed' '*Makefile' '*CMakeLists.txt' '*.cmake' '*.in' .ci/run |
        while read -r file; do head -n 5 "$file" | grep -q "$id" || echo "$file"; done
}

add() { # add FILE: keeps its mode
    case $1 in
    peri.h) awk -v id="   $id" '{ print } NR == 1 { print id }' "$1" ;;
    *.c|*.h|*.inl|*.cpp|*.c.in) echo "/* $id */" && cat "$1" ;;
    *) awk -v id="# $id" 'NR == 1 && /^#!/ { print; print id; next } NR == 1 { print id } { print }' "$1" ;;
    esac > build/spdx && cat build/spdx > "$1"
}

case $1 in
--check)
    files=$(lacking)
    [ -z "$files" ] || { echo "$files"; exit 1; }
    ;;
--add)
    mkdir -p build
    lacking | while read -r file; do add "$file" || exit 1; done
    rm -f build/spdx
    ;;
*)
    echo "spdx.sh --check | --add"
    exit 2
    ;;
esac
