/* SPDX-License-Identifier: MIT */
/* test_westergaard.c - the second part of the convergence study [C], its section 6: a crack under inner pressure in an infinite medium,
   plane strain, static.

   SOURCE OF TRUTH: Westergaard's functions, checked below by Navier's equation and by what they give on the crack; Sneddon's ellipse for
   the opening; the trends of [C] tables 7 and 8. [C] table 6 has a crack of 700 mm in 160 m, which no grid of it resolves: here the
   domain is 16 cracks wide. */
#include "study.h"

#define SIDE     160.0 /* [m]                                                                                            */
#define HALF     5.0   /* half the crack                                                                                  */
#define STIFF    60e9
#define PRESSURE 0.1e9

/* ---- the exact solution ------------------------------------------------------------------------------------------- */

/* With Z = P (z/r - 1) and its integral Zb = P (r - z), r = sqrt(z^2 - a^2), the Airy function Re int Zb + y Im Zb gives
   sigma_yy = Re Z + y Im Z', sigma_xx = Re Z - y Im Z', sigma_xy = -y Re Z' and, in plane strain,
     2 mu u_x = (1 - 2 nu) Re Zb - y Im Z,     2 mu u_y = 2 (1 - nu) Im Zb - y Re Z
   ([C] 46, 47 as they must read). On the crack Re Z = -P; far away r - z = -a^2/(2 z) and all vanishes. u is odd in x along x, and in y
   along y, so one quadrant is enough, where r is the product of the principal roots of z - a and z + a. */
static void exact_at(const double *at, double nu, double *u) {
    const double x = fabs(at[0]), y = fabs(at[1]), mu = STIFF / (2 * (1 + nu));
    const double p = hypot(x - HALF, y), q = hypot(x + HALF, y), turn = 0.5 * (atan2(y, x - HALF) + atan2(y, x + HALF));
    const double re = sqrt(p * q) * cos(turn), im = sqrt(p * q) * sin(turn), square = p * q; /* r, |r|^2 */
    const double zre = PRESSURE * ((x * re + y * im) / square - 1), zim = PRESSURE * (y * re - x * im) / square;
    u[0] = ((1 - 2 * nu) * PRESSURE * (re - x) - y * zim) / (2 * mu);
    u[1] = (2 * (1 - nu) * PRESSURE * (im - y) - y * zre) / (2 * mu);
    if (at[0] < 0) u[0] = -u[0];
    if (at[1] < 0) u[1] = -u[1];
}

/* Navier's equation (lambda + mu) grad div u + mu lap u = 0 and, close to the crack, sigma_yy = -P, sigma_xy = 0, by differences of step
   d: errors d^2/6 of third and fourth derivatives, u/a^4 at distances of a/2 and more, and rounding 1e-16 u/d^2. */
static void the_exact_solution_solves(void) {
    static const double places[5][2] = {{2, 3}, {6, 4}, {-8, 3}, {-3, -2.5}, {9, -9}};
    static const double poisson[2] = {0, 0.3};
    const double d = 1e-3 * HALF;
    int k, n;
    for (n = 0; n < 2; ++n) {
        const double nu = poisson[n], mu = STIFF / (2 * (1 + nu)), lambda = 2 * mu * nu / (1 - 2 * nu);
        double u[3][3][2], at[2], far[2], big;
        int i, j;
        for (k = 0; k < 5; ++k) {
            double xx[2], yy[2], xy[2];
            for (i = 0; i < 3; ++i)
                for (j = 0; j < 3; ++j) {
                    at[0] = places[k][0] + (i - 1) * d;
                    at[1] = places[k][1] + (j - 1) * d;
                    exact_at(at, nu, u[i][j]);
                }
            for (i = 0; i < 2; ++i) {
                xx[i] = (u[0][1][i] - 2 * u[1][1][i] + u[2][1][i]) / (d * d);
                yy[i] = (u[1][0][i] - 2 * u[1][1][i] + u[1][2][i]) / (d * d);
                xy[i] = (u[0][0][i] + u[2][2][i] - u[0][2][i] - u[2][0][i]) / (4 * d * d);
            }
            big = (lambda + 2 * mu) * (fabs(xx[0]) + fabs(yy[0]) + fabs(xx[1]) + fabs(yy[1]));
            CHECK_NEAR((lambda + mu) * (xx[0] + xy[1]) + mu * (xx[0] + yy[0]), 0, 0, 1e-4 * big);
            CHECK_NEAR((lambda + mu) * (xy[0] + yy[1]) + mu * (xx[1] + yy[1]), 0, 0, 1e-4 * big);
        }
        for (k = 0; k < 4; ++k) { /* on the upper face */
            const double x = (0.2 * k - 0.1) * HALF, y = 1e-6 * HALF, step = 1e-7 * HALF;
            double right[2], left[2], above[2], below[2], along[2], up[2];
            at[0] = x + d;
            at[1] = y;
            exact_at(at, nu, right);
            at[0] = x - d;
            exact_at(at, nu, left);
            at[0] = x;
            at[1] = y + step;
            exact_at(at, nu, above);
            at[1] = y - step;
            exact_at(at, nu, below);
            for (i = 0; i < 2; ++i) {
                along[i] = (right[i] - left[i]) / (2 * d);
                up[i] = (above[i] - below[i]) / (2 * step);
            }
            CHECK_NEAR((lambda + 2 * mu) * up[1] + lambda * along[0], -PRESSURE, 1e-4, 0);
            CHECK_NEAR(mu * (up[0] + along[1]), 0, 0, 1e-4 * PRESSURE);
            at[1] = 0;
            exact_at(at, nu, above); /* Sneddon: half the opening 2 (1 - nu^2) P/E sqrt(a^2 - x^2) */
            CHECK_NEAR(above[1], 2 * (1 - nu * nu) * PRESSURE / STIFF * sqrt(HALF * HALF - x * x), 1e-12, 0);
        }
        at[0] = 3e3 * HALF;
        at[1] = 4e3 * HALF;
        exact_at(at, nu, far);
        CHECK(hypot(far[0], far[1]) < 1e-3 * PRESSURE / STIFF * HALF);
    }
}

/* ---- the study ---------------------------------------------------------------------------------------------------- */

typedef struct study {
    const study_law *law;
    int    shape, cells, consistent, touched; /* consistent: peri_apply_pressure, else through the bonds; touched: bonds that only touch
                                                 the tip are cut, too                                                       */
    double ratio, nu;
} study;

typedef struct outcome {
    double  error, opening; /* [C] 48, as lengths; opening at the middle of the crack over the exact one                    */
    double  face;           /* error of the points beside the crack, as lengths                                           */
    double  smooth[3];      /* error after smoothing with Const, Linear, Cubic                                             */
    int64_t iterations;
} outcome;

static study study_of(const study_law *law, int shape, double ratio, int consistent) {
    study s;
    s.law = law;
    s.shape = shape;
    s.cells = 0;
    s.consistent = consistent;
    s.touched = 0;
    s.ratio = ratio;
    s.nu = 0;
    return s;
}

typedef struct rim {
    const study  *s;
    const double *x;
} rim;

static int32_t outermost(void *user, int64_t index, const double *x) {
    const study *s = (const study *)user;
    (void)index;
    return fmax(fabs(x[0]), fabs(x[1])) > SIDE / 2 - SIDE / s->cells;
}

static int32_t hold(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const rim *r = (const rim *)user;
    int64_t k;
    (void)time;
    for (k = 0; k < count; ++k) exact_at(&r->x[2 * points[k]], r->s->nu, &value[2 * k]);
    return 0;
}

/* The root of [C] 48, the integral of |u - exact|^2 over that of |exact|^2: by their size the errors of its tables are roots, too. */
static double error_of(const study *s, const double *x, const double *u) {
    double off = 0, all = 0, want[2];
    int64_t i;
    for (i = 0; i < (int64_t)s->cells * s->cells; ++i) {
        exact_at(&x[2 * i], s->nu, want);
        off += pow(u[2 * i] - want[0], 2) + pow(u[2 * i + 1] - want[1], 2);
        all += want[0] * want[0] + want[1] * want[1];
    }
    return sqrt(off / all);
}

/* [C] 49: means over the live family and the point itself, weighed by w. */
static double *smoothed(peri_body *b, const study *s, const double *u, int shape) {
    const int n = s->cells, reach = (int)s->ratio;
    double *out = (double *)calloc((size_t)n * (size_t)n * 2, sizeof *out);
    int ix, iy, dx, dy;
    for (iy = 0; iy < n; ++iy)
        for (ix = 0; ix < n; ++ix) {
            const int i = iy * n + ix;
            double sum[3] = {0, 0, 0};
            for (dy = -reach; dy <= reach; ++dy)
                for (dx = -reach; dx <= reach; ++dx) {
                    const double q = hypot(dx, dy) / s->ratio, w = shape == CONST ? 1 : shape == LINEAR ? 1 - q : pow(1 - q, 3);
                    const int x = ix + dx, y = iy + dy, j = y * n + x;
                    if (q > 1 + 1e-8 || x < 0 || y < 0 || x >= n || y >= n || (i != j && peri_bond_is_intact(b, i, j) != 1)) continue;
                    sum[0] += w * u[2 * j];
                    sum[1] += w * u[2 * j + 1];
                    sum[2] += w;
                }
            out[2 * i] = sum[0] / sum[2];
            out[2 * i + 1] = sum[1] / sum[2];
        }
    return out;
}

static outcome solve(const study *s, int smooth) {
    static const int shapes[3] = {CONST, LINEAR, CUBIC};
    const double corner[2] = {-SIDE / 2, -SIDE / 2}, h = SIDE / s->cells, reach = 2 * s->ratio * h;
    peri_body *b = study_square(s->law, s->shape, s->ratio, s->cells, corner, SIDE, STIFF, s->nu);
    double *x = get(b, PERI_FIELD_POSITION), *u, from[2] = {0, 0}, to[2] = {0, 0}, off = 0, all = 0;
    int32_t rim_set, near_crack;
    peri_solve_report report;
    outcome o;
    rim r;
    int64_t i;
    int k;
    memset(&o, 0, sizeof o);
    r.s = s;
    r.x = x;
    to[0] = s->touched ? HALF : HALF * (1 - 1e-6);
    from[0] = -to[0];
    CHECK(MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to)) > 0);
    rim_set = (int32_t)MUST(b, peri_select_if(b, NULL, outermost, (void *)s));
    (void)MUST(b, peri_prescribe_displacement(b, rim_set, PERI_AXIS_X | PERI_AXIS_Y, NULL, hold, &r));
    near_crack = study_box(b, -HALF - reach, -reach, HALF + reach, reach);
    if (s->consistent) (void)MUST(b, peri_apply_pressure(b, near_crack, PRESSURE, NULL, NULL));
    else (void)MUST(b, peri_apply_bond_pressure_for_comparison(b, near_crack, PRESSURE, NULL, NULL));
    (void)MUST(b, study_solve(b, 1e-7, 20000, &report));
    o.iterations = report.iterations;
    u = get(b, PERI_FIELD_DISPLACEMENT);
    o.error = error_of(s, x, u);
    for (i = 0; i < (int64_t)s->cells * s->cells; ++i) {
        double want[2];
        if (fabs(x[2 * i + 1]) > h || fabs(x[2 * i]) > HALF) continue;
        exact_at(&x[2 * i], s->nu, want);
        off += pow(u[2 * i] - want[0], 2) + pow(u[2 * i + 1] - want[1], 2);
        all += want[0] * want[0] + want[1] * want[1];
        if (fabs(x[2 * i]) < h && x[2 * i] > 0 && x[2 * i + 1] > 0) o.opening = u[2 * i + 1] / want[1];
    }
    o.face = sqrt(off / all);
    for (k = 0; smooth && k < 3; ++k) {
        double *v = smoothed(b, s, u, shapes[k]);
        o.smooth[k] = error_of(s, x, v);
        free(v);
    }
    free(x);
    free(u);
    peri_body_destroy(b);
    return o;
}

static const study_law STABLE = {PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE, 0.2, "stable 0.2"};
static const study_law STIFFER = {PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE, 0.5, "stable 0.5"};
static const study_law MOMENT = {PERI_LAW_LPS, PERI_CORRECTION_MOMENT, 0, "Silling+m"};

/* Solves on the grids of a list that ends with 0, and prints a line of the table. Returns the order of the errors. */
static double series(study s, const int *grids, outcome *o) {
    double h[16], error[16];
    int k;
    if (test_long) printf("    %-10s %-6s RF %.1f %s:", s.law->name, shape_name[s.shape], s.ratio, s.consistent ? "pressure" : "bonds   ");
    for (k = 0; grids[k]; ++k) {
        s.cells = grids[k];
        o[k] = solve(&s, 0);
        h[k] = 1.0 / s.cells;
        error[k] = o[k].error;
        if (test_long) printf(" %d: %.2f (%.3f)", s.cells, 100 * o[k].error, o[k].opening);
    }
    if (test_long && k > 1) printf("  order %.2f", study_order(k, h, error));
    if (test_long) printf("\n");
    return k > 1 ? study_order(k, h, error) : 0;
}

/* As [C] table 8 and Fig. 16 have it: grids irrespective of the ends of the crack, of which N/16 spacings are to be cut. What is cut is up
   to half a spacing at each end off; displacements go as the square of the length: up to 32/N off whatever the law, 16 % at N = 200, so
   that errors jump from grid to grid and no order is asked. [C]: 2.2 % at best for Silling, below 5 % feasible, the gradient law worst.
   The bar: a stable law within 2 % at 200, unsmoothed. 200 is a lucky grid, 150 and 400 are not: the next test has no luck in it. */
static void grids_of_the_paper(void) {
    static const int once[5] = {50, 100, 150, 200, 0}, coarse[2] = {100, 0}, few[3] = {100, 200, 0}, many[6] = {50, 100, 150, 200, 400, 0};
    const int *grids = test_long ? many : few, at = test_long ? 3 : 1;
    outcome o[8], silling[8], oterkus[8], gradient[8];
    const int last = test_long ? 3 : 0;
    int k;
    if (test_long) printf("    error %% (opening at the middle over Sneddon's)\n");
    (void)series(study_of(&SILLING, CUBIC, 3.5, 0), test_long ? many : coarse, silling);
    (void)series(study_of(&OTERKUS, CUBIC, 3.5, 0), test_long ? many : coarse, oterkus);
    CHECK(!test_long || (silling[at].error < 0.05 && oterkus[at].error < 0.05)); /* [C]: below 5 % is feasible */
    (void)series(study_of(&GRADIENT, CUBIC, 1.5, 0), test_long ? once : coarse, gradient);
    for (k = 0; k <= last; ++k) CHECK(gradient[k].error > silling[k].error && gradient[k].error > oterkus[k].error);
    (void)series(study_of(&STABLE, CUBIC, 2, 1), grids, o);
    CHECK(o[at].error <= 0.02 && o[at].face <= 0.02);
    CHECK(fabs(o[at].opening - 1) <= 0.02);
    if (!test_long) return;
    (void)series(study_of(&MOMENT, CUBIC, 3.5, 0), grids, o);
    CHECK(o[at].error <= 0.02);
    (void)series(study_of(&MOMENT, CUBIC, 3.5, 1), grids, o);
    CHECK(o[at].error <= 0.02);
    (void)series(study_of(&STABLE, CUBIC, 2, 0), grids, o);
    CHECK(o[at].error <= 0.02);
}

/* Grids whose cell borders meet the ends of the crack, and bonds that only touch the tip left whole: what remains falls with h, smoothly.
   With those bonds cut, too, the crack acts as if some part of a spacing longer, which also falls with h: order 1, larger errors. */
static void grids_that_fit_the_crack(void) {
    static const int few[4] = {64, 128, 192, 0}, many[6] = {64, 128, 192, 256, 384, 0}, one[2] = {192, 0};
    const int *grids = test_long ? many : few, last = test_long ? 4 : 2;
    outcome o[8], cut[8];
    study s = study_of(&STABLE, CUBIC, 2, 1);
    double order = series(s, grids, o);
    int k;
    CHECK(order >= 0.9 && o[2].error <= 0.02);
    CHECK_NEAR(o[2].error, 0.015, 0, 0.001); /* 12 points along the crack: docs/accuracy.md, README.md; 24 with --long */
    if (test_long) CHECK_NEAR(o[4].error, 0.007, 0, 0.0005);
    for (k = 1; k <= last; ++k) CHECK(o[k].error < o[k - 1].error);
    CHECK(fabs(o[last].opening - 1) < 0.02);
    s.nu = 0.25;
    (void)series(s, one, cut);
    CHECK(cut[0].error <= 0.02 && fabs(cut[0].opening - 1) < 0.02);
    if (!test_long) return;
    s.nu = 0;
    s.touched = 1;
    order = series(s, few, cut);
    CHECK(order >= 0.9 && cut[2].error > o[2].error && cut[2].opening > 1);
    order = series(study_of(&MOMENT, CUBIC, 3.5, 1), grids, o);
    CHECK(order >= 0.9 && o[4].error <= 0.02);
    order = series(study_of(&STABLE, CUBIC, 1.5, 1), grids, o);
    CHECK(order >= 0.9 && o[4].error <= 0.02);
    (void)series(study_of(&SILLING, CUBIC, 3.5, 0), grids, o); /* wrong moduli: a part that stays */
    CHECK(o[4].error > 0.01 && o[4].error > 0.6 * o[2].error);
}

/* Table 7: the error of the gradient law grows steeply with the horizon; smoothing mends most of it; Linear does so best on wide
   families, by a factor above ten at RF 3.5, and no smoothing brings it to what a stable law has as it is. */
static void smoothing(void) {
    static const double printed[5][4] = {{0.2105, 0.0836, 0.0708, 0.1810},
                                         {0.3022, 0.0868, 0.0429, 0.1697},
                                         {0.5409, 0.1080, 0.0670, 0.1628},
                                         {1.0375, 0.1604, 0.1004, 0.1965},
                                         {2.6741, 0.2684, 0.1452, 0.3302}};
    double last = 0;
    int k, j;
    for (k = 0; k < 5; k += test_long ? 1 : 4) {
        study s = study_of(&GRADIENT, CUBIC, 1.5 + 0.5 * k, 0);
        outcome wild, tame;
        s.cells = test_long ? 100 : 50;
        wild = solve(&s, 1);
        s.law = &STABLE;
        s.consistent = 1;
        tame = solve(&s, 0);
        if (test_long) {
            printf("    RF %.1f: %.4f, smoothed", s.ratio, wild.error);
            for (j = 0; j < 3; ++j) printf(" %.4f", wild.smooth[j]);
            printf("  stable %.4f   [C]", tame.error);
            for (j = 0; j < 4; ++j) printf(" %.4f", printed[k][j]);
            printf("\n");
        }
        CHECK(wild.error > last && tame.error < wild.error);
        for (j = 0; j < 3; ++j) CHECK(wild.smooth[j] < wild.error);
        if (test_long && k >= 2) CHECK(wild.smooth[1] < wild.smooth[0] && wild.smooth[1] < wild.smooth[2]);
        if (test_long) CHECK(tame.error < fmin(wild.smooth[0], wild.smooth[1]));
        if (test_long && k == 4) CHECK(wild.smooth[1] < 0.1 * wild.error);
        last = wild.error;
    }
}

/* What the horizon, the stabilization and the way of loading do, at 192. Where the moduli are right errors stay within 6 %; a stabilization
   of 0.5 stiffens the short waves of the tip and of the faces, the more the wider the horizon: up to 15 %. */
static void horizons(void) {
    static const study_law *const laws[5] = {&SILLING, &OTERKUS, &MOMENT, &STABLE, &STIFFER};
    static const int grid[2] = {192, 0};
    int law, k, consistent;
    outcome o[1];
    for (law = 0; law < 5; ++law)
        for (k = law < 3 ? 1 : 0; k < 5; ++k)
            for (consistent = law < 2 ? 0 : law == 4; consistent < (law < 2 ? 1 : 2); ++consistent) {
                (void)series(study_of(laws[law], CUBIC, 1.5 + 0.5 * k, consistent), grid, o);
                CHECK(law < 2 || o[0].error < (law == 4 ? 0.15 : 0.06));
            }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(the_exact_solution_solves);
    RUN(grids_of_the_paper);
    RUN(grids_that_fit_the_crack);
    RUN(smoothing);
    LONG_RUN(horizons);
    return test_end("test_westergaard");
}
