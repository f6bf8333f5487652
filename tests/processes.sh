# SPDX-License-Identifier: MIT
# To be read by a shell: processes SECONDS N PROGRAM ... runs N processes by mpirun. All take turns on one processor, where that can be had:
# those that wait for others ask again and again, and give way at once to one on the same processor, but not to other work on theirs.
[ "$(id -u)" != 0 ] || root=--allow-run-as-root
if taskset -c 0 true 2> /dev/null; then one="taskset -c 0"; fi
processes() {
    limit=$1 ranks=$2
    shift 2
    # shellcheck disable=SC2086
    $one timeout "$limit" mpirun $root --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -n "$ranks" "$@"
}
