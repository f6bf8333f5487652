/* SPDX-License-Identifier: MIT */
/* static_a.c - one of two units that both hold a private copy of the library (PERI_STATIC), linked together. main is here.
   SOURCE OF TRUTH: the same program text twice gives the same bits; and a free body keeps the momentum that it got. */
#define PERI_STATIC
#define PERI_IMPLEMENTATION
#include "../peri.h"
#include "two_copies.h"

double static_b_run(double *displacement, int32_t count);

int main(void) {
    double a[2 * 64], b[2 * 64], momentum_a, momentum_b, want = 0.25 * 2.0 * 0.64 * 0.5;
    int k, failed = 0;
    momentum_a = two_copies_run(a, 2 * 64);
    momentum_b = static_b_run(b, 2 * 64);
    for (k = 0; k < 2 * 64; ++k)
        if (a[k] != b[k] || !(fabs(a[k]) < 1)) failed++;
    if (momentum_a != momentum_b || !(fabs(momentum_a - want) <= 1e-12 * want)) failed++;
    printf("static: %d passed, %d failed\n", failed ? 0 : 1, failed);
    return failed;
}
