/* SPDX-License-Identifier: MIT */
/* test_stable_step.c - how close peri_stable_step is to the true limit.
   SOURCE OF TRUTH: an explicit step is stable up to 2/sqrt(L), L the largest eigenvalue of M^-1 K. Small bodies: all eigenvalues of
   the matrix of differences of the force, by Jacobi's rotations. Larger ones: the power method on peri_multiply_stiffness, and runs,
   which stay bounded just below the limit and do not just above it. */
#include "specimen.h"
#include "stiffest.h"

#define CLOSE 1.05 /* true limit over peri_stable_step, where it is an estimate; 1.10 is promised */

static double *get(peri_body *b, int32_t field) {
    const int64_t n = peri_size_of_field(b, field);
    double *out = (double *)calloc((size_t)n + 1, sizeof *out);
    (void)MUST(b, peri_get_field(b, field, out, n));
    return out;
}

/* ---- the truth ------------------------------------------------------------------------------------------------------ */

/* The least and largest eigenvalue of the symmetric a[n][n], which is lost: rotations until what is beside the diagonal is nothing. */
static void eigenvalues(double *a, int64_t n, double *least, double *most) {
    int64_t p, q, k;
    int sweep;
    for (sweep = 0; sweep < 60; ++sweep) {
        double beside = 0, all = 0;
        for (p = 0; p < n; ++p)
            for (q = 0; q < n; ++q) {
                all += a[p * n + q] * a[p * n + q];
                if (p != q) beside += a[p * n + q] * a[p * n + q];
            }
        if (beside <= 1e-20 * all) break;
        for (p = 0; p < n; ++p)
            for (q = p + 1; q < n; ++q) {
                const double apq = a[p * n + q];
                double phi, t, c, s;
                if (apq * apq <= 1e-26 * all / (double)(n * n)) continue;
                phi = 0.5 * (a[q * n + q] - a[p * n + p]) / apq;
                t = (phi < 0 ? -1 : 1) / (fabs(phi) + sqrt(phi * phi + 1));
                c = 1 / sqrt(t * t + 1);
                s = t * c;
                for (k = 0; k < n; ++k) {
                    const double x = a[p * n + k], y = a[q * n + k];
                    a[p * n + k] = c * x - s * y;
                    a[q * n + k] = s * x + c * y;
                }
                for (k = 0; k < n; ++k) {
                    const double x = a[k * n + p], y = a[k * n + q];
                    a[k * n + p] = c * x - s * y;
                    a[k * n + q] = s * x + c * y;
                }
            }
    }
    CHECK(sweep < 60);
    *least = *most = a[0];
    for (p = 1; p < n; ++p) {
        *least = fmin(*least, a[p * n + p]);
        *most = fmax(*most, a[p * n + p]);
    }
}

/* Of M^(-1/2) K M^(-1/2) from the forces under unit displacements on top of the present state; density: of the points. Geometry is
   linear. */
static void dense(peri_body *b, const double *density, double *least, double *most) {
    const int64_t n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT), dim = peri_dimension(b);
    double *a = (double *)calloc((size_t)(n * n), sizeof *a), *u = (double *)calloc((size_t)n, sizeof *u), *f0, *f, *v;
    int64_t i, j;
    v = get(b, PERI_FIELD_VOLUME);
    for (i = 0; i < n / dim; ++i) v[i] *= density[i];
    f0 = get(b, PERI_FIELD_FORCE_DENSITY);
    for (j = 0; j < n; ++j) {
        u[j] = 1;
        (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, n));
        f = get(b, PERI_FIELD_FORCE_DENSITY);
        for (i = 0; i < n; ++i) a[i * n + j] = (f0[i] - f[i]) / density[i / dim] * sqrt(v[i / dim] / v[j / dim]);
        u[j] = 0;
        free(f);
    }
    (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, n));
    for (i = 0; i < n; ++i)
        for (j = 0; j < i; ++j) a[i * n + j] = a[j * n + i] = 0.5 * (a[i * n + j] + a[j * n + i]);
    eigenvalues(a, n, least, most);
    free(a), free(u), free(f0), free(v);
}

/* ---- random bodies -------------------------------------------------------------------------------------------------- */

static int pick(uint64_t *seed, int count) { return (int)(test_random(seed) * count); }

#define MOST 27 /* points of a random body */
static int64_t random_points(peri_body *b, uint64_t *seed, int32_t dim, const int32_t *ids, const double *densities, int materials,
                             double *density, int *used) {
    const double lo[3] = {0, 0, 0};
    double hi[3] = {1, 1, 1}, x[3 * 24], v[24];
    int32_t which[24];
    const int how = materials > 1 ? 2 : pick(seed, 3), n = 2 + pick(seed, dim == 3 ? 16 : 22);
    int k, d, m;
    for (k = 0; k < MOST; ++k) density[k] = densities[0];
    used[0] = how < 2;
    if (how < 2) {
        for (d = 0; d < dim; ++d) hi[d] = 1 + pick(seed, dim == 3 ? 3 : 5);
        return how ? peri_add_perturbed_box(b, ids[0], lo, hi, 1, test_random(seed), 3) : peri_add_box(b, ids[0], lo, hi, 1);
    }
    for (k = 0; k < n; ++k) { /* the k-th of a grid, moved */
        const int edge = dim == 3 ? 3 : 5;
        x[dim * k] = k % edge + 0.7 * test_random(seed);
        x[dim * k + 1] = k / edge % edge + 0.7 * test_random(seed);
        if (dim == 3) x[dim * k + 2] = k / (edge * edge) + 0.7 * test_random(seed);
        v[k] = 0.4 + 1.2 * test_random(seed);
        m = pick(seed, materials);
        which[k] = ids[m];
        density[k] = densities[m];
        used[m] = 1;
    }
    return peri_add_points(b, n, x, v, which);
}

typedef struct trial {
    int    sharp;   /* 1: must be within CLOSE */
    int    counted; /* 1: could be built       */
    double ratio;   /* true limit over ours    */
    double least;   /* that it may be          */
} trial;

static trial random_body(uint64_t number) {
    trial t = {0, 0, 0, 0};
    uint64_t seed = 1000 * number + 17;
    double density[MOST], densities[3], least, most;
    int32_t ids[3], law[3], status;
    peri_body_desc d;
    peri_body *b;
    const int materials = pick(&seed, 3) ? 1 : 2 + pick(&seed, 2), breakable = pick(&seed, 3) == 0, standing = pick(&seed, 2);
    int k, pairwise = 1, used[3] = {0, 0, 0};
    chance c = {0, 0};
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS + pick(&seed, 3);
    d.geometry = PERI_GEOMETRY_LINEAR;
    d.threads = 1;
    d.horizon = 1.5 + 2 * test_random(&seed);
    d.precision = PERI_PRECISION_DOUBLE + (pick(&seed, 2) ? 0 : pick(&seed, 3));
    d.influence = pick(&seed, 2) ? PERI_INFLUENCE_CONSTANT : PERI_INFLUENCE_CONSTANT + pick(&seed, 15);
    d.quadrature = pick(&seed, 2) ? PERI_QUADRATURE_FULL : PERI_QUADRATURE_FULL + pick(&seed, 3);
    d.correction = pick(&seed, 2) ? PERI_CORRECTION_NONE : PERI_CORRECTION_NONE + pick(&seed, 4);
    d.kernel = PERI_KERNEL_BEST + pick(&seed, 3);
    (void)MUST(NULL, peri_body_create(&d, &b, NULL));
    for (k = 0; k < materials; ++k) {
        peri_material_desc m;
        law[k] = PERI_LAW_BOND_BASED + (k > 0 && pick(&seed, 2) ? law[0] - PERI_LAW_BOND_BASED : pick(&seed, 4));
        peri_material_desc_init(&m, law[k]);
        m.young = exp(2 * test_random(&seed) - 1);
        m.density = densities[k] = exp(3 * test_random(&seed) - 1.5);
        if (law[k] != PERI_LAW_BOND_BASED) m.poisson = -0.3 + 0.75 * test_random(&seed);
        if (breakable) m.critical_stretch = 1e6;
        ids[k] = (int32_t)MUST(b, peri_add_material(b, &m));
    }
    status = (int32_t)random_points(b, &seed, d.space == PERI_SPACE_SOLID ? 3 : 2, ids, densities, materials, density, used);
    if (status >= 0) status = peri_build(b);
    if (status >= 0) {
        for (k = 0; k < materials; ++k) pairwise = pairwise && (!used[k] || law[k] == PERI_LAW_BOND_BASED);
        c.seed = seed;
        c.share = pick(&seed, 2) ? 0 : 0.7 * test_random(&seed);
        if (c.share > 0) (void)MUST(b, peri_cut_if(b, standing ? PERI_CUT_NOW : PERI_CUT_INITIAL, by_chance, &c));
        dense(b, density, &least, &most);
        t.counted = most > 0; /* a bond is left */
        t.ratio = 2 / sqrt(most) / peri_stable_step(b);
        t.sharp = least > -1e-6 * most && !(breakable && !pairwise);
        /* a pairwise body stands for all that the reset brings back; what its weights are is not told */
        if (pairwise && (breakable || c.share > 0))
            t.sharp = t.sharp && !standing && d.influence != PERI_INFLUENCE_POLE_HALF && d.correction != PERI_CORRECTION_MOMENT;
        t.least = 1 - (d.precision == PERI_PRECISION_DOUBLE ? 1e-12 : 1e-6); /* two points: the bound is the limit, but for rounding */
        if (t.counted && (!(t.ratio >= t.least) || (t.sharp && !(t.ratio <= CLOSE))))
            printf("    body %d: space %d precision %d influence %d quadrature %d correction %d, law %d, %d materials, breakable %d, "
                   "cut %.2f (%d): ratio %.4f, eigenvalues %.3g %.3g\n", (int)number, (int)d.space, (int)d.precision, (int)d.influence,
                   (int)d.quadrature, (int)d.correction, (int)law[0], materials, breakable, c.share, standing, t.ratio, least, most);
    }
    peri_body_destroy(b);
    return t;
}

static void random_bodies_of(uint64_t first, int count) {
    double least = HUGE_VAL, most = 0, loose = 0;
    int sharp = 0, bodies = 0;
    uint64_t number;
    for (number = first; bodies < count && number < first + 4 * (uint64_t)count; ++number) {
        const trial t = random_body(number);
        if (!t.counted) continue;
        ++bodies;
        sharp += t.sharp;
        least = fmin(least, t.ratio);
        if (t.sharp) most = fmax(most, t.ratio);
        loose = fmax(loose, t.ratio);
        CHECK(t.ratio >= t.least);
        CHECK(!t.sharp || t.ratio <= CLOSE);
    }
    CHECK(bodies == count && 2 * sharp > count);
    printf("    %d bodies: true limit over stable step %.4f to %.4f; %d of them by the estimate, at most %.4f\n", bodies, least,
           loose, sharp, most);
}
static void random_bodies(void) { random_bodies_of(0, test_long ? 500 : 250); }
static void more_random_bodies(void) { random_bodies_of(100000, 10000); }

/* ---- bodies of some size ---------------------------------------------------------------------------------------------- */

/* A box of some size, of unit spacing times `size`. */
static specimen some_box(int32_t space, int32_t law, double size, double reach) {
    if (space == PERI_SPACE_SOLID) return specimen_of(space, law, 0.2, size, reach, 7, 8, 9);
    return specimen_of(space, law, 0.2, size, reach, 20, 24, 1);
}

/* Does the body stay bounded for a while with this step, from small velocities at random? */
static int runs(peri_body *b, double step) {
    const int64_t n = peri_size_of_field(b, PERI_FIELD_VELOCITY);
    double *v = (double *)calloc((size_t)n, sizeof *v);
    uint64_t seed = 3;
    int64_t k;
    peri_advance_desc r;
    peri_energy start, end;
    (void)MUST(b, peri_reset(b));
    for (k = 0; k < n; ++k) v[k] = 1e-6 * (test_random(&seed) - 0.5);
    (void)MUST(b, peri_set_field(b, PERI_FIELD_VELOCITY, v, n));
    free(v);
    (void)MUST(b, peri_get_energy(b, &start));
    peri_advance_desc_init(&r);
    r.steps = 300;
    r.time_step = step;
    r.force_step = 1;
    if (peri_advance(b, &r) < 0) return 0;
    (void)MUST(b, peri_get_energy(b, &end));
    return end.kinetic < 100 * start.kinetic;
}

static void one_size(int32_t law, int32_t space, double scatter, int32_t correction, int32_t influence, double reach) {
    specimen s = some_box(space, law, 0.01, reach);
    double limit, ratio;
    peri_body *b;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.desc.correction = correction;
    s.desc.influence = influence;
    s.scatter = scatter;
    b = specimen_make(&s);
    limit = 2 / sqrt(stiffest(b, 0, test_long ? 3000 : 250));
    ratio = limit / peri_stable_step(b);
    if (!(ratio >= 1 && ratio <= CLOSE)) printf("    law %d space %d scatter %g: %.4f\n", (int)law, (int)space, scatter, ratio);
    CHECK(ratio >= 1 && ratio <= CLOSE);
    CHECK(runs(b, peri_stable_step(b)));
    CHECK(!runs(b, 1.03 * limit));
    if (test_long) CHECK(runs(b, 0.98 * limit));
    peri_body_destroy(b);
}
static void lattices_and_clouds(void) {
    int32_t law, space;
    int w;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
            for (w = 0; w < (test_long ? 6 : 2); ++w) {
                if (!test_long && space == PERI_SPACE_SOLID && (w + law) % 2) continue; /* the other with another law */
                one_size(law, space, w % 2, w == 3 ? PERI_CORRECTION_MOMENT : PERI_CORRECTION_NONE,
                         w / 2 == 1 ? PERI_INFLUENCE_LINEAR : w / 2 == 2 ? PERI_INFLUENCE_INVERSE : PERI_INFLUENCE_CONSTANT, w > 3 ? 2 : 3);
            }
}

/* Two points: K = 2 k, so the limit is 2/sqrt(2 k/m) whatever the law makes of k: by the dense matrix. Three; and two parts apart. */
static void few_points(void) {
    static const double three[6] = {0, 0, 1, 0, 0.4, 0.8}, apart[10] = {0, 0, 1, 0, 50, 0, 51, 0, 50.5, 0.7}, v[5] = {1, 1.3, 0.8, 0.5, 1};
    const double density[24] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    int32_t law;
    int k;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (k = 0; k < 3; ++k) {
            specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, law, 0.3, 1, 1.5, 1, 1, 1);
            double least, most, ratio;
            peri_body *b;
            s.desc.geometry = PERI_GEOMETRY_LINEAR;
            b = specimen_start(&s);
            (void)MUST(b, peri_add_points(b, k == 0 ? 2 : k == 1 ? 3 : 5, k == 2 ? apart : three, v, NULL));
            (void)MUST(b, peri_build(b));
            (void)MUST(b, peri_reset(b)); /* before anybody has asked */
            dense(b, density, &least, &most);
            ratio = 2 / sqrt(most) / peri_stable_step(b);
            CHECK(ratio >= 1 && ratio <= CLOSE);
            peri_body_destroy(b);
        }
}

/* All points within a plane obstacle: K + k n n, whose largest eigenvalue is found from the forces, too. Taken as the sum of both. */
static void obstacles(void) {
    const double place[3] = {0, 0, 100}, normal[3] = {0.6, 0, 0.8}, side[3] = {100, 100, 0}, slope[3] = {0.6, 0.8, 0};
    const double density[24] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    int32_t law, space;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; space += 2) {
            specimen s = specimen_of(space, law, 0.25, 1, 2, 4, 3, 2);
            double least, most, ratio;
            peri_body *b;
            s.desc.geometry = PERI_GEOMETRY_LINEAR;
            b = specimen_make(&s);
            (void)MUST(b, space == PERI_SPACE_SOLID ? plane_obstacle(b, place, normal, 0.5, NULL, NULL)
                                                    : plane_obstacle(b, side, slope, 0.5, NULL, NULL));
            dense(b, density, &least, &most);
            ratio = 2 / sqrt(most) / peri_stable_step(b);
            if (!(ratio >= 1 && ratio <= 1.1)) printf("    law %d space %d: %.4f\n", (int)law, (int)space, ratio);
            CHECK(ratio >= 1 && ratio <= 1.1);
            peri_body_destroy(b);
        }
}

/* Bodies whose bonds may break keep to the bound of stiffness.c, whose slack is its own: below 1 never, and no more than the ratio of
   a direction to all of them, sqrt(D), over the limit of springs. */
static void the_bound(void) {
    int32_t law, space;
    for (law = PERI_LAW_LPS; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space) {
            specimen s = some_box(space, law, 1, 3);
            double ratio;
            peri_body *b;
            s.desc.geometry = PERI_GEOMETRY_LINEAR;
            s.material.critical_stretch = 1e6;
            b = specimen_make(&s);
            ratio = 2 / sqrt(stiffest(b, 0, 250)) / peri_stable_step(b);
            printf("    law %d space %d: %.3f\n", (int)law, (int)space, ratio);
            CHECK(ratio >= 1 && ratio <= (law == PERI_LAW_CORRESPONDENCE ? 2.2 : 1.35));
            peri_body_destroy(b);
        }
}

/* ---- stretched ------------------------------------------------------------------------------------------------------- */

static void deform(peri_body *b, const double *axes) {
    const int64_t n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT), dim = peri_dimension(b);
    double *u = get(b, PERI_FIELD_POSITION);
    int64_t k;
    for (k = 0; k < n; ++k) u[k] *= axes[k % dim] - 1;
    (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, n));
    free(u);
}

/* Unit cells, unit density: of the tangent at the displacement. At rest the step is as sharp as in linear geometry, stretched and squeezed
   it is never too large; of springs it falls no further than to the bound of any stretch. */
static void in_any_shape(void) {
    static const double axes[9][3] = {{1, 1, 1},   {1.02, 1, 1},     {1.1, 1, 1},         {1.4, 1, 1},      {0.5, 1, 1},
                                      {2, 2, 2},   {1.1, 1.1, 1.1},  {1.2, 0.85, 0.85},   {0.8, 1.1, 1.1}};
    int32_t law, space;
    int k, nu;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
            for (nu = 0; nu < (test_long && law != PERI_LAW_BOND_BASED ? 2 : 1); ++nu) {
                specimen s = space == PERI_SPACE_SOLID ? specimen_of(space, law, nu ? 0.45 : 0.2, 1, 2.05, 4, 5, 6)
                                                       : specimen_of(space, law, nu ? 0.45 : 0.2, 1, 3.05, 9, 10, 1);
                peri_body *b = specimen_make(&s);
                const double rest = stiffest(b, 0, 200), step = peri_stable_step(b);
                for (k = 0; k < 9; ++k) {
                    double ratio;
                    if (!test_long && k > 1 && (k + law) % 2) continue; /* the others with another law; all with --long */
                    deform(b, axes[k]);
                    ratio = 2 / sqrt(stiffest(b, rest, 100)) / peri_stable_step(b);
                    CHECK(ratio >= 1);
                    if (k < 2) CHECK(ratio <= 1.1);
                    if (law == PERI_LAW_BOND_BASED) CHECK(peri_stable_step(b) > step / 1.5);
                }
                (void)MUST(b, peri_reset(b));
                CHECK(peri_stable_step(b) == step);
                peri_body_destroy(b);
            }
}

/* SOURCE OF TRUTH: the contract of peri_advance, and the conservation of energy: a free body that is torn apart at 0.3 of the speed
   of sound and swings back keeps its energy: to a tenth where lengths make the forces, to a half where P = F S does, whose waves are
   steep. What is unstable for eight steps is off by a hundred times all of it. */
static void in_large_motion(void) {
    int32_t law, space;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space) {
            specimen s = some_box(space, law, 1, 3);
            double *v, fewest;
            peri_advance_desc r;
            peri_energy e;
            int64_t n, k;
            peri_body *b = specimen_make(&s);
            fewest = 60 / (0.9 * peri_stable_step(b));
            v = get(b, PERI_FIELD_POSITION);
            n = peri_size_of_field(b, PERI_FIELD_VELOCITY);
            for (k = 0; k < n; ++k) v[k] = 0.02 * v[k];
            (void)MUST(b, peri_set_field(b, PERI_FIELD_VELOCITY, v, n));
            free(v);
            peri_advance_desc_init(&r);
            r.duration = 60;
            (void)MUST(b, peri_advance(b, &r));
            (void)MUST(b, peri_get_energy(b, &e));
            CHECK(fabs(e.error) < (law == PERI_LAW_CORRESPONDENCE ? 0.5 : 0.1) * e.initial);
            CHECK((double)peri_step_count(b) > fewest);
            peri_body_destroy(b);
        }
}

/* ---- the same for all ------------------------------------------------------------------------------------------------- */

/* Threads and instruction sets: the bits. Kernels: rounding. Precisions: theirs. */
static void one_answer(void) {
    int32_t law, space;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; law += law == PERI_LAW_LPS && !test_long ? 2 : 1)
        for (space = PERI_SPACE_PLANE_STRAIN; space < peri__end_space; ++space) {
            if (!test_long && space == PERI_SPACE_SOLID && law != PERI_LAW_LPS) continue;
            specimen s = specimen_of(space, law, 0.2, 1, space == PERI_SPACE_SOLID ? 2 : 3, space == PERI_SPACE_SOLID ? 16 : 70,
                                     space == PERI_SPACE_SOLID ? 16 : 70, 16);
            double first = 0;
            int k;
            for (k = 0; k < 8; k += k == 1 ? 2 : 1) {
                static const int32_t sets[3] = {PERI_INSTRUCTIONS_BASELINE, PERI_INSTRUCTIONS_AVX2, PERI_INSTRUCTIONS_AVX512};
                peri_body *b;
                double step;
                s.desc.threads = k == 1 ? 2 : 1;
                s.desc.instructions = k == 3 || k == 4 || k == 5 ? sets[k - 3] : PERI_INSTRUCTIONS_BEST;
                s.desc.precision = k == 6 ? PERI_PRECISION_MIXED : k == 7 ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
                b = specimen_make(&s);
                step = peri_stable_step(b);
                if (k == 0) first = step;
                if (k < 6) CHECK(step == first);
                else CHECK_NEAR(step, first, 1e-5, 0);
                peri_body_destroy(b);
            }
            s.desc.kernel = PERI_KERNEL_LIST;
            {
                peri_body *b = specimen_make(&s);
                CHECK_NEAR(peri_stable_step(b), first, 1e-5, 0);
                peri_body_destroy(b);
            }
        }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(random_bodies);
    LONG_RUN(more_random_bodies);
    RUN(lattices_and_clouds);
    RUN(few_points);
    RUN(obstacles);
    RUN(the_bound);
    RUN(in_any_shape);
    RUN(in_large_motion);
    RUN(one_answer);
    return test_end("test_stable_step");
}
