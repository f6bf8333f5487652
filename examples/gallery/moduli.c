/* SPDX-License-Identifier: MIT */
/* moduli.c - Young's modulus and Poisson's ratio as a plate in tension shows them: [T] 4.2, Figs 4.13 to 4.26.

   double node: strains by the points a horizon away from the middle; internal nodes: mean strains over the points two horizons away
   from all edges; tensor: Hooke's law between the tensors of strain and of collapsed stress in the middle. */
#include "tension.h"

static void row(FILE *file, const char *series, double at, plate p) {
    double strain[2][2] = {{0, 0}, {0, 0}}, count[2] = {0, 0}, e[3], n[3];
    solve_plate(&p);
    double *x = field_of(p.body, PERI_FIELD_POSITION), *u = field_of(p.body, PERI_FIELD_DISPLACEMENT);
    double *eps = field_of(p.body, PERI_FIELD_STRAIN), *sig = field_of(p.body, PERI_FIELD_FORCE_STRESS);
    strain[0][0] = u[2 * (p.middle + p.m)] / p.horizon;
    strain[0][1] = u[2 * (p.middle + p.m * p.columns) + 1] / p.horizon;
    for (int i = 0; i < p.columns * p.rows; ++i) {
        const int column = i % p.columns, line = i / p.columns, edge = 2 * p.m;
        if (column < edge || column >= p.columns - edge || line < edge || line >= p.rows - edge) continue;
        for (int d = 0; d < 2; ++d)
            if (d == 0 ? column != p.columns / 2 : line != p.rows / 2) strain[1][d] += u[2 * i + d] / x[2 * i + d], count[d] += 1;
    }
    for (int d = 0; d < 2; ++d) strain[1][d] /= count[d];
    for (int k = 0; k < 2; ++k) e[k] = stress / strain[k][0], n[k] = -strain[k][1] / strain[k][0];
    const double ex = eps[3 * p.middle], ey = eps[3 * p.middle + 1], sx = sig[3 * p.middle], sy = sig[3 * p.middle + 1];
    const double det = sy * ey - ex * sx; /* Hooke's law solved for nu and E, [T] 4.17 */
    n[2] = (sx * ey - ex * sy) / det, e[2] = (sy * sy - sx * sx) / det;
    fprintf(file, "%s,%g,%g", series, at, p.nu);
    for (int k = 0; k < 3; ++k) fprintf(file, ",%.6g,%.6g", e[k], n[k]);
    fprintf(file, "\n");
    free(x), free(u), free(eps), free(sig);
    peri_body_destroy(p.body);
}

int main(void) {
    const double ratio[5] = {0.1, 0.2, 0.3, 0.4, 0.45}, horizon[4] = {0.5, 0.4, 0.3, 0.2};
    const plate usual = {0.1, 0.3e-3, 3, PERI_INFLUENCE_CONSTANT, PERI_QUADRATURE_RAMP, NULL, 0, 0, 0};
    FILE *file = table("moduli", "series,at,nu,E0,n0,E1,n1,E2,n2");
    plate p = usual;
    for (p.m = 3; p.m <= 5; p.m += 2)
        for (int k = 0; k < 5; ++k) p.nu = ratio[k], row(file, p.m == 3 ? "nu3" : "nu5", p.nu, p);
    p = usual;
    for (int k = 0; k < 4; ++k) p.horizon = horizon[k] * mm, row(file, "horizon", horizon[k], p);
    for (int k = 0; k < 5; k += k == 1 ? 2 : 1)
        for (p = usual, p.nu = ratio[k], p.m = 2; p.m <= 6; ++p.m) row(file, "m", p.m, p);
    fclose(file);

    p = usual, p.m = 6;
    solve_plate(&p); /* u = stress x/E, -nu stress y/E: the solid's displacements, Figs 4.24 to 4.26 */
    map_of("moduli_ux", p.body, PERI_FIELD_DISPLACEMENT, 0), map_of("moduli_uy", p.body, PERI_FIELD_DISPLACEMENT, 1);
    peri_body_destroy(p.body);
    return 0;
}
