/* SPDX-License-Identifier: MIT */
/* A state that was put aside and taken up again goes on as if nothing had been.

   SOURCE OF TRUTH: the run that was not interrupted, to the last bit. */
#include "restart_scene.h"
#include <setjmp.h>

static const int32_t laws[4] = { PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE };
static const int32_t precisions[3] = { PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_SINGLE };

/* ---- reading and writing back ------------------------------------------------------------------------------------------------------- */

static void write_back(peri_body *b) {
    static double out[600];
    const int64_t dofs = peri_point_count(b) * peri_dimension(b);
    for (int32_t field = PERI_FIELD_DISPLACEMENT; field <= PERI_FIELD_VELOCITY; ++field) {
        (void)MUST(b, peri_get_field(b, field, out, dofs));
        (void)MUST(b, peri_set_field(b, field, out, dofs));
    }
}

/* Read and written back every few steps, a run stays the same to the last bit: motion, bonds, ledger. */
static void read_then_written_is_as_before(void) {
    for (int law = 0; law < 4; ++law)
        for (int p = 0; p < 3; ++p) {
            const scene s = scene_of(laws[law], law == 1 ? PERI_CRITERION_BOND_ENERGY : PERI_CRITERION_STRETCH, precisions[p], law % 2);
            peri_body *a = scene_make(&s), *b = scene_make(&s);
            for (int part = 0; part < 3; ++part) {
                scene_run(a, 20);
                scene_run(b, 20);
                write_back(b);
            }
            CHECK(peri_broken_count(a) > 10 && same_state(a, b));
            peri_body_destroy(a);
            peri_body_destroy(b);
        }
}

/* One entry that was changed is the only one that changes. */
static void only_what_differs_is_set(void) {
    static double now[600], then[600], velocity[600];
    const scene s = scene_of(PERI_LAW_BOND_BASED, PERI_CRITERION_STRETCH, PERI_PRECISION_DOUBLE, 1);
    peri_body *a = scene_make(&s), *b = scene_make(&s);
    const int64_t dofs = peri_point_count(a) * peri_dimension(a);
    peri_view v, w;
    int64_t differ = 0;
    scene_run(a, 20);
    scene_run(b, 20);
    (void)MUST(a, peri_get_field(a, PERI_FIELD_DISPLACEMENT, now, dofs));
    (void)MUST(a, peri_get_field(a, PERI_FIELD_VELOCITY, velocity, dofs));
    now[37] += 0.125;
    (void)MUST(a, peri_set_field(a, PERI_FIELD_DISPLACEMENT, now, dofs));
    (void)MUST(a, peri_get_field(a, PERI_FIELD_DISPLACEMENT, then, dofs));
    CHECK_NEAR(then[37], now[37], 1e-15, 0);
    (void)MUST(a, peri_view_field(a, PERI_FIELD_DISPLACEMENT, &v));
    (void)MUST(b, peri_view_field(b, PERI_FIELD_DISPLACEMENT, &w));
    for (int64_t i = 0; i < v.count; ++i)
        for (int32_t d = 0; d < v.components; ++d) {
            const int64_t at = i * v.point_stride + d * v.component_stride;
            differ += ((const double *)v.data)[at] != ((const double *)w.data)[at];
        }
    CHECK(differ == 1);
    CHECK(same_view(a, b, PERI_FIELD_VELOCITY));
    peri_body_destroy(a);
    peri_body_destroy(b);
}

/* ---- checkpoints --------------------------------------------------------------------------------------------------- */

/* Saved, loaded into a body of the same scene, and gone on with: the bits of the run that went on itself. That the state shows no
   difference right after loading says that all was saved; after 30 more steps, that all of it was taken. */
static int64_t goes_on(const scene *at, const scene *elsewhere) {
    const double nudge[3] = { 1e-3, 0, 0 };
    buffer file = { NULL, 0, 0, 0 };
    peri_body *a = scene_make(at), *b = scene_make(elsewhere);
    scene_run(a, 40);
    save(a, &file);
    if (at->scattered) scene_run(b, 7); /* what the body went through before is over */
    (void)MUST(b, load(b, &file));
    CHECK(file.at == file.count);
    CHECK(same_state(a, b));
    peri_body *c = NULL, *d = NULL; /* forces and reactions made anew are the same, too */
    (void)MUST(NULL, peri_body_clone(a, &c, NULL));
    (void)MUST(NULL, peri_body_clone(b, &d, NULL));
    (void)MUST(c, peri_add_velocity(c, PERI_ALL, nudge));
    (void)MUST(d, peri_add_velocity(d, PERI_ALL, nudge));
    CHECK(same_state(c, d));
    peri_body_destroy(c);
    peri_body_destroy(d);
    scene_run(a, 30);
    scene_run(b, 30);
    CHECK(same_state(a, b));
    const int64_t broken = peri_broken_count(a);
    (void)MUST(a, peri_reset(a));
    (void)MUST(b, peri_reset(b));
    CHECK(same_state(a, b));
    peri_body_destroy(a);
    peri_body_destroy(b);
    free(file.data);
    return broken;
}

static void every_law_criterion_and_precision(void) {
    for (int law = 0; law < 4; ++law)
        for (int32_t criterion = 0; criterion < (law ? 3 : 1); ++criterion)
            for (int p = 0; p < 3; ++p)
                for (int cloud = 0; cloud < 2; ++cloud) {
                    scene s = scene_of(laws[law], PERI_CRITERION_STRETCH + criterion, precisions[p], cloud);
                    s.timing = (law + p + cloud) % 2 ? PERI_BREAK_AFTER_DRIFT : PERI_BREAK_WITHIN_STEP;
                    const int bad = test_bad;
                    CHECK(goes_on(&s, &s) > 10);
                    if (test_bad > bad) printf("    law %d, criterion %d, precision %d, cloud %d\n", law, (int)criterion, p, cloud);
                }
}

static void solids_linear_geometry_and_corrections(void) {
    for (int law = 0; law < 4; ++law)
        for (int k = 0; k < 3; ++k) {
            scene s = scene_of(laws[law], PERI_CRITERION_STRETCH, precisions[(law + k) % 3], (law + k) % 2);
            if (k == 0) s.space = PERI_SPACE_SOLID;
            if (k == 1) s.geometry = PERI_GEOMETRY_LINEAR;
            if (k == 2) s.correction = PERI_CORRECTION_MOMENT;
            const int bad = test_bad;
            CHECK(goes_on(&s, &s) > 5);
            if (test_bad > bad) printf("    law %d, %d\n", law, k);
        }
}

/* More work than one thread is given (parallel.c). */
static peri_body *large(int32_t law, int32_t threads, int32_t instructions) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.3, 0.37, 3.01, 70, 60, 0);
    const double up[2] = { 0, 0.05 }, centre[2] = { 9, 9 };
    s.desc.threads = threads;
    s.desc.instructions = instructions;
    s.material.critical_stretch = 0.02;
    peri_body *b = specimen_make(&s);
    (void)MUST(b, peri_add_velocity(b, (int32_t)MUST(b, peri_select_ball(b, NULL, centre, 4)), up));
    return b;
}

static void other_threads_and_instructions(void) {
    static const int32_t sets[4] = { PERI_INSTRUCTIONS_BEST, PERI_INSTRUCTIONS_BASELINE, PERI_INSTRUCTIONS_AVX2, PERI_INSTRUCTIONS_AVX512 };
    for (int law = 0; law < 2; ++law) {
        buffer file = { NULL, 0, 0, 0 };
        peri_body *a = large(laws[law], 1, PERI_INSTRUCTIONS_BEST);
        scene_run(a, 8);
        save(a, &file);
        scene_run(a, 8);
        CHECK(peri_broken_count(a) > 100);
        for (int k = 0; k < 4; ++k) {
            peri_body *b = large(laws[law], 1 + k, sets[k]);
            (void)MUST(b, load(b, &file));
            scene_run(b, 8);
            CHECK(same_state(a, b));
            peri_body_destroy(b);
        }
        peri_body_destroy(a);
        free(file.data);
    }
}

/* A run by central differences that saves in its frames; one of them is left by a jump, and the body taken up where it was saved. */
static jmp_buf out;
typedef struct frames {
    buffer file;
    int   count, leave;
} frames;
static int32_t save_frame(void *user, peri_body *b) {
    frames *f = (frames *)user;
    if (++f->count == 1) save(b, &f->file);
    if (f->count == f->leave) longjmp(out, 1);
    return 0;
}
static void a_frame_that_is_left_by_a_jump(void) {
    for (int law = 0; law < 4; ++law) {
        frames f = { { NULL, 0, 0, 0 }, 0, 0 };
        scene s = scene_of(laws[law], PERI_CRITERION_STRETCH, PERI_PRECISION_DOUBLE, law % 2);
        peri_body *a = scene_make(&s);
        peri_body *volatile b = scene_make(&s);
        peri_advance_desc run;
        peri_advance_desc_init(&run);
        run.integrator = PERI_INTEGRATOR_CENTRAL_DIFFERENCE;
        run.time_step = 0.0625;
        run.frame_steps = 15;
        run.on_frame = save_frame;
        run.user = &f;
        for (run.steps = 15; run.steps <= 30; run.steps += 15) (void)MUST(a, peri_advance(a, &run));
        f.count = 0;
        f.leave = 2;
        if (setjmp(out) == 0) (void)peri_advance(b, &run);
        (void)MUST(b, peri_unlock(b));
        CHECK(peri_advance(b, &run) == PERI_ERROR_ORDER);
        CHECK(peri_save_state_to(b, write_bytes, &f.file) == PERI_ERROR_ORDER);
        (void)MUST(b, load(b, &f.file));
        run.steps = 30;
        f.leave = 0;
        f.count = 1;
        (void)MUST(b, peri_advance(b, &run));
        CHECK(same_state(a, b));
        peri_body_destroy(a);
        peri_body_destroy(b);
        free(f.file.data);
    }
}

/* Equilibrium before, and after. */
static void between_two_solves(void) {
    for (int law = 0; law < 4; ++law) {
        buffer file = { NULL, 0, 0, 0 };
        const double pull[2] = { 0.08, 0 };
        specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, laws[law], 0.2, 0.37, 2.1, 14, 8, 0);
        peri_body *body[2];
        peri_solve_desc st;
        s.material.critical_stretch = 0.02;
        for (int k = 0; k < 2; ++k) {
            const double lo[2] = { 0, 0 }, grip[2] = { 0.8, 3 }, far[2] = { 4.3, 0 }, hi[2] = { 5.2, 3 };
            body[k] = specimen_make(&s);
            const int32_t left = (int32_t)MUST(body[k], peri_select_box(body[k], NULL, lo, grip));
            const int32_t right = (int32_t)MUST(body[k], peri_select_box(body[k], NULL, far, hi));
            (void)MUST(body[k], peri_prescribe_displacement(body[k], left, PERI_AXIS_XY, NULL, NULL, NULL));
            (void)MUST(body[k], peri_prescribe_displacement(body[k], right, PERI_AXIS_X, pull, NULL, NULL));
        }
        peri_solve_desc_init(&st);
        st.loose = PERI_LOOSE_PINNED;
        st.load_to = 0.5;
        (void)MUST(body[0], peri_solve(body[0], &st, NULL));
        save(body[0], &file);
        (void)MUST(body[1], load(body[1], &file));
        CHECK(same_state(body[0], body[1]) && peri_load_factor(body[1]) == 0.5);
        st.load_to = 1;
        for (int k = 0; k < 2; ++k) (void)MUST(body[k], peri_solve(body[k], &st, NULL));
        CHECK(peri_broken_count(body[0]) > 0 && same_state(body[0], body[1]));
        for (int k = 0; k < 2; ++k) scene_run(body[k], 10);
        CHECK(same_state(body[0], body[1]));
        peri_body_destroy(body[0]);
        peri_body_destroy(body[1]);
        free(file.data);
    }
}

/* Two blocks that meet and rub: one that was saved while they touch, with what dashpots and friction gave then. */
static peri_body *blocks(int32_t law, int32_t precision) {
    const double lo[2] = { 0, 0 }, hi[2] = { 3.7, 2.22 }, from[2] = { 3.9, 0.9 }, to[2] = { 6.2, 2.8 };
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.2, 0.37, 2.1, 1, 1, 0);
    s.desc.precision = precision;
    s.desc.number = 5;
    s.material.critical_stretch = 0.05;
    peri_body *b = specimen_start(&s);
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
    (void)MUST(b, peri_add_box(b, material, lo, hi, 0.37));
    (void)MUST(b, peri_add_box(b, material, from, to, 0.37));
    (void)MUST(b, peri_build(b));
    const double way[2] = { -0.2, 0.05 };
    (void)MUST(b, peri_add_velocity(b, (int32_t)MUST(b, peri_select_box(b, NULL, from, to)), way));
    peri_contact_desc c;
    peri_contact_desc_init(&c);
    c.friction = 0.3;
    c.friction_speed = 0.01;
    c.restitution = 0.7;
    (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, &c));
    return b;
}

static void blocks_that_touch(void) {
    for (int law = 0; law < 4; ++law) {
        buffer file = { NULL, 0, 0, 0 };
        peri_body *a = blocks(laws[law], precisions[law % 3]), *b = blocks(laws[law], precisions[law % 3]);
        peri_energy e = { 0 };
        for (int k = 0; k < 40 && !(e.contact > 0); ++k) {
            scene_run(a, 5);
            (void)MUST(a, peri_get_energy(a, &e));
        }
        scene_run(a, 3);
        (void)MUST(a, peri_get_energy(a, &e));
        CHECK(e.contact > 0);
        save(a, &file);
        (void)MUST(b, load(b, &file));
        CHECK(same_state(a, b));
        scene_run(a, 40);
        scene_run(b, 40);
        CHECK(same_state(a, b));
        peri_body_destroy(a);
        peri_body_destroy(b);
        free(file.data);
    }
}

/* A ball of its own mass that falls on a beam, turns, rubs and bounces: saved while it touches. */
static peri_body *falling_ball(int32_t law, int32_t *ball) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.2, 0.37, 2.1, 12, 4, 0);
    s.material.critical_stretch = 0.05;
    s.desc.number = 5;
    peri_body *b = specimen_make(&s);
    peri_obstacle_desc d;
    peri_obstacle_desc_init(&d, PERI_SHAPE_BALL);
    d.place[0] = 2.1, d.place[1] = 2.5;
    d.radius = 0.9;
    d.density = 2;
    d.friction = 0.4, d.friction_speed = 0.01;
    d.restitution = 0.8;
    d.velocity[0] = 0.1, d.velocity[1] = -0.2;
    d.spin[0] = 0.3;
    *ball = (int32_t)MUST(b, peri_add_obstacle(b, &d));
    return b;
}

static void a_free_ball_that_rubs(void) {
    for (int law = 0; law < 4; ++law) {
        buffer file = { NULL, 0, 0, 0 };
        int32_t ball;
        peri_obstacle_state at[2];
        peri_body *a = falling_ball(laws[law], &ball), *b = falling_ball(laws[law], &ball);
        memset(at, 0, sizeof at);
        for (int k = 0; k < 40 && !(at[0].lost > 0 && at[0].stored > 0); ++k) {
            scene_run(a, 2);
            (void)MUST(a, peri_get_obstacle_state(a, ball, &at[0]));
        }
        CHECK(at[0].stored > 0 && at[0].lost > 0);
        save(a, &file);
        (void)MUST(b, load(b, &file));
        CHECK(same_state(a, b));
        for (int k = 0; k < 2; ++k) {
            (void)MUST(a, peri_get_obstacle_state(a, ball, &at[0]));
            (void)MUST(b, peri_get_obstacle_state(b, ball, &at[1]));
            CHECK(memcmp(&at[0], &at[1], sizeof at[0]) == 0 && at[0].mass > 0);
            scene_run(a, 30);
            scene_run(b, 30);
            CHECK(same_state(a, b));
        }
        peri_body_destroy(a);
        peri_body_destroy(b);
        free(file.data);
    }
}

/* Flags of bonds that one body has and the other has not, either way. */
static void cuts_come_and_go(void) {
    const double from[2] = { 1.5, -1 }, to[2] = { 1.5, 1 };
    for (int law = 0; law < 2; ++law) {
        buffer whole = { NULL, 0, 0, 0 }, cut = { NULL, 0, 0, 0 };
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, laws[law], 0.2, 0.37, 2.1, 9, 7, 0);
        peri_body *a = specimen_make(&s), *b = specimen_make(&s);
        save(a, &whole);
        (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
        save(b, &cut);
        CHECK(cut.count > whole.count && peri_cut_count(b) > 5);
        (void)MUST(a, load(a, &cut));
        CHECK(same_state(a, b));
        (void)MUST(a, peri_reset(a));
        (void)MUST(b, peri_reset(b));
        CHECK(peri_cut_count(a) > 5 && same_state(a, b));
        (void)MUST(a, load(a, &whole));
        CHECK(peri_cut_count(a) == 0);
        (void)MUST(b, peri_get_families(b, 0, 1, (int32_t[64]){ 0 }, 64));
        peri_body_destroy(b);
        b = specimen_make(&s);
        CHECK(same_state(a, b));
        scene_run(a, 5);
        scene_run(b, 5);
        CHECK(same_state(a, b));
        peri_body_destroy(a);
        peri_body_destroy(b);
        free(whole.data);
        free(cut.data);
    }
}

/* In a frame the body may be saved; loading would change it. */
static int32_t save_then_load(void *user, peri_body *b) {
    buffer *file = (buffer *)user;
    save(b, file);
    CHECK(load(b, file) == PERI_ERROR_ORDER && file->at == 0);
    return 0;
}
static void frames_may_save_not_load(void) {
    buffer file = { NULL, 0, 0, 0 };
    const scene s = scene_of(PERI_LAW_BOND_BASED, PERI_CRITERION_STRETCH, PERI_PRECISION_SINGLE, 0);
    peri_body *a = scene_make(&s), *b = scene_make(&s);
    peri_advance_desc run;
    peri_advance_desc_init(&run);
    run.steps = 20;
    run.on_frame = save_then_load;
    run.user = &file;
    (void)MUST(a, peri_advance(a, &run));
    (void)MUST(b, load(b, &file));
    CHECK(same_state(a, b));
    peri_body_destroy(a);
    peri_body_destroy(b);
    free(file.data);
}

/* Loads of other values, as of another phase of a test: the state is taken, and the new values act. */
static void values_of_loads_may_differ(void) {
    buffer file = { NULL, 0, 0, 0 };
    const specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 0.37, 2.1, 6, 5, 0);
    const double first[2] = { 0.1, 0 }, second[2] = { 0, -0.3 };
    double u[60], v[60], force[2];
    peri_body *a = specimen_make(&s), *b = specimen_make(&s);
    (void)MUST(a, peri_apply_body_force(a, PERI_ALL, first, NULL, NULL));
    const int32_t other = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, second, NULL, NULL));
    scene_run(a, 10);
    save(a, &file);
    (void)MUST(b, load(b, &file));
    (void)MUST(a, peri_get_field(a, PERI_FIELD_DISPLACEMENT, u, 60));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, v, 60));
    (void)MUST(b, peri_get_reaction(b, other, force));
    CHECK(memcmp(u, v, sizeof u) == 0 && u[0] > 0);
    CHECK_NEAR(force[1], -0.3 * 30 * 0.37 * 0.37, 1e-13, 0);
    peri_body_destroy(a);
    peri_body_destroy(b);
    free(file.data);
}

static void files(void) {
    const scene s = scene_of(PERI_LAW_LPS, PERI_CRITERION_BOND_ENERGY, PERI_PRECISION_MIXED, 0);
    peri_body *a = scene_make(&s), *b = scene_make(&s);
    scene_run(a, 40);
    (void)MUST(a, peri_save_state(a, "build/test_restart.state"));
    (void)MUST(b, peri_load_state(b, "build/test_restart.state"));
    CHECK(same_state(a, b));
    (void)remove("build/test_restart.state");
    CHECK(peri_load_state(b, "build/test_restart.state") == PERI_ERROR_STATE && same_state(a, b));
    CHECK(peri_save_state(a, "build/no such folder/x") == PERI_ERROR_WRITE);
    CHECK(peri_save_state(a, NULL) == PERI_ERROR_ARGUMENT && peri_load_state(a, NULL) == PERI_ERROR_ARGUMENT);
    peri_body_destroy(a);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(every_law_criterion_and_precision);
    RUN(solids_linear_geometry_and_corrections);
    RUN(other_threads_and_instructions);
    RUN(a_frame_that_is_left_by_a_jump);
    RUN(between_two_solves);
    RUN(blocks_that_touch);
    RUN(a_free_ball_that_rubs);
    RUN(cuts_come_and_go);
    RUN(frames_may_save_not_load);
    RUN(values_of_loads_may_differ);
    RUN(files);
    RUN(read_then_written_is_as_before);
    RUN(only_what_differs_is_set);
    return test_end("test_restart");
}
