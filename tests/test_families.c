/* SPDX-License-Identifier: MIT */
/* test_families.c - points, cells, families and sets, against counts and searches that are done here.

   Sources of truth: the number of integer vectors no longer than m (12, 28, 48, 80 in the plane; 32, 122, 256 in space),
   counted here in integers for every point of the lattice; O(N^2) searches; the volume and the first moment of a box. */
#include "peri_test.h"

#define N_MAX 4096

/* What a case takes, release() gives back. */
static void      *kept_memory[64];
static peri_body *kept_body[16];
static int        memories, bodies;

static void *keep(size_t bytes) {
    void *p = memories < 64 ? malloc(bytes + 1) : NULL;
    if (!p) exit(3);
    return kept_memory[memories++] = p;
}

static void release(void) {
    while (memories) free(kept_memory[--memories]);
    while (bodies) peri_body_destroy(kept_body[--bodies]);
}

/* A body with one material of E = 1, density = 1. */
static peri_body *new_body(int32_t space, int32_t precision, double horizon) {
    peri_body_desc d;
    peri_body_desc_init(&d);
    d.space = space;
    d.precision = precision;
    d.horizon = horizon;
    d.threads = 1;
    if (bodies == 16) exit(3);
    return kept_body[bodies++] = test_unit_body(&d, 0.0);
}

static double *read_field(peri_body *body, int32_t field) {
    const int64_t count = peri_size_of_field(body, field);
    double *values = (double *)keep(sizeof(double) * (size_t)(count > 0 ? count : 0));
    MUST(body, peri_get_field(body, field, values, count));
    return values;
}

static int32_t *read_rows(peri_body *body) {
    const int64_t n = peri_point_count(body), width = peri_family_width(body);
    int32_t *rows = (int32_t *)keep(sizeof(int32_t) * (size_t)(n * width));
    MUST(body, peri_get_families(body, 0, n, rows, n * width));
    return rows;
}

/* ---- families on lattices ------------------------------------------------------------------------------------------ */

/* Compares every row with the integer vectors v, 4 v.v <= two_m^2 (horizon: two_m/2 spacings), that stay in the lattice.
   Rows ascend and are padded with the row's own id; the size field, the width and the bond count agree. */
static void check_lattice_rows(peri_body *body, int dim, const int *n, int two_m) {
    const int reach = two_m / 2, rz = dim == 3 ? reach : 0;
    int32_t *rows = read_rows(body);
    double  *sizes = read_field(body, PERI_FIELD_FAMILY_SIZE);
    const int64_t width = peri_family_width(body);
    int64_t total = 0, largest = 0, wrong = 0;
    int x, y, z, dx, dy, dz;
    CHECK(peri_point_count(body) == (int64_t)n[0] * n[1] * n[2]);
    for (z = 0; z < n[2]; ++z)
        for (y = 0; y < n[1]; ++y)
            for (x = 0; x < n[0]; ++x) {
                const int64_t i = x + (int64_t)n[0] * (y + (int64_t)n[1] * z);
                const int32_t *row = rows + i * width;
                int64_t k = 0;
                for (dz = -rz; dz <= rz; ++dz)
                    for (dy = -reach; dy <= reach; ++dy)
                        for (dx = -reach; dx <= reach; ++dx) {
                            const int a = x + dx, b = y + dy, c = z + dz;
                            if (4 * (dx * dx + dy * dy + dz * dz) > two_m * two_m || (!dx && !dy && !dz)) continue;
                            if (a < 0 || b < 0 || c < 0 || a >= n[0] || b >= n[1] || c >= n[2]) continue;
                            if (k >= width || row[k] != a + n[0] * (b + n[1] * c)) wrong++;
                            k++;
                        }
                if (k > largest) largest = k;
                total += k;
                if ((int64_t)sizes[i] != k) wrong++;
                for (; k < width; ++k) wrong += row[k] != (int32_t)i;
            }
    CHECK(wrong == 0 && width == largest && peri_entry_count(body) == total);
}

/* One lattice: by the library's box or by the caller's own coordinates origin + (i + 1/2) dx. */
static void one_lattice(int dim, int two_m, double dx, const double *origin, int by_points, int32_t precision) {
    static double position[3 * N_MAX], volume[N_MAX];
    const int m = (two_m + 1) / 2, n[3] = {2 * m + 1, 2 * m + 2, dim == 3 ? 2 * m + 1 : 1}, count = n[0] * n[1] * n[2];
    peri_body *body = new_body(dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, precision, two_m % 2 ? 0.5 * two_m * dx : m * dx);
    double lo[3], hi[3];
    int i, k;
    for (k = 0; k < 3; ++k) {
        lo[k] = origin[k] * dx;
        hi[k] = lo[k] + n[k] * dx;
    }
    if (by_points) {
        for (i = 0; i < count; ++i) {
            position[i * dim] = lo[0] + (i % n[0] + 0.5) * dx;
            position[i * dim + 1] = lo[1] + (i / n[0] % n[1] + 0.5) * dx;
            if (dim == 3) position[i * dim + 2] = lo[2] + (i / n[0] / n[1] + 0.5) * dx;
            volume[i] = dim == 3 ? dx * dx * dx : dx * dx;
        }
        CHECK(MUST(body, peri_add_points(body, count, position, volume, NULL)) == count);
    } else {
        CHECK(MUST(body, peri_add_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), lo, hi, dx)) == count);
    }
    if (MUST(body, peri_build(body)) >= 0) {
        check_lattice_rows(body, dim, n, two_m);
        if (two_m % 2 == 0) { /* the interior point has the textbook's count */
            static const int plane[6] = {0, 0, 12, 28, 48, 80}, space[5] = {0, 0, 32, 122, 256};
            CHECK(peri_family_width(body) == (dim == 3 ? space[m] : plane[m]));
        }
    }
    release();
}

static void all_lattices(int dim, int two_m_lo, int two_m_hi) {
    static const double spacing[9] = {1e-9, 1e-6, 1e-3, 0.1, 1.0, 3.0, 1e3, 1e6, 1e9};
    static const double origin[3][3] = {{0, 0, 0}, {1e6, -7e5, 3e5}, {-12345.678, 98765.4321, -1e6}};
    int two_m, s, o, by_points;
    for (two_m = two_m_lo; two_m <= two_m_hi; ++two_m)
        for (s = 0; s < 9; ++s)
            for (o = 0; o < 3; ++o)
                for (by_points = 0; by_points < 2; ++by_points) {
                    one_lattice(dim, two_m, spacing[s], origin[o], by_points, PERI_PRECISION_DOUBLE);
                    one_lattice(dim, two_m, spacing[s], origin[o], by_points, PERI_PRECISION_SINGLE);
                }
}

static void lattice_counts_2d(void) { all_lattices(2, 3, 11); }
static void lattice_counts_3d(void) { all_lattices(3, 3, 6); }
static void lattice_counts_3d_wide(void) {
    static const double origin[3] = {1e6, -7e5, 3e5};
    one_lattice(3, 8, 0.1, origin, 0, PERI_PRECISION_DOUBLE);
    one_lattice(3, 8, 1e-9, origin, 1, PERI_PRECISION_SINGLE);
    one_lattice(3, 9, 3.0, origin, 1, PERI_PRECISION_DOUBLE);
}
static void lattice_counts_3d_all(void) { all_lattices(3, 7, 9); }

/* Truth: the header's relative tolerance of 1e-8 for comparisons with the horizon. 24 = 28 less the four points at 3 dx. */
static void horizon_tolerance(void) {
    static const double factor[4] = {1.0 - 2e-8, 1.0 - 0.5e-8, 1.0 + 0.5e-8, 1.0};
    static const int32_t want[4] = {24, 28, 28, 28};
    static const double lo[2] = {0, 0}, hi[2] = {9, 9};
    int k;
    for (k = 0; k < 4; ++k) {
        peri_body *body = new_body(PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_DOUBLE, 3.0 * factor[k]);
        MUST(body, peri_add_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), lo, hi, 1.0));
        MUST(body, peri_build(body));
        CHECK(peri_family_width(body) == want[k]);
        release();
    }
}

/* ---- clouds -------------------------------------------------------------------------------------------------------- */

static void random_cloud(int dim, int64_t n, uint64_t seed, double scale, double *position, double *volume) {
    int64_t i;
    for (i = 0; i < n; ++i) {
        int k;
        for (k = 0; k < dim; ++k) position[i * dim + k] = scale * (test_random(&seed) - 0.25);
        volume[i] = (0.5 + test_random(&seed)) * pow(scale, dim) / (double)n;
    }
}

static double distance(int dim, const double *a, const double *b) {
    return dim == 2 ? hypot(a[0] - b[0], a[1] - b[1]) : hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* Truth: all pairs. No pair of these clouds lies within 1e-7 of the horizon, so no tolerance matters. */
static void one_cloud(int dim, int64_t n, uint64_t seed, double horizon, double scale, int32_t precision) {
    static double position[3 * N_MAX], volume[N_MAX];
    peri_body *body = new_body(dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, precision, horizon * scale);
    int32_t *rows, *some, wrong = 0;
    double *sizes;
    int64_t i, j, k, width, total = 0, largest = 0;
    random_cloud(dim, n, seed, scale, position, volume);
    CHECK(MUST(body, peri_add_points(body, n, position, volume, NULL)) == n);
    MUST(body, peri_build(body));
    rows = read_rows(body);
    sizes = read_field(body, PERI_FIELD_FAMILY_SIZE);
    width = peri_family_width(body);
    for (i = 0; i < n; ++i) {
        for (j = 0, k = 0; j < n; ++j) {
            const double r = distance(dim, position + i * dim, position + j * dim);
            CHECK(fabs(r / (horizon * scale) - 1.0) > 1e-7);
            if (j == i || r > horizon * scale) continue;
            if (k >= width || rows[i * width + k] != (int32_t)j) wrong++;
            k++;
        }
        total += k;
        if (k > largest) largest = k;
        if ((int64_t)sizes[i] != k) wrong++;
        for (; k < width; ++k) wrong += rows[i * width + k] != (int32_t)i;
    }
    CHECK(wrong == 0 && width == largest && peri_entry_count(body) == total);
    some = (int32_t *)keep(sizeof(int32_t) * (size_t)(5 * width)); /* a part of the rows, from the middle */
    MUST(body, peri_get_families(body, 17, 5, some, 5 * width));
    CHECK(memcmp(some, rows + 17 * width, sizeof(int32_t) * (size_t)(5 * width)) == 0);
    CHECK(peri_get_families(body, n - 2, 3, some, 5 * width) < 0 && peri_get_families(body, 17, 5, some, 5 * width - 1) < 0);
    release();
}

static void clouds(void) {
    one_cloud(2, 1000, 11, 0.11, 1.0, PERI_PRECISION_DOUBLE);
    one_cloud(2, 3000, 12, 0.07, 1e-6, PERI_PRECISION_SINGLE);
    one_cloud(2, 1500, 13, 0.09, 1e7, PERI_PRECISION_DOUBLE);
    one_cloud(3, 1000, 14, 0.25, 1.0, PERI_PRECISION_SINGLE);
    one_cloud(3, 2500, 15, 0.17, 1e-8, PERI_PRECISION_DOUBLE);
}

/* ---- families from the caller -------------------------------------------------------------------------------------- */

/* A displacement that is no rigid motion and no symmetry: a fixed random one of 1 % of the horizon. */
static void shake(peri_body *body, int dim, double size) {
    const int64_t count = peri_point_count(body) * dim;
    double *u = (double *)keep(sizeof(double) * (size_t)count);
    uint64_t seed = 99;
    int64_t k;
    for (k = 0; k < count; ++k) u[k] = size * (test_random(&seed) - 0.5);
    MUST(body, peri_set_field(body, PERI_FIELD_DISPLACEMENT, u, count));
}

static void compare_field(peri_body *a, peri_body *b, int32_t field) {
    double *x = read_field(a, field), *y = read_field(b, field), largest = 0.0;
    const int64_t count = peri_size_of_field(a, field);
    int64_t k;
    CHECK(count == peri_size_of_field(b, field));
    for (k = 0; k < count; ++k) largest = fmax(largest, fabs(x[k]));
    CHECK(largest > 0.0);
    for (k = 0; k < count; ++k) CHECK_NEAR(y[k], x[k], 0.0, 1e-13 * largest); /* the sum of ~30 terms, in any order */
}

/* Truth: the same points with the same families are the same body, whoever found them. */
static void families_given(void) {
    static double position[3 * N_MAX], volume[N_MAX];
    static const double lo[3] = {0, 0, 0}, hi[3] = {1, 0.8, 0.7};
    int kind;
    for (kind = 0; kind < 3; ++kind) { /* 0: cloud 2D, 1: cloud 3D, 2: lattice 3D */
        const int dim = kind ? 3 : 2;
        const double horizon = kind == 0 ? 0.15 : 0.3;
        const int32_t space = kind ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS;
        peri_body *found = new_body(space, PERI_PRECISION_DOUBLE, horizon), *given = new_body(space, PERI_PRECISION_DOUBLE, horizon);
        int32_t *rows;
        int k;
        random_cloud(dim, 600, 5, 1.0, position, volume);
        for (k = 0; k < 2; ++k)
            if (kind == 2) MUST(found, peri_add_box(k ? given : found, peri_id(k ? given : found, PERI_KIND_MATERIAL, 1), lo, hi, 0.1));
            else MUST(found, peri_add_points(k ? given : found, 600, position, volume, NULL));
        MUST(found, peri_build(found));
        rows = read_rows(found);
        MUST(given, peri_set_families(given, peri_family_width(found), rows));
        if (MUST(given, peri_build(given)) >= 0) {
            CHECK(peri_entry_count(given) == peri_entry_count(found) && peri_family_width(given) == peri_family_width(found));
            shake(found, dim, 0.01 * horizon);
            shake(given, dim, 0.01 * horizon);
            compare_field(found, given, PERI_FIELD_ENERGY_DENSITY);
            compare_field(found, given, PERI_FIELD_FORCE_DENSITY);
        }
        release();
    }
}

/* Truth: the sums f_i = sum c s M V_j and W_i = 1/4 sum c s^2 |xi| V_j (thickness 1) over a family that no search would
   find: the mutual pairs with (i + j) mod 3 != 0 among the pairs within the horizon. */
static void families_chosen(void) {
    enum { N = 300, WIDTH = 64 };
    static double position[2 * N], volume[N];
    static int32_t rows[N * WIDTH];
    const double horizon = 0.15;
    peri_body *body = new_body(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, horizon);
    double *u, *w, *f, c = 0.0, largest = 0.0;
    int32_t i, j;
    random_cloud(2, N, 21, 1.0, position, volume);
    for (i = 0; i < N; ++i) {
        int32_t k = 0;
        for (j = 0; j < N; ++j)
            if (i != j && (i + j) % 3 && distance(2, position + 2 * i, position + 2 * j) <= horizon && k < WIDTH)
                rows[i * WIDTH + k++] = j;
        CHECK(k < WIDTH);
        while (k < WIDTH) rows[i * WIDTH + k++] = i;
    }
    MUST(body, peri_add_points(body, N, position, volume, NULL));
    MUST(body, peri_set_families(body, WIDTH, rows));
    MUST(body, peri_build(body));
    MUST(body, peri_get_bond_constants(body, peri_id(body, PERI_KIND_MATERIAL, 1), peri_id(body, PERI_KIND_MATERIAL, 1), &c, NULL));
    shake(body, 2, 0.01 * horizon);
    u = read_field(body, PERI_FIELD_DISPLACEMENT);
    w = read_field(body, PERI_FIELD_ENERGY_DENSITY);
    f = read_field(body, PERI_FIELD_FORCE_DENSITY);
    for (i = 0; i < 2 * N; ++i) largest = fmax(largest, fabs(f[i]));
    for (i = 0; i < N; ++i) {
        double energy = 0.0, force[2] = {0.0, 0.0};
        int32_t k;
        for (k = 0; k < WIDTH && (j = rows[i * WIDTH + k]) != i; ++k) {
            const double r = distance(2, position + 2 * j, position + 2 * i);
            const double y0 = position[2 * j] + u[2 * j] - position[2 * i] - u[2 * i];
            const double y1 = position[2 * j + 1] + u[2 * j + 1] - position[2 * i + 1] - u[2 * i + 1];
            const double p = hypot(y0, y1), s = (p - r) / r;
            energy += 0.25 * c * s * s * r * volume[j];
            force[0] += c * s * y0 / p * volume[j];
            force[1] += c * s * y1 / p * volume[j];
        }
        CHECK_NEAR(w[i], energy, 1e-11, 0.0);
        for (k = 0; k < 2; ++k) CHECK_NEAR(f[2 * i + k], force[k], 0.0, 1e-11 * largest);
    }
    release();
}

/* Truth: peri.h: membership must be mutual, ids valid, none twice; error.index names the first offending entry of ibond (of
   twins either). Afterwards the body is as it was: the right rows still build it, and the width is that of the largest family. */
static void families_refused(void) {
    enum { N = 9, WIDTH = 9 };
    static const double lo[2] = {0, 0}, hi[2] = {3, 3};
    static const int64_t entry[4] = {4 * WIDTH + 7, 5 * WIDTH, 6 * WIDTH + 8, 2 * WIDTH + 6};
    int32_t good[N * WIDTH], bad[N * WIDTH], i, j, k, kind;
    for (i = 0; i < N; ++i) { /* everybody knows everybody, one column spare */
        for (j = 0, k = 0; j < N; ++j)
            if (j != i) good[i * WIDTH + k++] = j;
        good[i * WIDTH + k] = i;
    }
    for (kind = 0; kind < 4; ++kind) {
        peri_body *body = new_body(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, 4.5);
        peri_error error;
        int32_t result;
        MUST(body, peri_add_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), lo, hi, 1.0));
        memcpy(bad, good, sizeof bad);
        if (kind == 0) bad[4 * WIDTH + 7] = N;
        if (kind == 1) bad[5 * WIDTH + 0] = -2;
        if (kind == 2) bad[6 * WIDTH + 8] = 3;
        if (kind == 3) { /* 2 lists 7, 7 does not list 2 */
            memmove(bad + 7 * WIDTH + 2, bad + 7 * WIDTH + 3, sizeof(int32_t) * 5);
            bad[7 * WIDTH + 7] = 7;
        }
        result = peri_set_families(body, WIDTH, bad);
        if (result >= 0) result = peri_build(body);
        CHECK(result == PERI_ERROR_IBOND && peri_get_error(body, &error) == PERI_OK && error.code == PERI_ERROR_IBOND);
        CHECK(error.index == entry[kind] || (kind == 2 && error.index == 6 * WIDTH + 3));
        MUST(body, peri_set_families(body, WIDTH, good));
        MUST(body, peri_build(body));
        CHECK(peri_entry_count(body) == N * (N - 1));
        CHECK(peri_family_width(body) == N - 1);
        release();
    }
}

/* ---- perturbed boxes ----------------------------------------------------------------------------------------------- */

static double box_lo[3] = {-1.0, 2.0, 0.5}, box_hi[3] = {2.0, 4.2, 1.5};

static peri_body *perturbed(int dim, double spacing, double amount, uint64_t seed, int plain) {
    peri_body *body = new_body(dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, 3.0 * spacing);
    if (plain) MUST(body, peri_add_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), box_lo, box_hi, spacing));
    else MUST(body, peri_add_perturbed_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), box_lo, box_hi, spacing, amount, seed));
    MUST(body, peri_build(body));
    return body;
}

/* Truths. The moved cells tile the box and their points are centroids: sum V = |box| and sum V x = |box| * centre, exactly
   (1e-12: rounding of ~1000 terms). Vertices move by at most a = amount/4 cells per axis. The centroid of a quadrilateral
   then moves by at most 4a/3 of a cell, not a: the extreme is the trapezoid with sides 1 - 2a and 1 + 2a, moved by a; in
   3D, the frustum, less than 5a/3. Its linear response to a vertex is u_x/4 +- u_y/12, so with u uniform in +-a the rms is
   a/sqrt(3) * sqrt(4/16 + 4/144); 560 cells give it to some %. */
static void one_perturbed(int dim, double spacing, double amount) {
    peri_body *body = perturbed(dim, spacing, amount, 7, 0), *twin = perturbed(dim, spacing, amount, 7, 0);
    peri_body *other = perturbed(dim, spacing, amount, 8, 0), *plain = perturbed(dim, spacing, amount, 7, 1);
    double *x = read_field(body, PERI_FIELD_POSITION), *v = read_field(body, PERI_FIELD_VOLUME);
    double *x2 = read_field(twin, PERI_FIELD_POSITION), *v2 = read_field(twin, PERI_FIELD_VOLUME);
    double *x3 = read_field(other, PERI_FIELD_POSITION), *x0 = read_field(plain, PERI_FIELD_POSITION);
    double *v0 = read_field(plain, PERI_FIELD_VOLUME);
    const int64_t n = peri_point_count(body);
    const double bound = amount / 4.0 * (dim == 2 ? 4.0 : 5.0) / 3.0;
    double sum = 0.0, size = 1.0, moment[3] = {0, 0, 0}, cell[3], square = 0.0;
    int64_t i, differ = 0, inner = 0;
    int k;
    CHECK(peri_point_count(twin) == n && peri_point_count(other) == n && peri_point_count(plain) == n);
    for (k = 0; k < dim; ++k) {
        size *= box_hi[k] - box_lo[k];
        cell[k] = (box_hi[k] - box_lo[k]) / floor((box_hi[k] - box_lo[k]) / spacing + 0.5);
    }
    for (i = 0; i < n; ++i) {
        int interior = 1;
        CHECK(v[i] > 0.0);
        if (amount == 0.0) CHECK_NEAR(v[i], v0[i], 1e-13, 0.0);
        sum += v[i];
        for (k = 0; k < dim; ++k) {
            const int64_t at = i * dim + k;
            moment[k] += v[i] * x[at];
            CHECK(x[at] > box_lo[k] && x[at] < box_hi[k]);
            CHECK(fabs(x[at] - x0[at]) <= bound * cell[k] * (1.0 + 1e-9) + 1e-14);
            if (x0[at] - box_lo[k] < cell[k] || box_hi[k] - x0[at] < cell[k]) interior = 0;
            if (x[at] != x3[at]) differ++;
        }
        if (!interior) continue;
        inner++;
        for (k = 0; k < dim; ++k) square += pow((x[i * dim + k] - x0[i * dim + k]) / cell[k], 2) / dim;
    }
    CHECK_NEAR(sum, size, 1e-12, 0.0);
    for (k = 0; k < dim; ++k) CHECK_NEAR(moment[k], size * 0.5 * (box_lo[k] + box_hi[k]), 1e-12, 0.0);
    CHECK(memcmp(x, x2, sizeof(double) * (size_t)(n * dim)) == 0);
    CHECK(memcmp(v, v2, sizeof(double) * (size_t)n) == 0);
    CHECK(differ == (amount > 0.0 ? n * dim : 0) && (amount > 0.0 || peri_entry_count(body) == peri_entry_count(plain)));
    if (dim == 2) CHECK_NEAR(sqrt(square / (double)inner), amount / 4 / sqrt(3.0) * sqrt(10.0 / 36.0), 0.12, 1e-13);
    release();
}

static void perturbed_boxes(void) {
    one_perturbed(2, 0.1, 1.0);
    one_perturbed(2, 0.1, 0.25);
    one_perturbed(2, 0.1, 0.0);
    one_perturbed(3, 0.25, 1.0);
    one_perturbed(3, 0.2, 0.5);
    one_perturbed(3, 0.25, 0.0);
}

/* Truth: the box around the ball has k = round(2r/spacing) cells per axis; a centre is inside when the odd or even integers
   (2i + 1 - k) have a sum of squares of at most (2r/h)^2 = k^2, for k cells of h = 2r/k. No sum of squares equals k^2 here:
   mod 4 (2D) and mod 8 (3D) they differ. So the count is exact at any scale. */
static void one_ball(int dim, double spacing, double radius, const double *centre) {
    peri_body *body = new_body(dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, 3.0 * spacing);
    const int k = (int)floor(2.0 * radius / spacing + 0.5), kz = dim == 3 ? k : 1;
    const double h = 2.0 * radius / k;
    int64_t count = 0, wrong = 0;
    const int64_t got = MUST(body, peri_add_ball(body, peri_id(body, PERI_KIND_MATERIAL, 1), centre, radius, spacing));
    double *p, *v, at[3];
    int i;
    MUST(body, peri_build(body));
    p = read_field(body, PERI_FIELD_POSITION);
    v = read_field(body, PERI_FIELD_VOLUME);
    for (i = 0; i < k * k * kz; ++i) {
        const int a = 2 * (i % k) + 1 - k, b = 2 * (i / k % k) + 1 - k, c = dim == 3 ? 2 * (i / k / k) + 1 - k : 0;
        if (a * a + b * b + c * c > k * k) continue;
        at[0] = centre[0] + 0.5 * a * h;
        at[1] = centre[1] + 0.5 * b * h;
        at[2] = centre[2] + 0.5 * c * h;
        if (count < got && distance(dim, at, p + count * dim) > 1e-9 * h) wrong++;
        if (count < got && fabs(v[count] / pow(h, dim) - 1.0) > 1e-12) wrong++;
        count++;
    }
    CHECK(got == count && peri_point_count(body) == count && wrong == 0);
    release();
}

static void balls(void) {
    static const double origin[3] = {0, 0, 0}, away[3] = {1e3, -250.0, 3.7};
    one_ball(2, 1.0, 3.5, origin);
    one_ball(2, 1.0, 5.0, away);
    one_ball(2, 1.0, 3.3, origin);
    one_ball(2, 1e-6, 10.5e-6, origin);
    one_ball(3, 1.0, 3.0, origin);
    one_ball(3, 1.0, 4.5, away);
    one_ball(3, 1e3, 4.1e3, origin);
}

typedef struct {
    int64_t calls, taken, wrong;
} shape_state;

static int in_ring(double x, double y) {
    const double r = hypot(x - 1.0, y - 0.5);
    return r > 0.3 && r < 0.9 && x < 1.4;
}

/* The sector of a ring; notes in which order the candidates come. */
static int32_t ring(void *user, int64_t index, const double *x) {
    shape_state *state = (shape_state *)user;
    const int32_t take = in_ring(x[0], x[1]);
    if (index != state->calls++) state->wrong++;
    state->taken += take;
    return take;
}

/* Truth: the candidates are the centres of the 20 x 10 cells, x fastest, and what the function takes is what is there. */
static void shapes(void) {
    static const double lo[2] = {0, 0}, hi[2] = {2, 1};
    shape_state state = {0, 0, 0};
    peri_body *body = new_body(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, 0.3);
    int64_t k, count = 0;
    double *p;
    CHECK(MUST(body, peri_add_shape(body, peri_id(body, PERI_KIND_MATERIAL, 1), lo, hi, 0.1, ring, &state)) == state.taken);
    MUST(body, peri_build(body));
    CHECK(state.wrong == 0);
    CHECK(state.calls == 200);
    p = read_field(body, PERI_FIELD_POSITION);
    for (k = 0; k < 200; ++k) {
        const double x = ((double)(k % 20) + 0.5) * 0.1, y = ((double)(k / 20) + 0.5) * 0.1;
        if (!in_ring(x, y)) continue;
        CHECK_NEAR(p[2 * count], x, 1e-13, 0.0);
        CHECK_NEAR(p[2 * count + 1], y, 1e-13, 0.0);
        count++;
    }
    CHECK(count == state.taken);
    release();
}

/* Truth: peri.h: 0 <= amount <= 1; a shape without a point is an error. Nothing is added. */
static void nothing_added(void) {
    static const double lo[2] = {5, 5}, hi[2] = {6, 6};
    shape_state state = {0, 0, 0};
    peri_body *body = new_body(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, 0.3);
    CHECK(peri_add_shape(body, peri_id(body, PERI_KIND_MATERIAL, 1), lo, hi, 0.1, ring, &state) == PERI_ERROR_EMPTY);
    CHECK(peri_add_perturbed_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), box_lo, box_hi, 0.1, 1.01, 1) == PERI_ERROR_RANGE);
    CHECK(peri_add_perturbed_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), box_lo, box_hi, 0.1, -0.1, 1) == PERI_ERROR_RANGE);
    CHECK(peri_add_perturbed_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), box_lo, box_hi, 0.1, nan(""), 1) == PERI_ERROR_RANGE);
    CHECK(peri_point_count(body) == 0);
    CHECK(peri_build(body) == PERI_ERROR_EMPTY);
    release();
}

/* ---- sets ---------------------------------------------------------------------------------------------------------- */

static int32_t odd_points(void *user, int64_t index, const double *x) {
    return index % 2 == 1 && x[0] > *(const double *)user;
}

/* The set must be exactly the points with want[i], ascending. */
static void check_set(peri_body *body, int32_t set, const int *want) {
    int32_t points[N_MAX];
    const int64_t n = peri_point_count(body), size = MUST(body, peri_size_of_set(body, set));
    int64_t i, k = 0;
    int wrong = 0;
    MUST(body, peri_get_set(body, set, points, N_MAX));
    for (i = 0; i < n; ++i)
        if (want[i]) {
            if (k >= size || points[k] != (int32_t)i) wrong++;
            k++;
        }
    CHECK(k == size);
    CHECK(wrong == 0);
    CHECK(size == 0 || peri_get_set(body, set, points, size - 1) == PERI_ERROR_CAPACITY);
}

/* Truth: integer comparisons on the lattice x = 2i + 1 (in half spacings). The faces of the box and of the ball run through
   points, which belong to the set. All at three scales, because the boundary's tolerance is relative to the spacing. */
static void sets(void) {
    static const double scale[3] = {1.0, 1e-9, 1e6};
    static const int32_t some[4] = {77, 3, 100, 42};
    int s;
    for (s = 0; s < 3; ++s) {
        const double dx = scale[s], lo[2] = {0, 0}, hi[2] = {12 * dx, 10 * dx};
        const double box[4] = {2.5 * dx, 1.5 * dx, 6.5 * dx, 3.4 * dx}, centre[2] = {5.5 * dx, 4.5 * dx};
        const double far_off[2] = {-50 * dx, 0};
        double limit = 2.0 * dx;
        peri_body *body = new_body(PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_DOUBLE, 3.0 * dx);
        int want[120], i;
        int32_t a, b, c, d;
        MUST(body, peri_add_box(body, peri_id(body, PERI_KIND_MATERIAL, 1), lo, hi, dx));
        CHECK(peri_select_box(body, "early", box, box + 2) == PERI_ERROR_ORDER);
        MUST(body, peri_build(body));
        a = peri_select_box(body, "box", box, box + 2);
        b = peri_select_ball(body, "ball", centre, 5.0 * dx);
        c = peri_select_if(body, NULL, odd_points, &limit);
        d = peri_select_points(body, "some", 4, some);
        for (i = 1; i <= 4; ++i) CHECK(peri_id(body, PERI_KIND_SET, i) == (i == 1 ? a : i == 2 ? b : i == 3 ? c : d));
        CHECK(PERI_ID_INDEX(a) == 1 && PERI_ID_INDEX(b) == 2 && PERI_ID_INDEX(c) == 3 && PERI_ID_INDEX(d) == 4);
        for (i = 0; i < 120; ++i) want[i] = i % 12 >= 2 && i % 12 <= 6 && i / 12 >= 1 && i / 12 <= 2;
        check_set(body, a, want);
        for (i = 0; i < 120; ++i) want[i] = (i % 12 - 5) * (i % 12 - 5) + (i / 12 - 4) * (i / 12 - 4) <= 25;
        check_set(body, b, want);
        for (i = 0; i < 120; ++i) want[i] = i % 2 == 1 && i % 12 >= 2;
        check_set(body, c, want);
        for (i = 0; i < 120; ++i) want[i] = i == 77 || i == 3 || i == 100 || i == 42;
        check_set(body, d, want);
        CHECK(peri_size_of_set(body, PERI_ALL) == 120);
        CHECK(peri_find_set(body, "box") == a && peri_find_set(body, "ball") == b && peri_find_set(body, "some") == d);
        CHECK(peri_find_set(body, "bo") == PERI_ERROR_NAME);
        CHECK(peri_select_box(body, "ball", box, box + 2) == PERI_ERROR_NAME); /* the name is taken */
        CHECK(peri_select_ball(body, "none", far_off, dx) == PERI_ERROR_EMPTY);
        CHECK(peri_find_set(body, "none") == PERI_ERROR_NAME);
        CHECK(peri_size_of_set(body, 99) == PERI_ERROR_ID_NONE && peri_size_of_set(body, -1) == PERI_ERROR_ID_NONE);
        release();
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(lattice_counts_2d);
    RUN(lattice_counts_3d);
    RUN(lattice_counts_3d_wide);
    LONG_RUN(lattice_counts_3d_all);
    RUN(horizon_tolerance);
    RUN(clouds);
    RUN(families_given);
    RUN(families_chosen);
    RUN(families_refused);
    RUN(perturbed_boxes);
    RUN(balls);
    RUN(shapes);
    RUN(nothing_added);
    RUN(sets);
    return test_end("test_families");
}
