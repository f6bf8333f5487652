/* SPDX-License-Identifier: MIT */
/* test_direction.c - the direction in which a crack sets out depends on Poisson's ratio ([T] 5.2, Figs 5.6-5.9).

   A square plate of side a, notched along half of its middle line, is pulled and sheared alike: both edges move by v t/2 across and along.
   In the plate without its notch sigma_yy = E v t/a and sigma_xy = mu v t/a, so the largest principal stress opens a crack at
       psi = 1/2 arctan(2 mu/E) = 1/2 arctan(1/(1+nu))
   to the notch, downwards ([T] 5.1, 5.2). Plane stress, LPS, s0 = 0.1 %, as the thesis; size and rate, which it does not state, are chosen
   here: horizon a/20, v = 5e-5 sqrt(E/rho), motion starting as v y/a everywhere so that no shock runs ahead. psi is the direction of the
   undisturbed field. A tip that is small beside the plate obeys the mixed-mode stress intensities instead, which turn it further: with a
   horizon of a/32 the angles are 3 to 6 degrees larger. */
#include "specimen.h"

typedef struct crack {
    const double *x;
    double        sum[5], reach, horizon, end; /* sums of 1, x, y, xx, xy over the middles of broken bonds                */
} crack;

static int32_t note(void *user, int32_t i, int32_t j, double time, double stretch) {
    crack *c = (crack *)user;
    double x = 0.5 * (c->x[2 * i] + c->x[2 * j]), y = 0.5 * (c->x[2 * i + 1] + c->x[2 * j + 1]);
    (void)time;
    (void)stretch;
    c->reach = fmax(c->reach, x);
    if (x < 0.5 * c->horizon || x > c->end - 0.5 * c->horizon) return 0; /* off the tip and the front                       */
    c->sum[0] += 1;
    c->sum[1] += x;
    c->sum[2] += y;
    c->sum[3] += x * x;
    c->sum[4] += x * y;
    return 0;
}

/* Angle of the first 0.15 a of the crack below the notch, in degrees. cells: per side; m = horizon/spacing. */
static double angle(double nu, int cells, int m) {
    const double h = 1.0 / cells, zone = m * h, speed = 5e-5;
    const double lo[2] = {-0.5, -0.5}, hi[2] = {0.5, 0.5}, edge[2] = {-0.5, 0}, tip[2] = {0, 0};
    const double top[2] = {-0.5, 0.5 - zone}, bottom[2] = {0.5, zone - 0.5}, top2[2] = {-0.5, 0.5 - 2 * zone};
    const double bottom2[2] = {0.5, 2 * zone - 0.5}, up[2] = {speed / 2, speed / 2}, down[2] = {-speed / 2, -speed / 2};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, nu, h, m, cells, cells, 1);
    peri_body *b;
    peri_advance_desc run;
    crack c;
    double *x, *v;
    int64_t n, i;
    for (int d = 0; d < 2; ++d) {
        s.lo[d] = lo[d];
        s.hi[d] = hi[d];
    }
    s.material.critical_stretch = 1e-3;
    b = specimen_make(&s);
    MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, edge, tip));
    MUST(b, peri_prescribe_velocity(b, (int32_t)MUST(b, peri_select_box(b, NULL, top, hi)), PERI_AXIS_XY, up, NULL, NULL));
    MUST(b, peri_prescribe_velocity(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, bottom)), PERI_AXIS_XY, down, NULL, NULL));
    MUST(b, peri_set_no_fail(b, (int32_t)MUST(b, peri_select_box(b, NULL, top2, hi)), 1));
    MUST(b, peri_set_no_fail(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, bottom2)), 1));
    n = 2 * peri_point_count(b);
    x = (double *)malloc((size_t)n * sizeof *x);
    v = (double *)malloc((size_t)n * sizeof *v);
    MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, n));
    for (i = 0; i < n; ++i) v[i] = speed * x[i - i % 2 + 1];
    MUST(b, peri_set_field(b, PERI_FIELD_VELOCITY, v, n));
    memset(&c, 0, sizeof c);
    c.x = x;
    c.horizon = zone;
    c.end = 0.15;
    MUST(b, peri_on_break(b, note, &c));
    peri_advance_desc_init(&run);
    run.steps = 20;
    while (c.reach < c.end && peri_time(b) < 20) MUST(b, peri_advance(b, &run));
    CHECK(c.reach >= c.end);
    peri_body_destroy(b);
    free(x);
    free(v);
    return atan((c.sum[1] * c.sum[2] / c.sum[0] - c.sum[4]) / (c.sum[3] - c.sum[1] * c.sum[1] / c.sum[0])) * 57.29577951308232;
}

static double theory(double nu) { return 0.5 * atan(1 / (1 + nu)) * 57.29577951308232; }

/* SOURCE OF TRUTH: [T] 5.1, to 3 degrees. A horizon of a/16 does for this ratio; 0.4 needs a/20. */
static void sets_out_with_poissons_ratio(void) {
    const double low = test_long ? angle(0.1, 112, 7) : angle(0.1, 80, 5);
    printf("    nu 0.1: %.1f degrees, [T] 5.1 %.1f\n", low, theory(0.1));
    CHECK_NEAR(low, theory(0.1), 0, 3);
}

/* The larger ratios at a/20, where psi of 0.1 would be met by 4 degrees; what the lattice makes of it; and the smaller a ratio, the further
   the crack turns, whatever the horizon ([T] 5.1). */
static void directions(void) {
    const double nu[3] = {0.1, 0.25, 0.4};
    double last[2] = {90, 90};
    int k;
    printf("    nu     [T] 5.1   m=7, horizon a/20   m=5, a/20   m=7, a/32   [degrees]\n");
    for (k = 0; k < 3; ++k) {
        const double usual = angle(nu[k], 140, 7), fine = angle(nu[k], 224, 7);
        printf("    %.2f   %.2f     %.2f               %.2f       %.2f\n", nu[k], theory(nu[k]), usual, angle(nu[k], 100, 5), fine);
        if (k > 0) CHECK_NEAR(usual, theory(nu[k]), 0, 3);
        CHECK(usual < last[0] && fine < last[1]);
        last[0] = usual;
        last[1] = fine;
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(sets_out_with_poissons_ratio);
    LONG_RUN(directions);
    return test_end("test_direction");
}
