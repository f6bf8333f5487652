#!/bin/sh
# SPDX-License-Identifier: MIT
# The code in README.md and docs/*.md: every block of C compiles under the strict warnings, whole programs and blocks of Python run and end
# with 0. SOURCE OF TRUTH: the compiler, and what the programs check of themselves.
#
# A block that has a main is a program. Others are the inside of a function whose parameters are the names in the comment before them:
#   <!-- needs: body, lo -->      names of the list `declare` below
#   <!-- file scope -->           declarations, as they stand
#   <!-- same as PATH -->         the text of that file, which is another version's: it is compared, not compiled
#   <!-- not compiled -->         needs a system that this machine may not have
#   <!-- with MODULE -->          a block of Python that is skipped where Python has no such module
# check_docs.sh --compile only compiles. Blocks of sh are not run. Python finds the library in the environment variable PERI.
set -e
cc=${CC:-cc}
dir=build/checks/docs
strict="-std=c99 -pedantic -Wall -Wextra -Wconversion -Wshadow -Wundef -Werror -Wno-unused-variable -Wno-unused-parameter -Wno-unused-but-set-variable"
rm -rf $dir
mkdir -p $dir
awk -v dir=$dir '
function declare(name) {
    if (name == "body" || name == "copy") return "peri_body *" name
    if (name ~ /^(lo|hi)$/) return "const double *" name
    if (name ~ /^(glass|steel|set|top|bottom|load|status)$/) return "int32_t " name
    if (name == "run") return "peri_advance_desc *" name
    print FILENAME ":" FNR ": no declaration of " name > "/dev/stderr"
    failed = 1
    exit 1
}
FNR == 1 {
    page = FILENAME
    gsub(/.*\/|\.md$/, "", page)
    hint = ""
}
/^<!-- / { hint = $0; next }
/^```(c|python)$/ && !inside {
    inside = /python/ ? "py" : "c"
    text = ""
    at = FNR + 1
    next
}
/^```$/ && inside {
    if (hint ~ /same as/) {
        sub(/.*same as /, "", hint)
        sub(/ -->.*/, "", hint)
        out = dir "/" page "_" at ".text"
        print hint > (dir "/same_" page "_" at)
        printf "%s", text > out
    } else if (inside == "py" || text ~ /int main\(/) {
        out = dir "/" page "_" at "." inside
        if (inside == "c") printf "#line %d \"%s\"\n", at, FILENAME > out
        printf "%s", text > out
        if (inside == "py" && hint ~ /<!-- with /) {
            gsub(/.*<!-- with | *-->.*/, "", hint)
            print hint > (out ".needs")
        }
    } else if (hint !~ /not compiled/) {
        if (hint !~ /needs:|file scope/) {
            print FILENAME ":" at ": a block without a main says neither what it needs nor that it is of file scope" > "/dev/stderr"
            failed = 1
            exit 1
        }
        fragments = dir "/fragments.c"
        if (!begun) print "#include \"peri.h\"\n#include <math.h>\n#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>" > fragments
        begun = 1
        if (hint ~ /file scope/) {
            printf "#line %d \"%s\"\n%s", at, FILENAME, text > fragments
        } else {
            gsub(/.*needs: *| *-->.*/, "", hint)
            count = split(hint, names, / *, */)
            list = count ? "" : "void"
            for (k = 1; k <= count; ++k) list = list (k > 1 ? ", " : "") declare(names[k])
            printf "void fragment_%d(%s);\nvoid fragment_%d(%s) {\n#line %d \"%s\"\n%s}\n", ++made, list, made, list, at, FILENAME, text > fragments
        }
    }
    inside = hint = ""
    next
}
inside { text = text $0 "\n"; next }
/[^ ]/ { hint = "" }
END { exit failed }' README.md docs/*.md

if [ -f $dir/fragments.c ]; then $cc $strict -O0 -I. -c $dir/fragments.c -o $dir/fragments.o; fi
for same in $dir/same_*; do
    [ -f "$same" ] || continue
    name=$(basename "$same" | sed 's/^same_//')
    grep -v SPDX-License "$(cat "$same")" | diff "$dir/$name.text" -
done
if [ "$1" = --compile ]; then # of make lint: nothing is linked or run
    for program in $dir/*_[0-9]*.c; do $cc $strict -I. -DPERI_IMPLEMENTATION_DONE -fsyntax-only "$program"; done
    exit 0
fi
programs=0
for program in $dir/*_[0-9]*.c; do # the library is linked: PERI_IMPLEMENTATION, where it is defined, finds it done
    name=${program%.c}
    $cc $strict -O0 -I. -DPERI_IMPLEMENTATION_DONE "$program" build/libperi.a ${OPENMP--fopenmp} -lm -o "$name"
    (cd $dir && "./$(basename "$name")" > "$(basename "$name").out") || { echo "$program: ends with $?"; cat "$name.out"; exit 1; }
    programs=$((programs + 1))
done
[ $programs -ge 3 ] || { echo "only $programs programs"; exit 1; }
if command -v python3 > /dev/null; then
    for program in $dir/*.py; do
        if [ -f "$program.needs" ] && ! python3 -c "import $(cat "$program.needs")" 2> /dev/null; then
            echo "skip $program: no $(cat "$program.needs")"
            continue
        fi
        PERI=build/libperi.so python3 "$program" > "${program%.py}.out"
    done
else
    echo "skip python: not on this machine"
fi
