/* SPDX-License-Identifier: MIT */
/* test_survivors_shapes.c - what `make mutants` found that no other quick test looked at: parts of cells, corrections, ranges of whole
   bodies, and memory that is given back.

   SOURCE OF TRUTH: areas of discs; the formulas of docs/theory.md by hand; peri.h: what peri_get_memory counts is what the hooks were asked
   for, a call that fails has changed nothing, release gets back all that allocate gave. */
#include "scene.h"
#include <setjmp.h>

/* ---- parts of cells ------------------------------------------------------------------------------------------------ */

/* w = h/|xi| makes the energy density of isotropic strain e that of an area: c e^2 h/4 sum beta V. The parts of all cells but its own are
   those of a disc. Horizons through corners of cells, where a root is at an end, as well as any. */
static void parts_fill_the_disc(void) {
    const double square[6] = {8.5, 18.5, 22.5, 24.5, 9, 7.3};
    int k;
    for (k = 0; k < 12; ++k) {
        const double h = sqrt(square[k % 6]);
        double c = 0, *x, *w;
        int64_t i;
        specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 0, 1, h, 13, 13, 1);
        s.desc.quadrature = PERI_QUADRATURE_PARTIAL;
        s.desc.influence = PERI_INFLUENCE_INVERSE;
        s.desc.geometry = PERI_GEOMETRY_LINEAR;
        s.scatter = k < 6 ? 0 : 1e-300; /* cells as quadrilaterals of the same corners */
        peri_body *b = specimen_make(&s);
        MUST(b, peri_get_bond_constants(b, peri_id(b, PERI_KIND_MATERIAL, 1), peri_id(b, PERI_KIND_MATERIAL, 1), &c, NULL));
        x = get(b, PERI_FIELD_POSITION);
        for (i = 0; i < 2 * peri_point_count(b); ++i) x[i] *= 1e-3;
        put(b, PERI_FIELD_DISPLACEMENT, x);
        w = get(b, PERI_FIELD_ENERGY_DENSITY);
        CHECK_NEAR(w[84] / (0.25 * c * 1e-6 * h), PI * h * h - 1, 1e-6, 0);
        free(x);
        free(w);
        peri_body_destroy(b);
    }
}

/* A moved lattice that comes second has the cells that it has alone: another box far away changes nothing. */
static void parts_of_later_pieces(void) {
    const double far[2] = {100, 100}, beyond[2] = {104, 103}, lo[2] = {0, 0}, hi[2] = {8, 7};
    double *w[2], u[2 * 68];
    int k, i;
    for (k = 0; k < 2; ++k) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 0, 1, 2.3, 8, 7, 1);
        s.desc.quadrature = PERI_QUADRATURE_PARTIAL;
        s.desc.geometry = PERI_GEOMETRY_LINEAR;
        peri_body *b = specimen_start(&s);
        const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
        if (k) MUST(b, peri_add_box(b, material, far, beyond, 1));
        MUST(b, peri_add_perturbed_box(b, material, lo, hi, 1, 0.8, 5));
        MUST(b, peri_build(b));
        double *x = get(b, PERI_FIELD_POSITION);
        for (i = 0; i < 2 * (56 + 12 * k); ++i) u[i] = 1e-3 * x[i];
        put(b, PERI_FIELD_DISPLACEMENT, u);
        w[k] = get(b, PERI_FIELD_ENERGY_DENSITY);
        free(x);
        peri_body_destroy(b);
    }
    for (i = 0; i < 56; ++i) CHECK_NEAR(w[1][12 + i], w[0][i], 1e-9, 0);
    free(w[0]);
    free(w[1]);
}

/* The ramp is 0 beyond horizon + spacing/2, in families of the caller, too. */
static void ramps_end(void) {
    const int32_t rows[12] = {1, 3, 2, 0, 2, 3, 1, 3, 0, 2, 0, 1};
    const double x[8] = {0, 0, 1, 0, 2, 0, 3, 0}, v[4] = {1, 1, 1, 1};
    double u[8] = {0}, *f;
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 1.5);
    peri_body_destroy(b);
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 1.5, 4, 1, 1);
    s.desc.quadrature = PERI_QUADRATURE_RAMP;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    b = specimen_start(&s);
    MUST(b, peri_add_points(b, 4, x, v, NULL));
    MUST(b, peri_set_families(b, 3, rows));
    MUST(b, peri_build(b));
    u[6] = 0.01; /* point 3: one from 2, 3 from 0 */
    put(b, PERI_FIELD_DISPLACEMENT, u);
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    CHECK(f[0] == 0 && f[4] > 0);
    free(f);
    peri_body_destroy(b);
}

/* 1/(1 + spacing/(2 horizon) - q) ends where it would be infinite: cells further out that the horizon still meets weigh nothing. */
static void poles_end(void) {
    double u[2 * 169] = {0}, *f;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 3, 13, 13, 1);
    s.desc.quadrature = PERI_QUADRATURE_PARTIAL;
    s.desc.influence = PERI_INFLUENCE_POLE_EDGE;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *b = specimen_make(&s);
    CHECK(peri_bond_is_intact(b, 6 * 13 + 6, 8 * 13 + 9) == 1); /* (3, 2) from the middle: q = 1.2, a corner within */
    u[2 * (6 * 13 + 6)] = 0.01;
    put(b, PERI_FIELD_DISPLACEMENT, u);
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    CHECK(f[2 * (8 * 13 + 9)] == 0 && f[2 * (8 * 13 + 8)] > 0);
    free(f);
    peri_body_destroy(b);
}

/* Energy density and bond force by the centroid rule, whose centroids are sums over a fine grid here: stress sum t xi V, of the half that a
   point gives, t = c s n/2. */
static void stress_by_centroids(void) {
    const double h = 2.3, e = 1e-3;
    const int fine = 200;
    double c = 0, want = 0, energy = 0, *x, *stress, *w;
    int i, j, p, q;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 0, 1, h, 11, 11, 1);
    s.desc.quadrature = PERI_QUADRATURE_PARTIAL_CENTROID;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *b = specimen_make(&s);
    MUST(b, peri_get_bond_constants(b, peri_id(b, PERI_KIND_MATERIAL, 1), peri_id(b, PERI_KIND_MATERIAL, 1), &c, NULL));
    x = get(b, PERI_FIELD_POSITION);
    for (i = 0; i < 2 * peri_point_count(b); ++i) x[i] *= i % 2 ? 0 : e; /* along x */
    put(b, PERI_FIELD_DISPLACEMENT, x);
    stress = get(b, PERI_FIELD_FORCE_STRESS);
    w = get(b, PERI_FIELD_ENERGY_DENSITY);
    for (i = -3; i <= 3; ++i)
        for (j = -3; j <= 3; ++j) {
            double area = 0, mx = 0, my = 0;
            if (i == 0 && j == 0) continue;
            for (p = 0; p < fine; ++p)
                for (q = 0; q < fine; ++q) {
                    const double y = i - 0.5 + (p + 0.5) / fine, z = j - 0.5 + (q + 0.5) / fine;
                    if (y * y + z * z > h * h) continue;
                    area += 1;
                    mx += y;
                    my += z;
                }
            if (area == 0) continue;
            mx /= area;
            my /= area;
            area /= (double)fine * fine;
            const double bond = hypot(mx, my), stretch = mx * e * i / (bond * bond);
            want += 0.5 * c * stretch * area * mx / bond * mx;
            energy += 0.25 * c * stretch * stretch * bond * area;
        }
    CHECK_NEAR(stress[3 * 60], want, 1e-4, 0);
    CHECK_NEAR(w[60], energy, 1e-4, 0);
    free(x);
    free(stress);
    free(w);
    peri_body_destroy(b);
}

/* ---- corrections --------------------------------------------------------------------------------------------------- */

/* Of volumes: a bond weighs 2 V0/(V_i + V_j), V of a family with its point, whole cells; V0 = pi h^2. What point i does that moves along x
   it does to j by that bond alone: c s n V. */
static void volumes_of_both_ends(void) {
    const int nx = 9, ny = 8;
    double u[2 * 72] = {0}, c = 0, *size, *f;
    int64_t i, j, bad = 0;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 0, 1, 3.1, nx, ny, 1);
    s.desc.correction = PERI_CORRECTION_VOLUME;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *b = specimen_make(&s);
    MUST(b, peri_get_bond_constants(b, peri_id(b, PERI_KIND_MATERIAL, 1), peri_id(b, PERI_KIND_MATERIAL, 1), &c, NULL));
    size = get(b, PERI_FIELD_FAMILY_SIZE);
    for (i = 0; i < nx * ny; i += 5) {
        u[2 * i] = 0.01;
        put(b, PERI_FIELD_DISPLACEMENT, u);
        u[2 * i] = 0;
        f = get(b, PERI_FIELD_FORCE_DENSITY);
        for (j = 0; j < nx * ny; ++j) {
            const double dx = (double)(i % nx - j % nx), dy = (double)(i / nx - j / nx), bond = hypot(dx, dy);
            if (i == j || bond > 3.1) continue;
            const double want = c * 2 * PI * 3.1 * 3.1 / (2 + size[i] + size[j]) * (dx * 0.01 / (bond * bond)) * dx / bond;
            bad += fabs(f[2 * j] - want) > 1e-12;
        }
        free(f);
    }
    CHECK(bad == 0);
    free(size);
    peri_body_destroy(b);
}

/* Four points in a square: by symmetry all bonds of a kind have one factor, and the energy of isotropic strain s is right in each point:
   1/2 bulk (2 s)^2, whichever weights the correction found for the directions. */
static void corrections_keep_the_energy(void) {
    double u[8], *w;
    int k;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 0, 1, 3, 2, 2, 1);
    s.desc.correction = PERI_CORRECTION_MOMENT;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.material.young = YOUNG;
    peri_body *b = specimen_make(&s);
    const moduli m = moduli_of(PERI_SPACE_PLANE_STRAIN, 0.25);
    MUST(b, peri_get_field(b, PERI_FIELD_POSITION, u, 8));
    for (k = 0; k < 8; ++k) u[k] *= 1e-3;
    put(b, PERI_FIELD_DISPLACEMENT, u);
    w = get(b, PERI_FIELD_ENERGY_DENSITY);
    for (k = 0; k < 4; ++k) CHECK_NEAR(w[k], 0.5 * m.bulk * 4e-6, 1e-10, 0);
    free(w);
    peri_body_destroy(b);
}

typedef struct asking {
    int64_t asked, when_told, fail_at;
    int     told, leave;
    jmp_buf out;
} asking;

static int32_t influence(void *user, double q, double *w) {
    asking *a = (asking *)user;
    (void)q;
    *w = 1;
    return ++a->asked == a->fail_at ? -3 : 0;
}
static void tell(void *user, int32_t level, const char *text) {
    asking *a = (asking *)user;
    (void)level;
    a->told += strstr(text, "isotropic") != NULL;
    a->when_told = a->asked;
    if (a->leave) longjmp(a->out, 1);
}

/* All bonds of a chain are along one line: no weights make that isotropic, and the log says so. A build that was left from there after the
   influence function had failed is made again as if nothing had been. */
static void chains_are_told_of(void) {
    static asking a;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 0, 1, 3, 8, 1, 1);
    s.desc.correction = PERI_CORRECTION_MOMENT;
    s.desc.influence = PERI_INFLUENCE_USER;
    s.desc.influence_fn = influence;
    s.desc.influence_user = s.desc.log_user = &a;
    s.desc.log = tell;
    memset(&a, 0, sizeof a);
    peri_body_destroy(specimen_make(&s));
    CHECK(a.told == 1);
    a.fail_at = a.when_told; /* the last that was asked before the log was told */
    a.asked = 0;
    a.leave = 1;
    peri_body *volatile b = specimen_start(&s);
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 1));
    if (setjmp(a.out) == 0) {
        (void)peri_build(b);
        CHECK(a.leave == 0); /* not reached: the log leaves the build */
    }
    MUST(b, peri_unlock(b));
    a.leave = 0;
    MUST(b, peri_build(b));
    peri_body_destroy(b);
}

static int32_t cut_some(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user, (void)xi, (void)xj;
    return (i * 7 + j * 3) % 5 == 0;
}

/* Damage counts parts of cells, by the ramp (h + 1/2 - |xi|) here, whatever order the rows of a corrected cloud lie in. */
static void parts_stay_with_their_bonds(void) {
    double x[2 * 96], v[96], *damage;
    uint64_t seed = 5;
    int i, j, bad = 0;
    for (i = 0; i < 96; ++i) {
        const int site = i * 37 % 96;
        x[2 * i] = site % 12 + 0.4 * test_random(&seed);
        x[2 * i + 1] = site / 12 + 0.4 * test_random(&seed);
        v[i] = 1;
    }
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 0, 1, 3, 1, 1, 1);
    s.desc.quadrature = PERI_QUADRATURE_RAMP;
    s.desc.correction = PERI_CORRECTION_MOMENT;
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_points(b, 96, x, v, NULL));
    MUST(b, peri_build(b));
    MUST(b, peri_cut_if(b, PERI_CUT_NOW, cut_some, NULL));
    damage = get(b, PERI_FIELD_DAMAGE);
    for (i = 0; i < 96; ++i) {
        double all = 0, cut = 0;
        for (j = 0; j < 96; ++j) {
            const double part = fmin(1, 3.5 - hypot(x[2 * j] - x[2 * i], x[2 * j + 1] - x[2 * i + 1]));
            if (i == j || !(part > 0)) continue;
            all += part;
            if (cut_some(NULL, i < j ? i : j, i < j ? j : i, NULL, NULL)) cut += part;
        }
        bad += fabs(damage[i] - cut / all) > 1e-6; /* parts are kept in single precision */
    }
    CHECK(bad == 0);
    free(damage);
    peri_body_destroy(b);
}

/* ---- points and ranges --------------------------------------------------------------------------------------------- */

/* Points that come later leave those that were there what they are. */
static void materials_stay(void) {
    const double lo[2] = {0, 0}, middle[2] = {30, 10}, low[2] = {0, 10}, hi[2] = {30, 60};
    int64_t i, bad = 0;
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 2);
    const int32_t first = unbreakable(b, 1, 1), second = unbreakable(b, 2, 1);
    MUST(b, peri_add_box(b, second, lo, middle, 1));
    MUST(b, peri_add_box(b, first, low, hi, 1));
    MUST(b, peri_build(b));
    double *m = get(b, PERI_FIELD_MATERIAL);
    for (i = 0; i < peri_point_count(b); ++i) bad += m[i] != (i < 300 ? 2 : 1);
    CHECK(bad == 0);
    free(m);
    peri_body_destroy(b);
}

/* What no double or no frequency can be made of is refused: two parts, one of which is heavy and the other soft, by 1e40 each. */
static void frequencies_have_a_range(void) {
    const double lo[2] = {0, 0}, middle[2] = {6, 6}, low[2] = {20, 20}, hi[2] = {26, 26};
    const int32_t laws[2] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS};
    int k, kernel;
    for (k = 0; k < 2; ++k)
        for (kernel = 0; kernel < 2; ++kernel) {
            specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, laws[k], 0.3, 1, 3, 6, 6, 1);
            s.material.density = 1e40;
            s.desc.kernel = kernel ? PERI_KERNEL_LIST : PERI_KERNEL_BEST;
            peri_body *b = specimen_start(&s);
            s.material.density = 1;
            s.material.young = 1e-40;
            const int32_t second = (int32_t)MUST(b, peri_add_material(b, &s.material));
            MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, middle, 1));
            MUST(b, peri_add_box(b, second, low, hi, 1));
            CHECK(peri_build(b) == PERI_ERROR_RANGE);
            peri_body_destroy(b);
        }
}

/* A horizon that is nothing beside the spacing is too small. */
static void horizons_of_nothing(void) {
    peri_error e;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 0, 1, 1e-240, 6, 6, 1);
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 1));
    const int32_t status = peri_build(b);
    CHECK(status == PERI_ERROR_HORIZON && peri_get_error(b, &e) == PERI_OK && e.code == status);
    peri_body_destroy(b);
}

/* Three points at one place, wherever the cells of the search meet: the record names the first, and the least of the others. */
static void twins_on_either_side(void) {
    double x[2 * 103], v[103];
    int cells, k, i;
    for (i = 0; i < 103; ++i) {
        x[2 * i] = (i - 3) % 10;
        x[2 * i + 1] = (double)((i - 3) / 10);
        v[i] = 1;
    }
    for (cells = 2; cells < 10; ++cells)
        for (k = 1; k < cells; ++k) {
            const double at = 9.0 * k / cells, shift[3] = {2e-13, 3e-13, -2e-13};
            peri_error e;
            specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 0, 1, 3, 1, 1, 1);
            peri_body *b = specimen_start(&s);
            for (i = 0; i < 3; ++i) {
                x[2 * i] = at + shift[i];
                x[2 * i + 1] = 4.5;
            }
            MUST(b, peri_add_points(b, 103, x, v, NULL));
            CHECK(peri_build(b) == PERI_ERROR_COINCIDENT && peri_get_error(b, &e) == PERI_OK);
            CHECK(e.index == 1 && e.value == 0);
            peri_body_destroy(b);
        }
}

/* Numbers of points end before their count. */
static void numbers_end(void) {
    const double x[6] = {0, 0, 1, 0, 2, 0}, v[3] = {1, 1, 1};
    const int32_t rows[6] = {1, 0, 0, 2, 1, 3};
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 1.5);
    peri_error e;
    (void)unbreakable(b, 1, 1);
    MUST(b, peri_add_points(b, 3, x, v, NULL));
    MUST(b, peri_set_families(b, 2, rows));
    CHECK(peri_build(b) == PERI_ERROR_IBOND && peri_get_error(b, &e) == PERI_OK);
    CHECK(e.index == 5 && e.value == 3);
    peri_body_destroy(b);
}

/* ---- memory -------------------------------------------------------------------------------------------------------- */

typedef struct purse {
    int64_t bytes, calls, fail_at; /* what is out; calls so far; the one that fails, from 0, or -1 */
} purse;

static void *take(void *user, uint64_t bytes) {
    purse *p = (purse *)user;
    void *made = p->calls++ == p->fail_at ? NULL : malloc((size_t)bytes);
    if (made) p->bytes += (int64_t)bytes;
    return made;
}
static void give(void *user, void *pointer, uint64_t bytes) {
    purse *p = (purse *)user;
    if (pointer) p->bytes -= (int64_t)bytes;
    free(pointer);
}

/* What the body says it holds is what it was given. */
static void check_purse(const peri_body *b, const purse *p) {
    peri_memory m;
    MUST(b, peri_get_memory(b, &m));
    CHECK(m.total == p->bytes);
}

static specimen counted(int32_t law, purse *p) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, law, 0.3, 1, 3, 9, 8, 1);
    memset(p, 0, sizeof *p);
    p->fail_at = -1;
    s.desc.allocate = take;
    s.desc.release = give;
    s.desc.memory_user = p;
    return s;
}

static void loads_are_given_back(void) {
    const double normal[2] = {1, 0}, pull[2] = {0.1, 0};
    purse p;
    specimen s = counted(PERI_LAW_CORRESPONDENCE, &p);
    peri_body *b = specimen_make(&s), *copy = NULL;
    check_purse(b, &p);
    const double lo[2] = {3, -1}, hi[2] = {10, 10};
    const int32_t face = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
    const int32_t traction = (int32_t)MUST(b, peri_apply_traction(b, face, 8, normal, pull, NULL, NULL));
    const int32_t support = (int32_t)MUST(b, peri_prescribe_displacement(b, face, PERI_AXIS_XY, NULL, NULL, NULL));
    check_purse(b, &p);
    MUST(b, peri_body_clone(b, &copy, NULL));
    peri_body_destroy(copy);
    check_purse(b, &p);
    MUST(b, peri_remove_load(b, traction));
    MUST(b, peri_remove_load(b, support));
    check_purse(b, &p);
    MUST(b, peri_apply_traction(b, face, 8, normal, pull, NULL, NULL));
    peri_body_destroy(b);
    CHECK(p.bytes == 0);
}

static void builds_are_given_back(void) {
    const int32_t corrections[4] = {PERI_CORRECTION_NONE, PERI_CORRECTION_VOLUME, PERI_CORRECTION_ENERGY, PERI_CORRECTION_MOMENT};
    const double middle[2] = {9, 8}, low[2] = {0, 8}, hi[2] = {9, 16}, x[6] = {0, 0, 1, 0, 2, 0}, v[3] = {1, 1, 1};
    const int32_t rows[6] = {1, 0, 0, 2, 1, 2};
    purse p;
    int k, fail;
    for (k = 0; k < 4; ++k) {
        specimen s = counted(PERI_LAW_BOND_BASED, &p);
        s.desc.correction = corrections[k];
        peri_body *b = specimen_make(&s);
        check_purse(b, &p);
        peri_body_destroy(b);
        CHECK(p.bytes == 0);
    }
    for (fail = -1; fail < 60; ++fail) { /* columns of two laws, where each of the blocks is refused */
        specimen s = counted(PERI_LAW_LPS, &p);
        peri_body *b = specimen_start(&s);
        peri_material_desc_init(&s.material, PERI_LAW_BOND_BASED);
        s.material.young = s.material.density = 1;
        const int32_t second = (int32_t)MUST(b, peri_add_material(b, &s.material));
        MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, middle, 1));
        MUST(b, peri_add_box(b, second, low, hi, 1));
        const int64_t before = p.bytes;
        p.fail_at = fail < 0 ? -1 : p.calls + fail;
        const int32_t status = peri_build(b);
        CHECK(status == PERI_OK || (status == PERI_ERROR_MEMORY && p.bytes == before));
        p.fail_at = -1;
        if (status == PERI_OK) check_purse(b, &p);
        peri_body_destroy(b);
        CHECK(p.bytes == 0);
    }
    for (k = 0; k < 2; ++k) { /* families of the caller, given twice */
        specimen s = counted(PERI_LAW_BOND_BASED, &p);
        peri_body *b = specimen_start(&s);
        MUST(b, peri_add_points(b, 3, x, v, NULL));
        MUST(b, peri_set_families(b, 2, rows));
        MUST(b, peri_set_families(b, 2, rows));
        if (k) {
            MUST(b, peri_build(b));
            check_purse(b, &p);
        }
        peri_body_destroy(b);
        CHECK(p.bytes == 0);
    }
}

/* A list takes as much whether columns were tried or not. */
static void lists_take_what_they_take(void) {
    peri_memory m[2];
    purse p;
    int k;
    for (k = 0; k < 2; ++k) {
        specimen s = counted(PERI_LAW_BOND_BASED, &p);
        s.desc.kernel = k ? PERI_KERNEL_LIST : PERI_KERNEL_BEST;
        s.hi[0] = s.hi[1] = 40;
        s.scatter = 0.9;
        s.seed = 3;
        peri_body *b = specimen_make(&s);
        CHECK(strncmp(peri_kernel_text(b), "list", 4) == 0);
        MUST(b, peri_get_memory(b, &m[k]));
        peri_body_destroy(b);
        CHECK(p.bytes == 0);
    }
    CHECK(m[0].families == m[1].families);
}

/* A zone that finds no memory, and a callback that is removed, leave nothing behind. */
static void damage_is_given_back(void) {
    peri_memory before, after;
    purse p;
    int fail;
    for (fail = 0; fail < 3; ++fail) {
        specimen s = counted(PERI_LAW_BOND_BASED, &p);
        s.material.critical_stretch = 0.1;
        peri_body *b = specimen_make(&s);
        MUST(b, peri_get_memory(b, &before));
        p.fail_at = p.calls + fail;
        const int32_t status = peri_set_no_fail(b, PERI_ALL, 1);
        p.fail_at = -1;
        CHECK(status == PERI_OK || status == PERI_ERROR_MEMORY);
        MUST(b, peri_get_memory(b, &after));
        CHECK(status == PERI_OK || after.total == before.total);
        check_purse(b, &p);
        peri_body_destroy(b);
        CHECK(p.bytes == 0);
    }
}

/* Products with the stiffness keep one number per point of a law with theta, of one with a gradient its D^2 entries, too. */
static void products_keep_what_they_gather(void) {
    const int32_t laws[2] = {PERI_LAW_LPS, PERI_LAW_CORRESPONDENCE};
    int64_t grown[2];
    int k;
    for (k = 0; k < 2; ++k) {
        double u[144] = {0};
        peri_memory before, after;
        purse p;
        specimen s = counted(laws[k], &p);
        peri_body *b = specimen_make(&s);
        MUST(b, peri_get_memory(b, &before));
        MUST(b, peri_multiply_stiffness(b, u, u, 144));
        MUST(b, peri_get_memory(b, &after));
        grown[k] = after.total - before.total;
        peri_body_destroy(b);
    }
    CHECK(grown[0] > 0 && grown[1] >= grown[0] + 4 * 72 * (int64_t)sizeof(double));
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(parts_fill_the_disc);
    RUN(parts_of_later_pieces);
    RUN(ramps_end);
    RUN(poles_end);
    RUN(stress_by_centroids);
    RUN(volumes_of_both_ends);
    RUN(corrections_keep_the_energy);
    RUN(chains_are_told_of);
    RUN(parts_stay_with_their_bonds);
    RUN(materials_stay);
    RUN(frequencies_have_a_range);
    RUN(horizons_of_nothing);
    RUN(twins_on_either_side);
    RUN(numbers_end);
    RUN(loads_are_given_back);
    RUN(builds_are_given_back);
    RUN(lists_take_what_they_take);
    RUN(damage_is_given_back);
    RUN(products_keep_what_they_gather);
    return test_end("test_survivors_shapes");
}
