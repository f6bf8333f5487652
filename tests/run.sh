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
    if "$@" > "build/$name.log" 2>&1; then
        passed=$((passed + 1))
        echo "pass $name"
    else
        failed=$((failed + 1))
        echo "FAIL $name"
        tail -n 20 "build/$name.log"
    fi
}

skip() { echo "skip $1: $2"; }

mkdir -p build out
programs build/tests "" $(basename -s .c tests/test_*.c)

if [ -z "$long" ]; then
    . tests/checks.sh
fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
