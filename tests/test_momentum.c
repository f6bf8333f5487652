/* SPDX-License-Identifier: MIT */
/* test_momentum.c - momentum of bodies whose points have different volumes, in every law, loader, rule and precision. SOURCE OF TRUTH:
   Newton's third law. The forces of the bonds of a body add up to nothing but the rounding of the sums, which the state is in; whatever
   rounds a bond rounds it for both ends alike. */
#include "scene.h"

enum { CLOUD, BOXES, TWINS, GIVEN, TEXTBOOK, LOADERS };

typedef struct mix {
    int32_t space, law, other, precision, geometry, correction, quadrature, criterion; /* other: of the right part, or 0: one material */
    int loader;
    double s0; /* critical stretch, 0: none                                                                             */
} mix;

/* Two parts side by side, the right one stiffer and heavier where it is of another material. CLOUD: moved cells, by the list; TEXTBOOK:
   the same by the reference kernel; BOXES: lattices of spacings 1 and 3/4, by columns in the plane; TWINS: of the same spacing; GIVEN:
   scattered points of different volumes with families of the caller. */
static void add_parts(peri_body *b, const mix *s, const int32_t *id) {
    const int dim = dim_of(s->space), nx = dim == 2 ? 10 : 3, ny = dim == 2 ? 6 : 3, nz = dim == 2 ? 1 : 3, end = dim == 2 ? 16 : 6;
    const double lo[3] = {0, 0, 0}, hi[3] = {nx, ny, nz}, next[3] = {nx, 0, 0}, far_[3] = {end, ny, nz};
    double x[3 * 96], volume[96], reach = dim == 2 ? 2.3 : 1.8;
    int32_t material[96], families[96 * 32];
    uint64_t seed = 5;
    int n = 0;
    if (s->loader == CLOUD || s->loader == TEXTBOOK) {
        MUST(b, peri_add_perturbed_box(b, id[0], lo, hi, 1, 0.9, 7));
        MUST(b, peri_add_perturbed_box(b, id[1], next, far_, 1, 0.9, 9));
    } else if (s->loader != GIVEN) {
        MUST(b, peri_add_box(b, id[0], lo, hi, 1));
        MUST(b, peri_add_box(b, id[1], next, far_, s->loader == BOXES ? 0.75 : 1));
    } else {
        for (int z = 0; z < nz; ++z)
            for (int y = 0; y < ny; ++y)
                for (int k = 0; k < end; ++k, ++n) {
                    const double at[3] = {k, y, z};
                    for (int d = 0; d < dim; ++d) x[n * dim + d] = at[d] + 0.3 * test_random(&seed);
                    volume[n] = 0.5 + test_random(&seed);
                    material[n] = id[k >= nx];
                }
        for (int i = 0; i < n; ++i) {
            int found = 0;
            for (int j = 0; j < n; ++j) {
                double square = 0;
                for (int d = 0; d < dim; ++d) square += pow(x[i * dim + d] - x[j * dim + d], 2);
                if (j != i && square < reach * reach && found < 32) families[i * 32 + found++] = j;
            }
            CHECK(found > 2 && found < 32);
            while (found < 32) families[i * 32 + found++] = i;
        }
        MUST(b, peri_add_points(b, n, x, volume, material));
        MUST(b, peri_set_families(b, 32, families));
    }
}

static peri_body *mixed_body(const mix *s) {
    specimen p = specimen_of(s->space, s->law, 0.2, 1, s->space == PERI_SPACE_SOLID ? 1.8 : 2.3, 1, 1, 1);
    int32_t id[2];
    p.desc.precision = s->precision;
    p.desc.geometry = s->geometry;
    p.desc.correction = s->correction;
    p.desc.quadrature = s->quadrature;
    if (s->loader == TEXTBOOK) p.desc.kernel = PERI_KERNEL_REFERENCE;
    p.material.critical_stretch = s->s0;
    if (s->criterion != PERI_CRITERION_STRETCH) {
        p.material.criterion = s->criterion;
        p.material.fracture_energy = 1e-3;
    }
    peri_body *b = specimen_start(&p);
    id[0] = id[1] = peri_id(b, PERI_KIND_MATERIAL, 1);
    if (s->other) {
        const specimen q = specimen_of(s->space, s->other, 0.2, 1, 1, 1, 1, 1);
        peri_material_desc right = q.material;
        right.young = 2.7;
        right.density = 1.3;
        right.criterion = p.material.criterion;
        right.critical_stretch = p.material.critical_stretch;
        right.fracture_energy = p.material.fracture_energy;
        id[1] = (int32_t)MUST(b, peri_add_material(b, &right));
    }
    add_parts(b, s, id);
    MUST(b, peri_build(b));
    return b;
}

/* |sum of f V| over the sum of |f| V, where all points are moved by up to 2 % of a spacing. */
static double unbalance(peri_body *b, int dim) {
    const int64_t n = peri_point_count(b);
    double *u = random_field(n * dim, 0.02, 3), *f, *volume = get(b, PERI_FIELD_VOLUME), sum[3] = {0, 0, 0}, size = 0;
    put(b, PERI_FIELD_DISPLACEMENT, u);
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    for (int64_t k = 0; k < n * dim; ++k) {
        sum[k % dim] += f[k] * volume[k / dim];
        size += fabs(f[k]) * volume[k / dim];
    }
    CHECK(size > 1e-3);
    free(u);
    free(f);
    free(volume);
    return sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / size;
}

static void balances(const mix *s, double *worst) {
    peri_body *b = mixed_body(s);
    const double left = unbalance(b, dim_of(s->space)), ulp = s->precision == PERI_PRECISION_SINGLE ? ULP32 : ULP64;
    const int plain = s->quadrature == PERI_QUADRATURE_FULL && s->correction == PERI_CORRECTION_NONE;
    if (s->loader == BOXES && s->space != PERI_SPACE_SOLID && plain)
        CHECK(strncmp(peri_kernel_text(b), "columns", 7) == 0);
    if (!(left <= 2 * ulp)) {
        CHECK(left <= 2 * ulp);
        printf("    law %d and %d, loader %d, rule %d, correction %d, geometry %d: %.1e\n", (int)s->law % 100, (int)s->other % 100,
               s->loader, (int)s->quadrature % 100, (int)s->correction % 100, (int)s->geometry % 100, left);
    }
    *worst = fmax(*worst, left);
    peri_body_destroy(b);
}

/* Of every pair of laws, loader and rule of weights. Each of the 100 forces is rounded by up to one unit, and these add up like a walk: two
   units. Weights that both ends round each for itself leave 1e-9 in mixed precision. */
static void forces_of_bonds_balance(void) {
    static const int32_t rules[6][2] = {{PERI_QUADRATURE_FULL, PERI_CORRECTION_NONE}, {PERI_QUADRATURE_FULL, PERI_CORRECTION_MOMENT},
                                        {PERI_QUADRATURE_RAMP, PERI_CORRECTION_NONE}, {PERI_QUADRATURE_PARTIAL, PERI_CORRECTION_MOMENT},
                                        {PERI_QUADRATURE_FULL, PERI_CORRECTION_VOLUME},
                                        {PERI_QUADRATURE_PARTIAL_MOMENT, PERI_CORRECTION_NONE}};
    for (int32_t precision = PERI_PRECISION_DOUBLE; precision < peri__end_precision; ++precision) {
        double worst = 0;
        for (int way = 0, turn = 0; way < 4 * 5 * LOADERS; ++way)
            for (int rule = 0; rule < 6; ++rule, ++turn) {
                const int32_t law = PERI_LAW_BOND_BASED + way % 4, other = way / 4 % 5 ? PERI_LAW_BOND_BASED + way / 4 % 5 - 1 : 0;
                mix s = {PERI_SPACE_PLANE_STRAIN, law, other, precision, PERI_GEOMETRY_NONLINEAR, rules[rule][1], rules[rule][0],
                         PERI_CRITERION_STRETCH, way / 20, 0};
                if (rule == 5 && (law != PERI_LAW_BOND_BASED || other > PERI_LAW_BOND_BASED)) continue; /* of springs alone */
                if (precision != PERI_PRECISION_MIXED && !test_long && turn % 7) continue;
                if (turn % 3 == 0) s.geometry = PERI_GEOMETRY_LINEAR;
                balances(&s, &worst);
                if (rule > 0 || turn % 2) continue;
                s.space = PERI_SPACE_SOLID;
                balances(&s, &worst);
            }
        printf("    precision %d: at most %.1e of their sizes\n", (int)precision % 100, worst);
    }
}

/* The same through fracture: bonds near their limit are done one by one at one end, and by vectors at the other. Momentum is that at the
   start but for one rounding of each velocity per step, again like a walk: less than one unit times the steps. */
static void momentum_is_kept_through_fracture(void) {
    const int64_t steps = 30;
    double worst = 0;
    int64_t least = INT64_MAX;
    for (int way = 0, turn = 0; way < 4 * 5 * 3 * 3; ++way) {
        static const int loaders[3] = {CLOUD, BOXES, TWINS};
        const int32_t law = PERI_LAW_BOND_BASED + way % 4, other = way / 4 % 5 ? PERI_LAW_BOND_BASED + way / 4 % 5 - 1 : 0;
        const int32_t criterion = PERI_CRITERION_STRETCH + way / 60;
        mix s = {PERI_SPACE_PLANE_STRAIN, law, other, PERI_PRECISION_MIXED, PERI_GEOMETRY_NONLINEAR, PERI_CORRECTION_NONE,
                 PERI_QUADRATURE_FULL, criterion, loaders[way / 20 % 3], criterion == PERI_CRITERION_STRETCH ? 0.02 : 0};
        double before[3], after[3], size = 0;
        if (criterion != PERI_CRITERION_STRETCH && (law == PERI_LAW_BOND_BASED || other == PERI_LAW_BOND_BASED)) continue;
        if (++turn % 2) s.geometry = PERI_GEOMETRY_LINEAR;
        if (turn % 5 == 0) s.correction = PERI_CORRECTION_MOMENT;
        if (turn % 7 == 0) s.space = PERI_SPACE_SOLID;
        const int dim = dim_of(s.space);
        peri_body *b = mixed_body(&s);
        double *x = get(b, PERI_FIELD_POSITION), *v = random_field(peri_point_count(b) * dim, 0.01, 4);
        for (int64_t i = 0; i < peri_point_count(b); ++i) v[i * dim] += x[i * dim] > (dim == 3 ? 3 : 8) ? 0.1 : -0.1;
        for (int64_t k = 0; k < peri_point_count(b) * dim; ++k) size += fabs(v[k]);
        put(b, PERI_FIELD_VELOCITY, v);
        MUST(b, peri_get_momentum(b, before, NULL));
        go(b, PERI_INTEGRATOR_VELOCITY_VERLET, steps, 0.4 * peri_stable_step(b), 0);
        MUST(b, peri_get_momentum(b, after, NULL));
        for (int d = 0; d < dim; ++d) {
            CHECK(fabs(after[d] - before[d]) <= (double)steps * ULP64 * size);
            worst = fmax(worst, fabs(after[d] - before[d]) / size);
        }
        CHECK(peri_broken_count(b) > 2);
        least = peri_broken_count(b) < least ? peri_broken_count(b) : least;
        free(x);
        free(v);
        peri_body_destroy(b);
    }
    printf("    off by at most %.1e of the sum of all; %d bonds or more broke\n", worst, (int)least);
}

/* A body at rest that vibrates stays where it is, in 1000 steps (100,000 with --long): its momenta walk by a unit of rounding of the state
   per step. Angular momentum of mixed precision feels the rounding of the directions of bonds, which is single. Clouds, law by law. */
static void a_body_at_rest_stays(void) {
    const int64_t steps = test_long ? 100000 : 1000;
    for (int way = 0; way < 3 * 4; ++way) {
        const int32_t precision = PERI_PRECISION_DOUBLE + way / 4;
        const mix s = {PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED + way % 4, 0, precision, PERI_GEOMETRY_NONLINEAR, PERI_CORRECTION_NONE,
                       PERI_QUADRATURE_FULL, PERI_CRITERION_STRETCH, CLOUD, 0};
        const double ulp = precision == PERI_PRECISION_SINGLE ? ULP32 : ULP64;
        const double turn_ulp = precision == PERI_PRECISION_DOUBLE ? ULP64 : ULP32;
        peri_body *b = mixed_body(&s);
        double *u = random_field(peri_size_of_field(b, PERI_FIELD_DISPLACEMENT), 0.02, 8), p[2], l[1], size = 0, turn = 0;
        put(b, PERI_FIELD_DISPLACEMENT, u);
        go(b, PERI_INTEGRATOR_VELOCITY_VERLET, steps, 0, 0);
        MUST(b, peri_get_momentum(b, p, l));
        double *x = get(b, PERI_FIELD_POSITION), *v = get(b, PERI_FIELD_VELOCITY);
        for (int64_t i = 0; i < peri_point_count(b); ++i) {
            size += hypot(v[2 * i], v[2 * i + 1]);
            turn += hypot(v[2 * i], v[2 * i + 1]) * hypot(x[2 * i], x[2 * i + 1]);
        }
        printf("    precision %d, law %d: %.1e of momentum, %.1e of angular momentum\n", (int)precision % 100, (int)s.law % 100,
               hypot(p[0], p[1]) / size, fabs(l[0]) / turn);
        CHECK(size > 0.1);
        CHECK(hypot(p[0], p[1]) <= sqrt((double)steps) * ulp * size);
        CHECK(fabs(l[0]) <= sqrt((double)steps) * turn_ulp * turn);
        free(u);
        free(x);
        free(v);
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(forces_of_bonds_balance);
    RUN(momentum_is_kept_through_fracture);
    RUN(a_body_at_rest_stays);
    return test_end("test_momentum");
}
