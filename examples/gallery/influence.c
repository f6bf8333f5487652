/* SPDX-License-Identifier: MIT */
/* influence.c - what the influence function does to the displacement of a plate in tension: [T] 4.2.3, Figs 4.27 to 4.45.

   The kernel of a bond is the trace of the block of the stiffness matrix that couples its two points, here along the row of the middle
   point: points feel each other up to two horizons away. The pole at horizon/2 is left out: with m = 6 points stand at it. */
#include "tension.h"

static double weigh(int32_t influence, double q, double m) {
    switch (influence) {
        case PERI_INFLUENCE_GAUSSIAN: return exp(-q * q);
        case PERI_INFLUENCE_PROPORTIONAL: return q;
        case PERI_INFLUENCE_LINEAR: return 1 - q;
        case PERI_INFLUENCE_INVERSE: return 1 / q;
        case PERI_INFLUENCE_INVERSE_4: return pow(q, -4);
        case PERI_INFLUENCE_POLE_EDGE: return 1 / (1 + 0.5 / m - q);
        default: return 1;
    }
}

int main(void) {
    const int32_t influence[7] = {PERI_INFLUENCE_CONSTANT, PERI_INFLUENCE_GAUSSIAN, PERI_INFLUENCE_PROPORTIONAL, PERI_INFLUENCE_LINEAR,
                                  PERI_INFLUENCE_INVERSE, PERI_INFLUENCE_INVERSE_4, PERI_INFLUENCE_POLE_EDGE};
    FILE *kernels = table("influence_kernels", "function,q,w,kernel"), *errors = table("influence_errors", "function,x,y,percent");
    for (int k = 0; k < 7; ++k) {
        plate p = {0.1, 0.3e-3, 6, 0, PERI_QUADRATURE_RAMP, NULL, 0, 0, 0};
        p.influence = influence[k];
        solve_plate(&p);
        const int n = p.columns * p.rows;
        double *x = field_of(p.body, PERI_FIELD_POSITION), *u = field_of(p.body, PERI_FIELD_DISPLACEMENT), *row[2];
        for (int d = 0; d < 2; ++d) { /* the columns of the matrix that belong to the middle point */
            row[d] = (double *)calloc((size_t)(2 * n), sizeof *row[d]);
            if (!row[d]) return EXIT_FAILURE;
            row[d][2 * p.middle + d] = 1;
            must(p.body, peri_multiply_stiffness(p.body, row[d], row[d], 2 * n));
        }
        const double own = row[0][2 * (p.middle + 1)] + row[1][2 * (p.middle + 1) + 1];
        for (int j = 1; j <= 2 * p.m + 2; ++j) {
            const double q = (double)j / p.m, trace = row[0][2 * (p.middle + j)] + row[1][2 * (p.middle + j) + 1];
            fprintf(kernels, "%d,%g,%g,%g\n", k, q, q <= 1 ? weigh(p.influence, q, p.m) : 0, trace / own);
        }
        for (int i = 0; i < n; ++i) /* the right half, as in [T] */
            if (x[2 * i] > 0.05 * mm)
                fprintf(errors, "%d,%.7g,%.7g,%.5g\n", k, x[2 * i], x[2 * i + 1], 100 * (u[2 * i] / (stress * x[2 * i] / young) - 1));
        free(x), free(u), free(row[0]), free(row[1]);
        peri_body_destroy(p.body);
    }
    fclose(kernels), fclose(errors);
    return 0;
}
