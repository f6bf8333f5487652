#!/bin/sh
# SPDX-License-Identifier: MIT
# What docs/manual.md says of builds, threads and fork(), and tests in C cannot see: tests/promises names the sentences. A check of checks.sh;
# `sh tests/check_promises.sh NAME...` does some alone. What the machine lacks is skipped by name.
# SOURCE OF TRUTH: the sentences; nm, objdump and the compiler; /proc/self/status.
set -e
cd "$(dirname "$0")/.."
cc=${CC:-cc}
openmp=${OPENMP--fopenmp}
strict="-std=c99 -pedantic -Wall -Wextra -Werror -I."
plane="-O0 -DPERI_NO_3D -DPERI_NO_MIXED -DPERI_NO_F32 -DPERI_NO_ADVICE" # quick to build
out=build/checks/promises
on_x86=""
if gcc --version > /dev/null 2>&1 && [ "$(uname -m)" = x86_64 ]; then on_x86=yes; fi
mkdir -p $out

same() { [ "$1" = "$2" ] || { echo "\"$1\", not \"$2\""; exit 1; }; }
fits() { expr "$1" : "$2\$" > /dev/null || { echo "\"$1\" is not $2"; exit 1; }; }
none() { [ ! -s "$2" ] || { echo "$1:"; cat "$2"; exit 1; }; } # none WHAT FILE

# one: without OpenMP, without FILE, its functions hidden; other: in spite of -fopenmp, with 16-byte vectors and without unwind tables
objects() {
    quick=$cc
    gcc=$cc
    if command -v clang > /dev/null; then quick=clang; fi # in half the time
    [ -z "$on_x86" ] || gcc=gcc
    $quick $strict $plane -DPERI_NO_STDIO '-DPERI_API=__attribute__((visibility("hidden"))) extern' -c peri_impl.c -o $out/one.o
    $gcc $strict $plane -DPERI_NO_STATICS -DPERI_NO_OUTPUT $openmp -DPERI_NO_OPENMP -DPERI_KERNELS=2 -fno-asynchronous-unwind-tables -c peri_impl.c -o $out/other.o
    for name in one other; do $gcc $strict tests/promises/threads.c $out/$name.o -lm -o $out/$name; done
    $cc $strict tests/promises/threads.c build/libperi.a $openmp -lm -o $out/library
}

# "It needs libc and libm"; "does not print, exit, ... read files, or touch the locale"; "reads a clock only in peri_plan ... and in
# peri_choose"; PERI_NO_STDIO leaves out what needs FILE. Names of GNU libgomp, of the compiler and of the library aside.
symbols() {
    command -v nm > /dev/null || { echo "skip symbols: no nm on this machine"; return; }
    maths="atan2 ceil cos exp expm1 fabs floor fmax fmin frexp hypot ldexp log log10 log1p pow sin sincos sqrt sqrtf tan"
    memory="free malloc memcmp memcpy memmove memset qsort strcmp strcpy strlen strstr"
    for name in $maths $memory; do echo "$name"; done | sort > $out/always
    for name in fopen fclose fread fwrite fputc fseek ftell clock; do echo "$name"; done | sort - $out/always > $out/allowed
    of() { nm -u "$@" | awk 'NF == 2 {print $2}' | grep -v '^\(peri__\|GOMP_\|omp_\|__cpu_\|_GLOBAL_OFFSET\|__stack_chk\)' | sort -u; }
    of build/core.o build/kernels/*.o > $out/needed
    grep -q -x clock $out/needed && grep -q -x fopen $out/needed || { echo "not seen: clock, fopen"; exit 1; }
    comm -23 $out/needed $out/allowed > $out/more
    none "needs more than it should" $out/more
    of $out/one.o | comm -23 - $out/always > $out/more
    none "without advice and stdio there is still" $out/more
    grep -E 'fopen\(|peri__save\(' src/*/*.c | grep '"r' | grep -v -e '^src/output/checkpoint.c:' -e '^src/output/output.c:.*frame == 0' > $out/more || true
    none "reads a file" $out/more
}

# "PERI_API may be defined to a linkage of yours."
linkage() {
    command -v objdump > /dev/null || { echo "skip linkage: no objdump on this machine"; return; }
    objdump -t $out/one.o | grep ' g .* peri_[a-z]' > $out/functions
    grep -q 'peri_build$' $out/functions
    grep -v '\.hidden' $out/functions > $out/more || true
    none "not of the linkage given" $out/more
}

# "With -fopenmp the loops run on all cores; without it, or with PERI_NO_OPENMP, they run on the calling thread"; "small loops (less work than
# about 100,000 bonds) run on the calling thread"; parallel_for: "with it `threads` and OpenMP are not used". Building passes over the bonds of
# a point four times: 28 x 28 points of 28 bonds are small, 65 x 65 are not.
threads() {
    [ -r /proc/self/status ] && [ -n "$openmp" ] || { echo "skip threads: no /proc or no OpenMP on this machine"; return; }
    after() { OMP_NUM_THREADS=3 "$@" | sed 's/ threads.*//'; }
    same "$(after $out/library 65 0)" 3
    same "$(after $out/library 28 0)" 1
    same "$(after $out/library 65 2)" 2
    same "$(after $out/library 65 1)" 1
    same "$(after $out/library 65 0 hook)" 1
    same "$(after $out/one 65 0)" 1
    same "$(after $out/other 65 0)" 1
}

# PERI_KERNELS: "1: kernels in plain C99: the default without optimisation and with gcc's address sanitizer, and all that other compilers
# have; 2: and the 16-byte vectors of gcc and clang; 3: and the vectors of x86-64: the default"; "the library picks one at run time".
vectors() {
    [ -n "$on_x86" ] || { echo "skip vectors: no gcc for x86-64"; return; }
    fits "$($out/library 40 1)" '.*columns, \(SSE2\|AVX2\|AVX-512\)'
    fits "$($out/one 40 1)" '.*columns, plain'
    fits "$($out/other 40 1)" '.*columns, 16 bytes'
    chosen() { gcc -std=c99 -DPERI_IMPL "$@" -E -dD src/base/compiler.h | sed -n 's/^#define PERI_KERNELS //p' | tail -n 1; }
    same "$(chosen -O0) $(chosen -O1) $(chosen -O2) $(chosen -O1 -fsanitize=address)" "1 3 3 1"
    command -v tcc > /dev/null || { echo "skip tcc: not on this machine"; return; }
    tcc -I. $plane tests/promises/threads.c peri_impl.c -lm -o $out/tcc
    fits "$($out/tcc 40 1)" '.*columns, plain'
}

# The table of fork(): a child of a process that has run a parallel region of GNU libgomp hangs in one, and only there. gcc 12.2, as it says.
fork() {
    case "$(uname -sm) $(gcc -dumpfullversion 2> /dev/null)" in "Linux x86_64 12."*) ;; *) echo "skip fork: no gcc 12 on Linux"; return ;; esac
    gcc $strict tests/promises/fork.c build/libperi.a -fopenmp -lm -o $out/fork
    same "$($out/fork 2 2)" hangs
    same "$($out/fork 2 1)" runs
    same "$($out/fork 1 2)" runs
    if clang $strict tests/promises/fork.c build/libperi.a -fopenmp=libomp -lm -o $out/fork_clang 2> /dev/null; then
        same "$($out/fork_clang 2 2)" runs
    else
        echo "skip libomp: not on this machine"
    fi
}

# "gcc on x86-64 writes unwind tables by default, and the exception then passes without [-fexceptions]; built with
# -fno-asynchronous-unwind-tables and without -fexceptions the same program was ended by std::terminate."
exceptions() {
    [ -n "$on_x86" ] && command -v g++ > /dev/null || { echo "skip exceptions: no g++ for x86-64"; return; }
    case $($cc -v 2>&1) in *"gcc version"*) ;; *) echo "skip exceptions: $cc is not gcc"; return ;; esac
    g++ -std=c++11 -I. -c tests/cxx_throws.cpp -o $out/throws.o
    g++ $out/throws.o build/libperi.a $openmp -o $out/throws_library -lm
    g++ $out/throws.o $out/other.o -o $out/throws_other -lm
    $out/throws_library
    if $out/throws_other > $out/throws.log 2>&1; then echo "the exception passed"; exit 1; fi
    grep -q "terminate called" $out/throws.log
}

# "The functions are flat: 32- and 64-bit integers, doubles, pointers; no structs by value, no variable arguments, no bit fields."
flat() {
    awk '
    !/^#/ { code = code " " $0 }
    END {
        while (match(code, /\/\*([^*]|\*[^\/])*\*\//)) code = substr(code, 1, RSTART - 1) " " substr(code, RSTART + RLENGTH)
        if (code ~ /\.\.\./ || code ~ /[a-z_] *: *[0-9]+ *;/) { print "variable arguments or bit fields"; bad = 1 }
        while (match(code, /PERI_API [^;]*;/)) {
            one = substr(code, RSTART + 9, RLENGTH - 10)
            code = substr(code, RSTART + RLENGTH)
            count++
            match(one, /\(.*\)/)
            list = substr(one, RSTART + 1, RLENGTH - 2)
            if (substr(one, 1, RSTART - 1) !~ /^ *(void|int32_t|int64_t|double|const char \*) *peri_[a-z0-9_]+$/) { print "returns: " one; bad = 1 }
            args = split(list, arg, ",")
            for (k = 1; k <= args; ++k)
                if (arg[k] !~ /\*|^ *(void|(int32_t|int64_t|uint64_t|double|peri_[a-z_]+_fn) [a-z0-9_]+) *$/) { print one ": " arg[k]; bad = 1 }
        }
        if (count < 90) { print "only " count " functions"; bad = 1 }
        exit bad
    }' peri.h
}

# README.md: what its program prints.
readme() {
    said=$(sed -n 's/^It prints `\(.*\)`.*/\1/p' README.md)
    awk '/^```c$/ { code = 1; next } /^```$/ { if (code) exit } code' README.md > $out/readme.c
    $cc $strict -DPERI_IMPLEMENTATION_DONE $out/readme.c build/libperi.a $openmp -lm -o $out/readme
    same "$(cd $out && ./readme)" "$said"
}

[ $# -gt 0 ] || set -- symbols linkage threads vectors fork exceptions flat readme
objects
for check; do
    $check
    echo "done $check"
done
