/* SPDX-License-Identifier: MIT */
/* test_moments.c - state-based laws calibrated on whole families (PERI_MOMENTS_WHOLE): their equations summed here bond by bond, what
   breaking takes, the stable step, and what stays as it is on live families. */
#include "scene.h"
#include "stiffest.h"

/* ---- a body with a crack, and fields made of trigonometric functions ------------------------------------------------ */

typedef struct way {
    int32_t space, law, kernel, quadrature, correction, geometry;
} way;

static const double MIDDLE = 4.5; /* the plane of the crack: between rows                                               */

static specimen cracked(way w, int32_t moments) {
    const int solid = w.space == PERI_SPACE_SOLID;
    specimen s = specimen_of(w.space, w.law, 0.12, 1.0, 2.3, solid ? 7 : 12, 9, solid ? 6 : 1);
    s.material.young = YOUNG;
    s.desc.kernel = w.kernel;
    s.desc.quadrature = w.quadrature;
    s.desc.correction = w.correction;
    s.desc.geometry = w.geometry;
    s.desc.moments = moments;
    return s;
}

/* Cut below y = 4.5 up to the middle in x. */
static int32_t across(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user, (void)i, (void)j;
    return (xi[1] < MIDDLE) != (xj[1] < MIDDLE) && 0.5 * (xi[0] + xj[0]) < 4.2;
}

static void wave_to(peri_body *b, double size) {
    const int dim = peri_dimension(b);
    const int64_t n = peri_point_count(b);
    double *x = (double *)calloc((size_t)(2 * n * dim), sizeof *x), *u = x + n * dim;
    (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, n * dim));
    for (int64_t i = 0; i < n; ++i)
        for (int d = 0; d < dim; ++d)
            u[i * dim + d] = size * (sin(0.7 * x[i * dim] + d) + cos(0.9 * x[i * dim + 1] - 2 * d) + 0.3 * x[i * dim + d]);
    (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, n * dim));
    free(x);
}

/* ---- the law, bond by bond ------------------------------------------------------------------------------------------ */

typedef struct sums {
    double m, length, theta, spring, pressure;
} sums;

typedef struct field {
    int      dim;
    int64_t  n;
    double  *x, *u, *v;
    int32_t *rows, width;
    sums    *at;
} field;

static field field_of(peri_body *b) {
    field f;
    f.dim = peri_dimension(b);
    f.n = peri_point_count(b);
    f.width = peri_family_width(b);
    f.x = (double *)calloc((size_t)(f.n * f.dim), sizeof *f.x);
    f.u = (double *)calloc((size_t)(f.n * f.dim), sizeof *f.u);
    f.v = (double *)calloc((size_t)f.n, sizeof *f.v);
    f.rows = (int32_t *)calloc((size_t)(f.n * f.width), sizeof *f.rows);
    f.at = (sums *)calloc((size_t)f.n, sizeof *f.at);
    (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, f.x, f.n * f.dim));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, f.u, f.n * f.dim));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_VOLUME, f.v, f.n));
    (void)MUST(b, peri_get_families(b, 0, f.n, f.rows, f.n * f.width));
    return f;
}

static void drop(field *f) { free(f->x), free(f->u), free(f->v), free(f->rows), free(f->at); }

/* |xi|, xi to n, and e of small displacements. */
static double bond(const field *f, int64_t i, int64_t j, double *n, double *e) {
    double length = 0;
    *e = 0;
    for (int d = 0; d < f->dim; ++d) {
        n[d] = f->x[j * f->dim + d] - f->x[i * f->dim + d];
        length += n[d] * n[d];
    }
    length = sqrt(length);
    for (int d = 0; d < f->dim; ++d) {
        n[d] /= length;
        *e += n[d] * (f->u[j * f->dim + d] - f->u[i * f->dim + d]);
    }
    return length;
}

/* Truth: [T] 1.54, 1.67, 1.72 and docs/theory.md for Oterkus, w = 1 and whole cells: m and sum |xi| V over the whole family (`whole`) or
   the bonds that are left, e over those that are left. To force density f and dilatation theta. */
static void by_hand(peri_body *b, const field *f, int32_t law, moduli e, int whole, double *force, double *theta) {
    const int dim = f->dim;
    const double A = dim * (e.lambda - e.mu), B = dim * (dim + 2) * e.mu;
    double n[3], ext;
    for (int64_t i = 0; i < f->n; ++i) {
        sums *s = &f->at[i];
        double sum = 0;
        memset(s, 0, sizeof *s);
        for (int k = 0; k < f->width; ++k) {
            const int64_t j = f->rows[i * f->width + k];
            if (j == i) continue;
            const int live = peri_bond_is_intact(b, (int32_t)i, (int32_t)j);
            const double length = bond(f, i, j, n, &ext);
            if (whole || live) s->m += length * length * f->v[j], s->length += length * f->v[j];
            if (live) sum += (law == PERI_LAW_LPS ? length : 1) * ext * f->v[j];
        }
        if (s->m == 0) continue;
        s->theta = dim * sum / (law == PERI_LAW_LPS ? s->m : s->length);
        s->spring = B / s->m;
        s->pressure = law == PERI_LAW_LPS ? A * s->theta / s->m : (e.bulk - B / (dim * dim)) * dim / s->length * s->theta;
        theta[i] = s->theta;
    }
    for (int64_t i = 0; i < f->n; ++i)
        for (int k = 0; k < f->width; ++k) {
            const int64_t j = f->rows[i * f->width + k];
            if (j == i || peri_bond_is_intact(b, (int32_t)i, (int32_t)j) != 1) continue;
            const double length = bond(f, i, j, n, &ext), g = law == PERI_LAW_LPS ? length : 1;
            const double t = ((f->at[i].pressure + f->at[j].pressure) * g + (f->at[i].spring + f->at[j].spring) * ext) * f->v[j];
            for (int d = 0; d < dim; ++d) force[i * dim + d] += t * n[d];
        }
}

static void compare(way w, int32_t moments) {
    specimen s = cracked(w, moments);
    peri_body *b = specimen_make(&s);
    CHECK(MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, across, NULL)) > 0);
    wave_to(b, 1e-3);
    field f = field_of(b);
    double *got = (double *)calloc((size_t)(4 * f.n * f.dim), sizeof *got), *want = got + f.n * f.dim, *theta = want + f.n * f.dim;
    double *seen = theta + f.n * f.dim, most = 0;
    (void)MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, got, f.n * f.dim));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_DILATATION, seen, f.n));
    by_hand(b, &f, w.law, moduli_of(w.space, 0.12), moments == PERI_MOMENTS_WHOLE, want, theta);
    for (int64_t k = 0; k < f.n * f.dim; ++k) most = fmax(most, fabs(want[k]));
    for (int64_t k = 0; k < f.n * f.dim; ++k) CHECK_NEAR(got[k], want[k], 0, 1e-11 * most);
    for (int64_t i = 0; i < f.n; ++i) CHECK_NEAR(seen[i], theta[i], 0, 1e-14);
    free(got);
    drop(&f);
    peri_body_destroy(b);
}

static void forces_by_hand(void) {
    static const int32_t laws[2] = {PERI_LAW_LPS, PERI_LAW_OTERKUS};
    for (int32_t space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (int k = 0; k < 2; ++k)
            for (int32_t kernel = PERI_KERNEL_BEST; kernel < peri__end_kernel; ++kernel)
                for (int32_t moments = PERI_MOMENTS_LIVE; moments < peri__end_moments; ++moments) {
                    const way w = {space, laws[k], kernel, PERI_QUADRATURE_FULL, PERI_CORRECTION_NONE, PERI_GEOMETRY_LINEAR};
                    compare(w, moments);
                }
}

/* ---- what stays ------------------------------------------------------------------------------------------------------ */

static int same_forces(peri_body *a, peri_body *b) {
    const int64_t n = peri_size_of_field(a, PERI_FIELD_FORCE_DENSITY);
    double *f = (double *)calloc((size_t)(2 * n), sizeof *f);
    (void)MUST(a, peri_get_field(a, PERI_FIELD_FORCE_DENSITY, f, n));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f + n, n));
    const int same = memcmp(f, f + n, (size_t)n * sizeof *f) == 0;
    free(f);
    return same;
}

/* Truth: peri.h. Until a bond is cut there is no difference, to the last bit; bond-based and correspondence never differ, ordinary laws do
   after a cut. */
static void nothing_else_changes(void) {
    for (int32_t law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
        const way w = {PERI_SPACE_PLANE_STRAIN, law, PERI_KERNEL_BEST, PERI_QUADRATURE_FULL, PERI_CORRECTION_MOMENT,
                       PERI_GEOMETRY_NONLINEAR};
        specimen live = cracked(w, PERI_MOMENTS_LIVE), whole = cracked(w, PERI_MOMENTS_WHOLE);
        peri_body *a = specimen_make(&live), *b = specimen_make(&whole);
        const int ordinary = law == PERI_LAW_LPS || law == PERI_LAW_OTERKUS;
        wave_to(a, 0.01);
        wave_to(b, 0.01);
        CHECK(same_forces(a, b) && peri_stable_step(a) == peri_stable_step(b));
        (void)MUST(a, peri_cut_if(a, PERI_CUT_NOW, across, NULL));
        (void)MUST(b, peri_cut_if(b, PERI_CUT_NOW, across, NULL));
        CHECK(same_forces(a, b) == !ordinary);
        (void)MUST(b, peri_reset(b));
        (void)MUST(a, peri_reset(a));
        wave_to(a, 0.01);
        wave_to(b, 0.01);
        CHECK(same_forces(a, b));
        peri_body_destroy(a);
        peri_body_destroy(b);
    }
}

/* ---- energy ---------------------------------------------------------------------------------------------------------- */

static double elastic(peri_body *b) {
    peri_energy e;
    (void)MUST(b, peri_get_energy(b, &e));
    return e.elastic;
}

/* Truth: the force is the derivative of the energy, here by central differences; K the derivative of the force, and the assembled matrix
   its rows. The points beside the crack are among those tried. */
static void forces_derive_from_the_energy(void) {
    static const int32_t laws[2] = {PERI_LAW_LPS, PERI_LAW_OTERKUS};
    for (int k = 0; k < 4; ++k) {
        const way w = {PERI_SPACE_PLANE_STRESS, laws[k % 2], PERI_KERNEL_BEST, k < 2 ? PERI_QUADRATURE_FULL : PERI_QUADRATURE_PARTIAL,
                       k < 2 ? PERI_CORRECTION_NONE : PERI_CORRECTION_MOMENT, PERI_GEOMETRY_NONLINEAR};
        specimen s = cracked(w, PERI_MOMENTS_WHOLE);
        peri_body *b = specimen_make(&s);
        (void)MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, across, NULL));
        wave_to(b, 0.02);
        const int64_t n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
        double *u = (double *)calloc((size_t)(6 * n), sizeof *u), *f = u + n, *way_of = f + n, *kw = way_of + n, *up = kw + n;
        double *down = up + n;
        double *vol = (double *)calloc((size_t)n, sizeof *vol);
        const double step = 1e-5;
        uint64_t seed = 3;
        (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, n));
        (void)MUST(b, peri_get_field(b, PERI_FIELD_VOLUME, vol, n / 2));
        (void)MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, n));
        double power = 0, most = 0, energy[2];
        for (int64_t q = 0; q < n; ++q) way_of[q] = test_random(&seed) - 0.5;
        for (int64_t q = 0; q < n; ++q) power += f[q] * vol[q / 2] * way_of[q];
        (void)MUST(b, peri_multiply_stiffness(b, way_of, kw, n));
        for (int side = 0; side < 2; ++side) {
            for (int64_t q = 0; q < n; ++q) u[q] += (side ? -2 : 1) * step * way_of[q];
            (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, n));
            energy[side] = elastic(b);
            (void)MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, side ? down : up, n));
        }
        CHECK_NEAR((energy[0] - energy[1]) / (2 * step), -power, 1e-6, 0);
        for (int64_t q = 0; q < n; ++q) most = fmax(most, fabs(kw[q]));
        for (int64_t q = 0; q < n; ++q) CHECK_NEAR(-(up[q] - down[q]) * vol[q / 2] / (2 * step), kw[q], 0, 1e-5 * most);
        free(u);
        free(vol);
        peri_body_destroy(b);
    }
}

static void assembled_matrix_is_the_product(void) {
    const way w = {PERI_SPACE_SOLID, PERI_LAW_LPS, PERI_KERNEL_BEST, PERI_QUADRATURE_FULL, PERI_CORRECTION_NONE, PERI_GEOMETRY_LINEAR};
    specimen s = cracked(w, PERI_MOMENTS_WHOLE);
    peri_body *b = specimen_make(&s);
    peri_matrix *matrix = NULL;
    (void)MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, across, NULL));
    (void)MUST(b, peri_matrix_create(b, &matrix));
    const int64_t n = peri_matrix_rows(matrix), entries = peri_matrix_entries(matrix);
    int64_t *start = (int64_t *)calloc((size_t)n + 1, sizeof *start);
    int32_t *column = (int32_t *)calloc((size_t)entries, sizeof *column);
    double *value = (double *)calloc((size_t)(entries + 2 * n), sizeof *value), *in = value + entries, *out = in + n, most = 0;
    uint64_t seed = 4;
    (void)MUST(b, peri_get_matrix(matrix, start, column, value));
    for (int64_t q = 0; q < n; ++q) in[q] = test_random(&seed) - 0.5;
    (void)MUST(b, peri_multiply_stiffness(b, in, out, n));
    for (int64_t q = 0; q < n; ++q) most = fmax(most, fabs(out[q]));
    for (int64_t q = 0; q < n; ++q) {
        double sum = 0;
        for (int64_t k = start[q]; k < start[q + 1]; ++k) sum += value[k] * in[column[k]];
        CHECK_NEAR(out[q], sum, 0, 1e-12 * most);
    }
    free(start), free(column), free(value);
    peri_matrix_destroy(matrix);
    peri_body_destroy(b);
}

/* ---- breaking -------------------------------------------------------------------------------------------------------- */

typedef struct tear {
    double  error, fracture, step;
    int64_t broken;
} tear;

/* A cracked plate, its upper half thrown up: it tears while the ledger is kept. part: of the stable step. */
static tear torn(int32_t law, int32_t moments, double part, int32_t threads, double *u) {
    const way w = {PERI_SPACE_PLANE_STRESS, law, PERI_KERNEL_BEST, PERI_QUADRATURE_FULL, PERI_CORRECTION_NONE, PERI_GEOMETRY_NONLINEAR};
    specimen s = cracked(w, moments);
    s.desc.threads = threads;
    s.material.critical_stretch = 0.03;
    peri_body *b = specimen_make(&s);
    const int64_t n = peri_size_of_field(b, PERI_FIELD_VELOCITY);
    double *x = (double *)calloc((size_t)(2 * n), sizeof *x), *v = x + n;
    peri_advance_desc a;
    peri_energy e;
    tear t;
    (void)MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, across, NULL));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, n));
    for (int64_t k = 1; k < n; k += 2) v[k] = 0.03 * (x[k] - MIDDLE);
    (void)MUST(b, peri_set_field(b, PERI_FIELD_VELOCITY, v, n));
    peri_advance_desc_init(&a);
    a.duration = 6;
    a.safety = part;
    (void)MUST(b, peri_advance(b, &a));
    (void)MUST(b, peri_get_energy(b, &e));
    t.error = e.error / e.fracture;
    t.fracture = e.fracture;
    t.broken = peri_broken_count(b);
    t.step = peri_stable_step(b);
    if (u) (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, n));
    free(x);
    peri_body_destroy(b);
    return t;
}

/* Truth: energy balance. Its error falls with the step; breaking takes energy, and does so in whole families, too. The bound of the step,
   which falls on live families as few bonds come to carry what many did, holds for whole ones to the half. */
static void breaking_closes_the_ledger(void) {
    for (int32_t law = PERI_LAW_LPS; law <= PERI_LAW_OTERKUS; ++law) {
        const tear coarse = torn(law, PERI_MOMENTS_WHOLE, 0.5, 1, NULL), fine = torn(law, PERI_MOMENTS_WHOLE, 0.1, 1, NULL);
        const tear live = torn(law, PERI_MOMENTS_LIVE, 0.5, 1, NULL);
        printf("    law %d: %d bonds, ledger %.1e and %.1e of the fracture energy; stable step %.3f whole, %.3f live\n", law,
               (int)coarse.broken, coarse.error, fine.error, coarse.step, live.step);
        CHECK(coarse.broken > 20 && coarse.fracture > 0);
        CHECK(fabs(coarse.error) < 2e-2 && fabs(fine.error) < 2e-3);
        CHECK(coarse.step > live.step);
    }
}

static void same_bits_on_any_threads(void) {
    double u[3][12 * 9 * 2];
    for (int k = 0; k < 3; ++k) (void)torn(PERI_LAW_LPS, PERI_MOMENTS_WHOLE, 0.9, 1 + k, u[k]);
    CHECK(memcmp(u[0], u[1], sizeof u[0]) == 0 && memcmp(u[0], u[2], sizeof u[0]) == 0);
}

/* Truth: dt <= 2/sqrt(the largest eigenvalue of M^-1 K), here by the power method, with bonds cut at random: up to nine in ten. */
static void stable_step_holds(void) {
    for (int32_t law = PERI_LAW_LPS; law <= PERI_LAW_OTERKUS; ++law)
        for (int k = 0; k < 4; ++k) {
            const way w = {PERI_SPACE_PLANE_STRAIN, law, PERI_KERNEL_BEST, PERI_QUADRATURE_FULL, PERI_CORRECTION_NONE,
                           PERI_GEOMETRY_LINEAR};
            specimen s = cracked(w, PERI_MOMENTS_WHOLE);
            s.material.critical_stretch = 1;
            s.material.poisson = k % 2 ? 0.45 : 0.2;
            peri_body *b = specimen_make(&s);
            chance cut = {(uint64_t)(11 + k), 0.3 * k};
            const double before = peri_stable_step(b);
            (void)MUST(b, peri_cut_if(b, PERI_CUT_NOW, by_chance, &cut));
            const double most = stiffest(b, 0, 60), step = peri_stable_step(b);
            CHECK(step * sqrt(most) <= 2 && step * sqrt(most) > (k < 3 ? 0.8 : 0.4));
            CHECK(step >= 0.8 * before);
            peri_body_destroy(b);
        }
}

/* A clone goes on as its original does, and memory is what it was: the option takes none. */
static void clones_and_memory(void) {
    const way w = {PERI_SPACE_SOLID, PERI_LAW_OTERKUS, PERI_KERNEL_BEST, PERI_QUADRATURE_RAMP, PERI_CORRECTION_NONE, PERI_GEOMETRY_LINEAR};
    specimen whole = cracked(w, PERI_MOMENTS_WHOLE), live = cracked(w, PERI_MOMENTS_LIVE);
    peri_body *b = specimen_make(&whole), *c = NULL, *l = specimen_make(&live);
    peri_memory m[2];
    (void)MUST(b, peri_body_clone(b, &c, NULL));
    (void)MUST(b, peri_cut_if(b, PERI_CUT_NOW, across, NULL));
    (void)MUST(c, peri_cut_if(c, PERI_CUT_NOW, across, NULL));
    (void)MUST(l, peri_cut_if(l, PERI_CUT_NOW, across, NULL));
    wave_to(b, 0.01);
    wave_to(c, 0.01);
    wave_to(l, 0.01);
    CHECK(same_forces(b, c) && !same_forces(b, l));
    (void)MUST(b, peri_get_memory(b, &m[0]));
    (void)MUST(l, peri_get_memory(l, &m[1]));
    CHECK(m[0].total == m[1].total);
    peri_body_destroy(b);
    peri_body_destroy(c);
    peri_body_destroy(l);
}

/* Truth: Newton's third law and an equilibrium. A cracked plate pulled at two edges: what both supports give cancels. */
static void an_equilibrium_balances(void) {
    const way w = {PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_KERNEL_BEST, PERI_QUADRATURE_FULL, PERI_CORRECTION_NONE,
                   PERI_GEOMETRY_LINEAR};
    double force[2];
    for (int k = 0; k < 2; ++k) {
        specimen s = cracked(w, k ? PERI_MOMENTS_WHOLE : PERI_MOMENTS_LIVE);
        peri_body *b = specimen_make(&s);
        const double low[2] = {-1, -1}, low_to[2] = {13, 2}, high[2] = {-1, 7}, high_to[2] = {13, 10}, up[2] = {0, 0.01};
        double below[2], above[2];
        peri_solve_desc d;
        (void)MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, across, NULL));
        const int32_t foot = (int32_t)MUST(b, peri_select_box(b, NULL, low, low_to));
        const int32_t head = (int32_t)MUST(b, peri_select_box(b, NULL, high, high_to));
        const int32_t held = (int32_t)MUST(b, peri_prescribe_displacement(b, foot, PERI_AXIS_XY, NULL, NULL, NULL));
        const int32_t pulled = (int32_t)MUST(b, peri_prescribe_displacement(b, head, PERI_AXIS_XY, up, NULL, NULL));
        peri_solve_desc_init(&d);
        (void)MUST(b, peri_solve(b, &d, NULL));
        (void)MUST(b, peri_get_reaction(b, held, below));
        (void)MUST(b, peri_get_reaction(b, pulled, above));
        CHECK(above[1] > 0);
        CHECK_NEAR(below[1], -above[1], 1e-6, 0);
        force[k] = above[1];
        peri_body_destroy(b);
    }
    CHECK(force[1] < force[0]); /* nothing makes up for what is cut                                                     */
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(forces_by_hand);
    RUN(nothing_else_changes);
    RUN(forces_derive_from_the_energy);
    RUN(assembled_matrix_is_the_product);
    RUN(breaking_closes_the_ledger);
    RUN(same_bits_on_any_threads);
    RUN(stable_step_holds);
    RUN(clones_and_memory);
    RUN(an_equilibrium_balances);
    return test_end("test_moments");
}
