#!/bin/sh
# Runs every test and closes with "N passed, N failed". What a machine lacks is skipped with a message.
#   run.sh          the tests of `make test`
#   run.sh --long   the test programs with their long tables (make validate)
cd "$(dirname "$0")/.." || exit 1
long=$1
passed=0
failed=0

tally() { # one "<program>: N passed, N failed" line, and what came before it
    sum=$(tail -n 1 "$1" | sed -n 's/^[^:]*: \([0-9]*\) passed, \([0-9]*\) failed$/\1 \2/p')
    if [ -z "$sum" ]; then
        failed=$((failed + 1))
        echo "  FAIL: ended without a result"
    else
        passed=$((passed + ${sum% *}))
        failed=$((failed + ${sum#* }))
    fi
}

show() { # show NAME: the log of a test program, and its tally
    echo "== $1"
    if [ -n "$long" ]; then cat "build/$1.log"; else grep -v '^  pass ' "build/$1.log"; fi
    tally "build/$1.log"
}

program() { # program NAME COMMAND...
    name=$1
    shift
    "$@" > "build/$name.log" 2>&1
    show "$name"
}

programs() { # programs DIRECTORY PREFIX NAME...: two at a time
    directory=$1
    prefix=$2
    shift 2
    printf '%s\n' "$@" | xargs -P 2 -I % sh -c "$directory/% $long > build/$prefix%.log 2>&1"
    for name; do show "$prefix$name"; done
}

check() { # check NAME COMMAND...: passes when the command does
    name=$1
    shift
    "$@" > "build/$name.log" 2>&1
    verdict "$name" $?
}

verdict() { # verdict NAME STATUS, of what has left its log
    if [ "$2" -eq 0 ]; then
        passed=$((passed + 1))
        echo "pass $1"
    else
        failed=$((failed + 1))
        echo "FAIL $1"
        tail -n 20 "build/$1.log"
    fi
}

queued=""
queue() { # queue NAME COMMAND: a check for run_queue, COMMAND one line of shell
    echo "$2" > "build/queue/$1.sh"
    queued="$queued $1"
}

run_queue() { # two at a time
    printf '%s\n' $queued | xargs -P 2 -I % sh -c 'sh build/queue/%.sh > build/%.log 2>&1; echo $? > build/queue/%.status'
    for name in $queued; do verdict "$name" "$(cat "build/queue/$name.status")"; done
    queued=""
}

skip() { echo "skip $1: $2"; }

STRICT="-std=c99 -pedantic -Wall -Wextra -Wconversion -Wshadow -Wundef -Werror"
SANITIZE="-g1 -O1 -fsanitize=address,undefined -fno-sanitize-recover=all"
CC=${CC:-cc}
can_sanitize() { echo 'int main(void){return 0;}' | $CC $SANITIZE -x c - -o build/san/probe 2> /dev/null && build/san/probe; }

mkdir -p build/queue build/checks build/san out
# the longest first
programs build/tests "" extremes test_kernels test_choose $(basename -s .c tests/test_*.c | grep -v -e test_kernels -e test_choose)

if [ -z "$long" ]; then
    . tests/checks.sh
elif can_sanitize; then
    check sanitized_library $CC $STRICT $SANITIZE -c peri_impl.c -o build/san/serial.o
    check sanitized_extremes_build $CC $STRICT $SANITIZE -DLONGEST=200.0 -I. tests/extremes/*.c build/san/serial.o -o build/san/extremes -lm
    program sanitized_extremes build/san/extremes
fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
