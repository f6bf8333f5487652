/* SPDX-License-Identifier: MIT */
/* test_loads.c - loads, supports and obstacles: totals, values in time, callbacks, balance, bounces and pushes.

   Nothing here was recorded from the library. Expected values are totals written in the contract, closed-form motions that
   velocity-Verlet follows exactly, Newton's laws, and sums over the points written out below. */
#include "scene.h"

static const double origin[3] = {0, 0, 0};

/* The column (2D) or layer (3D) of points whose first coordinate lies in cell `column`. */
static int32_t column(peri_body *b, int at) {
    const double lo[3] = {at * H, -1e3, -1e3}, hi[3] = {(at + 1) * H, 1e3, 1e3};
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}

/* Sum of force density times volume (times thickness) over the points: the resultant of all that acts. */
static void resultant(peri_body *b, int32_t space, double *sum) {
    double *f = get(b, PERI_FIELD_FORCE_DENSITY), *vol = get(b, PERI_FIELD_VOLUME);
    int dim = peri_dimension(b), k;
    int64_t i;
    for (k = 0; k < dim; ++k)
        for (sum[k] = 0, i = 0; i < peri_point_count(b); ++i) sum[k] += f[i * dim + k] * vol[i] * thickness(space);
    free(f);
    free(vol);
}

/* ---- totals ------------------------------------------------------------------------------------------------------- */

/* SOURCE OF TRUTH: the contract: "the total force is t*area exactly", "spread by volume"; a body force sums to b*volume. At
   zero displacement no bond pulls, so the force density of the points is the load alone. Sums of < 100 terms: 1e-14. */
static void totals(int32_t space) {
    const double t[3] = {0.2, -0.7, 0.4}, area = 0.33, b3[3] = {-1, 2, 3};
    peri_body *b = block(space, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 6, 5, 3);
    int32_t set = column(b, 5), traction, gravity;
    int dim = peri_dimension(b), k;
    int64_t i, n = peri_point_count(b);
    double sum[3], r[3], *f, *x, volume = (double)n * pow(H, dim) * thickness(space);
    double face = (double)peri_size_of_set(b, set) * pow(H, dim);
    traction = (int32_t)MUST(b, peri_apply_layer_traction(b, set, area, t, NULL, NULL));
    resultant(b, space, sum);
    (void)MUST(b, peri_get_reaction(b, traction, r));
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    x = get(b, PERI_FIELD_POSITION);
    for (k = 0; k < dim; ++k) {
        CHECK_NEAR(sum[k], t[k] * area * thickness(space), 1e-13, 0);
        CHECK_NEAR(r[k], t[k] * area * thickness(space), 1e-13, 0);
        for (i = 0; i < n; ++i) CHECK_NEAR(f[i * dim + k], x[i * dim] > 5 * H ? t[k] * area / face : 0, 1e-13, 0);
    }
    free(f);
    free(x);
    gravity = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, b3, NULL, NULL));
    CHECK(gravity != traction);
    resultant(b, space, sum);
    (void)MUST(b, peri_get_reaction(b, gravity, r));
    for (k = 0; k < dim; ++k) {
        CHECK_NEAR(r[k], b3[k] * volume, 1e-13, 0);
        CHECK_NEAR(sum[k], b3[k] * volume + t[k] * area * thickness(space), 1e-13, 0);
    }
    /* remove_load: the ids of the others stay, the removed one is gone */
    CHECK(peri_remove_load(b, traction) == PERI_OK);
    CHECK(peri_remove_load(b, traction) == PERI_ERROR_ID_GONE && peri_get_reaction(b, traction, r) == PERI_ERROR_ID_GONE);
    resultant(b, space, sum);
    (void)MUST(b, peri_get_reaction(b, gravity, r));
    for (k = 0; k < dim; ++k) {
        CHECK_NEAR(r[k], b3[k] * volume, 1e-13, 0);
        CHECK_NEAR(sum[k], b3[k] * volume, 1e-13, 0);
    }
    peri_body_destroy(b);
}
static void load_totals(void) {
    totals(PERI_SPACE_PLANE_STRESS);
    totals(PERI_SPACE_PLANE_STRAIN);
    totals(PERI_SPACE_SOLID);
}

/* SOURCE OF TRUTH: u = v0 t + b t^2/(2 rho), which Verlet follows exactly for a constant force. Removal leaves v constant. */
static void free_fall_is_a_parabola(void) {
    const double g[3] = {0.3, -2, 0.7}, v0[3] = {-1, 0.5, 0.25};
    int integrator;
    for (integrator = PERI_INTEGRATOR_VELOCITY_VERLET; integrator < peri__end_integrator; ++integrator) {
        peri_body *b = block(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 4, 3, 3);
        int64_t n = 3 * peri_point_count(b), i;
        int32_t load = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, g, NULL, NULL));
        double *u, *v, t, t2;
        (void)MUST(b, peri_add_velocity(b, PERI_ALL, v0));
        (void)go(b, integrator, 500, 0, 0);
        t = peri_time(b);
        u = get(b, PERI_FIELD_DISPLACEMENT);
        v = get(b, PERI_FIELD_VELOCITY);
        for (i = 0; i < n; ++i) {
            CHECK_NEAR(u[i], v0[i % 3] * t + g[i % 3] / DENSITY * t * t / 2, 1e-12, 1e-12 * t);
            CHECK_NEAR(v[i], v0[i % 3] + g[i % 3] / DENSITY * t, 1e-12, 1e-12);
        }
        free(u);
        free(v);
        (void)MUST(b, peri_remove_load(b, load));
        (void)go(b, integrator, 100, 0, 0);
        t2 = peri_time(b) - t;
        u = get(b, PERI_FIELD_DISPLACEMENT);
        for (i = 0; i < n; ++i)
            CHECK_NEAR(u[i], v0[i % 3] * (t + t2) + g[i % 3] / DENSITY * (t * t / 2 + t * t2), 1e-12, 1e-12 * (t + t2));
        free(u);
        peri_body_destroy(b);
    }
}

/* SOURCE OF TRUTH: equilibrium. Damped to rest (the slowest mode, bending of a 0.8 x 0.4 cantilever, decays as exp(-0.75 t):
   t > 60 leaves 1e-20), the support carries minus the load. Force density is zero where supported and vanishes elsewhere. */
static void reaction_balances_the_load(void) {
    const double t[2] = {0.01, 0.003};
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 8, 4, 1);
    int32_t support = (int32_t)MUST(b, peri_prescribe_displacement(b, column(b, 0), PERI_AXIS_X | PERI_AXIS_Y, NULL, NULL, NULL));
    int32_t load = (int32_t)MUST(b, peri_apply_layer_traction(b, column(b, 7), 4 * H, t, NULL, NULL));
    double r[2], l[2], sum[2], *f, *u;
    int k;
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 3000, 0, 1.5);
    CHECK(peri_time(b) > 60);
    (void)MUST(b, peri_get_reaction(b, support, r));
    (void)MUST(b, peri_get_reaction(b, load, l));
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    u = get(b, PERI_FIELD_DISPLACEMENT);
    resultant(b, PERI_SPACE_PLANE_STRESS, sum);
    for (k = 0; k < 2; ++k) {
        CHECK_NEAR(l[k], t[k] * 4 * H * THICK, 1e-13, 0);
        CHECK_NEAR(r[k], -l[k], 1e-10, 0);
        CHECK_NEAR(sum[k], 0, 0, 1e-12);
        CHECK(f[k] == 0 && u[k] == 0);
        CHECK(u[2 * 7 + k] > 0); /* the loaded corner did give way */
    }
    free(f);
    free(u);
    peri_body_destroy(b);
}

/* ---- values in time ----------------------------------------------------------------------------------------------- */

typedef struct record {
    int     calls, bad, dim, write;
    int64_t count;
    double  time[64], constant[3];
    int32_t first, stride;
} record;

static int32_t recorder(void *user, double time, int64_t count, const int32_t *points, double *value) {
    record *r = (record *)user;
    int64_t i;
    int k;
    if (r->calls < 64) r->time[r->calls] = time;
    r->calls++;
    if (count != r->count) r->bad++;
    for (i = 0; i < count; ++i)
        for (k = 0; k < r->dim; ++k) {
            if (points[i] != r->first + r->stride * (int32_t)i || value[i * r->dim + k] != r->constant[k]) r->bad++;
            if (r->write) value[i * r->dim + k] = (1 + time) * r->constant[k];
        }
    return 0;
}

/* SOURCE OF TRUTH: the contract: constant at entry, the set's points in ascending order, once per step for the time at its end:
   dt, 2dt, ...; loads and velocities also at the start. */
static void callbacks_get_the_right_calls(void) {
    const double t[2] = {0.0025, -0.005};
    peri_body *b = block(PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 5, 4, 1);
    int32_t set = column(b, 4), load[4];
    record r[4];
    double dt = 0.5 * peri_stable_step(b), f[2];
    int k, s;
    memset(r, 0, sizeof r);
    for (k = 0; k < 4; ++k) {
        r[k].dim = 2;
        r[k].count = k == 1 ? 20 : 4;
        r[k].first = k == 1 ? 0 : 4;
        r[k].stride = k == 1 ? 1 : 5;
        r[k].constant[0] = t[0];
        r[k].constant[1] = t[1];
        r[k].write = k < 2;
    }
    load[0] = peri_apply_layer_traction(b, set, 0.4, t, recorder, &r[0]);
    load[1] = peri_apply_body_force(b, PERI_ALL, t, recorder, &r[1]);
    load[2] = peri_prescribe_velocity(b, set, PERI_AXIS_X, t, recorder, &r[2]);
    load[3] = peri_prescribe_displacement(b, set, PERI_AXIS_Y, t, recorder, &r[3]);
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 10, dt, 0);
    for (k = 0; k < 4; ++k) {
        int first = k < 3 ? 0 : 1;
        CHECK(PERI_ID_INDEX(load[k]) == k + 1 && r[k].bad == 0 && r[k].calls == 11 - first);
        for (s = 0; s < r[k].calls && s < 64; ++s) CHECK_NEAR(r[k].time[s], (s + first) * dt, 1e-13, 0);
    }
    (void)MUST(b, peri_get_reaction(b, load[0], f));
    CHECK_NEAR(f[0], (1 + 10 * dt) * t[0] * 0.4 * THICK, 1e-12, 0);
    (void)MUST(b, peri_get_reaction(b, load[1], f));
    CHECK_NEAR(f[1], (1 + 10 * dt) * t[1] * 20 * H * H * THICK, 1e-12, 0);
    peri_body_destroy(b);
}

/* v(t) = 0.2 + 0.5 t in x; d(t) = 0.01 t in y. */
static int32_t ramp_velocity(void *user, double time, int64_t count, const int32_t *points, double *value) {
    int64_t i;
    (void)user;
    (void)points;
    for (i = 0; i < count; ++i) value[2 * i] = 0.2 + 0.5 * time;
    return 0;
}
static int32_t ramp_displacement(void *user, double time, int64_t count, const int32_t *points, double *value) {
    int64_t i;
    (void)points;
    for (i = 0; i < count; ++i) value[2 * i + 1] = *(double *)user * time;
    return 0;
}

/* SOURCE OF TRUTH: a prescribed component is what was prescribed. A velocity linear in time has u = 0.2 t + 0.25 t^2, which
   any second-order rule integrates exactly. The other component keeps its own motion (here all points start with the same
   velocity and share it: no bond pulls). */
static void supports_prescribe_their_components_only(void) {
    const double v0[2] = {0.3, -0.1};
    double rate = 0.07, *u, *v, t;
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 5, 4, 1);
    int64_t i;
    (void)MUST(b, peri_add_velocity(b, PERI_ALL, v0));
    (void)MUST(b, peri_prescribe_velocity(b, PERI_ALL, PERI_AXIS_X, NULL, ramp_velocity, NULL));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 40, 0, 0);
    t = peri_time(b);
    u = get(b, PERI_FIELD_DISPLACEMENT);
    v = get(b, PERI_FIELD_VELOCITY);
    for (i = 0; i < 20; ++i) {
        CHECK_NEAR(u[2 * i], 0.2 * t + 0.25 * t * t, 1e-12, 0);
        CHECK_NEAR(v[2 * i], 0.2 + 0.5 * t, 1e-12, 0);
        CHECK_NEAR(u[2 * i + 1], -0.1 * t, 1e-12, 0);
        CHECK_NEAR(v[2 * i + 1], -0.1, 1e-12, 0);
    }
    free(u);
    free(v);
    peri_body_destroy(b);

    b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 5, 4, 1);
    (void)MUST(b, peri_add_velocity(b, PERI_ALL, v0));
    (void)MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_Y, NULL, NULL, NULL));
    (void)MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_Y, NULL, ramp_displacement, &rate)); /* the later one wins */
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 40, 0, 0);
    t = peri_time(b);
    u = get(b, PERI_FIELD_DISPLACEMENT);
    for (i = 0; i < 20; ++i) {
        CHECK_NEAR(u[2 * i], 0.3 * t, 1e-12, 0);
        CHECK_NEAR(u[2 * i + 1], 0.07 * t, 1e-12, 0);
    }
    free(u);
    peri_body_destroy(b);
}

static int32_t sway(void *user, double time, int64_t count, const int32_t *points, double *value) {
    int64_t i;
    (void)user;
    (void)points;
    for (i = 0; i < count; ++i) {
        value[2 * i] = 0.03 * sin(2.5 * time);
        value[2 * i + 1] = 0.02 * (1 - cos(1.5 * time));
    }
    return 0;
}

/* SOURCE OF TRUTH: Newton's second law. A support that carries the whole body along with v = 0.2 + 0.5 t exerts 0.5 M. Where it
   holds one column, the momentum of the body is the sum of reaction times step, to rounding at any step: no other force acts. */
static void supports_give_the_momentum(void) {
    const int steps[2] = {50, 400};
    double force[2], p[2], gap[2];
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 5, 4, 1);
    int32_t load = (int32_t)MUST(b, peri_prescribe_velocity(b, PERI_ALL, PERI_AXIS_X, NULL, ramp_velocity, NULL));
    int round, k;
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 20, 0, 0);
    (void)MUST(b, peri_get_reaction(b, load, force));
    CHECK_NEAR(force[0], 0.5 * 20 * H * H * THICK * DENSITY, 1e-11, 0);
    CHECK(force[1] == 0);
    peri_body_destroy(b);
    for (round = 0; round < 2; ++round) {
        double dt = 2.0 / steps[round], sum[2] = {0, 0};
        b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 8, 4, 1);
        load = (int32_t)MUST(b, peri_prescribe_velocity(b, column(b, 0), PERI_AXIS_X | PERI_AXIS_Y, NULL, sway, NULL));
        for (k = 0; k < steps[round]; ++k) {
            (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 1, dt, 0);
            (void)MUST(b, peri_get_reaction(b, load, force));
            sum[0] += dt * force[0];
            sum[1] += dt * force[1];
        }
        (void)MUST(b, peri_get_momentum(b, p, NULL));
        gap[round] = hypot(p[0] - sum[0], p[1] - sum[1]) / hypot(p[0], p[1]);
        peri_body_destroy(b);
    }
    printf("    momentum less impulse of the support: %.2e, %.2e\n", gap[0], gap[1]);
    CHECK(gap[0] <= 1e-12 && gap[1] <= 1e-12);
}

/* Where two supports hold different columns, each holds its own; the later one wins in the column that both have. */
static void later_supports_win(void) {
    const double one[2] = {0.01, 0}, two[2] = {0.02, 0}, lo[2] = {0, 0}, hi[2] = {2 * H, 4 * H};
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 5, 4, 1);
    int32_t wide = (int32_t)MUST(b, peri_select_box(b, "wide", lo, hi));
    double *u;
    (void)MUST(b, peri_prescribe_displacement(b, wide, PERI_AXIS_X, one, NULL, NULL));
    (void)MUST(b, peri_prescribe_displacement(b, column(b, 1), PERI_AXIS_X, two, NULL, NULL));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 3, 0.4 * peri_stable_step(b), 0); /* short of the first swing of what is free */
    u = get(b, PERI_FIELD_DISPLACEMENT);
    CHECK_NEAR(u[0], 0.01, 1e-15, 0);
    CHECK_NEAR(u[2], 0.02, 1e-15, 0);
    CHECK(u[4] != 0 && fabs(u[4]) < 0.02); /* the third column is free */
    free(u);
    peri_body_destroy(b);
}

/* SOURCE OF TRUTH: peri.h: later supports win. Which are later is told by those that there are: a support that is removed gives its
   components back to the last one before it, and a component that nobody prescribes is free. x of column 0 under three supports, y of it
   under one. */
static void removed_supports_give_back(void) {
    const double one[2] = {0.01, 0.004}, two[2] = {0.02, 9}, three[2] = {0.03, 9}, lo[2] = {0, 0}, hi[2] = {2 * H, 4 * H};
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 5, 4, 1);
    const int32_t wide = (int32_t)MUST(b, peri_select_box(b, "wide", lo, hi));
    const int32_t first = (int32_t)MUST(b, peri_prescribe_displacement(b, column(b, 0), PERI_AXIS_XY, one, NULL, NULL));
    const int32_t second = (int32_t)MUST(b, peri_prescribe_displacement(b, wide, PERI_AXIS_X, two, NULL, NULL));
    const int32_t third = (int32_t)MUST(b, peri_prescribe_displacement(b, column(b, 0), PERI_AXIS_X, three, NULL, NULL));
    const int32_t removed[4] = {0, second, third, first};
    const double x0[4] = {0.03, 0.03, 0.01, 0}, y0[4] = {0.004, 0.004, 0.004, 0}; /* 0: free */
    int k;
    for (k = 0; k < 4; ++k) {
        double *u, r[2];
        if (removed[k]) MUST(b, peri_remove_load(b, removed[k]));
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 2, 0, 0);
        u = get(b, PERI_FIELD_DISPLACEMENT);
        if (k < 3) CHECK_NEAR(u[0], x0[k], 1e-15, 0);
        else CHECK(fabs(u[0] - 0.01) > 1e-6);
        if (k < 3) CHECK_NEAR(u[1], y0[k], 1e-15, 0);
        else CHECK(fabs(u[1] - 0.004) > 1e-6);
        if (k == 0) CHECK_NEAR(u[2], 0.02, 1e-15, 0);
        else CHECK(fabs(u[2] - 0.02) > 1e-6); /* column 1 is free with its only support gone */
        free(u);
        if (k < 2) { /* x of the first belongs to others: its reaction is along y */
            MUST(b, peri_get_reaction(b, first, r));
            CHECK(r[0] == 0 && r[1] != 0);
        } else if (k == 2) {
            MUST(b, peri_get_reaction(b, first, r));
            CHECK(r[0] != 0);
        }
    }
    peri_body_destroy(b);
}

/* SOURCE OF TRUTH: peri.h: peri_reset takes all motion away. A body at rest that nothing loads needs nobody to hold it, as before its first
   step; under a body force a support holds what the bonds to it would, none. Bonds that can break and such that cannot. */
static void reactions_are_reset(void) {
    int breakable;
    for (breakable = 0; breakable < 2; ++breakable) {
        const double pull[2] = {0.3, 0.1}, shift[2] = {1e-3, 0};
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, H, 3, 6, 4, 1);
        double *field, r[2], want[2];
        int32_t still, driven, k;
        peri_body *b;
        s.material.critical_stretch = breakable ? 0.5 : 0;
        b = specimen_make(&s);
        still = (int32_t)MUST(b, peri_prescribe_displacement(b, column(b, 0), PERI_AXIS_XY, NULL, NULL, NULL));
        driven = (int32_t)MUST(b, peri_prescribe_displacement(b, column(b, 5), PERI_AXIS_X, shift, NULL, NULL));
        MUST(b, peri_apply_body_force(b, PERI_ALL, pull, NULL, NULL));
        MUST(b, peri_get_reaction(b, still, want));
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 20, 0, 0);
        MUST(b, peri_get_reaction(b, driven, r));
        CHECK(fabs(r[0]) > 1e-3);
        MUST(b, peri_reset(b));
        MUST(b, peri_get_reaction(b, still, r));
        for (k = 0; k < 2; ++k) {
            CHECK_NEAR(r[k], want[k], 1e-15, 0);
            CHECK_NEAR(r[k], -pull[k] * 4 * H * H, 1e-12, 0); /* what is put on its points themselves */
        }
        MUST(b, peri_remove_load(b, peri_id(b, PERI_KIND_LOAD, 3)));
        MUST(b, peri_reset(b));
        field = get(b, PERI_FIELD_REACTION);
        for (k = 0; k < 48; ++k) CHECK(field[k] == 0);
        free(field);
        peri_body_destroy(b);
    }
}

/* SOURCE OF TRUTH: peri.h: a clone is an independent copy, and a run goes on at peri_load_factor: so it does of the clone. */
static void clones_keep_the_load_factor(void) {
    const double pull[2] = {0.3, 0.1};
    int solved;
    for (solved = 0; solved < 2; ++solved) {
        peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 6, 4, 1), *copy = NULL;
        peri_advance_desc r;
        peri_solve_desc s;
        double *u[2], total[2];
        const int32_t load = (int32_t)MUST(b, peri_apply_body_force(b, column(b, 5), pull, NULL, NULL));
        MUST(b, peri_prescribe_displacement(b, column(b, 0), PERI_AXIS_XY, NULL, NULL, NULL));
        peri_advance_desc_init(&r);
        r.steps = 3;
        r.load_factor = 0.25;
        peri_solve_desc_init(&s);
        s.load_to = 0.25;
        if (solved) MUST(b, peri_solve(b, &s, NULL));
        else MUST(b, peri_advance(b, &r));
        CHECK(peri_body_clone(b, &copy, NULL) == PERI_OK);
        CHECK(peri_load_factor(copy) == 0.25);
        MUST(copy, peri_get_reaction(copy, load, total));
        CHECK_NEAR(total[0], 0.25 * pull[0] * 4 * H * H * THICK, 1e-12, 0);
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 5, 0, 0);
        (void)go(copy, PERI_INTEGRATOR_VELOCITY_VERLET, 5, 0, 0);
        CHECK(peri_load_factor(copy) == 0.25 && peri_load_factor(b) == 0.25);
        u[0] = get(b, PERI_FIELD_DISPLACEMENT);
        u[1] = get(copy, PERI_FIELD_DISPLACEMENT);
        CHECK(u[0][10] > 1e-3 && memcmp(u[0], u[1], 48 * sizeof **u) == 0);
        free(u[0]);
        free(u[1]);
        peri_body_destroy(b);
        peri_body_destroy(copy);
    }
}

static int32_t spoil(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const double *when = (const double *)user;
    (void)points;
    if (time >= *when && count > 1) value[2 * 1 + 1] = NAN;
    return 0;
}
static int32_t spoil_motion(void *user, double time, double *place, double *turn) {
    (void)turn;
    if (time >= *(const double *)user) place[0] = HUGE_VAL;
    return 0;
}

/* SOURCE OF TRUTH: the contract of PERI_ERROR_CALLBACK: found at the step where it happens, the point named, and the body goes
   on once the load is gone. The spoilt entry is the second of the set of column 4: point 9. */
static void callbacks_that_write_nan(void) {
    int k;
    for (k = 0; k < 4; ++k) {
        peri_body *b = block(PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 5, 4, 1);
        int32_t set = column(b, 4), load = -1;
        double dt = 0.5 * peri_stable_step(b), when = 2.9 * dt, *u;
        const double up[2] = {0, 1}, below[2] = {0, -1};
        peri_error e;
        peri_advance_desc r;
        peri_advance_desc_init(&r);
        r.steps = 10;
        r.time_step = dt;
        if (k == 0) load = peri_apply_layer_traction(b, set, 1, origin, spoil, &when);
        if (k == 1) load = peri_prescribe_velocity(b, set, PERI_AXIS_Y, NULL, spoil, &when);
        if (k == 2) load = peri_prescribe_displacement(b, set, PERI_AXIS_Y, NULL, spoil, &when);
        if (k == 3) (void)MUST(b, plane_obstacle(b, below, up, 0, spoil_motion, &when));
        CHECK(peri_advance(b, &r) == PERI_ERROR_CALLBACK);
        CHECK(peri_get_error(b, &e) == PERI_OK && e.code == PERI_ERROR_CALLBACK && e.text && e.field);
        if (k < 3) CHECK(e.index == 9);
        CHECK(peri_step_count(b) >= 2 && peri_step_count(b) <= 3);
        u = get(b, PERI_FIELD_DISPLACEMENT);
        CHECK(largest(u, 40) < HUGE_VAL);
        free(u);
        if (k < 3) CHECK(peri_remove_load(b, load) == PERI_OK && peri_advance(b, &r) == PERI_OK);
        peri_body_destroy(b);
    }
}

/* ---- obstacles ---------------------------------------------------------------------------------------------------- */

/* SOURCE OF TRUTH: sum over the points of stiffness * depth * normal * volume, from the places of the points, both shapes, and
   the default stiffness young/spacing^2. 60 points, a few roundings each, depths from differences: 1e-12. */
static void obstacle_force_by_brute_force(void) {
    const double place[2] = {0.2, 0.13}, normal[2] = {1, 2}, centre[2] = {0.5, 0.4}, radius = 0.17;
    int kind, k, i;
    for (kind = 0; kind < 2; ++kind) {
        peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 10, 6, 1);
        double *u = random_field(120, 0.3 * H, 9), *x, stiffness = kind ? 40 : YOUNG / (H * H), want[2] = {0, 0}, got[2], sum[2];
        int32_t id = (int32_t)MUST(b, kind ? ball_obstacle(b, centre, radius, stiffness, NULL, NULL)
                                           : plane_obstacle(b, place, normal, 0, NULL, NULL));
        int touched = 0;
        put(b, PERI_FIELD_DISPLACEMENT, u);
        x = get(b, PERI_FIELD_CURRENT_POSITION);
        for (i = 0; i < 60; ++i) {
            double rx = x[2 * i] - (kind ? centre[0] : place[0]), ry = x[2 * i + 1] - (kind ? centre[1] : place[1]);
            double len = sqrt(rx * rx + ry * ry), nx = kind ? rx / len : 1 / sqrt(5.0), ny = kind ? ry / len : 2 / sqrt(5.0);
            double depth = kind ? radius - len : -(nx * rx + ny * ry);
            if (depth <= 0) continue;
            touched++;
            want[0] += stiffness * depth * nx * H * H * THICK;
            want[1] += stiffness * depth * ny * H * H * THICK;
        }
        CHECK(touched >= 3 && touched < 60);
        (void)MUST(b, peri_get_obstacle_force(b, id, got, NULL));
        resultant(b, PERI_SPACE_PLANE_STRESS, sum); /* the bonds' own forces cancel in the sum */
        for (k = 0; k < 2; ++k) {
            CHECK_NEAR(got[k], want[k], 1e-12, 1e-14);
            CHECK_NEAR(sum[k], want[k], 1e-10, 1e-12);
        }
        free(u);
        free(x);
        peri_body_destroy(b);
    }
}

static peri_body *disc(int32_t precision) {
    const double centre[2] = {0, 0.5};
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, precision, PERI_GEOMETRY_NONLINEAR, 3 * H);
    CHECK(MUST(b, peri_add_ball(b, unbreakable(b, YOUNG, DENSITY), centre, 0.5, H)) > 60);
    (void)MUST(b, peri_build(b));
    return b;
}

/* SOURCE OF TRUTH: momentum and energy conservation. A disc of ~80 points, radius 0.5, 4 points in its lowest row, falls on a
   plane of stiffness 3: contact frequency sqrt(3*4/(2*80)) = 0.27, a tenth of the disc's lowest frequency (about 1.8*0.8/0.5 =
   2.9), so it leaves about (0.27/2.9)^2 = 1 % of the speed, at most, in vibration. It can never leave faster than it came. The
   penalty force has a potential, so after contact its work is zero but for O((0.27 dt)^2) = 3e-5 of the kinetic energy. */
static void a_disc_bounces(void) {
    const double v0[2] = {0.004, -0.01}, up[2] = {0, 1};
    peri_body *b = disc(PERI_PRECISION_DOUBLE);
    double p0[2], p1[2], f[2];
    peri_energy e;
    int32_t plane = (int32_t)MUST(b, plane_obstacle(b, origin, up, 3, NULL, NULL));
    int touched = 0, k;
    (void)MUST(b, peri_add_velocity(b, PERI_ALL, v0));
    (void)MUST(b, peri_get_momentum(b, p0, NULL));
    for (k = 0; k < 25; ++k) {
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 50, 0.02, 0);
        (void)MUST(b, peri_get_obstacle_force(b, plane, f, NULL));
        CHECK(f[0] == 0 && f[1] >= 0);
        if (f[1] > 0) touched++;
    }
    CHECK(touched > 3 && f[1] == 0);
    (void)MUST(b, peri_get_momentum(b, p1, NULL));
    (void)MUST(b, peri_get_energy(b, &e));
    printf("    bounce: -v_out/v_in = %.6f, obstacle work/initial = %.2g, error/initial = %.2g\n", -p1[1] / p0[1],
           e.obstacle / e.initial, e.error / e.initial);
    CHECK_NEAR(p1[0], p0[0], 1e-11, 0);
    CHECK_NEAR(p1[1], -p0[1], 0.01, 0);
    CHECK(fabs(p1[1]) <= fabs(p0[1]) * (1 + 1e-4));
    CHECK(fabs(e.obstacle) <= 1e-4 * e.initial && fabs(e.error) <= 1e-4 * e.initial);
    CHECK(e.external == 0 && e.fracture == 0 && e.damping == 0);
    peri_body_destroy(b);
}

/* Places: y = 0.01 t - 0.02 (plane); z = 0.01 t - 1.02 (ball of radius 1). */
static int32_t rise(void *user, double time, double *place, double *turn) {
    (void)turn;
    place[*(const int *)user] = 0.01 * time - (*(const int *)user == 2 ? 1.02 : 0.02);
    return 0;
}

/* SOURCE OF TRUTH: Galileo. An obstacle that moves with constant velocity V does the work V.(impulse) once contact is over (in
   its own frame its force has a potential), and the impulse is the momentum that a body at rest has gained. Errors as in the
   bounce, O((w dt)^2) of the energy. A soft push hands over 2 M V; the rest is vibration. */
static void moving_obstacles_push(void) {
    const double up[3] = {0, 1, 0};
    int dim;
    for (dim = 2; dim <= 3; ++dim) {
        const double under[3] = {0, dim == 3 ? 0 : -0.02, -1.02}, lo[3] = {-2 * H, -2 * H, 0}, hi[3] = {2 * H, 2 * H, 4 * H};
        int axis = dim - 1, k;
        double p[3], f[3], l[3], mass, *vol;
        int64_t i;
        peri_energy e;
        peri_body *b = dim == 2 ? disc(PERI_PRECISION_DOUBLE)
                                : empty(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 3 * H);
        int32_t id;
        if (dim == 3) {
            (void)MUST(b, peri_add_box(b, unbreakable(b, YOUNG, DENSITY), lo, hi, H));
            (void)MUST(b, peri_build(b));
        }
        id = (int32_t)MUST(b, dim == 2 ? plane_obstacle(b, under, up, 3, rise, &axis)
                                       : ball_obstacle(b, under, 1, 4, rise, &axis));
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 1250, 0.02, 0);
        (void)MUST(b, peri_get_obstacle_force(b, id, f, NULL));
        (void)MUST(b, peri_get_momentum(b, p, l));
        (void)MUST(b, peri_get_energy(b, &e));
        vol = get(b, PERI_FIELD_VOLUME);
        for (mass = 0, i = 0; i < peri_point_count(b); ++i) mass += vol[i] * DENSITY * (dim == 2 ? THICK : 1);
        free(vol);
        printf("    push %dD: p/2MV = %.6f, work/(V p) - 1 = %.2g, error/work = %.2g\n", dim, p[axis] / (2 * mass * 0.01),
               e.obstacle / (0.01 * p[axis]) - 1, e.error / e.obstacle);
        for (k = 0; k < dim; ++k) CHECK(f[k] == 0); /* contact is over */
        CHECK_NEAR(p[axis], 2 * mass * 0.01, 0.01, 0);
        CHECK_NEAR(e.obstacle, 0.01 * p[axis], 2e-4, 0);
        CHECK_NEAR(e.obstacle, e.kinetic + e.elastic, 2e-4, 0);
        CHECK(e.external == 0 && e.initial == 0 && fabs(e.error) <= 2e-4 * e.obstacle);
        for (k = 0; k < axis; ++k) CHECK_NEAR(p[k], 0, 0, 1e-11 * p[axis]); /* by symmetry */
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(load_totals);
    RUN(free_fall_is_a_parabola);
    RUN(reaction_balances_the_load);
    RUN(callbacks_get_the_right_calls);
    RUN(supports_prescribe_their_components_only);
    RUN(supports_give_the_momentum);
    RUN(later_supports_win);
    RUN(removed_supports_give_back);
    RUN(reactions_are_reset);
    RUN(clones_keep_the_load_factor);
    RUN(callbacks_that_write_nan);
    RUN(obstacle_force_by_brute_force);
    RUN(a_disc_bounces);
    RUN(moving_obstacles_push);
    return test_end("test_loads");
}
