#!/bin/sh
# SPDX-License-Identifier: MIT
# House rules and static analysis. Tools that a machine lacks are skipped with a message.
cd "$(dirname "$0")/.." || exit 1
status=0
fail() { echo "lint: $*"; status=1; }
strict="-std=c99 -pedantic -Wall -Wextra -Wconversion -Wshadow -Wundef -Werror -fsyntax-only -DPERI_KERNELS=3 -I."

for compiler in gcc clang; do
    command -v $compiler > /dev/null || { echo "lint: no $compiler, skipped"; continue; }
    for file in peri_impl.c examples/*.c examples/gallery/*.c tests/*.c tests/extremes/*.c tests/promises/*.c bench/*.c \
        tools/run/*.c; do
        $compiler $strict "$file" || fail "$compiler: $file"
    done
done
if command -v cppcheck > /dev/null; then
    cppcheck --quiet --std=c99 --enable=warning,portability --inline-suppr --error-exitcode=1 \
        --suppress=missingIncludeSystem -DPERI_IMPLEMENTATION_DONE --include=peri.h peri_impl.c || fail cppcheck
else
    echo "lint: no cppcheck, skipped"
fi
for file in src/*/* peri_impl.c examples/*.[ch] examples/gallery/* tests/*.c tests/*.h tests/extremes/* tests/promises/* bench/* tools/run/*.[ch]; do
    lines=$(wc -l < "$file")
    [ "$lines" -le 600 ] || fail "$file: $lines lines, more than 600"
done
awk 'length > 140 { printf "lint: %s:%d: longer than 140\n", FILENAME, FNR; bad = 1 } END { exit bad }' \
    peri_impl.c src/*/* examples/*.[ch] examples/gallery/* extras/* tests/*.c tests/*.h tests/extremes/* tests/promises/*.c bench/* tools/run/*.[ch] || status=1
# peri.h is read in ten minutes
awk 'length > 100 { printf "lint: peri.h:%d: longer than 100\n", FNR; bad = 1 }
    { size += length + 1; rest = $0
      while (rest != "") {
          at = index(rest, inside ? "*/" : "/*")
          if (inside) said += at ? at + 1 : length(rest) + 1
          if (!at) break
          rest = substr(rest, at + 2); if (!inside) said += 2; inside = !inside
      }
      if (inside && rest == "") said++ }
    END { if (size > 80000) { printf "lint: peri.h: %d bytes, more than 80,000\n", size; bad = 1 }
          if (said > 0.55 * size) { printf "lint: peri.h: comments are %.1f %% of it, more than 55\n", 100 * said / size; bad = 1 }
          exit bad }' peri.h || status=1
grep -nE '[[:space:]]+$' peri.h peri_impl.c src/*/* extras/* examples/*.[ch] examples/gallery/* tests/*.* tests/extremes/* tests/promises/* bench/* tools/*.* tools/bind/*.* tools/run/*.* tools/run/decks/* Makefile README.md && fail "trailing blanks"
grep -nE '\b(printf|exit|abort|assert)[[:space:]]*\(' src/*/* && fail "the library prints or exits"
# no state: every variable of the library is const or local
grep -nE '^static [a-z_0-9]+ [a-z_0-9]+(\[.*\])? *(=|;)' src/*/* | grep -v const && fail "global state"
awk -v laws=refuse -f tools/wings.awk peri_impl.c src/*/* || status=1
sh tools/check_docs.sh || status=1
sh tests/promises/check.sh || fail "what the pages promise is not proven"
sh tests/check_docs.sh --compile || fail "code in the docs does not compile"
sh tools/spdx.sh --check || fail "files without a licence line"
if command -v python3 > /dev/null; then
    python3 tools/api.py --check || status=1
    python3 tools/bind.py --check || status=1
fi
awk -f tools/fields.awk peri.h src/*/*.c || status=1
# peri.h and peri_status_text say the same of each status
awk -f - peri.h src/base/status.c << 'END' || fail "peri.h and src/base/status.c differ in the text of a status"
FILENAME == "peri.h" && !ended {
    entry = entry " " $0
    if (!/\*\/$/) next
    if (match(entry, /PERI_[A-Z_]+ += +-?[0-9]+,? +\/\* /)) {
        name = substr(entry, RSTART)
        said = substr(entry, RSTART + RLENGTH)
        sub(/ .*/, "", name); sub(/ \*\/$/, "", said); gsub(/ +/, " ", said)
        text[name] = said
    }
    entry = ""
}
/^} peri_status;/ { ended = 1 }
FILENAME != "peri.h" && /^ +X\([A-Z_]+, -?[0-9]+, "/ {
    name = $1
    sub(/^X\(/, "PERI_", name); sub(/,$/, "", name)
    sub(/^[^"]*"/, ""); sub(/"\).*$/, "")
    if (text[name] != $0) { print "lint: " name ": " $0; bad = 1 }
    seen++
}
END { exit bad || !seen }
END
[ $status -eq 0 ] && echo "lint: clean"
exit $status
