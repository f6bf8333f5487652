#!/bin/sh
# House rules and static analysis. Tools that a machine lacks are skipped with a message.
cd "$(dirname "$0")/.." || exit 1
status=0
fail() { echo "lint: $*"; status=1; }
strict="-std=c99 -pedantic -Wall -Wextra -Wconversion -Wshadow -Wundef -Werror -fsyntax-only -I."

for compiler in gcc clang; do
    command -v $compiler > /dev/null || { echo "lint: no $compiler, skipped"; continue; }
    for file in peri_impl.c examples/*.c tests/*.c tests/extremes/*.c bench/*.c; do
        $compiler $strict "$file" || fail "$compiler: $file"
    done
done
if command -v cppcheck > /dev/null; then
    cppcheck --quiet --std=c99 --enable=warning,portability --inline-suppr --error-exitcode=1 \
        --suppress=missingIncludeSystem -DPERI_IMPLEMENTATION_DONE --include=peri.h peri_impl.c || fail cppcheck
else
    echo "lint: no cppcheck, skipped"
fi
for file in src/*/* peri_impl.c examples/* tests/*.c tests/*.h tests/extremes/* bench/*; do
    lines=$(wc -l < "$file")
    [ "$lines" -le 600 ] || fail "$file: $lines lines, more than 600"
done
awk 'length > 140 { printf "lint: %s:%d: longer than 140\n", FILENAME, FNR; bad = 1 } END { exit bad }' \
    peri.h peri_impl.c src/*/* examples/* tests/*.c tests/*.h tests/extremes/* bench/* || status=1
grep -nE '[[:space:]]+$' peri.h peri_impl.c src/*/* examples/* tests/*.* tests/extremes/* bench/* tools/* Makefile README.md && fail "trailing blanks"
grep -nE '\b(printf|exit|abort|assert)[[:space:]]*\(' src/*/* && fail "the library prints or exits"
# no state: every variable of the library is const or local
grep -nE '^static [a-z_0-9]+ [a-z_0-9]+(\[.*\])? *(=|;)' src/*/* | grep -v const && fail "global state"
[ $status -eq 0 ] && echo "lint: clean"
exit $status
