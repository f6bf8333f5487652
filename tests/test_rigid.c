/* SPDX-License-Identifier: MIT */
/* Rigid grips: sets that move as rigid bodies, and the moments of supports and loads. */
#include "pool.h"
#include "refusal.h"

/* Truth: the rotation by the angle |w| about w, through the quaternion of half of it. */
static void rotate(const double *w, const double *x, double *out) {
    const double angle = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]), s = angle > 0 ? sin(angle / 2) / angle : 0.5;
    const double q = cos(angle / 2), v[3] = {s * w[0], s * w[1], s * w[2]};
    double t[3];
    for (int d = 0; d < 3; ++d) t[d] = 2 * (v[(d + 1) % 3] * x[(d + 2) % 3] - v[(d + 2) % 3] * x[(d + 1) % 3]);
    for (int d = 0; d < 3; ++d) out[d] = x[d] + q * t[d] + v[(d + 1) % 3] * t[(d + 2) % 3] - v[(d + 2) % 3] * t[(d + 1) % 3];
}

static const double centre[3] = {1.5, -0.4, 0.7};

/* How far the points of the set are from where the motion takes them. */
static double off_motion(peri_body *b, int32_t set, const double *way, const double *w) {
    const int dim = peri_dimension(b);
    double *x = get(b, PERI_FIELD_POSITION), *u = get(b, PERI_FIELD_DISPLACEMENT), most = 0;
    static int32_t points[4000];
    const int64_t count = peri_size_of_set(b, set);
    (void)MUST(b, peri_get_set(b, set, points, 4000));
    for (int64_t k = 0; k < count; ++k) {
        double arm[3] = {0}, to[3];
        for (int d = 0; d < dim; ++d) arm[d] = x[points[k] * dim + d] - centre[d];
        rotate(w, arm, to);
        for (int d = 0; d < dim; ++d) most = fmax(most, fabs(u[points[k] * dim + d] - (to[d] - arm[d] + way[d])));
    }
    free(x);
    free(u);
    return most;
}

static int32_t solve_to(peri_body *b, double factor, double tolerance) {
    peri_solve_desc d;
    peri_solve_desc_init(&d);
    d.load_to = factor;
    d.tolerance = tolerance;
    d.steps = 2;
    return (int32_t)MUST(b, peri_solve(b, &d, NULL));
}

/* A body that turns as a whole is not strained: no energy, no force, no moment. Half the load factor is half the angle. */
static void the_whole_body_turns(void) {
    static const double turns[4][3] = {{0, 0, 0.7}, {0, 0, -3}, {0.5, -0.3, 0.9}, {0, 0, 0}};
    for (int k = 0; k < 4; ++k)
        for (int half = 0; half < 2; ++half)
            for (int32_t law = PERI_LAW_BOND_BASED; law <= PERI_LAW_CORRESPONDENCE; ++law) {
                const int dim = k == 2 ? 3 : 2;
                const double way[3] = {0.3, -0.2, dim == 3 ? 0.1 : 0}, f = half ? 0.5 : 1;
                double motion[6] = {way[0], way[1], 0}, force[3], moment[3], w[3], part[3];
                specimen s = specimen_of(dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, law, 0.2, 0.5, 2.1, 6, 5, 4);
                peri_body *b = specimen_make(&s);
                peri_energy e;
                for (int d = 0; d < 3; ++d) w[d] = f * turns[k][d], part[d] = f * way[d];
                if (dim == 2) motion[2] = turns[k][2];
                else for (int d = 0; d < 3; ++d) motion[d] = way[d], motion[3 + d] = turns[k][d];
                const int32_t grip = (int32_t)MUST(b, peri_prescribe_rigid(b, PERI_ALL, centre, motion, NULL, NULL));
                (void)solve_to(b, f, 0);
                CHECK(off_motion(b, PERI_ALL, part, w) < 2e-14);
                (void)MUST(b, peri_get_energy(b, &e));
                (void)MUST(b, peri_get_reaction(b, grip, force));
                (void)MUST(b, peri_get_reaction_moment(b, grip, centre, moment));
                CHECK(fabs(e.elastic) < 1e-25);
                for (int d = 0; d < dim; ++d) CHECK(fabs(force[d]) < 1e-12);
                for (int d = 0; d < (dim == 3 ? 3 : 1); ++d) CHECK(fabs(moment[d]) < 1e-12);
                peri_body_destroy(b);
            }
}

/* In linear geometry a turn is w x X, which strains nothing there. */
static void small_turns_of_linear_geometry(void) {
    for (int dim = 2; dim <= 3; ++dim) {
        const double motion[6] = {0, 0, dim == 3 ? 0 : 0.4, 0.3, -0.2, 0.5};
        specimen s = specimen_of(dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, PERI_LAW_LPS, 0.3, 0.5, 2.1, 6, 5, 4);
        s.desc.geometry = PERI_GEOMETRY_LINEAR;
        peri_body *b = specimen_make(&s);
        peri_energy e;
        (void)MUST(b, peri_prescribe_rigid(b, PERI_ALL, centre, motion, NULL, NULL));
        (void)solve_to(b, 1, 0);
        (void)MUST(b, peri_get_energy(b, &e));
        CHECK(fabs(e.elastic) < 1e-25);
        double *x = get(b, PERI_FIELD_POSITION), *u = get(b, PERI_FIELD_DISPLACEMENT);
        const double w[3] = {dim == 3 ? 0.3 : 0, dim == 3 ? -0.2 : 0, dim == 3 ? 0.5 : 0.4};
        for (int64_t k = 0; k < peri_point_count(b); ++k) {
            double arm[3] = {0, 0, 0};
            for (int d = 0; d < dim; ++d) arm[d] = x[k * dim + d] - centre[d];
            for (int d = 0; d < dim; ++d)
                CHECK_NEAR(u[k * dim + d], w[(d + 1) % 3] * arm[(d + 2) % 3] - w[(d + 2) % 3] * arm[(d + 1) % 3], 0, 1e-14);
        }
        free(x);
        free(u);
        peri_body_destroy(b);
    }
}

typedef struct bar {
    peri_body *body;
    int32_t    left, right, set;
    double     lo[3], hi[3];
} bar;

/* Held at the left by a rigid grip that does not move, by another at the right, each two horizons deep. */
static bar gripped(int dim, int32_t geometry, int32_t law, const double *motion, peri_rigid_fn fn, void *user) {
    bar g;
    const int deep = 6, n = 40;
    specimen s = specimen_of(dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, law, 0.25, 0.25, 3.015, n, dim == 3 ? 5 : 12, 5);
    s.desc.geometry = geometry;
    s.desc.correction = PERI_CORRECTION_MOMENT;
    s.desc.thickness = dim == 3 ? 1 : 0.4;
    if (dim == 3) s.desc.horizon = 2.1 * 0.25;
    g.body = specimen_make(&s);
    const double left[3] = {deep * 0.25, 99, 99}, right[3] = {(n - deep) * 0.25, -1, -1}, low[3] = {-1, -1, -1}, high[3] = {99, 99, 99};
    const int32_t held = (int32_t)MUST(g.body, peri_select_box(g.body, NULL, low, left));
    g.set = (int32_t)MUST(g.body, peri_select_box(g.body, NULL, right, high));
    g.left = (int32_t)MUST(g.body, peri_prescribe_rigid(g.body, held, centre, NULL, NULL, NULL));
    g.right = (int32_t)MUST(g.body, peri_prescribe_rigid(g.body, g.set, centre, motion, fn, user));
    memcpy(g.hi, s.hi, sizeof g.hi);
    return g;
}

/* Balance: forces of both grips cancel, and so do their moments, about any place. Clapeyron: in linear geometry the energy is half the work
   of the final force and moment on the motion, the moment taken about the centre. */
static void grips_balance(void) {
    for (int dim = 2; dim <= 3; ++dim)
        for (int linear = 0; linear < 2; ++linear) {
            const double motion[6] = {0.01, -0.03, dim == 3 ? 0.02 : 0.05, 0.06, 0.02, -0.04}, place[3] = {7, -3, 2};
            const int turns = dim == 3 ? 3 : 1;
            bar g = gripped(dim, linear ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR, PERI_LAW_BOND_BASED, motion, NULL, NULL);
            double f[2][3], m[2][3], c[2][3], work = 0;
            peri_energy e;
            (void)solve_to(g.body, 1, 1e-11);
            for (int k = 0; k < 2; ++k) {
                const int32_t grip = k ? g.right : g.left;
                (void)MUST(g.body, peri_get_reaction(g.body, grip, f[k]));
                (void)MUST(g.body, peri_get_reaction_moment(g.body, grip, place, m[k]));
                (void)MUST(g.body, peri_get_reaction_moment(g.body, grip, centre, c[k]));
            }
            for (int d = 0; d < dim; ++d) CHECK_NEAR(f[0][d], -f[1][d], 1e-7, 1e-9);
            for (int d = 0; d < turns; ++d) {
                CHECK(fabs(m[1][d]) > 1e-6 && fabs(c[1][d]) > 1e-6);
                CHECK_NEAR(m[0][d], -m[1][d], 1e-7, 1e-9);
                CHECK_NEAR(c[0][d], -c[1][d], 1e-7, 1e-9);
            }
            /* another place: M' = M + (c - place) x F */
            const double arm[3] = {centre[0] - place[0], centre[1] - place[1], dim == 3 ? centre[2] - place[2] : 0};
            if (dim == 2) CHECK_NEAR(m[1][0], c[1][0] + arm[0] * f[1][1] - arm[1] * f[1][0], 1e-9, 0);
            else
                for (int d = 0; d < 3; ++d) {
                    const int p = (d + 1) % 3, q = (d + 2) % 3;
                    CHECK_NEAR(m[1][d], c[1][d] + arm[p] * f[1][q] - arm[q] * f[1][p], 1e-9, 1e-12);
                }
            (void)MUST(g.body, peri_get_energy(g.body, &e));
            for (int d = 0; d < dim; ++d) work += 0.5 * f[1][d] * motion[d];
            for (int d = 0; d < turns; ++d) work += 0.5 * c[1][d] * motion[dim + d];
            CHECK_NEAR(e.elastic, work, linear ? 1e-7 : 0.05, 0);
            peri_body_destroy(g.body);
        }
}

/* Pure bending, both ends turned: M = E I angle/L, I = t H^3/12 of the rectangle (beam theory; grips clamp the cross-section, too). */
static void pure_bending(void) {
    const double angle = 0.02, gauge = 7, height = 3, length = 10;
    const double middle_left[2] = {1.5, height / 2}, middle_right[2] = {length - 1.5, height / 2};
    const double left_turn[3] = {0, 0, -angle / 2}, right_turn[3] = {0, 0, angle / 2};
    double moment, force[2];
    bar g = gripped(2, PERI_GEOMETRY_LINEAR, PERI_LAW_BOND_BASED, NULL, NULL, NULL);
    const double low[2] = {-1, -1}, left[2] = {1.5, 99};
    const int32_t held = (int32_t)MUST(g.body, peri_select_box(g.body, NULL, low, left));
    (void)MUST(g.body, peri_prescribe_rigid(g.body, held, middle_left, left_turn, NULL, NULL)); /* later supports win */
    const int32_t turned = (int32_t)MUST(g.body, peri_prescribe_rigid(g.body, g.set, middle_right, right_turn, NULL, NULL));
    (void)solve_to(g.body, 1, 1e-10);
    (void)MUST(g.body, peri_get_reaction_moment(g.body, turned, middle_right, &moment));
    (void)MUST(g.body, peri_get_reaction(g.body, turned, force));
    const double want = 1 * 0.4 * height * height * height / 12 * angle / gauge;
    printf("    moment %.4g of beam theory, with its clamps\n", moment / want);
    CHECK_NEAR(moment, want, 0.12, 0);
    CHECK(fabs(force[0]) < 1e-7 * want && fabs(force[1]) < 1e-7 * want);
    (void)MUST(g.body, peri_get_reaction_moment(g.body, g.right, middle_right, &moment));
    CHECK(moment == 0); /* nothing is left to it */
    peri_body_destroy(g.body);
}

/* The moment of a load: that of its forces. */
static void moment_of_a_load(void) {
    const double place[3] = {1, 2, 3}, force[3] = {0.2, -0.1, 0.3};
    specimen s = specimen_of(PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 0, 0.5, 2.1, 5, 4, 3);
    peri_body *b = specimen_make(&s);
    const int32_t load = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, force, NULL, NULL));
    double moment[3], total[3];
    const double arm[3] = {s.hi[0] / 2 - place[0], s.hi[1] / 2 - place[1], s.hi[2] / 2 - place[2]}; /* to the centre of volume */
    (void)MUST(b, peri_get_reaction(b, load, total));
    (void)MUST(b, peri_get_reaction_moment(b, load, place, moment));
    for (int d = 0; d < 3; ++d) {
        const int p = (d + 1) % 3, q = (d + 2) % 3;
        CHECK_NEAR(moment[d], arm[p] * total[q] - arm[q] * total[p], 1e-12, 0);
    }
    peri_body_destroy(b);
}

/* ---- in motion ------------------------------------------------------------------------------------------------------- */

typedef struct spin {
    double rate, last;
    int    calls, say;
} spin;
static int32_t turn_on(void *user, double time, double *motion) {
    spin *s = (spin *)user;
    s->calls++;
    s->last = time;
    motion[2] += s->rate * time;
    if (s->say == 2) motion[1] = (double)NAN;
    return s->say == 2 ? 0 : s->say;
}

/* Where a grip is follows from the time; what it takes from the ledger, too: nothing is left open but what a step leaves. */
static void a_grip_that_spins(void) {
    const double motion[3] = {0.001, 0, 0};
    spin s = {0.02, 0, 0, 0};
    bar g = gripped(2, PERI_GEOMETRY_NONLINEAR, PERI_LAW_BOND_BASED, motion, turn_on, &s);
    peri_body *copy = NULL;
    peri_energy e;
    double m[2];
    const double dt = 0.8 * peri_stable_step(g.body);
    (void)go(g.body, PERI_INTEGRATOR_VELOCITY_VERLET, 40, dt, 0);
    const double w[3] = {0, 0, 0.02 * peri_time(g.body)}, way[3] = {0.001, 0, 0};
    CHECK_NEAR(s.last, peri_time(g.body), 1e-14, 0);
    CHECK(s.calls >= 40);
    CHECK(off_motion(g.body, g.set, way, w) < 1e-14);
    (void)MUST(g.body, peri_get_energy(g.body, &e));
    CHECK(e.external > 0 && fabs(e.error) < 0.02 * e.external);
    (void)MUST(g.body, peri_get_reaction_moment(g.body, g.right, centre, &m[0]));
    CHECK(m[0] > 0); /* drives the turn */
    (void)MUST(g.body, peri_body_clone(g.body, &copy, NULL));
    (void)go(g.body, PERI_INTEGRATOR_VELOCITY_VERLET, 5, dt, 0);
    (void)go(copy, PERI_INTEGRATOR_VELOCITY_VERLET, 5, dt, 0);
    for (int k = 0; k < 2; ++k) (void)MUST(k ? copy : g.body, peri_get_reaction_moment(k ? copy : g.body, g.right, centre, &m[k]));
    CHECK(m[0] == m[1] && m[0] != 0);
    (void)MUST(g.body, peri_reset(g.body));
    (void)go(g.body, PERI_INTEGRATOR_VELOCITY_VERLET, 45, dt, 0);
    (void)MUST(g.body, peri_get_reaction_moment(g.body, g.right, centre, &m[1]));
    CHECK_NEAR(m[1], m[0], 1e-9, 0);
    (void)MUST(copy, peri_remove_load(copy, g.right));
    (void)go(copy, PERI_INTEGRATOR_VELOCITY_VERLET, 5, dt, 0);
    CHECK(off_motion(copy, g.set, way, w) > 1e-6); /* free again */
    peri_body_destroy(copy);
    peri_body_destroy(g.body);
}

/* What its callback says is heeded as of any other; a value that is not finite is named. */
static void callbacks_of_grips(void) {
    for (int say = -4; say < 3; say += 3) {
        spin s = {0.02, 0, 0, say};
        peri_advance_desc d;
        bar g = gripped(2, PERI_GEOMETRY_NONLINEAR, PERI_LAW_BOND_BASED, NULL, turn_on, &s);
        peri_advance_desc_init(&d);
        d.steps = 3;
        REFUSE(g.body, PERI_ERROR_CALLBACK, peri_advance(g.body, &d));
        FIELD_IS(say < 0 ? "peri_rigid_fn" : "motion");
        peri_body_destroy(g.body);
    }
    spin stop = {0.02, 0, 0, 1};
    peri_advance_desc d;
    bar g = gripped(2, PERI_GEOMETRY_NONLINEAR, PERI_LAW_BOND_BASED, NULL, turn_on, &stop);
    peri_advance_desc_init(&d);
    d.steps = 3;
    CHECK(peri_advance(g.body, &d) == PERI_STOPPED && stop.calls < 3);
    peri_body_destroy(g.body);
}

/* ---- mistakes, memory ------------------------------------------------------------------------------------------------ */

static void wrong_grips(void) {
    const double bad[3] = {0, 0, (double)NAN}, good[3] = {0, 0, 1}, place[2] = {0, HUGE_VAL};
    double out[3] = {7, 7, 7};
    bar g = gripped(2, PERI_GEOMETRY_NONLINEAR, PERI_LAW_BOND_BASED, NULL, NULL, NULL);
    peri_body *b = g.body;
    REFUSE(b, PERI_ERROR_RANGE, peri_prescribe_rigid(b, g.set, centre, bad, NULL, NULL));
    FIELD_IS("motion");
    REFUSE(b, PERI_ERROR_RANGE, peri_prescribe_rigid(b, g.set, place, good, NULL, NULL));
    FIELD_IS("centre");
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_prescribe_rigid(b, g.set, NULL, good, NULL, NULL));
    REFUSE(b, PERI_ERROR_ID_KIND, peri_prescribe_rigid(b, g.left, centre, good, NULL, NULL));
    REFUSE(b, PERI_ERROR_ID_KIND, peri_get_reaction_moment(b, g.set, centre, out));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_get_reaction_moment(b, g.left, NULL, out));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_get_reaction_moment(b, g.left, centre, NULL));
    REFUSE(b, PERI_ERROR_RANGE, peri_get_reaction_moment(b, g.left, place, out));
    CHECK(out[0] == 7 && peri_prescribe_rigid(NULL, g.set, centre, good, NULL, NULL) == PERI_ERROR_ARGUMENT);
    peri_body_destroy(b);
}

static pool lent;

static void failing_allocations(void) {
    const double motion[6] = {0.1, 0, 0, 0, 0, 0.1}, zero[3] = {0, 0, 0};
    specimen s = specimen_of(PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 0, 1, 1.5, 5, 4, 3);
    peri_memory memory;
    hook(&s.desc, &lent);
    memset(&lent, 0, sizeof lent);
    lent.fail_at = -1;
    peri_body *b = specimen_make(&s);
    const int32_t before = (int32_t)MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_XYZ, zero, NULL, NULL));
    int32_t grip = PERI_ERROR_MEMORY;
    for (int64_t n = 1; grip == PERI_ERROR_MEMORY && n < 20; ++n) {
        lent.fail_at = lent.calls + n - 1;
        grip = peri_prescribe_rigid(b, PERI_ALL, zero, motion, NULL, NULL);
        (void)MUST(b, peri_get_memory(b, &memory));
        CHECK(memory.total == lent.bytes);
        if (grip > 0) break;
        lent.fail_at = -1; /* the dofs are those of the support before */
        peri_body *copy = NULL;
        double *u;
        (void)MUST(b, peri_body_clone(b, &copy, NULL));
        (void)solve_to(copy, 1, 0);
        u = get(copy, PERI_FIELD_DISPLACEMENT);
        CHECK(largest(u, 3 * peri_point_count(copy)) == 0);
        free(u);
        peri_body_destroy(copy);
    }
    CHECK(grip > 0 && PERI_ID_INDEX(grip) == 2 && PERI_ID_INDEX(before) == 1);
    lent.fail_at = -1;
    peri_body_destroy(b);
    CHECK(lent.bytes == 0);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(the_whole_body_turns);
    RUN(small_turns_of_linear_geometry);
    RUN(grips_balance);
    RUN(pure_bending);
    RUN(moment_of_a_load);
    RUN(a_grip_that_spins);
    RUN(callbacks_of_grips);
    RUN(wrong_grips);
    RUN(failing_allocations);
    return test_end("test_rigid");
}
