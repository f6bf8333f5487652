#!/bin/sh
# SPDX-License-Identifier: MIT
# What docs/manual.md says builds take: the table of switches, by the compiler that it names, and the flags that keep clang's -ffast-math to
# the bits of the library. A part of make validate, three minutes of one processor; `sh tests/check_builds.sh NAME...` does some alone.
# SOURCE OF TRUTH: the table, which is read here: times over that of the first row to 0.1, bytes of code to 5 %.
set -e
cd "$(dirname "$0")/.."
out=build/checks/builds
mkdir -p $out

# seconds COMMAND...: of the processors
seconds() {
    ("$@" >&2; times > $out/times)
    awk -F '[ms ]+' 'NR == 2 {printf "%.2f", 60 * $1 + $2 + 60 * $3 + $4}' $out/times
}
within() { awk -v a="$1" -v lo="$2" -v hi="$3" 'BEGIN {exit !(a >= lo && a <= hi)}' || { echo "$4: $1 is not in $2 .. $3"; exit 1; }; }

# "up to a minute of gcc, once"; "What each switch saves (gcc 12, x86-64, processor time over that of the first row, of one run)".
table() {
    sed -n '/^| build | time | bytes of code |$/,/^$/p' docs/manual.md | grep '^|' | sed 1,2d | tr -d '`' |
        sed 's/,\([0-9]\)/\1/g' > $out/rows
    [ "$(wc -l < $out/rows)" -eq 6 ] || { echo "the table has not six rows"; exit 1; }
    first=""
    last=""
    while IFS='|' read -r nothing flags time bytes rest; do
        flags=$(echo "$flags" | sed 's/, all of it//; s/:.*//')
        case $flags in *"the same with"*) flags="$last ${flags#*the same with }" ;; esac
        last=$flags
        took=$(seconds gcc $flags -c peri_impl.c -o $out/object.o)
        first=${first:-$took}
        size=$(size -A $out/object.o | awk '$1 ~ /^\.text/ || $1 ~ /^\.rodata/ || $1 ~ /^\.eh_frame/ {n += $2} END {print n}')
        echo "$flags: $took s, $(echo "$took $first" | awk '{printf "%.2f", $1 / $2}') of the first; $size bytes"
        echo "$flags|$took|$first|$size|$time|$bytes" >> $out/measured
    done < $out/rows
    awk -F '|' '{
        if ($2 / $3 < $5 - 0.1 || $2 / $3 > $5 + 0.1) { print $1 ": " $2 / $3 " of the time of the first, not " $5; bad = 1 }
        if ($4 < 0.95 * $6 || $4 > 1.05 * $6) { print $1 ": " $4 " bytes, not " $6; bad = 1 }
    } END { exit bad }' $out/measured
    within "$first" 5 75 "seconds of gcc -O2"
}
# "at -O0 some 5 seconds"
one_file() {
    printf '#define PERI_IMPLEMENTATION\n#include "../../../peri.h"\n' > $out/one_file.c
    within "$(seconds gcc -O0 -c $out/one_file.c -o $out/one_file.o)" 2 10 "seconds of gcc -O0"
}
# "clang's -ffast-math still fuses products into sums and estimates square roots: for the same bits on all vectors add -ffp-contract=off
# -mrecip=none."
clang_fast_math() {
    command -v clang > /dev/null || { echo "skip clang_fast_math: no clang on this machine"; return; }
    cc=${CC:-cc}
    $cc -std=c99 -O1 -I. tests/bits.c build/libperi.a ${OPENMP--fopenmp} -lm -o $out/bits
    $out/bits > $out/bits.text
    clang -O1 -ffast-math -ffp-contract=off -mrecip=none -DPERI_KERNELS=3 -c peri_impl.c -o $out/fast.o
    $cc -std=c99 -O1 -I. tests/bits.c $out/fast.o -lm -o $out/bits_fast
    $out/bits_fast | cmp - $out/bits.text
}

# README.md, make demo: "about half a minute, most of it compiling"
demo() {
    rm -f build/demo/*
    within "$(seconds make --no-print-directory demo)" 10 60 "seconds of make demo"
}

rm -f $out/measured
[ $# -gt 0 ] || set -- table one_file demo clang_fast_math
case "$(uname -m) $(gcc -dumpfullversion 2> /dev/null)" in
"x86_64 12."*) ;;
*) echo "skip table, one_file, demo: no gcc 12 for x86-64"; set -- clang_fast_math ;;
esac
for check; do
    $check
    echo "done $check"
done
