/* SPDX-License-Identifier: MIT */
/* test_promises.c - sentences of docs/manual.md on descriptors, arrays, ids and records that no other test is about. tests/promises says
   which sentence each case proves. SOURCE OF TRUTH: that sentence, quoted before each case; where a number follows from it, arithmetic. */
#include "refusal.h"

static const double lo3[3] = {0, 0, 0};

/* A box of unit cells from the origin, horizon 2.1, unit modulus and density, one material. */
static specimen box_of(int32_t space, int32_t law, int nx, int ny, int nz) { return specimen_of(space, law, 0.2, 1, 2.1, nx, ny, nz); }
static peri_body *plate(int nx, int ny) {
    const specimen s = box_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, nx, ny, 1);
    return specimen_make(&s);
}
static peri_error record_of(const peri_body *b) {
    peri_error e;
    memset(&e, 0x55, sizeof e);
    CHECK(peri_get_error(b, &e) == PERI_OK);
    return e;
}

/* ---- versions and descriptors -------------------------------------------------------------------------------------- */

/* "PERI_VERSION and PERI_VERSION_NUMBER are those of the header, peri_version gives that of the implementation"; "major * 1,000,000 + minor
   * 1,000 + patch. PERI_VERSION is the text." */
static void versions(void) {
    int major = -1, minor = -1, patch = -1;
    CHECK(sscanf(PERI_VERSION, "%d.%d.%d", &major, &minor, &patch) == 3);
    CHECK(PERI_VERSION_NUMBER == major * 1000000 + minor * 1000 + patch && peri_version() == PERI_VERSION_NUMBER);
}

/* "described: materials, points, peri_build, constants of bonds, peri_get_memory [are allowed]; all that needs points, families or a state
   [is refused], field peri_build"; "peri_body_create: the body is empty"; "peri_point_count counts the points added so far before
   peri_build, too"; "peri_dimension: 2 or 3"; "peri_kernel_text: "" before peri_build". */
static void described_bodies(void) {
    const double hi[3] = {4, 3, 2}, v[3] = {1, 0, 0};
    const int32_t pair[2] = {0, 1};
    double out[64], c, s0;
    int32_t ints[64];
    int64_t count = 0;
    for (int32_t space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space) {
        const int dim = dim_of(space);
        const specimen s = box_of(space, PERI_LAW_BOND_BASED, 4, 3, 2);
        peri_body *b = NULL, *copy = NULL;
        peri_memory m;
        peri_energy e;
        peri_view view;
        peri_matrix *matrix = NULL;
        MUST(NULL, peri_body_create(&s.desc, &b, NULL));
        CHECK(peri_dimension(b) == dim && peri_point_count(b) == 0 && peri_id(b, PERI_KIND_MATERIAL, 1) == PERI_ERROR_ID_GONE);
        const int32_t id = (int32_t)MUST(b, peri_add_material(b, &s.material));
        count = MUST(b, peri_add_box(b, id, lo3, hi, 1));
        CHECK(count == (dim == 3 ? 24 : 12) && peri_point_count(b) == count);
        CHECK(peri_add_ball(b, id, (const double[3]){20, 0, 0}, 1.0, 1) > 0 && peri_point_count(b) > count);
        CHECK(peri_get_memory(b, &m) == PERI_OK && m.points > 0);
        CHECK(peri_get_bond_constants(b, id, id, &c, &s0) == PERI_OK && c > 0);
        CHECK(peri_family_width(b) == 0 && peri_bond_count(b) == 0 && peri_stable_step(b) == 0 && peri_kernel_text(b)[0] == 0);
        peri_advance_desc a;
        peri_solve_desc st;
        peri_advance_desc_init(&a);
        a.steps = 1;
        peri_solve_desc_init(&st);
#define NOT_YET(call)                                                                                                  \
    do {                                                                                                               \
        REFUSE(b, PERI_ERROR_ORDER, call);                                                                             \
        CHECK(strcmp(seen.field, "peri_build") == 0 && seen.value == 0);                                               \
    } while (0)
        NOT_YET(peri_get_families(b, 0, 1, ints, 64));
        NOT_YET(peri_bond_is_intact(b, 0, 1));
        NOT_YET(peri_reset(b));
        NOT_YET(peri_select_box(b, NULL, lo3, hi));
        NOT_YET(peri_select_ball(b, NULL, lo3, 9));
        NOT_YET(peri_select_if(b, NULL, take_left, NULL));
        NOT_YET(peri_select_points(b, NULL, 2, pair));
        NOT_YET(peri_size_of_set(b, PERI_ALL));
        NOT_YET(peri_get_set(b, PERI_ALL, ints, 64));
        if (dim == 2) NOT_YET(peri_cut_segment(b, PERI_CUT_INITIAL, lo3, hi));
        else NOT_YET(peri_cut_disc(b, PERI_CUT_INITIAL, lo3, hi, 1));
        NOT_YET(peri_cut_pairs(b, PERI_CUT_INITIAL, 1, pair));
        NOT_YET(peri_set_no_fail(b, PERI_ALL, 1));
        NOT_YET(peri_on_break(b, NULL, NULL));
        NOT_YET(peri_add_displacement(b, PERI_ALL, v));
        NOT_YET(peri_add_velocity(b, PERI_ALL, v));
        NOT_YET(peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_X, NULL, NULL, NULL));
        NOT_YET(peri_prescribe_velocity(b, PERI_ALL, PERI_AXIS_X, NULL, NULL, NULL));
        NOT_YET(peri_apply_body_force(b, PERI_ALL, v, NULL, NULL));
        NOT_YET(peri_apply_traction(b, PERI_ALL, 1, v, v, NULL, NULL));
        NOT_YET(peri_apply_layer_traction(b, PERI_ALL, 1, v, NULL, NULL));
        NOT_YET(peri_apply_pressure(b, PERI_ALL, 1, NULL, NULL));
        NOT_YET(peri_apply_bond_pressure_for_comparison(b, PERI_ALL, 1, NULL, NULL));
        NOT_YET(plane_obstacle(b, lo3, v, 0, NULL, NULL));
        NOT_YET(ball_obstacle(b, lo3, 1, 0, NULL, NULL));
        NOT_YET(peri_advance(b, &a));
        NOT_YET(peri_solve(b, &st, NULL));
        NOT_YET(peri_multiply_stiffness(b, out, out, 64));
        NOT_YET(peri_matrix_create(b, &matrix));
        NOT_YET(peri_size_of_field(b, PERI_FIELD_POSITION));
        NOT_YET(peri_get_field(b, PERI_FIELD_POSITION, out, 64));
        NOT_YET(peri_set_field(b, PERI_FIELD_VELOCITY, out, 64));
        NOT_YET(peri_view_field(b, PERI_FIELD_POSITION, &view));
        NOT_YET(peri_get_energy(b, &e));
        NOT_YET(peri_get_momentum(b, out, NULL));
        NOT_YET(peri_export_vtu_to(b, write_nothing, b));
        NOT_YET(peri_export_history_to(b, 1, write_nothing, b));
        CHECK(peri_body_clone(b, &copy, &seen) == PERI_ERROR_ORDER && copy == NULL && strcmp(seen.field, "peri_build") == 0);
        peri_body_destroy(b);
    }
}

/* "peri_body_desc_init, like all functions of this kind, fills every field with its default and ignores NULL. Fields that the header marks
   as required have no default": what is missing is refused by its name. Defaults: peri.h. */
static void defaults(void) {
    peri_body_desc d;
    peri_material_desc m;
    peri_advance_desc a;
    peri_solve_desc s;
    peri_plan_desc p;
    peri_choose_desc c;
    peri_plan_report report;
    peri_choose_report choice;
    peri_body *b = NULL;
    peri_body_desc_init(NULL);
    peri_material_desc_init(NULL, PERI_LAW_LPS);
    peri_advance_desc_init(NULL);
    peri_solve_desc_init(NULL);
    peri_plan_desc_init(NULL);
    peri_choose_desc_init(NULL);
    memset(&d, 0x5A, sizeof d);
    memset(&m, 0x5A, sizeof m);
    memset(&a, 0x5A, sizeof a);
    memset(&s, 0x5A, sizeof s);
    memset(&p, 0x5A, sizeof p);
    memset(&c, 0x5A, sizeof c);
    peri_body_desc_init(&d);
    CHECK(d.precision == PERI_PRECISION_DOUBLE && d.geometry == PERI_GEOMETRY_NONLINEAR && d.influence == PERI_INFLUENCE_CONSTANT);
    CHECK(d.quadrature == PERI_QUADRATURE_FULL && d.correction == PERI_CORRECTION_NONE && d.break_timing == PERI_BREAK_WITHIN_STEP);
    CHECK(d.kernel == PERI_KERNEL_BEST && d.instructions == PERI_INSTRUCTIONS_BEST && d.threads == 0 && d.ledger == 1 && d.number == 0);
    CHECK(d.moments == PERI_MOMENTS_LIVE && d.reserved == 0);
    CHECK(d.thickness == 1 && !d.influence_fn && !d.influence_user && !d.allocate && !d.release && !d.memory_user);
    CHECK(!d.parallel_for && !d.parallel_user && !d.log && !d.log_user);
    peri_material_desc_init(&m, PERI_LAW_CORRESPONDENCE);
    CHECK(m.law == PERI_LAW_CORRESPONDENCE && m.criterion == PERI_CRITERION_STRETCH && m.young == 0 && m.bulk == 0);
    CHECK(m.poisson != m.poisson && m.fracture_energy == 0 && m.critical_stretch == 0 && m.stabilization == 0.2);
    peri_advance_desc_init(&a);
    CHECK(a.integrator == PERI_INTEGRATOR_VELOCITY_VERLET && a.force_step == 0 && a.time_step == 0 && a.safety == 0.9 && a.damping == 0);
    CHECK(a.load_factor != a.load_factor && a.frame_steps == 0 && !a.on_frame && !a.user);
    peri_solve_desc_init(&s);
    CHECK(s.method == PERI_METHOD_NEWTON && s.preconditioner == PERI_PRECONDITIONER_MULTILEVEL && s.loose == PERI_LOOSE_REFUSED);
    CHECK(s.fracture == 1 && s.criticality == 0.98 && s.control == PERI_CONTROL_LOAD && s.tolerance == 0 && s.energy_tolerance == 0);
    CHECK(s.iterations == 20000 && s.newton == 60);
    CHECK(s.breaks == 100000 && s.load_from != s.load_from && s.load_to == 1 && s.steps == 1 && s.halvings == 8 && s.curve_load == 0);
    CHECK(!s.curve && s.curve_rows == 0 && !s.on_iteration && !s.on_step && !s.user);
    peri_plan_desc_init(&p);
    CHECK(!p.body && !p.material && p.source == PERI_SOURCE_BOX && p.measure == 0 && p.amount == 1);
    peri_choose_desc_init(&c);
    CHECK(c.preset == PERI_PRESET_NONE && c.error == 0 && c.seconds == 0 && c.bytes == 0);
    /* what is required, one after the other */
#define REQUIRED(code, name, call) CHECK((call) == (code) && strcmp(seen.field, name) == 0)
    REQUIRED(PERI_ERROR_CHOICE, "space", peri_body_create(&d, &b, &seen));
    d.space = PERI_SPACE_PLANE_STRESS;
    REQUIRED(PERI_ERROR_RANGE, "horizon", peri_body_create(&d, &b, &seen));
    d.horizon = 2.1;
    MUST(NULL, peri_body_create(&d, &b, NULL));
    REFUSE(b, PERI_ERROR_RANGE, peri_add_material(b, &m));
    FIELD_IS("density");
    m.density = 1;
    REFUSE(b, PERI_ERROR_MATERIAL, peri_add_material(b, &m));
    FIELD_IS("bulk");
    m.young = 1;
    REFUSE(b, PERI_ERROR_RANGE, peri_add_material(b, &m));
    FIELD_IS("poisson");
    m.poisson = 0.2;
    MUST(b, peri_add_box(b, (int32_t)MUST(b, peri_add_material(b, &m)), lo3, (const double[2]){4, 4}, 1));
    MUST(b, peri_build(b));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_advance(b, &a));
    FIELD_IS("duration");
    peri_body_destroy(b);
    REQUIRED(PERI_ERROR_ARGUMENT, "body", peri_plan(&p, &report, &seen));
    p.body = &d;
    REQUIRED(PERI_ERROR_ARGUMENT, "material", peri_plan(&p, &report, &seen));
    p.material = &m;
    REQUIRED(PERI_ERROR_RANGE, "spacing", peri_plan(&p, &report, &seen));
    p.spacing = 1;
    REQUIRED(PERI_ERROR_RANGE, "hi", peri_plan(&p, &report, &seen));
    c.preset = PERI_PRESET_GAME;
    REQUIRED(PERI_ERROR_CHOICE, "quantity", peri_choose(&c, &d, &m, &choice, &seen));
    c.quantity = PERI_QUANTITY_DEFORMATION;
    REQUIRED(PERI_ERROR_RANGE, "feature", peri_choose(&c, &d, &m, &choice, &seen));
    c.feature = 1;
    REQUIRED(PERI_ERROR_RANGE, "hi", peri_choose(&c, &d, &m, &choice, &seen));
}

/* README.md: "four laws, nine failure criteria", "15 influence functions or yours; five quadratures". */
static void choices_are_counted(void) {
    CHECK(peri__count_law == 4 && peri__count_criterion == 9 && peri__count_influence == 15 + 1 && peri__count_quadrature == 5);
    CHECK(peri__count_space == 3 && peri__count_precision == 3 && peri__count_geometry == 2 && peri__count_integrator == 2);
}

/* ---- arrays -------------------------------------------------------------------------------------------------------- */

/* "Vectors are interleaved: x0 y0 x1 y1 ... in 2D, x0 y0 z0 x1 ... in 3D. lo for one place or vector has as many entries as the space has
   dimensions": the centres of the cells of a box, and a block that ends with the last entry. */
static void vectors_are_interleaved(void) {
    for (int dim = 2; dim <= 3; ++dim) {
        const specimen s = box_of(dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 3, 2, 2);
        peri_body *b = specimen_make(&s);
        double *x = get(b, PERI_FIELD_POSITION), *v, *one = (double *)malloc((size_t)dim * sizeof *one), *two;
        for (int64_t i = 0; i < peri_point_count(b); ++i) {
            const double at[3] = {0.5 + (double)(i % 3), 0.5 + (double)(i / 3 % 2), 0.5 + (double)(i / 6)};
            for (int d = 0; d < dim; ++d) CHECK(fabs(x[i * dim + d] - at[d]) < 1e-14);
        }
        for (int d = 0; d < dim; ++d) one[d] = d + 1;
        MUST(b, peri_add_velocity(b, PERI_ALL, one));
        v = get(b, PERI_FIELD_VELOCITY);
        for (int64_t i = 0; i < peri_point_count(b) * dim; ++i) CHECK(fabs(v[i] - (double)(i % dim + 1)) < 1e-14);
        two = (double *)malloc((size_t)dim * sizeof *two);
        for (int d = 0; d < dim; ++d) one[d] = 0, two[d] = 1;
        CHECK(peri_size_of_set(b, peri_select_box(b, NULL, one, two)) == 1);
        free(x);
        free(v);
        free(one);
        free(two);
        peri_body_destroy(b);
    }
}

/* "You own what you pass in: descriptors and arrays are copied": a life from arrays that are overwritten after each call. */
static double *life_of_copies(int spoil, int64_t *count) {
    double x[12 * 2], volume[12], point[2] = {0, 0}, hi[2] = {2, 2}, vertices[6] = {1, -1, 1, 0.5, 1, 1}, v[2] = {0.02, 0.01};
    int32_t ids[12], pairs[2] = {10, 11}, chosen[3] = {3, 1, 3}, rows[16 * 8];
    char name[8] = "chosen";
    peri_body_desc d;
    peri_material_desc m;
    peri_advance_desc a;
    peri_body *b = NULL;
#define SPOIL(what) do { if (spoil) memset(&(what), 0x7F, sizeof(what)); } while (0)
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 1.5;
    MUST(NULL, peri_body_create(&d, &b, NULL));
    SPOIL(d);
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = m.density = 1;
    m.critical_stretch = 0.01;
    const int32_t material = (int32_t)MUST(b, peri_add_material(b, &m));
    SPOIL(m);
    MUST(b, peri_add_box(b, material, point, hi, 1));
    SPOIL(point);
    SPOIL(hi);
    for (int k = 0; k < 12; ++k) x[2 * k] = 2.5 + k % 6, x[2 * k + 1] = 0.5 + k / 6, volume[k] = 1, ids[k] = material;
    MUST(b, peri_add_points(b, 12, x, volume, ids));
    SPOIL(x);
    SPOIL(volume);
    SPOIL(ids);
    for (int i = 0; i < 16; ++i) { /* all within 1.5 spacings: 4 of the box, then two rows of six */
        const int xi = i < 4 ? i % 2 : 2 + (i - 4) % 6, yi = i < 4 ? i / 2 : (i - 4) / 6;
        int k = 0;
        for (int j = 0; j < 16; ++j) {
            const int xj = j < 4 ? j % 2 : 2 + (j - 4) % 6, yj = j < 4 ? j / 2 : (j - 4) / 6;
            if (j != i && (xi - xj) * (xi - xj) + (yi - yj) * (yi - yj) <= 2) rows[8 * i + k++] = j;
        }
        for (; k < 8; ++k) rows[8 * i + k] = i;
    }
    MUST(b, peri_set_families(b, 8, rows));
    SPOIL(rows);
    MUST(b, peri_build(b));
    const int32_t set = (int32_t)MUST(b, peri_select_points(b, name, 3, chosen));
    SPOIL(name);
    SPOIL(chosen);
    CHECK(peri_find_set(b, "chosen") == set && peri_size_of_set(b, set) == 2);
    MUST(b, peri_cut_polyline(b, PERI_CUT_INITIAL, 3, vertices));
    SPOIL(vertices);
    MUST(b, peri_cut_pairs(b, PERI_CUT_INITIAL, 1, pairs));
    SPOIL(pairs);
    MUST(b, peri_prescribe_velocity(b, set, PERI_AXIS_XY, v, NULL, NULL));
    MUST(b, peri_apply_body_force(b, PERI_ALL, v, NULL, NULL));
    SPOIL(v);
    peri_advance_desc_init(&a);
    a.steps = 40;
    MUST(b, peri_advance(b, &a));
    CHECK(peri_cut_count(b) > 1 && peri_broken_count(b) > 0);
    double *u = get(b, PERI_FIELD_DISPLACEMENT);
    *count = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
    peri_body_destroy(b);
    return u;
}
static void arrays_are_copied(void) {
    int64_t n[2] = {0, 0};
    double *kept = life_of_copies(0, &n[0]), *spoilt = life_of_copies(1, &n[1]);
    CHECK(n[0] == 32 && n[0] == n[1] && memcmp(kept, spoilt, (size_t)n[0] * sizeof *kept) == 0 && largest(kept, n[0]) > 0);
    free(kept);
    free(spoilt);
}

/* "In plane stress and plane strain the volume of a point is its area"; forces, masses and momenta include the thickness: mass by the
   momentum at unit velocity. "thickness: of plane bodies; ignored in 3D". */
static void volumes_of_planes_are_areas(void) {
    for (int32_t space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space) {
        specimen s = box_of(space, PERI_LAW_BOND_BASED, 4, 3, 2);
        const double along[3] = {1, 0, 0}, want = space == PERI_SPACE_SOLID ? 24 : 12 * 7;
        double momentum[3];
        s.desc.thickness = 7;
        peri_body *b = specimen_make(&s);
        double *volume = get(b, PERI_FIELD_VOLUME);
        for (int64_t i = 0; i < peri_point_count(b); ++i) CHECK_NEAR(volume[i], 1, 1e-14, 0);
        MUST(b, peri_add_velocity(b, PERI_ALL, along));
        MUST(b, peri_get_momentum(b, momentum, NULL));
        CHECK_NEAR(momentum[0], want, 1e-13, 0);
        free(volume);
        peri_body_destroy(b);
    }
}
static void thickness_of_solids(void) {
    double *f[2];
    for (int k = 0; k < 2; ++k) {
        specimen s = box_of(PERI_SPACE_SOLID, PERI_LAW_LPS, 4, 3, 3);
        s.desc.thickness = k ? 7 : 1;
        peri_body *b = specimen_make(&s);
        double *u = random_field(108, 0.01, 3);
        put(b, PERI_FIELD_DISPLACEMENT, u);
        f[k] = get(b, PERI_FIELD_FORCE_DENSITY);
        free(u);
        peri_body_destroy(b);
    }
    CHECK(memcmp(f[0], f[1], 108 * sizeof(double)) == 0 && largest(f[0], 108) > 0);
    free(f[0]);
    free(f[1]);
}

/* "Points are numbered from 0 in the order in which they were added"; "your numbering stays, whatever order the library uses inside": a
   cloud given in a scattered order, after a box, is worked on by place. */
static void points_are_numbered_as_added(void) {
    enum { CLOUD = 900 };
    static double x[2 * CLOUD], volume[CLOUD];
    const double hi[2] = {5, 4};
    const specimen s = box_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 5, 4, 1);
    peri_body *b = specimen_start(&s);
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
    for (int k = 0; k < CLOUD; ++k) {
        const int at = k * 389 % CLOUD; /* 389 and 900 have no common factor: each place once */
        x[2 * k] = 10.5 + at % 30;
        x[2 * k + 1] = 0.5 + at / 30;
        volume[k] = 1 + at * 1e-5;
    }
    CHECK(MUST(b, peri_add_points(b, CLOUD, x, volume, NULL)) == CLOUD && MUST(b, peri_add_box(b, material, lo3, hi, 1)) == 20);
    MUST(b, peri_build(b));
    double *seen_x = get(b, PERI_FIELD_POSITION), *seen_v = get(b, PERI_FIELD_VOLUME);
    for (int k = 0; k < CLOUD; ++k) {
        CHECK_NEAR(seen_x[2 * k], x[2 * k], 1e-14, 0);
        CHECK_NEAR(seen_x[2 * k + 1], x[2 * k + 1], 1e-14, 0);
        CHECK_NEAR(seen_v[k], volume[k], 1e-14, 0);
    }
    for (int k = 0; k < 20; ++k) CHECK(fabs(seen_x[2 * (CLOUD + k)] - (0.5 + k % 5)) < 1e-13);
    free(seen_x);
    free(seen_v);
    peri_body_destroy(b);
}

/* ---- ids ----------------------------------------------------------------------------------------------------------- */

/* "bit 31: 0 | 30 .. 27: kind | 26 .. 20: number of the body | 19 .. 0: 1, 2, 3, ... in the order in which they were given", "with the
   kind 1 of materials, 2 of sets, 3 of loads, 4 of obstacles"; PERI_ID_INDEX gives the last part; the middle part is `number`, or is made
   from the address: "two bodies that live at the same time then mostly differ". */
static void layout_of_ids(void) {
    const double v[2] = {1, 0}, hi[2] = {9, 9}, far_[2] = {-9, -9};
    specimen s = box_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 4, 3, 1);
    peri_body *many[32];
    int same = 0;
    for (int32_t number = 1; number <= 127; number += 63) {
        int32_t id[4][3], load;
        s.desc.number = number;
        peri_body *b = specimen_start(&s);
        const int32_t first = peri_id(b, PERI_KIND_MATERIAL, 1), second = (int32_t)MUST(b, peri_add_material(b, &s.material));
        id[0][0] = first, id[0][1] = second, id[0][2] = (int32_t)MUST(b, peri_add_material(b, &s.material));
        MUST(b, peri_add_box(b, second, s.lo, s.hi, 1));
        MUST(b, peri_build(b));
        for (int k = 0; k < 3; ++k) {
            id[1][k] = (int32_t)MUST(b, peri_select_box(b, NULL, lo3, hi));
            id[3][k] = (int32_t)MUST(b, plane_obstacle(b, far_, v, 0, NULL, NULL));
        }
        id[2][0] = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, v, NULL, NULL));
        id[2][1] = load = (int32_t)MUST(b, peri_prescribe_velocity(b, PERI_ALL, PERI_AXIS_X, NULL, NULL, NULL)); /* supports are loads */
        MUST(b, peri_remove_load(b, load));
        id[2][2] = (int32_t)MUST(b, peri_apply_layer_traction(b, PERI_ALL, 1, v, NULL, NULL));
        for (int32_t kind = 0; kind < 4; ++kind)
            for (int32_t k = 0; k < 3; ++k) {
                CHECK(id[kind][k] == ((kind + 1) << 27 | number << 20 | (k + 1)) && id[kind][k] > 0);
                CHECK(PERI_ID_INDEX(id[kind][k]) == k + 1 && peri_id(b, PERI_KIND_MATERIAL + kind, k + 1) == id[kind][k]);
            }
        double *material = get(b, PERI_FIELD_MATERIAL);
        CHECK(material[5] == PERI_ID_INDEX(second) && peri_size_of_set(b, PERI_ALL) == 12);
        free(material);
        peri_body_destroy(b);
    }
    s.desc.number = 0;
    for (int k = 0; k < 32; ++k) {
        many[k] = specimen_start(&s);
        const int32_t number = peri_id(many[k], PERI_KIND_MATERIAL, 1) >> 20 & 0x7F;
        CHECK(number >= 1);
        for (int j = 0; j < k; ++j) same += (peri_id(many[j], PERI_KIND_MATERIAL, 1) >> 20 & 0x7F) == number;
    }
    CHECK(same < 32 * 31 / 2 / 10); /* of 496 pairs 4 if numbers were drawn */
    for (int k = 0; k < 32; ++k) peri_body_destroy(many[k]);
}

/* "There are at most 1,048,575 of a kind, of materials 120" (those: test_misuse.c); PERI_ERROR_TOO_LARGE: "the value is the limit". */
static void numbers_of_a_kind(void) {
    peri_body *b = plate(4, 3);
    const int32_t point = 7;
    int32_t last = 0;
    for (int32_t k = 0; k < 1048575 && last >= 0; ++k) last = peri_select_points(b, NULL, 1, &point);
    CHECK(PERI_ID_INDEX(MUST(b, last)) == 1048575 && peri_size_of_set(b, last) == 1);
    REFUSE(b, PERI_ERROR_TOO_LARGE, peri_select_points(b, NULL, 1, &point));
    CHECK(seen.value == 1048575);
    peri_body_destroy(b);
}

/* "Axes are sums (bitwise or) of PERI_AXIS_X, PERI_AXIS_Y and PERI_AXIS_Z; PERI_AXIS_XY and PERI_AXIS_XYZ are two such sums." */
static void axes_are_sums(void) {
    CHECK(PERI_AXIS_XY == (PERI_AXIS_X | PERI_AXIS_Y) && PERI_AXIS_XYZ == (PERI_AXIS_X | PERI_AXIS_Y | PERI_AXIS_Z));
    for (int axes = 1; axes < 8; ++axes) {
        const specimen s = box_of(PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 3, 3, 3);
        const double v[3] = {1, 1, 1};
        int32_t sum = 0;
        peri_body *b = specimen_make(&s);
        if (axes & 1) sum |= PERI_AXIS_X;
        if (axes & 2) sum |= PERI_AXIS_Y;
        if (axes & 4) sum |= PERI_AXIS_Z;
        MUST(b, peri_prescribe_velocity(b, PERI_ALL, sum, v, NULL, NULL));
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 1, 0, 0);
        double *got = get(b, PERI_FIELD_VELOCITY);
        for (int d = 0; d < 3; ++d) CHECK_NEAR(got[3 * 13 + d], axes >> d & 1, 0, 1e-14);
        free(got);
        peri_body_destroy(b);
    }
}

/* PERI_ERROR_ID_NONE: "the index is what was given"; _ID_KIND: "the index is the id, in an array the index is the entry and the value the
   id", and peri_format_error says of what: "set is material 1 of body 7". */
static void ids_in_records(void) {
    specimen s = box_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 4, 3, 1);
    const double x[4] = {0.5, 0.5, 1.5, 0.5}, volume[2] = {1, 1};
    char text[128];
    s.desc.number = 7;
    peri_body *b = specimen_start(&s);
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
    int32_t of_points[2] = {material, PERI_ALL};
    REFUSE(b, PERI_ERROR_ID_KIND, peri_add_points(b, 2, x, volume, of_points));
    CHECK(seen.index == 1 && seen.value == PERI_ALL);
    of_points[1] = 12;
    REFUSE(b, PERI_ERROR_ID_NONE, peri_add_points(b, 2, x, volume, of_points));
    CHECK(seen.index == 1 && seen.value == 12);
    MUST(b, peri_add_box(b, material, s.lo, s.hi, 1));
    MUST(b, peri_build(b));
    for (int32_t k = -3; k < 3; ++k) {
        REFUSE(b, PERI_ERROR_ID_NONE, peri_size_of_set(b, k));
        CHECK(seen.index == k);
    }
    REFUSE(b, PERI_ERROR_ID_KIND, peri_get_set(b, material, NULL, 0));
    CHECK(seen.index == material);
    MUST(NULL, peri_format_error(&seen, text, sizeof text));
    CHECK(strstr(text, "set is material 1 of body 7") != NULL);
    peri_body_destroy(b);
}

/* ---- records ------------------------------------------------------------------------------------------------------- */

static int32_t bad_beyond(void *user, double q, double *w) {
    *w = q > *(const double *)user ? (double)NAN : 1;
    return 0;
}

/* "code: PERI_OK where no call failed yet"; "index: the first offending point, entry of an array argument, or id; else -1"; "value: the
   offending value, or the limit that was passed; else 0"; "field: constant text ... or """; the rows of the table of statuses. */
static void records(void) {
    specimen s = box_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 4, 3, 1);
    const int32_t points[3] = {1, 2, 99}, pairs[4] = {0, 1, 99, 2};
    const double to[2] = {4, 4};
    char text[128];
    double limit = 0.8;
    peri_body *b = specimen_start(&s), *other = NULL;
    peri_error e = record_of(b), kept;
    peri_material_desc m = s.material;
    CHECK(e.code == PERI_OK && e.index == -1 && e.value == 0 && e.reserved == 0 && e.field[0] == 0 && strcmp(e.text, "success") == 0);
    m.poisson = 0.3;
    REFUSE(b, PERI_ERROR_POISSON, peri_add_material(b, &m));
    CHECK_NEAR(seen.value, 1.0 / 3.0, 1e-15, 0);
    REFUSE(b, PERI_ERROR_EMPTY, peri_build(b));
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 3));
    REFUSE(b, PERI_ERROR_HORIZON, peri_build(b)); /* 1 x 1 cells of 4 x 3: "the spacing of the points, which is the value" */
    CHECK(seen.value > s.desc.horizon && seen.value <= 4);
    peri_body_destroy(b);
    b = specimen_make(&s);
    REFUSE(b, PERI_ERROR_ORDER, peri_build(b));
    CHECK(strcmp(seen.field, "peri_build") == 0 && seen.value == 1 && seen.index == -1);
    MUST(NULL, peri_format_error(&seen, text, sizeof text)); /* on a copy, without a body */
    CHECK(strstr(text, "peri_build was called") != NULL);
    REFUSE(b, PERI_ERROR_INDEX, peri_select_points(b, NULL, 3, points));
    CHECK(seen.index == 2 && seen.value == 99);
    REFUSE(b, PERI_ERROR_INDEX, peri_cut_pairs(b, PERI_CUT_NOW, 2, pairs));
    CHECK((seen.index == 1 || seen.index == 2) && seen.value == 99);
    const int32_t set = (int32_t)MUST(b, peri_select_box(b, "all", lo3, to));
    REFUSE(b, PERI_ERROR_NAME, peri_select_ball(b, "all", lo3, 9));
    CHECK(seen.index == set);
    kept = seen;
    REFUSE(b, PERI_ERROR_CRACK, peri_cut_segment(b, PERI_CUT_NOW, to, to));
    CHECK(strcmp(kept.field, "name") == 0 && kept.text == peri_status_text(PERI_ERROR_NAME)); /* constant text */
    peri_body_destroy(b);
    CHECK(strcmp(kept.field, "name") == 0);
    s.desc.correction = PERI_CORRECTION_MOMENT; /* "a choice that another excludes: a planar quadrature in 3D, a correction beside it" */
    s.desc.quadrature = PERI_QUADRATURE_PARTIAL_MOMENT;
    CHECK(peri_body_create(&s.desc, &other, &e) == PERI_ERROR_CHOICE && strcmp(e.field, "correction") == 0);
    CHECK(e.value == PERI_CORRECTION_MOMENT);
    s.desc.correction = PERI_CORRECTION_NONE;
    s.desc.quadrature = PERI_QUADRATURE_FULL;
    s.desc.influence = PERI_INFLUENCE_USER; /* "is not finite here, or has no finite moments to calibrate with; index: the point" */
    s.desc.influence_fn = bad_beyond;
    s.desc.influence_user = &limit;
    s.material.law = PERI_LAW_LPS; /* asks for no moments */
    s.material.poisson = 0.2;
    b = specimen_start(&s);
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 1));
    REFUSE(b, PERI_ERROR_INFLUENCE, peri_build(b));
    CHECK(seen.index == 0); /* which has a neighbour at 2/2.1 > 0.8 */
    peri_body_destroy(b);
    s.material.law = PERI_LAW_BOND_BASED;
    s.material.poisson = (double)NAN;
    b = specimen_start(&s);
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
    double c;
    REFUSE(b, PERI_ERROR_INFLUENCE, peri_get_bond_constants(b, material, material, &c, NULL));
    CHECK(seen.index == -1 && seen.value == 0); /* of no point */
    peri_body_destroy(b);
}

/* "0 lets the call go on (of a choice: no)"; peri_point_fn: "> 0: take this site, or this point", "`index` numbers the candidates: the
   sites of the lattice in peri_add_shape, the points in peri_select_if. It sees each once, in order". */
typedef struct chooser {
    int64_t next;
    int     wrong;
} chooser;
static int32_t every_third(void *user, int64_t index, const double *x) {
    chooser *c = (chooser *)user;
    c->wrong += index != c->next++ || !(x[0] > 0);
    return index % 3 == 0 ? 5 : 0;
}
static int32_t cut_none(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)i, (void)j, (void)xi, (void)xj;
    return 0 * ++*(int *)user;
}
static void zero_is_no(void) {
    specimen s = box_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 6, 4, 1);
    chooser c = {0, 0};
    int asked = 0;
    s.desc.horizon = 3.3;
    peri_body *b = specimen_start(&s);
    CHECK(MUST(b, peri_add_shape(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 1, every_third, &c)) == 8 && c.next == 24);
    MUST(b, peri_build(b));
    c.next = 0;
    CHECK(peri_size_of_set(b, (int32_t)MUST(b, peri_select_if(b, NULL, every_third, &c))) == 3 && c.next == 8 && c.wrong == 0);
    CHECK(MUST(b, peri_cut_if(b, PERI_CUT_NOW, cut_none, &asked)) == 0 && asked == peri_bond_count(b) && peri_broken_count(b) == 0);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(versions);
    RUN(described_bodies);
    RUN(defaults);
    RUN(choices_are_counted);
    RUN(vectors_are_interleaved);
    RUN(arrays_are_copied);
    RUN(volumes_of_planes_are_areas);
    RUN(thickness_of_solids);
    RUN(points_are_numbered_as_added);
    RUN(layout_of_ids);
    RUN(numbers_of_a_kind);
    RUN(axes_are_sums);
    RUN(ids_in_records);
    RUN(records);
    RUN(zero_is_no);
    return test_end("test_promises");
}
