/* SPDX-License-Identifier: MIT */
/* A bar pulled by consistent tractions to half the load and then to all of it, as it was written for peri 0.1: settings by their old names,
   the load factor by hand. Hooke's law is what it must give. */
#include "peri.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static int32_t watch(void *user, int64_t iteration, double residual) {
    (void)residual;
    *(int64_t *)user = iteration;
    return 0;
}

int main(void) {
    const double lo[2] = {0, 0}, hi[2] = {20, 10}, left[2] = {-1, 0}, right[2] = {1, 0}, pull[2] = {1e-4, 0}, push[2] = {-1e-4, 0};
    const double half[2] = {10, 10}, middle[2] = {10, 0};
    double curve[2][6];
    int64_t iterations = 0;
    peri_body_desc desc;
    peri_material steel;
    peri_statics solve;
    peri_statics_report report;
    peri_energy energy;
    peri_matrix *stiffness;
    peri_body *bar;
    peri_body_desc_init(&desc);
    desc.space = PERI_PLANE_STRAIN;
    desc.geometry = PERI_LINEAR;
    desc.influence = PERI_INFLUENCE_GAUSSIAN;
    desc.correction = PERI_NO_CORRECTION;
    desc.horizon = 2;
    if (peri_body_create(&desc, &bar, NULL) < 0) return 1;
    peri_material_init(&steel, PERI_CORRESPONDENCE);
    steel.young = 1;
    steel.poisson = 0.3;
    steel.density = 1;
    peri_add_box(bar, peri_add_material(bar, &steel), lo, hi, 1);
    if (peri_build(bar) < 0) return 1;
    const int32_t first = peri_select_box(bar, "left", lo, half);
    const int32_t second = peri_select_box(bar, "right", middle, hi);
    peri_apply_surface_traction(bar, first, 10, left, push, NULL, NULL);
    const int32_t load = peri_apply_surface_traction(bar, second, 10, right, pull, NULL, NULL);

    peri_statics_init(&solve);
    solve.method = PERI_NEWTON;
    solve.preconditioner = PERI_BLOCK_JACOBI;
    solve.loose = PERI_LOOSE_PINNED;
    solve.curve_load = load;
    solve.curve = curve[0];
    solve.curve_rows = 2;
    solve.load_to = 0.5;
    solve.on_iteration = watch;
    solve.user = &iterations;
    if (peri_solve(bar, &solve, &report) < 0) return 1;
    solve.load_from = 0.5;
    solve.load_to = 1;
    if (peri_solve(bar, &solve, &report) < 0 || peri_read_energy(bar, &energy) < 0) return 1;

    const int64_t size = peri_field_size(bar, PERI_STRAIN);
    double *strain = (double *)malloc(sizeof *strain * (size_t)size), want = 1e-4 * (1 - 0.3 * 0.3), worst = 0;
    if (!strain || peri_read(bar, PERI_STRAIN, strain, size) < 0) return 1;
    for (int64_t k = 0; k < size; k += 3) worst = fmax(worst, fabs(strain[k] / want - 1));
    if (peri_assemble(bar, &stiffness) < 0) return 1;
    printf("strain off by %.1e, %d iterations, %d rows of the matrix\n", worst, (int)iterations, (int)peri_matrix_rows(stiffness));
    peri_matrix_destroy(stiffness);
    free(strain);
    peri_body_destroy(bar);
    return !(worst < 1e-6 && report.curve_rows == 1 && fabs(energy.elastic / (0.5 * 1e-4 * want * 200) - 1) < 1e-6);
}
