# SPDX-License-Identifier: MIT
# Checks of the build and of the examples, read by run.sh, and between them its test programs: what takes long runs beside them.

# ---- every way to compile it
quick=$CC
can_sanitize=""
if can_sanitize; then
    can_sanitize=yes
    queue sanitized_library "make --no-print-directory CC='$CC' build/san/peri.o"
else
    skip sanitized "no sanitizers on this machine"
fi
queue_program extremes "build/tests/extremes --some"
. tests/sanitizers.sh
if command -v clang > /dev/null; then
    queue strict_clang "clang $STRICT -fsyntax-only -DPERI_KERNELS=1 -DPERI_NO_STDIO peri_impl.c" # make validate compiles it
    quick=clang
else
    skip strict_clang "no clang on this machine"
fi
# the same bits, whatever the vectors: of the library here, for others
. tests/bits.sh
# the tokens of peri_impl.c, of peri.h with PERI_IMPLEMENTATION and of the single file are the same (dist): one build stands for all; $CC
# made build/libperi.a with $STRICT, too. Here the text with all vectors is read by the strict compiler, in make validate compiled
queue dist "sh tests/check_dist.sh --quick"
queue strict_single_file "awk -f tools/dist.awk peri.h > build/checks/single.h && \
    $quick $STRICT -fsyntax-only -DPERI_KERNELS=3 -DPERI_IMPLEMENTATION -x c build/checks/single.h"
queue static_in_two_units "$quick $STRICT -O0 -DPERI_NO_3D -DPERI_NO_MIXED -DPERI_NO_F32 -I. tests/static_a.c tests/static_b.c \
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
switches 2D_double $quick 3D F32 MIXED
switches 3D_single "$CC" 2D F64 MIXED STATICS ADVICE OUTPUT
switches statics $quick STATICS ADVICE F64
switches output $quick OUTPUT STDIO MIXED 2D
switches mixed $quick F64 F32
if command -v g++ > /dev/null; then
    queue cxx11 "g++ -std=c++11 -pedantic -Wall -Wextra -Wconversion -Wshadow -Werror -I. tests/cxx_user.cpp build/libperi.a \
        -o build/checks/cxx $OPENMP -lm && build/checks/cxx"
    queue cxx_view "echo '#include \"extras/peri_view.h\"' | g++ -std=c++11 -pedantic -Wall -Wextra -Wconversion -Wshadow -Werror -I. \
        -x c++ -fsyntax-only -"
    queue cxx_throws "$quick $STRICT -O0 -fexceptions -DPERI_NO_3D -DPERI_NO_MIXED -DPERI_NO_F32 -c peri_impl.c -o build/checks/throws.o && \
        g++ -std=c++11 -pedantic -Wall -Wextra -Wconversion -Wshadow -Werror -I. tests/cxx_throws.cpp build/checks/throws.o \
        -o build/checks/throws -lm && build/checks/throws"
else
    skip cxx11 "no g++ on this machine"
fi
queue bindings "CC='$CC' OPENMP='$OPENMP' sh tests/test_bindings.sh"
. tests/check_hygiene.sh
queue install "sh tests/check_install.sh"
queue docs "sh tests/check_docs.sh"
queue migrate "sh tests/check_migrate.sh"
queue tools "sh tests/check_tools.sh"
queue run "CC='$CC' OPENMP='$OPENMP' OMP_WAIT_POLICY=passive sh tests/check_run.sh"
queue mpi "OPENMP='$OPENMP' sh tests/check_mpi.sh"
queue petsc "OPENMP='$OPENMP' sh tests/check_petsc.sh"
queue promises "CC='$CC' OPENMP='$OPENMP' sh tests/check_promises.sh"
if command -v tcc > /dev/null; then
    queue tcc "tcc -I. -c peri_impl.c -o build/checks/tcc.o"
else
    skip tcc "no tcc on this machine"
fi
# ---- the examples run as they are
for source in examples/*.c; do
    name=$(basename "$source" .c)
    queue "example_$name" "build/examples/$name"
done
queue example_length 'for e in examples/*.c; do
    lines=$(wc -l < $e); [ $lines -lt 80 ] || { echo "$e: $lines lines"; exit 1; }; done'

# ---- under sanitizers, what is quick enough. The tests themselves as they are: the library sees what they give it; two that ask whether
# ---- they are sanitized are compiled so. make validate does so with all, and leaves out nothing
left_out() { # left_out NAME: the cases that take longest, and whose calls others make
    case $1 in
    test_callbacks) # they take their memory in the same places
        echo -first_calls_of_other_solves -last_calls -last_calls_of_solves -on_a_list -with_corrected_weights ;;
    test_cracks) echo -segments -triangles -rectangles -discs ;; # cut by misuses, programs and other scenes
    test_criteria) echo -planes_take_g0 -a_pair_breaks_at_its_energy -uniform_strain_breaks_what_it_must ;;
    test_edges) echo -callbacks_read_and_do_no_harm ;; # programs call all in callbacks
    test_families) echo -lattice_counts_2d -lattice_counts_3d -clouds ;;
    test_fields) echo -affine_strain_is_exact -static_pull -force_stress_is_the_stress ;;
    test_fragments) echo -remnants_of_families -stable_step_is_safe -the_step_follows ;;
    test_loads) # the same steps over and over; programs and callbacks move obstacles
        echo -moving_obstacles_push -free_fall_is_a_parabola ;;
    # a body that sanitized kernels time takes longer than any machine would
    test_plan) echo -measuring_builds_and_frees_a_small_body -huge_bodies_are_counted_or_refused -memory_is_what_the_allocator_counts \
        -corrections_and_large_families_are_planned -lattices_are_planned_exactly \
        -quadratures_and_influences_are_planned_exactly -clouds_are_planned_to_5_percent ;;
    test_quadrature) echo -lattices_3d -own_points -second_moments -momentum ;;
    test_search) echo -densities -thin_clouds -renumbered -lattices -constants_shared ;;
    test_solvers) echo -equals_a_dense_factorisation -stiffness_is_its_product ;;
    esac
}
# What runs under sanitizers does not run again without, but for the cases that are left out there; make validate runs all.
for name in $longest $shorter; do
    case " $sanitized " in
    *" $name "*)
        rest=$(left_out "$name" | sed 's/-/+/; s/ -/ +/g')
        if [ -z "$can_sanitize" ] || [ "$name" = test_random ]; then queue_programs "$name"
        elif [ -n "$rest" ]; then queue_program "$name" "build/tests/$name $rest"
        fi ;;
    *) [ "$name" = extremes ] || queue_programs "$name" ;;
    esac
done
run_queue
if [ -n "$can_sanitize" ]; then
    for name in $sanitized; do
        [ "$name" != test_random ] || continue # random programs do the same in small
        object=build/tests/$name.o
        case $name in test_memory | test_programs) object="$STRICT $SANITIZE -O0 -I. tests/$name.c" ;; esac
        queue_program "sanitized_$name" "$CC -fsanitize=address,undefined $OPENMP $object build/san/peri.o -o build/san/$name -lm && \
            build/san/$name $(left_out $name)"
    done
fi

if command -v python3 > /dev/null; then
    queue_program test_ctypes "$CC $STRICT -O2 -I. tests/ctypes_scene.c build/libperi.a -o build/checks/ctypes_scene $OPENMP -lm && \
        python3 tests/test_ctypes.py build/libperi.so build/checks/ctypes_scene"
    queue_program test_misuse_py "python3 tests/test_misuse.py build/libperi.so build/tests/test_misuse"
else
    skip test_ctypes "no python3 on this machine"
fi
python=$(for p in python3 /usr/bin/python3; do $p -c 'import numpy' 2> /dev/null && echo $p && break; done)
if [ -n "$python" ]; then
    queue_program test_series_py "$python tests/test_series.py build/tests/test_series"
    queue_program test_python "CC='$CC' OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $python tests/test_python.py build/python build/tests/binding_scenes"
    if $python -c 'import matplotlib' 2> /dev/null; then
        queue lesson_1 "mkdir -p out/lessons && PYTHONPATH=build/python MPLBACKEND=Agg $python docs/lessons/1_bar.py" # make validate: all
    else
        skip lesson_1 "no matplotlib on this machine"
    fi
else
    skip test_python "no python3 with NumPy on this machine"
fi
run_queue
