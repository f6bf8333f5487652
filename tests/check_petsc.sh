#!/bin/sh
# SPDX-License-Identifier: MIT
# examples/petsc on 1, 2 and 4 processes. SOURCE OF TRUTH: peri_solve, which other tests show to find equilibria: the same displacement to
# 9 digits in no more than 1.3 times its iterations, and the same softening curve. A machine without PETSc skips this.
cd "$(dirname "$0")/.." || exit 1
{ command -v mpicc && command -v mpirun && pkg-config --exists petsc; } > /dev/null 2>&1 || { echo "petsc: none here, skipped"; exit 0; }
dir=build/checks/petsc
rm -rf $dir
mkdir -p $dir
for name in plate crack; do
    # shellcheck disable=SC2046
    mpicc -std=c99 -Wall -Wextra -O1 -I. $(pkg-config --cflags petsc) examples/petsc/$name.c build/libperi.a $(pkg-config --libs petsc) \
        $OPENMP -fopenmp -lm -o $dir/$name || exit 1
done
. tests/processes.sh
cd $dir || exit 1
export OMP_NUM_THREADS=1
run() { # N PROGRAM ARGUMENTS
    processes 100 "$@" > text 2> errors || { cat text errors; exit 1; }
    tail -1 text | sed -e "s/^/petsc: /"
}
for n in 1 2 4; do
    run $n ./plate -cells 40
    awk '{ exit !($NF < 1e-9 && $6 > 5 && $6 <= 1.3 * $11) }' text || { echo "petsc: too far, or too slow"; exit 1; }
done
run 2 ./crack
awk 'END { exit !($8 > 100 && $11 == 0 && $NF < 1e-9) }' text || { echo "petsc: another curve"; exit 1; }
