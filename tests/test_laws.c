/* SPDX-License-Identifier: MIT */
/* test_laws.c - what each law makes of uniform strain and of a checkerboard, and where two laws are one.

   Nothing here was recorded from the library. The truth is classical elasticity (W and stress of a uniform strain), the published
   formulas summed over an ideal lattice by published_laws.h, and an identity between two of the laws. */
#include "published_laws.h"

/* ---- uniform strain in the bulk ------------------------------------------------------------------------------------ */

#define NUS    9
#define MIXED  (3 * NUS) /* points of the block in the middle of a mixed body: three state-based laws times the ratios */

static const double nus[NUS] = {-0.5, 0, 0.1, 0.2, 0.25, 1.0 / 3.0, 0.4, 0.45, 0.49};
static double table[4][5][5][8]; /* [space][law][correction][reach]: largest |sigma - C:eps|/|C| where the function has moments */

/* What a point of the bulk must show. */
typedef struct expected {
    int32_t law;
    double  nu, tolerance, scale; /* of W and stress, relative to scale = largest entry of C */
    tensor4 moduli, solid;
    int     usable; /* 0: only isotropic strain is held against it, see below */
} expected;

/* Tolerances: 1e-12 for sums of up to 924 terms, 1e-10 where a fit is part of it. The moment correction is a compromise where steep
   poles would take large factors (peri.h): POLE_QUARTER, where only the energy of isotropic strain is exact. So it is where Oterkus's
   spring meets the bound of its energy (stiffness_of_law), which is taken of the sums before the fit, hence the 0.8. */
static expected expect(const scene *s, const sums *o, int32_t law, double nu) {
    expected x;
    int fitted = s->correction == PERI_CORRECTION_MOMENT && law != PERI_LAW_CORRESPONDENCE;
    memset(&x, 0, sizeof x);
    x.law = law;
    x.nu = law == PERI_LAW_BOND_BASED ? bond_nu(s->space) : nu;
    stiffness_of_law(s, o, law, nu, &x.moduli);
    stiffness_of_solid(dim_of(s->space), moduli_of(s->space, x.nu), &x.solid);
    x.scale = fmax(largest_entry(&x.moduli), largest_entry(&x.solid));
    x.tolerance = 1e-12 * fmax(o->size / o->m, o->span / fabs(o->length));
    if (fitted) x.tolerance = fmax(x.tolerance, 1e-10);
    x.usable = !fitted || s->influence != PERI_INFLUENCE_POLE_QUARTER;
    if (fitted && law == PERI_LAW_OTERKUS) {
        const moduli e = moduli_of(s->space, nu);
        const int dim = dim_of(s->space);
        const double over = o->m * o->plain / (o->length * o->length) - 1;
        if (dim * (dim + 2) * e.mu * over > 0.8 * e.bulk * dim * dim * (over + 1)) x.usable = 0;
    }
    return x;
}

/* Unit strains xx, yy, (zz,) xy, (yz, xz), then isotropic, then all of them at once; each with a little rotation. */
static void strain_of(int dim, int which, double amount, double grad[3][3], double eps[3][3]) {
    static const int rows[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}, plane[3] = {0, 1, 3};
    static const double all[3][3] = {{0.7, 0.2, -0.3}, {0.2, -0.4, 0.6}, {-0.3, 0.6, 0.5}};
    int count = dim * (dim + 1) / 2, a, b;
    for (a = 0; a < 3; ++a)
        for (b = 0; b < 3; ++b) eps[a][b] = which == count ? delta(a, b) : which > count ? all[a][b] : 0;
    if (which < count) {
        const int *row = rows[dim == 2 ? plane[which] : which];
        eps[row[0]][row[1]] = eps[row[1]][row[0]] = 1;
    }
    for (a = 0; a < 3; ++a)
        for (b = 0; b < 3; ++b) {
            eps[a][b] *= amount;
            grad[a][b] = eps[a][b] + 0.1 * amount * (a < b ? 1 : a > b ? -1 : 0);
        }
}

/* Reads the fields and holds the listed points against what is expected of them. `slack`: relative, what a small strain in the
   nonlinear geometry may differ by. Large bodies show strain, stress and dilatation only for the last two strains. */
static void check_bulk(peri_body *b, const scene *s, int points, const int *point, const expected *x, const sums *o) {
    const int dim = dim_of(s->space), parts = dim * (dim + 1) / 2;
    const double amount = s->geometry == PERI_GEOMETRY_LINEAR ? 1 : 1e-7, slack = s->geometry == PERI_GEOMETRY_LINEAR ? 0 : 20 * amount;
    int which, k, a, c;
    for (which = 0; which < parts + 2; ++which) {
        double grad[3][3], eps[3][3], sigma[3][3], exact[3][3], *f[5] = {NULL}, trace = 0, cond = o->size / o->m;
        const int all = which >= parts || peri_entry_count(b) < 500000;
        strain_of(dim, which, amount, grad, eps);
        stretch_body(b, grad);
        f[0] = get(b, PERI_FIELD_ENERGY_DENSITY);
        f[1] = get(b, PERI_FIELD_FORCE_STRESS);
        if (all) f[2] = get(b, PERI_FIELD_STRESS);
        if (all) f[3] = get(b, PERI_FIELD_STRAIN);
        if (all) f[4] = get(b, PERI_FIELD_DILATATION);
        for (a = 0; a < dim; ++a) trace += eps[a][a];
        for (k = 0; k < points; ++k, ++x) {
            double *worst = &table[s->space % 100][x->law % 100][s->correction % 100][(int)(s->reach + 0.5)];
            double w = 0, tol = x->tolerance + slack;
            contract(dim, &x->moduli, eps, sigma);
            contract(dim, &x->solid, eps, exact);
            for (a = 0; a < dim; ++a)
                for (c = 0; c < dim; ++c) {
                    int at = point[k] * parts + packed(dim, a, c);
                    w += 0.5 * eps[a][c] * sigma[a][c];
                    if (x->usable || which == parts) CHECK_NEAR(f[1][at], sigma[a][c], 0, tol * x->scale * amount);
                    CHECK(f[1][at] - f[1][at] == 0);
                    if (all) CHECK_NEAR(f[2][at], exact[a][c], 0, (1e-12 * cond + slack) * x->scale * amount);
                    if (all) CHECK_NEAR(f[3][at], eps[a][c], 0, (1e-12 * cond + slack) * amount);
                    if (has_moments(s->influence) && s->geometry == PERI_GEOMETRY_LINEAR)
                        *worst = fmax(*worst, fabs(f[1][at] - exact[a][c]) / (largest_entry(&x->solid)));
                }
            if (x->usable || which == parts) CHECK_NEAR(f[0][point[k]], w, 0, tol * x->scale * amount * amount);
            CHECK(f[0][point[k]] - f[0][point[k]] == 0);
            if (all) CHECK_NEAR(f[4][point[k]], trace, 0, (tol + 1e-12 * cond) * amount);
        }
        x -= points;
        for (k = 0; k < 5; ++k) free(f[k]);
    }
}

/* Sites n[0] x n[1] (x n[2]) of the lattice, all of one material, or (material NULL) as given. */
static void add_sites(peri_body *b, int dim, const int *n, const int32_t *material) {
    int count = n[0] * n[1] * (dim == 3 ? n[2] : 1), i, d;
    double *x = (double *)calloc((size_t)(count * dim), sizeof *x), *v = (double *)calloc((size_t)count, sizeof *v);
    for (i = 0; i < count; ++i) {
        int index[3];
        index[0] = i % n[0];
        index[1] = i / n[0] % n[1];
        index[2] = i / n[0] / n[1];
        for (d = 0; d < dim; ++d) x[i * dim + d] = H * (index[d] + 0.5);
        v[i] = pow(H, dim);
    }
    (void)MUST(b, peri_add_points(b, count, x, v, material));
    free(x);
    free(v);
}

/* Points with at least `margin` others between them and every face; returns their number. */
static int inner_points(int dim, const int *n, int margin, int *point) {
    int count = 0, i, total = n[0] * n[1] * (dim == 3 ? n[2] : 1);
    for (i = 0; i < total; ++i) {
        int x = i % n[0], y = i / n[0] % n[1], z = i / n[0] / n[1];
        if (x < margin || x >= n[0] - margin || y < margin || y >= n[1] - margin) continue;
        if (dim == 3 && (z < margin || z >= n[2] - margin)) continue;
        point[count++] = i;
    }
    return count;
}

/* Builds, or says that the influence function is refused by name: which it must be for a bond-based body without moments, and where
   it is infinite (POLE_HALF at |xi| = horizon/2). Returns 1 where the body is built. */
static int build_or_refuse(peri_body *b, const scene *s, int bonds) {
    int infinite = s->influence == PERI_INFLUENCE_POLE_HALF && fabs(fmod(s->reach, 2)) < 1e-9;
    int32_t status = peri_build(b);
    peri_error error;
    if ((bonds && !has_moments(s->influence)) || infinite) CHECK(status == PERI_ERROR_INFLUENCE);
    else (void)MUST(b, status);
    CHECK(peri_get_error(b, &error) == PERI_OK);
    if (status == PERI_ERROR_INFLUENCE) CHECK(strcmp(error.field, "influence") == 0 && error.code == status);
    return status == PERI_OK;
}

/* A body of one material. Bulk: the families of a point and of all its neighbours are whole. In 3D a horizon of 6 spacings needs a
   ball of 24 across. */
static void bulk_of(const scene *s, int32_t law, double nu) {
    const int dim = dim_of(s->space), reach = (int)(s->reach + 0.5);
    int n[3] = {1, 1, 1}, point[8], k, points = 0;
    const double lo[3] = {0, 0, 0};
    double hi[3], centre[3];
    int32_t material;
    expected x[8];
    sums o;
    peri_body *b = scene_body(s);
    for (k = 0; k < dim; ++k) n[k] = 4 * reach + (k == 0 ? 2 : 1);
    for (k = 0; k < 3; ++k) {
        hi[k] = H * n[k];
        centre[k] = H * (2 * reach + 0.5);
    }
    material = add_law(b, law, nu, -1);
    if (dim == 3 && reach > 3) (void)MUST(b, peri_add_ball(b, material, centre, centre[0], H));
    else (void)MUST(b, peri_add_box(b, material, lo, hi, H));
    lattice_sums(s, &o);
    if (build_or_refuse(b, s, law == PERI_LAW_BOND_BASED)) {
        double *at = get(b, PERI_FIELD_POSITION);
        for (k = 0; k < peri_point_count(b); ++k) { /* those that are not nearer to a face than the centre of the box */
            if (fabs(at[k * dim + 1] - centre[1]) > 1e-9 || (dim == 3 && fabs(at[k * dim + 2] - centre[2]) > 1e-9)) continue;
            if (fabs(at[k * dim] - centre[0]) < 1e-9 || (points > 0 && reach < 4 && at[k * dim] < centre[0] + 1.5 * H)) point[points++] = k;
        }
        CHECK(points > 0);
        for (k = 0; k < points; ++k) x[k] = expect(s, &o, law, nu);
        check_bulk(b, s, points, point, x, &o);
        free(at);
    }
    peri_body_destroy(b);
}

/* One body of 27 materials, three state-based laws of nine Poisson ratios, each at one point in the middle of an LPS body. A point's
   energy and its half of the forces are those of its own family and material, so this is one body for all of them, and the families
   of its neighbours need not be whole. */
static void bulk_of_mixture(const scene *s) {
    const int dim = dim_of(s->space), margin = (int)(s->reach + 0.5);
    int n[3], point[MIXED], k, points, count;
    static expected x[MIXED];
    int32_t *material;
    sums o;
    peri_body *b = scene_body(s);
    n[0] = 2 * margin + (dim == 3 ? 3 : 9);
    n[1] = 2 * margin + 3;
    n[2] = dim == 3 ? n[1] : 1;
    count = n[0] * n[1] * n[2];
    material = (int32_t *)calloc((size_t)count, sizeof *material);
    lattice_sums(s, &o);
    points = inner_points(dim, n, margin, point);
    CHECK(points == MIXED);
    material[0] = add_law(b, PERI_LAW_LPS, 0.2, -1);
    for (k = 1; k < count; ++k) material[k] = material[0];
    for (k = 0; k < MIXED; ++k) {
        x[k] = expect(s, &o, laws[1 + k / NUS], nus[k % NUS]);
        material[point[k]] = add_law(b, x[k].law, x[k].nu, -1);
    }
    add_sites(b, dim, n, material);
    if (build_or_refuse(b, s, 0)) check_bulk(b, s, points, point, x, &o);
    free(material);
    peri_body_destroy(b);
}

/* The corrections that change nothing in the bulk (expect) are looked at with the first function only where bodies are large. The weights
   of the equilibrium correction are those of the whole body, not of a lattice: test_balance.c. */
static void bulk_sweep(int32_t space, int influences, const int32_t *functions, double reach) {
    int k;
    for (k = 0; k < influences; ++k) {
        scene s = scene_of(space, PERI_GEOMETRY_LINEAR, functions[k], PERI_CORRECTION_NONE, reach);
        for (; s.correction <= PERI_CORRECTION_MOMENT; ++s.correction) {
            int same = s.correction == PERI_CORRECTION_VOLUME || s.correction == PERI_CORRECTION_ENERGY, large = space == PERI_SPACE_SOLID;
            if (large && same && !test_long) continue; /* planes have them */
            if (!(same && large && k > 0)) bulk_of_mixture(&s);
            if (!(large && k > 0 && (same || reach > 3))) bulk_of(&s, PERI_LAW_BOND_BASED, 0);
        }
    }
}

static const int32_t every[15] = {401, 402, 403, 404, 405, 406, 407, 408, 409, 410, 411, 412, 413, 414, 415}; /* of peri_influence */
static const int32_t some[5] = {PERI_INFLUENCE_CONSTANT, PERI_INFLUENCE_LINEAR, PERI_INFLUENCE_POWER_3, PERI_INFLUENCE_GAUSSIAN,
                                PERI_INFLUENCE_INVERSE};

static void print_table(int32_t space, double reach) {
    static const char *const names[] = {"", "none", "volume", "energy", "moment"};
    int law, correction;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
        printf("    %-13s m = %.0f  %-15s", space_name[space % 100], reach, law_name[law % 100]);
        for (correction = PERI_CORRECTION_NONE; correction <= PERI_CORRECTION_MOMENT; ++correction)
            printf("  %s %.1e", names[correction % 100], table[space % 100][law % 100][correction % 100][(int)(reach + 0.5)]);
        printf("\n");
    }
}

static void bulk_plane_stress(void) { bulk_sweep(PERI_SPACE_PLANE_STRESS, 15, every, 3); }
static void bulk_plane_strain(void) { bulk_sweep(PERI_SPACE_PLANE_STRAIN, 5, some, 3); }
static void bulk_solid(void) { bulk_sweep(PERI_SPACE_SOLID, 1, some, 3); }

static void bulk_long(void) {
    int32_t space;
    double reach;
    memset(table, 0, sizeof table);
    for (reach = 3; reach < 7; reach += 3)
        for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space) {
            int few = space == PERI_SPACE_SOLID && reach > 3;
            bulk_sweep(space, few ? 2 : 15, few ? some : every, reach);
            print_table(space, reach);
        }
}

/* Bodies of one material, and tiny strains in the nonlinear geometry. */
static void pure(int32_t space, int32_t correction) {
    scene s = scene_of(space, PERI_GEOMETRY_LINEAR, PERI_INFLUENCE_CUBIC, correction, 3);
    int k;
    for (s.geometry = PERI_GEOMETRY_NONLINEAR; s.geometry < peri__end_geometry; ++s.geometry)
        for (k = 0; k < LAWS; ++k) bulk_of(&s, laws[k], k % 2 ? 0.4 : 0.1);
}
static void bulk_pure_plane(void) {
    int32_t correction;
    for (correction = PERI_CORRECTION_NONE; correction <= PERI_CORRECTION_MOMENT; ++correction) {
        pure(PERI_SPACE_PLANE_STRESS, correction);
        pure(PERI_SPACE_PLANE_STRAIN, correction);
    }
}
static void bulk_pure_solid(void) {
    pure(PERI_SPACE_SOLID, PERI_CORRECTION_NONE);
    pure(PERI_SPACE_SOLID, PERI_CORRECTION_MOMENT);
}

/* SOURCE OF TRUTH: N = sum w F xi xi V = F K, so F is exact for any family that spans the space, surfaces and irregular cells included,
   and the collapsed stress sum w sigma K^-1 xi xi V = sigma. */
static void correspondence_everywhere(void) {
    int32_t space;
    int k, which;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (k = 0; k < NUS; ++k) {
            scene s = small_scene(space, PERI_GEOMETRY_LINEAR, PERI_CORRECTION_NONE);
            peri_body *b = small_body(&s, PERI_LAW_CORRESPONDENCE, nus[k], -1, 0);
            int dim = dim_of(space), parts = dim * (dim + 1) / 2, a, c;
            tensor4 solid;
            int64_t i;
            stiffness_of_solid(dim, moduli_of(space, nus[k]), &solid);
            for (which = 0; which < parts + 2; ++which) {
                double grad[3][3], eps[3][3], sigma[3][3], *f[4], w = 0, trace = 0, tol = 1e-12 * largest_entry(&solid);
                strain_of(dim, which, 1, grad, eps);
                stretch_body(b, grad);
                contract(dim, &solid, eps, sigma);
                f[0] = get(b, PERI_FIELD_FORCE_STRESS);
                f[1] = get(b, PERI_FIELD_STRAIN);
                f[2] = get(b, PERI_FIELD_ENERGY_DENSITY);
                f[3] = get(b, PERI_FIELD_DILATATION);
                for (a = 0; a < dim; ++a) trace += eps[a][a];
                for (a = 0; a < dim; ++a)
                    for (c = 0; c < dim; ++c) w += 0.5 * sigma[a][c] * eps[a][c];
                for (i = 0; i < peri_point_count(b); ++i) {
                    for (a = 0; a < dim; ++a)
                        for (c = 0; c < dim; ++c) {
                            CHECK_NEAR(f[0][i * parts + packed(dim, a, c)], sigma[a][c], 0, tol);
                            CHECK_NEAR(f[1][i * parts + packed(dim, a, c)], eps[a][c], 0, 1e-12);
                        }
                    CHECK_NEAR(f[2][i], w, 0, tol);
                    CHECK_NEAR(f[3][i], trace, 0, 1e-12);
                }
                for (a = 0; a < 4; ++a) free(f[a]);
            }
            peri_body_destroy(b);
        }
}

/* ---- LPS at the Poisson ratio of springs -------------------------------------------------------------------------- */

/* SOURCE OF TRUTH: an identity. There A = 0 and LPS with w = horizon/|xi| has, in bond (i, j), the force per volume squared
   (B/m_i + B/m_j) w e = (B/S_i + B/S_j) s, S_i = sum |xi| V over the family. The bond-based body with w = 1 calibrated on its own
   families has c_i = 2 D^2 bulk/S_i (stiffness_of_law), its bonds the mean: 1/2 (c_i + c_j) s = (D^2 bulk/S_i + D^2 bulk/S_j) s; and at
   this ratio lambda = mu, so D^2 bulk = D (D lambda + 2 mu) = D (D + 2) mu = B. Hence the forces are equal bond by bond, at surfaces
   too. With the moment correction both fit the same factors x to the same shares |xi| V of their families, LPS for each end and
   bond-based for the mean: (B/S_i x_ij + B/S_j x_ji) s. Energies: V_i V_j (B/S_i + B/S_j) s^2 |xi|/2 summed over bonds in both. Fits stop
   at 1e-15 of a moment, a factor feels that through a system of the condition of the family: 1e-11.
   Without correction the forces are not equal, but theta = D sum w |xi| e V/m = D sum s |xi| V/S is. */
static void same_law(int32_t space, int32_t geometry, int32_t bonds, int32_t states, double tolerance) {
    peri_body *b[2];
    double *f[2], *u, *theta[2], far = 0;
    peri_energy e[2];
    int64_t n = 0, i;
    int k, equal = bonds != PERI_CORRECTION_NONE;
    for (k = 0; k < 2; ++k) {
        const double lo[3] = {0, 0, 0}, hi[3] = {9 * H, 7 * H, 6 * H};
        scene s = scene_of(space, geometry, PERI_INFLUENCE_CONSTANT, bonds, space == PERI_SPACE_SOLID ? 2.1 : 3);
        if (k) s.influence = PERI_INFLUENCE_INVERSE;
        if (k) s.correction = states;
        b[k] = scene_body(&s);
        const int32_t material = add_law(b[k], k ? PERI_LAW_LPS : PERI_LAW_BOND_BASED, bond_nu(space), -1);
        (void)MUST(b[k], peri_add_perturbed_box(b[k], material, lo, hi, H, 0.5, 3));
        (void)MUST(b[k], peri_build(b[k]));
        n = peri_size_of_field(b[k], PERI_FIELD_DISPLACEMENT);
        u = random_field(n, 0.05 * H, 11);
        put(b[k], PERI_FIELD_DISPLACEMENT, u);
        f[k] = get(b[k], PERI_FIELD_FORCE_DENSITY);
        theta[k] = get(b[k], PERI_FIELD_DILATATION);
        (void)MUST(b[k], peri_get_energy(b[k], &e[k]));
        free(u);
    }
    CHECK(largest(f[0], n) > 0.1 * YOUNG * 0.05 / H);
    for (i = 0; i < n; ++i) far = fmax(far, fabs(f[1][i] - f[0][i]) / largest(f[0], n));
    if (equal) {
        CHECK_NEAR(far, 0, 0, tolerance);
        CHECK_NEAR(e[1].elastic, e[0].elastic, tolerance, 0);
    } else {
        CHECK(far > 0.01);
        for (i = 0; i < peri_point_count(b[0]); ++i) CHECK_NEAR(theta[1][i], theta[0][i], 0, tolerance);
    }
    for (k = 0; k < 2; ++k) {
        free(f[k]);
        free(theta[k]);
        peri_body_destroy(b[k]);
    }
}

static void lps_is_bond_based(void) {
    int32_t space, geometry;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry) {
            same_law(space, geometry, PERI_CORRECTION_NONE, PERI_CORRECTION_NONE, 1e-14);
            same_law(space, geometry, PERI_CORRECTION_ENERGY, PERI_CORRECTION_NONE, 1e-12);
            same_law(space, geometry, PERI_CORRECTION_MOMENT, PERI_CORRECTION_MOMENT, 1e-11);
        }
}

/* ---- zero-energy modes -------------------------------------------------------------------------------------------- */

/* u_x = +-a by the colour of the site, geometry linear. SOURCE OF TRUTH: eta is even in xi over a whole family, so sum w eta xi = 0:
   F = 1 and theta = 0 in the bulk. What is left is W = 1/2 k sum w |eta|^2 V, k = stabilization B/m (peri.h), with |eta| = 2a between
   the colours; for LPS 1/2 B/m sum w (eta.xi/|xi|)^2 V. Both ends of a bond give the same half, so the force density is
   2 k sum w eta V = -+ 4 k a sum over the odd bonds of w V: 0 without stabilization. */
static void checkerboard(void) {
    const double a = 0.01 * H;
    int32_t space;
    int k;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (k = 0; k < 5; ++k) {
            static const double stable[5] = {0, 0.25, 0.5, 1, -1};
            scene s = scene_of(space, PERI_GEOMETRY_LINEAR, PERI_INFLUENCE_LINEAR, PERI_CORRECTION_NONE, space == PERI_SPACE_SOLID ? 2 : 3);
            int dim = dim_of(space), reach = (int)s.reach, n[3] = {1, 1, 1}, point[40], points, i;
            int32_t law = stable[k] < 0 ? PERI_LAW_LPS : PERI_LAW_CORRESPONDENCE;
            double big = dim * (dim + 2) * moduli_of(space, 0.2).mu, w, force, *x, *f;
            peri_body *b = scene_body(&s);
            sums o;
            lattice_sums(&s, &o);
            for (i = 0; i < dim; ++i) n[i] = 4 * reach + 2;
            (void)add_law(b, law, 0.2, stable[k]);
            add_sites(b, dim, n, NULL);
            (void)MUST(b, peri_build(b));
            points = inner_points(dim, n, 2 * reach, point);
            CHECK(points == (dim == 3 ? 8 : 4));
            x = get(b, PERI_FIELD_DISPLACEMENT);
            for (i = 0; i < peri_point_count(b); ++i) x[i * dim] = (i % n[0] + i / n[0] % n[1] + i / n[0] / n[1]) % 2 ? -a : a;
            put(b, PERI_FIELD_DISPLACEMENT, x);
            f = get(b, PERI_FIELD_FORCE_DENSITY);
            w = 0.5 * big / o.m * 4 * a * a * (law == PERI_LAW_LPS ? o.odd_x : stable[k] * o.odd);
            force = 2 * big / o.m * 2 * a * (law == PERI_LAW_LPS ? o.odd_x : stable[k] * o.odd);
            CHECK(k == 0 || w > 1e-6 * YOUNG);
            for (i = 0; i < points; ++i)
                CHECK_NEAR(f[point[i] * dim], x[point[i] * dim] > 0 ? -force : force, 1e-12, 1e-13 * YOUNG * a / (H * H));
            free(x);
            x = get(b, PERI_FIELD_ENERGY_DENSITY);
            for (i = 0; i < points; ++i) CHECK_NEAR(x[point[i]], w, 1e-12, 1e-28 * YOUNG);
            free(x);
            free(f);
            peri_body_destroy(b);
        }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(bulk_pure_plane);
    RUN(bulk_plane_stress);
    RUN(bulk_plane_strain);
    RUN(bulk_solid);
    RUN(correspondence_everywhere);
    RUN(lps_is_bond_based);
    RUN(checkerboard);
    LONG_RUN(bulk_pure_solid);
    LONG_RUN(bulk_long);
    return test_end("test_laws");
}
