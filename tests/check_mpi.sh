#!/bin/sh
# SPDX-License-Identifier: MIT
# examples/mpi on 1 and on 3 processes. SOURCE OF TRUTH: the text of the example: its file has the same bytes for any number of processes.
# A machine without mpicc skips this.
cd "$(dirname "$0")/.." || exit 1
command -v mpicc > /dev/null && command -v mpirun > /dev/null || { echo "mpi: no mpicc, skipped"; exit 0; }
dir=build/checks/mpi
rm -rf $dir
mkdir -p $dir/out
for name in branching impact; do
    mpicc -std=c99 -pedantic -Wall -Wextra -O1 -I. examples/mpi/$name.c build/libperi.a $OPENMP -fopenmp -lm -o $dir/$name || exit 1
done
. tests/processes.sh
cd $dir || exit 1
run() { # NAME BYTES
    for n in 1 3; do
        processes 60 $n ./"$1" > "$1.$n" 2> errors || { cat errors; exit 1; }
        mv "out/mpi_$1.bin" "$1.$n.bin"
        [ "$(wc -c < "$1.$n.bin")" -eq "$2" ] || { echo "mpi: $n processes wrote $(wc -c < "$1.$n.bin") bytes"; exit 1; }
    done
    cmp "$1.1.bin" "$1.3.bin" || exit 1
    sed -e "s/^/mpi: /" "$1.3"
}
run branching 96000
[ "$(grep -c '<Piece' out/mpi_branching.pvtu)" -eq 3 ] && [ -s out/mpi_branching_2.vtu ] || exit 1
run impact 41472
awk '{ exit !($3 > 1000) }' impact.3 || { echo "mpi: little breaks"; exit 1; }
# a film: each frame of the list has its pieces
frames=$(sed -n 's/.*file="\(.*\)".*/\1/p' out/mpi_impact.pvd)
[ "$(echo "$frames" | wc -l)" -ge 3 ] || exit 1
for frame in $frames; do
    for piece in $(sed -n 's/.*Piece Source="\(.*\)".*/\1/p' "out/$frame"); do [ -s "out/$piece" ] || { echo "mpi: no $piece"; exit 1; }; done
done
echo "mpi: the same bytes on 1 and 3 processes"
