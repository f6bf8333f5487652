# SPDX-License-Identifier: MIT
# Sanitizers that want all of a program built for them: of threads, and of memory that was never written (clang). Read by checks.sh and
# run.sh. Threads in make test on a small library, plane and double, not optimised, by clang where there is one, which builds it in half the
# time of gcc; both in make validate on all of it, threads by $CC. A race ends the program.
can_run() { echo 'int main(void){return 0;}' | "$@" -x c - -o build/san/probe 2> /dev/null && build/san/probe; }
races="-g1 -fsanitize=thread"
unwritten="-g1 -fsanitize=memory -fno-sanitize-recover=all"
small="-O0 -DPERI_NO_3D -DPERI_NO_MIXED -DPERI_NO_F32 -DPERI_NO_ADVICE"
memory_tests="test_oracles test_errors test_output"

if can_run $CC $races; then
    if [ -z "$long" ]; then
        racer=$CC
        if command -v clang > /dev/null && can_run clang $races; then racer=clang; fi
        queue_program sanitized_threads "$racer $STRICT $races $small -I. tests/threads.c peri_impl.c -o build/san/threads -lm -lpthread && \
            TSAN_OPTIONS=halt_on_error=1 build/san/threads"
    else
        check build_sanitized_threads $CC $STRICT $races -O1 -I. tests/threads.c peri_impl.c -o build/san/threads -lm -lpthread
        program sanitized_threads env TSAN_OPTIONS=halt_on_error=1 build/san/threads --long
    fi
else
    skip sanitized_threads "no thread sanitizer of $CC on this machine"
fi
if [ -z "$long" ]; then
    : # of memory that was never written: in make validate alone, which has the time
elif command -v clang > /dev/null && can_run clang $unwritten; then
    check build_sanitized_memory clang $STRICT $unwritten -O1 -c peri_impl.c -o build/san/unwritten.o
    for name in $memory_tests; do
        made=build/san/unwritten_$name
        check "build_unwritten_$name" clang $STRICT $unwritten -O0 -I. "tests/$name.c" build/san/unwritten.o -o "$made" -lm
        program "unwritten_$name" "$made"
    done
else
    skip sanitized_memory "no clang with a memory sanitizer on this machine"
fi
