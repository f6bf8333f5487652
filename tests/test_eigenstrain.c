/* SPDX-License-Identifier: MIT */
/* test_eigenstrain.c - eigenstrain by point: every law, every storage, rest, motion and equilibria.

   SOURCE OF TRUTH
     free       a body that has grown by the same eigenstrain everywhere, and turned, bears no force, stores nothing and has no stress
     held       at rest under eigenstrain a the stress of linear elasticity is -a (D lambda + 2 mu), lambda of the plane
     energy     force and tangent are differences of the elastic energy, the matrix is the tangent
     grown      in linear geometry a body moves and breaks about its grown state as one without eigenstrain does about rest
     ledger     what is put in is accounted for, in motion and in equilibria
     bimetal    Timoshenko 1925: two layers alike in modulus and height bend by 3/2 (a1 - a2)/h, h the height of both
     cracks     a long crack in a strip of width L whose sides are held, cooled by a, frees E a^2/2 L per length, as it relieves all: it
                grows from a = sqrt(2 G0/(E L)) on (the columns of Maurini et al. 2013), here to 10 %
     criteria   at rest under eigenstrain -a the elastic stretch of every bond is a */
#include "equilibrium.h"
#include "solid.h"
#include "specimen.h"

enum { COLUMNS, LISTED, REFERENCE, STORAGES };

static const int32_t laws[4] = { PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE };

static double *doubles(int64_t n) {
    double *made = (double *)calloc((size_t)n, sizeof *made);
    if (!made) abort();
    return made;
}

static double poisson_of(int32_t law, int32_t space) {
    return law == PERI_LAW_BOND_BASED ? (double)NAN : space == PERI_SPACE_SOLID ? 0.3 : 0.2;
}

static specimen scene_of(int32_t law, int32_t space, int storage) {
    const int block = space == PERI_SPACE_SOLID;
    specimen s = specimen_of(space, law, poisson_of(law, space), 1e-3, 3.015, block ? 6 : 12, block ? 5 : 10, block ? 5 : 1);
    s.desc.kernel = storage == COLUMNS ? PERI_KERNEL_BEST : storage == LISTED ? PERI_KERNEL_LIST : PERI_KERNEL_REFERENCE;
    s.material.young = 7e10;
    s.material.density = 2500;
    return s;
}

static void set_uniform(peri_body *b, int32_t field, double value) {
    const int64_t n = peri_point_count(b);
    double *values = doubles(n);
    for (int64_t i = 0; i < n; ++i) values[i] = value;
    (void)MUST(b, peri_set_field(b, field, values, n));
    free(values);
}

static void set_random(peri_body *b, int32_t field, double least, double most, uint64_t seed) {
    const int64_t n = peri_point_count(b);
    double *values = doubles(n);
    for (int64_t i = 0; i < n; ++i) values[i] = least + (most - least) * test_random(&seed);
    (void)MUST(b, peri_set_field(b, field, values, n));
    free(values);
}

static double largest_of(peri_body *b, int32_t field) {
    const int64_t n = peri_size_of_field(b, field);
    double *values = doubles(n), most = 0;
    (void)MUST(b, peri_get_field(b, field, values, n));
    for (int64_t k = 0; k < n; ++k) most = fmax(most, fabs(values[k]));
    free(values);
    return most;
}

/* u = (R (1 + a) - 1) x, R a turn in the plane of x and y. */
static void grow(peri_body *b, double a, double angle) {
    const double c = (1 + a) * cos(angle), s = (1 + a) * sin(angle);
    double h[9] = { c - 1, -s, 0, s, c - 1, 0, 0, 0, a };
    if (peri_dimension(b) == 2) h[2] = s, h[3] = c - 1;
    stretch_by(b, h);
}

/* Force density, energy and stresses over those that eigenstrain a of a body at rest makes. */
static void check_nothing(peri_body *b, double a, double rounding) {
    const double young = 7e10, spacing = 1e-3;
    CHECK(largest_of(b, PERI_FIELD_FORCE_DENSITY) < rounding * young * a / spacing);
    CHECK(largest_of(b, PERI_FIELD_STRESS) < rounding * young * a);
    CHECK(largest_of(b, PERI_FIELD_FORCE_STRESS) < rounding * young * a);
    CHECK(largest_of(b, PERI_FIELD_ENERGY_DENSITY) < rounding * young * a * a);
}

static void a_free_body_that_has_grown_bears_nothing(void) {
    static const int32_t spaces[3] = { PERI_SPACE_PLANE_STRESS, PERI_SPACE_PLANE_STRAIN, PERI_SPACE_SOLID };
    static const int32_t precisions[3] = { PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_SINGLE };
    const double a = 1e-3, rounding[3] = { 1e-10, 2e-3, 5e-3 };
    for (int law = 0; law < 4; ++law)
        for (int space = 0; space < 3; ++space)
            for (int storage = 0; storage < STORAGES; ++storage)
                for (int p = 0; p < 3; ++p) {
                    specimen s = scene_of(laws[law], spaces[space], storage);
                    if (space == 1 && p > 0) continue;
                    s.desc.precision = precisions[p];
                    s.desc.geometry = storage == LISTED ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR;
                    s.scatter = storage == LISTED ? 0.5 : 0;
                    peri_body *b = specimen_make(&s);
                    set_uniform(b, PERI_FIELD_EIGENSTRAIN, a);
                    CHECK(largest_of(b, PERI_FIELD_FORCE_DENSITY) > 1e-2 * 7e10 * a / 1e-3);
                    grow(b, a, storage == LISTED ? 0 : 0.4);
                    check_nothing(b, a, rounding[p]);
                    peri_body_destroy(b);
                }
}

/* The law beside it: correspondence, of another modulus. */
static peri_body *two_laws(int32_t law, int32_t kernel, int32_t geometry) {
    specimen s = scene_of(law, PERI_SPACE_PLANE_STRESS, COLUMNS);
    peri_material_desc other = scene_of(PERI_LAW_CORRESPONDENCE, PERI_SPACE_PLANE_STRESS, COLUMNS).material;
    const double lo[2] = { 12e-3, 0 }, hi[2] = { 20e-3, 10e-3 };
    s.desc.kernel = kernel;
    s.desc.geometry = geometry;
    other.young = 2e10;
    peri_body *b = specimen_start(&s);
    const int32_t second = (int32_t)MUST(b, peri_add_material(b, &other));
    (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, s.spacing));
    (void)MUST(b, peri_add_box(b, second, lo, hi, s.spacing));
    (void)MUST(b, peri_build(b));
    return b;
}

static void nor_does_one_of_two_laws_or_with_a_crack(void) {
    static const int32_t kernels[2] = { PERI_KERNEL_BEST, PERI_KERNEL_REFERENCE };
    for (int law = 0; law < 3; ++law)
        for (int k = 0; k < 2; ++k) {
            peri_body *b = two_laws(laws[law], kernels[k], PERI_GEOMETRY_NONLINEAR);
            const double from[2] = { 4e-3, 0 }, to[2] = { 4.2e-3, 6e-3 };
            (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
            set_uniform(b, PERI_FIELD_EIGENSTRAIN, -2e-3);
            grow(b, -2e-3, 0.2);
            check_nothing(b, 2e-3, 1e-10);
            peri_body_destroy(b);
        }
    for (int law = 1; law < 3; ++law) { /* constants of the whole family: what bonds that are gone do not add must not count */
        specimen s = scene_of(laws[law], PERI_SPACE_PLANE_STRESS, COLUMNS);
        const double from[2] = { 4.1e-3, 0 }, to[2] = { 4.1e-3, 5e-3 };
        s.desc.moments = PERI_MOMENTS_WHOLE;
        peri_body *b = specimen_make(&s);
        (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
        set_uniform(b, PERI_FIELD_EIGENSTRAIN, 1e-3);
        grow(b, 1e-3, 0);
        check_nothing(b, 1e-3, 1e-10);
        peri_body_destroy(b);
    }
}

static void a_held_body_bears_what_elasticity_says(void) {
    static const int32_t spaces[3] = { PERI_SPACE_PLANE_STRESS, PERI_SPACE_PLANE_STRAIN, PERI_SPACE_SOLID };
    const double a = 1e-4;
    for (int law = 0; law < 4; ++law)
        for (int space = 0; space < 3; ++space) {
            const int dim = spaces[space] == PERI_SPACE_SOLID ? 3 : 2;
            specimen s = scene_of(laws[law], spaces[space], COLUMNS);
            const double nu = law > 0 ? s.material.poisson : spaces[space] == PERI_SPACE_PLANE_STRESS ? 1.0 / 3 : 0.25;
            double lambda, mu, centre[3] = { 6e-3, 5e-3, 2.5e-3 }, stress[6];
            s.desc.correction = law > 0 ? PERI_CORRECTION_NONE : PERI_CORRECTION_MOMENT;
            if (law == 0) s.desc.geometry = PERI_GEOMETRY_LINEAR;
            for (int d = 0; d < dim; ++d) s.hi[d] = law == 0 ? 13e-3 : 7e-3, centre[d] = s.hi[d] / 2;
            peri_body *b = specimen_make(&s);
            const int64_t i = peri_find_point(b, centre), n = peri_point_count(b), parts = dim == 3 ? 6 : 3;
            double *all = doubles(n * parts);
            lame(spaces[space], nu, &lambda, &mu);
            set_uniform(b, PERI_FIELD_EIGENSTRAIN, a);
            (void)MUST(b, peri_get_field(b, PERI_FIELD_FORCE_STRESS, all, n * parts));
            memcpy(stress, &all[i * parts], sizeof *stress * (size_t)parts);
            for (int d = 0; d < dim; ++d) CHECK_NEAR(stress[d], -7e10 * a * (dim * lambda + 2 * mu) / YOUNG, law == 3 ? 1e-3 : 1e-2, 0);
            (void)MUST(b, peri_get_field(b, PERI_FIELD_STRESS, all, n * parts));
            for (int d = 0; d < dim; ++d) CHECK_NEAR(all[i * parts + d], -7e10 * a * (dim * lambda + 2 * mu) / YOUNG, 1e-3, 0);
            free(all);
            peri_body_destroy(b);
        }
}

/* ---- energy, force, tangent, matrix -------------------------------------------------------------------------------- */

static double energy_at(peri_body *b, const double *u, double *force) {
    peri_evaluate_desc e;
    peri_evaluate_report r;
    peri_evaluate_desc_init(&e);
    e.displacement = u;
    e.nodal = 1;
    e.energy = 1;
    e.force = force;
    (void)MUST(b, peri_evaluate(b, &e, &r));
    return r.energy;
}

/* A body far from rest under random eigenstrain and stiffness: force against energy, product against force, matrix against product. */
static void check_consistent(peri_body *b, int stiffness) {
    const int64_t n = peri_point_count(b) * peri_dimension(b);
    double *u = doubles(n), *way = doubles(n), *there = doubles(n), *f[5], *product = doubles(n), *row = doubles(n), w[5];
    double slope = 0, want = 0, off = 0, size = 0;
    uint64_t seed = 7;
    const double step = 2e-8;
    peri_matrix *matrix = NULL;
    for (int64_t k = 0; k < n; ++k) u[k] = 2e-5 * (test_random(&seed) - 0.5), way[k] = test_random(&seed) - 0.5;
    set_random(b, PERI_FIELD_EIGENSTRAIN, -0.02, 0.02, 11);
    if (stiffness) set_random(b, PERI_FIELD_STIFFNESS, 0.3, 3, 12);
    (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, n));
    for (int k = 0; k < 5; ++k) {
        f[k] = doubles(n);
        for (int64_t d = 0; d < n; ++d) there[d] = u[d] + (k - 2) * step * way[d];
        w[k] = energy_at(b, there, f[k]);
    }
    slope = (w[0] - 8 * w[1] + 8 * w[3] - w[4]) / (12 * step);
    for (int64_t d = 0; d < n; ++d) want -= f[2][d] * way[d];
    CHECK_NEAR(slope, want, 1e-7, 0);
    (void)MUST(b, peri_multiply_stiffness(b, way, product, n));
    for (int64_t d = 0; d < n; ++d) {
        const double difference = -(f[0][d] - 8 * f[1][d] + 8 * f[3][d] - f[4][d]) / (12 * step);
        off = fmax(off, fabs(difference - product[d]));
        size = fmax(size, fabs(product[d]));
    }
    CHECK(size > 0 && off < 1e-6 * size);
    (void)MUST(b, peri_multiply_stiffness_at(b, u, way, there, n));
    CHECK(furthest(there, product, n) < 1e-10 * size);
    (void)MUST(b, peri_matrix_create(b, &matrix));
    int64_t *start = (int64_t *)malloc((size_t)(n + 1) * sizeof *start);
    int32_t *column = (int32_t *)malloc((size_t)peri_matrix_entries(matrix) * sizeof *column);
    double *value = doubles(peri_matrix_entries(matrix));
    (void)MUST(b, peri_get_matrix(matrix, start, column, value));
    for (int64_t d = 0; d < n; ++d)
        for (int64_t k = start[d]; k < start[d + 1]; ++k) row[d] += value[k] * way[column[k]];
    CHECK(furthest(row, product, n) < 1e-9 * size);
    peri_matrix_destroy(matrix);
    for (int k = 0; k < 5; ++k) free(f[k]);
    free(u), free(way), free(there), free(product), free(row), free(start), free(column), free(value);
}

static void force_tangent_and_matrix_are_differences_of_the_energy(void) {
    static const int32_t geometries[2] = { PERI_GEOMETRY_NONLINEAR, PERI_GEOMETRY_LINEAR };
    for (int law = 0; law < 4; ++law)
        for (int k = 0; k < 2; ++k)
            for (int storage = 0; storage < 2; ++storage) {
                specimen s = scene_of(laws[law], k && storage ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, storage);
                s.desc.geometry = geometries[k];
                s.scatter = storage == LISTED ? 0.5 : 0;
                if (s.desc.space == PERI_SPACE_SOLID) s.hi[0] = s.hi[1] = s.hi[2] = 4e-3;
                peri_body *b = specimen_make(&s);
                check_consistent(b, 1);
                peri_body_destroy(b);
            }
    for (int law = 0; law < 3; ++law) {
        peri_body *b = two_laws(laws[law], PERI_KERNEL_BEST, PERI_GEOMETRY_NONLINEAR);
        check_consistent(b, 1);
        peri_body_destroy(b);
    }
}

/* Forces of the vectors are those of the rows. */
static void vectors_and_rows_agree(void) {
    static const int32_t precisions[4] = { PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED };
    for (int law = 0; law < 4; ++law)
        for (int p = 0; p < 4; ++p) {
            specimen s = scene_of(laws[law], PERI_SPACE_PLANE_STRESS, COLUMNS);
            double *u, *f[2], size = 0;
            int64_t n = 0;
            s.desc.precision = precisions[p];
            for (int storage = 0; storage < 2; ++storage) {
                s.desc.kernel = storage ? PERI_KERNEL_REFERENCE : PERI_KERNEL_BEST;
                s.scatter = p < 2 ? 0 : 0.5;
                s.hi[0] = 16e-3, s.hi[1] = 14e-3; /* rows of one group: their constants would be copied without a field */
                peri_body *b = specimen_make(&s);
                uint64_t seed = 5;
                n = 2 * peri_point_count(b);
                u = doubles(n), f[storage] = doubles(n);
                for (int64_t k = 0; k < n; ++k) u[k] = 1e-5 * test_random(&seed);
                set_random(b, PERI_FIELD_EIGENSTRAIN, -0.02, 0.02, 3);
                set_random(b, PERI_FIELD_STIFFNESS, 0.5, 2, 4);
                (void)energy_at(b, u, f[storage]);
                CHECK(strncmp(peri_kernel_text(b), storage ? "reference" : p < 2 ? "columns" : "list", 4) == 0);
                free(u);
                peri_body_destroy(b);
            }
            for (int64_t k = 0; k < n; ++k) size = fmax(size, fabs(f[0][k]));
            CHECK(furthest(f[0], f[1], n) < (p % 2 ? 1e-5 : 1e-13) * size);
            free(f[0]), free(f[1]);
        }
}

/* ---- equilibria ----------------------------------------------------------------------------------------------------- */

/* A free strip takes its length by itself; what holds it against rigid motion is pinned. */
static void a_free_strip_takes_its_length(void) {
    static const int32_t methods[2] = { PERI_METHOD_NEWTON, PERI_METHOD_RELAXATION };
    for (int law = 0; law < 4; ++law)
        for (int k = 0; k < 2; ++k) {
            specimen s = scene_of(laws[law], PERI_SPACE_PLANE_STRESS, law == 1 ? LISTED : COLUMNS);
            peri_solve_desc d = statics_of(1e-10);
            double ends[2][2] = { { 0.5e-3, 5.5e-3 }, { 11.5e-3, 5.5e-3 } }, *u;
            peri_energy e;
            peri_solve_report fine, coarse;
            d.method = methods[k];
            d.loose = PERI_LOOSE_PINNED;
            s.desc.geometry = law == 2 ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR;
            peri_body *b = specimen_make(&s);
            const int64_t n = peri_point_count(b), left = peri_find_point(b, ends[0]), right = peri_find_point(b, ends[1]);
            set_uniform(b, PERI_FIELD_EIGENSTRAIN, 1e-3);
            d.tolerance = 1e-2; /* of the forces that the eigenstrain needs at rest */
            coarse = solve(b, &d);
            (void)MUST(b, peri_reset(b));
            d.tolerance = 1e-10;
            fine = solve(b, &d);
            CHECK(fine.iterations > coarse.iterations && fine.residual <= 1e-10 && coarse.residual > 1e-10);
            u = doubles(2 * n);
            (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * n));
            const double dx = 11e-3 + u[2 * right] - u[2 * left], dy = u[2 * right + 1] - u[2 * left + 1];
            CHECK_NEAR(sqrt(dx * dx + dy * dy) / 11e-3 - 1, 1e-3, 1e-7, 0);
            CHECK(largest_of(b, PERI_FIELD_STRESS) < 1e-6 * 7e10 * 1e-3);
            (void)MUST(b, peri_get_energy(b, &e));
            if (law == 2) CHECK(fabs(e.error) < 1e-6 * e.initial);
            free(u);
            peri_body_destroy(b);
        }
}

/* Held at its ends, warm: -E a along it, nothing across it. */
static void a_clamped_bar_bears_minus_young_times_eigenstrain(void) {
    for (int law = 0; law < 4; ++law) {
        specimen s = scene_of(laws[law], PERI_SPACE_PLANE_STRESS, COLUMNS);
        peri_solve_desc d = statics_of(1e-9);
        const double centre[2] = { 20e-3, 5e-3 };
        double *stress;
        peri_energy e;
        s.hi[0] = 40e-3;
        s.desc.geometry = PERI_GEOMETRY_LINEAR;
        if (law < 2) s.desc.correction = PERI_CORRECTION_MOMENT;
        peri_body *b = specimen_make(&s);
        const int64_t n = peri_point_count(b), i = peri_find_point(b, centre);
        const double left[4] = { -1, -1, 6.1e-3, 1 }, right[4] = { 33.9e-3, -1, 1, 1 };
        const int32_t ends[2] = { (int32_t)MUST(b, peri_select_box(b, NULL, left, left + 2)),
                                  (int32_t)MUST(b, peri_select_box(b, NULL, right, right + 2)) };
        for (int k = 0; k < 2; ++k) (void)MUST(b, peri_prescribe_displacement(b, ends[k], PERI_AXIS_X, NULL, NULL, NULL));
        d.loose = PERI_LOOSE_PINNED;
        for (int k = 1; k <= 2; ++k) { /* the second time from the equilibrium of the first */
            set_uniform(b, PERI_FIELD_EIGENSTRAIN, 1e-4 * k);
            (void)solve(b, &d);
            stress = doubles(3 * n);
            (void)MUST(b, peri_get_field(b, PERI_FIELD_STRESS, stress, 3 * n));
            CHECK_NEAR(stress[3 * i], -7e6 * k, 1e-2, 0);
            CHECK(fabs(stress[3 * i + 1]) < 0.03 * 7e6 * k);
            free(stress);
            (void)MUST(b, peri_get_energy(b, &e));
            CHECK(e.elastic > 0 && fabs(e.error) < 1e-6 * e.elastic);
        }
        peri_body_destroy(b);
    }
}

static void a_bimetal_bends_as_timoshenko_has_it(void) {
    for (int law = 1; law < 4; law += 2) {
        specimen s = scene_of(laws[law], PERI_SPACE_PLANE_STRESS, COLUMNS);
        peri_solve_desc d = statics_of(1e-9);
        const double height = 10e-3, a = 1e-4;
        double *x, *u, *eigen, sum = 0;
        int64_t count = 0;
        s.hi[0] = 60e-3;
        s.material.poisson = 0.2;
        s.desc.geometry = PERI_GEOMETRY_LINEAR;
        if (law == 1) s.desc.correction = PERI_CORRECTION_MOMENT;
        peri_body *b = specimen_make(&s);
        const int64_t n = peri_point_count(b);
        x = doubles(2 * n), u = doubles(2 * n), eigen = doubles(n);
        (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, 2 * n));
        for (int64_t i = 0; i < n; ++i) eigen[i] = x[2 * i + 1] > height / 2 ? a : 0;
        (void)MUST(b, peri_set_field(b, PERI_FIELD_EIGENSTRAIN, eigen, n));
        d.loose = PERI_LOOSE_PINNED;
        (void)solve(b, &d);
        (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * n));
        /* curvature of the middle: second difference of the deflection of points 15 mm apart, mean over the height */
        for (int64_t i = 0; i < n; ++i) {
            const double left[2] = { x[2 * i] - 15e-3, x[2 * i + 1] }, right[2] = { x[2 * i] + 15e-3, x[2 * i + 1] };
            if (fabs(x[2 * i] - 30.5e-3) > 1e-4) continue;
            const int64_t l = peri_find_point(b, left), r = peri_find_point(b, right);
            sum += (u[2 * l + 1] - 2 * u[2 * i + 1] + u[2 * r + 1]) / (15e-3 * 15e-3);
            count++;
        }
        CHECK_NEAR(-sum / (double)count, 1.5 * a / height, 2e-2, 0);
        free(x), free(u), free(eigen);
        peri_body_destroy(b);
    }
}

/* ---- motion, breaking, life ----------------------------------------------------------------------------------------- */

static int32_t warm(void *user, peri_body *b) {
    double *eigenstrain = (double *)user;
    *eigenstrain += 1e-4;
    set_uniform(b, PERI_FIELD_EIGENSTRAIN, *eigenstrain);
    return 0;
}

/* The ledger of a bar that is warmed in jumps as it moves closes with the square of the step; heat at rest is `initial`. */
static void the_ledger_closes_in_motion(void) {
    for (int law = 0; law < 4; ++law) {
        double error[2];
        for (int k = 0; k < 2; ++k) {
            specimen s = scene_of(laws[law], PERI_SPACE_PLANE_STRESS, COLUMNS);
            peri_advance_desc a;
            peri_energy e;
            double eigenstrain = 0;
            peri_body *b = specimen_make(&s);
            peri_advance_desc_init(&a);
            a.time_step = 2e-8 / (1 + k);
            a.steps = 120 * (1 + k);
            a.frame_steps = 20 * (1 + k);
            a.on_frame = warm;
            a.user = &eigenstrain;
            (void)MUST(b, peri_advance(b, &a));
            (void)MUST(b, peri_get_energy(b, &e));
            CHECK(e.kinetic > 0.05 * e.initial && e.elastic > 0.05 * e.initial && e.external == 0);
            error[k] = e.error / e.initial;
            CHECK(fabs(error[k]) < 2e-2);
            (void)MUST(b, peri_reset(b));
            (void)MUST(b, peri_get_energy(b, &e));
            CHECK(e.elastic > 0);
            CHECK_NEAR(e.initial, e.elastic, 1e-12, 0);
            peri_body_destroy(b);
        }
        CHECK_NEAR(error[0] / error[1], 4, 0.1, 0);
    }
}

static void a_grown_body_moves_and_breaks_as_one_at_rest(void) {
    const double a = 0.03;
    for (int law = 0; law < 4; ++law)
        for (int storage = 0; storage < 2; ++storage) {
            double *u[2], *x = NULL, size = 0;
            int64_t n = 0, broken[2];
            peri_energy e[2];
            for (int k = 0; k < 2; ++k) {
                specimen s = scene_of(laws[law], PERI_SPACE_PLANE_STRESS, storage);
                peri_advance_desc run;
                uint64_t seed = 9;
                s.material.critical_stretch = 1e-3;
                s.desc.geometry = PERI_GEOMETRY_LINEAR;
                peri_body *b = specimen_make(&s);
                n = 2 * peri_point_count(b);
                u[k] = doubles(n);
                for (int64_t d = 0; d < n; ++d) u[k][d] = 20 * (test_random(&seed) - 0.5);
                (void)MUST(b, peri_set_field(b, PERI_FIELD_VELOCITY, u[k], n));
                if (k) set_uniform(b, PERI_FIELD_EIGENSTRAIN, a), grow(b, a, 0);
                peri_advance_desc_init(&run);
                run.steps = 40;
                run.time_step = 6e-8;
                (void)MUST(b, peri_advance(b, &run));
                (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u[k], n));
                if (k) x = doubles(n), (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, n));
                for (int64_t d = 0; k && d < n; ++d) u[k][d] -= a * x[d];
                (void)MUST(b, peri_get_energy(b, &e[k]));
                broken[k] = peri_broken_count(b);
                peri_body_destroy(b);
            }
            for (int64_t d = 0; d < n; ++d) size = fmax(size, fabs(u[0][d]));
            CHECK(furthest(u[0], u[1], n) < 1e-8 * size);
            CHECK(broken[0] > 50 && broken[1] == broken[0]);
            CHECK_NEAR(e[1].fracture, e[0].fracture, 1e-8, 0);
            free(u[0]), free(u[1]), free(x);
        }
}

/* Cooled where it is, every bond breaks at its critical stretch, not before. */
static void criteria_see_the_elastic_stretch(void) {
    for (int law = 0; law < 4; ++law)
        for (int storage = 0; storage < STORAGES; ++storage)
            for (int equilibrium = 0; equilibrium < 2; ++equilibrium) {
                specimen s = scene_of(laws[law], PERI_SPACE_PLANE_STRESS, storage);
                peri_advance_desc a;
                s.material.critical_stretch = 1e-3;
                s.scatter = storage == LISTED ? 0.5 : 0;
                peri_body *b = specimen_make(&s);
                peri_solve_desc d = statics_of(1e-8);
                (void)MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_XY, NULL, NULL, NULL));
                peri_advance_desc_init(&a);
                a.steps = 1;
                for (int k = 0; k < 3; ++k) { /* warm and not cold enough, then cold enough */
                    set_uniform(b, PERI_FIELD_EIGENSTRAIN, k == 0 ? 0.1 : k == 1 ? -0.9999e-3 : -1.0001e-3);
                    if (equilibrium) (void)peri_solve(b, &d, NULL);
                    else (void)MUST(b, peri_advance(b, &a));
                    CHECK(peri_broken_count(b) == (k < 2 ? 0 : peri_bond_count(b)));
                }
                peri_body_destroy(b);
            }
}

static void a_long_crack_in_a_cooled_strip_grows_by_griffith(void) {
    specimen s = scene_of(PERI_LAW_BOND_BASED, PERI_SPACE_PLANE_STRESS, COLUMNS);
    const double wide = 24e-3, g0 = 40, from[2] = { 12e-3, -1 }, to[2] = { 12e-3, 30e-3 }, grip = 3.01e-3;
    const double left[4] = { -1, -1, grip, 1 }, right[4] = { wide - grip, -1, 1, 1 }, griffith = sqrt(2 * g0 / (7e10 * (wide - 5e-3)));
    peri_solve_desc d = statics_of(1e-6);
    s.hi[0] = wide, s.hi[1] = 60e-3;
    s.material.fracture_energy = g0;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *b = specimen_make(&s);
    (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
    for (int k = 0; k < 2; ++k) {
        const double *box = k ? right : left;
        const int32_t side = (int32_t)MUST(b, peri_select_box(b, NULL, box, box + 2));
        (void)MUST(b, peri_prescribe_displacement(b, side, PERI_AXIS_X, NULL, NULL, NULL));
        (void)MUST(b, peri_set_no_fail(b, side, 1));
    }
    d.loose = PERI_LOOSE_PINNED;
    d.breaks = 12;
    d.halvings = 0;
    set_uniform(b, PERI_FIELD_EIGENSTRAIN, -0.9 * griffith);
    (void)MUST(b, peri_solve(b, &d, NULL));
    CHECK(peri_broken_count(b) < 5);
    set_uniform(b, PERI_FIELD_EIGENSTRAIN, -1.1 * griffith);
    (void)peri_solve(b, &d, NULL);
    CHECK(peri_broken_count(b) >= 12);
    peri_body_destroy(b);
}

static void node_energies_do_too(void) {
    specimen s = scene_of(PERI_LAW_LPS, PERI_SPACE_PLANE_STRESS, COLUMNS);
    s.material.criterion = PERI_CRITERION_NODE_ENERGY;
    s.material.fracture_energy = 100;
    peri_body *b = specimen_make(&s);
    peri_advance_desc a;
    peri_advance_desc_init(&a);
    a.steps = 1;
    set_uniform(b, PERI_FIELD_EIGENSTRAIN, 0.01);
    grow(b, 0.01, 0.1);
    (void)MUST(b, peri_advance(b, &a));
    CHECK(peri_broken_count(b) == 0);
    set_uniform(b, PERI_FIELD_EIGENSTRAIN, -0.01);
    (void)MUST(b, peri_advance(b, &a));
    CHECK(peri_broken_count(b) > 0);
    peri_body_destroy(b);
    s.material.criterion = PERI_CRITERION_BOND_ENERGY;
    b = specimen_make(&s);
    double *zero = doubles(peri_point_count(b));
    CHECK(peri_set_field(b, PERI_FIELD_EIGENSTRAIN, zero, peri_point_count(b)) == PERI_ERROR_CRITERION);
    free(zero);
    peri_body_destroy(b);
}

/* A corner that was cut off bears nothing: its energy is that of its bonds, none. */
static void a_point_alone_stores_nothing(void) {
    for (int law = 0; law < 4; ++law)
        for (int linear = 0; linear < 2; ++linear) {
            specimen s = scene_of(laws[law], PERI_SPACE_PLANE_STRESS, 0);
            const double at[2] = {s.lo[0] + s.spacing, s.lo[1] + s.spacing}, out = s.spacing;
            const double way[6] = {at[0], at[1] - 2 * out, at[0], at[1], at[0] - 2 * out, at[1]};
            s.desc.geometry = linear ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR;
            peri_body *b = specimen_make(&s);
            const int64_t n = peri_point_count(b);
            double *w = doubles(n), *damage = doubles(n);
            int alone = 0;
            set_uniform(b, PERI_FIELD_EIGENSTRAIN, 1e-3);
            MUST(b, peri_cut_polyline(b, PERI_CUT_NOW, 3, way));
            MUST(b, peri_get_field(b, PERI_FIELD_ENERGY_DENSITY, w, n));
            MUST(b, peri_get_field(b, PERI_FIELD_DAMAGE, damage, n));
            for (int64_t i = 0; i < n; ++i)
                if (damage[i] == 1) {
                    CHECK(w[i] == 0);
                    alone++;
                }
            CHECK(alone == 1);
            free(w), free(damage), peri_body_destroy(b);
        }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(a_free_body_that_has_grown_bears_nothing);
    RUN(nor_does_one_of_two_laws_or_with_a_crack);
    RUN(a_held_body_bears_what_elasticity_says);
    RUN(force_tangent_and_matrix_are_differences_of_the_energy);
    RUN(vectors_and_rows_agree);
    RUN(a_free_strip_takes_its_length);
    RUN(a_clamped_bar_bears_minus_young_times_eigenstrain);
    RUN(a_bimetal_bends_as_timoshenko_has_it);
    RUN(the_ledger_closes_in_motion);
    RUN(a_grown_body_moves_and_breaks_as_one_at_rest);
    RUN(criteria_see_the_elastic_stretch);
    RUN(a_long_crack_in_a_cooled_strip_grows_by_griffith);
    RUN(node_energies_do_too);
    RUN(a_point_alone_stores_nothing);
    return test_end("test_eigenstrain");
}
