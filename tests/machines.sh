#!/bin/sh
# SPDX-License-Identifier: MIT
# The library on other machines, built and run here: 32-bit x86 with the registers of the x87 and with SSE2, and, emulated, ARM and s390x,
# whose bytes are in the other order. Every row of the extremes, and the tests below. Skips what is not installed; takes over an hour.
#   machines.sh NAME    only i686, i686_sse2, aarch64 or s390x
cd "$(dirname "$0")/.." || exit 1
STRICT="-std=c99 -pedantic -Wall -Wextra -Wconversion -Wshadow -Wundef -Werror"
TESTS="test_cracks test_edges test_errors test_families test_fields test_limits test_loads test_memory test_output test_search test_solvers"
only=$1
bad=0
mkdir -p build/machines

machine() { # machine NAME COMPILER FLAGS RUNNER
    [ -z "$only" ] || [ "$only" = "$1" ] || return
    if ! command -v "$2" > /dev/null || { [ -n "$4" ] && ! command -v "$4" > /dev/null; }; then
        echo "skip $1: no $2 $4 on this machine"
        return
    fi
    out=build/machines/$1
    $2 $STRICT -O1 $3 -c peri_impl.c -o "$out.o" || { echo "FAIL $1: does not build"; bad=1; return; }
    for name in extremes $TESTS; do
        source=tests/$name.c
        [ $name = extremes ] && source=$(echo tests/extremes/*.c)
        $2 $STRICT -O1 $3 -static -DLONGEST=200.0 -I. $source "$out.o" -o "$out.$name" -lm && $4 "$out.$name" > "$out.$name.log" 2>&1
        status=$?
        [ $status -eq 0 ] || { bad=1; grep -A 1 FAIL "$out.$name.log"; }
        echo "$1: $(tail -n 1 "$out.$name.log")"
    done
}

machine i686 i686-linux-gnu-gcc "" ""
machine i686_sse2 i686-linux-gnu-gcc "-msse2 -mfpmath=sse" ""
machine aarch64 aarch64-linux-gnu-gcc "" qemu-aarch64-static
machine s390x s390x-linux-gnu-gcc "" qemu-s390x-static
exit $bad
