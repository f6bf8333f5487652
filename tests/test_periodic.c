/* SPDX-License-Identifier: MIT */
/* test_periodic.c - periodic cells: a part whose ghosts are images of its own points; and what parts refuse.

   SOURCE OF TRUTH: Hooke's law holds of uniform strain to rounding, and waves have the frequency of the closed form of the discrete sum,
   rho omega^2 = sum_j K(xi_j) (1 - cos(k.xi_j)), K(xi) = c V xi xi/|xi|^3 for the linear bond-based law. A copy, a body that was reset and
   a body that was read have the bits of a body that was not. */
#include "pool.h"
#include "specimen.h"

static const int32_t laws[4] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE};

#define CELL 12
#define RIM  7 /* layers of images: two horizons of 3 spacings, and one more                                             */
#define WIDE (CELL + 2 * RIM)

static pool *memory_of_cells; /* NULL: malloc                                                                            */
static double critical_stretch;  /* of its bonds, where they break                                                      */
static peri_body *periodic(int32_t law, int32_t correction, int32_t *owned) {
    static int32_t ghosts[WIDE * WIDE], owners[WIDE * WIDE];
    const double h = 1.0 / 8, lo[2] = {0, 0}, hi[2] = {WIDE * h, WIDE * h};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, law, 0.2, h, 3, WIDE, WIDE, 0);
    peri_part_desc p;
    int64_t count = 0, own = 0;
    s.desc.geometry = PERI_GEOMETRY_LINEAR, s.desc.correction = correction;
    if (critical_stretch > 0) s.material.critical_stretch = critical_stretch;
    if (memory_of_cells) hook(&s.desc, memory_of_cells);
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, h));
    for (int32_t i = 0; i < WIDE * WIDE; ++i) {
        const int x = i % WIDE, y = i / WIDE, at = RIM + (x + CELL - RIM) % CELL, up = RIM + (y + CELL - RIM) % CELL;
        if (at == x && up == y) owned[own++] = i;
        else ghosts[count] = i, owners[count++] = at + WIDE * up;
    }
    peri_part_desc_init(&p), p.length = h, p.mean_volume = h * h;
    p.ghost_count = count, p.ghosts = ghosts, p.owners = owners;
    for (int64_t k = 0, status = PERI_ERROR_MEMORY; memory_of_cells && status == PERI_ERROR_MEMORY; ++k) { /* each allocation fails once */
        const int64_t blocks = memory_of_cells->blocks;
        memory_of_cells->fail_at = memory_of_cells->calls + k;
        status = peri_set_part(b, &p);
        CHECK(status == PERI_OK || (status == PERI_ERROR_MEMORY && memory_of_cells->blocks == blocks));
    }
    for (int64_t k = 0, status = PERI_ERROR_MEMORY; memory_of_cells && status == PERI_ERROR_MEMORY; ++k) {
        const int64_t blocks = memory_of_cells->blocks;
        memory_of_cells->fail_at = memory_of_cells->calls + k;
        status = peri_build(b);
        CHECK(status == PERI_OK || (status == PERI_ERROR_MEMORY && memory_of_cells->blocks == blocks));
    }
    if (memory_of_cells) return b;
    MUST(b, peri_set_part(b, &p));
    MUST(b, peri_build(b));
    return b;
}

/* With weights whose fourth moments are isotropic the energy of any uniform strain is that of Hooke's law, and no point feels a force, as
   there is no surface. */
static void cells_have_no_surface(void) {
    const double strain[4] = {2e-3, 1e-3, 1e-3, -1e-3}, h = 1.0 / 8;
    int32_t owned[CELL * CELL];
    for (int law = 0; law < 4; ++law) {
        static double u[WIDE * WIDE * 2], f[WIDE * WIDE * 2], x[WIDE * WIDE * 2];
        const double nu = law ? 0.2 : 0.25, mu = 0.5 / (1 + nu), lambda = 2 * mu * nu / (1 - 2 * nu); /* bond-based: fixed */
        peri_energy energy;
        peri_body *b = periodic(laws[law], PERI_CORRECTION_MOMENT, owned);
        MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, WIDE * WIDE * 2));
        MUST(b, peri_set_mean_gradient(b, strain));
        memset(u, 0, sizeof u);
        for (int k = 0; k < CELL * CELL; ++k)
            for (int d = 0; d < 2; ++d)
                u[2 * owned[k] + d] = strain[2 * d] * x[2 * owned[k]] + strain[2 * d + 1] * x[2 * owned[k] + 1];
        MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, WIDE * WIDE * 2));
        MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, WIDE * WIDE * 2));
        for (int k = 0; k < CELL * CELL; ++k)
            for (int d = 0; d < 2; ++d) CHECK_NEAR(f[2 * owned[k] + d], 0, 0, 1e-13);
        MUST(b, peri_get_energy(b, &energy));
        const double trace = strain[0] + strain[3], square = strain[0] * strain[0] + strain[3] * strain[3] + 2 * strain[1] * strain[2];
        const double hooke = (0.5 * lambda * trace * trace + mu * square) * CELL * CELL * h * h;
        CHECK_NEAR(energy.elastic, hooke, 1e-10, 0);
        peri_body_destroy(b);
    }
}

static void waves_in_cells_disperse(void) {
    const double h = 1.0 / 8, k = 2 * 3.14159265358979323846 * 2 / (CELL * h), a = 1e-6;
    static double u[WIDE * WIDE * 2], f[WIDE * WIDE * 2], x[WIDE * WIDE * 2], moved[WIDE * WIDE * 2];
    const double strain[4] = {2e-7, 1e-7, 1e-7, -1e-7};
    int32_t owned[CELL * CELL];
    double c = 0, s0, sum = 0;
    peri_evaluate_desc e;
    peri_body *b = periodic(PERI_LAW_BOND_BASED, PERI_CORRECTION_NONE, owned);
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
    MUST(b, peri_get_bond_constants(b, material, material, &c, &s0));
    for (int p = -3; p <= 3; ++p)
        for (int q = -3; q <= 3; ++q) {
            const double r = h * sqrt(p * p + q * q);
            if (p * p + q * q > 0 && p * p + q * q <= 9) sum += c * h * h * (p * h) * (p * h) / (r * r * r) * (1 - cos(k * p * h));
        }
    MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, WIDE * WIDE * 2));
    memset(u, 0, sizeof u);
    for (int n = 0; n < CELL * CELL; ++n) u[2 * owned[n]] = a * sin(k * x[2 * owned[n]]);
    MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, WIDE * WIDE * 2));
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, WIDE * WIDE * 2));
    for (int n = 0; n < CELL * CELL; ++n) CHECK_NEAR(f[2 * owned[n]], -sum * u[2 * owned[n]], 0, 1e-10 * sum * a);
    memset(f, 0, sizeof f);
    MUST(b, peri_set_mean_gradient(b, strain)); /* of which the tangent, and the force of a wave on top of it, know nothing */
    MUST(b, peri_multiply_stiffness(b, u, f, WIDE * WIDE * 2));
    for (int n = 0; n < CELL * CELL; ++n) CHECK_NEAR(f[2 * owned[n]], h * h * sum * u[2 * owned[n]], 0, 1e-10 * h * h * sum * a);
    for (int n = 0; n < CELL * CELL; ++n)
        for (int d = 0; d < 2; ++d) {
            const double *at = x + 2 * owned[n];
            moved[2 * owned[n] + d] = u[2 * owned[n] + d] + strain[2 * d] * at[0] + strain[2 * d + 1] * at[1];
        }
    peri_evaluate_desc_init(&e), e.displacement = moved, e.force = f;
    MUST(b, peri_evaluate(b, &e, NULL));
    for (int n = 0; n < CELL * CELL; ++n) CHECK_NEAR(f[2 * owned[n]], -sum * u[2 * owned[n]], 0, 1e-10 * sum * a);
    peri_body_destroy(b);
}

/* A clone goes on as its body, and so does a body that was reset; all memory is counted, and given back. */
static void cells_live_as_bodies_do(void) {
    static double u[3][WIDE * WIDE * 2];
    const double strain[4] = {2e-3, 1e-3, 1e-3, -1e-3}, v[2] = {0.1, 0.02};
    int32_t owned[CELL * CELL];
    pool memory = {0, 0, 0, 0, -1, 0};
    peri_memory held;
    peri_advance_desc a;
    peri_body *copy = NULL;
    memory_of_cells = &memory;
    peri_body *b = periodic(PERI_LAW_LPS, PERI_CORRECTION_NONE, owned);
    memory_of_cells = NULL, memory.fail_at = -1;
    MUST(b, peri_get_memory(b, &held));
    CHECK(held.total == memory.bytes);
    const int32_t set = (int32_t)MUST(b, peri_select_points(b, NULL, CELL, owned));
    peri_advance_desc_init(&a), a.steps = 10;
    for (int k = 0; k < 3; ++k) {
        peri_body *own = k == 1 ? copy : b;
        if (k == 0) MUST(b, peri_body_clone(b, &copy, NULL));
        if (k == 2) MUST(b, peri_reset(b));
        MUST(own, peri_set_mean_gradient(own, strain));
        MUST(own, peri_add_velocity(own, set, v));
        MUST(own, peri_advance(own, &a));
        MUST(own, peri_get_field(own, PERI_FIELD_DISPLACEMENT, u[k], WIDE * WIDE * 2));
    }
    CHECK(memcmp(u[0], u[1], sizeof u[0]) == 0 && memcmp(u[0], u[2], sizeof u[0]) == 0);
    peri_body_destroy(b), peri_body_destroy(copy);
    CHECK(memory.blocks == 0 && memory.bytes == 0 && memory.wrong == 0);
}

/* ---- what is refused -------------------------------------------------------------------------------------------------- */

static void refused(int32_t status, int64_t got) { CHECK(got == status); }

static void parts_refuse_what_they_cannot(void) {
    static double many[WIDE * WIDE * 4];
    int32_t owned[CELL * CELL], ghosts[2] = {3, 2}, owners[2] = {9, 9};
    int64_t ids[WIDE * WIDE] = {0};
    const double lo[2] = {0, 0}, hi[2] = {1, 1}, huge[4] = {1, 2, 3, 1e9};
    const int32_t first[2] = {0, 0}, last[2] = {4, 9};
    peri_part_desc p;
    peri_solve_desc solve;
    peri_solve_report report;
    peri_advance_desc advance;
    peri_matrix *matrix = NULL;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_LPS, 0.2, 0.125, 3, 8, 8, 0);
    peri_body *b = specimen_start(&s);
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
    peri_part_desc_init(&p), p.length = 1, p.mean_volume = 1;
    refused(PERI_ERROR_EMPTY, peri_set_part(b, &p));
    refused(PERI_ERROR_RANGE, peri_add_box_part(b, material, lo, hi, 0.125, first, last));
    MUST(b, peri_add_box(b, material, lo, hi, 0.125));
    refused(PERI_ERROR_ARGUMENT, peri_set_part(NULL, &p));
    refused(PERI_ERROR_ARGUMENT, peri_set_part(b, NULL));
    p.ghost_count = 64, refused(PERI_ERROR_RANGE, peri_set_part(b, &p));
    p.ghost_count = 2, refused(PERI_ERROR_ARGUMENT, peri_set_part(b, &p));
    p.ghosts = ghosts, refused(PERI_ERROR_INDEX, peri_set_part(b, &p));
    ghosts[1] = 9, p.owners = owners, refused(PERI_ERROR_INDEX, peri_set_part(b, &p));
    owners[0] = owners[1] = -1, refused(PERI_ERROR_ARGUMENT, peri_set_part(b, &p));
    owners[0] = owners[1] = 8, p.ids = ids, refused(PERI_ERROR_INDEX, peri_set_part(b, &p));
    p.ids = NULL, p.length = 0, refused(PERI_ERROR_RANGE, peri_set_part(b, &p));
    p.length = 1e3, refused(PERI_ERROR_RANGE, peri_set_part(b, &p));
    p.length = 1, p.mean_volume = NAN, refused(PERI_ERROR_RANGE, peri_set_part(b, &p));
    p.mean_volume = 1, p.cookie++, refused(PERI_ERROR_DESCRIPTOR, peri_set_part(b, &p));
    CHECK(peri_ghost_depth(b) == 2 && peri_ghost_depth(NULL) == PERI_ERROR_ARGUMENT);
    peri_body_destroy(b);

    b = periodic(PERI_LAW_LPS, PERI_CORRECTION_NONE, owned);
    peri_solve_desc_init(&solve), peri_advance_desc_init(&advance), advance.steps = 1, advance.time_step = 1;
    refused(PERI_ERROR_PART, peri_solve(b, &solve, &report));
    refused(PERI_ERROR_PART, peri_advance_implicit(b, &advance, NULL, 1, NULL));
    refused(PERI_ERROR_PART, peri_matrix_create(b, &matrix));
    refused(PERI_ERROR_PART, peri_find_fragments(b, NULL, 0));
    refused(PERI_ERROR_PART, peri_set_field(b, PERI_FIELD_STIFFNESS, many, WIDE * WIDE));
    refused(PERI_ERROR_PART, peri_set_contact(b, PERI_ALL, PERI_ALL, NULL));
    refused(PERI_ERROR_PART, peri_save_state(b, "build/part.state"));
    refused(PERI_ERROR_ARGUMENT, peri_set_mean_gradient(b, NULL));
    refused(PERI_ERROR_RANGE, peri_set_mean_gradient(b, huge));
    peri_body_destroy(b);
}

static int32_t read_energy(void *user, double time, int64_t count, const int32_t *points, double *value) {
    peri_energy e;
    (void)time, (void)count, (void)points, (void)value;
    return peri_get_energy((peri_body *)user, &e) < 0 ? -1 : 0;
}

/* What a load reads changes nothing; a field of bonds is the same whatever was read before; after a reset, under the mean strain that
   stays, the ledger is closed. */
static void cells_do_not_feel_readers(void) {
    static double u[2][WIDE * WIDE * 2], strain[2][WIDE * WIDE * 3], f[WIDE * WIDE * 2];
    const double mean[4] = {2e-3, 1e-3, 1e-3, -1e-3}, v[2] = {3, 0.02}, none[2] = {0, 0};
    int64_t broken[2];
    critical_stretch = 0.1;
    for (int k = 0; k < 2; ++k) {
        int32_t owned[CELL * CELL];
        peri_energy e;
        peri_advance_desc a;
        peri_body *b = periodic(PERI_LAW_BOND_BASED, PERI_CORRECTION_NONE, owned);
        const int32_t set = (int32_t)MUST(b, peri_select_points(b, NULL, 3, owned));
        MUST(b, peri_set_mean_gradient(b, mean));
        if (k) MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, WIDE * WIDE * 2));
        MUST(b, peri_get_field(b, PERI_FIELD_STRAIN, strain[k], WIDE * WIDE * 3));
        MUST(b, peri_add_velocity(b, set, v));
        MUST(b, peri_apply_body_force(b, set, none, k ? read_energy : NULL, k ? b : NULL));
        peri_advance_desc_init(&a), a.steps = 10;
        MUST(b, peri_advance(b, &a));
        MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u[k], WIDE * WIDE * 2));
        broken[k] = peri_broken_count(b);
        MUST(b, peri_reset(b));
        MUST(b, peri_get_energy(b, &e));
        CHECK(e.elastic > 0 && fabs(e.error) <= 1e-12 * e.elastic);
        peri_body_destroy(b);
    }
    critical_stretch = 0;
    printf("    %ld bonds broken\n", (long)broken[0]);
    CHECK(broken[0] > 0 && broken[0] == broken[1]);
    CHECK(memcmp(u[0], u[1], sizeof u[0]) == 0 && memcmp(strain[0], strain[1], sizeof strain[0]) == 0);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(cells_have_no_surface);
    RUN(waves_in_cells_disperse);
    RUN(cells_live_as_bodies_do);
    RUN(parts_refuse_what_they_cannot);
    RUN(cells_do_not_feel_readers);
    return test_end("test_periodic");
}
