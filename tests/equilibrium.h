/* SPDX-License-Identifier: MIT */
/* equilibrium.h - what the tests of statics share: a solve in one line, the assembled stiffness as a dense matrix, its factorisation, and
   equilibria found with that alone. */
#ifndef EQUILIBRIUM_H
#define EQUILIBRIUM_H

#include "scene.h"

static inline peri_solve_desc statics_of(double tolerance) {
    peri_solve_desc s;
    peri_solve_desc_init(&s);
    s.tolerance = tolerance;
    return s;
}

static inline peri_solve_report solve(peri_body *b, const peri_solve_desc *s) {
    peri_solve_report r;
    memset(&r, 0, sizeof r);
    (void)MUST(b, peri_solve(b, s, &r));
    return r;
}

static inline int32_t last_code(const peri_body *b) {
    peri_error e;
    return peri_get_error(b, &e) == PERI_OK ? e.code : PERI_OK;
}

/* The points of lo..hi in spacings, whatever lies beyond in the axes not given. */
static inline int32_t slab(peri_body *b, int axis, double from, double to) {
    double lo[3] = {-1e6, -1e6, -1e6}, hi[3] = {1e6, 1e6, 1e6};
    lo[axis] = from;
    hi[axis] = to;
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}

static inline double norm(const double *v, int64_t n) {
    double sum = 0;
    int64_t k;
    for (k = 0; k < n; ++k) sum += v[k] * v[k];
    return sqrt(sum);
}

static inline double furthest(const double *a, const double *b, int64_t n) { /* largest |a - b| */
    double most = 0;
    int64_t k;
    for (k = 0; k < n; ++k) most = fmax(most, fabs(a[k] - b[k]));
    return most;
}

/* Force of each dof that belongs to a force density: times volume and thickness. */
static inline double *forces_of(peri_body *b, const double *density, int32_t space) {
    double *v = get(b, PERI_FIELD_VOLUME), *f;
    int64_t n = peri_point_count(b), k;
    int dim = peri_dimension(b);
    f = (double *)calloc((size_t)(n * dim), sizeof *f);
    for (k = 0; k < n * dim; ++k) f[k] = density[k] * v[k / dim] * thickness(space);
    free(v);
    return f;
}

/* The assembled stiffness, n x n; counts = 1: checks that the columns ascend. */
static inline double *dense_stiffness(peri_body *b, int64_t *n) {
    peri_matrix *m = NULL;
    int64_t rows, entries, i, k, *start;
    int32_t *column;
    double *value, *a;
    *n = 0;
    if (MUST(b, peri_matrix_create(b, &m)) < 0) return NULL;
    rows = peri_matrix_rows(m);
    entries = peri_matrix_entries(m);
    start = (int64_t *)calloc((size_t)rows + 1, sizeof *start);
    column = (int32_t *)calloc((size_t)entries, sizeof *column);
    value = (double *)calloc((size_t)entries, sizeof *value);
    a = (double *)calloc((size_t)(rows * rows), sizeof *a);
    CHECK(peri_get_matrix(m, start, column, value) == PERI_OK);
    CHECK(start[0] == 0 && start[rows] == entries && rows == peri_point_count(b) * peri_dimension(b));
    for (i = 0; i < rows; ++i)
        for (k = start[i]; k < start[i + 1]; ++k) {
            if (k > start[i] && column[k] <= column[k - 1]) test_bad++;
            a[i * rows + column[k]] = value[k];
        }
    free(start);
    free(column);
    free(value);
    peri_matrix_destroy(m);
    *n = rows;
    return a;
}

/* ---- Cholesky ----------------------------------------------------------------------------------------------------- */

/* The lower factor in place of the lower triangle; rows and columns of held dofs are those of the identity. Returns 0 where it is not
   positive definite. */
static inline int factorise(double *a, int64_t n, const unsigned char *held) {
    int64_t i, j, k;
    for (i = 0; i < n; ++i)
        for (j = 0; j < n; ++j)
            if (held && (held[i] || held[j])) a[i * n + j] = i == j;
    for (i = 0; i < n; ++i)
        for (j = 0; j <= i; ++j) {
            double sum = a[i * n + j];
            for (k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
            if (i == j && !(sum > 0)) return 0;
            a[i * n + j] = i == j ? sqrt(sum) : sum / a[j * n + j];
        }
    return 1;
}

static inline void substitute(const double *a, int64_t n, double *x) {
    int64_t i, k;
    for (i = 0; i < n; ++i) {
        for (k = 0; k < i; ++k) x[i] -= a[i * n + k] * x[k];
        x[i] /= a[i * n + i];
    }
    for (i = n; i-- > 0;) {
        for (k = i + 1; k < n; ++k) x[i] -= a[k * n + i] * x[k];
        x[i] /= a[i * n + i];
    }
}

/* A bound of |K^-1| on free dofs: of a force of size 1 no displacement is larger. By inverse iteration, a tenth added. */
static inline double softness(const double *factor, int64_t n, const unsigned char *held) {
    double *x = random_field(n, 1, 99), size = 0;
    int64_t k;
    int turn;
    for (k = 0; k < n; ++k)
        if (held && held[k]) x[k] = 0;
    for (turn = 0; turn < 60; ++turn) {
        double s = norm(x, n);
        for (k = 0; k < n; ++k) x[k] /= s;
        substitute(factor, n, x);
        size = norm(x, n);
    }
    free(x);
    return 1.1 * size;
}

/* u of K u = load on free dofs, with the given values on held ones; reaction = K u - load, if wanted. Returns the softness. */
static inline double dense_equilibrium(const double *stiffness, int64_t n, const unsigned char *held, const double *given,
                                       const double *load, double *u, double *reaction) {
    double *a = (double *)malloc((size_t)(n * n) * sizeof *a), soft;
    int64_t i, k;
    memcpy(a, stiffness, (size_t)(n * n) * sizeof *a);
    for (i = 0; i < n; ++i) {
        u[i] = held[i] ? given[i] : load[i];
        for (k = 0; k < n && !held[i]; ++k)
            if (held[k]) u[i] -= stiffness[i * n + k] * given[k];
    }
    CHECK(factorise(a, n, held));
    substitute(a, n, u);
    soft = softness(a, n, held);
    for (i = 0; reaction && i < n; ++i) {
        reaction[i] = -load[i];
        for (k = 0; k < n; ++k) reaction[i] += stiffness[i * n + k] * u[k];
        if (!held[i]) reaction[i] = 0;
    }
    free(a);
    return soft;
}

#endif
