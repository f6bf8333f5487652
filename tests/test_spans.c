/* SPDX-License-Identifier: MIT */
/* Points that do not span the space, and families that are not those of the horizon: what the constants do not hold for. */
#include "pool.h"
#include "refusal.h"
#include "scene.h"

#define MOST 1200

typedef struct cloud {
    int     dim;
    int64_t count;
    double  x[3 * MOST], volume[MOST];
} cloud;
static cloud c;

static void put_point(double x, double y, double z) {
    const double at[3] = {x, y, z};
    for (int d = 0; d < c.dim; ++d) c.x[c.count * c.dim + d] = at[d];
    c.volume[c.count++] = 1;
}

static void put_block(double x, double y, double z, int nx, int ny, int nz) {
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) put_point(x + i, y + j, z + k);
}

static void clear_cloud(int dim) {
    c.dim = dim;
    c.count = 0;
}

static int remarks;
static int64_t remarked; /* the point that the last remark names */
static void count_remarks(void *user, int32_t level, const char *text) {
    const char *number = strstr(text, "at point ");
    (void)user;
    remarks += level > 0;
    remarked = number ? atoll(number + 9) : -1;
}

static peri_body *cloud_body(int32_t law, double horizon) {
    specimen s = specimen_of(c.dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, law, 0.2, 1, horizon, 1, 1, 1);
    s.desc.log = count_remarks;
    remarks = 0;
    remarked = -1;
    peri_body *b = specimen_start(&s);
    (void)MUST(b, peri_add_points(b, c.count, c.x, c.volume, NULL));
    return b;
}

/* The first point that the log names as flat, or -1: built it is, and one remark is all. */
static int64_t first_flat(int32_t law, double horizon) {
    peri_body *b = cloud_body(law, horizon);
    (void)MUST(b, peri_build(b));
    CHECK(remarks == (remarked >= 0));
    peri_body_destroy(b);
    return remarked;
}

/* Truth: a bar of one row stretched by e stores E e^2/2 per volume, whatever the horizon. Bonds in one line with the constants of the space
   store another energy: bond-based in 3D c sum |xi|/4 e^2 = 12/(pi 3^4) 12/4 E e^2, 0.28 of it; LPS of Poisson's ratio 0.25 15 mu/2 e^2, 6
   times it. Where the energy is off by a factor the log says so, and where it is not, nothing. */
static void rows_are_remarked(void) {
    static const double horizon[2] = {1.1, 3.015};
    for (int dim = 2; dim <= 3; ++dim)
        for (int32_t law = PERI_LAW_BOND_BASED; law <= PERI_LAW_CORRESPONDENCE; ++law)
            for (int turned = 0; turned < 2; ++turned)
                for (int k = 0; k < 2; ++k) {
                    const double a = turned ? 0.6 : 1, b = turned ? (dim == 3 ? 0.8 * 0.28 : 0.8) : 0, z = turned ? 0.8 * 0.96 : 0;
                    clear_cloud(dim);
                    for (int i = 0; i < 100; ++i) put_point(a * i, b * i, z * i);
                    CHECK(first_flat(law, horizon[k]) == 0);
                }
    for (int32_t law = PERI_LAW_BOND_BASED; law <= PERI_LAW_LPS; ++law) {
        const double springs = 12 / (PI * 81) * 12 / 4, solid = 15.0 / 2.4 / 2 + 3 * (0.2 / (1.2 * 0.6) - 1 / 2.4) * 3 / 2;
        const double want = law == PERI_LAW_BOND_BASED ? springs : solid;
        clear_cloud(3);
        put_block(0, 0, 0, 20, 1, 1);
        peri_body *b = cloud_body(law, 3);
        (void)MUST(b, peri_build(b));
        double *u = get(b, PERI_FIELD_POSITION), *w;
        for (int k = 0; k < 60; ++k) u[k] *= 1e-6;
        put(b, PERI_FIELD_DISPLACEMENT, u);
        w = get(b, PERI_FIELD_ENERGY_DENSITY);
        CHECK_NEAR(w[10] * 1e12, want, 1e-5, 0);
        CHECK(remarked == 0 && !(want > 0.25 && want < 1));
        free(u);
        free(w);
        peri_body_destroy(b);
    }
}

static void sheets_are_remarked(void) {
    static const double horizon[3] = {1.1, 1.5, 3.015};
    for (int k = 0; k < 3; ++k)
        for (int32_t law = PERI_LAW_BOND_BASED; law <= PERI_LAW_CORRESPONDENCE; ++law) {
            clear_cloud(3);
            put_block(0, 0, 0, 12, 11, 1);
            CHECK(first_flat(law, horizon[k]) == 0);
            clear_cloud(3);
            for (int i = 0; i < 144; ++i) put_point(i % 12, 0.6 * (i / 12), 0.8 * (i / 12)); /* turned about x */
            CHECK(first_flat(law, horizon[k]) == 0);
            clear_cloud(3);
            put_block(0, 0, 0, 40, 2, 1);
            CHECK(first_flat(law, horizon[k]) == 0);
        }
}

/* Points a spacing apart on an arc in the plane, and on a cylinder. */
static void bend(int dim, double radius, int rows) {
    clear_cloud(dim);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < 60; ++i) put_point(radius * sin(i / radius), radius * (1 - cos(i / radius)), j);
}

static void bent_rows_and_shells_are_remarked(void) {
    static const double radius[3] = {1e6, 100, 12};
    for (int k = 0; k < 3; ++k) {
        bend(2, radius[k], 1);
        CHECK(first_flat(PERI_LAW_LPS, 3.015) == 0);
        bend(3, radius[k], 1);
        CHECK(first_flat(PERI_LAW_LPS, 3.015) == 0);
        bend(3, radius[k], 10);
        CHECK(first_flat(PERI_LAW_BOND_BASED, 3.015) == 0);
    }
    for (int dim = 2; dim <= 3; ++dim) { /* closed: no point sees bonds on one side alone */
        clear_cloud(dim);
        for (int j = 0; j < (dim == 3 ? 9 : 1); ++j)
            for (int i = 0; i < 75; ++i) put_point(12 * cos(2 * PI * i / 75), 12 * sin(2 * PI * i / 75), j);
        CHECK(first_flat(PERI_LAW_BOND_BASED, 3.1) == 0);
    }
}

/* Two layers of a lattice have bonds in all directions, and so have the corners of coarse lattices; a body within one family is no row. */
static void nothing_is_said_of_what_spans(void) {
    static const double horizon[5] = {1, 1.1, 1.5, 3.015, 6};
    for (int k = 0; k < 5; ++k)
        for (int dim = 2; dim <= 3; ++dim)
            for (int thick = 2; thick <= 3; ++thick) {
                clear_cloud(dim);
                put_block(0, 0, 0, 12, dim == 3 ? 12 : thick, dim == 3 ? thick : 1);
                CHECK(first_flat(PERI_LAW_LPS, horizon[k]) < 0);
                clear_cloud(dim);
                put_block(0, 0, 0, 2, 2, dim == 3 ? 2 : 1);
                CHECK(first_flat(PERI_LAW_BOND_BASED, horizon[k]) < 0);
            }
    for (int n = 2; n <= 7; ++n) {
        clear_cloud(3);
        put_block(0, 0, 0, n, 1, 1);
        CHECK(first_flat(PERI_LAW_LPS, 3.015) < 0);
    }
    clear_cloud(3);
    put_block(0, 0, 0, 8, 1, 1);
    CHECK(first_flat(PERI_LAW_LPS, 3.015) == 0);
    clear_cloud(2);
    for (int i = 0; i < 40; ++i) put_point(i, 3.9 * (i % 2), 0); /* two rows, hardly within each other's reach */
    CHECK(first_flat(PERI_LAW_LPS, 4.1) < 0);
}

static int32_t in_the_shell(void *user, int64_t index, const double *x) {
    double out = 0;
    (void)index;
    for (int d = 0; d < *(int *)user; ++d) out = fmax(out, fabs(x[d] - 6.5));
    return out > 5.5;
}

/* A hair of a part that spans, a row beside it: the first flat point. Boxes, too, of whose inner points none is looked at. */
static void the_first_flat_point_is_named(void) {
    clear_cloud(2);
    put_block(0, 0, 0, 10, 10, 1);
    CHECK(first_flat(PERI_LAW_LPS, 3.015) < 0);
    put_block(10, 4, 0, 9, 1, 1);
    CHECK(first_flat(PERI_LAW_LPS, 3.015) > 100); /* the root of the hair sees the block */
    clear_cloud(2);
    put_block(0, 0, 0, 10, 10, 1);
    put_block(0, 30, 0, 30, 1, 1);
    CHECK(first_flat(PERI_LAW_LPS, 3.015) == 100);
    for (int dim = 2; dim <= 3; ++dim) { /* hollow: what spans is the edges alone */
        const int32_t space = dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS;
        specimen s = specimen_of(space, PERI_LAW_BOND_BASED, 0, 1, dim == 3 ? 3.015 : 1, 13, 13, 13);
        s.desc.log = count_remarks;
        remarks = 0;
        peri_body *b = specimen_start(&s);
        (void)MUST(b, peri_add_shape(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 1, in_the_shell, &dim));
        (void)MUST(b, peri_build(b));
        CHECK(remarks == 1 && remarked > 0);
        peri_body_destroy(b);
    }
    for (int flat = 0; flat < 2; ++flat) {
        specimen s = specimen_of(PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 0, 1, 3.015, 12, 12, flat ? 1 : 2);
        s.desc.log = count_remarks;
        remarks = 0;
        peri_body_destroy(specimen_make(&s));
        CHECK(remarks == flat);
    }
}

/* ---- families of the caller ------------------------------------------------------------ */

#define WIDTH 300
static int32_t rows[MOST * WIDTH];

typedef int (*chosen_fn)(const double *p, const double *q);

static double apart(int64_t i, int64_t j) {
    double square = 0;
    for (int d = 0; d < c.dim; ++d) square += pow(c.x[i * c.dim + d] - c.x[j * c.dim + d], 2);
    return sqrt(square);
}

/* All pairs within reach that `chosen` takes. */
static void choose_rows(double reach, chosen_fn chosen) {
    for (int32_t i = 0; i < c.count; ++i) {
        int k = 0;
        for (int32_t j = 0; j < c.count; ++j)
            if (i != j && apart(i, j) <= reach && (!chosen || chosen(&c.x[i * c.dim], &c.x[j * c.dim]))) rows[i * WIDTH + k++] = j;
        CHECK(k < WIDTH);
        while (k < WIDTH) rows[i * WIDTH + k++] = i;
    }
}

static peri_body *given_body(int32_t law, double horizon) {
    peri_body *b = cloud_body(law, horizon);
    (void)MUST(b, peri_set_families(b, WIDTH, rows));
    return b;
}

static int32_t given_verdict(double horizon) {
    peri_body *b = given_body(PERI_LAW_BOND_BASED, horizon);
    const int32_t status = peri_build(b);
    peri_body_destroy(b);
    return status;
}

/* sum |xi| V of what the rows have of point i, over that of all within the horizon. */
static double share(int64_t i, double horizon) {
    double given = 0, sought = 0;
    for (int k = 0; k < WIDTH && rows[i * WIDTH + k] != i; ++k) given += apart(i, rows[i * WIDTH + k]);
    for (int64_t j = 0; j < c.count; ++j)
        if (j != i && apart(i, j) <= horizon) sought += apart(i, j);
    return given / sought;
}

/* Truth: c holds for the sum of |xi| V over the ball of the horizon, and the energy of a strain is proportional to it. */
static void families_of_another_horizon_are_refused(void) {
    static const double other[4] = {1.5, 2.1, 4.05, 5.1};
    peri_error e;
    uint64_t seed = 3;
    for (int kind = 0; kind < 3; ++kind)
        for (int k = 0; k < 4; ++k)
            for (int32_t law = PERI_LAW_BOND_BASED; law <= PERI_LAW_LPS; ++law) {
                clear_cloud(kind == 1 ? 3 : 2);
                if (kind == 1 && k == 3) continue;
                put_block(0, 0, 0, kind == 1 ? 7 : 16, kind == 1 ? 7 : 16, kind == 1 ? 7 : 1);
                for (int64_t n = 0; kind == 2 && n < c.count * c.dim; ++n) c.x[n] += 0.4 * test_random(&seed);
                choose_rows(other[k], NULL);
                peri_body *b = given_body(law, 3.05);
                REFUSE(b, PERI_ERROR_IBOND, peri_build(b));
                CHECK(peri_get_error(b, &e) == PERI_OK && strcmp(e.field, "ibond") == 0 && e.index == 0);
                CHECK_NEAR(e.value, share(0, 3.05), 1e-12, 0);
                CHECK(other[k] < 3 ? e.value < 0.75 : e.value > 1.25);
                peri_body_destroy(b);
            }
}

/* The same of the nearest points of a cloud, however far they are. */
static void nearest_points_are_refused(void) {
    uint64_t seed = 3;
    clear_cloud(2);
    for (int k = 0; k < 256; ++k) put_point(k % 16 + 0.9 * test_random(&seed), k / 16 + 0.9 * test_random(&seed), 0);
    for (int32_t i = 0; i < c.count; ++i)
        for (int k = 0; k < WIDTH; ++k) rows[i * WIDTH + k] = i;
    for (int32_t i = 0; i < c.count; ++i)
        for (int n = 0, next = -1; n < 6; ++n) { /* the next nearest, mutually */
            const double last = next < 0 ? 0 : apart(i, next);
            next = -1;
            for (int32_t j = 0; j < c.count; ++j)
                if (j != i && apart(i, j) > last && (next < 0 || apart(i, j) < apart(i, next))) next = j;
            for (int end = 0; end < 2; ++end) {
                int32_t *row = &rows[(end ? next : i) * WIDTH];
                while (*row != (end ? next : i) && *row != (end ? i : next)) ++row;
                *row = end ? i : next;
            }
        }
    CHECK(given_verdict(3.05) == PERI_ERROR_IBOND);
    choose_rows(3.05, NULL);
    CHECK(given_verdict(3.05) == PERI_OK);
}

static int same_half(const double *p, const double *q) { return (p[0] < 7.5) == (q[0] < 7.5); }
static int same_grain(const double *p, const double *q) {
    return (int)((p[0] + 0.5) / 4) == (int)((q[0] + 0.5) / 4) && (int)((p[1] + 0.5) / 4) == (int)((q[1] + 0.5) / 4);
}
static int two_in_three(const double *p, const double *q) { return ((int)(p[0] + q[0] + 5 * p[1] + 5 * q[1]) % 3) != 0; }
static int notch(const double *p, const double *q) { return (p[1] < 7.5) == (q[1] < 7.5) || p[0] + q[0] > 16; }

/* A face, a notch, grains that know nothing of each other, bonds left out by number: all of them families of this horizon. */
static void families_cut_by_faces_are_taken(void) {
    static const chosen_fn chosen[5] = {NULL, same_half, notch, same_grain, two_in_three};
    for (int k = 0; k < 5; ++k)
        for (int p = 0; p < 3; ++p) {
            clear_cloud(2);
            put_block(0, 0, 0, 16, 16, 1);
            choose_rows(3.05, chosen[k]);
            CHECK(given_verdict(p == 0 ? 3.05 : p == 1 ? 3 : 3.1) == PERI_OK);
        }
    clear_cloud(2);
    put_block(0, 0, 0, 3, 1, 1);
    choose_rows(1.1, NULL);
    CHECK(given_verdict(3) == PERI_OK); /* all within one horizon: there is no bulk */
}

/* Cells that the horizon only touches may be in the family or not; with the weights of the quadrature they change little. */
static void cells_at_the_edge_may_be_in_or_out(void) {
    for (int beyond = 0; beyond < 3; ++beyond) { /* at a horizon of 1.2 the diagonal cells weigh half as much as those within */
        clear_cloud(2);
        put_block(0, 0, 0, 16, 16, 1);
        choose_rows(beyond == 2 ? 1.5 : beyond ? 3.5 : 3, NULL);
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, beyond == 2 ? 1.2 : 3, 1, 1, 1);
        s.desc.quadrature = PERI_QUADRATURE_PARTIAL;
        peri_body *b = specimen_start(&s);
        (void)MUST(b, peri_add_points(b, c.count, c.x, c.volume, NULL));
        (void)MUST(b, peri_set_families(b, WIDTH, rows));
        (void)MUST(b, peri_build(b));
        peri_body_destroy(b);
    }
}

/* ---- memory ------------------------------------------------------------ */

static pool lent;

/* Whichever allocation fails, what is refused is so in the end, and nothing is lost. */
static void failing_allocations(void) {
    for (int given = 0; given < 2; ++given) {
        int32_t status = PERI_ERROR_MEMORY;
        for (int64_t n = 1; status == PERI_ERROR_MEMORY && n < 200; ++n) {
            clear_cloud(2);
            put_block(0, 0, 0, 12, given ? 12 : 1, 1);
            if (given) choose_rows(1.5, NULL);
            specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 1, 3, 1, 1, 1);
            s.desc.log = count_remarks;
            hook(&s.desc, &lent);
            memset(&lent, 0, sizeof lent);
            lent.fail_at = -1;
            peri_body *b = specimen_start(&s);
            (void)MUST(b, peri_add_points(b, c.count, c.x, c.volume, NULL));
            if (given) (void)MUST(b, peri_set_families(b, WIDTH, rows));
            const int64_t before = lent.bytes;
            lent.fail_at = lent.calls + n - 1;
            status = peri_build(b);
            CHECK(status == PERI_OK || lent.bytes == before);
            peri_body_destroy(b);
            CHECK(lent.bytes == 0);
        }
        CHECK(status == (given ? PERI_ERROR_IBOND : PERI_OK));
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(rows_are_remarked);
    RUN(sheets_are_remarked);
    RUN(bent_rows_and_shells_are_remarked);
    RUN(nothing_is_said_of_what_spans);
    RUN(the_first_flat_point_is_named);
    RUN(families_of_another_horizon_are_refused);
    RUN(nearest_points_are_refused);
    RUN(families_cut_by_faces_are_taken);
    RUN(cells_at_the_edge_may_be_in_or_out);
    RUN(failing_allocations);
    return test_end("test_spans");
}
