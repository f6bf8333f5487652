/* SPDX-License-Identifier: MIT */
/* test_parts.c - parts that come off in quasi-static fracture; fracture control beside all that a solve may meet.

   SOURCE OF TRUTH: peri.h; equilibrium of the body without what came off; the ledger; the criterion that every event meets; a second body
   on which the same is done another way. */
#include "pool.h"
#include "solid.h"
#include "equilibrium.h"

#define LIMIT 0.01

/* ---- splinters ---------------------------------------------------------------------------------------------------- */

/* A plate of nx x ny cells, both ends held along x and y, the upper end moved up; from `cut` to the right edge a slit is cut, and a block
   above it hangs on to the plate by the bonds to its left. */
static peri_body *plate(int32_t law, int32_t geometry, double stretch, double scatter, uint64_t seed) {
    solid s = solid_of(PERI_SPACE_PLANE_STRESS, law, PERI_CORRECTION_NONE);
    specimen p = specimen_of(s.space, law, s.nu, H, 3, 16, 12, 1);
    p.desc.geometry = geometry;
    p.material = solid_material(&s);
    p.material.critical_stretch = stretch;
    if (stretch == 0) {
        p.material.criterion = PERI_CRITERION_NODE_ENERGY;
        p.material.fracture_energy = 1e-4;
    }
    p.scatter = scatter;
    p.seed = seed;
    return specimen_make(&p);
}

/* Pulled apart and pushed aside in its middle until it is in pieces. Chips come off that nothing holds; they are left where they are, and
   what is held stands as it does where chips are pinned. */
static void chips_come_off(void) {
    const double up[2] = {0, 1.2 * H}, aside[2] = {0.5 * H, 0}, from[2] = {7 * H, 5 * H}, to[2] = {9 * H, 7 * H};
    peri_solve_report r[2];
    double *u[2];
    int64_t n = 0, i;
    int k, moved = 0;
    for (k = 0; k < 2; ++k) {
        peri_body *b = plate(PERI_LAW_LPS, PERI_GEOMETRY_LINEAR, 0, 0.5, 9);
        peri_solve_desc st = statics_of(1e-9);
        peri_energy e;
        (void)MUST(b, peri_prescribe_displacement(b, slab(b, 1, 0, 3 * H), PERI_AXIS_XY, NULL, NULL, NULL));
        (void)MUST(b, peri_prescribe_displacement(b, slab(b, 1, 9 * H, 12 * H), PERI_AXIS_XY, up, NULL, NULL));
        (void)MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, from, to)), PERI_AXIS_X, aside, NULL, NULL));
        st.loose = k ? PERI_LOOSE_PINNED : PERI_LOOSE_REFUSED;
        st.steps = 6;
        st.criticality = 0.3;
        if (k == 0) { /* goes on from solve to solve */
            st.load_to = 0.5;
            st.steps = 3;
            r[0] = solve(b, &st);
            st.load_to = 1;
        }
        r[k] = solve(b, &st);
        (void)MUST(b, peri_get_energy(b, &e));
        CHECK(fabs(e.error) <= 1e-7 * e.external && r[k].load_factor == 1);
        u[k] = get(b, PERI_FIELD_DISPLACEMENT);
        n = peri_point_count(b);
        peri_body_destroy(b);
    }
    printf("    %d parts, %d points came off\n", (int)r[0].lost_parts, (int)r[0].lost_points);
    CHECK(r[0].ended == PERI_ENDED_LOAD || r[0].ended == PERI_ENDED_SEVERED);
    CHECK(r[0].lost_parts > 0 && r[0].lost_points >= r[0].lost_parts && r[0].lost_points < n / 2 && r[0].loose == 0);
    CHECK(r[1].lost_parts == 0 && r[1].loose > 0);
    for (i = 0; i < n; ++i) moved += hypot(u[0][2 * i] - u[1][2 * i], u[0][2 * i + 1] - u[1][2 * i + 1]) > 1e-5 * H;
    CHECK(moved <= r[0].lost_points);
    free(u[0]);
    free(u[1]);
}

/* A block is cut free in on_step, which counts as broken: the solve goes on as if it were not there, and so does the next. Cut before the
   start it is refused; so is it where a load acts on it. */
typedef struct knife {
    double  from[2], corner[2], to[2];
    int64_t steps;
} knife;
static int32_t cut_free(void *user, peri_body *b) {
    knife *k = (knife *)user;
    if (++k->steps != 1) return 0;
    (void)MUST(b, peri_cut_segment(b, PERI_CUT_NOW, k->from, k->corner));
    (void)MUST(b, peri_cut_segment(b, PERI_CUT_NOW, k->corner, k->to));
    return 0;
}
static void a_block_is_cut_free(void) {
    const double up[2] = {0, 0.1 * H}, pull[2] = {1e-6, 0};
    int way;
    for (way = 0; way < 4; ++way) { /* cut in on_step; before the start, without the block's own part in it; with a load; first of all */
        peri_body *b = plate(PERI_LAW_LPS, PERI_GEOMETRY_LINEAR, 1, 0, 0);
        knife k = {{17 * H, 8 * H}, {12 * H, 8 * H}, {12 * H, 4 * H}, 0};
        const double below[2][2] = {{12 * H, 4 * H}, {17 * H, 4 * H}}, block_lo[2] = {12 * H, 4 * H}, block_hi[2] = {16 * H, 8 * H};
        peri_solve_desc st = statics_of(1e-10);
        peri_solve_report r;
        double *u, moved = 0;
        int64_t i;
        int32_t code;
        (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, below[0], below[1]));
        (void)MUST(b, peri_prescribe_displacement(b, slab(b, 1, 0, 2 * H), PERI_AXIS_XY, NULL, NULL, NULL));
        (void)MUST(b, peri_prescribe_displacement(b, slab(b, 1, 10 * H, 12 * H), PERI_AXIS_XY, up, NULL, NULL));
        if (way == 2)
            (void)MUST(b, peri_apply_body_force(b, (int32_t)MUST(b, peri_select_box(b, NULL, block_lo, block_hi)), pull, NULL, NULL));
        st.steps = 2;
        st.on_step = cut_free;
        st.user = &k;
        if (way == 1) {
            (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, k.from, k.corner));
            (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, k.corner, k.to));
        }
        memset(&r, 0, sizeof r);
        code = peri_solve(b, &st, &r);
        if (way == 1 || way == 2) {
            CHECK(code == PERI_ERROR_LOOSE && r.ended == 0 && r.lost_parts == 0);
            peri_body_destroy(b);
            continue;
        }
        CHECK(code == PERI_OK && r.ended == PERI_ENDED_LOAD && r.lost_parts == 1 && r.lost_points == 16 && r.loose == 0);
        u = get(b, PERI_FIELD_DISPLACEMENT);
        for (i = 0; i < peri_point_count(b); ++i)
            if (i % 16 >= 12 && i / 16 >= 4 && i / 16 < 8) moved = fmax(moved, fabs(u[2 * i + 1] - u[2 * (12 + 16 * 4) + 1]));
        CHECK(moved < 0.05 * H); /* as a whole, without strain */
        st.load_to = 0.5;
        st.on_step = NULL;
        r = solve(b, &st);
        CHECK(r.lost_parts == 1 && r.lost_points == 16);
        free(u);
        peri_body_destroy(b);
    }
}

/* ---- in two ------------------------------------------------------------------------------------------------------- */

/* A notched strip, its foot held, its head moved or pulled along y. */
static peri_body *strip(int32_t law, int32_t criterion, int32_t geometry, int forced, int32_t *head) {
    const double notch[2][2] = {{-1, 10 * H}, {4 * H, 10 * H}}, up[2] = {0, 0.5 * H}, pull[2] = {0, 0.02};
    solid s = solid_of(PERI_SPACE_PLANE_STRESS, law, PERI_CORRECTION_NONE);
    specimen p = specimen_of(s.space, law, s.nu, H, 3, 14, 20, 1);
    peri_body *b;
    int side;
    p.desc.geometry = geometry;
    p.desc.thickness = THICK;
    p.material = solid_material(&s);
    p.material.criterion = criterion;
    if (criterion == PERI_CRITERION_STRETCH) p.material.critical_stretch = LIMIT;
    else p.material.fracture_energy = 1e-5;
    b = specimen_make(&p);
    (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, notch[0], notch[1]));
    for (side = 0; side < 2; ++side) (void)MUST(b, peri_set_no_fail(b, slab(b, 1, side ? 17 * H : 0, side ? 20 * H : 3 * H), 1));
    (void)MUST(b, peri_prescribe_displacement(b, slab(b, 1, 0, 3 * H), PERI_AXIS_XY, NULL, NULL, NULL));
    *head = (int32_t)(forced ? MUST(b, peri_apply_layer_traction(b, slab(b, 1, 19 * H, 20 * H), 14 * H, pull, NULL, NULL))
                             : MUST(b, peri_prescribe_displacement(b, slab(b, 1, 17 * H, 20 * H), PERI_AXIS_XY, up, NULL, NULL)));
    return b;
}

/* Moved, the head comes off, carries nothing more, and the solve goes on to the end. Pulled, it comes loose: a success that says so, the
   ledger closed, where the last bond broke; there is then no equilibrium to go on with. Under either control. */
static void a_strip_in_two(void) {
    int forced, control;
    for (forced = 0; forced < 2; ++forced)
        for (control = PERI_CONTROL_LOAD; control <= PERI_CONTROL_FRACTURE; ++control) {
            int32_t head;
            peri_body *b = strip(PERI_LAW_LPS, PERI_CRITERION_STRETCH, PERI_GEOMETRY_LINEAR, forced, &head);
            double rows[400][6], peak = 0;
            peri_solve_desc st = statics_of(1e-9);
            peri_solve_report r;
            peri_energy e;
            int k, last;
            st.control = control;
            st.steps = 10;
            st.curve_load = head;
            st.curve = rows[0];
            st.curve_rows = 400;
            r = solve(b, &st);
            (void)MUST(b, peri_get_energy(b, &e));
            CHECK(r.broken > 100 && r.steps == r.curve_rows && r.curve_rows <= 400);
            last = (int)r.curve_rows - 1;
            for (k = 0; k <= last; ++k) peak = fmax(peak, rows[k][4]);
            CHECK(fabs(e.error) <= 1e-7 * e.external);
            CHECK_NEAR(e.external, e.elastic + e.fracture + e.damping, 1e-7, 0);
            if (!forced) {
                CHECK(r.ended == PERI_ENDED_LOAD && r.load_factor == 1 && rows[last][0] == 1 && rows[last][4] < 1e-6 * peak);
                CHECK(e.elastic < 1e-9 * e.external);
            } else {
                peri_error error;
                CHECK(r.ended == PERI_ENDED_SEVERED && r.load_factor < 1 && peri_load_factor(b) == r.load_factor);
                if (control == PERI_CONTROL_LOAD) CHECK(r.load_factor > rows[last][0]);
                else CHECK(r.load_factor == rows[last][0] && rows[last][4] < 0.2 * peak);
                CHECK(peri_solve(b, &st, &r) == PERI_ERROR_LOOSE && r.ended == 0 && peri_get_error(b, &error) == PERI_OK);
                CHECK(error.index >= 10 * 14); /* a point of the head */
            }
            if (control == PERI_CONTROL_FRACTURE) CHECK(e.damping < (forced ? 1e-12 : 0.02) * e.external);
            peri_body_destroy(b);
        }
}

/* ---- fracture control ---------------------------------------------------------------------------------------------- */

typedef struct strain_watch {
    double *x, most; /* the largest excess over one, of intact bonds at an event                                          */
    int64_t events, stop_at, cut_at, seen_broken;
} strain_watch;

/* At an event the most overloaded of the bonds that may break is at its limit, and no other over it. */
static int32_t at_limit(void *user, peri_body *b) {
    strain_watch *w = (strain_watch *)user;
    double *u = get(b, PERI_FIELD_DISPLACEMENT), most = 0;
    int64_t n = peri_point_count(b);
    int32_t width = peri_family_width(b), i, k, *rows = (int32_t *)calloc((size_t)(n * width), sizeof *rows);
    (void)MUST(b, peri_get_families(b, 0, n, rows, n * width));
    for (i = 0; i < n; ++i)
        for (k = 0; k < width; ++k) {
            const int32_t j = rows[(int64_t)i * width + k];
            const double *p = &w->x[2 * i], *q = &w->x[2 * j], xi[2] = {q[0] - p[0], q[1] - p[1]};
            const double eta[2] = {u[2 * j] - u[2 * i], u[2 * j + 1] - u[2 * i + 1]}, square = xi[0] * xi[0] + xi[1] * xi[1];
            if (j <= i || fmin(p[1], q[1]) < 3 * H || fmax(p[1], q[1]) > 17 * H || peri_bond_is_intact(b, i, j) != 1) continue;
            most = fmax(most, (xi[0] * eta[0] + xi[1] * eta[1]) / square / LIMIT);
        }
    free(rows);
    free(u);
    w->most = fmax(w->most, fabs(most - 1));
    w->events++;
    w->seen_broken = peri_broken_count(b);
    if (w->events == w->cut_at) {
        const double from[2] = {12 * H, 10 * H}, to[2] = {15 * H, 10 * H};
        (void)MUST(b, peri_cut_segment(b, PERI_CUT_NOW, from, to));
    }
    return w->events == w->stop_at;
}
static int32_t dead_load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    int64_t k;
    (void)time;
    (void)points;
    for (k = 0; k < count; ++k) value[2 * k] = *(const double *)user;
    return 0;
}

/* With all proportional, and beside a load that does not go with the factor; with a cut in between; stopped where it is asked to. */
static void every_event_is_at_the_limit(void) {
    int way;
    for (way = 0; way < 4; ++way) {
        const double zero[2] = {0, 0};
        int32_t head;
        peri_body *b = strip(PERI_LAW_LPS, PERI_CRITERION_STRETCH, PERI_GEOMETRY_LINEAR, 0, &head);
        double push = 2e-4;
        strain_watch w;
        peri_solve_desc st = statics_of(1e-10);
        peri_solve_report r;
        peri_energy e;
        int32_t code;
        memset(&w, 0, sizeof w);
        w.x = get(b, PERI_FIELD_POSITION);
        if (way == 1) (void)MUST(b, peri_apply_body_force(b, slab(b, 1, 11 * H, 14 * H), zero, dead_load, &push));
        w.cut_at = way == 2 ? 5 : 0;
        w.stop_at = way == 3 ? 7 : 0;
        st.control = PERI_CONTROL_FRACTURE;
        st.breaks = 20;
        st.on_step = at_limit;
        st.user = &w;
        memset(&r, 0, sizeof r);
        code = peri_solve(b, &st, &r);
        (void)MUST(b, peri_get_energy(b, &e));
        CHECK(code == (way == 3 ? PERI_STOPPED : PERI_OK) && r.ended == (way == 3 ? PERI_ENDED_STOPPED : PERI_ENDED_BREAKS));
        CHECK(w.most < 1e-6 && w.events == (way == 3 ? 7 : way == 2 ? 22 : 21) && r.steps == w.events && r.broken >= (way == 3 ? 6 : 20));
        CHECK(fabs(e.error) <= 1e-7 * e.external + (way == 1 ? 1e-2 * e.external : 0)); /* the dead load comes at once */
        free(w.x);
        peri_body_destroy(b);
    }
}

/* Whatever the criterion and the geometry: load control breaks nothing just short of the factor of the first event, and something just past
   it; the ledger of what follows closes. */
static void the_first_event(void) {
    int32_t criterion, geometry;
    for (criterion = PERI_CRITERION_STRETCH; criterion <= PERI_CRITERION_NODE_ENERGY; ++criterion)
        for (geometry = PERI_GEOMETRY_NONLINEAR; geometry <= PERI_GEOMETRY_LINEAR; ++geometry) {
            double rows[40][6];
            int k;
            int32_t head;
            peri_body *b = strip(PERI_LAW_LPS, criterion, geometry, 0, &head), *copy = NULL;
            peri_solve_desc st = statics_of(1e-9), short_of;
            peri_solve_report r;
            peri_energy e;
            (void)MUST(b, peri_body_clone(b, &copy, NULL));
            st.steps = 4;
            st.control = PERI_CONTROL_FRACTURE;
            st.breaks = 8;
            st.curve_load = head;
            st.curve = rows[0];
            st.curve_rows = 40;
            r = solve(b, &st);
            (void)MUST(b, peri_get_energy(b, &e));
            CHECK(r.ended == PERI_ENDED_BREAKS && r.broken >= 8 && r.curve_rows <= 40);
            CHECK(fabs(e.error) <= (geometry == PERI_GEOMETRY_LINEAR ? 1e-7 : 0.02) * e.external && e.fracture > 0 && e.damping == 0);
            for (k = 0; k < r.curve_rows && rows[k + 1][5] == 0; ++k) {}
            CHECK(rows[k][5] == 0 && rows[k + 1][5] > 0);
            const double near = criterion == PERI_CRITERION_BOND_ENERGY && geometry == PERI_GEOMETRY_NONLINEAR ? 1e-3 : 1e-5; /* of work */
            short_of = statics_of(1e-9);
            short_of.load_to = rows[k][0] * (1 - near);
            short_of.steps = 10;
            r = solve(copy, &short_of);
            CHECK(r.broken == 0);
            short_of.load_to = rows[k][0] * (1 + near);
            short_of.steps = 1;
            r = solve(copy, &short_of);
            CHECK(r.broken > 0);
            peri_body_destroy(copy);
            peri_body_destroy(b);
        }
}

/* The same bits after a reset, in a clone and with four threads. */
static void the_same_path_again(void) {
    double *u[4];
    int64_t n = 0;
    int k;
    for (k = 0; k < 2; ++k) {
        int32_t head;
        solid s = solid_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_CORRECTION_NONE);
        specimen p = specimen_of(s.space, s.law, s.nu, H, 3, 20, 20, 1);
        const double notch[2][2] = {{-1, 10 * H}, {4 * H, 10 * H}}, up[2] = {0, 0.5 * H};
        peri_body *b, *copy = NULL;
        peri_solve_desc st = statics_of(1e-8);
        p.desc.threads = k ? 4 : 1;
        p.desc.geometry = PERI_GEOMETRY_LINEAR;
        p.material = solid_material(&s);
        p.material.critical_stretch = LIMIT;
        b = specimen_make(&p);
        (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, notch[0], notch[1]));
        (void)MUST(b, peri_prescribe_displacement(b, slab(b, 1, 0, 3 * H), PERI_AXIS_XY, NULL, NULL, NULL));
        head = (int32_t)MUST(b, peri_prescribe_displacement(b, slab(b, 1, 17 * H, 20 * H), PERI_AXIS_XY, up, NULL, NULL));
        st.control = PERI_CONTROL_FRACTURE;
        st.breaks = 15;
        st.curve_load = head;
        (void)solve(b, &st);
        u[2 * k] = get(b, PERI_FIELD_DISPLACEMENT);
        n = 2 * peri_point_count(b);
        if (!k) {
            (void)MUST(b, peri_reset(b));
            (void)MUST(b, peri_body_clone(b, &copy, NULL));
        }
        (void)solve(copy ? copy : b, &st); /* k = 1: goes on, into the same body */
        u[2 * k + 1] = get(copy ? copy : b, PERI_FIELD_DISPLACEMENT);
        peri_body_destroy(copy);
        peri_body_destroy(b);
    }
    CHECK(largest(u[0], n) > 0);
    CHECK(memcmp(u[0], u[1], (size_t)n * sizeof *u[0]) == 0 && memcmp(u[0], u[2], (size_t)n * sizeof *u[0]) == 0);
    CHECK(memcmp(u[0], u[3], (size_t)n * sizeof *u[0]) != 0);
    for (k = 0; k < 4; ++k) free(u[k]);
}

/* ---- without memory ----------------------------------------------------------------------------------------------- */

/* Every allocation of a solve under fracture control fails once: PERI_ERROR_MEMORY, nothing kept, and the next solve does it. */
static void every_allocation_fails_once(void) {
    int64_t calls = 1, k;
    for (k = -1; k < calls; ++k) {
        const double up[2] = {0, 0.5 * H};
        pool p = {0, 0, 0, 0, -1, 0};
        solid s = solid_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_CORRECTION_NONE);
        specimen q = specimen_of(s.space, s.law, s.nu, H, 2, 8, 10, 1);
        peri_solve_desc st = statics_of(1e-8);
        peri_body *b;
        int64_t before;
        int32_t code;
        hook(&q.desc, &p);
        q.material = solid_material(&s);
        q.material.critical_stretch = LIMIT;
        b = specimen_make(&q);
        (void)MUST(b, peri_prescribe_displacement(b, slab(b, 1, 0, 2 * H), PERI_AXIS_XY, NULL, NULL, NULL));
        (void)MUST(b, peri_prescribe_displacement(b, slab(b, 1, 8 * H, 10 * H), PERI_AXIS_XY, up, NULL, NULL));
        st.control = PERI_CONTROL_FRACTURE;
        st.breaks = 1;
        before = p.blocks;
        calls = k < 0 ? p.calls : calls;
        p.fail_at = k < 0 ? -1 : p.calls + k;
        code = peri_solve(b, &st, NULL);
        if (k < 0) calls = p.calls - calls;
        CHECK(code == (k < 0 ? PERI_OK : PERI_ERROR_MEMORY) && p.blocks == before);
        p.fail_at = -1;
        (void)MUST(b, peri_solve(b, &st, NULL));
        peri_body_destroy(b);
        CHECK(p.blocks == 0);
    }
    CHECK(calls > 10);
}

/* What is refused names its field: criticality of zero would break all that is stretched. */
static void fields_of_control(void) {
    int32_t head;
    peri_body *b = strip(PERI_LAW_LPS, PERI_CRITERION_STRETCH, PERI_GEOMETRY_LINEAR, 0, &head);
    peri_solve_desc st;
    peri_error e;
    peri_solve_desc_init(&st);
    CHECK(st.control == PERI_CONTROL_LOAD && st.criticality == 0.98);
    st.control = PERI_LOOSE_PINNED;
    CHECK(peri_solve(b, &st, NULL) == PERI_ERROR_CHOICE && peri_get_error(b, &e) == PERI_OK && strcmp(e.field, "control") == 0);
    st.control = PERI_CONTROL_FRACTURE;
    st.criticality = 0;
    CHECK(peri_solve(b, &st, NULL) == PERI_ERROR_RANGE && peri_get_error(b, &e) == PERI_OK && strcmp(e.field, "criticality") == 0);
    st.control = PERI_CONTROL_LOAD;
    st.load_to = 0.01;
    (void)solve(b, &st);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(chips_come_off);
    RUN(a_block_is_cut_free);
    RUN(a_strip_in_two);
    RUN(every_event_is_at_the_limit);
    RUN(the_first_event);
    RUN(the_same_path_again);
    RUN(every_allocation_fails_once);
    RUN(fields_of_control);
    return test_end("test_parts");
}
