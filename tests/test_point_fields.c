/* SPDX-License-Identifier: MIT */
/* test_point_fields.c - strength, stiffness and density by point, strength by bond.

   SOURCE OF TRUTH
     strength   which bonds break at a given strain: counted here, bond by bond, by s > s0 times the mean of both ends (times the bond's)
     chain      a row of cells pulled slowly breaks at its weakest link, at its load; the weakest of n Weibull strengths is Weibull
                with the scale n^(-1/m)
     stiffness  the same factor everywhere is another Young's modulus; a bar of two halves is two springs one after the other
     density    the same factor everywhere is another unit of time; a bar of two halves rings at the root of cos cos = r sin sin
     life       a body that sets nothing, or what it has, holds no byte more; copies, resets, saved states and lack of memory */
#include "equilibrium.h"
#include "pool.h"
#include "specimen.h"

static const int32_t laws[4] = { PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE };

static double *doubles(int64_t n) {
    double *made = (double *)calloc((size_t)n, sizeof *made);
    if (!made) abort();
    return made;
}

static specimen plate_of(int32_t law, int nx, int ny) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, law == PERI_LAW_BOND_BASED ? (double)NAN : 0.25, 1e-3, 3.015, nx, ny, 1);
    s.material.young = 7e10;
    s.material.density = 2500;
    return s;
}

static void set(peri_body *b, int32_t field, double (*value)(const double *x)) {
    const int64_t n = peri_point_count(b);
    double *x = doubles(2 * n), *values = doubles(n);
    (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, 2 * n));
    for (int64_t i = 0; i < n; ++i) values[i] = value(&x[2 * i]);
    (void)MUST(b, peri_set_field(b, field, values, n));
    free(x), free(values);
}

static double any(const double *x) { /* of a place, in 0.5..1.5 */
    const double at = sin(12345.0 * x[0] + 54321.0 * x[1]) * 1000;
    return 0.5 + (at - floor(at));
}

static double fourfold(const double *x) { return (void)x, 4; }
static double quarter(const double *x) { return (void)x, 0.25; }
static double two_halves(const double *x) { return x[0] > 20e-3 ? 3 : 1; }
static double dense_half(const double *x) { return x[0] > 20e-3 ? 10000 : 2500; }

/* ---- strength ------------------------------------------------------------------------------------------------------- */

static int32_t steep(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user, (void)i, (void)j;
    return fabs(xj[1] - xi[1]) > 2.5 * fabs(xj[0] - xi[0]);
}

/* u = strain x in x alone; counts by the bonds that the library lists. */
static int64_t should_break(peri_body *b, const double *x, const double *strength, double strain, double s0, double of_steep) {
    const int64_t n = peri_point_count(b);
    const int32_t width = peri_family_width(b);
    int32_t *rows = (int32_t *)malloc((size_t)(n * width) * sizeof *rows);
    int64_t count = 0;
    (void)MUST(b, peri_get_families(b, 0, n, rows, n * width));
    for (int64_t i = 0; i < n; ++i)
        for (int32_t k = 0; k < width; ++k) {
            const int64_t j = rows[i * width + k];
            if (j <= i) continue;
            const double dx = x[2 * j] - x[2 * i], dy = x[2 * j + 1] - x[2 * i + 1], now = (1 + strain) * dx;
            const double stretch = sqrt((now * now + dy * dy) / (dx * dx + dy * dy)) - 1;
            const double own = steep(NULL, 0, 0, &x[2 * i], &x[2 * j]) ? of_steep : 1;
            count += stretch > s0 * 0.5 * (strength[i] + strength[j]) * own;
        }
    free(rows);
    return count;
}

static void bonds_break_at_the_strength_of_their_ends(void) {
    static const int32_t kernels[3] = { PERI_KERNEL_BEST, PERI_KERNEL_LIST, PERI_KERNEL_REFERENCE };
    for (int law = 0; law < 4; ++law)
        for (int k = 0; k < 3; ++k)
            for (int by_bond = 0; by_bond < 2; ++by_bond) {
                specimen s = plate_of(laws[law], 20, 12);
                peri_evaluate_desc e;
                peri_evaluate_report r;
                s.desc.kernel = kernels[k];
                s.material.critical_stretch = 1e-2;
                peri_body *b = specimen_make(&s);
                const int64_t n = peri_point_count(b);
                double *x = doubles(2 * n), *u = doubles(2 * n), *strength = doubles(n);
                (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, 2 * n));
                set(b, PERI_FIELD_STRENGTH, any);
                (void)MUST(b, peri_get_field(b, PERI_FIELD_STRENGTH, strength, n));
                if (by_bond) CHECK(MUST(b, peri_set_strength_if(b, 0.1, steep, NULL)) > 100);
                peri_evaluate_desc_init(&e);
                e.fracture = 1;
                e.displacement = u;
                for (int step = 1; step <= 3; ++step) {
                    const double strain = 4e-3 * step;
                    for (int64_t i = 0; i < n; ++i) u[2 * i] = strain * x[2 * i];
                    (void)MUST(b, peri_evaluate(b, &e, &r));
                    CHECK(peri_broken_count(b) == should_break(b, x, strength, strain, 1e-2, by_bond ? 0.1 : 1));
                }
                CHECK(peri_broken_count(b) > 100 && peri_broken_count(b) < peri_bond_count(b));
                free(x), free(u), free(strength);
                peri_body_destroy(b);
            }
}

/* Energies go with the square: under a strength f everywhere bonds break as under f^2 of the fracture energy. */
static void energies_go_with_the_square(void) {
    for (int k = 0; k < 2; ++k) {
        int64_t broken[2];
        for (int by_field = 0; by_field < 2; ++by_field) {
            specimen s = plate_of(PERI_LAW_LPS, 20, 12);
            const double h[4] = { 3e-3, 1e-3, 0, 1e-3 };
            peri_advance_desc a;
            s.material.criterion = k ? PERI_CRITERION_NODE_ENERGY : PERI_CRITERION_BOND_ENERGY;
            s.material.fracture_energy = by_field ? 200.0 * 16 : 200.0;
            peri_body *b = specimen_make(&s);
            const int64_t n = peri_point_count(b);
            double *v = doubles(2 * n), *x = doubles(2 * n);
            (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, 2 * n));
            for (int64_t i = 0; i < n; ++i)
                for (int d = 0; d < 2; ++d) v[2 * i + d] = 3e5 * (h[2 * d] * x[2 * i] + h[2 * d + 1] * x[2 * i + 1]);
            if (by_field) set(b, PERI_FIELD_STRENGTH, quarter);
            (void)MUST(b, peri_set_field(b, PERI_FIELD_VELOCITY, v, 2 * n));
            peri_advance_desc_init(&a);
            a.steps = 60;
            (void)MUST(b, peri_advance(b, &a));
            broken[by_field] = peri_broken_count(b);
            free(v), free(x);
            peri_body_destroy(b);
        }
        CHECK(broken[0] > 20 && broken[0] == broken[1]);
    }
}

/* A chain of cells whose families are their neighbours: each link c s of its own strength, one after the other, in linear geometry. */
static double chain_fails_at(uint64_t *seed, int links, double shape, double *weakest, int64_t *where, int64_t *expected) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, (double)NAN, 1, 1.2, links + 1, 1, 1);
    peri_solve_desc d = statics_of(1e-10);
    const double right[2] = { 1e-4 * links, 0 };
    int32_t *pairs = (int32_t *)malloc((size_t)(2 * links) * sizeof *pairs);
    double *factors = doubles(links), row[600], lo[2] = { -1, -1 }, hi[2] = { 0.9, 2 };
    s.material.critical_stretch = 1e-4;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *b = specimen_make(&s);
    *weakest = 1e30;
    for (int k = 0; k < links; ++k) {
        pairs[2 * k] = k, pairs[2 * k + 1] = k + 1;
        factors[k] = pow(-log(1 - test_random(seed)), 1 / shape);
        if (factors[k] < *weakest) *weakest = factors[k], *expected = k;
    }
    CHECK(MUST(b, peri_set_strength_pairs(b, links, pairs, factors)) == links);
    const int32_t left = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
    lo[0] = links, hi[0] = links + 2;
    const int32_t end = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
    (void)MUST(b, peri_prescribe_displacement(b, left, PERI_AXIS_X, NULL, NULL, NULL));
    const int32_t pull = (int32_t)MUST(b, peri_prescribe_displacement(b, end, PERI_AXIS_X, right, NULL, NULL));
    (void)MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_Y, NULL, NULL, NULL));
    d.control = PERI_CONTROL_FRACTURE;
    d.criticality = 1;
    d.load_to = 3;
    d.curve_load = pull;
    d.curve = row;
    d.curve_rows = 100;
    (void)MUST(b, peri_solve(b, &d, NULL));
    for (int k = 0; k < links; ++k)
        if (!peri_bond_is_intact(b, k, k + 1)) *where = k;
    const double at = row[0];
    free(pairs), free(factors);
    peri_body_destroy(b);
    return at;
}

static void a_chain_is_as_strong_as_its_weakest_link(void) {
    const int links = 12, chains = 40;
    const double shape = 5;
    uint64_t seed = 2024;
    double mean = 0, square = 0, weakest = 0;
    for (int k = 0; k < chains; ++k) {
        int64_t where = -1, expected = -2;
        const double at = chain_fails_at(&seed, links, shape, &weakest, &where, &expected);
        CHECK_NEAR(at, weakest, 1e-6, 0); /* the strain is the same in every link */
        CHECK(where == expected);
        mean += at / chains;
        square += at * at / chains;
    }
    /* mean and deviation of Weibull's distribution; 40 chains know the mean to 0.22/sqrt(40), here within three of these */
    const double scale = pow(links, -1 / shape), want = scale * tgamma(1 + 1 / shape);
    const double deviation = scale * sqrt(tgamma(1 + 2 / shape) - pow(tgamma(1 + 1 / shape), 2));
    CHECK(fabs(mean - want) < 3 * deviation / sqrt((double)chains));
    CHECK_NEAR(sqrt(square - mean * mean), deviation, 0.4, 0);
}

/* ---- stiffness and density ------------------------------------------------------------------------------------------ */

static void a_factor_everywhere_is_another_modulus(void) {
    for (int law = 0; law < 4; ++law) {
        double *f[2], *u = NULL, size = 0, energy[2], step[2];
        int64_t n = 0;
        for (int k = 0; k < 2; ++k) {
            specimen s = plate_of(laws[law], 14, 10);
            peri_evaluate_desc e;
            peri_evaluate_report r;
            uint64_t seed = 3;
            if (k == 0) s.material.young *= 4;
            peri_body *b = specimen_make(&s);
            if (k == 1) set(b, PERI_FIELD_STIFFNESS, fourfold);
            n = 2 * peri_point_count(b);
            u = doubles(n), f[k] = doubles(n);
            for (int64_t d = 0; d < n; ++d) u[d] = 1e-5 * test_random(&seed);
            peri_evaluate_desc_init(&e);
            e.displacement = u;
            e.force = f[k];
            e.energy = 1;
            (void)MUST(b, peri_evaluate(b, &e, &r));
            energy[k] = r.energy;
            step[k] = peri_stable_step(b);
            free(u);
            peri_body_destroy(b);
        }
        for (int64_t d = 0; d < n; ++d) size = fmax(size, fabs(f[0][d]));
        CHECK(furthest(f[0], f[1], n) < 1e-12 * size);
        CHECK_NEAR(energy[1], energy[0], 1e-12, 0);
        CHECK_NEAR(step[1], step[0], 1e-3, 0);
        free(f[0]), free(f[1]);
    }
}

/* One end held, the other moved: the strains of the halves are as 3 to 1, and the force is that of both springs. */
static void a_bar_of_two_halves_is_two_springs(void) {
    for (int law = 0; law < 4; ++law) {
        specimen s = plate_of(laws[law], 40, 8);
        peri_solve_desc d = statics_of(1e-9);
        double *u, *x, centre[4] = { 10.5e-3, 4.5e-3, 30.5e-3, 4.5e-3 }, strain[2];
        const double lo[2] = { -1, -1 }, hi[2] = { 3.1e-3, 1 }, far_lo[2] = { 36.9e-3, -1 }, far_hi[2] = { 1, 1 }, move[2] = { 1e-5, 0 };
        s.desc.geometry = PERI_GEOMETRY_LINEAR;
        peri_body *b = specimen_make(&s);
        const int64_t n = peri_point_count(b);
        set(b, PERI_FIELD_STIFFNESS, two_halves);
        (void)MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), PERI_AXIS_X, NULL, NULL, NULL));
        (void)MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, far_lo, far_hi)), PERI_AXIS_X, move, NULL,
                                                  NULL));
        d.loose = PERI_LOOSE_PINNED;
        (void)solve(b, &d);
        u = doubles(2 * n), x = doubles(2 * n);
        (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * n));
        (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, 2 * n));
        for (int k = 0; k < 2; ++k) {
            const double left[2] = { centre[2 * k] - 5e-3, 4.5e-3 }, right[2] = { centre[2 * k] + 5e-3, 4.5e-3 };
            strain[k] = (u[2 * peri_find_point(b, right)] - u[2 * peri_find_point(b, left)]) / 10e-3;
        }
        CHECK_NEAR(strain[0] / strain[1], 3, 2e-2, 0);
        free(u), free(x);
        peri_body_destroy(b);
    }
}

static void a_density_everywhere_is_another_time(void) {
    for (int law = 0; law < 4; ++law) {
        double *u[2], step[2], size = 0;
        int64_t n = 0;
        for (int k = 0; k < 2; ++k) {
            specimen s = plate_of(laws[law], 14, 10);
            peri_advance_desc a;
            uint64_t seed = 3;
            peri_energy e;
            peri_body *b = specimen_make(&s);
            n = 2 * peri_point_count(b);
            u[k] = doubles(n);
            for (int64_t d = 0; d < n; ++d) u[k][d] = 1e-5 * test_random(&seed);
            if (k == 1) {
                double *rho = doubles(n / 2), *read = doubles(n / 2);
                for (int64_t i = 0; i < n / 2; ++i) rho[i] = 10000;
                (void)MUST(b, peri_set_field(b, PERI_FIELD_DENSITY, rho, n / 2));
                (void)MUST(b, peri_get_field(b, PERI_FIELD_DENSITY, read, n / 2));
                CHECK_NEAR(read[3], 10000, 1e-15, 0);
                (void)MUST(b, peri_get_field(b, PERI_FIELD_MASS, read, n / 2));
                CHECK_NEAR(read[3], 10000 * 1e-6, 1e-12, 0);
                free(rho), free(read);
            }
            step[k] = peri_stable_step(b);
            (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u[k], n));
            peri_advance_desc_init(&a);
            a.steps = 100;
            a.time_step = 4e-8 * (1 + k);
            a.damping = 1e4 / (1 + k);
            (void)MUST(b, peri_advance(b, &a));
            (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u[k], n));
            (void)MUST(b, peri_get_energy(b, &e));
            CHECK(e.damping > 0 && fabs(e.error) < 2e-2 * e.initial);
            peri_body_destroy(b);
        }
        CHECK_NEAR(step[1] / step[0], 2, 1e-3, 0);
        for (int64_t d = 0; d < n; ++d) size = fmax(size, fabs(u[0][d]));
        CHECK(furthest(u[0], u[1], n) < 1e-9 * size);
        free(u[0]), free(u[1]);
    }
}

/* Free-free bar, 1 and 4 times as dense by halves of length l: tan(k l) = -2 tan(2 k l) of continuous force, k = omega sqrt(rho/E); the
   mode shape of the lowest root as the start, and the time until its end points pass zero. */
static void a_bar_of_two_densities_rings_at_its_pitch(void) {
    specimen s = plate_of(PERI_LAW_CORRESPONDENCE, 40, 4);
    const double l = 20e-3, speed = sqrt(7e10 / 2500);
    double lo = 0.5, hi = 1.5, *u, *x, sign, time = 0, before = 1, now = 1;
    peri_advance_desc a;
    s.material.poisson = 0;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    for (int k = 0; k < 60; ++k) { /* sin q cos 2q + 2 sin 2q cos q = 0 */
        const double q = 0.5 * (lo + hi), value = sin(q) * cos(2 * q) + 2 * sin(2 * q) * cos(q);
        if (value > 0) lo = q;
        else hi = q;
    }
    const double omega = lo * speed / l;
    peri_body *b = specimen_make(&s);
    const int64_t n = peri_point_count(b);
    x = doubles(2 * n), u = doubles(2 * n);
    (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, 2 * n));
    set(b, PERI_FIELD_DENSITY, dense_half);
    sign = cos(lo) / cos(2 * lo);
    for (int64_t i = 0; i < n; ++i)
        u[2 * i] = 1e-7 * (x[2 * i] < l ? cos(lo * x[2 * i] / l) : sign * cos(2 * lo * (2 * l - x[2 * i]) / l));
    (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * n));
    peri_advance_desc_init(&a);
    a.steps = 1;
    a.time_step = 4e-8;
    while (now > 0 && time < 1e-3) {
        (void)MUST(b, peri_advance(b, &a));
        before = now, time = peri_time(b);
        (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * n));
        now = u[0];
    }
    CHECK_NEAR(time - a.time_step * now / (now - before), acos(-1.0) / 2 / omega, 2e-2, 0);
    free(x), free(u);
    peri_body_destroy(b);
}

/* ---- life ----------------------------------------------------------------------------------------------------------- */

static int64_t bytes_of(peri_body *b) {
    peri_memory m;
    (void)MUST(b, peri_get_memory(b, &m));
    return m.total;
}

static void bodies_without_hold_nothing_more(void) {
    static const int32_t fields[4] = { PERI_FIELD_EIGENSTRAIN, PERI_FIELD_STRENGTH, PERI_FIELD_STIFFNESS, PERI_FIELD_DENSITY };
    specimen s = plate_of(PERI_LAW_LPS, 20, 12);
    pool p = { 0, 0, 0, 0, -1, 0 };
    s.material.critical_stretch = 1e-2;
    hook(&s.desc, &p);
    peri_body *b = specimen_make(&s), *copy = NULL;
    const int64_t n = peri_point_count(b), before = bytes_of(b);
    double *values = doubles(n), *read = doubles(n);
    for (int k = 0; k < 3; ++k) { /* what it is anyway */
        (void)MUST(b, peri_get_field(b, fields[k], values, n));
        (void)MUST(b, peri_set_field(b, fields[k], values, n));
    }
    CHECK(bytes_of(b) == before);
    for (int k = 0; k < 4; ++k) {
        for (int64_t i = 0; i < n; ++i) values[i] = 0.5 + 1e-3 * (double)i;
        const int64_t held = bytes_of(b);
        p.fail_at = p.calls;
        CHECK(peri_set_field(b, fields[k], values, n) == PERI_ERROR_MEMORY);
        CHECK(bytes_of(b) == held);
        (void)MUST(b, peri_set_field(b, fields[k], values, n));
        (void)MUST(b, peri_get_field(b, fields[k], read, n));
        for (int64_t i = 0; i < n; ++i) CHECK_NEAR(read[i], values[i], 1e-15, 0);
        CHECK(peri_set_field(b, fields[k], values, n - 1) == PERI_ERROR_CAPACITY);
        values[7] = k == 0 ? 11 : -1;
        CHECK(peri_set_field(b, fields[k], values, n) == PERI_ERROR_RANGE);
        values[7] = (double)NAN;
        CHECK(peri_set_field(b, fields[k], values, n) == PERI_ERROR_RANGE);
        peri_error error;
        (void)peri_get_error(b, &error);
        CHECK(error.index == 7);
    }
    CHECK(bytes_of(b) > before + n * 32);
    CHECK(bytes_of(b) == p.bytes);
    (void)MUST(b, peri_body_clone(b, &copy, NULL));
    (void)MUST(copy, peri_get_field(copy, PERI_FIELD_STIFFNESS, read, n));
    CHECK_NEAR(read[9], 0.509, 1e-15, 0);
    (void)MUST(b, peri_reset(b));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_STRENGTH, read, n));
    CHECK_NEAR(read[9], 0.509, 1e-15, 0);
    peri_body_destroy(copy);
    peri_body_destroy(b);
    CHECK(p.bytes == 0 && p.wrong == 0);
    free(values), free(read);
}

/* A clone, and a body that takes a saved state, go on with the same bits; a body without the fields refuses the state. */
typedef struct store {
    char   *bytes;
    int64_t count, read;
} store;

static int32_t keep(void *user, const void *bytes, int64_t count) {
    store *s = (store *)user;
    s->bytes = (char *)realloc(s->bytes, (size_t)(s->count + count));
    memcpy(s->bytes + s->count, bytes, (size_t)count);
    s->count += count;
    return 0;
}

static int32_t give(void *user, void *bytes, int64_t count) {
    store *s = (store *)user;
    if (s->read + count > s->count) return 1;
    memcpy(bytes, s->bytes + s->read, (size_t)count);
    s->read += count;
    return 0;
}

static double strain_at(const double *x) { return 4e-3 * any(x) - 4e-3; }

static void copies_and_saved_states_go_on_alike(void) {
    for (int law = 0; law < 4; ++law) {
        specimen s = plate_of(laws[law], 20, 12);
        const int32_t pair[2] = { 100, 101 };
        const double factor = 0.7;
        double *u[3];
        peri_body *b[3] = { NULL, NULL, NULL }, *bare;
        peri_advance_desc a;
        peri_error error;
        store kept = { NULL, 0, 0 };
        s.material.critical_stretch = 4e-3;
        peri_advance_desc_init(&a);
        a.steps = 30;
        a.time_step = 3e-8;
        for (int k = 0; k < 3; k += 2) {
            b[k] = specimen_make(&s);
            set(b[k], PERI_FIELD_STRENGTH, any);
            set(b[k], PERI_FIELD_STIFFNESS, any);
            set(b[k], PERI_FIELD_EIGENSTRAIN, k ? any : strain_at);
            set(b[k], PERI_FIELD_DENSITY, dense_half);
            (void)MUST(b[k], peri_set_strength_pairs(b[k], 1, pair, &factor));
        }
        bare = specimen_make(&s);
        (void)MUST(b[0], peri_advance(b[0], &a));
        CHECK(peri_broken_count(b[0]) > 0);
        (void)MUST(b[0], peri_body_clone(b[0], &b[1], NULL));
        (void)MUST(b[0], peri_save_state_to(b[0], keep, &kept));
        (void)MUST(b[2], peri_load_state_from(b[2], give, &kept));
        kept.read = 0;
        CHECK(peri_load_state_from(bare, give, &kept) == PERI_ERROR_STATE && peri_get_error(bare, &error) == PERI_OK);
        CHECK(strcmp(error.field, "eigenstrain") == 0); /* the first field that only one of both has */
        set(bare, PERI_FIELD_EIGENSTRAIN, any);
        kept.read = 0;
        CHECK(peri_load_state_from(bare, give, &kept) == PERI_ERROR_STATE && peri_get_error(bare, &error) == PERI_OK);
        CHECK(strcmp(error.field, "strength") == 0);
        kept.count = kept.read = 0; /* and the other way round */
        (void)MUST(bare, peri_save_state_to(bare, keep, &kept));
        CHECK(peri_load_state_from(b[2], give, &kept) == PERI_ERROR_STATE && peri_get_error(b[2], &error) == PERI_OK);
        CHECK(strcmp(error.field, "strength") == 0);
        const int64_t n = 2 * peri_point_count(b[0]);
        for (int k = 0; k < 3; ++k) {
            u[k] = doubles(n);
            (void)MUST(b[k], peri_advance(b[k], &a));
            (void)MUST(b[k], peri_get_field(b[k], PERI_FIELD_DISPLACEMENT, u[k], n));
            CHECK(memcmp(u[k], u[0], (size_t)n * sizeof **u) == 0 && peri_broken_count(b[k]) == peri_broken_count(b[0]));
        }
        for (int k = 0; k < 3; ++k) free(u[k]), peri_body_destroy(b[k]);
        peri_body_destroy(bare);
        free(kept.bytes);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(bonds_break_at_the_strength_of_their_ends);
    RUN(energies_go_with_the_square);
    RUN(a_chain_is_as_strong_as_its_weakest_link);
    RUN(a_factor_everywhere_is_another_modulus);
    RUN(a_bar_of_two_halves_is_two_springs);
    RUN(a_density_everywhere_is_another_time);
    RUN(a_bar_of_two_densities_rings_at_its_pitch);
    RUN(bodies_without_hold_nothing_more);
    RUN(copies_and_saved_states_go_on_alike);
    return test_end("test_point_fields");
}
