# Checks of the build and of the examples, read by run.sh, and between them its test programs: what takes long runs beside them.

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
check docs sh tests/check_docs.sh
check migrate sh tests/check_migrate.sh
sanitized=""
if can_sanitize; then
    sanitized="test_breaking test_callbacks test_cracks test_criteria test_edges test_errors test_families test_fields test_fragments test_loads \
        test_loadsteps test_loose test_memory test_misuse test_output test_plan test_programs test_quadrature test_random test_search \
        test_solvers"
    queue sanitized_library "make --no-print-directory CC='$CC' SANITIZE='$SANITIZE' build/san/peri.o"
else
    skip sanitized "no sanitizers on this machine"
fi
others=""
if command -v clang > /dev/null; then
    queue strict_clang "make --no-print-directory build/clang/peri.o"
    others="build/clang/peri.o"
    quick=clang
else
    skip strict_clang "no clang on this machine"
fi
queue fast_math "make --no-print-directory CC='$CC' build/fast/peri.o"
# the tokens of peri_impl.c, of peri.h with PERI_IMPLEMENTATION and of the single file are the same (dist): one build stands for all; $CC
# made build/libperi.a with $STRICT, too. Without optimisation clang takes a third of gcc's time for all that vectors ask for
queue "strict_single_file" "$quick $STRICT -O0 -DPERI_KERNELS=3 -DPERI_IMPLEMENTATION -x c -c build/dist/peri.h -o build/checks/single.o"
queue "static_in_two_units" "$quick $STRICT -O0 -DPERI_NO_3D -DPERI_NO_MIXED -DPERI_NO_F32 -I. tests/static_a.c tests/static_b.c \
    -o build/checks/static -lm && build/checks/static"
# parts left out, one line of switches each; without optimisation, so plain kernels
switches() { # switches NAME COMPILER SWITCH...
    name=switches_$1
    out=build/checks/$name
    build="$2 $STRICT -O0"
    shift 2
    for switch; do build="$build -DPERI_NO_$switch"; done
    queue "$name" "$build -c peri_impl.c -o $out.o && $build -I. tests/switches.c $out.o -o $out -lm && $out > $out.text && \
        grep -q . $out.text && ! grep -vxF -f build/checks/switches.text $out.text"
}
check switches $CC $STRICT -I. tests/switches.c build/libperi.a -o build/checks/switches $OPENMP -lm
check switches_whole sh -c 'build/checks/switches > build/checks/switches.text && [ "$(wc -l < build/checks/switches.text)" -eq 48 ]'
switches 2D_double $CC 3D F32 MIXED
switches 3D_single $CC 2D F64 MIXED STATICS ADVICE OUTPUT
switches statics $quick STATICS F64
switches advice $quick ADVICE F32
switches output $quick OUTPUT STDIO MIXED
switches mixed $quick F64 F32
if command -v g++ > /dev/null; then
    queue cxx11 "g++ -std=c++11 -pedantic -Wall -Wextra -Wconversion -Wshadow -Werror -I. tests/cxx_user.cpp build/libperi.a \
        -o build/checks/cxx $OPENMP -lm && build/checks/cxx"
    queue cxx_throws "$CC $STRICT -O0 -fexceptions -DPERI_NO_3D -DPERI_NO_MIXED -DPERI_NO_F32 -c peri_impl.c -o build/checks/throws.o && \
        g++ -std=c++11 -pedantic -Wall -Wextra -Wconversion -Wshadow -Werror -I. tests/cxx_throws.cpp build/checks/throws.o \
        -o build/checks/throws -lm && build/checks/throws"
else
    skip cxx11 "no g++ on this machine"
fi
. tests/check_hygiene.sh
queue install "sh tests/check_install.sh"
if command -v tcc > /dev/null; then
    queue tcc "tcc -I. -c peri_impl.c -o build/checks/tcc.o"
else
    skip tcc "no tcc on this machine"
fi
queue_programs build/tests "" $longest $shorter
run_queue

# ---- the same bits, whatever the vectors and the compiler
bits() { $CC $STRICT -I. tests/bits.c "$1" -o "$1.bits" $OPENMP -lm && "$1.bits" > "$1.text" && cmp "$1.text" build/checks/bits.text; }
$CC $STRICT -I. tests/bits.c build/libperi.a -o build/checks/bits $OPENMP -lm
build/checks/bits > build/checks/bits.text
for other in $others; do check "same_bits_$(echo "$other" | tr / _)" bits "$other"; done

# ---- -ffast-math: the same bits, and NaN is refused
fast=build/fast/peri.o
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
    program test_misuse_py python3 tests/test_misuse.py build/libperi.so build/tests/test_misuse
else
    skip test_ctypes "no python3 on this machine"
fi
