/* SPDX-License-Identifier: MIT */
/* oracle_rest.h - laws of a body at rest: what any elastic body does, whatever it is made of. */
#ifndef ORACLE_REST_H
#define ORACLE_REST_H

#include "oracle_scene.h"

typedef struct verdict { /* of one law on one scene                                                                      */
    scene      *s;
    const char *law;
    int         bad, loud, idle; /* idle: the law had nothing to say here                                                 */
    int         asked;           /* 1: bad alone is counted                                                              */
    double      worst; /* error over its bound, and of what                                                              */
    const char *what;
} verdict;

static void within(verdict *v, double error, double bound, const char *what) {
    const double part = bound > 0 ? error / bound : error > 0 ? HUGE_VAL : 0;
    if (!(part <= v->worst)) {
        v->worst = part;
        v->what = what;
    }
    if (error <= bound) return;
    if (v->asked) {
        v->bad++;
        return;
    }
    if (v->loud) printf("    %s: %s off by %.3g, at most %.3g\n", v->law, what, error, bound);
    if (!v->loud && v->bad == 0)
        printf("    scene %d breaks \"%s\": %s off by %.3g, at most %.3g (build/tests/test_oracles %d)\n", (int)v->s->seed, v->law, what,
               error, bound, (int)v->s->seed);
    v->bad++;
    test_bad++;
}

/* ---- what a body does ---------------------------------------------------------------------------------------------- */

/* What acts on a cell per force density. */
static double cell_of(const scene *s, int64_t i) { return s->volume[i] * (s->dim == 2 ? s->desc.thickness : 1); }

/* The largest force density on point i that displacements up to `size` can make, and half of the energy that goes with it. */
static double force_scale(const scene *s, int64_t i, double size) { return s->rho[i] * s->stiff * size; }
static double energy_scale(const scene *s, double size) {
    double sum = 0;
    for (int64_t i = 0; i < s->count; ++i) sum += force_scale(s, i, size) * cell_of(s, i) * size;
    return sum;
}

static void forces_at(const scene *s, const double *u, double *f) {
    put(s->body, PERI_FIELD_DISPLACEMENT, u);
    MUST(s->body, peri_get_field(s->body, PERI_FIELD_FORCE_DENSITY, f, s->dofs));
}

static double energy_at(const scene *s, const double *u) {
    peri_energy e;
    put(s->body, PERI_FIELD_DISPLACEMENT, u);
    MUST(s->body, peri_get_energy(s->body, &e));
    return e.elastic;
}

/* u + a p */
static const double *sum_of(const scene *s, const double *u, double a, const double *p) {
    static double out[3 * MOST];
    for (int64_t k = 0; k < s->dofs; ++k) out[k] = u[k] + a * p[k];
    return out;
}

/* sum f.u V */
static double work_of(const scene *s, const double *f, const double *u) {
    double sum = 0;
    for (int64_t k = 0; k < s->dofs; ++k) sum += f[k] * u[k] * cell_of(s, k / s->dim);
    return sum;
}

/* Forces against those wanted, each over the scale of its point. */
static void forces_agree(verdict *v, const double *f, const double *want, double size, double bound, const char *what) {
    double worst = 0;
    for (int64_t k = 0; k < v->s->dofs; ++k) {
        const double off = fabs(f[k] - want[k]) / force_scale(v->s, k / v->s->dim, size);
        if (!(off <= worst)) worst = off;
    }
    within(v, worst, bound, what);
}

static int is_linear(const scene *s) { return s->desc.geometry == PERI_GEOMETRY_LINEAR; }
static int always(const scene *s) { return s != NULL; }

/* The rule of centroids pulls at a place beside the point: where cells differ the two ends of a bond feel different pulls, and no energy
   belongs to them (theory.md). */
static int is_mutual(const scene *s) {
    return s->desc.quadrature != PERI_QUADRATURE_PARTIAL_CENTROID || !is_scattered(s);
}

/* The rule of centroids is not objective (peri.h, theory.md: for comparison). */
static int is_objective(const scene *s) { return s->desc.quadrature != PERI_QUADRATURE_PARTIAL_CENTROID; }
static int is_quadratic(const scene *s) { return is_linear(s) && is_mutual(s); }
static int has_stiffness(const scene *s) { return s->desc.quadrature != PERI_QUADRATURE_PARTIAL_CENTROID; } /* else refused */
static int can_superpose(const scene *s) { return is_linear(s) || has_stiffness(s); }

/* ---- momentum ------------------------------------------------------------------------------------------------------ */

/* Off while mixed precision rounds the weights of both ends of a bond, which differ where volumes do: sums then drift by 6e-8. */
#ifndef ORACLE_MIXED_MOMENTUM
#define ORACLE_MIXED_MOMENTUM 1 /* 1: momentum to the rounding of the state in every precision                           */
#endif
static double momentum_unit(const scene *s) { return ORACLE_MIXED_MOMENTUM ? state_unit(s) : bond_unit(s); }

/* Third law: sum f V = 0. */
static void momentum(verdict *v) {
    const scene *s = v->s;
    double f[3 * MOST], sum[3] = {0, 0, 0}, scale = 0;
    forces_at(s, s->u, f);
    for (int64_t k = 0; k < s->dofs; ++k) sum[k % s->dim] += f[k] * cell_of(s, k / s->dim);
    for (int64_t i = 0; i < s->count; ++i) scale += force_scale(s, i, s->size) * cell_of(s, i);
    within(v, largest(sum, s->dim), roundings(s) * momentum_unit(s) * scale, "sum of forces");
}

/* sum y x f V = 0 with y where the points are, of linear geometry where they were. */
static void angular_momentum(verdict *v) {
    const scene *s = v->s;
    double f[3 * MOST], sum[3] = {0, 0, 0}, scale = 0;
    forces_at(s, s->u, f);
    for (int64_t i = 0; i < s->count; ++i) {
        double y[3] = {0, 0, 0}, g[3] = {0, 0, 0};
        for (int d = 0; d < s->dim; ++d) {
            y[d] = s->x[i * s->dim + d] - s->x[d] + (is_linear(s) ? 0 : s->u[i * s->dim + d]);
            g[d] = f[i * s->dim + d] * cell_of(s, i);
        }
        for (int d = 0; d < 3; ++d) sum[d] += y[(d + 1) % 3] * g[(d + 2) % 3] - y[(d + 2) % 3] * g[(d + 1) % 3];
        scale += force_scale(s, i, s->size) * cell_of(s, i) * (s->reach + s->size);
    }
    within(v, largest(sum, 3), (rounding(s) + 4 * ends_of(s, 0)) * scale, "sum of moments");
}

/* ---- frames of the observer: the body moved as a whole ------------------------------------------------------------- */

/* A rotation by any angle about any axis (quaternions), from a seed. */
static void some_rotation(uint64_t seed, int dim, double *r) {
    double q[4], norm = 0;
    for (int k = 0; k < 4; ++k) q[k] = dim == 2 && (k == 1 || k == 2) ? 0 : 2 * test_random(&seed) - 1;
    for (int k = 0; k < 4; ++k) norm += q[k] * q[k];
    for (int k = 0; k < 4; ++k) q[k] /= sqrt(norm);
    for (int a = 0; a < 3; ++a) {
        const int c = (a + 1) % 3, e = (a + 2) % 3;
        r[3 * a + a] = 1 - 2 * (q[c + 1] * q[c + 1] + q[e + 1] * q[e + 1]);
        r[3 * a + c] = 2 * (q[a + 1] * q[c + 1] - q[0] * q[e + 1]);
        r[3 * a + e] = 2 * (q[a + 1] * q[e + 1] + q[0] * q[c + 1]);
    }
}

/* Rounding of the displacements `size` of a body that has moved as a whole, and of the lengths of its bonds, over s->size: each bond feels
   it, and the sum of all is within the scale. */
static double turning(const scene *s, double size) {
    const double cells = state_unit(s) * (size + s->reach) + bond_unit(s) * 2 * s->desc.horizon;
    return 16 * cells / s->size * (s->gradient ? 50 : 1) + 2 * rounding(s);
}

/* F(u + c) = F(u) */
static void moved_along(verdict *v) {
    const scene *s = v->s;
    double f[3 * MOST], g[3 * MOST], c[3 * MOST];
    for (int64_t k = 0; k < s->dofs; ++k) c[k] = s->u[k] + s->spacing * 3 * s->value[k % s->dim];
    forces_at(s, s->u, f);
    forces_at(s, c, g);
    forces_agree(v, g, f, s->size, turning(s, 4 * s->spacing), "forces after a translation");
    within(v, fabs(energy_at(s, c) - energy_at(s, s->u)), 2 * turning(s, 4 * s->spacing) * energy_scale(s, s->size), "energy");
}

/* The displacements of the body deformed by u (NULL: not at all), then turned about its first point: R (x + u) - x; of linear geometry
   u + W x with W = (R - R^T)/2. */
static void turn_body(const scene *s, const double *r, const double *u, double *out) {
    for (int64_t i = 0; i < s->count; ++i)
        for (int a = 0; a < s->dim; ++a) {
            const double own = u ? u[i * s->dim + a] : 0;
            double sum = 0;
            for (int c = 0; c < s->dim; ++c) {
                const double x = s->x[i * s->dim + c] - s->x[c], moved = u ? u[i * s->dim + c] : 0;
                if (is_linear(s)) sum += 0.5 * (r[3 * a + c] - r[3 * c + a]) * x;
                else sum += (r[3 * a + c] - (a == c)) * x + r[3 * a + c] * moved;
            }
            out[i * s->dim + a] = is_linear(s) ? own + sum : sum;
        }
}

/* A rigid motion makes no force and has no energy. */
static void rigid_motion(verdict *v) {
    const scene *s = v->s;
    double r[9], u[3 * MOST], f[3 * MOST], none[3 * MOST] = {0};
    some_rotation(s->seed, s->dim, r);
    turn_body(s, r, NULL, u);
    const double bound = turning(s, 2 * s->reach);
    forces_at(s, u, f);
    forces_agree(v, f, none, s->size, bound, "forces of a rigid motion");
    within(v, fabs(energy_at(s, u)), bound * bound * energy_scale(s, s->size), "energy of a rigid motion");
}

/* F(R (x + u) - x) = R F(u): the observer turns; the body and the directions of its bonds stay what they are. */
static void turned_observer(verdict *v) {
    const scene *s = v->s;
    double r[9], u[3 * MOST], f[3 * MOST], g[3 * MOST], want[3 * MOST];
    some_rotation(s->seed + 1, s->dim, r);
    turn_body(s, r, s->u, u);
    forces_at(s, s->u, f);
    forces_at(s, u, g);
    for (int64_t k = 0; k < s->dofs; ++k) {
        want[k] = is_linear(s) ? f[k] : 0;
        for (int c = 0; !is_linear(s) && c < s->dim; ++c) want[k] += r[3 * (k % s->dim) + c] * f[k - k % s->dim + c];
    }
    const double bound = turning(s, 3 * s->reach);
    forces_agree(v, g, want, s->size, bound, "forces after a rotation");
    within(v, fabs(energy_at(s, u) - energy_at(s, s->u)), 2 * bound * energy_scale(s, s->size), "energy after a rotation");
}

/* ---- potential ----------------------------------------------------------------------------------------------------- */

/* Bond lengths have derivatives n! (b/a)^n a of order n along displacements that change them by b, a the present length. */
static double sharpness(const scene *s) { return 2 * s->size / (0.5 * s->shortest); }

/* A step of differences where what Richardson's rule leaves, h^4, meets the rounding over h. */
static double step_of(const scene *s) { return is_linear(s) ? 1 : ldexp(1, (int)floor(log2(rounding(s)) / 5)); }

/* -F.p is the derivative of the energy along p: central differences, exact of the quadratic energy of linear geometry, else by Richardson's
   rule with an error of h^4 E'''''/480. */
static void potential(verdict *v) {
    const scene *s = v->s;
    const double h = step_of(s), scale = energy_scale(s, 2 * s->size);
    double f[3 * MOST], slope[2];
    forces_at(s, s->u, f);
    for (int k = 0; k < 2; ++k) {
        const double part = k ? 0.5 * h : h, above = energy_at(s, sum_of(s, s->u, part, s->p));
        slope[k] = (above - energy_at(s, sum_of(s, s->u, -part, s->p))) / (2 * part);
    }
    const double found = is_linear(s) ? slope[0] : (4 * slope[1] - slope[0]) / 3;
    const double left = is_linear(s) ? 0 : 4 * pow(h, 4) * pow(sharpness(s), 3);
    within(v, fabs(found + work_of(s, f, s->p)), (left + 4 * rounding(s) / h) * scale, "derivative of the energy");
}

/* Of linear geometry forces are linear: the energy is -F.u/2 (Clapeyron). */
static void quadratic_energy(verdict *v) {
    const scene *s = v->s;
    double f[3 * MOST];
    forces_at(s, s->u, f);
    const double off = energy_at(s, s->u) + 0.5 * work_of(s, f, s->u);
    within(v, fabs(off), 2 * rounding(s) * energy_scale(s, s->size), "energy less half the work");
}

static void product(const scene *s, const double *p, double *out) { MUST(s->body, peri_multiply_stiffness(s->body, p, out, s->dofs)); }

/* K p is minus the derivative of the forces along p. */
static void tangent(verdict *v) {
    const scene *s = v->s;
    const double h = step_of(s);
    double f[4][3 * MOST], k[3 * MOST], found[3 * MOST];
    put(s->body, PERI_FIELD_DISPLACEMENT, s->u);
    product(s, s->p, k);
    for (int n = 0; n < 4; ++n) forces_at(s, sum_of(s, s->u, (n % 2 ? -1 : 1) * (n < 2 ? h : 0.5 * h), s->p), f[n]);
    for (int64_t n = 0; n < s->dofs; ++n) {
        const double wide = (f[0][n] - f[1][n]) / (2 * h), near = (f[2][n] - f[3][n]) / h;
        found[n] = is_linear(s) ? wide : (4 * near - wide) / 3;
        k[n] /= -cell_of(s, n / s->dim);
    }
    const double left = is_linear(s) ? 0 : 8 * pow(h, 4) * pow(sharpness(s), 4);
    forces_agree(v, k, found, 2 * s->size, left + 4 * rounding(s) / h, "product with the stiffness");
}

/* Maxwell, Betti: q.K p = p.K q, at any displacement. */
static void reciprocity(verdict *v) {
    const scene *s = v->s;
    double one[3 * MOST], other[3 * MOST], sum = 0;
    put(s->body, PERI_FIELD_DISPLACEMENT, s->u);
    product(s, s->p, one);
    product(s, s->q, other);
    for (int64_t k = 0; k < s->dofs; ++k) sum += s->q[k] * one[k] - s->p[k] * other[k];
    within(v, fabs(sum), 4 * rounding(s) * energy_scale(s, s->size), "q.K p - p.K q");
}

/* K (a p + b q) = a K p + b K q; of linear geometry forces, too. */
static void superposition(verdict *v) {
    const scene *s = v->s;
    const double a = 0.75, b = -1.5;
    double one[3 * MOST], other[3 * MOST], both[3 * MOST], sum[3 * MOST];
    for (int64_t k = 0; k < s->dofs; ++k) sum[k] = a * s->p[k] + b * s->q[k];
    put(s->body, PERI_FIELD_DISPLACEMENT, s->u);
    for (int forces = !has_stiffness(s); forces <= is_linear(s); ++forces) {
        void (*of)(const scene *, const double *, double *) = forces ? forces_at : product;
        of(s, s->p, one);
        of(s, s->q, other);
        of(s, sum, both);
        for (int64_t k = 0; k < s->dofs; ++k) {
            const double cell = forces ? 1 : cell_of(s, k / s->dim);
            one[k] = (a * one[k] + b * other[k]) / cell;
            both[k] /= cell;
        }
        forces_agree(v, both, one, s->size, 6 * rounding(s), forces ? "forces of a sum" : "stiffness times a sum");
    }
}

#endif
