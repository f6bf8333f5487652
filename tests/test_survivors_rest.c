/* SPDX-License-Identifier: MIT */
/* test_survivors_rest.c - what `make mutants` found that no other test of equilibria looked at.

   SOURCE OF TRUTH: with one free point the block of its diagonal is the whole stiffness, so that conjugate gradients end after one step;
   peri.h (peri_solve_report, criticality, lost_parts); a linear body stores what is done on it; what is at rest again has no residual. */
#include "refusal.h"

static int32_t band(peri_body *b, double from, double to) {
    const double lo[3] = {from, -1e9, -1e9}, hi[3] = {to, 1e9, 1e9};
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}
static void hold(peri_body *b, int32_t set, double x) {
    const double to[2] = {x, 0};
    MUST(b, peri_prescribe_displacement(b, set, PERI_AXIS_XY, to, NULL, NULL));
}

static int32_t all_but_the_first(void *user, int64_t index, const double *x) {
    (void)user, (void)x;
    return index > 0;
}

/* A corner, whose family is one-sided: theta and the gradient of its own are a part of the stiffness that it feels. */
static void one_free_point_takes_one_step(void) {
    for (int32_t law = PERI_LAW_BOND_BASED; law <= PERI_LAW_CORRESPONDENCE; ++law) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.3, 1, 2.2, 6, 5, 1);
        const double force[2] = {1e-3, -3e-3};
        const int32_t first = 0;
        peri_solve_report r;
        peri_solve_desc st;
        s.desc.geometry = PERI_GEOMETRY_LINEAR;
        peri_body *b = specimen_make(&s);
        hold(b, (int32_t)MUST(b, peri_select_if(b, NULL, all_but_the_first, NULL)), 0);
        MUST(b, peri_apply_body_force(b, (int32_t)MUST(b, peri_select_points(b, NULL, 1, &first)), force, NULL, NULL));
        peri_solve_desc_init(&st);
        st.preconditioner = PERI_PRECONDITIONER_BLOCK_JACOBI;
        MUST(b, peri_solve(b, &st, &r));
        CHECK(r.iterations == 1 && r.newton == 1);
        peri_body_destroy(b);
    }
}

/* Displaced by hand, held on the left and let go, a body is at rest at 0, and what is left of its forces is rounding: of a solve that
   succeeds the residual is within the tolerance. */
static void rest_has_no_residual(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.2, 8, 5, 1);
    peri_solve_report r;
    peri_solve_desc st;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *b = specimen_make(&s);
    double *u = random_field(80, 1e-2, 7);
    put(b, PERI_FIELD_DISPLACEMENT, u);
    hold(b, band(b, 0, 2), 0);
    peri_solve_desc_init(&st);
    MUST(b, peri_solve(b, &st, &r));
    CHECK(r.residual <= 1e-8);
    double *at = get(b, PERI_FIELD_DISPLACEMENT);
    CHECK(largest(at, 80) <= 1e-8 * 1e-2);
    free(at);
    free(u);
    peri_body_destroy(b);
}

/* Linear up to a tenth, then as good as infinite: the sum of squares of such forces is no number. */
static int32_t explode(void *user, const peri_bond_row *row) {
    (void)user;
    for (int32_t k = 0; k < row->count; ++k) {
        const double s = row->stretch[k], c = fabs(s) < 0.1 ? 1 : 1e200;
        row->force[k] = c * s;
        if (row->tangent) row->tangent[k] = c;
        if (row->energy) row->energy[k] = 0.5 * c * s * s;
    }
    return 0;
}

/* A step that leads out of all numbers is taken back: the body is where it was before, and the residual is that of there. */
static void what_leads_nowhere_is_taken_back(void) {
    for (int relaxed = 0; relaxed < 2; ++relaxed) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.2, 6, 3, 1);
        const double pull[2] = {1, 0};
        peri_solve_report r;
        peri_solve_desc st;
        peri_body *b = specimen_start(&s);
        const int32_t m = peri_id(b, PERI_KIND_MATERIAL, 1);
        MUST(b, peri_set_bond_law(b, m, m, 0, explode, NULL));
        MUST(b, peri_add_box(b, m, s.lo, s.hi, 1));
        MUST(b, peri_build(b));
        hold(b, band(b, 0, 2), 0);
        if (relaxed) MUST(b, peri_apply_body_force(b, band(b, 4, 6), pull, NULL, NULL));
        else hold(b, band(b, 4, 6), 3);
        peri_solve_desc_init(&st);
        st.method = relaxed ? PERI_METHOD_RELAXATION : PERI_METHOD_NEWTON;
        st.halvings = 0;
        memset(&r, 0, sizeof r);
        REFUSE(b, PERI_ERROR_CONVERGENCE, peri_solve(b, &st, &r));
        double *u = get(b, PERI_FIELD_DISPLACEMENT);
        CHECK(largest(u, 36) == 0);
        if (!relaxed) CHECK(r.residual < HUGE_VAL && seen.value < HUGE_VAL);
        free(u);
        peri_body_destroy(b);
    }
}

/* Under small loads a body of nonlinear geometry is linear all but 1e-6: a whole step is right, after which the forces are asked for once;
   a search for the step asks three times or more. */
static void whole_steps_are_taken(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.2, 6, 4, 1);
    const double force[2] = {1e-6, 0};
    peri_solve_report r;
    peri_solve_desc st;
    s.desc.geometry = PERI_GEOMETRY_NONLINEAR;
    peri_body *b = specimen_make(&s);
    hold(b, band(b, 0, 2), 0);
    MUST(b, peri_apply_body_force(b, band(b, 4, 6), force, NULL, NULL));
    peri_solve_desc_init(&st);
    st.method = PERI_METHOD_BICGSTAB;
    MUST(b, peri_solve(b, &st, &r));
    CHECK(r.newton >= 1 && r.passes <= 2 + 2 * r.newton);
    peri_body_destroy(b);
}

/* ---- fracture ------------------------------------------------------------------------------------------------------- */

static int32_t across(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    const double at = *(const double *)user;
    (void)i, (void)j;
    return (xi[0] - at) * (xj[0] - at) < 0;
}

/* A strip of two rows, pulled at its ends, with two planes of bonds that bear less. */
static peri_body *strip(double first, double second, int32_t ledger, double pull) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 1.5, 12, 2, 1);
    double left = 4, right = 8;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.desc.ledger = ledger;
    s.material.critical_stretch = 0.01;
    peri_body *b = specimen_make(&s);
    if (first < 1) MUST(b, peri_set_strength_if(b, first, across, &left));
    if (second < 1) MUST(b, peri_set_strength_if(b, second, across, &right));
    hold(b, band(b, 0, 1), 0);
    hold(b, band(b, 11, 12), pull);
    return b;
}

/* Both planes break at once, and what lies between them, 4 x 2 points, is lost. */
static void what_breaks_off_is_told(void) {
    peri_body *b = strip(0.5, 0.5, 1, 0.07);
    peri_solve_report r;
    peri_solve_desc st;
    peri_solve_desc_init(&st);
    MUST(b, peri_solve(b, &st, &r));
    CHECK(r.lost_parts == 1 && r.lost_points == 8 && peri_bond_is_intact(b, 3, 4) == 0 && peri_bond_is_intact(b, 7, 8) == 0);
    peri_body_destroy(b);
}

/* "break those over this part of the largest excess": of two planes of 0.5 and 0.7 of the strength the weaker alone loses bonds in the
   first round where that part is 0.8, and both where it is 0.6; no bond besides has more than 0.5. */
static void round_of(double criticality, int both) {
    peri_body *b = strip(0.5, 0.7, 1, 0.07);
    peri_solve_report r;
    peri_solve_desc st;
    peri_solve_desc_init(&st);
    st.control = PERI_CONTROL_FRACTURE;
    st.criticality = criticality;
    st.breaks = 1;
    MUST(b, peri_solve(b, &st, &r));
    CHECK(r.broken >= 1 && r.ended == PERI_ENDED_BREAKS);
    CHECK(peri_bond_is_intact(b, 3, 4) == 0 && peri_bond_is_intact(b, 15, 16) == 0);
    CHECK(peri_bond_is_intact(b, 7, 8) == !both && peri_bond_is_intact(b, 19, 20) == !both);
    CHECK(peri_bond_is_intact(b, 2, 3) == 1 && peri_bond_is_intact(b, 9, 10) == 1);
    peri_body_destroy(b);
}
static void rounds_break_what_is_critical(void) {
    round_of(0.8, 0);
    round_of(0.6, 1);
}

/* Clapeyron: loads from nothing to where they are now have done on a linear body what it has stored, in however many steps. */
static void work_is_stored_step_by_step(void) {
    peri_body *b = strip(1, 1, 1, 0.07);
    peri_solve_desc st;
    peri_energy e;
    peri_solve_desc_init(&st);
    st.control = PERI_CONTROL_FRACTURE;
    st.steps = 4;
    st.load_from = 0;
    MUST(b, peri_solve(b, &st, NULL));
    MUST(b, peri_get_energy(b, &e));
    CHECK(peri_broken_count(b) == 0 && e.elastic > 1e-5);
    CHECK_NEAR(e.external, e.elastic, 1e-7, 0);
    peri_body_destroy(b);
}

typedef struct bent_strip {
    double *x, first;
    int     mirrored;
} bent_strip;

static int32_t strain_more_and_more(void *user, double factor, int64_t count, const int32_t *points, double *value) {
    const bent_strip *s = (const bent_strip *)user;
    for (int64_t k = 0; k < count; ++k) {
        const double x = s->x[2 * points[k]], way = s->mirrored ? 10 - x : x;
        value[2 * k] = (s->mirrored ? -1 : 1) * 1e-3 * factor * way * way;
        value[2 * k + 1] = 0;
    }
    return 0;
}
static int32_t note_first(void *user, peri_body *b) {
    bent_strip *s = (bent_strip *)user;
    if (s->first == 0) s->first = peri_load_factor(b);
    return 0;
}

/* A strain that grows along x breaks the first bond at the same factor as its image in a mirror, in which the ends of bonds have changed
   places. */
static double first_factor(int32_t criterion, int mirrored) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 1, 2.2, 10, 4, 1);
    bent_strip strip = {NULL, 0, mirrored};
    peri_solve_desc st;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.material.criterion = criterion;
    s.material.fracture_energy = 1e-4;
    peri_body *b = specimen_make(&s);
    strip.x = get(b, PERI_FIELD_POSITION);
    MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_XY, NULL, strain_more_and_more, &strip));
    peri_solve_desc_init(&st);
    st.control = PERI_CONTROL_FRACTURE;
    st.load_to = 20;
    st.breaks = 1;
    st.on_step = note_first;
    st.user = &strip;
    MUST(b, peri_solve(b, &st, NULL));
    CHECK(peri_broken_count(b) > 0);
    free(strip.x);
    peri_body_destroy(b);
    return strip.first;
}
static void mirrored_bodies_break_alike(void) {
    static const int32_t criteria[3] = {PERI_CRITERION_STRETCH, PERI_CRITERION_BOND_ENERGY, PERI_CRITERION_NODE_ENERGY};
    for (int k = 0; k < 3; ++k) {
        const double one = first_factor(criteria[k], 0), other = first_factor(criteria[k], 1);
        CHECK(one > 0);
        CHECK_NEAR(other, one, 1e-5, 0);
    }
}

/* [T] 1.102: the bond that breaks first has w0 = (W_i/V_i + W_j/V_j), the mean of 2 W over the volume of the family at its ends. */
static void nodes_have_the_mean_of_their_ends(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 1, 2.2, 10, 4, 1);
    const double factor = first_factor(PERI_CRITERION_NODE_ENERGY, 0);
    double w0, most = 0, u[80];
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.material.criterion = PERI_CRITERION_NODE_ENERGY;
    s.material.fracture_energy = 1e-4;
    peri_body *b = specimen_make(&s);
    MUST(b, peri_get_critical_energy(b, peri_id(b, PERI_KIND_MATERIAL, 1), &w0));
    double *x = get(b, PERI_FIELD_POSITION);
    for (int k = 0; k < 40; ++k) u[2 * k] = 1e-3 * factor * x[2 * k] * x[2 * k], u[2 * k + 1] = 0;
    put(b, PERI_FIELD_DISPLACEMENT, u);
    double *w = get(b, PERI_FIELD_ENERGY_DENSITY);
    for (int32_t i = 0; i < 40; ++i) {
        int family = 0;
        for (int32_t j = 0; j < 40; ++j) family += j != i && hypot(x[2 * i] - x[2 * j], x[2 * i + 1] - x[2 * j + 1]) < 2.2;
        w[i] /= family;
    }
    for (int32_t i = 0; i < 40; ++i)
        for (int32_t j = 0; j < i; ++j)
            if (fabs(x[2 * i] - x[2 * j]) > 0.5 && hypot(x[2 * i] - x[2 * j], x[2 * i + 1] - x[2 * j + 1]) < 2.2)
                most = fmax(most, w[i] + w[j]);
    CHECK_NEAR(most, w0, 1e-5, 0);
    free(x);
    free(w);
    peri_body_destroy(b);
}

/* A plate of 5 x 4 points, and a point that hangs on one oblique bond from its corner. "just enough is held": three components hold the
   plate where it is; one across the bond of the point that hangs, which a turn moves most, would not. */
static void pins_hold_the_plate(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 1.5, 1, 1, 1);
    const double force[2] = {3e-4, 1e-3};
    const int32_t end = 14;
    double at[42], volume[21];
    peri_solve_report r;
    peri_solve_desc st;
    for (int k = 0; k < 20; ++k) at[2 * k] = k % 5, at[2 * k + 1] = k / 5;
    at[40] = 4.9, at[41] = 3.9;
    for (int k = 0; k < 21; ++k) volume[k] = 1;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_points(b, 21, at, volume, NULL));
    MUST(b, peri_build(b));
    MUST(b, peri_apply_body_force(b, (int32_t)MUST(b, peri_select_points(b, NULL, 1, &end)), force, NULL, NULL));
    peri_solve_desc_init(&st);
    st.loose = PERI_LOOSE_PINNED;
    MUST(b, peri_solve(b, &st, &r));
    double *u = get(b, PERI_FIELD_DISPLACEMENT);
    CHECK(r.loose == 3 && largest(u, 40) < 0.1);
    free(u);
    peri_body_destroy(b);
}

/* The first law through an arrest: of a strip that hangs on a force one inner bond breaks and no other follows; all that the force has done
   is stored or lost to the bond and to the springs that it freed. */
static void work_through_an_arrest(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 1.5, 12, 5, 1);
    const int32_t weak[2] = {29, 30};
    const double factor = 0.3, force[2] = {0.005, 0};
    peri_solve_desc st;
    peri_energy e;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.material.critical_stretch = 0.01;
    peri_body *b = specimen_make(&s);
    MUST(b, peri_set_strength_pairs(b, 1, weak, &factor));
    hold(b, band(b, 0, 1), 0);
    MUST(b, peri_apply_body_force(b, band(b, 11, 12), force, NULL, NULL));
    peri_solve_desc_init(&st);
    st.control = PERI_CONTROL_FRACTURE;
    MUST(b, peri_solve(b, &st, NULL));
    MUST(b, peri_get_energy(b, &e));
    CHECK(peri_broken_count(b) == 1 && peri_load_factor(b) == 1 && e.fracture + e.damping > 1e-4 * e.external);
    CHECK(fabs(e.external - e.elastic - e.fracture - e.damping) <= 1e-7 * e.external);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(one_free_point_takes_one_step);
    RUN(rest_has_no_residual);
    RUN(what_leads_nowhere_is_taken_back);
    RUN(whole_steps_are_taken);
    RUN(what_breaks_off_is_told);
    RUN(rounds_break_what_is_critical);
    RUN(work_is_stored_step_by_step);
    RUN(mirrored_bodies_break_alike);
    RUN(nodes_have_the_mean_of_their_ends);
    RUN(pins_hold_the_plate);
    RUN(work_through_an_arrest);
    return test_end("test_survivors_rest");
}
