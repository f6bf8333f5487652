/* SPDX-License-Identifier: MIT */
/* pressure.c - a crack under inner pressure in an infinite solid, by three laws: [C] 6, Figs 12 to 15.

   200 x 200 points of 160 m, crack of 10 m, E 60 GPa, nu 0, 0.1 GPa, edges moved by the exact solution, as examples/pressurised.c explains.
   The law of the deformation gradient without stabilization shows the oscillations of [C] Fig. 13, which smoothing with the linear
   influence function takes away ([C] 49, Fig. 14). The error is that of [C] 48 over the whole square, as lengths. */
#include "gallery.h"

enum { N = 200 };
static const double A = 5, SIDE = 160, P = 1e8, YOUNG = 60e9;
static double x[N * N][2], u[N * N][2], smooth[N * N][2];

static void exact(const double *at, double *value) { /* Westergaard, nu = 0 */
    const double px = fabs(at[0]), py = fabs(at[1]), mu = YOUNG / 2, size = hypot(px - A, py) * hypot(px + A, py);
    const double turn = 0.5 * (atan2(py, px - A) + atan2(py, px + A)), re = sqrt(size) * cos(turn), im = sqrt(size) * sin(turn);
    const double z_re = P * ((px * re + py * im) / size - 1), z_im = P * (py * re - px * im) / size;
    value[0] = copysign(1, at[0]) * (P * (re - px) - py * z_im) / (2 * mu);
    value[1] = copysign(1, at[1]) * (2 * P * (im - py) - py * z_re) / (2 * mu);
}

static int32_t far_field(void *user, double factor, int64_t count, const int32_t *points, double *value) {
    (void)user, (void)factor; /* of one step: 1 */
    for (int64_t k = 0; k < count; ++k) exact(x[points[k]], &value[2 * k]);
    return 0;
}

static int32_t outside(void *limit, int64_t index, const double *at) {
    return index >= 0 && fmax(fabs(at[0]), fabs(at[1])) > *(const double *)limit;
}

/* [C] 49 with 1 - |xi|/horizon, not across the crack. */
static void smoothen(double horizon) {
    const double h = SIDE / N;
    const int reach = (int)(horizon / h + 1e-9);
    for (int i = 0; i < N * N; ++i) {
        double sum[3] = {0, 0, 0};
        for (int dy = -reach; dy <= reach; ++dy)
            for (int dx = -reach; dx <= reach; ++dx) {
                const int column = i % N + dx, line = i / N + dy, j = line * N + column;
                const double w = 1 - hypot(dx, dy) * h / horizon;
                if (column < 0 || column >= N || line < 0 || line >= N || w <= 0) continue;
                const double meet = x[i][1] * x[j][1] < 0 ? x[i][0] + (x[j][0] - x[i][0]) * x[i][1] / (x[i][1] - x[j][1]) : HUGE_VAL;
                if (fabs(meet) < A) continue;
                for (int d = 0; d < 2; ++d) sum[d] += w * u[j][d];
                sum[2] += w;
            }
        for (int d = 0; d < 2; ++d) smooth[i][d] = sum[d] / sum[2];
    }
}

static double write_out(FILE *file, const char *panel, double (*field)[2]) {
    double off = 0, all = 0, want[2];
    for (int i = 0; i < N * N; ++i) {
        exact(x[i], want);
        off += pow(field[i][0] - want[0], 2) + pow(field[i][1] - want[1], 2), all += want[0] * want[0] + want[1] * want[1];
        if (fabs(x[i][0]) < 8.5 && fabs(x[i][1]) < 6)
            fprintf(file, "\"%s\",%g,%g,%.6g,%.6g\n", panel, x[i][0], x[i][1], field[i][0], field[i][1]);
    }
    return sqrt(off / all);
}

static double press(FILE *file, const char *panel, int32_t law, double ratio, int smoothed) {
    const double h = SIDE / N, horizon = ratio * h, lo[2] = {-SIDE / 2, -SIDE / 2}, hi[2] = {SIDE / 2, SIDE / 2};
    const double ends[4] = {-A + 1e-6, 0, A - 1e-6, 0};
    const double near_lo[2] = {-A - 2 * horizon, -2 * horizon}, near_hi[2] = {-near_lo[0], -near_lo[1]};
    double limit = SIDE / 2 - 2 * horizon;
    peri_body_desc desc;
    peri_material_desc solid;
    peri_solve_desc statics;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRAIN, desc.geometry = PERI_GEOMETRY_LINEAR, desc.horizon = horizon;
    desc.influence = PERI_INFLUENCE_POWER_3;
    peri_body *block = must_create(&desc);
    peri_material_desc_init(&solid, law);
    solid.young = YOUNG, solid.poisson = 0, solid.density = 2600, solid.stabilization = 0;
    const int32_t material = must(block, peri_add_material(block, &solid));
    must(block, peri_add_box(block, material, lo, hi, h)), must(block, peri_build(block));
    must(block, peri_get_field(block, PERI_FIELD_POSITION, x[0], 2 * N * N));
    must(block, peri_cut_segment(block, PERI_CUT_INITIAL, ends, ends + 2));
    must(block, peri_apply_pressure(block, must(block, peri_select_box(block, NULL, near_lo, near_hi)), P, NULL, NULL));
    const int32_t edge = must(block, peri_select_if(block, NULL, outside, &limit));
    must(block, peri_prescribe_displacement(block, edge, PERI_AXIS_XY, NULL, far_field, NULL));
    peri_solve_desc_init(&statics);
    statics.tolerance = 1e-6;
    must(block, peri_solve(block, &statics, NULL));
    must(block, peri_get_field(block, PERI_FIELD_DISPLACEMENT, u[0], 2 * N * N));
    peri_body_destroy(block);
    if (smoothed) smoothen(horizon);
    return write_out(file, panel, smoothed ? smooth : u);
}

int main(void) {
    FILE *file = table("pressure", "panel,x,y,ux,uy"), *f = figures_of("pressure");
    const double ratio[2] = {1.5, 2.5}, rough[2] = {21.05, 54.09}, even[2] = {7.08, 6.70}; /* [C] table 7 */
    char panel[64];
    for (int k = 0; k < 2; ++k) {
        snprintf(panel, sizeof panel, "gradient, horizon %.1f spacings", ratio[k]);
        figure(f, panel, 100 * press(file, panel, PERI_LAW_CORRESPONDENCE, ratio[k], 0), rough[k], 0, "%");
        snprintf(panel, sizeof panel, "gradient, %.1f, smoothed", ratio[k]);
        figure(f, panel, 100 * press(file, panel, PERI_LAW_CORRESPONDENCE, ratio[k], 1), even[k], 0, "%");
    }
    figure(f, "LPS, 3.5; reference: the least of [C] table 8", 100 * press(file, "LPS", PERI_LAW_LPS, 3.5, 0), 2.2, 0, "%");
    figure(f, "Oterkus, 3.5; likewise", 100 * press(file, "Oterkus", PERI_LAW_OTERKUS, 3.5, 0), 5.7, 0, "%");
    for (int i = 0; i < N * N; ++i) exact(x[i], u[i]);
    (void)write_out(file, "exact", u);
    fclose(file), fclose(f);
    return 0;
}
