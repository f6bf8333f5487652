/* SPDX-License-Identifier: MIT */
/* static_b.c - the other unit: see static_a.c. */
#define PERI_STATIC
#define PERI_IMPLEMENTATION
#include "../peri.h"
#include "two_copies.h"

double static_b_run(double *displacement, int32_t count);
double static_b_run(double *displacement, int32_t count) { return two_copies_run(displacement, count); }
