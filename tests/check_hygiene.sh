#!/bin/sh
# SPDX-License-Identifier: MIT
# Odd surroundings: words taken by windows.h, C++, other C libraries and machines. Read by checks.sh it queues its checks, those whose tools
# the machine lacks skipped by name; run as `sh tests/check_hygiene.sh [NAME...]` it does them.
# Builds are small, in the plane and double precision, and without optimisation; the words of windows.h are looked for in all of the text.
hygiene="windows_macros windows_h mingw musl m32 wasm tcc_runs cxx_header_gcc cxx_header_clang cxx_implementation static_late"
strict="-std=c99 -pedantic -Wall -Wextra -Werror -I."
parts="-O0 -DPERI_NO_3D -DPERI_NO_MIXED -DPERI_NO_F32 -DPERI_NO_STATICS -DPERI_NO_ADVICE -DPERI_NO_OUTPUT"
out=build/checks
mingw=x86_64-w64-mingw32-gcc

tool_of() { # tool_of NAME: what the check needs; where that is there, nothing
    case $1 in
    windows_h|mingw) command -v $mingw > /dev/null || echo $mingw ;;
    musl) command -v musl-gcc > /dev/null || echo musl-gcc ;;
    m32) echo 'int main(void) { return 0; }' | ${CC:-cc} -m32 -x c - -o $out/m32_probe 2> /dev/null || echo "C library for -m32" ;;
    wasm) command -v emcc > /dev/null || echo emcc ;;
    tcc_runs) command -v tcc > /dev/null || echo tcc ;;
    cxx_header_gcc|cxx_implementation) command -v g++ > /dev/null || echo g++ ;;
    cxx_header_clang) command -v clang++ > /dev/null || echo clang++ ;;
    esac
}

# every word of windows.h that is a name of ours somewhere, whatever the vectors
windows_macros() { ${CC:-cc} $strict -O1 -DPERI_KERNELS=3 -DWINDOWS_MACROS -fsyntax-only tests/portable.c; }
windows_h() { $mingw $strict -O1 -DPERI_KERNELS=3 -fsyntax-only tests/portable.c; }

mingw() {
    $mingw $strict $parts tests/portable.c -o $out/portable.exe
    command -v wine > /dev/null || { echo "no wine: built, not run"; return; }
    WINEPREFIX=$PWD/$out/wine WINEDEBUG=-all wine $out/portable.exe
}
musl() { musl-gcc $strict $parts -static tests/portable.c -o $out/portable_musl -lm && $out/portable_musl; }
m32() { ${CC:-cc} $strict $parts -m32 tests/portable.c -o $out/portable_m32 -lm && $out/portable_m32; }
wasm() {
    emcc $strict $parts -s SINGLE_FILE=1 tests/portable.c -o $out/portable.js
    command -v node > /dev/null || { echo "no node: built, not run"; return; }
    node $out/portable.js
}
tcc_runs() { tcc -I. $parts tests/portable.c -o $out/portable_tcc -lm && $out/portable_tcc; }

# the declarations are C++11 and later, after windows.h, too, and may be included twice
cxx_header() { # cxx_header COMPILER
    printf '#include "tests/windows_macros.h"\n#include "peri.h"\n#include "peri.h"\n' > $out/header.cpp
    for standard in 11 14 17 20; do
        $1 -std=c++$standard -Wall -Wextra -pedantic -Wundef -Wshadow -Werror -I. -fsyntax-only $out/header.cpp
    done
}
cxx_header_gcc() { cxx_header g++; }
cxx_header_clang() { cxx_header clang++; }

# refused HOW-OFTEN TEXT COMMAND...: the compiler fails, its first error is ours, and that comes so many times (0: at least once)
refused() {
    times=$1
    text=$2
    shift 2
    log=$out/refused.$$.log # checks run side by side
    if "$@" > $log 2>&1; then echo "compiles: $*"; return 1; fi
    grep 'error' $log | head -n 1 | grep -q "error.*$text" || { cat $log; return 1; }
    [ "$times" -eq 0 ] || [ "$(grep -c 'error:' $log)" -eq "$times" ] || { cat $log; return 1; }
    rm -f $log
}
cxx_implementation() {
    printf '#define PERI_IMPLEMENTATION\n#include "peri.h"\nint main() { return 0; }\n' > $out/implementation.cpp
    mkdir -p $out/single_cxx
    awk -f tools/dist.awk peri.h > $out/single_cxx/peri.h
    for compiler in g++ clang++; do
        command -v $compiler > /dev/null || continue
        for folder in . $out/single_cxx; do
            refused 1 "PERI_IMPLEMENTATION in C++" $compiler -I$folder -fsyntax-only $out/implementation.cpp
        done
        refused 0 "is C99: compile it as C" $compiler -Wfatal-errors -x c++ -I. -fsyntax-only peri_impl.c
    done
}
static_late() {
    printf '#include "peri.h"\n#define PERI_STATIC\n#include "peri.h"\nint main(void) { return 0; }\n' > $out/static_late.c
    refused 1 "PERI_STATIC comes too late" ${CC:-cc} -std=c99 -I. -fsyntax-only $out/static_late.c
    printf '#include "peri.h"\n#define PERI_STATIC\n#define PERI_IMPLEMENTATION\n#include "peri.h"\n' > $out/static_late.c
    refused 1 "PERI_STATIC comes too late" ${CC:-cc} -std=c99 -I. -fsyntax-only $out/static_late.c
}

if command -v queue > /dev/null; then
    for name in $hygiene; do
        lacks=$(tool_of $name)
        # of one kind the other is enough where there is time for one; make validate does all
        case $name in
        windows_macros) [ -n "$(tool_of windows_h)" ] || continue ;;
        musl) [ -n "$(tool_of m32)" ] || continue ;;
        esac
        if [ -z "$lacks" ]; then queue $name "sh tests/check_hygiene.sh $name"; else skip $name "no $lacks on this machine"; fi
    done
else
    set -e
    cd "$(dirname "$0")/.."
    mkdir -p $out
    [ $# -gt 0 ] || set -- $hygiene
    for name; do
        lacks=$(tool_of $name)
        if [ -z "$lacks" ]; then $name; else echo "skip $name: no $lacks on this machine"; fi
    done
fi
