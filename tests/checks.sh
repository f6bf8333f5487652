# Checks of the build and of the examples, read by run.sh. They use check, program and skip.

# ---- the examples run as they are
for source in examples/*.c; do
    name=$(basename "$source" .c)
    queue "example_$name" "build/examples/$name"
done
check example_length sh -c 'for e in examples/*.c; do
    lines=$(wc -l < $e); [ $lines -lt 80 ] || { echo "$e: $lines lines"; exit 1; }; done'

# ---- every way to compile it
quick=$CC
check dist sh tests/check_dist.sh
sanitized=""
if can_sanitize; then
    sanitized="test_breaking test_cracks test_criteria test_edges test_errors test_families test_fields test_fragments test_loads \
        test_loadsteps test_loose test_memory test_output test_plan test_programs test_quadrature test_random test_search \
        test_solvers"
    queue sanitized_library "$CC $STRICT $SANITIZE $OPENMP -c peri_impl.c -o build/san/peri.o"
else
    skip sanitized "no sanitizers on this machine"
fi
for compiler in gcc clang; do
    if ! command -v $compiler > /dev/null; then skip "strict_$compiler" "no $compiler on this machine"; continue; fi
    out=build/checks/$compiler
    vectors=PERI_PLAIN
    [ $compiler = clang ] || vectors=PERI_PORTABLE
    queue "${compiler}_${vectors}_no_stdio" "$compiler $STRICT -O1 -DPERI_NO_STDIO -D$vectors -c peri_impl.c -o $out.other.o"
    quick=$compiler
done
queue fast_math "$CC $STRICT -O1 -ffast-math -c peri_impl.c -o build/checks/fast.o"
# the tokens of peri_impl.c, of peri.h with PERI_IMPLEMENTATION and of the single file are the same (dist): one build stands for all; $CC
# made build/libperi.a with $STRICT, too. Without optimisation clang takes a fifth of gcc's time
queue "strict_single_file" "$quick $STRICT -O0 -DPERI_IMPLEMENTATION -x c -c build/dist/peri.h -o build/checks/single.o"
queue "static_in_two_units" "$quick $STRICT -O0 -DPERI_PLAIN -I. tests/static_a.c tests/static_b.c -o build/checks/static -lm && \
    build/checks/static"
if command -v g++ > /dev/null; then
    queue cxx11 "g++ -std=c++11 -pedantic -Wall -Wextra -Wconversion -Wshadow -Werror -I. tests/cxx_user.cpp build/libperi.a \
        -o build/checks/cxx $OPENMP -lm && build/checks/cxx"
else
    skip cxx11 "no g++ on this machine"
fi
if command -v tcc > /dev/null; then
    queue tcc "tcc -I. -c peri_impl.c -o build/checks/tcc.o"
else
    skip tcc "no tcc on this machine"
fi
run_queue

# ---- the same bits, whatever the vectors and the compiler
bits() { $CC $STRICT -I. tests/bits.c "$1" -o "$1.bits" $OPENMP -lm && "$1.bits" > "$1.text" && cmp "$1.text" build/checks/bits.text; }
$CC $STRICT -I. tests/bits.c build/libperi.a -o build/checks/bits $OPENMP -lm
build/checks/bits > build/checks/bits.text
for other in build/checks/*.other.o; do check "same_bits_$(basename "$other" .other.o)" bits "$other"; done

# ---- -ffast-math: the same bits, and NaN is refused
fast=build/checks/fast.o
check fast_math_bits bits $fast
$CC build/extremes/*.o $fast -o build/checks/fast_math_callbacks $OPENMP -lm
program fast_math_callbacks build/checks/fast_math_callbacks callbacks

# ---- under sanitizers, what is quick enough
if [ -n "$sanitized" ]; then
    printf '%s\n' $sanitized |
        xargs -P 2 -I % sh -c "$CC $STRICT $SANITIZE $OPENMP -I. tests/%.c build/san/peri.o -o build/san/% -lm"
    programs build/san sanitized_ $sanitized
fi

if command -v python3 > /dev/null; then
    check ctypes_build $CC $STRICT -O2 -I. tests/ctypes_scene.c build/libperi.a -o build/checks/ctypes_scene $OPENMP -lm
    program test_ctypes python3 tests/test_ctypes.py build/libperi.so build/checks/ctypes_scene
else
    skip test_ctypes "no python3 on this machine"
fi
