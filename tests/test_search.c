/* SPDX-License-Identifier: MIT */
/* test_search.c - the search for families, and lists that are stored by place, not by id.

   Sources of truth: all pairs of points, tried here one by one; peri_build names the first point without a family and the first of two at
   one place; what a body does does not depend on how its points are numbered, nor, bit by bit, on the number of threads; break events come
   in ascending (i, j). */
#include "peri_test.h"

#define N_MAX 3000

typedef struct cloud {
    int     dim;
    int64_t count;
    double  horizon;
    double  x[3 * N_MAX], volume[N_MAX];
} cloud;

static cloud    given, moved;
static int32_t  rows_a[5 * 1000 * 1000], rows_b[1000 * 1000];
static int64_t  where[N_MAX]; /* of point i of `given`, in `moved`                                                         */
static uint64_t seed = 5;

static double unit(void) { return test_random(&seed); }

static double square_between(const cloud *c, int64_t i, int64_t j) {
    double sum = 0.0;
    int d;
    for (d = 0; d < c->dim; ++d) sum += (c->x[i * c->dim + d] - c->x[j * c->dim + d]) * (c->x[i * c->dim + d] - c->x[j * c->dim + d]);
    return sum;
}

static peri_body *body_of(const cloud *c, const peri_body_desc *desc) {
    peri_body *body = test_unit_body(desc, 0.0);
    MUST(body, peri_add_points(body, c->count, c->x, c->volume, NULL));
    return body;
}

static peri_body_desc desc_of(const cloud *c) {
    peri_body_desc d;
    peri_body_desc_init(&d);
    d.space = c->dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN;
    d.horizon = c->horizon;
    d.threads = 1;
    return d;
}

/* Truth: all pairs. Pairs within 1e-7 of the horizon may be either. */
static void check_families(const cloud *c) {
    const peri_body_desc d = desc_of(c);
    peri_body *body = body_of(c, &d);
    const int32_t status = peri_build(body);
    int64_t i, j, lonely = -1, width, wrong = 0;
    for (i = 0; i < c->count && lonely < 0; ++i) {
        int64_t found = 0;
        for (j = 0; j < c->count; ++j) found += j != i && square_between(c, i, j) <= c->horizon * c->horizon;
        if (found == 0) lonely = i;
    }
    if (lonely >= 0) { /* the first of them is named */
        peri_error error;
        CHECK(status == PERI_ERROR_FAMILY || status == PERI_ERROR_HORIZON);
        CHECK(peri_get_error(body, &error) == PERI_OK && error.index == lonely);
        peri_body_destroy(body);
        return;
    }
    MUST(body, status);
    width = peri_family_width(body);
    if (c->count * width > (int64_t)(sizeof rows_a / sizeof rows_a[0])) exit(3);
    MUST(body, peri_get_families(body, 0, c->count, rows_a, c->count * width));
    for (i = 0; i < c->count; ++i) {
        const int32_t *row = &rows_a[i * width];
        int64_t k = 0;
        for (j = 0; j < c->count; ++j) {
            const double ratio = sqrt(square_between(c, i, j)) / c->horizon;
            const int listed = k < width && row[k] == (int32_t)j && j != i;
            if (j != i && fabs(ratio - 1.0) > 1e-7) wrong += listed != (ratio < 1.0);
            k += listed;
        }
        for (; k < width; ++k) wrong += row[k] != (int32_t)i; /* padding, and so nothing else was listed */
    }
    CHECK(wrong == 0);
    peri_body_destroy(body);
}

static void fill(cloud *c, int dim, int64_t count, double horizon) {
    int64_t i;
    c->dim = dim;
    c->count = count;
    c->horizon = horizon;
    for (i = 0; i < count; ++i) c->volume[i] = 1.0;
}

static void scatter(cloud *c, double edge) {
    int64_t k;
    for (k = 0; k < c->count * c->dim; ++k) c->x[k] = edge * unit();
}

/* About 1 to 300 bonds a point. */
static void densities(void) {
    static const double bonds[4] = { 8, 30, 110, 300 };
    int dim, k;
    for (dim = 2; dim <= 3; ++dim)
        for (k = 0; k < 4; ++k) {
            fill(&given, dim, 2500, 1.0);
            scatter(&given, dim == 2 ? sqrt(2500 * 3.14 / bonds[k]) : cbrt(2500 * 4.19 / bonds[k]));
            check_families(&given);
        }
}

/* Every number of points from 1 to 100: cells of the grid are few, then, and of any shape. */
static void few_points(void) {
    int64_t n;
    int dim;
    for (dim = 2; dim <= 3; ++dim)
        for (n = 1; n <= 100; ++n) {
            fill(&given, dim, n, 1.0);
            scatter(&given, 0.6 * pow((double)n, 1.0 / dim));
            check_families(&given);
        }
}

/* Places with thousands of times as many points as others: most cells of the grid are empty, some hold more than is tested at once. */
static void clusters(void) {
    int64_t i;
    int dim, d;
    for (dim = 2; dim <= 3; ++dim) {
        fill(&given, dim, 2800, 1.0);
        for (i = 0; i < given.count; ++i) {
            const double spread = i < 1300 ? 0.3 : i < 2700 ? 2.5 : 3.5;
            for (d = 0; d < dim; ++d)
                given.x[i * dim + d] = spread * (unit() + unit() - 1.0) + (i < 1300 ? 20.0 : i < 2700 ? 0.0 : 18.0);
        }
        check_families(&given);
    }
}

/* On a line along an axis, on one across, and on a plane in space: the cloud has no width. */
static void thin_clouds(void) {
    int64_t i;
    int axis, d;
    for (axis = 0; axis <= 3; ++axis) {
        fill(&given, 3, 2000, 2.4);
        for (i = 0; i < given.count; ++i)
            for (d = 0; d < 3; ++d) given.x[i * 3 + d] = axis == 3 ? 0.6 * (double)i : d == axis ? (double)i + 0.3 * unit() : 7.0;
        check_families(&given);
    }
    fill(&given, 3, 2000, 3.0);
    scatter(&given, 45.0);
    for (i = 0; i < given.count; ++i) given.x[i * 3 + 1] = -1.0;
    check_families(&given);
}

/* Far from the origin, where coordinates have few digits left, and with one point far away that has a neighbour there. */
static void far_away(void) {
    int64_t k;
    int dim;
    for (dim = 2; dim <= 3; ++dim) {
        fill(&given, dim, 2000, 1e-3);
        scatter(&given, 1e-3 * (dim == 2 ? 15.0 : 6.0));
        for (k = 0; k < given.count * dim; ++k) given.x[k] += 1e5; /* with 8 digits of a horizon left */
        check_families(&given);
        for (k = 0; k < dim; ++k) {
            given.x[k] = -1e9;
            given.x[dim + k] = -1e9;
        }
        given.horizon = 1.0;
        for (k = 2 * dim; k < given.count * dim; ++k) given.x[k] = (given.x[k] - 1e5) * 1e3;
        given.x[0] += 0.5;
        check_families(&given);
    }
}

/* Truth: the smallest id that is not alone at its place, with the smallest there. */
static void twins(void) {
    static const int64_t pair[4][2] = { { 77, 78 }, { 1200, 1201 }, { 2, 1999 }, { 2, 1500 } }; /* one after the other */
    static const int64_t named[4][2] = { { 77, 78 }, { 77, 78 }, { 2, 1999 }, { 2, 1500 } };
    int dim, k, d;
    for (dim = 2; dim <= 3; ++dim) {
        fill(&given, dim, 2000, 1.0);
        scatter(&given, dim == 2 ? 15.0 : 6.0);
        for (k = 0; k < 4; ++k) {
            const peri_body_desc desc = desc_of(&given);
            peri_body *body;
            peri_error error;
            for (d = 0; d < dim; ++d) given.x[pair[k][1] * dim + d] = given.x[pair[k][0] * dim + d];
            body = body_of(&given, &desc);
            CHECK(peri_build(body) == PERI_ERROR_COINCIDENT);
            CHECK(peri_get_error(body, &error) == PERI_OK);
            CHECK(error.index == named[k][1] && error.value == (double)named[k][0]);
            peri_body_destroy(body);
        }
    }
}

/* ---- numbering ---------------------------------------------------------------------------------------------------- */

static void shuffle(void) {
    int64_t i;
    int d;
    moved = given;
    for (i = 0; i < given.count; ++i) where[i] = i;
    for (i = given.count - 1; i > 0; --i) {
        const int64_t j = (int64_t)(unit() * (double)(i + 1)), w = where[i];
        where[i] = where[j];
        where[j] = w;
    }
    for (i = 0; i < given.count; ++i) {
        for (d = 0; d < given.dim; ++d) moved.x[where[i] * given.dim + d] = given.x[i * given.dim + d];
        moved.volume[where[i]] = given.volume[i];
    }
}

typedef struct event {
    int64_t count, disorder;
    double  time;
    int32_t i, j;
} event;

static int32_t on_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    event *e = (event *)user;
    (void)stretch;
    if (i >= j || (e->count > 0 && e->time == time && (i < e->i || (i == e->i && j <= e->j)))) e->disorder++;
    e->time = time;
    e->i = i;
    e->j = j;
    e->count++;
    return 0;
}

typedef struct scene {
    const char *name;
    int32_t     law, quadrature, correction, precision, influence;
    int         breaks, dim; /* breaks 0: with centroids the end of lower id decides for both                              */
} scene;

/* Force density under a displacement that is no symmetry, then damage after steps that break bonds. */
static void act(const cloud *c, const scene *s, double *force, double *damage, int64_t *bonds, event *seen, const int64_t *to) {
    static double u[3 * N_MAX], out[3 * N_MAX];
    peri_body_desc desc = desc_of(c);
    peri_material_desc m;
    peri_body *body = NULL;
    peri_advance_desc run;
    int64_t i;
    int d;
    desc.quadrature = s->quadrature;
    desc.correction = s->correction;
    desc.precision = s->precision;
    desc.influence = s->influence;
    CHECK(peri_body_create(&desc, &body, NULL) == PERI_OK);
    peri_material_desc_init(&m, s->law);
    if (s->law != PERI_LAW_BOND_BASED) m.poisson = 0.2;
    m.young = m.density = 1.0;
    m.critical_stretch = s->breaks ? 0.02 : 0.0;
    MUST(body, peri_add_material(body, &m));
    MUST(body, peri_add_points(body, c->count, c->x, c->volume, NULL));
    MUST(body, peri_build(body));
    for (i = 0; i < c->count; ++i) {
        const double *x = &c->x[i * c->dim];
        for (d = 0; d < c->dim; ++d) u[i * c->dim + d] = 0.01 * sin(0.8 * x[0] + d) * x[(d + 1) % c->dim] + 0.02 * (x[d] > 4.0) * x[d];
    }
    MUST(body, peri_set_field(body, PERI_FIELD_DISPLACEMENT, u, c->count * c->dim));
    MUST(body, peri_get_field(body, PERI_FIELD_FORCE_DENSITY, out, c->count * c->dim));
    for (i = 0; i < c->count; ++i)
        for (d = 0; d < c->dim; ++d) force[i * c->dim + d] = out[(to ? to[i] : i) * c->dim + d];
    memset(seen, 0, sizeof *seen);
    MUST(body, peri_on_break(body, on_break, seen));
    peri_advance_desc_init(&run);
    run.steps = 2;
    MUST(body, peri_advance(body, &run));
    MUST(body, peri_get_field(body, PERI_FIELD_DAMAGE, out, c->count));
    for (i = 0; i < c->count; ++i) damage[i] = out[to ? to[i] : i];
    *bonds = peri_entry_count(body);
    CHECK(seen->disorder == 0 && seen->count == peri_broken_count(body) && (seen->count > 0) == s->breaks);
    peri_body_destroy(body);
}

static void renumbered(void) {
    static const scene scenes[] = {
        { "bond-based", PERI_LAW_BOND_BASED, PERI_QUADRATURE_FULL,
          PERI_CORRECTION_NONE, PERI_PRECISION_DOUBLE, PERI_INFLUENCE_CONSTANT, 1, 3 },
        { "bond-based f32", PERI_LAW_BOND_BASED, PERI_QUADRATURE_FULL,
          PERI_CORRECTION_NONE, PERI_PRECISION_SINGLE, PERI_INFLUENCE_CUBIC, 1, 3 },
        { "bond-based 2D", PERI_LAW_BOND_BASED, PERI_QUADRATURE_FULL,
          PERI_CORRECTION_NONE, PERI_PRECISION_DOUBLE, PERI_INFLUENCE_GAUSSIAN, 1, 2 },
        { "ramp", PERI_LAW_BOND_BASED, PERI_QUADRATURE_RAMP, PERI_CORRECTION_NONE, PERI_PRECISION_DOUBLE, PERI_INFLUENCE_CONSTANT, 1, 2 },
        { "partial", PERI_LAW_BOND_BASED, PERI_QUADRATURE_PARTIAL,
          PERI_CORRECTION_NONE, PERI_PRECISION_DOUBLE, PERI_INFLUENCE_LINEAR, 1, 2 },
        { "centroid", PERI_LAW_BOND_BASED, PERI_QUADRATURE_PARTIAL_CENTROID,
          PERI_CORRECTION_NONE, PERI_PRECISION_DOUBLE, PERI_INFLUENCE_CONSTANT, 0, 2 },
        { "LPS", PERI_LAW_LPS, PERI_QUADRATURE_FULL, PERI_CORRECTION_NONE, PERI_PRECISION_DOUBLE, PERI_INFLUENCE_CONSTANT, 1, 3 },
        { "Oterkus", PERI_LAW_OTERKUS, PERI_QUADRATURE_FULL, PERI_CORRECTION_NONE, PERI_PRECISION_DOUBLE, PERI_INFLUENCE_INVERSE, 1, 2 },
        { "correspondence", PERI_LAW_CORRESPONDENCE, PERI_QUADRATURE_FULL,
          PERI_CORRECTION_NONE, PERI_PRECISION_DOUBLE, PERI_INFLUENCE_CONSTANT, 1, 2 },
        { "volume correction", PERI_LAW_BOND_BASED, PERI_QUADRATURE_FULL,
          PERI_CORRECTION_VOLUME, PERI_PRECISION_DOUBLE, PERI_INFLUENCE_CONSTANT, 1, 2 },
        { "moment correction", PERI_LAW_LPS, PERI_QUADRATURE_FULL,
          PERI_CORRECTION_MOMENT, PERI_PRECISION_DOUBLE, PERI_INFLUENCE_CONSTANT, 1, 2 },
    };
    static double force[2][3 * N_MAX], damage[2][N_MAX];
    size_t k;
    seed = 5; /* whatever ran before: centroids of slivers lose digits */
    for (k = 0; k < sizeof scenes / sizeof scenes[0]; ++k) {
        const scene *s = &scenes[k];
        const double rounding = s->precision == PERI_PRECISION_SINGLE ? 2e-5 : 1e-11;
        double largest = 0.0, apart = 0.0, hurt = 0.0;
        int64_t bonds[2], i;
        event seen[2];
        fill(&given, s->dim, 1000, s->dim == 2 ? 3.0 : 2.2);
        scatter(&given, s->dim == 2 ? sqrt(1000.0) : 10.0);
        for (i = 0; i < given.count; ++i) given.volume[i] = 0.8 + 0.4 * unit();
        shuffle();
        act(&given, s, force[0], damage[0], &bonds[0], &seen[0], NULL);
        act(&moved, s, force[1], damage[1], &bonds[1], &seen[1], where);
        for (i = 0; i < given.count * given.dim; ++i) {
            largest = fmax(largest, fabs(force[0][i]));
            apart = fmax(apart, fabs(force[0][i] - force[1][i]));
        }
        for (i = 0; i < given.count; ++i) hurt = fmax(hurt, fabs(damage[0][i] - damage[1][i]));
        if (!(apart <= rounding * largest) || !(hurt <= 1e-6))
            printf("    %s: forces %.3g of %.3g, damage %.3g apart\n", s->name, apart, largest, hurt);
        CHECK(bonds[0] == bonds[1] && seen[0].count == seen[1].count);
        CHECK(apart <= rounding * largest && hurt <= 1e-6 && largest > 0.0);
    }
}

static int32_t written_out(void *user, double q, double *w) {
    switch (*(const int32_t *)user) {
    case PERI_INFLUENCE_LINEAR: { *w = 1 - q; return 0; }
    case PERI_INFLUENCE_CUBIC: { *w = 1 - 3 * q * q + 2 * q * q * q; return 0; }
    case PERI_INFLUENCE_QUINTIC: { *w = 1 - q * q * q * (10 - 15 * q + 6 * q * q); return 0; }
    default: { *w = exp(-q * q); return 0; }
    }
}

/* Truth: the same function of the caller, which is asked bond by bond. The two moments differ by what their quadratures leave. */
static void influences(void) {
    static const int32_t kinds[4] = { PERI_INFLUENCE_LINEAR, PERI_INFLUENCE_CUBIC, PERI_INFLUENCE_QUINTIC, PERI_INFLUENCE_GAUSSIAN };
    static double force[2][3 * N_MAX];
    int k, user;
    for (k = 0; k < 4; ++k) {
        double largest = 0.0, apart = 0.0;
        int64_t i;
        fill(&given, 3, 500, 2.2);
        scatter(&given, 7.9);
        for (user = 0; user < 2; ++user) {
            int32_t kind = kinds[k];
            peri_body_desc d = desc_of(&given);
            peri_body *body;
            d.influence = user ? PERI_INFLUENCE_USER : kind;
            d.influence_fn = user ? written_out : NULL;
            d.influence_user = &kind;
            body = body_of(&given, &d);
            MUST(body, peri_build(body));
            for (i = 0; i < 3 * given.count; ++i) force[user][i] = 1e-2 * sin(0.37 * (double)i);
            MUST(body, peri_set_field(body, PERI_FIELD_DISPLACEMENT, force[user], 3 * given.count));
            MUST(body, peri_get_field(body, PERI_FIELD_FORCE_DENSITY, force[user], 3 * given.count));
            peri_body_destroy(body);
        }
        for (i = 0; i < 3 * given.count; ++i) {
            largest = fmax(largest, fabs(force[1][i]));
            apart = fmax(apart, fabs(force[0][i] - force[1][i]));
        }
        CHECK(largest > 0.0 && apart <= 1e-9 * largest);
    }
}

/* Bonds are found from either end, and cut once. */
static void pairs_found(void) {
    peri_body_desc desc;
    peri_body *body;
    int64_t i, j, wrong = 0, bonds = 0;
    int32_t pair[2] = { 0, 0 };
    fill(&given, 3, 400, 2.2);
    scatter(&given, 7.4);
    desc = desc_of(&given);
    body = body_of(&given, &desc);
    MUST(body, peri_build(body));
    for (i = 0; i < given.count; ++i)
        for (j = 0; j < given.count; ++j) {
            const int bond = j != i && square_between(&given, i, j) <= given.horizon * given.horizon;
            wrong += (peri_bond_is_intact(body, (int32_t)i, (int32_t)j) == 1) != bond;
            bonds += bond;
            if (bond && i == 200) pair[1] = (int32_t)j;
        }
    pair[0] = 200;
    CHECK(wrong == 0 && peri_entry_count(body) == bonds);
    CHECK(peri_cut_pairs(body, PERI_CUT_INITIAL, 1, pair) == 1 && peri_cut_pairs(body, PERI_CUT_INITIAL, 1, pair) == 0);
    CHECK(peri_cut_count(body) == 1);
    CHECK(peri_bond_is_intact(body, pair[1], pair[0]) == 0);
    peri_body_destroy(body);
}

/* ---- threads ------------------------------------------------------------------------------------------------------ */

static void any_threads(void) {
    static double force[2][3 * N_MAX];
    int dim, kind;
    int32_t threads;
    for (dim = 2; dim <= 3; ++dim)
        for (kind = 0; kind < 2; ++kind)
            for (threads = 1; threads <= 3; ++threads) {
                static int32_t width;
                const double lo[3] = { 0, 0, 0 }, hi[3] = { 24, dim == 2 ? 60.0 : 10.0, 10 };
                double *out = force[threads > 1];
                int32_t *rows = threads > 1 ? rows_b : rows_a;
                peri_body_desc desc;
                peri_body *body;
                int64_t n, k;
                if (threads == 1 && kind == 0) {
                    fill(&given, dim, 2400, dim == 2 ? 4.2 : 2.4);
                    scatter(&given, dim == 2 ? 49.0 : 13.4);
                }
                desc = desc_of(&given);
                desc.horizon = dim == 2 ? 4.2 : 2.4;
                desc.threads = threads;
                body = test_unit_body(&desc, 0.0);
                if (kind == 0) MUST(body, peri_add_points(body, given.count, given.x, given.volume, NULL));
                else MUST(body, peri_add_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), lo, hi, dim == 2 ? 0.8 : 1.0));
                MUST(body, peri_build(body));
                n = peri_point_count(body);
                if (n > N_MAX) exit(3);
                if (threads == 1) width = peri_family_width(body);
                CHECK(peri_family_width(body) == width);
                if (n * width > (int64_t)(sizeof rows_b / sizeof rows_b[0])) exit(3);
                MUST(body, peri_get_families(body, 0, n, rows, n * width));
                for (k = 0; k < n * dim; ++k) out[k] = 1e-3 * sin(0.37 * (double)k);
                MUST(body, peri_set_field(body, PERI_FIELD_DISPLACEMENT, out, n * dim));
                MUST(body, peri_get_field(body, PERI_FIELD_FORCE_DENSITY, out, n * dim));
                if (threads > 1) {
                    CHECK(memcmp(rows_a, rows_b, (size_t)(n * width) * sizeof *rows_a) == 0);
                    CHECK(memcmp(force[0], force[1], (size_t)(n * dim) * sizeof force[0][0]) == 0);
                }
                peri_body_destroy(body);
            }
}

/* ---- lattices ----------------------------------------------------------------------------------------------------- */

/* Columns are repeated where groups of points are alike: boxes whose lines are no multiple of a group, balls, and boxes that meet at
   shifted or stretched lattices. Truth: all pairs, and the textbook kernel (desc.kernel). */
static void lattices(void) {
    int kind, dim;
    for (dim = 2; dim <= 3; ++dim)
        for (kind = 0; kind < 4; ++kind) {
            static double u[3 * N_MAX], force[2][3 * N_MAX];
            const double lo[3] = { 0, 0, 0 }, hi[3] = { dim == 2 ? 53.0 : 13.0, dim == 2 ? 47.0 : 14.0, 12 };
            const double lo2[3] = { 0, hi[1], 0 }, hi2[3] = { hi[0], hi[1] + 3.0, hi[2] }, centre[3] = { 1.1, 0.2, 0.3 };
            double largest = 0.0, apart = 0.0;
            int reference;
            for (reference = 0; reference < 2; ++reference) {
                peri_body_desc desc;
                peri_body *body;
                int64_t k;
                given.dim = dim;
                given.horizon = 2.3;
                desc = desc_of(&given);
                desc.kernel = reference ? PERI_KERNEL_REFERENCE : PERI_KERNEL_BEST;
                body = test_unit_body(&desc, 0.0);
                if (kind == 0) MUST(body, peri_add_ball(body, peri_id(body, PERI_KIND_MATERIAL, 1), centre, dim == 2 ? 24.0 : 7.5, 1.0));
                else MUST(body, peri_add_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), lo, hi, 1.0));
                if (kind == 2) MUST(body, peri_add_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), lo2, hi2, 0.99));
                if (kind == 3) {
                    const double lo3[3] = { hi[0] + 0.4, 0.0, 0.0 }, hi3[3] = { hi[0] + 3.4, hi[1], hi[2] };
                    MUST(body, peri_add_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), lo3, hi3, 1.0));
                }
                MUST(body, peri_build(body));
                given.count = peri_point_count(body);
                if (given.count > N_MAX) exit(3);
                for (k = 0; k < given.count * dim; ++k) u[k] = 1e-2 * sin(0.37 * (double)k);
                MUST(body, peri_set_field(body, PERI_FIELD_DISPLACEMENT, u, given.count * dim));
                MUST(body, peri_get_field(body, PERI_FIELD_FORCE_DENSITY, force[reference], given.count * dim));
                if (!reference) { /* the rows, as of a cloud */
                    int64_t i, j, wrong = 0, width = peri_family_width(body);
                    MUST(body, peri_get_field(body, PERI_FIELD_POSITION, given.x, given.count * dim));
                    if (given.count * width > (int64_t)(sizeof rows_a / sizeof rows_a[0])) exit(3);
                    MUST(body, peri_get_families(body, 0, given.count, rows_a, given.count * width));
                    for (i = 0; i < given.count; ++i) {
                        int64_t n = 0;
                        for (j = 0; j < given.count; ++j) {
                            if (j == i || square_between(&given, i, j) > given.horizon * given.horizon) continue;
                            wrong += n >= width || rows_a[i * width + n] != (int32_t)j;
                            ++n;
                        }
                        wrong += n < width && rows_a[i * width + n] != (int32_t)i;
                    }
                    CHECK(wrong == 0);
                }
                peri_body_destroy(body);
            }
            {
                int64_t k;
                for (k = 0; k < given.count * dim; ++k) {
                    largest = fmax(largest, fabs(force[1][k]));
                    apart = fmax(apart, fabs(force[0][k] - force[1][k]));
                }
            }
            CHECK(largest > 0.0 && apart <= 1e-11 * largest);
        }
}

/* Groups of a lattice with the same columns share the constants of their law, and bounds of the frequency are taken by columns, as long as
   all bonds are whole. Truth: the constants of each point by itself, which the textbook kernel (desc.kernel) uses on rows. */
static void constants_shared(void) {
    static const int32_t laws[3] = { PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE };
    static double u[3 * N_MAX], force[2][3 * N_MAX];
    int dim, k, ball;
    for (k = 0; k < 12; ++k) {
        double step[2][2], largest = 0.0, apart = 0.0;
        int64_t n = 0, i;
        int reference;
        dim = 2 + k / 6;
        ball = k / 3 % 2;
        for (reference = 0; reference < 2; ++reference) {
            const double lo[3] = { 0, 0, 0 }, hi[3] = { dim == 2 ? 37.0 : 13.0, dim == 2 ? 21.0 : test_long ? 14.0 : 9.0, 8 };
            const double centre[3] = { 0.1, 0.2, 0.3 };
            const double from[3] = { 0, 3.1, 0 }, to[3] = { 5, 3.1, 0 }, up[3] = { 0, 1, 0 };
            peri_body_desc d;
            peri_material_desc m;
            peri_body *body = NULL;
            peri_body_desc_init(&d);
            d.space = dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS;
            d.horizon = 2.3;
            d.threads = 1;
            d.kernel = reference ? PERI_KERNEL_REFERENCE : PERI_KERNEL_BEST;
            CHECK(peri_body_create(&d, &body, NULL) == PERI_OK);
            peri_material_desc_init(&m, laws[k % 3]);
            m.young = m.density = 1.0;
            m.poisson = 0.4; /* theta adds to the stiffness */
            MUST(body, peri_add_material(body, &m));
            if (ball) MUST(body, peri_add_ball(body, peri_id(body, PERI_KIND_MATERIAL, 1), centre, dim == 2 ? 14.0 : 6.0, 1.0));
            else MUST(body, peri_add_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), lo, hi, 1.0));
            MUST(body, peri_build(body));
            n = peri_point_count(body);
            if (n > N_MAX) exit(3);
            for (i = 0; i < n * dim; ++i) u[i] = 1e-2 * sin(0.37 * (double)i);
            MUST(body, peri_set_field(body, PERI_FIELD_DISPLACEMENT, u, n * dim));
            MUST(body, peri_get_field(body, PERI_FIELD_FORCE_DENSITY, force[reference], n * dim));
            step[reference][0] = peri_stable_step(body);
            if (dim == 2) MUST(body, peri_cut_segment(body, PERI_CUT_INITIAL, from, to)); /* and when they are whole no more */
            else MUST(body, peri_cut_disc(body, PERI_CUT_INITIAL, from, up, 4.0));
            step[reference][1] = peri_stable_step(body);
            peri_body_destroy(body);
        }
        for (i = 0; i < n * dim; ++i) {
            largest = fmax(largest, fabs(force[1][i]));
            apart = fmax(apart, fabs(force[0][i] - force[1][i]));
        }
        CHECK(largest > 0.0 && apart <= 1e-11 * largest);
        CHECK_NEAR(step[0][0], step[1][0], 1e-12, 0);
        CHECK_NEAR(step[0][1], step[1][1], 1e-12, 0);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(densities);
    RUN(few_points);
    RUN(clusters);
    RUN(thin_clouds);
    RUN(far_away);
    RUN(twins);
    RUN(renumbered);
    RUN(influences);
    RUN(pairs_found);
    RUN(any_threads);
    RUN(lattices);
    RUN(constants_shared);
    return test_end("test_search");
}
