/* SPDX-License-Identifier: MIT */
/* stiffest.h - the largest eigenvalue of M^-1 K by the power method on peri_multiply_stiffness: an independent way to the stable step. */
#ifndef STIFFEST_H
#define STIFFEST_H

#include "peri_test.h"

/* Of a body of unit density at its displacement; from below, so that 2/sqrt of it is above the true limit. shift: K + shift is iterated,
   where K may have eigenvalues below 0 that are larger in size. */
static inline double stiffest(peri_body *b, double shift, int rounds) {
    const int64_t n = peri_size_of_field(b, PERI_FIELD_VELOCITY), dim = peri_dimension(b);
    double *x = (double *)calloc((size_t)n, sizeof *x), *u = (double *)calloc((size_t)n, sizeof *u);
    double *y = (double *)calloc((size_t)n, sizeof *y), *v = (double *)calloc((size_t)n, sizeof *v), found = 0;
    uint64_t seed = 5;
    int64_t k;
    int it;
    (void)MUST(b, peri_get_field(b, PERI_FIELD_VOLUME, v, n / dim));
    for (k = 0; k < n; ++k) x[k] = test_random(&seed) - 0.5;
    for (it = 0; it < rounds; ++it) {
        double norm = 0;
        for (k = 0; k < n; ++k) norm += x[k] * x[k];
        for (k = 0; k < n; ++k) x[k] /= sqrt(norm), u[k] = x[k] / sqrt(v[k / dim]);
        (void)MUST(b, peri_multiply_stiffness(b, u, y, n));
        found = 0;
        for (k = 0; k < n; ++k) found += u[k] * y[k], x[k] = y[k] / sqrt(v[k / dim]) + shift * x[k];
    }
    free(x), free(u), free(y), free(v);
    return found;
}

#endif
