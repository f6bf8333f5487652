/* SPDX-License-Identifier: MIT */
/* glass.h - crack branching in a glass plate, the benchmark of [P] (PDMATLAB2D): its numbers, an independent textbook
   program for it, and the same scene built through the library.

   The scene: (-0.05, 0.05) x (-0.02, 0.02) m, 300 x 120 cells, points at centres, whole cells, constant influence, horizon 3
   cells = 1 mm, plane stress, E = 72 GPa, rho = 2440, G0 = 3.8, notch from the left edge to the centre at mid-height, +-2 MPa
   on the outermost rows as body force stress/cell from t = 0, bonds with an end at |y| > 0.02 - horizon do not fail, steps of
   67 ns to 43 us (642 steps), bonds break after the drift. With 150 x 60 cells everything is doubled but the plate. */
#ifndef GLASS_H
#define GLASS_H

#include "peri_test.h"

#define PI 3.14159265358979323846

typedef struct scene {
    int    nx, ny, steps;
    double m; /* one metre in the scene's unit of length */
    double cell, horizon, dt, young, density, g0, stress;
} scene;

static inline scene glass(int nx, double metre) {
    scene s;
    s.nx = nx;
    s.ny = nx * 2 / 5;
    s.steps = (642 * nx + 299) / 300;
    s.m = metre;
    s.cell = 0.1 * metre / nx;
    s.horizon = 3 * s.cell;
    s.dt = 67e-9 * 300 / nx;
    s.young = 72e9 / metre; /* kg/(m s^2) */
    s.density = 2440 / (metre * metre * metre);
    s.g0 = 3.8; /* kg/s^2 */
    s.stress = 2e6 / metre;
    return s;
}

/* ---- the textbook program: nothing of the library is used in it --------------------------------------------------- */

typedef struct textbook {
    int      n, width;
    int     *id;    /* [n*width] neighbours */
    char    *alive; /* [n*width] */
    double  *len;   /* [n*width] lengths of the bonds */
    int     *size;  /* [n] */
    double  *x, *u, *v, *f;
    int64_t  directed, cut, broken;
    int64_t *history; /* broken bonds after every step */
} textbook;

/* Twice the site's coordinates in cells, from the centre of the plate: exact integers. */
static inline int site_x(const scene *s, int i) { return 2 * (i % s->nx) + 1 - s->nx; }
static inline int site_y(const scene *s, int i) { return 2 * (i / s->nx) + 1 - s->ny; }

/* Does the straight line between two sites meet the notch y = 0, x <= 0 (touching and collinear count)? In integers. */
static inline int meets_notch(const scene *s, int i, int j) {
    int64_t x1 = site_x(s, i), y1 = site_y(s, i), x2 = site_x(s, j), y2 = site_y(s, j), t;
    if ((y1 > 0 && y2 > 0) || (y1 < 0 && y2 < 0)) return 0;
    if (y1 == 0 && y2 == 0) return x1 <= 0 || x2 <= 0;
    t = x1 * y2 - x2 * y1; /* x where y = 0, times (y2 - y1) */
    return y2 > y1 ? t <= 0 : t >= 0;
}

static inline void textbook_force(textbook *t, const scene *s, int no_break) {
    double c = 9 * s->young / (PI * s->horizon * s->horizon * s->horizon), area = s->cell * s->cell;
    double s0 = sqrt(4 * PI * s->g0 / (9 * s->young * s->horizon));
    int64_t broken = 0; /* directed: every row finds its own */
    int i;
#ifdef _OPENMP
#pragma omp parallel for reduction(+ : broken)
#endif
    for (i = 0; i < t->n; ++i) {
        int k;
        double fx = 0, fy = 0, xi = t->x[2 * i], yi = t->x[2 * i + 1], ui = t->u[2 * i], vi = t->u[2 * i + 1];
        int fails = fabs(yi) <= 0.02 * s->m - s->horizon;
        if (i < s->nx) fy = -s->stress / s->cell;
        if (i >= t->n - s->nx) fy = s->stress / s->cell;
        for (k = i * t->width; k < i * t->width + t->size[i]; ++k) {
            int j = t->id[k];
            double px, py, p2, r, p;
            if (!t->alive[k]) continue;
            px = t->x[2 * j] - xi + t->u[2 * j] - ui;
            py = t->x[2 * j + 1] - yi + t->u[2 * j + 1] - vi;
            r = t->len[k];
            p2 = px * px + py * py;
            if (!no_break && p2 > (1 + s0) * (1 + s0) * r * r && fails && fabs(t->x[2 * j + 1]) <= 0.02 * s->m - s->horizon) {
                t->alive[k] = 0;
                broken++;
                continue;
            }
            p = sqrt(p2);
            fx += c * (p - r) / (r * p) * px * area;
            fy += c * (p - r) / (r * p) * py * area;
        }
        t->f[2 * i] = fx;
        t->f[2 * i + 1] = fy;
    }
    t->broken += broken;
}

static inline textbook textbook_make(const scene *s) {
    textbook t;
    int i, di, dj, k;
    memset(&t, 0, sizeof t);
    t.n = s->nx * s->ny;
    t.width = 28;
    t.id = (int *)calloc((size_t)(t.n * t.width), sizeof(int));
    t.alive = (char *)calloc((size_t)(t.n * t.width), 1);
    t.len = (double *)calloc((size_t)(t.n * t.width), sizeof(double));
    t.size = (int *)calloc((size_t)t.n, sizeof(int));
    t.x = (double *)calloc((size_t)t.n * 2, sizeof(double));
    t.u = (double *)calloc((size_t)t.n * 2, sizeof(double));
    t.v = (double *)calloc((size_t)t.n * 2, sizeof(double));
    t.f = (double *)calloc((size_t)t.n * 2, sizeof(double));
    t.history = (int64_t *)calloc((size_t)s->steps + 1, sizeof(int64_t));
    for (i = 0; i < t.n; ++i) {
        t.x[2 * i] = 0.5 * s->cell * site_x(s, i);
        t.x[2 * i + 1] = 0.5 * s->cell * site_y(s, i);
        for (dj = -3; dj <= 3; ++dj)
            for (di = -3; di <= 3; ++di) {
                int col = i % s->nx + di, row = i / s->nx + dj, j = row * s->nx + col;
                if ((!di && !dj) || di * di + dj * dj > 9 || col < 0 || col >= s->nx || row < 0 || row >= s->ny) continue;
                k = i * t.width + t.size[i]++;
                t.id[k] = j;
                t.len[k] = s->cell * sqrt((double)(di * di + dj * dj));
                t.alive[k] = !meets_notch(s, i, j);
                t.directed++;
                if (!t.alive[k]) t.cut++;
            }
    }
    t.cut /= 2;
    return t;
}
static inline void textbook_run(textbook *t, const scene *s) {
    int step, k;
    textbook_force(t, s, 1);
    for (step = 1; step <= s->steps; ++step) {
        for (k = 0; k < 2 * t->n; ++k) {
            t->v[k] += 0.5 * s->dt * t->f[k] / s->density;
            t->u[k] += s->dt * t->v[k];
        }
        textbook_force(t, s, 0);
        for (k = 0; k < 2 * t->n; ++k) t->v[k] += 0.5 * s->dt * t->f[k] / s->density;
        t->history[step] = t->broken / 2;
    }
}
static inline void textbook_free(textbook *t) {
    free(t->id);
    free(t->alive);
    free(t->len);
    free(t->size);
    free(t->x);
    free(t->u);
    free(t->v);
    free(t->f);
    free(t->history);
}

/* ---- the same through the library --------------------------------------------------------------------------------- */

typedef struct options {
    int32_t              precision, threads;
    peri_parallel_for_fn parallel_for;
    const int           *order; /* body point k = lattice site order[k]; NULL: a box */
    int                  mirror;
} options;

static inline peri_body *plate(const scene *s, const options *o) {
    double w = 0.05 * s->m, h = 0.02 * s->m, lo[2], hi[2], b2[2] = {0, 0}, c[2] = {0, 0};
    int32_t glass_id, rows[2], safe[2];
    int k, side, n = s->nx * s->ny;
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = s->horizon;
    d.break_timing = PERI_BREAK_AFTER_DRIFT;
    if (o && o->precision) d.precision = o->precision;
    if (o) d.threads = o->threads;
    if (o) d.parallel_for = o->parallel_for;
    (void)MUST(NULL, peri_body_create(&d, &b, NULL));
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = s->young;
    m.density = s->density;
    m.fracture_energy = s->g0;
    glass_id = (int32_t)MUST(b, peri_add_material(b, &m));
    lo[0] = -w, lo[1] = -h, hi[0] = w, hi[1] = h;
    if (!o || !o->order) CHECK(MUST(b, peri_add_box(b, glass_id, lo, hi, s->cell)) == n);
    else {
        double *x = (double *)calloc((size_t)n * 3, sizeof *x), *area = x + 2 * n;
        for (k = 0; k < n; ++k) {
            x[2 * k] = 0.5 * s->cell * site_x(s, o->order[k]);
            x[2 * k + 1] = 0.5 * s->cell * site_y(s, o->order[k]) * (o->mirror ? -1 : 1);
            area[k] = s->cell * s->cell;
        }
        CHECK(MUST(b, peri_add_points(b, n, x, area, NULL)) == n);
        free(x);
    }
    (void)MUST(b, peri_build(b));
    lo[0] = -w, lo[1] = 0;
    (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, lo, c));
    for (side = 0; side < 2; ++side) {
        lo[0] = -w, hi[0] = w;
        lo[1] = side ? h - s->cell : -h;
        hi[1] = side ? h : -h + s->cell;
        rows[side] = (int32_t)MUST(b, peri_select_box(b, side ? "top" : "bottom", lo, hi));
        CHECK(peri_size_of_set(b, rows[side]) == s->nx);
        lo[1] = side ? h - s->horizon : -h;
        hi[1] = side ? h : -h + s->horizon;
        safe[side] = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
        (void)MUST(b, peri_set_no_fail(b, safe[side], 1));
        b2[1] = (side ? 1 : -1) * s->stress / s->cell;
        (void)MUST(b, peri_apply_body_force(b, rows[side], b2, NULL, NULL));
    }
    return b;
}

#endif
