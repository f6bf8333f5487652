/* SPDX-License-Identifier: MIT */
/* solid.h - a body of any law in a few lines, and the solid that it stands for: its moduli, energy and stress. */
#ifndef SOLID_H
#define SOLID_H

#include "scene.h"

typedef struct solid {
    int32_t space, law, correction, geometry, precision, influence, quadrature;
    double  nu, stabilization, ratio, spacing; /* stabilization < 0: the default; ratio = horizon/spacing                   */
} solid;

static const char *const correction_name[] = {"", "none", "volume", "energy", "moment", "equilibrium"};

static inline int parts_of(int dim) { return dim == 3 ? 6 : 3; }

/* Small strains, double, full volumes, constant influence, horizon 3; Poisson ratio 0.3 where the law lets one choose. */
static inline solid solid_of(int32_t space, int32_t law, int32_t correction) {
    solid s;
    s.space = space;
    s.law = law;
    s.correction = correction;
    s.geometry = PERI_GEOMETRY_LINEAR;
    s.precision = PERI_PRECISION_DOUBLE;
    s.influence = PERI_INFLUENCE_CONSTANT;
    s.quadrature = PERI_QUADRATURE_FULL;
    s.nu = law == PERI_LAW_BOND_BASED ? bond_nu(space) : 0.3;
    s.stabilization = -1;
    s.ratio = 3;
    s.spacing = H;
    return s;
}

/* Lame's constants such that sigma = lambda tr(eps) + 2 mu eps with the in-plane strains (plane stress: lambda' of E, nu). */
static inline void lame(int32_t space, double nu, double *lambda, double *mu) {
    const moduli e = moduli_of(space, nu);
    *lambda = e.lambda;
    *mu = e.mu;
}

/* W = 1/2 lambda (tr eps)^2 + mu eps:eps, and sigma. eps packed. */
static inline double solid_energy(const solid *s, const double *eps) {
    const moduli e = moduli_of(s->space, s->nu);
    double trace = 0, norm = 0;
    int dim = dim_of(s->space), k;
    for (k = 0; k < parts_of(dim); ++k) {
        if (k < dim) trace += eps[k];
        norm += (k < dim ? 1 : 2) * eps[k] * eps[k];
    }
    return 0.5 * e.lambda * trace * trace + e.mu * norm;
}
static inline void solid_stress(const solid *s, const double *eps, double *sigma) {
    const moduli e = moduli_of(s->space, s->nu);
    double trace = 0;
    int dim = dim_of(s->space), k;
    for (k = 0; k < dim; ++k) trace += eps[k];
    for (k = 0; k < parts_of(dim); ++k) sigma[k] = 2 * e.mu * eps[k] + (k < dim ? e.lambda * trace : 0);
}

/* A block of nx x ny (x nz) cells with a corner at the origin. */
static inline specimen solid_specimen(const solid *s, int nx, int ny, int nz) {
    specimen p = specimen_of(s->space, s->law, s->nu, s->spacing, s->ratio, nx, ny, nz);
    p.desc.correction = s->correction;
    p.desc.geometry = s->geometry;
    p.desc.precision = s->precision;
    p.desc.influence = s->influence;
    p.desc.quadrature = s->quadrature;
    p.desc.thickness = thickness(s->space);
    p.material.young = YOUNG;
    p.material.density = DENSITY;
    if (s->law == PERI_LAW_CORRESPONDENCE && s->stabilization >= 0) p.material.stabilization = s->stabilization;
    return p;
}

static inline peri_material_desc solid_material(const solid *s) { return solid_specimen(s, 1, 1, 1).material; }

/* A body without points, with its material. */
static inline peri_body *solid_new(const solid *s) {
    const specimen p = solid_specimen(s, 1, 1, 1);
    return specimen_start(&p);
}

static inline peri_body *solid_block(const solid *s, int nx, int ny, int nz) {
    const specimen p = solid_specimen(s, nx, ny, nz);
    return specimen_make(&p);
}

/* u = h x with h[dim*dim], row by row. */
static inline void stretch_by(peri_body *b, const double *h) {
    double *x = get(b, PERI_FIELD_POSITION), *u = get(b, PERI_FIELD_DISPLACEMENT);
    int64_t i, n = peri_point_count(b);
    int dim = peri_dimension(b), a, c;
    for (i = 0; i < n; ++i)
        for (a = 0; a < dim; ++a) {
            u[i * dim + a] = 0;
            for (c = 0; c < dim; ++c) u[i * dim + a] += h[a * dim + c] * x[i * dim + c];
        }
    put(b, PERI_FIELD_DISPLACEMENT, u);
    free(x);
    free(u);
}

/* The symmetric h of a packed strain. */
static inline void strain_matrix(int dim, const double *eps, double *h) {
    int a, c;
    for (a = 0; a < dim; ++a)
        for (c = 0; c < dim; ++c) h[a * dim + c] = eps[packed(dim, a, c)];
}

#endif
