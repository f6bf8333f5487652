#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs every test, shows the five that took longest and the seconds of all, and closes with "N passed, N failed". What a machine lacks is
# skipped with a message.
#   run.sh          the tests of `make test`
#   run.sh --long   the test programs with their long tables (make validate)
# Seconds are those of the processors, of all threads and children together: they hold on a busy machine, too. Every case's are in
# build/NAME.log, those of all programs and checks, the longest first, in build/sums; cases below a second are not shown.
cd "$(dirname "$0")/.." || exit 1

# ---- one job: build/NAME.log is what it said; in build/queue, NAME.sh is its command where it waits for its turn, NAME.program is there
# ---- where it is a test program, and NAME.sum is what came of it: "passed failed seconds name"

timed() { # timed NAME COMMAND...
    job=$1
    shift
    ("$@" > "build/$job.log" 2>&1
    echo $? > "build/queue/$job.status"
    times > "build/queue/$job.times")
}

# seconds FILE: from "0m0.01s 0m0.00s", those of the shell itself, and a second line, those of its children
seconds() { awk -F '[ms ]+' '{s += 60 * $1 + $2 + 60 * $3 + $4} END {printf "%.1f", s}' "$1"; }

report() { # report NAME: what a job that has ended did, in one piece, for others end at the same time
    log=build/$1.log
    took=$(seconds "build/queue/$1.times")
    if [ -f "build/queue/$1.program" ]; then
        sum=$(tail -n 1 "$log" | sed -n 's/^[^:]*: \([0-9]*\) passed, \([0-9]*\) failed$/\1 \2/p')
        {
            echo "== $1 ($took s)"
            if [ -n "$long" ]; then cat "$log"; else grep -v '^  pass .* 0\.[0-9]* s$' "$log"; fi
            # 132: what a sanitizer traps; SANITIZE in the Makefile says how to see it
            [ -n "$sum" ] || echo "  FAIL: ended without a result, status $(cat "build/queue/$1.status")"
        } > "build/queue/$1.shown"
        [ -n "$sum" ] || sum="0 1"
    elif [ "$(cat "build/queue/$1.status")" -eq 0 ]; then
        sum="1 0"
        echo "pass $1 ($took s)" > "build/queue/$1.shown"
    else
        sum="0 1"
        { echo "FAIL $1 ($took s)"; tail -n 20 "$log"; } > "build/queue/$1.shown"
    fi
    echo "$sum $took $1" > "build/queue/$1.sum"
    cat "build/queue/$1.shown"
}

if [ "$1" = --job ]; then
    long=$3
    timed "$2" sh "build/queue/$2.sh"
    report "$2"
    exit 0
fi

# ---- what the lists of tests are written with

long=$1
jobs=$(getconf _NPROCESSORS_ONLN 2> /dev/null) || jobs=2
all=""
queued=""

queue() { # queue NAME COMMAND: a check for run_queue, COMMAND one line of shell
    echo "$2" > "build/queue/$1.sh"
    queued="$queued $1"
}

queue_program() { # queue_program NAME COMMAND: a test program with arguments
    : > "build/queue/$1.program"
    queue "$1" "$2"
}

queue_programs() { # queue_programs NAME...: of build/tests
    for program; do queue_program "$program" "build/tests/$program $long"; done
}

run_queue() { # as many at a time as there are processors, in the order of the queue
    [ -n "$queued" ] || return 0
    printf '%s\n' $queued | xargs -P "$jobs" -I % sh tests/run.sh --job % "$long"
    all="$all $queued"
    queued=""
}

check() { # check NAME COMMAND...: passes when the command does
    all="$all $1"
    timed "$@"
    report "$1"
}

program() { # program NAME COMMAND...: a test program with arguments
    : > "build/queue/$1.program"
    check "$@"
}

skip() { echo "skip $1: $2"; }

STRICT="-std=c99 -pedantic -Wall -Wextra -Wconversion -Wshadow -Wundef -Werror"
SANITIZE="-g1 -O1 -fsanitize=address,undefined -fno-sanitize-recover=all"
CC=${CC:-cc}
can_sanitize() { echo 'int main(void){return 0;}' | $CC $SANITIZE -x c - -o build/san/probe 2> /dev/null && build/san/probe; }

# ---- the tests

rm -rf build/queue
mkdir -p build/queue build/checks build/san out
# under sanitizers, the tests of what handles memory: "NAME -CASE..." leaves out the cases that take longest there
sanitized="test_memory test_callbacks test_programs test_loose test_breaking test_cracks test_criteria test_edges test_errors \
    test_families test_fields test_fragments test_loads test_loadsteps test_misuse test_output test_plan test_quadrature test_random \
    test_search test_solvers"
longest="extremes test_oracles test_kernels test_programs test_choose test_direction test_failure test_branching test_random \
    test_callbacks test_bending test_stale"
shorter=$(basename -s .c tests/test_*.c)
for name in $longest; do shorter=$(printf '%s\n' $shorter | grep -v -x "$name"); done

if [ -z "$long" ]; then
    . tests/checks.sh
else
    # of 200,000 scenes a quarter, another every day; WHOLE=1: all, and all of 200,000 random programs
    quarter=$(expr "$(date -u +%j)" % 4)
    for part in 1-50000 50001-100000 100001-150000 150001-200000; do # longer than all else
        if [ -n "$WHOLE" ] || [ "$quarter" -eq 0 ]; then queue_program "test_oracles_$part" "build/tests/test_oracles $part"
        else skip "test_oracles_$part" "a quarter of the scenes a day; WHOLE=1 make validate runs all"; fi
        quarter=$((quarter - 1))
    done
    if [ -n "$WHOLE" ]; then queue_program test_programs_50000-199999 "build/tests/test_programs --many 50000 150000"
    else skip test_programs_50000-199999 "the first 50,000 programs are run; WHOLE=1 make validate runs all"; fi
    queue_programs $(for name in $longest $shorter; do [ "$name" = test_oracles ] || echo "$name"; done)
    . tests/bits.sh
    run_queue
    check dist sh tests/check_dist.sh
    check builds sh tests/check_builds.sh
    check hygiene sh tests/check_hygiene.sh
    check bindings sh tests/test_bindings.sh --long
    check python_install sh tests/check_python_install.sh
    check lessons make --no-print-directory CC="$CC" lessons
    rm -f build/clang/peri.o build/fast/peri.o build/fast/core.o
    check fast_math make --no-print-directory -j2 CC="$CC" "OWN_fast=$kernels" FAST_CORE= build/fast/peri.o
    rm -f build/fast/core.o # that of make test is another
    check fast_math_bits bits build/fast/peri.o
    program fast_math_callbacks sh -c "$CC build/extremes/*.o build/fast/peri.o -o build/checks/fast_math_callbacks $OPENMP -lm && \
        build/checks/fast_math_callbacks --some write" # NaN is refused
    if command -v clang > /dev/null; then
        check strict_single_file clang $STRICT -O0 -DPERI_KERNELS=3 -DPERI_IMPLEMENTATION -x c -c build/dist/peri.h -o build/checks/single.o
        check strict_clang make --no-print-directory -j2 "OWN_clang=$kernels" build/clang/peri.o
        check same_bits_clang bits build/clang/peri.o
    fi
    if can_sanitize; then
        check sanitized_library $CC $STRICT $SANITIZE -c peri_impl.c -o build/san/serial.o
        check sanitized_extremes_build $CC $STRICT $SANITIZE -DLONGEST=200.0 -I. tests/extremes/*.c build/san/serial.o \
            -o build/san/extremes -lm
        program sanitized_extremes build/san/extremes
        for name in $sanitized test_oracles test_soak; do
            check "build_sanitized_$name" $CC $STRICT $SANITIZE $OPENMP -I. "tests/$name.c" build/san/serial.o -o "build/san/$name" -lm
            case $name in test_callbacks | test_memory | test_plan) whole=--long ;; *) whole= ;; esac
            program "sanitized_$name" "build/san/$name" $whole
        done
    fi
    . tests/sanitizers.sh
    check web sh tests/web/run.sh
fi

for name in $all; do cat "build/queue/$name.sum" 2> /dev/null || echo "0 1 0 $name"; done | sort -k 3 -n -r > build/sums
echo "the longest:"
head -n 5 build/sums | awk '{printf "%8.1f s  %s\n", $3, $4}'
times > build/queue/times
awk -v all="$(seconds build/queue/times)" -v built="$([ ! -f build/build.times ] || seconds build/build.times)" \
    'BEGIN {printf "%.1f s of the processors, and %.1f s to build\n", all, built}'
awk '{passed += $1; failed += $2} END {printf "%d passed, %d failed\n", passed, failed; exit failed > 0}' build/sums
