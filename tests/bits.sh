# SPDX-License-Identifier: MIT
# The same bits, whatever the vectors and the compiler: read by run.sh and checks.sh. The check bits writes bits.text, those of the
# library, which others are compared with after run_queue.
kernels="d2 d3 m2 m3 f2 f3"
queue bits "$CC $STRICT -I. -c tests/bits.c -o build/checks/bits.o && \
    $CC build/checks/bits.o build/libperi.a -o build/checks/bits $OPENMP -lm && build/checks/bits > build/checks/bits.text"
bits_of() { echo "$CC build/checks/bits.o $1 -o $1.bits $OPENMP -lm && $1.bits > $1.text && cmp $1.text build/checks/bits.text"; }
bits() { sh -c "$(bits_of "$1")"; }
