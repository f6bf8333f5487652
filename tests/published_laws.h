/* SPDX-License-Identifier: MIT */
/* published_laws.h - bodies of every law for test_laws.c and test_operator.c, and the lattice sums of the published laws that they are held
   against, written from the texts: peri.h (laws, influence functions), DESIGN section 2 (A, B), [C] eqs. 8-17 (Oterkus). */
#ifndef PUBLISHED_LAWS_H
#define PUBLISHED_LAWS_H

#include "scene.h"

#define LAWS 4

static const int32_t laws[LAWS] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE};

typedef struct scene {
    int32_t space, geometry, influence, correction, precision;
    double  reach; /* horizon over spacing */
} scene;

static inline scene scene_of(int32_t space, int32_t geometry, int32_t influence, int32_t correction, double reach) {
    scene s;
    s.space = space;
    s.geometry = geometry;
    s.influence = influence;
    s.correction = correction;
    s.precision = PERI_PRECISION_DOUBLE;
    s.reach = reach;
    return s;
}

static inline peri_body *scene_body(const scene *s) {
    specimen p = specimen_of(s->space, PERI_LAW_BOND_BASED, 0, H, s->reach, 1, 1, 1);
    peri_body *b = NULL;
    p.desc.precision = s->precision;
    p.desc.geometry = s->geometry;
    p.desc.influence = s->influence;
    p.desc.correction = s->correction;
    p.desc.thickness = thickness(s->space);
    (void)MUST(NULL, peri_body_create(&p.desc, &b, NULL));
    return b;
}

/* An unbreakable material; nu is not used where it is bond-based, `stable` < 0 leaves the default of the stabilization. */
static inline int32_t add_law(peri_body *b, int32_t law, double nu, double stable) {
    peri_material_desc m;
    peri_material_desc_init(&m, law);
    m.young = YOUNG;
    m.density = DENSITY;
    if (law != PERI_LAW_BOND_BASED) m.poisson = nu;
    if (stable >= 0) m.stabilization = stable;
    return (int32_t)MUST(b, peri_add_material(b, &m));
}

/* ---- the family of a lattice point -------------------------------------------------------------------------------- */

/* w(q) within the horizon, from the table of peri_influence. */
static inline double influence(int32_t kind, double q, double edge) {
    switch (kind) {
    case PERI_INFLUENCE_LINEAR: return 1 - q;
    case PERI_INFLUENCE_CUBIC: return 1 - 3 * q * q + 2 * pow(q, 3);
    case PERI_INFLUENCE_QUINTIC: return 1 - 10 * pow(q, 3) + 15 * pow(q, 4) - 6 * pow(q, 5);
    case PERI_INFLUENCE_SEPTIC: return 1 - 35 * pow(q, 4) + 84 * pow(q, 5) - 70 * pow(q, 6) + 20 * pow(q, 7);
    case PERI_INFLUENCE_POWER_2: return (1 - q) * (1 - q);
    case PERI_INFLUENCE_POWER_3: return pow(1 - q, 3);
    case PERI_INFLUENCE_GAUSSIAN: return exp(-q * q);
    case PERI_INFLUENCE_PROPORTIONAL: return q;
    case PERI_INFLUENCE_INVERSE: return 1 / q;
    case PERI_INFLUENCE_INVERSE_4: return pow(q, -4);
    case PERI_INFLUENCE_POLE_EDGE: return 1 / (1 + edge - q);
    case PERI_INFLUENCE_POLE_HALF: return fabs(1 / (2 * q - 1));
    case PERI_INFLUENCE_POLE_QUARTER: return exp(1 / (q - 0.25));
    default: return 1;
    }
}

/* No moments for bond-based constants: the last three of the table (peri.h). */
static inline int has_moments(int32_t kind) {
    return kind != PERI_INFLUENCE_INVERSE_4 && kind != PERI_INFLUENCE_POLE_HALF && kind != PERI_INFLUENCE_POLE_QUARTER;
}

typedef struct tensor4 {
    double c[3][3][3][3];
} tensor4;

/* Sums over the whole family of a point of the square or cubic lattice, V = H^D. */
typedef struct sums {
    int     bonds;
    double  volume;      /* V                                   */
    double  plain;       /* w V                                 */
    double  m;           /* w |xi|^2 V                          */
    double  size;        /* |w| |xi|^2 V                        */
    double  length;      /* w |xi| V                            */
    double  span;        /* |w| |xi| V                          */
    double  full;        /* integral of w |xi| over the horizon */
    double  odd, odd_x;  /* w V, and w xi_1^2/|xi|^2 V, of the bonds between the two colours of a checkerboard */
    double  t[3][3];     /* w xi xi V                           */
    double  l[3][3];     /* w xi xi/|xi| V                      */
    tensor4 q;           /* w xi xi xi xi/|xi|^2 V              */
    tensor4 r;           /* w xi xi xi xi/|xi|^3 V              */
} sums;

static inline double integral_of_length(const scene *s) { /* of w |xi| over the horizon, by Simpson's rule */
    double edge = 0.5 / s->reach, sum = 0, h = s->reach * H;
    int dim = dim_of(s->space), n = 20000, k;
    if (!has_moments(s->influence)) return 0;
    for (k = 1; k <= n; ++k) {
        double q = (double)k / n;
        sum += (k == n ? 1 : k % 2 ? 4 : 2) / (3.0 * n) * influence(s->influence, q, edge) * pow(q, dim);
    }
    return (dim == 3 ? 4 : 2) * PI * pow(h, dim + 1) * sum;
}

static inline void lattice_sums(const scene *s, sums *o) {
    int dim = dim_of(s->space), reach = (int)(s->reach + 1e-9), n[3], a, b, c, d;
    double cell = pow(H, dim);
    memset(o, 0, sizeof *o);
    for (n[2] = dim == 3 ? -reach : 0; n[2] <= (dim == 3 ? reach : 0); ++n[2])
        for (n[1] = -reach; n[1] <= reach; ++n[1])
            for (n[0] = -reach; n[0] <= reach; ++n[0]) {
                int square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
                double xi[3], len = H * sqrt(square), w;
                if (square == 0 || square > s->reach * s->reach * (1 + 1e-8)) continue;
                w = influence(s->influence, sqrt(square) / s->reach, 0.5 / s->reach) * cell;
                for (a = 0; a < 3; ++a) xi[a] = H * n[a];
                o->bonds++;
                o->volume += cell;
                o->plain += w;
                o->m += w * len * len;
                o->size += fabs(w) * len * len;
                o->length += w * len;
                o->span += fabs(w) * len;
                if ((n[0] + n[1] + n[2]) % 2) o->odd += w;
                if ((n[0] + n[1] + n[2]) % 2) o->odd_x += w * xi[0] * xi[0] / (len * len);
                for (a = 0; a < dim; ++a)
                    for (b = 0; b < dim; ++b) {
                        o->t[a][b] += w * xi[a] * xi[b];
                        o->l[a][b] += w * xi[a] * xi[b] / len;
                        for (c = 0; c < dim; ++c)
                            for (d = 0; d < dim; ++d) {
                                double term = w * xi[a] * xi[b] * xi[c] * xi[d] / (len * len);
                                o->q.c[a][b][c][d] += term;
                                o->r.c[a][b][c][d] += term / len;
                            }
                    }
            }
    o->full = integral_of_length(s);
}

/* ---- what a law makes of a uniform strain: W = 1/2 eps:C:eps, collapsed stress = dW/d eps = C:eps ------------------ */

static inline double delta(int a, int b) { return a == b ? 1 : 0; }

static inline void stiffness_of_solid(int dim, moduli e, tensor4 *o) {
    int a, b, c, d;
    memset(o, 0, sizeof *o);
    for (a = 0; a < dim; ++a)
        for (b = 0; b < dim; ++b)
            for (c = 0; c < dim; ++c)
                for (d = 0; d < dim; ++d)
                    o->c[a][b][c][d] = e.lambda * delta(a, b) * delta(c, d)
                                     + e.mu * (delta(a, c) * delta(b, d) + delta(a, d) * delta(b, c));
}

/* alpha T T + beta Q */
static inline void stiffness_of_sums(int dim, double alpha, double t[3][3], double beta, const tensor4 *q, tensor4 *o) {
    int a, b, c, d;
    for (a = 0; a < dim; ++a)
        for (b = 0; b < dim; ++b)
            for (c = 0; c < dim; ++c)
                for (d = 0; d < dim; ++d) o->c[a][b][c][d] = alpha * t[a][b] * t[c][d] + beta * q->c[a][b][c][d];
}

/* C of a law in the bulk of the lattice.
     bond-based      W = 1/4 c sum w s^2 |xi| V; c such that the integral over the full horizon has the energy 1/2 bulk (D s)^2 of an
                     isotropic stretch: c = 2 D^2 bulk/full. Volume correction: c V0/V, V with the point's own cell; energy correction:
                     the sum has that energy, c = 2 D^2 bulk/sum
     LPS             W = 1/2 A/D theta^2 + 1/2 B/m sum w e^2 V, whose derivative to e is the t of the table. The energy correction
                     changes nothing: sum w e^2 V over the mean of all deviators depends on m alone, which B is divided by
     Oterkus         [C] 8-17: W = a theta^2 + b sum w e^2 V, theta = d sum w e V; d = D/sum w|xi|V ([C] 12), b = mu/(2 S),
                     S = sum w |xi|^2 n_1^2 n_2^2 V ([C] 15, 16: simple shear s has the energy mu s^2/2) on the mean over all directions of
                     the shear: n_1^2 n_2^2 is 1/8 on the mean over the circle, 1/15 over the sphere, so S = m/(D(D+2)) (theory.md);
                     a = (bulk - 2 b m/D^2)/2 ([C] 13, 17: isotropic strain).
                     By Cauchy-Schwarz theta^2 <= d^2 sum w V sum w e^2 V, so W >= 0 needs b + a d^2 sum w V >= 0 where a < 0: no larger b
     correspondence  F is exact for any family, and so is W; the stabilization is 0
   With the moment correction: that of the solid, which is what it is for. */
static inline void stiffness_of_law(const scene *s, const sums *o, int32_t law, double nu, tensor4 *out) {
    int dim = dim_of(s->space);
    double d2 = dim * dim, none[3][3] = {{0}};
    moduli e = moduli_of(s->space, law == PERI_LAW_BOND_BASED ? bond_nu(s->space) : nu);
    if (law == PERI_LAW_CORRESPONDENCE || s->correction == PERI_CORRECTION_MOMENT) {
        stiffness_of_solid(dim, e, out);
    } else if (law == PERI_LAW_LPS) {
        stiffness_of_sums(dim, e.a * dim / (o->m * o->m), (double(*)[3])o->t, e.b / o->m, &o->q, out);
    } else if (law == PERI_LAW_OTERKUS) {
        double b = e.mu / (2 * o->m / (dim == 3 ? 15 : 8));
        double d = dim / o->length, a, over = o->m * o->plain / (o->length * o->length) - 1;
        if (2 * b * o->m * over > e.bulk * d2 * (over + 1)) b = 0.5 * e.bulk * d2 * (over + 1) / (over * o->m);
        a = 0.5 * (e.bulk - 2 * b * o->m / d2);
        stiffness_of_sums(dim, 2 * a * d * d, (double(*)[3])o->l, 2 * b, &o->q, out);
    } else {
        double h = s->reach * H, whole = dim == 3 ? 4.0 / 3 * PI * h * h * h : PI * h * h, c = 2 * d2 * e.bulk / o->full;
        if (s->correction == PERI_CORRECTION_VOLUME) c *= whole / (o->volume + pow(H, dim));
        if (s->correction == PERI_CORRECTION_ENERGY) c = 2 * d2 * e.bulk / o->length;
        stiffness_of_sums(dim, 0, none, 0.5 * c, &o->r, out);
    }
}

static inline void contract(int dim, const tensor4 *t, double eps[3][3], double sigma[3][3]) {
    int a, b, c, d;
    for (a = 0; a < dim; ++a)
        for (b = 0; b < dim; ++b) {
            sigma[a][b] = 0;
            for (c = 0; c < dim; ++c)
                for (d = 0; d < dim; ++d) sigma[a][b] += t->c[a][b][c][d] * eps[c][d];
        }
}

static inline double largest_entry(const tensor4 *t) {
    return largest(&t->c[0][0][0][0], 81);
}

/* ---- uniform deformation ------------------------------------------------------------------------------------------- */

/* Displacements u = grad x of all points. */
static inline void stretch_body(peri_body *b, double grad[3][3]) {
    double *x = get(b, PERI_FIELD_POSITION), u[3];
    int dim = peri_dimension(b), a, c;
    int64_t i;
    for (i = 0; i < peri_point_count(b); ++i) {
        for (a = 0; a < dim; ++a)
            for (c = 0, u[a] = 0; c < dim; ++c) u[a] += grad[a][c] * x[i * dim + c];
        memcpy(&x[i * dim], u, (size_t)dim * sizeof(double));
    }
    put(b, PERI_FIELD_DISPLACEMENT, x);
    free(x);
}

/* ---- small bodies without symmetry ---------------------------------------------------------------------------------- */

/* Half of the bonds, by chance. */
static inline int32_t heads(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    uint64_t seed = (uint64_t)i * 1009u + (uint64_t)j;
    (void)user;
    (void)xi;
    (void)xj;
    return test_random(&seed) < 0.5;
}

/* A perturbed grid of 6 x 5 or 4 x 3 x 3 cells of one law; law 0: the four laws side by side in four such grids. broken: half of
   the bonds are cut. */
static inline peri_body *small_body(const scene *s, int32_t law, double nu, double stable, int broken) {
    static const double lo[4][2] = {{0, 0}, {3, 0}, {0, 3}, {3, 3}};
    int solid = s->space == PERI_SPACE_SOLID, k;
    double from[3] = {0, 0, 0}, to[3];
    peri_body *b = scene_body(s);
    if (law) {
        to[0] = H * (solid ? 4 : 6);
        to[1] = H * (solid ? 3 : 5);
        to[2] = H * 3;
        (void)MUST(b, peri_add_perturbed_box(b, add_law(b, law, nu, stable), from, to, H, 0.8, 7));
    } else {
        for (k = 0; k < LAWS; ++k) {
            double cells = solid ? 2 : 3;
            from[0] = H * lo[k][0] * cells / 3;
            from[1] = H * lo[k][1] * cells / 3;
            to[0] = from[0] + H * cells;
            to[1] = from[1] + H * cells;
            to[2] = H * 3;
            (void)MUST(b, peri_add_perturbed_box(b, add_law(b, laws[k], 0.1 * (k + 1), -1), from, to, H, 0.8, 7 + (uint64_t)k));
        }
    }
    (void)MUST(b, peri_build(b));
    if (broken) CHECK(MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, heads, NULL)) > peri_entry_count(b) / 8);
    return b;
}

/* A regular grid of 33 x 3 or 17 x 3 x 2 cells, of one law: long enough for the kernels that work on rows of a lattice. */
static inline peri_body *lattice_body(const scene *s, int32_t law, double nu, int broken) {
    const double lo[3] = {0, 0, 0}, hi[3] = {H * (s->space == PERI_SPACE_SOLID ? 17 : 33), H * 3, H * 2};
    peri_body *b = scene_body(s);
    (void)MUST(b, peri_add_box(b, add_law(b, law, nu, -1), lo, hi, H));
    (void)MUST(b, peri_build(b));
    if (broken) CHECK(MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, heads, NULL)) > peri_entry_count(b) / 8);
    return b;
}

static inline scene small_scene(int32_t space, int32_t geometry, int32_t correction) {
    return scene_of(space, geometry, PERI_INFLUENCE_GAUSSIAN, correction, space == PERI_SPACE_SOLID ? 1.9 : 2.6);
}

#endif
