#!/bin/sh
# SPDX-License-Identifier: MIT
# examples/mpi on 1 and on 3 processes. SOURCE OF TRUTH: the text of the example: its file has the same bytes for any number of processes.
# A machine without mpicc skips this.
cd "$(dirname "$0")/.." || exit 1
command -v mpicc > /dev/null && command -v mpirun > /dev/null || { echo "mpi: no mpicc, skipped"; exit 0; }
dir=build/checks/mpi
rm -rf $dir
mkdir -p $dir/out
mpicc -std=c99 -pedantic -Wall -Wextra -O1 -I. examples/mpi/branching.c build/libperi.a $OPENMP -fopenmp -lm -o $dir/branching || exit 1
cd $dir || exit 1
[ "$(id -u)" != 0 ] || root=--allow-run-as-root
for n in 1 3; do
    timeout 60 mpirun $root --oversubscribe -n $n ./branching > text.$n 2> errors.$n || { cat errors.$n; exit 1; }
    mv out/mpi_branching.bin $n.bin
    [ "$(wc -c < $n.bin)" -eq 96000 ] || { echo "mpi: $n processes wrote $(wc -c < $n.bin) bytes"; exit 1; }
done
cmp 1.bin 3.bin || exit 1
[ "$(grep -c '<Piece' out/mpi_branching.pvtu)" -eq 3 ] && [ -s out/mpi_branching_2.vtu ] || exit 1
echo "mpi: the same bytes on 1 and 3 processes"
