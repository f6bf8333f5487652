/* SPDX-License-Identifier: MIT */
/* test_edges.c - what callbacks may and may not do, and inputs at the edge of what a body can hold. Truths: the promises of peri.h,
   conservation laws, and the textbook kernel. */
#include "peri_test.h"

static peri_body *empty(int32_t space, int32_t precision, double horizon, int32_t quadrature, int32_t kernel, double s0) {
    peri_body_desc desc;
    peri_body_desc_init(&desc);
    desc.space = space;
    desc.precision = precision;
    desc.horizon = horizon;
    desc.quadrature = quadrature;
    desc.kernel = kernel;
    return test_unit_body(&desc, s0);
}

static peri_body *plate(double s0) {
    const double lo[2] = {0, 0}, hi[2] = {20, 10};
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, 3.0, PERI_QUADRATURE_FULL, PERI_KERNEL_BEST, s0);
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1.0));
    MUST(b, peri_build(b));
    return b;
}

/* u = stretch*x along x. */
static void pull(peri_body *b, double stretch) {
    int64_t n = peri_size_of_field(b, PERI_FIELD_POSITION), i;
    double *x = (double *)malloc((size_t)n * sizeof(double));
    MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, n));
    for (i = 0; i < n; ++i) x[i] *= i % peri_dimension(b) ? 0.0 : stretch;
    MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, x, n));
    free(x);
}

static int32_t run_steps(peri_body *b, int64_t steps, double damping) {
    peri_advance_desc run;
    peri_advance_desc_init(&run);
    run.steps = steps;
    run.damping = damping;
    return peri_advance(b, &run);
}

/* ---- callbacks ------------------------------------------------------------------------------------------------------ */

typedef struct counter {
    peri_body *body;
    int64_t    calls, refused;
} counter;

/* Reads all there is to read, and tries what no callback may do. */
static void meddle(counter *c) {
    peri_energy e;
    peri_view view;
    const double v[2] = {1, 1};
    c->calls++;
    CHECK(peri_get_energy(c->body, &e) == PERI_OK);
    CHECK(peri_view_field(c->body, PERI_FIELD_DAMAGE, &view) == PERI_OK);
    CHECK(peri_view_field(c->body, PERI_FIELD_FORCE_DENSITY, &view) == PERI_OK);
    c->refused += peri_reset(c->body) == PERI_ERROR_ORDER;
    c->refused += peri_add_velocity(c->body, PERI_ALL, v) == PERI_ERROR_ORDER;
    c->refused += run_steps(c->body, 1, 0) == PERI_ERROR_ORDER;
    peri_body_destroy(c->body);
}

static int32_t on_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    CHECK(i < j && time > 0 && stretch > 0.01);
    meddle((counter *)user);
    return 0;
}
static int32_t on_load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)time, (void)count, (void)points, (void)value;
    meddle((counter *)user);
    return 0;
}
static int32_t on_pair(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)i, (void)j, (void)xj;
    meddle((counter *)user);
    return xi[0] < 4.0;
}
static int32_t on_point(void *user, int64_t index, const double *x) {
    (void)index, (void)x;
    meddle((counter *)user);
    return 1;
}
static int32_t on_write(void *user, const void *bytes, int64_t count) {
    (void)bytes, (void)count;
    meddle((counter *)user);
    return 0;
}

/* Every bond that breaks is told once, whatever the callback reads; the ledger closes as without it; what would change the body is
   refused and the body lives. */
static void callbacks_read_and_do_no_harm(void) {
    const double zero[2] = {0, 0};
    counter c = {NULL, 0, 0}, other = {NULL, 0, 0}, quiet_one = {NULL, 0, 0};
    peri_energy told, quiet;
    peri_body *b = plate(0.01), *q = plate(0.01);
    c.body = other.body = b;
    quiet_one.body = q;
    pull(b, 0.0098);
    pull(q, 0.0098);
    CHECK(MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, on_pair, &other)) > 10);
    MUST(q, peri_cut_if(q, PERI_CUT_INITIAL, on_pair, &quiet_one));
    MUST(b, peri_on_break(b, on_break, &c));
    MUST(b, peri_apply_body_force(b, PERI_ALL, zero, on_load, &other));
    MUST(b, peri_select_if(b, NULL, on_point, &other));
    MUST(b, peri_export_vtu_to(b, on_write, &other));
    MUST(b, run_steps(b, 40, 0));
    MUST(q, run_steps(q, 40, 0));
    CHECK(c.calls == peri_broken_count(b) && c.calls > 20 && c.refused == 3 * c.calls);
    CHECK(other.calls > 200 && other.refused == 3 * other.calls);
    MUST(b, peri_get_energy(b, &told));
    MUST(q, peri_get_energy(q, &quiet));
    CHECK_NEAR(told.error, quiet.error, 0, 1e-13);
    CHECK_NEAR(told.initial, quiet.initial, 1e-12, 0);
    peri_body_destroy(b);
    peri_body_destroy(q);
}

static int32_t add_more(void *user, int64_t index, const double *x) {
    const double lo[2] = {0, 0}, hi[2] = {4, 4};
    (void)index, (void)x;
    CHECK(peri_add_box((peri_body *)user, peri_id((peri_body *)user, PERI_KIND_MATERIAL, 1), lo, hi, 1.0) == PERI_ERROR_ORDER);
    return 1;
}
static int32_t build_again(void *user, double q, double *w) {
    CHECK(peri_build(*(peri_body **)user) == PERI_ERROR_ORDER);
    *w = 1.0 - 0.5 * q;
    return 0;
}

static void callbacks_before_build(void) {
    const double lo[2] = {0, 0}, hi[2] = {6, 6};
    peri_body_desc desc;
    peri_material_desc m;
    peri_body *b = NULL;
    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRAIN;
    desc.horizon = 2.5;
    desc.influence = PERI_INFLUENCE_USER;
    desc.influence_fn = build_again;
    desc.influence_user = &b;
    CHECK(peri_body_create(&desc, &b, NULL) == PERI_OK);
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = m.density = 1.0;
    MUST(b, peri_add_material(b, &m));
    CHECK(MUST(b, peri_add_shape(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1.0, add_more, b)) == 36);
    MUST(b, peri_build(b));
    CHECK(peri_point_count(b) == 36);
    peri_body_destroy(b);
}

static int32_t add_stiff_plane(void *user, peri_body *b) {
    const double place[2] = {0, -5}, normal[2] = {0, 1};
    if (peri_step_count(b) == 5) *(int32_t *)user = (int32_t)MUST(b, plane_obstacle(b, place, normal, 1e3, NULL, NULL));
    return 0;
}

/* An obstacle that comes in a frame lowers the stable step: the run stops rather than go unstable; without it, it goes on. */
static void obstacle_in_a_frame(void) {
    peri_body *b = plate(0);
    peri_advance_desc run;
    peri_error e;
    int32_t plane = -1;
    double before = peri_stable_step(b);
    peri_advance_desc_init(&run);
    run.steps = 20;
    run.frame_steps = 5;
    run.on_frame = add_stiff_plane;
    run.user = &plane;
    run.time_step = 0.9 * before;
    CHECK(peri_advance(b, &run) == PERI_ERROR_STEP && peri_step_count(b) == 5);
    CHECK(peri_get_error(b, &e) == PERI_OK && e.value == peri_stable_step(b) && e.value < 0.2 * before);
    MUST(b, peri_remove_obstacle(b, plane));
    CHECK(peri_stable_step(b) == before);
    CHECK(peri_remove_obstacle(b, plane) == PERI_ERROR_ID_GONE);
    MUST(b, run_steps(b, 15, 0));
    MUST(b, peri_reset(b));
    run.time_step = 0; /* a step that was not given gets shorter instead */
    CHECK(peri_advance(b, &run) == PERI_OK && peri_step_count(b) == 20 && peri_stable_step(b) < 0.2 * before);
    peri_body_destroy(b);
}

/* ---- columns at their edge ------------------------------------------------------------------------------------------ */

/* Two boxes whose lattices nearly fit: forces are those of the textbook kernel, and none is left over. */
static void lattices_that_nearly_fit(void) {
    static const double misfit[6] = {0, 1e-12, 1e-8, 1e-5, 2e-4, 1e-2};
    int k, kernel;
    for (k = 0; k < 6; ++k) {
        double *f[2], net = 0, size = 0, worst = 0;
        int64_t n = 0, i;
        for (kernel = PERI_KERNEL_BEST; kernel <= PERI_KERNEL_REFERENCE; ++kernel) {
            const double lo[2] = {0, 0}, hi[2] = {40, 10}, lo2[2] = {0, 10}, hi2[2] = {40 * (1 + misfit[k]), 20};
            peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, 3.0, PERI_QUADRATURE_FULL, kernel, 0);
            MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1.0));
            MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo2, hi2, 1.0));
            MUST(b, peri_build(b));
            pull(b, 1e-3);
            n = peri_size_of_field(b, PERI_FIELD_FORCE_DENSITY);
            f[kernel - PERI_KERNEL_BEST] = (double *)malloc((size_t)n * sizeof(double));
            MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f[kernel - PERI_KERNEL_BEST], n));
            peri_body_destroy(b);
        }
        for (i = 0; i < n; ++i) {
            size = fmax(size, fabs(f[1][i]));
            worst = fmax(worst, fabs(f[0][i] - f[1][i]));
            if (misfit[k] == 0) net += f[0][i];
        }
        CHECK(size > 1e-4);
        CHECK_NEAR(worst, 0, 0, 1e-10 * size); /* bond vectors that differ by less than 1.5e-11 of a spacing are one */
        CHECK_NEAR(net, 0, 0, 1e-13 * size * (double)n);
        free(f[0]);
        free(f[1]);
    }
}

/* A second lattice far away, in single precision and at another scale: built, and at rest under a rigid shift. */
static void lattices_far_apart(void) {
    static const double far_lo[3] = {40000.3371, 3e6, 5e8}, cell[3] = {1, 1, 1e4};
    int32_t precision, quadrature;
    int k;
    for (precision = PERI_PRECISION_DOUBLE; precision <= PERI_PRECISION_SINGLE; ++precision)
        for (quadrature = PERI_QUADRATURE_FULL; quadrature <= PERI_QUADRATURE_PARTIAL; ++quadrature)
            for (k = 0; k < 3; ++k) {
                const double lo[2] = {0, 0}, hi[2] = {16, 4}, lo2[2] = {far_lo[k], 0}, shift[2] = {0.25, 0};
                const double hi2[2] = {far_lo[k] + 20.003 * cell[k], 4 * cell[k]};
                peri_body *b = empty(PERI_SPACE_PLANE_STRESS, precision, 2.5, quadrature, PERI_KERNEL_BEST, 0);
                int64_t n, i;
                double *f, largest = 0;
                MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1.0));
                MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo2, hi2, cell[k]));
                if (k == 2) { /* cells far larger than the horizon */
                    CHECK(peri_build(b) == PERI_ERROR_HORIZON);
                    peri_body_destroy(b);
                    continue;
                }
                if (peri_build(b) == PERI_OK) { /* single precision may merge points that far out: refused, not wrong */
                    MUST(b, peri_add_displacement(b, PERI_ALL, shift));
                    n = peri_size_of_field(b, PERI_FIELD_FORCE_DENSITY);
                    f = (double *)malloc((size_t)n * sizeof(double));
                    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, n));
                    for (i = 0; i < n; ++i) largest = fmax(largest, fabs(f[i]));
                    CHECK_NEAR(largest, 0, 0, 1e-6);
                    free(f);
                } else {
                    CHECK(precision == PERI_PRECISION_SINGLE);
                }
                peri_body_destroy(b);
            }
}

/* ---- numbers -------------------------------------------------------------------------------------------------------- */

/* Rigid motion under damping: the kinetic energy that is lost is the damping entry, at any damping that is allowed. */
static void damping_of_rigid_motion(void) {
    static const double per_step[5] = {0.01, 0.1, 0.5, 1.0, 1.9};
    const double v[2] = {1, 0};
    int32_t integrator;
    int k;
    for (k = 0; k < 5; ++k)
        for (integrator = PERI_INTEGRATOR_VELOCITY_VERLET; integrator < peri__end_integrator; ++integrator) {
            peri_body *b = plate(0);
            peri_energy e;
            peri_advance_desc run;
            MUST(b, peri_add_velocity(b, PERI_ALL, v));
            peri_advance_desc_init(&run);
            run.integrator = integrator;
            run.steps = 20;
            run.time_step = 0.5 * peri_stable_step(b);
            run.damping = per_step[k] / run.time_step;
            MUST(b, peri_advance(b, &run));
            MUST(b, peri_get_energy(b, &e));
            CHECK_NEAR(e.initial, 0.5 * 200, 1e-13, 0);
            CHECK_NEAR(e.error, 0, 0, 1e-11);
            CHECK(e.damping > 0.3 * e.initial);
            run.damping = 2.1 / run.time_step;
            CHECK(peri_advance(b, &run) == PERI_ERROR_RANGE);
            peri_body_destroy(b);
        }
}

/* What the arithmetic cannot hold is refused, and nothing changes. */
static void too_large_numbers(void) {
    const double lo[2] = {0, 0}, hi[2] = {4, 4}, far_[2] = {1e300, 0}, fast[2] = {1e12, 0}, nan_[2] = {NAN, 0};
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_SINGLE, 1e200, PERI_QUADRATURE_FULL, PERI_KERNEL_BEST, 0);
    peri_error error;
    int64_t n;
    double *x;
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1.0));
    CHECK(peri_build(b) == PERI_ERROR_RANGE);
    peri_body_destroy(b);
    for (n = 0; n < 3; ++n) { /* an extent beyond double; one that is so in units of a spacing; a spacing below double */
        const double places[2][4] = {{-1.7e308, 0, 1.7e308, 0}, {0, 0, 1e300, 0}}, volumes[2][2] = {{1, 1}, {1e-30, 1e-30}};
        const double thin[2] = {4.9e-324, 4};
        b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, n == 2 ? 10 : 2, PERI_QUADRATURE_FULL, PERI_KERNEL_BEST, 0);
        if (n < 2) MUST(b, peri_add_points(b, 2, places[n], volumes[n], NULL));
        else MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, thin, 1.0));
        CHECK(peri_build(b) == PERI_ERROR_POINT);
        peri_body_destroy(b);
    }
    b = plate(0);
    n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
    x = (double *)calloc((size_t)n, sizeof(double));
    CHECK(peri_add_displacement(b, PERI_ALL, far_) == PERI_ERROR_RANGE);
    CHECK(peri_get_error(b, &error) == PERI_OK && strcmp(error.field, "value") == 0);
    CHECK(peri_add_velocity(b, PERI_ALL, fast) == PERI_ERROR_RANGE);
    CHECK(peri_add_velocity(b, PERI_ALL, nan_) == PERI_ERROR_RANGE);
    x[7] = 1e20;
    CHECK(peri_set_field(b, PERI_FIELD_DISPLACEMENT, x, n) == PERI_ERROR_RANGE);
    CHECK(peri_get_error(b, &error) == PERI_OK && strcmp(error.field, "in") == 0 && error.index == 3);
    MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, x, n));
    CHECK(x[0] == 0 && x[7] == 0);
    free(x);
    peri_body_destroy(b);
}

/* A polyline that is refused has cut nothing, also where vertices differ by less than the arithmetic can tell. */
static void polyline_all_or_nothing(void) {
    const double vertices[6] = {-0.9, 5, 0, 5, 1e-20, 5}, lo[2] = {-1, 0}, hi[2] = {9, 10};
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, 3.0, PERI_QUADRATURE_FULL, PERI_KERNEL_BEST, 0);
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1.0));
    MUST(b, peri_build(b));
    CHECK(peri_cut_polyline(b, PERI_CUT_INITIAL, 3, vertices) == PERI_ERROR_CRACK);
    CHECK(peri_cut_count(b) == 0);
    peri_body_destroy(b);
}

/* A box through the places of points takes them, in either precision. */
static void selection_on_the_edge(void) {
    enum { N = 60 };
    int32_t precision;
    for (precision = PERI_PRECISION_DOUBLE; precision <= PERI_PRECISION_SINGLE; ++precision) {
        double x[2 * N], v[N];
        int64_t i;
        peri_body *b = empty(PERI_SPACE_PLANE_STRESS, precision, 3.5, PERI_QUADRATURE_FULL, PERI_KERNEL_BEST, 0);
        for (i = 0; i < N; ++i) {
            x[2 * i] = 0.1 * (double)(i % 10) * 7.3 + 0.013;
            x[2 * i + 1] = (double)(i / 10) * 1.1;
            v[i] = 1.0;
        }
        MUST(b, peri_add_points(b, N, x, v, NULL));
        MUST(b, peri_build(b));
        for (i = 0; i < 10; ++i) {
            const double lo[2] = {x[2 * i], -1}, hi[2] = {x[2 * i], 99};
            CHECK(peri_size_of_set(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi))) == 6);
        }
        peri_body_destroy(b);
    }
}

/* A load that changes nothing changes no reaction. */
static void reactions_outlive_other_loads(void) {
    const double v[2] = {0.01, 0}, lo[2] = {0, 0}, hi[2] = {1, 10}, none[2] = {0, 0};
    double before[2], after[2];
    peri_body *b = plate(0);
    int32_t end = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
    int32_t support = (int32_t)MUST(b, peri_prescribe_velocity(b, end, PERI_AXIS_X, v, NULL, NULL));
    MUST(b, run_steps(b, 30, 0));
    MUST(b, peri_get_reaction(b, support, before));
    MUST(b, peri_apply_body_force(b, PERI_ALL, none, NULL, NULL));
    MUST(b, peri_get_reaction(b, support, after));
    CHECK(before[0] != 0 && before[0] == after[0]);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(callbacks_read_and_do_no_harm);
    RUN(callbacks_before_build);
    RUN(obstacle_in_a_frame);
    RUN(lattices_that_nearly_fit);
    RUN(lattices_far_apart);
    RUN(damping_of_rigid_motion);
    RUN(too_large_numbers);
    RUN(polyline_all_or_nothing);
    RUN(selection_on_the_edge);
    RUN(reactions_outlive_other_loads);
    return test_end("test_edges");
}
